// SPDX-License-Identifier: MIT
// Draws in a thread of its own, so that the window never waits for a picture: of what is ordered the newest is drawn, and
// what was ordered meanwhile is forgotten.
#ifndef VIEW_PAINTER_H
#define VIEW_PAINTER_H

#include "render_state.h"

/// What a picture of the window is to show.
struct view_order {
    struct cli_render_job job; ///< its camera is ten numbers; what it points to outlives the painter
    bool hurries;              ///< something moves: coarsely where it takes long
};

/// A picture as the window shows it.
struct view_picture {
    uint8_t *pixels; ///< [height][width][4], RGBA; free it
    int width, height;
    bool is_coarse; ///< fewer samples or pixels than were ordered
    double ms;      ///< what it took to draw
    uint64_t triangles;
    int threads;
    enum rhw_isa isa;
};

/// What is done once, beside drawing.
enum view_errand {
    VIEW_ERRAND_NONE,
    VIEW_ERRAND_EXPLAIN, ///< gives a text
    VIEW_ERRAND_SAVE     ///< writes a file, in the current folder
};

struct view_painter;

/// `wake` is called by the painter's thread when there is something to take. `panorama` is that of the job's environment
/// and outlives the painter. NULL after a report.
struct view_painter *view_painter_start(const struct scene_panorama *panorama, void (*wake)(void));
void view_painter_stop(struct view_painter *painter);
/// Takes over a model that was read, with its input; the one before it is freed.
void view_painter_show(struct view_painter *painter, const struct render *read);
void view_painter_draw(struct view_painter *painter, const struct view_order *order);
/// Of the picture that is ordered; x and y: of its pixel that is to be explained. It takes the place of an errand that has not
/// begun.
void view_painter_send(struct view_painter *painter, enum view_errand errand, const struct view_order *order,
                       int x, int y);
/// The newest picture that was not taken yet; false: there is none.
bool view_painter_take_picture(struct view_painter *painter, struct view_picture *picture);
/// What the last errand gave, for the caller to free; NULL: nothing yet.
char *view_painter_take_text(struct view_painter *painter, enum view_errand *errand);
/// What it is doing and since how many milliseconds, for the eye; NULL: it waits.
const char *view_painter_doing(struct view_painter *painter, double *ms);

#endif
