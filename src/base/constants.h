// SPDX-License-Identifier: MIT
// Constants of the pipeline, each with its unit, its reason and what follows from it.
#ifndef RHW_CONSTANTS_H
#define RHW_CONSTANTS_H

enum {
    // Positions are snapped to 1/256 pixel: 8 bits of subpixel, as Direct3D 11.3 §3.4.1 asks.
    RHW_SUBPIXEL_BITS = 8,
    RHW_SUBPIXEL = 1 << RHW_SUBPIXEL_BITS,

    // Pixels. A vertex further than this from the target's origin is clipped. Snapped positions thus stay
    // within ±2^15·2^8 = 2^23 and differences within 2^24. An edge function is a sum of two products of
    // such differences: below 2·2^24·2^24 = 2^49, exact in int64 and in a double's 53 bits.
    RHW_GUARD_BAND = 32768,

    // Pixels. 64×64 RGBA8 and D32F are 16 KiB each and stay in the first two cache levels.
    RHW_TILE_LOG2 = 6,
    RHW_TILE = 1 << RHW_TILE_LOG2,

    // Pixels. Coverage is decided per 8×8 block, whose mask is one 64-bit word, one byte per row of 8 lanes.
    // Inside a block that an edge crosses |e / 256| stays below 2·2^24·8 = 2^28: int32 is exact there.
    RHW_BLOCK_LOG2 = 3,
    RHW_BLOCK = 1 << RHW_BLOCK_LOG2,

    // Triangles of a chunk: enough that a mesh shades few vertices in two of them (rows of a grid, 1000
    // quads wide: 1.25 times instead of 2 with 2048), few enough that its vertices stay in the second cache level
    // for common vertex sizes. Below 2^16, the numbers that bins hold.
    RHW_CHUNK_TRIANGLES = 8192,

    // Chunks of one wave. Bounds their list, and 16 bytes of scratch each per thread: 134 million triangles, of which
    // those that leave nothing to draw take hardly any bin memory.
    RHW_WAVE_CHUNKS = 16384,

    // Bytes; a cache line, so that two threads never write the same one.
    RHW_CACHE_LINE = 64
};

#endif
