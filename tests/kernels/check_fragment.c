// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/fragment: varyings and their derivatives; compiled with RHW_ISA_SUFFIX = baseline, ...
#include "kernels/fragment/derivative.h"
#include "kernels/fragment/interpolate.h"
#include "kernels/fragment/pack.h"

#include "kernel_folders.h"

enum { COMPONENTS = 11 }; // one vector of a packed group, and a part of one

// Varyings of three vertices, and where some fragments are.
struct varyings_input {
    float varyings[3][16];
    float b[RHW_BLOCK][8], c[RHW_BLOCK][8];
    double screen[2][8];
    int32_t provoking_first, is_homogeneous, qualifier[16];
};

static void make_varyings(struct kernel_random *random, void *input)
{
    struct varyings_input *const in = input;
    for (int i = 0; i < 16; i++) {
        const bool constant = random_one_in(random, 4);
        for (int v = 0; v < 3; v++) {
            in->varyings[v][i] = constant && v > 0 ? in->varyings[0][i] : random_float(random);
        }
        in->qualifier[i] = (int32_t)random_int(random, RHW_SMOOTH, RHW_FLAT);
    }
    for (int n = 0; n < RHW_BLOCK; n++) {
        for (int i = 0; i < 8; i++) {
            in->b[n][i] =
                random_one_in(random, 16) ? random_float(random) : random_float_in(random, 0.0f, 1.0f);
            in->c[n][i] =
                random_one_in(random, 16) ? random_float(random) : random_float_in(random, 0.0f, 1.0f);
        }
    }
    for (int i = 0; i < 8; i++) {
        in->screen[0][i] = random_finite_double(random, 30);
        in->screen[1][i] = random_finite_double(random, 30);
    }
    in->provoking_first = random_one_in(random, 2);
    in->is_homogeneous = random_one_in(random, 2);
}

// Vertex records with the varyings of an input, and the triangle that they make.
struct varyings_triangle {
    _Alignas(RHW_CACHE_LINE) float records[3][32];
    const struct rhw_vertex_record *v[3];
    struct rhw_triangle t;
    struct rhw_pipeline_data pipeline;
    struct triangle_work work;
};

static void set_varyings(struct varyings_triangle *triangle, const float varyings[3][16])
{
    memset(&triangle->pipeline, 0, sizeof triangle->pipeline);
    triangle->pipeline.varying_components = COMPONENTS;
    triangle->work.v = triangle->v;
    triangle->work.t = &triangle->t;
    for (int v = 0; v < 3; v++) {
        struct rhw_vertex_record *const record = (struct rhw_vertex_record *)(void *)triangle->records[v];
        memcpy(record->varyings, varyings[v], sizeof varyings[v]);
        triangle->v[v] = record;
    }
}

static void run_interpolate_groups(const void *input, void *result)
{
    const struct varyings_input *const in = input;
    struct varyings_triangle triangle;
    struct group_weights weights;
    set_varyings(&triangle, in->varyings);
    set_values(&triangle.work, &triangle.pipeline);
    memcpy(weights.b, in->b, sizeof weights.b);
    memcpy(weights.c, in->c, sizeof weights.c);
    const struct rhw_component_run runs[] = {{0, 3}, {3, COMPONENTS}};
    for (int i = 0; i < 2; i++) {
        interpolate_groups(result, COMPONENTS, runs[i], &triangle.work, &weights, RHW_BLOCK);
    }
}

static void run_interpolate_any(const void *input, void *result)
{
    const struct varyings_input *const in = input;
    struct varyings_triangle triangle;
    set_varyings(&triangle, in->varyings);
    triangle.pipeline.def.provoking = in->provoking_first ? RHW_PROVOKING_FIRST : RHW_PROVOKING_LAST;
    triangle.pipeline.any_noperspective = true;
    for (int i = 0; i < COMPONENTS; i++) {
        triangle.pipeline.component_qualifier[i] = (uint8_t)in->qualifier[i];
    }
    set_values(&triangle.work, &triangle.pipeline);
    triangle.work.planes.is_homogeneous = in->is_homogeneous;
    struct weights weights = {.b = f32x8_load(in->b), .c = f32x8_load(in->c)};
    struct screen_weights screen;
    memcpy(&screen.s, in->screen[0], sizeof screen.s);
    memcpy(&screen.t, in->screen[1], sizeof screen.t);
    interpolate_any(result, &triangle.pipeline, &triangle.work, &weights, &screen);
}

// Each lane a triangle of its own: here the same three vertices in another order.
static void run_pack_components(const void *input, void *result)
{
    const struct varyings_input *const in = input;
    struct rhw_pipeline_data pipeline = {0};
    const struct packed_weights weights = {in->b[0], in->c[0], in->c[0], in->b[0]};
    struct packed_triangle orders[3];
    const struct packed_triangle *lanes[8];
    f32x8 out[16];
    for (int order = 0; order < 3; order++) {
        for (int v = 0; v < 3; v++) {
            orders[order].varyings[v] = in->varyings[(v + order) % 3];
        }
        orders[order].provoking = orders[order].varyings[0];
    }
    for (int lane = 0; lane < 8; lane++) {
        lanes[lane] = &orders[lane % 3];
    }
    for (int i = 0; i < COMPONENTS; i++) {
        pipeline.flat_mask[i] = in->qualifier[i] == RHW_FLAT ? -1 : 0;
        pipeline.noperspective_mask[i] = in->qualifier[i] == RHW_NOPERSPECTIVE ? -1 : 0;
    }
    pack_smooth(lanes, 4, &weights, out);
    pack_qualified(lanes, 4, &weights, &pipeline, out + 8);
    memcpy(result, out, sizeof out);
}

// A snapped triangle with W and two varyings, and 8 pixels.
struct derivative_input {
    float varyings[3][16], w[3];
    int32_t x_24_8[3], y_24_8[3], anchor_x, anchor_y;
    double inverse_area, dx[8], dy[8], inverse_s[8];
};

static void make_derivative(struct kernel_random *random, void *input)
{
    struct derivative_input *const in = input;
    int64_t area;
    do {
        random_triangle(random, 1 << 16, 1 << 16, in->x_24_8, in->y_24_8);
        const int32_t *const x = in->x_24_8, *const y = in->y_24_8;
        area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    } while (area == 0);
    in->inverse_area = 1.0 / (double)(area < 0 ? -area : area);
    in->anchor_x = in->x_24_8[0] >> RHW_SUBPIXEL_BITS;
    in->anchor_y = in->y_24_8[0] >> RHW_SUBPIXEL_BITS;
    for (int v = 0; v < 3; v++) {
        in->varyings[v][0] = random_float(random);
        in->varyings[v][1] = random_float(random);
        in->w[v] = random_float_in(random, 0x1p-20f, 0x1p20f);
    }
    for (int i = 0; i < 8; i++) {
        in->dx[i] = (double)random_int(random, -4 * RHW_TILE, 4 * RHW_TILE);
        in->dy[i] = (double)random_int(random, -4 * RHW_TILE, 4 * RHW_TILE);
        in->inverse_s[i] = random_finite_double(random, 20);
    }
}

static void run_derivatives(const void *input, void *result)
{
    const struct derivative_input *const in = input;
    struct varyings_triangle triangle;
    set_varyings(&triangle, in->varyings);
    for (int v = 0; v < 3; v++) {
        triangle.t.x_24_8[v] = in->x_24_8[v];
        triangle.t.y_24_8[v] = in->y_24_8[v];
        triangle.records[v][7] = in->w[v];
    }
    struct planes *const planes = &triangle.work.planes;
    planes->kind = PLANES_LINEAR;
    planes->is_homogeneous = false;
    planes->inverse_area = in->inverse_area;
    planes->anchor_x = in->anchor_x;
    planes->anchor_y = in->anchor_y;
    triangle.pipeline.derivative_pairs = 1;
    triangle.pipeline.derivative_component[0][1] = 1;
    struct derivative_pair pair;
    component_derivatives(&pair, &triangle.work, &triangle.pipeline);
    struct anchor_offset at;
    f64x8 inverse_s;
    memcpy(&at.dx, in->dx, sizeof at.dx);
    memcpy(&at.dy, in->dy, sizeof at.dy);
    memcpy(&inverse_s, in->inverse_s, sizeof inverse_s);
    f32x8 out[4];
    for (int which = 0; which < 2; which++) {
        pair_derivatives(&pair, which, &at, f64x8_mul(inverse_s, inverse_s), &out[2 * which],
                         &out[2 * which + 1]);
    }
    memcpy(result, out, sizeof out);
}

static const struct kernel_check checks[] = {
    {"interpolate_groups", sizeof(struct varyings_input), RHW_BLOCK *COMPONENTS * sizeof(f32x8),
     KERNEL_FLOATS, make_varyings, run_interpolate_groups},
    {"interpolate_any", sizeof(struct varyings_input), COMPONENTS * sizeof(f32x8), KERNEL_FLOATS,
     make_varyings, run_interpolate_any},
    {"pack_components", sizeof(struct varyings_input), 16 * sizeof(f32x8), KERNEL_FLOATS, make_varyings,
     run_pack_components},
    {"derivatives", sizeof(struct derivative_input), 4 * sizeof(f32x8), KERNEL_FLOATS, make_derivative,
     run_derivatives},
};

const struct kernel_folder RHW_ISA_NAME(check_fragment) = {"fragment", checks,
                                                           sizeof checks / sizeof *checks};
