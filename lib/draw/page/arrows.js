"use strict";

// Forces and velocities as arrows, moments as arcs, and the overlay with their scales.

function head(x, y, ux, uy, colour) {
  path([[x, y], [x - 11 * ux - 4.6 * uy, y - 11 * uy + 4.6 * ux], [x - 11 * ux + 4.6 * uy, y - 11 * uy - 4.6 * ux]], true);
  fillWith(colour);
}

// The part of an arrow from a point of the canvas, `length` along [ux, uy], that lies on the canvas; an arrow from
// outside is not cut.
function roomFor([x, y], ux, uy, length) {
  const edges = [[x, ux, margin, view.width - margin], [y, uy, margin, view.height - margin]];
  let room = length;
  for (const [from, way, low, high] of edges) {
    if (from < low || from > high) return length;
    if (way > 0) room = Math.min(room, (high - from) / way);
    if (way < 0) room = Math.min(room, (low - from) / way);
  }
  return room;
}

// Draw two strokes across the shaft of an arrow that is shorter than to scale.
function drawCut(x, y, ux, uy, colour) {
  for (const along of [-2.5, 2.5]) {
    const cx = x + along * ux, cy = y + along * uy;
    path([[cx - 4 * uy - 1.5 * ux, cy + 4 * ux - 1.5 * uy], [cx + 4 * uy + 1.5 * ux, cy - 4 * ux + 1.5 * uy]]);
    strokeWith(tone.paper, 3.4);
    strokeWith(colour, 1.2);
  }
}

// True if the arrow from [x, y] by `length` along [ux, uy] overlaps one that is drawn.
function liesOnAnother([x, y], ux, uy, length) {
  return drawn.arrows.some(([x1, y1, x2, y2, arc]) => {
    const dx = x2 - x1, dy = y2 - y1, size = Math.hypot(dx, dy);
    if (arc || !(size > 0) || Math.abs(ux * dy - uy * dx) > 0.06 * size || Math.abs((x1 - x) * uy - (y1 - y) * ux) > 3) return false;
    const a = (x1 - x) * ux + (y1 - y) * uy, b = a + dx * ux + dy * uy;
    return Math.min(length, Math.max(a, b)) - Math.max(0, Math.min(a, b)) > 2;
  });
}

// The start of an arrow, moved sideways by the fewest steps of 5 pixels so that it overlaps no other.
function stepAside(from, ux, uy, length) {
  for (let k = 0; k < 9; k++) {
    const step = 5 * (k + 1 >> 1) * (k % 2 ? 1 : -1), at = [from[0] - step * uy, from[1] + step * ux];
    if (!liesOnAnother(at, ux, uy, length)) return at;
  }
  return from;
}

// Stroke the current path of an arrow, stronger if it is the one that is pointed at or shown.
function strokeArrow(colour, key) {
  if (key && (key === picked.lit || key === picked.shown)) {
    pen.globalAlpha = 0.3;
    strokeWith(colour, 10);
    pen.globalAlpha = 1;
  }
  strokeWith(colour, 2.8);
}

// Draw an arrow of [dx, dy] pixels; returns its tip, or null if it is too short to be seen. An arrow that exceeds the
// canvas, or the largest length, is cut.
function arrowTo(point, dx, dy, colour, key) {
  const whole = Math.hypot(dx, dy);
  if (!(whole > 2)) return null;
  const ux = dx / whole, uy = dy / whole, from = stepAside(point, ux, uy, Math.min(whole, longestArrow()));
  const length = Math.min(roomFor(from, ux, uy, Math.min(whole, longestArrow())), whole);
  if (length < 6 && length < whole) return null;
  const on = (s) => [from[0] + s * ux, from[1] + s * uy], tip = on(length);
  path([from, on(Math.max(length - 8, 0))]);
  strokeArrow(colour, key);
  if (length < whole * (1 - 1e-9)) drawCut(...on(0.45 * length), ux, uy, colour);
  head(...tip, ux, uy, colour);
  avoidLine(...from, ...tip);
  drawn.arrows.push([...from, ...tip, false, key]);
  return tip;
}

function arrowKey(body, arrow) {
  return `${body.name}:${arrow.name}`;
}

function labelOf(name, value, units, shows) {
  return [shows.names ? quantity(name) : "", shows.values ? measured(value, units) : ""].filter(Boolean).join(" ");
}

// Draw an arc about [x, y] from an angle of the world by `sweep`, with a head if it is longer than `least`.
function drawArc([x, y], radius, from, sweep, colour, stroke, least) {
  const end = from + sweep, way = sweep > 0 ? 1 : -1, turn = end - way * 5 / radius; // direction of the head: the chord of its arc
  pen.beginPath();
  pen.arc(x, y, radius, -from, -end, sweep > 0);
  stroke();
  avoidLine(x, y, radius);
  if (Math.abs(sweep) * radius > least) head(x + radius * Math.cos(end), y - radius * Math.sin(end), -way * Math.sin(turn), -way * Math.cos(turn), colour);
}

// A label at an angle of an arc.
function labelArc([x, y], radius, angle, key, text, colour) {
  const c = Math.cos(angle), s = Math.sin(angle);
  wantLabel(key, text, x + radius * c, y - radius * s, c, -s, colour);
}

// Draw a moment as an arc around [x, y]; further ones of the body have larger radii.
function drawCouple([x, y], couple, index, colour, key, text) {
  const radius = 24 + 7 * index, from = 0.5 + 0.6 * index, sweep = clamp(4.2 * couple / view.moment, -5, 5);
  if (Math.abs(sweep) < 0.15) return false;
  drawArc([x, y], radius, from, sweep + 6 * Math.sign(sweep) / radius, colour, () => strokeArrow(colour, key), 0);
  if (text) labelArc([x, y], radius, from + sweep, `${key}:moment`, text, colour);
  drawn.arrows.push([x - radius, y - radius, x + radius, y + radius, true, key]);
  return true;
}

function drawForces(body, frame, t, shows) {
  const length = pixelsPerForce(), labelled = shows.names || shows.values;
  let couples = 0;
  for (const arrow of body.arrows) {
    const [fx, fy, px, py, couple] = valuesAt(arrow.arrow, t), colour = tone[arrow.hue], key = arrowKey(body, arrow);
    const size = Math.hypot(fx, fy), least = roundingOf(run.units.force), from = onCanvas(frame, [px, py]);
    const tip = size > least ? arrowTo(from, fx * length, -fy * length, colour, key) : null;
    if (tip && labelled) wantLabel(key, labelOf(arrow.name, size, run.units.force, shows), ...tip, fx / size, -fy / size, colour);
    if (Math.abs(couple) <= roundingOf(run.units.moment)) continue;
    const text = labelled && labelOf(arrow.name, Math.abs(couple), run.units.moment, shows);
    if (drawCouple(toScreen([frame.x, frame.y]), couple, couples, colour, key, text)) couples++;
  }
}

function drawVelocity(body, frame, t, shows) {
  const [vx, vy] = valuesAt(body.velocity, t), speed = Math.hypot(vx, vy);
  if (!(speed > roundingOf(run.units.speed))) return;
  const length = arrowShare * view.side / view.speed;
  const tip = arrowTo(onCanvas(frame, body.G), vx * length, -vy * length, tone.velocity);
  if (tip && (shows.names || shows.values))
    wantLabel(`${body.name}:v`, labelOf("v", speed, run.units.speed, shows), ...tip, vx / speed, -vy / speed, tone.velocity);
}

// ---- axes, scales, angles

// An arrow that is no force: from a point, `length` along a unit vector.
function plainArrow([x, y], [ux, uy], length, colour) {
  path([[x, y], [x + (length - 8) * ux, y + (length - 8) * uy]]);
  strokeWith(colour, 2.2);
  head(x + length * ux, y + length * uy, ux, uy, colour);
}

// The degrees of an angle.
function degrees(angle) {
  return `${show(angle * 180 / Math.PI, 3)}°`;
}

// The largest of 1, 2 or 5 times a power of ten that is at most `most`.
function roundBelow(most) {
  const power = 10 ** Math.floor(Math.log10(most)), share = most / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

function plainText(text, x, y, colour, boxed = true) {
  const width = textWidth(text);
  writeText(text, x, y, colour);
  if (boxed) avoidBox(x, y - 8, x + width, y + 8, text);
  return width;
}

// Draw the scales below the scene: a length, a force, a velocity; and the directions of x and y.
function drawScales(shows) {
  const y = view.height - 16, soft = tone.soft;
  let x = 16;
  path([[x, y - 18], [x, y], [x + 18, y]]);
  strokeWith(soft, 1.2);
  head(x + 22, y, 1, 0, soft);
  head(x, y - 22, 0, -1, soft);
  plainText("y", x + 6, y - 18, soft, false);
  x += 26 + plainText("x", x + 26, y, soft, false);
  avoidBox(12, y - 26, x, y + 8, "axes");
  const add = (scale, units, colour, ruler) => {
    const value = roundBelow(Math.min(110, view.width / 6) / scale), text = measured(value, units), pixels = scale * value, end = x + 18 + pixels;
    if (!(end + 6 + textWidth(text) <= view.width - 8)) return;
    if (ruler) {
      path([[x + 18, y - 4], [x + 18, y + 4], [x + 18, y], [end, y], [end, y - 4], [end, y + 4]]);
      strokeWith(colour, 1.2);
    } else plainArrow([x + 18, y], [1, 0], pixels, colour);
    x = end + 6 + plainText(text, end + 6, y, colour);
  };
  add(view.scale, run.units.length, soft, true);
  if (shows.forces && held.arrows.length) add(pixelsPerForce(), run.units.force, soft);
  if (shows.velocity) add(arrowShare * view.side / view.speed, run.units.speed, tone.velocity);
}

// Draw an arc from angle `from` by `sweep`, both as in the world, with its label.
function drawAngle([x, y], from, sweep, radius, key, text) {
  path([[x, y], [x + (radius + 14) * Math.cos(from), y - (radius + 14) * Math.sin(from)]]);
  strokeWith(tone.soft, 1, [4, 3]);
  drawArc([x, y], radius, from, sweep, tone.soft, () => strokeWith(tone.soft, 1.2), 12);
  labelArc([x, y], radius, from + sweep / 2, key, text, tone.soft);
}

// Draw the angle of an inclined slide on the ground, at its low end on the canvas, once for each direction; and that of
// a pivoted body from its zero.
function drawAngles(frames, t, chosen) {
  const seen = new Set();
  run.bodies.forEach((body, i) => {
    if (body.line?.on < 0) {
      const [ex, ey] = body.line.along, angle = Math.atan2(ey, ex), name = degrees(angle);
      if (Math.abs(ex) < 1e-9 || Math.abs(ey) < 1e-9 || seen.has(name)) return;
      seen.add(name);
      const corner = lowEnd(body);
      if (corner) drawAngle(corner, ex > 0 ? 0 : Math.PI, Math.atan(ey / ex), 44, `${body.name}:slope`, degrees(Math.abs(Math.atan(ey / ex))));
    }
    if (body.motion !== "pivot" || (chosen === null ? run.bodies.length > 3 : chosen !== i)) return;
    const theta = valueAt(body.coordinates[0], t), turn = Math.atan2(Math.sin(theta), Math.cos(theta));
    const own = Math.atan2(body.G[1], body.G[0]);
    const turned = frames[i].angle + own;
    if (Math.abs(turn) > 0.03) drawAngle(toScreen([frames[i].x, frames[i].y]), turned - turn, turn, 40, `${body.name}:angle`, `θ = ${degrees(theta)}`);
  });
}

// The point near the canvas's edge where the line under a slide enters at its low end; null if there is none.
function lowEnd(body) {
  const { through, along, normal } = body.line, [x, y] = toScreen(through), way = along[1] > 0 ? -1 : 1;
  const dx = way * along[0], dy = -way * along[1], bottom = view.height - strip - 8;
  const sides = [dx > 0 ? (view.width - 50 - x) / dx : (50 - x) / dx, (bottom - y) / dy].filter(Number.isFinite);
  const s = Math.min(...sides), foot = [x + s * dx, y + s * dy];
  const down = surfaceBelow(body), corner = [foot[0] - normal[0] * down, foot[1] + normal[1] * down];
  return corner.every((v) => v > 0) && corner[0] < view.width && corner[1] < view.height ? corner : null;
}
