// SPDX-License-Identifier: MIT
// Enumerators of pipelines, from Vulkan to librhw. A value that Vulkan does not have becomes the first one.
#ifndef VULKAN_PIPELINE_ENUMS_H
#define VULKAN_PIPELINE_ENUMS_H

#include <vulkan/vulkan_core.h>

#include "rhw/types.h"

enum rhw_stencil_operation vulkan_stencil_operation(VkStencilOp operation);
enum rhw_blend_factor vulkan_blend_factor(VkBlendFactor factor);
enum rhw_blend_operation vulkan_blend_operation(VkBlendOp operation);
enum rhw_logic vulkan_logic(VkLogicOp operation);
enum rhw_topology vulkan_topology(VkPrimitiveTopology topology);

#endif
