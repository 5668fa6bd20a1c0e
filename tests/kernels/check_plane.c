// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/raster: planes of triangles and their values; compiled with RHW_ISA_SUFFIX = baseline, ...
#include "kernels/raster/plane_clipped.h"
#include "kernels/raster/plane_setup.h"
#include "kernels/raster/sample_position.h"

#include "kernel_folders.h"

// A triangle that is drawn.
struct triangle_input {
    int32_t x_24_8[3], y_24_8[3];
    float position[3][4];
    double depth_low, depth_span;
    double dx[8], dy[8]; // pixels from the anchor
};

struct four_triangles_input {
    struct triangle_input triangles[4];
};

// A block of columns and rows, and pixels that lie anywhere, which both of `plane_value8` and its callers take.
static void make_offsets(struct kernel_random *random, struct triangle_input *in)
{
    const int64_t x = random_int(random, -2 * RHW_TILE, 2 * RHW_TILE),
                  y = random_int(random, -2 * RHW_TILE, 2 * RHW_TILE);
    for (int i = 0; i < 8; i++) {
        in->dx[i] = (double)(x + i);
        in->dy[i] = (double)(y + i);
    }
}

static void make_depth_range(struct kernel_random *random, struct triangle_input *in)
{
    const double low = random_one_in(random, 2) ? 0.0 : (double)random_float_in(random, 0.0f, 1.0f);
    const double high = random_one_in(random, 2) ? 1.0 : (double)random_float_in(random, 0.0f, 1.0f);
    in->depth_low = low;
    in->depth_span = high - low;
}

// Of vertices that are snapped: W is positive and finite, of any size beside that of the others; the area is not 0.
static void make_snapped_triangle(struct kernel_random *random, struct triangle_input *in)
{
    int64_t area;
    do {
        random_triangle(random, (int32_t)random_int(random, 0, 1 << 20),
                        (int32_t)random_int(random, 0, 1 << 20), in->x_24_8, in->y_24_8);
        const int32_t *const x = in->x_24_8, *const y = in->y_24_8;
        area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    } while (area == 0);
    const bool affine = random_one_in(random, 4);
    for (int v = 0; v < 3; v++) {
        float *const position = in->position[v];
        do {
            random_clip_position(random, position);
        } while (!(position[3] > 0.0f && position[3] < 0x1p127f));
        position[3] = affine ? 1.0f : position[3];
        position[2] = random_one_in(random, 8) ? random_finite(random)
                                               : position[3] * random_float_in(random, 0.0f, 1.0f);
    }
    make_depth_range(random, in);
    make_offsets(random, in);
}

static void make_snapped(struct kernel_random *random, void *input)
{
    make_snapped_triangle(random, input);
}

// A clipped one may lose its area when it is snapped.
static void make_clipped_snapped(struct kernel_random *random, void *input)
{
    struct triangle_input *const in = input;
    make_snapped_triangle(random, in);
    if (random_one_in(random, 8)) {
        in->x_24_8[2] = in->x_24_8[1];
        in->y_24_8[2] = in->y_24_8[1];
    }
}

static void make_four_snapped(struct kernel_random *random, void *input)
{
    struct four_triangles_input *const in = input;
    for (int i = 0; i < 4; i++) {
        make_snapped_triangle(random, &in->triangles[i]);
    }
}

// Of vertices that may lie anywhere, behind the eye too.
static void make_clipped(struct kernel_random *random, void *input)
{
    struct triangle_input *const in = input;
    for (int v = 0; v < 3; v++) {
        do {
            random_clip_position(random, in->position[v]);
        } while (!(in->position[v][3] - in->position[v][3] == 0.0f)); // finite
        for (int i = 0; i < 3; i++) {
            in->position[v][i] = in->position[v][i] - in->position[v][i] == 0.0f ? in->position[v][i] : 1.0f;
        }
    }
    if (random_one_in(random, 4)) { // a sliver
        for (int i = 0; i < 4; i++) {
            in->position[2][i] = 0.5f * in->position[0][i] + 0.5f * in->position[1][i];
        }
    }
    make_depth_range(random, in);
    make_offsets(random, in);
}

static void set_lane(f64x4 *v, int lane, double value)
{
    memcpy((double *)(void *)v + lane, &value, sizeof value);
}

static void add_triangle(struct setup_input4 *out, int lane, const struct triangle_input *in)
{
    const int32_t *const x = in->x_24_8, *const y = in->y_24_8;
    set_lane(&out->x1, lane, x[1] - x[0]);
    set_lane(&out->y1, lane, y[1] - y[0]);
    set_lane(&out->x2, lane, x[2] - x[0]);
    set_lane(&out->y2, lane, y[2] - y[0]);
    set_lane(&out->px, lane, sample_from_position(x[0]));
    set_lane(&out->py, lane, sample_from_position(y[0]));
    for (int v = 0; v < 3; v++) {
        set_lane(&out->z[v], lane, (double)in->position[v][2]);
        set_lane(&out->w[v], lane, (double)in->position[v][3]);
    }
    set_lane(&out->depth_low, lane, in->depth_low);
    set_lane(&out->depth_span, lane, in->depth_span);
}

static void run_setup(const void *input, void *result)
{
    const struct four_triangles_input *const in = input;
    struct setup_input4 four;
    for (int i = 0; i < 4; i++) {
        add_triangle(&four, i, &in->triangles[i]);
    }
    struct setup_output4 out;
    setup_planes4(&out, &four);
    memcpy(result, &out, sizeof out);
}

// The planes of a triangle as the tiles have them.
static void set_planes(struct planes *planes, const struct triangle_input *in)
{
    struct setup_input4 four;
    for (int i = 0; i < 4; i++) {
        add_triangle(&four, i, in);
    }
    struct setup_output4 out;
    setup_planes4(&out, &four);
    memset(planes, 0, sizeof *planes);
    planes->kind = out.is_exact[0] ? PLANES_EXACT : PLANES_LINEAR;
    for (int q = 0; q < 4; q++) {
        planes->quantities.at[q] = out.quantity[q].at[0];
        planes->quantities.dx[q] = out.quantity[q].dx[0];
        planes->quantities.dy[q] = out.quantity[q].dy[0];
    }
    planes->inverse_area = out.inverse_area[0];
    setup_factors(&planes->factors, &four);
    planes->n1 = plane_scale(planes->inverse_area, planes->factors.e1);
    planes->n2 = plane_scale(planes->inverse_area, planes->factors.e2);
}

static struct anchor_offset offsets_of(const struct triangle_input *in)
{
    struct anchor_offset at;
    memcpy(&at.dx, in->dx, sizeof at.dx);
    memcpy(&at.dy, in->dy, sizeof at.dy);
    return at;
}

// What a row has, as doubles.
struct row_result {
    f64x8 depth, b, c, s, inverse_s, screen_s, screen_t;
};

static void store_weights(struct row_result *out, const struct weights *weights,
                          const struct screen_weights *screen)
{
    out->b = f64x8_from_f32x8(weights->b);
    out->c = f64x8_from_f32x8(weights->c);
    out->s = weights->s;
    out->inverse_s = weights->inverse_s;
    out->screen_s = screen->s;
    out->screen_t = screen->t;
}

static void run_block(const void *input, void *result)
{
    const struct anchor_offset at = offsets_of(input);
    struct row_result *const out = result;
    struct planes planes;
    set_planes(&planes, input);
    const enum weight_path path = weight_path_of(&planes);
    struct block_planes block;
    block_depth(&block, &planes, &at);
    block_weights(&block, &planes, &at, path);
    block_screen_weights(&block, &planes, &at);
    for (int row = 0; row < RHW_BLOCK; row++) {
        const struct weights weights = weights_of_row(&planes, &block, row, path);
        const struct screen_weights screen = screen_weights_of_row(&planes, &block, row);
        out[row].depth = f64x8_from_f32x8(depth_of_row(&planes, &block, row));
        store_weights(&out[row], &weights, &screen);
    }
}

// Pixels anywhere, and the four quantities at each of them.
struct pixels_result {
    struct row_result row;
    f64x4 quantities[8];
};

static void run_pixels(const void *input, void *result)
{
    const struct triangle_input *const in = input;
    const struct anchor_offset at = offsets_of(in);
    struct pixels_result *const out = result;
    struct planes planes;
    set_planes(&planes, in);
    const struct weights weights = weights_of_pixels(&planes.quantities, &at);
    const struct screen_weights screen = {plane_value8(planes.n1, at.dx, at.dy),
                                          plane_value8(planes.n2, at.dx, at.dy)};
    store_weights(&out->row, &weights, &screen);
    out->row.depth = plane_value8(plane_of(&planes.quantities, QUANTITY_Z), at.dx, at.dy);
    for (int i = 0; i < 8; i++) {
        out->quantities[i] = quantity_values(&planes.quantities, in->dx[i], in->dy[i]);
    }
}

struct clipped_result {
    struct row_result rows[RHW_BLOCK];
    double lanes[RHW_BLOCK]; // which of a row are replaced, as bits
    double leaves_triangle[4];
};

static void store_clipped(struct clipped_result *out, const struct planes *planes,
                          const struct clipped_planes *clipped, const struct anchor_offset *at)
{
    out->leaves_triangle[0] = block_leaves_triangle(planes, clipped, at);
    memset(&out->leaves_triangle[1], 0, 3 * sizeof(double));
    for (int row = 0; row < RHW_BLOCK; row++) {
        struct clipped_row values;
        clipped_row_set(&values, planes, clipped, at, row);
        out->lanes[row] = i32x8_sign_bits(values.lanes);
        out->rows[row].depth = f64x8_from_f32x8(values.z);
        store_weights(&out->rows[row], &values.weights, &values.screen);
    }
}

// The vertices of the input as records, and the viewport.
struct clipped_triangle {
    _Alignas(RHW_CACHE_LINE) unsigned char records[3][RHW_CACHE_LINE]; // without varyings
    const struct rhw_vertex_record *vertices[3];
    struct rhw_draw_state state;
};

static void set_clipped_triangle(struct clipped_triangle *triangle, const struct triangle_input *in)
{
    for (int v = 0; v < 3; v++) {
        struct rhw_vertex_record *const record = (struct rhw_vertex_record *)(void *)triangle->records[v];
        memcpy(record->position, in->position[v], sizeof in->position[v]);
        triangle->vertices[v] = record;
    }
    triangle->state.depth_low = in->depth_low;
    triangle->state.depth_span = in->depth_span;
    triangle->state.half_width = triangle->state.center_x = 960.0;
    triangle->state.half_height = triangle->state.center_y = 540.5;
}

static void run_homogeneous(const void *input, void *result)
{
    const struct anchor_offset at = offsets_of(input);
    struct clipped_triangle triangle;
    struct planes planes;
    struct clipped_planes clipped;
    set_clipped_triangle(&triangle, input);
    planes_homogeneous(&planes, &clipped, &triangle.state, triangle.vertices);
    store_clipped(result, &planes, &clipped, &at);
}

static void run_clipped_snapped(const void *input, void *result)
{
    const struct anchor_offset at = offsets_of(input);
    struct clipped_triangle triangle;
    struct planes planes;
    struct clipped_planes clipped;
    set_clipped_triangle(&triangle, input);
    set_planes(&planes, input);
    planes_clipped_snapped(&planes, &clipped, &triangle.state, triangle.vertices);
    store_clipped(result, &planes, &clipped, &at);
}

static const struct kernel_check checks[] = {
    {"setup_planes4", sizeof(struct four_triangles_input), sizeof(struct setup_output4), KERNEL_DOUBLES,
     make_four_snapped, run_setup},
    {"weights_of_row", sizeof(struct triangle_input), RHW_BLOCK * sizeof(struct row_result), KERNEL_DOUBLES,
     make_snapped, run_block},
    {"weights_of_pixels", sizeof(struct triangle_input), sizeof(struct pixels_result), KERNEL_DOUBLES,
     make_snapped, run_pixels},
    {"planes_homogeneous", sizeof(struct triangle_input), sizeof(struct clipped_result), KERNEL_DOUBLES,
     make_clipped, run_homogeneous},
    {"planes_clipped_snapped", sizeof(struct triangle_input), sizeof(struct clipped_result), KERNEL_DOUBLES,
     make_clipped_snapped, run_clipped_snapped},
};

const struct kernel_folder RHW_ISA_NAME(check_plane) = {"raster", checks, sizeof checks / sizeof *checks};
