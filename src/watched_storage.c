// SPDX-License-Identifier: MIT
// Storage under validation.
#include "findings.h"
#include "watch.h"

void rhw_watch_storage(const struct rhw_bindings *textures, int slot, enum rhw_storage_operation operation)
{
    const struct rhw_sample_site *const site = &textures->site;
    if ((unsigned)slot >= RHW_MAX_STORAGE_BUFFERS) {
        rhw_findings_add(site->findings, RHW_FINDING_MISUSE, site->draw,
                         "a shader function of %s uses storage slot %d; slots are 0..%d", site->pipeline,
                         slot, RHW_MAX_STORAGE_BUFFERS - 1);
    } else if (!textures->storage->buffers[slot].words) {
        rhw_findings_add(site->findings, RHW_FINDING_MISUSE, site->draw,
                         "a shader function of %s uses storage slot %d, in which no buffer is set",
                         site->pipeline, slot);
    } else if (textures->drops_effects && operation != RHW_STORAGE_LOAD) {
        rhw_findings_add(site->findings, RHW_FINDING_MISUSE, site->draw,
                         "a shader function of %s writes to storage slot %d; its program declares no such "
                         "effects, by RHW_USE_EFFECTS or vertex_effects",
                         site->pipeline, slot);
    }
}
