// SPDX-License-Identifier: MIT
// Smooth lines: alpha is the area of each pixel that the rectangle covers, by hand and against polygons cut by the pixel's
// sides one after the other.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 64, PIXELS = SIZE * SIZE };

static void open_rig(struct rig *rig, enum rhw_paths paths)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig->pipeline.topology = RHW_LINE_LIST;
    rig->pipeline.line_mode = RHW_LINE_RECTANGULAR_SMOOTH;
}

static struct rig_vertex vertex_at(const struct rig *rig, double x, double y)
{
    struct rig_vertex v = {.value = {0.5f, 1, 0.25f, 0.5f}};
    rig_place(rig, (float)x, (float)y, 0.5f, 1, v.position);
    return v;
}

// From 4.25 to 7.75 across and from 9.5 to 11.5 down; alpha is half of that, and colours are as they are.
static void test_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.line_width = 2;
    const struct rig_vertex v[] = {vertex_at(&rig, 4.25, 10.5), vertex_at(&rig, 7.75, 10.5)};
    static const double across[] = {0, 0.75, 1, 1, 0.75, 0}, down[] = {0, 0.5, 1, 0.5, 0};
    for (int samples = 1; samples <= 4; samples *= 4) {
        rig.pass.samples = samples;
        rig_draw_once(&rig, v, 2);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int y = 8; y < 13; y++) {
            for (int x = 3; x < 9; x++) {
                const double area = across[x - 3] * down[y - 8];
                const float *const pixel = pixels[y * SIZE + x];
                assert_float_equal(pixel[3], area / 2, 0);
                assert_float_equal(pixel[0], area == 0 ? 0 : 0.5, 0);
            }
        }
    }
    rig.pass.samples = 1;
    rig.pipeline.line_width = 0;
    rig.pipeline.line_stipple =
        (struct rhw_line_stipple){1, 0x5555}; // of pixels whose centre is in the piece
    const struct rig_vertex s[] = {vertex_at(&rig, 4, 10.5), vertex_at(&rig, 8, 10.5)};
    rig_draw_once(&rig, s, 2);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int x = 4; x < 8; x++) {
        assert_float_equal(pixels[10 * SIZE + x][3], (float)(x % 2 == 0) / 2, 0);
    }
    rig_close(&rig);
}

static void write_both(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].color[0], groups[g].varying, sizeof groups[g].color[0]);
        memcpy(groups[g].color[1], groups[g].varying, sizeof groups[g].color[1]);
    }
}

// The alpha of colour 0 alone is weighed, and that of others is not in its place where target 0 is left out.
static void test_other_colors(void **state)
{
    (void)state;
    for (int left_out = 0; left_out < 2; left_out++) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        rig.pipeline.line_width = 2;
        rig_set_program(&rig, rig_vertex_pass, write_both);
        rig_set_target(&rig, 1, RHW_FORMAT_RGBA32_FLOAT);
        const rhw_texture first = rig.pass.colors[0].texture;
        if (left_out) {
            rig.pass.colors[0] = (struct rhw_color_attachment){.layer = 0};
            rig.pipeline.targets[0] = (struct rhw_color_target){.format = RHW_FORMAT_NONE};
        }
        const struct rig_vertex v[] = {vertex_at(&rig, 4.25, 10.5), vertex_at(&rig, 7.75, 10.5)};
        rig_draw_once(&rig, v, 2);
        const int at = 10 * SIZE + 4;
        const float *pixels = rig_read(&rig, rig.pass.colors[1].texture);
        assert_float_equal(pixels[4 * at + 3], 0.5, 0);
        pixels = rig_read(&rig, first);
        assert_true(pixels[4 * at + 3] == (left_out ? 0 : 0.375f));
        rig_close(&rig);
    }
}

// Where alpha decides about coverage the area does, also where there is no target that has alpha.
static void test_coverage_by_alpha(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.line_width = 2;
    rig.pipeline.alpha_to_coverage = true;
    const struct rig_vertex v[] = {vertex_at(&rig, 4.25, 10.5), vertex_at(&rig, 7.75, 10.5)};
    uint64_t passed[2];
    for (int without = 0; without < 2; without++) {
        rhw_query query;
        const struct rhw_query_def def = {.kind = RHW_QUERY_OCCLUSION};
        assert_int_equal(rhw_query_create(rig.context, &def, &query), RHW_OK);
        rig.pass.samples = 16;
        if (without) {
            rig.pass = (struct rhw_pass_def){.width = SIZE, .height = SIZE, .samples = 16};
            rig.pipeline.target_count = 0;
            rig.pipeline.targets[0].format = RHW_FORMAT_R32_UINT; // says nothing then
        }
        rig_begin(&rig);
        rhw_pass_begin_query(rig.context, rig.recording, query);
        rig_draw(&rig, v, 2);
        rhw_pass_end_query(rig.context, rig.recording, query);
        rig_end(&rig);
        struct rhw_query_counts counts;
        assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
        passed[without] = counts.samples_passed;
    }
    // Half of 16 samples, where the line has all of the pixel; of 0.75, 0.5 and 0.375 as much.
    assert_int_equal(passed[0], 2 * 8 + 2 * 6 + 4 * 4 + 4 * 3);
    assert_int_equal(passed[1], passed[0]);
    rig_close(&rig);
}

struct corners {
    int count;
    double x[12], y[12];
};

// What of a polygon lies where sign·(x or y) <= sign·at.
static struct corners cut(const struct corners *p, bool by_y, double at, double sign)
{
    struct corners out = {.count = 0};
    for (int i = 0; i < p->count; i++) {
        const int j = (i + 1) % p->count;
        const double a = sign * ((by_y ? p->y[i] : p->x[i]) - at),
                     b = sign * ((by_y ? p->y[j] : p->x[j]) - at);
        if (a <= 0) {
            out.x[out.count] = p->x[i];
            out.y[out.count++] = p->y[i];
        }
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
            const double part = a / (a - b);
            out.x[out.count] = p->x[i] + part * (p->x[j] - p->x[i]);
            out.y[out.count++] = p->y[i] + part * (p->y[j] - p->y[i]);
        }
    }
    return out;
}

static double area_in_pixel(const struct corners *rectangle, int x, int y)
{
    struct corners p = cut(rectangle, false, x + 1, 1);
    p = cut(&p, false, x, -1);
    p = cut(&p, true, y + 1, 1);
    p = cut(&p, true, y, -1);
    double twice = 0;
    for (int i = 0; i < p.count; i++) {
        const int j = (i + 1) % p.count;
        twice += (p.x[i] - x) * (p.y[j] - y) - (p.x[j] - x) * (p.y[i] - y);
    }
    return fabs(twice) / 2;
}

static void test_areas(void **state)
{
    (void)state;
    uint64_t random = 5;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    for (int n = 0; n < 200; n++) {
        double x[2], y[2];
        for (int i = 0; i < 2; i++) {
            x[i] = (rig_random_int(&random, SIZE * 256) - (n % 9 == 0 ? 4096 : 0)) / 256.0;
            y[i] = rig_random_int(&random, SIZE * 256) / 256.0;
        }
        x[1] = n % 5 == 1 ? x[0] : x[1];
        y[1] = n % 5 == 2 ? y[0] : n % 5 == 3 ? y[0] + 1 / 256.0 : y[1];
        y[1] = n % 10 == 4 ? y[0] + rint((x[1] - x[0]) * 2.56) / 256 : y[1]; // hardly slanted
        if (x[0] == x[1] && y[0] == y[1]) {
            continue;
        }
        const double width = n % 3 == 0 ? 1 : 1 + rig_random_int(&random, 12), dx = x[1] - x[0],
                     dy = y[1] - y[0];
        const double scale = width / 2 / sqrt(dx * dx + dy * dy);
        const double nx = -rint(dy * scale * 256) / 256, ny = rint(dx * scale * 256) / 256;
        const struct corners rectangle = {
            4, {x[0] + nx, x[0] - nx, x[1] - nx, x[1] + nx}, {y[0] + ny, y[0] - ny, y[1] - ny, y[1] + ny}};
        const struct rig_vertex v[] = {vertex_at(&rig, x[0], y[0]), vertex_at(&rig, x[1], y[1])};
        rig.pipeline.line_width = (float)width;
        rig_draw_once(&rig, v, 2);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < PIXELS; i++) {
            const double wanted = area_in_pixel(&rectangle, i % SIZE, i / SIZE) / 2;
            if (fabs((double)pixels[i][3] - wanted) > 0x1p-16) {
                fail_msg("line %d, %g, %g to %g, %g wide %g, pixel %d, %d: %g, expected %g", n, x[0], y[0],
                         x[1], y[1], width, i % SIZE, i / SIZE, (double)pixels[i][3], wanted);
            }
        }
    }
    rig_close(&rig);
}

// Alpha that is blended, a strip of edges, one path and the other: the same bytes.
static void test_paths_agree(void **state)
{
    (void)state;
    static float first[PIXELS][4];
    for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL; paths += RHW_PATHS_GENERAL) {
        struct rig rig;
        open_rig(&rig, (enum rhw_paths)paths);
        rig.pipeline.topology = RHW_TRIANGLE_STRIP;
        rig.pipeline.polygon_mode = RHW_POLYGON_LINE;
        rig.pipeline.line_width = 3;
        rig.pipeline.targets[0].blend = true;
        rig.pipeline.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
        struct rig_vertex v[20];
        uint64_t random = 2;
        for (int i = 0; i < 20; i++) {
            v[i] = vertex_at(&rig, rig_random_int(&random, SIZE), rig_random_int(&random, SIZE));
        }
        rig_draw_once(&rig, v, 20);
        if (paths == RHW_PATHS_ALL) {
            memcpy(first, rig_read_float4(&rig), sizeof first);
        } else {
            assert_memory_equal(first, rig_read_float4(&rig), sizeof first);
        }
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_by_hand), cmocka_unit_test(test_areas), cmocka_unit_test(test_paths_agree),
    cmocka_unit_test(test_other_colors), cmocka_unit_test(test_coverage_by_alpha)};

const struct unit_tests test_smooth_lines = UNIT_TESTS(tests, NULL, NULL);
