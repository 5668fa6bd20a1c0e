// SPDX-License-Identifier: MIT
// The chunks of a 3DS, each of which has a kind, its length with these six bytes, and what it holds.
#ifndef SCENE_IMPORT_CHUNKS_3DS_H
#define SCENE_IMPORT_CHUNKS_3DS_H

#include <stdbool.h>
#include <stddef.h>

/// Kinds of chunks. Those up to SCENE_3DS_FACES hold others, those of faces, lights and cameras behind their own
/// numbers.
enum {
    SCENE_3DS_FILE = 0x4d4d,
    SCENE_3DS_EDITOR = 0x3d3d,
    SCENE_3DS_OBJECT = 0x4000,
    SCENE_3DS_MESH = 0x4100,
    SCENE_3DS_KEYS = 0xb000,
    SCENE_3DS_NODE = 0xb002,
    SCENE_3DS_MATERIAL = 0xafff,
    SCENE_3DS_TEXTURE = 0xa200,
    SCENE_3DS_SPECULAR_MAP = 0xa204,
    SCENE_3DS_OPACITY_MAP = 0xa210,
    SCENE_3DS_REFLECTION_MAP = 0xa220,
    SCENE_3DS_BUMP_MAP = 0xa230,
    SCENE_3DS_SHININESS_MAP = 0xa33c,
    SCENE_3DS_EMISSION_MAP = 0xa33d,
    SCENE_3DS_LIGHT = 0x4600,
    SCENE_3DS_CAMERA = 0x4700,
    SCENE_3DS_FACES = 0x4120,
    SCENE_3DS_POINTS = 0x4110,
    SCENE_3DS_SMOOTHING = 0x4150,
    SCENE_3DS_MATRIX = 0x4160,
    SCENE_3DS_PIVOT = 0xb013
};

enum { SCENE_3DS_HEAD = 6 };

/// Chunks of a file, from `at` to `end`.
struct scene_3ds_chunks {
    const unsigned char *bytes; ///< all bytes of the file
    size_t at, end;
};

struct scene_3ds_chunk {
    size_t at, kind;
    struct scene_3ds_chunks content; ///< what it holds; an object has a name before that
};

/// Return a number of some bytes, the lowest first.
size_t scene_3ds_number(const unsigned char *bytes, size_t count);
/// Take the next chunk. Return false at the end, or where a chunk is cut.
bool scene_3ds_next(struct scene_3ds_chunks *chunks, struct scene_3ds_chunk *chunk);
/// Make chunks of no meaning of zeros that stand behind the last chunk of a file, or of one that holds others. Return
/// false where there are none. assimp 5.2.5 refuses a file for those that are as many as a chunk begins with.
bool scene_3ds_fill(unsigned char *bytes, size_t size);

#endif
