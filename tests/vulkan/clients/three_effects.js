// SPDX-License-Identifier: MIT
// Scenes of three.js that need more of a driver than those of three_scenes.js: cube and 3D textures, many targets, storage
// textures, textures of matrices, lines and points.
import * as THREE from "three/webgpu";
import { Fn, instanceIndex, mrt, normalView, output, pass, positionLocal, sin, texture3D, textureStore, uvec2, vec2, vec3, vec4 } from "three/tsl";
import { ao } from "three/addons/tsl/display/GTAONode.js";
import { fxaa } from "three/addons/tsl/display/FXAANode.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { addFloor, addLights, addMesh, makeCamera } from "./three_parts.js";

// Shadows of a point light, in a cube of depths, and of a cone of light.
export function lamps(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(3, 2.6, 4.2);
    scene.background = new THREE.Color(0x10131a);
    addFloor(scene);
    const lamp = new THREE.PointLight(0xffffff, 30);
    lamp.position.set(0.5, 2.5, 0.5);
    const spot = new THREE.SpotLight(0xff8844, 40, 0, 0.5, 0.3);
    spot.position.set(-3, 4, 2);
    lamp.castShadow = spot.castShadow = true;
    scene.add(lamp, spot, spot.target);
    const material = new THREE.MeshStandardMaterial({ color: 0x44aa88 });
    for (let i = 0; i < 6; i++) {
        addMesh(scene, new THREE.BoxGeometry(0.4, 0.8, 0.4), material, Math.cos(i) * 1.5, 0.6, Math.sin(i) * 1.5);
    }
    return () => renderer.render(scene, camera);
}

// Metal of five kinds of roughness and glass in a lit room, which is drawn into cubes and filtered first.
export function environment(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(0, 1.6, 4.6);
    scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.04).texture;
    scene.background = scene.environment;
    scene.backgroundBlurriness = 0.4;
    for (let i = 0; i < 5; i++) {
        const material = i === 4 ? new THREE.MeshPhysicalMaterial({ transmission: 1, roughness: 0.1, thickness: 0.5 })
            : new THREE.MeshStandardMaterial({ color: 0xffd9a0, metalness: 1, roughness: i / 4 });
        addMesh(scene, new THREE.SphereGeometry(0.4, 32, 24), material, i - 2, 0.6, 0);
    }
    return () => renderer.render(scene, camera);
}

// Colours and normals in two targets of a pass; where corners are dark is computed from these and from depths.
export function occlusion(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(3, 2.6, 4.2);
    addFloor(scene);
    addLights(scene);
    const material = new THREE.MeshStandardMaterial({ color: 0xaa8866 });
    for (let i = 0; i < 8; i++) {
        addMesh(scene, new THREE.BoxGeometry(0.5, 0.7, 0.5), material, (i % 3) * 0.6 - 0.6, 0.35, Math.floor(i / 3) * 0.6 - 0.6);
    }
    const drawn = pass(scene, camera);
    drawn.setMRT(mrt({ output, normal: normalView }));
    const dark = ao(drawn.getTextureNode("depth"), drawn.getTextureNode("normal"), camera).getTextureNode().r;
    const pipeline = new THREE.RenderPipeline(renderer);
    pipeline.outputNode = fxaa(drawn.getTextureNode("output").mul(vec4(vec3(dark), 1)));
    return () => pipeline.render();
}

// A tube that three bones bend.
function makeTube() {
    const tube = new THREE.CylinderGeometry(0.3, 0.3, 2, 16, 10), place = tube.attributes.position;
    const indices = [], weights = [];
    for (let i = 0; i < place.count; i++) {
        const height = place.getY(i) + 1, bone = Math.min(1, Math.floor(height));
        indices.push(bone, bone + 1, 0, 0);
        weights.push(1 - (height - bone), height - bone, 0, 0);
    }
    tube.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(indices, 4));
    tube.setAttribute("skinWeight", new THREE.Float32BufferAttribute(weights, 4));
    const bones = [-1, 1, 1].map((height) => {
        const bone = new THREE.Bone();
        bone.position.y = height;
        return bone;
    });
    bones[0].add(bones[1]);
    bones[1].add(bones[2]);
    const mesh = new THREE.SkinnedMesh(tube, new THREE.MeshStandardMaterial({ color: 0xcc8844 }));
    mesh.add(bones[0]);
    mesh.bind(new THREE.Skeleton(bones));
    mesh.position.y = 1;
    bones[1].rotation.z = 0.8;
    bones[2].rotation.z = 0.5;
    return mesh;
}

// Meshes that bones and targets change, whose numbers are in textures.
export function animated(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(3, 2.6, 4.2);
    addLights(scene);
    addFloor(scene);
    scene.add(makeTube());
    const box = new THREE.BoxGeometry(0.8, 0.8, 0.8, 4, 4, 4), round = box.attributes.position.clone();
    const corner = new THREE.Vector3();
    for (let i = 0; i < round.count; i++) {
        corner.fromBufferAttribute(round, i).setLength(0.7);
        round.setXYZ(i, corner.x, corner.y, corner.z);
    }
    box.morphAttributes.position = [round];
    const ball = addMesh(scene, box, new THREE.MeshStandardMaterial({ color: 0x4488cc }), 1.5, 0.8, 0.5);
    ball.morphTargetInfluences[0] = 0.7;
    return () => renderer.render(scene, camera);
}

// Lines, points and the edges of triangles.
export function lines(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(3, 2.6, 4.2);
    scene.background = new THREE.Color(0x10131a);
    const knot = new THREE.TorusKnotGeometry(0.7, 0.2, 60, 8);
    const edges = addMesh(scene, knot, new THREE.MeshBasicMaterial({ wireframe: true, color: 0x66dddd }), 1.5, 0, 0);
    edges.castShadow = false;
    const box = new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1));
    scene.add(new THREE.Points(knot, new THREE.PointsMaterial({ color: 0xffff00 })),
        new THREE.LineSegments(box, new THREE.LineBasicMaterial({ color: 0xff5544 })), new THREE.GridHelper(6, 12));
    return () => renderer.render(scene, camera);
}

// A texture that a compute shader fills, and one of three dimensions.
export function volume(renderer) {
    const scene = new THREE.Scene(), camera = makeCamera(2, 1.8, 3);
    scene.background = new THREE.Color(0x22262e);
    const filled = new THREE.StorageTexture(256, 256);
    const fill = Fn(() => {
        const x = instanceIndex.mod(256), y = instanceIndex.div(256), at = vec2(x, y).div(256);
        textureStore(filled, uvec2(x, y), vec4(sin(at.x.mul(20)).mul(0.5).add(0.5), at.y, at.x, 1)).toWriteOnly();
    });
    renderer.compute(fill().compute(256 * 256));
    const cells = new THREE.Data3DTexture(Uint8Array.from({ length: 4096 }, (_, i) => i * 7), 16, 16, 16);
    cells.format = THREE.RedFormat;
    cells.minFilter = cells.magFilter = THREE.LinearFilter;
    cells.needsUpdate = true;
    const solid = new THREE.MeshBasicNodeMaterial();
    solid.colorNode = texture3D(cells, positionLocal.add(0.5)).rrr;
    addMesh(scene, new THREE.BoxGeometry(1.1, 1.1, 1.1), new THREE.MeshBasicNodeMaterial({ map: filled }), -0.7, 0.5, 0);
    addMesh(scene, new THREE.BoxGeometry(1, 1, 1), solid, 0.8, 0.5, 0);
    return () => renderer.render(scene, camera);
}
