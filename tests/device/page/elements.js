"use strict";
// What the tests ask: layers that were sent, and how often the first region at a point is that of the element that a touch would meet.
const layers = [];
HapticPanel.addEventListener("layer", ({ detail }) => layers.push(detail));

function inside(one, x, y) {
  if (one.shape === "rectangle") return x >= one.x_mm && x <= one.x_mm + one.width_mm && y >= one.y_mm && y <= one.y_mm + one.height_mm;
  let is = false;
  one.corners_mm.forEach(([ax, ay], i) => {
    const [bx, by] = one.corners_mm.at(i - 1);
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) is = !is;
  });
  return is;
}

function touched(x, y) {
  let hit = document.elementFromPoint(x, y);
  while (hit?.shadowRoot) hit = hit.shadowRoot.elementFromPoint(x, y);
  if (hit?.contentDocument) {
    if (getComputedStyle(hit).opacity === "0") return "";
    const [inner_x, inner_y] = HOMES[hit.id](x, y);
    hit = hit.contentDocument.elementFromPoint(inner_x, inner_y);
  }
  while (hit && !hit.dataset.expected) hit = hit.parentElement || hit.getRootNode().host;
  return hit?.dataset.expected === "felt" && !hit.matches(":disabled") ? hit.id : "";
}

// From the page into each frame, by hand: where its upper left corner is, its border of 6 px, its angle and scale.
const HOMES = {
  plain: (x, y) => [x - 166, y - 26],
  turned: (x, y) => {
    const dx = (x - 630) / 1.2, dy = (y - 160) / 1.2, angle = (-25 * Math.PI) / 180;
    return [Math.cos(angle) * dx - Math.sin(angle) * dy + 124, Math.sin(angle) * dx + Math.cos(angle) * dy + 94];
  },
  scrolled: (x, y) => { const box = document.getElementById("box"); return [x - 29, y - 369 + box.scrollTop]; },
};

const BESIDE = [[-1, 0], [1, 0], [0, -1], [0, 1]]; // in CSS pixels

function compare(points) {
  const { regions } = layers.at(-1);
  const wrong = [];
  let seed = 7, asked = 0, right = 0, felt = 0;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  for (let i = 0; i < points; i++) {
    const px = random() * innerWidth, py = random() * innerHeight;
    const expected = touched(px, py);
    if (BESIDE.some(([dx, dy]) => touched(px + dx, py + dy) !== expected)) continue; // hit tests round near a border
    asked++;
    const region = regions.find((one) => inside(one, ...HapticPanel.toPlate(px, py)));
    const is = region?.effects.length ? region.name.replace(/ \d+$/, "") : "";
    felt += expected !== "";
    if (is === expected) right++;
    else if (wrong.length < 8) wrong.push([px, py, is, expected]);
  }
  return { asked, right, felt, wrong };
}

function hide(hidden) {
  if (hidden) Object.defineProperty(document, "hidden", { value: true, configurable: true });
  else delete document.hidden;
  document.dispatchEvent(new Event("visibilitychange"));
}

function moves(id, to, duration) {
  return document.getElementById(id).animate({ translate: ["0 0", to] }, { duration, fill: "forwards" }).finished.then(() => 0);
}
