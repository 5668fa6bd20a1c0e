// SPDX-License-Identifier: MIT
#include "pipeline_state.h"
#include "shader_module.h"

struct stages {
    rhw_shader *vertex, *fragment;
};

static VkResult create_shaders(const VkGraphicsPipelineCreateInfo *info, struct stages *stages)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; result == VK_SUCCESS && i < info->stageCount; i++) {
        const VkPipelineShaderStageCreateInfo *const stage = &info->pStages[i];
        // Fragments that are never made need no shader, and the program may leave it out of what it declares.
        const bool is_fragment = stage->stage == VK_SHADER_STAGE_FRAGMENT_BIT;
        if (!is_fragment || !info->pRasterizationState->rasterizerDiscardEnable) {
            result = vulkan_shader_create(stage, is_fragment ? &stages->fragment : &stages->vertex);
        }
    }
    return result;
}

static VkResult create_pipeline(VkDevice device, const VkGraphicsPipelineCreateInfo *info,
                                const VkAllocationCallbacks *allocator, VkPipeline *pipeline)
{
    *pipeline = VK_NULL_HANDLE;
    VkPipeline made = vulkan_device_allocate(device, allocator, sizeof *made);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->point = VK_PIPELINE_BIND_POINT_GRAPHICS;
    struct stages stages = {NULL, NULL};
    VkResult result = create_shaders(info, &stages);
    if (result == VK_SUCCESS) {
        result = vulkan_pipeline_link(
            made, info->layout,
            &(struct rhw_shader_program_def){.vertex = stages.vertex, .fragment = stages.fragment});
    }
    if (result == VK_SUCCESS) {
        vulkan_pipeline_state_fill(made, info, rhw_shader_get_info(stages.vertex));
        *pipeline = made;
    } else {
        vulkan_pipeline_free(device, allocator, made);
    }
    rhw_shader_destroy(stages.vertex);
    rhw_shader_destroy(stages.fragment);
    return result;
}

VkResult vkCreateGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                   const VkGraphicsPipelineCreateInfo *infos,
                                   const VkAllocationCallbacks *allocator, VkPipeline *pipelines)
{
    VkResult result = VK_SUCCESS;
    (void)cache;
    for (uint32_t i = 0; i < count; i++) {
        const VkResult one = create_pipeline(device, &infos[i], allocator, &pipelines[i]);
        result = one != VK_SUCCESS ? one : result;
    }
    return result;
}
