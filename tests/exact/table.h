// SPDX-License-Identifier: MIT
// The measured errors as a Markdown table, and the file that keeps it.
#ifndef EXACT_TABLE_H
#define EXACT_TABLE_H

#include <stdbool.h>
#include <stdio.h>

#include "judge.h"

struct table_column {
    const char *name;  // of the renderer
    const char *title; // the same with its version
    const struct judge_results *results;
};

// A row per quantity; then, folded, one table per quantity with a row per family and one per kind of vertex values. A
// column per renderer, at most 8, the first ours. `bound`: what is asserted of it, per quantity.
void table_print(FILE *out, const struct table_column *columns, int count, const double *bound);
// Replaces what stands between the marker lines of `path`; false with a line on stderr when that fails.
bool table_write(const char *path, const struct table_column *columns, int count, const double *bound);

#endif
