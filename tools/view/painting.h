// SPDX-License-Identifier: MIT
// What the window shows, being drawn: a model, its scene in one pose, and what is asked of it. Belongs to the painter's
// thread.
#ifndef VIEW_PAINTING_H
#define VIEW_PAINTING_H

#include "coarseness.h"
#include "render_state.h"

enum { VIEW_CELLS = 16 }; ///< each way, of a picture: where the model is

/// What a picture of the window is to show.
struct view_order {
    struct cli_render_job job; ///< its camera is ten numbers; what it points to outlives the painter
    bool hurries;              ///< something moves: coarsely where it takes long
    int version;               ///< of what is seen; who orders counts it
};

/// A picture as the window shows it.
struct view_picture {
    uint8_t *pixels; ///< [height][width][4], RGBA; free it. NULL: it could not be drawn, which was reported
    int width, height;
    bool is_coarse; ///< fewer samples or pixels than were ordered
    int version;    ///< of its order
    /// A bit for each cell, from the left, of each row of them, from the top: the model is there. Zeros where that is
    /// not known.
    uint16_t covered[VIEW_CELLS];
    double ms; ///< what it took to draw
    uint64_t triangles;
    int threads;
    enum rhw_isa isa;
};

/// Of an animation; or at rest.
struct view_moment {
    bool is_posed;
    double time;
    const char *animation; ///< NULL: the first
};

struct view_painting {
    /// What it does next, and asked while it does: false gives it up, without a report.
    void (*say)(void *user, const char *doing);
    bool (*goes_on)(void *user);
    void *user;
    // ---
    struct render render;            // its model is the pose that is shown
    struct scene_model *base, *pose; // as it was read; NULL, or as it is posed now
    struct view_moment base_moment, pose_moment;
    double drawn_ms; // what the last picture took
    struct view_coarseness coarseness;
    int saved; // files
};

/// With those three set; `panorama` is that of the job's environment and outlives it.
void view_painting_open(struct view_painting *p, const struct scene_panorama *panorama);
/// Takes over a model that was read, with its input; the one before it is freed.
void view_painting_adopt(struct view_painting *p, const struct render *read);
void view_painting_close(struct view_painting *p);

/// The picture has no pixels where it failed or was given up.
struct view_picture view_painting_draw(struct view_painting *p, const struct view_order *order);
/// How the pixel came to be, for the caller to free; NULL: it failed or was given up.
char *view_painting_explain(struct view_painting *p, const struct view_order *order, int x, int y);
/// Draws it into a file of its own in the current folder; the line that says so, likewise.
char *view_painting_save(struct view_painting *p, const struct view_order *order);

#endif
