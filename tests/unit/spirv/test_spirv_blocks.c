// SPDX-License-Identifier: MIT
// Reflection tells what images are, which constants are chosen, and what stands where in blocks: offsets and strides of std140 and std430, as the
// GLSL text asks for them.
#include <rhw/spirv.h>
#include <string.h>

#include "blocks_frag.h"
#include "harness.h"

static rhw_shader *shader;
static const struct rhw_shader_info *info;

static int create_shader(void **state)
{
    (void)state;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT};
    const enum rhw_result result = rhw_shader_create(blocks_frag, sizeof blocks_frag, &def, &shader, NULL);
    info = result == RHW_OK ? rhw_shader_get_info(shader) : NULL;
    return result == RHW_OK ? 0 : -1;
}

static int destroy_shader(void **state)
{
    (void)state;
    rhw_shader_destroy(shader);
    return 0;
}

// Return the type of a member, which stands at `offset`.
static const struct rhw_shader_type *member_at(const struct rhw_shader_type *type, uint32_t number,
                                               const char *name, uint32_t offset)
{
    assert_true(type->kind == RHW_SHADER_STRUCT && number < type->count);
    assert_string_equal(type->members[number].name, name);
    assert_int_equal(type->members[number].offset, offset);
    return type->members[number].type;
}

static void expect_number(const struct rhw_shader_type *type, enum rhw_shader_type_kind kind, uint32_t rows,
                          uint32_t columns)
{
    assert_int_equal(type->kind, kind);
    assert_int_equal(type->bits, 32);
    assert_int_equal(type->rows, rows);
    assert_int_equal(type->columns, columns);
}

static void test_uniform_block(void **state)
{
    (void)state;
    const struct rhw_shader_resource *const scene = &info->resources[0];
    assert_string_equal(scene->name, "scene");
    assert_true(scene->is_read_only);
    const struct rhw_shader_type *const type = scene->type;
    assert_string_equal(type->name, "Scene");
    assert_int_equal(type->count, 6);
    assert_int_equal(scene->size, type->size);
    const struct rhw_shader_type *const view = member_at(type, 0, "view", 0);
    expect_number(view, RHW_SHADER_FLOAT, 4, 4);
    assert_int_equal(view->stride, 16);
    assert_false(view->is_row_major);
    const struct rhw_shader_type *const turn = member_at(type, 1, "turn", 64);
    expect_number(turn, RHW_SHADER_FLOAT, 2, 3);
    assert_true(turn->is_row_major);
    assert_int_equal(turn->stride, 16);
    assert_int_equal(turn->size, 16 + 12);
    expect_number(member_at(type, 2, "eye", 96), RHW_SHADER_FLOAT, 3, 1);
    expect_number(member_at(type, 3, "time", 108), RHW_SHADER_FLOAT, 1, 1);
    const struct rhw_shader_type *const lights = member_at(type, 4, "lights", 112);
    assert_int_equal(lights->kind, RHW_SHADER_ARRAY);
    assert_int_equal(lights->count, 3);
    assert_int_equal(lights->stride, 16);
    assert_string_equal(lights->element->name, "Light");
    expect_number(member_at(lights->element, 1, "power", 12), RHW_SHADER_FLOAT, 1, 1);
    const struct rhw_shader_type *const flags = member_at(type, 5, "flags", 160);
    assert_int_equal(flags->stride, 16);
    expect_number(flags->element, RHW_SHADER_UINT, 1, 1);
    assert_int_equal(type->size, 160 + 16 + 4);
}

static void test_storage_blocks_and_push_constants(void **state)
{
    (void)state;
    assert_int_equal(info->resource_count, 5);
    const struct rhw_shader_resource *const weights = &info->resources[1], *const sink = &info->resources[2];
    assert_string_equal(weights->name, "Weights"); // the block, as it has no other name
    assert_true(weights->is_read_only);
    assert_int_equal(weights->size, 4);
    expect_number(member_at(weights->type, 0, "count", 0), RHW_SHADER_INT, 1, 1);
    const struct rhw_shader_type *const array = member_at(weights->type, 1, "weights", 4);
    assert_int_equal(array->count, 0);
    assert_int_equal(array->stride, 4);
    assert_false(sink->is_read_only);
    expect_number(member_at(sink->type, 0, "seen", 0)->element, RHW_SHADER_INT, 2, 1);
    expect_number(member_at(info->push_type, 0, "shift", 16), RHW_SHADER_FLOAT, 2, 1);
    assert_int_equal(info->push_type->size, 24);
    assert_int_equal(info->push_size, 24);
}

static void test_images(void **state)
{
    (void)state;
    const struct rhw_shader_resource *const layers = &info->resources[3];
    assert_string_equal(layers->name, "layers");
    assert_int_equal(layers->texture_kind, RHW_TEXTURE_2D);
    assert_true(layers->is_array && layers->is_integer && layers->is_read_only);
    assert_false(layers->is_multisampled);
    assert_null(layers->type);
    assert_false(layers->is_signed || layers->is_depth);
    assert_int_equal(layers->format, 0);
    const struct rhw_shader_resource *const store = &info->resources[4];
    assert_true(store->is_integer && store->is_signed);
    assert_int_equal(store->format, 26); // Rg16i
}

static void test_constants(void **state)
{
    (void)state;
    const float half = 0.5f;
    uint32_t bits;
    memcpy(&bits, &half, sizeof bits);
    const struct rhw_shader_constant_info expected[] = {
        {.id = 2, .kind = RHW_SHADER_UINT, .is_bool = true, .bits = 32, .value = 1, .name = "IS_ON"},
        {.id = 5, .kind = RHW_SHADER_INT, .bits = 32, .value = (uint32_t)-3, .name = "MOST"},
        {.id = 7, .kind = RHW_SHADER_FLOAT, .bits = 32, .value = bits, .name = "SCALE"}};
    assert_int_equal(info->constant_count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        const struct rhw_shader_constant_info *const one = &info->constants[i], *const other = &expected[i];
        assert_string_equal(one->name, other->name);
        assert_int_equal(one->id, other->id);
        assert_int_equal(one->kind, other->kind);
        assert_int_equal(one->is_bool, other->is_bool);
        assert_int_equal(one->bits, other->bits);
        assert_int_equal(one->value, other->value);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_images),
    cmocka_unit_test(test_constants),
    cmocka_unit_test(test_uniform_block),
    cmocka_unit_test(test_storage_blocks_and_push_constants),
};

const struct unit_tests test_spirv_blocks = UNIT_TESTS(tests, create_shader, destroy_shader);
