// SPDX-License-Identifier: MIT
// The numbers of a fragment as a list of doubles, which hold everything in them exactly: floats, snapped positions and edge
// functions, below 2^53 on a stage.
#ifndef STAGE_EXPLAIN_H
#define STAGE_EXPLAIN_H

#include "rhw/explain.h"

enum { STAGE_MAX_NUMBERS = 80 };

/// See stage_number_names. `method`: enum stage_method. Returns where the numbers by way of the world begin, without values.
int stage_explain_numbers(const struct rhw_explained_fragment *fragment, int method,
                          double numbers[STAGE_MAX_NUMBERS]);
/// Sets what a fragment told by way of the world, in the numbers that begin at `world`; `told`: enum stage_told.
void stage_explain_told(const struct rhw_explained_fragment *fragment, int told, double *world);

#endif
