// The program as WebAssembly beside the native one: the same exit code, verdict, counts and real solutions.
//
//     node web/compare.mjs NATIVE MODULE [--all | NAME ...]
//
// Without names twenty entries of the library are compared, one of every sort; with --all every one of those kinds.
import { spawnSync } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { runInThisContext } from 'node:vm';

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

/** Entries that take longer are compared once. */
const KEPT_MS = 3000;

const [native, file, ...wanted] = process.argv.slice(2);
if (!native || !file) {
  console.error('found too few arguments, expected NATIVE MODULE [--all | NAME ...]');
  process.exit(1);
}
const root = new URL('..', import.meta.url).pathname;
const module = await WebAssembly.compile(readFileSync(file));

function nativeRun(args) {
  const { status, stdout, stderr } = spawnSync(native, args, { encoding: 'utf8', maxBuffer: 1 << 28 });
  return { code: status, stdout, stderr };
}

/** What a page runs: its worker, without a page. Node's own WASI ends with a segmentation fault where instances are freed. */
globalThis.self = {};
runInThisContext(readFileSync(join(root, 'assets/viewer/worker.js'), 'utf8'), { filename: 'worker.js' });

/** Runs commands one after the other in one program, as a page does. */
async function wasmRuns(commands) {
  const program = await begun(module);
  return commands.map((command) => run(program, 'again', command, {}));
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

const entries = Object.keys(VERBS).flatMap((kind) => readdirSync(join(root, 'equations', kind))
  .filter((name) => name.endsWith('.toml')).map((name) => [kind, basename(name, '.toml')]));
const named = new Set(wanted.length ? wanted : QUICK);
const chosen = entries.filter(([kind, name]) => wanted.includes('--all') || named.has(name) || named.has(`${kind}/${name}`));
if (!wanted.length) {
  // Two further ones of every kind: the first and the last by name.
  for (const kind of Object.keys(VERBS)) {
    const own = entries.filter(([other]) => other === kind);
    for (const one of [own[0], own[own.length - 1]]) if (chosen.length < 20 && !chosen.includes(one)) chosen.push(one);
  }
}
const start = performance.now();
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
    const [again, kept] = await wasmRuns([plain, plain]);
    found = difference(again, other) || difference(kept, other);
    if (found) found += ', in the program of another command';
  }
  if (found) {
    failed += 1;
    console.log(`${kind}/${name}: ${found}`);
  }
}
console.log(`${chosen.length} entries in ${((performance.now() - start) / 1000).toFixed(1)} s: WebAssembly ${(inWasm / 1000).toFixed(1)} s, native ${(inNative / 1000).toFixed(1)} s`);
console.log(`${chosen.length - failed} passed, ${failed} failed`);
process.exit(failed || !chosen.length ? 1 : 0);
