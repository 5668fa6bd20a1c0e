// SPDX-License-Identifier: MIT
// Storage buffers in shader functions: what each operation does, what lies outside, and how often and in which order
// fragment functions with effects are called, whatever the threads, paths and instruction set.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 150, HEIGHT = 84, PIXELS = WIDTH * HEIGHT };

static rhw_buffer make_buffer(struct rig *rig, size_t words, const uint32_t *data)
{
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = 4 * words, .data = data, .label = "counts"};
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

static void read_words(struct rig *rig, rhw_buffer buffer, uint32_t *words, size_t count)
{
    assert_int_equal(rhw_buffer_read(rig->context, buffer, 0, words, 4 * count), RHW_OK);
}

// Operations -------------------------------------------------------------------------------------------

// A word for each operation, by its number; 16 × 16 fragments do it.
static void operate(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const struct rhw_bindings *const t = f->textures;
        const rhw_int x = rhw_int_from_float(f->coord[0]), y = rhw_int_from_float(f->coord[1]);
        const rhw_int id = y * 16 + x, one = rhw_splat_int(1);
        const rhw_int bit = rhw_select_int(rhw_equal_int(y, 3), one, rhw_splat_int(0)) << x;
        for (int o = RHW_STORAGE_ADD; o < RHW_STORAGE_EXCHANGE; o++) {
            const bool is_bits = o >= RHW_STORAGE_AND && o <= RHW_STORAGE_XOR;
            const rhw_int value = o == RHW_STORAGE_AND ? ~bit : is_bits ? bit : id - 100;
            rhw_storage_atomic(t, 2, (enum rhw_storage_operation)o, rhw_splat_int(o), value, f->mask);
        }
        // What comes out of 256 exchanges, and stays, is what went in.
        const rhw_int out =
            rhw_storage_atomic(t, 2, RHW_STORAGE_EXCHANGE, rhw_splat_int(RHW_STORAGE_EXCHANGE), id, f->mask);
        rhw_storage_atomic(t, 2, RHW_STORAGE_ADD, rhw_splat_int(20), out, f->mask);
        // One fragment alone finds 7 and leaves its number.
        const rhw_int found = rhw_storage_compare_exchange(t, 2, rhw_splat_int(RHW_STORAGE_COMPARE_EXCHANGE),
                                                           rhw_splat_int(7), id + 1000, f->mask);
        rhw_storage_atomic(t, 2, RHW_STORAGE_ADD, rhw_splat_int(21), one, f->mask & rhw_equal_int(found, 7));
        rhw_storage_store(t, 2, id + 32, id ^ 0x55, f->mask);
        const rhw_int back = rhw_storage_load(t, 2, id + 32, f->mask);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = rhw_float_from_int(back);
        }
    }
}

static void operate1(struct rhw_fragment1 *f)
{
    const struct rhw_bindings *const t = f->textures;
    const int32_t x = (int32_t)f->coord[0], y = (int32_t)f->coord[1], id = y * 16 + x;
    const int32_t bit = y == 3 ? 1 << x : 0;
    for (int o = RHW_STORAGE_ADD; o < RHW_STORAGE_EXCHANGE; o++) {
        const bool is_bits = o >= RHW_STORAGE_AND && o <= RHW_STORAGE_XOR;
        const int32_t value = o == RHW_STORAGE_AND ? ~bit : is_bits ? bit : id - 100;
        rhw_storage_atomic1(t, 2, (enum rhw_storage_operation)o, (uint32_t)o, value);
    }
    const int32_t out = rhw_storage_atomic1(t, 2, RHW_STORAGE_EXCHANGE, RHW_STORAGE_EXCHANGE, id);
    rhw_storage_atomic1(t, 2, RHW_STORAGE_ADD, 20, out);
    const int32_t found = rhw_storage_compare_exchange1(t, 2, RHW_STORAGE_COMPARE_EXCHANGE, 7, id + 1000);
    rhw_storage_atomic1(t, 2, RHW_STORAGE_ADD, 21, found == 7);
    rhw_storage_store1(t, 2, (uint32_t)id + 32, id ^ 0x55);
    for (int c = 0; c < 4; c++) {
        f->color[0][c] = (float)rhw_storage_load1(t, 2, (uint32_t)id + 32);
    }
}

// The second: 16 × 16 fragments as one function of plain numbers.
static void check_operations(bool one)
{
    struct rig rig;
    struct rig_vertex vertices[6];
    uint32_t words[32 + 256] = {[RHW_STORAGE_AND] = UINT32_MAX, [RHW_STORAGE_COMPARE_EXCHANGE] = 7};
    words[RHW_STORAGE_MIN] = 5;
    words[RHW_STORAGE_MAX] = 5;
    words[RHW_STORAGE_MIN_UNSIGNED] = UINT32_MAX;
    words[RHW_STORAGE_MAX_UNSIGNED] = 5;
    words[RHW_STORAGE_XOR] = 0xf00f;
    words[RHW_STORAGE_EXCHANGE] = 999;
    rig_open(&rig, 16, 16);
    const rhw_buffer buffer = make_buffer(&rig, 32 + 256, words);
    if (one) {
        memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
        rig.pipeline.program.fragment1 = operate1;
    } else {
        rig_set_program(&rig, rig_vertex_pass, operate);
    }
    rig.pipeline.program.uses = RHW_USE_EFFECTS | RHW_USE_COORD;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 2, buffer, 0, 0);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    read_words(&rig, buffer, words, 32 + 256);
    assert_int_equal((int32_t)words[RHW_STORAGE_ADD], 255 * 256 / 2 - 256 * 100);
    assert_int_equal((int32_t)words[RHW_STORAGE_MIN], -100);
    assert_int_equal((int32_t)words[RHW_STORAGE_MAX], 155);
    assert_int_equal(words[RHW_STORAGE_MIN_UNSIGNED], 0);
    assert_int_equal((int32_t)words[RHW_STORAGE_MAX_UNSIGNED], -1);
    assert_int_equal(words[RHW_STORAGE_AND], 0xffff0000);
    assert_int_equal(words[RHW_STORAGE_OR], 0xffff);
    assert_int_equal(words[RHW_STORAGE_XOR], 0x0ff0);
    assert_int_equal(words[20] + words[RHW_STORAGE_EXCHANGE], 255 * 256 / 2 + 999);
    assert_in_range(words[RHW_STORAGE_COMPARE_EXCHANGE], 1000, 1255);
    assert_int_equal(words[21], 1);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (uint32_t i = 0; i < 256; i++) {
        assert_int_equal(words[32 + i], i ^ 0x55);
        assert_true(pixels[i][0] == (float)(i ^ 0x55));
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static void operations(void **state)
{
    (void)state;
    check_operations(false);
    check_operations(true);
}

// Bounds -----------------------------------------------------------------------------------------------

// Words around a range of 6, and a slot without a buffer, one that does not exist, and lanes that are masked out.
static void reach_outside(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const struct rhw_bindings *const t = f->textures;
        const rhw_int x = rhw_int_from_float(f->coord[0]); // 0..7
        const int32_t least = INT32_MIN;
        const rhw_int outside[4] = {x + 6, x - 8, x + least, ~x};
        rhw_int seen = rhw_splat_int(0);
        for (int i = 0; i < 4; i++) {
            seen |= rhw_storage_load(t, 0, outside[i], f->mask);
            seen |= rhw_storage_atomic(t, 0, RHW_STORAGE_ADD, outside[i], rhw_splat_int(1), f->mask);
            rhw_storage_store(t, 0, outside[i], rhw_splat_int(-1), f->mask);
            rhw_storage_store(t, 1, outside[i], rhw_splat_int(-1), f->mask);
            seen |= rhw_storage_load(t, 1, outside[i], f->mask) | rhw_storage_load(t, -1, x, f->mask) |
                    rhw_storage_load(t, RHW_MAX_STORAGE_BUFFERS, x, f->mask);
        }
        rhw_storage_store(t, 0, x, rhw_splat_int(3), f->mask & rhw_equal_int(x, 2));
        const bool counts = rhw_storage_count(t, 0) == 6 && rhw_storage_count(t, 1) == 0;
        f->color[0][0] = rhw_float_from_int(seen);
        f->color[0][1] = rhw_splat(counts ? 1.0f : 0.0f);
        f->color[0][2] = rhw_float_from_int(rhw_storage_load(t, 0, x, f->mask & rhw_equal_int(x, 1)));
        f->color[0][3] = rhw_splat(0);
    }
}

static void outside(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    const struct rhw_context_def def = {.threads = 1, .validate = RHW_VALIDATE_OFF};
    uint32_t words[10] = {90, 91, 10, 11, 12, 13, 14, 15, 98, 99};
    rig_open_with(&rig, 8, 1, &def);
    const rhw_buffer buffer = make_buffer(&rig, 10, words);
    rig_set_program(&rig, rig_vertex_pass, reach_outside);
    rig.pipeline.program.uses = RHW_USE_EFFECTS | RHW_USE_COORD;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 8, 27); // 6 whole words
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    read_words(&rig, buffer, words, 10);
    const uint32_t expected[10] = {90, 91, 10, 11, 3, 13, 14, 15, 98, 99};
    assert_memory_equal(words, expected, sizeof words);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int x = 0; x < 8; x++) {
        assert_true(pixels[x][0] == 0 && pixels[x][1] == 1);
        assert_true(pixels[x][2] == (x == 1 ? 11 : 0));
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

// Counts and order -------------------------------------------------------------------------------------

// Counts each fragment at its pixel, and appends the digit of its draw to what is there, in slot 1.
static void count_fragments(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int at = rhw_int_from_float(f->coord[1]) * WIDTH + rhw_int_from_float(f->coord[0]);
        rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, at, rhw_splat_int(1), f->mask);
        const rhw_int digit = rhw_int_from_float(f->varying[0]);
        const rhw_int before = rhw_storage_load(f->textures, 1, at, f->mask);
        rhw_storage_store(f->textures, 1, at, before * 5 + digit, f->mask);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = f->varying[c];
        }
    }
}

static void count_fragment1(struct rhw_fragment1 *f)
{
    const uint32_t at = (uint32_t)f->coord[1] * WIDTH + (uint32_t)f->coord[0];
    rhw_storage_atomic1(f->textures, 0, RHW_STORAGE_ADD, at, 1);
    const int32_t before = rhw_storage_load1(f->textures, 1, at);
    rhw_storage_store1(f->textures, 1, at, before * 5 + (int32_t)f->varying[0]);
    memcpy(f->color[0], f->varying, sizeof f->color[0]);
}

// A function that receives nothing.
static void count_all(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_storage_atomic(groups[g].textures, 0, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1),
                           groups[g].mask);
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(1);
        }
    }
}

// Five layers, each all over the target: whole, as a grid of small rectangles, as strips that end within tiles, and whole
// again. The third lies behind the first two, the fifth before all.
enum { LAYERS = 5, MOST = 6 * (WIDTH / 5) * (HEIGHT / 3) };

static int make_layer(const struct rig *rig, int layer, struct rig_vertex *vertices)
{
    static const struct {
        int width, height;
        float depth;
    } layers[LAYERS] = {
        {WIDTH, HEIGHT, 0.5f}, {5, 3, 0.25f}, {WIDTH, HEIGHT, 0.75f}, {75, 12, 0.125f}, {10, 84, 0.0625f}};
    int count = 0;
    const float value[4] = {(float)layer, 0, 0, 1};
    for (int y = 0; y < HEIGHT; y += layers[layer].height) {
        for (int x = 0; x < WIDTH; x += layers[layer].width) {
            rig_rectangle(rig, (float)x, (float)y, (float)(x + layers[layer].width),
                          (float)(y + layers[layer].height), layers[layer].depth, value, vertices + count);
            count += 6;
        }
    }
    return count;
}

struct counting {
    struct rhw_context_def context;
    bool depth, early, one, reversed; // the layers from the last to the first
};

static void draw_layers(struct rig *rig, const struct counting *test, uint32_t *counts, uint32_t *digits)
{
    struct rig_vertex *const vertices = malloc(MOST * sizeof *vertices);
    memset(counts, 0, 4 * PIXELS);
    const rhw_buffer buffers[2] = {make_buffer(rig, PIXELS, counts), make_buffer(rig, PIXELS, counts)};
    rig_begin(rig);
    for (int i = 0; i < 2; i++) {
        rhw_pass_set_storage_buffer(rig->context, rig->recording, i, buffers[i], 0, 0);
    }
    for (int i = 0; i < LAYERS; i++) {
        rig_draw(rig, vertices, make_layer(rig, test->reversed ? LAYERS - 1 - i : i, vertices));
    }
    rig_end(rig);
    read_words(rig, buffers[0], counts, PIXELS);
    read_words(rig, buffers[1], digits, PIXELS);
    rhw_buffer_destroy(rig->context, buffers[0]);
    rhw_buffer_destroy(rig->context, buffers[1]);
    free(vertices);
}

static void check_counts(const struct counting *test)
{
    static uint32_t counts[PIXELS], digits[PIXELS];
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &test->context);
    if (test->depth) {
        rig_set_depth(&rig);
    }
    if (test->one) {
        memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
        rig.pipeline.program.fragment1 = count_fragment1;
    } else {
        rig_set_program(&rig, rig_vertex_pass, count_fragments);
    }
    rig.pipeline.program.uses = RHW_USE_EFFECTS | RHW_USE_COORD;
    rig.pipeline.program.early_fragment_tests = test->early;
    draw_layers(&rig, test, counts, digits);
    // Every layer; or those that pass by depth: 0, 1, 3, 4; from the last, that alone.
    const bool passes = test->early && test->depth;
    const uint32_t order = !passes          ? (test->reversed ? (((4 * 5 + 3) * 5 + 2) * 5 + 1) * 5 + 0
                                                              : (((0 * 5 + 1) * 5 + 2) * 5 + 3) * 5 + 4)
                           : test->reversed ? 4
                                            : ((0 * 5 + 1) * 5 + 3) * 5 + 4;
    const uint32_t count = !passes ? LAYERS : test->reversed ? 1 : 4;
    const float last = !test->depth && test->reversed ? 0 : 4;
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(counts[i], count);
        assert_int_equal(digits[i], order);
        assert_true(pixels[i][0] == last);
    }
    rig_close(&rig);
}

static void check_counts_in(const struct rhw_context_def *context)
{
    for (int bits = 0; bits < 16; bits++) {
        const struct counting test = {
            .context = *context, .depth = bits & 1, .early = bits & 2, .one = bits & 4, .reversed = bits & 8};
        check_counts(&test);
    }
}

static void counts(void **state)
{
    (void)state;
    static const enum rhw_paths paths[] = {RHW_PATHS_ALL, RHW_PATHS_IN_ORDER, RHW_PATHS_GENERAL};
    for (int i = 0; i < 3; i++) {
        for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
            const struct rhw_context_def context = {
                .threads = i == 0 ? 1 : 4, .paths = paths[i], .isa_limit = rhw_isa_up_to((enum rhw_isa)isa)};
            if (rhw_isa_supported((enum rhw_isa)isa)) {
                check_counts_in(&context);
            }
        }
    }
    // Under validation, and in many waves.
    check_counts_in(&(struct rhw_context_def){.threads = 4, .validate = RHW_VALIDATE_ON});
    check_counts_in(&(struct rhw_context_def){.threads = 4, .bin_memory = 1});
}

static void place(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].position, groups[g].attribute[0], sizeof groups[g].position);
    }
}

static void nothing_received(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    uint32_t sum = 0;
    rig_open(&rig, WIDTH, HEIGHT);
    const rhw_buffer buffer = make_buffer(&rig, 1, &sum);
    rig_set_program(&rig, place, count_all);
    rig.pipeline.program.varyings[0] = (struct rhw_varying){0};
    rig.pipeline.program.varying_count = 0;
    rig.pipeline.program.uses = RHW_USE_EFFECTS;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 4);
    rig_draw(&rig, vertices, 6);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    read_words(&rig, buffer, &sum, 1);
    assert_int_equal(sum, 2 * PIXELS);
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

// Samples of fragments, by depth tested before or after: a fragment is called once for all its samples.
static void count_samples(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        rhw_int samples = rhw_splat_int(0);
        for (int s = 0; s < 4; s++) {
            samples += f->sample_mask >> s & 1;
        }
        rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, rhw_splat_int(0), samples, f->mask);
        rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, rhw_splat_int(1), rhw_splat_int(1), f->mask);
        memcpy(f->color[0], f->varying, sizeof f->color[0]);
    }
}

static void multisampled(void **state)
{
    (void)state;
    for (int early = 0; early < 2; early++) {
        struct rig rig;
        struct rig_vertex vertices[6];
        uint32_t sums[2] = {0};
        rig_open(&rig, 64, 64);
        rig_set_depth(&rig);
        rig.pass.depth.texture = (rhw_texture){0};
        rig.pass.depth.store = RHW_STORE_DISCARD;
        rig.pass.samples = 4;
        const rhw_buffer buffer = make_buffer(&rig, 2, sums);
        rig_set_program(&rig, rig_vertex_pass, count_samples);
        rig.pipeline.program.uses = RHW_USE_EFFECTS | RHW_USE_SAMPLE_MASK;
        rig.pipeline.program.early_fragment_tests = early;
        // Two squares, the second with a part behind the first; both triangles of each have a fragment on its diagonal.
        rig_begin(&rig);
        rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 0);
        rig_rectangle(&rig, 0, 0, 32, 32, 0.5f, (const float[4]){1, 1, 1, 1}, vertices);
        rig_draw(&rig, vertices, 6);
        rig_rectangle(&rig, 0, 0, 48, 48, 0.75f, (const float[4]){0.5f, 1, 1, 1}, vertices);
        rig_draw(&rig, vertices, 6);
        rig_end(&rig);
        read_words(&rig, buffer, sums, 2);
        const uint32_t pixels = 48 * 48 + (early ? 0 : 32 * 32);
        assert_int_equal(sums[0], 4 * pixels);
        assert_int_equal(sums[1], pixels + 32 + (early ? 16 : 48));
        rhw_buffer_destroy(rig.context, buffer);
        rig_close(&rig);
    }
}

// In lanes of one group no pixel is twice, also where fragments of several triangles wait for others to fill it, or share
// pixels by their samples: counting without atomics counts as much.
static void count_plainly(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int at = rhw_int_from_float(f->varying[1]) * WIDTH + rhw_int_from_float(f->varying[0]);
        rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, at, rhw_splat_int(1), f->mask);
        const rhw_int before = rhw_storage_load(f->textures, 1, at, f->mask);
        rhw_storage_store(f->textures, 1, at, before + 1, f->mask);
        memcpy(f->color[0], f->varying, sizeof f->color[0]);
    }
}

static void distinct_lanes(void **state)
{
    (void)state;
    enum { TRIANGLES = 400 };
    static uint32_t counts[2][PIXELS];
    for (int i = 0; i < 4 * 2 * 2; i++) {
        static const int samples[] = {1, 2, 4, 16};
        static const float reaches[] = {0.75f, 4};
        const float reach = reaches[i / 4 % 2];
        struct rig rig;
        struct rig_vertex vertices[3 * TRIANGLES];
        uint64_t random = 7;
        rig_open(&rig, WIDTH, HEIGHT);
        rig.pass.samples = samples[i % 4];
        memset(counts, 0, sizeof counts);
        const rhw_buffer buffers[2] = {make_buffer(&rig, PIXELS, counts[0]),
                                       make_buffer(&rig, PIXELS, counts[1])};
        rig_set_program(&rig, rig_vertex_pass, count_plainly);
        rig.pipeline.program.uses = RHW_USE_EFFECTS;
        rig.pipeline.program.early_fragment_tests = i / 8;
        // Varyings are pixel coordinates, moved inside where a centre is not covered.
        for (int v = 0; v < 3 * TRIANGLES; v++) {
            static float x, y;
            if (v % 3 == 0) {
                x = rig_random_float(&random, 4, 4 + 3 * reach);
                y = rig_random_float(&random, 4, 4 + 3 * reach);
            }
            const float px = x + rig_random_float(&random, -reach, reach),
                        py = y + rig_random_float(&random, -reach, reach);
            rig_place(&rig, px, py, 0.5f, 1, vertices[v].position);
            vertices[v].value[0] = px;
            vertices[v].value[1] = py;
            vertices[v].value[2] = vertices[v].value[3] = 0;
        }
        rig_begin(&rig);
        rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffers[0], 0, 0);
        rhw_pass_set_storage_buffer(rig.context, rig.recording, 1, buffers[1], 0, 0);
        rig_draw(&rig, vertices, 3 * TRIANGLES);
        rig_end(&rig);
        read_words(&rig, buffers[0], counts[0], PIXELS);
        read_words(&rig, buffers[1], counts[1], PIXELS);
        assert_memory_equal(counts[0], counts[1], sizeof counts[0]);
        rhw_buffer_destroy(rig.context, buffers[0]);
        rhw_buffer_destroy(rig.context, buffers[1]);
        rig_close(&rig);
    }
}

// Discarding, with depth written before the function: what lies behind stays hidden by what was discarded.
static void discard_all(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].color[0], groups[g].varying, sizeof groups[g].color[0]);
        groups[g].mask = rhw_splat_int(0);
    }
}

static void early_discard(void **state)
{
    (void)state;
    for (int early = 0; early < 2; early++) {
        for (int general = 0; general < 2; general++) {
            struct rig rig;
            struct rig_vertex vertices[6];
            const struct rhw_context_def def = {.paths = general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL};
            rig_open_with(&rig, 16, 16, &def);
            rig_set_depth(&rig);
            rig_begin(&rig);
            rig_set_program(&rig, rig_vertex_pass, discard_all);
            rig.pipeline.program.uses = RHW_USE_DISCARD;
            rig.pipeline.program.early_fragment_tests = early;
            rig_cover(&rig, 0.25f, (const float[4]){1, 1, 1, 1}, vertices);
            rig_draw(&rig, vertices, 6);
            rig_set_program(&rig, rig_vertex_pass, rig_fragment_pass);
            rig.pipeline.program.uses = 0;
            rig.pipeline.program.early_fragment_tests = false;
            rig_cover(&rig, 0.5f, (const float[4]){2, 2, 2, 2}, vertices);
            rig_draw(&rig, vertices, 6);
            rig_end(&rig);
            assert_true(rig_read_float4(&rig)[17][0] == (early ? 0.0f : 2.0f));
            assert_true(rig_read_depth(&rig)[17] == (early ? 0.25f : 0.5f));
            rig_close(&rig);
        }
    }
}

// Vertices ---------------------------------------------------------------------------------------------

// Counts each vertex of each instance, and passes on how often it was met before: once, so 0.
static void count_vertices(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        memcpy(v->position, v->attribute[0], sizeof v->position);
        const rhw_int at = v->instance_index * 4096 + v->vertex_index;
        const rhw_int before =
            rhw_storage_atomic(v->textures, 0, RHW_STORAGE_ADD, at, rhw_splat_int(1), v->mask);
        for (int c = 0; c < 4; c++) {
            v->varying[c] = rhw_float_from_int(before) + 1.0f;
        }
    }
}

static void count_vertex1(struct rhw_vertex1 *v)
{
    memcpy(v->position, v->attribute[0], sizeof v->position);
    const int32_t at = v->instance_index * 4096 + v->vertex_index;
    const int32_t before = rhw_storage_atomic1(v->textures, 0, RHW_STORAGE_ADD, (uint32_t)at, 1);
    for (int c = 0; c < 4; c++) {
        v->varying[c] = (float)before + 1.0f;
    }
}

enum {
    GRID = 40,
    ROW = GRID + 1,
    INDICES = 6 * GRID * GRID
}; // cells each way, in a target of as many pixels

// A grid of cells, its vertices from number 3 on, in rows; every triangle names vertices that others name too.
static void make_grid(const struct rig *rig, struct rig_vertex *vertices, uint32_t *indices)
{
    for (int i = 0; i < ROW * ROW; i++) {
        rig_place(rig, (float)(i % ROW), (float)(i / ROW), 0.5f, 1, vertices[3 + i].position);
    }
    for (uint32_t i = 0; i < GRID * GRID; i++) {
        const uint32_t at = 3 + i / GRID * ROW + i % GRID;
        const uint32_t corners[6] = {at, at + 1, at + ROW, at + ROW, at + 1, at + ROW + 1};
        // The cells in an order that jumps.
        memcpy(indices + 6 * (i * 577 % (GRID * GRID)), corners, sizeof corners);
    }
}

static void draw_grid(struct rig *rig, rhw_buffer buffer, bool indexed)
{
    static struct rig_vertex vertices[3 + ROW * ROW];
    static uint32_t indices[INDICES];
    make_grid(rig, vertices, indices);
    rig_begin(rig);
    rhw_pass_set_storage_buffer(rig->context, rig->recording, 0, buffer, 0, 0);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, sizeof vertices);
    if (indexed) {
        rig_use_indices(rig, RHW_INDEX_UINT32, indices, sizeof indices);
        rhw_pass_draw_indexed(rig->context, rig->recording, 0, INDICES, 0, 0, 2);
    } else { // a strip: its second row of triangles is of no area, and called all the same
        rhw_pass_draw(rig->context, rig->recording, 3, 2 * ROW, 0, 2);
    }
    rig_end(rig);
}

static void check_vertices(const struct rhw_context_def *def, bool one, bool indexed)
{
    static uint32_t counts[2 * 4096];
    struct rig rig;
    memset(counts, 0, sizeof counts);
    rig_open_with(&rig, GRID, GRID, def);
    const rhw_buffer buffer = make_buffer(&rig, 2 * 4096, counts);
    if (one) {
        memset(rig.pipeline.program.vertex, 0, sizeof rig.pipeline.program.vertex);
        rig.pipeline.program.vertex1 = count_vertex1;
    } else {
        rig_set_program(&rig, count_vertices, rig_fragment_pass);
    }
    rig.pipeline.program.vertex_effects = true;
    rig.pipeline.topology = indexed ? RHW_TRIANGLE_LIST : RHW_TRIANGLE_STRIP;
    draw_grid(&rig, buffer, indexed);
    read_words(&rig, buffer, counts, 2 * 4096);
    const uint32_t named = indexed ? ROW * ROW : 2 * ROW;
    for (uint32_t i = 0; i < 2 * 4096; i++) {
        assert_int_equal(counts[i], i % 4096 >= 3 && i % 4096 < 3 + named);
    }
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < GRID * GRID && indexed; i++) {
        assert_true(pixels[i][0] == 1);
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static void vertices(void **state)
{
    (void)state;
    static const struct rhw_context_def defs[] = {
        {.threads = 1},
        {.threads = 4},
        {.threads = 4, .paths = RHW_PATHS_GENERAL},
        {.threads = 4, .bin_memory = 1},
        {.threads = 4, .isa_limit = RHW_ISA_UP_TO_BASELINE},
        {.threads = 4, .validate = RHW_VALIDATE_ON},
    };
    for (size_t i = 0; i < sizeof defs / sizeof defs[0]; i++) {
        for (int bits = 0; bits < 4; bits++) {
            check_vertices(&defs[i], bits & 1, bits & 2);
        }
    }
}

// Misuse -----------------------------------------------------------------------------------------------

static void misuse(void **state)
{
    (void)state;
    struct rig rig;
    uint32_t words[8] = {0};
    struct rig_vertex vertices[6];
    rig_open(&rig, 16, 16);
    rhw_context *const context = rig.context;
    const rhw_buffer buffer = make_buffer(&rig, 8, words), fetched = make_buffer(&rig, 8, words);
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(context, rig.recording, RHW_MAX_STORAGE_BUFFERS, buffer, 0, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_storage_buffer: slot is 16; it is in 0..15");
    rhw_pass_set_storage_buffer(context, rig.recording, 0, buffer, 2, 0);
    rig_expect_misuse(&rig, "offset is 2; it must be a multiple of 4");
    rhw_pass_set_storage_buffer(context, rig.recording, 0, buffer, 4, 29);
    rig_expect_misuse(&rig, "offset is 4 and size is 29; together they must stay within the 32 bytes of");
    rhw_pass_set_storage_buffer(context, rig.recording, 0, buffer, 0, 0);
    rhw_pass_set_vertex_buffer(context, rig.recording, 0, buffer, 0);
    rig_expect_misuse(&rig,
                      "rhw_pass_set_vertex_buffer: it reads bytes 0 to 32 of buffer 1 \"counts\"; storage of "
                      "this pass may write bytes 0 to 32");
    rhw_pass_set_vertex_buffer(context, rig.recording, 0, fetched, 0);
    rhw_pass_set_storage_buffer(context, rig.recording, 0, fetched, 0, 0);
    rig_expect_misuse(
        &rig, "it may write bytes 0 to 32 of buffer 2 \"counts\"; a vertex, index or read-only buffer "
              "of this pass reads bytes 0 to 32");
    rhw_buffer_write(context, buffer, 0, words, 4);
    rig_expect_misuse(&rig, "rhw_buffer_write: it writes bytes 0 to 4 of buffer 1 \"counts\"; storage of "
                            "this pass may write bytes 0 to 32");
    rhw_buffer_read(context, buffer, 0, words, 4);
    rig_expect_misuse(&rig, "rhw_buffer_read: it reads bytes 0 to 4 of buffer 1 \"counts\"; storage of this "
                            "pass may write bytes 0 to 32");
    rhw_pass_cancel(context, rig.recording);
    rhw_buffer_read(context, buffer, 30, words, 4);
    rig_expect_misuse(&rig, "offset is 30 and size is 4");
    rhw_buffer_destroy(context, buffer);
    rhw_buffer_destroy(context, fetched);
    rig_close(&rig);
}

// What validation tells of a fragment function that writes to `slot` of a pass with a buffer in slot 0.
static void expect_message(uint32_t uses, rhw_fragment_function *function, const char *part)
{
    struct rig rig;
    struct rig_vertex vertices[6];
    const struct rhw_context_def def = {.validate = RHW_VALIDATE_ON};
    uint32_t words[2] = {0};
    rig_open_with(&rig, 16, 16, &def);
    const rhw_buffer buffer = make_buffer(&rig, 2, words);
    rig_set_program(&rig, rig_vertex_pass, function);
    rig.pipeline.program.uses = uses;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 0);
    rig_draw(&rig, vertices, 6);
    rhw_pass_end(rig.context, rig.recording, &rig.stats);
    rig_expect_misuse(&rig, part);
    read_words(&rig, buffer, words, 2);
    assert_int_equal(words[0], 0);
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static void write_slot0(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        rhw_storage_store(groups[g].textures, 0, rhw_splat_int(0), rhw_splat_int(1), groups[g].mask);
    }
}

static void write_slot1(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        rhw_storage_store(groups[g].textures, 1, rhw_splat_int(0), rhw_splat_int(1), groups[g].mask);
    }
}

static void read_slot16(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        (void)rhw_storage_load(groups[g].textures, 16, rhw_splat_int(0), groups[g].mask);
    }
}

static void validation(void **state)
{
    (void)state;
    expect_message(0, write_slot0,
                   "writes to storage slot 0; its program declares no such effects, by RHW_USE_EFFECTS or "
                   "vertex_effects");
    expect_message(RHW_USE_EFFECTS, write_slot1, "uses storage slot 1, in which nothing is set");
    expect_message(0, read_slot16, "uses storage slot 16; slots are 0..15");
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(operations),    cmocka_unit_test(outside),
                                          cmocka_unit_test(counts),        cmocka_unit_test(nothing_received),
                                          cmocka_unit_test(multisampled),  cmocka_unit_test(distinct_lanes),
                                          cmocka_unit_test(early_discard), cmocka_unit_test(vertices),
                                          cmocka_unit_test(misuse),        cmocka_unit_test(validation)};

const struct unit_tests test_storage = UNIT_TESTS(tests, NULL, NULL);
