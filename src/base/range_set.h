// SPDX-License-Identifier: MIT
// Sets of ranges of bytes that have no byte in common, found by where they lie. A set is a tree that is in order by
// where its ranges begin and a heap by a random rank (Seidel and Aragon, "Randomized Search Trees"), so that a hundred
// thousand ranges cost a few steps each, in whatever order they come.
#ifndef RHW_RANGE_SET_H
#define RHW_RANGE_SET_H

#include <stddef.h>
#include <stdint.h>

struct rhw_arena;

// A range has the bytes from `first` to below `end`.
struct rhw_range {
    size_t first, end;
    uint32_t rank;
    struct rhw_range *before, *behind; // subtrees
};

// A zeroed set is empty.
struct rhw_range_set {
    struct rhw_range *root;
    // The range of the last call that added one. NULL: there was none, or it has left.
    struct rhw_range *last;
    uint32_t rank; // rank of the last range that was made
};

// Return a range that has some of the bytes. Return NULL if none has.
struct rhw_range *rhw_range_set_find(const struct rhw_range_set *set, size_t first, size_t end);

// Make a range of the set end earlier. A range that becomes empty leaves the set: nothing could be found past it.
void rhw_range_set_shorten(struct rhw_range_set *set, struct rhw_range *range, size_t end);

// Add a range of bytes that no other has. A range without bytes is made and stays outside of the set. Return NULL when
// out of memory.
struct rhw_range *rhw_range_set_add(struct rhw_range_set *set, struct rhw_arena *arena, size_t first,
                                    size_t end);

// Add bytes. They become one range with the ranges that have some of them or lie next to them. A range without bytes is
// made as by rhw_range_set_add. Return NULL when out of memory.
struct rhw_range *rhw_range_set_unite(struct rhw_range_set *set, struct rhw_arena *arena, size_t first,
                                      size_t end);

#endif
