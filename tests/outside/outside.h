// SPDX-License-Identifier: MIT
// What the programs of this folder share: a number made of a picture, and checks. The environment says what contexts
// they draw with: OUTSIDE_THREADS is a number, OUTSIDE_ISA the name of the highest instruction set, and OUTSIDE_VALIDATE
// is "on" or "off".
#ifndef OUTSIDE_H
#define OUTSIDE_H

#include "picture.h"

/// What the environment says, and the library's defaults for what it leaves open.
struct rhw_context_def outside_context_def(void);

/// Notes what was worked out by hand: where it does not hold, `sentence` is said.
void check(bool holds, const char *sentence);

/// The status that the program ends with: 0 if every check held.
int outside_status(void);

/// Prints `name` and FNV-1a of the texels of level 0. Returns the texels, for the caller to free.
void *outside_show(rhw_context *context, const char *name, rhw_texture texture);

#endif
