// SPDX-License-Identifier: MIT
// A program may ask a pass for the history of a sample, and for the work on each tile. The questions are recorded here,
// and tiles fill in the answers.
#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "encoder.h"
#include "pass_end.h"
#include "rhw/explain.h"
#include "rhw/stats.h"

static bool check_explain(const struct rhw_context *context, const struct rhw_encoder *encoder,
                          const struct rhw_explain *explain, const char *where)
{
    const struct rhw_target *const target = &encoder->pass->target;
    const struct rhw_rect *const area = &target->area;
    return rhw_check(context, explain && explain->fragment, "%s: explain.fragment is NULL", where) &&
           rhw_check(context, encoder->pass->draws.count == 0,
                     "%s: the pass has drawn already; call it before", where) &&
           rhw_check(context, !encoder->pass->explained.ask.fragment,
                     "%s: the pass explains a sample already", where) &&
           rhw_check(context,
                     explain->x >= area->x && explain->x - area->x < area->width && explain->y >= area->y &&
                         explain->y - area->y < area->height,
                     "%s: (%d, %d) lies outside of what the pass draws, %d,%d %dx%d", where, explain->x,
                     explain->y, area->x, area->y, area->width, area->height) &&
           rhw_check(context, explain->layer >= 0 && explain->layer < target->layers,
                     "%s: layer is %d; the pass has %d", where, explain->layer, target->layers) &&
           rhw_check(context, explain->sample >= 0 && explain->sample < target->pattern->count,
                     "%s: sample is %d; a pixel has %d", where, explain->sample, target->pattern->count);
}

void rhw_pass_explain(rhw_context *context, rhw_pass id, const struct rhw_explain *explain)
{
    static const char *const where = "rhw_pass_explain";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_explain(context, encoder, explain, where)) {
        const struct rhw_target *const target = &encoder->pass->target;
        struct rhw_explained *const explained = &encoder->pass->explained;
        explained->ask = *explain;
        explained->tile = explain->layer * target->tiles_x * target->tiles_y +
                          explain->y / RHW_TILE * target->tiles_x + explain->x / RHW_TILE;
        explained->x = explain->x % RHW_TILE;
        explained->y = explain->y % RHW_TILE;
        encoder->pass->paths = RHW_PATHS_GENERAL;
    }
    rhw_context_leave(context);
}

int rhw_pass_tile_count(rhw_context *context, rhw_pass id)
{
    const struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_tile_count");
    if (!encoder) {
        return 0;
    }
    const int count = rhw_target_tiles(&encoder->pass->target);
    rhw_context_leave(context);
    return count;
}

static bool check_reports(const struct rhw_context *context, const struct rhw_encoder *encoder,
                          const struct rhw_tile_report *reports, int count, const char *where)
{
    const int tiles = rhw_target_tiles(&encoder->pass->target);
    return rhw_check(context, reports, "%s: reports is NULL", where) &&
           rhw_check(context, count == tiles, "%s: count is %d; the pass has %d tiles", where, count,
                     tiles) &&
           rhw_check(context, !encoder->pass->tile_reports, "%s: the pass reports already", where);
}

static struct rhw_tile_report empty_report(const struct rhw_target *target, int number)
{
    const int in_layer = number % (target->tiles_x * target->tiles_y);
    const int x = in_layer % target->tiles_x * RHW_TILE, y = in_layer / target->tiles_x * RHW_TILE;
    return (struct rhw_tile_report){.x = x,
                                    .y = y,
                                    .width = target->width - x < RHW_TILE ? target->width - x : RHW_TILE,
                                    .height = target->height - y < RHW_TILE ? target->height - y : RHW_TILE,
                                    .layer = number / (target->tiles_x * target->tiles_y)};
}

void rhw_pass_empty_reports(struct rhw_recorded_pass *pass)
{
    for (int i = 0; pass->tile_reports && i < rhw_target_tiles(&pass->target); i++) {
        pass->tile_reports[i] = empty_report(&pass->target, i);
    }
}

void rhw_pass_report_tiles(rhw_context *context, rhw_pass id, struct rhw_tile_report *reports, int count)
{
    static const char *const where = "rhw_pass_report_tiles";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_reports(context, encoder, reports, count, where)) {
        encoder->pass->tile_reports = reports;
        rhw_pass_empty_reports(encoder->pass);
    }
    rhw_context_leave(context);
}
