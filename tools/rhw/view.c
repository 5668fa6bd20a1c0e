// SPDX-License-Identifier: MIT
// rhw view: becomes rhw-view, which needs SDL2 and so is a program, and a package, of its own.
#include "message.h"
#include "options.h"
#include "subprocess.h"
#include "verbs.h"

#include <errno.h>
#include <string.h>

static const char name[] = "rhw-view";

int cli_view(int argc, char **argv)
{
    (void)argc;
    system_subprocess_become(name, argv); // the one beside this program is of the same version
    cli_error("view", "%s, which shows the window, cannot be run: %s", name,
              errno == ENOENT ? "it is not installed; it comes with SDL2, in a package of its own"
                              : strerror(errno));
    return CLI_FAILED;
}
