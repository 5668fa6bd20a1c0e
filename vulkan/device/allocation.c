// SPDX-License-Identifier: MIT
#include "allocation.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

static void *VKAPI_CALL allocate(void *user, size_t size, size_t alignment, VkSystemAllocationScope scope)
{
    (void)user;
    (void)scope;
    const size_t whole = size + (alignment - size % alignment) % alignment;
    return whole < size ? NULL : aligned_alloc(alignment, whole);
}

// The driver never asks to reallocate.
static void *VKAPI_CALL reallocate(void *user, void *original, size_t size, size_t alignment,
                                   VkSystemAllocationScope scope)
{
    (void)user;
    (void)original;
    (void)size;
    (void)alignment;
    (void)scope;
    return NULL;
}

static void VKAPI_CALL release(void *user, void *memory)
{
    (void)user;
    free(memory);
}

const VkAllocationCallbacks vulkan_callbacks_default = {
    .pfnAllocation = allocate, .pfnReallocation = reallocate, .pfnFree = release};

const VkAllocationCallbacks *vulkan_callbacks(const VkAllocationCallbacks *own,
                                              const VkAllocationCallbacks *parent)
{
    return own ? own : parent;
}

void *vulkan_allocate(const VkAllocationCallbacks *callbacks, size_t size, VkSystemAllocationScope scope)
{
    void *const memory = callbacks->pfnAllocation(callbacks->pUserData, size, ALIGNMENT, scope);
    return memory ? memset(memory, 0, size) : NULL;
}

void vulkan_free(const VkAllocationCallbacks *callbacks, void *memory)
{
    if (memory) {
        callbacks->pfnFree(callbacks->pUserData, memory);
    }
}
