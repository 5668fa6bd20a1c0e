// SPDX-License-Identifier: MIT
// Draws a scene of PlayCanvas: a lit plane and solids with a shadow, 4 samples.
// usage: playcanvas.js [FOLDER]
import process from "node:process";
import { fail, finish, openGpu, readTexture } from "./host.js";
import { HEIGHT, makeCanvas, WIDTH } from "./three_host.js";

await openGpu();
const canvas = makeCanvas();
const pc = await import("playcanvas");
// What the engine takes of a page, from when it has found out that there is none.
globalThis.window = globalThis;
globalThis.addEventListener ??= () => {};
globalThis.removeEventListener ??= () => {};
globalThis.requestAnimationFrame = () => 1;
globalThis.cancelAnimationFrame = () => {};
globalThis.document = {
    addEventListener() {},
    removeEventListener() {},
    createElement: makeCanvas,
    visibilityState: "visible",
};
for (const name of ["HTMLCanvasElement", "HTMLImageElement", "HTMLVideoElement", "ImageBitmap"]) {
    globalThis[name] ??= class {};
}

const device = new pc.WebgpuGraphicsDevice(canvas, { antialias: true });
await device.createDevice("", "");
device.wgpu.addEventListener("uncapturederror", (event) => fail(event.error.message));
const options = new pc.AppOptions();
options.graphicsDevice = device;
options.componentSystems = [pc.RenderComponentSystem, pc.CameraComponentSystem, pc.LightComponentSystem];
const app = new pc.AppBase(canvas);
app.init(options);

function addEntity(component, settings) {
    const entity = new pc.Entity(component);
    entity.addComponent(component, settings);
    app.root.addChild(entity);
    return entity;
}

function addSolid(type, position, scale, r, g, b) {
    const material = new pc.StandardMaterial();
    material.diffuse = new pc.Color(r, g, b);
    material.gloss = 0.6;
    material.update();
    const entity = addEntity("render", { type, material, castShadows: true, receiveShadows: true });
    entity.setLocalPosition(...position);
    entity.setLocalScale(...scale);
}

app.scene.ambientLight = new pc.Color(0.3, 0.3, 0.35);
addSolid("plane", [0, 0, 0], [6, 1, 6], 0.7, 0.66, 0.6);
addSolid("box", [-1.4, 0.5, 0.4], [1, 1, 1], 0.8, 0.5, 0.2);
addSolid("sphere", [1.3, 0.6, 0.4], [1.2, 1.2, 1.2], 0.8, 0.25, 0.2);
addSolid("cone", [0, 0.8, -0.8], [1, 1.6, 1], 0.25, 0.5, 0.85);
const camera = addEntity("camera", { clearColor: new pc.Color(0.13, 0.15, 0.18), farClip: 50 });
camera.setLocalPosition(3.2, 3, 4.2);
camera.lookAt(0, 0.5, 0);
addEntity("light", {
    type: "directional",
    castShadows: true,
    shadowBias: 0.2,
    normalOffsetBias: 0.05,
    shadowDistance: 20,
    shadowResolution: 1024,
}).setLocalEulerAngles(50, 110, 0);
app.start();
app.tick(0);
app.tick(16);
finish("playcanvas", await readTexture(device.wgpu, canvas.texture), WIDTH, HEIGHT, process.argv[2]);
