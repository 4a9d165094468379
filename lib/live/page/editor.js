"use strict";

// The model's text: an editor with line numbers and marks at errors.

const editor = element("live-text");

function showLineNumbers() {
  const count = editor.value.split("\n").length, gutter = element("live-lines");
  if (gutter.childElementCount === count) return;
  gutter.replaceChildren(...Array.from({ length: count }, (unused, i) => {
    const line = document.createElement("div");
    line.textContent = String(i + 1);
    return line;
  }));
}

// The index in the text of line and column (from 1, in characters).
function placeInText(text, line, column) {
  let at = 0;
  for (let i = 1; i < line; i++) {
    const end = text.indexOf("\n", at);
    if (end < 0) return text.length;
    at = end + 1;
  }
  for (let i = 1; i < column && at < text.length && text[at] !== "\n"; i++) at += text.codePointAt(at) > 0xffff ? 2 : 1;
  return at;
}

function goToNote(note) {
  const at = placeInText(editor.value, note.line, note.column), rest = /^[\w.+-]+/.exec(editor.value.slice(at));
  editor.focus();
  editor.setSelectionRange(at, at + (rest ? rest[0].length : 1));
  editor.scrollTop = Math.max(0, (note.line - 5) * editor.scrollHeight / Math.max(1, editor.value.split("\n").length));
}

function noteItem(note) {
  const item = document.createElement("li"), button = document.createElement("button");
  button.type = "button";
  button.className = note.severity;
  button.textContent = `${note.line ? `${note.line}:${note.column}: ` : ""}${note.severity}: ${note.message}`;
  if (note.line) button.addEventListener("click", () => goToNote(note));
  item.append(button);
  for (const text of [note.hint, note.see && `see ${note.see}`].filter(Boolean)) {
    const more = document.createElement("small");
    more.textContent = text;
    item.append(more);
  }
  return item;
}

// Show marks by a copy of the text under the editor, invisible except for the marks.
function showMarks(notes) {
  const text = editor.value, places = notes.filter((note) => note.line > 0).map((note) => [placeInText(text, note.line, note.column), note.severity]);
  const back = element("live-marks"), pieces = [];
  let at = 0;
  for (const [from, severity] of places.sort((a, b) => a[0] - b[0])) {
    if (from < at) continue;
    const word = /^[^\s,}\]]+/.exec(text.slice(from)), mark = document.createElement("mark");
    mark.className = severity;
    mark.textContent = word ? word[0] : " ";
    pieces.push(text.slice(at, from), mark);
    at = from + (word ? word[0].length : 0);
  }
  back.replaceChildren(...pieces, text.slice(at), "\n");
}

function showNotes(notes) {
  element("live-notes").replaceChildren(...notes.map(noteItem));
  const lines = element("live-lines").children;
  for (const line of lines) line.className = "";
  for (const note of notes) if (lines[note.line - 1]) lines[note.line - 1].className = note.severity;
  showMarks(notes);
}

function scrollEditor() {
  element("live-lines").scrollTop = editor.scrollTop;
  Object.assign(element("live-marks"), { scrollTop: editor.scrollTop, scrollLeft: editor.scrollLeft });
}

function setEditor(text) {
  if (editor.value === text) return;
  editor.value = text;
  showLineNumbers();
  scrollEditor();
}
