// SPDX-License-Identifier: MIT
// See painter.h.
#define _GNU_SOURCE // open_memstream
#include "painter.h"

#include "explain_write.h"
#include "movement.h"
#include "options.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    SLOW_MS = 50,   // a picture of something that moves takes no longer, or the next is coarser
    QUICK_MS = 12,  // or the next is finer
    LEVEL_LAST = 5, // see coarsen
    LEAST_SIDE = 16 // pixels
};

// Of an animation; or at rest.
struct moment {
    bool is_posed;
    double time;
    const char *animation; // NULL: the first
};

struct view_painter {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t wanted;
    void (*wake)(void);

    // Under the lock: what is wanted, and what there is to take.
    bool quits, has_model, has_order, has_errand, has_picture;
    struct render model; // to be shown from now on
    struct view_order order, errand_order;
    enum view_errand errand, done_errand;
    int x, y; // of the errand
    struct view_picture picture;
    char *text;
    const char *doing;
    double doing_since;

    // Of the thread alone.
    struct render render;            // its model is the pose that is shown
    struct scene_model *base, *pose; // as it was read; NULL, or as it is posed now
    struct moment base_moment, pose_moment;
    double drawn_ms; // what the last picture took
    int level;       // of coarseness
    int saved;       // files
};

static void say(struct view_painter *p, const char *doing)
{
    pthread_mutex_lock(&p->lock);
    p->doing = doing;
    p->doing_since = cli_milliseconds();
    pthread_mutex_unlock(&p->lock);
}

// The model on the screen ----------------------------------------------------------------------------

static void forget_scene(struct view_painter *p)
{
    struct render *const render = &p->render;
    scene_pictures_free(&render->pictures);
    scene_destroy(render->scene);
    rhw_context_destroy(render->context);
    cli_movement_free_pose(p->pose);
    render->scene = NULL;
    render->context = NULL;
    render->model = p->base;
    p->pose = NULL;
}

static void forget_model(struct view_painter *p)
{
    forget_scene(p);
    cli_render_forget_model(&p->render);
    p->base = NULL;
}

static struct moment moment_of(const struct cli_render_job *job)
{
    return (struct moment){job->is_posed, job->time, job->animation};
}

static void adopt(struct view_painter *p, const struct render *read)
{
    forget_model(p);
    p->render.model = p->base = read->model;
    p->render.input = read->input;
    p->base_moment = moment_of(&read->job);
    p->level = 0;
}

static bool is_same_moment(struct moment a, struct moment b)
{
    const bool same_animation =
        a.animation == b.animation || (a.animation && b.animation && strcmp(a.animation, b.animation) == 0);
    return a.is_posed == b.is_posed && (!a.is_posed || (a.time == b.time && same_animation));
}

// The scene in the pose that the job asks for.
static bool set_pose(struct view_painter *p)
{
    struct render *const render = &p->render;
    const struct moment wanted = moment_of(&render->job);
    if (is_same_moment(wanted, p->pose ? p->pose_moment : p->base_moment)) {
        return true;
    }
    say(p, "Posing");
    render->model = p->base;
    const bool is_base = is_same_moment(wanted, p->base_moment);
    struct scene_model *const pose = is_base ? NULL : cli_pose_read(render, wanted.time);
    const bool posed = (is_base || pose) && scene_set_pose(render->scene, is_base ? p->base : pose) == RHW_OK;
    if (!posed) {
        forget_scene(p); // first: it may stand on the pose
        cli_movement_free_pose(pose);
        return false;
    }
    cli_movement_free_pose(p->pose);
    p->pose = pose;
    p->pose_moment = wanted;
    render->model = is_base ? p->base : pose;
    return true;
}

// Whatever the order says of threads and instruction set.
static bool open_scene(struct view_painter *p, const struct cli_render_job *job)
{
    struct render *const render = &p->render;
    const bool fits = render->scene && job->threads == render->job.threads && job->isa == render->job.isa &&
                      job->paths == render->job.paths;
    const char *const path = render->input.name;
    render->job = *job;
    render->job.model_path = path;
    if (!fits) {
        say(p, "Preparing");
        forget_scene(p);
        if (!cli_render_open_scene(render)) {
            forget_scene(p);
            return false;
        }
    }
    return set_pose(p);
}

// Drawing --------------------------------------------------------------------------------------------

// What a picture of something that moves can do without, step by step.
static void coarsen(struct cli_render_job *job, int level)
{
    static const int divisors[LEVEL_LAST + 1] = {1, 1, 2, 2, 4, 8};
    if (level > 0) {
        job->samples = job->supersample = 1;
    }
    if (level > 2) {
        job->shadows = job->ambient_occlusion = false;
    }
    job->width = job->width / divisors[level] > LEAST_SIDE ? job->width / divisors[level] : LEAST_SIDE;
    job->height = job->height / divisors[level] > LEAST_SIDE ? job->height / divisors[level] : LEAST_SIDE;
}

// Of the next picture in a hurry, after what the last one took. Each level takes a third of the one before, or so.
static void choose_level(struct view_painter *p, bool hurried)
{
    int level = hurried ? p->level : 0;
    double expected_ms = p->drawn_ms;
    while (expected_ms > SLOW_MS && level < LEVEL_LAST) {
        expected_ms /= 3.0;
        level++;
    }
    p->level = hurried && p->drawn_ms < QUICK_MS && level > 0 ? level - 1 : level;
}

// A transparent pixel over fields, as it is usual.
static void lay_over_fields(uint8_t *pixel, int x, int y)
{
    enum { FIELD = 12, LIGHT = 205, DARK = 170 };
    const int field = (x / FIELD + y / FIELD) % 2 ? DARK : LIGHT, alpha = pixel[3];
    for (int c = 0; c < 3; c++) {
        pixel[c] = (uint8_t)((pixel[c] * alpha + field * (255 - alpha) + 127) / 255);
    }
    pixel[3] = UINT8_MAX;
}

// The output that is shown, as a file has it, in RGBA. NULL without memory.
static uint8_t *make_pixels(const struct render *render)
{
    struct cli_output_raster output;
    const enum cli_output_kind kind = (enum cli_output_kind)__builtin_ctz(render->job.kinds);
    cli_render_rasterize(render, kind, &output);
    const int width = output.raster.width, height = output.raster.height, channels = output.raster.channels;
    uint8_t *const pixels = malloc((size_t)width * (size_t)height * 4), *const row = malloc((size_t)width *
                                                                                            (size_t)channels);
    for (int y = 0; y < height && pixels && row; y++) {
        output.raster.row(output.raster.user, y, row);
        for (int x = 0; x < width; x++) {
            const uint8_t *const from = row + x * channels;
            uint8_t *const to = pixels + 4 * ((size_t)y * (size_t)width + (size_t)x);
            for (int c = 0; c < 4; c++) {
                to[c] = channels == 1 && c < 3 ? from[0] : c < channels ? from[c] : UINT8_MAX;
            }
            if (channels == 4) {
                lay_over_fields(to, x, y);
            }
        }
    }
    free(row);
    if (!row) {
        free(pixels);
    }
    return row ? pixels : NULL;
}

static bool draw(struct view_painter *p, const struct cli_render_job *job, int level)
{
    struct render *const render = &p->render;
    if (!p->base || !open_scene(p, job)) {
        return false;
    }
    say(p, "Drawing");
    coarsen(&render->job, level);
    const double start = cli_milliseconds();
    const bool drawn = cli_render_set_view(render) && cli_render_draw(render);
    p->drawn_ms = cli_milliseconds() - start;
    return drawn;
}

static void paint(struct view_painter *p, const struct view_order *order)
{
    const int level = order->hurries ? p->level : 0;
    if (!draw(p, &order->job, level)) {
        return;
    }
    const struct render *const render = &p->render;
    struct view_picture picture = {.pixels = make_pixels(render),
                                   .width = render->pictures.width,
                                   .height = render->pictures.height,
                                   .is_coarse = level > 0,
                                   .ms = p->drawn_ms,
                                   .triangles = render->stats.pipeline.triangles_in,
                                   .threads = rhw_context_threads(render->context),
                                   .isa = rhw_context_isa(render->context)};
    if (!picture.pixels) {
        cli_error(render->job.model_path, "out of memory");
        return;
    }
    choose_level(p, order->hurries);
    pthread_mutex_lock(&p->lock);
    free(p->has_picture ? p->picture.pixels : NULL);
    p->picture = picture;
    p->has_picture = true;
    pthread_mutex_unlock(&p->lock);
    p->wake();
}

// Errands --------------------------------------------------------------------------------------------

static char *explain(struct view_painter *p, const struct cli_render_job *wanted, int x, int y)
{
    struct render *const render = &p->render;
    struct cli_history history = {0};
    const struct scene_explain ask = {.x = x, .y = y, .fragment = cli_history_add, .user = &history};
    struct cli_render_job job = *wanted;
    job.kinds = 1u << CLI_KIND_COLOR;
    char *text = NULL;
    size_t size;
    if (p->base && open_scene(p, &job) && cli_render_set_view(render)) {
        say(p, "Explaining");
        render->view.explain = &ask;
        const bool drawn = cli_render_draw(render);
        FILE *const out = drawn && !history.failed ? open_memstream(&text, &size) : NULL;
        if (out) {
            const struct cli_explanation explanation = {.model_path = render->job.model_path,
                                                        .model = render->model,
                                                        .history = &history,
                                                        .x = x,
                                                        .y = y,
                                                        .samples = render->view.samples,
                                                        .width = render->view.width,
                                                        .height = render->view.height,
                                                        .picture = render->pictures.color};
            cli_explain_text(out, &explanation);
            fclose(out);
        }
    }
    cli_history_free(&history);
    return text;
}

// The first name of a picture of the model that no file has.
static void name_picture(struct view_painter *p, char *name, size_t size)
{
    const char *const path = p->render.input.name, *const slash = strrchr(path, '/'),
                      *const base = slash ? slash + 1 : path;
    const char *const dot = strrchr(base, '.');
    const int stem = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    do {
        snprintf(name, size, "%.*s-%d.png", stem, base, ++p->saved);
    } while (access(name, F_OK) == 0);
}

static char *save(struct view_painter *p, const struct cli_render_job *wanted)
{
    char name[512], text[600];
    name_picture(p, name, sizeof name);
    if (!draw(p, wanted, 0)) {
        return NULL;
    }
    p->render.job.out = name;
    cli_render_files_forget(&p->render);
    const bool saved = cli_render_files_plan(&p->render, -1) && cli_render_files_write(&p->render);
    cli_render_files_forget(&p->render);
    snprintf(text, sizeof text, "Saved %s\n", name);
    return saved ? strdup(text) : NULL;
}

static void run_errand(struct view_painter *p, enum view_errand errand, const struct cli_render_job *job,
                       int x, int y)
{
    char *const text = errand == VIEW_ERRAND_EXPLAIN ? explain(p, job, x, y) : save(p, job);
    if (text) {
        pthread_mutex_lock(&p->lock);
        free(p->text);
        p->text = text;
        p->done_errand = errand;
        pthread_mutex_unlock(&p->lock);
        p->wake();
    }
}

// The thread -----------------------------------------------------------------------------------------

// One thing after the other: a model, an errand, a picture. Called and returns under the lock.
static void work(struct view_painter *p)
{
    if (p->has_model) {
        const struct render model = p->model;
        p->has_model = false;
        pthread_mutex_unlock(&p->lock);
        adopt(p, &model);
    } else if (p->has_errand) {
        const struct view_order order = p->errand_order;
        const enum view_errand errand = p->errand;
        const int x = p->x, y = p->y;
        p->has_errand = false;
        pthread_mutex_unlock(&p->lock);
        run_errand(p, errand, &order.job, x, y);
    } else {
        const struct view_order order = p->order;
        p->has_order = false;
        pthread_mutex_unlock(&p->lock);
        paint(p, &order);
    }
    pthread_mutex_lock(&p->lock);
    p->doing = NULL;
}

static void *paint_all(void *user)
{
    struct view_painter *const p = user;
    pthread_mutex_lock(&p->lock);
    while (!p->quits) {
        if (p->has_model || p->has_errand || p->has_order) {
            work(p);
        } else {
            pthread_cond_wait(&p->wanted, &p->lock);
        }
    }
    pthread_mutex_unlock(&p->lock);
    forget_model(p);
    return NULL;
}

struct view_painter *view_painter_start(const struct scene_panorama *panorama, void (*wake)(void))
{
    struct view_painter *const p = calloc(1, sizeof *p);
    if (!p) {
        cli_error("view", "out of memory");
        return NULL;
    }
    p->wake = wake;
    p->render.panorama = *panorama;
    p->render.input.descriptor = -1;
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->wanted, NULL);
    if (pthread_create(&p->thread, NULL, paint_all, p) != 0) {
        cli_error("view", "the system gives no thread to draw in");
        free(p);
        return NULL;
    }
    return p;
}

void view_painter_stop(struct view_painter *p)
{
    pthread_mutex_lock(&p->lock);
    p->quits = true;
    pthread_cond_signal(&p->wanted);
    pthread_mutex_unlock(&p->lock);
    pthread_join(p->thread, NULL);
    if (p->has_model) {
        cli_render_forget_model(&p->model);
    }
    free(p->has_picture ? p->picture.pixels : NULL);
    free(p->text);
    pthread_cond_destroy(&p->wanted);
    pthread_mutex_destroy(&p->lock);
    free(p);
}

void view_painter_show(struct view_painter *p, const struct render *read)
{
    pthread_mutex_lock(&p->lock);
    if (p->has_model) {
        cli_render_forget_model(&p->model);
    }
    p->model = *read;
    p->has_model = true;
    p->has_order = p->has_errand = false; // those were of the other model
    pthread_cond_signal(&p->wanted);
    pthread_mutex_unlock(&p->lock);
}

void view_painter_draw(struct view_painter *p, const struct view_order *order)
{
    pthread_mutex_lock(&p->lock);
    p->order = *order;
    p->has_order = true;
    pthread_cond_signal(&p->wanted);
    pthread_mutex_unlock(&p->lock);
}

void view_painter_send(struct view_painter *p, enum view_errand errand, const struct view_order *order, int x,
                       int y)
{
    pthread_mutex_lock(&p->lock);
    p->errand = errand;
    p->errand_order = *order;
    p->x = x;
    p->y = y;
    p->has_errand = true;
    pthread_cond_signal(&p->wanted);
    pthread_mutex_unlock(&p->lock);
}

bool view_painter_take_picture(struct view_painter *p, struct view_picture *picture)
{
    pthread_mutex_lock(&p->lock);
    const bool found = p->has_picture;
    if (found) {
        *picture = p->picture;
        p->has_picture = false;
    }
    pthread_mutex_unlock(&p->lock);
    return found;
}

char *view_painter_take_text(struct view_painter *p, enum view_errand *errand)
{
    pthread_mutex_lock(&p->lock);
    char *const text = p->text;
    *errand = p->done_errand;
    p->text = NULL;
    pthread_mutex_unlock(&p->lock);
    return text;
}

const char *view_painter_doing(struct view_painter *p, double *ms)
{
    pthread_mutex_lock(&p->lock);
    const char *const doing = p->doing;
    *ms = cli_milliseconds() - p->doing_since;
    pthread_mutex_unlock(&p->lock);
    return doing;
}
