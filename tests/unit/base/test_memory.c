// SPDX-License-Identifier: MIT
// The allocator hook: every byte comes from it and goes back to it with the size it was asked for; when it
// has nothing left, wherever that happens, the call says so and the context can still be used or destroyed.
#include "harness.h"
#include "huge_page_mark.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/pages.h"
#include "resource/buffer.h"
#include "context/context.h"
#include "context/lookup.h"
#include "resource/texture.h"

struct meter {
    atomic_size_t live, peak;
    atomic_int blocks, calls;
    atomic_int fail_at; // the call that gets NULL, and every one after it while `stay` is set; -1: none
    atomic_bool stay, wrong_size, misaligned;
};

// Room for the size before the block, at whatever alignment was asked for.
enum { HEADER = 4096 };

static void *take(void *user, size_t size, size_t alignment)
{
    struct meter *meter = user;
    const int call = atomic_fetch_add(&meter->calls, 1), fail_at = atomic_load(&meter->fail_at);
    if (fail_at >= 0 && (call == fail_at || (call > fail_at && meter->stay))) {
        return NULL;
    }
    if (size == 0 || alignment == 0 || alignment > 4096 || (alignment & (alignment - 1)) != 0) {
        meter->misaligned = true;
    }
    const size_t header = alignment > 64 ? HEADER : 64;
    unsigned char *block = aligned_alloc(header, (size + header + header - 1) / header * header);
    if (block == NULL) {
        return NULL;
    }
    memcpy(block + header - sizeof size, &size, sizeof size);
    memcpy(block + header - 2 * sizeof size, &header, sizeof header);
    memset(block + header, 0xcd, size); // nobody may rely on zeros
    atomic_fetch_add(&meter->blocks, 1);
    const size_t live = atomic_fetch_add(&meter->live, size) + size;
    size_t peak = meter->peak;
    while (live > peak && !atomic_compare_exchange_weak(&meter->peak, &peak, live)) {
    }
    return block + header;
}

static void give(void *user, void *memory, size_t size)
{
    struct meter *meter = user;
    size_t taken, header;
    if (memory == NULL) {
        meter->wrong_size = true;
        return;
    }
    memcpy(&taken, (unsigned char *)memory - sizeof taken, sizeof taken);
    memcpy(&header, (unsigned char *)memory - 2 * sizeof taken, sizeof header);
    if (taken != size) {
        meter->wrong_size = true;
    }
    atomic_fetch_sub(&meter->live, taken);
    atomic_fetch_sub(&meter->blocks, 1);
    memset(memory, 0xdd, taken); // nor on what they gave back
    free((unsigned char *)memory - header);
}

struct texture_uniforms {
    float gain;
};

static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct texture_uniforms *u = groups[g].uniforms;
        const rhw_float uv[2] = {groups[g].varying[0], groups[g].varying[1]};
        rhw_sample_lod(groups[g].bindings, 0, uv, rhw_splat(0), groups[g].color[0]);
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].color[0][c] * u->gain + groups[g].varying[c];
        }
    }
}

// Everything a program does, in one go: objects of every kind, a pass with many draws, indices, strips with
// restart, texture writes and mips, a pass to a texture, readback. Returns the first result that is not OK.
struct work {
    rhw_context *context;
    rhw_buffer vertices, indices;
    rhw_texture color, depth, image;
    rhw_sampler sampler;
    rhw_pipeline pipelines[2];
};

enum { SIZE = 48, VERTICES = 120, DRAWS = 80 };

static enum rhw_result make_objects(struct work *work)
{
    static struct rig_vertex vertices[VERTICES];
    static uint16_t indices[VERTICES];
    uint64_t random = 40;
    for (int i = 0; i < VERTICES; i++) {
        for (int c = 0; c < 4; c++) {
            vertices[i].position[c] = c == 3 ? 1 : rig_random_float(&random, -1.2f, 1.2f);
            vertices[i].value[c] = rig_random_float(&random, 0, 1);
        }
        indices[i] = (uint16_t)(i % 20 == 19 ? 0xffff : i);
    }
    struct rhw_buffer_def buffer = rhw_buffer_def_default();
    buffer.size = sizeof vertices;
    buffer.data = vertices;
    enum rhw_result result = rhw_buffer_create(work->context, &buffer, &work->vertices);
    if (result != RHW_OK) {
        return result;
    }
    buffer.size = sizeof indices;
    buffer.data = indices;
    result = rhw_buffer_create(work->context, &buffer, &work->indices);
    if (result != RHW_OK) {
        return result;
    }
    const enum rhw_format formats[3] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_D32_FLOAT, RHW_FORMAT_RGBA8_SRGB};
    rhw_texture *textures[3] = {&work->color, &work->depth, &work->image};
    for (int i = 0; i < 3; i++) {
        struct rhw_texture_def def = rhw_texture_def_default();
        def.format = formats[i];
        def.width = def.height = SIZE;
        def.mip_levels = i == 2 ? RHW_MIP_LEVELS_ALL : 1;
        result = rhw_texture_create(work->context, &def, textures[i]);
        if (result != RHW_OK) {
            return result;
        }
    }
    const struct rhw_sampler_def sampler = rhw_sampler_def_default();
    return rhw_sampler_create(work->context, &sampler, &work->sampler);
}

static enum rhw_result make_pipelines(struct work *work)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex[0] = rig_vertex_pass;
    def.program.fragment[0] = sample_fragment;
    def.program.varyings[0] = (struct rhw_varying){.components = 4, .derivatives = true};
    def.program.varying_count = 1;
    def.program.uniform_size = sizeof(struct texture_uniforms);
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, 0};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, 16};
    def.attribute_count = 2;
    def.buffers[0].stride = 32;
    def.buffer_count = 1;
    def.depth_test = true;
    def.targets[0].blend = true;
    const enum rhw_result result = rhw_pipeline_create(work->context, &def, &work->pipelines[0]);
    if (result != RHW_OK) {
        return result;
    }
    def.topology = RHW_TRIANGLE_STRIP;
    def.primitive_restart = true;
    return rhw_pipeline_create(work->context, &def, &work->pipelines[1]);
}

static enum rhw_result begin_draws(struct work *work, int samples, rhw_pass *pass)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.samples = samples;
    def.colors[0].texture = work->color;
    def.color_count = 1;
    def.depth = (struct rhw_depth_attachment){.enabled = true, .texture = work->depth, .clear = 1};
    const enum rhw_result result = rhw_pass_begin(work->context, &def, pass);
    if (result == RHW_OK) {
        rhw_pass_set_vertex_buffer(work->context, *pass, 0, work->vertices, 0);
        rhw_pass_set_index_buffer(work->context, *pass, work->indices, RHW_INDEX_UINT16, 0);
        rhw_pass_set_texture(work->context, *pass, 0, work->image, work->sampler);
    }
    return result;
}

static void record_draw(struct work *work, rhw_pass pass, int i)
{
    const struct texture_uniforms uniforms = {(float)i};
    rhw_pass_set_uniforms(work->context, pass, &uniforms, sizeof uniforms);
    rhw_pass_set_pipeline(work->context, pass, work->pipelines[i & 1]);
    if (i & 1) {
        rhw_pass_draw_indexed(work->context, pass, 0, VERTICES, 0, 0, 1);
    } else {
        rhw_pass_draw(work->context, pass, 0, VERTICES, 0, 1);
    }
}

static enum rhw_result draw_some(struct work *work, int samples, int draws)
{
    rhw_pass pass;
    const enum rhw_result result = begin_draws(work, samples, &pass);
    if (result != RHW_OK) {
        return result;
    }
    for (int i = 0; i < draws; i++) {
        record_draw(work, pass, i);
    }
    return rhw_pass_end(work->context, pass, NULL);
}

static enum rhw_result draw_everything(struct work *work)
{
    return draw_some(work, 1, DRAWS);
}

static enum rhw_result do_everything(struct meter *meter, struct rig *rig, int threads)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.bin_memory = 1 << 16; // several flushes
    def.allocator = (struct rhw_allocator){take, give, meter};
    def.assert_ = rig_misuse;
    def.user = rig;
    struct work work = {0};
    enum rhw_result result = rhw_context_create(&def, &work.context);
    if (result != RHW_OK) {
        assert_null(work.context);
        return result;
    }
    result = make_objects(&work);
    if (result == RHW_OK) {
        result = make_pipelines(&work);
    }
    static unsigned char texels[SIZE * SIZE * 4];
    if (result == RHW_OK) {
        rhw_texture_write(work.context, work.image, 0, texels, 0);
        result = rhw_texture_generate_mips(work.context, work.image);
    }
    if (result == RHW_OK) {
        result = draw_everything(&work);
        if (result == RHW_OK) {
            rhw_texture_read(work.context, work.color, 0, texels, 0);
        } else {
            meter->stay = false;
        }
    }
    if (result != RHW_OK && meter->fail_at >= 0 && !meter->stay && work.pipelines[1].index != 0) {
        // One allocation failed, the next ones work: so must the context.
        assert_int_equal(draw_everything(&work), RHW_OK);
    }
    rhw_context_destroy(work.context);
    return result;
}

static void expect_all_returned(const struct meter *meter)
{
    assert_int_equal(meter->blocks, 0);
    assert_int_equal(meter->live, 0);
    assert_false(meter->wrong_size);
    assert_false(meter->misaligned);
}

static void test_everything_is_returned(void **state)
{
    (void)state;
    const int threads[] = {1, 2, 5};
    for (int t = 0; t < 3; t++) {
        struct meter meter = {.fail_at = -1};
        struct rig rig = {0};
        assert_int_equal(do_everything(&meter, &rig, threads[t]), RHW_OK);
        assert_true(meter.calls > 10);
        assert_int_equal(rig.misuses, 0);
        expect_all_returned(&meter);
    }
}

static void check_out_of_memory(int threads, bool stay)
{
    struct meter meter = {.fail_at = -1};
    struct rig rig = {0};
    assert_int_equal(do_everything(&meter, &rig, threads), RHW_OK);
    // With threads the number of calls may vary from run to run.
    const int calls = meter.calls;
    int failed = 0;
    for (int fail_at = 0; fail_at < calls; fail_at++) {
        struct meter poor = {.fail_at = fail_at, .stay = stay};
        const enum rhw_result result = do_everything(&poor, &rig, threads);
        if (result != RHW_OK && result != RHW_ERROR_OUT_OF_MEMORY) {
            fail_msg("allocation %d of %d: %s", fail_at, calls, rhw_result_string(result));
        }
        if (threads == 1 && result == RHW_OK) {
            fail_msg("allocation %d of %d failed and nobody said so", fail_at, calls);
        }
        failed += result != RHW_OK;
        if (rig.misuses != 0) {
            fail_msg("allocation %d of %d: reported as misuse: %s", fail_at, calls, rig.message);
        }
        expect_all_returned(&poor);
    }
    assert_true(failed > calls / 2);
}

static void test_out_of_memory_once(void **state)
{
    (void)state;
    check_out_of_memory(1, false);
    check_out_of_memory(3, false);
}

static void test_out_of_memory_from_then_on(void **state)
{
    (void)state;
    check_out_of_memory(1, true);
    check_out_of_memory(3, true);
}

static rhw_texture make_texture(rhw_context *context, int size)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_UNORM;
    def.width = def.height = size;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    return texture;
}

// One allocation after the other fails while a context that validates is created.
static void test_validation_out_of_memory(void **state)
{
    (void)state;
    struct meter meter;
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    for (int fail_at = 0; result != RHW_OK; fail_at++) {
        meter = (struct meter){.fail_at = fail_at};
        const struct rhw_context_def def = {
            .threads = 1, .validate = RHW_VALIDATE_ON, .allocator = {take, give, &meter}};
        rhw_context *context;
        result = rhw_context_create(&def, &context);
        assert_int_equal(result, fail_at < meter.calls ? RHW_ERROR_OUT_OF_MEMORY : RHW_OK);
        rhw_context_destroy(context);
        expect_all_returned(&meter);
    }
}

// When there is no memory for more samples, passes with as many as before can still be drawn.
static void test_more_samples_out_of_memory(void **state)
{
    (void)state;
    struct meter meter = {.fail_at = -1};
    const struct rhw_context_def def = {.threads = 1, .allocator = {take, give, &meter}};
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    int failures = 0;
    for (; result != RHW_OK; failures++) {
        struct work work = {0};
        assert_int_equal(rhw_context_create(&def, &work.context), RHW_OK);
        assert_int_equal(make_objects(&work), RHW_OK);
        assert_int_equal(make_pipelines(&work), RHW_OK);
        assert_int_equal(draw_some(&work, 4, 1), RHW_OK);
        meter.fail_at = meter.calls + failures;
        result = draw_some(&work, 16, 1);
        assert_int_equal(result, meter.calls > meter.fail_at ? RHW_ERROR_OUT_OF_MEMORY : RHW_OK);
        meter.fail_at = -1;
        assert_int_equal(draw_some(&work, 4, 1), RHW_OK);
        rhw_context_destroy(work.context);
        expect_all_returned(&meter);
    }
    assert_true(failures > 1);
}

// A texture that a recorded draw reads is written, so that it gets new memory, while the allocations fail one by one.
static void test_renewed_textures_out_of_memory(void **state)
{
    (void)state;
    enum { CHUNK = 16 }; // textures for which a context has room at once
    static const unsigned char texels[SIZE * SIZE * 4];
    struct meter meter = {.fail_at = -1};
    const struct rhw_context_def def = {.threads = 1, .allocator = {take, give, &meter}};
    struct work work = {0};
    assert_int_equal(rhw_context_create(&def, &work.context), RHW_OK);
    assert_int_equal(make_objects(&work), RHW_OK);
    assert_int_equal(make_pipelines(&work), RHW_OK);
    for (int i = 3; i < CHUNK; i++) {
        (void)make_texture(work.context, 1);
    }
    rhw_pass pass;
    assert_int_equal(begin_draws(&work, 1, &pass), RHW_OK);
    record_draw(&work, pass, 0);
    const size_t live = meter.live;
    int failures = 0;
    for (;; failures++) {
        meter.fail_at = meter.calls + failures;
        if (rhw_texture_write(work.context, work.image, 0, texels, 0) == RHW_OK) {
            break;
        }
        assert_true(meter.live == live);
    }
    assert_int_equal(failures, 3); // the texture, its texels, and the room for what it was
    rhw_pass_cancel(work.context, pass);
    rhw_context_destroy(work.context);
    expect_all_returned(&meter);
}

// The allocations of a view fail one by one.
static void test_views_out_of_memory(void **state)
{
    (void)state;
    struct meter meter = {.fail_at = -1};
    const struct rhw_context_def def = {.threads = 1, .allocator = {take, give, &meter}};
    rhw_context *context;
    rhw_texture view;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    const struct rhw_texture_view_def view_def = {.texture = make_texture(context, 4), .label = "view"};
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    for (int fail_after = 0; result != RHW_OK; fail_after++) {
        meter.fail_at = meter.calls + fail_after;
        result = rhw_texture_view_create(context, &view_def, &view);
        assert_int_equal(result, meter.calls > meter.fail_at ? RHW_ERROR_OUT_OF_MEMORY : RHW_OK);
        assert_true((view.index != 0) == (result == RHW_OK));
    }
    assert_int_equal(rhw_texture_width(context, view, 0), 4);
    rhw_context_destroy(context);
    expect_all_returned(&meter);
}

// A block of no bytes is a valid one, of which hooks see a byte.
static void test_blocks_of_nothing(void **state)
{
    (void)state;
    struct meter meter = {.fail_at = -1};
    struct rhw_memory memory = {.allocator = {take, give, &meter}};
    void *const block = rhw_memory_allocate(&memory, 0, 8);
    assert_non_null(block);
    assert_true(meter.live == 1);
    rhw_memory_release(&memory, block, 0);
    expect_all_returned(&meter);
}

// A warm context draws the same frame again without asking for memory.
static void test_warm_passes_do_not_allocate(void **state)
{
    (void)state;
    struct meter meter = {.fail_at = -1};
    struct rig rig = {0};
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.allocator = (struct rhw_allocator){take, give, &meter};
    def.assert_ = rig_misuse;
    def.user = &rig;
    struct work work = {0};
    assert_int_equal(rhw_context_create(&def, &work.context), RHW_OK);
    assert_int_equal(make_objects(&work), RHW_OK);
    assert_int_equal(make_pipelines(&work), RHW_OK);
    assert_int_equal(draw_everything(&work), RHW_OK);
    assert_int_equal(draw_everything(&work), RHW_OK);
    const int warm = meter.calls;
    for (int i = 0; i < 5; i++) {
        assert_int_equal(draw_everything(&work), RHW_OK);
    }
    assert_int_equal(meter.calls, warm);
    rhw_context_destroy(work.context);
    expect_all_returned(&meter);
}

static void test_the_stats_know_the_peak(void **state)
{
    (void)state;
    struct meter meter = {.fail_at = -1};
    struct rhw_context_def def = rhw_context_def_default();
    def.allocator = (struct rhw_allocator){take, give, &meter};
    struct rig rig;
    rig_open_with(&rig, 300, 200, &def);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, all);
    rig_draw_once(&rig, all, 6);
    assert_true(rig.stats.memory_peak >= 300 * 200 * 16);
    assert_true(rig.stats.memory_peak <= meter.peak);
    assert_true(rig.stats.memory_peak > meter.peak / 2);
    rig_close(&rig);
    expect_all_returned(&meter);
}

// A context takes memory in proportion to the picture and its scene: 768 KiB for a triangle in one tile of 64×64 pixels,
// whatever its threads, and 448 KiB for each thread more that further tiles may occupy.
static void test_a_small_picture_takes_little(void **state)
{
    (void)state;
    enum { KIB = 1024 };
    for (int tiles = 1; tiles <= 3; tiles++) {
        const int more = tiles == 1 ? 0 : tiles;
        struct meter meter = {.fail_at = -1};
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = 16;
        def.allocator = (struct rhw_allocator){take, give, &meter};
        struct rig rig;
        rig_open_with(&rig, 64 * tiles, 64, &def);
        struct rig_vertex all[6];
        rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, all);
        rig_draw_once(&rig, all, 3);
        assert_in_range(rig.stats.memory_peak, 1, (uint64_t)(768 + 448 * more) * KIB);
        rig_close(&rig);
        expect_all_returned(&meter);
    }
}

// Bytes of a block that are in memory.
static size_t resident(const void *block, size_t size)
{
    const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    const uintptr_t first = (uintptr_t)block / page * page;
    const size_t count = ((uintptr_t)block + size - first + page - 1) / page;
    unsigned char *const pages = calloc(count, 1);
    assert_int_equal(mincore((void *)first, count * page, pages), 0);
    size_t there = 0;
    for (size_t i = 0; i < count; i++) {
        there += (pages[i] & 1) * page;
    }
    free(pages);
    return there;
}

enum { LARGE = 4096, MEGABYTE = 1 << 20 };

// 64 MiB that nobody has touched take none; a row that is written takes a huge page at most.
static void test_what_is_created_takes_no_memory_yet(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const rhw_texture texture = make_texture(rig.context, LARGE);
    const struct rhw_texture_data *const data = rhw_context_texture(rig.context, texture, "test");
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = (size_t)64 * MEGABYTE;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    const void *const bytes = rhw_context_buffer(rig.context, buffer, "test")->bytes;
    assert_int_equal(resident(data->memory, data->memory_size), 0);
    assert_int_equal(resident(bytes, def.size), 0);
    rhw_buffer_write(rig.context, buffer, def.size / 2, "one", 4);
    assert_in_range(resident(bytes, def.size), 1, 2 * MEGABYTE);
    rhw_buffer_destroy(rig.context, buffer);
    rhw_texture_destroy(rig.context, texture);
    rig_close(&rig);
}

// Zeros, whoever had the memory before: with the default hooks, on both sides of where blocks get pages of their own, and
// with hooks that fill it.
static void test_what_is_created_is_zero(void **state)
{
    (void)state;
    static const int sizes[] = {64, 700, 724, 725, 1500};
    struct meter meter = {.fail_at = -1};
    for (int hooks = 0; hooks < 2; hooks++) {
        struct rhw_context_def def = rhw_context_def_default();
        if (hooks == 1) {
            def.allocator = (struct rhw_allocator){take, give, &meter};
        }
        rhw_context *context;
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        for (int i = 0; i < 2 * (int)(sizeof sizes / sizeof *sizes); i++) {
            const int size = sizes[i / 2];
            const size_t bytes = (size_t)size * (size_t)size * 4;
            unsigned char *const texels = malloc(bytes);
            const rhw_texture texture = make_texture(context, size);
            rhw_texture_read(context, texture, 0, texels, 0);
            for (size_t k = 0; k < bytes; k++) {
                if (texels[k] != 0) {
                    fail_msg("byte %zu of a texture of %dx%d is not zero", k, size, size);
                }
            }
            memset(texels, 0xff, bytes);
            rhw_texture_write(context, texture, 0, texels, 0);
            rhw_texture_destroy(context, texture);
            free(texels);
        }
        rhw_context_destroy(context);
    }
    expect_all_returned(&meter);
}

// What is left behind the last whole huge page is on one too if it is large beside the rest of the page.
static void test_blocks_end_on_huge_pages(void **state)
{
    (void)state;
    enum { KIBIBYTE = 1 << 10 };
    static const struct {
        size_t size;
        int mark;
    } blocks[] = {{2816 * KIBIBYTE, 1}, {2304 * KIBIBYTE, 0}, {1024 * KIBIBYTE, 0}, {4096 * KIBIBYTE, 1}};
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++) {
        unsigned char *const block = rhw_pages_map(blocks[i].size);
        const int mark = block != NULL ? huge_page_mark(block + blocks[i].size - 1) : -1;
        if (block != NULL) {
            rhw_pages_unmap(block, blocks[i].size);
        }
        if (mark < 0) {
            skip();
        }
        assert_int_equal(mark, blocks[i].mark);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_everything_is_returned),
    cmocka_unit_test(test_out_of_memory_once),
    cmocka_unit_test(test_out_of_memory_from_then_on),
    cmocka_unit_test(test_validation_out_of_memory),
    cmocka_unit_test(test_more_samples_out_of_memory),
    cmocka_unit_test(test_renewed_textures_out_of_memory),
    cmocka_unit_test(test_views_out_of_memory),
    cmocka_unit_test(test_blocks_of_nothing),
    cmocka_unit_test(test_warm_passes_do_not_allocate),
    cmocka_unit_test(test_the_stats_know_the_peak),
    cmocka_unit_test(test_a_small_picture_takes_little),
    cmocka_unit_test(test_what_is_created_takes_no_memory_yet),
    cmocka_unit_test(test_what_is_created_is_zero),
    cmocka_unit_test(test_blocks_end_on_huge_pages),
};

const struct unit_tests test_memory = UNIT_TESTS(tests, NULL, NULL);
