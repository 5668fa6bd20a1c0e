// SPDX-License-Identifier: MIT
// What the types of the package allow and what they refuse; tsc --strict reads this, nobody runs it.
import { load, rasterize, render, RhwError, type Explanation, type Picture, type Scene } from 'rhw';

const bytes = new Uint8Array(8);

const plain: Picture = await render(bytes);
const color: Uint8ClampedArray = plain.color;
// @ts-expect-error only what was asked for is there
plain.depth;

const image = new ImageData(plain.color, plain.width, plain.height), blob: Blob = new Blob([plain.color]);
const fetched: Picture = await render('models/chair.gltf', { signal: new AbortController().signal, background: 0xff8800, fov: 45 });
await render(new URL('file:///chair.glb'), { camera: { eye: [0, 0, 1], target: [0, 0, 0], fov: 45 }, background: '#f80' });
// @ts-expect-error a model is none
await render(7);

const data = await render(bytes.buffer, { size: [64, 32], outputs: ['depth', 'triangle'], camera: 0, time: 1.5 });
const depth: Float32Array = data.depth, triangles: Uint32Array = data.triangle;
// @ts-expect-error color was not
data.color;
// @ts-expect-error 3 samples are none of the choices
await render(bytes, { samples: 3 });
// @ts-expect-error there is no such output
await render(bytes, { outputs: ['depht'] });
// @ts-expect-error there is no such option
await render(bytes, { sise: 64 });

const scene: Scene = await load(bytes, { name: 'a.obj', files: { 'a.mtl': new Uint8Array(1) } });
const { camera } = scene.view({ orbit: [30, 20] });
scene.render({ camera, goesOn: () => true });
scene.render({ fragmentShader: new Uint8Array(20) });
scene.render({ camera, size: 64, outputs: ['normal'] }).normal.length;
const told: Explanation = scene.explain(1, 2, { sample: 0, size: 64 });
const text: string = told.text, fate: 'written' | string = told.fragments[0]!.fate;
const bounds = scene.info().bounds;
const low: number | undefined = bounds.empty ? undefined : bounds.min[0];
// @ts-expect-error textures are taken in by load
scene.render({ maxTexture: 64 });
scene.close();

const { ids } = await rasterize({ size: 4, positions: new Float32Array(12), cull: 'back' });
// @ts-expect-error positions are floats
await rasterize({ size: 4, positions: [0, 0, 0, 1] });
const message: string = new RhwError('rhw: a: b').message;

export const used = [image, blob, fetched, color, depth, triangles, text, fate, low, ids, message];
