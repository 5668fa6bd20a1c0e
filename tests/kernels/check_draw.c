// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/tile.c: whole draws, of every shading and depth rule, into a tile. The picture of all
// special paths (small triangles, spans, whole tiles, collected and packed fragments, two phases, hierarchical depth) is
// that of the general path. Compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "draw_scene.h"

#include "kernel_folders.h"

enum { TEXELS = RHW_TILE * RHW_TILE };

// What a tile holds when it is drawn. Open pixels, bounds and counts are those of the special paths, in both halves.
struct draw_half {
    unsigned char first[TEXELS * 8], second[TEXELS * 4];
    float depth[TEXELS], bounds[HIZ_BLOCKS * HIZ_BLOCKS];
    uint64_t open[RHW_TILE], fragments, groups;
    int64_t open_count, direction;
};

struct draw_result {
    struct draw_half special, general;
};

static void fill(unsigned char *texels, size_t size, const unsigned char pattern[RHW_CLEAR_BYTES])
{
    for (size_t i = 0; i < size; i += RHW_CLEAR_BYTES) {
        memcpy(texels + i, pattern, RHW_CLEAR_BYTES);
    }
}

// A tile without triangles is left as it is. What only some draws set starts as 0.
static void clear_tile(struct rhw_tile_scratch *tile, const struct scene_input *in,
                       const struct rhw_target *target)
{
    for (int t = 0; t < in->target_count; t++) {
        fill(tile->color[t], TEXELS * target->colors[t].texel_size, in->clear[t]);
    }
    fill((unsigned char *)tile->depth.texels, sizeof tile->depth.texels, target->depth.clear);
    memset(tile->depth.bounds, 0, sizeof tile->depth.bounds);
    memset(tile->depth.open, 0, sizeof tile->depth.open);
    tile->depth.open_count = tile->depth.direction = 0;
}

static void draw_scene(const struct scene_input *in, enum rhw_paths paths, struct draw_half *out)
{
    struct scene *const scene = front_of_scene(in, paths);
    struct rhw_tile_scratch *const tile = &scene->tile;
    clear_tile(tile, in, &scene->wave.target);
    scene->worker.counters = (struct rhw_counters){0};
    RHW_ISA_NAME(rhw_kernels).tile(&scene->wave, in->tile, 0);
    if (in->target_count > 0) {
        memcpy(out->first, tile->color[0], TEXELS * scene->wave.target.colors[0].texel_size);
    }
    if (in->target_count > 1) {
        memcpy(out->second, tile->color[1], TEXELS * scene->wave.target.colors[1].texel_size);
    }
    memcpy(out->depth, tile->depth.texels, sizeof out->depth);
    memcpy(out->bounds, tile->depth.bounds, sizeof out->bounds);
    memcpy(out->open, tile->depth.open, sizeof out->open);
    out->open_count = tile->depth.open_count;
    out->direction = tile->depth.direction;
    out->fragments = scene->worker.counters.fragments;
    out->groups = scene->worker.counters.groups;
}

static void run_draw(const void *input, void *result)
{
    struct draw_result *const out = result;
    memset(out, 0, sizeof *out);
    draw_scene(input, RHW_PATHS_ALL, &out->special);
    draw_scene(input, RHW_PATHS_GENERAL, &out->general);
    const size_t picture = offsetof(struct draw_half, bounds);
    memcpy((unsigned char *)&out->general + picture, (unsigned char *)&out->special + picture,
           sizeof out->general - picture);
}

static const struct kernel_check checks[] = {
    {"draw", sizeof(struct scene_input), sizeof(struct draw_result), KERNEL_HALVES, make_scene, run_draw},
};

const struct kernel_folder RHW_ISA_NAME(check_draw) = {"tile", checks, sizeof checks / sizeof *checks};
