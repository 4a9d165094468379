"use strict";

// Keys and words of the model language while one types: a list at the caret, and the meaning of the key at the caret or
// under the pointer. They come from the JSON Schema of the library (fbd_schema).

const hints = { schema: null, list: [], chosen: -1, from: 0 };

// ---- the schema

// A node with all that it refers to, its alternatives and conditions.
function schemaNodes(node) {
  if (!node || typeof node !== "object") return [];
  const referred = node.$ref && hints.schema.definitions[node.$ref.split("/").pop()];
  return [node, ...[referred, node.then, node.else, ...(node.allOf || []), ...(node.anyOf || []), ...(node.oneOf || [])].flatMap(schemaNodes)];
}

// The nodes under a key, or with null of the items of a list.
function schemaUnder(nodes, key) {
  const under = ({ items, properties = {}, additionalProperties }) => {
    if (key === null) return items;
    return Object.hasOwn(properties, key) ? properties[key] : additionalProperties;
  };
  return nodes.map(under).flatMap(schemaNodes);
}

function schemaAt(trail) {
  return trail.reduce(schemaUnder, schemaNodes(hints.schema));
}

// The words that nodes permit, with their meanings: keys if `asKeys`, and values.
function wordsOf(nodes, asKeys) {
  const words = new Map();
  const add = (word, means, isKey) => { if (typeof word === "string" && !words.get(word)?.means) words.set(word, { word, means: means || "", isKey }); };
  for (const node of nodes) {
    for (const value of [...(node.enum || []), node.const]) add(value, node.description, false);
    if (asKeys) for (const [key, value] of Object.entries(node.properties || {})) add(key, meaningOf(schemaNodes(value)), true);
  }
  return [...words.values()].filter(({ word }) => word[0] !== "$");
}

function meaningOf(nodes) {
  return nodes.find((node) => node.description)?.description || "";
}

// ---- the place in the text

// The path of keys, with null for items of lists, at the end of a text; `value` behind a key on its line. Reads the subset of
// YAML that models use: blocks, lists, brackets, texts in quotes, comments.
function pathAtEnd(text) {
  const open = []; // of blocks: {column, key}; of brackets: {bracket, key}
  let value = false;
  const last = () => open[open.length - 1], lines = text.split("\n");
  lines.forEach((line, i) => {
    let at = /^ */.exec(line)[0].length;
    value = false;
    if (!last()?.bracket) {
      if (i + 1 < lines.length && !/^ *[^ #]/.test(line)) return;
      // the items of a list may stand at the column of its key
      while (last()?.column >= at && !(last().column === at && line[at] === "-" && last().key !== null)) open.pop();
      for (let item; (item = /^- +|^-$/.exec(line.slice(at))); at += item[0].length) open.push({ column: at, key: null });
      const key = /^"?([\w.$]+)"?:(?= |$)/.exec(line.slice(at));
      if (key) { open.push({ column: at, key: key[1] }); at += key[0].length; value = true; }
    }
    value = readFlow(open, line.slice(at)) || (value && !last().bracket);
  });
  return { path: open.filter(({ bracket, key }) => bracket !== "{" || key !== undefined).flatMap(pathOf), value };
}

function pathOf({ bracket, key }) {
  if (bracket === "[") return key === undefined ? [null] : [null, key];
  return [key];
}

// Follow the brackets of a line; true behind a key in one.
function readFlow(open, line) {
  const tokens = line.matchAll(/"(?:[^"\\]|\\.)*"|'[^']*'|(?:^|\s)#.*$|[[\]{},]|([\w.$]+):(?=\s|$)/g);
  for (const [token, key] of tokens) {
    const last = open[open.length - 1];
    if (/^\s*#/.test(token)) break;
    if (token === "{" || token === "[") open.push({ bracket: token });
    else if (last?.bracket && (token === "}" || token === "]")) open.pop();
    else if (last?.bracket && token === ",") delete last.key;
    else if (last?.bracket && key) last.key = key;
  }
  return open[open.length - 1]?.key !== undefined && Boolean(open[open.length - 1].bracket);
}

// The word around or before a place, from its start.
function wordAt(text, at, whole) {
  const before = /[\w.$]*$/.exec(text.slice(0, at))[0], behind = whole ? /^[\w.$]*/.exec(text.slice(at))[0] : "";
  return { word: before + behind, from: at - before.length };
}

// The meaning of the word at a position of the text, or else of the key whose value it is.
function meaningAt(text, at) {
  const { word, from } = wordAt(text, at, true), { path: trail, value } = pathAtEnd(text.slice(0, from)), key = trail[trail.length - 1];
  if (/#/.test(text.slice(text.lastIndexOf("\n", from - 1) + 1, from))) return "";
  const found = wordsOf(schemaAt(trail), !value).find((other) => other.word === word);
  const said = found?.means ? [word, found.means] : [key, key && meaningOf(schemaAt(trail))];
  return said[1] ? said.join(": ") : "";
}

// ---- the list

function showMeaning(at) {
  const means = hints.schema ? meaningAt(editor.value, at) : "", line = element("live-hint");
  Object.assign(line, { textContent: means || phrase("live-hints"), lang: means ? "en" : "" });
}

function closeHints() {
  hints.list = [];
  element("live-words").hidden = true;
  editor.removeAttribute("aria-activedescendant");
}

// Width of a letter and height of a line.
function editorGrid() {
  const style = getComputedStyle(editor), context = document.createElement("canvas").getContext("2d");
  context.font = `${style.fontSize} ${style.fontFamily}`;
  return [context.measureText("m").width, parseFloat(style.lineHeight), parseFloat(style.paddingLeft)];
}

function chooseHint(index) {
  const list = element("live-words");
  hints.chosen = index;
  [...list.children].forEach((item, i) => item.setAttribute("aria-selected", String(i === index)));
  if (index < 0) return;
  list.children[index].scrollIntoView({ block: "nearest" });
  editor.setAttribute("aria-activedescendant", list.children[index].id);
}

// Open the list of the words that may follow at the caret; without a request only while a word is typed.
function openHints(requested) {
  const at = editor.selectionStart, { word, from } = wordAt(editor.value, at, false), text = editor.value.slice(0, from);
  closeHints();
  if (!hints.schema || (!requested && !word) || /#[^\n]*$/.test(text)) return;
  const { path: trail, value } = pathAtEnd(text), words = wordsOf(schemaAt(trail), !value);
  hints.list = words.filter((other) => other.word.startsWith(word) && (requested || other.word !== word));
  if (!hints.list.length) return;
  hints.from = from;
  const list = element("live-words"), before = text.slice(text.lastIndexOf("\n") + 1), [width, height, pad] = editorGrid();
  list.replaceChildren(...hints.list.map(({ word: name, means }, i) => {
    const item = make("li", "", make("b", "", name), make("small", "", means.slice(0, 80)));
    item.id = `live-word-${i}`;
    item.setAttribute("role", "option");
    item.addEventListener("click", () => takeHint(i));
    return item;
  }));
  list.hidden = false;
  const top = pad + height * text.split("\n").length - editor.scrollTop, area = element("live-paper");
  list.style.left = `${Math.max(0, Math.min(pad + width * before.length - editor.scrollLeft, area.clientWidth - list.offsetWidth))}px`;
  list.style.top = `${top + list.offsetHeight > area.clientHeight && top > list.offsetHeight + height ? top - height - list.offsetHeight : top}px`;
  chooseHint(requested ? 0 : -1);
}

// Replace the beginning of a word by the word, as typed input.
function takeHint(index) {
  const { word, isKey } = hints.list[index], colon = isKey && !/^\s*:/.test(editor.value.slice(editor.selectionStart));
  editor.focus();
  editor.setSelectionRange(hints.from, editor.selectionStart);
  document.execCommand("insertText", false, word + (colon ? ": " : ""));
  closeHints();
}

// Keys while the list is open; Enter inserts the word chosen by the arrow keys.
function hintKey(event) {
  const { list, chosen } = hints, step = { ArrowDown: 1, ArrowUp: -1 }[event.key], count = list.length;
  if (event.key === " " && event.ctrlKey) openHints(true);
  else if (!count) return;
  else if (step) chooseHint((Math.max(chosen, step < 0 ? 0 : -1) + step + count) % count);
  else if (event.key === "Tab" || (event.key === "Enter" && chosen >= 0)) takeHint(Math.max(chosen, 0));
  else if (event.key === "Escape") closeHints();
  else return;
  event.preventDefault();
  event.stopPropagation();
}

function connectHints(schema) {
  hints.schema = JSON.parse(schema);
  showMeaning(0);
  editor.addEventListener("keydown", hintKey);
  listen("live-words", "mousedown", (event) => event.preventDefault()); // the caret stays in the text
  editor.addEventListener("blur", closeHints);
  editor.addEventListener("scroll", closeHints);
  editor.addEventListener("input", (event) => { if (event.inputType === "insertText" && /^\w$/.test(event.data || "")) openHints(false); else closeHints(); });
  document.addEventListener("selectionchange", () => { if (document.activeElement === editor) showMeaning(editor.selectionStart); });
  editor.addEventListener("pointermove", (event) => {
    const [width, height, pad] = editorGrid(), row = Math.floor((event.offsetY - pad + editor.scrollTop) / height);
    const line = editor.value.split("\n")[row] ?? "", column = Math.round((event.offsetX - pad + editor.scrollLeft) / width);
    const at = placeInText(editor.value, row + 1, column + 1);
    showMeaning(column <= line.length ? at : editor.value.length);
  });
  editor.addEventListener("pointerleave", () => showMeaning(editor.selectionStart));
}
