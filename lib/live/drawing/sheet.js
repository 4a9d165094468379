"use strict";

// The sheet as a whole: undo, the draft kept by the browser, the file to hand in. `fbd` is the interface for scripts.

const kept = { past: [], future: [], field: "" };

const snapshot = () => JSON.stringify([drawing.entries, drawing.lines, drawing.next, drawing.inertia]);

// Call before a change; successive changes of one field are one undo step.
function keepHistory(field = "") {
  if (field && field === kept.field) return;
  kept.field = field;
  kept.past.push(snapshot());
  kept.future = [];
}

function setDrawing(text) {
  const [entries, lines, next, inertia] = JSON.parse(text);
  Object.assign(drawing, { entries, lines, next, inertia });
  if (!entryOf(drawing.selected)) drawing.selected = 0;
  kept.field = "";
}

function restore(text) {
  setDrawing(text);
  changed();
  showAll();
}

function undo() {
  if (!kept.past.length) return;
  kept.future.push(snapshot());
  restore(kept.past.pop());
}

function redo() {
  if (!kept.future.length) return;
  kept.past.push(snapshot());
  restore(kept.future.pop());
}

function clearSheet() {
  keepHistory();
  const none = sheet.bodies.map(() => "");
  restore(JSON.stringify([[], none, drawing.next, none]));
}

// ---- the draft

// Drafts are kept per key and per version of the page, whose points may differ.
const draftKey = () => {
  let hash = 0;
  for (const letter of element("data").textContent) hash = (Math.imul(hash, 31) + letter.codePointAt(0)) | 0;
  return `fbd ${sheet.exam ? "exam" : "sheet"} ${sheet.student} ${hash}`;
};

function keepDraft() {
  try { localStorage.setItem(draftKey(), snapshot()); } catch { drawing.lost = kept.past.length > 0; } // some browsers store nothing for files
}

// Show the last draft, or an empty sheet. Reading writes nothing: another window may have kept a newer draft.
function takeDraft() {
  let draft = null;
  try { draft = localStorage.getItem(draftKey()); } catch { /* as before */ }
  setDrawing(draft || snapshot());
  showAnswer();
  showAll();
}

// ---- the file

const answerName = () => `${sheet.student.replace(/[^\w.@ -]/g, "_")}.yaml`;

function saveAnswer() {
  const link = make("a", { href: URL.createObjectURL(new Blob([answerOf().text], { type: "text/yaml" })), download: answerName() });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  drawing.lost = false;
  element("says").textContent = `saved as ${link.download}`;
}

function showAnswer() {
  element("answer").textContent = answerOf().text;
  element("undo").disabled = !kept.past.length;
  element("redo").disabled = !kept.future.length;
}

// After a change the previous check is no longer valid.
function changed() {
  drawing.marks.clear();
  element("verdict").hidden = true;
  element("says").textContent = "";
  showAnswer();
  keepDraft();
}

// ---- the start

function showHead() {
  element("title").textContent = sheet.title || "Free-body diagram";
  const equations = sheet.bodies.some(asksHand) ? ", and write its equations" : "";
  const bodies = sheet.bodies.length > 1 ? "each body" : "the body";
  element("asked").textContent = `Sheet of ${sheet.student}. Draw every force and moment on ${bodies}${equations}. ${sheet.reactions}`;
  element("given").replaceChildren(...givenValues().map(([name, text]) =>
    make("div", {}, make("dt", {}, inMath(name)), make("dd", {}, `= ${unit(text).replace(" deg", "°")}`))));
  element("how").textContent = sheet.exam ? "Save the answer and hand the file in." : "";
}

function undoKeys(event) {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches("input[type=text], textarea")) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) redo(); else undo();
}

function begin() {
  showHead();
  sheet.bodies.forEach(makeDesk);
  setMode("force");
  connectVerdict();
  element("save").addEventListener("click", saveAnswer);
  element("undo").addEventListener("click", undo);
  element("redo").addEventListener("click", redo);
  document.addEventListener("keydown", undoKeys);
  element("clear").addEventListener("click", clearSheet);
  addEventListener("beforeunload", (event) => { if (drawing.lost) event.preventDefault(); });
  takeDraft();
}

begin();
window.fbd = { drawing, answer: () => answerOf().text };
