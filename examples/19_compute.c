// SPDX-License-Identifier: MIT
// Lesson 19: compute. Functions that draw nothing run over a grid of workgroups, and read and write buffers and images.
//
// A table of sums says of every pixel how much stands above and to the left of it. The sum over any rectangle is then a
// sum of four numbers of the table, so a blur costs the same whatever its radius. The table is made by prefix sums: along
// each row, then along each column. A workgroup adds up one row in shared memory: in step i every invocation adds what
// stands 2^i places before it, and after 9 steps 400 numbers are sums of all before them. All must have read before one
// writes: a barrier stands between the two, which in C is the end of one loop over the workgroup and the beginning of
// the next.
//
// Left the picture, in the middle one radius for all pixels, right a radius that grows with the distance from what the
// lens is focused on.
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { SIZE = 400, CHANNELS = 3, BALLS = 9, GROUPS = SIZE / RHW_LANES };
enum { FULL = 4095 }; // the number that stands for 1: the sum over the picture stays below 2^31

static const float eye[3] = {-2.2f, 2.2f, 6.5f}, target_point[3] = {0.4f, 0.3f, 0}, zoom = 2.6f;
static const float paper[4] = {0.80f, 0.86f, 0.92f, 1}, sun[3] = {0.36f, 0.80f, 0.48f};
static const float focus = 7.2f; // distance ahead that is sharp

// Drawing: balls on a chequered floor, and the distance of each pixel ---------------------------------

struct place {
    float center[3], size[3], color[3];
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const float *camera = groups[i].uniforms;
        rhw_float world[3];
        for (int k = 0; k < 3; k++) {
            world[k] = groups[i].attribute[0][k] * groups[i].attribute[3][k] + groups[i].attribute[2][k];
            groups[i].varying[k] = groups[i].attribute[1][k];
            groups[i].varying[3 + k] = groups[i].attribute[4][k];
            groups[i].varying[6 + k] = world[k];
        }
        rhw_mat4_mul_point(camera, world, groups[i].position);
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_float *const v = groups[i].varying;
        const rhw_int field = rhw_int_from_float(rhw_floor(v[6])) + rhw_int_from_float(rhw_floor(v[8]));
        const rhw_int dark = rhw_equal_int(field & 1, rhw_splat_int(0)) & (v[7] < 0.001f);
        rhw_float normal[3];
        rhw_normalize3(v, normal);
        const rhw_float direct = rhw_max(normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2], 0.0f);
        for (int k = 0; k < 3; k++) {
            const rhw_float color = rhw_select(dark, v[3 + k] * 0.15f, v[3 + k]);
            groups[i].color[0][k] = color * (0.25f + 0.75f * direct);
        }
        groups[i].color[0][3] = rhw_splat(1);
        groups[i].color[1][0] = 1.0f / groups[i].coord[3]; // w, the distance ahead
    }
}

static void draw(rhw_context *context, rhw_texture colors, rhw_texture distances)
{
    struct place places[1 + BALLS] = {{{0, 0, 0}, {40, 1, 40}, {0.75f, 0.75f, 0.72f}}};
    for (int i = 0; i < BALLS; i++) {
        const float turn = (float)i * 0.7f, along = (float)i - 1;
        places[1 + i] = (struct place){{-1.7f + 0.95f * along, 0.45f, 3.0f - 1.6f * along},
                                       {0.45f, 0.45f, 0.45f},
                                       {0.5f + 0.4f * rhw_sin1(turn), 0.5f + 0.4f * rhw_sin1(turn + 2),
                                        0.5f + 0.4f * rhw_sin1(turn + 4)}};
    }
    struct rhw_pipeline_def def = solid_pipeline_def();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {paint},
                                       .varyings = {{.components = 3}, {.components = 3}, {.components = 3}},
                                       .varying_count = 3,
                                       .uniform_size = 16 * sizeof(float),
                                       .uses = RHW_USE_COORD};
    for (int k = 0; k < 3; k++) {
        def.attributes[2 + k] =
            (struct rhw_attribute){RHW_VERTEX_FLOAT3, 1, (uint32_t)(3 * sizeof(float)) * (uint32_t)k};
    }
    def.attribute_count = 5;
    def.buffers[1].per_instance = true;
    def.buffer_count = 2;
    def.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
    def.targets[1].format = RHW_FORMAT_R32_FLOAT;
    def.target_count = 2;
    def.label = "lesson 19";
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    struct rhw_pass_def attachments = {
        .colors = {{.texture = colors}, {.texture = distances, .clear = {100}}},
        .color_count = 2,
        .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
        .label = "colours and distances"};
    memcpy(attachments.colors[0].clear, paper, sizeof paper);
    float camera[16];
    solid_camera(eye, target_point, zoom, camera);
    const rhw_buffer vertices = solid_buffer(context),
                     instances = picture_vertices(context, places, sizeof places);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    rhw_pass_set_uniforms(context, pass, camera, sizeof camera);
    rhw_pass_set_vertex_buffer(context, pass, 1, instances, 0);
    solid_draw(context, pass, SOLID_SQUARE, 1);
    rhw_pass_set_vertex_buffer(context, pass, 1, instances, sizeof *places);
    solid_draw(context, pass, SOLID_BALL, BALLS);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, vertices);
    rhw_buffer_destroy(context, instances);
    rhw_pipeline_destroy(context, pipeline);
}

// Numbers: a texel becomes three whole numbers, because sums of them are exact --------------------------

static rhw_int index_of(rhw_int x, rhw_int y, int channel)
{
    return (channel * SIZE + y) * SIZE + x;
}

static void to_numbers(struct rhw_workgroup *w)
{
    for (int g = 0; g < w->count; g++) {
        const struct rhw_invocations *const i = &w->groups[g];
        rhw_float texel[4];
        rhw_sample_fetch(w->bindings, 0, i->id, NULL, texel);
        for (int k = 0; k < CHANNELS; k++) {
            const rhw_int number = rhw_int_from_float(texel[k] * (float)FULL + 0.5f);
            rhw_storage_store(w->bindings, 0, index_of(i->id[0], i->id[1], k), number, i->mask);
        }
    }
}

// Prefix sums: a workgroup for each line ---------------------------------------------------------------

struct direction {
    int32_t step, line; // words from one number of a line to the next, and from one line to the next
};

static void add_up(struct rhw_workgroup *w)
{
    const struct direction *const d = w->uniforms;
    const int32_t start = w->id[0] * d->line + w->id[1] * SIZE * SIZE;
    int32_t *const sums = w->shared;
    rhw_int before[GROUPS];
    for (int g = 0; g < w->count; g++) {
        const rhw_int at = start + w->groups[g].index * d->step;
        rhw_store_int(&sums[g * RHW_LANES], rhw_storage_load(w->bindings, 0, at, w->groups[g].mask));
    }
    for (int reach = 1; reach < SIZE; reach *= 2) {
        for (int g = 0; g < w->count; g++) {
            before[g] = rhw_gather_int(sums, SIZE, w->groups[g].index - reach); // 0 before the first
        }
        // A barrier: every invocation has read.
        for (int g = 0; g < w->count; g++) {
            rhw_store_int(&sums[g * RHW_LANES], rhw_load_int(&sums[g * RHW_LANES]) + before[g]);
        }
        // A barrier: every invocation has written.
    }
    for (int g = 0; g < w->count; g++) {
        const rhw_int at = start + w->groups[g].index * d->step;
        rhw_storage_store(w->bindings, 0, at, rhw_load_int(&sums[g * RHW_LANES]), w->groups[g].mask);
    }
}

// Add a line up as add_up does, in a function of one invocation. It returns true where it stands at a barrier, and is
// called again when all other invocations have come there.
static bool add_up1(struct rhw_invocation1 *i)
{
    const struct direction *const d = i->uniforms;
    const int32_t start = i->workgroup[0] * d->line + i->workgroup[1] * SIZE * SIZE;
    const uint32_t at = (uint32_t)(start + i->index * d->step);
    int32_t *const sums = i->shared, *const before = i->memory;
    const int reach = 1 << i->step / 2;
    if (i->step == 0) {
        sums[i->index] = rhw_storage_load1(i->bindings, 0, at);
    } else if (i->step % 2 == 1) { // every invocation has written
        *before = i->index >= reach ? sums[i->index - reach] : 0;
    } else { // every invocation has read
        sums[i->index] += *before;
    }
    if (i->step % 2 == 1 || reach < SIZE) {
        return true; // a barrier
    }
    rhw_storage_store1(i->bindings, 0, at, sums[i->index]);
    return false;
}

// Blur: four numbers of the table for any radius -------------------------------------------------------

struct lens {
    float least, aperture; // radius in pixels at the focus, and how it grows with 1 / focus − 1 / distance
};

static const struct lens lenses[2] = {{.least = 8}, {.aperture = 180}}; // one radius everywhere, and a lens

// Return the sum of all pixels up to and including x, y, or 0 beyond the upper or the left edge.
static rhw_int sum_up_to(const struct rhw_bindings *bindings, rhw_int x, rhw_int y, int channel)
{
    const rhw_int inside = ~rhw_less_int(x | y, rhw_splat_int(0));
    return rhw_storage_load(bindings, 0, index_of(x, y, channel), inside);
}

static void blur(struct rhw_workgroup *w)
{
    const struct lens *const lens = w->uniforms;
    const rhw_int last = rhw_splat_int(SIZE - 1), none = rhw_splat_int(-1);
    for (int g = 0; g < w->count; g++) {
        const struct rhw_invocations *const i = &w->groups[g];
        rhw_float distance[4], color[4];
        rhw_sample_fetch(w->bindings, 1, i->id, NULL, distance);
        const rhw_float unsharp = rhw_abs(1.0f / focus - 1.0f / distance[0]) * lens->aperture;
        const rhw_int radius = rhw_int_from_float(lens->least + rhw_min(unsharp, 30.0f));
        const rhw_int left = rhw_max_int(i->id[0] - radius - 1, none),
                      right = rhw_min_int(i->id[0] + radius, last),
                      top = rhw_max_int(i->id[1] - radius - 1, none),
                      bottom = rhw_min_int(i->id[1] + radius, last);
        const rhw_float pixels = rhw_float_from_int((right - left) * (bottom - top));
        for (int k = 0; k < CHANNELS; k++) {
            const rhw_int sum = sum_up_to(w->bindings, right, bottom, k) -
                                sum_up_to(w->bindings, left, bottom, k) -
                                sum_up_to(w->bindings, right, top, k) + sum_up_to(w->bindings, left, top, k);
            color[k] = rhw_float_from_int(sum) / pixels * (1.0f / (float)FULL);
        }
        color[3] = rhw_splat(1);
        rhw_image_store(w->bindings, 0, i->id, &i->mask, color);
    }
}

// Putting it together ----------------------------------------------------------------------------------

static rhw_sampler make_sampler(rhw_context *context)
{
    const struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST, .mag_filter = RHW_FILTER_NEAREST};
    rhw_sampler sampler;
    must(rhw_sampler_create(context, &def, &sampler), "sampler");
    return sampler;
}

// Return the table of sums of a picture, made by the function on 8 lanes or one at a time.
static rhw_buffer make_table(rhw_context *context, rhw_texture colors, rhw_sampler sampler, bool one)
{
    static const struct direction directions[2] = {{1, SIZE}, {SIZE, 1}};
    const struct rhw_buffer_def def = {.size = sizeof(int32_t) * CHANNELS * SIZE * SIZE, .label = "sums"};
    rhw_buffer sums;
    must(rhw_buffer_create(context, &def, &sums), "buffer");
    struct rhw_dispatch_def dispatch = {
        .program = {.workgroup = {to_numbers}, .size = {8, 8}, .label = "numbers"},
        .textures = {{colors, sampler}},
        .buffers = {{.buffer = sums}}};
    must(rhw_dispatch(context, &dispatch, SIZE / 8, SIZE / 8, 1), "dispatch");
    dispatch = (struct rhw_dispatch_def){.program = {.workgroup = {one ? NULL : add_up},
                                                     .invocation1 = add_up1,
                                                     .size = {SIZE},
                                                     .shared_size = SIZE * sizeof(int32_t),
                                                     .invocation_size = sizeof(int32_t),
                                                     .uniform_size = sizeof(struct direction),
                                                     .label = "prefix sums"},
                                         .uniform_bytes = sizeof *directions,
                                         .buffers = {{.buffer = sums}}};
    for (int i = 0; i < 2; i++) { // rows, then columns of sums of rows
        dispatch.uniforms = &directions[i];
        must(rhw_dispatch(context, &dispatch, SIZE, CHANNELS, 1), "dispatch");
    }
    return sums;
}

static rhw_texture make_blurred(rhw_context *context, rhw_buffer sums, rhw_texture distances,
                                rhw_sampler sampler, struct lens lens)
{
    const rhw_texture image = picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE, SIZE, 1);
    const struct rhw_dispatch_def dispatch = {
        .program = {.workgroup = {blur}, .size = {8, 8}, .uniform_size = sizeof lens, .label = "blur"},
        .uniforms = &lens,
        .uniform_bytes = sizeof lens,
        .textures = {[1] = {distances, sampler}},
        .buffers = {{.buffer = sums, .read_only = true}},
        .images = {{.texture = image}}};
    must(rhw_dispatch(context, &dispatch, SIZE / 8, SIZE / 8, 1), "dispatch");
    return image;
}

int main(int argc, char **argv)
{
    static uint8_t picture[SIZE][3 * SIZE][4];
    static int32_t table[CHANNELS][SIZE][SIZE], table1[CHANNELS][SIZE][SIZE];
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_sampler sampler = make_sampler(context);
    const rhw_texture colors = picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE, SIZE, 1),
                      distances = picture_target(context, RHW_FORMAT_R32_FLOAT, SIZE, SIZE, 1);
    draw(context, colors, distances);
    const rhw_buffer sums = make_table(context, colors, sampler, false),
                     sums1 = make_table(context, colors, sampler, true);
    for (int panel = 0; panel < 3; panel++) {
        const rhw_texture shown =
            panel == 0 ? colors : make_blurred(context, sums, distances, sampler, lenses[panel - 1]);
        uint8_t *const pixels = picture_read(context, shown, 0);
        for (int y = 0; y < SIZE; y++) {
            memcpy(picture[y][panel * SIZE], pixels + (size_t)y * SIZE * 4, SIZE * 4);
        }
        free(pixels);
    }
    picture_write_png(directory, "19_compute.png", 3 * SIZE, SIZE, picture[0][0]);

    must(rhw_buffer_read(context, sums, 0, table, sizeof table), "read");
    must(rhw_buffer_read(context, sums1, 0, table1, sizeof table1), "read");
    printf("one invocation at a time: %s\n",
           memcmp(table, table1, sizeof table) == 0 ? "the same table" : "another table");
    printf("red of the whole picture: %d, green %d, blue %d, of %d each\n", table[0][SIZE - 1][SIZE - 1],
           table[1][SIZE - 1][SIZE - 1], table[2][SIZE - 1][SIZE - 1], FULL * SIZE * SIZE);
    printf("a mean over 17 by 17 pixels adds 4 numbers of the table instead of 289\n");
    rhw_context_destroy(context);
    return 0;
}
