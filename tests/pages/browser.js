'use strict';
// A headless Chromium, spoken to over a pipe with its DevTools protocol: no port, no library.

const { spawn } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

const DEADLINE_MS = 60_000;

/** Messages are JSON, each ended by a zero byte. */
class Pipe {
  #toBrowser;
  #rest = '';

  constructor(process, receive) {
    this.#toBrowser = process.stdio[3];
    process.stdio[4].setEncoding('utf8').on('data', (text) => {
      const messages = (this.#rest + text).split('\0');
      this.#rest = messages.pop();
      messages.forEach((message) => receive(JSON.parse(message)));
    });
  }

  send(message) {
    this.#toBrowser.write(`${JSON.stringify(message)}\0`);
  }
}

class Browser {
  #process;
  #pipe;
  #folder = fs.mkdtempSync(path.join(os.tmpdir(), 'gonio_pages_'));
  #calls = new Map();
  #nextId = 1;
  #listeners = new Set();

  constructor() {
    // A container may have no user of its own and little shared memory.
    const options = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
      '--no-first-run', '--disable-background-networking', '--disable-component-update',
      '--remote-debugging-pipe', `--user-data-dir=${this.#folder}`];
    this.#process = spawn(process.env.CHROMIUM ?? 'chromium', options,
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true });
    this.#process.on('error', (error) => this.#failAll(error));
    this.#process.on('exit', () => this.#failAll(new Error('chromium has ended')));
    this.#pipe = new Pipe(this.#process, (message) => this.#receive(message));
  }

  #failAll(error) {
    this.#calls.forEach(({ reject }) => reject(error));
    this.#calls.clear();
  }

  #receive(message) {
    if (message.id === undefined) {
      this.#listeners.forEach((listener) => listener(message));
      return;
    }
    const { resolve, reject } = this.#calls.get(message.id);
    this.#calls.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  }

  /** Calls a method of the protocol. @return  a promise of its result. */
  call(method, params = {}, sessionId = undefined) {
    const id = this.#nextId++;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`${method}: no answer`)), DEADLINE_MS);
      const settled = (settle) => (value) => { clearTimeout(timer); settle(value); };
      this.#calls.set(id, { resolve: settled(resolve), reject: settled(reject) });
      this.#pipe.send({ id, method, params, sessionId });
    });
  }

  listen(listener) { this.#listeners.add(listener); }
  forget(listener) { this.#listeners.delete(listener); }

  /** Opens an empty tab. */
  async newPage() {
    const { targetId } = await this.call('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.call('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, sessionId);
    await page.call('Page.enable');
    await page.call('Runtime.enable');
    await page.call('Log.enable');
    await page.call('Network.enable');
    return page;
  }

  /** Ends the browser with its helpers, which are a process group, and removes its folder. */
  async close() {
    const ended = new Promise((resolve) => { this.#process.once('exit', resolve); });
    await this.call('Browser.close').catch(() => {});
    const timer = setTimeout(() => process.kill(-this.#process.pid, 'SIGKILL'), DEADLINE_MS);
    if (this.#process.exitCode === null && this.#process.signalCode === null) await ended;
    clearTimeout(timer);
    fs.rmSync(this.#folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

/** A tab, and what it complained of and asked for since it was opened. */
class Page {
  #browser;
  #session;
  complaints = [];
  requests = [];

  constructor(browser, session) {
    this.#browser = browser;
    this.#session = session;
    browser.listen((message) => this.#note(message));
  }

  #note({ method, params, sessionId }) {
    if (sessionId !== this.#session) return;
    if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled') this.complaints.push(`console.${params.type}`);
    if (method === 'Log.entryAdded') this.complaints.push(params.entry.text);
    if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
  }

  call(method, params = {}) { return this.#browser.call(method, params, this.#session); }

  /** Opens a file and waits until it is loaded. */
  async open(file) {
    const loaded = new Promise((resolve) => {
      const listener = ({ method, sessionId }) => {
        if (method !== 'Page.loadEventFired' || sessionId !== this.#session) return;
        this.#browser.forget(listener);
        resolve();
      };
      this.#browser.listen(listener);
    });
    const { errorText } = await this.call('Page.navigate', { url: `file://${path.resolve(file)}` });
    if (errorText) throw new Error(`${file}: ${errorText}`);
    await loaded;
  }

  /** The value of a function's call inside the page. */
  async evaluate(func, ...values) {
    const expression = `(${func})(${values.map((value) => JSON.stringify(value)).join(', ')})`;
    const { result, exceptionDetails } = await this.call('Runtime.evaluate',
      { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description);
    return result.value;
  }
}

module.exports = { Browser };
