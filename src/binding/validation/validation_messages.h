// SPDX-License-Identifier: MIT
// What validation finds while a pass runs, on any thread, kept until the pass ends and told then. One of each kind: that
// of the earliest draw.
#ifndef RHW_VALIDATION_MESSAGES_H
#define RHW_VALIDATION_MESSAGES_H

#include "rhw/base.h"
#include "base/thread.h"

enum rhw_validation_kind { RHW_VALIDATION_MISUSE, RHW_VALIDATION_WARNING, RHW_VALIDATION_KINDS };

struct rhw_validation_message {
    bool found;
    uint32_t draw;
    char text[512];
};

struct rhw_validation_messages {
    struct rhw_mutex mutex; // guards `kinds` while workers run
    struct rhw_validation_message kinds[RHW_VALIDATION_KINDS];
};

// False when the system has no mutex.
bool rhw_validation_messages_init(struct rhw_validation_messages *validation);
void rhw_validation_messages_destroy(struct rhw_validation_messages *validation);
void rhw_validation_messages_clear(struct rhw_validation_messages *validation);

// Called on any thread.
__attribute__((format(printf, 4, 5), cold)) void rhw_validation_messages_add(
    struct rhw_validation_messages *validation, enum rhw_validation_kind kind, uint32_t draw,
    const char *format, ...);

#endif
