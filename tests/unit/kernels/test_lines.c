// SPDX-License-Identifier: MIT
// Lines as rectangles: coverage by exact arithmetic on the snapped corners, values along the line, clipping, flat values,
// topologies against each other.
#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 96 };

static void open_rig(struct rig *rig, enum rhw_paths paths)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.paths = paths;
    def.threads = 2;
    rig_open_with(rig, SIZE, SIZE, &def);
    rig->pipeline.topology = RHW_LINE_LIST;
}

static struct rig_vertex vertex_at(const struct rig *rig, double x, double y, float w, float value)
{
    struct rig_vertex v = {.value = {value, 1, 0, 1}};
    rig_place(rig, (float)x, (float)y, 0.5f, w, v.position);
    return v;
}

struct snapped {
    int64_t x, y; // 1/256 pixel
};

// Inside a convex polygon that turns clockwise on the screen, by the top-left rule.
static bool inside(const struct snapped *corners, int count, int64_t x, int64_t y)
{
    for (int i = 0; i < count; i++) {
        const struct snapped a = corners[i], b = corners[(i + 1) % count];
        const int64_t dx = b.x - a.x, dy = b.y - a.y, e = dx * (y - a.y) - dy * (x - a.x);
        const bool top_left = dy < 0 || (dy == 0 && dx > 0);
        if (e < 0 || (e == 0 && !top_left)) {
            return false;
        }
    }
    return true;
}

static void test_coverage_is_the_rectangle(void **state)
{
    (void)state;
    static const float widths[] = {0, 1, 1.5f, 2, 7, 33.25f, 100};
    for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL; paths += RHW_PATHS_GENERAL) {
        struct rig rig;
        open_rig(&rig, (enum rhw_paths)paths);
        uint64_t random = 11;
        for (int n = 0; n < 140; n++) {
            const int range = n % 2 ? SIZE * 256 : 6 * 256, from = n % 2 ? 0 : 40 * 256;
            struct snapped a = {from + rig_random_int(&random, range), from + rig_random_int(&random, range)};
            struct snapped b = {from + rig_random_int(&random, range), from + rig_random_int(&random, range)};
            if (n % 5 == 0) {
                b.y = a.y = a.y & -128; // horizontal, through centres and between pixels
            }
            const float width = widths[n % 7];
            rig.pipeline.line_width = width;
            const struct rig_vertex v[2] = {vertex_at(&rig, (double)a.x / 256, (double)a.y / 256, 1, 1),
                                            vertex_at(&rig, (double)b.x / 256, (double)b.y / 256, 1, 1)};
            rig_draw_once(&rig, v, 2);
            const double dx = (double)(b.x - a.x), dy = (double)(b.y - a.y);
            const double scale = (width == 0 ? 1 : (double)width) * 128 / sqrt(dx * dx + dy * dy);
            const struct snapped s = {-(int64_t)nearbyint(dy * scale), (int64_t)nearbyint(dx * scale)};
            const struct snapped corners[4] = {{a.x + s.x, a.y + s.y},
                                               {a.x - s.x, a.y - s.y},
                                               {b.x - s.x, b.y - s.y},
                                               {b.x + s.x, b.y + s.y}};
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int i = 0; i < SIZE * SIZE; i++) {
                const bool in = inside(corners, 4, 256 * (i % SIZE) + 128, 256 * (i / SIZE) + 128);
                if ((pixels[i][3] != 0) != in) {
                    fail_msg("paths %d, line %d, pixel %d, %d: expected %d", paths, n, i % SIZE, i / SIZE,
                             in);
                }
            }
        }
        rig_close(&rig);
    }
}

// Vulkan 1.3 §28.9: t = (p − a)·(b − a) / |b − a|², and values in space are weighed by 1/W.
static void test_values_follow_the_line(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig_set_depth(&rig);
    rig.pipeline.line_width = 3;
    rig.pipeline.program.varyings[0].qualifier = RHW_SMOOTH;
    const double ax = 10, ay = 20, bx = 74, by = 52, wa = 1, wb = 4, za = 0.25, zb = 0.75;
    struct rig_vertex v[2] = {vertex_at(&rig, ax, ay, (float)wa, 100),
                              vertex_at(&rig, bx, by, (float)wb, 200)};
    v[0].position[2] = (float)(za * wa);
    v[1].position[2] = (float)(zb * wb);
    rig_draw_once(&rig, v, 2);
    static float colors[SIZE * SIZE][4];
    memcpy(colors, rig_read_float4(&rig), sizeof colors);
    const float *depth = rig_read_depth(&rig);
    int seen = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (colors[i][3] != 0) {
            const double x = i % SIZE + 0.5 - ax, y = i / SIZE + 0.5 - ay;
            const double t =
                (x * (bx - ax) + y * (by - ay)) / ((bx - ax) * (bx - ax) + (by - ay) * (by - ay));
            const double value = ((1 - t) * 100 / wa + t * 200 / wb) / ((1 - t) / wa + t / wb);
            // The side of the rectangle is snapped: across it, t is off by 1/512 pixel at most.
            assert_true(fabs((double)colors[i][0] - value) < 0.02);
            assert_true(fabs((double)depth[i] - (za + t * (zb - za))) < 1e-4);
            seen++;
        }
    }
    assert_true(seen > 190);
    rig_close(&rig);
}

static void test_a_thin_line_has_a_pixel_a_column(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    for (int sub = 0; sub < 256; sub += 32) {
        const double y = 20 + sub / 256.0;
        const struct rig_vertex v[2] = {vertex_at(&rig, 10, y, 1, 1), vertex_at(&rig, 50, y, 1, 1)};
        rig_draw_once(&rig, v, 2);
        const float(*pixels)[4] = rig_read_float4(&rig);
        int count = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            count += pixels[i][3] != 0;
        }
        assert_int_equal(count, 40);
    }
    rig_close(&rig);
}

// What a plane cuts off does not change the values of what is left.
static void test_clipped_lines_keep_their_values(void **state)
{
    (void)state;
    for (int qualifier = RHW_SMOOTH; qualifier <= RHW_FLAT; qualifier++) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        rig.pipeline.program.varyings[0].qualifier = (enum rhw_qualifier)qualifier;
        // Depth runs from −1 to 1 along the line, so the near plane leaves the second half.
        struct rig_vertex v[2] = {vertex_at(&rig, 8, 40.5, 1, 10), vertex_at(&rig, 88, 40.5, 3, 90)};
        v[0].position[2] = -1;
        v[1].position[2] = 3;
        rig_draw_once(&rig, v, 2);
        assert_int_equal(rig.stats.triangles_clipped, 1);
        const float(*pixels)[4] = rig_read_float4(&rig);
        // Z = −1 + 4t is 0 at t = 1/4 in space: there W = 1.5, and the line is at 8 + 80·(0.25·3/1.5) = 48.
        for (int x = 0; x < SIZE; x++) {
            const float *const p = pixels[40 * SIZE + x];
            assert_int_equal(p[3] != 0, x >= 48 && x < 88);
            const double t = (x + 0.5 - 8) / 80, smooth = ((1 - t) * 10 + t * 90 / 3) / ((1 - t) + t / 3);
            const double expected = qualifier == RHW_FLAT     ? 10
                                    : qualifier == RHW_SMOOTH ? smooth
                                                              : 10 + t * 80;
            if (p[3] != 0 && fabs((double)p[0] - expected) > 1e-3) {
                fail_msg("qualifier %d, column %d: %g instead of %g", qualifier, x, (double)p[0], expected);
            }
        }
        rig_close(&rig);
    }
}

static void test_a_line_from_behind_the_eye(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    struct rig_vertex v[2] = {vertex_at(&rig, 48, 48.5, 1, 10), vertex_at(&rig, 48, 48.5, 1, 10)};
    v[1].position[0] = 1;
    v[1].position[1] = 0.03f;
    v[1].position[2] = -2;
    v[1].position[3] = -1;
    v[0].position[2] = 0.5f;
    rig_draw_once(&rig, v, 2);
    const float(*pixels)[4] = rig_read_float4(&rig);
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        count += pixels[i][3] != 0;
        assert_true(pixels[i][3] == 0 || pixels[i][0] == 10);
    }
    assert_true(count > 5 && count < 60);
    rig_close(&rig);
}

static void test_flat_values_are_the_provoking_vertex_s(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    rig.pipeline.line_width = 5;
    for (int last = 0; last < 2; last++) {
        rig.pipeline.provoking = last ? RHW_PROVOKING_LAST : RHW_PROVOKING_FIRST;
        const struct rig_vertex v[2] = {vertex_at(&rig, 10, 10, 1, 3), vertex_at(&rig, 80, 60, 2, 4)};
        rig_draw_once(&rig, v, 2);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIZE * SIZE; i++) {
            assert_true(pixels[i][3] == 0 || pixels[i][0] == (last ? 4 : 3));
        }
    }
    rig_close(&rig);
}

// Each draws the primitives of the list that is worked out here by hand.
static void test_topologies_are_their_lists(void **state)
{
    (void)state;
    enum { VERTICES = 14 };
    static const struct {
        enum rhw_topology topology, list;
        int count, picks[40], pick_count;
    } cases[] = {
        {RHW_LINE_STRIP, RHW_LINE_LIST, 5, {0, 1, 1, 2, 2, 3, 3, 4}, 8},
        {RHW_LINE_LOOP, RHW_LINE_LIST, 5, {0, 1, 1, 2, 2, 3, 3, 4, 4, 0}, 10},
        {RHW_LINE_LOOP, RHW_LINE_LIST, 2, {0, 1, 1, 0}, 4},
        {RHW_LINE_LOOP, RHW_LINE_LIST, 1, {0}, 0},
        {RHW_LINE_LIST, RHW_LINE_LIST, 5, {0, 1, 2, 3}, 4},
        {RHW_LINE_LIST_ADJACENCY, RHW_LINE_LIST, 10, {1, 2, 5, 6}, 4},
        {RHW_LINE_STRIP_ADJACENCY, RHW_LINE_LIST, 6, {1, 2, 2, 3, 3, 4}, 6},
        {RHW_TRIANGLE_LIST_ADJACENCY, RHW_TRIANGLE_LIST, 13, {0, 2, 4, 6, 8, 10}, 6},
        {RHW_TRIANGLE_STRIP_ADJACENCY, RHW_TRIANGLE_LIST, 11, {0, 2, 4, 2, 6, 4, 4, 6, 8}, 9},
        {RHW_TRIANGLE_STRIP_ADJACENCY, RHW_TRIANGLE_LIST, 5, {0}, 0},
        {RHW_LINE_STRIP, RHW_LINE_LIST, 1, {0}, 0},
        {RHW_LINE_STRIP_ADJACENCY, RHW_LINE_LIST, 3, {0}, 0},
    };
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    struct rig_vertex v[VERTICES], list[40];
    uint64_t random = 5;
    for (int i = 0; i < VERTICES; i++) {
        v[i] = vertex_at(&rig, rig_random_float(&random, 0, SIZE), rig_random_float(&random, 0, SIZE), 1,
                         (float)(i + 1));
    }
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (int i = 0; i < cases[k].pick_count; i++) {
            list[i] = v[cases[k].picks[i]];
        }
        rig.pipeline.topology = cases[k].list;
        rig_draw_once(&rig, list, cases[k].pick_count == 0 ? 1 : cases[k].pick_count);
        const uint64_t expected = rig_hash(&rig, 0);
        rig.pipeline.topology = cases[k].topology;
        rig_draw_once(&rig, v, cases[k].count);
        assert_int_equal(rig.stats.triangles_in,
                         cases[k].pick_count / (cases[k].list == RHW_LINE_LIST ? 2 : 3));
        if (rig_hash(&rig, 0) != expected) {
            fail_msg("case %d differs from its list", (int)k);
        }
    }
    rig_close(&rig);
}

static void test_restart_cuts_every_topology(void **state)
{
    (void)state;
    enum { R = 0xffff };
    static const uint16_t indices[] = {0, 1, 2, 3, R, 4, 5, 6, R, R, 7, 8, 9, 10, 11, 12, 13, R, 1};
    static const struct {
        enum rhw_topology topology;
        int primitives;
    } cases[] = {{RHW_POINT_LIST, 15},
                 {RHW_LINE_LIST, 2 + 1 + 3},
                 {RHW_LINE_STRIP, 3 + 2 + 6},
                 {RHW_LINE_LOOP, 4 + 3 + 7},
                 {RHW_TRIANGLE_LIST, 1 + 1 + 2},
                 {RHW_TRIANGLE_STRIP, 2 + 1 + 5},
                 {RHW_TRIANGLE_FAN, 2 + 1 + 5},
                 {RHW_LINE_LIST_ADJACENCY, 1 + 1},
                 {RHW_LINE_STRIP_ADJACENCY, 1 + 4},
                 {RHW_TRIANGLE_LIST_ADJACENCY, 1},
                 {RHW_TRIANGLE_STRIP_ADJACENCY, 1}};
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.primitive_restart = true;
    struct rig_vertex v[14];
    uint64_t random = 5;
    for (int i = 0; i < 14; i++) {
        v[i] = vertex_at(&rig, rig_random_float(&random, 0, SIZE), rig_random_float(&random, 0, SIZE), 1, 1);
    }
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        rig.pipeline.topology = cases[k].topology;
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, v, sizeof v);
        rig_use_indices(&rig, RHW_INDEX_UINT16, indices, sizeof indices);
        rhw_pass_draw_indexed(rig.context, rig.recording, 0, sizeof indices / sizeof *indices, 0, 0, 1);
        rig_end(&rig);
        if (rig.stats.triangles_in != (uint64_t)cases[k].primitives) {
            fail_msg("topology %d: %d primitives instead of %d", (int)cases[k].topology,
                     (int)rig.stats.triangles_in, cases[k].primitives);
        }
    }
    rig_close(&rig);
}

// Many lines, some cut: the same bytes on every path, with any number of triangles in the bins.
static void test_paths_agree(void **state)
{
    (void)state;
    enum { LINES = 4000 };
    struct rig_vertex *const v = malloc(2 * LINES * sizeof *v);
    assert_non_null(v);
    uint64_t hashes[3];
    for (int k = 0; k < 3; k++) {
        struct rig rig;
        struct rhw_context_def def = rhw_context_def_default();
        def.paths = k == 1 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL;
        def.threads = k + 1;
        def.bin_memory = k == 2 ? 1 << 16 : 0;
        rig_open_with(&rig, SIZE, SIZE, &def);
        rig.pipeline.topology = RHW_LINE_LIST;
        rig_set_depth(&rig);
        rig.pipeline.line_width = 1.5f;
        rig.pipeline.program.varyings[0].derivatives = true;
        uint64_t random = 9;
        for (int i = 0; i < 2 * LINES; i++) {
            const float x = rig_random_float(&random, -20, SIZE + 20),
                        y = rig_random_float(&random, -20, SIZE + 20);
            const float spread = i % 9 == 0 ? 1 : 0.05f;
            v[i] = vertex_at(&rig, x, y, rig_random_float(&random, 0.5f, 2), (float)i);
            if (i % 2 == 1 && i % 9 != 0) {
                for (int c = 0; c < 2; c++) {
                    v[i].position[c] = v[i - 1].position[c] + spread * v[i].position[c];
                }
                v[i].position[3] = v[i - 1].position[3];
            }
            v[i].position[2] = rig_random_float(&random, -0.2f, 1.5f);
        }
        rig_draw_once(&rig, v, 2 * LINES);
        assert_true(rig.stats.triangles_clipped > 100);
        assert_true(rig.stats.triangles_in == rig.stats.triangles_culled + rig.stats.triangles_dropped +
                                                  rig.stats.triangles_rasterized);
        hashes[k] = rig_hash(&rig, 0);
        rig_close(&rig);
    }
    free(v);
    assert_true(hashes[0] == hashes[1]);
    assert_true(hashes[0] == hashes[2]);
}

static void test_widths_out_of_range_are_misuse(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    static const float widths[] = {0.5f, -1, 256.5f, NAN};
    for (int i = 0; i < 4; i++) {
        rig.pipeline.line_width = widths[i];
        rhw_pipeline pipeline;
        assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, "it must be 1..256, or 0 for 1");
    }
    rig_close(&rig);
}

// What the pass sets stands in the place of the pipelines' own, 3 pixels, until it sets 0. Rows of lines through
// middles.
static void test_widths_of_the_pass(void **state)
{
    (void)state;
    static const struct {
        double y;
        float set; // -1: nothing
        int first, rows;
    } lines[] = {{4.5, -1, 3, 3},    {14.5, 7, 11, 7}, {22.5, -1, 19, 7},    {26.5, 1, 26, 1},
                 {45.5, 31, 30, 31}, {64.5, 0, 63, 3}, {74.5, 4.75f, 72, 5}, {84.5, 0, 83, 3}};
    enum { LINES = sizeof lines / sizeof *lines };
    for (int mode = RHW_LINE_RECTANGULAR; mode <= RHW_LINE_BRESENHAM; mode++) {
        struct rig rig;
        struct rig_vertex v[2 * LINES];
        open_rig(&rig, RHW_PATHS_ALL);
        rig.pipeline.line_mode = (enum rhw_line_mode)mode;
        rig.pipeline.line_width = 3;
        bool wanted[SIZE] = {false};
        for (int i = 0; i < LINES; i++) {
            v[2 * i] = vertex_at(&rig, 4, lines[i].y, 1, 1);
            v[2 * i + 1] = vertex_at(&rig, 90, lines[i].y, 1, 1);
            for (int y = 0; y < lines[i].rows; y++) {
                wanted[lines[i].first + y] = true;
            }
        }
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, v, sizeof v);
        for (int i = 0; i < LINES; i++) {
            if (lines[i].set >= 0) {
                rhw_pass_set_line_width(rig.context, rig.recording, lines[i].set);
            }
            rhw_pass_draw(rig.context, rig.recording, (uint32_t)(2 * i), 2, 0, 1);
        }
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int y = 0; y < SIZE; y++) {
            if ((pixels[y * SIZE + 48][3] != 0) != wanted[y]) {
                fail_msg("mode %d, row %d: expected %d", mode, y, wanted[y]);
            }
        }
        rig_close(&rig);
    }
}

// Edges of triangles, and lines of strips with a stipple: the bytes of a pipeline with that width.
static void test_widths_of_edges_and_strips(void **state)
{
    (void)state;
    for (int n = 0; n < 6; n++) {
        struct rig rig;
        open_rig(&rig, n % 2 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL);
        rig.pipeline.line_mode = (enum rhw_line_mode)(n / 2);
        rig.pipeline.topology = n % 2 ? RHW_TRIANGLE_LIST : RHW_LINE_STRIP;
        rig.pipeline.polygon_mode = RHW_POLYGON_LINE;
        rig.pipeline.line_stipple = (struct rhw_line_stipple){2, 0x6b2d};
        const struct rig_vertex v[3] = {vertex_at(&rig, 11.25, 20.5, 1, 0.25f),
                                        vertex_at(&rig, 80.75, 33.5, 2, 0.5f),
                                        vertex_at(&rig, 50.5, 77.125, 1, 1)};
        uint64_t hashes[3];
        for (int i = 0; i < 3; i++) {
            rig.pipeline.line_width = i == 0 ? 5.5f : 2;
            rig_begin(&rig);
            if (i == 1) {
                rhw_pass_set_line_width(rig.context, rig.recording, 5.5f);
            }
            rig_draw(&rig, v, 3);
            rig_end(&rig);
            hashes[i] = rig_hash(&rig, 0);
        }
        assert_true(hashes[0] == hashes[1]);
        assert_true(hashes[0] != hashes[2]); // the next pass has the pipelines' own
        rig_close(&rig);
    }
}

static void test_widths_of_the_pass_are_checked(void **state)
{
    (void)state;
    static const float widths[] = {0.5f, -1, 256.5f, NAN};
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig_begin(&rig);
    for (int i = 0; i < 4; i++) {
        rhw_pass_set_line_width(rig.context, rig.recording, widths[i]);
        rig_expect_misuse(&rig, "it must be 1..256, or 0 for the pipelines' own");
    }
    rhw_pass_set_line_width(rig.context, rig.recording, RHW_MAX_LINE_WIDTH);
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_coverage_is_the_rectangle),
    cmocka_unit_test(test_values_follow_the_line),
    cmocka_unit_test(test_a_thin_line_has_a_pixel_a_column),
    cmocka_unit_test(test_clipped_lines_keep_their_values),
    cmocka_unit_test(test_a_line_from_behind_the_eye),
    cmocka_unit_test(test_flat_values_are_the_provoking_vertex_s),
    cmocka_unit_test(test_topologies_are_their_lists),
    cmocka_unit_test(test_restart_cuts_every_topology),
    cmocka_unit_test(test_paths_agree),
    cmocka_unit_test(test_widths_out_of_range_are_misuse),
    cmocka_unit_test(test_widths_of_the_pass),
    cmocka_unit_test(test_widths_of_edges_and_strips),
    cmocka_unit_test(test_widths_of_the_pass_are_checked),
};

const struct unit_tests test_lines = UNIT_TESTS(tests, NULL, NULL);
