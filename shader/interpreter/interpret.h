// SPDX-License-Identifier: MIT
// The functions that a pipeline has in place of compiled shaders. The pipeline's `user` is a struct shader_stages.
#ifndef SHADER_INTERPRET_H
#define SHADER_INTERPRET_H

#include "bytecode.h"
#include "rhw/isa.h"
#include "rhw/shader.h"

void RHW_ISA_NAME(shader_interpret_vertices)(struct rhw_vertex *groups, int count);
// Groups of a workgroup go through the shader together where it has barriers, so that a barrier needs nothing.
void RHW_ISA_NAME(shader_interpret_workgroup)(struct rhw_workgroup *workgroup);
void RHW_ISA_NAME(shader_interpret_fragments)(struct rhw_fragment *groups, int count);

#endif
