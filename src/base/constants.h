// SPDX-License-Identifier: MIT
// Constants of the pipeline, each with its unit, its reason and what follows from it.
#ifndef RHW_CONSTANTS_H
#define RHW_CONSTANTS_H

enum {
    // Positions are snapped to 1/256 pixel: Direct3D 11.3 §3.4.1 asks for 8 bits of subpixel.
    RHW_SUBPIXEL_BITS = 8,
    RHW_SUBPIXEL = 1 << RHW_SUBPIXEL_BITS,

    // Pixels. A vertex further than this from the target's origin is clipped, so snapped positions stay within
    // ±2^15·2^8 = 2^23 and differences within 2^24. An edge function is a sum of two products of two differences each:
    // it stays below 2·2^24·2^24 = 2^49, which is exact in int64 and in a double's 53 bits.
    RHW_GUARD_BAND = 32768,

    // Pixels. 64×64 texels of RGBA8 or of D32F are 16 KiB and stay in the first two cache levels.
    RHW_TILE_LOG2 = 6,
    RHW_TILE = 1 << RHW_TILE_LOG2,

    // Pixels. Coverage is decided per 8×8 block, whose mask is one 64-bit word with one byte per row of 8 lanes. Inside
    // a block that an edge crosses |e / 256| stays below 2·2^24·8 = 2^28, which is exact in int32.
    RHW_BLOCK_LOG2 = 3,
    RHW_BLOCK = 1 << RHW_BLOCK_LOG2,

    // Triangles of a chunk. They are enough that a mesh shades few vertices in two chunks: a grid with rows of 1000
    // quads shades each vertex 1.25 times; with 2048 triangles it would be 2 times. They are few enough that the
    // chunk's vertices stay in the second cache level for common vertex sizes. The number is below 2^16, since bins
    // hold it in 16 bits.
    RHW_CHUNK_TRIANGLES = 8192,

    // Chunks of one wave. This bounds their list, and the 16 bytes that each thread has for each of them. A wave has
    // 134 million triangles at most; triangles that leave nothing to draw take hardly any bin memory.
    RHW_WAVE_CHUNKS = 16384,

    // Bytes. Data that two threads write stand this far apart, so that the threads never write one cache line.
    RHW_CACHE_LINE = 64
};

#endif
