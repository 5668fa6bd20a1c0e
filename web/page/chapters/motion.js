// SPDX-License-Identifier: MIT
// One motion from clip space through the division to the screen, by a slider; the picture of few, large pixels that comes of it,
// with what the raster mixes and what the division gives back; and the numbers of each.
import { choice, distanceSlider } from '../controls.js';
import { cutTriangle } from '../cut.js';
import { termsOf } from '../derivation.js';
import { Flight } from '../flight.js';
import { nextFrame } from '../frame.js';
import { hear } from '../heard.js';
import { say, whenLanguage } from '../language.js';
import { formulaIn, short } from '../math.js';
import { cornersOf } from '../overlay.js';
import { sizeOf } from '../size.js';
import { element, fill, text } from '../slots.js';
import { METHOD, PATTERN } from '../stage.js';
import { takeable } from '../taken.js';
import { chapterTerms } from '../tips.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const [COLUMNS, ROWS] = [64, 36];
const NEAR = 1;
const SECONDS = 4; // of the motion, played
const FARTHEST = 6; // W that a triangle of another picture gets in the drawing

// What is drawn in the pixels.
const PICTURES = { colors: PATTERN.colors, raster: PATTERN.uvOverW, recover: PATTERN.uv };
// Of every corner and of P the terms of a table: before the division, after it, and what the raster makes of them.
const STEPS = {
  clip: ['X', 'Y', 'Z', 'W'],
  divide: ['x', 'y', 'column', 'row', 'd', 'i'],
  raster: ['i', 'q', 'u'],
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
const ROUND = ['x', 'y', 'd']; // within −1..1: four places behind the point say all
const WIDEST = 380; // CSS pixels that the columns of the division take at most
const SPOKEN = { x: 'X/W', y: 'Y/W', column: HEADS.column, row: HEADS.row, d: 'Z/W', i: '1/W', q: 'u/W' };

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

// The corners of what the near plane leaves of the explained triangle.
const clipped = (n) => cutTriangle(cornersOf(n))[0];

// A row of a table. Cells are names, or {formula, values}.
function rowIn(table, kind, cells) {
  fill(element(table, 'tr', kind), (row) => {
    for (const { tag = 'td', name, formula, values } of cells) {
      fill(element(row, tag, formula ? 'value' : ''), (node) => (formula ? formulaIn(node, formula, values) : text(node, name)));
    }
  });
}

const named = (name) => ({ tag: 'th', name });

// Where there is no room for all columns, a corner is one of them, and what is told of it are the rows.
function showTable(table, terms, step, polygon) {
  const names = STEPS[step];
  const left = polygon.map(({ name }) => name);
  const all = { clip: [...new Set(['A', 'B', 'C', ...left])], divide: left }[step] ?? ['A', 'B', 'C'];
  const corners = [...all, 'P'];
  const head = named(say({ en: 'corner', zh: '顶点' }));
  const headOf = (name) => ({ tag: 'th', formula: say(HEADS[name] ?? name) });
  const cell = (name, corner) => {
    const term = `${name}_${corner}`;
    return { formula: term, values: { [term]: short(ROUND.includes(name) ? Number(terms[term].toFixed(4)) : terms[term]) } };
  };
  fill(table, () => {
    if (sizeOf(table.parentElement)[0] < WIDEST && names.length > corners.length) {
      rowIn(table, '', [head, ...corners.map(named)]);
      names.forEach((name) => rowIn(table, '', [headOf(name), ...corners.map((corner) => cell(name, corner))]));
      return;
    }
    rowIn(table, '', [head, ...names.map(headOf)]);
    for (const corner of corners) {
      const isBehind = step === 'clip' && 'ABC'.includes(corner) && !left.includes(corner);
      rowIn(table, isBehind ? 'behind' : '', [{ name: corner }, ...names.map((name) => cell(name, corner))]);
    }
  });
}

const SAID = [
  { en: 'Clip space: X, Y and W as the vertex shader gave them. What is nearer than the near plane is cut off.', zh: '裁剪空间：X、Y、W 是顶点着色器给出的值。比近平面更近的部分被切掉。' },
  { en: 'Every point moves along its line to the eye. What is farther shrinks more.', zh: '每个点沿着通向眼睛的直线移动；越远的缩得越多。' },
  { en: 'The screen: X/W and Y/W. Lines are still lines, but equal steps are no longer equal.', zh: '屏幕：X/W 与 Y/W。直线仍是直线，但原来等距的点不再等距。' },
];

// The slider, and the motion played once when it is first seen, unless the reader wants none.
class Motion {
  constructor(section, flight, view, changed) {
    Object.assign(this, { flight, view, changed });
    this.slider = section.querySelector('[name="k"]');
    this.said = section.querySelector('.said-of-motion');
    this.slider.addEventListener('input', () => {
      this.playing = false;
      this.isSet = true;
      this.show();
      changed();
    });
    section.querySelector('.play').addEventListener('click', () => this.play());
    whenLanguage(() => this.show());
    if (!matchMedia('(prefers-reduced-motion: reduce)').matches) {
      const seen = new IntersectionObserver((entries) => {
        if (entries.at(-1).isIntersecting) {
          seen.disconnect();
          this.isSet || this.play();
        }
      }, { threshold: 0.8 });
      seen.observe(flight.root);
    }
  }

  get k() {
    return Number(this.slider.value);
  }

  play() {
    this.playing = true;
    this.started = undefined;
    nextFrame(this.#step);
  }

  #step = (time) => {
    this.started ??= time;
    const part = Math.min((time - this.started) / 1000 / SECONDS, 1);
    if (this.playing) {
      this.slider.value = part * part * (3 - 2 * part);
      this.show();
      this.changed();
      if (part < 1) {
        setTimeout(() => nextFrame(this.#step)); // of this frame all is drawn already
      } else {
        this.playing = false;
      }
    }
  };

  show() {
    const { view, k } = this;
    if (!view.clips) {
      view.stage.resize(COLUMNS, ROWS, 1); // the motion may be seen before its picture
    }
    this.flight.show(view.scene.corners.map(({ at }) => view.stageClip(at)), k);
    const text = say(SAID[k === 0 ? 0 : k < 1 ? 1 : 2]);
    if (this.said.textContent !== text) {
      this.said.textContent = text;
    }
    this.flight.root.setAttribute('aria-label', text);
  }
}

export function start(section, stage) {
  const corners = [
    { at: [-0.5, -0.42, 0.4], color: [1, 0.2, 0.15], uv: [0, 0] },
    { at: [3.6, -0.4, -6], color: [0.2, 0.8, 0.3], uv: [1, 0] },
    { at: [-0.5, 1.2, -3], color: [0.3, 0.45, 1], uv: [0, 1] },
  ];
  const scene = {
    camera: { eye: [0, 0, 0], target: [0, 0, -1], yfov: 50, near: NEAR, far: 12 },
    corners,
    width: COLUMNS,
    samples: 1,
    limit: within([-4, -2, -9], [6, 2, 1.2]),
    triangleOf: () => corners,
    outline: (n) => (n ? clipped(n).map(({ clip }) => clip) : null),
    draw(to) {
      to.triangle(corners, METHOD.correct, PICTURES[this.picture]);
    },
  };
  const table = section.querySelector('table.step');
  const flight = new Flight(section.querySelector('.flight-room'), 16 / 9);
  const tell = (view) => {
    table.hidden = !view.numbers;
    if (view.numbers) {
      const polygon = clipped(view.numbers);
      const step = scene.picture === 'colors' ? (motion.k < 0.5 ? 'clip' : 'divide') : 'raster';
      const terms = stepTerms(view.numbers, polygon, view.size);
      showTable(table, terms, step, polygon);
      hear(table, `P: ${STEPS[step].map((name) => `${say(SPOKEN[name] ?? name)} ${short(terms[`${name}_P`])}`).join(', ')}`);
    }
  };
  const view = new View(stage, section.querySelector('.view'), scene, () => {
    showDistance();
    motion.show();
    tell(view);
  });
  const showDistance = distanceSlider(section, view, corners[0]);
  const slider = section.querySelector('[name="distance"]');
  const { min, max } = slider;
  const motion = new Motion(section, flight, view, () => tell(view));
  choice(section, 'picture', (value) => {
    scene.picture = value;
    section.querySelectorAll('[data-picture]').forEach((node) => (node.hidden = node.dataset.picture !== value));
    view.update();
  });
  chapterTerms(
    section,
    () => view.numbers && stepTerms(view.numbers, clipped(view.numbers), view.size),
    [view],
  );
  takeable(section, view, {
    nearer: 0.5,
    changed(taken) {
      const w = corners.map(({ at }) => -at[2]);
      flight.unit = taken ? Number((Math.max(...w) / FARTHEST).toPrecision(2)) : 1;
      slider.min = taken ? 0.2 * Math.min(...w) : min;
      slider.max = taken ? 2 * Math.max(...w) : max;
    },
  });
  view.pick([0.5, 0.45]);
  return view;
}
