// SPDX-License-Identifier: MIT
// Temporary file beside the target, which gets its name at the end; see output_file.h. Signals need the one piece of
// process-wide state in the program: a fixed list of names that the handler, which may call nothing but
// async-signal-safe functions, can walk and unlink. Files may be open in several threads. A name is in the list just as
// long as its file is there and ours: the program does not end between one and the other.
#include "output_file.h"

#include "ending.h"
#include "file.h"
#include "folder.h"
#include "message.h"
#include "temporary_file.h"

#include <errno.h>
#include <libgen.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    PENDING_MAX = 256, // files open at a time: every kind of some pictures that are encoded at once, and room
    BUFFER_SIZE = 1 << 18, // bytes; encoders write in pieces of a few KiB
    NAME_ATTEMPTS = 1000
};

static struct {
    // An entry is NULL where it is free. Whoever holds the program's end writes it; the handler reads it, and does not
    // wait for that in all cases.
    const char *_Atomic names[PENDING_MAX];
    char late[512];       // what is said at the deadline
    pthread_mutex_t lock; // held while an entry is taken
} pending = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void remove_pending(void)
{
    for (int i = 0; i < PENDING_MAX; i++) {
        const char *const name = pending.names[i];
        if (name) {
            unlink(name);
        }
    }
}

void cli_output_files_deadline(double seconds, const char *subject)
{
    snprintf(pending.late, sizeof pending.late, "rhw: %.400s: takes longer than --max-time, %g seconds\n",
             subject, seconds);
    system_ending_deadline(seconds, pending.late);
}

void cli_output_files_guard(void)
{
    for (int i = 0; i < PENDING_MAX; i++) {
        pending.names[i] = NULL; // a process that was forked has the names of the one that forked it
    }
    system_ending_guard(remove_pending);
}

static bool report(const char *path)
{
    cli_error(path, "cannot be written: %s", strerror(errno));
    return false;
}

static bool is_standard_output(const char *path)
{
    return strcmp(path, "-") == 0;
}

static char *directory_of(const char *path)
{
    char *copy = strdup(path);
    char *directory = copy ? strdup(dirname(copy)) : NULL;
    free(copy);
    return directory;
}

bool cli_output_file_check(const char *path)
{
    if (is_standard_output(path)) {
        return true;
    }
    if (!*path) {
        cli_error("''", "an output file needs a name");
        return false;
    }
    if (cli_is_folder(path)) {
        return false;
    }
    struct stat status;
    if (stat(path, &status) == 0) {
        if (access(path, W_OK) != 0) {
            return report(path);
        }
        if (!S_ISREG(status.st_mode)) {
            return true;
        }
    } else if (errno != ENOENT) {
        return report(path);
    }
    char *directory = directory_of(path);
    const bool writable = directory && access(directory, W_OK | X_OK) == 0;
    if (!writable) {
        report(path);
    }
    free(directory);
    return writable;
}

static const char *base_of(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

// Names of what is not there yet are one in one folder, however that is written.
static bool will_be_same(const char *path, const char *other)
{
    char *const folder = directory_of(path), *const other_folder = directory_of(other);
    const bool same = folder && other_folder && system_file_is_same(folder, other_folder) &&
                      strcmp(base_of(path), base_of(other)) == 0;
    free(folder);
    free(other_folder);
    return same;
}

bool cli_output_file_is_same(const char *path, const char *other)
{
    if (is_standard_output(path) || is_standard_output(other)) {
        return strcmp(path, other) == 0;
    }
    return system_file_is_same(path, other) || will_be_same(path, other);
}

// A symbolic link stays one: the file it leads to is what is replaced.
static char *resolve(const char *path)
{
    char *resolved = system_file_resolve(path);
    return resolved ? resolved : errno == ENOENT ? strdup(path) : NULL;
}

// DIRECTORY/.rhw-TARGET-N.tmp with the name of the target as a number (FNV-1a, 32 bits), so that it is not too long.
// NULL where there is no memory.
static char *name_of(const char *target, int number)
{
    char *const directory = directory_of(target);
    const size_t size = directory ? strlen(directory) + 64 : 0;
    char *const name = directory ? malloc(size) : NULL;
    uint32_t hash = 2166136261u;
    for (const char *c = base_of(target); *c; c++) {
        hash = (hash ^ (unsigned char)*c) * 16777619u;
    }
    if (name) {
        snprintf(name, size, "%s/.rhw-%08x-%d.tmp", directory, (unsigned)hash, number);
    }
    free(directory);
    return name;
}

// Makes a file of a name that no other process writes; 0 or above with its name, −1 with errno.
static int make_named(const char *target, int (*make)(const char *name, int descriptor), int descriptor,
                      char **name)
{
    int made = -1;
    errno = EEXIST;
    for (int number = 0; number < NAME_ATTEMPTS && made < 0 && errno == EEXIST; number++) {
        *name = name_of(target, number);
        if (!*name) {
            errno = ENOMEM;
            return -1;
        }
        (void)system_temporary_file_remove(*name);
        made = make(*name, descriptor);
        if (made < 0) {
            const int cause = errno;
            free(*name);
            *name = NULL;
            errno = cause;
        }
    }
    return made;
}

static int create(const char *name, int descriptor)
{
    (void)descriptor;
    return system_temporary_file_create(name);
}

static int give_name(const char *name, int descriptor)
{
    return system_temporary_file_name(descriptor, name) ? 0 : -1;
}

// Makes a signal remove the file. Removes it at once, and returns false, where too many are open.
static bool guard(struct cli_output_file *file)
{
    pthread_mutex_lock(&pending.lock);
    for (int i = 0; i < PENDING_MAX && file->pending < 0; i++) {
        file->pending = pending.names[i] ? -1 : i;
    }
    if (file->pending >= 0) {
        pending.names[file->pending] = file->temporary;
    }
    pthread_mutex_unlock(&pending.lock);
    if (file->pending < 0) {
        unlink(file->temporary);
    }
    return file->pending >= 0;
}

// The entry is emptied before the question whether the program ends: if it does not yet, nobody has the name any more.
static void forget_temporary(struct cli_output_file *file)
{
    if (file->pending >= 0) {
        pending.names[file->pending] = NULL;
        file->pending = -1;
    }
    if (!system_ending_began()) {
        free(file->temporary);
    }
    file->temporary = NULL;
}

static bool open_temporary(struct cli_output_file *file)
{
    char *const directory = directory_of(file->target);
    file->descriptor = directory ? system_temporary_file_open(directory) : -1;
    free(directory);
    if (file->descriptor >= 0) {
        return true;
    }
    system_ending_hold();
    file->descriptor = make_named(file->target, create, -1, &file->temporary);
    const bool made = file->descriptor >= 0, guarded = made && guard(file);
    if (made && !guarded) {
        forget_temporary(file);
        errno = EMFILE;
    }
    system_ending_release();
    return guarded;
}

static int open_target(struct cli_output_file *file)
{
    struct stat status;
    if (is_standard_output(file->path)) {
        file->seekable = false;
        return dup(STDOUT_FILENO);
    }
    const bool exists = stat(file->path, &status) == 0;
    if (exists && !S_ISREG(status.st_mode)) {
        file->seekable = false;
        return system_file_open(file->path, SYSTEM_FILE_WRITE);
    }
    file->target = resolve(file->path);
    if (!file->target) {
        return -1;
    }
    if (!open_temporary(file)) {
        return -1;
    }
    if (exists) {
        system_file_permit_as(file->descriptor, file->path); // as a copy would
    }
    return dup(file->descriptor);
}

bool cli_output_file_open(struct cli_output_file *file, const char *path)
{
    *file = (struct cli_output_file){.path = path, .seekable = true, .descriptor = -1, .pending = -1};
    const int descriptor = open_target(file);
    file->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (!file->stream) {
        errno = errno == EINVAL ? EBADF : errno; // standard output is closed, or cannot be written
        report(path);
        if (descriptor >= 0) {
            close(descriptor);
        }
        cli_output_file_discard(file);
        return false;
    }
    setvbuf(file->stream, NULL, _IOFBF, BUFFER_SIZE);
    return true;
}

bool cli_output_file_finish(struct cli_output_file *file)
{
    errno = 0;
    const bool flushed = fflush(file->stream) == 0 && !ferror(file->stream);
    const int cause = errno;
    const bool closed = fclose(file->stream) == 0;
    file->stream = NULL;
    if (flushed && closed) {
        return true;
    }
    errno = !flushed && cause ? cause : errno ? errno : EIO;
    return report(file->path);
}

// Without a name a file can take one that is free alone: in the place of another it comes by a temporary one.
static bool take_name(struct cli_output_file *file)
{
    if (!file->temporary && system_temporary_file_name(file->descriptor, file->target)) {
        return true;
    }
    if (!file->temporary &&
        (errno != EEXIST || make_named(file->target, give_name, file->descriptor, &file->temporary) < 0)) {
        return false;
    }
    const bool replaced = system_temporary_file_replace(&file->descriptor, file->temporary, file->target);
    if (replaced) {
        forget_temporary(file);
    }
    return replaced;
}

static void drop_temporary(struct cli_output_file *file)
{
    if (file->temporary) {
        unlink(file->temporary);
        forget_temporary(file);
    }
}

bool cli_output_file_commit(struct cli_output_file *file)
{
    system_ending_hold();
    const bool named = !file->target || take_name(file);
    const int cause = errno;
    drop_temporary(file);
    system_ending_release();
    if (!named) {
        errno = cause;
        report(file->path);
    }
    cli_output_file_discard(file);
    return named;
}

void cli_output_file_discard(struct cli_output_file *file)
{
    if (file->stream) {
        fclose(file->stream);
    }
    system_ending_hold();
    drop_temporary(file);
    system_ending_release();
    if (file->descriptor >= 0) {
        close(file->descriptor);
    }
    free(file->target);
    file->stream = NULL;
    file->target = NULL;
    file->descriptor = -1;
}
