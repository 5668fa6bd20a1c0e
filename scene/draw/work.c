// SPDX-License-Identifier: MIT
// Pictures of the work on the tiles of the colour pass.
#include "drawing.h"

#include <stdlib.h>

bool scene_work_begin(const struct draw *draw, rhw_pass pass, struct scene_work *work)
{
    rhw_context *const context = draw->scene->upload.context;
    *work = (struct scene_work){0};
    if (!draw->pictures->tiles && !draw->pictures->plan) {
        return true;
    }
    const int count = rhw_pass_tile_count(context, pass);
    work->reports = calloc((size_t)count, sizeof *work->reports);
    if (!work->reports) {
        return false;
    }
    work->count = count;
    rhw_pass_report_tiles(context, pass, work->reports, count);
    return true;
}

// Return a report without the background, which is one triangle over the whole picture without a depth test. It alone
// goes backwards in depth: what tests depth never does.
static struct rhw_tile_report of_the_model(const struct draw *draw, const struct rhw_tile_report *report)
{
    struct rhw_tile_report model = *report;
    if (scene_background_is_drawn(draw)) {
        model.triangles -= model.triangles > 0;
        model.orders = model.triangles > 0 ? model.orders & ~(uint32_t)RHW_TILE_BACKWARDS : 0;
    }
    return model;
}

// A tile of a pass that has several pixels for one of the picture has those whose first one lies in it.
static void note_tile(const struct draw *draw, const struct rhw_tile_report *report)
{
    const struct scene_pictures *const pictures = draw->pictures;
    const int side = draw->side, width = draw->view->width;
    const int x0 = (report->x + side - 1) / side, x1 = (report->x + report->width + side - 1) / side;
    const int rows = scene_band_height(draw);
    const int y0 = (report->y + side - 1) / side, end = (report->y + report->height + side - 1) / side;
    const int y1 = end < rows ? end : rows;
    for (int y = y0; y < y1; y++) {
        const size_t row = (size_t)(draw->first_row + y) * (size_t)width;
        for (int x = x0; x < x1; x++) {
            if (pictures->tiles) {
                pictures->tiles[row + (size_t)x] = (uint32_t)report->triangles;
            }
            if (pictures->plan) {
                pictures->plan[row + (size_t)x] = report->orders;
            }
        }
    }
}

void scene_work_end(const struct draw *draw, struct scene_work *work)
{
    for (int i = 0; i < work->count; i++) {
        const struct rhw_tile_report report = of_the_model(draw, &work->reports[i]);
        note_tile(draw, &report);
    }
    free(work->reports);
    *work = (struct scene_work){0};
}
