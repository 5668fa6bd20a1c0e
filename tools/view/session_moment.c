// SPDX-License-Identifier: MIT
// Animations: which one, and when; see session.h.
#include "movement.h"
#include "options.h"
#include "session.h"

#include <math.h>
#include <stdio.h>

enum { MOST_ANIMATIONS = 1000 };      // that one can go through
static const double step_rate = 30.0; // to the second

void view_session_measure_animation(struct view_session *s)
{
    const uint32_t chosen = cli_movement_animation(&s->job, s->model);
    s->duration = chosen < s->model->animation_count ? (double)s->model->animations[chosen].seconds : 0.0;
}

// A thousandth of a second is what --time is told.
static void set_time(struct view_session *s, double time)
{
    const double wrapped = s->duration > 0.0 ? time - s->duration * floor(time / s->duration) : 0.0;
    s->job.is_posed = true;
    s->job.time = floor(wrapped * 1e3 + 1e-6) / 1e3;
}

void view_session_play(struct view_session *s)
{
    if (s->plays) {
        set_time(s, (cli_milliseconds() - s->played_from) / 1e3);
        view_session_touch(s, true);
    }
}

static bool is_animated(struct view_session *s)
{
    if (s->model->animation_count > 0) {
        return true;
    }
    view_session_note(s, "The model has no animation");
    return false;
}

void view_session_play_or_pause(struct view_session *s)
{
    if (is_animated(s)) {
        s->plays = !s->plays;
        s->played_from = cli_milliseconds() - (s->job.is_posed ? s->job.time : 0.0) * 1e3;
    }
}

void view_session_step(struct view_session *s, int direction)
{
    enum { WITHIN = 20 }; // a step's time was cut to a thousandth of a second, which is a thirtieth of a step
    if (!is_animated(s)) {
        return;
    }
    const double steps = (s->job.is_posed ? s->job.time : 0.0) * step_rate, near = 1.0 / WITHIN;
    const double next = direction > 0 ? floor(steps + near) + 1.0 : ceil(steps - near) - 1.0;
    const double last = ceil(s->duration * step_rate - near) - 1.0; // before the end, which is the beginning
    s->plays = false;
    set_time(s, (next < 0.0 ? last : next > last ? 0.0 : next) / step_rate);
}

// By number, as names need not be different. The painter may look at it until the end.
static const char *name_of(uint32_t number)
{
    static char names[MOST_ANIMATIONS][12];
    if (!names[number][0]) {
        snprintf(names[number], sizeof names[number], "%u", (unsigned)number);
    }
    return names[number];
}

void view_session_next_animation(struct view_session *s)
{
    if (!is_animated(s)) {
        return;
    }
    const uint32_t count =
        s->model->animation_count < MOST_ANIMATIONS ? s->model->animation_count : MOST_ANIMATIONS;
    const uint32_t next = (cli_movement_animation(&s->job, s->model) + 1) % count;
    s->job.animation = name_of(next);
    view_session_measure_animation(s);
    s->played_from = cli_milliseconds();
    s->job.is_posed = true;
    s->job.time = 0.0;
    view_session_note(s, "Animation %u of %u: %s", next + 1, s->model->animation_count,
                      s->model->animations[next].name);
}

void view_session_rewind(struct view_session *s)
{
    s->plays = false;
    s->job.is_posed = s->first.is_posed;
    s->job.time = s->first.time;
    s->job.animation = s->first.animation;
    view_session_measure_animation(s);
}
