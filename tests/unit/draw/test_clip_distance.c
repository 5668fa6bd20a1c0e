// SPDX-License-Identifier: MIT
// Clip and cull distances of triangles, lines and points: what is cut off, that values of what is left do not change,
// both shader forms, and what validation says.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 64, PLANES = 8 };

// Uniforms: a distance is the plane's dot product with the clip position.
struct planes {
    float clip[PLANES][4], cull[PLANES][4];
    int32_t clip_count, cull_count;
};

static void plane_vertex(struct rhw_vertex *groups, int count)
{
    const struct planes *const p = groups->uniforms;
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        for (int k = 0; k < 2; k++) {
            const float(*const planes)[4] = k == 0 ? p->clip : p->cull;
            rhw_float *const out = k == 0 ? groups[g].clip_distance : groups[g].cull_distance;
            for (int i = 0; i < (k == 0 ? p->clip_count : p->cull_count); i++) {
                out[i] = rhw_splat(0);
                for (int c = 0; c < 4; c++) {
                    out[i] += rhw_splat(planes[i][c]) * groups[g].position[c];
                }
            }
        }
    }
}

static void plane_vertex1(struct rhw_vertex1 *v)
{
    const struct planes *const p = v->uniforms;
    memcpy(v->position, v->attribute[0], sizeof v->position);
    memcpy(v->varying, v->attribute[1], 4 * sizeof(float));
    for (int k = 0; k < 2; k++) {
        const float(*const planes)[4] = k == 0 ? p->clip : p->cull;
        float *const out = k == 0 ? v->clip_distance : v->cull_distance;
        for (int i = 0; i < (k == 0 ? p->clip_count : p->cull_count); i++) {
            out[i] = 0;
            for (int c = 0; c < 4; c++) {
                out[i] += planes[i][c] * v->position[c];
            }
        }
    }
}

static void open_rig(struct rig *rig)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, plane_vertex, rig_fragment_pass);
    rig->pipeline.program.uniform_size = sizeof(struct planes);
}

static void draw(struct rig *rig, const struct planes *planes, const struct rig_vertex *vertices, int count)
{
    rig->pipeline.program.clip_distance_count = planes->clip_count;
    rig->pipeline.program.cull_distance_count = planes->cull_count;
    rig_begin(rig);
    rhw_pass_set_uniforms(rig->context, rig->recording, planes, sizeof *planes);
    rig_draw(rig, vertices, count);
    rig_end(rig);
}

// A slope in space, so that values would show it if they were not those of the whole triangle.
static void make_slope(const struct rig *rig, struct rig_vertex vertices[3])
{
    static const float at[3][4] = {{2, 3, 0.2f, 1}, {61, 5, 0.4f, 2}, {9, 62, 0.6f, 5}};
    for (int i = 0; i < 3; i++) {
        rig_place(rig, at[i][0], at[i][1], at[i][2], at[i][3], vertices[i].position);
        vertices[i].value[0] = (float)(i * i + 1);
        vertices[i].value[1] = (float)(7 - i);
        vertices[i].value[2] = (float)(i == 1);
        vertices[i].value[3] = 1;
    }
}

// Planes through pixel borders, x = −1/2 and y = 1/4: sides of the clip volume that is left.
static const struct planes two = {.clip = {{1, 0, 0, 0.5f}, {0, -1, 0, 0.25f}}, .clip_count = 2};

static void test_triangles_are_cut_and_keep_their_values(void **state)
{
    (void)state;
    static float whole[SIZE * SIZE][4];
    for (int form = 0; form < 2; form++) {
        struct rig rig;
        open_rig(&rig);
        if (form == 1) {
            memset(rig.pipeline.program.vertex, 0, sizeof rig.pipeline.program.vertex);
            rig.pipeline.program.vertex1 = plane_vertex1;
        }
        struct rig_vertex vertices[3];
        const struct planes none = {.clip_count = 0};
        make_slope(&rig, vertices);
        draw(&rig, &none, vertices, 3);
        assert_int_equal(rig.stats.triangles_clipped, 0);
        memcpy(whole, rig_read_float4(&rig), sizeof whole);
        draw(&rig, &two, vertices, 3);
        assert_int_equal(rig.stats.triangles_clipped, 1);
        const float(*pixels)[4] = rig_read_float4(&rig);
        int seen = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            static const float nothing[4];
            const bool in = i % SIZE >= 16 && i / SIZE >= 24;
            if (memcmp(pixels[i], in ? whole[i] : nothing, sizeof *pixels) != 0) {
                fail_msg("form %d, pixel %d, %d", form, i % SIZE, i / SIZE);
            }
            seen += pixels[i][3] != 0;
        }
        assert_true(seen > 300);
        rig_close(&rig);
    }
}

// Eight planes around a circle leave a regular octagon of two triangles, without a hole where they meet.
static void test_eight_planes_leave_an_octagon(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct planes planes = {.clip_count = PLANES};
    for (int i = 0; i < PLANES; i++) {
        const double angle = (i + 0.25) * 0.78539816339744831;
        planes.clip[i][0] = (float)cos(angle);
        planes.clip[i][1] = (float)sin(angle);
        planes.clip[i][3] = 0.7f;
    }
    struct rig_vertex vertices[6];
    const float value[4] = {1, 1, 1, 1};
    rig_cover(&rig, 0.5f, value, vertices);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    draw(&rig, &planes, vertices, 6);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double x = (i % SIZE + 0.5) / 32 - 1, y = 1 - (i / SIZE + 0.5) / 32;
        double least = 1;
        for (int k = 0; k < PLANES; k++) {
            least = fmin(least, (double)planes.clip[k][0] * x + (double)planes.clip[k][1] * y + 0.7);
        }
        if (fabs(least) > 0.001 && pixels[i][0] != (least > 0 ? 1 : 0)) {
            fail_msg("pixel %d, %d is drawn %g times", i % SIZE, i / SIZE, (double)pixels[i][0]);
        }
    }
    rig_close(&rig);
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

static void test_lines_and_points_are_cut(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex v[2] = {{.value = {10, 0, 0, 1}}, {.value = {50, 0, 0, 1}}};
    rig_place(&rig, 4, 30.5f, 0.5f, 1, v[0].position);
    rig_place(&rig, 44, 30.5f, 0.5f, 1, v[1].position);
    rig.pipeline.topology = RHW_LINE_LIST;
    draw(&rig, &two, v, 2);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int x = 0; x < SIZE; x++) {
        const float *const p = pixels[30 * SIZE + x];
        assert_int_equal(p[3] != 0, x >= 16 && x < 44);
        assert_true(p[3] == 0 || fabs((double)p[0] - (10 + (x + 0.5 - 4))) < 1e-4);
    }
    rig.pipeline.topology = RHW_POINT_LIST;
    draw(&rig, &two, v, 2); // the first is outside
    assert_int_equal(covered(&rig), 1);
    v[0].position[0] = NAN; // and so is a distance that is no number
    v[1].position[0] = 0;
    draw(&rig, &two, v, 2);
    assert_int_equal(covered(&rig), 1);
    rig_close(&rig);
}

// Not drawn where all vertices are below 0 by the same distance; otherwise whole.
static void test_cull_distances_take_all_or_nothing(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex vertices[3];
    make_slope(&rig, vertices);
    const struct planes none = {.clip_count = 0};
    draw(&rig, &none, vertices, 3);
    const int whole = covered(&rig);
    static const struct {
        float planes[2][4];
        bool drawn;
    } cases[] = {{{{0, 0, 0, -1}, {0, 0, 0, 1}}, false}, {{{0, 0, 0, 1}, {0, 0, 0, -1}}, false},
                 {{{1, 0, 0, 0}, {-1, 0, 0, 0}}, true},  {{{0, 0, 0, 0}, {0, 0, 0, 0}}, true},
                 {{{NAN, 0, 0, 0}, {0, 0, 0, 1}}, true}, {{{0, 0, 0, 1}, {0, 0, 0, 1}}, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct planes planes = {.cull_count = 2};
        memcpy(planes.cull, cases[i].planes, sizeof cases[i].planes);
        draw(&rig, &planes, vertices, 3);
        if (covered(&rig) != (cases[i].drawn ? whole : 0)) {
            fail_msg("case %d", (int)i);
        }
        assert_int_equal(rig.stats.triangles_clipped, 0);
        assert_int_equal(rig.stats.triangles_culled, cases[i].drawn ? 0 : 1);
    }
    rig_close(&rig);
}

static void test_counts_out_of_range_are_misuse(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rhw_pipeline pipeline;
    rig.pipeline.program.clip_distance_count = 9;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "program.clip_distance_count is 9; it must be 0..8");
    rig.pipeline.program.clip_distance_count = 0;
    rig.pipeline.program.cull_distance_count = -1;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "program.cull_distance_count is -1; it must be 0..8");
    rig_close(&rig);
}

static void test_validation_looks_at_distances(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.validate = RHW_VALIDATE_ON;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &def);
    rig_set_program(&rig, plane_vertex, rig_fragment_pass);
    rig.pipeline.program.uniform_size = sizeof(struct planes);
    struct rig_vertex vertices[3];
    make_slope(&rig, vertices);
    draw(&rig, &two, vertices, 3);
    for (int more = -1; more <= 1; more += 2) {
        rig.pipeline.program.clip_distance_count = 2 + more;
        rig_begin(&rig);
        rhw_pass_set_uniforms(rig.context, rig.recording, &two, sizeof two);
        rig_draw(&rig, vertices, 3);
        rig_end(&rig);
        rig_expect_misuse(&rig, more < 0 ? "writes clip_distance[1]; its program has 1"
                                         : "does not write clip_distance[2]; its program has 3");
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_triangles_are_cut_and_keep_their_values),
    cmocka_unit_test(test_eight_planes_leave_an_octagon),
    cmocka_unit_test(test_lines_and_points_are_cut),
    cmocka_unit_test(test_cull_distances_take_all_or_nothing),
    cmocka_unit_test(test_counts_out_of_range_are_misuse),
    cmocka_unit_test(test_validation_looks_at_distances),
};

const struct unit_tests test_clip_distance = UNIT_TESTS(tests, NULL, NULL);
