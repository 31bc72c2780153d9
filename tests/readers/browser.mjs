// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Headless Chromium for the checks here, and the server of what its pages ask for.
import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';

export const chromium = process.env.CHROMIUM || 'chromium';
export const newProfile = () => mkdtemp(path.join(tmpdir(), 'terratet-chromium-'));
export const removeProfile = (profile) => rm(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });

/** With WebGL by SwiftShader, and without requests of its own. */
export const flags = (profile, size) => [
  '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
  '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--hide-scrollbars',
  '--disable-dev-shm-usage', `--user-data-dir=${profile}`, `--window-size=${size}`,
];

const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm',
                '.css': 'text/css', '.glb': 'model/gltf-binary', '.gltf': 'model/gltf+json' };

/** A file under `/modules/`, if the URL's path is one. */
export const ofModules = (url, modules) =>
  url.startsWith('/modules/') ? path.join(modules, path.normalize(url.slice('/modules'.length))) : null;

/**
 * Serves on this machine what `fileOf` makes of a URL's path: a file, or null. What a page POSTs, as JSON, is what it found.
 * `missing` lists what was asked for and is not there.
 */
export async function serve(fileOf) {
  const served = { found: null, missing: [], reported: null };
  let report;
  served.reported = new Promise((resolve) => { report = resolve; });
  const server = createServer(async (request, response) => {
    if (request.method === 'POST') {
      let body = '';
      for await (const chunk of request) body += chunk;
      served.found = JSON.parse(body);
      response.end();
      report();
      return;
    }
    const url = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    const file = fileOf(url);
    try {
      const bytes = await readFile(file);
      response.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' });
      response.end(bytes);
    } catch {
      if (url !== '/favicon.ico') served.missing.push(url);
      response.writeHead(404);
      response.end();
    }
  });
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  served.address = `http://127.0.0.1:${server.address().port}/`;
  served.close = () => {
    server.close();
    server.closeAllConnections();
  };
  return served;
}

/** Shows a page until it has reported, or for so many milliseconds. */
export async function show(fileOf, query, size, limit) {
  const served = await serve(fileOf);
  const profile = await newProfile();
  const browser = spawn(chromium, [...flags(profile, size), '--remote-debugging-port=0', `${served.address}?${query}`],
                        { stdio: 'ignore' });
  const gone = new Promise((resolve) => { browser.on('exit', resolve); });
  let timer;
  await Promise.race([served.reported, gone, new Promise((resolve) => { timer = setTimeout(resolve, limit); })]);
  clearTimeout(timer);
  browser.kill();
  await gone;
  served.close();
  await removeProfile(profile);
  return served;
}
