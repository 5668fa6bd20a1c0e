// SPDX-License-Identifier: MIT
// The package for node (platform.js).
import { readFile } from 'node:fs/promises';
import { availableParallelism, cpus } from 'node:os';
import { pathToFileURL } from 'node:url';

import { RhwError } from './error.js';
import { NodeWorker } from './node_worker.js';
import { platform } from './platform.js';

const { read } = platform;

async function readUrl(url, signal) {
    if (url.protocol !== 'file:') {
        return read(url, signal);
    }
    try {
        return await readFile(url, { signal });
    } catch (error) {
        throw signal?.aborted ? error : new RhwError(`rhw: ${url.pathname}: ${error.code === 'ENOENT' ? 'no such file' : error.message}`);
    }
}

// Node has threads, but no Worker, which the module makes some of while it is called: it finds one then alone.
function withWorkers(make) {
    const before = Object.getOwnPropertyDescriptor(globalThis, 'Worker');
    Object.defineProperty(globalThis, 'Worker', { value: NodeWorker, configurable: true });
    try {
        return make();
    } finally {
        before ? Object.defineProperty(globalThis, 'Worker', before) : delete globalThis.Worker;
    }
}

Object.assign(platform, {
    compile: async (url) => WebAssembly.compile(await readFile(url)),
    read: readUrl,
    base: () => pathToFileURL(`${process.cwd()}/`).href,
    cores: () => availableParallelism?.() ?? cpus().length,
    withWorkers,
});

export * from './index.js';
