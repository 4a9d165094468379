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

function addRow(table, cells, css) {
  const row = table.insertRow();
  if (css) row.className = css;
  for (const [text, number] of cells) {
    const td = row.insertCell();
    td.append(text);
    if (number) td.className = "number";
  }
  return row;
}

// A row with a time-dependent number: value(t, row).
function addChanging(table, label, value, units, css) {
  const number = addRow(table, [[label], ["", true], [units]], css).cells[1];
  changing.push([number.appendChild(document.createTextNode("")), value]);
}

function valueIn(index) {
  return (t, row) => readAt(index, t, row);
}

// The sum of terms, zero at the round-off level of floats.
function sumOf(terms, t, row) {
  const values = terms.map(([, index]) => readAt(index, t, row));
  const sum = values.reduce((a, b) => a + b, 0), largest = Math.max(0, ...values.map(Math.abs));
  return Math.abs(sum) < 5e-7 * largest ? 0 : sum;
}

// The inertia of an equation, proportional to a mass that may vary.
function inertiaIn(equation) {
  if (equation.mass === undefined) return () => equation.value;
  const mass = valueIn(equation.mass);
  return (t, row) => equation.value * mass(t, row) / equation.massAtStart;
}

// The terms of an equation that are nonzero at some time.
function livingTerms(equation) {
  return equation.terms.filter(([, index]) => sizeOf(index) > roundingOf(equation.unit));
}

// The displayed terms: in symbols those with a symbol.
function writtenTerms(equation) {
  return equation.left ? equation.terms.filter(([, , symbol]) => symbol) : livingTerms(equation);
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
  terms.forEach(([, , symbol], i) => {
    const negative = symbol.startsWith("-");
    if (i || negative) row.append(termSign(i === 0, negative ? "−" : "+"));
    row.append(...mathOf(negative ? symbol.slice(1) : symbol));
  });
  if (!terms.length) row.append(math("mn", "0"));
  return mathLine(row);
}

// The equation with the numbers at the cursor's time.
function inNumbers(equation) {
  const row = math("mrow");
  const number = (value, format) => {
    const text = document.createTextNode("");
    changing.push([text, value, format]);
    return math("mn", text);
  };
  const upright = (units) => math("mtext", `\u2009${unit(units)}`);
  row.append(number(inertiaIn(equation), (value) => show(value, 4)), upright(equation.inertiaUnit), math("mo", "·"), math("mo", "("),
    number(valueIn(equation.acceleration), (value) => show(value, 4)), upright(equation.accelerationUnit), math("mo", ")"), math("mo", "="));
  const terms = writtenTerms(equation);
  terms.forEach(([, index], i) => {
    const sign = document.createTextNode("");
    changing.push([sign, valueIn(index), (value) => (value < 0 ? "−" : i ? "+" : "")]);
    row.append(termSign(i === 0, sign), number(valueIn(index), (value) => show(Math.abs(value), 4)));
  });
  if (!terms.length) row.append(math("mn", "0"));
  row.append(upright(equation.unit));
  return mathLine(row);
}

// One equation: the terms, their sum, the inertia and the acceleration.
function equationTable(equation) {
  const box = document.createElement("div"), table = document.createElement("table"), units = unit(equation.unit);
  const symbols = inSymbols(equation), name = Object.assign(document.createElement("div"), { className: "name", textContent: quantity(equation.name) });
  box.append(name);
  if (symbols) box.append(symbols, inNumbers(equation));
  else box.append(mathLine(math("mrow", ...mathOf(`${equation.inertia} ${equation.accelerationName}`), math("mo", "="), math("mo", "∑"))));
  for (const [term, index] of equation.terms) addChanging(table, term, valueIn(index), units);
  addChanging(table, "sum", (t, row) => sumOf(equation.terms, t, row), units, "sum");
  addChanging(table, inMath(equation.inertia), inertiaIn(equation), unit(equation.inertiaUnit));
  addChanging(table, inMath(equation.accelerationName), valueIn(equation.acceleration), unit(equation.accelerationUnit));
  box.append(table);
  return box;
}

// The acceleration of G in terms of those of the coordinates.
function kinematicLines(body) {
  if (body.kinematics.length === 0) return [];
  const box = document.createElement("div");
  box.append(Object.assign(document.createElement("div"), { className: "name", textContent: `${body.name}: a of G` }));
  for (const line of body.kinematics) box.append(mathLine(math("mrow", ...mathOf(line))));
  return [box];
}

function makeTables(bodies) {
  changing.length = 0;
  element("equations").replaceChildren(...bodies.flatMap((body) => [...body.equations.map(equationTable), ...kinematicLines(body)]));
  const ledger = element("ledger"), energy = unit(run.units.energy);
  ledger.textContent = "";
  for (const index of run.energy) addChanging(ledger, run.columns[index].n.replace(".", ": "), valueIn(index), energy);
  for (const index of run.states) addChanging(ledger, quantity(run.columns[index].n), valueIn(index), unit(run.columns[index].u));
  for (const body of bodies)
    for (const arrow of body.arrows)
      if (arrow.work >= 0) addChanging(ledger, `work of ${body.name}.${arrow.name}`, valueIn(arrow.work), energy);
}

function showTables(t) {
  const row = rowAt(t), clock = `t = ${show(t)} s`;
  element("equations-time").textContent = clock;
  element("ledger-time").textContent = clock;
  for (const [text, value, format] of changing) write(text, (format || show)(value(t, row)));
}

function makeDetails(bodies) {
  makeCharts(bodies);
  makeTables(bodies);
}

function showCost() {
  const s = run.stats, table = element("cost");
  table.textContent = "";
  const rows = [["method", s.method], ["tolerance of a step", show(s.tolerance)], ["steps", String(s.steps)], ["rejected", String(s.rejected)],
    ["right-hand sides", String(s.rhs)], ["Jacobians", String(s.jacobians)], ["steps by the stiff method", String(s.stiffSteps)],
    ["processor time of the run", `${show(s.seconds)} s`], ["events", String(run.events.count)],
    ["rows in this page", `${run.rows}${run.thinned ? ", thinned; extremes are kept in the plots" : ""}`]];
  for (const [label, value] of rows) addRow(table, [[label], [value, true]]);
}

function listEvents() {
  const most = 1000, list = element("events");
  list.textContent = "";
  if (run.events.count === 0) list.textContent = "none";
  eventTimes.slice(0, most).forEach((t, i) => {
    const label = eventLabel(i), button = document.createElement("button");
    button.type = "button";
    button.dataset.index = i;
    const detail = run.events.details[i] || label.name;
    button.textContent = `t = ${show(t)} s  ${label.body} ${label.kind}: ${detail}`;
    button.addEventListener("click", () => seek(t));
    list.append(button);
  });
  if (run.events.count > most) list.append(`and ${run.events.count - most} more`);
}

// ---- time

// The state of the checkboxes.
function shownNow() {
  const is = (id) => element(id).checked;
  return { forces: is("show-forces"), names: is("show-names"), values: is("show-values"), axes: is("show-axes"), velocity: is("show-velocity"),
    trace: is("show-trace"), follow: is("follow") };
}

// Redraw at the present time; during an animation the texts only at intervals.
function refresh(everything = true) {
  const before = performance.now(), pause = chosenBodies().length > fewBodies ? 250 : 66; // ms between two updates of texts
  drawScene(player.t, shownNow(), chosenBody());
  placeCursors();
  element("scrub").value = player.t;
  element("clock").textContent = `${show(player.t)} s`;
  if (everything || before - player.written > pause) {
    showValues(plotWindow.hover === null ? player.t : plotWindow.hover);
    showTables(plotWindow.hover === null ? player.t : plotWindow.hover);
    player.written = before;
  }
  player.frames++;
  player.drawing += performance.now() - before;
}

function seek(t) {
  player.t = Math.min(Math.max(t, run.start), run.end);
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
  return good.reduce((best, speed) => (Math.abs(Math.log(speed)) < Math.abs(Math.log(best)) ? speed : best), good[0] || 1);
}

function seekEvent(direction) {
  const small = 1e-12 * Math.max(Math.abs(run.end), 1);
  const ahead = eventTimes.filter((t) => (t - player.t) * direction > small);
  if (ahead.length) seek(direction > 0 ? ahead[0] : ahead[ahead.length - 1]);
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
};

function seekHash() {
  const match = /^#t=([-+0-9.eE]+)$/.exec(location.hash);
  if (match && Number.isFinite(Number(match[1]))) seek(Number(match[1]));
}

// ---- the start

// The contents of the tables without the time-dependent numbers.
function tablesSay(bodies) {
  const equations = bodies.map((body) => body.equations.map((equation) => [equation, livingTerms(equation)]));
  return JSON.stringify([equations, bodies.map((body) => body.arrows)]);
}

// Show title, summary, events and cost of the run.
function describeRun() {
  element("title").textContent = run.title || "fbd";
  element("summary").textContent = `t = ${show(run.start)} s to ${show(run.end)} s, ${run.bodies.length} ${run.bodies.length === 1 ? "body" : "bodies"}` +
    (run.reason ? `. The run ended early: ${run.reason}` : "");
  listEvents();
  showCost();
}

function fillChoices() {
  element("body").replaceChildren(new Option("all", String(allBodies)));
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

// The structure of a run: bodies, forces and columns by name.
function makeup({ columns, bodies }) {
  const parts = bodies.map(({ name, arrows, equations }) => [name, arrows, equations.map((e) => [e.name, e.terms])]);
  return JSON.stringify([columns.map(({ n, u }) => [n, u]), parts]);
}

// Show another run of the page's model. View, time and checkboxes are kept if the structure is the same. The scene and
// the numbers beside it are updated first.
function showAgain(data) {
  const { t } = player, said = tablesSay(chosenBodies()), whole = plotWindow.from === run.start && plotWindow.to === run.end;
  if (makeup(data) !== makeup(run)) {
    showRun(data);
    seek(t);
    return;
  }
  takeRun(data);
  eventTimes = run.events.times;
  const { from, to } = plotWindow, kept = !whole && to <= run.end && from >= run.start;
  Object.assign(plotWindow, kept ? { from, to } : { from: run.start, to: run.end });
  Object.assign(element("scrub"), { min: run.start, max: run.end });
  measure();
  aim();
  if (tablesSay(chosenBodies()) !== said) makeTables(chosenBodies());
  if (chartsAreOthers()) makeCharts(chosenBodies()); else redrawChartsSoon();
  seek(t);
  clearTimeout(player.describing);
  player.describing = setTimeout(describeRun, 0);
}

// True if the focused element itself uses the key.
function takesKey(target, key) {
  if (target.isContentEditable || ["SELECT", "TEXTAREA"].includes(target.tagName)) return true;
  if (["BUTTON", "SUMMARY"].includes(target.tagName)) return key === " ";
  if (target.tagName !== "INPUT") return false;
  if (target.type === "checkbox") return key === " ";
  return target.type !== "range" || key.startsWith("Arrow") || key === "Home" || key === "End";
}

function connect() {
  for (const speed of speeds) element("speed").add(new Option(speed === 1 ? "real time" : `${show(speed)} ×`, String(speed)));
  setSpeed(usualSpeed());
  element("play").addEventListener("click", () => setPlaying(!player.playing));
  element("scrub").addEventListener("input", () => seek(Number(element("scrub").value)));
  element("speed").addEventListener("change", () => setSpeed(Number(element("speed").value)));
  element("body").addEventListener("change", () => { makeDetails(chosenBodies()); refresh(); });
  for (const id of ["show-forces", "show-names", "show-values", "show-axes", "show-velocity", "show-trace"])
    element(id).addEventListener("change", () => refresh());
  element("follow").addEventListener("change", () => { fit(); refresh(); });
  document.addEventListener("keydown", (event) => {
    if (takesKey(event.target, event.key) || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  addEventListener("hashchange", seekHash);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { fit(); restyleCharts(null); refresh(); });
}

showRun(JSON.parse(element("data").textContent));
connect();
connectEye();
connectPaper();
seek(run.start);
seekHash();

window.fbd = {
  seek, setPlaying, setSpeed, zoom: setWindow, player, drawn, labels, get run() { return run; },
  value: (columnName, t) => valueAt(run.columns.findIndex((column) => column.n === columnName), t, rowAt(t)),
};
