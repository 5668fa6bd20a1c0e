// SPDX-License-Identifier: MIT
// See isa_shaders.h; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "isa_shaders.h"

#include <rhw/shader.h>

void RHW_ISA_NAME(isa_shader_vertex)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
            groups[g].varying[c] = groups[g].attribute[1][c];
        }
    }
}

void RHW_ISA_NAME(isa_shader_fragment)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float *v = groups[g].varying;
        groups[g].color[0][0] = v[0] * v[1] + v[2];
        groups[g].color[0][1] = v[1] * v[2] + v[0] * v[3] + v[1];
        groups[g].color[0][2] = v[0] / (v[1] * v[1] + 1.0f);
        groups[g].color[0][3] = rhw_select(v[2] < v[3], v[2] * v[2] + v[3], v[3] - v[2] * v[0]);
    }
}
