"use strict";

// The scene on the canvas: ground, bodies, couplings, traces.

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

// ---- static parts

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
  hatch(...acrossCanvas(through, along, normal, down), -normal[0], normal[1]);
}

// Draw the surface under the body, or the line on which it moves.
function drawLine(body) {
  const { through, along, normal, surface, reach } = body.line;
  if (surface) {
    drawSurface(through, along, normal, wedgeReach(body) * view.scale || reach * view.scale || view.block * 0.7);
  } else {
    path(acrossCanvas(through, along, normal, 0));
    strokeWith(view.colour.line, 1, [6, 4]);
  }
}

// Draw the curve of a track in the frame of its carrier; on the ground (null) in the world.
function drawTrack(body, frame) {
  path(body.track.points.map((point) => toScreen(frame ? place(frame, ...point) : point)));
  strokeWith(view.colour.line, 1.5);
}

function drawAxis(body) {
  const hangs = Math.hypot(...body.G) > 0 && body.G[1] <= 0.3 * Math.hypot(...body.G);
  drawBearing(...toScreen(body.axis), hangs ? -1 : 1);
}

// Draw a bearing on ground below (d = 1) or above (-1).
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
  const lines = new Set();
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
    path([[x, y], at([shape.center[0] + shape.radius, shape.center[1]])]); // shows the rotation
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
  strokeWith(view.colour.trace, 1.2, [4, 3]);
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
