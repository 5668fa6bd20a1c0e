// SPDX-License-Identifier: MIT
// A pool counts the sets and descriptors that it promises. Each set has memory of its own, so that freed ones leave no
// gaps that a pool could not fill.
#include "descriptor_set.h"
#include <string.h>

enum { TYPES = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT + 1 };

struct VkDescriptorPool_T {
    VkAllocationCallbacks callbacks;
    VkDescriptorSet sets; ///< first of its sets
    uint32_t set_room;
    uint64_t rooms[TYPES]; ///< descriptors of a type that are left
};

VkResult vkCreateDescriptorPool(VkDevice device, const VkDescriptorPoolCreateInfo *info,
                                const VkAllocationCallbacks *allocator, VkDescriptorPool *pool)
{
    *pool = vulkan_device_allocate(device, allocator, sizeof **pool);
    if (!*pool) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*pool)->callbacks = *vulkan_callbacks(allocator, &device->callbacks);
    (*pool)->set_room = info->maxSets;
    for (uint32_t i = 0; i < info->poolSizeCount; i++) {
        const VkDescriptorPoolSize *const size = &info->pPoolSizes[i];
        if ((unsigned)size->type < TYPES) {
            (*pool)->rooms[size->type] += size->descriptorCount;
        }
    }
    return VK_SUCCESS;
}

// Take the descriptors of a layout out of the pool, or give them back. Return false, and take nothing, if the pool has
// fewer.
static bool take_rooms(VkDescriptorPool pool, VkDescriptorSetLayout layout)
{
    uint64_t rooms[TYPES];
    memcpy(rooms, pool->rooms, sizeof rooms);
    for (uint32_t i = 0; i < layout->binding_count; i++) {
        const struct vulkan_set_binding *const binding = &layout->bindings[i];
        if (binding->count == 0) {
            continue;
        }
        if ((unsigned)binding->type >= TYPES || rooms[binding->type] < binding->count) {
            return false;
        }
        rooms[binding->type] -= binding->count;
    }
    memcpy(pool->rooms, rooms, sizeof rooms);
    return true;
}

static void give_rooms(VkDescriptorPool pool, VkDescriptorSetLayout layout)
{
    for (uint32_t i = 0; i < layout->binding_count; i++) {
        const struct vulkan_set_binding *const binding = &layout->bindings[i];
        if ((unsigned)binding->type < TYPES) {
            pool->rooms[binding->type] += binding->count;
        }
    }
}

static void free_set(VkDescriptorPool pool, VkDescriptorSet set)
{
    give_rooms(pool, set->layout);
    pool->set_room++;
    if (set->previous) {
        set->previous->next = set->next;
    } else {
        pool->sets = set->next;
    }
    if (set->next) {
        set->next->previous = set->previous;
    }
    vulkan_set_layout_release(set->layout);
    vulkan_free(&pool->callbacks, set);
}

static VkResult allocate_set(VkDescriptorPool pool, VkDescriptorSetLayout layout, VkDescriptorSet *set)
{
    if (pool->set_room == 0 || !take_rooms(pool, layout)) {
        return VK_ERROR_OUT_OF_POOL_MEMORY;
    }
    VkDescriptorSet made = vulkan_allocate(&pool->callbacks, vulkan_descriptor_set_bytes(layout),
                                           VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
    if (!made) {
        give_rooms(pool, layout);
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    vulkan_set_layout_hold(layout);
    vulkan_descriptor_set_init(made, layout);
    made->pool = pool;
    made->next = pool->sets;
    if (made->next) {
        made->next->previous = made;
    }
    pool->sets = made;
    pool->set_room--;
    *set = made;
    return VK_SUCCESS;
}

VkResult vkAllocateDescriptorSets(VkDevice device, const VkDescriptorSetAllocateInfo *info,
                                  VkDescriptorSet *sets)
{
    VkResult result = VK_SUCCESS;
    uint32_t made = 0;
    (void)device;
    while (made < info->descriptorSetCount && result == VK_SUCCESS) {
        result = allocate_set(info->descriptorPool, info->pSetLayouts[made], &sets[made]);
        made += result == VK_SUCCESS;
    }
    for (uint32_t i = 0; result != VK_SUCCESS && i < info->descriptorSetCount; i++) {
        if (i < made) {
            free_set(info->descriptorPool, sets[i]);
        }
        sets[i] = VK_NULL_HANDLE;
    }
    return result;
}

VkResult vkFreeDescriptorSets(VkDevice device, VkDescriptorPool pool, uint32_t count,
                              const VkDescriptorSet *sets)
{
    (void)device;
    for (uint32_t i = 0; i < count; i++) {
        if (sets[i]) {
            free_set(pool, sets[i]);
        }
    }
    return VK_SUCCESS;
}

VkResult vkResetDescriptorPool(VkDevice device, VkDescriptorPool pool, VkDescriptorPoolResetFlags flags)
{
    (void)device;
    (void)flags;
    while (pool->sets) {
        free_set(pool, pool->sets);
    }
    return VK_SUCCESS;
}

void vkDestroyDescriptorPool(VkDevice device, VkDescriptorPool pool, const VkAllocationCallbacks *allocator)
{
    if (pool) {
        (void)vkResetDescriptorPool(device, pool, 0);
        vulkan_device_free(device, allocator, pool);
    }
}
