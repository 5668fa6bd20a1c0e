// SPDX-License-Identifier: MIT
// Transparent surfaces above each other, whose light can be worked out: sorted by triangles, and exact in every sample.
#include "tiny_model.h"

#include <string.h>

enum { SIZE = 16, MOST = 12 };

// Squares of one mesh, unlit, each with a colour.
struct stack {
    struct tiny t;
    int count;
    float positions[MOST * 4][3], normals[MOST * 4][3], colors[MOST * 4][4];
    uint32_t indices[MOST * 6];
};

static void make_stack(struct stack *s)
{
    memset(s, 0, sizeof *s);
    tiny_make(&s->t);
    s->t.material.alpha_mode = SCENE_ALPHA_BLEND;
    s->t.material.double_sided = true;
    s->t.mesh.positions = s->positions;
    s->t.mesh.normals = s->normals;
    s->t.mesh.colors = s->colors;
    s->t.mesh.indices = s->indices;
    s->t.mesh.uvs[0] = NULL;
}

// The square −1..1 at z, tilted so that z rises by `slope` times x.
static void add_square(struct stack *s, float z, float slope, const float color[4])
{
    const uint32_t first = (uint32_t)s->count * 4;
    for (uint32_t v = 0; v < 4; v++) {
        memcpy(s->positions[first + v], s->t.positions[v], sizeof s->positions[0]);
        s->positions[first + v][2] = z + slope * s->t.positions[v][0];
        s->normals[first + v][2] = 1.0f;
        memcpy(s->colors[first + v], color, sizeof s->colors[0]);
    }
    for (uint32_t i = 0; i < 6; i++) {
        s->indices[(uint32_t)s->count * 6 + i] = first + s->t.indices[i];
    }
    s->count++;
    s->t.mesh.vertex_count = (uint32_t)s->count * 4;
    s->t.mesh.index_count = (uint32_t)s->count * 6;
    for (int c = 0; c < 3; c++) {
        s->t.mesh.bounds_min[c] = s->t.model.bounds_min[c] = -4.0f;
        s->t.mesh.bounds_max[c] = s->t.model.bounds_max[c] = 4.0f;
    }
}

static struct scene_view make_view(const struct stack *s, enum scene_transparency transparency)
{
    struct scene_view view = tiny_view(&s->t, SIZE);
    view.camera.eye[2] = 10;
    view.camera.zfar = 20;
    view.transparency = transparency;
    view.outputs = SCENE_OUTPUT_LINEAR | SCENE_OUTPUT_COLOR;
    return view;
}

static void draw(const struct stack *s, const struct scene_view *view, struct scene_pictures *pictures)
{
    const struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    struct scene *scene;
    char error[256];
    assert_true(scene_view_check(view, error, sizeof error));
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(scene_create(context, &s->t.model, &scene), RHW_OK);
    assert_int_equal(scene_draw(scene, view, pictures, NULL), RHW_OK);
    struct scene_pictures again; // what a scene keeps from draw to draw changes nothing
    assert_int_equal(scene_draw(scene, view, &again, NULL), RHW_OK);
    assert_memory_equal(pictures->color, again.color, 4 * SIZE * SIZE);
    scene_pictures_free(&again);
    scene_destroy(scene);
    rhw_context_destroy(context);
}

// Premultiplied, over what is there.
static void lay_over(double below[4], const float color[4])
{
    for (int c = 0; c < 4; c++) {
        const double above = c < 3 ? (double)color[c] * (double)color[3] : (double)color[3];
        below[c] = above + below[c] * (1.0 - (double)color[3]);
    }
}

static void assert_light(const struct scene_pictures *pictures, int x, int y, const double expected[4])
{
    for (int c = 0; c < 4; c++) {
        tiny_assert_close((double)pictures->linear[(y * SIZE + x) * 4 + c], expected[c], 1e-5);
    }
}

static const float red[4] = {0.9f, 0.1f, 0.2f, 0.5f}, green[4] = {0.1f, 0.8f, 0.3f, 0.25f},
                   blue[4] = {0.2f, 0.1f, 0.7f, 0.75f};

// They cross in the middle: on each side another one is in front.
static void crossing_squares_lie_as_they_do(void **state)
{
    (void)state;
    struct stack s;
    for (int order = 0; order < 2; order++) {
        make_stack(&s);
        add_square(&s, 0.0f, order ? -1.0f : 1.0f, order ? green : red);
        add_square(&s, 0.0f, order ? 1.0f : -1.0f, order ? red : green);
        for (int samples = 1; samples <= 4; samples *= 4) {
            for (int supersample = 1; supersample <= 4; supersample *= 4) {
                struct scene_view view = make_view(&s, SCENE_TRANSPARENCY_EXACT);
                view.samples = samples;
                view.supersample = supersample;
                struct scene_pictures pictures;
                draw(&s, &view, &pictures);
                double left[4] = {0}, right[4] = {0};
                lay_over(left, red);
                lay_over(left, green);
                lay_over(right, green);
                lay_over(right, red);
                assert_light(&pictures, SIZE / 2 - 3, SIZE / 2, left);
                assert_light(&pictures, SIZE / 2 + 2, SIZE / 2, right);
                scene_pictures_free(&pictures);
            }
        }
    }
}

// Nine parallel squares in a scrambled order, and the same mixed by another one.
static void triangles_are_sorted(void **state)
{
    (void)state;
    static const int orders[3][9] = {
        {4, 8, 0, 2, 6, 1, 7, 3, 5}, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {8, 7, 6, 5, 4, 3, 2, 1, 0}};
    const float *const colors[3] = {red, green, blue};
    double expected[4] = {0};
    for (int i = 0; i < 9; i++) {
        lay_over(expected, colors[i % 3]);
    }
    struct scene_pictures first = {0};
    for (int order = 0; order < 3; order++) {
        struct stack s;
        make_stack(&s);
        for (int i = 0; i < 9; i++) {
            const int place = orders[order][i];
            add_square(&s, (float)place * 0.3f - 1.2f, 0.0f, colors[place % 3]);
        }
        for (int mode = 0; mode < 2; mode++) {
            const struct scene_view view =
                make_view(&s, mode ? SCENE_TRANSPARENCY_EXACT : SCENE_TRANSPARENCY_SORTED);
            struct scene_pictures pictures;
            draw(&s, &view, &pictures);
            assert_light(&pictures, SIZE / 2, SIZE / 2 - 1, expected);
            if (order + mode == 0) {
                first = pictures;
                continue;
            }
            assert_memory_equal(pictures.linear, first.linear, 16 * SIZE * SIZE);
            scene_pictures_free(&pictures);
        }
    }
    scene_pictures_free(&first);
}

// What lies behind an opaque square is not seen, what lies before it is; and where there is one layer alone, on edges too,
// both ways give the same bytes.
static void opaque_surfaces_hide(void **state)
{
    (void)state;
    struct stack s;
    make_stack(&s);
    add_square(&s, 1.0f, 0.0f, green);
    add_square(&s, -1.0f, 0.0f, red);
    struct scene_mesh meshes[2] = {s.t.mesh, s.t.mesh};
    struct scene_material materials[2] = {s.t.material, s.t.material};
    materials[1].alpha_mode = SCENE_ALPHA_OPAQUE;
    meshes[1].material = 1;
    meshes[1].colors = NULL;
    meshes[1].index_count = 6;
    struct tiny *t = &s.t;
    t->model.meshes = meshes;
    t->model.materials = materials;
    t->model.mesh_count = t->model.material_count = t->model.instance_count = 2;
    t->instances[1].mesh = 1;
    t->instances[1].world[14] = -1.0f; // at z = 0
    struct scene_pictures pictures[2];
    for (int mode = 0; mode < 2; mode++) {
        struct scene_view view = make_view(&s, mode ? SCENE_TRANSPARENCY_EXACT : SCENE_TRANSPARENCY_SORTED);
        view.samples = 4;
        view.camera.eye[0] = 0.03;
        draw(&s, &view, &pictures[mode]);
        double expected[4] = {1, 1, 1, 1};
        lay_over(expected, green);
        assert_light(&pictures[mode], SIZE / 2, SIZE / 2, expected);
    }
    assert_memory_equal(pictures[0].color, pictures[1].color, 4 * SIZE * SIZE);
    scene_pictures_free(&pictures[0]);
    scene_pictures_free(&pictures[1]);
}

static void views_without_such_a_transparency_are_refused(void **state)
{
    (void)state;
    struct stack s;
    make_stack(&s);
    struct scene_view view = make_view(&s, (enum scene_transparency)2);
    char error[256];
    assert_false(scene_view_check(&view, error, sizeof error));
    assert_string_equal(error, "transparency: must be sorted or exact");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(crossing_squares_lie_as_they_do), cmocka_unit_test(triangles_are_sorted),
    cmocka_unit_test(opaque_surfaces_hide), cmocka_unit_test(views_without_such_a_transparency_are_refused)};

const struct unit_tests test_transparency = UNIT_TESTS(tests, NULL, NULL);
