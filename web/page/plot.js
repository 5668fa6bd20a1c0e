// SPDX-License-Identifier: MIT
// Curves over a line of pixels: each {name, values [count], kind, scale}, all over the same places: the middles of as many pixels.
import { say } from './language.js';
import { points, set, svg } from './svg.js';

const [LEFT, TOP, BOTTOM] = [12, 14, 24];

export class Plot {
  constructor(node) {
    this.root = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.root.classList.add('plot');
    node.append(this.root);
    new ResizeObserver(() => this.show(this.curves, this.place)).observe(node);
  }

  /** `place`: where the explained pixel is, 0..1, or null. A curve is drawn between 0 and the largest value of its `scale`. */
  show(curves, place) {
    this.curves = curves;
    this.place = place;
    const { clientWidth: width, clientHeight: height } = this.root;
    this.root.replaceChildren();
    if (!curves || width === 0) {
      return;
    }
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    const x = (part) => LEFT + part * (width - 2 * LEFT);
    const floor = height - BOTTOM;
    svg(this.root, 'line', { class: 'axis', x1: LEFT, x2: width - LEFT, y1: floor, y2: floor });
    if (place !== null) {
      svg(this.root, 'line', { class: 'here', x1: x(place), x2: x(place), y1: TOP, y2: floor });
    }
    for (const curve of curves) {
      const alike = curves.filter(({ scale }) => scale === curve.scale).flatMap(({ values }) => values);
      this.#curve(curve, Math.max(...alike.filter(Number.isFinite)) || 1, x, floor);
    }
  }

  #curve({ values, kind }, largest, x, floor) {
    const list = values.map((value, i) => [x((i + 0.5) / values.length), floor - (value / largest) * (floor - TOP)]);
    svg(this.root, 'polyline', { class: `curve ${kind}`, points: points(list.filter(([, y]) => Number.isFinite(y))) });
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
