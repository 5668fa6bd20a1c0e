// SPDX-License-Identifier: MIT
// Points and lines, made of a scene's vertices in view: coverage, point coordinates, values along lines and depth, against
// exact arithmetic.
#ifndef EXACT_PRIMITIVE_JUDGE_H
#define EXACT_PRIMITIVE_JUDGE_H

#include "judge.h"

struct primitive_judge;

// NULL when the context cannot be created.
struct primitive_judge *primitive_judge_create(enum rhw_isa isa);
void primitive_judge_destroy(struct primitive_judge *judge);
// Draws the scene's corners as points and its edges as lines, rectangular and Bresenham, and adds what it finds to
// `results`. False when nothing can be drawn.
bool primitive_judge_compare(struct primitive_judge *judge, const struct scene *scene,
                             struct judge_results *results);

#endif
