// SPDX-License-Identifier: MIT
// A pipeline is a linked program of librhw-shader, and of graphics the definition of a pipeline of librhw, which the
// queue's thread creates when a draw first needs it.
#ifndef VULKAN_PIPELINE_H
#define VULKAN_PIPELINE_H

#include "dynamic_state.h"
#include "pipeline_layout.h"
#include "pipeline_targets.h"

// Bindings of a set that the shaders of a pipeline use.
struct vulkan_used_binding {
    uint32_t set, first, count;
};

// What is made for one view of a subpass that has several.
struct vulkan_variant {
    rhw_shader_program *program; ///< NULL for a view that the subpass does not have, but for the first one

    // The queue's thread has this.
    rhw_pipeline pipeline; ///< null id until a draw needs it
    bool is_adapted;       ///< the definition does not fit `targets`, and was adapted to them
    struct vulkan_targets targets;
};

struct VkPipeline_T {
    VkPipelineBindPoint point;
    VkPipelineLayout layout;
    struct vulkan_variant *variants; ///< by number of the view, or one for all views
    uint32_t variant_count;
    struct vulkan_used_binding *used;
    uint32_t used_count;
    uint32_t used_sets; ///< bit s: the shaders use bindings of set s
    uint32_t push_size; ///< bytes of push constants that the shaders read
    bool reads_draw;    ///< they read numbers of the draw too

    // Members of graphics pipelines
    struct rhw_pipeline_def def; ///< its program is that of the first variant
    uint32_t samples;            ///< samples of a pixel
    bool shades_samples;         ///< the fragment function is called for every sample
    bool has_depth_bias;         ///< the depth bias counts, whether a command or `state` gives it
    bool has_line_stipple;       ///< the stipple of lines counts, whether a command or `state` gives it
    uint32_t vertex_buffers;     ///< bit i: an attribute reads vertex buffer i
    struct vulkan_dynamic_state state;
    uint32_t dynamic; ///< or-ed enum vulkan_dynamic: parts that commands set, in place of `state`
};

// Allocate a pipeline with variants. Return NULL without memory.
VkPipeline vulkan_pipeline_allocate(VkDevice device, const VkAllocationCallbacks *allocator,
                                    VkPipelineBindPoint point, VkPipelineLayout layout, uint32_t variants);

// Link shaders to the program of a variant. Shaders that are NULL are left out. If that fails, return a VkResult, and
// leave the pipeline to vulkan_pipeline_free.
VkResult vulkan_pipeline_link(VkDevice device, VkPipeline pipeline, uint32_t variant,
                              const struct rhw_shader_program_def *shaders);

// Free a pipeline that no draw has needed yet.
void vulkan_pipeline_free(VkDevice device, const VkAllocationCallbacks *allocator, VkPipeline pipeline);

#endif
