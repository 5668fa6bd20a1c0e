// SPDX-License-Identifier: MIT
// A programmer's errors: each goes to the assert hook, once, with a message that names the function; the call
// then does nothing, and the context works on. Stale and null ids first, then every definition and argument.
#include "harness.h"

#include <math.h>
#include <string.h>

static const float white[4] = {1, 1, 1, 1};

static rhw_buffer make_buffer(struct rig *rig)
{
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = 64;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

static rhw_texture make_texture(struct rig *rig, enum rhw_format format, int size)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = def.height = size;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static rhw_sampler make_sampler(struct rig *rig)
{
    const struct rhw_sampler_def def = rhw_sampler_def_default();
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &def, &sampler), RHW_OK);
    return sampler;
}

static rhw_pipeline make_pipeline(struct rig *rig)
{
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig->context, &rig->pipeline, &pipeline), RHW_OK);
    return pipeline;
}

// After everything: the context still draws.
static void expect_alive(struct rig *rig)
{
    struct rig_vertex all[6];
    rig_cover(rig, 0.5f, white, all);
    rig_draw_once(rig, all, 6);
    assert_true(rig_read_float4(rig)[0][0] == 1);
}

static void use_buffer(struct rig *rig, rhw_buffer buffer)
{
    rhw_buffer_write(rig->context, buffer, 0, white, sizeof white);
    rig_expect_misuse(rig, "rhw_buffer_write");
    rig_begin(rig);
    rhw_pass_set_vertex_buffer(rig->context, rig->recording, 0, buffer, 0);
    rig_expect_misuse(rig, "rhw_pass_set_vertex_buffer");
    rhw_pass_set_index_buffer(rig->context, rig->recording, buffer, RHW_INDEX_UINT16, 0);
    rig_expect_misuse(rig, "rhw_pass_set_index_buffer");
    rig_end(rig);
    if (buffer.index != 0) {
        rhw_buffer_destroy(rig->context, buffer);
        rig_expect_misuse(rig, "rhw_buffer_destroy");
    }
}

static void use_texture(struct rig *rig, rhw_texture texture)
{
    float texel[4] = {7, 7, 7, 7};
    assert_int_equal(rhw_texture_width(rig->context, texture, 0), 0);
    rig_expect_misuse(rig, "rhw_texture_width");
    assert_int_equal(rhw_texture_height(rig->context, texture, 0), 0);
    rig_expect_misuse(rig, "rhw_texture_height");
    assert_int_equal(rhw_texture_mip_levels(rig->context, texture), 0);
    rig_expect_misuse(rig, "rhw_texture_mip_levels");
    assert_int_equal(rhw_texture_format(rig->context, texture), RHW_FORMAT_NONE);
    rig_expect_misuse(rig, "rhw_texture_format");
    rhw_texture_write(rig->context, texture, 0, texel, 0);
    rig_expect_misuse(rig, "rhw_texture_write");
    rhw_texture_read(rig->context, texture, 0, texel, 0);
    rig_expect_misuse(rig, "rhw_texture_read");
    assert_true(texel[0] == 7);
    rhw_texture_generate_mips(rig->context, texture);
    rig_expect_misuse(rig, "rhw_texture_generate_mips");
    struct rhw_pass_def def = rig->pass;
    def.colors[0].texture = texture;
    rhw_pass pass = {9, 9, 9};
    assert_int_equal(rhw_pass_begin(rig->context, &def, &pass), RHW_ERROR_MISUSE);
    assert_int_equal(pass.index, 0);
    rig_expect_misuse(rig, "rhw_pass_begin");
    if (texture.index != 0) {
        rhw_texture_destroy(rig->context, texture);
        rig_expect_misuse(rig, "rhw_texture_destroy");
    }
}

static void test_destroyed_and_null_ids(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const rhw_buffer buffer = make_buffer(&rig);
    const rhw_texture texture = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8);
    const rhw_sampler sampler = make_sampler(&rig);
    const rhw_pipeline pipeline = make_pipeline(&rig);
    rhw_buffer_destroy(rig.context, buffer);
    rhw_texture_destroy(rig.context, texture);
    rhw_sampler_destroy(rig.context, sampler);
    rhw_pipeline_destroy(rig.context, pipeline);
    // Others may live in their places now; the old ids must still be caught.
    make_buffer(&rig);
    const rhw_texture live = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8);
    make_sampler(&rig);
    make_pipeline(&rig);
    use_buffer(&rig, buffer);
    use_buffer(&rig, (rhw_buffer){0});
    use_buffer(&rig, (rhw_buffer){12345, 1, buffer.context});
    use_buffer(&rig, (rhw_buffer){UINT32_MAX, UINT32_MAX, UINT32_MAX});
    use_texture(&rig, texture);
    use_texture(&rig, (rhw_texture){0});
    use_texture(&rig, (rhw_texture){UINT32_MAX, 1, texture.context});
    const rhw_pipeline pipelines[] = {pipeline, {0}, {1000, 1, pipeline.context}};
    const rhw_sampler samplers[] = {sampler, {0}, {1000, 1, sampler.context}};
    for (int i = 0; i < 3; i++) {
        rig_begin(&rig);
        rhw_pass_set_pipeline(rig.context, rig.recording, pipelines[i]);
        rig_expect_misuse(&rig, "rhw_pass_set_pipeline");
        rhw_pass_set_texture(rig.context, rig.recording, 0, live, samplers[i]);
        rig_expect_misuse(&rig, "rhw_pass_set_texture");
        rig_end(&rig);
        if (pipelines[i].index == 0) {
            continue;
        }
        rhw_pipeline_destroy(rig.context, pipelines[i]);
        rig_expect_misuse(&rig, "rhw_pipeline_destroy");
        rhw_sampler_destroy(rig.context, samplers[i]);
        rig_expect_misuse(&rig, "rhw_sampler_destroy");
    }
    expect_alive(&rig);
    rig_close(&rig);
}

static void test_an_ended_pass_is_stale(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_begin(&rig);
    const rhw_pass ended = rig.recording;
    rig_end(&rig);
    rig_begin(&rig); // another one records now
    const rhw_pass ids[] = {ended, {0}, {77, 77, ended.context}};
    const rhw_buffer buffer = make_buffer(&rig);
    const rhw_pipeline pipeline = make_pipeline(&rig);
    for (int i = 0; i < 3; i++) {
        rhw_context *context = rig.context;
        rhw_pass_set_pipeline(context, ids[i], pipeline);
        rig_expect_misuse(&rig, "rhw_pass_set_pipeline");
        rhw_pass_set_vertex_buffer(context, ids[i], 0, buffer, 0);
        rig_expect_misuse(&rig, "rhw_pass_set_vertex_buffer");
        rhw_pass_set_index_buffer(context, ids[i], buffer, RHW_INDEX_UINT8, 0);
        rig_expect_misuse(&rig, "rhw_pass_set_index_buffer");
        rhw_pass_set_uniforms(context, ids[i], white, sizeof white);
        rig_expect_misuse(&rig, "rhw_pass_set_uniforms");
        rhw_pass_set_texture(context, ids[i], 0, (rhw_texture){0}, (rhw_sampler){0});
        rig_expect_misuse(&rig, "rhw_pass_set_texture");
        rhw_pass_set_viewport(context, ids[i], &(struct rhw_viewport){0, 0, 8, 8, 0, 1});
        rig_expect_misuse(&rig, "rhw_pass_set_viewport");
        rhw_pass_set_scissor(context, ids[i], &(struct rhw_rect){0, 0, 8, 8});
        rig_expect_misuse(&rig, "rhw_pass_set_scissor");
        rhw_pass_set_blend_constant(context, ids[i], white);
        rig_expect_misuse(&rig, "rhw_pass_set_blend_constant");
        rhw_pass_draw(context, ids[i], 0, 3, 0, 1);
        rig_expect_misuse(&rig, "rhw_pass_draw");
        rhw_pass_draw_indexed(context, ids[i], 0, 3, 0, 0, 1);
        rig_expect_misuse(&rig, "rhw_pass_draw_indexed");
        assert_int_equal(rhw_pass_end(context, ids[i], NULL), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, "rhw_pass_end");
    }
    struct rhw_pass_def def = rig.pass;
    rhw_pass second;
    assert_int_equal(rhw_pass_begin(rig.context, &def, &second), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_begin");
    rig_end(&rig);
    expect_alive(&rig);
    rig_close(&rig);
}

// A definition that is wrong in one field.
static void reject_texture(struct rig *rig, enum rhw_format format, int width, int height, int levels)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = levels;
    rhw_texture texture = {5, 5, 5};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_ERROR_MISUSE);
    assert_int_equal(texture.index, 0);
    rig_expect_misuse(rig, "rhw_texture_create");
}

static void test_texture_and_buffer_definitions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    reject_texture(&rig, RHW_FORMAT_NONE, 8, 8, 1);
    reject_texture(&rig, RHW_FORMAT_COUNT, 8, 8, 1);
    reject_texture(&rig, (enum rhw_format)1000, 8, 8, 1);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 0, 8, 1);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8, 0, 1);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, -1, 8, 1);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, RHW_MAX_TARGET_SIZE + 1, 8, 1);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8, INT32_MAX, 1);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8, 8, -2);
    reject_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8, 8, 5);
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = 0;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_buffer_create");
    buffer = make_buffer(&rig);
    const size_t ranges[][2] = {{0, 65}, {64, 1}, {65, 0}, {SIZE_MAX, 2}, {1, SIZE_MAX}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        static const char data[128];
        rhw_buffer_write(rig.context, buffer, ranges[i][0], data, ranges[i][1]);
        rig_expect_misuse(&rig, "rhw_buffer_write");
    }
    const rhw_texture texture = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8);
    unsigned char texels[256] = {0};
    rhw_texture_write(rig.context, texture, 1, texels, 0);
    rig_expect_misuse(&rig, "rhw_texture_write");
    rhw_texture_read(rig.context, texture, -1, texels, 0);
    rig_expect_misuse(&rig, "rhw_texture_read");
    rhw_texture_write(rig.context, texture, 0, texels, 31);
    rig_expect_misuse(&rig, "rhw_texture_write");
    rhw_texture_write(rig.context, texture, 0, NULL, 0);
    rig_expect_misuse(&rig, "rhw_texture_write");
    assert_int_equal(rhw_texture_width(rig.context, texture, 4), 0);
    rig_expect_misuse(&rig, "rhw_texture_width");
    const rhw_texture integers = make_texture(&rig, RHW_FORMAT_R32_UINT, 8);
    rhw_texture_generate_mips(rig.context, integers);
    rig_expect_misuse(&rig, "rhw_texture_generate_mips");
    rig_close(&rig);
}

static void test_sampler_definitions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    for (int wrong = 0; wrong < 9; wrong++) {
        struct rhw_sampler_def def = rhw_sampler_def_default();
        switch (wrong) {
        case 0: def.min_filter = (enum rhw_filter)2; break;
        case 1: def.mag_filter = (enum rhw_filter)99; break;
        case 2: def.mip_filter = (enum rhw_mip_filter)3; break;
        case 3: def.address_u = (enum rhw_address)5; break;
        case 4: def.address_v = (enum rhw_address)77; break;
        case 5: def.lod_bias = NAN; break;
        case 6: def.lod_min = INFINITY; break;
        case 7: def.lod_max = NAN; break;
        default: def.lod_min = 3, def.lod_max = 2;
        }
        rhw_sampler sampler;
        assert_int_equal(rhw_sampler_create(rig.context, &def, &sampler), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, "rhw_sampler_create");
    }
    rig_close(&rig);
}

static void test_pipeline_definitions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const struct rhw_pipeline_def good = rig.pipeline;
    for (int wrong = 0; wrong < 32; wrong++) {
        struct rhw_pipeline_def def = good;
        switch (wrong) {
        case 0: def.program.vertex[0] = NULL; break;
        case 1: def.program.varying_count = RHW_MAX_VARYINGS + 1; break;
        case 2: def.program.varying_count = -1; break;
        case 3: def.program.varyings[0].components = 0; break;
        case 4: def.program.varyings[0].components = 5; break;
        case 5: def.program.varyings[0].qualifier = (enum rhw_qualifier)3; break;
        case 6:
            def.program.varying_count = 17;
            for (int i = 0; i < 17; i++) {
                def.program.varyings[i].components = 4;
            }
            break;
        case 7: def.program.uses = 1u << 20; break;
        case 8: def.program.uniform_size = RHW_MAX_UNIFORM_SIZE + 1; break;
        case 9: def.attribute_count = RHW_MAX_ATTRIBUTES + 1; break;
        case 10: def.attribute_count = -1; break;
        case 11: def.attributes[1].format = RHW_VERTEX_FORMAT_COUNT; break;
        case 12: def.attributes[1].buffer = 1; break;
        case 13: def.attributes[1].buffer = -1; break;
        case 14: def.buffers[0].instance_step = 1; break; // and not per_instance
        case 15: def.buffer_count = RHW_MAX_VERTEX_BUFFERS + 1; break;
        case 16: def.buffer_count = -1; break;
        case 17: def.topology = (enum rhw_topology)(RHW_LINE_LOOP + 1); break;
        case 18: def.provoking = (enum rhw_provoking)2; break;
        case 19: def.cull = (enum rhw_cull)4; break;
        case 20: def.front = (enum rhw_winding)2; break;
        case 21: def.depth_range = (enum rhw_depth_range)2; break;
        case 22: def.depth_compare = (enum rhw_compare)8; break;
        case 23: def.target_count = RHW_MAX_COLOR_ATTACHMENTS + 1; break;
        case 24: def.target_count = -1; break;
        case 25: def.targets[0].format = RHW_FORMAT_NONE; break;
        case 26: def.targets[0].format = RHW_FORMAT_D32_FLOAT; break;
        case 27: def.targets[0].color.src = (enum rhw_blend_factor)20; break;
        case 28: def.targets[0].alpha.operation = (enum rhw_blend_operation)5; break;
        case 29: def.targets[0].write_mask = RHW_WRITE_NONE | RHW_WRITE_RED; break;
        case 30:
            def.targets[0].format = RHW_FORMAT_R32_UINT;
            def.targets[0].blend = true;
            break;
        default: def.program.vertex[0] = NULL, def.program.vertex[1] = rig_vertex_pass;
        }
        rhw_pipeline pipeline;
        if (rhw_pipeline_create(rig.context, &def, &pipeline) != RHW_ERROR_MISUSE) {
            fail_msg("definition %d was accepted", wrong);
        }
        rig_expect_misuse(&rig, "rhw_pipeline_create");
    }
    expect_alive(&rig);
    rig_close(&rig);
}

// What a program's flags make of its arithmetic; tests/program/test_flags.sh compiles such programs.
static void test_arithmetic_of_the_program(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_pipeline pipeline;
    assert_int_equal(rhw_arithmetic_flaws(), 0);
    static const struct {
        uint32_t flaws;
        const char *message;
    } cases[] = {{RHW_ARITHMETIC_FUSED, "-ffp-contract=off"},
                 {RHW_ARITHMETIC_REORDERED, "-fassociative-math"},
                 {4, "flaws is 0x4"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(rhw_pipeline_create_probed(rig.context, &rig.pipeline, cases[i].flaws, &pipeline),
                         RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, cases[i].message);
    }
    assert_int_equal(rhw_pipeline_create_probed(rig.context, &rig.pipeline, 0, &pipeline), RHW_OK);
    rhw_pipeline_destroy(rig.context, pipeline);
    expect_alive(&rig);
    rig_close(&rig);
}

static void test_pass_definitions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_depth(&rig);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA8_UNORM);
    const struct rhw_pass_def good = rig.pass;
    const rhw_texture small = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 4);
    for (int wrong = 0; wrong < 16; wrong++) {
        struct rhw_pass_def def = good;
        switch (wrong) {
        case 0: def.color_count = RHW_MAX_COLOR_ATTACHMENTS + 1; break;
        case 1: def.color_count = -1; break;
        case 2: def.color_count = 0, def.depth.enabled = false; break;
        case 3: def.colors[1].texture = small; break;
        case 4: def.width = 9, def.height = 8; break;
        case 5: def.width = 8, def.height = -8; break;
        case 6: def.colors[0].load = (enum rhw_load)4; break;
        case 7: def.colors[0].store = (enum rhw_store)2; break;
        case 8: def.depth.texture = def.colors[0].texture; break;
        case 9: def.colors[1].texture = def.depth.texture; break;
        case 10: def.depth.clear = 1.5f; break;
        case 11: def.depth.clear = NAN; break;
        case 12: def.depth.texture = (rhw_texture){0}; break; // stored where nothing is
        case 13:
            def.depth.texture = (rhw_texture){0}, def.depth.store = RHW_STORE_DISCARD,
            def.depth.load = RHW_LOAD_LOAD;
            break;
        case 14:
            def.colors[0].texture = (rhw_texture){0};
            def.color_count = 0;
            def.width = RHW_MAX_TARGET_SIZE + 1, def.height = 8;
            def.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
            break;
        default: def.colors[1].texture = def.colors[0].texture; // the same memory twice
        }
        rhw_pass pass;
        if (rhw_pass_begin(rig.context, &def, &pass) != RHW_ERROR_MISUSE) {
            fail_msg("definition %d was accepted", wrong);
        }
        rig_expect_misuse(&rig, "rhw_pass_begin");
    }
    rig_begin(&rig);
    rig_end(&rig);
    rig_close(&rig);
}

static void test_pass_state(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_context *const context = rig.context;
    const rhw_buffer buffer = make_buffer(&rig);
    const rhw_texture texture = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 8);
    const rhw_sampler sampler = make_sampler(&rig);
    rig_begin(&rig);
    rhw_pass_set_vertex_buffer(context, rig.recording, RHW_MAX_VERTEX_BUFFERS, buffer, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_buffer");
    rhw_pass_set_vertex_buffer(context, rig.recording, -1, buffer, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_buffer");
    rhw_pass_set_vertex_buffer(context, rig.recording, 0, buffer, 65);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_buffer");
    rhw_pass_set_index_buffer(context, rig.recording, buffer, (enum rhw_index_type)3, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_index_buffer");
    rhw_pass_set_index_buffer(context, rig.recording, buffer, RHW_INDEX_UINT8, SIZE_MAX);
    rig_expect_misuse(&rig, "rhw_pass_set_index_buffer");
    rhw_pass_set_uniforms(context, rig.recording, NULL, 4);
    rig_expect_misuse(&rig, "rhw_pass_set_uniforms");
    static const char block[RHW_MAX_UNIFORM_SIZE + 1];
    rhw_pass_set_uniforms(context, rig.recording, block, sizeof block);
    rig_expect_misuse(&rig, "rhw_pass_set_uniforms");
    rhw_pass_set_texture(context, rig.recording, RHW_MAX_TEXTURES, texture, sampler);
    rig_expect_misuse(&rig, "rhw_pass_set_texture");
    rhw_pass_set_texture(context, rig.recording, 0, rig.pass.colors[0].texture, sampler);
    rig_expect_misuse(&rig, "rhw_pass_set_texture"); // it is drawn into
    const struct rhw_viewport viewports[] = {
        {0, 0, 0, 8, 0, 1},   {0, 0, 8, -20000, 0, 1},   {0, 0, 8, 8, -0.5f, 1}, {0, 0, 8, 8, 0, 2},
        {NAN, 0, 8, 8, 0, 1}, {0, 0, INFINITY, 8, 0, 1}, {0, 0, 8, 8, NAN, 1},   {0, 1e9f, 8, 8, 0, 1},
        {0, 0, 8, NAN, 0, 1}, {-32769, 0, 8, 8, 0, 1},   {0, 0, 8, 8, 0, -0.5f},
    };
    for (size_t i = 0; i < sizeof viewports / sizeof *viewports; i++) {
        rhw_pass_set_viewport(context, rig.recording, &viewports[i]);
        rig_expect_misuse(&rig, "rhw_pass_set_viewport");
    }
    rhw_pass_set_scissor(context, rig.recording, &(struct rhw_rect){0, 0, -1, 8});
    rig_expect_misuse(&rig, "rhw_pass_set_scissor");
    rhw_pass_set_scissor(context, rig.recording, NULL);
    rig_expect_misuse(&rig, "rhw_pass_set_scissor");
    rhw_pass_set_blend_constant(context, rig.recording, NULL);
    rig_expect_misuse(&rig, "rhw_pass_set_blend_constant");
    rig_end(&rig);
    expect_alive(&rig);
    rig_close(&rig);
}

static void test_draws_without_what_they_need(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_context *const context = rig.context;
    rig_begin(&rig);
    rhw_pass_draw(context, rig.recording, 0, 3, 0, 1);
    rig_expect_misuse(&rig, "rhw_pass_draw"); // no pipeline
    rig.pipeline.program.uniform_size = 32;
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, white, sizeof white);
    rhw_pass_draw(context, rig.recording, 0, 3, 0, 1);
    rig_expect_misuse(&rig, "rhw_pass_draw"); // no uniforms
    rhw_pass_set_uniforms(context, rig.recording, white, sizeof white);
    rhw_pass_draw(context, rig.recording, 0, 3, 0, 1);
    rig_expect_misuse(&rig, "rhw_pass_draw"); // too few
    rig.pipeline.program.uniform_size = 0;
    rig_use_pipeline(&rig);
    rhw_pass_draw_indexed(context, rig.recording, 0, 3, 0, 0, 1);
    rig_expect_misuse(&rig, "rhw_pass_draw_indexed"); // no index buffer
    rig_end(&rig);
    assert_int_equal(rig.stats.draws, 0);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_draw(context, rig.recording, 0, 3, 0, 1);
    rig_expect_misuse(&rig,
                      "rhw_pass_draw: no vertex buffer is set in slot 0, which attribute 0 of pipeline");
    // A pipeline made for other attachments.
    rig.pipeline.targets[0].format = RHW_FORMAT_RGBA8_UNORM;
    rhw_pipeline other = make_pipeline(&rig);
    rhw_pass_set_pipeline(context, rig.recording, other);
    rig_expect_misuse(&rig, "rhw_pass_set_pipeline");
    rig.pipeline.targets[0].format = RHW_FORMAT_RGBA32_FLOAT;
    rig.pipeline.depth_test = true;
    other = make_pipeline(&rig);
    rhw_pass_set_pipeline(context, rig.recording, other);
    rig_expect_misuse(&rig, "rhw_pass_set_pipeline");
    rig.pipeline.depth_test = false;
    rig.pipeline.target_count = 2;
    rig.pipeline.targets[1] = rig.pipeline.targets[0];
    other = make_pipeline(&rig);
    rhw_pass_set_pipeline(context, rig.recording, other);
    rig_expect_misuse(&rig, "rhw_pass_set_pipeline");
    rig.pipeline.target_count = 1;
    rig_end(&rig);
    expect_alive(&rig);
    rig_close(&rig);
}

static void test_null_arguments(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_context *const context = rig.context;
    assert_int_equal(rhw_buffer_create(context, NULL, &(rhw_buffer){0}), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_buffer_create");
    assert_int_equal(rhw_texture_create(context, NULL, &(rhw_texture){0}), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_texture_create");
    assert_int_equal(rhw_sampler_create(context, NULL, &(rhw_sampler){0}), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_sampler_create");
    assert_int_equal(rhw_pipeline_create(context, NULL, &(rhw_pipeline){0}), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pipeline_create");
    assert_int_equal(rhw_pass_begin(context, NULL, &(rhw_pass){0}), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_begin");
    assert_int_equal(rhw_pass_begin(context, &rig.pass, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_begin");
    rig_close(&rig);
}

static void release_nothing(void *user, void *memory, size_t size)
{
    (void)user, (void)memory, (void)size;
}

static void test_context_definitions(void **state)
{
    (void)state;
    struct rig rig = {0};
    for (int wrong = 0; wrong < 7; wrong++) {
        struct rhw_context_def def = rhw_context_def_default();
        def.assert_ = rig_misuse;
        def.user = &rig;
        switch (wrong) {
        case 0: def.threads = -1; break;
        case 1: def.threads = RHW_MAX_THREADS + 1; break;
        case 2: def.isa_limit = (enum rhw_isa_limit)(RHW_ISA_COUNT + 1); break;
        case 3: def.isa_limit = (enum rhw_isa_limit) - 1; break;
        case 4: def.paths = (enum rhw_paths)(RHW_PATHS_GENERAL + 1); break;
        case 5: def.paths = (enum rhw_paths) - 1; break;
        default: def.allocator.release = release_nothing;
        }
        rhw_context *context = (rhw_context *)&rig;
        assert_int_equal(rhw_context_create(&def, &context), RHW_ERROR_MISUSE);
        assert_null(context);
        rig_expect_misuse(&rig, "rhw_context_create");
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_destroyed_and_null_ids),
    cmocka_unit_test(test_an_ended_pass_is_stale),
    cmocka_unit_test(test_texture_and_buffer_definitions),
    cmocka_unit_test(test_sampler_definitions),
    cmocka_unit_test(test_pipeline_definitions),
    cmocka_unit_test(test_arithmetic_of_the_program),
    cmocka_unit_test(test_pass_definitions),
    cmocka_unit_test(test_pass_state),
    cmocka_unit_test(test_draws_without_what_they_need),
    cmocka_unit_test(test_null_arguments),
    cmocka_unit_test(test_context_definitions),
};

const struct unit_tests test_misuse = UNIT_TESTS(tests, NULL, NULL);
