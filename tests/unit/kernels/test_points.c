// SPDX-License-Identifier: MIT
// Points: squares of exact size around snapped positions, point coordinates, flat values, what the view volume and
// sizes out of range do, both shader forms, and what validation says.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 96 };

// The size is the vertex's value[3].
static void sized_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].point_size = groups[g].attribute[1][3];
    }
}

static void sized_vertex1(struct rhw_vertex1 *v)
{
    memcpy(v->position, v->attribute[0], sizeof v->position);
    memcpy(v->varying, v->attribute[1], 4 * sizeof(float));
    v->point_size = v->attribute[1][3];
}

static void coord_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].point_coord[0];
        groups[g].color[0][1] = groups[g].point_coord[1];
        groups[g].color[0][2] = groups[g].varying[0];
        groups[g].color[0][3] = rhw_splat(1);
    }
}

static void coord_fragment1(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->point_coord[0];
    f->color[0][1] = f->point_coord[1];
    f->color[0][2] = f->varying[0];
    f->color[0][3] = 1;
}

static void open_rig(struct rig *rig, enum rhw_paths paths)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.paths = paths;
    def.threads = 2;
    rig_open_with(rig, SIZE, SIZE, &def);
    rig_set_program(rig, sized_vertex, coord_fragment);
    rig->pipeline.topology = RHW_POINT_LIST;
    rig->pipeline.program.writes_point_size = true;
    rig->pipeline.program.uses = RHW_USE_POINT_COORD;
}

static struct rig_vertex point_at(const struct rig *rig, float x, float y, float size, float value)
{
    struct rig_vertex v = {.value = {value, 0, 0, size}};
    rig_place(rig, x, y, 0, 1, v.position);
    return v;
}

// What a point covers, by exact arithmetic in 1/256 pixel.
static bool covers(int x_24_8, int y_24_8, int size, int pixel_x, int pixel_y)
{
    const int x = 256 * pixel_x + 128 - (x_24_8 - size / 2), y = 256 * pixel_y + 128 - (y_24_8 - size / 2);
    return x >= 0 && x < size && y >= 0 && y < size;
}

static void test_coverage_and_coordinates_are_exact(void **state)
{
    (void)state;
    for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL; paths += RHW_PATHS_GENERAL) {
        struct rig rig;
        open_rig(&rig, (enum rhw_paths)paths);
        uint64_t random = 7;
        for (int n = 0; n < 60; n++) {
            const int sizes[] = {256,           257,      300,          512,     3 * 256,
                                 10 * 256 + 77, 31 * 256, 40 * 256 + 1, 90 * 256};
            const int size = sizes[n % 9];
            const int x = rig_random_int(&random, SIZE * 256), y = rig_random_int(&random, SIZE * 256);
            const struct rig_vertex v =
                point_at(&rig, (float)x / 256, (float)y / 256, (float)size / 256, (float)(n + 1));
            rig_draw_once(&rig, &v, 1);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int i = 0; i < SIZE * SIZE; i++) {
                const bool in = covers(x, y, size, i % SIZE, i / SIZE);
                if ((pixels[i][3] != 0) != in) {
                    fail_msg("paths %d, point %d, pixel %d, %d", paths, n, i % SIZE, i / SIZE);
                }
                if (in) {
                    const double s = (256.0 * (i % SIZE) + 128 - (x - size / 2)) / size;
                    const double t = (256.0 * (i / SIZE) + 128 - (y - size / 2)) / size;
                    assert_true(fabs((double)pixels[i][0] - s) <= rig_ulp(s));
                    assert_true(fabs((double)pixels[i][1] - t) <= rig_ulp(t));
                    assert_true(pixels[i][2] == (float)(n + 1));
                }
            }
        }
        rig_close(&rig);
    }
}

static int covered(struct rig *rig)
{
    const float(*pixels)[4] = rig_read_float4(rig);
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        count += pixels[i][3] != 0;
    }
    return count;
}

static void test_a_point_of_size_one_hits_one_pixel(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig_set_program(&rig, rig_vertex_pass, coord_fragment);
    rig.pipeline.program.writes_point_size = false;
    for (int i = 0; i <= 256; i += 16) {
        const struct rig_vertex v = point_at(&rig, 20 + (float)i / 256, 30.5f - (float)i / 512, 9, 9);
        rig_draw_once(&rig, &v, 1);
        assert_int_equal(covered(&rig), 1);
    }
    rig_close(&rig);
}

static void test_sizes_are_clamped(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    const float least[] = {0, -3, 0.25f, NAN, -INFINITY};
    for (int i = 0; i < 5; i++) {
        const struct rig_vertex v = point_at(&rig, 20, 30, least[i], 1);
        rig_draw_once(&rig, &v, 1);
        assert_int_equal(covered(&rig), 1);
    }
    const struct rig_vertex v = point_at(&rig, 0, 0, INFINITY, 1);
    rig_draw_once(&rig, &v, 1);
    assert_int_equal(covered(&rig), SIZE * SIZE);
    rig_close(&rig);
}

// Vulkan 1.3 §27.4: a point is discarded where its vertex is outside the volume, and is not cut otherwise.
static void test_the_centre_decides_what_is_clipped(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    const struct rhw_viewport viewport = {32, 32, 32, 32, 0, 1};
    static const struct {
        float position[4];
        int pixels;
    } cases[] = {
        {{1, 0, 0, 1}, 64},     {{1.0001f, 0, 0, 1}, 0}, {{-1, 1, 1, 1}, 64},      {{0, 0, 1.001f, 1}, 0},
        {{0, 0, -0.01f, 1}, 0}, {{0, 0, 0, -1}, 0},      {{NAN, 0, 0, 1}, 0},      {{0, 0, 0, 0}, 0},
        {{2, 2, 0, 2}, 64},     {{0, -1.01f, 0, 1}, 0},  {{0.5f, 0.5f, 0, 1}, 64},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct rig_vertex v = {.value = {1, 0, 0, 8}};
        memcpy(v.position, cases[i].position, sizeof v.position);
        rig_begin(&rig);
        rhw_pass_set_viewport(rig.context, rig.recording, &viewport);
        rig_draw(&rig, &v, 1);
        rig_end(&rig);
        if (covered(&rig) != cases[i].pixels) {
            fail_msg("case %d: %d pixels", (int)i, covered(&rig));
        }
        assert_int_equal(rig.stats.triangles_in, 1);
        assert_int_equal(rig.stats.triangles_rasterized, cases[i].pixels != 0);
    }
    rig_close(&rig);
}

static void test_the_scissor_cuts_points(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    const struct rhw_rect scissor = {10, 12, 40, 30};
    for (int size = 8; size <= 128; size *= 2) {
        const struct rig_vertex v = point_at(&rig, 10, 12, (float)size, 1);
        rig_begin(&rig);
        rhw_pass_set_scissor(rig.context, rig.recording, &scissor);
        rig_draw(&rig, &v, 1);
        rig_end(&rig);
        const int half = size / 2, width = half < 40 ? half : 40, height = half < 30 ? half : 30;
        assert_int_equal(covered(&rig), width * height);
    }
    const struct rig_vertex beside = point_at(&rig, 6, 12, 4, 1); // in the view, and left of the scissor
    rig_begin(&rig);
    rhw_pass_set_scissor(rig.context, rig.recording, &scissor);
    rig_draw(&rig, &beside, 1);
    rig_end(&rig);
    assert_int_equal(rig.stats.triangles_culled, 1);
    assert_int_equal(rig.stats.triangles_rasterized, 0);
    rig_close(&rig);
}

// A viewport keeps or leaves out a point by its centre, and does not cut it; a line it does cut.
static void test_a_viewport_does_not_cut_points(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    const struct rhw_viewport viewport = {20, 20, 16, 16, 0, 1};
    const struct rig_vertex v[2] = {{{0.875f, 0, 0, 1}, {1, 0, 0, 8}}, {{1.125f, 0, 0, 1}, {1, 0, 0, 8}}};
    for (int i = 0; i < 2; i++) {
        rig_begin(&rig);
        rhw_pass_set_viewport(rig.context, rig.recording, &viewport);
        rig_draw(&rig, &v[i], 1);
        rig_end(&rig);
        assert_int_equal(covered(&rig),
                         i == 0 ? 8 * 8 : 0); // x 31..38 the first, where the viewport ends at 35
    }
    const struct rig_vertex line[2] = {{{-2, 0, 0, 1}, {1, 0, 0, 1}}, {{2, 0, 0, 1}, {1, 0, 0, 1}}};
    rig.pipeline.topology = RHW_LINE_LIST;
    rig.pipeline.line_width = 4;
    rig.pipeline.program.uses = 0;
    rig_set_program(&rig, sized_vertex, rig_fragment_pass);
    rig_begin(&rig);
    rhw_pass_set_viewport(rig.context, rig.recording, &viewport);
    rig_draw(&rig, line, 2);
    rig_end(&rig);
    assert_int_equal(covered(&rig), 16 * 4);
    rig_close(&rig);
}

// Many points above each other: drawn in order, and the same on every path and in both shader forms.
static void test_forms_and_paths_agree(void **state)
{
    (void)state;
    enum { POINTS = 3000 };
    static struct rig_vertex vertices[POINTS];
    uint64_t hashes[4];
    for (int k = 0; k < 4; k++) {
        struct rig rig;
        open_rig(&rig, k % 2 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL);
        rig_set_depth(&rig);
        if (k / 2) {
            memset(rig.pipeline.program.vertex, 0, sizeof rig.pipeline.program.vertex);
            memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
            rig.pipeline.program.vertex1 = sized_vertex1;
            rig.pipeline.program.fragment1 = coord_fragment1;
        }
        uint64_t random = 3;
        for (int i = 0; i < POINTS; i++) {
            vertices[i] = point_at(&rig, rig_random_float(&random, -4, SIZE + 4),
                                   rig_random_float(&random, -4, SIZE + 4),
                                   i % 50 == 0 ? 50 : rig_random_float(&random, 0, 9), (float)i);
            vertices[i].position[2] = rig_random_float(&random, 0, 1);
        }
        rig_draw_once(&rig, vertices, POINTS);
        hashes[k] = rig_hash(&rig, 0);
        rig_close(&rig);
    }
    assert_true(hashes[0] == hashes[1]);
    assert_true(hashes[0] == hashes[2]);
    assert_true(hashes[0] == hashes[3]);
}

static void unsized_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].point_coord[0];
        }
    }
}

// Its points lie where an attribute that the pipeline does not have says.
static void moved_vertex(struct rhw_vertex *groups, int count)
{
    sized_vertex(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].position[0] = groups[g].attribute[2][1];
    }
}

static void test_validation_looks_at_points(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.validate = RHW_VALIDATE_ON;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &def);
    rig.pipeline.topology = RHW_POINT_LIST;
    const struct rig_vertex v = point_at(&rig, 20, 30, 4, 1);
    rig.pipeline.program.writes_point_size = true;
    rig_draw_once(&rig, &v, 1);
    rig_expect_misuse(&rig, "does not write point_size; its program's writes_point_size is true");
    rig.pipeline.program.writes_point_size = false;
    rig_set_program(&rig, sized_vertex, rig_fragment_pass);
    rig_draw_once(&rig, &v, 1);
    rig_expect_misuse(&rig, "writes point_size; its program's writes_point_size is false");
    rig_set_program(&rig, rig_vertex_pass, unsized_fragment);
    rig_draw_once(&rig, &v, 1);
    rig_expect_misuse(&rig, "reads point_coord; RHW_USE_POINT_COORD is missing");
    rig.pipeline.program.uses = RHW_USE_POINT_COORD;
    rig_draw_once(&rig, &v, 1);
    rig_set_program(&rig, sized_vertex, coord_fragment);
    rig.pipeline.program.writes_point_size = true;
    rig_draw_once(&rig, &v, 1);
    assert_int_equal(covered(&rig), 4 * 4);
    rig_set_program(&rig, moved_vertex, coord_fragment);
    rig_draw_once(&rig, &v, 1);
    rig_expect_misuse(&rig, "reads an attribute behind the last; the pipeline has 2");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_coverage_and_coordinates_are_exact),
    cmocka_unit_test(test_a_point_of_size_one_hits_one_pixel),
    cmocka_unit_test(test_sizes_are_clamped),
    cmocka_unit_test(test_the_centre_decides_what_is_clipped),
    cmocka_unit_test(test_the_scissor_cuts_points),
    cmocka_unit_test(test_a_viewport_does_not_cut_points),
    cmocka_unit_test(test_forms_and_paths_agree),
    cmocka_unit_test(test_validation_looks_at_points),
};

const struct unit_tests test_points = UNIT_TESTS(tests, NULL, NULL);
