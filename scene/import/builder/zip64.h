// SPDX-License-Identifier: MIT
// Archives whose sizes are in the fields of ZIP64.
#ifndef SCENE_IMPORT_ZIP64_H
#define SCENE_IMPORT_ZIP64_H

#include <minizip/unzip.h>

#include "import.h"

/// Open an archive for minizip. Return NULL if it is none.
unzFile scene_zip64_open(struct scene_import *import, const char *path);

#endif
