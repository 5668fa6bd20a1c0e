// SPDX-License-Identifier: MIT
// Layouts of descriptor sets. A program may destroy a layout while sets and pipelines of it go on, so they share it.
#ifndef VULKAN_SET_LAYOUT_H
#define VULKAN_SET_LAYOUT_H

#include <stdatomic.h>

#include "device/device.h"

enum {
    VULKAN_MAX_DYNAMIC_BUFFERS = 16 ///< buffers with dynamic offsets in a set
};

struct vulkan_set_binding {
    uint32_t number;
    VkDescriptorType type;
    uint32_t count;             ///< descriptors, 0 for a number that is reserved
    uint32_t first;             ///< place of the first of them in a set
    const VkSampler *immutable; ///< `count` samplers, or NULL
};

struct VkDescriptorSetLayout_T {
    /// Callbacks of the device: those of the layout may be gone when its last user is.
    const VkAllocationCallbacks *callbacks;
    atomic_uint users;
    uint32_t size;          ///< descriptors of a set
    uint32_t dynamic_count; ///< buffers of a set with dynamic offsets
    uint32_t binding_count;
    struct vulkan_set_binding bindings[]; ///< by number
};

// Return true for the types of buffers with dynamic offsets.
bool vulkan_descriptor_is_dynamic(VkDescriptorType type);

// Return the binding of a number, or NULL.
const struct vulkan_set_binding *vulkan_set_layout_find(VkDescriptorSetLayout layout, uint32_t number);

// Take and leave a layout, which may be NULL. It is freed when the last user leaves it.
void vulkan_set_layout_hold(VkDescriptorSetLayout layout);
void vulkan_set_layout_release(VkDescriptorSetLayout layout);

#endif
