// The program as WebAssembly beside the native one: the same exit code, verdict, counts and real solutions.
//
//     node web/compare.mjs NATIVE MODULE [--all | NAME ...]
//
// Without names twenty entries of the library are compared, one of every sort; with --all every one of those kinds.
import { spawnSync } from 'node:child_process';
import { closeSync, mkdtempSync, openSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { WASI } from 'node:wasi';

/** What is asked of the entries of a folder. */
const VERBS = {
  arm: ['solve', '--json'], loop: ['solve', '--json'], platform: ['solve', '--json'], overconstrained: ['solve', '--json'],
  linkage: ['solve', '--json'], chain: ['mobility', '--json'], framework: ['mobility', '--json'],
};
const QUICK = [
  'general_16real', 'manocha_canny_1994', 'puma560', 'ur5', 'general_02real', 'crcrr_2_angle', 'rrsrr', 'general_7r',
  'dietmaier_40real', 'goldberg_a',
];
/** Angles and metres: rounding differs, since lanes and compilers do. */
const NEAR = 1e-8;

/** Entries in one process: Node 20 was seen to end with a segmentation fault after some hundred instances of a module. */
const BATCH = 20;
/** Entries that take longer are compared once. */
const KEPT_MS = 3000;

const [native, file, ...wanted] = process.argv.slice(2);
if (!native || !file) {
  console.error('found too few arguments, expected NATIVE MODULE [--all | NAME ...]');
  process.exit(1);
}
const root = new URL('..', import.meta.url).pathname;
const folder = mkdtempSync(join(tmpdir(), 'looproot-'));
const module = await WebAssembly.compile(readFileSync(file));

function nativeRun(args) {
  const { status, stdout, stderr } = spawnSync(native, args, { encoding: 'utf8', maxBuffer: 1 << 28 });
  return { code: status, stdout, stderr };
}

/** Runs commands one after the other in one program, as a page does: the first begins it. */
async function wasmRuns(commands) {
  const [out, err] = ['out', 'err'].map((name) => join(folder, name));
  const [stdout, stderr] = [out, err].map((path) => openSync(path, 'w'));
  const args = ['looproot'];
  const wasi = new WASI({ version: 'preview1', args, env: {}, stdout, stderr, returnOnExit: true });
  const imports = wasi.getImportObject();
  // The arguments of the command that runs, in the place of those of the process.
  const text = () => args.map((word) => new TextEncoder().encode(`${word}\0`));
  const memory = () => new DataView(instance.exports.memory.buffer);
  imports.wasi_snapshot_preview1.args_sizes_get = (count, size) => {
    memory().setUint32(count, args.length, true);
    memory().setUint32(size, text().reduce((sum, word) => sum + word.length, 0), true);
    return 0;
  };
  imports.wasi_snapshot_preview1.args_get = (list, at) => {
    let next = at;
    text().forEach((word, k) => {
      memory().setUint32(list + 4 * k, next, true);
      new Uint8Array(memory().buffer).set(word, next);
      next += word.length;
    });
    return 0;
  };
  const instance = await WebAssembly.instantiate(module, imports);
  const ended = [];
  let [printed, said] = [0, 0];
  for (const [k, command] of commands.entries()) {
    args.splice(1, args.length, ...command);
    let code;
    try {
      code = k ? instance.exports.again() : wasi.start(instance);
    } catch (error) {
      code = String(error);
    }
    const [whole, told] = [out, err].map((path) => readFileSync(path));
    ended.push({ code, stdout: whole.subarray(printed).toString(), stderr: told.subarray(said).toString() });
    [printed, said] = [whole.length, told.length];
  }
  [stdout, stderr].forEach(closeSync);
  return ended;
}

/** How far two values of a variable are apart; angles as points of the circle. */
function apart(a, b, isAngle) {
  const d = Math.abs(a - b);
  return isAngle ? Math.abs(d - 2 * Math.PI * Math.round(d / (2 * Math.PI))) : d;
}

/** The numbers of a real mode, and which of them are angles. */
function numbers(mode, variables) {
  if (mode.q) return mode.q.map((value, k) => [value, (variables[k]?.kind ?? 'angle') === 'angle']);
  if (mode.quaternion) return [...mode.quaternion, ...mode.position].map((value) => [value, false]);
  const bodies = Object.entries(mode.bodies ?? {}).sort(([a], [b]) => (a < b ? -1 : 1));
  return bodies.flatMap(([, body]) => [[body.angle ?? 0, true], ...(body.position ?? []).map((value) => [value, false])]);
}

/** What differs between two answers, or nothing. */
function difference(own, other) {
  if (own.code !== other.code) return `exit code ${own.code}, native ${other.code}: ${own.stderr.trim()}`;
  if (!other.stdout.trim()) return own.stdout.trim() ? 'an answer, native none' : null;
  const [a, b] = [own, other].map((one) => JSON.parse(one.stdout));
  const results = (document) => document.results ?? [document];
  if (results(a).length !== results(b).length) return `${results(a).length} results, native ${results(b).length}`;
  for (const [k, x] of results(a).entries()) {
    const y = results(b)[k];
    for (const key of ['mobility', 'proof', 'rank']) {
      if (typeof y[key] !== 'object' && x[key] !== y[key]) return `${key} ${x[key]}, native ${y[key]}`;
    }
    const [u, v] = [x.verdict ?? {}, y.verdict ?? {}];
    for (const key of ['status', 'proof', 'code', 'real', 'complex', 'self_motion', 'at_infinity', 'certified', 'near']) {
      if (typeof v !== 'object' ? u !== v : u[key] !== v[key]) return `case ${k + 1}: ${key} ${u[key]}, native ${v[key]}`;
    }
    const [p, q] = [x, y].map((one) => (one.modes ?? []).filter((mode) => mode.real !== false));
    if (p.length !== q.length) return `case ${k + 1}: ${p.length} real solutions, native ${q.length}`;
    const left = [...q];
    for (const mode of p) {
      const mine = numbers(mode, b.joint_variables ?? []);
      const at = left.findIndex((one) => {
        const theirs = numbers(one, b.joint_variables ?? []);
        const near = (sign) => mine.every(([value, isAngle], i) => apart(i < 4 ? sign * value : value, theirs[i][0], isAngle) < NEAR);
        // A quaternion and its negative are one rotation.
        return near(1) || (mode.quaternion && near(-1));
      });
      if (at < 0) return `case ${k + 1}: the solution ${mine.map(([value]) => value.toFixed(6))} is none of the native ones`;
      left.splice(at, 1);
    }
  }
  return null;
}

/** Compares entries in processes of their own; those of a process that a signal ended are compared one by one. */
function inBatches(names) {
  let failed = 0;
  const compare = (some) => {
    const { status, signal, stdout } = spawnSync(process.execPath, ['--no-warnings', process.argv[1], native, file, ...some], { encoding: 'utf8' });
    process.stdout.write(stdout);
    if (signal && some.length > 1) some.forEach((name) => compare([name]));
    else if (status !== 0) failed += 1;
    if (signal && some.length === 1) console.log(`${some[0]}: ended by ${signal}`);
  };
  for (let k = 0; k < names.length; k += BATCH) compare(names.slice(k, k + BATCH));
  rmSync(folder, { recursive: true });
  console.log(`${names.length} entries, ${failed} batches failed`);
  return failed ? 1 : 0;
}

const entries = Object.keys(VERBS).flatMap((kind) => readdirSync(join(root, 'equations', kind))
  .filter((name) => name.endsWith('.toml')).map((name) => [kind, basename(name, '.toml')]));
if (wanted.includes('--all')) process.exit(inBatches(entries.map((entry) => entry.join('/'))));
const named = new Set(wanted.length ? wanted : QUICK);
const chosen = entries.filter(([kind, name]) => named.has(name) || named.has(`${kind}/${name}`));
if (!wanted.length) {
  // Two further ones of every kind: the first and the last by name.
  for (const kind of Object.keys(VERBS)) {
    const own = entries.filter(([other]) => other === kind);
    for (const one of [own[0], own[own.length - 1]]) if (chosen.length < 20 && !chosen.includes(one)) chosen.push(one);
  }
}
const begun = performance.now();
let [failed, inWasm, inNative] = [0, 0, 0];
for (const [kind, name] of chosen) {
  const [verb, ...options] = VERBS[kind];
  const args = [verb, `${kind}/${name}`, ...options, '--seed', '1'].filter((word) => verb === 'solve' || !['--seed', '1'].includes(word));
  const first = performance.now();
  const other = nativeRun(args);
  const second = performance.now();
  const [own] = await wasmRuns([args]);
  inNative += second - first;
  inWasm += performance.now() - second;
  let found = difference(own, other);
  // With a seed nothing is kept. Without one the third command finds what the second has prepared.
  if (!found && verb === 'solve' && performance.now() - second < KEPT_MS) {
    const plain = args.slice(0, -2);
    const [, again, kept] = await wasmRuns([['--version'], plain, plain]);
    found = difference(again, other) || difference(kept, other);
    if (found) found += ', in the program of another command';
  }
  if (found) {
    failed += 1;
    console.log(`${kind}/${name}: ${found}`);
  }
}
rmSync(folder, { recursive: true });
console.log(`${chosen.length} entries in ${((performance.now() - begun) / 1000).toFixed(1)} s: WebAssembly ${(inWasm / 1000).toFixed(1)} s, native ${(inNative / 1000).toFixed(1)} s`);
console.log(`${chosen.length - failed} passed, ${failed} failed`);
process.exit(failed || !chosen.length ? 1 : 0);
