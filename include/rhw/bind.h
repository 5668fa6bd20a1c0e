// SPDX-License-Identifier: MIT
// A binding is what a slot of a draw has, as a value of the program: a texture with its sampler, an image, or a buffer.
// It may lie in any memory, so a shader finds thousands of them by pointers and indices, and a draw changes them by
// changing its uniforms. shader_binding.h has what shader functions do with one.
//
// A binding refers to what it was made of. The program keeps that alive, and keeps the binding as it is, until each
// pass and each dispatch that uses the binding has run. No pass records which bindings its functions use: none of the
// rules about who reads and who writes is checked, and destroying a texture or a buffer in use is an error that nobody
// tells. docs/shaders.md has the rules.
#ifndef RHW_BIND_H
#define RHW_BIND_H

#include "types.h"

/// A binding. Its size is 64 bytes, and its alignment that of uint64_t; at an address that is a multiple of 64 it takes
/// one cache line. The program may copy it. Zeros are an empty binding. It means something in the process that made it,
/// and to the version of the library that made it, alone. The members are the library's.
struct RHW_MAY_ALIAS rhw_binding {
    uint64_t opaque[8];
};

// Bindings of what a context owns. These functions look up ids, so the calling thread is the one that is inside the
// context. They may be called while a pass is recorded. They return RHW_OK, RHW_ERROR_OUT_OF_MEMORY,
// RHW_ERROR_GIVEN_UP (rhw_context_set_goes_on) or RHW_ERROR_MISUSE. On failure the binding is empty.

/// Make a binding of a texture with a sampler, for the sampling functions. The rules about the pair are those of
/// rhw_pass_set_texture. A null sampler gives a binding for fetches and sizes, and for rhw_binding_of_pair.
///
/// A texture with a binding keeps its texels where they are. If the pass being recorded reads them from a slot,
/// rhw_texture_write and its like are misuse until the pass has ended. Before each pass and each dispatch runs, the
/// library prepares textures with bindings that were written, as rhw_pass_set_texture prepares its texture. A function
/// of a pass sees the texels of its beginning, so it must not sample what the pass writes.
RHW_API enum rhw_result rhw_binding_of_texture(rhw_context *context, rhw_texture texture, rhw_sampler sampler,
                                               struct rhw_binding *binding);

/// Make a binding of a sampler, for rhw_binding_of_pair alone.
RHW_API enum rhw_result rhw_binding_of_sampler(rhw_context *context, rhw_sampler sampler,
                                               struct rhw_binding *binding);

/// Make a binding of a level of a texture, for the image functions. The rules about texture and level are those of
/// rhw_pass_set_storage_image. Functions do not write to a binding that is `read_only`. From one that is not, the
/// library takes any pass or dispatch to write the texture, so its kept clears and copies are made anew each time.
RHW_API enum rhw_result rhw_binding_of_image(rhw_context *context, rhw_texture texture, int level,
                                             bool read_only, struct rhw_binding *binding);

/// Make a binding of bytes of a buffer, for the storage functions. The rules about the range are those of
/// rhw_pass_set_storage_buffer: `offset` is a multiple of 4, and a `size` of 0 goes up to the end. Functions do not
/// write to a binding that is `read_only`. A buffer with a binding keeps its bytes where they are. If the pass being
/// recorded reads bytes of it as vertices or by a slot, rhw_buffer_write to these is misuse until the pass has ended.
RHW_API enum rhw_result rhw_binding_of_buffer(rhw_context *context, rhw_buffer buffer, size_t offset,
                                              size_t size, bool read_only, struct rhw_binding *binding);

/// Make a binding of bytes of a buffer as texels, for the image functions. The rules about format and range are those
/// of rhw_pass_set_texel_buffer.
RHW_API enum rhw_result rhw_binding_of_texels(rhw_context *context, rhw_buffer buffer, enum rhw_format format,
                                              size_t offset, size_t size, bool read_only,
                                              struct rhw_binding *binding);

// Bindings of other bindings and of memory. These functions are pure. Any thread may call them at any time, a shader
// function too. They return false, and the binding is empty, where a rule is broken.

/// Make a binding of the texture of one binding with the sampler of another. `texture` comes from
/// rhw_binding_of_texture, and `sampler` from there or from rhw_binding_of_sampler. Each may be `binding` itself. The
/// binding of a multisampled texture has no sampler to give. The rules about the pair are those of
/// rhw_pass_set_texture. Both are of one context.
RHW_API bool rhw_binding_of_pair(const struct rhw_binding *texture, const struct rhw_binding *sampler,
                                 struct rhw_binding *binding);

/// Make a binding of `size` bytes of the program, for the storage functions. `memory` is aligned to 4 bytes, and NULL
/// with a size of 0 alone. Bytes behind the last whole word do not count.
RHW_API bool rhw_binding_of_memory(void *memory, size_t size, bool read_only, struct rhw_binding *binding);

/// Make a binding of `size` bytes of the program as texels, for the image functions. The format is one of colour, and
/// not compressed. `memory` is aligned to the words of its texels: to their size, or to 4 bytes where they are larger.
/// It is NULL with a size of 0 alone. Bytes behind the last whole texel do not count, and no more than
/// RHW_MAX_TEXEL_BUFFER texels do. `isa` is an instruction set that the machine has: rhw_context_isa of a context, or
/// RHW_ISA_BASELINE. It decides how soon texels are decoded, and not what they are.
RHW_API bool rhw_binding_of_texel_memory(enum rhw_isa isa, void *memory, size_t size, enum rhw_format format,
                                         bool read_only, struct rhw_binding *binding);

#endif
