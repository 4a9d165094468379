"use strict";

// The library in workers: compiled once, one question at a time. Of several waiting questions only the newest is kept;
// a question that takes too long is ended when another one comes.

const parts = JSON.parse(element("live-parts").textContent);
const patience = 2000; // ms

const engine = { module: null, script: URL.createObjectURL(new Blob([parts["wasi.js"], "\n", parts["worker.js"]], { type: "text/javascript" })) };

async function compileEngine() {
  const bytes = new Blob([decode(element("live-wasm").textContent.trim())]).stream();
  const headers = { "Content-Type": "application/wasm" };
  engine.module = await WebAssembly.compileStreaming(new Response(bytes.pipeThrough(new DecompressionStream("gzip")), { headers }));
}

// Make a worker for one kind of question; told(progress) is called with its progress.
function makeAsker(told) {
  const asker = { worker: null, ready: false, busy: null, since: 0, waiting: null };
  const next = () => {
    if (!asker.ready || asker.busy || !asker.waiting) return;
    asker.busy = asker.waiting;
    asker.waiting = null;
    asker.since = performance.now();
    asker.worker.postMessage(asker.busy.question);
  };
  const hear = ({ data }) => {
    if (data.progress) { told(data.progress); return; }
    if (data.ready) asker.ready = true;
    else {
      const { answered } = asker.busy;
      asker.busy = null;
      answered(data.answer);
    }
    next();
  };
  const start = () => {
    asker.worker = new Worker(engine.script);
    asker.worker.onmessage = hear;
    asker.worker.onerror = (event) => { event.preventDefault(); asker.stop(); asker.failed(event.message); };
    asker.worker.postMessage({ module: engine.module, files: parts.files });
  };
  asker.failed = () => {};
  // End the present question; a waiting one is asked afterwards.
  asker.stop = () => {
    asker.worker?.terminate();
    Object.assign(asker, { ready: false, busy: null });
    start();
  };
  asker.ask = (call, texts, answered, numbers) => {
    asker.waiting = { question: { call, texts, numbers }, answered };
    if (asker.busy && performance.now() - asker.since > patience) asker.stop();
    else next();
  };
  start();
  return asker;
}
