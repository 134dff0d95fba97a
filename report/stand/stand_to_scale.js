// The stand to scale for pages that redraw it while a value is typed: the same drawing as stand_to_scale.cpp, from the
// same lengths (run.json, "geometry").  A test compares the two.

const viewHeight = 440, viewGap = 34, viewFoot = 52, viewWidth = 430;  // px

export const needed = ["work_roll_diameter", "work_roll_length", "work_neck_diameter", "work_total_length",
  "work_bearing_span", "backup_diameter", "backup_length", "backup_neck_diameter", "backup_neck_length",
  "backup_bearing_span"];

// As the report prints it: a half goes to the even number, where Math.round goes up.
function wholeNumber(value) {
  const up = Math.round(value);
  return up - value === 0.5 && up % 2 !== 0 ? up - 1 : up;
}

/** Length in m; 0 where the case does not draw it. */
function sizes(length) {
  return name => length[name] > 0 ? length[name] : 0;
}

function heightsOf(size) {
  const h = { work: 0.5 * size("work_roll_diameter"), windowTop: 0, windowBottom: 0 };
  h.backup = size("work_roll_diameter") + 0.5 * size("backup_diameter");
  h.top = h.backup + 0.5 * size("backup_diameter");
  h.bottom = -h.top;
  if (size("housing_window_height") > 0) {
    const chock = 1.5 * size("backup_neck_diameter");  // where no chock is drawn
    h.windowBottom = -h.backup - 0.5 * Math.max(chock, size("backup_diameter") * 0.9);
    h.windowTop = h.windowBottom + size("housing_window_height");
    h.top = Math.max(h.top, h.windowTop + size("housing_upper_beam_height"));
    h.bottom = Math.min(h.bottom, h.windowBottom - size("housing_lower_beam_height"));
  }
  return h;
}

function halfLength(size) {
  return Math.max(0.5 * size("work_total_length"), 0.5 * size("backup_length") + size("backup_neck_length"),
    0.5 * (size("backup_bearing_span") + size("housing_thickness")));
}

/** Collects shapes of one view: a scale and where its middle and the pass line stand. */
class View {
  constructor(shapes, scale, x, y) {
    Object.assign(this, { shapes, scale, x, y });
  }
  box(left, bottom, width, height, style, part = "frame") {
    if (width > 0 && height > 0)
      this.shapes.push({ kind: "rect", x: this.x + this.scale * left, y: this.y - this.scale * (bottom + height),
        width: this.scale * width, height: this.scale * height, style, part });
  }
  disc(height, diameter, style, part) {
    this.shapes.push({ kind: "circle", cx: this.x, cy: this.y - this.scale * height, r: 0.5 * this.scale * diameter, style, part });
  }
  line(x1, y1, x2, y2, style, part = "frame") {
    this.shapes.push({ kind: "line", x1, y1, x2, y2, style, part });
  }
}

// Nut, screw, load cell and piston hang from the upper beam; what is not drawn is left out.
function drawScrewdown(view, size, h, middle) {
  const part = (top, diameter, height, style) => {
    view.box(middle - 0.5 * diameter, top - height, diameter, height, style);
    return diameter > 0 && height > 0 ? top - height : top;
  };
  part(h.windowTop + size("nut_height"), size("nut_outside_diameter"), size("nut_height"), "ring-steel");
  let below = part(h.windowTop, size("screw_diameter"), size("screw_length"), "roller");
  below = part(below, size("load_cell_diameter"), size("load_cell_height"), "bearing");
  part(below, size("piston_diameter"), size("piston_length") + size("stroke"), "ring-steel");
}

const rollPart = { backup: { "1": "M2", "-1": "M5" }, work: { "1": "M3", "-1": "M4" } };

function drawRollPair(view, axis, barrel, diameter, end, neck, which) {
  for (const side of [-1, 1]) {
    const part = rollPart[which][side];
    view.box(-end, side * axis - 0.5 * neck, 2 * end, neck, "steel", part);
    view.box(-0.5 * barrel, side * axis - 0.5 * diameter, barrel, diameter, "steel", part);
    const y = view.y - view.scale * side * axis;
    view.line(view.x - view.scale * end - 6, y, view.x + view.scale * end + 6, y, "centreline", part);
  }
}

function drawAlongRolling(view, size, h) {
  const span = size("backup_bearing_span"), thick = size("housing_thickness");
  for (const side of [-0.5, 0.5]) {
    view.box(side * span - 0.5 * thick, h.bottom, thick, h.top - h.bottom, "part");
    if (h.windowTop > h.windowBottom)
      drawScrewdown(view, size, h, side * span);
  }
  drawRollPair(view, h.backup, size("backup_length"), size("backup_diameter"),
    0.5 * size("backup_length") + size("backup_neck_length"), size("backup_neck_diameter"), "backup");
  drawRollPair(view, h.work, size("work_roll_length"), size("work_roll_diameter"),
    0.5 * size("work_total_length"), size("work_neck_diameter"), "work");
  for (const [axis, bearings, neck, which] of [[h.backup, span, size("backup_neck_diameter"), "backup"],
    [h.work, size("work_bearing_span"), size("work_neck_diameter"), "work"]])
    for (const side of [-0.5, 0.5])
      for (const up of [-1, 1])
        view.box(side * bearings - 0.225 * neck, up * axis - 0.65 * neck, 0.45 * neck, 1.3 * neck, "bearing", rollPart[which][up]);
  const strip = size("strip_width");
  view.shapes.push({ kind: "rect", x: view.x - 0.5 * view.scale * strip, y: view.y - 1.5, width: view.scale * strip,
    height: 3, style: "strip", part: "strip" });
}

function drawAlongRolls(view, size, h) {
  const window = size("housing_window_width"), post = size("housing_post_width");
  view.box(-0.5 * window - post, h.bottom, window + 2 * post, h.top - h.bottom, "part");
  view.box(-0.5 * window, h.windowBottom, window, h.windowTop - h.windowBottom, "window");
  drawScrewdown(view, size, h, 0);
  for (const up of [-1, 1]) {
    view.disc(up * h.backup, size("backup_diameter"), "steel", rollPart.backup[up]);
    view.disc(up * h.backup, size("backup_neck_diameter"), "bearing", rollPart.backup[up]);
    view.disc(up * h.work, size("work_roll_diameter"), "steel", rollPart.work[up]);
    view.disc(up * h.work, size("work_neck_diameter"), "bearing", rollPart.work[up]);
  }
  view.line(view.x - 0.5 * view.scale * window, view.y, view.x + 0.5 * view.scale * window, view.y, "strip-line", "strip");
}

/**
 * Shapes of the stand in px, or null where a length of the rolls is missing.
 * @param length  m, by the names of run.json
 * @return {width, height, shapes, views: {front, side}, heights}; the views have scale (px/m), x, y of the pass line
 */
export function standToScale(length) {
  const size = sizes(length);
  if (needed.some(name => !(size(name) > 0)))
    return null;
  const heights = heightsOf(size), broad = 2 * halfLength(size);
  const side = size("housing_window_width") + 2 * size("housing_post_width");
  const scale = Math.min(viewHeight / (heights.top - heights.bottom), (viewWidth - viewGap) / (broad + side));
  const width = Math.max(scale * (broad + side) + (side > 0 ? viewGap : 0) + 20, 300);
  const tall = scale * (heights.top - heights.bottom), shapes = [];
  const y = 6 + scale * heights.top;
  const front = new View(shapes, scale, 10 + 0.5 * scale * broad, y);
  const views = { front };
  drawAlongRolling(front, size, heights);
  if (side > 0) {
    views.side = new View(shapes, scale, 10 + scale * broad + viewGap + 0.5 * scale * side, y);
    drawAlongRolls(views.side, size, heights);
  }
  const metres = scale > 450 ? 0.2 : scale > 180 ? 0.5 : scale > 90 ? 1 : scale > 45 ? 2 : 4, foot = tall + 30;
  front.line(10, foot, 10 + scale * metres, foot, "dimension");
  for (const end of [0, metres])
    front.line(10 + scale * end, foot - 4, 10 + scale * end, foot + 4, "dimension");
  shapes.push({ kind: "text", x: 10 + scale * metres + 8, y: foot + 4, text: `${1000 * metres} [mm]`, style: "axis" });
  const diameter = name => wholeNumber(1e3 * size(name));
  shapes.push({ kind: "text", x: width - 10, y: tall + 34, anchor: "end", style: "axis",
    text: `\u2300 ${diameter("work_roll_diameter")} / ${diameter("backup_diameter")}` });
  return { width, height: tall + viewFoot, shapes, views, heights };
}
