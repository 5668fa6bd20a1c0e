// SPDX-License-Identifier: MIT
// What a pass reads and writes of a buffer at once: buffers that shader functions only read, beside every other
// reading; reading and writing of one buffer, told apart by bytes; and what the program does with others meanwhile.
#include "harness.h"

#include <string.h>

static rhw_buffer make_buffer(struct rig *rig, size_t words, const uint32_t *data)
{
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = 4 * words, .data = data, .label = "counts"};
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

// Reading alone ----------------------------------------------------------------------------------------

// One buffer for everything that a pass reads.
struct everything {
    struct rig_vertex vertices[6];
    uint16_t indices[6];
    uint32_t before; // what follows begins at a multiple of 4
    struct rhw_draw_indexed_command command;
    uint32_t words[4];
    float texels[4];
};

static void read_everything(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int at[1] = {rhw_splat_int(1)};
        rhw_float texel[4];
        rhw_image_load(f->textures, 5, at, texel);
        f->color[0][0] = f->varying[0];
        f->color[0][1] = rhw_float_from_int(rhw_storage_load(f->textures, 3, rhw_splat_int(2), f->mask));
        f->color[0][2] = texel[0];
        f->color[0][3] = rhw_splat((float)rhw_storage_count(f->textures, 3));
    }
}

static void make_everything(const struct rig *rig, struct everything *all)
{
    *all = (struct everything){.indices = {0, 1, 2, 3, 4, 5},
                               .command = {.count = 6, .instances = 1},
                               .words = {10, 11, 12, 13},
                               .texels = {0.5f, 0.75f, 1, 2}};
    rig_cover(rig, 0.5f, (const float[4]){8, 0, 0, 0}, all->vertices);
}

static void read_only_goes_with_all(void **state)
{
    (void)state;
    struct everything all;
    struct rig rig;
    rig_open(&rig, 16, 16);
    make_everything(&rig, &all);
    const rhw_buffer buffer = make_buffer(&rig, sizeof all / 4, (const uint32_t *)(const void *)&all);
    rig_set_program(&rig, rig_vertex_pass, read_everything);
    rhw_context *const context = rig.context;
    const size_t words = offsetof(struct everything, words), texels = offsetof(struct everything, texels);
    const struct rhw_draw_commands commands = {
        .buffer = buffer, .offset = offsetof(struct everything, command), .count = 1};
    for (int order = 0; order < 2; order++) { // vertices before and after
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        for (int i = 0; i < 2; i++) {
            if (i == order) {
                rhw_pass_set_vertex_buffer(context, rig.recording, 0, buffer, 0);
                rhw_pass_set_index_buffer(context, rig.recording, buffer, RHW_INDEX_UINT16,
                                          offsetof(struct everything, indices));
            } else {
                rhw_pass_set_read_only_storage_buffer(context, rig.recording, 3, buffer, words,
                                                      sizeof all.words);
                rhw_pass_set_read_only_texel_buffer(context, rig.recording, 5, buffer, RHW_FORMAT_R32_FLOAT,
                                                    texels, 0);
            }
        }
        rhw_pass_draw_indexed_indirect(context, rig.recording, &commands);
        rig_end(&rig);
        assert_memory_equal(rig_read_float4(&rig)[100], ((const float[4]){8, 12, 0.75f, 4}), 16);
    }
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

// Between draws it may be written: each draw keeps what it had.
static void read_only_is_written_between_draws(void **state)
{
    (void)state;
    struct everything all;
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open(&rig, 16, 16);
    make_everything(&rig, &all);
    const rhw_buffer buffer = make_buffer(&rig, sizeof all / 4, (const uint32_t *)(const void *)&all);
    rig_set_program(&rig, rig_vertex_pass, read_everything);
    rhw_context *const context = rig.context;
    rig_begin(&rig);
    rhw_pass_set_read_only_storage_buffer(context, rig.recording, 3, buffer,
                                          offsetof(struct everything, words), sizeof all.words);
    rhw_pass_set_read_only_texel_buffer(context, rig.recording, 5, buffer, RHW_FORMAT_R32_FLOAT,
                                        offsetof(struct everything, texels), 0);
    rig_rectangle(&rig, 0, 0, 8, 16, 0.5f, (const float[4]){1}, vertices);
    rig_draw(&rig, vertices, 6);
    const uint32_t word = 77;
    const float texel = 0.125f;
    assert_int_equal(rhw_buffer_write(context, buffer, offsetof(struct everything, words[2]), &word, 4),
                     RHW_OK);
    assert_int_equal(rhw_buffer_write(context, buffer, offsetof(struct everything, texels[1]), &texel, 4),
                     RHW_OK);
    rig_rectangle(&rig, 8, 0, 16, 16, 0.5f, (const float[4]){2}, vertices);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig)[7], ((const float[4]){1, 12, 0.75f, 4}), 16);
    assert_memory_equal(rig_read_float4(&rig)[8], ((const float[4]){2, 77, 0.125f, 4}), 16);
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

static rhw_int try_to_write(const struct rhw_fragment *f)
{
    const rhw_int zero[1] = {rhw_splat_int(0)}, one = rhw_splat_int(1);
    rhw_int before, sum = rhw_splat_int(0);
    rhw_float texel[4] = {rhw_splat(0), rhw_splat(0), rhw_splat(0), rhw_splat(0)};
    rhw_storage_store(f->textures, 0, zero[0], one, f->mask);
    sum += rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, zero[0], one, f->mask);
    sum += rhw_storage_compare_exchange(f->textures, 0, zero[0], rhw_splat_int(41), one, f->mask);
    rhw_image_store(f->textures, 0, zero, &f->mask, texel);
    const struct rhw_storage_request request = {
        .operation = RHW_STORAGE_ADD, .mask = &f->mask, .index = zero, .value = &one};
    rhw_image_atomic(f->textures, 0, &request, &before);
    return sum + before;
}

static void write_in_vain(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int zero[1] = {rhw_splat_int(0)};
        f->color[0][0] = rhw_float_from_int(try_to_write(f));
        f->color[0][1] = rhw_float_from_int(rhw_storage_load(f->textures, 0, zero[0], f->mask));
        rhw_float texel[4];
        rhw_image_load(f->textures, 0, zero, texel);
        f->color[0][2] = rhw_float_from_int(rhw_bits_from_float(texel[0]));
        f->color[0][3] = rhw_splat(1);
    }
}

static void write_in_vain1(struct rhw_fragment1 *f)
{
    const int32_t zero[1] = {0};
    const float none[4] = {0};
    rhw_storage_store1(f->textures, 0, 0, 1);
    int32_t sum = rhw_storage_atomic1(f->textures, 0, RHW_STORAGE_ADD, 0, 1);
    sum += rhw_storage_compare_exchange1(f->textures, 0, 0, 41, 1);
    rhw_image_store1(f->textures, 0, zero, none);
    sum += rhw_image_atomic1(f->textures, 0, RHW_STORAGE_ADD, zero, 1, 0);
    float texel[4];
    rhw_image_load1(f->textures, 0, zero, texel);
    int32_t bits;
    memcpy(&bits, texel, sizeof bits);
    f->color[0][0] = (float)sum;
    f->color[0][1] = (float)rhw_storage_load1(f->textures, 0, 0);
    f->color[0][2] = (float)bits;
    f->color[0][3] = 1;
}

// Writing and atomics do nothing and give 0; under validation they are told.
static void read_only_is_not_written(void **state)
{
    (void)state;
    for (int n = 0; n < 8;
         n++) { // the first half with another buffer in the storage slot, which may be written
        const bool validates = n & 1, has_other = n < 4;
        const struct rhw_context_def def = {.validate = validates ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF};
        struct rig rig;
        struct rig_vertex vertices[6];
        uint32_t words[2] = {41, 42};
        rig_open_with(&rig, 16, 16, &def);
        const rhw_buffer buffer = make_buffer(&rig, 2, words), other = make_buffer(&rig, 2, words);
        rig_set_program(&rig, rig_vertex_pass, write_in_vain);
        if (n & 2) {
            memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
            rig.pipeline.program.fragment1 = write_in_vain1;
        }
        rig.pipeline.program.uses = RHW_USE_EFFECTS;
        rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
        rig_begin(&rig);
        if (has_other) {
            rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, other, 0, 0);
        } else {
            rhw_pass_set_read_only_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 0);
        }
        rhw_pass_set_read_only_texel_buffer(rig.context, rig.recording, 0, buffer, RHW_FORMAT_R32_UINT, 4, 0);
        rig_draw(&rig, vertices, 6);
        rhw_pass_end(rig.context, rig.recording, &rig.stats);
        if (validates) {
            rig_expect_misuse(&rig, has_other ? "writes to image slot 0, which is set for reading alone"
                                              : "writes to storage slot 0, which is set for reading alone");
        }
        assert_int_equal(rhw_buffer_read(rig.context, buffer, 0, words, sizeof words), RHW_OK);
        assert_true(words[0] == 41 && words[1] == 42);
        const float *const pixel = rig_read_float4(&rig)[100];
        assert_true(pixel[2] == 42 && (has_other || (pixel[0] == 0 && pixel[1] == 41)));
        rhw_buffer_destroy(rig.context, buffer);
        rhw_buffer_destroy(rig.context, other);
        rig_close(&rig);
    }
}

// Ranges -----------------------------------------------------------------------------------------------

enum use { USE_VERTICES, USE_INDICES, USE_READ_ONLY, USE_READ_ONLY_TEXELS, USE_STORAGE, USE_TEXELS, USES };

static void use_range(struct rig *rig, rhw_buffer buffer, enum use use, size_t offset, size_t size)
{
    rhw_context *const context = rig->context;
    const rhw_pass pass = rig->recording;
    switch (use) {
    case USE_VERTICES: rhw_pass_set_vertex_buffer_range(context, pass, 1, buffer, offset, size); break;
    case USE_INDICES:
        rhw_pass_set_index_buffer_range(context, pass, buffer, RHW_INDEX_UINT16, offset, size);
        break;
    case USE_READ_ONLY: rhw_pass_set_read_only_storage_buffer(context, pass, 1, buffer, offset, size); break;
    case USE_READ_ONLY_TEXELS:
        rhw_pass_set_read_only_texel_buffer(context, pass, 1, buffer, RHW_FORMAT_R32_FLOAT, offset, size);
        break;
    case USE_STORAGE: rhw_pass_set_storage_buffer(context, pass, 1, buffer, offset, size); break;
    default: rhw_pass_set_texel_buffer(context, pass, 1, buffer, RHW_FORMAT_R32_UINT, offset, size); break;
    }
}

// Reading and writing exclude each other where they share a byte, in either order; nothing else does.
static void ranges(void **state)
{
    (void)state;
    static const struct {
        size_t offset, size;
        bool shares;
    } others[] = {{0, 16, false}, {32, 0, false}, {0, 20, true}, {28, 4, true},
                  {20, 4, true},  {0, 0, true},   {28, 0, true}, {16, 16, true}};
    struct rig rig;
    rig_open(&rig, 16, 16);
    const rhw_buffer buffer = make_buffer(&rig, 16, NULL);
    for (int n = 0; n < USES * USES * 8; n++) {
        const enum use a = (enum use)(n / 8 / USES), b = (enum use)(n / 8 % USES);
        const bool excludes = (a >= USE_STORAGE) != (b >= USE_STORAGE) && others[n % 8].shares;
        rig_begin(&rig);
        use_range(&rig, buffer, a, 16, 16);
        use_range(&rig, buffer, b, others[n % 8].offset, others[n % 8].size);
        if (excludes != (rig.misuses != 0)) {
            fail_msg("%d, %d, range %d: %s", (int)a, (int)b, n % 8, rig.misuses ? rig.message : "no misuse");
        }
        if (excludes) {
            rig_expect_misuse(&rig, "bytes 16 to 32");
        }
        rhw_pass_cancel(rig.context, rig.recording);
    }
    // Between two that are read there is one to write, and the other way round.
    for (int swaps = 0; swaps < 2; swaps++) {
        const enum use outer = swaps ? USE_STORAGE : USE_READ_ONLY, inner = swaps ? USE_INDICES : USE_TEXELS;
        rig_begin(&rig);
        use_range(&rig, buffer, outer, 0, 16);
        use_range(&rig, buffer, outer, 32, 16);
        use_range(&rig, buffer, inner, 16, 16);
        use_range(&rig, buffer, inner, 48, 0);
        assert_int_equal(rig.misuses, 0);
        use_range(&rig, buffer, inner, 12, 8);
        rig_expect_misuse(&rig, "bytes 0 to 16");
        use_range(&rig, buffer, inner, 44, 8);
        rig_expect_misuse(&rig, "bytes 32 to 48");
        rhw_pass_cancel(rig.context, rig.recording);
    }
    // No commands are no bytes.
    const struct rhw_draw_commands none = {.buffer = buffer, .offset = 4};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    use_range(&rig, buffer, USE_STORAGE, 0, 0);
    rhw_pass_draw_indirect(rig.context, rig.recording, &none);
    rig_end(&rig);
    assert_int_equal(rig.misuses, 0);
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static void count_in_slot1(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        rhw_storage_atomic(groups[g].textures, 1, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1),
                           groups[g].mask);
    }
}

// Vertices in front, what is counted behind; what lies behind a range of vertices or indices is outside to draws.
static void halves(void **state)
{
    (void)state;
    struct {
        struct rig_vertex vertices[6];
        uint16_t indices[6];
        uint32_t pad, sum;
    } both = {.indices = {0, 1, 2, 3, 4, 5}};
    const size_t vertices = sizeof both.vertices, indices = sizeof both.indices, all = sizeof both;
    struct rig rig;
    rig_open_with(&rig, 16, 16, &(struct rhw_context_def){.validate = RHW_VALIDATE_OFF});
    rig_cover(&rig, 0.5f, (const float[4]){3, 0, 0, 1}, both.vertices);
    const rhw_buffer buffer = make_buffer(&rig, all / 4, (const uint32_t *)(const void *)&both);
    rig_set_program(&rig, rig_vertex_pass, count_in_slot1);
    rig.pipeline.program.uses = RHW_USE_EFFECTS;
    static const struct {
        int vertices, indices; // that the ranges have
        uint32_t fragments;    // the diagonal is the second triangle's
    } cases[] = {{6, 6, 256}, {3, 6, 120}, {6, 3, 120}, {6, 2, 0}, {1, 6, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rhw_pass_set_vertex_buffer_range(rig.context, rig.recording, 0, buffer, 0,
                                         (size_t)cases[i].vertices * sizeof *both.vertices);
        rhw_pass_set_index_buffer_range(rig.context, rig.recording, buffer, RHW_INDEX_UINT16, vertices,
                                        (size_t)cases[i].indices * sizeof *both.indices);
        rhw_pass_set_storage_buffer(rig.context, rig.recording, 1, buffer, vertices + indices + 4, 4);
        rhw_pass_draw_indexed(rig.context, rig.recording, 0, 6, 0, 0, 1);
        rig_end(&rig);
        uint32_t words[sizeof both / 4];
        assert_int_equal(rhw_buffer_read(rig.context, buffer, 0, words, all), RHW_OK);
        const uint32_t sum = words[all / 4 - 1];
        assert_int_equal(sum, cases[i].fragments);
        words[all / 4 - 1] = 0;
        assert_memory_equal(words, &both, all);
        assert_int_equal(rhw_buffer_write(rig.context, buffer, all - 4, words + all / 4 - 1, 4), RHW_OK);
    }
    rig_begin(&rig);
    rhw_pass_set_vertex_buffer_range(rig.context, rig.recording, 0, buffer, 4, all);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_buffer_range: offset is 4 and size is");
    rhw_pass_set_index_buffer_range(rig.context, rig.recording, buffer, RHW_INDEX_UINT16, all + 1, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_index_buffer_range: offset is");
    rhw_pass_cancel(rig.context, rig.recording);
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

// The program, meanwhile -------------------------------------------------------------------------------

enum access {
    HOST_READ,
    HOST_COPY_FROM,
    HOST_TEXTURE_FROM,
    HOST_MAP_READ,
    HOST_WRITE,
    HOST_FILL,
    HOST_COPY_TO,
    HOST_TEXTURE_TO,
    HOST_MAP,
    HOST_ACCESSES
};

struct host {
    rhw_buffer buffer, other;
    rhw_texture texture; // a row of R32_UINT
};

static void access_bytes(struct rig *rig, const struct host *host, enum access access, size_t offset,
                         size_t size)
{
    rhw_context *const context = rig->context;
    unsigned char bytes[64] = {0};
    void *mapped;
    const struct rhw_texture_region region = {.width = (int)size / 4, .height = 1};
    const struct rhw_texel_layout layout = {.offset = offset};
    switch (access) {
    case HOST_READ: rhw_buffer_read(context, host->buffer, offset, bytes, size); break;
    case HOST_COPY_FROM: rhw_buffer_copy(context, host->buffer, offset, host->other, 0, size); break;
    case HOST_TEXTURE_FROM:
        rhw_texture_copy_from_buffer(context, host->texture, &region, host->buffer, &layout);
        break;
    case HOST_WRITE: rhw_buffer_write(context, host->buffer, offset, bytes, size); break;
    case HOST_FILL: rhw_buffer_fill(context, host->buffer, offset, size, 0); break;
    case HOST_COPY_TO: rhw_buffer_copy(context, host->other, 0, host->buffer, offset, size); break;
    case HOST_TEXTURE_TO:
        rhw_texture_copy_to_buffer(context, host->texture, &region, host->buffer, &layout);
        break;
    default:
        if (rhw_buffer_map(context, host->buffer, offset, size,
                           access == HOST_MAP ? RHW_MAP_READ_WRITE : RHW_MAP_READ, &mapped) == RHW_OK) {
            rhw_buffer_unmap(context, host->buffer);
        }
    }
}

// What the pass may write the program neither reads nor writes; what it reads is written where nothing of the buffer is
// written by the pass. Bytes beside all this are free.
static void program_beside_passes(void **state)
{
    (void)state;
    static const struct {
        size_t offset, size;
        bool shares;
    } others[] = {{0, 16, false}, {32, 16, false}, {0, 20, true}, {28, 4, true}, {0, 48, true}};
    struct rig rig;
    rig_open(&rig, 16, 16);
    struct host host = {make_buffer(&rig, 16, NULL), make_buffer(&rig, 16, NULL), {0}};
    const struct rhw_texture_def def = {.format = RHW_FORMAT_R32_UINT, .width = 16, .height = 1};
    assert_int_equal(rhw_texture_create(rig.context, &def, &host.texture), RHW_OK);
    for (int n = 0; n < USES * HOST_ACCESSES * 5 * 2; n++) {
        const enum use use = (enum use)(n / 10 / HOST_ACCESSES);
        const enum access access = (enum access)(n / 10 % HOST_ACCESSES);
        const bool is_written = use >= USE_STORAGE, writes_others = n % 10 >= 5,
                   shares = others[n % 5].shares;
        const bool refuses =
            shares && (is_written || access == HOST_MAP || (writes_others && access >= HOST_WRITE));
        rig_begin(&rig);
        use_range(&rig, host.buffer, use, 16, 16);
        if (writes_others) {
            rhw_pass_set_storage_buffer(rig.context, rig.recording, 2, host.buffer, 48, 0);
        }
        access_bytes(&rig, &host, access, others[n % 5].offset, others[n % 5].size);
        if (refuses != (rig.misuses != 0)) {
            fail_msg("%d, %d, range %d: %s", (int)use, (int)access, n % 10,
                     rig.misuses ? rig.message : "no misuse");
        }
        if (refuses) {
            rig_expect_misuse(&rig, is_written           ? "storage of this pass may write bytes 16 to 32"
                                    : access == HOST_MAP ? "of this pass reads bytes 16 to 32"
                                                         : "this pass reads some of them and may write "
                                                           "others; end the pass first");
        }
        rhw_pass_cancel(rig.context, rig.recording);
        access_bytes(&rig, &host, access, 0, 64); // what the pass used is forgotten
        assert_int_equal(rig.misuses, 0);
    }
    rig_close(&rig);
}

// Vertices in front, what is counted behind, and what the program writes and reads between the two, while a pass is
// recorded that uses both: nothing of it is lost.
static void program_between_draws(void **state)
{
    (void)state;
    struct {
        struct rig_vertex vertices[6];
        uint32_t middle[4], sum;
    } all = {.middle = {1, 2, 3, 4}};
    const size_t middle = sizeof all.vertices;
    struct rig rig;
    rig_open_with(&rig, 16, 16, &(struct rhw_context_def){.validate = RHW_VALIDATE_OFF});
    rhw_context *const context = rig.context;
    rig_cover(&rig, 0.5f, (const float[4]){3, 0, 0, 1}, all.vertices);
    const rhw_buffer buffer = make_buffer(&rig, sizeof all / 4, (const uint32_t *)(const void *)&all);
    rig_set_program(&rig, rig_vertex_pass, count_in_slot1);
    rig.pipeline.program.uses = RHW_USE_EFFECTS;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer_range(context, rig.recording, 0, buffer, 0, middle);
    rhw_pass_set_storage_buffer(context, rig.recording, 1, buffer, middle + 16, 0);
    rhw_pass_draw(context, rig.recording, 0, 6, 0, 1);
    assert_int_equal(rhw_buffer_fill(context, buffer, middle, 8, 50), RHW_OK);
    void *mapped;
    assert_int_equal(rhw_buffer_map(context, buffer, middle + 8, 8, RHW_MAP_READ_WRITE, &mapped), RHW_OK);
    // What is mapped the pass leaves alone, and uses the bytes beside it.
    rhw_pass_set_storage_buffer(context, rig.recording, 2, buffer, middle + 12, 4);
    rig_expect_misuse(&rig, "rhw_pass_set_storage_buffer: bytes 200 to 208 of buffer");
    rhw_pass_set_vertex_buffer_range(context, rig.recording, 1, buffer, 0, middle + 12);
    rig_expect_misuse(&rig, "are mapped for writing; call rhw_buffer_unmap first");
    rhw_pass_set_vertex_buffer_range(context, rig.recording, 0, buffer, 0, middle);
    rhw_pass_set_storage_buffer(context, rig.recording, 1, buffer, middle + 16, 4);
    rhw_pass_draw_indirect(context, rig.recording,
                           &(struct rhw_draw_commands){.buffer = buffer, .offset = middle + 12}); // none
    assert_int_equal(rig.misuses, 0);
    rhw_pass_draw(context, rig.recording, 0, 6, 0, 1);
    uint32_t words[4];
    assert_int_equal(rhw_buffer_read(context, buffer, middle, words, sizeof words), RHW_OK);
    assert_memory_equal(words, ((const uint32_t[]){50, 50, 3, 4}), sizeof words);
    assert_int_equal(rhw_pass_end(context, rig.recording, NULL), RHW_ERROR_MISUSE);
    memcpy(mapped, words, 8);
    rhw_buffer_unmap(context, buffer);
    assert_int_equal(rhw_buffer_read(context, buffer, 0, &all, sizeof all), RHW_OK);
    assert_memory_equal(all.middle, ((const uint32_t[]){50, 50, 50, 50}), sizeof words);
    assert_int_equal(all.sum, 2 * 256);
    assert_true(rig_read_float4(&rig)[77][0] == 3);
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

// A part without bytes is not written: what draws read beside it the program replaces.
static void program_beside_nothing(void **state)
{
    (void)state;
    struct rig_vertex vertices[2][6];
    struct rig rig;
    rig_open(&rig, 16, 16);
    rhw_context *const context = rig.context;
    rig_cover(&rig, 0.5f, (const float[4]){3, 0, 0, 1}, vertices[0]);
    rig_cover(&rig, 0.5f, (const float[4]){5, 0, 0, 1}, vertices[1]);
    const rhw_buffer buffer =
        make_buffer(&rig, sizeof vertices[0] / 4, (const uint32_t *)(const void *)vertices[0]);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(context, rig.recording, 0, buffer, 0);
    rhw_pass_set_storage_buffer(context, rig.recording, 1, buffer, sizeof vertices[0], 0);
    rhw_pass_draw(context, rig.recording, 0, 6, 0, 1);
    assert_int_equal(rhw_buffer_write(context, buffer, 0, vertices[1], sizeof vertices[1]), RHW_OK);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[77][0] == 3);
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(read_only_goes_with_all),
                                          cmocka_unit_test(read_only_is_written_between_draws),
                                          cmocka_unit_test(read_only_is_not_written),
                                          cmocka_unit_test(ranges),
                                          cmocka_unit_test(halves),
                                          cmocka_unit_test(program_beside_passes),
                                          cmocka_unit_test(program_between_draws),
                                          cmocka_unit_test(program_beside_nothing)};

const struct unit_tests test_buffer_use = UNIT_TESTS(tests, NULL, NULL);
