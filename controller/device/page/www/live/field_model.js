// The plate model in a browser: what `haptic-panel focus` computes for a point, from the modes in a field file (field_file.py).
const MAGIC = "HPfield1", TYPES = { int8: Int8Array, uint16: Uint16Array, float32: Float32Array };
const AFTER_S = 0.4e-3, FINEST = 240; // points of the grid along the longer side

export class FieldModel {
  constructor(buffer) {
    const bytes = new Uint8Array(buffer), start = MAGIC.length + 4;
    if (String.fromCharCode(...bytes.subarray(0, MAGIC.length)) !== MAGIC) throw new Error("this is no field file of this version");
    const end = start + new DataView(buffer).getUint32(MAGIC.length, true);
    Object.assign(this, JSON.parse(new TextDecoder().decode(bytes.subarray(start, end))));
    for (const [name, { type, offset, count }] of Object.entries(this.sections)) this[name] = new TYPES[type](buffer, end + offset, count);
    this.idle_words ??= [this.idle_word]; // of each FPGA
    this.frames = this.samples + Math.round(AFTER_S / this.bit_period_s); // frame n: the end of bit n
    const step_m = Math.max(this.length_m, this.width_m) / FINEST;
    [this.columns, this.rows] = [this.length_m, this.width_m].map((extent_m) => Math.max(2, Math.round(extent_m / step_m)));
    this.along_x = sines(this.half_waves_x, this.length_m, centres(this.columns, this.length_m));
    this.along_y = sines(this.half_waves_y, this.width_m, centres(this.rows, this.width_m));
  }

  time_s(frame) { return (frame + 1 - this.samples) * this.bit_period_s; } // from T, the end of the emission

  shapes(x_m, y_m) {
    const [x, y] = [sines(this.half_waves_x, this.length_m, [x_m]), sines(this.half_waves_y, this.width_m, [y_m])];
    return Float64Array.from(this.half_waves_x, (m, k) => x.of[m] * y.of[this.half_waves_y[k]]);
  }

  // Bits of the emission that focuses on a point: the sign of its responses reversed in time. A sample has a word for each FPGA;
  // bit q of the first is of channel q, of the next of channel 32 + q.
  words(x_m, y_m) {
    const { samples, modes, response, response_scale, forces, idle_words } = this, fpgas = idle_words.length, shape = this.shapes(x_m, y_m);
    const words = new Uint32Array(samples * fpgas), sum = new Float32Array(samples);
    for (let q = 0; q < 32 * fpgas; q++) {
      sum.fill(0);
      for (let k = 0; k < modes; k++) {
        const weight = shape[k] * forces[q * modes + k] * response_scale[k];
        for (let j = 0, at = k * samples; j < samples; j++) sum[j] += weight * response[at + j];
      }
      for (let j = 0; j < samples; j++) {
        const value = sum[samples - 1 - j], bit = value === 0 ? (idle_words[q >> 5] >>> q) & 1 : Number(value > 0);
        words[j * fpgas + (q >> 5)] |= bit << q; // shifts are modulo 32
      }
    }
    return words;
  }

  // Displacement of each mode at the end of each bit, in m from rest at the idle word, which follows the emission: [frame * modes + mode].
  play(words) {
    const { modes, frames, forces, idle_words, term_mode, term_turn, term_residue } = this, terms = term_mode.length;
    const found = new Float32Array(frames * modes), pushed = new Float64Array(modes), level = new Float64Array(modes);
    const re = new Float64Array(terms), im = new Float64Array(terms);
    const fpgas = idle_words.length;
    let before = idle_words;
    for (let frame = 0; frame < frames; frame++) {
      const now = frame < this.samples ? words.subarray(frame * fpgas, (frame + 1) * fpgas) : idle_words;
      pushed.fill(0);
      for (let q = 0; q < 32 * fpgas; q++) {
        const high = (now[q >> 5] >>> q) & 1;
        if (high === ((before[q >> 5] >>> q) & 1)) continue;
        const volts = high ? this.supply_v : -this.supply_v;
        for (let k = 0, at = q * modes; k < modes; k++) pushed[k] += forces[at + k] * volts;
      }
      before = now;
      const out = found.subarray(frame * modes, (frame + 1) * modes);
      for (let k = 0; k < modes; k++) out[k] = (level[k] += pushed[k] * this.static[k]);
      for (let t = 0; t < terms; t++) { // a step at the start of the bit is a bit old at its end
        const k = term_mode[t], a = re[t] + pushed[k], b = im[t], c = term_turn[2 * t], d = term_turn[2 * t + 1];
        re[t] = a * c - b * d;
        im[t] = a * d + b * c;
        out[k] += term_residue[2 * t] * re[t] - term_residue[2 * t + 1] * im[t];
      }
    }
    return found;
  }

  // Displacement of a point in m at all frames.
  history(played, x_m, y_m) {
    const shape = this.shapes(x_m, y_m), found = new Float64Array(this.frames);
    for (let frame = 0, at = 0; frame < this.frames; frame++) for (let k = 0; k < this.modes; k++) found[frame] += shape[k] * played[at++];
    return found;
  }

  // Displacement in m at a frame on the grid, row by row from y = 0 on; the sum over modes goes along x first.
  map(played, frame) {
    const { columns, rows, along_x, along_y, modes } = this;
    const by_y = new Float32Array(along_y.orders * columns), found = new Float32Array(rows * columns);
    for (let k = 0; k < modes; k++) {
      const amplitude = played[frame * modes + k], to = this.half_waves_y[k] * columns, from = this.half_waves_x[k] * columns;
      for (let i = 0; i < columns; i++) by_y[to + i] += amplitude * along_x.of[from + i];
    }
    for (let n = 0; n < along_y.orders; n++)
      for (let j = 0; j < rows; j++) {
        const factor = along_y.of[n * rows + j];
        for (let i = 0; i < columns; i++) found[j * columns + i] += factor * by_y[n * columns + i];
      }
    return found;
  }

  // Root mean square in m of a map farther than `outside_m` from a point: what the focus stands out of.
  background(map, x_m, y_m) {
    const xs = centres(this.columns, this.length_m), ys = centres(this.rows, this.width_m);
    let sum = 0, count = 0;
    for (let j = 0; j < this.rows; j++)
      for (let i = 0; i < this.columns; i++)
        if (Math.hypot(xs[i] - x_m, ys[j] - y_m) > this.outside_m) [sum, count] = [sum + map[j * this.columns + i] ** 2, count + 1];
    return Math.sqrt(sum / count);
  }
}

const centres = (count, extent_m) => Array.from({ length: count }, (_, i) => ((i + 0.5) * extent_m) / count);

// sin(m pi x / extent) of all orders m up to the highest: [m * places + place]
function sines(half_waves, extent_m, places_m) {
  const orders = half_waves.reduce((most, m) => Math.max(most, m), 0) + 1, of = new Float32Array(orders * places_m.length);
  for (let m = 0; m < orders; m++) for (let i = 0; i < places_m.length; i++) of[m * places_m.length + i] = Math.sin((m * Math.PI * places_m[i]) / extent_m);
  return { orders, of };
}
