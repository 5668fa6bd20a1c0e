// SPDX-License-Identifier: MIT
// A signal or the deadline at the worst moment of a file that is written: just when it has a name, on systems that have no
// files without a name and on those that have. What stands here for system/temporary_file sends it.
#include "ending.h"
#include "output_file.h"
#include "temporary_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum moment { CREATED, NAMED, REPLACED };

static struct {
    enum moment moment;
    int signal; // 0: the deadline
    bool has_unnamed;
    bool has_thread; // another thread is there to take the signal
} worst;

// The other thread has begun to end the program; or the signal waits for this thread, which takes none while it holds.
static bool is_struck(void)
{
    sigset_t waiting;
    if (worst.has_thread) {
        return system_ending_began();
    }
    return sigpending(&waiting) == 0 && sigismember(&waiting, worst.signal ? worst.signal : SIGALRM) == 1;
}

// The deadline begins here, so that a busy machine does not reach it in front of the moment.
static void strike(enum moment moment)
{
    if (moment == worst.moment) {
        if (worst.signal) {
            kill(getpid(), worst.signal);
        } else {
            cli_output_files_deadline(0.001, "target");
        }
        while (!is_struck()) {
            nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        }
    }
}

int system_temporary_file_open(const char *folder)
{
    (void)folder;
    if (!worst.has_unnamed) {
        errno = ENOTSUP;
        return -1;
    }
    const int descriptor = open("unnamed", O_RDWR | O_CREAT | O_EXCL, 0666);
    unlink("unnamed");
    return descriptor;
}

static int make(const char *path)
{
    return open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
}

bool system_temporary_file_name(int descriptor, const char *path)
{
    const int made = make(path);
    char text[16];
    if (made < 0) {
        return false;
    }
    const ssize_t size = pread(descriptor, text, sizeof text, 0);
    const bool copied = size >= 0 && write(made, text, (size_t)size) == size;
    close(made);
    strike(NAMED);
    return copied;
}

int system_temporary_file_create(const char *path)
{
    const int descriptor = make(path);
    if (descriptor >= 0) {
        strike(CREATED);
    }
    return descriptor;
}

bool system_temporary_file_replace(int *descriptor, const char *from, const char *to)
{
    (void)descriptor;
    const bool replaced = rename(from, to) == 0;
    if (worst.moment == REPLACED) {
        close(make(from)); // another process has the name at once
        strike(REPLACED);
    }
    return replaced;
}

bool system_temporary_file_remove(const char *path)
{
    (void)path;
    return false;
}

static void *idle(void *user)
{
    (void)user;
    for (;;) {
        pause();
    }
    return NULL;
}

// Writes the file `target`, and waits to be ended.
static void write_and_wait(void)
{
    pthread_t thread;
    struct cli_output_file file;
    cli_output_files_guard();
    if (worst.has_thread && pthread_create(&thread, NULL, idle, NULL) != 0) {
        _exit(2);
    }
    if (!cli_output_file_open(&file, "target") || fputs("newer", file.stream) < 0 ||
        !cli_output_file_finish(&file) || !cli_output_file_commit(&file)) {
        _exit(3);
    }
    idle(NULL);
}

// Removes the files beside the target, and returns how many there were.
static int remove_others(void)
{
    int count = 0;
    DIR *const folder = opendir(".");
    assert_non_null(folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (strncmp(entry->d_name, ".rhw-", 5) == 0) {
            assert_int_equal(unlink(entry->d_name), 0);
            count++;
        }
    }
    closedir(folder);
    return count;
}

// A file that was being committed took the place of the target, and is whole. Before that the older one is still there.
static void check_target(enum moment moment)
{
    const char *const wanted = moment == CREATED ? "older" : "newer";
    char text[16] = "";
    FILE *const file = fopen("target", "rb");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    assert_string_equal(text, wanted);
}

static void try(enum moment moment, int number, bool has_unnamed, bool has_thread)
{
    worst.moment = moment;
    worst.signal = number;
    worst.has_unnamed = has_unnamed;
    worst.has_thread = has_thread;
    const int older = open("target", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    assert_int_equal(write(older, "older", 5), 5);
    close(older);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        signal(number ? number : SIGALRM, SIG_DFL);
        write_and_wait();
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    if (number) {
        assert_true(WIFSIGNALED(status));
        assert_int_equal(WTERMSIG(status), number);
    } else {
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 1);
    }
    assert_int_equal(remove_others(), moment == REPLACED ? 1 : 0);
    check_target(moment);
}

static void try_all(enum moment moment, bool has_unnamed)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, 0};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        try(moment, numbers[i], has_unnamed, false);
        try(moment, numbers[i], has_unnamed, true);
    }
}

static void test_when_it_was_created(void **state)
{
    (void)state;
    try_all(CREATED, false);
}

static void test_when_it_was_named(void **state)
{
    (void)state;
    try_all(NAMED, true);
}

static void test_when_it_took_its_place(void **state)
{
    (void)state;
    try_all(REPLACED, false);
    try_all(REPLACED, true);
}

static int enter_folder(void **state)
{
    static char folder[] = "/tmp/rhw-output-XXXXXX";
    *state = folder;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave_folder(void **state)
{
    unlink("target");
    return chdir("/") == 0 && rmdir(*state) == 0 ? 0 : -1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_when_it_was_created),
        cmocka_unit_test(test_when_it_was_named),
        cmocka_unit_test(test_when_it_took_its_place),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
