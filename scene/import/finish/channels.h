// SPDX-License-Identifier: MIT
// One image of the channels of others.
#ifndef SCENE_CHANNELS_H
#define SCENE_CHANNELS_H

#include "import/builder/import.h"

/// Makes an image of others that are decoded; false where none could be read.
bool scene_import_join_channels(struct scene_import *import, struct scene_image *image,
                                const struct scene_import_channels *channels);

#endif
