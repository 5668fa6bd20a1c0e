// SPDX-License-Identifier: MIT
// The program's word on whether work goes on (rhw_context_set_goes_on).
#ifndef RHW_GIVEN_UP_H
#define RHW_GIVEN_UP_H

#include "context.h"

// Begin work that nobody has given up.
void rhw_context_begin_work(struct rhw_context *context);

// Bytes that a copy moves between two questions, in some 200 µs.
enum { RHW_ASKED_BYTES = 1 << 20 };

// Return true if the program gives up the work that is under way. A task asks before it begins. Worker 0 asks the
// program, on the program's own thread; the others hear of it.
bool rhw_context_is_given_up(struct rhw_context *context, int worker);

// Return true if the program gives up the work that is under way. A shader function asks while it runs, on any thread,
// some thousand times a second. The program itself is asked every 10 ms.
bool rhw_context_is_given_up_within(struct rhw_context *context);

// Return true if the program gives up the work that is under way. A task of a pass asks before each call of a shader
// function, for `groups` groups. The program itself is asked every 10 ms, or before each call that takes longer.
bool rhw_context_is_given_up_amid(struct rhw_context *context, int worker, int groups);

#endif
