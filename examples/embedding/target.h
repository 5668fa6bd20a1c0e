// SPDX-License-Identifier: MIT
// A picture that follows the size of something else, of a window for instance.
#ifndef TARGET_H
#define TARGET_H

#include <rhw/rhw.h>

// Zeroed: nothing yet.
struct target {
    rhw_texture texture;
    int width, height;
};

// Gives the target width × height pixels. It stays as it is where that is its size, where there is nothing to see (a
// window that is minimized), and where there is no memory for a new one.
static inline enum rhw_result target_fit(rhw_context *context, struct target *target, int width, int height)
{
    if (width < 1 || height < 1 || (width == target->width && height == target->height)) {
        return RHW_OK;
    }
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = width;
    def.height = height;
    rhw_texture texture;
    const enum rhw_result result = rhw_texture_create(context, &def, &texture);
    if (result != RHW_OK) {
        return result;
    }
    if (target->width > 0) {
        rhw_texture_destroy(context, target->texture);
    }
    *target = (struct target){texture, width, height};
    return RHW_OK;
}

#endif
