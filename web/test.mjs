// Live pages and the page of web/ in a browser: node --test web/test.mjs, after web/build. LOOPROOT names the native program, SHOTS a
// folder for pictures of what is seen.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { browser } from './browse.mjs';

const root = new URL('..', import.meta.url).pathname;
const target = process.env.CARGO_TARGET_DIR || join(root, 'target');
const native = process.env.LOOPROOT || ['release', 'debug'].map((kind) => join(target, kind, 'looproot')).find(existsSync);
const site = join(target, 'browser');
const folder = mkdtempSync(join(tmpdir(), 'looproot-web-'));
const shots = process.env.SHOTS;
let chromium = null;

before(async () => { chromium = await browser(); });
after(async () => { await chromium?.close(); rmSync(folder, { recursive: true, force: true }); });

function looproot(...args) {
  const { status, stdout, stderr } = spawnSync(native, args, { encoding: 'utf8', maxBuffer: 1 << 28 });
  assert.ok([0, 2, 3].includes(status), `${args.join(' ')}: ${status} ${stderr}`);
  return stdout;
}

/** Takes what is asked in the figure and drags it: the controls follow, and an answer comes. */
async function drag(page, name) {
  const box = await page.value("(() => { const b = document.querySelector('#canvas').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()");
  const asked = "[...document.querySelectorAll('#controls input')].map((range) => Number(range.value))";
  const held = async () => {
    for (let k = 0; k < 900; k += 1) {
      const [x, y] = [box[0] + (box[2] * (0.5 + (k % 30))) / 30, box[1] + (box[3] * (0.5 + Math.floor(k / 30))) / 30];
      await page.mouse('mouseMoved', x, y);
      if (await page.value("document.querySelector('#canvas').style.cursor === 'move'")) return [x, y];
    }
    throw new Error(`${name}: nothing in the figure can be dragged`);
  };
  const [x, y] = await held();
  const [before, answer] = [await page.value(asked), await page.value('document.documentElement.dataset.answer')];
  await page.mouse('mousePressed', x, y, 'left');
  for (let k = 1; k <= 4; k += 1) await page.mouse('mouseMoved', x + 2 * k, y - k, 'left');
  await page.mouse('mouseReleased', x + 8, y - 4, 'left');
  await page.until(`document.documentElement.dataset.answer !== '${answer}'`);
  const after = await page.value(asked);
  assert.ok(after.some((value, k) => value !== before[k]), `${name}: ${before} stay`);
}

/** Moves a slider, and waits for the answer. */
const MOVE = `(async (k, value) => {
  const root = document.documentElement;
  const before = root.dataset.answer;
  const range = document.querySelectorAll('input[type=range]')[k];
  range.value = value;
  const start = performance.now();
  range.dispatchEvent(new Event('input', { bubbles: true }));
  while (root.dataset.answer === before) await new Promise((resolve) => setTimeout(resolve, 1));
  return performance.now() - start;
})`;
const ROWS = "document.querySelectorAll('table tbody tr').length";

for (const [name, verb] of [['arm/general_16real', 'an arm'], ['loop/rrsrr', 'a loop'], ['platform/dietmaier_40real', 'a platform'],
  ['platform/hexapod', 'a hexapod with plane plates']]) {
  test(`a live page solves ${verb} anew`, { timeout: 120_000 }, async (t) => {
    if (!chromium) { t.skip('no browser'); return; }
    const path = join(folder, `${name.replace('/', '-')}.html`);
    looproot('view', name, '--live', '-o', path);
    const bytes = statSync(path).size;
    assert.ok(bytes < 6_000_000, `${bytes} bytes`);
    const page = await chromium.open(pathToFileURL(path).href);
    await page.until("document.documentElement.dataset.live === 'true'");
    const begin = await page.value('performance.now()');
    // A person looks at the page first; meanwhile the solver is rehearsed, so that the browser has compiled it well.
    await new Promise((resolve) => { setTimeout(resolve, 3000); });
    const rows = await page.value(ROWS);
    const limits = await page.value("[...document.querySelectorAll('input[type=range]')].map((r) => [Number(r.min), Number(r.max), Number(r.value)])");
    assert.ok(limits.length === (name.startsWith('loop') ? 2 : 7), 'a slider for every number, and that of families');
    const first = await page.value(`${MOVE}(0, ${limits[0][2] + 0.002 * (limits[0][1] - limits[0][0])})`);
    t.diagnostic(`${name}: ${bytes} bytes, ready after ${begin.toFixed(0)} ms, first answer ${first.toFixed(0)} ms`);
    assert.ok(rows > 0 && (await page.value(ROWS)) > 0);
    const asked = [];
    for (let k = 0; k < 40; k += 1) {
      await page.value(`${MOVE}(0, ${limits[0][2] + 0.0005 * (k % 10) * (limits[0][1] - limits[0][0])})`);
      asked.push(Number.parseFloat(await page.value("document.querySelector('#time').textContent")));
    }
    asked.sort((a, b) => a - b);
    t.diagnostic(`${name}: ${asked[20]} ms an answer (median of 40; least ${asked[0]})`);
    // The least, since the machine may be busy with more than this.
    // 12 ms on two quiet cores; other machines are slower, and busy.
    assert.ok(asked[0] <= 30, `${asked[0]} ms an answer`);
    // What is shown is what the native program answers to the same question.
    const question = await page.value("(() => { const l = JSON.parse(document.querySelector('#live').textContent); return l.argument; })()");
    const values = await page.value("[...document.querySelectorAll('#controls label output')].map((o) => parseFloat(o.textContent.replace('\\u2212', '-')))");
    const argument = question.replace(/\{(\d)\}/g, (_, k) => values[k]);
    const code = spawnSync(native, ['solve', name, argument, '--json', '--seed', '1'], { encoding: 'utf8', maxBuffer: 1 << 28 });
    const result = JSON.parse(code.stdout).results[0];
    assert.equal(await page.value(ROWS), result.modes.length);
    assert.equal(await page.value('document.documentElement.dataset.code'), String(code.status));
    await drag(page, name);
    assert.deepEqual(page.console, []);
    assert.equal(page.requests.filter((url) => !/^(data|blob|about):/.test(url)).length, 1, page.requests.join(' '));
    if (shots) await page.picture(join(shots, `${name.replace('/', '-')}.png`));
    await page.close();
  });
}

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.txt': 'text/plain' };

test('the page of web/ solves what is typed, chosen, dropped and linked', { timeout: 120_000 }, async (t) => {
  if (!chromium) { t.skip('no browser'); return; }
  const server = createServer((request, response) => {
    const path = join(site, request.url === '/' ? 'index.html' : request.url.split('?')[0]);
    if (!existsSync(path)) { response.writeHead(404).end(); return; }
    response.writeHead(200, { 'content-type': TYPES[extname(path)] || 'application/octet-stream' }).end(readFileSync(path));
  });
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  const address = `http://127.0.0.1:${server.address().port}/`;
  try {
    const page = await chromium.open(address);
    await page.until("document.documentElement.dataset.ready === 'true'");
    assert.match(await page.value("document.querySelector('#verdict').textContent"), /16/);
    assert.ok((await page.value("document.querySelectorAll('#library option').length")) > 200);
    if (shots) { await new Promise((resolve) => { setTimeout(resolve, 2500); }); await page.picture(join(shots, 'web.png')); }
    const answered = async (act) => {
      const before = await page.value('document.documentElement.dataset.answer');
      await page.value(`${act}; null`);
      await page.until(`document.documentElement.dataset.answer !== '${before}'`);
      return page.value("document.querySelector('#verdict').textContent");
    };
    const choose = "(() => { const s = document.querySelector('#library'); s.value = 'platform/dietmaier_40real.toml'; s.dispatchEvent(new Event('change')); })()";
    assert.match(await answered(choose), /40/);
    const broken = "(() => { const e = document.querySelector('#editor'); e.value = e.value.replace('kind', 'kin'); e.dispatchEvent(new Event('input')); })()";
    assert.match(await answered(broken), /found/);
    const urdf = readFileSync(join(root, 'web/robot.urdf'), 'utf8');
      const drop = `(() => { const t = new DataTransfer(); t.items.add(new File([${JSON.stringify(urdf)}], 'robot.urdf'));
      window.dispatchEvent(new DragEvent('drop', { dataTransfer: t, bubbles: true, cancelable: true })); })()`;
    assert.match(await answered(drop), /solution|real/i);
    if (shots) { await new Promise((resolve) => { setTimeout(resolve, 2500); }); await page.picture(join(shots, 'web-urdf.png')); }
    await page.value("document.querySelector('#share').click()");
    await page.until('location.hash.length > 100');
    const link = await page.value('location.href');
    assert.ok(page.requests.every((url) => url.startsWith(address) || /^(data|blob|about):/.test(url)), page.requests.join(' '));
    assert.deepEqual(page.console, []);
    await page.close();
    const other = await chromium.open(link);
    await other.until("document.documentElement.dataset.ready === 'true'");
    assert.equal(await other.value("document.querySelector('#name').value"), 'robot.urdf');
    assert.equal(await other.value("document.querySelector('#editor').value"), urdf);
    await other.close();
  } finally {
    server.close();
  }
});
