// SPDX-License-Identifier: MIT
// Which pixels a triangle has: exact edges, the top-left rule on pixel centres, shared edges, slivers,
// degenerate triangles, and meshes whose every pixel must be drawn exactly once.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void place_8(const struct rig *rig, int64_t x_8, int64_t y_8, struct rig_vertex *vertex)
{
    rig_place(rig, (float)((double)x_8 / 256), (float)((double)y_8 / 256), 0.5f, 1, vertex->position);
    for (int c = 0; c < 4; c++) {
        vertex->value[c] = 1;
    }
}

static void check_triangle(struct rig *rig, const struct ref_triangle *reference)
{
    struct rig_vertex vertices[3];
    for (int i = 0; i < 3; i++) {
        place_8(rig, reference->x_8[i], reference->y_8[i], &vertices[i]);
    }
    rig_draw_once(rig, vertices, 3);
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int y = 0; y < rig->height; y++) {
        for (int x = 0; x < rig->width; x++) {
            const bool covered = ref_covers(reference, x, y);
            if ((pixels[y * rig->width + x][0] != 0) != covered) {
                fail_msg("pixel %d,%d of (%d,%d) (%d,%d) (%d,%d)/256 is %s", x, y, (int)reference->x_8[0],
                         (int)reference->y_8[0], (int)reference->x_8[1], (int)reference->y_8[1],
                         (int)reference->x_8[2], (int)reference->y_8[2], covered ? "missing" : "too much");
            }
        }
    }
}

// Corners on pixel centres, so that edges pass through many centres exactly.
static void test_edges_through_pixel_centres(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 32, 32);
    uint64_t random = 13;
    for (int n = 0; n < 2000; n++) {
        struct ref_triangle t = {0};
        for (int i = 0; i < 3; i++) {
            t.x_8[i] = rig_random_int(&random, 14) * 256 + 128;
            t.y_8[i] = rig_random_int(&random, 14) * 256 + 128;
        }
        check_triangle(&rig, &t);
    }
    rig_close(&rig);
}

// Triangles of less than 3 pixels each way, half of them with vertices on pixel centres and edges: those that cover
// nothing are counted as culled, whatever their rectangle has, unless the general path draws them to no effect.
static void draw_tiny_triangles(enum rhw_paths paths)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.paths = paths;
    struct rig rig;
    rig_open_with(&rig, 32, 32, &def);
    uint64_t random = 41, culled = 0, uncovered = 0;
    for (int n = 0; n < 4000; n++) {
        const int step = n % 2 ? 1 : 128, at = 256 * rig_random_int(&random, 28);
        struct ref_triangle t = {0};
        for (int i = 0; i < 3; i++) {
            t.x_8[i] = at + step * rig_random_int(&random, 768 / step);
            t.y_8[i] = at + step * rig_random_int(&random, 768 / step);
        }
        check_triangle(&rig, &t);
        bool covers = false;
        for (int i = 0; i < 32 * 32; i++) {
            covers = covers || ref_covers(&t, i % 32, i / 32);
        }
        assert_int_equal(rig.stats.triangles_rasterized + rig.stats.triangles_culled, 1);
        assert_true(rig.stats.triangles_rasterized >= covers);
        culled += rig.stats.triangles_culled;
        uncovered += !covers;
    }
    assert_in_range(uncovered, 400, 3600);
    assert_in_range(culled, 100, uncovered);
    assert_int_equal(paths == RHW_PATHS_ALL, culled == uncovered);
    rig_close(&rig);
}

static void test_tiny_triangles_that_cover_nothing_are_culled(void **state)
{
    (void)state;
    draw_tiny_triangles(RHW_PATHS_ALL);
    draw_tiny_triangles(RHW_PATHS_GENERAL);
}

// Tiny triangles set up beside huge ones, whose edge functions do not fit 32 bits, and a scissor that leaves out most
// of them: what is drawn is what each draws alone.
static void test_tiny_triangles_beside_huge_ones(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    uint64_t random = 43;
    const struct rhw_rect scissor = {8, 8, 30, 30};
    for (int n = 0; n < 300; n++) {
        struct rig_vertex vertices[24];
        struct ref_triangle t[8] = {0};
        for (int i = 0; i < 24; i++) {
            const int reach = i / 3 % 2 ? 600 : 15000 * 256, at = i / 3 % 2 ? 256 * (i / 3 * 6) : -reach / 2;
            t[i / 3].x_8[i % 3] = at + rig_random_int(&random, reach);
            t[i / 3].y_8[i % 3] = at + rig_random_int(&random, reach);
            place_8(&rig, t[i / 3].x_8[i % 3], t[i / 3].y_8[i % 3], &vertices[i]);
        }
        rig_begin(&rig);
        rhw_pass_set_scissor(rig.context, rig.recording, &scissor);
        rig_draw(&rig, vertices, 24);
        rig_end(&rig);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < 64 * 64; i++) {
            const int x = i % 64, y = i / 64;
            bool covered = false;
            for (int k = 0; k < 8; k++) {
                covered = covered || ref_covers(&t[k], x, y);
            }
            assert_int_equal(pixels[i][0] != 0, covered && x >= 8 && x < 38 && y >= 8 && y < 38);
        }
    }
    rig_close(&rig);
}

// Triangles of up to 64 pixels, some of whose corners are pixel centres, cut by a scissor that ends anywhere in them.
static void test_small_triangles_within_a_scissor(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 128, 64);
    rig_set_depth(&rig);
    uint64_t random = 44;
    for (int n = 0; n < 500; n++) {
        const int reach = 4 << n % 5, step = n % 3 ? 1 : 128; // pixels; 1/256 pixel
        const int x = rig_random_int(&random, 100), y = rig_random_int(&random, 40);
        struct ref_triangle t = {0};
        struct rig_vertex vertices[3];
        for (int i = 0; i < 3; i++) {
            t.x_8[i] = 256 * x + step * rig_random_int(&random, reach * 256 / step);
            t.y_8[i] = 256 * y + step * rig_random_int(&random, reach * 256 / step);
            place_8(&rig, t.x_8[i], t.y_8[i], &vertices[i]);
        }
        const struct rhw_rect scissor = {
            x + rig_random_int(&random, reach / 2), y + rig_random_int(&random, reach / 2),
            1 + rig_random_int(&random, reach), 1 + rig_random_int(&random, reach)};
        rig.pipeline.depth_test = n % 2;
        rig_begin(&rig);
        rhw_pass_set_scissor(rig.context, rig.recording, &scissor);
        rig_draw(&rig, vertices, 3);
        rig_end(&rig);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < 128 * 64; i++) {
            const int px = i % 128, py = i / 128;
            const bool within = px >= scissor.x && px < scissor.x + scissor.width && py >= scissor.y &&
                                py < scissor.y + scissor.height;
            assert_int_equal(pixels[i][0] != 0, within && ref_covers(&t, px, py));
        }
    }
    rig_close(&rig);
}

static void test_random_triangles(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 128, 64); // powers of two: positions are exact
    uint64_t random = 14;
    const int reach[] = {3 * 256, 40 * 256, 100 * 256, 2000 * 256, 15000 * 256};
    for (int n = 0; n < 1500; n++) {
        struct ref_triangle t = {0};
        const int r = reach[n % 5];
        for (int i = 0; i < 3; i++) {
            t.x_8[i] = 64 * 256 + rig_random_int(&random, 2 * r) - r;
            t.y_8[i] = 32 * 256 + rig_random_int(&random, 2 * r) - r;
        }
        check_triangle(&rig, &t);
    }
    rig_close(&rig);
}

// Long slivers, less than a pixel wide, at every angle.
static void test_slivers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 80, 80);
    uint64_t random = 15;
    for (int n = 0; n < 600; n++) {
        const double angle = n * 0.0107, width = rig_random_int(&random, 200) + 1;
        struct ref_triangle t = {0};
        for (int i = 0; i < 2; i++) {
            t.x_8[i] = 40 * 256 + (int64_t)((i ? 1 : -1) * 9000 * cos(angle));
            t.y_8[i] = 40 * 256 + (int64_t)((i ? 1 : -1) * 9000 * sin(angle));
        }
        t.x_8[2] = t.x_8[0] + (int64_t)(width * sin(angle));
        t.y_8[2] = t.y_8[0] - (int64_t)(width * cos(angle));
        check_triangle(&rig, &t);
    }
    rig_close(&rig);
}

static void test_positions_snap_to_nearest_even(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    // A right edge near the centre of pixel 4, in 1/256 pixel: half a step above the centre the tie goes to the
    // even side, which is the centre itself, and a right edge on a centre does not have it.
    const struct {
        double edge_8;
        bool covered;
    } rows[] = {
        {4 * 256 + 127.25, false}, {4 * 256 + 127.5, false}, {4 * 256 + 128, false},
        {4 * 256 + 128.25, false}, {4 * 256 + 128.5, false}, {4 * 256 + 128.75, true},
        {4 * 256 + 129, true},     {4 * 256 + 129.5, true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct rig_vertex square[6];
        rig_rectangle(&rig, 1, 1, (float)(rows[i].edge_8 / 256), 8, 0.5f, (const float[4]){1, 1, 1, 1},
                      square);
        rig_draw_once(&rig, square, 6);
        const float(*pixels)[4] = rig_read_float4(&rig);
        assert_true(pixels[4 * 16 + 3][0] == 1);
        assert_true((pixels[4 * 16 + 4][0] == 1) == rows[i].covered);
    }
    rig_close(&rig);
}

static void test_degenerate_triangles_draw_nothing(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 32, 32);
    const int64_t shapes[][6] = {
        {1000, 1000, 1000, 1000, 1000, 1000}, // a point
        {0, 0, 4096, 4096, 8192, 8192},       // a line
        {128, 128, 128, 8000, 128, 4000},
        {128, 128, 8000, 128, 128, 128},
    };
    for (int n = 0; n < 4; n++) {
        struct rig_vertex vertices[3];
        for (int i = 0; i < 3; i++) {
            place_8(&rig, shapes[n][2 * i], shapes[n][2 * i + 1], &vertices[i]);
        }
        rig_draw_once(&rig, vertices, 3);
        assert_int_equal(rig.stats.triangles_in, 1);
        assert_int_equal(rig.stats.triangles_culled, 1);
        assert_int_equal(rig.stats.triangles_rasterized, 0);
        assert_int_equal(rig.stats.fragments_shaded, 0);
    }
    rig_close(&rig);
}

// Adds 1 per fragment; what was drawn once everywhere is 1 everywhere.
static void set_counting(struct rig *rig)
{
    rig_set_target(rig, 0, RHW_FORMAT_R32_FLOAT);
    rig->pipeline.targets[0].blend = true;
    rig->pipeline.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
}

static void expect_all_once(struct rig *rig)
{
    const float *counts = rig_read(rig, rig->pass.colors[0].texture);
    for (int i = 0; i < rig->width * rig->height; i++) {
        if (counts[i] != 1) {
            fail_msg("pixel %d,%d is drawn %g times", i % rig->width, i / rig->width, (double)counts[i]);
        }
    }
}

// A grid over more than the target whose inner points are moved at random: on a raster of `step` 1/256 pixel,
// so that with step 128 many edges pass through centres.
static void check_mesh(int cells, int step, uint64_t seed)
{
    struct rig rig;
    rig_open(&rig, 131, 117);
    set_counting(&rig);
    uint64_t random = seed;
    const int pitch = 150 * 256 / cells;
    int64_t *x_8 = malloc(sizeof *x_8 * (size_t)((cells + 1) * (cells + 1)));
    int64_t *y_8 = malloc(sizeof *y_8 * (size_t)((cells + 1) * (cells + 1)));
    for (int j = 0; j <= cells; j++) {
        for (int i = 0; i <= cells; i++) {
            const bool inner = i > 0 && j > 0 && i < cells && j < cells;
            // At most a quarter of a cell: no triangle turns over.
            const int range = pitch / 2 / step;
            const int dx = inner && range > 0 ? rig_random_int(&random, range) - range / 2 : 0;
            const int dy = inner && range > 0 ? rig_random_int(&random, range) - range / 2 : 0;
            x_8[j * (cells + 1) + i] = ((int64_t)i * pitch - 8 * 256) / step * step + dx * step;
            y_8[j * (cells + 1) + i] = ((int64_t)j * pitch - 8 * 256) / step * step + dy * step;
        }
    }
    struct rig_vertex *vertices = malloc(sizeof *vertices * (size_t)(cells * cells * 6));
    int count = 0;
    for (int j = 0; j < cells; j++) {
        for (int i = 0; i < cells; i++) {
            const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            // Either diagonal, any first corner, either winding.
            const int split[2][6] = {{a, b, c, c, b, d}, {a, b, d, a, d, c}};
            const int which = rig_random_int(&random, 2);
            for (int t = 0; t < 2; t++) {
                const int turn = rig_random_int(&random, 3), flip = rig_random_int(&random, 2);
                for (int k = 0; k < 3; k++) {
                    const int corner = split[which][3 * t + (flip ? 2 - (k + turn) % 3 : (k + turn) % 3)];
                    place_8(&rig, x_8[corner], y_8[corner], &vertices[count++]);
                }
            }
        }
    }
    rig_draw_once(&rig, vertices, count);
    expect_all_once(&rig);
    free(x_8);
    free(y_8);
    free(vertices);
    rig_close(&rig);
}

static void test_meshes_are_drawn_exactly_once(void **state)
{
    (void)state;
    check_mesh(5, 1, 16);
    check_mesh(5, 128, 17);
    check_mesh(40, 1, 18);
    check_mesh(40, 128, 19);
    check_mesh(150, 1, 20);
    check_mesh(300, 1, 21); // two triangles per half pixel
}

// A fan of needles around one point: hundreds of edges meet there.
static void test_a_fan_of_needles(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 100, 100);
    set_counting(&rig);
    rig.pipeline.topology = RHW_TRIANGLE_FAN;
    enum { RIM = 900 };
    static struct rig_vertex vertices[RIM + 2];
    place_8(&rig, 50 * 256 + 128, 50 * 256 + 128, &vertices[0]);
    for (int i = 0; i <= RIM; i++) {
        const double angle = (i % RIM) * 6.283185307179586 / RIM;
        place_8(&rig, 50 * 256 + (int64_t)(90 * 256 * cos(angle)),
                50 * 256 + (int64_t)(90 * 256 * sin(angle)), &vertices[i + 1]);
    }
    rig_draw_once(&rig, vertices, RIM + 2);
    expect_all_once(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_edges_through_pixel_centres),
    cmocka_unit_test(test_tiny_triangles_that_cover_nothing_are_culled),
    cmocka_unit_test(test_tiny_triangles_beside_huge_ones),
    cmocka_unit_test(test_small_triangles_within_a_scissor),
    cmocka_unit_test(test_random_triangles),
    cmocka_unit_test(test_slivers),
    cmocka_unit_test(test_positions_snap_to_nearest_even),
    cmocka_unit_test(test_degenerate_triangles_draw_nothing),
    cmocka_unit_test(test_meshes_are_drawn_exactly_once),
    cmocka_unit_test(test_a_fan_of_needles),
};

const struct unit_tests test_coverage = UNIT_TESTS(tests, NULL, NULL);
