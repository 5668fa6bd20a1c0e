// SPDX-License-Identifier: MIT
#include "device/chain.h"
#include "pass/render_pass.h"
#include "pipeline_state.h"
#include "shader_module.h"

struct stages {
    rhw_shader *vertex, *fragment;
};

static void destroy_shaders(struct stages *stages)
{
    rhw_shader_destroy(stages->vertex);
    rhw_shader_destroy(stages->fragment);
    *stages = (struct stages){NULL, NULL};
}

static VkResult create_shaders(VkDevice device, const VkGraphicsPipelineCreateInfo *info, uint32_t view,
                               struct stages *stages)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; result == VK_SUCCESS && i < info->stageCount; i++) {
        const VkPipelineShaderStageCreateInfo *const stage = &info->pStages[i];
        const bool is_fragment = stage->stage == VK_SHADER_STAGE_FRAGMENT_BIT;
        rhw_shader **const shader = is_fragment ? &stages->fragment : &stages->vertex;
        // Fragments that are never made need no shader, and the program may leave it out of what it declares.
        if (!*shader && (!is_fragment || !info->pRasterizationState->rasterizerDiscardEnable)) {
            result = vulkan_shader_create(device, stage, view, shader);
        }
    }
    return result;
}

// Return the views that the pipeline draws, one bit each. 0 means that it draws no views.
static uint32_t find_views(const VkGraphicsPipelineCreateInfo *info)
{
    if (info->renderPass) {
        return info->renderPass->subpasses[info->subpass].view_mask;
    }
    const VkPipelineRenderingCreateInfo *const rendering =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    return rendering ? rendering->viewMask : 0;
}

// Return how many variants shaders need.
static uint32_t count_variants(const struct stages *stages, uint32_t views)
{
    const bool reads = (stages->vertex && rhw_shader_get_info(stages->vertex)->reads_view_index) ||
                       (stages->fragment && rhw_shader_get_info(stages->fragment)->reads_view_index);
    uint32_t count = 1;
    while (reads && count < 32 && views >> count != 0) {
        count++;
    }
    return count;
}

// Link the shaders of view 0, and translate and link those of the other views. The shaders of view 0 stay.
static VkResult link_variants(VkDevice device, VkPipeline pipeline, const VkGraphicsPipelineCreateInfo *info,
                              uint32_t views, const struct stages *first)
{
    VkResult result = vulkan_pipeline_link(
        device, pipeline, 0,
        &(struct rhw_shader_program_def){.vertex = first->vertex, .fragment = first->fragment});
    for (uint32_t v = 1; result == VK_SUCCESS && v < pipeline->variant_count; v++) {
        struct stages stages = {NULL, NULL};
        if (!(views >> v & 1)) {
            continue;
        }
        result = create_shaders(device, info, v, &stages);
        if (result == VK_SUCCESS) {
            result = vulkan_pipeline_link(
                device, pipeline, v,
                &(struct rhw_shader_program_def){.vertex = stages.vertex, .fragment = stages.fragment});
        }
        destroy_shaders(&stages);
    }
    return result;
}

static VkResult create_pipeline(VkDevice device, const VkGraphicsPipelineCreateInfo *info,
                                const VkAllocationCallbacks *allocator, VkPipeline *pipeline)
{
    const uint32_t views = find_views(info);
    struct stages stages = {NULL, NULL};
    *pipeline = VK_NULL_HANDLE;
    VkResult result = create_shaders(device, info, 0, &stages);
    if (result == VK_SUCCESS) {
        VkPipeline made = vulkan_pipeline_allocate(device, allocator, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                                   info->layout, count_variants(&stages, views));
        result = made ? link_variants(device, made, info, views, &stages) : VK_ERROR_OUT_OF_HOST_MEMORY;
        if (result == VK_SUCCESS) {
            vulkan_pipeline_state_fill(made, info, rhw_shader_get_info(stages.vertex));
            result = vulkan_pipeline_state_check(made);
        }
        if (result == VK_SUCCESS) {
            *pipeline = made;
        } else {
            vulkan_pipeline_free(device, allocator, made);
        }
    }
    destroy_shaders(&stages);
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
