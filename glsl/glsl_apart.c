// SPDX-License-Identifier: MIT
// Compiling in a process of its own: a text of a few kilobytes may make glslang use up its stack, or all memory.
//
// The child sends a struct head and the bytes that it tells of. Whoever waits has made glslang's tables before, so that
// no child makes them again, and no other thread is inside glslang when a child is made.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "child.h"
#include "glsl_here.h"
#include "machine.h"

enum { SECONDS = 20, WALL_FACTOR = 5, MESSAGE = 1024 };

struct order {
    enum rhw_shader_stage stage;
    const char *text, *name;
    size_t size;
    const struct glsl_options *options;
};

struct head {
    size_t code_size, log_size, files_size;
    bool is_relaxed;
    char message[MESSAGE];
};

static void give(const void *bytes, size_t size, const struct system_child *child)
{
    if (size > 0) {
        fwrite(bytes, 1, size, child->reply);
    }
}

static int run(void *user, struct system_child *child)
{
    const struct order *const order = user;
    struct head head = {0};
    struct glsl_code code;
    glsl_compile_here(order->stage, order->text, order->size, order->name, order->options, &code,
                      head.message, sizeof head.message);
    head.code_size = code.size;
    head.log_size = code.log != NULL ? strlen(code.log) : 0;
    head.files_size = code.files != NULL ? strlen(code.files) : 0;
    head.is_relaxed = code.is_relaxed;
    fwrite(&head, sizeof head, 1, child->reply);
    give(code.words, head.code_size, child);
    give(code.log, head.log_size, child);
    give(code.files, head.files_size, child);
    glsl_code_free(&code);
    return 0;
}

static void keep(void *user)
{
    (void)user; // the order is the caller's, who waits
}

static size_t memory_limit(void)
{
    const size_t share = system_machine_memory() / 4 * 3, most = (size_t)16 << 30;
    return share > 0 && share < most ? share : most;
}

// Take bytes, with a 0 behind them. Return NULL if they are not there.
static char *take_bytes(FILE *reply, size_t size)
{
    char *const bytes = malloc(size + 1);
    if (bytes != NULL && fread(bytes, 1, size, reply) != size) {
        free(bytes);
        return NULL;
    }
    if (bytes != NULL) {
        bytes[size] = 0;
    }
    return bytes;
}

// Take what the child has sent. Return false if it is not whole.
static bool take(FILE *reply, struct glsl_code *code, struct head *head)
{
    rewind(reply);
    if (fread(head, sizeof *head, 1, reply) != 1 || head->code_size > GLSL_MAX_CODE_SIZE ||
        head->log_size > GLSL_MAX_CODE_SIZE || head->files_size > GLSL_MAX_CODE_SIZE) {
        return false;
    }
    head->message[MESSAGE - 1] = 0;
    code->words = head->code_size > 0 ? (uint32_t *)(void *)take_bytes(reply, head->code_size) : NULL;
    code->size = head->code_size;
    code->is_relaxed = head->is_relaxed;
    if (code->words == NULL && head->code_size > 0) {
        return false;
    }
    code->log = take_bytes(reply, head->log_size);
    code->files = take_bytes(reply, head->files_size);
    return code->log != NULL && code->files != NULL;
}

static void tell_end(const struct system_child_result *result, const char *name, char *message,
                     size_t message_size)
{
    switch (result->end) {
    case SYSTEM_CHILD_CPU_TIME:
    case SYSTEM_CHILD_WALL_TIME:
        snprintf(message, message_size, "%s: compiling takes more than %d seconds", name, SECONDS);
        break;
    case SYSTEM_CHILD_NOT_STARTED:
        snprintf(message, message_size, "%s: compiling could not start: %s", name, strerror(result->number));
        break;
    case SYSTEM_CHILD_SIGNAL:
        snprintf(message, message_size, "%s: the compiler crashed (signal %d); the text may nest too deep",
                 name, result->number);
        break;
    default: snprintf(message, message_size, "%s: compiling needs more memory than there is", name);
    }
}

bool glsl_compile(enum rhw_shader_stage stage, const char *text, size_t size, const char *name,
                  const struct glsl_options *options, struct glsl_code *code, char *message,
                  size_t message_size)
{
    static const struct glsl_options nothing = {0};
    struct order order = {stage, text, name, size, options != NULL ? options : &nothing};
    const struct system_child_work work = {.run = run,
                                           .user = &order,
                                           .release = keep,
                                           .is_borrowing = true,
                                           .cpu_seconds = SECONDS,
                                           .wall_seconds = SECONDS * WALL_FACTOR,
                                           .memory = memory_limit()};
    struct head head;
    *code = (struct glsl_code){0};
    if (!glsl_prepare()) {
        snprintf(message, message_size, "%s: memory is out", name);
        return false;
    }
    struct system_child_result result = system_child_run(&work);
    const bool left = result.end == SYSTEM_CHILD_LEFT && result.number == 0;
    const bool taken = left && take(result.reply.stream, code, &head);
    if (!taken) {
        tell_end(&result, name, message, message_size);
        glsl_code_free(code);
    } else if (code->words == NULL) {
        snprintf(message, message_size, "%s", head.message);
    }
    system_memory_file_close(&result.reply);
    return taken && code->words != NULL;
}
