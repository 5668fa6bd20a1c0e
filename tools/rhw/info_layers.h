// SPDX-License-Identifier: MIT
// What rhw info tells of the layers of a material.
#ifndef CLI_INFO_LAYERS_H
#define CLI_INFO_LAYERS_H

#include "model.h"

/// A function that is given a number of the layers, or three, under its name in rhw info.
typedef void cli_layer_teller(const char *name, const float *values, int count);

/// Calls `tell` for each number that is not what a material without layers has, in a fixed order; not for one that uses
/// none.
void cli_info_layers(const struct scene_layers *layers, cli_layer_teller *tell);

#endif
