// SPDX-License-Identifier: MIT
// Bresenham lines against the diamond-exit rule as Vulkan words it, pixel by pixel in whole numbers: a pixel is drawn where
// the line meets its diamond and does not end there. Strips, values, several samples, what is refused.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 96 };

static void open_rig(struct rig *rig, enum rhw_paths paths)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig->pipeline.topology = RHW_LINE_LIST;
    rig->pipeline.line_mode = RHW_LINE_BRESENHAM;
}

static struct rig_vertex vertex_at(const struct rig *rig, double x, double y, float w, float value)
{
    struct rig_vertex v = {.value = {value, 1, 0, 1}};
    rig_place(rig, (float)x, (float)y, 0.5f, w, v.position);
    return v;
}

// 1/256 pixel, times 2^40; what −ε and −ε² of the rule stand for is smaller than anything two lines can differ by here.
__extension__ typedef __int128 exact;

static const exact one = (exact)1 << 40, epsilon = (exact)1 << 20, epsilon_squared = 1;

struct point {
    exact x, y;
};

static struct point moved(const int ends[2])
{
    return (struct point){ends[0] * one - epsilon, ends[1] * one - epsilon_squared};
}

// Below 0 on the inner side of one of the four sides of a pixel's diamond.
static exact side(struct point p, int x, int y, int which)
{
    const exact u = p.x - (256 * x + 128) * one, v = p.y - (256 * y + 128) * one;
    return (which & 1 ? u : -u) + (which & 2 ? v : -v) - 128 * one;
}

struct part { // of the line, between 0 and 1
    exact over, under;
};

static bool is_before(struct part a, struct part b)
{
    return a.over * b.under < b.over * a.under;
}

static bool leaves_diamond(struct point a, struct point b, int x, int y)
{
    struct part from = {0, 1}, to = {1, 1};
    bool ends_inside = true;
    for (int which = 0; which < 4; which++) {
        const exact at_a = side(a, x, y, which), at_b = side(b, x, y, which);
        ends_inside = ends_inside && at_b < 0;
        if (at_a >= 0 && at_b >= 0) {
            return false;
        }
        // Scaled down so that products fit; exact, as both are multiples of what is left out or differ by far more.
        const struct part cut = {at_a > at_b ? at_a : -at_a, at_a > at_b ? at_a - at_b : at_b - at_a};
        if (at_a > at_b && at_a >= 0 && is_before(from, cut)) {
            from = cut;
        } else if (at_b > at_a && at_b >= 0 && is_before(cut, to)) {
            to = cut;
        }
    }
    return is_before(from, to) && !ends_inside;
}

static void expect_lines(struct rig *rig, const int (*ends)[2][2], int lines, int width, int number)
{
    struct rig_vertex v[32];
    static bool drawn[SIZE * SIZE];
    memset(drawn, 0, sizeof drawn);
    for (int i = 0; i < lines; i++) {
        const int dx = ends[i][1][0] - ends[i][0][0], dy = ends[i][1][1] - ends[i][0][1];
        const bool is_steep = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
        int shifted[2][2];
        for (int k = 0; k < 2; k++) {
            v[2 * i + k] = vertex_at(rig, ends[i][k][0] / 256.0, ends[i][k][1] / 256.0, 1, 1);
            shifted[k][0] = ends[i][k][0] - (is_steep ? 128 * (width - 1) : 0);
            shifted[k][1] = ends[i][k][1] - (is_steep ? 0 : 128 * (width - 1));
        }
        const struct point a = moved(shifted[0]), b = moved(shifted[1]);
        for (int p = -SIZE * SIZE; p < 2 * SIZE * SIZE; p++) {
            const int x = (p + SIZE * SIZE) % SIZE, y = (p + SIZE * SIZE) / SIZE - SIZE;
            // Rows above and below the picture too: of wide lines a part may be in it. Columns likewise.
            for (int shift = 0; shift < (is_steep ? width : 1); shift++) {
                if (!leaves_diamond(a, b, x - shift, y)) {
                    continue;
                }
                for (int w = 0; w < (is_steep ? 1 : width); w++) {
                    if (y + w >= 0 && y + w < SIZE) {
                        drawn[(y + w) * SIZE + x] = true;
                    }
                }
            }
        }
    }
    rig_draw_once(rig, v, 2 * lines);
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        if ((pixels[i][3] != 0) != drawn[i]) {
            fail_msg("line %d, %d,%d to %d,%d wide %d, pixel %d, %d: expected %d", number, ends[0][0][0],
                     ends[0][0][1], ends[0][1][0], ends[0][1][1], width, i % SIZE, i / SIZE, drawn[i]);
        }
    }
}

// Near and far, on and between the corners of diamonds, in every direction.
static void test_diamonds(void **state)
{
    (void)state;
    static const int steps[] = {1, 64, 128, 256, 32};
    for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL; paths += RHW_PATHS_GENERAL) {
        struct rig rig;
        open_rig(&rig, (enum rhw_paths)paths);
        uint64_t random = 5;
        for (int n = 0; n < 500; n++) {
            const int range = n % 2 ? SIZE * 256 : n % 4 ? 3 * 256 : 12 * 256, from = n % 2 ? 0 : 62 * 256;
            const int step = steps[n % 5];
            int ends[1][2][2];
            for (int k = 0; k < 4; k++) {
                ends[0][k / 2][k % 2] = (from + rig_random_int(&random, range)) / step * step;
            }
            const int width = n % 7 == 0 ? 1 + rig_random_int(&random, 5) : 1;
            rig.pipeline.line_width = (float)width + (width > 1 ? 0.4f : 0);
            expect_lines(&rig, (const int(*)[2][2])ends, 1, width, n);
        }
        rig_close(&rig);
    }
}

// By hand: from the middle of a pixel to that of another, the last one is left out.
static void test_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    const struct rig_vertex v[2] = {vertex_at(&rig, 2.5, 3.5, 1, 1), vertex_at(&rig, 7.5, 5.5, 1, 1)};
    rig_draw_once(&rig, v, 2);
    const float(*pixels)[4] = rig_read_float4(&rig);
    static const int rows[] = {3, 3, 4, 4, 5}; // at 4.5 the line is at 4.3, at 5.5 at 4.7
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int x = i % SIZE, y = i / SIZE;
        count += pixels[i][3] != 0;
        if (x >= 2 && x < 7) {
            assert_int_equal(pixels[i][3] != 0, y == rows[x - 2]);
        }
    }
    assert_int_equal(count, 5);
    rig_close(&rig);
}

// A closed strip has each of its pixels once: where lines meet nothing is missing and nothing is drawn twice, whichever
// way they go on.
static void test_strips_meet(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.topology = RHW_LINE_STRIP;
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    uint64_t random = 3;
    for (int n = 0; n < 60; n++) {
        enum { CORNERS = 24 };
        struct rig_vertex v[CORNERS + 1];
        for (int i = 0; i < CORNERS; i++) { // to the right at slopes below 1: no column is entered twice
            const double x = 4 + 3.5 * i + rig_random_int(&random, 256) / 256.0;
            const double y = 48 + rig_random_int(&random, 500) / 256.0;
            v[i] = vertex_at(&rig, x, y, 1, 1);
        }
        rig_draw_once(&rig, v, CORNERS);
        const float(*pixels)[4] = rig_read_float4(&rig);
        int columns = 0, first = SIZE, last = 0;
        for (int x = 0; x < SIZE; x++) {
            double sum = 0;
            for (int y = 0; y < SIZE; y++) {
                sum += (double)pixels[y * SIZE + x][3];
            }
            assert_true(sum == 0 || sum == 1);
            columns += sum != 0;
            first = sum != 0 && x < first ? x : first;
            last = sum != 0 ? x : last;
        }
        assert_int_equal(columns, last - first + 1);
    }
    rig_close(&rig);
}

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
            assert_true(fabs((double)colors[i][0] - value) < 0.001);
            assert_true(fabs((double)depth[i] - (za + t * (zb - za))) < 1e-6);
            seen++;
        }
    }
    assert_int_equal(seen, 64 * 3);
    rig_close(&rig);
}

// A line that begins beyond its first pixel's centre has that pixel still; depth does not leave the view there.
static void test_depth_is_held(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig_set_depth(&rig);
    rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    for (int reversed = 0; reversed < 2; reversed++) {
        struct rig_vertex v[2] = {vertex_at(&rig, 10.75, 20.5, 1, 1), vertex_at(&rig, 14, 21, 1, 1)};
        v[0].position[2] = reversed ? 0.99f : 0.01f;
        v[1].position[2] = reversed ? 0.01f : 0.99f;
        rig_draw_once(&rig, v, 2);
        assert_true(rig_read_float4(&rig)[20 * SIZE + 10][3] != 0);
        assert_true(rig_read_depth(&rig)[20 * SIZE + 10] == (reversed ? 1.0f : 0.0f));
    }
    rig_close(&rig);
}

// Every sample of a pixel, and of no other: a resolved picture is that of one sample, depth by depth.
static void test_samples(void **state)
{
    (void)state;
    static float alone[SIZE * SIZE][4];
    for (int samples = 1; samples <= 8; samples *= 2) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        rig_set_depth(&rig);
        rig.pass.samples = samples;
        uint64_t random = 9;
        struct rig_vertex v[40];
        for (int i = 0; i < 40; i++) {
            v[i] = vertex_at(&rig, rig_random_int(&random, 256 * SIZE) / 256.0,
                             rig_random_int(&random, 256 * SIZE) / 256.0, 1, (float)(i / 2 + 1));
            v[i].position[2] = (float)(i / 2) / 40;
        }
        rig.pipeline.line_width = 2;
        rig.pipeline.depth_compare = RHW_COMPARE_LESS;
        rig_draw_once(&rig, v, 40);
        if (samples == 1) {
            memcpy(alone, rig_read_float4(&rig), sizeof alone);
        } else {
            assert_memory_equal(alone, rig_read_float4(&rig), sizeof alone);
        }
        rig_close(&rig);
    }
}

// The edges of a triangle, each corner of which begins one, and lines that leave the view: what is within is what was
// there before.
static void test_edges_and_clipping(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.topology = RHW_TRIANGLE_LIST;
    rig.pipeline.polygon_mode = RHW_POLYGON_LINE;
    struct rig_vertex v[3] = {vertex_at(&rig, 10.5, 10.5, 1, 1), vertex_at(&rig, 80.5, 10.5, 1, 1),
                              vertex_at(&rig, 10.5, 50.5, 1, 1)};
    for (int first = 0; first < 3; first++) {
        const struct rig_vertex turned[3] = {v[first], v[(first + 1) % 3], v[(first + 2) % 3]};
        rig_draw_once(&rig, turned, 3);
        const float(*const edges)[4] = rig_read_float4(&rig);
        int count = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            count += edges[i][3] != 0;
        }
        assert_int_equal(
            count, 70 + 70 + 40); // pixels 10..79 of the row, columns 80..11, pixels 50..11 of the column
        assert_true(edges[10 * SIZE + 10][3] != 0 && edges[10 * SIZE + 80][3] != 0 &&
                    edges[50 * SIZE + 10][3] != 0);
        assert_true(edges[10 * SIZE + 40][3] != 0 && edges[30 * SIZE + 10][3] != 0 &&
                    edges[11 * SIZE + 40][3] == 0);
    }
    rig.pipeline.topology = RHW_LINE_LIST;
    rig.pipeline.polygon_mode = RHW_POLYGON_FILL;
    const int ends[1][2][2] = {{{-3000 * 256, 20 * 256 + 77}, {2500 * 256, 60 * 256 + 128}}};
    expect_lines(&rig, (const int(*)[2][2])ends, 1, 1, 0);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_pipeline pipeline;
    rig.pipeline.line_mode = (enum rhw_line_mode)3;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "line_mode is 3");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_by_hand),
                                          cmocka_unit_test(test_diamonds),
                                          cmocka_unit_test(test_strips_meet),
                                          cmocka_unit_test(test_values_follow_the_line),
                                          cmocka_unit_test(test_depth_is_held),
                                          cmocka_unit_test(test_samples),
                                          cmocka_unit_test(test_edges_and_clipping),
                                          cmocka_unit_test(test_misuse)};

const struct unit_tests test_bresenham = UNIT_TESTS(tests, NULL, NULL);
