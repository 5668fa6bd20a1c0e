// SPDX-License-Identifier: MIT
// PLY: colours of vertices, faces and edges in all numbers that files have them in, several textures, and what is told.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
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

// Elements stand in the order of the header, which is free: faces may stand before the vertices that they refer to.
static void test_faces_before_vertices(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("o.ply", "ply\nformat ascii 1.0\nelement face 2\n" LIST "element vertex 4\n" VERTICES
                           "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
                           "3 0 1 2\n3 0 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 3\n");
    assert_int_equal(model->triangles_drawn, 2);
    assert_int_equal(model->mesh_count, 2);
    assert_int_equal(model->warning_count + model->unsupported_count, 0);
    scene_model_free(model);
    static const char head[] = "ply\nformat binary_little_endian 1.0\nelement face 1\n" LIST
                               "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
                               "end_header\n";
    static const unsigned char data[] = {3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    unsigned char bytes[512];
    memcpy(bytes, head, sizeof head - 1);
    memcpy(bytes + sizeof head - 1, data, sizeof data);
    write_bytes("o.ply", bytes, sizeof head - 1 + sizeof data);
    model = load("o.ply");
    assert_int_equal(model->triangles_drawn, 1);
    assert_floats(model->bounds_max, (const float[]){1, 1, 0}, 3, 0);
    scene_model_free(model);
    write_bytes("o.ply", bytes, sizeof head - 1 + 8);
    expect_refused("o.ply", "is truncated");
    write_text("o.ply", "ply\nformat ascii 1.0\nelement face 1\n" LIST "end_header\n3 0 1 2\n");
    expect_refused("o.ply", "has no vertices");
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

// A file with many textures is drawn with them. What is beyond the limit, and a number that no texture has, are told.
static void test_many_textures(void **state)
{
    (void)state;
    enum { LENGTH = 40000 };
    static const int counts[] = {70, 256, 300};
    for (int k = 0; k < 3; k++) {
        char *const text = calloc(LENGTH, 1);
        int at = snprintf(text, LENGTH, "ply\nformat ascii 1.0\n");
        for (int i = 0; i < counts[k]; i++) {
            at += snprintf(text + at, (size_t)(LENGTH - at), "comment TextureFile %d.tga\n", i);
        }
        at += snprintf(text + at, (size_t)(LENGTH - at),
                       "element vertex 3\n" VERTICES "element face %d\n" LIST
                       "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
                       "0 0 0\n1 0 0\n1 1 0\n",
                       counts[k] + 2);
        for (int i = -1; i <= counts[k]; i++) {
            at += snprintf(text + at, (size_t)(LENGTH - at), "3 0 1 2 6 0 0 1 0 0 1 %d\n", i);
        }
        struct scene_model *model = load_text("t.ply", text);
        const uint32_t there = counts[k] < 256 ? (uint32_t)counts[k] : 256;
        assert_int_equal(model->mesh_count, there + 1);
        assert_int_equal(model->image_count, there);
        assert_int_equal(model->meshes[0].index_count, 3 * ((uint32_t)counts[k] + 2 - there));
        assert_int_equal(model->meshes[there].vertex_count, 3);
        char beyond[96];
        snprintf(beyond, sizeof beyond, "textures of %u faces (PLY): the file has none of their numbers",
                 (unsigned)counts[k] + 1 - there);
        assert_int_equal(model->unsupported_count, counts[k] > 256 ? 2 : 1);
        assert_string_equal(model->unsupported[model->unsupported_count - 1], beyond);
        if (counts[k] > 256) {
            assert_string_equal(model->unsupported[0], "textures after the first 256 (PLY): not drawn");
        }
        scene_model_free(model);
        free(text);
    }
}

// The name of the model may stand for itself at the start of a texture's.
static void test_texture_named_by_model(void **state)
{
    (void)state;
    static const unsigned char texel[] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [18] = 0, 0, 255};
    static const char *const names[][2] = {{"<this>_A.tga", "t.b_A.tga"}, {"a_<this>.tga", "a_t.b.tga"}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        write_bytes(names[i][1], texel, sizeof texel);
        write_format("t.b.ply",
                     "ply\nformat ascii 1.0\ncomment TextureFile %s\nelement vertex 3\n" VERTICES
                     "property float s\nproperty float t\nelement face 1\n" LIST "end_header\n"
                     "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n3 0 1 2\n",
                     names[i][0]);
        struct scene_model *const model = load("t.b.ply");
        assert_int_equal(model->warning_count, 0);
        assert_string_equal(model->images[0].name, names[i][1]);
        scene_model_free(model);
    }
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
        float found[2] = {0, 0}, reds[2] = {0, 0};
        for (uint32_t m = 0; m < model->mesh_count; m++) {
            const struct scene_mesh *const mesh = &model->meshes[m];
            for (uint32_t k = 0; k < mesh->index_count; k += 3) {
                const bool is_first = mesh->positions[mesh->indices[k + 1]][1] < 0.5f;
                found[is_first ? 0 : 1] = mesh->colors[mesh->indices[k]][3];
                reds[is_first ? 0 : 1] = mesh->colors[mesh->indices[k]][0];
            }
        }
        assert_floats(found, (const float[]){is_face ? 1 : 0.2f, is_face ? 0.2f : 1}, 2, 1e-6f);
        const float grey = 0.4019778f; // 170 of 255 in sRGB, as light
        const float expected[] = {is_bare && is_face ? grey : 1, is_bare && !is_face ? grey : 1};
        assert_floats(reds, expected, 2, 1e-6f);
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

// A grid of triangles with two quads among them.
enum { SIDE = 5, GRID_POINTS = SIDE * SIDE, GRID_FACES = 2 * (SIDE - 1) * (SIDE - 1) - 2 };

// How a grid is written: types of its numbers, and what stands beside them.
struct grid_form {
    const char *coordinate, *count, *index;
    bool is_text, is_big, has_others;
};

static size_t put_number(char *out, const struct grid_form *form, const char *type, double number)
{
    if (form->is_text) {
        return (size_t)sprintf(out, "%g ", number);
    }
    unsigned char bytes[8] = {0};
    size_t size = 4;
    const float single = (float)number;
    const uint32_t whole = (uint32_t)(int32_t)number;
    memcpy(bytes, &whole, sizeof whole); // the bytes of shorter types stand first
    if (strcmp(type, "float") == 0) {
        memcpy(bytes, &single, sizeof single);
    } else if (strcmp(type, "double") == 0) {
        memcpy(bytes, &number, size = sizeof number);
    } else {
        size = strstr(type, "char") != NULL ? 1 : strstr(type, "short") != NULL ? 2 : 4;
    }
    for (size_t i = 0; i < size; i++) {
        out[i] = (char)bytes[form->is_big ? size - 1 - i : i];
    }
    return size;
}

static size_t put_face(char *out, const struct grid_form *form, const int *corners, int count)
{
    size_t size = put_number(out, form, form->count, count);
    for (int k = 0; k < count; k++) {
        size += put_number(out + size, form, form->index, corners[k]);
    }
    return size + (form->is_text ? (size_t)sprintf(out + size, "\n") : 0);
}

// Write the grid, whose last face has `last` for its last corner. Leave its last `cut` bytes out.
static void write_grid(const char *name, const struct grid_form *form, int last, size_t cut)
{
    char text[8192];
    size_t size = (size_t)sprintf(text, "ply\nformat %s 1.0\nelement vertex %d\n",
                                  form->is_text  ? "ascii"
                                  : form->is_big ? "binary_big_endian"
                                                 : "binary_little_endian",
                                  GRID_POINTS);
    const char *const others = form->has_others ? "property uchar q\nproperty float nx\nproperty double ny\n"
                                                  "property short nz\n"
                                                : "";
    size += (size_t)sprintf(text + size, "property %s x\nproperty %s y\nproperty %s z\n%selement face %d\n",
                            form->coordinate, form->coordinate, form->coordinate, others, GRID_FACES);
    size += (size_t)sprintf(text + size, "property list %s %s vertex_indices\nend_header\n", form->count,
                            form->index);
    for (int i = 0; i < GRID_POINTS; i++) {
        const double place[3] = {i % SIDE * 0.25, i / SIDE * -0.5, i * i % 7 * 0.125};
        for (int c = 0; c < 3; c++) {
            size += put_number(text + size, form, form->coordinate, place[c]);
        }
        if (form->has_others) {
            size += put_number(text + size, form, "uchar", 200);
            size += put_number(text + size, form, "float", i * 0.5);
            size += put_number(text + size, form, "double", 1.25);
            size += put_number(text + size, form, "short", -i);
        }
    }
    for (int cell = 0; cell < (SIDE - 1) * (SIDE - 1); cell++) {
        const int a = cell / (SIDE - 1) * SIDE + cell % (SIDE - 1),
                  quad[] = {a, a + 1, a + SIDE + 1, a + SIDE};
        const bool is_whole = cell == 5 || cell == 6, is_last = cell == (SIDE - 1) * (SIDE - 1) - 1;
        const int rest[] = {quad[0], quad[2], is_last ? last : quad[3]};
        size += put_face(text + size, form, quad, is_whole ? 4 : 3);
        size += is_whole ? 0 : put_face(text + size, form, rest, 3);
    }
    write_bytes(name, text, size - cut);
}

// Rows that are loaded from known places have the numbers that text has.
static void test_binary_rows(void **state)
{
    (void)state;
    static const char *const coordinates[] = {"float", "double"}, *const counts[] = {"uchar", "int"},
                             *const indices[] = {"int", "uint", "short"};
    const int good = GRID_POINTS - 2;
    for (int i = 0; i < 48; i++) {
        struct grid_form form = {coordinates[i % 2], counts[i / 2 % 2], indices[i / 4 % 3], true,
                                 i / 12 % 2 == 1,    i / 24 == 1};
        write_grid("text.ply", &form, good, 0);
        form.is_text = false;
        write_grid("binary.ply", &form, good, 0);
        struct scene_model *const text = load("text.ply");
        struct scene_model *const binary = load("binary.ply");
        assert_same_meshes(text, binary);
        scene_model_free(text);
        scene_model_free(binary);
    }
    const struct grid_form form = {"float", "uchar", "int", false, false, false};
    write_grid("beyond.ply", &form, GRID_POINTS, 0);
    expect_refused("beyond.ply", "face 29 refers to vertex 25 of 25");
    write_grid("below.ply", &form, -1, 0);
    expect_refused("below.ply", "face 29 refers to vertex -1 of 25");
    write_grid("cut.ply", &form, good, 1);
    expect_refused("cut.ply", "it ends in face 29 of 30");
    write_grid("short.ply", &form, good, GRID_FACES * 13 + 8 + 1);
    expect_refused("short.ply", "it ends in vertex 24 of 25");
    for (size_t left_out = 1; left_out < GRID_POINTS * 12 + GRID_FACES * 13;
         left_out += left_out < 40 ? 1 : 7) {
        write_grid("cut.ply", &form, good, left_out);
        expect_refused("cut.ply", "is truncated");
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_faces_before_vertices),
    cmocka_unit_test(test_mark),
    cmocka_unit_test(test_strips_beside_texture_coordinates),
    cmocka_unit_test(test_face_colors),
    cmocka_unit_test(test_binary_face_colors),
    cmocka_unit_test(test_binary_rows),
    cmocka_unit_test(test_vertex_colors),
    cmocka_unit_test(test_all_colors),
    cmocka_unit_test(test_textures),
    cmocka_unit_test(test_many_textures),
    cmocka_unit_test(test_texture_named_by_model),
    cmocka_unit_test(test_faces_beside_strips),
};

const struct unit_tests test_ply = UNIT_TESTS(tests, make_directory, remove_directory);
