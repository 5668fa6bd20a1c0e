// SPDX-License-Identifier: MIT
// See shader_name.h.
#include "shader_name.h"

#include <stdio.h>

static const char *const scalars[] = {"float", "int", "uint"}, *const letters[] = {"", "i", "u"};

// Write the type of a number, vector or matrix.
static void name_number(const struct rhw_shader_type *type, char name[32])
{
    const char *const narrow = type->bits == 8 ? "8" : type->bits == 16 ? "16" : "";
    if (type->columns > 1) {
        snprintf(name, 32, "mat%ux%u", (unsigned)type->columns, (unsigned)type->rows);
    } else if (type->rows > 1) {
        snprintf(name, 32, "%svec%u%s%s", letters[type->kind], (unsigned)type->rows, narrow[0] ? " of " : "",
                 narrow);
    } else {
        snprintf(name, 32, "%s%s", scalars[type->kind], narrow);
    }
}

void cli_shader_name_type(const struct rhw_shader_type *type, char name[CLI_SHADER_TYPE_NAME])
{
    char lengths[64] = "", inner[32];
    size_t length = 0;
    for (; type->kind == RHW_SHADER_ARRAY; type = type->element) {
        char one[16] = "[]";
        if (type->count > 0) {
            snprintf(one, sizeof one, "[%u]", (unsigned)type->count);
        }
        if (length + sizeof one < sizeof lengths) {
            length += (size_t)snprintf(lengths + length, sizeof lengths - length, "%s", one);
        }
    }
    if (type->kind == RHW_SHADER_STRUCT) {
        snprintf(name, CLI_SHADER_TYPE_NAME, "%.80s%s", type->name[0] ? type->name : "struct", lengths);
    } else {
        name_number(type, inner);
        snprintf(name, CLI_SHADER_TYPE_NAME, "%s%s", inner, lengths);
    }
}

static enum rhw_shader_type_kind kind_of(bool is_integer, bool is_signed)
{
    return !is_integer ? RHW_SHADER_FLOAT : is_signed ? RHW_SHADER_INT : RHW_SHADER_UINT;
}

void cli_shader_name_variable(const struct rhw_shader_variable *variable, char name[CLI_SHADER_TYPE_NAME])
{
    const struct rhw_shader_type type = {.kind = kind_of(variable->is_integer, variable->is_signed),
                                         .bits = 32,
                                         .rows = variable->components,
                                         .columns = 1};
    cli_shader_name_type(&type, name);
}

// Return what the name of an image begins with, or NULL for what is no image.
static const char *noun_of(const struct rhw_shader_resource *resource)
{
    switch (resource->kind) {
    case RHW_SHADER_SAMPLED_TEXTURE: return "sampler";
    case RHW_SHADER_TEXTURE: return "texture";
    case RHW_SHADER_STORAGE_IMAGE: return "image";
    case RHW_SHADER_TEXEL_BUFFER: // what is sampled has no format
        return resource->format != 0 || !resource->is_read_only ? "image" : "sampler";
    case RHW_SHADER_INPUT_ATTACHMENT: return "subpassInput";
    default: return NULL;
    }
}

void cli_shader_name_image(const struct rhw_shader_resource *resource, char name[CLI_SHADER_TYPE_NAME])
{
    static const char *const dimensions[] = {
        [RHW_TEXTURE_1D] = "1D", [RHW_TEXTURE_2D] = "2D", [RHW_TEXTURE_3D] = "3D", [RHW_TEXTURE_CUBE] = "Cube"};
    const char *const noun = noun_of(resource);
    const char *const dimension = resource->kind == RHW_SHADER_TEXEL_BUFFER ? "Buffer"
                                  : resource->kind == RHW_SHADER_INPUT_ATTACHMENT
                                      ? ""
                                      : dimensions[resource->texture_kind];
    name[0] = 0;
    if (noun) {
        snprintf(name, CLI_SHADER_TYPE_NAME, "%s%s%s%s%s%s",
                 letters[kind_of(resource->is_integer, resource->is_signed)], noun, dimension,
                 resource->is_multisampled ? "MS" : "", resource->is_array ? "Array" : "",
                 resource->is_depth ? "Shadow" : "");
    }
}

const char *cli_shader_constant_type(const struct rhw_shader_constant_info *constant)
{
    static const char *const narrow[2][3] = {{"float16", "int8", "uint8"}, {"float16", "int16", "uint16"}};
    return constant->is_bool      ? "bool"
           : constant->bits == 32 ? scalars[constant->kind]
                                  : narrow[constant->bits == 16][constant->kind];
}

const char *cli_shader_format_name(const struct rhw_shader_resource *resource)
{
    // By the numbers of SPIR-V.
    static const char *const names[] = {"",          "rgba32f",      "rgba16f",
                                        "r32f",      "rgba8",        "rgba8_snorm",
                                        "rg32f",     "rg16f",        "r11f_g11f_b10f",
                                        "r16f",      "rgba16",       "rgb10_a2",
                                        "rg16",      "rg8",          "r16",
                                        "r8",        "rgba16_snorm", "rg16_snorm",
                                        "rg8_snorm", "r16_snorm",    "r8_snorm",
                                        "rgba32i",   "rgba16i",      "rgba8i",
                                        "r32i",      "rg32i",        "rg16i",
                                        "rg8i",      "r16i",         "r8i",
                                        "rgba32ui",  "rgba16ui",     "rgba8ui",
                                        "r32ui",     "rgb10_a2ui",   "rg32ui",
                                        "rg16ui",    "rg8ui",        "r16ui",
                                        "r8ui"};
    return resource->format < sizeof names / sizeof *names ? names[resource->format] : "";
}
