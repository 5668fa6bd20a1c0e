// SPDX-License-Identifier: MIT
// The one-at-a-time form for compilers without lanes: what the library has for them gives the bits of the inline
// functions, and its shaders the same picture.
#include "float_bits.h"
#include "harness.h"
#include "no_lanes.h"
#include "one_at_a_time.h"

enum { SIZE = 64, TEXTURE = 32 };

// The bits; one pattern for every NaN.
static uint32_t bits(float value)
{
    return value == value ? to_bits(value) : 0x7fc00000;
}

static float random_bits(uint64_t *state)
{
    return from_bits((uint32_t)rig_random(state));
}

static void test_maths(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < ONE_MATHS * 20000; i++) {
        const int number = i % ONE_MATHS;
        const bool wild = i / ONE_MATHS % 2 != 0;
        const float a = wild ? random_bits(&random) : rig_random_float(&random, -2, 2);
        const float b = wild ? random_bits(&random) : rig_random_float(&random, -2, 2);
        assert_int_equal(bits(one_math(number, a, b)), bits(no_lanes_math(number, a, b)));
    }
    assert_int_equal(bits(rhw_math1((enum rhw_math1_function)99, 1, 1)), 0x7fc00000);
}

static uint64_t draw(rhw_vertex1_function *vertex, rhw_fragment1_function *fragment)
{
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_program(&rig, NULL, NULL);
    rig.pipeline.program.vertex1 = vertex;
    rig.pipeline.program.fragment1 = fragment;
    rig.pipeline.program.varyings[0].derivatives = true;

    static unsigned char texels[TEXTURE * TEXTURE][4];
    uint64_t random = 2;
    for (int i = 0; i < TEXTURE * TEXTURE * 4; i++) {
        texels[i / 4][i % 4] = (unsigned char)rig_random(&random);
    }
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_UNORM,
                                        .width = TEXTURE,
                                        .height = TEXTURE,
                                        .mip_levels = RHW_MIP_LEVELS_ALL};
    const struct rhw_sampler_def sampler_def = {.lod_max = 0};
    rhw_texture texture;
    rhw_sampler sampler;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    rhw_texture_write(rig.context, texture, 0, texels, 0);
    assert_int_equal(rhw_texture_generate_mips(rig.context, texture), RHW_OK);

    // Further away to the right, so that levels are mixed.
    const struct rig_vertex vertices[3] = {
        {{-1, 1, 0, 1}, {0, 0, 0, 0}}, {{-1, -3, 0, 1}, {0, 2, 0, 0}}, {{9, 3, 0, 3}, {6, 0, 0, 0}}};
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    rig_draw(&rig, vertices, 3);
    rig_end(&rig);
    assert_int_not_equal(rig.stats.fragments_shaded, 0);
    rig_read_float4(&rig);
    const uint64_t hash = rig_hash(&rig, 0);
    rig_close(&rig);
    return hash;
}

static void test_picture(void **state)
{
    (void)state;
    assert_true(draw(one_vertex, one_fragment) == draw(no_lanes_vertex, no_lanes_fragment));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_maths),
    cmocka_unit_test(test_picture),
};

const struct unit_tests test_no_lanes = UNIT_TESTS(tests, NULL, NULL);
