// SPDX-License-Identifier: MIT
// The caller waits for the reader in short turns, and looks for signals between them. A reader that was given up frees
// the reading when it ends.
#include "panorama_reading.h"

#include "problem.h"

#include "panorama_load.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TURN_MS = 50 };

struct reading {
    pthread_mutex_t lock;
    pthread_cond_t has_ended;
    bool ended, given_up, loaded;
    struct scene_panorama panorama;
    char problem[PYTHON_PROBLEM_SIZE]; // of the reader's thread
    char path[];
};

static void free_reading(struct reading *reading)
{
    pthread_cond_destroy(&reading->has_ended);
    pthread_mutex_destroy(&reading->lock);
    free(reading);
}

static struct reading *make_reading(const char *path)
{
    const size_t size = strlen(path) + 1;
    struct reading *const reading = calloc(1, sizeof *reading + size);
    if (!reading) {
        return NULL;
    }
    if (pthread_mutex_init(&reading->lock, NULL) != 0) {
        free(reading);
        return NULL;
    }
    if (pthread_cond_init(&reading->has_ended, NULL) != 0) {
        pthread_mutex_destroy(&reading->lock);
        free(reading);
        return NULL;
    }
    memcpy(reading->path, path, size);
    return reading;
}

static void *read_panorama(void *user)
{
    struct reading *const reading = user;
    python_problem_forget();
    reading->loaded = cli_panorama_load(&reading->panorama, reading->path);
    strcpy(reading->problem, python_problem());
    pthread_mutex_lock(&reading->lock);
    const bool given_up = reading->given_up;
    reading->ended = true;
    pthread_cond_signal(&reading->has_ended);
    pthread_mutex_unlock(&reading->lock);
    if (given_up) {
        free(reading->loaded ? reading->panorama.texels : NULL);
        free_reading(reading);
    }
    return NULL;
}

static bool start(struct reading *reading)
{
    pthread_attr_t attributes;
    pthread_t thread;
    if (pthread_attr_init(&attributes) != 0) {
        return false;
    }
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    const bool started = pthread_create(&thread, &attributes, read_panorama, reading) == 0;
    pthread_attr_destroy(&attributes);
    return started;
}

static void wait_for_turn(struct reading *reading)
{
    struct timespec end;
    clock_gettime(CLOCK_REALTIME, &end);
    end.tv_nsec += TURN_MS * 1000000;
    end.tv_sec += end.tv_nsec / 1000000000;
    end.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&reading->has_ended, &reading->lock, &end);
}

// Waits for the reader. False if it was given up, and has the reading.
static bool wait_for(struct reading *reading)
{
    struct python_work work = python_work_begin();
    pthread_mutex_lock(&reading->lock);
    while (!reading->ended && !reading->given_up) {
        wait_for_turn(reading);
        pthread_mutex_unlock(&reading->lock);
        const bool goes_on = python_work_goes_on(&work);
        pthread_mutex_lock(&reading->lock);
        reading->given_up = !goes_on && !reading->ended;
    }
    const bool given_up = reading->given_up;
    pthread_mutex_unlock(&reading->lock);
    PyEval_RestoreThread(work.state);
    return !given_up;
}

bool python_panorama_load(const char *path, struct scene_panorama *panorama)
{
    struct reading *const reading = make_reading(path);
    if (!reading || !start(reading)) {
        if (reading) {
            free_reading(reading);
        }
        PyErr_NoMemory();
        return false;
    }
    if (!wait_for(reading)) {
        return false;
    }
    const bool loaded = reading->loaded && !PyErr_Occurred();
    if (loaded) {
        *panorama = reading->panorama;
    } else {
        free(reading->loaded ? reading->panorama.texels : NULL);
        if (!PyErr_Occurred()) {
            PyErr_SetString(python_error, reading->problem);
        }
    }
    free_reading(reading);
    return loaded;
}
