// SPDX-License-Identifier: MIT
// A picture of few, large pixels, step by step: clip coordinates, the division, what the raster mixes, and the recovery of u.
import { choice } from '../controls.js';
import { termsOf } from '../derivation.js';
import { say } from '../language.js';
import { formula, short } from '../math.js';
import { cornersOf } from '../overlay.js';
import { METHOD, PATTERN } from '../stage.js';
import { chapterTerms } from '../tips.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const COLUMNS = 64;

// What each step shows: its picture, and of every corner and of P the terms of a table.
const STEPS = {
  clip: { pattern: PATTERN.colors, terms: ['X', 'Y', 'Z', 'W'] },
  divide: { pattern: PATTERN.colors, terms: ['x', 'y', 'column', 'row', 'd', 'i'] },
  raster: { pattern: PATTERN.uvOverW, terms: ['i', 'q'] },
  recover: { pattern: PATTERN.uv, terms: ['u'] },
};
// Formulas for the columns that are no plain term; a place on the screen is rounded to 1/256 pixel.
const HEADS = {
  x: '[X|W]',
  y: '[Y|W]',
  column: { en: 'column', zh: '列' },
  row: { en: 'row', zh: '行' },
  d: '[Z|W]',
  i: '[1|W]',
  q: '[u|W]',
};

// The terms of every corner and of P, those of the division and of the raster among them, and of the corners that clipping
// made: [{name, clip}..].
function stepTerms(n, polygon, [width, height]) {
  const terms = termsOf(n);
  for (const { name, clip } of polygon) {
    ['X', 'Y', 'Z', 'W'].forEach((axis, i) => (terms[`${axis}_${name}`] = clip[i]));
  }
  for (const name of [...new Set(['A', 'B', 'C', 'P', ...polygon.map((corner) => corner.name)])]) {
    const over = 1 / terms[`W_${name}`];
    const round = (value) => Math.round(value * 256) / 256;
    terms[`x_${name}`] = terms[`X_${name}`] * over;
    terms[`y_${name}`] = terms[`Y_${name}`] * over;
    terms[`column_${name}`] = round(((1 + terms[`x_${name}`]) / 2) * width);
    terms[`row_${name}`] = round(((1 - terms[`y_${name}`]) / 2) * height);
    terms[`d_${name}`] = terms[`Z_${name}`] * over;
    terms[`i_${name}`] = over;
    terms[`q_${name}`] = terms[`u_${name}`] * over;
  }
  return terms;
}

// What the near plane, Z = 0, leaves of a triangle: Sutherland and Hodgman's walk round it.
function clipped(corners) {
  const polygon = [];
  corners.forEach((clip, i) => {
    const [name, next] = ['ABC'[i], (i + 1) % 3];
    const other = corners[next];
    if (clip[2] >= 0) {
      polygon.push({ name, clip });
    }
    if (clip[2] >= 0 !== other[2] >= 0) {
      const k = clip[2] / (clip[2] - other[2]);
      const at = clip.map((value, axis) => value + k * (other[axis] - value));
      polygon.push({ name: [name, 'ABC'[next]].sort().join(''), clip: at });
    }
  });
  return polygon;
}

function showTable(table, terms, step, polygon) {
  table.replaceChildren();
  const row = (cells, tag) => {
    const line = table.insertRow();
    cells.forEach((cell) => line.appendChild(document.createElement(tag)).append(cell));
    return line;
  };
  const names = STEPS[step].terms;
  row([say({ en: 'corner', zh: '顶点' }), ...names.map((name) => formula(say(HEADS[name] ?? name)))], 'th');
  const left = polygon.map(({ name }) => name);
  const all = { clip: [...new Set(['A', 'B', 'C', ...left])], divide: left }[step] ?? ['A', 'B', 'C'];
  for (const corner of [...all, 'P']) {
    const cells = names.map((name) => `${name}_${corner}`);
    const line = row([corner, ...cells.map((term) => formula(term, { [term]: short(terms[term]) }))], 'td');
    line.classList.toggle('behind', step === 'clip' && 'ABC'.includes(corner) && !left.includes(corner));
  }
}

export function start(section, stage) {
  const corners = [
    { at: [-0.5, -0.42, -0.8], color: [1, 0.2, 0.15], uv: [0, 0] },
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
    outline: (n) => (n ? clipped(cornersOf(n)).map(({ clip }) => clip) : null),
    draw(to) {
      to.triangle(corners, METHOD.correct, STEPS[this.step].pattern);
    },
  };
  const table = section.querySelector('table.step');
  const view = new View(stage, section.querySelector('.view'), scene, (numbers, _pixel, size) => {
    table.hidden = !numbers;
    if (numbers) {
      const polygon = clipped(cornersOf(numbers));
      showTable(table, stepTerms(numbers, polygon, size), scene.step, polygon);
    }
  });
  choice(section, 'step', (value) => {
    scene.step = value;
    section.querySelectorAll('[data-step]').forEach((node) => (node.hidden = node.dataset.step !== value));
    view.update();
  });
  chapterTerms(
    section,
    () => view.numbers && stepTerms(view.numbers, clipped(cornersOf(view.numbers)), view.size),
    [view],
  );
  view.pick([0.43, 0.5]);
  return view;
}
