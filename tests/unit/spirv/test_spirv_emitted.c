// SPDX-License-Identifier: MIT
// What becomes of a program as C: which back end a test draws with, and what is refused. Every test of this folder runs on
// both back ends (emitted.h).
#include <stdlib.h>

#include "emitted.h"
#include "spirv_run.h"
#include "turns_comp.h"

static bool is_asked_for(void)
{
    const char *const back_end = getenv("RHW_TEST_BACK_END");
    return back_end && strcmp(back_end, "c") == 0;
}

// The first branch changes the variable that chose it.
static void test_a_branch_may_change_its_condition(void **state)
{
    (void)state;
    struct rig rig;
    uint32_t own[8];
    const int before = emitted_count();
    rhw_shader_program *const program = spirv_link(NULL, NULL, SPIRV_CREATE(turns_comp, RHW_SHADER_COMPUTE));
    for (uint32_t i = 0; i < 8; i++) {
        own[i] = i;
    }
    rig_open(&rig, 4, 4);
    const struct rhw_binding set = spirv_memory(own, sizeof own);
    const struct rhw_shader_frame frame = {.sets = {&set}};
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    for (uint32_t i = 0; i < 8; i++) {
        assert_int_equal(own[i], i % 2 == 1 ? 16 * 3 + 2 : 16 * 2 + 3);
    }
    assert_int_equal(emitted_count() - before, is_asked_for() ? 1 : 0);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_names_are_identifiers(void **state)
{
    (void)state;
    static const char *const names[] = {"", "2d", "a-b", "a b", "é", NULL};
    rhw_shader_program *const program = spirv_link(NULL, NULL, SPIRV_CREATE(turns_comp, RHW_SHADER_COMPUTE));
    char message[RHW_SHADER_MESSAGE], *text;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct rhw_shader_c_def def = {.name = names[i]};
        assert_int_equal(rhw_shader_program_emit_c(program, &def, &text, message), RHW_ERROR_MISUSE);
        assert_null(text);
        assert_non_null(strstr(message, "identifier"));
    }
    rhw_shader_program_destroy(program);
}

static void test_comments_cannot_be_left(void **state)
{
    (void)state;
    rhw_shader_program *const program = spirv_link(NULL, NULL, SPIRV_CREATE(turns_comp, RHW_SHADER_COMPUTE));
    const struct rhw_shader_c_def def = {.name = "x1", .source = "turns\\\n#error .comp"};
    char *text;
    assert_int_equal(rhw_shader_program_emit_c(program, &def, &text, NULL), RHW_OK);
    assert_non_null(strstr(text, "// x1 of turns__#error .comp"));
    assert_non_null(strstr(text, "const struct rhw_compute_program x1_program = {"));
    rhw_shader_free_text(text);
    rhw_shader_free_text(NULL);
    rhw_shader_program_destroy(program);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_branch_may_change_its_condition),
    cmocka_unit_test(test_names_are_identifiers),
    cmocka_unit_test(test_comments_cannot_be_left),
};

const struct unit_tests test_spirv_emitted = UNIT_TESTS(tests, NULL, NULL);
