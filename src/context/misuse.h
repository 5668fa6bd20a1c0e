// SPDX-License-Identifier: MIT
// What the library tells the program through the hooks of a context: misuse, and lines of the log.
#ifndef RHW_MISUSE_H
#define RHW_MISUSE_H

#include "rhw/types.h"

__attribute__((format(printf, 3, 4))) void rhw_context_log(const struct rhw_context *context,
                                                           enum rhw_log_level level, const char *format, ...);

// A warning about what was recorded earlier, which is named behind it.
struct rhw_recording;
void rhw_context_warn_at(const struct rhw_context *context, const struct rhw_recording *place,
                         const char *text);

// Reports misuse: formats the message and calls the assert hook (the default one when `context` is NULL).
// Messages read "rhw_function: what has which value; the rule". While a pass is recorded they go on with where in it,
// and its end will be an error.
__attribute__((format(printf, 2, 3), cold)) void rhw_misuse(const struct rhw_context *context,
                                                            const char *format, ...);
// The same with what was recorded earlier as the place.
__attribute__((format(printf, 3, 4), cold)) void rhw_misuse_at(const struct rhw_context *context,
                                                               const struct rhw_recording *place,
                                                               const char *format, ...);
// The same for a call that could not enter the context: it does not look at what another thread may be changing.
__attribute__((format(printf, 2, 3), cold)) void rhw_misuse_outside(const struct rhw_context *context,
                                                                    const char *format, ...);
// Reports misuse when `condition` is false; is `condition`. A macro, because a draw passes a dozen of these: a call
// with arguments for a message that nobody needs took a fifth of the time of recording.
#define rhw_check(context, condition, ...) ((condition) || (rhw_misuse((context), __VA_ARGS__), false))

#endif
