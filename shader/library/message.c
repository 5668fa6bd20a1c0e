// SPDX-License-Identifier: MIT
// See message.h.
#include "message.h"

#include <stdarg.h>
#include <stdio.h>

#include "rhw/spirv.h"

void shader_say(char *message, const char *format, ...)
{
    va_list arguments;
    if (!message) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(message, RHW_SHADER_MESSAGE, format, arguments);
    va_end(arguments);
}
