// SPDX-License-Identifier: MIT
// 3MF of slicers: colours of filaments, parts that are not printed, painted triangles. Values by hand.
#include "package_3mf.h"

#include <stdio.h>

#define TWO "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/><triangle v1=\"1\" v2=\"3\" v3=\"2\"/>"

static const float red[] = {1, 0, 0, 1}, green[] = {0, 1, 0, 1}, blue[] = {0, 0, 1, 1};

// A package with the model and up to two files more.
static struct scene_model *load_files(const char *resources, const char *build, const char *name,
                                      const char *text, const char *other, const char *other_text)
{
    zipFile zip = package_begin("s.3mf");
    package_add_relationships(zip);
    package_add_model(zip, "3D/3dmodel.model", resources, build);
    if (name != NULL) {
        package_add_text(zip, name, text);
    }
    if (other != NULL) {
        package_add_text(zip, other, other_text);
    }
    package_end(zip);
    return load("s.3mf");
}

static void assert_color(const struct scene_model *model, uint32_t instance, uint32_t triangle,
                         const float *color)
{
    const struct scene_mesh *mesh = mesh_of(model, instance);
    assert_true(3 * triangle < mesh->index_count);
    for (uint32_t k = 0; k < 3; k++) {
        assert_floats(mesh->colors[mesh->indices[3 * triangle + k]], color, 4, 0);
    }
}

static void assert_quiet(const struct scene_model *model)
{
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->unsupported_count, 0);
}

// Bambu Studio and OrcaSlicer: a part has the filament that it names, or that of its object; an object that they do not
// speak of has the first one.
static void test_bambu_parts(void **state)
{
    (void)state;
    struct scene_model *model = load_files(
        "<object id=\"1\">" MESH(
            "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>"
                                                      "<object id=\"2\">" MESH(
                                                          "<triangle v1=\"0\" v2=\"1\" "
                                                          "v3=\"2\"/>") "</object>"
                                                                        "<object id=\"3\" "
                                                                        "type=\"other\">" MESH(
                                                                            "<triangle v1=\"0\" "
                                                                            "v2=\"1\" v3=\"2\"/>") "</object>"
                                                                                                   "<object "
                                                                                                   "id=\"4\">"
                                                                                                   "<componen"
                                                                                                   "ts><"
                                                                                                   "component"
                                                                                                   " objectid"
                                                                                                   "=\"1\"/"
                                                                                                   "><"
                                                                                                   "component"
                                                                                                   " objectid"
                                                                                                   "=\"2\"/>"
                                                                                                   "<componen"
                                                                                                   "t "
                                                                                                   "objectid="
                                                                                                   "\"3\"/></"
                                                                                                   "component"
                                                                                                   "s></"
                                                                                                   "object>",
        "<item objectid=\"4\"/><item objectid=\"1\"/>", "Metadata/model_settings.config",
        "<config><object id=\"4\"><metadata key=\"extruder\" value=\"2\"/>"
        "<part id=\"1\" subtype=\"normal_part\"/>"
        "<part id=\"2\" subtype=\"normal_part\"><metadata key=\"extruder\" value=\"3\"/></part>"
        "<part id=\"3\" subtype=\"modifier_part\"/></object>"
        "<plate><metadata key=\"extruder\" value=\"1\"/></plate></config>",
        "Metadata/project_settings.config",
        "{\"filament_colour\": [\"#FF0000\", \"#00FF00\", \"#0000FFFF\"]}");
    assert_int_equal(model->instance_count, 3);
    assert_color(model, 0, 0, green);
    assert_color(model, 1, 0, blue);
    assert_color(model, 2, 0, red); // the same mesh, in another colour
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->unsupported_count, 1);
    assert_true(is_unsupported(model, "modifiers of slicers (3MF): left out"));
    scene_model_free(model);
}

// What is not printed of Bambu Studio's parts, by their subtypes, and objects of the type "other".
static void test_bambu_roles(void **state)
{
    (void)state;
    static const char *const cases[][3] = {
        {"model", "negative_part", "negative volumes"}, {"model", "modifier_part", "modifiers of slicers"},
        {"model", "support_enforcer", "enforcers and"}, {"model", "support_blocker", "blockers of supports"},
        {"other", "normal_part", "objects of type"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char resources[2048], settings[512];
        snprintf(resources, sizeof resources,
                 "<object id=\"1\">" MESH(TWO) "</object><object id=\"2\" type=\"%s\">" MESH(
                     TWO) "</object><object id=\"3\"><components><component objectid=\"1\"/><component "
                          "objectid=\"2\"/></components></object>",
                 cases[i][0]);
        snprintf(settings, sizeof settings,
                 "<config><object id=\"3\"><part id=\"2\" subtype=\"%s\"/></object></config>", cases[i][1]);
        struct scene_model *model = load_files(resources, "<item objectid=\"3\"/>",
                                               "Metadata/model_settings.config", settings, NULL, NULL);
        assert_int_equal(model->instance_count, 1);
        assert_true(is_unsupported(model, cases[i][2]));
        scene_model_free(model);
    }
}

// PrusaSlicer: ranges of triangles. The colour of the extruder goes before that of the filament where there is one.
static void test_prusa_volumes(void **state)
{
    (void)state;
    struct scene_model *model = load_files(
        "<object id=\"7\">" MESH(TWO TWO "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/>") "</object>",
        "<item objectid=\"7\"/>", "Metadata/Slic3r_PE_model.config",
        "<config><object id=\"7\"><metadata type=\"object\" key=\"extruder\" value=\"2\"/>"
        "<volume firstid=\"1\" lastid=\"2\"><metadata type=\"volume\" key=\"volume_type\" "
        "value=\"ModelPart\"/>"
        "<metadata type=\"volume\" key=\"extruder\" value=\"3\"/></volume>"
        "<volume firstid=\"0\" lastid=\"0\"><metadata type=\"volume\" key=\"extruder\" value=\"0\"/></volume>"
        "<volume firstid=\"3\" lastid=\"3\"><metadata type=\"volume\" key=\"modifier\" value=\"1\"/></volume>"
        "<volume firstid=\"4\" lastid=\"4\"><metadata type=\"volume\" key=\"volume_type\" "
        "value=\"SupportBlocker\"/></volume></object></config>",
        "Metadata/Slic3r_PE.config",
        "; extruder_colour = \"\";#00FF00;\"\"\n; filament_colour = #FF0000;#FF0000;#0000FF\n");
    assert_int_equal(model->triangles_drawn, 3);
    assert_color(model, 0, 0, green);
    assert_color(model, 0, 1, blue);
    assert_color(model, 0, 2, blue);
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->unsupported_count, 2);
    assert_true(is_unsupported(model, "modifiers of slicers"));
    assert_true(is_unsupported(model, "blockers of supports"));
    scene_model_free(model);
}

// Slic3r has its volumes in the model, Cura its settings.
static void test_slic3r_and_cura(void **state)
{
    (void)state;
    struct scene_model *model = package_load(
        "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" "
        "z=\"0\"/><vertex "
        "x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"1\" y=\"1\" z=\"0\"/></vertices><triangles>" TWO "</triangles>"
        "<slic3r:volumes><slic3r:volume ts=\"0\" te=\"0\" modifier=\"0\"><slic3r:metadata "
        "type=\"slic3r.extruder\" "
        "config=\"1\"/></slic3r:volume><slic3r:volume ts=\"1\" te=\"1\" "
        "modifier=\"1\"/></slic3r:volumes></mesh>"
        "</object><object id=\"2\"><metadatagroup><metadata name=\"cura:infill_mesh\">True</metadata>"
        "</metadatagroup>" MESH(
            TWO) "</object><object id=\"3\"><settings><setting key=\"support_mesh\">True"
                 "</setting></settings>" MESH(
                     TWO) "</object><object id=\"4\"><metadatagroup><metadata name=\"cura:"
                          "infill_mesh\">False</metadata><metadata "
                          "name=\"cura:extruder_nr\">1</metadata></metadatagroup>" MESH(TWO) "</object>",
        "<item objectid=\"1\"/><item objectid=\"2\"/><item objectid=\"3\"/><item objectid=\"4\"/>");
    assert_int_equal(model->triangles_drawn, 3);
    assert_int_equal(model->instance_count, 2);
    assert_int_equal(model->unsupported_count, 3);
    assert_true(is_unsupported(model, "modifiers of slicers"));
    assert_true(is_unsupported(model, "blockers of supports"));
    assert_true(is_unsupported(model, "colours of Cura's materials (3MF): not drawn"));
    scene_model_free(model);
}

// Painted triangles -------------------------------------------------------------------------------

static struct scene_model *load_painted(const char *attribute, const char *painting, const char *colors)
{
    char resources[2048];
    snprintf(resources, sizeof resources,
             "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\" %s=\"%s\"/>") "</object>",
             attribute, painting);
    return load_files(resources, "<item objectid=\"1\"/>",
                      colors != NULL ? "Metadata/project_settings.config" : NULL, colors, NULL, NULL);
}

static const char colors_of_three[] = "{\"filament_colour\": [\"#FF0000\", \"#00FF00\", \"#0000FF\"]}";

// The last digit comes first. 4 and 8 are the first two filaments, 0C the third.
static void test_painted(void **state)
{
    (void)state;
    static const struct {
        const char *attribute, *painting;
        const float *color;
    } cases[] = {
        {"paint_color", "4", red},
        {"paint_color", "8", green},
        {"slic3rpe:mmu_segmentation", "8", green},
        {"paint_color", "0C", blue},
        {"slic3rpe:mmu_segmentation", "0c", blue},
        {"paint_color", "0", red}, // not painted: the first filament
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_painted(cases[i].attribute, cases[i].painting, colors_of_three);
        assert_color(model, 0, 0, cases[i].color);
        assert_quiet(model);
        scene_model_free(model);
    }
}

// The colour of the triangle at a point of the plane, which must be in one alone and run counter-clockwise.
static const float *color_at(const struct scene_mesh *mesh, const float point[2])
{
    const float *color = NULL;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        bool inside = true;
        for (uint32_t k = 0; k < 3; k++) {
            const float *a = mesh->positions[mesh->indices[i + k]];
            const float *b = mesh->positions[mesh->indices[i + (k + 1) % 3]];
            inside = inside && (b[0] - a[0]) * (point[1] - a[1]) > (b[1] - a[1]) * (point[0] - a[0]);
        }
        if (inside) {
            assert_null(color);
            color = mesh->colors[mesh->indices[i]];
        }
    }
    assert_non_null(color);
    return color;
}

// Trees of cuts of the triangle (0, 0), (1, 0), (0, 1).
static void test_cuts(void **state)
{
    (void)state;
    static const struct {
        const char *painting;
        uint32_t triangles;
        struct {
            float point[2];
            const float *color; // NULL ends the list
        } probes[6];
    } cases[] = {
        // One side, from each of the corners.
        {"841", 2, {{{0.5f, 0.17f}, green}, {{0.17f, 0.5f}, red}}},
        {"845", 2, {{{0.3f, 0.6f}, green}, {{0.3f, 0.1f}, red}}},
        {"849", 2, {{{0.1f, 0.3f}, green}, {{0.6f, 0.2f}, red}}},
        // Two sides.
        {"480C2", 3, {{{0.1f, 0.1f}, red}, {{0.55f, 0.1f}, green}, {{0.3f, 0.5f}, blue}}},
        {"480CA", 3, {{{0.1f, 0.8f}, red}, {{0.1f, 0.3f}, green}, {{0.5f, 0.1f}, blue}}},
        // Three sides, with a piece that is not painted.
        {"0840C3", 4, {{{0.3f, 0.3f}, blue}, {{0.1f, 0.8f}, red}, {{0.8f, 0.1f}, green}, {{0.1f, 0.1f}, red}}},
        // A cut within a cut, and the piece beside it is cut, too.
        {"0C81840C3",
         6,
         {{{0.4f, 0.3f}, blue},
          {{0.1f, 0.8f}, red},
          {{0.8f, 0.1f}, green},
          {{0.25f, 0.08f}, blue},
          {{0.08f, 0.25f}, green}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_painted("paint_color", cases[i].painting, colors_of_three);
        assert_int_equal(model->triangles_drawn, cases[i].triangles);
        assert_quiet(model);
        for (int k = 0; k < 6 && cases[i].probes[k].color != NULL; k++) {
            assert_floats(color_at(mesh_of(model, 0), cases[i].probes[k].point), cases[i].probes[k].color, 4,
                          0);
        }
        scene_model_free(model);
    }
}

// A triangle beside one that is cut has a corner where that is cut, once and once more.
static void test_cuts_beside(void **state)
{
    (void)state;
    struct scene_model *model =
        load_files("<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\" paint_color=\"4881443\"/>"
                                            "<triangle v1=\"1\" v2=\"3\" v3=\"2\"/>") "</object>",
                   "<item objectid=\"1\"/>", "Metadata/project_settings.config", colors_of_three, NULL, NULL);
    assert_int_equal(model->triangles_drawn, 5 + 3);
    assert_floats(color_at(mesh_of(model, 0), (const float[]){0.8f, 0.9f}), red, 4, 0);
    assert_floats(color_at(mesh_of(model, 0), (const float[]){0.95f, 0.1f}), red, 4, 0);
    assert_floats(color_at(mesh_of(model, 0), (const float[]){0.85f, 0.1f}), green, 4, 0);
    scene_model_free(model);
}

static void test_told(void **state)
{
    (void)state;
    static const struct {
        const char *painting, *colors, *warning;
    } cases[] = {
        {"4", NULL, "names no colour of filament 1: drawn in grey"},
        {"2FC", colors_of_three, "names no colour of filament 20: drawn in grey"},
        {"0C", "{\"filament_colour\": [\"#FF0000\", \"\"]}", "names no colour of filament 3"},
        {"4",
         "{\"filament_colour\": ", "\"Metadata/project_settings.config\" in the archive is not valid JSON"},
        {"1", colors_of_three, "object 1 has a triangle whose painting is damaged: left out"},
        {"C", colors_of_three, "painting is damaged"},
        {"44", colors_of_three, "painting is damaged"},
        {"D", colors_of_three, "painting is damaged"},
        {"4G", colors_of_three, "painting is damaged"},
        {"4444444444444444444444444444444444444444111111111111111111111111111111111111111", colors_of_three,
         "painting is damaged"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_painted("paint_color", cases[i].painting, cases[i].colors);
        assert_int_equal(model->triangles_drawn, 1);
        assert_true(has_warning(model, cases[i].warning));
        scene_model_free(model);
    }
}

// Files beside the model: the last place of colours, what is told of, and what is damaged.
static void test_files(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *unsupported, *warning;
    } cases[] = {
        {"Metadata/slice_info.config",
         "<config><plate><filament id=\"1\" color=\"#0000FF\"/></plate></config>", NULL, NULL},
        {"Materials/pla.xml.fdm_material", "<fdmmaterial/>", "colours of Cura's materials (3MF): not drawn",
         NULL},
        {"Metadata/custom_gcode_per_layer.xml",
         "<a><plate><layer top_z=\"2\" type=\"2\" gcode=\"tool_change\"/></plate></a>",
         "changes of the filament by height (3MF): not drawn", NULL},
        {"Metadata/custom_gcode_per_layer.xml",
         "<a><plate><layer top_z=\"2\" type=\"1\" gcode=\"M601\"/></plate></a>", NULL, NULL},
        {"Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml", "<a><code print_z=\"2\" gcode=\"M600\"/></a>",
         "changes of the filament by height", NULL},
        {"Metadata/Prusa_Slicer_layer_config_ranges.xml",
         "<objects><object id=\"1\"><range><option "
         "opt_key=\"extruder\">2</option></range></object></objects>",
         "changes of the filament by height", NULL},
        {"Metadata/layer_config_ranges.xml",
         "<objects><object id=\"1\"><range><option opt_key=\"extruder\">0</option><option "
         "opt_key=\"layer_height\">2"
         "</option></range></object></objects>",
         NULL, NULL},
        {"Metadata/model_settings.config", "<config>\n<object>", NULL,
         "\"Metadata/model_settings.config\" in the archive, line 2: no element found"},
        {"Metadata/model_settings.config", "<!DOCTYPE a [<!ENTITY a \"aaaa\">]><config/>", NULL,
         "parsing aborted"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model =
            load_files("<object id=\"1\">" MESH(TWO) "</object>", "<item objectid=\"1\"/>", cases[i].name,
                       cases[i].text, NULL, NULL);
        assert_int_equal(model->unsupported_count, cases[i].unsupported != NULL);
        assert_int_equal(model->warning_count, cases[i].warning != NULL);
        assert_true(cases[i].unsupported == NULL || is_unsupported(model, cases[i].unsupported));
        assert_true(cases[i].warning == NULL || has_warning(model, cases[i].warning));
        if (i == 0) {
            assert_color(model, 0, 0, blue);
        }
        scene_model_free(model);
    }
}

// A package without a model says why there is none.
static void test_nothing_drawn(void **state)
{
    (void)state;
    package_write("s.3mf", "<object id=\"1\" type=\"other\">" MESH(TWO) "</object>",
                  "<item objectid=\"1\"/>");
    expect_refused("s.3mf", "has nothing that can be drawn: objects of type \"other\" (3MF): left out");
    zipFile zip = package_begin("s.3mf");
    package_add_model(zip, "3D/3dmodel.model", "", "");
    package_add_text(zip, "Metadata/plate_1.gcode", "G28\n");
    package_end(zip);
    expect_refused("s.3mf", "holds G-code for a printer, and no model");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_bambu_parts),   cmocka_unit_test(test_bambu_roles),
    cmocka_unit_test(test_prusa_volumes), cmocka_unit_test(test_slic3r_and_cura),
    cmocka_unit_test(test_painted),       cmocka_unit_test(test_cuts),
    cmocka_unit_test(test_cuts_beside),   cmocka_unit_test(test_told),
    cmocka_unit_test(test_files),         cmocka_unit_test(test_nothing_drawn),
};

const struct unit_tests test_3mf_slicer = UNIT_TESTS(tests, make_directory, remove_directory);
