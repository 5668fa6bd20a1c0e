// SPDX-License-Identifier: MIT
// The program's messages, kept for JavaScript instead of written to stderr; nobody looks on, so there are no stages.
#include "message.h"
#include "message_line.h"
#include "web_module.h"

#include <emscripten.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { ROOM = 1 << 16 }; // bytes of lines; what does not fit is left out

static char lines[ROOM];
static size_t used;

EMSCRIPTEN_KEEPALIVE const char *web_messages(void)
{
    return lines;
}

EMSCRIPTEN_KEEPALIVE void web_messages_clear(void)
{
    used = 0;
    lines[0] = '\0';
}

static void add_line(const char *subject, const char *prefix, const char *format, va_list arguments)
{
    char line[CLI_MESSAGE_LINE];
    cli_message_line(line, subject, prefix, format, arguments);
    const size_t size = strlen(line);
    if (used + size + 2 <= ROOM) {
        memcpy(lines + used, line, size);
        memcpy(lines + used + size, "\n", 2);
        used += size + 1;
    }
}

void cli_error(const char *subject, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_line(subject, "", format, arguments);
    va_end(arguments);
}

void cli_warning(const char *subject, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_line(subject, "warning: ", format, arguments);
    va_end(arguments);
}

void cli_stage(const char *work, const char *subject)
{
    (void)work;
    (void)subject;
}

void cli_stage_end(void)
{
}
