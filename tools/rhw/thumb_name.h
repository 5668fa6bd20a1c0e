// SPDX-License-Identifier: MIT
// What the names of files say to rhw thumbs.
#ifndef CLI_THUMB_NAME_H
#define CLI_THUMB_NAME_H

#include <stdbool.h>

/// Counts files of formats that nothing here reads, for each format.
struct cli_thumb_unread {
    struct {
        const char *format;
        int files;
    } formats[64];
    int count;
};

/// Return true for the name of a model.
bool cli_thumb_is_model(const char *name);
/// Count a file, if its name is that of a model that nothing here reads.
void cli_thumb_count_unread(struct cli_thumb_unread *unread, const char *name);
/// Warn of the files that were counted, a line for each format.
void cli_thumb_tell_unread(const struct cli_thumb_unread *unread, const char *folder);

#endif
