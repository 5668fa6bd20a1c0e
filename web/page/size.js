// SPDX-License-Identifier: MIT
// How large elements are. The browser tells of every change of a size once it has laid out the page, so that nobody who asks
// makes it lay out the page at once, before all that a frame changes is written.

const sizes = new WeakMap();

const observer = new ResizeObserver((entries) => entries.forEach(({ target }) => measure(target)));

/** [width, height] of an element in CSS pixels, as it is now: for what draws before the next frame. */
export function measure(node) {
  const size = [node.clientWidth, node.clientHeight];
  sizes.set(node, size);
  return size;
}

/** [width, height] of an element in CSS pixels, as it was when the page was laid out last. */
export function sizeOf(node) {
  if (!sizes.has(node)) {
    measure(node);
    observer.observe(node);
  }
  return sizes.get(node);
}
