// Connection, keys and the order in which things are drawn.
import { colour, floats, plain, readColours } from "./canvas.js";
import { SpectrumChart, Waterfall } from "./charts.js";
import { TraceChart, drawShares, drawWave } from "./histories.js";
import { StandView } from "./stand.js";
import { Sliders, fillAccount, fillAdvice, fillAlarms, fillLevels, fillModes } from "./tables.js";
import { active, beginning, clock, drawAnswers, loudest, takeBands, tell } from "./answers.js";

const byId = id => document.getElementById(id);
const token = decodeURIComponent(location.hash.slice(1));

/** The last data of each event of the program. */
const mill = {
  link: "waiting", stale: false, stand: null, numbers: null, levels: null, spectrum: null, account: null, modes: null,
  chatter: null, parameters: null, advice: null, alarms: new Map(), proposals: new Map(), history: [],
  label: name => { const place = mill.stand && mill.stand.places.find(p => p.place === name); return place ? place.label : name; },
};
const view = new StandView(byId("stand")), traces = new TraceChart(byId("traces"));
const spectrum = new SpectrumChart(byId("spectrum")), waterfall = new Waterfall(byId("waterfall"));
const sliders = new Sliders(byId("sliders"), send);
let changed = new Set();  // pictures and tables that have to be drawn again

// -- commands ---------------------------------------------------------------------------------------------------
async function send(command) {
  try {
    const answer = await fetch("/command", { method: "POST", body: JSON.stringify(command),
      headers: { "Content-Type": "application/json", "X-Millstand-Token": token } });
    const text = await answer.json().catch(() => ({}));
    if (!answer.ok)
      banner(text.error || `refused (${answer.status})`, 6000);
    return answer.ok;
  } catch {
    banner("the program does not answer; the command was not carried out", 6000);
    return false;
  }
}

let bannerTimer = 0;
function banner(text, milliseconds = 0) {
  clearTimeout(bannerTimer);
  byId("banner").hidden = !text;
  tell(byId("banner"), text);
  if (milliseconds)
    bannerTimer = setTimeout(() => link(mill.link, mill.linkWhy), milliseconds);
}

// -- events of the program --------------------------------------------------------------------------------------
const takes = {
  numbers(data) {
    if (!mill.numbers || mill.numbers.state !== data.state)
      mark("answers");
    data.measured.forEach((trace, i) => { if (trace.length && mill.stand && mill.stand.places[i] && !mill.stand.places[i].measured) seenMeasured(i); });
    mill.numbers = data;
    mill.heard = performance.now();
    view.setNumbers(data);
    traces.add(data);
    mark("stand", "traces", "facts");
  },
  motion(data) {
    mill.motion = { ...data, displacement: data.displacement.map(floats) };
    byId("slow").disabled = false;
  },
  levels(data) {
    mill.levels = data;
    remember(data.utc);
    mark("answers", "levels", "shares", "stand");
  },
  spectrum(data) {
    const chosen = mill.parameters && mill.parameters.place;
    if (chosen && data.place !== chosen && mill.spectrumPlace === chosen)
      return;  // of a place that is not shown
    mill.spectrum = { ...data, measured: floats(data.measured), simulated: floats(data.simulated), latest: floats(data.latest),
      wave_measured: floats(data.wave_measured), wave_simulated: floats(data.wave_simulated) };
    if (mill.spectrumPlace !== data.place)
      waterfall.clear();
    mill.spectrumPlace = data.place;
    waterfall.add(mill.spectrum.latest, data.df, data.utc);
    spectrum.set(mill.spectrum);
    mark("spectrum", "wave", "place");
  },
  account(data) {
    if (!mill.account || mill.account.forgotten !== data.forgotten)
      mark("alarms");
    mill.account = data;
    mark("account", "facts", "answers");
  },
  modes(data) { mill.modes = data; mark("modes", "answers"); },
  chatter(data) { mill.chatter = data; takeBands(mill, data); mark("answers"); },
  alarm(data) { takeEntry(mill.alarms, data, entry => entry.over); mark("alarms", "answers"); },
  proposal(data) { takeEntry(mill.proposals, data, entry => entry.state !== "open"); mark("alarms", "answers"); },
  parameters(data) {
    mill.parameters = data;
    readStand().catch(() => {});  // a source may have said what it measures
    sliders.take(data);
    view.moved = new Set(data.sliders.filter(p => Math.abs(p.factor - 1) > 1e-9).map(p => p.key));
    mark("modes", "answers", "spectrum", "place", "stand");
  },
  advice(data) { mill.advice = data; mark("advice"); },
};

// As the program keeps them (event_frames.cpp): the latest 200 changes, and what is open whatever its age.
function takeEntry(entries, data, isOver) {
  entries.delete(data.id);
  entries.set(data.id, data);
  if (entries.size <= 200)
    return;
  const over = [...entries.values()].find(isOver);
  if (over || entries.size > 1000)
    entries.delete((over || entries.values().next().value).id);
}

function mark(...names) {
  names.forEach(name => changed.add(name));
}

// Ten minutes of the level, one point a second, kept over a reload of the page.
function remember(utc) {
  const now = loudest(mill), last = mill.history[mill.history.length - 1];
  if (!now)
    return;
  if (last && utc < last.utc)
    mill.history = [];
  if (!last || utc > last.utc)
    mill.history.push({ utc, ratio: now.ratio });
  while (mill.history.length && mill.history[0].utc < utc - 600)
    mill.history.shift();
}

// -- connection -------------------------------------------------------------------------------------------------
let source = null, retry = 0;

function link(state, why = "") {
  mill.link = state;
  mill.linkWhy = why;
  document.body.dataset.link = state === "open" ? "open" : state === "waiting" ? "waiting" : "lost";
  banner(why);
  mark("facts", "answers");
}

async function readStand() {
  const answer = await fetch("/stand", { headers: { "X-Millstand-Token": token } });
  if (!answer.ok)
    throw new Error((await answer.json().catch(() => ({}))).error || `refused (${answer.status})`);
  const text = await answer.text();
  if (text === mill.standText)
    return;
  const stand = JSON.parse(text);
  mill.standText = text;
  mill.stand = stand;
  view.setStand(stand);
  sliders.set(stand);
  tell(byId("stand-name"), stand.name || "millstand live");
  document.title = `${stand.name || "millstand"} live`;
  tell(byId("sliders-note"), `${stand.source}${stand.version ? `; millstand ${stand.version}` : ""}`);
  if (mill.parameters)
    takes.parameters(mill.parameters);
  listPlaces();
  mark("stand", "modes", "traces");
}

function listPlaces() {
  const chosen = byId("place").value;
  byId("place").replaceChildren(...mill.stand.places.map(place => new Option(`${place.label}${place.measured ? "" : " (twin only)"}`, place.place)));
  byId("place").value = chosen || mill.spectrumPlace || "";
}

// Which places have a sensor shows with the first data of the source.
function seenMeasured(index) {
  mill.stand.places[index].measured = true;
  listPlaces();
  mark("stand", "traces", "answers");
}

// The stand is read first, then the events that move it.
async function connect() {
  clearTimeout(retry);
  if (!token) {
    link("lost", "this address has no token: open the address that millstand live printed, with everything after the #");
    return;
  }
  try {
    await readStand();
  } catch (failure) {
    return again(failure instanceof TypeError ? "" : failure.message);
  }
  source = new EventSource(`/events?token=${encodeURIComponent(token)}`);
  // A new connection begins with the present state, of a program that may have been started again.
  source.onopen = async () => {
    mill.alarms.clear();
    mill.proposals.clear();
    mark("alarms");
    try {
      await readStand();
      link("open");
    } catch (failure) {
      again(failure.message);
    }
  };
  source.onerror = () => {
    if (source.readyState === EventSource.CLOSED)
      refused();  // the browser does not try again
    else
      lost();
  };
  for (const name of Object.keys(takes))
    source.addEventListener(name, event => safely(takes[name], JSON.parse(event.data)));
}

// An event of another program version may not fit; the page goes on with the other events.
function safely(take, data) {
  try {
    take(data);
  } catch (failure) {
    mill.misfit = String(failure);
  }
}

// A page that was just opened is connecting; only after some seconds, or with a reason, is that a failure.
const patience = 5000;  // ms
function lost(why = "") {
  if (!why && mill.link === "waiting" && performance.now() < patience)
    return;
  if (mill.link !== "lost")
    mill.lostAt = Date.now() / 1000;
  link("lost", why || `no connection to millstand live since ${clock(mill.lostAt)} UTC; trying again every second`);
}

// A stream does not say why it was refused; the answer to an ordinary request does.
async function refused() {
  const answer = await fetch(`/events?token=${encodeURIComponent(token)}`).catch(() => null);
  const why = answer && !answer.ok ? (await answer.json().catch(() => ({}))).error : "";
  if (answer && answer.ok)
    answer.body.cancel();
  again(why);
}

function again(why) {
  if (source)
    source.close();
  lost(why);
  clearTimeout(retry);
  retry = setTimeout(connect, 1000);
}

// -- drawing ----------------------------------------------------------------------------------------------------
const draws = {
  stand() {
    const levels = mill.stand ? mill.stand.places.map((place, i) => {
      const found = mill.levels && mill.levels.places.find(p => p.place === place.place);
      return { measured: found ? found.measured[0] : null, simulated: found && found.simulated[0] !== null ? found.simulated[0] : mill.numbers ? mill.numbers.acceleration[i] : null };
    }) : [];
    view.draw(performance.now(), levels);
    const slow = view.slow && view.motion ? `, ${plain(view.slowFactor(), 2)} × slower` : "";
    tell(byId("stand-amplification"), `motion × ${String(Math.round(view.amplification)).replace(/\B(?=(\d{3})+$)/g, " ")}${slow}`);
    tell(byId("stand-note"), `to scale${view.shape && !view.shape.drawn ? " by masses" : ""}; rms in m/s²`);
  },
  traces() {
    if (!mill.stand)
      return;
    const measured = mill.stand.places.map((place, index) => ({ index, label: place.label, measured: place.measured }));
    const wanted = measured.filter(lane => lane.measured), rolls = measured.filter(lane => /work/.test(lane.label));
    const lanes = (wanted.length ? wanted : rolls.length ? rolls : measured).slice(0, 2);
    traces.draw(lanes);
    tell(byId("traces-note"), "m/s², lowest and highest of each instant");
  },
  answers() {
    drawAnswers(mill, send);
    const worst = active(mill).filter(alarm => !alarm.acknowledged).sort((a, b) => (a.level === "alarm" ? 0 : 1) - (b.level === "alarm" ? 0 : 1) || b.utc - a.utc)[0];
    const box = byId("alarm-banner");
    box.hidden = !worst;
    document.body.dataset.alarm = worst ? "yes" : "no";
    mill.worst = worst;
    if (worst) {
      box.dataset.level = worst.level;
      tell(byId("alarm-word"), worst.level);
      tell(byId("alarm-text"), `${clock(worst.utc)} ${beginning(worst.text)}`);
      byId("alarm-text").title = worst.text;
    }
  },
  facts() {
    const n = mill.numbers, state = mill.link === "waiting" ? "connecting" : mill.link !== "open" ? "lost" : mill.stale ? "no data" : n ? n.state : "waiting";
    byId("run-state").dataset.state = state === "no data" ? "gap" : state;
    tell(byId("run-state"), state === "lost" ? "no link" : state);
    tell(byId("fact-speed"), n && n.speed !== null ? `${plain(n.speed)} m/s` : "–");
    tell(byId("fact-force"), n && n.force !== null ? `${(n.force / 1000).toFixed(n.force >= 1e5 ? 0 : 1)} kN` : "–");
    tell(byId("fact-time"), n ? `${clock(n.utc)} UTC` : "–");
    tell(byId("fact-recording"), mill.account ? (mill.account.trouble || (mill.account.recording ? "on" : "off")) : "–");
  },
  spectrum() {
    spectrum.modes = (mill.parameters && mill.parameters.frequencies) || (mill.stand ? mill.stand.modes.map(mode => mode.frequency) : []);
    spectrum.draw();
    waterfall.draw(spectrum.range, spectrum.modes);
    const data = mill.spectrum;
    if (!data)
      return;
    const peaks = [["measured", spectrum.canvas.dataset.peakMeasured], ["twin", spectrum.canvas.dataset.peakSimulated]]
      .filter(entry => entry[1]).map(([name, f]) => `${name} ${plain(Number(f), 4)}`).join(", ");
    tell(byId("spectrum-note"), `${peaks ? `highest ${peaks} Hz; ` : ""}m/s² per √Hz, ${data.window === "none" ? "no window" : `${data.window} window`}, ${data.segments === 1 ? "1 segment" : `${data.segments} segments`}, ENBW ${plain(data.enbw, 3)} Hz`);
    tell(byId("waterfall-note"), `${data.measured.length ? "measured" : "simulated"}; three decades`);
  },
  wave() {
    const data = mill.spectrum;
    drawWave(byId("wave"), data ? data.wave_step : 0, data ? data.wave_measured : [], data ? data.wave_simulated : []);
    tell(byId("wave-note"), data && data.wave_step ? `${mill.label(data.place)}, m/s²` : "");
  },
  shares() {
    const place = mill.levels && mill.levels.places.find(p => p.place === mill.spectrumPlace);
    drawShares(byId("unlike"), place ? place.incoherent : []);
  },
  place() {
    const place = mill.spectrumPlace || (mill.parameters && mill.parameters.place);
    if (place && document.activeElement !== byId("place"))
      byId("place").value = place;
    mark("shares");
  },
  levels: () => fillLevels(mill), account: () => fillAccount(mill), alarms: () => fillAlarms(mill, send), modes: () => fillModes(mill), advice: () => fillAdvice(mill),
};

function frame(now) {
  requestAnimationFrame(frame);
  const stale = mill.link === "open" && mill.heard !== undefined && performance.now() - mill.heard > 3000;
  if (stale !== mill.stale) {
    mill.stale = stale;
    mark("facts", "answers");
  }
  if (mill.motion && (!view.motion || now - view.motionBegan > 4000)) {
    if (view.motion !== mill.motion)
      view.setMotion(mill.motion, now);
  }
  if (view.slow && view.motion)
    changed.add("stand");
  const now_drawn = changed;
  changed = new Set();
  for (const name of now_drawn)
    draws[name]();
}

// -- keys and buttons -------------------------------------------------------------------------------------------
function show(screen) {
  document.body.dataset.screen = screen;
  for (const name of ["operator", "engineer"]) {
    byId(name).hidden = name !== screen;
    byId(`show-${name}`).setAttribute("aria-pressed", String(name === screen));
  }
  keep("screen", screen);
  mark(...Object.keys(draws));
}

function tab(name) {
  for (const button of document.querySelectorAll('[role="tab"]')) {
    const chosen = button.dataset.tab === name;
    button.setAttribute("aria-selected", String(chosen));
    button.tabIndex = chosen ? 0 : -1;
    byId(`tab-${button.dataset.tab}`).hidden = !chosen;
  }
  keep("tab", name);
}

function theme(name) {
  if (name)
    document.documentElement.dataset.theme = name;
  readColours();
  mark(...Object.keys(draws));
}

function otherTheme() {
  const dark = colour("paper").match(/[\d.]+/g).slice(0, 3).reduce((sum, v) => sum + Number(v), 0) < (colour("paper").startsWith("color(") ? 1.5 : 380);
  const name = dark ? "light" : "dark";
  keep("theme", name);
  theme(name);
}

function slow() {
  if (byId("slow").disabled)
    return;
  view.slow = !view.slow;
  byId("slow").setAttribute("aria-pressed", String(view.slow));
  mark("stand");
}

function nextPlace() {
  const select = byId("place");
  if (select.options.length) {
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    send({ command: "place", place: select.value });
  }
}

const seen = () => { if (mill.worst) send({ command: "acknowledge", id: mill.worst.id }); };
const size = direction => { direction ? view.step(direction) : view.automatic(); mark("stand"); };

// Private windows may refuse to keep anything.
function keep(name, value) { try { localStorage.setItem(`millstand.${name}`, value); } catch { /* then not */ } }
function kept(name) { try { return localStorage.getItem(`millstand.${name}`); } catch { return null; } }

const keys = {
  1: () => show("operator"), 2: () => show("engineer"), t: otherTheme, m: slow, a: seen, p: nextPlace, r: () => { sliders.release(); send({ command: "reset" }); },
  "+": () => size(1), "=": () => size(1), "-": () => size(-1), 0: () => size(0), "?": () => byId("keys").showModal(),
};
document.addEventListener("keydown", event => {
  const does = keys[event.key.length === 1 ? event.key.toLowerCase() : ""];
  if (!does || event.ctrlKey || event.altKey || event.metaKey || byId("keys").open || event.target.tagName === "SELECT")
    return;
  event.preventDefault();
  does();
});
byId("tabs").addEventListener("keydown", event => {
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key], all = [...document.querySelectorAll('[role="tab"]')];
  if (step) {
    const next = all[(all.indexOf(document.activeElement) + step + all.length) % all.length];
    tab(next.dataset.tab);
    next.focus();
  }
});
for (const [id, does] of [["show-operator", keys[1]], ["show-engineer", keys[2]], ["theme", otherTheme], ["help", keys["?"]], ["less", () => size(-1)],
  ["more", () => size(1)], ["auto", () => size(0)], ["slow", slow], ["alarm-seen", seen], ["reset", keys.r], ["ask-advice", () => send({ command: "advice" })]])
  byId(id).addEventListener("click", does);
for (const button of document.querySelectorAll('[role="tab"]'))
  button.addEventListener("click", () => tab(button.dataset.tab));
byId("place").addEventListener("change", () => send({ command: "place", place: byId("place").value }));
spectrum.onRange = () => mark("spectrum");
// A new line of alarm or another window size changes the size of a canvas.
const room = new ResizeObserver(() => mark(...Object.keys(draws)));
document.querySelectorAll("canvas").forEach(canvas => room.observe(canvas));
window.addEventListener("hashchange", () => location.reload());
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => theme());
window.addEventListener("pagehide", () => { try { sessionStorage.setItem("millstand.history", JSON.stringify(mill.history)); } catch { /* then not */ } });
try {
  mill.history = JSON.parse(sessionStorage.getItem("millstand.history")) || [];
} catch { /* begins empty */ }

byId("slow").disabled = true;
theme(kept("theme"));
show(kept("screen") === "engineer" ? "engineer" : "operator");
tab(kept("tab") || "levels");
connect();
requestAnimationFrame(frame);
