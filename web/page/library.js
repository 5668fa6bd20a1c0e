// SPDX-License-Identifier: MIT
// The npm package in a worker (model_worker.js), as calls that are answered later.

export class Library {
  #worker;
  #waiting = new Map();
  #count = 0;
  // The worker hears nothing while it draws, but where pages may share memory it looks here: how often pictures were given up.
  #turn = globalThis.crossOriginIsolated ? new Int32Array(new SharedArrayBuffer(4)) : null;

  constructor() {
    this.#start();
  }

  #start() {
    this.#worker = new Worker(new URL('model_worker.js', import.meta.url), { type: 'module' });
    this.#worker.postMessage({ turn: this.#turn });
    this.#worker.onmessage = ({ data: { id, result, error } }) => {
      const { done, fail } = this.#waiting.get(id);
      this.#waiting.delete(id);
      error === undefined ? done(result) : fail(new Error(error));
    };
    this.#worker.onerror = (event) => {
      event.preventDefault();
      const error = new Error(event.message || 'the library could not be loaded');
      this.#waiting.forEach(({ fail }) => fail(error));
      this.#waiting.clear();
      this.#worker.terminate();
      this.#worker = null; // the network may be back the next time
    };
  }

  /** Gives up the picture that is being drawn, whose result is null then; if pages may share memory. */
  giveUp() {
    if (this.#turn) {
      Atomics.add(this.#turn, 0, 1);
    }
  }

  /** The result of a call of model_worker.js; it fails with rhw's line. */
  ask(call, what = {}) {
    const id = ++this.#count;
    if (!this.#worker) {
      this.#start();
    }
    return new Promise((done, fail) => {
      this.#waiting.set(id, { done, fail });
      this.#worker.postMessage({ id, call, mine: this.#turn && Atomics.load(this.#turn, 0), ...what });
    });
  }
}
