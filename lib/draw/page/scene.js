"use strict";

// The scene on the canvas: ground, bodies, forces, velocity, trace.

const canvas = document.getElementById("scene");
let pen = canvas.getContext("2d");
const still = document.createElement("canvas"); // what does not move, drawn once
const view = { scale: 1, x: 0, y: 0, width: 0, height: 0, block: 0, force: 1, moment: 1, speed: 1, colour: {} };

// Times spread over the run, for what is measured once: bounds, scales, traces.
const survey = [];

function frameAt(body, t, row) {
  const angle = valueAt(body.frame[2], t, row);
  return { x: valueAt(body.frame[0], t, row), y: valueAt(body.frame[1], t, row), c: Math.cos(angle), s: Math.sin(angle) };
}

// A point of the body's frame in the world; shapes are told from the frame of the file, whose pin sits on the axis.
function place(frame, x, y) {
  return [frame.x + frame.c * x - frame.s * y, frame.y + frame.s * x + frame.c * y];
}

function shapePoint(body, frame, point) {
  return place(frame, point[0] - body.pin[0], point[1] - body.pin[1]);
}

function shapePoints(shape) {
  if (shape.kind !== "circle") return shape.corners || [shape.center];
  const [x, y] = shape.center, r = shape.radius;
  return [[x - r, y], [x + r, y], [x, y - r], [x, y + r]];
}

// What the eye follows: the end of a rod or the part of a pivoted body that is farthest from its axis, else G.
function tracePoint(body) {
  let best = body.G, most = -1;
  if (body.motion !== "pivot") return best;
  for (const shape of body.shapes) {
    for (const point of shape.kind === "bar" ? shape.corners : [shape.center]) {
      const x = point[0] - body.pin[0], y = point[1] - body.pin[1], far = Math.hypot(x, y);
      if (far > most * 1.0001) { most = far; best = [x, y]; }
    }
  }
  return most > 0 ? best : body.G;
}

function percentile(values) {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  return sorted.length ? sorted[Math.floor(0.85 * (sorted.length - 1))] : 0;
}

// A spring or damper along a slide has its other end at a wall that the model does not place: above, on a level
// slide behind the least coordinate.
function placeWalls() {
  run.links.forEach((link, i) => {
    if (link.anchor) return;
    const { through, along, normal } = run.bodies[link.body].line;
    const xs = survey.map((t) => valueAt(run.bodies[link.body].coordinates[0], t, rowAt(t)));
    const least = Math.min(...xs), most = Math.max(...xs), range = most - least || 1;
    const x = along[1] > 0.1 ? most + 0.5 * range : least - 0.5 * range;
    const beside = run.links.findIndex((other) => other.body === link.body) === i ? 0 : 0.06 * range; // two lie side by side
    link.anchor = [through[0] + x * along[0] + beside * normal[0], through[1] + x * along[1] + beside * normal[1]];
    link.offset = [beside * normal[0], beside * normal[1]];
    link.wall = normal;
  });
}

// The rectangle that the bodies stay in, and the sizes of forces, moments and speeds.
function measure() {
  for (let i = 0; i <= 400; i++) survey[i] = run.start + (run.end - run.start) * i / 400;
  let left = Infinity, right = -Infinity, bottom = Infinity, top = -Infinity;
  const take = (x, y) => {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    left = Math.min(left, x); right = Math.max(right, x); bottom = Math.min(bottom, y); top = Math.max(top, y);
  };
  prepareTies();
  const step = run.bodies.length > 20 ? 8 : 1, forces = [], moments = [], speeds = [];
  for (let i = 0; i < survey.length; i += step) {
    const t = survey[i], row = rowAt(t);
    for (const point of tiePoints((b) => frameAt(run.bodies[b], t, row))) take(...point);
    for (const body of run.bodies) {
      const frame = frameAt(body, t, row);
      take(frame.x, frame.y);
      if (body.track && body.track.on < 0 && !i) for (const point of body.track.points) take(...point);
      for (const shape of body.shapes) for (const point of shapePoints(shape)) take(...shapePoint(body, frame, point));
      for (const { arrow } of body.arrows) {
        forces.push(Math.hypot(valueAt(arrow[0], t, row), valueAt(arrow[1], t, row)));
        moments.push(Math.abs(valueAt(arrow[4], t, row)));
      }
      speeds.push(Math.hypot(...velocityAt(body, t, row)));
    }
  }
  placeWalls();
  for (const link of run.links) if (link.partner < 0) take(...link.anchor);
  if (left > right) { left = right = bottom = top = 0; }
  const size = Math.max(right - left, top - bottom) || 1;
  const pad = 0.16 * size;
  Object.assign(view, { left: left - pad, right: right + pad, bottom: bottom - pad, top: top + pad });
  Object.assign(view, { force: percentile(forces) || 1, moment: percentile(moments) || 1, speed: percentile(speeds) || 1 });
}

// The least distance of two parallel lines with bodies that have no size: their blocks pass each other.
function slideGap() {
  const lines = run.bodies.filter((body) => body.line && body.line.on < 0 && !isSized(body)).map((body) => body.line);
  let gap = Infinity;
  lines.forEach((a, i) => lines.slice(i + 1).forEach((b) => {
    const away = Math.abs((b.through[0] - a.through[0]) * a.normal[0] + (b.through[1] - a.through[1]) * a.normal[1]);
    const parallel = Math.abs(a.along[0] * b.along[1] - a.along[1] * b.along[0]) < 1e-9;
    if (parallel && away > 1e-3 * (view.right - view.left)) gap = Math.min(gap, away);
  }));
  return gap;
}

function velocityAt(body, t, row) {
  return [valueAt(body.velocity[0], t, row), valueAt(body.velocity[1], t, row)];
}

// Half the size of a body around its centre of mass, 0 for one without a size.
function bodyExtent(body) {
  let most = 0;
  for (const shape of body.shapes)
    if (shape.corners || shape.radius)
      for (const [x, y] of shapePoints(shape)) most = Math.max(most, Math.hypot(x - body.pin[0] - body.G[0], y - body.pin[1] - body.G[1]));
  return most;
}

// Are the bodies so small on the way that they go that nobody would see them turn?
function bodiesAreSpecks() {
  const extents = run.bodies.map(bodyExtent);
  return Math.min(...extents) > 0 && Math.max(...extents) * view.scale < 5;
}

// The eye goes with a body, near enough to see it.
function follow(body, frame) {
  const [x, y] = place(frame, ...body.G);
  view.scale = Math.max(view.wholeScale, 0.09 * Math.min(view.width, view.height) / (bodyExtent(body) || Infinity));
  view.x = view.width / 2 - view.scale * x;
  view.y = view.height / 2 + view.scale * y;
  drawStill();
}

function fit() {
  const ratio = view.ratio = window.devicePixelRatio || 1;
  view.width = canvas.clientWidth;
  view.height = canvas.clientHeight;
  canvas.width = Math.round(view.width * ratio);
  canvas.height = Math.round(view.height * ratio);
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  view.scale = Math.min(view.width / (view.right - view.left), view.height / (view.top - view.bottom));
  view.wholeScale = view.scale;
  view.x = view.width / 2 - view.scale * (view.left + view.right) / 2;
  view.y = view.height / 2 + view.scale * (view.bottom + view.top) / 2;
  view.block = Math.min(0.045 * Math.min(view.width, view.height), Math.max(7, 0.45 * view.scale * slideGap()));
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "ink", "soft", "line", "body", "edge", "gravity", "reaction", "friction", "applied", "velocity", "trace", "rope"])
    view.colour[name] = style.getPropertyValue("--" + name).trim();
  drawStill();
}

function toScreen([x, y]) {
  return [view.x + view.scale * x, view.y - view.scale * y];
}

function path(points, closed) {
  pen.beginPath();
  points.forEach(([x, y], i) => { if (i) pen.lineTo(x, y); else pen.moveTo(x, y); });
  if (closed) pen.closePath();
}

function dot(x, y, radius, colour) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
}

function strokeWith(colour, width, dash) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.setLineDash(dash || []);
  pen.stroke();
}

// ---- what does not move

const hatchStep = 9;

function hatch(from, to, nx, ny) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const ux = (to[0] - from[0]) / length, uy = (to[1] - from[1]) / length;
  path([from, to]);
  strokeWith(view.colour.soft, 1.5);
  pen.beginPath();
  for (let d = 0; d < length; d += hatchStep) {
    const x = from[0] + d * ux, y = from[1] + d * uy;
    pen.moveTo(x, y);
    pen.lineTo(x + 8 * (nx - 0.7 * ux), y + 8 * (ny - 0.7 * uy));
  }
  strokeWith(view.colour.line, 1);
}

// The ends, far outside of the canvas, of a line that lies so many pixels under the point `through`.
function acrossCanvas(through, along, normal, down) {
  const [x, y] = toScreen(through), far = view.width + view.height, ex = along[0], ey = -along[1];
  const bx = x - normal[0] * down, by = y + normal[1] * down;
  // from the foot of the canvas's middle, so that the ends are far outside wherever the line starts
  const k = (view.width / 2 - bx) * ex + (view.height / 2 - by) * ey;
  const first = hatchStep * Math.floor((k - far) / hatchStep); // marks stay where they are when the eye moves
  return [[bx + first * ex, by + first * ey], [bx + (k + far) * ex, by + (k + far) * ey]];
}

function drawSurface(through, along, normal, down) {
  hatch(...acrossCanvas(through, along, normal, down), -normal[0], normal[1]);
}

// The surface under the body, or the line that it moves on.
function drawLine(body) {
  const { through, along, normal, surface, reach } = body.line;
  if (surface) {
    drawSurface(through, along, normal, wedgeReach(body) * view.scale || reach * view.scale || view.block * 0.7);
  } else {
    path(acrossCanvas(through, along, normal, 0));
    strokeWith(view.colour.line, 1, [6, 4]);
  }
}

// The curve that the body runs on, in the frame of what it lies on; on the ground (null) in the world.
function drawTrack(body, frame) {
  path(body.track.points.map((point) => toScreen(frame ? place(frame, ...point) : point)));
  strokeWith(view.colour.line, 1.5);
}

function drawAxis(body) {
  const hangs = Math.hypot(...body.G) > 0 && body.G[1] <= 0.3 * Math.hypot(...body.G);
  drawBearing(...toScreen(body.axis), hangs ? -1 : 1);
}

// On ground below (d = 1) or above (-1).
function drawBearing(x, y, d) {
  path([[x, y], [x - 9, y + 15 * d], [x + 9, y + 15 * d]], true);
  pen.fillStyle = view.colour.paper;
  pen.fill();
  strokeWith(view.colour.soft, 1.2);
  hatch([x - 18, y + 15 * d], [x + 18, y + 15 * d], 0, d);
}

function drawLink(link, frames) {
  const end = place(frames[link.body], ...link.point), shift = link.offset || [0, 0];
  const a = toScreen(link.partner < 0 ? link.anchor : place(frames[link.partner], ...link.anchor)), b = toScreen([end[0] + shift[0], end[1] + shift[1]]);
  const dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy);
  if (!(length > 1)) return;
  const half = Math.min(6, length / 6);
  const at = (along, across) => [a[0] + dx * along - dy / length * across, a[1] + dy * along + dx / length * across];
  if (link.kind === "damper") {
    path([a, at(0.55, 0)]);
    strokeWith(view.colour.soft, 1.4);
    path([at(0.7, 6), at(0.4, 6), at(0.4, -6), at(0.7, -6)]);
    strokeWith(view.colour.soft, 1.4);
    path([at(0.55, 5), at(0.55, -5)]);
    strokeWith(view.colour.soft, 1.4);
    path([at(0.55, 0), b]);
    strokeWith(view.colour.soft, 1.4);
  } else {
    const points = [a, at(0.1, 0)];
    for (let i = 0; i < 16; i++) points.push(at(0.1 + 0.8 * (i + 0.5) / 16, i % 2 ? half : -half));
    points.push(at(0.9, 0), b);
    path(points);
    strokeWith(view.colour.soft, 1.4);
  }
  if (link.wall) { // across the slide, hatched on the far side
    const wx = 14 * link.wall[0], wy = -14 * link.wall[1];
    hatch([a[0] - wx, a[1] - wy], [a[0] + wx, a[1] + wy], -dx / length, -dy / length);
    return;
  }
  dot(a[0], a[1], 3, view.colour.soft);
}

function drawStill() {
  const moving = pen;
  still.width = canvas.width;
  still.height = canvas.height;
  pen = still.getContext("2d");
  pen.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  pen.fillStyle = view.colour.paper;
  pen.fillRect(0, 0, view.width, view.height);
  const drawn = new Set();
  for (const body of run.bodies) {
    if (body.axis && Math.hypot(...body.G) > 0) drawAxis(body);
    if (!body.line || body.line.on >= 0) continue;
    const same = JSON.stringify(body.line); // bodies on one surface share its picture
    if (!drawn.has(same)) drawLine(body);
    drawn.add(same);
  }
  for (const body of run.bodies) if (body.track && body.track.on < 0) drawTrack(body, null);
  drawStillTies();
  pen = moving;
}

// ---- bodies

function drawShape(body, frame, shape) {
  const at = (point) => toScreen(shapePoint(body, frame, point));
  const [x, y] = at(shape.center);
  pen.fillStyle = shape.hole ? view.colour.paper : view.colour.body;
  if (shape.kind === "circle") {
    pen.beginPath();
    pen.arc(x, y, Math.max(shape.radius * view.scale, 3), 0, 2 * Math.PI);
    if (shape.inner > 0) pen.arc(x, y, shape.inner * view.scale, 0, 2 * Math.PI, true);
    pen.fill();
    strokeWith(view.colour.edge, 1.4);
    path([[x, y], at([shape.center[0] + shape.radius, shape.center[1]])]); // shows that it turns
    if (!(shape.inner > 0) && body.motion !== "particle") strokeWith(view.colour.soft, 1.4);
  } else if (shape.kind === "polygon") {
    path(shape.corners.map(at), true);
    pen.fill();
    strokeWith(view.colour.edge, 1.4);
  } else if (shape.kind === "bar") {
    path(shape.corners.map(at));
    pen.lineCap = "round";
    strokeWith(view.colour.edge, 7);
    strokeWith(view.colour.body, 4.4);
    pen.lineCap = "butt";
  } else {
    dot(x, y, 5, view.colour.edge);
  }
}

function drawBlock(frame) {
  const w = view.block, h = 0.7 * view.block, [x, y] = toScreen([frame.x, frame.y]);
  const corner = (a, b) => [x + a * frame.c - b * frame.s, y - a * frame.s - b * frame.c];
  path([corner(w, h), corner(-w, h), corner(-w, -h), corner(w, -h)], true);
  pen.fillStyle = view.colour.body;
  pen.fill();
  strokeWith(view.colour.edge, 1.4);
}

function drawBody(body, frame) {
  if (drawShapeless(body, frame)) return;
  if (body.joint && body.motion === "pivot") {
    const axis = toScreen([frame.x, frame.y]);
    for (const shape of body.shapes) {
      path([axis, toScreen(shapePoint(body, frame, shape.center))]);
      strokeWith(view.colour.edge, 1.2);
    }
  }
  if (!isSized(body) && body.board) return;
  if (!isSized(body) && body.line) { drawBlock(frame); return; }
  for (const hole of [false, true]) for (const shape of body.shapes) if (Boolean(shape.hole) === hole) drawShape(body, frame, shape);
}

// ---- arrows

function head(x, y, ux, uy, colour) {
  path([[x, y], [x - 10 * ux - 4 * uy, y - 10 * uy + 4 * ux], [x - 10 * ux + 4 * uy, y - 10 * uy - 4 * ux]], true);
  pen.fillStyle = colour;
  pen.fill();
}

function arrowTo(from, dx, dy, colour) {
  const length = Math.hypot(dx, dy);
  if (!(length > 2)) return;
  const ux = dx / length, uy = dy / length, x = from[0] + dx, y = from[1] + dy;
  path([from, [x - 8 * ux, y - 8 * uy]]);
  strokeWith(colour, 2.2);
  head(x, y, ux, uy, colour);
}

const textWidths = new Map(); // all captions are of one font

function textWidth(text) {
  if (!textWidths.has(text)) textWidths.set(text, pen.measureText(text).width);
  return textWidths.get(text);
}

function caption(text, x, y, ux, uy, colour) {
  pen.font = "13px Arial, Helvetica, sans-serif";
  pen.textAlign = "left";
  pen.textBaseline = uy > 0.3 ? "top" : uy < -0.3 ? "bottom" : "middle";
  pen.lineWidth = 3;
  pen.setLineDash([]);
  pen.strokeStyle = view.colour.paper;
  // a text beside the canvas's edge is pushed in
  const width = textWidth(text), left = x + 5 * ux - width * (ux > 0.3 ? 0 : ux < -0.3 ? 1 : 0.5);
  const at = [Math.max(4, Math.min(left, view.width - width - 4)), Math.max(16, Math.min(y + 5 * uy, view.height - 16))];
  pen.strokeText(text, ...at);
  pen.fillStyle = colour;
  pen.fillText(text, ...at);
}

function arrowColour(arrow) {
  const what = arrow.name.split(".").pop(); // on the other body it is called body.normal
  if (what.startsWith("friction")) return view.colour.friction;
  if (arrow.reaction || what === "normal") return view.colour.reaction;
  if (arrow.name === "gravity") return view.colour.gravity;
  return view.colour.applied;
}

function drawCouple(from, couple, colour, text) {
  const radius = 26, sweep = Math.max(-5, Math.min(5, 4.2 * couple / view.moment));
  if (Math.abs(sweep) < 0.15) return;
  const start = -0.5, end = start - sweep;
  pen.beginPath();
  pen.arc(from[0], from[1], radius, start, end, sweep > 0);
  strokeWith(colour, 2.2);
  const x = from[0] + radius * Math.cos(end), y = from[1] + radius * Math.sin(end), way = sweep > 0 ? 1 : -1;
  head(x + 6 * way * Math.sin(end), y - 6 * way * Math.cos(end), way * Math.sin(end), -way * Math.cos(end), colour);
  if (text) caption(text, from[0] + radius, from[1] - radius, 0.7, -0.7, colour);
}

function drawForces(body, frame, t, row, names) {
  const length = 0.24 * Math.min(view.width, view.height) / view.force;
  for (const arrow of body.arrows) {
    const [fx, fy, px, py, couple] = arrow.arrow.map((c) => valueAt(c, t, row)), colour = arrowColour(arrow);
    const from = toScreen(place(frame, px, py)), dx = fx * length, dy = -fy * length, size = Math.hypot(dx, dy);
    arrowTo(from, dx, dy, colour);
    if (names && size > 6) caption(arrow.name, from[0] + dx, from[1] + dy, dx / size, dy / size, colour);
    if (couple !== 0) drawCouple(toScreen([frame.x, frame.y]), couple, colour, names && arrow.name);
  }
}

// The way of the last rows: of a usual run the whole way, of a long one what the eye can still tell apart.
function drawTrace(body, t) {
  const most = 2500, pieces = 300, point = tracePoint(body), points = [];
  const start = times[Math.max(rowAt(t) - most, 0)];
  for (let i = 0; i < pieces; i++) {
    const when = start + (t - start) * i / pieces;
    points.push(toScreen(place(frameAt(body, when, rowAt(when)), ...point)));
  }
  points.push(toScreen(place(frameAt(body, t, rowAt(t)), ...point)));
  path(points);
  strokeWith(view.colour.trace, 1.2, [4, 3]);
}

// Draw everything at time t. shows: {forces, names, velocity, trace, follow}; forces and names of `chosen` or, when
// null, all. The eye follows the chosen body, or the first one.
function drawScene(t, shows, chosen) {
  const row = rowAt(t), frames = run.bodies.map((body) => frameAt(body, t, row));
  if (shows.follow) follow(run.bodies[chosen || 0], frames[chosen || 0]);
  pen.drawImage(still, 0, 0, view.width, view.height);
  if (shows.trace) for (const body of run.bodies) drawTrace(body, t);
  for (const link of run.links) drawLink(link, frames);
  for (const body of run.bodies) if (body.track && body.track.on >= 0) drawTrack(body, frames[body.track.on]);
  drawTiesUnder(frames);
  run.bodies.forEach((body, i) => drawBody(body, frames[i]));
  drawTiesOver(frames, t, row);
  run.bodies.forEach((body, i) => {
    if (body.motion !== "pivot") return;
    if (body.axis && Math.hypot(...body.G) === 0) drawAxis(body);
    drawPin(toScreen([frames[i].x, frames[i].y]));
  });
  run.bodies.forEach((body, i) => {
    if (chosen !== null && chosen !== i) return;
    if (shows.forces) drawForces(body, frames[i], t, row, shows.names);
    if (!shows.velocity) return;
    const [vx, vy] = velocityAt(body, t, row);
    const length = 0.22 * Math.min(view.width, view.height) / view.speed;
    const from = toScreen(place(frames[i], ...body.G)), dx = vx * length, dy = -vy * length, size = Math.hypot(dx, dy);
    arrowTo(from, dx, dy, view.colour.velocity);
    if (shows.names && size > 6) caption("v", from[0] + dx, from[1] + dy, dx / size, dy / size, view.colour.velocity);
  });
}
