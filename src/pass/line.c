// SPDX-License-Identifier: MIT
// Recording: what a pass sets of lines.
#include "line.h"

#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "enter.h"
#include "encoder.h"
#include "pipeline/pipeline.h"
#include "rhw/rhw.h"

void rhw_draw_state_set_lines(struct rhw_draw_state *state)
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const bool is_lines =
        pipeline->primitive == RHW_PRIMITIVE_LINES || pipeline->primitive == RHW_PRIMITIVE_POLYGON_LINES;
    state->stipple = !is_lines                       ? (struct rhw_line_stipple){0}
                     : state->stipple_setting.is_set ? state->stipple_setting.stipple
                                                     : pipeline->def.line_stipple;
    const float width = state->line_width_setting != 0 ? state->line_width_setting : pipeline->def.line_width;
    state->line_pixels = (int)(width + 0.5f);
    state->half_width_24_8 = (double)width * (RHW_SUBPIXEL / 2);
}

void rhw_pass_set_line_width(rhw_context *context, rhw_pass id, float width)
{
    static const char *const where = "rhw_pass_set_line_width";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (rhw_check(context, width == 0 || (width >= 1 && width <= RHW_MAX_LINE_WIDTH),
                  "%s: width is %g; it must be 1..%d, or 0 for the pipelines' own", where, (double)width,
                  RHW_MAX_LINE_WIDTH)) {
        encoder->pending.line_width_setting = width;
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}

void rhw_pass_set_line_stipple(rhw_context *context, rhw_pass id, const struct rhw_line_stipple *stipple)
{
    static const char *const where = "rhw_pass_set_line_stipple";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (!stipple || rhw_check_line_stipple(context, stipple, where)) {
        encoder->pending.stipple_setting.is_set = stipple != NULL;
        encoder->pending.stipple_setting.stipple = stipple ? *stipple : (struct rhw_line_stipple){0};
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}
