// SPDX-License-Identifier: MIT
// The drawing of one motion, from clip space through the division to the screen. A point (X, Y, W) goes to
// (X, Y, W)/(1 − k + k·W): where k is 0 nothing has moved, where it is 1 all has been divided by its W and lies on the screen, W = 1.
// Each step between is a projective map, so lines stay lines, and the place from which one looks turns until it is the eye's.
import { between, cutLine, cutTriangle } from './cut.js';
import { say } from './language.js';
import { short } from './math.js';
import { sizeOf } from './size.js';
import { fill } from './slots.js';
import { drawn, points, set, svg } from './svg.js';
import { clamp } from './vector.js';

const FIELDS = 8; // of the triangle, along u and v
const YAW = (68 * Math.PI) / 180; // from where one looks at the start: from the side, a little from above
const PITCH = (24 * Math.PI) / 180;
const FAR = 7; // W up to which the start is in the picture
const CAPTION = 120; // CSS pixels that the name of the screen takes at most
const BELOW = 22; // CSS pixels for it below the screen, at the end
const LIFT = 0.3; // of the start, as what is near stands low in it

const ASIDE = 8; // CSS pixels from a corner of the cut to its name
const NAME = 22; // that it takes

const mix = (from, to, k) => from + (to - from) * k;

export class Flight {
  /** `aspect`: width over height of the picture that the screen is. */
  constructor(node, aspect) {
    this.aspect = aspect;
    this.k = 0;
    this.unit = 1; // W of the screen
    this.root = svg(node, 'svg', { class: 'top flight', role: 'img' });
    this.rim = svg(this.root, 'polygon', { class: 'screen' });
    this.sight = [0, 1, 2, 3].map(() => svg(this.root, 'line', { class: 'sight-edge' }));
    this.body = svg(this.root, 'polygon', { class: 'body' });
    this.lattice = svg(this.root, 'path', { class: 'lattice' });
    this.behind = svg(this.root, 'polygon', { class: 'cut-off' });
    this.edge = svg(this.root, 'line', { class: 'cut' });
    this.eye = svg(this.root, 'circle', { class: 'eye', r: 5 });
    this.labels = svg(this.root, 'g');
    new ResizeObserver(() => this.update()).observe(node);
  }

  // Where a place in clip coordinates, [X, Y, Z, W], is in the drawing after so much of the motion.
  #at(clip) {
    const { k, unit, width, height } = this;
    const [x, y, , w] = clip.map((value) => value / unit);
    const over = 1 / (1 - k + k * w);
    const [px, py, pz] = [x * this.aspect * over, y * over, w * over - mix(FAR / 2, 1, k)];
    const turn = (1 - k) ** 1.5;
    const [yaw, pitch] = [YAW * turn, PITCH * turn];
    const across = px * Math.cos(yaw) + pz * Math.sin(yaw);
    const away = -px * Math.sin(yaw) + pz * Math.cos(yaw);
    const up = py * Math.cos(pitch) + away * Math.sin(pitch);
    const room = height - mix(0, BELOW, k);
    const scale = Math.min(width / mix(FAR + 4, 2.3 * this.aspect, k), room / mix(7, 2.3, k));
    return [width / 2 + across * scale, room / 2 - (up + mix(LIFT, 0, k)) * scale];
  }

  // A place of the screen, -1..1, or where the line to it from the eye is so many times as far.
  #onScreen(x, y, far = 1) {
    return [x, y, 0, 1].map((value) => value * far * this.unit);
  }

  #line(node, from, to) {
    const [[x1, y1], [x2, y2]] = [this.#at(from), this.#at(to)];
    set(node, { x1, y1, x2, y2 });
  }

  // Lines of equal u and of equal v, cut where the triangle is.
  #latticePath() {
    const [a, b, c] = this.corners;
    const lines = [];
    for (let i = 1; i < FIELDS; i++) {
      const part = i / FIELDS;
      lines.push([between(a, b, part), between(c, b, part)], [between(a, c, part), between(b, c, part)], [between(b, a, part), between(c, a, part)]);
    }
    return lines
      .map(([from, to]) => cutLine(from, to))
      .filter(Boolean)
      .map(([from, to]) => `M${this.#at(from)}L${this.#at(to)}`)
      .join('');
  }

  // What is cut off has its name below it: above it may stand that of the eye.
  #label(text, [x, y], kind, isCut) {
    drawn(this.labels, 'circle', { cx: x, cy: y, r: 5, class: `dot ${kind}` });
    drawn(this.labels, 'text', isCut ? { x: x - 4, y: y + 20 } : { x: x + 9, y: y - 6 }, text);
  }

  /** `corners`: [X, Y, Z, W] of A, B and C; `k`: how far the motion is, 0..1. */
  show(corners, k) {
    this.corners = corners;
    this.k = k;
    this.update();
  }

  update() {
    const [width, height] = sizeOf(this.root);
    if (!width || !this.corners) {
      return;
    }
    Object.assign(this, { width, height });
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    const rim = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    set(this.rim, { points: points(rim.map(([x, y]) => this.#at(this.#onScreen(x, y)))) });
    rim.forEach(([x, y], i) => this.#line(this.sight[i], this.#onScreen(0, 0, 0.02), this.#onScreen(x, y, FAR * 0.7)));
    const [kept, gone] = cutTriangle(this.corners);
    set(this.body, { points: points(kept.map(({ clip }) => this.#at(clip))) });
    set(this.lattice, { d: this.#latticePath() });
    const early = Math.max(0, 1 - 5 * this.k); // what is cut off is gone before anything is divided
    set(this.behind, { points: early ? points(gone.map(({ clip }) => this.#unmoved(clip))) : '', style: `opacity: ${early}` });
    this.#placeCut(kept);
    this.kept = kept;
    this.eye.toggleAttribute('hidden', this.k === 1); // all lines through it are parallel by then
    if (this.k < 1) {
      const [cx, cy] = this.#at([0, 0, 0, 0]);
      set(this.eye, { cx, cy, style: `opacity: ${1 - this.k}` });
    }
    this.#placeLabels(early);
  }

  #unmoved(at) {
    const { k } = this;
    this.k = 0;
    const place = this.#at(at);
    this.k = k;
    return place;
  }

  #placeCut(kept) {
    const edge = kept.filter(({ name }) => name.length === 2);
    this.edge.toggleAttribute('hidden', edge.length !== 2);
    if (edge.length === 2) {
      this.#line(this.edge, ...edge.map(({ clip }) => clip));
    }
  }

  #placeLabels(early) {
    fill(this.labels, () => this.#writeLabels(early));
  }

  // The corners that the cut made have their names beyond it, once there is room between them.
  #nameCut() {
    const places = this.kept.map(({ clip }) => this.#at(clip));
    const made = this.kept.flatMap(({ name }, i) => (name.length === 2 ? [{ name, at: places[i] }] : []));
    if (this.k < 0.5 || made.length !== 2) {
      return;
    }
    const [[x1, y1], [x2, y2]] = made.map(({ at }) => at);
    const [x, y] = [0, 1].map((k) => places.reduce((sum, at) => sum + at[k], 0) / places.length); // within
    const side = (y2 - y1) * (x - x1) - (x2 - x1) * (y - y1) > 0 ? -1 : 1;
    const far = (side * ASIDE) / Math.max(Math.hypot(x2 - x1, y2 - y1), 1);
    for (const { name, at } of made) {
      const [across, down] = [(y2 - y1) * far, -(x2 - x1) * far];
      const attributes = { x: clamp(at[0] + across, NAME, this.width - NAME), y: at[1] + down + 4 };
      drawn(this.labels, 'text', { ...attributes, 'text-anchor': across < 0 ? 'end' : 'start', class: 'caption' }, name);
    }
  }

  #writeLabels(early) {
    this.#nameCut();
    this.corners.forEach((corner, i) => {
      const isCut = corner[2] < 0;
      if (!isCut || early > 0.5) {
        this.#label('ABC'[i], isCut ? this.#unmoved(corner) : this.#at(corner), `corner${'ABC'[i]}`, isCut);
      }
    });
    if (this.k < 0.6) {
      const [x, y] = this.#at([0, 0, 0, 0]);
      drawn(this.labels, 'text', { x: x - 9, y: y + 4, 'text-anchor': 'end', class: 'caption' }, say({ en: 'eye', zh: '眼睛' }));
    }
    const [x, y] = this.#at(this.#onScreen(1, -1));
    const fits = x + CAPTION < this.width; // else it ends where the screen does
    const at = { x: fits ? x + 4 : x - 4, y: y + 20 < this.height ? y + 16 : y - 6, 'text-anchor': fits ? 'start' : 'end' };
    drawn(this.labels, 'text', { ...at, class: 'caption' }, say({ en: `screen, W = ${short(this.unit)}`, zh: `屏幕，W = ${short(this.unit)}` }));
  }
}
