// SPDX-License-Identifier: MIT
// How much of a model a mirror leaves as it is.
#ifndef SCENE_SYMMETRY_H
#define SCENE_SYMMETRY_H

#include "import/builder/import.h"

/// Find, for each axis, the part, 0..1, of the model's vertices that have another vertex, or themselves, where a mirror
/// across the middle of the axis shows them. They may be off by a hundredth of the model's longest side. What is never
/// seen and specks far away do not count.
void scene_symmetry_find(struct scene_import *import, double shares[3]);

#endif
