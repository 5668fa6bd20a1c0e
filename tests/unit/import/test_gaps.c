// SPDX-License-Identifier: MIT
// What assimp leaves out of the formats that it reads is told: by its own log, and by marks in the file.
#include "model_files.h"

#include <stdio.h>
#include <inttypes.h>
#include <string.h>

#define SECTION(name, pairs) "0\nSECTION\n2\n" name "\n" pairs "0\nENDSEC\n"
#define FACE(pairs)                                                                                         \
    "0\n3DFACE\n" pairs "10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n13\n0\n23\n1\n33\n" \
    "0\n"
#define LAYER(pairs) SECTION("TABLES", "0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nl\n" pairs "0\nENDTAB\n")

// Entities that assimp has no code for, whatever they are, and entities that it draws though they are hidden.
static void test_entities(void **state)
{
    (void)state;
    static const struct {
        const char *text, *told;
    } cases[] = {
        {SECTION("ENTITIES", FACE("8\n0\n") "  0\r\nSPLINE\r\n8\n0\n10\n5\n20\n5\n30\n0\n40\n1\n"),
         "entities SPLINE (DXF): not drawn"},
        {SECTION("ENTITIES", FACE("") "0\nMULTILEADER\n8\n0\n"), "entities MULTILEADER (DXF): not drawn"},
        {SECTION("BLOCKS", "0\nBLOCK\n2\nb\n0\nATTDEF\n0\nHATCH\n0\nENDBLK\n") SECTION("ENTITIES", FACE("")),
         "entities HATCH (DXF): not drawn"},
        {SECTION("ENTITIES", FACE("") "0\nVIEWPORT\n67\n1\n") SECTION("OBJECTS", "0\nDICTIONARY\n67\n1\n"),
         NULL},
        {SECTION("ENTITIES", FACE("") "0\nCIRCLE\n39\n2\n10\n0\n20\n0\n30\n0\n40\n2\n"),
         "the thickness of entities (DXF): drawn without"},
        {SECTION("ENTITIES", FACE("60\n1\n")), "hidden objects: drawn"},
        {SECTION("ENTITIES", FACE("67\n1\n")), "entities of sheets (DXF): drawn among those of the model"},
        {LAYER("70\n0\n62\n-7\n") SECTION("ENTITIES", FACE("8\nl\n")),
         "layers that are off or frozen (DXF): drawn"},
        {LAYER("70\n1\n62\n7\n") SECTION("ENTITIES", FACE("8\nl\n")),
         "layers that are off or frozen (DXF): drawn"},
        {LAYER("70\n4\n62\n7\n") SECTION("ENTITIES", FACE("8\nl\n")), NULL},
        {LAYER("70\n1\n62\n7\n") SECTION("ENTITIES", FACE("8\nL2\n")), NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_format("e.dxf", "%s0\nEOF\n", cases[i].text);
        struct scene_model *const model = load("e.dxf");
        assert_true(model->triangles_drawn > 0);
        if (model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("%zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
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
                                       "<instance_camera url=\"#eye\"/><instance_geometry url=\"#c\"/>"));
    assert_true(
        is_unsupported(model, "assimp leaves out: Collada: Unable to find camera for ID \"eye\". Skipping."));
    assert_true(is_unsupported(model, "curves: not drawn"));
    scene_model_free(model);
    model = load_text("c.dae", COLLADA "<library_geometries>" TRIANGLE "</library_geometries>" SCENE(""));
    assert_int_equal(model->unsupported_count + model->warning_count, 0);
    scene_model_free(model);
}

// A texture of half its strength, and coordinates of three numbers.
static void test_textures(void **state)
{
    (void)state;
    static const char *const thirds[] = {"0", "0.5"}, *const strengths[] = {"1", "0.5"};
    for (int i = 0; i < 2; i++) {
        char text[8192];
        snprintf(
            text, sizeof text,
            COLLADA
            "<library_images><image id=\"i\"><init_from>gone.png</init_from></image></library_images>"
            "<library_effects><effect id=\"e\"><profile_COMMON><newparam sid=\"f\"><surface type=\"2D\">"
            "<init_from>i</init_from></surface></newparam><newparam sid=\"s\"><sampler2D><source>f</source>"
            "</sampler2D></newparam><technique sid=\"c\"><phong><diffuse><texture texture=\"s\" "
            "texcoord=\"UV\"><extra><technique "
            "profile=\"OKINO\"><weighting>%s</weighting></technique></extra>"
            "</texture></diffuse></phong></technique></profile_COMMON></effect></library_effects>"
            "<library_materials><material id=\"m\"><instance_effect "
            "url=\"#e\"/></material></library_materials>"
            "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" "
            "count=\"9\">0 0 %s 1 0 0 0 1 0</float_array><technique_common><accessor source=\"#pa\" "
            "count=\"3\" "
            "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param "
            "name=\"Z\" type=\"float\"/></accessor></technique_common></source><source id=\"q\"><float_array "
            "id=\"qa\" count=\"9\">0 0 %s 1 0 0 0 1 0</float_array><technique_common><accessor "
            "source=\"#qa\" "
            "count=\"3\" stride=\"3\"><param name=\"S\" type=\"float\"/><param name=\"T\" type=\"float\"/>"
            "<param name=\"P\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\">"
            "<input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\" material=\"s\">"
            "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><input semantic=\"TEXCOORD\" "
            "source=\"#q\" offset=\"0\" set=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
            "</library_geometries><library_visual_scenes><visual_scene id=\"s0\"><node><instance_geometry "
            "url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" target=\"#m\"/>"
            "</technique_common></bind_material></instance_geometry></node></visual_scene>"
            "</library_visual_scenes><scene><instance_visual_scene url=\"#s0\"/></scene></COLLADA>",
            strengths[i], thirds[i], thirds[i]);
        struct scene_model *const model = load_text("c.dae", text);
        assert_true(is_unsupported(model, "texture coordinates of three numbers: the third is not used") ==
                    i);
        assert_true(is_unsupported(model, "textures of less than their whole strength: drawn whole") == i);
        assert_int_equal(model->unsupported_count, 2 * (unsigned)i);
        scene_model_free(model);
    }
}

#define SOURCE(id, width, params, numbers)                                                            \
    "<source id=\"" id "\"><float_array id=\"" id "a\" count=\"" width "\">" numbers "</float_array>" \
    "<technique_common><accessor source=\"#" id "a\" count=\"3\" stride=\"" params "</accessor>"      \
    "</technique_common></source>"
#define TWO "2\"><param name=\"S\" type=\"float\"/><param name=\"T\" type=\"float\"/>"
#define THREE                                                                                    \
    "3\"><param name=\"R\" type=\"float\"/><param name=\"G\" type=\"float\"/><param name=\"B\" " \
    "type=\"float\"/>"
#define FOUR                                                                                     \
    "4\"><param name=\"R\" type=\"float\"/><param name=\"G\" type=\"float\"/><param name=\"B\" " \
    "type=\"float\"/>"                                                                           \
    "<param name=\"A\" type=\"float\"/>"
#define INPUT(semantic, source, set) \
    "<input semantic=\"" semantic "\" source=\"#" source "\" offset=\"0\" set=\"" set "\"/>"
#define UVS SOURCE("t", "6", TWO, "0 0 1 0 0 1")

// What a triangle of Collada may have beside its positions.
static void test_vertices(void **state)
{
    (void)state;
    static const struct {
        const char *sources, *inputs, *slot, *set, *told;
    } cases[] = {
        {SOURCE("c", "12", FOUR, "1 0 0 1 0 1 0 0.5 0 0 1 1"), INPUT("COLOR", "c", "0"), "diffuse", "0",
         "alpha of vertex colours: not used"},
        {SOURCE("c", "9", THREE, "1 0 0 0 1 0 0 0 1"), INPUT("COLOR", "c", "0") INPUT("COLOR", "c", "1"),
         "diffuse", "0", "vertex colours beyond the first set: ignored"},
        {UVS, INPUT("TEXCOORD", "t", "0") INPUT("TEXCOORD", "t", "1") INPUT("TEXCOORD", "t", "2"), "diffuse",
         "2", "texture coordinate set 2: set 0 is read instead"},
        {UVS, INPUT("TEXCOORD", "t", "0"), "specular", "0", "specular textures: not used"},
        {UVS, INPUT("TEXCOORD", "t", "0"), "ambient", "0", "light textures: not used"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[8192];
        snprintf(
            text, sizeof text,
            COLLADA
            "<library_images><image id=\"i\"><init_from>gone.png</init_from></image></library_images>"
            "<library_effects><effect id=\"e\"><profile_COMMON><newparam sid=\"f\"><surface "
            "type=\"2D\"><init_from>i</init_from></surface></newparam><newparam sid=\"s\"><sampler2D>"
            "<source>f</source></sampler2D></newparam><technique sid=\"c\"><phong><%s><texture "
            "texture=\"s\" texcoord=\"UV\"/></%s></phong></technique></profile_COMMON></effect>"
            "</library_effects><library_materials><material id=\"m\"><instance_effect url=\"#e\"/>"
            "</material></library_materials><library_geometries><geometry id=\"g\"><mesh>" SOURCE(
                "p", "9", THREE,
                "0 0 0 1 0 0 0 1 0") "%s<vertices id=\"v\"><input "
                                     "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\" "
                                     "material=\"s\">"
                                     "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>%s<p>0 1 "
                                     "2</p></triangles></mesh>"
                                     "</geometry></library_geometries><library_visual_scenes><visual_scene "
                                     "id=\"z\"><node>"
                                     "<instance_geometry "
                                     "url=\"#g\"><bind_material><technique_common><instance_material "
                                     "symbol=\"s\" target=\"#m\"><bind_vertex_input semantic=\"UV\" "
                                     "input_semantic=\"TEXCOORD\" "
                                     "input_set=\"%s\"/></instance_material></technique_common>"
                                     "</bind_material></instance_geometry></node></visual_scene></"
                                     "library_visual_scenes><scene>"
                                     "<instance_visual_scene url=\"#z\"/></scene></COLLADA>",
            cases[i].slot, cases[i].slot, cases[i].sources, cases[i].inputs, cases[i].set);
        struct scene_model *const model = load_text("c.dae", text);
        if (!is_unsupported(model, cases[i].told) || model->unsupported_count != 1) {
            fail_msg("%s: %u lines", cases[i].told, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

#define EFFECT(profile, look)                                                                            \
    COLLADA "<library_effects><effect id=\"e\"><" profile "><technique sid=\"c\"><phong>" look           \
            "</phong></technique></" profile "></effect></library_effects><library_geometries>" TRIANGLE \
            "</library_geometries>" SCENE("")
#define BLEND(mode)                                                                                        \
    "<diffuse><texture texture=\"s\" texcoord=\"UV\"><extra><technique profile=\"MAYA\"><blend_mode>" mode \
    "</blend_mode></technique></extra></texture></diffuse>"
#define TRANSPARENT(mode, what) "<transparent opaque=\"" mode "\">" what "</transparent>"

// What assimp reads of effects and nodes of Collada, and loses.
static void test_collada(void **state)
{
    (void)state;
    static const struct {
        const char *text, *told;
    } cases[] = {
        {EFFECT("profile_COMMON", TRANSPARENT("RGB_ZERO", "<color>1 0 0 1</color>")),
         "colours of transparency: not used"},
        {EFFECT("profile_COMMON", TRANSPARENT("RGB_ONE", "<color>1 1 0 1</color>")),
         "colours of transparency: not used"},
        {EFFECT("profile_COMMON", TRANSPARENT("RGB_ZERO", "<color>1 1 1 1</color>")), NULL},
        {EFFECT("profile_COMMON", TRANSPARENT("A_ONE", "<color>1 0 0 1</color>")), NULL},
        {EFFECT("profile_COMMON", TRANSPARENT("A_ZERO", "<texture texture=\"s\" texcoord=\"UV\"/>")),
         "inverted textures: drawn as they are"},
        {EFFECT("profile_COMMON", TRANSPARENT("A_ONE", "<texture texture=\"s\" texcoord=\"UV\"/>")), NULL},
        {EFFECT("profile_COMMON", BLEND("ADD")), "the blend mode ADD of textures (Collada): not used"},
        {EFFECT("profile_COMMON", BLEND(" OVER ")), "the blend mode OVER of textures (Collada): not used"},
        {EFFECT("profile_COMMON", BLEND("NONE")), NULL},
        {EFFECT("profile_COMMON", BLEND("MULTIPLY")), NULL},
        {EFFECT("profile_CG", ""), "materials that are programs alone (Collada): drawn plain"},
        {COLLADA "<library_geometries>" TRIANGLE "</library_geometries>" SCENE(
             "<extra><technique profile=\"FCOLLADA\"><visibility>0</visibility></technique></extra>"),
         "hidden nodes: drawn"},
        {COLLADA "<library_geometries>" TRIANGLE "</library_geometries>" SCENE(
             "<extra><technique profile=\"FCOLLADA\"><visibility>1</visibility></technique></extra>"),
         NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene_model *const model = load_text("c.dae", cases[i].text);
        if (model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("%zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

#define PLY_HEAD   "ply\nformat ascii 1.0\n"
#define PLY_PLACE  "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_COLORS "property uchar red\nproperty uchar green\nproperty uchar blue\n"
#define PLY_FACE   "element face 1\nproperty list uchar int vertex_indices\n"

#define X_FILE(mesh, material)                                                                              \
    "xof 0303txt 0032\nMesh {\n 3;\n 0.0;0.0;0.0;,\n 1.0;0.0;0.0;,\n 0.0;1.0;0.0;;\n 1;\n 3;0,1,2;;\n" mesh \
    " MeshMaterialList {\n  1;\n  1;\n  0;\n  Material {\n   1.0;0.0;0.0;0.25;;\n   5.0;\n   "              \
    "0.0;0.0;0.0;;\n"                                                                                       \
    "   0.0;0.0;0.0;;\n" material "  }\n }\n}\n"

// What assimp has of a material and does not call by the usual name: the alpha of a face of DirectX, and the colour of
// NFF.
static void test_materials(void **state)
{
    (void)state;
    struct scene_model *model = load_text("a.x", X_FILE("", ""));
    assert_floats(model->materials[model->meshes[0].material].base_color, (const float[]){1, 0, 0, 0.25f}, 4,
                  1e-6f);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
    model = load_text("a.nff", "f 1 0 0 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n");
    assert_floats(model->materials[model->meshes[0].material].base_color, (const float[]){1, 0, 0, 1}, 4,
                  1e-6f);
    scene_model_free(model);
}

#define GLTF_TRIANGLE(attributes)                                                                           \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{"  \
    "\"primitives\":[{\"attributes\":{\"POSITION\":0" attributes "}}]}],\"accessors\":[{\"bufferView\":0,"  \
    "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":" \
    "36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"                  \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}"

#define AC3D(lines)                                                                                         \
    "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n" \
    "OBJECT poly\nname \"p\"\n" lines "numvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x20\nmat 0\n"       \
    "refs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n"

// What other readers leave out.
static void test_texts(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *told;
    } cases[] = {
        {"t.ply",
         PLY_HEAD PLY_PLACE PLY_COLORS PLY_FACE PLY_COLORS
         "end_header\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2 1 2 3\n",
         "colours of faces (PLY): not drawn, as its vertices have colours"},
        {"t.ply",
         PLY_HEAD "comment TextureFile a.png\ncomment TextureFile b.png\n" PLY_PLACE
                  "property float s\nproperty float t\n" PLY_FACE
                  "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
         "textures after the first (PLY): no face has the number of one"},
        {"t.x", X_FILE(" FVFData { 0; 0; }\n", ""),
         "assimp leaves out: Unknown data object in mesh in x file"},
        {"t.x", X_FILE("", "   EffectInstance { \"a.fx\"; }\n"),
         "assimp leaves out: Unknown data object in material in x file"},
        {"t.off", "COFF\n3 1 0\n0 0 0 9 9 9 255\n1 0 0 9 9 9 255\n0 1 0 9 9 9 255\n3 0 1 2 1 2 3\n",
         "colours of faces (OFF): not drawn, as its vertices have colours"},
        {"t.stl",
         "solid a\nfacet normal 0 0 1\ncolor 1 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
         "endloop\nendfacet\nendsolid a\n",
         "colours in text (STL): not drawn"},
        {"t.dxf",
         "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n90\n2\n70\n0\n43\n0."
         "5\n10\n0\n20\n0\n10\n2\n20\n0\n0\nENDSEC\n"
         "0\nEOF\n",
         "the width of polylines (DXF): drawn as lines"},
        {"t.ply",
         PLY_HEAD PLY_PLACE "property uint rgb\n" PLY_FACE "end_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n",
         "property \"rgb\" (PLY): not drawn"},
        {"t.ply",
         PLY_HEAD PLY_PLACE "property uchar Red\n" PLY_FACE
                            "property float predicted\nend_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2 5\n",
         "property \"Red\" (PLY): not drawn"},
        {"t.ply",
         PLY_HEAD PLY_PLACE PLY_FACE
         "property uchar face_color\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5\n",
         "property \"face_color\" (PLY): not drawn"},
        {"t.stl",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nshine "
         "2\n"
         "endfacet\nendsolid a\n",
         "\"shine\" has no meaning (STL): its lines are left out"},
        {"t.nff", "f 1 0 0 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\nk 1\n", "\"k\" has no meaning (NFF)"},
        {"t.nff", "b 1 0 0\nf 1 0 0 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n# none\n",
         "the background: not drawn"},
        {"t.ac", AC3D("hidden\n"), "hidden objects: drawn"},
        {"t.ac", AC3D("data 4\nhide\nshader a\n"),
         "\"shader\" has no meaning (AC3D): its lines are left out"},
        {"t.ac", AC3D("texture \"a.png\" base\ntexture \"b.png\" ormap\n"),
         "textures above each other: the last alone is used"},
        {"t.gltf", GLTF_TRIANGLE(",\"_COLOR\":0,\"COLOUR_0\":0"), "attribute \"COLOUR_0\": ignored"},
        {"t.gltf", GLTF_TRIANGLE(",\"COLOR_0\":0,\"COLOR_1\":0"),
         "a second set of vertex colours (COLOR_1): ignored"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *const model = load_text(cases[i].name, cases[i].text);
        if (!is_unsupported(model, cases[i].told) || model->unsupported_count != 1) {
            fail_msg("%s: %u lines", cases[i].told, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

#define X3D(marks)                                                                                    \
    "<?xml version=\"1.0\"?><X3D version=\"3.0\"><Scene><Shape><IndexedFaceSet coordIndex=\"0 1 2 "   \
    "-1\"><Coordinate point=\"0 0 0 1 0 0 0 1 0\"/></IndexedFaceSet></Shape><WorldInfo title='" marks \
    "'/></Scene></X3D>"
#define AMF(marks)                                                                                           \
    "<?xml version=\"1.0\"?><amf unit=\"millimeter\"><object id=\"1\"><mesh><vertices><vertex><coordinates>" \
    "<x>0</x><y>0</y><z>0</z></coordinates></vertex><vertex><coordinates><x>1</x><y>0</y><z>0</z></"         \
    "coordinates>"                                                                                           \
    "</vertex><vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></"                        \
    "vertices><volume><triangle>"                                                                            \
    "<v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object><metadata type='" marks "'/></amf>"

#define PARTS                                                                                     \
    "<mesh><vertices id=\"w\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles " \
    "count=\"1\">"                                                                                \
    "<input semantic=\"VERTEX\" source=\"#w\" offset=\"0\"/><p>0 1 2</p></triangles></mesh>"
#define INSTANCE(id) "<instance_geometry url=\"#" id "\"/>"
// A geometry c beside a triangle, other libraries, and instances.
#define GEOMETRY(parts, libraries, instances)                           \
    COLLADA "<library_geometries>" TRIANGLE "<geometry id=\"c\">" parts \
            "</geometry></library_geometries>" libraries                \
            SCENE(instances)

static void append(unsigned char *bytes, size_t *size, const void *more, size_t count)
{
    memcpy(bytes + *size, more, count);
    *size += count;
}

// A model of 3D GameStudio, whose texture has a name that assimp keeps without the 0 at its end: a triangle.
static void test_gamestudio(void **state)
{
    (void)state;
    static const char texture[] = "wall.bmp";
    static const int32_t skin[2] = {sizeof texture, 1}, counts[5] = {1, 3, 1, 3, 1}, material = 0;
    static const float coordinates[3][2] = {{0, 0}, {1, 0}, {0, 1}}, normal[3] = {0, 0, 1},
                       places[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const uint16_t face[6] = {0, 1, 2, 0, 1, 2}, no_bone = UINT16_MAX,
                          sizes[10] = {36, 28, 16, 68, 8, 16, 26, 26, 68, 24};
    unsigned char bytes[512] = {0};
    const int32_t head[7] = {0x374c444d, 0, 0, 1, 0, 0, 0}, data = 0;
    size_t size = 0;
    append(bytes, &size, head, sizeof head);
    append(bytes, &size, sizes, sizeof sizes);
    append(bytes, &size, "\1\0\0\0", 4); // the group
    append(bytes, &size, &data, sizeof data);
    append(bytes, &size, "group\0\0\0\0\0\0\0\0\0\0\0", 16);
    append(bytes, &size, counts, sizeof counts);
    append(bytes, &size, "\7\0\0\0", 4); // its skin
    append(bytes, &size, skin, sizeof skin);
    append(bytes, &size, "skin\0\0\0\0\0\0\0\0\0\0\0\0", 16);
    append(bytes, &size, texture, sizeof texture);
    append(bytes, &size, coordinates, sizeof coordinates);
    append(bytes, &size, face, sizeof face);
    append(bytes, &size, &material, sizeof material);
    for (int i = 0; i < 3; i++) {
        append(bytes, &size, places[i], sizeof places[i]);
        append(bytes, &size, &no_bone, sizeof no_bone);
        append(bytes, &size, normal, sizeof normal);
    }
    write_bytes("g.mdl", bytes, size + 24); // a frame without vertices
    struct scene_model *const model = load("g.mdl");
    assert_int_equal(model->triangles_drawn, 1);
    assert_string_equal(model->images[0].name, texture);
    scene_model_free(model);
}

// Words of formats that assimp passes over without a word in its log.
static void test_words(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *told;
    } cases[] = {
        {"w.x3d", X3D("<Text"), "text: not drawn"},
        {"w.x3d", X3D("<NurbsCurve"), "NURBS: not drawn"},
        {"w.x3d", X3D("<GeoOrigin"), "geospatial nodes: not drawn"},
        {"w.x3d", X3D("<HAnimSite"), "humanoids: not drawn"},
        {"w.x3d", X3D("<ProtoInstance"), "prototypes: not drawn"},
        {"w.x3d", X3D("<VolumeData"), "volumes: not drawn"},
        {"w.x3d", X3D("<PixelTexture"), "textures in the file: not drawn"},
        {"w.x3d", X3D("<MovieTexture"), "films: not drawn"},
        {"w.x3d", X3D("<MultiTexture"), "textures above each other: not drawn"},
        {"w.x3d", X3D("<Background"), "the background: not drawn"},
        {"w.x3d", X3D("<Fog"), "fog: not drawn"},
        {"w.x3d", X3D("<ParticleSystem"), "particles: not drawn"},
        {"w.x3d", X3D("<RigidBodyCollection"), "rigid bodies: not drawn"},
        {"w.x3d", X3D("<LayerSet"), "layers: not drawn"},
        {"w.amf", AMF("<composite"), "composite materials: not drawn"},
        {"w.amf", AMF("<edge"), "curved edges: not drawn"},
        {"w.x3d", X3D("<!-- <Text -->"), NULL},
        {"w.amf", AMF("<!-- <edge -->"), NULL},
        {"w.dae", GEOMETRY("<brep/>", "", INSTANCE("c")), "boundary representations: not drawn"},
        {"w.dae", GEOMETRY("<brep/>", "", ""), NULL},
        {"w.dae", GEOMETRY("<brep/><spline/>", "<library_physics_models/>", INSTANCE("c")),
         "boundary representations: not drawn"},
        {"w.dae", GEOMETRY("<nurbs></nurbs>", "", INSTANCE("c")), "NURBS: not drawn"},
        {"w.dae", GEOMETRY("<convex_mesh convex_hull_of=\"#g\"/>", "", INSTANCE("c")),
         "convex hulls of meshes: not drawn"},
        {"w.dae", GEOMETRY("<convex_mesh convex_hull_of=\"#g\"/>", "", "<!-- " INSTANCE("c") " -->"), NULL},
        {"w.dae", GEOMETRY("<!-- <convex_mesh convex_hull_of=\"#g\"/> -->" PARTS, "", INSTANCE("c")), NULL},
        {"w.dae",
         GEOMETRY(
             "<convex_mesh convex_hull_of=\"#g\"/>",
             "<library_physics_models><physics_model id=\"m\"><rigid_body "
             "sid=\"b\"><technique_common><shape>" INSTANCE(
                 "c") "</shape></technique_common></rigid_body></physics_model></library_physics_models>",
             ""),
         NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene_model *const model = load_text(cases[i].name, cases[i].text);
        const char *const told = cases[i].told;
        if (model->unsupported_count != (told != NULL) || (told != NULL && !is_unsupported(model, told))) {
            fail_msg("case %zu, %s: %s", i, cases[i].name, told);
        }
        scene_model_free(model);
    }
}

// Faces of an ASE that refer to what is not there, in any of its lists and any of its meshes.
static void test_ase(void **state)
{
    (void)state;
    static const char plain[] =
        "*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1 BC: 1 CA: 9 *MESH_SMOOTHING 9 *MESH_MTLID 0";
    static const struct {
        const char *face, *coordinates, *colors, *cause;
    } cases[] = {
        {plain, "0\t0\t1\t1", "0 0 0 0", NULL},
        {"*MESH_FACE    0:    A:    0 B:    3 C:    2", "0 0 0 0", "0 0 0 0",
         "line 13: face 0 refers to vertex 3; the mesh has 3, counted from 0"},
        {"*MESH_FACE 7: A:-1 B:2 C:2", "0 0 0 0", "0 0 0 0",
         "line 13: face 7 refers to vertex -1; the mesh has 3, counted from 0"},
        {plain, "4 0 0 2", "0 0 0 0",
         "line 22: face 4 refers to texture coordinate 2; the mesh has 2, counted from 0"},
        {"x *MESH_FACE 0: A: 0 B: 3 C: 2", "0 0 0 0", "0 0 0 0",
         "line 13: face 0 refers to vertex 3; the mesh has 3, counted from 0"},
        {"*MESH_TFACE 0 0 0 0\n*MESH_FACE 0: A: 0 B: 1 C: 2", "1 0 0 0", "0 0 0 0",
         "a mesh has 1 faces, of which 0 say their texture coordinates"},
        {plain, "1 0 0 0", "0 0 0 0", "a mesh has 1 faces, of which 0 say their texture coordinates"},
        {plain, "0 0 0 0", "1 0 0 0", "a mesh has 1 faces, of which 0 say their colours"},
        {"", "0 0 0 0", "0 0 0 0", "a mesh should have 1 faces and has 0"},
        {"*MESH_FACE 0: C:2 A:0 B: 1", "0 0 0 0", "0 0 0 0", NULL},
        {"*MESH_FACE 0: A: 0z B: 1 C: 2 AB: 1", "0 0 0 0", "0 0 0 0", "a mesh should have 1 faces and has 0"},
        {"*MESH_FACE 0:\x10 A: 0 B: 1 C: 2", "0 0 0 0", "0 0 0 0", "a mesh should have 1 faces and has 0"},
        {"*MESH_FACE 0: 0 B: 1 C: 2 AB: 1", "0 0 0 0", "0 0 0 0", "a mesh should have 1 faces and has 0"},
        {"*MESH_FACE 0: A: 0 B: 1 A: 2", "0 0 0 0", "0 0 0 0", "a mesh should have 1 faces and has 0"},
        {"*MESH_FACE 1: A: 0 B: 1 C: 2", "0 0 0 0", "0 0 0 0", "a mesh should have 1 faces and has 0"},
        {"*MESH_NUMVERTEX 4", "0 0 0 0", "0 0 0 0", "line 13: a mesh says two numbers of its vertex list"},
        {plain, "0 0 0 0\n*MESH_NUMTVFACES 2", "0 0 0 0",
         "line 23: a mesh says two numbers of its texture coordinate list"},
        {plain, "0 0 0 0", "0 1 0 0", "line 30: face 0 refers to colour 1; the mesh has 1, counted from 0"},
    };
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const char *const cause = cases[i / 2].cause;
        const char *const name = i % 4 < 2 ? "a.ase" : "a.foo"; // known by its first words, too
        write_format(
            name,
            "*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n*NODE_NAME \"a\"\n*MESH {\n*MESH_NUMVERTEX 3\n"
            "*MESH_NUMFACES 1\n*MESH_VERTEX_LIST {\n*MESH_VERTEX 0 0 0 0\n*MESH_VERTEX 1 1 0 0\n"
            "*MESH_VERTEX 2 0 1 0\n}\n*MESH_FACE_LIST {\n%s\n}\n*MESH_NUMTVERTEX 2\n*MESH_TVERTLIST {\n"
            "*MESH_TVERT 0 0 0 0\n*MESH_TVERT 1 1 0 0\n}\n*MESH_NUMTVFACES 1\n*MESH_TFACELIST {\n"
            "*MESH_TFACE %s\n}\n*MESH_NUMCVERTEX 1\n*MESH_CVERTLIST {\n*MESH_VERTCOL 0 1 0 0\n}\n"
            "*MESH_NUMCVFACES 1\n*MESH_CFACELIST {\n*MESH_CFACE %s\n}\n}\n}\n%s",
            cases[i / 2].face, cases[i / 2].coordinates, cases[i / 2].colors,
            i % 2 == 0
                ? ""
                : "*GEOMOBJECT {\n*NODE_NAME \"b\"\n*MESH {\n*MESH_NUMVERTEX 9\n*MESH_NUMTVERTEX 9\n}\n}\n");
        if (cause != NULL) {
            expect_refused(name, cause);
            continue;
        }
        struct scene_model *const model = load(name);
        assert_int_equal(model->triangles_drawn, 1);
        scene_model_free(model);
    }
}

// Faces of an ASE as programs write them: in either case, with blanks or without, and in any order. One that stands
// twice counts once, as it stands last.
static void test_ase_faces(void **state)
{
    (void)state;
    static const struct {
        const char *faces, *cause;
    } cases[] = {
        {"*MESH_FACE 0:A:0 B:1 C:2\n*MESH_FACE 1: A:0B:1C:2", NULL},
        {"*MESH_FACE 0 : A: 0 B: 1 C: 2\n*MESH_FACE 1 A : 0 B : 1 C : 2", NULL},
        {"*MESH_FACE 0: a: 0 b: 1 c: 2\n*MESH_FACE\t1:\tc:0\ta:1\tb:2", NULL},
        {"*MESH_FACE 1: A: 0 B: 1 C: 2\n*MESH_FACE 0: A: 0 B: 1 C: 2", NULL},
        {"*MESH_FACE 1: A: 0 B: 1 C: 2\n*MESH_FACE 1: A: 0 B: 1 C: 2",
         "a mesh should have 2 faces and has 1"},
        {"*MESH_FACE 0: A: 0 B: 1 C: 2\n*MESH_FACE 2: A: 0 B: 1 C: 2",
         "a mesh should have 2 faces and has 1"},
        {"*MESH_FACE 0: A: 0 B: 1 C: 2\n*MESH_FACE 1: A: 0 B: 1 C: 2\n*MESH_FACE 0: A: 0",
         "a mesh should have 2 faces and has 1"},
        {"*MESH_FACE 0: A: 0\n*MESH_FACE 0: A: 0 B: 1 C: 2\n*MESH_FACE 1: A: 0 B: 1 C: 2", NULL},
        {"*MESH_FACE 0: A: 0 B: 1 C: 2\n*MESH_FACE 1: A 0 B: 1 C: 2", "a mesh should have 2 faces and has 1"},
        {"*MESH_FACE 0:A:0 B:1 C:2\n*MESH_FACE 1:A:0 B:1 C:3",
         "line 14: face 1 refers to vertex 3; the mesh has 3, counted from 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("f.ase",
                     "*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n*NODE_NAME \"a\"\n*MESH {\n*MESH_NUMVERTEX 3\n"
                     "*MESH_NUMFACES 2\n*MESH_VERTEX_LIST {\n*MESH_VERTEX 0 0 0 0\n*MESH_VERTEX 1 1 0 0\n"
                     "*MESH_VERTEX 2 0 1 0\n}\n*MESH_FACE_LIST {\n%s\n}\n}\n}\n",
                     cases[i].faces);
        if (cases[i].cause != NULL) {
            expect_refused("f.ase", cases[i].cause);
            continue;
        }
        struct scene_model *const model = load("f.ase");
        if (model->triangles_drawn != 2) {
            fail_msg("case %zu: %" PRIu64 " triangles", i, (uint64_t)model->triangles_drawn);
        }
        scene_model_free(model);
    }
}

// A mesh of an AMF that says nothing of colours is grey, as all that is not described.
static void test_no_colors(void **state)
{
    (void)state;
    struct scene_model *const model = load_text("w.amf", AMF(""));
    const struct scene_mesh *const mesh = &model->meshes[0];
    assert_null(mesh->colors);
    assert_floats(model->materials[mesh->material].base_color, (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    scene_model_free(model);
}

// A camera and a light that cannot be, and a light of a kind that is not drawn.
static void test_cameras_and_lights(void **state)
{
    (void)state;
    struct scene_model *const model = load_text(
        "c.dae", COLLADA
        "<library_cameras><camera id=\"eye\" "
        "name=\"eye\"><optics><technique_common><perspective><xfov>270</xfov>"
        "<aspect_ratio>1</aspect_ratio><znear>1</znear><zfar>9</zfar></perspective></technique_common></"
        "optics>"
        "</camera></library_cameras><library_lights><light id=\"dark\" "
        "name=\"dark\"><technique_common><point>"
        "<color>0 0 0</color></point></technique_common></light><light id=\"all\"><technique_common><ambient>"
        "<color>1 1 1</color></ambient></technique_common></light></library_lights>"
        "<library_geometries>" TRIANGLE "</library_geometries>" SCENE(
            "<instance_camera url=\"#eye\"/><instance_light url=\"#dark\"/><instance_light url=\"#all\"/>"));
    assert_true(has_warning(model, "camera \"$ColladaAutoName$_0\" is not valid: left out"));
    assert_true(has_warning(model, "light \"$ColladaAutoName$_0\" gives no light: left out"));
    assert_true(is_unsupported(model, "ambient and area lights: left out"));
    assert_int_equal(model->camera_count + model->light_count, 0);
    scene_model_free(model);
}

// Number of lines of all meshes. Set the bounds of the model in the plane of the drawing.
static uint32_t count_lines(const struct scene_model *model, float size[2])
{
    uint32_t lines = 0;
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        lines += model->meshes[i].primitive == SCENE_PRIMITIVE_LINES ? model->meshes[i].index_count / 2 : 0;
    }
    size[0] = model->bounds_max[0] - model->bounds_min[0];
    size[1] = model->bounds_max[2] - model->bounds_min[2];
    return lines;
}

// Polylines with arcs, circles and solids, alone in their files. A circle has 64 lines.
static void test_drawings(void **state)
{
    (void)state;
    static const struct {
        const char *entity;
        uint32_t lines, triangles;
        float size[2];
    } cases[] = {
        {"LWPOLYLINE\n90\n3\n70\n1\n10\n0\n20\n0\n10\n2\n20\n0\n10\n2\n20\n3\n", 3, 0, {2, 3}},
        {"LWPOLYLINE\n90\n2\n70\n0\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n", 32, 0, {2, 1}},
        {"POLYLINE\n66\n1\n70\n0\n0\nVERTEX\n10\n0\n20\n0\n30\n0\n0\nVERTEX\n10\n4\n20\n0\n30\n0\n0\n"
         "VERTEX\n10\n4\n20\n1\n30\n0\n0\nSEQEND\n",
         2,
         0,
         {4, 1}},
        {"CIRCLE\n62\n1e20\n70\n-1e20\n10\n7\n20\n8\n30\n0\n40\n2\n", 64, 0, {4, 4}},
        {"CIRCLE\n10\n7\n20\n8\n30\n0\n40\n2\n210\n0\n220\n0\n230\n-1\n", 64, 0, {4, 4}},
        {"ARC\n10\n7\n20\n8\n30\n0\n40\n2\n50\n270\n51\n90\n", 32, 0, {2, 4}},
        {"ELLIPSE\n10\n0\n20\n0\n30\n0\n11\n0\n21\n3\n31\n0\n40\n0.5\n", 64, 0, {3, 6}},
        {"SOLID\n10\n0\n20\n0\n11\n4\n21\n0\n12\n0\n22\n1\n13\n4\n23\n1\n", 0, 2, {4, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        float size[2];
        write_format("d.dxf", "0\nSECTION\n2\nENTITIES\n0\n%s0\nENDSEC\n0\nEOF\n", cases[i].entity);
        struct scene_model *model = load("d.dxf");
        assert_int_equal(count_lines(model, size), cases[i].lines);
        assert_int_equal(model->triangles_drawn, cases[i].triangles);
        assert_floats(size, cases[i].size, 2, 1e-5f);
        assert_int_equal(model->unsupported_count, 0);
        scene_model_free(model);
    }
    write_text("d.dxf", "0\nSECTION\n2\nENTITIES\n0\nHATCH\n8\n0\n0\nENDSEC\n0\nEOF\n");
    expect_refused("d.dxf", "has nothing that can be drawn: entities HATCH (DXF): not drawn");
}

// A schema that assimp does not know is named where assimp refuses a file.
static void test_schema(void **state)
{
    (void)state;
    static const char text[] = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
                               "FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA (('%s'));\nENDSEC;\nDATA;\n"
                               "ENDSEC;\nEND-ISO-10303-21;\n";
    write_format("x.ifc", text, "IFC4X3");
    expect_refused("x.ifc", "; assimp knows IFC2X3, and this is IFC4X3");
    write_format("x.ifc", text, "IFC2X3");
    expect_refused("x.ifc", "missing IfcProject entity");
    write_text("x.dae", "<?xml version=\"1.0\"?><COLLADA xmlns=\"a\" version=\"1.3.1\"></COLLADA>");
    expect_refused("x.dae", "; assimp knows Collada 1.4 and 1.5, and this is 1.3.1");
}

// Numbers of the log, of which one may be hexadecimal, do not make several lines of one.
static void test_meshes_without_faces(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "x.fbx", "; FBX 7.4.0 project file\n"
                 "FBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
                 "Objects:  {\n"
                 "\tGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
                 "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
                 "\t\tPolygonVertexIndex: *0 {\n\t\t\ta: \n\t\t}\n\t\tGeometryVersion: 124\n\t}\n"
                 "\tGeometry: 12, \"Geometry::\", \"NurbsCurve\" {\n\t\tNurbsCurveVersion: 100\n\t}\n"
                 "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n"
                 "}\n"
                 "Connections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n}\n");
    assert_int_equal(model->instance_count, 0);
    assert_true(is_unsupported(model, "encountered mesh with no faces"));
    assert_true(is_unsupported(model, "NURBS curves: not drawn"));
    scene_model_free(model);
}

// Values that cannot be as they are, and what is missing.
static void test_warnings(void **state)
{
    (void)state;
    static const char places[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    static const char *const cases[][3] = {
        {"a.obj", "vn 0 0 0\nf 1//1 2//1 3//1\n", "has normals of no length; they are made from its faces"},
        {"a.obj", "usemtl z\nf 1 2 3\n", "material \"z\" is in no library"},
        {"a.obj", "mtllib a.mtl\nusemtl m\nf 1 2 3\n", "material \"m\" is wholly transparent: drawn opaque"},
        {"a.obj", "mtllib a.mtl\nusemtl m\nf 1 2 3\n",
         "lacks the texture coordinates its material \"m\" reads"},
        {"a.obj", "mtllib e.mtl\nusemtl e\nvt 0 0\nf 1/1 2/1 3/1\n",
         "texture \"e.jpg\": has no mark at its end: it may be cut"},
    };
    static const char endless[] =
        "\xff\xd8\xff\xdb\0\x43\0\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1"
        "\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\xff\xc0\0\x0b\x08\0\x08\0\x08"
        "\1\1\x11\0\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xff\xc4\0\x14\x10\1\0\0\0\0\0\0\0\0\0"
        "\0\0\0\0\0\0\0\xff\xda\0\x08\1\1\0\0\x3f\0\x3f"; // one grey block
    write_text("e.mtl", "newmtl e\nmap_Kd e.jpg\n");
    write_bytes("e.jpg", endless, sizeof endless - 1);
    write_text("a.mtl", "newmtl m\nd 0\nmap_Kd a.ppm\n");
    write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_format(cases[i][0], "%s%s", places, cases[i][1]);
        struct scene_model *const model = load(cases[i][0]);
        if (!has_warning(model, cases[i][2])) {
            fail_msg("%s", cases[i][2]);
        }
        scene_model_free(model);
    }
    struct scene_model *model = load_text(
        "a.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
                  "\"meshes\":[{\"primitives\":[{\"attributes\":{}}]}]}");
    assert_true(has_warning(model, "meshes[0].primitives[0] has no positions: not drawn"));
    scene_model_free(model);
    static const char triangle[] = GLTF_TRIANGLE("},\"material\":0,\"extras\":{");
    write_format("a.gltf", "{\"materials\":[{\"name\":\"m\",\"alphaMode\":\"mask\"}],%s", triangle + 1);
    model = load("a.gltf");
    assert_true(has_warning(model, "material \"m\" has an alphaMode that does not exist: drawn opaque"));
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_warnings),
    cmocka_unit_test(test_vertices),
    cmocka_unit_test(test_ase),
    cmocka_unit_test(test_ase_faces),
    cmocka_unit_test(test_gamestudio),
    cmocka_unit_test(test_no_colors),
    cmocka_unit_test(test_materials),
    cmocka_unit_test(test_texts),
    cmocka_unit_test(test_entities),
    cmocka_unit_test(test_drawings),
    cmocka_unit_test(test_schema),
    cmocka_unit_test(test_meshes_without_faces),
    cmocka_unit_test(test_log),
    cmocka_unit_test(test_textures),
    cmocka_unit_test(test_collada),
    cmocka_unit_test(test_words),
    cmocka_unit_test(test_cameras_and_lights),
};

const struct unit_tests test_gaps = UNIT_TESTS(tests, make_directory, remove_directory);
