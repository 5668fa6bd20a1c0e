// SPDX-License-Identifier: MIT
// A pass id is good for its own pass; bins keep within their memory; triangles at the very edge of the guard band are
// culled, not binned.
#include "harness.h"

#include <string.h>

static const struct rig_vertex triangle[3] = {
    {{-1, -1, 0, 1}, {1, 1, 1, 1}}, {{3, -1, 0, 1}, {1, 1, 1, 1}}, {{-1, 3, 0, 1}, {1, 1, 1, 1}}};

static void test_stale_pass(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    rig_begin(&rig);
    const rhw_pass stale = {rig.recording.index, rig.recording.generation + 1, rig.recording.context};
    rhw_pass_draw(rig.context, stale, 0, 3, 0, 1);
    rig_expect_misuse(&rig, "rhw_pass_draw: the pass id is null or its pass has ended");
    rig_end(&rig);
    rig_close(&rig);
}

// Every triangle covers every tile: the bins take more than vertices and triangles together.
static void test_bins_are_bounded(void **state)
{
    (void)state;
    enum { TRIANGLES = 4096, SIZE = 1024 };
    static struct rig_vertex vertices[TRIANGLES * 3];
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.bin_memory = (size_t)2 << 20;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &def);
    for (int i = 0; i < TRIANGLES; i++) {
        memcpy(&vertices[3 * i], triangle, sizeof triangle);
    }
    rig.pipeline.program.fragment[0] = NULL; // binning is what counts
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    rig_draw_once(&rig, vertices, TRIANGLES * 3);
    assert_int_equal(rig.stats.triangles_rasterized, TRIANGLES);
    assert_true(rig.stats.flushes >= 1); // 2 MiB of entries, above 1 MiB of triangles and vertices
    rig_close(&rig);
}

// All that clipping leaves lies within half a pixel of the guard band, 32768 pixels to the right.
static void test_edge_of_the_guard_band(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    struct rig_vertex v[3];
    memset(v, 0, sizeof v);
    rig_place(&rig, 32, 32, -0.5f, 1, v[0].position);
    rig_place(&rig, 32767.8f, 20, 0.0f, 1, v[1].position);
    rig_place(&rig, 32767.8f, 44, 0.0f, 1, v[2].position);
    rig_draw_once(&rig, v, 3);
    assert_int_equal(rig.stats.triangles_rasterized, 0);
    assert_int_equal(rig.stats.triangles_culled, 1);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_stale_pass),
    cmocka_unit_test(test_bins_are_bounded),
    cmocka_unit_test(test_edge_of_the_guard_band),
};

const struct unit_tests test_in_use = UNIT_TESTS(tests, NULL, NULL);
