// SPDX-License-Identifier: MIT
// What lies over a picture and belongs to the triangle that is explained: its outline with the names of its corners, the pixel
// P, and the place of a term that is pointed at.
import { fill } from './slots.js';
import { drawn, points, set, svg } from './svg.js';
import { clamp } from './vector.js';

// The terms that are a share of the triangle, by the corner they belong to; corners by their names.
const PARTS = { r: 0, s: 1, t: 2, a: 0, b: 1, c: 2, e_A: 0, e_B: 1, e_C: 2 };
const CORNERS = { A: 0, B: 1, C: 2 };

/** The clip coordinates of the corners of an explained triangle. */
export const cornersOf = (n) => [0, 1, 2].map((i) => ['X', 'Y', 'Z', 'W'].map((axis) => n[`${axis}_${i}`]));

/** Clip coordinates to places in a picture of [width, height]; null behind the eye. */
export const onScreen = ([x, y, , w], [width, height]) =>
  w > 1e-6 ? [((x / w + 1) / 2) * width, ((1 - y / w) / 2) * height] : null;

export class Overlay {
  #shown = {};

  /** In an <svg> that covers the picture. */
  constructor(root) {
    this.root = root;
    this.outline = svg(root, 'g', { class: 'outline' });
    this.part = svg(root, 'polygon', { class: 'part' });
    this.ray = svg(root, 'g', { class: 'rays' });
    this.mark = svg(root, 'g', { class: 'mark' });
    svg(this.mark, 'circle', { class: 'under', r: 5 });
    svg(this.mark, 'circle', { r: 5 });
    svg(this.mark, 'text', { x: 8, y: -8 }, 'P');
    this.place({ size: [1, 1] });
  }

  /**
   * `size`: of the picture, CSS pixels; `pixel`: P, by parts of it; `numbers`: those of P; `named`: whether the corners have their
   * names already; `polygon`: clip coordinates of another outline. Any may be missing.
   */
  place({ size, pixel, numbers, named, polygon }) {
    this.#shown = { size, p: pixel && pixel.map((part, i) => part * size[i]), numbers };
    set(this.root, { viewBox: `0 0 ${size[0]} ${size[1]}` });
    this.mark.toggleAttribute('hidden', !pixel);
    if (pixel) {
      set(this.mark, { transform: `translate(${this.#shown.p})` });
    }
    fill(this.outline, () => {
      const cut = polygon?.map((clip) => onScreen(clip, size));
      if (cut?.every(Boolean)) {
        drawn(this.outline, 'polygon', { points: points(cut) });
      }
      if (numbers && !named) {
        this.#placeOutline(size, cornersOf(numbers).map((clip) => onScreen(clip, size)));
      }
    });
    this.point(this.term);
  }

  #placeOutline([width, height], on) {
    if (!on.every(Boolean)) {
      return;
    }
    drawn(this.outline, 'polygon', { points: points(on) });
    on.forEach(([x, y], i) => {
      const at = { x: clamp(x, 14, width - 14), y: clamp(y, 18, height - 8), class: `corner${'ABC'[i]}` };
      drawn(this.outline, 'text', at, 'ABC'[i]);
    });
  }

  /** Shows where a term is in the picture; null: none. What has a corner's name belongs to the corner, weights to a part. */
  point(term) {
    this.term = term;
    const { p, numbers, size } = this.#shown;
    const on = numbers && cornersOf(numbers).map((clip) => onScreen(clip, size));
    const i = PARTS[term];
    const corner = CORNERS[term?.split('_')[1]];
    const showPart = on && p && i !== undefined && on[(i + 1) % 3] && on[(i + 2) % 3];
    set(this.part, {
      points: showPart ? points([p, on[(i + 1) % 3], on[(i + 2) % 3]]) : '',
      class: `part corner${'ABC'[i]}`,
    });
    const at = on && corner !== undefined ? on[corner] : term?.endsWith('_P') ? p : null;
    fill(this.ray, () => at && drawn(this.ray, 'circle', { cx: at[0], cy: at[1], r: 16 }));
  }
}
