// SPDX-License-Identifier: MIT
// Compiled once per instruction set, with RHW_ISA_SUFFIX naming it.
#include "kernels.h"

#include "geometry_entry.h"
#include "sample_slots_tmpl.h"
#include "tile_entry.h"

const struct rhw_kernels RHW_ISA_NAME(rhw_kernels) = {.shared_part = RHW_ISA_NAME(rhw_shade_shared_part),
                                                      .chunk = RHW_ISA_NAME(rhw_make_chunk),
                                                      .tile = RHW_ISA_NAME(rhw_draw_tile),
                                                      .sample_other = sample_other,
                                                      .sample_rgba8 = sample_rgba8,
                                                      .sample_rgba8_srgb = sample_rgba8_srgb,
                                                      .sample_slots = sample_slots,
                                                      .sample_groups = sample_groups};
