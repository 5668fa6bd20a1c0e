// SPDX-License-Identifier: MIT
// See progress.h.
#define _POSIX_C_SOURCE 200809L // for isatty and fileno
#include "progress.h"

#include <stdio.h>
#include <unistd.h>

static double seconds_between(const struct timespec *from, const struct timespec *to)
{
    return (double)(to->tv_sec - from->tv_sec) + 1e-9 * (double)(to->tv_nsec - from->tv_nsec);
}

static int terminal(void)
{
    return isatty(fileno(stderr));
}

void progress_start(struct progress *p, const char *what)
{
    p->what = what;
    timespec_get(&p->start, TIME_UTC);
    p->said = p->start;
}

void progress_say(struct progress *p, double part)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    if (seconds_between(&p->said, &now) < (terminal() ? 1 : 60) || !(part > 0)) {
        return;
    }
    p->said = now;
    const double gone = seconds_between(&p->start, &now), left = gone / part * (1 - part);
    fprintf(stderr, "%s%s: %.1f %% in %d:%02d, %d:%02d to go%s", terminal() ? "\r" : "", p->what, 100 * part,
            (int)gone / 60, (int)gone % 60, (int)left / 60, (int)left % 60, terminal() ? "   " : "\n");
    fflush(stderr);
}

void progress_end(const struct progress *p)
{
    if (terminal() && (p->said.tv_sec != p->start.tv_sec || p->said.tv_nsec != p->start.tv_nsec)) {
        fprintf(stderr, "\r%79s\r", "");
    }
}
