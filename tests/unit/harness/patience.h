// SPDX-License-Identifier: MIT
// A program that lets the library go on a number of times (rhw_context_set_goes_on), and counts how often it is asked.
#ifndef PATIENCE_H
#define PATIENCE_H

#include <stdbool.h>

struct patience {
    int left, asked;
};

static inline bool goes_on(void *user)
{
    struct patience *const patience = user;
    patience->asked++;
    return patience->left-- > 0;
}

#endif
