"use strict";

// The desk of a body: its board with tools, the form of the selected entry, the list of entries, the equations.

const desks = []; // elements by body

// ---- the board

function pointShapes(body) {
  return body.points.map(({ paper: [x, y], name }) => svg("circle", { class: "point", cx: x, cy: y, r: 0.9 }, svg("title", {}, name)));
}

function makeBoard(body, b) {
  const [left, top, width, height] = body.box, m = boardMargin;
  const board = svg("svg", { class: "board fbd", viewBox: `${left - m} ${top - m} ${width + 2 * m} ${height + 2 * m}`, role: "group", tabindex: 0,
    "data-body": b, "aria-label": `${body.name}, cut free. F adds a force, M a moment.` });
  const notes = svg("g", { class: "notes" }, ...pictures[b].querySelectorAll("text"));
  board.append(svg("g", { class: "under" }, ...pictures[b].childNodes), svg("g", { class: "points" }, ...pointShapes(body)),
    svg("g", { class: "arrows" }), notes, svg("g", { class: "handles" }));
  connectBoard(board);
  return board;
}

// Move notes of the picture away from arrows; returns their positions.
function placeNotes(board, spots) {
  return [...board.querySelectorAll(".notes text")].map((note) => {
    const { x, y, width, height } = note.getBBox(), middle = [x + width / 2, y + height / 2];
    const crowd = (way) => spots.filter((spot) => {
      const [dx, dy] = minusOf(spot, plus(middle, way));
      return Math.abs(dx) < width / 2 + 2 && Math.abs(dy) < height / 2 + 1;
    }).length;
    const way = [[0, 0], [0, -4], [0, 4], [-4, -4], [4, 4], [0, -8], [0, 8]].reduce((a, b) => (crowd(b) < crowd(a) ? b : a));
    note.setAttribute("transform", `translate(${way})`);
    return plus(middle, way);
  });
}

function showBoard(b) {
  const { board } = desks[b], own = drawing.entries.filter((entry) => entry.body === b), chosen = chosenOn(b);
  const taken = [...sheet.bodies[b].points.map(({ paper }) => paper), ...placeNotes(board, own.flatMap(spotsOf))];
  const focus = document.activeElement?.closest?.(".board") === board ? document.activeElement.dataset.id : null;
  board.querySelector(".arrows").replaceChildren(...own.map((entry) => arrowShape(entry, taken, own)));
  board.querySelector(".handles").replaceChildren(...(chosen ? handlesOf(chosen) : []));
  board.querySelector(".points").classList.toggle("seen", own.length === 0 || Boolean(chosen) || stroke.board === board);
  if (focus) board.querySelector(`[data-id="${focus}"]`)?.focus({ preventScroll: true });
}

function focusArrow(id) {
  const entry = entryOf(id);
  if (entry) desks[entry.body].board.querySelector(`[data-id="${id}"]`)?.focus({ preventScroll: true });
}

function tell(b, text) {
  desks[b].says.textContent = text;
}

// ---- the form of the selected entry

const chosenOn = (b) => drawing.entries.find((entry) => entry.id === drawing.selected && entry.body === b);

function labelled(text, input, css) {
  return make("label", { className: css || "" }, make("span", {}, text), input);
}

// Connect a field of the form to the selected entry; successive changes of one field are one undo step.
function connectField(b, field, kind, take) {
  field.addEventListener(kind, () => {
    const entry = chosenOn(b);
    if (!entry) return;
    keepHistory(`${field.dataset.field}${entry.id}`);
    take(entry);
    const fault = field.validationMessage;
    changed();
    showDesk(b);
    tell(b, fault);
  });
}

function takeDirection(desk, entry) {
  const body = bodyOf(entry), value = desk.direction.value;
  if (value === "unknown") { entry.direction = null; entry.value = ""; return; }
  if (value !== "other") entry.direction = directionsOf(body)[Number(value)];
  else if (entry.direction) entry.direction = { ...entry.direction, body: false, other: true, angle: `${rounded(within(entry.direction.degrees), 5)} deg` };
  else entry.direction = { degrees: 45, angle: "45 deg", body: false, other: true };
}

function takeAngle(desk, entry) {
  const angle = fileNumber(desk.angle.value, isGiven), degrees = amountOf(desk.angle.value, givenValue) * 180 / Math.PI;
  desk.angle.setCustomValidity(Number.isFinite(degrees) ? "" : "an angle, as 30 deg");
  if (Number.isFinite(degrees)) entry.direction = { degrees: within(degrees), angle, body: false, other: true };
}

function takePoint(desk, entry) {
  delete entry.typed;
  entry.point = desk.point.value === "place" ? placeOf(entry) : Number(desk.point.value);
}

function takePlace(desk, entry) {
  const typed = desk.beside.value.split(","), values = typed.map((text) => amountOf(text, givenValue));
  const read = values.length === 2 && values.every(Number.isFinite);
  desk.beside.setCustomValidity(read ? "" : "two lengths, as 0.5 m, 0");
  if (read) Object.assign(entry, { typed, point: placeAt(bodyOf(entry), values) });
}

function makeForm(b) {
  const body = sheet.bodies[b], desk = desks[b];
  const input = (field, properties) => make("input", { type: "text", autocomplete: "off", spellcheck: false, "data-field": field, ...properties });
  const select = (field, ...options) => make("select", { "data-field": field }, ...options.map(([text, value]) => new Option(text, value)));
  const choices = (list) => list.map(({ name }, i) => [name, i]);
  desk.name = input("name", { size: 8 });
  desk.value = input("value", { size: 12, placeholder: "unknown" });
  desk.point = select("point", ...choices(body.points), ...(body.frame ? [["another place", "place"]] : []));
  desk.beside = input("beside", { size: 12 });
  desk.direction = select("direction", ...choices(directionsOf(body)), ["another angle", "other"], ["unknown", "unknown"]);
  desk.angle = input("angle", { size: 10, "aria-label": "Angle from the horizontal, counter-clockwise" });
  desk.tip = make("input", { type: "checkbox", "data-field": "tip" });
  desk.sense = select("sense", ["counter-clockwise", "1"], ["clockwise", "-1"]);
  desk.remove = make("button", { type: "button" }, "Delete");
  connectField(b, desk.name, "input", (entry) => { entry.name = desk.name.value; });
  connectField(b, desk.value, "input", (entry) => { entry.value = desk.value.value; });
  connectField(b, desk.point, "change", (entry) => takePoint(desk, entry));
  connectField(b, desk.beside, "input", (entry) => takePlace(desk, entry));
  connectField(b, desk.direction, "change", (entry) => takeDirection(desk, entry));
  connectField(b, desk.angle, "input", (entry) => takeAngle(desk, entry));
  connectField(b, desk.tip, "change", (entry) => { entry.tip = desk.tip.checked; });
  connectField(b, desk.sense, "change", (entry) => { entry.sense = Number(desk.sense.value); });
  desk.remove.addEventListener("click", () => { const entry = chosenOn(b); if (entry) removeEntry(entry); });
  desk.legend = make("legend", {}, "");
  desk.parts = { place: labelled("acts at", desk.point), beside: labelled("place x, y on the body", desk.beside),
    way: labelled("direction", desk.direction), angle: labelled("angle", desk.angle),
    tip: labelled("its tip is at the point", desk.tip, "box"), sense: labelled("sense", desk.sense) };
  desk.form = make("fieldset", { className: "form" }, desk.legend, labelled("name", desk.name), labelled("magnitude", desk.value),
    ...Object.values(desk.parts), desk.remove);
  desk.form.addEventListener("keydown", (event) => { if (event.key === "Escape") focusArrow(drawing.selected); });
  return desk.form;
}

function showDirection(desk, entry) {
  const all = directionsOf(bodyOf(entry)), { direction } = entry;
  const known = direction && !direction.other ? all.findIndex((other) => other.angle === direction.angle && other.body === direction.body) : -1;
  desk.direction.value = direction ? (known < 0 ? "other" : String(known)) : "unknown";
  desk.parts.angle.hidden = entry.kind !== "force" || desk.direction.value !== "other";
  if (document.activeElement !== desk.angle) { desk.angle.value = direction ? direction.angle : ""; desk.angle.setCustomValidity(""); }
}

function showPlace(desk, entry) {
  const beside = Array.isArray(entry.point);
  desk.point.value = beside ? "place" : String(entry.point);
  desk.parts.beside.hidden = !beside;
  if (!beside || document.activeElement === desk.beside) return;
  desk.beside.value = entry.typed?.join(",") || placeNumbers(bodyOf(entry), entry.point).join(", ");
  desk.beside.setCustomValidity("");
}

function showForm(b) {
  const desk = desks[b], entry = chosenOn(b), force = entry?.kind === "force";
  desk.form.hidden = !entry;
  if (!entry) return;
  desk.legend.textContent = force ? "Force" : "Moment";
  if (document.activeElement !== desk.name) desk.name.value = entry.name;
  desk.name.placeholder = nameOf(entry);
  if (document.activeElement !== desk.value) desk.value.value = entry.value;
  desk.value.disabled = force && !entry.direction;
  for (const part of ["place", "way", "tip"]) desk.parts[part].hidden = !force;
  desk.parts.sense.hidden = force;
  desk.tip.checked = entry.tip;
  desk.sense.value = String(entry.sense);
  showPlace(desk, entry);
  showDirection(desk, entry);
}

// ---- the list

// The finding at an entry or a line, or null.
function markOf(key) {
  const mark = drawing.marks.get(key);
  return mark ? make("span", { className: mark.right ? "right" : "wrong" }, `${mark.right ? "✓" : "✗"} ${mark.message}`) : null;
}

function entryItem(entry) {
  const fault = faultOf(entry), says = markOf(entry.id) || (fault ? make("span", { className: "wrong" }, fault) : "");
  const button = make("button", { type: "button", className: "entry" }, inWords(entry));
  button.setAttribute("aria-pressed", String(entry.id === drawing.selected));
  button.addEventListener("click", () => { choose(entry.id, true); focusArrow(entry.id); });
  return make("li", {}, button, says);
}

function showList(b) {
  const own = drawing.entries.filter((entry) => entry.body === b);
  desks[b].list.replaceChildren(...own.map(entryItem));
  desks[b].none.hidden = own.length > 0;
}

// ---- inertia and equations

function makeInertia(b) {
  const field = make("input", { type: "text", autocomplete: "off", spellcheck: false, placeholder: "as m*R^2/2 or 0.1 kg*m^2" });
  desks[b].inertia = field;
  field.addEventListener("input", () => {
    keepHistory(`inertia${b}`);
    drawing.inertia[b] = field.value;
    changed();
  });
  return labelled("moment of inertia about G", field, "wide");
}

function makeEquations(b) {
  const desk = desks[b];
  desk.lines = make("textarea", { rows: 4, spellcheck: false, autocapitalize: "off", placeholder: "one equation a line, as m*a_x = F - f",
    "aria-label": `Equations of ${sheet.bodies[b].name}, one a line` });
  desk.shown = make("div", { className: "shown" });
  desk.lines.addEventListener("input", () => {
    keepHistory(`lines${b}`);
    drawing.lines[b] = desk.lines.value;
    changed();
    showEquations(b);
  });
  return make("section", {}, make("h3", {}, "Equations"), desk.lines, desk.shown);
}

function showEquations(b) {
  const desk = desks[b];
  if (desk.inertia && desk.inertia.value !== drawing.inertia[b]) desk.inertia.value = drawing.inertia[b];
  if (!desk.lines) return;
  if (desk.lines.value !== drawing.lines[b]) desk.lines.value = drawing.lines[b];
  desk.shown.replaceChildren(...linesOf(b).map((line, i) => {
    const mark = markOf(`${b}:${i}`);
    return make("div", { className: "line" }, typeset(line), ...(mark ? [mark] : []));
  }));
}

// ---- the desk

function makeTools(b) {
  const tool = (kind) => {
    const button = make("button", { type: "button", className: "tool" }, kind === "force" ? "↗ Force" : "↺ Moment");
    button.dataset.kind = kind;
    button.addEventListener("click", () => setMode(kind));
    return button;
  };
  const add = make("button", { type: "button" }, "Add");
  add.title = "Add one that is then moved by keys or by the form";
  add.addEventListener("click", () => addByKey(b, drawing.mode));
  return make("div", { className: "tools", role: "group", "aria-label": "What a stroke draws" }, tool("force"), tool("moment"), add);
}

function setMode(kind) {
  drawing.mode = kind;
  for (const button of document.querySelectorAll(".tool")) button.setAttribute("aria-pressed", String(button.dataset.kind === kind));
}

function makeDesk(body, b) {
  const desk = { body };
  desks.push(desk);
  desk.board = makeBoard(body, b);
  desk.says = make("p", { className: "says" });
  desk.says.setAttribute("aria-live", "polite");
  desk.list = make("ol", { className: "entries" });
  desk.none = make("p", { className: "none" }, "Nothing is drawn yet: drag on the body, or press Add.");
  const side = make("div", { className: "side" }, make("h3", {}, "Forces and moments"), desk.none, desk.list, makeForm(b));
  if (asksInertia(body)) side.append(makeInertia(b));
  if (asksHand(body)) side.append(makeEquations(b));
  const paper = make("div", {}, makeTools(b), desk.board, desk.says);
  const section = make("section", { className: "body" }, make("h2", {}, body.name), make("p", { className: "data" }, dataOf(body)),
    make("div", { className: "desk" }, paper, side));
  section.setAttribute("aria-label", body.name);
  element("bodies").append(section);
}

// Update a desk, except for the field with the focus.
function showDesk(b) {
  showBoard(b);
  showForm(b);
  showList(b);
}

function showAll() {
  sheet.bodies.forEach((body, b) => { showDesk(b); showEquations(b); });
}

function choose(id, keepFocus) {
  drawing.selected = id;
  sheet.bodies.forEach((body, b) => showDesk(b));
  if (id && !keepFocus) focusArrow(id);
}

function removeEntry(entry) {
  keepHistory();
  drawing.entries = drawing.entries.filter((other) => other !== entry);
  drawing.selected = 0;
  changed();
  showDesk(entry.body);
  tell(entry.body, `${nameOf(entry)} is deleted`);
  desks[entry.body].board.focus({ preventScroll: true });
}
