"use strict";

// The run as columns of numbers over rows, with interpolation between the rows. A live page shows one run after
// another.

let run, doubles, floats, envelope, times, inDegrees = false;

// Show `data` (lib/api/page_data.c) from now on.
function takeRun(data) {
  run = data;
  inDegrees = inDegrees || data.angles === "deg"; // the first run of a live page decides
  run.units.speed = `${run.units.length}/s`;
  doubles = new Float64Array(decode(run.doubles));
  floats = new Float32Array(decode(run.floats));
  envelope = new Float32Array(decode(run.envelope));
  times = doubles.subarray(0, run.rows);
  latest.t = NaN;
  roundings.clear();
  run.columns.forEach((column, index) => {
    column.index = index;
    if (column.d !== undefined) column.data = doubles.subarray((column.d + 1) * run.rows, (column.d + 2) * run.rows);
    if (column.f !== undefined) column.data = floats.subarray(column.f * run.rows, (column.f + 1) * run.rows);
    if (column.c === null) column.c = NaN;
    // cancellation in a + b c leaves round-off errors of a and of column c (7 or 16 digits)
    if (column.of !== undefined) column.noise = Math.abs(column.a) * (run.columns[column.of].f === undefined ? 4e-16 : 6e-8);
  });
  // a column whose rate is another column is interpolated with its slopes
  run.bodies.forEach((body, index) => {
    body.index = index;
    body.arm = Math.hypot(...body.G);
    body.coordinates.forEach((c, k) => { run.columns[c].slope = body.rates[k]; });
    body.rates.forEach((c, k) => { run.columns[c].slope = body.accelerations[k]; });
  });
}

function clamp(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

// The least and greatest of many values.
function bounds(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

// a + b times the value of another column, or zero if the sum is at round-off level.
function combined(column, value) {
  const sum = column.a + column.b * value;
  return Math.abs(sum) <= column.noise ? 0 : sum;
}

// The number of column `index` in a row.
function cell(index, row) {
  const column = run.columns[index];
  if (column.data) return column.data[row];
  return column.of === undefined ? column.c : combined(column, cell(column.of, row));
}

const latest = { t: NaN, row: 0 }; // many columns are read at one time

// The last row at or before t: of the two rows of an event the second one.
function rowAt(t) {
  let low = 0, high = run.rows - 1;
  if (t === latest.t) return latest.row;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle; else high = middle - 1;
  }
  Object.assign(latest, { t, row: low });
  return low;
}

function hermite(index, slope, row, t) {
  const h = times[row + 1] - times[row], u = (t - times[row]) / h;
  const a = cell(index, row), b = cell(index, row + 1), p = h * cell(slope, row), q = h * cell(slope, row + 1);
  return a + u * (p + u * (3 * (b - a) - 2 * p - q + u * (2 * (a - b) + p + q)));
}

// The next row from `row`, forward or backward, that is more than `gap` away; -1 beyond an event or the run's ends.
function rowBeyond(row, step, gap) {
  for (let i = row + step; i >= 0 && i < run.rows && times[i] !== times[i - step]; i += step) {
    if (Math.abs(times[i] - times[row]) > gap) return i;
  }
  return -1;
}

// The cubic through four rows, or fewer near an event; rows that nearly coincide are skipped, since they do not
// determine slopes.
function cubic(index, row, t) {
  const gap = 0.2 * (times[row + 1] - times[row]);
  const rows = [row, row + 1, rowBeyond(row, -1, gap), rowBeyond(row + 1, 1, gap)].filter((i) => i >= 0);
  let sum = 0;
  for (const i of rows) {
    let weight = 1;
    for (const k of rows) if (k !== i) weight *= (t - times[k]) / (times[i] - times[k]);
    sum += weight * cell(index, i);
  }
  return sum;
}

// The value of a column at time t.
function valueAt(index, t) {
  const column = run.columns[index], row = rowAt(t);
  if (column.of !== undefined) return combined(column, valueAt(column.of, t));
  if (!column.data) return column.c;
  if (t <= times[row] || row + 1 >= run.rows) return column.data[row];
  return column.slope === undefined ? cubic(index, row, t) : hermite(index, column.slope, row, t);
}

function valuesAt(columns, t) {
  return columns.map((c) => valueAt(c, t));
}

// The least and greatest value of a column in [from, to], of the rows and of the envelope.
function extremes(index, from, to, firstRow, lastRow) {
  const column = run.columns[index];
  if (column.of !== undefined) {
    const [low, high] = extremes(column.of, from, to, firstRow, lastRow);
    const a = column.a + column.b * low, b = column.a + column.b * high;
    return a < b ? [a, b] : [b, a];
  }
  if (!column.data) return [column.c, column.c];
  const limits = bounds(column.data.subarray(firstRow, lastRow + 1));
  if (!run.thinned) return limits;
  const slot = column.d === undefined ? run.doubleColumns + column.f : column.d;
  const all = run.doubleColumns + run.floatColumns;
  // a piece of the envelope counts if its start is in the interval
  for (let k = Math.ceil(from / run.bucket); k < run.buckets && k * run.bucket < to; k++) {
    const at = 2 * (k * all + slot);
    limits.push(envelope[at], envelope[at + 1]);
  }
  return bounds(limits);
}

// The largest magnitude of a column in the run.
function sizeOf(index) {
  const column = run.columns[index];
  if (column.size === undefined) {
    column.size = Math.max(...extremes(index, run.start, run.end, 0, run.rows - 1).map(Math.abs), 0);
  }
  return column.size;
}

// The round-off level of numbers with this unit, by the largest one in the run with the same unit, and at least one
// radian, since angles have an arbitrary zero.
const roundings = new Map();

function roundingOf(text) {
  if (!roundings.has(text)) {
    const sizes = run.columns.filter((column) => column.u === text).map(({ index }) => sizeOf(index)).filter(Number.isFinite);
    roundings.set(text, 64 * Number.EPSILON * Math.max(text === "rad" ? 1 : 0, ...sizes));
  }
  return roundings.get(text);
}

// The displayed value of a column at time t: zero at round-off level.
function readAt(index, t) {
  const value = valueAt(index, t);
  return Math.abs(value) <= roundingOf(run.columns[index].u) ? 0 : value;
}

// Change a text node only if its text differs, since every change causes a new layout.
function write(node, text) {
  if (node.data !== text) node.data = text;
}
