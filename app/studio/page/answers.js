// The right column: what check says, the quick answer with changes, and the finite elements with what they differ by.
import { address, ask, banner, byId, edit, isOld, make, on, reread, studio } from "./state.js";
import { jump, words } from "./fields.js";

const shownUnits = { "N/m": ["MN/mm", 1e-9], N: ["kN", 1e-3], m: ["mm", 1e3], "kg": ["t", 1e-3], "1": ["%", 100], "Hz": ["Hz", 1], "m/s": ["m/s", 1] };

export function digits(value, unit) {
  const [word, factor] = shownUnits[unit] || [unit, 1];
  return `${plain(value * factor)} ${word}`;
}
export function plain(value, n = 4) {
  if (!Number.isFinite(value))
    return "–";
  const text = Number(value.toPrecision(n));
  return Math.abs(text) >= 1e-3 && Math.abs(text) < 1e6 ? String(text) : value.toExponential(2);
}
export function change(value, base) {
  if (!Number.isFinite(value) || !Number.isFinite(base) || base === 0)
    return "";
  const percent = 100 * (value / base - 1);
  return Math.abs(percent) < 0.005 ? "=" : `${percent > 0 ? "+" : "−"}${Math.abs(percent) < 10 ? Math.abs(percent).toFixed(2) : Math.abs(percent).toFixed(1)} %`;
}

// The sentence of a pass, with its name where there are several.
const named = (speeds, s) => speeds.length > 1 ? `${words(s.pass)}: ${s.sentence || ""}` : s.sentence || "";

const signed = slope => `${slope < 0 ? "−" : "+"}${plain(Math.abs(slope), 2)}`;

const rows = [
  ["Gap modes of six masses", ["mode.gap_first_kind.frequency", "gap mode, first kind"], ["mode.gap_second_kind.frequency", "gap mode, second kind"],
    ["open.mode.gap_first_kind.frequency", "first kind, open stand"], ["f1", "lowest mode, f1"], ["f6", "highest mode, f6"]],
  ["Stiffness", ["K3", "K3, upper rolls"], ["K5", "K5, lower rolls"], ["K4", "K4, strip"], ["Kzc1", "Kzc, backup roll"], ["Kzc2", "Kzc, work roll"],
    ["stand.modulus.kiss", "mill modulus, rolls touching"], ["stand.modulus.tangent", "mill modulus with strip"]],
  ["Masses", ["M1", "M1"], ["M2", "M2"], ["M3", "M3"], ["M4", "M4"], ["M5", "M5"], ["M6", "M6"]],
];
export const keyResults = rows.flatMap(([, ...lines]) => lines);

/** Numbers of a quick answer by name; the critical speeds are among them. */
export function numbersOf(quick) {
  const out = {};
  for (const r of (quick && quick.results) || [])
    out[r.name] = { value: r.value === null ? NaN : r.value, unit: r.unit };
  for (const s of (quick && quick.speeds) || [])
    if (s.critical !== null)
      out[`critical_speed.${s.pass}`] = { value: s.critical, unit: "m/s" };
  return out;
}

// -- check -------------------------------------------------------------------------------------------------------
function drawCheck() {
  const { problems, facts } = studio.check, errors = problems.filter(p => p.severity === "error");
  const state = byId("state"), remarks = problems.length - errors.length;
  state.dataset.state = errors.length ? "error" : remarks ? "warning" : "good";
  state.textContent = errors.length ? `${errors.length} ${errors.length === 1 ? "error" : "errors"}: the case cannot be computed yet.`
    : remarks ? `No errors, ${remarks} ${remarks === 1 ? "remark" : "remarks"}.` : "No errors.";
  byId("problems").replaceChildren(...problems.map(p => {
    const item = make("li", {}, make("span", { className: p.severity, textContent: `${p.severity}: ` }), p.message);
    if (p.key) {
      const go = make("button", { textContent: p.key, title: "to the value" });
      go.addEventListener("click", () => jump(p.key));
      item.prepend(go);
    }
    return item;
  }));
  byId("facts").replaceChildren(...facts.map(text => make("li", { textContent: text })));
  byId("facts-box").hidden = facts.length === 0;
  byId("run").disabled = errors.length > 0 || running;
  old();
}

// -- quick answer --------------------------------------------------------------------------------------------------
function drawQuick() {
  const quick = studio.quick;
  byId("quick-note").textContent = quick && quick.seconds ? `closed forms, ${Math.round(1000 * quick.seconds)} ms` : "closed forms";
  if (quick.error) {
    byId("quick").replaceChildren(make("p", { textContent: quick.error }));
    byId("moves").replaceChildren();
    return old();
  }
  const now = numbersOf(quick), base = studio.base ? numbersOf(studio.base.quick) : {};
  const speeds = quick.speeds.map((s, i) => {
    const box = make("p", { className: "speed", textContent: named(quick.speeds, s) });
    box.dataset.finding = s.finding;
    const before = base[`critical_speed.${s.pass}`];
    if (before && s.critical !== null)
      box.append(` Since ${studio.base.name}: ${change(s.critical, before.value)}.`);
    for (const key of s.missing) {
      const go = make("button", { textContent: key });
      go.addEventListener("click", () => jump(key.replace(/^pass\./, `pass.${i}.`)));
      box.append(" ", go);
    }
    return box;
  });
  const table = make("table", {}, make("thead", {}, make("tr", {}, make("th", { textContent: "result" }), make("th", { textContent: "value" }),
    make("th", { textContent: studio.base ? `since ${studio.base.name}` : "" }))));
  const body = make("tbody");
  for (const [group, ...lines] of rows) {
    const present = lines.filter(([name]) => now[name] && Number.isFinite(now[name].value));
    if (!present.length)
      continue;
    body.append(make("tr", { className: "group" }, make("th", { textContent: group, colSpan: 3 })));
    for (const [name, label] of present) {
      const line = make("tr", {}, make("td", { textContent: label, title: name }), make("td", { textContent: digits(now[name].value, now[name].unit) }),
        make("td", { textContent: base[name] ? change(now[name].value, base[name].value) : "" }));
      line.dataset.name = name;
      body.append(line);
    }
  }
  table.append(body);
  if (!body.children.length)
    for (const r of quick.results.slice(0, 24))
      body.append(make("tr", {}, make("td", { textContent: r.name, title: r.meaning }), make("td", { textContent: r.value === null ? "–" : digits(r.value, r.unit) }), make("td", {})));
  byId("quick").replaceChildren(...speeds, table);
  const kinds = { gap_first_kind: "the gap mode, first kind,", gap_second_kind: "the gap mode, second kind," };
  const moves = quick.moves.filter(m => m.mode === "gap_first_kind").slice(0, 4)
    .map(m => `1 % of ${m.input} moves ${kinds[m.mode]} by ${signed(m.slope)} %.`);
  for (const s of quick.speeds.slice(0, 1))
    for (const input of s.inputs.filter(i => i.slope !== null).slice(0, 5))
      moves.push(`1 % of ${input.name.replace(/_/g, " ")} moves the critical speed by ${signed(input.slope)} %.`);
  byId("moves").replaceChildren(...moves.map(text => make("li", { textContent: text })));
  old();
}

// An answer to an earlier state is grey until the new one is here.
function old() {
  const grey = isOld(studio.quick);
  byId("quick").classList.toggle("old", grey);
  byId("moves").classList.toggle("old", grey);
  byId("answer-note").textContent = grey && studio.check ? "of an earlier state" : "";
}

// -- finite elements -----------------------------------------------------------------------------------------------
let running = false, lastRun = "";

export function drawJob(job) {
  running = job.status === "running";
  byId("cancel").hidden = !running;
  byId("run-progress").hidden = !running;
  byId("run-progress").value = job.percent;
  byId("run").disabled = running || !studio.check || studio.check.problems.some(p => p.severity === "error");
  const left = job.left >= 0 ? `, about ${job.left < 90 ? `${Math.ceil(job.left)} s` : `${Math.ceil(job.left / 60)} min`} left` : "";
  byId("run-note").textContent = running ? `${job.percent} %, ${job.stage}${left}` : job.status ? `${job.id}: ${job.status}${job.seconds ? ` after ${Math.round(job.seconds)} s` : ""}` : "";
  if (job.status === "failed")
    byId("run-answer").replaceChildren(make("pre", { textContent: job.printed }));
  if (job.status !== "done")
    return;
  if (job.id.startsWith("run-")) {
    reread().catch(() => {});  // pins of this state have a run now
    showRun(job.id).catch(error => banner(error.message, 6000));
  } else {
    offerExport(job);
  }
}

function offerExport(job) {
  const file = job.file;
  byId("export-answer").replaceChildren(make("p", {}, make("a", { id: "download", href: address(`/run/${job.id}/${file}`), download: file, textContent: `Download ${file}` })));
}

export function openReport(path, title) {
  byId("report-title").textContent = title;
  byId("report-frame").src = address(path);
  byId("report-link").href = address(path);
  byId("report-box").showModal();
}

export async function showRun(id) {
  const [results, manifest] = await Promise.all([ask(`/run/${id}/results.json`), ask(`/run/${id}/run.json`)]);
  lastRun = id;
  const run = {};
  for (const [name, p] of Object.entries(results.values || {}))
    if (p && typeof p === "object" && "value" in p)
      run[name] = p;
  const quick = numbersOf(studio.quick);
  const speeds = (manifest.critical_speed || []).map(s => make("p", { className: "speed", textContent: named(manifest.critical_speed, s) }));
  const body = make("tbody");
  const lines = [...keyResults];
  for (const [name, label] of lines) {
    const found = run[name] || run[`${name}.tangent`] || run[`${name}.combined`];
    if (!found || typeof found.value !== "number")
      continue;
    const six = (found.checks || []).find(check => check.name === "six masses"), cell = make("td");
    if (quick[name])
      cell.append(change((six || found).value, quick[name].value), ...(six ? [make("br"), make("small", { textContent: `six masses ${digits(six.value, found.unit)}` })] : []));
    body.append(make("tr", {}, make("td", { textContent: label, title: name }), make("td", { textContent: digits(found.value, found.unit) }), cell));
  }
  const detailed = (run["mode.gap_first_kind.frequency"] || {}).source || "", rolls = /rolls as [^;]*$/.exec(detailed);
  const why = make("p", { className: "why", textContent: rolls ? `Gap modes of the run: ${rolls[0]}. The quick answer has six rigid masses and is held against the six masses of the run.` : "" });
  const open = make("button", { textContent: "Show the report", id: "show-report" });
  open.addEventListener("click", () => openReport(`/run/${id}/report.html`, `Report of ${id}`));
  byId("run-answer").replaceChildren(...speeds, make("p", { textContent: results.status && results.status !== "ok" ? `The run ended with status ${results.status}.` : "" }),
    make("table", {}, make("thead", {}, make("tr", {}, make("th", { textContent: id }), make("th", { textContent: "finite elements" }), make("th", { textContent: "against quick" }))), body), why, open);
}

const shownRun = () => lastRun || studio.document.run;

export function chooseExport() {
  const errors = !studio.check || studio.check.problems.some(p => p.severity === "error");
  byId("export-box").querySelectorAll(".choices button").forEach(button => { button.disabled = button.value === "page" ? !shownRun() : errors || running; });
  byId("export-page").title = shownRun() ? "" : "press Run first: the page is that of a run";
  byId("export-box").returnValue = "";
  byId("export-box").showModal();
}

export async function startRun(what = "run") {
  try {
    await ask("/run", { what });
  } catch (error) {
    banner(error.message, 6000);
  }
}

export function begin() {
  on("check", drawCheck);
  on("typed", old);
  on("quick", drawQuick);
  on("base", () => studio.quick && drawQuick());
  on("run", drawJob);
  byId("run").addEventListener("click", () => startRun());
  byId("cancel").addEventListener("click", () => startRun("cancel"));
  byId("export").addEventListener("click", chooseExport);
  byId("export-box").addEventListener("close", () => {
    const what = byId("export-box").returnValue;
    if (what === "page")
      openReport(`/run/${shownRun()}/report.html`, `Report of ${shownRun()}`);
    else if (what)
      startRun(what);
  });
  byId("save").addEventListener("click", save);
}

export async function save() {
  try {
    await edit({ op: "hello" });  // what waits is sent first
    await ask("/save", {});
    banner("Saved.", 1500);
    await reread();
  } catch (error) {
    banner(error.message, 8000);
  }
}
