// SPDX-License-Identifier: MIT
// Attachments can be cleared within a pass. A clear is recorded as a draw of rectangles with a pipeline of its own. Its
// place among the draws, several samples, and whatever tiles keep about their contents therefore need no code of their
// own.
#include <string.h>

#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/misuse.h"
#include "encoder.h"
#include "pipeline/pipeline.h"
#include "rhw/rhw.h"

static const char *const where = "rhw_pass_clear_attachments";

struct clear_uniforms {
    float color[RHW_MAX_COLOR_ATTACHMENTS][4];
    float depth;
    int32_t color_count;
    bool writes_layer;
};

// This vertex function makes a triangle around everything, for every instance in its layer.
static void cover(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct clear_uniforms *const uniforms = groups[g].uniforms;
        const rhw_float index = rhw_float_from_int(groups[g].vertex_index);
        groups[g].position[0] = rhw_select(rhw_equal(index, 1.0f), rhw_splat(3), rhw_splat(-1));
        groups[g].position[1] = rhw_select(rhw_equal(index, 2.0f), rhw_splat(3), rhw_splat(-1));
        groups[g].position[2] = rhw_splat(uniforms->depth);
        groups[g].position[3] = rhw_splat(1);
        if (uniforms->writes_layer) {
            groups[g].layer = groups[g].instance_index;
        }
    }
}

static void fill(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct clear_uniforms *const uniforms = groups[g].uniforms;
        for (int t = 0; t < uniforms->color_count; t++) {
            for (int c = 0; c < 4; c++) {
                groups[g].color[t][c] = rhw_splat(uniforms->color[t][c]);
            }
        }
    }
}

// Checks ----------------------------------------------------------------------------------------------

static bool check_rects(const struct rhw_encoder *encoder, const struct rhw_clear *clear)
{
    const struct rhw_context *const context = encoder->context;
    const struct rhw_rect *const area = &encoder->pass->target.area;
    if (!rhw_check(context, clear->rect_count >= 0 && (clear->rects || clear->rect_count == 0),
                   "%s: rect_count is %d and rects is %s", where, clear->rect_count,
                   clear->rects ? "set" : "NULL")) {
        return false;
    }
    for (int i = 0; i < clear->rect_count; i++) {
        const struct rhw_rect *const r = &clear->rects[i];
        if (!rhw_check(context,
                       r->x >= area->x && r->y >= area->y && r->width > 0 && r->height > 0 &&
                           r->width <= area->width - (r->x - area->x) &&
                           r->height <= area->height - (r->y - area->y),
                       "%s: rects[%d] is %d,%d %dx%d; it lies within the pass's render area, %d,%d %dx%d",
                       where, i, r->x, r->y, r->width, r->height, area->x, area->y, area->width,
                       area->height)) {
            return false;
        }
    }
    return true;
}

static bool check(const struct rhw_encoder *encoder, const struct rhw_clear *clear)
{
    const struct rhw_target *const target = &encoder->pass->target;
    const struct rhw_context *const context = encoder->context;
    return rhw_check(context, clear != NULL, "%s: clear is NULL", where) &&
           rhw_check(context, clear->colors >> target->color_count == 0,
                     "%s: colors is 0x%x; the pass has %d colour attachments", where, clear->colors,
                     target->color_count) &&
           rhw_check(context, clear->colors != 0 || clear->depth || clear->stencil,
                     "%s: colors is 0, depth and stencil are false: nothing is to be cleared", where) &&
           rhw_check(context, !clear->depth || target->has_depth, "%s: the pass has no depth attachment",
                     where) &&
           rhw_check(context, !clear->stencil || target->has_stencil,
                     "%s: the pass has no stencil attachment", where) &&
           rhw_check(context, !clear->depth || !target->depth.is_read_only,
                     "%s: depth is true and the pass has it read_only", where) &&
           rhw_check(context, !clear->stencil || !target->stencil.is_read_only,
                     "%s: stencil is true and the pass has it read_only", where) &&
           rhw_check(context, clear->depth_value >= 0 && clear->depth_value <= 1,
                     "%s: depth_value is %g; it is in 0..1", where, (double)clear->depth_value) &&
           rhw_check(context,
                     clear->layer >= 0 && clear->layer_count >= 0 && clear->layer < target->layers &&
                         clear->layer_count <= target->layers - clear->layer,
                     "%s: layer is %d and layer_count %d; the pass has %d", where, clear->layer,
                     clear->layer_count, target->layers) &&
           check_rects(encoder, clear);
}

// Drawing ---------------------------------------------------------------------------------------------

static struct rhw_pipeline_def pipeline_of(const struct rhw_encoder *encoder, const struct rhw_clear *clear)
{
    const struct rhw_target *const target = &encoder->pass->target;
    const struct rhw_stencil_face replace = {.pass = RHW_STENCIL_REPLACE};
    struct rhw_pipeline_def def = {
        .program = {.vertex = {cover}, .uniform_size = sizeof(struct clear_uniforms)},
        .target_count = target->color_count,
        .depth_test = clear->depth,
        .depth_compare = RHW_COMPARE_ALWAYS,
        .depth_clip_disabled = true, // 0 and 1 lie on the planes
        .stencil_test = clear->stencil,
        .stencil_front = clear->stencil ? replace : (struct rhw_stencil_face){0},
        .stencil_back = clear->stencil ? replace : (struct rhw_stencil_face){0},
        .label = "rhw_pass_clear_attachments"};
    def.program.writes_layer = target->layers > 1;
    def.program.fragment[RHW_ISA_BASELINE] = clear->colors != 0 ? fill : NULL;
    for (int i = 0; i < target->color_count; i++) {
        def.targets[i].format = target->colors[i].is_left_out ? RHW_FORMAT_NONE : target->colors[i].format;
        def.targets[i].write_mask = clear->colors >> i & 1 ? 0 : RHW_WRITE_NONE;
    }
    return def;
}

static struct clear_uniforms uniforms_of(const struct rhw_encoder *encoder, const struct rhw_clear *clear)
{
    const struct rhw_target *const target = &encoder->pass->target;
    struct clear_uniforms uniforms = {.depth = clear->depth ? clear->depth_value : 0,
                                      .color_count = target->color_count,
                                      .writes_layer = target->layers > 1};
    for (int i = 0; i < target->color_count; i++) {
        const struct rhw_format_info *const info = rhw_format_info(target->colors[i].format);
        const void *const value =
            rhw_format_is_integer(info) ? (const void *)clear->color_integer[i] : clear->color[i];
        memcpy(uniforms.color[i], value, sizeof uniforms.color[i]);
    }
    return uniforms;
}

// Return the pipeline of a clear, which belongs to the pass. Return NULL when out of memory.
static const struct rhw_pipeline_data *make_pipeline(struct rhw_encoder *encoder,
                                                     const struct rhw_clear *clear)
{
    const struct rhw_pipeline_def def = pipeline_of(encoder, clear);
    struct rhw_pipeline_data *const pipeline =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *pipeline, RHW_CACHE_LINE);
    if (pipeline) {
        rhw_pipeline_data_init(pipeline, &def, encoder->context->isa);
    }
    return pipeline;
}

static void draw(rhw_context *context, rhw_pass id, struct rhw_encoder *encoder,
                 const struct rhw_clear *clear, const struct rhw_pipeline_data *pipeline)
{
    const struct rhw_target *const target = &encoder->pass->target;
    const struct rhw_viewport viewport = {0, 0, (float)target->width, (float)target->height, 0, 1};
    const struct rhw_rect whole = {0, 0, target->width, target->height};
    const struct clear_uniforms uniforms = uniforms_of(encoder, clear);
    const int layers = clear->layer_count != 0 ? clear->layer_count : target->layers - clear->layer;
    encoder->pending.pipeline = pipeline;
    encoder->pending_changed = true;
    rhw_pass_set_viewport(context, id, &viewport);
    rhw_pass_set_uniforms(context, id, &uniforms, sizeof uniforms);
    rhw_pass_set_stencil_reference(context, id, clear->stencil_value, clear->stencil_value);
    rhw_pass_set_stencil_masks(context, id, NULL);
    rhw_pass_set_depth_bias(context, id, NULL);
    for (int i = 0; i < (clear->rect_count > 0 ? clear->rect_count : 1); i++) {
        rhw_pass_set_scissor(context, id, clear->rect_count > 0 ? &clear->rects[i] : &whole);
        rhw_pass_draw(context, id, 0, 3, (uint32_t)clear->layer, (uint32_t)layers);
    }
}

// A clear leaves what recording has set as it was, and keeps it here meanwhile.
struct kept_state {
    struct rhw_draw_state pending;
    struct rhw_bound bound;
    struct rhw_viewport viewport;
    struct rhw_rect scissor;
    const void *uniforms;
    uint32_t uniform_size;
    bool refused_pipeline, has_feedback;
};

static void keep_state(struct rhw_encoder *encoder, struct kept_state *kept)
{
    *kept = (struct kept_state){.pending = encoder->pending,
                                .bound = encoder->bound,
                                .viewport = encoder->viewports[0],
                                .scissor = encoder->scissors[0],
                                .uniforms = encoder->uniforms,
                                .uniform_size = encoder->uniform_size,
                                .refused_pipeline = encoder->refused_pipeline,
                                .has_feedback = encoder->feedback.is_active};
    encoder->pending.queries = NULL;
    encoder->feedback.is_active = false;
}

static void restore_state(struct rhw_encoder *encoder, const struct kept_state *kept)
{
    encoder->pending = kept->pending;
    encoder->bound = kept->bound;
    encoder->viewports[0] = kept->viewport;
    encoder->scissors[0] = kept->scissor;
    encoder->uniforms = kept->uniforms;
    encoder->uniform_size = kept->uniform_size;
    encoder->refused_pipeline = kept->refused_pipeline;
    encoder->feedback.is_active = kept->has_feedback;
    encoder->pending_changed = true;
}

void rhw_pass_clear_attachments(rhw_context *context, rhw_pass id, const struct rhw_clear *clear)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    const bool is_good = check(encoder, clear);
    rhw_context_leave(context);
    if (!is_good) {
        return;
    }
    const struct rhw_pipeline_data *const pipeline = make_pipeline(encoder, clear);
    if (!pipeline) {
        encoder->out_of_memory = true;
        return;
    }
    struct kept_state kept;
    keep_state(encoder, &kept);
    draw(context, id, encoder, clear, pipeline);
    restore_state(encoder, &kept);
}
