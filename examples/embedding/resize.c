// SPDX-License-Identifier: MIT
// Draws into a picture that changes its size, on one context and with one pipeline. Prints each size and a number made
// of the picture: the same size has the same one.
#include <stdio.h>

#include "cube.h"
#include "picture_hash.h"
#include "target.h"

int main(void)
{
    static const int sizes[][2] = {{640, 480}, {1280, 720}, {1, 1}, {0, 0}, {300, 900}, {640, 480}};
    const struct rhw_context_def def = {0};
    struct target target = {0};
    rhw_context *context;
    rhw_pipeline pipeline;
    if (rhw_context_create(&def, &context) != RHW_OK) {
        return 1;
    }
    enum rhw_result result = cube_pipeline(context, &pipeline);
    for (size_t i = 0; result == RHW_OK && i < sizeof sizes / sizeof sizes[0]; i++) {
        result = target_fit(context, &target, sizes[i][0], sizes[i][1]);
        if (result == RHW_OK) {
            result = cube_draw(context, pipeline, target.texture, 0.5f);
        }
        if (result == RHW_OK) {
            printf("%d x %d %016llx\n", target.width, target.height,
                   (unsigned long long)hash_picture(context, target.texture));
        }
    }
    rhw_context_destroy(context);
    if (result != RHW_OK) {
        fprintf(stderr, "resize: %s\n", rhw_result_string(result));
    }
    return result != RHW_OK;
}
