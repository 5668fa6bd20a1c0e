// SPDX-License-Identifier: MIT
#include "pipeline_targets.h"

static bool writes_stencil(const struct rhw_stencil_face *face)
{
    return face->fail != RHW_STENCIL_KEEP || face->depth_fail != RHW_STENCIL_KEEP ||
           face->pass != RHW_STENCIL_KEEP;
}

static bool colors_fit(const struct vulkan_targets *targets, const struct rhw_pipeline_def *def)
{
    bool fit = def->target_count == targets->count;
    for (int i = 0; fit && i < targets->count; i++) {
        fit = def->targets[i].format == targets->formats[i];
    }
    return fit;
}

bool vulkan_targets_fit(const struct vulkan_targets *targets, const struct rhw_pipeline_def *def)
{
    const bool tests_depth = def->depth_test || def->depth_bounds_test;
    return colors_fit(targets, def) && (targets->has_depth || !tests_depth) &&
           (targets->has_stencil || !def->stencil_test) &&
           (!targets->keeps_depth || !def->depth_test || def->depth_read_only) &&
           (!targets->keeps_stencil || !def->stencil_test ||
            !(writes_stencil(&def->stencil_front) || writes_stencil(&def->stencil_back)));
}

static void keep_stencil(struct rhw_stencil_face *face)
{
    face->fail = face->depth_fail = face->pass = RHW_STENCIL_KEEP;
}

void vulkan_targets_adapt(const struct vulkan_targets *targets, struct rhw_pipeline_def *def)
{
    for (int i = 0; i < RHW_MAX_COLOR_ATTACHMENTS; i++) {
        struct rhw_color_target *const target = &def->targets[i];
        const enum rhw_format format = i < targets->count ? targets->formats[i] : RHW_FORMAT_NONE;
        if (format == RHW_FORMAT_NONE) {
            *target = (struct rhw_color_target){.format = RHW_FORMAT_NONE};
        } else if (i >= def->target_count || target->format == RHW_FORMAT_NONE) {
            *target = (struct rhw_color_target){.format = format, .write_mask = RHW_WRITE_NONE};
        }
        target->format = format;
        target->blend = target->blend && (rhw_format_features(format) & RHW_FEATURE_BLENDED);
    }
    def->target_count = targets->count;
    def->depth_test = def->depth_test && targets->has_depth;
    def->depth_bounds_test = def->depth_bounds_test && targets->has_depth;
    def->depth_read_only = def->depth_read_only || targets->keeps_depth;
    def->stencil_test = def->stencil_test && targets->has_stencil;
    if (targets->keeps_stencil) {
        keep_stencil(&def->stencil_front);
        keep_stencil(&def->stencil_back);
    }
}

bool vulkan_targets_are_equal(const struct vulkan_targets *a, const struct vulkan_targets *b)
{
    bool are = a->count == b->count && a->has_depth == b->has_depth && a->has_stencil == b->has_stencil &&
               a->keeps_depth == b->keeps_depth && a->keeps_stencil == b->keeps_stencil;
    for (int i = 0; are && i < a->count; i++) {
        are = a->formats[i] == b->formats[i];
    }
    return are;
}
