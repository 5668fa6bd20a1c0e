// SPDX-License-Identifier: MIT
// Buffers that are written between draws: each draw sees what was there when it was recorded, as draws of buffers of
// their own do; and a write costs memory for what the draws before it read, however large the buffer is.
#include "harness.h"

#include <string.h>

enum { SIZE = 64, QUADS = 24, STEPS = 120, INDICES = 6 * QUADS };

// What the buffer holds: quads of two triangles, then indices.
struct content {
    struct rig_vertex vertices[6 * QUADS];
    uint32_t indices[INDICES];
};

static void set_quad(struct rig *rig, struct content *content, int quad, uint64_t *random)
{
    const float x = rig_random_float(random, 0, SIZE), y = rig_random_float(random, 0, SIZE);
    float value[4];
    for (int c = 0; c < 4; c++) {
        value[c] = rig_random_float(random, 0, 1);
    }
    rig_rectangle(rig, x, y, x + 9, y + 7, 0, value, &content->vertices[(ptrdiff_t)6 * quad]);
}

static rhw_buffer make_buffer(struct rig *rig, const struct content *content)
{
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = sizeof *content, .data = content};
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

// A draw of a random part of the buffer, by an index or not.
struct draw {
    bool is_indexed, sets_range;
    uint32_t first, count;
    int32_t base;
};

static struct draw random_draw(uint64_t *random)
{
    const uint32_t first = 3 * (uint32_t)rig_random_int(random, 2 * QUADS - 4);
    return (struct draw){.is_indexed = rig_random_int(random, 2) != 0,
                         .sets_range = rig_random_int(random, 3) == 0,
                         .first = first,
                         .count = 3 * (1 + (uint32_t)rig_random_int(random, 4)),
                         .base = rig_random_int(random, 7)};
}

static void record(struct rig *rig, rhw_buffer buffer, const struct draw *draw)
{
    const size_t end = sizeof(struct rig_vertex) * 6 * QUADS;
    if (draw->sets_range) {
        rhw_pass_set_vertex_buffer_range(rig->context, rig->recording, 0, buffer, 0, end);
    } else {
        rhw_pass_set_vertex_buffer(rig->context, rig->recording, 0, buffer, 0);
    }
    if (draw->is_indexed) {
        rhw_pass_set_index_buffer(rig->context, rig->recording, buffer, RHW_INDEX_UINT32,
                                  offsetof(struct content, indices));
        rhw_pass_draw_indexed(rig->context, rig->recording, draw->first, draw->count, draw->base, 0, 1);
    } else {
        rhw_pass_draw(rig->context, rig->recording, draw->first, draw->count, 0, 1);
    }
}

// Draw and write in turns. With `own_buffers` each draw has a buffer of its own, and none is written.
static uint64_t draw_steps(struct rig *rig, bool own_buffers, uint64_t seed)
{
    struct content content;
    uint64_t random = seed;
    rhw_buffer own[STEPS];
    for (int i = 0; i < QUADS; i++) {
        set_quad(rig, &content, i, &random);
    }
    for (int i = 0; i < INDICES; i++) {
        content.indices[i] = (uint32_t)rig_random_int(&random, 6 * QUADS);
    }
    const rhw_buffer shared = make_buffer(rig, &content);
    rig_begin(rig);
    rig_use_pipeline(rig);
    for (int i = 0; i < STEPS; i++) {
        const int draws = rig_random_int(&random, 3);
        own[i] = make_buffer(rig, &content);
        for (int d = 0; d < draws; d++) {
            const struct draw draw = random_draw(&random);
            record(rig, own_buffers ? own[i] : shared, &draw);
        }
        const int quad = rig_random_int(&random, QUADS), index = rig_random_int(&random, INDICES);
        set_quad(rig, &content, quad, &random);
        content.indices[index] = (uint32_t)rig_random_int(&random, 6 * QUADS);
        const size_t at = sizeof(struct rig_vertex) * 6 * (size_t)quad;
        if (!own_buffers) {
            assert_int_equal(rhw_buffer_write(rig->context, shared, at, (unsigned char *)&content + at,
                                              6 * sizeof(struct rig_vertex)),
                             RHW_OK);
            assert_int_equal(rhw_buffer_write(rig->context, shared,
                                              offsetof(struct content, indices) + 4 * (size_t)index,
                                              &content.indices[index], 4),
                             RHW_OK);
        }
    }
    rig_end(rig);
    struct content held;
    assert_int_equal(rhw_buffer_read(rig->context, shared, 0, &held, sizeof held), RHW_OK);
    assert_int_equal(memcmp(&held, &content, sizeof held) == 0, !own_buffers);
    for (int i = 0; i < STEPS; i++) {
        rhw_buffer_destroy(rig->context, own[i]);
    }
    rhw_buffer_destroy(rig->context, shared);
    return rig_hash(rig, 0);
}

static void test_draws_see_what_was_there(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    for (uint64_t seed = 1; seed < 9; seed++) {
        assert_int_equal(draw_steps(&rig, false, seed), draw_steps(&rig, true, seed));
    }
    rig_close(&rig);
}

// Primitives that name their viewport have a state for each.
static void write_viewport(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].viewport_index = groups[g].instance_index & 1;
    }
}

static uint64_t draw_routed(struct rig *rig, bool writes)
{
    struct rig_vertex vertices[2][6];
    const float values[2][4] = {{1, 0.5f, 0, 1}, {0, 0.5f, 1, 1}};
    const struct rhw_viewport viewports[2] = {{0, 0, 32, 64, 0, 1}, {32, 0, 32, 64, 0, 1}};
    rhw_buffer buffers[2];
    for (int i = 0; i < 2; i++) {
        rig_rectangle(rig, 4, (float)(8 + 20 * i), 50, (float)(20 + 20 * i), 0, values[i], vertices[i]);
        const struct rhw_buffer_def def = {.size = sizeof vertices[0], .data = vertices[i]};
        assert_int_equal(rhw_buffer_create(rig->context, &def, &buffers[i]), RHW_OK);
    }
    rig_begin(rig);
    rig_use_pipeline(rig);
    rhw_pass_set_viewports(rig->context, rig->recording, 0, 2, viewports);
    for (int i = 0; i < 2; i++) {
        rhw_pass_set_vertex_buffer(rig->context, rig->recording, 0, buffers[writes ? 0 : i], 0);
        rhw_pass_draw(rig->context, rig->recording, 0, 6, 0, 2);
        if (writes) {
            assert_int_equal(rhw_buffer_write(rig->context, buffers[0], 0, vertices[1], sizeof vertices[1]),
                             RHW_OK);
        }
    }
    rig_end(rig);
    rhw_buffer_destroy(rig->context, buffers[0]);
    rhw_buffer_destroy(rig->context, buffers[1]);
    return rig_hash(rig, 0);
}

static void test_other_viewports(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_program(&rig, write_viewport, rig_fragment_pass);
    rig.pipeline.program.writes_viewport_index = true;
    assert_int_equal(draw_routed(&rig, true), draw_routed(&rig, false));
    rig_close(&rig);
}

// A hundred writes of 144 bytes into 32 MiB in use.
static void test_memory_is_in_proportion(void **state)
{
    (void)state;
    enum { LARGE = 32 << 20, WRITES = 100 };
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = LARGE};
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    for (int i = 0; i < WRITES; i++) {
        struct rig_vertex vertices[6];
        const float value[4] = {(float)(i + 1) / WRITES, 0, 0, 1};
        rig_rectangle(&rig, (float)(i % 10) * 6, (float)(i / 10) * 6, (float)(i % 10) * 6 + 6,
                      (float)(i / 10) * 6 + 6, 0, value, vertices);
        assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, vertices, sizeof vertices), RHW_OK);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    }
    rig_end(&rig);
    assert_true(rig.stats.memory_peak < LARGE + (8 << 20));
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < WRITES; i++) {
        assert_true(pixels[(i / 10 * 6 + 3) * SIZE + i % 10 * 6 + 3][0] == (float)(i + 1) / WRITES);
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_draws_see_what_was_there),
    cmocka_unit_test(test_other_viewports),
    cmocka_unit_test(test_memory_is_in_proportion),
};

const struct unit_tests test_kept_reads = UNIT_TESTS(tests, NULL, NULL);
