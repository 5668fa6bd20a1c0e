// SPDX-License-Identifier: MIT
#include "findings.h"

#include <stdarg.h>
#include <stdio.h>

bool rhw_findings_init(struct rhw_findings *findings)
{
    rhw_findings_clear(findings);
    return rhw_mutex_init(&findings->mutex);
}

void rhw_findings_destroy(struct rhw_findings *findings)
{
    rhw_mutex_destroy(&findings->mutex);
}

void rhw_findings_clear(struct rhw_findings *findings)
{
    for (int i = 0; i < RHW_FINDING_KINDS; i++) {
        findings->kinds[i].found = false;
    }
}

void rhw_findings_add(struct rhw_findings *findings, enum rhw_finding_kind kind, uint32_t draw,
                      const char *format, ...)
{
    struct rhw_finding *const finding = &findings->kinds[kind];
    rhw_mutex_lock(&findings->mutex);
    if (!finding->found || draw < finding->draw) {
        finding->found = true;
        finding->draw = draw;
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(finding->text, sizeof finding->text, format, arguments);
        va_end(arguments);
    }
    rhw_mutex_unlock(&findings->mutex);
}
