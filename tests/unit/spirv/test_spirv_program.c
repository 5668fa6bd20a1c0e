// SPDX-License-Identifier: MIT
// Modules become programs that pipelines and dispatches take: linking, layouts, reflection, and what is refused.
#include "double_comp.h"
#include "many_comp.h"
#include "narrow_only_comp.h"
#include "part_frag.h"
#include "plain_frag.h"
#include "plain_vert.h"
#include "spirv_run.h"

#define CREATE(words, stage) create(words, sizeof(words), stage)

static rhw_shader *create(const uint32_t *words, size_t size, enum rhw_shader_stage stage)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = stage};
    const enum rhw_result result = rhw_shader_create(words, size, &def, &shader, message);
    if (result != RHW_OK) {
        fail_msg("%s", message);
    }
    return shader;
}

static rhw_shader_program *link_shaders(const struct rhw_shader_program_def *def)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader_program *program;
    if (rhw_shader_program_create(def, &program, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    return program;
}

// Drawing --------------------------------------------------------------------------------------------

static const struct rig_vertex triangle[3] = {
    {{-2, -2, 0, 1}, {1, 0, 0, 1}},
    {{6, -2, 0, 1}, {1, 0, 0, 1}},
    {{-2, 6, 0, 1}, {1, 0, 0, 1}},
};

static void test_stages_are_linked_and_draw(void **state)
{
    (void)state;
    rhw_shader *const vertex = CREATE(plain_vert, RHW_SHADER_VERTEX);
    rhw_shader *const fragment = CREATE(plain_frag, RHW_SHADER_FRAGMENT);
    rhw_shader_program *const program =
        link_shaders(&(struct rhw_shader_program_def){.vertex = vertex, .fragment = fragment});
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
    const float tint[4] = {0.5f, 1, 1, 1}, scale = 1;
    struct rhw_binding set[1];
    assert_int_equal(rhw_shader_program_find(program, 0, 1), 0);
    assert_int_equal(rhw_shader_program_set_size(program, 0), 1);
    assert_true(rhw_binding_of_memory((void *)tint, sizeof tint, true, &set[0]));
    const struct rhw_shader_frame frame = {
        .sets = {set}, .push_constants = &scale, .push_size = sizeof scale};

    struct rig rig;
    rig_open(&rig, 8, 8);
    spirv_draw(&rig, program, triangle, 3, &frame);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 64; i++) {
        assert_memory_equal(pixels[i], ((const float[4]){0.5f, 0, 0.25f, 1}), sizeof *pixels);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// Components that no text sets: those it names are 0, others are 0 but for alpha, which is 1.
static void test_colors_are_complete(void **state)
{
    (void)state;
    static const uint32_t whole[4] = {7, 8, 0, 1};
    rhw_shader *const vertex = CREATE(plain_vert, RHW_SHADER_VERTEX);
    rhw_shader *const fragment = CREATE(part_frag, RHW_SHADER_FRAGMENT);
    rhw_shader_program *const program =
        link_shaders(&(struct rhw_shader_program_def){.vertex = vertex, .fragment = fragment});
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
    const float scale = 1;
    const struct rhw_shader_frame frame = {.push_constants = &scale, .push_size = sizeof scale};
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA32_UINT);
    rig_set_target(&rig, 2, RHW_FORMAT_RGBA32_FLOAT);
    spirv_draw(&rig, program, triangle, 3, &frame);
    assert_memory_equal(rig_read_float4(&rig)[9], ((const float[4]){1, 0, 0, 1}), 16);
    assert_memory_equal((const uint32_t *)rig_read(&rig, rig.pass.colors[1].texture) + 36, whole,
                        sizeof whole);
    assert_memory_equal((const float *)rig_read(&rig, rig.pass.colors[2].texture) + 36, ((const float[4]){0}),
                        16);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// Compute --------------------------------------------------------------------------------------------

// Each lane of every group reads the buffer that it names itself.
static void test_lanes_name_their_buffers(void **state)
{
    (void)state;
    enum { MANY = 64 };
    uint32_t numbers[MANY], sink[MANY] = {0};
    struct rhw_binding set[MANY + 1];
    rhw_shader *const shader = CREATE(many_comp, RHW_SHADER_COMPUTE);
    rhw_shader_program *const program = link_shaders(&(struct rhw_shader_program_def){.compute = shader});
    for (uint32_t i = 0; i < MANY; i++) {
        numbers[i] = 1000 + i * i;
        assert_true(rhw_binding_of_memory(&numbers[i], sizeof numbers[i], true, &set[i]));
    }
    assert_true(rhw_binding_of_memory(sink, sizeof sink, false, &set[MANY]));
    const struct rhw_shader_frame frame = {.sets = {set}};
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_dispatch_def dispatch = {.program = *rhw_shader_program_get_compute(program),
                                              .uniforms = &frame,
                                              .uniform_bytes = sizeof frame};
    assert_int_equal(rhw_dispatch(rig.context, &dispatch, 1, 1, 1), RHW_OK);
    assert_memory_equal(sink, numbers, sizeof sink);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(shader);
}

static void test_compute_is_specialized_and_runs(void **state)
{
    (void)state;
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_constant constants[] = {
        {.id = 7, .value = 24}, {.id = 3, .value = 5}, {.id = 99, .value = 1}};
    const struct rhw_shader_def def = {
        .stage = RHW_SHADER_COMPUTE, .constants = constants, .constant_count = 2};
    assert_int_equal(rhw_shader_create(double_comp, sizeof double_comp, &def, &shader, message), RHW_OK);
    rhw_shader_program *const program = link_shaders(&(struct rhw_shader_program_def){.compute = shader});
    assert_int_equal(rhw_shader_program_get_compute(program)->size[0], 24);
    uint32_t source[50], sink[60];
    for (uint32_t i = 0; i < 50; i++) {
        source[i] = i + 1;
    }
    memset(sink, 0xff, sizeof sink);
    struct rhw_binding first, second;
    assert_true(rhw_binding_of_memory(source, sizeof source, true, &first));
    assert_true(rhw_binding_of_memory(sink, sizeof sink, false, &second));
    const struct rhw_shader_frame frame = {.sets = {&first, &second}};
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_dispatch_def dispatch = {.program = *rhw_shader_program_get_compute(program),
                                              .uniforms = &frame,
                                              .uniform_bytes = sizeof frame};
    assert_int_equal(rhw_dispatch(rig.context, &dispatch, 3, 1, 1), RHW_OK);
    for (uint32_t i = 0; i < 60; i++) {
        assert_int_equal(sink[i], i < 50 ? 5 * (i + 1) : UINT32_MAX);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(shader);
}

// Reflection -----------------------------------------------------------------------------------------

static void test_reflection_names_resources_and_variables(void **state)
{
    (void)state;
    rhw_shader *const shader = CREATE(double_comp, RHW_SHADER_COMPUTE);
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    assert_int_equal(info->resource_count, 2);
    assert_int_equal(info->resources[1].kind, RHW_SHADER_STORAGE_BUFFER);
    assert_int_equal(info->resources[1].set, 1);
    assert_int_equal(info->resources[1].binding, 2);
    rhw_shader_destroy(shader);
    rhw_shader *const vertex = CREATE(plain_vert, RHW_SHADER_VERTEX);
    const struct rhw_shader_info *const inputs = rhw_shader_get_info(vertex);
    assert_int_equal(inputs->input_count, 2);
    assert_string_equal(inputs->inputs[1].name, "value");
    assert_int_equal(inputs->inputs[1].components, 4);
    assert_int_equal(inputs->output_count, 1);
    assert_int_equal(inputs->push_size, 4);
    rhw_shader_destroy(vertex);
}

static void test_reflection_tells_what_is_written(void **state)
{
    (void)state;
    rhw_shader *const shader = CREATE(narrow_only_comp, RHW_SHADER_COMPUTE);
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    assert_int_equal(info->resource_count, 2);
    assert_false(info->resources[0].is_read_only);
    assert_true(info->resources[1].is_read_only);
    rhw_shader_destroy(shader);
}

// Refusals -------------------------------------------------------------------------------------------

static void expect_refused(const uint32_t *words, size_t size, const char *entry_point, const char *part)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT, .entry_point = entry_point};
    assert_int_equal(rhw_shader_create(words, size, &def, &shader, message), RHW_ERROR_MISUSE);
    assert_null(shader);
    if (!strstr(message, part)) {
        fail_msg("\"%s\" has no \"%s\"", message, part);
    }
}

static void test_what_is_wrong_is_named(void **state)
{
    (void)state;
    expect_refused(plain_frag, sizeof plain_frag, "other", "\"other\"");
    expect_refused(plain_frag, sizeof plain_frag - 1, NULL, "whole words");
    expect_refused(plain_frag, 16, NULL, "5 at least");
    expect_refused(plain_frag, (size_t)(RHW_SHADER_MAX_WORDS + 1) * 4, NULL, "RHW_SHADER_MAX_WORDS");
    expect_refused(plain_vert, sizeof plain_vert, NULL, "no fragment entry point");
    expect_refused((const uint32_t *)(const void *)triangle, sizeof triangle, NULL, "magic");
}

static void test_words_may_be_swapped(void **state)
{
    (void)state;
    uint32_t words[sizeof plain_frag / sizeof *plain_frag];
    for (size_t i = 0; i < sizeof plain_frag / sizeof *plain_frag; i++) {
        words[i] = __builtin_bswap32(plain_frag[i]);
    }
    rhw_shader_destroy(CREATE(words, RHW_SHADER_FRAGMENT));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_stages_are_linked_and_draw),
    cmocka_unit_test(test_colors_are_complete),
    cmocka_unit_test(test_lanes_name_their_buffers),
    cmocka_unit_test(test_reflection_tells_what_is_written),
    cmocka_unit_test(test_compute_is_specialized_and_runs),
    cmocka_unit_test(test_reflection_names_resources_and_variables),
    cmocka_unit_test(test_what_is_wrong_is_named),
    cmocka_unit_test(test_words_may_be_swapped),
};

const struct unit_tests test_spirv_program = UNIT_TESTS(tests, NULL, NULL);
