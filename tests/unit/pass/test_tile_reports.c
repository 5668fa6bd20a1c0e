// SPDX-License-Identifier: MIT
// What rhw_pass_report_tiles tells, against scenes whose tiles are known: a tile has 64×64 pixels.
#include "harness.h"

#include <string.h>

enum { WIDTH = 150, HEIGHT = 100, TILES_X = 3, TILES = 6 };

static const float white[4] = {1, 1, 1, 1};

// A pass of one draw that reports.
static void draw(struct rig *rig, const struct rig_vertex *vertices, int count,
                 struct rhw_tile_report reports[TILES])
{
    rig_begin(rig);
    assert_int_equal(rhw_pass_tile_count(rig->context, rig->recording), TILES);
    memset(reports, 0xFF, TILES * sizeof *reports);
    rhw_pass_report_tiles(rig->context, rig->recording, reports, TILES);
    rig_draw(rig, vertices, count);
    rig_end(rig);
}

static void test_places(void **state)
{
    (void)state;
    struct rig rig;
    struct rhw_tile_report reports[TILES];
    rig_open(&rig, WIDTH, HEIGHT);
    rig_begin(&rig);
    rhw_pass_report_tiles(rig.context, rig.recording, reports, TILES);
    rig_end(&rig);
    for (int i = 0; i < TILES; i++) {
        const struct rhw_tile_report *const r = &reports[i];
        const int x = i % TILES_X, y = i / TILES_X;
        assert_int_equal(r->x, 64 * x);
        assert_int_equal(r->y, 64 * y);
        assert_int_equal(r->width, x < 2 ? 64 : 22);
        assert_int_equal(r->height, y < 1 ? 64 : 36);
        assert_int_equal(r->layer, 0);
        assert_int_equal(r->triangles + r->fragments_shaded + r->fragment_groups + r->orders, 0);
        assert_true(r->busy_ms >= 0);
    }
    rig_close(&rig);
}

// 30×10 pixels across the corner of four tiles, and 5×5 in the last of all.
static void test_counts(void **state)
{
    (void)state;
    static const int pixels[TILES] = {4 * 4, 26 * 4, 0, 4 * 6, 26 * 6, 5 * 5};
    struct rig rig;
    struct rhw_tile_report reports[TILES];
    struct rig_vertex vertices[12];
    rig_open(&rig, WIDTH, HEIGHT);
    rig_rectangle(&rig, 60, 60, 90, 70, 0.5f, white, vertices);
    rig_rectangle(&rig, 140, 90, 145, 95, 0.5f, white, vertices + 6);
    draw(&rig, vertices, 12, reports);
    uint64_t fragments = 0, groups = 0, entries = 0;
    for (int i = 0; i < TILES; i++) {
        assert_int_equal(reports[i].fragments_shaded, pixels[i]);
        assert_int_equal(reports[i].orders != 0, pixels[i] != 0);
        assert_int_equal(reports[i].triangles != 0, pixels[i] != 0);
        fragments += reports[i].fragments_shaded;
        groups += reports[i].fragment_groups;
        entries += reports[i].triangles;
    }
    assert_int_equal(fragments, rig.stats.fragments_shaded);
    assert_int_equal(groups, rig.stats.fragment_groups);
    assert_int_equal(entries, rig.stats.bin_entries);
    rig_close(&rig);
}

// Many layers above each other in the first tile, the farthest first.
static uint32_t plans_of(struct rig *rig)
{
    enum { LAYERS = 40 };
    struct rhw_tile_report reports[TILES];
    struct rig_vertex vertices[6 * LAYERS];
    for (int i = 0; i < LAYERS; i++) {
        rig_rectangle(rig, 0, 0, 64, 64, 1.0f - (float)i / LAYERS, white, vertices + 6 * i);
    }
    draw(rig, vertices, 6 * LAYERS, reports);
    assert_int_equal(reports[1].orders, 0);
    return reports[0].orders;
}

static void test_plans(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    assert_int_equal(plans_of(&rig), RHW_TILE_BACKWARDS); // without depth the last is seen
    rig_set_depth(&rig);
    assert_int_equal(plans_of(&rig), RHW_TILE_DEPTH_FIRST);
    rig.pipeline.targets[0].blend = true;
    assert_int_equal(plans_of(&rig), RHW_TILE_IN_ORDER);
    rig_close(&rig);
}

// Draws of two kinds in turn, `turns` of each: what has no depth test, then layers above each other.
static uint32_t plans_in_turn(struct rig *rig, int turns)
{
    enum { LAYERS = 40 };
    struct rhw_tile_report reports[TILES];
    struct rig_vertex vertices[6 * LAYERS];
    for (int i = 0; i < LAYERS; i++) {
        rig_rectangle(rig, 0, 0, 64, 64, 1.0f - (float)i / LAYERS, white, vertices + 6 * i);
    }
    rig_begin(rig);
    rhw_pass_report_tiles(rig->context, rig->recording, reports, TILES);
    for (int turn = 0; turn < turns; turn++) {
        rig->pipeline.depth_test = false;
        rig_draw(rig, vertices, 6);
        rig->pipeline.depth_test = true;
        rig_draw(rig, vertices, 6 * LAYERS);
    }
    rig_end(rig);
    return reports[0].orders;
}

// A background keeps nothing before it from being drawn depth first; draws that take turns many times are not each cut off.
static void test_plans_of_a_background_and_a_model(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    rig_set_depth(&rig);
    assert_int_equal(plans_in_turn(&rig, 1), RHW_TILE_BACKWARDS | RHW_TILE_DEPTH_FIRST);
    assert_true((plans_in_turn(&rig, 40) & RHW_TILE_IN_ORDER) != 0);
    rig_close(&rig);
}

static void test_a_pass_reports_for_itself_alone(void **state)
{
    (void)state;
    struct rig rig;
    struct rhw_tile_report reports[TILES], before[TILES];
    struct rig_vertex vertices[6];
    rig_open(&rig, WIDTH, HEIGHT);
    rig_cover(&rig, 0.5f, white, vertices);
    draw(&rig, vertices, 6, reports);
    const uint64_t hash = rig_hash(&rig, 0);
    memcpy(before, reports, sizeof before);
    rig_draw_once(&rig, vertices, 6);
    assert_memory_equal(before, reports, sizeof before);
    assert_int_equal(rig_hash(&rig, 0), hash);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    struct rhw_tile_report reports[TILES];
    rig_open(&rig, WIDTH, HEIGHT);
    rig_begin(&rig);
    rhw_pass_report_tiles(rig.context, rig.recording, reports, 5);
    rig_expect_misuse(&rig, "rhw_pass_report_tiles: count is 5; the pass has 6 tiles");
    rhw_pass_report_tiles(rig.context, rig.recording, NULL, TILES);
    rig_expect_misuse(&rig, "reports is NULL");
    rhw_pass_report_tiles(rig.context, rig.recording, reports, TILES);
    rhw_pass_report_tiles(rig.context, rig.recording, reports, TILES);
    rig_expect_misuse(&rig, "the pass reports already");
    rig_end(&rig);
    assert_int_equal(rhw_pass_tile_count(rig.context, rig.recording), 0);
    rig_expect_misuse(&rig, "rhw_pass_tile_count");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_places),
                                          cmocka_unit_test(test_counts),
                                          cmocka_unit_test(test_plans),
                                          cmocka_unit_test(test_plans_of_a_background_and_a_model),
                                          cmocka_unit_test(test_a_pass_reports_for_itself_alone),
                                          cmocka_unit_test(test_misuse)};

const struct unit_tests test_tile_reports = UNIT_TESTS(tests, NULL, NULL);
