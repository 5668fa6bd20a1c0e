// SPDX-License-Identifier: MIT
// Draws whose vertices are shaded before their chunks: those of a mesh whose triangles lie in no order. Drawn as many
// small draws, which have no mesh, they must give the same picture.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum {
    SIZE = 130,
    CELLS = 48, // along each side of the mesh
    POINTS = (CELLS + 1) * (CELLS + 1),
    TRIANGLES = 2 * CELLS * CELLS,
    PART = TRIANGLES / 4 // of a mesh that is drawn by parts: too few for one
};

struct mesh {
    struct rig_vertex vertices[POINTS];
    uint32_t indices[TRIANGLES][3];
};

// Bumps over the target, each vertex with a colour of its own, triangles shuffled.
static struct mesh *make_mesh(const struct rig *rig)
{
    struct mesh *const mesh = malloc(sizeof *mesh);
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
        memcpy(mesh->indices[2 * i], (uint32_t[3]){a, a + 1, c}, sizeof mesh->indices[0]);
        memcpy(mesh->indices[2 * i + 1], (uint32_t[3]){c, a + 1, c + 1}, sizeof mesh->indices[0]);
    }
    for (int i = TRIANGLES - 1; i > 0; i--) {
        const int k = rig_random_int(&random, i + 1);
        uint32_t other[3];
        memcpy(other, mesh->indices[k], sizeof other);
        memcpy(mesh->indices[k], mesh->indices[i], sizeof other);
        memcpy(mesh->indices[i], other, sizeof other);
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

static void add_to_indices(struct mesh *mesh, uint32_t value)
{
    for (int i = 0; i < TRIANGLES; i++) {
        for (int k = 0; k < 3; k++) {
            mesh->indices[i][k] += value;
        }
    }
}

// The hash of `draws` times the mesh, each in `parts` draws. `base_vertex` is taken off the indices first.
static uint64_t draw_mesh(struct rig *rig, struct mesh *mesh, int draws, int parts, int32_t base_vertex)
{
    add_to_indices(mesh, (uint32_t)-base_vertex);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, mesh->vertices, sizeof mesh->vertices);
    rig_use_indices(rig, RHW_INDEX_UINT32, mesh->indices, sizeof mesh->indices);
    for (int i = 0; i < draws * parts; i++) {
        const uint32_t count = 3 * TRIANGLES / (uint32_t)parts;
        rhw_pass_draw_indexed(rig->context, rig->recording, (uint32_t)(i % parts) * count, count, base_vertex,
                              0, 1);
    }
    rig_end(rig);
    add_to_indices(mesh, (uint32_t)base_vertex);
    return rig_hash(rig, 0);
}

static void test_vertices_are_shaded_once(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 3; threads++) {
        struct rig rig;
        open_mesh(&rig, threads, 0);
        struct mesh *const mesh = make_mesh(&rig);
        const uint64_t parts = draw_mesh(&rig, mesh, 1, TRIANGLES / PART, 0);
        assert_true(rig.stats.vertices_shaded > POINTS * 3 / 2);
        assert_true(draw_mesh(&rig, mesh, 1, 1, 0) == parts);
        assert_int_equal(rig.stats.vertices_shaded, POINTS);
        assert_true(draw_mesh(&rig, mesh, 2, 1, 0) == parts);
        if (threads > 1) { // one thread has two chunks a draw, and so no mesh
            assert_int_equal(rig.stats.vertices_shaded, 2 * POINTS);
        }
        free(mesh);
        rig_close(&rig);
    }
}

// Fragments of the value 1 where vertex numbers are those that the shader should see.
static void number_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < 4; i++) {
            groups[g].position[i] = groups[g].attribute[0][i];
            groups[g].varying[i] = rhw_to_float(groups[g].vertex_index * (i + 1) + groups[g].instance_index);
        }
    }
}

static void test_base_vertex_and_numbers(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 2, 0);
    rig_set_program(&rig, number_vertex, rig_fragment_pass);
    struct mesh *const mesh = make_mesh(&rig);
    const uint64_t parts = draw_mesh(&rig, mesh, 1, TRIANGLES / PART, 0);
    assert_true(draw_mesh(&rig, mesh, 1, 1, 0) == parts);
    assert_int_equal(rig.stats.vertices_shaded, POINTS);
    // Index 0 names vertex −7 then, and 4294967295 vertex 0: those that do are not taken from a mesh.
    assert_true(draw_mesh(&rig, mesh, 1, 1, 7) == parts);
    assert_true(draw_mesh(&rig, mesh, 1, 1, -7) == parts);
    free(mesh);
    rig_close(&rig);
}

// Indices behind the end of the buffer name vertices of zeros: only chunks without them take the mesh.
static void test_indices_past_the_end(void **state)
{
    (void)state;
    struct rig rig;
    open_mesh(&rig, 2, 0);
    struct mesh *const mesh = make_mesh(&rig);
    mesh->indices[5][1] = POINTS;
    mesh->indices[TRIANGLES - 1][2] = UINT32_MAX;
    const uint64_t parts = draw_mesh(&rig, mesh, 1, TRIANGLES / PART, 0);
    assert_true(draw_mesh(&rig, mesh, 1, 1, 0) == parts);
    assert_true(rig.stats.vertices_shaded > POINTS);
    free(mesh);
    rig_close(&rig);
}

// A wave has meshes of its own, as many as fit.
static void test_waves_of_meshes(void **state)
{
    (void)state;
    struct rig rig;
    enum { THREADS = 8 }; // so that chunks are small
    open_mesh(&rig, THREADS, 0);
    struct mesh *const mesh = make_mesh(&rig);
    const uint64_t whole = draw_mesh(&rig, mesh, 12, 1, 0);
    assert_int_equal(rig.stats.vertices_shaded, 12 * POINTS);
    rig_close(&rig);
    const size_t bytes = POINTS * (16 + 4) * sizeof(float); // of records with 4 varyings, and corners
    open_mesh(&rig, THREADS, 12 * bytes);
    assert_true(draw_mesh(&rig, mesh, 12, 1, 0) == whole);
    assert_true(rig.stats.flushes > 0 && rig.stats.geometry_peak > bytes);
    assert_true(rig.stats.vertices_shaded > 12 * POINTS && rig.stats.vertices_shaded < 50 * POINTS);
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
        if (rhw_context_create(&def, &context) != RHW_OK) {
            continue;
        }
        struct rhw_pass_def pass_def = rhw_pass_def_default();
        struct rhw_texture_def texture = rhw_texture_def_default();
        texture.width = texture.height = SIZE;
        texture.format = RHW_FORMAT_RGBA32_FLOAT;
        pass_def.color_count = 1;
        pass_def.depth =
            (struct rhw_depth_attachment){.enabled = true, .clear = 1, .store = RHW_STORE_DISCARD};
        rhw_buffer vertices, indices;
        rhw_pipeline pipeline;
        rhw_pass pass;
        const struct rhw_buffer_def vertex_def = {sizeof mesh->vertices, mesh->vertices},
                                    index_def = {sizeof mesh->indices, mesh->indices};
        if (rhw_texture_create(context, &texture, &pass_def.colors[0].texture) == RHW_OK &&
            rhw_buffer_create(context, &vertex_def, &vertices) == RHW_OK &&
            rhw_buffer_create(context, &index_def, &indices) == RHW_OK &&
            rhw_pipeline_create(context, &pipeline_def, &pipeline) == RHW_OK &&
            rhw_pass_begin(context, &pass_def, &pass) == RHW_OK) {
            struct rhw_stats stats;
            rhw_pass_set_pipeline(context, pass, pipeline);
            rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
            rhw_pass_set_index_buffer(context, pass, indices, RHW_INDEX_UINT32, 0);
            rhw_pass_draw_indexed(context, pass, 0, 3 * TRIANGLES, 0, 0, 1);
            drawn = rhw_pass_end(context, pass, &stats) == RHW_OK;
            assert_true(drawn == (left >= 0));
            assert_true(!drawn || stats.vertices_shaded == POINTS);
        }
        rhw_context_destroy(context);
    }
    free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vertices_are_shaded_once), cmocka_unit_test(test_base_vertex_and_numbers),
        cmocka_unit_test(test_indices_past_the_end),     cmocka_unit_test(test_waves_of_meshes),
        cmocka_unit_test(test_memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
