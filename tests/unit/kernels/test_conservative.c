// SPDX-License-Identifier: MIT
// Conservative rasterization against whole numbers: of every pixel, whether its square and the snapped triangle have a point
// in common, or the square lies within it. Clipping, samples, values, topologies, what is refused.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 150, PIXELS = SIZE * SIZE };

static void open_rig(struct rig *rig, enum rhw_paths paths)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
}

static struct rig_vertex vertex_at(const struct rig *rig, double x, double y)
{
    struct rig_vertex v = {.value = {1, 1, 0, 1}};
    rig_place(rig, (float)x, (float)y, 0.5f, 1, v.position);
    return v;
}

struct corner {
    int64_t x, y; // 1/256 pixel
};

// Twice the area of a, b, p; above 0 where they turn one way.
static int64_t turn(struct corner a, struct corner b, struct corner p)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

static int64_t least_of(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t most_of(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

// Two convex shapes have nothing in common exactly where the line of one side of either has them on its two sides.
static bool covers(const struct corner t[3], bool contains, int x, int y)
{
    const int64_t sign = turn(t[0], t[1], t[2]) < 0 ? -1 : 1;
    const int64_t left = 256 * x, right = left + 256, top = 256 * y, bottom = top + 256;
    if (!contains && (least_of(least_of(t[0].x, t[1].x), t[2].x) > right ||
                      most_of(most_of(t[0].x, t[1].x), t[2].x) < left ||
                      least_of(least_of(t[0].y, t[1].y), t[2].y) > bottom ||
                      most_of(most_of(t[0].y, t[1].y), t[2].y) < top)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        int inside = 0;
        for (int c = 0; c < 4; c++) {
            const struct corner p = {c & 1 ? right : left, c & 2 ? bottom : top};
            inside += sign * turn(t[i], t[(i + 1) % 3], p) >= 0;
        }
        if (inside == 0 || (contains && inside < 4)) {
            return false;
        }
    }
    return turn(t[0], t[1], t[2]) != 0;
}

static void random_triangle(struct corner t[3], int n, uint64_t *random)
{
    static const int steps[] = {1, 256, 64, 1, 128},
                     ranges[] = {SIZE * 256, SIZE * 256, 8 * 256, 2 * 256, 70 * 256};
    const int range = ranges[n % 5 == 1 ? 1 : (n / 5) % 5], step = steps[n % 5];
    const int from = range < SIZE * 256 ? rig_random_int(random, SIZE * 256 - range) : -20 * 256;
    for (int i = 0; i < 3; i++) {
        t[i].x = (from + rig_random_int(random, range + (from < 0 ? 40 * 256 : 0))) / step * step;
        t[i].y = (from + rig_random_int(random, range + (from < 0 ? 40 * 256 : 0))) / step * step;
    }
    if (n % 7 == 3) { // a sliver
        t[2].x = t[1].x + rig_random_int(random, 5) - 2;
        t[2].y = t[1].y + rig_random_int(random, 5) - 2;
    }
    if (n % 11 == 5) { // along a border of pixels
        t[0].x = t[1].x = (t[0].x + 128) / 256 * 256;
    }
}

static void expect_covered(struct rig *rig, const struct corner t[3], enum rhw_conservative mode, int n)
{
    struct rig_vertex v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = vertex_at(rig, (double)t[i].x / 256, (double)t[i].y / 256);
    }
    rig->pipeline.conservative = mode;
    rig_draw_once(rig, v, 3);
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < PIXELS; i++) {
        const bool wanted = covers(t, mode == RHW_CONSERVATIVE_UNDERESTIMATE, i % SIZE, i / SIZE);
        if ((pixels[i][3] != 0) != wanted) {
            fail_msg("triangle %d, mode %d, pixel %d, %d: expected %d; %d,%d %d,%d %d,%d", n, mode, i % SIZE,
                     i / SIZE, wanted, (int)t[0].x, (int)t[0].y, (int)t[1].x, (int)t[1].y, (int)t[2].x,
                     (int)t[2].y);
        }
    }
}

static void test_squares(void **state)
{
    (void)state;
    for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL; paths += RHW_PATHS_GENERAL) {
        struct rig rig;
        open_rig(&rig, (enum rhw_paths)paths);
        uint64_t random = 21;
        for (int n = 0; n < 150; n++) {
            struct corner t[3];
            random_triangle(t, n, &random);
            expect_covered(&rig, t, RHW_CONSERVATIVE_OVERESTIMATE, n);
            expect_covered(&rig, t, RHW_CONSERVATIVE_UNDERESTIMATE, n);
        }
        rig_close(&rig);
    }
}

// By hand: a triangle within a pixel touches that one and contains none; one on the borders of 2 × 2 pixels touches 16,
// less the three that lie beyond its long side.
static void test_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    static const struct {
        struct corner t[3];
        int touched, contained;
    } cases[] = {
        {{{10 * 256 + 30, 10 * 256 + 30}, {10 * 256 + 60, 10 * 256 + 30}, {10 * 256 + 30, 10 * 256 + 60}},
         1,
         0},
        {{{20 * 256, 20 * 256}, {22 * 256, 20 * 256}, {20 * 256, 22 * 256}}, 13, 1}};
    for (int i = 0; i < 2; i++) {
        for (int mode = 1; mode < 3; mode++) {
            expect_covered(&rig, cases[i].t, (enum rhw_conservative)mode, i);
            const float(*pixels)[4] = rig_read_float4(&rig);
            int count = 0;
            for (int p = 0; p < PIXELS; p++) {
                count += pixels[p][3] != 0;
            }
            assert_int_equal(count, mode == 1 ? cases[i].touched : cases[i].contained);
        }
    }
    rig_close(&rig);
}

// A triangle that reaches behind the eye touches every pixel that it covers, and covers every one that it contains.
static void test_clipped(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    uint64_t random = 4;
    for (int n = 0; n < 40; n++) {
        struct rig_vertex v[3] = {0};
        for (int i = 0; i < 3; i++) {
            const float w = i == 0 ? -0.5f : rig_random_float(&random, 0.5f, 2);
            v[i].value[0] = v[i].value[3] = 1;
            v[i].position[0] = rig_random_float(&random, -1, 1) * w;
            v[i].position[1] = rig_random_float(&random, -1, 1) * w;
            v[i].position[2] = (i == 0 ? -0.2f : 0.5f) * (w < 0 ? 1 : w);
            v[i].position[3] = w;
        }
        static bool drawn[3][PIXELS];
        for (int mode = 0; mode < 3; mode++) {
            rig.pipeline.conservative = (enum rhw_conservative)mode;
            rig_draw_once(&rig, v, 3);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int i = 0; i < PIXELS; i++) {
                drawn[mode][i] = pixels[i][3] != 0;
            }
        }
        for (int i = 0; i < PIXELS; i++) {
            const bool touched = drawn[RHW_CONSERVATIVE_OVERESTIMATE][i],
                       contained = drawn[RHW_CONSERVATIVE_UNDERESTIMATE][i];
            assert_true((!drawn[0][i] || touched) && (!contained || drawn[0][i]));
        }
    }
    rig_close(&rig);
}

// All samples of a pixel, so that what is resolved is what one sample shows; values go on linearly beyond the triangle.
static void test_samples_and_values(void **state)
{
    (void)state;
    static float alone[PIXELS][4];
    for (int samples = 1; samples <= 4; samples *= 2) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        rig.pass.samples = samples;
        rig.pipeline.conservative = RHW_CONSERVATIVE_OVERESTIMATE;
        rig.pipeline.program.varyings[0].qualifier = RHW_NOPERSPECTIVE;
        struct rig_vertex v[3] = {vertex_at(&rig, 20.25, 30.75), vertex_at(&rig, 90, 41),
                                  vertex_at(&rig, 37, 101.5)};
        for (int i = 0; i < 3; i++) {
            v[i].value[0] = (float[]){20.25f, 90, 37}[i];
            v[i].value[1] = (float[]){30.75f, 41, 101.5f}[i];
        }
        rig_draw_once(&rig, v, 3);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < PIXELS; i++) {
            if (pixels[i][3] != 0) {
                assert_true(fabs((double)pixels[i][0] - (i % SIZE + 0.5)) < 1e-4);
                assert_true(fabs((double)pixels[i][1] - (i / SIZE + 0.5)) < 1e-4);
            }
        }
        if (samples == 1) {
            memcpy(alone, pixels, sizeof alone);
        } else {
            assert_memory_equal(alone, pixels, sizeof alone);
        }
        rig_close(&rig);
    }
}

// Lines, points and edges are drawn as without.
static void test_other_primitives(void **state)
{
    (void)state;
    static const enum rhw_topology topologies[] = {RHW_POINT_LIST, RHW_LINE_STRIP, RHW_TRIANGLE_LIST};
    for (int i = 0; i < 3; i++) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        static float without[PIXELS][4];
        rig.pipeline.topology = topologies[i];
        rig.pipeline.polygon_mode = i == 2 ? RHW_POLYGON_LINE : RHW_POLYGON_FILL;
        const struct rig_vertex v[3] = {vertex_at(&rig, 20.25, 30.75), vertex_at(&rig, 90, 41),
                                        vertex_at(&rig, 37, 101.5)};
        rig_draw_once(&rig, v, 3);
        memcpy(without, rig_read_float4(&rig), sizeof without);
        rig.pipeline.conservative = RHW_CONSERVATIVE_OVERESTIMATE;
        rig_draw_once(&rig, v, 3);
        assert_memory_equal(without, rig_read_float4(&rig), sizeof without);
        rig_close(&rig);
    }
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_pipeline pipeline;
    rig.pipeline.conservative = (enum rhw_conservative)3;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "conservative is 3");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_by_hand),          cmocka_unit_test(test_squares),
    cmocka_unit_test(test_clipped),          cmocka_unit_test(test_samples_and_values),
    cmocka_unit_test(test_other_primitives), cmocka_unit_test(test_misuse)};

const struct unit_tests test_conservative = UNIT_TESTS(tests, NULL, NULL);
