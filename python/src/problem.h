// SPDX-License-Identifier: MIT
// What the program's readers and writers of files report: it prints that, here it becomes an exception.
#ifndef PYTHON_PROBLEM_H
#define PYTHON_PROBLEM_H

enum { PYTHON_PROBLEM_SIZE = 512 };

/// Begins anew, before one of them is called on this thread.
void python_problem_forget(void);
/// What one of them reported on this thread since, "SUBJECT: CAUSE"; "" for nothing.
const char *python_problem(void);

#endif
