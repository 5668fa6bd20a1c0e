// SPDX-License-Identifier: MIT
// What GLSL calls types, images and their formats.
#ifndef CLI_SHADER_NAME_H
#define CLI_SHADER_NAME_H

#include <rhw/spirv.h>

enum { CLI_SHADER_TYPE_NAME = 160 };

/// Write the name of a type in memory, with the lengths of its arrays.
void cli_shader_name_type(const struct rhw_shader_type *type, char name[CLI_SHADER_TYPE_NAME]);
/// Write the name of the type of an input or output.
void cli_shader_name_variable(const struct rhw_shader_variable *variable, char name[CLI_SHADER_TYPE_NAME]);
/// Write the name of an image's type, sampler2DArrayShadow for instance, or "" for what is no image.
void cli_shader_name_image(const struct rhw_shader_resource *resource, char name[CLI_SHADER_TYPE_NAME]);
/// Return the name of a constant's type.
const char *cli_shader_constant_type(const struct rhw_shader_constant_info *constant);
/// Return the name of the format that the module gives an image's texels, or "".
const char *cli_shader_format_name(const struct rhw_shader_resource *resource);

#endif
