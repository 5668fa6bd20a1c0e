// SPDX-License-Identifier: MIT
// Recording: whether a pass tells what the work on its tiles was. run/run.c and kernels/tile.c fill the reports in.
#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "enter.h"
#include "pass_state.h"
#include "rhw/stats.h"

static int tile_count(const struct rhw_pass_state *pass)
{
    return pass->tiles_x * pass->tiles_y * pass->layers;
}

int rhw_pass_tile_count(rhw_context *context, rhw_pass id)
{
    const struct rhw_pass_state *const pass = rhw_pass_enter(context, id, "rhw_pass_tile_count");
    if (!pass) {
        return 0;
    }
    const int count = tile_count(pass);
    rhw_context_leave(context);
    return count;
}

static bool check(const struct rhw_context *context, const struct rhw_pass_state *pass,
                  const struct rhw_tile_report *reports, int count, const char *where)
{
    return rhw_check(context, reports, "%s: reports is NULL", where) &&
           rhw_check(context, count == tile_count(pass), "%s: count is %d; the pass has %d tiles", where,
                     count, tile_count(pass)) &&
           rhw_check(context, !pass->tile_reports, "%s: the pass reports already", where);
}

static struct rhw_tile_report empty_report(const struct rhw_pass_state *pass, int number)
{
    const int in_layer = number % (pass->tiles_x * pass->tiles_y);
    const int x = in_layer % pass->tiles_x * RHW_TILE, y = in_layer / pass->tiles_x * RHW_TILE;
    return (struct rhw_tile_report){.x = x,
                                    .y = y,
                                    .width = pass->width - x < RHW_TILE ? pass->width - x : RHW_TILE,
                                    .height = pass->height - y < RHW_TILE ? pass->height - y : RHW_TILE,
                                    .layer = number / (pass->tiles_x * pass->tiles_y)};
}

void rhw_pass_report_tiles(rhw_context *context, rhw_pass id, struct rhw_tile_report *reports, int count)
{
    static const char *const where = "rhw_pass_report_tiles";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (check(context, pass, reports, count, where)) {
        for (int i = 0; i < count; i++) {
            reports[i] = empty_report(pass, i);
        }
        pass->tile_reports = reports;
    }
    rhw_context_leave(context);
}
