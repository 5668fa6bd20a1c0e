// SPDX-License-Identifier: MIT
// A thread of node in the clothes of a page's Worker, as far as the module with threads wants one. It keeps node running
// until it has loaded the module, and not after that: a scene that nobody closed ends with the program.
import { Worker } from 'node:worker_threads';

export class NodeWorker {
    #thread;

    constructor(url) {
        this.#thread = new Worker(new URL('./node_thread.js', import.meta.url), { workerData: String(url) });
        this.#thread.on('message', (data) => {
            if (data.cmd === 'loaded') {
                this.#thread.unref();
            }
            this.onmessage({ data });
        });
        this.#thread.on('error', (error) => this.onerror(error));
    }

    postMessage(message) {
        this.#thread.postMessage(message);
    }

    terminate() {
        this.#thread.terminate();
    }
}
