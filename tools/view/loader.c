// SPDX-License-Identifier: MIT
// See loader.h. The import itself runs in a process of its own (scene/import/reader_process.c), which shares a page
// with this one that says how far it is.
#include "loader.h"

#include "child.h"
#include "options.h"
#include "sanitizer.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct view_loader {
    struct render render;
    const char *path;
    double started; // milliseconds
    void (*wake)(void);
    pthread_t thread;
    int status;
    atomic_bool done, stopped;
    atomic_bool forks, waits; // see stand_still
};

static bool goes_on(void *user)
{
    struct view_loader *const loader = user;
    return !atomic_load(&loader->stopped);
}

// Reading forks a process; see pose_reader.c. A sanitized window therefore stands still from then on until it is done.
static void stand_still(struct view_loader *loader)
{
    while (SYSTEM_SANITIZED && atomic_load(&loader->forks) && !atomic_load(&loader->done)) {
        atomic_store(&loader->waits, true);
        sched_yield();
    }
}

static void wait_for_stillness(struct view_loader *loader)
{
    atomic_store(&loader->forks, true);
    loader->wake();
    while (SYSTEM_SANITIZED && !atomic_load(&loader->waits) && goes_on(loader)) {
        sched_yield();
    }
}

static void *load(void *user)
{
    struct view_loader *const loader = user;
    loader->status = CLI_FAILED;
    if (cli_render_take_input(&loader->render, loader->path)) {
        wait_for_stillness(loader);
        loader->status = cli_render_read(&loader->render);
    }
    atomic_store(&loader->done, true);
    loader->wake();
    return NULL;
}

static void release(struct view_loader *loader)
{
    system_child_unshare(loader->render.progress, sizeof *loader->render.progress);
    free(loader);
}

struct view_loader *view_loader_start(const struct cli_render_job *job, const char *path, void (*wake)(void))
{
    struct view_loader *const loader = calloc(1, sizeof *loader);
    void *const page = system_child_share(sizeof(struct scene_progress));
    if (!loader || !page) {
        cli_error(path, "out of memory");
        if (page) {
            system_child_unshare(page, sizeof(struct scene_progress));
        }
        free(loader);
        return NULL;
    }
    loader->render = (struct render){.job = *job, .progress = page, .goes_on = goes_on, .user = loader};
    loader->path = path;
    loader->started = cli_milliseconds();
    loader->wake = wake;
    if (pthread_create(&loader->thread, NULL, load, loader) != 0) {
        cli_error(path, "the system gives no thread to read it");
        release(loader);
        return NULL;
    }
    return loader;
}

bool view_loader_is_done(struct view_loader *loader)
{
    stand_still(loader);
    return atomic_load(&loader->done);
}

void view_loader_describe(const struct view_loader *loader, char *line, size_t size)
{
    const struct scene_progress *const progress = loader->render.progress;
    const uint32_t images = __atomic_load_n(&progress->images, __ATOMIC_RELAXED),
                   count = __atomic_load_n(&progress->image_count, __ATOMIC_RELAXED);
    const double seconds = (cli_milliseconds() - loader->started) / 1e3;
    const char *const slash = strrchr(loader->path, '/'), *const name = slash ? slash + 1 : loader->path;
    if (count > 0) {
        snprintf(line, size, "Reading %.60s: image %u of %u, %.1f s", name, images, count, seconds);
    } else {
        snprintf(line, size, "Reading %.60s: %.1f s", name, seconds);
    }
}

bool view_loader_take(struct view_loader *loader, struct render *read)
{
    pthread_join(loader->thread, NULL);
    const bool found = loader->status == CLI_OK;
    *read = loader->render;
    read->progress = NULL;
    read->goes_on = read->view.goes_on = NULL;
    if (!found) {
        cli_render_forget_model(read);
    }
    release(loader);
    return found;
}

void view_loader_stop(struct view_loader *loader)
{
    if (!loader) {
        return;
    }
    atomic_store(&loader->stopped, true);
    struct render read;
    if (view_loader_take(loader, &read)) {
        cli_render_forget_model(&read);
    }
}
