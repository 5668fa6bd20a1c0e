// SPDX-License-Identifier: MIT
// See frame_writer.h. A frame is a copy of what rhw render knows when it is drawn, with the picture and the paths moved
// into it; frame n has place n mod the number of places.
#include "frame_writer.h"

#include "message.h"
#include "sanitizer.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS_MAX = 8, PLACES_MAX = THREADS_MAX + 1 };

struct cli_frame_writer {
    struct cli_moving *moving;
    pthread_t threads[THREADS_MAX];
    int thread_count, place_count;
    pthread_mutex_t lock; // of all that follows
    pthread_cond_t changed;
    struct render places[PLACES_MAX];
    bool taken[PLACES_MAX];     // holds a frame that is not written
    int added, begun, finished; // frames; the last: all before it are in the moving file
    bool failed, closing;
};

static void free_frame(struct render *frame)
{
    scene_pictures_free(&frame->pictures);
    cli_render_files_forget(frame);
}

static enum scene_output_kind only_kind(const struct cli_render_job *job)
{
    int kind = 0;
    while (!(job->kinds >> kind & 1)) {
        kind++;
    }
    return (enum scene_output_kind)kind;
}

// Only one thread has the turn.
static void wait_for_turn(struct cli_frame_writer *writer, int number)
{
    pthread_mutex_lock(&writer->lock);
    while (writer->finished != number) {
        pthread_cond_wait(&writer->changed, &writer->lock);
    }
    pthread_mutex_unlock(&writer->lock);
}

static bool add_to_moving(struct cli_frame_writer *writer, const struct render *frame, int number)
{
    struct cli_output_raster output;
    struct cli_moving_frame encoded;
    cli_render_rasterize(frame, only_kind(&frame->job), &output);
    bool added = cli_moving_encode(writer->moving, &output.raster, &encoded);
    wait_for_turn(writer, number);
    added = added && cli_moving_add(writer->moving, &output.raster, &encoded);
    cli_moving_forget(&encoded);
    return added;
}

static bool write_frame(struct cli_frame_writer *writer, struct render *frame, int number, bool failed)
{
    bool written = false;
    if (writer->moving) {
        if (failed) {
            wait_for_turn(writer, number);
        } else {
            written = add_to_moving(writer, frame, number);
        }
    } else {
        written = !failed && cli_render_files_write(frame);
    }
    free_frame(frame);
    return written;
}

// The lock is held before and after.
static void work_on_next(struct cli_frame_writer *writer)
{
    const int number = writer->begun++, place = number % writer->place_count;
    const bool failed = writer->failed;
    pthread_mutex_unlock(&writer->lock);
    const bool written = write_frame(writer, &writer->places[place], number, failed);
    pthread_mutex_lock(&writer->lock);
    writer->taken[place] = false;
    writer->failed = writer->failed || !written;
    writer->finished += writer->moving ? 1 : 0;
    pthread_cond_broadcast(&writer->changed);
}

static void *work(void *user)
{
    struct cli_frame_writer *const writer = user;
    pthread_mutex_lock(&writer->lock);
    while (writer->begun < writer->added || !writer->closing) {
        if (writer->begun < writer->added) {
            work_on_next(writer);
        } else {
            pthread_cond_wait(&writer->changed, &writer->lock);
        }
    }
    pthread_mutex_unlock(&writer->lock);
    return NULL;
}

struct cli_frame_writer *cli_frame_writer_open(const struct render *render, struct cli_moving *moving)
{
    struct cli_frame_writer *const writer = calloc(1, sizeof *writer);
    if (!writer) {
        cli_error(render->job.model_path, "out of memory");
        return NULL;
    }
    const bool forks = SYSTEM_SANITIZED && render->job.rate > 0.0; // see pose_reader.c
    const int threads = forks ? 0 : rhw_context_threads(render->context);
    const int most = threads < THREADS_MAX ? threads : THREADS_MAX;
    writer->moving = moving;
    pthread_mutex_init(&writer->lock, NULL);
    pthread_cond_init(&writer->changed, NULL);
    writer->place_count = most + 1;
    while (writer->thread_count < most &&
           pthread_create(&writer->threads[writer->thread_count], NULL, work, writer) == 0) {
        writer->thread_count++;
    }
    return writer;
}

bool cli_frame_writer_add(struct cli_frame_writer *writer, struct render *render)
{
    pthread_mutex_lock(&writer->lock);
    const int place = writer->added % writer->place_count;
    while (writer->taken[place]) {
        pthread_cond_wait(&writer->changed, &writer->lock);
    }
    writer->places[place] = *render;
    writer->taken[place] = true;
    writer->added++;
    render->pictures = (struct scene_pictures){0};
    memset(render->paths, 0, sizeof render->paths);
    if (writer->thread_count == 0) { // the system gives none
        work_on_next(writer);
    }
    const bool going = !writer->failed;
    pthread_cond_broadcast(&writer->changed);
    pthread_mutex_unlock(&writer->lock);
    return going;
}

bool cli_frame_writer_close(struct cli_frame_writer *writer)
{
    pthread_mutex_lock(&writer->lock);
    writer->closing = true;
    pthread_cond_broadcast(&writer->changed);
    pthread_mutex_unlock(&writer->lock);
    for (int i = 0; i < writer->thread_count; i++) {
        pthread_join(writer->threads[i], NULL);
    }
    const bool written = !writer->failed;
    pthread_cond_destroy(&writer->changed);
    pthread_mutex_destroy(&writer->lock);
    free(writer);
    return written;
}
