// SPDX-License-Identifier: MIT
// STL: both conventions for colours of facets, text and binary told apart, and files that are cut.
#include "model_files.h"

#include <stdio.h>
#include <string.h>

enum { HEADER = 84, FACET = 50 };

// A binary file with `count` facets, the k-th one up at z = k, that says it has `said`; words: what follows each.
static size_t make_binary(unsigned char *bytes, const char *head, uint32_t said, int count,
                          const uint16_t *words)
{
    memset(bytes, 0, HEADER + (size_t)count * FACET);
    memcpy(bytes, head, strlen(head));
    memcpy(bytes + 80, &said, 4);
    for (int i = 0; i < count; i++) {
        const float z = (float)i;
        const float values[12] = {0, 0, 1, 0, 0, z, 1, 0, z, 0, 1, z};
        memcpy(bytes + HEADER + i * FACET, values, sizeof values);
        memcpy(bytes + HEADER + i * FACET + 48, &words[i], 2);
    }
    return HEADER + (size_t)count * FACET;
}

static unsigned char bytes[1024];

// The colour of facet `facet`.
static const float *color_of(const struct scene_model *model, uint32_t facet)
{
    const struct scene_mesh *mesh = &model->meshes[0];
    return mesh->colors[mesh->indices[3 * facet]];
}

// Red from bit 10 on, where the highest bit says so; 16 of 31 is 0.229275 linear.
static void test_viscam(void **state)
{
    (void)state;
    const uint16_t words[] = {0x8000 | 31 << 10, 0x8000 | 16, 31 << 10};
    write_bytes("x.stl", bytes, make_binary(bytes, "solid binary", 3, 3, words));
    struct scene_model *model = load("x.stl");
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->triangles_drawn, 3);
    assert_int_equal(model->up, SCENE_AXIS_Z);
    assert_floats(color_of(model, 0), (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(color_of(model, 1), (const float[]){0, 0, 0.229275f, 1}, 4, 1e-6f);
    assert_floats(color_of(model, 2), (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    assert_floats(model->meshes[0].normals[0], (const float[]){0, 0, 1}, 3, 0);
    const uint32_t last = model->meshes[0].indices[8];
    assert_floats(model->meshes[0].positions[last], (const float[]){0, 1, 2}, 3, 0);
    scene_model_free(model);
}

// Red from bit 0 on, where the highest bit does not say that the colour of the head is meant.
static void test_magics(void **state)
{
    (void)state;
    const uint16_t words[] = {31, 31 << 10, 0x8000 | 31};
    const char head[] = "COLOR=\x80\xff\x01\xff";
    write_bytes("x.stl", bytes, make_binary(bytes, head, 3, 3, words));
    struct scene_model *model = load("x.stl");
    assert_floats(color_of(model, 0), (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(color_of(model, 1), (const float[]){0, 0, 1, 1}, 4, 0);
    assert_floats(color_of(model, 2), (const float[]){0.2158605f, 1, 0.000303527f, 1}, 4, 1e-6f);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
    const char rich[] = "COLOR=\x80\xff\x01\x80,MATERIAL=\x80\xff\x01\xff";
    write_bytes("x.stl", bytes, make_binary(bytes, rich, 3, 3, words));
    model = load("x.stl");
    assert_true(is_unsupported(model, "the material in its head"));
    assert_true(is_unsupported(model, "the translucency in its head"));
    scene_model_free(model);
}

// Words of 0 behind the head of Magics are no black facets. Their colour is that of the head.
static void test_magics_without_words(void **state)
{
    (void)state;
    const uint16_t words[] = {0, 0};
    write_bytes("x.stl", bytes, make_binary(bytes, "COLOR=\x80\xff\x01\xff", 2, 2, words));
    struct scene_model *model = load("x.stl");
    assert_floats(color_of(model, 0), (const float[]){0.2158605f, 1, 0.000303527f, 1}, 4, 1e-6f);
    assert_floats(color_of(model, 1), (const float[]){0.2158605f, 1, 0.000303527f, 1}, 4, 1e-6f);
    scene_model_free(model);
}

// MeshLab's head is that of every file, whether it has colours or not; facets with a colour have the highest bit.
static void test_meshlab(void **state)
{
    (void)state;
    const char head[] = "COLOR=\x7f\x7f\x7f MATERIAL=\x7f\x7f\x7f \x7f\x7f\x7f \x7f\x7f\x7f     ";
    const uint16_t none[] = {0, 0};
    write_bytes("x.stl", bytes, make_binary(bytes, head, 2, 2, none));
    struct scene_model *model = load("x.stl");
    assert_null(model->meshes[0].colors);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
    const uint16_t words[] = {0x8000 | 31, 0x8000 | 31 << 10, 0};
    write_bytes("x.stl", bytes, make_binary(bytes, head, 3, 3, words));
    model = load("x.stl");
    assert_floats(color_of(model, 0), (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(color_of(model, 1), (const float[]){0, 0, 1, 1}, 4, 0);
    assert_floats(color_of(model, 2), (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
}

// Words without the highest bit are anything, so there are no colours.
static void test_no_colors(void **state)
{
    (void)state;
    const uint16_t words[] = {31, 7};
    write_bytes("x.stl", bytes, make_binary(bytes, "", 2, 2, words));
    struct scene_model *model = load("x.stl");
    assert_null(model->meshes[0].colors);
    assert_int_equal(model->unsupported_count, 1);
    assert_true(is_unsupported(model, "attributes of facets that are no colours (STL): not drawn"));
    scene_model_free(model);
}

// Facets of which one has a normal are flat, whichever it is. Without any they are smooth over their edge, which is not
// sharp.
static void test_normals_of_binary(void **state)
{
    (void)state;
    enum { COUNT = 2 };
    const float corners[COUNT][9] = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0.25f, 0, 1, 0}};
    const float normals[COUNT][3] = {{0, 0, 1}, {-0.2357f, -0.2357f, 0.9428f}};
    for (int given = 0; given <= COUNT; given++) { // the facet that has its normal, or none
        memset(bytes, 0, HEADER + COUNT * FACET);
        bytes[80] = COUNT;
        for (int i = 0; i < COUNT; i++) {
            unsigned char *const facet = bytes + HEADER + i * FACET;
            memcpy(facet + 12, corners[i], sizeof corners[i]);
            if (i == given) {
                memcpy(facet, normals[i], sizeof normals[i]);
            }
        }
        write_bytes("x.stl", bytes, HEADER + COUNT * FACET);
        struct scene_model *const model = load("x.stl");
        const struct scene_mesh *const mesh = &model->meshes[0];
        assert_int_equal(mesh->vertex_count, given < COUNT ? 6 : 4);
        for (uint32_t k = 0; k < 6 && given < COUNT; k++) {
            assert_floats(mesh->normals[mesh->indices[k]], normals[k / 3], 3, 1e-3f);
        }
        scene_model_free(model);
    }
    for (size_t size = 1; size < HEADER + COUNT * FACET; size++) {
        write_bytes("x.stl", bytes, size);
        expect_refused("x.stl", "is cut");
    }
}

static void test_counts(void **state)
{
    (void)state;
    const uint16_t words[4] = {0};
    size_t size = make_binary(bytes, "", 40, 4, words);
    write_bytes("x.stl", bytes, size);
    expect_refused("x.stl", "is cut: it ends after 4 of 40 facets");
    write_bytes("x.stl", bytes, size - 1);
    expect_refused("x.stl", "is cut: it ends after 3 of 40 facets");
    write_bytes("x.stl", bytes, 83);
    expect_refused("x.stl", "is cut: it has 83 bytes, and the head of a binary STL has 84");

    // A writer that cannot go back leaves the count at 0 or at −1.
    const char *const unsaid[] = {"0", "4294967295"};
    for (int i = 0; i < 2; i++) {
        write_bytes("x.stl", bytes, make_binary(bytes, "", i == 0 ? 0 : UINT32_MAX, 4, words));
        struct scene_model *const model = load("x.stl");
        char warning[80];
        snprintf(warning, sizeof warning, "says that it has %s facets; the 4 that it has are drawn",
                 unsaid[i]);
        assert_int_equal(model->triangles_drawn, 4);
        assert_true(has_warning(model, warning));
        scene_model_free(model);
    }

    write_bytes("x.stl", bytes, make_binary(bytes, "", 3, 4, words));
    struct scene_model *const model = load("x.stl");
    assert_int_equal(model->triangles_drawn, 3);
    assert_true(has_warning(model, "50 bytes after its last facet are ignored"));
    scene_model_free(model);
}

#define FACET_TEXT "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"

static void test_text(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("x.stl", " # by hand\n# twice\n SOLID one thing # so called\n" FACET_TEXT
                           "endloop\nendfacet\nendsolid\nsolid empty\nendsolid empty\n"
                           "solid two\n" FACET_TEXT "vertex 0 0.5 0\nendloop\nendfacet\nendsolid two\n");
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->instance_count, 2);
    assert_string_equal(model->instances[0].name, "one thing");
    assert_string_equal(model->instances[1].name, "two");
    assert_int_equal(model->instances[1].object, 2);
    assert_int_equal(model->triangles_drawn, 3); // the last facet has four corners
    scene_model_free(model);
}

// One facet without a normal, as those without an area have none, leaves the others flat: two that meet at an angle which would be smooth.
static void test_one_lacks_a_normal(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "x.stl",
        "solid\n" FACET_TEXT "endloop\nendfacet\nfacet normal 0 -0.6 0.8\nouter loop\nvertex 0 0 0\n"
        "vertex 0 -0.8 -0.6\nvertex 1 0 0\nendloop\nendfacet\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n"
        "vertex 1 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n");
    const struct scene_mesh *mesh = &model->meshes[0];
    for (uint32_t k = 0; k < 3; k++) {
        assert_floats(mesh->normals[mesh->indices[k]], (const float[]){0, 0, 1}, 3, 0);
        assert_floats(mesh->normals[mesh->indices[3 + k]], (const float[]){0, -0.6f, 0.8f}, 3, 1e-6f);
    }
    scene_model_free(model);
}

// Normals that are none are made from the corners.
static void test_odd_normals(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("x.stl", "solid\n" FACET_TEXT
                           "endloop\nendfacet\nfacet normal +inf -inf odd\nouter loop\nvertex 0 0 5\n"
                           "vertex 0 1 5\nvertex 1 0 5\nendloop\nendfacet\nendsolid\n");
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_int_equal(model->warning_count, 0);
    assert_floats(mesh->normals[mesh->indices[0]], (const float[]){0, 0, 1}, 3, 1e-6f);
    assert_floats(mesh->normals[mesh->indices[3]], (const float[]){0, 0, -1}, 3, 1e-6f);
    scene_model_free(model);
}

// A surface is shaded by the side that is seen, and corners say which that is: a normal on the other side is turned.
static void test_normals_that_oppose_corners(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("x.stl", "solid\n" FACET_TEXT "endloop\nendfacet\nfacet normal 0 0 -1\nouter loop\n"
                           "vertex 0 0 5\nvertex 1 0 5\nvertex 0 1 5\nendloop\nendfacet\n"
                           "endsolid\n");
    const struct scene_mesh *mesh = &model->meshes[0];
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (uint32_t k = 0; k < 6; k++) {
        const float place[3] = {corners[k % 3][0], corners[k % 3][1], k < 3 ? 0 : 5};
        assert_floats(mesh->positions[mesh->indices[k]], place, 3, 0);
        assert_floats(mesh->normals[mesh->indices[k]], (const float[]){0, 0, 1}, 3, 0);
    }
    scene_model_free(model);
}

// Byte order marks before "solid": of UTF-8, once or twice, and of UTF-16 in both orders.
static void test_marks(void **state)
{
    (void)state;
    static const char text[] = "solid a\n" FACET_TEXT "endloop\nendfacet\nendsolid\n";
    static const char *const names[] = {"x.stl", "nameless"};
    for (int i = 0; i < 4; i++) {
        size_t size = 0;
        if (i < 2) {
            size = (size_t)sprintf((char *)bytes, "\xef\xbb\xbf%s%s", i == 0 ? "" : "\xef\xbb\xbf", text);
        } else {
            memcpy(bytes, i == 2 ? "\xff\xfe" : "\xfe\xff", 2);
            memset(bytes + 2, 0, 2 * sizeof text);
            for (size = 2; size / 2 - 1 < strlen(text); size += 2) {
                bytes[size + (i == 3)] = (unsigned char)text[size / 2 - 1];
            }
        }
        write_bytes(names[i == 1], bytes, size);
        struct scene_model *model = load(names[i == 1]);
        assert_int_equal(model->warning_count, 0);
        assert_int_equal(model->triangles_drawn, 1);
        assert_string_equal(model->instances[0].name, "a");
        scene_model_free(model);
    }
}

// Lines of other words before "solid", and a head that has such lines and belongs to a binary file.
static void test_lines_before(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("x.stl", "+\n solid BALL  \n" FACET_TEXT "endloop\nendfacet\nendsolid\n");
    assert_int_equal(model->triangles_drawn, 1);
    assert_true(is_unsupported(model, "\"+\" has no meaning (STL): its lines are left out"));
    scene_model_free(model);
    const uint16_t words[] = {0, 0, 0};
    write_bytes("x.stl", bytes, make_binary(bytes, "made by\nsolid", 3, 3, words));
    model = load("x.stl");
    assert_int_equal(model->triangles_drawn, 3);
    scene_model_free(model);
}

static void test_cut_text(void **state)
{
    (void)state;
    write_text("x.stl", "solid a\n" FACET_TEXT "endloop\nendfacet\n" FACET_TEXT);
    expect_refused("x.stl", "is cut: it ends in facet 2");
    struct scene_model *model = load_text("x.stl", "solid a\n" FACET_TEXT "endloop\nendfacet\n");
    assert_true(has_warning(model, "has no \"endsolid\" after facet 1: it may be cut"));
    scene_model_free(model);
    write_text("x.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n");
    expect_refused("x.stl", "line 5: a vertex needs three numbers");
    write_text("x.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0 0\nendfacet\nendsolid");
    expect_refused("x.stl", "line 4: a facet needs three vertices");
    write_text("x.stl", "solid a\n" FACET_TEXT "endloop\nendfacet\nvertex 5 5 5\nendsolid");
    expect_refused("x.stl", "a vertex stands outside of a facet");
}

// A normal in the plane of its facet cannot be its own: the model was turned without it. Up to 60 degrees it stays.
static void test_normals_of_another_pose(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("x.stl", "solid\nfacet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\n"
                           "endloop\nendfacet\nfacet normal 0 0.6 0.8\nouter loop\nvertex 0 0 5\n"
                           "vertex 9 0 5\nvertex 0 9 5\nendloop\nendfacet\nendsolid\n");
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_floats(mesh->normals[mesh->indices[0]], (const float[]){0, 0, 1}, 3, 0);
    assert_floats(mesh->normals[mesh->indices[3]], (const float[]){0, 0.6f, 0.8f}, 3, 1e-6f);
    scene_model_free(model);
}

// Meshmixer writes facets white that nobody has painted, and those that fill a hole black.
static void test_meshmixer(void **state)
{
    (void)state;
    const char head[] = "MESHMIXER-STL-BINARY-FORMAT---------------------------";
    const uint16_t words[] = {0xffff, 0x8000, 0xffff}, painted[] = {0x8000 | 31, 0x8000, 0xffff};
    write_bytes("x.stl", bytes, make_binary(bytes, head, 3, 3, words));
    struct scene_model *model = load("x.stl");
    assert_floats(color_of(model, 0), (const float[]){1, 1, 1, 1}, 4, 0);
    assert_floats(color_of(model, 1), (const float[]){1, 1, 1, 1}, 4, 0);
    scene_model_free(model);
    write_bytes("x.stl", bytes, make_binary(bytes, head, 3, 3, painted));
    model = load("x.stl");
    assert_floats(color_of(model, 1), (const float[]){0, 0, 0, 1}, 4, 0);
    scene_model_free(model);
    write_bytes("x.stl", bytes, make_binary(bytes, "another program", 3, 3, words));
    model = load("x.stl");
    assert_floats(color_of(model, 1), (const float[]){0, 0, 0, 1}, 4, 0);
    scene_model_free(model);
}

// Autodesk's words are those of Magics whether its head names a colour or not: the highest bit says that there is none.
static void test_autodesk(void **state)
{
    (void)state;
    const char head[] = "STLB ATF 9.0.0.1214                      ";
    static const uint16_t none[][2] = {{0, 0}, {0x8000, 0x8000}, {0x8000, 0}};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        write_bytes("x.stl", bytes, make_binary(bytes, head, 2, 2, none[i]));
        struct scene_model *const model = load("x.stl");
        assert_null(model->meshes[0].colors);
        assert_int_equal(model->unsupported_count, 0);
        scene_model_free(model);
    }
    const uint16_t words[] = {31, 31 << 10, 0x8000};
    write_bytes("x.stl", bytes, make_binary(bytes, head, 3, 3, words));
    struct scene_model *const model = load("x.stl");
    assert_floats(color_of(model, 0), (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(color_of(model, 1), (const float[]){0, 0, 1, 1}, 4, 0);
    assert_floats(color_of(model, 2), (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_viscam),
    cmocka_unit_test(test_magics),
    cmocka_unit_test(test_magics_without_words),
    cmocka_unit_test(test_meshlab),
    cmocka_unit_test(test_autodesk),
    cmocka_unit_test(test_meshmixer),
    cmocka_unit_test(test_no_colors),
    cmocka_unit_test(test_counts),
    cmocka_unit_test(test_text),
    cmocka_unit_test(test_odd_normals),
    cmocka_unit_test(test_one_lacks_a_normal),
    cmocka_unit_test(test_normals_of_binary),
    cmocka_unit_test(test_normals_that_oppose_corners),
    cmocka_unit_test(test_normals_of_another_pose),
    cmocka_unit_test(test_marks),
    cmocka_unit_test(test_lines_before),
    cmocka_unit_test(test_cut_text),
};

const struct unit_tests test_stl = UNIT_TESTS(tests, make_directory, remove_directory);
