// SPDX-License-Identifier: MIT
// Draws what changed, once a frame of the browser.

const waiting = new Set();

function draw(time) {
  const due = [...waiting];
  waiting.clear();
  due.forEach((callback) => callback(time));
}

/** Calls `callback` with the next frame, once however often it is asked for. */
export function nextFrame(callback) {
  if (waiting.size === 0) {
    requestAnimationFrame(draw);
  }
  waiting.add(callback);
}
