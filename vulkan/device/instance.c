// SPDX-License-Identifier: MIT
#include "instance.h"

#include <string.h>

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceVersion(uint32_t *version)
{
    *version = VK_API_VERSION_1_1;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceExtensionProperties(const char *layer, uint32_t *count,
                                                                      VkExtensionProperties *properties)
{
    return layer ? VK_ERROR_LAYER_NOT_PRESENT
                 : vulkan_extensions_enumerate(vulkan_extensions_of(false), count, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceLayerProperties(uint32_t *count,
                                                                  VkLayerProperties *properties)
{
    (void)properties;
    *count = 0;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateInstance(const VkInstanceCreateInfo *info,
                                                const VkAllocationCallbacks *callbacks, VkInstance *instance)
{
    *instance = VK_NULL_HANDLE;
    vulkan_extension_set extensions;
    const VkResult result = vulkan_extensions_enable(
        info->ppEnabledExtensionNames, info->enabledExtensionCount, vulkan_extensions_of(false), &extensions);
    if (result != VK_SUCCESS) {
        return result;
    }
    callbacks = vulkan_callbacks(callbacks, &vulkan_callbacks_default);
    const VkInstance made = vulkan_allocate(callbacks, sizeof *made, VK_SYSTEM_ALLOCATION_SCOPE_INSTANCE);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    const uint32_t version = info->pApplicationInfo ? info->pApplicationInfo->apiVersion : 0;
    *made = (struct VkInstance_T){
        .callbacks = *callbacks,
        .extensions = extensions,
        .api_version = version ? version : VK_API_VERSION_1_0,
    };
    set_loader_magic_value(made);
    made->physical.instance = made;
    set_loader_magic_value(&made->physical);
    *instance = made;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyInstance(VkInstance instance, const VkAllocationCallbacks *callbacks)
{
    (void)callbacks; // the ones that it was created with are kept
    if (instance) {
        const VkAllocationCallbacks own = instance->callbacks;
        vulkan_free(&own, instance);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumeratePhysicalDevices(VkInstance instance, uint32_t *count,
                                                          VkPhysicalDevice *devices)
{
    if (!devices) {
        *count = 1;
        return VK_SUCCESS;
    }
    if (*count == 0) {
        return VK_INCOMPLETE;
    }
    *count = 1;
    devices[0] = &instance->physical;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumeratePhysicalDeviceGroups(VkInstance instance, uint32_t *count,
                                                               VkPhysicalDeviceGroupProperties *groups)
{
    if (!groups) {
        *count = 1;
        return VK_SUCCESS;
    }
    if (*count == 0) {
        return VK_INCOMPLETE;
    }
    *count = 1;
    groups[0].physicalDeviceCount = 1;
    memset(groups[0].physicalDevices, 0, sizeof groups[0].physicalDevices);
    groups[0].physicalDevices[0] = &instance->physical;
    groups[0].subsetAllocation = VK_FALSE;
    return VK_SUCCESS;
}
