// The three answers of the first screen: is it quiet, how far from chatter, what changed.  No answer is given from
// data that is absent or old.
import { plain, whole } from "./canvas.js";
import { drawLevel, drawSpeeds } from "./histories.js";

const byId = id => document.getElementById(id);
export const clock = utc => utc > 0 ? new Date(utc * 1000).toISOString().slice(11, 19) : "–";
export const day = utc => utc > 0 ? new Date(utc * 1000).toISOString().slice(0, 19).replace("T", " ") : "–";
const percent = (share, digits = 0) => `${share < 0 ? "−" : "+"}${Math.abs(share * 100).toFixed(digits)} %`;

/** Sets a text only when it changes, so that screen readers and selections are left alone. */
export function tell(node, text) {
  if (node.textContent !== text)
    node.textContent = text;
}

function answer(tile, state, word, sentence) {
  const node = byId(`tile-${tile}`);
  if (node.dataset.state !== state)
    node.dataset.state = state;
  tell(byId(`${tile}-word`), word.charAt(0).toUpperCase() + word.slice(1));
  const say = byId(`${tile}-say`);
  if (say)
    tell(say, sentence);
}

/** Alarms and warnings whose cause is still there. */
export const active = mill => [...mill.alarms.values()].filter(alarm => !alarm.over && alarm.level !== "note");

const alarmRatio = mill => (mill.chatter && mill.chatter.alarm_ratio) || 5;

/** Whole clauses of a long text; the rest stands in the list of alarms. */
export function beginning(text, longest = 160) {
  if (text.length <= longest)
    return text;
  const clauses = text.split("; ");
  let kept = clauses.shift();
  while (clauses.length && kept.length + clauses[0].length + 2 <= longest)
    kept += `; ${clauses.shift()}`;
  return clauses.length ? `${kept} …` : kept;
}

/** Why there are no data to judge; null when there are data. */
function silence(mill) {
  if (mill.link === "waiting")
    return ["connecting", "waiting for the answer of the program"];
  if (mill.link !== "open")
    return ["no link", "the program does not answer"];
  const state = mill.numbers ? mill.numbers.state : "waiting";
  if (mill.stale)
    return ["no data", `nothing new since ${clock(mill.numbers && mill.numbers.utc)}`];
  return { waiting: ["no data", "waiting for the source"], gap: ["no data", "samples were lost; waiting for the next"],
    settling: ["settling", "two seconds after a gap nothing is judged"] }[state] || null;
}

// The amplitude of a narrow band varies by chance: of eight calm bands one is above twice its calm level every few
// seconds.  Its mean square over five events does so once in hours.
const swing = 0.2;

/** Takes the bands of an event into their mean squares. */
export function takeBands(mill, chatter) {
  const before = mill.bandSquares || new Map();
  mill.bandSquares = new Map();
  for (const band of chatter.bands)
    if (band.amplitude !== null && band.baseline > 0) {
      const key = `${band.name} ${band.frequency}`, square = (band.amplitude / band.baseline) ** 2, mean = before.get(key) ?? square;
      mill.bandSquares.set(key, mean + swing * (square - mean));
    }
}

/** Largest level over its calm level, of bands and places; null when no calm level is known.  What stands at the limit
    of an alarm takes effect at once. */
export function loudest(mill) {
  let best = null;
  const limit = alarmRatio(mill);
  for (const band of (mill.chatter && mill.chatter.bands) || []) {
    const square = mill.bandSquares && mill.bandSquares.get(`${band.name} ${band.frequency}`);
    if (square === undefined || band.amplitude === null || !(band.baseline > 0))
      continue;
    const now = band.amplitude / band.baseline, ratio = now >= limit ? now : Math.sqrt(square);
    if (!best || ratio > best.ratio)
      best = { ratio, of: `${band.name}${band.frequency ? `, ${plain(band.frequency, 3)} Hz` : ""}` };
  }
  for (const place of (mill.levels && mill.levels.places) || [])
    if (place.measured[0] !== null && place.baseline > 0 && (!best || place.measured[0] / place.baseline > best.ratio))
      best = { ratio: place.measured[0] / place.baseline, of: mill.label(place.place) };
  return best;
}

function quiet(mill) {
  const none = silence(mill), now = loudest(mill), limit = alarmRatio(mill);
  drawLevel(byId("quiet-gauge"), mill.history, limit);
  const alarms = active(mill).filter(alarm => alarm.kind === "chatter" || alarm.kind === "level");
  if (none)
    return answer("quiet", "unknown", none[0], none[1]);
  if (alarms.some(alarm => alarm.level === "alarm"))
    return answer("quiet", "bad", "alarm", alarms.find(alarm => alarm.level === "alarm").text);
  if (!now) {
    const measured = mill.stand && mill.stand.places.some(place => place.measured);
    return answer("quiet", "unknown", measured ? "learning" : "not measured",
      measured ? "the calm level is not known yet" : "only the twin runs: no place has a sensor");
  }
  const sentence = `${plain(now.ratio, 2)} × the calm level (${now.of}); alarm at ${whole(limit)} ×`;
  if (now.ratio >= limit)
    return answer("quiet", "bad", "loud", sentence);
  if (now.ratio >= 2)
    return answer("quiet", "fair", "louder", sentence);
  answer("quiet", "good", "quiet", sentence);
}

function growthSentence(chatter) {
  if (chatter.growth === null)
    return "";
  const fate = chatter.growth < 0 ? `vibration dies away at ${plain(-chatter.growth, 2)} 1/s` : `vibration grows at ${plain(chatter.growth, 2)} 1/s`;
  return `${fate}; warning above ${plain(chatter.growth_limit, 2)} 1/s`;
}

function chatter(mill) {
  const data = mill.chatter, canvas = byId("chatter-gauge"), known = data && data.critical > 0 && data.distance !== null;
  canvas.hidden = !known;
  const none = silence(mill);
  if (none)
    return answer("chatter", "unknown", none[0], "");
  if (!data)
    return answer("chatter", "unknown", "–", "not judged yet");
  const rising = data.bands.filter(band => band.state === "warning" || band.state === "alarm");
  const growing = data.growth !== null && data.growth > data.growth_limit;
  const worst = rising.some(band => band.state === "alarm") ? "bad" : rising.length || growing ? "fair" : "good";
  if (!known) {
    const why = data.because ? `critical speed not known: ${data.because}` : "critical speed not known";
    if (data.growth === null)
      return answer("chatter", "unknown", "not known", why);
    return answer("chatter", worst, worst === "good" ? "stable" : worst === "fair" ? "near" : "growing", `${growthSentence(data)}; ${why}`);
  }
  drawSpeeds(canvas, data);
  const margin = data.distance, inside = data.low !== null && data.speed >= data.low;
  const state = margin <= 0 || worst === "bad" ? "bad" : inside || margin < 0.1 || worst === "fair" ? "fair" : "good";
  const interval = data.low !== null && data.high !== null ? ` (${plain(data.low)} … ${plain(data.high)})` : "";
  const words = margin > 0 ? "to the critical speed" : "beyond the critical speed";
  const growth = growthSentence(data);
  answer("chatter", state, percent(margin), `${words}, ${plain(data.critical)}${interval} m/s${growth ? "; " + growth : ""}`);
}

const parameterWords = list => list.map(p => `${p.key === "damping" ? "damping" : p.key} × ${p.factor.toFixed(2)}`).join(", ");

/** What is not as it was: [{state, text, button?}] worst first. */
export function changes(mill) {
  const out = [];
  for (const proposal of mill.proposals.values())
    if (proposal.state === "open")
      out.push({ state: "fair", text: proposal.text.split(/(?<=\.) /)[0], whole: proposal.text, adopt: proposal.id });
  for (const mode of (mill.modes && mill.modes.modes) || []) {
    if (mode.state !== "drifting" && mode.state !== "drifted")
      continue;
    const name = mode.name || `mode at ${plain(mode.twin, 4)} Hz`;
    out.push({ state: mode.state === "drifted" ? "bad" : "fair",
      text: `${name}: ${plain(mode.measured, 4)} Hz, ${plain(100 * Math.abs(mode.measured / mode.twin - 1), 2)} % ${mode.measured < mode.twin ? "below" : "above"} the twin` });
  }
  for (const alarm of active(mill))
    if (alarm.kind !== "chatter" && alarm.kind !== "level" && alarm.kind !== "drift")
      out.push({ state: alarm.level === "alarm" ? "bad" : "fair", text: `${clock(alarm.utc)} ${alarm.text}` });
  const account = mill.account;
  if (account && account.trouble && !out.some(entry => entry.text.includes(account.trouble)))
    out.push({ state: "fair", text: account.trouble });
  const byHand = ((mill.parameters && mill.parameters.sliders) || []).filter(p => Math.abs(p.factor - 1) > 1e-9);
  if (byHand.length)
    out.push({ state: "note", text: `twin changed by hand: ${parameterWords(byHand)}` });
  const order = ["bad", "fair", "note"];
  return out.sort((a, b) => order.indexOf(a.state) - order.indexOf(b.state));
}

let shownChanges = "";

function changed(mill, send) {
  const all = changes(mill), key = JSON.stringify(all), known = mill.modes && mill.modes.modes.some(mode => mode.measured !== null);
  const state = all.some(entry => entry.state === "bad") ? "bad" : all.length ? "fair" : mill.link !== "open" || !known ? "unknown" : "good";
  const word = all.length ? (all.length === 1 ? "1 change" : `${all.length} changes`) : mill.link === "waiting" ? "connecting" : mill.link !== "open" ? "no link" : known ? "nothing" : "not known";
  answer("changed", state, word, "");
  if (key + word === shownChanges)
    return;
  shownChanges = key + word;
  const list = byId("changed-list");
  const more = all.length > 3 ? `; ${all.length - 3} more: key 2` : "";
  list.replaceChildren(...all.slice(0, 3).map((entry, i) => {
    const item = document.createElement("li"), words = document.createElement("span");
    words.textContent = entry.text + (i === 2 ? more : "");
    item.append(words);
    item.title = entry.whole || "";
    if (entry.adopt !== undefined) {
      const button = document.createElement("button");
      button.textContent = "Adopt";
      button.addEventListener("click", () => send({ command: "adopt", id: entry.adopt }));
      item.append(button);
    }
    return item;
  }));
  const rest = document.createElement("li");
  if (!all.length)
    rest.textContent = mill.link !== "open" ? "" : known ? "frequencies, parameters and source have not changed" : "no mode has been measured yet";
  if (rest.textContent)
    list.append(rest);
}

export function drawAnswers(mill, send) {
  quiet(mill);
  chatter(mill);
  changed(mill, send);
}
