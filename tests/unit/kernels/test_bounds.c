// SPDX-License-Identifier: MIT
// Bounds of depth: those that a pipeline tests, and those that a tile keeps of its blocks, which end to hold when a draw
// may move depth away from them.
#include "harness.h"

enum { SIZE = 64 };

static const float red[4] = {1, 0, 0, 1}, green[4] = {0, 1, 0, 1};

static void cover(struct rig *rig, float depth, const float color[4])
{
    struct rig_vertex all[6];
    rig_cover(rig, depth, color, all);
    rig_draw(rig, all, 6);
}

static void attach_stencil(struct rig *rig)
{
    rig_set_depth(rig);
    rhw_texture_destroy(rig->context, rig->pass.depth.texture);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_D32_FLOAT_S8_UINT, .width = SIZE, .height = SIZE};
    assert_int_equal(rhw_texture_create(rig->context, &def, &rig->pass.depth.texture), RHW_OK);
}

// Without stencil_test its faces have no say, whatever else is tested.
static void test_stencil_is_off(void **state)
{
    (void)state;
    for (int bounds = 0; bounds < 2; bounds++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        attach_stencil(&rig);
        rig.pipeline.depth_bounds_test = bounds;
        rig.pipeline.stencil_front = rig.pipeline.stencil_back =
            (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_NEVER};
        rig_begin(&rig);
        cover(&rig, 0.5f, red);
        rig_end(&rig);
        assert_true(rig_read_float4(&rig)[100][0] == 1);
        rig_close(&rig);
    }
}

// A draw that lets depth move back, and cannot be bounded itself as it changes the stencil where it fails.
static void test_bounds_end(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    attach_stencil(&rig);
    rig_begin(&rig);
    cover(&rig, 0.25f, red); // a bound for every block
    rig.pipeline.depth_compare = RHW_COMPARE_GREATER;
    rig.pipeline.stencil_test = true;
    rig.pipeline.stencil_front.depth_fail = rig.pipeline.stencil_back.depth_fail = RHW_STENCIL_INVERT;
    cover(&rig, 0.75f, red);
    rig.pipeline.stencil_test = false;
    rig.pipeline.depth_compare = RHW_COMPARE_LESS;
    rig.pipeline.stencil_front = rig.pipeline.stencil_back = (struct rhw_stencil_face){.compares = false};
    cover(&rig, 0.5f, green); // behind the first, in front of the second
    rig_end(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(rig_read_float4(&rig)[i][1] == 1 && rig_read_depth(&rig)[i] == 0.5f);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_stencil_is_off),
    cmocka_unit_test(test_bounds_end),
};

const struct unit_tests test_bounds = UNIT_TESTS(tests, NULL, NULL);
