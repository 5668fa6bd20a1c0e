// SPDX-License-Identifier: MIT
// What scenes of three.js have in common: a camera, lights with a shadow, a chequered floor.
import * as THREE from "three/webgpu";

export function makeCamera(x, y, z) {
    const camera = new THREE.PerspectiveCamera(45, 640 / 480, 0.1, 100);
    camera.position.set(x, y, z);
    camera.lookAt(0, 0.5, 0);
    return camera;
}

// Fields of two colours with levels, as a texture that needs no file.
export function makeBoard() {
    const side = 128, data = new Uint8Array(side * side * 4);
    for (let y = 0; y < side; y++) {
        for (let x = 0; x < side; x++) {
            data.set((x >> 4) + (y >> 4) & 1 ? [235, 225, 205, 255] : [120, 60, 40, 255], (y * side + x) * 4);
        }
    }
    const texture = new THREE.DataTexture(data, side, side);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.magFilter = THREE.LinearFilter;
    texture.minFilter = THREE.LinearMipmapLinearFilter;
    texture.generateMipmaps = true;
    texture.anisotropy = 4;
    texture.repeat.set(3, 3);
    texture.needsUpdate = true;
    return texture;
}

export function addLights(scene) {
    scene.background = new THREE.Color(0x22262e);
    scene.add(new THREE.HemisphereLight(0xbfd4ff, 0x554433, 0.9));
    const sun = new THREE.DirectionalLight(0xfff2dd, 2.6);
    sun.position.set(3, 5, 2);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.camera.left = sun.shadow.camera.bottom = -4;
    sun.shadow.camera.right = sun.shadow.camera.top = 4;
    sun.shadow.bias = -0.002;
    scene.add(sun);
}

export function addFloor(scene) {
    const floor = new THREE.Mesh(new THREE.PlaneGeometry(8, 8), new THREE.MeshStandardMaterial({ map: makeBoard(), roughness: 0.9 }));
    floor.rotation.x = -Math.PI / 2;
    floor.receiveShadow = true;
    scene.add(floor);
}

export function addMesh(scene, geometry, material, x, y, z) {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(x, y, z);
    mesh.castShadow = mesh.receiveShadow = true;
    scene.add(mesh);
    return mesh;
}
