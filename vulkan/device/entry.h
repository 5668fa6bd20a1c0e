// SPDX-License-Identifier: MIT
// The table of entry points, and the extensions that open some of them.
#ifndef VULKAN_ENTRY_H
#define VULKAN_ENTRY_H

#include <stdbool.h>
#include <vulkan/vulkan_core.h>

// What an entry needs: a version of Vulkan, or an extension.
enum vulkan_extension {
#define EXTENSION(name, version, kind) VULKAN_##name,
#include "extensions.inc"
#undef EXTENSION
    VULKAN_EXTENSION_COUNT,
    VULKAN_VERSION_1_0 = VULKAN_EXTENSION_COUNT,
    VULKAN_VERSION_1_1
};

// Extensions, one bit each.
typedef uint64_t vulkan_extension_set;

// Whom a command is asked of.
enum vulkan_level {
    VULKAN_LEVEL_GLOBAL,
    VULKAN_LEVEL_INSTANCE,
    VULKAN_LEVEL_PHYSICAL_DEVICE,
    VULKAN_LEVEL_DEVICE
};

// Return the function of a name whose level is within `least`..`most`, or NULL. `enabled` has the extensions that may
// be used.
PFN_vkVoidFunction vulkan_entry_find(const char *name, enum vulkan_level least, enum vulkan_level most,
                                     vulkan_extension_set enabled);

// Return all extensions of instances, or of devices.
vulkan_extension_set vulkan_extensions_of(bool device);

// Set *set to the extensions with these names. Return VK_ERROR_EXTENSION_NOT_PRESENT for a name that is none of
// `offered`.
VkResult vulkan_extensions_enable(const char *const *names, uint32_t count, vulkan_extension_set offered,
                                  vulkan_extension_set *set);

// Tell the extensions of a set as vkEnumerateDeviceExtensionProperties does.
VkResult vulkan_extensions_enumerate(vulkan_extension_set set, uint32_t *count,
                                     VkExtensionProperties *properties);

#endif
