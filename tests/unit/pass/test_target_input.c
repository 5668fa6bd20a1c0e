// SPDX-License-Identifier: MIT
// Fragment functions that read their targets: what they find is what came before, in the order of primitives, by every
// path; so that adding in the function is what blending by ONE and ONE does.
#include "harness.h"

#include <string.h>

enum { SIDE = 90, TRIANGLES = 60 };

// Adds to what is there.
static void add(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] += groups[g].varying[c];
        }
    }
}

static void add1(struct rhw_fragment1 *f)
{
    for (int c = 0; c < 4; c++) {
        f->color[0][c] += f->varying[c];
    }
}

// Triangles of all sizes over each other, of whole numbers, so that sums are exact in any order and differ where one is
// missing.
static void make_triangles(const struct rig *rig, struct rig_vertex *vertices)
{
    uint64_t random = 4;
    for (int i = 0; i < TRIANGLES; i++) {
        const float size = i % 3 == 0 ? 200 : i % 3 == 1 ? 30 : 4;
        const float x = rig_random_float(&random, -10, SIDE + 10),
                    y = rig_random_float(&random, -10, SIDE + 10);
        for (int k = 0; k < 3; k++) {
            struct rig_vertex *const v = &vertices[3 * i + k];
            rig_place(rig, x + rig_random_float(&random, -size, size),
                      y + rig_random_float(&random, -size, size), rig_random_float(&random, 0, 1), 1,
                      v->position);
            v->value[0] = (float)(i + 1);
            v->value[1] = (float)(i * i);
            v->value[2] = 1;
            v->value[3] = 0.5f;
        }
    }
}

enum how { HOW_BLEND, HOW_INPUT, HOW_INPUT1 };

static void draw_sums(const struct rhw_context_def *def, int samples, bool depth, enum how how,
                      float pixels[SIDE * SIDE * 4][4], struct rhw_stats *stats)
{
    struct rig rig;
    struct rig_vertex vertices[3 * TRIANGLES];
    rig_open_with(&rig, SIDE, SIDE, def);
    if (depth) {
        rig_set_depth(&rig);
        rig.pass.depth.texture = (rhw_texture){0};
        rig.pass.depth.store = RHW_STORE_DISCARD;
        rig.pipeline.depth_compare = RHW_COMPARE_LESS_EQUAL;
    }
    const struct rhw_texture_def kept_def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = SIDE, .height = SIDE, .samples = samples};
    rhw_texture kept;
    rhw_texture_create(rig.context, &kept_def, &kept);
    const rhw_texture resolved = rig.pass.colors[0].texture;
    rig.pass.colors[0].texture = kept;
    rig.pipeline.targets[0].blend = how == HOW_BLEND;
    if (how == HOW_BLEND) {
        rig.pipeline.targets[0].color = rig.pipeline.targets[0].alpha =
            (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    }
    if (how != HOW_BLEND) {
        rig_set_program(&rig, rig_vertex_pass, add);
        rig.pipeline.program.uses = RHW_USE_COLOR_INPUT;
    } else {
        rig.pipeline.program.uses = samples > 1 ? RHW_USE_SAMPLE : 0;
    }
    if (how == HOW_INPUT1) {
        memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
        rig.pipeline.program.fragment1 = add1;
    }
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    make_triangles(&rig, vertices);
    rig_begin(&rig);
    rig_draw(&rig, vertices, 3 * TRIANGLES / 2);
    rig_draw(&rig, vertices + 3 * TRIANGLES / 2, 3 * TRIANGLES / 2);
    rig_end(&rig);
    for (int s = 0; s < samples; s++) {
        rhw_texture_read_sample(rig.context, kept, s, pixels[s * SIDE * SIDE], 0);
    }
    *stats = rig.stats;
    rig.pass.colors[0].texture = resolved;
    rhw_texture_destroy(rig.context, kept);
    rig_close(&rig);
}

static void sums(void **state)
{
    (void)state;
    static float expected[SIDE * SIDE * 4][4], found[SIDE * SIDE * 4][4];
    static const struct rhw_context_def defs[] = {
        {.threads = 1},
        {.threads = 3, .paths = RHW_PATHS_IN_ORDER},
        {.threads = 3, .paths = RHW_PATHS_GENERAL},
        {.threads = 3, .isa_limit = RHW_ISA_UP_TO_BASELINE},
        {.threads = 3, .isa_limit = RHW_ISA_UP_TO_AVX512},
        {.threads = 3, .validate = RHW_VALIDATE_ON},
        {.threads = 3, .bin_memory = 1},
    };
    struct rhw_stats by_blending, by_input;
    for (int bits = 0; bits < 4; bits++) {
        const int samples = bits & 1 ? 4 : 1;
        const size_t size = (size_t)samples * SIDE * SIDE * sizeof expected[0];
        draw_sums(&defs[0], samples, bits & 2, HOW_BLEND, expected, &by_blending);
        for (size_t i = 0; i < sizeof defs / sizeof defs[0]; i++) {
            for (int how = HOW_INPUT; how <= HOW_INPUT1; how++) {
                draw_sums(&defs[i], samples, bits & 2, (enum how)how, found, &by_input);
                assert_memory_equal(found, expected, size);
                assert_int_equal(by_input.fragments_shaded, by_blending.fragments_shaded);
            }
        }
    }
}

// One step of 8 bits more.
static void step(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] += 1.0f / 255;
        }
    }
}

static void formats(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open(&rig, SIDE, SIDE);
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
    rig_set_program(&rig, rig_vertex_pass, step);
    rig.pipeline.program.uses = RHW_USE_COLOR_INPUT;
    rig_begin(&rig);
    for (int i = 0; i < 40; i++) {
        rig_rectangle(&rig, (float)i, 0, SIDE, (float)(SIDE - i), 0.5f, (const float[4]){0}, vertices);
        rig_draw(&rig, vertices, 6);
    }
    rig_end(&rig);
    const unsigned char(*const pixels)[4] =
        (const unsigned char(*)[4])rig_read(&rig, rig.pass.colors[0].texture);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE + 1, up = SIDE - i / SIDE, least = x < up ? x : up;
        assert_int_equal(pixels[i][2], least < 40 ? least : 40);
    }
    rig_close(&rig);
}

// Depth ------------------------------------------------------------------------------------------------

static void show_depth(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].depth_input;
        }
    }
}

static void show_depth1(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->color[0][1] = f->color[0][2] = f->color[0][3] = f->depth_input;
}

// What is seen after each of four rectangles: the second lies before the first, the fourth before all, and the third behind,
// so that what the second left stays. Early tests have written a fragment's own depth when its function reads.
static void check_depth(bool one, bool early, const struct rhw_context_def *def)
{
    static const float depths[] = {0.5f, 0.25f, 0.75f, 0.125f};
    static const float expected[2][4] = {{1, 0.5f, 0.5f, 0.25f}, {0.5f, 0.25f, 0.25f, 0.125f}};
    for (int last = 0; last < 4; last++) {
        struct rig rig;
        struct rig_vertex vertices[6];
        rig_open_with(&rig, SIDE, SIDE, def);
        rig_set_depth(&rig);
        rig_set_program(&rig, rig_vertex_pass, show_depth);
        if (one) {
            memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
            rig.pipeline.program.fragment1 = show_depth1;
        }
        rig.pipeline.program.uses = RHW_USE_DEPTH_INPUT;
        rig.pipeline.program.early_fragment_tests = early;
        rig_begin(&rig);
        for (int i = 0; i <= last; i++) {
            rig_cover(&rig, depths[i], (const float[4]){0}, vertices);
            rig_draw(&rig, vertices, 6);
        }
        rig_end(&rig);
        const float(*const seen)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_true(seen[i][0] == expected[early][last]);
        }
        assert_true(rig_read_depth(&rig)[SIDE] == (last == 2 ? depths[1] : depths[last]));
        rig_close(&rig);
    }
}

static void depth(void **state)
{
    (void)state;
    for (int bits = 0; bits < 4; bits++) {
        check_depth(bits & 1, bits & 2, &(struct rhw_context_def){.threads = 2});
        check_depth(bits & 1, bits & 2, &(struct rhw_context_def){.paths = RHW_PATHS_GENERAL});
        check_depth(bits & 1, bits & 2, &(struct rhw_context_def){.validate = RHW_VALIDATE_ON});
    }
}

// Stencil ----------------------------------------------------------------------------------------------

static void show_stencil(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_float_from_int(groups[g].stencil_input);
        }
    }
}

static void show_stencil1(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->color[0][1] = f->color[0][2] = f->color[0][3] = (float)f->stencil_input;
}

// Three times two rectangles that count themselves in stencil from 250 on, up to 255: the left one covers two columns
// more each time. Early tests have counted a fragment itself when its function reads.
static void check_stencil(bool one, bool early, int samples, const struct rhw_context_def *def)
{
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open_with(&rig, SIDE, SIDE, def);
    rig_set_program(&rig, rig_vertex_pass, show_stencil);
    if (one) {
        memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
        rig.pipeline.program.fragment1 = show_stencil1;
    }
    rig.pass.samples = samples;
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true,
                                                   .format = RHW_FORMAT_S8_UINT,
                                                   .stencil_clear = 250,
                                                   .stencil_store = RHW_STORE_DISCARD};
    rig.pipeline.stencil_test = true;
    rig.pipeline.stencil_front.pass = rig.pipeline.stencil_back.pass = RHW_STENCIL_INCREMENT_CLAMP;
    rig.pipeline.program.uses = RHW_USE_STENCIL_INPUT;
    rig.pipeline.program.early_fragment_tests = early;
    rig_begin(&rig);
    for (int i = 0; i < 6; i++) {
        const float to = i % 2 == 0 ? (float)(3 + i) : SIDE;
        rig_rectangle(&rig, 0, 0, to, SIDE, 0.5f, (const float[4]){0}, vertices);
        rig_draw(&rig, vertices, 6);
    }
    rig_end(&rig);
    const float(*const seen)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE, before = 2 + (x < 3) + (x < 5) + (x < 7);
        const int expected = 250 + before + early;
        assert_true(seen[i][0] == (float)(expected > 255 ? 255 : expected));
    }
    rig_close(&rig);
}

static void stencil(void **state)
{
    (void)state;
    for (int bits = 0; bits < 8; bits++) {
        const int samples = bits & 4 ? 4 : 1;
        check_stencil(bits & 1, bits & 2, samples, &(struct rhw_context_def){.threads = 2});
        check_stencil(bits & 1, bits & 2, samples, &(struct rhw_context_def){.paths = RHW_PATHS_GENERAL});
        check_stencil(bits & 1, bits & 2, samples, &(struct rhw_context_def){.validate = RHW_VALIDATE_ON});
    }
}

static void misuse(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    const struct rhw_context_def def = {.validate = RHW_VALIDATE_ON};
    rig_open_with(&rig, SIDE, SIDE, &def);
    rig_set_program(&rig, rig_vertex_pass, show_depth);
    rig.pipeline.program.uses = RHW_USE_DEPTH_INPUT;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "reads depth_input; the pass has no depth attachment");
    rhw_pass_cancel(rig.context, rig.recording);
    rig.pipeline.program.uses = 0;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rig_draw(&rig, vertices, 6);
    rhw_pass_end(rig.context, rig.recording, NULL);
    rig_expect_misuse(&rig, "reads depth_input; RHW_USE_DEPTH_INPUT is missing in its program's uses");
    rig.pipeline.program.uses = RHW_USE_STENCIL_INPUT;
    rig_set_depth(&rig);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "reads stencil_input; the pass has no stencil attachment");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_set_program(&rig, rig_vertex_pass, show_stencil);
    rig.pipeline.program.uses = 0;
    rig_begin(&rig);
    rig_draw(&rig, vertices, 6);
    rhw_pass_end(rig.context, rig.recording, NULL);
    rig_expect_misuse(&rig, "reads stencil_input; RHW_USE_STENCIL_INPUT is missing in its program's uses");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(sums), cmocka_unit_test(formats),
                                          cmocka_unit_test(depth), cmocka_unit_test(stencil),
                                          cmocka_unit_test(misuse)};

const struct unit_tests test_target_input = UNIT_TESTS(tests, NULL, NULL);
