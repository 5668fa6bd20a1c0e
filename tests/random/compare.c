// SPDX-License-Identifier: MIT
// Runs random programs on the interpreter and as C, from the same memory, and compares all that they leave.
#include "compare.h"

#include <stdio.h>
#include <string.h>

#include "world.h"

static void test_programs_leave_equal_bytes(void **state)
{
    (void)state;
    static struct world worlds[2];
    static struct stage stage;
    int flaws = 0, used = 0;
    open_stage(&stage);
    rhw_shader *const vertex =
        create_shader(random_vertex.name, random_vertex.words, random_vertex.size, RHW_SHADER_VERTEX);
    for (int i = 0; i < random_count; i++) {
        const struct random_program *const one = &random_programs[i];
        rhw_shader *const shader = create_shader(one->words.name, one->words.words, one->words.size,
                                                 one->compute ? RHW_SHADER_COMPUTE : RHW_SHADER_FRAGMENT);
        const struct rhw_shader_program_def def = {.vertex = one->compute ? NULL : vertex,
                                                   .fragment = one->compute ? NULL : shader,
                                                   .compute = one->compute ? shader : NULL,
                                                   .is_interpreted = true};
        rhw_shader_program *program;
        assert_int_equal(rhw_shader_program_create(&def, &program, NULL), RHW_OK);
        const struct rhw_program *const drawn = one->compute ? NULL : rhw_shader_program_get(program);
        run_program(&stage, drawn, rhw_shader_program_get_compute(program), program, &worlds[0], 0);
        run_program(&stage, one->drawn, one->compute, program, &worlds[1], 0);
        flaws += worlds_differ(one->words.name, &worlds[0], &worlds[1], "C") ? 1 : 0;
        fill_world(&worlds[1], 0);
        used += memcmp(&worlds[0], &worlds[1], sizeof worlds[0]) != 0 ? 1 : 0;
        rhw_shader_program_destroy(program);
        rhw_shader_destroy(shader);
    }
    rhw_shader_destroy(vertex);
    rig_close(&stage.rig);
    printf("%d programs, %d of them change something, %d differ\n", random_count, used, flaws);
    assert_int_equal(flaws, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_programs_leave_equal_bytes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
