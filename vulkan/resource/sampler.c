// SPDX-License-Identifier: MIT
#include "sampler.h"

#include "device/chain.h"

#include <string.h>

enum rhw_compare vulkan_compare(VkCompareOp compare)
{
    static const enum rhw_compare compares[] = {
        [VK_COMPARE_OP_NEVER] = RHW_COMPARE_NEVER,
        [VK_COMPARE_OP_LESS] = RHW_COMPARE_LESS,
        [VK_COMPARE_OP_EQUAL] = RHW_COMPARE_EQUAL,
        [VK_COMPARE_OP_LESS_OR_EQUAL] = RHW_COMPARE_LESS_EQUAL,
        [VK_COMPARE_OP_GREATER] = RHW_COMPARE_GREATER,
        [VK_COMPARE_OP_NOT_EQUAL] = RHW_COMPARE_NOT_EQUAL,
        [VK_COMPARE_OP_GREATER_OR_EQUAL] = RHW_COMPARE_GREATER_EQUAL,
        [VK_COMPARE_OP_ALWAYS] = RHW_COMPARE_ALWAYS,
    };
    return (unsigned)compare < sizeof compares / sizeof *compares ? compares[compare] : RHW_COMPARE_ALWAYS;
}

static enum rhw_filter filter_of(VkFilter filter)
{
    return filter == VK_FILTER_NEAREST ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR;
}

static enum rhw_address address_of(VkSamplerAddressMode mode)
{
    switch (mode) {
    case VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT: return RHW_ADDRESS_MIRROR;
    case VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE: return RHW_ADDRESS_CLAMP;
    case VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER: return RHW_ADDRESS_BORDER;
    case VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE: return RHW_ADDRESS_MIRROR_ONCE;
    default: return RHW_ADDRESS_REPEAT;
    }
}

// A border is black or white, and its alpha is 0 or 1.
static void set_border(VkBorderColor color, struct rhw_sampler_def *def)
{
    const bool is_white =
        color == VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE || color == VK_BORDER_COLOR_INT_OPAQUE_WHITE;
    const bool is_opaque =
        is_white || color == VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK || color == VK_BORDER_COLOR_INT_OPAQUE_BLACK;
    for (int i = 0; i < 4; i++) {
        const int value = i == 3 ? is_opaque : is_white;
        def->border[i] = (float)value;
        def->border_integer[i] = value;
    }
}

// Return true if a sampler has a border of its own, and set it.
static bool set_own_border(const VkSamplerCreateInfo *info, struct rhw_sampler_def *def)
{
    const VkSamplerCustomBorderColorCreateInfoEXT *const own =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_SAMPLER_CUSTOM_BORDER_COLOR_CREATE_INFO_EXT);
    const bool is_own = info->borderColor == VK_BORDER_COLOR_FLOAT_CUSTOM_EXT ||
                        info->borderColor == VK_BORDER_COLOR_INT_CUSTOM_EXT;
    if (!is_own || !own) {
        return false;
    }
    if (info->borderColor == VK_BORDER_COLOR_FLOAT_CUSTOM_EXT) {
        memcpy(def->border, own->customBorderColor.float32, sizeof def->border);
    } else {
        memcpy(def->border_integer, own->customBorderColor.int32, sizeof def->border_integer);
    }
    return true;
}

static void set_levels(const VkSamplerCreateInfo *info, struct rhw_sampler_def *def)
{
    def->mip_filter =
        info->mipmapMode == VK_SAMPLER_MIPMAP_MODE_NEAREST ? RHW_MIP_FILTER_NEAREST : RHW_MIP_FILTER_LINEAR;
    def->lod_bias = info->mipLodBias;
    def->lod_min = info->minLod;
    def->lod_max = info->maxLod == 0 ? -1.0f : info->maxLod;
    def->max_anisotropy = info->anisotropyEnable ? info->maxAnisotropy : 0;
}

static struct rhw_sampler_def definition(const VkSamplerCreateInfo *info)
{
    struct rhw_sampler_def def = rhw_sampler_def_default();
    def.min_filter = filter_of(info->minFilter);
    def.mag_filter = filter_of(info->magFilter);
    def.address_u = address_of(info->addressModeU);
    def.address_v = address_of(info->addressModeV);
    def.address_w = address_of(info->addressModeW);
    if (!set_own_border(info, &def)) {
        set_border(info->borderColor, &def);
    }
    if (info->unnormalizedCoordinates) {
        def.unnormalized = true;
        def.mip_filter = RHW_MIP_FILTER_NONE;
        def.address_w = RHW_ADDRESS_CLAMP;
        return def;
    }
    set_levels(info, &def);
    def.compares = info->compareEnable;
    def.compare = info->compareEnable ? vulkan_compare(info->compareOp) : RHW_COMPARE_LESS;
    return def;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateSampler(VkDevice device, const VkSamplerCreateInfo *info,
                                               const VkAllocationCallbacks *callbacks, VkSampler *sampler)
{
    *sampler = vulkan_device_allocate(device, callbacks, sizeof **sampler);
    if (!*sampler) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*sampler)->def = definition(info);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroySampler(VkDevice device, VkSampler sampler,
                                            const VkAllocationCallbacks *callbacks)
{
    if (sampler) {
        vulkan_retire_sampler(&device->queue, sampler->sampler);
        vulkan_device_free(device, callbacks, sampler);
    }
}

const struct rhw_binding *vulkan_sampler_binding(VkQueue queue, VkSampler sampler)
{
    if (!sampler->has_binding) {
        enum rhw_result result = RHW_OK;
        if (sampler->sampler.context == 0) {
            result = rhw_sampler_create(queue->context, &sampler->def, &sampler->sampler);
        }
        if (result == RHW_OK) {
            result = rhw_binding_of_sampler(queue->context, sampler->sampler, &sampler->binding);
        }
        sampler->has_binding = result == RHW_OK || result == RHW_ERROR_MISUSE;
    }
    return sampler->has_binding ? &sampler->binding : NULL;
}

// Formats with several planes are not there, so nothing converts from them.

VKAPI_ATTR VkResult VKAPI_CALL vkCreateSamplerYcbcrConversion(VkDevice device,
                                                              const VkSamplerYcbcrConversionCreateInfo *info,
                                                              const VkAllocationCallbacks *callbacks,
                                                              VkSamplerYcbcrConversion *conversion)
{
    (void)device;
    (void)info;
    (void)callbacks;
    *conversion = VK_NULL_HANDLE;
    return VK_ERROR_OUT_OF_HOST_MEMORY;
}

VKAPI_ATTR void VKAPI_CALL vkDestroySamplerYcbcrConversion(VkDevice device,
                                                           VkSamplerYcbcrConversion conversion,
                                                           const VkAllocationCallbacks *callbacks)
{
    (void)device;
    (void)conversion;
    (void)callbacks;
}
