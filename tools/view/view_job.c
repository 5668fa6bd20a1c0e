// SPDX-License-Identifier: MIT
// See view_job.h.
#include "view_job.h"

#include "keys.h"
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct cli_option options[] = {
    {"fullscreen", 256, NULL, "fill the screen; F11 does it too"},
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
    "fast; at rest they are those of rhw render, byte for byte.\n\n"
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

bool view_job_parse(struct view_job *job, int argc, char **argv, int *status)
{
    static char render[] = "render", out[] = "--out={name}.png", texture[] = "--max-texture=16384";
    *job = (struct view_job){.argv = calloc((size_t)argc + 4, sizeof *job->argv)};
    *status = CLI_FAILED;
    if (!job->argv) {
        cli_error("view", "out of memory");
        return false;
    }
    int count = 0;
    job->argv[count++] = render;
    job->argv[count++] = out;
    job->argv[count++] = texture;
    bool is_operand = false;
    for (int i = 1; i < argc; i++) {
        is_operand = is_operand || strcmp(argv[i], "--") == 0;
        if (!is_operand && (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0)) {
            cli_print_help(&verb);
            putchar('\n');
            view_keys_print(stdout);
            *status = CLI_OK;
            return false;
        }
        if (!is_operand && strcmp(argv[i], "--fullscreen") == 0) {
            job->is_fullscreen = true;
        } else {
            job->argv[count++] = argv[i];
        }
    }
    if (!cli_render_job_parse(&job->render, &verb, count, job->argv, status)) {
        return false;
    }
    *status = CLI_USAGE;
    return check(&job->render);
}
