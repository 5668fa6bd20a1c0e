// SPDX-License-Identifier: MIT
// Files that an X3D shows, and theirs: what they look for, and what cannot be shown.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define SHAPE(texture)                                                                  \
    "<Shape><Appearance><ImageTexture url='" texture "'/></Appearance><IndexedFaceSet " \
    "coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>"
#define FILE_OF(nodes) "<?xml version='1.0'?><X3D><head/><Scene>" nodes "</Scene></X3D>"

static void write_color(const char *name, char red)
{
    const char image[] = {'P', '6', '\n', '1', ' ', '1', '\n', '2', '5', '5', '\n', red, 0, 0};
    write_bytes(name, image, sizeof image);
}

// What another file shows in this one is read as this one is, and tells what it lacks.
static void test_inline_files(void **state)
{
    (void)state;
    write_text("within.x3d",
               FILE_OF("<Shape><Appearance><PhysicalMaterial baseColor='0 1 0'/></Appearance>"
                       "<QuadSet><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/></QuadSet></Shape>"
                       "<Shape><Text string='a'/></Shape><Cloud/>"));
    struct scene_model *const model =
        load_text("i.x3d", FILE_OF("<Inline DEF='w' url='\"within.x3d\"'/><Transform translation='3 0 0'>"
                                   "<Inline USE='w'></Inline></Transform>"));
    assert_int_equal(model->triangles_drawn, 4);
    assert_true(model->bounds_max[0] == 4);
    assert_true(is_unsupported(model, "physically based materials (X3D): drawn dull, in their base colour"));
    assert_true(is_unsupported(model, "text: not drawn"));
    assert_true(is_unsupported(model, "nodes Cloud in Group (X3D): not drawn"));
    assert_int_equal(model->unsupported_count, 3);
    scene_model_free(model);
}

// Lights of a file that is shown twice stand in two places.
static void test_lights(void **state)
{
    (void)state;
    write_text("lamp.x3d", FILE_OF("<PointLight DEF='l' location='0 0 1'/>" SHAPE("")));
    struct scene_model *const model =
        load_text("l.x3d", FILE_OF("<Inline url='lamp.x3d'/><Transform translation='5 0 0'><Inline "
                                   "url='lamp.x3d'/></Transform>"));
    assert_int_equal(model->light_count, 2);
    assert_true(model->lights[0].position[0] == 0 && model->lights[1].position[0] == 5);
    scene_model_free(model);
}

// Names are those of one file.
static void test_names(void **state)
{
    (void)state;
#define SET(size)                                                    \
    "<Shape><IndexedFaceSet DEF='f' coordIndex='0 1 2'><Coordinate " \
    "point='0 0 0 " size " 0 0 0 1 0'/></IndexedFaceSet></Shape>"    \
    "<Transform translation='0 0 1'><Shape><IndexedFaceSet USE='f'/></Shape></Transform>"
    write_text("named.x3d", FILE_OF(SET("3")));
    struct scene_model *const model = load_text("d.x3d", FILE_OF(SET("1") "<Inline url='named.x3d'/>"));
    assert_int_equal(model->triangles_drawn, 4);
    unsigned wide = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        wide += model->meshes[model->instances[i].mesh].bounds_max[0] == 3;
    }
    assert_int_equal(wide, 2);
    scene_model_free(model);
}

// Textures and files are looked for beside the file that names them.
static void test_folders(void **state)
{
    (void)state;
    assert_int_equal(mkdir(path_of("a & 'b'"), 0777), 0);
    assert_int_equal(mkdir(path_of("a & 'b'/inner"), 0777), 0);
    write_color("a.ppm", 1);
    write_color("a & 'b'/a.ppm", 2);
    write_color("a & 'b'/inner/a.ppm", 3);
    write_text("a & 'b'/inner/x.x3d", FILE_OF(SHAPE("\"a.ppm\"") SHAPE("\"../a.ppm\"")));
    write_text("a & 'b'/x.x3d", FILE_OF("<Inline url='\"x.wrl\" \"inner/x.x3d\"'></Inline>" SHAPE("a.ppm")));
    write_text("a & 'b'/x.wrl", "#VRML V2.0 utf8\n");
    struct scene_model *const model =
        load_text("f.x3d", FILE_OF(SHAPE("\"a.ppm\"") "<Inline url='\"a &amp; %27b%27/x.x3d\"'/>"));
    assert_int_equal(model->unsupported_count + model->warning_count, 0);
    assert_int_equal(model->triangles_drawn, 4);
    unsigned found[4] = {0};
    for (uint32_t i = 0; i < model->image_count; i++) {
        const uint8_t red = *(const uint8_t *)model->images[i].texels;
        assert_in_range(red, 1, 3);
        found[red]++;
    }
    assert_true(found[1] > 0 && found[2] > 0 && found[3] > 0);
    scene_model_free(model);
    remove_folder("a & 'b'");
}

// Files that are not there, are no X3D, or show each other are told, and the rest is drawn.
static void test_what_is_not_shown(void **state)
{
    (void)state;
    static const struct {
        const char *tag, *warning, *told;
        unsigned triangles;
    } cases[] = {
        {"<Inline url='\"is gone &amp; lost.x3d\"'/>",
         "file \"is gone & lost.x3d\", which it shows: No such file or directory; not drawn", NULL, 1},
        {"<Inline url='\"m.wrl\"'/>", "file \"m.wrl\", which it shows: is no X3D in XML; not drawn", NULL, 1},
        {"<Inline url='m.wrl'><MetadataString/></Inline>",
         "file \"m.wrl\", which it shows: is no X3D in XML; not drawn", NULL, 1},
        {"<Inline/>", "file \"\", which it shows: has no name; not drawn", NULL, 1},
        {"<Inline load='false' url='\"two.x3d\"'/>", NULL, "files that are loaded later (X3D): not drawn", 1},
        {"<Inline url='\"s.x3d\"'/>", NULL, "files that show each other (X3D): not drawn again", 1},
        {"<Inline url='\"one.x3d\"'/>", NULL, "files that show each other (X3D): not drawn again", 3},
        {"<Inline url='\"empty.x3d\"'/>", NULL, NULL, 1},
        {SHAPE("\"no image.ppm\""), "texture \"no image.ppm\": No such file or directory; drawn in magenta",
         NULL, 2},
        {"<Inline url='\"cut.x3d\"'/>",
         "file \"cut.x3d\", which it shows: is cut before the end of its scene; not drawn", NULL, 1},
    };
    write_text("m.wrl", "#VRML V2.0 utf8\n");
    write_text("empty.x3d", "<X3D><Scene/></X3D>");
    write_text("cut.x3d", "<X3D><Scene><Group/>" SHAPE("") "<Shape><Box");
    write_text("one.x3d", FILE_OF(SHAPE("") "<Inline url='\"two.x3d\"'/>"));
    write_text("two.x3d", FILE_OF(SHAPE("") "<Group><Inline url='\"one.x3d\"'/></Group>"));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("s.x3d", FILE_OF(SHAPE("") "%s"), cases[i].tag);
        struct scene_model *const model = load("s.x3d");
        if (model->triangles_drawn != cases[i].triangles ||
            model->warning_count != (cases[i].warning != NULL) ||
            model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].warning != NULL && !has_warning(model, cases[i].warning)) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("case %zu: %u triangles; %s; %s", i, (unsigned)model->triangles_drawn,
                     model->warning_count > 0 ? model->warnings[0] : "",
                     model->unsupported_count > 0 ? model->unsupported[0] : "");
        }
        scene_model_free(model);
    }
}

// A few files that each show the next one many times would be of any size.
static void test_many_files(void **state)
{
    (void)state;
    enum { FILES = 12 };
    for (int i = 0; i < FILES; i++) {
        char name[32], next[512] = "", one[32];
        snprintf(name, sizeof name, "n%d.x3d", i);
        snprintf(one, sizeof one, "<Inline url='n%d.x3d'/>", i + 1);
        for (int k = 0; k < 10 && i + 1 < FILES; k++) {
            strcat(next, one);
        }
        write_format(name, FILE_OF("%s" SHAPE("")), next);
    }
    struct scene_model *const model = load("n0.x3d");
    assert_true(model->triangles_drawn > 1000 && model->triangles_drawn < 20000);
    assert_true(is_unsupported(model, "files that are shown (X3D): not all drawn"));
    assert_int_equal(model->unsupported_count, 1);
    scene_model_free(model);
}

// Of files that are too large together the first are drawn. What follows a scene is no part of it.
static void test_large_files(void **state)
{
    (void)state;
    static const char start[] = "<X3D><Scene>" SHAPE("") "<!--", end[] = "--></Scene><Scene></X3D>";
    const size_t size = 20000000;
    char *const text = malloc(size);
    assert_non_null(text);
    memset(text, 'x', size);
    memcpy(text, start, strlen(start));
    memcpy(text + size - strlen(end), end, strlen(end));
    write_bytes("large.x3d", text, size);
    free(text);
    struct scene_model *const model =
        load_text("b.x3d", FILE_OF("<Inline url='large.x3d'/><Inline url='large.x3d'/>" SHAPE("")));
    assert_int_equal(model->triangles_drawn, 2);
    assert_true(is_unsupported(model, "files that are shown (X3D): not all drawn"));
    assert_int_equal(model->unsupported_count + model->warning_count, 1);
    scene_model_free(model);
}

// Files that are made large, also by what stands outside of their scenes, have room together.
static void test_made_files(void **state)
{
    (void)state;
    enum { POINTS = 320 };
    char spine[POINTS * 10] = "", section[POINTS * 4] = "";
    for (int i = 0; i < POINTS; i++) {
        snprintf(spine + strlen(spine), sizeof spine - strlen(spine), "0 %d 0 ", i);
        snprintf(section + strlen(section), sizeof section - strlen(section), "%d %d ", i % 2, i % 3);
    }
    write_format("made.x3d",
                 "<X3D><Shape><Extrusion crossSection='%s' spine='%s'/></Shape><Scene>" SHAPE("") "</Scene>"
                                                                                                  "</X3D>",
                 section, spine);
    write_text("m.x3d", FILE_OF(SHAPE("") "<Inline url='made.x3d'/><Inline url='made.x3d'/><Inline "
                                          "url='made.x3d'/><Inline url='made.x3d'/><Inline url='made.x3d'/>"
                                          "<Inline url='made.x3d'/><Inline url='made.x3d'/>"));
    struct scene_model *const model = load("m.x3d");
    assert_int_equal(model->triangles_drawn, 8);
    assert_true(is_unsupported(model, "grids and extrusions after very large ones (X3D): not drawn"));
    assert_int_equal(model->unsupported_count + model->warning_count, 1);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_inline_files),
    cmocka_unit_test(test_lights),
    cmocka_unit_test(test_names),
    cmocka_unit_test(test_folders),
    cmocka_unit_test(test_what_is_not_shown),
    cmocka_unit_test(test_many_files),
    cmocka_unit_test(test_large_files),
    cmocka_unit_test(test_made_files),
};

const struct unit_tests test_x3d_inline = UNIT_TESTS(tests, make_directory, remove_directory);
