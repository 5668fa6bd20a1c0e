// SPDX-License-Identifier: MIT
// The files inside a ZIP archive. The size that an entry claims is compared with the bytes that it has before any
// memory is asked for: an archive that claims a terabyte is refused by its claim.
#ifndef SCENE_IMPORT_ZIP_H
#define SCENE_IMPORT_ZIP_H

#include "import.h"

struct scene_zip;

/// Open the archive at import->model.path. Fail the import if it is none.
struct scene_zip *scene_zip_open(struct scene_import *import);
/// Open the entry of this name (case is ignored, as by the Open Packaging Conventions). Return false if there is none.
/// Fail the import if what the entry claims cannot be.
bool scene_zip_enter(struct scene_zip *zip, const char *name, size_t *size);
/// Read up to `size` bytes of the open entry. Return 0 at its end. Fail the import if it is damaged.
size_t scene_zip_read(struct scene_zip *zip, void *bytes, size_t size);
/// Return the whole of an entry, followed by a 0. Return NULL if there is none.
void *scene_zip_read_all(struct scene_zip *zip, const char *name, size_t *size);
/// Return the first name with this ending. Return NULL if there is none.
const char *scene_zip_find_ending(struct scene_zip *zip, const char *ending);

#endif
