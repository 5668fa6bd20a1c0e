// SPDX-License-Identifier: MIT
// The program's cli_error, in the extension.
#include "problem.h"

#include "message.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

static _Thread_local char problem[PYTHON_PROBLEM_SIZE];

void cli_error(const char *subject, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int used = snprintf(problem, sizeof problem, "%s: ", subject);
    if (used >= 0 && (size_t)used < sizeof problem) {
        vsnprintf(problem + used, sizeof problem - (size_t)used, format, arguments);
    }
    va_end(arguments);
}

void python_problem_forget(void)
{
    problem[0] = 0;
}

const char *python_problem(void)
{
    return problem;
}
