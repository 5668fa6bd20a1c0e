// SPDX-License-Identifier: MIT
// Curves over a line of pixels: each {name, values [count], kind, scale, ends}, all over the same places: the middles of as many
// pixels; and at its two ends, where it reaches them. Axes with their numbers, and a line at the
// explained place; where that can be dragged, a dot on each curve with its value.
import { say, whenLanguage } from './language.js';
import { short } from './math.js';
import { nameDrawing, percentOf } from './naming.js';
import { sizeOf } from './size.js';
import { element, fill, write } from './slots.js';
import { draggable, drawn, points, set, svg } from './svg.js';

const [LEFT, RIGHT, TOP, BOTTOM] = [46, 14, 16, 34];
const ABOVE_AXIS = 40; // CSS pixels above the axis that a value below its dot and the name of the place take

export class Plot {
  /**
   * `slides`, if any, hears of drags of the place: {by(part), to(part)}, of the width. `axes`: {x, y}, each {en, zh}, as is `name`.
   */
  constructor(node, { axes, slides, name = { en: 'Curves over the screen', zh: '屏幕上的曲线' } } = {}) {
    this.axes = axes;
    this.root = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.root.classList.add('plot');
    nameDrawing(this.root, name);
    node.append(this.root);
    this.lines = svg(this.root, 'g');
    if (slides) {
      this.handle = svg(this.root, 'g', { class: 'handle mark', tabindex: 0, ...percentOf(0) });
      whenLanguage(() => this.handle.setAttribute('aria-label', say({ en: "P' on the screen", zh: "屏幕上的 P'" })));
      svg(this.handle, 'circle', { class: 'reach', r: 18 });
      svg(this.handle, 'circle', { r: 6 });
      svg(this.handle, 'text', { x: 9, y: -8 }, "P'");
      const by = (dx) => slides.by(dx / (sizeOf(this.root)[0] - LEFT - RIGHT));
      draggable(this.handle, { move: by, step: (dx) => by(4 * dx), ends: slides.to });
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
    const [width, height] = sizeOf(this.root);
    if (!curves || width === 0) {
      return;
    }
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    const x = (part) => LEFT + part * (width - LEFT - RIGHT);
    const floor = height - BOTTOM;
    fill(this.lines, () => {
      this.#axes(curves, x, floor);
      if (place !== null) {
        drawn(this.lines, 'line', { class: 'here', x1: x(place), x2: x(place), y1: TOP, y2: floor });
      }
      const lines = curves.map((curve) => this.#curve(curve, this.largest(curve), x, floor));
      if (this.handle && place !== null) {
        this.#dots(lines, x(place), floor);
      }
    });
    if (this.handle) {
      this.handle.toggleAttribute('hidden', place === null);
      set(this.handle, { transform: `translate(${x(place ?? 0)},${floor})`, ...percentOf(place ?? 0) });
      set(this.handle.lastChild, { x: place > 0.85 ? -22 : 9 });
    }
  }

  /** What a curve that is shown has at the upper end of the axis. */
  largest({ scale }) {
    const alike = this.curves.filter((curve) => curve.scale === scale).flatMap(({ values, ends = [] }) => [...values, ...ends]);
    return Math.max(...alike.filter(Number.isFinite)) || 1;
  }

  #axes(curves, x, floor) {
    drawn(this.lines, 'line', { class: 'axis', x1: x(0), x2: x(1), y1: floor, y2: floor });
    drawn(this.lines, 'line', { class: 'axis', x1: x(0), x2: x(0), y1: TOP, y2: floor });
    if (new Set(curves.map(({ scale }) => scale)).size === 1) {
      const largest = this.largest(curves[0]);
      for (const part of [0, 0.5, 1]) {
        const y = floor - part * (floor - TOP);
        drawn(this.lines, 'line', { class: 'axis', x1: x(0) - 4, x2: x(0), y1: y, y2: y });
        drawn(this.lines, 'text', { class: 'tick', x: x(0) - 7, y: y + 4, 'text-anchor': 'end' }, short(Number((part * largest).toPrecision(3))));
      }
    }
    if (this.axes) {
      drawn(this.lines, 'text', { class: 'tick', x: x(1), y: floor + 28, 'text-anchor': 'end' }, say(this.axes.x));
      drawn(this.lines, 'text', { class: 'tick', x: x(0) + 8, y: TOP - 3 }, say(this.axes.y));
      (this.axes.ends ?? []).forEach((name, i) => drawn(this.lines, 'text', { class: 'tick', x: x(i), y: floor + 16, 'text-anchor': 'middle' }, name));
    }
  }

  // Draws a curve. Returns {kind, value, y, rises} of it at the place.
  #curve({ values, kind, ends = [] }, largest, x, floor) {
    const at = (value, part) => [x(part), floor - (value / largest) * (floor - TOP)];
    const list = values.map((value, i) => at(value, (i + 0.5) / values.length));
    if (ends.length) {
      list.unshift(at(ends[0], 0));
      list.push(at(ends[1], 1));
    }
    drawn(this.lines, 'polyline', { class: `curve ${kind}`, points: points(list.filter(([, y]) => Number.isFinite(y))) });
    const value = valueAt(values, ends, this.place ?? 0);
    return { kind, value, y: at(value, 0)[1], rises: values.at(-1) > values[0] };
  }

  // The upper one of two values stands above its dot, the other one below where the axis leaves room, each on the side to which its
  // curve leaves some.
  #dots(lines, x, floor) {
    const highest = Math.min(...lines.map(({ y }) => y));
    for (const { kind, value, y, rises } of lines) {
      const isAbove = y === highest || floor - y < ABOVE_AXIS;
      const isLeft = this.place > 0.85 || (this.place > 0.15 && isAbove === rises);
      const at = { x: x + (isLeft ? -8 : 8), y: isAbove ? Math.max(y - 7, TOP + 4) : y + 18 };
      drawn(this.lines, 'circle', { class: `on-curve ${kind}`, cx: x, cy: y, r: 5 });
      drawn(this.lines, 'text', { class: `value ${kind}`, ...at, 'text-anchor': isLeft ? 'end' : 'start' }, short(value));
    }
  }
}

// Between the two values beside a place, 0..1.
function valueAt(values, [first = values[0], last = values.at(-1)], place) {
  const all = [first, ...values, last];
  const index = Math.min(Math.max(place * values.length + 0.5, 0), values.length + 1);
  const low = Math.min(Math.floor(index), values.length);
  const part = low === 0 ? 2 * (index - 0.5) : low === values.length ? 2 * (index - low) : index - low;
  return all[low] + (all[low + 1] - all[low]) * Math.min(part, 1);
}

/** Fills `node` with the curves' names and their colours. */
export function legend(node, curves) {
  fill(node, () => curves.forEach(({ name, kind }) => write(element(node, 'span', `key ${kind}`), say(name))));
}
