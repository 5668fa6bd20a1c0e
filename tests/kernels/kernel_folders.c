// SPDX-License-Identifier: MIT
// See kernel_folders.h; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "kernel_folders.h"

const struct kernel_folders RHW_ISA_NAME(kernel_folders) = {.folders = {
                                                                &RHW_ISA_NAME(check_simd),
                                                                &RHW_ISA_NAME(check_simd_layout),
                                                                &RHW_ISA_NAME(check_raster),
                                                                &RHW_ISA_NAME(check_plane),
                                                                &RHW_ISA_NAME(check_depth),
                                                                &RHW_ISA_NAME(check_fragment),
                                                                &RHW_ISA_NAME(check_blend),
                                                                &RHW_ISA_NAME(check_geometry),
                                                                &RHW_ISA_NAME(check_chunk),
                                                                &RHW_ISA_NAME(check_tile),
                                                                &RHW_ISA_NAME(check_draw),
                                                                &RHW_ISA_NAME(check_sample),
                                                                &RHW_ISA_NAME(check_texel),
                                                                &RHW_ISA_NAME(check_words),
                                                            }};
