// SPDX-License-Identifier: MIT
// The table of kernels of one instruction set, which RHW_ISA_SUFFIX names.
#include "kernel_entries.h"

const struct rhw_kernels RHW_ISA_NAME(rhw_kernels) = {
    .shared_part = RHW_ISA_NAME(rhw_shade_shared_part),
    .chunk = RHW_ISA_NAME(rhw_make_chunk),
    .tile = RHW_ISA_NAME(rhw_draw_tile),
    .sample_float = RHW_ISA_NAME(rhw_sample_float),
    .sample_halves = RHW_ISA_NAME(rhw_sample_halves),
    .sample_compared = RHW_ISA_NAME(rhw_sample_compared),
    .compare_window = RHW_ISA_NAME(rhw_compare_window),
    .sample_unorm8 = RHW_ISA_NAME(rhw_sample_unorm8),
    .sample_srgb8 = RHW_ISA_NAME(rhw_sample_srgb8),
    .sample_unorm8_general = RHW_ISA_NAME(rhw_sample_unorm8_general),
    .sample_srgb8_general = RHW_ISA_NAME(rhw_sample_srgb8_general),
    .sample_groups = RHW_ISA_NAME(rhw_sample_groups),
    .sample_general = RHW_ISA_NAME(rhw_sample_general),
    .sample_anisotropic = RHW_ISA_NAME(rhw_sample_anisotropic),
    .sample_fixed_anisotropic = RHW_ISA_NAME(rhw_sample_fixed_anisotropic),
    .sample_fixed_anisotropic_general = RHW_ISA_NAME(rhw_sample_fixed_anisotropic_general),
    .sample_axis_groups = RHW_ISA_NAME(rhw_sample_axis_groups),
    .sample_biased = RHW_ISA_NAME(rhw_sample_biased),
    .gather = RHW_ISA_NAME(rhw_gather_texels),
    .fetch = RHW_ISA_NAME(rhw_fetch_texels),
    .query_level = RHW_ISA_NAME(rhw_query_level),
    .query_size = RHW_ISA_NAME(rhw_query_size),
    .fetch_sample = RHW_ISA_NAME(rhw_fetch_sample_texels),
    .image_load = RHW_ISA_NAME(rhw_load_image),
    .image_store = RHW_ISA_NAME(rhw_store_image),
    .mip_band = RHW_ISA_NAME(rhw_make_mip_band),
    .mip_slice = RHW_ISA_NAME(rhw_make_mip_slice),
    .blit_band = RHW_ISA_NAME(rhw_blit_band),
    .resolve_band = RHW_ISA_NAME(rhw_resolve_band)};
