"use strict";

// The scene on the canvas: ground, bodies, couplings, traces.

function path(points, closed) {
  pen.beginPath();
  points.forEach(([x, y], i) => { if (i) pen.lineTo(x, y); else pen.moveTo(x, y); });
  if (closed) pen.closePath();
}

function disc([x, y], radius) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
}

function dot(x, y, radius, colour) {
  disc([x, y], radius);
  fillWith(colour);
}

function fillWith(colour) {
  pen.fillStyle = colour;
  pen.fill();
}

function strokeWith(colour, width, dash) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.setLineDash(dash || []);
  pen.stroke();
}

// ---- static parts

const hatchStep = 9, hatchDepth = 11;

function hatch(from, to, nx, ny) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const ux = (to[0] - from[0]) / length, uy = (to[1] - from[1]) / length;
  const under = ([x, y]) => [x + hatchDepth * nx, y + hatchDepth * ny];
  path([from, to, under(to), under(from)], true);
  fillWith(tone.ground);
  pen.beginPath();
  for (let d = 0; d < length; d += hatchStep) {
    const x = from[0] + d * ux, y = from[1] + d * uy;
    pen.moveTo(x, y);
    pen.lineTo(x + hatchDepth * (nx - 0.7 * ux), y + hatchDepth * (ny - 0.7 * uy));
  }
  strokeWith(tone.hatch, 1.2);
  path([from, to]);
  strokeWith(tone.soft, 1.8);
}

// Fill polygons of the ground, hatched; an outline is drawn only where it is not inside another polygon.
function drawGround(polygons) {
  const all = polygons.map((corners) => corners.map(toScreen)), far = view.width + view.height;
  for (const corners of all) {
    path(corners, true);
    strokeWith(tone.soft, 3.6);
  }
  for (const corners of all) {
    pen.save();
    path(corners, true);
    fillWith(tone.ground);
    pen.clip();
    pen.beginPath();
    for (let d = 0; d < far; d += hatchStep) {
      pen.moveTo(d, 0);
      pen.lineTo(d - view.height, view.height);
    }
    strokeWith(tone.hatch, 1);
    pen.restore();
    const area = corners.reduce((sum, [x, y], i) => sum + x * corners.at(i - 1)[1] - y * corners.at(i - 1)[0], 0), outward = Math.sign(area);
    corners.forEach((to, i) => {
      const from = corners.at(i - 1), length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
      const e = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
      view.grounds.push({ from, e, n: [-outward * e[1], outward * e[0]], length });
    });
  }
}

// ---- shadows

// Draw where a body is near the ground: darker the nearer. They show contact; no light is modelled. All in pixels of
// the canvas: e along the ground, n out of it.
function drawShadow({ from, e, n, length }, body, frame) {
  let low = Infinity, first = Infinity, last = -Infinity;
  const take = ([x, y], radius) => {
    const dx = x - from[0], dy = y - from[1], s = dx * e[0] + dy * e[1];
    low = Math.min(low, dx * n[0] + dy * n[1] - radius);
    first = Math.min(first, s - radius);
    last = Math.max(last, s + radius);
  };
  if (!isSized(body) && body.line) for (const corner of blockCorners(frame)) take(corner, 0);
  for (const shape of body.shapes) {
    const isRound = shape.kind === "circle", radius = isRound ? shape.radius * view.scale : shape.kind === "bar" ? 4 : 0;
    for (const point of isRound ? [shape.center] : shape.corners || []) take(toScreen(shapePoint(body, frame, point)), radius);
  }
  const strength = 1 - low / (24 + 0.4 * (last - first));
  if (length) [first, last] = [Math.max(first, 0), Math.min(last, length)];
  if (!(last > first) || !(strength > 0) || low < -8) return;
  const middle = (first + last) / 2;
  pen.fillStyle = tone.shadow;
  pen.globalAlpha = 0.16 * strength;
  for (const thick of [6, 3]) {
    pen.beginPath();
    pen.ellipse(from[0] + middle * e[0], from[1] + middle * e[1], (last - first) / 2 + 2 * thick - 6, thick, Math.atan2(e[1], e[0]), 0, 2 * Math.PI);
    pen.fill();
  }
  pen.globalAlpha = 1;
}

// The ends, far outside of the canvas, of a line that lies `down` pixels under the point `through`.
function acrossCanvas(through, along, normal, down) {
  const [x, y] = toScreen(through), far = view.width + view.height, ex = along[0], ey = -along[1];
  const bx = x - normal[0] * down, by = y + normal[1] * down;
  // relative to the projection of the canvas's middle, so that the ends are always far outside
  const k = (view.width / 2 - bx) * ex + (view.height / 2 - by) * ey;
  const first = hatchStep * Math.floor((k - far) / hatchStep); // hatching does not move with the view
  return [[bx + first * ex, by + first * ey], [bx + (k + far) * ex, by + (k + far) * ey]];
}

function drawSurface(through, along, normal, down) {
  const ends = acrossCanvas(through, along, normal, down);
  const ground = { from: ends[0], e: [along[0], -along[1]], n: [normal[0], -normal[1]] };
  const isSame = ({ from, n }) => Math.hypot(n[0] - ground.n[0], n[1] - ground.n[1], from[0] - ends[0][0], from[1] - ends[0][1]) < 0.5;
  if (view.grounds.some(isSame)) return; // contacts of several bodies with one line
  hatch(...ends, -normal[0], normal[1]);
  view.grounds.push(ground);
}

// The distance on the canvas of the surface of a slide from the line of the body's x; 0 without a surface.
function surfaceBelow(body) {
  return body.line.surface ? (wedgeReach(body) || body.line.reach) * view.scale || view.block * 0.7 : 0;
}

// Draw the surface under the body, or the line on which it moves.
function drawLine(body) {
  const { through, along, normal, surface } = body.line;
  if (surface) {
    drawSurface(through, along, normal, surfaceBelow(body));
  } else {
    path(acrossCanvas(through, along, normal, 0));
    strokeWith(tone.line, 1, [6, 4]);
  }
}

// Draw the curve of a track in the frame of its carrier; on the ground (null) in the world.
function drawTrack(body, frame) {
  path(body.track.points.map((point) => toScreen(frame ? place(frame, ...point) : point)));
  strokeWith(tone.hatch, 6);
  strokeWith(tone.soft, 1.8);
}

function drawAxis(body) {
  const hangs = Math.hypot(...body.G) > 0 && body.G[1] <= 0.3 * Math.hypot(...body.G);
  drawBearing(...toScreen(body.axis), hangs ? -1 : 1);
}

// Draw a bearing on ground below (d = 1) or above (-1).
function drawBearing(x, y, d) {
  path([[x, y], [x - 9, y + 15 * d], [x + 9, y + 15 * d]], true);
  fillWith(tone.paper);
  strokeWith(tone.soft, 1.5);
  hatch([x - 18, y + 15 * d], [x + 18, y + 15 * d], 0, d);
}

function drawDamper(a, b, at) {
  path([at(0.72, 7), at(0.38, 7), at(0.38, -7), at(0.72, -7)]);
  fillWith(tone.ground);
  strokeWith(tone.edge, 1.6);
  for (const line of [[a, at(0.38, 0)], [at(0.55, 6), at(0.55, -6)], [at(0.55, 0), b]]) {
    path(line);
    strokeWith(tone.edge, 2);
  }
}

// A coil of nine turns seen from the side: a circle that moves along the spring.
function drawSpring(a, b, at, length) {
  const turns = 9, round = 14, radius = Math.min(9, length / 6), points = [a];
  for (let i = 0; i <= turns * round; i++) {
    const turn = 2 * Math.PI * i / round;
    points.push(at(0.12 + 0.76 * i / (turns * round) + 0.5 * radius / length * (Math.cos(turn) - 1), radius * Math.sin(turn)));
  }
  path([...points, b]);
  pen.lineJoin = "round";
  strokeWith(tone.edge, 3);
  strokeWith(tone.line, 1);
  pen.lineJoin = "miter";
}

function drawLink(link, frames) {
  const end = place(frames[link.body], ...link.point), shift = link.offset || [0, 0];
  const a = toScreen(link.partner < 0 ? link.anchor : place(frames[link.partner], ...link.anchor)), b = toScreen([end[0] + shift[0], end[1] + shift[1]]);
  const dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy);
  if (!(length > 1)) return;
  const at = (along, across) => [a[0] + dx * along - dy / length * across, a[1] + dy * along + dx / length * across];
  if (link.kind === "damper") drawDamper(a, b, at); else drawSpring(a, b, at, length);
  if (link.wall) { // across the slide, hatched on the far side
    const wx = 14 * link.wall[0], wy = -14 * link.wall[1];
    hatch([a[0] - wx, a[1] - wy], [a[0] + wx, a[1] + wy], -dx / length, -dy / length);
    return;
  }
  dot(a[0], a[1], 3, tone.soft);
}

function drawStill() {
  const moving = pen;
  still.width = canvas.width;
  still.height = canvas.height;
  pen = still.getContext("2d");
  pen.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  pen.fillStyle = tone.paper;
  pen.fillRect(0, 0, view.width, view.height);
  const lines = new Set();
  view.grounds = [];
  for (const body of run.bodies) {
    if (body.axis && Math.hypot(...body.G) > 0) drawAxis(body);
    if (!body.line || body.line.on >= 0) continue;
    const same = JSON.stringify(body.line); // bodies on one surface share its drawing
    if (!lines.has(same)) drawLine(body);
    lines.add(same);
  }
  for (const body of run.bodies) if (body.track && body.track.on < 0) drawTrack(body, null);
  drawStillTies();
  pen = moving;
}

// ---- bodies

// The colour of a body's area, or of the marks on it; its curves in the plots have the same hue.
function tintOf(body, part = "tints") {
  return tone[part][body.index % curveCount];
}

function drawWheel(x, y, outer, inner, colour) {
  disc([x, y], outer);
  if (inner > 0) pen.arc(x, y, inner, 0, 2 * Math.PI, true);
  fillWith(colour);
  strokeWith(tone.edge, 1.6);
}

// Darker sectors of a disc (two) or ring (eight), which turn with it.
function drawSectors(x, y, outer, inner, frame, colour) {
  const count = inner > 0 ? 8 : 2, zero = -Math.atan2(frame.s, frame.c);
  pen.beginPath();
  for (let k = 0; k < count; k++) {
    const from = zero + 2 * Math.PI * k / count, to = from + Math.PI / count;
    pen.moveTo(x + inner * Math.cos(from), y + inner * Math.sin(from));
    pen.arc(x, y, outer, from, to);
    pen.arc(x, y, inner, to, from, true);
  }
  fillWith(colour);
}

function drawShape(body, frame, shape) {
  const at = (point) => toScreen(shapePoint(body, frame, point));
  const [x, y] = at(shape.center), fill = shape.hole ? tone.paper : tintOf(body);
  if (shape.kind === "circle") {
    const outer = Math.max(shape.radius * view.scale, 4), inner = (shape.inner || 0) * view.scale;
    drawWheel(x, y, outer, inner, fill);
    if (!shape.hole && body.motion !== "particle") drawSectors(x, y, outer, inner, frame, tintOf(body, "marks"));
    disc([x, y], outer);
    strokeWith(tone.edge, 1.6);
  } else if (shape.kind === "polygon") {
    path(shape.corners.map(at), true);
    fillWith(fill);
    strokeWith(tone.edge, 1.6);
  } else if (shape.kind === "bar") {
    path(shape.corners.map(at));
    pen.lineCap = "round";
    strokeWith(tone.edge, 9);
    strokeWith(fill, 6);
    pen.lineCap = "butt";
  } else {
    dot(x, y, 6, tone.edge);
    dot(x, y, 4.4, tintOf(body, "marks"));
  }
}

function blockCorners(frame) {
  const w = view.block, h = 0.7 * view.block, [x, y] = toScreen([frame.x, frame.y]);
  return [[w, h], [-w, h], [-w, -h], [w, -h]].map(([a, b]) => [x + a * frame.c - b * frame.s, y - a * frame.s - b * frame.c]);
}

function drawBody(body, frame) {
  if (drawShapeless(body, frame)) return;
  if (body.joint && body.motion === "pivot") {
    const axis = toScreen([frame.x, frame.y]);
    for (const shape of body.shapes) {
      path([axis, toScreen(shapePoint(body, frame, shape.center))]);
      strokeWith(tone.edge, 1.4);
    }
  }
  if (!isSized(body) && body.board) return;
  if (!isSized(body) && body.line) { drawPlate(blockCorners(frame), body); return; }
  for (const hole of [false, true]) for (const shape of body.shapes) if (Boolean(shape.hole) === hole) drawShape(body, frame, shape);
}

// Keep labels off the bars.
function avoidBars(frames) {
  run.bodies.forEach((body, i) => {
    for (const { kind, corners } of body.shapes)
      if (kind === "bar") avoidLine(...toScreen(shapePoint(body, frames[i], corners[0])), ...toScreen(shapePoint(body, frames[i], corners[1])));
  });
}

// Draw the path of the last rows: usually of the whole run, for a long one of a readable part.
function drawTrace(body, t) {
  const most = 2500, pieces = 300, point = tracePoint(body), points = [];
  const start = times[Math.max(rowAt(t) - most, 0)];
  for (let i = 0; i < pieces; i++) {
    const when = start + (t - start) * i / pieces;
    points.push(toScreen(place(frameAt(body, when, rowAt(when)), ...point)));
  }
  points.push(toScreen(place(frameAt(body, t, rowAt(t)), ...point)));
  path(points);
  strokeWith(tone.trace, 1.2, [4, 3]);
}

// Draw everything at time t. shows: {forces, names, values, axes, velocity, trace, follow}; forces and names of
// `chosen` or, when null, all. The view follows the chosen body, or the first one.
function drawScene(t, shows, chosen) {
  const row = rowAt(t), frames = run.bodies.map((body) => frameAt(body, t, row));
  view.following = shows.follow;
  if (shows.follow) follow(run.bodies[chosen || 0], frames[chosen || 0]);
  pen.drawImage(still, 0, 0, view.width, view.height);
  if (shows.trace) for (const body of run.bodies) drawTrace(body, t);
  for (const link of run.links) drawLink(link, frames);
  for (const body of run.bodies) if (body.track && body.track.on >= 0) drawTrack(body, frames[body.track.on]);
  drawTiesUnder(frames);
  for (const ground of view.grounds) run.bodies.forEach((body, i) => drawShadow(ground, body, frames[i]));
  run.bodies.forEach((body, i) => drawBody(body, frames[i]));
  drawTiesOver(frames, t, row);
  run.bodies.forEach((body, i) => {
    if (body.motion !== "pivot") return;
    if (body.axis && Math.hypot(...body.G) === 0) drawAxis(body);
    drawPin(toScreen([frames[i].x, frames[i].y]));
  });
  beginLabels();
  avoidBars(frames);
  if (shows.axes) drawScales(shows);
  if (shows.axes) drawAngles(frames, t, row, chosen);
  run.bodies.forEach((body, i) => {
    if (chosen !== null && chosen !== i) return;
    if (shows.forces) drawForces(body, frames[i], t, row, shows);
    if (shows.velocity) drawVelocity(body, frames[i], t, row, shows);
  });
  placeLabels();
}
