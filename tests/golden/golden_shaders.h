// SPDX-License-Identifier: MIT
// Shaders of the golden scenes, compiled once per instruction set.
#ifndef GOLDEN_SHADERS_H
#define GOLDEN_SHADERS_H

#include <rhw/isa.h>
#include <rhw/rhw.h>

enum golden_shader {
    GOLDEN_LIT,     ///< a lit, patterned ball: most of the shader maths
    GOLDEN_TEXTURE, ///< trilinear texture times a colour
    GOLDEN_GLASS,   ///< a colour with alpha, discarded in stripes
    GOLDEN_SHADER_COUNT
};

struct golden_uniforms {
    float matrix[16]; ///< column major, to clip space
    float eye[4], light[4];
};

/// Attribute 0 is the position (3 floats), attribute 1 four values; varyings are the position, then those.
void golden_shaders_fill(struct rhw_program *program, enum golden_shader shader);

// One per instruction set; golden_shaders_fill is who calls them.
typedef void golden_shaders_function(struct rhw_program *program, enum rhw_isa isa,
                                     enum golden_shader shader);
RHW_ISA_DECLARE(golden_shaders_function, golden_shaders);

#endif
