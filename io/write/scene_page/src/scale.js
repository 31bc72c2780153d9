// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values, their scales, and how they are written.

export const nodata = -3.4028234663852886e38;
/** Stands for a missing value in shaders; no measured quantity is that small. */
export const missing = -1e30;

export const isMissing = (value) => !(value > -1e37);

export function toScale(property, value) {
  if (isMissing(value)) return NaN;
  if (property.scale === 'log10') return value > 0 ? Math.log10(value) : NaN;
  return value;
}

export const fromScale = (property, scaled) => (property.scale === 'log10' ? 10 ** scaled : scaled);

/** As a person writes it, with a minus that is one. */
export function numberText(value, digits = 4) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  let text;
  if (size !== 0 && (size < 1e-3 || size >= 10 ** Math.max(5, digits))) {
    const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 1)).split('e');
    text = `${String(Number(mantissa))}e${Number(exponent)}`;
  } else {
    text = String(Number(value.toPrecision(digits)));
  }
  return text.replace(/^-/, '\u2212');
}

export function tickStep(span) {
  const rough = span / 6;
  const power = 10 ** Math.floor(Math.log10(rough));
  return ([1, 2, 5].find((digit) => rough <= digit * power) ?? 10) * power;
}

/** Round numbers within a range that is given in the property's scale: {value, fraction, label}. */
export function ticks(property, low, high) {
  if (!(high > low)) return [{ value: fromScale(property, low), fraction: 0.5, label: numberText(fromScale(property, low)) }];
  const values = [];
  const linear = (a, b) => {
    const step = tickStep(b - a);
    for (let k = Math.ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; ++k) values.push(k * step);
  };
  if (property.scale !== 'log10') linear(low, high);
  else if (high - low < 0.7) linear(10 ** low, 10 ** high);
  else {
    const every = Math.max(1, Math.ceil((high - low) / 8));
    for (let d = Math.floor(low); d <= high; ++d) {
      for (const digit of [1, 2, 5]) {
        const exponent = d + Math.log10(digit);
        const wanted = digit === 1 ? d % every === 0 : high - low < 3;
        if (wanted && exponent >= low - 1e-9 && exponent <= high + 1e-9) values.push(Number(`${digit}e${d}`));
      }
    }
  }
  return values.map((value) => ({
    value,
    fraction: Math.min(1, Math.max(0, (toScale(property, value) - low) / (high - low))),
    label: numberText(value),
  }));
}

/** Between a map's anchors, as text for style sheets and as bytes. */
export function colorAt(anchors, t) {
  const place = Math.min(1, Math.max(0, t)) * (anchors.length - 1);
  const i = Math.min(Math.floor(place), anchors.length - 2);
  const f = place - i;
  const channel = (hex, k) => parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16);
  return [0, 1, 2].map((k) => Math.round(channel(anchors[i], k) * (1 - f) + channel(anchors[i + 1], k) * f));
}

export const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;

/** Of a volume in cubic metres. */
export function volumeText(cubicMetres) {
  for (const [size, name] of [[1e9, 'km³'], [1, 'm³']]) {
    if (Math.abs(cubicMetres) >= size * (size > 1 ? 0.1 : 0)) {
      const text = Number((cubicMetres / size).toPrecision(4)).toLocaleString('en', { maximumSignificantDigits: 4 });
      return `${text} ${name}`;
    }
  }
  return '0 m³';
}
