// Beginning, keys and boxes of the page.
import { ask, banner, byId, edit, flush, listen, make, on, reread, studio, takeDocument } from "./state.js";
import * as answers from "./answers.js";
import * as drawing from "./drawing.js";
import * as fields from "./fields.js";
import * as variants from "./variants.js";

function drawHead() {
  const d = studio.document, name = d.path.replace(/^.*\//, "");
  document.title = `${d.saved ? "" : "● "}${name} · millstand studio`;
  byId("case-name").textContent = d.path;
  byId("saved").textContent = d.saved ? "saved" : "not saved";
  byId("saved").dataset.state = d.saved ? "saved" : "open";
  byId("undo").disabled = d.undo === 0;
  byId("redo").disabled = d.redo === 0;
}

const step = op => edit({ op }).catch(error => banner(error.message, 6000));

function keys(event) {
  const control = event.ctrlKey || event.metaKey;
  if (!control || document.querySelector("dialog[open]"))
    return;
  const key = event.key.toLowerCase();
  const action = key === "s" ? answers.save : key === "z" && !event.shiftKey ? () => step("undo") : key === "y" || (key === "z" && event.shiftKey) ? () => step("redo")
    : key === "enter" ? () => byId("run").click() : key === "k" ? () => byId("search").focus() : key === "e" ? answers.chooseExport : null;
  if (action) {
    event.preventDefault();
    action();
  }
}

async function takeImport() {
  const text = byId("import-text").value, file = byId("import-file").files[0];
  const isCase = file ? /\.toml$/i.test(file.name) : /^\s*\[?[A-Za-z_]+\s*=|^\s*\[[a-z_.\[]+\]/m.test(text);
  try {
    await edit({ op: "import", as: isCase ? "case" : "sheet", text, name: file ? file.name : "" });
    byId("import-box").close();
    byId("import-text").value = "";
    byId("import-file").value = "";
    banner("Taken over; Undo brings the state before back.", 5000);
  } catch (error) {
    const problems = (error.answer && error.answer.problems) || [{ line: 0, message: error.message }];
    byId("import-errors").replaceChildren(...problems.map(p => make("li", { textContent: `${p.line ? `line ${p.line}: ` : ""}${p.message}` })));
  }
}

function beginBoxes() {
  byId("import").addEventListener("click", () => { byId("import-errors").replaceChildren(); byId("import-box").showModal(); });
  byId("import-take").addEventListener("click", takeImport);
  byId("import-file").addEventListener("change", async () => {
    const file = byId("import-file").files[0];
    if (file)
      byId("import-text").value = await file.text();
  });
  byId("help").addEventListener("click", () => byId("help-box").showModal());
  byId("report-box").addEventListener("close", () => { byId("report-frame").removeAttribute("src"); });
  byId("theme").addEventListener("click", () => {
    const dark = getComputedStyle(document.documentElement).colorScheme.includes("dark") && (document.documentElement.dataset.theme === "dark" ||
      (!document.documentElement.dataset.theme && matchMedia("(prefers-color-scheme: dark)").matches));
    document.documentElement.dataset.theme = dark ? "light" : "dark";
    localStorage.setItem("millstand-theme", document.documentElement.dataset.theme);
  });
  const theme = localStorage.getItem("millstand-theme");
  if (theme)
    document.documentElement.dataset.theme = theme;
}

async function begin() {
  beginBoxes();
  byId("undo").addEventListener("click", () => step("undo"));
  byId("redo").addEventListener("click", () => step("redo"));
  addEventListener("keydown", keys);
  on("document", drawHead);
  on("check", () => {
    if (studio.values.kind && studio.values.kind !== studio.schema.kind && !studio.check.problems.some(p => p.key === "kind"))
      location.reload();  // another kind has other rows
    drawHead();
  });
  on("back", () => reread().catch(() => {}));
  on("windows", data => {
    if (data.open > 1)
      banner(`This case is open in ${data.open} windows; what one of them changes, all show.`, 8000);
  });
  try {
    const [schema, first] = await Promise.all([ask("/schema"), ask("/document")]);
    studio.schema = schema;
    [fields, drawing, answers, variants].forEach(part => part.begin());
    takeDocument(first);
    if (first.notice)
      banner(first.notice, 8000);
    await flush();
    listen();
    if (first.run)
      answers.showRun(first.run).catch(() => {});
    if (first.job.status === "running" || first.job.file)  // begun before a reload
      answers.drawJob(first.job);
    document.body.dataset.ready = "yes";
  } catch (error) {
    banner(error.status === 401 ? "This address has not the token of the running program; open the address that it printed." : error.message);
  }
}

begin();
