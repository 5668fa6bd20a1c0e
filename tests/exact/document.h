// SPDX-License-Identifier: MIT
// A part of a text file that a program writes, between two marker lines that people leave alone.
#ifndef EXACT_DOCUMENT_H
#define EXACT_DOCUMENT_H

#include <stdbool.h>
#include <stdio.h>

typedef void document_print(FILE *out, const void *argument);

// Replaces what stands between the lines `begin` and `end` (each with its newline) of `path` with what `print` writes.
// The file is whole at any time. False with a line on stderr when that fails.
bool document_replace(const char *path, const char *begin, const char *end, document_print *print,
                      const void *argument);

#endif
