// SPDX-License-Identifier: MIT
// The npm package in a worker (model_worker.js), as calls that are answered later.

export class Library {
  #worker = new Worker(new URL('model_worker.js', import.meta.url), { type: 'module' });
  #waiting = new Map();
  #count = 0;

  constructor() {
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
    };
  }

  /** The result of a call of model_worker.js; it fails with rhw's line. */
  ask(call, what = {}) {
    const id = ++this.#count;
    return new Promise((done, fail) => {
      this.#waiting.set(id, { done, fail });
      this.#worker.postMessage({ id, call, ...what });
    });
  }
}
