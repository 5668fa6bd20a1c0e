// SPDX-License-Identifier: MIT
// Data URIs (RFC 2397): bytes that stand in the place of a file's name.
#ifndef SCENE_DATA_URI_H
#define SCENE_DATA_URI_H

#include "import.h"

bool scene_data_uri_is(const char *name);
/// Return the bytes of a data URI. Line breaks and blanks in it are skipped, digits may be encoded by percent signs,
/// and what follows a question mark or a number sign is left out. Return NULL if the URI is not of base64, or not
/// valid.
unsigned char *scene_data_uri_decode(struct scene_import *import, const char *uri, size_t *size);

#endif
