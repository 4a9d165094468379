"use strict";

// The live page: the text of the model is run, saved and carried by links; sliders change their numbers in it. Effects
// that are off are removed from the text that runs.

const bench = { base: parts.text, moved: new Map(), off: new Set(), controls: null, shown: 0, runner: null, coster: null, writer: null };

// The text with all changes made by sliders since `controls` were received.
function benchText() {
  const changes = [...bench.moved].map(([key, value]) => [controlOf(key).written, value]).sort((a, b) => b[0].from - a[0].from);
  let text = bench.base;
  for (const [spot, value] of changes) {
    const written = spot.to === undefined ? spot.before + value + spot.behind : value;
    text = text.slice(0, spot.from) + written + text.slice(spot.to ?? spot.from);
  }
  return text;
}

function offNames() {
  return [...bench.off].join("\n");
}

// ---- controls

function controlList(controls) {
  const list = [];
  for (const control of controls.parameters) list.push([`parameters.${control.name}`, control]);
  for (const control of controls.initial) if (control.written) list.push([`initial.${control.name}`, control]);
  for (const key of ["masses", "slopes"])
    for (const control of controls[key]) if (control.written?.number !== undefined) list.push([`${key}.${control.name}`, control]);
  list.push(["until", controls.until], ["tolerance", controls.tolerance], ["method", controls.method]);
  return list;
}

function controlOf(key) {
  return controlList(bench.controls).find(([other]) => other === key)[1];
}

// Apply a change. While a slider moves, the run has fewer rows; the call is sent before the page changes its texts.
function moved(key, value, underWay = false) {
  if (!bench.controls || !controlOf(key).written) return;
  bench.moved.set(key, value);
  bench.last = key;
  if (knobs.has(key)) knobs.get(key).sent = value;
  const text = benchText();
  requestRun(text, underWay ? rowsUnderWay : 0);
  setEditor(text);
}

// Make the sliders; initial values not given as a number are folded away, as are masses and slopes that are no parameters.
function makeKnobs() {
  const given = [], zero = [];
  knobs.clear();
  for (const [key, control] of controlList(bench.controls)) {
    if (key === "method" || key === "tolerance") continue;
    const folded = /^(masses|slopes)/.test(key) || (key.startsWith("initial") && control.written.number === undefined);
    (folded ? zero : given).push(makeKnob(key, control, bench.base, moved));
  }
  element("live-knobs").replaceChildren(...given);
  element("live-more").replaceChildren(...zero);
  element("live-more").parentElement.hidden = zero.length === 0;
  bench.keys = keyList();
}

function keyList() {
  return controlList(bench.controls).map(([key, control]) => key + (control.written ? "" : "-")).join(" ");
}

function effectName(effect) {
  return effect.body ? `${effect.body}.${effect.name}` : effect.name;
}

function makeEffects() {
  const names = new Set(), made = JSON.stringify(bench.controls.effects.map(({ body, name }) => [body, name]).concat([...bench.off]));
  if (made === bench.effectsMade) return;
  bench.effectsMade = made;
  element("live-effects").replaceChildren(...bench.controls.effects.map((effect) => {
    const label = document.createElement("label"), box = document.createElement("input"), name = effectName(effect);
    names.add(name);
    box.type = "checkbox";
    box.checked = !bench.off.has(name);
    box.dataset.effect = name;
    box.addEventListener("change", () => {
      if (box.checked) bench.off.delete(name); else bench.off.add(name);
      requestRun();
    });
    label.append(box, ` ${bench.controls.effects.some((other) => other.body !== effect.body) ? name : effect.name}`);
    return label;
  }));
  for (const name of bench.off) if (!names.has(name)) bench.off.delete(name);
  element("live-effects").parentElement.hidden = names.size === 0;
}

function showMethod() {
  const { controls } = bench, select = element("live-method"), box = element("live-tolerance");
  if (!select.length) select.replaceChildren(...["auto", ...controls.methods].map((name) => new Option(name)));
  select.value = controls.chosen;
  select.disabled = !controls.method.written;
  box.disabled = controls.accuracy || controls.step || !controls.tolerance.written;
  if (document.activeElement !== box) box.value = controls.tolerance.value ?? "1e-10";
}

// Use the controls received for a text.
function takeControls(text, controls) {
  bench.base = text;
  bench.controls = controls;
  bench.moved.clear();
  if (bench.keys === keyList()) for (const [key, control] of controlList(controls)) { if (knobs.has(key)) setKnob(key, control, text); }
  else makeKnobs();
  makeEffects();
  showMethod();
}

// ---- runs

function say(key, values = [], css = "") {
  bench.said = { key, values };
  Object.assign(element("live-says"), { textContent: phrase(key, ...values), className: css, lang: "" });
}

// Show the first error of the library, whose messages are English, or the text of `key` without one.
function sayLibrary(errors, key = "live-no-run") {
  const wrong = errors.find((note) => note.severity === "error");
  say(key, [], "error");
  if (!wrong) return;
  bench.said = null;
  Object.assign(element("live-says"), { textContent: wrong.message, lang: "en" });
}

// Write the texts of the live panel in the chosen language.
function speakLive() {
  for (const knob of knobs.values()) nameSlider(knob.control.name, knob);
  showMeaning(editor.selectionStart);
  if (bench.said) element("live-says").textContent = phrase(bench.said.key, ...bench.said.values);
  if (checker.said) sayChecked(...checker.said);
  showCommand();
}

function answeredControls(text, answer) {
  const { errors, controls } = JSON.parse(answer);
  if (text !== editor.value) return;
  showNotes(errors);
  element("live-grade").hidden = !/^grading:/m.test(text);
  if (controls) takeControls(text, controls);
  element("live-side").classList.toggle("stale", !controls);
  for (const [key, { box }] of knobs) box.setAttribute("aria-invalid", String(!controls && key === bench.last));
  if (!controls) sayLibrary(errors, "live-no-model");
}

function answeredRun(question, answer) {
  const { errors, data } = JSON.parse(answer);
  if (question.off) showNotes(errors); // positions are valid: removing effects keeps the line numbers
  const wrong = errors.find((note) => note.severity === "error");
  if (data) showAgain(data);
  if (wrong || !data) sayLibrary(errors);
  else say("live-ran", [(performance.now() - bench.since).toFixed(0)]);
  bench.shown++;
  bench.runFor = question.text + question.off;
  element("live-stop").hidden = true;
  keepLinkSoon();
}

// Rows of a run while a slider moves: a quarter of the usual number.
const rowsUnderWay = 500;

// Request the controls and then the run of a text.
function requestRun(text = editor.value, rows = 0) {
  const off = offNames();
  bench.since = performance.now();
  markVerdict(text);
  bench.coster?.stop();
  bench.runner.request("both", [text, parts.name, off], (answer) => {
    const [controls, motion] = answer;
    answeredControls(text, controls);
    if (motion) answeredRun({ text, off }, motion);
    else { bench.shown++; element("live-stop").hidden = true; }
  }, [rows]);
}

// ---- cost of accuracy

function showCosts() {
  if (!element("live-costs").open) return;
  const picture = element("live-diagram"), says = element("live-cost-says");
  says.textContent = phrase("live-measuring");
  bench.coster = bench.coster || makeClient(([share]) => { says.textContent = phrase("live-measured", Math.round(100 * share)); });
  bench.coster.request("cost", [editor.value, parts.name, offNames()], (svg) => {
    says.textContent = svg ? "" : phrase("live-no-costs");
    picture.hidden = !svg;
    if (svg) picture.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  }, [3]);
}

// ---- the start

function stopRun() {
  bench.runner.stop();
  element("live-stop").hidden = true;
  say("live-stopped", [], "error");
}

function connectBench() {
  let typing = 0;
  editor.addEventListener("input", () => {
    showLineNumbers();
    bench.last = null;
    clearTimeout(typing);
    typing = setTimeout(() => requestRun(), 150);
  });
  editor.addEventListener("scroll", scrollEditor);
  element("live-method").addEventListener("change", () => moved("method", element("live-method").value));
  element("live-tolerance").addEventListener("change", () => moved("tolerance", element("live-tolerance").value.trim()));
  element("live-costs").addEventListener("toggle", showCosts);
  element("live-measure").addEventListener("click", showCosts);
  element("live-stop").addEventListener("click", stopRun);
  element("live-reset").addEventListener("click", () => { setModel(ownText(), []); });
  listen("language", "change", speakLive);
  connectShare();
  connectValues();
  connectCheck();
}

function setModel(text, off) {
  bench.off = new Set(off);
  setEditor(text);
  requestRun();
}

// The initial text of the page, with the settings of the command line.
function ownText() {
  if (!bench.first) return parts.text;
  Object.assign(bench, { base: parts.text, controls: bench.first });
  const known = new Map(controlList(bench.first));
  bench.moved = new Map(Object.entries(parts.moved).filter(([key]) => known.get(key)?.written));
  return benchText();
}

async function startBench() {
  say("live-loading");
  setEditor(parts.text);
  connectBench();
  await compileEngine();
  bench.runner = makeClient(([t, until]) => {
    element("live-stop").hidden = false;
    say("live-running", [show(t), show(until)]);
  });
  bench.runner.failed = (message) => say("live-failed", [message], "error");
  const controls = await new Promise((answered) => { bench.runner.request("controls", [parts.text, parts.name], answered); });
  bench.first = JSON.parse(controls).controls;
  connectHints(await new Promise((answered) => { bench.runner.request("schema", [], answered); }));
  bench.own = ownText();
  const linked = await readLink();
  setModel(linked ? linked.text : bench.own, linked ? linked.off : []);
}

startBench().catch((error) => say("live-no-library", [error.message], "error"));
window.fbd.bench = bench;
