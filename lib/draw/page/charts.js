"use strict";

// The plots: linked in time, with the events as marks and the cursor as a line.

const charts = [];
const plotWindow = { from: 0, to: 0, hover: null };

// The meaning of columns by colour: {hue: its name in the style sheet, key: of the arrow}. Coordinates have the hue of
// their body, forces that of their arrow; curves of one hue in a plot have different dashes.
const dashes = [[null, "solid"], [[8, 4], "dashed"], [[2, 3], "dotted"], [[9, 3, 2, 3], "double"]];
const meanings = new Map();

function findMeanings() {
  meanings.clear();
  for (const body of run.bodies) {
    for (const c of [...body.coordinates, ...body.rates]) meanings.set(c, { hue: `curve-${body.index % curveCount}` });
    for (const arrow of body.arrows) for (const c of arrow.force) meanings.set(c, { hue: arrow.hue, key: arrowKey(body, arrow) });
  }
  ["velocity", "gravity", "applied", "reaction"].forEach((hue, i) => meanings.set(run.energy[i], { hue }));
}

// The looks of the curves of a plot: {hue, key, dash}.
function curvesOf(columns) {
  const all = columns.map((c, i) => meanings.get(c) || { hue: `curve-${i % curveCount}` });
  return all.map((curve, i) => ({ ...curve, dash: dashes[all.slice(0, i).filter(({ hue }) => hue === curve.hue).length % dashes.length] }));
}

function looksOf(spec) {
  return { colors: curvesOf(spec.columns).map(({ hue }) => tone[hue]), gridLineColor: tone.line, axisLineColor: tone.soft };
}

// The displayed unit, degrees for angles of coordinates and their rates if the page uses degrees, and its size.
function inUnit(text, angles) {
  const turns = inDegrees && angles && /^rad(\/s)?$/.test(text);
  return { unit: turns ? text.replace("rad", "deg") : text, size: turns ? Math.PI / 180 : 1 };
}

function byUnit(title, columns, angles = false) {
  const units = [...new Set(columns.map((c) => run.columns[c].u))];
  return units.map((text) => ({ title, ...inUnit(text, angles), columns: columns.filter((c) => run.columns[c].u === text) }));
}

// The plots for the chosen bodies.
function chartSpecs(bodies) {
  const all = (member) => bodies.flatMap((body) => body[member]), energy = { unit: run.units.energy, size: 1 };
  return [
    ...byUnit(phrase("coordinates"), all("coordinates"), true), ...byUnit(phrase("velocities"), all("rates"), true),
    ...bodies.flatMap((body) => byUnit(phrase("forces-on", body.name), body.arrows.flatMap((arrow) => arrow.force))),
    ...byUnit(phrase("states"), run.states),
    { title: phrase("energy"), ...energy, columns: run.energy.slice(0, 3) }, { title: phrase("residual"), ...energy, columns: run.energy.slice(3) },
  ];
}

// The rows of a window; if they are too many, the least and greatest values in parts of it. `size`: of the displayed
// unit.
function chartRows(columns, from, to, size = 1) {
  const most = 6000, pieces = 700, begins = Math.max(rowAt(from) - 1, 0), last = Math.min(rowAt(to) + 1, run.rows - 1);
  const rows = [];
  if (last - begins <= most && !(run.thinned && last - begins > most / 4)) {
    for (let i = begins; i <= last; i++) rows.push([times[i], ...columns.map((c) => cell(c, i) / size)]);
    return rows;
  }
  const width = (to - from) / pieces;
  let next = begins;
  for (let k = 0; k < pieces; k++) {
    const start = from + k * width, end = start + width, begin = next;
    while (next < last && times[next] < end) next++;
    const limits = columns.map((c) => {
      const [low, high] = extremes(c, start, end, begin, next - 1);
      return low <= high ? [low, high] : [valueAt(c, start), valueAt(c, end)];
    });
    const first = columns.map((c) => (valueAt(c, start) <= valueAt(c, end) ? 0 : 1));
    rows.push([start + width / 4, ...limits.map((limit, i) => limit[first[i]] / size)]);
    rows.push([start + width * 3 / 4, ...limits.map((limit, i) => limit[1 - first[i]] / size)]);
  }
  return rows;
}

function drawMarks(context, area, graph) {
  const visible = [...eventTimes.keys()].filter((i) => eventTimes[i] >= plotWindow.from && eventTimes[i] <= plotWindow.to);
  const others = visible.filter((i) => eventLabel(i).kind !== "switch"), display = visible.length > 60 && others.length ? others : visible;
  const every = Math.ceil(display.length / 300);
  const moving = pen;
  pen = context;
  pen.save();
  pen.globalAlpha = 0.6;
  for (let k = 0; k < display.length; k += every) {
    const x = Math.round(graph.toDomXCoord(eventTimes[display[k]])) + 0.5;
    path([[x, area.y], [x, area.y + area.h]]);
    strokeWith(tone.soft, 1, [3, 3]);
  }
  pen.restore();
  pen = moving;
}

function setWindow(from, to) {
  if (!(to > from) || (from === plotWindow.from && to === plotWindow.to)) return;
  Object.assign(plotWindow, { from, to });
  redrawCharts();
  placeCursors();
}

function redrawChart(chart) {
  const { from, to } = plotWindow;
  chart.stale = false;
  chart.graph.updateOptions({ file: chartRows(chart.spec.columns, from, to, chart.spec.size), dateWindow: [from, to], valueRange: null });
}

// Redraw the visible plots; others are marked, and redrawn when they become visible.
function redrawCharts() {
  for (const chart of charts) {
    if (!chart.graph) continue;
    if (chart.unseen || !chart.box.open) chart.stale = true; else redrawChart(chart);
  }
}

// The note of an empty plot: its values are at round-off level or, for the residual, less than a billionth of the
// energies.
function emptiness(spec) {
  const most = Math.max(...spec.columns.map(sizeOf)), energies = Math.max(...run.energy.slice(0, 3).map(sizeOf));
  if (spec.columns.every((c) => sizeOf(c) <= roundingOf(run.columns[c].u))) return phrase("zero-throughout");
  const residual = spec.columns.length === 1 && spec.columns[0] === run.energy[3];
  return residual && most < 1e-9 * energies ? phrase("of-energies", measured(most, spec.unit, 2), show(most / energies, 1)) : "";
}

// The name and value of a curve; a click hides or shows the curve.
function legendItem(chart, { hue, key, dash }, i) {
  const text = document.createTextNode(""), item = makeButton(text);
  item.style.color = `var(--${hue})`;
  item.style.borderBottomStyle = dash[1];
  if (key) item.dataset.arrow = key;
  item.setAttribute("aria-pressed", "true");
  item.title = phrase("toggle-curve");
  item.addEventListener("click", () => {
    chart.hidden[i] = !chart.hidden[i];
    item.setAttribute("aria-pressed", String(!chart.hidden[i]));
    chart.graph.setVisibility(i, !chart.hidden[i]);
  });
  return [item, text];
}

function makeGraph(chart) {
  const { spec, holder } = chart, curves = curvesOf(spec.columns), names = spec.columns.map((c) => run.columns[c].n);
  chart.graph = new Dygraph(holder, chartRows(spec.columns, plotWindow.from, plotWindow.to, spec.size), {
    labels: ["t", ...names],
    ...looksOf(spec),
    series: Object.fromEntries(names.map((name, i) => [name, { strokePattern: curves[i].dash[0] }])),
    visibility: chart.hidden.map((hidden) => !hidden),
    dateWindow: [plotWindow.from, plotWindow.to],
    strokeWidth: 1.5,
    resizable: "passive", // with its element, whose width depends on the plots beside it
    legend: "never",
    axisLabelWidth: 70,
    highlightCircleSize: 3,
    axes: { x: { axisLabelFormatter: (t) => show(t), valueFormatter: (t) => show(t) }, y: { axisLabelFormatter: (value) => show(value) } },
    underlayCallback: drawMarks,
    drawCallback: placeCursors,
    zoomCallback: (from, to) => setWindow(Math.max(from, run.start), Math.min(to, run.end)),
    highlightCallback: (event, t) => { plotWindow.hover = t; refresh(); },
    unhighlightCallback: () => { plotWindow.hover = null; refresh(); },
    clickCallback: (event, t) => seek(t),
  });
}

// A folded plot has no graph until it is opened.
function makeChart(spec) {
  const empty = emptiness(spec), note = document.createTextNode(empty && ` ${empty}`), title = make("h2", "", `${spec.title} [${unit(spec.unit)}]`);
  const legend = make("div", "legend"), holder = make("div", "holder"), cursor = make("div", "cursor");
  holder.setAttribute("role", "img");
  holder.setAttribute("aria-label", spec.title);
  const box = make("details", "chart", make("summary", "", title, note), legend, make("div", "plot", holder, cursor));
  element("charts").append(box);
  const chart = { spec, holder, box, cursor, note, empty: empty !== "", graph: null, stale: false, hidden: spec.columns.map(() => false), unseen: false };
  chart.values = curvesOf(spec.columns).map((curve, i) => {
    const [item, text] = legendItem(chart, curve, i);
    legend.append(item);
    return text;
  });
  box.open = !empty;
  if (box.open) makeGraph(chart);
  box.addEventListener("toggle", () => {
    if (!box.isConnected) return; // the event comes later
    if (box.open && !chart.graph) makeGraph(chart);
    if (box.open && chart.stale) redrawChart(chart);
    refresh();
  });
  // an invisible plot needs no cursor and no values; browsers without this event update all plots
  box.addEventListener("contentvisibilityautostatechange", (event) => {
    chart.unseen = event.skipped;
    if (chart.stale && !event.skipped) redrawChart(chart);
    if (!event.skipped) refresh();
  });
  charts.push(chart);
}

function dropCharts() {
  for (const chart of charts) if (chart.graph) chart.graph.destroy();
}

function makeCharts(bodies) {
  dropCharts();
  charts.length = 0;
  element("charts").textContent = "";
  findMeanings();
  chartSpecs(bodies).forEach(makeChart);
}

// Update colours and sizes from the style sheet; `ratio` is canvas pixels per page pixel (null: that of the screen).
function restyleCharts(ratio) {
  for (const { graph, spec, box } of charts) {
    if (!graph || !box.open) continue;
    graph.updateOptions({ ...looksOf(spec), pixelRatio: ratio }, true);
    graph.width_ = 0; // forces the graph to update its size
    graph.resize();
  }
}

// The line of the cursor in every plot.
function placeCursors() {
  for (const { graph, cursor, unseen, box } of charts) {
    if (unseen || !graph || !box.open) continue;
    const area = graph.getArea(), x = graph.toDomXCoord(now());
    cursor.style.display = x >= area.x && x <= area.x + area.w ? "block" : "none";
    cursor.style.transform = `translateX(${x}px)`;
    cursor.style.height = `${area.h}px`;
  }
}

// The values at time t beside the plots' titles.
function showValues(t) {
  for (const { spec, values, unseen } of charts) {
    if (unseen) continue;
    spec.columns.forEach((c, i) => write(values[i], `${quantity(run.columns[c].n)} = ${measured(readAt(c, t) / spec.size, spec.unit, 6)}`));
  }
}
