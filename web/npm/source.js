// SPDX-License-Identifier: MIT
// Models by their addresses: the file, and those beside it that it names, which are known when it is read.
import { RhwError } from './error.js';
import { bytesOf } from './instance.js';
import { platform } from './platform.js';

/** Rejects with the reason of a signal that was given. What was under way before is heard of first. */
export async function checkSignal(signal) {
    if (signal) {
        await new Promise((heard) => setTimeout(heard));
        throwIfAborted(signal);
    }
}

export function throwIfAborted(signal) {
    if (signal?.aborted) {
        throw signal.reason ?? new DOMException('This operation was aborted', 'AbortError');
    }
}

function addressOf(model) {
    try {
        return new URL(model, platform.base());
    } catch {
        throw new RhwError(`rhw: model: '${model}' is no address of a file`);
    }
}

function lastPart(url) {
    const part = url.pathname.split('/').pop();
    try {
        return decodeURIComponent(part);
    } catch {
        return part; // a "%" that codes nothing
    }
}

// The address of a file by its path as seen from another; undefined where nothing lies beside that, as with blob: and data:.
function addressBeside(path, url) {
    try {
        return new URL(path.split('/').map(encodeURIComponent).join('/'), url);
    } catch {
        return undefined;
    }
}

/**
 * What is to be read: {bytes, name, fetchBeside}. `fetchBeside(path)` gives the bytes of a file by its path as seen from the model;
 * it is undefined for bytes, and gives undefined where there is no such file.
 */
export async function openSource(model, { name, signal }) {
    if (typeof model !== 'string' && !(model instanceof URL)) {
        return { bytes: bytesOf(model, 'model'), name: name ?? 'model' };
    }
    const url = addressOf(model);
    const read = (address) => platform.read(address, signal).catch((error) => {
        throwIfAborted(signal);
        throw error;
    });
    const fetchBeside = (path) => {
        const beside = addressBeside(path, url);
        if (!beside) {
            return undefined;
        }
        beside.search = url.search; // where an address is signed, those beside it are too
        return read(beside).catch((error) => {
            throwIfAborted(signal);
            if (!(error instanceof RhwError)) {
                throw error;
            }
            return undefined; // the reader warns of it, or refuses the model
        });
    };
    return { bytes: await read(url), name: name ?? (lastPart(url) || 'model'), fetchBeside };
}
