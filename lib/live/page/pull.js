"use strict";

// While the page plays, a body is pulled by the pointer, or by keys: by a spring from the grabbed point to the hand, with a
// damper beside it. The library writes them into the text as a force with the path of the hand as a table
// (fbd_model_pulled), and the model is run again: the force has an arrow, a term and a work as every other one. After
// the release the motion continues. The hand reaches the pointer `lag` later: only the future part of its path changes.

const lag = 50; // ms between two points of the path
const pull = { body: 0, name: "", text: "", shown: "", path: [], at: null, timer: 0 }; // at: null while nothing is pulled

// The stiffness of the spring by which the arrow of its force, in the scale of the others, ends at the hand.
function stiffnessOfPull() {
  return view.scale / pixelsPerForce();
}

function toWorld([x, y]) {
  return [(x - view.x) / view.scale, (view.y - y) / view.scale];
}

// The grabbed point at a time, in the world.
function grabbedAt(t) {
  return placed(frameAt(run.bodies[pull.body], t), pull.point);
}

// The position of the hand at a time of its path.
function handAt(t) {
  const k = pull.path.findIndex(([time]) => time > t), b = pull.path[k], a = pull.path[Math.max(k, 0) - 1] || pull.path[pull.path.length - 1];
  if (!b || b === pull.path[0]) return (b || a).slice(1);
  const share = (t - a[0]) / (b[0] - a[0]);
  return [a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])];
}

function hidePull() {
  run.links = run.links.filter((link) => !link.pulls);
}

// The spring on the canvas, from the grabbed point to the hand, on a slide along its line.
function showPull() {
  const t = now(), from = grabbedAt(t), hand = handAt(t), { line } = run.bodies[pull.body];
  if (line && line.on < 0) {
    const away = (hand[0] - from[0]) * line.along[0] + (hand[1] - from[1]) * line.along[1];
    hand.splice(0, 2, from[0] + away * line.along[0], from[1] + away * line.along[1]);
  }
  hidePull();
  run.links.push({ body: pull.body, point: pull.point, partner: -1, anchor: hand, kind: "spring", pulls: true });
}

// The force and the work of the hand so far.
function sayPull(key) {
  const body = run.bodies[pull.body], arrow = body.arrows.find(({ name }) => name === pull.name), t = now();
  if (!arrow) return;
  const [fx, fy] = arrow.arrow.map((c) => readAt(c, t)), work = arrow.work < 0 ? 0 : readAt(arrow.work, t);
  element("live-says").setAttribute("aria-live", pull.at ? "off" : "polite"); // not read out twenty times a second
  say(key, [`${body.name}.${arrow.name}`, measured(Math.hypot(fx, fy), run.units.force), measured(work, run.units.energy)]);
}

function takePulled([made, controls, motion]) {
  const { errors, text } = JSON.parse(made), { name } = run.bodies[pull.body];
  if (!text) {
    stopPull();
    showNotes(errors);
    sayLibrary(errors);
    return;
  }
  setEditor(pull.shown = text);
  answeredControls(text, controls);
  const known = pull.name;
  pull.name = bench.controls.effects.filter((effect) => effect.body === name && /^pull(_\d+)?$/.test(effect.name)).pop()?.name;
  if (motion) answeredRun({ text, off: offNames() }, motion);
  else bench.shown++;
  if (pull.at) showPull();
  if (pull.at && pull.name !== known) pick(`${name}:${pull.name}`); // with its term in the equations
  sayPull(pull.at ? "live-pulling" : "live-pulled");
}

// Run the text with the pull so far; the hand stays where it is until `until`.
function requestPull(until, rows) {
  const { text, body, point, stiffness, grab: from } = pull, { pin, name } = run.bodies[body];
  bench.since = performance.now();
  bench.coster?.stop();
  bench.runner.request("pulled", [text, parts.name, offNames(), name, pull.path.flat().join(" ")], takePulled,
    [rows, point[0] + pin[0], point[1] + pin[1], stiffness, from, until]);
}

// Let the hand follow the pointer from now on.
function pullFurther() {
  if (editor.value !== pull.shown) stopPull(); // another control has changed it
  if (!pull.at) return;
  if (!player.playing || now() < pull.grab) { letGo(); return; } // at the end of the run, or by another control
  const t = now(), step = lag / 1000 * player.speed, last = pull.path[pull.path.length - 1], at = Math.max(t, last[0]);
  showPull();
  sayPull("live-pulling");
  if (Math.hypot(pull.at[0] - last[1], pull.at[1] - last[2]) * view.scale < 1) return;
  if (at > last[0]) pull.path.push([at, last[1], last[2]]);
  pull.path.push([at + step, ...pull.at]);
  requestPull(run.end, rowsUnderWay);
}

function stopPull() {
  clearInterval(pull.timer);
  hidePull();
  pull.at = hold.grip = null;
}

// End the pull at the present time: the motion continues without the hand.
function letGo() {
  if (!pull.at) return;
  stopPull();
  const until = Math.max(now(), pull.path[pull.path.length - 1][0]);
  if (pull.path.length > 1) requestPull(until, 0);
  pick("");
}

// Begin to pull body `index` at a point of the world.
function beginPull(index, [x, y]) {
  const body = run.bodies[index], frame = frameAt(body, now());
  const point = ["particle", "track", "slide"].includes(body.motion) && !(body.line && body.line.on < 0) ? body.G : inFrame(frame, [x, y]);
  Object.assign(pull, { body: index, point, text: editor.value, shown: editor.value, name: "" });
  Object.assign(pull, { grab: now(), stiffness: stiffnessOfPull(), path: [[now(), x, y]], at: [x, y] });
  hold.force = view.force;
  pull.timer = setInterval(pullFurther, lag);
  showPull();
}

function gripOfPull(at, reach, begins) {
  const body = player.playing && bodyAt(at, () => true);
  if (!body) return null;
  if (begins) beginPull(body.index, toWorld(at));
  return (to, underWay) => {
    if (pull.at) pull.at = toWorld(to);
    if (!underWay) letGo();
  };
}

// ---- keys: g grabs the chosen body, or the first one, at G, and lets it go; arrows move the hand

const handSteps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function pullByKey(event) {
  if (!bench.controls || takesKey(event.target, event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
  const step = pull.at && handSteps[event.key];
  if (event.key === "g" && !pull.at && !player.playing) say("live-pull-plays");
  else if (event.key === "g" && !pull.at) {
    const body = run.bodies[chosenBody() || 0];
    beginPull(body.index, place(frameAt(body, now()), ...body.G));
  } else if (pull.at && (event.key === "g" || event.key === "Escape")) letGo();
  else if (step) pull.at = pull.at.map((x, k) => x + 20 * step[k] / view.scale);
  else return;
  event.preventDefault();
  event.stopImmediatePropagation();
}

addEventListener("keydown", pullByKey, { capture: true });
