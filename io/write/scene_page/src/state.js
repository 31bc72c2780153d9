// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The state of the page in the address bar: only what differs from the first view.

const encode = (value) => (Array.isArray(value) ? value.map(encode).join(',')
  : typeof value === 'boolean' ? String(Number(value))
    : typeof value === 'number' ? String(Number(value.toPrecision(10)))
      : encodeURIComponent(value));

function decode(text, like) {
  if (Array.isArray(like)) return text === '' ? [] : text.split(',').map((part) => (like.textual ? decodeURIComponent(part) : Number(part)));
  if (typeof like === 'boolean') return text === '1';
  if (typeof like === 'number') return Number(text);
  return decodeURIComponent(text);
}

export function toHash(state, defaults) {
  return Object.keys(defaults).filter((key) => encode(state[key]) !== encode(defaults[key]))
    .map((key) => `${key}=${encode(state[key])}`).join('&');
}

/** What cannot be read is as it is by default. */
export function fromHash(hash, defaults) {
  const state = { ...defaults };
  for (const pair of hash.replace(/^#/, '').split('&')) {
    const [key, text] = [pair.split('=')[0], pair.slice(pair.indexOf('=') + 1)];
    if (!(key in defaults) || !pair.includes('=')) continue;
    const value = decode(text, defaults[key]);
    const numbers = Array.isArray(value) ? value : [value];
    if (numbers.every((n) => typeof n !== 'number' || Number.isFinite(n))) state[key] = value;
  }
  return state;
}
