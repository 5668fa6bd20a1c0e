// SPDX-License-Identifier: MIT
// From an id to the item it names. `where` is the public function that was called, for messages.
#ifndef RHW_LOOKUP_H
#define RHW_LOOKUP_H

#include "rhw/types.h"

struct rhw_pool;
struct rhw_buffer_data;
struct rhw_texture_data;
struct rhw_sampler_data;
struct rhw_pipeline_data;

// A null or stale id is reported as misuse of `where` and gives NULL, as a NULL context does. Items do not move while
// they live.
struct rhw_buffer_data *rhw_context_buffer(const struct rhw_context *context, rhw_buffer id,
                                           const char *where);
struct rhw_texture_data *rhw_context_texture(const struct rhw_context *context, rhw_texture id,
                                             const char *where);
struct rhw_sampler_data *rhw_context_sampler(const struct rhw_context *context, rhw_sampler id,
                                             const char *where);
struct rhw_pipeline_data *rhw_context_pipeline(const struct rhw_context *context, rhw_pipeline id,
                                               const char *where);

// False, and misuse of `where`, when the pass being recorded uses the live item of one of the context's pools.
bool rhw_context_check_idle(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                            const char *where);

#endif
