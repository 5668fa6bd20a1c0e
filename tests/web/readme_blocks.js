// SPDX-License-Identifier: MIT
// The examples of the package's README as files that tsc reads: node readme_blocks.js README FOLDER writes each block of JavaScript
// with the names that it takes for granted declared, those of workers into FOLDER/worker, all others into FOLDER/page.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const GRANTED = {
    glb: 'Uint8Array<ArrayBuffer>',
    obj: 'ArrayBuffer',
    mtl: 'ArrayBuffer',
    jpeg: 'ArrayBuffer',
    toon: 'Uint8Array',
    shared: 'SharedArrayBuffer',
    view: "import('rhw').RenderOptions",
    scene: "import('rhw').Scene",
    positions: 'Float32Array',
    indices: 'Uint32Array',
    matrix: 'Float32Array',
    render: "typeof import('rhw').render",
};

const [readme, folder] = process.argv.slice(2);
const blocks = [...readFileSync(readme, 'utf8').matchAll(/^```js\n(.*?)^```$/gms)].map(([, text]) => text);

for (const kind of ['page', 'worker']) {
    mkdirSync(join(folder, kind), { recursive: true });
}
blocks.forEach((text, i) => {
    const isDeclared = (name) => new RegExp(`(?:let|const|import) [^=;]*\\b${name}\\b`).test(text);
    const granted = Object.entries(GRANTED).filter(([name]) => !isDeclared(name));
    const lines = granted.map(([name, type]) => `declare const ${name}: ${type};\n`);
    const kind = text.startsWith('// worker.js') ? 'worker' : 'page';
    writeFileSync(join(folder, kind, `block${i}.mts`), `${lines.join('')}${text}\nexport {};\n`);
});
if (blocks.length < 5) {
    throw new Error(`${readme}: has ${blocks.length} examples`);
}
