// SPDX-License-Identifier: MIT
// What the library tells the program through the hooks of a context: misuse, and lines of the log.
#ifndef RHW_MISUSE_H
#define RHW_MISUSE_H

#include "rhw/types.h"

__attribute__((format(printf, 3, 4))) void rhw_context_log(const struct rhw_context *context,
                                                           enum rhw_log_level level, const char *format, ...);

// Log a warning about something that was recorded earlier. Its place is named behind the warning.
struct rhw_recording_place;
void rhw_context_warn_at(const struct rhw_context *context, const struct rhw_recording_place *place,
                         const char *text);

// Report misuse: format the message and call the assert hook (the default one when `context` is NULL). Messages read
// "rhw_function: what has which value; the rule". While a pass is recorded the message goes on with the place in it,
// and the end of the pass will be an error.
__attribute__((format(printf, 2, 3), cold)) void rhw_misuse(const struct rhw_context *context,
                                                            const char *format, ...);
// Report misuse with something that was recorded earlier as the place.
__attribute__((format(printf, 3, 4), cold)) void rhw_misuse_at(const struct rhw_context *context,
                                                               const struct rhw_recording_place *place,
                                                               const char *format, ...);
// Report misuse of a call that could not enter the context. It does not look at what another thread may be changing.
__attribute__((format(printf, 2, 3), cold)) void rhw_misuse_outside(const struct rhw_context *context,
                                                                    const char *format, ...);
// Report misuse when `condition` is false. Return `condition`. This is a macro because a draw passes a dozen of these
// checks: a call with arguments for a message that nobody needs took a fifth of the time of recording.
#define rhw_check(context, condition, ...) ((condition) || (rhw_misuse((context), __VA_ARGS__), false))

#endif
