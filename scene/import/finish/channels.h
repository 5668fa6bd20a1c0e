// SPDX-License-Identifier: MIT
// One image made of channels of others.
#ifndef SCENE_CHANNELS_H
#define SCENE_CHANNELS_H

#include "import/builder/import.h"

/// Make an image of other images that are decoded. Return false if none could be read.
bool scene_import_join_channels(struct scene_import *import, struct scene_image *image,
                                const struct scene_import_channels *channels);

#endif
