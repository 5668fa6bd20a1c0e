// SPDX-License-Identifier: MIT
#include "shader_module.h"
#include <stdlib.h>
#include <string.h>

VkResult vkCreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo *info,
                              const VkAllocationCallbacks *allocator, VkShaderModule *module)
{
    *module = vulkan_device_allocate(device, allocator, sizeof **module + info->codeSize);
    if (!*module) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*module)->size = info->codeSize;
    memcpy((*module)->words, info->pCode, info->codeSize);
    return VK_SUCCESS;
}

void vkDestroyShaderModule(VkDevice device, VkShaderModule module, const VkAllocationCallbacks *allocator)
{
    vulkan_device_free(device, allocator, module);
}

// Return the constants of a stage, or NULL if there are none or there is no memory for them; *count tells which.
static struct rhw_shader_constant *read_constants(const VkSpecializationInfo *info, uint32_t *count)
{
    *count = info ? info->mapEntryCount : 0;
    struct rhw_shader_constant *const constants = *count > 0 ? calloc(*count, sizeof *constants) : NULL;
    for (uint32_t i = 0; constants && i < *count; i++) {
        const VkSpecializationMapEntry *const entry = &info->pMapEntries[i];
        constants[i].id = entry->constantID;
        // Constants have 32 bits at most; of a larger one the low word counts.
        const size_t size = entry->size < sizeof(uint32_t) ? entry->size : sizeof(uint32_t);
        if (entry->offset <= info->dataSize && size <= info->dataSize - entry->offset) {
            memcpy(&constants[i].value, (const unsigned char *)info->pData + entry->offset, size);
        }
    }
    return constants;
}

VkResult vulkan_shader_create(VkDevice device, const VkPipelineShaderStageCreateInfo *stage,
                              uint32_t view_index, rhw_shader **shader)
{
    *shader = NULL;
    struct rhw_shader_def def = {
        .entry_point = stage->pName, .view_index = view_index, .cache = device->shaders};
    switch (stage->stage) {
    case VK_SHADER_STAGE_VERTEX_BIT: def.stage = RHW_SHADER_VERTEX; break;
    case VK_SHADER_STAGE_FRAGMENT_BIT: def.stage = RHW_SHADER_FRAGMENT; break;
    case VK_SHADER_STAGE_COMPUTE_BIT: def.stage = RHW_SHADER_COMPUTE; break;
    default: vulkan_log("a shader has a stage that is not supported"); return VK_ERROR_INVALID_SHADER_NV;
    }
    struct rhw_shader_constant *const constants =
        read_constants(stage->pSpecializationInfo, &def.constant_count);
    if (def.constant_count > 0 && !constants) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    def.constants = constants;
    char message[RHW_SHADER_MESSAGE];
    const enum rhw_result result =
        rhw_shader_create(stage->module->words, stage->module->size, &def, shader, message);
    free(constants);
    if (result == RHW_ERROR_MISUSE) {
        vulkan_log("a shader was refused: %s", message);
        return VK_ERROR_INVALID_SHADER_NV;
    }
    return result == RHW_OK ? VK_SUCCESS : VK_ERROR_OUT_OF_HOST_MEMORY;
}
