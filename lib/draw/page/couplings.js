"use strict";

// Couplings; and bodies without a shape in the file, drawn by the points where joints and couplings act.

function couplingEnd(end, frameOf) {
  return end.body < 0 ? end.point : place(frameOf(end.body), ...end.point);
}

function isSized(body) {
  return body.shapes.some((shape) => shape.corners || shape.radius);
}

// A point of the world in a body's frame.
function inFrame(frame, [x, y]) {
  const dx = x - frame.x, dy = y - frame.y;
  return [frame.c * dx + frame.s * dy, frame.c * dy - frame.s * dx];
}

// ---- preparation, from the motion of the whole run

// The range of the line that the circle covers, in its frame; the line of a rack touches the circle.
function prepareLine(coupling) {
  const [circle, line] = coupling.ends, [ex, ey] = coupling.e;
  coupling.n = [-ey * coupling.side, ex * coupling.side];
  coupling.span = [Infinity, -Infinity];
  coupling.lift = 0;
  survey.forEach((t, i) => {
    const row = rowAt(t), frameOf = (b) => frameAt(run.bodies[b], t, row), center = couplingEnd(circle, frameOf);
    const [x, y] = line.body < 0 ? center : inFrame(frameOf(line.body), center), dx = x - line.point[0], dy = y - line.point[1];
    const along = dx * ex + dy * ey;
    if (coupling.kind === "rack" && i === 0) coupling.lift = dx * coupling.n[0] + dy * coupling.n[1] - circle.radius;
    coupling.span = [Math.min(coupling.span[0], along - circle.radius), Math.max(coupling.span[1], along + circle.radius)];
  });
  if (line.body >= 0) run.bodies[line.body].board = true;
}

// Set the ends of a slot without ends: somewhat beyond the path of its point.
function prepareSlot(coupling) {
  const [x, y] = coupling.ends[1].point, [ex, ey] = coupling.e, board = coupling.ends[1].body >= 0 && run.bodies[coupling.ends[1].body].board;
  prepareLine(coupling);
  if (coupling.ends[1].body >= 0) run.bodies[coupling.ends[1].body].board = board;
  const pad = 0.15 * (coupling.span[1] - coupling.span[0]);
  coupling.points = [coupling.span[0] - pad, coupling.span[1] + pad].map((s) => [x + s * ex, y + s * ey]);
  coupling.span = null;
}

// Give both wheels teeth of the same pitch that mesh at the start.
function prepareGear(coupling) {
  const row = rowAt(run.start), frameOf = (b) => frameAt(run.bodies[b], run.start, row);
  const [a, b] = coupling.ends.map((end) => couplingEnd(end, frameOf)), centres = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const least = Math.min(...coupling.ends.map((end) => Math.abs(end.radius)));
  coupling.ends.forEach((end, k) => {
    const contact = k === 1 || coupling.ends[1].radius < 0 ? centres + Math.PI : centres, frame = frameOf(end.body);
    end.teeth = Math.round(12 * Math.abs(end.radius) / least);
    end.phase = contact - Math.atan2(frame.s, frame.c) + (k === 1 ? Math.PI / end.teeth : 0);
    if (end.radius > 0) run.bodies[end.body].wheel = end;
  });
}

// The points of a body's joints, couplings and springs, once each.
function jointsOf(index) {
  const row = rowAt(run.start), frame = frameAt(run.bodies[index], run.start, row), found = [];
  const add = (point) => {
    if (!found.some((other) => Math.hypot(other[0] - point[0], other[1] - point[1]) < 1e-9)) found.push(point);
  };
  if (run.bodies[index].joint) add([0, 0]);
  for (const body of run.bodies) {
    const child = frameAt(body, run.start, row);
    if (body.joint && body.parent === index) add(inFrame(frame, [child.x, child.y]));
  }
  for (const coupling of run.couplings) for (const end of coupling.ends) if (end.body === index && end.radius === 0) add(end.point);
  for (const link of run.links) {
    if (link.body === index) add(link.point);
    if (link.partner === index) add(link.anchor);
  }
  const middle = [0, 1].map((k) => found.reduce((sum, point) => sum + point[k], 0) / (found.length || 1));
  return found.sort((p, q) => Math.atan2(p[1] - middle[1], p[0] - middle[0]) - Math.atan2(q[1] - middle[1], q[0] - middle[0]));
}

function prepareTies() {
  prepareWedges();
  for (const coupling of run.couplings) {
    if (coupling.kind === "roll" || coupling.kind === "rack") prepareLine(coupling);
    if (coupling.kind === "slot" && !coupling.points) prepareSlot(coupling);
    if (coupling.kind === "gear") prepareGear(coupling);
  }
  run.bodies.forEach((body, index) => {
    body.joints = body.motion !== "slide" && body.motion !== "particle" && !isSized(body) ? jointsOf(index) : [];
    if (body.joints.length === 1 && body.shapes[0]?.kind === "unknown" && !Math.hypot(...body.G)) body.wheel = body.wheel || { point: body.G };
  });
}

// The ends of a rack or of a board with a rolling circle, in the frame of the line.
function lineEnds(coupling) {
  const [x, y] = coupling.ends[1].point, [ex, ey] = coupling.e, [nx, ny] = coupling.n;
  return coupling.span.map((s) => [x + s * ex + coupling.lift * nx, y + s * ey + coupling.lift * ny]);
}

// The range of the line of a slide on a body without a shape.
function prepareWedges() {
  for (const body of run.bodies) {
    const under = body.line && run.bodies[body.line.on];
    if (!under || isSized(under)) continue;
    const { through, along, normal } = body.line, places = survey.map((t) => {
      const row = rowAt(t), frame = frameAt(body, t, row), [x, y] = inFrame(frameAt(under, t, row), [frame.x, frame.y]);
      return (x - through[0]) * along[0] + (y - through[1]) * along[1];
    });
    const low = Math.min(...places), high = Math.max(...places), pad = 0.15 * (high - low) || 0.1;
    under.wedge = { from: [low - pad, high + pad], through, along, normal, reach: body.line.reach };
  }
}

// The corners of a wedge in its frame: the line below the sliding body, and a base along the wedge's motion.
function wedgeCorners(body) {
  const { from, through, along, normal, reach } = body.wedge, down = reach || view.block * 0.7 / view.scale;
  const top = from.map((s) => [0, 1].map((k) => through[k] + s * along[k] - down * normal[k]));
  const rise = Math.abs(top[1][1] - top[0][1]), thick = Math.max(0, 0.2 * (from[1] - from[0]) - rise);
  const base = Math.min(top[0][1], top[1][1]) - thick;
  return [...top, [top[1][0], base], [top[0][0], base]];
}

// The distance of the base below the frame of the body; 0 for a body that is no wedge.
function wedgeReach(body) {
  return body.wedge ? Math.max(0, -wedgeCorners(body)[2][1]) : 0;
}

// Points of couplings that the picture must contain.
function tiePoints(frameOf) {
  const points = [];
  for (const coupling of run.couplings) {
    for (const end of coupling.ends) {
      const [x, y] = couplingEnd(end, frameOf), r = Math.abs(end.radius);
      if (coupling.kind !== "roll" || end.body >= 0) points.push([x - r, y - r], [x + r, y + r]);
    }
    if (coupling.points) points.push(...coupling.points.map((p) => coupling.ends[1].body < 0 ? p : place(frameOf(coupling.ends[1].body), ...p)));
    if (coupling.span && coupling.ends[1].body >= 0) points.push(...lineEnds(coupling).map((p) => place(frameOf(coupling.ends[1].body), ...p)));
  }
  run.bodies.forEach((body, i) => {
    for (const p of body.joints) points.push(place(frameOf(i), ...p));
    if (body.wedge) for (const p of wedgeCorners(body)) points.push(place(frameOf(i), ...p));
  });
  return points;
}

// ---- static parts

function drawStillTies() {
  for (const { point, e, n, corners } of run.surfaces) if (!corners) drawSurface(point, e, n, 0);
  drawGround(run.surfaces.map(({ corners }) => corners).filter(Boolean));
  for (const coupling of run.couplings) {
    if (coupling.kind === "roll" && coupling.ends[1].body < 0) drawSurface(coupling.ends[1].point, coupling.e, coupling.n, 0);
    coupling.ends.forEach((end, k) => {
      const [x, y] = toScreen(end.point), last = k === 0 || k + 1 === coupling.ends.length;
      if (end.body >= 0 || coupling.kind === "roll" || coupling.kind === "slot") return;
      if (end.wound) drawDrum(x, y, end.radius);
      else if (coupling.kind === "rope" && last) hatch([x - 16, y], [x + 16, y], 0, -1);
      if (coupling.kind === "rope" && !end.wound) dot(x, y, 3.5, tone.soft);
      else if (coupling.kind === "weld") hatch([x - 16, y], [x + 16, y], 0, 1);
      else if (coupling.kind === "pin" || coupling.kind === "rod") drawBearing(x, y, 1);
    });
  }
}

// A fixed disc of the ground.
function drawDrum(x, y, radius) {
  drawWheel(x, y, radius * view.scale, 0, tone.hatch);
}

// ---- drawn under the bodies

function drawBoard(coupling, frame) {
  const [a, b] = lineEnds(coupling).map((point) => toScreen(place(frame, ...point)));
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1, ux = (b[0] - a[0]) / length, uy = (b[1] - a[1]) / length;
  const way = -coupling.side, thick = Math.max(6, 0.25 * coupling.ends[0].radius * view.scale);
  const down = ([x, y], d) => [x + way * uy * d, y - way * ux * d];
  drawPlate([a, b, down(b, thick), down(a, thick)], run.bodies[coupling.ends[1].body]);
  if (coupling.kind !== "rack") return;
  const pitch = 2 * Math.PI * coupling.ends[0].radius * view.scale / 12;
  pen.beginPath();
  for (let s = pitch / 2; s < length; s += pitch) {
    const p = [a[0] + s * ux, a[1] + s * uy], low = down(p, 4), high = down(p, -3);
    pen.moveTo(...low);
    pen.lineTo(...high);
  }
  strokeWith(tone.edge, 1.2);
}

// The area in a closed curve, as of a cam.
function drawCam({ ends, points }, frame) {
  const [x, y] = points[0], [endX, endY] = points[points.length - 1];
  if (Math.hypot(endX - x, endY - y) * view.scale > 1) return;
  path(points.map((point) => toScreen(place(frame, ...point))), true);
  fillWith(tintOf(run.bodies[ends[1].body]));
}

function drawTiesUnder(frames) {
  for (const coupling of run.couplings) if (coupling.points && coupling.ends[1].body >= 0) drawCam(coupling, frames[coupling.ends[1].body]);
  for (const coupling of run.couplings) if (coupling.span && coupling.ends[1].body >= 0) drawBoard(coupling, frames[coupling.ends[1].body]);
}

function drawPlate(points, body) {
  path(points, true);
  fillWith(tintOf(body));
  strokeWith(tone.edge, 1.6);
}

// A body without a shape: a wedge under a slide, the wheel of a gear, or a plate or bar through its joints.
function drawShapeless(body, frame) {
  if (body.wedge) {
    drawPlate(wedgeCorners(body).map((point) => toScreen(place(frame, ...point))), body);
  } else if (body.wheel) {
    const [x, y] = toScreen(place(frame, ...body.wheel.point)), r = body.wheel.radius * view.scale || view.block;
    drawWheel(x, y, r, 0, tintOf(body));
    drawSectors(x, y, r, 0, frame, tintOf(body, "marks"));
  } else if (body.joints.length > 1) {
    path(body.joints.map((point) => toScreen(place(frame, ...point))), true);
    pen.lineJoin = "round";
    strokeWith(tone.edge, 9);
    fillWith(tintOf(body));
    strokeWith(tintOf(body), 6);
    pen.lineJoin = "miter";
    for (const shape of body.shapes) if (shape.kind === "dot") drawShape(body, frame, shape);
  }
  return body.wedge || body.wheel || body.joints.length > 1;
}

// ---- drawn over the bodies

// The straight part of a rope between two circles that it wraps counter-clockwise (s R > 0) or clockwise: with d = C_2
// - C_1 = L u + (s_2 R_2 - s_1 R_1) n and n = k x u it touches them at C - s R n.
function straightPiece(from, to, sR1, sR2) {
  const dx = to[0] - from[0], dy = to[1] - from[1], m = sR2 - sR1, square = dx * dx + dy * dy || 1;
  const length = Math.sqrt(Math.max(square - m * m, 0));
  const ux = (dx * length + dy * m) / square, uy = (dy * length - dx * m) / square;
  return [[from[0] + sR1 * uy, from[1] - sR1 * ux], [to[0] + sR2 * uy, to[1] - sR2 * ux]];
}

// A slack rope of constant length between two points: near its taut length the sag is that of a flat parabola,
// sqrt(3 c (L - c) / 8), and with coincident ends nearly half the rope.
function hangLoose([from, to], length) {
  const chord = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const sag = Math.sqrt(3 / 16 * Math.max(length * length - chord * chord, 0));
  const middle = toScreen([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2 - 2 * sag]);
  pen.beginPath();
  pen.moveTo(...toScreen(from));
  pen.quadraticCurveTo(...middle, ...toScreen(to));
}

// True without tension, up to the rounding of a sum of floats.
function isSlack(coupling, t, row) {
  return coupling.force >= 0 && Math.hypot(valueAt(coupling.force, t, row), valueAt(coupling.force + 1, t, row)) < 1e-5 * view.force;
}

// The current path as a rope: dashed when slack, else with strands.
function strokeRope(slack) {
  strokeWith(tone.rope, slack ? 2 : 3, slack ? [5, 4] : []);
  if (!slack) strokeWith(tone.strand, 1.2, [3, 3]);
}

// The wound part of a rope: a full circle.
function drawCoil(center, radius) {
  disc(center, radius * view.scale);
  strokeRope(false);
}

// One part of a rope between pulleys, and its arc on the pulley where the part before ends.
function drawRope(coupling, before, frames, t, row) {
  const places = coupling.ends.map((end) => couplingEnd(end, (b) => frames[b])), ways = coupling.ends.map((end) => end.side * end.radius);
  const slack = isSlack(coupling, t, row), points = [];
  for (let k = 0; k + 1 < places.length; k++) points.push(...straightPiece(places[k], places[k + 1], ways[k], ways[k + 1]));
  if (slack && points.length === 2 && !ways[0] && !ways[1]) hangLoose(points, coupling.length);
  else path(points.map(toScreen));
  strokeRope(slack);
  const first = coupling.ends[0];
  if (first.radius > 0 && before && before.name === coupling.name) {
    const angle = ([x, y]) => -Math.atan2(y - places[0][1], x - places[0][0]);
    pen.beginPath();
    pen.arc(...toScreen(places[0]), first.radius * view.scale, angle(before.reached), angle(points[0]), first.side > 0);
    strokeRope(slack);
  }
  coupling.ends.forEach((end, k) => {
    if (end.wound) drawCoil(toScreen(places[k]), end.radius);
  });
  coupling.reached = points[points.length - 1];
}

// Both strands, and the belt all around its discs.
function drawBelt(coupling, frames) {
  const [a, b] = coupling.ends.map((end) => couplingEnd(end, (body) => frames[body])), [sA, sB] = coupling.ends.map((end) => end.side * end.radius);
  for (const strand of [straightPiece(a, b, sA, sB), straightPiece(b, a, sB, sA)]) {
    path(strand.map(toScreen));
    strokeRope(false);
  }
  coupling.ends.forEach((end, k) => drawCoil(toScreen(k ? b : a), end.radius));
}

// Dash-dotted pitch circles, and the teeth.
function drawGear(coupling, frames) {
  for (const end of coupling.ends) {
    const frame = frames[end.body], [x, y] = toScreen(place(frame, ...end.point)), r = Math.abs(end.radius) * view.scale;
    disc([x, y], r);
    strokeWith(tone.soft, 1.2, [9, 3, 2, 3]);
    pen.beginPath();
    for (let k = 0; k < end.teeth; k++) {
      const angle = Math.atan2(frame.s, frame.c) + end.phase + 2 * Math.PI * k / end.teeth, c = Math.cos(angle), s = Math.sin(angle);
      pen.moveTo(x + (r - 4) * c, y - (r - 4) * s);
      pen.lineTo(x + (r + 3) * c, y - (r + 3) * s);
    }
    strokeWith(tone.edge, 1.2);
  }
}

// The groove, or the face of a cam, and its pin or roller.
function drawSlot(coupling, frames) {
  const frame = (end) => end.body < 0 ? null : frames[end.body], [pin, slot] = coupling.ends, on = frame(slot);
  path(coupling.points.map((point) => toScreen(on ? place(on, ...point) : point)));
  strokeWith(tone.edge, 2);
  disc(toScreen(couplingEnd(pin, (b) => frames[b])), Math.max(pin.radius * view.scale, 3.5));
  fillWith(tone.paper);
  strokeWith(tone.edge, 1.4);
}

function drawPin([x, y]) {
  dot(x, y, 3.5, tone.paper);
  strokeWith(tone.edge, 1.4);
}

function drawWeld([x, y]) {
  for (const d of [-4, 4]) {
    path([[x - 4, y - d], [x + 4, y + d]]);
    strokeWith(tone.edge, 2);
  }
}

function drawTiesOver(frames, t, row) {
  run.couplings.forEach((coupling, i) => {
    const places = () => coupling.ends.map((end) => toScreen(couplingEnd(end, (b) => frames[b])));
    if (coupling.kind === "rope") drawRope(coupling, run.couplings[i - 1], frames, t, row);
    if (coupling.kind === "gear") drawGear(coupling, frames);
    if (coupling.kind === "belt") drawBelt(coupling, frames);
    if (coupling.kind === "pin") drawPin(places()[0]);
    if (coupling.kind === "weld") drawWeld(places()[0]);
    if (coupling.kind === "slot") drawSlot(coupling, frames);
    if (coupling.kind === "rod") {
      path(places());
      strokeWith(tone.edge, 3);
      places().forEach(drawPin);
    }
  });
}
