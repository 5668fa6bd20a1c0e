// SPDX-License-Identifier: MIT
// See function_rig.h.
#include "function_rig.h"

#include <rhw/bind.h>
#include <rhw/spirv.h>
#include <string.h>

#include "functions_comp.h"
#include "harness.h"

enum { GROUP = 64 };

// Dispatch `groups` workgroups of the function with these constants. Bindings are those of operands and results.
static void run(struct rig *rig, const struct rhw_shader_constant *constants, uint32_t constant_count,
                const struct rhw_binding bindings[2], uint32_t groups)
{
    struct rhw_binding set[2];
    const struct rhw_shader_frame frame = {.sets = {set}};
    const struct rhw_shader_def def = {
        .stage = RHW_SHADER_COMPUTE, .constants = constants, .constant_count = constant_count};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    rhw_shader_program *program;
    if (rhw_shader_create(functions_comp, sizeof functions_comp, &def, &shader, message) != RHW_OK ||
        rhw_shader_program_create(&(struct rhw_shader_program_def){.compute = shader}, &program, message) !=
            RHW_OK) {
        fail_msg("%s", message);
    }
    for (uint32_t b = 0; b < 2; b++) { // operands that are constants are in no set
        const int place = rhw_shader_program_find(program, 0, b);
        if (place >= 0) {
            set[place] = bindings[b];
        }
    }
    const struct rhw_dispatch_def dispatch = {.program = *rhw_shader_program_get_compute(program),
                                              .uniforms = &frame,
                                              .uniform_bytes = sizeof frame};
    assert_int_equal(rhw_dispatch(rig->context, &dispatch, groups, 1, 1), RHW_OK);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(shader);
}

void function_rig_run(int which, const float (*operands)[4], int count, bool is_given, uint32_t (*results)[4])
{
    struct rhw_binding bindings[2];
    struct rhw_shader_constant constants[] = {
        {0, (uint32_t)which}, {1, is_given ? 1 : 0}, {2, 0}, {3, 0}, {4, 0}};
    struct rig rig;
    rig_open(&rig, 4, 4);
    assert_true(
        rhw_binding_of_memory((void *)operands, (size_t)count * sizeof *operands, true, &bindings[0]));
    if (!is_given) {
        assert_true(rhw_binding_of_memory(results, (size_t)count * sizeof *results, false, &bindings[1]));
        run(&rig, constants, 2, bindings, ((uint32_t)count + GROUP - 1) / GROUP);
    }
    for (int i = 0; is_given && i < count; i++) {
        for (int c = 0; c < 3; c++) {
            memcpy(&constants[2 + c].value, &operands[i][c], sizeof(float));
        }
        assert_true(rhw_binding_of_memory(results[i], sizeof *results, false, &bindings[1]));
        run(&rig, constants, 5, bindings, 1);
    }
    rig_close(&rig);
}
