// Buttons that calibrate the touch panel, with progress and result: the bridge runs `haptic-panel calibrate-touch --socket` for them.
(() => {
  "use strict";
  const at = (id) => document.getElementById(id);
  const panel = window.HapticPanel;
  const SVG = "http://www.w3.org/2000/svg";
  const fingers = new Map();
  let plate = null, running = "";

  const make = (name, attributes) => {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    return node;
  };
  const say = (words) => { at("say").textContent = words; };
  function show() {
    const may = panel.rights.includes("operate");
    for (const what of ["axes", "ghosts", "lag"]) at(what).disabled = Boolean(running) || !may || !plate;
    at("cancel").hidden = !running;
  }

  panel.addEventListener("open", ({ detail }) => {
    plate = detail;
    at("drawing").setAttribute("viewBox", `0 0 ${plate.length_mm} ${plate.width_mm}`);
    at("plate").style.aspectRatio = `${plate.length_mm} / ${plate.width_mm}`;
    panel.send({ kind: "subscribe", to: ["state", ...(panel.rights.includes("play") ? ["touches"] : [])] });
    if (!panel.rights.includes("operate")) say("Calibrating is for operators: the bridge's settings do not give this page the right 'operate'.");
    show();
  });
  panel.addEventListener("close", ({ detail }) => {
    [plate, running] = [null, ""];
    fingers.clear();
    at("state").textContent = detail || "The panel's program does not answer. This page tries again.";
    show();
  });
  panel.addEventListener("message", ({ detail }) => {
    if (detail.kind === "state") at("state").textContent = `${plate?.board ?? ""}: ${detail.state}${detail.cause ? `, ${detail.cause}` : ""}`;
    else if (detail.kind === "touch") touched(detail);
    else if (detail.kind === "calibration") told(detail);
  });
  function touched(touch) {
    if (touch.contact) fingers.set(touch.finger, touch); else fingers.delete(touch.finger);
    at("fingers").replaceChildren(...[...fingers.values()].map(({ x_mm, y_mm }) => make("circle", { class: "finger", cx: x_mm, cy: plate.width_mm - y_mm, r: 4 })));
  }

  // ---- a calibration
  function told({ say: words, step, of, at_mm, lines, words: result }) {
    if (words !== undefined) {
      say(words);
      [at("progress").max, at("progress").value] = [of, step];
      target(at_mm);
    }
    if (!lines) return;
    at("result").hidden = false;
    at("lines").textContent = lines.join("\n");
    at("words").replaceChildren(...result.map((line) => Object.assign(document.createElement("li"), { textContent: line })));
  }
  function target(at_mm) {
    if (!at_mm) return at("target").replaceChildren();
    const [x, y] = [at_mm[0], plate.width_mm - at_mm[1]];
    at("target").replaceChildren(make("path", { d: `M${x - 6} ${y}h12M${x} ${y - 6}v12` }), make("circle", { cx: x, cy: y, r: 3 }));
  }
  async function begin(what, more = {}) {
    running = what;
    at("result").hidden = true;
    at("progress").value = 0;
    say("It begins…");
    show();
    const answer = await panel.send({ kind: "calibrate", what, ...more });
    running = "";
    target(null);
    say(answer.reason ? `Not calibrated: ${answer.reason}` : "Done.");
    if (!answer.reason) at("progress").value = at("progress").max;
    show();
  }
  at("axes").addEventListener("click", () => {
    const rows = at("targets").value.split("\n").map((row) => row.trim()).filter(Boolean);
    const at_mm = rows.map((row) => row.split(/[\s;]+/).map(Number));
    const wrong = at_mm.findIndex((place) => place.length !== 2 || place.some((mm) => !Number.isFinite(mm)));
    if (wrong >= 0) return say(`“${rows[wrong]}” is no place: give x and y in mm, with a space between, as in “20 30.5”.`);
    begin("axes", at_mm.length ? { at_mm } : {});
  });
  at("ghosts").addEventListener("click", () => begin("ghosts"));

  // ---- the lag: steps of a mouse, with the browser's times of them
  const BATCH_MS = 50;
  let steps = [], answered = null;
  addEventListener("pointermove", (event) => {
    if (running !== "lag" || event.pointerType !== "mouse") return;
    const all = event.getCoalescedEvents?.() ?? [];
    for (const one of all.length ? all : [event]) steps.push([one.timeStamp, one.movementX, one.movementY]);
  });
  async function send() {
    const batch = { kind: "mouse", sent_ms: performance.now(), steps: steps.splice(0, 300), answered };
    const { time_s } = await panel.send(batch);
    if (time_s !== undefined) answered = [time_s, performance.now()];
  }
  at("lag").addEventListener("click", async () => {
    const page = document.documentElement;
    await page.requestPointerLock({ unadjustedMovement: true })?.catch(() => page.requestPointerLock())?.catch(() => {}); // without it: until the screen's edge
    [steps, answered] = [[], null];
    const sends = setInterval(send, BATCH_MS);
    await begin("lag");
    clearInterval(sends);
    document.exitPointerLock();
  });
  at("cancel").addEventListener("click", () => panel.send({ kind: "cancel" }));
  at("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(`${at("lines").textContent}\n`);
      say("Copied.");
    } catch { // not in every context
      getSelection().selectAllChildren(at("lines"));
      say("Not copied by the browser: the lines are selected, copy them by its menu.");
    }
  });
  at("stop").addEventListener("pointerdown", stop);
  addEventListener("pointerdown", () => { // of a mouse that reaches no button
    if (!document.pointerLockElement) return;
    document.exitPointerLock();
    stop();
  });
  at("stop").addEventListener("click", ({ detail }) => detail === 0 && stop());
  function stop() {
    panel.stop().then((answer) => say(answer.outcome === "done" ? "STOP was accepted: outputs ramp down." : `STOP failed: ${answer.reason}. Use the switch of the supply.`));
  }
})();
