// SPDX-License-Identifier: MIT
// What the window shows, and what the user has made of it so far.
#ifndef VIEW_SESSION_H
#define VIEW_SESSION_H

#include "eye.h"
#include "loader.h"
#include "painter.h"
#include "panel.h"
#include "view_job.h"
#include "window.h"

#include <pthread.h>

/// What a click explained, in a column of text beside the picture.
struct view_explanation {
    char *text; ///< NULL: none is open
    int x, y;   ///< pixel of a picture as large as the window was
    int version;
    int line; ///< the first that is shown
};

struct view_session {
    struct view_window window;
    struct view_painter *painter;
    struct view_loader *loader;      // NULL: nothing is being read
    const struct scene_model *model; // that the painter has, as it was read; NULL: none yet
    char **dropped; // the files that were dragged in, which models are named by until the end
    int dropped_count;

    struct cli_render_job job; // what is drawn, but for its camera, size and moment
    struct view_eye eye, first_eye;
    double vertical[3];       // what is up
    double extent;            // of the model: half its diagonal
    struct view_moment first; // as the model was read
    double duration;          // of the animation; 0: there is none
    bool plays;
    double played_from; // when time was 0, on the clock

    bool is_open, shows_info, shows_help, has_failed;
    struct view_picture shown; // without its pixels; width 0: none
    struct view_explanation explanation;
    int help_line;
    enum view_corner info_corner;
    char notice[512]; // the last that there was to say
    double noticed_at;
    pthread_mutex_t notice_lock;

    int version;             // of what is seen, whichever output shows it
    bool changed, in_motion; // since the last order; by something that goes on
    double changed_at;       // on the clock
    bool awaits;             // the picture of the last order
    bool hurried;            // the last order was drawn in a hurry: it is drawn again at rest
    bool drags, moved;       // a mouse button is down; and was moved since
    int button;              // which
    int from_x, from_y;      // where it went down
};

/// Until the window is closed; a cli_status.
int view_session_run(const struct view_job *job, const struct scene_panorama *panorama);

// session_change.c: what a key changes.

/// `repeats`: the key was down already.
void view_session_act(struct view_session *s, SDL_Keycode code, bool shift, bool repeats);
/// Moves what is open, an explanation or else the help, by lines. False: nothing is.
bool view_session_scroll(struct view_session *s, int lines);
/// Something of the picture is another now; `in_motion`: and will be again in a moment.
void view_session_touch(struct view_session *s, bool in_motion);
void view_session_note(struct view_session *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
/// The order of what there is to see now.
struct view_order view_session_order(const struct view_session *s);

// session_moment.c: animations.

/// Finds out how long the animation is.
void view_session_measure_animation(struct view_session *s);
/// Sets the moment of one that plays.
void view_session_play(struct view_session *s);
void view_session_play_or_pause(struct view_session *s);
/// By a thirtieth of a second, to a whole one: 1 ahead, −1 back.
void view_session_step(struct view_session *s, int direction);
void view_session_next_animation(struct view_session *s);
/// As the model was read.
void view_session_rewind(struct view_session *s);

// session_mouse.c: the mouse, and flying.

void view_session_mouse(struct view_session *s, const SDL_Event *event);
/// Moves the eye as the keys that are held say, for so many seconds. True where it moved.
bool view_session_fly(struct view_session *s, double seconds);

// session_explain.c: how a pixel came to be.

/// Asks for it.
void view_session_explain(struct view_session *s, int x, int y);
/// Opens what came of it.
void view_session_open_explanation(struct view_session *s, const struct view_answer *answer);
void view_session_close_explanation(struct view_session *s);
/// Says where in the window the picture stands: beside an explanation where one is open, else in all of it.
void view_session_place_picture(struct view_session *s);
/// Over the picture and beside it.
void view_session_draw_explanation(struct view_session *s);

// session_draw.c: what stands in the window.

/// True where something in it is there for a while only.
bool view_session_draw(struct view_session *s);

#endif
