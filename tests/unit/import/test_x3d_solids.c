// SPDX-License-Identifier: MIT
// Boxes, spheres, cones and cylinders of an X3D, and the texture that its standard lays on them.
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEXTURED "<Appearance><ImageTexture url='\"a.ppm\"'/></Appearance>"

// A corner: where it is, its normal, and its place in the texture.
struct corner {
    float values[8];
};

static bool has_corner(const struct scene_mesh *mesh, const struct corner *corner)
{
    bool found = false;
    for (uint32_t i = 0; i < mesh->index_count && !found; i++) {
        const uint32_t vertex = mesh->indices[i];
        const float *const p = mesh->positions[vertex], *const n = mesh->normals[vertex],
                           *const uv = mesh->uvs[0][vertex];
        // Textures of a model run downward.
        const float values[8] = {p[0], p[1], p[2], n[0], n[1], n[2], uv[0], 1 - uv[1]};
        float most = 0;
        for (int c = 0; c < 8; c++) {
            most = fmaxf(most, fabsf(values[c] - corner->values[c]));
        }
        found = most < 1e-5f;
    }
    return found;
}

static void test_textures(void **state)
{
    (void)state;
    static const struct {
        const char *solid;
        unsigned triangles;
        struct corner corners[7];
    } cases[] = {
        {"<Box size='2 4 6'/>",
         12,
         {{{-1, -2, 3, 0, 0, 1, 0, 0}},
          {{1, 2, -3, 0, 0, -1, 0, 1}},
          {{1, 2, 3, 1, 0, 0, 0, 1}},
          {{-1, -2, 3, -1, 0, 0, 1, 0}},
          {{-1, 2, -3, 0, 1, 0, 0, 1}},
          {{1, -2, 3, 0, -1, 0, 1, 1}},
          {{1, -2, -3, 0, -1, 0, 1, 0}}}},
        {"<Sphere radius='2'/>",
         2 * 48 * 23,
         {{{0, 0, 2, 0, 0, 1, 0.5f, 0.5f}},
          {{2, 0, 0, 1, 0, 0, 0.75f, 0.5f}},
          {{-2, 0, 0, -1, 0, 0, 0.25f, 0.5f}},
          {{0, 0, -2, 0, 0, -1, 0, 0.5f}},
          {{0, 0, -2, 0, 0, -1, 1, 0.5f}},
          {{0, 2, 0, 0, 1, 0, 0.5f, 1}},
          {{0, -1.414214f, 1.414214f, 0, -0.707107f, 0.707107f, 0.5f, 0.25f}}}},
        {"<Cylinder radius='2' height='6'></Cylinder>",
         4 * 48 - 4,
         {{{0, 3, 2, 0, 0, 1, 0.5f, 1}},
          {{2, -3, 0, 1, 0, 0, 0.75f, 0}},
          {{0, 3, -2, 0, 0, -1, 1, 1}},
          {{0, 3, -2, 0, 1, 0, 0.5f, 1}},
          {{2, 3, 0, 0, 1, 0, 1, 0.5f}},
          {{0, -3, 2, 0, -1, 0, 0.5f, 1}},
          {{2, -3, 0, 0, -1, 0, 1, 0.5f}}}},
        {"<Cone bottomRadius='3' height='4'/>",
         2 * 48 - 2,
         {{{0, -2, 3, 0, 0.6f, 0.8f, 0.5f, 0}},
          {{3, -2, 0, 0.8f, 0.6f, 0, 0.75f, 0}},
          {{0, 2, 0, 0.8f, 0.6f, 0, 0.75f, 1}},
          {{0, -2, -3, 0, 0.6f, -0.8f, 1, 0}},
          {{0, -2, 3, 0, -1, 0, 0.5f, 1}},
          {{-3, -2, 0, 0, -1, 0, 0, 0.5f}},
          {{0, -2, -3, 0, -1, 0, 0.5f, 0}}}},
    };
    static const struct {
        const char *solid;
        unsigned triangles;
        struct corner corners[4];
    } flat[] = {
        {"<Rectangle2D size='4 2'/>",
         2,
         {{{-2, -1, 0, 0, 0, 1, 0, 0}},
          {{2, -1, 0, 0, 0, 1, 1, 0}},
          {{2, 1, 0, 0, 0, 1, 1, 1}},
          {{-2, 1, 0, 0, 0, 1, 0, 1}}}},
        {"<Disk2D outerRadius='2'/>",
         46,
         {{{0, 2, 0, 0, 0, 1, 0.5f, 1}},
          {{-2, 0, 0, 0, 0, 1, 0, 0.5f}},
          {{0, -2, 0, 0, 0, 1, 0.5f, 0}},
          {{2, 0, 0, 0, 0, 1, 1, 0.5f}}}},
        {"<Disk2D outerRadius='2' innerRadius='1'></Disk2D>",
         96,
         {{{0, 2, 0, 0, 0, 1, 0.5f, 1}},
          {{-1, 0, 0, 0, 0, 1, 0.25f, 0.5f}},
          {{0, -1, 0, 0, 0, 1, 0.5f, 0.25f}},
          {{2, 0, 0, 0, 0, 1, 1, 0.5f}}}},
    };
    write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("s.x3d", "<X3D><Scene><Shape>" TEXTURED "%s</Shape></Scene></X3D>", cases[i].solid);
        struct scene_model *const model = load("s.x3d");
        assert_int_equal(model->unsupported_count + model->warning_count, 0);
        assert_int_equal(model->mesh_count, 1);
        assert_int_equal(model->triangles_drawn, cases[i].triangles);
        for (size_t k = 0; k < 7; k++) {
            if (!has_corner(&model->meshes[0], &cases[i].corners[k])) {
                fail_msg("case %zu: corner %zu is not there", i, k);
            }
        }
        scene_model_free(model);
    }
    for (size_t i = 0; i < sizeof flat / sizeof flat[0]; i++) {
        write_format("f.x3d", "<X3D><Scene><Shape>" TEXTURED "%s</Shape></Scene></X3D>", flat[i].solid);
        struct scene_model *const model = load("f.x3d");
        assert_int_equal(model->unsupported_count + model->warning_count, 0);
        assert_int_equal(model->triangles_drawn, flat[i].triangles);
        for (size_t k = 0; k < 4; k++) {
            if (!has_corner(&model->meshes[0], &flat[i].corners[k])) {
                fail_msg("flat case %zu: corner %zu is not there", i, k);
            }
        }
        scene_model_free(model);
    }
}

// Solids have the parts that they are given. A cone stands on its disk, and without a texture assimp makes the others,
// also where one with a texture is used again.
static void test_parts(void **state)
{
    (void)state;
    static const char told[] = "solids, rectangles and disks without faces (X3D): not drawn";
    static const struct {
        const char *shape;
        unsigned triangles;
        float lowest, highest;
        bool is_told;
    } cases[] = {
        {"<Shape><Cone bottom='false'/></Shape>", 48, -1, 1, false},
        {"<Shape><Cone/></Shape>", 48 + 46, -1, 1, false},
        {"<Shape>" TEXTURED "<Cone side='false'/></Shape>", 46, -1, -1, false},
        {"<Shape><Cone side='false' height='3'/></Shape>", 46, -1.5f, -1.5f, false},
        {"<Shape>" TEXTURED "<Cylinder side='false' bottom='false'/></Shape>", 46, 1, 1, false},
        {"<Shape><Cylinder top='false'/>" TEXTURED "</Shape>", 96 + 46, -1, 1, false},
        {"<Shape>" TEXTURED "<Sphere DEF='s'/></Shape><Shape><Sphere USE='s'/></Shape>", 2208 + 1280, -1, 1,
         false},
        {"<Shape><Box DEF='s'/></Shape><Shape>" TEXTURED "<Box USE='s'/></Shape>", 24, -1, 1, false},
        {"<Shape><Disk2D/></Shape>", 46, -1, 1, false},
        {"<Shape><Sphere/></Shape><Shape><Disk2D outerRadius='2' innerRadius='2'/></Shape>", 1280, -1, 1,
         true},
        {"<Shape><Sphere/></Shape><Shape><Cone radius='0' bottomRadius='0'/></Shape>", 1280, -1, 1, true},
        {"<Shape><Sphere/></Shape><Shape><Cone side='false' bottom='false'/></Shape>", 1280, -1, 1, true},
        {"<Shape><Sphere/></Shape><Shape>" TEXTURED "<Box size='2 2'/></Shape>", 1280, -1, 1, true},
        {"<Shape><Sphere/></Shape><Shape>" TEXTURED "<Sphere radius='-1'/></Shape>", 1280, -1, 1, true},
    };
    write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("p.x3d", "<X3D><Scene>%s</Scene></X3D>", cases[i].shape);
        struct scene_model *const model = load("p.x3d");
        if (model->triangles_drawn != cases[i].triangles || model->unsupported_count != cases[i].is_told ||
            (cases[i].is_told && !is_unsupported(model, told)) ||
            fabsf(model->bounds_min[1] - cases[i].lowest) > 1e-5f ||
            fabsf(model->bounds_max[1] - cases[i].highest) > 1e-5f) {
            fail_msg("case %zu: %u triangles from %g to %g, %s", i, (unsigned)model->triangles_drawn,
                     (double)model->bounds_min[1], (double)model->bounds_max[1],
                     model->unsupported_count > 0 ? model->unsupported[0] : "");
        }
        scene_model_free(model);
    }
}

// A cone without a texture is round, and its disk is flat.
static void test_plain_cone(void **state)
{
    (void)state;
    struct scene_model *const model =
        load_text("c.x3d", "<X3D><Scene><Shape><Cone bottomRadius='3' height='4'/></Shape></Scene></X3D>");
    const struct scene_mesh *const mesh = &model->meshes[0];
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const float *const p = mesh->positions[mesh->indices[i]], *const n = mesh->normals[mesh->indices[i]];
        const float outward = (p[0] * n[0] + p[2] * n[2]) / 3;
        assert_true(n[1] == -1 || p[1] == 2 || (fabsf(outward - 0.8f) < 0.01f && fabsf(n[1] - 0.6f) < 0.01f));
    }
    assert_true(model->unsupported_count == 0);
    scene_model_free(model);
}

// Solids after very many are drawn as assimp makes them, and those of which assimp makes nothing are told as too many.
static void test_many(void **state)
{
    (void)state;
    enum { SPHERES = 600 };
    static const char sphere[] = "<Shape>" TEXTURED "<Sphere/></Shape>";
    char *const shapes = malloc(SPHERES * strlen(sphere) + 1), *end = shapes;
    assert_non_null(shapes);
    for (int i = 0; i < SPHERES; i++) {
        end += sprintf(end, "%s", sphere);
    }
    write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
    write_format("m.x3d",
                 "<X3D><Scene>%s<Shape><Cone/></Shape><Shape><Disk2D/></Shape><Shape><Extrusion/></Shape>"
                 "</Scene></X3D>",
                 shapes);
    free(shapes);
    struct scene_model *const model = load("m.x3d");
    assert_int_equal(model->instance_count, SPHERES + 2);
    assert_true(model->triangles_drawn > 520 * 2208 && model->triangles_drawn < 550 * 2208 + 50 * 1280);
    assert_true(is_unsupported(model, "solids, rectangles and disks after very many (X3D): textures drawn "
                                      "otherwise, cones upside down, disks with ten corners"));
    assert_true(is_unsupported(model, "grids and extrusions after very large ones (X3D): not drawn"));
    assert_int_equal(model->unsupported_count + model->warning_count, 2);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_textures),
    cmocka_unit_test(test_parts),
    cmocka_unit_test(test_plain_cone),
    cmocka_unit_test(test_many),
};

const struct unit_tests test_x3d_solids = UNIT_TESTS(tests, make_directory, remove_directory);
