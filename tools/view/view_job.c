// SPDX-License-Identifier: MIT
// See view_job.h.
#include "view_job.h"

#include "keys.h"
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct cli_option options[] = {
    {"fullscreen", CLI_ASKED_OPTION, NULL, "fill the screen; F11 does it too"},
};

static const char notes[] =
    "The other options are those of rhw render that say what is drawn: --size (of the window), --samples,\n"
    "--output, --camera, --fit, --time, --environment and the rest.\n\n"
    "The window writes what C copies and F12 saves, and what a click explains, to standard output; pictures "
    "are\n"
    "saved in the current folder.\n"
    "A file dragged into the window is opened. While the view moves, pictures are drawn as coarsely as it "
    "takes "
    "to be\n"
    "fast, where that gains time, as is the first one of a large model; at rest they are those of rhw "
    "render,\n"
    "byte for byte.\n\n"
    "Exit status: 0, 1 when the work failed, 2 for a wrong command line.";

static const struct cli_verb verb = {.name = "view",
                                     .operands = "MODEL",
                                     .summary = "Shows a model in a window.",
                                     .options = options,
                                     .option_count = sizeof options / sizeof *options,
                                     .notes = notes};

// What a window has no place for.
static bool check(const struct cli_render_job *job)
{
    const char *const option = job->view_count > 0                   ? "--views"
                               : cli_render_moves(job)               ? "--animate and --turntable"
                               : job->kinds & (job->kinds - 1)       ? "--output with several outputs"
                               : job->stats                          ? "--stats"
                               : job->print_camera                   ? "--print-camera"
                               : job->budget.seconds > 0.0           ? "--max-time"
                               : strcmp(job->out, "{name}.png") != 0 ? "--out"
                               : job->is_literal                     ? "--literal"
                               : job->format != CLI_PICTURE_PNG      ? "--format"
                                                                     : NULL;
    if (option) {
        cli_error(option, "cannot be shown in a window");
        return false;
    }
    return true;
}

static bool take_fullscreen(void *user, int id, const char *argument)
{
    struct view_job *const job = user;
    (void)id, (void)argument;
    job->is_fullscreen = true;
    return true;
}

bool view_job_parse(struct view_job *job, int argc, char **argv, int *status)
{
    static char render[] = "render", out[] = "--out={name}.png", texture[] = "--max-texture=16384";
    const struct cli_render_asked asked = {.verb = &verb, .take = take_fullscreen, .user = job};
    *job = (struct view_job){.argv = calloc((size_t)argc + 3, sizeof *job->argv)};
    *status = CLI_FAILED;
    if (!job->argv) {
        cli_error("view", "out of memory");
        return false;
    }
    job->argv[0] = render;
    job->argv[1] = out;
    job->argv[2] = texture;
    memcpy(job->argv + 3, argv + 1, (size_t)(argc - 1) * sizeof *job->argv);
    if (!cli_render_job_parse(&job->render, &asked, argc + 2, job->argv, status)) {
        if (*status == CLI_OK) {
            putchar('\n');
            view_keys_print(stdout);
        }
        return false;
    }
    *status = CLI_USAGE;
    return check(&job->render);
}
