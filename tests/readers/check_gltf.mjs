// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Validates glTF files with the Khronos validator: no error and no warning is accepted.
//
//   check_gltf.mjs --modules NODE_MODULES [--node NAME]... FILE...
//
// --node: a node that each file must have, by its name's beginning.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';
import { parseArgs } from 'node:util';

const { values: options, positionals: files } = parseArgs({
  allowPositionals: true,
  options: { modules: { type: 'string' }, node: { type: 'string', multiple: true, default: [] } },
});
const require = createRequire(path.resolve(options.modules) + '/');
const validator = require('gltf-validator');

function document(bytes) {
  const isBinary = bytes.toString('latin1', 0, 4) === 'glTF';
  return JSON.parse(isBinary ? bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)) : bytes.toString('utf8'));
}

let failed = files.length === 0;
for (const file of files) {
  const bytes = await readFile(file);
  const report = await validator.validateBytes(new Uint8Array(bytes), { uri: path.basename(file), maxIssues: 0 });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  for (const message of messages) {
    console.log(`${file}: ${['error', 'warning', 'information', 'hint'][message.severity]} ${message.code} at ` +
                `${message.pointer}: ${message.message}`);
  }
  const names = document(bytes).nodes.map((node) => node.name);
  const missing = options.node.filter((wanted) => !names.some((name) => name.startsWith(wanted)));
  if (missing.length) {
    console.log(`${file}: no node ${missing.join(', ')} among ${names.join(', ')}`);
  }
  failed ||= numErrors > 0 || numWarnings > 0 || missing.length > 0;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} informations; ` +
              `${report.info.totalTriangleCount} triangles, nodes ${names.join(', ')}`);
}
process.exit(failed ? 1 : 0);
