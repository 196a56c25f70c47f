// Rectangles on the plate, as elements with data-haptic: haptic.js has the panel play them, and what is drawn is saved as a scene.toml.
(() => {
  "use strict";
  const at = (id) => document.getElementById(id);
  const panel = window.HapticPanel;
  const FIELDS = ["name", "effect", "amplitude", "x_mm", "y_mm", "width_mm", "height_mm"];
  const MOVING = ["texture", "edge", "detent", "grating"]; // of the library, beside those that a command can play
  const LEAST_MM = 2;
  const fingers = new Map();
  let plate = null, regions = [], chosen = null, dragged = null, names = 0;

  panel.addEventListener("open", ({ detail }) => {
    plate = detail;
    at("plate").style.aspectRatio = `${plate.length_mm} / ${plate.width_mm}`;
    at("drawing").setAttribute("viewBox", `0 0 ${plate.length_mm} ${plate.width_mm}`);
    const effects = [...new Set([...MOVING, ...plate.effects])];
    at("effect").replaceChildren(...effects.map((name) => new Option(name, name)));
    at("state").textContent = panel.rights.includes("regions") ? plate.board : "This page may not lay regions: what is drawn is not felt.";
    at("keeping").hidden = !panel.rights.includes("operate");
    if (panel.rights.includes("play")) panel.send({ kind: "subscribe" });
    show();
  });
  panel.addEventListener("close", ({ detail }) => { at("state").textContent = detail || "The panel's program does not answer."; fingers.clear(); draw(); });
  panel.addEventListener("layer", ({ detail }) => {
    const { refused = [], reason } = detail.answer;
    if (refused.length || reason) at("state").textContent = `Not felt: ${reason || refused.map((one) => one.reason).join("; ")}`;
    else if (plate) at("state").textContent = plate.board;
  });
  panel.addEventListener("message", ({ detail }) => {
    if (detail.kind !== "touch") return;
    if (detail.contact) fingers.set(detail.finger, detail); else fingers.delete(detail.finger);
    draw();
  });
  function draw() {
    at("fingers").replaceChildren(...[...fingers.values()].map(({ x_mm, y_mm }) => {
      const circle = document.createElementNS("http://www.w3.org/2000/svg", "circle");
      for (const [key, value] of Object.entries({ class: "finger", cx: x_mm, cy: plate.width_mm - y_mm, r: 4 })) circle.setAttribute(key, value);
      return circle;
    }));
  }

  // ---- regions: lengths in mm from the plate's lower left corner
  const tenths = (mm) => Math.round(mm * 10) / 10;
  function make(x_mm, y_mm, width_mm, height_mm) {
    const element = document.createElement("div");
    element.className = "drawn";
    at("plate").append(element);
    const taken = new Set(regions.map((one) => one.name));
    do names++; while (taken.has(`region ${names}`));
    const region = { name: `region ${names}`, effect: "click", amplitude: 1, x_mm, y_mm, width_mm, height_mm, element };
    regions.push(region);
    return region;
  }
  function show() {
    if (!plate) return;
    for (const { element, name, effect, amplitude, x_mm, y_mm, width_mm, height_mm } of regions) {
      const part = (mm, whole) => `${(100 * mm) / whole}%`;
      Object.assign(element.style, {
        left: part(x_mm, plate.length_mm), bottom: part(y_mm, plate.width_mm),
        width: part(width_mm, plate.length_mm), height: part(height_mm, plate.width_mm),
      });
      element.dataset.haptic = `${effect} ${amplitude}`;
      element.textContent = name;
      element.classList.toggle("chosen", element === chosen?.element);
    }
    at("which").replaceChildren(...regions.map((one) => new Option(one.name, one.name, false, one === chosen)));
    at("properties").hidden = !chosen;
    for (const field of chosen ? FIELDS : []) if (document.activeElement !== at(field)) at(field).value = chosen[field];
    at("toml").textContent = toml();
    for (const button of ["save", "keep"]) at(button).disabled = !regions.length;
    panel.look?.();
  }
  function choose(region) { chosen = region; show(); }

  // ---- drawing
  const place = ({ clientX, clientY }) => {
    const box = at("plate").getBoundingClientRect(), clamp = (share) => Math.min(1, Math.max(0, share));
    return [clamp((clientX - box.left) / box.width) * plate.length_mm, clamp((box.bottom - clientY) / box.height) * plate.width_mm];
  };
  at("plate").addEventListener("pointerdown", (event) => {
    if (!plate || !event.isPrimary) return;
    const hit = regions.find((one) => one.element === event.target);
    if (hit) return choose(hit);
    dragged = { from: place(event), region: null };
    at("plate").setPointerCapture(event.pointerId);
  });
  at("plate").addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const [[ax, ay], [bx, by]] = [dragged.from, place(event)];
    const box = [Math.min(ax, bx), Math.min(ay, by), Math.abs(ax - bx), Math.abs(ay - by)].map(tenths);
    if (box[2] < LEAST_MM || box[3] < LEAST_MM) return;
    dragged.region ||= make(...box);
    [dragged.region.x_mm, dragged.region.y_mm, dragged.region.width_mm, dragged.region.height_mm] = box;
    choose(dragged.region);
  });
  for (const type of ["pointerup", "pointercancel"]) at("plate").addEventListener(type, () => { dragged = null; });

  // ---- by keyboard
  at("add").addEventListener("click", () => plate && choose(make(tenths(plate.length_mm / 2 - 15), tenths(plate.width_mm / 2 - 10), 30, 20)));
  at("which").addEventListener("change", () => choose(regions.find((one) => one.name === at("which").value)));
  at("delete").addEventListener("click", () => {
    chosen.element.remove();
    regions = regions.filter((one) => one !== chosen);
    choose(regions.at(-1) || null);
  });
  for (const field of FIELDS)
    at(field).addEventListener("change", () => {
      const input = at(field), value = input.type === "number" ? input.valueAsNumber : input.value.trim();
      const taken = field === "name" && (!value || regions.some((one) => one !== chosen && one.name === value));
      if (!taken && (input.type !== "number" || input.checkValidity() || field.endsWith("_mm")) && !Number.isNaN(value)) chosen[field] = value;
      input.value = chosen[field];
      show();
    });

  // ---- as a file: the newest first, since it lies on top
  function toml() {
    const number = (value) => (Number.isInteger(value) ? `${value}.0` : String(value));
    return [...regions].reverse().map((one) => [
      "[[regions]]", `name = ${JSON.stringify(one.name)}`, 'shape = "rectangle"',
      ...["x_mm", "y_mm", "width_mm", "height_mm"].map((key) => `${key} = ${number(one[key])}`),
      ...(one.amplitude < 1 ? [`amplitude = ${one.amplitude}`] : []), `effects = [${JSON.stringify(one.effect)}]`, "",
    ].join("\n")).join("\n");
  }
  at("keeping").addEventListener("submit", (event) => {
    event.preventDefault();
    const name = at("scene-name").value;
    said(`saving ${name}`);
    panel.send({ kind: "save_scene", name, toml: toml() }).then(({ reason }) => said(reason ? `Not saved: ${reason}` : `Saved as ${name}.`, reason ? "" : name));
  });
  at("load").addEventListener("click", () => {
    const name = at("load").value;
    panel.send({ kind: "load_scene", name }).then(({ reason }) => said(reason ? `Not loaded: ${reason}` : `${name} is in force; what is drawn here lies on top of it until this page is closed.`));
  });
  function said(text, saved = "") {
    at("kept").textContent = text;
    at("load").value = saved;
    at("load").hidden = !saved;
  }
  at("save").addEventListener("click", () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([toml()], { type: "application/toml" }));
    link.download = "scene.toml";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
})();
