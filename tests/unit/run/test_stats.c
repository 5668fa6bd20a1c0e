// SPDX-License-Identifier: MIT
// The numbers a pass reports, against scenes whose counts are known.
#include "harness.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { SIZE = 128 };

static double milliseconds_between(const struct timespec *from, const struct timespec *to)
{
    return (double)(to->tv_sec - from->tv_sec) * 1e3 + (double)(to->tv_nsec - from->tv_nsec) * 1e-6;
}

static const float white[4] = {1, 1, 1, 1};

// n copies of each kind of triangle, so that a count gone to the wrong place shows.
static void test_every_triangle_is_counted_once(void **state)
{
    (void)state;
    const float kinds[6][3][4] = {
        {{-0.5f, -0.5f, 0.5f, 1}, {0.5f, -0.5f, 0.5f, 1}, {-0.5f, 0.5f, 0.5f, 1}},    // drawn
        {{NAN, -0.5f, 0.5f, 1}, {0.5f, -0.5f, 0.5f, 1}, {-0.5f, 0.5f, 0.5f, 1}},      // dropped
        {{-0.5f, -0.5f, -0.5f, 1}, {0.5f, -0.5f, 0.5f, 1}, {-0.5f, 0.5f, 0.5f, 1}},   // clipped, drawn
        {{-0.5f, -0.5f, -0.5f, 1}, {0.5f, -0.5f, -0.5f, 1}, {-0.5f, 0.5f, -0.5f, 1}}, // outside
        {{-0.5f, 0.5f, 0.5f, 1}, {0.5f, -0.5f, 0.5f, 1}, {-0.5f, -0.5f, 0.5f, 1}},    // facing away
        {{-0.5f, -0.5f, 0.5f, 1}, {0, 0, 0.5f, 1}, {0.5f, 0.5f, 0.5f, 1}},            // of no area
    };
    const int copies[6] = {1, 2, 4, 8, 16, 32};
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig.pipeline.cull = RHW_CULL_BACK;
    struct rig_vertex vertices[3 * 63];
    int count = 0;
    for (int kind = 0; kind < 6; kind++) {
        for (int n = 0; n < copies[kind]; n++) {
            for (int i = 0; i < 3; i++, count++) {
                memcpy(vertices[count].position, kinds[kind][i], sizeof kinds[kind][i]);
                memcpy(vertices[count].value, white, sizeof white);
            }
        }
    }
    rig_draw_once(&rig, vertices, count);
    const struct rhw_stats *stats = &rig.stats;
    assert_int_equal(stats->draws, 1);
    assert_int_equal(stats->triangles_in, 63);
    assert_int_equal(stats->triangles_dropped, 2);
    assert_int_equal(stats->triangles_clipped, 4);
    assert_int_equal(stats->triangles_culled, 8 + 16 + 32);
    assert_int_equal(stats->triangles_rasterized, 1 + 4);
    assert_true(stats->vertices_shaded >= 189 && stats->vertices_shaded < 256);
    assert_int_equal(stats->threads, 2);
    assert_int_equal(stats->tiles, 4);
    assert_int_equal(stats->isa, rhw_context_isa(rig.context));
    assert_true(stats->front_ms >= 0 && stats->back_ms >= 0);
    assert_true(isfinite(stats->front_ms + stats->back_ms));
    rig_close(&rig);
}

static void test_a_triangle_between_the_samples_is_culled(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex tiny[6];
    rig_rectangle(&rig, 10.625f, 10.625f, 11.375f, 11.375f, 0.5f, white, tiny);
    rig_draw_once(&rig, tiny, 6);
    assert_int_equal(rig.stats.triangles_in, 2);
    assert_int_equal(rig.stats.triangles_culled, 2);
    assert_int_equal(rig.stats.triangles_rasterized, 0);
    rig_close(&rig);
}

static void test_fragments(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex rows[6];
    for (int n = 0; n < 30; n++) {
        rig_rectangle(&rig, 3, 5, (float)(4 + 4 * n), (float)(6 + 3 * n), 0.5f, white, rows);
        rig_draw_once(&rig, rows, 6);
        const uint64_t pixels = (uint64_t)(1 + 4 * n) * (uint64_t)(1 + 3 * n);
        assert_int_equal(rig.stats.fragments_shaded, pixels);
        // Groups of 8 lanes: never fewer than the pixels need, and the pipeline is wide.
        assert_true(rig.stats.fragment_groups * 8 >= pixels);
        assert_true(n < 10 || rig.stats.fragment_groups * 8 < 2 * pixels);
    }
    rig_close(&rig);
}

// Vertices that triangles share are shaded once where an index names them again soon.
static void test_shared_vertices(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    enum { CELLS = 20 };
    struct rig_vertex grid[(CELLS + 1) * (CELLS + 1)];
    uint16_t indices[CELLS * CELLS * 6];
    for (int i = 0; i < (CELLS + 1) * (CELLS + 1); i++) {
        rig_place(&rig, (float)(i % (CELLS + 1) * 6), (float)(i / (CELLS + 1) * 6), 0.5f, 1,
                  grid[i].position);
        memcpy(grid[i].value, white, sizeof white);
    }
    for (int i = 0; i < CELLS * CELLS; i++) {
        const int a = i / CELLS * (CELLS + 1) + i % CELLS;
        const int corners[6] = {a, a + 1, a + CELLS + 1, a + CELLS + 1, a + 1, a + CELLS + 2};
        for (int k = 0; k < 6; k++) {
            indices[6 * i + k] = (uint16_t)corners[k];
        }
    }
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, grid, sizeof grid);
    rig_use_indices(&rig, RHW_INDEX_UINT16, indices, sizeof indices);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, CELLS * CELLS * 6, 0, 0, 1);
    rig_end(&rig);
    assert_int_equal(rig.stats.triangles_in, CELLS * CELLS * 2);
    assert_true(rig.stats.vertices_shaded >= (CELLS + 1) * (CELLS + 1));
    assert_true(rig.stats.vertices_shaded < CELLS * CELLS * 2); // without reuse it would be 6 a cell
    rig_close(&rig);
}

// The sum of what the stages say is what went by, and their parts are parts.
static void test_times_add_up(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, white, all);
    struct timespec from, begun, recorded, to;
    clock_gettime(CLOCK_MONOTONIC, &from);
    rig_begin(&rig);
    clock_gettime(CLOCK_MONOTONIC, &begun);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, all, sizeof all);
    for (int n = 0; n < 200; n++) {
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    }
    clock_gettime(CLOCK_MONOTONIC, &recorded);
    rig_end(&rig);
    clock_gettime(CLOCK_MONOTONIC, &to);
    const struct rhw_stats *s = &rig.stats;
    const double recording = milliseconds_between(&begun, &recorded),
                 all_ms = milliseconds_between(&from, &to);
    assert_true(s->front_ms > 0 && s->back_ms > 0);
    assert_true(s->record_ms >= recording && s->record_ms + s->front_ms + s->back_ms <= all_ms);
    assert_true(s->vertex_busy_ms > 0 && s->setup_busy_ms > 0 && s->bin_busy_ms > 0);
    const double parts = s->vertex_busy_ms + s->setup_busy_ms + s->bin_busy_ms;
    assert_true(parts <= s->front_busy_ms && s->front_busy_ms <= 2 * s->front_ms);
    assert_true(s->back_busy_ms > 0 && s->back_busy_ms <= 2 * s->back_ms);
    rig_close(&rig);
}

// Rectangles that lie in 1, 2, 4 and 6 of the tiles, two triangles each.
static void test_bin_entries(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 3 * 64, 2 * 64);
    const float rectangles[4][4] = {{3, 3, 60, 60}, {3, 3, 66, 60}, {60, 60, 68, 68}, {1, 1, 191, 127}};
    const int entries[4] = {2, 4, 8, 12};
    for (int i = 0; i < 4; i++) {
        const float *r = rectangles[i];
        struct rig_vertex vertices[6];
        rig_rectangle(&rig, r[0], r[1], r[2], r[3], 0.5f, white, vertices);
        rig_draw_once(&rig, vertices, 6);
        assert_int_equal(rig.stats.bin_entries, entries[i]);
        assert_true(rig.stats.geometry_peak >= 2 * 64 + 6 * 32);
        assert_true(rig.stats.geometry_peak < 16384);
        assert_true(rig.stats.geometry_peak < rig.stats.memory_peak);
    }
    rig_close(&rig);
}

// Long triangles are drawn in the tiles that their edges lead through. From 8 at the top, y = 8, to 312 at the bottom,
// y = 248, an edge has x = 78.9, 160 and 241.1 where one row of tiles ends and the next begins; that of the other side stays
// within the same tiles: to 94 in the first row, 172 in the second, 251 in the third. So it is two tiles in each of 4 rows, of
// 20 that its rectangle has, whether it turns this way or that, begins outside of the target, or is what the near plane leaves.
static void test_bin_entries_of_long_triangles(void **state)
{
    (void)state;
    enum { WIDTH = 5 * 64, HEIGHT = 4 * 64, LONG = 4 };
    static const float corners[LONG][3][3] = {
        {{8, 8, 0.5f}, {24, 8, 0.5f}, {312, 248, 0.5f}},
        {{WIDTH - 8, 8, 0.5f}, {WIDTH - 24, 8, 0.5f}, {WIDTH - 312, 248, 0.5f}},
        {{-296, -232, 0.5f}, {-280, -232, 0.5f}, {312, 248, 0.5f}},
        {{8, 8, 0.5f}, {24, 8, 0.5f}, {616, 488, -0.5f}}, // cut in its middle: at (312, 248) and (320, 248)
    };
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    for (int i = 0; i < LONG; i++) {
        struct rig_vertex vertices[3];
        for (int k = 0; k < 3; k++) {
            const float *const at = corners[i][k];
            rig_place(&rig, at[0], at[1], at[2], 1, vertices[k].position);
            memcpy(vertices[k].value, white, sizeof white);
        }
        rig_draw_once(&rig, vertices, 3);
        assert_int_equal(rig.stats.triangles_clipped, i == 3);
        assert_int_equal(rig.stats.bin_entries, 8);
    }
    // The halves of a square, of 4 rows and columns: the tiles on and beside its diagonal, whose corners are tiles' corners.
    struct rig_vertex square[6];
    rig_rectangle(&rig, 0, 0, HEIGHT, HEIGHT, 0.5f, white, square);
    rig_draw_once(&rig, square, 6);
    assert_int_equal(rig.stats.bin_entries, 2 * (1 + 2 + 3 + 4));
    rig_close(&rig);
}

static void test_stats_start_anew(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, white, all);
    for (int n = 0; n < 3; n++) {
        rig_draw_once(&rig, all, 6);
        assert_int_equal(rig.stats.triangles_in, 2);
        assert_int_equal(rig.stats.fragments_shaded, SIZE * SIZE);
    }
    rig_begin(&rig);
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_OK);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_triangle_is_counted_once),
    cmocka_unit_test(test_a_triangle_between_the_samples_is_culled),
    cmocka_unit_test(test_fragments),
    cmocka_unit_test(test_shared_vertices),
    cmocka_unit_test(test_times_add_up),
    cmocka_unit_test(test_bin_entries),
    cmocka_unit_test(test_bin_entries_of_long_triangles),
    cmocka_unit_test(test_stats_start_anew),
};

const struct unit_tests test_stats = UNIT_TESTS(tests, NULL, NULL);
