// SPDX-License-Identifier: MIT
// The checks in node, and in a worker of it: node in_node.js DATA, in a folder with the package installed.
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { isMainThread, parentPort, Worker, workerData } from 'node:worker_threads';

import * as rhw from 'rhw';

import { check } from './checks.js';

function checkHere(folder) {
    return check(rhw, async (name) => new Uint8Array(await readFile(join(folder, name))), 1);
}

function checkInWorker(folder) {
    return new Promise((resolve, reject) => {
        const worker = new Worker(new URL(import.meta.url), { workerData: folder });
        worker.once('message', resolve);
        worker.once('error', reject);
    });
}

function report(where, { count, failures }) {
    failures.forEach((failure) => console.log(`${where}: ${failure}`));
    console.log(`${where}: ${count - failures.length} of ${count} passed`);
    process.exitCode ||= failures.length > 0 ? 1 : 0;
}

if (isMainThread) {
    const folder = process.argv[2];
    report('node', await checkHere(folder));
    report('worker of node', await checkInWorker(folder));
} else {
    parentPort.postMessage(await checkHere(workerData));
}
