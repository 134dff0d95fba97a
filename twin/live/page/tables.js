// Tables, lists and sliders of the second screen.
import { plain } from "./canvas.js";
import { clock, day, tell } from "./answers.js";

const byId = id => document.getElementById(id);

function cell(kind, text, name = "") {
  const node = document.createElement(kind);
  if (text instanceof Node)
    node.append(text);
  else
    node.textContent = text;
  if (name)
    node.className = name;
  return node;
}

// head: texts; rows: arrays of texts or nodes; the first of a row is its head.  `words` columns are set left.
function fill(table, head, rows, words = []) {
  const top = document.createElement("thead"), body = document.createElement("tbody"), line = document.createElement("tr");
  line.append(...head.map((text, i) => cell("th", text, words.includes(i) ? "words" : "")));
  top.append(line);
  for (const row of rows) {
    const tr = document.createElement("tr");
    tr.className = row.name || "";
    tr.append(...row.map((text, i) => cell(i ? "td" : "th", text, words.includes(i) ? "words" : "")));
    body.append(tr);
  }
  table.replaceChildren(top, body);
}

function stateWord(word) {
  const kind = { calm: "good", running: "good", drifting: "fair", warning: "fair", drifted: "bad", alarm: "bad" }[word] || "unknown";
  return cell("span", word || "–", `state ${kind}`);
}

function cusum(mode) {
  const bar = document.createElement("span");
  bar.className = "cusum";
  bar.title = `CUSUM down ${plain(mode.down, 2)}, up ${plain(mode.up, 2)}, limit ${plain(mode.limit, 2)}`;
  for (const side of ["down", "up"]) {
    const part = document.createElement("i");
    part.className = side;
    part.style.width = `${Math.min(1, (mode[side] || 0) / mode.limit) * 50}%`;
    bar.append(part);
  }
  return bar;
}

export function fillModes(mill) {
  const data = mill.modes, stand = mill.stand;
  if (!stand)
    return;
  const now = (mill.parameters && mill.parameters.frequencies) || [];
  const rows = stand.modes.map((mode, i) => {
    const seen = data && data.modes[i];
    const name = (seen && seen.name) || mode.name || `${i + 1}`;
    const twin = now[i] ?? (seen ? seen.twin : mode.frequency);
    if (!seen)
      return [name, plain(twin, 4), "–", "–", "", stateWord("")];
    return [name, plain(twin, 4), seen.measured === null ? "–" : `${plain(seen.measured, 4)} ± ${plain(seen.sd, 2)}`,
      seen.deviation === null ? "–" : signed(seen.deviation), cusum(seen), stateWord(seen.state)];
  });
  fill(byId("modes"), ["mode", "twin Hz", "measured Hz", "in sd", "CUSUM", "state"], rows, [5]);
  const because = data && data.modes.map(mode => mode.because).find(text => text);
  tell(byId("modes-note"), because || (data ? `every 10 s, last ${clock(data.utc)}` : "measured every 10 s"));
}

export function fillLevels(mill) {
  const data = mill.levels;
  const rows = ((data && data.places) || []).map(place => [mill.label(place.place),
    plain(place.measured[0]), plain(place.simulated[0]), plain(place.measured[1]), plain(place.simulated[1]), plain(place.measured[2], 2), plain(place.simulated[2], 2),
    place.ratio_db === null ? "–" : signed(place.ratio_db),
    place.delay === null ? "–" : `${(place.delay * 1000).toFixed(2).replace("-", "−")}`]);
  fill(byId("levels"), ["m/s²", "rms", "twin", "peak", "twin", "crest", "twin", "dB", "delay ms"], rows);
}

const lasting = seconds => seconds < 120 ? `${seconds.toFixed(0)} s` : seconds < 7200 ? `${(seconds / 60).toFixed(0)} min` : `${(seconds / 3600).toFixed(1)} h`;
const signed = value => `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(1)}`;
const count = value => String(value).replace(/\B(?=(\d{3})+$)/g, " ");

export function fillAccount(mill) {
  const data = mill.account;
  if (!data)
    return tell(byId("account-say"), "no data yet");
  const parts = [data.source, data.connected ? "connected" : "waiting for the source", `queue ${plain(data.queue, 2)} of ${plain(data.queue_limit, 2)} s`,
    data.recording ? `recording to ${data.recording}, ${lasting(data.recorded)}` : "not recording"];
  if (data.load !== null)
    parts.push(`${plain(data.load * 100, 2)} % of a core`);
  if (data.trouble)
    parts.push(data.trouble);
  tell(byId("account-say"), parts.filter(text => text).join("; "));
  const rows = data.channels.map(row => {
    const open = row.offered - row.processed - row.missing - row.rejected - row.overrun;
    const balance = cell("span", open === 0 ? "=" : `${count(open)} open`, `state ${open === 0 ? "good" : "fair"}`);
    return [row.channel, ...["offered", "processed", "missing", "rejected", "overrun"].map(key => count(row[key])), balance];
  });
  fill(byId("account"), ["samples", "offered", "processed", "missing", "rejected", "overrun", ""], rows);
}

export function fillAlarms(mill, send) {
  const all = [...mill.alarms.values()].map(alarm => ({ ...alarm, order: alarm.utc }))
    .concat([...mill.proposals.values()].map(proposal => ({ ...proposal, order: proposal.utc, proposal: true })))
    .sort((a, b) => b.order - a.order);
  // what is open is listed whatever its age
  const isOpen = entry => entry.proposal ? entry.state === "open" : !entry.over;
  let room = 100 - all.filter(isOpen).length;
  const listed = all.filter(entry => isOpen(entry) || room-- > 0), rest = all.length - listed.length + ((mill.account && mill.account.forgotten) || 0);
  byId("alarms").replaceChildren(...listed.map(entry => {
    const item = document.createElement("li");
    const word = entry.proposal ? "proposal" : entry.level;
    item.append(cell("b", day(entry.utc)), cell("em", word, `state ${word === "alarm" ? "bad" : word === "note" ? "unknown" : "fair"}`),
      cell("span", entry.text + (entry.proposal ? values(entry) : entry.over ? " (over)" : "")));
    if (entry.over || (entry.proposal && entry.state !== "open"))
      item.className = "over";
    const action = entry.proposal ? (entry.state === "open" ? { command: "adopt", id: entry.id } : null)
      : entry.acknowledged ? null : { command: "acknowledge", id: entry.id };
    if (action) {
      const button = cell("button", entry.proposal ? "Adopt" : "Seen");
      button.addEventListener("click", () => send(action));
      item.append(button);
    } else {
      item.append(cell("small", entry.proposal ? `${entry.state}${entry.file ? `: ${entry.file}` : ""}` : "seen"));
    }
    return item;
  }));
  if (rest)
    byId("alarms").append(cell("li", `${rest} earlier, over, not listed`));
  else if (!all.length)
    byId("alarms").replaceChildren(cell("li", "none since the program started"));
  const open = all.filter(entry => entry.proposal ? entry.state === "open" : !entry.acknowledged).length;
  const tab = document.querySelector('[data-tab="alarms"]');
  tab.replaceChildren("Alarms", ...(open ? [" ", cell("b", `${open}`)] : []));
}

function values(proposal) {
  return proposal.values.map(v => ` ${v.key} ${scaled(v.from, v.unit)} → ${scaled(v.to, v.unit)}${v.identified ? "" : " (not identified)"}`).join(";");
}

export function fillAdvice(mill) {
  const data = mill.advice, say = byId("advice-say");
  byId("ask-advice").disabled = Boolean(data && data.state === "computing");
  if (!data)
    return tell(say, "what would lower the vibration; text only, nothing is sent to the mill");
  tell(say, [data.state === "computing" ? "computing …" : data.state === "failed" ? "no answer" : clock(data.utc), data.goal, data.text].filter(text => text).join("; "));
  const share = value => value === null ? "–" : `${value > 0 ? "+" : "−"}${Math.abs(value * 100).toFixed(1)} %`;
  const line = row => [row.action, share(row.change), share(row.first_order), row.cost || "none", [row.side_effects, row.mark, row.against].filter(text => text).join("; ")];
  const rows = data.rows.filter(row => !row.against).map(line);
  const below = data.rows.filter(row => row.against).map(line);
  below.forEach(row => { row.name = "against"; });
  fill(byId("advice"), ["action", "change", "linear estimate", "cost", "side effects"], rows.concat(below), [4]);
}

/** 4.4e10 N/m -> "44.0 GN/m" */
export function scaled(value, unit) {
  if (value === null || !isFinite(value))
    return "–";
  if (unit === "-" || !unit)
    return value < 0.2 ? `${plain(value * 100)} %` : plain(value);
  const [factor, letter] = [[1e9, "G"], [1e6, "M"], [1e3, "k"]].find(([f]) => Math.abs(value) >= f) || [1, ""];
  return `${plain(value / factor)} ${letter}${unit}`;
}

export class Sliders {
  constructor(box, send) {
    this.box = box;
    this.send = send;
    this.rows = new Map();
  }
  set(stand) {
    const key = JSON.stringify(stand.sliders);
    if (key === this.key)
      return;  // what has the focus keeps it
    this.key = key;
    this.rows.clear();
    this.box.replaceChildren(...stand.sliders.map(slider => this.row(slider)));
  }
  row(slider) {
    const node = document.createElement("div"), id = `slider-${slider.key}`;
    node.className = "slider";
    const label = document.createElement("label");
    label.htmlFor = id;
    if (slider.label.includes(slider.key))
      label.append(cell("b", slider.label));
    else
      label.append(cell("b", slider.key), ` ${slider.label}`);
    const input = document.createElement("input");
    Object.assign(input, { type: "range", id, min: 0.5, max: 1.5, step: 0.01, value: 1, title: `the model's own value: ${scaled(slider.value, slider.unit)}` });
    const value = document.createElement("output"), factor = cell("em", "");
    const row = { node, input, value, factor, slider, sent: 1, busy: false, awaited: 0 };
    input.addEventListener("input", () => { this.show(row); this.change(row); });
    input.addEventListener("dblclick", () => { input.value = 1; this.show(row); this.change(row); });
    node.append(label, input, value, factor);
    this.rows.set(slider.key, row);
    this.show(row);
    return node;
  }
  show(row) {
    const factor = Number(row.input.value);
    tell(row.value, scaled(row.slider.value * factor, row.slider.unit));
    tell(row.factor, factor === 1 ? "own" : `× ${factor.toFixed(2)}`);
    row.node.dataset.moved = factor === 1 ? "no" : "yes";
    row.input.setAttribute("aria-valuetext", `${row.value.textContent}, ${row.factor.textContent}`);
  }
  // While a value is on its way the next one waits; of several the last is sent.
  async change(row) {
    if (row.busy)
      return;
    row.busy = true;
    while (row.sent !== Number(row.input.value)) {
      row.sent = Number(row.input.value);
      row.awaited = performance.now() + 2000;
      await this.send({ command: "set", key: row.slider.key, factor: row.sent });
    }
    row.busy = false;
  }
  /** Whatever comes next is shown. */
  release() {
    for (const row of this.rows.values())
      row.awaited = 0;
  }
  /** What the program says its parameters are.  A slider that is being moved is left alone, and so is one whose
   *  last value is still on its way: what comes before it is older, and would undo a step. */
  take(parameters) {
    for (const { key, factor } of parameters.sliders) {
      const row = this.rows.get(key);
      if (!row || row.busy || (Math.abs(factor - row.sent) > 1e-6 && performance.now() < row.awaited))
        continue;
      row.awaited = 0;
      row.sent = Number(factor.toFixed(6));
      row.input.value = factor;
      this.show(row);
    }
  }
}
