// SPDX-License-Identifier: MIT
// The functions in the table of kernels, by their names in this instruction set. kernels.h tells what they do.
#ifndef RHW_KERNEL_ENTRIES_H
#define RHW_KERNEL_ENTRIES_H

#include "kernels.h"

// geometry.c defines this function and the next.
bool RHW_ISA_NAME(rhw_make_chunk)(const struct rhw_wave *wave, struct rhw_chunk *chunk, int worker);
void RHW_ISA_NAME(rhw_shade_shared_part)(const struct rhw_wave *wave, const struct rhw_shared_part *part,
                                         int worker);
// tile.c defines this function.
void RHW_ISA_NAME(rhw_draw_tile)(const struct rhw_wave *wave, int tile, int worker);
// sample.c defines these functions.
rhw_sample_function RHW_ISA_NAME(rhw_sample_float);
rhw_sample_function RHW_ISA_NAME(rhw_sample_halves);
rhw_sample_function RHW_ISA_NAME(rhw_sample_compared);
rhw_compare_window_function RHW_ISA_NAME(rhw_compare_window);
rhw_sample_function RHW_ISA_NAME(rhw_sample_unorm8);
rhw_sample_function RHW_ISA_NAME(rhw_sample_srgb8);
rhw_sample_function RHW_ISA_NAME(rhw_sample_unorm8_general);
rhw_sample_function RHW_ISA_NAME(rhw_sample_srgb8_general);
rhw_sample_groups_function RHW_ISA_NAME(rhw_sample_groups);
// sample_general.c defines these functions.
rhw_sample_function RHW_ISA_NAME(rhw_sample_general);
rhw_sample_function RHW_ISA_NAME(rhw_sample_anisotropic);
rhw_sample_function RHW_ISA_NAME(rhw_sample_fixed_anisotropic);
rhw_sample_function RHW_ISA_NAME(rhw_sample_fixed_anisotropic_general);
rhw_sample_axis_groups_function RHW_ISA_NAME(rhw_sample_axis_groups);
rhw_sample_function RHW_ISA_NAME(rhw_sample_biased);
rhw_gather_function RHW_ISA_NAME(rhw_gather_texels);
rhw_fetch_function RHW_ISA_NAME(rhw_fetch_texels);
rhw_query_level_function RHW_ISA_NAME(rhw_query_level);
rhw_query_size_function RHW_ISA_NAME(rhw_query_size);
rhw_fetch_sample_function RHW_ISA_NAME(rhw_fetch_sample_texels);
rhw_image_load_function RHW_ISA_NAME(rhw_load_image);
rhw_image_store_function RHW_ISA_NAME(rhw_store_image);
// mip_band.c defines these functions.
void RHW_ISA_NAME(rhw_make_mip_band)(const struct rhw_mip_job *job, int index, int worker);
void RHW_ISA_NAME(rhw_make_mip_slice)(const struct rhw_mip_volume_job *job, int index, int worker);
// transfer.c defines these functions.
void RHW_ISA_NAME(rhw_blit_band)(const struct rhw_blit_job *job, int index);
void RHW_ISA_NAME(rhw_resolve_band)(const struct rhw_resolve_job *job, int index);

#endif
