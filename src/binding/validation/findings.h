// SPDX-License-Identifier: MIT
// What validation finds while a pass runs, on any thread, kept until the pass ends and told then. One of each kind: that
// of the earliest draw.
#ifndef RHW_FINDINGS_H
#define RHW_FINDINGS_H

#include "rhw/base.h"
#include "base/thread.h"

enum rhw_finding_kind { RHW_FINDING_MISUSE, RHW_FINDING_WARNING, RHW_FINDING_KINDS };

struct rhw_finding {
    bool found;
    uint32_t draw;
    char text[512];
};

struct rhw_findings {
    struct rhw_mutex mutex; // guards `kinds` while workers run
    struct rhw_finding kinds[RHW_FINDING_KINDS];
};

// False when the system has no mutex.
bool rhw_findings_init(struct rhw_findings *findings);
void rhw_findings_destroy(struct rhw_findings *findings);
void rhw_findings_clear(struct rhw_findings *findings);

// Called on any thread.
__attribute__((format(printf, 4, 5), cold)) void rhw_findings_add(struct rhw_findings *findings,
                                                                  enum rhw_finding_kind kind, uint32_t draw,
                                                                  const char *format, ...);

#endif
