// SPDX-License-Identifier: MIT
// Points and directions as arrays of three numbers.

export const add = (a, b, factor = 1) => a.map((value, i) => value + factor * b[i]);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const normalize = (a) => a.map((value) => value / Math.sqrt(dot(a, a)));
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** Holds a point between two corners of a box. */
export const within = (low, high) => (at) => at.map((value, i) => clamp(value, low[i], high[i]));

/** Right, up and forward of a camera {eye, target, up}; y is up where that is left out. */
export function basis({ eye, target, up = [0, 1, 0] }) {
  const forward = normalize(add(target, eye, -1));
  const right = normalize(cross(forward, up));
  return { right, up: cross(right, forward), forward };
}
