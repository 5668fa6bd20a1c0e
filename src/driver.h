// SPDX-License-Identifier: MIT
// The door for the Vulkan driver, which contains the library and is compiled with it: what programs have no need of. It
// is not installed.
#ifndef RHW_DRIVER_H
#define RHW_DRIVER_H

#include "rhw/rhw.h"

// Tell the layout of a texture as rhw_texture_query_layout does, on any thread. The definition is valid.
void rhw_driver_texture_layout(const struct rhw_texture_def *def, struct rhw_texture_layout *layout);

// Return true if rhw_pipeline_create takes a definition. Call `tell` with the reason, and return false, if it does not.
// Any thread may call this.
bool rhw_driver_pipeline_check(const struct rhw_pipeline_def *def,
                               void (*tell)(void *user, const char *message));

#endif
