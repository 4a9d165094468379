"use strict";

// Strokes on a board by mouse and finger, and keys for its arrows.

const stroke = { board: null };

// The snap distance of a pointer to a point, in pixels.
const reachOf = (event) => (event.pointerType === "touch" ? 26 : 15);

// The snapped point, or the position itself if it is on a body with a size; otherwise the nearest point.
function snapped(body, { at, pixel }, event) {
  const near = pointNear(body, at, reachOf(event) * pixel);
  if (near >= 0) return near;
  return body.frame && insideOf(body, at) ? at : pointNear(body, at, Infinity);
}

// True if a position is within the bounds of a body's points.
function insideOf(body, [x, y]) {
  const xs = body.points.map(({ paper }) => paper[0]), ys = body.points.map(({ paper }) => paper[1]);
  return x >= Math.min(...xs) && x <= Math.max(...xs) && y >= Math.min(...ys) && y <= Math.max(...ys);
}

// Choose the action of a stroke: at the free end of the selected arrow it turns the arrow; at a point of the body it
// draws a new one, since several arrows may start there; elsewhere on an arrow it moves the arrow.
function beginStroke(event) {
  const board = event.currentTarget, b = Number(board.dataset.body), from = paperOf(board, event);
  const arrow = event.target.closest("[data-id]"), free = event.target.closest(".handle");
  if (event.button !== 0 || stroke.board) return;
  event.preventDefault();
  board.setPointerCapture(event.pointerId);
  const touched = free ? drawing.selected : Number(arrow?.dataset.id || 0);
  const anew = !free && pointNear(sheet.bodies[b], from.at, reachOf(event) * from.pixel) >= 0;
  Object.assign(stroke, { board, pointer: event.pointerId, body: b, from, moved: false, touched, id: anew ? 0 : touched, end: free ? "free" : "point" });
  if (stroke.id) stroke.place = placeOf(entryOf(stroke.id));
}

// Move the free end of the arrow to the pointer, or move the arrow with the pointer.
function moveEnd(entry, here, event) {
  const body = bodyOf(entry);
  if (stroke.end === "point") {
    delete entry.typed;
    entry.point = snapped(body, { at: plus(stroke.place, minusOf(here.at, stroke.from.at)), pixel: here.pixel }, event);
    return;
  }
  const at = placeOf(entry), way = entry.tip ? minusOf(at, here.at) : minusOf(here.at, at);
  entry.direction = directionNear(body, turnOf(way));
  entry.length = Math.min(Math.max(away(here.at, at), 8), 60);
}

// Draw a new force, from the start of the stroke; its tip is at the end if only that is a point.
function drawForce(entry, here, event) {
  const body = bodyOf(entry), reach = reachOf(event) * here.pixel, { from } = stroke;
  const start = pointNear(body, from.at, reach), end = pointNear(body, here.at, reach);
  entry.tip = start < 0 && end >= 0;
  entry.point = entry.tip ? end : snapped(body, from, event);
  const at = placeOf(entry), other = entry.tip ? from.at : here.at, way = entry.tip ? minusOf(at, other) : minusOf(other, at);
  entry.direction = directionNear(body, turnOf(way));
  entry.length = Math.min(Math.max(away(other, at), 8), 60);
}

// Draw a new moment; its sense follows from the side of the pointer.
function drawMoment(entry, here, event) {
  entry.point = snapped(bodyOf(entry), stroke.from, event);
  const [x, y] = minusOf(here.at, placeOf(entry));
  entry.sense = x < 0 || (x === 0 && y > 0) ? 1 : -1;
}

function moveStroke(event) {
  if (stroke.board !== event.currentTarget || event.pointerId !== stroke.pointer) return;
  const here = paperOf(stroke.board, event), least = 6 * here.pixel;
  if (!stroke.moved && away(here.at, stroke.from.at) < least) return;
  if (!stroke.moved) {
    keepHistory();
    if (!stroke.id) Object.assign(stroke, { id: newEntry(stroke.body, drawing.mode, {}).id, end: "new" });
    drawing.selected = stroke.id;
  }
  stroke.moved = true;
  const entry = entryOf(stroke.id);
  if (stroke.end !== "new") moveEnd(entry, here, event);
  else if (entry.kind === "force") drawForce(entry, here, event);
  else drawMoment(entry, here, event);
  showBoard(stroke.body);
  tell(stroke.body, inWords(entry));
}

function endStroke(event) {
  if (stroke.board !== event.currentTarget || event.pointerId !== stroke.pointer) return;
  const { body, id, moved, touched } = stroke;
  stroke.board = null;
  if (!moved) { choose(touched); return; }
  changed();
  sheet.bodies.forEach((other, b) => showDesk(b));
  focusArrow(id);
  tell(body, inWords(entryOf(id)));
}

function cancelStroke(event) {
  if (stroke.board !== event.currentTarget) return;
  stroke.board = null;
  if (stroke.moved) undo();
}

// ---- keys

function stepPoint(entry, step) {
  delete entry.typed;
  const { points } = bodyOf(entry), from = Array.isArray(entry.point) ? pointNear(bodyOf(entry), entry.point, Infinity) : entry.point + step;
  entry.point = (from + points.length) % points.length;
}

function turnBy(entry, step) {
  if (entry.kind === "moment") entry.sense = step;
  else entry.direction = directionNext(bodyOf(entry), entry.direction ? entry.direction.degrees : 45, step);
}

function reverse(entry) {
  if (entry.kind === "moment") { entry.sense = -entry.sense; return; }
  if (!entry.direction) return;
  entry.direction = directionNear(bodyOf(entry), entry.direction.degrees + 180);
}

const arrowKeys = {
  ArrowRight: (entry) => stepPoint(entry, 1),
  ArrowLeft: (entry) => stepPoint(entry, -1),
  ArrowUp: (entry) => turnBy(entry, 1),
  ArrowDown: (entry) => turnBy(entry, -1),
  r: reverse,
  t: (entry) => { entry.tip = !entry.tip; },
  "+": (entry) => { entry.length = Math.min(entry.length + 3, 60); },
  "-": (entry) => { entry.length = Math.max(entry.length - 3, 8); },
};

// Add a force or moment to be adjusted by keys: at the first point, upward or counter-clockwise.
function addByKey(b, kind) {
  keepHistory();
  const entry = newEntry(b, kind, {});
  drawing.selected = entry.id;
  changed();
  showDesk(b);
  focusArrow(entry.id);
  tell(b, inWords(entry));
}

function pressKey(event) {
  const b = Number(event.currentTarget.dataset.body), arrow = event.target.closest("[data-id]"), entry = arrow && entryOf(Number(arrow.dataset.id));
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (key === "f" || key === "m") { event.preventDefault(); addByKey(b, key === "f" ? "force" : "moment"); return; }
  if (!entry) return;
  if (arrowKeys[key]) {
    keepHistory(`${key}${entry.id}`);
    arrowKeys[key](entry);
    changed();
    showDesk(b);
    focusArrow(entry.id);
    tell(b, inWords(entry));
  } else if (key === "Delete" || key === "Backspace") removeEntry(entry);
  else if (key === "Enter" || key === " ") { choose(entry.id); desks[b].name.focus(); desks[b].name.select(); }
  else return;
  event.preventDefault();
}

function connectBoard(board) {
  board.addEventListener("pointerdown", beginStroke);
  board.addEventListener("pointermove", moveStroke);
  board.addEventListener("pointerup", endStroke);
  board.addEventListener("pointercancel", cancelStroke);
  board.addEventListener("keydown", pressKey);
  board.addEventListener("focusin", (event) => {
    const arrow = event.target.closest("[data-id]");
    if (arrow && !stroke.board && Number(arrow.dataset.id) !== drawing.selected) choose(Number(arrow.dataset.id), true);
  });
}
