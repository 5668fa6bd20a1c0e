// SPDX-License-Identifier: MIT
// Instances of the WebAssembly modules (web/module/web_module.h), each with memory of its own, and what goes in and
// out of them. Either module, for one thread or for several, is loaded when it is first wanted, once.
import { RhwError } from './error.js';
import { platform } from './platform.js';
import { inOptions } from './words.js';

// Addresses in the form that bundlers look for. Threads load the script anew, from a file: in a bundle it is none.
const single = { url: new URL('./rhw.wasm', import.meta.url), script: () => import('./rhw.js') };
const threaded = {
    url: new URL('./rhw-threads.wasm', import.meta.url),
    script: () => import('./rhw-threads.js'),
    file: new URL('./rhw-threads.js', import.meta.url).href,
};

async function loadKind(kind) {
    const [module, { default: create }] = await Promise.all([platform.compile(kind.url), kind.script()]);
    return { module, create };
}

function loaded(kind) {
    kind.loading ??= loadKind(kind).catch((error) => {
        kind.loading = undefined; // the network may be back the next time
        throw error;
    });
    return kind.loading;
}

/** How many threads can draw here: they share memory, which pages may do where they are cross-origin isolated. */
export function mostThreads() {
    const most = 64; // RHW_MAX_THREADS
    return Math.min(platform.cores(), most);
}

/** The bytes of an ArrayBuffer or a view of one. `what` names them where they are none. */
export function bytesOf(source, what) {
    if (ArrayBuffer.isView(source)) {
        return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
    }
    if (source instanceof ArrayBuffer) {
        return new Uint8Array(source);
    }
    throw new RhwError(`rhw: ${what}: must be a Uint8Array or an ArrayBuffer`);
}

export class Instance {
    /** @param threads that its contexts will have at most */
    static async create(threads = 1) {
        const kind = threads > 1 ? threaded : single;
        const { module, create } = await loaded(kind);
        const instance = new Instance();
        instance.said = [];
        instance.complaints = [];
        instance.crashed = false;
        const options = {
            cores: mostThreads(),
            mainScriptUrlOrBlob: kind.file,
            helpThreads: threads - 1, // beside the one that calls; web/CMakeLists.txt makes workers for them
            instantiateWasm(imports, done) {
                WebAssembly.instantiate(module, imports).then((made) => done(made, module));
                return {};
            },
            print: (line) => instance.said.push(line),
            printErr: (line) => instance.complaints.push(line), // of libraries; rhw's own lines are messages()
        };
        instance.module = await (kind === threaded ? platform.withWorkers(() => create(options)) : create(options));
        return instance;
    }

    /**
     * Ends its workers. Its memory goes when nobody holds it. The threads' data stays there, which
     * PThread.terminateAllThreads clears: a worker goes on for a moment, and reads it where its thread has just begun.
     */
    end() {
        const { unusedWorkers = [], runningWorkers = [] } = this.module.PThread ?? {};
        for (const workers of [unusedWorkers, runningWorkers]) {
            workers.splice(0).forEach((worker) => worker.terminate());
        }
    }

    /** Bytes in the module's memory, 64-byte aligned. */
    allocate(size) {
        const address = size < 2 ** 32 - 128 ? this.module._web_allocate(size) >>> 0 : 0;
        if (address === 0) {
            throw new RhwError(`rhw: needs more memory than there is (${size} bytes more)`);
        }
        return address;
    }

    free(address) {
        if (!this.crashed) {
            this.module._web_free(address);
        }
    }

    /** Copies an ArrayBuffer or a view of one into the module's memory. */
    copyIn(source) {
        const bytes = bytesOf(source, 'memory');
        const address = this.allocate(bytes.length);
        this.module.HEAPU8.set(bytes, address);
        return address;
    }

    /** A copy of `length` elements of the module's memory. */
    copyOut(Type, address, length) {
        return new Type(this.module.HEAPU8.buffer, address >>> 0, length).slice();
    }

    /** Calls `run(address, size)` with words, each with a 0 behind it, in the module's memory. */
    withWords(words, run) {
        const bytes = new TextEncoder().encode(words.map((word) => `${word}\0`).join(''));
        const address = this.copyIn(bytes);
        try {
            return run(address, bytes.length);
        } finally {
            this.free(address);
        }
    }

    /** The lines of a text in the module's memory. */
    linesAt(address) {
        const heap = this.module.HEAPU8;
        const start = address >>> 0;
        const text = new TextDecoder().decode(heap.slice(start, heap.indexOf(0, start)));
        return text.split('\n').filter((line) => line !== '');
    }

    /** What rhw has said since it was called, a line each, with options by their names here. */
    messages() {
        return this.linesAt(this.module._web_messages()).map(inOptions);
    }

    /** All outputs by their names: bit, the type of the elements, and how many a pixel has. */
    outputs() {
        const types = [Uint8ClampedArray, Uint32Array, Float32Array]; // enum scene_element
        const rows = this.linesAt(this.module._web_outputs()).map((line) => line.split(' '));
        rows.sort((a, b) => a[1] - b[1]);
        return Object.fromEntries(rows.map(([name, bit, element, count]) =>
            [name, { bit: Number(bit), Type: types[element], count: Number(count) }]));
    }

    /** What it has printed since. */
    takeSaid() {
        return this.said.splice(0).join('\n');
    }

    /** Calls an entry point. What traps is an error about `subject`, and leaves nothing that could be gone on with. */
    call(subject, name, ...values) {
        try {
            return this.module[name](...values);
        } catch (trap) {
            if (trap?.name === 'ExitStatus') {
                return trap.status; // of web_read, which ends so
            }
            const why = this.complaints.find((line) => !line.startsWith('Aborted')) ?? trap?.message ?? trap;
            this.crashed = true;
            this.end();
            throw new RhwError(`rhw: ${subject}: needs more memory than there is, or crashed (${why})`);
        }
    }

    /** The last message as an error. */
    error() {
        return new RhwError(this.messages().pop() ?? 'rhw: failed and did not say why');
    }
}
