"use strict";

// The page: time, controls, tables. `fbd` is the interface for scripts.

const player = { t: 0, playing: false, speed: 1, last: 0, next: 0, written: 0, frames: 0, drawing: 0 };
let eventTimes = [];
const speeds = [1e-6, 1e-5, 1e-4, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 1000, 1e4, 1e5, 1e6];
const allBodies = -1, fewBodies = 4;
const changing = []; // time-dependent texts of the tables, and their values

function now() {
  return player.t;
}

function eventLabel(i) {
  return run.events.labels[run.events.of[i]] || { body: "", kind: "event", name: "" };
}

function chosenBody() {
  const value = Number(element("body").value);
  return value === allBodies ? null : value;
}

function chosenBodies() {
  const chosen = chosenBody();
  return chosen === null ? run.bodies : [run.bodies[chosen]];
}

// ---- tables

function addRow(table, cells, css = "") {
  const row = make("tr", css, ...cells.map(([text, number]) => make("td", number ? "number" : "", text)));
  table.append(row);
  return row;
}

// A time-dependent number: value(t).
function changingText(value, format = show) {
  const text = document.createTextNode("");
  changing.push([text, value, format]);
  return text;
}

function addChanging(table, label, value, units, css) {
  return addRow(table, [[label], [changingText(value), true], [units]], css);
}

// Give a term of an equation the colour of its arrow, and let it be found by that.
function markTerm(node, equation, name) {
  const found = arrowBy(`${equation.body}:${name}`);
  if (!found) return node;
  node.setAttribute("data-arrow", arrowKey(found.body, found.arrow));
  node.style.color = `var(--${found.arrow.hue})`;
  return node;
}

function valueIn(index) {
  return (t) => readAt(index, t);
}

// The sum of terms, zero at the round-off level of floats.
function sumOf(terms, t) {
  const values = terms.map(([, index]) => readAt(index, t));
  const sum = values.reduce((a, b) => a + b, 0), largest = Math.max(0, ...values.map(Math.abs));
  return Math.abs(sum) < 5e-7 * largest ? 0 : sum;
}

// The inertia of an equation, proportional to a mass that may vary.
function inertiaIn(equation) {
  if (equation.mass === undefined) return () => equation.value;
  const mass = valueIn(equation.mass);
  return (t) => equation.value * mass(t) / equation.massAtStart;
}

// The displayed terms: in symbols those with a symbol, else those that are nonzero at some time.
function writtenTerms(equation) {
  return equation.terms.filter(([, index, symbol]) => equation.left ? symbol : sizeOf(index) > roundingOf(equation.unit));
}

// The sign of a term; without space around the first one.
function termSign(first, text) {
  const sign = math("mo", text);
  if (first) for (const side of ["lspace", "rspace"]) sign.setAttribute(side, "0");
  return sign;
}

// The equation in symbols; null if it has none.
function inSymbols(equation) {
  const terms = writtenTerms(equation);
  if (!equation.left) return null;
  const row = math("mrow", ...mathOf(equation.left), math("mo", "="));
  terms.forEach(([name, , symbol], i) => {
    const negative = symbol.startsWith("-");
    if (i || negative) row.append(termSign(i === 0, negative ? "−" : "+"));
    row.append(markTerm(math("mrow", ...mathOf(negative ? symbol.slice(1) : symbol)), equation, name));
  });
  if (!terms.length) row.append(math("mn", "0"));
  return mathLine(row);
}

// The equation with the numbers at the cursor's time.
function inNumbers(equation) {
  const row = math("mrow");
  const number = (value, format = (x) => show(x, 4)) => math("mn", changingText(value, format));
  const upright = (units) => math("mtext", `\u2009${unit(units)}`);
  row.append(number(inertiaIn(equation)), upright(equation.inertiaUnit), math("mo", "·"), math("mo", "("),
    number(valueIn(equation.acceleration)), upright(equation.accelerationUnit), math("mo", ")"), math("mo", "="));
  const terms = writtenTerms(equation);
  terms.forEach(([name, index], i) => {
    const sign = changingText(valueIn(index), (value) => (value < 0 ? "−" : i ? "+" : ""));
    row.append(termSign(i === 0, sign), markTerm(number(valueIn(index), (value) => show(Math.abs(value), 4)), equation, name));
  });
  if (!terms.length) row.append(math("mn", "0"));
  row.append(upright(equation.unit));
  return mathLine(row);
}

// One equation: the terms, their sum, the inertia and the acceleration.
function equationTable(equation) {
  const table = make("table", ""), units = unit(equation.unit), symbols = inSymbols(equation);
  const box = make("div", "", make("div", "name", quantity(equation.name)));
  if (symbols) box.append(symbols, inNumbers(equation));
  else box.append(mathLine(math("mrow", ...mathOf(`${equation.inertia} ${equation.accelerationName}`), math("mo", "="), math("mo", "∑"))));
  for (const [term, index] of equation.terms) markTerm(addChanging(table, term, valueIn(index), units), equation, term);
  addChanging(table, phrase("sum"), (t) => sumOf(equation.terms, t), units, "sum");
  addChanging(table, inMath(equation.inertia), inertiaIn(equation), unit(equation.inertiaUnit));
  addChanging(table, inMath(equation.accelerationName), valueIn(equation.acceleration), unit(equation.accelerationUnit));
  box.append(table);
  return box;
}

// The acceleration of G in terms of those of the coordinates.
function kinematicLines(body) {
  if (body.kinematics.length === 0) return [];
  const lines = body.kinematics.map((line) => mathLine(math("mrow", ...mathOf(line))));
  return [make("div", "", make("div", "name", phrase("acceleration-of", body.name)), ...lines)];
}

function makeTables(bodies) {
  changing.length = 0;
  const tables = (body) => [...body.equations.map((e) => equationTable({ ...e, body: body.name })), ...kinematicLines(body)];
  element("equations").replaceChildren(...bodies.flatMap(tables));
  const ledger = element("ledger"), energy = unit(run.units.energy);
  ledger.textContent = "";
  for (const index of run.energy) addChanging(ledger, run.columns[index].n.replace(".", ": "), valueIn(index), energy);
  for (const index of run.states) addChanging(ledger, quantity(run.columns[index].n), valueIn(index), unit(run.columns[index].u));
  for (const body of bodies)
    for (const arrow of body.arrows)
      if (arrow.work >= 0) addChanging(ledger, phrase("work-of", `${body.name}.${arrow.name}`), valueIn(arrow.work), energy);
}

function showTables(t) {
  for (const id of ["equations-time", "ledger-time"]) element(id).textContent = `t = ${show(t)} s`;
  for (const [text, value, format] of changing) write(text, format(value(t)));
}

// Formulas that are too long scroll, by keys as well.
function reachFormulas() {
  if (chosenBodies().length > fewBodies) return; // measuring very many takes long
  for (const box of document.querySelectorAll(".formula")) box.tabIndex = box.scrollWidth > box.clientWidth ? 0 : -1;
}

function makeDetails(bodies) {
  makeCharts(bodies);
  makeTables(bodies);
  markTerms();
  reachFormulas();
}

function showCost() {
  const s = run.stats, table = element("cost");
  table.textContent = "";
  const rows = [["method", s.method], ["tolerance", show(s.tolerance)], ["steps", s.steps], ["rejected", s.rejected],
    ["right-hand-sides", s.rhs], ["jacobians", s.jacobians], ["stiff-steps", s.stiffSteps],
    ["processor-time", `${show(s.seconds)} s`], ["events", run.events.count], ["rows", run.thinned ? phrase("thinned", run.rows) : run.rows]];
  for (const [key, value] of rows) addRow(table, [[phrase(key)], [String(value), true]]);
}

function eventText(i) {
  const label = eventLabel(i);
  return `t = ${show(eventTimes[i])} s  ${label.body} ${label.kind.replace(/_/g, " ")}: ${unit(run.events.details[i] || label.name)}`;
}

function listEvents() {
  const most = 1000, list = element("events");
  list.textContent = "";
  for (const id of ["events", "events-title", "event-before", "event-next"]) element(id).hidden = run.events.count === 0;
  eventTimes.slice(0, most).forEach((t, i) => {
    const button = makeButton(eventText(i));
    button.addEventListener("click", () => seek(t));
    list.append(button);
  });
  if (run.events.count > most) list.append(phrase("more-events", run.events.count - most));
}

// ---- time

// The state of the checkboxes.
const choices = ["forces", "names", "values", "axes", "velocity", "trace"];

function shownNow() {
  return Object.fromEntries([["follow", element("follow").checked], ...choices.map((name) => [name, element(`show-${name}`).checked])]);
}

// Redraw at the present time; during an animation the texts only at intervals.
function refresh(everything = true) {
  const before = performance.now(), pause = chosenBodies().length > fewBodies ? 250 : 66; // ms between two updates of texts
  drawScene(player.t, shownNow(), chosenBody());
  placeCursors();
  element("scrub").value = player.t;
  element("clock").textContent = `${show(player.t)} s`;
  if (everything || before - player.written > pause) {
    showValues(plotWindow.hover ?? player.t);
    showTables(plotWindow.hover ?? player.t);
    showCard(player.t);
    if (!player.playing) write(element("words").firstChild, sceneInWords(player.t, chosenBodies()));
    player.written = before;
  }
  player.frames++;
  player.drawing += performance.now() - before;
}

function seek(t) {
  player.t = clamp(t, run.start, run.end);
  refresh();
}

function setPlaying(playing) {
  cancelAnimationFrame(player.next);
  player.playing = playing && run.end > run.start;
  element("play").textContent = player.playing ? "❚❚" : "▶";
  if (!player.playing) { refresh(); return; }
  if (player.t >= run.end) player.t = run.start;
  player.last = performance.now();
  player.next = requestAnimationFrame(advance);
}

function advance(clock) {
  if (!player.playing) return;
  player.t += Math.max(0, clock - player.last) / 1000 * player.speed;
  player.last = Math.max(clock, player.last);
  if (player.t >= run.end && element("loop").checked) player.t = run.start;
  if (player.t >= run.end) {
    player.t = run.end;
    setPlaying(false);
    return;
  }
  refresh(false);
  player.next = requestAnimationFrame(advance);
}

function setSpeed(speed) {
  player.speed = speed;
  element("speed").value = String(speed);
}

function changeSpeed(by) {
  const i = speeds.indexOf(player.speed) + by;
  if (i >= 0 && i < speeds.length) setSpeed(speeds[i]);
}

// The speed nearest to real time at which the run takes between 2 and 25 s.
function usualSpeed() {
  const length = run.end - run.start, good = speeds.filter((speed) => length / speed >= 2 && length / speed <= 25);
  const away = (speed) => Math.abs(Math.log(speed));
  return good.sort((a, b) => away(a) - away(b))[0] || 1;
}

function seekEvent(direction) {
  const small = 1e-12 * Math.max(Math.abs(run.end), 1);
  const ahead = eventTimes.filter((t) => (t - player.t) * direction > small);
  if (!ahead.length) return;
  seek(direction > 0 ? ahead[0] : ahead[ahead.length - 1]);
  element("said").textContent = eventText(eventTimes.indexOf(player.t));
}

const keys = {
  " ": () => setPlaying(!player.playing),
  ArrowLeft: () => seek(player.t - (run.end - run.start) / 200),
  ArrowRight: () => seek(player.t + (run.end - run.start) / 200),
  Home: () => seek(run.start),
  End: () => seek(run.end),
  "+": () => changeSpeed(1),
  "-": () => changeSpeed(-1),
  n: () => seekEvent(1),
  p: () => seekEvent(-1),
  a: pickNext,
  Escape: () => pick(""),
};

function seekHash() {
  const match = /^#t=([-+0-9.eE]+)$/.exec(location.hash);
  if (match && Number.isFinite(Number(match[1]))) seek(Number(match[1]));
}

// ---- the start

// Show title, summary, events and cost of the run.
function describeRun() {
  element("title").textContent = run.title || "fbd";
  element("summary").textContent = phrase(run.bodies.length === 1 ? "one-body" : "bodies", show(run.start), show(run.end), run.bodies.length) +
    (run.reason ? `. ${phrase("ended-early", run.reason)}` : "");
  listEvents();
  showCost();
}

function fillChoices() {
  element("body").replaceChildren(new Option(phrase("all"), String(allBodies)));
  run.bodies.forEach((body, i) => element("body").add(new Option(body.name, String(i))));
  if (run.bodies.length > fewBodies) element("body").value = "0";
  element("which").hidden = run.bodies.length === 1;
  element("show-trace").checked = run.bodies.length < fewBodies;
}

// Show a run with other bodies, forces or columns: rebuild everything.
function showRun(data) {
  takeRun(data);
  eventTimes = run.events.times;
  Object.assign(plotWindow, { from: run.start, to: run.end, hover: null });
  Object.assign(element("scrub"), { min: run.start, max: run.end });
  describeRun();
  fillChoices();
  measure();
  fit();
  element("follow").checked = bodiesAreSpecks();
  makeDetails(chosenBodies());
}

// True if the focused element itself uses the key.
function takesKey({ isContentEditable, tagName, type }, key) {
  if (isContentEditable || ["SELECT", "TEXTAREA"].includes(tagName)) return true;
  if (["BUTTON", "SUMMARY"].includes(tagName) || type === "checkbox") return key === " ";
  return tagName === "INPUT" && (type !== "range" || key.startsWith("Arrow") || key === "Home" || key === "End");
}

// Write all texts in the language chosen.
function speak() {
  translatePage();
  element("speed").replaceChildren(...speeds.map((speed) => new Option(speed === 1 ? phrase("real-time") : `${show(speed)} ×`, String(speed))));
  setSpeed(player.speed);
}

function changeLanguage(name) {
  language = element("language").value = name;
  speak();
  describeRun();
  element("body").options[0].text = phrase("all");
  makeDetails(chosenBodies());
  refresh();
}

function connect() {
  setSpeed(usualSpeed());
  listen("language", "change", () => changeLanguage(element("language").value));
  listen("event-before", "click", () => seekEvent(-1));
  listen("event-next", "click", () => seekEvent(1));
  listen("play", "click", () => setPlaying(!player.playing));
  listen("scrub", "input", () => seek(Number(element("scrub").value)));
  listen("speed", "change", () => setSpeed(Number(element("speed").value)));
  listen("body", "change", () => { makeDetails(chosenBodies()); refresh(); });
  for (const name of choices) listen(`show-${name}`, "change", () => refresh());
  listen("follow", "change", () => { fit(); refresh(); });
  document.addEventListener("keydown", (event) => {
    if (takesKey(event.target, event.key) || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  addEventListener("hashchange", seekHash);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { fit(); restyleCharts(null); refresh(); });
}

element("words").append("");
chooseLanguage();
speak();
showRun(JSON.parse(element("data").textContent));
connect();
connectEye();
connectPick();
connectPaper();
seek(run.start);
seekHash();

window.fbd = {
  seek, setPlaying, setSpeed, zoom: setWindow, player, drawn, labels, get run() { return run; },
  value: (columnName, t) => valueAt(run.columns.findIndex((column) => column.n === columnName), t),
};
