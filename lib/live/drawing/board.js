"use strict";

// A body cut free on its board: positions in millimetres on paper, y down; snap points and directions of strokes.

const sheet = JSON.parse(element("data").textContent);

// Number points with equal names.
for (const { points } of sheet.bodies) {
  const of = (name) => points.filter((point) => point.name === name);
  for (const { name } of [...points]) if (of(name).length > 1) of(name).forEach((point, i) => { point.name += ` ${i + 1}`; });
}

// ---- elements

function make(tag, properties, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties || {})) {
    if (name in node) node[name] = value; else node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

// The SVG namespace is a URL, which this page must not contain: take it from the pictures.
const pictures = [...element("pictures").children], svgSpace = pictures[0].namespaceURI;

function svg(tag, attributes, ...children) {
  const node = document.createElementNS(svgSpace, tag);
  for (const [name, value] of Object.entries(attributes || {})) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

// ---- places

const plus = ([a, b], [c, d]) => [a + c, b + d];
const minusOf = ([a, b], [c, d]) => [a - c, b - d];
const times = (k, [a, b]) => [k * a, k * b];
const away = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
const radians = (degrees) => degrees * Math.PI / 180;
const unitOf = (degrees) => [Math.cos(radians(degrees)), -Math.sin(radians(degrees))]; // on paper
const turnOf = ([x, y]) => Math.atan2(-y, x) * 180 / Math.PI;
const within = (degrees) => { const turn = ((degrees % 360) + 360) % 360; return turn > 180 ? turn - 360 : turn; };
const apart = (a, b) => Math.abs(within(a - b));
const rounded = (number, digits) => Number(number.toPrecision(digits));

const boardMargin = 9; // mm around the room for arrows

// The position of a pointer on the paper of a board, and the size of a pixel in millimetres.
function paperOf(board, event) {
  const matrix = board.getScreenCTM().inverse(), { clientX: x, clientY: y } = event;
  return { at: [matrix.a * x + matrix.c * y + matrix.e, matrix.b * x + matrix.d * y + matrix.f], pixel: matrix.a };
}

// The nearest point of a body within `reach`, or -1.
function pointNear(body, at, reach) {
  let best = -1, least = reach;
  body.points.forEach(({ paper }, i) => {
    const far = away(paper, at);
    if (far < least) { least = far; best = i; }
  });
  return best;
}

// A position in the frame of the body as two numbers of the file; and the position of such numbers.
function placeNumbers(body, at) {
  const { paper, degrees, millimetres } = body.frame, [dx, dy] = minusOf(at, paper), turn = radians(degrees);
  const x = dx / millimetres, y = -dy / millimetres;
  const along = x * Math.cos(turn) + y * Math.sin(turn), across = y * Math.cos(turn) - x * Math.sin(turn);
  const short = (number) => (Math.abs(number) * millimetres < 1 ? 0 : rounded(number, 3)); // snap to the axes
  return [String(short(along)), String(short(across))];
}

function placeAt(body, [x, y]) {
  const { paper, degrees, millimetres } = body.frame, [a, b] = unitOf(degrees);
  return plus(paper, times(millimetres, [a * x + b * y, b * x - a * y]));
}

// ---- directions

// The directions offered for a body, its own ones first; of directions equal on paper only the first.
function directionsOf(body) {
  if (body.all) return body.all;
  const all = [];
  const add = (direction) => { if (!all.some((other) => apart(other.degrees, direction.degrees) < 0.01)) all.push(direction); };
  const names = { 0: "to the right", 90: "up", 180: "to the left", "-90": "down" };
  const turn = (degrees) => ({ degrees, angle: `${degrees} deg`, body: false, name: names[degrees] || `${show(degrees)}°` });
  for (const degrees of [0, 90, 180, -90]) add(turn(degrees));
  body.directions.forEach((direction) => add({ ...direction, name: `${direction.name}, ${show(rounded(within(direction.degrees), 4))}°` }));
  for (let degrees = -165; degrees < 180; degrees += 15) add(turn(degrees));
  body.all = all;
  return all;
}

// The direction of a stroke: an offered one within some degrees, else whole degrees.
function directionNear(body, degrees) {
  const [best] = directionsOf(body).slice().sort((a, b) => apart(a.degrees, degrees) - apart(b.degrees, degrees));
  if (apart(best.degrees, degrees) <= 4) return best;
  const whole = Math.round(within(degrees));
  return { degrees: whole, angle: `${whole} deg`, body: false };
}

// The next direction, counter-clockwise with step 1.
function directionNext(body, degrees, step) {
  const ahead = (other) => { const turn = (((other.degrees - degrees) * step) % 360 + 360) % 360; return turn < 0.01 ? 360 : turn; };
  return directionsOf(body).slice().sort((a, b) => ahead(a) - ahead(b))[0];
}
