// SPDX-License-Identifier: MIT
// Varyings by name: what a struct writes arrives in the struct, in both forms and between them; a struct that does not
// fit its varyings is told, with the member's name.
#include "harness.h"

#include <string.h>

struct surface {
    rhw_float normal[3], uv[2], height;
};

struct surface1 {
    float normal[3], uv[2], height;
};

static const struct rhw_varying lanes[3] = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                            RHW_VARYING(struct surface, uv, RHW_SMOOTH, true),
                                            RHW_VARYING(struct surface, height, RHW_FLAT, false)};
static const struct rhw_varying one[3] = {RHW_VARYING1(struct surface1, normal, RHW_SMOOTH, false),
                                          RHW_VARYING1(struct surface1, uv, RHW_SMOOTH, true),
                                          RHW_VARYING1(struct surface1, height, RHW_FLAT, false)};

static void vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
        memcpy(v->position, v->attribute[0], sizeof v->position);
        memcpy(out->normal, v->attribute[1], sizeof out->normal);
        out->uv[0] = v->attribute[1][0] * 2.0f;
        out->uv[1] = v->attribute[1][3];
        out->height = v->attribute[1][2] + 5.0f;
    }
}

static void vertex1(struct rhw_vertex1 *v)
{
    struct surface1 *out = RHW_VARYINGS_OUT(struct surface1, v->varying);
    memcpy(v->position, v->attribute[0], sizeof v->position);
    memcpy(out->normal, v->attribute[1], sizeof out->normal);
    out->uv[0] = v->attribute[1][0] * 2.0f;
    out->uv[1] = v->attribute[1][3];
    out->height = v->attribute[1][2] + 5.0f;
}

static void fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct surface *in = RHW_VARYINGS(struct surface, groups[g].varying);
        const struct surface *ddx = RHW_VARYINGS(struct surface, groups[g].ddx);
        rhw_float *color = groups[g].color[0];
        color[0] = in->normal[0] + in->normal[2];
        color[1] = in->uv[0] - in->uv[1];
        color[2] = in->height;
        color[3] = ddx->uv[0];
    }
}

static void fragment1(struct rhw_fragment1 *f)
{
    const struct surface1 *in = RHW_VARYINGS(struct surface1, f->varying);
    const struct surface1 *ddx = RHW_VARYINGS(struct surface1, f->ddx);
    f->color[0][0] = in->normal[0] + in->normal[2];
    f->color[0][1] = in->uv[0] - in->uv[1];
    f->color[0][2] = in->height;
    f->color[0][3] = ddx->uv[0];
}

static void draw(bool vertex_lanes, bool fragment_lanes, float result[16 * 16][4])
{
    static const struct rig_vertex triangle[3] = {
        {{-1, -1, 0, 1}, {1, 2, 3, 4}}, {{3, -1, 0, 1}, {5, -6, 7, 8}}, {{-4, 12, 0, 4}, {-9, 1, 0.5f, 2}}};
    struct rig rig;
    rig_open(&rig, 16, 16);
    struct rhw_program *const program = &rig.pipeline.program;
    memset(program->vertex, 0, sizeof program->vertex);
    memset(program->fragment, 0, sizeof program->fragment);
    program->vertex[0] = vertex_lanes ? vertex : NULL;
    program->fragment[0] = fragment_lanes ? fragment : NULL;
    program->vertex1 = vertex1;
    program->fragment1 = fragment1;
    memcpy(program->varyings, vertex_lanes ? lanes : one, sizeof lanes);
    program->varying_count = 3;
    rig_draw_once(&rig, triangle, 3);
    memcpy(result, rig_read_float4(&rig), sizeof(float[16 * 16][4]));
    rig_close(&rig);
}

static void test_members_have_numbers(void **state)
{
    (void)state;
    assert_true(RHW_COMPONENT(struct surface, normal) == 0 && RHW_COMPONENT(struct surface, uv) == 3);
    assert_true(RHW_COMPONENT1(struct surface1, uv) == 3 && RHW_COMPONENT1(struct surface1, height) == 5);
}

static void test_members_arrive_by_name(void **state)
{
    (void)state;
    static float first[16 * 16][4], other[16 * 16][4];
    draw(true, true, first);
    for (int i = 0; i < 16 * 16; i++) {
        assert_true(first[i][2] == 8); // flat, of the first vertex
        assert_true(first[i][3] != 0);
    }
    for (int form = 0; form < 3; form++) {
        draw(form & 1, form & 2, other);
        assert_memory_equal(first, other, sizeof first);
    }
}

static void expect_told(struct rig *rig, const char *part)
{
    rhw_pipeline pipeline;
    if (rhw_pipeline_create(rig->context, &rig->pipeline, &pipeline) != RHW_ERROR_MISUSE) {
        fail_msg("accepted: %s", part);
    }
    rig_expect_misuse(rig, part);
}

static void test_what_does_not_fit_is_told(void **state)
{
    (void)state;
    struct two {
        rhw_float wide[5], narrow;
    };
    struct padded {
        rhw_float value;
        float rest;
    };
    static const struct rhw_varying wide[2] = {RHW_VARYING(struct two, wide, RHW_SMOOTH, false),
                                               RHW_VARYING(struct two, narrow, RHW_SMOOTH, false)};
    static const struct rhw_varying padded = RHW_VARYING(struct padded, value, RHW_SMOOTH, false);
    static const struct rhw_varying floats = RHW_VARYING(struct surface1, normal, RHW_SMOOTH, false);
    static const struct rhw_varying not_floats = RHW_VARYING1(struct surface, normal, RHW_SMOOTH, false);
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rhw_program *const program = &rig.pipeline.program;
    const struct rhw_varying plain = program->varyings[0];

    program->varyings[0] = lanes[1];
    program->varyings[1] = lanes[0];
    program->varyings[2] = lanes[2];
    program->varying_count = 3;
    expect_told(&rig, "program.varyings[0], uv, begins at component 3 of its struct, after 0");

    program->varyings[0] = lanes[0];
    program->varyings[1] = lanes[2];
    program->varying_count = 2;
    expect_told(&rig, "program.varyings[1], height, begins at component 5 of its struct, after 3");

    program->varyings[1] = lanes[1];
    expect_told(&rig,
                "program.varyings[1], uv, is the last and ends at component 5 of its struct, which has 6");

    memcpy(program->varyings, wide, sizeof wide);
    expect_told(&rig, "program.varyings[0], wide, has 5 components");

    program->varying_count = 1;
    program->varyings[0] = padded;
    expect_told(&rig,
                "program.varyings[0], value, is the last and ends at component 1 of its struct, which has 2");

    program->varyings[0] = floats;
    expect_told(&rig, "program.varyings[0], normal, has 0 components");
    program->varyings[0] = not_floats;
    expect_told(&rig, "program.varyings[0], normal, has 24 components");

    program->varying_count = 2;
    program->varyings[0] = lanes[0];
    program->varyings[1] = plain;
    expect_told(&rig, "program.varyings[1] has no name");
    program->varyings[0] = plain;
    program->varyings[1] = lanes[0];
    expect_told(&rig, "program.varyings[1] is normal of a struct and those before it have no name");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_members_have_numbers),
    cmocka_unit_test(test_members_arrive_by_name),
    cmocka_unit_test(test_what_does_not_fit_is_told),
};

const struct unit_tests test_varying_struct = UNIT_TESTS(tests, NULL, NULL);
