// SPDX-License-Identifier: MIT
// Draws a scene of Babylon.js: a lit ground and solids with a shadow, 4 samples.
// usage: babylon.js [FOLDER]
import process from "node:process";
import { fail, finish, openGpu, readTexture } from "./host.js";
import { HEIGHT, makeCanvas, WIDTH } from "./three_host.js";

await openGpu();
const canvas = makeCanvas();
const BABYLON = await import("@babylonjs/core");
const engine = new BABYLON.WebGPUEngine(canvas, { antialias: true });
await engine.initAsync();
engine._device.addEventListener("uncapturederror", (event) => fail(event.error.message));

const scene = new BABYLON.Scene(engine);
scene.clearColor = new BABYLON.Color4(0.13, 0.15, 0.18, 1);
const camera = new BABYLON.ArcRotateCamera("camera", 0.9, 1.1, 7, new BABYLON.Vector3(0, 0.6, 0), scene);
camera.minZ = 0.1;
new BABYLON.HemisphericLight("sky", new BABYLON.Vector3(0, 1, 0), scene).intensity = 0.5;
const sun = new BABYLON.DirectionalLight("sun", new BABYLON.Vector3(-1, -2, -1), scene);
sun.position = new BABYLON.Vector3(4, 8, 4);
const shadows = new BABYLON.ShadowGenerator(1024, sun);
shadows.usePercentageCloserFiltering = true;

function addMesh(mesh, x, y, z, r, g, b) {
    mesh.position.set(x, y, z);
    mesh.material = new BABYLON.StandardMaterial(mesh.name, scene);
    mesh.material.diffuseColor = new BABYLON.Color3(r, g, b);
    mesh.receiveShadows = true;
    shadows.addShadowCaster(mesh);
}

addMesh(BABYLON.MeshBuilder.CreateGround("ground", { width: 6, height: 6 }, scene), 0, 0, 0, 0.7, 0.66, 0.6);
addMesh(BABYLON.MeshBuilder.CreateTorusKnot("knot", { radius: 0.6, tube: 0.2, radialSegments: 96 }, scene), 0, 1.1, 0, 0.25, 0.5, 0.85);
addMesh(BABYLON.MeshBuilder.CreateBox("box", { size: 0.8 }, scene), -1.6, 0.4, 0.6, 0.8, 0.5, 0.2);
addMesh(BABYLON.MeshBuilder.CreateSphere("ball", { diameter: 1 }, scene), 1.5, 0.5, 0.4, 0.8, 0.25, 0.2);
await scene.whenReadyAsync();
engine.beginFrame();
scene.render();
engine.endFrame();
finish("babylon", await readTexture(engine._device, canvas.texture), WIDTH, HEIGHT, process.argv[2]);
