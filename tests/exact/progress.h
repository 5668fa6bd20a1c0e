// SPDX-License-Identifier: MIT
// How far long work is and how long it will take, on stderr: a line that is rewritten every second on a terminal, a
// new line every minute elsewhere, nothing for work of less than that.
#ifndef EXACT_PROGRESS_H
#define EXACT_PROGRESS_H

#include <time.h>

struct progress {
    const char *what;
    struct timespec start, said;
};

void progress_start(struct progress *p, const char *what);
// `part` of the work is done, 0..1. May be called as often as is convenient.
void progress_say(struct progress *p, double part);
// Clears the line.
void progress_end(const struct progress *p);

#endif
