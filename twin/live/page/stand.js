// The stand to scale with its moving masses, the chain of springs, and the level of each mass.
import { cleared, colour, font, plain, round125, roundUp, write } from "./canvas.js";

const comfortable = 11, least = 3, most = 24;  // px: largest motion on the screen that is chosen, and may stay

/** Sizes (m) of what is drawn for each place, from the pass line up; rolls as seen along their axes. */
function layout(stand) {
  const parts = stand.places.filter(place => place.drawn !== false).map((place, index) => {
    const roll = place.diameter > 0 || /roll/.test(place.place);
    // Without a drawing: a solid steel cylinder as long as wide, of the mass of the place.
    const diameter = place.diameter || Math.cbrt(4 * Math.max(place.mass || 0, 100) / (Math.PI * 7850));
    return { index, roll, radius: diameter / 2, place };
  });
  const rolls = parts.filter(part => part.roll);
  const largest = Math.max(0.3, ...parts.map(part => part.radius));
  const half = Math.ceil(rolls.length / 2);
  let up = 0, down = 0;
  rolls.slice(0, half).reverse().forEach(part => { part.y = up + part.radius; up += 2 * part.radius; });
  rolls.slice(half).forEach(part => { part.y = -down - part.radius; down += 2 * part.radius; });
  const gap = 0.1 * largest, tall = 0.42 * largest;
  const blocks = parts.filter(part => !part.roll);
  blocks.forEach(part => {
    part.tall = tall;
    part.wide = 1.9 * largest;
    if (part.index < (rolls[0] || part).index || /upper/.test(part.place.place)) {
      part.y = up + gap + tall / 2;
      up += gap + tall;
    } else {
      part.y = -down - gap - tall / 2;
      down += gap + tall;
    }
  });
  const beam = 0.34 * largest;
  return { parts, top: up + gap + beam, bottom: -down - gap - beam, beam, half: 1.42 * largest, largest,
    drawn: stand.places.some(place => place.diameter > 0) };
}

export class StandView {
  constructor(canvas) {
    this.canvas = canvas;
    this.chosen = 0;         // amplification by the user, 0: automatic
    this.amplification = 1000;
    this.slow = false;
    this.recent = [];        // [utc, largest motion] of the last seconds
    this.moved = new Set();  // springs that are not at the model's own value
  }
  setStand(stand) {
    this.stand = stand;
    this.shape = layout(stand);
    this.position = stand.places.map(() => 0);
  }
  setNumbers(numbers) {
    this.live = numbers.displacement;
    const largest = Math.max(0, ...this.live.map(y => Math.abs(y || 0)));
    this.recent.push(largest);
    if (this.recent.length > 100)
      this.recent.shift();
    this.choose();
  }
  setMotion(motion, now) {
    this.motion = motion;
    this.motionBegan = now;
  }
  // Steps of 1, 2, 5, renewed only when the motion has become too small or too large to be read.
  choose() {
    const largest = Math.max(...this.recent) * (this.pixels || 100);
    if (this.chosen) {
      this.amplification = this.chosen;
    } else if (largest > 0 && (largest * this.amplification > most || largest * this.amplification < least)) {
      const wanted = comfortable / largest;
      this.amplification = Math.max(1, Math.min(1e8, round125(wanted) > wanted * 1.5 ? round125(wanted / 2.5) : round125(wanted)));
    }
  }
  step(direction) {
    const up = round125(this.amplification * 1.01), down = round125(this.amplification / 2.6);
    this.chosen = this.amplification = Math.max(1, Math.min(1e9, direction > 0 ? up : down));
  }
  automatic() {
    this.chosen = 0;
    this.recent = this.recent.slice(-1);
    this.amplification *= 1e-6;
    this.choose();
  }
  /** Slow motion plays a stored piece once in the time until the next. */
  slowFactor() {
    return this.motion ? 4 / (this.motion.step * this.motion.displacement[0].length) : 0;
  }
  displacement(now) {
    if (!this.slow || !this.motion)
      return this.live || [];
    const n = this.motion.displacement[0].length, place = Math.min(n - 1, (now - this.motionBegan) / 4000 * (n - 1));
    const k = Math.max(0, Math.min(n - 2, Math.floor(place))), part = place - k;
    return this.motion.displacement.map(y => y[k] * (1 - part) + y[k + 1] * part);
  }
  draw(now, levels) {
    if (!this.stand)
      return;
    const c = cleared(this.canvas);
    if (!c)
      return;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight, { shape } = this;
    const narrow = width < 480, chain = narrow ? 46 : 96;
    const labels = narrow ? 138 : Math.min(300, width * 0.42);
    const room = width - chain - labels - 8;
    const scale = this.pixels = Math.min((height - 8) / (shape.top - shape.bottom), room / (2 * shape.half));
    const middle = chain + room / 2;
    const line = (height - (shape.top - shape.bottom) * scale) / 2 + shape.top * scale;
    const motion = this.displacement(now);
    const at = part => line - (part.y + (motion[part.index] || 0) * this.amplification) * scale;
    this.canvas.dataset.scale = scale;
    this.canvas.dataset.amplification = this.amplification;
    this.canvas.dataset.middle = middle;
    this.canvas.dataset.line = line;
    this.housing(c, middle, line, scale);
    for (const part of shape.parts)
      part.roll ? this.ghost(c, part, middle, line - part.y * scale, scale) : 0;
    for (const part of shape.parts)
      part.roll ? this.roll(c, part, middle, at(part), scale) : this.block(c, part, middle, at(part), scale);
    this.strip(c, middle, line, scale, chain, room);
    this.springs(c, at, line, scale, chain, narrow);
    this.levels(c, at, width - labels, width, height, middle, scale, levels, narrow);
  }
  housing(c, middle, line, scale) {
    const { shape } = this, outer = shape.half * scale, inner = 1.06 * shape.largest * scale;
    const top = line - shape.top * scale, bottom = line - shape.bottom * scale, beam = shape.beam * scale;
    c.fillStyle = colour("frame");
    c.strokeStyle = colour("rule");
    c.lineWidth = 1.5;
    c.beginPath();
    c.roundRect(middle - outer, top, 2 * outer, bottom - top, 8);
    c.roundRect(middle - inner, top + beam, 2 * inner, bottom - top - 2 * beam, 4);
    c.fill("evenodd");
    c.stroke();
    c.lineWidth = 1;
  }
  ghost(c, part, x, y, scale) {
    c.strokeStyle = colour("soft");
    c.globalAlpha = 0.55;
    c.setLineDash([3, 4]);
    c.beginPath();
    c.arc(x, y, part.radius * scale, 0, 7);
    c.stroke();
    c.setLineDash([]);
    c.globalAlpha = 1;
  }
  roll(c, part, x, y, scale) {
    const radius = part.radius * scale, shade = c.createRadialGradient(x - radius * 0.35, y - radius * 0.4, radius * 0.1, x, y, radius);
    shade.addColorStop(0, colour("steel-bright"));
    shade.addColorStop(1, colour("steel"));
    c.fillStyle = shade;
    c.strokeStyle = colour("steel-edge");
    c.lineWidth = 1.5;
    c.beginPath();
    c.arc(x, y, radius, 0, 7);
    c.fill();
    c.stroke();
    this.axis(c, x, y, radius * 0.86);
    c.beginPath();
    c.moveTo(x, y - radius * 0.16);
    c.lineTo(x, y + radius * 0.16);
    c.stroke();
    c.lineWidth = 1;
  }
  // The line that shows where the mass is.
  axis(c, x, y, half) {
    c.strokeStyle = colour("ink");
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(x - half, y);
    c.lineTo(x + half, y);
    c.stroke();
  }
  block(c, part, x, y, scale) {
    const wide = part.wide * scale, tall = part.tall * scale;
    c.fillStyle = colour("steel");
    c.strokeStyle = colour("steel-edge");
    c.lineWidth = 1.5;
    c.beginPath();
    c.roundRect(x - wide / 2, y - tall / 2, wide, tall, 4);
    c.fill();
    c.stroke();
    this.axis(c, x, y, wide * 0.43);
    c.lineWidth = 1;
  }
  strip(c, middle, line, scale, chain, room) {
    const reach = Math.min(room / 2, this.shape.half * scale * 1.12);
    c.fillStyle = colour("strip");
    c.fillRect(middle - reach, line - 2, reach, 4);
    c.fillRect(middle, line - 1.25, reach, 2.5);
    c.beginPath();
    c.moveTo(middle + reach + 2, line);
    c.lineTo(middle + reach - 9, line - 5);
    c.lineTo(middle + reach - 9, line + 5);
    c.fill();
  }
  // The chain K1..K7 with the same motion.
  springs(c, at, line, scale, chain, narrow) {
    const x = narrow ? 14 : 26, { parts, top, bottom } = this.shape;
    const level = index => index < 0 ? null : at(parts[index]);
    const used = this.stand.springs.filter(spring => spring.value > 0);
    c.font = font(narrow ? 11 : 13, 600);
    c.textBaseline = "middle";
    for (const spring of used) {
      let from = level(spring.from), to = level(spring.to);
      if (from === null || to === null) {
        const held = from === null ? to : from;
        const up = held < line;
        [from, to] = up ? [line - top * scale, held] : [held, line - bottom * scale];
        this.ground(c, x, up ? from : to, up);
      }
      const changed = this.moved.has(spring.key);
      c.strokeStyle = c.fillStyle = colour(changed ? "simulated" : "soft");
      c.lineWidth = changed ? 2.2 : 1.4;
      this.zigzag(c, x, Math.min(from, to), Math.max(from, to));
      write(c, spring.key, x + 13, (from + to) / 2, "left", 0, chain);
    }
    c.strokeStyle = colour("steel-edge");
    c.fillStyle = colour("steel");
    c.lineWidth = 1.2;
    for (const part of parts) {
      c.beginPath();
      c.roundRect(x - 11, at(part) - 4, 22, 8, 2);
      c.fill();
      c.stroke();
    }
    c.lineWidth = 1;
  }
  ground(c, x, y, up) {
    c.strokeStyle = colour("soft");
    c.beginPath();
    c.moveTo(x - 12, y);
    c.lineTo(x + 12, y);
    for (let k = -10; k <= 10; k += 5) {
      c.moveTo(x + k, y);
      c.lineTo(x + k + 4, y + (up ? -5 : 5));
    }
    c.stroke();
  }
  zigzag(c, x, top, bottom) {
    const lead = Math.min(8, (bottom - top) * 0.2), turns = 6, tall = (bottom - top - 2 * lead) / turns;
    c.beginPath();
    c.moveTo(x, top);
    c.lineTo(x, top + lead);
    for (let k = 0; k < turns; ++k)
      c.lineTo(x + (k % 2 ? -6 : 6), top + lead + (k + 0.5) * tall);
    c.lineTo(x, bottom - lead);
    c.lineTo(x, bottom);
    c.stroke();
  }
  // Name and rms of each mass, rows that never lie on each other, a line to the mass.
  levels(c, at, left, right, height, middle, scale, levels, narrow) {
    const rows = this.shape.parts.map(part => ({ part, y: at(part), rest: part.y })).sort((a, b) => b.rest - a.rest);
    const tall = Math.min(narrow ? 58 : 88, (height - 8) / rows.length), size = Math.max(12, Math.min(17, tall * 0.22));
    rows.forEach((row, k) => { row.top = (height - tall * rows.length) / 2 + k * tall; });
    const largest = roundUp(Math.max(1e-6, ...rows.map(row => Math.max(levels[row.part.index]?.measured || 0, levels[row.part.index]?.simulated || 0))));
    const from = left + (narrow ? 10 : 26), number = narrow ? 54 : 70, bar = Math.max(20, right - from - number - 4);
    c.textBaseline = "middle";
    for (const { part, y, top } of rows) {
      const level = levels[part.index] || {}, centre = top + tall / 2;
      c.strokeStyle = colour("soft");
      c.globalAlpha = 0.5;
      c.lineWidth = 1;
      c.beginPath();
      c.moveTo(middle + (part.roll ? part.radius * 0.9 : part.wide * 0.46) * scale, y);
      c.lineTo(left, centre);
      c.lineTo(from - 6, centre);
      c.stroke();
      c.globalAlpha = 1;
      c.font = font(size, 600);
      c.fillStyle = colour("ink");
      write(c, part.place.label, from, top + tall * 0.2, "left", 0, right);
      const bars = [["measured", level.measured], ["simulated", level.simulated]].filter(([kind]) => kind === "simulated" || part.place.measured);
      bars.forEach(([kind, value], k) => {
        const line = top + tall * (0.49 + 0.27 * k), thick = Math.max(5, tall * 0.15);
        c.fillStyle = colour("grid");
        c.fillRect(from, line - thick / 2, bar, thick);
        c.fillStyle = colour(kind);
        c.fillRect(from, line - thick / 2, bar * Math.min(1, Math.max(0, value || 0) / largest), thick);
        c.font = font(size + 1, 600);
        c.fillStyle = value > 0 ? colour(kind) : colour("soft");
        write(c, value > 0 ? plain(value) : "–", right, line, "right", from + bar, right);
      });
    }
  }
}
