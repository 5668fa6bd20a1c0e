// SPDX-License-Identifier: MIT
// What flows from the vertex to the fragment function: smooth, noperspective and flat against the formulas,
// derivatives, constants, all 48 components, barycentrics and coordinates. Bounds are those of the contract.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64 };

struct sample_vertex {
    float position[4];
    float smooth, noperspective, flat;
};

static void qualifier_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
        }
        for (int c = 0; c < 3; c++) {
            groups[g].varying[c] = groups[g].attribute[1][c];
        }
    }
}

static void qualifier_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] = groups[g].varying[c];
        }
        groups[g].color[0][3] = groups[g].coord[3];
    }
}

static void derivative_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].ddx[0];
        groups[g].color[0][1] = groups[g].ddy[0];
        groups[g].color[0][2] = groups[g].ddx[1];
        groups[g].color[0][3] = groups[g].ddy[1];
    }
}

static void open_rig(struct rig *rig, rhw_fragment_function *fragment)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, qualifier_vertex, fragment);
    rig->pipeline.program.varyings[0] = (struct rhw_varying){.components = 1, .derivatives = true};
    rig->pipeline.program.varyings[1] =
        (struct rhw_varying){.components = 1, .qualifier = RHW_NOPERSPECTIVE, .derivatives = true};
    rig->pipeline.program.varyings[2] = (struct rhw_varying){.components = 1, .qualifier = RHW_FLAT};
    rig->pipeline.program.varying_count = 3;
    rig->pipeline.program.uses = RHW_USE_COORD;
    rig->pipeline.attributes[1] =
        (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct sample_vertex, smooth)};
    rig->pipeline.buffers[0].stride = sizeof(struct sample_vertex);
}

struct random_triangle {
    struct sample_vertex vertices[3];
    struct ref_triangle reference;
    double smooth[3], noperspective[3];
};

static struct random_triangle make_triangle(const struct rig *rig, uint64_t *random, float w_ratio)
{
    struct random_triangle t;
    memset(&t, 0, sizeof t);
    for (int i = 0; i < 3; i++) {
        t.reference.x_8[i] = rig_random_int(random, (SIZE + 32) * 256) - 16 * 256;
        t.reference.y_8[i] = rig_random_int(random, (SIZE + 32) * 256) - 16 * 256;
        const float w = powf(w_ratio, rig_random_float(random, 0, 1));
        t.reference.w[i] = (double)w;
        rig_place(rig, (float)t.reference.x_8[i] / 256, (float)t.reference.y_8[i] / 256, 0.5f, w,
                  t.vertices[i].position);
        t.vertices[i].smooth = rig_random_float(random, -1, 1);
        t.vertices[i].noperspective = rig_random_float(random, -100, 100);
        t.vertices[i].flat = rig_random_float(random, -1, 1);
        t.smooth[i] = (double)t.vertices[i].smooth;
        t.noperspective[i] = (double)t.vertices[i].noperspective;
    }
    return t;
}

static void draw_triangle(struct rig *rig, const struct sample_vertex vertices[3])
{
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, 3 * sizeof *vertices);
    rhw_pass_draw(rig->context, rig->recording, 0, 3, 0, 1);
    rig_end(rig);
}

static double largest_of(const double values[3])
{
    return fmax(fabs(values[0]), fmax(fabs(values[1]), fabs(values[2])));
}

static void expect_near(const char *what, double seen, double expected, double bound)
{
    if (!(fabs(seen - expected) <= bound)) {
        fail_msg("%s is %.9g, not %.17g: off by %.3g where %.3g is allowed", what, seen, expected,
                 fabs(seen - expected), bound);
    }
}

static void check_qualifiers(float w_ratio)
{
    struct rig rig;
    open_rig(&rig, qualifier_fragment);
    uint64_t random = 8;
    int covered = 0;
    for (int n = 0; n < 300; n++) {
        const struct random_triangle t = make_triangle(&rig, &random, w_ratio);
        rig.pipeline.provoking = n % 2 ? RHW_PROVOKING_LAST : RHW_PROVOKING_FIRST;
        draw_triangle(&rig, t.vertices);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIZE * SIZE; i++) {
            if (!ref_covers(&t.reference, i % SIZE, i / SIZE)) {
                assert_true(pixels[i][3] == 0);
                continue;
            }
            covered++;
            const struct ref_weights weights = ref_weights_at(&t.reference, i % SIZE + 0.5, i / SIZE + 0.5);
            expect_near("smooth", (double)pixels[i][0], ref_mix(weights.space, t.smooth),
                        8 * rig_ulp(largest_of(t.smooth)));
            expect_near("noperspective", (double)pixels[i][1], ref_mix(weights.screen, t.noperspective),
                        8 * rig_ulp(largest_of(t.noperspective)));
            assert_true(pixels[i][2] == t.vertices[n % 2 ? 2 : 0].flat);
            expect_near("1/w", (double)pixels[i][3], 1 / weights.w, 8 * rig_ulp(1 / weights.w));
        }
    }
    assert_true(covered > 50000);
    rig_close(&rig);
}

static void test_qualifiers_follow_the_formulas(void **state)
{
    (void)state;
    check_qualifiers(1);
    check_qualifiers(100);
    check_qualifiers(1e6f);
}

static void test_derivatives_follow_the_formulas(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, derivative_fragment);
    uint64_t random = 9;
    for (int n = 0; n < 200; n++) {
        const struct random_triangle t = make_triangle(&rig, &random, n % 2 ? 1 : 30);
        struct ref_triangle affine = t.reference;
        affine.w[0] = affine.w[1] = affine.w[2] = 1;
        draw_triangle(&rig, t.vertices);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIZE * SIZE; i++) {
            if (!ref_covers(&t.reference, i % SIZE, i / SIZE)) {
                continue;
            }
            const double x = i % SIZE + 0.5, y = i / SIZE + 0.5;
            // Values of the order of 1 over slivers give steep slopes: the bound follows the slope's terms.
            double steepest_smooth = 1e-3, steepest_affine = 1e-3;
            for (int k = 0; k < 3; k++) {
                const double unit[3] = {k == 0, k == 1, k == 2};
                for (int axis = 0; axis < 2; axis++) {
                    steepest_smooth =
                        fmax(steepest_smooth, fabs(ref_derivative(&t.reference, x, y, unit, axis)));
                    steepest_affine = fmax(steepest_affine, fabs(ref_derivative(&affine, x, y, unit, axis)));
                }
            }
            for (int axis = 0; axis < 2; axis++) { // rounded once
                const double smooth = ref_derivative(&t.reference, x, y, t.smooth, axis),
                             screen = ref_derivative(&affine, x, y, t.noperspective, axis);
                expect_near("d smooth", (double)pixels[i][axis], smooth,
                            0x1p-24 * fabs(smooth) + 1e-9 * steepest_smooth);
                expect_near("d noperspective", (double)pixels[i][2 + axis], screen,
                            0x1p-24 * fabs(screen) + 1e-9 * steepest_affine);
            }
        }
    }
    rig_close(&rig);
}

static void test_constants_survive(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, qualifier_fragment);
    uint64_t random = 10;
    for (int n = 0; n < 200; n++) {
        struct random_triangle t = make_triangle(&rig, &random, 1000);
        // Of every size, the negative zero included.
        const float smooth = n == 0 ? -0.0f : t.vertices[0].smooth * 1e10f;
        const float noperspective = n == 1 ? -0.0f : t.vertices[0].noperspective * 1e-30f;
        for (int i = 0; i < 3; i++) {
            t.vertices[i].smooth = smooth;
            t.vertices[i].noperspective = noperspective;
        }
        draw_triangle(&rig, t.vertices);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIZE * SIZE; i++) {
            if (!ref_covers(&t.reference, i % SIZE, i / SIZE)) {
                continue;
            }
            assert_memory_equal(&pixels[i][0], &smooth, sizeof smooth);
            assert_memory_equal(&pixels[i][1], &noperspective, sizeof noperspective);
        }
    }
    rig_close(&rig);
}

// Moving a triangle by whole pixels moves its picture and changes no bit of it.
static void test_translation_by_whole_pixels(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, qualifier_fragment);
    rig.pipeline.program.uses = RHW_USE_COORD;
    uint64_t random = 11;
    for (int n = 0; n < 100; n++) {
        struct random_triangle t = make_triangle(&rig, &random, 50);
        // Within 32×32 pixels; W powers of two so that every place is hit exactly.
        for (int i = 0; i < 3; i++) {
            const float w = ldexpf(1, rig_random_int(&random, 6));
            t.reference.w[i] = (double)w;
            t.reference.x_8[i] = rig_random_int(&random, 32 * 256);
            t.reference.y_8[i] = rig_random_int(&random, 32 * 256);
        }
        static float first[32 * 32][4];
        for (int place = 0; place < 4; place++) {
            const int dx = place == 0 ? 0 : rig_random_int(&random, 33);
            const int dy = place == 0 ? 0 : rig_random_int(&random, 33);
            for (int i = 0; i < 3; i++) {
                rig_place(&rig, (float)t.reference.x_8[i] / 256 + (float)dx,
                          (float)t.reference.y_8[i] / 256 + (float)dy, 0.5f, (float)t.reference.w[i],
                          t.vertices[i].position);
            }
            draw_triangle(&rig, t.vertices);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int y = 0; y < 32; y++) {
                const float(*row)[4] = pixels + (y + dy) * SIZE + dx;
                if (place == 0) {
                    memcpy(first[y * 32], row, 32 * sizeof *row);
                } else {
                    assert_memory_equal(first[y * 32], row, 32 * sizeof *row);
                }
            }
        }
    }
    rig_close(&rig);
}

static void weights_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < 3; i++) {
            groups[g].color[0][i] = groups[g].barycentric[i];
            groups[g].color[1][i] = groups[g].barycentric_noperspective[i];
            groups[g].color[2][i] = groups[g].barycentric_ddx[i];
            groups[g].color[3][i] = groups[g].barycentric_ddy[i];
        }
        for (int i = 0; i < 4; i++) {
            groups[g].color[4][i] = groups[g].coord[i];
        }
    }
}

static void test_barycentrics_and_coordinates(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, weights_fragment);
    rig.pipeline.program.uses = RHW_USE_COORD | RHW_USE_BARYCENTRIC | RHW_USE_BARYCENTRIC_DERIVATIVES;
    for (int t = 1; t < 5; t++) {
        rig_set_target(&rig, t, RHW_FORMAT_RGBA32_FLOAT);
    }
    uint64_t random = 12;
    static float targets[5][SIZE * SIZE][4];
    for (int n = 0; n < 100; n++) {
        const struct random_triangle t = make_triangle(&rig, &random, 30);
        draw_triangle(&rig, t.vertices);
        for (int i = 0; i < 5; i++) {
            memcpy(targets[i], rig_read(&rig, rig.pass.colors[i].texture), sizeof targets[i]);
        }
        for (int i = 0; i < SIZE * SIZE; i++) {
            if (!ref_covers(&t.reference, i % SIZE, i / SIZE)) {
                continue;
            }
            const double x = i % SIZE + 0.5, y = i / SIZE + 0.5;
            const struct ref_weights weights = ref_weights_at(&t.reference, x, y);
            for (int k = 0; k < 3; k++) {
                const double unit[3] = {k == 0, k == 1, k == 2};
                expect_near("barycentric", (double)targets[0][i][k], weights.space[k], 8 * rig_ulp(1));
                expect_near("barycentric_noperspective", (double)targets[1][i][k], weights.screen[k],
                            8 * rig_ulp(1));
                for (int axis = 0; axis < 2; axis++) {
                    const double expected = ref_derivative(&t.reference, x, y, unit, axis);
                    expect_near("barycentric derivative", (double)targets[2 + axis][i][k], expected,
                                1e-5 * fmax(fabs(expected), 0.1));
                }
            }
            assert_true((double)targets[4][i][0] == x && (double)targets[4][i][1] == y);
            expect_near("z", (double)targets[4][i][2], 0.5, 8 * rig_ulp(0.5));
            expect_near("1/w", (double)targets[4][i][3], 1 / weights.w, 8 * rig_ulp(1 / weights.w));
        }
    }
    rig_close(&rig);
}

static int many;  // components
static int shown; // the first of 32 that the targets show

static void many_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
        }
        const rhw_float number = __builtin_convertvector(groups[g].vertex_index, rhw_float);
        for (int i = 0; i < many; i++) {
            groups[g].varying[i] = number * (float)(i + 1) + (float)i;
        }
    }
}

static void many_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int t = 0; t < 8; t++) {
            for (int c = 0; c < 4; c++) {
                const int i = shown + t * 4 + c;
                groups[g].color[t][c] =
                    groups[g].varying[i % many] - groups[g].varying[(i + many / 2) % many];
            }
        }
    }
}

// Varyings of `kinds` qualifiers in turn, each component in its place. The number of components is 0 behind the last.
static void draw_components(const enum rhw_qualifier *qualifiers, int kinds,
                            const int components[RHW_MAX_VARYINGS])
{
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_program(&rig, many_vertex, many_fragment);
    enum rhw_qualifier qualifier_of[RHW_MAX_VARYING_COMPONENTS];
    many = 0;
    for (int v = 0; v < RHW_MAX_VARYINGS && components[v] != 0; v++) {
        rig.pipeline.program.varying_count = v + 1;
        rig.pipeline.program.varyings[v] =
            (struct rhw_varying){.components = components[v], .qualifier = qualifiers[v % kinds]};
        for (int c = 0; c < components[v]; c++) {
            qualifier_of[many++] = qualifiers[v % kinds];
        }
    }
    for (int t = 1; t < 8; t++) {
        rig_set_target(&rig, t, RHW_FORMAT_RGBA32_FLOAT);
    }
    struct ref_triangle reference = {{-256, 15000, 2000}, {300, 4000, 16000}, {1, 2, 4}, {0}};
    struct rig_vertex vertices[3] = {0};
    for (int i = 0; i < 3; i++) {
        rig_place(&rig, (float)reference.x_8[i] / 256, (float)reference.y_8[i] / 256, 0.5f,
                  (float)reference.w[i], vertices[i].position);
    }
    rig_draw_once(&rig, vertices, 3);
    for (int t = 0; t < 8; t++) {
        const float(*texels)[4] = (rig_read(&rig, rig.pass.colors[t].texture), rig.pixels);
        for (int i = 0; i < SIZE * SIZE; i++) {
            if (!ref_covers(&reference, i % SIZE, i / SIZE)) {
                continue;
            }
            const struct ref_weights weights = ref_weights_at(&reference, i % SIZE + 0.5, i / SIZE + 0.5);
            for (int c = 0; c < 4; c++) {
                double value[2];
                for (int k = 0; k < 2; k++) {
                    const int v = (shown + t * 4 + c + many / 2 * k) % many;
                    const double corner[3] = {v, 2.0 * v + 1, 3.0 * v + 2};
                    value[k] = qualifier_of[v] == RHW_FLAT     ? corner[0]
                               : qualifier_of[v] == RHW_SMOOTH ? ref_mix(weights.space, corner)
                                                               : ref_mix(weights.screen, corner);
                }
                expect_near("component", (double)texels[i][c], value[0] - value[1], 17 * rig_ulp(3.0 * many));
            }
        }
    }
    rig_close(&rig);
}

// Some sizes, and the most that there may be; with noperspective ones, which another path interpolates, and without.
static void test_all_components(void **state)
{
    (void)state;
    static const enum rhw_qualifier all[] = {RHW_SMOOTH, RHW_NOPERSPECTIVE, RHW_FLAT},
                                    two[] = {RHW_SMOOTH, RHW_FLAT}, flat_first[] = {RHW_FLAT, RHW_SMOOTH},
                                    smooth[] = {RHW_SMOOTH};
    static const int some[RHW_MAX_VARYINGS] = {4, 3, 2, 1, 4, 4, 3, 3, 2, 4, 1, 4, 4, 3, 2, 4};
    int widest[RHW_MAX_VARYINGS] = {0}, most[RHW_MAX_VARYINGS];
    for (int v = 0; v < RHW_MAX_VARYINGS; v++) {
        widest[v] = v < RHW_MAX_VARYING_COMPONENTS / 4 ? 4 : 0;
        most[v] = RHW_MAX_VARYING_COMPONENTS / RHW_MAX_VARYINGS;
    }
    shown = 0;
    draw_components(all, 3, some);
    draw_components(two, 2, some);
    draw_components(flat_first, 2, some);
    draw_components(smooth, 1, some);
    for (; shown < RHW_MAX_VARYING_COMPONENTS / 2; shown += 32) {
        draw_components(all, 3, widest);
        assert_int_equal(many, RHW_MAX_VARYING_COMPONENTS);
        draw_components(two, 2, most);
        assert_int_equal(many, RHW_MAX_VARYING_COMPONENTS);
    }
}

static void slopes_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        for (int i = 0; i < 32; i++) {
            const int component = shown + i;
            f->color[i / 4][i % 4] = f->varying[component] + f->ddx[component] - f->ddy[component];
        }
    }
}

// Draw 60 triangles of all sizes with the most components that there may be, and their derivatives. Return the hash of
// all targets.
static uint64_t hash_of_slopes(enum rhw_paths paths)
{
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_program(&rig, many_vertex, slopes_fragment);
    many = RHW_MAX_VARYING_COMPONENTS;
    for (int v = 0; v < RHW_MAX_VARYINGS; v++) {
        rig.pipeline.program.varyings[v] = (struct rhw_varying){
            .components = 2, .qualifier = (enum rhw_qualifier)(v * 7 / 5 % 3), .derivatives = true};
    }
    rig.pipeline.program.varying_count = RHW_MAX_VARYINGS;
    for (int t = 1; t < 8; t++) {
        rig_set_target(&rig, t, RHW_FORMAT_RGBA32_FLOAT);
    }
    struct rig_vertex vertices[180] = {0};
    uint64_t random = 5;
    for (int i = 0; i < 180; i += 3) {
        const float x = rig_random_float(&random, 0, SIZE), y = rig_random_float(&random, 0, SIZE),
                    size = i < 30 ? SIZE : 4;
        for (int k = 0; k < 3; k++) {
            rig_place(&rig, x + rig_random_float(&random, 0, size), y + rig_random_float(&random, 0, size),
                      0.5f, rig_random_float(&random, 1, 3), vertices[i + k].position);
        }
    }
    rig_draw_once(&rig, vertices, 180);
    uint64_t hash = 0;
    for (int t = 0; t < 8; t++) {
        hash = hash * 31 + rig_hash(&rig, t);
    }
    rig_close(&rig);
    return hash;
}

static void test_all_components_on_every_path(void **state)
{
    (void)state;
    for (shown = 0; shown < RHW_MAX_VARYING_COMPONENTS; shown += 32) {
        assert_true(hash_of_slopes(RHW_PATHS_ALL) == hash_of_slopes(RHW_PATHS_GENERAL));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_qualifiers_follow_the_formulas),
    cmocka_unit_test(test_derivatives_follow_the_formulas),
    cmocka_unit_test(test_constants_survive),
    cmocka_unit_test(test_translation_by_whole_pixels),
    cmocka_unit_test(test_barycentrics_and_coordinates),
    cmocka_unit_test(test_all_components),
    cmocka_unit_test(test_all_components_on_every_path),
};

const struct unit_tests test_varyings = UNIT_TESTS(tests, NULL, NULL);
