// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/tile: the setup of 8 triangles, and the spans of small ones against what coverage says of
// them; compiled with RHW_ISA_SUFFIX = baseline, avx2, ... Whole draws stand in check_draw.c.
#include "kernels/tile/triangle_setup8.h"
#include "kernels/raster/coverage.h"
#include "kernels/tile/span_blocks.h"

#include "kernel_folders.h"

enum { TILES = RHW_GUARD_BAND / 2 / RHW_TILE }; // each way, of the largest target

// 8 triangles of a bin: each reaches into the tile.
struct setup_input {
    struct rhw_triangle triangles[BATCH];
    float positions[BATCH][3][4];
    double depth_low, depth_span;
    int32_t tile_x, tile_y; // pixels
};

static int64_t area_of(const struct rhw_triangle *t)
{
    const int64_t x1 = t->x_24_8[1] - t->x_24_8[0], y1 = t->y_24_8[1] - t->y_24_8[0];
    const int64_t x2 = t->x_24_8[2] - t->x_24_8[0], y2 = t->y_24_8[2] - t->y_24_8[0];
    return x1 * y2 - x2 * y1;
}

static int32_t least(const int32_t v[3])
{
    return min_int(min_int(v[0], v[1]), v[2]);
}

static int32_t most(const int32_t v[3])
{
    return max_int(max_int(v[0], v[1]), v[2]);
}

// Bounds and flags as the front end sets them. False where the triangle leaves nothing to draw in the tile.
static bool finish_triangle(struct kernel_random *random, const struct setup_input *in,
                            struct rhw_triangle *t)
{
    const int32_t size = RHW_TILE * RHW_SUBPIXEL, *const xs = t->x_24_8, *const ys = t->y_24_8;
    const bool scissored = random_one_in(random, 4);
    const int left = scissored ? (int)random_int(random, in->tile_x, in->tile_x + RHW_TILE - 1) : 0;
    const int bottom = in->tile_y + (scissored ? (int)random_int(random, 1, RHW_TILE) : RHW_TILE);
    const int x0 = max_int(pixel_of_step(least(xs), 127), left),
              y0 = max_int(pixel_of_step(least(ys), 127), 0);
    const int x1 = min_int(pixel_of_step(most(xs), 128), RHW_GUARD_BAND / 2),
              y1 = min_int(pixel_of_step(most(ys), 128), bottom);
    t->x0 = (int16_t)x0;
    t->y0 = (int16_t)y0;
    t->x1 = (int16_t)x1;
    t->y1 = (int16_t)y1;
    const bool is_small = most(xs) - least(xs) < size && most(ys) - least(ys) < size;
    t->flags = (uint16_t)((area_of(t) < 0 ? RHW_TRIANGLE_NEGATIVE : 0) | (is_small ? RHW_TRIANGLE_SMALL : 0));
    return max_int(x0, in->tile_x) < min_int(x1, in->tile_x + RHW_TILE) &&
           max_int(y0, in->tile_y) < min_int(y1, in->tile_y + RHW_TILE);
}

// Of any size; a small one where that is asked for.
static void make_triangle(struct kernel_random *random, const struct setup_input *in, bool is_small,
                          struct rhw_triangle *t)
{
    do {
        const int x = in->tile_x + (int)random_int(random, 0, RHW_TILE);
        const int y = in->tile_y + (int)random_int(random, 0, RHW_TILE);
        random_triangle(random, x * RHW_SUBPIXEL, y * RHW_SUBPIXEL, t->x_24_8, t->y_24_8);
    } while (!finish_triangle(random, in, t) || (is_small && !(t->flags & RHW_TRIANGLE_SMALL)));
}

static void make_tile(struct kernel_random *random, struct setup_input *in)
{
    in->tile_x = (int)random_int(random, 0, TILES - 1) * RHW_TILE;
    in->tile_y = (int)random_int(random, 0, TILES - 1) * RHW_TILE;
}

static void make_setup(struct kernel_random *random, void *input)
{
    struct setup_input *const in = input;
    make_tile(random, in);
    in->depth_low = (double)random_float_in(random, 0.0f, 1.0f);
    in->depth_span = (double)random_float_in(random, -1.0f, 1.0f);
    const bool affine = random_one_in(random, 4);
    for (int i = 0; i < BATCH; i++) {
        make_triangle(random, in, random_one_in(random, 2), &in->triangles[i]);
        for (int v = 0; v < 3; v++) {
            float *const position = in->positions[i][v];
            do {
                random_clip_position(random, position);
            } while (!(position[3] > 0.0f && position[3] < 0x1p127f));
            position[3] = affine ? 1.0f : position[3];
            position[2] = random_one_in(random, 8) ? random_finite(random)
                                                   : position[3] * random_float_in(random, 0.0f, 1.0f);
        }
    }
}

// Most of them small.
static void make_small(struct kernel_random *random, void *input)
{
    struct setup_input *const in = input;
    make_tile(random, in);
    for (int i = 0; i < BATCH; i++) {
        do {
            make_triangle(random, in, true, &in->triangles[i]);
        } while (area_of(&in->triangles[i]) == 0); // such a one is never drawn
        for (int v = 0; v < 3; v++) {
            in->positions[i][v][3] = 1.0f;
        }
    }
}

// What a tile reads: vertex records, a chunk of one segment, and a batch of the bin.
struct setup_scene {
    float records[BATCH][3][8];
    struct rhw_draw_state state;
    struct rhw_draw draw;
    struct rhw_segment segment;
    struct rhw_chunk chunk;
    struct bin_batch read;
    struct tile_work work;
    struct triangle_setup8 setup;
};

static void set_scene(struct setup_scene *scene, const struct setup_input *in)
{
    memset(scene, 0, sizeof *scene);
    scene->state.depth_low = in->depth_low;
    scene->state.depth_span = in->depth_span;
    scene->draw.state = &scene->state;
    scene->segment.draw = &scene->draw;
    scene->chunk.segments = &scene->segment;
    scene->work.x = in->tile_x;
    scene->work.y = in->tile_y;
    scene->read.count = BATCH;
    for (int i = 0; i < BATCH; i++) {
        scene->read.triangle[i] = &in->triangles[i];
        for (int v = 0; v < 3; v++) {
            struct rhw_vertex_record *const record = (struct rhw_vertex_record *)(void *)scene->records[i][v];
            memcpy(record->position, in->positions[i][v], sizeof record->position);
            scene->read.vertex[i][v] = record;
        }
    }
    setup_triangles8(&scene->setup, &scene->work, &scene->chunk, &scene->read);
}

// Setup of 8 triangles -------------------------------------------------------------------------------

struct setup_result {
    double planes[BATCH][12], inverse_area[BATCH];
    int32_t rect[BATCH][4], anchor[BATCH][2], exact[BATCH];
    int32_t x[BATCH], q[BATCH][3], a[BATCH][3], b[BATCH][3];
};

// Edges are those of small triangles alone. One without area, which has no planes, may stand beside others: it is
// clipped.
static void run_setup(const void *input, void *result)
{
    const struct setup_input *const in = input;
    struct setup_result *const out = result;
    struct setup_scene scene;
    set_scene(&scene, in);
    memset(out, 0, sizeof *out);
    const struct triangle_setup8 *const setup = &scene.setup;
    for (int i = 0; i < BATCH; i++) {
        const int32_t rect[4] = {setup->x0[i], setup->y0[i], setup->x1[i], setup->y1[i]};
        memcpy(out->rect[i], rect, sizeof rect);
        out->anchor[i][0] = setup->anchor_x[i];
        out->anchor[i][1] = setup->anchor_y[i];
        if (area_of(&in->triangles[i]) != 0) {
            memcpy(out->planes[i], &setup->quantities[i], sizeof out->planes[i]);
            out->inverse_area[i] = setup->inverse_area[i];
            out->exact[i] = setup->exact >> i & 1;
        }
        for (int e = 0; e < 3 && in->triangles[i].flags & RHW_TRIANGLE_SMALL; e++) {
            out->x[i] = setup->x[i];
            out->q[i][e] = setup->q[e][i];
            out->a[i][e] = setup->a[e][i];
            out->b[i][e] = setup->b[e][i];
        }
    }
}

// Spans ----------------------------------------------------------------------------------------------

// The pixels of the tile that each triangle covers, by row.
struct span_result {
    uint64_t by_spans[BATCH][RHW_TILE], by_coverage[BATCH][RHW_TILE];
};

struct span_collector {
    struct triangle_work triangle; // first: what is drawn leads to the rows
    uint64_t *rows;
};

static void collect_span(struct tile_work *work, struct triangle_work *triangle, int x, int y, uint64_t mask)
{
    uint64_t *const rows = ((struct span_collector *)(void *)triangle)->rows;
    (void)work;
    for (int row = 0; row < RHW_BLOCK; row++) {
        rows[y + row] |= (mask >> (8 * row) & 0xff) << x;
    }
}

// The same by whole blocks, as large triangles are drawn.
static void collect_coverage(const struct setup_scene *scene, int i, uint64_t rows[RHW_TILE])
{
    const struct triangle_setup8 *const setup = &scene->setup;
    struct coverage coverage;
    coverage_setup(&coverage, &scene->chunk, scene->read.triangle[i],
                   center_of_pixel(scene->work.x, scene->work.y));
    for (int y = setup->y0[i] & -RHW_BLOCK; y < setup->y1[i]; y += RHW_BLOCK) {
        for (int x = setup->x0[i] & -RHW_BLOCK; x < setup->x1[i]; x += RHW_BLOCK) {
            const uint64_t mask = coverage_mask(&coverage, x, y) &
                                  rect_mask(x, y, setup->x0[i], setup->y0[i], setup->x1[i], setup->y1[i]);
            for (int row = 0; row < RHW_BLOCK; row++) {
                rows[y + row] |= (mask >> (8 * row) & 0xff) << x;
            }
        }
    }
}

static void run_spans(const void *input, void *result)
{
    const struct setup_input *const in = input;
    struct span_result *const out = result;
    struct setup_scene scene;
    set_scene(&scene, in);
    memset(out, 0, sizeof *out);
    for (int i = 0; i < BATCH; i++) {
        struct span_collector collector;
        collector.triangle.setup = &scene.setup;
        collector.triangle.lane = i;
        collector.rows = out->by_spans[i];
        draw_span_blocks(&scene.work, &collector.triangle, collect_span);
        collect_coverage(&scene, i, out->by_coverage[i]);
    }
}

static const struct kernel_check checks[] = {
    {"setup_triangles8", sizeof(struct setup_input), sizeof(struct setup_result), KERNEL_BITS, make_setup,
     run_setup},
    {"span_blocks", sizeof(struct setup_input), sizeof(struct span_result), KERNEL_HALVES, make_small,
     run_spans},
};

const struct kernel_folder RHW_ISA_NAME(check_tile) = {"tile", checks, sizeof checks / sizeof *checks};
