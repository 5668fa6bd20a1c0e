// SPDX-License-Identifier: MIT
// GLSL texts become modules that librhw-shader takes. What is wrong is told in lines that name file and line.
#include <glsl.h>
#include <math.h>
#include <pthread.h>
#include <rhw/shader.h>
#include <rhw/spirv.h>
#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "sanitizer.h"

static const char name[] = "folder/x.frag";

static void need_glslang(void)
{
    if (!glsl_is_there()) {
        skip();
    }
}

static bool compile(const char *text, const struct glsl_options *options, struct glsl_code *code,
                    char *message)
{
    return glsl_compile(RHW_SHADER_FRAGMENT, text, strlen(text), name, options, code, message,
                        RHW_SHADER_MESSAGE);
}

// Compile a text, and translate it.
static void expect_shader(const char *text, const struct glsl_options *options)
{
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    if (!compile(text, options, &code, message)) {
        fail_msg("%s", message);
    }
    assert_string_equal(code.log, "");
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT};
    if (rhw_shader_create(code.words, code.size, &def, &shader, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    rhw_shader_destroy(shader);
    glsl_code_free(&code);
}

static void expect_error(const char *text, const struct glsl_options *options, const char *expected)
{
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    assert_false(compile(text, options, &code, message));
    assert_string_equal(message, expected);
    assert_null(code.words);
    glsl_code_free(&code);
}

static void test_a_text_becomes_a_shader(void **state)
{
    (void)state;
    need_glslang();
    expect_shader("layout(location = 0) out vec4 c; void main() { c = vec4(1); }", NULL);
    expect_shader("#version 310 es\nprecision highp float;\nlayout(location = 0) out vec4 c;\n"
                  "void main() { c = vec4(1); }",
                  NULL);
}

static void test_errors_have_their_lines(void **state)
{
    (void)state;
    need_glslang();
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    assert_false(compile("void main()\n{\n    foo = 1;\n    bar(2);\n}\n", NULL, &code, message));
    assert_string_equal(message, "folder/x.frag:3: 'foo' : undeclared identifier");
    assert_non_null(strstr(code.log, "folder/x.frag:4: 'bar' : no matching overloaded function found"));
    glsl_code_free(&code);
    expect_error(
        "void mian() {}", NULL,
        "folder/x.frag: Linking fragment stage: Missing entry point: Each stage requires one entry point");
    expect_error("#version 110\nvoid main() {}", NULL,
                 "folder/x.frag: #version: Desktop shaders for Vulkan SPIR-V require version 140 or higher");
    expect_error(
        "#include \"y.glsl\"\nvoid main() {}", NULL,
        "folder/x.frag:1: '#include' : this text has no file to include from for header name: y.glsl");
}

static void test_warnings_are_told_with_code(void **state)
{
    (void)state;
    need_glslang();
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    assert_true(compile("#extension GL_none : enable\nvoid main() {}", NULL, &code, message));
    assert_string_equal(code.log,
                        "folder/x.frag:1: warning: '#extension' : extension not supported: GL_none\n");
    glsl_code_free(&code);
}

static void test_macros_are_defined(void **state)
{
    (void)state;
    need_glslang();
    static const char text[] = "#ifndef TWICE\n#error TWICE is missing\n#endif\n"
                               "layout(location = 0) out vec4 c; void main() { c = vec4(HALF * 2.0); }";
    const struct glsl_macro macros[] = {{"HALF", "0.5"}, {"TWICE", NULL}};
    expect_shader(text, &(struct glsl_options){.macros = macros, .macro_count = 2});
    expect_error(text, &(struct glsl_options){.macros = macros, .macro_count = 1},
                 "folder/x.frag:2: '#error' : TWICE is missing");
    static const struct glsl_macro wrong[] = {
        {"2", NULL}, {"", NULL}, {"A B", NULL}, {"GL_A", NULL}, {"A__B", NULL}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char message[RHW_SHADER_MESSAGE];
        struct glsl_code code;
        assert_false(
            compile(text, &(struct glsl_options){.macros = &wrong[i], .macro_count = 1}, &code, message));
        assert_non_null(strstr(message, "cannot be defined"));
        glsl_code_free(&code);
    }
    expect_error(text,
                 &(struct glsl_options){.macros = &(struct glsl_macro){"A", "1\n#error"}, .macro_count = 1},
                 "the value of 'A' has a line break or a backslash");
}

static void test_relaxed_uniforms_make_a_block(void **state)
{
    (void)state;
    need_glslang();
    static const char text[] =
        "uniform float time; layout(location = 0) out vec4 c; void main() { c = vec4(time); }";
    expect_shader(text, &(struct glsl_options){.is_relaxed = true});
    expect_error(
        text, NULL,
        "folder/x.frag:1: 'non-opaque uniforms outside a block' : not allowed when using GLSL for Vulkan");
}

static void test_lines_before_a_text_are_none_of_it(void **state)
{
    (void)state;
    need_glslang();
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    const struct glsl_options options = {.before = "float part() { return 0.5; }", .is_relaxed = true};
    assert_true(compile("#version 450\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(part()); }",
                        &options, &code, message));
    assert_false(code.is_relaxed); // nothing is missing
    glsl_code_free(&code);
    expect_error("void main() { c = 1; }", &options, "folder/x.frag:1: 'c' : undeclared identifier");
}

static void test_errors_about_no_word_are_short(void **state)
{
    (void)state;
    need_glslang();
    expect_error("void main() { int }", NULL,
                 "folder/x.frag:1: syntax error, unexpected RIGHT_BRACE, expecting COMMA or SEMICOLON");
}

// Files, as a caller has them: each includes the one of the next number.
static const char *give(void *user, struct glsl_include *include)
{
    int *const left = user;
    if (--*left < 0) {
        return "this is enough";
    }
    char text[128];
    if (*left > 0) {
        snprintf(text, sizeof text, "#include <%d.glsl>\n", *left);
    } else {
        snprintf(text, sizeof text, "float f() { return x; }\n");
    }
    include->name = strdup(include->header);
    include->text = strdup(text);
    include->size = strlen(text);
    return NULL;
}

static void test_includes_are_asked_for(void **state)
{
    (void)state;
    need_glslang();
    static const char text[] = "#include \"first.glsl\"\nvoid main() {}";
    int left = 3;
    const struct glsl_options options = {.include = give, .user = &left};
    expect_error(text, &options, "1.glsl:1: 'x' : undeclared identifier");
    assert_int_equal(left, 3); // it counts in the process that compiles
    left = 0;
    expect_error(text, &options, "folder/x.frag:1: '#include' : this is enough for header name: first.glsl");
    left = 1000;
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    assert_false(compile(text, &options, &code, message));
    assert_non_null(strstr(message, "more than 32 files include each other"));
    glsl_code_free(&code);
}

// 0.1 is an angle whose sine differs in the last bit from what is nearest.
static void test_constants_are_what_shaders_compute(void **state)
{
    (void)state;
    need_glslang();
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    assert_true(compile("layout(location = 0) out vec4 c; void main() { c = vec4(sin(0.1)); }", NULL, &code,
                        message));
    const float sine = rhw_sin1(0.1f);
    assert_true(sine != (float)sin(0.1));
    bool found = false;
    for (size_t i = 0; i < code.size / sizeof *code.words; i++) {
        found = found || memcmp(&code.words[i], &sine, sizeof sine) == 0;
    }
    assert_true(found);
    glsl_code_free(&code);
}

// The last of 100,000 sums stands 100,000 deep in the tree of the compiler, which walks trees by recursion.
static void test_crashes_are_told(void **state)
{
    (void)state;
    need_glslang();
    enum { SUMS = 100000 };
    static char text[2 * SUMS + 128];
    size_t length = (size_t)snprintf(text, sizeof text, "void main() { float x = gl_FragCoord.x; x = x");
    for (int i = 0; i < SUMS; i++) {
        memcpy(text + length, "+x", 2);
        length += 2;
    }
    snprintf(text + length, sizeof text - length, "; }");
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    if (!compile(text, NULL, &code, message)) {
        assert_non_null(strstr(message, "folder/x.frag: "));
    }
    glsl_code_free(&code);
}

static void *compile_often(void *failed)
{
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    for (int i = 0; i < 4; i++) {
        if (!compile("layout(location = 0) out vec4 c; void main() { c = vec4(1); }", NULL, &code, message)) {
            *(bool *)failed = true;
        }
        glsl_code_free(&code);
    }
    return NULL;
}

// A sanitizer's memory stays locked in a child that is made while another thread takes some.
static void test_threads_compile_at_a_time(void **state)
{
    (void)state;
    need_glslang();
    if (SYSTEM_SANITIZED) {
        skip();
    }
    enum { THREADS = 4 };
    pthread_t threads[THREADS];
    bool failed[THREADS] = {0};
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, compile_often, &failed[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        assert_false(failed[i]);
    }
}

static void test_fragments_have_no_shuffle(void **state)
{
    (void)state;
    static const char text[] = "#extension GL_KHR_shader_subgroup_shuffle : require\n"
                               "layout(location = 0) in vec4 color;\n"
                               "layout(location = 0) out vec4 target;\n"
                               "void main()\n"
                               "{\n"
                               "    target = subgroupShuffleXor(color, 1u);\n"
                               "}\n";
    char message[RHW_SHADER_MESSAGE];
    struct glsl_code code;
    rhw_shader *shader;
    need_glslang();
    if (!compile(text, NULL, &code, message)) {
        fail_msg("%s", message);
    }
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT};
    assert_int_equal(rhw_shader_create(code.words, code.size, &def, &shader, message), RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "no subgroup operation but elect"));
    glsl_code_free(&code);
}

// Without glslang every text is refused.
static void test_absence_is_told(void **state)
{
    (void)state;
    if (glsl_is_there()) {
        skip();
    }
    expect_error("void main() {}", NULL,
                 "folder/x.frag: this rhw was built without glslang, so it reads SPIR-V alone");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_text_becomes_a_shader),
    cmocka_unit_test(test_errors_have_their_lines),
    cmocka_unit_test(test_errors_about_no_word_are_short),
    cmocka_unit_test(test_warnings_are_told_with_code),
    cmocka_unit_test(test_macros_are_defined),
    cmocka_unit_test(test_relaxed_uniforms_make_a_block),
    cmocka_unit_test(test_lines_before_a_text_are_none_of_it),
    cmocka_unit_test(test_includes_are_asked_for),
    cmocka_unit_test(test_constants_are_what_shaders_compute),
    cmocka_unit_test(test_crashes_are_told),
    cmocka_unit_test(test_threads_compile_at_a_time),
    cmocka_unit_test(test_fragments_have_no_shuffle),
    cmocka_unit_test(test_absence_is_told),
};

const struct unit_tests test_glsl = UNIT_TESTS(tests, NULL, NULL);
