// SPDX-License-Identifier: MIT
// Exercises that the page checks: one triangle, naive on the left and correct on the right, and what to do with it. An answer
// speaks of the triangle as the reader left it.
import { termsOf } from '../derivation.js';
import { hearNumbers } from '../heard.js';
import { say, whenLanguage } from '../language.js';
import { short } from '../math.js';
import { sizeOf } from '../size.js';
import { METHOD, PATTERN } from '../stage.js';
import { chapterTerms } from '../tips.js';
import { TopView } from '../topview.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const NEAR = 0.3;
const GRID = 48; // pixels across the small picture in which the largest error is looked for
const REST = 400; // ms that the pointer or a corner rests until it is looked at
const SAME = 0.03; // parts by which two W may differ and be one: some pixels under a finger
const ALIKE = 0.01; // by which two shares may
const MIDDLE = 0.05; // by which the shares of an edge's ends may differ from a half: a finger finds it

const START = [
  [-1.3, -0.7, 0.4],
  [1.4, -0.6, -2.6],
  [0.1, 1.1, -0.6],
];

const naiveOf = (n) => n.r * n.u_0 + n.s * n.u_1 + n.t * n.u_2;
const wOf = (n) => [n.W_0, n.W_1, n.W_2];
const spread = (list) => (Math.max(...list) - Math.min(...list)) / Math.max(...list.map(Math.abs));
const percent = (part) => `${Math.round(100 * part)} %`;

/**
 * Each: what is asked; `met(n, world)`, whether it is so, of the numbers of the pixel (null where none is) and {ws, worst()}: W of
 * the corners and the largest error in the picture; `answer(n, world)`: {en, zh}, with the reader's own numbers.
 */
export const EXERCISES = [
  {
    asked: {
      en: 'Make the naive side correct without touching its formula: move corners nearer or farther until the checkerboard no longer breaks at the line. What had to become equal?',
      zh: '不改公式，让“未校正”那边也画对：拉近或推远顶点，直到棋盘格在分界线处不再错开。什么必须变得相等？',
    },
    met: (_, { ws }) => Math.min(...ws) > 0 && spread(ws) < SAME,
    answer: (_, { ws }) => ({
      en: `All W: yours are ${ws.map(short).join(', ')}. Then 1/W is the same everywhere, and r, s, t are a, b, c. A triangle that is parallel to the screen needs no division.`,
      zh: `三个 W 相等：现在是 ${ws.map(short).join('、')}。这时 1/W 处处相同，r、s、t 就是 a、b、c。与屏幕平行的三角形不需要除法。`,
    }),
  },
  {
    asked: {
      en: 'With all corners in front of the eye, point at the pixel where the naive value is most wrong. Nine tenths of the largest error will do.',
      zh: '所有顶点都在眼睛前方时，指向“未校正”误差最大的像素（达到最大误差的九成即可）。',
    },
    met: (n, { ws, worst }) => n && Math.min(...ws) > 0 && worst() > 0.01 && Math.abs(naiveOf(n) - n.u) > 0.9 * worst(),
    answer: (n, { ws }) => {
      const [low, high] = [Math.min(...ws), Math.max(...ws)];
      const at = Math.sqrt(high) / (Math.sqrt(high) + Math.sqrt(low));
      return {
        en: `Here u is ${short(n.u)} and the naive value is ${short(naiveOf(n))}. From a corner at W = ${short(low)} to one at ${short(high)} the gap is widest where the screen says ${percent(at)} of the way and space ${percent(1 - at)}: the split goes by √W, not by W.`,
        zh: `这里 u 是 ${short(n.u)}，“未校正”得到 ${short(naiveOf(n))}。从 W = ${short(low)} 的顶点到 ${short(high)} 的顶点，差距最大处是屏幕上走了 ${percent(at)}、空间中走了 ${percent(1 - at)} 的地方：按 √W 分，而不是按 W。`,
      };
    },
  },
  {
    asked: {
      en: 'Point at the middle of the edge AB: the middle in space, not in the picture.',
      zh: '指向边 AB 的中点：是空间中的中点，不是画面上的。',
    },
    met: (n) => n && n.W_0 > 0 && n.W_1 > 0 && Math.abs(n.a - 0.5) < MIDDLE && Math.abs(n.b - 0.5) < MIDDLE,
    answer: (n) => ({
      en: `There r : s is W_A : W_B = ${short(n.W_0)} : ${short(n.W_1)}, so s = ${short(n.W_1 / (n.W_0 + n.W_1))}. In space A and B have a half each there; on the screen their shares are in proportion to their W.`.replaceAll('_', ''),
      zh: `那里 r : s = WA : WB = ${short(n.W_0)} : ${short(n.W_1)}，所以 s = ${short(n.W_1 / (n.W_0 + n.W_1))}。在空间中，两个顶点在中点各占一半；在屏幕上，两者的份额与各自的 W 成正比。`,
    }),
  },
  {
    asked: {
      en: 'Away from the edges, find a pixel where C has the same share on the screen as in space: t = c. What is special about P?',
      zh: '找一个离边较远的像素，使 C 在屏幕上与空间中的份额相同（t = c）。P 有什么特别之处？',
    },
    met: (n, { ws }) => n && spread(ws) > 0.1 && Math.min(n.r, n.s, n.t) > 0.05 && Math.abs(n.t - n.c) < ALIKE,
    answer: (n) => ({
      en: `c = t · W of P / W of C: they are equal where P is as far away as C. Here W is ${short(1 / n.inverse_w)} in P, ${short(n.W_2)} in C.`,
      zh: `c = t · P 的 W / C 的 W：P 与 C 一样远时两者相等。这里 P 的 W 是 ${short(1 / n.inverse_w)}，C 的是 ${short(n.W_2)}。`,
    }),
  },
  {
    asked: {
      en: 'Make the naive side correct along one edge alone: give A and B the same distance, and C another one.',
      zh: '让“未校正”只在一条边上正确：使 A、B 一样远，而 C 不同。',
    },
    met: (_, { ws: [a, b, c] }) => Math.min(a, b) > 0 && spread([a, b]) < SAME && spread([a, c]) > 0.1,
    answer: (_, { ws: [a, , c] }) => ({
      en: `All along AB the distance W is ${short(a)}, so there the naive value is correct. It no longer is on the way to C, where W is ${short(c)}.`,
      zh: `AB 上 W 处处是 ${short(a)}，所以在那里“未校正”也正确；朝 C（W = ${short(c)}）走就偏了。`,
    }),
  },
  {
    asked: {
      en: 'Make the W of a corner negative, and point at what is still seen. Are a, b, c still between 0 and 1? Are r, s, t?',
      zh: '让某个顶点的 W 变为负数，再指向仍可见的部分。a、b、c 还在 0 与 1 之间吗？r、s、t 呢？',
    },
    met: (n, { ws }) => n && Math.min(...ws) < 0,
    answer: (n) => ({
      en: `a, b, c = ${[n.a, n.b, n.c].map(short).join(', ')} and r, s, t = ${[n.r, n.s, n.t].map(short).join(', ')}. In space P lies within the triangle, whichever corner is behind the eye. On the screen it does not lie between the places of the corners. The formula never asked for W > 0.`,
      zh: `a、b、c = ${[n.a, n.b, n.c].map(short).join('、')}，r、s、t = ${[n.r, n.s, n.t].map(short).join('、')}。无论哪个顶点在眼睛后方，P 在空间中总在三角形内；在屏幕上，它却不在各顶点的像之间。公式从未要求 W > 0。`,
    }),
  },
];

class Exercise {
  constructor(list, exercise) {
    Object.assign(this, exercise);
    this.node = list.appendChild(document.createElement('li'));
    this.text = this.node.appendChild(document.createElement('p'));
    this.result = this.node.appendChild(document.createElement('p'));
    this.result.className = 'result';
    this.result.setAttribute('aria-live', 'off');
    this.button = this.node.appendChild(document.createElement('button'));
    this.button.type = 'button';
    this.done = false;
    this.told = '';
  }

  // Once it is solved the answer stays, about the triangle of that moment.
  look(numbers, world) {
    if (!this.done && this.met(numbers, world)) {
      this.done = true;
      this.told = this.answer(numbers, world);
      this.node.classList.add('done');
    }
    this.retell();
  }

  retell() {
    this.text.textContent = say(this.asked);
    this.result.textContent = this.done ? `✓ ${say(this.told)}` : '';
    this.button.hidden = !this.done;
    this.button.textContent = say({ en: 'once more', zh: '再做一次' });
  }

  again() {
    this.done = false;
    this.node.classList.remove('done');
  }
}

export function start(section, stage) {
  const colors = [[1, 0.5, 0.42], [0.5, 0.9, 0.55], [0.55, 0.66, 1]];
  const uvs = [[0, 0], [1, 0], [0.5, 1]];
  const corners = START.map((at, i) => ({ at: [...at], color: colors[i], uv: uvs[i] }));
  const scene = {
    camera: { eye: [0, 0.1, 3], target: [0, 0.1, 0], yfov: 50, near: NEAR, far: 50 },
    corners,
    split: 0.5,
    limit: within([-2.6, -1.4, -5], [2.6, 1.8, 4]),
    triangleOf: () => corners,
    draw(to, { canvas }) {
      const middle = Math.round(this.split * canvas.width);
      to.triangle(corners, METHOD.naive, PATTERN.checker, 0, middle);
      to.triangle(corners, METHOD.correct, PATTERN.checker, middle, canvas.width);
    },
  };
  // The largest error of a small picture, both of whose halves are drawn correctly: u is right in all of its pixels.
  const worst = () => {
    const [wide, high] = sizeOf(view.figure);
    const [width, height] = [GRID, Math.round((GRID * high) / wide)];
    stage.resize(width, height, 1);
    stage.camera(scene.camera);
    stage.clear([0, 0, 0]);
    stage.triangle(corners, METHOD.correct, PATTERN.checker);
    let most = 0;
    for (let i = 0; i < width * height; i++) {
      const n = stage.explain(i % width, Math.floor(i / width));
      most = n ? Math.max(most, Math.abs(naiveOf(n) - n.u)) : most;
    }
    return most;
  };
  const list = section.querySelector('.exercises');
  const exercises = EXERCISES.map((exercise) => new Exercise(list, exercise));
  const check = (numbers) => {
    const ws = corners.map((corner) => view.stageClip(corner.at)[3]);
    const correct = numbers && { ...numbers, u: numbers.a * numbers.u_0 + numbers.b * numbers.u_1 + numbers.c * numbers.u_2 };
    exercises.forEach((exercise) => exercise.look(correct, { ws, worst }));
  };
  let touched = false; // an exercise is not solved by nobody
  let resting;
  const look = (numbers) => {
    // Whoever passes over a place has not pointed at it.
    clearTimeout(resting);
    resting = setTimeout(() => touched && check(numbers), REST);
    hearNumbers(view.figure, numbers);
    top.update(numbers);
  };
  const view = new View(stage, section.querySelector('.view'), scene, look);
  const top = new TopView(section.querySelector('.above'), view, { x: [-3, 3], z: [-5.2, 4.2] });
  for (const kind of ['pointerdown', 'keydown', 'pointermove']) {
    section.addEventListener(kind, () => (touched = true), { once: true });
  }
  exercises.forEach((exercise) => exercise.button.addEventListener('click', () => {
    exercise.again();
    corners.forEach((corner, i) => (corner.at = [...START[i]]));
    view.pixel = null;
    view.numbers = null;
    view.update();
    exercise.retell();
  }));
  whenLanguage(() => exercises.forEach((exercise) => exercise.retell()));
  chapterTerms(section, () => view.numbers && termsOf(view.numbers), [view, top]);
  return view;
}
