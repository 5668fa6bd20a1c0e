// SPDX-License-Identifier: MIT
// Two threads draw at the same time, each in a context of its own. Prints a number made of what each has drawn: both
// draw the same, so they are equal.
#include <pthread.h>
#include <stdio.h>

#include "cube.h"
#include "picture_hash.h"
#include "target.h"

enum { PAINTERS = 2, FRAMES = 20 };

struct painter {
    enum rhw_result result;
    uint64_t hash;
};

// Everything of a context is created, used and destroyed by one thread at a time; here by this one alone.
static enum rhw_result paint(struct painter *painter)
{
    struct rhw_context_def def = rhw_context_def_default();
    struct target target = {0};
    rhw_context *context;
    rhw_pipeline pipeline;
    def.threads = 1; // the painters share the cores; 0 would give each context all of them
    enum rhw_result result = rhw_context_create(&def, &context);
    if (result == RHW_OK) {
        result = cube_pipeline(context, &pipeline);
    }
    if (result == RHW_OK) {
        result = target_fit(context, &target, 320, 240);
    }
    for (int frame = 0; result == RHW_OK && frame < FRAMES; frame++) {
        result = cube_draw(context, pipeline, target.texture, (float)frame * 0.1f);
    }
    if (result == RHW_OK) {
        painter->hash = hash_picture(context, target.texture);
    }
    rhw_context_destroy(context);
    return result;
}

static void *run(void *argument)
{
    struct painter *const painter = argument;
    painter->result = paint(painter);
    return NULL;
}

int main(void)
{
    struct painter painters[PAINTERS] = {0};
    pthread_t threads[PAINTERS];
    int started = 0, status = 0;
    while (started < PAINTERS && pthread_create(&threads[started], NULL, run, &painters[started]) == 0) {
        started++;
    }
    for (int i = 0; i < started; i++) {
        pthread_join(threads[i], NULL);
        printf("%016llx %s\n", (unsigned long long)painters[i].hash, rhw_result_string(painters[i].result));
        status |= painters[i].result != RHW_OK;
    }
    return started < PAINTERS || status;
}
