// Spectrum and waterfall.
import { abscissa, cleared, colour, font, plain, say, write } from "./canvas.js";

/** Highest resonance between two frequencies: 1/S is a parabola of f about it, fitted over its width, so that the
    scatter of single points averages out.  `values` root of the density. */
export function highestPeak(values, df, low, high) {
  const smooth = i => { let sum = 0; for (let k = i - 3; k <= i + 3; ++k) sum += (values[k] || 0) ** 2; return sum / 7; };
  let best = -1;
  for (let i = Math.max(4, Math.ceil(low / df)); i < values.length - 4 && i * df <= high; ++i)
    if (best < 0 || smooth(i) > smooth(best))
      best = i;
  if (best < 0 || !(smooth(best) > 0))
    return null;
  const top = smooth(best), edge = step => { let n = 0; while (n < 40 && smooth(best + n * step) > 0.4 * top) ++n; return n; };
  const half = Math.max(3, Math.min(edge(1), edge(-1), best - 1));
  const sums = [0, 0, 0, 0, 0], right = [0, 0, 0];  // of x^0 .. x^4, of y x^0 .. y x^2, weights S^2
  for (let x = -half; x <= half; ++x) {
    const density = smooth(best + x) / top || 1e-12;
    for (let p = 0; p < 5; ++p)
      sums[p] += density ** 2 * x ** p;
    for (let p = 0; p < 3; ++p)
      right[p] += density * x ** p;
  }
  // Cramer's rule for c0 + c1 x + c2 x^2; only c1/c2 is asked for.
  const [s0, s1, s2, s3, s4] = sums, [r0, r1, r2] = right;
  const c1 = s0 * (r1 * s4 - r2 * s3) - r0 * (s1 * s4 - s2 * s3) + s2 * (s1 * r2 - s2 * r1);
  const c2 = s0 * (s2 * r2 - s3 * r1) - s1 * (s1 * r2 - s2 * r1) + r0 * (s1 * s3 - s2 * s2);
  const all = s0 * (s2 * s4 - s3 * s3) - s1 * (s1 * s4 - s2 * s3) + s2 * (s1 * s3 - s2 * s2);
  const shift = c2 / all > 0 ? Math.max(-half, Math.min(half, -0.5 * c1 / c2)) : 0;
  return { frequency: (best + shift) * df, value: Math.sqrt(top) };
}

/** Measured and simulated density over frequency, with the modes of the twin. */
export class SpectrumChart {
  constructor(canvas) {
    this.canvas = canvas;
    this.range = null;  // [low, high] Hz, null: all
    this.pointer = null;
    this.modes = [];
    canvas.addEventListener("pointermove", event => { this.move(event); });
    canvas.addEventListener("pointerdown", event => { this.held = { x: event.offsetX, range: this.shown() }; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointerup", () => { this.held = null; });
    canvas.addEventListener("pointerleave", () => { this.pointer = null; this.draw(); });
    canvas.addEventListener("dblclick", () => { this.range = null; this.changed(); });
    canvas.addEventListener("wheel", event => { event.preventDefault(); this.zoom(event.deltaY > 0 ? 1.25 : 0.8, this.frequencyAt(event.offsetX)); }, { passive: false });
    canvas.addEventListener("keydown", event => { this.key(event); });
  }
  changed() {
    this.draw();
    if (this.onRange)
      this.onRange();
  }
  set(data) {
    this.data = data;
    this.draw();
  }
  full() {
    const n = this.data ? Math.max(this.data.measured.length, this.data.simulated.length) : 2;
    return this.data ? this.data.df * (n - 1) : 1000;
  }
  shown() {
    return this.range || [0, this.full()];
  }
  frequencyAt(x) {
    const [low, high] = this.shown();
    return low + (x - this.box.left) / (this.box.right - this.box.left) * (high - low);
  }
  zoom(factor, centre) {
    const [low, high] = this.shown(), full = this.full();
    const width = Math.max(20, Math.min(full, (high - low) * factor));
    const from = Math.max(0, Math.min(full - width, centre - (centre - low) / (high - low) * width));
    this.range = width >= full ? null : [from, from + width];
    this.changed();
  }
  shift(amount) {
    const [low, high] = this.shown(), width = high - low;
    const from = Math.max(0, Math.min(this.full() - width, low + amount));
    this.range = this.range && [from, from + width];
    this.changed();
  }
  move(event) {
    if (this.held && this.box) {
      const [low, high] = this.held.range;
      this.range = [low, high];
      this.shift((this.held.x - event.offsetX) / (this.box.right - this.box.left) * (high - low));
    }
    this.pointer = event.offsetX;
    this.draw();
  }
  key(event) {
    const [low, high] = this.shown(), middle = (low + high) / 2;
    const does = {
      ArrowLeft: () => this.shift((low - high) / 8), ArrowRight: () => this.shift((high - low) / 8),
      "+": () => this.zoom(0.8, middle), "-": () => this.zoom(1.25, middle), Home: () => { this.range = null; this.changed(); },
    }[event.key];
    if (does) {
      event.preventDefault();
      event.stopPropagation();
      does();
    }
  }
  draw() {
    if (!this.data)
      return say(this.canvas, "no spectrum yet");
    const c = cleared(this.canvas);
    if (!c)
      return;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    const box = this.box = { left: 46, right: width - 4, top: 18, bottom: height - 20 };
    const [low, high] = this.shown(), { measured, simulated, df } = this.data;
    const largest = Math.max(this.largest(measured, low, high), this.largest(simulated, low, high));
    const top = Math.ceil(Math.log10(Math.max(largest, 1e-12)) * 2 + 0.2) / 2, bottom = top - 4;
    const x = abscissa(c, box, low, high, "Hz");
    const y = value => box.bottom - Math.max(0, (Math.log10(Math.max(value, 1e-30)) - bottom) / (top - bottom)) * (box.bottom - box.top);
    this.decades(c, box, bottom, top, y);
    this.modeLines(c, box, x, low, high);
    c.save();
    c.beginPath();
    c.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    c.clip();
    this.curve(c, measured, df, x, y, low, high, "measured", 1.6);
    this.curve(c, simulated, df, x, y, low, high, "simulated", 1.6);
    c.restore();
    this.readOff(c, box, x, y, low, high);
    const peak = highestPeak(simulated, df, low, high), other = highestPeak(measured, df, low, high);
    this.canvas.dataset.peakSimulated = peak ? peak.frequency.toFixed(3) : "";
    this.canvas.dataset.peakMeasured = other ? other.frequency.toFixed(3) : "";
    this.canvas.dataset.df = df;
  }
  largest(values, low, high) {
    let out = 0;
    for (let i = Math.max(1, Math.floor(low / this.data.df)); i < values.length && i * this.data.df <= high; ++i)
      out = Math.max(out, values[i]);
    return out;
  }
  decades(c, box, bottom, top, y) {
    c.font = font(12);
    c.textBaseline = "middle";
    for (let power = Math.ceil(bottom); power <= top; ++power) {
      c.strokeStyle = colour("grid");
      c.beginPath();
      c.moveTo(box.left, y(10 ** power));
      c.lineTo(box.right, y(10 ** power));
      c.stroke();
      c.fillStyle = colour("soft");
      write(c, power >= -2 && power <= 3 ? plain(10 ** power, 1) : `1e${power}`.replace("-", "−"), box.left - 6, y(10 ** power), "right", 0, box.left - 6);
    }
  }
  modeLines(c, box, x, low, high) {
    c.font = font(12, 600);
    c.textBaseline = "alphabetic";
    c.setLineDash([4, 4]);
    let free = -Infinity;
    for (const frequency of this.modes) {
      if (frequency < low || frequency > high)
        continue;
      c.strokeStyle = c.fillStyle = colour("mode");
      c.beginPath();
      c.moveTo(x(frequency), box.top);
      c.lineTo(x(frequency), box.bottom);
      c.stroke();
      const text = plain(frequency, 4);
      if (x(frequency) - c.measureText(text).width / 2 > free)
        free = write(c, text, x(frequency), box.top - 5, "center", box.left, box.right)[1] + 8;
    }
    c.setLineDash([]);
  }
  curve(c, values, df, x, y, low, high, name, width) {
    c.strokeStyle = colour(name);
    c.lineWidth = width;
    c.lineJoin = "round";
    c.beginPath();
    for (let i = Math.max(1, Math.floor(low / df)); i < values.length && (i - 1) * df <= high; ++i)
      c.lineTo(x(i * df), y(values[i]));
    c.stroke();
    c.lineWidth = 1;
  }
  readOff(c, box, x, y, low, high) {
    if (this.pointer === null || this.pointer < box.left || this.pointer > box.right)
      return;
    const { measured, simulated, df } = this.data, i = Math.round(this.frequencyAt(this.pointer) / df);
    if (i < 0 || i * df > high || i * df < low)
      return;
    c.strokeStyle = colour("soft");
    c.beginPath();
    c.moveTo(x(i * df), box.top);
    c.lineTo(x(i * df), box.bottom);
    c.stroke();
    const parts = [[`${plain(i * df, 4)} Hz`, "ink"]];
    if (i < measured.length)
      parts.push([plain(measured[i]), "measured"]);
    if (i < simulated.length)
      parts.push([plain(simulated[i]), "simulated"]);
    c.font = font(13, 600);
    c.textBaseline = "middle";
    const all = parts.map(p => p[0]).join("   "), wide = c.measureText(all).width + 16;
    let at = Math.min(x(i * df) + 8, box.right - wide);
    c.fillStyle = colour("panel");
    c.fillRect(at, box.top + 4, wide, 22);
    at += 8;
    for (const [text, name] of parts) {
      c.fillStyle = colour(name);
      c.fillText(text, at, box.top + 15);
      at += c.measureText(text + "   ").width;
    }
  }
}

const waterfallRows = 240, waterfallRange = 3;  // rows: 60 s at 4 Hz; decades of colour

/** Spectra below each other, the newest on top. */
export class Waterfall {
  constructor(canvas) {
    this.canvas = canvas;
    this.sheet = document.createElement("canvas");
    this.rows = [];
  }
  add(values, df, utc) {
    if (this.df !== df || (this.rows.length && this.rows[0].values.length !== values.length))
      this.rows = [];
    this.df = df;
    this.rows.unshift({ values, utc });
    this.rows.length = Math.min(this.rows.length, waterfallRows);
    this.paint();
  }
  clear() {
    this.rows = [];
  }
  paint() {
    if (!this.rows.length || !this.canvas.clientWidth)
      return;
    const n = this.rows[0].values.length;
    let largest = 1e-12;
    for (const row of this.rows)
      for (let i = 2; i < n; ++i)
        largest = Math.max(largest, row.values[i]);
    const top = Math.ceil(Math.log10(largest) * 4) / 4;
    // All rows again when the scale or the colours change, else the newest alone under the others.
    const sketch = this.sheet.getContext("2d", { willReadFrequently: true }), key = `${n} ${top} ${colour("heat-4")}`;
    if (this.key !== key) {
      this.key = key;
      this.shades = shades();
      this.sheet.width = n;
      this.sheet.height = waterfallRows;
      this.rows.forEach((row, k) => sketch.putImageData(this.line(row.values, top), 0, k));
      this.painted = this.rows[0];
    } else if (this.painted !== this.rows[0]) {
      sketch.drawImage(this.sheet, 0, 1);
      sketch.putImageData(this.line(this.rows[0].values, top), 0, 0);
      this.painted = this.rows[0];
    }
    this.top = top;
  }
  line(values, top) {
    const image = new ImageData(values.length, 1);
    for (let i = 0; i < values.length; ++i) {
      const share = 1 + (Math.log10(Math.max(values[i], 1e-30)) - top) / waterfallRange;
      image.data.set(this.shades[Math.max(0, Math.min(255, Math.round(share * 255)))], 4 * i);
    }
    return image;
  }
  draw(range, modes) {
    if (!this.rows.length)
      return say(this.canvas, "no spectrum yet");
    this.paint();
    const c = cleared(this.canvas);
    if (!c)
      return;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight, n = this.rows[0].values.length;
    const box = { left: 46, right: width - 4, top: 4, bottom: height - 20 };
    const [low, high] = range || [0, this.df * (n - 1)];
    c.fillStyle = colour("heat-0");
    c.fillRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    c.imageSmoothingEnabled = false;
    const shown = Math.max(1, high / this.df - low / this.df);
    c.drawImage(this.sheet, low / this.df, 0, shown, waterfallRows, box.left, box.top, box.right - box.left, box.bottom - box.top);
    const x = abscissa(c, { ...box, top: box.bottom - 4 }, low, high, "Hz");
    c.fillStyle = colour("soft");
    c.textBaseline = "middle";
    for (const seconds of [0, 20, 40])
      write(c, `${seconds} s`, box.left - 6, box.top + 8 + seconds / 60 * (box.bottom - box.top), "right", 0, box.left - 6);
    c.fillStyle = colour("mode");
    for (const frequency of modes)
      if (frequency >= low && frequency <= high)
        c.fillRect(x(frequency) - 1, box.bottom - 7, 2, 7);
  }
}

// 256 colours between the five of the style sheet.
function shades() {
  const stops = [0, 1, 2, 3, 4].map(k => rgb(colour(`heat-${k}`)));
  return Array.from({ length: 256 }, (_, i) => {
    const place = i / 255 * 4, k = Math.min(3, Math.floor(place)), part = place - k;
    return [0, 1, 2].map(j => stops[k][j] * (1 - part) + stops[k + 1][j] * part).concat(255);
  });
}

function rgb(text) {
  const numbers = text.match(/[\d.]+/g).map(Number);
  return text.startsWith("color(") ? numbers.slice(0, 3).map(v => v * 255) : numbers.slice(0, 3);
}
