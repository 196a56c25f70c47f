"use strict";
// Of each emission for a finger: how long it came after the touch that caused it, by the panel's own times.
const STEP_MM = 3;
const last = new Map(), asked = new Map(); // fingers: the last touch; where the script last played, and for which touch
let ready = false, mode = "", times = [];

HapticPanel.addEventListener("open", async () => {
  await HapticPanel.send({ kind: "subscribe", to: ["touches", "emissions"] });
  ready = true;
});
HapticPanel.addEventListener("message", ({ detail }) => {
  if (detail.kind === "touch") touched(detail);
  else if (detail.kind === "emissions") detail.foci.forEach(played);
});
function touched({ finger, x_mm, y_mm, time_s, contact }) {
  if (!contact) return;
  const touches = last.get(finger) || last.set(finger, []).get(finger);
  touches.push(time_s);
  if (touches.length > 60) touches.shift();
  if (mode !== "script") return;
  const before = asked.get(finger);
  if (before && Math.hypot(x_mm - before.x_mm, y_mm - before.y_mm) < STEP_MM) return;
  asked.set(finger, { x_mm, y_mm, time_s });
  HapticPanel.send({ kind: "play", effect: "click", finger });
}
function played({ finger, time_s, of }) {
  if (finger === undefined || mode === "") return;
  if (mode === "script") {
    const cause = asked.get(finger);
    if (of === "click" && cause && time_s >= cause.time_s) times.push(time_s - cause.time_s);
  } else if (of !== "click") {
    const cause = (last.get(finger) || []).filter((at) => at <= time_s).at(-1);
    if (cause) times.push(time_s - cause);
  }
}
function begin(next) {
  [mode, times] = [next, []];
  asked.clear();
  HapticPanel.send({ kind: "regions", regions: next === "region" ? [{ name: "pad", shape: "plate", effects: [{ effect: "texture", spacing_mm: STEP_MM }] }] : [] });
}
