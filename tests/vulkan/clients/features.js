// SPDX-License-Identifier: MIT
// WebGPU feature by feature: each function draws or computes a little, with numbers that drivers have alike but for the last
// bit of what is normalized, and gives the bytes. All of them make the hash. With `each` a line a feature tells which one
// differs between two drivers, and with a name the bytes of that one.
// usage: features.js [each [FEATURE]]
import { Buffer } from "node:buffer";
import { createHash } from "node:crypto";
import process from "node:process";
import { hashOf, isDeno, openDevice } from "./host.js";

const device = await openDevice();
const SIZE = 16;

async function readBuffer(buffer) {
    const copy = device.createBuffer({ size: buffer.size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const encoder = device.createCommandEncoder();
    encoder.copyBufferToBuffer(buffer, 0, copy, 0, buffer.size);
    device.queue.submit([encoder.finish()]);
    await copy.mapAsync(GPUMapMode.READ);
    return new Uint8Array(copy.getMappedRange().slice(0));
}

// All texels of a level, of a format with so many bytes a texel (or a block of 4x4).
async function readLevel(texture, bytes, level = 0, block = 1, aspect = "all") {
    const size = (length) => Math.max(1, length >> level);
    const width = size(texture.width), height = size(texture.height);
    const layers = texture.dimension === "3d" ? size(texture.depthOrArrayLayers) : texture.depthOrArrayLayers;
    const rows = Math.ceil(height / block);
    const pitch = Math.ceil((Math.ceil(width / block) * bytes) / 256) * 256;
    const buffer = device.createBuffer({
        size: pitch * rows * layers,
        usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC,
    });
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer(
        { texture, mipLevel: level, aspect },
        { buffer, bytesPerRow: pitch, rowsPerImage: rows },
        [Math.ceil(width / block) * block, rows * block, layers],
    );
    device.queue.submit([encoder.finish()]);
    const all = await readBuffer(buffer), used = Math.ceil(width / block) * bytes;
    const packed = new Uint8Array(used * rows * layers);
    for (let row = 0; row < rows * layers; row++) {
        packed.set(all.subarray(row * pitch, row * pitch + used), row * used);
    }
    return packed;
}

function makeTarget(format = "rgba8unorm", sampleCount = 1, size = [SIZE, SIZE]) {
    return device.createTexture({
        size,
        format,
        sampleCount,
        usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING |
            (sampleCount === 1 ? GPUTextureUsage.COPY_SRC : 0),
    });
}

function makeBuffer(data, usage = 0) {
    const size = Math.ceil(data.byteLength / 4) * 4;
    const buffer = device.createBuffer({
        size,
        usage: usage | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC,
        mappedAtCreation: true,
    });
    new Uint8Array(buffer.getMappedRange()).set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    buffer.unmap();
    return buffer;
}

const SHADER = /* wgsl */ `
struct Corner { @builtin(position) position: vec4f, @location(0) color: vec4f }
@vertex fn vertex(@location(0) place: vec4f, @location(1) color: vec4f) -> Corner { return Corner(place, color); }
// A triangle over all of the target.
@vertex fn whole(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0.5, 1);
}
@fragment fn fragment(@location(0) color: vec4f) -> @location(0) vec4f { return color; }
`;

const PLACE_COLOR = {
    arrayStride: 32,
    attributes: [
        { shaderLocation: 0, offset: 0, format: "float32x4" },
        { shaderLocation: 1, offset: 16, format: "float32x4" },
    ],
};
// Corners that share a row or column of pixels with nothing: x, y, z, w, r, g, b, a each.
const TRIANGLE = new Float32Array([-1, -1, 0.25, 1, 1, 0, 0, 0.5, 1, -1, 0.25, 1, 1, 0, 0, 0.5, -1, 1, 0.25, 1, 1, 0, 0, 0.5]);
const SQUARE = new Float32Array([
    -0.5, -0.5, 0.5, 1, 0, 0, 1, 0.5, 0.5, -0.5, 0.5, 1, 0, 0, 1, 0.5, -0.5, 0.5, 0.5, 1, 0, 0, 1, 0.5,
    0.5, 0.5, 0.5, 1, 0, 0, 1, 0.5,
]);

function makePipeline(code, { fragment = {}, buffers = [PLACE_COLOR], entry = "vertex", topology = "triangle-list", primitive = {}, ...more } = {}) {
    const module = device.createShaderModule({ code });
    return device.createRenderPipeline({
        layout: "auto",
        vertex: { module, entryPoint: entry, buffers: entry === "whole" ? [] : buffers },
        fragment: { module, entryPoint: "fragment", targets: [{ format: "rgba8unorm" }], ...fragment },
        primitive: { topology, ...primitive },
        ...more,
    });
}

// Draws by a function of the pass into a target that is cleared.
function draw(target, record, more = {}, clear = [0.2, 0.4, 0.6, 1]) {
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({
        colorAttachments: [{ view: target.createView(), loadOp: "clear", storeOp: "store", clearValue: clear }],
        ...more,
    });
    record(pass);
    pass.end();
    device.queue.submit([encoder.finish()]);
}

// Runs a compute shader on bindings of group 0, and gives what the first holds then.
async function compute(code, size, entries, groups = [1], constants = {}) {
    const out = device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    const pipeline = device.createComputePipeline({
        layout: "auto",
        compute: { module: device.createShaderModule({ code }), constants },
    });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({
        layout: pipeline.getBindGroupLayout(0),
        entries: [{ buffer: out }, ...entries].map((resource, binding) => ({ binding, resource })),
    }));
    pass.dispatchWorkgroups(...groups);
    pass.end();
    device.queue.submit([encoder.finish()]);
    return readBuffer(out);
}

function join(parts) {
    const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    parts.reduce((at, part) => (all.set(part, at), at + part.length), 0);
    return all;
}

const features = {
    async blend() {
        const parts = [];
        for (const [operation, srcFactor, dstFactor] of [["add", "src-alpha", "one-minus-src-alpha"], ["subtract", "one", "one"],
            ["reverse-subtract", "one", "one"], ["min", "one", "one"], ["max", "one", "one"], ["add", "constant", "zero"], ["add", "dst", "src"]]) {
            const target = makeTarget(), blend = { operation, srcFactor, dstFactor };
            const pipeline = makePipeline(SHADER, { fragment: { targets: [{ format: "rgba8unorm", blend: { color: blend, alpha: blend } }] } });
            draw(target, (pass) => {
                pass.setPipeline(pipeline);
                pass.setBlendConstant([0.2, 0.4, 0.6, 0.8]);
                pass.setVertexBuffer(0, makeBuffer(TRIANGLE, GPUBufferUsage.VERTEX));
                pass.draw(3);
            }, {}, [0.4, 0.4, 0.4, 0.4]);
            parts.push(await readLevel(target, 4));
        }
        return join(parts);
    },
    async mask_scissor_viewport() {
        const target = makeTarget();
        const pipeline = makePipeline(SHADER, { fragment: { targets: [{ format: "rgba8unorm", writeMask: GPUColorWrite.RED | GPUColorWrite.ALPHA }] } });
        draw(target, (pass) => {
            pass.setPipeline(pipeline);
            pass.setViewport(2, 2, 12, 12, 0, 1);
            pass.setScissorRect(3, 4, 7, 8);
            pass.setVertexBuffer(0, makeBuffer(SQUARE, GPUBufferUsage.VERTEX));
            pass.setIndexBuffer(makeBuffer(new Uint16Array([0, 1, 2, 2, 1, 3]), GPUBufferUsage.INDEX), "uint16");
            pass.drawIndexed(6);
        });
        return readLevel(target, 4);
    },
    async strips_lines_points() {
        const parts = [];
        for (const topology of ["triangle-strip", "line-list", "line-strip", "point-list"]) {
            const target = makeTarget();
            const pipeline = makePipeline(SHADER, { topology, primitive: topology.endsWith("strip") ? { stripIndexFormat: "uint32" } : {} });
            draw(target, (pass) => {
                pass.setPipeline(pipeline);
                pass.setVertexBuffer(0, makeBuffer(SQUARE, GPUBufferUsage.VERTEX));
                pass.setIndexBuffer(makeBuffer(new Uint32Array([0, 1, 0xffffffff, 0, 1, 2, 3]), GPUBufferUsage.INDEX), "uint32");
                pass.drawIndexed(topology.endsWith("strip") ? 7 : 2);
            });
            parts.push(await readLevel(target, 4));
        }
        return join(parts);
    },
    async cull() {
        const parts = [];
        for (const cullMode of ["none", "front", "back"]) {
            for (const frontFace of ["ccw", "cw"]) {
                const target = makeTarget();
                const pipeline = makePipeline(SHADER, { primitive: { cullMode, frontFace } });
                draw(target, (pass) => {
                    pass.setPipeline(pipeline);
                    pass.setVertexBuffer(0, makeBuffer(TRIANGLE, GPUBufferUsage.VERTEX));
                    pass.draw(3);
                });
                parts.push(await readLevel(target, 4));
            }
        }
        return join(parts);
    },
    async depth_stencil() {
        const parts = [];
        for (const format of ["depth16unorm", "depth24plus", "depth32float", "depth24plus-stencil8"]) {
            const target = makeTarget(), depth = makeTarget(format), stencil = format.endsWith("stencil8");
            const depthStencil = {
                format,
                depthCompare: "less",
                depthWriteEnabled: true,
                depthBias: 0,
                ...(stencil ? { stencilFront: { passOp: "increment-clamp", depthFailOp: "invert" }, stencilBack: { passOp: "replace" } } : {}),
            };
            const pipeline = makePipeline(SHADER, { depthStencil });
            draw(target, (pass) => {
                pass.setPipeline(pipeline);
                pass.setStencilReference(7);
                pass.setVertexBuffer(0, makeBuffer(TRIANGLE, GPUBufferUsage.VERTEX));
                pass.draw(3);
                pass.setVertexBuffer(0, makeBuffer(SQUARE, GPUBufferUsage.VERTEX));
                pass.draw(3);
            }, {
                depthStencilAttachment: {
                    view: depth.createView(),
                    depthLoadOp: "clear",
                    depthStoreOp: "store",
                    depthClearValue: 0.75,
                    ...(stencil ? { stencilLoadOp: "clear", stencilStoreOp: "store", stencilClearValue: 3 } : {}),
                },
            });
            parts.push(await readLevel(target, 4));
            if (format === "depth32float" || format === "depth16unorm") {
                parts.push(await readLevel(depth, format === "depth16unorm" ? 2 : 4));
            }
            if (stencil) {
                parts.push(await readLevel(depth, 1, 0, 1, "stencil-only"));
            }
        }
        return join(parts);
    },
    async targets() {
        const parts = [];
        const kinds = { f: "vec4f(0.25, 0.5, 1, 0.125)", i: "vec4i(-3, 5, 7, 100)", u: "vec4u(3, 5, 7, 200)" };
        const formats = { r8unorm: 1, rg8unorm: 2, rgba8unorm: 4, "rgba8unorm-srgb": 4, bgra8unorm: 4, "bgra8unorm-srgb": 4, r8uint: 1, r8sint: 1, rg8uint: 2, rg8sint: 2, rgba8uint: 4, rgba8sint: 4,
            r16uint: 2, r16sint: 2, r16float: 2, rg16uint: 4, rg16sint: 4, rg16float: 4, rgba16uint: 8, rgba16sint: 8, rgba16float: 8, r32uint: 4, r32sint: 4, r32float: 4, rg32uint: 8, rg32sint: 8, rg32float: 8,
            rgba32uint: 16, rgba32sint: 16, rgba32float: 16, rgb10a2unorm: 4, rgb10a2uint: 4 };
        for (const [format, bytes] of Object.entries(formats)) {
            const kind = format.includes("uint") ? "u" : format.includes("sint") ? "i" : "f", target = makeTarget(format);
            const pipeline = makePipeline(`${SHADER.split("@fragment")[0]} @fragment fn fragment() -> @location(0) vec4${kind} { return ${kinds[kind]}; }`, { entry: "whole", fragment: { targets: [{ format }] } });
            draw(target, (pass) => {
                pass.setPipeline(pipeline);
                pass.setScissorRect(0, 0, 8, 16);
                pass.draw(3);
            }, {}, [1, 0, 1, 1]);
            parts.push(await readLevel(target, bytes));
        }
        return join(parts);
    },
    async many_targets() {
        const textures = ["rgba8unorm", "r32uint", "rg16float", "rgba8sint"].map((format) => makeTarget(format));
        const pipeline = makePipeline(`${SHADER.split("@fragment")[0]}
            struct Out { @location(0) a: vec4f, @location(1) b: u32, @location(2) c: vec2f, @location(3) d: vec4i }
            @fragment fn fragment(@builtin(position) at: vec4f) -> Out { return Out(vec4f(1, 0, 1, 1), u32(at.x), at.xy, vec4i(vec4f(at.yx, at.z, at.w))); }`,
        { entry: "whole", fragment: { targets: textures.map(({ format }) => ({ format })) } });
        draw(textures[0], (pass) => {
            pass.setPipeline(pipeline);
            pass.draw(3);
        }, { colorAttachments: textures.map((texture) => ({ view: texture.createView(), loadOp: "clear", storeOp: "store" })) });
        return join([await readLevel(textures[0], 4), await readLevel(textures[1], 4), await readLevel(textures[2], 4), await readLevel(textures[3], 4)]);
    },
    async samples() {
        const parts = [];
        for (const format of ["rgba8unorm", "rgba16float"]) {
            for (const alphaToCoverageEnabled of [false, true]) {
                const many = makeTarget(format, 4), one = makeTarget(format);
                const pipeline = makePipeline(SHADER, { fragment: { targets: [{ format }] }, multisample: { count: 4, mask: 7, alphaToCoverageEnabled } });
                draw(many, (pass) => {
                    pass.setPipeline(pipeline);
                    pass.setVertexBuffer(0, makeBuffer(SQUARE, GPUBufferUsage.VERTEX));
                    pass.draw(3);
                }, { colorAttachments: [{ view: many.createView(), resolveTarget: one.createView(), loadOp: "clear", storeOp: "store", clearValue: [0, 0, 0, 0] }] });
                parts.push(await readLevel(one, format === "rgba8unorm" ? 4 : 8));
            }
        }
        return join(parts);
    },
    async sample_index_and_load() {
        const many = makeTarget("rgba8unorm", 4);
        const pipeline = makePipeline(`${SHADER.split("@fragment")[0]} @fragment fn fragment(@builtin(sample_index) i: u32) -> @location(0) vec4f { return vec4f(f32(i) / 3, 0, 1, 1); }`, { entry: "whole", multisample: { count: 4 } });
        draw(many, (pass) => {
            pass.setPipeline(pipeline);
            pass.draw(3);
        });
        return compute(`@group(0) @binding(0) var<storage, read_write> out: array<vec4f>;
            @group(0) @binding(1) var image: texture_multisampled_2d<f32>;
            @compute @workgroup_size(4, 4, 4) fn main(@builtin(global_invocation_id) at: vec3u) {
                out[(at.z * 4 + at.y) * 4 + at.x] = textureLoad(image, at.xy, i32(at.z)) + f32(textureNumSamples(image));
            }`, 16 * 64, [many.createView()]);
    },
    async vertex_formats() {
        const parts = [], bytes = makeBuffer(Uint8Array.from({ length: 256 }, (_, i) => (i * 37 + 11) & 0x3f), GPUBufferUsage.VERTEX);
        const formats = ["uint8x2", "uint8x4", "sint8x2", "sint8x4", "unorm8x2", "unorm8x4", "snorm8x2", "snorm8x4", "uint16x2", "uint16x4", "sint16x2", "sint16x4",
            "unorm16x2", "unorm16x4", "snorm16x2", "snorm16x4", "float16x2", "float16x4", "float32", "float32x2", "float32x3", "float32x4", "uint32", "uint32x2", "uint32x3", "uint32x4", "sint32", "sint32x2", "sint32x3", "sint32x4", "unorm10-10-10-2"];
        for (const format of formats) {
            const kind = format.startsWith("uint") ? "vec4u" : format.startsWith("sint") ? "vec4i" : "vec4f", target = makeTarget("rgba32float", 1, [4, 1]);
            const pipeline = makePipeline(`
                struct Corner { @builtin(position) position: vec4f, @location(0) @interpolate(flat) value: vec4f }
                @vertex fn vertex(@location(0) value: ${kind}, @builtin(vertex_index) i: u32) -> Corner { return Corner(vec4f((f32(i) + 0.5) / 2 - 1, 0, 0, 1), vec4f(value)); }
                @fragment fn fragment(@location(0) @interpolate(flat) value: vec4f) -> @location(0) vec4f { return value; }`,
            { topology: "point-list", fragment: { targets: [{ format: "rgba32float" }] }, buffers: [{ arrayStride: 20, attributes: [{ shaderLocation: 0, offset: 4, format }] }] });
            draw(target, (pass) => {
                pass.setPipeline(pipeline);
                pass.setVertexBuffer(0, bytes);
                pass.draw(4);
            });
            parts.push(await readLevel(target, 16));
        }
        return join(parts);
    },
    async indirect_and_instances() {
        const target = makeTarget();
        const pipeline = makePipeline(`
            struct Corner { @builtin(position) position: vec4f, @location(0) @interpolate(flat) id: u32 }
            @vertex fn vertex(@location(0) shift: vec2f, @builtin(vertex_index) i: u32, @builtin(instance_index) id: u32) -> Corner {
                return Corner(vec4f(shift + vec2f(f32(i & 1), f32(i >> 1)) * 0.5, 0, 1), id);
            }
            @fragment fn fragment(@location(0) @interpolate(flat) id: u32) -> @location(0) vec4f { return vec4f(f32(id) / 255, 1, 0, 1); }`,
        { buffers: [{ arrayStride: 8, stepMode: "instance", attributes: [{ shaderLocation: 0, offset: 0, format: "float32x2" }] }] });
        const places = makeBuffer(new Float32Array([-1, -1, 0, -1, -1, 0, 0, 0, 0.5, 0.5]), GPUBufferUsage.VERTEX);
        draw(target, (pass) => {
            pass.setPipeline(pipeline);
            pass.setVertexBuffer(0, places);
            pass.drawIndirect(makeBuffer(new Uint32Array([3, 2, 0, 0]), GPUBufferUsage.INDIRECT), 0);
            pass.setIndexBuffer(makeBuffer(new Uint16Array([9, 0, 1, 2]), GPUBufferUsage.INDEX), "uint16");
            pass.drawIndexedIndirect(makeBuffer(new Uint32Array([0, 3, 2, 1, 0, 0]), GPUBufferUsage.INDIRECT), 4);
            pass.draw(3, 2, 0, 3);
        });
        return readLevel(target, 4);
    },
    async dynamic_offsets() {
        const target = makeTarget("rgba8unorm");
        const layout = device.createBindGroupLayout({ entries: [{ binding: 0, visibility: GPUShaderStage.FRAGMENT, buffer: { hasDynamicOffset: true } }] });
        const pipeline = makePipeline(`${SHADER.split("@fragment")[0]} @group(1) @binding(0) var<uniform> color: vec4f; @fragment fn fragment() -> @location(0) vec4f { return color; }`,
            { entry: "whole", layout: device.createPipelineLayout({ bindGroupLayouts: [device.createBindGroupLayout({ entries: [] }), layout] }) });
        const data = new Float32Array(256);
        data.set([1, 0, 0, 1], 0), data.set([0, 1, 0, 1], 64), data.set([0, 0, 1, 1], 128);
        const group = device.createBindGroup({ layout, entries: [{ binding: 0, resource: { buffer: makeBuffer(data, GPUBufferUsage.UNIFORM), size: 16 } }] });
        draw(target, (pass) => {
            pass.setPipeline(pipeline);
            pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [] }));
            for (let i = 0; i < 3; i++) {
                pass.setScissorRect(i * 5, 0, 5, 16);
                pass.setBindGroup(1, group, [i * 256]);
                pass.draw(3);
            }
        });
        return readLevel(target, 4);
    },
    async texture_kinds() {
        const parts = [];
        const kinds = [["1d", "texture_1d<f32>", [16, 1, 1], "i32(at.x)", "0"], ["2d", "texture_2d<f32>", [8, 8, 1], "at.xy", "1"], ["2d-array", "texture_2d_array<f32>", [8, 8, 6], "at.xy, at.z", "1"],
            ["3d", "texture_3d<f32>", [8, 8, 8], "at", "1"]];
        for (const [dimension, type, size, at, level] of kinds) {
            const texture = device.createTexture({ size, format: "rgba8unorm", dimension: dimension.slice(0, 2), mipLevelCount: dimension === "1d" ? 1 : 2, usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
            for (let mipLevel = 0; mipLevel < texture.mipLevelCount; mipLevel++) {
                const extent = size.map((length, i) => (i < 2 || dimension === "3d" ? Math.max(1, length >> mipLevel) : length));
                device.queue.writeTexture({ texture, mipLevel }, Uint8Array.from({ length: extent[0] * extent[1] * extent[2] * 4 }, (_, i) => i * 7 + mipLevel), { bytesPerRow: extent[0] * 4, rowsPerImage: extent[1] }, extent);
            }
            parts.push(await compute(`@group(0) @binding(0) var<storage, read_write> out: array<vec4f>;
                @group(0) @binding(1) var image: ${type};
                @compute @workgroup_size(4, 4, 4) fn main(@builtin(global_invocation_id) at: vec3u) {
                    out[(at.z * 4 + at.y) * 4 + at.x] = textureLoad(image, ${at}, ${level}) + vec4f(f32(textureNumLevels(image)));
                }`, 1024, [texture.createView({ dimension })]));
        }
        return join(parts);
    },
    async cubes_gather_compare() {
        const texture = device.createTexture({ size: [4, 4, 6], format: "rgba8unorm", usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
        device.queue.writeTexture({ texture }, Uint8Array.from({ length: 384 }, (_, i) => i), { bytesPerRow: 16, rowsPerImage: 4 }, [4, 4, 6]);
        const unorm = device.createTexture({ size: [4, 4], format: "rgba8unorm", usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
        device.queue.writeTexture({ texture: unorm }, Uint8Array.from({ length: 64 }, (_, i) => i * 3), { bytesPerRow: 16 }, [4, 4]);
        const depth = device.createTexture({ size: [4, 4], format: "depth32float", usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.RENDER_ATTACHMENT });
        const encoder = device.createCommandEncoder();
        encoder.beginRenderPass({ colorAttachments: [], depthStencilAttachment: { view: depth.createView(), depthLoadOp: "clear", depthStoreOp: "store", depthClearValue: 0.5 } }).end();
        device.queue.submit([encoder.finish()]);
        const clamp = device.createSampler({}), repeat = device.createSampler({ addressModeU: "repeat", addressModeV: "mirror-repeat" });
        return compute(`@group(0) @binding(0) var<storage, read_write> out: array<vec4f>;
            @group(0) @binding(1) var cube: texture_cube<f32>;
            @group(0) @binding(2) var clamp_to: sampler;
            @group(0) @binding(3) var image: texture_2d<f32>;
            @group(0) @binding(4) var repeating: sampler;
            @group(0) @binding(5) var depth: texture_depth_2d;
            @group(0) @binding(6) var comparing: sampler_comparison;
            @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) at: vec3u) {
                let i = f32(at.x);
                let way = array(vec3f(1, 0.3, 0.6), vec3f(-1, 0.1, -0.7), vec3f(0.1, 1, 0.9), vec3f(0.3, -1, 0.2), vec3f(-0.6, 0.4, 1), vec3f(0.8, 0.2, -1))[at.x % 6];
                out[at.x * 4] = textureSampleLevel(cube, clamp_to, way, 0);
                out[at.x * 4 + 1] = textureGather(1, image, repeating, vec2f(i / 8 - 3.06, i / 4 - 7.07));
                out[at.x * 4 + 2] = textureSampleLevel(image, repeating, vec2f(i / 8 - 3.0625, 0.4 - i / 4), 0);
                out[at.x * 4 + 3] = vec4f(textureSampleCompareLevel(depth, comparing, vec2f(0.4), i / 64), f32(textureDimensions(cube).x), textureLoad(depth, vec2u(1, 2), 0), 0);
            }`, 64 * 64, [texture.createView({ dimension: "cube" }), clamp, unorm.createView(), repeat, depth.createView(), device.createSampler({ compare: "less-equal" })]);
    },
    async filter() {
        const image = device.createTexture({ size: [8, 8], mipLevelCount: 4, format: "rgba8unorm", usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
        for (let mipLevel = 0; mipLevel < 4; mipLevel++) {
            device.queue.writeTexture({ texture: image, mipLevel }, Uint8Array.from({ length: 4 * (8 >> mipLevel) ** 2 }, (_, i) => (i & 1) * 128 + mipLevel * 16), { bytesPerRow: (8 >> mipLevel) * 4 }, [8 >> mipLevel, 8 >> mipLevel]);
        }
        const sampler = device.createSampler({ magFilter: "linear", minFilter: "linear", mipmapFilter: "linear", addressModeU: "repeat" });
        const floats = new Float32Array((await compute(`@group(0) @binding(0) var<storage, read_write> out: array<vec4f>;
            @group(0) @binding(1) var image: texture_2d<f32>;
            @group(0) @binding(2) var smooth_one: sampler;
            @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) at: vec3u) {
                let i = f32(at.x);
                out[at.x] = textureSampleLevel(image, smooth_one, vec2f(i / 32, i / 64), i / 16);
            }`, 1024, [image.createView(), sampler])).buffer);
        return Uint8Array.from(floats, (value) => Math.round(value * 31)); // weights of 8 bits and of more agree so far
    },
    async storage_textures() {
        const parts = [];
        const formats = { rgba8unorm: "f32", rgba8snorm: "f32", rgba8uint: "u32", rgba8sint: "i32", rgba16uint: "u32", rgba16sint: "i32", rgba16float: "f32", r32uint: "u32", r32sint: "i32", r32float: "f32",
            rg32uint: "u32", rg32sint: "i32", rg32float: "f32", rgba32uint: "u32", rgba32sint: "i32", rgba32float: "f32" };
        const bytes = (format) => (Number(/\d+/.exec(format)[0]) * (format.startsWith("rgba") ? 4 : format.startsWith("rg") ? 2 : 1)) / 8;
        for (const [format, type] of Object.entries(formats)) {
            const texture = device.createTexture({ size: [8, 8], format, usage: GPUTextureUsage.STORAGE_BINDING | GPUTextureUsage.COPY_SRC });
            await compute(`@group(0) @binding(0) var<storage, read_write> out: array<u32>;
                @group(0) @binding(1) var image: texture_storage_2d<${format}, write>;
                @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) at: vec3u) {
                    out[at.x] = textureDimensions(image).x;
                    textureStore(image, at.xy, vec4<${type}>(vec4f(vec2f(at.xy), 1, 2)${type === "f32" ? " / 8" : ""}));
                }`, 64, [texture.createView()]);
            parts.push(await readLevel(texture, bytes(format)));
        }
        return join(parts);
    },
    async storage_read_write() {
        const texture = device.createTexture({ size: [8, 8], format: "r32uint", usage: GPUTextureUsage.STORAGE_BINDING | GPUTextureUsage.COPY_SRC });
        const out = await compute(`@group(0) @binding(0) var<storage, read_write> out: array<u32>;
            @group(0) @binding(1) var image: texture_storage_2d<r32uint, read_write>;
            @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) at: vec3u) {
                textureStore(image, at.xy, vec4u(at.y * 8 + at.x));
                textureBarrier();
                out[at.y * 8 + at.x] = textureLoad(image, at.yx).x;
            }`, 256, [texture.createView()]);
        return join([out, await readLevel(texture, 4)]);
    },
    async fragment_storage() {
        const target = makeTarget(), counts = makeBuffer(new Uint32Array(4), GPUBufferUsage.STORAGE);
        const pipeline = makePipeline(`${SHADER.split("@fragment")[0]} @group(0) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;
            @fragment fn fragment(@builtin(position) at: vec4f, @builtin(front_facing) front: bool) -> @location(0) vec4f {
                if (at.x > 12) { discard; }
                atomicAdd(&counts[u32(at.x) & 3], select(1u, 16u, front));
                return vec4f(1);
            }`, { entry: "whole" });
        draw(target, (pass) => {
            pass.setPipeline(pipeline);
            pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: { buffer: counts } }] }));
            pass.draw(3);
        });
        return join([await readLevel(target, 4), await readBuffer(counts)]);
    },
    async out_of_bounds() {
        const small = makeBuffer(new Uint32Array([1, 2, 3, 4]), GPUBufferUsage.STORAGE);
        const out = await compute(`@group(0) @binding(0) var<storage, read_write> out: array<u32>;
            @group(0) @binding(1) var<storage, read_write> small: array<u32>;
            @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) at: vec3u) {
                if (at.x > 3) { small[at.x * 1000] = 77; }
                out[at.x] = u32(small[at.x * 100000] <= 77) + arrayLength(&small);
            }`, 256, [{ buffer: small }]);
        return out;
    },
    async copies() {
        const parts = [];
        const data = Uint8Array.from({ length: 4096 }, (_, i) => (i * 31) ^ (i >> 3));
        const a = device.createTexture({ size: [16, 16, 4], format: "rgba8unorm", mipLevelCount: 2, usage: 15 & ~GPUTextureUsage.STORAGE_BINDING });
        const b = device.createTexture({ size: [16, 16, 4], format: "rgba8unorm", usage: GPUTextureUsage.COPY_SRC | GPUTextureUsage.COPY_DST });
        device.queue.writeTexture({ texture: a, origin: [0, 0, 1] }, data, { bytesPerRow: 64, rowsPerImage: 16 }, [16, 16, 3]);
        const buffer = makeBuffer(data);
        const encoder = device.createCommandEncoder();
        encoder.copyTextureToTexture({ texture: a, origin: [1, 2, 1] }, { texture: b, origin: [3, 4, 0] }, [9, 10, 2]);
        encoder.copyBufferToTexture({ buffer, offset: 512, bytesPerRow: 256, rowsPerImage: 4 }, { texture: b, origin: [8, 8, 3] }, [8, 4, 1]);
        encoder.copyBufferToTexture({ buffer, offset: 256, bytesPerRow: 256 }, { texture: a, mipLevel: 1 }, [8, 8, 1]);
        encoder.clearBuffer(buffer, 64, 128);
        encoder.copyBufferToBuffer(makeBuffer(data), 1024, buffer, 0, 60);
        device.queue.submit([encoder.finish()]);
        parts.push(await readLevel(b, 4), await readLevel(a, 4, 1), await readBuffer(buffer));
        return join(parts);
    },
    async occlusion() {
        const target = makeTarget(), set = device.createQuerySet({ type: "occlusion", count: 3 });
        const result = device.createBuffer({ size: 24, usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC });
        const encoder = device.createCommandEncoder();
        const pipeline = makePipeline(SHADER);
        const pass = encoder.beginRenderPass({ occlusionQuerySet: set, colorAttachments: [{ view: target.createView(), loadOp: "clear", storeOp: "store" }] });
        pass.setPipeline(pipeline);
        pass.setVertexBuffer(0, makeBuffer(SQUARE, GPUBufferUsage.VERTEX));
        for (let i = 0; i < 2; i++) {
            pass.setScissorRect(0, 0, i * 16, i * 16);
            pass.beginOcclusionQuery(i);
            pass.draw(3);
            pass.endOcclusionQuery();
        }
        pass.end();
        encoder.resolveQuerySet(set, 0, 3, result, 0);
        device.queue.submit([encoder.finish()]);
        return Uint8Array.from(new BigUint64Array((await readBuffer(result)).buffer), (count) => (count > 0n ? 1 : 0));
    },
    async bundles() {
        const target = makeTarget(), pipeline = makePipeline(SHADER);
        const bundle = device.createRenderBundleEncoder({ colorFormats: ["rgba8unorm"] });
        bundle.setPipeline(pipeline);
        bundle.setVertexBuffer(0, makeBuffer(TRIANGLE, GPUBufferUsage.VERTEX));
        bundle.draw(3);
        const recorded = bundle.finish();
        draw(target, (pass) => pass.executeBundles([recorded, recorded]));
        return readLevel(target, 4);
    },
    async constants_and_workgroup() {
        return compute(`override size: u32 = 4; override shift: i32 = 1; override on: bool = false;
            @group(0) @binding(0) var<storage, read_write> out: array<u32>;
            var<workgroup> sum: atomic<u32>; var<workgroup> numbers: array<u32, size>;
            @compute @workgroup_size(size) fn main(@builtin(local_invocation_index) i: u32, @builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u) {
                numbers[i] = (i << u32(shift)) + group.x;
                atomicAdd(&sum, numbers[i]);
                workgroupBarrier();
                out[group.x * size + i] = select(0u, numbers[size - 1 - i] * 1000 + atomicLoad(&sum), on) + groups.x + workgroupUniformLoad(&numbers[0]);
            }`, 32 * 4 * 4, [], [4], { size: 32, shift: 3, on: 1 });
    },
    async dispatch_indirect() {
        const out = makeBuffer(new Uint32Array(16), GPUBufferUsage.STORAGE);
        const pipeline = device.createComputePipeline({ layout: "auto", compute: { module: device.createShaderModule({ code: `
            @group(0) @binding(0) var<storage, read_write> out: array<atomic<u32>>;
            @compute @workgroup_size(1) fn main(@builtin(workgroup_id) at: vec3u) { atomicOr(&out[at.x], 1u << at.y); atomicMax(&out[15], at.z); }` }) } });
        const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: { buffer: out } }] }));
        pass.dispatchWorkgroupsIndirect(makeBuffer(new Uint32Array([9, 5, 4, 3]), GPUBufferUsage.INDIRECT), 4);
        pass.end();
        device.queue.submit([encoder.finish()]);
        return readBuffer(out);
    },
    async integers() {
        return compute(`@group(0) @binding(0) var<storage, read_write> out: array<vec4u>;
            @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) at: vec3u) {
                let n = at.x * 2654435761u + 12345u; let s = bitcast<i32>(n);
                out[at.x] = (vec4u(countOneBits(n) + reverseBits(n), firstLeadingBit(n) ^ firstTrailingBit(n), extractBits(n, 5, 9) + insertBits(n, 3u, 4, 7), pack4x8unorm(vec4f(f32(at.x) / 64)))
                    + vec4u(bitcast<u32>(s / 7), bitcast<u32>(s % 13), n / 11, n % 17)) ^ vec4u(bitcast<u32>(abs(s)), bitcast<u32>(max(s, 5)), dot(vec3u(n), vec3u(1, 2, 3)), pack2x16float(vec2f(f32(at.x), 0.5)));
            }`, 1024, []);
    },
    async half_and_matrices() {
        return compute(`@group(0) @binding(0) var<storage, read_write> out: array<vec4f>;
            @compute @workgroup_size(16) fn main(@builtin(global_invocation_id) at: vec3u) {
                let a = f32(at.x); let m = mat4x4f(a, 1, 2, 3, 4, a, 6, 7, 8, 9, a, 11, 12, 13, 14, a);
                var table = array<mat2x3f, 3>(); table[at.x % 3] = mat2x3f(a, 2, 3, 4, 5, 6);
                out[at.x] = m * transpose(m) * vec4f(1, 2, 3, 4) + vec4f(determinant(mat2x2f(a, 2, 3, 4)), table[(at.x + 1) % 3][1].y, unpack2x16float(at.x * 1000).x, floor(a / 3) + fract(a / 4) + trunc(-a / 2) + sign(a - 4));
            }`, 256, []);
    },
};
const each = process.argv[2] === "each", all = createHash("sha256"), only = process.argv[3];
for (const [name, feature] of Object.entries(features)) {
    if (only && only !== name) {
        continue;
    }
    const bytes = await feature();
    all.update(bytes);
    if (each) {
        console.log(`${name} ${hashOf(bytes).slice(0, 16)}`);
    }
    if (only) {
        console.log(Buffer.from(bytes).toString("hex").replace(/(.{64})/g, "$1\n"));
    }
}
console.log(`${isDeno ? "deno" : "node"}_features ${all.digest("hex")}`);
process.exit(0);
