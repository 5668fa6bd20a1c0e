// SPDX-License-Identifier: MIT
// What differs between pages, with their workers, and node: how files are read, and what threads there are. Here is what pages
// have; node.js puts what node has in its place, so that a page's bundle has nothing of node's.
import { RhwError } from './error.js';

/** The response to a request. An answer that is none is an error. */
async function request(url, signal) {
    let response;
    try {
        response = await fetch(url, { signal });
    } catch (error) {
        throw signal?.aborted ? error : new RhwError(`rhw: ${url}: ${error.message}`);
    }
    if (!response.ok) {
        throw new RhwError(`rhw: ${url}: ${response.status} ${response.statusText}`.trimEnd());
    }
    return response;
}

export const platform = {
    /** The module of a file with WebAssembly. Servers that do not know the type are many. */
    async compile(url) {
        const response = await request(url);
        return response.headers.get('content-type') === 'application/wasm'
            ? WebAssembly.compileStreaming(response)
            : WebAssembly.compile(await response.arrayBuffer());
    },

    /** The bytes of a file that a caller names. */
    async read(url, signal) {
        return new Uint8Array(await (await request(url, signal)).arrayBuffer());
    },

    /** What relative addresses are relative to. */
    base: () => globalThis.document?.baseURI ?? globalThis.location?.href,

    /** How many threads could run at a time and share memory. */
    cores: () => (globalThis.crossOriginIsolated && typeof Worker === 'function' ? navigator.hardwareConcurrency : 1),

    /** Calls `make`, which makes workers while it runs. */
    withWorkers: (make) => make(),
};
