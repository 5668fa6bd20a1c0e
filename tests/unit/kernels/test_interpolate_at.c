// SPDX-License-Identifier: MIT
// rhw_interpolate_at: a value worked out by hand, then random triangles against the formulas at the place that was asked
// for, from centres and from samples, and the form for one at a time bit for bit.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <string.h>
#include <stddef.h>

enum { SIZE = 64, SMOOTH = 0, SCREEN = 1, W = 2 };

struct vertex {
    float position[4];
    float smooth, screen;
};

static void vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
        }
        groups[g].varying[SMOOTH] = groups[g].attribute[1][0];
        groups[g].varying[SCREEN] = groups[g].attribute[1][1];
        groups[g].varying[W] = groups[g].position[3];
    }
}

// The values at an offset that the uniforms have.
static void move(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const float *const by = f->uniforms;
        const rhw_float offset[2] = {rhw_splat(by[0]), rhw_splat(by[1])};
        f->color[0][0] = rhw_interpolate_at(f, SMOOTH, W, offset);
        f->color[0][1] = rhw_interpolate_at(f, SCREEN, -1, offset);
        f->color[0][2] = rhw_interpolate_at(f, W, W, offset);
        f->color[0][3] = f->coord[3];
    }
}

static void move1(struct rhw_fragment1 *f)
{
    const float *const by = f->uniforms;
    f->color[0][0] = rhw_interpolate_at1(f, SMOOTH, W, by);
    f->color[0][1] = rhw_interpolate_at1(f, SCREEN, -1, by);
    f->color[0][2] = rhw_interpolate_at1(f, W, W, by);
    f->color[0][3] = f->coord[3];
}

// From a sample to the centre.
static void move_to_center(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_float offset[2] = {0.5f - f->sample_position[0], 0.5f - f->sample_position[1]};
        f->color[0][0] = rhw_interpolate_at(f, SMOOTH, W, offset);
        f->color[0][1] = rhw_interpolate_at(f, SCREEN, -1, offset);
        f->color[0][2] = rhw_interpolate_at(f, W, W, offset);
        f->color[0][3] = rhw_splat(1);
    }
}

static void open_rig(struct rig *rig, rhw_fragment_function *fragment, rhw_fragment1_function *one)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, vertex, fragment);
    rig->pipeline.program.fragment1 = one;
    for (int i = 0; i < 3; i++) {
        rig->pipeline.program.varyings[i] = (struct rhw_varying){.components = 1, .derivatives = true};
    }
    rig->pipeline.program.varyings[SCREEN].qualifier = RHW_NOPERSPECTIVE;
    rig->pipeline.program.varying_count = 3;
    rig->pipeline.program.uses = RHW_USE_COORD;
    rig->pipeline.attributes[1] =
        (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct vertex, smooth)};
    rig->pipeline.buffers[0].stride = sizeof(struct vertex);
}

static const float (*draw(struct rig *rig, const struct vertex vertices[3], const float offset[2]))[4]
{
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, 3 * sizeof *vertices);
    rhw_pass_set_uniforms(rig->context, rig->recording, offset, 2 * sizeof *offset);
    rhw_pass_draw(rig->context, rig->recording, 0, 3, 0, 1);
    rig_end(rig);
    return rig_read_float4(rig);
}

static void expect_near(double seen, double expected, double bound)
{
    if (!(fabs(seen - expected) <= bound)) {
        fail_msg("%.9g is not %.17g: off by %.3g where %.3g is allowed", seen, expected,
                 fabs(seen - expected), bound);
    }
}

// Corners 0, 0 and 0, 64 with W = 1 and value 0, corner 64, 0 with W = 2 and value 1: 1/W = 1 − x/128, and the value is
// (x/64 · 1/2) / (1 − x/128) = x / (128 − x).
static void test_by_hand(void **state)
{
    (void)state;
    static const struct {
        float offset[2], value, w;
    } cases[] = {{{31.5f, 0}, 1 / 3.0f, 4 / 3.0f},
                 {{31.5f, 7}, 1 / 3.0f, 4 / 3.0f},
                 {{0.25f, -0.5f}, 0.75f / 127.25f, 128 / 127.25f},
                 {{63.5f, 0}, 1, 2},
                 {{-0.5f, 0}, 0, 1},
                 {{-128.5f, 0}, -0.5f, 0.5f}};
    struct rig rig;
    open_rig(&rig, move, NULL);
    struct vertex vertices[3] = {{.smooth = 0, .screen = 0}, {.smooth = 1, .screen = 64}, {.screen = 0}};
    rig_place(&rig, 0, 0, 0.5f, 1, vertices[0].position);
    rig_place(&rig, SIZE, 0, 0.5f, 2, vertices[1].position);
    rig_place(&rig, 0, SIZE, 0.5f, 1, vertices[2].position);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float *const first = draw(&rig, vertices, cases[i].offset)[0];
        expect_near((double)first[0], (double)cases[i].value, 4 * rig_ulp(1));
        expect_near((double)first[1], 0.5 + (double)cases[i].offset[0], 4 * rig_ulp(64));
        expect_near((double)first[2], (double)cases[i].w, 4 * rig_ulp(1));
    }
    rig_close(&rig);
}

struct random_triangle {
    struct vertex vertices[3];
    struct ref_triangle reference;
    double smooth[3], screen[3];
};

static struct random_triangle make_triangle(const struct rig *rig, uint64_t *random)
{
    struct random_triangle t;
    memset(&t, 0, sizeof t);
    for (int i = 0; i < 3; i++) {
        t.reference.x_8[i] = rig_random_int(random, SIZE * 256);
        t.reference.y_8[i] = rig_random_int(random, SIZE * 256);
        const float w = powf(30, rig_random_float(random, 0, 1));
        t.reference.w[i] = (double)w;
        rig_place(rig, (float)t.reference.x_8[i] / 256, (float)t.reference.y_8[i] / 256, 0.5f, w,
                  t.vertices[i].position);
        t.smooth[i] = (double)(t.vertices[i].smooth = rig_random_float(random, -1, 1));
        t.screen[i] = (double)(t.vertices[i].screen = rig_random_float(random, -1, 1));
    }
    return t;
}

static bool is_inside(const struct ref_weights *weights)
{
    return weights->screen[0] >= 0 && weights->screen[1] >= 0 && weights->screen[2] >= 0;
}

// The larger of `largest` and the largest derivative of a weight times it and the offset. `moved`: from the place where the
// derivative is taken.
static double reach_of(const struct random_triangle *t, double x, double y, const float moved[2],
                       double largest)
{
    double reach = largest;
    for (int i = 0; i < 3; i++) {
        const double corner[3] = {i == 0, i == 1, i == 2};
        for (int axis = 0; axis < 2; axis++) {
            const double slope = ref_derivative(&t->reference, x, y, corner, axis);
            reach = fmax(reach, fabs(slope * (double)moved[axis]) * largest);
        }
    }
    return reach;
}

static double largest_of(const double v[3])
{
    return fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
}

// Offsets as in GLSL, and farther, whose places lie in the triangle. The docstring's error, with 5 in place of 32, which takes
// triangles of more extreme W (tests/exact).
static void test_against_the_formulas(void **state)
{
    (void)state;
    struct rig rig, one;
    open_rig(&rig, move, NULL);
    open_rig(&one, NULL, move1);
    uint64_t random = 15;
    int seen = 0;
    for (int n = 0; n < 100; n++) {
        const struct random_triangle t = make_triangle(&rig, &random);
        struct random_triangle flat = t; // its weights in space are those on the screen
        flat.reference.w[0] = flat.reference.w[1] = flat.reference.w[2] = 1;
        const float reach = n % 2 ? 0.5f : 20;
        const float offset[2] = {rig_random_float(&random, -reach, reach),
                                 rig_random_float(&random, -reach, reach)};
        const float(*const pixels)[4] = draw(&rig, t.vertices, offset);
        assert_memory_equal(draw(&one, t.vertices, offset), pixels, sizeof(float[SIZE * SIZE][4]));
        for (int i = 0; i < SIZE * SIZE; i++) {
            const double x = i % SIZE + 0.5 + (double)offset[0], y = i / SIZE + 0.5 + (double)offset[1];
            const struct ref_weights there = ref_weights_at(&t.reference, x, y);
            if (ref_covers(&t.reference, i % SIZE, i / SIZE) && is_inside(&there)) {
                const double from_x = i % SIZE + 0.5, from_y = i / SIZE + 0.5, w = largest_of(t.reference.w);
                const double spread = reach_of(&t, from_x, from_y, offset, w) / there.w;
                const double smooth = reach_of(&t, from_x, from_y, offset, largest_of(t.smooth));
                const double screen = reach_of(&flat, from_x, from_y, offset, largest_of(t.screen));
                seen++;
                expect_near((double)pixels[i][0], ref_mix(there.space, t.smooth),
                            5 * rig_ulp(smooth) * spread);
                expect_near((double)pixels[i][1], ref_mix(there.screen, t.screen), 5 * rig_ulp(screen));
                expect_near((double)pixels[i][2], there.w, 5 * rig_ulp(spread * there.w) * spread);
            }
        }
    }
    assert_true(seen > 10000);
    rig_close(&one);
    rig_close(&rig);
}

// An offset counts from where the fragment has its values: every sample finds the centre.
static void test_from_samples(void **state)
{
    (void)state;
    struct rig rig, plain;
    open_rig(&plain, move, NULL);
    open_rig(&rig, move_to_center, NULL);
    rig.pass.samples = 4;
    rig.pipeline.program.varyings[SMOOTH].sampling = RHW_SAMPLING_SAMPLE;
    rig.pipeline.program.uses = RHW_USE_SAMPLE;
    uint64_t random = 16;
    static const float none[2];
    for (int n = 0; n < 20; n++) {
        struct random_triangle t = make_triangle(&rig, &random);
        const float(*const moved)[4] = draw(&rig, t.vertices, none),
                           (*const expected)[4] = draw(&plain, t.vertices, none);
        for (int i = 0; i < SIZE * SIZE; i++) {
            if (moved[i][3] == 1 && expected[i][3] != 0) { // all samples are covered
                for (int c = 0; c < 3; c++) {
                    expect_near((double)moved[i][c], (double)expected[i][c],
                                64 * rig_ulp(fmax(1, fabs((double)expected[i][c]))));
                }
            }
        }
    }
    rig_close(&plain);
    rig_close(&rig);
}

// As far as limits say, and by steps of the bits they give: a value that is x less 31.5, which is 0 in the middle of a
// pixel.
static void test_limits(void **state)
{
    (void)state;
    const struct rhw_limits l = rhw_limits_get();
    const float least = l.min_interpolation_offset, most = l.max_interpolation_offset;
    const float step = 1.0f / (float)(1u << l.sub_pixel_interpolation_offset_bits);
    assert_true(least <= -0.5f && most >= 0.5f - step && l.sub_pixel_interpolation_offset_bits >= 4);
    const float offsets[] = {least, most, least + step, most - step, -0.5f, 0.5f - step, step, -step};
    for (int one = 0; one < 2; one++) {
        struct rig rig;
        open_rig(&rig, one ? NULL : move, one ? move1 : NULL);
        struct vertex vertices[3] = {{.smooth = -31.5f, .screen = -31.5f},
                                     {.smooth = 32.5f, .screen = 32.5f},
                                     {.smooth = -31.5f, .screen = -31.5f}};
        rig_place(&rig, 0, 0, 0.5f, 1, vertices[0].position);
        rig_place(&rig, SIZE, 0, 0.5f, 1, vertices[1].position);
        rig_place(&rig, 0, SIZE, 0.5f, 1, vertices[2].position);
        for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
            const float *const pixel = draw(&rig, vertices, (const float[2]){offsets[i], 7})[2 * SIZE + 31];
            assert_true(pixel[0] == offsets[i] && pixel[1] == offsets[i]);
        }
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_limits),
    cmocka_unit_test(test_by_hand),
    cmocka_unit_test(test_against_the_formulas),
    cmocka_unit_test(test_from_samples),
};

const struct unit_tests test_interpolate_at = UNIT_TESTS(tests, NULL, NULL);
