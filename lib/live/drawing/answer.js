"use strict";

// The answer: the sheet with the drawing and derivations in its lists, as the file that `fbd-run --grade` reads.

// A scalar within braces, quoted if YAML could misread it.
function scalar(text) {
  return /^-?[A-Za-z0-9(.]([A-Za-z0-9_ .*/^()+-]*[A-Za-z0-9_.)])?$/.test(text) ? text : JSON.stringify(text);
}

const word = (text) => text.replace(/[^A-Za-z0-9_]/g, "_").replace(/^(?=[0-9])/, "_");

// A name as in the file: Greek letters by their names.
function fileName(entry) {
  const letters = Object.fromEntries(Object.entries(greek).map(([name, letter]) => [letter, name]));
  return word([...nameOf(entry)].map((letter) => letters[letter] || letter).join(""));
}

function valueText(entry) {
  const value = fileNumber(entry.value, isGiven) || "unknown";
  if (entry.kind === "force" || entry.sense > 0) return value;
  return /^[\w.]+( [\w*/^.]+)?$/.test(value) ? `-${value}` : `-(${value})`;
}

function entryText(entry) {
  const keys = [`name: ${fileName(entry)}`, `value: ${scalar(valueText(entry))}`];
  if (entry.kind === "force") {
    keys.push(`angle: ${entry.direction ? scalar(entry.direction.angle) : "unknown"}`);
    if (entry.direction?.body) keys.push("frame: body");
    const at = Array.isArray(entry.point) ? `[${placeTexts(entry).map(scalar).join(", ")}]` : bodyOf(entry).points[entry.point].at;
    if (at) keys.push(`at: ${at}`);
  }
  return `applied: {${keys.join(", ")}}`;
}

// A place beside the points: as it was typed, or else as it was drawn.
const placeTexts = (entry) => (entry.typed ? entry.typed.map((text) => fileNumber(text, isGiven)) : placeNumbers(bodyOf(entry), entry.point));

const linesOf = (body) => drawing.lines[body].split("\n").map((line) => line.trim()).filter(Boolean);

// A list as YAML; calls note(line, i) with the line of entry i.
function listText(key, entries, from, note) {
  if (!entries.length) return `    ${key}: []\n`;
  entries.forEach((entry, i) => note(from + 1 + i, i));
  return `    ${key}:\n${entries.map((entry) => `      - ${entry}\n`).join("")}`;
}

// {text, places}: the text, and for each line its {entry} or {body, line}.
function answerOf() {
  const parts = sheet.sheet.split(/^(\f\v|\f|\v)(.*)\n/m), places = new Map();
  let text = parts[0];
  const here = () => text.split("\n").length;
  for (let i = 1; i < parts.length; i += 3) {
    const b = sheet.bodies.findIndex((body) => body.name === parts[i + 1]);
    const own = drawing.entries.filter((entry) => entry.body === b);
    if (parts[i] === "\f\v") {
      const inertia = fileNumber(drawing.inertia[b], isGiven);
      text += `${inertia ? `    inertia: ${scalar(inertia)}\n` : ""}${parts[i + 2]}`;
      continue;
    }
    for (const kind of ["force", "moment"]) {
      const list = own.filter((entry) => entry.kind === kind);
      text += listText(`${kind}s`, list.map(entryText), here(), (line, k) => places.set(line, { entry: list[k] }));
    }
    const lines = linesOf(b).map((line) => JSON.stringify(line));
    if (parts[i] === "\v") text += listText("hand", lines, here(), (line, k) => places.set(line, { body: b, line: k }));
    text += parts[i + 2];
  }
  return { text, places };
}

const asksHand = (body) => sheet.sheet.includes(`\n\v${body.name}\n`);
const asksInertia = (body) => sheet.sheet.includes(`\f\v${body.name}\n`);

// The data of a body in the sheet, one line each: its shape, mass, motion.
function dataOf(body) {
  const [before] = sheet.sheet.split(new RegExp(`^[\\f\\v]${body.name}\n`, "m"));
  return [...before.slice(before.lastIndexOf(`\n  ${body.name}:\n`)).matchAll(/^ {4}(\w+: .+)$/gm)].map(([, line]) => line).join(", ");
}

// The parameters given in the sheet, [name, text].
function givenValues() {
  const rows = /^parameters:\n((?: {2}.*\n)*)/m.exec(sheet.sheet);
  return rows ? [...rows[1].matchAll(/^ {2}(\w+): (.*)$/gm)].map(([, name, text]) => [name, /^\{value: ([^,}]*)/.exec(text)?.[1] || text]) : [];
}

const isGiven = (name) => givenValues().some(([other]) => other === name);

// A given angle or length as a number, for directions and positions that use it; NaN for others.
function givenValue(name) {
  const row = givenValues().find(([other]) => other === name);
  return row ? amountOf(row[1], () => NaN) : NaN;
}
