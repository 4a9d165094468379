"use strict";

// The library in workers: compiled once; a worker runs one call at a time. Of several waiting calls only the newest is kept;
// a call that exceeds `patience` is ended when another one comes.

const parts = JSON.parse(element("live-parts").textContent);
const patience = 2000; // ms

const engine = { module: null, script: URL.createObjectURL(new Blob([parts["wasi.js"], "\n", parts["worker.js"]], { type: "text/javascript" })) };

async function compileEngine() {
  const bytes = new Blob([decode(element("live-wasm").textContent.trim())]).stream();
  const headers = { "Content-Type": "application/wasm" };
  engine.module = await WebAssembly.compileStreaming(new Response(bytes.pipeThrough(new DecompressionStream("gzip")), { headers }));
}

// Make a worker for one kind of call; onProgress([done, all]) receives its progress.
function makeClient(onProgress) {
  const client = { worker: null, ready: false, busy: null, since: 0, waiting: null };
  const next = () => {
    if (!client.ready || client.busy || !client.waiting) return;
    client.busy = client.waiting;
    client.waiting = null;
    client.since = performance.now();
    client.worker.postMessage(client.busy.question);
  };
  const receive = ({ data }) => {
    if (data.progress) { onProgress(data.progress); return; }
    if (data.ready) client.ready = true;
    else {
      const { answered } = client.busy;
      client.busy = null;
      answered(data.answer);
    }
    next();
  };
  const start = () => {
    client.worker = new Worker(engine.script);
    client.worker.onmessage = receive;
    client.worker.onerror = (event) => { event.preventDefault(); client.stop(); client.failed(event.message); };
    client.worker.postMessage({ module: engine.module, files: parts.files });
  };
  client.failed = () => {};
  // End the present call; a waiting one runs afterwards.
  client.stop = () => {
    client.worker?.terminate();
    Object.assign(client, { ready: false, busy: null });
    start();
  };
  client.request = (call, texts, answered, numbers) => {
    client.waiting = { question: { call, texts, numbers }, answered };
    if (client.busy && performance.now() - client.since > patience) client.stop();
    else next();
  };
  start();
  return client;
}
