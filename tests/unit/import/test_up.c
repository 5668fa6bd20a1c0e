// SPDX-License-Identifier: MIT
// Which axis of a model is up, where its format leaves it open.
#include "model_files.h"

#include <stdio.h>
#include <string.h>

// A pyramid that stands on its base, seen along an axis, which points to its tip; as OBJ, OFF or STL.
static void write_pyramid(const char *name, int axis)
{
    static const float corners[5][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.5f, 0.5f, 3}};
    static const int faces[6][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    const char ending = name[strlen(name) - 1]; // obJ, ofF, stL
    fputs(ending == 'f' ? "OFF\n5 6 0\n" : ending == 'l' ? "solid s\n" : "", file);
    for (int v = 0; v < 5 && ending != 'l'; v++) {
        const float *p = corners[v];
        fprintf(file, "%s%g %g %g\n", ending == 'j' ? "v " : "", (double)p[(5 - axis) % 3],
                (double)p[(6 - axis) % 3], (double)p[(7 - axis) % 3]);
    }
    for (int f = 0; f < 6; f++) {
        const int *c = faces[f];
        if (ending != 'l') {
            const int base = ending == 'j';
            fprintf(file, "%s%d %d %d\n", base ? "f " : "3 ", c[0] + base, c[1] + base, c[2] + base);
            continue;
        }
        fputs("facet normal 0 0 0\nouter loop\n", file);
        for (int k = 0; k < 3; k++) {
            const float *p = corners[c[k]];
            fprintf(file, "vertex %g %g %g\n", (double)p[(5 - axis) % 3], (double)p[(6 - axis) % 3],
                    (double)p[(7 - axis) % 3]);
        }
        fputs("endloop\nendfacet\n", file);
    }
    fputs(ending == 'l' ? "endsolid s\n" : "", file);
    assert_int_equal(fclose(file), 0);
}

static void test_axes(void **state)
{
    (void)state;
    static const char *const names[] = {"up.obj", "up.off", "up.stl"};
    for (int i = 0; i < 3; i++) {
        for (int axis = 1; axis < 3; axis++) {
            write_pyramid(names[i], axis);
            struct scene_model *model = load(names[i]);
            assert_true(model->bounds_max[axis] == 3);
            assert_int_equal(model->up, axis == 2 ? SCENE_AXIS_Z : SCENE_AXIS_Y);
            assert_int_equal(model->up_guessed, (axis == 2) != (i == 2));
            scene_model_free(model);
        }
    }
    // A relief that faces the viewer has its broad side below along z, but must not lie.
    struct scene_model *model = load_text("card.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 .05\n"
                                                      "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    assert_int_equal(model->up, SCENE_AXIS_Y);
    scene_model_free(model);
    // Along z all of the base, along y a strip beside it: a fifth or a tenth of that side.
    for (int tenth = 0; tenth < 2; tenth++) {
        char text[256];
        snprintf(text, sizeof text,
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\nv 0 0 %g\nv 1 0 %g\n"
                 "f 4 3 2 1\nf 1 2 7 6\nf 2 3 5\nf 3 4 5\nf 4 1 5\n",
                 tenth ? 0.1 : 0.2, tenth ? 0.1 : 0.2);
        model = load_text("strip.obj", text);
        assert_int_equal(model->up, tenth ? SCENE_AXIS_Z : SCENE_AXIS_Y);
        scene_model_free(model);
    }
    // Broad backs and thin things look as if they stood along z, and do not: a lamp on a wall, an arrow, a banner.
    static const char *const lying[] = {"v 0 1 0\nv .5 -.6 .9\n", "v 0 1 0\nv .5 -.1 6\n",
                                        "v 0 2 0\nv .5 -.1 .2\n"};
    for (size_t i = 0; i < sizeof lying / sizeof *lying; i++) {
        char text[256];
        for (int is_said = 0; is_said < 2; is_said++) { // the program that wrote it says more than the shape
            snprintf(text, sizeof text,
                     "# made by\n# %s v0.19\nv 0 0 0\nv 1 0 0\nv 1 1 0\n%sf 4 3 2 1\nf 1 2 5\n"
                     "f 2 3 5\nf 3 4 5\nf 4 1 5\n",
                     is_said ? "FreeCAD" : "Blender", lying[i]);
            model = load_text("lying.obj", text);
            assert_int_equal(model->up, is_said ? SCENE_AXIS_Z : SCENE_AXIS_Y);
            assert_false(model->up_guessed);
            scene_model_free(model);
        }
    }
    // A speck far below is not what it stands on.
    model =
        load_text("speck.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 -.1 2\nv 0 -900 0\nv .01 -900 0\n"
                               "v 0 -900 .01\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 6 7 8\n");
    assert_true(model->is_framed);
    assert_int_equal(model->up, SCENE_AXIS_Z);
    scene_model_free(model);
    // Nothing to stand on, neither way: what is usual.
    model = load_text("tip.obj", "v 0 0 0\nv 1 3 3\nv 3 2 1\nv 1 2 4\nf 1 2 3\nf 1 3 4\n");
    assert_int_equal(model->up, SCENE_AXIS_Y);
    scene_model_free(model);
}

// Write a box of x, y and z from `low` to `high`. Axis k of the box is axis order[k] of the file, with a sign.
static void write_box(FILE *file, const double low[3], const double high[3], const int order[3], int sign)
{
    static const int faces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                                    {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
    for (int i = 0; i < 8; i++) {
        double point[3];
        for (int k = 0; k < 3; k++) {
            point[order[k]] = (i >> k & 1 ? high[k] : low[k]) * (k == 1 ? sign : 1);
        }
        fprintf(file, "v %g %g %g\n", point[0], point[1], point[2]);
    }
    for (int f = 0; f < 6; f++) {
        const int *const c = faces[f];
        fprintf(file, "f %d %d %d %d\n", c[0] - 9, c[1] - 9, c[2] - 9, c[3] - 9);
    }
}

enum car { CAR, CAR_ON_A_BOARD, CAR_WITH_WHEELS_APART, BUS, BUS_ASIDE, BUS_ABOVE };

static enum scene_axis up_of_car(const int order[3], int sign, enum car car)
{
    FILE *const file = fopen(path_of("car.obj"), "w");
    assert_non_null(file);
    const double lift = car == BUS_ABOVE ? 0.1 : 0; // its wheels do not reach the ground
    write_box(file, (double[]){-1, -2, lift + 0.4}, (double[]){1, 2, lift + 1}, order, sign);
    write_box(file, (double[]){-0.9, -1, lift + 1}, (double[]){0.9, 1.5, lift + 1.6}, order, sign);
    const double half = car < BUS ? 0.6 : 1, low = car < BUS ? 0.5 : 0.4, high = car < BUS ? 0.7 : 1.6;
    write_box(file, (double[]){-half, -2.2, lift + low}, (double[]){half, -2, lift + high}, order, sign);
    for (int i = 0; i < 4; i++) {
        const double x = i % 2 == 0 ? -1 : 0.8,
                     y = (i < 2 ? -1.4 : 1) + (car == CAR_WITH_WHEELS_APART && i % 2 == 0 ? 0.4 : 0);
        write_box(file, (double[]){x, y, lift}, (double[]){x + 0.2, y + 0.4, lift + 0.8}, order, sign);
    }
    if (car == CAR_ON_A_BOARD) {
        write_box(file, (double[]){-1, -2, 0}, (double[]){1, 2, 0.01}, order, sign);
    }
    if (car == BUS_ASIDE) { // the middle is elsewhere by a thing behind it
        write_box(file, (double[]){-0.1, 3.4, 0.4}, (double[]){0.1, 3.6, 0.6}, order, sign);
    }
    assert_int_equal(fclose(file), 0);
    struct scene_model *const model = load("car.obj");
    const enum scene_axis up = model->up;
    assert_int_equal(model->up_guessed, up == SCENE_AXIS_Z);
    scene_model_free(model);
    return up;
}

// A car of the format that nearly always has y up stands on its wheels, and not on its nose or its side.
static void test_cars(void **state)
{
    (void)state;
    static const int along_y[3] = {0, 1, 2}, along_x[3] = {1, 0, 2}, usual_along_z[3] = {0, 2, 1},
                     usual_along_x[3] = {2, 0, 1};
    assert_int_equal(up_of_car(along_y, 1, CAR), SCENE_AXIS_Z);
    for (int sign = -1; sign < 2; sign += 2) {
        assert_int_equal(up_of_car(usual_along_z, sign, CAR), SCENE_AXIS_Y);
        assert_int_equal(up_of_car(usual_along_x, sign, CAR), SCENE_AXIS_Y);
    }
    // What is on a back, or is no mirror image of itself, is no car.
    assert_int_equal(up_of_car(along_y, 1, CAR_ON_A_BOARD), SCENE_AXIS_Y);
    assert_int_equal(up_of_car(along_y, 1, CAR_WITH_WHEELS_APART), SCENE_AXIS_Y);
    // A bus may as well stand on its nose, and a car on its side, unless it rests in the middle of the ground.
    assert_int_equal(up_of_car(along_y, 1, BUS), SCENE_AXIS_Z);
    assert_int_equal(up_of_car(along_x, 1, CAR), SCENE_AXIS_Z);
    assert_int_equal(up_of_car(along_x, 1, BUS_ABOVE), SCENE_AXIS_Y);
    assert_int_equal(up_of_car(usual_along_z, 1, BUS), SCENE_AXIS_Y);
    assert_int_equal(up_of_car(along_y, 1, BUS_ASIDE), SCENE_AXIS_Y);
    assert_int_equal(up_of_car(along_y, 1, BUS_ABOVE), SCENE_AXIS_Y);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_axes),
    cmocka_unit_test(test_cars),
};

const struct unit_tests test_up = UNIT_TESTS(tests, make_directory, remove_directory);
