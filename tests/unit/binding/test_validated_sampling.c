// SPDX-License-Identifier: MIT
// What validation says about sampling and about groups: slots without a texture, levels that nobody has written, shader
// functions that work on their first group alone; and its warnings, where the program has no log.
#include "harness.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void open_validated(struct rig *rig, rhw_log_function *log)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    def.validate = RHW_VALIDATE_ON;
    def.log = log;
    rig_open_with(rig, 8, 8, &def);
    rig->pipeline.label = "sky";
    rig->pass.label = "main";
}

// Draws a whole picture; what the end of the pass gives.
static enum rhw_result draw(struct rig *rig, rhw_texture texture, rhw_sampler sampler)
{
    static const float coordinates[4] = {0.5f, 0.5f, 0, 1};
    struct rig_vertex all[6];
    rig_cover(rig, 0, coordinates, all);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 3, texture, sampler);
    rig_draw(rig, all, 6);
    return rhw_pass_end(rig->context, rig->recording, NULL);
}

// Slots ---------------------------------------------------------------------------------------------------

static float level_asked; // of the test under way

static void sample(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_sample_lod(groups[g].bindings, 3, groups[g].varying, rhw_splat(level_asked), groups[g].color[0]);
    }
}

static void sample_one(struct rhw_fragment1 *f)
{
    rhw_sample_lod1(f->bindings, 3, f->varying, level_asked, f->color[0]);
}

static void sample_groups(struct rhw_fragment *groups, int count)
{
    rhw_float texels[RHW_MAX_GROUPS * 4][4];
    rhw_sample_groups(groups, count, 8, 0, texels, 4);
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].color[0], texels[4 * g + 3], sizeof texels[0]);
    }
}

static void sample_groups_one(struct rhw_fragment1 *f)
{
    float texels[4][4];
    rhw_sample_groups1(f, 8, 0, texels);
    memcpy(f->color[0], texels[3], sizeof texels[3]);
}

static void sample_narrow(struct rhw_fragment *groups, int count)
{
    rhw_float texels[RHW_MAX_GROUPS * 3][4];
    memset(texels, 0, sizeof texels);
    rhw_sample_groups(groups, count, 9, 0, texels, 3);
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].color[0], texels[3 * g], sizeof texels[0]);
    }
}

static void place(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        rhw_sample_lod(groups[g].bindings, 3, groups[g].attribute[1], rhw_splat(level_asked),
                       groups[g].varying);
    }
}

enum { FORMS = 5 };

static void use_form(struct rig *rig, int form)
{
    struct rhw_program *const program = &rig->pipeline.program;
    rig_set_program(rig, form == 3 ? place : rig_vertex_pass,
                    form == 0   ? sample
                    : form == 1 ? NULL
                    : form == 4 ? NULL
                    : form == 2 ? sample_groups
                                : rig_fragment_pass);
    program->fragment1 = form == 1 ? sample_one : form == 4 ? sample_groups_one : NULL;
    program->varyings[0].derivatives = form == 2 || form == 4;
}

static void test_an_empty_slot(void **state)
{
    (void)state;
    for (int form = 0; form < FORMS; form++) {
        struct rig rig;
        open_validated(&rig, NULL);
        use_form(&rig, form);
        level_asked = 0;
        assert_int_equal(draw(&rig, (rhw_texture){0}, (rhw_sampler){0}), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig,
                          "a shader function of pipeline 1 \"sky\" samples slot 3, in which no texture is "
                          "set [draw 0 of pass \"main\"]");
        const float *const texel = rig_read_float4(&rig)[0];
        assert_true(texel[0] == 0 && texel[1] == 0 && texel[2] == 0 && texel[3] == 1);
        rig_close(&rig);
    }
}

// Slot 3 of a group would lie in the next one.
static void test_a_stride_without_room(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, NULL);
    rig_set_program(&rig, rig_vertex_pass, sample_narrow);
    rig.pipeline.program.varyings[0].derivatives = true;
    assert_int_equal(draw(&rig, (rhw_texture){0}, (rhw_sampler){0}), RHW_ERROR_MISUSE);
    rig_expect_misuse(
        &rig, "a shader function of pipeline 1 \"sky\" calls rhw_sample_groups with stride 3; it must be "
              "above the highest slot, which is 3 [draw 0 of pass \"main\"]");
    assert_true(rig_read_float4(&rig)[0][0] == 0);
    rig_close(&rig);
}

// Levels --------------------------------------------------------------------------------------------------

static rhw_texture make_texture(struct rig *rig)
{
    static const float white[16][16][4];
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = 16, .height = 16, .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    assert_int_equal(rhw_texture_write(rig->context, texture, 0, white, 0), RHW_OK);
    return texture;
}

static rhw_sampler make_sampler(struct rig *rig, enum rhw_mip_filter filter)
{
    const struct rhw_sampler_def def = {.mip_filter = filter};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &def, &sampler), RHW_OK);
    return sampler;
}

static void test_levels_that_nobody_wrote(void **state)
{
    (void)state;
    static const struct {
        float asked;
        enum rhw_mip_filter filter;
        int told; // 0: nothing
    } cases[] = {{0, RHW_MIP_FILTER_LINEAR, 0},     {-3, RHW_MIP_FILTER_LINEAR, 0},
                 {0.5f, RHW_MIP_FILTER_LINEAR, 1},  {2, RHW_MIP_FILTER_LINEAR, 2},
                 {99, RHW_MIP_FILTER_LINEAR, 4},    {0.4f, RHW_MIP_FILTER_NEAREST, 0},
                 {0.6f, RHW_MIP_FILTER_NEAREST, 1}, {4, RHW_MIP_FILTER_NONE, 0}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        struct rig rig;
        open_validated(&rig, NULL);
        use_form(&rig, i % 2);
        level_asked = cases[i / 2].asked;
        const rhw_texture texture = make_texture(&rig);
        const rhw_sampler sampler = make_sampler(&rig, cases[i / 2].filter);
        const int told = cases[i / 2].told;
        assert_int_equal(draw(&rig, texture, sampler), told ? RHW_ERROR_MISUSE : RHW_OK);
        if (told) {
            char message[128];
            snprintf(message, sizeof message,
                     "samples level %d of the texture in slot 3, which was never written; "
                     "rhw_texture_generate_mips",
                     told);
            rig_expect_misuse(&rig, message);
        }
        assert_int_equal(rhw_texture_generate_mips(rig.context, texture), RHW_OK);
        assert_int_equal(draw(&rig, texture, sampler), RHW_OK);
        rig_close(&rig);
    }
}

// A view counts as written in all its levels, and so does the texture from then on: which levels somebody wrote through
// which of both is not followed.
static void test_levels_behind_a_view(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, NULL);
    use_form(&rig, 0);
    level_asked = 3;
    const rhw_texture texture = make_texture(&rig);
    const rhw_sampler sampler = make_sampler(&rig, RHW_MIP_FILTER_LINEAR);
    const struct rhw_texture_view_def def = {.texture = texture, .level = 2, .levels = 2};
    rhw_texture view;
    assert_int_equal(rhw_texture_view_create(rig.context, &def, &view), RHW_OK);
    assert_int_equal(draw(&rig, texture, sampler), RHW_OK);
    assert_int_equal(draw(&rig, view, sampler), RHW_OK);
    rhw_texture_destroy(rig.context, view);
    rig_close(&rig);
}

static void sample_by_mask(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float level = rhw_select(groups[g].mask, rhw_splat(0), rhw_splat(4));
        rhw_sample_lod(groups[g].bindings, 3, groups[g].varying, level, groups[g].color[0]);
    }
}

// Lanes without a fragment ask for anything.
static void test_dead_lanes_do_not_count(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, NULL);
    rig_set_program(&rig, rig_vertex_pass, sample_by_mask);
    struct rig_vertex all[6];
    rig_rectangle(&rig, 0, 0, 3, 1, 0, (const float[4]){0}, all);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 3, make_texture(&rig),
                         make_sampler(&rig, RHW_MIP_FILTER_LINEAR));
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    assert_int_equal(rig.misuses, 0);
    rig_close(&rig);
}

// What is written by hand counts, also where the write gave the texture new memory.
static void test_levels_written_one_by_one(void **state)
{
    (void)state;
    static const float texels[8][8][4];
    struct rig rig;
    open_validated(&rig, NULL);
    use_form(&rig, 0);
    level_asked = 1;
    const rhw_texture texture = make_texture(&rig);
    const rhw_sampler sampler = make_sampler(&rig, RHW_MIP_FILTER_LINEAR);
    assert_int_equal(rhw_texture_write(rig.context, texture, 1, texels, 0), RHW_OK);
    assert_int_equal(draw(&rig, texture, sampler), RHW_OK);
    struct rig_vertex all[6];
    rig_cover(&rig, 0, (const float[4]){0}, all);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 3, texture, sampler);
    rig_draw(&rig, all, 6);
    assert_int_equal(rhw_texture_write(rig.context, texture, 2, texels, 0), RHW_OK); // the draw has a copy
    level_asked = 1;
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    level_asked = 2;
    assert_int_equal(draw(&rig, texture, sampler), RHW_OK);
    // Of the two levels that are mixed the finer one is missing.
    const rhw_texture gap = make_texture(&rig);
    assert_int_equal(rhw_texture_write(rig.context, gap, 3, texels, 0), RHW_OK);
    level_asked = 2.5f;
    assert_int_equal(draw(&rig, gap, sampler), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "samples level 2 of the texture in slot 3, which was never written");
    rig_close(&rig);
}

// References ----------------------------------------------------------------------------------------------

static int way; // of the test under way: by level, by gradient, gathered, in a window
static bool has_reference;

static void sample_anyway(struct rhw_fragment *groups, int count)
{
    static const rhw_float none[4], half = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    for (int g = 0; g < count; g++) {
        const struct rhw_sample_request request = {.coordinates = groups[g].varying,
                                                   .gradient = way == 1 ? none : NULL,
                                                   .reference = has_reference ? &half : NULL};
        if (way < 2) {
            rhw_sample(groups[g].bindings, 3, &request, groups[g].color[0]);
        } else if (way == 2) {
            rhw_sample_gather(groups[g].bindings, 3, &request, 0, groups[g].color[0]);
        } else {
            rhw_sample_compare_window(groups[g].bindings, 3, &request, 2, 2, groups[g].color[0]);
        }
    }
}

// A reference belongs to a sampler that compares: one without the other is a slip.
static void test_references(void **state)
{
    (void)state;
    static const char *const messages[] = {
        "\"sky\" gives a reference for slot 3, and the sampler there does not compare",
        "\"sky\" samples slot 3 without a reference, and the sampler there compares"};
    for (int i = 0; i < 4 * 4; i++) {
        struct rig rig;
        rhw_sampler sampler;
        rhw_texture texture;
        const bool compares = i & 1;
        way = i / 4;
        has_reference = i & 2;
        open_validated(&rig, NULL);
        rig_set_program(&rig, rig_vertex_pass, sample_anyway);
        const struct rhw_texture_def def = {.format = RHW_FORMAT_D32_FLOAT, .width = 4, .height = 4};
        assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
        assert_int_equal(
            rhw_sampler_create(rig.context, &(struct rhw_sampler_def){.compares = compares}, &sampler),
            RHW_OK);
        const bool is_slip = compares != has_reference;
        assert_int_equal(draw(&rig, texture, sampler), is_slip ? RHW_ERROR_MISUSE : RHW_OK);
        if (is_slip) {
            rig_expect_misuse(&rig, messages[compares]);
        }
        rig_close(&rig);
    }
}

// Groups --------------------------------------------------------------------------------------------------

static void paint_first(struct rhw_fragment *groups, int count)
{
    (void)count;
    rig_fragment_pass(groups, 1);
}

static void place_first(struct rhw_vertex *groups, int count)
{
    (void)count;
    rig_vertex_pass(groups, 1);
}

// However few groups a draw has.
static void test_functions_that_forget_their_count(void **state)
{
    (void)state;
    for (int vertices = 3; vertices <= 6; vertices += 3) {
        for (int wrong = 0; wrong < 2; wrong++) {
            struct rig rig;
            open_validated(&rig, NULL);
            rig_set_program(&rig, wrong ? place_first : rig_vertex_pass,
                            wrong ? rig_fragment_pass : paint_first);
            struct rig_vertex all[6];
            rig_rectangle(&rig, 0, 0, vertices == 3 ? 2 : 8, 8, 0, (const float[4]){1, 1, 1, 1}, all);
            rig_begin(&rig);
            rig_draw(&rig, all, vertices);
            assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
            rig_expect_misuse(&rig,
                              wrong ? "the vertex function of pipeline 1 \"sky\" works on the first of its "
                                      "groups alone; it must work on `count` of them"
                                    : "the fragment function of pipeline 1 \"sky\" works on the first of "
                                      "its groups alone; it must work on `count` of them");
            rig_close(&rig);
        }
    }
}

// Warnings ------------------------------------------------------------------------------------------------

static void divide(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_splat(0) / (groups[g].varying[2] - groups[g].varying[2]);
    }
}

static void hear(void *user, enum rhw_log_level level, const char *message)
{
    (void)user;
    (void)level;
    (void)message;
}

// What a draw that is warned about leaves on stderr.
static void read_stderr(rhw_log_function *log, char text[512])
{
    FILE *const file = tmpfile();
    const int kept = dup(2);
    assert_true(file != NULL && kept >= 0);
    struct rig rig;
    open_validated(&rig, log);
    rig_set_program(&rig, rig_vertex_pass, divide);
    fflush(stderr);
    dup2(fileno(file), 2);
    const enum rhw_result result = draw(&rig, (rhw_texture){0}, (rhw_sampler){0});
    fflush(stderr);
    dup2(kept, 2);
    close(kept);
    assert_int_equal(result, RHW_OK);
    rewind(file);
    text[fread(text, 1, 511, file)] = 0;
    fclose(file);
    rig_close(&rig);
}

static void test_warnings_are_seen_without_a_log(void **state)
{
    (void)state;
    char text[512];
    read_stderr(NULL, text);
    assert_string_equal(text, "rhw: warning: the fragment function of pipeline 1 \"sky\" gives NaN in "
                              "color[0][0]; at pixel 0, 0 [draw 0 of pass \"main\"]\n");
    read_stderr(hear, text);
    assert_string_equal(text, "");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_an_empty_slot),
    cmocka_unit_test(test_a_stride_without_room),
    cmocka_unit_test(test_levels_that_nobody_wrote),
    cmocka_unit_test(test_levels_behind_a_view),
    cmocka_unit_test(test_references),
    cmocka_unit_test(test_levels_written_one_by_one),
    cmocka_unit_test(test_dead_lanes_do_not_count),
    cmocka_unit_test(test_functions_that_forget_their_count),
    cmocka_unit_test(test_warnings_are_seen_without_a_log),
};

const struct unit_tests test_validated_sampling = UNIT_TESTS(tests, NULL, NULL);
