"use strict";

// The drawing: forces and moments as entries, as arrows on the boards, and in words.
//
// entry: {id, body, kind: "force" or "moment", name, value, point: index or [x, y] on paper,
//   typed: [x, y] as texts if the position was typed, direction: {degrees, angle, body} or null if unknown,
//   tip: its tip is at the point, length: mm, sense: 1 or -1}

const drawing = { entries: [], lines: sheet.bodies.map(() => ""), inertia: sheet.bodies.map(() => ""), next: 1, selected: 0, marks: new Map() };
const usualLength = 24, headLength = 3.2, arcRadius = 8;

const entryOf = (id) => drawing.entries.find((entry) => entry.id === id);
const bodyOf = (entry) => sheet.bodies[entry.body];
const placeOf = (entry) => (Array.isArray(entry.point) ? entry.point : bodyOf(entry).points[entry.point].paper);
const nameOf = (entry) => entry.name.trim() || `${entry.kind === "force" ? "F" : "M"}${entry.id}`;

function newEntry(body, kind, properties) {
  const entry = { id: drawing.next++, body, kind, name: "", value: "", point: 0, direction: directionsOf(sheet.bodies[body])[1],
    tip: false, length: usualLength, sense: 1, ...properties };
  drawing.entries.push(entry);
  return entry;
}

// The ends of an arrow on paper.
function endsOf(entry) {
  const at = placeOf(entry), reach = times(entry.length, unitOf(entry.direction ? entry.direction.degrees : 45));
  return entry.tip ? [minusOf(at, reach), at] : [at, plus(at, reach)];
}

// An error of an entry that is visible without the key, or "".
function faultOf(entry) {
  const name = fileName(entry);
  const twin = drawing.entries.some((other) => other !== entry && other.body === entry.body && fileName(other) === name);
  if (twin) return `two are called ${name}`;
  return entry.value.trim() && !treeOf(entry.value) ? "its magnitude cannot be read" : "";
}

// ---- in words

function placeName(entry) {
  return Array.isArray(entry.point) ? `[${placeTexts(entry).join(", ")}]` : bodyOf(entry).points[entry.point].name;
}

function directionName(entry) {
  if (entry.kind === "moment") return entry.sense > 0 ? "counter-clockwise" : "clockwise";
  if (!entry.direction) return "in an unknown direction";
  const known = directionsOf(bodyOf(entry)).find((other) => other.angle === entry.direction.angle && other.body === entry.direction.body);
  return known ? known.name : entry.direction.angle;
}

function inWords(entry) {
  const where = entry.kind === "force" ? ` at ${placeName(entry)}` : "";
  return `${nameOf(entry)}: ${entry.kind}${where}, ${directionName(entry)}, magnitude ${entry.value.trim() || "unknown"}`;
}

// ---- as arrows

// A_x, mu_k, N' as a label with an index after the underscore.
function labelOf(text, at) {
  const [, base, index] = /^([^_]*)_?(.*)$/.exec(text), label = svg("text", { x: at[0], y: at[1], class: "name", "text-anchor": "middle" });
  label.append(greek[base] || base);
  if (index) label.append(svg("tspan", { dy: 1, class: "below" }, greek[index] || index));
  return label;
}

function headAt(tip, degrees) {
  const back = times(-headLength, unitOf(degrees)), side = times(0.42 * headLength, unitOf(degrees + 90));
  const corners = [tip, plus(plus(tip, back), side), minusOf(plus(tip, back), side)];
  return svg("polygon", { class: "head", points: corners.map((corner) => corner.join(",")).join(" ") });
}

function forceShape(entry) {
  const [tail, tip] = endsOf(entry), degrees = entry.direction ? entry.direction.degrees : 45;
  const neck = minusOf(tip, times(0.8 * headLength, unitOf(degrees)));
  const line = (css) => svg("line", { class: css, x1: tail[0], y1: tail[1], x2: neck[0], y2: neck[1] });
  return [line("reach"), line("shaft"), headAt(tip, degrees)];
}

// Three quarters of a circle around its point.
function momentShape(entry) {
  const [x, y] = placeOf(entry), r = arcRadius, from = entry.sense > 0 ? -45 : 225, to = from + entry.sense * 255;
  const start = plus([x, y], times(r, unitOf(from))), end = plus([x, y], times(r, unitOf(to)));
  const arc = (css) => svg("path", { class: css, d: `M${start} A${r} ${r} 0 1 ${entry.sense > 0 ? 0 : 1} ${end}` });
  return [arc("reach"), arc("shaft"), headAt(plus([x, y], times(r, unitOf(to + entry.sense * 15))), to + entry.sense * 97)];
}

// Points along an arrow that labels should avoid.
function spotsOf(entry) {
  const part = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1];
  if (entry.kind === "moment") return part.map((k) => plus(placeOf(entry), times(arcRadius, unitOf(360 * k))));
  const [tail, tip] = endsOf(entry);
  return part.map((k) => plus(tail, times(k, minusOf(tip, tail))));
}

// Candidate positions of a label: around a moment; beside the free end of a force.
function labelSpots(entry) {
  if (entry.kind === "moment")
    return [90, 135, 45, 180, 0, -135].map((degrees) => plus(plus(placeOf(entry), times(arcRadius + 3.5, unitOf(degrees))), [0, 1.2]));
  const [tail, tip] = endsOf(entry), free = entry.tip ? tail : tip, fixed = entry.tip ? tip : tail;
  const out = times(1 / away(tail, tip), minusOf(free, fixed)), side = [-out[1], out[0]];
  const half = 1.1 * nameOf(entry).length + (drawing.marks.has(entry.id) ? 2 : 0);
  const room = ([x, y]) => 2 + Math.abs(x) * half + Math.abs(y) * 1.6, beside = room(side);
  return [[2, beside], [2, -beside], [-6, beside], [-6, -beside], [room(out), 0]]
    .map(([a, b]) => plus(plus(free, times(a, out)), plus(times(b, side), [0, 1.2])));
}

// The candidate with the fewest points nearby.
function labelPlace(entry, taken) {
  const crowd = (spot) => taken.reduce((sum, other) => sum + Math.max(0, 7 - away(spot, other)), 0);
  return labelSpots(entry).reduce((a, b) => (crowd(b) < crowd(a) - 0.01 ? b : a));
}

// `taken` are positions of labels and points, `all` the arrows of the board.
function arrowShape(entry, taken, all) {
  const chosen = entry.id === drawing.selected, mark = drawing.marks.get(entry.id);
  const place = labelPlace(entry, [...taken, ...all.flatMap((other) => (other === entry ? [] : spotsOf(other)))]);
  taken.push(place);
  const label = labelOf(nameOf(entry), place);
  if (mark) label.append(svg("tspan", { class: "mark", dx: 1 }, mark.right ? "✓" : "✗"));
  const free = !entry.direction && entry.kind === "force", judged = mark ? (mark.right ? "right" : "wrong") : "";
  const css = ["arrow", entry.kind, chosen ? "chosen" : "", free ? "free" : "", judged];
  return svg("g", { class: css.filter(Boolean).join(" "), "data-id": entry.id, tabindex: 0, role: "button", "aria-pressed": chosen,
    "aria-label": `${inWords(entry)}${mark ? `. ${mark.message}` : ""}` },
  ...(entry.kind === "force" ? forceShape(entry) : momentShape(entry)), label);
}

// The axes to which a free position refers.
function axesOf({ paper, degrees }) {
  return ["x", "y"].flatMap((name, i) => {
    const turn = degrees + 90 * i, tip = plus(paper, times(9, unitOf(turn))), [x, y] = plus(tip, plus(times(2.4, unitOf(turn)), [0, 1.2]));
    return [svg("line", { class: "frame", x1: paper[0], y1: paper[1], x2: tip[0], y2: tip[1] }), svg("text", { class: "middle", x, y }, name)];
  });
}

// The handle at the free end of the selected arrow, and axes if its position is not a given point.
function handlesOf(entry) {
  if (entry.kind === "moment") return [];
  const [tail, tip] = endsOf(entry), [x, y] = entry.tip ? tail : tip;
  return [...(Array.isArray(entry.point) ? axesOf(bodyOf(entry).frame) : []), svg("circle", { class: "handle", cx: x, cy: y, r: 1.6 })];
}
