// SPDX-License-Identifier: MIT
// Clouds of points as text: what their columns mean.
#include "model_files.h"

static const struct scene_mesh *only_mesh(const struct scene_model *model, uint32_t count)
{
    assert_int_equal(model->instance_count, 1);
    assert_int_equal(model->meshes[0].primitive, SCENE_PRIMITIVE_POINTS);
    assert_int_equal(model->meshes[0].index_count, count);
    return &model->meshes[0];
}

// 255 0 0 is red and 0 0 1 white's scale of 255, where a number is above 1; a normal has a length of 1.
static void test_columns(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text;
        bool colored, has_normals;
        uint32_t unsupported;
    } cases[] = {
        {"a.xyz", "1 2 3\n4 5 6\n", false, false, 0},
        {"b.xyz", "# of a scanner\n//X Y Z R G B\nX,Y,Z,R,G,B\n1,2,3,255,0,0\n4;5;6;0;0;255\n", true, false,
         0},
        {"c.xyz", "1 2 3 0.6 0 0.8\n4 5 6 0 -1 0\n", false, true, 0},
        {"d.xyz", "1 2 3 255 0 0 0.6 0 0.8\n4 5 6 0 0 255 0 0 -1\n", true, true, 0},
        {"e.xyz", "1 2 3 0.6 0 0.8 255 0 0\n4 5 6 0 0 -1 0 0 255\n", true, true, 0},
        {"f.xyz", "1 2 3 255 0 0 12\n4 5 6 0 0 255 -7\n", true, false, 1},
        {"o.xyz", "1 2 3 255 0 0 255\n4 5 6 0 0 255 255\n", true, false, 0},
        {"g.xyz", "1 2 3 -12\n4 5 6 -7\n", false, false, 1},
        {"h.pts", "2\n1 2 3 -1500 255 0 0\n4 5 6 -1000 0 0 255\n", true, false, 1},
        {"i.pts", "1\r\n1 2 3 255 0 0\r\n1\r\n4 5 6 0 0 255\r\n", true, false, 0},
        {"k.xyz", "1 2 3 255 0 0\n4 5 6 0 0 255 7\n", true, false, 1},
        {"l.xyz", "1 2 3 255 0 0 0.6 0 0.8 255 9\n4 5 6 0 0 255 0 0 -1 255 9\n", true, true, 1},
        {"m.asc", "//X Y Z R G B Intensity\n2\n1 2 3 1 0 0 15.0\n4 5 6 0 0 1 15.0\n", true, false, 1},
        {"j.xyz",
         "\xef\xbb\xbf"
         "1 2 3 1 0 0\n4 5 6 0 0 1",
         true, false, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_text(cases[i].name, cases[i].text);
        const struct scene_mesh *mesh = only_mesh(model, 2);
        assert_floats(mesh->positions[0], (const float[]){1, 2, 3}, 3, 0);
        assert_floats(mesh->positions[1], (const float[]){4, 5, 6}, 3, 0);
        assert_int_equal(mesh->colors != NULL, cases[i].colored);
        if (cases[i].colored) {
            assert_floats(mesh->colors[0], (const float[]){1, 0, 0, 1}, 4, 0);
            assert_floats(mesh->colors[1], (const float[]){0, 0, 1, 1}, 4, 0);
        }
        assert_int_equal(mesh->normals != NULL, cases[i].has_normals);
        if (cases[i].has_normals) {
            assert_floats(mesh->normals[0], (const float[]){0.6f, 0, 0.8f}, 3, 1e-6f);
        }
        assert_int_equal(model->unsupported_count, cases[i].unsupported);
        assert_int_equal(model->warning_count, 0);
        scene_model_free(model);
    }
}

// A survey: floats would hold halves of a metre there, and all distances are 1/8.
static void test_far(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("far.xyz", "665187.5 5648349.125 241\n665187.625 5648349.25 241.125\n"
                             "665187.75 5648349.375 241.25\n");
    const struct scene_mesh *mesh = only_mesh(model, 3);
    for (int i = 0; i < 2; i++) {
        for (int c = 0; c < 3; c++) {
            assert_true(mesh->positions[i + 1][c] - mesh->positions[i][c] == 0.125f);
        }
    }
    scene_model_free(model);
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *cause;
    } cases[] = {
        {"water.xyz", "3\nwater\nO 0 0 0\nH 1 0 0\nH 0 1 0\n",
         "lists atoms (XYZ of chemistry), which are not supported"},
        {"cut.pts", "3\n1 2 3\n4 5 6\n", "is cut: it has 2 of 3 points"},
        {"words.xyz", "no point at all\n", "is no cloud of points: no line has three numbers"},
        {"short.xyz", "1 2 3\n4 5\n", "line 2: a point needs three numbers"},
        {"fewer.xyz", "1 2 3 4\n4 5 6\n", "line 2: a point has fewer numbers than the first one"},
        {"word.xyz", "1 2 3\n4 5 6 seven\n", "line 2: a point needs three numbers"},
        {"hill.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6\n",
         "is a grid of Esri (terrain), which is not supported"},
        {"key.asc", "-----BEGIN PGP SIGNATURE-----\n", "is no cloud of points: no line has three numbers"},
        {"scan.ptx", "1\n1\n", "is PTX (point cloud), which is not supported"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_text(cases[i].name, cases[i].text);
        expect_refused(cases[i].name, cases[i].cause);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_columns),
    cmocka_unit_test(test_far),
    cmocka_unit_test(test_refused),
};

const struct unit_tests test_xyz = UNIT_TESTS(tests, make_directory, remove_directory);
