// SPDX-License-Identifier: MIT
// The derivation in homogeneous clip coordinates, with a triangle that may reach behind the eye: W passes through 0 and
// below, and the weights of what is seen stay right.
import { showDerivation, termsOf } from '../derivation.js';
import { say } from '../language.js';
import { formulaIn, short } from '../math.js';
import { element, fill, write } from '../slots.js';
import { METHOD, PATTERN } from '../stage.js';
import { takeable } from '../taken.js';
import { chapterTerms } from '../tips.js';
import { TopView } from '../topview.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const NEAR = 0.5;
const AXES = ['X', 'Y', 'Z', 'W'];

// X, Y, Z, W of A, B and C, and of P as their mixture: the three equations that the derivation begins with.
function showCoordinates(table, terms) {
  fill(table, () => {
    fill(element(table, 'tr'), (row) => {
      write(element(row, 'th'), say({ en: 'corner', zh: '顶点' }));
      AXES.forEach((axis) => fill(element(row, 'th', 'axis'), (cell) => formulaIn(cell, axis)));
    });
    for (const name of ['A', 'B', 'C', 'P']) {
      fill(element(table, 'tr', terms[`W_${name}`] <= 0 ? 'behind' : ''), (row) => {
        write(element(row, 'td'), name);
        for (const term of AXES.map((axis) => `${axis}_${name}`)) {
          fill(element(row, 'td', 'value'), (cell) => formulaIn(cell, term, { [term]: short(terms[term]) }));
        }
      });
    }
  });
}

const SOME_BEHIND = {
  en: 'Not all corners are in front of the eye: where W is below 0, dividing would put a corner on the wrong side, and where it is 0 nothing can be divided by it. Only what lies beyond the near plane, a plane a little in front of the eye, is filled. Its r, s, t may be negative or large; a, b, c are not.',
  zh: '并非所有顶点都在眼睛前方：W 小于 0 时，除以它会把顶点放到错误的一侧；W 等于 0 时无法相除。只填充比近平面（眼前不远处的一个平面）更远的部分；其 r、s、t 可能为负或很大，而 a、b、c 不会。',
};
// By how many corners are not in front of the eye.
const BEHIND = [
  { en: 'All corners are in front of the eye.', zh: '所有顶点都在眼睛前方。' },
  SOME_BEHIND,
  SOME_BEHIND,
  { en: 'All corners are behind the eye: nothing is seen.', zh: '所有顶点都在眼睛后方：什么也看不到。' },
];

function showBehind(note, corners) {
  const behind = corners.filter((corner) => corner.at[2] > -1e-9).length; // the eye is at 0
  write(note, say(BEHIND[behind]));
}

export function start(section, stage) {
  const corners = [
    { at: [-1.6, -0.9, -3.4], color: [1, 0.55, 0.5], uv: [0, 0] },
    { at: [1.9, 0.9, -4.2], color: [0.55, 0.9, 0.6], uv: [1, 0] },
    { at: [0.2, -0.55, 0.6], color: [0.6, 0.7, 1], uv: [0.5, 1] },
  ];
  const scene = {
    camera: { eye: [0, 0, 0], target: [0, 0, -1], yfov: 60, near: NEAR, far: 50 },
    corners,
    limit: within([-2.8, -2, -5.5], [2.8, 2, 1.4]),
    triangleOf: () => corners,
    draw: (to) => to.triangle(corners, METHOD.correct, PATTERN.checker),
  };
  const panel = section.querySelector('.derivation');
  const [table, note] = [section.querySelector('table.clip'), section.querySelector('.behind')];
  const view = new View(stage, section.querySelector('.view'), scene, (numbers, pixel, size) => {
    if (view.writes) {
      showDerivation(panel, numbers, pixel, size);
      showBehind(note, corners);
      table.hidden = !numbers;
      if (numbers) {
        showCoordinates(table, termsOf(numbers));
      }
    }
    top.update(numbers);
  });
  const planes = [
    { distance: 0, name: 'W = 0' },
    { distance: NEAR, name: { en: 'near', zh: '近平面' } },
  ];
  const top = new TopView(section.querySelector('.above'), view, { x: [-3.4, 3.4], z: [-5.6, 1.6] }, planes);
  chapterTerms(section, () => view.numbers && termsOf(view.numbers), [view, top]);
  takeable(section, view, {
    changed(taken) {
      top.reach(taken);
      top.planes[1].distance = scene.camera.near;
    },
  });
  view.pick([0.45, 0.62]);
  return view;
}
