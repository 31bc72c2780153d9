// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Voxel tilesets of a field linear in x, y and z, with voids, drawn by CesiumJS in headless Chromium, whose shader
// compares each pixel's value with its place; and their tiles in the Khronos validator.
//
// CesiumJS calls a tile that is left out a failed one.
//
//   check_tiles.mjs --modules NODE_MODULES --viewers NODE_MODULES --terratet PROGRAM [--picture FOLDER]
import { execFileSync } from 'node:child_process';
import { mkdtemp, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

import { ofModules, show } from './browser.mjs';

const { values: options } = parseArgs({
  options: { modules: { type: 'string' }, viewers: { type: 'string' }, terratet: { type: 'string' }, picture: { type: 'string' } },
});
const here = path.dirname(fileURLToPath(import.meta.url));
const folder = await mkdtemp(path.join(tmpdir(), 'terratet-tiles-'));
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

function fileOf(url) {
  if (url === '/') return path.join(here, 'tiles.html');
  return url.startsWith('/data/') ? path.join(folder, path.normalize(url.slice('/data'.length)))
    : ofModules(url, options.viewers);
}

async function draw(name, job, least) {
  const { found } = await show(fileOf, `job=${encodeURIComponent(JSON.stringify(job))}`, '800,640', 170000);
  const { picture, ...told } = found ?? {};
  console.log(name, JSON.stringify(told));
  if (options.picture && picture) {
    await writeFile(path.join(options.picture, `${name}.png`), Buffer.from(picture.split(',')[1], 'base64'));
  }
  if (!found || found.log.length || found.pixels.red || !(found.pixels.green > least)) {
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
  await writeFile(path.join(folder, 'table.csv'), table());
  execFileSync(path.resolve(options.terratet), ['export', '--voxels', 'table.csv,srs=EPSG:3067', 't.json', '-q'], { cwd: folder });
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
  await rm(folder, { recursive: true, force: true });
}
for (const problem of problems) console.log(problem);
process.exit(problems.length ? 1 : 0);
