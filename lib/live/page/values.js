"use strict";

// At which value of a parameter does an outcome change, or an equation hold? The answers become marks on its slider, at
// which it stops when it is dragged, and buttons that set it.

const finder = { client: null };

// A value in SI units as the slider of a parameter writes it, with all digits that are known.
function valueAsWritten(knob, { value, error }) {
  const { factor, unit: units } = knob.quantity;
  const digits = error > 0 ? Math.min(12, Math.max(3, Math.ceil(Math.log10(Math.abs(value) / error)))) : 12;
  return `${Number((value / factor).toPrecision(Number.isFinite(digits) ? digits : 12))}${units ? ` ${units}` : ""}`;
}

function markSlider(knob, solutions) {
  const list = document.createElement("datalist");
  list.id = "live-values-marks";
  list.append(...solutions.map(({ value }) => new Option("", String(value / knob.quantity.factor))));
  element(list.id)?.remove();
  knob.slider.after(list);
  // a mark between two steps of the slider could not be reached
  if (solutions.length) Object.assign(knob.slider, { step: "any" });
  knob.slider.setAttribute("list", list.id);
}

function foundItem(key, knob, solution) {
  const item = document.createElement("li"), button = document.createElement("button");
  const written = valueAsWritten(knob, solution);
  button.type = "button";
  button.textContent = `${knob.control.name} = ${written}`;
  button.addEventListener("click", () => moved(key, written));
  item.append(button, ` ±${show(solution.error / knob.quantity.factor, 2)} ${knob.quantity.unit}`.trimEnd());
  if (solution.below) item.append(phrase("live-below-above", solution.below, solution.above));
  return item;
}

function showFound(answer) {
  const { errors, find } = JSON.parse(answer), says = element("live-find-says"), list = element("live-found");
  const wrong = errors.find((note) => note.severity === "error"), key = find && `parameters.${find.parameter}`;
  const knob = find && knobs.get(key);
  list.replaceChildren();
  Object.assign(says, { className: wrong ? "error" : "", textContent: wrong ? `${wrong.message}${wrong.hint ? `: ${wrong.hint}` : ""}` : "" });
  if (!knob) return;
  list.append(...find.solutions.map((solution) => foundItem(key, knob, solution)));
  markSlider(knob, find.solutions);
  const own = (value) => `${show(value / knob.quantity.factor)} ${knob.quantity.unit}`.trim();
  says.textContent = phrase("live-found", find.solutions.length, own(find.from), own(find.to), find.runs, own(Number(find.step.toPrecision(3))));
}

function requestValues(event) {
  event.preventDefault();
  const says = element("live-find-says");
  finder.client = finder.client || makeClient(([share, all]) => { says.textContent = phrase("live-searched", Math.round(100 * share / all)); });
  finder.client.failed = (message) => Object.assign(says, { className: "error", textContent: phrase("live-search-failed", message) });
  says.textContent = phrase("live-searching");
  finder.client.request("find", [editor.value, parts.name, element("live-question").value], showFound, [element("live-statics").checked ? 1 : 0]);
}

function connectValues() {
  element("live-find").addEventListener("submit", requestValues);
}
