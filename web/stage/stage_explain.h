// SPDX-License-Identifier: MIT
// The numbers of a fragment as a list of doubles, which hold everything in them exactly: floats, snapped positions and edge
// functions, below 2^53 on a stage.
#ifndef STAGE_EXPLAIN_H
#define STAGE_EXPLAIN_H

#include "rhw/explain.h"

enum { STAGE_MAX_NUMBERS = 80 };

/// See stage_number_names.
int stage_explain_numbers(const struct rhw_explained_fragment *fragment, double numbers[STAGE_MAX_NUMBERS]);

#endif
