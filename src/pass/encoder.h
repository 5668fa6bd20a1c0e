// SPDX-License-Identifier: MIT
// The encoder of a context holds what is set for the next draw, and what recording keeps until the pass ends. The other
// files of this room change it, and write what they record into `pass`. Running a pass needs nothing of the encoder.
#ifndef RHW_ENCODER_H
#define RHW_ENCODER_H

#include "binding/binding.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/use_table.h"
#include "draw/recorded_pass.h"
#include "memory_overlap.h"
#include "resource/buffer.h"
#include "rhw/shader.h"
#include "transform_feedback.h"

struct rhw_clean_part;
struct rhw_read_texture;
struct rhw_stored_level;

// These structures hold what is set for the next draw, by reference: the bytes of a buffer and the texels of a texture
// are looked up when something is drawn.
struct rhw_bound_buffer {
    const struct rhw_buffer_data *data; // NULL: no buffer is set
    const unsigned char *memory;        // memory of the program; NULL: a buffer is set, or nothing
    size_t offset, size;                // bytes
    uint32_t index;                     // number of the buffer, for messages
};
struct rhw_bound_texture {
    struct rhw_texture_data *const *texture; // in the context's pool; NULL: nothing is set
    const struct rhw_sampler_data *sampler;
};
struct rhw_bound_range {
    const struct rhw_buffer_data *data; // NULL: nothing is set
    size_t offset, size;                // bytes
    bool is_read_only;
};
// A storage image is a level of a texture, or a range of a buffer as texels.
struct rhw_bound_image {
    struct rhw_texture_data *const *texture; // in the context's pool; NULL: no level is set
    int level;
    struct rhw_bound_range range;
    enum rhw_format format; // format of the range
    bool is_read_only;
};
struct rhw_bound {
    struct rhw_bound_buffer vertices[RHW_MAX_VERTEX_BUFFERS], indices;
    struct rhw_bound_texture textures[RHW_MAX_TEXTURES];
    rhw_pipeline pipeline; // name of the pipeline, for messages
    struct rhw_bound_range storage[RHW_MAX_STORAGE_BUFFERS];
    struct rhw_bound_image images[RHW_MAX_STORAGE_IMAGES];
};

struct rhw_encoder {
    struct rhw_context *context;
    struct rhw_recorded_pass *pass; // the pass that is recorded
    bool out_of_memory;             // something could not be recorded: the pass fails when it ends
    bool given_up;                  // the program gave it up while it was recorded
    bool names_size;                // the definition names the size, and attachments may be larger
    bool depth_by_default;          // RHW_LOAD_DEFAULT clears depth to 1, because no other value was given

    struct rhw_bound bound;
    struct rhw_draw_state pending; // what the next draw would use
    bool pending_changed, bindings_changed, storage_changed;
    struct rhw_bindings slots;           // what the slots have for the next draw
    const struct rhw_bindings *bindings; // last copy of `slots`
    uint32_t rewrites_seen;              // the last value of context->recording.rewrites that was seen
    const void *uniforms;                // uniforms of the next draw
    uint32_t uniform_size;
    const struct rhw_draw_state *current;             // last copy of `pending`
    bool refused_pipeline;                            // rhw_pass_set_pipeline was misuse
    struct rhw_viewport viewports[RHW_MAX_VIEWPORTS]; // viewports of the next draw; `pending` has the first too
    struct rhw_rect scissors[RHW_MAX_VIEWPORTS];
    const struct rhw_draw_state *routed[RHW_MAX_VIEWPORTS]; // `current` in each viewport; NULL: not made yet

    // pass/feedback_loop.h keeps these lists of what was set.
    const struct rhw_read_texture *read;
    const struct rhw_stored_level *stored;
    struct rhw_feedback_state feedback;
    struct rhw_used_memory memory; // see pass/memory_overlap.h
    struct rhw_use_table uses;     // what the pass uses, where the context is a recorder
    // Parts of textures whose records of clean tiles a recording looks up when it runs.
    struct rhw_clean_part *clean_parts;
};

// Return true if a buffer or memory is set.
static inline bool rhw_bound_is_set(const struct rhw_bound_buffer *bound)
{
    return bound->data || bound->memory;
}

// Return the first of the bytes that are set. A buffer that was written after a draw of this pass has new ones.
static inline const unsigned char *rhw_bound_bytes(const struct rhw_bound_buffer *bound)
{
    return bound->data ? bound->data->bytes + bound->offset : bound->memory;
}

// Return an encoder that records into `pass`, or NULL when out of memory.
struct rhw_encoder *rhw_encoder_create(struct rhw_context *context, struct rhw_recorded_pass *pass);
// Release an encoder. Do nothing where it is NULL.
void rhw_encoder_destroy(struct rhw_encoder *encoder);

// Forget all that the last pass, or the last dispatch, used and set. What is used and set from now on belongs to
// another, which has the next generation.
void rhw_encoder_renew(struct rhw_encoder *encoder);

// Note that the pass uses the live item at `index`. `moves` is how often it has got other memory, or 0 for an item that
// has none.
static inline void rhw_encoder_note_use(struct rhw_encoder *encoder, const struct rhw_pool *pool,
                                        uint32_t index, uint32_t moves)
{
    if (!encoder->context->uses) { // the common case, for each call of the program
        rhw_pool_use(pool, index, encoder->context->recording.generation);
        return;
    }
    encoder->out_of_memory |=
        !rhw_use_table_note(encoder->context->uses, &encoder->pass->arena, pool, index, moves);
}

// Report that an id names no pass under way.
__attribute__((cold)) void rhw_pass_report(const rhw_context *context, rhw_pass id, const char *where);

// Enter the context, and return the encoder of the pass that `id` names, until rhw_context_leave. Report misuse, leave
// the context and return NULL if `id` names no pass under way.
static inline struct rhw_encoder *rhw_pass_enter(rhw_context *context, rhw_pass id, const char *where)
{
    if (!rhw_context_enter_any(context, where)) {
        return NULL;
    }
    const struct rhw_recording_place *const recording = &context->recording;
    if (recording->active && id.generation == recording->generation && id.context == context->pass_number) {
        return context->encoder;
    }
    rhw_pass_report(context, id, where);
    rhw_context_leave(context);
    return NULL;
}

#endif
