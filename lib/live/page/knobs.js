"use strict";

// Sliders: each moves one number of the text.

// A round number, at least `value`: at most two digits.
function niceAbove(value) {
  const power = 10 ** Math.floor(Math.log10(value)), digit = value / power;
  return power * ([1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((step) => digit <= step * (1 + 1e-9)) || 10);
}

const positive = ["kg", "slug", "m", "ft", "kg*m^2", "slug*ft^2", "s"]; // masses, sizes and durations, which must not be 0
const spans = { deg: 180, rad: Math.PI, "rad/s": 10, m: 1, "m/s": 5, ft: 3, "ft/s": 15 }; // half ranges of values that start at 0

// The number of a control as written: {number, unit, factor}; for an expression its value.
function quantityOf(control, text) {
  const spot = control.written, units = control.unit === "rad" ? "deg" : control.unit;
  if (spot && spot.number !== undefined) {
    const written = text.slice(spot.from, spot.to);
    return { number: Number(written.slice(0, spot.number)), unit: written.slice(spot.number).trim(), factor: spot.factor };
  }
  const factor = units === "deg" ? Math.PI / 180 : 1;
  return { number: Number(((control.value ?? 0) / factor).toPrecision(12)), unit: units, factor };
}

// The range of a slider: that of the file, or up to twice the present value.
function rangeOf(control, { number, unit: units, factor }, key) {
  if (control.low !== null && control.low !== undefined) return [control.low, control.high].map((limit) => Number((limit / factor).toPrecision(12)));
  if (key === "until") return [0, niceAbove(3 * number)];
  if (!control.unit && number >= 0 && number <= 1) return [0, 1]; // coefficient of friction or restitution, fraction
  if (number === 0) return [-(spans[units] || 1), spans[units] || 1];
  const far = niceAbove(2 * Math.abs(number)), near = positive.includes(control.unit) && key.startsWith("parameters") ? far / 20 : 0;
  if (key.startsWith("initial") && units !== "m" && units !== "ft") return [-far, far];
  return number > 0 ? [near, far] : [-far, far];
}

// A round step, about 1/200 of the range.
function stepOf([low, high]) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 100));
  return (high - low) / step > 400 ? 2 * step : step;
}

// key: {control, quantity, slider, box, range, shown: in the box, sent: the last text that a slider, box or grip wrote}
const knobs = new Map();

function writtenAs(knob, number) {
  const digits = Math.max(0, -Math.floor(Math.log10(knob.step) + 1e-9));
  return `${Number(Number(number).toFixed(Math.min(digits, 20)))}${knob.quantity.unit ? ` ${knob.quantity.unit}` : ""}`;
}

// Make a slider and a box for the same number; tell(key, text) puts it into the model.
function makeKnob(key, control, text, tell) {
  const row = document.createElement("label"), name = document.createElement("span");
  const slider = document.createElement("input"), box = document.createElement("input"), knob = { row, slider, box };
  row.className = "knob";
  name.textContent = control.name;
  name.title = control.description || "";
  slider.type = "range";
  box.type = "text";
  box.spellcheck = false;
  box.setAttribute("aria-label", control.name);
  slider.addEventListener("input", () => {
    box.value = writtenAs(knob, slider.value);
    tell(key, box.value, true);
  });
  slider.addEventListener("change", () => tell(key, box.value));
  box.addEventListener("change", () => {
    box.value = box.value.trim() || knob.shown;
    tell(key, box.value);
  });
  row.append(name, slider, box);
  knobs.set(key, knob);
  nameSlider(control.name, knob);
  setKnob(key, control, text);
  return row;
}

function nameSlider(name, { slider }) {
  slider.setAttribute("aria-label", phrase("live-slider", name));
}

function setKnob(key, control, text) {
  const knob = knobs.get(key), amount = quantityOf(control, text), spot = control.written;
  const fixed = !spot || control.derived || !Number.isFinite(amount.number), before = knob.shown;
  knob.shown = spot && spot.to !== undefined ? text.slice(spot.from, spot.to) : `${show(amount.number)} ${amount.unit}`.trim();
  // the range stays where the page itself has changed the number, or another one
  const { range: [low, high] = [0, 0] } = knob, typed = knob.shown !== before && knob.shown !== knob.sent;
  if (typed || knob.quantity.unit !== amount.unit || amount.number < low || amount.number > high) {
    knob.range = rangeOf(control, amount, key);
    if (amount.number < knob.range[0]) knob.range[0] = amount.number;
    if (amount.number > knob.range[1]) knob.range[1] = amount.number;
    knob.step = stepOf(knob.range);
  }
  Object.assign(knob, { control, quantity: amount });
  if (document.activeElement !== knob.slider) {
    Object.assign(knob.slider, { min: knob.range[0], max: knob.range[1], step: knob.step });
    knob.slider.value = amount.number;
  }
  for (const input of [knob.slider, knob.box]) input.disabled = fixed;
  if (document.activeElement === knob.box || document.activeElement === knob.slider) return;
  knob.box.value = knob.shown;
}
