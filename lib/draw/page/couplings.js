"use strict";

// Couplings; and bodies without a shape in the file, drawn by the points where joints and couplings act.

// The ends of a coupling in the world; frames[-1], that of the ground, is undefined.
function endsOf(coupling, frames) {
  return coupling.ends.map(({ body, point }) => placed(frames[body], point));
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
  coupling.lift = 0;
  coupling.span = bounds(survey.flatMap(({ frames }, i) => {
    const center = placed(frames[circle.body], circle.point), [x, y] = line.body < 0 ? center : inFrame(frames[line.body], center);
    const dx = x - line.point[0], dy = y - line.point[1];
    const along = dx * ex + dy * ey;
    if (coupling.kind === "rack" && i === 0) coupling.lift = dx * coupling.n[0] + dy * coupling.n[1] - circle.radius;
    return [along - circle.radius, along + circle.radius];
  }));
}

// Set the ends of a slot without ends: somewhat beyond the path of its point.
function prepareSlot(coupling) {
  prepareLine(coupling);
  const [low, high] = coupling.span, pad = 0.15 * (high - low);
  coupling.span = [low - pad, high + pad];
  coupling.points = lineEnds(coupling);
}

// Give both wheels teeth of the same pitch that mesh at the start.
function prepareGear(coupling) {
  const { frames } = survey[0], [a, b] = endsOf(coupling, frames), centres = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const least = Math.min(...coupling.ends.map((end) => Math.abs(end.radius)));
  coupling.ends.forEach((end, k) => {
    const contact = k === 1 || coupling.ends[1].radius < 0 ? centres + Math.PI : centres, frame = frames[end.body];
    end.teeth = Math.round(12 * Math.abs(end.radius) / least);
    end.phase = contact - frame.angle + (k === 1 ? Math.PI / end.teeth : 0);
    if (end.radius > 0) run.bodies[end.body].wheel = end;
  });
}

// The points of a body's joints, couplings and springs, once each.
function jointsOf(index) {
  const { frames } = survey[0], found = [];
  const add = (point) => {
    if (!found.some((other) => Math.hypot(other[0] - point[0], other[1] - point[1]) < 1e-9)) found.push(point);
  };
  if (run.bodies[index].joint) add([0, 0]);
  run.bodies.forEach((body, i) => {
    if (body.joint && body.parent === index) add(inFrame(frames[index], [frames[i].x, frames[i].y]));
  });
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
    const { kind, ends } = coupling;
    coupling.on = ends[1]?.body ?? -1;
    coupling.board = (kind === "roll" || kind === "rack") && coupling.on >= 0;
    if (coupling.board) run.bodies[coupling.on].board = true;
    if (kind === "roll" || kind === "rack") prepareLine(coupling);
    if (kind === "slot" && !coupling.points) prepareSlot(coupling);
    if (kind === "gear") prepareGear(coupling);
  }
  run.bodies.forEach((body, index) => {
    body.joints = body.motion !== "slide" && body.motion !== "particle" && !isSized(body) ? jointsOf(index) : [];
    if (body.joints.length === 1 && body.shapes[0]?.kind === "unknown" && !body.arm) body.wheel = body.wheel || { point: body.G };
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
    const { through, along, normal } = body.line, places = survey.map(({ frames }) => {
      const frame = frames[body.index], [x, y] = inFrame(frames[under.index], [frame.x, frame.y]);
      return (x - through[0]) * along[0] + (y - through[1]) * along[1];
    });
    const [low, high] = bounds(places), pad = 0.15 * (high - low) || 0.1;
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
function tiePoints(frames) {
  const points = [], add = (frame, list) => points.push(...list.map((point) => placed(frame, point)));
  for (const coupling of run.couplings) {
    const places = endsOf(coupling, frames), on = frames[coupling.on];
    coupling.ends.forEach((end, k) => {
      const [x, y] = places[k], r = Math.abs(end.radius);
      if (coupling.kind !== "roll" || end.body >= 0) points.push([x - r, y - r], [x + r, y + r]);
    });
    if (coupling.points) add(on, coupling.points);
    if (coupling.board) add(on, lineEnds(coupling));
  }
  run.bodies.forEach((body, i) => add(frames[i], body.wedge ? wedgeCorners(body) : body.joints));
  return points;
}

// ---- static parts

function drawStillTies() {
  for (const { point, e, n, speed } of run.surfaces) if (point) drawSurface(point, e, n, 0, speed);
  drawGround(run.surfaces.filter(({ corners }) => corners));
  for (const { kind, ends, e, n, speed } of run.couplings) {
    if (kind === "roll" && ends[1].body < 0) drawSurface(ends[1].point, e, n, 0, speed);
    ends.forEach((end, k) => {
      const [x, y] = toScreen(end.point), last = k === 0 || k + 1 === ends.length;
      if (end.body >= 0 || kind === "roll" || kind === "slot") return;
      if (end.wound) drawWheel([x, y], end.radius * view.scale, 0, tone.hatch);
      else if (kind === "rope" && last) drawWall([x, y], [0, -1]);
      if (kind === "rope" && !end.wound) dot(x, y, 3.5, tone.soft);
      else if (kind === "weld") drawClamp([x, y], run.bodies[ends[1 - k].body]);
      else if (kind === "pin" || kind === "rod") drawBearing(x, y, 1);
    });
  }
}

// The wall of a body that is welded to the ground at a point of the canvas, away from its centre of mass.
function drawClamp(at, body) {
  const [far, ...way] = wayTo(onCanvas(survey[0].frames[body.index], body.G), at);
  drawWall(at, far > 1 ? way : [0, 1]);
}

// ---- drawn under the bodies

function drawBoard(coupling, frame) {
  const [a, b] = lineEnds(coupling).map((point) => onCanvas(frame, point));
  const [length, ux, uy] = wayTo(a, b), way = -coupling.side, thick = Math.max(6, 0.25 * coupling.ends[0].radius * view.scale);
  const down = ([x, y], d) => [x + way * uy * d, y - way * ux * d];
  drawPlate([a, b, down(b, thick), down(a, thick)], tintOf(run.bodies[coupling.on]));
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
function drawCam({ on, points }, frame) {
  if (wayTo(points[0], points.at(-1))[0] * view.scale > 1) return;
  path(points.map((point) => onCanvas(frame, point)), true);
  fillWith(tintOf(run.bodies[on]));
}

function drawTiesUnder(frames) {
  for (const coupling of run.couplings) {
    if (coupling.points && coupling.on >= 0) drawCam(coupling, frames[coupling.on]);
    if (coupling.board) drawBoard(coupling, frames[coupling.on]);
  }
}

function drawPlate(points, colour) {
  outline(points, true);
  fillWith(colour);
  strokeWith(tone.edge, 1.6);
}

// A body without a shape: a wedge under a slide, the wheel of a gear, or a plate or bar through its joints.
function drawShapeless(body, frame) {
  if (body.wedge) {
    drawPlate(wedgeCorners(body).map((point) => onCanvas(frame, point)), tintOf(body));
  } else if (body.wheel) {
    drawWheel(onCanvas(frame, body.wheel.point), body.wheel.radius * view.scale || view.block, 0, tintOf(body), frame, tintOf(body, "marks"));
  } else if (body.joints.length > 1) {
    outline(body.joints.map((point) => onCanvas(frame, point)), true);
    strokeWith(tone.edge, 9);
    fillWith(tintOf(body));
    strokeWith(tintOf(body), 6);
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
  const [chord] = wayTo(from, to), sag = Math.sqrt(3 / 16 * Math.max(length * length - chord * chord, 0));
  const middle = toScreen([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2 - 2 * sag]);
  pen.beginPath();
  pen.moveTo(...toScreen(from));
  pen.quadraticCurveTo(...middle, ...toScreen(to));
}

// True without tension, up to the rounding of a sum of floats.
function isSlack(coupling, t) {
  return coupling.force >= 0 && Math.hypot(...valuesAt([coupling.force, coupling.force + 1], t)) < 1e-5 * view.force;
}

// The current path as a rope: dashed when slack, else with strands.
function strokeRope(slack) {
  strokeWith(tone.rope, slack ? 2 : 3, slack ? [5, 4] : []);
  if (!slack) strokeWith(tone.strand, 1.2, [3, 3]);
}

// The wound parts of a rope, and those of a belt: full circles.
function drawCoils(coupling, places) {
  coupling.ends.forEach((end, k) => {
    if (!end.wound) return;
    disc(toScreen(places[k]), end.radius * view.scale);
    strokeRope(false);
  });
}

// One part of a rope between pulleys, and its arc on the pulley where the part before ends.
function drawRope(coupling, frames, t, before) {
  const places = endsOf(coupling, frames), ways = coupling.ends.map((end) => end.side * end.radius);
  const slack = isSlack(coupling, t), points = [];
  for (let k = 0; k + 1 < places.length; k++) points.push(...straightPiece(places[k], places[k + 1], ways[k], ways[k + 1]));
  if (slack && points.length === 2 && !ways[0] && !ways[1]) hangLoose(points, coupling.length);
  else outline(points.map(toScreen));
  strokeRope(slack);
  const first = coupling.ends[0];
  if (first.radius > 0 && before && before.name === coupling.name) {
    const angle = ([x, y]) => -Math.atan2(y - places[0][1], x - places[0][0]);
    pen.beginPath();
    pen.arc(...toScreen(places[0]), first.radius * view.scale, angle(before.reached), angle(points[0]), first.side > 0);
    strokeRope(slack);
  }
  drawCoils(coupling, places);
  coupling.reached = points.at(-1);
}

// Both strands, and the belt all around its discs.
function drawBelt(coupling, frames) {
  const [a, b] = endsOf(coupling, frames), [sA, sB] = coupling.ends.map((end) => end.side * end.radius);
  for (const strand of [straightPiece(a, b, sA, sB), straightPiece(b, a, sB, sA)]) {
    outline(strand.map(toScreen));
    strokeRope(false);
  }
  drawCoils(coupling, [a, b]);
}

// Dash-dotted pitch circles, and the teeth.
function drawGear(coupling, frames) {
  for (const end of coupling.ends) {
    const frame = frames[end.body], [x, y] = onCanvas(frame, end.point), r = Math.abs(end.radius) * view.scale;
    disc([x, y], r);
    strokeWith(tone.soft, 1.2, [9, 3, 2, 3]);
    pen.beginPath();
    for (let k = 0; k < end.teeth; k++) {
      const angle = frame.angle + end.phase + 2 * Math.PI * k / end.teeth, c = Math.cos(angle), s = Math.sin(angle);
      pen.moveTo(x + (r - 4) * c, y - (r - 4) * s);
      pen.lineTo(x + (r + 3) * c, y - (r + 3) * s);
    }
    strokeWith(tone.edge, 1.2);
  }
}

// The groove, or the face of a cam, and its pin or roller.
function drawSlot(coupling, frames) {
  const [pin] = coupling.ends;
  path(coupling.points.map((point) => onCanvas(frames[coupling.on], point)));
  strokeWith(tone.edge, 2);
  drawPin(onCanvas(frames[pin.body], pin.point), Math.max(pin.radius * view.scale, 3.5));
}

function drawPin([x, y], radius = 3.5) {
  dot(x, y, radius, tone.paper);
  strokeWith(tone.edge, 1.4);
}

function drawWeld([x, y]) {
  for (const d of [-4, 4]) {
    path([[x - 4, y - d], [x + 4, y + d]]);
    strokeWith(tone.edge, 2);
  }
}

// A pin or weld, unless its points are apart without a force: it has ended, or begins later.
function drawJoint(coupling, frames, t) {
  const [a, b] = endsOf(coupling, frames).map(toScreen);
  if (wayTo(a, b)[0] < 3 || !isSlack(coupling, t)) (coupling.kind === "pin" ? drawPin : drawWeld)(a);
}

// Dashed lines from the first body of a ratio to the others.
function drawRatio(coupling, frames) {
  const [first, ...others] = coupling.ends.filter(({ body }) => body >= 0).map(({ body }) => onCanvas(frames[body], turnsAbout(run.bodies[body])));
  for (const other of others) {
    outline([first, other]);
    strokeWith(tone.soft, 1.2, [6, 4]);
  }
}

// The point about which a body is seen to turn, in its frame.
function turnsAbout(body) {
  return body.motion === "pivot" ? [0, 0] : body.G;
}

// A spring about an axis: a spiral that winds up, from the body to its carrier.
function drawSpiral(body, frame, t) {
  const [x, y] = onCanvas(frame, turnsAbout(body)), theta = valueAt(body.coordinates.at(-1), t), turns = 2.75, pieces = 90;
  path(Array.from({ length: pieces + 1 }, (none, i) => {
    const share = i / pieces, angle = frame.angle + share * (2 * Math.PI * turns - theta), radius = 5 + 15 * share;
    return [x + radius * Math.cos(angle), y - radius * Math.sin(angle)];
  }));
  strokeWith(tone.edge, 1.6);
  avoidLine(x, y, 20);
}

// Walls at which a slide or pivot stops, in the frame of its carrier: before the body, or beside the axis.
function drawStops(body, frame, shows) {
  for (const { at, beside, beyond, value, high } of body.stops) {
    const from = onCanvas(frame, at), [, ...u] = wayTo(from, onCanvas(frame, beside)), [, ...n] = wayTo(from, onCanvas(frame, beyond));
    const pivots = body.motion === "pivot", block = pivots || isSized(body) ? 0 : view.block;
    const on = (away) => from.map((x, k) => x + away * u[k] + block * n[k]);
    drawWall(on(pivots ? 30 : 0), n, 12);
    const text = pivots ? `θ ${high} ${degrees(value)}` : `x ${high} ${measured(value, run.units.length)}`;
    if (shows.axes) wantLabel(body.name + high, text, ...on(pivots ? 42 : 12), ...u, tone.soft);
  }
}

function drawRod(coupling, frames) {
  const places = endsOf(coupling, frames).map(toScreen);
  outline(places);
  strokeWith(tone.edge, 3);
  for (const at of places) drawPin(at);
}

const drawTie = { rope: drawRope, gear: drawGear, belt: drawBelt, pin: drawJoint, weld: drawJoint, ratio: drawRatio, slot: drawSlot, rod: drawRod };

function drawTiesOver(frames, t) {
  run.couplings.forEach((coupling, i) => drawTie[coupling.kind]?.(coupling, frames, t, run.couplings[i - 1]));
}
