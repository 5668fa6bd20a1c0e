// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/geometry.c: a chunk through the front end, from indices to bins. Compiled with
// RHW_ISA_SUFFIX = baseline, avx2, ...
#include "draw_scene.h"

#include "kernel_folders.h"

enum {
    TRIANGLES = 64,
    TILES_MOST = 9, // of a scene's target
    RECORD = 8 + SCENE_COMPONENTS + 4
};

// The first chunk of a scene. A triangle names its vertices by slot; here they stand beside it.
struct chunk_result {
    uint64_t counters[6], count;
    int32_t tiles[4];
    uint32_t offsets[TILES_MOST + 1], hidden[2];
    uint16_t entries[TRIANGLES * TILES_MOST];
    struct rhw_triangle triangles[TRIANGLES];
    struct rhw_polygon polygons[TRIANGLES];
    float vertices[TRIANGLES][3][RECORD];
};

static void make_chunk_input(struct kernel_random *random, void *input)
{
    struct scene_input *const in = input;
    make_scene(random, in);
    in->split = (uint32_t)random_int(random, 1, TRIANGLES);
}

static void copy_bins(struct chunk_result *out, const struct rhw_chunk *chunk)
{
    const int32_t tiles[4] = {chunk->tile_x0, chunk->tile_y0, chunk->tile_x1, chunk->tile_y1};
    const size_t count = (size_t)(tiles[2] - tiles[0]) * (size_t)(tiles[3] - tiles[1]);
    memcpy(out->tiles, tiles, sizeof tiles);
    memcpy(out->offsets, chunk->offsets, (count + 1) * sizeof *out->offsets);
    memcpy(out->entries, chunk->entries, chunk->offsets[count] * sizeof *out->entries);
}

// Records end with whole vectors of varyings; a NaN that the front end made is any.
static void copy_triangle(struct chunk_result *out, const struct rhw_chunk *chunk, int i)
{
    const struct rhw_triangle *const t = &chunk->triangles[i];
    const struct rhw_segment *const segment = &chunk->segments[t->segment];
    out->triangles[i] = *t;
    for (int v = 0; v < 3; v++) {
        float *const to = out->vertices[i][v];
        memcpy(to, segment->vertices + (size_t)t->vertex[v] * (size_t)segment->vertex_stride,
               (size_t)segment->vertex_stride * sizeof *to);
        unify_nans(&to[2], 1);
    }
    if (t->flags & RHW_TRIANGLE_POLYGON) {
        struct rhw_polygon *const to = &out->polygons[i];
        *to = chunk->polygons[t->polygon];
        memset(&to->x_24_8[to->count], 0, (size_t)(RHW_POLYGON_VERTICES - to->count) * sizeof *to->x_24_8);
        memset(&to->y_24_8[to->count], 0, (size_t)(RHW_POLYGON_VERTICES - to->count) * sizeof *to->y_24_8);
    }
}

static void run_chunk(const void *input, void *result)
{
    const struct scene_input *const in = input;
    struct chunk_result *const out = result;
    memset(out, 0, sizeof *out);
    const struct scene *const scene = front_of_scene(in, RHW_PATHS_ALL);
    if (scene->wave.chunk_count == 0) {
        return;
    }
    const struct rhw_chunk *const chunk = &scene->chunks[0];
    const struct rhw_front_counters *const counters = &chunk->counters;
    const uint64_t counts[6] = {counters->vertices_shaded, counters->dropped,    counters->clipped,
                                counters->culled,          counters->rasterized, counters->entries};
    memcpy(out->counters, counts, sizeof counts);
    out->count = chunk->count;
    out->hidden[0] = chunk->hidden.kind;
    out->hidden[1] = chunk->hidden.compare;
    copy_bins(out, chunk);
    for (int i = 0; i < (int)counters->rasterized; i++) {
        copy_triangle(out, chunk, i);
    }
}

static const struct kernel_check checks[] = {
    {"chunk", sizeof(struct scene_input), sizeof(struct chunk_result), KERNEL_BITS, make_chunk_input,
     run_chunk},
};

const struct kernel_folder RHW_ISA_NAME(check_chunk) = {"geometry", checks, sizeof checks / sizeof *checks};
