// SPDX-License-Identifier: MIT
// WebGPU as a page has it, in node (Dawn, of the npm package webgpu) or in Deno (wgpu), and what a program of these tests
// ends with: a line with the hash of its picture, and the picture as a PNG file where a folder is given.
import { Buffer } from "node:buffer";
import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import process from "node:process";
import { deflateSync } from "node:zlib";

export const isDeno = "Deno" in globalThis;

// Dawn's instance has to live as long as the program.
let instance;

// The entry to WebGPU, which libraries find in navigator.
export async function openGpu() {
    if (!isDeno) {
        const dawn = await import("webgpu");
        Object.assign(globalThis, dawn.globals);
        instance = dawn.create([]);
        // Dawn's set of features lacks a method of sets that Babylon.js calls.
        globalThis.GPUSupportedFeatures.prototype.forEach ??= function (call) {
            [...this].forEach((feature) => call(feature, feature, this));
        };
        Object.defineProperty(globalThis, "navigator", {
            value: { gpu: instance, userAgent: "node", language: "en" },
            configurable: true,
        });
    }
    return navigator.gpu;
}

// A device, or the end of the program where there is no driver. A message of the device ends the program, too.
export async function openDevice() {
    const gpu = await openGpu();
    const adapter = await gpu.requestAdapter();
    if (!adapter) {
        fail("there is no adapter");
    }
    const device = await adapter.requestDevice();
    device.addEventListener("uncapturederror", (event) => fail(event.error.message));
    return device;
}

export function fail(message) {
    console.error(message);
    process.exit(1);
}

// The pixels of a texture of 8-bit RGBA or BGRA, as RGBA without padding.
export async function readTexture(device, texture) {
    const { width, height } = texture;
    const pitch = Math.ceil((width * 4) / 256) * 256;
    const buffer = device.createBuffer({
        size: pitch * height,
        usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
    });
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow: pitch }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const rows = new Uint8Array(buffer.getMappedRange());
    const pixels = new Uint8Array(width * height * 4);
    for (let y = 0; y < height; y++) {
        pixels.set(rows.subarray(y * pitch, y * pitch + width * 4), y * width * 4);
    }
    buffer.destroy();
    if (texture.format.startsWith("bgra")) {
        for (let i = 0; i < pixels.length; i += 4) {
            [pixels[i], pixels[i + 2]] = [pixels[i + 2], pixels[i]];
        }
    }
    return pixels;
}

export function hashOf(bytes) {
    return createHash("sha256").update(bytes).digest("hex");
}

function crcOf(bytes) {
    let crc = ~0;
    for (const byte of bytes) {
        crc ^= byte;
        for (let bit = 0; bit < 8; bit++) {
            crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
        }
    }
    return ~crc >>> 0;
}

function chunk(type, data) {
    const bytes = new Uint8Array(data.length + 12);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, data.length);
    bytes.set(new TextEncoder().encode(type), 4);
    bytes.set(data, 8);
    view.setUint32(data.length + 8, crcOf(bytes.subarray(4, data.length + 8)));
    return bytes;
}

function encodePng(pixels, width, height) {
    const header = new Uint8Array(13);
    new DataView(header.buffer).setUint32(0, width);
    new DataView(header.buffer).setUint32(4, height);
    header.set([8, 6], 8);
    const rows = new Uint8Array(height * (width * 4 + 1));
    for (let y = 0; y < height; y++) {
        rows.set(pixels.subarray(y * width * 4, (y + 1) * width * 4), y * (width * 4 + 1) + 1);
    }
    const signature = Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a);
    return Buffer.concat([signature, chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND", [])]);
}

// Ends a program that draws. The folder for the picture is the last argument of the command line, where it is given.
export function finish(name, pixels, width, height, folder) {
    if (folder) {
        writeFileSync(join(folder, `${name}.png`), encodePng(pixels, width, height));
    }
    console.log(`${name} ${hashOf(pixels)}`);
    process.exit(0);
}
