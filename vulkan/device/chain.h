// SPDX-License-Identifier: MIT
// Structs that extend others hang at them in a chain.
#ifndef VULKAN_CHAIN_H
#define VULKAN_CHAIN_H

#include <stddef.h>
#include <vulkan/vulkan_core.h>

// Return the first struct of a type in a chain (pNext), or NULL.
static inline const void *vulkan_chain_find(const void *chain, VkStructureType type)
{
    const VkBaseInStructure *one = chain;
    while (one && one->sType != type) {
        one = one->pNext;
    }
    return one;
}

#endif
