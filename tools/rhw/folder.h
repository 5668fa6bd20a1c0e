// SPDX-License-Identifier: MIT
// Names of folders where a file's is wanted.
#ifndef CLI_FOLDER_H
#define CLI_FOLDER_H

#include <stdbool.h>

/// Whether `path` is a folder, or named as one. Reports that it is. "-" is standard output.
bool cli_is_folder(const char *path);

#endif
