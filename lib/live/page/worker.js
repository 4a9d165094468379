"use strict";

// Code of the worker: calls the library, one function after another. Texts in, JSON out.

let library = null;

function toHeap(text) {
  const bytes = new TextEncoder().encode(text), at = library.malloc(bytes.length + 1);
  const heap = new Uint8Array(library.memory.buffer, at, bytes.length + 1);
  heap.set(bytes);
  heap[bytes.length] = 0;
  return at;
}

function fromHeap(at) {
  const heap = new Uint8Array(library.memory.buffer);
  return new TextDecoder().decode(heap.subarray(at, heap.indexOf(0, at)));
}

function call(name, texts, numbers) {
  const places = texts.map(toHeap), answer = library[`live_${name}`](...places, ...numbers);
  const text = answer ? fromHeap(answer) : null;
  for (const at of [...places, answer]) library.free(at);
  return text;
}

async function begin({ module, files }) {
  const page = { progress: (done, all) => postMessage({ progress: [done, all] }) };
  const imports = { page, wasi_snapshot_preview1: makeSystem(files, () => library.memory) };
  library = (await WebAssembly.instantiate(module, imports)).exports;
  library._initialize();
  library.live_begin();
  postMessage({ ready: true });
}

// The controls of a text, and its run with `rows` rows.
function both([text, name, off], rows) {
  const controls = call("controls", [text, name], []);
  return [controls, controls.endsWith("\"controls\":null}") ? null : call("run", [text, name, off], rows)];
}

// The text with a pull, its controls and its run.
function pulled([text, name, off, body, way], [rows, ...numbers]) {
  const made = call("pulled", [text, name, body, way], numbers), own = JSON.parse(made).text;
  return own === null ? [made] : [made, ...both([own, name, off], [rows])];
}

const several = { both, pulled }; // calls of several functions of the library

self.onmessage = ({ data }) => {
  if (data.module) begin(data);
  else postMessage({ answer: several[data.call] ? several[data.call](data.texts, data.numbers) : call(data.call, data.texts, data.numbers || []) });
};
