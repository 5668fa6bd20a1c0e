// SPDX-License-Identifier: MIT
// The fixed state of a graphics pipeline, from Vulkan to librhw.
#ifndef VULKAN_PIPELINE_STATE_H
#define VULKAN_PIPELINE_STATE_H

#include "pipeline.h"

// Fill the definition, the state and the samples of a pipeline whose shaders are linked. `inputs` are those of its
// vertex shader.
void vulkan_pipeline_state_fill(VkPipeline pipeline, const VkGraphicsPipelineCreateInfo *info,
                                const struct rhw_shader_info *inputs);

// Return VK_SUCCESS if librhw takes the definitions of all variants, or else VK_ERROR_UNKNOWN; the log tells why.
VkResult vulkan_pipeline_state_check(VkPipeline pipeline);

// Set *def to the definition with the program of a variant.
void vulkan_pipeline_definition(VkPipeline pipeline, uint32_t variant, struct rhw_pipeline_def *def);

#endif
