// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Voxel tilesets of a field linear in x, y and z, with voids, drawn by CesiumJS in headless Chromium, whose shader
// compares each pixel's value with its place; and their tiles in the Khronos validator.
//
// CesiumJS calls a tile that is left out a failed one.
//
//   check_tiles.mjs --modules NODE_MODULES --viewers NODE_MODULES --terratet PROGRAM [--picture FOLDER]
import { execFileSync, spawn } from 'node:child_process';
import { mkdtemp, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const { values: options } = parseArgs({
  options: { modules: { type: 'string' }, viewers: { type: 'string' }, terratet: { type: 'string' }, picture: { type: 'string' } },
});
const here = path.dirname(fileURLToPath(import.meta.url));
const folder = await mkdtemp(path.join(tmpdir(), 'terratet-tiles-'));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.css': 'text/css' };
const problems = [];

const size = [140, 72, 48];
const [origin, step] = [[400005, 6700005, -400], [10, 10, 10]];
const value = (x, y, z) => x - 400700 + 2 * (y - 6700360) + 5 * (z + 165);
const isVoid = (i, j, k) => i >= 48 && i < 96 && j < 40 && k >= 24;

/** Blocks without a value are not in the table. */
function table() {
  const rows = ['X;Y;Z;value;half;rock'];
  for (let k = 0; k < size[2]; k++) {
    for (let j = 0; j < size[1]; j++) {
      for (let i = 0; i < size[0]; i++) {
        const at = [i, j, k].map((n, a) => origin[a] + step[a] * n);
        if (!isVoid(i, j, k)) rows.push(`${at.join(';')};${value(...at)};${value(...at) / 2};${k < 24 ? 'clay' : 'sand'}`);
      }
    }
  }
  return rows.join('\n');
}

let result = null;
let report;
const server = createServer(async (request, response) => {
  if (request.method === 'POST') {
    let body = '';
    for await (const chunk of request) body += chunk;
    result = JSON.parse(body);
    response.end();
    report();
    return;
  }
  const url = new URL(request.url, 'http://localhost').pathname;
  const name = url === '/' ? path.join(here, 'tiles.html')
    : path.join(url.startsWith('/modules/') ? options.viewers : folder,
                path.normalize(url.replace('/modules', '').replace('/data', '')));
  try {
    const bytes = await readFile(name);
    response.writeHead(200, { 'content-type': types[path.extname(name)] ?? 'application/octet-stream' });
    response.end(bytes);
  } catch {
    response.writeHead(404);
    response.end();
  }
});

async function draw(name, job, least) {
  const profile = await mkdtemp(path.join(tmpdir(), 'terratet-chromium-'));
  result = null;
  const reported = new Promise((resolve) => { report = resolve; });
  const browser = spawn(process.env.CHROMIUM || 'chromium', [
    '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--hide-scrollbars', '--disable-dev-shm-usage', `--user-data-dir=${profile}`,
    '--window-size=800,640', '--remote-debugging-port=0',
    `http://127.0.0.1:${server.address().port}/?job=${encodeURIComponent(JSON.stringify(job))}`,
  ], { stdio: 'ignore' });
  const gone = new Promise((resolve) => { browser.on('exit', resolve); });
  let timer;
  await Promise.race([reported, gone, new Promise((resolve) => { timer = setTimeout(resolve, 170000); })]);
  clearTimeout(timer);
  browser.kill();
  await gone;
  await rm(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  console.log(name, JSON.stringify({ ...result, picture: undefined }));
  if (options.picture && result) {
    await writeFile(path.join(options.picture, `${name}.png`), Buffer.from(result.picture.split(',')[1], 'base64'));
  }
  if (!result || result.log.length || result.pixels.red || !(result.pixels.green > least)) {
    problems.push(`${name}: not all pixels are right`);
  }
}

async function validate(tiles) {
  const validator = createRequire(path.resolve(options.modules) + '/')('gltf-validator');
  const names = await readdir(tiles);
  for (const name of names) {
    const { issues } = await validator.validateBytes(new Uint8Array(await readFile(path.join(tiles, name))));
    const codes = new Set(issues.messages.filter(({ severity }) => severity < 2).map(({ code }) => code));
    const known = ['MESH_PRIMITIVE_NO_POSITION', 'VALUE_NOT_IN_RANGE'];
    if ([...codes].sort().join() !== known.join()) problems.push(`${name}: ${[...codes]}`);
  }
  console.log(`${names.length} tiles of ${tiles} validated`);
}

try {
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  await writeFile(path.join(folder, 'table.csv'), table());
  execFileSync(options.terratet, ['export', '--voxels', 'table.csv,srs=EPSG:3067', 't.json', '-q'], { cwd: folder });
  const { root, extras } = JSON.parse(await readFile(path.join(folder, 't.json')));
  const { box } = root.boundingVolume;
  const { dimensions } = root.content.extensions['3DTILES_content_voxels'];
  const levels = root.implicitTiling.availableLevels;
  if (levels !== 3) problems.push(`${levels} levels`);
  // Metres along the box's axes to map coordinates from the grid's middle.
  const scale = [0, 1, 2].map((a) => (dimensions[a] * 2 ** (levels - 1) * extras.spacing[a]) / (2 * box[3 + 4 * a]));
  const middle = [0, 1, 2].map((a) => extras.origin[a] + ((size[a] - 1) / 2) * step[a]);
  const glsl = (x) => (Number.isInteger(x) ? x.toFixed(1) : String(x));
  const truth = `(${glsl(value(...middle))} + q.x * ${glsl(scale[0])} + 2.0 * q.y * ${glsl(scale[1])} + 5.0 * q.z * ${glsl(scale[2])})`;
  const view = { look: [0, 0, 0], heading: 0.5, pitch: -0.6, distance: 1700, error: 1, nearest: false,
                 alpha: 'step(0.5, fsInput.metadata.mask)' };
  const right = `abs(fsInput.metadata.value - ${truth}) < 2.0 && abs(2.0 * fsInput.metadata.p_half - ${truth}) < 2.0`;
  await draw('linear', { ...view, tileset: '/data/t.json', right }, 20000);
  const rock = `abs(fsInput.metadata.rock * 255.0 - (q.z > 0.0 ? ROCK)) < 0.1 || abs(q.z) < 1.0`;
  await draw('category', { ...view, tileset: '/data/t/rock/tileset.json', nearest: true,
                           right: rock.replace('ROCK', '1.0 : 0.0') }, 20000);
  await validate(path.join(folder, 't', 'content'));
} finally {
  server.close();
  await rm(folder, { recursive: true, force: true });
}
for (const problem of problems) console.log(problem);
process.exit(problems.length ? 1 : 0);
