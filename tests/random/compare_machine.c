// SPDX-License-Identifier: MIT
// Compiles random GLSL programs, runs them on the interpreter and as generated machine code, from the same memory, and
// compares all that they leave. The environment variable RHW_JIT may ask for fewer registers.
// usage: compare_machine FOLDER FIRST COUNT VERTEX.vert
#include <glsl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "world.h"

enum { KINDS = 3 };

// Compile a text. Return NULL where there is no such file.
static rhw_shader *compile(const char *path, enum rhw_shader_stage stage)
{
    static char text[1 << 20];
    char message[RHW_SHADER_MESSAGE];
    FILE *const file = fopen(path, "rb");
    if (!file) {
        return NULL;
    }
    const size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    const struct glsl_options options = {.macros = NULL};
    struct glsl_code code;
    if (!glsl_compile(stage, text, size, path, &options, &code, message, sizeof message)) {
        fail_msg("%s: %s", path, message);
    }
    rhw_shader *const shader = create_shader(path, code.words, code.size, stage);
    glsl_code_free(&code);
    return shader;
}

static rhw_shader *compile_number(const char *folder, int number, enum rhw_shader_stage stage)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/r%d.%s", folder, number, stage == RHW_SHADER_COMPUTE ? "comp" : "frag");
    return compile(path, stage);
}

// Return how often a program leaves other bytes.
static int compare(struct stage *stage, const char *folder, int number, rhw_shader *vertex, int *left_out)
{
    static struct world worlds[2];
    rhw_shader *const compute = compile_number(folder, number, RHW_SHADER_COMPUTE);
    rhw_shader *const fragment = compute ? NULL : compile_number(folder, number, RHW_SHADER_FRAGMENT);
    struct rhw_shader_program_def def = {
        .vertex = compute ? NULL : vertex, .fragment = fragment, .compute = compute};
    char name[32];
    rhw_shader_program *generated, *interpreted;
    int flaws = 0;
    snprintf(name, sizeof name, "r%d", number);
    assert_true(compute || fragment);
    assert_int_equal(rhw_shader_program_create(&def, &generated, NULL), RHW_OK);
    def.is_interpreted = true;
    assert_int_equal(rhw_shader_program_create(&def, &interpreted, NULL), RHW_OK);
    *left_out +=
        !rhw_shader_program_is_generated(generated, compute ? RHW_SHADER_COMPUTE : RHW_SHADER_FRAGMENT);
    for (int kind = 0; kind < KINDS; kind++) {
        run_program(stage, compute ? NULL : rhw_shader_program_get(interpreted),
                    rhw_shader_program_get_compute(interpreted), interpreted, &worlds[0], kind);
        run_program(stage, compute ? NULL : rhw_shader_program_get(generated),
                    rhw_shader_program_get_compute(generated), generated, &worlds[1], kind);
        flaws += worlds_differ(name, &worlds[0], &worlds[1], "machine code") ? 1 : 0;
    }
    rhw_shader_program_destroy(generated);
    rhw_shader_program_destroy(interpreted);
    rhw_shader_destroy(compute ? compute : fragment);
    return flaws;
}

static char **arguments;

static void test_machine_code_leaves_equal_bytes(void **state)
{
    (void)state;
    static struct stage stage;
    const int first = atoi(arguments[2]), count = atoi(arguments[3]);
    int flaws = 0, left_out = 0;
    open_stage(&stage);
    rhw_shader *const vertex = compile(arguments[4], RHW_SHADER_VERTEX);
    for (int i = 0; i < count; i++) {
        flaws += compare(&stage, arguments[1], first + i, vertex, &left_out);
    }
    rhw_shader_destroy(vertex);
    rig_close(&stage.rig);
    printf("%d programs, of %d no code was generated, %d runs differ\n", count, left_out, flaws);
    assert_int_equal(flaws, 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_machine_code_leaves_equal_bytes)};
    arguments = argv;
    if (argc != 5) {
        fprintf(stderr, "usage: compare_machine FOLDER FIRST COUNT VERTEX.vert\n");
        return 1;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
