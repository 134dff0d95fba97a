// What the page knows, and its talk with the program.  Edits wait here until the program has taken them, over a
// reload and over an end of the program too.
const token = decodeURIComponent(location.hash.slice(1));
const own = Math.random().toString(36).slice(2, 10);
const store = "millstand-studio-edits/";
const mostSent = 200;  // edits of one request

export const studio = {
  schema: null, document: null,
  values: {},       // as the case has them: full key -> text
  typed: {},        // what is typed and not yet taken: full key -> text or null
  check: null,      // answer of /check
  quick: null,      // answer of /quick
  geometry: null,   // m, of the last case without errors
  base: null,       // results of the last pin, for changes
  link: "waiting",
};

const listeners = {};
export function on(event, listener) {
  (listeners[event] = listeners[event] || []).push(listener);
}
export function tell(event, data) {
  (listeners[event] || []).forEach(listener => listener(data));
}

export const byId = id => document.getElementById(id);

/** An element with attributes and children; text only, never HTML. */
export function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (key in element && key !== "list" && key !== "form") element[key] = value;
    else element.setAttribute(key, value);
  element.append(...children);
  return element;
}

export const address = path => `${path}?token=${encodeURIComponent(token)}`;

export async function ask(path, body, keepalive = false) {
  const options = { headers: { "X-Millstand-Token": token }, keepalive };
  if (body !== undefined) {
    options.method = "POST";
    options.headers["Content-Type"] = "application/json";
    options.body = JSON.stringify(body);
  }
  let answer;
  try {
    answer = await fetch(path, options);
  } catch {
    link("lost");
    throw new Error("the program does not answer");
  }
  const json = await answer.json().catch(() => ({}));
  if (!answer.ok)
    throw Object.assign(new Error(json.error || `refused (${answer.status})`), { answer: json, status: answer.status });
  return json;
}

let bannerTimer = 0;
export function banner(text, milliseconds = 0) {
  clearTimeout(bannerTimer);
  byId("banner").hidden = !text;
  byId("banner").textContent = text;
  if (milliseconds)
    bannerTimer = setTimeout(() => link(studio.link), milliseconds);
}

export function link(state) {
  const again = state === "open" && studio.link === "lost";
  studio.link = state;
  document.body.dataset.link = state;
  banner(state === "lost" ? "The program does not answer. What you type is kept here and sent when it is back: start millstand studio again." : "");
  if (again)
    tell("back");
}

// -- edits -------------------------------------------------------------------------------------------------------
// Each edit has an entry of its own, named by the case and its id, so that windows and cases of one address do not
// overwrite each other.  What a window that was closed has left is sent by the next window of its case.
let waiting = [];  // edits of this case: id, key, value, time; sent: on its way
let number = 0, timer = 0, busy = false, again = false, mine = null;

function keep(edit) {
  if (mine)
    localStorage.setItem(mine + edit.id, JSON.stringify({ key: edit.key, value: edit.value, time: edit.time }));
}
function forget(edit) {
  if (mine)
    localStorage.removeItem(mine + edit.id);
}
function takeWhatWaits() {
  mine = `${store}${encodeURIComponent(studio.document.case)}/${token}/`;
  const left = [];
  for (let i = 0; i < localStorage.length; ++i) {
    const name = localStorage.key(i);
    if (name.startsWith(mine))
      left.push({ id: name.slice(mine.length), ...JSON.parse(localStorage.getItem(name)) });
  }
  left.sort((a, b) => a.time - b.time);
  waiting = [...left, ...waiting];
  waiting.forEach(edit => { studio.typed[edit.key] = edit.value; });
}

/** A value was typed; null takes the line out of the case. */
export function type(key, value) {
  studio.typed[key] = value;
  waiting.filter(edit => edit.key === key && !edit.sent).forEach(forget);
  waiting = waiting.filter(edit => edit.key !== key || edit.sent);
  const edit = { id: `${own}-${++number}`, key, value, time: Date.now() };
  waiting.push(edit);
  keep(edit);
  tell("typed", key);
  clearTimeout(timer);
  timer = setTimeout(flush, 150);
}

/** Sends what waits, then asks what the case means. */
export async function flush() {
  clearTimeout(timer);
  if (busy) {
    again = true;
    return;
  }
  busy = true;
  const edits = waiting.slice(0, mostSent);
  edits.forEach(edit => { edit.sent = true; });
  let went = true;
  try {
    const answer = await ask("/check", request(edits));
    taken(edits);
    sayRefused(edits, answer.refused);
    takeCheck(answer);
  } catch (error) {
    went = false;
    if (error.status === 400) {  // what the program refuses once it refuses again
      went = true;
      taken(edits);
      banner(error.message, 8000);
      sayRefused(edits, error.answer.refused || []);
      reread().catch(() => {});
    }
  }
  busy = false;
  if (again || (went && waiting.some(edit => !edit.sent))) {
    again = false;
    return flush();
  }
  askQuick();
}

function request(edits) {
  return { by: own, edits: edits.map(({ id, key, value }) => ({ id, key, value })) };
}

function taken(edits) {
  waiting = waiting.filter(edit => !edits.includes(edit));
  for (const edit of edits) {
    forget(edit);
    if (!waiting.some(other => other.key === edit.key))
      delete studio.typed[edit.key];
  }
}

function sayRefused(edits, refused) {
  const sentences = refused.map(({ id, error }) => {
    const edit = edits.find(one => one.id === id);
    return edit ? `${edit.key}: ${error}` : error;
  });
  if (sentences.length)
    banner(`Not taken: ${sentences.join("; ")}`, 8000);
}

export const unsent = () => waiting.length;

function takeCheck(answer) {
  studio.check = answer;
  studio.values = answer.values;
  if (answer.geometry)
    studio.geometry = answer.geometry;
  Object.assign(studio.document, { revision: answer.revision, saved: answer.saved, undo: answer.undo, redo: answer.redo });
  tell("check");
}

// -- quick answer ------------------------------------------------------------------------------------------------
let quickBusy = false;
async function askQuick() {
  if (quickBusy || unsent() || !studio.check || studio.check.problems.some(p => p.severity === "error"))
    return;
  if (studio.quick && studio.quick.revision === studio.document.revision)
    return;
  quickBusy = true;
  try {
    studio.quick = await ask("/quick", {});
    tell("quick");
  } catch { /* the link says it */ }
  quickBusy = false;
  if (studio.quick && studio.quick.revision !== studio.document.revision)
    askQuick();
}

/** True while the answer belongs to an earlier state of the case. */
export function isOld(answer) {
  return !answer || unsent() > 0 || answer.revision !== studio.document.revision;
}

// -- the document ------------------------------------------------------------------------------------------------
export function takeDocument(answer) {
  studio.document = answer;
  studio.values = answer.values;
  if (!mine)
    takeWhatWaits();
  tell("document");
}

export async function reread() {
  takeDocument(await ask("/document"));
  return flush();
}

/** undo, redo, pin ..: {op, ..}; @throws Error with the words of the program */
export async function edit(request) {
  if (unsent())
    await flush();
  takeDocument(await ask("/edit", { by: own, ...request }));
  await flush();
}

// -- events ------------------------------------------------------------------------------------------------------
let source = null;
export function listen() {
  if (source)
    source.close();
  source = new EventSource(address("/events"));
  source.onopen = () => {
    link("open");
    ask("/edit", { op: "hello" }).catch(() => {});
  };
  source.onerror = () => {
    link("lost");
    if (source.readyState === EventSource.CLOSED)
      setTimeout(listen, 1000);
  };
  source.addEventListener("document", event => {
    const data = JSON.parse(event.data);
    if (data.by !== own && studio.document && data.revision !== studio.document.revision)
      reread().catch(() => {});
  });
  source.addEventListener("run", event => tell("run", JSON.parse(event.data)));
  source.addEventListener("windows", event => tell("windows", JSON.parse(event.data)));
}

addEventListener("pagehide", () => {
  if (waiting.length)
    ask("/check", request(waiting.slice(0, mostSent)), true).catch(() => {});
});
