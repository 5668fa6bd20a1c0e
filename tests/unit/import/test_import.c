// SPDX-License-Identifier: MIT
// The OBJ and PLY readers, and the parts they rest on: numbers, polygons, normals, the way to the parent.
#include "import/builder/bounds.h"
#include "import/builder/face_weights.h"
#include "import/builder/polygon.h"
#include "import/blob.h"
#include "import/builder/text_lines.h"
#include "import/builder/vector.h"
#include "import/builder/vertices.h"
#include "model_files.h"
#include "rhw/rhw.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t random_state = 1;

static uint32_t next_random(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

// Numbers -------------------------------------------------------------------------------------------

static double number_of(const char *text)
{
    double value = 0;
    size_t length = 0;
    assert_true(scene_word_number((struct scene_word){text, strlen(text)}, &value, &length));
    assert_int_equal(length, strlen(text));
    return value;
}

static void test_numbers(void **state)
{
    (void)state;
    static const char *const samples[] = {
        "0",
        "-0",
        "1",
        "+1",
        ".5",
        "-.5e1",
        "5.",
        "1e3",
        "1E-3",
        "0.1",
        "3.4028235e38",
        "1e-45",
        "1.17549435e-38",
        "123456789012345678901234567890",
        "0.000000000000000000000000000001",
        "9007199254740993",
        "1e22",
        "1e23",
        "1e400",
        "4.35",
        "0.30000000000000004",
        "-12.75",
        "1e-007",
    };
    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
        assert_true(number_of(samples[i]) == strtod(samples[i], NULL));
    }
    for (int i = 0; i < 20000; i++) {
        char text[64];
        const double value = (double)(int32_t)next_random() * pow(10, (int)(next_random() % 60) - 30);
        snprintf(text, sizeof text, "%.*g", 1 + (int)(next_random() % 17), value);
        if (number_of(text) != strtod(text, NULL)) {
            fail_msg("%s is read as %.17g", text, number_of(text));
        }
    }
    assert_true(isnan(number_of("nan")) && isnan(number_of("-1.#IND")) && isnan(number_of("NaN(x)")));
    assert_true(number_of("-inf") == -(double)INFINITY);
    double value = 0;
    size_t length = 0;
    assert_false(scene_word_number((struct scene_word){"abc", 3}, &value, &length));
    assert_false(scene_word_number((struct scene_word){"-", 1}, &value, &length));
    assert_true(scene_word_number((struct scene_word){"1e", 2}, &value, &length) && length == 1);
    // What stands behind the word does not belong to it.
    assert_true(scene_word_number((struct scene_word){"1e5", 2}, &value, &length) && value == 1 &&
                length == 1);
}

// Polygons ------------------------------------------------------------------------------------------

static double area_of(const float (*points)[3], const uint32_t *corners)
{
    const float *a = points[corners[0]], *b = points[corners[1]], *c = points[corners[2]];
    return 0.5 * (((double)b[0] - (double)a[0]) * ((double)c[1] - (double)a[1]) -
                  ((double)b[1] - (double)a[1]) * ((double)c[0] - (double)a[0]));
}

// Stars have corners that turn both ways: the triangles must cover them once and nothing else.
static void test_polygons(void **state)
{
    (void)state;
    enum { CORNERS = 40 };
    for (int round = 0; round < 500; round++) {
        float points[CORNERS][3];
        uint32_t corners[CORNERS], triangles[3 * (CORNERS - 2)];
        const uint32_t count = 4 + next_random() % (CORNERS - 4);
        double whole = 0, sum = 0;
        for (uint32_t i = 0; i < count; i++) {
            const double angle = 6.283185307179586 * i / count,
                         radius = 0.2 + (next_random() % 1000) / 1000.0;
            points[i][0] = (float)(radius * cos(angle));
            points[i][1] = (float)(radius * sin(angle));
            points[i][2] = 3;
            corners[i] = i;
        }
        for (uint32_t i = 0; i < count; i++) {
            const float *a = points[i], *b = points[(i + 1) % count];
            whole += 0.5 * ((double)a[0] * (double)b[1] - (double)a[1] * (double)b[0]);
        }
        const struct scene_mesh mesh = {.positions = points};
        struct scene_import import = {.fan_count = 0};
        scene_import_triangulate(&import, &mesh, corners, count, triangles);
        for (uint32_t i = 0; i < count - 2; i++) {
            const double area = area_of((const float(*)[3])points, triangles + 3 * i);
            assert_true(area > -1e-9);
            sum += area;
        }
        assert_true(fabs(sum - whole) < 1e-6);
    }
}

// A comb of thousands of teeth, whose triangles cover it once and nothing else.
static void test_large_polygons(void **state)
{
    (void)state;
    enum { TEETH = 2000, CORNERS = 2 * TEETH + 2 };
    static float points[CORNERS][3];
    static uint32_t corners[CORNERS], triangles[3 * (CORNERS - 2)];
    double whole = 0, sum = 0;
    for (uint32_t i = 0; i < CORNERS; i++) {
        const uint32_t tooth = (CORNERS - 1 - i) / 2;
        points[i][0] = (float)tooth + (i % 2 == 0 && i > 0 ? 0.5f : 0);
        points[i][1] = i == 0 ? -1.0f : i % 2 == 0 ? 10.0f : 1.0f + (float)(next_random() % 8);
        corners[i] = i;
    }
    points[0][0] = TEETH;
    points[CORNERS - 1][0] = 0;
    points[CORNERS - 1][1] = -1;
    for (uint32_t i = 0; i < CORNERS; i++) {
        const float *a = points[i], *b = points[(i + 1) % CORNERS];
        whole += 0.5 * ((double)a[0] * (double)b[1] - (double)a[1] * (double)b[0]);
    }
    const struct scene_mesh mesh = {.positions = points};
    struct scene_import import = {.fan_count = 0};
    scene_import_triangulate(&import, &mesh, corners, CORNERS, triangles);
    for (uint32_t i = 0; i < CORNERS - 2; i++) {
        const double area = area_of((const float(*)[3])points, triangles + 3 * i);
        assert_true(area >= 0);
        sum += area;
    }
    assert_true(whole > 0 && fabs(sum - whole) < 1e-6 * whole);
    assert_int_equal(import.fan_count, 0);
}

// A file of 10,000 polygons that cross themselves everywhere. Each takes many times the looks of a usual one, which
// would be half a minute for all. What they may take together is over at some of them, and the file says of how many a
// part is a fan.
static void test_hostile_polygons(void **state)
{
    (void)state;
    enum { POLYGONS = 10000, CORNERS = 120 };
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    for (int i = 0; i < CORNERS; i++) {
        fprintf(file, "v %u %u 0\n", next_random() % 1000, next_random() % 1000);
    }
    for (int i = 0; i < POLYGONS; i++) {
        fprintf(file, "f");
        for (int k = 1; k <= CORNERS; k++) {
            fprintf(file, " %d", k);
        }
        fprintf(file, "\n");
    }
    fclose(file);
    struct scene_model *model = load_text("hostile.obj", text);
    free(text);
    assert_int_equal(model->warning_count, 1);
    unsigned fans = 0;
    assert_int_equal(
        sscanf(model->warnings[0], "its polygons take too long to cut: a part of %u of them is a", &fans), 1);
    assert_in_range(fans, 1, POLYGONS - 1);
    scene_model_free(model);
}

// OBJ -----------------------------------------------------------------------------------------------

static void test_obj_cube(void **state)
{
    (void)state;
    const char *cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                       "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    struct scene_model *model = load_text("cube.obj", cube);
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_string_equal(model->format, "Wavefront OBJ");
    assert_int_equal(model->triangles_drawn, 12);
    // Its edges are creases: three normals, so three vertices, at each of 8 corners, each along its face.
    assert_int_equal(mesh->vertex_count, 24);
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const float *a = mesh->positions[mesh->indices[i]], *b = mesh->positions[mesh->indices[i + 1]],
                    *c = mesh->positions[mesh->indices[i + 2]];
        const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                    v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        const float normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                 u[0] * v[1] - u[1] * v[0]};
        for (uint32_t k = 0; k < 3; k++) {
            assert_floats(mesh->normals[mesh->indices[i + k]], normal, 3, 1e-6f);
        }
    }
    scene_model_free(model);
}

// A flat roof of two faces that meet at 20°: smooth, and the normals at the ridge point straight up.
static void test_obj_smooth(void **state)
{
    (void)state;
    const char *roof = "v -1 0 0\nv 0 .17632698 0\nv 1 0 0\nv -1 0 1\nv 0 .17632698 1\nv 1 0 1\n%s"
                       "f 1 4 5 2\nf 2 5 6 3\n";
    char text[512];
    snprintf(text, sizeof text, roof, "");
    struct scene_model *model = load_text("roof.obj", text);
    assert_int_equal(model->meshes[0].vertex_count, 6);
    for (uint32_t i = 0; i < 6; i++) {
        if (model->meshes[0].positions[i][0] == 0) {
            assert_floats(model->meshes[0].normals[i], (const float[]){0, 1, 0}, 3,
                          1e-5f); // angles are good to 7e-5
        }
    }
    scene_model_free(model);
    snprintf(text, sizeof text, roof, "s off\n");
    model = load_text("roof.obj", text);
    for (uint32_t i = 0; i < model->meshes[0].vertex_count; i++) {
        const float slope = model->meshes[0].normals[i][0];
        assert_true(fabsf(fabsf(slope) - 0.17364818f) < 1e-6f); // sin 10°
    }
    scene_model_free(model);
}

static int vertices_at_origin(const struct scene_mesh *mesh)
{
    int count = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *const p = mesh->positions[i];
        count += p[0] == 0 && p[1] == 0 && p[2] == 0;
    }
    return count;
}

// Three faces around a point, each 40° from the next and the outer ones 79° from each other: no edge between them is a
// crease, so there is one normal, that of the middle one.
static void test_a_ridge_is_not_torn(void **state)
{
    (void)state;
    const char *ridge = "v 0 0 0\nv 1 -.2 0\nv 1 .2 0\nv 0 -.766 -.643\nv 0 .766 -.643\n"
                        "f 1 4 2\nf 1 2 3\nf 1 3 5\n";
    struct scene_model *model = load_text("ridge.obj", ridge);
    const struct scene_mesh *const mesh = &model->meshes[0];
    assert_int_equal(vertices_at_origin(mesh), 1);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (mesh->positions[i][0] == 0 && mesh->positions[i][1] == 0) {
            assert_true(mesh->normals[i][2] > 0.9f && fabsf(mesh->normals[i][1]) < 1e-6f);
        }
    }
    scene_model_free(model);
}

// A triangle as small as noise, which leans by 45°, does not tilt the normal of the floor that it stands on.
static void test_a_speck_weighs_nothing(void **state)
{
    (void)state;
    const char *floor = "v 0 0 0\nv 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\nv .0002 0 0\nv 0 .0002 .0002\n"
                        "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\nf 1 6 2\nf 6 5 2\nf 1 6 7\n";
    struct scene_model *model = load_text("floor.obj", floor);
    const struct scene_mesh *const mesh = &model->meshes[0];
    assert_int_equal(vertices_at_origin(mesh), 1);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (mesh->positions[i][0] == 0 && mesh->positions[i][1] == 0) {
            assert_true(mesh->normals[i][2] > 0.99999f);
        }
    }
    scene_model_free(model);
}

// The faces around the tip of a steep cone go with their neighbours: one normal for all would be the axis.
static void test_a_tip_keeps_its_faces(void **state)
{
    (void)state;
    const char *cone =
        "v 0 0 0\nv 1 0 -4\nv .7 .7 -4\nv 0 1 -4\nv -.7 .7 -4\nv -1 0 -4\nv -.7 -.7 -4\nv 0 -1 -4\n"
        "v .7 -.7 -4\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\nf 1 6 7\nf 1 7 8\nf 1 8 9\nf 1 9 2\n";
    struct scene_model *model = load_text("cone.obj", cone);
    assert_int_equal(vertices_at_origin(&model->meshes[0]), 8);
    scene_model_free(model);
}

static void test_obj_syntax(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "syntax.obj",
        "# comment\r\no first\r\nv .5 -.25e1 1e-1\rv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nvt 1 0\nvt 0 1\nvn 0 0 2\n"
        "f -3/1/1 -2/2/-1 \\\n -1/3/1\no second part\nf 1 2 3\nl 1 2 3\np 1 2\n");
    assert_int_equal(model->instance_count, 4);
    assert_string_equal(model->instances[1].name, "second part");
    assert_int_equal(model->instances[0].object, 1);
    assert_int_equal(model->instances[3].object, 2);
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_floats(mesh->positions[mesh->indices[0]], (const float[]){0.5f, -2.5f, 0.1f}, 3, 0);
    assert_floats(mesh->uvs[0][mesh->indices[0]], (const float[]){0.25f, 0.25f}, 2, 0); // v turned downward
    assert_floats(mesh->normals[0], (const float[]){0, 0, 1}, 3, 0);
    assert_int_equal(model->meshes[2].primitive, SCENE_PRIMITIVE_LINES);
    assert_int_equal(model->meshes[2].index_count, 4);
    assert_int_equal(model->meshes[3].primitive, SCENE_PRIMITIVE_POINTS);
    scene_model_free(model);
    // UTF-16 with its mark, and vertices alone.
    const unsigned char wide[] = {0xff, 0xfe, 'v', 0,   ' ', 0,   '1', 0,    ' ',
                                  0,    '2',  0,   ' ', 0,   '3', 0,   '\n', 0};
    write_bytes("wide.obj", wide, sizeof wide);
    model = load("wide.obj");
    assert_int_equal(model->meshes[0].primitive, SCENE_PRIMITIVE_POINTS);
    assert_floats(model->meshes[0].positions[0], (const float[]){1, 2, 3}, 3, 0);
    scene_model_free(model);
}

static void test_obj_materials(void **state)
{
    (void)state;
    write_text("a b.mtl", "newmtl red one\nKd 1 0 0\nNs 30\nKs 1 1 1\nd 0.5\nTr 0.9\n"
                          "newmtl textured\nKd 0 0 0\nmap_Kd -s 2 3 1 -o .5 -clamp on no file.png\n");
    struct scene_model *model =
        load_text("materials.obj",
                  "mtllib a b.mtl\nv 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                  "usemtl red one\nf 1 2 3\nusemtl textured\nf 1/1 2/2 3/3\nusemtl red one\nf 3 2 1\n");
    assert_int_equal(model->mesh_count, 2); // both runs of red are one
    assert_int_equal(model->meshes[0].index_count, 6);
    const struct scene_material *red = &model->materials[model->meshes[0].material];
    const struct scene_material *textured = &model->materials[model->meshes[1].material];
    assert_string_equal(red->name, "red one");
    assert_int_equal(red->alpha_mode, SCENE_ALPHA_BLEND);
    assert_floats(&red->base_color[3], (const float[]){0.5f}, 1, 0); // d counts, not Tr
    assert_floats(&red->roughness, (const float[]){0.5f}, 1, 1e-6f); // (2 / 32)^¼
    assert_true(red->double_sided);
    // Vertex colours: those not given are white, the given are decoded from sRGB.
    const struct scene_mesh *mesh = &model->meshes[0];
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const bool origin = mesh->positions[i][0] == 0 && mesh->positions[i][1] == 0;
        assert_floats(mesh->colors[i],
                      origin ? (const float[]){1, 0.21404114f, 0, 1} : (const float[]){1, 1, 1, 1}, 4, 1e-6f);
    }
    const struct scene_texture_slot *slot = &textured->slots[SCENE_SLOT_BASE_COLOR];
    assert_floats(textured->base_color, (const float[]){1, 1, 1, 1}, 4, 0);
    assert_string_equal(model->images[slot->image].name, "no file.png");
    assert_int_equal(slot->address_u, RHW_ADDRESS_CLAMP);
    assert_floats(slot->transform, (const float[]){2, 0, 0.5f, 0, 3, -2}, 6, 0);
    scene_model_free(model);
}

// PLY -----------------------------------------------------------------------------------------------

static const char ply_header[] =
    "ply\nformat %s 1.0\ncomment made by a test\nelement vertex 4\nproperty float x\nproperty double "
    "y\nproperty short z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\n"
    "element face 1\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";

static void put(unsigned char **out, const void *value, size_t size, bool swap)
{
    for (size_t i = 0; i < size; i++) {
        (*out)[i] = ((const unsigned char *)value)[swap ? size - 1 - i : i];
    }
    *out += size;
}

static void write_binary_ply(const char *name, const char *format, bool swap)
{
    unsigned char bytes[1024];
    unsigned char *out = bytes + sprintf((char *)bytes, ply_header, format);
    for (int i = 0; i < 4; i++) {
        const float x = i == 1 || i == 2 ? 1 : 0, quality = 5;
        const double y = i >= 2 ? 0.5 : 0;
        const int16_t z = -7;
        const uint8_t color[3] = {255, 128, 0};
        put(&out, &x, 4, swap);
        put(&out, &y, 8, swap);
        put(&out, &z, 2, swap);
        for (int c = 0; c < 3; c++) {
            put(&out, &color[c], 1, swap);
        }
        put(&out, &quality, 4, swap);
    }
    const uint8_t head[2] = {9, 4};
    put(&out, &head[0], 1, swap);
    put(&out, &head[1], 1, swap);
    for (int32_t i = 0; i < 4; i++) {
        put(&out, &i, 4, swap);
    }
    write_bytes(name, bytes, (size_t)(out - bytes));
}

static void check_ply(struct scene_model *model)
{
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_string_equal(model->format, "PLY");
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->index_count, 6);
    assert_floats(mesh->positions[2], (const float[]){1, 0.5f, -7}, 3, 0);
    assert_floats(mesh->colors[3], (const float[]){1, 0.21586050f, 0, 1}, 4, 1e-6f);
    assert_floats(mesh->normals[0], (const float[]){0, 0, 1}, 3, 1e-6f);
    scene_model_free(model);
}

// Two triangles share vertices whose normals point up; one lies with its corners the other way round.
static void test_normals_turned_apart(void **state)
{
    (void)state;
    struct scene_model *model = load_text("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\n"
                                                   "f 1//1 2//1 3//1\nf 2//1 3//1 4//1\nl 1 2\n");
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_int_equal(mesh->vertex_count, 6); // two of four are in both
    const int corners[6] = {0, 1, 2, 1, 2, 3};
    for (uint32_t i = 0; i < 6; i++) {
        const float place[3] = {(float)(corners[i] % 2), (float)(corners[i] / 2), 0};
        assert_floats(mesh->positions[mesh->indices[i]], place, 3, 0);
        assert_floats(mesh->normals[mesh->indices[i]], (const float[]){0, 0, i < 3 ? 1 : -1}, 3, 0);
    }
    scene_model_free(model);
}

// A slope over an edge: normals that are smoothed are not of one mind there, and the rest of the mesh decides.
static void test_normals_of_two_minds(void **state)
{
    (void)state;
    const char *vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 0 9\nvn 0 0 1\nvn 1 0 0\n";
    const char *clockwise = "f 1//1 3//1 2//1\nf 2//1 3//1 4//1\nf 2//1 4//1 5//2\n",
               *counter = "f 1//1 2//1 3//1\nf 2//1 4//1 3//1\nf 2//1 4//1 5//2\n";
    for (int i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text, "%s%s", vertices, i == 0 ? clockwise : counter);
        struct scene_model *model = load_text("x.obj", text);
        const struct scene_mesh *mesh = &model->meshes[0];
        assert_int_equal(mesh->index_count, 9);
        for (uint32_t k = 0; k < 8; k++) {
            assert_floats(mesh->normals[mesh->indices[k]], (const float[]){0, 0, i == 0 ? -1 : 1}, 3, 0);
        }
        assert_floats(mesh->normals[mesh->indices[8]], (const float[]){i == 0 ? -1 : 1, 0, 0}, 3, 0);
        scene_model_free(model);
    }
}

// A normal map's frame is turned as a whole: N × T is y in both, so that the bitangent goes with the fourth number.
static void test_tangents_are_turned(void **state)
{
    (void)state;
    write_text("x.mtl", "newmtl a\nnorm bumps.png\n");
    const char *vertices =
        "mtllib x.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n";
    for (int i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text, "%s%s", vertices,
                 i == 0 ? "f 1/1/1 2/2/1 3/3/1\n" : "f 1/1/1 3/3/1 2/2/1\n");
        struct scene_model *model = load_text("x.obj", text);
        const struct scene_mesh *mesh = &model->meshes[0];
        const float sign = i == 0 ? 1 : -1;
        assert_floats(mesh->normals[0], (const float[]){0, 0, sign}, 3, 0);
        assert_non_null(mesh->tangents);
        assert_floats(mesh->tangents[0], (const float[]){sign, 0, 0, sign}, 4, 1e-6f);
        scene_model_free(model);
    }
}

static void test_no_area(void **state)
{
    (void)state;
    const char *warning = "none of its triangles has an area: there is nothing to see";
    struct scene_model *model = load_text("x.obj", "v 0 0 0\nv 1 2 3\nv -1 -2 -3\nf 1 2 3\n");
    assert_true(has_warning(model, warning));
    assert_true(model->lacks_area);
    scene_model_free(model);
    model = load_text("x.obj", "v 0 0 0\nv 1 2 3\nv -1 -2 -3\nv 1 0 0\nf 1 2 3\nf 1 2 4\n");
    assert_int_equal(model->warning_count, 0);
    assert_false(model->lacks_area);
    scene_model_free(model);
    model = load_text("x.obj", "v 0 0 0\nv 1 2 3\nl 1 2\n");
    assert_int_equal(model->warning_count, 0);
    scene_model_free(model);
}

static void test_ply(void **state)
{
    (void)state;
    write_binary_ply("little.ply", "binary_little_endian", false);
    check_ply(load("little.ply"));
    write_binary_ply("big.ply", "binary_big_endian", true);
    check_ply(load("big.ply"));
    char text[1024];
    const int length = snprintf(text, sizeof text, ply_header, "ascii");
    snprintf(
        text + length, sizeof text - (size_t)length,
        "0 0 -7 255 128 0 5\n1 0 -7 255 128 0 5\n1 .5 -7 255 128 0 5 0 0.5\n-7 255 128 0 5\n9 4 0 1 2 3");
    check_ply(load_text("ascii.ply", text));
    text[strlen(text) - 4] = 0;
    write_text("short.ply", text);
    expect_refused("short.ply", "truncated: it ends in face 0 of 1");
}

static void test_ply_elements(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "strips.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nelement edge 2\nproperty int "
        "vertex1\nproperty int vertex2\n"
        "end_header\n0 0 0 1 0 0 0 1 0 1 1 0\n8 0 1 2 3 -1 3 2 1\n0 1 2 3\n");
    assert_int_equal(model->mesh_count, 2);
    assert_int_equal(model->meshes[0].primitive, SCENE_PRIMITIVE_LINES);
    assert_int_equal(model->meshes[0].index_count, 4);
    const uint32_t expected[] = {0, 1, 2, 2, 1, 3, 3, 2, 1};
    assert_int_equal(model->meshes[1].index_count, 9);
    for (int i = 0; i < 9; i++) {
        const float *position = model->meshes[1].positions[model->meshes[1].indices[i]];
        assert_floats(position, (const float[]){(float)(expected[i] % 2), (float)(expected[i] / 2), 0}, 3, 0);
    }
    scene_model_free(model);
    // Texture coordinates per corner: the shared edge has two of each.
    model = load_text("wedges.ply",
                      "ply\nformat ascii 1.0\ncomment TextureFile lost.png\nelement vertex 4\nproperty float "
                      "x\nproperty float y\nproperty float z\n"
                      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
                      "texcoord\nend_header\n"
                      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 .5 0 1 1 0 1\n");
    assert_int_equal(model->meshes[0].vertex_count, 5);
    assert_true(has_warning(model, "lost.png"));
    scene_model_free(model);
}

// The way to the parent -----------------------------------------------------------------------------

static size_t write_blob(unsigned char *bytes, size_t capacity)
{
    uint32_t indices[3] = {0, 1, 2};
    float positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
          normals[3][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    uint8_t texel[4] = {1, 2, 3, 4};
    struct scene_mesh mesh = {.name = "mesh",
                              .vertex_count = 3,
                              .index_count = 3,
                              .indices = indices,
                              .positions = positions,
                              .normals = normals};
    struct scene_material material = {.name = "material"};
    for (int i = 0; i < SCENE_SLOT_COUNT; i++) {
        material.slots[i] = (struct scene_texture_slot){.image = i == 0 ? 0 : -1};
    }
    struct scene_image image = {.name = "image", .width = 1, .height = 1, .size = 4, .texels = texel};
    struct scene_instance instance = {.name = "node"};
    struct scene_model_animation animation = {.name = "walk", .seconds = 2.5f, .channel_count = 3};
    struct scene_model_extension extension = {.name = "KHR_extension", .is_drawn = true};
    const char *warning = "a warning";
    struct scene_model model = {.path = "p",
                                .format = "f",
                                .unit = "metre",
                                .mesh_count = 1,
                                .material_count = 1,
                                .image_count = 1,
                                .instance_count = 1,
                                .animation_count = 1,
                                .extension_count = 1,
                                .meshes = &mesh,
                                .materials = &material,
                                .images = &image,
                                .instances = &instance,
                                .animations = &animation,
                                .extensions = &extension,
                                .warning_count = 1,
                                .warnings = &warning};
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_true(scene_blob_write(&model, file));
    const size_t size = (size_t)ftell(file);
    assert_true(size <= capacity);
    rewind(file);
    assert_int_equal(fread(bytes, 1, size, file), size);
    fclose(file);
    return size;
}

static void test_blob(void **state)
{
    (void)state;
    enum { CAPACITY = 8192 };
    unsigned char *original = malloc(CAPACITY);
    const size_t size = write_blob(original, CAPACITY);
    unsigned char *copy = aligned_alloc(64, (size + 63) / 64 * 64);
    memcpy(copy, original, size);
    struct scene_model *model = scene_blob_read(copy, size);
    assert_non_null(model);
    assert_string_equal(model->warnings[0], "a warning");
    assert_string_equal(model->unit, "metre");
    assert_string_equal(model->animations[0].name, "walk");
    assert_int_equal(model->animations[0].channel_count, 3);
    assert_string_equal(model->extensions[0].name, "KHR_extension");
    assert_string_equal(model->meshes[0].name, "mesh");
    assert_floats(model->meshes[0].positions[1], (const float[]){1, 0, 0}, 3, 0);
    assert_null(model->meshes[0].colors);
    assert_int_equal(((uint8_t *)model->images[0].texels)[3], 4);
    for (size_t cut = 0; cut < size; cut++) {
        memcpy(copy, original, size);
        assert_null(scene_blob_read(copy, cut));
    }
    // A damaged byte may pass only where every index and count is still in range; what passes can be read.
    for (size_t i = 0; i < size; i++) {
        for (int bit = 0; bit < 8; bit++) {
            memcpy(copy, original, size);
            copy[i] ^= (unsigned char)(1 << bit);
            model = scene_blob_read(copy, size);
            if (model == NULL) {
                continue;
            }
            for (uint32_t k = 0; k < model->meshes[0].index_count; k++) {
                assert_true(model->meshes[0].indices[k] < model->meshes[0].vertex_count);
            }
            assert_true(model->instances[0].mesh < model->mesh_count);
            assert_true(model->meshes[0].material < model->material_count);
            assert_true(model->materials[0].slots[0].image < (int32_t)model->image_count);
        }
    }
    free(copy);
    free(original);
}

// Of points at one place the first stands for all, also where one has 0 and another −0. Points at different places stay
// apart, however many there are: their hashes alone would join some of these.
static void test_points_at_one_place(void **state)
{
    (void)state;
    enum { COUNT = 200000, SAME = 7 };
    struct scene_import import = {.read = NULL};
    float(*const positions)[3] = malloc(COUNT * sizeof *positions);
    for (uint32_t i = 0; i < COUNT; i++) {
        positions[i][0] = (float)(i / SAME % 101) + 0.25f;
        positions[i][1] = i % SAME == 3 ? -0.0f : 0.0f;
        positions[i][2] = -0x1p-9f * (float)(i / SAME);
    }
    const struct scene_mesh mesh = {.positions = positions, .vertex_count = COUNT};
    uint32_t *const first = scene_import_weld_positions(&import, &mesh, false);
    for (uint32_t i = 0; i < COUNT; i++) {
        assert_int_equal(first[i], i / SAME * SAME);
    }
    free(first);
    for (uint32_t i = 0; i < COUNT; i++) {
        positions[i][1] = (float)(i % SAME);
    }
    for (int are_distinct = 0; are_distinct < 2; are_distinct++) {
        uint32_t *const own = scene_import_weld_positions(&import, &mesh, are_distinct);
        for (uint32_t i = 0; i < COUNT; i++) {
            assert_int_equal(own[i], i);
        }
        free(own);
    }
    // No two have the same bytes, but two are at one place.
    const float pair[2][3] = {{0, 1, 2}, {-0.0f, 1, 2}};
    memcpy(positions, pair, sizeof pair);
    uint32_t *const joined = scene_import_weld_positions(&import, &mesh, true);
    assert_int_equal(joined[0], 0);
    assert_int_equal(joined[1], 0);
    assert_int_equal(joined[2], 2);
    free(joined);
    free(positions);
}

// Vertices that are equal become the first of them, also where more are different than was expected.
static void test_equal_vertices(void **state)
{
    (void)state;
    enum { COUNT = 6000, DIFFERENT = COUNT / 2 };
    struct scene_import import = {.read = NULL};
    struct scene_mesh mesh = {.vertex_count = COUNT,
                              .index_count = COUNT,
                              .positions = malloc(COUNT * sizeof *mesh.positions),
                              .colors = calloc(COUNT, sizeof *mesh.colors),
                              .indices = malloc(COUNT * sizeof *mesh.indices)};
    for (uint32_t i = 0; i < COUNT; i++) {
        mesh.indices[i] = i;
        for (int c = 0; c < 3; c++) {
            mesh.positions[i][c] = (float)(i % DIFFERENT / 2 + (uint32_t)c);
        }
        mesh.colors[i][3] = (float)(i % 2);
    }
    assert_false(scene_import_join_vertices(&import, &mesh));
    assert_int_equal(mesh.vertex_count, DIFFERENT);
    for (uint32_t i = 0; i < COUNT; i++) {
        assert_int_equal(mesh.indices[i], i % DIFFERENT);
        assert_true(mesh.positions[i % DIFFERENT][1] == (float)(i % DIFFERENT / 2 + 1));
        assert_true(mesh.colors[i % DIFFERENT][3] == (float)(i % 2));
    }
    free(mesh.colors);
    mesh.colors = NULL;
    assert_true(scene_import_join_vertices(&import, &mesh)); // positions alone
    assert_int_equal(mesh.vertex_count, DIFFERENT / 2);
    free(mesh.positions);
    free(mesh.indices);
}

// Bounds of any number of points are those of each by itself. What is not a number does not count, and is told.
static void test_bounds(void **state)
{
    (void)state;
    enum { MOST = 27 };
    for (uint32_t count = 0; count <= MOST; count++) {
        for (uint32_t odd = 0; odd <= count; odd++) { // a point that has none, or all are good
            float points[MOST][3], low[3], high[3];
            float least[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, most[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
            for (uint32_t i = 0; i < 3 * count; i++) {
                const float at = (float)(next_random() % 1000) - 500;
                points[i / 3][i % 3] = i / 3 == odd && i % 3 == odd % 3 ? NAN : at;
                if (points[i / 3][i % 3] == at) {
                    least[i % 3] = fminf(least[i % 3], at);
                    most[i % 3] = fmaxf(most[i % 3], at);
                }
            }
            assert_int_equal(scene_import_bound((const float(*)[3])points, count, low, high), odd == count);
            assert_memory_equal(low, least, sizeof low);
            assert_memory_equal(high, most, sizeof high);
        }
    }
}

enum { FACES = SCENE_FACE_BATCH - 3 };

// Points of a batch of faces are summed as each face by itself, in the order of the faces, and then made unit vectors.
static void assert_points(const struct scene_face_functions *functions, struct scene_face_batch *batch)
{
    enum { POINTS = SCENE_FACE_BATCH + 5 };
    struct scene_face_point points[POINTS] = {{{0}}};
    double sums[POINTS][4] = {{0}};
    for (uint32_t i = 0; i < 3 * FACES; i++) {
        const uint32_t point = i * i % (POINTS - 1);
        batch->points[i / 3][i % 3] = point;
        for (int c = 0; c < 3; c++) {
            sums[point][c] += batch->normals[c][i / 3] * batch->weights[i % 3][i / 3];
        }
        sums[point][3]++;
    }
    functions->add(batch, points);
    assert_memory_equal(points, sums, sizeof sums);
    functions->make_directions(points, POINTS);
    for (int i = 0; i < POINTS; i++) {
        scene_vector_unit(sums[i]);
    }
    assert_memory_equal(points, sums, sizeof sums);
}

// Check what the functions of an instruction set find of a mesh.
static void assert_batch(const struct scene_face_functions *functions, const struct scene_mesh *mesh)
{
    struct scene_face_batch batch = {.count = FACES}, normals = {.count = FACES};
    for (uint32_t i = 0; i < FACES; i++) {
        batch.faces[i] = normals.faces[i] = i;
    }
    functions->weigh(mesh, &batch);
    functions->find_normals(mesh, &normals);
    for (uint32_t i = 0; i < FACES; i++) {
        double ab[3], ac[3], bc[3], normal[3];
        scene_vector_between(mesh->positions[3 * i], mesh->positions[3 * i + 1], ab);
        scene_vector_between(mesh->positions[3 * i], mesh->positions[3 * i + 2], ac);
        scene_vector_between(mesh->positions[3 * i + 1], mesh->positions[3 * i + 2], bc);
        scene_cross(ab, ac, normal);
        const double area = __builtin_sqrt(scene_dot(normal, normal));
        scene_vector_unit(ab);
        scene_vector_unit(ac);
        scene_vector_unit(bc);
        const double weights[3] = {area * scene_vector_angle(scene_dot(ab, ac)),
                                   area * scene_vector_angle(-scene_dot(ab, bc)),
                                   area * scene_vector_angle(scene_dot(ac, bc))};
        for (int c = 0; c < 3; c++) {
            assert_true(batch.weights[c][i] == weights[c]);
            assert_true(batch.normals[c][i] == (area > 0 ? normal[c] / area : 0));
            assert_true(normals.normals[c][i] == batch.normals[c][i]);
        }
    }
    assert_points(functions, &batch);
}

// A batch of faces is weighed as each face by itself, by the formulas of doubles, bit for bit, on all instruction sets.
// One face has no area, and one batch is not full.
static void test_batch_of_faces(void **state)
{
    (void)state;
    static const struct scene_face_functions *const functions[RHW_ISA_COUNT] =
        RHW_ISA_TABLE(&scene_face_functions);
    float positions[3 * FACES][3];
    uint32_t indices[3 * FACES], random = 1;
    for (uint32_t i = 0; i < 9 * FACES; i++) {
        random = random * 1664525 + 1013904223;
        positions[i / 3][i % 3] = i < 9 ? 1.0f : (float)(random >> 8) * 0x1p-20f - 8.0f;
        indices[i / 3] = i / 3;
    }
    const struct scene_mesh mesh = {
        .indices = indices, .positions = positions, .vertex_count = 3 * FACES, .index_count = 3 * FACES};
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (functions[isa] != NULL && rhw_isa_supported((enum rhw_isa)isa)) {
            assert_batch(functions[isa], &mesh);
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_batch_of_faces),
    cmocka_unit_test(test_points_at_one_place),
    cmocka_unit_test(test_equal_vertices),
    cmocka_unit_test(test_bounds),
    cmocka_unit_test(test_numbers),
    cmocka_unit_test(test_polygons),
    cmocka_unit_test(test_large_polygons),
    cmocka_unit_test(test_hostile_polygons),
    cmocka_unit_test(test_obj_cube),
    cmocka_unit_test(test_obj_smooth),
    cmocka_unit_test(test_a_ridge_is_not_torn),
    cmocka_unit_test(test_a_speck_weighs_nothing),
    cmocka_unit_test(test_a_tip_keeps_its_faces),
    cmocka_unit_test(test_obj_syntax),
    cmocka_unit_test(test_obj_materials),
    cmocka_unit_test(test_normals_turned_apart),
    cmocka_unit_test(test_normals_of_two_minds),
    cmocka_unit_test(test_tangents_are_turned),
    cmocka_unit_test(test_no_area),
    cmocka_unit_test(test_ply),
    cmocka_unit_test(test_ply_elements),
    cmocka_unit_test(test_blob),
};

const struct unit_tests test_import = UNIT_TESTS(tests, make_directory, remove_directory);
