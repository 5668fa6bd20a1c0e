// SPDX-License-Identifier: MIT
// A fragment shader that shades models instead of their materials, as scene/draw/material_program.h has it: what it
// finds where, and the program that it is linked to.
#ifndef CLI_FRAGMENT_PROGRAM_H
#define CLI_FRAGMENT_PROGRAM_H

#include <rhw/spirv.h>
#include <stdbool.h>

enum { CLI_FRAGMENT_INPUTS = 4, CLI_FRAGMENT_MEMBERS = 8 };

/// An input at a location, or a member of the uniform block at an offset: so many floats.
struct cli_fragment_known {
    const char *name;
    uint32_t number, rows;
};

extern const struct cli_fragment_known cli_fragment_inputs[CLI_FRAGMENT_INPUTS]; ///< by location
extern const struct cli_fragment_known cli_fragment_members[CLI_FRAGMENT_MEMBERS];

/// What messages about these end with.
extern const char cli_fragment_hint[];

/// Link a fragment shader as scene_view.program wants it. `path` is what messages call it. Uniforms of one that
/// `is_relaxed` stand where their names belong, so that their types have to be those of the block. Return NULL after a
/// report.
rhw_shader_program *cli_fragment_program_create(const char *path, const rhw_shader *fragment,
                                                bool is_relaxed);

#endif
