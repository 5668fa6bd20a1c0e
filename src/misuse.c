// SPDX-License-Identifier: MIT
// Messages are formatted on the stack: telling something needs no memory.
#include "misuse.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "context.h"

enum { MESSAGE_SIZE = 512 }; // bytes of a line; a longer one is cut

void rhw_context_log(const struct rhw_context *context, enum rhw_log_level level, const char *format, ...)
{
    if (context->log == NULL) {
        return;
    }
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    context->log(context->user, level, message);
}

void rhw_misuse(const struct rhw_context *context, const char *format, ...)
{
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (context == NULL || context->assert_ == NULL) {
        fprintf(stderr, "rhw: %s\n", message);
        abort();
    }
    context->assert_(context->user, message);
}
