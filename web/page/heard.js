// SPDX-License-Identifier: MIT
// What a screen reader says when numbers have changed and rest. It says what changes in the chapter that the reader works with, and
// nothing of the others: all of them are told anew when they begin, and when the language changes.
import { short } from './math.js';
import { write } from './slots.js';

const REST = 250; // ms without a change until it is said
const lines = new WeakMap(); // panel → {node, timer}
let worked = null; // section of the chapter that was pointed at, or got the focus, last

function workWith({ target }) {
  const section = target.closest?.('section.chapter');
  if (section && section !== worked) {
    worked = section;
    for (const node of document.querySelectorAll('.chapter [aria-live]')) {
      node.setAttribute('aria-live', section.contains(node) ? 'polite' : 'off');
    }
  }
}

/** Listens on the whole page. */
export function startHearing() {
  for (const kind of ['focusin', 'pointerdown']) {
    document.addEventListener(kind, workWith, { capture: true });
  }
}

function lineOf(panel) {
  const node = document.createElement('p');
  node.className = 'heard';
  node.setAttribute('aria-live', worked?.contains(panel) ? 'polite' : 'off');
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
