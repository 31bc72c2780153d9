// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Legend, strip log and the saved picture: what explains the colours.
import { byId, make, rows, svg } from './dom.js';
import { colorAt, css, numberText, tickStep, ticks, toScale } from './scale.js';

/** With the unit, once: a column's header may say it itself. */
export function titleOf({ name, unit }) {
  return !unit || name.endsWith(`(${unit})`) || name.endsWith(`[${unit}]`) ? name : `${name} [${unit}]`;
}

export function drawLegend(box, property, anchors, [low, high]) {
  const parts = [make('h2', {}, titleOf(property))];
  if (property.classes) {
    parts.push(classList(property.classes));
  } else {
    const ramp = make('canvas', { width: 1, height: 128 });
    const context = ramp.getContext('2d');
    for (let y = 0; y < 128; ++y) {
      context.fillStyle = css(colorAt(anchors, 1 - y / 127));
      context.fillRect(0, y, 1, 1);
    }
    const list = make('ol', {});
    for (const { fraction, label } of ticks(property, low, high)) {
      const item = make('li', {}, label);
      item.style.top = `${100 * (1 - fraction)}%`;
      list.append(item);
    }
    parts.push(make('div', { class: 'ramp' }, ramp, list));
  }
  const grey = make('i');
  grey.style.background = 'rgb(199, 201, 207)';
  parts.push(make('div', {}, grey, 'no value or out of reach'));
  box.replaceChildren(...parts);
}

function classList(classes) {
  return make('ol', {}, ...classes.map(({ name, color }) => {
    const swatch = make('i');
    swatch.style.background = color;
    return make('li', {}, swatch, name);
  }));
}

/** A borehole's log beside the scene: depth downwards, a bar an interval. */
export function drawStrip(box, hole, intervals, property, index, anchors, [low, high], unit, close) {
  const own = [];
  for (let i = 0; intervals && i < intervals.hole.length; ++i) if (intervals.hole[i] === hole.index) own.push(i);
  const length = Math.max(hole.length, ...own.map((i) => intervals.depth[i] + 0.5 * intervals.length[i]), 1e-9);
  const [width, height, top] = [176, 600, 14];
  const y = (depth) => top + (height - top - 6) * depth / length;
  const drawing = svg('svg', { viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: 'none', role: 'img', 'aria-label': `log of ${hole.id}` });
  const step = tickStep(length * 0.6);
  for (let depth = 0; depth <= length; depth += step) {
    drawing.append(svg('line', { x1: 38, x2: width, y1: y(depth), y2: y(depth), stroke: 'currentColor', opacity: 0.15 }),
                   svg('text', { x: 34, y: y(depth) + 3, 'text-anchor': 'end' }, numberText(depth, 6)));
  }
  let known = 0;
  for (const i of own) {
    const value = property.own ? NaN : intervals.values[index][i];
    const level = toScale(property, value);
    const thick = Math.max(y(intervals.length[i]) - y(0), 1.2);
    const middle = y(intervals.depth[i]);
    if (Number.isNaN(level)) continue;
    ++known;
    const t = property.classes ? 1 : Math.min(1, Math.max(0.02, (level - low) / (high - low || 1)));
    const color = property.classes ? property.classes[level]?.color : css(colorAt(anchors, (level - low) / (high - low || 1)));
    const label = property.classes ? property.classes[level]?.name : numberText(value);
    drawing.append(svg('rect', { x: 42, y: middle - thick / 2, width: t * (width - 44), height: thick, fill: color },
                       svg('title', {}, `${numberText(intervals.depth[i], 6)} ${unit}: ${label}`)));
  }
  box.replaceChildren(
    make('h2', {}, make('button', { class: 'close', title: 'Close', onclick: close }, '×'), hole.id),
    rows([['length', `${numberText(hole.length, 6)} ${unit}`], ['collar', hole.collar.map((x) => numberText(x, 9)).join(', ')],
          [titleOf(property), `${known} of ${own.length} intervals`]]), drawing);
  box.hidden = false;
}

/** The scene with title and legend as one picture. */
export function picture(view, title, property, anchors, [low, high]) {
  view.drawNow();
  const source = view.renderer.domElement;
  const canvas = make('canvas', { width: source.width, height: source.height });
  const scale = source.width / source.clientWidth;
  const context = canvas.getContext('2d');
  const style = getComputedStyle(document.documentElement);
  context.fillStyle = style.getPropertyValue('--back');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(source, 0, 0);
  context.scale(scale, scale);
  const [width, height] = [source.clientWidth, source.clientHeight];
  context.fillStyle = style.getPropertyValue('--text');
  context.font = '600 17px "DejaVu Sans", sans-serif';
  context.fillText(title, 16, 28);
  context.font = '12px "DejaVu Sans", sans-serif';
  context.fillText(byId('honesty').textContent, 16, height - 12);
  const top = height - 250;
  context.fillText(titleOf(property), width - 150, top - 12);
  if (property.classes) {
    property.classes.slice(0, 12).forEach(({ name, color }, i) => {
      context.fillStyle = color;
      context.fillRect(width - 150, top + 18 * i, 13, 13);
      context.fillStyle = style.getPropertyValue('--text');
      context.fillText(name, width - 130, top + 11 + 18 * i);
    });
  } else {
    for (let i = 0; i < 200; ++i) {
      context.fillStyle = css(colorAt(anchors, 1 - i / 199));
      context.fillRect(width - 150, top + i, 20, 1.5);
    }
    context.fillStyle = style.getPropertyValue('--text');
    for (const { fraction, label } of ticks(property, low, high)) context.fillText(label, width - 122, top + 200 * (1 - fraction) + 4);
  }
  return canvas;
}
