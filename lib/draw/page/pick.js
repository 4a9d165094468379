"use strict";

// Arrows under the pointer: drawn stronger, with their terms in the equations and the names of their curves, and the
// reverse. A click or tap on one shows its numbers.

const picked = { lit: "", shown: "" }; // keys of arrows

function arrowBy(key) {
  for (const body of run.bodies) for (const arrow of body.arrows) if (arrowKey(body, arrow) === key) return { body, arrow };
  return null;
}

function distanceTo([x1, y1, x2, y2, arc], x, y) {
  if (arc) return Math.abs(Math.hypot(x - (x1 + x2) / 2, y - (y1 + y2) / 2) - (x2 - x1) / 2);
  const dx = x2 - x1, dy = y2 - y1, s = ((x - x1) * dx + (y - y1) * dy) / (dx * dx + dy * dy);
  const along = clamp(s, 0, 1);
  return Math.hypot(x - x1 - along * dx, y - y1 - along * dy);
}

// The key of the arrow nearest to a point of the canvas, within `reach` pixels.
function arrowAt([x, y], reach) {
  let best = "", least = reach;
  for (const arrow of drawn.arrows) {
    const away = distanceTo(arrow, x, y);
    if (arrow[5] && away < least) { least = away; best = arrow[5]; }
  }
  return best;
}

// Mark the terms and names of the arrow that is lit, or else of the one whose numbers are shown.
function markTerms() {
  const key = picked.lit || picked.shown;
  for (const node of document.querySelectorAll("[data-arrow]")) node.classList.toggle("lit", node.getAttribute("data-arrow") === key);
}

function light(key) {
  if (key === picked.lit) return;
  picked.lit = key;
  markTerms();
  refresh(false);
}

// Show the numbers of an arrow, and write them for screen readers; scroll its first equation into the panel.
function pick(key) {
  picked.shown = key;
  markTerms();
  const found = arrowBy(key), box = element("equations"), term = found && box.querySelector(`[data-arrow="${CSS.escape(key)}"]`);
  const [x] = drawn.arrows.find((arrow) => arrow[5] === key) || [0];
  element("card").className = x > view.width / 2 ? "left" : ""; // beside the arrow
  if (term) box.scrollTop += term.getBoundingClientRect().top - box.getBoundingClientRect().top - 40;
  element("said").textContent = found ? `${found.body.name}: ${arrowInWords(found.arrow, now())}` : "";
  refresh();
}

function pickNext() {
  const keysDrawn = [...new Set(drawn.arrows.map((arrow) => arrow[5]).filter(Boolean))];
  pick(keysDrawn[keysDrawn.indexOf(picked.shown) + 1] || keysDrawn[0] || "");
}

function showCard(t) {
  const found = arrowBy(picked.shown), table = element("card-table");
  element("card").hidden = !found;
  if (!found) return;
  const { arrow, body } = found, [fx, fy, , , couple] = arrow.arrow, read = (c) => readAt(c, t);
  const { force, moment, energy } = run.units, [x, y] = [read(fx), read(fy)];
  const lines = [[phrase("magnitude"), Math.hypot(x, y), force], ["x", x, force], ["y", y, force]];
  if (sizeOf(couple) > roundingOf(moment)) lines.push([phrase("moment"), read(couple), moment]);
  if (arrow.work >= 0) lines.push([phrase("work"), read(arrow.work), energy]);
  element("card-title").textContent = phrase("arrow-on", quantity(arrow.name), body.name);
  element("card-title").style.color = `var(--${arrow.hue})`;
  table.textContent = "";
  for (const [name, value, units] of lines) addRow(table, [[name], [show(value), true], [unit(units)]]);
}

function connectPick() {
  for (const id of ["equations", "charts"]) {
    listen(id, "pointerover", (event) => light(event.target.closest("[data-arrow]")?.getAttribute("data-arrow") || ""));
    listen(id, "pointerleave", () => light(""));
  }
  listen("equations", "click", (event) => {
    const term = event.target.closest("[data-arrow]");
    if (term) pick(term.getAttribute("data-arrow"));
  });
  listen("scene", "pointerleave", () => light(""));
  listen("card-close", "click", () => { pick(""); canvas.focus(); });
}
