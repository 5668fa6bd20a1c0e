// SPDX-License-Identifier: MIT
// See message_line.h.
#include "message_line.h"

#include <ctype.h>
#include <stddef.h>
#include <stdio.h>

void cli_message_line(char line[CLI_MESSAGE_LINE], const char *subject, const char *prefix,
                      const char *format, va_list arguments)
{
    const int used = snprintf(line, CLI_MESSAGE_LINE, "rhw: %s: %s", *subject ? subject : "''", prefix);
    if (used < 0) {
        line[0] = '\0';
        return;
    }
    if (used < CLI_MESSAGE_LINE) {
        vsnprintf(line + used, (size_t)(CLI_MESSAGE_LINE - used), format, arguments);
    }
    for (char *c = line; *c; c++) {
        *c = iscntrl((unsigned char)*c) ? '?' : *c;
    }
}
