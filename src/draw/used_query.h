// SPDX-License-Identifier: MIT
// A used query is a query in the pass that uses it, with what it counts. Draws point at it. pass/query.h has what
// queries are between passes.
#ifndef RHW_USED_QUERY_H
#define RHW_USED_QUERY_H

#include <stdatomic.h>

#include "base/constants.h"
#include "rhw/stats.h"

// The queries that a pass uses form a list.
struct rhw_used_query {
    struct rhw_used_query *next;
    rhw_query id;
    enum rhw_query_kind kind;
    uint64_t place; // triangles of the pass before it, if it is a timestamp
    struct rhw_query_counts counts;
    struct rhw_query_counts recorded; // what recording counted, where the pass was kept
    // The workers write these, once for each tile and change of state.
    _Alignas(RHW_CACHE_LINE) _Atomic uint64_t samples, fragments;
};

// These are the queries under way, by kind. NULL: none of the kind. The structure does not change, because draws point
// at it.
struct rhw_active_queries {
    struct rhw_used_query *of[RHW_QUERY_KIND_COUNT];
};

#endif
