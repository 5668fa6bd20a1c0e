// SPDX-License-Identifier: MIT
// Scenes of three.js' WebGPURenderer, as its own examples make them: each a function that gives what is drawn every frame.
import { readFileSync } from "node:fs";
import * as THREE from "three/webgpu";
import { Fn, cos, float, hash, instanceIndex, instancedArray, pass, sin, vec3 } from "three/tsl";
import { bloom } from "three/addons/tsl/display/BloomNode.js";
import { gaussianBlur } from "three/addons/tsl/display/GaussianBlurNode.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { addFloor, addLights, addMesh, makeBoard, makeCamera } from "./three_parts.js";

const MODEL = "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";

// Lit and textured meshes with shadows.
export function lit(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(3, 2.6, 4.2);
    addLights(scene);
    addFloor(scene);
    const knot = addMesh(scene, new THREE.TorusKnotGeometry(0.6, 0.2, 128, 24), new THREE.MeshStandardMaterial({ color: 0x3f7fd0, roughness: 0.25, metalness: 0.3 }), 0, 1.1, 0);
    addMesh(scene, new THREE.BoxGeometry(0.8, 0.8, 0.8), new THREE.MeshStandardMaterial({ map: makeBoard() }), -1.5, 0.4, 0.6);
    addMesh(scene, new THREE.SphereGeometry(0.5, 48, 32), new THREE.MeshPhysicalMaterial({ color: 0xd04a3a, clearcoat: 1, roughness: 0.4 }), 1.4, 0.5, 0.5);
    addMesh(scene, new THREE.ConeGeometry(0.4, 1, 32), new THREE.MeshPhongMaterial({ color: 0x44aa66, transparent: true, opacity: 0.6 }), 0.6, 0.5, 1.6);
    return (frame) => {
        knot.rotation.y = frame * 0.05;
        renderer.render(scene, camera);
    };
}

// A model of 121,496 triangles from a glTF file.
export async function gltf(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(2.4, 1.9, 2.8);
    addLights(scene);
    addFloor(scene);
    const file = readFileSync(MODEL);
    const model = (await new GLTFLoader().parseAsync(file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength), "")).scene;
    const box = new THREE.Box3().setFromObject(model), size = box.getSize(new THREE.Vector3());
    model.scale.multiplyScalar(2 / Math.max(size.x, size.y, size.z));
    box.setFromObject(model);
    model.position.sub(box.getCenter(new THREE.Vector3()));
    model.position.y += (box.max.y - box.min.y) / 2;
    model.traverse((node) => {
        node.castShadow = node.receiveShadow = true;
    });
    scene.add(model);
    return (frame) => {
        model.rotation.y = frame * 0.05;
        renderer.render(scene, camera);
    };
}

// One mesh a thousand times, with a colour each.
export function instances(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(4, 5, 7);
    addLights(scene);
    const count = 1000, side = 10;
    const mesh = new THREE.InstancedMesh(new THREE.IcosahedronGeometry(0.22, 2), new THREE.MeshStandardMaterial({ roughness: 0.5 }), count);
    const matrix = new THREE.Matrix4(), color = new THREE.Color();
    for (let i = 0; i < count; i++) {
        const x = i % side, y = Math.floor(i / side) % side, z = Math.floor(i / side / side);
        mesh.setMatrixAt(i, matrix.makeTranslation((x - 4.5) * 0.6, (y - 4.5) * 0.6, (z - 4.5) * 0.6));
        mesh.setColorAt(i, color.setRGB(x / 9, y / 9, z / 9));
    }
    mesh.castShadow = mesh.receiveShadow = true;
    scene.add(mesh);
    return (frame) => {
        mesh.rotation.y = frame * 0.05;
        renderer.render(scene, camera);
    };
}

// The lit scene through post-processing: a glow, and a blur that grows to the right.
export function blur(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(3, 2.6, 4.2);
    addLights(scene);
    addFloor(scene);
    addMesh(scene, new THREE.TorusKnotGeometry(0.6, 0.2, 128, 24), new THREE.MeshStandardMaterial({ color: 0x3f7fd0, emissive: 0x0a2a60 }), 0, 1.1, 0);
    addMesh(scene, new THREE.SphereGeometry(0.3, 32, 16), new THREE.MeshBasicMaterial({ color: 0xffe0a0 }), 1.3, 1.2, 0.4);
    const drawn = pass(scene, camera).getTextureNode("output");
    const pipeline = new THREE.RenderPipeline(renderer);
    pipeline.outputNode = gaussianBlur(drawn, null, 3).add(bloom(drawn, 0.6, 0.4, 0.7));
    return () => pipeline.render();
}

// Points that a compute shader moves, drawn as instances from its storage buffers.
export function compute(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(0, 2.5, 5.5), count = 4096;
    scene.background = new THREE.Color(0x10131a);
    const places = instancedArray(count, "vec3"), speeds = instancedArray(count, "vec3");
    const start = Fn(() => {
        const angle = hash(instanceIndex).mul(6.2831853), height = hash(instanceIndex.add(7919));
        places.element(instanceIndex).assign(vec3(cos(angle), height, sin(angle)));
        speeds.element(instanceIndex).assign(vec3(sin(angle).negate(), 0.6, cos(angle)).mul(0.02));
    })().compute(count);
    const step = Fn(() => {
        const place = places.element(instanceIndex), speed = speeds.element(instanceIndex);
        speed.addAssign(place.mul(vec3(-0.0004, -0.0006, -0.0004)));
        place.addAssign(speed);
    })().compute(count);
    const material = new THREE.SpriteNodeMaterial({ depthWrite: false, blending: THREE.AdditiveBlending });
    material.positionNode = places.toAttribute();
    material.colorNode = places.toAttribute().mul(0.3).add(vec3(0.3, 0.4, 0.5));
    material.scaleNode = float(0.03);
    const sprites = new THREE.Sprite(material);
    sprites.count = count;
    sprites.frustumCulled = false;
    scene.add(sprites);
    renderer.compute(start);
    return () => {
        renderer.compute(step);
        renderer.render(scene, camera);
    };
}
