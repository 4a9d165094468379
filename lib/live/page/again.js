"use strict";

// Another run of the page's model in place of the one shown. The scene and the numbers beside it are updated first.

// ---- plots

// Redraw the plots one after another, each in a task of its own, so that the scene and the user's input need not wait.
// If new runs come faster than all plots are drawn, the plots take turns.
const drawing = new MessageChannel();
let drawnLast = 0;

function redrawChartsSoon() {
  for (const chart of charts) chart.stale = chart.graph !== null;
  drawing.port2.postMessage(null);
}

drawing.port1.onmessage = () => {
  const waits = ({ stale, unseen, box }) => stale && !unseen && box.open;
  for (let k = 1; k <= charts.length; k++) {
    const next = (drawnLast + k) % charts.length;
    if (!waits(charts[next])) continue;
    drawnLast = next;
    redrawChart(charts[next]);
    if (charts.some(waits)) drawing.port2.postMessage(null);
    return;
  }
};

// After another run: true if a folded plot is no longer empty, or an open one is; otherwise update the notes.
function chartsAreOthers() {
  const says = charts.map(({ spec }) => emptiness(spec));
  if (charts.some(({ empty }, i) => Boolean(says[i]) !== empty)) return true;
  charts.forEach(({ note }, i) => write(note, says[i] && ` ${says[i]}`));
  return false;
}

// ---- the page

// The contents of the tables without the time-dependent numbers.
function tablesSay(bodies) {
  const equations = bodies.map((body) => body.equations.map((equation) => [equation, writtenTerms(equation)]));
  return JSON.stringify([equations, bodies.map((body) => body.arrows)]);
}

// The structure of a run: bodies, forces and columns by name.
function makeup({ columns, bodies }) {
  const made = bodies.map(({ name, arrows, equations }) => [name, arrows, equations.map((e) => [e.name, e.terms])]);
  return JSON.stringify([columns.map(({ n, u }) => [n, u]), made]);
}

// While something is dragged the view and the scale of the arrows stay; true then.
function keepStill(kept) {
  if (!hold.grip && !pull.at) return false;
  Object.assign(view, kept, { force: hold.force });
  drawStill();
  return true;
}

// Show another run of the page's model. View, time and checkboxes are kept if the structure is the same. The scene and
// the numbers beside it are updated first.
function showAgain(data) {
  const { t } = player, said = tablesSay(chosenBodies()), whole = plotWindow.from === run.start && plotWindow.to === run.end;
  if (makeup(data) !== makeup(run)) {
    const kept = { scale: view.scale, x: view.x, y: view.y }, names = ({ bodies }) => bodies.map(({ name }) => name).join();
    const same = names(data) === names(run), box = element("body"), { value } = box;
    showRun(data);
    if (same && value !== box.value) { box.value = value; makeDetails(chosenBodies()); }
    keepStill(kept);
    seek(t);
    return;
  }
  takeRun(data);
  eventTimes = run.events.times;
  const { from, to } = plotWindow, kept = !whole && to <= run.end && from >= run.start;
  Object.assign(plotWindow, kept ? { from, to } : { from: run.start, to: run.end });
  Object.assign(element("scrub"), { min: run.start, max: run.end });
  measure();
  if (!keepStill({})) aim();
  if (tablesSay(chosenBodies()) !== said) makeTables(chosenBodies());
  if (chartsAreOthers()) makeCharts(chosenBodies()); else redrawChartsSoon();
  seek(t);
  clearTimeout(player.describing);
  player.describing = setTimeout(describeRun, 0);
}
