// SPDX-License-Identifier: MIT
// Draws a scene of three_scenes.js or three_effects.js and tells the hash of its picture. With a number of frames it draws that many, each
// read back, and tells the milliseconds of the median frame and of the first, from the start of the program.
// usage: three.js SCENE [FOLDER] [FRAMES]
import process from "node:process";
import * as THREE from "three/webgpu";
import { fail, finish, readTexture } from "./host.js";
import { drawFrame, HEIGHT, openRenderer, WIDTH } from "./three_host.js";
import * as effects from "./three_effects.js";
import * as basic from "./three_scenes.js";

const scenes = { ...basic, ...effects };
const [name, folder, frames = "0"] = process.argv.slice(2);
if (!scenes[name]) {
    fail(`usage: three.js ${Object.keys(scenes).join("|")} [FOLDER] [FRAMES]`);
}
const { renderer, canvas, device } = await openRenderer(THREE);
device.addEventListener("uncapturederror", (event) => fail(event.error.message));
const draw = await scenes[name](renderer);
let frame = 0;
renderer.setAnimationLoop(() => draw(frame));
drawFrame(0);
const pixels = await readTexture(device, canvas.texture);
const first = process.uptime() * 1000, times = [];
for (frame = 1; frame <= Number(frames); frame++) {
    const before = performance.now();
    drawFrame(frame);
    await readTexture(device, canvas.texture);
    times.push(performance.now() - before);
}
if (times.length > 0) {
    const median = times.sort((a, b) => a - b)[times.length >> 1];
    console.log(`${name} frame ${median.toFixed(2)} ms, first ${first.toFixed(0)} ms`);
    process.exit(0);
}
finish(`three_${name}`, pixels, WIDTH, HEIGHT, folder);
