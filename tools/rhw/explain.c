// SPDX-License-Identifier: MIT
// rhw explain: the picture that rhw render draws, and the history of one of its samples. The options that say what is
// drawn are those of rhw render, which reads them.
#include "explain_draw.h"
#include "explain_write.h"
#include "options.h"
#include "output_file.h"
#include "verbs.h"

#include <stdlib.h>
#include <string.h>

enum { OPTION_AT = CLI_ASKED_OPTION, OPTION_SAMPLE, OPTION_JSON, OPTION_PICTURE };

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
    bool has_place, is_json;
    const char *picture; // a file; NULL: none
};

static bool take_place(struct question *q, const char *argument)
{
    double place[2];
    int count;
    q->has_place = cli_parse_numbers(argument, 2, 2, place, &count) && place[0] >= 0 && place[1] >= 0 &&
                   place[0] < RHW_MAX_TARGET_SIZE && place[1] < RHW_MAX_TARGET_SIZE &&
                   place[0] == (int)place[0] && place[1] == (int)place[1];
    if (!q->has_place) {
        cli_error("--at", "'%s' is not the X,Y of a pixel, from 0,0 on", argument);
        return false;
    }
    q->x = (int)place[0];
    q->y = (int)place[1];
    return true;
}

static bool take_picture(struct question *q, const char *argument)
{
    const size_t length = strlen(argument);
    q->picture = argument;
    if (length < 5 || strcmp(argument + length - 4, ".svg") != 0) {
        cli_error("--picture", "'%s' is not the name of a .svg file", argument);
        return false;
    }
    return true;
}

static bool take_option(void *user, int id, const char *argument)
{
    struct question *const q = user;
    switch (id) {
    case OPTION_AT: return take_place(q, argument);
    case OPTION_PICTURE: return take_picture(q, argument);
    case OPTION_SAMPLE:
        if (cli_parse_int(argument, 0, 255, &q->sample)) {
            return true;
        }
        cli_error("--sample", "'%s' is not a number of 0 to 255", argument);
        return false;
    default: q->is_json = true; return true;
    }
}

// Fills the question and the job; the latter points into *words, to be freed. False where `*status` is what to return.
static bool parse(struct question *q, struct cli_render_job *job, int argc, char **argv, char ***words,
                  int *status)
{
    static char render[] = "render", out[] = "--out=-", format[] = "--format=png";
    const struct cli_render_asked asked = {.verb = &verb, .take = take_option, .user = q};
    *words = calloc((size_t)argc + 3, sizeof **words);
    if (!*words) {
        cli_error("explain", "out of memory");
        *status = CLI_FAILED;
        return false;
    }
    (*words)[0] = render;
    (*words)[1] = out; // it writes nothing
    (*words)[2] = format;
    memcpy(*words + 3, argv + 1, (size_t)(argc - 1) * sizeof **words);
    if (!cli_render_job_parse(job, &asked, argc + 2, *words, status)) {
        return false;
    }
    if (!q->has_place) {
        cli_error("explain", "--at X,Y is missing: which pixel?");
    }
    *status = CLI_USAGE;
    return q->has_place;
}

// What rhw render would do and explain does not.
static bool check(const struct question *q, const struct cli_render_job *job)
{
    if (job->kinds != 1u << SCENE_KIND_COLOR) {
        cli_error("--output", "cannot be explained");
        return false;
    }
    if (job->fragment_shader) {
        cli_error("--fragment-shader", "cannot be explained");
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
    struct question question = {0};
    struct render render = {0};
    char **words;
    int status = CLI_USAGE;
    if (parse(&question, &render.job, argc, argv, &words, &status) && check(&question, &render.job)) {
        status = CLI_FAILED;
        render.job.offers_time = true;
        if (cli_render_prepare(&render)) {
            status = cli_render_open(&render, render.job.model_paths[0]);
        }
        if (status == CLI_OK && !tell(&question, &render)) {
            status = CLI_FAILED;
        }
        cli_render_forget_model(&render);
        cli_render_release(&render);
    }
    free(words);
    return status;
}
