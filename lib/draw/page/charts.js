"use strict";

// The plots: linked in time, with the events as marks and the cursor as a line.

const charts = [];
const plotWindow = { from: 0, to: 0, hover: null };
const palette = ["#1f77b4", "#d9541e", "#2a9d3a", "#9a4fc0", "#b8860b", "#0f8a93", "#c2347a", "#6b7682"];

function byUnit(title, columns) {
  const groups = new Map();
  for (const c of columns) {
    const key = run.columns[c].u;
    groups.set(key, (groups.get(key) || []).concat(c));
  }
  return [...groups].map(([key, members]) => ({ title, unit: key, columns: members }));
}

// Which plots there are for the chosen bodies.
function chartSpecs(bodies) {
  const all = (member) => bodies.reduce((list, body) => list.concat(body[member]), []);
  const [kinetic, potential, work, residual] = run.energy;
  let specs = [...byUnit("Coordinates", all("coordinates")), ...byUnit("Velocities", all("rates"))];
  for (const body of bodies) {
    const columns = body.arrows.reduce((list, arrow) => list.concat(arrow.force), []);
    specs = specs.concat(byUnit("Forces and moments on " + body.name, columns));
  }
  specs = specs.concat(byUnit("States", run.states));
  specs.push({ title: "Energy", unit: run.units.energy, columns: [kinetic, potential, work] });
  specs.push({ title: "Energy residual", unit: run.units.energy, columns: [residual] });
  return specs;
}

// The rows of a window; when they are more than can be seen, the least and greatest values of pieces of it.
function chartRows(columns, from, to) {
  const most = 6000, pieces = 700, begins = Math.max(rowAt(from) - 1, 0), last = Math.min(rowAt(to) + 1, run.rows - 1);
  const rows = [];
  if (last - begins <= most && !(run.thinned && last - begins > most / 4)) {
    for (let i = begins; i <= last; i++) rows.push([times[i], ...columns.map((c) => cell(c, i))]);
    return rows;
  }
  const width = (to - from) / pieces;
  let next = begins;
  for (let k = 0; k < pieces; k++) {
    const start = from + k * width, end = start + width, begin = next;
    while (next < last && times[next] < end) next++;
    const limits = columns.map((c) => {
      const [low, high] = extremes(c, start, end, begin, next - 1);
      return low <= high ? [low, high] : [valueAt(c, start, rowAt(start)), valueAt(c, end, rowAt(end))];
    });
    const first = columns.map((c) => (valueAt(c, start, rowAt(start)) <= valueAt(c, end, rowAt(end)) ? 0 : 1));
    rows.push([start + width / 4, ...limits.map((limit, i) => limit[first[i]])]);
    rows.push([start + width * 3 / 4, ...limits.map((limit, i) => limit[1 - first[i]])]);
  }
  return rows;
}

function drawMarks(context, area, graph) {
  const visible = [];
  eventTimes.forEach((t, i) => { if (t >= plotWindow.from && t <= plotWindow.to) visible.push(i); });
  const switches = visible.filter((i) => eventLabel(i).kind === "switch").length;
  const shown = visible.length > 60 && switches < visible.length ? visible.filter((i) => eventLabel(i).kind !== "switch") : visible;
  const every = Math.ceil(shown.length / 300);
  context.save();
  context.setLineDash([3, 3]);
  context.strokeStyle = view.colour.soft;
  context.globalAlpha = 0.6;
  for (let k = 0; k < shown.length; k += every) {
    const x = Math.round(graph.toDomXCoord(eventTimes[shown[k]])) + 0.5;
    context.beginPath();
    context.moveTo(x, area.y);
    context.lineTo(x, area.y + area.h);
    context.stroke();
  }
  context.restore();
}

function setWindow(from, to) {
  if (!(to > from) || (from === plotWindow.from && to === plotWindow.to)) return;
  Object.assign(plotWindow, { from, to });
  for (const chart of charts) {
    chart.graph.updateOptions({ file: chartRows(chart.spec.columns, from, to), dateWindow: [from, to], valueRange: null });
  }
  placeCursors();
}

function makeChart(spec) {
  const box = document.createElement("div"), title = document.createElement("h2"), legend = document.createElement("span");
  const plot = document.createElement("div"), cursor = document.createElement("div");
  box.className = "chart";
  title.textContent = `${spec.title} [${unit(spec.unit)}]`;
  legend.className = "legend";
  plot.className = "plot";
  cursor.className = "cursor";
  const holder = document.createElement("div");
  holder.style.cssText = "position:absolute;inset:0";
  plot.append(holder, cursor);
  box.append(title, legend, plot);
  document.getElementById("charts").append(box);
  const values = spec.columns.map((c, i) => {
    const item = document.createElement("b");
    item.style.color = palette[i % palette.length];
    legend.append(item);
    return item.appendChild(document.createTextNode(""));
  });
  const graph = new Dygraph(holder, chartRows(spec.columns, plotWindow.from, plotWindow.to), {
    labels: ["t", ...spec.columns.map((c) => run.columns[c].n)],
    colors: spec.columns.map((c, i) => palette[i % palette.length]),
    dateWindow: [plotWindow.from, plotWindow.to],
    strokeWidth: 1.5,
    legend: "never",
    axisLabelWidth: 70,
    gridLineColor: view.colour.line,
    axisLineColor: view.colour.soft,
    highlightCircleSize: 3,
    axes: { x: { axisLabelFormatter: show, valueFormatter: show }, y: { axisLabelFormatter: show } },
    underlayCallback: drawMarks,
    zoomCallback: (from, to) => setWindow(Math.max(from, run.start), Math.min(to, run.end)),
    highlightCallback: (event, t) => { plotWindow.hover = t; refresh(); },
    unhighlightCallback: () => { plotWindow.hover = null; refresh(); },
    clickCallback: (event, t) => seek(t),
  });
  const chart = { spec, graph, cursor, values, unseen: false };
  // a plot out of sight needs no cursor and no values; a browser that does not tell draws them all
  box.addEventListener("contentvisibilityautostatechange", (event) => {
    chart.unseen = event.skipped;
    if (!event.skipped) refresh();
  });
  charts.push(chart);
}

function makeCharts(bodies) {
  for (const chart of charts) chart.graph.destroy();
  charts.length = 0;
  document.getElementById("charts").textContent = "";
  chartSpecs(bodies).forEach(makeChart);
}

// The line of the cursor in every plot.
function placeCursors() {
  for (const { graph, cursor, unseen } of charts) {
    if (unseen) continue;
    const area = graph.getArea(), x = graph.toDomXCoord(now());
    cursor.style.display = x >= area.x && x <= area.x + area.w ? "block" : "none";
    cursor.style.transform = `translateX(${x}px)`;
    cursor.style.height = `${area.h}px`;
  }
}

// The values at time t beside the plots' titles.
function showValues(t) {
  const row = rowAt(t);
  for (const { spec, values, unseen } of charts) {
    if (unseen) continue;
    spec.columns.forEach((c, i) => write(values[i], `${run.columns[c].n} = ${show(valueAt(c, t, row))} ${unit(spec.unit)}`));
  }
}
