// SPDX-License-Identifier: MIT
// Every tree is in order by where its ranges begin, and a heap by their ranks.
#include "range_set.h"

#include "arena.h"

// Split a tree into the ranges that begin below `at` and the others.
static void split(struct rhw_range *tree, size_t at, struct rhw_range **below, struct rhw_range **others)
{
    if (!tree) {
        *below = *others = NULL;
    } else if (tree->first < at) {
        *below = tree;
        split(tree->behind, at, &tree->behind, others);
    } else {
        *others = tree;
        split(tree->before, at, below, &tree->before);
    }
}

// Join two trees. The ranges of the first lie before those of the second.
static struct rhw_range *join(struct rhw_range *a, struct rhw_range *b)
{
    if (!a || !b) {
        return a ? a : b;
    }
    if (a->rank > b->rank) {
        a->behind = join(a->behind, b);
        return a;
    }
    b->before = join(a, b->before);
    return b;
}

static void insert(struct rhw_range_set *set, struct rhw_range *range, size_t first, size_t end)
{
    struct rhw_range *below, *others;
    // This is the generator of Numerical Recipes.
    set->rank = set->rank * 1664525 + 1013904223;
    *range = (struct rhw_range){first, end, set->rank, NULL, NULL};
    split(set->root, first, &below, &others);
    set->root = join(join(below, range), others);
    set->last = range;
}

static void take_out(struct rhw_range_set *set, struct rhw_range *range)
{
    struct rhw_range **link = &set->root;
    while (*link != range) {
        link = range->first < (*link)->first ? &(*link)->before : &(*link)->behind;
    }
    *link = join(range->before, range->behind);
}

struct rhw_range *rhw_range_set_find(const struct rhw_range_set *set, size_t first, size_t end)
{
    struct rhw_range *range = first < end ? set->root : NULL;
    while (range && (end <= range->first || range->end <= first)) {
        range = end <= range->first ? range->before : range->behind;
    }
    return range;
}

void rhw_range_set_shorten(struct rhw_range_set *set, struct rhw_range *range, size_t end)
{
    if (range->first < range->end && end == range->first) {
        take_out(set, range);
        set->last = set->last == range ? NULL : set->last;
    }
    range->end = end;
}

// Return a range that has some of the bytes or lies next to them.
static struct rhw_range *find_touching(const struct rhw_range_set *set, size_t first, size_t end)
{
    struct rhw_range *range = set->root;
    while (range && (end < range->first || range->end < first)) {
        range = end < range->first ? range->before : range->behind;
    }
    return range;
}

struct rhw_range *rhw_range_set_add(struct rhw_range_set *set, struct rhw_arena *arena, size_t first,
                                    size_t end)
{
    struct rhw_range *const range = rhw_arena_alloc(arena, sizeof *range, _Alignof(struct rhw_range));
    if (range && first < end) {
        insert(set, range, first, end);
    } else if (range) {
        *range = (struct rhw_range){.first = first, .end = end};
    }
    return range;
}

struct rhw_range *rhw_range_set_unite(struct rhw_range_set *set, struct rhw_arena *arena, size_t first,
                                      size_t end)
{
    struct rhw_range *taken = NULL, *range;
    if (first == end) {
        return rhw_range_set_add(set, arena, first, end);
    }
    while ((range = find_touching(set, first, end)) != NULL) {
        if (range->first <= first && end <= range->end) {
            set->last = range;
            return range;
        }
        first = range->first < first ? range->first : first;
        end = range->end > end ? range->end : end;
        take_out(set, range);
        taken = range;
    }
    if (!taken) {
        return rhw_range_set_add(set, arena, first, end);
    }
    insert(set, taken, first, end);
    return taken;
}
