// SPDX-License-Identifier: MIT
// The question before any answer: where in the picture is the middle of the floor's edge? The reader puts a ring there; then the
// floor is drawn twice, naive and divided by w, with the middle of each.
import { say, whenLanguage } from '../language.js';
import { onScreen } from '../overlay.js';
import { sizeOf } from '../size.js';
import { METHOD, PATTERN } from '../stage.js';
import { numbersIn, numbersText } from '../state.js';
import { draggable, points, set, svg } from '../svg.js';
import { add, clamp } from '../vector.js';
import { View } from '../view.js';

const NEAR = 1.3; // z of the floor's near end
const CLOSE = 0.045; // of the edge: a ring so near to a place is there

// 0, near left; 1, far left; 2, far right; 3, near right. v runs along the floor.
function floorTo(far) {
  const corner = (x, z, u, v) => ({ at: [x, 0, z], color: [0.96, 0.94, 0.89], uv: [u, v] });
  return [corner(-1.15, NEAR, 0, 0), corner(-1.15, far, 0, 1), corner(1.15, far, 1, 1), corner(1.15, NEAR, 1, 0)];
}

const trianglesOf = ([a, b, c, d]) => [[a, b, c], [a, c, d]];
const between = (from, to, part) => add(from, add(to, from, -1), part);

// One of the two pictures: the floor by a method, its edge, and the line across its middle.
class Floor {
  constructor(stage, figure, method, asked) {
    this.asked = asked;
    this.method = method;
    const scene = {
      camera: { eye: [0, 1.25, 3.6], target: [0, 0.42, 0], yfov: 36, near: 0.1, far: 60 },
      corners: [],
      quiet: true,
      draw: (to) => {
        const pattern = asked.shown ? PATTERN.checker : PATTERN.colors;
        trianglesOf(asked.floor).forEach((triangle) => to.triangle(triangle, method, pattern));
      },
    };
    this.view = new View(stage, figure, scene, () => {
      this.place();
      asked.judge();
    });
    this.root = svg(figure, 'svg', { class: 'ask' });
    this.edge = svg(this.root, 'line', { class: 'edge' });
    this.middle = svg(this.root, 'polyline', { class: 'middle' });
    this.name = svg(this.root, 'text', { class: 'name', x: 12, y: 26 });
    this.ends = ['A', 'B'].map((name) => svg(this.root, 'text', { class: 'name' }, name));
    this.ring = svg(this.root, 'g', { class: 'handle mark', tabindex: 0, role: 'slider', 'aria-valuemin': 0, 'aria-valuemax': 100 });
    svg(this.ring, 'circle', { class: 'reach', r: 24 });
    svg(this.ring, 'circle', { r: 11 });
    draggable(this.ring, {
      move: (dx, dy) => asked.slide(this.#along(dx, dy)),
      step: (dx, dy, deeper) => asked.slide((dx - dy) / 50 + deeper / 10),
      ends: (part) => asked.set(part),
    });
  }

  // How far a drag goes along the edge in the picture.
  #along(dx, dy) {
    const [from, to] = this.screen;
    const way = [to[0] - from[0], to[1] - from[1]];
    return (dx * way[0] + dy * way[1]) / (way[0] ** 2 + way[1] ** 2);
  }

  // Where this way of drawing puts the line across the middle: naive in each triangle halfway on the screen.
  #middleLine(on) {
    const [a, b, c, d] = this.asked.floor.map((corner) => corner.at);
    if (this.method === METHOD.correct) {
      return [on(between(a, b, 0.5)), on(between(d, c, 0.5))];
    }
    return [[a, b], [a, c], [d, c]].map(([from, to]) => between(on(from), on(to), 0.5));
  }

  place() {
    const [width, height] = sizeOf(this.view.figure);
    if (width === 0 || !this.view.clips) {
      return; // nothing was drawn yet
    }
    const on = (at) => onScreen(this.view.stageClip(at), [width, height]);
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    this.screen = this.asked.floor.slice(0, 2).map((corner) => on(corner.at));
    const [from, to] = this.screen;
    set(this.edge, { x1: from[0], y1: from[1], x2: to[0], y2: to[1] });
    this.ends.forEach((text, i) => set(text, { x: this.screen[i][0] - 20, y: this.screen[i][1] + 5 }));
    set(this.ring, { transform: `translate(${between(from, to, this.asked.place)})`, ...this.asked.sliderAt() });
    set(this.middle, { points: this.asked.shown ? points(this.#middleLine(on)) : '' });
    this.name.toggleAttribute('hidden', !this.asked.shown);
  }
}

const VERDICTS = {
  naive: {
    en: 'You put the ring halfway along the line in the picture. So does a program that mixes values on the screen: that is the orange line of the naive picture. But the far half of the floor looks smaller than the near half, so the middle of the floor lies further up.',
    zh: '你把圆环放在了画面中这条线段的中点。直接在屏幕上插值的程序也是这样做的，得到“未校正”图中的橙线。但地板较远的一半看上去更小，所以真正的中点在画面上更靠上。',
  },
  right: {
    en: 'That is where it is: the far half of the floor looks smaller than the near half. The orange line of the picture “divided by w” goes through your ring; a program that mixes values on the screen draws the naive one.',
    zh: '没错，就在那里：地板较远的一半看上去更小。“除以 w”图中的橙线正好穿过你的圆环；直接在屏幕上插值的程序画出的是“未校正”那幅。',
  },
  near: {
    en: 'The middle lies further up, where the orange line of the picture “divided by w” meets the edge: the far half of the floor looks smaller than the near half.',
    zh: '中点还要靠上，在“除以 w”图中橙线与这条边相交之处：地板较远的一半看上去更小。',
  },
  far: {
    en: 'Not so far up: the middle lies where the orange line of the picture “divided by w” meets the edge. The far half of the floor looks smaller than the near half, but not by that much.',
    zh: '没有那么靠上：中点在“除以 w”图中橙线与这条边相交之处。地板较远的一半看上去确实更小，但没有小那么多。',
  },
};

class Question {
  place = 0.2; // of the ring, along the edge in the picture
  shown = false;
  floor = floorTo(-5);

  constructor(section, stage) {
    this.section = section;
    this.verdict = section.querySelector('.verdict');
    const [left, right] = section.querySelectorAll('.view');
    this.floors = [new Floor(stage, left, METHOD.naive, this), new Floor(stage, right, METHOD.correct, this)];
    section.querySelector('.look').addEventListener('click', () => this.show(true));
    section.querySelector('.again').addEventListener('click', () => this.show(false));
    section.querySelector('[name="far"]').addEventListener('input', ({ target }) => {
      this.floor = floorTo(-Number(target.value));
      this.update(true);
    });
    whenLanguage(() => this.#name());
  }

  #name() {
    const names = [{ en: 'naive', zh: '未校正' }, { en: 'divided by w', zh: '除以 w' }];
    this.floors.forEach(({ name, ring }, i) => {
      name.textContent = say(names[i]);
      ring.setAttribute('aria-label', say({ en: 'your mark on the edge from A to B', zh: '你在 AB 边上的标记' }));
    });
    this.judge();
  }

  // Where the middle of the edge is seen, as a part of its picture.
  get right() {
    const [near, far] = this.floor.map((corner) => this.floors[0].view.stageClip(corner.at)[3]);
    return far / (near + far);
  }

  get judgement() {
    const off = this.place - this.right;
    if (Math.abs(off) < CLOSE) {
      return 'right';
    }
    return Math.abs(this.place - 0.5) < CLOSE ? 'naive' : off < 0 ? 'near' : 'far';
  }

  judge() {
    const text = this.shown && this.floors?.[0].view.clips ? say(VERDICTS[this.judgement]) : '';
    if (this.verdict.textContent !== text) {
      this.verdict.textContent = text;
    }
  }

  sliderAt() {
    const percent = Math.round(100 * this.place);
    return { 'aria-valuenow': percent, 'aria-valuetext': say({ en: `${percent} % of the way up`, zh: `从下往上 ${percent} %` }) };
  }

  slide(part) {
    this.set(this.place + part);
  }

  set(place) {
    this.place = clamp(place, 0, 1);
    this.floors.forEach((floor) => floor.place());
    this.judge();
  }

  show(shown) {
    this.shown = shown;
    this.section.classList.toggle('answered', shown);
    this.judge();
    this.update();
  }

  update(moving = false) {
    this.floors.forEach(({ view }) => view.update(moving));
    this.judge();
  }

  save() {
    return { mark: numbersText([this.place]), shown: Number(this.shown) };
  }

  restore(values) {
    this.set((numbersIn(values, 'mark', 1) ?? [this.place])[0]);
    this.show(values.get('shown') === '1');
  }
}

export function start(section, stage) {
  const question = new Question(section, stage);
  const { view } = question.floors[0];
  const draw = question.floors.map((floor) => floor.view.drawForPaper.bind(floor.view));
  return Object.assign(view, {
    save: () => question.save(),
    restore: (values) => question.restore(values),
    drawForPaper() {
      const { shown } = question; // paper has the answer
      question.show(true);
      draw.forEach((one) => one());
      addEventListener('afterprint', () => question.show(shown), { once: true });
    },
  });
}
