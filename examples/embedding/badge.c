// SPDX-License-Identifier: MIT
// The library: rhw is linked into it statically. Built with -fvisibility=hidden, so that what it shows is marked here;
// what comes from librhw.a is hidden already.
#include "badge.h"

#include "cube.h"
#include "target.h"

__attribute__((visibility("default"))) int badge_draw(unsigned char *pixels, int size)
{
    const struct rhw_context_def def = {.threads = 1}; // a small picture: no thread of ours in your process
    struct target target = {0};
    rhw_context *context;
    rhw_pipeline pipeline;
    const bool good = rhw_context_create(&def, &context) == RHW_OK &&
                      cube_pipeline(context, &pipeline) == RHW_OK &&
                      target_fit(context, &target, size, size) == RHW_OK &&
                      cube_draw(context, pipeline, target.texture, 0.5f) == RHW_OK;
    if (good) {
        rhw_texture_read(context, target.texture, 0, pixels, 0);
    }
    rhw_context_destroy(context);
    return good ? 0 : -1;
}
