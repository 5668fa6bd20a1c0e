// SPDX-License-Identifier: MIT
// The checks in node, and in a worker of it: node in_node.js DATA, in a folder with the package installed.
import { readFile } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { isMainThread, parentPort, Worker, workerData } from 'node:worker_threads';

import * as rhw from 'rhw';

import { checkAddressesOf } from './addresses.js';
import { check } from './checks.js';

function checkHere(folder) {
    const read = async (name) => new Uint8Array(await readFile(join(folder, name)));
    return check(rhw, read, availableParallelism(), (name) => pathToFileURL(join(folder, name)).href);
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

// A model that cannot be written down, as where memory ends: the whole message, and no model.
async function checkReply() {
    const failures = [];
    const { Instance } = await import(new URL('node_modules/rhw/instance.js', import.meta.url).href);
    const reader = await Instance.create();
    const { FS: fs } = reader.module;
    const full = fs.makedev(64, 0), noSpace = 51;
    const write = () => {
        throw new fs.ErrnoError(noSpace);
    };
    fs.registerDevice(full, { open() {}, close() {}, write });
    fs.mkdev('/reply', full);
    fs.writeFile('/a.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
    const status = reader.withWords(['--', '/a.obj'], (...place) => reader.call('a', '_web_read', ...place));
    const { message } = reader.error();
    if (status !== 3 || message !== 'rhw: /a.obj: there is not enough memory for the model') {
        failures.push(`a reply that cannot be written: ${status}, ${message}`);
    }
    return { count: 1, failures };
}

// With threads, and as many as are asked for; a scene that nobody closes does not keep node running.
async function checkThreads(folder) {
    const failures = [];
    const box = await readFile(join(folder, JSON.parse(await readFile(join(folder, 'data.json'))).cases[0].model));
    for (const threads of [1, 2]) {
        const scene = await rhw.load(box, { threads });
        const wanted = Math.min(threads, availableParallelism());
        if (scene.render({ size: 64 }).threads !== wanted) {
            failures.push(`not ${wanted} threads`);
        }
    }
    if ('Worker' in globalThis) {
        failures.push('Worker is left behind');
    }
    return { count: 3, failures };
}

async function checkAddresses() {
    const { platform } = await import(new URL('node_modules/rhw/platform.js', import.meta.url).href);
    return checkAddressesOf(rhw, platform);
}

if (isMainThread) {
    const folder = process.argv[2];
    report('addresses', await checkAddresses());
    report('messages', await checkReply());
    report('threads', await checkThreads(folder));
    report('node', await checkHere(folder));
    report('worker of node', await checkInWorker(folder));
} else {
    parentPort.postMessage(await checkHere(workerData));
}
