// SPDX-License-Identifier: MIT
// Times what three.js does little of, through WebGPU: 10,000 draws of a bundle, which Dawn records anew for every frame; a
// copy of 64 MB, and the same copy by memcpy without a driver; a product of two matrices of 1024 x 1024, by a kernel that
// reads storage alone and by one with tiles in shared memory. Tells the milliseconds of the median and of the first run,
// from submission to a value that was read back.
// usage: throughput.js draws|copy|memcpy|naive|tiled [RUNS]
import process from "node:process";
import { fail, openDevice } from "./host.js";

const [name, runs = "10"] = process.argv.slice(2);
const device = await openDevice();
const result = device.createBuffer({ size: 4, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });

// Submits commands, of which the last copies a word to `result`, and returns that word as an unsigned number.
async function run(encoder) {
    device.queue.submit([encoder.finish()]);
    await result.mapAsync(GPUMapMode.READ);
    const value = new Uint32Array(result.getMappedRange())[0];
    result.unmap();
    return value;
}

function makeBuffer(size, words = []) {
    const buffer = device.createBuffer({
        size,
        usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST,
        mappedAtCreation: true,
    });
    new Float32Array(buffer.getMappedRange()).set(words);
    buffer.unmap();
    return buffer;
}

// Draws -------------------------------------------------------------------------------------------------

// 100 x 100 squares of 4 x 4 pixels, each with a color of its own in a bind group of its own.
function makeDraws() {
    const side = 100, pixels = 4 * side;
    const module = device.createShaderModule({
        code: `
            struct Square { place: vec2f, color: vec4f }
            @group(0) @binding(0) var<uniform> square: Square;
            @vertex fn place(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
                return vec4f((square.place + vec2f(f32(i & 1), f32(i >> 1))) * ${2 / side} - 1, 0, 1);
            }
            @fragment fn shade() -> @location(0) vec4f { return square.color; }`,
    });
    const target = device.createTexture({
        size: [pixels, pixels],
        format: "rgba8unorm",
        usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
    });
    const pipeline = device.createRenderPipeline({
        layout: "auto",
        vertex: { module },
        fragment: { module, targets: [{ format: "rgba8unorm" }] },
        primitive: { topology: "triangle-strip" },
    });
    const stride = 256;
    const squares = device.createBuffer({
        size: side * side * stride,
        usage: GPUBufferUsage.UNIFORM,
        mappedAtCreation: true,
    });
    const words = new Float32Array(squares.getMappedRange());
    const bundle = device.createRenderBundleEncoder({ colorFormats: ["rgba8unorm"] });
    bundle.setPipeline(pipeline);
    for (let i = 0; i < side * side; i++) {
        const x = i % side, y = Math.floor(i / side);
        words.set([x, y, 0, 0, x / 255, y / 255, 1, 1], (i * stride) / 4);
        const group = device.createBindGroup({
            layout: pipeline.getBindGroupLayout(0),
            entries: [{ binding: 0, resource: { buffer: squares, offset: i * stride, size: 32 } }],
        });
        bundle.setBindGroup(0, group);
        bundle.draw(4);
    }
    squares.unmap();
    const bundles = [bundle.finish()];
    return async () => {
        const encoder = device.createCommandEncoder();
        const pass = encoder.beginRenderPass({
            colorAttachments: [{ view: target.createView(), loadOp: "clear", storeOp: "store" }],
        });
        pass.executeBundles(bundles);
        pass.end();
        encoder.copyTextureToBuffer({ texture: target, origin: [pixels - 1, 0] }, { buffer: result }, [1, 1]);
        return (await run(encoder)) === 0xffff6363;
    };
}

// Copies ------------------------------------------------------------------------------------------------

const COPIED = 1 << 26;

function makeCopy() {
    const size = COPIED, from = makeBuffer(size, new Float32Array(size / 4).fill(1)), to = makeBuffer(size);
    return async () => {
        const encoder = device.createCommandEncoder();
        encoder.copyBufferToBuffer(from, 0, to, 0, size);
        encoder.copyBufferToBuffer(to, size - 4, result, 0, 4);
        return (await run(encoder)) === 0x3f800000;
    };
}

function makeMemcpy() {
    const from = new Uint8Array(COPIED).fill(1), to = new Uint8Array(COPIED);
    return async () => {
        to.set(from);
        return to[COPIED - 1] === 1;
    };
}

// Products ----------------------------------------------------------------------------------------------

const SIDE = 1024, TILE = 16;
const declarations = `
    @group(0) @binding(0) var<storage, read> a: array<f32>;
    @group(0) @binding(1) var<storage, read> b: array<f32>;
    @group(0) @binding(2) var<storage, read_write> c: array<f32>;`;
const kernels = {
    naive: `${declarations}
        @compute @workgroup_size(${TILE}, ${TILE}) fn multiply(@builtin(global_invocation_id) at: vec3u) {
            var sum = 0.0;
            for (var k = 0u; k < ${SIDE}u; k++) {
                sum += a[at.y * ${SIDE}u + k] * b[k * ${SIDE}u + at.x];
            }
            c[at.y * ${SIDE}u + at.x] = sum;
        }`,
    tiled: `${declarations}
        var<workgroup> left: array<array<f32, ${TILE}>, ${TILE}>;
        var<workgroup> right: array<array<f32, ${TILE}>, ${TILE}>;
        @compute @workgroup_size(${TILE}, ${TILE}) fn multiply(@builtin(global_invocation_id) at: vec3u,
                                                              @builtin(local_invocation_id) own: vec3u) {
            var sum = 0.0;
            for (var first = 0u; first < ${SIDE}u; first += ${TILE}u) {
                left[own.y][own.x] = a[at.y * ${SIDE}u + first + own.x];
                right[own.y][own.x] = b[(first + own.y) * ${SIDE}u + at.x];
                workgroupBarrier();
                for (var k = 0u; k < ${TILE}u; k++) {
                    sum += left[own.y][k] * right[k][own.x];
                }
                workgroupBarrier();
            }
            c[at.y * ${SIDE}u + at.x] = sum;
        }`,
};

// Small whole numbers, so that sums are exact in any order.
function makeProduct(code) {
    const a = Float32Array.from({ length: SIDE * SIDE }, (_, i) => i % 7);
    const b = Float32Array.from({ length: SIDE * SIDE }, (_, i) => i % 5);
    const buffers = [makeBuffer(4 * a.length, a), makeBuffer(4 * b.length, b), makeBuffer(4 * a.length)];
    const pipeline = device.createComputePipeline({
        layout: "auto",
        compute: { module: device.createShaderModule({ code }) },
    });
    const group = device.createBindGroup({
        layout: pipeline.getBindGroupLayout(0),
        entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })),
    });
    let sum = 0;
    for (let k = 0; k < SIDE; k++) {
        sum += a[(SIDE - 1) * SIDE + k] * b[k * SIDE + SIDE - 1];
    }
    const expected = new Uint32Array(Float32Array.of(sum).buffer)[0];
    return async () => {
        const encoder = device.createCommandEncoder();
        const pass = encoder.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.dispatchWorkgroups(SIDE / TILE, SIDE / TILE);
        pass.end();
        encoder.copyBufferToBuffer(buffers[2], 4 * (SIDE * SIDE - 1), result, 0, 4);
        return (await run(encoder)) === expected;
    };
}

const makers = { draws: makeDraws, copy: makeCopy, memcpy: makeMemcpy };
for (const kernel of Object.keys(kernels)) {
    makers[kernel] = () => makeProduct(kernels[kernel]);
}
if (!makers[name]) {
    fail(`usage: throughput.js ${Object.keys(makers).join("|")} [RUNS]`);
}
const once = makers[name](), times = [];
for (let i = 0; i < Number(runs); i++) {
    const before = performance.now();
    if (!(await once())) {
        fail(`${name}: wrong result`);
    }
    times.push(performance.now() - before);
}
const first = times[0];
const median = times.sort((x, y) => x - y)[times.length >> 1];
console.log(`${name} frame ${median.toFixed(2)} ms, first ${first.toFixed(0)} ms`);
process.exit(0);
