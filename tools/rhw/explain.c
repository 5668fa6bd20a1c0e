// SPDX-License-Identifier: MIT
// rhw explain: the picture that rhw render draws, and the history of one of its samples. The options that say what is drawn
// are those of rhw render, which reads them.
#include "explain_draw.h"
#include "explain_write.h"
#include "options.h"
#include "output_file.h"
#include "verbs.h"

#include <stdlib.h>
#include <string.h>

enum { OPTION_AT = 256, OPTION_SAMPLE, OPTION_JSON, OPTION_PICTURE };

static const struct cli_option options[] = {
    {"at", OPTION_AT, "X,Y", "the pixel, from the top left of the picture"},
    {"sample", OPTION_SAMPLE, "N",
     "which of its samples, those of all pixels of --supersample in rows; default 0"},
    {"json", OPTION_JSON, NULL, "the same as JSON, with every fragment's numbers"},
    {"picture", OPTION_PICTURE, "FILE", "draw the triangle around the pixel too, into a .svg file"},
};

static const char notes[] =
    "The other options are those of rhw render that say what is drawn: --size, --camera, --orbit, --fit,\n"
    "--samples, --background, --environment, --time and the rest.\n\n"
    "Tells every fragment that came to the sample, in the order of drawing, what became of it, and for the "
    "one\n"
    "that is seen how its value follows: the edges, r, s, t on the screen, 1/W, a, b, c in space, and every\n"
    "varying three ways: naive (r, s, t), by the formula in exact arithmetic, and as the pipeline wrote "
    "it;\n"
    "then what was read of each texture and why there, the normal and what of every light arrives, and the "
    "color\n"
    "that the shader made of it all.\n\n"
    "Exit status: 0, 1 when the work failed, 2 for a wrong command line.";

static const struct cli_verb verb = {.name = "explain",
                                     .operands = "MODEL --at X,Y",
                                     .summary = "Tells how a pixel of the picture got its value.",
                                     .options = options,
                                     .option_count = sizeof options / sizeof *options,
                                     .notes = notes};

struct question {
    int x, y, sample;
    bool has_place, is_json, wants_help;
    const char *picture; // a file; NULL: none
    int argc;            // what is left for rhw render
    char **argv;
};

// The argument of `name`, which is that option of argv[*i] or the word behind it, or "" where there is none; NULL: it is
// another.
static const char *argument_of(const char *name, int argc, char **argv, int *i)
{
    const size_t length = strlen(name);
    if (strncmp(argv[*i], name, length) != 0 || (argv[*i][length] != '\0' && argv[*i][length] != '=')) {
        return NULL;
    }
    if (argv[*i][length] == '=') {
        return argv[*i] + length + 1;
    }
    return *i + 1 < argc ? argv[++*i] : "";
}

// Reports where there is no argument. `what` it has to be.
static bool has_argument(const char *argument, const char *name, const char *what)
{
    if (*argument == '\0') {
        cli_error(name, "needs %s; see 'rhw explain --help'", what);
    }
    return *argument != '\0';
}

static bool take_option(struct question *q, int argc, char **argv, int *i, bool *taken)
{
    const char *argument;
    double place[2];
    int count;
    *taken = true;
    if ((argument = argument_of("--at", argc, argv, i))) {
        if (!has_argument(argument, "--at", "X,Y, a pixel")) {
            return false;
        }
        q->has_place = cli_parse_numbers(argument, 2, 2, place, &count) && place[0] >= 0 && place[1] >= 0 &&
                       place[0] < RHW_MAX_TARGET_SIZE && place[1] < RHW_MAX_TARGET_SIZE &&
                       place[0] == (int)place[0] && place[1] == (int)place[1];
        if (!q->has_place) {
            cli_error("--at", "'%s' is not the X,Y of a pixel, from 0,0 on", argument);
            return false;
        }
        q->x = (int)place[0];
        q->y = (int)place[1];
    } else if ((argument = argument_of("--sample", argc, argv, i))) {
        if (!has_argument(argument, "--sample", "N, the number of a sample")) {
            return false;
        }
        if (!cli_parse_int(argument, 0, 255, &q->sample)) {
            cli_error("--sample", "'%s' is not a number of 0 to 255", argument);
            return false;
        }
    } else if ((argument = argument_of("--picture", argc, argv, i))) {
        if (!has_argument(argument, "--picture", "FILE, the name of a .svg file")) {
            return false;
        }
        const size_t length = strlen(argument);
        if (length < 5 || strcmp(argument + length - 4, ".svg") != 0) {
            cli_error("--picture", "'%s' is not the name of a .svg file", argument);
            return false;
        }
        q->picture = argument;
    } else if (strcmp(argv[*i], "--json") == 0) {
        q->is_json = true;
    } else if (strcmp(argv[*i], "--help") == 0 || strcmp(argv[*i], "-h") == 0) {
        q->wants_help = true;
    } else {
        *taken = false;
    }
    return true;
}

// What is not explain's own goes on to rhw render, which writes nothing here.
static bool parse(struct question *q, int argc, char **argv)
{
    static char render[] = "render", out[] = "--out=-", format[] = "--format=png";
    *q = (struct question){.argv = calloc((size_t)argc + 4, sizeof *q->argv)};
    if (!q->argv) {
        cli_error("explain", "out of memory");
        return false;
    }
    q->argv[q->argc++] = render;
    q->argv[q->argc++] = out;
    q->argv[q->argc++] = format;
    bool is_operand = false;
    for (int i = 1; i < argc; i++) {
        bool taken = false;
        is_operand = is_operand || strcmp(argv[i], "--") == 0;
        if (!is_operand && !take_option(q, argc, argv, &i, &taken)) {
            return false;
        }
        if (!taken) {
            q->argv[q->argc++] = argv[i];
        }
    }
    if (!q->wants_help && !q->has_place) {
        cli_error("explain", "--at X,Y is missing: which pixel?");
        return false;
    }
    return true;
}

// What rhw render would do and explain does not.
static bool check(const struct question *q, const struct cli_render_job *job)
{
    if (job->kinds != 1u << SCENE_KIND_COLOR) {
        cli_error("--output", "cannot be explained");
        return false;
    }
    if (strcmp(job->out, "-") != 0) {
        cli_error("--out", "explain writes no picture; --picture FILE.svg draws the triangle");
        return false;
    }
    return cli_explain_check(job, q->x, q->y, q->sample) &&
           (!q->picture || cli_output_file_check(q->picture));
}

static bool tell(const struct question *q, struct render *render)
{
    struct cli_history history;
    struct cli_explanation explanation;
    if (!cli_render_open_scene(render) ||
        !cli_explain_draw(render, q->x, q->y, q->sample, &history, &explanation)) {
        return false;
    }
    if (q->is_json) {
        cli_explain_json(&explanation);
    } else {
        cli_explain_text(stdout, &explanation);
    }
    const bool told = !q->picture || cli_explain_picture(&explanation, q->picture);
    cli_history_free(&history);
    return told;
}

int cli_explain(int argc, char **argv)
{
    struct question question;
    struct render render = {0};
    int status = CLI_USAGE;
    if (!parse(&question, argc, argv)) {
        free(question.argv);
        return status;
    }
    if (question.wants_help) {
        cli_print_help(&verb);
        free(question.argv);
        return CLI_OK;
    }
    if (cli_render_job_parse(&render.job, &verb, question.argc, question.argv, &status) &&
        check(&question, &render.job)) {
        status = CLI_FAILED;
        if (cli_render_prepare(&render)) {
            status = cli_render_open(&render, render.job.model_paths[0]);
        }
        if (status == CLI_OK && !tell(&question, &render)) {
            status = CLI_FAILED;
        }
        cli_render_forget_model(&render);
        free(render.panorama.texels);
    }
    free(question.argv);
    return status;
}
