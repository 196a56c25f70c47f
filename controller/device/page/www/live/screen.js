// Four crosses are touched; the panel says where, and a least-squares fit where each pixel of the screen lies on the plate.
(() => {
  "use strict";
  const at = (id) => document.getElementById(id);
  const panel = window.HapticPanel;
  const CROSSES = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]]; // shares of width and height
  const STILL_MM = 3, FIT_MM = 1.5; // a finger that slips; a cross that was missed
  const down = new Map(); // fingers: where they were reported; null: down before it began
  let taps = [], place = null, step = -1;

  const say = (text) => { at("say").textContent = text; };
  function show(next) {
    step = next;
    document.body.dataset.step = step < 0 ? "start" : step < CROSSES.length ? "tap" : "done";
    if (step < 0 || step >= CROSSES.length) return;
    const [x, y] = cross();
    at("cross").dataset.number = step + 1;
    [at("cross").style.left, at("cross").style.top] = [`${x}px`, `${y}px`];
    say(`Touch cross ${step + 1} of ${CROSSES.length}, and lift the finger.`);
  }
  const cross = () => [CROSSES[step][0] * innerWidth, CROSSES[step][1] * innerHeight];

  panel.addEventListener("open", () => {
    panel.send({ kind: "subscribe" }).then((answer) => {
      const may = panel.rights.includes("screen");
      at("begin").disabled = !may || Boolean(answer.reason);
      if (answer.reason) say(answer.reason);
      else if (!may) say("The bridge's settings do not give this page the right 'screen': add it to its line below [origins].");
    });
  });
  panel.addEventListener("close", ({ detail }) => { show(-1); at("begin").disabled = true; say(detail || "The panel's program does not answer."); });
  panel.addEventListener("message", ({ detail }) => {
    if (detail.kind !== "touch") return;
    const { finger, x_mm, y_mm, contact } = detail;
    if (contact) {
      if (!down.has(finger)) down.set(finger, []);
      down.get(finger)?.push([x_mm, y_mm]);
    } else if (down.has(finger)) {
      const reports = down.get(finger);
      down.delete(finger);
      if (reports && step >= 0 && step < CROSSES.length && down.size === 0) tapped(reports);
    }
    if (place) dots();
  });

  function tapped(reports) {
    const mean = [0, 1].map((axis) => reports.reduce((sum, one) => sum + one[axis], 0) / reports.length);
    if (reports.some((one) => Math.hypot(one[0] - mean[0], one[1] - mean[1]) > STILL_MM)) return say("The finger slipped: touch this cross again.");
    taps.push([...cross(), ...mean]);
    if (taps.length < CROSSES.length) return show(taps.length);
    const { x, y, worst } = fit(taps);
    const ratio = devicePixelRatio;
    if (worst > FIT_MM) {
      taps = [];
      show(0);
      return say(`These touches do not fit together: a cross is ${worst.toFixed(1)} mm off. Again, from cross 1.`);
    }
    place = { x, y, message: { x_mm_from_pixels: [x[0] / ratio, x[1] / ratio, x[2]], y_mm_from_pixels: [y[0] / ratio, y[1] / ratio, y[2]] } };
    show(CROSSES.length);
    at("keep").hidden = false;
    say(`Found: each cross is within ${worst.toFixed(2)} mm. Touch the screen: a circle has to follow each finger. Then keep it.`);
  }

  // x = a u + b v + c of pixels (u, v), and so y: normal equations, by Cramer's rule
  function fit(points) {
    const n = points.length, mean = (i) => points.reduce((sum, p) => sum + p[i], 0) / n;
    const means = [0, 1, 2, 3].map(mean);
    const s = (i, j) => points.reduce((sum, p) => sum + (p[i] - means[i]) * (p[j] - means[j]), 0);
    const [uu, uv, vv] = [s(0, 0), s(0, 1), s(1, 1)], det = uu * vv - uv * uv;
    const row = (k) => {
      const a = (s(0, k) * vv - s(1, k) * uv) / det, b = (s(1, k) * uu - s(0, k) * uv) / det;
      return [a, b, means[k] - a * means[0] - b * means[1]];
    };
    const [x, y] = [row(2), row(3)];
    const off = points.map(([u, v, px, py]) => Math.hypot(x[0] * u + x[1] * v + x[2] - px, y[0] * u + y[1] * v + y[2] - py));
    return { x, y, worst: Math.max(...off) };
  }
  function dots() {
    const { x, y } = place, det = x[0] * y[1] - x[1] * y[0];
    at("dots").replaceChildren(...[...down.values()].filter(Boolean).map((reports) => {
      const [px, py] = reports.at(-1), dot = document.createElement("div");
      const [dx, dy] = [px - x[2], py - y[2]];
      dot.className = "dot";
      dot.style.left = `${(dx * y[1] - dy * x[1]) / det}px`;
      dot.style.top = `${(dy * x[0] - dx * y[0]) / det}px`;
      return dot;
    }));
  }

  function begin() {
    [taps, place] = [[], null];
    at("keep").hidden = true;
    at("dots").replaceChildren();
    for (const finger of down.keys()) down.set(finger, null);
    show(0);
  }
  at("begin").addEventListener("click", async () => {
    try { await document.documentElement.requestFullscreen(); } catch { /* a kiosk's window covers the screen already */ }
    begin();
  });
  addEventListener("resize", () => step >= 0 && begin());
  at("keep").addEventListener("click", async () => {
    const answer = await panel.send({ kind: "screen", ...place.message });
    say(answer.reason ? `Not kept: ${answer.reason}` : "Kept. All pages of this bridge follow it from now on.");
    at("keep").hidden = !answer.reason;
  });
})();
