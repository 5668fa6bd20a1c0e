// SPDX-License-Identifier: MIT
// What a thread of node needs to be taken for a page's worker by the script that the module with threads has for those.
import { parentPort, workerData } from 'node:worker_threads';

Object.assign(globalThis, {
    self: globalThis,
    location: { href: workerData },
    importScripts() {}, // by which it knows a worker
    postMessage: (message) => parentPort.postMessage(message),
});
await import(workerData);
parentPort.on('message', (data) => globalThis.onmessage({ data }));
