// SPDX-License-Identifier: MIT
// See painter.h.
#include "painter.h"

#include "options.h"

#include <pthread.h>
#include <stdlib.h>

struct view_painter {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t wanted;
    void (*wake)(void);

    // Under the lock: what is wanted, and what there is to take.
    bool quits, has_model, has_order, has_errand, has_picture;
    struct render model; // to be shown from now on
    unsigned generation; // of models that were shown
    bool gives_way;      // what is being drawn, to an order that hurries
    bool is_given_up;    // what is being done; whoever asks is told the same from then on
    struct view_order order, errand_order;
    enum view_errand errand;
    int x, y; // of the errand
    struct view_picture picture;
    struct view_answer answer;
    const char *doing;
    double doing_since;

    struct view_painting painting; // of the thread alone
};

static void say(void *user, const char *doing)
{
    struct view_painter *const p = user;
    pthread_mutex_lock(&p->lock);
    p->doing = doing;
    p->doing_since = cli_milliseconds();
    pthread_mutex_unlock(&p->lock);
}

// What is done for nobody is given up. Pictures of what moves are not: each would give way to the next.
static bool goes_on(void *user)
{
    struct view_painter *const p = user;
    pthread_mutex_lock(&p->lock);
    const bool is_outrun = p->gives_way && p->has_order && p->order.hurries;
    p->is_given_up = p->is_given_up || p->quits || p->has_model || is_outrun;
    const bool wanted = !p->is_given_up;
    pthread_mutex_unlock(&p->lock);
    return wanted;
}

// The thread -----------------------------------------------------------------------------------------

// Each is called and returns under the lock, which it does not hold meanwhile.

static void adopt(struct view_painter *p)
{
    const struct render model = p->model;
    p->has_model = false;
    pthread_mutex_unlock(&p->lock);
    view_painting_adopt(&p->painting, &model);
    pthread_mutex_lock(&p->lock);
}

static void run_errand(struct view_painter *p)
{
    const struct view_order order = p->errand_order;
    const unsigned generation = p->generation;
    struct view_answer answer = {.errand = p->errand, .x = p->x, .y = p->y, .version = order.version};
    p->has_errand = false;
    pthread_mutex_unlock(&p->lock);
    answer.text = answer.errand == VIEW_ERRAND_EXPLAIN
                      ? view_painting_explain(&p->painting, &order, answer.x, answer.y)
                      : view_painting_save(&p->painting, &order);
    pthread_mutex_lock(&p->lock);
    if (!answer.text || (answer.errand == VIEW_ERRAND_EXPLAIN && generation != p->generation)) {
        free(answer.text);
        return;
    }
    free(p->answer.text);
    p->answer = answer;
    p->wake();
}

static void paint(struct view_painter *p)
{
    const struct view_order order = p->order;
    const unsigned generation = p->generation;
    p->has_order = false;
    p->gives_way = !order.hurries;
    pthread_mutex_unlock(&p->lock);
    const struct view_picture picture = view_painting_draw(&p->painting, &order);
    pthread_mutex_lock(&p->lock);
    p->gives_way = false;
    const bool is_late = generation != p->generation || (!picture.pixels && p->has_order);
    if (is_late) {
        free(picture.pixels);
        return;
    }
    free(p->has_picture ? p->picture.pixels : NULL);
    p->picture = picture;
    p->has_picture = true;
    p->wake();
}

static void *paint_all(void *user)
{
    struct view_painter *const p = user;
    pthread_mutex_lock(&p->lock);
    while (!p->quits) {
        p->is_given_up = false;
        if (p->has_model) {
            adopt(p);
        } else if (p->has_errand) {
            run_errand(p);
        } else if (p->has_order) {
            paint(p);
        } else {
            pthread_cond_wait(&p->wanted, &p->lock);
        }
        p->doing = NULL;
    }
    pthread_mutex_unlock(&p->lock);
    view_painting_close(&p->painting);
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
    p->painting = (struct view_painting){.say = say, .goes_on = goes_on, .user = p};
    view_painting_open(&p->painting, panorama);
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->wanted, NULL);
    if (pthread_create(&p->thread, NULL, paint_all, p) != 0) {
        cli_error("view", "the system gives no thread to draw in");
        pthread_cond_destroy(&p->wanted);
        pthread_mutex_destroy(&p->lock);
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
    free(p->answer.text);
    pthread_cond_destroy(&p->wanted);
    pthread_mutex_destroy(&p->lock);
    free(p);
}

// Orders and what comes of them ----------------------------------------------------------------------

void view_painter_show(struct view_painter *p, const struct render *read)
{
    pthread_mutex_lock(&p->lock);
    if (p->has_model) {
        cli_render_forget_model(&p->model);
    }
    p->model = *read;
    p->has_model = true;
    p->generation++;
    p->has_order = p->has_errand = false;
    free(p->has_picture ? p->picture.pixels : NULL);
    p->has_picture = false;
    if (p->answer.errand == VIEW_ERRAND_EXPLAIN) {
        free(p->answer.text);
        p->answer = (struct view_answer){0};
    }
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

struct view_answer view_painter_take_answer(struct view_painter *p)
{
    pthread_mutex_lock(&p->lock);
    const struct view_answer answer = p->answer;
    p->answer = (struct view_answer){0};
    pthread_mutex_unlock(&p->lock);
    return answer;
}

const char *view_painter_doing(struct view_painter *p, double *ms)
{
    pthread_mutex_lock(&p->lock);
    const char *const doing = p->doing;
    *ms = cli_milliseconds() - p->doing_since;
    pthread_mutex_unlock(&p->lock);
    return doing;
}
