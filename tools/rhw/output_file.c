// SPDX-License-Identifier: MIT
// Temporary file beside the target, renamed at the end; see output_file.h. Signals need the one piece of
// process-wide state in the program: a fixed list of names that the handler, which may call nothing but
// async-signal-safe functions, can walk and unlink. Files may be open in several threads.
#include "output_file.h"

#include "message.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

enum {
    PENDING_MAX = 256, // files open at a time: every kind of some pictures that are encoded at once, and room
    BUFFER_SIZE = 1 << 18, // bytes; encoders write in pieces of a few KiB
    NAME_ATTEMPTS = 1000
};

static struct {
    const char *volatile names[PENDING_MAX]; // NULL: free; the strings outlive their entry
    volatile pid_t owner; // a forked child inherits the handler but must not remove its parent's files
    volatile sig_atomic_t dying;
    char late[512]; // what is said at the deadline
    size_t late_size;
    pthread_mutex_t lock; // of what follows, and of taking an entry
    unsigned long created;
} pending = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void remove_pending(void)
{
    if (getpid() == pending.owner) {
        pending.dying = 1;
        for (int i = 0; i < PENDING_MAX; i++) {
            if (pending.names[i]) {
                unlink(pending.names[i]);
            }
        }
    }
}

static void remove_pending_and_die(int number)
{
    remove_pending();
    signal(number, SIG_DFL);
    raise(number);
}

static void remove_pending_and_tell(int number)
{
    (void)number;
    remove_pending();
    const ssize_t written = write(STDERR_FILENO, pending.late, pending.late_size);
    (void)written;
    _exit(1);
}

void cli_output_files_deadline(double seconds, const char *subject)
{
    const int size = snprintf(pending.late, sizeof pending.late,
                              "rhw: %.400s: takes longer than --max-time, %g seconds\n", subject, seconds);
    pending.late_size = (size_t)size;
    struct sigaction action = {.sa_handler = remove_pending_and_tell};
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)seconds,
                     .tv_usec = (suseconds_t)((seconds - (double)(time_t)seconds) * 1e6)}};
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &timer, NULL);
}

void cli_output_files_guard(void)
{
    static const int deadly[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
    pending.owner = getpid();
    for (int i = 0; i < PENDING_MAX; i++) {
        pending.names[i] = NULL; // those of the process that forked this one
    }
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++) {
        struct sigaction action, old;
        memset(&action, 0, sizeof action);
        action.sa_handler = remove_pending_and_die;
        sigemptyset(&action.sa_mask);
        // nohup and shells that start background jobs ignore signals on purpose: leave those ignored
        if (sigaction(deadly[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) {
            sigaction(deadly[i], &action, NULL);
        }
    }
    signal(SIGXFSZ, SIG_IGN);
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
    struct stat status;
    if (stat(path, &status) == 0) {
        if (S_ISDIR(status.st_mode)) {
            errno = EISDIR;
            return report(path);
        }
        if (access(path, W_OK) != 0) {
            return report(path);
        }
        if (!S_ISREG(status.st_mode)) {
            return true;
        }
    } else if (errno != ENOENT) {
        return report(path);
    }
    if (path[strlen(path) - 1] == '/') {
        errno = EISDIR;
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

// A symbolic link stays one: the file it leads to is what is replaced.
static char *resolve(const char *path)
{
    char *resolved = realpath(path, NULL);
    return resolved ? resolved : errno == ENOENT ? strdup(path) : NULL;
}

// Takes an entry of the list for DIRECTORY/.rhw-PID-N.tmp; false where none is free. `name` then holds that.
static bool take_entry(struct cli_output_file *file, char *name, size_t size, const char *directory)
{
    pthread_mutex_lock(&pending.lock);
    file->pending = -1;
    for (int i = 0; i < PENDING_MAX && file->pending < 0; i++) {
        file->pending = pending.names[i] ? -1 : i;
    }
    if (file->pending >= 0) {
        snprintf(name, size, "%s/.rhw-%ld-%lu.tmp", directory, (long)getpid(), pending.created++);
        pending.names[file->pending] = name;
    }
    pthread_mutex_unlock(&pending.lock);
    return file->pending >= 0;
}

// The name is in the list before the file is there, so that the handler knows every file that exists.
static int create_guarded(struct cli_output_file *file, char *name, size_t size, const char *directory)
{
    int descriptor = -1;
    errno = EEXIST; // one that a process of this number left behind
    for (int attempt = 0; attempt < NAME_ATTEMPTS && descriptor < 0 && errno == EEXIST; attempt++) {
        if (!take_entry(file, name, size, directory)) {
            errno = EMFILE;
            return -1;
        }
        descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            pending.names[file->pending] = NULL;
        }
    }
    if (descriptor >= 0 && pending.dying) {
        unlink(name); // the handler has been here
    }
    return descriptor;
}

static int open_temporary(struct cli_output_file *file)
{
    char *directory = directory_of(file->target);
    const size_t size = directory ? strlen(directory) + 64 : 0;
    char *name = directory ? malloc(size) : NULL;
    const int descriptor = name ? create_guarded(file, name, size, directory) : -1;
    const int cause = errno;
    if (descriptor >= 0) {
        file->temporary = name;
    } else {
        free(name);
    }
    free(directory);
    errno = cause;
    return descriptor;
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
        return open(file->path, O_WRONLY | O_CLOEXEC);
    }
    file->target = resolve(file->path);
    if (!file->target) {
        return -1;
    }
    const int descriptor = open_temporary(file);
    if (descriptor >= 0 && exists) {
        fchmod(descriptor, status.st_mode & 07777); // best effort, as a copy would
    }
    return descriptor;
}

bool cli_output_file_open(struct cli_output_file *file, const char *path)
{
    *file = (struct cli_output_file){.path = path, .seekable = true, .pending = -1};
    const int descriptor = open_target(file);
    file->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (!file->stream) {
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

bool cli_output_file_commit(struct cli_output_file *file)
{
    bool renamed = true;
    if (file->temporary) {
        renamed = rename(file->temporary, file->target) == 0;
        if (renamed) {
            pending.names[file->pending] = NULL;
            free(file->temporary);
            file->temporary = NULL;
        } else {
            report(file->path);
        }
    }
    cli_output_file_discard(file);
    return renamed;
}

void cli_output_file_discard(struct cli_output_file *file)
{
    if (file->stream) {
        fclose(file->stream);
    }
    if (file->temporary) {
        unlink(file->temporary);
        pending.names[file->pending] = NULL;
    }
    free(file->temporary);
    free(file->target);
    file->stream = NULL;
    file->temporary = file->target = NULL;
}
