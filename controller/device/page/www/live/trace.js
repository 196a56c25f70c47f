// A trace of the loop as a picture: turns, host, wire and plate over each other, the late pulses marked; and the same as a table and in words.
(() => {
  "use strict";
  const at = (id) => document.getElementById(id);
  const panel = window.HapticPanel;
  const SVG = "http://www.w3.org/2000/svg";
  const LATE_US = 2000, FIRST_US = 200e3, LEAST_US = 200, LOOK_MS = 1000, ROWS = 100;
  const LANES = [[1, "turns"], [2, "host"], [3, "wire"], [4, "waits"], [5, "plate"]];
  const LANE_PX = 32, TOP_PX = 20, TICK_PX = 90;
  let files = [], wanted = "", text = "", file = null, lanes = new Map(), late = [], end_us = 1, from_us = 0, to_us = 1, drawing = 0;

  const make = (name, attributes, content) => {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (content !== undefined) node.textContent = content;
    return node;
  };
  const say = (words) => { at("state").textContent = words; };
  const ms = (us, digits = 3) => (us / 1000).toLocaleString("en", { minimumFractionDigits: digits, maximumFractionDigits: digits });

  // ---- the files
  panel.addEventListener("open", () => {
    const may = panel.rights.includes("operate");
    at("write").disabled = !may;
    say(may ? "" : "Traces are for operators: the bridge's settings do not give this page the right 'operate'.");
    if (may) look();
  });
  panel.addEventListener("close", ({ detail }) => say(detail || "The panel's program does not answer. This page tries again."));
  async function look() {
    const answer = await panel.send({ kind: "traces" });
    if (answer.kind !== "traces") return;
    const newest = answer.files[0]?.written ?? "";
    if (JSON.stringify(files) !== JSON.stringify(answer.files)) {
      files = answer.files;
      at("files").replaceChildren(...files.map(({ name, written }) => new Option(`${name}, ${new Date(Number(written) / 1e6).toLocaleTimeString()}`, written)));
      if (file) at("files").value = file.written;
    }
    if (newest && newest !== wanted && (!file || wanted !== "")) read(files[0]);
    else if (!files.length && !file) say("No trace has been written yet.");
  }
  at("write").addEventListener("click", async () => {
    wanted = files[0]?.written ?? "none";
    const answer = await panel.send({ kind: "trace" });
    say(answer.reason ? `No trace: ${answer.reason}` : "A trace is being written, in the loop's spare time…");
    if (answer.reason) wanted = "";
  });
  at("files").addEventListener("change", () => read(files.find((one) => one.written === at("files").value)));
  async function read(next) {
    wanted = "";
    file = next;
    at("download").disabled = true;
    let read_text = "";
    do {
      const part = await panel.send({ kind: "read_trace", name: next.name, written: next.written, offset: read_text.length });
      if (file !== next) return; // another one was chosen meanwhile
      if (part.kind !== "trace_part") { file = null; return say(`Not read: ${part.reason}`); }
      read_text += part.text;
      if (!part.text) break;
      say(`Reading ${next.name}: ${Math.round(100 * read_text.length / part.bytes)} %`);
    } while (read_text.length < next.bytes);
    text = read_text;
    at("files").value = next.written;
    at("download").disabled = false;
    show(JSON.parse(text));
    at("words").replaceChildren();
    const words = await panel.send({ kind: "explain_trace", name: next.name });
    if (file === next) at("words").replaceChildren(...(words.lines || [`Not explained: ${words.reason}`]).map((line) => Object.assign(document.createElement("li"), { textContent: line })));
  }
  at("download").addEventListener("click", () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
    link.download = file.name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });

  // ---- the picture
  const isLate = ({ args }) => args.pulse && args.late_us > LATE_US;
  function show({ traceEvents, otherData }) {
    lanes = new Map(LANES.map(([track]) => [track, []]));
    for (const event of traceEvents) if (event.ph === "X") lanes.get(event.tid)?.push(event);
    for (const events of lanes.values()) events.sort((a, b) => a.ts - b.ts);
    late = lanes.get(5).filter(isLate);
    end_us = Math.max(1, ...[...lanes.values()].map((events) => events.at(-1)).filter(Boolean).map((last) => last.ts + last.dur));
    at("reason").textContent = `written because: ${otherData.reason}`;
    say(`${file.name}: ${(end_us / 1e6).toFixed(1)} s, ${lanes.get(5).length} emissions, ${late.length} pulses more than 2 ms late.`);
    const latest = late.reduce((worst, one) => (!worst || one.args.late_us > worst.args.late_us ? one : worst), null);
    if (latest) around(latest);
    else go(end_us - FIRST_US, end_us);
  }
  function around({ args, ts, dur }) {
    const margin = Math.max(args.late_us, 5000);
    go(args.due_us - margin, ts + dur + margin);
  }
  function go(from, to) {
    const span = Math.min(Math.max(to - from, LEAST_US), end_us);
    from_us = Math.min(Math.max((from + to - span) / 2, 0), end_us - span);
    to_us = from_us + span;
    drawing ||= requestAnimationFrame(draw);
  }
  function within(events) { // those that reach into the window; sorted, and none overlaps another
    let low = 0, high = events.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (events[middle].ts + events[middle].dur < from_us) low = middle + 1; else high = middle;
    }
    const found = [];
    for (; low < events.length && events[low].ts <= to_us; low++) found.push(events[low]);
    return found;
  }
  function draw() {
    drawing = 0;
    const width = at("timeline").clientWidth, x = (us) => ((us - from_us) / (to_us - from_us)) * width;
    const drawn = [...ticks(x, width / TICK_PX)];
    LANES.forEach(([track], lane) => {
      let painted = -1;
      for (const event of within(lanes.get(track) || [])) {
        const left = x(event.ts), right = Math.max(x(event.ts + event.dur), left + 1), marked = isLate(event);
        if (right <= painted && !marked) continue; // another one has this pixel
        painted = Math.max(right, painted);
        const y = TOP_PX + lane * LANE_PX;
        const box = make("rect", { class: `event lane-${track}${marked ? " late" : ""}`, x: left, y: y + 6, width: right - left, height: LANE_PX - 12 });
        box.append(make("title", {}, `${event.name}: ${ms(event.ts)} ms, for ${ms(event.dur)} ms${marked ? `, ${ms(event.args.late_us, 1)} ms late` : ""}`));
        drawn.push(box);
        if (marked) drawn.push(make("line", { class: "delay", x1: x(event.args.due_us), x2: left, y1: y + 3, y2: y + 3 }));
      }
    });
    at("timeline").replaceChildren(...drawn);
    at("shown").textContent = `${ms(from_us, 1)} to ${ms(to_us, 1)} ms of ${ms(end_us, 0)} ms`;
    table(within(lanes.get(5) || []));
  }
  function* ticks(x, most) {
    const rough = (to_us - from_us) / most, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find((n) => n * power >= rough) * power;
    for (let at_us = Math.ceil(from_us / step) * step; at_us <= to_us; at_us += step) {
      yield make("line", { class: "tick", x1: x(at_us), x2: x(at_us), y1: 0, y2: TOP_PX + LANES.length * LANE_PX });
      yield make("text", { x: x(at_us) + 3, y: 13 }, `${ms(at_us, step < 1000 ? 1 : 0)} ms`);
    }
  }
  function table(emissions) {
    at("rows").replaceChildren(...emissions.slice(0, ROWS).map((event) => {
      const { due_us, late_us, ready_us, decide_us, frame_us, wire_us, pulse, resident, foci } = event.args;
      const row = document.createElement("tr"), what = `${pulse ? "pulse of a train" : "emission"}, ${resident ? "resident" : "uploaded"}${foci > 1 ? `, ${foci} foci` : ""}`;
      row.classList.toggle("late", Boolean(isLate(event)));
      const cells = [event.ts, due_us, late_us, decide_us + frame_us, wire_us, Math.max(event.ts - ready_us, 0)].map((us) => `${ms(us)} ms`);
      row.append(...[...cells, what].map((content) => Object.assign(document.createElement("td"), { textContent: content })));
      return row;
    }));
    at("more").textContent = emissions.length > ROWS ? `The first ${ROWS} of ${emissions.length}: zoom in for the others.` : emissions.length ? "" : "None in this window.";
  }

  // ---- by buttons and keys
  const MOVES = {
    earlier: (span) => go(from_us - span / 2, to_us - span / 2), later: (span) => go(from_us + span / 2, to_us + span / 2),
    in: (span) => go(from_us + span / 4, to_us - span / 4), out: (span) => go(from_us - span / 2, to_us + span / 2),
    whole: () => go(0, end_us),
    late: () => late.length && around(late.find(({ args, ts, dur }) => (Math.max(args.due_us, 0) + ts + dur) / 2 > (from_us + to_us) / 2 + 1) || late[0]),
  };
  const KEYS = { ArrowLeft: "earlier", ArrowRight: "later", "+": "in", "=": "in", "-": "out", "−": "out", Home: "whole", l: "late", L: "late" };
  const move = (name) => file && MOVES[name](to_us - from_us);
  at("moves").addEventListener("click", ({ target }) => target.dataset.move && move(target.dataset.move));
  at("timeline").addEventListener("keydown", (event) => {
    if (!KEYS[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move(KEYS[event.key]);
  });
  at("names").replaceChildren(...LANES.map(([, name]) => Object.assign(document.createElement("li"), { textContent: name })));
  new ResizeObserver(() => file && (drawing ||= requestAnimationFrame(draw))).observe(at("timeline"));
  setInterval(() => !document.hidden && panel.rights?.includes("operate") && look(), LOOK_MS);
})();
