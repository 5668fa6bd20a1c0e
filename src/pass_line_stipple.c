// SPDX-License-Identifier: MIT
// Recording: what a pass sets of lines.
#include "pass_line_stipple.h"

#include "context.h"
#include "entry.h"
#include "misuse.h"
#include "pass_enter.h"
#include "pass_state.h"
#include "pipeline.h"
#include "rhw/rhw.h"

struct rhw_line_stipple rhw_line_stipple_of(const struct rhw_line_stipple_setting *setting,
                                            const struct rhw_pipeline_data *pipeline)
{
    const bool is_lines =
        pipeline->primitive == RHW_PRIMITIVE_LINES || pipeline->primitive == RHW_PRIMITIVE_POLYGON_LINES;
    return !is_lines         ? (struct rhw_line_stipple){0}
           : setting->is_set ? setting->stipple
                             : pipeline->def.line_stipple;
}

void rhw_pass_set_line_stipple(rhw_context *context, rhw_pass id, const struct rhw_line_stipple *stipple)
{
    static const char *const where = "rhw_pass_set_line_stipple";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (!stipple || rhw_check_line_stipple(context, stipple, where)) {
        pass->pending.stipple_setting.is_set = stipple != NULL;
        pass->pending.stipple_setting.stipple = stipple ? *stipple : (struct rhw_line_stipple){0};
        pass->pending_changed = true;
    }
    rhw_context_leave(context);
}
