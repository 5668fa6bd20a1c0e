// SPDX-License-Identifier: MIT
// Messages are formatted on the stack, so that telling something needs no memory.
#include "misuse.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"

enum {
    MESSAGE_SIZE = 1024, // bytes of a line; a longer one is cut
    // At most so many groups are named; a loop that forgets to pop leaves any number of them.
    GROUPS_NAMED = 8
};

struct message {
    char text[MESSAGE_SIZE];
    size_t length;
};

static void append_list(struct message *message, const char *format, va_list arguments)
{
    const size_t room = sizeof message->text - message->length;
    const int length = vsnprintf(message->text + message->length, room, format, arguments);
    if (length > 0) {
        message->length += (size_t)length < room ? (size_t)length : room - 1;
    }
}

__attribute__((format(printf, 2, 3))) static void append(struct message *message, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append_list(message, format, arguments);
    va_end(arguments);
}

// Make 'rhw_texture_create "sky": ...' of 'rhw_texture_create: ...' where the call takes a definition with a label.
static void name_definition(struct message *message, const char *label)
{
    char copy[RHW_LABEL_SIZE];
    rhw_label_copy(copy, label);
    const char *const colon = strchr(message->text, ':');
    if (copy[0] == 0 || colon == NULL) {
        return;
    }
    const struct message plain = *message;
    message->length = (size_t)(colon - message->text);
    append(message, " \"%s\"%s", copy, plain.text + message->length);
}

// Return true if somebody is told. Without a hook nobody is, except what validation was asked for.
static bool is_heard(const struct rhw_context *context, enum rhw_log_level level)
{
    return context->log != NULL || (level == RHW_LOG_WARNING && context->validation != NULL);
}

static void say(const struct rhw_context *context, enum rhw_log_level level, const char *text)
{
    if (context->log != NULL) {
        context->log(context->user, level, text);
    } else {
        fprintf(stderr, "rhw: warning: %s\n", text);
    }
}

void rhw_context_log(const struct rhw_context *context, enum rhw_log_level level, const char *format, ...)
{
    if (!is_heard(context, level)) {
        return;
    }
    struct message message = {.length = 0};
    va_list arguments;
    va_start(arguments, format);
    append_list(&message, format, arguments);
    va_end(arguments);
    name_definition(&message, context->definition);
    say(context, level, message.text);
}

// Append the innermost groups, outer ones first.
static void append_groups(struct message *message, const struct rhw_debug_group *group)
{
    const struct rhw_debug_group *named[GROUPS_NAMED];
    int count = 0;
    for (; group != NULL && count < GROUPS_NAMED; group = group->outer) {
        named[count++] = group;
    }
    append(message, "%s", group != NULL ? "... / " : "");
    while (count-- > 0) {
        append(message, "%s%s", named[count]->label, count > 0 ? " / " : "");
    }
}

// Append which draw is being recorded. Draws are counted from 0, as shaders see them.
static void append_draw(struct message *message, const struct rhw_recording_place *recording)
{
    append(message, "draw %u", (unsigned)recording->draw);
    if (recording->group != NULL) {
        append(message, " in ");
        append_groups(message, recording->group);
    }
    if (recording->label[0] != 0) {
        append(message, " of pass \"%s\"", recording->label);
    }
}

static void append_place(struct message *message, const struct rhw_context *context,
                         const struct rhw_recording_place *place)
{
    const bool recording = place->active, labelled = context->label[0] != 0;
    if (!recording && !labelled) {
        return;
    }
    append(message, " [");
    if (recording) {
        append_draw(message, place);
    }
    if (labelled) {
        append(message, "%scontext \"%s\"", recording ? ", " : "", context->label);
    }
    append(message, "]");
}

void rhw_context_warn_at(const struct rhw_context *context, const struct rhw_recording_place *place,
                         const char *text)
{
    if (is_heard(context, RHW_LOG_WARNING)) {
        struct message message = {.length = 0};
        append(&message, "%s", text);
        append_place(&message, context, place);
        say(context, RHW_LOG_WARNING, message.text);
    }
}

static void tell(const struct rhw_context *context, const char *text)
{
    if (context == NULL || context->assert_ == NULL) {
        fprintf(stderr, "rhw: %s\n", text);
        abort();
    }
    context->assert_(context->user, text);
}

// Call the hook of a context that this thread is in. The hook may leave by longjmp or by an exception. So the context
// is left before the call, and entered again after it for the call that found the misuse to go on.
static void tell_inside(struct rhw_context *context, const struct rhw_recording_place *place,
                        struct message *message)
{
    name_definition(message, context->definition);
    // The hook may never return to the call that has the definition.
    context->definition = NULL;
    append_place(message, context, place);
    context->recording.misused |= context->recording.active;
    context->recording.dispatches = false; // misuse ends a dispatch
    const char *const where =
        atomic_exchange_explicit(&context->entered, context->idle, memory_order_relaxed);
    tell(context, message->text);
    atomic_store_explicit(&context->entered, where, memory_order_relaxed);
}

void rhw_misuse(const struct rhw_context *context, const char *format, ...)
{
    struct message message = {.length = 0};
    va_list arguments;
    va_start(arguments, format);
    append_list(&message, format, arguments);
    va_end(arguments);
    if (context == NULL) {
        tell(context, message.text);
    } else {
        // Functions that only look report, too.
        tell_inside((struct rhw_context *)context, &context->recording, &message);
    }
}

void rhw_misuse_at(const struct rhw_context *context, const struct rhw_recording_place *place,
                   const char *format, ...)
{
    struct message message = {.length = 0};
    va_list arguments;
    va_start(arguments, format);
    append_list(&message, format, arguments);
    va_end(arguments);
    tell_inside((struct rhw_context *)context, place, &message);
}

void rhw_misuse_outside(const struct rhw_context *context, const char *format, ...)
{
    struct message message = {.length = 0};
    va_list arguments;
    va_start(arguments, format);
    append_list(&message, format, arguments);
    va_end(arguments);
    append_place(&message, context, &(const struct rhw_recording_place){.active = false});
    tell(context, message.text);
}
