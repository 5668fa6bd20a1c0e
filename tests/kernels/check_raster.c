// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/raster; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "kernels/raster/coverage.h"
#include "kernels/raster/double_double.h"
#include "kernels/raster/sample_position.h"

#include "kernel_folders.h"

enum {
    GUARD_24_8 = RHW_GUARD_BAND * RHW_SUBPIXEL,
    BLOCKS = (RHW_TILE / RHW_BLOCK) * (RHW_TILE / RHW_BLOCK),
    TILES = RHW_GUARD_BAND / 2 / RHW_TILE // each way, of the largest target
};

// Sample positions -----------------------------------------------------------------------------------

struct position_input {
    int32_t pixels[8], positions_24_8[8];
};

static void make_positions(struct kernel_random *random, void *input)
{
    struct position_input *const in = input;
    random_ints(random, in->pixels, 8, INT32_MIN, INT32_MAX);
    random_ints(random, in->positions_24_8, 8, -GUARD_24_8, GUARD_24_8);
}

static void run_positions(const void *input, void *result)
{
    const struct position_input *const in = input;
    const i32x8 positions = i32x8_load(in->positions_24_8);
    const i32x8 out[4] = {sample_of_pixel8(i32x8_load(in->pixels)), sample_from_position8(positions),
                          pixel_of_step8(positions, i32x8_splat(127)),
                          pixel_of_step8(positions, i32x8_splat(128))};
    memcpy(result, out, sizeof out);
}

// Coverage -------------------------------------------------------------------------------------------

struct coverage_input {
    int tile_x, tile_y;
    struct rhw_triangle triangle;
    struct rhw_polygon polygon;
};

struct coverage_result {
    uint64_t masks[BLOCKS];
    int64_t count, covers_tile;
};

// A triangle in a tile, or the polygon of a clipped one.
static void make_coverage(struct kernel_random *random, void *input)
{
    struct coverage_input *const in = input;
    in->tile_x = (int)random_int(random, 0, TILES - 1) * RHW_TILE;
    in->tile_y = (int)random_int(random, 0, TILES - 1) * RHW_TILE;
    const int32_t x = (in->tile_x + (int)random_int(random, 0, RHW_TILE)) * RHW_SUBPIXEL;
    const int32_t y = (in->tile_y + (int)random_int(random, 0, RHW_TILE)) * RHW_SUBPIXEL;
    random_triangle(random, x, y, in->triangle.x_24_8, in->triangle.y_24_8);
    const int32_t *const xs = in->triangle.x_24_8, *const ys = in->triangle.y_24_8;
    const int64_t area =
        (int64_t)(xs[1] - xs[0]) * (ys[2] - ys[0]) - (int64_t)(xs[2] - xs[0]) * (ys[1] - ys[0]);
    in->triangle.flags = area < 0 ? RHW_TRIANGLE_NEGATIVE : 0;
    if (area == 0 || random_one_in(random, 4)) { // one without area is never drawn, but a fan may have some
        const int most = sizeof in->polygon.x_24_8 / sizeof *in->polygon.x_24_8;
        in->triangle.flags = RHW_TRIANGLE_POLYGON;
        in->polygon.count = (int32_t)random_int(random, 3, most);
        for (int i = 0; i < most; i += 3) {
            random_triangle(random, x, y, &in->polygon.x_24_8[i], &in->polygon.y_24_8[i]);
        }
    }
}

static void run_coverage(const void *input, void *result)
{
    const struct coverage_input *const in = input;
    struct rhw_polygon polygon = in->polygon;
    const struct rhw_chunk chunk = {.polygons = &polygon};
    struct coverage coverage;
    coverage_setup(&coverage, &chunk, &in->triangle, center_of_pixel(in->tile_x, in->tile_y));
    struct coverage_result *const out = result;
    out->count = coverage.count;
    out->covers_tile = covers_tile(&coverage);
    for (int i = 0; i < BLOCKS; i++) {
        const int x = i % (RHW_TILE / RHW_BLOCK) * RHW_BLOCK, y = i / (RHW_TILE / RHW_BLOCK) * RHW_BLOCK;
        out->masks[i] = coverage_mask(&coverage, x, y);
    }
}

struct edges_input {
    int32_t x_24_8[3][8], y_24_8[3][8], turn[8], sample_x[8], sample_y[8];
    int edge;
};

// Eight triangles, most of them small and near the sample.
static void make_edges(struct kernel_random *random, void *input)
{
    struct edges_input *const in = input;
    in->edge = (int)random_int(random, 0, 2);
    for (int lane = 0; lane < 8; lane++) {
        int32_t xs[3], ys[3];
        in->sample_x[lane] = (int32_t)random_int(random, 0, GUARD_24_8 / 2);
        in->sample_y[lane] = (int32_t)random_int(random, 0, GUARD_24_8 / 2);
        random_triangle(random, in->sample_x[lane], in->sample_y[lane], xs, ys);
        for (int i = 0; i < 3; i++) {
            in->x_24_8[i][lane] = xs[i];
            in->y_24_8[i][lane] = ys[i];
        }
        in->turn[lane] = random_one_in(random, 2) ? -1 : 0;
    }
}

static void run_edges(const void *input, void *result)
{
    const struct edges_input *const in = input;
    i32x8 x[3], y[3];
    memcpy(x, in->x_24_8, sizeof x);
    memcpy(y, in->y_24_8, sizeof y);
    const struct edge_lanes edges =
        edge_lanes(x, y, in->edge, i32x8_load(in->turn), i32x8_load(in->sample_x), i32x8_load(in->sample_y));
    const i32x8 out[3] = {edges.a, edges.b, edges.e};
    memcpy(result, out, sizeof out);
}

struct rect_input {
    int x, y, x0, y0, x1, y1;
};

// A block of a tile, and a rectangle that overlaps it.
static void make_rect(struct kernel_random *random, void *input)
{
    struct rect_input *const in = input;
    in->x = (int)random_int(random, 0, RHW_TILE / RHW_BLOCK - 1) * RHW_BLOCK;
    in->y = (int)random_int(random, 0, RHW_TILE / RHW_BLOCK - 1) * RHW_BLOCK;
    in->x0 = (int)random_int(random, 0, in->x + RHW_BLOCK - 1);
    in->y0 = (int)random_int(random, 0, in->y + RHW_BLOCK - 1);
    in->x1 = (int)random_int(random, (in->x0 > in->x ? in->x0 : in->x) + 1, RHW_TILE);
    in->y1 = (int)random_int(random, (in->y0 > in->y ? in->y0 : in->y) + 1, RHW_TILE);
}

static void run_rect(const void *input, void *result)
{
    const struct rect_input *const in = input;
    const uint64_t mask = rect_mask(in->x, in->y, in->x0, in->y0, in->x1, in->y1);
    memcpy(result, &mask, sizeof mask);
}

// Double-double --------------------------------------------------------------------------------------

// A homogeneous triangle, whose numbers are floats, in a viewport.
struct clipped_input {
    double vertices[3][3]; // X, Y, W
    double half_width, half_height, cx, cy, dy;
    double dx[8];
};

static void make_clipped(struct kernel_random *random, void *input)
{
    struct clipped_input *const in = input;
    for (int v = 0; v < 3; v++) {
        float position[4];
        random_clip_position(random, position);
        in->vertices[v][0] = (double)position[0];
        in->vertices[v][1] = (double)position[1];
        in->vertices[v][2] = (double)position[3];
    }
    if (random_one_in(random, 4)) { // a sliver: the last vertex lies between the others but for roundings
        for (int i = 0; i < 3; i++) {
            in->vertices[2][i] = (double)(float)(0.5 * in->vertices[0][i] + 0.5 * in->vertices[1][i]);
        }
    }
    in->half_width = (double)random_int(random, 1, RHW_GUARD_BAND / 2) * 0.5;
    in->half_height = (double)random_int(random, 1, RHW_GUARD_BAND / 2) * 0.5;
    in->cx = (double)random_int(random, -RHW_GUARD_BAND, RHW_GUARD_BAND) * 0.5;
    in->cy = (double)random_int(random, -RHW_GUARD_BAND, RHW_GUARD_BAND) * 0.5;
    in->dy = (double)random_int(random, -RHW_GUARD_BAND, RHW_GUARD_BAND);
    const int64_t first = random_int(random, -RHW_GUARD_BAND, RHW_GUARD_BAND);
    for (int i = 0; i < 8; i++) {
        in->dx[i] = (double)(first + i);
    }
}

// The three edges at a row of pixels.
static void run_dd_edge(const void *input, void *result)
{
    const struct clipped_input *const in = input;
    f64x8 dx, rows[3];
    memcpy(&dx, in->dx, sizeof dx);
    for (int i = 0; i < 3; i++) {
        const struct dd_plane plane = dd_edge(in->vertices[(i + 1) % 3], in->vertices[(i + 2) % 3],
                                              in->half_width, in->half_height, in->cx, in->cy);
        rows[i] = dd_row(&plane, dx, in->dy);
    }
    memcpy(result, rows, sizeof rows);
}

static void run_dd_determinant(const void *input, void *result)
{
    struct clipped_input in = *(const struct clipped_input *)input;
    const struct dd determinant = dd_determinant(in.vertices);
    memcpy(result, &determinant, sizeof determinant);
}

static const struct kernel_check checks[] = {
    {"sample_position", sizeof(struct position_input), 4 * sizeof(i32x8), KERNEL_BITS, make_positions,
     run_positions},
    {"coverage_mask", sizeof(struct coverage_input), sizeof(struct coverage_result), KERNEL_BITS,
     make_coverage, run_coverage},
    {"edge_lanes", sizeof(struct edges_input), 3 * sizeof(i32x8), KERNEL_BITS, make_edges, run_edges},
    {"rect_mask", sizeof(struct rect_input), sizeof(uint64_t), KERNEL_BITS, make_rect, run_rect},
    {"dd_edge", sizeof(struct clipped_input), 3 * sizeof(f64x8), KERNEL_DOUBLES, make_clipped, run_dd_edge},
    {"dd_determinant", sizeof(struct clipped_input), sizeof(struct dd), KERNEL_DOUBLES, make_clipped,
     run_dd_determinant},
};

const struct kernel_folder RHW_ISA_NAME(check_raster) = {"raster", checks, sizeof checks / sizeof *checks};
