// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page into one file, page.html: what Terratet fills in stands between @@. With --check, compares with the file
// that is there instead of writing it.
import { createHash } from 'node:crypto';
import { readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

import { build } from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const modules = process.env.PAGE_MODULES ?? path.join(here, 'node_modules');
const bundled = await build({
  entryPoints: [path.join(here, 'src/main.js')], bundle: true, minify: true, write: false, format: 'iife', target: 'es2022',
  charset: 'ascii', legalComments: 'none', nodePaths: [modules],
  alias: { 'three/addons': path.join(modules, 'three/examples/jsm') },
});
const style = (await build({ entryPoints: [path.join(here, 'src/page.css')], minify: true, write: false })).outputFiles[0].text.trim();
const script = bundled.outputFiles[0].text.trim().replaceAll('</script', '<\\/script');
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const license = await readFile(path.join(modules, 'three/LICENSE'), 'utf8');
const page = (await readFile(path.join(here, 'src/page.html'), 'utf8'))
  .replace('%LICENSE%', () => license.trim().replaceAll('--', '- -'))
  .replace('%POLICY%', () => `default-src 'none'; script-src ${hash(script)} 'wasm-unsafe-eval'; style-src ${hash(style)}; img-src data: blob:`)
  .replace('%STYLE%', () => style)
  .replace('%SCRIPT%', () => script);
const target = path.join(here, 'page.html');
if (process.argv.includes('--check')) {
  if (await readFile(target, 'utf8') !== page) {
    console.error(`${target} is not what its source makes: run npm run build there`);
    process.exit(1);
  }
  console.log(`page.html is what its source makes: ${page.length} bytes`);
} else {
  await writeFile(target, page);
  console.log(`${target}: ${page.length} bytes`);
}
