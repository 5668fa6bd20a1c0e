// SPDX-License-Identifier: MIT
// rhw-view, the program that `rhw view` becomes: apart from rhw, which runs where there is no display and no SDL2.
#include "options.h"
#include "output_file.h"
#include "session.h"
#include "streams.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int run(int argc, char **argv)
{
    struct view_job job;
    struct render render = {0};
    int status;
    if (view_job_parse(&job, argc, argv, &status)) {
        const char *const path = job.render.model_paths[0];
        render.job = job.render;
        status = CLI_FAILED;
        if (strcmp(path, "-") != 0 && access(path, R_OK) != 0) {
            cli_error(path, "cannot be opened: %s", strerror(errno)); // no window for a mistyped name
        } else if (cli_render_prepare(&render)) {
            status = view_session_run(&job, &render.panorama);
        }
        cli_render_release(&render);
    }
    free(job.argv);
    return status;
}

int main(int argc, char **argv)
{
    system_streams_start(argc, argv);
    cli_output_files_guard();
    const int status = run(argc, argv);
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return status;
    }
    cli_error("-", "cannot be written: %s", strerror(errno ? errno : EIO));
    return CLI_FAILED;
}
