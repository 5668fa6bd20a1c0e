// SPDX-License-Identifier: MIT
// Every pixel: a floor and a triangle whose corners can be dragged, naive on the left and correct on the right of a line, with the
// derivation of the pixel that is pointed at, and the same as a program.
import { Code, codeTerms } from '../code.js';
import { showDerivation, termsOf } from '../derivation.js';
import { METHOD, PATTERN } from '../stage.js';
import { takeable } from '../taken.js';
import { chapterTerms } from '../tips.js';
import { TopView } from '../topview.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const white = [1, 1, 1];
const FLOOR = [
  { at: [-2, 0, -3], color: white, uv: [0, 0] },
  { at: [-2, 0, 1.7], color: white, uv: [0, 1] },
  { at: [2, 0, 1.7], color: white, uv: [1, 1] },
  { at: [2, 0, -3], color: white, uv: [1, 0] },
];
const TRIANGLES = [
  [FLOOR[0], FLOOR[1], FLOOR[2]],
  [FLOOR[0], FLOOR[2], FLOOR[3]],
];

export function start(section, stage) {
  const corners = [
    { at: [-0.9, 0.15, 0.75], color: [1, 0.15, 0.1], uv: [0, 0] },
    { at: [1.15, 0.25, -1.6], color: [0.1, 0.85, 0.2], uv: [1, 0] },
    { at: [0.45, 1.3, 0.25], color: [0.2, 0.35, 1], uv: [0.5, 1] },
  ];
  const triangles = [...TRIANGLES, corners];
  const scene = {
    camera: { eye: [0, 1.5, 3], target: [0, 0.5, 0], yfov: 42, near: 0.1, far: 50 },
    corners,
    split: 0.5,
    limit: within([-2.5, 0, -2.5], [2.5, 2.2, 2.2]),
    triangleOf: (draw) => (scene.taken ? corners : triangles[draw % 3]),
    draw(to, { canvas }) {
      const middle = Math.round(this.split * canvas.width);
      for (const [method, first, end] of [
        [METHOD.naive, 0, middle],
        [METHOD.correct, middle, canvas.width],
      ]) {
        if (!this.taken) {
          TRIANGLES.forEach((triangle) => to.triangle(triangle, method, PATTERN.floor, first, end));
        }
        to.triangle(corners, method, PATTERN.checker, first, end);
      }
    },
  };
  const panel = section.querySelector('.derivation');
  const code = new Code(section);
  const terms = () => view.numbers && codeTerms(termsOf(view.numbers));
  const view = new View(stage, section.querySelector('.view'), scene, (numbers, pixel, size) => {
    if (view.writes) {
      showDerivation(panel, numbers, pixel, size);
      code.show(terms());
    }
    top.update(numbers);
  });
  const top = new TopView(section.querySelector('.above'), view, { x: [-2.6, 2.6], z: [-2.6, 3.1] });
  chapterTerms(section, terms, [view, top]);
  takeable(section, view, { changed: (taken) => top.reach(taken) });
  view.pick([0.57, 0.5]);
  return view;
}
