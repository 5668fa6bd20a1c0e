// SPDX-License-Identifier: MIT
// Draws in a thread of its own, so that the window never waits for a picture: of what is ordered the newest is drawn,
// and what was ordered meanwhile is forgotten. Models are counted: what was made of one is never taken once another is
// shown.
#ifndef VIEW_PAINTER_H
#define VIEW_PAINTER_H

#include "painting.h"

/// What is done once, beside drawing.
enum view_errand {
    VIEW_ERRAND_NONE,
    VIEW_ERRAND_EXPLAIN, ///< gives a text
    VIEW_ERRAND_SAVE     ///< writes a file, in the current folder
};

/// What an errand gave.
struct view_answer {
    enum view_errand errand; ///< NONE: there is nothing yet
    char *text;              ///< free it
    int x, y;                ///< of the pixel
    int version;             ///< of the order
};

struct view_painter;

/// `wake` is called by the painter's thread when there is something to take. `panorama` is that of the job's
/// environment and outlives the painter. NULL after a report.
struct view_painter *view_painter_start(const struct scene_panorama *panorama, void (*wake)(void));
/// Gives up what it is doing.
void view_painter_stop(struct view_painter *painter);
/// Takes over a model that was read, with its input; the one before it is freed. What was made of that is forgotten,
/// but for the word that a file was saved.
void view_painter_show(struct view_painter *painter, const struct render *read);
void view_painter_draw(struct view_painter *painter, const struct view_order *order);
/// Of the picture that is ordered; x and y: of its pixel that is to be explained. It takes the place of an errand that
/// has not begun.
void view_painter_send(struct view_painter *painter, enum view_errand errand, const struct view_order *order,
                       int x, int y);
/// The newest picture that was not taken yet, or the failure of the newest order; false: there is neither.
bool view_painter_take_picture(struct view_painter *painter, struct view_picture *picture);
/// What the last errand gave.
struct view_answer view_painter_take_answer(struct view_painter *painter);
/// What it is doing and since how many milliseconds, for the eye; NULL: it waits.
const char *view_painter_doing(struct view_painter *painter, double *ms);

#endif
