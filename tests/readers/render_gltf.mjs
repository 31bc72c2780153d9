// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws a glTF file with three.js in headless Chromium and checks that something is to be seen.
//
//   render_gltf.mjs --modules NODE_MODULES [--node NAME]... FILE PICTURE.png
//
// Fails unless WebGL drew, a fair part of the picture is not background, and the named nodes (by the beginning of the
// name) are in three.js's scene with triangles, colours and values.
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';

const { values: options, positionals: [file, picture] } = parseArgs({
  allowPositionals: true,
  options: { modules: { type: 'string' }, node: { type: 'string', multiple: true, default: [] } },
});
const here = path.dirname(fileURLToPath(import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary', '.gltf': 'model/gltf+json' };

/** What the page found, or why it found nothing. */
let result = null;

function localFile(url) {
  if (url === '/') return path.join(here, 'view.html');
  if (url.startsWith('/scene')) return file;
  if (url.startsWith('/modules/')) return path.join(options.modules, path.normalize(url.slice('/modules'.length)));
  return null;
}

const server = createServer(async (request, response) => {
  if (request.method === 'POST') {
    let body = '';
    for await (const chunk of request) body += chunk;
    result = JSON.parse(body);
    response.end();
    return;
  }
  const name = localFile(new URL(request.url, 'http://localhost').pathname);
  try {
    const bytes = await readFile(name);
    response.writeHead(200, { 'content-type': types[path.extname(name)] ?? 'application/octet-stream' });
    response.end(bytes);
  } catch {
    response.writeHead(404);
    response.end();
  }
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

const profile = await mkdtemp(path.join(tmpdir(), 'terratet-chromium-'));
await rm(picture, { force: true });
try {
  await promisify(execFile)(process.env.CHROMIUM ?? 'chromium', [
    '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--hide-scrollbars', '--disable-dev-shm-usage', `--user-data-dir=${profile}`,
    '--window-size=1200,900', '--virtual-time-budget=20000', `--screenshot=${path.resolve(picture)}`,
    `http://127.0.0.1:${server.address().port}/?scene=/scene${path.extname(file)}`,
  ], { timeout: 120000 });
} finally {
  server.close();
  await rm(profile, { recursive: true, force: true });
}

const problems = [];
if (!result) {
  problems.push('the page did not report');
} else if (result.error) {
  problems.push(result.error);
} else {
  const { drawn, nodes } = result;
  if (drawn < 0.1) problems.push(`only ${(100 * drawn).toFixed(1)} % of the picture is drawn`);
  for (const wanted of options.node) {
    const node = nodes.find(({ name }) => name.startsWith(wanted));
    if (!node) problems.push(`no node '${wanted}' among ${nodes.map(({ name }) => name).join(', ')}`);
    else if (!(node.triangles > 0)) problems.push(`node '${wanted}' has no triangles`);
    else if (/^(section|borehole)/.test(wanted) && !node.colored) problems.push(`node '${wanted}' has no colours or values`);
  }
  console.log(`${file}: ${(100 * drawn).toFixed(1)} % drawn by ${result.renderer}; ` +
              nodes.map(({ name, triangles }) => `${name} (${triangles})`).join(', '));
}
if (!(await stat(picture).catch(() => null))?.size) problems.push('no screenshot');
for (const problem of problems) console.log(`${file}: ${problem}`);
process.exit(problems.length ? 1 : 0);
