"use strict";
// Ten by ten cells: two rows each of elements that rest, that are scrolled, rotated, zoomed, and animated. Twenty elements lie over others and are not to be felt.
const KINDS = ["resting", "scrolled", "rotated", "zoomed", "animated"];
const HIDDEN = [
  { hidden: true }, { style: "visibility" }, { style: "opacity" }, { disabled: true }, { inert: true }, { style: "pointer-events" }, { "aria-disabled": "true" }, { "data-haptic": "none" },
];
const layers = [], changes = [], taps = [];
HapticPanel.addEventListener("layer", ({ detail: { answer } }) => layers.push([performance.now(), answer]));
addEventListener("pointerdown", ({ clientX, clientY }) => taps.push(under(clientX, clientY)), true);

function make(parent, tag, attributes) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value === true ? "" : value);
  return parent.appendChild(element);
}
const main = make(document.body, "main", { id: "main", "data-haptic": "texture" });
for (let i = 0; i < 100; i++) {
  const kind = KINDS[Math.floor(i / 20)], cell = make(main, "div", { class: "cell" });
  if (kind === "scrolled") {
    const box = make(cell, "div", { class: "scrolled" });
    for (const letter of "ab") make(box, "button", { class: "felt", id: `scrolled-${i}${letter}` });
  } else make(cell, "button", { class: `felt ${kind}`, id: `${kind}-${i}` });
  if (i % 5 !== 2) continue;
  const { style, ...attributes } = HIDDEN[Math.floor(i / 5) % HIDDEN.length];
  const cover = make(cell, "button", { class: "felt not", id: `not-${i}`, ...attributes });
  if (style) cover.style.setProperty(style, { visibility: "hidden", opacity: "0", "pointer-events": "none" }[style]);
}
const all = (selector) => [...document.querySelectorAll(selector)];

// What a touch would meet: an element that is to be felt, or "".
function under(x, y) {
  const found = document.elementFromPoint(x, y)?.closest(".felt, main");
  return found && !found.matches(".not, :disabled") ? found.id : "";
}
function toPixels(x_mm, y_mm) {
  const box = document.body.getBoundingClientRect(), { length_mm, width_mm } = HapticPanel.plate;
  return [(x_mm / length_mm) * box.width, (1 - y_mm / width_mm) * box.height];
}
// The same at places in mm on the plate; null within a pixel of a border, where hit tests round.
function underAll(places) {
  return places.map((place) => {
    const [x, y] = toPixels(...place), found = under(x, y);
    return [[-1, 0], [1, 0], [0, -1], [0, 1]].some(([dx, dy]) => under(x + dx, y + dy) !== found) ? null : found;
  });
}
const CHANGES = {
  scrolled: (round) => all(".scrolled").forEach((box, i) => { box.scrollTop = ((round * 37 + i * 13) % 100) / 100 * (box.scrollHeight - box.clientHeight); }),
  rotated: (round) => all(".rotated").forEach((one, i) => { one.style.rotate = `${(round * 47 + i * 29) % 180}deg`; }),
  zoomed: (round) => all(".zoomed").forEach((one, i) => { one.style.zoom = 1 + ((round * 7 + i * 3) % 10) / 10; }),
  switched: (round) => all(".resting:not(.not)").forEach((one, i) => { one.disabled = (i + round) % 3 === 0; one.hidden = (i + round) % 5 === 0; }),
};
// When it was changed, and when the panel had answered the last layer that came of it.
async function change(kind, round) {
  const at = performance.now();
  layers.length = 0;
  CHANGES[kind]?.(round);
  let last;
  do {
    last = layers.length;
    await new Promise((done) => setTimeout(done, 700)); // longer than what no event announces takes
  } while (layers.length !== last);
  return [at, layers.at(-1)?.[0] ?? at, layers.flatMap(([, answer]) => answer.refused)];
}
let animations = [];
function animate() {
  animations = all(".animated").map((one, i) => one.animate(
    { translate: ["-12px -6px", "12px 6px"], rotate: ["0deg", `${10 + i}deg`] }, { duration: 500, iterations: Infinity, direction: "alternate" }));
  return Promise.all(animations.map((one) => one.ready)).then(() => performance.now());
}
function underThen(queries) { // [time, x_mm, y_mm]: the animations are set back to that time
  animations.forEach((one) => { one.began ??= one.startTime; one.pause(); });
  return queries.map(([time, ...place]) => {
    animations.forEach((one) => { one.currentTime = time - one.began; });
    return underAll([place])[0];
  });
}
