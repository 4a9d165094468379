"use strict";

// Code of the worker: calls the library through its loader (fbd-live.js), one question after another. Texts in, JSON
// out.

let library = null;

function toHeap(text) {
  const size = library.lengthBytesUTF8(text) + 1, at = library._malloc(size);
  library.stringToUTF8(text, at, size);
  return at;
}

function call(name, texts, numbers) {
  const places = texts.map(toHeap), answer = library[`_live_${name}`](...places, ...numbers);
  const text = answer ? library.UTF8ToString(answer) : null;
  for (const at of [...places, answer]) library._free(at);
  return text;
}

async function begin({ module, files }) {
  library = await self.makeFbd({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then(done);
      return {};
    },
    progress: (done, all) => postMessage({ progress: [done, all] }),
  });
  for (const [name, text] of files) {
    const folder = name.slice(0, name.lastIndexOf("/") + 1);
    if (folder) library.FS.mkdirTree(folder);
    library.FS.writeFile(name, text);
  }
  postMessage({ ready: true });
}

// The controls of a text, and its run with `rows` rows.
function both([text, name, off], rows) {
  const controls = call("controls", [text, name], []);
  return [controls, controls.endsWith("\"controls\":null}") ? null : call("run", [text, name, off], rows)];
}

self.onmessage = ({ data }) => {
  if (data.module) begin(data);
  else postMessage({ answer: data.call === "both" ? both(data.texts, data.numbers) : call(data.call, data.texts, data.numbers || []) });
};
