// SPDX-License-Identifier: MIT
#include "pipeline.h"
#include "shader_module.h"

static VkResult create_pipeline(VkDevice device, const VkComputePipelineCreateInfo *info,
                                const VkAllocationCallbacks *allocator, VkPipeline *pipeline)
{
    rhw_shader *shader = NULL;
    *pipeline = VK_NULL_HANDLE;
    VkResult result = vulkan_shader_create(device, &info->stage, 0, &shader);
    if (result == VK_SUCCESS) {
        VkPipeline made =
            vulkan_pipeline_allocate(device, allocator, VK_PIPELINE_BIND_POINT_COMPUTE, info->layout, 1);
        result =
            made ? vulkan_pipeline_link(device, made, 0, &(struct rhw_shader_program_def){.compute = shader})
                 : VK_ERROR_OUT_OF_HOST_MEMORY;
        if (result == VK_SUCCESS) {
            *pipeline = made;
        } else {
            vulkan_pipeline_free(device, allocator, made);
        }
    }
    rhw_shader_destroy(shader);
    return result;
}

VkResult vkCreateComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                  const VkComputePipelineCreateInfo *infos,
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
