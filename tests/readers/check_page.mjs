// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Opens a scene page from disk in headless Chromium with the network off, works with it as a person does, and prints what
// it saw as JSON:
//
//   check_page.mjs PAGE.html PICTURE.png WORK
//
// WORK is JSON: {picks: [[x, y, z], …], cut: VALUE, property: NAME, hole: ID, controls: true}, each optional. Fails when
// the page asks for anything, says anything on the console, or does not come up.
import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { writeFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { chromium, flags, newProfile, removeProfile } from './browser.mjs';

const [page, picture, work] = [process.argv[2], process.argv[3], JSON.parse(process.argv[4] ?? '{}')];
const profile = await newProfile();
const browser = spawn(chromium, [...flags(profile, '1400,900'), '--remote-debugging-pipe', 'about:blank'],
                      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });

/** The debugging protocol over pipes: JSON messages, each ended by a zero byte. */
let next = 1;
let buffer = '';
const waiting = new Map();
const events = [];
browser.stdio[4].setEncoding('utf8');
browser.stdio[4].on('data', (chunk) => {
  const parts = (buffer + chunk).split('\0');
  buffer = parts.pop();
  for (const message of parts.map((part) => JSON.parse(part))) {
    if (message.id) {
      const { resolve, reject } = waiting.get(message.id);
      waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message));
      else resolve(message.result);
    } else events.push(message);
  }
});
const call = (method, params = {}, sessionId = session) => new Promise((resolve, reject) => {
  waiting.set(next, { resolve, reject });
  browser.stdio[3].write(`${JSON.stringify({ id: next++, method, params, sessionId })}\0`);
});
let session;
const run = async (expression) => {
  const { result, exceptionDetails } = await call('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
  if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
  return result.value;
};
const settle = () => run('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))');
const text = (selector) => run(`document.querySelector(${JSON.stringify(selector)})?.innerText ?? null`);
const mouse = (type, x, y, buttons) => call('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons, clickCount: 1 });

async function state(changes) {
  const before = await run('location.hash');
  const keys = new URLSearchParams(before.slice(1));
  for (const [key, value] of Object.entries(changes)) keys.set(key, value);
  const hash = [...keys].map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll('%2C', ',')}`).join('&');
  await run(`new Promise((done) => { addEventListener('hashchange', () => setTimeout(() => done(true), 0), { once: true }); location.hash = ${JSON.stringify(hash)}; if (location.hash === ${JSON.stringify(before)}) done(true); })`);
  await settle();
}

/** Drags the orange handle of the section that has one nearest to the picture's middle, and times it. */
async function drag() {
  const at = await run(`(() => {
    const canvas = document.getElementById('view');
    const rect = canvas.getBoundingClientRect();
    const [width, height] = [Math.round(rect.width), Math.round(rect.height)];
    canvas.dispatchEvent(new KeyboardEvent('keydown', { key: '0', bubbles: true }));  // draws: then its pixels can be read
    const flat = Object.assign(document.createElement('canvas'), { width, height });
    return new Promise((done) => requestAnimationFrame(() => {
      const context = flat.getContext('2d');
      context.drawImage(canvas, 0, 0, width, height);
      const { data } = context.getImageData(0, 0, width, height);
      let best = null;
      for (let i = 0; i < data.length; i += 4) {
        const away = Math.abs(data[i] - 232) + Math.abs(data[i + 1] - 87) + Math.abs(data[i + 2] - 42);
        if (data[i + 3] > 250 && away < 40 && (!best || away < best.away)) best = { away, i: i / 4 };
      }
      done(best && { x: rect.left + (best.i % width + 0.5) * rect.width / width, y: rect.top + (Math.floor(best.i / width) + 0.5) * rect.height / height });
    }));
  })()`);
  if (!at) return null;
  const values = () => run(`['ew', 'ns', 'level'].map((key) => Number(document.querySelector('[data-key="' + key + '"]').value))`);
  const before = await values();
  await mouse('mousePressed', at.x, at.y, 1);
  const start = performance.now();
  const frames = 60;
  for (let i = 1; i <= frames; ++i) {
    await mouse('mouseMoved', at.x - 1.5 * i, at.y + 0.5 * i, 1);
    await settle();
  }
  const seconds = (performance.now() - start) / 1000;
  await mouse('mouseReleased', at.x - 1.5 * frames, at.y + 0.5 * frames, 0);
  return { frames, seconds, before, after: await values() };
}

/** Uses each control once: what it changed, of picture, address and page. One that changes nothing is dead. */
async function controls() {
  const look = async () => {
    await settle();
    const { data } = await call('Page.captureScreenshot', { format: 'png' });
    return { picture: createHash('sha256').update(data).digest('hex'), address: await run('location.hash'),
             page: await run("document.body.outerHTML.replace(/<canvas[^>]*>/g, '')") };
  };
  // What hides or turns the rest comes last.
  const count = await run("(window.controls = [...document.querySelectorAll('input, select'), ...[...document.querySelectorAll('button')].reverse()]).length");
  const used = [];
  let before = await look();
  for (let i = 0; i < count; ++i) {
    const name = await run(`(() => {
      const c = window.controls[${i}];
      const label = c.dataset.key || c.id || c.title || c.getAttribute('aria-label') || c.textContent || c.closest('label')?.innerText || c.outerHTML;
      return c.tagName.toLowerCase() + (c.type ? ':' + c.type : '') + ' ' + label.trim().replace(/\\s+/g, ' ').slice(0, 60);
    })()`);
    const visible = await run(`(() => { const c = window.controls[${i}]; return c.isConnected && !c.disabled && c.offsetParent !== null; })()`);
    if (!visible) { used.push({ name, visible }); continue; }
    await run(`(() => {
      const c = window.controls[${i}];
      const tell = () => { for (const type of ['input', 'change']) c.dispatchEvent(new Event(type, { bubbles: true })); };
      if (c.tagName === 'BUTTON' || c.type === 'checkbox' || c.type === 'radio') return c.click();
      if (c.tagName === 'SELECT') c.selectedIndex = (c.selectedIndex + 1) % c.options.length;
      else if (c.type === 'range') c.value = Number(c.min) + 0.3 * (Number(c.max) - Number(c.min));
      else if (c.type === 'color') c.value = '#ff0000';
      else c.value = c.type === 'number' ? Number(c.value || c.min || 0) + Number(c.step > 0 ? c.step : 1) : '1';
      tell();
    })()`);
    const after = await look();
    used.push({ name, visible, changed: Object.keys(before).filter((key) => before[key] !== after[key]) });
    before = after;
    if (/measure|help/.test(name)) {
      await run(`window.controls[${i}].click()`);
      before = await look();
    }
  }
  return used;
}

const seen = {};
let failed = '';
try {
  const { targetInfos } = await call('Target.getTargets', {}, undefined);
  const target = targetInfos.find(({ type }) => type === 'page');
  ({ sessionId: session } = await call('Target.attachToTarget', { targetId: target.targetId, flatten: true }, undefined));
  for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await call(`${domain}.enable`);
  await call('Network.emulateNetworkConditions', { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 });
  const url = pathToFileURL(path.resolve(page)).href;
  const began = performance.now();
  await call('Page.navigate', { url });
  for (let tries = 0; !(seen.ready = await run('document.body?.dataset.ready ?? ""')) && tries < 600; ++tries) {
    await new Promise((done) => setTimeout(done, 50));
  }
  seen.first_view_seconds = (performance.now() - began) / 1000;
  if (seen.ready !== 'live') throw new Error(`the page is ${seen.ready || 'not ready'}: ${await text('#where')}`);
  await settle();
  seen.legend = await text('.legend');
  seen.crs = await text('.crs');
  seen.honesty = await text('#honesty');
  seen.holes = await run('[...document.querySelectorAll("#holes li")].map((item) => item.textContent)');
  const { data } = await call('Page.captureScreenshot', { format: 'png' });
  await writeFile(picture, Buffer.from(data, 'base64'));
  seen.drag = await drag();
  seen.picks = [];
  for (const place of work.picks ?? []) {
    await state({ pick: place.join(',') });
    seen.picks.push(await run('Object.fromEntries([...document.querySelectorAll("#picked dt")].map((term) => [term.textContent, term.nextElementSibling.textContent]))'));
  }
  if (work.cut !== undefined) {
    await run(`(() => { const input = document.querySelector('input[data-key="cut"]'); input.value = ${work.cut}; input.dispatchEvent(new Event('change')); })()`);
    await settle();
    seen.volume = await run('({ text: document.getElementById("volume").textContent, value: Number(document.getElementById("volume").dataset.volume) })');
  }
  if (work.hole) {
    await run(`[...document.querySelectorAll('#hole-list button')].find((button) => button.textContent === ${JSON.stringify(work.hole)}).click()`);
    await settle();
    seen.strip = await text('#strip');
    seen.strip_intervals = await run('document.querySelectorAll("#strip svg rect").length');
  }
  if (work.property) {
    await run(`(() => { const select = document.querySelector('select[data-key="p"]'); select.value = ${JSON.stringify(work.property)}; select.dispatchEvent(new Event('change')); })()`);
    await settle();
    seen.property_legend = await text('.legend');
  }
  if (work.controls) seen.controls = await controls();
  for (const key of ['e', 'i', 'f', 'b', '1', '2', '3', '0', 'ArrowRight', 'l', '?', 'Escape']) await run(`document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', { key: ${JSON.stringify(key)}, bubbles: true }))`);
  await settle();
  const last = await call('Page.captureScreenshot', { format: 'png' });
  await writeFile(picture.replace(/\.png$/, '-after.png'), Buffer.from(last.data, 'base64'));
  seen.requests = events.filter(({ method, params }) => method === 'Network.requestWillBeSent' && !/^(data|blob):/.test(params.request.url))
    .map(({ params }) => params.request.url).filter((asked) => asked !== url);
  seen.console = events.filter(({ method }) => ['Runtime.consoleAPICalled', 'Runtime.exceptionThrown', 'Log.entryAdded'].includes(method))
    .map(({ params }) => JSON.stringify(params).slice(0, 300));
} catch (error) {
  failed = String(error.stack ?? error);
} finally {
  browser.kill();
  await new Promise((done) => { browser.on('exit', done); setTimeout(done, 3000); });
  await removeProfile(profile);
}
console.log(JSON.stringify(seen, null, 1));
if (failed || seen.requests.length || seen.console.length) {
  console.error(failed || 'the page asked for something, or spoke on the console');
  process.exit(1);
}
