// SPDX-License-Identifier: MIT
// A fragment shader of the user's, which shades models instead of their materials.
#ifndef CLI_FRAGMENT_SHADER_H
#define CLI_FRAGMENT_SHADER_H

#include <rhw/spirv.h>

/// A shader that does as little as it may, with all that it may read. It is a text for people to change.
extern const char cli_fragment_shader_template[];

/// Read a file, and link it as scene_view.program wants it. Return NULL after a report.
rhw_shader_program *cli_fragment_shader_open(const char *path);

#endif
