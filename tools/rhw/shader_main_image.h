// SPDX-License-Identifier: MIT
// Texts as ShaderToy has them: mainImage() gives the colour of a pixel, whose y points up, and nothing declares the
// uniforms.
#ifndef CLI_SHADER_MAIN_IMAGE_H
#define CLI_SHADER_MAIN_IMAGE_H

#include <stdbool.h>
#include <stddef.h>

struct cli_shader_main_image {
    size_t size;      ///< bytes of `text`
    char *text;       ///< text with a main() behind it, by malloc; NULL: it has one, or no mainImage()
    char before[512]; ///< declarations of what it may name and does not declare
};

/// Look for mainImage() in a text of `size` bytes with a 0 behind them. Return false if memory is out.
bool cli_shader_main_image(const char *text, size_t size, struct cli_shader_main_image *made);

#endif
