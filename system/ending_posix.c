// SPDX-License-Identifier: MIT
// See ending.h.
#include "ending.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

static struct {
    void (*volatile clean)(void);
    volatile pid_t owner; // a forked child inherits the handler but must not remove its parent's files
    const char *late;     // what is said at the deadline
} ending;

static void clean_up(void)
{
    if (getpid() == ending.owner && ending.clean) {
        ending.clean();
    }
}

static void clean_and_die(int number)
{
    clean_up();
    signal(number, SIG_DFL);
    raise(number);
}

static void clean_and_tell(int number)
{
    (void)number;
    clean_up();
    const ssize_t written = write(STDERR_FILENO, ending.late, strlen(ending.late));
    (void)written;
    _exit(1);
}

void system_ending_deadline(double seconds, const char *line)
{
    ending.late = line;
    struct sigaction action = {.sa_handler = clean_and_tell};
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)seconds,
                     .tv_usec = (suseconds_t)((seconds - (double)(time_t)seconds) * 1e6)}};
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &timer, NULL);
}

void system_ending_guard(void (*clean)(void))
{
    static const int deadly[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
    ending.clean = clean;
    ending.owner = getpid();
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++) {
        struct sigaction action, old;
        memset(&action, 0, sizeof action);
        action.sa_handler = clean_and_die;
        sigemptyset(&action.sa_mask);
        // nohup and shells that start background jobs ignore signals on purpose: leave those ignored
        if (sigaction(deadly[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) {
            sigaction(deadly[i], &action, NULL);
        }
    }
    signal(SIGXFSZ, SIG_IGN);
}
