// SPDX-License-Identifier: MIT
// See subprocess.h.
#include "subprocess.h"

#include <errno.h>
#include <limits.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

extern char **environ;

// The file that this program is; "" where the system does not say.
static void find_program(char path[PATH_MAX])
{
#if defined(__APPLE__)
    uint32_t size = PATH_MAX;
    if (_NSGetExecutablePath(path, &size) != 0) {
        path[0] = '\0';
    }
#else
    const ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    path[length > 0 ? length : 0] = '\0';
#endif
}

bool system_subprocess_start(int (*run)(int count, char **arguments), int count, char **arguments)
{
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const int status = run(count, arguments);
        fflush(stdout);
        _exit(status);
    }
    return child > 0;
}

static int status_of(int status)
{
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int system_subprocess_wait(void)
{
    int status;
    pid_t child;
    do {
        child = wait(&status);
    } while (child < 0 && errno == EINTR);
    return child > 0 ? status_of(status) : -1;
}

// What to start this program from: on Linux that which runs, whatever has become of its file.
static void find_itself(char path[PATH_MAX])
{
#if defined(__linux__)
    memcpy(path, "/proc/self/exe", sizeof "/proc/self/exe");
#else
    find_program(path);
#endif
}

bool system_subprocess_can_restart(void)
{
    char path[PATH_MAX];
    find_itself(path);
    return access(path, X_OK) == 0;
}

// posix_spawn does not copy this program's memory, as fork would.
int system_subprocess_restart(const char *const *arguments)
{
    char path[PATH_MAX];
    pid_t child;
    int status = -1;
    find_itself(path);
    if (posix_spawn(&child, path, NULL, NULL, (char *const *)(uintptr_t)arguments, environ) != 0) {
        return -1;
    }
    pid_t ended;
    do {
        ended = waitpid(child, &status, 0);
    } while (ended < 0 && errno == EINTR);
    return ended == child ? status_of(status) : -1;
}

void system_subprocess_become(const char *name, char **arguments)
{
    char path[PATH_MAX];
    find_program(path);
    char *const slash = strrchr(path, '/');
    errno = ENOENT;
    if (slash && slash + 1 + strlen(name) + 1 <= path + PATH_MAX) {
        memcpy(slash + 1, name, strlen(name) + 1);
        execv(path, arguments);
    }
    if (errno == ENOENT) {
        execvp(name, arguments);
    }
}

void system_subprocess_set_variable(const char *name, const char *value)
{
    setenv(name, value, 1);
}
