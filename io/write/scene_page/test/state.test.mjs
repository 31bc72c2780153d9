// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { numberText, ticks, volumeText } from '../src/scale.js';
import { fromHash, toHash } from '../src/state.js';

test('a state comes back from the address bar, and only what differs is there', () => {
  const defaults = { p: 'CU', cut: 0.6, on: false, eye: [1, 2], iso: [] };
  const state = { p: 'a & b=c', cut: 1 / 3, on: true, eye: [1, -2.5], iso: [0.1] };
  assert.equal(toHash(defaults, defaults), '');
  const back = fromHash(`#${toHash(state, defaults)}`, defaults);
  assert.deepEqual({ ...back, cut: 0 }, { ...state, cut: 0 });
  assert.ok(Math.abs(back.cut - 1 / 3) < 1e-9);
  assert.deepEqual(fromHash('#cut=x&nonsense&other=1&eye=1,b', defaults), defaults);
});

test('ticks are round numbers within the range, decades on a logarithmic scale', () => {
  assert.deepEqual(ticks({ scale: 'linear' }, 0, 1).map(({ value }) => Number(value.toFixed(6))), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual(ticks({ scale: 'log10' }, -12, -8).map(({ label }) => label), ['1e\u221212', '1e\u221211', '1e\u221210', '1e\u22129', '1e\u22128'].map((t) => t.replace('\u2212', '-')));
  assert.deepEqual(ticks({ scale: 'log10' }, 0, 2).map(({ value }) => value), [1, 2, 5, 10, 20, 50, 100]);
  assert.equal(ticks({ scale: 'linear' }, 3, 3).length, 1);
});

test('numbers are written as people do', () => {
  assert.equal(numberText(-0.25), '\u22120.25');
  assert.equal(numberText(1234567), '1.235e6');
  assert.equal(numberText(1234567, 7), '1234567');
  assert.equal(numberText(NaN), '–');
  assert.equal(volumeText(2.5e9), '2.5 km³');
  assert.equal(volumeText(12345.6), '12,350 m³');
});
