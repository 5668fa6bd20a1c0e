// SPDX-License-Identifier: MIT
// A shader module is a copy of its words. Each stage of a pipeline translates them with its own constants.
#ifndef VULKAN_SHADER_MODULE_H
#define VULKAN_SHADER_MODULE_H

#include "device/device.h"
#include "rhw/spirv.h"

struct VkShaderModule_T {
    size_t size; ///< bytes
    uint32_t words[];
};

// Translate a stage of a pipeline, for a view of several. Return VK_SUCCESS, VK_ERROR_OUT_OF_HOST_MEMORY, or
// VK_ERROR_INVALID_SHADER_NV for a module that librhw-shader refuses; the log tells why.
VkResult vulkan_shader_create(VkDevice device, const VkPipelineShaderStageCreateInfo *stage,
                              uint32_t view_index, rhw_shader **shader);

#endif
