// SPDX-License-Identifier: MIT
// What a pass draws into, as far as the definition of a pipeline has to agree with it. Vulkan wants the two to agree;
// where they do not, other drivers draw into what is there, and so the definition is adapted to the pass.
#ifndef VULKAN_PIPELINE_TARGETS_H
#define VULKAN_PIPELINE_TARGETS_H

#include "rhw/rhw.h"

struct vulkan_targets {
    int count;
    enum rhw_format formats[RHW_MAX_COLOR_ATTACHMENTS]; ///< RHW_FORMAT_NONE of an attachment that is left out
    bool has_depth, has_stencil;
    bool keeps_depth, keeps_stencil; ///< the aspect is read only
};

// Return true if pipelines of a definition draw into targets as it stands.
bool vulkan_targets_fit(const struct vulkan_targets *targets, const struct rhw_pipeline_def *def);

// Change a definition so that its pipelines draw into targets. Colours that the pass does not have are dropped. Colours
// that the pipeline does not have stay as they are, and so do depth and stencil that are read only.
void vulkan_targets_adapt(const struct vulkan_targets *targets, struct rhw_pipeline_def *def);

bool vulkan_targets_are_equal(const struct vulkan_targets *a, const struct vulkan_targets *b);

#endif
