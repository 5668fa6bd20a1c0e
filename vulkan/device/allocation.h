// SPDX-License-Identifier: MIT
// Memory of the driver's objects comes from the callbacks that the program gives, or from the C library.
#ifndef VULKAN_ALLOCATION_H
#define VULKAN_ALLOCATION_H

#include <stddef.h>
#include <vulkan/vulkan_core.h>

// Return the callbacks for an object of a parent: the object's own if the program gives some, else the parent's.
const VkAllocationCallbacks *vulkan_callbacks(const VkAllocationCallbacks *own,
                                              const VkAllocationCallbacks *parent);

// Return `size` bytes of zeros, aligned to 64, or NULL. `callbacks` is not NULL (vulkan_callbacks_default).
void *vulkan_allocate(const VkAllocationCallbacks *callbacks, size_t size, VkSystemAllocationScope scope);

// Give memory back, which may be NULL.
void vulkan_free(const VkAllocationCallbacks *callbacks, void *memory);

// The callbacks of a program that gives none.
extern const VkAllocationCallbacks vulkan_callbacks_default;

#endif
