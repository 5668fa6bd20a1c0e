// SPDX-License-Identifier: MIT
// Elements of SVG.

const SVG = 'http://www.w3.org/2000/svg';

export function set(node, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    node.setAttribute(name, value);
  }
  return node;
}

/** A new child of `parent`. */
export function svg(parent, name, attributes = {}, text = '') {
  const node = set(document.createElementNS(SVG, name), attributes);
  node.textContent = text;
  parent.append(node);
  return node;
}

export const points = (list) => list.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(' ');

/**
 * Lets a node be dragged by mouse, pen, finger and keyboard: `move(dx, dy, event)` in CSS pixels, `step(dx, dy, deeper)` for
 * arrow keys and page up and down. Pointers that are already down keep what they hold.
 */
export function draggable(node, { move, step, end = () => {} }) {
  node.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    event.stopPropagation();
    node.setPointerCapture(event.pointerId);
    node.focus({ preventScroll: true });
    let last = [event.clientX, event.clientY];
    const follow = (at) => {
      move(at.clientX - last[0], at.clientY - last[1], at);
      last = [at.clientX, at.clientY];
    };
    const stop = () => {
      node.removeEventListener('pointermove', follow);
      end();
    };
    node.addEventListener('pointermove', follow);
    node.addEventListener('pointerup', stop, { once: true });
    node.addEventListener('pointercancel', stop, { once: true });
  });
  node.addEventListener('keydown', (event) => {
    const keys = {
      ArrowLeft: [-1, 0, 0],
      ArrowRight: [1, 0, 0],
      ArrowUp: [0, -1, 0],
      ArrowDown: [0, 1, 0],
      PageUp: [0, 0, 1],
      PageDown: [0, 0, -1],
    };
    if (keys[event.key]) {
      event.preventDefault();
      event.stopPropagation();
      step(...keys[event.key]);
      end();
    }
  });
}
