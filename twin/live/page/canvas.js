// What every canvas of the page needs: colours and fonts of the style sheet, size in CSS pixels, axes, numbers.

const names = ["paper", "panel", "ink", "soft", "rule", "grid", "measured", "simulated", "mode", "good", "fair", "bad",
  "good-wash", "fair-wash", "bad-wash", "steel", "steel-bright", "steel-edge", "frame", "strip",
  "heat-0", "heat-1", "heat-2", "heat-3", "heat-4"];
const known = {};
let family = "sans-serif";

/** Colours of the style sheet as the theme has them now. */
export function readColours() {
  const probe = document.createElement("span");
  document.body.append(probe);
  for (const name of names) {
    probe.style.color = `var(--${name})`;
    known[name] = getComputedStyle(probe).color;
  }
  probe.remove();
  family = getComputedStyle(document.body).fontFamily;
}

export const colour = name => known[name];
export const font = (size, weight = 400) => `${weight} ${size}px ${family}`;

/** Context of a canvas in CSS pixels, cleared; null while it is not shown. */
export function cleared(canvas) {
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (!width || !height)
    return null;
  const scale = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
  }
  const c = canvas.getContext("2d");
  c.setTransform(scale, 0, 0, scale, 0, 0);
  c.clearRect(0, 0, width, height);
  return c;
}

/** 1, 2 or 5 times a power of ten, not below `value`. */
export function round125(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find(step => step * power >= value * 0.9999) * power;
}

/** A little above `value`: for the end of a scale. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find(step => step * power >= value) * power;
}

/** The name of a third octave: 1258.9 -> 1250 */
export function nominal(frequency) {
  const series = [1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8, 10], power = 10 ** Math.floor(Math.log10(frequency));
  const distance = value => Math.abs(Math.log(frequency / (value * power)));
  return String(Number((series.reduce((best, value) => distance(value) < distance(best) ? value : best) * power).toPrecision(3)));
}

/** Whole multiples of a round step from `low` to `high`, some `count` of them. */
export function ticks(low, high, count) {
  const step = round125((high - low) / Math.max(1, count)), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; ++k)
    out.push(k * step);
  return out;
}

export function plain(value, digits = 3) {
  if (value === null || value === undefined || !isFinite(value))
    return "–";
  if (value === 0)
    return "0";
  const before = Math.floor(Math.log10(Math.abs(value))) + 1;
  return value.toFixed(Math.max(0, Math.min(9, digits - before))).replace("-", "−");
}

/** "5" and not "5.0" */
export const whole = value => plain(value, 2).replace(/\.0+$/, "");

/** Text that stays inside [left, right]. */
export function write(c, text, x, y, align, left, right) {
  const width = c.measureText(text).width;
  let from = align === "center" ? x - width / 2 : align === "right" ? x - width : x;
  from = Math.max(left, Math.min(from, right - width));
  c.textAlign = "left";
  c.fillText(text, from, y);
  return [from, from + width];
}

/** A picture without data: a sentence in the middle of the picture. */
export function say(canvas, text) {
  const c = cleared(canvas);
  if (!c)
    return;
  c.font = font(14);
  c.fillStyle = colour("soft");
  c.textBaseline = "middle";
  write(c, text, canvas.clientWidth / 2, canvas.clientHeight / 2, "center", 0, canvas.clientWidth);
}

export function floats(base64) {
  const bytes = Uint8Array.from(atob(base64), letter => letter.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

/** Grid lines and numbers of the abscissa; returns the function from value to pixel. */
export function abscissa(c, box, low, high, unit, labels = true) {
  const at = value => box.left + (value - low) / (high - low) * (box.right - box.left);
  c.font = font(12);
  c.textBaseline = "alphabetic";
  c.lineWidth = 1;
  let free = -Infinity;
  for (const tick of ticks(low, high, (box.right - box.left) / 80)) {
    c.strokeStyle = colour("grid");
    c.beginPath();
    c.moveTo(at(tick), box.top);
    c.lineTo(at(tick), box.bottom);
    c.stroke();
    if (!labels)
      continue;
    c.fillStyle = colour("soft");
    const text = plain(tick, 4).replace(/\.0+$/, ""), width = c.measureText(text).width;
    if (at(tick) - width / 2 > free && at(tick) + width / 2 < box.right - 20)
      free = write(c, text, at(tick), box.bottom + 15, "center", 0, box.right)[1] + 6;
  }
  if (labels)
    write(c, unit, box.right, box.bottom + 15, "right", 0, box.right);
  return at;
}
