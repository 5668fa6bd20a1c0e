// SPDX-License-Identifier: MIT
// Files that a model names, found as people keep them: in other case, with backslashes, at paths of another machine, in
// a folder beside.
#include "model_files.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// One white texel.
static void write_picture(const char *name)
{
    unsigned char bytes[21] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [18] = 255, 255, 255};
    write_bytes(name, bytes, sizeof bytes);
}

static bool is_found(const char *model_name, const char *texture)
{
    write_format("m.mtl", "newmtl m\nmap_Kd %s\n", texture);
    struct scene_model *model =
        load_text(model_name, "mtllib m.mtl\nmtllib ../m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                              "vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    assert_int_equal(model->image_count, 1);
    const bool found = !model->images[0].missing;
    assert_true(found != has_warning(model, "No such file or directory; drawn in magenta"));
    scene_model_free(model);
    return found;
}

static void test_beside(void **state)
{
    (void)state;
    write_picture("Wall 1.tga");
    assert_true(is_found("m.obj", "Wall 1.tga"));
    assert_true(is_found("m.obj", "wall 1.TGA"));
    assert_true(is_found("m.obj", "Wall%201.tga"));
    assert_true(is_found("m.obj", ".\\wall 1.tga"));
    assert_true(is_found("m.obj", "C:\\Users\\me\\Models\\castle\\Wall 1.tga"));
    assert_true(is_found("m.obj", "/home/someone/castle/wall 1.tga"));
    assert_true(is_found("m.obj", "file:///C:/castle/Wall%201.tga"));
    assert_false(is_found("m.obj", "Wall 2.tga"));
    assert_false(is_found("m.obj", "C:\\castle\\all 1.tga"));
    unlink(path_of("Wall 1.tga"));
}

static void test_folders(void **state)
{
    (void)state;
    assert_int_equal(mkdir(path_of("Textures"), 0700), 0);
    write_picture("Textures/Roof.tga");
    assert_true(is_found("m.obj", "roof.tga"));
    assert_true(is_found("m.obj", "D:\\old\\place\\roof.tga"));
    assert_true(is_found("m.obj", "E:\\castle\\textures\\roof.tga"));
    // A model in a folder of its own, beside that of the textures.
    assert_int_equal(mkdir(path_of("source"), 0700), 0);
    assert_true(is_found("source/m.obj", "roof.tga"));
    unlink(path_of("source/m.obj"));
    rmdir(path_of("source"));
    unlink(path_of("Textures/Roof.tga"));
    rmdir(path_of("Textures"));
}

// Of two files of one name, the one in the folder that the path ends with.
static void test_longest_end(void **state)
{
    (void)state;
    const unsigned char two[24] = {[2] = 2, [12] = 2, [14] = 1, [16] = 24};
    assert_int_equal(mkdir(path_of("b"), 0700), 0);
    write_picture("x.tga");
    write_bytes("b/x.tga", two, sizeof two);
    write_text("m.mtl", "newmtl m\nmap_Kd Z:\\a\\b\\x.tga\n");
    struct scene_model *model =
        load_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    assert_int_equal(model->images[0].width, 2);
    scene_model_free(model);
    unlink(path_of("b/x.tga"));
    rmdir(path_of("b"));
}

// An OBJ that was renamed, with its library.
static void test_renamed(void **state)
{
    (void)state;
    write_text("new name.mtl", "newmtl m\nKd 1 0 0\n");
    struct scene_model *model =
        load_text("new name.obj", "mtllib old.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    assert_true(has_warning(model, "material library \"old.mtl\" is not there; \"new name.mtl\" is read"));
    assert_floats(model->materials[model->meshes[0].material].base_color, (const float[]){1, 0, 0, 1}, 4, 0);
    scene_model_free(model);
    model = load_text("other.obj", "mtllib old.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    assert_true(has_warning(model, "material library \"old.mtl\": No such file or directory"));
    scene_model_free(model);
}

// What stands in for a missing colour is plain magenta, whatever the material does to its texture.
static void test_stand_in(void **state)
{
    (void)state;
    write_text("m.mtl", "newmtl m\nKd 0.1 0.2 0.05\nd 0.2\nPm 1\nmap_Kd none.tga\n");
    struct scene_model *model =
        load_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    const struct scene_material *material = &model->materials[model->meshes[0].material];
    assert_floats(material->base_color, (const float[]){1, 1, 1, 1}, 4, 0);
    assert_floats(&material->metallic, (const float[]){0}, 1, 0);
    assert_int_equal(material->alpha_mode, SCENE_ALPHA_OPAQUE);
    assert_int_equal(material->slots[SCENE_SLOT_BASE_COLOR].mag_filter, RHW_FILTER_NEAREST);
    assert_memory_equal(model->images[0].texels, ((const uint8_t[]){255, 0, 255, 255, 96, 0, 96, 255}), 8);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_beside),  cmocka_unit_test(test_folders),  cmocka_unit_test(test_longest_end),
    cmocka_unit_test(test_renamed), cmocka_unit_test(test_stand_in),
};

const struct unit_tests test_resources = UNIT_TESTS(tests, make_directory, remove_directory);
