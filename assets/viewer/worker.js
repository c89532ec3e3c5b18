// The program in a browser: runs looproot, compiled to WebAssembly, away from the page. It is a worker of live pages and of web/.
//
// In:  { module: bytes, gzipped: bool }             once                 out: { ready: true, ms }
//      { id, args: [text], files: { name: text } }  for every command    out: { id, code, stdout, stderr, ms }
//
//      { rehearse: true, args, files }          while nobody asks    nothing
//
// The program begins once, and runs one command after the other: what it has read and prepared of a mechanism serves the next question
// about it. A command that traps or ends the program harms no other, since a new program begins after it. A browser compiles quickly
// first and well later, where a program runs often: a command that is rehearsed while nobody asks makes the answers to come three times
// as fast. The program asks for what a system offers by WASI (wasi_snapshot_preview1); of that there is here what it uses: arguments,
// clocks, random numbers, and one folder of files that are in memory.
'use strict';

const [OK, BAD, EXISTS, INVALID, MISSING, UNKNOWN] = [0, 8, 20, 28, 44, 52];
const [FOLDER, FILE] = [3, 4];
const ROOT = 3;
const PAGE = 65536;

/** What ends a command: its exit code. */
class Exit {
  constructor(code) { this.code = code; }
}

/** Bytes that grow while they are written. */
class Buffer {
  constructor(bytes = new Uint8Array(0)) { this.bytes = bytes; this.length = bytes.length; }

  write(at, part) {
    const end = at + part.length;
    if (end > this.bytes.length) {
      const grown = new Uint8Array(Math.max(end, 2 * this.bytes.length, 4096));
      grown.set(this.bytes.subarray(0, this.length));
      this.bytes = grown;
    }
    this.bytes.set(part, at);
    this.length = Math.max(this.length, end);
  }

  get text() { return new TextDecoder().decode(this.bytes.subarray(0, this.length)); }
}

/** The system as one command sees it; `memory` is set once there is one. */
function system(args, files) {
  const encoder = new TextEncoder();
  const named = new Map(Object.entries(files).map(([name, text]) => [name, new Buffer(encoder.encode(text))]));
  const [stdout, stderr] = [new Buffer(), new Buffer()];
  const open = new Map([
    [0, { file: new Buffer(), at: 0 }], [1, { file: stdout, at: 0 }], [2, { file: stderr, at: 0 }], [ROOT, { folder: true }],
  ]);
  const words = ['looproot', ...args].map((word) => encoder.encode(`${word}\0`));
  const own = { memory: null, stdout, stderr };
  const view = () => new DataView(own.memory.buffer);
  const bytes = (at, length) => new Uint8Array(own.memory.buffer, at, length);
  const name = (at, length) => new TextDecoder().decode(bytes(at, length)).replace(/^(\.?\/)+/, '');

  /** The pieces of memory that a read or a write names. */
  const pieces = (list, count) => Array.from({ length: count }, (_, k) => (
    bytes(view().getUint32(list + 8 * k, true), view().getUint32(list + 8 * k + 4, true))));
  const stat = (at, kind, size) => {
    bytes(at, 64).fill(0);
    view().setUint8(at + 16, kind);
    view().setBigUint64(at + 24, 1n, true);
    view().setBigUint64(at + 32, BigInt(size), true);
    return OK;
  };

  own.calls = {
    args_sizes_get(count, size) {
      view().setUint32(count, words.length, true);
      view().setUint32(size, words.reduce((sum, word) => sum + word.length, 0), true);
      return OK;
    },
    args_get(list, text) {
      let at = text;
      words.forEach((word, k) => {
        view().setUint32(list + 4 * k, at, true);
        bytes(at, word.length).set(word);
        at += word.length;
      });
      return OK;
    },
    environ_sizes_get(count, size) {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return OK;
    },
    environ_get: () => OK,
    clock_time_get(clock, precision, at) {
      const ms = clock === 0 ? Date.now() : performance.now();
      view().setBigUint64(at, BigInt(Math.round(ms * 1e6)), true);
      return OK;
    },
    random_get(at, length) {
      // The browser gives as many at once.
      for (let done = 0; done < length; done += PAGE) crypto.getRandomValues(bytes(at + done, Math.min(PAGE, length - done)));
      return OK;
    },
    sched_yield: () => OK,
    proc_exit(code) { throw new Exit(code); },

    fd_prestat_get(fd, at) {
      if (fd !== ROOT) return BAD;
      view().setUint32(at, 0, true);
      view().setUint32(at + 4, 1, true);
      return OK;
    },
    fd_prestat_dir_name(fd, at) {
      if (fd !== ROOT) return BAD;
      bytes(at, 1)[0] = '/'.charCodeAt(0);
      return OK;
    },
    fd_fdstat_get(fd, at) {
      const found = open.get(fd);
      if (!found) return BAD;
      bytes(at, 24).fill(0);
      // Output is a file and no terminal: no colours, no progress.
      view().setUint8(at, found.folder ? FOLDER : FILE);
      view().setBigUint64(at + 8, ~0n & 0x1fffffffn, true);
      view().setBigUint64(at + 16, ~0n & 0x1fffffffn, true);
      return OK;
    },
    fd_fdstat_set_flags: () => OK,
    fd_filestat_get(fd, at) {
      const found = open.get(fd);
      if (!found) return BAD;
      return found.folder ? stat(at, FOLDER, 0) : stat(at, FILE, found.file.length);
    },
    path_filestat_get(fd, flags, path, length, at) {
      const wanted = name(path, length);
      if (wanted === '' || wanted === '.') return stat(at, FOLDER, 0);
      return named.has(wanted) ? stat(at, FILE, named.get(wanted).length) : MISSING;
    },
    path_open(fd, flags, path, length, how, rights, inherited, status, at) {
      const wanted = name(path, length);
      const [create, folder, fresh, empty] = [1, 2, 4, 8].map((bit) => (how & bit) !== 0);
      const next = Math.max(...open.keys()) + 1;
      if (wanted === '' || wanted === '.' || folder) {
        if (wanted !== '' && wanted !== '.') return MISSING;
        open.set(next, { folder: true });
      } else {
        if (!named.has(wanted) && !create) return MISSING;
        if (named.has(wanted) && create && fresh) return EXISTS;
        if (!named.has(wanted) || empty) named.set(wanted, new Buffer());
        open.set(next, { file: named.get(wanted), at: 0 });
      }
      view().setUint32(at, next, true);
      return OK;
    },
    fd_read(fd, list, count, at) {
      const found = open.get(fd);
      if (!found || found.folder) return BAD;
      let done = 0;
      for (const piece of pieces(list, count)) {
        const part = found.file.bytes.subarray(found.at, Math.min(found.at + piece.length, found.file.length));
        piece.set(part);
        found.at += part.length;
        done += part.length;
      }
      view().setUint32(at, done, true);
      return OK;
    },
    fd_write(fd, list, count, at) {
      const found = open.get(fd);
      if (!found || found.folder) return BAD;
      let done = 0;
      for (const piece of pieces(list, count)) {
        found.file.write(found.at, piece);
        found.at += piece.length;
        done += piece.length;
      }
      view().setUint32(at, done, true);
      return OK;
    },
    fd_seek(fd, offset, from, at) {
      const found = open.get(fd);
      if (!found || found.folder) return BAD;
      const place = [0, found.at, found.file.length][from] + Number(offset);
      if (!(place >= 0)) return INVALID;
      found.at = place;
      view().setBigUint64(at, BigInt(place), true);
      return OK;
    },
    fd_readdir(fd, at, length, cookie, used) {
      // Nothing that runs here lists a folder.
      view().setUint32(used, 0, true);
      return OK;
    },
    fd_close(fd) {
      return open.delete(fd) ? OK : BAD;
    },
  };
  return own;
}

/** A program that has begun, and the system that it asks: each command has its own. */
async function begun(module) {
  const own = { system: null };
  const imports = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    imports[space] ??= {};
    imports[space][name] = (...values) => (own.system.calls[name] ? own.system.calls[name](...values) : UNKNOWN);
  }
  own.exports = (await WebAssembly.instantiate(module, imports)).exports;
  // Its main function has to end before the next command.
  run(own, '_start', ['--version'], {});
  return own;
}

/** A program whose memory has grown to this many bytes is followed by a new one: memory never becomes smaller. */
const LARGE = 1 << 28;

/** Runs one command to its end, by an export of the program. `whole` says whether the program can run another one. */
function run(program, name, args, files) {
  const own = system(args, files);
  own.memory = program.exports.memory;
  program.system = own;
  const answer = (code, whole, more = '') => ({ code, stdout: own.stdout.text, stderr: own.stderr.text + more, whole });
  try {
    return answer(program.exports[name](), own.memory.buffer.byteLength < LARGE);
  } catch (error) {
    return error instanceof Exit ? answer(error.code, false) : answer(70, false, `${error}\n`);
  }
}

let module = null;
/** The program of the next command. */
let program = null;
/** The number of commands that were asked for. */
let asked = 0;
/** How often a command is rehearsed, and for how many milliseconds: after a hundred answers all of it is compiled well. */
const [REHEARSALS, REHEARSED] = [100, 3000];

/** Runs one command, and begins another program where this one cannot go on. */
async function answered({ args, files }) {
  const { whole, ...answer } = run(await program, 'again', args, files || {});
  if (!whole) program = begun(module);
  return answer;
}

/** Runs a command again and again until another one is asked for. */
async function rehearse(command) {
  const [before, start] = [asked, performance.now()];
  for (let k = 0; k < REHEARSALS && performance.now() - start < REHEARSED; k += 1) {
    await answered(command);
    // What was asked meanwhile comes first.
    await new Promise((resolve) => { setTimeout(resolve); });
    if (asked !== before) return;
  }
}

async function load({ module: bytes, gzipped }) {
  if (!gzipped) return WebAssembly.compile(bytes);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  // Compiled while it is unpacked.
  return WebAssembly.compileStreaming(new Response(stream, { headers: { 'content-type': 'application/wasm' } }));
}

self.onmessage = async ({ data }) => {
  const start = performance.now();
  if (data.module) {
    try {
      module = await load(data);
      program = begun(module);
      await program;
      self.postMessage({ ready: true, ms: performance.now() - start });
    } catch (error) {
      self.postMessage({ ready: false, error: String(error) });
    }
    return;
  }
  if (data.rehearse) {
    await rehearse(data);
    return;
  }
  asked += 1;
  const answer = await answered(data);
  self.postMessage({ id: data.id, ...answer, ms: performance.now() - start });
};
