// SPDX-License-Identifier: MIT
// Passes larger than the bin memory: drawn in waves, in bounded memory, with the picture and the counts of one wave;
// also where the bins of a single chunk are too large and it is cut.
#include "harness.h"

#include <string.h>

enum { SIZE = 320, TRIANGLES = 300, INSTANCES = 3, DRAWS = 2 };

// Order shows: what a pixel gets depends on every blend before it.
static void fill(struct rig *rig, struct rig_vertex *vertices, float most)
{
    uint64_t random = 11;
    for (int t = 0; t < TRIANGLES; t++) {
        const float size = t % 3 == 0 ? 2 * (float)SIZE : rig_random_float(&random, 1, most);
        const float x = rig_random_float(&random, 0, SIZE), y = rig_random_float(&random, 0, SIZE);
        for (int i = 0; i < 3; i++) {
            struct rig_vertex *const v = &vertices[3 * t + i];
            const float dx = rig_random_float(&random, -size, size),
                        dy = rig_random_float(&random, -size, size);
            // Some are cut by the near plane, and some have no place in the view at all.
            rig_place(rig, x + dx, y + dy, rig_random_float(&random, -0.05f, 0.9f), 1, v->position);
            for (int c = 0; c < 4; c++) {
                v->value[c] = rig_random_float(&random, 0.1f, 0.9f);
            }
        }
    }
}

static void draw(struct rig *rig, const struct rig_vertex *vertices)
{
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, (size_t)(3 * TRIANGLES) * sizeof *vertices);
    for (int n = 0; n < DRAWS; n++) {
        rhw_pass_draw(rig->context, rig->recording, 0, 3 * TRIANGLES, 0, INSTANCES);
    }
    rig_end(rig);
}

static void open_scene(struct rig *rig, int threads, size_t bin_memory)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.bin_memory = bin_memory;
    rig_open_with(rig, SIZE, SIZE, &def);
    rig->pipeline.targets[0].blend = true;
    rig->pipeline.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    rig->pipeline.cull = RHW_CULL_BACK;
    rig->pipeline.depth_test = true;
    rig->pipeline.depth_compare = RHW_COMPARE_LESS_EQUAL;
    // Depth without a texture: it must outlive a wave all the same.
    rig->pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD, .clear = 1};
}

static void expect_same_counts(const struct rhw_stats *a, const struct rhw_stats *b)
{
    assert_int_equal(a->triangles_in, b->triangles_in);
    assert_int_equal(a->triangles_clipped, b->triangles_clipped);
    assert_int_equal(a->triangles_culled, b->triangles_culled);
    assert_int_equal(a->triangles_rasterized, b->triangles_rasterized);
    assert_int_equal(a->bin_entries, b->bin_entries);
    assert_int_equal(a->fragments_shaded, b->fragments_shaded);
}

static void test_waves_do_not_show(void **state)
{
    (void)state;
    static struct rig_vertex vertices[3 * TRIANGLES];
    struct rig whole;
    open_scene(&whole, 1, (size_t)1 << 30);
    fill(&whole, vertices, 60);
    draw(&whole, vertices);
    const uint64_t hash = rig_hash(&whole, 0);
    assert_int_equal(whole.stats.flushes, 0);
    assert_int_equal(whole.stats.triangles_in, TRIANGLES * INSTANCES * DRAWS);
    const struct rhw_stats expected = whole.stats;
    rig_close(&whole);

    const size_t limits[] = {1, 1 << 11, 1 << 14, 1 << 17, 1 << 20};
    const int threads[] = {1, 2, 5};
    for (int i = 0; i < 5; i++) {
        for (int t = 0; t < 3; t++) {
            struct rig rig;
            open_scene(&rig, threads[t], limits[i]);
            draw(&rig, vertices);
            assert_true(rig_hash(&rig, 0) == hash);
            expect_same_counts(&rig.stats, &expected);
            rig_close(&rig);
        }
    }
}

// Every triangle is half of the target, to one side of its diagonal: of 5×5 tiles it has 1 + 2 + 3 + 4 + 5, 2 bytes an
// entry. Chunks of at least 128 triangles are cut to what a quarter of the memory holds, and geometry stays below the
// memory, that quarter, and the last chunks' triangles.
static void test_bins_of_a_chunk_are_bounded(void **state)
{
    (void)state;
    enum { COUNT = 1000, TILES = 15, LIMIT = 16384, THREADS = 2, CHUNK = 128 };
    static struct rig_vertex vertices[3 * COUNT];
    struct rig rig;
    open_scene(&rig, THREADS, LIMIT);
    rig.pipeline.cull = RHW_CULL_NONE;
    const float value[4] = {0.5f, 0.25f, 0.125f, 0.5f};
    for (int t = 0; t < COUNT; t++) {
        rig_cover(&rig, 0.5f, value, &vertices[3 * t < 3 * COUNT - 6 ? 3 * t : 3 * COUNT - 6]);
    }
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    rhw_pass_draw(rig.context, rig.recording, 0, 3 * COUNT, 0, 1);
    rig_end(&rig);
    assert_int_equal(rig.stats.bin_entries, COUNT * TILES);
    const size_t in_chunk = LIMIT / (4 * THREADS * 2 * TILES);
    const size_t chunks = (COUNT + in_chunk - 1) / in_chunk;
    assert_int_equal(rig.stats.flushes + 1, chunks); // the first chunk is cut, which ends the wave
    const size_t triangles = THREADS * 2 * CHUNK * (64 + 3 * 64 + 16); // a chunk that is cut is made twice
    assert_true(rig.stats.geometry_peak <= LIMIT + LIMIT / 4 + triangles + THREADS * 4096);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_waves_do_not_show),
    cmocka_unit_test(test_bins_of_a_chunk_are_bounded),
};

const struct unit_tests test_waves = UNIT_TESTS(tests, NULL, NULL);
