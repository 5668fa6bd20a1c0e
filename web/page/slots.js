// SPDX-License-Identifier: MIT
// Panels that are written anew for every pixel, in the same order each time. A node stays where it has the key that it had, and
// only its text changes; else another one is made. So a drag makes no nodes, and the browser lays out little.

const counts = new WeakMap(); // parent → how many of its children are written so far
const keys = new WeakMap(); // child → key

/** Writes the children of `parent`: `write()` calls slot() for each. Children that it does not come to are removed. */
export function fill(parent, write) {
  counts.set(parent, 0);
  write(parent);
  while (parent.childNodes.length > counts.get(parent)) {
    parent.lastChild.remove();
  }
}

/** The next child of a parent that is being filled: the one that is there if it has this key, else what `make()` returns. */
export function slot(parent, key, make) {
  const index = counts.get(parent);
  counts.set(parent, index + 1);
  const old = parent.childNodes[index];
  if (old && keys.get(old) === key) {
    return old;
  }
  const node = make();
  keys.set(node, key);
  old ? old.replaceWith(node) : parent.append(node);
  return node;
}

/** An element as the next child. */
export const element = (parent, tag, kind = '') =>
  slot(parent, `${tag} ${kind}`, () => Object.assign(document.createElement(tag), { className: kind }));

/** Sets the text of a node that has nothing but text, if it is another one. */
export function write(node, text) {
  const inside = node.firstChild;
  if (!inside) {
    node.textContent = text;
  } else if (inside.data !== text) {
    inside.data = text;
  }
  return node;
}

/** A text as the next child. */
export function text(parent, string) {
  const node = slot(parent, 'text', () => document.createTextNode(string));
  if (node.data !== string) {
    node.data = string;
  }
}
