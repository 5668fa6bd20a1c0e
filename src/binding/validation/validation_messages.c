// SPDX-License-Identifier: MIT
#include "validation_messages.h"

#include <stdarg.h>
#include <stdio.h>

bool rhw_validation_messages_init(struct rhw_validation_messages *validation)
{
    rhw_validation_messages_clear(validation);
    return rhw_mutex_init(&validation->mutex);
}

void rhw_validation_messages_destroy(struct rhw_validation_messages *validation)
{
    rhw_mutex_destroy(&validation->mutex);
}

void rhw_validation_messages_clear(struct rhw_validation_messages *validation)
{
    for (int i = 0; i < RHW_VALIDATION_KINDS; i++) {
        validation->kinds[i].found = false;
    }
}

void rhw_validation_messages_add(struct rhw_validation_messages *validation, enum rhw_validation_kind kind,
                                 uint32_t draw, const char *format, ...)
{
    struct rhw_validation_message *const message = &validation->kinds[kind];
    rhw_mutex_lock(&validation->mutex);
    if (!message->found || draw < message->draw) {
        message->found = true;
        message->draw = draw;
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message->text, sizeof message->text, format, arguments);
        va_end(arguments);
    }
    rhw_mutex_unlock(&validation->mutex);
}
