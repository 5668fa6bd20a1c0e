// SPDX-License-Identifier: MIT
// What a picture of a model is about: what is seen, without specks far away.
#include "model_files.h"

#include "draw/camera/camera.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Two red texels that are transparent, and two green ones that are not.
static const unsigned char half_clear[] = {0,  0, 2, 0,   0, 0, 0, 0,   0, 0, 0,   0, 4,   0, 1,   0, 32,
                                           40, 0, 0, 255, 0, 0, 0, 255, 0, 0, 255, 0, 255, 0, 255, 0, 255};

// A file with a square of side 1 in the plane z = 0, seen as it stands, and once more as the node and the material say.
// Its images are a red pixel that is transparent and a green one that is not; u below a half is the red one.
static struct scene_model *load_pair(const char *material, const char *node, bool is_colored)
{
    static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    static const float uv[4][2] = {{.2f, 1}, {.3f, 1}, {.3f, 0}, {.2f, 0}};
    static const float colors[4][4] = {{1, 1, 1, 0}, {1, 1, 1, 0}, {1, 1, 1, 0}, {1, 1, 1, 0}};
    unsigned char bytes[156] = {0};
    memcpy(bytes, square, sizeof square);
    memcpy(bytes + 48, uv, sizeof uv);
    memcpy(bytes + 80, colors, sizeof colors);
    memcpy(bytes + 144, (const uint8_t[]){0, 1, 2, 0, 2, 3}, 6);
    write_format("pair.gltf",
                 "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],"
                 "\"nodes\":[{\"mesh\":0},{\"mesh\":1,%s}],\"materials\":[{},{%s}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":3}]},"
                 "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1%s},\"indices\":3,"
                 "\"material\":1}]}],"
                 "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
                 "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
                 "{\"bufferView\":0,\"byteOffset\":80,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"
                 "{\"bufferView\":0,\"byteOffset\":144,\"componentType\":5121,\"count\":6,"
                 "\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":156}],"
                 "\"buffers\":[{\"byteLength\":156,\"uri\":\"%s\"}]}",
                 node, material, is_colored ? ",\"COLOR_0\":2" : "", data_uri(half_clear, sizeof half_clear),
                 data_uri(bytes, sizeof bytes));
    return load("pair.gltf");
}

#define COLOR(alpha)           "\"baseColorFactor\":[1,1,1," alpha "]"
#define SURFACE(mode, members) "\"alphaMode\":\"" mode "\",\"pbrMetallicRoughness\":{" members "}"
#define IMAGE                  "\"baseColorTexture\":{\"index\":0}"

static void test_what_is_never_seen_sets_no_frame(void **state)
{
    (void)state;
    static const char far[] = "\"translation\":[5,5,5]";
    static const struct {
        const char *material, *node;
        bool is_colored, is_seen;
    } cases[] = {
        {SURFACE("BLEND", COLOR("0")), far, false, false},
        {SURFACE("BLEND", COLOR("0.002")), far, false, false},
        {SURFACE("BLEND", COLOR("0.0038")), far, false, false},
        {SURFACE("BLEND", COLOR("0.0040")), far, false, true},
        {SURFACE("BLEND", COLOR("0.02")), far, false, true},
        {SURFACE("OPAQUE", COLOR("0")), far, false, true},
        {SURFACE("MASK", COLOR("0.49")), far, false, false},
        {SURFACE("MASK", COLOR("0.51")), far, false, true},
        {"\"alphaCutoff\":2," SURFACE("MASK", COLOR("1")), far, false, false},
        {SURFACE("BLEND", IMAGE), far, false, false},
        {SURFACE("MASK", IMAGE), far, false, false},
        {SURFACE("OPAQUE", IMAGE), far, false, true},
        {SURFACE("BLEND", COLOR("1")), far, true, false},
        {SURFACE("OPAQUE", COLOR("1")), far, true, true},
        {SURFACE("OPAQUE", COLOR("1")), "\"translation\":[5,5,5],\"scale\":[0,0,0]", false, false},
        {SURFACE("OPAQUE", COLOR("1")), "\"translation\":[5,5,5],\"scale\":[0,1,1]", false, false},
        {SURFACE("OPAQUE", COLOR("1")), "\"translation\":[5,5,5],\"scale\":[1,1,0]", false, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene_model *model = load_pair(cases[i].material, cases[i].node, cases[i].is_colored);
        assert_int_equal(model->instance_count, 2);
        assert_true(model->bounds_max[2] == 5 && !model->instances[0].unseen);
        if (model->is_framed != !cases[i].is_seen || model->instances[1].unseen != !cases[i].is_seen) {
            fail_msg("case %zu is %s", i, model->is_framed ? "not seen" : "seen");
        }
        assert_true(!model->is_framed || (model->frame_max[0] == 1 && model->frame_max[2] == 0));
        scene_model_free(model);
    }
}

// Of a mesh that a mask cuts away in part, what is left sets the frame. A picture of nothing is about all of it.
static void test_parts_that_are_cut_away(void **state)
{
    (void)state;
    static const char material[] = "newmtl m\nmap_Kd half.tga\nmap_d half.tga\n";
    write_bytes("half.tga", half_clear, sizeof half_clear);
    write_text("half.mtl", material);
    for (int shows = 0; shows < 2; shows++) {
        write_format("half.obj",
                     "mtllib half.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\n"
                     "vt %s 0\nvt %s 0\nvt .2 0\nf 1/1 2/1 3/2\nf 4/3 5/3 6/3\n",
                     shows ? ".8" : ".2", shows ? ".9" : ".3");
        struct scene_model *model = load("half.obj");
        assert_true(model->bounds_max[0] == 9 && model->is_framed == (shows == 1));
        assert_true(!shows || (model->frame_max[0] == 1 && model->frame_max[1] == 1));
        assert_false(model->instances[0].unseen);
        scene_model_free(model);
    }
}

// Corners that a joint of scale 0 has brought to one place draw nothing there.
static void test_corners_at_one_place(void **state)
{
    (void)state;
    for (int apart = 0; apart < 2; apart++) {
        write_format("joint.obj",
                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 5 5\nv 5.%d 5 5\nv 5 5.%d 5\nf 1 2 3\nf 4 5 6\n", apart,
                     apart);
        struct scene_model *model = load("joint.obj");
        assert_true(model->bounds_max[0] >= 5 && model->is_framed == !apart && !model->instances[0].unseen);
        assert_true(apart || model->frame_max[0] == 1);
        scene_model_free(model);
    }
}

// Write a cube as eight vertices and twelve triangles after `count` vertices.
static int add_cube(char *text, int length, int count, double x, double y, double side)
{
    static const int faces[12][3] = {{1, 3, 2}, {2, 3, 4}, {5, 6, 7}, {6, 8, 7}, {1, 2, 5}, {2, 6, 5},
                                     {3, 7, 4}, {4, 7, 8}, {1, 5, 3}, {3, 5, 7}, {2, 4, 6}, {4, 8, 6}};
    for (int i = 0; i < 8; i++) {
        length += sprintf(text + length, "v %.12g %.12g %.12g\n", x + side * (i & 1), y + side * (i >> 1 & 1),
                          side * (i >> 2));
    }
    for (int i = 0; i < 12; i++) {
        length += sprintf(text + length, "f %d %d %d\n", faces[i][0] + count, faces[i][1] + count,
                          faces[i][2] + count);
    }
    return length;
}

// A speck at the origin does not make a model that is far from it one that is not seen, or seen in float's coarse steps.
static void test_a_speck_at_the_origin(void **state)
{
    (void)state;
    static const char *const specks[] = {"o speck", "f 9 10 11\np 9", "o speck\nf 9 10 11", "p 9"};
    for (size_t i = 0; i < sizeof specks / sizeof *specks; i++) {
        for (int is_first = 0; is_first < 2 && (i == 0 || is_first == 0); is_first++) {
            char text[4096] = "";
            int length = is_first ? add_cube(text, 0, 0, 0, 0, 0.01) : 0;
            length += is_first ? sprintf(text + length, "%s\n", specks[i]) : 0;
            length = add_cube(text, length, 8 * is_first, 500000.25, 4000000.5, 1);
            if (i > 0) {
                length += sprintf(text + length, "v 0 0 0\nv 0.01 0 0\nv 0 0.01 0\n%s\n", specks[i]);
            } else if (is_first == 0) {
                length += sprintf(text + length, "%s\n", specks[i]);
                add_cube(text, length, 8, 0, 0, 0.01);
            }
            struct scene_model *model = load_text("map.obj", text);
            assert_true(model->is_framed && has_warning(model, "specks far away"));
            assert_true((double)model->frame_min[0] + model->origin[0] == 500000.25);
            assert_true((double)model->frame_min[1] + model->origin[1] == 4000000.5);
            assert_true(model->frame_max[0] - model->frame_min[0] == 1);
            const struct scene_camera camera = scene_camera_fit(
                model, scene_camera_default_orbit(model, model->up), scene_camera_default_yfov(), 1);
            assert_true(fabs(camera.eye[0] - 500000) < 10 && fabs(camera.eye[1] - 4000000) < 10);
            scene_model_free(model);
        }
    }
}

static void test_specks_set_no_frame(void **state)
{
    (void)state;
    static const struct {
        double places[4][3]; // x, y and side of a cube; 0 is none
        double width;        // of the frame; 0 if nothing is left out
    } cases[] = {
        {{{0, 0, 1}, {1000, 0, .01}}, 1},
        {{{1000, 0, .01}, {0, 0, 1}}, 1},
        {{{0, 0, 1}, {1000, 0, .01}, {-300, 0, .05}, {0, -1e6, .001}}, 1},
        {{{0, 0, 1}, {1000, 0, .01}, {-300, 0, .05}, {0, -1e9, .001}},
         1}, // too far for the floats of one mesh
        {{{0, 0, 1}, {3, 0, .01}, {1000, 0, .01}}, 3.01},
        {{{0, 0, 1}, {10, 0, .01}}, 0},                        // near enough to be seen with the rest
        {{{0, 0, 1}, {1000, 0, 1}}, 0},                        // two of a size
        {{{0, 0, 1}, {1000, 0, .2}}, 0},                       // no speck
        {{{0, 0, 1}, {40, 0, 1}, {80, 0, 1}, {120, 0, 1}}, 0}, // a row
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int is_apart = 0; is_apart < 2; is_apart++) { // in one mesh, and each in its own
            char text[4096] = "";
            int length = 0;
            for (int k = 0; k < 4 && cases[i].places[k][2] > 0; k++) {
                const double *place = cases[i].places[k];
                length += is_apart ? sprintf(text + length, "o cube%d\n", k) : 0;
                length = add_cube(text, length, 8 * k, place[0], place[1], place[2]);
            }
            struct scene_model *model = load_text("specks.obj", text);
            const double width = (double)model->frame_max[0] - (double)model->frame_min[0];
            if (model->is_framed != (cases[i].width > 0) ||
                (model->is_framed && fabs(width - cases[i].width) > 1e-5)) {
                fail_msg("case %zu, %d: %g instead of %g", i, is_apart, model->is_framed ? width : 0,
                         cases[i].width);
            }
            assert_true(has_warning(model, "specks far away") == model->is_framed);
            scene_model_free(model);
        }
    }
}

// A scan has points that its instrument saw in the sky. Discs are as large as the others are apart.
static void test_a_point_in_the_sky(void **state)
{
    (void)state;
    FILE *file = fopen(path_of("sky.ply"), "w");
    assert_non_null(file);
    fputs("ply\nformat ascii 1.0\nelement vertex 401\nproperty float x\nproperty float y\nproperty float z\n"
          "end_header\n900 900 900\n",
          file);
    for (int i = 0; i < 400; i++) {
        fprintf(file, "%d %d 0\n", i % 20, i / 20);
    }
    assert_int_equal(fclose(file), 0);
    struct scene_model *model = load("sky.ply");
    assert_true(model->is_framed && model->frame_max[0] == 19 && model->frame_max[2] == 0);
    assert_true(model->meshes[0].point_radius > 0 && model->meshes[0].point_radius < 3);
    scene_model_free(model);
}

// Stray points of a cloud, the fewer the farther they are, set no frame. A cloud whose points become fewer to its ends
// is framed whole.
static void test_stray_points(void **state)
{
    (void)state;
    enum { SIDE = 16, POINTS = SIDE * SIDE * SIDE, STRAYS = 10 };
    static char text[POINTS * 40];
    const double place = -30; // all of it is on one side of the origin
    for (int case_number = 0; case_number < 3; case_number++) {
        char *out = text;
        for (int i = 0; i < POINTS; i++) {
            const double x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
            const double along = case_number == 1 ? x * x * x / SIDE / SIDE : x;
            out += sprintf(out, "%g %g %g\n", place + along, place + y, place + z);
        }
        for (int i = 0; i < STRAYS && case_number != 1; i++) {
            const double far = SIDE * (case_number == 0 ? 1 + 0.4 * i : 1 + 0.03 * i);
            out += sprintf(out, "%g %g %g\n", place + (i % 2 == 0 ? far : 1), place + (i % 2 == 0 ? 1 : far),
                           place + far);
        }
        struct scene_model *const model = load_text("c.xyz", text);
        assert_int_equal(model->is_framed, case_number == 0);
        assert_int_equal(has_warning(model, "stray points are outside a fitted picture"), case_number == 0);
        for (int c = 0; c < 3 && case_number == 0; c++) {
            assert_true(model->frame_min[c] == place && model->frame_max[c] >= place + SIDE - 1);
            assert_true(model->frame_max[c] < place + 1.5 * SIDE);
        }
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_what_is_never_seen_sets_no_frame),
    cmocka_unit_test(test_parts_that_are_cut_away),
    cmocka_unit_test(test_corners_at_one_place),
    cmocka_unit_test(test_specks_set_no_frame),
    cmocka_unit_test(test_a_speck_at_the_origin),
    cmocka_unit_test(test_a_point_in_the_sky),
    cmocka_unit_test(test_stray_points),
};

const struct unit_tests test_frame = UNIT_TESTS(tests, make_directory, remove_directory);
