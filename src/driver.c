// SPDX-License-Identifier: MIT
#include "driver.h"

#include "context/context.h"
#include "pipeline/pipeline_check.h"
#include "resource/texture.h"

void rhw_driver_texture_layout(const struct rhw_texture_def *def, struct rhw_texture_layout *layout)
{
    rhw_texture_layout_of(def, layout);
}

bool rhw_driver_pipeline_check(const struct rhw_pipeline_def *def,
                               void (*tell)(void *user, const char *message))
{
    // The context of the driver belongs to another thread. One that nobody has entered is enough to tell misuse.
    struct rhw_context context = {.assert_ = tell};
    rhw_pipeline pipeline;
    return rhw_pipeline_check(&context, def, 0, &pipeline);
}
