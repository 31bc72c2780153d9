// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the file's data to a page that answers: everything that is seen follows from one state, which the address bar keeps.
import { MeshoptDecoder } from 'meshoptimizer';

import { cellVolumes } from './cells.js';
import { parseGlb, unpack } from './glb.js';
import { Layers } from './layers.js';
import { isMissing, toScale } from './scale.js';
import { Controls } from './controls.js';
import { fromHash } from './state.js';
import { View } from './view.js';

const element = (id) => document.getElementById(id);

/** The cells and logs of the model as arrays. */
async function readModel(info) {
  await MeshoptDecoder.ready;
  const glb = parseGlb(await unpack(element('data').textContent.trim()), MeshoptDecoder);
  const extras = glb.json.asset.extras;
  const { points, corners, region, extrapolation, values } = extras.cells;
  const cells = {
    points: glb.accessor(points), corners: glb.accessor(corners), region: glb.accessor(region),
    far: glb.accessor(extrapolation), values: values.map(glb.accessor),
  };
  cells.volumes = cellVolumes(cells);
  const properties = info.properties.map((property, p) => {
    const levels = Float64Array.from(cells.values[p], (value) => toScale(property, value));
    return { ...property, levels };
  });
  properties.push({ name: 'extrapolation', unit: '', scale: 'linear', low: 0, high: 1, levels: Float64Array.from(cells.far),
                    quartiles: [], own: true });
  if (info.blocks.length > 1 || properties.length === 1) {
    const levels = new Float64Array(cells.far.length).fill(NaN);
    cells.corners.forEach((v, i) => { if (cells.region[i >> 2] > 0) levels[v] = cells.region[i >> 2] - 1; });
    properties.splice(info.property < 0 ? 0 : properties.length, 0,
                      { name: 'block', unit: '', scale: 'linear', low: 0, high: 1, levels, quartiles: [], own: true, classes: info.blocks });
  }
  let intervals = null;
  if (extras.intervals) {
    const { hole, depth, length, values: logged } = extras.intervals;
    intervals = { hole: glb.accessor(hole), depth: glb.accessor(depth), length: glb.accessor(length),
                  values: logged.map((index) => Float32Array.from(glb.accessor(index), (v) => (isMissing(v) ? NaN : v))) };
  }
  return { info, glb, extras, cells, properties, intervals };
}

function boxOf(points) {
  const box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (let i = 0; i < points.length; ++i) {
    box.min[i % 3] = Math.min(box.min[i % 3], points[i]);
    box.max[i % 3] = Math.max(box.max[i % 3], points[i]);
  }
  return box;
}

async function start() {
  const info = JSON.parse(element('info').textContent);
  const canvas = element('view');
  const probe = document.createElement('canvas');
  if (!probe.getContext('webgl2')) {
    canvas.hidden = true;
    document.body.dataset.ready = 'picture';
    return;
  }
  const model = await readModel(info);
  const box = boxOf(model.cells.points);
  const view = new View(canvas, box);
  const layers = new Layers(model, view, box);
  document.body.classList.add('live');
  const controls = new Controls(model, view, layers);
  controls.apply(fromHash(location.hash, controls.defaults()), true);
  addEventListener('hashchange', () => controls.apply(fromHash(location.hash, controls.defaults()), true));
  view.drawNow();
  document.body.dataset.ready = 'live';
}

start().catch((error) => {
  document.body.classList.remove('live');
  document.body.dataset.ready = 'failed';
  element('where').textContent = `This page could not show its scene: ${error.message}`;
});
