// SPDX-License-Identifier: MIT
// A wall of cards, each with a picture of its own, in one draw: the pictures are bindings in an array of the program.
// Prints a number made of the picture.
#include <stdio.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture_hash.h"

enum { COLUMNS = 12, ROWS = 8, CARDS = COLUMNS * ROWS, TEXELS = 4, WIDTH = 480, HEIGHT = 320 };

struct wall {
    const struct rhw_binding *cards; // CARDS of them
};

// A corner of a card: two triangles of six vertices without a buffer.
static void place(struct rhw_vertex1 *v)
{
    const int corner = v->vertex_index % 6;
    const float right = corner == 1 || corner == 2 || corner == 4 ? 1.0f : 0.0f;
    const float top = corner == 2 || corner == 4 || corner == 5 ? 1.0f : 0.0f;
    const float x = (float)(v->instance_index % COLUMNS) + 0.1f + 0.8f * right;
    const float y = (float)(v->instance_index / COLUMNS) + 0.1f + 0.8f * top;
    v->position[0] = 2 * x / COLUMNS - 1;
    v->position[1] = 2 * y / ROWS - 1;
    v->position[2] = 0;
    v->position[3] = 1;
    v->varying[0] = right;
    v->varying[1] = 1 - top;
}

static void paint(struct rhw_fragment1 *f)
{
    const struct wall *const wall = f->uniforms;
    rhw_binding_sample_lod1(&wall->cards[f->instance], f->varying, 0, f->color[0]);
}

static enum rhw_result make_pipeline(rhw_context *context, rhw_pipeline *pipeline)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = place,
                    .fragment1 = paint,
                    .uses = RHW_USE_IDS,
                    .varyings = {{.components = 2}},
                    .varying_count = 1,
                    .uniform_size = sizeof(struct wall)},
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
        .target_count = 1,
    };
    return rhw_pipeline_create(context, &def, pipeline);
}

// Make the picture of a card, and the binding of it.
static enum rhw_result make_card(rhw_context *context, int number, rhw_sampler sampler,
                                 struct rhw_binding *card)
{
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_SRGB, .width = TEXELS, .height = TEXELS};
    unsigned char texels[TEXELS][TEXELS][4];
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        unsigned char *const texel = texels[i / TEXELS][i % TEXELS];
        const bool is_light = (number >> i % 7 & 1) != 0;
        texel[0] = (unsigned char)(is_light ? 255 : 2 * number);
        texel[1] = (unsigned char)(is_light ? 240 : 60);
        texel[2] = (unsigned char)(is_light ? 200 : 255 - 2 * number);
        texel[3] = 255;
    }
    rhw_texture texture;
    const enum rhw_result result = rhw_texture_create(context, &def, &texture);
    if (result != RHW_OK) {
        return result;
    }
    rhw_texture_write(context, texture, 0, texels, 0);
    return rhw_binding_of_texture(context, texture, sampler, card); // the texture stays as long as the card
}

static enum rhw_result draw(rhw_context *context, rhw_pipeline pipeline, rhw_texture picture,
                            const struct wall *wall)
{
    struct rhw_pass_def def = {.color_count = 1};
    def.colors[0].texture = picture;
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_uniforms(context, pass, wall, sizeof *wall);
    rhw_pass_draw(context, pass, 0, 6, 0, CARDS);
    return rhw_pass_end(context, pass, NULL);
}

int main(void)
{
    const struct rhw_context_def def = {0};
    const struct rhw_texture_def picture_def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = WIDTH, .height = HEIGHT};
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST};
    struct rhw_binding cards[CARDS];
    const struct wall wall = {cards};
    rhw_context *context;
    rhw_pipeline pipeline;
    rhw_texture picture;
    rhw_sampler sampler;
    bool good = rhw_context_create(&def, &context) == RHW_OK &&
                rhw_texture_create(context, &picture_def, &picture) == RHW_OK &&
                rhw_sampler_create(context, &nearest, &sampler) == RHW_OK &&
                make_pipeline(context, &pipeline) == RHW_OK;
    for (int i = 0; i < CARDS && good; i++) {
        good = make_card(context, i, sampler, &cards[i]) == RHW_OK;
    }
    good = good && draw(context, pipeline, picture, &wall) == RHW_OK;
    if (good) {
        printf("%016llx\n", (unsigned long long)hash_picture(context, picture));
    }
    rhw_context_destroy(context); // NULL where it could not be created
    return good ? 0 : 1;
}
