// A headless Chromium, steered through its debugging pipe: pages are opened, looked at and measured without any package.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** Starts a browser; `null` where there is none. */
export async function browser(program = process.env.LOOPROOT_BROWSER || 'chromium') {
  const profile = mkdtempSync(join(tmpdir(), 'looproot-browser-'));
  const flags = [
    '--headless', '--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--hide-scrollbars',
    '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run', '--disable-quic',
    `--user-data-dir=${profile}`, '--remote-debugging-pipe', '--window-size=1400,900', 'about:blank',
  ];
  const child = spawn(program, flags, { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
  const started = await new Promise((resolve) => { child.on('error', () => resolve(false)); child.on('spawn', () => resolve(true)); });
  if (!started) { rmSync(profile, { recursive: true, force: true }); return null; }
  const [to, from] = [child.stdio[3], child.stdio[4]];
  const waiting = new Map();
  const listeners = [];
  let [count, left] = [0, ''];
  from.setEncoding('utf8');
  from.on('data', (text) => {
    const parts = (left + text).split('\0');
    left = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) {
        const { resolve, reject } = waiting.get(message.id);
        waiting.delete(message.id);
        if (message.error) reject(new Error(message.error.message)); else resolve(message.result);
      } else listeners.forEach((listener) => listener(message));
    }
  });
  const send = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
    const id = ++count;
    waiting.set(id, { resolve, reject });
    to.write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
  });

  /** Opens a page, with what it says on its console and what it asks the network for. */
  async function open(address, { width = 1400, height = 900 } = {}) {
    const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
    const page = { console: [], requests: [] };
    listeners.push(({ method, params, sessionId: own }) => {
      if (own !== sessionId) return;
      if (method === 'Runtime.consoleAPICalled') page.console.push(params.args.map((arg) => arg.value ?? arg.description).join(' '));
      if (method === 'Runtime.exceptionThrown') page.console.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
      if (method === 'Log.entryAdded') page.console.push(params.entry.text);
      if (method === 'Network.requestWillBeSent') page.requests.push(params.request.url);
    });
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await send(`${domain}.enable`, {}, sessionId);
    await send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false }, sessionId);
    await send('Page.navigate', { url: address }, sessionId);
    /** The value of an expression, or of the promise that it is. */
    page.value = async (expression) => {
      const { result, exceptionDetails } = await send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true }, sessionId);
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
      return result.value;
    };
    /** Waits until an expression holds. */
    page.until = async (expression, seconds = 60) => {
      const end = performance.now() + 1000 * seconds;
      while (performance.now() < end) {
        if (await page.value(expression).catch(() => false)) return;
        await new Promise((resolve) => { setTimeout(resolve, 25); });
      }
      throw new Error(`after ${seconds} s this does not hold: ${expression}; console: ${page.console.join(' | ')}`);
    };
    /** A mouse event: mouseMoved, mousePressed or mouseReleased, with the left button or none. */
    page.mouse = (type, x, y, button = 'none') => send(
      'Input.dispatchMouseEvent', { type, x, y, button, buttons: button === 'left' ? 1 : 0, clickCount: 1 }, sessionId);
    page.picture = async (path) => {
      const { data } = await send('Page.captureScreenshot', { format: 'png' }, sessionId);
      writeFileSync(path, Buffer.from(data, 'base64'));
    };
    page.close = () => send('Target.closeTarget', { targetId });
    return page;
  }

  async function close() {
    await send('Browser.close').catch(() => {});
    await new Promise((resolve) => { if (child.exitCode === null) child.on('exit', resolve); else resolve(); });
    rmSync(profile, { recursive: true, force: true });
  }
  return { open, close };
}
