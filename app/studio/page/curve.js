// A curve with axes, drawn as SVG.
const svgName = "http://www.w3.org/2000/svg";

function svg(name, attributes, text) {
  const element = document.createElementNS(svgName, name);
  for (const [key, value] of Object.entries(attributes))
    element.setAttribute(key, typeof value === "number" ? value.toFixed(1) : value);
  if (text !== undefined)
    element.textContent = text;
  return element;
}

/** Some five round numbers between two ends. */
export function ticks(low, high) {
  const span = high - low || Math.abs(high) || 1, raw = span / 4, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map(f => f * power).find(s => s >= raw);
  const out = [];
  for (let t = Math.ceil(low / step - 1e-9) * step; t <= high + 1e-9 * span; t += step)
    out.push(Number(t.toPrecision(10)));
  return out;
}

/** @param points  [[x, y]] rising in x; y may be NaN */
export function curve(points, { xLabel, yLabel, mark = -1 }) {
  const width = 430, height = 220, left = 58, right = 418, top = 12, bottom = 180;
  const good = points.filter(([, y]) => Number.isFinite(y)), xs = points.map(p => p[0]), ys = good.map(p => p[1]);
  const root = svg("svg", { class: "curve", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${yLabel} over ${xLabel}` });
  if (!good.length)
    return root;
  const x0 = Math.min(...xs), x1 = Math.max(...xs), low = Math.min(...ys), high = Math.max(...ys), pad = 0.06 * (high - low) || 0.01 * Math.abs(high) || 1;
  const y0 = low - pad, y1 = high + pad;
  const x = v => left + (right - left) * (v - x0) / (x1 - x0 || 1), y = v => bottom - (bottom - top) * (v - y0) / (y1 - y0);
  for (const t of ticks(y0, y1))
    root.append(svg("line", { class: "grid", x1: left, x2: right, y1: y(t), y2: y(t) }), svg("text", { x: left - 6, y: y(t) + 4, "text-anchor": "end" }, String(t)));
  for (const t of ticks(x0, x1))
    root.append(svg("line", { class: "grid", x1: x(t), x2: x(t), y1: top, y2: bottom }), svg("text", { x: x(t), y: bottom + 16, "text-anchor": "middle" }, String(t)));
  root.append(svg("text", { x: right, y: height - 6, "text-anchor": "end" }, xLabel), svg("text", { x: 4, y: height - 6 }, yLabel));
  root.append(svg("polyline", { class: "line", points: good.map(([px, py]) => `${x(px).toFixed(1)},${y(py).toFixed(1)}`).join(" ") }));
  if (mark >= 0 && points[mark] && Number.isFinite(points[mark][1]))
    root.append(svg("circle", { class: "mark", cx: x(points[mark][0]), cy: y(points[mark][1]), r: 5 }));
  return root;
}
