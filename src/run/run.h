// SPDX-License-Identifier: MIT
// An executor runs recorded passes.
#ifndef RHW_RUN_H
#define RHW_RUN_H

#include "rhw/stats.h"

struct rhw_context;
struct rhw_recorded_pass;

// The memory that running needs: workers' scratch, chunks, and what attachments without a texture hold between waves.
// It stays from pass to pass.
struct rhw_executor;

// Return an executor on the threads of the context, or NULL when out of memory.
struct rhw_executor *rhw_executor_create(struct rhw_context *context);
// Release an executor. Do nothing where it is NULL.
void rhw_executor_destroy(struct rhw_executor *executor);

// Run a pass and, where `stats` is not NULL, tell what the work was.
enum rhw_result rhw_executor_run(struct rhw_executor *executor, struct rhw_recorded_pass *pass,
                                 struct rhw_stats *stats);

#endif
