// SPDX-License-Identifier: MIT
// Shaders that are compiled once per instruction set, as a program does that wants them fast: the tests
// check that every copy draws the same bytes.
#ifndef TEST_ISA_SHADERS_H
#define TEST_ISA_SHADERS_H

#include <rhw/isa.h>
#include <rhw/rhw.h>

/// Fills every entry of `program->vertex` and `program->fragment` that this build has.
/// Vertex: clip position from attribute 0, varyings 0..3 from attribute 1.
/// Fragment: arithmetic that contraction or a reassociated sum would change, on varyings 0..3.
void isa_shaders_fill(struct rhw_program *program);

RHW_ISA_DECLARE(rhw_vertex_function, isa_shader_vertex);
RHW_ISA_DECLARE(rhw_fragment_function, isa_shader_fragment);

#endif
