// SPDX-License-Identifier: MIT
// What keys change; see session.h. Most of it is a member of the job, as an option of rhw render would set it.
#include "command_line.h"
#include "keys.h"
#include "session.h"
#include "draw/camera/subject.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void view_session_touch(struct view_session *s, bool in_motion)
{
    s->version++;
    s->changed = true;
    s->in_motion = in_motion;
    s->changed_at = cli_milliseconds();
}

void view_session_note(struct view_session *s, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    pthread_mutex_lock(&s->notice_lock);
    vsnprintf(s->notice, sizeof s->notice, format, arguments);
    s->noticed_at = cli_milliseconds();
    pthread_mutex_unlock(&s->notice_lock);
    va_end(arguments);
}

static enum scene_output_kind kind_of(const struct view_session *s)
{
    return (enum scene_output_kind)__builtin_ctz(s->job.kinds);
}

struct view_order view_session_order(const struct view_session *s)
{
    struct view_order order = {.job = s->job, .version = s->version};
    struct cli_render_job *const job = &order.job;
    const enum scene_output_kind kind = kind_of(s);
    job->width = s->window.width;
    job->height = s->window.height;
    job->camera = CLI_CAMERA_LOOK;
    job->orthographic = s->eye.orthographic;
    view_eye_numbers(&s->eye, job->look);
    job->quiet = true; // what there is to warn of was said when the file was read
    job->bits = kind == SCENE_KIND_DEPTH || kind == SCENE_KIND_DISTANCE ? 8 : 0; // as a window has
    return order;
}

// Choices --------------------------------------------------------------------------------------------

static int turn(int value, int count, bool back)
{
    return (value + (back ? count - 1 : 1)) % count;
}

static void choose_output(struct view_session *s, int kind)
{
    s->job.kinds = 1u << kind;
}

static void choose_lights(struct view_session *s)
{
    static const char *const names[] = {"those of the file, if any", "default", "none"};
    struct cli_render_job *const job = &s->job;
    const int choice = turn(job->no_lights ? 2 : job->default_lights ? 1 : 0, 3, false);
    job->default_lights = choice > 0;
    job->no_lights = choice == 2;
    view_session_note(s, "Lights: %s", names[choice]);
}

static void choose_background(struct view_session *s, bool back)
{
    static const struct {
        enum scene_background background;
        uint8_t level;
        const char *name;
    } choices[] = {{SCENE_BACKGROUND_DEFAULT, 0, "default"},
                   {SCENE_BACKGROUND_COLOR, 255, "white"},
                   {SCENE_BACKGROUND_COLOR, 0, "black"},
                   {SCENE_BACKGROUND_TRANSPARENT, 0, "transparent"},
                   {SCENE_BACKGROUND_PANORAMA, 0, "environment"}};
    const int count = s->job.environment ? 5 : 4;
    int at = 0;
    for (int i = 0; i < count; i++) {
        const bool same =
            choices[i].background == s->job.background && (choices[i].background != SCENE_BACKGROUND_COLOR ||
                                                           choices[i].level == s->job.background_color[0]);
        at = same ? i : at;
    }
    at = turn(at, count, back);
    s->job.background = choices[at].background;
    memset(s->job.background_color, choices[at].level, sizeof s->job.background_color);
    view_session_note(s, "Background: %s", choices[at].name);
}

// All, then powers of two below what there are.
static void choose_threads(struct view_session *s)
{
    const int now = s->job.threads, next = now == 0 ? 1 : 2 * now;
    s->job.threads = next > SDL_GetCPUCount() || next > RHW_MAX_THREADS ? 0 : next;
}

static void choose_isa(struct view_session *s)
{
    int isa = s->job.isa == RHW_ISA_COUNT ? (int)s->shown.isa : (int)s->job.isa;
    do {
        isa = turn(isa, RHW_ISA_COUNT, false);
    } while (!rhw_isa_supported((enum rhw_isa)isa));
    s->job.isa = (enum rhw_isa)isa;
}

static void choose_samples(struct view_session *s, bool back)
{
    const int next = back ? s->job.samples / 2 : 2 * s->job.samples;
    s->job.samples = next == 0 ? 16 : next > 16 ? 1 : next;
}

// Places ---------------------------------------------------------------------------------------------

// All of the model, seen from where it is seen now: the ball around it in the picture.
static void fit(struct view_session *s)
{
    const struct scene_subject subject = scene_subject_find(s->model);
    double middle[3], radius2 = 0.0;
    for (int c = 0; c < 3; c++) {
        const double low = subject.box.low[c], high = subject.box.high[c];
        middle[c] = 0.5 * (low + high) + s->model->origin[c];
        radius2 += 0.25 * (high - low) * (high - low);
    }
    const double least = 1e-3 * s->extent, radius = sqrt(radius2); // a point has none
    view_eye_fit(&s->eye, middle, radius > least ? radius : least,
                 (double)s->window.width / s->window.height);
}

static void reset(struct view_session *s)
{
    s->eye = s->first_eye;
    view_session_rewind(s);
}

// Errands --------------------------------------------------------------------------------------------

static void copy(struct view_session *s)
{
    const struct view_order order = view_session_order(s);
    char *const line = view_command_line(&order.job);
    if (line) {
        SDL_SetClipboardText(line);
        printf("%s\n", line);
        fflush(stdout);
        view_session_note(s, "Copied the rhw render that draws this");
    }
    free(line);
}

static void save(struct view_session *s)
{
    const struct view_order order = view_session_order(s);
    view_painter_send(s->painter, VIEW_ERRAND_SAVE, &order, 0, 0);
}

bool view_session_scroll(struct view_session *s, int lines)
{
    int *const line = s->explanation.text ? &s->explanation.line : s->shows_help ? &s->help_line : NULL;
    if (line) {
        *line += lines; // what draws it knows its end
    }
    return line != NULL;
}

static void leave(struct view_session *s)
{
    if (s->explanation.text) {
        view_session_close_explanation(s);
    } else if (s->shows_help) {
        s->shows_help = false;
    } else {
        s->is_open = false;
    }
}

// Keys -----------------------------------------------------------------------------------------------

// What concerns the window alone. False: it is another action.
static bool act_on_window(struct view_session *s, const struct view_key *key)
{
    switch (key->action) {
    case VIEW_INFO: s->shows_info = !s->shows_info; return true;
    case VIEW_HELP:
        s->shows_help = !s->shows_help;
        s->help_line = 0;
        return true;
    case VIEW_FULLSCREEN: view_window_toggle_fullscreen(&s->window); return true;
    case VIEW_SCROLL: view_session_scroll(s, key->argument); return true;
    case VIEW_LEAVE: leave(s); return true;
    default: return false;
    }
}

// Changes the picture. False: it does not.
static bool act_on_picture(struct view_session *s, const struct view_key *key, bool shift)
{
    struct cli_render_job *const job = &s->job;
    switch (key->action) {
    case VIEW_OUTPUT: choose_output(s, key->argument); break;
    case VIEW_NEXT_OUTPUT: choose_output(s, turn((int)kind_of(s), CLI_OUTPUT_KINDS, shift)); break;
    case VIEW_WIREFRAME: job->wireframe = (enum scene_wireframe)turn((int)job->wireframe, 3, shift); break;
    case VIEW_INTERPOLATE:
        job->interpolate = job->interpolate == RHW_SMOOTH ? RHW_NOPERSPECTIVE : RHW_SMOOTH;
        break;
    case VIEW_SAMPLES: choose_samples(s, shift); break;
    case VIEW_LIGHTS: choose_lights(s); break;
    case VIEW_SHADOWS: job->shadows = job->ambient_occlusion = !job->shadows; break;
    case VIEW_BACKGROUND: choose_background(s, shift); break;
    case VIEW_THREADS: choose_threads(s); break;
    case VIEW_ISA: choose_isa(s); break;
    case VIEW_FIT: fit(s); break;
    case VIEW_RESET: reset(s); break;
    case VIEW_PLAY: view_session_play_or_pause(s); break;
    case VIEW_STEP: view_session_step(s, key->argument); break;
    case VIEW_ANIMATION: view_session_next_animation(s); break;
    default: return false;
    }
    return true;
}

void view_session_act(struct view_session *s, SDL_Keycode code, bool shift, bool repeats)
{
    const struct view_key *const key = view_key_find(code);
    if (repeats && !(key && (key->action == VIEW_STEP || key->action == VIEW_SCROLL))) {
        return; // a key that is held would switch to and fro
    }
    view_session_note(s, "%s", ""); // what was said has been read
    if (!key || act_on_window(s, key) || !s->model) {
        return;
    }
    const int version = s->version;
    if (act_on_picture(s, key, shift)) {
        view_session_touch(s, false);
    } else if (key->action == VIEW_COPY) {
        copy(s);
    } else if (key->action == VIEW_SAVE) {
        save(s);
    }
    if (key->action == VIEW_OUTPUT || key->action == VIEW_NEXT_OUTPUT) {
        s->version = version; // the same places are seen
    }
}
