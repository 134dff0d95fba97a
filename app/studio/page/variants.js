// Pinned states side by side, and one value varied.
import { ask, banner, byId, edit, isOld, make, on, studio, tell, type } from "./state.js";
import { drawnKeys, fromSi, inSi, rowOf, valueOf, words } from "./fields.js";
import { change, digits, keyResults, numbersOf, openReport, plain } from "./answers.js";
import { curve } from "./curve.js";

const answers = new Map();  // name of a pin -> {quick, values}
let chosen = new Set(), sweep = null;

const results = () => [...keyResults.slice(0, 2), ["K3", "K3"], ["stand.modulus.tangent", "modulus with strip"], ["stand.modulus.kiss", "modulus, rolls touching"]];

async function readPins() {
  for (const pin of studio.document.pins)
    if (!answers.has(pin.name))
      try {
        answers.set(pin.name, await ask("/quick", { pin: pin.name }));
      } catch { return; }
  for (const name of answers.keys())
    if (!studio.document.pins.some(p => p.name === name))
      answers.delete(name);
  const last = studio.document.pins[studio.document.pins.length - 1];
  studio.base = last && answers.has(last.name) ? { name: last.name, quick: answers.get(last.name) } : null;
  tell("base");
  drawPins();
}

function differences(values) {
  const keys = new Set([...Object.keys(values), ...Object.keys(studio.values)]);
  return [...keys].filter(key => values[key] !== studio.values[key]);
}

// Two states that were run, and by different runs.
function showCompare() {
  const runs = studio.document.pins.filter(pin => chosen.has(pin.name)).map(pin => pin.run), without = runs.some(run => !run);
  byId("compare").disabled = runs.length !== 2 || without || runs[0] === runs[1];
  byId("compare-note").textContent = runs.length !== 2 ? (studio.document.pins.length > 1 ? "mark two pins" : "")
    : without ? "a pin without a run: go back to it and press Run" : runs[0] === runs[1] ? "both pins are one state" : "";
}

function drawPins() {
  const pins = studio.document.pins, now = numbersOf(studio.quick), table = byId("pins");
  chosen = new Set([...chosen].filter(name => pins.some(p => p.name === name)));
  showCompare();
  if (!pins.length) {
    table.replaceChildren();
    return;
  }
  const speeds = [...new Set([...answers.values()].flatMap(a => a.speeds || []).map(s => s.pass))].slice(0, 1).map(p => [`critical_speed.${p}`, "critical speed"]);
  const columns = [...speeds, ...results()].filter(([name]) => (now[name] && Number.isFinite(now[name].value)) || pins.some(p => { const r = numbersOf(answers.get(p.name))[name]; return r && Number.isFinite(r.value); }));
  const head = make("thead", {}, make("tr", {}, make("th", { textContent: "pin" }), ...columns.map(([, label]) => make("th", { textContent: label })), make("th", { textContent: "values that differ" }), make("th", {})));
  const body = make("tbody");
  for (const pin of pins) {
    const answer = answers.get(pin.name), of = numbersOf(answer);
    const box = make("input", { type: "checkbox", checked: chosen.has(pin.name), ariaLabel: `compare ${pin.name}` });
    box.addEventListener("change", () => { box.checked ? chosen.add(pin.name) : chosen.delete(pin.name); showCompare(); });
    const back = make("button", { textContent: "Back to it", disabled: pin.same });
    back.addEventListener("click", () => edit({ op: "back", name: pin.name }).catch(error => banner(error.message, 6000)));
    const drop = make("button", { textContent: "×", ariaLabel: `take ${pin.name} away`, title: "take away" });
    drop.addEventListener("click", () => edit({ op: "unpin", name: pin.name }).catch(error => banner(error.message, 6000)));
    const differ = answer && answer.values ? differences(answer.values) : [];
    const line = make("tr", {}, make("td", {}, box, ` ${pin.name}${pin.run ? ` (${pin.run})` : ""}`));
    for (const [name] of columns) {
      const cell = make("td", { textContent: of[name] ? digits(of[name].value, of[name].unit) : "–" });
      const by = of[name] && now[name] ? change(of[name].value, now[name].value) : "";
      if (by && by !== "=") {
        cell.append(make("br"), make("small", { textContent: by }));
        cell.className = "up";
      }
      line.append(cell);
    }
    line.append(make("td", { textContent: differ.length > 3 ? `${differ.length} values` : differ.join(", ") || "none", title: differ.join("\n") }), make("td", {}, back, " ", drop));
    body.append(line);
  }
  table.replaceChildren(head, body);
}

// -- one value varied ----------------------------------------------------------------------------------------------
function fillSweep() {
  const select = byId("sweep-key"), old = select.value;
  const keys = drawnKeys().filter(key => { const row = rowOf(key); return row && (row.kind === "quantity" || row.kind === "number") && valueOf(key) !== null; });
  if (keys.join() !== select.dataset.keys) {
    select.dataset.keys = keys.join();
    select.replaceChildren(...keys.map(key => make("option", { value: key, textContent: words(key) })));
    if (keys.includes(old))
      select.value = old;
    ends();
  }
  const result = byId("sweep-result"), was = result.value, now = numbersOf(studio.quick);
  const names = [...keyResults, ...Object.keys(now).filter(n => n.startsWith("critical_speed.")).map(n => [n, words(n.replace(".", ", "))])].filter(([n]) => now[n]);
  result.replaceChildren(...names.map(([name, label]) => make("option", { value: name, textContent: label })));
  if (names.some(([n]) => n === was))
    result.value = was;
}

const isPure = key => rowOf(key).kind === "number";
const unitHere = key => { const m = /[a-zA-Z%].*$/.exec(valueOf(key) || ""); return m ? m[0] : rowOf(key).form; };

// Ten per cent to both sides of what the case has.
function ends() {
  const key = byId("sweep-key").value;
  if (!key)
    return;
  const value = isPure(key) ? Number(valueOf(key)) : inSi(valueOf(key));
  const text = v => isPure(key) ? plain(v, 5) : `${fromSi(v, unitHere(key))} ${unitHere(key)}`;
  byId("sweep-from").value = text(0.9 * value);
  byId("sweep-to").value = text(1.1 * value);
}

async function runSweep() {
  const key = byId("sweep-key").value, read = text => (isPure(key) ? Number(text.replace(",", ".")) : inSi(text));
  const from = read(byId("sweep-from").value), to = read(byId("sweep-to").value), n = 15;
  if (!key || !Number.isFinite(from) || !Number.isFinite(to) || from === to)
    return banner("From and To are values with a unit of the key, and differ.", 5000);
  const numbers = Array.from({ length: n }, (_, i) => Math.min(from, to) + Math.abs(to - from) * i / (n - 1));
  const unit = isPure(key) ? "" : unitHere(key);
  const texts = numbers.map(v => isPure(key) ? String(Number(v.toPrecision(8))) : `${fromSi(v, unit)} ${unit}`);
  byId("sweep-curve").setAttribute("aria-busy", "true");
  try {
    const answer = await ask("/sweep", { key, values: texts });
    sweep = { key, unit, texts, x: texts.map(t => Number(t.split(" ")[0])), rows: answer.rows, revision: answer.revision };
    byId("sweep-slider").max = n - 1;
    byId("sweep-slider").value = Math.floor(n / 2);
    byId("sweep-slide").hidden = false;
    drawSweep();
  } catch (error) {
    banner(error.message, 6000);
  }
  byId("sweep-curve").removeAttribute("aria-busy");
}

function drawSweep() {
  if (!sweep)
    return;
  const name = byId("sweep-result").value, mark = Number(byId("sweep-slider").value), unit = (numbersOf(studio.quick)[name] || {}).unit || "1";
  const factor = v => Number(digits(v, unit).split(" ")[0]), word = digits(1, unit).split(" ").slice(1).join(" ");
  const points = sweep.rows.map((row, i) => [sweep.x[i], row.results && name in row.results ? factor(row.results[name]) : NaN]);
  byId("sweep-curve").replaceChildren(curve(points, { xLabel: `${words(sweep.key)} [${sweep.unit || "1"}]`, yLabel: `${byId("sweep-result").selectedOptions[0] ? byId("sweep-result").selectedOptions[0].textContent : ""} [${word}]`, mark }));
  byId("sweep-curve").classList.toggle("old", isOld(sweep));
  const refused = sweep.rows[mark].error;
  byId("sweep-text").textContent = `${sweep.texts[mark]}: ${refused || `${plain(points[mark][1])} ${word}`}`;
  byId("sweep-take").disabled = Boolean(refused);
}

export function begin() {
  on("document", readPins);
  on("quick", () => { drawPins(); fillSweep(); drawSweep(); });
  on("check", () => { fillSweep(); drawSweep(); });
  byId("pin-form").addEventListener("submit", event => {
    event.preventDefault();
    const name = byId("pin-name").value.trim() || `state ${studio.document.pins.length + 1}`;
    answers.delete(name);
    edit({ op: "pin", name }).then(() => { byId("pin-name").value = ""; }).catch(error => banner(error.message, 6000));
  });
  byId("compare").addEventListener("click", async () => {
    try {
      const answer = await ask("/compare", { pins: [...chosen] });
      openReport(answer.path, [...chosen].join(" and "));
    } catch (error) {
      banner(error.message, 8000);
    }
  });
  byId("sweep-form").addEventListener("submit", event => { event.preventDefault(); runSweep(); });
  byId("sweep-key").addEventListener("change", ends);
  byId("sweep-result").addEventListener("change", drawSweep);
  byId("sweep-slider").addEventListener("input", drawSweep);
  byId("sweep-take").addEventListener("click", () => type(sweep.key, sweep.texts[Number(byId("sweep-slider").value)]));
}
