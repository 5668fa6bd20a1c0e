// SPDX-License-Identifier: MIT
// The functions of a compute program (dispatch.h) receive these structs. shader.h includes this header.
//
// A workgroup function has all invocations of its workgroup at hand, so it needs no barrier: what one loop over the
// groups has written to shared memory, the next loop reads. Arrays that the function declares, with an element for each
// group, keep what belongs to an invocation from loop to loop.
#ifndef RHW_SHADER_COMPUTE_H
#define RHW_SHADER_COMPUTE_H

#include "dispatch.h"
#include "shader_lanes.h"

struct rhw_bindings;

#if RHW_HAS_LANES

enum { RHW_MAX_WORKGROUP_GROUPS = RHW_MAX_WORKGROUP_INVOCATIONS / 8 };

/// 8 invocations of a workgroup. They follow each other in x, then in y, then in z.
struct rhw_invocations {
    rhw_int id[3];    ///< place in the whole grid (GlobalInvocationId)
    rhw_int local[3]; ///< place in the workgroup (LocalInvocationId)
    rhw_int index;    ///< number in the workgroup, from 0 on (LocalInvocationIndex)
    /// −1 for an invocation. The last group has lanes of 0 if the workgroup's invocations are no multiple of 8; what
    /// such lanes write must not happen.
    rhw_int mask;
};

/// A workgroup. The library owns what the pointers point to, and the pointers are valid until the function returns.
struct rhw_workgroup {
    const struct rhw_invocations *groups; ///< [group]
    int count;                            ///< number of groups, 1..RHW_MAX_WORKGROUP_GROUPS
    int32_t id[3];                        ///< place of the workgroup among all (WorkgroupId)
    int32_t counts[3];                    ///< workgroups of the dispatch in each direction (NumWorkgroups)
    int32_t size[3];                      ///< invocations of a workgroup in each direction (WorkgroupSize)
    void *shared;                         ///< shared_size bytes, 0 at first, aligned to 64 bytes
    /// invocation_size bytes for each of the 8 lanes of every group, aligned to 64 bytes. Their order is the
    /// function's, and they hold anything at first.
    void *memory;
    const void *uniforms;
    const void *user;                    ///< rhw_compute_program.user
    const struct rhw_bindings *bindings; ///< what storage and sampling functions take
};

#endif

/// One invocation, for the one-at-a-time form. Each member means what the member of struct rhw_invocations or struct
/// rhw_workgroup with the same name means.
struct rhw_invocation1 {
    int32_t id[3], local[3], index;
    int32_t workgroup[3]; ///< place of the workgroup among all
    int32_t counts[3], size[3];
    int32_t step; ///< number of barriers that stand before this call, from 0 on
    void *memory; ///< invocation_size bytes of this invocation, aligned to 16 bytes
    void *shared;
    const void *uniforms;
    const void *user;
    const struct rhw_bindings *bindings;
};

#endif
