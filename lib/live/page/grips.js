"use strict";

// Grips of the scene: a body to another start, a weight to another mass, a slope to another angle. Each moves
// the slider of a number of the text, and the model is run again. A drag beside them moves the view.

const hold = { grip: null, from: null, far: false, force: 1 };

// The key of the slider of a control that the text gives as a number or as one parameter; null for others.
function sliderOf(key, control) {
  const spot = control?.written, name = spot && spot.to !== undefined && spot.number === undefined && bench.base.slice(spot.from, spot.to);
  const found = [name && `parameters.${name}`, key].find((other) => other && knobs.has(other) && !knobs.get(other).slider.disabled);
  return found || null;
}

function controlNamed(list, name) {
  return bench.controls[list].find((control) => control.name === name);
}

// A grip that adds changes(at), in SI units, to the numbers of sliders; `least` limits each by the one at the start.
function gripOf(sliders, changes, least = (number) => number) {
  const starts = sliders.map((key) => ({ key, knob: knobs.get(key), number: knobs.get(key).quantity.number }));
  return (at, underWay) => changes(at).forEach((change, k) => {
    const { key, number, knob } = starts[k];
    moved(key, writtenAs(knob, least(number + change / knob.quantity.factor, number)), underWay);
  });
}

// The angle between two points of the canvas as seen from a third one, counter-clockwise.
function turnAbout([x, y], from, to) {
  const angle = Math.atan2(y - to[1], to[0] - x) - Math.atan2(y - from[1], from[0] - x);
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}

// ---- bodies

// The outlines of a body on the canvas, as functions that trace them.
function outlinesOf(body, frame) {
  const outer = (points) => points.map((point) => toScreen(shapePoint(body, frame, point)));
  if (!isSized(body) && body.line) return [() => path(blockCorners(body, frame), true)];
  if (body.joints.length > 1) return [() => path(body.joints.map((point) => onCanvas(frame, point)), true)];
  return body.shapes.map((shape) => () => {
    if (shape.corners) path(outer(shape.corners), shape.kind === "polygon");
    else disc(outer([shape.center])[0], Math.max((shape.radius || 0) * view.scale, 6));
  });
}

// The body at a point of the canvas, within 8 pixels, of those for which `may` is true; the topmost first.
function bodyAt([x, y], may) {
  pen.setLineDash([]);
  pen.lineWidth = 16;
  return [...run.bodies].reverse().find((body) => may(body) && outlinesOf(body, frameAt(body, now())).some((trace) => {
    trace();
    return pen.isPointInPath(x * view.ratio, y * view.ratio) || pen.isPointInStroke(x * view.ratio, y * view.ratio);
  })) || null;
}

// The sliders of a body's initial coordinates; null if one of them has none, or a fixed one.
function startSliders(body) {
  const sliders = body.coordinates.map((c) => run.columns[c].n).map((name) => sliderOf(`initial.${name}`, controlNamed("initial", name)));
  return ["slide", "pivot", "particle", "planar"].includes(body.motion) && sliders.every(Boolean) ? sliders : null;
}

// The changes of the coordinates that bring the grabbed point from one place of the canvas to another: along the slide,
// about the axis, or in the plane.
function coordinateChanges(body, from, to) {
  const dx = (to[0] - from[0]) / view.scale, dy = (from[1] - to[1]) / view.scale;
  if (body.motion === "pivot") {
    const frame = frameAt(body, run.start);
    return [turnAbout(toScreen([frame.x, frame.y]), from, to)];
  }
  if (body.motion !== "slide") return [dx, dy];
  const { along, on } = body.line, { c, s } = on < 0 ? { c: 1, s: 0 } : frameAt(run.bodies[on], run.start);
  return [dx * (c * along[0] - s * along[1]) + dy * (s * along[0] + c * along[1])];
}

function gripOfStart(from) {
  const body = player.playing || now() !== run.start ? null : bodyAt(from, startSliders);
  return body && gripOf(startSliders(body), (at) => coordinateChanges(body, from, at));
}

// ---- weights and slopes

// The arrow of a weight grows in proportion to the mass, and keeps at least a twentieth. Its outer half is the grip.
function gripOfMass(from, reach) {
  const key = arrowAt(from, reach), found = arrowBy(key);
  const slider = found && found.arrow.hue === "gravity" && sliderOf(`masses.${found.body.name}`, controlNamed("masses", found.body.name));
  if (!slider) return null;
  const [x1, y1, x2, y2] = drawn.arrows.find((arrow) => arrow[5] === key), dx = x2 - x1, dy = y2 - y1;
  const share = (at, x, y) => ((at[0] - x) * dx + (at[1] - y) * dy) / (dx * dx + dy * dy), mass = controlNamed("masses", found.body.name).value;
  return share(from, x1, y1) < 0.5 ? null : gripOf([slider], (at) => [mass * share(at, ...from)], (value, start) => Math.max(value, 0.05 * start));
}

// A slope turns about the point through which its line goes.
function gripOfSlope(from, reach) {
  for (const body of run.bodies) {
    const slider = body.line?.on < 0 && sliderOf(`slopes.${body.name}`, controlNamed("slopes", body.name));
    if (!slider) continue;
    const { through, along, normal } = body.line, foot = toScreen(through);
    const ends = acrossCanvas(through, along, normal, surfaceBelow(body)).flat();
    if (distanceTo(ends, ...from) < reach && Math.hypot(from[0] - foot[0], from[1] - foot[1]) > 3 * reach)
      return gripOf([slider], (at) => [turnAbout(foot, from, at)]);
  }
  return null;
}

// ---- the pointer

// Of a pull the grip also `begins` it.
function gripAt(at, reach, begins) {
  if (!bench.controls || fingers.size || hold.grip || pull.at) return null;
  return gripOfPull(at, reach, begins) || gripOfStart(at) || gripOfMass(at, reach) || gripOfSlope(at, reach);
}

function reachOf(event) {
  return event.pointerType === "mouse" ? 8 : 24;
}

function grab(event) {
  const at = [event.offsetX, event.offsetY], grip = gripAt(at, reachOf(event), true);
  if (!grip) return;
  event.stopImmediatePropagation();
  canvas.setPointerCapture(event.pointerId);
  Object.assign(hold, { grip, from: at, far: false, force: view.force });
}

function drag(event) {
  const at = [event.offsetX, event.offsetY];
  if (event.pointerType === "mouse" && !event.buttons) canvas.style.cursor = gripAt(at, 8) ? "move" : "";
  if (!hold.grip) return;
  event.stopImmediatePropagation();
  hold.far = hold.far || Math.hypot(at[0] - hold.from[0], at[1] - hold.from[1]) >= 6;
  if (hold.far || pull.at) hold.grip(at, true);
}

function drop(event) {
  const { grip } = hold, at = [event.offsetX, event.offsetY];
  if (!grip) return;
  event.stopImmediatePropagation();
  hold.grip = null; // the run that follows is fitted again
  if (hold.far || pull.at) grip(at, false);
  if (!hold.far) pick(arrowAt(at, reachOf(event)));
}

for (const [kind, action] of [["pointerdown", grab], ["pointermove", drag], ["pointerup", drop], ["pointercancel", drop]])
  canvas.addEventListener(kind, action, { capture: true });
