// SPDX-License-Identifier: MIT
// Lesson 17: a picture of numbers. Beside the colours a target of integers takes what each pixel belongs to, bit for bit:
// no blending, no filter, no rounding. It answers which thing lies under the pointer, and where a thing's outline is;
// it is what training data is made of.
//
// Left the colours, with an outline around one thing; right the numbers, each in a colour of its own.
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { SIZE = 400, SIDE = 4, THINGS = SIDE * SIDE * SIDE, CHOSEN = 43 };
static const uint32_t nothing = 0xffffffff, first_number = 0x12340000; // far beyond what a float can count

static const float eye[3] = {4.6f, 3.9f, 6.0f}, target_point[3] = {0, 0, 0}, zoom = 2.5f;
static const float paper[4] = {0.93f, 0.93f, 0.91f, 1}, sun[3] = {0.36f, 0.80f, 0.48f};

struct uniforms {
    float camera[16];
};

struct place {
    float center[3];
    uint32_t number;
};

// Balls in a cube, all in one draw: each instance has its place and its number.
static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        rhw_float world[3];
        for (int k = 0; k < 3; k++) {
            world[k] = groups[i].attribute[0][k] * 0.42f + groups[i].attribute[2][k];
            groups[i].varying[k] = groups[i].attribute[1][k];
        }
        groups[i].varying[3] = groups[i].attribute[3][0]; // an integer arrives as bits, and flat it stays so
        rhw_mat4_mul_point(u->camera, world, groups[i].position);
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        rhw_float normal[3];
        rhw_normalize3(groups[i].varying, normal);
        const rhw_float direct = rhw_max(normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2], 0.0f);
        const rhw_int number = rhw_bits_from_float(groups[i].varying[3]);
        for (int k = 0; k < 3; k++) {
            const rhw_float along =
                rhw_float_from_int((number >> (2 * k)) & 3); // its place along an axis: 0..3
            groups[i].color[0][k] = (0.10f + 0.25f * along) * (0.25f + 0.75f * direct);
        }
        groups[i].color[0][3] = rhw_splat(1);
        groups[i].color[1][0] = groups[i].varying[3];
    }
}

static void draw(rhw_context *context, rhw_texture colors, rhw_texture numbers)
{
    struct place places[THINGS];
    for (int i = 0; i < THINGS; i++) {
        for (int k = 0; k < 3; k++) {
            places[i].center[k] = (float)(i >> (2 * k) & 3) - 1.5f;
        }
        places[i].number = first_number + (uint32_t)i;
    }
    struct rhw_pipeline_def def = solid_pipeline_def();
    def.program =
        (struct rhw_program){.vertex = {place},
                             .fragment = {paint},
                             .varyings = {{.components = 3}, {.components = 1, .qualifier = RHW_FLAT}},
                             .varying_count = 2,
                             .uniform_size = sizeof(struct uniforms)};
    def.attributes[2] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 1, offsetof(struct place, center)};
    def.attributes[3] = (struct rhw_attribute){RHW_VERTEX_UINT32X1, 1, offsetof(struct place, number)};
    def.attribute_count = 4;
    def.buffers[1].per_instance = true;
    def.buffer_count = 2;
    def.cull = RHW_CULL_BACK;
    def.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
    def.targets[1].format = RHW_FORMAT_R32_UINT;
    def.target_count = 2;
    def.label = "lesson 17";
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    struct rhw_pass_def attachments = {
        .colors = {{.texture = colors}, {.texture = numbers, .clear_integer = {(int32_t)nothing}}},
        .color_count = 2,
        .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
        .label = "colours and numbers"};
    memcpy(attachments.colors[0].clear, paper, sizeof paper);
    struct uniforms uniforms;
    solid_camera(eye, target_point, zoom, uniforms.camera);
    const rhw_buffer vertices = solid_buffer(context),
                     instances = picture_vertices(context, places, sizeof places);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    rhw_pass_set_vertex_buffer(context, pass, 1, instances, 0);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    solid_draw(context, pass, SOLID_BALL, THINGS);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, vertices);
    rhw_buffer_destroy(context, instances);
    rhw_pipeline_destroy(context, pipeline);
}

static uint32_t number_at(const uint32_t *numbers, int x, int y)
{
    return x >= 0 && x < SIZE && y >= 0 && y < SIZE ? numbers[y * SIZE + x] : nothing;
}

// Whether a pixel beside the thing, or of it, is within two pixels of its edge.
static bool is_outline(const uint32_t *numbers, int x, int y, uint32_t number)
{
    int of_it = 0;
    for (int i = 0; i < 25; i++) {
        of_it += number_at(numbers, x + i % 5 - 2, y + i / 5 - 2) == number;
    }
    return of_it > 0 && of_it < 25;
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture colors = picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE, SIZE, 1),
                      ids = picture_target(context, RHW_FORMAT_R32_UINT, SIZE, SIZE, 1);
    draw(context, colors, ids);
    static uint8_t seen[SIZE * SIZE][4], picture[SIZE][2 * SIZE][4];
    static uint32_t numbers[SIZE * SIZE];
    must(rhw_texture_read(context, colors, 0, seen, 0), "read");
    must(rhw_texture_read(context, ids, 0, numbers, 0), "read");
    for (int p = 0; p < SIZE * SIZE; p++) {
        const int x = p % SIZE, y = p / SIZE;
        const uint32_t hash = numbers[p] == nothing ? 0 : (numbers[p] - first_number + 1) * 2654435761u;
        const bool chosen = is_outline(numbers, x, y, first_number + CHOSEN);
        for (int k = 0; k < 3; k++) {
            static const uint8_t outline[3] = {255, 30, 30};
            picture[y][x][k] = chosen ? outline[k] : seen[p][k];
            picture[y][SIZE + x][k] = (uint8_t)(hash >> (8 * k + 8));
        }
    }
    picture_write_png(directory, "17_ids.png", 2 * SIZE, SIZE, picture[0][0]);

    static const int pointers[4][2] = {{200, 100}, {150, 250}, {280, 210}, {10, 10}};
    for (int i = 0; i < 4; i++) {
        const uint32_t number = number_at(numbers, pointers[i][0], pointers[i][1]);
        printf("at pixel %d, %d: ", pointers[i][0], pointers[i][1]);
        if (number == nothing) {
            printf("nothing\n");
        } else {
            printf("0x%08x, ball %d of %d\n", (unsigned)number, (int)(number - first_number), THINGS);
        }
    }
    rhw_context_destroy(context);
    return 0;
}
