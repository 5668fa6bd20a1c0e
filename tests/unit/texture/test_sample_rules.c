// SPDX-License-Identifier: MIT
// Rules of multisampled passes off the beaten way: tiles that a wave draws nothing in, stencil by facing after the
// fragment function, what equal samples resolve to, what is counted and refused; what fragments are told of samples
// where there is one, and what masks it.
#include "harness.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 136, PIXELS = SIZE * SIZE, TILE = 64 }; // three tiles each way, the last ones cut

static const float red[4] = {1, 0, 0, 1}, green[4] = {0, 1, 0, 1};

static void draw_rectangle(struct rig *rig, float x0, float y0, float x1, float y1, const float color[4])
{
    struct rig_vertex vertices[6];
    rig_rectangle(rig, x0, y0, x1, y1, 0.5f, color, vertices);
    rig_draw(rig, vertices, 6);
}

// What was resolved is loaded also into tiles where the first wave draws nothing, and a later one does.
static void test_loading_in_waves(void **state)
{
    (void)state;
    static struct rig_vertex vertices[6000];
    for (int waves = 0; waves < 2; waves++) {
        struct rig rig;
        rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 1, .bin_memory = waves ? 1 : 0});
        rig.pass.samples = 4;
        rig_begin(&rig);
        draw_rectangle(&rig, 0, 0, SIZE, SIZE, red);
        rig_end(&rig);
        rig.pass.colors[0].load = RHW_LOAD_LOAD;
        rig_begin(&rig);
        for (int i = 0; i < 6000; i += 6) {
            rig_rectangle(&rig, 1, 1, 9, 9, 0.5f, green, vertices + i);
        }
        for (int i = 0; i < 9; i++) {
            rig_draw(&rig, vertices, 6000);
        }
        draw_rectangle(&rig, 100, 100, 110, 110, green);
        rig_end(&rig);
        assert_true((rig.stats.flushes > 0) == (waves != 0));
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int p = 0; p < PIXELS; p++) {
            const int x = p % SIZE, y = p / SIZE;
            const bool is_green =
                (x >= 1 && x < 9 && y >= 1 && y < 9) || (x >= 100 && x < 110 && y >= 100 && y < 110);
            assert_memory_equal(pixels[p], is_green ? green : red, sizeof red);
        }
        rig_close(&rig);
    }
}

// Stencil after the fragment function goes by facing: triangles that face away take the rule of the back.
static void test_late_stencil_by_facing(void **state)
{
    (void)state;
    for (int by_alpha = 0; by_alpha < 2; by_alpha++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig.pass.samples = 4;
        rig.pass.depth = (struct rhw_depth_attachment){
            .enabled = true, .format = RHW_FORMAT_S8_UINT, .stencil_store = RHW_STORE_DISCARD};
        rig.pipeline.stencil_test = true;
        rig.pipeline.stencil_back.pass = RHW_STENCIL_INVERT;
        rig.pipeline.alpha_to_coverage = by_alpha;
        rig.pipeline.program.uses = by_alpha ? 0 : RHW_USE_SAMPLE_MASK;
        rig_begin(&rig);
        draw_rectangle(&rig, 0, 0, 40, SIZE, red); // faces the viewer
        struct rig_vertex away[6];
        rig_rectangle(&rig, 60, 0, 100, SIZE, 0.5f, red, away);
        for (int i = 0; i < 6; i += 3) {
            const struct rig_vertex first = away[i];
            away[i] = away[i + 1];
            away[i + 1] = first;
        }
        rig_draw(&rig, away, 6);
        rig.pipeline.alpha_to_coverage = false;
        rig.pipeline.program.uses = 0;
        rig.pipeline.stencil_back = (struct rhw_stencil_face){.compares = false};
        rig.pipeline.stencil_front =
            (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_NOT_EQUAL};
        draw_rectangle(&rig, 0, 0, SIZE, SIZE, green);
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        assert_true(pixels[20][0] == 1 && pixels[20][1] == 0);
        assert_true(pixels[80][0] == 0 && pixels[80][1] == 1);
        assert_true(pixels[120][0] == 0 && pixels[120][1] == 0);
        rig_close(&rig);
    }
}

static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        f->color[0][0] = rhw_float_from_int(f->sample_id);
        f->color[0][1] = f->sample_position[0];
        f->color[0][2] = f->sample_position[1];
        f->color[0][3] = rhw_float_from_int(f->sample_mask);
        f->sample_mask = rhw_splat_int(*(const int32_t *)f->user);
    }
}

// Full rows, parts of blocks and small triangles, and what the function leaves in sample_mask: bit 0 is that of the
// sample.
static void test_one_sample(void **state)
{
    (void)state;
    static const int32_t left[] = {1, -1, 0, 2};
    for (int i = 0; i < 2 * 4; i++) {
        const int general = i % 2;
        const float seen[4] = {0, 0.5f, 0.5f, 1}, none[4] = {0};
        const float *const expected = left[i / 2] & 1 ? seen : none;
        struct rig rig;
        rig_open_with(
            &rig, SIZE, SIZE,
            &(struct rhw_context_def){.threads = 1, .paths = general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL});
        rig_set_program(&rig, rig_vertex_pass, sample_fragment);
        rig.pipeline.program.uses = RHW_USE_SAMPLE | RHW_USE_SAMPLE_MASK;
        rig.pipeline.program.user = (void *)(uintptr_t)&left[i / 2];
        rig_begin(&rig);
        draw_rectangle(&rig, 0, 0, 100, 100, red);
        for (int n = 0; n < 30; n++) {
            draw_rectangle(&rig, (float)(4 * n), 110, (float)(4 * n + n % 3 + 1), 113, red);
        }
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int n = 0; n < 100 * 100; n++) {
            assert_memory_equal(pixels[n / 100 * SIZE + n % 100], expected, sizeof seen);
        }
        for (int n = 0; n < 30; n++) {
            assert_memory_equal(pixels[111 * SIZE + 4 * n + n % 3], expected, sizeof seen);
        }
        rig_close(&rig);
    }
}

static void one_color_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const float *const color = groups[g].user;
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(color[c]);
        }
    }
}

// How alpha, the pipeline's mask and alpha to one meet a pass of one sample (Vulkan 1.3 §28.9 makes no exception of
// it): round(alpha · 1) samples are kept. What is not neither moves depth nor is counted.
static void test_alpha_of_one_sample(void **state)
{
    (void)state;
    static const float alphas[] = {0, 0.25f, 0.4990234375f, 0.5f, 0.75f, 1, 2, -1, NAN};
    enum { ALPHAS = sizeof alphas / sizeof alphas[0] };
    for (int i = 0; i < ALPHAS * 32; i++) {
        const float alpha = alphas[i / 32];
        const bool by_alpha = i & 1, to_one = i & 2, constant = i & 4, general = i & 8, counted = i & 16;
        const float color[4] = {0.25f, 0.5f, 0.75f, alpha};
        const bool kept = !by_alpha || alpha >= 0.5f;
        struct rig rig;
        rig_open_with(
            &rig, SIZE, SIZE,
            &(struct rhw_context_def){.threads = 1, .paths = general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL});
        rig_set_program(&rig, rig_vertex_pass, constant ? one_color_fragment : rig_fragment_pass);
        if (constant) {
            rig.pipeline.program.varying_count = 0;
            rig.pipeline.program.varyings[0] = (struct rhw_varying){0};
            rig.pipeline.program.user = (void *)(uintptr_t)color;
        }
        rig_set_depth(&rig);
        rig.pipeline.depth_test = true;
        rig.pipeline.depth_compare = RHW_COMPARE_LESS;
        rig.pipeline.alpha_to_coverage = by_alpha;
        rig.pipeline.alpha_to_one = to_one;
        rhw_query query;
        assert_int_equal(
            rhw_query_create(rig.context, &(struct rhw_query_def){.kind = RHW_QUERY_OCCLUSION}, &query),
            RHW_OK);
        rig_begin(&rig);
        if (counted) { // in order then
            rhw_pass_begin_query(rig.context, rig.recording, query);
        }
        draw_rectangle(&rig, 0, 0, 80, 80, color);
        draw_rectangle(&rig, 101, 90, 103, 91, color);
        if (counted) {
            rhw_pass_end_query(rig.context, rig.recording, query);
        }
        rig_end(&rig);
        if (counted) {
            struct rhw_query_counts counts;
            assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
            assert_int_equal(counts.samples_passed, kept ? 80 * 80 + 2 : 0);
        }
        // What the rig read last stands until it reads again.
        static const int at[] = {0, 79 * SIZE + 79, 41 * SIZE + 37, 90 * SIZE + 102};
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int n = 0; n < 4; n++) {
            const float written = to_one ? 1 : alpha;
            assert_true(pixels[at[n]][0] == (kept ? 0.25f : 0));
            assert_true(pixels[at[n]][3] == (kept ? written : 0) || (kept && isnan(written)));
        }
        const float *const depth = rig_read_depth(&rig);
        for (int n = 0; n < 4; n++) {
            assert_true(depth[at[n]] == (kept ? 0.5f : 1.0f));
        }
        rhw_query_destroy(rig.context, query);
        rig_close(&rig);
    }
}

// Bit 0 of the pipeline's mask is that of the sample. Vertices are shaded for what it keeps out, too.
static void test_mask_of_one_sample(void **state)
{
    (void)state;
    static const uint32_t masks[] = {0, 1, 2, 3, 0x10000, 0xffffffff};
    for (int i = 0; i < 6; i++) {
        const bool drawn = masks[i] == 0 || masks[i] & 1;
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig.pipeline.sample_mask = masks[i];
        rig_begin(&rig);
        draw_rectangle(&rig, 3, 3, 90, 90, red);
        rig.pipeline.topology = RHW_POINT_LIST;
        struct rig_vertex point = {.value = {0, 1, 0, 1}};
        rig_place(&rig, 100.5f, 100.5f, 0.5f, 1, point.position);
        rig_draw(&rig, &point, 1);
        rig_end(&rig);
        assert_int_equal(rig.stats.fragments_shaded, drawn ? 87 * 87 + 1 : 0);
        assert_true(rig.stats.vertices_shaded >= 4);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        assert_true(pixels[50 * SIZE + 50][0] == (drawn ? 1 : 0));
        assert_true(pixels[100 * SIZE + 100][1] == (drawn ? 1 : 0));
        rig_close(&rig);
    }
}

// Alpha decides about coverage also where no target has it (Vulkan 1.3 §28.9: output 0).
static void test_alpha_without_target(void **state)
{
    (void)state;
    for (int samples = 1; samples <= 4; samples *= 4) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        const rhw_texture color = rig.pass.colors[0].texture;
        rig.pass.colors[0].texture = (rhw_texture){0};
        rig.pass.color_count = rig.pipeline.target_count = 0;
        rig_set_depth(&rig);
        rig.pass.samples = samples;
        rig.pass.depth.resolve_mode = RHW_RESOLVE_MIN;
        rig.pipeline.depth_test = true;
        rig.pipeline.depth_compare = RHW_COMPARE_LESS;
        rig.pipeline.alpha_to_coverage = true;
        rig_begin(&rig);
        draw_rectangle(&rig, 0, 0, 40, 40, (const float[4]){1, 1, 1, 0.1f});
        draw_rectangle(&rig, 50, 0, 90, 40, (const float[4]){0, 0, 0, 0.6f});
        rig_end(&rig);
        assert_true(rig_read_depth(&rig)[20 * SIZE + 20] == 1);
        assert_true(rig_read_depth(&rig)[20 * SIZE + 70] == 0.5f);
        rhw_texture_destroy(rig.context, color);
        rig_close(&rig);
    }
}

// Where samples agree they resolve to themselves, also in blocks that keep them apart: the mean of 16 times 0.1 would
// round to another float, and a NaN that was loaded keeps its bits.
static void test_equal_samples_resolve_to_themselves(void **state)
{
    (void)state;
    const enum rhw_resolve modes[] = {RHW_RESOLVE_AVERAGE, RHW_RESOLVE_MIN, RHW_RESOLVE_MAX};
    static uint32_t texels[PIXELS][4];
    for (int i = 0; i < PIXELS; i++) {
        memcpy(texels[i], (const uint32_t[]){0x7fc12345u, 0x80000000u, 0x3dcccccdu, 0xffc00001u},
               sizeof texels[i]);
    }
    for (int m = 0; m < 3; m++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig_set_depth(&rig);
        rig.pass.samples = 16;
        rig.pass.colors[0].load = RHW_LOAD_LOAD;
        rig.pass.colors[0].resolve_mode = rig.pass.depth.resolve_mode = modes[m];
        rig.pass.depth.clear = 0.1f;
        assert_int_equal(rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, texels, 0), RHW_OK);
        rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
        rig.pipeline.depth_read_only = true;
        rig_begin(&rig);
        draw_rectangle(&rig, 8.5f, 8.5f, 40.5f, 9.5f, red); // expands its blocks
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < PIXELS; i++) {
            const int x = i % SIZE, y = i / SIZE;
            if ((x < 8 || x > 40 || y < 8 || y > 9) && memcmp(pixels[i], texels[i], sizeof texels[i]) != 0) {
                uint32_t bits[4];
                memcpy(bits, pixels[i], sizeof bits);
                fail_msg("mode %d: pixel %d,%d is %x %x %x %x", m, x, y, bits[0], bits[1], bits[2], bits[3]);
            }
        }
        assert_true(rig_read_depth(&rig)[0] == 0.1f);
        rig_close(&rig);
    }
}

// Shaded sample by sample, each sample counts; else a fragment does once.
static void test_fragments_are_counted(void **state)
{
    (void)state;
    for (int by_sample = 0; by_sample < 2; by_sample++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig.pass.samples = 4;
        rig.pipeline.program.varyings[0].sampling = by_sample ? RHW_SAMPLING_SAMPLE : RHW_SAMPLING_CENTER;
        rig_begin(&rig);
        struct rig_vertex over[3];
        const float corners[3][2] = {{-10, -10}, {3 * SIZE, -10}, {-10, 3 * SIZE}};
        for (int i = 0; i < 3; i++) {
            rig_place(&rig, corners[i][0], corners[i][1], 0.5f, 1, over[i].position);
            memcpy(over[i].value, red, sizeof red);
        }
        rig_draw(&rig, over, 3);
        rig_end(&rig);
        assert_int_equal(rig.stats.fragments_shaded, by_sample ? 4 * PIXELS : PIXELS);
        rig_close(&rig);
    }
}

static void discarding_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= rhw_less(0.3f, groups[g].color[0][3]);
    }
}

// What is tested after the fragment function.
enum late { LATE_NOTHING, LATE_DEPTH, LATE_STENCIL, LATE_ALPHA, LATE_COUNT };

// Triangles of a few pixels and of many in one draw, above each other: the last is seen, or all are blended in order.
static uint64_t hash_of_crowd(int samples, bool blends, enum rhw_compare compare, enum late late,
                              enum rhw_paths paths)
{
    static struct rig_vertex vertices[6000];
    struct rig rig;
    uint64_t random = 5, hash = 0;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 1, .paths = paths});
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = SIZE, .height = SIZE, .samples = samples};
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    assert_int_equal(rhw_texture_create(rig.context, &def, &rig.pass.colors[0].texture), RHW_OK);
    rig.pass.samples = samples;
    rig.pass.depth =
        (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD, .clear = 0.9f};
    rig.pipeline.depth_test = true;
    rig.pipeline.depth_compare = compare;
    rig.pipeline.alpha_to_coverage = late == LATE_ALPHA;
    if (late == LATE_DEPTH || late == LATE_STENCIL) {
        rig.pipeline.program.uses = RHW_USE_DISCARD;
        rig_set_program(&rig, rig_vertex_pass, discarding_fragment);
    }
    if (late == LATE_STENCIL) {
        rig.pass.depth.format = RHW_FORMAT_D32_FLOAT_S8_UINT;
        rig.pass.depth.stencil_store = RHW_STORE_DISCARD;
        rig.pipeline.stencil_test = true;
        rig.pipeline.stencil_front = (struct rhw_stencil_face){.compares = true,
                                                               .compare = RHW_COMPARE_EQUAL,
                                                               .pass = RHW_STENCIL_INCREMENT_WRAP,
                                                               .read_mask = 1};
        rig.pipeline.stencil_back = (struct rhw_stencil_face){.pass = RHW_STENCIL_DECREMENT_WRAP};
    }
    rig.pipeline.targets[0].blend = blends;
    rig.pipeline.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    for (int v = 0; v < 6000; v += 3) {
        const float size = v % 100 < 90 ? 2.5f : 90;
        const float x = rig_random_float(&random, 0, SIZE), y = rig_random_float(&random, 0, SIZE);
        const float z = (float)rig_random_int(&random, 8) / 9, slope = v % 2 ? 0.1f : 0; // many are equal
        for (int i = 0; i < 3; i++) {
            rig_place(&rig, x + rig_random_float(&random, 0, size), y + rig_random_float(&random, 0, size),
                      z + rig_random_float(&random, 0, slope), 1, vertices[v + i].position);
            for (int c = 0; c < 4; c++) {
                vertices[v + i].value[c] = rig_random_float(&random, 0, 1);
            }
        }
    }
    rig_draw_once(&rig, vertices, 6000);
    for (int s = 0; s < samples; s++) {
        static float pixels[PIXELS][4];
        const rhw_texture texture = rig.pass.colors[0].texture;
        assert_int_equal(rhw_texture_read_sample(rig.context, texture, s, pixels, 0), RHW_OK);
        hash = rig_hash_bytes(hash, pixels, sizeof pixels);
    }
    rig_close(&rig);
    return hash;
}

static void test_order(void **state)
{
    (void)state;
    const enum rhw_compare compares[] = {RHW_COMPARE_ALWAYS, RHW_COMPARE_LESS, RHW_COMPARE_GREATER_EQUAL};
    for (int i = 0; i < 5 * 3 * 2 * LATE_COUNT; i++) {
        const int samples = 1 << i % 5;
        const enum rhw_compare compare = compares[i / 5 % 3];
        const bool blends = i / 15 % 2;
        const enum late late = (enum late)(i / 30);
        assert_true(hash_of_crowd(samples, blends, compare, late, RHW_PATHS_ALL) ==
                    hash_of_crowd(samples, blends, compare, late, RHW_PATHS_GENERAL));
    }
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rhw_pipeline_def def = rig.pipeline;
    rhw_pipeline pipeline;
    def = rig.pipeline;
    def.alpha_to_coverage = true;
    memset(def.program.fragment, 0, sizeof def.program.fragment);
    def.targets[0].write_mask = RHW_WRITE_NONE;
    assert_int_equal(rhw_pipeline_create(rig.context, &def, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "alpha_to_coverage is true and the program has no fragment function");

    struct rhw_texture_def texture_def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = SIZE, .height = SIZE, .samples = 4};
    rhw_texture samples, blocks;
    static float pixels[PIXELS][4];
    assert_int_equal(rhw_texture_create(rig.context, &texture_def, &samples), RHW_OK);
    const int wrong[] = {-1, INT32_MIN, 4};
    for (int i = 0; i < 3; i++) {
        char part[64];
        snprintf(part, sizeof part, "sample is %d; ", i == 1 ? -1 : wrong[i]);
        assert_int_equal(rhw_texture_read_sample(rig.context, samples, wrong[i], pixels, 0),
                         RHW_ERROR_MISUSE);
        assert_non_null(strstr(rig.message, "has samples 0..3"));
        rig_expect_misuse(&rig, part);
    }
    texture_def.format = RHW_FORMAT_BC7_UNORM;
    texture_def.samples = 1;
    assert_int_equal(rhw_texture_create(rig.context, &texture_def, &blocks), RHW_OK);
    rig.pass.samples = 4;
    const rhw_texture one = rig.pass.colors[0].texture;
    rig.pass.colors[0].texture = samples;
    rig.pass.colors[0].resolve = blocks;
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig,
                      "which is RHW_FORMAT_BC7_UNORM with 1 samples; it must be RHW_FORMAT_RGBA32_FLOAT");
    rig.pass.colors[0].texture = one;
    rig.pass.colors[0].resolve = (rhw_texture){0};
    rhw_texture_destroy(rig.context, samples);
    rhw_texture_destroy(rig.context, blocks);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_loading_in_waves),
    cmocka_unit_test(test_late_stencil_by_facing),
    cmocka_unit_test(test_one_sample),
    cmocka_unit_test(test_alpha_of_one_sample),
    cmocka_unit_test(test_mask_of_one_sample),
    cmocka_unit_test(test_alpha_without_target),
    cmocka_unit_test(test_equal_samples_resolve_to_themselves),
    cmocka_unit_test(test_fragments_are_counted),
    cmocka_unit_test(test_order),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_sample_rules = UNIT_TESTS(tests, NULL, NULL);
