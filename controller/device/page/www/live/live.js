// The live page: what the panel says, drawn; and buttons that ask it to play. The first user of haptic.js.
(() => {
  "use strict";
  const at = (id) => document.getElementById(id);
  const panel = window.HapticPanel;
  const SVG = "http://www.w3.org/2000/svg";
  const ASK_MS = 1000, KEPT_EVENTS = 50, FOCUS_MS = 350, MOST_FOCI = 32, INFO = 6, TESTED_MS = 1500;
  const WORDS = { // state: what it means to somebody who sees the panel for the first time; whether outputs are on
    "waiting for FPGA": ["The controller's FPGA does not answer. Outputs are off, or switch off by themselves.", "bad"],
    "no permit": ["The run permit (interlock) is missing: outputs stay off until it is given.", "bad"],
    faulted: ["The FPGA has switched the outputs off.", "bad"],
    ramping: ["Outputs are on their way: there is still voltage at the actuators.", "off"],
    disarmed: ["Switched off. It stays off until an operator arms it.", "off"],
    "waiting for panel": ["No touch panel answers. Commands are still played.", "off"],
    idle: ["Nothing was touched for a while: outputs are off until the next touch.", "off"],
    playing: ["Outputs are on, and something is felt.", "on"],
    armed: ["Outputs are on. Touch the plate.", "on"],
  };
  const CAUSES = { // of what was due, but not played
    merged: "replaced by newer ones", no_room: "too many waited", lifted: "finger lifted", outputs_off: "outputs off", refused: "refused by the FPGA",
    bad_entries: "not in the bank", unconfirmed: "contact not confirmed", scene_changed: "scene changed",
  };
  const fingers = new Map();
  let plate = null, layerRegions = [], before = null, state = "", drawing = 0, asking = 0;

  const make = (name, attributes, text) => {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (text !== undefined) node.textContent = text;
    return node;
  };
  const up = (y_mm) => plate.width_mm - y_mm; // the plate's y goes up, the screen's down

  // ---- events of the panel
  panel.addEventListener("open", ({ detail }) => {
    plate = detail;
    at("board").textContent = detail.board;
    at("plate-size").textContent = `${detail.length_mm} × ${detail.width_mm} mm`;
    at("drawing").setAttribute("viewBox", `0 0 ${detail.length_mm} ${detail.width_mm}`);
    at("plate").style.aspectRatio = `${detail.length_mm} / ${detail.width_mm}`;
    if (!at("x").value) [at("x").value, at("y").value] = [detail.length_mm / 2, detail.width_mm / 2];
    at("amplitude").max = detail.max_amplitude;
    at("arm").hidden = !panel.rights.includes("operate");
    at("effects").replaceChildren(...detail.effects.map((effect) => {
      const button = document.createElement("button");
      button.textContent = effect;
      button.addEventListener("click", () => playHere(effect));
      return button;
    }));
    const to = ["state", "description", "faults", ...(panel.rights.includes("play") ? ["touches", "emissions"] : []), ...(panel.rights.includes("operate") ? ["log"] : [])];
    at("log").hidden = !to.includes("log");
    at("log-lines").replaceChildren();
    panel.send({ kind: "subscribe", to }).then((answer) => answer.reason && happened(`No touches: ${answer.reason}`));
    happened(`Connected to ${detail.board}, version ${detail.version}.`);
    panel.look();
  });
  panel.addEventListener("close", ({ detail }) => {
    fingers.clear();
    at("foci").replaceChildren();
    before = null;
    show("no panel", detail || "The panel's program does not answer. This page tries again.", "bad");
    redraw();
  });
  panel.addEventListener("layer", ({ detail }) => {
    layerRegions = detail.regions;
    for (const one of detail.answer.refused || []) happened(`Not felt: ${one.name}: ${one.reason}`);
    redraw();
  });
  panel.addEventListener("message", ({ detail }) => {
    if (detail.kind === "state") showState(detail);
    else if (detail.kind === "touch") touched(detail);
    else if (detail.kind === "emissions") played(detail);
    else if (detail.kind === "figures") figures(detail.figures);
    else if (detail.kind === "description") described(detail);
    else if (detail.kind === "log") listed("log-lines", detail.text).classList.toggle("warning", detail.priority < INFO);
    else if (detail.kind === "fault") happened(`${detail.state}: ${detail.cause}`);
    else if (detail.kind === "farewell") happened(`The panel ended the connection: ${detail.reason}`);
  });

  // ---- state
  function showState({ state: word, cause, temperature_c: celsius, panel_present: present, outputs_on: on }) {
    if (!on) stopRepeating();
    const [text, kind] = WORDS[word] || ["", "off"];
    const warm = celsius === null ? "" : ` ${celsius.toFixed(1)} °C.`;
    show(word, `${text}${cause ? ` Cause: ${cause}.` : ""}${present ? "" : " The touch panel is missing."}${warm}`, kind);
  }
  function show(word, text, kind) {
    document.body.dataset.state = kind;
    at("state-word").textContent = word;
    at("state-text").textContent = text;
    const said = [word, kind === "on" ? "" : text].join(" ");
    if (said !== state && !(kind === "on" && /^(armed|playing)/.test(state))) happened(`${word}: ${text}`);
    state = said;
  }
  function happened(text) {
    const time = document.createElement("time");
    time.textContent = new Date().toLocaleTimeString();
    listed("events", time, text);
  }
  function listed(list, ...what) {
    const line = document.createElement("li");
    line.append(...what);
    at(list).prepend(line);
    while (at(list).children.length > KEPT_EVENTS) at(list).lastChild.remove();
    return line;
  }

  // ---- drawing, when something has changed
  function touched(touch) {
    if (touch.contact) fingers.set(touch.finger, touch); else fingers.delete(touch.finger);
    redraw();
  }
  function redraw() { drawing ||= requestAnimationFrame(draw); }
  function draw() {
    drawing = 0;
    if (!plate) return;
    at("fingers").replaceChildren(...[...fingers.values()].map((f) => make("circle", { class: "finger", cx: f.x_mm, cy: up(f.y_mm), r: f.size_mm / 2 || 4 })));
    at("regions").replaceChildren(...layerRegions.filter((one) => one.effects.length).map((one) => outline(one, { class: "region" })));
    const box = at("plate").getBoundingClientRect();
    for (const element of document.querySelectorAll(".felt")) {
      const r = element.getBoundingClientRect();
      element.classList.toggle("under", !element.disabled && [...fingers.values()].some((f) => {
        const x = box.left + (f.x_mm / plate.length_mm) * box.width, y = box.top + (up(f.y_mm) / plate.width_mm) * box.height;
        return x >= r.left && x <= r.right && y >= r.top && y <= r.bottom;
      }));
    }
  }
  function outline(one, attributes) {
    if (one.shape === "rectangle") return make("rect", { ...attributes, x: one.x_mm, y: up(one.y_mm + one.height_mm), width: one.width_mm, height: one.height_mm });
    if (one.shape === "circle") return make("circle", { ...attributes, cx: one.x_mm, cy: up(one.y_mm), r: one.radius_mm });
    if (one.shape === "polygon") return make("polygon", { ...attributes, points: one.corners_mm.map(([x, y]) => `${x},${up(y)}`).join(" ") });
    return make("g", {}); // the whole plate
  }
  function described({ patches, scene, regions, release, faults }) {
    at("scene").textContent = `, scene “${scene}”${release ? `, release ${release}` : ""}`;
    at("scene-regions").replaceChildren(...regions.map(({ name, shape }) => {
      const drawn = outline(shape, { class: "scene-region" });
      drawn.append(make("title", {}, name));
      return drawn;
    }));
    at("patches").replaceChildren(...patches.flatMap(({ channel, x_mm: x, y_mm: y, size_mm: size }) => [
      make("rect", { class: "patch", id: `patch-${channel}`, x: x - size / 2, y: up(y) - size / 2, width: size, height: size }),
      make("text", { class: "patch-number", x, y: up(y) + 1 }, channel),
    ]));
    at("channels").hidden = !panel.rights.includes("operate");
    const before = at("channel").value;
    at("channel").replaceChildren(...patches.map(({ channel }) => new Option(channel, channel, false, String(channel) === before)));
    for (const fault of faults.slice(-3)) happened(`Earlier: ${fault.state}: ${fault.cause}`);
  }
  function played({ foci }) { // as large as the spot that is felt, as thick as it is strong
    let start = 0;
    for (const { time_s, x_mm, y_mm, amplitude, of, period_ms } of foci.slice(-MOST_FOCI)) {
      if (time_s !== start) stopRepeating(); // a new start ends a repetition
      start = time_s;
      const ring = make("circle", { class: period_ms ? "focus repeats" : "focus", cx: x_mm, cy: up(y_mm), r: 2.5, "stroke-width": 0.3 + 1.2 * amplitude });
      ring.append(make("title", {}, `${of}, amplitude ${amplitude}${period_ms ? `, every ${period_ms} ms` : ""}`));
      at("foci").append(ring);
      if (!period_ms) setTimeout(() => ring.remove(), FOCUS_MS);
    }
  }
  function stopRepeating() { for (const ring of at("foci").querySelectorAll(".repeats")) ring.remove(); }

  // ---- figures of the last second: what is counted since the start, less what was a second ago
  function figures(now) {
    if (before && now.heartbeats === before.heartbeats) return; // the same as a second ago: they are renewed once a second
    const last = before;
    before = now;
    if (!last) return;
    const more = (pick) => Math.max(0, (pick(now) ?? 0) - (pick(last) ?? 0));
    const causes = Object.entries(CAUSES).map(([key, words]) => [more((f) => f.skipped?.[key]), words]).filter(([n]) => n);
    const skipped = causes.map(([n, words]) => `${n} ${words}`).join(", ") || 0;
    const rows = {
      "emissions accepted": more((f) => f.emissions), "waveforms uploaded": more((f) => f.uploads), "due, but not played": skipped,
      "outages so far": now.outages, "wire errors so far": Object.entries(now.link_counts || {}).reduce((sum, [key, n]) => sum + (/error|crc|bad|lost/.test(key) && typeof n === "number" ? n : 0), 0),
      "other programs connected": (now.application_socket?.clients_connected ?? 1) - 1,
    };
    at("figures").replaceChildren(...Object.entries(rows).flatMap(([name, value]) => {
      const [term, text] = [document.createElement("dt"), document.createElement("dd")];
      [term.textContent, text.textContent] = [name, String(value)];
      return [term, text];
    }));
    histogram(now.latency_histograms, last.latency_histograms);
  }
  function histogram(now, last) {
    if (!now?.uploads_host) return;
    const more = now.uploads_host.counts.map((n, i) => n - last.uploads_host.counts[i]);
    const bars = more.map((n, i) => n - (more[i - 1] || 0)), most = Math.max(1, ...bars), all = more.at(-1) || 0;
    at("latency").replaceChildren(...bars.map((n, i) => make("rect", { x: i * 20 + 1, y: 60 - 58 * n / most, width: 18, height: 58 * n / most + 1 })));
    const typical = now.bounds_us[more.findIndex((n) => n >= all / 2)];
    at("latency-text").textContent = all ? `${all} uploads; half of them within ${typical} µs. Bars: up to ${now.bounds_us.join(", ")} µs.` : "No upload in the last second.";
  }

  // ---- what the visitor does
  function playHere(effect) {
    const [x_mm, y_mm, amplitude] = ["x", "y", "amplitude"].map((id) => Number(at(id).value));
    panel.send({ kind: "play", effect, x_mm, y_mm, amplitude }).then(({ outcome, reason }) => {
      at("outcome").textContent = reason ? `${effect}: ${outcome}: ${reason}` : `${effect}: ${outcome} at ${x_mm}, ${y_mm} mm`;
    });
  }
  at("chirp").addEventListener("click", () => {
    const channel = Number(at("channel").value), patch = at(`patch-${channel}`);
    panel.send({ kind: "test_channel", channel }).then(({ outcome, reason }) => {
      at("outcome").textContent = reason ? `channel ${channel}: ${outcome}: ${reason}` : `channel ${channel}: ${outcome}: its patch alone has moved`;
      if (outcome === "played") patch.classList.add("tested");
      setTimeout(() => patch.classList.remove("tested"), TESTED_MS);
    });
  });
  at("plate").addEventListener("click", ({ clientX, clientY }) => {
    const place = panel.toPlate(clientX, clientY);
    if (place) [at("x").value, at("y").value] = place.map((mm) => mm.toFixed(1));
  });
  at("stop").addEventListener("pointerdown", stop); // at once, not when the finger is lifted
  at("stop").addEventListener("click", ({ detail }) => detail === 0 && stop()); // by keyboard, or a screen reader
  function stop() {
    panel.stop().then((answer) => happened(answer.outcome === "done" ? "STOP was accepted: outputs ramp down." : `STOP failed: ${answer.reason}. Use the switch of the supply.`));
  }
  at("arm").addEventListener("click", () => at("ask-arm").showModal());
  at("ask-arm").addEventListener("close", () => {
    if (at("ask-arm").returnValue === "yes") panel.send({ kind: "arm" }).then((answer) => answer.reason && happened(`Not armed: ${answer.reason}`));
    at("ask-arm").returnValue = "";
  });
  asking = setInterval(() => !document.hidden && plate && panel.send({ kind: "figures" }), ASK_MS);
  addEventListener("pagehide", () => clearInterval(asking));
})();
