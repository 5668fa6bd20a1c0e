// SPDX-License-Identifier: MIT
// State that changes between the draws of one pass: uniforms, pipelines, textures, blend constant, viewport,
// scissor; each draw sees what was set when it was recorded. And many draws, and draws in order.
#include "context/context.h"
#include "draw/recorded_pass.h"
#include "harness.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 64 };

struct uniforms {
    float rect[4]; // x0, y0, x1, y1 in pixels
    float color[4];
};

// Two triangles from six vertices without any buffer, placed by the uniforms.
static void uniform_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct uniforms *u = groups[g].uniforms;
        const rhw_int i = groups[g].vertex_index % 6;
        const rhw_int right = (i == 1) | (i == 4) | (i == 5), top = (i == 2) | (i == 3) | (i == 5);
        const rhw_float x = rhw_select(right, rhw_splat(u->rect[2]), rhw_splat(u->rect[0]));
        const rhw_float y = rhw_select(top, rhw_splat(u->rect[1]), rhw_splat(u->rect[3]));
        groups[g].position[0] = x * (2.0f / SIZE) - 1.0f;
        groups[g].position[1] = 1.0f - y * (2.0f / SIZE);
        groups[g].position[2] = rhw_splat(0);
        groups[g].position[3] = rhw_splat(1);
    }
}

static void uniform_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct uniforms *u = groups[g].uniforms;
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(u->color[c]);
        }
    }
}

static void doubling_fragment(struct rhw_fragment *groups, int count)
{
    uniform_fragment(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] *= 2.0f;
    }
}

static void texture_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float uv[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        rhw_sample_lod(groups[g].bindings, 3, uv, rhw_splat(0), groups[g].color[0]);
    }
}

static void open_rig(struct rig *rig)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, uniform_vertex, uniform_fragment);
    rig->pipeline.program.uniform_size = sizeof(struct uniforms);
    rig->pipeline.program.varyings[0] = (struct rhw_varying){0};
    rig->pipeline.program.varying_count = 0;
    rig->pipeline.attributes[0] = (struct rhw_attribute){0};
    rig->pipeline.attribute_count = rig->pipeline.buffer_count = 0;
}

static void set_uniforms(struct rig *rig, float x0, float y0, float x1, float y1, float red)
{
    const struct uniforms uniforms = {{x0, y0, x1, y1}, {red, 1, 2, 3}};
    rhw_pass_set_uniforms(rig->context, rig->recording, &uniforms, sizeof uniforms);
}

static void test_uniforms_change_between_draws(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    struct uniforms uniforms;
    for (int i = 0; i < 1024; i++) {
        // The caller's copy is overwritten at once; the draw must have its own.
        const float x = (float)(i % 32 * 2), y = (float)(i / 32 * 2);
        uniforms = (struct uniforms){{x, y, x + 2, y + 2}, {(float)(i + 1), 1, 2, 3}};
        rhw_pass_set_uniforms(rig.context, rig.recording, &uniforms, sizeof uniforms);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
        memset(&uniforms, 0xff, sizeof uniforms);
    }
    rig_end(&rig);
    assert_int_equal(rig.stats.draws, 1024);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            assert_true(pixels[y * SIZE + x][0] == (float)(y / 2 * 32 + x / 2 + 1));
            assert_true(pixels[y * SIZE + x][3] == 3);
        }
    }
    rig_close(&rig);
}

static void test_uniforms_of_the_largest_size(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    static unsigned char block[RHW_MAX_UNIFORM_SIZE];
    const struct uniforms uniforms = {{0, 0, SIZE, SIZE}, {7, 1, 2, 3}};
    memcpy(block, &uniforms, sizeof uniforms);
    rig.pipeline.program.uniform_size = sizeof block;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_uniforms(rig.context, rig.recording, block, sizeof block);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[100][0] == 7);
    rig_close(&rig);
}

static void test_pipelines_and_uniforms_persist_and_change(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    set_uniforms(&rig, 0, 0, 32, 32, 5);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_set_program(&rig, uniform_vertex, doubling_fragment);
    rig_use_pipeline(&rig); // the uniforms stay
    rhw_pass_set_scissor(rig.context, rig.recording, &(struct rhw_rect){0, 0, 16, 16});
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rhw_pass_set_scissor(rig.context, rig.recording, &(struct rhw_rect){0, 0, SIZE, SIZE});
    rhw_pass_set_viewport(rig.context, rig.recording, &(struct rhw_viewport){32, 32, 32, 32, 0, 1});
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1); // a quarter of the lower right quarter
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const bool low = x >= 32 && x < 48 && y >= 32 && y < 48;
            const float expected = low || (x < 16 && y < 16) ? 10.0f : x < 32 && y < 32 ? 5.0f : 0.0f;
            assert_true(pixels[y * SIZE + x][0] == expected);
        }
    }
    rig_close(&rig);
}

static rhw_texture plain_texture(struct rig *rig, float red)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA32_FLOAT;
    def.width = def.height = 1;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    const float texel[4] = {red, 0.25f, 0.5f, 0.75f};
    rhw_texture_write(rig->context, texture, 0, texel, 0);
    return texture;
}

static void test_textures_change_between_draws(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig_set_program(&rig, uniform_vertex, texture_fragment);
    const rhw_texture textures[2] = {plain_texture(&rig, 11), plain_texture(&rig, 12)};
    const struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    for (int i = 0; i < 4; i++) {
        set_uniforms(&rig, (float)(i * 16), 0, (float)(i * 16 + 16), 16, 1);
        if (i == 3) {
            rhw_pass_set_texture(rig.context, rig.recording, 3, (rhw_texture){0}, (rhw_sampler){0});
        } else {
            rhw_pass_set_texture(rig.context, rig.recording, 3, textures[i % 2], sampler);
        }
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    }
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int x = 0; x < 64; x++) {
        // The last quarter samples an unbound slot: 0, 0, 0, 1.
        const int i = x / 16;
        assert_true(pixels[x][0] == (i == 3 ? 0.0f : i == 1 ? 12.0f : 11.0f));
        assert_true(pixels[x][1] == (i == 3 ? 0.0f : 0.25f));
        assert_true(pixels[x][3] == (i == 3 ? 1.0f : 0.75f));
    }
    rhw_texture_destroy(rig.context, textures[0]);
    rhw_texture_destroy(rig.context, textures[1]);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

// Sample slot 1, which has a texture, and slot 9, behind which no slot has one.
static void empty_slot_fragment(struct rhw_fragment *groups, int count)
{
    static const uint32_t slots = 1u << 1 | 1u << 9;
    rhw_float texels[RHW_MAX_GROUPS][10][4];
    rhw_sample_groups(groups, count, slots, 0, texels[0], 10);
    for (int g = 0; g < count; g++) {
        const struct rhw_bindings *const bindings = groups[g].bindings;
        const rhw_int at[2] = {rhw_splat_int(0), rhw_splat_int(0)};
        rhw_float fetched[4];
        rhw_sample_fetch(bindings, 9, at, NULL, fetched);
        groups[g].color[0][0] = texels[g][1][0];
        groups[g].color[0][1] = texels[g][9][0] + fetched[0];
        groups[g].color[0][2] = texels[g][9][3] + fetched[3];
        groups[g].color[0][3] =
            rhw_splat((float)(rhw_sample_levels(bindings, 1) + 10 * rhw_sample_levels(bindings, 9)));
    }
}

static void test_slots_behind_the_last_texture_are_empty(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig_set_program(&rig, uniform_vertex, empty_slot_fragment);
    rig.pipeline.program.varyings[0] = (struct rhw_varying){.components = 2, .derivatives = true};
    rig.pipeline.program.varying_count = 1;
    const rhw_texture texture = plain_texture(&rig, 11);
    const struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 1, texture, sampler);
    set_uniforms(&rig, 0, 0, SIZE, SIZE, 1);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][0] == 11 && pixels[i][1] == 0 && pixels[i][2] == 2 && pixels[i][3] == 1);
    }
    rhw_texture_destroy(rig.context, texture);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

// A changed texture costs a draw what its slots hold, and no other copy of what is set.
static void test_a_changed_texture_takes_little_memory(void **state)
{
    (void)state;
    enum { DRAWS = 1000, BYTES = 256 };
    struct rig rig;
    open_rig(&rig);
    rig_set_program(&rig, uniform_vertex, texture_fragment);
    rig.pipeline.program.uniform_size = 0;
    const rhw_texture textures[2] = {plain_texture(&rig, 11), plain_texture(&rig, 12)};
    const struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    size_t before = 0;
    for (int i = 0; i <= DRAWS; i++) {
        rhw_pass_set_texture(rig.context, rig.recording, 0, textures[i % 2], sampler);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
        before = i == 0 ? rhw_arena_used(&rig.context->pass->arena) : before;
    }
    assert_true(rhw_arena_used(&rig.context->pass->arena) - before < DRAWS * BYTES);
    rhw_pass_cancel(rig.context, rig.recording);
    rhw_texture_destroy(rig.context, textures[0]);
    rhw_texture_destroy(rig.context, textures[1]);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static void test_blend_constant_changes_between_draws(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_CONSTANT, RHW_BLEND_ZERO, RHW_BLEND_ADD};
    rig.pipeline.targets[0].alpha = rig.pipeline.targets[0].color;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    for (int i = 0; i < 8; i++) {
        set_uniforms(&rig, (float)(i * 8), 0, (float)(i * 8 + 8), 8, 2);
        const float constant[4] = {(float)i, 10, 20, (float)(i * i)};
        rhw_pass_set_blend_constant(rig.context, rig.recording, constant);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    }
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int x = 0; x < 64; x++) {
        const float i = (float)(x / 8);
        assert_true(pixels[x][0] == 2 * i && pixels[x][1] == 10 && pixels[x][2] == 40 &&
                    pixels[x][3] == 3 * i * i);
    }
    rig_close(&rig);
}

// The picture of n overlapping layers depends on their order: c = c/2 + n. Every thread count must keep it.
static void test_order_is_kept_within_and_across_draws(void **state)
{
    (void)state;
    const int threads[] = {1, 2, 3, 8};
    for (int t = 0; t < 4; t++) {
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = threads[t];
        struct rig rig;
        rig_open_with(&rig, 256, 192, &def);
        rig.pipeline.targets[0].blend = true;
        rig.pipeline.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_CONSTANT, RHW_BLEND_ADD};
        rig.pipeline.targets[0].alpha = rig.pipeline.targets[0].color;
        static struct rig_vertex layers[6 * 40];
        float expected = 0;
        rig_begin(&rig);
        rhw_pass_set_blend_constant(rig.context, rig.recording, (const float[4]){0.5f, 0.5f, 0.5f, 0.5f});
        for (int draw = 0; draw < 10; draw++) {
            for (int i = 0; i < 40; i++) {
                const float value = (float)((draw * 40 + i) * 7 % 13);
                rig_cover(&rig, 0.5f, (const float[4]){value, value, value, value}, layers + 6 * i);
                expected = value + expected * 0.5f;
            }
            rig_draw(&rig, layers, 6 * 40);
        }
        rig_end(&rig);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < 256 * 192; i++) {
            assert_true(pixels[i][0] == expected);
        }
        rig_close(&rig);
    }
}

static void test_many_draws(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    set_uniforms(&rig, 8, 8, 10, 10, 1);
    for (int i = 0; i < 50000; i++) {
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    }
    rig_end(&rig);
    assert_int_equal(rig.stats.draws, 50000);
    assert_int_equal(rig.stats.triangles_in, 100000);
    assert_int_equal(rig.stats.fragments_shaded, 200000);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int y = 8; y < 10; y++) {
        for (int x = 8; x < 10; x++) {
            assert_true(pixels[y * SIZE + x][0] == 50000);
        }
    }
    rig_close(&rig);
}

static void test_one_draw_of_many_instances(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    set_uniforms(&rig, 0, 0, SIZE, SIZE, 1);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1000);
    rig_end(&rig);
    assert_int_equal(rig.stats.triangles_in, 2000);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][0] == 1000);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_uniforms_change_between_draws),
    cmocka_unit_test(test_uniforms_of_the_largest_size),
    cmocka_unit_test(test_pipelines_and_uniforms_persist_and_change),
    cmocka_unit_test(test_textures_change_between_draws),
    cmocka_unit_test(test_slots_behind_the_last_texture_are_empty),
    cmocka_unit_test(test_a_changed_texture_takes_little_memory),
    cmocka_unit_test(test_blend_constant_changes_between_draws),
    cmocka_unit_test(test_order_is_kept_within_and_across_draws),
    cmocka_unit_test(test_many_draws),
    cmocka_unit_test(test_one_draw_of_many_instances),
};

const struct unit_tests test_draw_state = UNIT_TESTS(tests, NULL, NULL);
