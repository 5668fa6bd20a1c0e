// SPDX-License-Identifier: MIT
// A file that appears whole or not at all. Data goes to a temporary file in the target's directory, which
// takes the target's name only after everything was written; whatever goes wrong before that, an error, a
// signal, a full disk, removes the temporary file and leaves an older target as it was. Where the system can make a
// file without a name, the temporary file has none, and nothing is left even of a process that was killed. Elsewhere
// its name follows from that of the target, and whoever writes the target next removes what is left.
#ifndef CLI_OUTPUT_FILE_H
#define CLI_OUTPUT_FILE_H

#include <stdbool.h>
#include <stdio.h>

struct cli_output_file {
    FILE *stream;     ///< write here; NULL after finish
    const char *path; ///< as the user gave it; names the file in error lines
    bool seekable;    ///< false for a pipe or a device, which is written directly
    /// Encoders ask it now and then, on the caller's thread. False gives the file up, without a report. It
    /// may be NULL.
    bool (*goes_on)(void *user);
    void *user;
    // ---
    char *target;    ///< NULL: written directly
    char *temporary; ///< NULL: written directly, or the file has no name yet
    int descriptor;  ///< the temporary file, which this keeps locked; −1: written directly
    int pending;     ///< entry in the list of files that a signal removes; −1: none
};

/// Whether an encoder is to go on with the file.
static inline bool cli_output_file_goes_on(const struct cli_output_file *file)
{
    return !file->goes_on || file->goes_on(file->user);
}

/// Makes SIGINT, SIGTERM, SIGHUP and SIGPIPE remove the temporary files before they end the process, and a
/// file size limit an ordinary write error. Call it first, and in each process that is forked.
void cli_output_files_guard(void);
/// From now on the process ends after so many seconds, with status 1, a line about `subject`, and no temporary file.
void cli_output_files_deadline(double seconds, const char *subject);

/// Reports what would keep `path` from being written, as far as that can be known before anything is
/// written: so that no one waits for a picture that cannot be kept. "-" is standard output.
bool cli_output_file_check(const char *path);
/// Whether both names lead to one file, also where it is not there yet.
bool cli_output_file_is_same(const char *path, const char *other);

/// Opens. On failure one line is printed and nothing is left behind. `path` must live until the end.
bool cli_output_file_open(struct cli_output_file *file, const char *path);
/// Writes out what is buffered and closes the stream; the target is not there yet. Reports failure; the
/// file must still be committed or discarded.
bool cli_output_file_finish(struct cli_output_file *file);
/// Gives a finished file its name. Reports failure and then leaves nothing behind.
bool cli_output_file_commit(struct cli_output_file *file);
/// Drops the file, finished or not. Harmless after commit.
void cli_output_file_discard(struct cli_output_file *file);

#endif
