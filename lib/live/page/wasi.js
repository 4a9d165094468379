"use strict";

// The system that the compiled library finds in a worker: the functions of WASI (snapshot preview 1) that its C library
// calls. There are a clock, and the data files of the model, which are read and never written; output is discarded.

const WASI = { success: 0, badDescriptor: 8, noEntry: 44, root: 3, device: 2, folder: 3, file: 4, allRights: 0xffffffffffffffffn };

// "a/./b/../c" is "a/c"; a path that begins with / begins at the same place as any other one.
function plainPath(path) {
  const parts = [];
  for (const part of path.split("/"))
    if (part === ".." && parts.length > 0 && parts.at(-1) !== "..") parts.pop();
    else if (part !== "" && part !== ".") parts.push(part);
  return parts.join("/");
}

// `files`: pairs of path and text. `memory()`: the memory of the library, which may have been replaced by a larger one.
function makeSystem(files, memory) {
  const contents = new Map(files.map(([name, text]) => [plainPath(name), new TextEncoder().encode(text)]));
  const open = new Map(); // descriptor: {bytes, at}
  let next = WASI.root + 1;
  const view = () => new DataView(memory().buffer);
  const path = (at, length) => plainPath(new TextDecoder().decode(new Uint8Array(memory().buffer, at, length)));

  function fileStatus(at, type, size) {
    new Uint8Array(memory().buffer, at, 64).fill(0);
    view().setUint8(at + 16, type);
    view().setBigUint64(at + 32, BigInt(size), true);
    return WASI.success;
  }

  // Calls use(address, length) for each part of a list of buffers and writes the sum of its answers.
  function eachBuffer(list, count, total, use) {
    let sum = 0;
    for (let i = 0; i < count; i++)
      sum += use(view().getUint32(list + 8 * i, true), view().getUint32(list + 8 * i + 4, true));
    view().setUint32(total, sum, true);
    return WASI.success;
  }

  return {
    clock_time_get(clock, precision, answer) {
      const now = clock === 0 ? Date.now() : performance.now();
      view().setBigUint64(answer, BigInt(Math.round(now * 1e6)), true);
      return WASI.success;
    },
    environ_sizes_get(count, bytes) {
      view().setUint32(count, 0, true);
      view().setUint32(bytes, 0, true);
      return WASI.success;
    },
    environ_get: () => WASI.success,
    fd_prestat_get(descriptor, answer) {
      if (descriptor !== WASI.root) return WASI.badDescriptor;
      view().setUint32(answer, 0, true);
      view().setUint32(answer + 4, 1, true);
      return WASI.success;
    },
    fd_prestat_dir_name(descriptor, answer) {
      view().setUint8(answer, "/".charCodeAt(0));
      return WASI.success;
    },
    fd_fdstat_get(descriptor, answer) {
      new Uint8Array(memory().buffer, answer, 24).fill(0);
      view().setUint8(answer, open.has(descriptor) ? WASI.file : descriptor === WASI.root ? WASI.folder : WASI.device);
      view().setBigUint64(answer + 8, WASI.allRights, true);
      view().setBigUint64(answer + 16, WASI.allRights, true);
      return WASI.success;
    },
    fd_fdstat_set_flags: () => WASI.success,
    path_open(folder, lookup, name, length, how, rights, inherited, flags, answer) {
      const bytes = contents.get(path(name, length));
      if (!bytes) return WASI.noEntry;
      open.set(next, { bytes, at: 0 });
      view().setUint32(answer, next++, true);
      return WASI.success;
    },
    path_filestat_get(folder, lookup, name, length, answer) {
      const bytes = contents.get(path(name, length));
      return bytes ? fileStatus(answer, WASI.file, bytes.length) : WASI.noEntry;
    },
    fd_filestat_get(descriptor, answer) {
      const file = open.get(descriptor);
      return file ? fileStatus(answer, WASI.file, file.bytes.length) : fileStatus(answer, WASI.device, 0);
    },
    fd_read(descriptor, list, count, total) {
      const file = open.get(descriptor);
      if (!file) return WASI.badDescriptor;
      return eachBuffer(list, count, total, (at, length) => {
        const part = file.bytes.subarray(file.at, file.at + length);
        new Uint8Array(memory().buffer, at, length).set(part);
        file.at += part.length;
        return part.length;
      });
    },
    fd_seek(descriptor, offset, from, answer) {
      const file = open.get(descriptor);
      if (!file) return WASI.badDescriptor;
      file.at = Number(offset) + [0, file.at, file.bytes.length][from];
      view().setBigUint64(answer, BigInt(file.at), true);
      return WASI.success;
    },
    fd_write: (descriptor, list, count, total) => eachBuffer(list, count, total, (at, length) => length),
    fd_close: (descriptor) => (open.delete(descriptor) ? WASI.success : WASI.badDescriptor),
    proc_exit(status) { throw new Error(`the library ended with ${status}`); },
  };
}
