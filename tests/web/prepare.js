// SPDX-License-Identifier: MIT
// What the checks compare with: node prepare.js RHW MODELS FOLDER writes the models of cases.js and what the program
// RHW makes of them, and data.json, which says where.
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';

import { cases, explained } from './cases.js';

const [rhw, models, folder] = process.argv.slice(2);

function run(...words) {
    return execFileSync(rhw, words, { maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'inherit'] });
}

function write(name, bytes) {
    writeFileSync(join(folder, name), bytes);
    return name;
}

mkdirSync(folder, { recursive: true });
const data = cases.map(({ name, model, files = [], options, words }, number) => {
    const own = `${number}`;
    mkdirSync(join(folder, own));
    for (const file of [basename(model), ...files]) {
        copyFileSync(join(models, dirname(model), file), join(folder, own, file));
    }
    const path = join(folder, own, basename(model));
    return {
        name,
        model: join(own, basename(model)),
        files: files.map((file) => join(own, file)),
        options,
        picture: write(`${own}.ppm`, run('render', path, '--quiet', '--format=ppm', '--out=-', ...words)),
    };
});

const at = [`--at=${explained.x},${explained.y}`, `--sample=${explained.sample}`];
const plain = join(folder, data[0].model);
const normals = ['--output=normal', '--bits=16', '--size=97x61', '--format=ppm', '--out=-'];
// A shader: the template, in SPIR-V, and what the program draws with its text.
const shader = join(folder, write('mine.frag', run('render', '--fragment-shader-template')));
run('shader', shader, '--out', join(folder, 'mine.spv'));
write('data.json', JSON.stringify({
    cases: data,
    explained,
    json: write('explain.json', run('explain', plain, ...at, '--json')),
    text: write('explain.txt', run('explain', plain, ...at)),
    info: write('info.json', run('info', plain, '--json')),
    shader: 'mine.spv',
    shaded: write('shaded.ppm', run('render', plain, '--quiet', `--fragment-shader=${shader}`, '--size=97x61', '--format=ppm', '--out=-')),
    normals: write('normals.ppm', run('render', plain, '--quiet', ...normals)),
}));
