// SPDX-License-Identifier: MIT
// The folders that have kernel checks, one line each: the tables of the files check_*.c.
#ifndef KERNEL_FOLDERS_H
#define KERNEL_FOLDERS_H

#include "kernel_check.h"
#include "rhw/isa.h"

RHW_ISA_DECLARE(const struct kernel_folder, check_simd);
RHW_ISA_DECLARE(const struct kernel_folder, check_simd_layout);
RHW_ISA_DECLARE(const struct kernel_folder, check_raster);
RHW_ISA_DECLARE(const struct kernel_folder, check_plane);
RHW_ISA_DECLARE(const struct kernel_folder, check_depth);
RHW_ISA_DECLARE(const struct kernel_folder, check_fragment);
RHW_ISA_DECLARE(const struct kernel_folder, check_blend);
RHW_ISA_DECLARE(const struct kernel_folder, check_geometry);
RHW_ISA_DECLARE(const struct kernel_folder, check_chunk);
RHW_ISA_DECLARE(const struct kernel_folder, check_tile);
RHW_ISA_DECLARE(const struct kernel_folder, check_draw);
RHW_ISA_DECLARE(const struct kernel_folder, check_sample);
RHW_ISA_DECLARE(const struct kernel_folder, check_texel);
RHW_ISA_DECLARE(const struct kernel_folder, check_words);

// All of one instruction set, then NULL.
struct kernel_folders {
    const struct kernel_folder *folders[16];
};

RHW_ISA_DECLARE(const struct kernel_folders, kernel_folders);

#endif
