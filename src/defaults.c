// SPDX-License-Identifier: MIT
// What zero stands for in the definition structs, written out, and one colour target. Fields that are not named are
// zero. tests/unit/context/test_zero.c draws with zeros and with these definitions.
#include "rhw/pass_def.h"

struct rhw_context_def rhw_context_def_default(void)
{
    return (struct rhw_context_def){.isa_limit = RHW_ISA_BEST};
}

struct rhw_buffer_def rhw_buffer_def_default(void)
{
    return (struct rhw_buffer_def){.size = 0};
}

struct rhw_texture_def rhw_texture_def_default(void)
{
    return (struct rhw_texture_def){.format = RHW_FORMAT_RGBA8_UNORM, .mip_levels = 1};
}

struct rhw_sampler_def rhw_sampler_def_default(void)
{
    return (struct rhw_sampler_def){
        .min_filter = RHW_FILTER_LINEAR,
        .mag_filter = RHW_FILTER_LINEAR,
        .mip_filter = RHW_MIP_FILTER_LINEAR,
        .address_u = RHW_ADDRESS_REPEAT,
        .address_v = RHW_ADDRESS_REPEAT,
        .lod_max = 1000,
    };
}

struct rhw_pipeline_def rhw_pipeline_def_default(void)
{
    struct rhw_pipeline_def def = {
        .topology = RHW_TRIANGLE_LIST,
        .provoking = RHW_PROVOKING_FIRST,
        .cull = RHW_CULL_NONE,
        .front = RHW_COUNTER_CLOCKWISE,
        .depth_range = RHW_DEPTH_ZERO_TO_ONE,
        .depth_compare = RHW_COMPARE_LESS,
        .target_count = 1,
    };
    const uint8_t all = RHW_WRITE_RED | RHW_WRITE_GREEN | RHW_WRITE_BLUE | RHW_WRITE_ALPHA;
    const struct rhw_blend_component replace = {RHW_BLEND_ONE, RHW_BLEND_ZERO, RHW_BLEND_ADD};
    for (int i = 0; i < RHW_MAX_COLOR_ATTACHMENTS; i++) {
        def.targets[i] = (struct rhw_color_target){
            .format = RHW_FORMAT_RGBA8_UNORM, .color = replace, .alpha = replace, .write_mask = all};
    }
    return def;
}

struct rhw_pass_def rhw_pass_def_default(void)
{
    struct rhw_pass_def def = {.color_count = 1, .depth = {.clear = 1}};
    for (int i = 0; i < RHW_MAX_COLOR_ATTACHMENTS; i++) {
        def.colors[i].load = RHW_LOAD_CLEAR;
        def.colors[i].store = RHW_STORE_STORE;
    }
    def.depth.load = RHW_LOAD_CLEAR;
    def.depth.store = RHW_STORE_STORE;
    return def;
}
