// SPDX-License-Identifier: MIT
// A picture of few, large pixels, step by step: clip coordinates, the division, what the raster mixes, and the recovery of u.
import { choice } from '../controls.js';
import { termsOf } from '../derivation.js';
import { language } from '../language.js';
import { formula, short } from '../math.js';
import { METHOD, PATTERN } from '../stage.js';
import { chapterTerms } from '../tips.js';
import { View } from '../view.js';
import { within } from './first.js';

const COLUMNS = 64;

// What each step shows: its picture, and of every corner and of P the terms of a table.
const STEPS = {
  clip: { pattern: PATTERN.colors, terms: ['X', 'Y', 'Z', 'W'] },
  divide: { pattern: PATTERN.colors, terms: ['x', 'y', 'column', 'row', 'd', 'i'] },
  raster: { pattern: PATTERN.uvOverW, terms: ['i', 'q'] },
  recover: { pattern: PATTERN.uv, terms: ['u'] },
};
// Formulas for the columns that are no plain term; a place on the screen is rounded to 1/256 pixel.
const HEADS = { x: '[X|W]', y: '[Y|W]', d: '[Z|W]', i: '[1|W]', q: '[u|W]', u: 'u' };

// The terms of every corner and of P, those of the division and of the raster among them.
function stepTerms(n) {
  const terms = termsOf(n);
  for (const axis of ['X', 'Y', 'Z']) {
    terms[`${axis}_P`] = terms.a * terms[`${axis}_A`] + terms.b * terms[`${axis}_B`] + terms.c * terms[`${axis}_C`];
  }
  terms.u_P = n.u;
  for (const name of ['A', 'B', 'C', 'P']) {
    const over = 1 / terms[`W_${name}`];
    terms[`x_${name}`] = terms[`X_${name}`] * over;
    terms[`y_${name}`] = terms[`Y_${name}`] * over;
    terms[`d_${name}`] = terms[`Z_${name}`] * over;
    terms[`i_${name}`] = over;
    terms[`q_${name}`] = terms[`u_${name}`] * over;
  }
  ['A', 'B', 'C', 'P'].forEach((name, i) => {
    terms[`column_${name}`] = n[`x_${i < 3 ? i : 'P'}`] / 256;
    terms[`row_${name}`] = n[`y_${i < 3 ? i : 'P'}`] / 256;
  });
  return terms;
}

function showTable(table, terms, step) {
  table.replaceChildren();
  table.lang = language();
  const row = (cells, tag) => {
    const line = table.insertRow();
    cells.forEach((cell) => line.appendChild(document.createElement(tag)).append(cell));
  };
  const names = STEPS[step].terms;
  row(['', ...names.map((name) => formula(HEADS[name] ?? name))], 'th');
  for (const corner of ['A', 'B', 'C', 'P']) {
    const cells = names.map((name) => `${name}_${corner}`);
    row([corner, ...cells.map((term) => formula(term, { [term]: short(terms[term]) }))], 'td');
  }
}

export function start(section, stage) {
  const corners = [
    { at: [-1.2, -0.85, -2], color: [1, 0.2, 0.15], uv: [0, 0] },
    { at: [3.6, -0.4, -6], color: [0.2, 0.8, 0.3], uv: [1, 0] },
    { at: [-0.5, 1.2, -3], color: [0.3, 0.45, 1], uv: [0, 1] },
  ];
  const scene = {
    camera: { eye: [0, 0, 0], target: [0, 0, -1], yfov: 50, near: 1, far: 12 },
    corners,
    width: COLUMNS,
    samples: 1,
    limit: within([-4, -2, -9], [6, 2, -0.4]),
    triangleOf: () => corners,
    draw(to) {
      to.triangle(corners, METHOD.correct, STEPS[this.step].pattern);
    },
  };
  const table = section.querySelector('table.step');
  const view = new View(stage, section.querySelector('.view'), scene, (numbers) => {
    table.hidden = !numbers;
    if (numbers) {
      showTable(table, stepTerms(numbers), scene.step);
    }
  });
  choice(section, 'step', (value) => {
    scene.step = value;
    section.querySelectorAll('[data-step]').forEach((node) => (node.hidden = node.dataset.step !== value));
    view.update();
  });
  chapterTerms(section, () => view.numbers && stepTerms(view.numbers), [view]);
  view.pick([0.43, 0.5]);
  return view;
}
