// SPDX-License-Identifier: MIT
// Recording: whether a pass tells what the work on its tiles was. run/run.c and kernels/tile.c fill the reports in.
#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "enter.h"
#include "encoder.h"
#include "rhw/stats.h"

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

static bool check(const struct rhw_context *context, const struct rhw_encoder *encoder,
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

void rhw_pass_report_tiles(rhw_context *context, rhw_pass id, struct rhw_tile_report *reports, int count)
{
    static const char *const where = "rhw_pass_report_tiles";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check(context, encoder, reports, count, where)) {
        for (int i = 0; i < count; i++) {
            reports[i] = empty_report(&encoder->pass->target, i);
        }
        encoder->pass->tile_reports = reports;
    }
    rhw_context_leave(context);
}
