// SPDX-License-Identifier: MIT
#include "descriptor_set.h"
#include "rhw/bind.h"
#include <string.h>

enum { ALIGNMENT = 64 };

static size_t aligned(size_t size)
{
    return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

size_t vulkan_descriptor_set_bytes(VkDescriptorSetLayout layout)
{
    return aligned(sizeof(struct VkDescriptorSet_T)) +
           layout->size * (sizeof(struct rhw_binding) + sizeof(struct vulkan_descriptor));
}

void vulkan_descriptor_set_init(VkDescriptorSet set, VkDescriptorSetLayout layout)
{
    set->layout = layout;
    set->bindings = (struct rhw_binding *)((unsigned char *)set + aligned(sizeof *set));
    set->descriptors = (struct vulkan_descriptor *)(set->bindings + layout->size);
    for (uint32_t b = 0; b < layout->binding_count; b++) {
        const struct vulkan_set_binding *const binding = &layout->bindings[b];
        for (uint32_t i = 0; i < binding->count; i++) {
            struct vulkan_descriptor *const descriptor = &set->descriptors[binding->first + i];
            descriptor->type = binding->type;
            if (binding->immutable) {
                descriptor->is_immutable = true;
                descriptor->is_stale = binding->type == VK_DESCRIPTOR_TYPE_SAMPLER;
                descriptor->sampler = binding->immutable[i];
            }
        }
    }
}

// Writing --------------------------------------------------------------------------------------------

static void write_image(struct vulkan_descriptor *descriptor, struct rhw_binding *binding,
                        const VkDescriptorImageInfo *info)
{
    const bool has_sampler = descriptor->type == VK_DESCRIPTOR_TYPE_SAMPLER ||
                             descriptor->type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    if (has_sampler && !descriptor->is_immutable) {
        descriptor->sampler = info->sampler;
    }
    if (descriptor->type != VK_DESCRIPTOR_TYPE_SAMPLER) {
        descriptor->view = info->imageView;
    }
    descriptor->is_stale = true;
    *binding = (struct rhw_binding){{0}};
}

static void write_buffer(struct vulkan_descriptor *descriptor, struct rhw_binding *binding,
                         const VkDescriptorBufferInfo *info)
{
    VkBuffer buffer = info->buffer;
    const bool is_inside = buffer && buffer->bytes && info->offset <= buffer->size;
    descriptor->bytes = is_inside ? buffer->bytes + info->offset : NULL;
    descriptor->available = is_inside ? buffer->size - info->offset : 0;
    descriptor->size = info->range < descriptor->available ? info->range : descriptor->available;
    descriptor->is_storage = descriptor->type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
                             descriptor->type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
    if (vulkan_descriptor_is_dynamic(descriptor->type) && info->range != VK_WHOLE_SIZE) {
        descriptor->size = info->range;
    }
    const VkDeviceSize size =
        descriptor->size < descriptor->available ? descriptor->size : descriptor->available;
    // On failure, which is a wrong alignment, the binding is empty.
    (void)rhw_binding_of_memory(descriptor->bytes, (size_t)size, !descriptor->is_storage, binding);
}

static void write_one(struct vulkan_descriptor *descriptor, struct rhw_binding *binding, const void *data)
{
    switch (descriptor->type) {
    case VK_DESCRIPTOR_TYPE_SAMPLER:
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
    case VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT: write_image(descriptor, binding, data); break;
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
    case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER: {
        VkBufferView view = *(const VkBufferView *)data;
        *binding = view ? view->binding : (struct rhw_binding){{0}};
        break;
    }
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC: write_buffer(descriptor, binding, data); break;
    default: break;
    }
}

// Elements behind the last of a binding are those of the next one (Vulkan 1.3 §14.2.6).
void vulkan_descriptor_set_write(const struct vulkan_descriptor_write *write)
{
    VkDescriptorSet set = write->set;
    const struct vulkan_set_binding *const binding = vulkan_set_layout_find(set->layout, write->binding);
    const unsigned char *data = write->data;
    if (!binding) {
        vulkan_log("descriptors of binding %u are not written: the layout of the set has none",
                   write->binding);
    }
    for (uint32_t i = 0; binding && i < write->count; i++, data += write->stride) {
        const uint64_t place = (uint64_t)binding->first + write->element + i;
        if (place >= set->layout->size || set->descriptors[place].type != write->type) {
            vulkan_log("descriptor %u of binding %u is not written: the set has none of this type there",
                       write->element + i, write->binding);
            return;
        }
        write_one(&set->descriptors[place], &set->bindings[place], data);
    }
}

static bool has_image(VkDescriptorType type)
{
    return type == VK_DESCRIPTOR_TYPE_SAMPLER || type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER ||
           type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE || type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ||
           type == VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
}

// Of an image or a sampler only what the binding is made of is read: the queue's thread may be making the binding.
static void copy_element(VkDescriptorSet from, uint64_t source, VkDescriptorSet to, uint64_t target)
{
    const struct vulkan_descriptor *const given = &from->descriptors[source];
    struct vulkan_descriptor *const descriptor = &to->descriptors[target];
    if (has_image(given->type)) {
        const VkDescriptorImageInfo info = {.sampler = given->sampler, .imageView = given->view};
        write_image(descriptor, &to->bindings[target], &info);
    } else {
        *descriptor = *given;
        to->bindings[target] = from->bindings[source];
    }
}

static void copy_elements(const VkCopyDescriptorSet *copy)
{
    VkDescriptorSet from = copy->srcSet, to = copy->dstSet;
    const struct vulkan_set_binding *const source = vulkan_set_layout_find(from->layout, copy->srcBinding);
    const struct vulkan_set_binding *const target = vulkan_set_layout_find(to->layout, copy->dstBinding);
    for (uint32_t i = 0; source && target && i < copy->descriptorCount; i++) {
        const uint64_t s = (uint64_t)source->first + copy->srcArrayElement + i;
        const uint64_t t = (uint64_t)target->first + copy->dstArrayElement + i;
        if (s >= from->layout->size || t >= to->layout->size ||
            from->descriptors[s].type != to->descriptors[t].type) {
            vulkan_log("descriptor %u of binding %u is not copied to binding %u: types differ, or it is none",
                       copy->srcArrayElement + i, copy->srcBinding, copy->dstBinding);
            return;
        }
        copy_element(from, s, to, t);
    }
}

void vkUpdateDescriptorSets(VkDevice device, uint32_t write_count, const VkWriteDescriptorSet *writes,
                            uint32_t copy_count, const VkCopyDescriptorSet *copies)
{
    (void)device;
    for (uint32_t i = 0; i < write_count; i++) {
        const VkWriteDescriptorSet *const given = &writes[i];
        struct vulkan_descriptor_write write = {.set = given->dstSet,
                                                .binding = given->dstBinding,
                                                .element = given->dstArrayElement,
                                                .count = given->descriptorCount,
                                                .type = given->descriptorType};
        switch (given->descriptorType) {
        case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
        case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER:
            write.data = given->pTexelBufferView;
            write.stride = sizeof *given->pTexelBufferView;
            break;
        case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
        case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
        case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC:
            write.data = given->pBufferInfo;
            write.stride = sizeof *given->pBufferInfo;
            break;
        default:
            write.data = given->pImageInfo;
            write.stride = sizeof *given->pImageInfo;
            break;
        }
        vulkan_descriptor_set_write(&write);
    }
    for (uint32_t i = 0; i < copy_count; i++) {
        copy_elements(&copies[i]);
    }
}

// Reading --------------------------------------------------------------------------------------------

// Return the binding of a part, or NULL if the part is missing. Without memory *is_lost becomes true.
static const struct rhw_binding *texture_of(VkQueue queue, VkImageView view, bool *is_lost)
{
    const struct rhw_binding *const binding = view ? vulkan_image_view_texture(queue, view) : NULL;
    *is_lost = *is_lost || (view && !binding);
    return binding;
}

static const struct rhw_binding *sampler_of(VkQueue queue, VkSampler sampler, bool *is_lost)
{
    const struct rhw_binding *const binding = sampler ? vulkan_sampler_binding(queue, sampler) : NULL;
    *is_lost = *is_lost || (sampler && !binding);
    return binding;
}

// Return false if memory is lost.
static bool freshen(VkQueue queue, struct vulkan_descriptor *descriptor, struct rhw_binding *binding)
{
    const struct rhw_binding *found = NULL, *sampler = NULL;
    bool is_lost = false;
    if (descriptor->type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
        found = descriptor->view ? vulkan_image_view_storage(queue, descriptor->view) : NULL;
        is_lost = descriptor->view && !found;
    } else if (descriptor->type == VK_DESCRIPTOR_TYPE_SAMPLER) {
        found = sampler_of(queue, descriptor->sampler, &is_lost);
    } else {
        found = texture_of(queue, descriptor->view, &is_lost);
        if (descriptor->type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) {
            sampler = sampler_of(queue, descriptor->sampler, &is_lost);
        }
    }
    // A pair that no shader may sample, such as a depth compared by a filter of colours, is left for fetches.
    if (!found) {
        *binding = (struct rhw_binding){{0}};
    } else if (!sampler || !rhw_binding_of_pair(found, sampler, binding)) {
        *binding = *found;
    }
    descriptor->is_stale = is_lost;
    return !is_lost;
}

bool vulkan_descriptor_set_freshen(VkQueue queue, VkDescriptorSet set, uint32_t first, uint32_t count)
{
    for (uint32_t i = first; i - first < count && i < set->layout->size; i++) {
        if (set->descriptors[i].is_stale && !freshen(queue, &set->descriptors[i], &set->bindings[i])) {
            return false;
        }
    }
    return true;
}

void vulkan_descriptor_set_offset(VkDescriptorSet set, const uint32_t *offsets, struct rhw_binding *bindings)
{
    memcpy(bindings, set->bindings, set->layout->size * sizeof *bindings);
    for (uint32_t i = 0; i < set->layout->size; i++) {
        const struct vulkan_descriptor *const descriptor = &set->descriptors[i];
        if (!vulkan_descriptor_is_dynamic(descriptor->type)) {
            continue;
        }
        const VkDeviceSize offset = *offsets++;
        if (!descriptor->bytes || offset > descriptor->available) {
            vulkan_log("a buffer of a set reads as zeros: its dynamic offset is %llu of %llu",
                       (unsigned long long)offset, (unsigned long long)descriptor->available);
            bindings[i] = (struct rhw_binding){{0}};
            continue;
        }
        const VkDeviceSize left = descriptor->available - offset;
        (void)rhw_binding_of_memory(descriptor->bytes + offset,
                                    (size_t)(descriptor->size < left ? descriptor->size : left),
                                    !descriptor->is_storage, &bindings[i]);
    }
}
