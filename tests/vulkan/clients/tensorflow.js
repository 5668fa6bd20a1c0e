// SPDX-License-Identifier: MIT
// TensorFlow.js: its WebGPU backend against its CPU backend, kernel by kernel. The hash is that of all results.
// usage: tensorflow.js
import { createHash } from "node:crypto";
import process from "node:process";
import * as tf from "@tensorflow/tfjs-core";
import "@tensorflow/tfjs-backend-cpu";
import { WebGPUBackend } from "@tensorflow/tfjs-backend-webgpu";
import { fail, openDevice } from "./host.js";

// Numbers from -1 to 1, the same in every run.
let state = 1;
function values(shape) {
    const data = new Float32Array(shape.reduce((product, size) => product * size, 1));
    for (let i = 0; i < data.length; i++) {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        data[i] = (state >>> 8) / 8388608 - 1;
    }
    return { shape, data };
}

const image = values([1, 17, 19, 8]), matrix = values([33, 47]), other = values([47, 29]), row = values([47]);
const filter = values([3, 3, 8, 12]), deep = values([3, 3, 8, 2]), more = values([33, 47]);

// Each kernel gets its tensors from a function, so that both backends have their own.
const kernels = {
    add: (t) => tf.add(t(matrix), t(row)),
    multiply: (t) => tf.mul(t(matrix), t(more)),
    divide: (t) => tf.div(t(matrix), tf.add(tf.abs(t(more)), 0.5)),
    exp: (t) => tf.exp(t(matrix)),
    tanh: (t) => tf.tanh(t(matrix)),
    sigmoid: (t) => tf.sigmoid(t(matrix)),
    relu6: (t) => tf.relu6(tf.mul(t(matrix), 8)),
    rsqrt: (t) => tf.rsqrt(tf.add(tf.square(t(matrix)), 0.1)),
    matMul: (t) => tf.matMul(t(matrix), t(other)),
    conv2d: (t) => tf.conv2d(t(image), t(filter), 1, "same"),
    depthwiseConv2d: (t) => tf.depthwiseConv2d(t(image), t(deep), 2, "valid"),
    maxPool: (t) => tf.maxPool(t(image), 3, 2, "same"),
    avgPool: (t) => tf.avgPool(t(image), 3, 2, "valid"),
    softmax: (t) => tf.softmax(t(matrix)),
    sum: (t) => tf.sum(t(matrix), 1),
    max: (t) => tf.max(t(matrix), 0),
    argMax: (t) => tf.argMax(t(matrix), 1),
    cumsum: (t) => tf.cumsum(t(matrix), 1),
    transpose: (t) => tf.transpose(t(image), [3, 1, 0, 2]),
    concat: (t) => tf.concat([t(matrix), t(more)], 1),
    slice: (t) => tf.slice(t(matrix), [3, 5], [20, 31]),
    pad: (t) => tf.pad(t(matrix), [[2, 3], [1, 4]], 7),
    gather: (t) => tf.gather(t(matrix), tf.tensor1d([5, 0, 32, 7], "int32")),
    resizeBilinear: (t) => tf.image.resizeBilinear(t(image), [31, 23]),
    batchNorm: (t) => tf.batchNorm(t(matrix), t(row), tf.abs(t(row)), undefined, undefined, 0.01),
    topk: (t) => tf.topk(t(matrix), 5).values,
};

async function run(kernel) {
    const tensor = kernel(({ shape, data }) => tf.tensor(data, shape));
    return { shape: tensor.shape, data: await tensor.data() };
}

const device = await openDevice();
tf.registerBackend("webgpu", () => new WebGPUBackend(device, device.adapterInfo ?? {}), 3);
const hash = createHash("sha256");
let worst = 0, failed = 0;
for (const [name, kernel] of Object.entries(kernels)) {
    await tf.setBackend("cpu");
    const expected = await run(kernel);
    await tf.setBackend("webgpu");
    const found = await run(kernel);
    const error = expected.data.reduce((most, value, i) => {
        const difference = Math.abs(value - found.data[i]) / Math.max(1, Math.abs(value));
        return difference <= most ? most : difference; // a NaN is kept
    }, 0);
    if (String(found.shape) !== String(expected.shape) || !(error <= 1e-4)) {
        console.error(`${name}: off by ${error}`);
        failed++;
    }
    worst = Math.max(worst, error);
    hash.update(new Uint8Array(found.data.buffer, found.data.byteOffset, found.data.byteLength));
}
if (failed > 0) {
    fail(`${failed} of ${Object.keys(kernels).length} kernels are wrong`);
}
console.log(`tensorflow ${hash.digest("hex")}`);
console.error(`tensorflow: ${Object.keys(kernels).length} kernels, off by at most ${worst.toExponential(1)}`);
process.exit(0);
