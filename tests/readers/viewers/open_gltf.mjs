// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Opens a glTF file with a viewer in headless Chromium, keeps a picture, and prints what the viewer reports as JSON:
//
//   open_gltf.mjs --modules NODE_MODULES --page cesium|model_viewer [--size X,Y,Z] FILE PICTURE.png
//
// Fails when the viewer reports an error or nothing, asks for anything that is not here, or finds another size.
import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const { values: options, positionals: [file, picture] } = parseArgs({
  allowPositionals: true,
  options: { modules: { type: 'string' }, page: { type: 'string' }, size: { type: 'string' } },
});
const here = path.dirname(fileURLToPath(import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm',
                '.css': 'text/css', '.glb': 'model/gltf-binary', '.gltf': 'model/gltf+json' };
const missing = [];
let found = null;
let reported;
const report = new Promise((resolve) => { reported = resolve; });

const server = createServer(async (request, response) => {
  if (request.method === 'POST') {
    let body = '';
    for await (const chunk of request) body += chunk;
    found = JSON.parse(body);
    response.end();
    reported();
    return;
  }
  const name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
  const local = name === '/' ? path.join(here, `${options.page}.html`)
    : name === '/report.js' ? path.join(here, 'report.js') : name.startsWith('/scene') ? file
    : name.startsWith('/modules/') ? path.join(options.modules, path.normalize(name.slice('/modules'.length))) : '';
  try {
    const bytes = await readFile(local);
    response.writeHead(200, { 'content-type': types[path.extname(local)] ?? 'application/octet-stream' });
    response.end(bytes);
  } catch {
    if (name !== '/favicon.ico') missing.push(name);
    response.writeHead(404);
    response.end();
  }
});
await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });

const profile = await mkdtemp(path.join(tmpdir(), 'terratet-chromium-'));
const browser = spawn(process.env.CHROMIUM || 'chromium', [
  '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
  '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--disable-dev-shm-usage', `--user-data-dir=${profile}`, '--window-size=1200,900', '--remote-debugging-port=0',
  `http://127.0.0.1:${server.address().port}/?scene=/scene${path.extname(file)}`], { stdio: 'ignore' });
const gone = new Promise((resolve) => { browser.on('exit', resolve); });
await Promise.race([report, gone, new Promise((resolve) => { setTimeout(resolve, 400000); })]);
browser.kill();
await gone;
server.close();
server.closeAllConnections();
await rm(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });

const { picture: drawn, ...told } = found ?? {};
if (drawn) await writeFile(picture, Buffer.from(drawn.split(',')[1], 'base64'));
const problems = missing.map((name) => `asked for ${name}`);
if (!found) problems.push('the viewer did not report');
else if (found.error) problems.push(found.error);
else if (options.size) {
  const wanted = options.size.split(',').map(Number);
  if (!found.size || wanted.some((length, k) => Math.abs(length - found.size[k]) > 0.01 * length)) {
    problems.push(`it is ${found.size}, not ${wanted}`);
  }
}
if (!(told.drawn > 0.02)) problems.push(`${100 * (told.drawn ?? 0)} % of the picture is drawn`);
console.log(JSON.stringify(told));
for (const problem of problems) console.error(`${file}: ${problem}`);
process.exit(problems.length ? 1 : 0);
