// SPDX-License-Identifier: MIT
// An import from its reader to a whole model.
#ifndef SCENE_FINISH_H
#define SCENE_FINISH_H

#include "import/builder/import.h"

/// Calls import->read, then completes the model. What comes out may be sent to the parent.
void scene_import_run(struct scene_import *import);

#endif
