// SPDX-License-Identifier: MIT
// Compiled once per instruction set, with RHW_ISA_SUFFIX naming it.
#include "kernels.h"

#include "front_tmpl.h"
#include "sample_entry.h"
#include "tile_entry.h"

const struct rhw_kernels RHW_ISA_NAME(rhw_kernels) = {
    .shared_part = shade_part,
    .chunk = make_chunk,
    .tile = RHW_ISA_NAME(rhw_draw_tile),
    .sample_float = RHW_ISA_NAME(rhw_sample_float),
    .sample_unorm8 = RHW_ISA_NAME(rhw_sample_unorm8),
    .sample_srgb8 = RHW_ISA_NAME(rhw_sample_srgb8),
    .sample_unorm8_general = RHW_ISA_NAME(rhw_sample_unorm8_general),
    .sample_srgb8_general = RHW_ISA_NAME(rhw_sample_srgb8_general),
    .sample_groups = RHW_ISA_NAME(rhw_sample_groups)};
