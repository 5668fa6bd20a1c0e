// SPDX-License-Identifier: MIT
// X3D as people write it, of which assimp would refuse much and drop more.
#include "model_files.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define SHAPE(appearance)                                                                  \
    "<Shape><Appearance>" appearance "</Appearance><IndexedFaceSet coordIndex='0 1 2 -1'>" \
    "<Coordinate point='0 0 0 1 0 0 0 1 0'/><TextureCoordinate point='0 0 1 0 0 "          \
    "1'/></IndexedFaceSet></Shape>"

#define LACKING "normals, colours and texture coordinates that some corners lack (X3D): not used"

// Lists of addresses as X3D writes them, of which the first that is there counts.
static void test_addresses(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"url='\"a.ppm\"'", "a.ppm"},
        {"url=\"&quot;a.ppm&quot;\"", "a.ppm"},
        {"url='a.ppm'", "a.ppm"},
        {"url='\"none.ppm\" \"a.ppm\"'", "a.ppm"},
        {"url='\"a%20b.ppm\"'", "a b.ppm"},
        {"url='\"a b.ppm\" \"a.ppm\"'", "a b.ppm"},
        {"DEF='i'\n url = '\"a.ppm\",\n\"none.ppm\"' ", "a.ppm"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
        write_bytes("a b.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
        unlink(path_of(strcmp(cases[i][1], "a.ppm") == 0 ? "a b.ppm" : "a.ppm"));
        write_format(
            "u.x3d", "<X3D><Scene>%s%s%s</Scene></X3D>", "<Shape><Appearance><ImageTexture ", cases[i][0],
            "/></Appearance><IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
            "<TextureCoordinate point='0 0 1 0 0 1'/></IndexedFaceSet></Shape>");
        struct scene_model *const model = load("u.x3d");
        assert_int_equal(model->image_count, 1);
        assert_int_equal(model->unsupported_count + model->warning_count, 0);
        assert_false(model->images[0].missing);
        scene_model_free(model);
    }
}

// Groups of all kinds, empty ones among them, and nodes that are not known: the rest of the file is drawn.
static void test_nodes(void **state)
{
    (void)state;
    static const char used[] = "some groups that are used again (X3D): not drawn";
    static const struct {
        const char *text;
        unsigned triangles;
        const char *told;
    } cases[] = {
        {"<Collision enabled='false'>" SHAPE("") "</Collision >", 2, NULL},
        {"<Anchor url='\"a.html\"'><Billboard>" SHAPE("") "</Billboard></Anchor>", 2, NULL},
        {"<CADLayer><CADAssembly><CADPart translation='1 0 0'><CADFace>" SHAPE(
             "") "</CADFace></CADPart></CADAssembly></CADLayer>",
         2, NULL},
        {"<LOD range='9'>" SHAPE("") SHAPE("") "</LOD>", 2, NULL},
        {"<Cloud><Group>" SHAPE("") "</Group><Cloud/></Cloud>", 1, "nodes Cloud in Scene (X3D): not drawn"},
        {SHAPE("<Material/><Cloud><Cloud/></Cloud>") "<!-- <Cloud/> -->", 2,
         "nodes Cloud in Appearance (X3D): not drawn"},
        {"<Collision><Cloud/></Collision>", 1, "nodes Cloud in Group (X3D): not drawn"},
        {"<LOD><Cloud/>" SHAPE("") "</LOD>", 2, "nodes Cloud in Switch (X3D): not drawn"},
        {"<Group><Ab/></Group>", 1, "nodes Ab in Group (X3D): not drawn"},
        {"<Transform><Cloud/>" SHAPE("") "</Transform>", 2, "nodes Cloud in Transform (X3D): not drawn"},
        {"<Shape><Appearance><Cloud/></Appearance></Shape>", 1, "nodes Cloud in Appearance (X3D): not drawn"},
        {"<Collision/><LOD/><Group/><StaticGroup/><Switch DEF='s'/><Anchor url='\"a.html\"'/>", 1, NULL},
        {"<Collision></Collision><CADPart>\n</CADPart><LOD></LOD><Group><!-- x --></Group>", 1, NULL},
        {"<Group><!----></Group><!---->" SHAPE("<!---->"), 2, NULL},
        {"<Switch whichChoice='1'><Group/>" SHAPE("") "</Switch>", 2, NULL},
        {"<Billboard DEF='b'>" SHAPE("") "</Billboard><Billboard USE='b'/>" SHAPE(""), 4, NULL},
        {"<Transform DEF='b'>" SHAPE("") "</Transform><Group><Transform USE='b'></Transform></Group>", 3,
         NULL},
        {"<Group DEF='b'>" SHAPE("") "</Group><Group USE='b'><!-- </again> --> </Group>", 3, NULL},
        {"<Group DEF='a'>" SHAPE("") "<Group DEF='b'>" SHAPE(
             "") "</Group></Group><Group DEF='c'><LOD USE='a'/>"
                 "<Group USE='b'/></Group><Group><Group USE='c' /></Group>",
         9, NULL},
        {"<Group DEF='b'/><Group DEF='ab'>" SHAPE("") "</Group><Group USE='b'/><Group USE='ab'/>", 3, NULL},
        {"<Switch whichChoice='-1'><Group DEF='b'>" SHAPE("") "</Group></Switch><Group USE='b'/>", 2, NULL},
        {"<Group DEF='b'>" SHAPE("") "<Group USE='b'/></Group>", 2, used},
        {"<Group USE='b'/><Group DEF='b'>" SHAPE("") "</Group>", 2, used},
        {"<Group DEF='b'>" SHAPE("") "</Group><Group USE='c'/>", 2, used},
        {"<Group> </Group><Transform>\t</Transform><Switch>\n</Switch><StaticGroup>\r\n</StaticGroup>", 1,
         NULL},
        {"<Group USE='c'><!-- none --></Group>" SHAPE(""), 2, used},
        {"<Group><!-- one --></Group><Collision> " SHAPE("") "</Collision>", 2, NULL},
        {"<Shape><IndexedFaceSet><Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>", 1,
         "sets of faces or lines without indices (X3D): not drawn"},
        {"<Shape><IndexedLineSet/></Shape><ProtoDeclare/>", 1, "prototypes: not drawn"},
        {"<Script/>", 1, "what scripts make: not drawn"},
        {"<Shape><IndexedFaceSet coordIndex=''><Coordinate point='0 0 0'/></IndexedFaceSet></Shape>", 1,
         NULL},
        {"<Shape><IndexedFaceSet coordIndex='-1 0 1 2 -1 -1'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
         "</IndexedFaceSet></Shape>",
         2, NULL},
        {"<Shape><IndexedFaceSet coordIndex='0 1 -1 0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
         "</IndexedFaceSet></Shape>",
         2, "faces of fewer than three corners (X3D): left out"},
        {"<Shape><IndexedTriangleSet index='0 1 2 0 1'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
         "</IndexedTriangleSet></Shape>",
         2, "faces of fewer than three corners (X3D): left out"},
        {"<Shape><IndexedTriangleFanSet index='0 1 -1 0 1 2'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
         "</IndexedTriangleFanSet></Shape>",
         2, "faces of fewer than three corners (X3D): left out"},
        {"<Shape><TriangleStripSet stripCount='3 2'><Coordinate point='0 0 0 1 0 0 0 1 0 2 0 0 2 1 0'/>"
         "</TriangleStripSet></Shape>",
         2, "faces of fewer than three corners (X3D): left out"},
        {"<Shape><ElevationGrid xDimension='2' zDimension='2' height=\"0 ' 1 1\"/></Shape>", 1,
         "grids without faces or without all of their heights (X3D): not drawn"},
        {"<Shape><ElevationGrid xDimension='2' zDimension='2' height='0 0 1'/></Shape>", 1,
         "grids without faces or without all of their heights (X3D): not drawn"},
        {"<Shape><IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
         "<Color USE='gone'/></IndexedFaceSet></Shape>",
         2, LACKING},
        {"<Shape><IndexedFaceSet coordIndex='0 1 2 -1'><Color color='1 0 0 0 1 0'><!-- </Color> --></Color >"
         "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>" SHAPE(""),
         3, LACKING},
        {"<Shape><IndexedFaceSet coordIndex='0 1 2 -1' normalIndex='0 0 7 -1'><Normal vector='0 0 1'/>"
         "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>",
         2, LACKING},
        {"<Shape><IndexedFaceSet coordIndex='0 1 2 -1'><TextureCoordinate/>"
         "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>",
         2, LACKING},
        {"<Shape><IndexedFaceSet coordIndex='0 1'><IndexedLineSet coordIndex='0 1'></IndexedLineSet>"
         "</IndexedFaceSet></Shape>" SHAPE(""),
         2, NULL},
        {"<Shape><IndexedFaceSet coordIndex='0 1 2'><Coordinate DEF='c' point='0 0 0 1 0 0 0 1 0'/>"
         "</IndexedFaceSet></Shape><Shape><PointSet><Coordinate class='REUSED' USE='c'/></PointSet></Shape>",
         2, NULL},
        {"<Shape><IndexedFaceSet DEF='f' coordIndex='0 1 2'><Coordinate USE='none'/></IndexedFaceSet></Shape>"
         "<Shape><IndexedFaceSet USE='f'/></Shape>",
         1, "sets of points that are not there (X3D): not drawn"},
        {"<Collision><Shape containerField='proxy'><Sphere/></Shape>" SHAPE("") "</Collision>", 2, NULL},
        {"<Collision><Group containerField='proxy'><Group containerField='proxy'>" SHAPE(
             "") "</Group></Group>" SHAPE("") "</Collision><Group containerField='children'>" SHAPE("") "</"
                                                                                                        "Grou"
                                                                                                        "p>",
         3, NULL},
        {"<Group><Shape containerField='proxy'><Sphere/></Shape><Shape "
         "containerField='proxy'><Sphere/></Shape><Group "
         "containerField='proxy'/></Group>",
         1, NULL},
        {"<Collision><Group containerField='proxy' DEF='b'>" SHAPE("") "</Group></Collision><Group USE='b'/>",
         2, NULL},
        {"<Group DEF='b'>" SHAPE("") "</Group><Collision><Group containerField='proxy' USE='b'/>" SHAPE(
             "") "</Collision>",
         3, NULL},
        {"<Collision><Shape containerField='proxy' DEF='s'><IndexedFaceSet coordIndex='0 1 2 -1'>"
         "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape></Collision><Shape USE='s'/>",
         2, NULL},
        {"<MetadataSet><MetadataString containerField='value' value='\"b\"'/></MetadataSet>"
         "<Group><MetadataString value='\"b\"'/></Group><Switch><MetadataFloat "
         "value='1'></MetadataFloat></Switch>",
         1, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *const told = cases[i].told;
        write_format("n.x3d", "<X3D><Scene>%s%s</Scene></X3D>", SHAPE(""), cases[i].text);
        struct scene_model *const model = load("n.x3d");
        if (model->triangles_drawn != cases[i].triangles) {
            fail_msg("case %zu: %" PRIu64 " triangles", i, (uint64_t)model->triangles_drawn);
        }
        if (model->unsupported_count != (told != NULL) || (told != NULL && !is_unsupported(model, told))) {
            fail_msg("case %zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

// Faces end at others, so that no file makes the search for what belongs to them long.
static void test_faces_within_faces(void **state)
{
    (void)state;
    struct scene_model *const model = load_text(
        "f.x3d",
        "<X3D><Scene><Shape><IndexedFaceSet coordIndex='0 1 2 -1'><IndexedFaceSet/>"
        "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>" SHAPE("") "</Scene></X3D>");
    assert_int_equal(model->triangles_drawn, 1);
    scene_model_free(model);
}

// Groups of two uses each, in each other, are repeated as long as the file stays of a bounded size.
static void test_groups_within_groups(void **state)
{
    (void)state;
    enum { DEEPEST = 40, LONGEST = 128 };
    static char text[DEEPEST * LONGEST + 4096];
    int length =
        snprintf(text, sizeof text, "<X3D><Scene><Group DEF='g0'><!--%2000s-->%s</Group>", "", SHAPE(""));
    for (int i = 1; i < DEEPEST; i++) {
        length += snprintf(text + length, LONGEST,
                           "<Group DEF='g%d'><Group USE='g%d'/><Group USE='g%d'/></Group>", i, i - 1, i - 1);
    }
    strcpy(text + length, "</Scene></X3D>");
    struct scene_model *const model = load_text("w.x3d", text);
    assert_true(is_unsupported(model, "some groups that are used again (X3D): not drawn"));
    assert_true(model->triangles_drawn > 1000 && model->triangles_drawn < 5000);
    scene_model_free(model);
}

// A light with a name is in every place where its group is used.
static void test_lights_that_are_used_again(void **state)
{
    (void)state;
    static const char *const lights[] = {"DirectionalLight", "PointLight", "SpotLight"};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        write_format("l.x3d",
                     "<X3D><Scene>%s<Group DEF='g'><%s DEF='l'/><Group DEF='h'/></Group><Transform "
                     "translation='5 0 0'><Group USE='g'/></Transform><Transform translation='0 3 0'>"
                     "<Group USE='g'/></Transform></Scene></X3D>",
                     SHAPE(""), lights[i]);
        struct scene_model *const model = load("l.x3d");
        assert_int_equal(model->light_count, 3);
        assert_int_equal(model->unsupported_count + model->warning_count, 0);
        float sum[3] = {0};
        for (uint32_t k = 0; k < model->light_count; k++) {
            for (int c = 0; c < 3; c++) {
                sum[c] += model->lights[k].position[c];
            }
            // No name is one that differs from run to run.
            assert_true(strcmp(model->lights[k].name, "l") == 0 || model->lights[k].name[0] == 0);
        }
        assert_floats(sum, (const float[]){5, 3, 0}, 3, 1e-6f);
        scene_model_free(model);
    }
}

// A light keeps its name, though it may end as those do that assimp gives.
static void test_names_of_lights(void **state)
{
    (void)state;
    static const char *const names[] = {"KeyLight_20240101", "aPointLight_20240101", "PointLight_20240101b",
                                        "PointLight_7", ""};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        write_format("l.x3d", "<X3D><Scene>%s<PointLight %s%s%s/></Scene></X3D>", SHAPE(""),
                     names[i][0] != 0 ? "DEF='" : "", names[i], names[i][0] != 0 ? "'" : "");
        struct scene_model *const model = load("l.x3d");
        assert_int_equal(model->light_count, 1);
        assert_string_equal(model->lights[0].name, names[i]);
        scene_model_free(model);
    }
}

#define QUADS "<Coordinate point='0 0 0 1 0 0, 1 1 0 0 1 0 2 0 0 3 0 0 3 1 0 2 1 0'/>"

// Quads, with indices and without, are drawn with what belongs to their corners, and where they are used again.
static void test_quads(void **state)
{
    (void)state;
    static const char few[] = "quads of fewer than four corners (X3D): left out", none[] = "quads: not drawn";
    static const struct {
        const char *text;
        unsigned triangles;
        const char *told;
    } cases[] = {
        {"<QuadSet>" QUADS "</QuadSet>", 4, NULL},
        {"<QuadSet DEF='q'><!-- <Coordinate point=''/> -->" QUADS "</QuadSet >", 4, NULL},
        {"<QuadSet><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 3 0 0'/></QuadSet>", 2, few},
        {"<IndexedQuadSet index='4 5 6 7'>" QUADS "</IndexedQuadSet>", 2, NULL},
        {"<IndexedQuadSet solid='false'\nindex = \"0,1,2,3 4 5 6 7 1\">" QUADS "</IndexedQuadSet>", 4, few},
        {"<QuadSet DEF='q'>" QUADS "</QuadSet></Shape><Shape><QuadSet USE='q'/>", 8, NULL},
        {"<IndexedQuadSet DEF='q' index='0 1 2 3'>" QUADS "</IndexedQuadSet></Shape><Shape><QuadSet/></Shape>"
         "<Shape><IndexedQuadSet USE='q'></IndexedQuadSet>",
         4, none},
        {"<QuadSet DEF='q'>" QUADS
         "</QuadSet></Shape><Shape><QuadSet DEF='r'/></Shape><Shape><QuadSet USE='r'>"
         "</QuadSet></Shape><Shape><QuadSet USE='q'/>",
         8, none},
        {"<QuadSet DEF='q'><Coordinate USE='c'/></QuadSet></Shape><Shape><QuadSet USE='q'/>", 0, none},
        {"<QuadSet><Coordinate DEF='c' point='0 0 0 1 0 0, 1 1 0 0 1 0'/></QuadSet></Shape><Shape><QuadSet>"
         "<Coordinate USE='c'/></QuadSet></Shape><Shape><IndexedQuadSet index='1 2 3 0'><Coordinate USE='c'/>"
         "</IndexedQuadSet>",
         6, NULL},
        {"<IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate DEF='d' point='0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 1 "
         "1 0 0 2'/>"
         "</IndexedFaceSet></Shape><Shape><QuadSet><Coordinate USE='d'/></QuadSet>",
         3, few},
        {"<QuadSet><Coordinate DEF='c' point='0 0 0 1 0 0, 1 1 0 0 1 0'/></QuadSet></Shape><Shape><QuadSet "
         "USE='c'/>",
         2, none},
        {"<QuadSet><Coordinate USE='c'/></QuadSet>", 0, none},
        {"<QuadSet/></Shape><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>" QUADS "</IndexedFaceSet>", 1,
         none},
        {"<QuadSet></QuadSet></Shape><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>" QUADS "</IndexedFaceSet>",
         1, none},
        {"<IndexedQuadSet index='0 1 2'>" QUADS "</IndexedQuadSet>", 0, none},
        {"<IndexedQuadSet>" QUADS "</IndexedQuadSet>", 0, none},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("q.x3d", "<X3D><Scene>%s<Shape>%s</Shape></Scene></X3D>", SHAPE(""), cases[i].text);
        struct scene_model *const model = load("q.x3d");
        if (model->triangles_drawn != 1 + cases[i].triangles) {
            fail_msg("case %zu: %" PRIu64 " triangles", i, (uint64_t)model->triangles_drawn);
        }
        const bool is_told = cases[i].told != NULL;
        if (model->unsupported_count != is_told || (is_told && !is_unsupported(model, cases[i].told))) {
            fail_msg("case %zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
    struct scene_model *const model =
        load_text("c.x3d", "<X3D><Scene><Shape><QuadSet><Color color='1 0 0 0 1 0 0 0 1 1 1 1'/>"
                           "<Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/></QuadSet></Shape></Scene></X3D>");
    assert_int_equal(model->mesh_count, 1);
    const struct scene_mesh *const mesh = &model->meshes[0];
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float x = mesh->positions[i][0], y = mesh->positions[i][1], *color = mesh->colors[i];
        assert_true(color[0] == (x == 0) && color[1] == (x != y) && color[2] == y);
    }
    scene_model_free(model);
}

// Quads that use one list of points are drawn as long as what is written for them stays of a bounded size.
static void test_quads_of_the_same_points(void **state)
{
    (void)state;
    enum { QUADS_EACH = 2000, USES = 300, LONGEST = 80 };
    static const char quad[] = "0 0 0 1 0 0 1 1 0 0 1 0 ";
    static char text[QUADS_EACH * sizeof quad + USES * LONGEST + 4096];
    strcpy(text, "<X3D><Scene><Shape><QuadSet><Coordinate DEF='c' point='");
    char *out = text + strlen(text);
    for (int i = 0; i < QUADS_EACH; i++) {
        out += sprintf(out, "%s", quad);
    }
    out += sprintf(out, "'/></QuadSet></Shape>");
    for (int i = 1; i < USES; i++) {
        out += sprintf(out, "<Shape><QuadSet><Coordinate USE='c'/></QuadSet></Shape>");
    }
    strcpy(out, "</Scene></X3D>");
    struct scene_model *const model = load_text("s.x3d", text);
    assert_true(is_unsupported(model, "quads: not drawn"));
    const uint64_t sets = model->triangles_drawn / (2 * QUADS_EACH);
    assert_int_equal(model->triangles_drawn, sets * 2 * QUADS_EACH);
    assert_true(sets > 50 && sets < 250);
    scene_model_free(model);
}

// Sets that use a few points each of one long list have no more points than corners, so that all of them are drawn.
static void test_few_of_many_points(void **state)
{
    (void)state;
    enum { POINTS = 20000, SETS = 500, LONGEST = 120 };
    static char text[POINTS * 16 + SETS * LONGEST + 4096];
    strcpy(text, "<X3D><Scene><Shape><PointSet><Coordinate DEF='c' point='");
    char *out = text + strlen(text);
    for (int i = 0; i < POINTS; i++) {
        out += sprintf(out, "%d %d 0 ", i / 2, i % 2);
    }
    out += sprintf(out, "'/></PointSet></Shape>");
    for (int i = 0; i < SETS; i++) {
        const int first = i * (POINTS / SETS);
        out += sprintf(
            out,
            "<Shape><IndexedFaceSet coordIndex='%d %d %d'><Coordinate USE='c'/></IndexedFaceSet></Shape>",
            first, first + 2, first + 1);
    }
    strcpy(out, "</Scene></X3D>");
    struct scene_model *const model = load_text("s.x3d", text);
    assert_int_equal(model->unsupported_count, 0);
    assert_int_equal(model->triangles_drawn, SETS);
    assert_int_equal(model->meshes[SETS].vertex_count, 3);
    scene_model_free(model);
}

// A roof of two triangles, one of which rises by 0.3 rad from the other's plane.
#define ROOF "<Coordinate point='0 0 0 0 1 0 1 0 0 -0.9553 0 0.2955'/>"
#define FOLD "coordIndex='0 2 1 -1 0 1 3 -1'"

// Values of a corner of a mesh: its normal, colour, or place in the texture.
struct corner_check {
    uint32_t corner;
    char what;
    float values[3];
};

static void check_corner(size_t number, const struct scene_mesh *mesh, const struct corner_check *check)
{
    assert_true(check->corner < mesh->index_count);
    const uint32_t vertex = mesh->indices[check->corner];
    const float *const values = check->what == 'n'   ? mesh->normals[vertex]
                                : check->what == 'c' ? mesh->colors[vertex]
                                                     : mesh->uvs[0][vertex];
    for (int i = 0; i < (check->what == 'u' ? 2 : 3); i++) {
        const float error = values[i] - check->values[i];
        if (error > 1e-3f || error < -1e-3f) {
            fail_msg("case %zu: %c%d of corner %u is %g", number, check->what, i, check->corner,
                     (double)values[i]);
        }
    }
}

// Faces have the normals, colours and texture coordinates that X3D says, by their own indices too, and edges up to the
// crease angle are smooth.
static void test_corners(void **state)
{
    (void)state;
    static const struct {
        const char *set;
        uint32_t corners, vertices;
        struct corner_check checks[2];
    } cases[] = {
        {"<IndexedFaceSet " FOLD ">" ROOF "</IndexedFaceSet>",
         6,
         6,
         {{0, 'n', {0, 0, 1}}, {1, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet creaseAngle='0.0' " FOLD ">" ROOF "</IndexedFaceSet>", 6, 6, {{2, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet creaseAngle='0.2' " FOLD ">" ROOF "</IndexedFaceSet>", 6, 6, {{2, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet creaseAngle='0.4' " FOLD ">" ROOF "</IndexedFaceSet>",
         6,
         4,
         {{0, 'n', {0.149f, 0, 0.989f}}, {2, 'n', {0.149f, 0, 0.989f}}}},
        {"<IndexedFaceSet normalPerVertex='false' creaseAngle='0.4' " FOLD ">" ROOF "</IndexedFaceSet>",
         6,
         6,
         {{0, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet ccw='false' creaseAngle='3.2' coordIndex='0 1 2 3'><Coordinate point='0 0 0 0 1 0 "
         "1 1 "
         "0 1 0 0'/></IndexedFaceSet>",
         6,
         4,
         {{0, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet creaseAngle='1.5' coordIndex='0 2 1 -1 0 1 3'><Coordinate point='0 0 0 0 1 0 1 0 0 "
         "0 0 "
         "-1'/></IndexedFaceSet>",
         6,
         6,
         {{0, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet creaseAngle='3.2' coordIndex='0 2 1 -1 0 1 3'><Coordinate point='0 0 0 0 1 0 1 0 0 "
         "0 0 "
         "-1'/></IndexedFaceSet>",
         6,
         4,
         {{0, 'n', {-0.7071f, 0, 0.7071f}}}},
        {"<IndexedTriangleSet normalPerVertex='false' index='0 2 1 0 1 3'>" ROOF "</IndexedTriangleSet>",
         6,
         6,
         {{0, 'n', {0, 0, 1}}}},
        {"<IndexedTriangleSet index='0 2 1 0 1 3'>" ROOF "</IndexedTriangleSet>",
         6,
         4,
         {{0, 'n', {0.149f, 0, 0.989f}}}},
        // Triangles with indices are smooth across any edge whose points they share, and others are flat.
        {"<IndexedTriangleSet index='0 2 1 0 1 3'><Coordinate point='0 0 0 0 1 0 1 0 0 0 0 -1'/>"
         "</IndexedTriangleSet>",
         6,
         4,
         {{0, 'n', {-0.7071f, 0, 0.7071f}}}},
        {"<IndexedTriangleSet index='0 1 2 3 4 5'><Coordinate point='0 0 0 1 0 0 0 1 0 0 0 0 0 1 0 -1 0 "
         "-0.3'/></IndexedTriangleSet>",
         6,
         6,
         {{0, 'n', {0, 0, 1}}}},
        {"<TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0 0 0 0 0 1 0 -1 0 -0.3'/></TriangleSet>",
         6,
         6,
         {{0, 'n', {0, 0, 1}}}},
        {"<IndexedFaceSet normalPerVertex='false' " FOLD ">" ROOF
         "<Normal vector='0 0.6 0.8 0 -0.6 0.8'/></IndexedFaceSet>",
         6,
         6,
         {{0, 'n', {0, 0.6f, 0.8f}}, {3, 'n', {0, -0.6f, 0.8f}}}},
        {"<IndexedFaceSet normalPerVertex='false' normalIndex='1 0' " FOLD
         "><Normal vector='0 0.6 0.8 0 -0.6 "
         "0.8'/>" ROOF "</IndexedFaceSet>",
         6,
         6,
         {{0, 'n', {0, -0.6f, 0.8f}}, {3, 'n', {0, 0.6f, 0.8f}}}},
        {"<IndexedFaceSet normalIndex='0 0 1 -1 0 1 1 -1' " FOLD
         "><Normal vector='0 0.6 0.8 0 -0.6 0.8'/>" ROOF "</IndexedFaceSet>",
         6,
         4,
         {{1, 'n', {0, 0.6f, 0.8f}}, {2, 'n', {0, -0.6f, 0.8f}}}},
        {"<IndexedFaceSet colorPerVertex='false' " FOLD ">" ROOF
         "<Color color='1 0 0 0 1 0'/></IndexedFaceSet>",
         6,
         6,
         {{2, 'c', {1, 0, 0}}, {3, 'c', {0, 1, 0}}}},
        {"<IndexedFaceSet colorPerVertex='false' colorIndex='1 0' " FOLD ">" ROOF
         "<ColorRGBA color='1 0 0 1 0 0 1 1'/></IndexedFaceSet>",
         6,
         6,
         {{2, 'c', {0, 0, 1}}, {3, 'c', {1, 0, 0}}}},
        {"<IndexedFaceSet creaseAngle='1' colorIndex='0 1 2 -1 0 2 1 -1' " FOLD ">" ROOF
         "<Color color='1 0 0 0 1 0 0 0 1'/></IndexedFaceSet>",
         6,
         4,
         {{1, 'c', {0, 1, 0}}, {5, 'c', {0, 1, 0}}}},
        {"<IndexedFaceSet creaseAngle='1' texCoordIndex='0 1 2 -1 3 2 0 -1' " FOLD ">" ROOF
         "<TextureCoordinate point='0 0 1 0 0 1 0.5 0.25'/></IndexedFaceSet>",
         6,
         5,
         {{0, 'u', {0, 1}}, {3, 'u', {0.5f, 0.75f}}}},
        {"<TriangleStripSet ccw='false' stripCount='4'><Coordinate point='0 0 0 0 1 0 1 0 0 1 1 "
         "0'/></TriangleStripSet>",
         6,
         4,
         {{0, 'n', {0, 0, 1}}, {3, 'n', {0, 0, 1}}}},
        {"<IndexedTriangleFanSet index='1 0 2 -1 1 3 0 -1'>" ROOF "</IndexedTriangleFanSet>",
         6,
         4,
         {{0, 'n', {0.149f, 0, 0.989f}}}},
        {"<ElevationGrid xDimension='3' zDimension='2' xSpacing='0.5' height='0 0 0.5 0 0 0.5'/>",
         12,
         10,
         {{0, 'n', {0, 1, 0}}, {0, 'u', {0, 0}}}},
        {"<ElevationGrid creaseAngle='3.2' xDimension='3' zDimension='2' xSpacing='0.5' height='0 0 0 0 0 0'>"
         "</ElevationGrid>",
         12,
         6,
         {{0, 'n', {0, 1, 0}}, {1, 'u', {0.5f, 0}}}},
        {"<ElevationGrid ccw='false' colorPerVertex='false' xDimension='3' zDimension='2' height='0 0 0 0 0 "
         "0'>"
         "<Color color='1 0 0 0 1 0'/></ElevationGrid>",
         12,
         8,
         {{0, 'n', {0, -1, 0}}, {6, 'c', {0, 1, 0}}}},
        // More normals than points, of which the first are used.
        {"<IndexedFaceSet " FOLD ">" ROOF
         "<Normal vector='0 0.6 0.8 0 -0.6 0.8 0 0.6 0.8 1 0 0 0 0 1'/></IndexedFaceSet>",
         6,
         4,
         {{4, 'n', {0, -0.6f, 0.8f}}, {5, 'n', {1, 0, 0}}}},
        {"<TriangleSet colorPerVertex='false'><CoordinateDouble point='0 0 0 1 0 0 0 1 0 5 0 0 6 0 0 5 1 0'/>"
         "<Color color='1 0 0 0 1 0'/></TriangleSet>",
         6,
         6,
         {{0, 'c', {1, 0, 0}}, {5, 'c', {0, 1, 0}}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("c.x3d", "<X3D><Scene><Shape>%s</Shape></Scene></X3D>", cases[i].set);
        struct scene_model *const model = load("c.x3d");
        assert_int_equal(model->mesh_count, 1);
        const struct scene_mesh *const mesh = &model->meshes[0];
        if (mesh->index_count != cases[i].corners || mesh->vertex_count != cases[i].vertices ||
            model->unsupported_count > 0) {
            fail_msg("case %zu: %u corners, %u vertices, %u lines", i, mesh->index_count, mesh->vertex_count,
                     model->unsupported_count);
        }
        for (size_t k = 0; k < 2 && cases[i].checks[k].what != 0; k++) {
            check_corner(i, mesh, &cases[i].checks[k]);
        }
        scene_model_free(model);
    }
}

// A file that ends anywhere is refused, or has nothing that the whole one has not.
static void test_cut_files(void **state)
{
    (void)state;
    static const char text[] =
        "<X3D><Scene><Group DEF='g'><PointLight DEF='l'/><Shape><Appearance><ImageTexture url='\"a.png\" "
        "\"b.png\"'/><UnlitMaterial emissiveColor='1 0 0'/></Appearance><IndexedFaceSet coordIndex='0 1 2 "
        "-1'>"
        "<Coordinate DEF='c' point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape></Group><Transform "
        "translation='1 0 0'><Group USE='g'><!-- again --></Group></Transform><Shape><ElevationGrid "
        "xDimension='2' zDimension='2' height='0 1 0 1'/></Shape><MetadataString value='\"m\"'/><Shape>"
        "<IndexedQuadSet index='0 1 2 &#48;'><Coordinate USE='c'/></IndexedQuadSet></Shape></Scene></X3D>";
    for (size_t cut = 0; cut < sizeof text; cut += 3) {
        write_bytes("t.x3d", text, sizeof text - 1 - cut);
        char error[512] = "";
        struct scene_model *const model = scene_model_load(path_of("t.x3d"), NULL, error, sizeof error);
        assert_true(model != NULL || error[0] != 0);
        assert_true(model == NULL || model->triangles_drawn <= 6);
        assert_true(cut > 0 || model->triangles_drawn == 6);
        scene_model_free(model);
    }
}

// Heights of a grid may have as many digits as they like.
static void test_long_heights(void **state)
{
    (void)state;
    enum { DIGITS = 3000 };
    static char height[DIGITS + 1];
    memset(height, '0', DIGITS);
    memcpy(height, "2.", 2);
    write_format("h.x3d",
                 "<X3D><Scene><Shape><ElevationGrid xDimension='2' zDimension='2' height='%s %s %s "
                 "%s'/></Shape></Scene></X3D>",
                 height, height, height, height);
    struct scene_model *const model = load("h.x3d");
    assert_int_equal(model->unsupported_count, 0);
    assert_int_equal(model->triangles_drawn, 2);
    for (uint32_t i = 0; i < model->meshes[0].vertex_count; i++) {
        assert_true(model->meshes[0].positions[i][1] == 2);
    }
    scene_model_free(model);
}

// A set whose colours are too few has none, which is not black, and a reference to a blank parts numbers.
static void test_lacking_colors(void **state)
{
    (void)state;
    struct scene_model *const model = load_text(
        "k.x3d", "<X3D><Scene><Shape><IndexedFaceSet coordIndex='0 1 2 -1 &#10;0&#xA;2&#x0d;3&#9;-1'>"
                 "<Coordinate point='0 0 0 1 0 0 1 1 0&#32;0 1 0'/><Color color='1 0 0 0 1 0'/>"
                 "</IndexedFaceSet></Shape></Scene></X3D>");
    assert_int_equal(model->triangles_drawn, 2);
    assert_true(is_unsupported(model, LACKING));
    assert_int_equal(model->unsupported_count, 1);
    assert_null(model->meshes[0].colors);
    scene_model_free(model);
}

// Points of a set of faces are those of lines too, which use them again.
static void test_points_of_faces(void **state)
{
    (void)state;
    struct scene_model *const model = load_text(
        "p.x3d", "<X3D><Scene><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>"
                 "<Coordinate DEF='c' point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape>"
                 "<Shape><IndexedLineSet coordIndex='0 1 2 -1'><Coordinate USE='c'/></IndexedLineSet></Shape>"
                 "<Shape><PointSet><Coordinate USE='c'></Coordinate></PointSet></Shape></Scene></X3D>");
    assert_int_equal(model->mesh_count, 3);
    assert_int_equal(model->meshes[1].primitive, SCENE_PRIMITIVE_LINES);
    assert_int_equal(model->meshes[1].index_count, 4);
    assert_int_equal(model->meshes[2].index_count, 3);
    scene_model_free(model);
}

// Lines are drawn as lines however many points they have, each in its colour.
static void test_lines(void **state)
{
    (void)state;
    struct scene_model *const model = load_text(
        "l.x3d", "<X3D><Scene><Shape><IndexedLineSet DEF='l' colorPerVertex='false' colorIndex='1 0' "
                 "coordIndex='0 1 2 3 -1 4 5 -1 5'><Color color='1 0 0 0 1 0'/>"
                 "<Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0'/></IndexedLineSet></Shape>"
                 "<Shape><LineSet vertexCount='4 2'>"
                 "<Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0'/></LineSet></Shape>"
                 "<Shape><IndexedLineSet USE='l'/></Shape></Scene></X3D>");
    assert_int_equal(model->triangles_drawn, 0);
    assert_int_equal(model->mesh_count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(model->meshes[i].primitive, SCENE_PRIMITIVE_LINES);
        assert_int_equal(model->meshes[i].index_count, 8);
    }
    const struct scene_mesh *const mesh = &model->meshes[0];
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t vertex = mesh->indices[i];
        const bool is_red = mesh->positions[vertex][0] == 2;
        assert_true(mesh->colors[vertex][0] == is_red && mesh->colors[vertex][1] == !is_red);
    }
    assert_true(is_unsupported(model, "lines of one point (X3D): left out"));
    assert_int_equal(model->unsupported_count, 1);
    scene_model_free(model);
}

// Of points that are not there assimp would read and write what follows the others.
static void test_points_that_are_not_there(void **state)
{
    (void)state;
    static const char points[] = "<Coordinate point='0 0 0 1 0 0 0 1 0'/><Color color='1 0 0 0 1 0'/>";
    static const char *const sets[][3] = {
        {"IndexedLineSet colorPerVertex='false' coordIndex='65536 1 2 -1 2 0'", "IndexedLineSet",
         "a line refers to vertex 65536 of 3"},
        {"IndexedFaceSet coordIndex='0 1 3'", "IndexedFaceSet", "a face refers to vertex 3 of 3"},
        {"IndexedQuadSet index='0 1 2 3'", "IndexedQuadSet", "a face refers to vertex 3 of 3"}};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        write_format("p.x3d", "<X3D><Scene><Shape><%s>%s</%s></Shape></Scene></X3D>", sets[i][0], points,
                     sets[i][1]);
        expect_refused("p.x3d", sets[i][2]);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_addresses),
    cmocka_unit_test(test_nodes),
    cmocka_unit_test(test_faces_within_faces),
    cmocka_unit_test(test_groups_within_groups),
    cmocka_unit_test(test_lights_that_are_used_again),
    cmocka_unit_test(test_names_of_lights),
    cmocka_unit_test(test_quads),
    cmocka_unit_test(test_quads_of_the_same_points),
    cmocka_unit_test(test_few_of_many_points),
    cmocka_unit_test(test_corners),
    cmocka_unit_test(test_cut_files),
    cmocka_unit_test(test_long_heights),
    cmocka_unit_test(test_lacking_colors),
    cmocka_unit_test(test_points_of_faces),
    cmocka_unit_test(test_lines),
    cmocka_unit_test(test_points_that_are_not_there),
};

const struct unit_tests test_x3d = UNIT_TESTS(tests, make_directory, remove_directory);
