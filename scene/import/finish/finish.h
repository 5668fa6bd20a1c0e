// SPDX-License-Identifier: MIT
// An import from its reader to a whole model.
#ifndef SCENE_FINISH_H
#define SCENE_FINISH_H

#include "import/builder/import.h"

/// Call import->read and complete the model. The result may be sent to the parent.
void scene_import_run(struct scene_import *import);

#endif
