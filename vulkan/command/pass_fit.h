// SPDX-License-Identifier: MIT
// A render pass that breaks rules of Vulkan about its attachments draws as much as other drivers do: within all of its
// attachments, and without an attachment that cannot be one beside the others.
#ifndef VULKAN_PASS_FIT_H
#define VULKAN_PASS_FIT_H

#include "pass_state.h"

// Make the definition of a pass one that librhw takes. Return false if nothing is left to draw into.
bool vulkan_pass_fit(const struct vulkan_pass_state *pass, struct rhw_pass_def *def);

#endif
