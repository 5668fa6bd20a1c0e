// SPDX-License-Identifier: MIT
// The first program of everybody: a triangle with a colour at each corner.
// usage: triangle.js [FOLDER]
import process from "node:process";
import { finish, isDeno, openDevice, readTexture } from "./host.js";

const code = /* wgsl */ `
struct Corner {
    @builtin(position) position: vec4f,
    @location(0) color: vec3f,
}

@vertex fn corner(@builtin(vertex_index) index: u32) -> Corner {
    const places = array(vec2f(0, 0.8), vec2f(-0.8, -0.7), vec2f(0.8, -0.7));
    const colors = array(vec3f(1, 0.25, 0.2), vec3f(0.2, 0.8, 0.3), vec3f(0.2, 0.4, 1));
    return Corner(vec4f(places[index], 0, 1), colors[index]);
}

@fragment fn shade(@location(0) color: vec3f) -> @location(0) vec4f {
    return vec4f(color, 1);
}`;

const size = 256;
const device = await openDevice();
const texture = device.createTexture({
    size: [size, size],
    format: "rgba8unorm",
    usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
});
const module = device.createShaderModule({ code });
const pipeline = device.createRenderPipeline({
    layout: "auto",
    vertex: { module },
    fragment: { module, targets: [{ format: texture.format }] },
});
const encoder = device.createCommandEncoder();
const pass = encoder.beginRenderPass({
    colorAttachments: [
        { view: texture.createView(), loadOp: "clear", storeOp: "store", clearValue: [0.1, 0.1, 0.12, 1] },
    ],
});
pass.setPipeline(pipeline);
pass.draw(3);
pass.end();
device.queue.submit([encoder.finish()]);
finish(isDeno ? "deno_triangle" : "node_triangle", await readTexture(device, texture), size, size, process.argv[2]);
