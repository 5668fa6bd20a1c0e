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
    struct scene_model *model = load_text(
        model_name,
        "mtllib m.mtl\nmtllib ../m.mtl ../../../m.mtl ../../../../m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
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
    // These end, or go on, within what would be a coded byte.
    assert_false(is_found("m.obj", "Wall%5"));
    assert_false(is_found("m.obj", "Wall%"));
    assert_false(is_found("m.obj", "Wall%2z1.tga"));
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
    remove_folder("source");
    // The folder that the libraries of FBX unpack into.
    assert_int_equal(mkdir(path_of("m.fbm"), 0700), 0);
    write_picture("m.fbm/door.tga");
    assert_true(is_found("m.obj", "C:\\old\\door.tga"));
    assert_false(is_found("other.obj", "C:\\old\\door.tga"));
    remove_folder("m.fbm");
    remove_folder("Textures");
}

// Gazebo and ROS keep a model in meshes/ or meshes/visual/, and its textures in materials/textures/.
static void test_gazebo(void **state)
{
    (void)state;
    static const char *const folders[] = {"materials", "materials/textures", "meshes", "meshes/visual"};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(mkdir(path_of(folders[i]), 0700), 0);
    }
    write_picture("materials/textures/hull.tga");
    assert_true(is_found("m.obj", "hull.tga"));
    assert_true(is_found("meshes/m.obj", "hull.tga"));
    assert_true(is_found("meshes/m.obj", "model://ship/materials/textures/hull.tga"));
    write_text("meshes/m.mtl", "newmtl m\nmap_Kd package://ship/hull.tga\n");
    struct scene_model *model =
        load_text("meshes/visual/m.obj", "mtllib ../m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                         "vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    assert_int_equal(model->warning_count, 0);
    scene_model_free(model);
    remove_folder("materials");
    remove_folder("meshes");
}

// A package that an address names stands beside the model's own.
static void test_other_package(void **state)
{
    (void)state;
    static const char *const folders[] = {
        "pack", "pack/ship", "pack/ship/meshes", "pack/ship/meshes/visual", "pack/Boat", "pack/Boat/paint"};
    for (int i = 0; i < 6; i++) {
        assert_int_equal(mkdir(path_of(folders[i]), 0700), 0);
    }
    write_picture("pack/Boat/paint/red hull.tga");
    assert_true(is_found("pack/ship/meshes/m.obj", "model://boat/paint/red hull.tga"));
    assert_true(is_found("pack/ship/meshes/visual/m.obj", "package://Boat/paint/red%20hull.tga"));
    assert_true(is_found("pack/Boat/paint/m.obj", "package://Boat/paint/red hull.tga"));
    assert_false(is_found("pack/ship/meshes/m.obj", "Boat/paint/red hull.tga"));
    assert_false(is_found("pack/ship/meshes/m.obj", "model://raft/paint/red hull.tga"));
    remove_folder("pack");
}

// A library in a folder of its own names files beside itself. Where it has none the model's folder counts.
static void test_beside_library(void **state)
{
    (void)state;
    const unsigned char two[24] = {[2] = 2, [12] = 2, [14] = 1, [16] = 24};
    static const char model_text[] = "mtllib mats/m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\n"
                                     "f 1/1 2/1 3/1\n";
    assert_int_equal(mkdir(path_of("mats"), 0700), 0);
    write_picture("x.tga");
    write_text("mats/m.mtl", "newmtl m\nmap_Kd x.tga\n");
    struct scene_model *model = load_text("m.obj", model_text);
    assert_int_equal(model->images[0].width, 1);
    assert_int_equal(model->warning_count, 0);
    scene_model_free(model);
    write_bytes("mats/x.tga", two, sizeof two);
    model = load_text("m.obj", model_text);
    assert_int_equal(model->images[0].width, 2);
    scene_model_free(model);
    remove_folder("mats");
    unlink(path_of("x.tga"));
}

// Names as exporters write them: in quotation marks, with the query of a URI, or with the ending of the file that
// somebody converted.
static void test_written_otherwise(void **state)
{
    (void)state;
    write_picture("my roof.tga");
    assert_true(is_found("m.obj", "\"my roof.tga\""));
    assert_true(is_found("m.obj", "-s 1 1 1 'my roof.tga'"));
    assert_true(is_found("m.obj", "\"C:\\old\\my roof.tga\""));
    assert_true(is_found("m.obj", "my%20roof.tga?v=3"));
    assert_true(is_found("m.obj", "my%20roof.tga#top"));
    assert_true(is_found("m.obj", "my roof.PNG"));
    assert_true(is_found("m.obj", "maps/my roof.dds"));
    assert_true(is_found("m.obj", "my roof"));
    write_text("my roof.webp", "no picture"); // a less likely ending
    assert_true(is_found("m.obj", "my roof.png"));
    unlink(path_of("my roof.webp"));
    assert_false(is_found("m.obj", "my roof.3.tga"));
    assert_false(is_found("m.obj", "my roo.tga"));
    write_picture("what?.tga"); // a question mark that is part of the name
    assert_true(is_found("m.obj", "what?.tga"));
    unlink(path_of("what?.tga"));
    unlink(path_of("my roof.tga"));
    static const char *const of_sgi[] = {"floor.sgi", "floor.rgb", "floor.rgba", "floor.bw"};
    for (int i = 0; i < 4; i++) {
        write_picture(of_sgi[i]);
        assert_true(is_found("m.obj", "floor.tif"));
        unlink(path_of(of_sgi[i]));
    }
}

// Names in a code page, of files that were unpacked as UTF-8, and the other way round. \xce\xc6\xc0\xed is GBK, and what
// follows it Shift JIS, whose second byte is a backslash, and Windows' Latin.
static void test_code_pages(void **state)
{
    (void)state;
    static const struct {
        const char *file, *name;
    } pairs[] = {
        {"\u7eb9\u7406 1.tga", "\xce\xc6\xc0\xed 1.tga"},
        {"\u8868 1.tga", "\x95\x5c 1.tga"},
        {"\u8868 1.tga", "C:\\old\\\x95\x5c 1.tga"},
        {"T\u00fcr.tga", "T\xfcr.tga"},
        {"T\u00fcr.tga", "t\xfcr.png"},
        {"\u0434\u043e\u043c.tga", "\xe4\xee\xec.tga"},
        {"\u0434\u043e\u043c.tga", "\xc4\xcf\xcd.tga"}, // KOI8-R
        {"T\u00fcr.tga", "T\x9fr.tga"},                 // of a Macintosh
        {"\u8868.tga", "\xc9\xbd.tga"},                 // EUC-JP
        {"T\xfcr.tga", "T\u00fcr.tga"},
        {"\u2560\u2219\u2550\u255d.tga", "\u8d34\u56fe.tga"}, // unpacked as if it were of DOS
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        write_picture(pairs[i].file);
        assert_true(is_found("m.obj", pairs[i].name));
        unlink(path_of(pairs[i].file));
        assert_false(is_found("m.obj", pairs[i].name));
    }
}

// Accents that are joined to their letters in one name and parted from them in the other: Latin with one and two, Cyrillic,
// Greek with up to three, Arabic, a vowel sign of Tamil, Japanese, and Korean with and without a last consonant.
static void test_parted_accents(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"T\u00fcr \u00c5.tga", "Tu\u0308r A\u030a.tga"},
        {"g\u1ed7.tga", "go\u0302\u0303.tga"},
        {"\u1ee3\u0457\u0439.tga", "o\u031b\u0323\u0456\u0308\u0438\u0306.tga"},
        {"\u1f85\u1f56\u1fb3.tga", "\u03b1\u0314\u0301\u0345\u03c5\u0313\u0342\u03b1\u0345.tga"},
        {"\u0622\u1e96\u0bcb.tga", "\u0627\u0653h\u0331\u0bc7\u0bbe.tga"},
        {"\u304c\u30d1\u30b7.tga", "\u304b\u3099\u30cf\u309a\u30b7.tga"},
        {"\uac00\ud55c\ud7a3 \U0001f600.tga",
         "\u1100\u1161\u1112\u1161\u11ab\u1112\u1175\u11c2 \U0001f600.tga"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        for (int k = 0; k < 2; k++) {
            write_picture(pairs[i][k]);
            assert_true(is_found("m.obj", pairs[i][1 - k]));
            unlink(path_of(pairs[i][k]));
            assert_false(is_found("m.obj", pairs[i][1 - k]));
        }
    }
    // In a folder with a name like that, with another ending, and encoded in a URI.
    write_picture("Bu\u0308ro.tga");
    assert_true(is_found("m.obj", "C:\\alt\\B\u00fcro.png"));
    assert_true(is_found("m.obj", "B%C3%BCro.tga"));
    unlink(path_of("Bu\u0308ro.tga"));
    // Of two letters that are the same the one that is made of parts is another one.
    write_picture("\u03b1\u0301.tga");
    assert_true(is_found("m.obj", "\u1f71.tga"));
    unlink(path_of("\u03b1\u0301.tga"));
    write_picture("\u03ac.tga");
    assert_true(is_found("m.obj", "\u03b1\u0301.tga"));
    unlink(path_of("\u03ac.tga"));
}

// Materials whose names are as long as each other in an unknown code page are two.
static void test_material_code_pages(void **state)
{
    (void)state;
    write_text("m.mtl", "newmtl \xc4\xbe\nKd 1 0 0\nnewmtl \xcc\xfa\nKd 0 1 0\n");
    struct scene_model *model =
        load_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \xcc\xfa\nf 1 2 3\n");
    assert_int_equal(model->warning_count, 0);
    assert_floats(model->materials[model->meshes[0].material].base_color, (const float[]){0, 1, 0, 1}, 4, 0);
    scene_model_free(model);
}

// Images within the model, by any format that names one: broken into lines, encoded as a URI is, and with a query.
static void test_data_uris(void **state)
{
    (void)state;
    static const char *const uris[] = {
        "data:image/x-tga;base64,AAACAAAAAAAAAAAAAQABABgA////",
        "data:;base64,AAACAAAAAAAAAAAAAQABABgA%2f%2F//?v=3",
        "DATA:image/x-tga;BASE64,AAACAAAA AAAAAAAA AQABABgA%0A____#texel",
        "data:image/x-tga;base64,AAACAAAAAAAA\\r\\n  AAAAAQABABgA\\n////\\n",
    };
    for (size_t i = 0; i < sizeof uris / sizeof uris[0]; i++) {
        write_format(
            "m.gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
            "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
            "\"material\":0}]}],\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
            "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
            "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}]}",
            uris[i]);
        struct scene_model *model = load("m.gltf");
        assert_int_equal(model->image_count, 1);
        assert_false(model->images[0].missing);
        assert_memory_equal(model->images[0].texels, ((const uint8_t[]){255, 255, 255, 255}), 4);
        scene_model_free(model);
        assert_true(i == 3 || is_found("m.obj", uris[i]));
    }
}

// A path of many components is followed from its end, in no memory to speak of.
static void test_many_slashes(void **state)
{
    (void)state;
    static char name[120001];
    for (size_t i = 0; i < 60000; i++) {
        memcpy(name + 2 * i, "a/", 2);
    }
    write_format("m.mtl", "newmtl m\nmap_Kd %s\n", name);
    struct scene_model *model =
        load_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    assert_true(has_warning(model, "a/\": the name is longer than that of a file can be; drawn in magenta"));
    scene_model_free(model);
    write_picture("x.tga");
    memcpy(name + 3000, "x.tga", 6);
    assert_true(is_found("m.obj", name));
    unlink(path_of("x.tga"));
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
    remove_folder("b");
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
    cmocka_unit_test(test_beside),
    cmocka_unit_test(test_folders),
    cmocka_unit_test(test_longest_end),
    cmocka_unit_test(test_renamed),
    cmocka_unit_test(test_stand_in),
    cmocka_unit_test(test_gazebo),
    cmocka_unit_test(test_other_package),
    cmocka_unit_test(test_beside_library),
    cmocka_unit_test(test_written_otherwise),
    cmocka_unit_test(test_code_pages),
    cmocka_unit_test(test_parted_accents),
    cmocka_unit_test(test_material_code_pages),
    cmocka_unit_test(test_many_slashes),
    cmocka_unit_test(test_data_uris),
};

const struct unit_tests test_resources = UNIT_TESTS(tests, make_directory, remove_directory);
