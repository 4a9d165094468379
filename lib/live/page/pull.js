"use strict";

// At the start of the run a body can be dragged to another position: its initial coordinates change as by their sliders,
// and the model is run again. At other times a drag moves the view.

const pull = { body: null, from: null, far: false };

// The keys of the sliders of a body's initial coordinates; null if one of them has none, or a fixed one.
function startKnobs(body) {
  const own = body.coordinates.map((c) => `initial.${run.columns[c].n}`);
  const free = ["slide", "pivot", "particle", "planar"].includes(body.motion) && own.every((key) => knobs.has(key) && !knobs.get(key).slider.disabled);
  return free ? own : null;
}

// The outlines of a body on the canvas, as functions that trace them.
function outlinesOf(body, frame) {
  const onCanvas = (points) => points.map((point) => toScreen(shapePoint(body, frame, point)));
  if (!isSized(body) && body.line) return [() => path(blockCorners(frame), true)];
  if (body.joints.length > 1) return [() => path(body.joints.map((point) => toScreen(place(frame, ...point))), true)];
  return body.shapes.map((shape) => () => {
    if (shape.corners) path(onCanvas(shape.corners), shape.kind === "polygon");
    else disc(onCanvas([shape.center])[0], Math.max((shape.radius || 0) * view.scale, 6));
  });
}

// The body at a point of the canvas, within 8 pixels, that can be dragged; the topmost first.
function bodyAt([x, y]) {
  if (!bench.controls || player.playing || now() !== run.start) return null;
  const row = rowAt(run.start);
  pen.setLineDash([]);
  pen.lineWidth = 16;
  return [...run.bodies].reverse().find((body) => startKnobs(body) && outlinesOf(body, frameAt(body, run.start, row)).some((trace) => {
    trace();
    return pen.isPointInPath(x * view.ratio, y * view.ratio) || pen.isPointInStroke(x * view.ratio, y * view.ratio);
  })) || null;
}

// The changes of the coordinates that bring the grabbed point from one place of the canvas to another: along the slide,
// about the axis, or in the plane.
function coordinateChanges(body, from, to) {
  const row = rowAt(run.start), dx = (to[0] - from[0]) / view.scale, dy = (from[1] - to[1]) / view.scale;
  if (body.motion === "pivot") {
    const frame = frameAt(body, run.start, row), [x, y] = toScreen([frame.x, frame.y]);
    const angle = Math.atan2(y - to[1], to[0] - x) - Math.atan2(y - from[1], from[0] - x);
    return [Math.atan2(Math.sin(angle), Math.cos(angle))];
  }
  if (body.motion !== "slide") return [dx, dy];
  const { along, on } = body.line, { c, s } = on < 0 ? { c: 1, s: 0 } : frameAt(run.bodies[on], run.start, row);
  return [dx * (c * along[0] - s * along[1]) + dy * (s * along[0] + c * along[1])];
}

function pullTo(at, underWay) {
  const changes = coordinateChanges(pull.body, pull.from, at);
  changes.forEach((change, k) => {
    const { key, number, knob } = pull.knobs[k];
    moved(key, writtenAs(knob, number + change / knob.quantity.factor), underWay);
  });
}

function grab(event) {
  const at = [event.offsetX, event.offsetY], body = fingers.size ? null : bodyAt(at);
  if (!body) return;
  event.stopImmediatePropagation();
  canvas.setPointerCapture(event.pointerId);
  const grabbed = startKnobs(body).map((key) => ({ key, knob: knobs.get(key), number: knobs.get(key).quantity.number }));
  Object.assign(pull, { body, from: at, far: false, knobs: grabbed });
}

function drag(event) {
  const at = [event.offsetX, event.offsetY];
  canvas.style.cursor = pull.body || bodyAt(at) ? "move" : "";
  if (!pull.body) return;
  event.stopImmediatePropagation();
  pull.far = pull.far || Math.hypot(at[0] - pull.from[0], at[1] - pull.from[1]) >= 6;
  if (pull.far) pullTo(at, true);
}

function drop(event) {
  if (!pull.body) return;
  event.stopImmediatePropagation();
  const at = [event.offsetX, event.offsetY];
  if (pull.far) pullTo(at, false);
  else pick(arrowAt(at, event.pointerType === "mouse" ? 8 : 24));
  pull.body = null; // the run that follows is fitted again
}

for (const [kind, action] of [["pointerdown", grab], ["pointermove", drag], ["pointerup", drop]]) canvas.addEventListener(kind, action, { capture: true });
canvas.addEventListener("pointercancel", () => { pull.body = null; });
