// SPDX-License-Identifier: MIT
// Lesson 11: a texture seen at a low angle, and what a sampler can do about it.
//
// Far away a pixel sees a long and narrow piece of the floor. A mip level has one size of texel in every direction:
//
//     off      the level is chosen by the long side: narrow tiles blur away before they are small
//     4, 16    the level is chosen by the short side, and up to so many samples are taken along the long one
//
// (Vulkan 1.3, "Texel Anisotropic Filtering".) The more there are, the nearer to the mean of what the pixel sees.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { WIDTH = 300, HEIGHT = 220, PANELS = 3, TEXELS = 64, JOINT = 5 };

static const float anisotropy[PANELS] = {1, 4, 16};
static const float sky[4] = {0.55f, 0.68f, 0.85f, 1};
static const float zoom = 1.1f, tilt = 0.68f,
                   height = 1.0f; // of the eye, which looks ahead and a little down

// Where a pixel of the panel sees the floor: x to the right, z ahead. False above the horizon.
static bool find_floor(double column, double row, double at[2])
{
    const double x = (2 * column / WIDTH - 1) / (double)zoom * WIDTH / HEIGHT,
                 y = (1 - 2 * row / HEIGHT) / (double)zoom;
    const double down = (double)tilt - y; // for a step of 1 ahead, but for the tilt of the picture
    at[0] = down > 0 ? x / down * (double)height : 0;
    at[1] = down > 0 ? (double)height / down : 0;
    return down > 0;
}

// Tiles of two colours with joints between them; two tiles each way make the texture.
static void find_color(double u, double v, float color[3])
{
    static const float colors[3][3] = {{0.62f, 0.30f, 0.16f}, {0.80f, 0.70f, 0.52f}, {0.05f, 0.05f, 0.06f}};
    const double x = u * 2 - floor(u * 2), y = v * 2 - floor(v * 2), joint = 2.0 * JOINT / TEXELS;
    const int other = ((int)floor(u * 2) + (int)floor(v * 2)) & 1;
    memcpy(color, colors[x < joint || y < joint ? 2 : other], sizeof colors[0]);
}

static rhw_texture make_tiles(rhw_context *context)
{
    static float texels[TEXELS][TEXELS][4];
    for (int y = 0; y < TEXELS; y++) {
        for (int x = 0; x < TEXELS; x++) {
            find_color((x + 0.5) / TEXELS, (y + 0.5) / TEXELS, texels[y][x]);
            texels[y][x][3] = 1;
        }
    }
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA32_FLOAT,
                                        .width = TEXELS,
                                        .height = TEXELS,
                                        .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), "texture");
    must(rhw_texture_write(context, texture, 0, texels, 0), "texture");
    must(rhw_texture_generate_mips(context, texture), "mips");
    return texture;
}

// A large quad of the floor; W is the distance ahead.
static void place(struct rhw_vertex *groups, int count)
{
    static const float corners[6][2] = {{-400, 0.3f}, {400, 0.3f}, {-400, 400},
                                        {-400, 400},  {400, 0.3f}, {400, 400}};
    for (int i = 0; i < count; i++) {
        const rhw_float x = rhw_gather(corners[0], 12, groups[i].vertex_index * 2),
                        z = rhw_gather(corners[0], 12, groups[i].vertex_index * 2 + 1);
        groups[i].position[0] = x * (zoom * HEIGHT / WIDTH);
        groups[i].position[1] = (z * tilt - height) * zoom;
        groups[i].position[2] = rhw_splat(0);
        groups[i].position[3] = z;
        groups[i].varying[0] = x;
        groups[i].varying[1] = z;
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_float gradient[4] = {groups[i].ddx[0], groups[i].ddx[1], groups[i].ddy[0],
                                       groups[i].ddy[1]};
        rhw_sample_grad(groups[i].bindings, 0, groups[i].varying, gradient, groups[i].color[0]);
    }
}

// The panels side by side in a target of PANELS · WIDTH × HEIGHT pixels.
static void draw(rhw_context *context, rhw_texture target)
{
    const struct rhw_pipeline_def def = {.program = {.vertex = {place},
                                                     .fragment = {paint},
                                                     .varyings = {{.components = 2, .derivatives = true}},
                                                     .varying_count = 1},
                                         .targets = {{.format = rhw_texture_format(context, target)}},
                                         .target_count = 1,
                                         .label = "lesson 11"};
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    const rhw_texture tiles = make_tiles(context);
    struct rhw_pass_def attachments = {.colors = {{.texture = target}}, .color_count = 1, .label = "floors"};
    memcpy(attachments.colors[0].clear, sky, sizeof sky);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_sampler samplers[PANELS];
    for (int i = 0; i < PANELS; i++) {
        const struct rhw_viewport panel = {(float)(i * WIDTH), 0, WIDTH, HEIGHT, 0, 1};
        const struct rhw_rect inside = {i * WIDTH, 0, WIDTH, HEIGHT};
        must(rhw_sampler_create(context, &(struct rhw_sampler_def){.max_anisotropy = anisotropy[i]},
                                &samplers[i]),
             "sampler");
        rhw_pass_set_viewport(context, pass, &panel);
        rhw_pass_set_scissor(context, pass, &inside);
        rhw_pass_set_texture(context, pass, 0, tiles, samplers[i]);
        rhw_pass_draw(context, pass, 0, 6, 0, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    for (int i = 0; i < PANELS; i++) {
        rhw_sampler_destroy(context, samplers[i]);
    }
    rhw_texture_destroy(context, tiles);
    rhw_pipeline_destroy(context, pipeline);
}

// The mean of the floor's red over a pixel, by 24 × 24 points. False where the pixel sees something else too.
static bool find_mean(int column, int row, double *mean)
{
    enum { STEPS = 24 };
    *mean = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double at[2];
        float color[3];
        if (!find_floor(column + (i % STEPS + 0.5) / STEPS, row + (i / STEPS + 0.5) / STEPS, at)) {
            return false;
        }
        find_color(at[0], at[1], color);
        *mean += (double)color[0] / (STEPS * STEPS);
    }
    return true;
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture = picture_target(context, RHW_FORMAT_RGBA8_SRGB, PANELS * WIDTH, HEIGHT, 1);
    draw(context, picture);
    picture_save(context, picture, 0, directory, "11_anisotropy.png");

    static float values[HEIGHT][PANELS * WIDTH][4];
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANELS * WIDTH, HEIGHT, 1);
    draw(context, plain);
    must(rhw_texture_read(context, plain, 0, values, 0), "read");
    printf("from the mean of what a pixel sees, 4 to 24 units ahead:\n");
    for (int i = 0; i < PANELS; i++) {
        double squares = 0;
        int count = 0;
        for (int p = 0; p < WIDTH * HEIGHT; p++) {
            double at[2], mean;
            if (find_floor(p % WIDTH + 0.5, p / WIDTH + 0.5, at) && at[1] > 4 && at[1] < 24 &&
                find_mean(p % WIDTH, p / WIDTH, &mean)) {
                const double error = (double)values[p / WIDTH][i * WIDTH + p % WIDTH][0] - mean;
                squares += error * error;
                count++;
            }
        }
        printf("  max_anisotropy %2.0f: %.4f (root mean square)\n", (double)anisotropy[i],
               sqrt(squares / count));
    }
    rhw_context_destroy(context);
    return 0;
}
