// SPDX-License-Identifier: MIT
// A sampler is kept as a definition until a command needs it.
#ifndef VULKAN_SAMPLER_H
#define VULKAN_SAMPLER_H

#include "device/device.h"

struct VkSampler_T {
    struct rhw_sampler_def def;

    // The queue's thread has these.
    rhw_sampler sampler; ///< null id until a command needs it
    struct rhw_binding binding;
    bool has_binding;
};

// Return the binding of a sampler. It is empty where librhw refuses the sampler. The queue's thread calls this. Return
// NULL if memory is lost.
const struct rhw_binding *vulkan_sampler_binding(VkQueue queue, VkSampler sampler);

// Return rhw_compare of VkCompareOp.
enum rhw_compare vulkan_compare(VkCompareOp compare);

#endif
