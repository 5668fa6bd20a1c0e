// SPDX-License-Identifier: MIT
#include "set_layout.h"
#include <stdlib.h>

// Descriptors of a set, so that no size computed of them leaves 32 bits.
enum { MAX_DESCRIPTORS = 1 << 22 };

bool vulkan_descriptor_is_dynamic(VkDescriptorType type)
{
    return type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC ||
           type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
}

const struct vulkan_set_binding *vulkan_set_layout_find(VkDescriptorSetLayout layout, uint32_t number)
{
    uint32_t low = 0, high = layout->binding_count;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (layout->bindings[middle].number < number) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < layout->binding_count && layout->bindings[low].number == number ? &layout->bindings[low]
                                                                                 : NULL;
}

void vulkan_set_layout_hold(VkDescriptorSetLayout layout)
{
    if (layout) {
        atomic_fetch_add_explicit(&layout->users, 1, memory_order_relaxed);
    }
}

void vulkan_set_layout_release(VkDescriptorSetLayout layout)
{
    if (layout && atomic_fetch_sub_explicit(&layout->users, 1, memory_order_acq_rel) == 1) {
        vulkan_free(layout->callbacks, layout);
    }
}

static int compare_bindings(const void *a, const void *b)
{
    const struct vulkan_set_binding *const x = a, *const y = b;
    return x->number < y->number ? -1 : x->number > y->number;
}

// Return whether the immutable samplers of a binding count. Vulkan ignores the pointer with other types.
static bool has_immutable(const VkDescriptorSetLayoutBinding *given)
{
    return given->pImmutableSamplers && given->descriptorCount > 0 &&
           (given->descriptorType == VK_DESCRIPTOR_TYPE_SAMPLER ||
            given->descriptorType == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
}

// Return whether a set of a layout is not too large.
static bool is_supported(const VkDescriptorSetLayoutCreateInfo *info)
{
    uint64_t descriptors = 0, dynamic = 0;
    for (uint32_t i = 0; i < info->bindingCount; i++) {
        const VkDescriptorSetLayoutBinding *const binding = &info->pBindings[i];
        descriptors += binding->descriptorCount;
        dynamic += vulkan_descriptor_is_dynamic(binding->descriptorType) ? binding->descriptorCount : 0;
    }
    return descriptors <= MAX_DESCRIPTORS && dynamic <= VULKAN_MAX_DYNAMIC_BUFFERS;
}

// Fill a layout whose samplers go to `samplers`.
static void fill_layout(VkDescriptorSetLayout layout, const VkDescriptorSetLayoutCreateInfo *info,
                        VkSampler *samplers)
{
    for (uint32_t i = 0; i < info->bindingCount; i++) {
        const VkDescriptorSetLayoutBinding *const given = &info->pBindings[i];
        layout->bindings[i] = (struct vulkan_set_binding){
            .number = given->binding, .type = given->descriptorType, .count = given->descriptorCount};
        if (has_immutable(given)) {
            layout->bindings[i].immutable = samplers;
            for (uint32_t s = 0; s < given->descriptorCount; s++) {
                *samplers++ = given->pImmutableSamplers[s];
            }
        }
    }
    layout->binding_count = info->bindingCount;
    if (info->bindingCount > 0) {
        qsort(layout->bindings, info->bindingCount, sizeof *layout->bindings, compare_bindings);
    }
    for (uint32_t i = 0; i < info->bindingCount; i++) {
        struct vulkan_set_binding *const binding = &layout->bindings[i];
        binding->first = layout->size;
        layout->size += binding->count;
        layout->dynamic_count += vulkan_descriptor_is_dynamic(binding->type) ? binding->count : 0;
    }
}

VkResult vkCreateDescriptorSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo *info,
                                     const VkAllocationCallbacks *allocator, VkDescriptorSetLayout *layout)
{
    (void)allocator;
    uint64_t samplers = 0;
    for (uint32_t i = 0; i < info->bindingCount; i++) {
        samplers += has_immutable(&info->pBindings[i]) ? info->pBindings[i].descriptorCount : 0;
    }
    *layout = VK_NULL_HANDLE;
    if (!is_supported(info)) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    const size_t head =
        sizeof(struct VkDescriptorSetLayout_T) + info->bindingCount * sizeof(struct vulkan_set_binding);
    VkDescriptorSetLayout made =
        vulkan_device_allocate(device, NULL, head + (size_t)samplers * sizeof(VkSampler));
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->callbacks = &device->callbacks;
    atomic_init(&made->users, 1);
    fill_layout(made, info, (VkSampler *)((unsigned char *)made + head));
    *layout = made;
    return VK_SUCCESS;
}

void vkDestroyDescriptorSetLayout(VkDevice device, VkDescriptorSetLayout layout,
                                  const VkAllocationCallbacks *allocator)
{
    (void)device;
    (void)allocator;
    vulkan_set_layout_release(layout);
}

void vkGetDescriptorSetLayoutSupport(VkDevice device, const VkDescriptorSetLayoutCreateInfo *info,
                                     VkDescriptorSetLayoutSupport *support)
{
    (void)device;
    support->supported = is_supported(info);
}
