// SPDX-License-Identifier: MIT
// What assimp leaves out of the formats that it reads is told: by its own log, and by marks in the file.
#include "model_files.h"

// An entity that assimp has no code for.
static void test_entities(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "e.dxf",
        "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32"
        "\n0\n"
        "13\n0\n23\n1\n33\n0\n  0\r\nCIRCLE\r\n8\n0\n10\n5\n20\n5\n30\n0\n40\n1\n0\nENDSEC\n0\nEOF\n");
    assert_true(is_unsupported(model, "entities CIRCLE (DXF): not drawn"));
    assert_int_equal(model->unsupported_count, 1);
    scene_model_free(model);
}

#define COLLADA                                                                               \
    "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" " \
    "version=\"1.4.1\">"                                                                      \
    "<asset><up_axis>Y_UP</up_axis></asset>"
#define TRIANGLE                                                                                             \
    "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 1 0 0 0 1 "          \
    "0</float_array>"                                                                                        \
    "<technique_common><accessor source=\"#pa\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>" \
    "<param name=\"Y\" type=\"float\"/><param name=\"Z\" "                                                   \
    "type=\"float\"/></accessor></technique_common></source>"                                                \
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"      \
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
#define SCENE(nodes)                                                                            \
    "<library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/>" nodes \
    "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene "              \
    "url=\"#s\"/></scene></COLLADA>"

// A camera that is not there, of which the log says so, and a curve, of which it says nothing.
static void test_log(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("c.dae", COLLADA "<library_geometries>" TRIANGLE
                                   "<geometry id=\"c\"><spline/></geometry></library_geometries>" SCENE(
                                       "<instance_camera url=\"#eye\"/>"));
    assert_true(
        is_unsupported(model, "assimp leaves out: Collada: Unable to find camera for ID \"eye\". Skipping."));
    assert_true(is_unsupported(model, "curves: not drawn"));
    scene_model_free(model);
    model = load_text("c.dae", COLLADA "<library_geometries>" TRIANGLE "</library_geometries>" SCENE(""));
    assert_int_equal(model->unsupported_count + model->warning_count, 0);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_entities),
    cmocka_unit_test(test_log),
};

const struct unit_tests test_gaps = UNIT_TESTS(tests, make_directory, remove_directory);
