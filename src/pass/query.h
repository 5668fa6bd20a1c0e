// SPDX-License-Identifier: MIT
// A query lives on between passes, and is recorded in passes. Draws carry the queries under way in their state
// (draw/used_query.h). A draw whose samples a query counts is drawn in its turn (depth_stencil.h: `counts`).
#ifndef RHW_QUERY_H
#define RHW_QUERY_H

#include "rhw/stats.h"

struct rhw_draw;
struct rhw_context;
struct rhw_encoder;
struct rhw_recorded_pass;

struct rhw_query_data {
    enum rhw_query_kind kind;
    uint32_t pass;    // generation of the last pass that used the query; 0: none yet
    bool is_answered; // `counts` belong to the last pass that used the query
    struct rhw_query_counts counts;
};

// Add what queries ask of a recorded draw of `count` vertices or indices.
void rhw_queries_count_draw(const struct rhw_draw *draw, uint32_t count);
// Add what transform feedback does for a draw, in primitives.
void rhw_queries_count_feedback(const struct rhw_draw *draw, uint64_t written, uint64_t needed);
// Report queries that were begun and not ended.
void rhw_queries_check_ended(const struct rhw_encoder *encoder, const char *where);
// Give queries the answers of the pass that has run.
void rhw_queries_answer(struct rhw_context *context, const struct rhw_recorded_pass *pass);

// Keep what recording counted, for all runs of the pass.
void rhw_queries_keep(struct rhw_recorded_pass *pass);
// Begin a run of a pass that was kept: its queries have no answer yet, and have counted what recording did.
void rhw_queries_begin(struct rhw_context *context, struct rhw_recorded_pass *pass);

#endif
