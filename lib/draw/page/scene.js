"use strict";

// The scene on the canvas: ground, bodies, couplings, traces.

function path(points, closed) {
  pen.beginPath();
  points.forEach(([x, y], i) => { if (i) pen.lineTo(x, y); else pen.moveTo(x, y); });
  if (closed) pen.closePath();
}

// A path that labels should not lie on.
function outline(points, closed) {
  path(points, closed);
  points.forEach((to, i) => { if (i || closed) avoidLine(...points.at(i - 1), ...to); });
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

// The distance of two points, and the direction from the first one to the second.
function wayTo([x, y], [endX, endY]) {
  const length = Math.hypot(endX - x, endY - y), by = length || 1;
  return [length, (endX - x) / by, (endY - y) / by];
}

function hatch(from, to, nx, ny) {
  const [length, ux, uy] = wayTo(from, to);
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

// A wall at a point of the canvas, hatched along the unit vector [nx, ny].
function drawWall([x, y], [nx, ny], half = 16) {
  hatch([x - half * ny, y + half * nx], [x + half * ny, y - half * nx], nx, ny);
}

// The senses in which a surface runs: both if its speed varies, none if it rests.
function sensesOf(speed) {
  return speed === undefined ? [] : speed === null ? [1, -1] : [Math.sign(speed)];
}

// An arrow below a surface that runs, centred `away` along it from its middle.
function drawRunning({ e: [ex, ey], middle, speed }, away) {
  for (const way of sensesOf(speed)) plainArrow([middle[0] + (away - 15 * way) * ex, middle[1] + (away - 15 * way) * ey], [way * ex, way * ey], 30, tone.soft);
}

function nameSpeed(key, speed, at, way, shows) {
  if (shows.axes && speed) wantLabel(`${key}:runs`, measured(Math.abs(speed), run.units.speed), ...at, ...way, tone.soft);
}

// The surfaces of bodies that run: arrows along slides and lines, arcs in bodies that contacts meet all around.
function drawRunningBodies(frames, shows) {
  const draw = (key, speed, [x, y], { c, s }, [ex, ey]) => {
    const e = [c * ex - s * ey, -s * ex - c * ey], middle = [x - 9 * e[1], y + 9 * e[0]];
    drawRunning({ e, middle, speed }, 0);
    nameSpeed(key, speed, middle, [0, 1], shows);
  };
  run.bodies.forEach(({ name, line }, i) => { if (line?.on >= 0) draw(name, line.speed, onCanvas(frames[i], [0, 0]), frames[line.on], line.along); });
  for (const { name, board, on, e, n, ends: [{ body, point, radius }], speed } of run.couplings) {
    if (!board) continue;
    const [x, y] = inFrame(frames[on], placed(frames[body], point));
    draw(name, speed, onCanvas(frames[on], [x - radius * n[0], y - radius * n[1]]), frames[on], e);
  }
  for (const { body, speed } of run.surfaces) {
    if (body === undefined) continue;
    const at = onCanvas(frames[body], run.bodies[body].G);
    for (const way of sensesOf(speed)) drawArc(at, 18, way > 0 ? -0.5 : Math.PI + 0.5, 4.1 * way, tone.soft, () => strokeWith(tone.soft, 2.2), 0);
    nameSpeed(body, speed, [at[0], at[1] + 18], [0, 1], shows);
  }
}

// Keep a surface of the ground for shadows and the label of its speed, which are below its `middle`.
function groundAt(from, to, e, n, speed, length) {
  const ground = { from, e, n, speed, length, middle: from.map((x, k) => (x + to[k]) / 2 - 20 * n[k]) };
  view.grounds.push(ground);
  return ground;
}

// Fill polygons of the ground, hatched; an outline is drawn only where it is not inside another polygon. A surface that
// runs does so counter-clockwise.
function drawGround(polygons) {
  const all = polygons.map(({ corners, speed }) => ({ corners: corners.map(toScreen), speed })), far = view.width + view.height;
  for (const { corners } of all) {
    path(corners, true);
    strokeWith(tone.soft, 3.6);
  }
  for (const { corners, speed } of all) {
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
      const from = corners.at(i - 1), [length, ...e] = wayTo(from, to), n = [-outward * e[1], outward * e[0]];
      drawRunning(groundAt(from, to, e, n, speed && outward * speed, length), 0);
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
  if (!isSized(body) && body.line) for (const corner of blockCorners(body, frame)) take(corner, 0);
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

function drawSurface(through, along, normal, down, speed) {
  const ends = acrossCanvas(through, along, normal, down);
  const n = [normal[0], -normal[1]], isSame = (other) => wayTo(other.n, n)[0] + wayTo(other.from, ends[0])[0] < 0.5;
  if (view.grounds.some(isSame)) return; // contacts of several bodies with one line
  hatch(...ends, -normal[0], normal[1]);
  const ground = groundAt(...ends, [along[0], -along[1]], n, speed);
  for (let away = -1600; away <= 1600; away += 160) drawRunning(ground, away);
}

// The distance on the canvas of the surface of a slide from the line of the body's x; 0 without a surface.
function surfaceBelow(body) {
  return body.line.surface ? (wedgeReach(body) || body.line.reach) * view.scale || view.block * 0.7 : 0;
}

// Draw the surface under the body, or the line on which it moves.
function drawLine(body) {
  const { through, along, normal, surface, speed } = body.line;
  if (surface) {
    drawSurface(through, along, normal, surfaceBelow(body), speed);
  } else {
    path(acrossCanvas(through, along, normal, 0));
    strokeWith(tone.line, 1, [6, 4]);
  }
}

// Draw the curve of a track in the frame of its carrier.
function drawTrack(body, frame) {
  path(body.track.points.map((point) => onCanvas(frame, point)));
  strokeWith(tone.hatch, 6);
  strokeWith(tone.soft, 1.8);
}

function drawAxis(body) {
  const hangs = body.arm > 0 && body.G[1] <= 0.3 * body.arm;
  drawBearing(...toScreen(body.axis), hangs ? -1 : 1);
}

// Draw a bearing on ground below (d = 1) or above (-1).
function drawBearing(x, y, d) {
  path([[x, y], [x - 9, y + 15 * d], [x + 9, y + 15 * d]], true);
  fillWith(tone.paper);
  strokeWith(tone.soft, 1.5);
  drawWall([x, y + 15 * d], [0, d], 18);
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

// A cylinder at the first point, with its rod at the second one.
function drawRam(a, b, at) {
  path([a, b]);
  strokeWith(tone.edge, 3);
  drawPlate([at(0.15, 7), at(0.65, 7), at(0.65, -7), at(0.15, -7)], tone.ground);
}

// A coil of nine turns seen from the side: a circle that moves along the spring.
function drawSpring(a, b, at, length) {
  const turns = 9, round = 14, radius = Math.min(9, length / 6), points = [a];
  for (let i = 0; i <= turns * round; i++) {
    const turn = 2 * Math.PI * i / round;
    points.push(at(0.12 + 0.76 * i / (turns * round) + 0.5 * radius / length * (Math.cos(turn) - 1), radius * Math.sin(turn)));
  }
  path([...points, b]);
  strokeWith(tone.edge, 3);
  strokeWith(tone.line, 1);
}

function drawLink(link, frames) {
  const [nx, ny] = link.wall || [0, 0], { beside = 0 } = link;
  const end = (frame, point) => { const [x, y] = onCanvas(frame, point); return [x + beside * nx, y - beside * ny]; };
  const a = end(frames[link.partner], link.anchor), b = end(frames[link.body], link.point);
  const [length, ux, uy] = wayTo(a, b), at = (along, across) => [a[0] + ux * length * along - uy * across, a[1] + uy * length * along + ux * across];
  ({ damper: drawDamper, actuator: drawRam }[link.kind] || drawSpring)(a, b, at, length);
  avoidLine(...a, ...b);
  if (link.wall) drawWall(a, [-ux, -uy], 14);
  else dot(a[0], a[1], 3, tone.soft);
}

function drawStill() {
  const moving = pen, { width, height } = canvas;
  Object.assign(still, { width, height });
  pen = still.getContext("2d");
  pen.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  pen.fillStyle = tone.paper;
  pen.fillRect(0, 0, view.width, view.height);
  view.grounds = [];
  for (const body of run.bodies) {
    if (body.axis && body.arm > 0) drawAxis(body);
    if (body.line?.on < 0) drawLine(body);
    if (body.motion === "weld" && body.parent < 0) drawClamp(onCanvas(survey[0].frames[body.index], [0, 0]), body);
  }
  for (const body of run.bodies) if (body.track?.on < 0) drawTrack(body);
  drawStillTies();
  pen = moving;
}

// ---- bodies

// The colour of a body's area, or of the marks on it; its curves in the plots have the same hue.
function tintOf(body, part = "tints") {
  return tone[part][body.index % curveCount];
}

// A disc or ring; with a frame also its sectors.
function drawWheel([x, y], outer, inner, colour, frame, marks) {
  avoidLine(x, y, outer);
  const trace = () => {
    disc([x, y], outer);
    if (inner > 0) pen.arc(x, y, inner, 0, 2 * Math.PI, true);
  };
  trace();
  fillWith(colour);
  if (frame) drawSectors(x, y, outer, inner, frame, marks);
  trace();
  strokeWith(tone.edge, 1.6);
}

// Darker sectors of a disc (two) or ring (eight), which turn with it.
function drawSectors(x, y, outer, inner, frame, colour) {
  const count = inner > 0 ? 8 : 2, zero = -frame.angle;
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
  const [x, y] = at(shape.center), fill = shape.hole ? tone.paper : tintOf(body), marks = tintOf(body, "marks");
  if (shape.kind === "circle") {
    const turns = !shape.hole && body.motion !== "particle" && frame;
    drawWheel([x, y], Math.max(shape.radius * view.scale, 4), (shape.inner || 0) * view.scale, fill, turns, marks);
  } else if (shape.kind === "polygon") {
    drawPlate(shape.corners.map(at), fill);
  } else if (shape.kind === "bar") {
    outline(shape.corners.map(at));
    pen.lineCap = "round";
    strokeWith(tone.edge, 9);
    strokeWith(fill, 6);
    pen.lineCap = "butt";
  } else {
    dot(x, y, 6, tone.edge);
    dot(x, y, 4.4, marks);
  }
}

// A block stands on the line of its slide on a body with a size; elsewhere the line goes through its middle.
function blockCorners({ line, share }, frame) {
  const w = view.block * share, h = 0.7 * w, [x, y] = toScreen([frame.x, frame.y]);
  const low = line.on >= 0 && isSized(run.bodies[line.on]) ? 0 : line.surface ? -0.7 * view.block : -h;
  return [[w, low + 2 * h], [-w, low + 2 * h], [-w, low], [w, low]].map(([a, b]) => [x + a * frame.c - b * frame.s, y - a * frame.s - b * frame.c]);
}

function drawBody(body, frame) {
  if (drawShapeless(body, frame)) return;
  if (body.motion === "pivot") {
    const axis = toScreen([frame.x, frame.y]);
    for (const shape of body.shapes) {
      path([axis, toScreen(shapePoint(body, frame, shape.center))]);
      strokeWith(tone.edge, 1.4);
    }
  }
  if (!isSized(body) && body.board) return;
  if (!isSized(body) && body.line) { drawPlate(blockCorners(body, frame), tintOf(body)); return; }
  for (const hole of [false, true]) for (const shape of body.shapes) if (Boolean(shape.hole) === hole) drawShape(body, frame, shape);
}

// Draw the path of the last rows: usually of the whole run, for a long one of a readable part.
function drawTrace(body, t) {
  const most = 2500, pieces = 300, point = tracePoint(body), points = [];
  const start = times[Math.max(rowAt(t) - most, 0)];
  for (let i = 0; i <= pieces; i++) points.push(onCanvas(frameAt(body, start + (t - start) * i / pieces), point));
  path(points);
  strokeWith(tone.trace, 1.2, [4, 3]);
}

// Draw everything at time t. shows: {forces, names, values, axes, velocity, trace, follow}; forces and names of
// `chosen` or, when null, all. The view follows the chosen body, or the first one.
function drawScene(t, shows, chosen) {
  const frames = framesAt(t);
  beginLabels();
  if (shows.follow) follow(run.bodies[chosen || 0], frames[chosen || 0]);
  pen.drawImage(still, 0, 0, view.width, view.height);
  if (shows.trace) for (const body of run.bodies) drawTrace(body, t);
  for (const link of run.links) drawLink(link, frames);
  for (const body of run.bodies) if (body.track?.on >= 0) drawTrack(body, frames[body.track.on]);
  drawTiesUnder(frames);
  view.grounds.forEach((ground, k) => {
    const { n: [nx, ny], middle, speed } = ground;
    run.bodies.forEach((body, i) => drawShadow(ground, body, frames[i]));
    nameSpeed(`ground ${k}`, speed, middle, [-nx, -ny], shows);
  });
  run.bodies.forEach((body, i) => drawBody(body, frames[i]));
  drawTiesOver(frames, t);
  drawRunningBodies(frames, shows);
  run.bodies.forEach((body, i) => {
    drawStops(body, frames[body.parent], shows);
    if (body.coil) drawSpiral(body, frames[i], t);
    if (body.motion !== "pivot") return;
    if (body.axis && body.arm === 0) drawAxis(body);
    drawPin(toScreen([frames[i].x, frames[i].y]));
  });
  if (shows.axes) drawScales(shows);
  if (shows.axes) drawAngles(frames, t, chosen);
  run.bodies.forEach((body, i) => {
    if (chosen !== null && chosen !== i) return;
    if (shows.forces) drawForces(body, frames[i], t, shows);
    if (shows.velocity) drawVelocity(body, frames[i], t, shows);
  });
  placeLabels();
}
