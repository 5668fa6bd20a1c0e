// SPDX-License-Identifier: MIT
// The clipped polygon of a triangle in rational arithmetic, for the oracle alone.
#ifndef EXACT_ORACLE_CLIP_H
#define EXACT_ORACLE_CLIP_H

#include "oracle.h"

// Cuts the triangle with near, far and the four sides of the guard band and snaps what is left into
// corner_24_8. Sets corner_count, clipped and ambiguous.
void oracle_clip(struct oracle_triangle *t);

#endif
