// SPDX-License-Identifier: MIT
// The files inside a ZIP archive. What an entry claims to be is compared with the bytes that it has before any memory
// is asked for: an archive that claims a terabyte is refused by its claim.
#ifndef SCENE_IMPORT_ZIP_H
#define SCENE_IMPORT_ZIP_H

#include "import/builder/import.h"

struct scene_zip;

/// Opens the archive at import->model.path; fails the import where it is none.
struct scene_zip *scene_zip_open(struct scene_import *import);
/// Opens the entry of this name (case is ignored, as by the Open Packaging Conventions); false where there is none.
/// Fails the import where what it claims cannot be.
bool scene_zip_enter(struct scene_zip *zip, const char *name, size_t *size);
/// Reads up to `size` bytes of the open entry; 0 at its end. Fails the import where it is damaged.
size_t scene_zip_read(struct scene_zip *zip, void *bytes, size_t size);
/// The whole of an entry, followed by a 0; NULL where there is none.
void *scene_zip_read_all(struct scene_zip *zip, const char *name, size_t *size);
/// The first name with this ending; NULL where there is none.
const char *scene_zip_find_ending(struct scene_zip *zip, const char *ending);

#endif
