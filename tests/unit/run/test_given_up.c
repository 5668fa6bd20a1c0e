// SPDX-License-Identifier: MIT
// Passes, mip levels and texels that the program gives up while they are made (rhw_context_set_goes_on): wherever that
// is, the result says so, nobody is asked again, and the next one is made as if nothing had been.
#include "harness.h"
#include "patience.h"

#include <string.h>
#include <time.h>

enum { SIZE = 320, TRIANGLES = 600, ONE_TILE = 64 };

static void fill(struct rig *rig, struct rig_vertex *vertices)
{
    uint64_t random = 3;
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        rig_place(rig, rig_random_float(&random, 0, SIZE), rig_random_float(&random, 0, SIZE),
                  rig_random_float(&random, 0, 1), 1, vertices[i].position);
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = rig_random_float(&random, 0, 1);
        }
    }
}

static enum rhw_result draw(struct rig *rig, const struct rig_vertex *vertices)
{
    rig_begin(rig);
    rig_draw(rig, vertices, 3 * TRIANGLES);
    return rhw_pass_end(rig->context, rig->recording, NULL);
}

static void check(int threads, size_t bin_memory)
{
    static struct rig_vertex vertices[3 * TRIANGLES];
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.bin_memory = bin_memory;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &def);
    fill(&rig, vertices);
    assert_int_equal(draw(&rig, vertices), RHW_OK);
    const uint64_t whole = rig_hash(&rig, 0);

    struct patience patience = {.left = 1 << 30};
    rhw_context_set_goes_on(rig.context, goes_on, &patience);
    assert_int_equal(draw(&rig, vertices), RHW_OK);
    assert_int_equal(rig_hash(&rig, 0), whole);
    const int all = patience.asked;
    assert_true(all > (threads == 1 ? 25 : 0)); // tiles, chunks, and once between them

    for (int left = 0; left < all && threads == 1; left++) {
        patience = (struct patience){.left = left};
        const enum rhw_result result = draw(&rig, vertices);
        // A machine that is busy holds some draws up, and they ask more often.
        const bool is_refused = patience.asked > left;
        assert_int_equal(result, is_refused ? RHW_ERROR_GIVEN_UP : RHW_OK);
        if (is_refused) {
            assert_int_equal(patience.asked, left + 1);
        }
    }
    for (int turn = 0; turn < 50; turn++) { // the other threads are somewhere
        patience = (struct patience){0};
        assert_int_equal(draw(&rig, vertices), RHW_ERROR_GIVEN_UP);
        assert_int_equal(patience.asked, 1);
    }
    rhw_context_set_goes_on(rig.context, NULL, NULL);
    assert_int_equal(draw(&rig, vertices), RHW_OK);
    assert_int_equal(rig_hash(&rig, 0), whole);
    rig_close(&rig);
}

static void test_one_thread(void **state)
{
    (void)state;
    check(1, 0);
}

static void test_one_thread_in_waves(void **state)
{
    (void)state;
    check(1, 1 << 12);
}

static void test_four_threads(void **state)
{
    (void)state;
    check(4, 0);
}

// Calls of the function that takes long, and how often the program has been asked since the first of them.
static _Atomic int long_calls;

static void take_long(void)
{
    long_calls++;
    const struct timespec time = {.tv_nsec = 11000000}; // the program is asked every 10 ms at least
    nanosleep(&time, NULL);
}

static void long_vertex(struct rhw_vertex *groups, int count)
{
    take_long();
    rig_vertex_pass(groups, count);
}

static void long_fragment(struct rhw_fragment *groups, int count)
{
    take_long();
    rig_fragment_pass(groups, count);
}

static bool goes_on_until_long(void *user)
{
    (void)user;
    return long_calls == 0;
}

// Draw with functions that take long in each call, which are many within one task, and give up after the first call.
static void check_long(rhw_vertex_function *vertex, rhw_fragment_function *fragment, int samples,
                       enum rhw_paths paths)
{
    static struct rig_vertex vertices[3 * TRIANGLES];
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.paths = paths;
    struct rig rig;
    rig_open_with(&rig, ONE_TILE, ONE_TILE, &def);
    rig.pass.samples = samples;
    fill(&rig, vertices);
    assert_int_equal(draw(&rig, vertices), RHW_OK);
    const uint64_t whole = rig_hash(&rig, 0);

    rig_set_program(&rig, vertex, fragment);
    long_calls = 0;
    rhw_context_set_goes_on(rig.context, goes_on_until_long, NULL);
    assert_int_equal(draw(&rig, vertices), RHW_ERROR_GIVEN_UP);
    assert_int_equal(long_calls, 1);

    rhw_context_set_goes_on(rig.context, NULL, NULL);
    rig_set_program(&rig, rig_vertex_pass, rig_fragment_pass);
    assert_int_equal(draw(&rig, vertices), RHW_OK);
    assert_int_equal(rig_hash(&rig, 0), whole);
    rig_close(&rig);
}

// Answer late, so that the other thread has begun all tiles when the calling one comes. Give up some calls later.
static bool goes_on_late(void *user)
{
    (void)user;
    const struct timespec time = {.tv_nsec = 5000000};
    nanosleep(&time, NULL);
    return long_calls < 3;
}

// The calling thread has nothing to do while the other one draws the last tile, and asks meanwhile.
static void test_long_tile_of_another(void **state)
{
    (void)state;
    static struct rig_vertex vertices[3 * TRIANGLES];
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    struct rig rig;
    rig_open_with(&rig, 2 * ONE_TILE, ONE_TILE, &def);
    fill(&rig, vertices);
    rig_set_program(&rig, rig_vertex_pass, long_fragment);
    const struct rhw_rect last_tile = {ONE_TILE, 0, ONE_TILE, ONE_TILE};
    rhw_context_set_goes_on(rig.context, goes_on_late, NULL);
    for (int turn = 0; turn < 3; turn++) {
        long_calls = 0;
        rig_begin(&rig);
        rhw_pass_set_scissor(rig.context, rig.recording, &last_tile);
        rig_draw(&rig, vertices, 3 * TRIANGLES);
        assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_GIVEN_UP);
        assert_in_range(long_calls, 1, 20); // of hundreds
    }
    rhw_context_set_goes_on(rig.context, NULL, NULL);
    rig_close(&rig);
}

static void test_long_vertices(void **state)
{
    (void)state;
    check_long(long_vertex, rig_fragment_pass, 1, RHW_PATHS_ALL);
}

static void test_long_fragments(void **state)
{
    (void)state;
    check_long(rig_vertex_pass, long_fragment, 1, RHW_PATHS_ALL);
    check_long(rig_vertex_pass, long_fragment, 4, RHW_PATHS_ALL);
    check_long(rig_vertex_pass, long_fragment, 1, RHW_PATHS_GENERAL);
}

static uint8_t last_level(rhw_context *context, rhw_texture texture, int level)
{
    uint8_t value = 0;
    assert_int_equal(rhw_texture_read(context, texture, level, &value, 1), RHW_OK);
    return value;
}

static void check_mips(int threads, enum rhw_texture_kind kind, int side, int depth, int levels)
{
    static uint8_t texels[1024 * 1024];
    struct rhw_context_def context_def = rhw_context_def_default();
    context_def.threads = threads;
    rhw_context *context;
    assert_int_equal(rhw_context_create(&context_def, &context), RHW_OK);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.kind = kind;
    def.format = RHW_FORMAT_R8_UNORM;
    def.width = def.height = side;
    def.depth = depth;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    memset(texels, 200, sizeof texels);
    const struct rhw_texture_region whole = {.width = side, .height = side, .depth = depth};
    assert_int_equal(rhw_texture_write_region(context, texture, &whole, texels, 0, 0), RHW_OK);
    struct patience patience = {.left = 1 << 30};
    rhw_context_set_goes_on(context, goes_on, &patience);
    assert_int_equal(rhw_texture_generate_mips(context, texture), RHW_OK);
    assert_int_equal(last_level(context, texture, levels - 1), 200);
    const int all = patience.asked;
    assert_true(all >= (threads == 1 ? 8 : 0)); // bands of 131072 texels, or slices
    for (int left = 0; left < all && threads == 1; left++) {
        patience = (struct patience){.left = left};
        assert_int_equal(rhw_texture_generate_mips(context, texture), RHW_ERROR_GIVEN_UP);
        assert_int_equal(patience.asked, left + 1);
    }
    rhw_context_set_goes_on(context, NULL, NULL);
    assert_int_equal(rhw_texture_generate_mips(context, texture), RHW_OK);
    assert_int_equal(last_level(context, texture, levels - 1), 200);
    rhw_context_destroy(context);
}

static void test_mips(void **state)
{
    (void)state;
    check_mips(1, RHW_TEXTURE_2D, 1024, 1, 11);
    check_mips(1, RHW_TEXTURE_3D, 32, 32, 6);
    check_mips(4, RHW_TEXTURE_2D, 1024, 1, 11);
}

// A step in the way of a texture to what the sampler reads, which asks at least so often.
struct step {
    enum rhw_result (*take)(rhw_context *context, rhw_texture texture);
    enum rhw_format format;
    int asked;
};

enum { STEP_SIDE = 1024 };

static uint32_t step_texels[STEP_SIDE * STEP_SIDE];

static enum rhw_result take_write(rhw_context *context, rhw_texture texture)
{
    return rhw_texture_write(context, texture, 0, step_texels, 0);
}

static enum rhw_result take_write_region(rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_region region = {.x = 4, .width = STEP_SIDE - 4};
    return rhw_texture_write_region(context, texture, &region, step_texels, 0, 0);
}

// The copy that samplers read is made in the pass, which then has nothing to draw.
static enum rhw_result take_bind(rhw_context *context, rhw_texture texture)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.width = def.height = 1;
    def.color_count = 0;
    def.depth.enabled = false;
    struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    rhw_sampler sampler;
    rhw_pass pass;
    assert_int_equal(rhw_sampler_create(context, &sampler_def, &sampler), RHW_OK);
    assert_int_equal(take_write(context, texture), RHW_OK);
    assert_int_equal(rhw_pass_begin(context, &def, &pass), RHW_OK);
    rhw_pass_set_texture(context, pass, 0, texture, sampler);
    const enum rhw_result result = rhw_pass_end(context, pass, NULL);
    rhw_sampler_destroy(context, sampler);
    return result;
}

static void check_step(const struct step *step)
{
    struct rhw_context_def context_def = rhw_context_def_default();
    context_def.threads = 1;
    rhw_context *context;
    assert_int_equal(rhw_context_create(&context_def, &context), RHW_OK);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = step->format;
    def.width = def.height = STEP_SIDE;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    struct patience patience = {.left = 1 << 30};
    rhw_context_set_goes_on(context, goes_on, &patience);
    assert_int_equal(step->take(context, texture), RHW_OK);
    const int all = patience.asked,
              first = step->take == take_bind ? 4 : 0; // the bound texture is written before
    assert_true(all >= first + step->asked);
    for (int left = first; left < all; left++) {
        patience = (struct patience){.left = left};
        assert_int_equal(step->take(context, texture), RHW_ERROR_GIVEN_UP);
        assert_int_equal(patience.asked, left + 1);
    }
    patience = (struct patience){.left = 1 << 30};
    assert_int_equal(step->take(context, texture), RHW_OK);
    assert_int_equal(patience.asked, all);
    rhw_context_destroy(context);
}

static void test_textures(void **state)
{
    (void)state;
    static const struct step steps[] = {
        {take_write, RHW_FORMAT_RGBA8_UNORM, 4}, // a megabyte at a time
        {take_write_region, RHW_FORMAT_RGBA8_UNORM, 4},
        {take_write, RHW_FORMAT_BC7_UNORM, 80}, // rows of blocks
        {take_bind, RHW_FORMAT_RGBA8_SRGB, 15},
    };
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        check_step(&steps[i]);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_one_thread),     cmocka_unit_test(test_one_thread_in_waves),
    cmocka_unit_test(test_four_threads),   cmocka_unit_test(test_long_vertices),
    cmocka_unit_test(test_long_fragments), cmocka_unit_test(test_long_tile_of_another),
    cmocka_unit_test(test_mips),           cmocka_unit_test(test_textures),
};

const struct unit_tests test_given_up = UNIT_TESTS(tests, NULL, NULL);
