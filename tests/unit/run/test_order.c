// SPDX-License-Identifier: MIT
// Draws that use what atomics return: they run in one order, whatever the context.
#include "harness.h"

// A draw whose fragments and vertices take numbers.
static void number_vertices(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const rhw_int turn =
            rhw_storage_atomic(v->bindings, 0, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1), v->mask);
        for (int c = 0; c < 4; c++) {
            v->position[c] = v->attribute[0][c];
            v->varying[c] = rhw_float_from_int(turn);
        }
    }
}

static void number_fragments(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int turn =
            rhw_storage_atomic(f->bindings, 0, RHW_STORAGE_ADD, rhw_splat_int(1), rhw_splat_int(1), f->mask);
        f->color[0][0] = rhw_float_from_int(turn);
        for (int c = 1; c < 4; c++) {
            f->color[0][c] = f->varying[c];
        }
    }
}

// Return the hash of a picture of numbers that many triangles, small and large, took from atomics.
static uint64_t hash_of_numbers(struct rhw_context_def context)
{
    enum { WIDTH = 300, HEIGHT = 200, TRIANGLES = 3000 };
    static struct rig_vertex vertices[3 * TRIANGLES];
    struct rig rig;
    uint64_t random = 5;
    rig_open_with(&rig, WIDTH, HEIGHT, &context);
    for (int i = 0; i < TRIANGLES; i++) {
        const float x = rig_random_float(&random, 0, WIDTH), y = rig_random_float(&random, 0, HEIGHT),
                    reach = i % 50 == 0 ? 150 : 6;
        for (int corner = 0; corner < 3; corner++) {
            rig_place(&rig, x + rig_random_float(&random, -reach, reach),
                      y + rig_random_float(&random, -reach, reach), 0.5f, 1,
                      vertices[3 * i + corner].position);
        }
    }
    rig_set_program(&rig, number_vertices, number_fragments);
    rig.pipeline.program.uses = RHW_USE_EFFECTS;
    rig.pipeline.program.vertex_effects = true;
    rig.pipeline.program.uses_atomic_results = true;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &(struct rhw_buffer_def){.size = 8}, &buffer), RHW_OK);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 0);
    rig_draw(&rig, vertices, 3 * TRIANGLES);
    rig_end(&rig);
    assert_int_equal(rig.stats.threads, 1);
    int32_t taken[2];
    assert_int_equal(rhw_buffer_read(rig.context, buffer, 0, taken, sizeof taken), RHW_OK);
    assert_true(taken[0] > 0 && taken[1] > 0); // vertices and fragments took numbers
    const uint64_t hash = rig_hash(&rig, 0);
    rig_close(&rig);
    return hash;
}

static void test_results_of_atomics(void **state)
{
    (void)state;
    const uint64_t hash =
        hash_of_numbers((struct rhw_context_def){.threads = 1, .validate = RHW_VALIDATE_OFF});
    const struct rhw_context_def contexts[] = {
        {.threads = 1, .isa_limit = RHW_ISA_UP_TO_BASELINE, .validate = RHW_VALIDATE_OFF},
        {.threads = 4, .isa_limit = RHW_ISA_UP_TO_AVX512, .validate = RHW_VALIDATE_OFF},
        {.threads = 2, .paths = RHW_PATHS_GENERAL},
        {.threads = 2, .paths = RHW_PATHS_IN_ORDER},
        {.threads = 2, .validate = RHW_VALIDATE_ON},
        {.threads = 4, .bin_memory = 1 << 14},
    };
    for (size_t i = 0; i < sizeof contexts / sizeof contexts[0]; i++) {
        assert_int_equal(hash_of_numbers(contexts[i]), hash);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_results_of_atomics),
};

const struct unit_tests test_order = UNIT_TESTS(tests, NULL, NULL);
