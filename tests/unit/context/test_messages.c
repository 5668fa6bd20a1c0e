// SPDX-License-Identifier: MIT
// What messages call things: definitions by their label, attachments by their member, what is gone by the label it had,
// formats by their name; and that contradictions in a definition are told.
#include "harness.h"

#include <stdio.h>
#include <string.h>

static void open_labelled(struct rig *rig)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.label = "thumbnails";
    rig_open_with(rig, 8, 8, &def);
}

static void refuse_pass(struct rig *rig, const struct rhw_pass_def *def, const char *message)
{
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig->context, def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, message);
}

static void test_definitions_are_named(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_buffer buffer;
    rhw_texture texture;
    rhw_sampler sampler;
    rhw_pipeline pipeline;
    rhw_context *context;
    rhw_buffer_create(rig.context, &(struct rhw_buffer_def){.label = "a"}, &buffer);
    rig_expect_misuse(&rig, "rhw_buffer_create \"a\": size is 0");
    rhw_texture_create(rig.context, &(struct rhw_texture_def){.label = "b"}, &texture);
    rig_expect_misuse(&rig, "rhw_texture_create \"b\": format is not set (RHW_FORMAT_NONE)");
    rhw_sampler_create(rig.context, &(struct rhw_sampler_def){.compare = 3, .label = "c"}, &sampler);
    rig_expect_misuse(&rig, "rhw_sampler_create \"c\": compare is 3");
    rhw_pipeline_create(rig.context, &(struct rhw_pipeline_def){.label = "sky"}, &pipeline);
    rig_expect_misuse(&rig, "rhw_pipeline_create \"sky\": program.vertex and program.vertex1 are NULL");
    const struct rhw_context_def wrong = {.threads = -1, .label = "e", .assert_ = rig_misuse, .user = &rig};
    rhw_context_create(&wrong, &context);
    rig_expect_misuse(&rig, "rhw_context_create \"e\": threads is -1");
    refuse_pass(&rig, &(struct rhw_pass_def){.label = "f"},
                "rhw_pass_begin \"f\": the pass has no attachment, so width and height must be set");
    // Others have none, nor has what comes after.
    rhw_buffer_create(rig.context, &(struct rhw_buffer_def){0}, &buffer);
    rig_expect_misuse(&rig, "rhw_buffer_create: size is 0");
    rhw_buffer_write(rig.context, (rhw_buffer){0}, 0, "", 1);
    rig_expect_misuse(&rig, "rhw_buffer_write: the buffer id is null");
    rig_close(&rig);
}

static void test_attachments_are_named(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rhw_pass_def def = rig.pass;
    const rhw_texture texture = def.colors[0].texture;
    def.color_count = 2;
    def.colors[1].resolve = texture;
    refuse_pass(&rig, &def, "rhw_pass_begin: colors[1].resolve is set and colors[1].texture is null");
    def.colors[1].load = 9;
    refuse_pass(&rig, &def, "rhw_pass_begin: colors[1].load is 9; not a load operation");
    def.color_count = 1;
    def.depth = (struct rhw_depth_attachment){.enabled = true, .stencil_load = 9};
    refuse_pass(&rig, &def, "rhw_pass_begin: depth.stencil_load is 9; not a load operation");
    def.depth = (struct rhw_depth_attachment){.enabled = true, .texture = texture};
    refuse_pass(&rig, &def, "rhw_pass_begin: depth is texture 1, as another attachment is");
    def.depth.texture.generation++;
    refuse_pass(&rig, &def, "rhw_pass_begin: depth.texture: texture 1 (generation 2) is stale");
    def.depth = (struct rhw_depth_attachment){.enabled = true};
    refuse_pass(&rig, &def,
                "depth.texture is null and depth.store is RHW_STORE_STORE: give it a texture, or set "
                "depth.store = RHW_STORE_DISCARD");
    def.depth.load = RHW_LOAD_LOAD;
    refuse_pass(&rig, &def, "depth.texture is null and depth.load is not RHW_LOAD_CLEAR: give it a texture");
    def.depth.format = RHW_FORMAT_RGBA8_UNORM;
    refuse_pass(&rig, &def, "depth.format is RHW_FORMAT_RGBA8_UNORM; that has neither depth nor stencil");
    rig_close(&rig);
}

static void test_formats_are_named(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_pipeline pipeline;
    rig.pipeline.targets[0].format = RHW_FORMAT_NONE;
    rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline);
    rig_expect_misuse(&rig, "targets[0].format is not set (RHW_FORMAT_NONE)");
    rig.pipeline.targets[1].format = RHW_FORMAT_R8_UNORM;
    rig.pipeline.target_count = 2;
    rig.pipeline.targets[0].blend = true;
    rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline);
    rig_expect_misuse(&rig, "targets[0].blend is true and its format is not set (RHW_FORMAT_NONE)");
    rig.pipeline.targets[0].blend = false;
    rig.pipeline.target_count = 1;
    rig.pipeline.targets[0].format = 999;
    rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline);
    rig_expect_misuse(&rig, "targets[0].format is 999; it must be RHW_FORMAT_R8_UNORM (1) to RHW_FORMAT_");
    rig_close(&rig);
}

static void test_what_is_gone_keeps_its_label(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rhw_buffer_def def = {.size = 4, .label = "old"};
    rhw_buffer old, next, last;
    rhw_buffer_create(rig.context, &def, &old);
    rhw_buffer_destroy(rig.context, old);
    rhw_buffer_write(rig.context, old, 0, "", 1);
    rig_expect_misuse(&rig, "buffer 1 \"old\" (generation 1) is stale: it was destroyed");
    def.label = "next"; // which has its place
    rhw_buffer_create(rig.context, &def, &next);
    rhw_buffer_write(rig.context, old, 0, "", 1);
    rig_expect_misuse(&rig, "buffer 1 \"old\" (generation 1) is stale: it was destroyed");
    rhw_buffer_destroy(rig.context, next);
    def.label = NULL;
    rhw_buffer_create(rig.context, &def, &last);
    rhw_buffer_write(rig.context, old, 0, "", 1);
    rig_expect_misuse(&rig, "buffer 1 (generation 1) is stale: it was destroyed");
    rig_close(&rig);
}

static void call_library(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    rhw_context *const *const context = groups->user;
    rhw_texture_destroy(*context, (rhw_texture){1, 1, 1});
}

static void test_calls_that_meet_name_the_context(void **state)
{
    (void)state;
    struct rig rig;
    open_labelled(&rig);
    struct rig_vertex all[6];
    rig_rectangle(&rig, 0, 0, 1, 1, 0, (const float[4]){0}, all);
    rig_set_program(&rig, rig_vertex_pass, call_library);
    rig.pipeline.program.user = &rig.context;
    rig_begin(&rig);
    rig_draw(&rig, all, 6);
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    assert_true(rig.misuses >= 1);
    rig.misuses = 1;
    rig_expect_misuse(&rig,
                      "rhw_texture_destroy: called by a function that the library called, such as a shader "
                      "function; it must not use the context [context \"thumbnails\"]");
    rig_close(&rig);
}

static void test_a_refused_pipeline(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    for (int refused = 1; refused >= 0; refused--) {
        rig_begin(&rig);
        if (refused) {
            rhw_pass_set_pipeline(rig.context, rig.recording, (rhw_pipeline){0});
            rig_expect_misuse(&rig, "the pipeline id is null");
        }
        rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
        rig_expect_misuse(&rig, refused ? "no pipeline is set, as the one that was to be was refused [draw 0]"
                                        : "no pipeline is set [draw 0]");
        rig_end(&rig);
    }
    rig_close(&rig);
}

static char logged[512];

static void keep_log(void *user, enum rhw_log_level level, const char *message)
{
    (void)user;
    if (level == RHW_LOG_WARNING) {
        snprintf(logged, sizeof logged, "%s", message);
    }
}

// What the last call logged, forgotten then: `message` where the context validates, else nothing.
static void expect_logged(bool validates, const char *message)
{
    assert_string_equal(logged, validates ? message : "");
    logged[0] = 0;
}

// What is set and switched off is no misuse, and told to those who validate.
static void test_contradictions(void **state)
{
    (void)state;
    for (int validates = 0; validates < 2; validates++) {
        struct rig rig;
        struct rhw_context_def context_def = rhw_context_def_default();
        context_def.validate = validates ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF;
        context_def.log = keep_log;
        rig_open_with(&rig, 8, 8, &context_def);
        struct rhw_pipeline_def def = rig.pipeline;
        rhw_pipeline pipeline;
        assert_int_equal(rhw_pipeline_create(rig.context, &def, &pipeline), RHW_OK);
        expect_logged(false, "");
        def.targets[0].alpha.dst = RHW_BLEND_ONE;
        def.label = "sky";
        assert_int_equal(rhw_pipeline_create(rig.context, &def, &pipeline), RHW_OK);
        expect_logged(validates, "rhw_pipeline_create \"sky\": targets[0].color or .alpha is set and "
                                 "targets[0].blend is false");
        def = rig.pipeline;
        def.depth_read_only = true;
        assert_int_equal(rhw_pipeline_create(rig.context, &def, &pipeline), RHW_OK);
        expect_logged(validates, "rhw_pipeline_create: depth_read_only is true and depth_test is false");
        def = rig.pipeline;
        def.stencil_back.pass = RHW_STENCIL_INVERT;
        assert_int_equal(rhw_pipeline_create(rig.context, &def, &pipeline), RHW_OK);
        expect_logged(validates,
                      "rhw_pipeline_create: stencil_front or stencil_back is set and stencil_test is false");
        rig_set_depth(&rig);
        rig.pass.depth.enabled = false;
        rhw_pass pass;
        assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_OK);
        expect_logged(validates, "rhw_pass_begin: depth.texture is set and depth.enabled is false");
        rhw_pass_cancel(rig.context, pass);
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_definitions_are_named),
    cmocka_unit_test(test_attachments_are_named),
    cmocka_unit_test(test_formats_are_named),
    cmocka_unit_test(test_what_is_gone_keeps_its_label),
    cmocka_unit_test(test_calls_that_meet_name_the_context),
    cmocka_unit_test(test_a_refused_pipeline),
    cmocka_unit_test(test_contradictions),
};

const struct unit_tests test_messages = UNIT_TESTS(tests, NULL, NULL);
