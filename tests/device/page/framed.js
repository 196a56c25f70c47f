"use strict";
// Elements are named after their frame; what its panel reports is kept, and sent to the page around, which may be of another origin.
document.querySelectorAll("button").forEach((one, i) => { one.id = `${location.search.slice(1)}-${i}`; });
var told = [];
addEventListener("DOMContentLoaded", () => {
  for (const type of ["open", "close", "layer"])
    HapticPanel.addEventListener(type, async ({ detail }) => {
      told.push(type);
      const outcome = type === "layer" && (await HapticPanel.play("click", { x: 20, y: 20 })).reason;
      parent.postMessage({ type, outcome, regions: detail?.regions?.length }, "*");
    });
});
