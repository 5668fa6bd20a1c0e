// SPDX-License-Identifier: MIT
// Shader functions under validation. A validator stands behind the seam in their place and calls each twice for every
// pair of groups: all that the program did not declare, and all that is still to be written, holds one rubbish the first
// time and another the second. What differs then was read without being declared, or not written at all. The pipeline
// goes on with the first result, in which undeclared floats are NaN. A group without another beside it is called as a
// pair of itself, so that a function which works on the first alone is found however few groups there are. Functions with
// effects are called once, and what they read is not looked at.
#ifndef RHW_VALIDATION_H
#define RHW_VALIDATION_H

#include <string.h>

#include "binding/binding.h"
#include "pipeline/pipeline.h"
#include "context/pool.h"

struct rhw_context;
struct rhw_validation_messages;

enum {
    RHW_VALIDATED_COMPONENTS = 64, // room for varyings; those behind the declared ones are validated
    RHW_VALIDATED_PADDING = 256,   // bytes of rubbish behind the uniforms
    RHW_VALIDATED_GROUPS = 2       // of a call
};

// Takes the place of program.user.
struct rhw_validator {
    struct rhw_validation_messages *validation;
    const struct rhw_pipeline_data *pipeline;
    rhw_vertex_function *vertex;     // NULL: the one-at-a-time form
    rhw_fragment_function *fragment; // likewise
    const void *user;                // the program's own
    uint32_t uses;                   // as declared; the pipeline asks for COORD besides, to name a pixel
    char name[RHW_LABEL_SIZE + 32];  // of the pipeline, for messages
};

// What stands before the uniforms of a draw under validation: two copies, each with its own rubbish behind it.
struct rhw_validated_uniforms {
    _Alignas(64) uint32_t draw;
    size_t second; // bytes from the first copy to the second
};

// Puts a validator, which the pipeline owns from then on, in the place of the pipeline's functions. Return false when out
// of memory. A context under validation calls this for every pipeline (context.h: validate_pipeline).
bool rhw_validate_pipeline(struct rhw_context *context, struct rhw_pipeline_data *pipeline, const char *name);

// A draw's uniforms as its validator wants them, from `size` bytes at `uniforms`; NULL when out of memory.
struct rhw_arena;
const void *rhw_validated_uniforms(struct rhw_arena *arena, const void *uniforms, uint32_t size,
                                   uint32_t draw);

void rhw_validated_vertex(struct rhw_vertex *groups, int count);
void rhw_validated_fragment(struct rhw_fragment *groups, int count);

// Looks at what a shader function asks of its textures: slots that do not exist or have no texture, and levels that
// nobody has written.
bool rhw_validate_slot(const struct rhw_bindings *textures, int slot);    // false: nothing is there
void rhw_validate_samples(const struct rhw_bindings *textures, int slot); // of a multisampled texture
// Whether what texels are compared with is there exactly where the sampler compares; the slot has a texture.
void rhw_validate_reference(const struct rhw_bindings *textures, int slot,
                            const struct rhw_sample_request *request);
// The same of storage, and effects that are not declared.
void rhw_validate_storage(const struct rhw_bindings *textures, int slot,
                          enum rhw_storage_operation operation);
void rhw_validate_image(const struct rhw_bindings *textures, int slot, enum rhw_storage_operation operation);
void rhw_validate_sample(const struct rhw_bindings *textures, int slot,
                         const struct rhw_sample_request *request);
// False where the call must not be made: its stride leaves no room.
bool rhw_validate_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                                int stride);

// The rubbish: [0] is NaN, [1] a number that nobody means. Outputs have their own, so that an input that is copied to
// an output does not pass for one that was not written.
extern const uint32_t rhw_validator_input[2], rhw_validator_output[2];

static inline rhw_float rhw_validator_rubbish(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return rhw_splat(value);
}

// Lanes of `mask` where a and b have different bits.
static inline rhw_int rhw_validator_differs(rhw_float a, rhw_float b, rhw_int mask)
{
    return ((rhw_int)a != (rhw_int)b) & mask;
}

// Whether both results still hold the rubbish of outputs in some lane of `mask`.
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

// Where sampling by a validated function is told; `mask` as in struct rhw_sample_site.
static inline struct rhw_sample_site rhw_validator_site(const struct rhw_validator *validator,
                                                        const void *uniforms, const rhw_int *mask)
{
    return (struct rhw_sample_site){validator->validation, rhw_validator_draw(uniforms)->draw,
                                    validator->name, mask};
}

#endif
