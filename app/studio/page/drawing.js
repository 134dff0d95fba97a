// The middle column: the stand to scale while one types, with the dimension of the value in hand, overlaps in red,
// and a mode that moves.
import { standToScale } from "./stand_to_scale.js";
import { byId, make, on, studio } from "./state.js";
import { inSi, rowOf, valueOf } from "./fields.js";

const svgName = "http://www.w3.org/2000/svg";
let picture = "stand", hand = "", drawn = null, frame = 0;

function svg(name, attributes, text) {
  const element = document.createElementNS(svgName, name);
  for (const [key, value] of Object.entries(attributes))
    element.setAttribute(key, typeof value === "number" ? String(Math.round(100 * value) / 100) : value);
  if (text !== undefined)
    element.textContent = text;
  return element;
}

/** Lengths of the case, with what is typed just now over them; m. */
export function lengths() {
  const length = { ...(studio.geometry || {}) };
  for (const section of studio.schema.sections)
    for (const row of section.rows)
      if (row.picture) {
        const value = inSi(valueOf(`${section.name}.${row.key}`));
        if (value > 0)
          length[row.picture] = value;
      }
  return length;
}

// -- overlaps ----------------------------------------------------------------------------------------------------
// Boxes in px that must not share room, with a sentence each.
function overlapsOf(length, d) {
  const out = [], { scale, x, y } = d.views.front, h = d.heights, has = name => length[name] > 0;
  const box = (left, bottom, width, height) => ({ x: x + scale * left, y: y - scale * (bottom + height), width: scale * width, height: scale * height });
  for (const [name, axis, barrel, diameter, neck, span] of [
    ["backup roll", h.backup, "backup_length", "backup_diameter", "backup_neck_diameter", "backup_bearing_span"],
    ["work roll", h.work, "work_roll_length", "work_roll_diameter", "work_neck_diameter", "work_bearing_span"]]) {
    const inner = 0.5 * length[span] - 0.225 * length[neck];  // edge of the bearing towards the barrel
    if (inner < 0.5 * length[barrel]) {
      out.push({ text: `The bearings of the ${name} stand in its barrel: bearing span and barrel length do not fit.`,
        boxes: [-1, 1].flatMap(up => [-1, 1].map(side => {
          const width = Math.min(0.45 * length[neck], 0.5 * length[barrel] - inner);
          return box(side > 0 ? inner : -inner - width, up * axis - 0.65 * length[neck], width, 1.3 * length[neck]);
        })) });
    }
    if (length[neck] >= length[diameter])
      out.push({ text: `The neck of the ${name} is as thick as its barrel.`,
        boxes: [-1, 1].map(up => box(-0.5 * length[barrel], up * axis - 0.5 * length[neck], length[barrel], length[neck])) });
  }
  const end = { backup: 0.5 * length.backup_length + length.backup_neck_length, work: 0.5 * length.work_total_length };
  for (const [name, which, span] of [["backup roll", "backup", "backup_bearing_span"], ["work roll", "work", "work_bearing_span"]])
    if (0.5 * length[span] > end[which])
      out.push({ text: `The bearings of the ${name} stand outside of its end.`,
        boxes: [-1, 1].flatMap(up => [-1, 1].map(side => box(side * 0.5 * length[span] - 0.02, up * h[which] - 0.1, 0.04, 0.2))) });
  if (length.work_total_length < length.work_roll_length)
    out.push({ text: "The work roll is shorter than its barrel.",
      boxes: [-1, 1].map(up => box(-0.5 * length.work_roll_length, up * h.work - 0.5 * length.work_roll_diameter, length.work_roll_length, length.work_roll_diameter)) });
  if (length.strip_width > Math.min(length.work_roll_length, length.backup_length))
    out.push({ text: "The strip is wider than the barrels.",
      boxes: [box(-0.5 * length.strip_width, -0.02, length.strip_width, 0.04)] });
  if (has("housing_window_width") && length.housing_window_width < length.work_roll_diameter)
    out.push({ text: "The window of the housing is narrower than the work roll.", boxes: [] });
  return out;
}

// -- the value in hand -------------------------------------------------------------------------------------------
// Ends of the dimension line of a length, px.
function dimensionOf(name, length, d) {
  const { scale, x, y } = d.views.front, h = d.heights, m = length[name];
  if (!(m > 0))
    return null;
  const flat = (height, from = -0.5 * m, to = 0.5 * m) => ({ x1: x + scale * from, y1: y - scale * height, x2: x + scale * to, y2: y - scale * height });
  const tall = (middle, height, at = 0) => ({ x1: x + scale * at, y1: y - scale * (middle + 0.5 * height), x2: x + scale * at, y2: y - scale * (middle - 0.5 * height) });
  const side = d.views.side;
  switch (name) {
    case "work_roll_diameter": return tall(h.work, m, 0.3 * length.work_roll_length);
    case "work_roll_length": return flat(h.work);
    case "work_neck_diameter": return tall(h.work, m, 0.5 * length.work_bearing_span);
    case "work_total_length": return flat(h.work);
    case "work_bearing_span": return flat(h.work);
    case "backup_diameter": return tall(h.backup, m, 0.3 * length.backup_length);
    case "backup_length": return flat(h.backup);
    case "backup_neck_diameter": return tall(h.backup, m, 0.5 * length.backup_bearing_span);
    case "backup_neck_length": return flat(h.backup, 0.5 * length.backup_length, 0.5 * length.backup_length + m);
    case "backup_bearing_span": return flat(h.backup);
    case "strip_width": return flat(0);
  }
  if (!side)
    return null;
  const across = (height, width, middle = 0) => ({ x1: side.x + side.scale * (middle - 0.5 * width), y1: side.y - side.scale * height, x2: side.x + side.scale * (middle + 0.5 * width), y2: side.y - side.scale * height });
  const up = (from, to, at = 0) => ({ x1: side.x + side.scale * at, y1: side.y - side.scale * from, x2: side.x + side.scale * at, y2: side.y - side.scale * to });
  switch (name) {
    case "housing_window_width": return across(h.windowTop - 0.1, m);
    case "housing_window_height": return up(h.windowBottom, h.windowTop);
    case "housing_post_width": return across(0, m, 0.5 * (length.housing_window_width + m));
    case "housing_upper_beam_height": return up(h.windowTop, h.windowTop + m);
    case "housing_lower_beam_height": return up(h.windowBottom - m, h.windowBottom);
    case "housing_thickness": return flat(h.top - 0.1, -0.5 * length.backup_bearing_span - 0.5 * m, -0.5 * length.backup_bearing_span + 0.5 * m);
  }
  return null;
}

function pictureOf(key) {
  const row = key && rowOf(key);
  return row ? row.picture : undefined;
}

function drawHand(root, length, d) {
  const name = pictureOf(hand), line = name && dimensionOf(name, length, d);
  if (!line)
    return;
  const upright = line.x1 === line.x2, across = upright ? [6, 0] : [0, 6];
  root.append(svg("line", { class: "lit", ...line }));
  for (const [x, y] of [[line.x1, line.y1], [line.x2, line.y2]])
    root.append(svg("line", { class: "lit", x1: x - across[0], y1: y - across[1], x2: x + across[0], y2: y + across[1] }));
  root.append(svg("text", { class: "lit-text", x: (line.x1 + line.x2) / 2 + (upright ? 8 : 0), y: (line.y1 + line.y2) / 2 - (upright ? 0 : 8),
    "text-anchor": upright ? "start" : "middle" }, valueOf(hand) || ""));
}

// -- pictures ----------------------------------------------------------------------------------------------------
function drawShapes(root, shapes) {
  const groups = {};
  for (const s of shapes) {
    const group = groups[s.part || "frame"] || (groups[s.part || "frame"] = root.appendChild(svg("g", { "data-part": s.part || "frame" })));
    const { kind, style, part, text, anchor, ...numbers } = s;
    if (kind === "text")
      root.append(svg("text", { class: style, ...numbers, ...(anchor ? { "text-anchor": anchor } : {}) }, text));
    else
      group.append(svg(kind, { class: style, ...numbers }));
  }
}

function drawStand() {
  const length = lengths(), d = standToScale(length);
  byId("picture").classList.toggle("old", !d);
  if (!d) {
    byId("drawing-note").textContent = "a length of the rolls is missing";
    return null;
  }
  const root = svg("svg", { viewBox: `0 0 ${d.width.toFixed(1)} ${d.height.toFixed(1)}`, role: "img", "aria-label": "the stand to scale" });
  drawShapes(root, d.shapes);
  const overlaps = overlapsOf(length, d);
  overlaps.forEach(o => o.boxes.forEach(b => root.append(svg("rect", { class: "over", ...b }))));
  drawHand(root, length, d);
  byId("overlaps").replaceChildren(...overlaps.map(o => make("li", { textContent: o.text })));
  byId("drawing-note").textContent = overlaps.length ? "" : "from the values on the left";
  byId("picture").replaceChildren(root);
  drawn = { root, d };
  return root;
}

// A roller bearing of the case: its section across the axis.
function drawBearing() {
  const name = [...new Set(Object.keys(studio.values).filter(k => /^bearing\..+\./.test(k)).map(k => k.slice(8, k.lastIndexOf("."))))];
  const chosen = name.find(n => hand.startsWith(`bearing.${n}.`)) || name[0];
  const of = key => inSi(valueOf(`bearing.${chosen}.${key}`));
  const bore = of("bore"), outside = of("outside_diameter"), width = of("width"), roller = of("roller_diameter"), length = of("roller_length");
  const rows = Number(valueOf(`bearing.${chosen}.rows`)) || (/four-row/.test(valueOf(`bearing.${chosen}.type`) || "") ? 4 : 2);
  const n = Number(valueOf(`bearing.${chosen}.rollers_per_row`));
  const root = svg("svg", { viewBox: "0 0 430 300", role: "img", "aria-label": "section of a bearing" });
  if (!(outside > bore && bore > 0)) {
    byId("picture").replaceChildren(make("p", { textContent: chosen ? `The bearing ${chosen} is given by its designation; type bore and outside diameter to see it.` : "The case has no roller bearing." }));
    return;
  }
  const scale = 250 / outside, x = 140, y = 140, pitch = (bore + outside) / 4;
  root.append(svg("circle", { class: "ring-steel", cx: x, cy: y, r: scale * outside / 2 }), svg("circle", { class: "window", cx: x, cy: y, r: scale * (pitch + roller / 2 || 0.45 * outside) }),
    svg("circle", { class: "ring-steel", cx: x, cy: y, r: scale * (pitch - roller / 2 || 0.6 * bore) }), svg("circle", { class: "window", cx: x, cy: y, r: scale * bore / 2 }));
  for (let i = 0; i < n && n < 200 && roller > 0; ++i)
    root.append(svg("circle", { class: "roller", cx: x + scale * pitch * Math.sin(2 * Math.PI * i / n), cy: y - scale * pitch * Math.cos(2 * Math.PI * i / n), r: scale * roller / 2 }));
  if (width > 0) {
    const left = 300, w = Math.min(120, scale * width), s = w / width, ring = s * (outside - bore) / 2, top = y - ring / 2;
    root.append(svg("rect", { class: "ring-steel", x: left, y: top, width: w, height: ring }));
    for (let i = 0; i < rows && roller > 0 && length > 0; ++i)
      root.append(svg("rect", { class: "roller", x: left + (i + 0.5) * w / rows - s * length / 2, y: y - s * roller / 2, width: s * length, height: s * roller }));
    root.append(svg("text", { class: "axis", x: left, y: top + ring + 18 }, `width ${valueOf(`bearing.${chosen}.width`)}`));
  }
  root.append(svg("text", { class: "axis", x: 10, y: 292 }, `${chosen}: d ${valueOf(`bearing.${chosen}.bore`)}, D ${valueOf(`bearing.${chosen}.outside_diameter`)}${n ? `, ${n} rollers in a row` : ""}`));
  byId("picture").replaceChildren(root);
}

// Roll bite: thicknesses to scale with the arc of contact, as far as entry and exit thickness say it.
function drawBite() {
  const l = lengths(), R = l.work_roll_diameter / 2, h0 = l.entry_thickness, h1 = l.exit_thickness;
  const root = svg("svg", { viewBox: "0 0 430 260", role: "img", "aria-label": "roll bite" });
  if (!(R > 0 && h0 > h1 && h1 > 0)) {
    byId("picture").replaceChildren(make("p", { textContent: "The bite needs an entry thickness that is larger than the exit thickness." }));
    return;
  }
  const arc = Math.sqrt(R * (h0 - h1)), scale = 250 / (2.4 * arc), x = 290, y = 125, upright = Math.min(scale * 8, 90 / h0);
  const points = [];
  for (let i = 0; i <= 40; ++i) {
    const along = -1.35 * arc + 2 * arc * i / 40;
    points.push([x + scale * along, y - upright * (h1 / 2 + (R - Math.sqrt(R * R - along * along)))]);
  }
  const strip = [[20, h0 / 2], [x - scale * arc, h0 / 2], ...points.filter(([px]) => px > x - scale * arc && px <= x).map(([px, py]) => [px, (y - py) / upright]), [x, h1 / 2], [415, h1 / 2]];
  const outline = strip.map(([px, half]) => `${px.toFixed(1)},${(y - upright * half).toFixed(1)}`).concat(strip.reverse().map(([px, half]) => `${px.toFixed(1)},${(y + upright * half).toFixed(1)}`));
  root.append(svg("polygon", { class: "strip", points: outline.join(" ") }));
  for (const side of [1, -1])
    root.append(svg("polyline", { class: "centreline", fill: "none", points: points.map(([px, py]) => `${px.toFixed(1)},${(side > 0 ? py : 2 * y - py).toFixed(1)}`).join(" ") }));
  root.append(svg("text", { class: "axis", x: 20, y: 232 }, `${(1e3 * h0).toPrecision(4)} → ${(1e3 * h1).toPrecision(4)} mm, reduction ${(100 * (1 - h1 / h0)).toFixed(1)} %`),
    svg("text", { class: "axis", x: 20, y: 250 }, `arc of contact ${(1e3 * arc).toPrecision(3)} mm with a rigid roll; heights ${(upright / scale).toPrecision(2)} times enlarged`));
  byId("picture").replaceChildren(root);
}

function drawHousing() {
  const length = lengths(), d = standToScale(length);
  if (!d || !d.views.side) {
    byId("picture").replaceChildren(make("p", { textContent: "The case draws no housing: [frame] has its masses and springs. Search for housing to give its drawing." }));
    return;
  }
  const half = 0.5 * length.housing_window_width + length.housing_post_width, v = d.views.side;
  const root = svg("svg", { viewBox: `${(v.x - v.scale * half - 30).toFixed(1)} 0 ${(2 * v.scale * half + 60).toFixed(1)} ${d.height.toFixed(1)}`, role: "img", "aria-label": "mill housing" });
  drawShapes(root, d.shapes.filter(s => (s.kind === "text" ? false : (s.x ?? s.cx ?? s.x1) > v.x - v.scale * half - 1)));
  drawHand(root, length, d);
  byId("picture").replaceChildren(root);
}

const pictures = { stand: ["Stand", drawStand], bearing: ["Bearing", drawBearing], bite: ["Bite", drawBite], housing: ["Housing", drawHousing] };

export function draw() {
  if (!studio.schema)
    return;
  if (picture !== "stand") {
    drawn = null;
    byId("overlaps").replaceChildren();
  }
  pictures[picture][1]();
}

function choose(name) {
  picture = name;
  [...byId("pictures").children].forEach(tab => {
    tab.setAttribute("aria-selected", String(tab.dataset.picture === name));
    tab.tabIndex = tab.dataset.picture === name ? 0 : -1;
  });
  draw();
}

// -- motion ------------------------------------------------------------------------------------------------------
function modes() {
  return (studio.quick && studio.quick.modes) || [];
}

function fillModes() {
  const select = byId("mode"), old = select.value;
  const unstable = ((studio.quick && studio.quick.speeds) || []).find(s => s.frequency);
  select.replaceChildren(...modes().map((m, i) => make("option", { value: `${m.open ? "open " : ""}${m.key || i}`,
    textContent: `${m.frequency.toFixed(1)} Hz · ${m.name || "mode"}${m.open ? " (open stand)" : ""}` })));
  if ([...select.options].some(o => o.value === old) && select.dataset.chosen) {
    select.value = old;
    return;
  }
  const near = unstable && modes().filter(m => !m.open).reduce((best, m) => (!best || Math.abs(m.frequency - unstable.frequency) < Math.abs(best.frequency - unstable.frequency) ? m : best), null);
  const first = near || modes().find(m => m.key === "gap_first_kind") || modes()[0];
  select.selectedIndex = Math.max(0, modes().indexOf(first));
}

function move(time) {
  frame = 0;
  const mode = modes()[byId("mode").selectedIndex], playing = byId("play").getAttribute("aria-pressed") === "true";
  if (drawn && mode) {
    const size = playing ? 14 * Math.sin(time / 1000 * 2 * Math.PI * 0.7) : 0;
    for (const group of drawn.root.querySelectorAll("g[data-part]")) {
      const i = ["M1", "M2", "M3", "M4", "M5", "M6"].indexOf(group.dataset.part);
      if (i >= 0)
        group.setAttribute("transform", `translate(0 ${(-size * (mode.shape[i] || 0)).toFixed(2)})`);
    }
    byId("mode-note").textContent = playing ? "M2 to M5 move as the mode does; the frame is drawn at rest" : "";
  }
  if (playing)
    frame = requestAnimationFrame(move);
}

export function begin() {
  const names = Object.keys(pictures);
  byId("pictures").replaceChildren(...names.map(name => {
    const tab = make("button", { textContent: pictures[name][0], role: "tab" });
    tab.dataset.picture = name;
    tab.addEventListener("click", () => choose(name));
    tab.addEventListener("keydown", event => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step) {
        const next = names[(names.indexOf(name) + step + names.length) % names.length];
        choose(next);
        byId("pictures").querySelector(`[data-picture=${next}]`).focus();
      }
    });
    return tab;
  }));
  choose("stand");
  on("typed", draw);
  on("check", draw);
  on("document", draw);
  on("hand", key => { hand = key; draw(); });
  on("quick", fillModes);
  byId("mode").addEventListener("change", () => { byId("mode").dataset.chosen = "yes"; });
  byId("play").addEventListener("click", () => {
    const playing = byId("play").getAttribute("aria-pressed") !== "true";
    byId("play").setAttribute("aria-pressed", String(playing));
    byId("play").textContent = playing ? "Stop" : "Animate";
    if (!frame)
      frame = requestAnimationFrame(move);
  });
}

