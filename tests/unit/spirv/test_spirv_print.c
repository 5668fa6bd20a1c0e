// SPDX-License-Identifier: MIT
// Translations are printed beside their source.
#include <glsl.h>
#include <rhw/spirv.h>
#include <string.h>

#include "harness.h"

static char printed[1 << 14];

static void keep(void *user, const char *text, size_t size)
{
    size_t *const length = user;
    assert_true(*length + size < sizeof printed);
    memcpy(printed + *length, text, size);
    *length += size;
    printed[*length] = 0;
}

static void print(const char *text, enum rhw_shader_stage stage, enum rhw_shader_stop stop)
{
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    if (!glsl_is_there()) {
        skip();
    }
    if (!glsl_compile(stage, text, strlen(text), "x.frag", &(struct glsl_options){.has_lines = true}, &code,
                      message, sizeof message)) {
        fail_msg("%s", message);
    }
    size_t length = 0;
    const struct rhw_shader_def def = {.stage = stage};
    if (rhw_shader_print(code.words, code.size, &def, stop, keep, &length, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    glsl_code_free(&code);
}

// Check that parts stand in what was printed, in this order.
static void expect_order(const char *const *parts, int count)
{
    const char *at = printed;
    for (int i = 0; i < count; i++) {
        const char *const found = strstr(at, parts[i]);
        if (found == NULL) {
            fail_msg("\"%s\" does not come where it should in:\n%s", parts[i], printed);
        }
        at = found + strlen(parts[i]);
    }
}

static const char text[] = "layout(location = 0) in vec3 normal;\n"
                           "layout(location = 0) out vec4 color;\n"
                           "layout(set = 2, binding = 5) uniform Light { float tint; } light;\n"
                           "void main()\n"
                           "{\n"
                           "    vec2 sum = vec2(0);\n"
                           "    for (int i = 0; i < 6; i++) {\n"
                           "        if (normal.y > 0.25) {\n"
                           "            sum.y += normal.x * light.tint;\n"
                           "        }\n"
                           "    }\n"
                           "    color = vec4(sum, 1, gl_FragCoord.z);\n"
                           "}\n";

static void test_the_form_stands_beside_its_source(void **state)
{
    (void)state;
    static const char *const parts[] = {
        "; fragment shader main, ",
        " = input normal.x\n",
        " = resource light (set 2, binding 5)\n",
        "\n; x.frag:6  vec2 sum = vec2(0);\n",
        "; x.frag:7  for (int i = 0; i < 6; i++) {\n",
        " = loop\n    ",
        ".i 6\n",
        "; x.frag:8  if (normal.y > 0.25) {\n",
        " = fless 0.25 v",
        "            ; x.frag:9  sum.y += normal.x * light.tint;\n            u",
        " = load u",
        "[0]\n",
        "            set h",
        ".sum.y v",
        "        end_if\n",
        "\nend_loop\n",
        "\noutput color.z 1.0\n"};
    print(text, RHW_SHADER_FRAGMENT, RHW_SHADER_PASSED);
    expect_order(parts, sizeof parts / sizeof *parts);
}

static void test_the_form_is_printed_before_its_passes(void **state)
{
    (void)state;
    static const char *const parts[] = {"; fragment shader main, ", "\nv", " = load v", "end_loop\n"};
    print(text, RHW_SHADER_FRAGMENT, RHW_SHADER_BUILT);
    expect_order(parts, sizeof parts / sizeof *parts);
}

static void test_instructions_have_registers(void **state)
{
    (void)state;
    static const char *const parts[] = {"; ",
                                        " instructions, ",
                                        " groups of 8 lanes at a time\n",
                                        "  input              r",
                                        " normal.x\n",
                                        "  loop ",
                                        " mask r",
                                        "  load               u",
                                        " light (set 2, binding 5)",
                                        "  output             color.w r",
                                        "  end "};
    print(text, RHW_SHADER_FRAGMENT, RHW_SHADER_ASSEMBLED);
    expect_order(parts, sizeof parts / sizeof *parts);
}

static void test_what_lanes_do_together_has_names(void **state)
{
    (void)state;
    static const char together[] = "#extension GL_KHR_shader_subgroup_arithmetic : enable\n"
                                   "layout(local_size_x = 8) in;\n"
                                   "layout(binding = 0) buffer B { uint b[]; };\n"
                                   "layout(binding = 1, r32ui) uniform uimage2D image;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    uint i = gl_LocalInvocationIndex;\n"
                                   "    b[9] = atomicCompSwap(b[3], i, 7u) + imageAtomicMin(image, ivec2(1, "
                                   "2), i) + subgroupExclusiveAdd(i);\n"
                                   "}\n";
    static const char *const parts[] = {" = atomic_compare_exchange u", "[12] 7 where v",
                                        " = image_atomic_min_uint u", "[1 2 0] v",
                                        " = scan_iadd exclusive of 8 lanes v"};
    print(together, RHW_SHADER_COMPUTE, RHW_SHADER_PASSED);
    expect_order(parts, sizeof parts / sizeof *parts);
}

// Print the machine code of a compute shader, and expect its parts.
static void expect_code(const char *source, const char *const *parts, int count)
{
    char message[RHW_SHADER_MESSAGE];
    size_t length = 0;
    rhw_shader *shader;
    rhw_shader_program *program;
    struct glsl_code code;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE};
    if (!glsl_is_there()) {
        skip();
    }
    assert_true(glsl_compile(RHW_SHADER_COMPUTE, source, strlen(source), "x.frag",
                             &(struct glsl_options){.has_lines = true}, &code, message, sizeof message));
    assert_int_equal(rhw_shader_create(code.words, code.size, &def, &shader, message), RHW_OK);
    glsl_code_free(&code);
    const struct rhw_shader_program_def linked = {.compute = shader};
    assert_int_equal(rhw_shader_program_create(&linked, &program, message), RHW_OK);
    rhw_shader_destroy(shader);
    assert_int_equal(rhw_shader_program_print_code(program, RHW_SHADER_COMPUTE, keep, &length, message),
                     RHW_OK);
    expect_order(parts, count);
    length = 0;
    assert_int_equal(rhw_shader_program_print_code(program, RHW_SHADER_VERTEX, keep, &length, message),
                     RHW_ERROR_MISUSE);
    assert_int_equal(length, 0);
    rhw_shader_program_destroy(program);
}

static void test_machine_code_stands_beside_its_source(void **state)
{
    (void)state;
    static const char twice[] = "layout(local_size_x = 8) in;\n"
                                "layout(binding = 0) buffer B { float b[]; };\n"
                                "void main()\n"
                                "{\n"
                                "    float one = b[gl_GlobalInvocationID.x];\n"
                                "    b[gl_GlobalInvocationID.x] = one < 7.5 ? sin(one) : one * 2.5;\n"
                                "}\n";
    static const char *const parts[] = {" bytes of code, ",
                                        "\nL0:\n",
                                        "\n; x.frag:5  float one = ",
                                        " = load u",
                                        "\n; x.frag:6  b[gl_GlobalInvocationID.x] = one < 7.5",
                                        "  vmulps ymm",
                                        " = fmul v",
                                        " 2.5\n",
                                        "  vzeroupper\n",
                                        "  ret\n",
                                        "  push rbp\n",
                                        "  jmp L0\n"};
    expect_code(twice, parts, sizeof parts / sizeof *parts);
}

// The second function would wait for the first, so all groups go through that before one call computes it for all.
static void test_a_chain_of_functions_is_taken_in_steps(void **state)
{
    (void)state;
    static const char chain[] = "layout(local_size_x = 64) in;\n"
                                "layout(binding = 0) buffer B { float b[]; };\n"
                                "void main() {\n"
                                "    float x = b[gl_LocalInvocationIndex];\n"
                                "    b[gl_LocalInvocationIndex] = sin(exp(log(x))) + x;\n"
                                "}\n";
    static const char *const parts[] = {" = log v", "  jne L",      " = exp v", "call qword",
                                        " = sin v", "  vaddps ymm", "  jne L"};
    expect_code(chain, parts, sizeof parts / sizeof *parts);
}

// The counter is compared once a round, between the loops over groups, which stand in the loop of the text.
static void test_a_loop_that_all_leave_together_has_steps(void **state)
{
    (void)state;
    static const char loop[] = "layout(local_size_x = 64) in;\n"
                               "layout(binding = 0) buffer B { float b[]; };\n"
                               "layout(binding = 1) uniform U { int rounds; };\n"
                               "void main() {\n"
                               "    float x = b[gl_LocalInvocationIndex];\n"
                               "    for (int i = 0; i < rounds; i++) {\n"
                               "        if (x > 0.5) { x = exp2(x * log2(x)); }\n"
                               "    }\n"
                               "    b[gl_LocalInvocationIndex] = x;\n"
                               "}\n";
    static const char *const parts[] = {" = iless h",      "  je L",   " = fless ", "  vmovmskps e",
                                        "  jne L",         " = log2 ", " = exp2 v", "call qword",
                                        "  vblendvps ymm", "  jne L",  " = iadd h", "  jmp L",
                                        "  vzeroupper\n"};
    expect_code(loop, parts, sizeof parts / sizeof *parts);
}

static void test_nothing_is_printed_of_what_is_refused(void **state)
{
    (void)state;
    char message[RHW_SHADER_MESSAGE];
    size_t length = 0;
    const uint32_t words[5] = {1, 2, 3, 4, 5};
    const struct rhw_shader_def def = {.stage = RHW_SHADER_VERTEX};
    assert_int_equal(rhw_shader_print(words, sizeof words, &def, RHW_SHADER_PASSED, keep, &length, message),
                     RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "magic number"));
    assert_int_equal(rhw_shader_print(words, 3, &def, RHW_SHADER_PASSED, keep, &length, message),
                     RHW_ERROR_MISUSE);
    assert_int_equal(length, 0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_form_stands_beside_its_source),
    cmocka_unit_test(test_the_form_is_printed_before_its_passes),
    cmocka_unit_test(test_instructions_have_registers),
    cmocka_unit_test(test_what_lanes_do_together_has_names),
    cmocka_unit_test(test_machine_code_stands_beside_its_source),
    cmocka_unit_test(test_a_chain_of_functions_is_taken_in_steps),
    cmocka_unit_test(test_a_loop_that_all_leave_together_has_steps),
    cmocka_unit_test(test_nothing_is_printed_of_what_is_refused),
};

const struct unit_tests test_spirv_print = UNIT_TESTS(tests, NULL, NULL);
