"use strict";

// Sliders: each moves one number of the text.

// A number with two digits that is no smaller.
function niceAbove(value) {
  const power = 10 ** Math.floor(Math.log10(value)), digit = value / power;
  return power * ([1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((step) => digit <= step * (1 + 1e-9)) || 10);
}

const positive = ["kg", "g", "t", "slug", "lbm", "m", "cm", "mm", "ft", "in", "kg*m^2", "slug*ft^2"]; // masses and sizes: 0 is none
const spans = { deg: 180, rad: Math.PI, "rad/s": 10, m: 1, "m/s": 5, ft: 3, "ft/s": 15 }; // of what starts at 0

// How the number of a control is written: {number, unit, factor}; of an expression its value.
function quantityOf(control, text) {
  const place = control.written, unit = control.unit === "rad" ? "deg" : control.unit;
  if (place && place.number !== undefined) {
    const written = text.slice(place.from, place.to);
    return { number: Number(written.slice(0, place.number)), unit: written.slice(place.number).trim(), factor: place.factor };
  }
  const factor = unit === "deg" ? Math.PI / 180 : 1;
  return { number: Number(((control.value ?? 0) / factor).toPrecision(12)), unit, factor };
}

// From where to where: as the file says, or twice as far as now.
function rangeOf(control, { number, unit, factor }, key) {
  if (control.low !== null && control.low !== undefined) return [control.low / factor, control.high / factor];
  if (key === "until") return [0, niceAbove(3 * number)];
  if (number === 0) return [-(spans[unit] || 1), spans[unit] || 1];
  const far = niceAbove(2 * Math.abs(number)), near = positive.includes(unit || control.unit) && key.startsWith("parameters") ? far / 20 : 0;
  if (key.startsWith("initial") && unit !== "m" && unit !== "ft") return [-far, far];
  return number > 0 ? [near, far] : [-far, -near];
}

// A step that is a round number, some two hundred of them.
function stepOf([low, high]) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 100));
  return (high - low) / step > 400 ? 2 * step : step;
}

const knobs = new Map(); // key: {control, quantity, slider, box, range}

function writtenAs(knob, number) {
  const digits = Math.max(0, -Math.floor(Math.log10(knob.step) + 1e-9));
  return `${Number(Number(number).toFixed(Math.min(digits, 20)))}${knob.quantity.unit ? ` ${knob.quantity.unit}` : ""}`;
}

// A slider and a box for the same number; moved(key, text) puts it into the model.
function makeKnob(key, control, text, moved) {
  const row = document.createElement("label"), name = document.createElement("span");
  const slider = document.createElement("input"), box = document.createElement("input"), knob = { row, slider, box };
  row.className = "knob";
  name.textContent = control.name;
  name.title = control.description || "";
  slider.type = "range";
  slider.setAttribute("aria-label", `${control.name}, slider`);
  box.type = "text";
  box.spellcheck = false;
  box.setAttribute("aria-label", control.name);
  slider.addEventListener("input", () => {
    box.value = writtenAs(knob, slider.value);
    moved(key, box.value);
  });
  box.addEventListener("change", () => moved(key, box.value.trim()));
  row.append(name, slider, box);
  knobs.set(key, knob);
  setKnob(key, control, text);
  return row;
}

function setKnob(key, control, text) {
  const knob = knobs.get(key), quantity = quantityOf(control, text), place = control.written;
  const fixed = !place || control.derived || !Number.isFinite(quantity.number);
  if (!knob.range || (knob.quantity.unit !== quantity.unit) || quantity.number < knob.range[0] || quantity.number > knob.range[1]) {
    knob.range = rangeOf(control, quantity, key);
    if (quantity.number < knob.range[0]) knob.range[0] = quantity.number;
    if (quantity.number > knob.range[1]) knob.range[1] = quantity.number;
    knob.step = stepOf(knob.range);
  }
  Object.assign(knob, { control, quantity });
  if (document.activeElement !== knob.slider) {
    Object.assign(knob.slider, { min: knob.range[0], max: knob.range[1], step: knob.step });
    knob.slider.value = quantity.number;
  }
  for (const input of [knob.slider, knob.box]) input.disabled = fixed;
  if (document.activeElement === knob.box || document.activeElement === knob.slider) return;
  knob.box.value = place && place.to !== undefined ? text.slice(place.from, place.to) : `${show(quantity.number)} ${quantity.unit}`.trim();
}
