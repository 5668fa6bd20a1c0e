// SPDX-License-Identifier: MIT
// The outputs that show the work on a picture: overdraw, and what the tiles of the colour pass have.
#include "tiny_model.h"

#include <string.h>

enum { SIZE = 256, TILE = 64 }; // the square −1..1 is pixels 64..191: four tiles of sixteen

// Two squares, the second behind the first and half a square to the right.
static void make_two(struct tiny *t)
{
    tiny_make(t);
    t->model.instance_count = 2;
    t->instances[1].world[12] = 1.0f;
    t->instances[1].world[14] = -1.0f;
}

static int squares_at(int x, int y)
{
    const bool row = y >= TILE && y < 3 * TILE;
    return (row && x >= TILE && x < 3 * TILE) + (row && x >= 2 * TILE);
}

// Each surface counts once where it covers a pixel's centre, hidden, blended or not, but for what faces away.
static void test_overdraw(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        struct tiny t;
        make_two(&t);
        t.material.alpha_mode = kind == 1 ? SCENE_ALPHA_BLEND : SCENE_ALPHA_OPAQUE;
        struct scene_view view = tiny_view(&t, SIZE);
        view.outputs = SCENE_OUTPUT_OVERDRAW | SCENE_OUTPUT_OBJECT;
        view.camera.eye[2] = kind == 2 ? -5.0 : 5.0;
        struct scene_pictures p = tiny_draw(&t, &view);
        for (int i = 0; i < SIZE * SIZE; i++) {
            const int squares = kind == 2 ? 0 : squares_at(i % SIZE, i / SIZE);
            assert_int_equal((int)p.overdraw[i], squares);
            assert_int_equal(p.object[i] != 0, squares != 0); // beside it the nearest is seen as ever
        }
        scene_pictures_free(&p);
    }
}

// Two triangles for each square in a tile, the background none; with 2×2 pixels for one a tile has a quarter of the picture's.
// A square is 4×4 of those, and the tiles beside its diagonal have one of its triangles alone; where the squares overlap, no
// tile is on both diagonals.
static void test_tiles(void **state)
{
    (void)state;
    for (int supersample = 1; supersample <= 4; supersample += 3) {
        for (int background = 0; background < 2; background++) {
            struct tiny t;
            make_two(&t);
            struct scene_view view = tiny_view(&t, SIZE);
            view.outputs = SCENE_OUTPUT_TILES | SCENE_OUTPUT_PLAN;
            view.supersample = supersample;
            view.background = background == 0 ? SCENE_BACKGROUND_DEFAULT : SCENE_BACKGROUND_COLOR;
            struct scene_pictures p = tiny_draw(&t, &view);
            assert_null(p.color);
            uint32_t most = 0;
            for (int y = 0; y < SIZE; y += TILE / 4) {
                for (int x = 0; x < SIZE; x += TILE / 4) {
                    const int squares = squares_at(x, y);
                    const uint32_t triangles = p.tiles[y * SIZE + x], plan = p.plan[y * SIZE + x];
                    assert_int_equal(triangles != 0, squares != 0);
                    assert_in_range(triangles, squares, 2 * squares);
                    assert_int_equal(plan != 0, squares != 0);
                    assert_int_equal(plan & ~(uint32_t)(RHW_TILE_IN_ORDER | RHW_TILE_DEPTH_FIRST), 0);
                    most = triangles > most ? triangles : most;
                }
            }
            assert_int_equal(most, supersample == 1 ? 4 : 3);
            scene_pictures_free(&p);
        }
    }
}

static void test_exact_transparency_has_no_one_pass(void **state)
{
    (void)state;
    struct tiny t;
    char error[256];
    make_two(&t);
    struct scene_view view = tiny_view(&t, SIZE);
    view.transparency = SCENE_TRANSPARENCY_EXACT;
    view.outputs = SCENE_OUTPUT_OVERDRAW;
    assert_true(scene_view_check(&view, error, sizeof error));
    view.outputs = SCENE_OUTPUT_PLAN;
    assert_false(scene_view_check(&view, error, sizeof error));
    assert_non_null(strstr(error, "transparency"));
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_overdraw), cmocka_unit_test(test_tiles),
                                          cmocka_unit_test(test_exact_transparency_has_no_one_pass)};

const struct unit_tests test_work_outputs = UNIT_TESTS(tests, NULL, NULL);
