// SPDX-License-Identifier: MIT
// Collada as it is written: white space at the ends of texts, texture coordinates that are bound by names, and packages.
#include "model_files.h"
#include "package_3mf.h"

#include <math.h>
#include <stdio.h>
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

// Makes the document with `blanks` at both ends of its texts.
static void make_document(const char *blanks, char text[8192])
{
    char *out = text;
    for (const char *c = DOCUMENT; *c != 0; c++) {
        if (*c == '[' || *c == ']') {
            memcpy(out, blanks, strlen(blanks));
            out += strlen(blanks);
        } else {
            *out++ = *c;
        }
    }
    *out = 0;
}

static void write_document(const char *blanks)
{
    char text[8192];
    make_document(blanks, text);
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

// Write a triangle with these texture coordinates (inputs of `<triangles>`), whose texture names them and binds them.
// The first coordinates of source #k are 0.25 k, 0.5.
static void write_sets(const char *inputs, const char *name, const char *binding)
{
    char text[8192], sources[2048] = "", *out = sources;
    for (int k = 1; k <= 2; k++) {
        out += sprintf(
            out,
            "<source id=\"t%d\"><float_array id=\"ta%d\" count=\"2\">%g 0.5</float_array>"
            "<technique_common><accessor source=\"#ta%d\" count=\"1\" stride=\"2\"><param name=\"S\" "
            "type=\"float\"/><param name=\"T\" type=\"float\"/></accessor></technique_common></source>",
            k, k, 0.25 * k, k);
    }
    const int size = snprintf(
        text, sizeof text,
        "<COLLADA version=\"1.4.1\"><library_images><image id=\"i\"><init_from>gone.png</init_from></image>"
        "</library_images><library_effects><effect id=\"e\"><profile_COMMON><newparam sid=\"f\"><surface "
        "type=\"2D\"><init_from>i</init_from></surface></newparam><newparam "
        "sid=\"s\"><sampler2D><source>f</source>"
        "</sampler2D></newparam><technique sid=\"c\"><phong><diffuse><texture texture=\"s\" texcoord = '%s'/>"
        "</diffuse></phong></technique></profile_COMMON></effect></"
        "library_effects><library_materials><material "
        "id=\"m\"><instance_effect url=\"#e\"/></material></library_materials><library_geometries><geometry "
        "id=\"g\">"
        "<mesh><source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 1 0 0 0 1 "
        "0</float_array><technique_common>"
        "<accessor source=\"#pa\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param "
        "name=\"Y\" "
        "type=\"float\"/><param name=\"Z\" "
        "type=\"float\"/></accessor></technique_common></source>%s<vertices id=\"v\">"
        "<input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\" material=\"s\"><input "
        "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>%s<p>0 0 1 0 2 0</p></triangles></mesh></geometry>"
        "</library_geometries><library_visual_scenes><visual_scene id=\"s0\"><node><instance_geometry "
        "url=\"#g\">"
        "<bind_material><technique_common><instance_material symbol=\"s\" "
        "target=\"#m\">%s</instance_material>"
        "</technique_common></bind_material></instance_geometry></node></visual_scene></"
        "library_visual_scenes><scene>"
        "<instance_visual_scene url=\"#s0\"/></scene></COLLADA>",
        name, sources, inputs, binding);
    assert_in_range(size, 1, sizeof text - 1);
    write_text("x.dae", text);
}

#define INPUT(source, set) \
    "<input semantic=\"TEXCOORD\" source=\"#t" source "\" offset=\"1\" set=\"" set "\"/>"
#define UNNUMBERED "<input semantic=\"TEXCOORD\" source=\"#t1\" offset=\"1\"/>"
#define BINDING(name, set) \
    "<bind_vertex_input semantic=\"" name "\" input_semantic=\"TEXCOORD\" input_set=\"" set "\"/>"

// What is bound to a name decides on the set, not a number in the name; and sets may have any numbers.
static void test_texture_coordinate_sets(void **state)
{
    (void)state;
    static const struct {
        const char *inputs, *name, *binding;
        float u;
    } cases[] = {
        {INPUT("1", "0"), "CHANNEL1", BINDING("CHANNEL1", "0"), 0.25f},
        {INPUT("1", "1"), "CHANNEL1", BINDING("CHANNEL1", "1"), 0.25f},
        {INPUT("1", "0") INPUT("2", "1"), "CHANNEL1", BINDING("CHANNEL2", "1") BINDING("CHANNEL1", "0"),
         0.25f},
        {INPUT("1", "0") INPUT("2", "1"), "CHANNEL2", BINDING("CHANNEL2", "1") BINDING("CHANNEL1", "0"),
         0.5f},
        {INPUT("1", "3") INPUT("2", "5"), "UV", BINDING("UV", "5") BINDING("UV", "3"), 0.5f},
        {INPUT("1", "0"), "8bit_2K_png", BINDING("8bit_2K_png", "0"), 0.25f},
        {INPUT("1", "0"), "8bit_2K_png", "", 0.25f},
        {UNNUMBERED, "CHANNEL1", BINDING("CHANNEL1", "1"), 0.25f},
        {INPUT("1", "2") INPUT("2", "3"), "UV", BINDING("UV", "1"), 0.25f},
        {INPUT("1", "0") INPUT("2", "1"), "UVSET1", "", 0.5f},
        {INPUT("1", "0"), "map-16", "<bind_vertex_input input_semantic = 'TEXCOORD'\n semantic='map-16'/>",
         0.25f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_sets(cases[i].inputs, cases[i].name, cases[i].binding);
        struct scene_model *model = load("x.dae");
        const struct scene_mesh *mesh = &model->meshes[model->instances[0].mesh];
        const struct scene_texture_slot *slot =
            &model->materials[mesh->material].slots[SCENE_SLOT_BASE_COLOR];
        assert_true(slot->image >= 0);
        assert_non_null(mesh->uvs[slot->uv_set]);
        assert_true(mesh->uvs[slot->uv_set][0][0] == cases[i].u);
        assert_false(has_warning(model, "coordinate"));
        assert_int_equal(model->unsupported_count, 0);
        scene_model_free(model);
    }
}

// A convex mesh with parts of its own is drawn as any mesh. The hull of another mesh is not.
static void test_convex(void **state)
{
    (void)state;
    static const char *const tags[] = {"<convex_mesh>", "<convex_mesh convex_hull_of=\"#g\">"};
    for (int i = 0; i < 2; i++) {
        char text[8192], changed[32768];
        make_document("", text);
        char *const mesh = strstr(text, "<mesh>"), *const end = strstr(text, "</mesh>");
        *mesh = *end = 0;
        snprintf(changed, sizeof changed, "%s%s%s</convex_mesh>%s", text, tags[i], mesh + strlen("<mesh>"),
                 end + strlen("</mesh>"));
        write_text("x.dae", changed);
        struct scene_model *const model = load("x.dae");
        assert_int_equal(model->triangles_drawn, i == 0);
        assert_true(is_unsupported(model, "convex hulls of meshes: not drawn") == (i == 1));
        scene_model_free(model);
    }
}

// An image that names no file is one that is missing. assimp refuses the document, or aborts.
static void test_images_without_names(void **state)
{
    (void)state;
    static const char given[] = "<image id=\"i\"><init_from>[gone.png]</init_from></image>";
    static const struct {
        const char *image, *told;
    } cases[] = {
        {"<image id=\"pic\"/>", "texture \"pic\": No such file"},
        {"<image id=\"pic\" />", "texture \"pic\": No such file"},
        {"<image id=\"pic\"><!--<init_from>x.png</init_from>--></image>", "texture \"pic\": No such file"},
        {"<image id=\"pic\"><init_from/></image>", "texture \"pic\": No such file"},
        {"<image id=\"pic\">\n<init_from> </init_from>\n</image>", "texture \"pic\": No such file"},
        {"<image id=\"pic\"><extra><technique profile=\"x\"><wrap>1</wrap></technique></extra></image>",
         "texture \"pic\": No such file"},
        {"<image id=\"pic\"><asset><unit/></asset><init_from><!--a.png--></init_from><extra/></image>",
         "texture \"pic\": No such file"},
        {"<image id=\"pic\"><init_from><ref> </ref></init_from></image>", "texture \"pic\": No such file"},
        {"<image id=\"pic\"><init_from><![CDATA[gone.png]]></init_from><extra/></image>",
         "texture \"gone.png\": No such file"},
        {"<image id=\" \"/><image id=\"pic\"><init_from>gone.png</init_from></image>",
         "texture \"gone.png\": No such file"},
        {"<image id=\"other\"/><image id=\"pic\"><init_from>gone.png</init_from></image>",
         "texture \"gone.png\": No such file"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char document[8192];
        const char *const start = strstr(DOCUMENT, given), *const rest = start + sizeof given - 1;
        const char *const use = strstr(rest, "[i]");
        snprintf(document, sizeof document, "%.*s%s%.*spic%s", (int)(start - DOCUMENT), DOCUMENT,
                 cases[i].image, (int)(use - rest), rest, use + 3);
        char *const image = document + (start - DOCUMENT), *const behind = image + strlen(cases[i].image);
        for (char *c = document; *c != 0; c++) {
            *c = (*c == '[' || *c == ']') && (c < image || c >= behind) ? ' ' : *c;
        }
        write_text("x.dae", document);
        struct scene_model *model = load("x.dae");
        assert_int_equal(model->triangles_drawn, 1);
        assert_true(has_warning(model, cases[i].told));
        scene_model_free(model);
    }
}

#define PERSPECTIVE(numbers)  "<perspective>" numbers "</perspective>"
#define ORTHOGRAPHIC(numbers) "<orthographic>" numbers "</orthographic>"

// A camera may lack a name, and its lens one of its numbers. Its planes are in the unit of the document.
static void test_cameras(void **state)
{
    (void)state;
    static const struct {
        const char *lens;
        float yfov, aspect, size[2], near, far;
    } cases[] = {
        {PERSPECTIVE("<xfov>90</xfov><aspect_ratio>2</aspect_ratio><znear>50</znear><zfar>900</zfar>"),
         53.130102f,
         2,
         {0, 0},
         0.5f,
         9},
        {PERSPECTIVE("<xfov sid=\"x\"> 90 </xfov>\n<yfov>53.130102</yfov><znear>50</znear>"),
         53.130102f,
         2,
         {0, 0},
         0.5f,
         0},
        {PERSPECTIVE("<yfov>40</yfov><aspect_ratio>1.5</aspect_ratio>"), 40, 1.5f, {0, 0}, 0.01f, 0},
        {PERSPECTIVE("<yfov>40</yfov>"), 40, 0, {0, 0}, 0.01f, 0},
        {PERSPECTIVE("<yfov>40</yfov><aspect_ratio>0</aspect_ratio>"), 40, 0, {0, 0}, 0.01f, 0},
        {ORTHOGRAPHIC("<xmag>300</xmag><ymag>100</ymag><znear>50</znear><zfar>900</zfar>"),
         0,
         3,
         {3, 1},
         0.5f,
         9},
        {ORTHOGRAPHIC("<ymag>100</ymag><aspect_ratio>2</aspect_ratio><zfar>900</zfar>"),
         0,
         2,
         {2, 1},
         0.01f,
         9},
        {ORTHOGRAPHIC("<xmag>200</xmag><zfar>900</zfar>"), 0, 4.0f / 3, {2, 1.5f}, 0.01f, 9},
    };
    static const char *const names[] = {"<camera id=\"eye\">", "<camera name=\"a &amp; b\" id=\"eye\">"};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        char document[8192], text[8192 + 1024];
        make_document("", document);
        char *const unit = strstr(document, "<asset>") + strlen("<asset>"),
                    *const library = strstr(unit, "<library_i"),
                    *const place = strstr(library, "<node>") + strlen("<node>");
        snprintf(
            text, sizeof text,
            "%.*s<unit meter=\"0.01\"/>%.*s<library_cameras>%s<optics><technique_common>%s</technique_common>"
            "<technique "
            "profile=\"x\"><xfov>1</xfov></technique></optics><extra><technique><camera_target/"
            "><camera_target>"
            "</camera_target></technique></extra></camera></library_cameras>%.*s"
            "<node><instance_camera url=\"#eye\"/></node>%s",
            (int)(unit - document), document, (int)(library - unit), unit, names[i % 2], cases[i / 2].lens,
            (int)(place - library), library, place);
        struct scene_model *const model = load_text("x.dae", text);
        assert_int_equal(model->camera_count, 1);
        const struct scene_model_camera *const camera = &model->cameras[0];
        const bool is_orthographic = cases[i / 2].size[0] > 0;
        assert_true(camera->orthographic == is_orthographic);
        assert_floats(is_orthographic ? &camera->xmag : &camera->yfov,
                      is_orthographic ? cases[i / 2].size : &(const float){cases[i / 2].yfov * 0.017453293f},
                      1, 1e-5f);
        assert_true(!is_orthographic || fabsf(camera->ymag - cases[i / 2].size[1]) < 1e-5f);
        assert_floats(&camera->aspect, &cases[i / 2].aspect, 1, 1e-5f);
        assert_floats(&camera->znear, &cases[i / 2].near, 1, 1e-5f);
        assert_floats(&camera->zfar, &cases[i / 2].far, 1, 1e-4f);
        assert_int_equal(model->unsupported_count, 0);
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

// A document and its texture in a ZIP archive, with a manifest that names the document, and without. The document has the
// name of the texture, and the archive the entry.
static void test_package(void **state)
{
    (void)state;
    static const char picture[] = "P6\n1 1\n255\n\x10\x20\x30";
    static const struct {
        const char *document, *root, *name, *entry;
    } cases[] = {
        {"x.dae", "./x.dae", "gone.png", "gone.png"},
        {"x.dae", " x.dae ", "tex/gone.png", "tex/gone.png"},
        {"x.dae", "x.dae", "file:///C:/models/tex/gone.png", "tex/gone.png"},
        {"in it/x.dae", "in%20it/x.dae", "../tex/a%20b.png", "tex/a b.png"},
        {"in it/x.dae", "./in%20it/x.dae", ".\\tex\\gone.png", "in it/tex/Gone.PNG"},
        {"a/b/x.dae", "/a/b/x.dae", "../c/../gone.png", "a/gone.png"},
        {"x.dae", "x.dae", "gone.png", "images/gone.png"},
        {"x.dae", "x.dae", "images/gone.png", "gone.png"},
    };
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        char given[8192], text[8192], manifest[128];
        make_document("", given);
        const char *const place = strstr(given, "gone.png");
        snprintf(text, sizeof text, "%.*s%s%s", (int)(place - given), given, cases[i / 2].name,
                 place + strlen("gone.png"));
        snprintf(manifest, sizeof manifest, "<?xml version=\"1.0\"?>\n<dae_root>%s</dae_root>",
                 cases[i / 2].root);
        zipFile zip = package_begin("x.zae");
        if (i % 2 == 0) {
            package_add_text(zip, "manifest.xml", manifest);
            package_add_text(zip, "other.dae", "no document");
        }
        package_add_text(zip, cases[i / 2].document, text);
        package_add(zip, cases[i / 2].entry, picture, sizeof picture - 1);
        package_end(zip);
        struct scene_model *const model = load("x.zae");
        assert_int_equal(model->triangles_drawn, 1);
        assert_false(has_warning(model, "png"));
        assert_int_equal(model->image_count, 1);
        assert_memory_equal(model->images[0].texels, "\x10\x20\x30\xff", 4);
        scene_model_free(model);
    }
}

// Two textures that are one entry of the archive have one image.
static void test_shared_entry(void **state)
{
    (void)state;
    static const char picture[] = "P6\n1 1\n255\n\x10\x20\x30";
    static const char color[] = "<color>0.5 0 0 1</color>";
    char given[8192], text[8192];
    make_document("", given);
    const char *const place = strstr(given, color);
    snprintf(text, sizeof text, "%.*s<texture texture=\"s\" texcoord=\"UV\"/>%s", (int)(place - given), given,
             place + strlen(color));
    zipFile zip = package_begin("x.zae");
    package_add_text(zip, "x.dae", text);
    package_add(zip, "gone.png", picture, sizeof picture - 1);
    package_end(zip);
    struct scene_model *const model = load("x.zae");
    const struct scene_material *material =
        &model->materials[model->meshes[model->instances[0].mesh].material];
    assert_int_equal(model->image_count, 1);
    assert_int_equal(material->slots[SCENE_SLOT_BASE_COLOR].image, 0);
    assert_int_equal(material->slots[SCENE_SLOT_EMISSIVE].image, 0);
    scene_model_free(model);
}

// Archives without a document, and one whose text is not in an archive at all.
static void test_packages_of_none(void **state)
{
    (void)state;
    zipFile zip = package_begin("x.zae");
    package_add_text(zip, "manifest.xml", "<dae_root>gone.dae</dae_root>");
    package_end(zip);
    expect_refused("x.zae", "without a document of Collada");
    char text[8192];
    make_document("", text);
    struct scene_model *const model = load_text("x.zae", text);
    assert_int_equal(model->triangles_drawn, 1);
    scene_model_free(model);
}

// A wall with a gable whose corners lie in one line with others. Its triangles cover it once and nothing else.
static void test_polygons(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "wall.dae",
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
        "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id=\"g\">"
        "<mesh><source id=\"p\"><float_array id=\"pa\" count=\"36\">0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 4 1 0 3 1 "
        "0 "
        "3 2 0 2 2 0 2 1 0 1 1 0 0 1 0</float_array><technique_common><accessor source=\"#pa\" count=\"12\" "
        "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
        "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\">"
        "<input semantic=\"POSITION\" source=\"#p\"/></vertices><polylist count=\"2\">"
        "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>12 4</vcount>"
        "<p>0 1 2 3 4 5 6 7 8 9 10 11 0 1 10 11</p></polylist></mesh></geometry></library_geometries>"
        "<library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node>"
        "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
        "url=\"#s\"/></scene></COLLADA>");
    const struct scene_mesh *mesh = &model->meshes[0];
    double area = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const float *a = mesh->positions[mesh->indices[i]], *b = mesh->positions[mesh->indices[i + 1]],
                    *c = mesh->positions[mesh->indices[i + 2]];
        area += 0.5 * fabs(((double)b[0] - (double)a[0]) * ((double)c[1] - (double)a[1]) -
                           ((double)b[1] - (double)a[1]) * ((double)c[0] - (double)a[0]));
    }
    assert_int_equal(model->mesh_count, 1);
    assert_int_equal(model->triangles_drawn, 12);
    assert_true(fabs(area - 6) < 1e-6); // 5 and the square once more
    scene_model_free(model);
}

// What is no index ends a list, and a mesh without all of its indices is refused. assimp alone would read for ever.
static void test_indices_that_are_none(void **state)
{
    (void)state;
    static const char *const words[] = {
        "2-1e39", "2.5", "two", "-", "0x2", "-1", "4294967295", "4294967298", "99999999999999999999999"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char text[8192];
        make_document("", text);
        char *const list = strstr(text, "<p>0 1 2</p>");
        write_format("x.dae", "%.*s<p>0 1 %s%s", (int)(list - text), text, words[i],
                     list + strlen("<p>0 1 2"));
        char line[96];
        snprintf(line, sizeof line, "cannot be read: a <p> has \"%.20s\", which is no index", words[i]);
        expect_refused("x.dae", line);
    }
}

// Copy a text, with another one before the first `place` in it.
static void insert(const char *text, const char *place, const char *more, char inserted[8192])
{
    const char *const found = strstr(text, place);
    assert_non_null(found);
    snprintf(inserted, 8192, "%.*s%s%s", (int)(found - text), text, more, found);
}

// What is left out of a document is told in an archive as it is beside one, and a camera is drawn.
static void test_gaps_in_archive(void **state)
{
    (void)state;
    char text[8192], with_curve[8192], whole[8192];
    make_document("", text);
    insert(text, "</library_geometries>", "<geometry id=\"c\"><spline/></geometry>", with_curve);
    insert(with_curve, "<scene>",
           "<library_cameras><camera id=\"eye\"><optics><technique_common><perspective><yfov>30</yfov>"
           "<aspect_ratio>1.5</aspect_ratio><znear>1</znear><zfar>9</zfar></perspective></technique_common>"
           "</optics></camera></library_cameras>",
           text);
    insert(text, "</visual_scene>",
           "<node><instance_camera url=\"#eye\"/><instance_geometry url=\"#c\"/></node>", whole);
    zipFile zip = package_begin("x.zae");
    package_add_text(zip, "x.dae", whole);
    package_end(zip);
    struct scene_model *const model = load("x.zae");
    assert_true(is_unsupported(model, "curves: not drawn"));
    assert_int_equal(model->unsupported_count, 1);
    assert_int_equal(model->camera_count, 1);
    assert_floats(&model->cameras[0].yfov, (const float[]){0.5235988f}, 1, 1e-6f);
    scene_model_free(model);
}

// Relief that is a grey image is one of heights, which become normals, and any other image has normals.
static void test_relief(void **state)
{
    (void)state;
    static const uint8_t pictures[][6] = {{0, 0, 0, 255, 255, 255}, {128, 128, 255, 128, 0, 128}},
                         texels[][8] = {{128, 128, 255, 255, 128, 128, 255, 255},
                                        {128, 128, 255, 255, 128, 0, 128, 255}};
    char text[8192], relief[8192];
    make_document("", text);
    memcpy(strstr(text, "gone.png"), "bump.png", strlen("bump.png"));
    insert(text, "</technique></profile_COMMON>",
           "<extra><technique profile=\"FCOLLADA\"><bump><texture texture=\"s\" texcoord=\"UV\"/></bump>"
           "</technique></extra>",
           relief);
    write_text("x.dae", relief);
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++) {
        char picture[18] = "P6\n2 1\n255\n";
        const size_t head = strlen(picture);
        memcpy(picture + head, pictures[i], sizeof pictures[i]);
        write_bytes("bump.png", picture, head + sizeof pictures[i]);
        struct scene_model *const model = load("x.dae");
        const struct scene_material *const material =
            &model->materials[model->meshes[model->instances[0].mesh].material];
        const int32_t image = material->slots[SCENE_SLOT_NORMAL].image;
        assert_true(image >= 0);
        assert_memory_equal(model->images[image].texels, texels[i], sizeof texels[i]);
        scene_model_free(model);
    }
}

#define PLACE                                                                                            \
    "<matrix>0.666666667 -0.666666667 0.333333333 3 0.333333333 0.666666667 0.666666667 4 -0.666666667 " \
    "-0.333333333 0.666666667 12 0 0 0 1</matrix>"

// Lights and cameras stand and look as their nodes do, which are turned about all axes. A colour is no brighter than 1, and
// what is left of a light at the middle of the triangle is what its strength is worth.
static void test_turned_nodes(void **state)
{
    (void)state;
    static const float forward[3] = {-1.0f / 3, -2.0f / 3, -2.0f / 3}, place[3] = {3, 4, 12};
    static const char point[] = "<point><color>2 1 0.5</color><constant_attenuation>1</constant_attenuation>"
                                "<linear_attenuation>0.5</linear_attenuation><quadratic_attenuation>0.25"
                                "</quadratic_attenuation></point>";
    static const char spot[] = "<spot><color>0.5 0.25 0</color><falloff_angle>40</falloff_angle></spot>";
    static const char sun[] = "<directional><color>0.25 1 0.5</color></directional>";
    const char *const kinds[] = {point, spot, sun};
    const double square = 2.5 * 2.5 + 3.5 * 3.5 + 12 * 12, pi = 3.14159265358979323846;
    const double strengths[] = {pi * square / (1 + 0.5 * sqrt(square) + 0.25 * square), pi * square, pi};
    for (int i = 0; i < 3; i++) {
        write_format(
            "l.dae",
            "<COLLADA version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset><library_cameras><camera "
            "id=\"c\">"
            "<optics><technique_common><perspective><xfov>40</xfov><aspect_ratio>2</aspect_ratio><znear>1</"
            "znear>"
            "<zfar>50</zfar></perspective></technique_common></optics></camera></"
            "library_cameras><library_lights>"
            "<light "
            "id=\"l\"><technique_common>%s</technique_common></light></library_lights><library_geometries>"
            "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 1 0 0 0 1 0"
            "</float_array><technique_common><accessor source=\"#pa\" count=\"3\" stride=\"3\"><param "
            "name=\"X\" "
            "type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
            "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
            "source=\"#p\"/></vertices>"
            "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
            "2</p></triangles>"
            "</mesh></geometry></library_geometries>%s",
            kinds[i],
            "<library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry "
            "url=\"#g\"/></node><node>" PLACE "<instance_light url=\"#l\"/></node><node>" PLACE
            "<instance_camera url=\"#c\"/></node></visual_scene>"
            "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
        struct scene_model *const model = load("l.dae");
        assert_int_equal(model->light_count, 1);
        const struct scene_model_light *const light = &model->lights[0];
        const float share = i == 0 ? 0.5f : 1;
        const float colors[3][3] = {{2, 1, 0.5f}, {0.5f, 0.25f, 0}, {0.25f, 1, 0.5f}};
        const float strength = (float)strengths[i],
                    cosines[] = {0.939692621f, 0.467460632f}; // of 20 and 62.13
        for (int c = 0; c < 3; c++) {
            assert_true(light->color[c] == share * colors[i][c]);
        }
        assert_floats(&light->intensity, &strength, 1, 1e-4f * strength);
        if (i < 2) {
            assert_floats(light->position, place, 3, 1e-5f);
        }
        if (i > 0) {
            assert_floats(light->direction, forward, 3, 1e-6f);
        }
        if (i == 1) {
            assert_floats(&light->inner_cos, &cosines[0], 1, 1e-6f);
            assert_floats(&light->outer_cos, &cosines[1], 1, 1e-6f);
        }
        static const float world[16] = {2.0f / 3, 1.0f / 3, -2.0f / 3, 0, -2.0f / 3, 2.0f / 3, -1.0f / 3, 0,
                                        1.0f / 3, 2.0f / 3, 2.0f / 3,  0, 3,         4,        12,        1};
        assert_int_equal(model->camera_count, 1);
        assert_floats(model->cameras[0].world, world, 16, 1e-5f);
        assert_floats(&model->cameras[0].zfar, (const float[]){50}, 1, 0);
        scene_model_free(model);
    }
}

// Images and samplers as Collada 1.5 has them.
static void test_samplers_1_5(void **state)
{
    (void)state;
    write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
    static const char *const changes[][2] = {
        {"version=\"1.4.1\"", "version=\"1.5.0\""},
        {"<init_from>gone.png</init_from>", "<init_from><ref>a.ppm</ref></init_from>"},
        {"<newparam sid=\"f\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam>", ""},
        {"<sampler2D><source>f</source></sampler2D>", "<sampler2D><instance_image url=\"#i\"/></sampler2D>"},
    };
    char changed[8192];
    make_document("", changed);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        char *const place = strstr(changed, changes[i][0]);
        assert_non_null(place);
        char rest[8192];
        strcpy(rest, place + strlen(changes[i][0]));
        strcpy(place, changes[i][1]);
        strcat(changed, rest);
    }
    struct scene_model *const model = load_text("x.dae", changed);
    assert_int_equal(model->image_count, 1);
    assert_false(model->images[0].missing);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_gaps_in_archive),
    cmocka_unit_test(test_relief),
    cmocka_unit_test(test_package),
    cmocka_unit_test(test_packages_of_none),
    cmocka_unit_test(test_shared_entry),
    cmocka_unit_test(test_polygons),
    cmocka_unit_test(test_indices_that_are_none),
    cmocka_unit_test(test_no_color),
    cmocka_unit_test(test_blanks),
    cmocka_unit_test(test_convex),
    cmocka_unit_test(test_cameras),
    cmocka_unit_test(test_turned_nodes),
    cmocka_unit_test(test_texture_coordinate_sets),
    cmocka_unit_test(test_images_without_names),
    cmocka_unit_test(test_samplers_1_5),
};

const struct unit_tests test_collada = UNIT_TESTS(tests, make_directory, remove_directory);
