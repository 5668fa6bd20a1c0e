// SPDX-License-Identifier: MIT
// Viewports of negative height (VK_KHR_maintenance1): places and facing by hand; the bytes of what is drawn with every
// Y negated in an upright viewport over the same pixels; the picture of the upright one with its rows turned over.
#include "harness.h"

#include <string.h>

enum { WIDTH = 150, HEIGHT = 100, PIXELS = WIDTH * HEIGHT, VERTICES = 3 * 80 };

static void expect_rect(struct rig *rig, int x0, int y0, int x1, int y1)
{
    const float(*const pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < rig->width * rig->height; i++) {
        const int x = i % rig->width, y = i / rig->width;
        if ((pixels[i][3] != 0) != (x >= x0 && x < x1 && y >= y0 && y < y1)) {
            fail_msg("pixel %d, %d is %d", x, y, pixels[i][3] != 0);
        }
    }
}

// NDC x0..x1, y0..y1, both triangles counter-clockwise with y up.
static void draw_ndc(struct rig *rig, struct rhw_viewport viewport, float x0, float y0, float x1, float y1)
{
    const struct rig_vertex v[6] = {
        {{x0, y0, 0, 1}, {1, 1, 1, 1}}, {{x1, y0, 0, 1}, {1, 1, 1, 1}}, {{x0, y1, 0, 1}, {1, 1, 1, 1}},
        {{x0, y1, 0, 1}, {1, 1, 1, 1}}, {{x1, y0, 0, 1}, {1, 1, 1, 1}}, {{x1, y1, 0, 1}, {1, 1, 1, 1}},
    };
    rig_begin(rig);
    rhw_pass_set_viewport(rig->context, rig->recording, &viewport);
    rig_draw(rig, v, 6);
    rig_end(rig);
}

static void test_places(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 128, 96);
    // The middle is at 64 − 32/2 = 48, and y goes down: 48 − 0.25 · 16 to 48 + 0.5 · 16.
    draw_ndc(&rig, (struct rhw_viewport){16, 64, 64, -32, 0, 1}, -0.5f, -0.25f, 0.25f, 0.5f);
    expect_rect(&rig, 32, 44, 56, 56);
    // Cut off at its edges, also those above and below the target.
    draw_ndc(&rig, (struct rhw_viewport){10, 60, 30, -40, 0, 1}, -2, -2, 2, 2);
    expect_rect(&rig, 10, 20, 40, 60);
    draw_ndc(&rig, (struct rhw_viewport){-10, 20, 30, -40, 0, 1}, -2, -2, 2, 2);
    expect_rect(&rig, 0, 0, 20, 20);
    draw_ndc(&rig, (struct rhw_viewport){100, 470, 300, -400, 0, 1}, -2, -2, 2, 2);
    expect_rect(&rig, 100, 70, 128, 96);
    draw_ndc(&rig, (struct rhw_viewport){0, 0, 128, -96, 0, 1}, -1, -1, 1, 1);
    expect_rect(&rig, 0, 0, 0, 0);
    // Without a height there is no pixel in it.
    draw_ndc(&rig, (struct rhw_viewport){0, 40, 128, 0, 0, 1}, -1, -1, 1, 1);
    expect_rect(&rig, 0, 0, 0, 0);
    rig_close(&rig);
}

static void test_points(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    rig.pipeline.topology = RHW_POINT_LIST;
    const struct rig_vertex v = {{0.5f, 0.75f, 0, 1}, {1, 1, 1, 1}};
    static const struct {
        float y, height;
        int row;
    } cases[] = {{64, -64, 56}, {0, 64, 8}, {10, 0, 10}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rig_begin(&rig);
        rhw_pass_set_viewport(
            rig.context, rig.recording,
            &(struct rhw_viewport){0.5f, cases[i].y + 0.5f, 64, cases[i].height, 0, 1}); // pixels' middles
        rig_draw(&rig, &v, 1);
        rig_end(&rig);
        expect_rect(&rig, 48, cases[i].row, 49, cases[i].row + 1);
    }
    rig_close(&rig);
}

static void tell_facing(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float front = rhw_float_from_int(groups[g].front_facing);
        groups[g].color[0][0] = groups[g].color[0][3] = 2.0f + front; // 1: the front, 2: the back
        groups[g].color[0][1] = groups[g].color[0][2] = rhw_splat(0);
    }
}

// What turns one way in an upright viewport turns the other way in a flipped one: filled, clipped behind the eye, as
// lines.
static void test_facing(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    rig_set_program(&rig, rig_vertex_pass, tell_facing);
    rig.pipeline.program.uses = RHW_USE_FACING;
    static const struct rig_vertex triangles[2][3] = {
        {{{-0.9f, -0.8f, 0, 1}, {0}}, {{0.9f, -0.8f, 0, 1}, {0}}, {{0, 0.9f, 0, 1}, {0}}},
        {{{-0.9f, -0.8f, 0.5f, 1}, {0}}, {{0.9f, -0.8f, 0.5f, 1}, {0}}, {{0.1f, 8, 0.5f, -1}, {0}}}};
    for (int n = 0; n < 2 * 2 * 2 * 4; n++) {
        const bool is_flipped = n & 1, is_clockwise = n & 2;
        rig.pipeline.front = is_clockwise ? RHW_CLOCKWISE : RHW_COUNTER_CLOCKWISE;
        rig.pipeline.cull = (enum rhw_cull)(n >> 3 & 3); // NONE, FRONT, BACK, BOTH
        rig.pipeline.depth_clip_disabled = true;
        for (int mode = 0; mode < 2; mode++) {
            rig.pipeline.polygon_mode = mode == 0 ? RHW_POLYGON_FILL : RHW_POLYGON_LINE;
            rig_begin(&rig);
            rhw_pass_set_viewport(
                rig.context, rig.recording,
                &(struct rhw_viewport){0, is_flipped ? 64 : 0, 64, is_flipped ? -64 : 64, 0, 1});
            rig_draw(&rig, triangles[n >> 2 & 1], 3);
            rig_end(&rig);
            const bool is_front = is_flipped == is_clockwise;
            const bool is_culled = rig.pipeline.cull == RHW_CULL_BOTH ||
                                   rig.pipeline.cull == (is_front ? RHW_CULL_FRONT : RHW_CULL_BACK);
            const float(*const pixels)[4] = rig_read_float4(&rig);
            int seen = 0;
            for (int i = 0; i < 64 * 64; i++) {
                seen += pixels[i][3] != 0;
                assert_true(pixels[i][3] == 0 || pixels[i][3] == (is_front ? 1 : 2));
            }
            assert_true(is_culled == (seen == 0));
        }
    }
    rig_close(&rig);
}

// What depends on which way y goes: values, their derivatives, facing, the place in a point.
static void tell_all(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float *const v = groups[g].varying;
        groups[g].color[0][0] = v[0] + rhw_float_from_int(groups[g].front_facing);
        groups[g].color[0][1] = v[1] + groups[g].coord[1];
        groups[g].color[0][2] = groups[g].ddy[0];
        groups[g].color[0][3] = groups[g].ddx[1];
    }
}

static void tell_point(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].varying[0];
        groups[g].color[0][1] = groups[g].coord[1];
        groups[g].color[0][2] = groups[g].point_coord[0];
        groups[g].color[0][3] = groups[g].point_coord[1];
    }
}

static void routing_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].viewport_index = rhw_int_from_float(groups[g].attribute[1][3]);
    }
}

struct kind {
    enum rhw_topology topology;
    enum rhw_polygon_mode mode;
    enum rhw_line_mode line_mode;
    enum rhw_conservative conservative;
    int corners, samples;
};
static const struct kind kinds[] = {
    {RHW_TRIANGLE_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_OFF, 3, 1},
    {RHW_TRIANGLE_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_OFF, 3, 4},
    {RHW_TRIANGLE_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_OVERESTIMATE, 3, 1},
    {RHW_TRIANGLE_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_UNDERESTIMATE, 3, 1},
    {RHW_TRIANGLE_LIST, RHW_POLYGON_LINE, RHW_LINE_BRESENHAM, RHW_CONSERVATIVE_OFF, 3, 1},
    {RHW_TRIANGLE_LIST, RHW_POLYGON_POINT, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_OFF, 3, 1},
    {RHW_LINE_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_OFF, 2, 1},
    {RHW_LINE_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR_SMOOTH, RHW_CONSERVATIVE_OFF, 2, 1},
    {RHW_LINE_LIST, RHW_POLYGON_FILL, RHW_LINE_BRESENHAM, RHW_CONSERVATIVE_OFF, 2, 1},
    {RHW_POINT_LIST, RHW_POLYGON_FILL, RHW_LINE_RECTANGULAR, RHW_CONSERVATIVE_OFF, 1, 1},
};
enum { KINDS = sizeof kinds / sizeof *kinds, VIEWS = 4 };

// The same pixels, upright: in the first and the third they are what the flipped ones are.
static const struct rhw_viewport flipped[VIEWS] = {{3, 97, 140, -90, 0, 1},
                                                   {20.25f, -10, 80, 70, 0.25f, 1},
                                                   {-20, 130.5f, 160, -70.75f, 1, 0},
                                                   {60, 40, 50, 50, 0, 0.5f}};
static const struct rhw_viewport upright[VIEWS] = {{3, 7, 140, 90, 0, 1},
                                                   {20.25f, -10, 80, 70, 0.25f, 1},
                                                   {-20, 59.75f, 160, 70.75f, 1, 0},
                                                   {60, 40, 50, 50, 0, 0.5f}};

// Vertices of which some are behind the eye and some far outside.
static void make_vertices(struct rig_vertex *vertices, int corners)
{
    uint64_t seed = 11;
    for (int i = 0; i < VERTICES; i++) {
        const float w = i % 17 == 5 ? -0.5f : rig_random_float(&seed, 0.5f, 2);
        const float reach = i % 29 == 3 ? 3000 : 1.3f;
        vertices[i].position[0] = rig_random_float(&seed, -reach, reach) * w;
        vertices[i].position[1] = rig_random_float(&seed, -reach, reach) * w;
        vertices[i].position[2] = rig_random_float(&seed, -0.1f, 1.1f) * w;
        vertices[i].position[3] = w;
        for (int c = 0; c < 3; c++) {
            vertices[i].value[c] = rig_random_float(&seed, 0, 1);
        }
        vertices[i].value[3] = (float)(i / corners % VIEWS);
    }
}

static void negate_flipped(struct rig_vertex *vertices)
{
    for (int i = 0; i < VERTICES; i++) {
        const float y = vertices[i].position[1];
        vertices[i].position[1] = flipped[(int)vertices[i].value[3]].height < 0 ? -y : y;
    }
}

static uint64_t draw_views(struct rig *rig, const struct rig_vertex *vertices,
                           const struct rhw_viewport views[VIEWS])
{
    rig_begin(rig);
    rhw_pass_set_viewports(rig->context, rig->recording, 0, VIEWS, views);
    rig_draw(rig, vertices, VERTICES);
    rig_end(rig);
    assert_true(rig->stats.triangles_clipped > 0 || rig->pipeline.topology != RHW_TRIANGLE_LIST);
    const uint64_t hash = rig_hash(rig, 0);
    return rig_hash_bytes(hash, rig_read_depth(rig), sizeof(float[PIXELS]));
}

static void set_kind(struct rig *rig, const struct kind *kind)
{
    rig_set_depth(rig);
    const bool is_points = kind->topology == RHW_POINT_LIST;
    rig_set_program(rig, routing_vertex, is_points ? tell_point : tell_all);
    rig->pipeline.program.writes_viewport_index = true;
    rig->pipeline.program.uses = RHW_USE_COORD | (is_points ? RHW_USE_POINT_COORD : RHW_USE_FACING);
    rig->pipeline.program.varyings[0].derivatives = true;
    rig->pipeline.topology = kind->topology;
    rig->pipeline.polygon_mode = kind->mode;
    rig->pipeline.line_mode = kind->line_mode;
    rig->pipeline.line_width = 3.5f;
    rig->pipeline.conservative = kind->conservative;
    rig->pipeline.depth_bias = (struct rhw_depth_bias){.slope = 1};
    rig->pass.samples = kind->samples;
    if (kind->samples > 1) { // depth stays in the tile
        rig->pass.depth.resolve_mode = RHW_RESOLVE_MIN;
    }
}

static void test_same_bytes(void **state)
{
    (void)state;
    static struct rig_vertex vertices[VERTICES];
    for (int n = 0; n < 2 * KINDS; n++) {
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = 2;
        def.paths = n < KINDS ? RHW_PATHS_ALL : RHW_PATHS_GENERAL;
        struct rig rig;
        rig_open_with(&rig, WIDTH, HEIGHT, &def);
        set_kind(&rig, &kinds[n % KINDS]);
        make_vertices(vertices, kinds[n % KINDS].corners);
        const uint64_t seen = draw_views(&rig, vertices, flipped);
        assert_true(seen != draw_views(&rig, vertices, upright));
        negate_flipped(vertices);
        if (seen != draw_views(&rig, vertices, upright)) {
            fail_msg("kind %d", n);
        }
        rig_close(&rig);
    }
}

// Twice the area of a, b and the middle of a pixel, 1/256 pixel each way.
static int64_t edge_at(const int32_t a[2], const int32_t b[2], int x, int y)
{
    return (int64_t)(b[0] - a[0]) * (256 * y + 128 - a[1]) - (int64_t)(b[1] - a[1]) * (256 * x + 128 - a[0]);
}

static bool meets_no_middle(int32_t corners[3][2])
{
    for (int i = 0; i < PIXELS; i++) {
        for (int k = 0; k < 3; k++) {
            if (edge_at(corners[k], corners[(k + 1) % 3], i % WIDTH, i / WIDTH) == 0) {
                return false;
            }
        }
    }
    return true;
}

static void test_rows_turn_over(void **state)
{
    (void)state;
    static float upper[PIXELS][4];
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    uint64_t seed = 5;
    int drawn = 0;
    for (int n = 0; n < 60; n++) {
        int32_t corners[3][2];
        struct rig_vertex v[3];
        for (int i = 0; i < 3; i++) {
            corners[i][0] = rig_random_int(&seed, 256 * WIDTH);
            corners[i][1] = rig_random_int(&seed, 256 * HEIGHT);
            v[i] = (struct rig_vertex){.value = {1, 2, 3, 4}};
            rig_place(&rig, (float)corners[i][0] / 256, (float)corners[i][1] / 256, 0.5f, 1, v[i].position);
        }
        if (!meets_no_middle(corners)) {
            continue;
        }
        rig_draw_once(&rig, v, 3);
        memcpy(upper, rig_read_float4(&rig), sizeof upper);
        rig_begin(&rig);
        rhw_pass_set_viewport(rig.context, rig.recording,
                              &(struct rhw_viewport){0, HEIGHT, WIDTH, -HEIGHT, 0, 1});
        rig_draw(&rig, v, 3);
        rig_end(&rig);
        const float(*const lower)[4] = rig_read_float4(&rig);
        for (int y = 0; y < HEIGHT; y++) {
            assert_memory_equal(lower[(HEIGHT - 1 - y) * WIDTH], upper[y * WIDTH], sizeof(float[WIDTH][4]));
        }
        drawn++;
    }
    assert_true(drawn > 20);
    rig_close(&rig);
}

static void test_limits(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_begin(&rig);
    static const struct rhw_viewport allowed[] = {
        {0, 8, 8, -8, 0, 1}, {0, 0, 8, -16384, 0, 1}, {0, -16384, 8, -16384, 0, 1}, {0, 32768, 8, -1, 0, 1}};
    static const struct rhw_viewport refused[] = {
        {0, 0, 8, -16385, 0, 1}, {0, -16385, 8, -16384, 0, 1}, {0, 32769, 8, -8, 0, 1}, {8, 0, -8, 8, 0, 1}};
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++) {
        rhw_pass_set_viewport(rig.context, rig.recording, &allowed[i]);
        assert_int_equal(rig.misuses, 0);
    }
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        rhw_pass_set_viewport(rig.context, rig.recording, &refused[i]);
        rig_expect_misuse(&rig, i == 1 || i == 2 ? "each is within ±32768"
                                                 : "the width is above 0, and neither is beyond 16384");
    }
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_places),     cmocka_unit_test(test_points),         cmocka_unit_test(test_facing),
    cmocka_unit_test(test_same_bytes), cmocka_unit_test(test_rows_turn_over), cmocka_unit_test(test_limits),
};

const struct unit_tests test_flipped_viewport = UNIT_TESTS(tests, NULL, NULL);
