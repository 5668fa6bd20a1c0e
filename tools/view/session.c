// SPDX-License-Identifier: MIT
// The loop of the window: events, what the threads have for it, and what is ordered of them. Nothing here waits for a
// file or a picture.
#include "session.h"

#include "draw/camera/subject.h"
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    REST_MS = 150,         // after the last movement a picture is drawn in full
    FRAME_MS = 15,         // between two looks at what moves
    NOTICE_MS = 200,       // between two looks at what does not
    LARGE_CORNERS = 300000 // of triangles
};

static Uint32 wake_event;

static void wake(void)
{
    SDL_PushEvent(&(SDL_Event){.type = wake_event});
}

static void hear(void *user, const char *line)
{
    view_session_note(user, "%s", line);
    wake();
}

// Models ---------------------------------------------------------------------------------------------

// What is shown stays as it is meanwhile.
static void read_model(struct view_session *s, const char *path, const struct cli_render_job *job)
{
    struct cli_render_job fitted = *job;
    fitted.width = s->window.width;
    fitted.height = s->window.height;
    view_loader_stop(s->loader);
    s->loader = view_loader_start(&fitted, path, wake);
    s->has_failed = !s->loader && !s->model;
}

// Whether a picture of it in full is waited for.
static bool is_large(const struct scene_model *model)
{
    uint64_t corners = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        corners += model->meshes[model->instances[i].mesh].index_count;
    }
    return corners > LARGE_CORNERS;
}

// What is shown from now on, and where from.
static void take_model(struct view_session *s)
{
    struct render read;
    const bool found = view_loader_take(s->loader, &read);
    s->loader = NULL;
    s->has_failed = !found && !s->model;
    if (!found) {
        return;
    }
    view_painter_show(s->painter, &read);
    view_session_close_explanation(s);
    s->model = read.model;
    s->job.model_path = read.input.is_standard_input ? "-" : read.input.name;
    s->job.variant = read.job.variant;
    s->first = (struct view_moment){read.job.is_posed, read.job.time, read.job.animation};
    view_session_rewind(s);
    const struct scene_box frame = scene_subject_frame(read.model);
    double size2 = 0.0;
    for (int c = 0; c < 3; c++) {
        const double size = frame.high[c] - frame.low[c];
        size2 += size * size;
        s->vertical[c] = c == 1;
    }
    scene_axis_turn(s->job.has_up ? s->job.up : read.model->up, s->vertical);
    s->extent = size2 > 0.0 ? 0.5 * sqrt(size2) : 1.0;
    view_eye_set(&s->eye, &read.view.camera, read.model);
    s->first_eye = s->eye;
    char title[300];
    const char *const slash = strrchr(read.input.name, '/');
    snprintf(title, sizeof title, "%.250s - rhw", slash ? slash + 1 : read.input.name);
    SDL_SetWindowTitle(s->window.window, title);
    if (read.model->animation_count > 0 && !s->job.is_posed) { // better advice than the warning of the import
        view_session_note(s, "Space plays the animation%s",
                          read.model->animation_count > 1 ? "; N: the next one" : "");
    }
    view_session_touch(
        s, is_large(read.model)); // its first picture is coarse, so that there is something to see
}

// Of another model there are no variants, animations or cameras that the command line could have named.
static void drop_model(struct view_session *s, char *path)
{
    struct cli_render_job job = s->job;
    view_session_note(s, "%s", ""); // it was of the model before
    char **const more = realloc(s->dropped, (size_t)(s->dropped_count + 1) * sizeof *more);
    if (!more) {
        SDL_free(path);
        return;
    }
    s->dropped = more;
    s->dropped[s->dropped_count++] = path;
    job.variant = job.animation = NULL;
    job.is_posed = false;
    job.time = 0.0;
    job.camera = CLI_CAMERA_AUTO;
    read_model(s, path, &job);
}

// Events ---------------------------------------------------------------------------------------------

static void handle(struct view_session *s, const SDL_Event *event)
{
    switch (event->type) {
    case SDL_QUIT: s->is_open = false; break;
    case SDL_KEYDOWN:
        view_session_act(s, event->key.keysym.sym, (event->key.keysym.mod & KMOD_SHIFT) != 0,
                         event->key.repeat != 0);
        break;
    case SDL_DROPFILE: drop_model(s, event->drop.file); break;
    case SDL_DROPTEXT: SDL_free(event->drop.file); break; // an address, say
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
    case SDL_MOUSEMOTION:
    case SDL_MOUSEWHEEL: view_session_mouse(s, event); break;
    default: break;
    }
}

// True where there was any.
static bool handle_all(struct view_session *s, int timeout)
{
    SDL_Event event;
    bool any = false;
    for (int found = SDL_WaitEventTimeout(&event, timeout); found; found = SDL_PollEvent(&event)) {
        handle(s, &event);
        any = true;
    }
    if (view_window_measure(&s->window)) {
        view_session_touch(s, true);
    }
    return any;
}

// A picture, or that there is none.
static void take_picture(struct view_session *s, struct view_picture *picture)
{
    s->awaits = false;
    if (!picture->pixels) {
        s->plays = false;
        s->has_failed = s->shown.width == 0;
        return;
    }
    s->has_failed = !view_window_set_picture(&s->window, picture);
    s->is_open = s->is_open && !s->has_failed;
    free(picture->pixels);
    picture->pixels = NULL;
    s->shown = *picture;
}

static void take_answer(struct view_session *s, const struct view_answer *answer)
{
    fputs(answer->text, stdout);
    fflush(stdout);
    if (answer->errand == VIEW_ERRAND_EXPLAIN) {
        view_session_open_explanation(s, answer);
    } else {
        view_session_note(s, "%.*s", (int)strcspn(answer->text, "\n"), answer->text);
        free(answer->text);
    }
}

// What the threads have made.
static void take_all(struct view_session *s)
{
    struct view_picture picture;
    if (s->loader && view_loader_is_done(s->loader)) {
        take_model(s);
    }
    if (view_painter_take_picture(s->painter, &picture)) {
        take_picture(s, &picture);
    }
    const struct view_answer answer = view_painter_take_answer(s->painter);
    if (answer.errand != VIEW_ERRAND_NONE) {
        take_answer(s, &answer);
    }
}

// Orders ---------------------------------------------------------------------------------------------

static void order(struct view_session *s)
{
    const bool rests = !s->drags && cli_milliseconds() - s->changed_at > REST_MS;
    if (!s->model || !(s->changed || (s->hurried && rests))) {
        return;
    }
    struct view_order wanted = view_session_order(s);
    wanted.hurries = s->changed && s->in_motion;
    s->hurried = wanted.hurries;
    s->changed = s->in_motion = false;
    s->awaits = true;
    view_painter_draw(s->painter, &wanted);
}

static void run(struct view_session *s)
{
    double before = cli_milliseconds();
    bool flies = false, tells = true;
    while (s->is_open) {
        const bool is_busy =
            flies || s->plays || s->hurried || s->loader || (s->awaits && s->shown.width == 0);
        const bool stirs = handle_all(s, is_busy ? FRAME_MS : NOTICE_MS);
        const double now = cli_milliseconds();
        flies = view_session_fly(s, (now - before) / 1e3);
        before = now;
        take_all(s);
        view_session_play(s);
        order(s);
        if (stirs || is_busy || tells) { // what takes time, or is shown for a while, changes by itself
            tells = view_session_draw(s) || s->awaits;
        }
    }
}

int view_session_run(const struct view_job *job, const struct scene_panorama *panorama)
{
    struct view_session s = {.job = job->render, .is_open = true, .shows_info = true};
    s.job.bits = 0;
    pthread_mutex_init(&s.notice_lock, NULL);
    if (view_window_open(&s.window, s.job.width, s.job.height, job->is_fullscreen)) {
        wake_event = SDL_RegisterEvents(1);
        cli_message_listen(hear, &s);
        s.painter = view_painter_start(panorama, wake);
        s.is_open = s.painter != NULL;
        if (s.painter) {
            read_model(&s, s.job.model_paths[0], &s.job);
            run(&s);
            SDL_HideWindow(s.window.window);
            view_loader_stop(s.loader);
            view_painter_stop(s.painter);
        }
        cli_message_listen(NULL, NULL);
    }
    view_window_close(&s.window);
    pthread_mutex_destroy(&s.notice_lock);
    view_session_close_explanation(&s);
    for (int i = 0; i < s.dropped_count; i++) {
        SDL_free(s.dropped[i]);
    }
    free(s.dropped);
    return s.painter && !s.has_failed ? CLI_OK : CLI_FAILED; // closed while it reads: that is no failure
}
