// SPDX-License-Identifier: MIT
// What three.js takes for a page: a canvas whose texture can be read, and no document.
import { openGpu } from "./host.js";

export const WIDTH = 640, HEIGHT = 480;

// A canvas of three.js or Babylon.js, which draws into one texture. Its field `texture` is what was drawn.
export function makeCanvas() {
    const canvas = {
        width: WIDTH,
        height: HEIGHT,
        clientWidth: WIDTH,
        clientHeight: HEIGHT,
        style: {},
        texture: null,
        addEventListener() {},
        removeEventListener() {},
        setAttribute() {},
        getBoundingClientRect: () => ({ x: 0, y: 0, left: 0, top: 0, width: WIDTH, height: HEIGHT }),
        getContext: () => context,
    };
    const context = {
        canvas,
        configure({ device, format, usage = GPUTextureUsage.RENDER_ATTACHMENT }) {
            canvas.texture = device.createTexture({
                size: [WIDTH, HEIGHT],
                format,
                usage: usage | GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
            });
        },
        unconfigure() {},
        getCurrentTexture: () => canvas.texture,
    };
    return canvas;
}

// What is to be called for the next frame.
let nextFrame = null;

// Has the renderer draw the next frame, as a page does when its display wants one.
export function drawFrame(frame) {
    const callback = nextFrame;
    nextFrame = null;
    callback((frame * 1000) / 60);
}

// A renderer of 4 samples with shadows, and its canvas.
export async function openRenderer(THREE) {
    await openGpu();
    globalThis.self ??= globalThis;
    globalThis.requestAnimationFrame = (callback) => {
        nextFrame = callback;
        return 1;
    };
    globalThis.cancelAnimationFrame = () => {};
    const canvas = makeCanvas();
    const renderer = new THREE.WebGPURenderer({ canvas, antialias: true });
    await renderer.init();
    renderer.setSize(WIDTH, HEIGHT, false);
    renderer.shadowMap.enabled = true;
    renderer.toneMapping = THREE.ACESFilmicToneMapping;
    return { renderer, canvas, device: renderer.backend.device };
}
