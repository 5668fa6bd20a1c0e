// SPDX-License-Identifier: MIT
// What generated code calls: the inline functions of the library, compiled for AVX2, so that its bits are those of
// every back end. Vectors are passed in registers, as the System V ABI has it for functions that are compiled for AVX.
#ifndef SHADER_CALLS_H
#define SHADER_CALLS_H

#include "form/linked_stage.h"
#include "rhw/shader.h"
#include "rhw/spirv.h"

// A function by the operation that needs it, and these.
enum shader_call {
    SHADER_CALL_PUSH_WORD = SHADER_OP_COUNT, // a word for all lanes
    SHADER_CALL_PUSH,                        // a word for each lane
    SHADER_CALL_SINE_FIRST,                  // sine and cosine, the other of which goes to memory
    SHADER_CALL_COSINE_FIRST,
    SHADER_CALL_FIND_WORDS,
    SHADER_CALL_FIND_SHARED,
    SHADER_CALL_FIND_PAIR,
    SHADER_CALL_COMPARE_WINDOW,
    SHADER_CALL_FIND_PLANE,
    SHADER_CALL_FETCH_PLANE,
    SHADER_CALL_LIST,
    SHADER_CALL_SAMPLE_GROUPS,
    SHADER_CALL_LOAD_WORDS,
    SHADER_CALL_SHARE,
    SHADER_CALL_OWN_STORE,
    SHADER_CALL_GIVEN_UP,
    SHADER_CALL_EXP_OF_GROUPS,
    SHADER_CALL_LOG_OF_GROUPS,
    SHADER_CALL_EXP2_OF_GROUPS,
    SHADER_CALL_LOG2_OF_GROUPS,
    SHADER_CALLS
};

typedef void shader_call_function(void);
typedef shader_call_function *shader_call_finder(unsigned which);

// What is known of an access when code is generated.
struct shader_site {
    struct shader_slot texture, sampler;
    uint32_t flags; // immediate of the operation
    uint32_t width; // bits that are stored
};

// Words that offsets of 32 bits reach.
#define SHADER_MOST_WORDS (1u << 30)

// A binding that all lanes of a call name, found once.
struct shader_found {
    _Alignas(32) const struct rhw_binding *binding; // NULL: there is none
    const uint32_t *words;
    uint64_t count; // words, at most SHADER_MOST_WORDS
};

// A texture with a sampler.
struct shader_found_pair {
    struct shader_found found;
    _Alignas(32) struct rhw_binding memory;
};

// The groups that go through the code together, and a record for each.
struct shader_together {
    void *groups, *records;
    uint64_t record_size;
    uint32_t here; // number of groups
};

// A texture whose texels are read one by one.
struct shader_found_plane {
    const struct rhw_binding *binding;
    struct rhw_texel_plane plane; // without texels where it has to be sampled
    _Alignas(32) uint32_t last[2][8],
        row_length[8]; // the last column and row, and texels of a row, in all lanes
};

#if RHW_HAS_LANES

union shader_lanes {
    rhw_float f;
    rhw_int i;
};

// Operands of an access to an image, and what came of it. Code stores those that there are.
struct shader_request {
    union {
        rhw_float f[4];
        rhw_int i[4];
    } at;
    rhw_float gradient[6];
    rhw_int offset[3];
    union shader_lanes lod;
    rhw_float reference, bias, least;
    rhw_int sample, texture, sampler, mask;
    rhw_float texel[4];
};

#endif

#endif
