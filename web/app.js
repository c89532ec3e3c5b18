// One page: an editor with the mechanism file on the left, what looproot answers on the right, the verdict on top. The program runs in
// a worker; nothing leaves the machine.
'use strict';

const $ = (selector) => document.querySelector(selector);
const VERBS = [
  ['All solutions', 'view FILE --live'], ['As a table', 'solve FILE'], ['Closure polynomial', 'derive FILE'],
  ['Does it move?', 'mobility FILE'], ['Sweep', 'view FILE --sweep --from "-180 deg" --to "180 deg" --steps 120'],
  ['As understood', 'show FILE'],
];
/** The tone of an answer by the exit code of the program. */
const TONES = { 0: 'sure', 3: 'sure', 2: 'doubt', 4: 'doubt' };

const worker = new Worker('worker.js');
const waiting = new Map();
let count = 0;

/** Runs a command in the worker. */
function run(args, files) {
  const id = ++count;
  return new Promise((resolve) => { waiting.set(id, resolve); worker.postMessage({ id, args, files }); });
}

const ready = new Promise((resolve, reject) => {
  worker.onmessage = ({ data }) => {
    if ('ready' in data) { if (data.ready) resolve(data.ms); else reject(new Error(data.error)); return; }
    waiting.get(data.id)?.(data);
    waiting.delete(data.id);
  };
});

/** Words as a shell would part them: quotes hold words together. */
function words(text) {
  return (text.match(/(?:[^\s"']+|"[^"]*"|'[^']*')+/g) || []).map((word) => word.replace(/["']/g, ''));
}

const file = () => ({ name: $('#name').value.trim() || 'mechanism.toml', text: $('#editor').value });

function say(text, tone) {
  $('#verdict').textContent = text;
  document.body.className = tone;
}

/** The verdict of a page, or of a part of one. */
function verdict(html) {
  const found = new DOMParser().parseFromString(html, 'text/html').querySelector('.verdict');
  return found ? [...found.children].map((part) => part.textContent).join(' \u2014 ') : '';
}

let latest = 0;
async function answer() {
  const own = ++latest;
  const { name, text } = file();
  const args = words($('#words').value).map((word) => (word === 'FILE' ? name : word));
  if (args[0] === 'looproot') args.shift();
  const found = await run(args, { [name]: text });
  if (own !== latest) return;
  const isPage = found.stdout.startsWith('<!doctype');
  const first = (found.stdout || found.stderr).trim().split('\n')[0];
  const isWrong = found.code === 1 || found.code > 4;
  if (isWrong) say(found.stderr.trim() || `exit code ${found.code}`, 'wrong');
  else say((isPage && verdict(found.stdout)) || (isPage ? '' : first), TONES[found.code]);
  document.documentElement.dataset.code = found.code;
  document.documentElement.dataset.answer = own;
  $('#page').hidden = !isPage;
  $('#text').hidden = isPage;
  if (isPage) $('#page').srcdoc = found.stdout;
  else $('#text').textContent = `${found.stdout}${found.stderr}`;
}

// A live page asks here, since it has no program of its own.
window.addEventListener('message', async ({ source, data }) => {
  if (source !== $('#page').contentWindow || !Array.isArray(data?.args)) return;
  const found = await run(data.args.map(String), data.files || {});
  source.postMessage({ ...found, id: data.id }, '*');
  if (found.stdout.startsWith('{')) say(verdict(JSON.parse(found.stdout).header), TONES[found.code] || 'wrong');
});

// ---- the file ----------------------------------------------------------------------------------------------------------

let timer = 0;
function changed() {
  clearTimeout(timer);
  timer = setTimeout(answer, 350);
}

function take(name, text, command) {
  $('#name').value = name;
  $('#editor').value = text;
  $('#editor').scrollTop = 0;
  $('#words').value = command || VERBS[0][1];
  return answer();
}

$('#editor').addEventListener('input', changed);
$('#name').addEventListener('change', answer);
$('#command').addEventListener('submit', (event) => { event.preventDefault(); answer(); });
for (const [title, command] of VERBS) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = title;
  button.addEventListener('click', () => { $('#words').value = command; answer(); });
  $('#verbs').append(button);
}

async function open(own) {
  if (own) await take(own.name, await own.text());
}
$('#file').addEventListener('change', () => open($('#file').files[0]));
for (const [kind, is] of [['dragenter', true], ['dragover', true], ['dragleave', false], ['drop', false]]) {
  window.addEventListener(kind, (event) => {
    event.preventDefault();
    document.body.classList.toggle('over', is);
    if (kind === 'drop') open(event.dataTransfer.files[0]);
  });
}

// ---- the library -------------------------------------------------------------------------------------------------------

const entries = new Map();
async function library() {
  const text = await (await fetch('library.txt')).text();
  const groups = new Map();
  for (const part of text.split(/^=== /m).slice(1)) {
    const end = part.indexOf('\n');
    const [kind, name] = part.slice(0, end).split('/');
    entries.set(`${kind}/${name}`, part.slice(end + 1));
    if (!groups.has(kind)) groups.set(kind, []);
    groups.get(kind).push(name);
  }
  for (const [kind, names] of groups) {
    const group = document.createElement('optgroup');
    group.label = kind;
    for (const name of names) group.append(new Option(name.replace('.toml', ''), `${kind}/${name}`));
    $('#library').append(group);
  }
}
$('#library').addEventListener('change', () => {
  const text = entries.get($('#library').value);
  if (text !== undefined) take($('#library').value.split('/')[1], text);
});

// ---- a link holds the file: nothing is stored anywhere ------------------------------------------------------------------

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function link() {
  const { name, text } = file();
  const plain = new TextEncoder().encode(JSON.stringify([name, text, $('#words').value]));
  const packed = await through(new CompressionStream('deflate-raw'), plain);
  const letters = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(''));
  return `${location.href.split('#')[0]}#${letters.replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '')}`;
}

/** The file of the fragment, or null. */
async function linked() {
  if (location.hash.length < 2) return null;
  try {
    const letters = atob(location.hash.slice(1).replace(/-/g, '+').replace(/_/g, '/'));
    const plain = await through(new DecompressionStream('deflate-raw'), Uint8Array.from(letters, (c) => c.charCodeAt(0)));
    const found = JSON.parse(new TextDecoder().decode(plain));
    return Array.isArray(found) && found.length === 3 ? found.map(String) : null;
  } catch {
    return null;
  }
}

$('#share').addEventListener('click', async () => {
  const address = await link();
  history.replaceState(null, '', address);
  const done = await navigator.clipboard?.writeText(address).then(() => true, () => false);
  $('#saved').textContent = done ? 'the link is copied' : 'the link is in the address bar';
});

async function start() {
  const bytes = await (await fetch('looproot.wasm')).arrayBuffer();
  worker.postMessage({ module: bytes, gzipped: false }, [bytes]);
  const [own] = await Promise.all([linked(), library(), ready]);
  if (own) await take(...own);
  else await take('general_16real.toml', entries.get('arm/general_16real.toml') ?? '');
  document.documentElement.dataset.ready = 'true';
}
start().catch((error) => say(`The solver does not start: ${error.message}`, 'wrong'));
