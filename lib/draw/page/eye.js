"use strict";

// The user's view: wheel, drag, pinch and buttons zoom and move the scene; window and paper change its size.

function eyeOn(change) {
  change();
  refresh();
}

const fingers = new Map(); // pointers that are down: id -> [x, y]
let pressed = null; // the start of a press by one pointer

function movePointer(event) {
  const before = fingers.get(event.pointerId), at = [event.offsetX, event.offsetY];
  if (!before) {
    if (event.pointerType === "mouse") light(arrowAt(at, 8));
    return;
  }
  const others = [...fingers].filter(([id]) => id !== event.pointerId).map(([, where]) => where);
  fingers.set(event.pointerId, at);
  if (!others.length) {
    eyeOn(() => panBy(at[0] - before[0], at[1] - before[1]));
    return;
  }
  const apart = ([x, y]) => Math.hypot(x - others[0][0], y - others[0][1]) || 1;
  const middle = [(at[0] + others[0][0]) / 2, (at[1] + others[0][1]) / 2];
  eyeOn(() => zoomBy(apart(at) / apart(before), middle));
}

function connectEye() {
  for (const [id, factor] of [["zoom-in", 1.25], ["zoom-out", 0.8]]) listen(id, "click", () => eyeOn(() => zoomBy(factor, viewMiddle())));
  listen("zoom-all", "click", () => { element("follow").checked = false; eyeOn(showWhole); });
  listen("scene", "dblclick", () => eyeOn(showWhole));
  // the wheel without a modifier scrolls the page, unless the scene has the focus
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    event.preventDefault();
    eyeOn(() => zoomBy(Math.exp(-event.deltaY / 400), [event.offsetX, event.offsetY]));
  }, { passive: false });
  listen("scene", "pointerdown", (event) => {
    pressed = fingers.size ? null : [event.offsetX, event.offsetY];
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    canvas.setPointerCapture(event.pointerId);
  });
  listen("scene", "pointermove", movePointer);
  listen("scene", "pointerup", (event) => {
    // a tap: the pointer has hardly moved
    if (pressed && Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) < 6) pick(arrowAt(pressed, event.pointerType === "mouse" ? 8 : 24));
  });
  for (const kind of ["pointerup", "pointercancel"]) listen("scene", kind, (event) => fingers.delete(event.pointerId));
  // the canvas follows the size of its element
  new ResizeObserver(() => { if (!paper.on) { eyeOn(fit); reachFormulas(); } }).observe(canvas);
}

// ---- paper

// On paper the page has the width that A4 and Letter permit, a light style, and pictures of high resolution,
// independent of the width of the window.
const paper = { on: false, width: 672, height: 400, ratio: 3 };

// Scale down formulas wider than their column, since paper does not scroll.
function fitFormulas(on) {
  for (const box of document.querySelectorAll(".formula")) {
    const whole = box.firstChild;
    whole.style.fontSize = "";
    const share = on ? box.clientWidth / whole.getBoundingClientRect().width : 1;
    if (share < 1) whole.style.fontSize = `${(12 * share).toFixed(2)}px`;
  }
}

function setPaper(on) {
  if (paper.on === on) return;
  paper.on = on;
  document.documentElement.classList.toggle("paper", on);
  for (const chart of charts) chart.unseen = false;
  fitFormulas(on);
  if (on) fit([paper.width, paper.height], paper.ratio);
  else fit();
  restyleCharts(on ? paper.ratio : null);
  refresh();
}

function connectPaper() {
  addEventListener("beforeprint", () => setPaper(true));
  addEventListener("afterprint", () => setPaper(false));
}
