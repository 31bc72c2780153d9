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
import { rm, stat } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';

import { chromium, flags, newProfile, ofModules, removeProfile, serve } from './browser.mjs';

const { values: options, positionals: [file, picture] } = parseArgs({
  allowPositionals: true,
  options: { modules: { type: 'string' }, node: { type: 'string', multiple: true, default: [] } },
});
const here = path.dirname(fileURLToPath(import.meta.url));

function fileOf(url) {
  if (url === '/') return path.join(here, 'view.html');
  return url.startsWith('/scene') ? file : ofModules(url, options.modules);
}

const served = await serve(fileOf);
const profile = await newProfile();
await rm(picture, { force: true });
try {
  await promisify(execFile)(chromium, [
    ...flags(profile, '1200,900'), '--virtual-time-budget=20000', `--screenshot=${path.resolve(picture)}`,
    `${served.address}?scene=/scene${path.extname(file)}`,
  ], { timeout: 120000 });
} finally {
  served.close();
  await removeProfile(profile);
}

/** What the page found, or why it found nothing. */
const result = served.found;
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
