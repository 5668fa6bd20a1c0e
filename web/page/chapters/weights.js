// SPDX-License-Identifier: MIT
// What r, s, t and a, b, c are: the three parts into which a point cuts its triangle, as shares of the whole, on the screen and on
// the triangle itself as it is seen straight on. Then the formula that leads from the ones to the others, term by term.
import { distanceSlider } from '../controls.js';
import { termsOf } from '../derivation.js';
import { hear, hearNumbers } from '../heard.js';
import { say, whenLanguage } from '../language.js';
import { cornersOf, onScreen } from '../overlay.js';
import { sizeOf } from '../size.js';
import { METHOD, PATTERN } from '../stage.js';
import { points, set, svg } from '../svg.js';
import { takeable } from '../taken.js';
import { chapterTerms } from '../tips.js';
import { add, dot, within } from '../vector.js';
import { View } from '../view.js';

const NAMES = ['A', 'B', 'C'];
const PAIRS = [['r', 'a'], ['s', 'b'], ['t', 'c']];
const MARGIN = 34;

// The three parts, each opposite its corner and with its colour, and the names of what they are shares of.
class Parts {
  constructor(root, terms) {
    this.terms = terms;
    this.parts = NAMES.map((name) => svg(root, 'polygon', { class: `share corner${name}` }));
    this.names = terms.map((term) => svg(root, 'text', { class: 'share-name' }, term));
  }

  /** Places of P and of the corners. Names stand where there is room. */
  place(p, corners, shares) {
    this.parts.forEach((part, i) => {
      const [from, to] = [corners[(i + 1) % 3], corners[(i + 2) % 3]];
      set(part, { points: points([p, from, to]) });
      const [x, y] = [0, 1].map((k) => 0.24 * p[k] + 0.38 * (from[k] + to[k])); // nearer to the edge than to P's name
      set(this.names[i], { x, y: y + 6 });
      this.names[i].toggleAttribute('hidden', shares[i] < 0.04);
    });
  }

  show(shown) {
    for (const node of [...this.parts, ...this.names]) {
      node.toggleAttribute('hidden', !shown);
    }
  }

  point(term) {
    this.parts.forEach((part, i) => part.classList.toggle('pointed', this.terms[i] === term));
  }
}

// The triangle in its own plane: AB level, C above it.
function flat(corners) {
  const [ab, ac] = [1, 2].map((i) => add(corners[i].at, corners[0].at, -1));
  const length = Math.max(Math.sqrt(dot(ab, ab)), 1e-9);
  const along = dot(ac, ab) / length;
  return [[0, 0], [length, 0], [along, Math.sqrt(Math.max(dot(ac, ac) - along ** 2, 0))]];
}

class StraightOn {
  constructor(node, view) {
    this.view = view;
    this.root = svg(node, 'svg', { class: 'top straight-on', role: 'img' });
    this.body = svg(this.root, 'polygon', { class: 'body' });
    this.parts = new Parts(this.root, ['a', 'b', 'c']);
    this.corners = NAMES.map((name) => svg(this.root, 'circle', { class: `dot corner${name}`, r: 6 }));
    this.names = NAMES.map((name) => svg(this.root, 'text', {}, name));
    this.p = svg(this.root, 'g', { class: 'mark' });
    svg(this.p, 'circle', { r: 5 });
    svg(this.p, 'text', { x: 8, y: -8 }, 'P');
    whenLanguage(() => this.root.setAttribute('aria-label', say({ en: 'The triangle, seen straight on', zh: '从正面看这个三角形' })));
    new ResizeObserver(() => this.update()).observe(node);
  }

  update(numbers = this.numbers) {
    this.numbers = numbers;
    const [width, height] = sizeOf(this.root);
    if (width === 0) {
      return;
    }
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    const plane = flat(this.view.scene.corners);
    const [low, high] = [Math.min, Math.max].map((of) => of(...plane.map(([x]) => x)));
    const tall = Math.max(...plane.map(([, y]) => y));
    const scale = Math.min((width - 2 * MARGIN) / (high - low), (height - 2 * MARGIN) / tall);
    const at = ([x, y]) => [width / 2 + (x - (low + high) / 2) * scale, height / 2 - (y - tall / 2) * scale];
    const corners = plane.map(at);
    set(this.body, { points: points(corners) });
    corners.forEach(([x, y], i) => {
      set(this.corners[i], { cx: x, cy: y });
      set(this.names[i], { x: x + (i === 0 ? -20 : 10), y: y + 5 });
    });
    this.p.toggleAttribute('hidden', !numbers);
    this.parts.show(Boolean(numbers));
    if (numbers) {
      const weights = [numbers.a, numbers.b, numbers.c];
      const p = weights.reduce((sum, weight, i) => add(sum, corners[i], weight), [0, 0]);
      set(this.p, { transform: `translate(${p})` });
      this.parts.place(p, corners, weights);
    }
  }

  point(term) {
    this.parts.point(term);
  }
}

// The shares as bars, the two of a corner below each other; and in words for those who hear the page.
class Bars {
  constructor(node) {
    this.bars = PAIRS.flatMap((pair, i) =>
      pair.map((term) => {
        const row = node.appendChild(document.createElement('div'));
        row.className = `bar corner${NAMES[i]}`;
        const name = row.appendChild(document.createElement('i'));
        name.textContent = term;
        name.dataset.term = term;
        const room = row.appendChild(document.createElement('span'));
        return { term, bar: room.appendChild(document.createElement('b')) };
      }),
    );
    this.node = node;
  }

  show(numbers) {
    this.bars.forEach(({ term, bar }) => (bar.style.width = `${100 * (numbers?.[term] ?? 0)}%`));
    hearNumbers(this.node, numbers, PAIRS.flat());
  }
}

// One line after the other, each when it is asked for.
function startSteps(section) {
  const steps = [...section.querySelectorAll('.steps > li')];
  const button = section.querySelector('.next');
  const show = (count) => {
    steps.forEach((step, i) => step.classList.toggle('later', i >= count));
    button.hidden = count >= steps.length;
  };
  button.addEventListener('click', () => {
    const count = steps.filter((step) => !step.classList.contains('later')).length + 1;
    show(count);
    steps[count - 1].focus();
  });
  steps.forEach((step) => (step.tabIndex = -1));
  show(1);
}

export function start(section, stage) {
  const pale = [0.93, 0.92, 0.9];
  const corners = [
    { at: [-1.3, -0.75, 0.6], color: pale, uv: [0, 0] },
    { at: [1.5, -0.55, -1.9], color: pale, uv: [1, 0] },
    { at: [-0.1, 1.05, -0.4], color: pale, uv: [0.5, 1] },
  ];
  const scene = {
    camera: { eye: [0, 0.1, 3.4], target: [0, 0.1, 0], yfov: 46, near: 0.1, far: 50 },
    corners,
    alongRays: true, // pushed away, a corner is seen where it was
    limit: within([-6, -4, -9], [6, 4, 1.8]),
    triangleOf: () => corners,
    draw: (to) => to.triangle(corners, METHOD.correct, PATTERN.colors),
  };
  const bars = new Bars(section.querySelector('.bars'));
  const figure = section.querySelector('.view');
  const view = new View(stage, figure, scene, (numbers) => {
    const size = sizeOf(figure);
    const places = numbers && cornersOf(numbers).map((clip) => onScreen(clip, size));
    const shown = Boolean(places?.every(Boolean));
    parts.show(shown);
    if (shown) {
      parts.place(view.pixel.map((part, i) => part * size[i]), places, [numbers.r, numbers.s, numbers.t]);
    }
    straight.update(numbers);
    bars.show(numbers);
    showDistance();
  });
  const showDistance = distanceSlider(section, view, corners[1]);
  const layer = svg(view.overlay, 'g');
  view.overlay.prepend(layer);
  const parts = new Parts(layer, ['r', 's', 't']);
  const straight = new StraightOn(section.querySelector('.straight'), view);
  takeable(section, view);
  startSteps(section);
  chapterTerms(section, () => view.numbers && termsOf(view.numbers), [parts, straight]);
  view.pick([0.5, 0.5]);
  return view;
}
