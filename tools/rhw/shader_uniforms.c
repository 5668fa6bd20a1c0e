// SPDX-License-Identifier: MIT
// See shader_uniforms.h. No clock is read, so that a picture has the same bytes every day: the date is the first day
// of 1970, and --time tells its seconds.
#include "shader_uniforms.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FRAME_RATE  60.0   // frames a second that --time is taken to be of
#define SAMPLE_RATE 44100U // of sound, which is what ShaderToy's is

enum { CHANNELS = 4 };

// A uniform: its numbers, of each element where it is an array.
struct value {
    const char *name;
    double numbers[CHANNELS][4];
};

static void write_number(enum rhw_shader_type_kind kind, double number, char *bytes)
{
    if (kind == RHW_SHADER_FLOAT) {
        const float single = (float)number;
        memcpy(bytes, &single, sizeof single);
    } else {
        const int32_t whole = (int32_t)fmax(-2147483648.0, fmin(number, 2147483647.0));
        memcpy(bytes, &whole, sizeof whole);
    }
}

// Write a scalar or vector of 32-bit numbers at an offset, as far as there is room.
static void write_vector(const struct rhw_shader_type *type, const double *numbers, char *memory,
                         size_t offset, size_t size)
{
    const size_t bytes = 4 * (size_t)type->rows;
    if (type->kind > RHW_SHADER_UINT || type->bits != 32 || type->columns != 1 || offset > size ||
        size - offset < bytes) {
        return;
    }
    for (uint32_t i = 0; i < type->rows; i++) {
        write_number(type->kind, numbers[i], memory + offset + 4 * (size_t)i);
    }
}

static void write_value(const struct rhw_shader_member *member, const struct value *value, char *memory,
                        size_t size)
{
    const struct rhw_shader_type *const type = member->type;
    if (type->kind != RHW_SHADER_ARRAY) {
        write_vector(type, value->numbers[0], memory, member->offset, size);
        return;
    }
    for (uint32_t i = 0; i < type->count && i < CHANNELS; i++) {
        write_vector(type->element, value->numbers[i], memory, member->offset + (size_t)type->stride * i,
                     size);
    }
}

// Find the picture of a channel. Return NULL if the shaders name none.
static const struct cli_shader_resource *find_channel(const struct cli_shader_resources *resources,
                                                      int channel)
{
    char name[24];
    snprintf(name, sizeof name, "iChannel%d", channel);
    for (int i = 0; i < resources->count; i++) {
        if (strcmp(resources->list[i].what->name, name) == 0) {
            return &resources->list[i];
        }
    }
    return NULL;
}

void cli_shader_uniforms_set(const struct rhw_shader_type *block, const struct cli_shader_job *job,
                             const struct cli_shader_resources *resources, void *memory, size_t size)
{
    const double x = job->mouse[0], y = job->mouse[1], time = job->time;
    struct value channel_sizes = {.name = "iChannelResolution"};
    for (int i = 0; i < CHANNELS; i++) {
        const struct cli_shader_resource *const channel = find_channel(resources, i);
        if (channel != NULL && channel->width > 0) {
            channel_sizes.numbers[i][0] = channel->width;
            channel_sizes.numbers[i][1] = channel->height;
            channel_sizes.numbers[i][2] = 1;
        }
    }
    const struct value values[] = {
        {"iResolution", {{job->width, job->height, 1}}},
        {"iTime", {{time}}},
        {"iTimeDelta", {{1 / FRAME_RATE}}},
        {"iFrame", {{floor(FRAME_RATE * time + 0.5)}}},
        {"iFrameRate", {{FRAME_RATE}}},
        {"iMouse", {{x, y, x, y}}},
        {"iDate", {{1970, 0, 1, time}}},
        {"iSampleRate", {{SAMPLE_RATE}}},
        {"iChannelTime", {{time}, {time}, {time}, {time}}},
        channel_sizes,
    };
    for (uint32_t i = 0; block != NULL && i < block->count; i++) {
        for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
            if (strcmp(block->members[i].name, values[v].name) == 0) {
                write_value(&block->members[i], &values[v], memory, size);
            }
        }
    }
}
