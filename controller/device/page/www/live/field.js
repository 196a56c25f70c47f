// The field view: press a point, and see the wave of one emission converge there. Everything is computed here, from the field file.
import { FieldModel } from "./field_model.js";

const at = (id) => document.getElementById(id);
const SVG = "http://www.w3.org/2000/svg", LEVELS = 255, SLOWER = 10_000, LEAD_S = 0.4e-3, TICKS = [-1, -0.25, 0, 0.25, 1];
const MISSING = 'This device has no field file: `haptic-panel focus --field-out FILE` makes one on a computer with the workshop, and field = "FILE" in page.toml has the bridge serve it.';
const PALETTES = { // from rest outwards: down, up
  light: [["#ffffff", "#9ecae1", "#2f77b8", "#08306b"], ["#ffffff", "#f9b48f", "#cb3d3d", "#67000d"]],
  dark: [["#14181f", "#1f5a94", "#4f9ee3", "#d6ecff"], ["#14181f", "#93361f", "#ea7a3d", "#ffe9c7"]],
};
const dark = matchMedia("(prefers-color-scheme: dark)"), still = matchMedia("(prefers-reduced-motion: reduce)");
const point = { x_mm: 0, y_mm: 0 };
let model, played, history, largest_m = 1, colours, frame = 0, playing = null, waiting = 0, pixels, context;

// ---- colours
const channels = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
function palette() { // of -1 to 1 by the root of the displacement
  const table = new Uint32Array(2 * LEVELS + 1), bytes = new Uint8ClampedArray(table.buffer);
  for (let level = -LEVELS; level <= LEVELS; level++) {
    const stops = PALETTES[dark.matches ? "dark" : "light"][level < 0 ? 0 : 1].map(channels);
    const along = (Math.abs(level) / LEVELS) * (stops.length - 1), n = Math.min(stops.length - 2, Math.floor(along));
    stops[n].forEach((from, i) => { bytes[4 * (level + LEVELS) + i] = from + (along - n) * (stops[n + 1][i] - from); });
    bytes[4 * (level + LEVELS) + 3] = 255;
  }
  return table;
}
function scale() {
  colours = palette();
  const picture = new ImageData(new Uint8ClampedArray(colours.slice().buffer), colours.length, 1);
  at("scale").getContext("2d").putImageData(picture, 0, 0);
  const um = TICKS.map((share) => share * largest_m * 1e6);
  at("scale").setAttribute("aria-label", `Colours from ${um[0].toFixed(1)} µm through 0 to ${um.at(-1).toFixed(1)} µm, by the root of the displacement`);
  at("ticks").replaceChildren(...TICKS.map((share, i) => {
    const tick = document.createElement("span");
    tick.textContent = `${share > 0 ? "+" : ""}${um[i].toFixed(share ? 1 : 0).replace("-", "−")}${share === 1 ? " µm" : ""}`;
    tick.style.left = `${50 + 50 * Math.sign(share) * Math.sqrt(Math.abs(share))}%`;
    tick.className = share === -1 ? "first" : share === 1 ? "last" : "";
    return tick;
  }));
}

// ---- one emission
function focus() { // once for all moves that came before it, and after the browser has drawn
  at("state").textContent = `computing the emission for ${place()}`;
  waiting ||= requestAnimationFrame(() => setTimeout(() => {
    waiting = 0;
    const [x_m, y_m] = [point.x_mm * 1e-3, point.y_mm * 1e-3];
    played = model.play(model.words(x_m, y_m));
    history = model.history(played, x_m, y_m);
    const at_T = model.samples - 1, rest_m = model.background(model.map(played, at_T), x_m, y_m);
    largest_m = Math.abs(history[at_T]) || 1e-9;
    scale();
    curve();
    at("state").textContent = `At ${place()}: ${um(history[at_T])} at T, ${(largest_m / rest_m).toFixed(0)} times the rest of the plate (${um(rest_m, 2)} rms).`;
    at("figures").dataset.rest_m = rest_m;
    show();
  }));
}
function move(x_mm, y_mm) {
  const within = (mm, most) => Math.min(most, Math.max(0, Math.round(mm * 10) / 10));
  [point.x_mm, point.y_mm] = [within(x_mm, model.length_m * 1e3), within(y_mm, model.width_m * 1e3)];
  for (const axis of ["x_mm", "y_mm"]) at(axis).value = point[axis];
  at("point").setAttribute("cx", point.x_mm);
  at("point").setAttribute("cy", model.width_m * 1e3 - point.y_mm); // the plate's y goes up, the screen's down
  focus();
}
const place = () => `${point.x_mm.toFixed(1)}, ${point.y_mm.toFixed(1)} mm`;
const um = (m, digits = 2) => `${(m * 1e6).toFixed(digits).replace("-", "−")} µm`;
const from_T = (n) => `${model.time_s(n) > 0 ? "+" : ""}${(model.time_s(n) * 1e3).toFixed(3).replace("-", "−")} ms`;

// ---- what is seen
function show() {
  if (!played) return;
  const map = model.map(played, frame), { columns, rows } = model;
  let most_m = Math.abs(history[frame]); // which may lie between points of the grid
  for (let j = 0; j < rows; j++)
    for (let i = 0, from = j * columns, to = (rows - 1 - j) * columns; i < columns; i++) {
      const u = map[from + i], size = Math.abs(u);
      if (size > most_m) most_m = size;
      const level = Math.min(LEVELS, Math.round(LEVELS * Math.sqrt(size / largest_m)));
      pixels[to + i] = colours[LEVELS + (u < 0 ? -level : level)];
    }
  context.putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer), columns, rows), 0, 0);
  at("cursor").setAttribute("d", `M${((1000 * frame) / (model.frames - 1)).toFixed(2)} 0V100`);
  at("time").value = frame;
  at("time").setAttribute("aria-valuetext", `${from_T(frame)} from T`);
  at("now").textContent = `${from_T(frame)} from T: ${um(history[frame])} at the point`;
  const rows_of = { "now, at the point": um(history[frame]), "now, largest on the plate": um(most_m), "at T, at the point": um(history[model.samples - 1]), "at T, rest of the plate (rms)": um(Number(at("figures").dataset.rest_m)) };
  at("figures").replaceChildren(...Object.entries(rows_of).flatMap(([name, value]) => ["dt", "dd"].map((kind) => {
    const node = document.createElement(kind);
    node.textContent = kind === "dt" ? name : value;
    return node;
  })));
  if (!playing) at("map").setAttribute("aria-label", `Displacement of the plate ${from_T(frame)} from T: ${um(history[frame])} at ${place()}, at most ${um(most_m)} anywhere.`);
}
function curve() {
  const places = Array.from(history, (u, n) => `${((1000 * n) / (model.frames - 1)).toFixed(1)} ${(50 - (46 * u) / largest_m).toFixed(1)}`);
  at("curve").setAttribute("d", `M${places.join("L")}`);
  at("history").setAttribute("aria-label", `Displacement of the point over time: ${um(history[model.samples - 1])} at T.`);
}
function seek(to) { frame = Math.min(model.frames - 1, Math.max(0, Math.round(to))); show(); }

// ---- time
function play(from = frame) {
  const begin = from >= model.frames - 1 ? lead() : from;
  pause();
  const per_ms = 1e-3 / SLOWER / model.bit_period_s;
  let began_ms = null;
  const step = (now_ms) => {
    began_ms ??= now_ms;
    if (waiting) began_ms = now_ms; // it is still being computed
    const to = begin + (now_ms - began_ms) * per_ms;
    playing = to < model.frames - 1 ? requestAnimationFrame(step) : null;
    seek(to);
    button();
  };
  playing = requestAnimationFrame(step);
  button();
}
function pause() { if (playing) cancelAnimationFrame(playing); playing = null; button(); }
function button() { at("play").textContent = playing ? "Pause" : "Play"; }
const lead = () => Math.max(0, model.samples - 1 - Math.round(LEAD_S / model.bit_period_s));
function press(x_mm, y_mm) { // whoever asked for less motion sees the focus, and may play
  move(x_mm, y_mm);
  if (still.matches) { pause(); frame = model.samples - 1; } else { frame = lead(); play(); }
}

// ---- pointer and keyboard
at("plate").addEventListener("click", ({ clientX, clientY }) => { // which no gesture that scrolls the page is
  const box = at("plate").getBoundingClientRect();
  press(((clientX - box.left) / box.width) * model.length_m * 1e3, ((box.bottom - clientY) / box.height) * model.width_m * 1e3);
});
at("plate").addEventListener("keydown", (event) => {
  const step = event.shiftKey ? 10 : 1, way = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
  if (way) move(point.x_mm + way[0], point.y_mm + way[1]);
  else if (event.key === " ") at("play").click();
  else if (event.key === "Enter") press(point.x_mm, point.y_mm);
  else return;
  event.preventDefault();
});
for (const axis of ["x_mm", "y_mm"])
  at(axis).addEventListener("change", () => {
    const [x_mm, y_mm] = ["x_mm", "y_mm"].map((id) => at(id).valueAsNumber);
    if (Number.isFinite(x_mm + y_mm)) press(x_mm, y_mm); else at(axis).value = point[axis];
  });
at("play").addEventListener("click", () => { if (playing) { pause(); show(); } else play(); });
at("time").addEventListener("input", () => { pause(); seek(Number(at("time").value)); });
at("history").addEventListener("click", ({ clientX }) => {
  const box = at("history").getBoundingClientRect();
  pause();
  seek(((clientX - box.left) / box.width) * (model.frames - 1));
});
dark.addEventListener("change", () => { scale(); show(); });

// ---- begin
async function begin() {
  const answer = await fetch("plate.field");
  if (!answer.ok) { at("state").textContent = answer.status === 404 ? MISSING : `The field file cannot be had: ${answer.status} ${answer.statusText}`; return; }
  model = new FieldModel(await answer.arrayBuffer());
  const [length_mm, width_mm] = [model.length_m * 1e3, model.width_m * 1e3];
  at("board").textContent = model.board;
  at("slower").textContent = SLOWER.toLocaleString("en");
  at("plate").style.aspectRatio = `${length_mm} / ${width_mm}`;
  at("drawing").setAttribute("viewBox", `0 0 ${length_mm} ${width_mm}`);
  at("patches").replaceChildren(...model.patches_m.map((patch) => {
    const [x, y, size] = patch.map((m) => m * 1e3), box = document.createElementNS(SVG, "rect");
    for (const [key, value] of Object.entries({ class: "patch", x: x - size / 2, y: width_mm - y - size / 2, width: size, height: size })) box.setAttribute(key, value);
    return box;
  }));
  [at("map").width, at("map").height] = [model.columns, model.rows];
  context = at("map").getContext("2d");
  pixels = new Uint32Array(model.columns * model.rows);
  at("time").max = model.frames - 1;
  at("times").replaceChildren(...[-2, -1, 0].map((ms) => [ms, model.samples - 1 + (ms * 1e-3) / model.bit_period_s]).filter(([, n]) => n > -2).map(([ms, n]) => {
    const tick = document.createElement("span");
    tick.textContent = ms ? `${String(ms).replace("-", "−")} ms` : "T";
    tick.style.left = `${(100 * Math.max(0, n)) / (model.frames - 1)}%`;
    if (n < 0) tick.className = "first";
    return tick;
  }));
  document.querySelector("main").hidden = false;
  button();
  press(length_mm * 0.55, width_mm * 0.45);
}
begin().catch((error) => { at("state").textContent = `The field cannot be shown: ${error.message}`; });
