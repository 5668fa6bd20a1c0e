// SPDX-License-Identifier: MIT
// How a message reads, wherever it goes: standard error, or the caller of the WebAssembly module.
#ifndef CLI_MESSAGE_LINE_H
#define CLI_MESSAGE_LINE_H

#include <stdarg.h>

enum { CLI_MESSAGE_LINE = 2048 }; ///< bytes; longer lines are cut

/// "rhw: SUBJECT: PREFIX" and what the format says, without a line feed: control characters become '?'.
void cli_message_line(char line[CLI_MESSAGE_LINE], const char *subject, const char *prefix,
                      const char *format, va_list arguments);

#endif
