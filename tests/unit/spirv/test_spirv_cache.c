// SPDX-License-Identifier: MIT
// Caches of shaders and programs: what is the same and what is not, the bound, and threads that ask at the same time.

// The library's own functions, which threads may call: those that harness/emitted.h puts in their places keep a list.
#undef rhw_shader_create
#undef rhw_shader_program_create
#undef rhw_shader_program_get
#undef rhw_shader_program_get_compute
#include <pthread.h>
#include <stdlib.h>

#include "double_comp.h"
#include "plain_frag.h"
#include "plain_vert.h"
#include "spirv_run.h"

static rhw_shader_cache *open_cache(size_t bound)
{
    rhw_shader_cache *cache;
    assert_int_equal(rhw_shader_cache_create(bound, &cache), RHW_OK);
    assert_int_equal(rhw_shader_cache_get_size(cache), 0);
    return cache;
}

static rhw_shader *create(const uint32_t *words, size_t size, const struct rhw_shader_def *def)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(words, size, def, &shader, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    return shader;
}

// Return the shader that doubles, with another factor.
static rhw_shader *create_factor(rhw_shader_cache *cache, uint32_t factor)
{
    const struct rhw_shader_constant constant = {.id = 3, .value = factor};
    return create(
        double_comp, sizeof double_comp,
        &(struct rhw_shader_def){
            .stage = RHW_SHADER_COMPUTE, .constants = &constant, .constant_count = 1, .cache = cache});
}

static rhw_shader_program *link_def(const struct rhw_shader_program_def *def)
{
    rhw_shader_program *program;
    assert_int_equal(rhw_shader_program_create(def, &program, NULL), RHW_OK);
    return program;
}

static void test_the_same_comes_back(void **state)
{
    (void)state;
    rhw_shader_cache *const cache = open_cache(16 << 20);
    rhw_shader *const first = create_factor(cache, 5);
    const size_t size = rhw_shader_cache_get_size(cache);
    assert_true(size >= sizeof double_comp);
    rhw_shader_destroy(first);
    rhw_shader *const again = create_factor(cache, 5);
    assert_ptr_equal(again, first);
    assert_int_equal(rhw_shader_cache_get_size(cache), size);
    rhw_shader_program *const program =
        link_def(&(struct rhw_shader_program_def){.compute = again, .cache = cache});
    rhw_shader_program *const linked_again =
        link_def(&(struct rhw_shader_program_def){.compute = again, .cache = cache});
    assert_ptr_equal(linked_again, program);
    rhw_shader_program_destroy(linked_again);
    rhw_shader_destroy(again);
    rhw_shader_cache_clear(cache);
    assert_int_equal(rhw_shader_cache_get_size(cache), 0);
    rhw_shader_cache_destroy(cache);

    // Whoever has the program goes on without the cache.
    uint32_t source[24], sink[24];
    for (uint32_t i = 0; i < 24; i++) {
        source[i] = i;
    }
    struct rhw_binding sets[2] = {spirv_memory(source, sizeof source), spirv_memory(sink, sizeof sink)};
    const struct rhw_shader_frame frame = {.sets = {&sets[0], &sets[1]}};
    struct rig rig;
    rig_open(&rig, 4, 4);
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    for (uint32_t i = 0; i < 24; i++) {
        assert_int_equal(sink[i], 5 * i);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// Return whether two definitions give one shader.
static bool is_same(rhw_shader_cache *cache, const struct rhw_shader_def *a, const struct rhw_shader_def *b)
{
    rhw_shader *const x = create(double_comp, sizeof double_comp, a);
    rhw_shader *const y = create(double_comp, sizeof double_comp, b);
    rhw_shader_destroy(x);
    rhw_shader_destroy(y);
    rhw_shader_cache_clear(cache);
    return x == y;
}

static void test_what_differs_is_kept_apart(void **state)
{
    (void)state;
    rhw_shader_cache *const cache = open_cache(16 << 20);
    const struct rhw_shader_constant two[] = {{.id = 3, .value = 5}, {.id = 4, .value = 5}};
    const struct rhw_shader_def def = {
        .stage = RHW_SHADER_COMPUTE, .constants = two, .constant_count = 1, .cache = cache};
    struct rhw_shader_def other = def;
    assert_true(is_same(cache, &def, &other));
    other.entry_point = "main";
    assert_true(is_same(cache, &def, &other));
    other.constants = &two[1];
    assert_false(is_same(cache, &def, &other));
    other = def;
    other.constant_count = 2;
    assert_false(is_same(cache, &def, &other));
    other.constant_count = 0;
    assert_false(is_same(cache, &def, &other));
    other = def;
    other.view_index = 1;
    assert_false(is_same(cache, &def, &other));
    other = def;
    other.cache = NULL;
    assert_false(is_same(cache, &def, &other));

    // One word: the version of what wrote the module.
    uint32_t words[sizeof double_comp / sizeof *double_comp];
    memcpy(words, double_comp, sizeof words);
    words[2] ^= 1;
    rhw_shader *const a = create(double_comp, sizeof double_comp, &def);
    rhw_shader *const b = create(words, sizeof words, &def);
    assert_ptr_not_equal(a, b);
    const struct rhw_shader_layout layouts[] = {{0, 0, 1}, {1, 2, 1}, {1, 3, 1}};
    struct rhw_shader_program_def link = {.compute = a, .cache = cache};
    rhw_shader_program *const plain = link_def(&link);
    link.layout = layouts;
    link.layout_count = 2;
    rhw_shader_program *const laid_out = link_def(&link);
    link.layout_count = 3;
    rhw_shader_program *const longer = link_def(&link);
    assert_ptr_not_equal(plain, laid_out);
    assert_ptr_not_equal(laid_out, longer);
    link.compute = b;
    rhw_shader_program *const another = link_def(&link);
    assert_ptr_not_equal(longer, another);
    link.is_interpreted = true;
    rhw_shader_program *const interpreted = link_def(&link);
    assert_ptr_not_equal(another, interpreted);
    rhw_shader_program *const all[] = {plain, laid_out, longer, another, interpreted};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        rhw_shader_program_destroy(all[i]);
    }
    rhw_shader_destroy(a);
    rhw_shader_destroy(b);
    rhw_shader_cache_destroy(cache);
}

static void test_refusals_are_told_each_time(void **state)
{
    (void)state;
    rhw_shader_cache *const cache = open_cache(16 << 20);
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT, .entry_point = "m", .cache = cache};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(rhw_shader_create(plain_frag, sizeof plain_frag, &def, &shader, message),
                         RHW_ERROR_MISUSE);
        assert_string_equal(message, "the module has no fragment entry point \"m\"");
    }
    const struct rhw_shader_def vertex = {.stage = RHW_SHADER_VERTEX, .cache = cache};
    const struct rhw_shader_layout too_short = {.set = 0, .binding = 7, .count = 1};
    const struct rhw_shader_def fragment = {.stage = RHW_SHADER_FRAGMENT, .cache = cache};
    rhw_shader *const above = create(plain_vert, sizeof plain_vert, &vertex);
    rhw_shader *const below = create(plain_frag, sizeof plain_frag, &fragment);
    rhw_shader_program *program;
    const struct rhw_shader_program_def link = {
        .vertex = above, .fragment = below, .layout = &too_short, .layout_count = 1, .cache = cache};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(rhw_shader_program_create(&link, &program, message), RHW_ERROR_MISUSE);
        assert_non_null(strstr(message, "the layout has fewer bindings"));
    }
    rhw_shader_destroy(above);
    rhw_shader_destroy(below);
    rhw_shader_cache_destroy(cache);
}

static void test_the_bound_holds(void **state)
{
    (void)state;
    rhw_shader_cache *cache = open_cache(16 << 20);
    rhw_shader_destroy(create_factor(cache, 0));
    const size_t one = rhw_shader_cache_get_size(cache);
    rhw_shader_cache_destroy(cache);

    // There is room for three. What was asked for least recently goes.
    cache = open_cache(3 * one + one / 2);
    rhw_shader *shaders[4];
    for (uint32_t i = 0; i < 4; i++) {
        shaders[i] = create_factor(cache, i);
        rhw_shader_destroy(create_factor(cache, 0));
        assert_true(rhw_shader_cache_get_size(cache) <= 3 * one + one / 2);
    }
    assert_int_equal(rhw_shader_cache_get_size(cache), 3 * one);
    static const uint32_t order[] = {0, 2, 3, 1};
    for (int i = 0; i < 4; i++) {
        rhw_shader *const again = create_factor(cache, order[i]);
        assert_int_equal(again == shaders[order[i]], order[i] != 1);
        rhw_shader_destroy(again);
        rhw_shader_destroy(shaders[order[i]]);
    }
    rhw_shader_cache_destroy(cache);

    cache = open_cache(one / 2);
    rhw_shader_destroy(create_factor(cache, 0));
    assert_int_equal(rhw_shader_cache_get_size(cache), 0);
    rhw_shader_cache_destroy(cache);
}

// Threads --------------------------------------------------------------------------------------------

enum { THREADS = 4, FACTORS = 6 };

struct asking {
    rhw_shader_cache *cache;
    rhw_shader *shaders[FACTORS];
};

static void *ask(void *user)
{
    struct asking *const asking = user;
    for (uint32_t i = 0; i < 3 * FACTORS; i++) {
        rhw_shader *const shader = create_factor(asking->cache, i % FACTORS);
        rhw_shader_destroy(asking->shaders[i % FACTORS]);
        asking->shaders[i % FACTORS] = shader;
    }
    return NULL;
}

static void ask_from_threads(rhw_shader_cache *cache, struct asking asking[THREADS])
{
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        asking[i] = (struct asking){.cache = cache};
        assert_int_equal(pthread_create(&threads[i], NULL, ask, &asking[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
}

static void test_threads_ask_at_a_time(void **state)
{
    (void)state;
    struct asking asking[THREADS];
    rhw_shader_cache *cache = open_cache(16 << 20);
    rhw_shader_destroy(create_factor(cache, 0));
    const size_t one = rhw_shader_cache_get_size(cache);
    ask_from_threads(cache, asking);
    assert_int_equal(rhw_shader_cache_get_size(cache), FACTORS * one);
    for (int i = 0; i < THREADS * FACTORS; i++) {
        rhw_shader *const shader = asking[i / FACTORS].shaders[i % FACTORS];
        assert_ptr_equal(shader, asking[0].shaders[i % FACTORS]);
        rhw_shader_destroy(shader);
    }
    rhw_shader_cache_destroy(cache);

    // Without room for all, shaders come and go.
    cache = open_cache(2 * one);
    ask_from_threads(cache, asking);
    assert_true(rhw_shader_cache_get_size(cache) <= 2 * one);
    for (int i = 0; i < THREADS * FACTORS; i++) {
        rhw_shader_destroy(asking[i / FACTORS].shaders[i % FACTORS]);
    }
    rhw_shader_cache_destroy(cache);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_same_comes_back),         cmocka_unit_test(test_what_differs_is_kept_apart),
    cmocka_unit_test(test_refusals_are_told_each_time), cmocka_unit_test(test_the_bound_holds),
    cmocka_unit_test(test_threads_ask_at_a_time),
};

const struct unit_tests test_spirv_cache = UNIT_TESTS(tests, NULL, NULL);
