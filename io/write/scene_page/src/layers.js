// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The things in the scene, and how they follow from the state.
import { barycentric, blockWalls, cutAtLevel, cutAtPlane, pointGradients, volumeAbove } from './cells.js';
import { fromScale, isMissing, missing, toScale } from './scale.js';
import { bodyMaterial, Color, cutMaterial, geometryOf, linesOf, mapTexture, Mesh, painting, tubeMaterial, Vector3 } from './view.js';

export const sectionKeys = ['ew', 'ns', 'level', 'free'];

export class Layers {
  constructor(model, view, box) {
    Object.assign(this, { model, view, box });
    const { info, extras, cells } = model;
    this.origin = extras.origin;
    this.metres = extras.metres_per_unit;
    this.centres = this.blockCentres(cells, info.blocks.length);
    this.cutMaterial = cutMaterial();
    this.cuts = new Map();  // name → {mesh, cut, edges}
    this.bodies = [];
    this.barriers = [];
    painting.reach.value = info.reach;
    this.addNodes();
    this.handles = new Map(sectionKeys.map((key) => [key, view.handle()]));
    for (const handle of this.handles.values()) view.scene.add(handle);
    this.dark = false;
  }

  toTrue([x, y, z]) {
    const [ox, oy, oz] = this.origin;
    return [ox + x / this.metres, oy - z / this.metres, oz + y / this.metres];
  }

  toScene([x, y, z]) {
    const [ox, oy, oz] = this.origin;
    return [(x - ox) * this.metres, (z - oz) * this.metres, -(y - oy) * this.metres];
  }

  blockCentres({ points, corners, region, volumes }, count) {
    const sums = Array.from({ length: count + 1 }, () => [0, 0, 0, 0]);
    for (let c = 0; c < volumes.length; ++c) {
      for (const of of [sums[region[c]], ...(region[c] > 0 ? [sums[0]] : [])]) {
        of[3] += volumes[c];
        for (let axis = 0; axis < 3; ++axis) {
          let middle = 0;
          for (let k = 0; k < 4; ++k) middle += 0.25 * points[3 * corners[4 * c + k] + axis];
          of[axis] += volumes[c] * middle;
        }
      }
    }
    return sums.map(([x, y, z, v]) => (v > 0 ? [x / v, y / v, z / v] : [0, 0, 0]));
  }

  /** How far a block is moved out. */
  shift(region) {
    if (!(this.state.explode > 0) || region === 0) return [0, 0, 0];
    return [0, 1, 2].map((k) => this.state.explode * (this.centres[region][k] - this.centres[0][k]));
  }

  /** Boreholes, barriers, ground and frame, as the file has them. */
  addNodes() {
    const { glb, properties, info } = this.model;
    const tubes = { position: [], index: [], hole: [], levels: properties.map(() => []) };
    for (const node of glb.json.nodes) {
      if (node.mesh === undefined) continue;
      const { attributes, indices, material, mode } = glb.json.meshes[node.mesh].primitives[0];
      const position = glb.positions(node);
      const index = Uint32Array.from(glb.accessor(indices));
      if (node.name.startsWith('borehole: ')) {
        const first = tubes.position.length / 3;
        for (const x of position) tubes.position.push(x);
        for (const i of index) tubes.index.push(first + i);
        const hole = glb.accessor(attributes._FEATURE_ID_0)[0];
        for (let v = 0; v < position.length / 3; ++v) tubes.hole.push(hole);
        properties.forEach((property, p) => {
          const values = property.own ? null : glb.accessor(attributes[info.properties[p].attribute]);
          for (let v = 0; v < position.length / 3; ++v) {
            const level = values ? toScale(property, values[v]) : NaN;
            tubes.levels[p].push(Number.isNaN(level) ? missing : level);
          }
        });
      } else if (mode === 1) {
        const ends = new Float32Array(3 * index.length);
        index.forEach((v, i) => ends.set(position.subarray(3 * v, 3 * v + 3), 3 * i));
        this.frame = linesOf(ends, '#87909b');
        this.view.world.add(this.frame);
      } else {
        const { pbrMetallicRoughness: { baseColorFactor: [r, g, b, a] } } = glb.json.materials[material];
        const mesh = new Mesh(geometryOf({ position: [position, 3] }, index), bodyMaterial(new Color(r, g, b), a));
        mesh.geometry.computeVertexNormals();
        mesh.renderOrder = 2;
        this.view.world.add(mesh);
        if (node.name === 'ground') this.ground = mesh;
        else {
          mesh.userData = info.barriers[glb.accessor(attributes._FEATURE_ID_0)[0]];
          this.barriers.push(mesh);
        }
      }
    }
    if (tubes.hole.length > 0) {
      this.tubeHoles = Uint32Array.from(tubes.hole);
      this.tubeLevels = tubes.levels.map((levels) => Float32Array.from(levels));
      this.tubes = new Mesh(geometryOf({
        position: [Float32Array.from(tubes.position), 3], level: [this.tubeLevels[0], 1],
        picked: [new Float32Array(tubes.hole.length), 1],
      }, Uint32Array.from(tubes.index)), tubeMaterial());
      this.view.world.add(this.tubes);
    }
  }

  get property() { return this.model.properties[this.propertyIndex]; }

  /** Everything that differs between two states is made anew. */
  apply(state, previous = {}) {
    this.state = state;
    const differs = (...keys) => keys.some((key) => String(state[key]) !== String(previous[key]));
    const recut = differs('explode');
    if (differs('p')) {
      this.propertyIndex = Math.max(0, this.model.properties.findIndex(({ name }) => name === state.p));
      this.gradients = null;
      for (const cut of this.cuts.values()) this.setLevels(cut);
    }
    if (differs('p', 'map', 'range')) this.setColors();
    if (differs('p', 'cut', 'cutOn')) {
      painting.cutoff.value = this.cutLevel() ?? missing;
    }
    for (const key of sectionKeys) {
      if (recut || differs(key, `${key}On`)) this.section(key);
    }
    if (recut || differs('p', 'iso', 'isoOn', 'cut', 'cutOn', 'map', 'range')) this.isosurfaces();
    if (recut || differs('blocks', 'cutOn')) this.walls();
    if (differs('edges')) for (const { edges } of this.cuts.values()) edges.visible = state.edges;
    if (differs('holes', 'barriers', 'hidden', 'ground', 'frame')) this.visibility();
    if (differs('p') && this.tubes) this.tubes.geometry.setAttribute('level', geometryOf({ level: [this.tubeLevels[this.propertyIndex], 1] }).getAttribute('level'));
    if (differs('hole')) this.mark(state.hole);
    if (differs('stretch')) this.view.setStretch(state.stretch);
    this.placeHandles();
    this.view.draw();
  }

  visibility() {
    const { holes, barriers, hidden, ground, frame } = this.state;
    if (this.tubes) this.tubes.visible = holes;
    for (const mesh of this.barriers) mesh.visible = barriers && !hidden.includes(mesh.userData.name);
    if (this.ground) this.ground.visible = ground;
    this.frame.visible = frame;
  }

  range() {
    const { range } = this.state;
    return range.length === 2 ? range : [this.property.low, this.property.high];
  }

  anchors() { return this.model.info.maps[this.state.map] ?? Object.values(this.model.info.maps)[0]; }

  setColors() {
    const { property } = this;
    const classes = property.classes ? property.classes.map(({ color }) => color) : null;
    painting.map.value?.dispose();
    painting.map.value = mapTexture(this.anchors(), classes);
    painting.classes.value = classes ? classes.length : 0;
    [painting.low.value, painting.high.value] = this.range();
  }

  /** The threshold in the property's scale, if there is one. */
  cutLevel() {
    if (!this.state.cutOn || this.property.classes) return null;
    const level = toScale(this.property, this.state.cut);
    return Number.isNaN(level) ? null : level;
  }

  volumeAboveCut() {
    const level = this.cutLevel();
    if (level === null) return null;
    const { cells, info } = this.model;
    return volumeAbove(cells, cells.volumes, this.property.levels, level, info.blocks.length);
  }

  plane(key) {
    const { state } = this;
    if (key === 'ew') return { normal: [0, 0, 1], offset: this.toScene([0, state.ew, 0])[2] };
    if (key === 'ns') return { normal: [1, 0, 0], offset: this.toScene([state.ns, 0, 0])[0] };
    if (key === 'level') return { normal: [0, 1, 0], offset: this.toScene([0, 0, state.level])[1] };
    const [azimuth, dip, offset] = state.free;
    const a = azimuth * Math.PI / 180;
    const d = dip * Math.PI / 180;
    // Right of the azimuth, tipped up as the plane dips: its normal.
    const normal = [Math.cos(a) * Math.sin(d), Math.cos(d), Math.sin(a) * Math.sin(d)];
    const middle = [0, 1, 2].map((k) => 0.5 * (this.box.min[k] + this.box.max[k]));
    return { normal, offset: normal.reduce((sum, n, k) => sum + n * middle[k], 0) + offset * this.metres };
  }

  section(key) {
    if (!this.state[`${key}On`]) this.drop(key);
    else {
      const { normal, offset } = this.plane(key);
      this.show(key, cutAtPlane(this.model.cells, normal, offset));
    }
  }

  walls() {
    if (!this.state.blocks && !this.state.cutOn) return this.drop('walls');
    this.wallSoup ??= blockWalls(this.model.cells);
    return this.show('walls', this.wallSoup);
  }

  drop(name) {
    const old = this.cuts.get(name);
    if (!old) return;
    for (const object of [old.mesh, old.edges]) {
      this.view.world.remove(object);
      object.geometry.dispose();
    }
    this.cuts.delete(name);
  }

  show(name, cut) {
    this.drop(name);
    const { region, far, corners } = this.model.cells;
    const position = Float32Array.from(cut.position);
    const farness = new Float32Array(position.length / 3);
    for (let t = 0; t < cut.cell.length; ++t) {
      const cell = cut.cell[t];
      const shift = this.shift(region[cell]);
      for (let v = 3 * t; v < 3 * t + 3; ++v) {
        for (let k = 0; k < 3; ++k) position[3 * v + k] += shift[k];
        for (let k = 0; k < 4; ++k) farness[v] += cut.weights[4 * v + k] * far[corners[4 * cell + k]];
      }
    }
    for (let v = 0; v < farness.length; ++v) farness[v] = farness[v] > 1 - 1e-6 ? 1 : farness[v];
    const mesh = new Mesh(geometryOf({
      position: [position, 3], weights: [cut.weights, 4], levels: [new Float32Array(cut.cell.length * 12), 4], far: [farness, 1],
    }), this.cutMaterial);
    const edges = linesOf(cut.edges, this.dark ? '#000' : '#333', 0.45);
    edges.visible = this.state.edges && !(this.state.explode > 0);
    const entry = { mesh, cut, edges };
    this.setLevels(entry);
    this.cuts.set(name, entry);
    this.view.world.add(mesh, edges);
  }

  setLevels({ mesh, cut }) {
    const { corners } = this.model.cells;
    const { levels } = this.property;
    const attribute = mesh.geometry.getAttribute('levels');
    for (let t = 0; t < cut.cell.length; ++t) {
      for (let k = 0; k < 4; ++k) {
        const level = levels[corners[4 * cut.cell[t] + k]];
        for (let v = 3 * t; v < 3 * t + 3; ++v) attribute.array[4 * v + k] = Number.isNaN(level) ? missing : level;
      }
    }
    attribute.needsUpdate = true;
  }

  isosurfaces() {
    for (const body of this.bodies) {
      this.view.world.remove(body);
      body.geometry.dispose();
      body.material.dispose();
    }
    this.bodies = [];
    const { state, property } = this;
    if (property.classes) return;
    const cutLevel = this.cutLevel();
    const levels = (state.isoOn ? this.isoLevels() : []).map((value) => toScale(property, value)).filter(Number.isFinite);
    const opacities = levels.map((_, i) => 0.18 + 0.5 * (i + 1) / levels.length);
    if (cutLevel !== null) {
      levels.push(cutLevel);
      opacities.push(1);
    }
    levels.forEach((level, i) => this.bodies.push(this.body(level, opacities[i], i)));
  }

  isoLevels() {
    return this.state.iso.length > 0 ? this.state.iso : this.property.quartiles.slice(-1);
  }

  body(level, opacity, order) {
    const { cells, info } = this.model;
    const { property } = this;
    this.gradients ??= pointGradients(cells, property.levels, cells.volumes);
    const cut = cutAtLevel(cells, property.levels, level);
    const position = [];
    const normal = [];
    const kept = [];
    for (let t = 0; t < cut.cell.length; ++t) {
      const cell = cut.cell[t];
      const corner = [0, 1, 2, 3].map((k) => cells.corners[4 * cell + k]);
      const farness = corner.reduce((sum, v, k) => sum + cut.weights[12 * t + k] * cells.far[v], 0);
      if (farness >= Math.min(info.reach, 1 - 1e-6)) continue;
      const shift = this.shift(cells.region[cell]);
      // In the order in which the front looks to where values fall.
      const p = (v, k) => cut.position[9 * t + 3 * v + k];
      const [u, w] = [1, 2].map((v) => [0, 1, 2].map((k) => p(v, k) - p(0, k)));
      const front = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      const rise = [0, 1, 2].map((axis) => corner.reduce((sum, i) => sum + this.gradients[3 * i + axis], 0));
      const order = front[0] * rise[0] + front[1] * rise[1] + front[2] * rise[2] > 0 ? [0, 2, 1] : [0, 1, 2];
      for (const v of order.map((k) => 3 * t + k)) {
        const n = [0, 1, 2].map((axis) => corner.reduce((sum, p, k) => sum - cut.weights[4 * v + k] * this.gradients[3 * p + axis], 0));
        const size = Math.hypot(...n) || 1;
        for (let k = 0; k < 3; ++k) {
          position.push(cut.position[3 * v + k] + shift[k]);
          normal.push(n[k] / size);
        }
      }
      kept.push(cell);
    }
    const [low, high] = this.range();
    const t = high > low ? (level - low) / (high - low) : 0.5;
    const { data, width } = painting.map.value.image;
    const texel = 4 * Math.min(width - 1, Math.max(0, Math.round(t * (width - 1))));
    const color = new Color(`rgb(${data[texel]}, ${data[texel + 1]}, ${data[texel + 2]})`);
    const mesh = new Mesh(geometryOf({ position: [Float32Array.from(position), 3], normal: [Float32Array.from(normal), 3] }),
                          bodyMaterial(color, opacity));
    mesh.renderOrder = 3 + order;
    mesh.userData = { cell: kept, value: fromScale(property, level) };
    this.view.world.add(mesh);
    return mesh;
  }

  mark(id) {
    if (!this.tubes) return;
    const hole = this.model.info.holes.findIndex((other) => other.id === id);
    const picked = this.tubes.geometry.getAttribute('picked');
    for (let v = 0; v < picked.array.length; ++v) picked.array[v] = Number(this.tubeHoles[v] === hole);
    picked.needsUpdate = true;
  }

  placeHandles() {
    const { box, view } = this;
    const size = 0.012 * view.radius;
    for (const [key, handle] of this.handles) {
      handle.visible = Boolean(this.state[`${key}On`]) && this.state.handles;
      if (!handle.visible) continue;
      const { normal, offset } = this.plane(key);
      const corner = key === 'ew' ? [box.max[0], box.max[1], 0] : key === 'ns' ? [0, box.max[1], box.max[2]]
        : key === 'level' ? [box.max[0], 0, box.max[2]] : [0, 1, 2].map((k) => 0.5 * (box.min[k] + box.max[k]));
      const away = offset - corner.reduce((sum, x, k) => sum + x * normal[k], 0);
      const at = corner.map((x, k) => x + away * normal[k]);
      handle.position.set(at[0], at[1] * view.stretch, at[2]);
      handle.scale.setScalar(size);
      handle.userData = { key, normal: new Vector3(normal[0], normal[1] * view.stretch, normal[2]).normalize() };
    }
  }

  /** What can be pointed at. */
  targets() {
    return [...this.cuts.values()].map(({ mesh }) => mesh)
      .concat(this.bodies, this.tubes ? [this.tubes] : [], this.barriers, this.ground ? [this.ground] : [])
      .filter((object) => object.visible);
  }

  /** What a ray hits first, and where that is in the model: {place, kind, …}; null for nothing. */
  hit(x, y) {
    for (const { object, point, faceIndex, face, uv: _, ...rest } of this.view.hits(x, y, this.targets())) {
      const place = [point.x, point.y / this.view.stretch, point.z];
      if (object === this.tubes) return { kind: 'hole', place, hole: this.tubeHoles[face.a] };
      const cut = [...this.cuts.values()].find(({ mesh }) => mesh === object)?.cut;
      const cell = cut ? cut.cell[faceIndex] : object.userData.cell?.[faceIndex];
      if (cell !== undefined) {
        const shift = this.shift(this.model.cells.region[cell]);
        const inside = place.map((value, k) => value - shift[k]);
        if (cut && painting.cutoff.value > -1e29) {
          const found = this.levelIn(cell, inside);
          if (!(found >= painting.cutoff.value)) continue;  // not drawn there
        }
        return { kind: 'cell', place: inside, cell, rest };
      }
      return { kind: object === this.ground ? 'ground' : 'barrier', place, barrier: object.userData };
    }
    return null;
  }

  levelIn(cell, place) {
    const { points, corners } = this.model.cells;
    const own = corners.subarray(4 * cell, 4 * cell + 4);
    const weights = barycentric(points, [...own].map((v) => 3 * v), place);
    return weights.reduce((sum, w, k) => sum + w * this.property.levels[own[k]], 0);
  }

  /** All values at a place in a cell, as people read them. */
  valuesIn(cell, weights) {
    const { corners } = this.model.cells;
    return this.model.properties.map((property) => {
      const levels = [0, 1, 2, 3].map((k) => property.levels[corners[4 * cell + k]]);
      if (property.classes) return property.classes[levels[weights.indexOf(Math.max(...weights))]]?.name ?? '–';
      const level = levels.reduce((sum, l, k) => sum + (weights[k] === 0 ? 0 : weights[k] * l), 0);
      return isMissing(level) ? NaN : fromScale(property, level);
    });
  }
}
