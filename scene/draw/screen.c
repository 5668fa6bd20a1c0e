// SPDX-License-Identifier: MIT
#include "screen.h"

static enum rhw_result record(rhw_context *context, rhw_pass pass, const struct rhw_pipeline_def *def,
                              const void *uniforms)
{
    rhw_pipeline pipeline;
    const enum rhw_result result = rhw_pipeline_create(context, def, &pipeline);
    if (result == RHW_OK) {
        rhw_pass_set_pipeline(context, pass, pipeline);
        rhw_pass_set_uniforms(context, pass, uniforms, def->program.uniform_size);
        rhw_pass_draw(context, pass, 0, 3, 0, 1);
        rhw_pipeline_destroy(context, pipeline); // waits for the pass
    }
    return result;
}

enum rhw_result scene_screen_record(rhw_context *context, rhw_pass pass, enum scene_screen_kind kind,
                                    const enum rhw_format *formats, int format_count, const void *uniforms)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    scene_program_screen(&def.program, kind);
    def.target_count = format_count;
    for (int i = 0; i < format_count; i++) {
        def.targets[i] =
            (struct rhw_color_target){.format = formats[i], .write_mask = i == 0 ? 0 : RHW_WRITE_NONE};
    }
    return record(context, pass, &def, uniforms);
}

enum rhw_result scene_screen_lay(rhw_context *context, rhw_pass pass, const enum rhw_format *formats,
                                 int format_count, const struct scene_layer *layer)
{
    const struct rhw_blend_component over = {RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    scene_program_screen(&def.program, SCENE_SCREEN_LAYER);
    def.program.uses |= layer->samples > 1 ? RHW_USE_SAMPLE : 0;
    def.target_count = format_count;
    for (int i = 0; i < format_count; i++) {
        def.targets[i] =
            (struct rhw_color_target){.format = formats[i], .blend = true, .color = over, .alpha = over};
    }
    return record(context, pass, &def, layer);
}

enum rhw_result scene_screen_begin(rhw_context *context, rhw_texture texture, rhw_pass *pass)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 1;
    def.colors[0] = (struct rhw_color_attachment){.texture = texture, .load = RHW_LOAD_DISCARD};
    def.depth = (struct rhw_depth_attachment){.enabled = false};
    return rhw_pass_begin(context, &def, pass);
}

enum rhw_result scene_pass_end(rhw_context *context, rhw_pass pass, enum rhw_result so_far,
                               struct rhw_stats *stats)
{
    const enum rhw_result result = rhw_pass_end(context, pass, stats);
    return so_far != RHW_OK ? so_far : result;
}
