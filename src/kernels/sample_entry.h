// SPDX-License-Identifier: MIT
// The sampler's functions in the table of kernels, by their names in this instruction set: kernels.h tells what they do.
#ifndef RHW_SAMPLE_ENTRY_H
#define RHW_SAMPLE_ENTRY_H

#include "rhw/isa.h"
#include "kernels.h"

rhw_sample_function RHW_ISA_NAME(rhw_sample_float);
rhw_sample_function RHW_ISA_NAME(rhw_sample_unorm8);
rhw_sample_function RHW_ISA_NAME(rhw_sample_srgb8);
rhw_sample_function RHW_ISA_NAME(rhw_sample_unorm8_general);
rhw_sample_function RHW_ISA_NAME(rhw_sample_srgb8_general);
rhw_sample_groups_function RHW_ISA_NAME(rhw_sample_groups);

#endif
