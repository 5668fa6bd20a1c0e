// SPDX-License-Identifier: MIT
// Images and samplers.
#include "build.h"

bool shader_build_image(struct shader_builder *builder, uint32_t opcode)
{
    (void)builder;
    (void)opcode;
    return false;
}
