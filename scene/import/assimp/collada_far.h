// SPDX-License-Identifier: MIT
// The two parts of a Collada document that may be far: the positions of its geometries, and the places of its nodes.
#ifndef SCENE_IMPORT_COLLADA_FAR_H
#define SCENE_IMPORT_COLLADA_FAR_H

#include "assimp_exact.h"
#include "edits.h"

/// Read the numbers between two places of a text, no more than `most`, and the blanks behind them. The first place
/// becomes that where the reading ends. Return how many there are. `ends` may be NULL, or gets where each begins and
/// ends.
size_t scene_collada_numbers(const char **text, const char *end, double *numbers, const char *(*ends)[2],
                             size_t most);
/// Collect the changes that positions need. A 0 follows the text.
void scene_collada_edit_geometries(struct scene_import *import, struct scene_assimp_exact *exact, char *text,
                                   size_t size, struct scene_edits *edits);
/// Collect the changes that the places of nodes need.
void scene_collada_edit_nodes(struct scene_import *import, struct scene_assimp_exact *exact, char *text,
                              size_t size, struct scene_edits *edits);
/// Return the unit of a document in metres, by which assimp multiplies all of it. Return 0 where it has none.
double scene_collada_unit(char *text, const char *end);

#endif
