// SPDX-License-Identifier: MIT
// Loops without an end are given up, on any thread, and control flow goes where it has lanes.
#include "patience.h"
#include "spirv_run.h"

#include "endless_comp.h"
#include "endless_frag.h"
#include "endless_vert.h"
#include "plain_vert.h"

enum { LANES = 20, WORKGROUPS = 3 };

static void check_given_up(int threads)
{
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(endless_comp, RHW_SHADER_COMPUTE));
    uint32_t words[LANES * WORKGROUPS];
    const struct rhw_binding binding = spirv_memory(words, sizeof words);
    const struct rhw_shader_frame frame = {.sets = {&binding}};
    struct rig rig;
    rig_open_with(&rig, 4, 4, &(struct rhw_context_def){.threads = threads});
    for (int turn = 0; turn < 3; turn++) {
        for (uint32_t i = 0; i < LANES * WORKGROUPS; i++) {
            words[i] = 1 + (i & 1);
        }
        words[LANES - 1] = turn == 0 ? 1 : 0; // the other turns have a lane that never ends
        struct patience patience = {.left = WORKGROUPS + 3};
        rhw_context_set_goes_on(rig.context, goes_on, &patience);
        assert_int_equal(spirv_dispatch(&rig, program, &frame, WORKGROUPS),
                         turn == 0 ? RHW_OK : RHW_ERROR_GIVEN_UP);
        for (uint32_t i = 0; turn == 0 && i < LANES * WORKGROUPS; i++) {
            assert_int_equal(words[i], i == LANES - 1 || (i & 1) == 0 ? 100 : 101);
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_a_dispatch_without_an_end_is_given_up(void **state)
{
    (void)state;
    check_given_up(1);
    check_given_up(3);
}

static enum rhw_result draw(struct rig *rig, const rhw_shader_program *program, float step)
{
    const struct rig_vertex triangle[3] = {
        {{-2, -2, 0, 1}, {0, step, 0, 1}},
        {{6, -2, 0, 1}, {0, step, 0, 1}},
        {{-2, 6, 0, 1}, {0, step, 0, 1}},
    };
    const float scale = 1;
    const struct rhw_shader_frame frame = {.push_constants = &scale, .push_size = sizeof scale};
    rig->pipeline.program = *rhw_shader_program_get(program);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, triangle, sizeof triangle);
    rhw_pass_set_uniforms(rig->context, rig->recording, &frame, sizeof frame);
    rhw_pass_draw(rig->context, rig->recording, 0, 3, 0, 1);
    return rhw_pass_end(rig->context, rig->recording, NULL);
}

static void check_draw(rhw_shader *vertex, rhw_shader *fragment, float step_that_ends)
{
    rhw_shader_program *const program = spirv_link(vertex, fragment, NULL);
    for (int threads = 1; threads <= 3; threads += 2) {
        struct rig rig;
        rig_open_with(&rig, 200, 200, &(struct rhw_context_def){.threads = threads});
        struct patience patience = {.left = 4};
        assert_int_equal(draw(&rig, program, step_that_ends), RHW_OK);
        rhw_context_set_goes_on(rig.context, goes_on, &patience);
        assert_int_equal(draw(&rig, program, 0), RHW_ERROR_GIVEN_UP);
        rhw_context_set_goes_on(rig.context, NULL, NULL);
        assert_int_equal(draw(&rig, program, step_that_ends), RHW_OK);
        rig_close(&rig);
    }
    rhw_shader_program_destroy(program);
}

static void test_fragments_without_an_end_are_given_up(void **state)
{
    (void)state;
    check_draw(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX), SPIRV_CREATE(endless_frag, RHW_SHADER_FRAGMENT),
               0.5f);
}

static void test_vertices_without_an_end_are_given_up(void **state)
{
    (void)state;
    check_draw(SPIRV_CREATE(endless_vert, RHW_SHADER_VERTEX), SPIRV_CREATE(endless_frag, RHW_SHADER_FRAGMENT),
               1.0f);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_dispatch_without_an_end_is_given_up),
    cmocka_unit_test(test_fragments_without_an_end_are_given_up),
    cmocka_unit_test(test_vertices_without_an_end_are_given_up),
};

const struct unit_tests test_spirv_flow = UNIT_TESTS(tests, NULL, NULL);
