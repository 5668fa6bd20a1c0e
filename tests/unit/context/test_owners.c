// SPDX-License-Identifier: MIT
// Who may use what: ids belong to their context, a context to one thread at a time, and shader functions call nothing.
// What draws were recorded with stays theirs, whether it is destroyed or rewritten before the pass ends.
#include "harness.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

static const float red[4] = {1, 0, 0, 1}, blue[4] = {0, 0, 1, 1};

// Calls outside of a pass that name what belongs to another context.
static void use_foreign_ids(struct rig *own, const struct rig *other)
{
    const rhw_texture texture = other->pass.colors[0].texture;
    uint8_t bytes[8 * 8 * 16] = {0};
    assert_int_equal(rhw_texture_width(own->context, texture, 0), 0);
    rig_expect_misuse(own, "rhw_texture_width: texture 1 belongs to another context");
    assert_int_equal(rhw_texture_write(own->context, texture, 0, bytes, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(own, "rhw_texture_write: texture 1 belongs to another context");
    assert_int_equal(rhw_texture_read(own->context, texture, 0, bytes, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(own, "rhw_texture_read: texture 1 belongs to another context");
    assert_int_equal(rhw_buffer_write(own->context, other->objects.buffers[0], 0, bytes, 8),
                     RHW_ERROR_MISUSE);
    rig_expect_misuse(own, "rhw_buffer_write: buffer 1 belongs to another context");
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(own->context, &other->pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(own, "rhw_pass_begin: texture 1 belongs to another context");
    rhw_buffer_destroy(own->context, other->objects.buffers[0]);
    rig_expect_misuse(own, "rhw_buffer_destroy: buffer 1 belongs to another context");
    rhw_pipeline_destroy(own->context, other->objects.pipelines[0]);
    rig_expect_misuse(own, "rhw_pipeline_destroy: pipeline 1 belongs to another context");
}

// Two rigs, and what the second one is refused of the first. Both draw as if it had not been asked.
static void test_ids_carry_their_context(void **state)
{
    (void)state;
    struct rig own, other;
    rig_open(&own, 8, 8);
    rig_open(&other, 8, 8);
    rig_begin(&other); // the ids below have the same index and generation in both contexts
    rig_use_pipeline(&other);
    struct rig_vertex all[6];
    rig_cover(&own, 0, red, all);
    rig_use_vertices(&other, 0, all, sizeof all);
    const struct rhw_texture_def sampled_def = {.format = RHW_FORMAT_R8_UNORM, .width = 1, .height = 1};
    rhw_texture sampled;
    rhw_sampler sampler;
    assert_int_equal(rhw_texture_create(own.context, &sampled_def, &sampled), RHW_OK);
    assert_int_equal(rhw_sampler_create(other.context, &(struct rhw_sampler_def){0}, &sampler), RHW_OK);

    use_foreign_ids(&own, &other);
    rhw_sampler_destroy(own.context, sampler);
    rig_expect_misuse(&own, "rhw_sampler_destroy: sampler 1 belongs to another context");
    rig_begin(&own);
    rig_use_pipeline(&own);
    rig_use_vertices(&own, 0, all, sizeof all);
    rhw_pass_set_pipeline(own.context, own.recording, other.objects.pipelines[0]);
    rig_expect_misuse(&own, "rhw_pass_set_pipeline: pipeline 1 belongs to another context");
    rhw_pass_set_vertex_buffer(own.context, own.recording, 0, other.objects.buffers[0], 0);
    rig_expect_misuse(&own, "rhw_pass_set_vertex_buffer: buffer 1 belongs to another context");
    rhw_pass_set_index_buffer(own.context, own.recording, other.objects.buffers[0], RHW_INDEX_UINT8, 0);
    rig_expect_misuse(&own, "rhw_pass_set_index_buffer: buffer 1 belongs to another context");
    rhw_pass_set_texture(own.context, own.recording, 0, sampled, sampler);
    rig_expect_misuse(&own, "rhw_pass_set_texture: sampler 1 belongs to another context");
    rhw_pass_draw(own.context, other.recording, 0, 1, 0, 1);
    rig_expect_misuse(&own, "rhw_pass_draw: the pass belongs to another context");
    assert_int_equal(rhw_pass_end(own.context, other.recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&own, "rhw_pass_end: the pass belongs to another context");
    rhw_texture_destroy(own.context, other.pass.colors[0].texture);
    rig_expect_misuse(&own, "rhw_texture_destroy: texture 1 belongs to another context");
    rhw_pass_draw(own.context, own.recording, 0, 6, 0, 1);
    rhw_pass_draw(other.context, other.recording, 0, 6, 0, 1);
    rig_end(&own);
    rig_end(&other);
    for (int i = 0; i < 8 * 8; i++) {
        assert_memory_equal(rig_read_float4(&own)[i], red, sizeof red);
        assert_memory_equal(rig_read_float4(&other)[i], red, sizeof red);
    }
    rig_close(&own);
    rig_close(&other);
}

// Shader functions ------------------------------------------------------------------------------------

static rhw_context *called;
static rhw_texture called_texture;
static atomic_int calls;

static void call_library(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        memset(groups[i].color, 0, 4 * sizeof groups[i].color[0][0]);
    }
    if (atomic_fetch_add(&calls, 1) == 0) { // so that one message comes
        rhw_texture_destroy(called, called_texture);
    }
}

// Whichever thread shades first.
static void test_shader_functions_call_nothing(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 4; threads++) {
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = threads;
        struct rig rig;
        rig_open_with(&rig, 256, 256, &def);
        rig_set_program(&rig, rig_vertex_pass, call_library);
        struct rig_vertex all[6];
        rig_cover(&rig, 0, red, all);
        called = rig.context;
        called_texture = rig.pass.colors[0].texture;
        atomic_store(&calls, 0);
        rig_begin(&rig);
        rig_draw(&rig, all, 6);
        assert_int_equal(rhw_pass_end(rig.context, rig.recording, &rig.stats), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig,
                          "rhw_texture_destroy: called by a function that the library called, such as a "
                          "shader function; it must not use the context");
        assert_int_equal(rhw_texture_width(rig.context, called_texture, 0), 256);
        rig_close(&rig);
    }
}

// A second thread -------------------------------------------------------------------------------------

static atomic_int shading, told; // the fragment function waits for the other thread to be told

static void wait_for_other(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    atomic_store(&shading, 1);
    while (atomic_load(&told) == 0) {
    }
}

static void *draw_from_outside(void *user)
{
    const struct rig *const rig = user;
    while (atomic_load(&shading) == 0) {
    }
    rhw_pass_draw(rig->context, rig->recording, 0, 3, 0, 1);
    atomic_store(&told, 1);
    return NULL;
}

static void test_a_second_thread_is_told(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    struct rig rig;
    rig_open_with(&rig, 8, 8, &def);
    rig_set_program(&rig, rig_vertex_pass, wait_for_other);
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    rig_begin(&rig);
    rig_draw(&rig, all, 6);
    pthread_t other;
    assert_int_equal(pthread_create(&other, NULL, draw_from_outside, &rig), 0);
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, &rig.stats), RHW_ERROR_MISUSE);
    pthread_join(other, NULL);
    rig_expect_misuse(
        &rig, "rhw_pass_draw: called while rhw_pass_end is under way in this context; one thread at a "
              "time may use a context");
    for (int i = 0; i < 8 * 8; i++) {
        assert_memory_equal(rig_read_float4(&rig)[i], red, sizeof red);
    }
    rig_close(&rig);
}

enum { HAMMERED = 2000 };

static atomic_int refused;

static void count_refused(void *user, const char *message)
{
    (void)user;
    (void)message;
    atomic_fetch_add(&refused, 1);
}

static void *hammer(void *user)
{
    rhw_context *const context = user;
    for (int i = 0; i < HAMMERED; i++) {
        const struct rhw_buffer_def def = {.size = 16};
        rhw_buffer buffer;
        if (rhw_buffer_create(context, &def, &buffer) == RHW_OK) {
            while (rhw_buffer_write(context, buffer, 0, "0123456789abcdef", 16) != RHW_OK) {
            }
            rhw_buffer_destroy(context, buffer);
        }
    }
    return NULL;
}

// Two threads that do not ask each other: some calls are refused, none does harm.
static void test_threads_that_race_do_no_harm(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.assert_ = count_refused;
    rhw_context *context;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    pthread_t threads[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, hammer, context), 0);
    }
    for (int i = 0; i < 2; i++) {
        pthread_join(threads[i], NULL);
    }
    rhw_context_destroy(context);
}

// A hook that leaves by longjmp -----------------------------------------------------------------------

static jmp_buf escape;

static void leave(void *user, const char *message)
{
    (void)user;
    (void)message;
    longjmp(escape, 1);
}

static void test_a_hook_may_leave(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.assert_ = leave;
    rhw_context *context;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    if (setjmp(escape) == 0) {
        rhw_buffer_write(context, (rhw_buffer){0}, 0, "", 1);
        fail_msg("the hook was not called");
    }
    const struct rhw_buffer_def buffer_def = {.size = 1};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(context, &buffer_def, &buffer), RHW_OK);
    rhw_context_destroy(context);
}

// A hook that calls the library: it may give up the very pass that is being ended.
struct giving_up {
    rhw_context *context;
    rhw_texture target;
    rhw_pass pass;
};

static void give_up(void *user, const char *message)
{
    (void)message;
    const struct giving_up *const it = user;
    rhw_pass_cancel(it->context, it->pass);
}

static void test_a_hook_may_give_the_pass_up(void **state)
{
    (void)state;
    struct giving_up it;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.assert_ = give_up;
    def.user = &it;
    assert_int_equal(rhw_context_create(&def, &it.context), RHW_OK);
    const struct rhw_texture_def texture_def = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 1, .height = 1};
    struct rhw_pass_def pass_def = {.color_count = 1, .colors = {{.clear = {1, 1, 1, 1}}}};
    rhw_texture target;
    assert_int_equal(rhw_texture_create(it.context, &texture_def, &target), RHW_OK);
    pass_def.colors[0].texture = target;
    assert_int_equal(rhw_pass_begin(it.context, &pass_def, &it.pass), RHW_OK);
    rhw_pass_push_debug_group(it.context, it.pass, "open");
    rhw_texture_destroy(it.context, target);
    assert_int_equal(rhw_pass_end(it.context, it.pass, NULL), RHW_ERROR_MISUSE);
    rhw_context_destroy(it.context);
}

// This hook gives up the pass that is being ended, and begins another one.
static void begin_another(void *user, const char *message)
{
    (void)message;
    struct giving_up *const it = user;
    const struct rhw_pass_def def = {
        .color_count = 1, .colors = {{.texture = it->target, .load = RHW_LOAD_CLEAR, .clear = {0, 1, 0, 1}}}};
    rhw_pass_cancel(it->context, it->pass);
    (void)rhw_pass_begin(it->context, &def, &it->pass);
}

static void test_a_hook_may_begin_another_pass(void **state)
{
    (void)state;
    struct giving_up it;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.assert_ = begin_another;
    def.user = &it;
    assert_int_equal(rhw_context_create(&def, &it.context), RHW_OK);
    const struct rhw_texture_def texture_def = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 1, .height = 1};
    assert_int_equal(rhw_texture_create(it.context, &texture_def, &it.target), RHW_OK);
    const struct rhw_pass_def pass_def = {.color_count = 1, .colors = {{.texture = it.target}}};
    assert_int_equal(rhw_pass_begin(it.context, &pass_def, &it.pass), RHW_OK);
    const rhw_pass first = it.pass;
    rhw_pass_push_debug_group(it.context, it.pass, "open");
    assert_int_equal(rhw_pass_end(it.context, it.pass, NULL), RHW_ERROR_MISUSE);
    assert_int_not_equal(it.pass.generation, first.generation);
    assert_int_equal(rhw_pass_end(it.context, it.pass, NULL), RHW_OK);
    unsigned char texel[4];
    rhw_texture_read(it.context, it.target, 0, texel, 0);
    assert_memory_equal(texel, ((const unsigned char[4]){0, 255, 0, 255}), 4);
    rhw_context_destroy(it.context);
}

// Destroyed while recorded ----------------------------------------------------------------------------

static void test_a_context_stays_while_it_records(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_begin(&rig);
    rhw_context_destroy(rig.context);
    rig_expect_misuse(&rig, "rhw_context_destroy: a pass is being recorded; end it first");
    rig_end(&rig);
    rig_close(&rig);
}

static void sample_texture(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_float uv[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        rhw_sample_lod(groups[i].bindings, 0, uv, rhw_splat(0), groups[i].color[0]);
    }
}

static rhw_texture make_texture(struct rig *rig, enum rhw_format format, int size)
{
    const struct rhw_texture_def def = {.format = format, .width = size, .height = size};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void write_texel(struct rig *rig, rhw_texture texture, uint32_t rgba)
{
    assert_int_equal(rhw_texture_write(rig->context, texture, 0, &rgba, 0), RHW_OK);
}

static rhw_sampler make_sampler(struct rig *rig)
{
    const struct rhw_sampler_def def = {.label = NULL};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &def, &sampler), RHW_OK);
    return sampler;
}

// Everything a draw uses goes right after it, and something else takes its place; what is still set draws again.
static void test_what_a_draw_used_may_go(void **state)
{
    (void)state;
    for (int srgb = 0; srgb < 2; srgb++) {
        struct rig rig;
        rig_open(&rig, 8, 8);
        rig_set_depth(&rig);
        rig_set_program(&rig, rig_vertex_pass, sample_texture);
        const rhw_texture image =
            make_texture(&rig, srgb ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM, 1);
        const rhw_sampler sampler = make_sampler(&rig);
        write_texel(&rig, image, 0xff0000ff); // red, first byte first
        struct rig_vertex half[6];
        rig_rectangle(&rig, 0, 0, 4, 8, 0, red, half);
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 0, image, sampler);
        rig_draw(&rig, half, 6);
        const rhw_buffer vertices = rig.objects.buffers[--rig.objects.buffer_count];
        rhw_buffer_destroy(rig.context, vertices);
        rhw_texture_destroy(rig.context, image);
        rhw_sampler_destroy(rig.context, sampler);
        rhw_pipeline_destroy(rig.context, rig.objects.pipelines[--rig.objects.pipeline_count]);
        rhw_texture_destroy(rig.context, rig.pass.depth.texture);
        const rhw_texture next = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 1);
        write_texel(&rig, next, 0xffff0000);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1); // with all that is still set

        // Destroyed is destroyed: the ids are stale at once.
        rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, vertices, 0);
        rig_expect_misuse(&rig,
                          "rhw_pass_set_vertex_buffer: buffer 1 (generation 1) is stale: it was destroyed");
        rhw_texture_destroy(rig.context, image);
        rig_expect_misuse(&rig, "is stale: it was destroyed");
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        assert_memory_equal(pixels[0], red, sizeof red);
        assert_true(pixels[7][0] == 0 && pixels[7][2] == 0);
        rig.pass.depth.enabled = false;
        rig_close(&rig);
    }
}

// What is destroyed in a pass is given back at its end, and not later.
static size_t live_bytes;

static void *count_allocate(void *user, size_t size, size_t alignment)
{
    (void)user;
    void *memory = NULL;
    if (posix_memalign(&memory, alignment < sizeof(void *) ? sizeof(void *) : alignment, size) != 0) {
        return NULL;
    }
    live_bytes += size;
    return memory;
}

static void count_release(void *user, void *memory, size_t size)
{
    (void)user;
    live_bytes -= size;
    free(memory);
}

static void test_memory_comes_back_at_the_end(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.allocator = (struct rhw_allocator){count_allocate, count_release, NULL};
    live_bytes = 0;
    struct rig rig;
    rig_open_with(&rig, 8, 8, &def);
    rig_draw_once(&rig, (struct rig_vertex[3]){{{0}, {0}}}, 3); // warm
    const size_t before = live_bytes;
    static const char bytes[100000];
    const struct rhw_buffer_def big = {.size = sizeof bytes, .data = bytes};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &big, &buffer), RHW_OK);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, bytes, 1), RHW_OK);
    rhw_buffer_destroy(rig.context, buffer);
    assert_true(live_bytes >
                before + sizeof bytes); // the buffer, and what the draw reads of what was written
    rig_end(&rig);
    assert_true(live_bytes <= before);
    rig_close(&rig);
    assert_int_equal(live_bytes, 0);
}

// What no draw has read since is written in its place: any number of writes between two draws cost one copy.
static void test_writes_between_draws_share_a_copy(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.allocator = (struct rhw_allocator){count_allocate, count_release, NULL};
    live_bytes = 0;
    struct rig rig;
    rig_open_with(&rig, 8, 8, &def);
    rig_set_program(&rig, rig_vertex_pass, sample_texture);
    const rhw_texture image = make_texture(&rig, RHW_FORMAT_RGBA8_SRGB, 200);
    const rhw_sampler sampler = make_sampler(&rig);
    static uint32_t texels[200 * 200];
    static struct rig_vertex vertices[6000];
    rig_rectangle(&rig, 0, 0, 4, 8, 0, red, vertices);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, image, sampler);
    rig_draw(&rig, vertices, 6000);
    const rhw_buffer buffer = rig.objects.buffers[rig.objects.buffer_count - 1];
    rig_rectangle(&rig, 4, 0, 8, 8, 0, red, vertices);
    const size_t before = live_bytes;
    for (int i = 0; i < 200; i++) {
        for (int t = 0; t < 200 * 200; t++) {
            texels[t] = i < 199 ? 0xffffffff : 0xff0000ff;
        }
        assert_int_equal(rhw_texture_write(rig.context, image, 0, texels, 0), RHW_OK);
        assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, vertices, sizeof vertices), RHW_OK);
    }
    assert_true(live_bytes < before + 2 * (sizeof texels + sizeof vertices));
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_end(&rig);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    const float black[4] = {0, 0, 0, 0};
    assert_memory_equal(pixels[0], black, sizeof black);
    assert_memory_equal(pixels[4], red, sizeof red);
    rig_close(&rig);
}

// Begun twice with one variable: it still names the first pass.
static void test_a_second_pass_leaves_the_first(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    rig_begin(&rig);
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &rig.recording), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_begin: a pass is being recorded; end it first");
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig)[0], red, sizeof red);
    rig_close(&rig);
}

// Attachments keep what they hold, what was destroyed is released, and the next pass begins.
static void test_a_pass_may_be_given_up(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    rig_draw_once(&rig, all, 6);
    rig_cover(&rig, 0, blue, all);
    rig_begin(&rig);
    rig_draw(&rig, all, 6);
    rhw_buffer_destroy(rig.context, rig.objects.buffers[--rig.objects.buffer_count]);
    rhw_pass_push_debug_group(rig.context, rig.recording, "half done");
    rhw_pass_cancel(rig.context, rig.recording);
    assert_memory_equal(rig_read_float4(&rig)[0], red, sizeof red);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_expect_misuse(&rig, "rhw_pass_draw: the pass id is null or its pass has ended");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_expect_misuse(&rig, "rhw_pass_cancel: the pass id is null or its pass has ended");
    rig_draw_once(&rig, all, 6);
    assert_memory_equal(rig_read_float4(&rig)[0], blue, sizeof blue);
    rig_close(&rig);
}

static void test_null_ids_are_destroyed(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_buffer_destroy(rig.context, (rhw_buffer){0});
    rhw_texture_destroy(rig.context, (rhw_texture){0});
    rhw_sampler_destroy(rig.context, (rhw_sampler){0});
    rhw_pipeline_destroy(rig.context, (rhw_pipeline){0});
    assert_int_equal(rig.misuses, 0);
    rig_close(&rig);
}

// Written while recorded ------------------------------------------------------------------------------

// One buffer, one pass, four draws: each sees what the buffer held when it was recorded, whether it was set again or not,
// written whole or in part, read as vertices or as indices.
static void test_draws_keep_what_a_buffer_held(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 8);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    struct rig_vertex quad[6];
    rig_rectangle(&rig, 0, 0, 4, 8, 0, red, quad);
    rig_use_vertices(&rig, 0, quad, sizeof quad);
    const rhw_buffer vertices = rig.objects.buffers[rig.objects.buffer_count - 1];
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_rectangle(&rig, 4, 0, 8, 8, 0, blue, quad); // whole, still set
    assert_int_equal(rhw_buffer_write(rig.context, vertices, 0, quad, sizeof quad), RHW_OK);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    for (int i = 0; i < 6; i++) { // in part: moved by 4 pixels, a position at a time
        quad[i].position[0] += 0.5f;
        assert_int_equal(rhw_buffer_write(rig.context, vertices, (size_t)i * sizeof quad[0], quad[i].position,
                                          sizeof quad[i].position),
                         RHW_OK);
    }
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, vertices, 0);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);

    uint16_t indices[6] = {0, 1, 2, 3, 4, 5};
    rig_use_indices(&rig, RHW_INDEX_UINT16, indices, sizeof indices);
    const rhw_buffer index_buffer = rig.objects.buffers[rig.objects.buffer_count - 1];
    rig_rectangle(&rig, 12, 0, 16, 8, 0, red, quad);
    assert_int_equal(rhw_buffer_write(rig.context, vertices, 0, quad, sizeof quad), RHW_OK);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 6, 0, 0, 1);
    memset(indices, 0, sizeof indices);
    assert_int_equal(rhw_buffer_write(rig.context, index_buffer, 0, indices, sizeof indices), RHW_OK);
    rig_end(&rig);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int x = 0; x < 16; x++) {
        assert_memory_equal(pixels[x], x < 4 || x >= 12 ? red : blue, sizeof red);
    }
    rig_close(&rig);
}

// The same for textures, in each of the three ways they are kept; mip maps are made for the draws that follow.
static void test_draws_keep_what_a_texture_held(void **state)
{
    (void)state;
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_R32_FLOAT};
    for (int f = 0; f < 3; f++) {
        struct rig rig;
        rig_open(&rig, 12, 8);
        rig_set_program(&rig, rig_vertex_pass, sample_texture);
        const rhw_texture image = make_texture(&rig, formats[f], 1);
        const rhw_sampler sampler = make_sampler(&rig);
        const float one = 1;
        uint32_t bits;
        memcpy(&bits, &one, sizeof bits);
        write_texel(&rig, image, f < 2 ? 0xff0000ff : bits);
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 0, image, sampler);
        struct rig_vertex quad[6];
        rig_rectangle(&rig, 0, 0, 4, 8, 0, red, quad);
        rig_draw(&rig, quad, 6);
        write_texel(&rig, image, f < 2 ? 0xff00ff00 : 0); // still set
        uint32_t now = 1;
        assert_int_equal(rhw_texture_read(rig.context, image, 0, &now, 0), RHW_OK);
        assert_int_equal(now, f < 2 ? 0xff00ff00 : 0);
        rig_rectangle(&rig, 4, 0, 8, 8, 0, red, quad);
        rig_draw(&rig, quad, 6);
        write_texel(&rig, image, f < 2 ? 0xff0000ff : bits);
        assert_int_equal(rhw_texture_generate_mips(rig.context, image), RHW_OK);
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        assert_true(pixels[0][0] == 1 && pixels[4][0] == 0 && pixels[4][1] == (f < 2 ? 1.0f : 0.0f));

        // And drawn with once more: what a write in a pass left is the texture.
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 0, image, sampler);
        rig_draw(&rig, quad, 6);
        rig_end(&rig);
        assert_true(rig_read_float4(&rig)[4][0] == 1);
        rig_close(&rig);
    }
}

static void test_attachments_are_the_pass(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const rhw_texture target = rig.pass.colors[0].texture;
    static float pixels[8 * 8 * 4];
    rig_begin(&rig);
    assert_int_equal(rhw_texture_write(rig.context, target, 0, pixels, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(
        &rig, "rhw_texture_write: texture 1 is an attachment of the pass being recorded; end that first");
    assert_int_equal(rhw_texture_read(rig.context, target, 0, pixels, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_texture_read: texture 1 is an attachment");
    assert_int_equal(rhw_texture_generate_mips(rig.context, target), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_texture_generate_mips: texture 1 is an attachment");
    rig_end(&rig);
    assert_int_equal(rhw_texture_read(rig.context, target, 0, pixels, 0), RHW_OK);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_ids_carry_their_context),
    cmocka_unit_test(test_shader_functions_call_nothing),
    cmocka_unit_test(test_a_second_thread_is_told),
    cmocka_unit_test(test_threads_that_race_do_no_harm),
    cmocka_unit_test(test_a_hook_may_leave),
    cmocka_unit_test(test_a_hook_may_give_the_pass_up),
    cmocka_unit_test(test_a_hook_may_begin_another_pass),
    cmocka_unit_test(test_a_context_stays_while_it_records),
    cmocka_unit_test(test_what_a_draw_used_may_go),
    cmocka_unit_test(test_memory_comes_back_at_the_end),
    cmocka_unit_test(test_writes_between_draws_share_a_copy),
    cmocka_unit_test(test_a_second_pass_leaves_the_first),
    cmocka_unit_test(test_a_pass_may_be_given_up),
    cmocka_unit_test(test_null_ids_are_destroyed),
    cmocka_unit_test(test_draws_keep_what_a_buffer_held),
    cmocka_unit_test(test_draws_keep_what_a_texture_held),
    cmocka_unit_test(test_attachments_are_the_pass),
};

const struct unit_tests test_owners = UNIT_TESTS(tests, NULL, NULL);
