"use strict";

// Positions of the labels of the scene: next to their objects, without overlaps, on few lines.
//
// Each label tries positions around its anchor, near ones and those in its direction first, and takes the cheapest one
// that overlaps no other label and lies on the canvas. The position in the previous picture is cheaper, so that labels
// do not jump while the scene moves. A label without a free position is omitted: the tables have its number.

const labelHeight = 15, labelGap = 5, labelTurns = 12, labelRings = [0, 11, 24, 40, 62];
const labels = { wanted: [], boxes: [], lines: [], last: new Map(), left: 0 };
const drawn = { arrows: [], labels: labels.boxes }; // for scripts that inspect the picture

function beginLabels() {
  for (const list of [labels.wanted, labels.boxes, labels.lines, drawn.arrows]) list.length = 0;
  labels.left = 0;
}

// key: identifies the labelled object; [ux, uy]: preferred direction on the canvas.
function wantLabel(key, text, x, y, ux, uy, colour) {
  labels.wanted.push({ key, text, x, y, ux, uy, colour });
}

// A line [x1, y1, x2, y2] or circle [x, y, radius] that labels should not lie on.
function avoidLine(...line) {
  labels.lines.push(line);
}

// A box that no label may lie on.
function avoidBox(left, top, right, bottom, text) {
  labels.boxes.push({ left, top, right, bottom, text });
}

const textWidths = new Map(); // all labels have the same font
const labelFont = "13px Arial, Helvetica, 'Liberation Sans', sans-serif";

function textWidth(text) {
  if (!textWidths.has(text)) {
    if (textWidths.size > 5000) textWidths.clear(); // limits the memory, since values keep changing
    pen.font = labelFont;
    textWidths.set(text, pen.measureText(text).width);
  }
  return textWidths.get(text);
}

// True if the circle crosses the box: one of its points is nearer than the radius, and one is farther.
function circleCrosses([x, y, radius], { left, right, top, bottom }) {
  const near = Math.hypot(Math.max(left - x, 0, x - right), Math.max(top - y, 0, y - bottom));
  return near < radius && radius < Math.hypot(Math.max(x - left, right - x), Math.max(y - top, bottom - y));
}

// True if the line crosses the box (Liang-Barsky clipping).
function crosses([x1, y1, x2, y2], box) {
  let enter = 0, leave = 1;
  const dx = x2 - x1, dy = y2 - y1;
  for (const [from, step, low, high] of [[x1, dx, box.left, box.right], [y1, dy, box.top, box.bottom]]) {
    if (step === 0) {
      if (from < low || from > high) return false;
      continue;
    }
    const a = (low - from) / step, b = (high - from) / step;
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return leave > enter;
}

function boxAt(label, width, turn, ring) {
  const angle = Math.atan2(label.uy, label.ux) + 2 * Math.PI * turn / labelTurns, ux = Math.cos(angle), uy = Math.sin(angle);
  const reach = Math.min(width / 2 / Math.max(Math.abs(ux), 1e-9), labelHeight / 2 / Math.max(Math.abs(uy), 1e-9));
  const away = labelGap + reach + labelRings[ring], x = label.x + away * ux, y = label.y + away * uy;
  return { left: x - width / 2, right: x + width / 2, top: y - labelHeight / 2, bottom: y + labelHeight / 2 };
}

function isFree(box) {
  if (box.left < 2 || box.top < 2 || box.right > view.width - 2 || box.bottom > view.height - 2) return false;
  return !labels.boxes.some((other) => box.left < other.right + 3 && other.left < box.right + 3 && box.top < other.bottom && other.top < box.bottom);
}

// The positions in the order of their costs: 0, 1, -1, 2, ... turns in each ring.
const labelPlaces = [];
labelRings.forEach((distance, ring) => {
  for (let k = 0; k < labelTurns; k++) {
    const turn = (k + 1 >> 1) * (k % 2 ? 1 : -1);
    labelPlaces.push({ turn, ring, price: distance + 3.5 * Math.abs(turn) + (ring > 1 ? 12 : 0) });
  }
});
labelPlaces.sort((a, b) => a.price - b.price);

function choosePlace(label) {
  const width = textWidth(label.text), last = labels.last.get(label.key), crowded = labels.wanted.length > 80;
  let best = null, least = Infinity;
  for (const spot of labelPlaces) {
    const stay = spot === last ? -9 : 0;
    if (spot.price - 9 >= least) break;
    const box = boxAt(label, width, spot.turn, spot.ring);
    if (!isFree(box)) continue;
    let price = spot.price + stay;
    if (!crowded) for (const line of labels.lines) if ((line.length < 4 ? circleCrosses : crosses)(line, box)) price += 14;
    if (price < least) { least = price; best = { spot, box }; }
  }
  return best;
}

// A text with a rim of the colour of paper; its left end and middle line are given.
function writeText(text, x, y, colour) {
  Object.assign(pen, { font: labelFont, textAlign: "left", textBaseline: "middle", lineWidth: 3, strokeStyle: tone.paper, fillStyle: colour });
  pen.setLineDash([]);
  pen.strokeText(text, x, y);
  pen.fillText(text, x, y);
}

function writeLabel(label, box, ring) {
  if (ring > 1) {
    path([[label.x, label.y], [clamp(label.x, box.left, box.right), clamp(label.y, box.top, box.bottom)]]);
    strokeWith(tone.soft, 0.8);
  }
  writeText(label.text, box.left, (box.top + box.bottom) / 2 + 1, label.colour);
}

function placeLabels() {
  for (const label of labels.wanted) {
    if (label.x < 0 || label.y < 0 || label.x > view.width || label.y > view.height) continue; // out of sight
    const best = choosePlace(label);
    if (!best) { labels.left++; continue; }
    labels.last.set(label.key, best.spot);
    labels.boxes.push({ ...best.box, text: label.text });
    writeLabel(label, best.box, best.spot.ring);
  }
}
