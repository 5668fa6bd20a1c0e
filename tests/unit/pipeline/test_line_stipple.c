// SPDX-License-Identifier: MIT
// Stipples of lines: by hand, and against a slow model that draws each line alone without one and then asks of each of its
// pixels, in whole numbers, where along the line, or its strip, it lies.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 64, MOST = 600 };

static void open_rig(struct rig *rig, enum rhw_line_mode mode, int threads, enum rhw_paths paths)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = threads, .paths = paths});
    rig->pipeline.topology = RHW_LINE_LIST;
    rig->pipeline.line_mode = mode;
}

static struct rig_vertex vertex_at(const struct rig *rig, double x, double y)
{
    struct rig_vertex v = {.value = {1, 1, 1, 1}};
    rig_place(rig, (float)x, (float)y, 0.5f, 1, v.position);
    return v;
}

static void expect_row(struct rig *rig, int y, const char *wanted)
{
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int x = 0; wanted[x] != 0; x++) {
        if ((pixels[y * SIZE + x][3] != 0) != (wanted[x] == '#')) {
            fail_msg("row %d, pixel %d: expected %c in %s", y, x, wanted[x], wanted);
        }
    }
}

static void expect_column(struct rig *rig, int x, const char *wanted)
{
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int y = 0; wanted[y] != 0; y++) {
        if ((pixels[y * SIZE + x][3] != 0) != (wanted[y] == '#')) {
            fail_msg("column %d, pixel %d: expected %c in %s", x, y, wanted[y], wanted);
        }
    }
}

// From the middle of pixel 2 to that of pixel 22, whose diamond the line does not leave: 20 pixels. The lowest bit of the
// pattern comes first.
static void test_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_LINE_BRESENHAM, 2, RHW_PATHS_ALL);
    const struct rig_vertex v[] = {vertex_at(&rig, 2.5, 1.5),   vertex_at(&rig, 22.5, 1.5),
                                   vertex_at(&rig, 22.5, 3.5),  vertex_at(&rig, 2.5, 3.5),
                                   vertex_at(&rig, 40.5, 2.5),  vertex_at(&rig, 40.5, 22.5),
                                   vertex_at(&rig, 42.5, 22.5), vertex_at(&rig, 42.5, 2.5)};
    rig.pipeline.line_stipple = (struct rhw_line_stipple){1, 0x800b};
    rig_draw_once(&rig, v, 8);
    expect_row(&rig, 1, "..##.#...........###.#.....");
    expect_row(&rig, 3, "...#.###...........#.##...");
    expect_column(&rig, 40, "..##.#...........###.#.....");
    expect_column(&rig, 42, "...#.###...........#.##...");
    rig.pipeline.line_stipple = (struct rhw_line_stipple){3, 0x0005};
    rig_draw_once(&rig, v, 8);
    expect_row(&rig, 1, "..###...###..............");
    expect_row(&rig, 3, "..............###...###..");
    rig.pipeline.line_mode =
        RHW_LINE_RECTANGULAR; // pixel 2 lies half a pixel along the line, and pixel 22 beyond it
    rig.pipeline.line_stipple = (struct rhw_line_stipple){1, 0x800b};
    const struct rig_vertex r[] = {vertex_at(&rig, 2, 1.5), vertex_at(&rig, 22, 1.5),
                                   vertex_at(&rig, 22, 3.5), vertex_at(&rig, 2, 3.5)};
    rig_draw_once(&rig, r, 4);
    expect_row(&rig, 1, "..##.#...........###.#.....");
    expect_row(&rig, 3, "..#.###...........#.##..");
    rig_close(&rig);
}

// A strip goes on where the line before it ended; the end of one line and the beginning of the next have one pixel.
static void test_strips(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_LINE_BRESENHAM, 2, RHW_PATHS_ALL);
    rig.pipeline.topology = RHW_LINE_STRIP;
    rig.pipeline.line_stipple = (struct rhw_line_stipple){2, 0x0003};
    const struct rig_vertex v[] = {vertex_at(&rig, 2.5, 1.5), vertex_at(&rig, 4.5, 1.5),
                                   vertex_at(&rig, 40.5, 1.5), vertex_at(&rig, 40.5, 9.5)};
    rig_draw_once(&rig, v, 4);
    expect_row(&rig, 1, "..####............................####..");
    expect_column(&rig, 40, "...........");
    rig.pipeline.topology = RHW_LINE_STRIP_ADJACENCY; // the two lines but the first and the last vertex
    const struct rig_vertex a[] = {v[3], v[0], v[1], v[2], v[0]};
    rig_draw_once(&rig, a, 5);
    expect_row(&rig, 1, "..####............................####..");
    rig.pipeline.topology = RHW_LINE_STRIP;
    rig.pipeline.primitive_restart = true;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, v, sizeof v);
    const uint16_t indices[] = {0, 1, UINT16_MAX, UINT16_MAX, 1, 2, UINT16_MAX, 3};
    rig_use_indices(&rig, RHW_INDEX_UINT16, indices, sizeof indices);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 8, 0, 0, 1);
    rig_end(&rig);
    expect_row(&rig, 1, "..######............................####"); // 2 pixels, then 4 from pixel 4 on
    rig_close(&rig);
}

struct end {
    int64_t x, y; // 1/256 pixel
};

static int64_t root_nearest(int64_t n)
{
    const int64_t root = (int64_t)floorl(sqrtl((long double)n));
    return n - root * root > root ? root + 1 : root;
}

// dot / √n, to the nearest: the p with (2p − 1)·√n <= 2·dot < (2p + 1)·√n, compared by squares.
static int64_t place_nearest(int64_t dot, int64_t n)
{
    __extension__ typedef __int128 wide;
    int64_t p = (int64_t)(sqrtl((long double)dot * (long double)dot / (long double)n));
    while (dot > 0 && (wide)(2 * p + 1) * (2 * p + 1) * n < (wide)4 * dot * dot) {
        p++;
    }
    return dot <= 0 ? 0 : p;
}

static bool is_set(const struct rhw_line_stipple *stipple, int64_t place, int unit)
{
    return stipple->pattern >> (place / (stipple->factor * unit) % 16) & 1;
}

// The pixels of one line by `covered`, its own ones, that begins at `phase`; returns the places up to the next.
static int64_t model_line(const struct rig *rig, const struct end e[2], const bool *covered, int64_t phase,
                          bool *drawn)
{
    const struct rhw_line_stipple *const stipple = &rig->pipeline.line_stipple;
    const int64_t dx = e[1].x - e[0].x, dy = e[1].y - e[0].y, n = dx * dx + dy * dy;
    const bool is_steep = llabs(dy) > llabs(dx), is_bresenham = rig->pipeline.line_mode == RHW_LINE_BRESENHAM;
    if (n == 0) {
        return 0;
    }
    int64_t columns = 0;
    for (int step = 0; step < SIZE && is_bresenham; step++) {
        const int major = (is_steep ? dy : dx) > 0 ? step : SIZE - 1 - step;
        bool any = false;
        for (int minor = 0; minor < SIZE; minor++) {
            const int i = is_steep ? major * SIZE + minor : minor * SIZE + major;
            any |= covered[i];
            drawn[i] |= covered[i] && is_set(stipple, phase + columns, 1);
        }
        columns += any;
    }
    for (int i = 0; i < SIZE * SIZE && !is_bresenham; i++) {
        const int64_t x = 256 * (i % SIZE) + 128 - e[0].x, y = 256 * (i / SIZE) + 128 - e[0].y;
        drawn[i] |= covered[i] && is_set(stipple, phase + place_nearest(dx * x + dy * y, n), 256);
    }
    return is_bresenham ? columns : root_nearest(n);
}

// Draws the ends as a list or a strip, and expects the model's pixels.
static void expect_model(struct rig *rig, const struct end *ends, int count, uint32_t instances)
{
    static struct rig_vertex v[MOST];
    static bool drawn[SIZE * SIZE], covered[SIZE * SIZE];
    const bool is_strip = rig->pipeline.topology == RHW_LINE_STRIP;
    const struct rhw_pipeline_def def = rig->pipeline;
    int64_t phase = 0;
    memset(drawn, 0, sizeof drawn);
    for (int i = 0; i < count; i++) {
        v[i] = vertex_at(rig, (double)ends[i].x / 256, (double)ends[i].y / 256);
    }
    for (int i = 0; i + 1 < count; i += is_strip ? 1 : 2) {
        rig->pipeline.topology = RHW_LINE_LIST;
        rig->pipeline.line_stipple.factor = 0;
        rig_draw_once(rig, v + i, 2);
        const float(*pixels)[4] = rig_read_float4(rig);
        for (int p = 0; p < SIZE * SIZE; p++) {
            covered[p] = pixels[p][3] != 0;
        }
        rig->pipeline.topology = def.topology;
        rig->pipeline.line_stipple = def.line_stipple;
        const int64_t length = model_line(rig, ends + i, covered, phase, drawn);
        phase = is_strip ? phase + length : 0;
    }
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, v, (size_t)count * sizeof *v);
    rhw_pass_draw(rig->context, rig->recording, 0, (uint32_t)count, 0, instances);
    rig_end(rig);
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int p = 0; p < SIZE * SIZE; p++) {
        if ((pixels[p][3] != 0) != drawn[p]) {
            fail_msg("%s, mode %d, width %g, factor %d, pattern %x, %d vertices: pixel %d, %d expected %d",
                     is_strip ? "strip" : "list", (int)def.line_mode, (double)def.line_width,
                     def.line_stipple.factor, def.line_stipple.pattern, count, p % SIZE, p / SIZE, drawn[p]);
        }
    }
}

// Ends at any 1/256 pixel, at corners and at middles of pixels, some the same as the one before.
static void random_ends(struct end *ends, int count, uint64_t *seed)
{
    static const int steps[] = {1, 256, 128, 16};
    for (int i = 0; i < count; i++) {
        const int step = steps[rig_random_int(seed, 4)];
        ends[i].x = 4 * 256 + rig_random_int(seed, (SIZE - 8) * 256 / step) * step;
        ends[i].y = 4 * 256 + rig_random_int(seed, (SIZE - 8) * 256 / step) * step;
        if (i > 0 && rig_random_int(seed, 8) == 0) {
            ends[i] = ends[i - 1];
        }
    }
}

static void test_model(void **state)
{
    (void)state;
    uint64_t seed = 16;
    for (int round = 0; round < 48; round++) {
        struct end ends[24];
        struct rig rig;
        open_rig(&rig, (enum rhw_line_mode)(round & 1), 1 + round % 3,
                 round % 5 == 0 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL);
        rig.pipeline.topology = round & 2 ? RHW_LINE_STRIP : RHW_LINE_LIST;
        rig.pipeline.line_width = round % 3 == 0 ? 1 : (float)rig_random_int(&seed, 6) + 1;
        rig.pipeline.line_stipple.factor = round % 7 == 6 ? 256 : 1 + rig_random_int(&seed, 5);
        rig.pipeline.line_stipple.pattern = (uint16_t)rig_random_int(&seed, 65536);
        random_ends(ends, 24, &seed);
        expect_model(&rig, ends, 24, 1 + (uint32_t)(round & 1));
        rig_close(&rig);
    }
}

// More lines than a chunk has, in short steps, so that the phases of later chunks follow from all before.
static void test_long_strips(void **state)
{
    (void)state;
    for (int mode = 0; mode < 2; mode++) {
        for (int threads = 1; threads <= 3; threads++) {
            static struct end ends[MOST];
            uint64_t seed = 7;
            struct rig rig;
            for (int i = 0; i < MOST; i++) { // a spiral
                const double angle = i * 0.13, radius = 2 + i * 0.045;
                ends[i].x = (int64_t)(256 * (32 + radius * cos(angle))) + rig_random_int(&seed, 3);
                ends[i].y = (int64_t)(256 * (32 + radius * sin(angle)));
            }
            open_rig(&rig, (enum rhw_line_mode)mode, threads, RHW_PATHS_ALL);
            rig.pipeline.topology = RHW_LINE_STRIP;
            rig.pipeline.line_stipple = (struct rhw_line_stipple){3, 0x3471};
            expect_model(&rig, ends, MOST, 2);
            rig_close(&rig);
        }
    }
}

// The pieces of a rectangle are cut between the samples of a pixel: from 2.25 on, of pixels with samples at 0.375, 0.875,
// 0.125 and 0.625 across, three belong to one piece and one to that before.
static void test_samples(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_LINE_RECTANGULAR, 2, RHW_PATHS_ALL);
    rig.pass.samples = 4;
    rig.pipeline.line_width = 4;
    rig.pipeline.line_stipple = (struct rhw_line_stipple){1, 0x5555};
    const struct rig_vertex v[] = {vertex_at(&rig, 2.25, 8), vertex_at(&rig, 6.25, 8)};
    rig_draw_once(&rig, v, 2);
    const float(*pixels)[4] = rig_read_float4(&rig);
    static const float wanted[] = {0, 0, 0.75f, 0.25f, 0.75f, 0.25f, 0, 0};
    for (int y = 6; y < 10; y++) {
        for (int x = 0; x < 8; x++) {
            assert_float_equal(pixels[y * SIZE + x][0], wanted[x], 0);
        }
    }
    rig.pipeline.line_mode = RHW_LINE_BRESENHAM; // whole pixels
    rig_draw_once(&rig, v, 2);
    pixels = rig_read_float4(&rig);
    for (int x = 2; x < 6; x++) {
        assert_float_equal(pixels[8 * SIZE + x][0], (float)(x % 2 == 0), 0);
    }
    rig_close(&rig);
}

// Each edge of a triangle begins anew; a line that a plane cuts begins where it is cut; what lies beside the view counts.
static void test_edges_and_clipping(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_LINE_BRESENHAM, 2, RHW_PATHS_ALL);
    rig.pipeline.line_stipple = (struct rhw_line_stipple){4, 0x0001};
    rig.pipeline.topology = RHW_TRIANGLE_LIST;
    rig.pipeline.polygon_mode = RHW_POLYGON_LINE;
    const struct rig_vertex t[] = {vertex_at(&rig, 4.5, 4.5), vertex_at(&rig, 44.5, 4.5),
                                   vertex_at(&rig, 44.5, 34.5)};
    rig_draw_once(&rig, t, 3);
    expect_row(&rig, 4, "....####....................................#....");
    expect_column(&rig, 44, "....####....................");
    rig.pipeline.polygon_mode = RHW_POLYGON_FILL;
    rig.pipeline.topology = RHW_LINE_LIST;
    struct rig_vertex v[] = {vertex_at(&rig, 4.5, 4.5), vertex_at(&rig, 44.5, 4.5)};
    v[0].position[2] = -0.5f; // depth 0 is a third on, at 17.83, in the diamond of pixel 17
    v[1].position[2] = 1;
    rig_draw_once(&rig, v, 2);
    expect_row(&rig, 4, ".................####........................");
    rig.pipeline.topology = RHW_LINE_STRIP; // 6 pixels to the left of the view, then pixel 0
    const struct rig_vertex s[] = {vertex_at(&rig, -5.5, 4.5), vertex_at(&rig, 0.5, 4.5),
                                   vertex_at(&rig, 20.5, 4.5)};
    rig.pipeline.line_stipple = (struct rhw_line_stipple){1, 0x0180};
    rig_draw_once(&rig, s, 3);
    expect_row(&rig, 4, ".##..............##.");
    rig_close(&rig);
}

static void test_pass_sets(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_LINE_BRESENHAM, 2, RHW_PATHS_ALL);
    rig.pipeline.line_stipple = (struct rhw_line_stipple){1, 0x00ff};
    const struct rig_vertex v[] = {vertex_at(&rig, 0.5, 1.5), vertex_at(&rig, 16.5, 1.5),
                                   vertex_at(&rig, 0.5, 3.5), vertex_at(&rig, 16.5, 3.5),
                                   vertex_at(&rig, 0.5, 5.5), vertex_at(&rig, 16.5, 5.5)};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, v, sizeof v);
    rhw_pass_set_line_stipple(rig.context, rig.recording, &(struct rhw_line_stipple){1, 0x0ff0});
    rhw_pass_draw(rig.context, rig.recording, 0, 2, 0, 1);
    rhw_pass_set_line_stipple(rig.context, rig.recording, NULL);
    rhw_pass_draw(rig.context, rig.recording, 2, 2, 0, 1);
    rhw_pass_set_line_stipple(rig.context, rig.recording, &(struct rhw_line_stipple){0});
    rhw_pass_draw(rig.context, rig.recording, 4, 2, 0, 1);
    rig_end(&rig);
    expect_row(&rig, 1, "....########....");
    expect_row(&rig, 3, "########........");
    expect_row(&rig, 5, "################");
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_pipeline pipeline;
    rig.pipeline.line_stipple.factor = 257;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "line_stipple.factor is 257; it must be 1..256");
    rig_begin(&rig);
    rhw_pass_set_line_stipple(rig.context, rig.recording, &(struct rhw_line_stipple){-1, 1});
    rig_expect_misuse(&rig, "rhw_pass_set_line_stipple: line_stipple.factor is -1; it must be 1..256");
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_by_hand),   cmocka_unit_test(test_strips),
    cmocka_unit_test(test_model),     cmocka_unit_test(test_long_strips),
    cmocka_unit_test(test_samples),   cmocka_unit_test(test_edges_and_clipping),
    cmocka_unit_test(test_pass_sets), cmocka_unit_test(test_misuse)};

const struct unit_tests test_line_stipple = UNIT_TESTS(tests, NULL, NULL);
