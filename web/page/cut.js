// SPDX-License-Identifier: MIT
// What the near plane, Z = 0, makes of a triangle's clip coordinates.

/** The place so far from p to q, 0..1, in as many coordinates as they have. */
export const between = (p, q, part) => p.map((value, i) => value + (q[i] - value) * part);

/** The part of a line beyond the near plane, [from, to], or null. */
export function cutLine(from, to) {
  if (from[2] < 0 && to[2] < 0) {
    return null;
  }
  const edge = () => between(from, to, from[2] / (from[2] - to[2]));
  return [from[2] < 0 ? edge() : from, to[2] < 0 ? edge() : to];
}

/**
 * The parts of a triangle beyond the near plane and before it, by Sutherland and Hodgman's walk round it: each [{name, clip}..]. A
 * corner that was made on the edge from A to B is AB.
 */
export function cutTriangle(clips) {
  const sides = [[], []];
  clips.forEach((clip, i) => {
    const next = (i + 1) % 3;
    sides[clip[2] < 0 ? 1 : 0].push({ name: 'ABC'[i], clip });
    if (clip[2] < 0 !== clips[next][2] < 0) {
      const at = between(clip, clips[next], clip[2] / (clip[2] - clips[next][2]));
      const corner = { name: ['ABC'[i], 'ABC'[next]].sort().join(''), clip: at };
      sides.forEach((side) => side.push(corner));
    }
  });
  return sides;
}
