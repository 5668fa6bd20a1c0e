// SPDX-License-Identifier: MIT
// Clouds of points: how large their discs are, and the colours of those that have none.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 64 }; // points each way

// A square of points one apart, which rises by as much as it is deep; with what each line has more.
static void write_cloud(const char *name, const char *properties, const char *more)
{
    static char text[1 << 18];
    char *out =
        text + sprintf(text,
                       "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                       "property float z\n%send_header\n",
                       SIDE * SIDE, properties);
    for (int i = 0; i < SIDE * SIDE; i++) {
        out += sprintf(out, "%d %d %d%s\n", i % SIDE, i / SIDE, i / SIDE, more);
    }
    write_text(name, text);
}

// 32 cells along the side of 63 hold 4 points each, so points are half a cell apart: 1.2 × 63 / 64.
static void test_radius(void **state)
{
    (void)state;
    write_cloud("x.ply", "", "");
    struct scene_model *model = load("x.ply");
    assert_int_equal(model->meshes[0].primitive, SCENE_PRIMITIVE_POINTS);
    assert_floats(&model->meshes[0].point_radius, (const float[]){1.2f * 63 / 64}, 1, 1e-5f);
    scene_model_free(model);
    // Fewer than 64 are single points.
    model = load_text("few.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    assert_floats(&model->meshes[0].point_radius, (const float[]){0}, 1, 0);
    assert_null(model->meshes[0].colors);
    scene_model_free(model);
}

// No disc is larger than 3 % of the cloud, and points in one place have no size.
static void test_extremes(void **state)
{
    (void)state;
    char text[4096], *out = text;
    for (int i = 0; i < 64; i++) {
        out += sprintf(out, "v %d %d 0\n", i % 8, i / 8);
    }
    struct scene_model *model = load_text("x.obj", text);
    assert_floats(&model->meshes[0].point_radius, (const float[]){0.03f * 7}, 1, 1e-6f);
    scene_model_free(model);
    out = text;
    for (int i = 0; i < 64; i++) {
        out += sprintf(out, "v 1 2 3\n");
    }
    model = load_text("x.obj", text);
    assert_floats(&model->meshes[0].point_radius, (const float[]){0}, 1, 0);
    scene_model_free(model);
}

// The lowest are dark blue, the highest yellow, those in the middle green-blue; sRGB 0.13, 0.57, 0.55 there.
static void test_heights(void **state)
{
    (void)state;
    write_cloud("x.ply", "", "");
    struct scene_model *model = load("x.ply");
    const struct scene_mesh *mesh = &model->meshes[0];
    const struct scene_material *material = &model->materials[mesh->material];
    assert_floats(material->base_color, (const float[]){1, 1, 1, 1}, 4, 0);
    assert_floats(mesh->colors[0], (const float[]){0.0592f, 0, 0.0890f, 1}, 4, 1e-3f);
    assert_floats(mesh->colors[SIDE * SIDE - 1], (const float[]){0.9774f, 0.8069f, 0.0195f, 1}, 4, 1e-3f);
    const float *below = mesh->colors[SIDE * (SIDE / 2 - 1)], *above = mesh->colors[SIDE * (SIDE / 2)];
    const float middle[3] = {0.0152f, 0.2850f, 0.2633f};
    for (int c = 0; c < 3; c++) {
        const float both = (below[c] + above[c]) / 2;
        assert_floats(&both, &middle[c], 1, 0.01f);
    }
    scene_model_free(model);
}

// Colours of the file are kept.
static void test_colored(void **state)
{
    (void)state;
    write_cloud("x.ply", "property uchar red\nproperty uchar green\nproperty uchar blue\n", " 255 0 0");
    struct scene_model *model = load("x.ply");
    assert_floats(model->meshes[0].colors[7], (const float[]){1, 0, 0, 1}, 4, 0);
    assert_true(model->meshes[0].point_radius > 1);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_radius),
    cmocka_unit_test(test_extremes),
    cmocka_unit_test(test_heights),
    cmocka_unit_test(test_colored),
};

const struct unit_tests test_point_clouds = UNIT_TESTS(tests, make_directory, remove_directory);
