// SPDX-License-Identifier: MIT
// Draws whose vertices are shaded before their chunks: meshes whose triangles lie in no order. A buffer with more
// vertices than chunks may share makes a twin without: the picture must be the same.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum {
    SIZE = 130,
    CELLS = 48, // along each side of the mesh
    POINTS = (CELLS + 1) * (CELLS + 1),
    TRIANGLES = 2 * CELLS * CELLS,
    INDICES = 3 * TRIANGLES,
    TOO_MANY = 2 * TRIANGLES // vertices to be shared
};

struct mesh {
    struct rig_vertex vertices[TOO_MANY];
    uint32_t indices[INDICES];
};

// How a mesh is drawn.
struct way {
    int draws;
    uint32_t points; // in the buffer
    int32_t base_vertex;
    uint32_t instances;
    bool shorts; // 16-bit indices
};

static const struct way once = {1, POINTS, 0, 1, false};

// Bumps over the target, each vertex with a colour of its own, triangles shuffled; behind them vertices that no index
// names.
static struct mesh *make_mesh(const struct rig *rig)
{
    struct mesh *const mesh = calloc(1, sizeof *mesh);
    uint64_t random = 1;
    assert_non_null(mesh);
    for (int i = 0; i < POINTS; i++) {
        const float x = (float)(i % (CELLS + 1)) * SIZE / CELLS, y = (float)(i / (CELLS + 1)) * SIZE / CELLS;
        rig_place(rig, x + rig_random_float(&random, -4, 4), y + rig_random_float(&random, -4, 4),
                  rig_random_float(&random, 0.2f, 0.8f), rig_random_float(&random, 0.5f, 3),
                  mesh->vertices[i].position);
        for (int k = 0; k < 4; k++) {
            mesh->vertices[i].value[k] = rig_random_float(&random, 0, 1);
        }
    }
    for (uint32_t i = 0; i < CELLS * CELLS; i++) {
        const uint32_t a = i / CELLS * (CELLS + 1) + i % CELLS, c = a + CELLS + 1;
        const uint32_t corners[6] = {a, a + 1, c, c, a + 1, c + 1};
        memcpy(&mesh->indices[6 * i], corners, sizeof corners);
    }
    for (int i = TRIANGLES - 1; i > 0; i--) {
        uint32_t *const one = &mesh->indices[3 * i], *const other =
                                                         &mesh->indices[3 * rig_random_int(&random, i + 1)];
        uint32_t kept[3];
        memcpy(kept, one, sizeof kept);
        memmove(one, other, sizeof kept);
        memcpy(other, kept, sizeof kept);
    }
    return mesh;
}

static void open_mesh(struct rig *rig, int threads, size_t bin_memory)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.bin_memory = bin_memory;
    rig_open_with(rig, SIZE, SIZE, &def);
    rig_set_depth(rig);
}

// The hash of the picture; whether vertices were shaded once tell the rig's statistics.
static uint64_t draw_mesh(struct rig *rig, const struct mesh *mesh, struct way way)
{
    static uint16_t shorts[INDICES];
    for (int i = 0; i < INDICES; i++) {
        shorts[i] = (uint16_t)mesh->indices[i];
    }
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, mesh->vertices, way.points * sizeof mesh->vertices[0]);
    if (way.shorts) {
        rig_use_indices(rig, RHW_INDEX_UINT16, shorts, sizeof shorts);
    } else {
        rig_use_indices(rig, RHW_INDEX_UINT32, mesh->indices, sizeof mesh->indices);
    }
    for (int i = 0; i < way.draws; i++) {
        rhw_pass_draw_indexed(rig->context, rig->recording, 0, INDICES, way.base_vertex, 5, way.instances);
    }
    rig_end(rig);
    return rig_hash(rig, 0);
}

static uint64_t draw_twin(struct rig *rig, const struct mesh *mesh, struct way way)
{
    way.points = TOO_MANY;
    return draw_mesh(rig, mesh, way);
}

static void assert_as_twin(struct rig *rig, const struct mesh *mesh, struct way way)
{
    const uint64_t twin = draw_twin(rig, mesh, way);
    assert_true(draw_mesh(rig, mesh, way) == twin);
}

static void test_vertices_are_shaded_once(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 4; threads++) {
        struct rig rig;
        open_mesh(&rig, threads, 0);
        struct mesh *const mesh = make_mesh(&rig);
        const uint64_t twin = draw_twin(&rig, mesh, once);
        assert_true(rig.stats.vertices_shaded > 3 * POINTS);
        assert_true(draw_mesh(&rig, mesh, once) == twin);
        assert_int_equal(rig.stats.vertices_shaded, POINTS);
        struct way twice = once;
        twice.draws = 2;
        assert_true(draw_mesh(&rig, mesh, twice) == twin);
        if (threads > 1) { // with one thread a draw is two chunks, and shares nothing
            assert_int_equal(rig.stats.vertices_shaded, 2 * POINTS);
        }
        free(mesh);
        rig_close(&rig);
    }
}

// Colours that tell the vertex and the instance, and instances apart from each other.
static void number_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float instance = rhw_float_from_int(groups[g].instance_index);
        for (int i = 0; i < 4; i++) {
            groups[g].position[i] = groups[g].attribute[0][i];
            groups[g].varying[i] = rhw_float_from_int(groups[g].vertex_index * (i + 1)) + instance;
        }
        groups[g].position[0] = groups[g].position[0] * (instance * 0.05f);
    }
}

static void test_instances_and_index_types(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 4, 0);
    rig_set_program(&rig, number_vertex, rig_fragment_pass);
    struct mesh *const mesh = make_mesh(&rig);
    for (uint32_t n = 0; n < 8; n++) {
        struct way way = once;
        way.instances = n / 2;
        way.shorts = n % 2;
        assert_as_twin(&rig, mesh, way);
        assert_int_equal(rig.stats.vertices_shaded, way.instances * POINTS);
    }
    free(mesh);
    rig_close(&rig);
}

static void test_base_vertex(void **state)
{
    (void)state;
    enum { BASE = 13 };
    struct rig rig;
    open_mesh(&rig, 2, 0);
    struct mesh *const mesh = make_mesh(&rig);
    const uint64_t plain = draw_mesh(&rig, mesh, once);
    memmove(mesh->vertices + BASE, mesh->vertices, POINTS * sizeof mesh->vertices[0]);
    struct way way = once;
    way.points = POINTS + BASE;
    way.base_vertex = BASE;
    assert_true(draw_mesh(&rig, mesh, way) == plain);
    assert_int_equal(rig.stats.vertices_shaded, POINTS);
    // Indices that are larger, with a base below 0, name the same vertices; chunks shade them themselves.
    for (int i = 0; i < INDICES; i++) {
        mesh->indices[i] += 2 * BASE;
    }
    way.base_vertex = -BASE;
    assert_true(draw_mesh(&rig, mesh, way) == plain);
    free(mesh);
    rig_close(&rig);
}

// Indices behind the end of the buffer name vertices of zeros: only chunks without them share the others.
static void test_indices_past_the_end(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 2, 0);
    rig_set_program(&rig, number_vertex, rig_fragment_pass);
    struct mesh *const mesh = make_mesh(&rig);
    mesh->indices[5] = POINTS;
    mesh->indices[INDICES - 1] = UINT32_MAX;
    memset(mesh->vertices + POINTS, 0, (TOO_MANY - POINTS) * sizeof mesh->vertices[0]);
    assert_as_twin(&rig, mesh, once);
    assert_true(rig.stats.vertices_shaded > POINTS && rig.stats.vertices_shaded < 3 * POINTS);
    free(mesh);
    rig_close(&rig);
}

// Strips and fans in no order, with primitive restart and without.
static void test_strips_and_fans(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 2, 0);
    struct mesh *const mesh = make_mesh(&rig);
    for (int n = 0; n < 4; n++) {
        rig.pipeline.topology = n & 1 ? RHW_TRIANGLE_STRIP : RHW_TRIANGLE_FAN;
        rig.pipeline.primitive_restart = n & 2;
        for (int i = 40; i < INDICES && n & 2; i += 41) {
            mesh->indices[i] = UINT32_MAX;
        }
        assert_as_twin(&rig, mesh, once);
        assert_int_equal(rig.stats.vertices_shaded, POINTS);
    }
    free(mesh);
    rig_close(&rig);
}

// What attributes say of the number of vertices: not those with a stride of 0, nor those per instance.
static void test_other_attributes(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 2, 0);
    struct mesh *const mesh = make_mesh(&rig);
    const float one[8][4] = {{0.5f, 0.25f, 1, 1}};
    for (int per_instance = 0; per_instance < 2; per_instance++) {
        uint64_t hash[2];
        rig.pipeline.buffers[1] = (struct rhw_vertex_layout){
            .stride = per_instance ? 16 : 0, .per_instance = per_instance, .constant = !per_instance};
        rig.pipeline.buffer_count = 2;
        rig.pipeline.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 1, 0};
        for (int twin = 0; twin < 2; twin++) {
            rig_begin(&rig);
            rig_use_pipeline(&rig);
            rig_use_vertices(&rig, 0, mesh->vertices, (twin ? TOO_MANY : POINTS) * sizeof mesh->vertices[0]);
            rig_use_vertices(&rig, 1, one, sizeof one);
            rig_use_indices(&rig, RHW_INDEX_UINT32, mesh->indices, sizeof mesh->indices);
            rhw_pass_draw_indexed(rig.context, rig.recording, 0, INDICES, 0, 0, 1);
            rig_end(&rig);
            hash[twin] = rig_hash(&rig, 0);
            assert_true((rig.stats.vertices_shaded == POINTS) == !twin);
        }
        assert_true(hash[0] == hash[1]);
    }
    free(mesh);
    rig_close(&rig);
}

// A wave shares vertices of as many draws as fit.
static void test_waves(void **state)
{
    (void)state;
    enum { THREADS = 8 };                                   // so that chunks are small
    const size_t bytes = POINTS * (16 + 4) * sizeof(float); // of records with 4 varyings, and corners
    struct rig rig;
    open_mesh(&rig, THREADS, 0);
    struct mesh *const mesh = make_mesh(&rig);
    struct way way = once;
    way.draws = 12;
    const uint64_t whole = draw_mesh(&rig, mesh, way);
    assert_int_equal(rig.stats.vertices_shaded, 12 * POINTS);
    rig_close(&rig);
    open_mesh(&rig, THREADS, 9 * bytes); // of two draws
    assert_true(draw_twin(&rig, mesh, way) == whole);
    const uint64_t without = rig.stats.vertices_shaded;
    assert_true(draw_mesh(&rig, mesh, way) == whole);
    assert_true(rig.stats.flushes > 0 && rig.stats.geometry_peak > bytes);
    assert_true(rig.stats.vertices_shaded > 12 * POINTS && rig.stats.vertices_shaded < without);
    free(mesh);
    rig_close(&rig);
}

// What grows from pass to pass leaves nothing behind.
static void test_memory_of_growing_draws(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 2, 0);
    struct mesh *const mesh = make_mesh(&rig);
    uint64_t first = 0;
    for (uint32_t points = POINTS; points < 3 * TRIANGLES / 2; points += 100) {
        struct way way = once;
        way.points = points;
        draw_mesh(&rig, mesh, way);
        assert_int_equal(rig.stats.vertices_shaded, points);
        first = first ? first : rig.stats.memory_peak;
    }
    assert_true(rig.stats.memory_peak < 2 * first); // the sum of all is 14 MB
    free(mesh);
    rig_close(&rig);
}

// Memory that a test gives, until `left` is 0.
static int left;

static void *give_some(void *user, size_t size, size_t alignment)
{
    (void)user;
    return left-- > 0 ? aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment) : NULL;
}

static void take_back(void *user, void *memory, size_t size)
{
    (void)user;
    (void)size;
    free(memory);
}

// Whether a pass that shares vertices was drawn in `context`. When it was not, some allocation had failed.
static bool draw_with_some_memory(rhw_context *context, const struct rhw_pipeline_def *pipeline_def,
                                  const struct mesh *mesh)
{
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    struct rhw_texture_def texture = rhw_texture_def_default();
    const struct rhw_buffer_def vertex_def = {.size = POINTS * sizeof mesh->vertices[0],
                                              .data = mesh->vertices},
                                index_def = {.size = sizeof mesh->indices, .data = mesh->indices};
    texture.width = texture.height = SIZE;
    texture.format = RHW_FORMAT_RGBA32_FLOAT;
    pass_def.color_count = 1;
    pass_def.depth = (struct rhw_depth_attachment){.enabled = true, .clear = 1, .store = RHW_STORE_DISCARD};
    rhw_buffer vertices, indices;
    rhw_pipeline pipeline;
    rhw_pass pass;
    if (rhw_texture_create(context, &texture, &pass_def.colors[0].texture) != RHW_OK ||
        rhw_buffer_create(context, &vertex_def, &vertices) != RHW_OK ||
        rhw_buffer_create(context, &index_def, &indices) != RHW_OK ||
        rhw_pipeline_create(context, pipeline_def, &pipeline) != RHW_OK ||
        rhw_pass_begin(context, &pass_def, &pass) != RHW_OK) {
        return false;
    }
    struct rhw_stats stats;
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    rhw_pass_set_index_buffer(context, pass, indices, RHW_INDEX_UINT32, 0);
    rhw_pass_draw_indexed(context, pass, 0, INDICES, 0, 0, 1);
    const bool drawn = rhw_pass_end(context, pass, &stats) == RHW_OK;
    assert_true(drawn == (left >= 0));
    assert_true(!drawn || stats.vertices_shaded == POINTS);
    return drawn;
}

// Whatever allocation fails, the pass says so.
static void test_memory_runs_out(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 1, 0);
    struct mesh *const mesh = make_mesh(&rig);
    const struct rhw_pipeline_def pipeline_def = rig.pipeline;
    rig_close(&rig);
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.allocator = (struct rhw_allocator){give_some, take_back, NULL};
    bool drawn = false;
    for (int most = 0; !drawn; most++) {
        left = most;
        rhw_context *context;
        if (rhw_context_create(&def, &context) == RHW_OK) {
            drawn = draw_with_some_memory(context, &pipeline_def, mesh);
            rhw_context_destroy(context);
        }
    }
    free(mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_vertices_are_shaded_once),
    cmocka_unit_test(test_instances_and_index_types),
    cmocka_unit_test(test_base_vertex),
    cmocka_unit_test(test_indices_past_the_end),
    cmocka_unit_test(test_strips_and_fans),
    cmocka_unit_test(test_other_attributes),
    cmocka_unit_test(test_waves),
    cmocka_unit_test(test_memory_of_growing_draws),
    cmocka_unit_test(test_memory_runs_out),
};

const struct unit_tests test_shared_vertices = UNIT_TESTS(tests, NULL, NULL);
