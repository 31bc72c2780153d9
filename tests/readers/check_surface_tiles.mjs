// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The twin's scene as 3D Tiles, drawn by CesiumJS in headless Chromium from afar and from near, plain and packed: the
// levels that are shown, what is picked, that its place is PROJ's, and the tiles in the Khronos validator.
//
//   check_surface_tiles.mjs --modules NODE_MODULES --viewers NODE_MODULES --terratet PROGRAM [--picture FOLDER]
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
const folder = await mkdtemp(path.join(tmpdir(), 'terratet-surfaces-'));
const problems = [];
const check = (right, what) => { if (!right) problems.push(what); };
const run = (...words) => execFileSync(path.resolve(options.terratet), words, { cwd: folder, encoding: 'utf8' });

function fileOf(url) {
  if (url === '/') return path.join(here, 'surface_tiles.html');
  return url.startsWith('/data/') ? path.join(folder, path.normalize(url.slice('/data'.length)))
    : ofModules(url, options.viewers);
}

async function draw(name) {
  const { found, missing } = await show(fileOf, `tileset=${encodeURIComponent(`/data/${name}.json`)}`, '800,640', 170000);
  const { views = [], ...told } = found ?? {};
  console.log(name, JSON.stringify({ ...told, views: views.map(({ picture, ...view }) => view) }));
  if (options.picture) {
    for (const [n, { picture }] of views.entries()) {
      await writeFile(path.join(options.picture, `${name}-${n}.png`), Buffer.from(picture.split(',')[1], 'base64'));
    }
  }
  check(found && !found.log.length && !missing.length, `${name}: CesiumJS complains or does not report`);
  check(views.length === 2 && views[0].drawn > 0.0005 && views[1].drawn > 0.05, `${name}: nothing is drawn`);
  if (views.length < 2) return;
  const [far, near] = views;
  check(far.triangles > 0 && near.triangles > 2 * far.triangles, `${name}: no more triangles from near than from afar`);
  const picked = Object.fromEntries(views.flatMap(({ picks }) => picks).map((facts) => [`${facts.kind} ${facts.name}`, facts]));
  const kinds = new Set(Object.values(picked).map(({ kind }) => kind));
  check(kinds.size >= 2, `${name}: picked only ${[...kinds]}`);
  for (const facts of Object.values(picked)) {
    check(facts.kind !== 'borehole' || (facts.id === facts.name && facts.length > 100), `${name}: ${JSON.stringify(facts)}`);
    check(facts.kind !== 'isosurface' || (facts.property === 'K' && facts.value > 0), `${name}: ${JSON.stringify(facts)}`);
    check(facts.kind !== 'fault' || facts.dip > 0, `${name}: ${JSON.stringify(facts)}`);
  }
  check(found.hole === 'borehole', `${name}: at a borehole's collar is ${found.hole}`);
}

async function validate(tiles) {
  const validator = createRequire(path.resolve(options.modules) + '/')('gltf-validator');
  const names = await readdir(tiles);
  for (const name of names) {
    const { issues } = await validator.validateBytes(new Uint8Array(await readFile(path.join(tiles, name))));
    for (const { severity, code, message } of issues.messages) check(severity > 1, `${name}: ${code} ${message}`);
  }
  console.log(`${names.length} tiles validated`);
}

try {
  const data = path.join(here, '../../data/olkiluoto-twin/');
  run('build', '--boreholes', `${data}collar.csv`, '--survey', `${data}survey.csv`, '--log', `${data}log.csv`, '--faults',
      `${data}fracture.ts`, '--property', 'K:log10:unit=m/s', '-s_srs', 'EPSG:3067', '-te', '525130', '6791500', '-990', '525870',
      '6792500', '10', '--lmin', '40m', '--estimator', 'idw:anisotropy=none', '-q', '-o', 'twin.gpkg');
  run('export', 'twin.gpkg', 'plain.json', '-q');
  run('export', '--compress', 'twin.gpkg', 'packed.json', '-q');
  await draw('plain');
  await draw('packed');
  await validate(path.join(folder, 'plain', 'content'));
  await validate(path.join(folder, 'packed', 'content'));
} finally {
  await rm(folder, { recursive: true, force: true });
}
for (const problem of problems) console.log(problem);
process.exit(problems.length ? 1 : 0);
