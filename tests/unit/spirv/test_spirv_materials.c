// SPDX-License-Identifier: MIT
// Samples of several textures at coordinates that are inputs, which machine code and C may do for all groups at once, give
// what the interpreter gives, whatever is bound.
#include "../binding/bound_things.h"
#include "spirv_run.h"

#include "material_frag.h"
#include "material_in_steps_frag.h"
#include "plain_vert.h"

enum { SIZE = 40, MAPS = 18 };

// Bind textures that may be sampled together, and others: of another size, format or kind, and none at all.
static void bind_maps(const struct rig *rig, struct rhw_binding set[MAPS])
{
    static const struct rhw_texture_def odd[] = {
        {.kind = RHW_TEXTURE_3D, .width = 6, .height = 5, .depth = 4, .mip_levels = 2},
        {.kind = RHW_TEXTURE_1D, .width = 13, .mip_levels = RHW_MIP_LEVELS_ALL},
        {.kind = RHW_TEXTURE_CUBE, .width = 8, .height = 8, .mip_levels = 3},
        {.width = 8, .height = 7, .layers = 4, .mip_levels = 2},
        {.kind = RHW_TEXTURE_1D, .width = 64, .layers = 4, .mip_levels = RHW_MIP_LEVELS_ALL},
        {.width = 9, .height = 31},
    };
    const rhw_sampler linear = make_sampler(rig, &(struct rhw_sampler_def){.address_v = RHW_ADDRESS_MIRROR});
    const rhw_sampler nearest = make_sampler(
        rig, &(struct rhw_sampler_def){.min_filter = RHW_FILTER_NEAREST, .mag_filter = RHW_FILTER_NEAREST});
    memset(set, 0, MAPS * sizeof *set);
    for (int i = 0; i < MAPS; i++) {
        const bool is_odd = i % 3 == 1;
        struct rhw_texture_def def = {.width = 64, .height = 64, .mip_levels = RHW_MIP_LEVELS_ALL};
        def = is_odd ? odd[i / 3] : def;
        def.format = is_odd       ? RHW_FORMAT_RGBA8_UNORM
                     : i % 4 == 0 ? RHW_FORMAT_RGBA8_SRGB
                     : i % 4 == 3 ? RHW_FORMAT_RGBA16_FLOAT
                                  : RHW_FORMAT_RGBA8_UNORM;
        const rhw_texture texture = make_texture(rig, &def);
        write_noise(rig, texture, (uint64_t)i + 1);
        const rhw_sampler sampler = i == 8 ? nearest : i == 9 ? (rhw_sampler){0} : linear;
        if (i != 11) {
            assert_int_equal(rhw_binding_of_texture(rig->context, texture, sampler, &set[i]), RHW_OK);
        }
    }
}

static void draw(struct rig *rig, rhw_shader *fragment, const struct rhw_binding *set, bool is_interpreted,
                 float pixels[SIZE * SIZE][4])
{
    static const struct rig_vertex triangle[3] = {
        {{-1, -1, 0, 1}, {0, 0, 0, 1}}, {{9, -1, 0, 3}, {3, 1, 2, 1}}, {{-1, 5, 0, 2}, {1, 2, -1, 1}}};
    const float scale = 1;
    const struct rhw_shader_frame frame = {
        .sets = {set}, .push_constants = &scale, .push_size = sizeof scale};
    rhw_shader *const vertex = SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX);
    const struct rhw_shader_program_def def = {
        .vertex = vertex, .fragment = fragment, .is_interpreted = is_interpreted};
    rhw_shader_program *program;
    assert_int_equal(rhw_shader_program_create(&def, &program, NULL), RHW_OK);
    spirv_draw(rig, program, triangle, 3, &frame);
    memcpy(pixels, rig_read_float4(rig), SIZE * SIZE * sizeof *pixels);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(vertex);
}

static void expect_equal_pictures(const struct rhw_binding *set, struct rig *rig, rhw_shader *fragment)
{
    static float pixels[2][SIZE * SIZE][4];
    int drawn = 0;
    draw(rig, fragment, set, true, pixels[0]);
    draw(rig, fragment, set, false, pixels[1]);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_memory_equal(pixels[0][i], pixels[1][i], sizeof *pixels[0]);
        drawn += pixels[0][i][1] != 0.0f ? 1 : 0;
    }
    assert_in_range(drawn, SIZE, SIZE * SIZE);
    rhw_shader_destroy(fragment);
}

static void test_materials_are_sampled_as_groups(void **state)
{
    (void)state;
    struct rig rig;
    struct rhw_binding set[MAPS];
    rig_open(&rig, SIZE, SIZE);
    bind_maps(&rig, set);
    expect_equal_pictures(set, &rig, SPIRV_CREATE(material_frag, RHW_SHADER_FRAGMENT));
    expect_equal_pictures(set, &rig, SPIRV_CREATE(material_in_steps_frag, RHW_SHADER_FRAGMENT));
    memset(set, 0, sizeof set);
    expect_equal_pictures(set, &rig, SPIRV_CREATE(material_in_steps_frag, RHW_SHADER_FRAGMENT));
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_materials_are_sampled_as_groups),
};

const struct unit_tests test_spirv_materials = UNIT_TESTS(tests, NULL, NULL);
