// SPDX-License-Identifier: MIT
// The way from an id to the item that it names. `where` is the public function that was called, for messages.
#ifndef RHW_LOOKUP_H
#define RHW_LOOKUP_H

#include "pool.h"
#include "rhw/types.h"

struct rhw_buffer_data;
struct rhw_texture_data;
struct rhw_sampler_data;
struct rhw_pipeline_data;
struct rhw_query_data;

// Return the item that an id names. Report misuse of `where` and return NULL for an id that is null, stale or of
// another context. Items do not move while they live.
struct rhw_buffer_data *rhw_context_buffer(const struct rhw_context *context, rhw_buffer id,
                                           const char *where);
struct rhw_texture_data *rhw_context_texture(const struct rhw_context *context, rhw_texture id,
                                             const char *where);
struct rhw_sampler_data *rhw_context_sampler(const struct rhw_context *context, rhw_sampler id,
                                             const char *where);
struct rhw_pipeline_data *rhw_context_pipeline(const struct rhw_context *context, rhw_pipeline id,
                                               const char *where);
struct rhw_query_data *rhw_context_query(const struct rhw_context *context, rhw_query id, const char *where);

// Return the item that an id names in one of the context's pools, as the functions above do.
void *rhw_context_item(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                       uint32_t generation, const char *where);

// Make the pools of a recorder those that its owner has now.
void rhw_recorder_look_at_pools(struct rhw_context *recorder);

// What messages call a live item: 'texture 3 "albedo"', or 'texture 3' where it has no label.
struct rhw_name {
    char text[RHW_LABEL_SIZE + 32];
};
struct rhw_name rhw_name_of(const struct rhw_pool *pool, uint32_t index);

// Return true if the pass being recorded uses the live item of one of the context's pools.
bool rhw_context_records(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index);
// Return true if a draw of the pass being recorded may read what the item holds now. The item got that in the pass
// `renewed_pass`, after `renewed_draws` draws.
bool rhw_context_draws_read(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                            uint32_t renewed_pass, uint32_t renewed_draws);

#endif
