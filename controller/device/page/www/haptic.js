// haptic.js: a page says where its elements are, and the panel's own loop plays them under each finger.
//   <button data-haptic="click 0.5">   button { --haptic: click 0.5 }   <haptic-region data-haptic="texture">
//   HapticPanel.play("click", {x, y} | element | pointerId, amplitude)   HapticPanel.stop()
// controller/device/page/README.md explains it. No dependency; works under `default-src 'self'`.
(() => {
  "use strict";
  if (window.HapticPanel) return;
  // names: begin (python -m controller.generate, from names.toml)
  const NAMES = {
    hint: ["click", 0.4], edge: ["click", 1.0], tick: ["click", 0.3], align: ["click", 0.7],
    EFFECT_CLICK: ["click", 0.7], EFFECT_TICK: ["click", 0.3], EFFECT_HEAVY_CLICK: ["click", 1.0], EFFECT_DOUBLE_CLICK: ["double_click", 0.7],
    KEYBOARD_TAP: ["click", 0.5], CLOCK_TICK: ["click", 0.3], LONG_PRESS: ["click", 1.0], CONFIRM: ["double_click", 0.6],
    REJECT: ["buzz", 1.0], light: ["click", 0.4], medium: ["click", 0.7], heavy: ["click", 1.0],
    soft: ["click", 0.3], rigid: ["click", 0.9], success: ["double_click", 0.8], warning: ["double_click", 1.0],
    error: ["buzz", 1.0], selection: ["click", 0.3],
  };
  // names: end
  const LEAST = 0.1; // amplitude that the panel plays
  const SEND_MS = 40; // between two layers: the panel takes 30 a second
  const SETTLE_MS = 150; // without a scroll event: a scroll is over
  const LOOK_MS = 500; // what no event announces, such as a changed style sheet, is found this late
  const MOST_REGIONS = 250;
  const script = document.currentScript;
  const address = new URL(script?.dataset.panel || "panel", script?.src || location.href);
  address.protocol = address.protocol.replace("http", "ws");
  const panel = new EventTarget();
  let socket, plate, greeting, shown = "", sentAt = 0, timer = 0, frame = 0, still = 0, retry = 0, lastId = 0;
  const waiting = new Map(), ids = new WeakMap(), pointers = new Map(), scrolling = new Map();
  let names = 0, lastPoint = null;

  // ---- the connection
  const tell = (type, detail) => panel.dispatchEvent(new CustomEvent(type, { detail }));
  function connect() {
    socket = new WebSocket(address);
    const own = socket;
    own.onopen = () => { retry = 0; shown = ""; };
    own.onmessage = ({ data }) => receive(JSON.parse(data));
    own.onclose = ({ reason }) => {
      if (own !== socket) return;
      plate = greeting = undefined;
      for (const answer of waiting.values()) answer({ kind: "answer", outcome: "refused", reason: reason || "no panel" });
      waiting.clear();
      tell("close", reason);
      setTimeout(connect, Math.min(10000, 250 * 2 ** retry++) * (0.75 + Math.random() / 2));
    };
  }
  function receive(message) {
    if (message.kind === "page") {
      greeting = message;
      if (plate) look(); // it says where the screen lies by now
      else send({ kind: "hello" }).then((hello) => {
        if (hello.kind !== "hello") return;
        plate = hello;
        tell("open", hello);
        look();
      });
    }
    const answer = waiting.get(message.id);
    waiting.delete(message.id);
    answer?.(message);
    tell("message", message);
  }
  function send(message) {
    return new Promise((answer) => {
      if (socket?.readyState !== 1) return answer({ kind: "answer", outcome: "refused", reason: "no panel" });
      waiting.set(++lastId, answer);
      socket.send(JSON.stringify({ ...message, id: lastId }));
    });
  }

  // ---- where the page lies on the plate: y goes down on a screen, and up on the plate
  function mapping() {
    if (!plate) return null;
    const view = window.visualViewport || { offsetLeft: 0, offsetTop: 0, scale: 1 };
    const drawn = document.querySelector("[data-haptic-plate]");
    if (drawn) {
      const r = drawn.getBoundingClientRect();
      if (!r.width || !r.height) return null;
      const kx = plate.length_mm / r.width, ky = plate.width_mm / r.height;
      return [kx, 0, -r.left * kx, 0, -ky, plate.width_mm + r.top * ky];
    }
    const whole = Math.abs(outerWidth - screen.width) < 2 && Math.abs(outerHeight - screen.height) < 2;
    if (!whole || Math.abs(innerHeight / innerWidth / (outerHeight / outerWidth) - 1) > 0.01) return null; // where is the window?
    const { x_mm_from_pixels: ax, y_mm_from_pixels: ay } = greeting;
    const s = view.scale, ox = -view.offsetLeft * s, oy = -view.offsetTop * s;
    const d = devicePixelRatio, kx = plate.length_mm / innerWidth, ky = plate.width_mm / innerHeight;
    const [a, b, c] = ax ? [ax[0] * d, ax[1] * d, ax[2]] : [kx, 0, 0];
    const [e, f, g] = ay ? [ay[0] * d, ay[1] * d, ay[2]] : [0, -ky, plate.width_mm];
    return [a * s, b * s, a * ox + b * oy + c, e * s, f * s, e * ox + f * oy + g];
  }
  const onto = (m, x, y) => [m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5]];

  // ---- which elements are felt, and how
  const up = (node) => node.assignedSlot || node.parentElement || node.getRootNode().host || null;
  const within = (node, element) => { for (; node; node = up(node)) if (node === element) return true; return false; };
  function* everything(root) {
    for (const element of root.querySelectorAll("*")) {
      yield element;
      if (element.shadowRoot) { observe(element.shadowRoot); yield* everything(element.shadowRoot); }
    }
  }
  function wanted(element, style) {
    const said = element.dataset?.haptic ?? style.getPropertyValue("--haptic").trim();
    if (!said && element.localName !== "haptic-region") return null;
    const words = (said || "click").split(/[\s,]+/).filter(Boolean);
    const share = Number(element.dataset?.hapticAmplitude ?? words.find((word) => !isNaN(word)) ?? 1);
    const when = element.dataset?.hapticOn?.split(/\s+/).filter(Boolean);
    return words.filter((word) => isNaN(word) && word !== "none").map((word) => {
      const [effect, own] = plate.effects.includes(word) || word === "edge" ? [word, 1] : NAMES[word] || [word, 1];
      const amplitude = Math.max(LEAST, Math.min(1, share * own));
      return { effect, ...(amplitude < 1 && { amplitude }), ...(when && { when }) };
    });
  }
  function usable(element, style) {
    return !element.matches(":disabled, [aria-disabled=true]") && style.pointerEvents !== "none" &&
      element.checkVisibility({ opacityProperty: true, visibilityProperty: true, contentVisibilityAuto: true });
  }

  // ---- their outlines: an affine image of a box has its centre where its bounding box has it
  function linear(element, known) {
    if (!element) return new DOMMatrix();
    let m = known.get(element);
    if (m) return m;
    const s = getComputedStyle(element);
    m = linear(up(element), known);
    if (s.rotate && s.rotate !== "none") m = m.multiply(new DOMMatrix(`rotate(${s.rotate})`));
    if (s.scale && s.scale !== "none") m = m.multiply(new DOMMatrix(`scale(${s.scale.replace(" ", ",")})`));
    if (s.transform && s.transform !== "none") m = m.multiply(new DOMMatrix(s.transform));
    known.set(element, m);
    return m;
  }
  function outline(element, known) {
    const r = element.getBoundingClientRect();
    const box = [[r.left, r.top], [r.right, r.top], [r.right, r.bottom], [r.left, r.bottom]];
    const m = linear(element, known);
    if (!m.is2D || (Math.abs(m.b) < 1e-6 && Math.abs(m.c) < 1e-6) || !element.offsetWidth) return box;
    const w = element.offsetWidth / 2, h = element.offsetHeight / 2, x = (r.left + r.right) / 2, y = (r.top + r.bottom) / 2;
    const k = r.width / 2 / (Math.abs(m.a) * w + Math.abs(m.c) * h); // zoom
    return [[-w, -h], [w, -h], [w, h], [-w, h]].map(([p, q]) => [x + k * (m.a * p + m.c * q), y + k * (m.b * p + m.d * q)]);
  }
  function clipped(points, { left, top, right, bottom }) {
    for (const [axis, sign, edge] of [[0, 1, left], [0, -1, right], [1, 1, top], [1, -1, bottom]]) {
      const inside = (p) => sign * (p[axis] - edge) >= 0;
      points = points.flatMap((p, i) => {
        const before = points.at(i - 1);
        if (inside(p) === inside(before)) return inside(p) ? [p] : [];
        const t = (edge - before[axis]) / (p[axis] - before[axis]);
        const cut = [before[0] + t * (p[0] - before[0]), before[1] + t * (p[1] - before[1])];
        return inside(p) ? [cut, p] : [cut];
      });
      if (points.length < 3) return [];
    }
    return points;
  }
  function visiblePart(element, known) {
    let points = clipped(outline(element, known), { left: 0, top: 0, right: innerWidth, bottom: innerHeight });
    for (let around = up(element); around && points.length; around = up(around))
      if (!/visible/.test(getComputedStyle(around).overflow) && around !== document.documentElement && around !== document.body)
        points = clipped(points, content(around));
    return points;
  }
  function content(element) { // the box that clips: within the border
    const r = element.getBoundingClientRect(), k = element.offsetWidth ? r.width / element.offsetWidth : 1;
    const left = r.left + k * element.clientLeft, top = r.top + k * element.clientTop;
    return { left, top, right: left + k * element.clientWidth, bottom: top + k * element.clientHeight };
  }
  function hit(x, y) {
    let found = document.elementFromPoint(x, y), inner;
    while ((inner = found?.shadowRoot?.elementFromPoint(x, y)) && inner !== found) found = inner;
    return found;
  }

  // ---- the layer: what lies on top first, and what covers an element without being felt is a region without effects
  function layer(m) {
    const known = new Map(), found = [], covers = new Set();
    for (const element of everything(document)) {
      const style = getComputedStyle(element);
      const effects = wanted(element, style);
      if (!effects || !usable(element, style) || pausedBy(element)) continue;
      const points = visiblePart(element, known);
      if (points.length) found.push({ element, effects, points });
    }
    const tracked = new Set(found.map((one) => one.element));
    const regions = [];
    for (const one of found) {
      const x = mean(one.points, 0), y = mean(one.points, 1);
      let touched = false;
      for (const [px, py] of [[x, y], ...one.points.map(([p, q]) => [p + (x - p) * 0.1, q + (y - q) * 0.1])]) {
        const top = hit(px, py);
        if (within(top, one.element)) touched = true;
        else if (top && !within(one.element, top) && !inside(top, tracked)) covers.add(top);
      }
      if (touched) regions.push(one);
    }
    for (const element of covers) regions.push({ element, effects: [], points: visiblePart(element, known) });
    return ordered(regions.filter((one) => one.points.length)).slice(0, MOST_REGIONS).map((one) => region(one, m));
  }
  const mean = (points, axis) => points.reduce((sum, p) => sum + p[axis], 0) / points.length;
  const inside = (node, set) => { for (; node; node = up(node)) if (set.has(node)) return true; return false; };
  function bounds(points) {
    const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  }
  function ordered(regions) {
    const result = [];
    for (const one of regions.reverse()) { // later in the document is above, unless a point of both says otherwise
      one.box = bounds(one.points);
      const place = result.findIndex((other) => above(one, other));
      result.splice(place < 0 ? result.length : place, 0, one);
    }
    return result;
  }
  function above(one, other) {
    const [a, b, c, d] = one.box, [e, f, g, h] = other.box;
    const l = Math.max(a, e), t = Math.max(b, f), r = Math.min(c, g), u = Math.min(d, h);
    if (l >= r || t >= u) return false;
    const stack = document.elementsFromPoint((l + r) / 2, (t + u) / 2);
    const first = stack.find((node) => within(node, one.element) || within(node, other.element));
    if (!first) return false;
    if (within(first, one.element) && within(first, other.element)) return within(one.element, other.element);
    return within(first, one.element);
  }
  function region({ element, effects, points }, m) {
    if (!ids.has(element)) ids.set(element, `${(element.id || element.localName).slice(0, 40)} ${++names}`);
    const round = (x) => Math.round(x * 100) / 100;
    const corners = points.map(([x, y]) => onto(m, x, y).map(round)).filter((p, i, all) => i === 0 || String(p) !== String(all[i - 1]));
    const [l, b, r, t] = bounds(corners);
    const name = ids.get(element);
    if (corners.length === 4 && corners.every(([x, y]) => (x === l || x === r) && (y === b || y === t)))
      return { name, shape: "rectangle", x_mm: l, y_mm: b, width_mm: round(r - l), height_mm: round(t - b), effects };
    return { name, shape: "polygon", corners_mm: corners, effects };
  }

  // ---- when to look again
  function look() {
    if (!plate || !greeting.rights.includes("regions")) return;
    const m = document.hidden ? null : mapping();
    const regions = m ? layer(m) : [];
    const text = JSON.stringify(regions);
    still = text === shown ? still + 1 : 0;
    if (text === shown) return;
    const wait = sentAt + SEND_MS - performance.now();
    if (wait > 0) { timer ||= setTimeout(() => { timer = 0; look(); }, wait); return; }
    shown = text;
    sentAt = performance.now();
    send({ kind: "regions", regions }).then((answer) => {
      if (answer.kind !== "layer" && text === shown) shown = ""; // as after `rate`: it is looked at again
      tell("layer", { regions, answer });
    });
  }
  const moving = () => document.getAnimations().some((animation) => animation.playState === "running");
  function soon() {
    still = 0;
    frame ||= requestAnimationFrame(next);
  }
  function next() {
    frame = 0;
    look();
    if (plate && !document.hidden && (moving() || still < 2)) frame = requestAnimationFrame(next);
  }
  function scrolled({ target }) {
    clearTimeout(scrolling.get(target));
    scrolling.set(target, setTimeout(() => settled({ target }), SETTLE_MS));
    soon();
  }
  function settled({ target }) {
    clearTimeout(scrolling.get(target));
    scrolling.delete(target);
    soon();
  }
  function pausedBy(element) { // a region that lags behind its scroll would be felt at the wrong place
    return element.getAttribute("scroll") !== "pan" && [...scrolling.keys()].some((box) => box === document || within(element, box));
  }
  const watcher = new MutationObserver(soon), observed = new WeakSet();
  function observe(root) {
    if (observed.has(root)) return;
    observed.add(root);
    watcher.observe(root, { subtree: true, childList: true, attributes: true });
  }
  function begin() {
    observe(document);
    new ResizeObserver(soon).observe(document.documentElement);
    const events = { scroll: scrolled, scrollend: settled, toggle: soon, load: soon, transitionrun: soon, animationstart: soon, transitionend: soon, animationend: soon, fullscreenchange: soon, visibilitychange: look };
    for (const [type, handler] of Object.entries(events)) document.addEventListener(type, handler, { capture: true, passive: true });
    for (const type of ["resize", "pageshow", "load"]) addEventListener(type, soon);
    for (const type of ["resize", "scroll"]) window.visualViewport?.addEventListener(type, soon);
    addEventListener("pagehide", () => { const own = socket; socket = null; own?.close(); }); // and the layer with it
    addEventListener("pageshow", ({ persisted }) => persisted && connect());
    for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel"])
      addEventListener(type, (event) => {
        lastPoint = { x: event.clientX, y: event.clientY };
        if (type === "pointerdown" || type === "pointermove") pointers.set(event.pointerId, lastPoint);
        else pointers.delete(event.pointerId);
      }, { capture: true, passive: true });
    setInterval(look, LOOK_MS);
    setInterval(() => moving() && soon(), LOOK_MS / 5); // those of scripts send no event
    connect();
  }

  // ---- what a page calls
  function point(where) {
    if (where instanceof Element) {
      const r = where.getBoundingClientRect();
      return { x: (r.left + r.right) / 2, y: (r.top + r.bottom) / 2 };
    }
    return typeof where === "number" ? pointers.get(where) : where;
  }
  /** Play an effect at a place of the page: {x, y} in CSS pixels, an element's centre, a pointer. Resolves to the answer. */
  function play(effect, where = lastPoint, amplitude = 1) {
    const at = point(where), m = mapping();
    if (!at || !m) return Promise.resolve({ kind: "answer", outcome: "refused", reason: m ? "no such place" : "the page's place on the plate is unknown" });
    const [name, own] = NAMES[effect] || [effect, 1];
    const [x_mm, y_mm] = onto(m, at.x, at.y);
    return send({ kind: typeof name === "string" ? "play" : "clip", effect: name, x_mm, y_mm, amplitude: Math.max(LEAST, Math.min(plate.max_amplitude, amplitude * own)) });
  }
  /** As navigator.vibrate: milliseconds on, off, on …, at the point touched last. */
  function vibrate(pattern) {
    let at = 0;
    [pattern].flat().forEach((ms, i) => {
      if (i % 2 === 0 && ms > 0) setTimeout(play, at, ms > 40 ? "buzz" : "click");
      at += ms;
    });
    return true;
  }
  Object.assign(panel, {
    play, vibrate, send, look: soon,
    stop: () => send({ kind: "stop" }),
    toPlate: (x, y) => { const m = mapping(); return m && onto(m, x, y); },
  });
  Object.defineProperties(panel, { plate: { get: () => plate }, rights: { get: () => greeting?.rights || [] } });
  window.HapticPanel = panel;
  try { Object.defineProperty(navigator, "vibrate", { value: vibrate, configurable: true }); } catch { /* another shim was first */ }
  try { CSS.registerProperty({ name: "--haptic", syntax: "*", inherits: false }); } catch { /* registered by the page */ }
  if (!customElements.get("haptic-region")) customElements.define("haptic-region", class extends HTMLElement {});
  if (document.readyState === "loading") addEventListener("DOMContentLoaded", begin); else begin();
})();
