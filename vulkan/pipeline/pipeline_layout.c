// SPDX-License-Identifier: MIT
#include "pipeline_layout.h"

void vulkan_pipeline_layout_hold(VkPipelineLayout layout)
{
    atomic_fetch_add_explicit(&layout->users, 1, memory_order_relaxed);
}

void vulkan_pipeline_layout_release(VkPipelineLayout layout)
{
    if (layout && atomic_fetch_sub_explicit(&layout->users, 1, memory_order_acq_rel) == 1) {
        for (uint32_t s = 0; s < layout->set_count; s++) {
            vulkan_set_layout_release(layout->sets[s]);
        }
        vulkan_free(layout->callbacks, layout);
    }
}

uint32_t vulkan_pipeline_layout_places(VkPipelineLayout layout, struct rhw_shader_layout *places)
{
    uint32_t count = 0;
    for (uint32_t s = 0; s < layout->set_count; s++) {
        VkDescriptorSetLayout set = layout->sets[s];
        for (uint32_t b = 0; set && b < set->binding_count; b++, count++) {
            if (places) {
                places[count] =
                    (struct rhw_shader_layout){s, set->bindings[b].number, set->bindings[b].count};
            }
        }
    }
    return count;
}

VkResult vkCreatePipelineLayout(VkDevice device, const VkPipelineLayoutCreateInfo *info,
                                const VkAllocationCallbacks *allocator, VkPipelineLayout *layout)
{
    (void)allocator;
    *layout = VK_NULL_HANDLE;
    if (info->setLayoutCount > RHW_SHADER_MAX_SETS) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    VkPipelineLayout made = vulkan_device_allocate(device, NULL, sizeof *made);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->callbacks = &device->callbacks;
    atomic_init(&made->users, 1);
    made->set_count = info->setLayoutCount;
    for (uint32_t s = 0; s < info->setLayoutCount; s++) {
        made->sets[s] = info->pSetLayouts[s];
        vulkan_set_layout_hold(made->sets[s]);
    }
    *layout = made;
    return VK_SUCCESS;
}

void vkDestroyPipelineLayout(VkDevice device, VkPipelineLayout layout, const VkAllocationCallbacks *allocator)
{
    (void)device;
    (void)allocator;
    vulkan_pipeline_layout_release(layout);
}
