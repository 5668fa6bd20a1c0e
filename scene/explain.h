// SPDX-License-Identifier: MIT
// The history of a sample of a picture, fragment by fragment, with what the library does not know: which instance of the
// model each one is of, and what its varyings mean.
#ifndef SCENE_EXPLAIN_H
#define SCENE_EXPLAIN_H

#include "rhw/rhw.h"
#include "shaders.h"

enum { SCENE_DRAWN_BACKGROUND = -1, SCENE_DRAWN_GROUND = -2 };

/// What a draw of the colour pass draws.
struct scene_drawn {
    int32_t instance; ///< of the model, or one of those above
    struct scene_surface surface;
};

struct scene_explain {
    int x, y;   ///< of the picture
    int sample; ///< of the pixel, 0..samples − 1
    /// Is called while the view is drawn, in order. The fragment's places are those of a picture that begins with
    /// row `first_row` of this one.
    void (*fragment)(void *user, const struct rhw_explained_fragment *fragment,
                     const struct scene_drawn *drawn, int first_row);
    void *user;
};

enum { SCENE_COMPONENT_NAME = 32 };
/// "normal x", "uv of base color u", ..: what a component of the varyings is.
void scene_component_name(const struct scene_surface *surface, int component,
                          char name[SCENE_COMPONENT_NAME]);

/// What the draws of a pass draw, by their numbers. Zeroed: none.
struct scene_draw_log {
    struct scene_drawn *draws;
    uint32_t count, capacity;
};

/// False without memory. `surface` may be NULL.
bool scene_draw_log_add(struct scene_draw_log *log, int32_t instance, const struct scene_surface *surface);
void scene_draw_log_free(struct scene_draw_log *log);

#endif
