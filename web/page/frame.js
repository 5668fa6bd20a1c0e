// SPDX-License-Identifier: MIT
// Draws what changed, once a frame of the browser, after what the pointer did since the last one.

const moves = new Set();
const waiting = new Set();
let isAsked = false; // whether a frame is to come in which what is asked for now is drawn

function take(callbacks) {
  const due = [...callbacks];
  callbacks.clear();
  return due;
}

function draw(time) {
  take(moves).forEach((callback) => callback(time));
  isAsked = false;
  take(waiting).forEach((callback) => callback(time));
}

function ask(callbacks, callback) {
  callbacks.add(callback);
  if (!isAsked) {
    isAsked = true;
    requestAnimationFrame(draw);
  }
}

/** Calls `callback` with the next frame, once however often it is asked for. */
export const nextFrame = (callback) => ask(waiting, callback);

/** Calls `callback` with the next frame, before what is drawn then. */
export const beforeFrame = (callback) => ask(moves, callback);
