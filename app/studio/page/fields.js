// The left column: values in the order of a drawing, each with its unit, range, estimate and help; all keys by search.
import { byId, make, on, studio, tell, type } from "./state.js";

const numberText = /^\s*([-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?)\s*(.*)$/;
const shown = new Map();   // full key -> its elements
let sectionsShown = "";

/** Rows of the schema by full key: "bearing.trb.bore" is a row of the section "bearing". */
export function rowOf(key) {
  const dot = key.lastIndexOf("."), section = key.slice(0, Math.max(dot, 0)), name = key.slice(dot + 1);
  for (const one of studio.schema.sections) {
    const fits = one.repeat === "once" ? section === one.name : section.startsWith(one.name + ".");
    const row = fits && one.rows.find(r => r.key === name);
    if (row)
      return row;
  }
  return null;
}

/** A key as words; '.' and '/' in a name of the user are escaped in its key. */
export const words = key => key.replace(/_/g, " ").replace(/%2E/g, ".").replace(/%2F/g, "/");
export const valueOf = key => (key in studio.typed ? studio.typed[key] : key in studio.values ? studio.values[key] : null);

/** Number and unit of a text, or null: "16,5 in" -> {number: "16,5", unit: "in"}. */
function parts(text) {
  const match = numberText.exec(text || "");
  return match ? { number: match[1], unit: match[2].trim() } : null;
}

/** A quantity in SI, or NaN. */
export function inSi(text) {
  const p = parts(text), unit = p && studio.schema.units[p.unit];
  return unit ? Number(p.number.replace(",", ".")) * unit.factor + unit.offset : NaN;
}

/** An SI value in a unit, with digits that a drawing would have. */
export function fromSi(value, unit) {
  const u = studio.schema.units[unit];
  return String(Number(((value - u.offset) / u.factor).toPrecision(8)));
}

const isQuantity = row => row && row.kind === "quantity" && row.units && row.units.length > 0;

function example(row) {
  return row ? (row.default || row.example || "").replace(/^"|"$/g, "") : "";
}

// The unit that a value has, or would get.
function unitOf(key, row) {
  const p = parts(valueOf(key));
  if (p && row.units.includes(p.unit))
    return p.unit;
  const of = parts(example(row));
  return of && row.units.includes(of.unit) ? of.unit : row.form;
}

function field(key, label) {
  const row = rowOf(key), id = `v-${key}`;
  const box = make("div", { className: "value" });
  box.dataset.key = key;
  const hint = make("p", { className: "hint", id: `${id}-hint` }), wrong = make("p", { className: "wrong", hidden: true, id: `${id}-wrong` });
  let input, unit = null;
  if (row && (row.kind === "choice" || row.kind === "flag")) {
    input = make("select", { id });
    const options = row.kind === "flag" ? ["true", "false"] : row.form.split(" | ");
    input.append(make("option", { value: "", textContent: row.default ? `default (${example(row)})` : "not given" }));
    options.forEach(option => input.append(make("option", { value: option, textContent: option })));
    box.classList.add("wide");
  } else {
    input = make("input", { id, autocomplete: "off", spellcheck: false });
    if (isQuantity(row)) {
      unit = make("select", { ariaLabel: `unit of ${label}` });
      row.units.forEach(u => unit.append(make("option", { value: u, textContent: u })));
    } else {
      box.classList.add("wide");
    }
  }
  input.setAttribute("aria-describedby", `${id}-wrong ${id}-hint`);
  box.append(make("label", { htmlFor: id, textContent: label }), input);
  if (unit)
    box.append(unit);
  box.append(wrong, hint);
  const one = { key, row, box, input, unit, hint, wrong };
  const take = () => {
    const text = input.value.trim(), p = parts(text);
    type(key, text === "" ? null : unit && p && p.unit === "" ? `${p.number} ${unit.value}` : text);
  };
  input.addEventListener("input", take);
  input.addEventListener("focus", () => tell("hand", key));
  input.addEventListener("keydown", event => {
    if (event.key === "Enter" && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      const all = [...document.querySelectorAll("#values .value input, #values .value > select[id]")];
      const next = all[all.indexOf(input) + (event.shiftKey ? -1 : 1)];
      if (next) {
        next.focus();
        if (next.select)
          next.select();
      }
    }
  });
  if (unit)
    unit.addEventListener("change", () => {
      const old = valueOf(key), si = inSi(old);
      if (old !== null && Number.isFinite(si)) {
        type(key, `${fromSi(si, unit.value)} ${unit.value}`);
        show(one);
      }
    });
  show(one);
  return one;
}

// Shows the value of the case, but for what is being typed.
function show(one) {
  const { key, row, input, unit } = one, value = valueOf(key);
  if (document.activeElement !== input || !(key in studio.typed)) {
    const p = unit && value !== null ? parts(value) : null;
    const split = p && row.units.includes(p.unit);
    const text = value === null ? "" : split ? p.number : value;
    if (input.value !== text && !(document.activeElement === input && isTyped(one, value)))
      input.value = text;
    if (unit && document.activeElement !== unit)
      unit.value = unitOf(key, row);
  }
  judge(one);
}

// Does what stands in the field mean the value of the case already?
function isTyped(one, value) {
  const text = one.input.value.trim(), p = parts(text);
  return value !== null && (text === value || (one.unit && p && p.unit === "" && `${p.number} ${one.unit.value}` === value));
}

function estimateOf(key) {
  return ((studio.check && studio.check.estimates) || []).find(e => e.key === key);
}

function judge(one) {
  const { key, row, box, input, hint, wrong } = one, check = studio.check;
  const problem = check && (check.problems.find(p => p.key === key && p.severity === "error") || check.problems.find(p => p.key === key));
  const estimate = valueOf(key) === null ? estimateOf(key) : null;
  wrong.hidden = !problem;
  wrong.textContent = problem ? problem.message : "";
  wrong.className = `wrong ${problem ? problem.severity : ""}`;
  box.classList.toggle("error", Boolean(problem && problem.severity === "error"));
  input.setAttribute("aria-invalid", String(Boolean(problem && problem.severity === "error")));
  box.classList.toggle("template", Boolean(check && (check.left_at_template || []).includes(key)));
  box.classList.toggle("estimated", Boolean(estimate));
  const three = x => String(Number(x.toPrecision(3)));
  if (row)
    hint.textContent = [row.where || row.meaning, row.range && `range ${row.range}`,
      row.default && `default ${example(row)}`,
      estimate && `estimated ${three(estimate.value)} ${estimate.unit} (${three(estimate.low)} .. ${three(estimate.high)}): ${estimate.rule}`]
      .filter(Boolean).join("; ");
  if (input.tagName === "INPUT")
    input.placeholder = estimate ? three(estimate.value) : row && !row.required && row.default ? example(row).replace(/\s.*/, "") : "";
}

// -- which fields, in which order -----------------------------------------------------------------------------------
function instances(section) {
  const names = new Set();
  for (const key of Object.keys({ ...studio.values, ...studio.typed })) {
    if (!key.startsWith(section.name + "."))
      continue;
    const rest = key.slice(section.name.length + 1), dot = rest.lastIndexOf(".");
    if (dot > 0)
      names.add(rest.slice(0, dot));
  }
  return [...names];
}

// [{title, meaning, keys}] : the drawing first, then what else stands in the file.
function layout() {
  const groups = [], used = new Set();
  const add = (title, meaning, keys) => {
    const fresh = keys.filter(key => !used.has(key) && used.add(key));
    if (fresh.length)
      groups.push({ title, meaning, keys: fresh });
  };
  const present = Object.keys(studio.values);
  const inFile = prefix => present.filter(key => key.startsWith(prefix + ".") && !key.slice(prefix.length + 1).includes("."));
  add("case", "", present.filter(key => !key.includes(".") && key !== "schema"));
  const done = new Set();
  for (const { section: id } of studio.schema.drawing) {
    const section = studio.schema.sections.find(s => s.id === id);
    if (done.has(id) || !section)
      continue;
    done.add(id);
    const drawn = studio.schema.drawing.filter(d => d.section === id).map(d => d.key);
    const prefixes = section.repeat === "once" ? [section.name] : instances(section).map(name => `${section.name}.${name}`);
    for (const prefix of prefixes) {
      const here = inFile(prefix);
      if (id === "strip.flow_stress" && here.length === 0)
        continue;
      const bearing = section.repeat === "named" && here.includes(`${prefix}.designation`);
      const wanted = drawn.map(key => `${prefix}.${key}`).filter(key =>
        section.repeat !== "named" || here.includes(key) || (!bearing && rowOf(key) && rowOf(key).required));
      const title = section.repeat === "list" ? `${words(section.name)} ${Number(prefix.split(".").pop()) + 1}` : words(prefix);
      add(title, section.meaning, [...wanted, ...here]);
    }
  }
  const others = new Map();
  for (const key of present.filter(k => !used.has(k) && k !== "schema")) {
    const prefix = key.slice(0, Math.max(key.lastIndexOf("."), 0));
    others.set(prefix, [...(others.get(prefix) || []), key]);
  }
  others.forEach((keys, prefix) => add(words(prefix || "case"), "", keys));
  return groups;
}

export function drawnKeys() {
  return layout().flatMap(group => group.keys);
}

function build() {
  const groups = layout(), now = JSON.stringify(groups.map(g => [g.title, g.keys]));
  if (now === sectionsShown) {
    shown.forEach(show);
    return;
  }
  sectionsShown = now;
  const hand = document.activeElement && document.activeElement.id, range = document.activeElement && document.activeElement.selectionStart;
  shown.clear();
  const all = groups.map(group => {
    const box = make("section", {}, make("h3", { title: group.meaning, textContent: group.title }));
    for (const key of group.keys) {
      const one = field(key, words(key.slice(key.lastIndexOf(".") + 1)));
      shown.set(key, one);
      box.append(one.box);
    }
    return box;
  });
  byId("fields").replaceChildren(...all);
  find();
  const back = hand && document.getElementById(hand);
  if (back && back !== document.activeElement) {
    back.focus();
    if (range !== undefined && range !== null && back.setSelectionRange)
      back.setSelectionRange(range, range);
  }
}

// -- search ------------------------------------------------------------------------------------------------------
function allKeys() {
  return studio.schema.sections.flatMap(section => {
    const prefixes = section.repeat === "once" ? [section.name] : section.repeat === "named" ? instances(section).map(n => `${section.name}.${n}`)
      : (instances(section).length ? instances(section) : ["0"]).map(n => `${section.name}.${n}`);
    return prefixes.flatMap(prefix => section.rows.map(row => ({ key: prefix ? `${prefix}.${row.key}` : row.key, row })));
  });
}

let foundKeys = "";
function find() {
  const wanted = byId("search").value.trim().toLowerCase().split(/\s+/).filter(Boolean);
  const hits = wanted.length === 0 ? [] : allKeys().filter(({ key, row }) => {
    const text = `${key} ${words(key)} ${row.meaning}`.toLowerCase();
    return wanted.every(w => text.includes(w)) && !shown.has(key);
  });
  const few = hits.slice(0, 24).map(hit => hit.key), now = [...wanted, ...few].join(" ");
  if (now === foundKeys && few.every(key => byId("found").querySelector(`[data-key="${CSS.escape(key)}"]`)))
    return;
  foundKeys = now;
  const rows = few.map(key => field(key, key));
  byId("found").replaceChildren(...rows.map(one => one.box));
  if (wanted.length)
    byId("found").append(make("small", { textContent: hits.length > 24 ? `${hits.length - 24} more; add a word` : hits.length ? "" : "No other key has these words; what stands in the case is below." }));
  rows.forEach(one => one.box.addEventListener("focusin", () => tell("hand", one.key)));
}

/** Puts the cursor into the field of a key, wherever it is. */
export function jump(key) {
  let one = shown.get(key);
  if (!one) {
    byId("search").value = key;
    find();
    const box = byId("found").querySelector(`[data-key="${CSS.escape(key)}"]`);
    one = box && { box, input: box.querySelector("input, select") };
  }
  if (!one)
    return;
  one.box.scrollIntoView({ block: "center" });
  one.input.focus();
  if (one.input.select)
    one.input.select();
}

export function begin() {
  byId("search").addEventListener("input", find);
  on("check", () => {
    build();
    const left = (studio.check.left_at_template || []).length;
    byId("values-note").textContent = left ? `${left} still at the template` : `${Object.keys(studio.values).length} in the case`;
  });
  on("document", build);
}
