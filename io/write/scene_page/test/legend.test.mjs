// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { titleOf } from '../src/legend.js';

test('a title says the unit once', () => {
  assert.equal(titleOf({ name: 'CU', unit: '%' }), 'CU [%]');
  assert.equal(titleOf({ name: 'As (ug/L)', unit: 'ug/L' }), 'As (ug/L)');
  assert.equal(titleOf({ name: 'K (field)', unit: 'm/s' }), 'K (field) [m/s]');
  assert.equal(titleOf({ name: 'pH', unit: '' }), 'pH');
});
