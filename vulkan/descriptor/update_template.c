// SPDX-License-Identifier: MIT
// A template says where in a program's memory the descriptors of a set stand.
#include "descriptor_set.h"
#include <string.h>

struct VkDescriptorUpdateTemplate_T {
    uint32_t count;
    VkDescriptorUpdateTemplateEntry entries[];
};

VkResult vkCreateDescriptorUpdateTemplate(VkDevice device, const VkDescriptorUpdateTemplateCreateInfo *info,
                                          const VkAllocationCallbacks *allocator,
                                          VkDescriptorUpdateTemplate *made)
{
    const size_t size = info->descriptorUpdateEntryCount * sizeof *info->pDescriptorUpdateEntries;
    *made = vulkan_device_allocate(device, allocator, sizeof **made + size);
    if (!*made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*made)->count = info->descriptorUpdateEntryCount;
    memcpy((*made)->entries, info->pDescriptorUpdateEntries, size);
    return VK_SUCCESS;
}

void vkDestroyDescriptorUpdateTemplate(VkDevice device, VkDescriptorUpdateTemplate given,
                                       const VkAllocationCallbacks *allocator)
{
    vulkan_device_free(device, allocator, given);
}

void vkUpdateDescriptorSetWithTemplate(VkDevice device, VkDescriptorSet set, VkDescriptorUpdateTemplate given,
                                       const void *data)
{
    (void)device;
    for (uint32_t i = 0; i < given->count; i++) {
        const VkDescriptorUpdateTemplateEntry *const entry = &given->entries[i];
        const struct vulkan_descriptor_write write = {.set = set,
                                                      .binding = entry->dstBinding,
                                                      .element = entry->dstArrayElement,
                                                      .count = entry->descriptorCount,
                                                      .type = entry->descriptorType,
                                                      .data = (const unsigned char *)data + entry->offset,
                                                      .stride = entry->stride};
        vulkan_descriptor_set_write(&write);
    }
}
