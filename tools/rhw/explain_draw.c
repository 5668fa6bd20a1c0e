// SPDX-License-Identifier: MIT
// See explain_draw.h.
#include "explain_draw.h"

#include "message.h"

bool cli_explain_check(const struct cli_render_job *job, int x, int y, int sample)
{
    const char *const option = job->supersample > 1                             ? "--supersample"
                               : job->transparency != SCENE_TRANSPARENCY_SORTED ? "--transparency"
                               : job->view_count > 0                            ? "--views"
                               : cli_render_moves(job)                          ? "--animate and --turntable"
                                                                                : NULL;
    if (option) {
        cli_error(option, "cannot be explained");
        return false;
    }
    if (x >= job->width || y >= job->height) {
        cli_error("--at", "%d,%d lies outside the picture, which is %dx%d", x, y, job->width, job->height);
        return false;
    }
    if (sample >= job->samples) {
        cli_error("--sample", "%d is too many: a pixel has %d, 0 to %d", sample, job->samples,
                  job->samples - 1);
        return false;
    }
    return true;
}

bool cli_explain_draw(struct render *render, int x, int y, int sample, struct cli_history *history,
                      struct cli_explanation *explanation)
{
    *history = (struct cli_history){0};
    const struct scene_explain explain = {
        .x = x, .y = y, .sample = sample, .fragment = cli_history_add, .user = history};
    render->view.explain = &explain;
    bool drawn = cli_render_draw(render);
    render->view.explain = NULL;
    if (drawn && history->failed) {
        cli_error(render->job.model_path, "out of memory");
        drawn = false;
    }
    if (!drawn) {
        cli_history_free(history);
        return false;
    }
    *explanation = (struct cli_explanation){.model_path = render->job.model_path,
                                            .model = render->model,
                                            .history = history,
                                            .x = x,
                                            .y = y,
                                            .sample = sample,
                                            .samples = render->view.samples,
                                            .width = render->view.width,
                                            .height = render->view.height,
                                            .picture = render->pictures.color};
    return true;
}
