// SPDX-License-Identifier: MIT
// Uniforms that the program knows by their names, which are those of ShaderToy.
#ifndef CLI_SHADER_UNIFORMS_H
#define CLI_SHADER_UNIFORMS_H

#include "shader_resources.h"

/// Set the members of a block, which may be NULL, that have such a name, in its `size` bytes. The sizes of textures are
/// those of `resources`.
void cli_shader_uniforms_set(const struct rhw_shader_type *block, const struct cli_shader_job *job,
                             const struct cli_shader_resources *resources, void *memory, size_t size);

#endif
