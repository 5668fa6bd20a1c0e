// SPDX-License-Identifier: MIT
// A dispatch runs a program over a grid of workgroups, without vertices and fragments (Vulkan 1.3 §9.2, "Compute
// Shaders"; WebGPU, "Computing operations"). Its functions read and write the buffers and images that the definition
// names by slot, as the functions of a pass do. shader_compute.h has what the functions receive, and docs/shaders.md
// tells how they are written.
#ifndef RHW_DISPATCH_H
#define RHW_DISPATCH_H

#include "types.h"

enum {
    RHW_MAX_WORKGROUP_INVOCATIONS = 1024, ///< invocations of a workgroup, in all directions together
    RHW_MAX_WORKGROUP_COUNT = 65535,      ///< workgroups of a dispatch in each direction
    RHW_MAX_SHARED_SIZE = 1 << 16,        ///< bytes that the invocations of a workgroup share
    RHW_MAX_INVOCATION_SIZE = 1 << 12     ///< bytes that an invocation keeps from one barrier to the next
};

struct rhw_workgroup;
struct rhw_invocation1;

/// A workgroup function is called once for each workgroup and works on all of its invocations, in groups of 8 lanes. A
/// barrier stands wherever one loop over the groups ends and the next begins. The library calls the function on any
/// thread, in any order.
typedef void rhw_workgroup_function(struct rhw_workgroup *workgroup);

/// A one-at-a-time function works on one invocation. The library calls it for all invocations of a workgroup, from the
/// first to the last. An invocation that returns true is called again when the function was called for all the others:
/// it stands at a barrier. An invocation that returns false is done.
typedef bool rhw_invocation1_function(struct rhw_invocation1 *invocation);

/// A compute program is a function and what it needs. It may be a constant of the program: nothing is created from it.
struct rhw_compute_program {
    /// The function on 8 lanes, by instruction set, as in rhw_program.vertex. Entry 0 (baseline) is enough.
    rhw_workgroup_function *workgroup[RHW_ISA_COUNT];
    rhw_invocation1_function *invocation1; ///< used if every entry of `workgroup` is NULL
    /// Invocations of a workgroup in each direction; 0 means 1. There are at most RHW_MAX_WORKGROUP_INVOCATIONS
    /// together.
    int size[3];
    uint32_t shared_size; ///< bytes at `shared`, 0..RHW_MAX_SHARED_SIZE; they are 0 when a workgroup begins
    /// Bytes at `memory` for each invocation, 0..RHW_MAX_INVOCATION_SIZE, which it keeps from one barrier to the next.
    /// In the one-at-a-time form these bytes are 0 when a workgroup begins.
    uint32_t invocation_size;
    uint32_t uniform_size; ///< bytes that the function reads at `uniforms`, 0..RHW_MAX_UNIFORM_SIZE
    const void *user;      ///< pointer that the function receives as `user`; see rhw_program.user
    /// The function uses what atomics on storage return, or exchanges words between workgroups, so that the order of
    /// the workgroups would show in what it writes. They then run on the calling thread alone, x first, then y, then z,
    /// and write the same bytes on every run. Leave it false if any order will do.
    bool uses_atomic_results;
    const char *label; ///< name in messages, or NULL
};

/// A texture with the sampler that reads it. A null texture leaves the slot empty. rhw_pass_set_texture has the rules.
struct rhw_dispatch_texture {
    rhw_texture texture;
    rhw_sampler sampler;
};

/// A range of a buffer in a storage slot. A null buffer leaves the slot empty. A size of 0 goes up to the end of the
/// buffer. rhw_pass_set_storage_buffer and rhw_pass_set_read_only_storage_buffer have the rules.
struct rhw_dispatch_buffer {
    rhw_buffer buffer;
    size_t offset, size; ///< bytes
    bool read_only;
};

/// A level of a texture, or a range of a buffer as texels, in an image slot. If both ids are null, the slot is empty.
/// It is misuse to set both. rhw_pass_set_storage_image and rhw_pass_set_texel_buffer have the rules.
struct rhw_dispatch_image {
    rhw_texture texture;
    int level;
    rhw_buffer buffer;
    enum rhw_format format; ///< format of the buffer's texels
    size_t offset, size;    ///< bytes of the buffer; a size of 0 goes up to its end
    bool read_only;
};

/// A program with all that it reaches. Element i of an array is what slot i has.
struct rhw_dispatch_def {
    struct rhw_compute_program program;
    const void *uniforms; ///< bytes that the function reads in place, at least program.uniform_size
    size_t uniform_bytes; ///< bytes at `uniforms`
    struct rhw_dispatch_buffer buffers[RHW_MAX_STORAGE_BUFFERS];
    struct rhw_dispatch_texture textures[RHW_MAX_TEXTURES];
    struct rhw_dispatch_image images[RHW_MAX_STORAGE_IMAGES];
    /// Place of the first workgroup: places run from here on, and those of invocations with them, while NumWorkgroups
    /// stays (vkCmdDispatchBase). In each direction the place behind the last workgroup is at most
    /// RHW_MAX_WORKGROUP_COUNT.
    uint32_t base[3];
};

/// Numbers of workgroups in a buffer (VkDispatchIndirectCommand; WebGPU, dispatchWorkgroupsIndirect).
struct rhw_dispatch_command {
    uint32_t x, y, z;
};

/// Dispatch as rhw_dispatch does, for callers in another language. `flaws` is the value of rhw_arithmetic_flaws where
/// the function was compiled, or 0 if no C compiler compiled it.
RHW_API enum rhw_result rhw_dispatch_probed(rhw_context *context, const struct rhw_dispatch_def *def,
                                            uint32_t flaws, uint32_t x, uint32_t y, uint32_t z);

/// Dispatch as rhw_dispatch_indirect does, for callers in another language, with `flaws` as in rhw_dispatch_probed.
RHW_API enum rhw_result rhw_dispatch_indirect_probed(rhw_context *context, const struct rhw_dispatch_def *def,
                                                     uint32_t flaws, rhw_buffer buffer, size_t offset);

#endif
