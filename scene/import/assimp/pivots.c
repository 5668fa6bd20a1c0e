// SPDX-License-Identifier: MIT
// 3DS whose meshes have lost the matrix of their own places. A mesh has its vertices where they are in the world, and
// its keys move it from that matrix, which programs that do not know it write as that of the origin. A pivot, which is
// counted from there, says so: with keys the parts would stand apart, so assimp gets the file without keys. It also
// gets faces in groups where the file leaves them out, which smoothing_groups.c finds, and chunks in place of zeros.
#include "assimp.h"
#include "chunks_3ds.h"
#include "smoothing_groups.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { DEEPEST = 5 }; // chunks in each other that are looked into

struct look {
    unsigned meshes, at_origin; // meshes, and their matrices that are those of the origin
    unsigned pivots;            // pivots that are not at the origin
    size_t keys;                // place of the chunk of all keys, or 0
};

static bool are_numbers(const unsigned char *bytes, size_t size, const float *numbers, size_t count)
{
    return size >= count * sizeof(float) && memcmp(bytes, numbers, count * sizeof(float)) == 0;
}

static void look_at_chunks(struct look *look, struct scene_3ds_chunks chunks, unsigned depth)
{
    static const float origin[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    struct scene_3ds_chunk chunk;
    while (depth < DEEPEST && scene_3ds_next(&chunks, &chunk)) {
        const size_t kind = chunk.kind, length = chunk.content.end - chunk.content.at;
        const unsigned char *const content = chunks.bytes + chunk.content.at;
        if (kind == SCENE_3DS_FILE || kind == SCENE_3DS_EDITOR || kind == SCENE_3DS_OBJECT ||
            kind == SCENE_3DS_MESH || kind == SCENE_3DS_KEYS || kind == SCENE_3DS_NODE) {
            look_at_chunks(look, chunk.content, depth + 1);
        }
        look->meshes += kind == SCENE_3DS_MESH;
        look->at_origin += kind == SCENE_3DS_MATRIX && are_numbers(content, length, origin, 12);
        look->pivots += kind == SCENE_3DS_PIVOT && length >= 3 * sizeof(float) &&
                        !are_numbers(content, length, origin + 9, 3);
        look->keys = kind == SCENE_3DS_KEYS ? chunk.at : look->keys;
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
    const bool is_filled = scene_3ds_fill((unsigned char *)bytes, *size);
    struct look look = {.meshes = 0};
    look_at_chunks(&look, (struct scene_3ds_chunks){(const unsigned char *)bytes, 0, *size}, 0);
    const bool is_lost =
        look.keys > 0 && look.meshes >= 2 && look.at_origin >= look.meshes && look.pivots > 0;
    if (is_lost) {
        memset(bytes + look.keys, 0xff, 2); // a chunk of no meaning
        scene_import_warn(import, "has meshes that say nothing of their places: drawn without keys");
    }
    struct scene_edits edits = {0};
    scene_assimp_group_faces(import, &edits, bytes, *size);
    char *const grouped = edits.count > 0 ? scene_edits_apply(import, &edits, bytes, size) : NULL;
    if (grouped != NULL || (!is_lost && !is_filled)) {
        free(bytes);
        return grouped;
    }
    return bytes;
}
