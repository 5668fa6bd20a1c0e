// SPDX-License-Identifier: MIT
// Pipeline layouts. Pipelines of a layout hold it, so a program may destroy it before them.
#ifndef VULKAN_PIPELINE_LAYOUT_H
#define VULKAN_PIPELINE_LAYOUT_H

#include "descriptor/set_layout.h"
#include "rhw/spirv.h"

struct VkPipelineLayout_T {
    /// Callbacks of the device: those of the layout may be gone when its last user is.
    const VkAllocationCallbacks *callbacks;
    atomic_uint users;
    uint32_t set_count;
    VkDescriptorSetLayout sets[RHW_SHADER_MAX_SETS]; ///< NULL where there is none
};

void vulkan_pipeline_layout_hold(VkPipelineLayout layout);
void vulkan_pipeline_layout_release(VkPipelineLayout layout);

// Return how many bindings the sets have numbers for, and write them to `places`, which may be NULL.
uint32_t vulkan_pipeline_layout_places(VkPipelineLayout layout, struct rhw_shader_layout *places);

#endif
