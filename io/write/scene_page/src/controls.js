// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The panel, the pointer and the keys: all that changes the state.
import { cellAt } from './cells.js';
import { byId, make, rows, svg } from './dom.js';
import { drawLegend, drawStrip, picture } from './legend.js';
import { sectionKeys } from './layers.js';
import { fromScale, numberText, tickStep, toScale, volumeText } from './scale.js';
import { toHash } from './state.js';
import { linesOf } from './view.js';

const names = { ew: 'E–W, y', ns: 'N–S, x', level: 'level, z' };

export class Controls {
  constructor(model, view, layers) {
    Object.assign(this, { model, view, layers });
    this.panel = byId('panel');
    this.active = 'ew';
    this.measuring = null;
    this.build();
    this.listen();
    this.resize();
  }

  defaults() {
    const { info, properties } = this.model;
    const { min, max } = this.trueBox();
    const textual = [];
    textual.textual = true;
    return {
      p: properties[info.property]?.name ?? properties[0].name, map: info.map, range: [], level: 0.5 * (min[2] + max[2]), free: [45, 90, 0], ...info.sections,
      cut: NaN, cutOn: false, iso: info.iso, isoOn: info.isoOn, holes: true, barriers: true, hidden: textual, ground: true, frame: true,
      edges: false, blocks: false, explode: 0, stretch: info.stretch, handles: true, hole: '', pick: [],
      eye: [], theme: '',
    };
  }

  trueBox() {
    const [a, b] = [this.layers.toTrue(this.layers.box.min), this.layers.toTrue(this.layers.box.max)];
    return { min: a.map((x, k) => Math.min(x, b[k])), max: a.map((x, k) => Math.max(x, b[k])) };
  }

  /** Takes over a state; the panel shows it. */
  apply(state, fresh = false) {
    if (Number.isNaN(state.cut)) state = { ...state, cut: this.defaultCut(state.p) };
    const previous = fresh ? {} : this.state;
    if (previous?.p !== undefined && previous.p !== state.p) {
      state = { ...state, range: [], iso: [], cut: this.defaultCut(state.p), cutOn: false };
    }
    this.state = state;
    this.layers.apply(state, previous ?? {});
    if (fresh) {
      document.documentElement.dataset.theme = state.theme;
      if (state.eye.length === 8) this.setEye(state.eye);
      else this.home();
    }
    this.show();
    this.pick(state.pick);
    this.strip();
    if (!fresh) this.remember();
  }

  set(changes) { this.apply({ ...this.state, ...changes }); }

  remember() {
    clearTimeout(this.remembering);
    this.remembering = setTimeout(() => {
      const defaults = { ...this.defaults(), cut: this.defaultCut(this.state.p) };
      const hash = toHash(this.state, defaults);
      history.replaceState(null, '', `${location.pathname}${location.search}${hash ? `#${hash}` : ''}`);
    }, 250);
  }

  defaultCut(name) {
    const property = this.model.properties.find((other) => other.name === name) ?? this.model.properties[0];
    const level = property.quartiles?.length ? toScale(property, property.quartiles.at(-1)) : 0.5 * (property.low + property.high);
    return Number(fromScale(property, level).toPrecision(3));
  }

  eye() {
    const { camera, controls, stretch } = this.view;
    return [...camera.position.toArray(), ...controls.target.toArray(), stretch, 1].map((x) => Number(x.toPrecision(7)));
  }

  setEye([x, y, z, tx, ty, tz]) {
    this.view.camera.position.set(x, y, z);
    this.view.controls.target.set(tx, ty, tz);
    this.view.clipPlanes();
    this.view.controls.update();
  }

  home() { this.view.lookFrom(this.model.info.azimuth, 24); }

  // ---- the panel

  field(title, ...children) { return make('fieldset', {}, make('legend', {}, title), ...children); }

  /** Of no use for classes. */
  quantity(title, ...children) {
    const field = this.field(title, ...children);
    field.dataset.quantity = '';
    return field;
  }

  check(key, label, more = {}) {
    const input = make('input', { type: 'checkbox', 'data-key': key, onchange: () => this.set({ [key]: input.checked, ...more }) });
    return make('label', {}, input, make('span', {}, label));
  }

  slider(key, label, low, high, digits = 7) {
    const input = make('input', { type: 'range', min: low, max: high, step: 'any', 'data-key': key, 'aria-label': label,
                                  oninput: () => { this.active = key; this.set({ [key]: Number(input.value) }); } });
    return make('label', {}, make('span', {}, label), input, make('output', { 'data-of': key, 'data-digits': digits }));
  }

  build() {
    const { info, properties, intervals } = this.model;
    const { min, max } = this.trueBox();
    const choice = (key, options) => {
      const select = make('select', { 'data-key': key, 'aria-label': key, onchange: () => this.set({ [key]: select.value }) },
                          ...options.map((name) => make('option', { value: name }, name)));
      return select;
    };
    const section = (key, axis) => {
      const row = this.slider(key, names[key], min[axis], max[axis]);
      const box = this.check(`${key}On`, '');
      row.prepend(box.querySelector('input'));
      return row;
    };
    const free = ['azimuth', 'dip', 'offset'].map((label, k) => {
      const span = 0.5 * Math.hypot(...max.map((x, axis) => x - min[axis]));
      const [low, high] = [[0, 360], [0, 90], [-span, span]][k];
      const input = make('input', { type: 'range', min: low, max: high, step: 'any', 'data-free': k, 'aria-label': label,
                                    oninput: () => this.set({ free: this.state.free.map((x, i) => (i === k ? Number(input.value) : x)) }) });
      return make('label', {}, make('span', {}, label), input, make('output', { 'data-free-of': k }));
    });
    this.histogram = svg('svg', { class: 'histogram', viewBox: '0 0 260 62', preserveAspectRatio: 'none', role: 'img', 'aria-label': 'histogram with the range of the colours' });
    const ends = ['low', 'high'].map((label, k) => make('input', { type: 'number', step: 'any', 'aria-label': `${label} end of the colours`, 'data-end': k,
      onchange: (event) => this.setEnd(k, toScale(this.layers.property, Number(event.target.value))) }));
    const cut = make('input', { type: 'number', step: 'any', 'data-key': 'cut', 'aria-label': 'threshold', onchange: () => this.set({ cut: Number(cut.value), cutOn: true }) });
    const cutSlide = make('input', { type: 'range', min: 0, max: 1, step: 'any', 'aria-label': 'threshold', id: 'cut-slide',
      oninput: () => { const [low, high] = this.layers.range(); this.set({ cutOn: true, cut: Number(fromScale(this.layers.property, low + (high - low) * Number(cutSlide.value)).toPrecision(4)) }); } });
    const isoText = make('input', { type: 'text', size: 14, 'aria-label': 'values of the isosurfaces', id: 'iso-text',
      onchange: () => this.set({ iso: isoText.value.split(/[\s,;]+/).filter(Boolean).map(Number).filter(Number.isFinite), isoOn: true }) });
    const find = make('input', { type: 'search', placeholder: 'find', 'aria-label': 'find a borehole', oninput: () => this.filterHoles(find.value) });
    this.holeList = make('ul', { id: 'hole-list' }, ...info.holes.map(({ id }) => make('li', {}, make('button', { onclick: () => this.set({ hole: this.state.hole === id ? '' : id }) }, id))));
    const layer = [this.check('holes', 'boreholes'), this.check('frame', 'extent'), this.check('edges', 'cell edges'), this.check('handles', 'handles of sections')];
    if (this.layers.ground) layer.unshift(this.check('ground', 'ground'));
    const barriers = this.layers.barriers.map(({ userData }) => {
      const input = make('input', { type: 'checkbox', 'data-barrier': userData.name, onchange: () => {
        const hidden = this.state.hidden.filter((name) => name !== userData.name);
        if (!input.checked) hidden.push(userData.name);
        hidden.textual = true;
        this.set({ hidden });
      } });
      return make('label', {}, input, make('span', {}, `${userData.kind} ${userData.name}`), make('output', {}, `${numberText(userData.dip, 3)}° to ${numberText(userData.dip_direction, 3)}°`));
    });
    const height = max[2] - min[2];
    const wide = Math.max(max[0] - min[0], max[1] - min[1]);
    this.panel.append(
      this.field('Property', make('label', {}, choice('p', properties.map(({ name }) => name))), make('label', {}, make('span', {}, 'colours'), choice('map', Object.keys(info.maps))),
                 make('div', { 'data-quantity': '' }, this.histogram, make('label', {}, ...ends))),
      this.field('Sections', section('ew', 1), section('ns', 0), section('level', 2), this.check('freeOn', 'any plane'), ...free),
      this.quantity('Threshold', make('label', {}, this.check('cutOn', 'show ≥').querySelector('input'), make('span', {}, 'show ≥'), cut, make('span', { id: 'cut-unit' })), cutSlide,
                 make('p', { class: 'result', id: 'volume', 'aria-live': 'polite' })),
      this.quantity('Isosurfaces', make('label', {}, this.check('isoOn', '').querySelector('input'), make('span', {}, 'at'), isoText)),
      this.field('Layers', ...layer, ...(info.blocks.length > 1 ? [this.check('blocks', 'blocks'), this.slider('explode', 'apart', 0, 1.5, 2)] : []),
                 ...(barriers.length ? [this.check('barriers', 'faults and horizons'), ...barriers] : [])),
      this.field('Blocks', rows(info.blocks.map(({ name, volume }) => [name, volumeText(volume)]))),
      this.field(`Boreholes (${info.holes.length})`, ...(info.holes.length > 12 ? [make('label', {}, find)] : []), this.holeList),
      this.field('Height', this.slider('stretch', 'stretched ×', 1, Math.max(5, Math.ceil(wide / height)), 3)));
    if (!intervals) this.holeList.hidden = info.holes.length === 0;
    this.dragRange();
  }

  filterHoles(text) {
    for (const item of this.holeList.children) item.hidden = !item.textContent.toLowerCase().includes(text.toLowerCase());
  }

  setEnd(end, level) {
    if (!Number.isFinite(level)) return this.show();
    const range = [...this.layers.range()];
    range[end] = level;
    if (range[0] < range[1]) this.set({ range });
    return undefined;
  }

  /** What the state is, in the panel's controls. */
  show() {
    const { state, layers } = this;
    const { property } = layers;
    for (const input of this.panel.querySelectorAll('[data-key]')) {
      const value = state[input.dataset.key];
      if (input.type === 'checkbox') input.checked = value;
      else if (document.activeElement !== input || input.type !== 'number') input.value = value;
    }
    for (const output of this.panel.querySelectorAll('[data-of]')) output.textContent = numberText(state[output.dataset.of], Number(output.dataset.digits));
    for (const input of this.panel.querySelectorAll('[data-free]')) input.value = state.free[input.dataset.free];
    for (const output of this.panel.querySelectorAll('[data-free-of]')) output.textContent = numberText(state.free[output.dataset.freeOf], 4);
    for (const input of this.panel.querySelectorAll('[data-barrier]')) input.checked = !state.hidden.includes(input.dataset.barrier);
    const [low, high] = layers.range();
    for (const input of this.panel.querySelectorAll('[data-end]')) input.value = Number(fromScale(property, [low, high][input.dataset.end]).toPrecision(4));
    byId('iso-text').value = property.classes ? '' : layers.isoLevels().map((value) => Number(value.toPrecision(4))).join(', ');
    byId('cut-slide').value = (toScale(property, state.cut) - low) / (high - low || 1);
    byId('cut-unit').textContent = property.unit;
    for (const field of this.panel.querySelectorAll('[data-quantity]')) field.hidden = Boolean(property.classes);
    this.drawHistogram(low, high);
    drawLegend(document.querySelector('.legend'), property, layers.anchors(), [low, high]);
    this.showVolume();
  }

  showVolume() {
    const { state, layers, model: { info } } = this;
    const key = [state.p, state.cut, state.cutOn].join();
    if (key === this.volumeKey) return;
    this.volumeKey = key;
    const found = layers.volumeAboveCut();
    const out = byId('volume');
    out.textContent = '';
    delete out.dataset.volume;
    if (!found) return;
    const unit = layers.metres === 1 ? '' : ` = ${numberText(found.above / layers.metres ** 3, 6)} ${info.unit}³`;
    out.textContent = `${volumeText(found.above)}${unit}, ${numberText(100 * found.above / found.all, 4)} % of the model`;
    out.dataset.volume = found.above / layers.metres ** 3;
    out.title = info.blocks.map(({ name }, b) => `${name}: ${volumeText(found.ofBlocks[b])}`).join('\n');
  }

  drawHistogram(low, high) {
    const { property, model: { cells, info } } = { property: this.layers.property, model: this.model };
    if (this.histogramOf !== property) {
      this.histogramOf = property;
      const near = property.levels.filter((l, v) => Number.isFinite(l) && (property.own || cells.far[v] < Math.min(info.reach, 1)));
      const all = near.length > 0 ? near : property.levels.filter(Number.isFinite);
      const sorted = Float64Array.from(all).sort();
      const first = sorted[0] ?? 0;
      const last = sorted.at(-1) ?? 1;
      // Long tails are left out of the picture, the range in force never.
      const cutLow = Math.max(first, property.low - 0.6 * (property.high - property.low));
      const cutHigh = Math.min(last, property.high + 0.6 * (property.high - property.low));
      this.bins = { low: cutLow, high: cutHigh > cutLow ? cutHigh : cutLow + 1, counts: new Array(52).fill(0) };
      for (const l of sorted) {
        const bin = Math.floor(52 * (l - this.bins.low) / (this.bins.high - this.bins.low));
        if (bin >= 0 && bin <= 52) ++this.bins.counts[Math.min(bin, 51)];
      }
    }
    const { counts } = this.bins;
    const most = Math.max(...counts, 1);
    const x = (level) => 260 * Math.min(1, Math.max(0, (level - this.bins.low) / (this.bins.high - this.bins.low)));
    this.histogram.replaceChildren(
      ...counts.map((count, i) => svg('rect', { x: 5 * i, width: 4.2, y: 60 - 56 * count / most, height: 56 * count / most })),
      ...[low, high].map((level) => svg('line', { x1: x(level), x2: x(level), y1: 0, y2: 62 })));
  }

  dragRange() {
    let end = -1;
    const levelAt = (event) => {
      const rect = this.histogram.getBoundingClientRect();
      return this.bins.low + (this.bins.high - this.bins.low) * (event.clientX - rect.left) / rect.width;
    };
    this.histogram.addEventListener('pointerdown', (event) => {
      if (this.layers.property.classes) return;
      const range = this.layers.range();
      const level = levelAt(event);
      end = Math.abs(level - range[0]) < Math.abs(level - range[1]) ? 0 : 1;
      this.histogram.setPointerCapture(event.pointerId);
      this.setEnd(end, level);
    });
    this.histogram.addEventListener('pointermove', (event) => { if (end >= 0) this.setEnd(end, levelAt(event)); });
    this.histogram.addEventListener('pointerup', () => { end = -1; });
  }

  // ---- pointer and keys

  listen() {
    const canvas = this.view.renderer.domElement;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    let down = null;
    canvas.addEventListener('pointerdown', (event) => {
      down = { x: event.clientX, y: event.clientY, key: null };
      const handles = [...this.layers.handles.values()].filter((handle) => handle.visible);
      const [first] = this.view.hits(event.clientX, event.clientY, handles);
      if (!first) return;
      down.key = first.object.userData.key;
      down.axis = first.object.userData.normal.clone();
      down.from = first.object.position.clone();
      down.start = this.along(event, down);
      down.value = down.key === 'free' ? this.state.free[2] : this.state[down.key];
      this.active = down.key;
      this.view.controls.enabled = false;
      canvas.setPointerCapture(event.pointerId);
    }, { capture: true });
    canvas.addEventListener('pointermove', (event) => {
      if (down?.key) this.drag(event, down);
      else if (!down || event.pointerType === 'mouse') this.hover(event);
    });
    canvas.addEventListener('pointerup', (event) => {
      const moved = down && Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4;
      if (down && !down.key && !moved && event.button === 0) this.point(event);
      down = null;
      this.view.controls.enabled = true;
    });
    this.view.controls.addEventListener('end', () => { this.state.eye = this.eye(); this.remember(); });
    this.view.onDraw = () => this.overlays();
    for (const button of document.querySelectorAll('[data-view]')) button.addEventListener('click', () => this.look(button.dataset.view));
    byId('panel-button').addEventListener('click', () => this.togglePanel());
    byId('measure').addEventListener('click', () => this.toggleMeasure());
    byId('save').addEventListener('click', () => this.save());
    byId('theme').addEventListener('click', () => this.toggleTheme());
    byId('help-button').addEventListener('click', () => this.toggleHelp());
    addEventListener('keydown', (event) => this.key(event));
    if (innerWidth < 720) this.togglePanel();
  }

  /** Where along a handle's axis the pointer is. */
  along(event, { from, axis }) {
    const { ray } = this.view.ray(event.clientX, event.clientY);
    const between = from.clone().sub(ray.origin);
    const b = axis.dot(ray.direction);
    const whole = 1 - b * b;
    return Math.abs(whole) < 1e-6 ? 0 : (b * ray.direction.dot(between) - axis.dot(between)) / whole;
  }

  drag(event, down) {
    const moved = (this.along(event, down) - down.start) / this.layers.metres;
    const { min, max } = this.trueBox();
    const axis = { ew: 1, ns: 0, level: 2 }[down.key];
    if (axis === undefined) {
      this.set({ free: [this.state.free[0], this.state.free[1], down.value + moved / (1 + (this.view.stretch - 1) * Math.abs(down.axis.y))] });
      return;
    }
    const sign = down.key === 'ew' ? -1 : 1;  // south is +z in the scene
    const value = down.value + sign * moved / (down.key === 'level' ? this.view.stretch : 1);
    this.set({ [down.key]: Math.min(max[axis], Math.max(min[axis], value)) });
  }

  hover(event) {
    if (this.hovering) return;
    this.hovering = requestAnimationFrame(() => {
      this.hovering = 0;
      const hit = this.layers.hit(event.clientX, event.clientY);
      byId('where').textContent = hit ? this.placeText(this.layers.toTrue(hit.place)) : '';
    });
  }

  placeText(place) {
    const { info } = this.model;
    const text = place.map((x) => x.toFixed(1)).join('  ');
    const globe = this.lonLat(place);
    return `${text}  ${info.unitShort}${globe ? `   ${globe[0].toFixed(6)}° ${globe[1].toFixed(6)}°` : ''}`;
  }

  /** Between the places that the file knows. */
  lonLat([x, y]) {
    const { globe } = this.model.info;
    if (!globe) return null;
    const { count, lo, hi, lon, lat } = globe;
    const place = [x, y].map((value, k) => Math.min(count - 1 - 1e-9, Math.max(0, (count - 1) * (value - lo[k]) / (hi[k] - lo[k]))));
    const [i, j] = place.map(Math.floor);
    const [u, v] = [place[0] - i, place[1] - j];
    const between = (table) => (1 - u) * (1 - v) * table[j * count + i] + u * (1 - v) * table[j * count + i + 1]
      + (1 - u) * v * table[(j + 1) * count + i] + u * v * table[(j + 1) * count + i + 1];
    return [between(lon), between(lat)];
  }

  point(event) {
    const hit = this.layers.hit(event.clientX, event.clientY);
    if (!hit) return;
    const place = this.layers.toTrue(hit.place);
    if (this.measuring) this.measureAt(place);
    else if (hit.kind === 'hole') this.set({ hole: this.model.info.holes[hit.hole].id, pick: [] });
    else if (hit.kind === 'barrier') this.showBarrier(hit.barrier, place);
    else this.set({ pick: place });
  }

  showCard(title, pairs) {
    const box = byId('picked');
    box.replaceChildren(make('button', { class: 'close', title: 'Close', onclick: () => this.set({ pick: [] }) }, '×'), make('h2', {}, title), rows(pairs));
    box.hidden = false;
  }

  showBarrier(barrier, place) {
    const strike = (barrier.dip_direction + 270) % 360;
    this.showCard(`${barrier.kind} ${barrier.name}`, [['dip', `${numberText(barrier.dip, 3)}°`], ['dip direction', `${numberText(barrier.dip_direction, 4)}°`],
                  ['strike', `${numberText(strike, 4)}°`], ['area', `${numberText(barrier.area, 4)} ${this.model.info.unitShort}²`], ['at', this.placeText(place)]]);
  }

  /** Everything that is known at a place. */
  pick(place) {
    if (place.length !== 3) {
      byId('picked').hidden = true;
      return;
    }
    const { cells, properties, info } = this.model;
    const found = cellAt(cells, this.layers.toScene(place));
    const pairs = [['at', this.placeText(place)]];
    if (found) {
      const values = this.layers.valuesIn(found.cell, found.weights);
      properties.forEach((property, p) => {
        const text = typeof values[p] === 'string' ? values[p] : numberText(values[p], 6);
        pairs.push([property.name, property.unit ? `${text} ${property.unit}` : text]);
      });
      const block = info.blocks[cells.region[found.cell] - 1];
      if (block) pairs.push(['block', block.name]);
    } else {
      pairs.push(['', 'outside the model, or within a fault']);
    }
    this.showCard('Here', pairs);
  }

  strip() {
    const { state, layers, model: { info, intervals } } = this;
    for (const item of this.holeList.children) item.firstChild.setAttribute('aria-pressed', String(item.textContent === state.hole));
    const index = info.holes.findIndex(({ id }) => id === state.hole);
    const box = byId('strip');
    if (index < 0) {
      box.hidden = true;
      return;
    }
    drawStrip(box, { ...info.holes[index], index }, intervals, layers.property, layers.propertyIndex, layers.anchors(), layers.range(), info.unitShort,
              () => this.set({ hole: '' }));
  }

  toggleMeasure() {
    this.measuring = this.measuring ? null : [];
    byId('measure').setAttribute('aria-pressed', String(Boolean(this.measuring)));
    if (this.line) {
      this.view.scene.remove(this.line);
      this.line = null;
      this.view.draw();
    }
    byId('where').textContent = this.measuring ? 'Measure: point at two places' : '';
  }

  measureAt(place) {
    this.measuring.push(place);
    if (this.measuring.length < 2) return;
    const [a, b] = this.measuring.slice(-2);
    this.measuring = [];
    const d = b.map((x, k) => x - a[k]);
    const across = Math.hypot(d[0], d[1]);
    const azimuth = (Math.atan2(d[0], d[1]) * 180 / Math.PI + 360) % 360;
    const { unitShort } = this.model.info;
    if (this.line) this.view.scene.remove(this.line);
    const ends = [a, b].flatMap((p) => { const [x, y, z] = this.layers.toScene(p); return [x, y * this.view.stretch, z]; });
    this.line = linesOf(Float32Array.from(ends), '#e8572a');
    this.line.material.depthTest = false;
    this.line.renderOrder = 9;
    this.view.scene.add(this.line);
    this.view.draw();
    this.showCard('Measured', [['distance', `${numberText(Math.hypot(...d), 5)} ${unitShort}`], ['across', `${numberText(across, 5)} ${unitShort}`],
                  ['up', `${numberText(d[2], 5)} ${unitShort}`], ['azimuth', `${numberText(azimuth, 4)}°`], ['plunge', `${numberText(-Math.atan2(d[2], across) * 180 / Math.PI, 3)}°`]]);
  }

  look(name) {
    if (name === 'home') this.home();
    else this.view.lookFrom({ top: 180, south: 180, east: 90 }[name], name === 'top' ? 90 : 0);
    this.state.eye = name === 'home' ? [] : this.eye();
    this.remember();
  }

  togglePanel() {
    this.panel.hidden = !this.panel.hidden;
    document.body.classList.toggle('no-panel', this.panel.hidden);
    byId('panel-button').setAttribute('aria-expanded', String(!this.panel.hidden));
    this.resize();
  }

  toggleTheme() {
    const dark = document.documentElement.dataset.theme === 'dark'
      || (!document.documentElement.dataset.theme && matchMedia('(prefers-color-scheme: dark)').matches);
    document.documentElement.dataset.theme = dark ? 'light' : 'dark';
    this.set({ theme: document.documentElement.dataset.theme });
  }

  toggleHelp() {
    const box = byId('help');
    box.hidden = !box.hidden;
    box.replaceChildren(make('h2', {}, 'Keys'), rows([
      ['0 1 2 3', 'first view, from above, from the south, from the east'], ['← →', 'move the section last touched'], ['t', 'threshold'], ['i', 'isosurfaces'],
      ['e', 'cell edges'], ['b', 'boreholes'], ['f', 'faults'], ['m', 'measure'], ['p', 'save a picture'], ['l', 'light or dark'], ['c', 'controls'], ['Esc', 'close'],
    ]), make('p', {}, 'Drag to turn, with the right button or two fingers to move, wheel to come nearer. Drag an orange handle to move its section. '
                      + 'Click anything for its values. The address keeps what is seen: copy it to show the same.'));
  }

  key(event) {
    if (event.target.matches?.('input, select, textarea') || event.ctrlKey || event.metaKey || event.altKey) return;
    const toggle = (key) => this.set({ [key]: !this.state[key] });
    const step = (sign) => {
      const key = sectionKeys.includes(this.active) && this.active !== 'free' ? this.active : 'ew';
      const axis = { ew: 1, ns: 0, level: 2 }[key];
      const { min, max } = this.trueBox();
      this.set({ [key]: Math.min(max[axis], Math.max(min[axis], this.state[key] + sign * (max[axis] - min[axis]) / 100)), [`${key}On`]: true });
    };
    const actions = {
      0: () => this.look('home'), 1: () => this.look('top'), 2: () => this.look('south'), 3: () => this.look('east'),
      ArrowLeft: () => step(-1), ArrowRight: () => step(1), t: () => toggle('cutOn'), i: () => toggle('isoOn'), e: () => toggle('edges'), b: () => toggle('holes'),
      f: () => toggle('barriers'), m: () => this.toggleMeasure(), p: () => this.save(), l: () => this.toggleTheme(), c: () => this.togglePanel(), '?': () => this.toggleHelp(),
      Escape: () => { byId('help').hidden = true; this.set({ pick: [], hole: '' }); },
    };
    if (actions[event.key]) {
      event.preventDefault();
      actions[event.key]();
    }
  }

  save() {
    picture(this.view, document.title, this.layers.property, this.layers.anchors(), this.layers.range()).toBlob((blob) => {
      const link = make('a', { href: URL.createObjectURL(blob), download: `${document.title}.png` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }

  resize() {
    const canvas = this.view.renderer.domElement;
    const main = canvas.parentElement;
    const left = this.panel.hidden || innerWidth < 720 ? 0 : this.panel.offsetWidth;
    canvas.style.left = `${left}px`;
    canvas.style.width = `${Math.max(50, main.clientWidth - left)}px`;
    this.view.resize(Math.max(50, main.clientWidth - left), Math.max(50, main.clientHeight));
  }

  /** North, scale and stretch, after each drawing. */
  overlays() {
    const { info } = this.model;
    const turn = this.view.controls.getAzimuthalAngle() * 180 / Math.PI;
    const arrow = svg('g', { transform: `rotate(${turn})` }, svg('path', { class: 'grid', d: 'M0,-34 L8,8 L0,2 L-8,8 Z' }));
    if (info.convergence !== undefined) arrow.append(svg('line', { class: 'true', x1: 0, y1: 0, x2: 0, y2: -36, transform: `rotate(${-info.convergence})` }));
    const up = turn * Math.PI / 180;
    arrow.append(svg('title', {}, info.convergence === undefined ? 'grid north' : `red: grid north; line: true north, ${numberText(-info.convergence, 3)}° clockwise of it`));
    byId('compass').replaceChildren(arrow, svg('text', { x: 43 * Math.sin(up), y: -43 * Math.cos(up) }, 'N'));
    const { camera, controls, renderer } = this.view;
    const perPixel = 2 * camera.position.distanceTo(controls.target) * Math.tan(camera.fov * Math.PI / 360) / renderer.domElement.clientHeight;
    const size = tickStep(6 * 130 * perPixel);
    const bar = byId('scale-bar');
    bar.firstElementChild.style.width = `${size / perPixel}px`;
    const stretch = this.view.stretch === 1 ? '' : `, heights × ${numberText(this.view.stretch, 3)}`;
    bar.lastElementChild.textContent = `${size >= 1000 ? `${size / 1000} km` : `${size} m`}${stretch}`;
  }
}
