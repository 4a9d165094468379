"use strict";

// The shown model as a file, as a link and as a command line.

// The text that runs, without the effects that are off.
function savedText(answered) {
  if (bench.off.size === 0) answered(editor.value);
  else bench.runner.request("text", [editor.value, parts.name, offNames()], (text) => answered(text ?? editor.value));
}

function download(text, type, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function saveText() {
  savedText((text) => download(text, "text/yaml", parts.name));
}

// A calculation note of the model that is shown, as HTML.
function saveNote() {
  const button = element("live-note"), ready = () => { button.textContent = phrase("live-note"); };
  button.textContent = phrase("live-calculating");
  bench.writer = bench.writer || makeClient(() => {});
  bench.writer.failed = (message) => { ready(); say("live-note-failed", [message], "error"); };
  bench.writer.request("note", [editor.value, parts.name, offNames()], (answer) => {
    const { errors, note } = JSON.parse(answer);
    ready();
    if (note) download(note, "text/html", parts.name.replace(/(\.ya?ml)?$/, "-note.html"));
    else sayLibrary(errors, "live-no-note");
  });
}

// ---- links: the text and the effects that are off, deflated, in the fragment

async function piped(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function packed(state) {
  const bytes = await piped(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream("deflate-raw"));
  return btoa(String.fromCharCode(...bytes)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

async function unpacked(text) {
  const bytes = new Uint8Array(decode(text.replace(/-/g, "+").replace(/_/g, "/")));
  return JSON.parse(new TextDecoder().decode(await piped(bytes, new DecompressionStream("deflate-raw"))));
}

async function readLink() {
  const match = /^#m=([\w-]+)$/.exec(location.hash);
  if (!match) return null;
  try {
    const { text, off } = await unpacked(match[1]);
    return typeof text === "string" && Array.isArray(off) ? { text, off } : null;
  } catch { return null; }
}

// Update the address when nothing has changed for a while, since browsers limit the rate of updates.
function keepLinkSoon() {
  clearTimeout(bench.linking);
  bench.linking = setTimeout(keepLink, 300);
  showCommand();
}

// Store the model in the address, unless it is the page's own.
async function keepLink() {
  const own = editor.value === bench.own && bench.off.size === 0;
  const address = own ? location.pathname + location.search : `#m=${await packed({ text: editor.value, off: [...bench.off] })}`;
  try { history.replaceState(null, "", address); } catch { /* a page of a file: the link is there to be copied */ }
  // the newest address counts
  // eslint-disable-next-line require-atomic-updates
  bench.link = own ? location.href.split("#")[0] : location.href.split("#")[0] + address;
  showCommand();
}

// ---- the command line

function quoted(text) {
  return /^[\w./:=+-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

// Parameters and settings of the run become options; other changes require the saved file.
function commandLine() {
  const first = bench.first, words = ["fbd-run"];
  let text = parts.text;
  if (!first || !bench.controls) return null;
  const known = new Map(controlList(bench.controls)), options = { until: "--until", method: "--method", tolerance: "--tolerance" };
  const changes = [];
  for (const [key, control] of controlList(first)) {
    const other = known.get(key), spot = control.written, written = other?.written;
    if (!spot || !written || written.to === undefined || !(key.startsWith("parameters") || options[key])) continue;
    const value = bench.base.slice(written.from, written.to);
    if (spot.to !== undefined && value === parts.text.slice(spot.from, spot.to)) continue;
    changes.push([spot, spot.to === undefined ? spot.before + value + spot.behind : value]);
    if (options[key]) words.push(options[key], quoted(value.replace(/\s+/g, "")));
    else words.push("--set", quoted(`${key.slice("parameters.".length)}=${value}`));
  }
  for (const [spot, value] of changes.sort((a, b) => b[0].from - a[0].from)) text = text.slice(0, spot.from) + value + text.slice(spot.to ?? spot.from);
  for (const name of bench.off) words.push("--without", quoted(name));
  return text === bench.base ? [...words, quoted(parts.name)].join(" ") : null;
}

function showCommand() {
  element("live-command").textContent = commandLine() || `fbd-run ${quoted(parts.name)}   # ${phrase("live-as-saved")}`;
}

function copy(text, button) {
  navigator.clipboard.writeText(text).then(() => { button.textContent = phrase("live-copied"); }, () => { window.prompt("", text); });
  setTimeout(() => { button.textContent = phrase(button.dataset.text); }, 1200);
}

function connectShare() {
  element("live-save").addEventListener("click", saveText);
  element("live-note").addEventListener("click", saveNote);
  element("live-link").addEventListener("click", () => copy(bench.link || location.href, element("live-link")));
  element("live-copy").addEventListener("click", () => copy(element("live-command").textContent, element("live-copy")));
  addEventListener("hashchange", async () => {
    clearTimeout(bench.linking);
    const linked = await readLink();
    if (linked) setModel(linked.text, linked.off);
  });
}
