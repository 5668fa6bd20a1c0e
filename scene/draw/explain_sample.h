// SPDX-License-Identifier: MIT
// The history of a sample of a picture, fragment by fragment, with what the library does not know: which instance of
// the model each fragment belongs to, and what its varyings mean.
#ifndef SCENE_EXPLAIN_SAMPLE_H
#define SCENE_EXPLAIN_SAMPLE_H

#include "rhw/rhw.h"
#include "draw/shading/scene_shaders.h"

enum { SCENE_DRAWN_BACKGROUND = -1, SCENE_DRAWN_GROUND = -2 };

/// What a draw of the colour pass draws.
struct scene_drawn {
    int32_t instance; ///< instance of the model, or one of the constants above
    struct scene_surface surface;
};

/// A texture that the fragment function of a surface reads, at the coordinates that it has.
struct scene_texture_look {
    enum scene_slot slot;
    float uv[2];
    float step[2][2]; ///< steps of u and v to the pixel on the right and to the one below
    float lod; ///< λ of the Vulkan specification, which follows from the steps; the levels there are bound it
    float level;      ///< level that is read; with a fraction it lies between two levels
    bool is_enlarged; ///< a texel is at least as wide as a pixel: the magnification filter is that which counts
    int base_width, base_height; ///< texels of level 0
    int width, height;           ///< texels of the finer of the two levels
    float place[2];              ///< in its texels, from the middle of the first: those around it are mixed
    float texels
        [2][4]
        [4]; ///< around the place, top left, top right, below: in that level, and in the next one at its place
    float texel[4]; ///< what sampling gives; colours are light
};

struct scene_explain {
    int x, y;   ///< place in the pixels that are drawn: `supersample` of them are one pixel of the picture
    int sample; ///< sample of the pixel, 0..samples − 1
    /// Is called while the view is drawn, in order. The fragment's places are those of a target that begins with
    /// row `first_row` of the pixels that are drawn.
    void (*fragment)(void *user, const struct rhw_explained_fragment *fragment,
                     const struct scene_drawn *drawn, int first_row);
    void *user;
};

/// The looks of a surface's shaded fragment, while that is told; returns how many there are, SCENE_SLOT_COUNT at most.
int scene_texture_looks(const struct rhw_explained_fragment *fragment, const struct scene_surface *surface,
                        struct scene_texture_look looks[SCENE_SLOT_COUNT]);
/// "base color", "normal map", ..
const char *scene_slot_name(enum scene_slot slot);

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
