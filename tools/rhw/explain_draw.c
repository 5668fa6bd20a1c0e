// SPDX-License-Identifier: MIT
// See explain_draw.h.
#include "explain_draw.h"

#include "draw/vicinity.h"
#include "message.h"

bool cli_explain_check(const struct cli_render_job *job, int x, int y, int sample)
{
    if (job->transparency != SCENE_TRANSPARENCY_SORTED) {
        cli_error("--transparency",
                  "cannot be explained; without it the same surfaces are told in another order");
        return false;
    }
    const char *const option = job->view_count > 0     ? "--views"
                               : cli_render_moves(job) ? "--animate and --turntable"
                                                       : NULL;
    if (option) {
        cli_error(option, "cannot be explained");
        return false;
    }
    if (x >= job->width || y >= job->height) {
        cli_error("--at", "%d,%d lies outside the picture, which is %dx%d", x, y, job->width, job->height);
        return false;
    }
    const int samples = job->samples * job->supersample;
    if (sample >= samples) {
        cli_error("--sample", "%d is too many: a pixel has %d, 0 to %d", sample, samples, samples - 1);
        return false;
    }
    return true;
}

// For who asked where nothing is.
static void find_nearest(const uint32_t *objects, struct cli_explanation *e)
{
    int64_t least = INT64_MAX;
    for (int y = 0; y < e->height; y++) {
        for (int x = 0; x < e->width; x++) {
            const int64_t dx = x - e->x, dy = y - e->y, distance2 = dx * dx + dy * dy;
            if (objects[(size_t)y * (size_t)e->width + (size_t)x] != 0 && distance2 < least) {
                least = distance2;
                e->has_nearest = true;
                e->nearest_x = x;
                e->nearest_y = y;
            }
        }
    }
}

bool cli_explain_draw(struct render *render, int x, int y, int sample, struct cli_history *history,
                      struct cli_explanation *explanation)
{
    *history = (struct cli_history){0};
    const int side = scene_view_grid_side(&render->view), samples = render->view.samples;
    const int drawn = sample / samples; // of the grid, row by row
    const struct scene_explain explain = {.x = side * x + drawn % side,
                                          .y = side * y + drawn / side,
                                          .sample = sample % samples,
                                          .fragment = cli_history_add,
                                          .user = history};
    render->view.explain = &explain;
    render->view.outputs |= SCENE_OUTPUT_OBJECT;
    bool is_drawn = cli_render_draw(render);
    render->view.explain = NULL;
    if (is_drawn && history->failed) {
        cli_error(render->job.model_path, "out of memory");
        is_drawn = false;
    }
    if (!is_drawn) {
        cli_history_free(history);
        return false;
    }
    *explanation = (struct cli_explanation){.model_path = render->job.model_path,
                                            .model = render->model,
                                            .history = history,
                                            .x = x,
                                            .y = y,
                                            .width = render->view.width,
                                            .height = render->view.height,
                                            .side = side,
                                            .drawn_x = explain.x,
                                            .drawn_y = explain.y,
                                            .drawn_width = side * render->view.width,
                                            .drawn_height = side * render->view.height,
                                            .sample = explain.sample,
                                            .samples = samples,
                                            .picture = render->pictures.color,
                                            .is_orthographic = render->view.camera.orthographic};
    scene_vicinity_origin(render->model, &render->view.camera, explanation->origin);
    find_nearest(render->pictures.object, explanation);
    return true;
}
