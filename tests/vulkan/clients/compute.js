// SPDX-License-Identifier: MIT
// A program that computes: it sorts numbers in shared memory with barriers, counts them by atomics, and multiplies two
// matrices, and holds all results to the same in JavaScript.
// usage: compute.js
import process from "node:process";
import { fail, hashOf, isDeno, openDevice } from "./host.js";

const COUNT = 256, BINS = 16, SIDE = 64;

const code = /* wgsl */ `
@group(0) @binding(0) var<storage, read> numbers: array<u32>;
@group(0) @binding(1) var<storage, read_write> sorted: array<u32>;
@group(0) @binding(2) var<storage, read_write> bins: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read> a: array<f32>;
@group(0) @binding(4) var<storage, read> b: array<f32>;
@group(0) @binding(5) var<storage, read_write> product: array<f32>;

var<workgroup> shared_numbers: array<u32, ${COUNT}>;

@compute @workgroup_size(${COUNT}) fn sort(@builtin(local_invocation_index) index: u32) {
    shared_numbers[index] = numbers[index];
    atomicAdd(&bins[numbers[index] >> 28], 1);
    workgroupBarrier();
    for (var size = 2u; size <= ${COUNT}u; size *= 2u) {
        for (var step = size / 2u; step > 0u; step /= 2u) {
            let other = index ^ step;
            let left = shared_numbers[index];
            let right = shared_numbers[other];
            workgroupBarrier();
            let ascending = (index & size) == 0u;
            if ((left > right) == (ascending == (index < other)) && left != right) {
                shared_numbers[index] = right;
            }
            workgroupBarrier();
        }
    }
    sorted[index] = shared_numbers[index];
}

var<workgroup> tile_a: array<array<f32, 8>, 8>;
var<workgroup> tile_b: array<array<f32, 8>, 8>;

@compute @workgroup_size(8, 8)
fn multiply(@builtin(global_invocation_id) at: vec3u, @builtin(local_invocation_id) local: vec3u) {
    var sum = 0.0;
    for (var k = 0u; k < ${SIDE}u; k += 8u) {
        tile_a[local.y][local.x] = a[at.y * ${SIDE}u + k + local.x];
        tile_b[local.y][local.x] = b[(k + local.y) * ${SIDE}u + at.x];
        workgroupBarrier();
        for (var i = 0u; i < 8u; i++) {
            sum += tile_a[local.y][i] * tile_b[i][local.x];
        }
        workgroupBarrier();
    }
    product[at.y * ${SIDE}u + at.x] = sum;
}`;

// Whole numbers of 32 bits, the same in every run.
let state = 1;
function nextNumber() {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state;
}

const device = await openDevice();

function makeBuffer(data, usage) {
    const buffer = device.createBuffer({ size: data.byteLength, usage: usage | GPUBufferUsage.STORAGE, mappedAtCreation: true });
    new data.constructor(buffer.getMappedRange()).set(data);
    buffer.unmap();
    return buffer;
}

async function read(buffer, Kind) {
    const copy = device.createBuffer({ size: buffer.size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const encoder = device.createCommandEncoder();
    encoder.copyBufferToBuffer(buffer, 0, copy, 0, buffer.size);
    device.queue.submit([encoder.finish()]);
    await copy.mapAsync(GPUMapMode.READ);
    return new Kind(copy.getMappedRange().slice(0));
}

const numbers = Uint32Array.from({ length: COUNT }, nextNumber);
const a = Float32Array.from({ length: SIDE * SIDE }, () => (nextNumber() >>> 24) / 16);
const b = Float32Array.from({ length: SIDE * SIDE }, () => (nextNumber() >>> 24) / 16);
const buffers = [
    makeBuffer(numbers, 0),
    makeBuffer(new Uint32Array(COUNT), GPUBufferUsage.COPY_SRC),
    makeBuffer(new Uint32Array(BINS), GPUBufferUsage.COPY_SRC),
    makeBuffer(a, 0),
    makeBuffer(b, 0),
    makeBuffer(new Float32Array(SIDE * SIDE), GPUBufferUsage.COPY_SRC),
];
const module = device.createShaderModule({ code });
const encoder = device.createCommandEncoder();
const pass = encoder.beginComputePass();
for (const [entryPoint, bindings, groups] of [["sort", [0, 1, 2], [1]], ["multiply", [3, 4, 5], [SIDE / 8, SIDE / 8]]]) {
    const pipeline = device.createComputePipeline({ layout: "auto", compute: { module, entryPoint } });
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({
        layout: pipeline.getBindGroupLayout(0),
        entries: bindings.map((binding) => ({ binding, resource: { buffer: buffers[binding] } })),
    }));
    pass.dispatchWorkgroups(...groups);
}
pass.end();
device.queue.submit([encoder.finish()]);

const sorted = await read(buffers[1], Uint32Array), bins = await read(buffers[2], Uint32Array);
const product = await read(buffers[5], Float32Array);
const expected = numbers.slice().sort();
if (sorted.some((value, i) => value !== expected[i])) {
    fail("the numbers are not sorted");
}
if (bins.some((count, bin) => count !== numbers.filter((value) => value >>> 28 === bin).length)) {
    fail("the numbers are counted wrong");
}
// The values have 8 bits, so that every sum is exact.
for (let i = 0; i < SIDE * SIDE; i++) {
    let sum = 0;
    for (let k = 0; k < SIDE; k++) {
        sum += a[Math.floor(i / SIDE) * SIDE + k] * b[k * SIDE + (i % SIDE)];
    }
    if (sum !== product[i]) {
        fail(`the product has ${product[i]} for ${sum} at ${i}`);
    }
}
const all = new Uint8Array(sorted.byteLength + bins.byteLength + product.byteLength);
all.set(new Uint8Array(sorted.buffer), 0);
all.set(new Uint8Array(bins.buffer), sorted.byteLength);
all.set(new Uint8Array(product.buffer), sorted.byteLength + bins.byteLength);
console.log(`${isDeno ? "deno" : "node"}_compute ${hashOf(all)}`);
process.exit(0);
