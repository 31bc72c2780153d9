// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts of the cells: sections, isosurfaces, walls of blocks, and volumes above a value.
//
// cells: {points: Float32Array (x, y, z of each), corners: Uint32Array (four of each cell), region: Uint32Array
// (0: none, else block + 1)}. A cut is a soup of triangles: three corners after each other, each with its place and the
// weights of its cell's four points there.

const pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

class Soup {
  constructor() {
    this.position = [];
    this.weights = [];
    this.cell = [];
    this.edges = [];  // two corners each, of the polygons' outlines
  }

  polygon(cell, corners, at) {
    const places = corners.map(([weights]) => at(weights));
    for (let k = 1; k + 1 < corners.length; ++k) {
      for (const j of [0, k, k + 1]) {
        this.position.push(...places[j]);
        this.weights.push(...corners[j][0]);
      }
      this.cell.push(cell);
    }
    for (let k = 0; k < corners.length; ++k) this.edges.push(...places[k], ...places[(k + 1) % corners.length]);
  }

  finish() {
    return {
      position: Float32Array.from(this.position), weights: Float32Array.from(this.weights),
      cell: Uint32Array.from(this.cell), edges: Float32Array.from(this.edges),
    };
  }
}

function mixer(points, corners, cell) {
  return (weights) => {
    const p = [0, 0, 0];
    for (let k = 0; k < 4; ++k) {
      const v = 3 * corners[4 * cell + k];
      for (let axis = 0; axis < 3; ++axis) p[axis] += weights[k] * points[v + axis];
    }
    return p;
  };
}

/** Where a level, given at the points, takes the value `at`. Cells with a NaN are left out. */
export function cutAtLevel({ points, corners }, level, at) {
  const soup = new Soup();
  const n = corners.length / 4;
  for (let c = 0; c < n; ++c) {
    const l0 = level[corners[4 * c]];
    const l1 = level[corners[4 * c + 1]];
    const l2 = level[corners[4 * c + 2]];
    const l3 = level[corners[4 * c + 3]];
    const above = (l0 >= at) + (l1 >= at) + (l2 >= at) + (l3 >= at);
    if (above === 0 || above === 4 || Number.isNaN(l0 + l1 + l2 + l3)) continue;
    const l = [l0, l1, l2, l3];
    const on = ([a, b]) => {
      const t = (at - l[a]) / (l[b] - l[a]);
      const weights = [0, 0, 0, 0];
      weights[a] = 1 - t;
      weights[b] = t;
      return [weights];
    };
    const crossed = pairs.filter(([a, b]) => (l[a] >= at) !== (l[b] >= at));
    if (crossed.length === 4) {  // in order round: neighbours share an end
      const [first, ...rest] = crossed;
      const meets = (e, f) => e.some((end) => f.includes(end));
      const opposite = rest.find((e) => !meets(first, e));
      const sides = rest.filter((e) => e !== opposite);
      soup.polygon(c, [first, sides[0], opposite, sides[1]].map(on), mixer(points, corners, c));
    } else {
      soup.polygon(c, crossed.map(on), mixer(points, corners, c));
    }
  }
  return soup.finish();
}

export function distances(points, normal, offset) {
  const result = new Float64Array(points.length / 3);
  for (let i = 0; i < result.length; ++i) {
    result[i] = normal[0] * points[3 * i] + normal[1] * points[3 * i + 1] + normal[2] * points[3 * i + 2] - offset;
  }
  return result;
}

export const cutAtPlane = (cells, normal, offset) => cutAtLevel(cells, distances(cells.points, normal, offset), 0);

/** The facets that one block alone has, with that block's side of each. */
export function blockWalls({ points, corners, region }) {
  const n = corners.length / 4;
  const span = points.length / 3;
  const open = new Map();
  for (let c = 0; c < n; ++c) {
    for (let k = 0; k < 4; ++k) {
      const [a, b, d] = [0, 1, 2, 3].filter((j) => j !== k).map((j) => corners[4 * c + j]).sort((x, y) => x - y);
      const key = (a * span + b) * span + d;
      const twin = open.get(key);
      if (twin === undefined) open.set(key, 4 * c + k);
      else if (region[twin >> 2] === region[c]) open.delete(key);
      else open.set(-1 - key, 4 * c + k);
    }
  }
  const soup = new Soup();
  for (const facet of [...open.values()].sort((x, y) => x - y)) {
    const cell = facet >> 2;
    const kept = [0, 1, 2, 3].filter((j) => j !== (facet & 3));
    const unit = (j) => { const w = [0, 0, 0, 0]; w[j] = 1; return [w]; };
    if (region[cell] > 0) soup.polygon(cell, kept.map(unit), mixer(points, corners, cell));
  }
  return soup.finish();
}

export function cellVolumes({ points, corners }) {
  const result = new Float64Array(corners.length / 4);
  const p = (v, axis) => points[3 * v + axis];
  for (let c = 0; c < result.length; ++c) {
    const [a, b, d, e] = corners.subarray(4 * c, 4 * c + 4);
    const u = [0, 1, 2].map((k) => p(b, k) - p(a, k));
    const v = [0, 1, 2].map((k) => p(d, k) - p(a, k));
    const w = [0, 1, 2].map((k) => p(e, k) - p(a, k));
    result[c] = Math.abs(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2])
                         + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6;
  }
  return result;
}

/** The share of a cell in which a level, linear between its corners, is at or above `at`. */
export function shareAbove(levels, at) {
  const l = [...levels].sort((a, b) => b - a);
  if (l.some(Number.isNaN)) return NaN;
  const above = l.filter((value) => value >= at).length;
  const tip = (own, others) => others.reduce((share, other) => share * (own - at) / (own - other), 1);
  if (above === 0) return 0;
  if (above === 4) return 1;
  if (above === 1) return tip(l[0], [l[1], l[2], l[3]]);
  if (above === 3) return 1 - tip(l[3], [l[0], l[1], l[2]]);
  const along = (i, o) => (l[i] - at) / (l[i] - l[o]);
  const [ac, ad, bc, bd] = [along(0, 2), along(0, 3), along(1, 2), along(1, 3)];
  return ac * ad + ac * (1 - ad) * bd + (1 - ac) * bc * bd;
}

/** Volume above, and of all cells with values; of the blocks each if wanted. */
export function volumeAbove({ corners, region }, volumes, level, at, blocks = 0) {
  const result = { above: 0, all: 0, ofBlocks: new Float64Array(blocks) };
  for (let c = 0; c < volumes.length; ++c) {
    result.all += volumes[c];
    const l = [0, 1, 2, 3].map((k) => level[corners[4 * c + k]]);
    const share = shareAbove(l, at);
    if (Number.isNaN(share)) continue;
    result.above += share * volumes[c];
    if (region[c] > 0 && blocks > 0) result.ofBlocks[region[c] - 1] += share * volumes[c];
  }
  return result;
}

/** The cell that holds a place, with the weights of its points there; null outside. */
export function cellAt({ points, corners }, place) {
  let best = null;
  for (let c = 0; c < corners.length / 4; ++c) {
    const v = [0, 1, 2, 3].map((k) => 3 * corners[4 * c + k]);
    let apart = false;
    for (let axis = 0; axis < 3 && !apart; ++axis) {
      const at = v.map((i) => points[i + axis]);
      const slack = 1e-4;
      apart = place[axis] < Math.min(...at) - slack || place[axis] > Math.max(...at) + slack;
    }
    if (apart) continue;
    const weights = barycentric(points, v, place);
    const least = Math.min(...weights);
    if (least >= 0) return { cell: c, weights };
    if (least > -1e-6 && (!best || least > Math.min(...best.weights))) best = { cell: c, weights };
  }
  return best;
}

/** Weights of a cell's four points, whose numbers begin at v in `points`. */
export function barycentric(points, v, place) {
  const d = [0, 1, 2].map((axis) => points[v[3] + axis]);
  const m = [0, 1, 2].map((k) => [0, 1, 2].map((axis) => points[v[k] + axis] - d[axis]));
  const q = place.map((x, axis) => x - d[axis]);
  const det = (a, b, c) => a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                           + a[2] * (b[0] * c[1] - b[1] * c[0]);
  const whole = det(...m);
  const w = [det(q, m[1], m[2]) / whole, det(m[0], q, m[2]) / whole, det(m[0], m[1], q) / whole];
  return [...w, 1 - w[0] - w[1] - w[2]];
}

/** Of each point the mean gradient of the cells round it, weighted by volume: normals of isosurfaces. */
export function pointGradients({ points, corners }, level, volumes) {
  const result = new Float32Array(points.length);
  for (let c = 0; c < volumes.length; ++c) {
    const v = [0, 1, 2, 3].map((k) => corners[4 * c + k]);
    const f = v.map((i) => level[i]);
    if (f.some(Number.isNaN)) continue;
    const e = [1, 2, 3].map((k) => [0, 1, 2].map((axis) => points[3 * v[k] + axis] - points[3 * v[0] + axis]));
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const faces = [cross(e[1], e[2]), cross(e[2], e[0]), cross(e[0], e[1])];
    const six = e[0][0] * faces[0][0] + e[0][1] * faces[0][1] + e[0][2] * faces[0][2];
    if (!(Math.abs(six) > 0)) continue;
    for (let axis = 0; axis < 3; ++axis) {
      const g = ((f[1] - f[0]) * faces[0][axis] + (f[2] - f[0]) * faces[1][axis] + (f[3] - f[0]) * faces[2][axis]) / six;
      for (const i of v) result[3 * i + axis] += g * volumes[c];
    }
  }
  return result;
}
