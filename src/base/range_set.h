// SPDX-License-Identifier: MIT
// Bytes as ranges that have none in common, found by where they lie: a tree that is in order by their beginnings and a
// heap by a random rank (Seidel and Aragon, "Randomized Search Trees"), so that in whatever order a hundred thousand of
// them come, each costs a few steps.
#ifndef RHW_RANGE_SET_H
#define RHW_RANGE_SET_H

#include <stddef.h>
#include <stdint.h>

struct rhw_arena;

// Bytes `first` to `end`.
struct rhw_range {
    size_t first, end;
    uint32_t rank;
    struct rhw_range *before, *behind; // subtrees
};

// Empty where it is zeroed.
struct rhw_range_set {
    struct rhw_range *root;
    struct rhw_range *last; // of the last call that added; NULL: none, or it has left
    uint32_t rank;          // of the last one that was made
};

// A range that has some of the bytes; NULL: none has.
struct rhw_range *rhw_range_set_find(const struct rhw_range_set *set, size_t first, size_t end);

// Makes a range that was added end earlier. One that becomes empty leaves the set: nothing could be found past it.
void rhw_range_set_shorten(struct rhw_range_set *set, struct rhw_range *range, size_t end);

// Adds a range of its own, of bytes that no other has; one without bytes is made and not in the set. NULL when out of
// memory.
struct rhw_range *rhw_range_set_add(struct rhw_range_set *set, struct rhw_arena *arena, size_t first,
                                    size_t end);

// Adds bytes, which become one range with those that have some of them or are next to them; none are added as by
// rhw_range_set_add. NULL when out of memory.
struct rhw_range *rhw_range_set_unite(struct rhw_range_set *set, struct rhw_arena *arena, size_t first,
                                      size_t end);

#endif
