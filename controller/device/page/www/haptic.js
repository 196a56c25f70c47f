// A page describes its elements, the panel's loop plays them: README.md
(() => {
  "use strict";
  if (window.HapticPanel) return;
  const RETRY_MS = 1000, SEND_MS = 40;
  const SETTLE_MS = 100;
  const LOOK_MS = 500;
  const panel = new EventTarget(), roots = new Set(), names = new WeakMap();
  const waiting = new Map(), scrolling = new Map(), pointers = new Map();
  const address = document.currentScript?.src || location;
  let socket, stopper, greeting, plate, lastPoint, known, shown, sentAt = 0, frame = 0, last = 0, changed, order = [];
  let root = window; // describes its frames, too
  try { while (root.parent !== root && root.parent.document) root = root.parent; } catch {}

  // ---- the connection
  const refused = (reason) => ({ kind: "answer", outcome: "refused", reason });
  function tell(type, detail, to = roots) {
    for (const { defaultView } of to)
      if (defaultView) Object.assign(defaultView.HapticPanel, greeting, { plate }).dispatchEvent(new CustomEvent(type, { detail }));
  }
  function connect() {
    [socket, stopper] = ["panel", "stop"].map((way) => new WebSocket(new URL(way, address)));
    stopper.onmessage = socket.onmessage = ({ data }) => receive(JSON.parse(data));
    stopper.onopen = () => { stopper.onclose = () => socket.close(); };
    socket.onclose = ({ reason }) => {
      waiting.forEach((answer) => answer(refused(reason || "no panel")));
      waiting.clear();
      stopper.onclose = stopper.close();
      plate = shown = "";
      tell("close", reason);
      setTimeout(connect, RETRY_MS);
    };
  }
  async function receive(message) {
    if (message.kind === "page") greeting = message;
    tell("message", message);
    waiting.get(message.id)?.(message);
    waiting.delete(message.id);
    if (greeting !== message) return;
    const hello = plate || await send({ kind: "hello" });
    if (hello.kind !== "hello") return;
    if (!plate) tell("open", plate = hello);
    soon();
  }
  async function send(message) {
    if (root !== window) return root.HapticPanel?.send(message) ?? refused("no panel");
    if (socket?.readyState !== 1) return refused("no panel");
    (message.kind === "stop" && stopper.readyState === 1 ? stopper : socket).send(JSON.stringify({ ...message, id: ++last }));
    return new Promise((answer) => waiting.set(last, answer));
  }

  // ---- places, in CSS pixels of the outermost page
  const up = (node) => node.assignedSlot || node.parentNode || node.host || node.defaultView?.frameElement;
  const nearest = (node, is) => { while (node && !is(node)) node = up(node); return node; };
  const inside = (element) => element.shadowRoot || element.contentDocument;
  const once = (key, matrix) => known.get(key) || known.set(key, matrix()).get(key);
  const linear = (node) => once(node, () => {
    if (node.nodeType === 9) return new DOMMatrix();
    if (node.nodeType !== 1) return linear(up(node));
    const { rotate, scale, transform } = getComputedStyle(node);
    return linear(up(node)).rotate(parseFloat(rotate) || 0).scale(...scale.split(" ").map((x) => parseFloat(x) || 1)).multiply(new DOMMatrix(transform));
  });
  const whole = ({ frameElement, innerWidth, innerHeight }) => frameElement ? inner(frameElement) : new DOMMatrix().scale(innerWidth, innerHeight);
  function viewport(node) {
    const view = (node.ownerDocument || node).defaultView;
    return once(view, () => whole(view).scale(1 / view.innerWidth, 1 / view.innerHeight));
  }
  function outer(element) { // from the unit square to its box
    const { left, top, width, height } = element.getBoundingClientRect(), { offsetWidth: w, offsetHeight: h } = element;
    const { a, b, c, d } = linear(element), zoom = width / (Math.abs(a * w) + Math.abs(c * h));
    const sides = w && (b || c) ? [a * w, b * w, c * h, d * h].map((x) => x * zoom) : [width, 0, 0, height];
    return viewport(element).multiply(new DOMMatrix([...sides, left + width / 2, top + height / 2])).translate(-0.5, -0.5);
  }
  function inner(element) {
    const { offsetWidth: w, offsetHeight: h, clientLeft, clientTop, clientWidth, clientHeight } = element;
    return outer(element).translate(clientLeft / w, clientTop / h).scale(clientWidth / w, clientHeight / h);
  }
  const place = (m, [x, y]) => (({ x, y }) => [x, y])(m.transformPoint({ x, y }));
  const corners = (m) => [[0, 0], [1, 0], [1, 1], [0, 1]].map((p) => place(m, p));
  function clipped(points, by) {
    by.forEach(([x, y], i) => {
      const [u, v] = by.at(i - 1), side = ([p, q]) => (x - u) * (q - v) - (y - v) * (p - u), sign = Math.sign(side(by.at(i - 2)));
      points = points.flatMap((p, j) => {
        const q = points.at(j - 1), s = sign * side(p), t = sign * side(q);
        return [...(s < 0 === t < 0 ? [] : [toward(q, p, t / (t - s))]), ...(s < 0 ? [] : [p])];
      });
    });
    return points;
  }
  const toward = (p, q, share) => p.map((x, i) => x + share * (q[i] - x));
  const mean = (points) => [0, 1].map((i) => points.reduce((sum, p) => sum + p[i], 0) / points.length);
  function visible(element) {
    let points = corners(outer(element));
    for (let node = up(element); node; node = up(node)) {
      if (node.nodeType === 9) points = clipped(points, corners(whole(node.defaultView)));
      else if (node.nodeType === 1 && !/^(html|body)$/.test(node.localName) && getComputedStyle(node).overflow !== "visible") points = clipped(points, corners(inner(node)));
    }
    return points;
  }
  function* stack(point, root = document) { // the uppermost first
    for (const ask of ["elementFromPoint", "elementsFromPoint"])
      for (const node of [root[ask](...place(viewport(root).inverse(), point))].flat()) {
        if (node?.getRootNode() !== root) continue;
        if (inside(node)) yield* stack(point, inside(node));
        yield node;
      }
  }
  function mapping() { // to mm
    const { x_mm_from_pixels: x, y_mm_from_pixels: y } = panel, { offsetLeft, offsetTop, scale } = visualViewport;
    const drawn = document.querySelector("[data-haptic-plate]")?.getBoundingClientRect();
    const { left, top, width, height } = drawn || new DOMRect(offsetLeft, offsetTop, innerWidth / scale, innerHeight / scale);
    if (!plate || !(drawn ? width * height : window === window.top && matchMedia("(display-mode: fullscreen)").matches)) return null;
    if (!drawn && x) return new DOMMatrix(x.flatMap((k, i) => [k, y[i]])).scale(devicePixelRatio * scale).translate(-left, -top);
    return new DOMMatrix([plate.length_mm / width, 0, 0, -plate.width_mm / height, 0, plate.width_mm]).translate(-left, -top);
  }

  // ---- the layer
  const named = (word) => !panel.plate.effects.includes(word) && panel.names[word] || [word, 1];
  const amplified = (x) => Math.max(0.1, Math.min(panel.plate.max_amplitude, x));
  const shows = (element) => element.checkVisibility({ opacityProperty: true, visibilityProperty: true });
  function wanted(element) {
    const style = getComputedStyle(element), { haptic, hapticAmplitude, hapticOn } = element.dataset || {};
    const said = haptic ?? style.getPropertyValue("--haptic"), disabled = element.matches(":disabled, [aria-disabled=true], [aria-disabled=true] *");
    if (!said && !disabled && element.localName !== "haptic-region" || style.pointerEvents === "none") return null;
    if (element.getAttribute("scroll") !== "pan" && nearest(element, (node) => scrolling.has(node))) return null;
    if (disabled || !shows(element)) return [];
    const words = (said || "click").split(/[\s,]+/), when = hapticOn?.match(/\w+/g) || undefined;
    return words.filter((word) => isNaN(word) && word !== "none").map((word) => {
      const [effect, own] = word === "edge" ? [word, 1] : named(word);
      const amplitude = amplified(own * (hapticAmplitude || words.find((word) => word > 0) || 1));
      return { effect, amplitude: amplitude < 1 ? amplitude : undefined, when };
    });
  }
  function* everything(tree) {
    attend(tree);
    for (const element of tree.querySelectorAll("*")) {
      yield element;
      const tree = inside(element);
      if (tree && (tree.host || tree.defaultView.HapticPanel) && shows(element)) yield* everything(tree);
    }
  }
  function ordered() {
    const found = new Map(), result = [];
    const put = (element, one) => found.set(element, { part: element, over: new Set(), ...one, element }).get(element);
    const felt = (node) => nearest(node, (one) => found.has(one));
    roots.clear();
    for (const element of everything(document)) {
      const effects = wanted(element), points = effects ? visible(element) : [];
      if (!points.length) continue;
      found.get(felt(element))?.over.add(element);
      put(element, { effects, points });
    }
    for (const one of found.values()) {
      const middle = mean(one.points), around = (other) => nearest(one.element, (node) => node === other);
      for (const corner of [middle, ...one.points]) {
        const p = toward(corner, middle, 0.1), over = [];
        for (const node of stack(p)) {
          const part = felt(node), hit = part && (part === one.element || !around(part)) ? part : node;
          if (hit === one.element) {
            one.touched = true;
            over.forEach((other) => one.over.add(other));
          }
          if (around(hit)) break;
          if (clipped([p], visible(hit)).length) over.push(hit);
        }
      }
    }
    const append = (element) => {
      const one = found.get(element) || put(element, { effects: [], ...found.get(felt(element)), points: visible(element), over: [], touched: true });
      if (!one.touched) return;
      one.touched = false;
      one.over.forEach(append);
      result.push(one);
    };
    [...found.keys()].reverse().forEach(append);
    return result;
  }
  function region({ element, part, effects }, m) {
    if (!names.has(element)) names.set(element, `${(part.id || part.localName).slice(0, 40)} ${++last}`);
    const name = names.get(element), round = (x) => Math.round(x * 100) / 100;
    const corners_mm = visible(element).map((p) => place(m, p).map(round)).filter((p, i, all) => String(p) !== String(all.at(i - 1)));
    const [[l, r, ...xs], [b, t, ...ys]] = [0, 1].map((axis) => [...new Set(corners_mm.map((p) => p[axis]))].sort((p, q) => p - q));
    if (corners_mm.length < 3) return [];
    if (corners_mm.length > 4 || xs.length || ys.length) return { name, shape: "polygon", corners_mm, effects };
    return { name, shape: "rectangle", x_mm: l, y_mm: b, width_mm: round(r - l), height_mm: round(t - b), effects };
  }

  // ---- when to look
  function look() {
    if (!plate || !panel.rights.includes("regions")) return false;
    const now = performance.now(), m = !document.hidden && mapping();
    if (!document.hidden && now < sentAt + SEND_MS) return true;
    for (const [box, at] of scrolling) if (now > at + SETTLE_MS) changed = scrolling.delete(box);
    known = new Map();
    if (m && changed) changed = !(order = ordered());
    const regions = m ? order.flatMap((one) => region(one, m)).slice(0, 250) : [], text = JSON.stringify(regions);
    if (text === shown) return moving() || scrolling.size;
    shown = text;
    sentAt = now;
    send({ kind: "regions", regions }).then((answer) => {
      if (answer.kind !== "layer") shown = "";
      tell("layer", { regions, answer });
    });
    return true;
  }
  const moving = () => [...roots].some((root) => root.getAnimations().some((one) => one.playState === "running"));
  function soon() {
    changed = true;
    again();
  }
  function again() {
    if (root !== window) root.HapticPanel?.look();
    else frame ||= requestAnimationFrame(() => {
      frame = 0;
      if (look()) again();
    });
  }
  function happened({ type, target }) {
    if (type === "scroll") scrolling.set(target, performance.now());
    soon();
  }
  const watcher = new MutationObserver(soon);
  function attend(tree) {
    roots.add(tree);
    watcher.observe(tree, { subtree: true, childList: true, attributes: true });
    for (const type of ["scroll", "load", "toggle", "transitionrun", "animationstart"]) tree.addEventListener(type, happened, true);
    if (plate && tree.defaultView?.HapticPanel.plate === undefined) tell("open", plate, [tree]);
  }
  function begin() {
    attend(document);
    document.addEventListener("visibilitychange", look);
    for (const type of ["resize", "scroll"]) visualViewport.addEventListener(type, soon);
    addEventListener("pagehide", () => socket.close());
    setInterval(soon, LOOK_MS);
    setInterval(() => moving() && again(), LOOK_MS / 5);
    connect();
  }

  // ---- calls
  function toPlate(x, y) {
    known = new Map();
    const p = place(viewport(document), [x, y]), m = mapping();
    return root === window ? m && place(m, p) : root.HapticPanel?.toPlate(...p);
  }
  async function play(effect, where = lastPoint, amplitude = 1) {
    const { x, y, width = 0, height = 0 } = where?.getBoundingClientRect?.() || pointers.get(where) || where || {};
    if (isNaN(x)) return refused("no such place");
    const found = toPlate(x + width / 2, y + height / 2);
    if (!found) return refused("the page's place on the plate is unknown");
    const [x_mm, y_mm] = found, [name, own] = named(effect);
    return send({ kind: name.at ? "play" : "clip", effect: name, x_mm, y_mm, amplitude: amplified(amplitude * own) });
  }
  navigator.vibrate = (pattern) => {
    [pattern].flat().reduce((at, ms, i) => {
      if (ms && i % 2 === 0) setTimeout(play, at, ms > 40 ? "buzz" : "click");
      return at + ms;
    }, 0);
    return true;
  };
  for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel"])
    addEventListener(type, ({ clientX, clientY, pointerId }) => {
      pointers.set(pointerId, lastPoint = { x: clientX, y: clientY });
      if (/up|cancel/.test(type)) pointers.delete(pointerId);
    }, true);
  window.HapticPanel = Object.assign(panel, { play, send, toPlate, look: soon, stop: () => send({ kind: "stop" }), rights: [] });
  try { CSS.registerProperty({ name: "--haptic", syntax: "*", inherits: false }); } catch {}
  if (root === window) document.readyState === "loading" ? addEventListener("DOMContentLoaded", begin) : begin();
})();
