// SPDX-License-Identifier: MIT
// The switch between special paths, which are faster for some triangles or vertices, and the general path, which takes
// all of them. Both draw the same bytes; rhw_paths tells how a program sets it.
#ifndef RHW_PATHS_H
#define RHW_PATHS_H

#include "../pass_state.h"

static inline bool takes_special_paths(const struct rhw_pass_state *pass)
{
    return pass->paths != RHW_PATHS_GENERAL;
}

#endif
