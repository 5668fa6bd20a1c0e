// SPDX-License-Identifier: MIT
// A blur of 3 × 3 texels, as a fragment function and as a workgroup function.
#ifndef BENCH_DISPATCH_BLUR_H
#define BENCH_DISPATCH_BLUR_H

#include <rhw/isa.h>
#include <rhw/rhw.h>

RHW_ISA_DECLARE(rhw_vertex_function, bench_cover);
RHW_ISA_DECLARE(rhw_fragment_function, bench_blur_fragments);
RHW_ISA_DECLARE(rhw_workgroup_function, bench_blur_workgroup);
RHW_ISA_DECLARE(rhw_workgroup_function, bench_do_nothing);

#endif
