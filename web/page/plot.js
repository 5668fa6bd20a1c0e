// SPDX-License-Identifier: MIT
// Curves over a line of pixels: each {name, values [count], kind, scale, ends}, all over the same places: the middles of as many
// pixels; and at its two ends, where it reaches them. Axes with their numbers, and a line at the explained place with a dot on each curve.
import { say } from './language.js';
import { short } from './math.js';
import { nameDrawing } from './naming.js';
import { draggable, points, set, svg } from './svg.js';

const [LEFT, RIGHT, TOP, BOTTOM] = [46, 14, 16, 34];

export class Plot {
  /** `moved(dx)`, if any, hears of drags of the place, as a part of the width. `axes`: {x, y}, each {en, zh}. */
  constructor(node, { axes, moved } = {}) {
    this.axes = axes;
    this.root = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.root.classList.add('plot');
    nameDrawing(this.root, { en: 'Curves over the screen', zh: '屏幕上的曲线' });
    node.append(this.root);
    this.lines = svg(this.root, 'g');
    if (moved) {
      this.handle = svg(this.root, 'g', { class: 'handle mark', tabindex: 0, role: 'button', 'aria-label': 'P' });
      svg(this.handle, 'circle', { class: 'reach', r: 18 });
      svg(this.handle, 'circle', { r: 6 });
      svg(this.handle, 'text', { x: 9, y: 18 }, "P'");
      const by = (dx) => moved(dx / (this.root.clientWidth - LEFT - RIGHT));
      draggable(this.handle, { move: by, step: (dx) => by(4 * dx) });
    }
    new ResizeObserver(() => this.show(this.curves, this.place)).observe(node);
  }

  /**
   * `place`: where the explained pixel is, 0..1, or null. A curve is drawn between 0 and the largest value of its `scale`, which
   * the axis has where there is one scale alone.
   */
  show(curves, place) {
    this.curves = curves;
    this.place = place;
    const { clientWidth: width, clientHeight: height } = this.root;
    this.lines.replaceChildren();
    if (!curves || width === 0) {
      return;
    }
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    const x = (part) => LEFT + part * (width - LEFT - RIGHT);
    const floor = height - BOTTOM;
    this.#axes(curves, x, floor);
    if (place !== null) {
      svg(this.lines, 'line', { class: 'here', x1: x(place), x2: x(place), y1: TOP, y2: floor });
    }
    for (const curve of curves) {
      this.#curve(curve, this.#largest(curve), x, floor);
    }
    if (this.handle) {
      this.handle.toggleAttribute('hidden', place === null);
      set(this.handle, { transform: `translate(${x(place ?? 0)},${floor})` });
    }
  }

  #largest({ scale }) {
    const alike = this.curves.filter((curve) => curve.scale === scale).flatMap(({ values, ends = [] }) => [...values, ...ends]);
    return Math.max(...alike.filter(Number.isFinite)) || 1;
  }

  #axes(curves, x, floor) {
    svg(this.lines, 'line', { class: 'axis', x1: x(0), x2: x(1), y1: floor, y2: floor });
    svg(this.lines, 'line', { class: 'axis', x1: x(0), x2: x(0), y1: TOP, y2: floor });
    if (new Set(curves.map(({ scale }) => scale)).size === 1) {
      const largest = this.#largest(curves[0]);
      for (const part of [0, 0.5, 1]) {
        const y = floor - part * (floor - TOP);
        svg(this.lines, 'line', { class: 'axis', x1: x(0) - 4, x2: x(0), y1: y, y2: y });
        svg(this.lines, 'text', { class: 'tick', x: x(0) - 7, y: y + 4, 'text-anchor': 'end' }, short(Number((part * largest).toPrecision(3))));
      }
    }
    if (this.axes) {
      svg(this.lines, 'text', { class: 'tick', x: x(1), y: floor + 28, 'text-anchor': 'end' }, say(this.axes.x));
      svg(this.lines, 'text', { class: 'tick', x: x(0) + 8, y: TOP - 3 }, say(this.axes.y));
      (this.axes.ends ?? []).forEach((name, i) => svg(this.lines, 'text', { class: 'tick', x: x(i), y: floor + 16, 'text-anchor': 'middle' }, name));
    }
  }

  #curve({ values, kind, ends = [] }, largest, x, floor) {
    const at = (value, part) => [x(part), floor - (value / largest) * (floor - TOP)];
    const list = values.map((value, i) => at(value, (i + 0.5) / values.length));
    if (ends.length) {
      list.unshift(at(ends[0], 0));
      list.push(at(ends[1], 1));
    }
    svg(this.lines, 'polyline', { class: `curve ${kind}`, points: points(list.filter(([, y]) => Number.isFinite(y))) });
    if (this.handle && this.place !== null) {
      const index = Math.min(Math.max(this.place * values.length - 0.5, 0), values.length - 1);
      const [low, high] = [Math.floor(index), Math.ceil(index)];
      const [cx, cy] = at(values[low] + (index - low) * (values[high] - values[low]), this.place);
      svg(this.lines, 'circle', { class: `on-curve ${kind}`, cx, cy, r: 5 });
    }
  }
}

/** Fills `node` with the curves' names and their colours. */
export function legend(node, curves) {
  node.replaceChildren(
    ...curves.map(({ name, kind }) => {
      const item = document.createElement('span');
      item.className = `key ${kind}`;
      item.textContent = say(name);
      return item;
    }),
  );
}
