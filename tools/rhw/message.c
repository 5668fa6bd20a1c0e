// SPDX-License-Identifier: MIT
// Lines on stderr; see message.h.
#include "message.h"

#include "message_line.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool stage_shown, has_bar;
static void (*listener)(void *user, const char *line);
static void *listener_user;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; // of these; pictures are encoded by several threads

static void clear_stage(void)
{
    if (stage_shown) {
        fputs("\r\033[K", stderr);
    }
    stage_shown = false;
}

void cli_stage(const char *work, const char *subject)
{
    pthread_mutex_lock(&lock);
    if (!has_bar && isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r\033[K%s %.200s", work, subject);
        stage_shown = true;
    }
    pthread_mutex_unlock(&lock);
}

void cli_progress(const char *subject, int done, int count)
{
    enum { WIDTH = 24 };
    if (!isatty(STDERR_FILENO)) {
        return;
    }
    pthread_mutex_lock(&lock);
    const int filled = (int)((long long)done * WIDTH / count);
    fprintf(stderr, "\r\033[Kdrawing %.100s [%.*s%.*s] %d of %d", subject, filled, "########################",
            WIDTH - filled, "........................", done, count);
    stage_shown = has_bar = true;
    pthread_mutex_unlock(&lock);
}

void cli_progress_end(void)
{
    pthread_mutex_lock(&lock);
    has_bar = false;
    clear_stage();
    pthread_mutex_unlock(&lock);
}

void cli_stage_end(void)
{
    pthread_mutex_lock(&lock);
    if (!has_bar) {
        clear_stage();
    }
    pthread_mutex_unlock(&lock);
}

static void print_line(const char *subject, const char *prefix, const char *format, va_list arguments)
{
    char line[CLI_MESSAGE_LINE];
    cli_message_line(line, strcmp(subject, "-") == 0 ? "standard output" : subject, prefix, format,
                     arguments);
    pthread_mutex_lock(&lock);
    clear_stage();
    fprintf(stderr, "%s\n", line);
    if (listener) {
        listener(listener_user, line + strlen("rhw: "));
    }
    pthread_mutex_unlock(&lock);
}

void cli_message_listen(void (*hear)(void *user, const char *line), void *user)
{
    pthread_mutex_lock(&lock);
    listener = hear;
    listener_user = user;
    pthread_mutex_unlock(&lock);
}

void cli_error(const char *subject, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(subject, "", format, arguments);
    va_end(arguments);
}

void cli_warning(const char *subject, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(subject, "warning: ", format, arguments);
    va_end(arguments);
}
