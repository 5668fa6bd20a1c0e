// SPDX-License-Identifier: MIT
// See frame.h.
#include "frame.h"

#include <math.h>
#include <string.h>

void frame_begin(struct frame *frame, int width, int height)
{
    memset(frame, 0, sizeof *frame);
    frame->width = width;
    frame->height = height;
    frame->samples = 1;
    frame->target_count = 1;
    frame->formats[0] = RHW_FORMAT_RGBA8_UNORM;
    frame->depth_clear = 1;
    frame->random = 1;
}

static uint32_t next(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

int frame_random(struct frame *frame, int limit)
{
    return (int)(next(&frame->random) % (uint32_t)limit);
}

float frame_random_part(struct frame *frame)
{
    return (float)frame_random(frame, 257) / 256;
}

struct frame_draw frame_draw_default(const struct frame *frame, const struct shader_pair *shaders)
{
    struct frame_draw draw = {.shaders = shaders, .instances = 1};
    draw.state.provoking = RHW_PROVOKING_LAST;
    draw.state.depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE;
    draw.state.target_count = frame->target_count;
    for (int i = 0; i < frame->target_count; i++) {
        draw.state.targets[i].format = frame->formats[i];
    }
    return draw;
}

struct frame_vertex frame_vertex_at(const struct frame *frame, double x, double y, double z,
                                    const float value[4])
{
    const double left = round(x * FRAME_SNAP) / FRAME_SNAP, top = round(y * FRAME_SNAP) / FRAME_SNAP;
    struct frame_vertex vertex = {
        {(float)(2 * left / frame->width - 1), (float)(1 - 2 * top / frame->height), (float)z, 1}, {0}};
    memcpy(vertex.value, value, sizeof vertex.value);
    return vertex;
}

void frame_add_vertex(struct frame *frame, struct frame_vertex vertex)
{
    frame->vertices[frame->vertex_count++] = vertex;
}

void frame_add_quad(struct frame *frame, double x, double y, double width, double height, double z,
                    const float low[4], const float high[4])
{
    static const int corner[6][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 0}, {0, 1}, {1, 1}};
    for (int i = 0; i < 6; i++) {
        const int right = corner[i][0], down = corner[i][1];
        const float value[4] = {right ? high[0] : low[0], down ? high[1] : low[1], right ? high[2] : low[2],
                                right ? high[3] : low[3]};
        frame_add_vertex(frame, frame_vertex_at(frame, x + right * width, y + down * height, z, value));
    }
}

static int within(int a, int pixels)
{
    return a < 0 ? 0 : a > pixels * FRAME_SNAP - 2 ? pixels * FRAME_SNAP - 2 : a;
}

static void add_triangles(struct frame *frame, int count, int reach, bool leaves)
{
    for (int i = 0; i < count; i++) {
        const int x = frame_random(frame, frame->width * FRAME_SNAP);
        const int y = frame_random(frame, frame->height * FRAME_SNAP);
        const double z = (double)frame_random_part(frame) * 2 - 1;
        for (int corner = 0; corner < 3; corner++) {
            const int dx = frame_random(frame, reach * FRAME_SNAP) - reach * FRAME_SNAP / 2;
            const int dy = frame_random(frame, reach * FRAME_SNAP) - reach * FRAME_SNAP / 2;
            const int left = leaves ? x + dx : within(x + dx, frame->width);
            const int top = leaves ? y + dy : within(y + dy, frame->height);
            const float value[4] = {frame_random_part(frame), frame_random_part(frame),
                                    frame_random_part(frame), frame_random_part(frame)};
            frame_add_vertex(frame, frame_vertex_at(frame, (double)(left | 1) / FRAME_SNAP,
                                                    (double)(top | 1) / FRAME_SNAP, z, value));
        }
    }
}

void frame_add_triangles(struct frame *frame, int count, int reach)
{
    add_triangles(frame, count, reach, false);
}

void frame_add_wide_triangles(struct frame *frame, int count, int reach)
{
    add_triangles(frame, count, reach, true);
}

struct frame_draw *frame_add_draw(struct frame *frame, struct frame_draw draw)
{
    struct frame_draw *const added = &frame->draws[frame->draw_count];
    if (frame->draw_count > 0) {
        const struct frame_draw *const last = added - 1;
        draw.first = last->indexed ? 0 : last->first + last->count;
    }
    draw.count = frame->vertex_count - draw.first;
    *added = draw;
    frame->draw_count++;
    return added;
}

static uint32_t hash(uint32_t a)
{
    a = (a ^ a >> 16) * 0x7feb352du;
    a = (a ^ a >> 15) * 0x846ca68bu;
    return a ^ a >> 16;
}

static uint16_t half_of(float part) // of 0..1 in steps of 1/256
{
    const int steps = (int)(part * 256);
    int exponent = 0;
    if (steps == 0) {
        return 0;
    }
    const double fraction = frexp(steps / 256.0, &exponent);
    return (uint16_t)((exponent - 1 + 15) << 10 | (int)((fraction * 2 - 1) * 1024));
}

static bool is_half(enum rhw_format format)
{
    return format == RHW_FORMAT_R16_FLOAT || format == RHW_FORMAT_RG16_FLOAT ||
           format == RHW_FORMAT_RGBA16_FLOAT;
}

static bool is_float(enum rhw_format format)
{
    return format == RHW_FORMAT_D32_FLOAT || format == RHW_FORMAT_R32_FLOAT ||
           format == RHW_FORMAT_RG32_FLOAT || format == RHW_FORMAT_RGBA32_FLOAT;
}

void frame_texels(const struct frame_texture *texture, int level, int layer, unsigned char *texels)
{
    const enum rhw_format format = texture->def.format;
    const int block_width = rhw_format_block_width(format), block_height = rhw_format_block_height(format);
    const int wide = texture->def.width >> level, high = texture->def.height >> level;
    const int columns = ((wide ? wide : 1) + block_width - 1) / block_width;
    const int rows = ((high ? high : 1) + block_height - 1) / block_height;
    const size_t bytes = rhw_format_block_bytes(format);
    const size_t step = is_float(format) ? 4 : is_half(format) ? 2 : 1;
    for (int y = 0; y < rows; y++) {
        for (int x = 0; x < columns; x++) {
            for (size_t at = 0; at < bytes; at += step, texels += step) {
                const uint32_t channel = (uint32_t)(at / step);
                const uint32_t noise =
                    hash(hash(hash((uint32_t)x + 1000u * (uint32_t)y) + 16u * (uint32_t)layer + channel) +
                         (uint32_t)level);
                const int byte = texture->plain ? level * (15 + 5 * (int)channel) : (int)(noise & 255);
                const float part = (float)byte / 256;
                const uint16_t half = half_of(part);
                if (step == 4) {
                    memcpy(texels, &part, step);
                } else if (step == 2) {
                    memcpy(texels, &half, step);
                } else {
                    *texels = (unsigned char)byte;
                }
            }
        }
    }
}
