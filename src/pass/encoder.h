// SPDX-License-Identifier: MIT
// The encoder of a context: what is set for the next draw, and what recording keeps until the pass ends. The other files
// of this room change it, and write what they record into `pass`; running it needs nothing of this.
#ifndef RHW_ENCODER_H
#define RHW_ENCODER_H

#include "binding/binding.h"
#include "context/context.h"
#include "context/entry.h"
#include "draw/recorded_pass.h"
#include "rhw/shader.h"
#include "transform_feedback.h"

struct rhw_read_texture;
struct rhw_stored_level;

// What is set for the next draw, by reference: the bytes of a buffer, and the texels of a texture, are looked up when
// something is drawn.
struct rhw_bound_buffer {
    const struct rhw_buffer_data *data; // NULL: nothing is set
    size_t offset, size;                // bytes
    uint32_t index;                     // of the buffer, for messages
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
// A level of a texture, or a range of a buffer as texels.
struct rhw_bound_image {
    struct rhw_texture_data *const *texture; // in the context's pool; NULL: none
    int level;
    struct rhw_bound_range range;
    enum rhw_format format; // of the range
    bool is_read_only;
};
struct rhw_bound {
    struct rhw_bound_buffer vertices[RHW_MAX_VERTEX_BUFFERS], indices;
    struct rhw_bound_texture textures[RHW_MAX_TEXTURES];
    rhw_pipeline pipeline; // for messages
    struct rhw_bound_range storage[RHW_MAX_STORAGE_BUFFERS];
    struct rhw_bound_image images[RHW_MAX_STORAGE_IMAGES];
};

struct rhw_encoder {
    struct rhw_context *context;
    struct rhw_recorded_pass *pass; // the one that is recorded
    bool out_of_memory;             // something could not be recorded: the pass fails when it ends
    bool names_size;                // the definition does, so that attachments may be larger
    bool depth_by_default;          // cleared to 1 by RHW_LOAD_DEFAULT, as no other value was given

    struct rhw_bound bound;
    struct rhw_draw_state pending; // what the next draw would use
    bool pending_changed, textures_changed;
    uint32_t rewrites_seen; // of the context's recording
    const void *uniforms;   // of the next draw
    uint32_t uniform_size;
    const struct rhw_draw_state *current;             // last copy of `pending`
    bool refused_pipeline;                            // rhw_pass_set_pipeline was misuse
    struct rhw_viewport viewports[RHW_MAX_VIEWPORTS]; // of the next draw; `pending` has the first as well
    struct rhw_rect scissors[RHW_MAX_VIEWPORTS];
    const struct rhw_draw_state *routed[RHW_MAX_VIEWPORTS]; // `current` by viewport; NULL: not made yet

    const struct rhw_read_texture *read; // lists of what was set (pass/feedback_loop.h)
    const struct rhw_stored_level *stored;
    struct rhw_feedback_state feedback;
};

// Return an encoder that records into `pass`, or NULL when out of memory.
struct rhw_encoder *rhw_encoder_create(struct rhw_context *context, struct rhw_recorded_pass *pass);
void rhw_encoder_destroy(struct rhw_encoder *encoder); // which may be NULL

// Reports that an id names no pass under way.
__attribute__((cold)) void rhw_pass_report(const rhw_context *context, rhw_pass id, const char *where);

// Enters the context and gives the pass that `id` names, until rhw_context_leave; or reports misuse, leaves again, and
// gives NULL.
static inline struct rhw_encoder *rhw_pass_enter(rhw_context *context, rhw_pass id, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return NULL;
    }
    const struct rhw_recording *const recording = &context->recording;
    if (recording->active && id.generation == recording->generation && id.context == context->number) {
        return context->encoder;
    }
    rhw_pass_report(context, id, where);
    rhw_context_leave(context);
    return NULL;
}

#endif
