// SPDX-License-Identifier: MIT
// The textures and the storage that a pass sets become the bindings of its draws.
#ifndef RHW_PASS_BINDING_H
#define RHW_PASS_BINDING_H

#include <stdbool.h>

struct rhw_encoder;

// Give the next draw the textures and the storage that are bound, as they are now. Return false when out of memory.
bool rhw_pass_resolve_bindings(struct rhw_encoder *encoder);

#endif
