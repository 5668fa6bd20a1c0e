// SPDX-License-Identifier: MIT
// Elements of SVG, and what drags them.
import { beforeFrame } from './frame.js';
import { slot } from './slots.js';

const SVG = 'http://www.w3.org/2000/svg';

// What an attribute was set to here. To write what is there already would make the browser style the page again.
const written = new WeakMap();

export function set(node, attributes) {
  let before = written.get(node);
  if (!before) {
    written.set(node, (before = {}));
  }
  for (const name in attributes) {
    const value = String(attributes[name]);
    if (before[name] !== value) {
      before[name] = value;
      node.setAttribute(name, value);
    }
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

/** The next child of a parent that is being filled (slots.js), with these attributes and no others. */
export function drawn(parent, name, attributes, text = '') {
  const node = slot(parent, `${name} ${Object.keys(attributes)}`, () => document.createElementNS(SVG, name));
  set(node, attributes);
  if (node.textContent !== text) {
    node.textContent = text;
  }
  return node;
}

export const points = (list) => list.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(' ');

const KEYS = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, -1, 0],
  ArrowDown: [0, 1, 0],
  PageUp: [0, 0, 1],
  PageDown: [0, 0, -1],
};

/** How many steps a press of a key goes. */
export const stepsOf = ({ shiftKey }) => (shiftKey ? 10 : 1);

/**
 * Lets a node be dragged by mouse, pen and one finger: `move(dx, dy, event)` in CSS pixels; and by keys: `step(dx, dy, deeper)`
 * for arrows, page up and down, in steps, ten at once with shift; and `ends(part)` for home, 0, and end, 1, where there are some. A
 * finger that drags does not scroll the page, unless `scrolls`.
 */
export function draggable(node, { move, step, ends, scrolls = false }) {
  if (!scrolls) {
    // touch-action is for elements of HTML and whole drawings, not for parts of them.
    node.addEventListener('touchstart', (event) => event.preventDefault(), { passive: false });
  }
  node.addEventListener('pointerdown', (event) => {
    if (!event.isPrimary || event.button !== 0) {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    node.setPointerCapture(event.pointerId);
    node.focus({ preventScroll: true });
    let last = [event.clientX, event.clientY];
    let latest = null; // event that nobody has heard of yet: there may be several in a frame
    const tell = () => {
      if (latest) {
        const at = latest;
        latest = null;
        move(at.clientX - last[0], at.clientY - last[1], at);
        last = [at.clientX, at.clientY];
      }
    };
    const drag = new AbortController();
    const listen = (kind, callback) =>
      node.addEventListener(kind, (at) => at.pointerId === event.pointerId && callback(at), { signal: drag.signal });
    listen('pointermove', (at) => {
      latest = at;
      beforeFrame(tell);
    });
    for (const kind of ['pointerup', 'pointercancel']) {
      listen(kind, () => {
        tell();
        drag.abort();
      });
    }
  });
  node.addEventListener('keydown', (event) => {
    if (KEYS[event.key]) {
      event.preventDefault();
      event.stopPropagation();
      step(...KEYS[event.key].map((part) => part * stepsOf(event)));
    } else if (ends && (event.key === 'Home' || event.key === 'End')) {
      event.preventDefault();
      ends(event.key === 'Home' ? 0 : 1);
    }
  });
}
