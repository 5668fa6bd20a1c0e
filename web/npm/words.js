// SPDX-License-Identifier: MIT
// Options as the words of rhw render's command line, which the module gives to the program's own parser: names,
// defaults, limits and messages are the program's.
import { colorWord } from './color.js';
import { RhwError } from './error.js';

const asIs = (name) => (value) => [`--${name}=${value}`];
const onOff = (name) => (value) => [`--${name}=${value ? 'on' : 'off'}`];
const flag = (name) => (value) => (value ? [`--${name}`] : []);
const list = (name) => (value) => [`--${name}=${[value].flat().join(',')}`];

// Degrees, by the name that the program has or by that of other libraries.
function angle(value, options) {
    if (options.fovy !== undefined && options.fov !== undefined) {
        throw new RhwError('rhw: fov: is fovy by another name, and both are given');
    }
    return [`--fovy=${value}`];
}

// true: the option without its argument.
const optional = (name) => (value) => (value === true ? [`--${name}`] : value === false ? [] : [`--${name}=${value}`]);

function size(value) {
    return [`--size=${[value].flat().join('x')}`];
}

function camera(value, options) {
    if (typeof value === 'number') {
        return [`--camera-index=${value}`];
    }
    if (typeof value === 'string') {
        return [`--camera-name=${value}`];
    }
    if (options.ortho && !value.orthographic) {
        throw new RhwError('rhw: ortho: cannot be together with a camera in perspective; give that orthographic: true');
    }
    const places = { eye: value.eye, target: value.target, up: value.up ?? [0, 1, 0] };
    for (const [name, place] of Object.entries(places)) {
        if (!(place?.length === 3 && [...place].every(Number.isFinite))) {
            throw new RhwError(`rhw: camera: ${name} is not three numbers`);
        }
    }
    if (value.fovy !== undefined && value.fov !== undefined) {
        throw new RhwError('rhw: camera: fov is fovy by another name, and both are given');
    }
    const lens = value.orthographic ? value.height : (value.fovy ?? value.fov ?? 30);
    const numbers = [...Object.values(places).flatMap((place) => [...place]), lens].join(',');
    return [...(value.orthographic ? ['--ortho'] : []), `--camera=${numbers}`];
}

const reading = {
    variant: asIs('variant'),
    animation: asIs('animation'),
    time: asIs('time'),
    maxTexture: asIs('max-texture'),
    strict: flag('strict'),
};

const drawing = {
    size,
    samples: asIs('samples'),
    supersample: asIs('supersample'),
    camera,
    orbit: list('orbit'),
    fit: optional('fit'),
    up: asIs('up'),
    zoom: asIs('zoom'),
    margin: asIs('margin'),
    ortho: flag('ortho'),
    fovy: angle,
    fov: angle,
    interpolate: asIs('interpolate'),
    wireframe: optional('wireframe'),
    background: (value) => [`--background=${colorWord(value)}`],
    lights: asIs('lights'),
    shadows: onOff('shadows'),
    ground: flag('ground'),
    ambientOcclusion: onOff('ambient-occlusion'),
    toneMap: asIs('tone-map'),
    transparency: asIs('transparency'),
    exposure: asIs('exposure'),
};

// Names of options that are no words.
const others = { reading: ['name', 'files', 'threads', 'signal'], drawing: ['outputs', 'fragmentShader', 'goesOn', 'signal'] };

// What the program calls otherwise than the options and arguments here.
const renamed = { 'camera-index': 'camera', 'camera-name': 'camera', at: 'explain', sample: 'sample' };
const optionOf = {
    ...Object.fromEntries(Object.keys({ ...reading, ...drawing }).map((name) => [name.replace(/[A-Z]/g, '-$&').toLowerCase(), name])),
    ...renamed,
};

/** A line of the program's, with options by their names here, but in what it quotes. */
export function inOptions(line) {
    return line
        .replace(/; see 'rhw [a-z]+ --help'/, '')
        .replace(/(?<=[ (])'[^']*'|(?<![\w-])--([a-z]+(?:-[a-z]+)*)/g, (word, name) => optionOf[name] ?? word);
}

function wordsOf(options, table, known) {
    return Object.entries(options).flatMap(([name, value]) => {
        if (value === undefined || known.includes(name)) {
            return [];
        }
        if (!Object.hasOwn(table, name)) {
            const names = [...new Set([...known, ...Object.keys(table)])];
            throw new RhwError(`rhw: '${name}' is no option; there are ${names.join(', ')}`);
        }
        const words = table[name](value, options);
        if (words.some((word) => word.includes('\0'))) {
            throw new RhwError(`rhw: ${name}: a character with code 0 is in it`);
        }
        return words;
    });
}

/** Of load. Textures stay as large as they are, since nobody knows yet how large pictures will be. */
export function readingWords(options) {
    return ['--max-texture=16384', ...wordsOf(options, reading, others.reading)];
}

/** Of render, in one go. */
export function allWords(options) {
    return wordsOf(options, { ...reading, ...drawing }, [...others.reading, ...others.drawing]);
}

/** Of the methods of a scene. */
export function drawingWords(options) {
    return wordsOf(options, drawing, others.drawing);
}

/** Those of render that are for a scene's. */
export function drawingOptions(options) {
    const names = [...others.drawing, ...Object.keys(drawing)];
    return Object.fromEntries(Object.entries(options).filter(([name]) => names.includes(name)));
}
