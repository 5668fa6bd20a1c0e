// SPDX-License-Identifier: MIT
// Queries in the pass that uses them: what they count, which draws carry in their state. pass/query.h has what queries are
// between passes.
#ifndef RHW_USED_QUERY_H
#define RHW_USED_QUERY_H

#include <stdatomic.h>

#include "base/constants.h"
#include "rhw/stats.h"

// A query in the pass that uses it, on a list.
struct rhw_used_query {
    struct rhw_used_query *next;
    rhw_query id;
    enum rhw_query_kind kind;
    uint64_t place; // of a timestamp: the triangles before it
    struct rhw_query_counts counts;
    // Written by the workers, once for each tile and change of state:
    _Alignas(RHW_CACHE_LINE) _Atomic uint64_t samples, fragments;
};

// Those that are under way, by kind; NULL: none. It does not change: draws point at it.
struct rhw_active_queries {
    struct rhw_used_query *of[RHW_QUERY_KIND_COUNT];
};

#endif
