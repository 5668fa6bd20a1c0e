// SPDX-License-Identifier: MIT
// 8 lines side by side.
#ifndef RHW_LINES8_H
#define RHW_LINES8_H

#include "../../simd.h"

struct lines8 {
    i8 x[2], y[2]; // 24.8
    i8 flags;      // of their triangles
    i8 vertex[2], primitive, segment;
};

#endif
