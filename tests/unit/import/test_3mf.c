// SPDX-License-Identifier: MIT
// 3MF: packages written here, and what becomes of their colours, textures, components and parts. Values by hand.
#include "package_3mf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// Colours -------------------------------------------------------------------------------------------

// Triangles have the object's property, one of their own, or one for each corner; sRGB 0x80 is 0.2158605 linear.
static void test_colors(void **state)
{
    (void)state;
    struct scene_model *model = package_load(
        "<basematerials id=\"1\"><base name=\"a\" displaycolor=\"#FF0000\"/><base name=\"b\" "
        "displaycolor=\"#00FF0080\"/></basematerials><m:colorgroup id=\"2\"><m:color color=\"#0000ff\"/>"
        "<m:color color=\"#808080\"/></m:colorgroup><object id=\"3\" pid=\"1\" pindex=\"0\" "
        "name=\"thing\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>"
                               "<triangle v1=\"1\" v2=\"3\" v3=\"2\" pid=\"2\" p1=\"0\" p2=\"1\" p3=\"0\"/>"
                               "<triangle v1=\"2\" v2=\"1\" v3=\"0\" p1=\"1\"/>") "</object>",
        "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 10 20 30\"/>");
    assert_int_equal(model->triangles_drawn, 3);
    assert_int_equal(model->instance_count, 2); // opaque and blended
    assert_int_equal(model->up, SCENE_AXIS_Z);
    assert_string_equal(model->instances[0].name, "thing");
    assert_floats(model->instances[0].world + 12, (const float[]){10, 20, 30}, 3, 0);
    const struct scene_mesh *opaque = mesh_of(model, 0), *blended = mesh_of(model, 1);
    assert_int_equal(opaque->index_count, 6);
    assert_floats(opaque->colors[opaque->indices[0]], (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(opaque->colors[opaque->indices[3]], (const float[]){0, 0, 1, 1}, 4, 0);
    const float grey = 0.2158605f;
    assert_floats(opaque->colors[opaque->indices[4]], (const float[]){grey, grey, grey, 1}, 4, 1e-6f);
    assert_floats(opaque->positions[opaque->indices[4]], (const float[]){1, 1, 0}, 3, 0);
    assert_floats(blended->colors[0], (const float[]){0, 1, 0, 128 / 255.0f}, 4, 1e-6f);
    assert_int_equal(model->materials[opaque->material].alpha_mode, SCENE_ALPHA_OPAQUE);
    assert_int_equal(model->materials[blended->material].alpha_mode, SCENE_ALPHA_BLEND);
    assert_floats(model->materials[opaque->material].base_color, (const float[]){1, 1, 1, 1}, 4, 0);
    scene_model_free(model);
}

// CAD programs export opaque parts with an alpha of 00. A corner that fades to nothing stays as it is.
static void test_alpha_zero(void **state)
{
    (void)state;
    struct scene_model *model = package_load(
        "<basematerials id=\"1\"><base displaycolor=\"#FF000000\"/></basematerials>"
        "<m:colorgroup id=\"2\"><m:color color=\"#0000ff00\"/><m:color color=\"#0000ffff\"/></m:colorgroup>"
        "<object id=\"3\" pid=\"1\" pindex=\"0\">" MESH(
            "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>"
                                                      "<object id=\"4\">" MESH(
                                                          "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"2\" "
                                                          "p1=\"0\" p2=\"1\" p3=\"0\"/>") "</object>",
        "<item objectid=\"3\"/><item objectid=\"4\"/>");
    assert_int_equal(model->warning_count, 1);
    assert_true(has_warning(model, "object 3 has a wholly transparent colour: drawn opaque"));
    assert_floats(mesh_of(model, 0)->colors[0], (const float[]){1, 0, 0, 1}, 4, 0);
    assert_int_equal(model->materials[mesh_of(model, 0)->material].alpha_mode, SCENE_ALPHA_OPAQUE);
    assert_floats(mesh_of(model, 1)->colors[0], (const float[]){0, 0, 1, 0}, 4, 0);
    assert_int_equal(model->materials[mesh_of(model, 1)->material].alpha_mode, SCENE_ALPHA_BLEND);
    scene_model_free(model);
}

// An extension that the file requires and nobody here knows.
static void test_required(void **state)
{
    (void)state;
    zipFile zip = package_begin("x.3mf");
    package_add_text(
        zip, "3D/3dmodel.model",
        "<model xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
        "xmlns:i=\"http://example.org/implicit\" requiredextensions=\"p i\"><resources><object "
        "id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object></resources><build><item "
                                                                   "objectid=\"1\"/></build></model>");
    package_end(zip);
    struct scene_model *model = load("x.3mf");
    assert_int_equal(model->unsupported_count, 1);
    assert_true(is_unsupported(
        model, "the extension \"http://example.org/implicit\" (3MF), which the file requires"));
    scene_model_free(model);
}

// Without a property, what is not described anywhere: a light grey.
static void test_plain(void **state)
{
    (void)state;
    struct scene_model *model =
        package_load("<object id=\"3\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                     "<item objectid=\"3\"/>");
    const struct scene_material *material = &model->materials[mesh_of(model, 0)->material];
    assert_floats(material->base_color, (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    scene_model_free(model);
}

static void test_metal_and_composites(void **state)
{
    (void)state;
    struct scene_model *model = package_load(
        "<basematerials id=\"1\"><base displaycolor=\"#FF0000\" displaypropertiesid=\"9\"/><base "
        "displaycolor=\"#0000FF\"/></basematerials>"
        "<m:compositematerials id=\"2\" matid=\"1\" matindices=\"0 1\"><m:composite values=\"1 3\"/>"
        "</m:compositematerials><m:pbmetallicdisplayproperties id=\"9\"><m:pbmetallic name=\"m\" "
        "metallicness=\"1\" "
        "roughness=\"0.25\"/></m:pbmetallicdisplayproperties><object id=\"3\">" MESH(
            "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"1\" p1=\"0\"/>"
            "<triangle v1=\"1\" v2=\"3\" v3=\"2\" pid=\"2\" p1=\"0\"/>") "</object>",
        "<item objectid=\"3\"/>");
    assert_int_equal(model->instance_count, 2);
    const struct scene_material *metal = &model->materials[mesh_of(model, 0)->material];
    assert_floats(&metal->metallic, (const float[]){1}, 1, 0);
    assert_floats(&metal->roughness, (const float[]){0.25f}, 1, 0);
    assert_floats(mesh_of(model, 1)->colors[0], (const float[]){0.25f, 0, 0.75f, 1}, 4, 1e-6f);
    scene_model_free(model);
}

// Textures ------------------------------------------------------------------------------------------

// A TGA of 1×1 or 2×1 texels with alpha, bottom up, BGRA.
static size_t make_tga(unsigned char *bytes, int width, const unsigned char *texels)
{
    memset(bytes, 0, 18);
    bytes[2] = 2;
    bytes[12] = (unsigned char)width;
    bytes[14] = 1;
    bytes[16] = 32;
    bytes[17] = 8;
    memcpy(bytes + 18, texels, (size_t)width * 4);
    return 18 + (size_t)width * 4;
}

static void write_textured(const char *properties, const char *triangle)
{
    char resources[24576];
    unsigned char tga[64];
    snprintf(
        resources, sizeof resources,
        "<basematerials id=\"1\"><base displaycolor=\"#FF0000\"/></basematerials>"
        "<m:texture2d id=\"2\" path=\"/3D/Textures/A.tga\" tilestyleu=\"clamp\" tilestylev=\"mirror\" "
        "filter=\"nearest\"/><m:texture2dgroup id=\"4\" texid=\"2\"><m:tex2coord u=\"0.25\" v=\"0.125\"/>"
        "<m:tex2coord u=\"1\" v=\"0\"/><m:tex2coord u=\"0\" v=\"1\"/></m:texture2dgroup>"
        "<m:texture2d id=\"5\" path=\"3D/Textures/b.tga\"/><m:texture2dgroup id=\"6\" texid=\"5\">"
        "<m:tex2coord u=\"0.25\" v=\"0.125\"/><m:tex2coord u=\"1\" v=\"0\"/><m:tex2coord u=\"0\" v=\"1\"/>"
        "</m:texture2dgroup>%s<object id=\"7\">" MESH("%s") "</object>",
        properties, triangle);
    zipFile zip = package_begin("x.3mf");
    package_add_relationships(zip);
    package_add_model(zip, "3D/3dmodel.model", resources, "<item objectid=\"7\"/>");
    // Opaque green and transparent; half blue.
    size_t size = make_tga(tga, 2, (const unsigned char[]){0, 255, 0, 255, 0, 255, 0, 0});
    package_add(zip, "3d/textures/a.tga", tga, size);
    size = make_tga(tga, 1, (const unsigned char[]){255, 0, 0, 128});
    package_add(zip, "3D/Textures/b.tga", tga, size);
    package_end(zip);
}

static void test_texture(void **state)
{
    (void)state;
    write_textured("", "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"4\" p1=\"0\" p2=\"1\" p3=\"2\"/>");
    struct scene_model *model = load("x.3mf");
    assert_int_equal(model->warning_count, 0);
    const struct scene_mesh *mesh = mesh_of(model, 0);
    const struct scene_texture_slot *slot = &model->materials[mesh->material].slots[SCENE_SLOT_BASE_COLOR];
    assert_int_equal(slot->image, 0);
    assert_int_equal(slot->address_u, RHW_ADDRESS_CLAMP);
    assert_int_equal(slot->address_v, RHW_ADDRESS_MIRROR);
    assert_int_equal(slot->mag_filter, RHW_FILTER_NEAREST);
    assert_floats(mesh->uvs[0][mesh->indices[0]], (const float[]){0.25f, 0.875f}, 2, 0);
    assert_int_equal(model->images[0].width, 2);
    scene_model_free(model);
}

// Half blue over green or nothing over red: by hand, in linear light.
static void test_layers(void **state)
{
    (void)state;
    write_textured("<m:multiproperties id=\"8\" pids=\"1 6 4\"><m:multi pindices=\"0 0 0\"/><m:multi "
                   "pindices=\"0 1 1\"/>"
                   "<m:multi pindices=\"0 2 2\"/></m:multiproperties>",
                   "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"8\" p1=\"0\" p2=\"1\" p3=\"2\"/>");
    struct scene_model *model = load("x.3mf");
    const struct scene_mesh *mesh = mesh_of(model, 0);
    const struct scene_material *material = &model->materials[mesh->material];
    const struct scene_image *image = &model->images[material->slots[SCENE_SLOT_BASE_COLOR].image];
    const uint8_t *texels = image->texels;
    assert_int_equal(image->width, 2);
    assert_memory_equal(texels, ((const uint8_t[]){0, 255, 0, 255}), 4);
    // 0.498 red and 0.502 blue in linear light are 187 and 188 (0x80 of 255 is 0.50196).
    assert_memory_equal(texels + 4, ((const uint8_t[]){187, 0, 188, 255}), 4);
    assert_floats(mesh->colors[0], (const float[]){1, 1, 1, 1}, 4, 0);
    scene_model_free(model);
}

// Of textures above each other two are drawn, where they stand in the same place: a third, and one that stands elsewhere,
// hide what is at the bottom.
static void test_stack(void **state)
{
    (void)state;
    static const struct {
        const char *pids, *places;
        bool is_told;
    } cases[] = {{"4 6", "0 0", false}, {"4 6", "0 1", true}, {"4 6 4", "0 0 0", true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char properties[256];
        snprintf(properties, sizeof properties,
                 "<m:multiproperties id=\"8\" pids=\"%s\"><m:multi pindices=\"%s\"/></m:multiproperties>",
                 cases[i].pids, cases[i].places);
        write_textured(properties, "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"8\" p1=\"0\"/>");
        struct scene_model *model = load("x.3mf");
        assert_int_equal(model->unsupported_count, cases[i].is_told);
        assert_true(is_unsupported(model, "textures above others (3MF): those at the bottom are left out") ==
                    cases[i].is_told);
        scene_model_free(model);
    }
}

// A texture over each of 80 colours: the first 64 get an image of their own, the others show the texture alone.
static void test_many_colors_below(void **state)
{
    (void)state;
    enum { COLORS = 80, LAYERED = 64 };
    static char properties[8192], triangles[8192];
    size_t at = (size_t)snprintf(properties, sizeof properties, "<m:colorgroup id=\"9\">"), end = 0;
    for (int i = 0; i < COLORS; i++) {
        at += (size_t)snprintf(properties + at, sizeof properties - at, "<m:color color=\"#%02X0000\"/>", i);
    }
    at += (size_t)snprintf(properties + at, sizeof properties - at,
                           "</m:colorgroup><m:multiproperties id=\"8\" pids=\"9 4\">");
    for (int i = 0; i < COLORS; i++) {
        at += (size_t)snprintf(properties + at, sizeof properties - at, "<m:multi pindices=\"%d 0\"/>", i);
        end += (size_t)snprintf(triangles + end, sizeof triangles - end,
                                "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"8\" p1=\"%d\"/>", i);
    }
    snprintf(properties + at, sizeof properties - at, "</m:multiproperties>");
    write_textured(properties, triangles);
    struct scene_model *model = load("x.3mf");
    assert_int_equal(model->image_count, LAYERED + 1);
    assert_int_equal(model->triangles_drawn, COLORS);
    assert_int_equal(model->unsupported_count, 1);
    assert_string_equal(model->unsupported[0], "what lies below textures: in 64 colours alone");
    scene_model_free(model);
}

static void test_multiplied(void **state)
{
    (void)state;
    write_textured(
        "<m:multiproperties id=\"8\" pids=\"1 4\" blendmethods=\"multiply\"><m:multi pindices=\"0 0\"/>"
        "</m:multiproperties>",
        "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"8\" p1=\"0\"/>");
    struct scene_model *model = load("x.3mf");
    const struct scene_mesh *mesh = mesh_of(model, 0);
    assert_int_equal(model->image_count, 1);
    assert_floats(mesh->colors[0], (const float[]){1, 0, 0, 1}, 4, 0);
    assert_floats(mesh->uvs[0][0], (const float[]){0.25f, 0.875f}, 2, 0);
    scene_model_free(model);
    // Of a list that is far longer than its layers, the first word alone is the first layer's.
    char properties[1024];
    int at =
        snprintf(properties, sizeof properties, "<m:multiproperties id=\"8\" pids=\"1 4\" blendmethods=\"");
    for (int i = 0; i < 64; i++) {
        at += snprintf(properties + at, sizeof properties - (size_t)at, "mix ");
    }
    snprintf(properties + at, sizeof properties - (size_t)at,
             "multiply\"><m:multi pindices=\"0 0\"/></m:multiproperties>");
    write_textured(properties, "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"8\" p1=\"0\"/>");
    model = load("x.3mf");
    assert_floats(mesh_of(model, 0)->colors[0], (const float[]){1, 1, 1, 1}, 4, 0);
    scene_model_free(model);
}

// A path that is wrong but for its end, or is written as other formats write it.
static void test_moved_texture(void **state)
{
    (void)state;
    static const char *const paths[] = {"./Textures/a b.tga", "\\3D\\Textures\\a b.tga",
                                        "/3D/Textures/a%20b.tga", "Textures/a%20b.tga?v=3"};
    unsigned char tga[64];
    const size_t size = make_tga(tga, 1, (const unsigned char[]){255, 0, 0, 128});
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        char resources[1024];
        zipFile zip = package_begin("x.3mf");
        snprintf(
            resources, sizeof resources,
            "<m:texture2d id=\"2\" path=\"%s\"/><m:texture2dgroup id=\"4\" texid=\"2\"><m:tex2coord u=\"0\" "
            "v=\"0\"/></m:texture2dgroup><object id=\"3\" pid=\"4\" pindex=\"0\">" MESH(
                "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
            paths[i]);
        package_add_model(zip, "3D/3dmodel.model", resources, "<item objectid=\"3\"/>");
        package_add(zip, "3D/Textures/A B.TGA", tga, size);
        package_end(zip);
        struct scene_model *model = load("x.3mf");
        assert_int_equal(model->warning_count, 0);
        assert_int_equal(model->images[0].width, 1);
        scene_model_free(model);
    }
}

// Outside of a texture that is not repeated, what lies below it shows: a grey if nothing does.
static void test_decal(void **state)
{
    (void)state;
    static const char *const properties[] = {
        "", "<m:multiproperties id=\"8\" pids=\"1 4\"><m:multi pindices=\"0 0\"/></m:multiproperties>"};
    static const float borders[2][4] = {{0.6f, 0.6f, 0.6f, 1}, {1, 0, 0, 1}};
    for (int i = 0; i < 2; i++) {
        char resources[4096];
        unsigned char tga[64];
        snprintf(resources, sizeof resources,
                 "<basematerials id=\"1\"><base name=\"a\" displaycolor=\"#FF0000\"/></basematerials>"
                 "<m:texture2d id=\"2\" path=\"/3D/a.tga\" tilestyleu=\"none\" tilestylev=\"none\"/>"
                 "<m:texture2dgroup id=\"4\" texid=\"2\"><m:tex2coord u=\"3\" v=\"2\"/></m:texture2dgroup>%s"
                 "<object id=\"7\" pid=\"%d\" pindex=\"0\">" MESH(
                     "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                 properties[i], i == 0 ? 4 : 8);
        zipFile zip = package_begin("x.3mf");
        package_add_relationships(zip);
        package_add_model(zip, "3D/3dmodel.model", resources, "<item objectid=\"7\"/>");
        package_add(zip, "3D/a.tga", tga, make_tga(tga, 1, (const unsigned char[]){0, 255, 0, 255}));
        package_end(zip);
        struct scene_model *const model = load("x.3mf");
        const struct scene_mesh *const mesh = mesh_of(model, 0);
        const struct scene_texture_slot *const slot =
            &model->materials[mesh->material].slots[SCENE_SLOT_BASE_COLOR];
        assert_int_equal(slot->address_u, RHW_ADDRESS_BORDER);
        assert_floats(slot->border, borders[i], 4, 1e-5f);
        scene_model_free(model);
    }
}

static void test_missing_texture(void **state)
{
    (void)state;
    struct scene_model *model =
        package_load("<m:texture2d id=\"2\" path=\"/3D/none.png\"/><m:texture2dgroup id=\"4\" "
                     "texid=\"2\"><m:tex2coord u=\"0\" "
                     "v=\"0\"/></m:texture2dgroup><object id=\"3\" pid=\"4\" pindex=\"0\">" MESH(
                         "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                     "<item objectid=\"3\"/>");
    assert_true(has_warning(model, "\"3D/none.png\": is not in the archive"));
    scene_model_free(model);
}

// Components ----------------------------------------------------------------------------------------

// A component of a component, in another part of the package: places multiply, and a mesh is kept once.
static void test_components(void **state)
{
    (void)state;
    zipFile zip = package_begin("x.3mf");
    package_add_relationships(zip);
    package_add_model(
        zip, "3D/3dmodel.model",
        "<object id=\"2\"><components><component p:path=\"/3D/Objects/part.model\" objectid=\"1\" "
        "transform=\"2 0 0 0 2 0 0 0 2 1 0 0\"/><component objectid=\"3\"/></components></object>"
        "<object id=\"3\"><components><component p:path=\"/3D/Objects/part.model\" objectid=\"1\"/>"
        "</components></object>",
        "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/>");
    // The unit is that of the part that the package begins with. What another part builds is not built.
    package_add_text(
        zip, "3D/Objects/part.model",
        "<model unit=\"inch\"><resources><object id=\"1\">" MESH(
            "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object></resources>"
                                                      "<build><item objectid=\"1\"/></build></model>");
    package_end(zip);
    struct scene_model *model = load("x.3mf");
    assert_string_equal(model->unit, "millimeter");
    assert_int_equal(model->instance_count, 2);
    assert_int_equal(model->mesh_count, 1);
    assert_int_equal(model->instances[0].object, 1);
    assert_int_equal(model->instances[1].object, 1);
    // (1, 0, 0) after the component is (3, 0, 0); the item turns x to y and lifts.
    const float *world = model->instances[0].world;
    const float point[3] = {world[0] + world[12], world[1] + world[13], world[2] + world[14]};
    assert_floats(point, (const float[]){0, 3, 5}, 3, 0);
    scene_model_free(model);
}

static void test_circle(void **state)
{
    (void)state;
    package_write("x.3mf", "<object id=\"1\"><components><component objectid=\"1\"/></components></object>",
                  "<item objectid=\"1\"/>");
    expect_refused("x.3mf", "object 1: its components are nested too deeply or in a circle");
}

// Which of the two is meant would be left to chance.
static void test_two_of_one_id(void **state)
{
    (void)state;
    package_write(
        "x.3mf",
        "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>"
                                                                           "<object id=\"1\">" MESH(
                                                                               "<triangle v1=\"0\" v2=\"2\" "
                                                                               "v3=\"1\"/>") "</object>",
        "<item objectid=\"1\"/>");
    expect_refused("x.3mf", "has two objects with id 1");
}

static void test_empty_relationships(void **state)
{
    (void)state;
    zipFile zip = package_begin("x.3mf");
    package_add(zip, "_rels/.rels", "", 0);
    package_add_model(zip, "3D/3dmodel.model",
                      "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                      "<item objectid=\"1\"/>");
    package_end(zip);
    struct scene_model *model = load("x.3mf");
    assert_int_equal(model->instance_count, 1);
    scene_model_free(model);
}

// The package begins with the part that its relationships name, in either kind of quotes.
static void test_named_part(void **state)
{
    (void)state;
    static const char type[] = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
    for (int i = 0; i < 2; i++) {
        const char quote = i == 0 ? '"' : '\'';
        char text[512];
        snprintf(text, sizeof text,
                 "<Relationships><Relationship Target=%c/a.png%c Type=%cthumbnail%c/>"
                 "<Relationship Target=%c/3D/other.model%c Type=%c%s%c/></Relationships>",
                 quote, quote, quote, quote, quote, quote, quote, type, quote);
        zipFile zip = package_begin("x.3mf");
        package_add_text(zip, "_rels/.rels", text);
        package_add_model(zip, "3D/3dmodel.model", "", "");
        package_add_model(zip, "3D/other.model",
                          "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                          "<item objectid=\"1\"/>");
        package_end(zip);
        struct scene_model *model = load("x.3mf");
        assert_int_equal(model->triangles_drawn, 1);
        assert_int_equal(model->unsupported_count, 0);
        scene_model_free(model);
    }
}

// A package has one model. Of several the first is drawn, and a second relationship to it is none.
static void test_two_models(void **state)
{
    (void)state;
    static const char *const targets[] = {"/3D/a.model", "/3D/b.model"};
    for (int i = 0; i < 2; i++) {
        static const char type[] = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
        char text[512];
        snprintf(text, sizeof text,
                 "<Relationships><Relationship\n Target=\"/3D/a.model\" Type=\"%s\"/>"
                 "<Relationship\tTarget=\"%s\" Type=\"%s\"/></Relationships>",
                 type, targets[i], type);
        zipFile zip = package_begin("x.3mf");
        package_add_text(zip, "_rels/.rels", text);
        for (int k = 0; k < 2; k++) {
            package_add_model(zip, targets[k] + 1,
                              "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                              "<item objectid=\"1\"/>");
        }
        package_end(zip);
        struct scene_model *model = load("x.3mf");
        assert_int_equal(model->triangles_drawn, 1);
        assert_true(is_unsupported(model, "several models in the package: the first alone is drawn") == i);
        scene_model_free(model);
    }
}

static void test_missing_object(void **state)
{
    (void)state;
    package_write("x.3mf", "", "<item objectid=\"1\"/>");
    struct scene_model *model = load("x.3mf");
    assert_int_equal(model->instance_count, 0);
    assert_true(has_warning(model, "object 1, which is to be built, is not there: left out"));
    scene_model_free(model);
}

// 2 to the power of 40 triangles in 40 lines.
static void test_too_many(void **state)
{
    (void)state;
    char resources[8192] = "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>";
    for (int i = 2; i < 42; i++) {
        sprintf(resources + strlen(resources),
                "<object id=\"%d\"><components><component objectid=\"%d\"/><component objectid=\"%d\"/>"
                "</components></object>",
                i, i - 1, i - 1);
    }
    package_write("x.3mf", resources, "<item objectid=\"41\"/>");
    expect_refused("x.3mf", "stand for more than 1048576 objects");
}

static void test_beams(void **state)
{
    (void)state;
    struct scene_model *model = package_load(
        "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
        "</vertices><triangles/><b:beamlattice><b:beams><b:beam v1=\"0\" "
        "v2=\"1\"/></b:beams></b:beamlattice></mesh>"
        "</object>",
        "<item objectid=\"1\"/>");
    assert_int_equal(mesh_of(model, 0)->primitive, SCENE_PRIMITIVE_LINES);
    assert_int_equal(mesh_of(model, 0)->index_count, 2);
    assert_true(is_unsupported(model, "thickness of beams"));
    scene_model_free(model);
}

static void test_no_build(void **state)
{
    (void)state;
    struct scene_model *model =
        package_load("<object id=\"3\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>", "");
    assert_int_equal(model->instance_count, 1);
    assert_true(has_warning(model, "its build lists nothing"));
    scene_model_free(model);
}

// Refusals ------------------------------------------------------------------------------------------

static void test_bad_xml(void **state)
{
    (void)state;
    static const struct {
        const char *resources, *cause;
    } cases[] = {
        {"<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"4\"/>") "</object>",
         "a triangle's v1, v2 and v3 must be vertices of its mesh"},
        {"<object id=\"1\"><mesh><vertices><vertex x=\"1\" y=\"a\" z=\"0\"/></vertices></mesh></object>",
         "a vertex needs x, y and z"},
        {"<m:colorgroup id=\"1\"><m:color color=\"red\"/></m:colorgroup>",
         "a color must be #RRGGBB or #RRGGBBAA"},
        {"<basematerials id=\"1\"><base displaycolor=\"FF000000\"/></basematerials>",
         "a displaycolor must be #RRGGBB or #RRGGBBAA"},
        {"<object id=\"-1\"></object>", "is not a whole number from 0 to 2147483647"},
        {"<object>", "\"3D/3dmodel.model\", line 1: mismatched tag"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        package_write("x.3mf", cases[i].resources, "<item objectid=\"1\"/>");
        expect_refused("x.3mf", cases[i].cause);
    }
}

static void test_doctype(void **state)
{
    (void)state;
    static const char bomb[] =
        "<!DOCTYPE model [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><model>&b;</model>";
    zipFile zip = package_begin("x.3mf");
    package_add(zip, "3D/3dmodel.model", bomb, strlen(bomb)); // found without relationships
    package_end(zip);
    expect_refused("x.3mf", "a document type is not allowed");
}

// A part that is encrypted is refused for that, and not for what its bytes would mean.
static void test_encrypted(void **state)
{
    (void)state;
    zipFile zip = package_begin("x.3mf");
    package_add(zip, "3D/3dmodel.model", "%3McF\0\0\0\x0c\0\0\0<?xml", 17);
    package_end(zip);
    expect_refused("x.3mf", "\"3D/3dmodel.model\" in the archive is encrypted");
}

static size_t read_package(unsigned char *bytes, size_t most)
{
    FILE *file = fopen(path_of("x.3mf"), "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, most, file);
    fclose(file);
    return size;
}

// An archive that claims 4 GiB, and one that claims a terabyte in the field for it, are refused at once.
static void test_claims(void **state)
{
    (void)state;
    static unsigned char bytes[16384];
    const clock_t start = clock();
    package_write("x.3mf", "<object id=\"1\"></object>", "");
    const size_t size = read_package(bytes, sizeof bytes);
    size_t entry = 0; // the last of the central directory
    for (size_t i = 0; i + 4 < size; i++) {
        entry = memcmp(bytes + i, "PK\1\2", 4) == 0 ? i : entry;
    }
    memcpy(bytes + entry + 24, (const unsigned char[]){0xfe, 0xff, 0xff, 0xff}, 4);
    write_bytes("x.3mf", bytes, size);
    expect_refused("x.3mf", "claims to be 4294967294 bytes made of");
    // The 64-bit extra field: its id, 8 bytes, and the size 2^40.
    static const unsigned char extra[] = {1, 0, 8, 0, 0, 0, 0, 0, 0, 1, 0, 0};
    const size_t name = bytes[entry + 28], after = entry + 46 + name;
    memcpy(bytes + entry + 24, (const unsigned char[]){0xff, 0xff, 0xff, 0xff}, 4);
    bytes[entry + 30] = sizeof extra;
    memmove(bytes + after + sizeof extra, bytes + after, size - after);
    memcpy(bytes + after, extra, sizeof extra);
    bytes[after + sizeof extra + 12] =
        (unsigned char)(bytes[after + sizeof extra + 12] + sizeof extra); // its size
    write_bytes("x.3mf", bytes, size + sizeof extra);
    expect_refused("x.3mf", "at most 2147483648, and 1032 times what it is made of, are read");
    assert_true((double)(clock() - start) / CLOCKS_PER_SEC < 0.5);
}

// Rewrites the archive x.3mf so that its central directory has all sizes and places in extra fields (ZIP64), behind
// another extra field.
static void widen(void)
{
    static unsigned char old[16384], bytes[32768];
    static const unsigned char head[] = {0x99, 0x99, 1, 0, 7, 1, 0, 24, 0};
    const size_t size = read_package(old, sizeof old), end = size - 22;
    const size_t first = old[end + 16] | (size_t)old[end + 17] << 8;
    size_t at = first, out = first;
    memcpy(bytes, old, first);
    while (memcmp(old + at, "PK\1\2", 4) == 0) {
        const size_t length = 46u + old[at + 28];
        memcpy(bytes + out, old + at, length);
        bytes[out + 30] = sizeof head + 24;
        memcpy(bytes + out + length, head, sizeof head);
        static const int fields[] = {24, 20, 42};
        for (size_t i = 0; i < 3; i++) {
            memset(bytes + out + fields[i], 0xff, 4);
            memcpy(bytes + out + length + sizeof head + 8 * i, old + at + fields[i], 4);
            memset(bytes + out + length + sizeof head + 8 * i + 4, 0, 4);
        }
        out += length + sizeof head + 24;
        at += length;
    }
    memcpy(bytes + out, old + end, 22);
    bytes[out + 12] = (unsigned char)(out - first);
    bytes[out + 13] = (unsigned char)((out - first) >> 8);
    write_bytes("x.3mf", bytes, out + 22);
}

static void test_zip64(void **state)
{
    (void)state;
    write_textured("", "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"4\" p1=\"0\" p2=\"1\" p3=\"2\"/>");
    widen();
    struct scene_model *model = load("x.3mf");
    assert_int_equal(model->warning_count, 0);
    assert_int_equal(model->triangles_drawn, 1);
    assert_int_equal(model->images[0].width, 2);
    scene_model_free(model);
}

// Cut anywhere, it is one line.
static void test_cut(void **state)
{
    (void)state;
    static unsigned char bytes[16384];
    package_write("x.3mf", "<object id=\"1\">" MESH("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>") "</object>",
                  "<item objectid=\"1\"/>");
    const size_t size = read_package(bytes, sizeof bytes);
    for (size_t cut = 1; cut < size; cut += 37) {
        write_bytes("x.3mf", bytes, cut);
        expect_refused("x.3mf", "is cut or no ZIP archive");
    }
    const size_t first = 30 + strlen("_rels/.rels") + 20; // within the first entry's data
    bytes[first] = (unsigned char)~bytes[first];
    write_bytes("x.3mf", bytes, size);
    expect_refused("x.3mf", "\"_rels/.rels\" in the archive is damaged");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_encrypted),
    cmocka_unit_test(test_colors),
    cmocka_unit_test(test_alpha_zero),
    cmocka_unit_test(test_required),
    cmocka_unit_test(test_plain),
    cmocka_unit_test(test_metal_and_composites),
    cmocka_unit_test(test_texture),
    cmocka_unit_test(test_layers),
    cmocka_unit_test(test_stack),
    cmocka_unit_test(test_multiplied),
    cmocka_unit_test(test_decal),
    cmocka_unit_test(test_missing_texture),
    cmocka_unit_test(test_moved_texture),
    cmocka_unit_test(test_components),
    cmocka_unit_test(test_circle),
    cmocka_unit_test(test_too_many),
    cmocka_unit_test(test_many_colors_below),
    cmocka_unit_test(test_two_of_one_id),
    cmocka_unit_test(test_empty_relationships),
    cmocka_unit_test(test_two_models),
    cmocka_unit_test(test_named_part),
    cmocka_unit_test(test_missing_object),
    cmocka_unit_test(test_beams),
    cmocka_unit_test(test_no_build),
    cmocka_unit_test(test_bad_xml),
    cmocka_unit_test(test_doctype),
    cmocka_unit_test(test_claims),
    cmocka_unit_test(test_zip64),
    cmocka_unit_test(test_cut),
};

const struct unit_tests test_3mf = UNIT_TESTS(tests, make_directory, remove_directory);
