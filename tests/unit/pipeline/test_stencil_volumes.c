// SPDX-License-Identifier: MIT
// Draws that do no more than count in stencil, as shadow volumes do: block by block where all of a plane passes the depth
// test, or fails it (kernels/depth/depth_range.h), they leave the stencil that the test of every pixel leaves.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 136, VOLUMES = 60, SCENES = 24 }; // three tiles each way

static const float flat = 0.1f;
static const struct rhw_stencil_face counts[3] = {
    {.depth_fail = RHW_STENCIL_INCREMENT_WRAP},
    {.pass = RHW_STENCIL_DECREMENT_WRAP, .write_mask = 0x7f},
    {.depth_fail = RHW_STENCIL_INVERT, .pass = RHW_STENCIL_INCREMENT_CLAMP}};

// What is there before: a slanted plane with steps in it, and places that no test can order.
static void write_depth(struct rig *rig, uint64_t *random, bool has_nan)
{
    static float depth[SIZE * SIZE];
    const float steep = rig_random_int(random, 3) == 0 ? 0.0f : 0.012f; // to both ends of the range, or flat
    const float base = steep > 0.0f ? 0.5f : flat;
    const float x = rig_random_float(random, -steep, steep), y = rig_random_float(random, -steep, steep);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int column = i % SIZE, row = i / SIZE, step = (column / 24 + row / 40) % 3;
        depth[i] = base + x * (float)(column - SIZE / 2) + y * (float)(row - SIZE / 2) + 0.05f * (float)step;
        depth[i] = depth[i] < 0.0f ? 0.0f : depth[i] > 1.0f ? 1.0f : depth[i];
        if (has_nan && column % 50 == 7 && row % 30 == 3) {
            depth[i] = NAN;
        }
    }
    assert_int_equal(rhw_texture_write(rig->context, rig->pass.depth.texture, 0, depth, 0), RHW_OK);
}

static void make_triangle(const struct rig *rig, uint64_t *random, struct rig_vertex vertices[3])
{
    memset(vertices, 0, 3 * sizeof *vertices);
    // Some lie less than a step of 24 bits beside what is there.
    const bool is_flat = rig_random_int(random, 4) == 0;
    const float beside = flat + (float)(rig_random_int(random, 9) - 4) * 0x1p-26f;
    for (int i = 0; i < 3; i++) {
        // Some are cut by the near plane, some leave the depth range.
        const float w = rig_random_int(random, 12) == 0 ? -1.0f : rig_random_float(random, 0.5f, 4.0f);
        rig_place(rig, rig_random_float(random, -60, SIZE + 60), rig_random_float(random, -60, SIZE + 60),
                  is_flat ? beside : rig_random_float(random, -0.3f, 1.3f), is_flat ? 1.0f : w,
                  vertices[i].position);
    }
}

static void draw_volumes(struct rig *rig, uint64_t seed)
{
    static const enum rhw_compare compares[] = {RHW_COMPARE_LESS, RHW_COMPARE_LESS_EQUAL, RHW_COMPARE_GREATER,
                                                RHW_COMPARE_GREATER_EQUAL};
    uint64_t random = seed;
    struct rhw_pipeline_def *const def = &rig->pipeline;
    rig_begin(rig);
    rig_set_program(rig, rig_vertex_pass, NULL);
    def->targets[0].write_mask = RHW_WRITE_NONE;
    def->stencil_test = def->depth_test = true;
    for (int i = 0; i < VOLUMES; i++) {
        struct rig_vertex vertices[3];
        make_triangle(rig, &random, vertices);
        def->depth_compare = compares[rig_random_int(&random, 4)];
        def->stencil_front = counts[rig_random_int(&random, 3)];
        def->stencil_back = counts[rig_random_int(&random, 3)];
        if (i % 8 == 7) { // what faces away is compared, which takes the test of every pixel
            def->stencil_back.compares = true;
            def->stencil_back.compare = RHW_COMPARE_EQUAL;
            def->stencil_back.fail = RHW_STENCIL_INCREMENT_WRAP;
        }
        def->depth_clip_disabled = def->depth_clamp = rig_random_int(&random, 3) == 0;
        def->depth_bias = (struct rhw_depth_bias){0};
        if (rig_random_int(&random, 3) == 0) {
            def->depth_bias = (struct rhw_depth_bias){.constant = 1000, .slope = 1.5f};
        }
        // Now and then depth moves, which ends what was known of it.
        def->depth_read_only = rig_random_int(&random, 25) != 0;
        rig_draw(rig, vertices, 3);
    }
    rig_end(rig);
}

static void count(enum rhw_paths paths, enum rhw_format format, uint64_t seed, uint8_t stencil[SIZE * SIZE])
{
    struct rig rig;
    uint64_t random = seed;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_depth(&rig);
    rhw_texture_destroy(rig.context, rig.pass.depth.texture);
    const struct rhw_texture_def def = {.format = format, .width = SIZE, .height = SIZE};
    assert_int_equal(rhw_texture_create(rig.context, &def, &rig.pass.depth.texture), RHW_OK);
    write_depth(&rig, &random, format == RHW_FORMAT_D32_FLOAT_S8_UINT && seed % 2 == 0);
    rig.pass.depth.load = RHW_LOAD_LOAD;
    rig.pass.depth.stencil_clear = 100;
    draw_volumes(&rig, seed);
    assert_int_equal(rhw_texture_read_stencil(rig.context, rig.pass.depth.texture, 0, stencil, 0), RHW_OK);
    rig_close(&rig);
}

static void compare_paths(enum rhw_format format)
{
    static uint8_t all[SIZE * SIZE], general[SIZE * SIZE];
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        count(RHW_PATHS_ALL, format, seed, all);
        count(RHW_PATHS_GENERAL, format, seed, general);
        assert_memory_equal(all, general, sizeof all);
        int changed = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            changed += all[i] != 100;
        }
        assert_true(changed > SIZE * SIZE / 2);
    }
}

static void test_floats(void **state)
{
    (void)state;
    compare_paths(RHW_FORMAT_D32_FLOAT_S8_UINT);
}

static void test_steps(void **state)
{
    (void)state;
    compare_paths(RHW_FORMAT_D24_UNORM_S8_UINT);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_floats),
    cmocka_unit_test(test_steps),
};

const struct unit_tests test_stencil_volumes = UNIT_TESTS(tests, NULL, NULL);
