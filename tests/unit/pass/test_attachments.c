// SPDX-License-Identifier: MIT
// Attachments and textures: load and store operations, clears, empty passes, sizes at the limits, texture
// write and read with pitches and levels, and drawing into a texture that is sampled afterwards.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float white[4] = {1, 1, 1, 1};

static rhw_texture create(struct rig *rig, enum rhw_format format, int width, int height, int levels)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = levels;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void test_a_pass_without_draws_clears(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 131, 67);
    rig_set_depth(&rig);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA8_UNORM);
    rig.pass.depth.clear = 0.625f;
    memcpy(rig.pass.colors[0].clear, (const float[4]){1.5f, -2, 0.1f, 7}, 16);
    memcpy(rig.pass.colors[1].clear, (const float[4]){1, 0, 0.2f, 0.8f}, 16);
    rig_begin(&rig);
    rig_end(&rig);
    assert_int_equal(rig.stats.draws, 0);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 131 * 67; i++) {
        assert_memory_equal(pixels[i], rig.pass.colors[0].clear, 16);
    }
    const unsigned char *bytes = rig_read(&rig, rig.pass.colors[1].texture);
    for (int i = 0; i < 131 * 67; i++) {
        assert_memory_equal(bytes + 4 * i, ((const unsigned char[4]){255, 0, 51, 204}), 4);
    }
    const float *depth = rig_read_depth(&rig);
    for (int i = 0; i < 131 * 67; i++) {
        assert_true(depth[i] == 0.625f);
    }
    rig_close(&rig);
}

static void test_textures_are_zeroed_when_created(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 50, 40);
    for (int format = RHW_FORMAT_R8_UNORM; format < RHW_FORMAT_COUNT; format++) {
        const rhw_texture texture = create(&rig, (enum rhw_format)format, 50, 40, 1);
        const unsigned char *bytes = rig_read(&rig, texture);
        const enum rhw_format decoded = rhw_format_decoded((enum rhw_format)format);
        for (size_t i = 0; i < 50 * 40 * rhw_format_size(decoded); i++) {
            assert_int_equal(bytes[i], 0);
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void test_load_keeps_what_was_there(void **state)
{
    (void)state;
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_RGBA8_SRGB,
                                       RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_R32_FLOAT,
                                       RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_R32_UINT};
    struct rig rig;
    rig_open(&rig, 75, 130);
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        rig_set_target(&rig, 0, formats[f]);
        const size_t texel = rhw_format_size(formats[f]), size = 75 * 130 * texel;
        unsigned char *before = malloc(size);
        uint64_t random = 30 + f;
        for (size_t i = 0; i < size; i++) {
            before[i] = (unsigned char)rig_random(&random);
        }
        rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, before, 0);
        rig.pass.colors[0].load = RHW_LOAD_LOAD;
        struct rig_vertex square[6];
        rig_rectangle(&rig, 20, 30, 40, 70, 0.5f, white, square);
        rig_draw_once(&rig, square, 6);
        const unsigned char *after = rig_read(&rig, rig.pass.colors[0].texture);
        for (size_t i = 0; i < 75 * 130; i++) {
            const size_t x = i % 75, y = i / 75;
            const bool drawn = x >= 20 && x < 40 && y >= 30 && y < 70;
            const unsigned char *seen = after + i * texel;
            assert_true(memcmp(seen, drawn ? after + (30 * 75 + 20) * texel : before + i * texel, texel) ==
                        0);
        }
        free(before);
    }
    rig_close(&rig);
}

static void test_what_is_not_stored_does_not_touch_memory(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 70, 70);
    rig_set_depth(&rig);
    float(*before)[4] = malloc(70 * 70 * sizeof *before);
    for (int i = 0; i < 70 * 70 * 4; i++) {
        before[i / 4][i % 4] = (float)i;
    }
    rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, before, 0);
    rig.pass.colors[0].store = RHW_STORE_DISCARD;
    rig.pass.depth.load = RHW_LOAD_DISCARD;
    rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    struct rig_vertex all[6];
    rig_cover(&rig, 0.25f, white, all);
    rig_draw_once(&rig, all, 6);
    // Unspecified by the contract, but a tiled renderer that wrote here would have wasted the bandwidth.
    assert_memory_equal(rig_read_float4(&rig), before, 70 * 70 * sizeof *before);
    const float *depth = rig_read_depth(&rig);
    for (int i = 0; i < 70 * 70; i++) {
        assert_true(depth[i] == 0.25f);
    }
    free(before);
    rig_close(&rig);
}

static void test_pass_size_may_be_given(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 40, 30);
    rig.pass.width = 40;
    rig.pass.height = 30;
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, white, all);
    rig_draw_once(&rig, all, 6);
    assert_int_equal(rig.stats.fragments_shaded, 1200);
    // Only transient depth: nothing else says how large the pass is.
    rig.pass.colors[0].texture = (rhw_texture){0};
    rig.pass.color_count = 0;
    rig.pipeline.target_count = 0;
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD, .clear = 1};
    rig.pipeline.depth_test = true;
    rig_draw_once(&rig, all, 6);
    assert_int_equal(rig.stats.triangles_rasterized, 2);
    rig_close(&rig);
}

static void test_tiles_at_every_size(void **state)
{
    (void)state;
    const int sizes[][2] = {{1, 1},   {1, 200}, {200, 1}, {7, 9},    {8, 8},
                            {63, 65}, {64, 64}, {65, 63}, {129, 200}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        struct rig rig;
        rig_open(&rig, sizes[s][0], sizes[s][1]);
        struct rig_vertex all[6];
        rig_cover(&rig, 0.5f, (const float[4]){1, 2, 3, 4}, all);
        rig_draw_once(&rig, all, 6);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < sizes[s][0] * sizes[s][1]; i++) {
            assert_memory_equal(pixels[i], ((const float[4]){1, 2, 3, 4}), 16);
        }
        assert_int_equal(rig.stats.fragments_shaded, sizes[s][0] * sizes[s][1]);
        rig_close(&rig);
    }
}

static const struct rig_vertex lower_left[3] = {
    {{-1, -1, 0, 1}, {1, 1, 1, 1}}, {{1, -1, 0, 1}, {1, 1, 1, 1}}, {{-1, 1, 0, 1}, {1, 1, 1, 1}}};

// Pixels of a row whose centre lies below the diagonal from the top left to the bottom right corner. A centre
// on the diagonal is not among them: the triangle lies to the left of that edge.
static int64_t covered_of_row(int64_t y, int64_t width, int64_t height)
{
    // (2x + 1)·height < (2y + 1)·width
    const int64_t bound = (2 * y + 1) * width;
    const int64_t count = (bound - 1 + height) / (2 * height);
    return count < width ? count : width;
}

// A diagonal edge from corner to corner must be exact everywhere.
static void check_large(int width, int height)
{
    struct rig rig;
    rig_open(&rig, width, height);
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
    rig_draw_once(&rig, lower_left, 3);
    const unsigned char(*texels)[4] = (rig_read(&rig, rig.pass.colors[0].texture), rig.pixels);
    int64_t total = 0;
    for (int64_t y = 0; y < height; y++) {
        const int64_t covered = covered_of_row(y, width, height);
        for (int64_t x = 0; x < width; x++) {
            if ((texels[y * width + x][0] == 255) != (x < covered)) {
                fail_msg("%dx%d: pixel %d,%d is wrong", width, height, (int)x, (int)y);
            }
        }
        total += covered;
    }
    assert_int_equal(rig.stats.fragments_shaded, total);
    rig_close(&rig);
}

static void count_only_fragment(struct rhw_fragment *groups, int count)
{
    (void)groups;
    (void)count;
}

static void test_the_largest_targets(void **state)
{
    (void)state;
    check_large(RHW_MAX_TARGET_SIZE, 16);
    check_large(16, RHW_MAX_TARGET_SIZE);
    check_large(RHW_MAX_TARGET_SIZE, 1);
    check_large(1, RHW_MAX_TARGET_SIZE);
    // The largest of all without the gigabyte: no colours, and a depth that stays in the tiles.
    struct rig rig;
    rig_open(&rig, 1, 1);
    rig.pass = rhw_pass_def_default();
    rig.pass.color_count = rig.pipeline.target_count = 0;
    rig.pass.width = rig.pass.height = RHW_MAX_TARGET_SIZE;
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD, .clear = 1};
    rig.pipeline.depth_test = true;
    rig_set_program(&rig, rig_vertex_pass, count_only_fragment);
    rig.pipeline.program.uses = RHW_USE_EFFECTS; // no target takes its colours
    rig_draw_once(&rig, lower_left, 3);
    int64_t total = 0;
    for (int64_t y = 0; y < RHW_MAX_TARGET_SIZE; y++) {
        total += covered_of_row(y, RHW_MAX_TARGET_SIZE, RHW_MAX_TARGET_SIZE);
    }
    assert_int_equal(rig.stats.fragments_shaded, total);
    assert_int_equal(rig.stats.tiles, 256 * 256);
    rig_close(&rig);
}

static void test_write_and_read_with_pitch_and_levels(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 1, 1);
    const rhw_texture texture = create(&rig, RHW_FORMAT_RGBA8_UNORM, 13, 6, RHW_MIP_LEVELS_ALL);
    assert_int_equal(rhw_texture_mip_levels(rig.context, texture), 4);
    assert_int_equal(rhw_texture_format(rig.context, texture), RHW_FORMAT_RGBA8_UNORM);
    const int sizes[4][2] = {{13, 6}, {6, 3}, {3, 1}, {1, 1}};
    uint64_t random = 31;
    for (int level = 0; level < 4; level++) {
        const int w = sizes[level][0], h = sizes[level][1];
        assert_int_equal(rhw_texture_width(rig.context, texture, level), w);
        assert_int_equal(rhw_texture_height(rig.context, texture, level), h);
        unsigned char in[13 * 4 * 6 + 600], out[13 * 4 * 6 + 600];
        for (size_t i = 0; i < sizeof in; i++) {
            in[i] = (unsigned char)rig_random(&random);
        }
        for (size_t extra = 0; extra <= 60; extra += 20) {
            const size_t pitch = (size_t)w * 4 + extra;
            rhw_texture_write(rig.context, texture, level, in, pitch);
            memset(out, 0xa5, sizeof out);
            rhw_texture_read(rig.context, texture, level, out, 0);
            for (int y = 0; y < h; y++) {
                assert_memory_equal(out + y * w * 4, in + (size_t)y * pitch, (size_t)w * 4);
            }
            assert_int_equal(out[w * h * 4], 0xa5);
            memset(out, 0xa5, sizeof out);
            rhw_texture_read(rig.context, texture, level, out, pitch);
            for (int y = 0; y < h; y++) {
                assert_memory_equal(out + (size_t)y * pitch, in + (size_t)y * pitch, (size_t)w * 4);
                for (size_t i = 0; i < extra; i++) {
                    assert_int_equal(out[(size_t)y * pitch + (size_t)w * 4 + i], 0xa5);
                }
            }
        }
    }
    rhw_texture_destroy(rig.context, texture);
    rig_close(&rig);
}

static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float uv[2] = {groups[g].varying[0], groups[g].varying[1]};
        rhw_sample_lod(groups[g].bindings, 0, uv, rhw_splat(0), groups[g].color[0]);
    }
}

// Draws a picture into a texture, then that texture onto a target of the same size: the same bytes.
static void test_render_to_texture_then_sample(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 96, 80);
    uint64_t random = 32;
    struct rig_vertex mess[60];
    for (int i = 0; i < 60; i++) {
        rig_place(&rig, rig_random_float(&random, -20, 110), rig_random_float(&random, -20, 100), 0.5f,
                  rig_random_float(&random, 1, 3), mess[i].position);
        for (int c = 0; c < 4; c++) {
            mess[i].value[c] = rig_random_float(&random, 0, 1);
        }
    }
    rig_draw_once(&rig, mess, 60);
    const rhw_texture picture = rig.pass.colors[0].texture;
    static float first[96 * 80][4];
    memcpy(first, rig_read_float4(&rig), sizeof first);
    rig.pass.colors[0].texture = create(&rig, RHW_FORMAT_RGBA32_FLOAT, 96, 80, 1);
    struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    sampler_def.min_filter = sampler_def.mag_filter = RHW_FILTER_NEAREST;
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, white, all);
    for (int i = 0; i < 6; i++) {
        all[i].value[0] = (all[i].position[0] + 1) * 0.5f;
        all[i].value[1] = (1 - all[i].position[1]) * 0.5f;
    }
    rig_set_program(&rig, rig_vertex_pass, sample_fragment);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, picture, sampler);
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig), first, sizeof first);
    // And back again, the other way round: the roles of the two textures are not fixed.
    const rhw_texture copy = rig.pass.colors[0].texture;
    rig.pass.colors[0].texture = picture;
    rig.pass.colors[0].clear[0] = 9;
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, copy, sampler);
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig), first, sizeof first);
    rig_close(&rig);
}

// Level 0 is what is drawn into; the chain made from it afterwards is its mean.
static void test_mips_of_a_rendered_texture(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    rig.pass.colors[0].texture = create(&rig, RHW_FORMAT_RGBA32_FLOAT, 64, 64, RHW_MIP_LEVELS_ALL);
    struct rig_vertex half[6];
    rig_rectangle(&rig, 0, 0, 64, 32, 0.5f, (const float[4]){1, 2, 4, 8}, half);
    rig_draw_once(&rig, half, 6);
    rhw_texture_generate_mips(rig.context, rig.pass.colors[0].texture);
    float texel[4];
    rhw_texture_read(rig.context, rig.pass.colors[0].texture, 6, texel, 0);
    assert_memory_equal(texel, ((const float[4]){0.5f, 1, 2, 4}), sizeof texel);
    rig_close(&rig);
}

static void test_uploads_between_passes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, white, all);
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = sizeof all;
    rhw_buffer buffer; // zeroed: six times the same point
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    for (int n = 0; n < 3; n++) {
        if (n == 1) {
            rhw_buffer_write(rig.context, buffer, 0, all, sizeof all);
        }
        if (n == 2) {
            const float value[4] = {5, 6, 7, 8};
            for (size_t i = 0; i < 6; i++) {
                rhw_buffer_write(rig.context, buffer, i * sizeof *all + 16, value, sizeof value);
            }
        }
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
        rig_end(&rig);
        const float *seen = rig_read_float4(&rig)[40];
        assert_true(seen[0] == (n == 2 ? 5.0f : (float)n) && seen[3] == (n == 2 ? 8.0f : (float)n));
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_pass_without_draws_clears),
    cmocka_unit_test(test_textures_are_zeroed_when_created),
    cmocka_unit_test(test_load_keeps_what_was_there),
    cmocka_unit_test(test_what_is_not_stored_does_not_touch_memory),
    cmocka_unit_test(test_pass_size_may_be_given),
    cmocka_unit_test(test_tiles_at_every_size),
    cmocka_unit_test(test_the_largest_targets),
    cmocka_unit_test(test_write_and_read_with_pitch_and_levels),
    cmocka_unit_test(test_render_to_texture_then_sample),
    cmocka_unit_test(test_mips_of_a_rendered_texture),
    cmocka_unit_test(test_uploads_between_passes),
};

const struct unit_tests test_attachments = UNIT_TESTS(tests, NULL, NULL);
