// Pictures over time, shares of bands, the two scales of the first screen.
import { abscissa, cleared, colour, font, nominal, plain, roundUp, say, whole, write } from "./canvas.js";

const traceSeconds = 20;

/** Lowest and highest acceleration over the last seconds, one lane for each place. */
export class TraceChart {
  constructor(canvas) {
    this.canvas = canvas;
    this.events = [];
  }
  add(event) {
    this.events.push(event);
    while (this.events.length && this.events[0].utc < event.utc - traceSeconds - 1)
      this.events.shift();
    if (this.events.length > 1 && this.events[this.events.length - 2].utc > event.utc)
      this.events = [event];  // the source started again
  }
  draw(lanes) {  // [{index, label}]
    if (!this.events.length || !lanes.length)
      return say(this.canvas, "no data yet");
    const c = cleared(this.canvas);
    if (!c)
      return;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    const box = { left: 46, right: width - 4, top: 2, bottom: height - 18 };
    const end = this.events[this.events.length - 1].utc;
    const x = abscissa(c, box, -traceSeconds, 0, "s");
    const tall = (box.bottom - box.top) / lanes.length;
    lanes.forEach((lane, k) => this.lane(c, { ...box, top: box.top + k * tall + 1, bottom: box.top + (k + 1) * tall - 1 }, lane, utc => x(utc - end)));
  }
  lane(c, box, lane, x) {
    let largest = 0;
    for (const event of this.events)
      for (const kind of ["measured", "simulated"])
        for (const value of event[kind][lane.index] || [])
          largest = Math.max(largest, Math.abs(value || 0));
    const scale = roundUp(Math.max(largest, 1e-6)), middle = (box.top + box.bottom) / 2;
    const y = value => middle - value / scale * (box.bottom - box.top) / 2;
    c.strokeStyle = colour("rule");
    c.strokeRect(box.left + 0.5, box.top + 0.5, box.right - box.left - 1, box.bottom - box.top - 1);
    for (const kind of ["measured", "simulated"])
      this.band(c, lane.index, kind, x, y, box);
    c.font = font(12);
    c.fillStyle = colour("soft");
    c.textBaseline = "middle";
    write(c, `±${plain(scale, 2)}`, box.left - 6, middle, "right", 0, box.left - 6);
    c.font = font(13, 600);
    const wide = c.measureText(lane.label).width;
    c.globalAlpha = 0.8;
    c.fillStyle = colour("panel");
    c.fillRect(box.left + 4, box.top + 3, wide + 10, 18);
    c.globalAlpha = 1;
    c.fillStyle = colour("ink");
    c.fillText(lane.label, box.left + 9, box.top + 13);
  }
  // One column for each quarter of an event: what a screen can show.
  band(c, index, kind, x, y, box) {
    c.fillStyle = colour(kind);
    c.globalAlpha = kind === "measured" ? 0.75 : 0.6;
    let previous = null;
    for (const event of this.events) {
      const trace = event[kind][index] || [], pieces = trace.length / 2, from = previous === null || event.utc - previous > 0.5 ? event.utc - 0.05 : previous;
      previous = event.utc;
      for (let q = 0; q < 4 && pieces >= 4; ++q) {
        let low = Infinity, high = -Infinity;
        for (let i = Math.floor(q * pieces / 4); i < Math.floor((q + 1) * pieces / 4); ++i) {
          if (trace[2 * i] === null)
            continue;
          low = Math.min(low, trace[2 * i]);
          high = Math.max(high, trace[2 * i + 1]);
        }
        const left = Math.max(box.left, x(from + (event.utc - from) * q / 4)), right = Math.min(box.right, x(from + (event.utc - from) * (q + 1) / 4));
        if (high >= low && right > left)
          c.fillRect(left, y(high), right - left + 0.3, Math.max(1, y(low) - y(high)));
      }
    }
    c.globalAlpha = 1;
  }
}

/** Consecutive samples of one place. */
export function drawWave(canvas, step, measured, simulated) {
  const n = Math.max(measured.length, simulated.length);
  if (!step || n < 2)
    return say(canvas, "no wave yet");
  const c = cleared(canvas);
  if (!c)
    return;
  const box = { left: 46, right: canvas.clientWidth - 4, top: 6, bottom: canvas.clientHeight - 20 };
  let largest = 1e-9;
  for (const values of [measured, simulated])
    for (const value of values)
      largest = Math.max(largest, Math.abs(value) || 0);
  const scale = roundUp(largest), x = abscissa(c, box, 0, (n - 1) * step * 1000, "ms");
  const y = value => (box.top + box.bottom) / 2 - value / scale * (box.bottom - box.top) / 2;
  c.textBaseline = "middle";
  for (const value of [-scale, 0, scale]) {
    c.strokeStyle = colour("grid");
    c.beginPath();
    c.moveTo(box.left, y(value));
    c.lineTo(box.right, y(value));
    c.stroke();
    c.fillStyle = colour("soft");
    write(c, plain(value, 2), box.left - 6, Math.max(box.top + 6, Math.min(box.bottom - 6, y(value))), "right", 0, box.left - 6);
  }
  for (const [values, name] of [[measured, "measured"], [simulated, "simulated"]]) {
    c.strokeStyle = colour(name);
    c.lineWidth = 1.5;
    c.beginPath();
    values.forEach((value, i) => { if (isFinite(value)) c.lineTo(x(i * step * 1000), y(value)); });
    c.stroke();
  }
  c.lineWidth = 1;
}

/** Share of the measured that the twin does not explain, third octave by third octave. */
export function drawShares(canvas, bands) {
  if (!bands.length)
    return say(canvas, "needs a measured place");
  const c = cleared(canvas);
  if (!c)
    return;
  const box = { left: 42, right: canvas.clientWidth - 4, top: 8, bottom: canvas.clientHeight - 20 };
  const wide = (box.right - box.left) / bands.length;
  c.font = font(12);
  c.textBaseline = "middle";
  for (const share of [0, 0.5, 1]) {
    const y = box.bottom - share * (box.bottom - box.top);
    c.fillStyle = colour("grid");
    c.fillRect(box.left, y, box.right - box.left, 1);
    c.fillStyle = colour("soft");
    write(c, `${share * 100} %`, box.left - 6, y, "right", 0, box.left - 6);
  }
  c.textBaseline = "alphabetic";
  let free = -Infinity;
  bands.forEach(([frequency, share], k) => {
    const x = box.left + k * wide, tall = Math.max(0, Math.min(1, share || 0)) * (box.bottom - box.top);
    c.fillStyle = colour(share > 0.5 ? "bad" : share > 0.2 ? "fair" : "good");
    if (share !== null)
      c.fillRect(x + wide * 0.12, box.bottom - tall, wide * 0.76, Math.max(1, tall));
    c.fillStyle = colour("soft");
    const text = nominal(frequency), half = c.measureText(text).width / 2, middle = x + wide / 2;
    if (middle - half > free && middle + half < box.right - 22)
      free = write(c, text, middle, box.bottom + 15, "center", box.left - 20, box.right)[1] + 8;
  });
  write(c, "Hz", box.right, box.bottom + 15, "right", 0, box.right);
}

/** Level over the calm level, the last ten minutes; `points` [{utc, ratio}]. */
export function drawLevel(canvas, points, alarm) {
  const c = cleared(canvas);
  if (!c)
    return;
  const box = { left: 0, right: canvas.clientWidth - 66, top: 3, bottom: canvas.clientHeight - 3 };
  const top = alarm * 1.15, y = ratio => box.bottom - Math.min(1, ratio / top) * (box.bottom - box.top);
  for (const [from, to, name] of [[0, 2, "good-wash"], [2, alarm, "fair-wash"], [alarm, top, "bad-wash"]]) {
    c.fillStyle = colour(name);
    c.fillRect(box.left, y(to), box.right - box.left, y(from) - y(to));
  }
  c.font = font(12);
  c.textBaseline = "middle";
  for (const [ratio, text] of [[alarm, `alarm ${whole(alarm)} ×`], [1, "calm"]]) {
    c.fillStyle = colour(ratio === 1 ? "soft" : "bad");
    c.fillRect(box.left, y(ratio), box.right - box.left, 1);
    c.fillText(text, box.right + 6, Math.min(box.bottom - 6, Math.max(7, y(ratio))));
  }
  if (!points.length)
    return;
  const end = points[points.length - 1].utc, x = utc => box.right - 4 - (end - utc) / 600 * (box.right - box.left - 4);
  c.strokeStyle = c.fillStyle = colour("ink");
  c.lineWidth = 2;
  c.lineJoin = "round";
  c.beginPath();
  let previous = null;
  for (const point of points) {
    if (previous !== null && point.utc - previous < 5)
      c.lineTo(x(point.utc), y(point.ratio));
    else
      c.moveTo(x(point.utc), y(point.ratio));
    previous = point.utc;
  }
  c.stroke();
  c.beginPath();
  c.arc(x(end), y(points[points.length - 1].ratio), 4.5, 0, 7);
  c.fill();
  c.lineWidth = 1;
}

/** Speed of the mill on a scale that ends beyond the critical speed. */
export function drawSpeeds(canvas, chatter) {
  const c = cleared(canvas);
  if (!c)
    return;
  if (!(chatter.critical > 0) || chatter.speed === null)
    return;
  const low = chatter.low || chatter.critical, high = chatter.high || chatter.critical;
  const end = Math.max(high, chatter.speed) * 1.12;
  const box = { left: 8, right: canvas.clientWidth - 8, top: 20, bottom: canvas.clientHeight - 20 };
  const x = speed => box.left + speed / end * (box.right - box.left);
  const fade = c.createLinearGradient(x(low), 0, x(high) + 1, 0);
  fade.addColorStop(0, colour("fair"));
  fade.addColorStop(1, colour("bad"));
  for (const [from, to, fill] of [[0, low, colour("good")], [low, high, fade], [high, end, colour("bad")]]) {
    c.fillStyle = fill;
    c.fillRect(x(from), box.top, Math.max(0, x(to) - x(from)), box.bottom - box.top);
  }
  c.fillStyle = colour("ink");
  c.fillRect(x(chatter.critical) - 1.5, box.top - 4, 3, box.bottom - box.top + 8);
  c.font = font(13, 600);
  c.textBaseline = "alphabetic";
  const taken = write(c, `critical ${plain(chatter.critical)} m/s`, x(chatter.critical), box.bottom + 16, "center", 0, box.right + 8);
  const text = `now ${plain(chatter.speed)} m/s`, wide = c.measureText(text).width;
  const room = x(chatter.speed) + wide / 2 < taken[0] - 8 || x(chatter.speed) - wide / 2 > taken[1] + 8;
  write(c, text, x(chatter.speed) - (room ? 0 : 14), room ? box.bottom + 16 : 13, room ? "center" : "right", 0, box.right + 8);
  c.beginPath();
  c.moveTo(x(chatter.speed), box.bottom - 4);
  c.lineTo(x(chatter.speed) - 10, box.top - 8);
  c.lineTo(x(chatter.speed) + 10, box.top - 8);
  c.closePath();
  c.fill();
  c.strokeStyle = colour("panel");
  c.lineWidth = 2;
  c.stroke();
  c.lineWidth = 1;
}
