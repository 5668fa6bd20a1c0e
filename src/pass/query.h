// SPDX-License-Identifier: MIT
// Queries: what they are between passes, and recording them. Draws carry those that are under way in their state
// (draw/used_query.h); a draw that a query counts the samples of is drawn in its turn (depth_stencil.h: `counts`).
#ifndef RHW_QUERY_H
#define RHW_QUERY_H

#include "rhw/stats.h"

struct rhw_draw;
struct rhw_front_counters;
struct rhw_encoder;

struct rhw_query_data {
    enum rhw_query_kind kind;
    uint32_t pass;    // generation of the last pass that used it; 0: none yet
    bool is_answered; // `counts` are those of that pass
    struct rhw_query_counts counts;
};

// Adds what queries ask of a draw of `count` vertices or indices that was recorded.
void rhw_queries_count_draw(const struct rhw_draw *draw, uint32_t count);
// Adds what transform feedback does for a draw, in primitives.
void rhw_queries_count_feedback(const struct rhw_draw *draw, uint64_t written, uint64_t needed);
// Reports those that were begun and not ended.
void rhw_queries_check_ended(const struct rhw_encoder *encoder);
// Gives queries the answers of the pass that has run.
void rhw_queries_answer(const struct rhw_encoder *encoder);

#endif
