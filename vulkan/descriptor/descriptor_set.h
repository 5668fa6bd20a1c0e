// SPDX-License-Identifier: MIT
// A descriptor set is an array of bindings of librhw, which shaders index, and beside it what the bindings are made of.
// Buffers are memory of the program, so their bindings are made when they are written. Images and samplers are ids of
// librhw, which the queue's thread alone makes: their bindings are stale until a draw or a dispatch needs them.
#ifndef VULKAN_DESCRIPTOR_SET_H
#define VULKAN_DESCRIPTOR_SET_H

#include "resource/buffer.h"
#include "resource/image_view.h"
#include "resource/sampler.h"
#include "set_layout.h"

// What a binding is made of.
struct vulkan_descriptor {
    VkDescriptorType type;
    bool is_immutable; ///< the layout has its sampler
    bool is_stale;     ///< the binding is older than this
    bool is_storage;   ///< the bytes are written too
    union {
        struct {
            VkImageView view;
            VkSampler sampler;
        };
        struct {
            unsigned char *bytes;   ///< first byte, without the dynamic offset
            VkDeviceSize available; ///< bytes up to the end of the buffer
            VkDeviceSize size;      ///< bytes of the descriptor, at most
        };
    };
};

struct VkDescriptorSet_T {
    VkDescriptorPool pool;
    VkDescriptorSet previous, next; ///< neighbours in the pool
    VkDescriptorSetLayout layout;
    struct rhw_binding *bindings;          ///< [layout->size]
    struct vulkan_descriptor *descriptors; ///< [layout->size]
};

// Return the bytes of a set of a layout, with its arrays.
size_t vulkan_descriptor_set_bytes(VkDescriptorSetLayout layout);
// Begin a set in zeroed memory of that many bytes: it is empty but for the layout's own samplers.
void vulkan_descriptor_set_init(VkDescriptorSet set, VkDescriptorSetLayout layout);

// What one write has, each of which stands every `stride` bytes. `data` are structs VkDescriptorImageInfo,
// VkDescriptorBufferInfo or VkBufferView, as the type asks for.
struct vulkan_descriptor_write {
    VkDescriptorSet set;
    uint32_t binding, element, count;
    VkDescriptorType type;
    const void *data;
    size_t stride;
};

void vulkan_descriptor_set_write(const struct vulkan_descriptor_write *write);

// Make the stale bindings of [first, first + count). The queue's thread calls this. Return false if memory is lost.
bool vulkan_descriptor_set_freshen(VkQueue queue, VkDescriptorSet set, uint32_t first, uint32_t count);

// Copy the bindings of a set, with dynamic offsets in the order of its layout, to `bindings`, which has layout->size.
void vulkan_descriptor_set_offset(VkDescriptorSet set, const uint32_t *offsets, struct rhw_binding *bindings);

#endif
