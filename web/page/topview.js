// SPDX-License-Identifier: MIT
// The scene from above: the eye, what it sees, the picture's plane, the triangle with corners to drag in depth, the ray through
// the pixel and the point P that it meets. Here one sees why halfway on the screen is not halfway in space.
import { say } from './language.js';
import { nameCorner, nameDrawing } from './naming.js';
import { sizeOf } from './size.js';
import { write } from './slots.js';
import { draggable, points, set, svg } from './svg.js';
import { add, basis, clamp } from './vector.js';

const MARGIN = 14;
const SCREEN = { distance: 1, name: { en: 'screen', zh: '屏幕' } };

export class TopView {
  /**
   * `view` is the picture that it belongs to; `range` what of the world it shows: {x: [low, high], z: [low, high]}; `planes`
   * across the view, with their names: [{distance, name}..].
   */
  constructor(node, view, range, planes = [SCREEN]) {
    this.view = view;
    this.range = range;
    this.ownRange = range;
    this.root = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.root.classList.add('top');
    nameDrawing(this.root, { en: 'The scene from above', zh: '俯视图' });
    node.append(this.root);
    this.sight = svg(this.root, 'polygon', { class: 'sight' });
    this.planes = planes.map((plane) => ({
      ...plane,
      line: svg(this.root, 'line', { class: 'plane' }),
      text: svg(this.root, 'text', { class: 'caption' }),
    }));
    this.outline = svg(this.root, 'polygon', { class: 'explained' });
    this.triangle = svg(this.root, 'polygon', { class: 'body' });
    this.part = svg(this.root, 'polygon', { class: 'part' });
    this.ray = svg(this.root, 'line', { class: 'ray' });
    this.distance = svg(this.root, 'line', { class: 'distance' });
    this.eye = svg(this.root, 'circle', { class: 'eye', r: 5 });
    this.p = svg(this.root, 'g', { class: 'mark' });
    svg(this.p, 'circle', { r: 4 });
    svg(this.p, 'text', { x: 7, y: -6 }, 'P');
    this.handles = view.scene.corners.map((corner, i) => this.#handle(corner, 'ABC'[i]));
    new ResizeObserver(() => this.update(this.numbers)).observe(node);
  }

  #handle(corner, name) {
    const node = svg(this.root, 'g', { class: `handle corner${name}`, tabindex: 0, role: 'button' });
    nameCorner(node, name);
    svg(node, 'circle', { class: 'reach', r: 18 });
    svg(node, 'circle', { class: 'dot', r: 6 });
    svg(node, 'text', { x: 9, y: 4 }, name);
    const by = (dx, dy) =>
      this.view.moveCorner(corner, [corner.at[0] + dx / this.scale, corner.at[1], corner.at[2] + dy / this.scale]);
    draggable(node, { move: by, step: (dx, dy, deeper) => by(4 * dx, 4 * dy - 4 * deeper) });
    return node;
  }

  // World x, z to the drawing: the eye is below and looks up, −z.
  #at([x, , z]) {
    return [this.left + (x - this.range.x[0]) * this.scale, MARGIN + (z - this.range.z[0]) * this.scale];
  }

  #layout() {
    const [width, height] = sizeOf(this.root);
    const { x, z } = this.range;
    this.scale = Math.min((width - 2 * MARGIN) / (x[1] - x[0]), (height - 2 * MARGIN) / (z[1] - z[0]));
    this.left = (width - (x[1] - x[0]) * this.scale) / 2;
    set(this.root, { viewBox: `0 0 ${width} ${height}` });
    return width > 0;
  }

  #placeSight() {
    const { camera } = this.view.scene;
    const { right, forward } = basis(camera);
    const [wide, high] = sizeOf(this.view.figure);
    const half = Math.tan((camera.yfov * Math.PI) / 360) * (wide / high);
    const edge = (side, distance) => this.#at(add(add(camera.eye, forward, distance), right, side * half * distance));
    set(this.sight, { points: points([this.#at(camera.eye), edge(-1, 20), edge(1, 20)]) });
    this.planes.forEach((plane) => this.#placePlane(plane, edge));
    const eye = this.#at(camera.eye);
    set(this.eye, { cx: eye[0], cy: eye[1] });
  }

  // A plane as wide as the view there; one through the eye, or behind it, as wide as the drawing.
  #placePlane({ distance, name, line, text }, edge) {
    const [from, to] = distance > 0 ? [edge(-1, distance), edge(1, distance)] : this.#across(distance);
    set(line, { x1: from[0], y1: from[1], x2: to[0], y2: to[1] });
    set(text, { x: clamp(to[0] + 6, 0, sizeOf(this.root)[0] - 60), y: to[1] - 4 });
    write(text, say(name));
  }

  #across(distance) {
    const { camera } = this.view.scene;
    const [, y] = this.#at(add(camera.eye, basis(camera).forward, distance));
    return [
      [0, y],
      [sizeOf(this.root)[0] - 66, y],
    ];
  }

  // P by its weights in space, of the triangle that was explained.
  #placePoint() {
    const n = this.numbers;
    const triangle = n && this.view.scene.triangleOf?.(n.triangle);
    this.p.toggleAttribute('hidden', !triangle);
    this.ray.toggleAttribute('hidden', !triangle);
    this.place = null;
    set(this.outline, { points: triangle ? points(triangle.map((corner) => this.#at(corner.at))) : '' });
    if (!triangle) {
      return;
    }
    this.corners = triangle.map((corner) => this.#at(corner.at));
    this.place = this.#at([n.a, n.b, n.c].reduce((sum, weight, i) => add(sum, triangle[i].at, weight), [0, 0, 0]));
    const eye = this.#at(this.view.scene.camera.eye);
    set(this.p, { transform: `translate(${this.place})` });
    set(this.ray, { x1: eye[0], y1: eye[1], x2: this.place[0], y2: this.place[1] });
  }

  /** Shows what of the world the corners and the eye need; or, with `all` false, what it showed first. */
  reach(all) {
    const { camera, corners } = this.view.scene;
    const around = (axis) => {
      const values = [camera.eye, ...corners.map(({ at }) => at)].map((at) => at[axis]);
      const [low, high] = [Math.min(...values), Math.max(...values)];
      const edge = 0.08 * (high - low);
      return [low - edge, high + edge];
    };
    this.range = all ? { x: around(0), z: around(2) } : this.ownRange;
  }

  /** After the picture changed. */
  update(numbers) {
    this.numbers = numbers;
    if (!this.#layout()) {
      return;
    }
    const corners = this.view.scene.corners.map((corner) => this.#at(corner.at));
    set(this.triangle, { points: points(corners) });
    corners.forEach((at, i) => set(this.handles[i], { transform: `translate(${at})` }));
    this.#placeSight();
    this.#placePoint();
    this.point(this.term);
  }

  /** Shows where a term is: a weight in space as an area, a W as a distance along the view. */
  point(term) {
    this.term = term;
    const part = { a: 0, b: 1, c: 2 }[term];
    const show = this.place && part !== undefined;
    set(this.part, {
      points: show ? points([this.place, this.corners[(part + 1) % 3], this.corners[(part + 2) % 3]]) : '',
      class: `part corner${'ABC'[part]}`,
    });
    const to = this.place && { W_A: this.corners[0], W_B: this.corners[1], W_C: this.corners[2], W_P: this.place }[term];
    this.distance.toggleAttribute('hidden', !to);
    if (to) {
      set(this.distance, { x1: to[0], y1: this.#at(this.view.scene.camera.eye)[1], x2: to[0], y2: to[1] });
    }
  }
}
