// SPDX-License-Identifier: MIT
// Shader functions under validation. A validator stands behind the seam in their place and calls each twice for every
// pair of groups. All that the program did not declare, and all that is still to be written, holds one rubbish the
// first time and another the second. What differs then was read without being declared, or not written at all. The
// pipeline goes on with the first result, in which undeclared floats are NaN. A group without another beside it is
// called as a pair of itself, so that a function which works on the first alone is found however few groups there are.
// Functions with effects are called once, and what they read is not compared.
#ifndef RHW_VALIDATION_H
#define RHW_VALIDATION_H

#include <string.h>

#include "base/thread.h"
#include "binding/binding.h"
#include "pipeline/pipeline.h"
#include "context/pool.h"

// What validation finds while a pass runs, on any thread. It is kept until the pass ends and told then. One message of
// each kind is kept: that of the earliest draw.
enum rhw_validation_kind { RHW_VALIDATION_MISUSE, RHW_VALIDATION_WARNING, RHW_VALIDATION_KINDS };

struct rhw_validation_message {
    bool found;
    uint32_t draw;
    char text[512];
};

struct rhw_validation_messages {
    struct rhw_mutex mutex; // guards `kinds` while workers run
    struct rhw_validation_message kinds[RHW_VALIDATION_KINDS];
};

// Set up the messages. Return false when the system has no mutex.
bool rhw_validation_messages_init(struct rhw_validation_messages *validation);
void rhw_validation_messages_destroy(struct rhw_validation_messages *validation);
void rhw_validation_messages_clear(struct rhw_validation_messages *validation);

// Add a message. Every thread may call this.
__attribute__((format(printf, 4, 5), cold)) void rhw_validation_messages_add(
    struct rhw_validation_messages *validation, enum rhw_validation_kind kind, uint32_t draw,
    const char *format, ...);

enum {
    RHW_VALIDATED_COMPONENTS = RHW_MAX_VARYING_COMPONENTS, // room for varyings
    RHW_VALIDATED_FEW = 64, // components of which programs with few varyings validate all
    RHW_VALIDATED_BEHIND =
        16, // components behind the declared ones that are validated, where there are as many
    RHW_VALIDATED_PADDING = 256, // bytes of rubbish behind the uniforms
    RHW_VALIDATED_GROUPS = 2     // groups of a call
};

// A validator takes the place of program.user.
struct rhw_validator {
    struct rhw_validation_messages *validation;
    const struct rhw_pipeline_data *pipeline;
    rhw_vertex_function *vertex;     // NULL: the one-at-a-time form
    rhw_fragment_function *fragment; // NULL: the one-at-a-time form
    const void *user;                // the program's own
    // What the program declared. The pipeline asks for COORD besides, to name a pixel.
    uint32_t uses;
    char name[RHW_LABEL_SIZE + 32]; // name of the pipeline, for messages
};

// Return how many components of varyings are validated: those that the program declares, and some behind them.
static inline int rhw_validated_count(const struct rhw_pipeline_data *pipeline)
{
    return pipeline->varying_components <= RHW_VALIDATED_FEW - RHW_VALIDATED_BEHIND
               ? RHW_VALIDATED_FEW
               : RHW_VALIDATED_COMPONENTS;
}

// What stands before the uniforms of a draw under validation: two copies, each with its own rubbish behind it.
struct rhw_validated_uniforms {
    _Alignas(64) uint32_t draw;
    uint32_t size;   // bytes of the uniforms
    size_t second;   // bytes from the first copy to the second
    const void *own; // the uniforms that the copies are of
};

// Put a validator, which the pipeline owns from then on, in the place of the pipeline's functions. Return false when
// out of memory. A context under validation calls this for every pipeline (context.h: validate_pipeline).
struct rhw_context;
bool rhw_validate_pipeline(struct rhw_context *context, struct rhw_pipeline_data *pipeline, const char *name);

// Return a draw's uniforms as its validator wants them, from `size` bytes at `uniforms`. Return NULL when out of
// memory.
struct rhw_arena;
const void *rhw_validated_uniforms(struct rhw_arena *arena, const void *uniforms, uint32_t size,
                                   uint32_t draw);
// Copy uniforms that rhw_validated_uniforms gave once more from where they stand, as a pass that runs again reads them.
void rhw_validated_uniforms_renew(const void *validated);

void rhw_validated_vertex(struct rhw_vertex *groups, int count);
void rhw_validated_fragment(struct rhw_fragment *groups, int count);

// These functions check what a shader function asks of its textures. They tell slots that do not exist or have no
// texture, and levels that nobody has written. rhw_validate_slot returns false if nothing is in the slot.
// rhw_validate_samples is for multisampled textures.
bool rhw_validate_slot(const struct rhw_bindings *bindings, int slot);
void rhw_validate_samples(const struct rhw_bindings *bindings, int slot);
// Tell a reference that is missing where the sampler compares, or is there where it does not. The slot has a texture.
void rhw_validate_reference(const struct rhw_bindings *bindings, int slot,
                            const struct rhw_sample_request *request);
// Tell storage slots that do not exist or have nothing set, writes to slots that are set for reading, and effects that
// are not declared.
void rhw_validate_storage(const struct rhw_bindings *bindings, int slot,
                          enum rhw_storage_operation operation);
void rhw_validate_image(const struct rhw_bindings *bindings, int slot, enum rhw_storage_operation operation);
void rhw_validate_sample(const struct rhw_bindings *bindings, int slot,
                         const struct rhw_sample_request *request);
// Return false where the call must not be made: its stride leaves no room.
bool rhw_validate_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                                int stride);

// The rubbish: [0] is NaN, [1] a number that nobody means. Outputs have rubbish of their own, so that an input that is
// copied to an output does not pass for an output that was not written.
extern const uint32_t rhw_validator_input[2], rhw_validator_output[2];

static inline rhw_float rhw_validator_rubbish(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return rhw_splat(value);
}

// Return the lanes of `mask` where a and b have different bits.
static inline rhw_int rhw_validator_differs(rhw_float a, rhw_float b, rhw_int mask)
{
    return ((rhw_int)a != (rhw_int)b) & mask;
}

// Return true if both results still hold the rubbish of outputs in some lane of `mask`.
static inline bool rhw_validator_unwritten(rhw_float first, rhw_float second, rhw_int mask)
{
    const rhw_int left = ((rhw_int)first == (int32_t)rhw_validator_output[0]) &
                         ((rhw_int)second == (int32_t)rhw_validator_output[1]) & mask;
    return rhw_any(left);
}

static inline struct rhw_validated_uniforms *rhw_validator_draw(const void *uniforms)
{
    return (struct rhw_validated_uniforms *)((unsigned char *)uniforms -
                                             sizeof(struct rhw_validated_uniforms));
}

static inline const void *rhw_validator_uniforms(const void *uniforms, bool second)
{
    return (const unsigned char *)uniforms + (second ? rhw_validator_draw(uniforms)->second : 0);
}

// Return the place where sampling by a validated function is told. `mask` is that of struct rhw_sample_site.
static inline struct rhw_sample_site rhw_validator_site(const struct rhw_validator *validator,
                                                        const void *uniforms, const rhw_int *mask)
{
    return (struct rhw_sample_site){validator->validation, rhw_validator_draw(uniforms)->draw,
                                    validator->name, mask};
}

#endif
