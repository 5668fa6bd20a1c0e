// SPDX-License-Identifier: MIT
// Letters with accents in UTF-8 are one code point or several: Macintoshes part them in the names of files, and
// archives carry such names to other machines.
#ifndef SCENE_ACCENTS_H
#define SCENE_ACCENTS_H

#include "import.h"

/// Return the name with accents joined to their letters (Unicode's form NFC), or parted from them (NFD), to be freed.
/// Letters that are never composed, which NFC parts too (U+0958 to U+095F, U+09DC and others), stay as they are. Return
/// NULL if it is not UTF-8.
char *scene_accents_join(struct scene_import *import, const char *name);
char *scene_accents_part(struct scene_import *import, const char *name);

#endif
