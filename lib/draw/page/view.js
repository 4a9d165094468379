"use strict";

// The view of the scene: its contents, the scale, zoom and pan, the colours.
//
// The scene is fitted together with its arrows. Their lengths are in pixels, so the scale is the largest one at which
// every point and every tip, at all sampled times, lies on the canvas.

const canvas = element("scene");
let pen = canvas.getContext("2d");
const still = document.createElement("canvas"); // static parts, drawn once
const view = { scale: 1, block: 0, zoom: 1, pan: [0, 0], colour: {} }, tone = view.colour;

// Pixels kept free: around, and below for the scales.
const margin = 14, strip = 40;

// Times over the run at which bounds, scales and traces are sampled: {t, frames of the bodies}.
let survey = [];

function frameAt(body, t) {
  const [x, y, angle] = valuesAt(body.frame, t);
  return { x, y, angle, c: Math.cos(angle), s: Math.sin(angle) };
}

function framesAt(t) {
  return run.bodies.map((body) => frameAt(body, t));
}

// A point of the body's frame in the world; shapes are given in the frame of the file, in which `pin` is the axis.
function place(frame, x, y) {
  return [frame.x + frame.c * x - frame.s * y, frame.y + frame.s * x + frame.c * y];
}

function shapePoint(body, frame, point) {
  return place(frame, point[0] - body.pin[0], point[1] - body.pin[1]);
}

// A point of a body, or without a frame of the ground, in the world and on the canvas.
function placed(frame, point) {
  return frame ? place(frame, ...point) : point;
}

function onCanvas(frame, point) {
  return toScreen(placed(frame, point));
}

function shapePoints(shape) {
  if (shape.kind !== "circle") return shape.corners || [shape.center];
  const [x, y] = shape.center, r = shape.radius;
  return [[x - r, y], [x + r, y], [x, y - r], [x, y + r]];
}

// The traced point: the end of a rod or the part of a pivoted body that is farthest from its axis, else G.
function tracePoint(body) {
  const all = body.shapes.flatMap((shape) => (shape.kind === "bar" ? shape.corners : [shape.center])).map(([x, y]) => [x - body.pin[0], y - body.pin[1]]);
  const far = all.reduce((best, point) => (Math.hypot(...point) > 1.0001 * Math.hypot(...best) ? point : best), [0, 0]);
  return body.motion === "pivot" && Math.hypot(...far) > 0 ? far : body.G;
}

// The size for the scale of arrows: the maximum, or the 75 % quantile if the maximum is at least three times that;
// larger arrows are drawn shorter than to scale.
function usualMost(values) {
  const sorted = values.filter((value) => Number.isFinite(value) && value > 0).sort((a, b) => a - b);
  if (!sorted.length) return 0;
  const usual = sorted[Math.floor(0.75 * (sorted.length - 1))], most = sorted[sorted.length - 1];
  return most < 3 * usual ? most : usual;
}

// Place the walls of springs and dampers along a slide, which have no position in the model: above, on a level slide
// before the least coordinate; several of a body side by side, `beside` in pixels.
function placeWalls() {
  const walled = run.links.filter((link) => !link.anchor), size = Math.max(held.right - held.left, held.top - held.bottom);
  for (const link of walled) {
    const { through, along, normal } = run.bodies[link.body].line, same = walled.filter((other) => other.body === link.body);
    const [least, most] = bounds(survey.map(({ t }) => valueAt(run.bodies[link.body].coordinates[0], t))), range = Math.max(most - least, 0.2 * size) || 1;
    const x = along[1] > 0.1 ? most + 0.5 * range : least - 0.5 * range;
    link.anchor = [through[0] + x * along[0], through[1] + x * along[1]];
    link.beside = 16 * (same.indexOf(link) - (same.length - 1) / 2);
    link.wall = normal;
  }
}

// The bounds of the picture, in the world, and its arrows: {x, y, fx, fy}, or the centres of moments.
const held = {};

function measureBody(body, { t, frames }, take, sizes) {
  const frame = frames[body.index];
  take(frame.x, frame.y);
  if (body.track?.on < 0 && t === run.start) for (const point of body.track.points) take(...point);
  for (const shape of body.shapes) for (const point of shapePoints(shape)) take(...shapePoint(body, frame, point));
  for (const { arrow } of body.arrows) {
    const [fx, fy, px, py, couple] = valuesAt(arrow, t), [x, y] = place(frame, px, py);
    sizes.forces.push(Math.hypot(fx, fy));
    sizes.moments.push(Math.abs(couple));
    if (Number.isFinite(x + y + fx + fy) && (fx || fy)) held.arrows.push({ x, y, fx, fy });
    if (couple) held.wheels.push([frame.x, frame.y]);
  }
  sizes.speeds.push(Math.hypot(...valuesAt(body.velocity, t)));
}

// The bounds contain the ground's polygons as far as an eighth of their size beyond the bodies, and stops that are not
// farther than their size.
function takeGround(take) {
  const { left, right, bottom, top } = held, size = Math.max(right - left, top - bottom);
  const near = ([x, y], pad) => [clamp(x, left - pad, right + pad), clamp(y, bottom - pad, top + pad)];
  for (const point of run.surfaces.flatMap(({ corners }) => corners || [])) take(...near(point, size / 8));
  const stops = run.bodies.flatMap((body) => body.stops.map(({ at }) => placed(survey[0].frames[body.parent], at)));
  for (const at of stops) if (!wayTo(at, near(at, size))[0]) take(...at);
}

// Determine the bounds of the bodies, and the sizes of forces, moments and speeds.
function measure() {
  const pieces = run.bodies.length > 20 ? 50 : 400, sizes = { forces: [], moments: [], speeds: [] };
  survey = Array.from({ length: pieces + 1 }, (none, i) => {
    const t = run.start + (run.end - run.start) * i / pieces;
    return { t, frames: framesAt(t) };
  });
  Object.assign(held, { arrows: [], wheels: [] });
  const xs = [], ys = [], take = (x, y) => { if (Number.isFinite(x + y)) { xs.push(x); ys.push(y); } };
  const bound = () => { [held.left, held.right] = bounds(xs); [held.bottom, held.top] = bounds(ys); };
  prepareTies();
  for (const sample of survey) {
    for (const point of tiePoints(sample.frames)) take(...point);
    for (const body of run.bodies) measureBody(body, sample, take, sizes);
  }
  bound();
  takeGround(take);
  placeWalls();
  for (const link of run.links) if (link.partner < 0) take(...link.anchor);
  bound();
  if (held.left > held.right) Object.assign(held, { left: 0, right: 0, bottom: 0, top: 0 });
  Object.assign(view, { force: usualMost(sizes.forces) || 1, moment: usualMost(sizes.moments) || 1, speed: usualMost(sizes.speeds) || 1 });
}

// Lengths of arrows relative to the canvas: of the usual largest force; of the longest arrow, beyond which arrows are
// cut.
const arrowShare = 0.14, cutShare = 0.19;

function pixelsPerForce() {
  return arrowShare * view.side / view.force;
}

function longestArrow() {
  return cutShare * view.side;
}

// The largest scale s at which s X + x, with X in the world and x in pixels, spans at most `room`; and the span by
// scale.
function fitAxis(points, room) {
  const span = (s) => bounds(points.map(([X, x]) => s * X + x)), [least, most] = bounds(points.map(([X]) => X));
  let low = 0, high = 1e-9;
  if (!(most - least > 1e-12 * Math.max(Math.abs(most), Math.abs(least)))) return { most: Infinity, span };
  const fits = (s) => { const [a, b] = span(s); return b - a <= room; };
  while (fits(high) && high < 1e30) high *= 4;
  for (let i = 0; i < 40; i++) {
    const middle = (low + high) / 2;
    if (fits(middle)) low = middle; else high = middle;
  }
  return { most: low, span };
}

// The corners of the bounds and the tips of the arrows: [world, pixels] along x and along y (downward).
function heldPoints() {
  const xs = [[held.left, -12], [held.right, 12]], ys = [[-held.top, -12], [-held.bottom, 12]];
  const length = pixelsPerForce(), most = longestArrow();
  for (const { x, y, fx, fy } of held.arrows) {
    const size = Math.hypot(fx, fy) * length, cut = Math.min(1, most / size) * length;
    xs.push([x, fx * cut]);
    ys.push([-y, -fy * cut]);
  }
  for (const [x, y] of held.wheels) {
    xs.push([x, -34], [x, 34]);
    ys.push([-y, -34], [-y, 34]);
  }
  return [xs, ys];
}

// Set scale and position so that everything is visible.
function fitWhole() {
  const [xs, ys] = heldPoints(), room = [view.width - 2 * margin - 30, view.height - 2 * margin - strip - 20];
  const across = fitAxis(xs, room[0]), up = fitAxis(ys, room[1]);
  let scale = Math.min(across.most, up.most);
  if (!(scale > 0)) scale = Math.min(room[0], room[1]) / (Math.max(held.right - held.left, held.top - held.bottom) || 1);
  if (!Number.isFinite(scale)) scale = 0.5 * view.side;
  const [left, right] = across.span(scale), [top, bottom] = up.span(scale), [mx, my] = viewMiddle();
  Object.assign(view, { scale, wholeScale: scale, x: mx - (left + right) / 2, y: my - (top + bottom) / 2 });
}

// The least distance of two parallel slides with bodies without a size, whose blocks must not overlap.
function slideGap() {
  const lines = run.bodies.filter((body) => body.line?.on < 0 && !isSized(body)).map((body) => body.line);
  const areParallel = (a, b) => Math.abs(a.along[0] * b.along[1] - a.along[1] * b.along[0]) < 1e-9;
  const away = (a, b) => Math.abs((b.through[0] - a.through[0]) * a.normal[0] + (b.through[1] - a.through[1]) * a.normal[1]);
  const gaps = lines.flatMap((a) => lines.filter((b) => areParallel(a, b)).map((b) => away(a, b)));
  return Math.min(...gaps.filter((gap) => gap > 1e-3 * (held.right - held.left)));
}

// Blocks without a size that overlap at some time are drawn one in the other, each smaller than those before.
function nestBlocks() {
  const blocks = run.bodies.filter((body) => body.line && !body.wedge && !isSized(body));
  const meet = (a, b) => survey.some(({ frames: { [a.index]: p, [b.index]: q } }) => Math.hypot(p.x - q.x, p.y - q.y) * view.scale < 1.4 * view.block);
  blocks.forEach((body, i) => { body.share = 0.7 ** blocks.slice(0, i).filter((other) => meet(body, other)).length; });
}

// Half the size of a body around its centre of mass, 0 if it has no size.
function bodyExtent(body) {
  const points = body.shapes.filter((shape) => shape.corners || shape.radius).flatMap(shapePoints);
  return Math.max(0, ...points.map(([x, y]) => Math.hypot(x - body.pin[0] - body.G[0], y - body.pin[1] - body.G[1])));
}

// True if the bodies are so small compared with their paths that rotations would be invisible.
function bodiesAreSpecks() {
  const extents = run.bodies.map(bodyExtent);
  return Math.min(...extents) > 0 && Math.max(...extents) * view.wholeScale < 3;
}

// ---- zoom and pan

// Center a body, magnified so that it is visible.
function follow(body, frame) {
  const [x, y] = place(frame, ...body.G);
  const near = 0.09 * view.side / (bodyExtent(body) || Infinity);
  view.scale = Math.max(view.wholeScale, near) * view.zoom;
  const [mx, my] = viewMiddle();
  view.x = mx + view.pan[0] - view.scale * x;
  view.y = my + view.pan[1] + view.scale * y;
  drawStill();
}

// Zoom by a factor; the point [x, y] of the canvas stays in place.
function zoomBy(factor, [x, y]) {
  const zoom = clamp(view.zoom * factor, 0.05, 200), by = zoom / view.zoom;
  const [mx, my] = viewMiddle(), from = [x - mx, y - my];
  view.pan = view.pan.map((p, k) => from[k] - by * (from[k] - p));
  view.zoom = zoom;
  aim();
}

function panBy(dx, dy) {
  view.pan = [view.pan[0] + dx, view.pan[1] + dy];
  aim();
}

function showWhole() {
  Object.assign(view, { zoom: 1, pan: [0, 0] });
  aim();
}

// The middle of the canvas, without the scales.
function viewMiddle() {
  return [view.width / 2, (view.height - strip) / 2];
}

// Set the view: the fitted picture, zoomed about the middle and moved.
function aim() {
  fitWhole();
  const [mx, my] = viewMiddle();
  view.scale *= view.zoom;
  view.x = mx + view.zoom * (view.x - mx) + view.pan[0];
  view.y = my + view.zoom * (view.y - my) + view.pan[1];
  view.block = Math.min(0.045 * view.side, Math.max(7, 0.45 * view.scale * slideGap()));
  nestBlocks();
  drawStill();
}

const curveCount = 8;
const colours = ["paper", "ink", "soft", "line", "body", "edge", "ground", "hatch", "shadow", "gravity", "reaction", "friction", "applied", "velocity",
  "trace", "rope", "strand", ...Array.from({ length: curveCount }, (none, i) => `curve-${i}`)];

// A colour #rrggbb between two others.
function mix(a, b, share) {
  const part = (colour, i) => parseInt(colour.slice(i, i + 2), 16);
  return "#" + [1, 3, 5].map((i) => Math.round(part(a, i) + share * (part(b, i) - part(a, i))).toString(16).padStart(2, "0")).join("");
}

// Set the resolution of the canvas: that of the screen, or for print a given size and a finer ratio.
function fit(size = [canvas.clientWidth, canvas.clientHeight], ratio = window.devicePixelRatio || 1) {
  view.ratio = ratio;
  [view.width, view.height] = size;
  view.side = Math.min(...size);
  canvas.width = Math.round(view.width * ratio);
  canvas.height = Math.round(view.height * ratio);
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.lineJoin = "round";
  const style = getComputedStyle(document.documentElement);
  for (const name of colours) tone[name] = style.getPropertyValue("--" + name).trim();
  const shades = (share) => Array.from({ length: curveCount }, (none, i) => mix(tone.body, tone[`curve-${i}`], share));
  Object.assign(tone, { tints: shades(0.24), marks: shades(0.42) });
  aim();
}

function toScreen([x, y]) {
  return [view.x + view.scale * x, view.y - view.scale * y];
}
