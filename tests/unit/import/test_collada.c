// SPDX-License-Identifier: MIT
// White space at the ends of Collada's texts, which is to be collapsed.
#include "model_files.h"

#include <string.h>

#define DOCUMENT                                                                                             \
    "<?xml version=\"1.0\"?><!-- a <color> 1 --><COLLADA version=\"1.4.1\"><asset><up_axis>[Z_UP]</up_axis>" \
    "</asset><library_images><image id=\"i\"><init_from>[gone.png]</init_from></image></library_images>"     \
    "<library_effects><effect id=\"e\"><profile_COMMON><newparam sid=\"f\"><surface type=\"2D\"><init_from>" \
    "[i]</init_from></surface></newparam><newparam sid=\"s\"><sampler2D><source>[f]</source></sampler2D>"    \
    "</newparam><technique sid=\"c\"><phong><emission><color>[0.5 0 0 "                                      \
    "1]</color></emission><diffuse><texture "                                                                \
    "texture=\"s\" texcoord=\"UV\"/></diffuse><specular><color>[1 1 1 "                                      \
    "1]</color></specular><shininess><float>"                                                                \
    "[0]</float></shininess></phong></technique></profile_COMMON></effect></library_effects>"                \
    "<library_materials><material id=\"m\" name=\"a> b\"><instance_effect url=\"#e\"/></material>"           \
    "</library_materials><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "        \
    "id=\"pa\" count=\"9\">[0 0 0 1 0 0 0 1 0]</float_array><technique_common><accessor source=\"#pa\" "     \
    "count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param "   \
    "name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input "           \
    "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\" material=\"s\"><input "          \
    "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>[0 1 2]</p></triangles></mesh></geometry>"           \
    "</library_geometries><library_visual_scenes><visual_scene id=\"s0\"><node><translate>[1 2 "             \
    "3]</translate>"                                                                                         \
    "<instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" "        \
    "target=\"#m\"/></technique_common></bind_material></instance_geometry></node></visual_scene>"           \
    "</library_visual_scenes><scene><instance_visual_scene url=\"#s0\"/></scene></COLLADA>"

// Writes the document with `blanks` at both ends of its texts.
static void write_document(const char *blanks)
{
    char text[8192], *out = text;
    for (const char *c = DOCUMENT; *c != 0; c++) {
        if (*c == '[' || *c == ']') {
            memcpy(out, blanks, strlen(blanks));
            out += strlen(blanks);
        } else {
            *out++ = *c;
        }
    }
    *out = 0;
    write_text("x.dae", text);
}

static void test_blanks(void **state)
{
    (void)state;
    static const char *const blanks[] = {"", " ", "\n\t  ", "\r\n        "};
    for (size_t i = 0; i < sizeof blanks / sizeof blanks[0]; i++) {
        write_document(blanks[i]);
        struct scene_model *model = load("x.dae");
        assert_int_equal(model->triangles_drawn, 1);
        assert_int_equal(model->unsupported_count, 0);
        assert_true(has_warning(model, "texture \"gone.png\": No such file"));
        const struct scene_material *material =
            &model->materials[model->meshes[model->instances[0].mesh].material];
        assert_string_equal(material->name, "a> b");
        assert_floats(material->emissive, (const float[]){0.21404114f, 0, 0}, 3, 1e-6f);
        const float *world = model->instances[0].world; // assimp turns z upward to y
        assert_floats(world + 12, (const float[]){1, 3, -2}, 3, 1e-6f);
        scene_model_free(model);
    }
}

// A colour that is no number is none.
static void test_no_color(void **state)
{
    (void)state;
    static const char *const words[] = {"nan", "inf"};
    for (int i = 0; i < 2; i++) {
        char text[8192] = DOCUMENT;
        for (char *c = text; *c != 0; c++) {
            *c = *c == '[' || *c == ']' ? ' ' : *c;
        }
        memcpy(strstr(text, "0.5 0 0"), words[i], 3);
        struct scene_model *model = load_text("x.dae", text);
        const uint32_t material = model->meshes[model->instances[0].mesh].material;
        assert_floats(model->materials[material].emissive, (const float[]){0, 0, 0}, 3, 0);
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_no_color),
    cmocka_unit_test(test_blanks),
};

const struct unit_tests test_collada = UNIT_TESTS(tests, make_directory, remove_directory);
