// SPDX-License-Identifier: MIT
// Sets of ranges against a byte for each of their bytes; and how much they cost when there are many.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "base/range_set.h"

enum { BYTES = 300 };

// What the set has, by byte: the number of the range, from 1 on in order, and 0 where none is.
static int list(const struct rhw_range *range, uint8_t *held, int count)
{
    if (!range) {
        return count;
    }
    count = list(range->before, held, count) + 1;
    for (size_t i = range->first; i < range->end; i++) {
        assert_int_equal(held[i], 0);
        held[i] = (uint8_t)count;
    }
    return list(range->behind, held, count);
}

static void test_united_bytes(void **state)
{
    (void)state;
    struct rhw_memory memory = {.allocator = rhw_allocator_or_default((struct rhw_allocator){0})};
    uint64_t random = 11;
    for (int round = 0; round < 200; round++) {
        struct rhw_arena arena;
        rhw_arena_init(&arena, &memory);
        struct rhw_range_set set = {.root = NULL};
        uint8_t expected[BYTES] = {0};
        for (int step = 0; step < 40; step++) {
            const size_t first = (size_t)rig_random_int(&random, BYTES - 12);
            const size_t end = first + 1 + (size_t)rig_random_int(&random, 12);
            const struct rhw_range *const found = rhw_range_set_find(&set, first, end);
            assert_true((found != NULL) == (memchr(expected + first, 1, end - first) != NULL));
            const struct rhw_range *const range = rhw_range_set_unite(&set, &arena, first, end);
            assert_true(range->first <= first && range->end >= end && set.last == range);
            memset(expected + first, 1, end - first);
            uint8_t held[BYTES] = {0};
            list(set.root, held, 0);
            for (int i = 0; i < BYTES; i++) {
                assert_int_equal(held[i] != 0, expected[i]);
                assert_true(i == 0 || !expected[i] || !expected[i - 1] || held[i] == held[i - 1]);
            }
        }
        rhw_arena_destroy(&arena);
    }
}

// Ranges of their own that lie side by side stay apart; one that became shorter frees what it had.
static void test_ranges_of_their_own(void **state)
{
    (void)state;
    struct rhw_memory memory = {.allocator = rhw_allocator_or_default((struct rhw_allocator){0})};
    struct rhw_arena arena;
    struct rhw_range_set set = {.root = NULL};
    rhw_arena_init(&arena, &memory);
    struct rhw_range *const a = rhw_range_set_add(&set, &arena, 10, 20),
                            *const b = rhw_range_set_add(&set, &arena, 20, 30),
                            *const c = rhw_range_set_add(&set, &arena, 0, 10);
    assert_true(rhw_range_set_find(&set, 19, 20) == a && rhw_range_set_find(&set, 20, 21) == b);
    assert_true(rhw_range_set_find(&set, 9, 10) == c && !rhw_range_set_find(&set, 30, 40));
    assert_null(rhw_range_set_find(&set, 15, 15));
    rhw_range_set_shorten(&set, a, 10); // to nothing
    assert_null(rhw_range_set_find(&set, 10, 20));
    struct rhw_range *const d = rhw_range_set_add(&set, &arena, 10, 18);
    assert_true(rhw_range_set_find(&set, 0, 300) && rhw_range_set_find(&set, 17, 20) == d);
    rhw_arena_destroy(&arena);
}

// Ranges at random that are shortened again, to nothing too, with empty ones among them.
static void test_shortened(void **state)
{
    (void)state;
    struct rhw_memory memory = {.allocator = rhw_allocator_or_default((struct rhw_allocator){0})};
    uint64_t random = 3;
    for (int round = 0; round < 300; round++) {
        struct rhw_arena arena;
        rhw_arena_init(&arena, &memory);
        struct rhw_range_set set = {.rank = (uint32_t)round};
        uint8_t expected[BYTES] = {0};
        for (int step = 0; step < 60; step++) {
            const size_t first = (size_t)rig_random_int(&random, BYTES / 10) * 10;
            const size_t end = first + 10 * (size_t)rig_random_int(&random, 2);
            if (rhw_range_set_find(&set, first, end)) {
                assert_non_null(memchr(expected + first, 1, end - first));
                continue;
            }
            assert_null(memchr(expected + first, 1, end - first));
            struct rhw_range *const range = rhw_range_set_add(&set, &arena, first, end);
            const size_t left = (size_t)rig_random_int(&random, (int)(end - first) + 1) / 5 * 5;
            rhw_range_set_shorten(&set, range, first + left);
            memset(expected + first, 1, left);
            assert_true(range->first == first && range->end == first + left);
        }
        uint8_t held[BYTES] = {0};
        list(set.root, held, 0);
        for (int i = 0; i < BYTES; i++) {
            assert_int_equal(held[i] != 0, expected[i]);
        }
        rhw_arena_destroy(&arena);
    }
}

// The height of the tree, whatever the order of what was added.
static int height(const struct rhw_range *range)
{
    const int before = range ? height(range->before) : 0, behind = range ? height(range->behind) : 0;
    return range ? 1 + (before > behind ? before : behind) : 0;
}

static void test_many(void **state)
{
    (void)state;
    enum { MANY = 1 << 16 };
    for (int order = 0; order < 3; order++) {
        struct rhw_memory memory = {.allocator = rhw_allocator_or_default((struct rhw_allocator){0})};
        struct rhw_arena arena;
        struct rhw_range_set set = {.root = NULL};
        rhw_arena_init(&arena, &memory);
        for (uint32_t i = 0; i < MANY; i++) {
            const uint32_t place = order == 0 ? i : order == 1 ? MANY - 1 - i : i * 40503 % MANY;
            assert_non_null(rhw_range_set_unite(&set, &arena, 8 * (size_t)place, 8 * (size_t)place + 4));
        }
        const size_t used = rhw_arena_used(&arena);
        for (size_t i = 0; i < 2 * MANY; i++) { // what is there takes no memory
            assert_non_null(
                rhw_range_set_unite(&set, &arena, i * 12345 % MANY * 8 + 1, i * 12345 % MANY * 8 + 2));
        }
        assert_int_equal(rhw_arena_used(&arena), used);
        assert_true(height(set.root) < 60);
        const struct rhw_range *const all = rhw_range_set_unite(&set, &arena, 0, 8 * (size_t)MANY);
        assert_true(set.root == all && !all->before && !all->behind);
        rhw_arena_destroy(&arena);
    }
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_united_bytes),
                                          cmocka_unit_test(test_ranges_of_their_own),
                                          cmocka_unit_test(test_shortened), cmocka_unit_test(test_many)};

const struct unit_tests test_range_set = UNIT_TESTS(tests, NULL, NULL);
