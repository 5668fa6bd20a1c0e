// SPDX-License-Identifier: MIT
// PLY: colours of vertices, faces and edges in all numbers that files have them in, several textures, and what is told.
#include "model_files.h"

#include <stdio.h>
#include <string.h>

#define VERTICES     "property float x\nproperty float y\nproperty float z\n"
#define COLORS(type) "property " type " red\nproperty " type " green\nproperty " type " blue\n"
#define LIST         "property list uchar int vertex_indices\n"

static const float *color_at(const struct scene_model *model, uint32_t mesh, uint32_t corner)
{
    return model->meshes[mesh].colors[model->meshes[mesh].indices[corner]];
}

// Each triangle of a face has the colour of its face, sRGB decoded; 128 of 255 is 0.21586 linear.
static void test_face_colors(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "f.ply", "ply\nformat ascii 1.0\nelement vertex 5\n" VERTICES "element face 2\n" LIST COLORS(
                     "uchar") "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3 255 0 0\n"
                              "3 0 1 4 0 128 255\n");
    assert_int_equal(model->warning_count + model->unsupported_count, 0);
    for (uint32_t corner = 0; corner < 6; corner++) {
        assert_floats(color_at(model, 0, corner), (const float[]){1, 0, 0, 1}, 4, 0);
    }
    assert_floats(color_at(model, 0, 6), (const float[]){0, 0.2158605f, 1, 1}, 4, 1e-6f);
    const struct scene_material *material = &model->materials[model->meshes[0].material];
    assert_floats(material->base_color, (const float[]){1, 1, 1, 1}, 4, 0);
    assert_int_equal(material->alpha_mode, SCENE_ALPHA_OPAQUE);
    scene_model_free(model);
}

// Faces of a binary file, whose numbers have big ends, with an alpha, which makes them translucent.
static void test_binary_face_colors(void **state)
{
    (void)state;
    static const char head[] =
        "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty uchar x\n"
        "property uchar y\nproperty uchar z\nelement face 1\nproperty ushort red\n"
        "property ushort green\nproperty ushort blue\nproperty uchar alpha\n" LIST "end_header\n";
    static const unsigned char data[] = {0,  0, 0, 1, 0, 0, 0, 1, 0, 0xff, 0xff, 0, 0, 0x80, 0,
                                         51, 3, 0, 0, 0, 0, 0, 0, 0, 1,    0,    0, 0, 2};
    unsigned char bytes[512];
    memcpy(bytes, head, sizeof head - 1);
    memcpy(bytes + sizeof head - 1, data, sizeof data);
    write_bytes("b.ply", bytes, sizeof head - 1 + sizeof data);
    struct scene_model *model = load("b.ply");
    assert_floats(color_at(model, 0, 0), (const float[]){1, 0, 0.2140432f, 0.2f}, 4, 1e-5f);
    assert_int_equal(model->materials[model->meshes[0].material].alpha_mode, SCENE_ALPHA_BLEND);
    scene_model_free(model);
}

// Numbers from 0 to 255 that are no bytes, as some programs write them, and numbers from 0 to 1.
static void test_vertex_colors(void **state)
{
    (void)state;
    static const struct {
        const char *type, *color;
        float green;
    } cases[] = {
        {"float", "255 128 0", 0.2158605f},  {"int", "255 128 0", 0.2158605f},
        {"float", "1 0.5 0", 0.2140411f},    {"double", "1 0.5 0", 0.2140411f},
        {"ushort", "255 128 0", 0.2158605f}, {"ushort", "65535 32768 0", 0.2140551f},
        {"uchar", "255 1 0", 0.0003035f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *type = cases[i].type;
        write_format("v.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\n" VERTICES
                     "property %s red\nproperty %s green\n"
                     "property %s blue\nelement face 1\n" LIST "end_header\n"
                     "0 0 0 %s\n1 0 0 %s\n0 1 0 %s\n3 0 1 2\n",
                     type, type, type, cases[i].color, cases[i].color, cases[i].color);
        struct scene_model *model = load("v.ply");
        assert_floats(color_at(model, 0, 0), (const float[]){1, cases[i].green, 0, 1}, 4, 1e-5f);
        scene_model_free(model);
    }
}

// Where vertices have colours, those of faces are told. Edges have colours of their own.
static void test_all_colors(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\n" VERTICES COLORS("uchar") "element face 1\n" LIST COLORS(
            "uchar") "element edge 1\nproperty int vertex1\nproperty int vertex2\n" COLORS("uchar") //
        "element camera 1\nproperty float view_px\nend_header\n"
        "0 0 0 0 255 0\n1 0 0 0 255 0\n0 1 0 0 255 0\n3 0 1 2 255 0 0\n0 1 0 0 255\n7\n");
    assert_true(is_unsupported(model, "colours of faces (PLY): not drawn"));
    assert_true(is_unsupported(model, "element \"camera\" (PLY): not drawn"));
    assert_int_equal(model->meshes[0].primitive, SCENE_PRIMITIVE_LINES);
    assert_floats(color_at(model, 0, 0), (const float[]){0, 0, 1, 1}, 4, 0);
    assert_floats(color_at(model, 1, 0), (const float[]){0, 1, 0, 1}, 4, 0);
    scene_model_free(model);
}

// Faces choose among textures by number; −1 is none.
static void test_textures(void **state)
{
    (void)state;
    static const unsigned char texel[] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [18] = 0, 0, 255};
    write_bytes("one.tga", texel, sizeof texel);
    write_bytes("two.tga", texel, sizeof texel);
    struct scene_model *model = load_text(
        "t.ply", "ply\nformat ascii 1.0\ncomment TextureFile one.tga\ncomment TextureFile two.tga\n"
                 "element vertex 5\n" VERTICES "element face 3\n" LIST
                 "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n3 0 1 2 6 0 0 1 0 1 1 1\n3 0 1 3 6 0 0 1 0 1 1 0\n"
                 "3 0 1 4 0 -1\n");
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->mesh_count, 3);
    static const char *const names[] = {NULL, "one.tga", "two.tga"};
    static const float heights[] = {0, 1, 1}; // y of the third corner
    for (uint32_t i = 0; i < 3; i++) {
        const struct scene_mesh *mesh = &model->meshes[i];
        const int32_t image = model->materials[mesh->material].slots[SCENE_SLOT_BASE_COLOR].image;
        assert_true((image < 0) == (names[i] == NULL));
        assert_floats(&mesh->positions[mesh->indices[2]][1], &heights[i], 1, 0);
        if (image >= 0) {
            assert_string_equal(model->images[image].name, names[i]);
        }
    }
    scene_model_free(model);
}

// Corners of strips have the texture coordinates 0, 0 beside faces that have some.
static void test_strips_beside_texture_coordinates(void **state)
{
    (void)state;
    enum { CORNERS = 600 };
    static char text[400 + 2 * CORNERS];
    int length = snprintf(text, sizeof text,
                          "ply\nformat ascii 1.0\nelement vertex 4\n" VERTICES "element face 1\n" LIST
                          "property list uchar float texcoord\nelement tristrips 1\n"
                          "property list int int vertex_indices\nend_header\n"
                          "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 1 0 1 0 1 0\n%d",
                          CORNERS);
    for (int i = 0; i < CORNERS; i++) {
        length += snprintf(text + length, sizeof text - (size_t)length, " %d", i % 4);
    }
    snprintf(text + length, sizeof text - (size_t)length, "\n");
    struct scene_model *model = load_text("s.ply", text);
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_int_equal(mesh->index_count, 3 * (CORNERS - 1));
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        assert_floats(mesh->uvs[0][mesh->indices[i]], (const float[]){i < 3, i < 3}, 2, 0);
    }
    scene_model_free(model);
}

// Strips without alpha, or without colours, beside faces that have both, and the other way round.
static void test_faces_beside_strips(void **state)
{
    (void)state;
    static const char face[] = "element face 1\n" LIST, strip[] = "element tristrips 1\n"
                                                                  "property list int int vertex_indices\n";
    static const char colors[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    static const char alpha[] = "property uchar alpha\n";
    for (int i = 0; i < 4; i++) { // which of the two lacks, and whether colours too
        const bool is_face = i & 1, is_bare = i & 2;
        char text[1024];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 4\n" VERTICES "%s%s%s%s%s%send_header\n"
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2%s\n3 0 2 3%s\n",
                 face, is_face && is_bare ? "" : colors, is_face ? "" : alpha, strip,
                 !is_face && is_bare ? "" : colors, is_face ? alpha : "",
                 !is_face  ? " 255 0 0 51"
                 : is_bare ? ""
                           : " 255 0 0",
                 is_face   ? " 255 0 0 51"
                 : is_bare ? ""
                           : " 255 0 0");
        struct scene_model *model = load_text("mixed.ply", text);
        float found[2] = {0, 0};
        for (uint32_t m = 0; m < model->mesh_count; m++) {
            const struct scene_mesh *const mesh = &model->meshes[m];
            for (uint32_t k = 0; k < mesh->index_count; k += 3) {
                const bool is_first = mesh->positions[mesh->indices[k + 1]][1] < 0.5f;
                found[is_first ? 0 : 1] = mesh->colors[mesh->indices[k]][3];
            }
        }
        assert_floats(found, (const float[]){is_face ? 1 : 0.2f, is_face ? 0.2f : 1}, 2, 1e-6f);
        scene_model_free(model);
    }
}

// A byte order mark of UTF-8 before the first word.
static void test_mark(void **state)
{
    (void)state;
    static const char text[] =
        "\xef\xbb\xbfply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const char *const names[] = {"mark.ply", "mark"};
    for (int i = 0; i < 2; i++) {
        struct scene_model *model = load_text(names[i], text);
        assert_int_equal(model->triangles_drawn, 1);
        assert_int_equal(model->warning_count, 0);
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_mark),          cmocka_unit_test(test_strips_beside_texture_coordinates),
    cmocka_unit_test(test_face_colors),   cmocka_unit_test(test_binary_face_colors),
    cmocka_unit_test(test_vertex_colors), cmocka_unit_test(test_all_colors),
    cmocka_unit_test(test_textures),      cmocka_unit_test(test_faces_beside_strips),
};

const struct unit_tests test_ply = UNIT_TESTS(tests, make_directory, remove_directory);
