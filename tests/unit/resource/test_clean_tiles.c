// SPDX-License-Identifier: MIT
// Tiles that hold a clear value already are left alone (clean_tiles.h), and never one that does not.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

#include "context/context.h"
#include "context/lookup.h"
#include "resource/texture.h"

// Three tiles by two, those at the ends cut off. A rig has two threads.
enum { WIDTH = 150, HEIGHT = 80 };

static const float white[4] = {1, 1, 1, 1}, gray[4] = {0.5f, 0.5f, 0.5f, 0.5f};

static void clear(struct rig *rig, const float color[4])
{
    memcpy(rig->pass.colors[0].clear, color, 4 * sizeof *color);
    rig_begin(rig);
    rig_end(rig);
}

static void expect_all(struct rig *rig, const float color[4])
{
    const float(*const pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_memory_equal(pixels[i], color, 4 * sizeof *color);
    }
}

static struct rhw_mip *target(struct rig *rig)
{
    return &rhw_context_texture(rig->context, rig->pass.colors[0].texture, __func__)->mip[0];
}

// What nobody but this test could have written stays where a tile is left alone.
static void test_what_is_clean_is_left_alone(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    struct rig_vertex square[6];
    rig_rectangle(&rig, 10, 10, 20, 20, 0.5f, white, square);
    clear(&rig, gray);
    float *const first = (float *)(void *)target(&rig)->texels;
    float *const second = first + 4 * 64; // a texel of the tile to the right
    *first = *second = 7;
    clear(&rig, gray);
    assert_true(*first == 7 && *second == 7);
    rig_draw_once(&rig, square, 6); // clears to gray too
    assert_true(*first == 0.5f && *second == 7);
    clear(&rig, gray);
    assert_true(*first == 0.5f && *second == 7);
    clear(&rig, white);
    assert_true(*first == 1 && *second == 1);
    rig_close(&rig);
}

static void test_what_was_drawn_is_cleared(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    rig_set_depth(&rig);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.25f, white, all);
    for (int load = 0; load < 2; load++) {
        clear(&rig, gray);
        rig.pass.colors[0].load = load ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
        rig_draw_once(&rig, all, 6);
        expect_all(&rig, white);
        rig.pass.colors[0].load = RHW_LOAD_CLEAR;
        clear(&rig, gray);
        expect_all(&rig, gray);
        const float *const depth = rig_read_depth(&rig);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            assert_true(depth[i] == 1);
        }
    }
    rig_close(&rig);
}

// A tile that is drawn in some wave is not clean, whatever is drawn later and not stored; nor is it where a load left
// zeros.
static void test_waves_and_stores(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    def.bin_memory = 1;
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &def);
    enum { SQUARES = 400 };
    static struct rig_vertex squares[SQUARES][6];
    for (int i = 0; i < SQUARES; i++) { // the tiles of the first row take turns, the second row is left alone
        const float x = (float)(i * 7 % (WIDTH - 4));
        rig_rectangle(&rig, x, 1, x + 4, 5, 0.5f, white, squares[i]);
    }
    clear(&rig, gray);
    rig_draw_once(&rig, &squares[0][0], 6 * SQUARES);
    assert_true(rig.stats.flushes > 0);
    rig.pass.colors[0].store = RHW_STORE_DISCARD;
    rig_draw_once(&rig, &squares[0][0], 6);
    rig.pass.colors[0].store = RHW_STORE_STORE;
    clear(&rig, gray);
    expect_all(&rig, gray);
    rig.pass.colors[0].load = RHW_LOAD_DISCARD; // what is undefined is 0
    clear(&rig, gray);
    rig.pass.colors[0].load = RHW_LOAD_CLEAR;
    clear(&rig, gray);
    expect_all(&rig, gray);
    rig_close(&rig);
}

static void test_another_clear_value_is_written(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    for (int i = 0; i < 2; i++) {
        clear(&rig, gray);
        expect_all(&rig, gray);
        clear(&rig, white);
        expect_all(&rig, white);
    }
    rig_close(&rig);
}

static void test_what_was_uploaded_is_cleared(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    clear(&rig, gray);
    float(*const texels)[4] = calloc(WIDTH * HEIGHT, sizeof *texels);
    rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, texels, 0);
    free(texels);
    clear(&rig, gray);
    expect_all(&rig, gray);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_what_is_clean_is_left_alone),
    cmocka_unit_test(test_what_was_drawn_is_cleared),
    cmocka_unit_test(test_waves_and_stores),
    cmocka_unit_test(test_another_clear_value_is_written),
    cmocka_unit_test(test_what_was_uploaded_is_cleared),
};

const struct unit_tests test_clean_tiles = UNIT_TESTS(tests, NULL, NULL);
