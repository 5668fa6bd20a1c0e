// SPDX-License-Identifier: MIT
// Shaders that are translated when the program runs: SPIR-V 1.0 to 1.3, as glslang, Tint, Naga and DXC write it for
// Vulkan. librhw-shader has them; it needs librhw and libc alone, and no compiler.
//
// A shader is one entry point of a module with its specialization. It needs no context: any thread may make and destroy
// it, and any number of pipelines may share it. rhw_shader_program puts a vertex and a fragment shader together and fills
// a struct rhw_program; rhw_shader_compute_program does so for compute. The bytes that they draw are the same on every
// machine.
//
// A module that breaks a rule of SPIR-V which the translation relies on, or that asks for what is not supported, is
// refused with a message that names the instruction and its word. Accesses outside of buffers and images are harmless:
// reads give 0, writes do nothing.
#ifndef RHW_SPIRV_H
#define RHW_SPIRV_H

#include "bind.h"
#include "types.h"

enum rhw_shader_stage { RHW_SHADER_VERTEX, RHW_SHADER_FRAGMENT, RHW_SHADER_COMPUTE, RHW_SHADER_STAGE_COUNT };

enum { RHW_SHADER_MAX_SETS = 8, RHW_SHADER_MESSAGE = 256 };

/// A value for a constant that the module lets its user choose (Vulkan 1.3, "Specialization Constants").
struct rhw_shader_constant {
    uint32_t id;    ///< SpecId
    uint32_t value; ///< bits of the number; of a bool, 0 or another number
};

struct rhw_shader_def {
    enum rhw_shader_stage stage;
    const char *entry_point; ///< NULL: "main"
    const struct rhw_shader_constant *constants;
    uint32_t constant_count;
};

/// A translated shader.
typedef struct rhw_shader rhw_shader;

/// Translate an entry point of a module of `size` bytes. The words may be in either order of bytes, and are copied.
/// Set *shader to NULL on failure, and put one line into `message`, which has RHW_SHADER_MESSAGE bytes, unless it is
/// NULL. The result is RHW_ERROR_MISUSE for a module that is refused, or RHW_ERROR_OUT_OF_MEMORY.
RHW_API enum rhw_result rhw_shader_create(const void *words, size_t size, const struct rhw_shader_def *def,
                                          rhw_shader **shader, char *message);
/// `shader` may be NULL. No pipeline of it may be used any more.
RHW_API void rhw_shader_destroy(rhw_shader *shader);

/// What a draw or dispatch gives its shaders. The uniforms of the draw (rhw_pass_set_uniforms) are this struct.
struct rhw_shader_frame {
    /// Descriptor sets. Bindings of a set lie behind one another in the order of their numbers, arrays with all their
    /// elements; rhw_shader_resource_at tells where. NULL and empty bindings are allowed, and read as 0.
    const struct rhw_binding *sets[RHW_SHADER_MAX_SETS];
    const void *push_constants;
    uint32_t push_size; ///< bytes at `push_constants`
};

#endif
