// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Opens a glTF file with a viewer in headless Chromium, keeps a picture, and prints what the viewer reports as JSON:
//
//   open_gltf.mjs --modules NODE_MODULES --page cesium|model_viewer [--size X,Y,Z] FILE PICTURE.png
//
// Fails when the viewer reports an error or nothing, asks for anything that is not here, or finds another size.
import { writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

import { ofModules, show } from '../browser.mjs';

const { values: options, positionals: [file, picture] } = parseArgs({
  allowPositionals: true,
  options: { modules: { type: 'string' }, page: { type: 'string' }, size: { type: 'string' } },
});
const here = path.dirname(fileURLToPath(import.meta.url));

function fileOf(url) {
  if (url === '/') return path.join(here, `${options.page}.html`);
  if (url === '/report.js') return path.join(here, 'report.js');
  return url.startsWith('/scene') ? file : ofModules(url, options.modules);
}

const { found, missing } = await show(fileOf, `scene=/scene${path.extname(file)}`, '1200,900', 400000);
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
