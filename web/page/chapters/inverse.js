// SPDX-License-Identifier: MIT
// In the plane: an edge AB in front of the eye, its picture A'B', and a point between them. Halfway on the screen is not halfway
// in space, and the distance W of the point is not the mixture of the distances, but 1/W is that of 1/W. Beside it the curves of
// W, 1/W, u/W and u over the screen, and the edge's stripes as they are seen.
import { choice } from '../controls.js';
import { hearNumbers } from '../heard.js';
import { say, whenLanguage } from '../language.js';
import { formulaIn, short } from '../math.js';
import { nameDrawing, percentOf } from '../naming.js';
import { legend, Plot } from '../plot.js';
import { sizeOf } from '../size.js';
import { element, fill, text as gap, write } from '../slots.js';
import { numbersIn, numbersText } from '../state.js';
import { draggable, points, set, svg } from '../svg.js';
import { takenNote } from '../taken.js';
import { chapterTerms } from '../tips.js';
import { clamp } from '../vector.js';

const RANGE = { x: [-3.2, 3.2], z: [-0.3, 7.4] }; // of the drawing; the eye is at 0
const SCREEN = 2; // its distance: 1 would be as good, and smaller
const FARTHEST = 6.8; // an end of an edge of another picture, in the drawing
const NAME = 76; // CSS pixels that the name of an end takes
const ASIDE = 0.44; // its ends are seen so far to the left and to the right
const OWN = [[-2, 3], [2.7, 7]];

const CAPTIONS = [{ en: 'eye', zh: '眼睛' }, { en: 'screen', zh: '屏幕' }];

class Drawing {
  constructor(node, changed) {
    this.ends = OWN.map((end) => [...end]);
    this.unit = 1; // of length: what the drawing's is in the numbers
    this.screenAt = SCREEN;
    this.q = 0.5;
    this.changed = changed;
    this.root = svg(node, 'svg', { class: 'top' });
    nameDrawing(this.root, { en: 'The edge AB, the eye and the screen, from above', zh: '俯视图：线段 AB、眼睛与屏幕' });
    this.rays = [0, 1, 2].map(() => svg(this.root, 'line', { class: 'ray' }));
    this.screen = svg(this.root, 'line', { class: 'plane' });
    this.edge = svg(this.root, 'line', { class: 'edge' });
    this.picture = svg(this.root, 'line', { class: 'picture' });
    this.half = svg(this.root, 'circle', { class: 'half', r: 4 });
    svg(this.root, 'circle', { class: 'eye', r: 5 });
    this.handles = this.ends.map((end, i) => this.#end(end, 'AB'[i]));
    this.p = this.#mark('P', { en: 'P on the edge', zh: '线段上的 P' });
    draggable(this.p, {
      move: (dx, dy) => this.#slideAlong(dx / this.scale, -dy / this.scale),
      step: (dx, dy) => this.#slideAlong(dx / 20, -dy / 20),
      ends: (part) => this.set(part),
    });
    this.shadow = this.#mark("P'", { en: "P' on the screen", zh: "屏幕上的 P'" });
    this.pictures = ["A'", "B'"].map((name) => svg(this.root, 'text', { class: 'caption' }, name));
    this.names = CAPTIONS.map(() => svg(this.root, 'text', { class: 'caption' }));
    draggable(this.shadow, {
      move: (dx) => this.#slide(dx / this.scale),
      step: (dx) => this.#slide(dx / 100),
      ends: (part) => this.set(part),
    });
    new ResizeObserver(() => this.update()).observe(node);
  }

  #end(end, name) {
    const node = svg(this.root, 'g', { class: `handle corner${name}`, tabindex: 0, role: 'button' });
    whenLanguage(() => node.setAttribute('aria-label', say({ en: `end ${name} of the edge: arrow keys`, zh: `端点 ${name}：方向键移动` })));
    svg(node, 'circle', { class: 'reach', r: 18 });
    svg(node, 'circle', { class: 'dot', r: 7 });
    svg(node, 'text', { x: 11, y: 5 }, name);
    const by = (dx, dy) => {
      end[0] = clamp(end[0] + dx / this.scale, -3.2, 3.2);
      end[1] = clamp(end[1] - dy / this.scale, 1.1 * this.screenAt, 7.2);
      this.update();
    };
    draggable(node, { move: by, step: (dx, dy) => by(4 * dx, 4 * dy) });
    return node;
  }

  #mark(name, label) {
    const node = svg(this.root, 'g', { class: 'handle mark', tabindex: 0, ...percentOf(0) });
    whenLanguage(() => node.setAttribute('aria-label', say(label)));
    svg(node, 'circle', { class: 'reach', r: 16 });
    svg(node, 'circle', { r: 6 });
    svg(node, 'text', { x: 10, y: 16 }, name);
    return node;
  }

  // P along the edge: q follows from its weight there.
  #slideAlong(dx, dz) {
    const [[x1, z1], [x2, z2]] = this.ends;
    const length = (x2 - x1) ** 2 + (z2 - z1) ** 2;
    if (length < 1e-9) {
      return; // A is B, and P is there
    }
    const b = clamp(this.numbers().b + (dx * (x2 - x1) + dz * (z2 - z1)) / length, 0, 1);
    this.set((b * z2) / ((1 - b) * z1 + b * z2));
  }

  /** By a part of the picture A'B'. */
  slideBy(part) {
    this.set(this.q + part);
  }

  #slide(dx) {
    const [from, to] = this.ends.map(([x, z]) => (this.screenAt * x) / z);
    this.set(this.q + (Math.abs(to - from) < 0.01 ? 0 : dx / (to - from)));
  }

  set(q) {
    this.q = clamp(q, 0, 1);
    this.update();
  }

  // Weights on the screen and in space, and the distances W.
  numbers() {
    const [wA, wB] = this.ends.map(([, z]) => z * this.unit);
    const [r, s] = [1 - this.q, this.q];
    const inverse = r / wA + s / wB;
    const [a, b] = [r / wA / inverse, s / wB / inverse];
    return { r, s, W_A: wA, W_B: wB, W_P: 1 / inverse, a, b };
  }

  #at([x, z]) {
    const [width, height] = sizeOf(this.root);
    return [width / 2 + x * this.scale, height - 14 - (z - RANGE.z[0]) * this.scale];
  }

  #line(node, from, to) {
    const [[x1, y1], [x2, y2]] = [this.#at(from), this.#at(to)];
    set(node, { x1, y1, x2, y2 });
  }

  // Where an end has its name: on its outer side, or where there is no room below the nearer one and above the other.
  #beside(x, isLeft, isNear) {
    const fits = isLeft ? x > NAME : x < sizeOf(this.root)[0] - NAME;
    const away = fits ? 11 : 8;
    return { x: isLeft ? -away : away, y: fits ? 5 : isNear ? 24 : -14, 'text-anchor': isLeft === fits ? 'end' : 'start' };
  }

  update() {
    const [width, height] = sizeOf(this.root);
    if (!width) {
      return;
    }
    this.scale = Math.min(width / (RANGE.x[1] - RANGE.x[0]), (height - 28) / (RANGE.z[1] - RANGE.z[0]));
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    const { a, b, ...terms } = this.numbers();
    const [from, to] = this.ends;
    const p = [a * from[0] + b * to[0], a * from[1] + b * to[1]];
    [from, to, p].forEach((end, i) => this.#line(this.rays[i], [0, 0], end));
    this.#line(this.screen, [-2.4, this.screenAt], [2.4, this.screenAt]);
    this.#line(this.edge, from, to);
    const onScreen = ([x, z]) => [(this.screenAt * x) / z, this.screenAt];
    this.#line(this.picture, onScreen(from), onScreen(to));
    this.ends.forEach((end, i) => {
      const [left, top] = this.#at(onScreen(end));
      set(this.pictures[i], { x: left + (i === 0 ? -22 : 8), y: top - 8 });
    });
    const middle = this.#at([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2]);
    set(this.half, { cx: middle[0], cy: middle[1] });
    const eye = this.#at([0, 0]);
    set(this.root.querySelector('.eye'), { cx: eye[0], cy: eye[1] });
    const rim = this.#at([2.4, this.screenAt]);
    set(this.names[0], { x: eye[0] + 12, y: eye[1] + 5 });
    set(this.names[1], { x: rim[0], y: rim[1] + 16, 'text-anchor': 'end' });
    this.names.forEach((node, i) => write(node, say(CAPTIONS[i])));
    this.ends.forEach((end, i) => {
      set(this.handles[i], { transform: `translate(${this.#at(end)})` });
      set(this.handles[i].lastChild, this.#beside(this.#at(end)[0], end[0] < this.ends[1 - i][0], end[1] < this.ends[1 - i][1]));
      write(this.handles[i].lastChild, `${'AB'[i]}, W = ${short(Number(terms[`W_${'AB'[i]}`].toPrecision(3)))}`);
    });
    set(this.p, { transform: `translate(${this.#at(p)})`, ...percentOf(b) });
    set(this.shadow, { transform: `translate(${this.#at(onScreen(p))})`, ...percentOf(this.q) });
    this.changed();
  }

  /** The edge AB of a triangle with these clip coordinates, and the point of it where A and B have their shares on the screen. */
  take({ clips, screen }) {
    const [wA, wB] = clips.map((clip) => clip[3]);
    this.#measure(Math.max(wA, wB) / FARTHEST);
    this.ends = [[-ASIDE, wA / this.unit], [ASIDE, wB / this.unit]].map(([x, z]) => [x * z, z]);
    this.screenAt = Math.min(SCREEN, 0.8 * this.ends[0][1], 0.8 * this.ends[1][1]);
    this.set(screen[1] / (screen[0] + screen[1]));
  }

  /** The edge that it had first. */
  giveBack() {
    this.#measure(1);
    this.ends = OWN.map((end) => [...end]);
    this.screenAt = SCREEN;
    this.set(0.5);
  }

  #measure(unit) {
    this.unit = unit;
    this.isTaken = unit !== 1;
  }

  /** {name: text} for the page's address. */
  save() {
    const [A, B] = this.ends.map(numbersText);
    return { A, B, q: numbersText([this.q]), ...(this.isTaken ? { taken: numbersText([this.unit, this.screenAt]) } : {}) };
  }

  restore(values) {
    const [unit, screenAt] = numbersIn(values, 'taken', 2) ?? [1, SCREEN];
    this.#measure(unit > 1e-30 ? unit : 1);
    this.screenAt = clamp(screenAt, 0.01, SCREEN);
    this.ends.forEach((end, i) => {
      const [x, z] = numbersIn(values, 'AB'[i], 2) ?? end;
      end[0] = clamp(x, -3.2, 3.2);
      end[1] = clamp(z, 1.1 * this.screenAt, 7.2);
    });
    this.set((numbersIn(values, 'q', 1) ?? [this.q])[0]);
  }

  retell() {
    this.update();
  }

  point(term) {
    const corner = { W_A: this.ends[0], W_B: this.ends[1] }[term];
    this.marked ??= svg(this.root, 'polyline', { class: 'distance' });
    const to = corner && this.#at(corner);
    set(this.marked, { points: to ? points([[to[0], this.#at([0, 0])[1]], to]) : '' });
  }
}

const LINES = [
  ['r', 'r'],
  ['s', 's'],
  ['[1|W_P] = [r|W_A] + [s|W_B]', 'W_P'],
  ['a = r·[W_P|W_A]', 'a'],
  ['b = s·[W_P|W_B]', 'b'],
];

const SAMPLES = 96; // of the curves
const STRIPES = 8; // of the edge

// What is plotted over the screen, at weights r, s there. u is 0 in A and 1 in B.
const OF = {
  w: ({ r, s, wA, wB }) => 1 / (r / wA + s / wB),
  naiveW: ({ r, s, wA, wB }) => r * wA + s * wB,
  inverse: ({ r, s, wA, wB }) => r / wA + s / wB,
  over: ({ s, wB }) => s / wB,
  u: ({ r, s, wA, wB }) => s / wB / (r / wA + s / wB),
  naiveU: ({ s }) => s,
};
const NAIVE_W = { name: { en: 'W mixed on the screen: wrong', zh: '直接插值的 W：错误' }, kind: 'naive', of: OF.naiveW };
const NAIVE_U = { name: { en: 's, which is u mixed on the screen: wrong', zh: 's，即直接插值的 u：错误' }, kind: 'naive', of: OF.naiveU };
const INVERSE = { name: { en: '1/W: straight', zh: '1/W：直线' }, kind: 'inverse', of: OF.inverse };
// What the two plots show, the upper one first. The curves of a plot have one scale.
const PLOTS = {
  w: [
    { y: { en: 'W, in units of length', zh: 'W，长度单位' }, curves: [{ name: { en: 'W: bent', zh: 'W：弯曲' }, kind: 'w', of: OF.w }, NAIVE_W] },
    { y: { en: '1/W, per unit of length', zh: '1/W，长度单位的倒数' }, curves: [INVERSE] },
  ],
  u: [
    {
      y: { en: '1/W and u/W, per unit of length', zh: '1/W 与 u/W，长度单位的倒数' },
      curves: [INVERSE, { name: { en: 'u/W: straight', zh: 'u/W：直线' }, kind: 'depth', of: OF.over }],
    },
    {
      y: { en: 'u, from 0 in A to 1 in B', zh: 'u：在 A 处为 0，在 B 处为 1' },
      curves: [{ name: { en: 'u, their quotient: bent, right', zh: 'u，上面两者之商：弯曲，正确' }, kind: 'w', of: OF.u }, NAIVE_U],
    },
  ],
};
const PLACE = { en: "place on the screen, from A' to B'", zh: "屏幕位置，从 A' 到 B'" };

// The edge as it is seen: stripes of equal length in space, with a value that is right and with one that is mixed on the screen.
class Stripes {
  constructor(node) {
    this.node = node;
    this.rows = [OF.naiveU, OF.u].map((of) => ({ of, canvas: node.appendChild(document.createElement('canvas')) }));
    this.rows.forEach(({ canvas }) => {
      canvas.setAttribute('aria-hidden', 'true');
      Object.assign(canvas, { width: 640, height: 1 });
    });
  }

  /** `q`: where the point is, as a part of the picture. */
  show(wA, wB, q) {
    this.node.style.setProperty('--q', q);
    for (const { of, canvas } of this.rows) {
      const { width } = canvas;
      const image = new ImageData(width, 1);
      for (let x = 0; x < width; x++) {
        const s = (x + 0.5) / width;
        const odd = Math.floor(STRIPES * of({ r: 1 - s, s, wA, wB })) % 2;
        image.data.set(odd ? [70, 80, 92, 255] : [250, 246, 236, 255], 4 * x);
      }
      canvas.getContext('2d').putImageData(image, 0, 0);
    }
  }
}

// The numbers of P, a line each.
function showLines(panel, terms) {
  fill(panel, () => {
    for (const [text, term] of LINES) {
      fill(element(panel, 'div', text === term ? 'line beside' : 'line'), (row) => {
        formulaIn(row, text);
        if (term === 'W_P') {
          gap(row, '\u2003');
          formulaIn(row, term);
        }
        formulaIn(row, `= ${term}`, { [term]: short(terms[term]) });
      });
    }
    fill(element(panel, 'div', 'line naive'), (row) => {
      write(element(row, 'span', 'what'), say({ en: 'W mixed on the screen:', zh: '直接插值的 W：' }));
      formulaIn(row, 'r·W_A + s·W_B');
      write(element(row, 'span'), `= ${short(terms.r * terms.W_A + terms.s * terms.W_B)}`);
    });
  });
  hearNumbers(panel, terms, ['r', 's', 'a', 'b']);
}

// Curves of the weights at places between A' and B', and at both.
function curvesOf(curves, { W_A: wA, W_B: wB }) {
  const at = (s) => ({ s, r: 1 - s, wA, wB });
  return curves.map((curve) => ({
    ...curve,
    values: Array.from({ length: SAMPLES }, (_, i) => curve.of(at((i + 0.5) / SAMPLES))),
    ends: [curve.of(at(0)), curve.of(at(1))],
  }));
}

export function start(section) {
  const panel = section.querySelector('.lines');
  const legends = [...section.querySelectorAll('.legend')];
  const note = takenNote(section, () => drawing.giveBack(), {
    en: 'This is the edge AB of the triangle of your model.',
    zh: '这是你的模型中那个三角形的边 AB。',
  });
  let shown = PLOTS.w;
  const show = () => {
    const terms = drawing.numbers();
    note.hidden = !drawing.isTaken;
    showLines(panel, terms);
    shown.forEach(({ y, curves }, i) => {
      plots[i].axes = { x: i === 1 ? PLACE : '', y, ends: ["A'", "B'"] };
      plots[i].show(curvesOf(curves, terms), drawing.q);
      legend(legends[i], curves);
    });
    stripes.show(terms.W_A, terms.W_B, drawing.q);
  };
  const rooms = [...section.querySelectorAll('.plot-room')];
  const names = [
    { en: 'W, or 1/W and u/W, over the screen', zh: '屏幕上的 W，或 1/W 与 u/W' },
    { en: '1/W, or u, over the screen', zh: '屏幕上的 1/W，或 u' },
  ];
  const slides = { by: (part) => drawing.slideBy(part), to: (part) => drawing.set(part) };
  const plots = rooms.map((room, i) => new Plot(room, { slides, name: names[i] }));
  const stripes = new Stripes(section.querySelector('.stripes'));
  const drawing = new Drawing(section.querySelector('.plane-room'), show);
  choice(section, 'curve', (value) => {
    shown = PLOTS[value];
    drawing.update();
  });
  section.querySelector('.on-screen').addEventListener('click', () => drawing.set(0.5));
  section.querySelector('.in-space').addEventListener('click', () => {
    const [wA, wB] = drawing.ends.map(([, z]) => z);
    drawing.set(wB / (wA + wB));
  });
  whenLanguage(() => drawing.update());
  chapterTerms(section, () => drawing.numbers(), [drawing]);
  return drawing;
}
