// SPDX-License-Identifier: MIT
// What a screen reader says when numbers have changed and rest.
import { short } from './math.js';
import { write } from './slots.js';

const REST = 250; // ms without a change until it is said
const lines = new WeakMap(); // panel → {node, timer}

function lineOf(panel) {
  const node = document.createElement('p');
  node.className = 'heard';
  node.setAttribute('aria-live', 'polite');
  panel.after(node);
  return { node };
}

/** Says a text about what `panel` shows. */
export function hear(panel, text) {
  if (!lines.has(panel)) {
    lines.set(panel, lineOf(panel));
  }
  const line = lines.get(panel);
  clearTimeout(line.timer);
  line.timer = setTimeout(() => write(line.node, text), REST);
}

/** Names of the shares of a pixel, on the screen and in space. */
export const SHARES = ['r', 's', 't', 'a', 'b', 'c'];

/** Says numbers with their names, or nothing where there are none. */
export function hearNumbers(panel, numbers, names = SHARES) {
  hear(panel, numbers ? names.map((name) => `${name} ${short(numbers[name])}`).join(', ') : '');
}
