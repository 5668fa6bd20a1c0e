// SPDX-License-Identifier: MIT
// OFF by Geomview's manual, as text in any layout and binary in either byte order, and as other programs write it.
#include "model_files.h"

#include <string.h>

#define SQUARE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
#define FACE   "4 0 1 2 3"

static const float *color_at(const struct scene_model *model, uint32_t corner)
{
    return model->meshes[0].colors[model->meshes[0].indices[corner]];
}

// Load a square that must have no warning, whose bounds are those of SQUARE.
static struct scene_model *load_square(const char *text)
{
    struct scene_model *model = load_text("s.off", text);
    if (model->warning_count + model->unsupported_count > 0) {
        fail_msg("%s", model->warning_count > 0 ? model->warnings[0] : model->unsupported[0]);
    }
    assert_string_equal(model->format, "Object File Format (OFF)");
    assert_int_equal(model->triangles_drawn, 2);
    assert_floats(model->bounds_min, (const float[]){0, 0, 0}, 3, 0);
    assert_floats(model->bounds_max, (const float[]){1, 1, 0}, 3, 0);
    return model;
}

// Any white space separates numbers, and comments begin anywhere. The keyword may lack, or stand before the counts without
// a blank, and the number of edges may lack where each vertex has a line.
static void test_layouts(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "OFF\n4 1 0\n" SQUARE FACE "\n",
        "OFF\r\n4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3",
        "# by hand\n\n  # twice\nOFF # a square\n4\n1 # faces\n\n0\n0 0 0#first\n1 0 0 1\n1 0 0 1 0\n4 "
        "0\n1\t2\n# almost\n3",
        "OFF 4 1 4 0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3",
        "OFF4 1 0\n" SQUARE FACE,
        "4 1 0\n" SQUARE FACE,
        "OFF\n4 1\n" SQUARE FACE,
        "off\n4 1 4\n" SQUARE FACE,
        "STOFF\n4 1 0\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n" FACE,
        "SOFF\n4 1 0\n" SQUARE FACE,
        "4OFF\n4 1 0\n0 0 0 1\n2 0 0 2\n-1 -1 0 -1\n0 1 0 1\n" FACE,
        "nOFF\n2\n4 1 0\n0 0\n1 0\n1 1\n0 1\n" FACE,
        "4nOFF 3 4 1 0\n1 0 0 0\n2 2 0 0\n1 1 1 0\n1 0 1 0\n" FACE,
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct scene_model *model = load_square(texts[i]);
        assert_null(model->meshes[0].colors);
        scene_model_free(model);
    }
}

// Colours of faces end with the line: whole numbers to 255, numbers with a point to 1, whole numbers to 1 where no larger
// one is. 0.5 is 0.21404 linear.
static void test_face_colors(void **state)
{
    (void)state;
    static const struct {
        const char *color;
        float expected[4];
    } cases[] = {
        {"255 0 0", {1, 0, 0, 1}},       {"255 0 0 # red", {1, 0, 0, 1}},
        {"1 0 0", {1, 0, 0, 1}},         {"0.5 0 1.0", {0.21404f, 0, 1, 1}},
        {"0 255 0 51", {0, 1, 0, 0.2f}}, {"0.0 1.0 0.0 0.2", {0, 1, 0, 0.2f}},
        {"0 255 0 1", {0, 1, 0, 1}},     {"255.0 0.0 0.0", {1, 0, 0, 1}},
        {"1e0 0 0", {1, 0, 0, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("c.off", "OFF\n4 1 0\n" SQUARE FACE " %s\n", cases[i].color);
        struct scene_model *model = load("c.off");
        const struct scene_material *material = &model->materials[model->meshes[0].material];
        assert_int_equal(model->warning_count + model->unsupported_count, 0);
        assert_floats(color_at(model, 0), cases[i].expected, 4, 1e-5f);
        assert_floats(color_at(model, 5), cases[i].expected, 4, 1e-5f);
        const bool clear = cases[i].expected[3] < 1;
        assert_int_equal(material->alpha_mode, clear ? SCENE_ALPHA_BLEND : SCENE_ALPHA_OPAQUE);
        scene_model_free(model);
    }
}

// Faces of one file with colours of either kind and without one: 0.666, which is 0.40109 linear. A 1 beside 255 is 1 of
// 255.
static void test_mixed_face_colors(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("m.off", "OFF\n4 4 0\n" SQUARE "3 0 1 2 255 0 0\n3 0 1 3 0.5 0.5 1.0\n"
                           "3 1 2 3\n3 0 2 3 1 1 0\n");
    assert_floats(color_at(model, 0), (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(color_at(model, 3), (const float[]){0.21404f, 0.21404f, 1, 1}, 4, 1e-5f);
    assert_floats(color_at(model, 6), (const float[]){0.40109f, 0.40109f, 0.40109f, 1}, 4, 1e-4f);
    assert_floats(color_at(model, 9), (const float[]){0.0003035f, 0.0003035f, 0, 1}, 4, 1e-6f);
    scene_model_free(model);
}

// Vertices with colours, by the keyword or by their lines alone.
static void test_vertex_colors(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "COFF\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n1 1 0 0 0 1 1\n0 1 0 1 1 0 1\n" FACE,
        "COFF\n4 1 0\n0 0 0 1 0 0 1 1 0 0 0 1 0\n1 1 1 0 0 0 1 1\n0 1 0 1 1 0 1\n" FACE,
        "COFF\n4 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 255 255 0\n" FACE,
        "COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 0 0 255 255\n0 1 0 255 255 0 255\n" FACE,
        "OFF\n4 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 255 255 0\n" FACE,
        "OFF\n4 1 0\n0 0 0 1.0 0 0 1\n1 0 0 0 1 0 1\n1 1 0 0 0 1 1\n0 1 0 1 1 0 1\n" FACE,
        "STCNOFF\n4 1 0\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0 0 0 1 0 1 0 1 0 0\n1 1 0 0 0 1 0 0 1 1 0 0\n"
        "0 1 0 0 0 1 1 1 0 1 0 0\n" FACE,
    };
    static const float expected[4][4] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 1}};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct scene_model *model = load_square(texts[i]);
        for (uint32_t v = 0; v < 6; v++) {
            const float *position = model->meshes[0].positions[model->meshes[0].indices[v]];
            const int corner = position[1] > 0 ? (position[0] > 0 ? 2 : 3) : position[0] > 0 ? 1 : 0;
            assert_floats(color_at(model, v), expected[corner], 4, 0);
        }
        scene_model_free(model);
    }
}

// Two vertices on a line of six numbers are no vertices with colours.
static void test_two_vertices_per_line(void **state)
{
    (void)state;
    scene_model_free(load_square("OFF\n4 1 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n" FACE));
    struct scene_model *model =
        load_text("p.off", "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n5 0 1 2 3 0\n5 3 2 1 0 3\n");
    assert_null(model->meshes[0].colors);
    scene_model_free(model);
}

static void test_normals(void **state)
{
    (void)state;
    struct scene_model *model =
        load_square("NOFF\n4 1 0\n0 0 0 0 3 4\n1 0 0 0 3 4\n1 1 0 0 3 4\n0 1 0 0 3 4\n" FACE);
    assert_floats(model->meshes[0].normals[0], (const float[]){0, 0.6f, 0.8f}, 3, 1e-6f);
    scene_model_free(model);
    model = load_text("n.off", "OFF\n3 1 0\n0 0 0 0 -0.6 0.8\n1 0 0 0 -.6 .8\n0 1 0 0 -.6 .8\n3 0 1 2\n");
    assert_true(has_warning(model, "taken for normals"));
    assert_floats(model->meshes[0].normals[0], (const float[]){0, -0.6f, 0.8f}, 3, 1e-6f);
    assert_null(model->meshes[0].colors);
    scene_model_free(model);
}

// What is not drawn is told.
static void test_told(void **state)
{
    (void)state;
    static const struct {
        const char *text, *line;
    } cases[] = {
        {"OFF\n4 1 0\n" SQUARE FACE " 7\n", "by their number in Geomview's map: not drawn"},
        {"nOFF 5\n4 1 0\n0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n" FACE,
         "dimensions after the third: not drawn"},
        {"COFF\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1 0 1 0 0 1\n0 1 0 1 0 0 1\n" FACE " 0 0 255\n",
         "colours of faces (OFF): not drawn"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_text("t.off", cases[i].text);
        assert_true(is_unsupported(model, cases[i].line));
        scene_model_free(model);
    }
    struct scene_model *model = load_text("t.off", "OFF\n4 2 0\n" SQUARE FACE " 1 2\n0\n9\n");
    assert_true(has_warning(model, "neither 3 nor 4 numbers are ignored"));
    assert_true(has_warning(model, "1 faces without corners are left out"));
    assert_true(has_warning(model, "what follows its last face is ignored"));
    scene_model_free(model);
    model = load_text("t.off", "OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n");
    assert_true(has_warning(model, "1 numbers after each vertex"));
    scene_model_free(model);
}

// Faces of two corners and of one are a line and a point; vertices alone are points.
static void test_lines_and_points(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("l.off", "OFF\n4 3 0\n" SQUARE "3 0 1 2 1 0 0\n2 2 3 0 1 0\n1 1 0 0 1\n");
    assert_int_equal(model->instance_count, 3);
    assert_int_equal(model->meshes[1].primitive, SCENE_PRIMITIVE_LINES);
    assert_floats(model->meshes[1].colors[0], (const float[]){0, 1, 0, 1}, 4, 0);
    assert_int_equal(model->meshes[2].primitive, SCENE_PRIMITIVE_POINTS);
    assert_floats(model->meshes[2].colors[0], (const float[]){0, 0, 1, 1}, 4, 0);
    scene_model_free(model);
    model = load_text("l.off", "OFF 4 0 0\n" SQUARE);
    assert_int_equal(model->meshes[0].primitive, SCENE_PRIMITIVE_POINTS);
    assert_int_equal(model->meshes[0].index_count, 4);
    scene_model_free(model);
}

static size_t put(unsigned char *bytes, size_t size, const void *value, bool big)
{
    unsigned char word[4];
    memcpy(word, value, 4);
    for (size_t i = 0; i < 4; i++) {
        bytes[size + i] = word[big ? 3 - i : i]; // for a machine with little ends
    }
    return size + 4;
}

// Geomview's binary files have big ends and count the numbers of colours. Other programs' have neither.
static void test_binary(void **state)
{
    (void)state;
    static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, red[4] = {1, 0, 0, 1};
    static const uint32_t counts[3] = {4, 1, 0}, face[6] = {4, 0, 1, 2, 3, 4};
    for (int way = 0; way < 4; way++) {
        const bool big = way % 2 == 0, counted = way < 2;
        unsigned char bytes[256] = "OFF BINARY\n";
        size_t size = 11;
        for (size_t i = 0; i < 3; i++) {
            size = put(bytes, size, &counts[i], big);
        }
        for (size_t i = 0; i < 12; i++) {
            size = put(bytes, size, &corners[i / 3][i % 3], big);
        }
        for (size_t i = 0; i < (counted ? 6 : 5); i++) {
            size = put(bytes, size, &face[i], big);
        }
        for (size_t i = 0; i < 4 && counted; i++) {
            size = put(bytes, size, &red[i], big);
        }
        write_bytes("b.off", bytes, size);
        struct scene_model *model = load("b.off");
        assert_int_equal(model->warning_count, 0);
        assert_int_equal(model->triangles_drawn, 2);
        assert_floats(model->bounds_max, (const float[]){1, 1, 0}, 3, 0);
        if (counted) {
            assert_floats(color_at(model, 0), red, 4, 0);
        }
        scene_model_free(model);
        if (way == 0) {
            write_bytes("b.off", bytes, size - 4);
            expect_refused("b.off", "face 1 of 1 is cut: the file ends there");
        }
    }
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *cause;
    } cases[] = {
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "face 1 of 1 is cut: the file ends there"},
        {"OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 ", "is cut: 4 vertices and 1 faces do not fit into it"},
        {"OFF\n400 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "is cut: 400 vertices and 1 faces do not fit into it"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3", "face 1 of 1 refers to vertex 3; it has 3, from 0 on"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -2",
         "face 1 of 1 has -2 where a whole number from 0 on must be"},
        {"OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2", "line 4: \"zero\" is not a number"},
        {"OFF\n0 0 0\n", "is no OFF model: it has no vertices"},
        {"appearance { +edge }\nOFF\n0 0 0\n", "is no OFF model: it begins with \"appearance\""},
        {"nOFF 0\n3 1 0\n", "has vertices of 0 dimensions; 1 to 64 can be read"},
        {"OFF\n-3 1 0\n", "its head has -3 where a whole number from 0 on must be"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_text("r.off", cases[i].text);
        expect_refused("r.off", cases[i].cause);
    }
}

// A file without an ending is told by its keyword.
static void test_kind(void **state)
{
    (void)state;
    struct scene_model *model = load_text("nameless", "# by hand\nCNOFF 1 0 0 0 0 0 0 0 1 1 0 0 1");
    assert_string_equal(model->format, "Object File Format (OFF)");
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_layouts),
    cmocka_unit_test(test_face_colors),
    cmocka_unit_test(test_mixed_face_colors),
    cmocka_unit_test(test_vertex_colors),
    cmocka_unit_test(test_two_vertices_per_line),
    cmocka_unit_test(test_normals),
    cmocka_unit_test(test_told),
    cmocka_unit_test(test_lines_and_points),
    cmocka_unit_test(test_binary),
    cmocka_unit_test(test_refused),
    cmocka_unit_test(test_kind),
};

const struct unit_tests test_off = UNIT_TESTS(tests, make_directory, remove_directory);
