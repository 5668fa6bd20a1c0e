// SPDX-License-Identifier: MIT
// What the package fetches for a model that is given by its address, and what it calls that: checkAddressesOf(rhw, platform) has
// files of its own in the place of a network, notes which addresses are asked for, and returns how many checks there were and a
// line for each that failed.

const triangle = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n';

/** Loads a model where these files, by their addresses, are all that there is. Gives its name and what was asked for after it. */
async function loadFrom(rhw, platform, model, files, options) {
    const plain = platform.read, asked = [];
    platform.read = async (url) => {
        asked.push(url.href);
        if (!(url.href in files)) {
            throw new rhw.RhwError(`rhw: ${url}: 404`);
        }
        return new TextEncoder().encode(files[url.href]);
    };
    try {
        const scene = await rhw.load(model, options);
        const { file } = scene.info();
        scene.close();
        return { name: file, asked: asked.slice(1) };
    } finally {
        platform.read = plain;
    }
}

const names = {
    'https://h/a/m%20x.obj': 'm x.obj',
    'https://h/a/m%zz.obj': 'm%zz.obj', // codes nothing
    'https://h/a/m.obj?name=b/c.ply#d/e': 'm.obj',
    'https://h/a/%2Fm.obj': 'm.obj',
    'https://h/': 'model',
};

// What an .mtl names, and what is asked for below https://h/a/b/, where the model lies. What lies above it is not asked for.
const beside = {
    't.png': ['t.png'],
    './t.png': ['t.png'],
    'in//./t.png': ['in/t.png'],
    'in/../t.png': ['t.png'],
    '../t.png': [],
    '../../../t.png': [],
    'in/../../t.png': [],
    '../model/t.png': ['t.png'], // where the module keeps the files
    '../models/t.png': [],
    '/etc/t.png': [],
    '/model/in/t.png': ['in/t.png'],
    'C:\\in\\t.png': ['C%3A%5Cin%5Ct.png', 'C%3A/in/t.png'],
    'a#b%20.png': ['a%23b%2520.png', 'a%23b%20.png', 'a'],
    'https://other/t.png': ['https%3A/other/t.png'],
};

export async function checkAddressesOf(rhw, platform) {
    let count = 0;
    const failures = [];
    const same = (what, got, wanted) => {
        count++;
        if (JSON.stringify(got) !== JSON.stringify(wanted)) {
            failures.push(`${what}: ${JSON.stringify(got)}`);
        }
    };
    for (const [address, name] of Object.entries(names)) {
        same(address, (await loadFrom(rhw, platform, address, { [new URL(address).href]: triangle })).name, name);
    }
    const model = 'https://h/a/b/m.obj?key=1';
    for (const [path, wanted] of Object.entries(beside)) {
        const { asked } = await loadFrom(rhw, platform, model, {
            [model]: `mtllib m.mtl\nusemtl m\n${triangle}`,
            'https://h/a/b/m.mtl?key=1': `newmtl m\nmap_Kd ${path}\n`,
        });
        same(path, asked, ['m.mtl', ...wanted].map((name) => `https://h/a/b/${name}?key=1`));
    }
    const data = `data:text/plain,${encodeURIComponent(`mtllib m.mtl\n${triangle}`)}`;
    const { asked } = await loadFrom(rhw, platform, data, { [data]: `mtllib m.mtl\n${triangle}` }, { name: 'm.obj' });
    same('nothing lies beside data', asked, []);
    return { count, failures };
}
