// SPDX-License-Identifier: MIT
#include "pipeline.h"
#include <stdlib.h>

VkPipeline vulkan_pipeline_allocate(VkDevice device, const VkAllocationCallbacks *allocator,
                                    VkPipelineBindPoint point, VkPipelineLayout layout, uint32_t variants)
{
    const size_t size = sizeof(struct VkPipeline_T);
    VkPipeline pipeline =
        vulkan_device_allocate(device, allocator, size + variants * sizeof *pipeline->variants);
    if (pipeline) {
        pipeline->point = point;
        pipeline->variants = (struct vulkan_variant *)(pipeline + 1);
        pipeline->variant_count = variants;
        pipeline->layout = layout;
        vulkan_pipeline_layout_hold(layout);
    }
    return pipeline;
}

// Add what a shader uses, which the pipeline has room for.
static void add_used(VkPipeline pipeline, const rhw_shader_program *program, const rhw_shader *shader)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const resource = &info->resources[i];
        const int first = rhw_shader_program_find(program, resource->set, resource->binding);
        if (first >= 0) {
            // An array without a length has as many elements as the layout says; the set knows where it ends.
            pipeline->used[pipeline->used_count++] = (struct vulkan_used_binding){
                resource->set, (uint32_t)first, resource->count > 0 ? resource->count : UINT32_MAX};
            pipeline->used_sets |= 1u << resource->set;
        }
    }
    pipeline->push_size = info->push_size > pipeline->push_size ? info->push_size : pipeline->push_size;
    pipeline->reads_draw = pipeline->reads_draw || info->reads_draw;
}

// Note what shaders use. Return false without memory.
static bool note_used(VkPipeline pipeline, const rhw_shader_program *program,
                      const struct rhw_shader_program_def *shaders)
{
    const rhw_shader *const given[] = {shaders->vertex, shaders->fragment, shaders->compute};
    size_t room = pipeline->used_count + (size_t)1;
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        room += given[i] ? rhw_shader_get_info(given[i])->resource_count : 0;
    }
    struct vulkan_used_binding *const used = realloc(pipeline->used, room * sizeof *used);
    if (!used) {
        return false;
    }
    pipeline->used = used;
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        if (given[i]) {
            add_used(pipeline, program, given[i]);
        }
    }
    return true;
}

VkResult vulkan_pipeline_link(VkDevice device, VkPipeline pipeline, uint32_t variant,
                              const struct rhw_shader_program_def *shaders)
{
    const uint32_t count = vulkan_pipeline_layout_places(pipeline->layout, NULL);
    struct rhw_shader_layout *const places = calloc((size_t)count + 1, sizeof *places);
    if (!places) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    struct rhw_shader_program_def def = *shaders;
    def.cache = device->shaders;
    def.layout = places;
    def.layout_count = vulkan_pipeline_layout_places(pipeline->layout, places);
    rhw_shader_program **const program = &pipeline->variants[variant].program;
    char message[RHW_SHADER_MESSAGE];
    const enum rhw_result result = rhw_shader_program_create(&def, program, message);
    free(places);
    if (result == RHW_ERROR_MISUSE) {
        vulkan_log("shaders were refused: %s", message);
        return VK_ERROR_INVALID_SHADER_NV;
    }
    return result == RHW_OK && note_used(pipeline, *program, shaders) ? VK_SUCCESS
                                                                      : VK_ERROR_OUT_OF_HOST_MEMORY;
}

void vulkan_pipeline_free(VkDevice device, const VkAllocationCallbacks *allocator, VkPipeline pipeline)
{
    if (pipeline) {
        for (uint32_t v = 0; v < pipeline->variant_count; v++) {
            rhw_shader_program_destroy(pipeline->variants[v].program);
        }
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
    for (uint32_t v = 0; pipeline && v < pipeline->variant_count; v++) {
        struct vulkan_variant *const variant = &pipeline->variants[v];
        if (variant->pipeline.generation != 0) {
            vulkan_retire_pipeline(&device->queue, variant->pipeline, destroy_program, variant->program);
            variant->program = NULL;
        }
    }
    vulkan_pipeline_free(device, allocator, pipeline);
}
