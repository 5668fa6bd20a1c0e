// SPDX-License-Identifier: MIT
// Extrusions of an X3D, against values that follow from the standard's rules by hand.
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static struct scene_model *load_extrusion(const char *fields)
{
    write_format("e.x3d", "<X3D><Scene><Shape><Extrusion %s/></Shape></Scene></X3D>", fields);
    struct scene_model *const model = load("e.x3d");
    assert_int_equal(model->unsupported_count + model->warning_count, 0);
    assert_int_equal(model->mesh_count, 1);
    return model;
}

static bool is_near(const float *a, const float *b, int width)
{
    float most = 0;
    for (int c = 0; c < width; c++) {
        most = fmaxf(most, fabsf(a[c] - b[c]));
    }
    return most < 2e-5f;
}

// Return true if a triangle has a corner here, with this normal and place in the texture, each of which may be NULL.
static bool has_corner(const struct scene_mesh *mesh, const float position[3], const float *normal,
                       const float *place)
{
    bool found = false;
    for (uint32_t i = 0; i < mesh->index_count && !found; i++) {
        const uint32_t vertex = mesh->indices[i];
        // Textures of a model run downward.
        const float up[2] = {mesh->uvs[0][vertex][0], 1 - mesh->uvs[0][vertex][1]};
        found = is_near(mesh->positions[vertex], position, 3) &&
                (normal == NULL || is_near(mesh->normals[vertex], normal, 3)) &&
                (place == NULL || is_near(up, place, 2));
    }
    return found;
}

// Without fields an extrusion is a cube of edges of 2 that is 1 high, flat, with the texture around it and on its caps.
static void test_usual_fields(void **state)
{
    (void)state;
    struct scene_model *const model = load_extrusion("");
    const struct scene_mesh *const mesh = &model->meshes[0];
    assert_int_equal(model->triangles_drawn, 12);
    static const struct {
        float position[3], normal[3], place[2];
    } corners[] = {
        {{1, 0, 1}, {1, 0, 0}, {0, 0}},       {{1, 1, -1}, {1, 0, 0}, {0.25f, 1}},
        {{1, 0, -1}, {0, 0, -1}, {0.25f, 0}}, {{-1, 1, -1}, {-1, 0, 0}, {0.5f, 1}},
        {{-1, 0, 1}, {0, 0, 1}, {0.75f, 0}},  {{1, 1, 1}, {0, 0, 1}, {1, 1}},
        {{1, 1, -1}, {0, 1, 0}, {1, 0}},      {{-1, 1, 1}, {0, 1, 0}, {0, 1}},
        {{-1, 0, -1}, {0, -1, 0}, {0, 0}},    {{1, 0, 1}, {0, -1, 0}, {1, 1}},
    };
    for (size_t i = 0; i < sizeof corners / sizeof corners[0]; i++) {
        if (!has_corner(mesh, corners[i].position, corners[i].normal, corners[i].place)) {
            fail_msg("corner %zu is not there", i);
        }
    }
    scene_model_free(model);
}

#define WEDGE "crossSection='0 0 4 0 0 2' "
#define S     0.70710678f

// Points where the standard's rules put the section (4, 0) and (0, 2), of which the first is along x and the second
// along z of the plane across the spine.
static void test_planes(void **state)
{
    (void)state;
    static const struct {
        const char *fields;
        unsigned triangles;
        float points[3][3];
    } cases[] = {
        // A straight spine turns the plane as it turns a vector along y.
        {WEDGE "spine='0 0 0 3 0 0'", 6, {{0, -4, 0}, {3, 0, 2}, {3, 0, 0}}},
        {WEDGE "spine='0 0 0 0 0 3'", 6, {{4, 0, 0}, {0, -2, 3}, {0, 0, 3}}},
        {WEDGE "spine='0 0 0 0 -3 0'", 6, {{4, 0, 0}, {0, 0, -2}, {4, -3, 0}}},
        {WEDGE "spine='0 0 0 0 3 3'", 6, {{4, 0, 0}, {0, -2 * S, 2 * S}, {4, 3, 3}}},
        {WEDGE "spine='0 0 0 0.1 0.2 0.3 0.3 0.6 0.9'",
         10,
         {{4 * 0.953452f, -4 * 0.267261f, -4 * 0.139643f},
          {-2 * 0.139643f, -2 * 0.801784f, 2 * 0.581070f},
          {0.3f, 0.6f, 0.9f}}},
        // Where all points of the spine are one, it stands upright.
        {WEDGE "spine='1 2 3 1 2 3' orientation='0 1 0 0 0 1 0 1.57079633'",
         5,
         {{5, 2, 3}, {1, 2, -1}, {3, 2, 3}}},
        // At a bend y is halfway, and z upright on both ways: here (1, 0, 0) × (0, −1, 0).
        {WEDGE "spine='0 0 0 0 1 0 1 1 0'", 10, {{-4, 0, 0}, {-4 * S, 1 + 4 * S, 0}, {1, 5, 0}}},
        {WEDGE "spine='0 0 0 0 1 0 1 1 0'", 10, {{0, 0, -2}, {0, 1, -2}, {1, 1, -2}}},
        // What comes before a bend, or behind it, has its z, also where points are at one place.
        {WEDGE "spine='0 -2 0 0 0 0 0 0 0 0 1 0 0 1 0 1 1 0 2 1 0'",
         18,
         {{-4, -2, 0}, {-4 * S, 1 + 4 * S, 0}, {2, 5, 0}}},
        // A turn to the other side would make z point the other way, which it does not.
        {WEDGE "spine='0 0 0 0 1 0 1 1 0 1 2 0'", 14, {{-4, 0, 0}, {1 - 4 * S, 1 + 4 * S, 0}, {-3, 2, 0}}},
        // The first point of a closed spine has the plane of the last one.
        {WEDGE "spine='0 0 0 1 0 0 1 0 1 0 0 1 0 0 0' beginCap='false' endCap='false'",
         16,
         {{-4 * S, 0, -4 * S}, {1 + 4 * S, 0, 1 + 4 * S}, {0, -2, 0}}},
        // Points that files with six digits cannot tell apart are at one place.
        {WEDGE "spine='0 0 0 1 0 0 1 0 1 1 0.0000001 1 0 0 1 0 0 0.0000001' beginCap='false' endCap='false'",
         20,
         {{-4 * S, 0, -4 * S}, {1 + 4 * S, 0, 1 + 4 * S}, {0, -2, 0}}},
        // The section is scaled, then turned; one scale is that of all points.
        {WEDGE "spine='0 0 0 0 1 0' scale='2 3' orientation='0 1 0 1.57079633 0 0 1 1.57079633'",
         6,
         {{0, 0, -8}, {0, 9, 0}, {0, 1, 6}}},
        {WEDGE "spine='0 0 0 0 1 0' scale='1 1 0.5 2' endCap='false'", 5, {{4, 0, 0}, {2, 1, 0}, {0, 1, 4}}},
        // A tip has no faces without area, and no cap.
        {WEDGE "spine='0 0 0 0 1 0' scale='1 1 0 0'", 3, {{4, 0, 0}, {0, 0, 2}, {0, 1, 0}}},
        // A section of two corners has no caps.
        {"crossSection='0 0 4 0'", 2, {{4, 0, 0}, {4, 1, 0}, {0, 1, 0}}},
        // A spine that turns back goes on to there, and keeps to its first way where it is straight.
        {WEDGE "spine='0 0 0 1 0 0 1 1 0 1 0 0'", 14, {{1 + 4 * S, -4 * S, 0}, {5, 1, 0}, {-3, 0, 0}}},
        {WEDGE "spine='0 0 0 0 3 0 0 1 0'", 10, {{4, 0, 0}, {4, 3, 0}, {4, 1, 0}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *const model = load_extrusion(cases[i].fields);
        if (model->triangles_drawn != cases[i].triangles) {
            fail_msg("case %zu: %u triangles", i, (unsigned)model->triangles_drawn);
        }
        for (size_t k = 0; k < 3; k++) {
            if (!has_corner(&model->meshes[0], cases[i].points[k], NULL, NULL)) {
                fail_msg("case %zu: point %zu is not there", i, k);
            }
        }
        scene_model_free(model);
    }
}

// Sides are smooth up to the crease angle, across the seam of the section too, and caps stay flat at any angle. The
// texture goes by the number of the point.
static void test_edges(void **state)
{
    (void)state;
#define PRISM "crossSection='1 1 1 -1 -1 -1 -1 1 1 1' "
    struct scene_model *const model = load_extrusion(PRISM "creaseAngle='3.2' spine='0 0 0 0 1 0 0 4 0'");
    const struct scene_mesh *const mesh = &model->meshes[0];
    assert_true(has_corner(mesh, (float[3]){1, 0, 1}, (float[3]){S, 0, S}, (float[2]){0, 0}));
    assert_true(has_corner(mesh, (float[3]){1, 0, 1}, (float[3]){S, 0, S}, (float[2]){1, 0}));
    assert_true(has_corner(mesh, (float[3]){1, 1, 1}, (float[3]){S, 0, S}, (float[2]){0, 0.5f}));
    assert_true(has_corner(mesh, (float[3]){1, 4, 1}, (float[3]){0, 1, 0}, (float[2]){1, 1}));
    assert_true(has_corner(mesh, (float[3]){1, 0, -1}, (float[3]){0, -1, 0}, (float[2]){1, 0}));
    assert_false(has_corner(mesh, (float[3]){1, 0, 1}, (float[3]){1, 0, 0}, NULL));
    scene_model_free(model);
    struct scene_model *const sharp = load_extrusion(PRISM "creaseAngle='1.5'");
    assert_true(has_corner(&sharp->meshes[0], (float[3]){1, 0, 1}, (float[3]){1, 0, 0}, NULL));
    assert_false(has_corner(&sharp->meshes[0], (float[3]){1, 0, 1}, (float[3]){S, 0, S}, NULL));
    scene_model_free(sharp);
    // Counted clockwise, all faces show the other side.
    struct scene_model *const inside = load_extrusion(PRISM "creaseAngle='3.2' ccw='false'");
    assert_true(has_corner(&inside->meshes[0], (float[3]){1, 0, 1}, (float[3]){-S, 0, -S}, (float[2]){0, 0}));
    assert_true(has_corner(&inside->meshes[0], (float[3]){1, 1, 1}, (float[3]){0, -1, 0}, (float[2]){1, 1}));
    scene_model_free(inside);
}

// A cap of a section that is bent inward has no more than its area, and its texture the section's larger size.
static void test_caps(void **state)
{
    (void)state;
    struct scene_model *const model =
        load_extrusion("crossSection='0 0 0 4 1 4 1 1 2 1 2 0' beginCap='false' spine='0 0 0 0 1 0'");
    const struct scene_mesh *const mesh = &model->meshes[0];
    double area = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const float *const a = mesh->positions[mesh->indices[i]],
                           *const b = mesh->positions[mesh->indices[i + 1]],
                           *const c = mesh->positions[mesh->indices[i + 2]];
        if (a[1] == 1 && b[1] == 1 && c[1] == 1) {
            area += 0.5 * fabs((double)((b[0] - a[0]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[0] - a[0])));
        }
    }
    assert_true(fabs(area - 5) < 1e-6);
    assert_int_equal(model->triangles_drawn, 10 + 4);
    assert_true(has_corner(mesh, (float[3]){1, 1, 4}, (float[3]){0, 1, 0}, (float[2]){0.25f, 1}));
    scene_model_free(model);
}

// What has no faces, or too many, is told, and the same one may be used again.
static void test_others(void **state)
{
    (void)state;
    static const char told[] = "extrusions without faces, or with very many (X3D): not drawn";
    static const char *const fields[] = {
        "spine='0 0 0'", "crossSection='1 1'", "spine='0 0 0 0 x 0'",
        "scale=''",      "orientation='1 0'",  "spine='0 0 0 0 1 0' scale='0 0'",
        "spine=''",
    };
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        write_format("o.x3d",
                     "<X3D><Scene><Shape><Extrusion %s/></Shape><Shape><Extrusion DEF='e'>"
                     "</Extrusion></Shape><Shape><Extrusion USE='e'/></Shape></Scene></X3D>",
                     fields[i]);
        struct scene_model *const model = load("o.x3d");
        assert_int_equal(model->triangles_drawn, 24);
        assert_int_equal(model->unsupported_count, 1);
        assert_true(is_unsupported(model, told));
        scene_model_free(model);
    }
    static char spine[1 << 13], text[1 << 15];
    for (size_t i = 0; i < 500; i++) {
        sprintf(spine + strlen(spine), "%zu %zu 0 ", i, i * i);
    }
    sprintf(text, "<X3D><Scene><Shape><Extrusion spine='%s' crossSection='%s'/></Shape></Scene></X3D>", spine,
            spine);
    struct scene_model *const large = load_text("l.x3d", text);
    assert_int_equal(large->triangles_drawn, 0);
    assert_true(is_unsupported(large, told));
    scene_model_free(large);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_usual_fields), cmocka_unit_test(test_planes), cmocka_unit_test(test_edges),
    cmocka_unit_test(test_caps),         cmocka_unit_test(test_others),
};

const struct unit_tests test_x3d_extrusion = UNIT_TESTS(tests, make_directory, remove_directory);
