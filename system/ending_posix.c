// SPDX-License-Identifier: MIT
// See ending.h. A thread that holds takes no signal, so that the handler never waits for the thread that it interrupts.
// The handler first says that the program ends, and then waits for the threads that hold. A thread first counts itself
// among them, and then looks whether the program ends: one of the two sees the other.
#include "ending.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { PATIENCE_MS = 1000 }; // a step may take longer on a disk far away, but the program has to end

static const int deadly[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

static struct {
    void (*volatile clean)(void);
    volatile pid_t owner; // a forked child inherits the handler but must not remove its parent's files
    const char *late;     // what is said at the deadline
    _Atomic int holders;
    _Atomic bool ends;
} ending;

static _Thread_local sigset_t unheld; // the signals that a thread blocked before it held

static void clean_up(void)
{
    if (getpid() != ending.owner || !ending.clean) {
        return;
    }
    ending.ends = true;
    for (int i = 0; i < PATIENCE_MS && ending.holders > 0; i++) {
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    ending.clean();
}

void system_ending_hold(void)
{
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGALRM);
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++) {
        sigaddset(&held, deadly[i]);
    }
    pthread_sigmask(SIG_BLOCK, &held, &unheld);
    ending.holders++;
    if (ending.ends && getpid() == ending.owner) {
        ending.holders--;
        for (;;) {
            pause();
        }
    }
}

bool system_ending_began(void)
{
    return ending.ends;
}

void system_ending_release(void)
{
    ending.holders--;
    pthread_sigmask(SIG_SETMASK, &unheld, NULL);
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
    ending.holders = 0; // a process that was forked has the count of the one that forked it
    ending.ends = false;
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
