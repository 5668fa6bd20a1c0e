// SPDX-License-Identifier: MIT
// 3DS whose meshes have lost the matrix of their own places. A mesh has its vertices where they are in the world, and
// its keys move it from that matrix, which programs that do not know it write as that of the origin. A pivot, which is
// counted from there, says so: with keys the parts would stand apart, so assimp gets the file without keys. It also
// gets faces in groups where the file leaves them out, which smoothing_groups.c finds.
#include "assimp.h"
#include "smoothing_groups.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { HEAD = 6, FILE_CHUNK = 0x4d4d, EDITOR = 0x3d3d, OBJECT = 0x4000, MESH = 0x4100, MATRIX = 0x4160 };
enum { KEYS = 0xb000, NODE = 0xb002, PIVOT = 0xb013 };
enum { DEEPEST = 5 }; // chunks in each other that are looked into

struct look {
    unsigned meshes, at_origin; // meshes, and their matrices that are those of the origin
    unsigned pivots;            // pivots that are not at the origin
    unsigned char *keys;        // the chunk of all keys, or NULL
};

static size_t read_little(const unsigned char *bytes, size_t count)
{
    size_t number = 0;
    for (size_t i = count; i > 0; i--) {
        number = number << 8 | bytes[i - 1];
    }
    return number;
}

static bool are_numbers(const unsigned char *bytes, size_t size, const float *numbers, size_t count)
{
    return size >= count * sizeof(float) && memcmp(bytes, numbers, count * sizeof(float)) == 0;
}

static void look_at_chunks(struct look *look, unsigned char *bytes, size_t size, unsigned depth);

static void look_at_chunk(struct look *look, size_t kind, unsigned char *chunk, size_t size, unsigned depth)
{
    static const float origin[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    unsigned char *const content = chunk + HEAD;
    const size_t length = size - HEAD;
    const unsigned char *const zero = kind == OBJECT ? memchr(content, 0, length) : NULL;
    const size_t name = zero == NULL ? 0 : (size_t)(zero - content) + 1;
    if (kind == FILE_CHUNK || kind == EDITOR || kind == OBJECT || kind == MESH || kind == KEYS ||
        kind == NODE) {
        look_at_chunks(look, content + name, length - name, depth + 1);
    }
    look->meshes += kind == MESH;
    look->at_origin += kind == MATRIX && are_numbers(content, length, origin, 12);
    look->pivots +=
        kind == PIVOT && length >= 3 * sizeof(float) && !are_numbers(content, length, origin + 9, 3);
    look->keys = kind == KEYS ? chunk : look->keys;
}

static void look_at_chunks(struct look *look, unsigned char *bytes, size_t size, unsigned depth)
{
    while (size >= HEAD && depth < DEEPEST) {
        const size_t length = read_little(bytes + 2, 4);
        if (length < HEAD || length > size) {
            return;
        }
        look_at_chunk(look, read_little(bytes, 2), bytes, length, depth);
        bytes += length;
        size -= length;
    }
}

char *scene_assimp_3ds(struct scene_import *import, size_t *size)
{
    const char *problem = NULL;
    char *const bytes = strcasecmp(import->ending, "3ds") == 0
                            ? scene_import_read_bytes(import->model.path, size, &problem)
                            : NULL;
    if (bytes == NULL) {
        return NULL;
    }
    struct look look = {.keys = NULL};
    look_at_chunks(&look, (unsigned char *)bytes, *size, 0);
    const bool is_lost =
        look.keys != NULL && look.meshes >= 2 && look.at_origin >= look.meshes && look.pivots > 0;
    if (is_lost) {
        look.keys[0] = look.keys[1] = 0xff; // a chunk of no meaning
        scene_import_warn(import, "has meshes that say nothing of their places: drawn without keys");
    }
    struct scene_edits edits = {0};
    scene_assimp_group_faces(import, &edits, bytes, *size);
    char *const grouped = edits.count > 0 ? scene_edits_apply(import, &edits, bytes, size) : NULL;
    if (grouped != NULL || !is_lost) {
        free(bytes);
        return grouped;
    }
    return bytes;
}
