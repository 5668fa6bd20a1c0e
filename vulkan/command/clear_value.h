// SPDX-License-Identifier: MIT
// Values that texels are cleared to, as librhw takes them.
#ifndef VULKAN_CLEAR_VALUE_H
#define VULKAN_CLEAR_VALUE_H

#include "rhw/rhw.h"
#include <vulkan/vulkan_core.h>

// Set `color` or `integer` to a colour of a format, and the other one to 0. Integers are cut to the bits that the
// format has.
void vulkan_clear_color(enum rhw_format format, const VkClearColorValue *value, float color[4],
                        int32_t integer[4]);

// Return depth within 0..1.
float vulkan_clear_depth(float depth);

#endif
