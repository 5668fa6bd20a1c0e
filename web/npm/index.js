// SPDX-License-Identifier: MIT
// rhw for pages and workers, and by node.js for node: see index.d.ts, which has the documentation, and README.md, which has
// examples.
import { RhwError } from './error.js';
import { bytesOf, Instance, mostThreads } from './instance.js';
import { checkSignal, openSource, throwIfAborted } from './source.js';
import { allWords, drawingOptions, drawingWords, readingWords } from './words.js';

export { RhwError };

// Reading --------------------------------------------------------------------------------------------------------

const folder = '/model';

// A path as seen from the model's folder as a whole one, without links to a folder itself and the one above.
function wholePath(path) {
    const parts = [];
    for (const part of (path.startsWith('/') ? path : `${folder}/${path}`).split('/')) {
        if (part === '..') {
            parts.pop();
        } else if (part !== '' && part !== '.') {
            parts.push(part);
        }
    }
    return `/${parts.join('/')}`;
}

function writeFile(fs, name, bytes, option) {
    const path = wholePath(`${folder}/${name}`);
    const content = bytesOf(bytes, name);
    try {
        fs.mkdirTree(path.slice(0, path.lastIndexOf('/')));
        fs.writeFile(path, content);
    } catch (error) {
        if (error.errno === undefined) {
            throw error; // not of the file system
        }
        throw new RhwError(`rhw: ${option}: '${name}' is no path of a file, or is that of a folder of another`);
    }
}

// A path below the model's folder, as seen from there; undefined if it lies elsewhere.
function belowFolder(path) {
    const whole = wholePath(path);
    return whole.startsWith(`${folder}/`) ? whole.slice(folder.length + 1) : undefined;
}

// Files below the model's folder that were looked for and are not there.
function listMissing(fs) {
    const missing = new Set();
    for (const call of ['open', 'stat']) {
        const plain = fs[call];
        fs[call] = (path, ...values) => {
            try {
                return plain(path, ...values);
            } catch (error) {
                const inside = typeof path === 'string' ? belowFolder(path) : undefined;
                if (inside) {
                    missing.add(inside);
                }
                throw error;
            }
        };
    }
    return missing;
}

// The model in an instance of its own: what the reader said, and the files that it missed.
async function readOnce(model, name, files, words) {
    const reader = await Instance.create();
    const { FS: fs } = reader.module;
    fs.mkdirTree(folder);
    for (const [path, bytes] of Object.entries(files)) {
        writeFile(fs, path, bytes, 'files');
    }
    writeFile(fs, name, model, 'name');
    fs.chdir(folder);
    const missing = listMissing(fs);
    const status = reader.withWords(words, (...place) => reader.call(name, '_web_read', ...place));
    return { reader, status, missing };
}

// The model as the bytes that a scene stands on. What it names is fetched where there is something to fetch it from: what these
// files name in turn is known when they are read, as an .obj names an .mtl and that its textures.
async function read({ bytes, name, fetchBeside }, given, words, signal) {
    const files = { ...given };
    const asked = new Set();
    for (;;) {
        const { reader, status, missing } = await readOnce(bytes, name, files, words);
        const wanted = fetchBeside ? [...missing].filter((path) => !asked.has(path)) : [];
        wanted.forEach((path) => asked.add(path));
        const found = (await Promise.all(wanted.map(async (path) => [path, await fetchBeside(path)]))).filter(([, file]) => file);
        await checkSignal(signal);
        if (found.length > 0) {
            Object.assign(files, Object.fromEntries(found));
        } else if (status !== 0) {
            throw reader.error();
        } else {
            return reader.module.FS.readFile('/reply');
        }
    }
}

function threadsOf({ threads }) {
    const most = mostThreads();
    if (threads !== undefined && (!Number.isInteger(threads) || threads < 1)) {
        throw new RhwError(`rhw: threads: '${threads}' is not a number from 1`);
    }
    return Math.min(threads ?? most, most);
}

async function open(model, options, words) {
    const { files = {}, signal } = options;
    throwIfAborted(signal);
    const threads = threadsOf(options);
    const source = await openSource(model, options);
    const name = source.name.replace(/^\/+/, ''); // its place is in the module's memory
    const all = [...words, '--', name];
    const bytes = await read({ ...source, name }, files, all, signal);
    const instance = await Instance.create(threads);
    const address = instance.copyIn(bytes);
    const handle = instance.withWords(all, (...place) =>
        instance.call(name, '_web_scene_open', address, bytes.length, ...place));
    if (handle === 0) {
        instance.end();
        throw instance.error();
    }
    return new Scene({ instance, handle, threads, warnings: instance.messages() });
}

export async function load(model, options = {}) {
    return open(model, options, readingWords(options));
}

export async function render(model, options = {}) {
    const scene = await open(model, options, allWords(options));
    try {
        await checkSignal(options.signal);
        const picture = scene.render(drawingOptions(options));
        return { ...picture, warnings: [...scene.warnings, ...picture.warnings] };
    } finally {
        scene.close();
    }
}

// Positions that count from a model's origin, in the coordinates of its file; they need no more than floats where these
// are the same.
function inFile(positions, origin) {
    if (origin.every((number) => number === 0)) {
        return positions;
    }
    const moved = [...origin, 0];
    return Float64Array.from(positions, (value, i) => value + (positions[i | 3] > 0 ? moved[i % 4] : 0));
}

// Scenes ---------------------------------------------------------------------------------------------------------

function checkOutputs(outputs, names) {
    const unknown = names.find((name) => !Object.hasOwn(outputs, name));
    if (unknown !== undefined || names.length === 0) {
        throw new RhwError(`rhw: outputs: ${unknown === undefined ? 'none' : `'${unknown}'`} is no output; there are ` +
                           Object.keys(outputs).join(', '));
    }
}


export class Scene {
    #instance;
    #handle;
    #threads;
    #warnings;

    /** @internal scenes are made by load */
    constructor({ instance, handle, threads, warnings }) {
        this.#instance = instance;
        this.#handle = handle;
        this.#threads = threads;
        this.#warnings = warnings;
    }

    get warnings() {
        return [...this.#warnings];
    }

    info() {
        this.#call('_web_scene_info');
        return JSON.parse(this.#instance.takeSaid());
    }

    view(options = {}) {
        this.#ask('_web_scene_look', drawingWords(options));
        return this.#view().view;
    }

    render(options = {}) {
        const names = [options.outputs ?? 'color'].flat();
        const outputs = this.#held().outputs();
        checkOutputs(outputs, names);
        const bits = names.reduce((sum, name) => sum | outputs[name].bit, 0);
        const words = drawingWords(options);
        this.#shade(options.fragmentShader);
        this.#askWhile(options, () => this.#ask('_web_scene_render', words, bits));
        const { view, origin } = this.#view();
        const pixels = view.width * view.height;
        const pictures = names.map((name) => {
            const { bit, Type, count } = outputs[name];
            const picture = this.#instance.copyOut(Type, this.#call('_web_scene_picture', bit), pixels * count);
            return [name, name === 'position' ? inFile(picture, origin) : picture];
        });
        const threads = this.#call('_web_scene_threads');
        return { ...view, ...Object.fromEntries(pictures), threads, warnings: this.#instance.messages() };
    }

    explain(x, y, { sample = 0, ...options } = {}) {
        if (options.fragmentShader !== undefined) {
            throw new RhwError('rhw: fragmentShader: cannot be explained');
        }
        if (![x, y, sample].every((number) => Number.isInteger(number) && number >= 0 && number < 16384)) {
            throw new RhwError(`rhw: explain: ${x},${y}, sample ${sample} is no sample of a pixel, from 0,0 on`);
        }
        this.#ask('_web_scene_explain', drawingWords(options), x, y, sample);
        const [json, text] = this.#instance.takeSaid().split('\n\f\n');
        return { ...JSON.parse(json), text };
    }

    close() {
        this.#instance?.end();
        this.#instance = undefined; // and with it all of its memory
    }

    #held() {
        if (this.#instance === undefined || this.#instance.crashed) {
            throw new RhwError(`rhw: the scene ${this.#instance ? 'has crashed' : 'is closed'}`);
        }
        return this.#instance;
    }

    // Calls an entry point of the module with this scene.
    #call(name, ...values) {
        return this.#held().call('scene', name, this.#handle, ...values);
    }

    // The same with words that choose a view, of which more may be the last.
    #ask(name, words, ...values) {
        const all = [`--threads=${this.#threads}`, ...words, '--', 'model'];
        const instance = this.#held();
        if (!instance.withWords(all, (...place) => this.#call(name, ...place, ...values))) {
            throw instance.error();
        }
    }

    // Shades by SPIR-V from now on, or by materials.
    #shade(words) {
        const instance = this.#held();
        const bytes = words === undefined ? new Uint8Array() : bytesOf(words, 'fragmentShader');
        const address = instance.copyIn(bytes);
        const isTaken = this.#call('_web_scene_shade', address, bytes.length);
        instance.free(address);
        if (!isTaken) {
            throw instance.error();
        }
    }

    // Draws as long as `goesOn()` is true. What it throws goes to the caller, not through the module.
    #askWhile({ goesOn, signal }, draw) {
        const { module } = this.#held();
        let failure;
        throwIfAborted(signal);
        module.goesOn = goesOn && (() => {
            try {
                failure = goesOn() ? undefined : new RhwError('rhw: given up, as goesOn returned false');
                throwIfAborted(signal);
            } catch (error) {
                failure = error;
            }
            return failure === undefined;
        });
        try {
            draw();
        } catch (error) {
            throw failure ?? error;
        } finally {
            module.goesOn = undefined;
        }
    }

    // The one that was chosen last; the numbers are those of web_scene_view.
    #view() {
        const [width, height, ...n] = this.#instance.copyOut(Float64Array, this.#call('_web_scene_view'), 19);
        const [orthographic, fovy, halfHeight, near, far, ...origin] = n.slice(9);
        const camera = {
            eye: n.slice(0, 3),
            target: n.slice(3, 6),
            up: n.slice(6, 9),
            ...(orthographic ? { orthographic: true, height: 2 * halfHeight } : { fovy }),
            near,
            far: far === 0 ? Infinity : far,
        };
        return { view: { width, height, camera }, origin };
    }
}

// Triangles ------------------------------------------------------------------------------------------------------

const culls = ['none', 'front', 'back'];
const depthRanges = ['zero-to-one', 'minus-one-to-one'];

function choose(option, name, names) {
    const choice = names.indexOf(name);
    if (choice < 0) {
        throw new RhwError(`rhw: ${option}: '${name}' is not one of ${names.join(', ')}`);
    }
    return choice;
}

function checkArray(option, array, Type, rule, fits = () => true) {
    if (!(array instanceof Type) || !fits(array.length)) {
        throw new RhwError(`rhw: ${option}: must be a ${Type.name} ${rule}`);
    }
}

const rasterizers = new Map(); // by how many threads they have at most

async function rasterizerInstance(threads) {
    if (!rasterizers.has(threads)) {
        rasterizers.set(threads, Instance.create(threads));
    }
    const waited = rasterizers.get(threads);
    const instance = await waited.catch(() => undefined);
    if (instance && !instance.crashed) {
        return instance;
    }
    if (rasterizers.get(threads) === waited) { // who waits for it too may have been first
        rasterizers.delete(threads);
        instance?.end();
    }
    return instance ? rasterizerInstance(threads) : waited;
}

// What lies in the module's memory for a call, and is freed after it.
class Lent {
    #instance;
    #addresses = [];

    constructor(instance) {
        this.#instance = instance;
    }

    give(array) {
        this.#addresses.push(array === undefined ? 0 : this.#instance.copyIn(array));
        return this.#addresses.at(-1);
    }

    room(size) {
        this.#addresses.push(this.#instance.allocate(size));
        return this.#addresses.at(-1);
    }

    takeBack() {
        this.#addresses.forEach((address) => this.#instance.free(address));
    }
}

const maxSide = 16384; // RHW_MAX_TARGET_SIZE

export async function rasterize(triangles) {
    const { positions, indices, matrix, components = 4, cull = 'none', depthRange = 'zero-to-one' } = triangles;
    const [width, height] = [triangles.size].flat().length === 1 ? [triangles.size, triangles.size] : triangles.size;
    if (![width, height].every(Number.isInteger)) {
        throw new RhwError(`rhw: size: '${triangles.size}' is not [width, height] or one number`);
    }
    if (![width, height].every((side) => side >= 1 && side <= maxSide)) { // before there is room for it
        throw new RhwError(`rhw: rasterize: size ${width}x${height}: width and height must lie between 1 and ${maxSide}`);
    }
    if (components !== 3 && components !== 4) {
        throw new RhwError(`rhw: components: '${components}' is not 3 or 4`);
    }
    checkArray('positions', positions, Float32Array, `of ${components} numbers for each vertex`,
               (length) => length % components === 0);
    if (indices !== undefined) {
        checkArray('indices', indices, Uint32Array, 'of 3 numbers for each triangle');
    }
    if (matrix !== undefined) {
        checkArray('matrix', matrix, Float32Array, 'of 16 numbers, column by column', (length) => length === 16);
    }
    const rules = [choose('cull', cull, culls), choose('depthRange', depthRange, depthRanges)];
    const threads = threadsOf(triangles);
    const instance = await rasterizerInstance(threads === 1 ? 1 : mostThreads());
    const lent = new Lent(instance);
    try {
        const vertices = positions.length / components;
        const pixels = width * height;
        const asked = [lent.give(positions), lent.give(indices), lent.give(matrix)];
        const [ids, depth, barycentric] = [4, 4, 16].map((size) => lent.room(Math.max(pixels, 1) * size));
        const words = [width, height, asked[0], components, vertices, asked[1], indices?.length ?? vertices, asked[2],
                       ...rules, threads, ids, depth, barycentric];
        const place = lent.give(Uint32Array.from(words));
        if (!instance.call('rasterize', '_web_rasterize', place)) {
            throw instance.error();
        }
        return {
            width,
            height,
            ids: instance.copyOut(Uint32Array, ids, pixels),
            depth: instance.copyOut(Float32Array, depth, pixels),
            barycentric: instance.copyOut(Float32Array, barycentric, 4 * pixels),
            threads: instance.copyOut(Uint32Array, place, words.length).at(-4),
        };
    } finally {
        lent.takeBack();
    }
}
