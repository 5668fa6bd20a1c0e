// SPDX-License-Identifier: MIT
// What assimp leaves out of Blender files, by files of its own tests that are changed byte by byte.
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MODELS "/usr/share/assimp/models/BLEND/"

// Read a file. Skip the test if it is not there.
static size_t read_model(const char *path, unsigned char *bytes, size_t room)
{
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        skip();
    }
    const size_t size = fread(bytes, 1, room, file);
    fclose(file);
    assert_true(size < room);
    return size;
}

// Load a file with a byte at a place.
static struct scene_model *load_changed(const char *path, size_t place, unsigned char byte)
{
    static unsigned char bytes[1 << 20];
    const size_t size = read_model(path, bytes, sizeof bytes);
    bytes[place] = byte;
    write_bytes("b.blend", bytes, size);
    return load("b.blend");
}

// Objects of kinds that assimp does not know, hidden ones, and materials that it does not understand, in files with
// pointers of eight bytes and of four.
static void test_told(void **state)
{
    (void)state;
    static const char wide[] = MODELS "BlenderDefault_269.blend",
                      narrow[] = MODELS "BlenderDefault_248.blend";
    static const char hidden[] = "hidden objects: drawn";
    static const struct {
        const char *path;
        size_t place;
        unsigned char byte;
        const char *told;
    } cases[] = {
        {wide, 297544, 0, NULL},
        {wide, 297544, 1, hidden}, // in the view
        {wide, 297544, 2, NULL},   // from being selected
        {wide, 297544, 4, hidden}, // in pictures
        {wide, 297312, 2, hidden}, // on another layer
        {wide, 299228, 4, NULL},   // a lamp
        {wide, 300211, 1, "materials of nodes (Blender): drawn plain"},
        {wide, 297608, 1, "particles (Blender): not drawn"},
        {wide, 298188, 2, "curves (Blender): not drawn"},
        {narrow, 77826, 0, NULL},
        {narrow, 77826, 4, hidden},
        {narrow, 77572, 2, hidden},
        {narrow, 77976, 4, "text (Blender): not drawn"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *const told = cases[i].told;
        struct scene_model *const model = load_changed(cases[i].path, cases[i].place, cases[i].byte);
        assert_int_equal(model->triangles_drawn, 12);
        if (model->unsupported_count != (told != NULL) || (told != NULL && !is_unsupported(model, told))) {
            fail_msg("case %zu: %u lines, such as %s", i, model->unsupported_count,
                     model->unsupported_count > 0 ? model->unsupported[0] : "none");
        }
        scene_model_free(model);
    }
}

// Nothing is told of a material that nothing uses, whether a user has kept it or not.
static void test_unused_material(void **state)
{
    (void)state;
    enum { USERS = 299776, KEPT = 299779, HAS_NODES = 300211 }; // places in the file
    static const struct {
        unsigned char users, kept;
        bool is_told;
    } cases[] = {{1, 0, true}, {1, 2, false}, {2, 2, true}, {0, 0, false}};
    static unsigned char bytes[1 << 20];
    const size_t size = read_model(MODELS "BlenderDefault_269.blend", bytes, sizeof bytes);
    bytes[HAS_NODES] = 1;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        bytes[USERS] = cases[i].users;
        bytes[KEPT] = cases[i].kept;
        write_bytes("m.blend", bytes, size);
        struct scene_model *const model = load("m.blend");
        if (is_unsupported(model, "materials of nodes (Blender): drawn plain") != cases[i].is_told) {
            fail_msg("case %zu", i);
        }
        scene_model_free(model);
    }
}

// White vertex colours of an early version, which assimp takes for -1.
static void test_colors(void **state)
{
    (void)state;
    struct scene_model *const model = load_changed(MODELS "BlenderDefault_250.blend", 0, 'B');
    const struct scene_mesh *const mesh = &model->meshes[0];
    assert_non_null(mesh->colors);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        assert_floats(mesh->colors[i], (const float[]){1, 1, 1, 1}, 4, 0);
    }
    scene_model_free(model);
}

// A lamp that is turned into a curve, and is then taken out of the scene, of which nothing is to be told.
static void test_scene(void **state)
{
    (void)state;
    enum { NEXT = 291432, LAMP = 298188 }; // what follows the cube in the scene, and the type of the lamp
    static unsigned char bytes[1 << 20];
    const size_t size = read_model(MODELS "BlenderDefault_269.blend", bytes, sizeof bytes);
    bytes[LAMP] = 2;
    for (int i = 0; i < 2; i++) {
        write_bytes("s.blend", bytes, size);
        struct scene_model *const model = load("s.blend");
        assert_int_equal(model->triangles_drawn, 12);
        assert_int_equal(is_unsupported(model, "curves (Blender): not drawn"), i == 0);
        scene_model_free(model);
        memset(bytes + NEXT, 0, 8);
    }
}

// A block is an object by its code, whatever its struct is.
static void test_kinds_of_blocks(void **state)
{
    (void)state;
    enum { HEAD = 298028, TYPE = 298188 }; // the block of a lamp, and what makes it a curve
    static unsigned char bytes[1 << 20];
    static const struct {
        size_t place;
        unsigned char byte;
        bool is_told;
    } cases[] = {{HEAD, 'O', true}, {HEAD, 'X', false}, {HEAD + 1, 'X', false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const size_t size = read_model(MODELS "BlenderDefault_269.blend", bytes, sizeof bytes);
        bytes[TYPE] = 2;
        bytes[cases[i].place] = cases[i].byte;
        write_bytes("k.blend", bytes, size);
        struct scene_model *const model = load("k.blend");
        assert_int_equal(model->triangles_drawn, 12);
        if (is_unsupported(model, "curves (Blender): not drawn") != cases[i].is_told) {
            fail_msg("case %zu", i);
        }
        scene_model_free(model);
    }
}

// The lamp of the start file is left out where its camera looks past the model, unless somebody has moved it.
static void test_start_lamp(void **state)
{
    (void)state;
    enum { CAMERA = 295416, LAMP = 298724 }; // the places in the matrices of both
    static const float away = 1000, moved = 4;
    static unsigned char bytes[1 << 20];
    static const struct {
        bool is_away, is_moved;
        uint32_t lights;
    } cases[] = {{false, false, 1}, {true, false, 0}, {true, true, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const size_t size = read_model(MODELS "BlenderDefault_269.blend", bytes, sizeof bytes);
        if (cases[i].is_away) {
            memcpy(bytes + CAMERA, &away, sizeof away);
        }
        if (cases[i].is_moved) {
            memcpy(bytes + LAMP, &moved, sizeof moved);
        }
        write_bytes("l.blend", bytes, size);
        struct scene_model *const model = load("l.blend");
        assert_int_equal(model->camera_count, 1);
        assert_int_equal(model->light_count, cases[i].lights);
        assert_int_equal(model->warning_count, 1 - cases[i].lights);
        scene_model_free(model);
    }
}

// The lamps of the start file are left out of what Blender exports, too, whatever its axes; all other lights are kept.
static void test_exported_start_lamps(void **state)
{
    (void)state;
    write_text("e.dae",
               "<COLLADA version=\"1.4.1\"><asset><up_axis>Z_UP</up_axis></asset><library_cameras>"
               "<camera id=\"c\"><optics><technique_common><perspective><xfov>40</xfov></perspective>"
               "</technique_common></optics></camera></library_cameras><library_lights><light id=\"l\">"
               "<technique_common><point><color>1 1 1</color></point></technique_common></light>"
               "</library_lights><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
               "<float_array id=\"a\" count=\"9\">0 0 0 0.1 0 0 0 0.1 0</float_array><technique_common>"
               "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
               "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
               "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
               "source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" "
               "source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
               "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>"
               "<instance_geometry url=\"#g\"/></node>"
               "<node><matrix>1 0 0 4.076245 0 1 0 1.005454 0 0 1 5.903862 0 0 0 1</matrix><instance_light "
               "url=\"#l\"/></node>"
               "<node><matrix>1 0 0 3 0 1 0 4 0 0 1 5 0 0 0 1</matrix><instance_light url=\"#l\"/></node>"
               "<node><matrix>1 0 0 5.903862 0 1 0 -1.005454 0 0 1 4.076245 0 0 0 1</matrix><instance_light "
               "url=\"#l\"/></node>"
               "<node><matrix>1 0 0 0 0 1 0 0 0 0 1 9 0 0 0 1</matrix>"
               "<instance_camera url=\"#c\"/></node></visual_scene></library_visual_scenes>"
               "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    struct scene_model *const model = load("e.dae");
    assert_int_equal(model->camera_count, 1);
    assert_int_equal(model->light_count, 1);
    assert_floats(model->lights[0].position, (const float[]){3, 5, -4}, 3, 1e-5f);
    assert_int_equal(model->warning_count, 1);
    assert_true(has_warning(model, "2 lamps of Blender's start file: left out"));
    scene_model_free(model);
}

// Return true if all corners of each triangle have one normal, but for 1e-5.
static bool is_flat(const struct scene_mesh *mesh)
{
    float worst = 0;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const float *const first = mesh->normals[mesh->indices[i - i % 3]],
                           *const other = mesh->normals[mesh->indices[i]];
        for (int c = 0; c < 3; c++) {
            worst = fmaxf(worst, fabsf(first[c] - other[c]));
        }
    }
    return worst < 1e-5f;
}

// Faces say whether they are smooth. A flat cube stays one where one of its faces is, as its edges are creases, but not
// where its sides lean as little as those of a lid. A smooth one becomes flat with one face that is, or by its angles.
static void test_shading(void **state)
{
    (void)state;
    enum {
        FLAT_FACE = 84415,
        SMOOTH_FACE = 86215,
        SMOOTH_FLAGS = 84794,
        VERTICES = 83380,
        VERTEX = 24,
        ANGLE = 32,
        NAME = 78999
    };
    static const struct {
        size_t place;
        unsigned char byte;
        bool is_lid, flat, smooth; // whether the flat one and the smooth one are drawn flat
    } cases[] = {
        {0, 'B', false, true, false},        {FLAT_FACE, 3, false, true, false},
        {SMOOTH_FACE, 2, false, true, true}, {SMOOTH_FLAGS, 4 + ANGLE, false, true, true},
        {0, 'B', true, true, false},         {FLAT_FACE, 3, true, false, false},
        {NAME, 0xe9, false, true, false}, // a letter of the name of the flat one, in Latin-1
    };
    static unsigned char bytes[1 << 20];
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const size_t size = read_model(MODELS "SmoothVsSolidCube_248.blend", bytes, sizeof bytes);
        bytes[cases[i].place] = cases[i].byte;
        for (int v = 0; v < 8 && cases[i].is_lid; v++) {
            float place[3];
            memcpy(place, bytes + VERTICES + v * VERTEX, sizeof place);
            if (place[2] > 0) {
                memcpy(bytes + VERTICES + v * VERTEX,
                       (const float[]){place[0] * 0.1f, place[1] * 0.1f, -0.8f}, sizeof place);
            }
        }
        write_bytes("s.blend", bytes, size);
        struct scene_model *const model = load("s.blend");
        assert_int_equal(model->mesh_count, 2);
        const int first = strlen(model->meshes[0].name) == strlen("Cube") ? 0 : 1;
        if (is_flat(&model->meshes[first]) != cases[i].flat ||
            is_flat(&model->meshes[1 - first]) != cases[i].smooth) {
            fail_msg("case %zu: %d, %d", i, is_flat(&model->meshes[first]),
                     is_flat(&model->meshes[1 - first]));
        }
        scene_model_free(model);
    }
}

static unsigned char *put(unsigned char *to, const void *bytes, size_t size)
{
    memcpy(to, bytes, size);
    return to + size;
}

// Fields are looked up once for each kind of block, and the elements of fields are counted once for each name. For each
// of many blocks, or of many fields of a long name, it would take more than the limit.
static void test_many_blocks(void **state)
{
    (void)state;
    enum { BLOCKS = 40000, BLOCK = 24, FIELDS = 0xffff, NAME = 16384 };
    static const unsigned char object[BLOCK] = {'O', 'B', [8] = 1, [20] = 1};
    static const char dna[] = "DNA1\x30\x40\4\0\1\0\0\0\0\0\0\0\0\0\0\0\1\0\0\0SDNANAME\1\0\0\0";
    static const char types[] = "TYPE\2\0\0\0Object\0char\0TLEN\0\0\1\0STRC\1\0\0\0\0\0\xff\xff";
    static char name[NAME] = "x";
    unsigned char *const bytes = malloc(BLOCKS * BLOCK + 4 * FIELDS + NAME + 256);
    memset(name + 1, '[', NAME - 3);
    name[NAME - 2] = ']'; // by which assimp leaves out the lengths
    unsigned char *end = put(bytes, "BLENDER-v269", 12);
    for (int i = 0; i < BLOCKS; i++) {
        end = put(end, object, BLOCK);
    }
    end = put(end, dna, sizeof dna - 1);
    end = put(end, name, NAME);
    end = put(end, types, sizeof types - 1);
    for (int i = 0; i < FIELDS; i++) {
        end = put(end, "\1\0\0", 4);
    }
    end = put(end, (const unsigned char[BLOCK]){'E', 'N', 'D', 'B'}, BLOCK);
    write_bytes("many.blend", bytes, (size_t)(end - bytes));
    free(bytes);
    char error[256] = "";
    const struct scene_model_options options = {.seconds = 8};
    assert_null(scene_model_load(path_of("many.blend"), &options, error, sizeof error));
    if (strstr(error, "no `Scene`") == NULL) {
        fail_msg("%s", error);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_told),
    cmocka_unit_test(test_unused_material),
    cmocka_unit_test(test_shading),
    cmocka_unit_test(test_scene),
    cmocka_unit_test(test_many_blocks),
    cmocka_unit_test(test_colors),
    cmocka_unit_test(test_start_lamp),
    cmocka_unit_test(test_exported_start_lamps),
    cmocka_unit_test(test_kinds_of_blocks),
};

const struct unit_tests test_blender = UNIT_TESTS(tests, make_directory, remove_directory);
