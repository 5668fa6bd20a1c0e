// SPDX-License-Identifier: MIT
// Effects of Collada: colours and numbers that are parameters, what a material sets of them, and how many there may be.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Write a triangle whose material has this effect, all that is within its tags, and this within those of its instance.
static void write_effect(const char *effect, const char *settings)
{
    write_format(
        "e.dae",
        "<COLLADA version=\"1.4.1\"><library_materials><material id=\"m\"><instance_effect url=\"#e\">%s"
        "</instance_effect></material></library_materials><library_effects><effect id=\"e\">%s</effect>"
        "</library_effects><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "
        "id=\"pa\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source=\"#pa\" "
        "count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param "
        "name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input "
        "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\" material=\"s\"><input "
        "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
        "</library_geometries><library_visual_scenes><visual_scene id=\"s0\"><node><instance_geometry "
        "url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" target=\"#m\"/>"
        "</technique_common></bind_material></instance_geometry></node></visual_scene>"
        "</library_visual_scenes><scene><instance_visual_scene url=\"#s0\"/></scene></COLLADA>",
        settings, effect);
}

#define COMMON(text) "<profile_COMMON><technique sid=\"c\">" text "</technique></profile_COMMON>"
#define RED          "<newparam sid=\"r\"><float3>1 0 0</float3></newparam>"
#define BLUE         "<newparam sid=\"r\"><float3>0 0 1</float3></newparam>"
#define LONG         "0.50000000000000000000000000000000000000000000000000000000000000000"
#define LAMBERT      "<lambert><diffuse><param ref=\"r\"/></diffuse></lambert>"

// Parameters of effects, wherever they stand and whoever sets them, and materials that are what they send out.
static void test_effects(void **state)
{
    (void)state;
    static const char absent[] = "parameters of materials that are not there (Collada): not used";
    static const struct {
        const char *effect, *settings;
        float color[3], alpha, emissive[3];
        bool is_unlit;
        const char *told;
    } cases[] = {
        {COMMON("<constant><emission><color>0 1 0 1</color></emission></constant>"),
         "",
         {0, 1, 0},
         1,
         {0, 0, 0},
         true,
         NULL},
        {COMMON("<constant></constant>"), "", {0, 0, 0}, 1, {0, 0, 0}, true, NULL},
        {COMMON("<constant><diffuse><color>1 0 0 1</color></diffuse></constant>"),
         "",
         {1, 0, 0},
         1,
         {0, 0, 0},
         true,
         NULL},
        {RED COMMON("<lambert><diffuse><param ref=\"r\"/></diffuse></lambert>"),
         "",
         {1, 0, 0},
         1,
         {0, 0, 0},
         false,
         NULL},
        {COMMON(RED "<phong><emission><param ref=\"r\"></param></emission><diffuse><color>0 0 1 1</color>"
                    "</diffuse></phong>"),
         "",
         {0, 0, 1},
         1,
         {1, 0, 0},
         false,
         NULL},
        {COMMON(RED "<newparam sid=\"a\"><float>0.25</float></newparam><lambert><diffuse><param ref='r'/>"
                    "</diffuse><transparent opaque=\"A_ONE\"><color>1 1 1 1</color></transparent>"
                    "<transparency><param ref='a'/></transparency></lambert>"),
         "",
         {1, 0, 0},
         0.25f,
         {0, 0, 0},
         false,
         NULL},
        {RED COMMON("<lambert><diffuse><param ref=\"r\"/></diffuse></lambert>"),
         "<setparam ref=\"r\"><float4>0 0 1 1</float4></setparam>",
         {0, 0, 1},
         1,
         {0, 0, 0},
         false,
         NULL},
        {RED COMMON("<lambert><diffuse><param ref=\"r\"/></diffuse></lambert>"),
         "<setparam ref=\"q\"><float3>0 0 1</float3></setparam>",
         {1, 0, 0},
         1,
         {0, 0, 0},
         false,
         NULL},
        {RED COMMON("<lambert><diffuse><param ref=\"r\"/></diffuse></lambert>"),
         "<setparam ref=\"r\"><surface type=\"2D\"/></setparam>",
         {1, 0, 0},
         1,
         {0, 0, 0},
         false,
         "images and samplers that materials set (Collada): not used"},
        {RED COMMON(
             "<lambert><emission><param ref=\"q\"/></emission><diffuse><color>0 1 0 1</color></diffuse>"
             "</lambert>"),
         "",
         {0, 1, 0},
         1,
         {0, 0, 0},
         false,
         absent},
        {BLUE "<profile_COMMON>" RED "<technique sid=\"c\">" LAMBERT "</technique></profile_COMMON>",
         "",
         {1, 0, 0},
         1,
         {0, 0, 0},
         false,
         NULL},
        {"<profile_GLSL>" BLUE "</profile_GLSL>" RED COMMON(LAMBERT), "", {1, 0, 0}, 1, {0, 0, 0}, false, NULL},
        {"<newparam sid=\"n\"><float></float></newparam>" COMMON(
             "<phong><diffuse><color>0 1 0 1</color></diffuse><shininess><param ref=\"n\"/></shininess>"
             "</phong>"),
         "",
         {0, 1, 0},
         1,
         {0, 0, 0},
         false,
         absent},
        {"<newparam sid=\"n\"><float>1high</float></newparam>" COMMON(
             "<phong><diffuse><color>0 1 0 1</color></diffuse><shininess><param ref=\"n\"/></shininess>"
             "</phong>"),
         "",
         {0, 1, 0},
         1,
         {0, 0, 0},
         false,
         absent},
        {"<newparam sid=\"n\"><float>" LONG "</float></newparam>" COMMON(
             "<phong><diffuse><color>0 1 0 1</color></diffuse><shininess><param ref=\"n\"/></shininess>"
             "</phong>"),
         "",
         {0, 1, 0},
         1,
         {0, 0, 0},
         false,
         absent},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_effect(cases[i].effect, cases[i].settings);
        struct scene_model *const model = load("e.dae");
        const struct scene_material *const material = &model->materials[model->meshes[0].material];
        assert_floats(material->base_color, cases[i].color, 3, 1e-6f);
        assert_floats(&material->base_color[3], &cases[i].alpha, 1, 1e-6f);
        assert_floats(material->emissive, cases[i].emissive, 3, 1e-6f);
        assert_int_equal(material->unlit, cases[i].is_unlit);
        assert_int_equal(model->unsupported_count, cases[i].told != NULL);
        assert_true(cases[i].told == NULL || is_unsupported(model, cases[i].told));
        scene_model_free(model);
    }
}

// Return a text that is repeated, with others around it.
static char *repeated(const char *before, const char *text, size_t count, const char *behind)
{
    char *const whole = malloc(strlen(before) + strlen(text) * count + strlen(behind) + 1);
    assert_non_null(whole);
    char *end = whole + sprintf(whole, "%s", before);
    for (size_t i = 0; i < count; i++) {
        end += sprintf(end, "%s", text);
    }
    strcpy(end, behind);
    return whole;
}

static struct scene_model *load_in_time(const char *name)
{
    const struct scene_model_options options = {.seconds = 8};
    char error[512] = "";
    struct scene_model *const model = scene_model_load(path_of(name), &options, error, sizeof error);
    if (strstr(error, "took more than") != NULL) {
        fail_msg("%s", error);
    }
    return model;
}

// Parameters that would make an effect, or its copies for many materials, too large, and those that do not end.
static void test_many_parameters(void **state)
{
    (void)state;
    static const char setting[] = "<setparam ref=\"r\"><float3>0 0 1</float3></setparam>";
    static const char next[] = "</instance_effect></material><material id=\"n\"><instance_effect url=\"#e\">"
                               "<setparam ref=\"r\"><float3>0 0 1</float3></setparam>";
    char *const blanks = repeated("<!--", " ", 100000, "-->");
    char *const large = repeated("<newparam sid=\"l\">", blanks, 1, "<float>1</float></newparam>" RED);
    char *const profiles = repeated(large, COMMON(LAMBERT), 200, "");
    write_effect(profiles, setting);
    struct scene_model *model = load_in_time("e.dae");
    assert_non_null(model);
    assert_int_equal(model->unsupported_count, 2);
    assert_true(is_unsupported(model, "parameters of effects (Collada): not all used"));
    assert_true(is_unsupported(model, "parameters that materials set (Collada): not all used"));
    scene_model_free(model);

    char *const one = repeated(large, COMMON(LAMBERT), 1, "");
    char *const materials = repeated(setting, next, 200, "");
    write_effect(one, materials);
    model = load_in_time("e.dae");
    assert_non_null(model);
    assert_int_equal(model->unsupported_count, 1);
    assert_true(is_unsupported(model, "parameters that materials set (Collada): not all used"));
    scene_model_free(model);

    char *const open = repeated("", "<instance_effect url=\"#e\"><setparam ref=\"r\">", 100000, "");
    write_effect(RED COMMON(LAMBERT), open);
    assert_null(load_in_time("e.dae"));
    free(blanks);
    free(large);
    free(profiles);
    free(one);
    free(materials);
    free(open);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_effects),
    cmocka_unit_test(test_many_parameters),
};

const struct unit_tests test_collada_effects = UNIT_TESTS(tests, make_directory, remove_directory);
