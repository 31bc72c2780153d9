// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { blockWalls, cellAt, cellVolumes, cutAtLevel, cutAtPlane, pointGradients, shareAbove, volumeAbove } from '../src/cells.js';

/** The unit cube in six tetrahedra round its diagonal; the two first are block 1, the others 2. */
function cube() {
  const points = [];
  for (let i = 0; i < 8; ++i) points.push(i >> 2 & 1, i >> 1 & 1, i & 1);
  const corners = [[0, 4, 6, 7], [0, 4, 5, 7], [0, 2, 6, 7], [0, 2, 3, 7], [0, 1, 5, 7], [0, 1, 3, 7]].flat();
  return { points: Float32Array.from(points), corners: Uint32Array.from(corners), region: Uint32Array.from([1, 1, 2, 2, 2, 2]) };
}

function area({ position }) {
  let sum = 0;
  for (let i = 0; i < position.length; i += 9) {
    const u = [0, 1, 2].map((k) => position[i + 3 + k] - position[i + k]);
    const v = [0, 1, 2].map((k) => position[i + 6 + k] - position[i + k]);
    sum += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return sum;
}

test('a section of the cube has the cube section\'s area', () => {
  assert.ok(Math.abs(area(cutAtPlane(cube(), [1, 0, 0], 0.3)) - 1) < 1e-6);
  const s = 1 / Math.sqrt(3);
  assert.ok(Math.abs(area(cutAtPlane(cube(), [s, s, s], 1.5 * s)) - 0.75 * Math.sqrt(3)) < 1e-6);  // a hexagon
});

test('volumes above a linear level are the cube\'s, and without a value none', () => {
  const cells = cube();
  const volumes = cellVolumes(cells);
  assert.ok(Math.abs(volumes.reduce((a, b) => a + b) - 1) < 1e-12);
  const sum = Float64Array.from({ length: 8 }, (_, i) => cells.points[3 * i] + cells.points[3 * i + 1] + cells.points[3 * i + 2]);
  for (const at of [-1, 0.5, 1, 1.5, 2.7, 4]) {
    const below = [0, 1, 2, 3].reduce((v, k) => v + [1, -3, 3, -1][k] * Math.max(0, Math.min(at, 3) - k) ** 3 / 6, 0);
    assert.ok(Math.abs(volumeAbove(cells, volumes, sum, at).above - (1 - below)) < 1e-9, `${at}`);
  }
  sum[0] = NaN;
  assert.equal(volumeAbove(cells, volumes, sum, -1).above, 0);
  const { ofBlocks } = volumeAbove(cells, volumes, new Float64Array(8), 0, 2);
  assert.ok(Math.abs(ofBlocks[0] - 1 / 3) < 1e-9 && Math.abs(ofBlocks[1] - 2 / 3) < 1e-9);
});

test('the share above agrees with sampling', () => {
  let seed = 7;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  for (let round = 0; round < 20; ++round) {
    const l = [random(), random(), random(), random()];
    const at = random();
    let hits = 0;
    for (let i = 0; i < 20000; ++i) {
      const e = [0, 1, 2, 3].map(() => -Math.log(random()));
      const sum = e[0] + e[1] + e[2] + e[3];
      hits += e.reduce((value, x, k) => value + x / sum * l[k], 0) >= at;
    }
    assert.ok(Math.abs(shareAbove(l, at) - hits / 20000) < 0.015);
  }
});

test('an isosurface lies where the level is, its normals along the gradient', () => {
  const cells = cube();
  const level = Float64Array.from({ length: 8 }, (_, i) => 2 * cells.points[3 * i] + 1);
  const { position, weights, cell } = cutAtLevel(cells, level, 1.5);
  assert.ok(cell.length > 0);
  for (let i = 0; i < position.length; i += 3) assert.ok(Math.abs(position[i] - 0.25) < 1e-6);
  for (let i = 0; i < weights.length; i += 4) assert.ok(Math.abs(weights.slice(i, i + 4).reduce((a, b) => a + b) - 1) < 1e-6);
  const gradients = pointGradients(cells, level, cellVolumes(cells));
  for (let i = 0; i < 8; ++i) assert.ok(gradients[3 * i] > 0 && Math.abs(gradients[3 * i + 1]) < 1e-6);
  level[3] = NaN;
  assert.ok(cutAtLevel(cells, level, 1.5).cell.length < cell.length);
});

test('a place is found in its cell, with weights that give it back', () => {
  const cells = cube();
  const found = cellAt(cells, [0.9, 0.3, 0.2]);
  assert.equal(found.cell, 0);
  assert.ok(Math.abs(found.weights.reduce((a, b) => a + b) - 1) < 1e-9 && Math.min(...found.weights) >= 0);
  assert.equal(cellAt(cells, [1.2, 0.5, 0.5]), null);
});

test('walls are the facets that only one block has, once for each block', () => {
  const walls = blockWalls(cube());
  assert.equal(walls.cell.length, 12 + 2 * 2);  // the cube's, and both sides of what parts the blocks
  assert.ok(Math.abs(area(walls) - (6 + 4 * Math.SQRT2 / 2)) < 1e-5);
});
