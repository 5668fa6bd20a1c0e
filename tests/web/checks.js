// SPDX-License-Identifier: MIT
// What the package promises, checked wherever modules run: check(rhw, read, threads) takes the package, a function
// that gives the bytes of a file of prepare.js, how many threads should draw, and a function that gives the address of a
// file, and returns how many checks there were and a line for each that failed.

const decoder = new TextDecoder();

/** The samples behind the header of a PPM file: of 8 bits, or of 16, the high byte first. */
function samplesOf(ppm) {
    const header = decoder.decode(ppm.subarray(0, 64));
    const [, width, height, most] = /^P6\s+(\d+)\s+(\d+)\s+(\d+)\s/.exec(header).map(Number);
    const wide = most > 255, count = 3 * width * height;
    const bytes = ppm.subarray(ppm.length - count * (wide ? 2 : 1));
    const samples = wide ? Uint16Array.from({ length: count }, (_, i) => bytes[2 * i] * 256 + bytes[2 * i + 1]) : bytes;
    return { width, height, samples };
}

function firstDifference(a, b) {
    return a.length === b.length ? a.findIndex((value, i) => value !== b[i]) : Math.min(a.length, b.length);
}

class Checks {
    count = 0;
    failures = [];

    that(what, holds, more = '') {
        this.count++;
        if (!holds) {
            this.failures.push(`${what}${more === '' ? '' : `: ${more}`}`);
        }
    }

    same(what, got, wanted) {
        this.that(what, JSON.stringify(got) === JSON.stringify(wanted), JSON.stringify(got)?.slice(0, 300));
    }

    samples(what, got, wanted) {
        const at = firstDifference(got, wanted);
        this.that(what, at < 0, `sample ${at} of ${wanted.length} is ${got[at]}, not ${wanted[at]}`);
    }

    async fails(what, promise, pattern) {
        const error = await promise.then(() => undefined, (reason) => reason);
        this.that(what, error?.name === 'RhwError' && pattern.test(error.message), String(error));
    }
}

function withoutAlpha(color) {
    return color.filter((_, i) => i % 4 !== 3);
}

async function checkPictures(checks, rhw, read, cases) {
    for (const { name, model, files, options, picture } of cases) {
        const beside = await Promise.all(files.map(async (file) => [file.split('/').pop(), await read(file)]));
        const drawn = await rhw.render(await read(model), {
            ...options, name: model.split('/').pop(), files: Object.fromEntries(beside),
        });
        const { width, height, samples } = samplesOf(await read(picture));
        checks.same(`${name}: size`, [drawn.width, drawn.height], [width, height]);
        checks.samples(`${name}: pixels`, withoutAlpha(drawn.color), samples);
    }
}

// Of a model by its address, with the files that it names.
async function checkAddresses(checks, rhw, read, cases, address) {
    for (const { name, model, options, picture } of cases.filter(({ files }) => files.length > 0)) {
        const drawn = await rhw.render(address(model), options);
        const { samples } = samplesOf(await read(picture));
        checks.samples(`${name}, by its address: pixels`, withoutAlpha(drawn.color), samples);
    }
    const box = cases[0].model;
    const scene = await rhw.load(new URL(address(box), globalThis.location?.href));
    checks.same('the name of an address', scene.info().file, 'BoxTextured.glb');
    scene.close();
    await checks.fails('no such address', rhw.load(`${address(box)}x`), /^rhw: .*BoxTextured\.glbx: (404|no such file)/);
}

async function checkSignals(checks, rhw, box, address) {
    const reasons = await Promise.all([
        rhw.render(box, { signal: AbortSignal.abort('late') }),
        rhw.load(address, { signal: AbortSignal.abort('late') }),
        ...[1, 20].map((wait) => {
            const controller = new AbortController();
            setTimeout(() => controller.abort('late'), wait);
            return rhw.load(address, { signal: controller.signal }).then((scene) => {
                scene.close();
                return 'loaded';
            });
        }),
    ].map((promise) => promise.then(() => 'drawn', (reason) => reason)));
    checks.same('aborted', reasons.slice(0, 3), ['late', 'late', 'late']);
    const scene = await rhw.load(box, { signal: new AbortController().signal });
    let thrown;
    try {
        scene.render({ signal: AbortSignal.abort('late') });
    } catch (error) {
        thrown = error;
    }
    checks.same('aborted before it is drawn', thrown, 'late');
    scene.close();
}

// A thread that fails does so in a worker, and whoever runs the checks hears of it.
async function checkClosing(checks, rhw, box) {
    for (let i = 0; i < 10; i++) {
        const scene = await rhw.load(box);
        const { color } = scene.render({ size: 1, samples: 1 });
        scene.close(); // some of its threads have not begun yet
        checks.same('a scene that is closed at once', color.length, 4);
    }
}

// What shades is that of each picture, and may change.
async function checkShader(checks, rhw, read, { cases, shader, shaded }) {
    const box = await read(cases[0].model), fragmentShader = await read(shader);
    const { samples } = samplesOf(await read(shaded));
    const view = { size: [97, 61] };
    const scene = await rhw.load(box, { name: 'box.glb' });
    const plain = scene.render(view).color;
    for (const time of ['first', 'second']) {
        checks.samples(`shaded, the ${time} time`, withoutAlpha(scene.render({ ...view, fragmentShader }).color), samples);
    }
    checks.same('what is said of it', scene.explain(48, 30, view).text !== '', true);
    checks.samples('materials again', scene.render(view).color, plain);
    const cut = fragmentShader.slice(0, 400);
    for (const [bytes, rule] of [[cut, '.+'], [new Uint8Array(3), 'a SPIR-V module is a number of whole words'],
                                 [Uint8Array.of(...fragmentShader.slice(0, 20)), '.+']]) {
        await checks.fails('a shader that is none', (async () => scene.render({ ...view, fragmentShader: bytes }))(),
                           new RegExp(`^rhw: fragmentShader: ${rule}`));
    }
    await checks.fails('a shader in words', (async () => scene.render({ ...view, fragmentShader: 'void main() {}' }))(),
                       /^rhw: fragmentShader: must be a Uint8Array or an ArrayBuffer$/);
    await checks.fails('a shader with wires', (async () => scene.render({ ...view, fragmentShader, wireframe: true }))(),
                       /^rhw: render: fragment shader: has no /);
    await checks.fails('a shader that is explained', (async () => scene.explain(1, 1, { fragmentShader }))(),
                       /^rhw: fragmentShader: cannot be explained$/);
    checks.samples('materials after all', scene.render(view).color, plain);
    scene.close();
}

async function checkColors(checks, rhw, box) {
    const scene = await rhw.load(box);
    const corner = (background) => [...scene.render({ size: 8, zoom: 0.1, samples: 1, background }).color.slice(0, 4)];
    const orange = [255, 136, 0, 255];
    for (const color of ['ff8800', '#f80', '#FF8800', '#ff8800ff', '#f80f', 0xff8800, 'rgb(255, 136, 0)', ' rgb(255 136 0) ',
                         'rgba(255,136,0,1)', 'rgb(100% 53.33% 0% / 100%)', 'hsl(32 100% 50%)', 'hsla(32deg, 100%, 50%, 1)']) {
        checks.same(`background ${color}`, corner(color), orange);
    }
    checks.same('a name of style sheets', [corner('rebeccapurple'), corner('Tomato')], [[102, 51, 153, 255], [255, 99, 71, 255]]);
    checks.same('nothing', [corner('transparent'), corner('#12345600'), corner('rgb(1 2 3 / 0)')].map((color) => color[3]), [0, 0, 0]);
    for (const [color, pattern] of [['#12345680', /'#12345680' is seen through in part/], [-1, /'-1' is not a number from 0/],
                                    ['rgb(1, 2)', /'rgb\(1, 2\)' is not a colour/], ['rgb(1,,2)', /'rgb\(1,,2\)' is not a colour/], ['tomatoe', /'tomatoe' is not a colour/]]) {
        await checks.fails(`background ${color}`, (async () => corner(color))(), new RegExp(`^rhw: background: ${pattern.source}`));
    }
    const view = (options) => JSON.stringify(scene.view({ size: 8, ...options }));
    const camera = { eye: [0, 0, 9], target: [0, 0, 0] };
    checks.same('fov', [view({ fov: 50 }), view({ camera: { ...camera, fov: 50 } })],
                [view({ fovy: 50 }), view({ camera: { ...camera, fovy: 50 } })]);
    await checks.fails('fov and fovy', (async () => view({ fov: 50, fovy: 50 }))(), /^rhw: fov: is fovy by another name/);
    scene.close();
}

async function checkScene(checks, rhw, read, data, threads) {
    const first = data.cases[0];
    const scene = await rhw.load(await read(first.model), { name: 'BoxTextured.glb' });
    const { samples } = samplesOf(await read(first.picture));
    const drawn = scene.render();
    checks.samples('a scene draws', withoutAlpha(drawn.color), samples);
    checks.same('threads', drawn.threads, threads);
    scene.render({ size: 50, orbit: 100 });
    checks.samples('and again, after another view', withoutAlpha(scene.render().color), samples);
    const { camera } = scene.view({ size: 50, orbit: 100 });
    checks.samples('a camera can be given back', scene.render({ size: 50, camera, samples: 1 }).color,
                   scene.render({ size: 50, orbit: 100, samples: 1 }).color);

    const { file, ...info } = JSON.parse(decoder.decode(await read(data.info)));
    const { file: name, ...own } = scene.info();
    checks.same('info', own, info);
    checks.same('info has the name', name, 'BoxTextured.glb');

    const { x, y, sample } = data.explained;
    const { text, model, ...explained } = scene.explain(x, y, { sample });
    const { model: path, ...wanted } = JSON.parse(decoder.decode(await read(data.json)));
    checks.same('explain', explained, wanted);
    const wantedText = decoder.decode(await read(data.text));
    checks.same('explain as text', `${text}\n`.slice(model.length), wantedText.slice(path.length));
    checkData(checks, scene, samplesOf(await read(data.normals)).samples);

    checkGivingUp(checks, scene);
    checks.samples('and again, after a picture that was given up', withoutAlpha(scene.render().color), samples);

    scene.close();
    await checks.fails('a closed scene', (async () => scene.render())(), /^rhw: the scene is closed$/);
    await checks.fails('and its info', (async () => scene.info())(), /^rhw: the scene is closed$/);
}

function checkGivingUp(checks, scene) {
    const whole = (options) => {
        let asked = 0;
        scene.render({ goesOn: () => ++asked > 0, ...options });
        return asked;
    };
    const all = whole({});
    checks.that('a picture asks all the while', all > 100, all);
    const error = (goesOn) => {
        try {
            scene.render({ goesOn });
        } catch (thrown) {
            return thrown;
        }
        return undefined;
    };
    for (const left of [0, 1, Math.floor(all / 2)]) {
        let asked = 0;
        const { name, message } = error(() => asked++ < left) ?? {};
        checks.same(`given up after ${left}`, [name, message, asked],
                    ['RhwError', 'rhw: given up, as goesOn returned false', left + 1]);
    }
    const own = new Error('mine');
    checks.that('what goesOn throws', error(() => {
        throw own;
    }) === own);
}

function checkData(checks, scene, normals) {
    const outputs = [
        'color', 'linear', 'depth', 'distance', 'normal', 'position', 'uv', 'object', 'triangle', 'barycentric',
        'overdraw', 'tiles', 'plan',
    ];
    const drawn = scene.render({ size: [97, 61], outputs });
    const to16 = (value) => Math.floor(Math.fround(Math.fround(value * 65535) + 0.5));
    const mapped = drawn.normal.reduce((list, value, i) => {
        if (i % 4 !== 3) {
            list.push(drawn.normal[i - (i % 4) + 3] === 0 ? 0 : to16(Math.fround(Math.fround(value + 1) * 0.5)));
        }
        return list;
    }, []);
    checks.samples('normals', mapped, normals);
    const pixels = 97 * 61;
    const sizes = outputs.map((name) => drawn[name].length / pixels);
    checks.same('sizes of outputs', sizes, [4, 4, 1, 1, 4, 4, 4, 1, 1, 4, 1, 1, 1]);
    let seen = 0, wrong = 0;
    for (let i = 0; i < pixels; i++) {
        const [a, b, c, hit] = drawn.barycentric.subarray(4 * i, 4 * i + 4);
        const nothing = drawn.triangle[i] === 0;
        seen += nothing ? 0 : 1;
        wrong += nothing !== (drawn.depth[i] === 1) || nothing !== (drawn.distance[i] === Infinity) ||
                 nothing !== (drawn.object[i] === 0) || nothing !== (hit === 0) || drawn.triangle[i] > 12 ||
                 (!nothing && Math.abs(a + b + c - 1) > 1e-6) ||
                 (!nothing && (drawn.overdraw[i] < 1 || drawn.tiles[i] === 0 || drawn.plan[i] === 0));
    }
    checks.that('something is seen, and something is not', seen > pixels / 10 && seen < (pixels * 9) / 10, seen);
    checks.same('data outputs agree on where nothing is', wrong, 0);
    const { fragments } = scene.explain(48, 30, { size: [97, 61], samples: 1 });
    checks.same('explain and ids agree', fragments.findLast(({ fate }) => fate === 'written').triangle + 1,
                drawn.triangle[30 * 97 + 48]);
}

async function checkErrors(checks, rhw, read, data) {
    const box = await read(data.cases[0].model);
    await checks.fails('no model', rhw.load(new Uint8Array(0), { name: 'a.glb' }), /^rhw: a\.glb: /);
    await checks.fails('a model that is no bytes', rhw.load(7), /^rhw: model: must be a Uint8Array/);
    await checks.fails('a cut model', rhw.load(box.subarray(0, 1000), { name: 'cut.glb' }), /^rhw: cut\.glb: .+/);
    const named = new TextEncoder().encode('mtllib ../m/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n');
    const mtl = new TextEncoder().encode('newmtl a\n');
    checks.same('a file beside the folder', (await rhw.render(named, { size: 4, name: 'a.obj', files: { '../m/a.mtl': mtl } })).warnings, []);
    for (const [option, given] of [['name', { name: '' }], ['files', { files: { '': mtl } }], ['files', { files: { x: mtl, 'x/y': mtl } }]]) {
        await checks.fails(`no path in ${option}`, rhw.render(named, { size: 4, ...given }), new RegExp(`^rhw: ${option}: '.*' is no path of a file`));
    }
    await checks.fails('a format that is not read', rhw.load(box.subarray(20), { name: 'a.fbx' }),
                       /^rhw: a\.fbx: is FBX, which is not read here; glTF, OBJ, PLY, STL and 3MF are$/);
    await checks.fails('an option that is none', rhw.render(box, { sise: 4 }),
                       /^rhw: 'sise' is no option; there are name, /);
    await checks.fails('a bad value', rhw.render(box, { samples: 3 }), /^rhw: samples: '3' is not 1, 2, 4, 8 or 16$/);
    await checks.fails('a bad output', rhw.render(box, { outputs: ['depht'] }),
                       /^rhw: outputs: 'depht' is no output; /);
    await checks.fails('a name of two words', rhw.render(box, { toneMap: 'film' }), /^rhw: toneMap: 'film' is not neutral, /);
    await checks.fails('an argument of words', rhw.render(box, { zoom: '--zoom' }), /^rhw: zoom: '--zoom' is not /);
    await checks.fails('half a camera', rhw.render(box, { camera: { eye: [1, 2, 3] } }),
                       /^rhw: camera: target is not three numbers$/);
    await checks.fails('two that do not go together', rhw.render(box, { orbit: 3, camera: 0 }), /^rhw: camera: cannot be together with orbit$/);
    await checks.fails('no threads', rhw.render(box, { threads: 0 }), /^rhw: threads: '0' is not a number from 1$/);
    await checks.fails('a bad camera', rhw.render(box, { camera: 7 }), /^rhw: camera: model has no cameras$/);
    await checks.fails('a variant that is not there', rhw.load(box, { variant: 'red' }),
                       /^rhw: model: has no variants/);
    const scene = await rhw.load(box);
    await checks.fails('a pixel outside', (async () => scene.explain(1280, 0))(),
                       /^rhw: explain: 1280,0 lies outside the picture, which is 1280x720$/);
    await checks.fails('what cannot be explained', (async () => scene.explain(0, 0, { transparency: 'exact' }))(),
                       /^rhw: transparency: cannot be explained; without it the same surfaces are told in another order$/);
    await checks.fails('pictures of 4 GiB', (async () => scene.render({ size: 16384, outputs: ['normal'] }))(),
                       /^rhw: model: Out of memory$/);
    const obj = new TextEncoder().encode('mtllib no.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
    const { warnings } = await rhw.render(obj, { name: 'a.obj', size: 8 });
    checks.that('a warning', warnings.length === 1 && /^rhw: a\.obj: warning: .*no\.mtl/.test(warnings[0]), warnings);
    await checks.fails('a warning with strict', rhw.render(obj, { name: 'a.obj', strict: true }),
                       /^rhw: a\.obj: is not drawn as /);
    const far = new TextEncoder().encode('v 5e6 0 4e6\nv 5000001.5 0 4e6\nv 5e6 1.25 4e6\nf 1 2 3\n');
    const { position, color } = await rhw.render(far, { name: 'far.obj', size: 8, outputs: ['position', 'color'] });
    const hit = position.findIndex((value, i) => i % 4 === 3 && value === 1) - 3;
    checks.that('positions far from the origin', position instanceof Float64Array && hit >= 0 &&
                position[hit] > 5e6 && position[hit] < 5000001.5 && position[hit + 2] === 4e6, [...position]);
    const near = new TextEncoder().encode('v 0 0 0\nv 1.5 0 0\nv 0 1.25 0\nf 1 2 3\n');
    const same = await rhw.render(near, { name: 'near.obj', size: 8, outputs: ['position', 'color'] });
    checks.same('a picture far from the origin', [...color], [...same.color]);
    checks.that('positions near the origin', same.position instanceof Float32Array);
    const pair = new TextEncoder().encode('v 0 0 0\nv 1.5 0 0\nv 0 1.25 0\nv 5e7 0 0\nv 50000001.5 0 0\nv 5e7 1.25 0\n' +
                                          'f 1 2 3\nf 4 5 6\n');
    const near5e7 = { eye: [50000000.5, 0.5, 4], target: [50000000.5, 0.5, 0] };
    const part = await rhw.render(pair, { name: 'pair.obj', size: 8, outputs: 'position', camera: near5e7 });
    const there = part.position.findIndex((value, i) => i % 4 === 3 && value === 1) - 3;
    checks.that('positions of a part far from the others', part.position instanceof Float64Array && there >= 0 &&
                part.position[there] > 5e7 && part.position[there] % 1 !== 0, [...part.position]);
}

async function checkTriangles(checks, rhw, threads) {
    const square = new Float32Array([-1, -1, 0.5, 1, -1, 0.5, -1, 1, 0.5, 1, 1, 0.5]);
    const indices = new Uint32Array([0, 1, 2, 2, 1, 3]);
    // The diagonal goes through the centres of four pixels, of which it is the left edge of the second triangle.
    const two = await rhw.rasterize({ size: 4, positions: square, components: 3, indices });
    checks.same('ids', [...two.ids], [2, 2, 2, 2, 1, 2, 2, 2, 1, 1, 2, 2, 1, 1, 1, 2]);
    checks.that('depth', two.depth.every((depth) => depth === 0.5));
    const turnedAway = new Uint32Array([0, 1, 2, 3, 1, 2]);
    const back = await rhw.rasterize({ size: 4, positions: square, components: 3, indices: turnedAway, cull: 'back' });
    checks.same('culled', [...back.ids], [0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0]);

    // W is 1 below and 3 above: at a quarter of the height r, s, t are not a, b, c.
    const slope = new Float32Array([-1, -1, 0, 1, 1, -1, 0, 1, -3, 3, 0, 3]);
    const one = await rhw.rasterize({ size: [1, 2], positions: slope });
    // The pixels' centres are (1/2, 1/2) and (1/2, 3/2) from the top left: on the screen t = 3/4 and 1/4, s = 1/2, so
    // the upper one is outside and in the lower one r = 1/4; 1/W = 3/4 + 1/12, and a, b, c = 3/10, 6/10, 1/10.
    checks.same('ids in perspective', [...one.ids], [0, 1]);
    const close = [0.3, 0.6, 0.1].every((weight, i) => Math.abs(one.barycentric[4 + i] - weight) < 1e-7);
    checks.that('weights in perspective', close, one.barycentric);

    const turned = new Float32Array([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]); // a quarter, against the clock
    const moved = await rhw.rasterize({ size: 4, positions: square, components: 3, indices, matrix: turned });
    checks.same('a matrix', [...moved.ids], [2, 2, 2, 1, 2, 2, 1, 1, 2, 1, 1, 1, 1, 1, 1, 1]);
    const nearer = new Float32Array([-1, -1, 0.9, 3, -1, 0.9, -1, 3, 0.9, -1, -1, 0.1, 3, -1, 0.1, -1, 3, 0.1]);
    checks.same('the nearer one', [...(await rhw.rasterize({ size: 1, positions: nearer, components: 3 })).ids], [2]);
    const none = await rhw.rasterize({ size: 2, positions: new Float32Array(0) });
    checks.same('no triangles', [[...none.ids], [...none.depth]], [[0, 0, 0, 0], [1, 1, 1, 1]]);

    const many = Float32Array.from({ length: 3 * 4 * 300 }, (_, i) => i % 4 < 2 ? Math.sin(i * i) : i % 4 === 2 ? i / 7200 : 1);
    const [all, single] = [await rhw.rasterize({ size: 300, positions: many }), await rhw.rasterize({ size: 300, positions: many, threads: 1 })];
    checks.same('threads of triangles', [all.threads, single.threads], [threads, 1]);
    checks.that('something is drawn', single.ids.some((id) => id !== 0));
    for (const name of ['ids', 'depth', 'barycentric']) {
        checks.that(`${name} with threads`, all[name].every((value, i) => value === single[name][i]));
    }
    await checks.fails('no threads for triangles', rhw.rasterize({ size: 4, positions: square, threads: 0 }),
                       /^rhw: threads: '0' is not a number from 1$/);

    const good = { size: 4, positions: square, components: 3, indices };
    const bad = (what, change, pattern) => checks.fails(what, rhw.rasterize({ ...good, ...change }), pattern);
    await bad('a size beyond 32 bits', { size: [-4294967196, 100] }, /^rhw: rasterize: size -4294967196x100: width and height/);
    await bad('no size', { size: 0 }, /^rhw: rasterize: size 0x0: width and height must lie between 1 and 16384$/);
    await bad('too much', { size: 16384 }, /^rhw: needs more memory than there is/);
    await bad('positions of doubles', { positions: new Float64Array(9) }, /^rhw: positions: must be a Float32Array/);
    await bad('an index too large', { indices: new Uint32Array([0, 1, 4]) },
              /^rhw: rasterize: index 4 at 2: there are 4 positions$/);
    await bad('too few indices', { indices: new Uint32Array(4) },
              /^rhw: rasterize: 4 indices: a triangle takes three$/);
    await bad('a short matrix', { matrix: new Float32Array(9) }, /^rhw: matrix: must be a Float32Array of 16 numbers/);
    await bad('a word', { cull: 'both' }, /^rhw: cull: 'both' is not one of none, front, back$/);
}

export async function check(rhw, read, threads, address) {
    const checks = new Checks();
    const data = JSON.parse(decoder.decode(await read('data.json')));
    await checkPictures(checks, rhw, read, data.cases);
    await checkAddresses(checks, rhw, read, data.cases, address);
    const box = data.cases[0].model;
    await checkSignals(checks, rhw, await read(box), address(box));
    await checkClosing(checks, rhw, await read(box));
    await checkShader(checks, rhw, read, data);
    await checkColors(checks, rhw, await read(box));
    await checkScene(checks, rhw, read, data, threads);
    await checkErrors(checks, rhw, read, data);
    await checkTriangles(checks, rhw, threads);
    return { count: checks.count, failures: checks.failures };
}
