// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Voxel tilesets of a field linear in x, y and z, with voids, drawn by CesiumJS in headless Chromium, whose shader
// compares each pixel's value with its place; their tiles in the Khronos validator; and values picked of the twin's
// tileset against `terratet query`.
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
  if (!found) problems.push(`${name}: CesiumJS did not report`);
  if (options.picture && picture) {
    await writeFile(path.join(options.picture, `${name}.png`), Buffer.from(picture.split(',')[1], 'base64'));
  }
  if (found && (found.log.length || found.pixels.red || !(found.pixels.green > least))) {
    problems.push(`${name}: not all pixels are right`);
  }
  return found?.picks ?? [];
}

const run = (...words) => execFileSync(path.resolve(options.terratet), words, { cwd: folder, encoding: 'utf8' });

/** True coordinates of a sample's middle, by the rules of 3DTILES_content_voxels for boxes with a padding of one. */
function placeOf({ level, tile, sample }, { root, extras }) {
  const { dimensions: d } = root.content.extensions['3DTILES_content_voxels'];
  const slice = (d[0] + 2) * (d[2] + 2);
  const [south, rest] = [Math.floor(sample / slice), sample % slice];
  const at = [(rest % (d[0] + 2)) - 1, d[1] - south, Math.floor(rest / (d[0] + 2)) - 1];
  const voxels = 2 ** (root.implicitTiling.availableLevels - 1 - level);
  return at.map((n, a) => extras.origin[a] + extras.spacing[a] * (voxels * (tile[a] * d[a] + n + 0.5) - 0.5));
}

async function pickTwin() {
  const data = path.join(here, '../../data/olkiluoto-twin/');
  run('build', '--boreholes', `${data}collar.csv`, '--survey', `${data}survey.csv`, '--log', `${data}log.csv`, '--faults',
      `${data}fracture.ts`, '--property', 'K:log10:unit=m/s', '-s_srs', 'EPSG:3067', '-te', '525130', '6791500', '-990', '525870',
      '6792500', '10', '--lmin', '60m', '--estimator', 'idw:anisotropy=none', '-q', '-o', 'twin.gpkg');
  run('export', '--voxels', '--values', 'estimator', '-tr', '12', 'twin.gpkg', 'twin.json', '-q');
  const tileset = JSON.parse(await readFile(path.join(folder, 'twin.json')));
  const picks = [];
  for (let x = 60; x < 250; x += 20) for (let y = 40; y < 130; y += 15) picks.push([x, y]);
  const found = (await draw('twin', { look: [0, 0, 0], heading: 0.5, pitch: -0.6, distance: 2400, error: 1, nearest: true,
                                     alpha: 'step(0.5, fsInput.metadata.mask)', tileset: '/data/twin.json', picks,
                                     right: 'fsInput.metadata.K_log10 < 0.0' }, 5000))
    // Where the mask is 0 values only go on as their neighbours do.
    .filter((pick) => pick && pick.values.mask && pick.level === tileset.root.implicitTiling.availableLevels - 1);
  const rows = found.map((pick) => placeOf(pick, tileset).join(','));
  await writeFile(path.join(folder, 'picked.csv'), `x,y,z\n${rows.join('\n')}\n`);
  const [head, ...answers] = run('query', 'twin.gpkg', 'value', 'picked.csv', '-q').trim().split('\n').map((line) => line.split(','));
  let worst = 0;
  found.forEach(({ values }, n) => {
    const of = (name) => Number(answers[n][head.indexOf(name)]);
    worst = Math.max(worst, Math.abs(values.K_log10 - Math.log10(of('K'))), Math.abs(values.extrapolation - of('K_extrapolation')));
  });
  console.log(`${found.length} values picked, farthest from query by ${worst}`);
  if (!(found.length > 8 && worst <= 1e-5)) problems.push('twin: what is picked is not what query says');
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
  run('export', '--voxels', 'table.csv,srs=EPSG:3067', 't.json', '-q');
  run('export', '--voxels', '--compress', 'table.csv,srs=EPSG:3067', 'packed.json', '-q');
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
  await draw('packed', { ...view, tileset: '/data/packed.json', right }, 20000);
  await draw('category', { ...view, tileset: '/data/t/rock/tileset.json', nearest: true,
                           right: rock.replace('ROCK', '1.0 : 0.0') }, 20000);
  await pickTwin();
  await validate(path.join(folder, 't', 'content'));
} finally {
  await rm(folder, { recursive: true, force: true });
}
for (const problem of problems) console.log(problem);
process.exit(problems.length ? 1 : 0);
