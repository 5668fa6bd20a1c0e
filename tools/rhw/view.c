// SPDX-License-Identifier: MIT
// rhw view: becomes rhw-view, which needs SDL2 and so is a program, and a package, of its own.
#include "message.h"
#include "options.h"
#include "verbs.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char name[] = "rhw-view";

// The one beside this program is of the same version.
static void run_beside(char **argv)
{
    char path[PATH_MAX + sizeof name];
    const ssize_t length = readlink("/proc/self/exe", path, PATH_MAX);
    path[length > 0 ? length : 0] = '\0';
    char *const slash = strrchr(path, '/');
    if (slash) {
        memcpy(slash + 1, name, sizeof name);
        execv(path, argv);
    }
}

int cli_view(int argc, char **argv)
{
    (void)argc;
    run_beside(argv);
    if (errno == ENOENT) {
        execvp(name, argv);
    }
    cli_error("view", "%s, which shows the window, cannot be run: %s", name,
              errno == ENOENT ? "it is not installed; it comes with SDL2, in a package of its own"
                              : strerror(errno));
    return CLI_FAILED;
}
