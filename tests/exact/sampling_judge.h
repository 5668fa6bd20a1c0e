// SPDX-License-Identifier: MIT
// Values away from the centres of pixels: at every sample, at centroids, and at offsets (rhw_interpolate_at), against the
// oracle at the very place that is promised.
#ifndef EXACT_SAMPLING_JUDGE_H
#define EXACT_SAMPLING_JUDGE_H

#include "judge.h"

struct sampling_judge;

// NULL when the context cannot be created.
struct sampling_judge *sampling_judge_create(enum rhw_isa isa);
void sampling_judge_destroy(struct sampling_judge *judge);
// Draws the scene with 2, 4, 8 or 16 samples, as its index has it, and adds what it finds to `results`. False when nothing
// can be drawn.
bool sampling_judge_compare(struct sampling_judge *judge, const struct scene *scene,
                            struct judge_results *results);

#endif
