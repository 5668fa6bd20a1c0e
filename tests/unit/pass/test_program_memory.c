// SPDX-License-Identifier: MIT
// Draws on memory of the program's: what they read of vertices, indices and uniforms is what they read of buffers, and
// no byte behind it; transform feedback to such memory; what is refused, and what validation tells.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

#if defined __linux__
#include <sys/mman.h>
#endif

// Memory that ends where the process may read nothing more, or at least where a sanitizer watches.
struct tail {
    unsigned char *bytes; // the last `size` bytes
    void *block;
    size_t length;
};

static struct tail tail_of(const void *data, size_t size)
{
    struct tail tail = {.length = (size + 4095) / 4096 * 4096 + 4096};
#if defined __linux__
    tail.block = mmap(NULL, tail.length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_ptr_not_equal(tail.block, MAP_FAILED);
    tail.bytes = (unsigned char *)tail.block + tail.length - 4096 - size;
    assert_int_equal(mprotect(tail.bytes + size, 4096, PROT_NONE), 0);
#else
    assert_int_equal(posix_memalign(&tail.block, 64, size == 0 ? 1 : size), 0);
    tail.bytes = tail.block;
#endif
    if (size != 0) {
        memcpy(tail.bytes, data, size);
    }
    return tail;
}

static void tail_free(struct tail tail)
{
#if defined __linux__
    munmap(tail.block, tail.length);
#else
    free(tail.block);
#endif
}

static rhw_buffer make_buffer(struct rig *rig, const void *data, size_t size)
{
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = size, .data = data, .label = "own"};
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

// What a vertex fetches, captured ------------------------------------------------------------------------

enum { MOST = 21, FLOATS = 8 }; // vertices, and floats that are kept of each

static void keep_attributes(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < FLOATS; i++) {
            groups[g].varying[i] = groups[g].attribute[i / 4][i % 4];
        }
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = rhw_splat(1);
        }
    }
}

// A rig whose pipeline captures two attributes of each point.
static void open_capture(struct rig *rig, const struct rhw_context_def *def)
{
    rig_open_with(rig, 8, 8, def);
    rig_set_program(rig, keep_attributes, rig_fragment_pass);
    rig->pipeline.topology = RHW_POINT_LIST;
    rig->pipeline.program.varying_count = 2;
    rig->pipeline.program.varyings[0] = rig->pipeline.program.varyings[1] =
        (struct rhw_varying){.components = 4, .qualifier = RHW_FLAT};
    for (int i = 0; i < 2; i++) {
        rig->pipeline.feedback_outputs[i] = (struct rhw_feedback_output){
            .source = RHW_FEEDBACK_VARYING, .index = i, .offset = 16u * (uint32_t)i};
    }
    rig->pipeline.feedback_output_count = 2;
}

// Let both attributes be one vector of four floats.
static void take_one_vector(struct rig *rig)
{
    rig->pipeline.attributes[0].format = rig->pipeline.attributes[1].format = RHW_VERTEX_FLOAT4;
    rig->pipeline.attributes[1].offset = 0;
    rig->pipeline.buffers[0].stride = 16;
}

// What stands in for vertices and indices in a draw.
struct input {
    const void *vertices, *indices; // `indices` NULL: none
    size_t vertex_size, index_size; // bytes
    enum rhw_index_type type;
    uint32_t count;
};

// Draw points from buffers or from memory into `out`, which is memory too where the input is.
static void capture(struct rig *rig, const struct input *input, bool from_memory, float *out)
{
    const size_t size = input->count * FLOATS * sizeof(float);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rhw_buffer kept = {0};
    if (from_memory) {
        rhw_pass_set_vertex_memory(rig->context, rig->recording, 0, input->vertices, input->vertex_size);
        rhw_pass_set_index_memory(rig->context, rig->recording, input->indices, input->type,
                                  input->index_size);
        const struct rhw_feedback_target target = {.memory = out, .size = size};
        rhw_pass_begin_transform_feedback(rig->context, rig->recording, &target, 1);
    } else {
        rig_use_vertices(rig, 0, input->vertices, input->vertex_size);
        if (input->indices) {
            rig_use_indices(rig, input->type, input->indices, input->index_size);
        }
        kept = make_buffer(rig, NULL, size);
        rhw_pass_begin_transform_feedback(rig->context, rig->recording,
                                          &(struct rhw_feedback_target){.buffer = kept}, 1);
    }
    if (input->indices) {
        rhw_pass_draw_indexed(rig->context, rig->recording, 0, input->count, 0, 0, 1);
    } else {
        rhw_pass_draw(rig->context, rig->recording, 0, input->count, 0, 1);
    }
    size_t written[RHW_MAX_FEEDBACK_TARGETS];
    rhw_pass_end_transform_feedback(rig->context, rig->recording, written);
    assert_int_equal(written[0], size);
    rig_end(rig);
    if (!from_memory) {
        assert_int_equal(rhw_buffer_read(rig->context, kept, 0, out, size), RHW_OK);
        rhw_buffer_destroy(rig->context, kept);
    }
}

static void expect_same(struct rig *rig, const struct input *input)
{
    float expected[MOST * FLOATS], seen[MOST * FLOATS];
    const struct tail vertices = tail_of(input->vertices, input->vertex_size);
    const struct tail indices = tail_of(input->indices, input->index_size);
    const struct tail out = tail_of(seen, input->count * FLOATS * sizeof(float));
    capture(rig, input, false, expected);
    struct input in_memory = *input;
    in_memory.vertices = vertices.bytes;
    in_memory.indices = input->indices ? indices.bytes : NULL;
    capture(rig, &in_memory, true, (float *)(void *)out.bytes);
    assert_memory_equal(out.bytes, expected, input->count * FLOATS * sizeof(float));
    tail_free(vertices);
    tail_free(indices);
    tail_free(out);
}

// Every format at the end of memory, in strides of any number of bytes, for up to two groups of 8 vertices and some.
static void test_vertices(void **state)
{
    (void)state;
    unsigned char data[MOST * 40];
    uint64_t random = 1;
    for (size_t i = 0; i < sizeof data; i++) {
        data[i] = (unsigned char)rig_random(&random);
    }
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 2});
    for (int format = 0; format < RHW_VERTEX_FORMAT_COUNT; format++) {
        const uint32_t size = (uint32_t)rhw_vertex_format_size((enum rhw_vertex_format)format);
        const uint32_t stride = size + (uint32_t)rig_random_int(&random, 9);
        rig.pipeline.attributes[0] = (struct rhw_attribute){(enum rhw_vertex_format)format, 0, 0};
        rig.pipeline.attributes[1] = (struct rhw_attribute){RHW_VERTEX_UNORM8X1, 0, stride - 1};
        rig.pipeline.buffers[0].stride = stride;
        const uint32_t count = (uint32_t)rig_random_int(&random, MOST) + 1;
        // Sometimes the last vertices do not lie wholly inside.
        const size_t cut = format % 3 == 0 ? (size_t)rig_random_int(&random, (int)stride) : 0;
        expect_same(&rig,
                    &(struct input){.vertices = data, .vertex_size = count * stride - cut, .count = count});
    }
    rig_close(&rig);
}

// A buffer on memory of the program's has no byte behind its own.
static void test_buffers_without_padding(void **state)
{
    (void)state;
    float data[16][3], out[16][FLOATS]; // 192 bytes, so that the memory is aligned
    for (int i = 0; i < 48; i++) {
        data[i / 3][i % 3] = (float)i;
    }
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 1});
    rig.pipeline.attributes[0].format = rig.pipeline.attributes[1].format = RHW_VERTEX_FLOAT3;
    rig.pipeline.attributes[1].offset = 0;
    rig.pipeline.buffers[0].stride = sizeof *data;
    const struct tail tail = tail_of(data, sizeof data);
    const struct rhw_buffer_def def = {.size = sizeof data, .memory = tail.bytes, .memory_size = sizeof data};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    const struct rhw_feedback_target target = {.memory = out, .size = sizeof out};
    rhw_pass_begin_transform_feedback(rig.context, rig.recording, &target, 1);
    rhw_pass_draw(rig.context, rig.recording, 0, 16, 0, 1);
    rhw_pass_end_transform_feedback(rig.context, rig.recording, NULL);
    rig_end(&rig);
    for (int i = 0; i < 16; i++) {
        assert_memory_equal(out[i], data[i], sizeof *data);
        assert_true(out[i][3] == 1);
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
    tail_free(tail);
}

static void test_indices(void **state)
{
    (void)state;
    float data[MOST][4];
    for (int i = 0; i < MOST; i++) {
        for (int c = 0; c < 4; c++) {
            data[i][c] = (float)(10 * i + c);
        }
    }
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 1});
    rig.pipeline.attributes[0].format = rig.pipeline.attributes[1].format = RHW_VERTEX_FLOAT2;
    rig.pipeline.attributes[1].offset = 8;
    rig.pipeline.buffers[0].stride = 16;
    for (int type = RHW_INDEX_UINT8; type <= RHW_INDEX_UINT32; type++) {
        const size_t size = (size_t)1 << type;
        for (uint32_t count = 1; count <= MOST; count++) {
            unsigned char indices[MOST * 4] = {0};
            for (size_t i = 0; i < count; i++) {
                indices[i * size] = (unsigned char)((i * 7 + 3) % MOST); // little endian
            }
            struct input input = {.vertices = data,
                                  .vertex_size = sizeof data,
                                  .indices = indices,
                                  .index_size = count * size,
                                  .type = (enum rhw_index_type)type,
                                  .count = count};
            expect_same(&rig, &input);
            input.index_size -= 1;       // the last index is not wholly inside, and the address is odd
            if (input.index_size != 0) { // no buffer has no bytes
                expect_same(&rig, &input);
            }
        }
    }
    rig_close(&rig);
}

// Strips read indices ahead, lists of triangles read them where they stand, and a large draw shares its vertices.
static void test_triangles(void **state)
{
    (void)state;
    enum { SIDE = 260, COUNT = 6 * (SIDE - 1) * (SIDE - 1) };
    struct rig_vertex *const vertices = calloc(SIDE * SIDE, sizeof *vertices);
    uint32_t *const indices = calloc(COUNT, sizeof *indices);
    assert_true(vertices && indices);
    struct rig rig;
    rig_open(&rig, 64, 64);
    uint64_t random = 3;
    for (int i = 0; i < SIDE * SIDE; i++) {
        rig_place(&rig, (float)(i % SIDE) / 4, (float)(i / SIDE) / 4, 0.5f, 1, vertices[i].position);
        vertices[i].value[0] = rig_random_float(&random, 0, 1);
    }
    for (uint32_t i = 0; i < COUNT; i++) {
        // Cells in no order, so that the vertices are shared before the chunks.
        const uint32_t cell = (uint32_t)((i / 6 * 7919ull) % ((SIDE - 1) * (SIDE - 1)));
        static const uint32_t corners[6] = {0, 1, SIDE, SIDE, 1, SIDE + 1};
        indices[i] = cell / (SIDE - 1) * SIDE + cell % (SIDE - 1) + corners[i % 6];
    }
    const struct tail vertex_tail = tail_of(vertices, SIDE * SIDE * sizeof *vertices);
    const struct tail index_tail = tail_of(indices, COUNT * sizeof *indices);
    for (int strip = 0; strip < 2; strip++) {
        rig.pipeline.topology = strip ? RHW_TRIANGLE_STRIP : RHW_TRIANGLE_LIST;
        uint64_t hash[2];
        for (int from_memory = 0; from_memory < 2; from_memory++) {
            rig_begin(&rig);
            rig_use_pipeline(&rig);
            if (from_memory) {
                rhw_pass_set_vertex_memory(rig.context, rig.recording, 0, vertex_tail.bytes,
                                           SIDE * SIDE * sizeof *vertices);
                rhw_pass_set_index_memory(rig.context, rig.recording, index_tail.bytes, RHW_INDEX_UINT32,
                                          COUNT * sizeof *indices);
            } else {
                rig_use_vertices(&rig, 0, vertices, SIDE * SIDE * sizeof *vertices);
                rig_use_indices(&rig, RHW_INDEX_UINT32, indices, COUNT * sizeof *indices);
            }
            rhw_pass_draw_indexed(rig.context, rig.recording, 0, COUNT, 0, 0, 1);
            rig_end(&rig);
            hash[from_memory] = rig_hash(&rig, 0);
        }
        assert_true(hash[0] == hash[1]);
    }
    rig_close(&rig);
    tail_free(vertex_tail);
    tail_free(index_tail);
    free(vertices);
    free(indices);
}

// Uniforms -----------------------------------------------------------------------------------------------

static float uniforms[4]; // what the functions must receive

static void uniform_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const float *const received = groups[g].uniforms;
        groups[g].color[0][0] = rhw_splat(received == uniforms ? 1.0f : 2.0f);
        for (int c = 1; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(received[c]);
        }
    }
}

static void test_uniforms(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_program(&rig, rig_vertex_pass, uniform_fragment);
    rig.pipeline.program.uniform_size = sizeof uniforms;
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    uniforms[3] = 7;
    rhw_pass_set_uniform_memory(rig.context, rig.recording, uniforms, sizeof uniforms);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[0][0] == 1 && rig_read_float4(&rig)[0][3] == 7);
    rig_begin(&rig); // the last that was set counts, also where the other kind was set before it
    rhw_pass_set_uniform_memory(rig.context, rig.recording, uniforms, sizeof uniforms);
    rhw_pass_set_uniforms(rig.context, rig.recording, (const float[4]){0, 0, 0, 8}, sizeof uniforms);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[0][0] == 2 && rig_read_float4(&rig)[0][3] == 8);
    rig_begin(&rig);
    rhw_pass_set_uniform_memory(rig.context, rig.recording, uniforms, 8);
    rig_draw(&rig, vertices, 6);
    rig_expect_misuse(&rig, "rhw_pass_draw: 8 bytes of uniforms are set; the program of pipeline");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

// Transform feedback -------------------------------------------------------------------------------------

// A target that two draws fill one behind the other, with a pause between, and no byte too many.
static void test_feedback_goes_on(void **state)
{
    (void)state;
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 2, .validate = RHW_VALIDATE_ON});
    const float data[2][4] = {{1, 2, 3, 4}, {5, 6, 7, 8}};
    float out[64];
    for (int i = 0; i < 64; i++) {
        out[i] = -1;
    }
    take_one_vector(&rig);
    size_t written[RHW_MAX_FEEDBACK_TARGETS], at = 8;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_memory(rig.context, rig.recording, 0, data, sizeof data);
    for (int draw = 0; draw < 3; draw++) {
        const struct rhw_feedback_target target = {.memory = out, .offset = at, .size = 5 * 32 + 8 - at};
        rhw_pass_begin_transform_feedback(rig.context, rig.recording, &target, 1);
        rhw_pass_draw(rig.context, rig.recording, 0, 2, 0, 1);
        rhw_pass_end_transform_feedback(rig.context, rig.recording, written);
        assert_int_equal(written[0], draw < 2 ? 64 : 32); // the last point has no room
        at += written[0];
    }
    rig_end(&rig);
    for (int i = 0; i < 64; i++) {
        const int float_ = i - 2;
        const float expected = float_ < 0 || float_ >= 40 ? -1 : data[float_ / 8 % 2][float_ % 4];
        assert_true(out[i] == expected);
    }
    rig_close(&rig);
}

// Misuse -------------------------------------------------------------------------------------------------

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 1});
    take_one_vector(&rig);
    static _Alignas(64) float memory[64];
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_context *const context = rig.context;
    const rhw_pass pass = rig.recording;
    rhw_pass_set_vertex_memory(context, pass, 0, NULL, 5);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_memory: memory is NULL and size is 5");
    rhw_pass_set_vertex_memory(context, pass, RHW_MAX_VERTEX_BUFFERS, memory, 5);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_memory: slot is 16; it is in 0..15");
    rhw_pass_set_index_memory(context, pass, NULL, RHW_INDEX_UINT8, 5);
    rig_expect_misuse(&rig, "rhw_pass_set_index_memory: memory is NULL and size is 5");
    rhw_pass_set_index_memory(context, pass, memory, (enum rhw_index_type)3, 5);
    rig_expect_misuse(&rig, "rhw_pass_set_index_memory: type is 3; not an index type");
    rhw_pass_set_uniform_memory(context, pass, NULL, 5);
    rig_expect_misuse(&rig, "rhw_pass_set_uniform_memory: memory is NULL and size is 5");
    rhw_pass_draw(context, pass, 0, 1, 0, 1);
    rig_expect_misuse(&rig, "no vertex buffer is set in slot 0"); // nothing of the above was set
    rhw_pass_set_vertex_memory(context, pass, 0, NULL, 0);
    rhw_pass_draw(context, pass, 0, 1, 0, 1); // reads zeros
    const rhw_buffer buffer = make_buffer(&rig, memory, 64);
    const struct {
        struct rhw_feedback_target target;
        const char *message;
    } wrong[] = {
        {{.memory = memory, .buffer = buffer, .size = 8},
         "targets[0] has a buffer and memory; one of them must"},
        {{.memory = (char *)memory + 2, .size = 8}, "and offset 0; both must be multiples of 4"},
        {{.memory = memory, .offset = 2, .size = 8}, "and offset 2; both must be multiples of 4"},
        {{.memory = memory}, "targets[0] has size 0; it must be the bytes that memory has from offset 0 on"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        rhw_pass_begin_transform_feedback(context, pass, &wrong[i].target, 1);
        rig_expect_misuse(&rig, wrong[i].message);
    }
    rhw_pass_cancel(context, pass);
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

// A target on memory of the program's, 1024 bytes a row of which 512 are texels.
static rhw_texture make_target(struct rig *rig, void *memory, size_t size)
{
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA32_FLOAT,
                                        .width = 32,
                                        .height = 4,
                                        .row_pitch = 1024,
                                        .memory = memory,
                                        .memory_size = size};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

// Validation tells memory that the pass reads and writes, and no memory beside it.
static void test_overlaps_are_told(void **state)
{
    (void)state;
    static _Alignas(64) unsigned char memory[512 + 4096 + 64], other[256];
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 1, .validate = RHW_VALIDATE_ON});
    rhw_context *const context = rig.context;
    take_one_vector(&rig);
    rig.pass.colors[0].texture = make_target(&rig, memory, sizeof memory);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    const rhw_pass pass = rig.recording;
    const struct {
        int first, size;
        bool is_told;
    } parts[] = {{0, 1, true},
                 {511, 1, true},
                 {512, 512, false},
                 {512, 513, true},
                 {1000, 24, false},
                 {1023, 2, true},
                 {3 * 1024, 1, true},
                 {3 * 1024 + 512, 512, false},
                 {2 * 1024 + 512, 512, false},
                 {700, 2000, true},
                 {3 * 1024 + 511, 9, true}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        rhw_pass_set_vertex_memory(context, pass, 0, memory + parts[i].first, (size_t)parts[i].size);
        if (parts[i].is_told) {
            rig_expect_misuse(&rig, "share some with a colour attachment of this pass; they must lie apart");
        }
    }
    rhw_pass_set_vertex_memory(context, pass, 0, memory, SIZE_MAX); // a program that does not know the size
    rig_expect_misuse(&rig, "share some with a colour attachment of this pass; they must lie apart");
    rhw_pass_set_index_memory(context, pass, memory + 5, RHW_INDEX_UINT8, 5);
    rig_expect_misuse(&rig, "rhw_pass_set_index_memory: 5 bytes at");
    rhw_pass_set_uniform_memory(context, pass, memory + 1024, 4);
    rig_expect_misuse(&rig, "rhw_pass_set_uniform_memory: 4 bytes at");
    rhw_pass_set_vertex_memory(context, pass, 0, other, 64);
    struct rhw_feedback_target target = {.memory = other + 60, .size = 64};
    rhw_pass_begin_transform_feedback(context, pass, &target, 1);
    rig_expect_misuse(&rig, "share some with what its draws read of this pass");
    target.memory = memory + 1024;
    rhw_pass_begin_transform_feedback(context, pass, &target, 1);
    rig_expect_misuse(&rig, "share some with a colour attachment");
    target = (struct rhw_feedback_target){.memory = other + 64, .size = 96};
    rhw_pass_begin_transform_feedback(context, pass, &target, 1);
    rhw_pass_draw(context, pass, 0, 2, 0, 1); // 64 bytes
    rhw_pass_set_index_memory(context, pass, other + 159, RHW_INDEX_UINT8, 1);
    rig_expect_misuse(&rig, "share some with transform feedback of this pass");
    rhw_pass_end_transform_feedback(context, pass, NULL);
    rhw_pass_set_index_memory(context, pass, other + 128, RHW_INDEX_UINT8, 32); // which was not written
    rhw_pass_set_index_memory(context, pass, other + 127, RHW_INDEX_UINT8, 32);
    rig_expect_misuse(&rig, "share some with transform feedback of this pass");
    // Storage on the same memory.
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = 64, .memory = other, .memory_size = 64};
    assert_int_equal(rhw_buffer_create(context, &def, &buffer), RHW_OK);
    rhw_pass_set_storage_buffer(context, pass, 0, buffer, 32, 8);
    rig_expect_misuse(&rig, "rhw_pass_set_storage_buffer: 8 bytes at");
    rhw_pass_set_read_only_storage_buffer(context, pass, 0, buffer, 32, 8);
    rhw_pass_cancel(context, pass);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(context, rig.recording, 0, buffer, 32, 8);
    rhw_pass_set_storage_buffer(context, rig.recording, 1, buffer, 36, 8);
    rhw_pass_set_vertex_memory(context, rig.recording, 0, other, 33);
    rig_expect_misuse(&rig, "share some with storage that shader functions write of this pass");
    // Another target's rows stand between those of the memory, and are an image of this pass.
    const rhw_texture image = make_target(&rig, memory + 512, sizeof memory - 512);
    rhw_pass_set_storage_image(context, rig.recording, 0, image, 0);
    rhw_pass_set_vertex_memory(context, rig.recording, 0, memory + 1024 + 512, 4);
    rig_expect_misuse(&rig, "share some with storage that shader functions write of this pass");
    rhw_pass_cancel(context, rig.recording);
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

// Validation tells draws that reach outside of memory, and indices at an odd place.
static void test_draws_stay_inside(void **state)
{
    (void)state;
    struct rig rig;
    open_capture(&rig, &(struct rhw_context_def){.threads = 1, .validate = RHW_VALIDATE_ON});
    take_one_vector(&rig);
    rig.pipeline.feedback_output_count = 0;
    memset(rig.pipeline.feedback_outputs, 0, sizeof rig.pipeline.feedback_outputs);
    static _Alignas(64) const uint16_t indices[4] = {0, 1, 2, 1};
    const float data[2][4] = {{0}};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_memory(rig.context, rig.recording, 0, data, sizeof data);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    rig_expect_misuse(&rig, "it reads vertices 0 to 2; attribute 0 has 2 in memory of the program, slot 0");
    rhw_pass_set_index_memory(rig.context, rig.recording, indices, RHW_INDEX_UINT16, 6);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 3, 0, 0, 1);
    rig_expect_misuse(&rig, "it reads vertices 0 to 2");
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 4, 0, 0, 1);
    rig_expect_misuse(&rig, "first is 0 and count is 4; the index buffer has 3 indices");
    rhw_pass_set_index_memory(rig.context, rig.recording, (const char *)indices + 1, RHW_INDEX_UINT16, 2);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 1, 0, 0, 1);
    rig_expect_misuse(&rig, "its address must be a multiple of the 2 bytes of an index");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_buffers_without_padding),
    cmocka_unit_test(test_vertices),
    cmocka_unit_test(test_indices),
    cmocka_unit_test(test_triangles),
    cmocka_unit_test(test_uniforms),
    cmocka_unit_test(test_feedback_goes_on),
    cmocka_unit_test(test_misuse),
    cmocka_unit_test(test_overlaps_are_told),
    cmocka_unit_test(test_draws_stay_inside),
};

const struct unit_tests test_program_memory = UNIT_TESTS(tests, NULL, NULL);
