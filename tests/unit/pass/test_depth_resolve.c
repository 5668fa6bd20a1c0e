// SPDX-License-Identifier: MIT
// Depth and stencil whose samples are kept and resolved besides, each by a mode of its own.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIDE = 70, EDGE = 10 }; // pixel EDGE has one of its two samples covered: those left of it both

static rhw_texture make(const struct rig *rig, enum rhw_format format, int samples)
{
    const struct rhw_texture_def def = {.format = format, .width = SIDE, .height = SIDE, .samples = samples};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static float depth_at(const struct rig *rig, rhw_texture texture, enum rhw_format format, int sample, int x)
{
    static uint32_t texels[SIDE * SIDE];
    const struct rhw_texture_region region = {.sample = sample};
    assert_int_equal(rhw_texture_read_region(rig->context, texture, &region, texels, 0, 0), RHW_OK);
    float value;
    memcpy(&value, &texels[x], sizeof value);
    return format == RHW_FORMAT_D24_UNORM_S8_UINT ? (float)texels[x] / 0xffffff : value;
}

static int stencil_at(const struct rig *rig, rhw_texture texture, int sample, int x)
{
    static uint8_t texels[SIDE * SIDE];
    const struct rhw_texture_region region = {.sample = sample, .aspect = RHW_ASPECT_STENCIL};
    assert_int_equal(rhw_texture_read_region(rig->context, texture, &region, texels, 0, 0), RHW_OK);
    return texels[x];
}

// Two samples of a pixel, at 0.75, 0.75 and 0.25, 0.25; the right part of the target is cleared alone.
static void open(struct rig *rig, enum rhw_format format, size_t bin_memory)
{
    rig_open_with(rig, SIDE, SIDE, &(struct rhw_context_def){.threads = 2, .bin_memory = bin_memory});
    rig->pass.samples = 2;
    rig->pass.depth = (struct rhw_depth_attachment){.enabled = true,
                                                    .texture = make(rig, format, 2),
                                                    .resolve = make(rig, format, 1),
                                                    .load = RHW_LOAD_CLEAR,
                                                    .clear = 1,
                                                    .stencil_clear = 7};
    rig->pipeline.depth_test = rig->pipeline.stencil_test = true;
    rig->pipeline.stencil_front.pass = rig->pipeline.stencil_back.pass = RHW_STENCIL_REPLACE;
}

// Again and again, so that little memory for bins makes several waves; only the first one passes the depth test.
static void draw(struct rig *rig)
{
    static const float one[4] = {1, 1, 1, 1};
    struct rig_vertex quad[6];
    rig_begin(rig);
    rhw_pass_set_stencil_reference(rig->context, rig->recording, 200, 200);
    for (int i = 0; i < 4; i++) {
        rig_rectangle(rig, 0, 0, EDGE + 0.5f, 10, 0, one, quad);
        rig_draw(rig, quad, 6);
        rig_rectangle(rig, 0, 20, 10, 30, 0, one, quad);
        rig_draw(rig, quad, 6);
    }
    rig_end(rig);
}

// Every pair of modes. Depth of pixel EDGE is 1 and 0, stencil 7 and 200; what is resolved into held 0.25 and 99.
static void test_modes(void **state)
{
    (void)state;
    static const float depths[] = {1, 0.5f, 0, 1, 1, 0.25f}; // by enum rhw_resolve
    static const int stencils[] = {7, 7, 7, 200, 7, 99};
    static const enum rhw_format formats[] = {RHW_FORMAT_D32_FLOAT_S8_UINT, RHW_FORMAT_D24_UNORM_S8_UINT};
    for (int i = 0; i < 6 * 6 * 4; i++) {
        const enum rhw_resolve mode = (enum rhw_resolve)(i % 6), stencil_mode = (enum rhw_resolve)(i / 6 % 6);
        const enum rhw_resolve taken = stencil_mode == RHW_RESOLVE_DEFAULT ? mode : stencil_mode;
        const enum rhw_format format = formats[i / 36 % 2];
        struct rig rig;
        open(&rig, format, (size_t)(i / 72));
        struct rhw_depth_attachment *const to = &rig.pass.depth;
        const struct rhw_clear_value before = {.depth = 0.25f, .stencil = 99};
        assert_int_equal(rhw_texture_clear(rig.context, to->resolve, NULL, &before), RHW_OK);
        to->resolve_mode = mode;
        to->stencil_resolve_mode = stencil_mode;
        draw(&rig);
        assert_true((rig.stats.flushes > 0) == (i >= 72));
        const bool keeps = mode == RHW_RESOLVE_NONE, keeps_stencil = taken == RHW_RESOLVE_NONE;
        for (int s = 0; s < 2; s++) {
            assert_true(depth_at(&rig, to->texture, format, s, EDGE) == (s == 0 ? 1.0f : 0.0f));
            assert_int_equal(stencil_at(&rig, to->texture, s, EDGE), s == 0 ? 7 : 200);
        }
        assert_true(fabsf(depth_at(&rig, to->resolve, format, 0, EDGE) - depths[mode]) < 1e-6f);
        assert_true(fabsf(depth_at(&rig, to->resolve, format, 0, 0) - (keeps ? 0.25f : 0)) < 1e-6f);
        assert_true(fabsf(depth_at(&rig, to->resolve, format, 0, SIDE - 1) - (keeps ? 0.25f : 1)) < 1e-6f);
        assert_int_equal(stencil_at(&rig, to->resolve, 0, EDGE), stencils[taken]);
        assert_int_equal(stencil_at(&rig, to->resolve, 0, 0), keeps_stencil ? 99 : 200);
        assert_int_equal(stencil_at(&rig, to->resolve, 0, SIDE - 1), keeps_stencil ? 99 : 7);
        rig_close(&rig);
    }
}

// What is resolved into may have one aspect, which is resolved alone.
static void test_one_aspect(void **state)
{
    (void)state;
    static const enum rhw_format formats[][2] = {{RHW_FORMAT_D32_FLOAT_S8_UINT, RHW_FORMAT_D32_FLOAT},
                                                 {RHW_FORMAT_D32_FLOAT_S8_UINT, RHW_FORMAT_S8_UINT},
                                                 {RHW_FORMAT_D24_UNORM_S8_UINT, RHW_FORMAT_D24_UNORM},
                                                 {RHW_FORMAT_D24_UNORM_S8_UINT, RHW_FORMAT_S8_UINT}};
    for (int i = 0; i < 4; i++) {
        struct rig rig;
        open(&rig, formats[i][0], 0);
        struct rhw_depth_attachment *const to = &rig.pass.depth;
        to->resolve = make(&rig, formats[i][1], 1);
        to->resolve_mode = RHW_RESOLVE_MAX;
        draw(&rig);
        if (i % 2 == 1) {
            assert_int_equal(stencil_at(&rig, to->resolve, 0, EDGE), 200);
            assert_int_equal(stencil_at(&rig, to->resolve, 0, SIDE - 1), 7);
        } else {
            assert_true(depth_at(&rig, to->resolve, formats[i][0], 0, EDGE) == 1);
            assert_true(depth_at(&rig, to->resolve, formats[i][0], 0, 0) == 0);
        }
        rig_close(&rig);
    }
}

// Samples that are forgotten, and those that are only read, are resolved nevertheless, with triangles and without.
static void test_what_is_not_stored(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct rig rig;
        struct rig_vertex quad[6];
        static const float one[4] = {1, 1, 1, 1};
        open(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, 0);
        struct rhw_depth_attachment *const to = &rig.pass.depth;
        draw(&rig);
        const struct rhw_clear_value before = {.depth = 0.25f, .stencil = 99};
        assert_int_equal(rhw_texture_clear(rig.context, to->resolve, NULL, &before), RHW_OK);
        const bool is_read_only = i & 1;
        to->load = to->stencil_load = RHW_LOAD_LOAD;
        to->resolve_mode = RHW_RESOLVE_MAX;
        to->read_only = to->stencil_read_only = is_read_only;
        to->store = to->stencil_store = is_read_only ? RHW_STORE_STORE : RHW_STORE_DISCARD;
        rig.pipeline.depth_read_only = true;
        rig.pipeline.stencil_test = false;
        rig_rectangle(&rig, 0, 0, 5, 5, 0, one, quad);
        rig_begin(&rig);
        if (i & 2) {
            rig_draw(&rig, quad, 6);
        }
        rig_end(&rig);
        assert_true(depth_at(&rig, to->resolve, RHW_FORMAT_D32_FLOAT, 0, EDGE) == 1);
        assert_true(depth_at(&rig, to->resolve, RHW_FORMAT_D32_FLOAT, 0, 0) == 0);
        assert_int_equal(stencil_at(&rig, to->resolve, 0, EDGE), 200);
        assert_int_equal(stencil_at(&rig, to->resolve, 0, SIDE - 1), 7);
        rig_close(&rig);
    }
}

// What is resolved into is written by the pass, also where the samples are only read: it cannot be sampled meanwhile.
static void test_sampled(void **state)
{
    (void)state;
    struct rig rig;
    open(&rig, RHW_FORMAT_D32_FLOAT, 0);
    struct rhw_depth_attachment *const to = &rig.pass.depth;
    to->stencil_clear = 0;
    rig.pipeline.stencil_test = false;
    draw(&rig);
    const struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &def, &sampler), RHW_OK);
    to->load = RHW_LOAD_LOAD;
    to->read_only = true;
    for (int resolves = 0; resolves < 2; resolves++) {
        to->resolve_mode = resolves ? RHW_RESOLVE_DEFAULT : RHW_RESOLVE_NONE;
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 0, to->resolve, sampler);
        if (resolves) {
            rig_expect_misuse(&rig, "is an attachment of this pass");
        }
        assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL),
                         resolves ? RHW_ERROR_MISUSE : RHW_OK);
    }
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    open(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, 0);
    const struct rhw_pass_def good = rig.pass;
    rig.pass.depth.resolve_mode = (enum rhw_resolve)6;
    rig_expect_refused_pass(&rig, "depth.resolve_mode is 6; not a resolve mode");
    rig.pass = good;
    rig.pass.depth.stencil_resolve_mode = (enum rhw_resolve) - 1;
    rig_expect_refused_pass(&rig, "depth.stencil_resolve_mode is -1; not a resolve mode");
    rig.pass = good;
    rig.pass.depth.stencil_resolve_mode = RHW_RESOLVE_NONE;
    rig.pass.depth.resolve = (rhw_texture){0};
    rig_expect_refused_pass(
        &rig, "depth.stencil_resolve_mode is RHW_RESOLVE_NONE; that is for a depth attachment with "
              "resolve set");
    rig.pass = good;
    rig.pass.colors[0].resolve_mode = RHW_RESOLVE_NONE;
    rig_expect_refused_pass(&rig, "colors[0].resolve_mode is RHW_RESOLVE_NONE");
    rig.pass = good;
    rig.pass.depth.resolve = make(&rig, RHW_FORMAT_D24_UNORM, 1);
    rig_expect_refused_pass(
        &rig,
        "which is RHW_FORMAT_D24_UNORM with 1 samples; it must be RHW_FORMAT_D32_FLOAT_S8_UINT with one");
    rig.pass = good;
    rig.pass.depth.resolve = make(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, 2);
    rig_expect_refused_pass(&rig, "with 2 samples; it must be RHW_FORMAT_D32_FLOAT_S8_UINT with one");
    rig.pass = good;
    rig.pass.depth.resolve = rig.pass.depth.texture;
    rig_expect_refused_pass(&rig, "as another attachment is");
    rig.pass = good;
    rig.pass.depth.texture = make(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, 1);
    rig_expect_refused_pass(&rig,
                            "depth.resolve is set and depth.texture has one sample; it must be null then");
    rig.pass = good;
    rig.pass.depth.texture = (rhw_texture){0};
    rig.pass.depth.format = RHW_FORMAT_D32_FLOAT_S8_UINT;
    rig.pass.depth.store = rig.pass.depth.stencil_store = RHW_STORE_DISCARD;
    rig_expect_refused_pass(&rig, "depth.resolve is set and depth.texture is null; it must be null then");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_modes), cmocka_unit_test(test_one_aspect),
                                          cmocka_unit_test(test_what_is_not_stored),
                                          cmocka_unit_test(test_sampled), cmocka_unit_test(test_misuse)};

const struct unit_tests test_depth_resolve = UNIT_TESTS(tests, NULL, NULL);
