// SPDX-License-Identifier: MIT
#include "pipeline.h"
#include <stdlib.h>

// Add what a shader uses, which the pipeline has room for.
static void add_used(VkPipeline pipeline, const rhw_shader *shader)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const resource = &info->resources[i];
        const int first = rhw_shader_program_find(pipeline->program, resource->set, resource->binding);
        if (first >= 0) {
            // An array without a length has as many elements as the layout says; the set knows where it ends.
            pipeline->used[pipeline->used_count++] = (struct vulkan_used_binding){
                resource->set, (uint32_t)first, resource->count > 0 ? resource->count : UINT32_MAX};
            pipeline->used_sets |= 1u << resource->set;
        }
    }
    pipeline->push_size = info->push_size > pipeline->push_size ? info->push_size : pipeline->push_size;
}

VkResult vulkan_pipeline_link(VkPipeline pipeline, VkPipelineLayout layout,
                              const struct rhw_shader_program_def *shaders)
{
    const uint32_t count = vulkan_pipeline_layout_places(layout, NULL);
    struct rhw_shader_layout *const places = calloc((size_t)count + 1, sizeof *places);
    if (!places) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    struct rhw_shader_program_def def = *shaders;
    def.layout = places;
    def.layout_count = vulkan_pipeline_layout_places(layout, places);
    vulkan_pipeline_layout_hold(layout);
    pipeline->layout = layout;
    char message[RHW_SHADER_MESSAGE];
    const enum rhw_result result = rhw_shader_program_create(&def, &pipeline->program, message);
    free(places);
    if (result == RHW_ERROR_MISUSE) {
        vulkan_log("shaders were refused: %s", message);
        return VK_ERROR_INVALID_SHADER_NV;
    }
    const rhw_shader *const given[] = {shaders->vertex, shaders->fragment, shaders->compute};
    size_t resources = 1;
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        resources += given[i] ? rhw_shader_get_info(given[i])->resource_count : 0;
    }
    pipeline->used = calloc(resources, sizeof *pipeline->used);
    if (result != RHW_OK || !pipeline->used) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        if (given[i]) {
            add_used(pipeline, given[i]);
        }
    }
    return VK_SUCCESS;
}

void vulkan_pipeline_free(VkDevice device, const VkAllocationCallbacks *allocator, VkPipeline pipeline)
{
    if (pipeline) {
        rhw_shader_program_destroy(pipeline->program);
        vulkan_pipeline_layout_release(pipeline->layout);
        free(pipeline->used);
        vulkan_device_free(device, allocator, pipeline);
    }
}

static void destroy_program(void *program)
{
    rhw_shader_program_destroy(program);
}

void vkDestroyPipeline(VkDevice device, VkPipeline pipeline, const VkAllocationCallbacks *allocator)
{
    if (pipeline && pipeline->pipeline.generation != 0) {
        vulkan_retire_pipeline(&device->queue, pipeline->pipeline, destroy_program, pipeline->program);
        pipeline->program = NULL;
    }
    vulkan_pipeline_free(device, allocator, pipeline);
}
