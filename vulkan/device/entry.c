// SPDX-License-Identifier: MIT
#include "entry.h"
#include "instance.h"
#include "device.h"
#include <stdlib.h>
#include <string.h>

struct entry {
    const char *name;
    PFN_vkVoidFunction function;
    enum vulkan_level level;
    unsigned needs;
};

static const struct entry entries[] = {
#define ENTRY(name, function, level, needs) \
    {#name, (PFN_vkVoidFunction)function, VULKAN_LEVEL_##level, VULKAN_##needs},
#include "entries.inc"
#undef ENTRY
};

static const struct extension {
    const char *name;
    uint32_t version;
    bool is_of_device;
} extensions[] = {
#define INSTANCE                       false
#define DEVICE                         true
#define EXTENSION(name, version, kind) {"VK_" #name, version, kind},
#include "extensions.inc"
#undef EXTENSION
#undef INSTANCE
#undef DEVICE
};

static int compare(const void *name, const void *entry)
{
    return strcmp(name, ((const struct entry *)entry)->name);
}

PFN_vkVoidFunction vulkan_entry_find(const char *name, enum vulkan_level least, enum vulkan_level most,
                                     vulkan_extension_set enabled)
{
    const struct entry *const entry =
        bsearch(name, entries, sizeof entries / sizeof *entries, sizeof *entries, compare);
    if (!entry || entry->level < least || entry->level > most) {
        return NULL;
    }
    const bool is_enabled = entry->needs >= VULKAN_EXTENSION_COUNT || (enabled >> entry->needs & 1);
    return is_enabled ? entry->function : NULL;
}

vulkan_extension_set vulkan_extensions_of(bool device)
{
    vulkan_extension_set set = 0;
    for (unsigned i = 0; i < VULKAN_EXTENSION_COUNT; i++) {
        set |= (vulkan_extension_set)(extensions[i].is_of_device == device) << i;
    }
    return set;
}

VkResult vulkan_extensions_enable(const char *const *names, uint32_t count, vulkan_extension_set offered,
                                  vulkan_extension_set *set)
{
    *set = 0;
    for (uint32_t i = 0; i < count; i++) {
        unsigned number = 0;
        while (number < VULKAN_EXTENSION_COUNT && strcmp(names[i], extensions[number].name) != 0) {
            number++;
        }
        if (number == VULKAN_EXTENSION_COUNT || !(offered >> number & 1)) {
            return VK_ERROR_EXTENSION_NOT_PRESENT;
        }
        *set |= (vulkan_extension_set)1 << number;
    }
    return VK_SUCCESS;
}

VkResult vulkan_extensions_enumerate(vulkan_extension_set set, uint32_t *count,
                                     VkExtensionProperties *properties)
{
    const uint32_t room = properties ? *count : UINT32_MAX;
    uint32_t found = 0;
    for (unsigned i = 0; i < VULKAN_EXTENSION_COUNT; i++) {
        if (!(set >> i & 1)) {
            continue;
        }
        if (found == room) {
            return VK_INCOMPLETE;
        }
        if (properties) {
            VkExtensionProperties *const one = &properties[found];
            *one = (VkExtensionProperties){.specVersion = extensions[i].version};
            memcpy(one->extensionName, extensions[i].name, strlen(extensions[i].name));
        }
        found++;
    }
    *count = found;
    return VK_SUCCESS;
}

PFN_vkVoidFunction vkGetInstanceProcAddr(VkInstance instance, const char *name)
{
    const vulkan_extension_set device = vulkan_extensions_of(true);
    if (!instance) {
        return vulkan_entry_find(name, VULKAN_LEVEL_GLOBAL, VULKAN_LEVEL_GLOBAL, 0);
    }
    return vulkan_entry_find(name, VULKAN_LEVEL_GLOBAL, VULKAN_LEVEL_DEVICE, instance->extensions | device);
}

PFN_vkVoidFunction vkGetDeviceProcAddr(VkDevice device, const char *name)
{
    return vulkan_entry_find(name, VULKAN_LEVEL_DEVICE, VULKAN_LEVEL_DEVICE, device->extensions);
}

// The loader's entry points are the only symbols that the library shows.

__attribute__((visibility("default"))) VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
vk_icdGetInstanceProcAddr(VkInstance instance, const char *name);
__attribute__((visibility("default"))) VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
vk_icdGetPhysicalDeviceProcAddr(VkInstance instance, const char *name);
__attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t *version);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance, const char *name)
{
    return vkGetInstanceProcAddr(instance, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetPhysicalDeviceProcAddr(VkInstance instance,
                                                                         const char *name)
{
    return vulkan_entry_find(name, VULKAN_LEVEL_PHYSICAL_DEVICE, VULKAN_LEVEL_PHYSICAL_DEVICE,
                             instance ? instance->extensions : 0);
}

VKAPI_ATTR VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t *version)
{
    enum { NEWEST = 5, OLDEST = 2 };
    if (*version < OLDEST) {
        return VK_ERROR_INCOMPATIBLE_DRIVER;
    }
    *version = *version < NEWEST ? *version : NEWEST;
    return VK_SUCCESS;
}
