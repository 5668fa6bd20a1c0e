// SPDX-License-Identifier: MIT
// Colours of vertices and faces. Most of them come from bytes, for which a table is exact and fast.
#include "stored_colors.h"

#include <stdlib.h>
#include <string.h>

#include "numbers.h"
#include "vertices.h"

static float scale_of(float largest)
{
    return !(largest >= 2) ? 1 : largest < 256 ? 255 : 65535;
}

struct scene_color_scale scene_import_color_scale(const float (*colors)[4], size_t count)
{
    const float beyond = 65536; // infinity lies beyond, too
    float largest[2] = {0, 0};
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 4; c++) {
            const float value = colors[i][c];
            if (value > largest[c == 3] && value < beyond) {
                largest[c == 3] = value;
            }
        }
    }
    return (struct scene_color_scale){scale_of(largest[0]), scale_of(largest[1])};
}

static float limited(float value)
{
    return value > 1 ? 1 : value > 0 ? value : 0; // NaN gives 0
}

bool scene_import_decode_colors(float (*colors)[4], size_t count, struct scene_color_scale scale)
{
    float table[256];
    bool visible = false, translucent = false;
    for (int i = 0; i < 256; i++) {
        table[i] = scene_import_from_srgb((float)i / 255);
    }
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            const float value = limited(colors[i][c] / scale.color), byte = value * 255;
            const bool exact = byte == __builtin_rintf(byte);
            colors[i][c] = exact ? table[(int)byte] : scene_import_from_srgb(value);
        }
        colors[i][3] = limited(colors[i][3] / scale.alpha);
        visible = visible || colors[i][3] > 0;
        translucent = translucent || colors[i][3] < 1;
    }
    for (size_t i = 0; i < count && !visible; i++) {
        colors[i][3] = 1;
    }
    return visible && translucent;
}

void scene_import_color_primitives(struct scene_import *import, struct scene_mesh *mesh,
                                   const float (*colors)[4], const uint32_t *rows)
{
    const uint32_t corners = scene_mesh_corners(mesh);
    scene_import_gather_vertices(import, mesh, mesh->indices, mesh->index_count);
    free(mesh->colors);
    mesh->colors = scene_import_allocate(import, mesh->index_count, sizeof *mesh->colors);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const uint32_t primitive = i / corners;
        memcpy(mesh->colors[i], colors[rows != NULL ? rows[primitive] : primitive], sizeof mesh->colors[i]);
        mesh->indices[i] = i;
    }
}
