// SPDX-License-Identifier: MIT
// Lesson 8: shaders on 8 lanes that do more than arithmetic, and the derivatives of what they compute.
//
// A floor is paved with tiles around a Julia set: every point z of it goes z ← z² + c until it is far away, and the
// angle and size it leaves with say where in a texture it stands. Tiles halve from ring to ring towards the set, so a
// pixel soon covers many of them, and the texture must be sampled with the gradient of what was computed:
//
//     left     the gradient of the floor, as if the texture lay on it: noise where tiles are small, blurred joints where
//              they are large
//     right    the gradient of the coordinates themselves: every operation is done on duals, a value with its change
//              per pixel, by the rules (a b)' = a' b + a b' and so on through the loop. The same changes tell how many
//              pixels away the set is, |z| ln |z| / |z'|, and its edge is as soft as a pixel is wide
//
// The shaders stand in julia_shaders.c, which is compiled once per instruction set.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>

#include "julia.h"
#include "picture.h"

enum { PANEL = 400, SAMPLES = 4, SAMPLE_LEVELS = 3, TILE = 64 };

static const struct julia julia = {
    // From (0, 1.75, 2.1) towards (0, 0, 0), 60 degrees wide; near 0.1, far 100.
    .clip = {1.73205f, 0, 0, 0, 0, 1.3306f, -0.640825f, -0.640184f, 0, -1.10883f, -0.76899f, -0.768221f, 0, 0,
             2.63622f, 2.73359f},
    .c = {-0.123f, 0.745f},
    .escape = 480,
    .steps = 60,
    .sky = {0.90f, 0.88f, 0.82f},
    .palette = {{0.90f, 0.83f, 0.66f},
                {0.88f, 0.70f, 0.42f},
                {0.80f, 0.45f, 0.20f},
                {0.65f, 0.22f, 0.13f},
                {0.36f, 0.12f, 0.20f},
                {0.12f, 0.15f, 0.34f},
                {0.05f, 0.30f, 0.46f},
                {0.10f, 0.50f, 0.55f},
                {0.30f, 0.65f, 0.58f},
                {0.62f, 0.80f, 0.66f},
                {0.85f, 0.90f, 0.78f},
                {0.95f, 0.95f, 0.90f}},
};

// x, y on the floor, and how far it has faded there.
static const float corners[4][3] = {{-4, 2.0f, 0}, {4, 2.0f, 0}, {-4, -6, 1}, {4, -6, 1}};

// A glazed tile: light from the top left, dark joints.
static rhw_texture make_tile(rhw_context *context)
{
    static uint8_t texels[TILE][TILE][4];
    for (int y = 0; y < TILE; y++) {
        for (int x = 0; x < TILE; x++) {
            const float u = (float)(2 * x + 1) / TILE - 1, v = (float)(2 * y + 1) / TILE - 1;
            const float edge = 1 - fmaxf(fabsf(u), fabsf(v));
            const float light =
                0.80f - 0.12f * (u + v) + (edge < 0.2f ? -0.15f * (fabsf(u) > fabsf(v) ? u : v) : 0);
            const float value = edge < 0.06f ? 0.16f : light;
            for (int c = 0; c < 4; c++) {
                texels[y][x][c] = c == 3 ? 255 : (uint8_t)(255 * fminf(value, 1) + 0.5f);
            }
        }
    }
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = TILE, .height = TILE, .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), "texture");
    rhw_texture_write(context, texture, 0, texels, 0);
    must(rhw_texture_generate_mips(context, texture), "mip levels");
    return texture;
}

static rhw_pipeline make_pipeline(rhw_context *context, bool numbers, enum rhw_format format)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){
        .vertex = RHW_ISA_TABLE(julia_vertex),
        .fragment = RHW_ISA_TABLE(julia_fragment),
        .varyings = {RHW_VARYING(struct floor_point, at, RHW_SMOOTH, true),
                     RHW_VARYING(struct floor_point, far, RHW_SMOOTH, false)},
        .varying_count = 2,
        .uniform_size = sizeof(struct julia),
    };
    if (numbers) {
        rhw_fragment_function *const functions[RHW_ISA_COUNT] = RHW_ISA_TABLE(julia_numbers);
        memcpy(def.program.fragment, functions, sizeof functions);
    }
    def.attributes[0].format = RHW_VERTEX_FLOAT3;
    def.attribute_count = 1;
    def.buffer_count = 1;
    def.topology = RHW_TRIANGLE_STRIP;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// One panel that fills the target.
static void draw(rhw_context *context, rhw_texture target, bool duals, bool numbers)
{
    struct julia uniforms = julia;
    uniforms.duals = duals;
    struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    rhw_sampler sampler;
    must(rhw_sampler_create(context, &sampler_def, &sampler), "sampler");
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = target;
    memcpy(attachments.colors[0].clear, julia.sky, sizeof julia.sky);
    const rhw_pipeline pipeline = make_pipeline(context, numbers, rhw_texture_format(context, target));
    const rhw_buffer floor = picture_vertices(context, corners, sizeof corners);
    const rhw_texture tile = make_tile(context);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, floor, 0);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_set_texture(context, pass, 0, tile, sampler);
    rhw_pass_draw(context, pass, 0, 4, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
}

// The panel with one sample per pixel, or with SAMPLES × SAMPLES averaged, as linear values.
static void draw_values(rhw_context *context, bool duals, bool averaged, float values[PANEL][PANEL][4])
{
    const int scale = averaged ? SAMPLES : 1, levels = averaged ? SAMPLE_LEVELS : 1;
    const rhw_texture target =
        picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANEL * scale, PANEL * scale, levels);
    draw(context, target, duals, false);
    must(rhw_texture_generate_mips(context, target), "average");
    rhw_texture_read(context, target, levels - 1, values, 0);
    rhw_texture_destroy(context, target);
}

// The root of the mean square of what two pictures differ by.
static double difference(float (*a)[PANEL][4], float (*b)[PANEL][4])
{
    double sum = 0;
    for (int i = 0; i < PANEL * PANEL; i++) {
        for (int c = 0; c < 3; c++) {
            const double d = (double)a[i / PANEL][i % PANEL][c] - (double)b[i / PANEL][i % PANEL][c];
            sum += d * d;
        }
    }
    return sqrt(sum / (3 * PANEL * PANEL));
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    static uint8_t both[PANEL][2 * PANEL][4];
    for (int panel = 0; panel < 2; panel++) {
        const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA8_SRGB, PANEL, PANEL, 1);
        draw(context, target, panel == 1, false);
        static uint8_t pixels[PANEL][PANEL][4];
        rhw_texture_read(context, target, 0, pixels, 0);
        for (int y = 0; y < PANEL; y++) {
            memcpy(both[y][panel * PANEL], pixels[y], sizeof pixels[y]);
        }
    }
    picture_write_png(directory, "08_julia.png", 2 * PANEL, PANEL, &both[0][0][0]);

    static float truth[PANEL][PANEL][4], drawn[PANEL][PANEL][4];
    draw_values(context, true, true, truth);
    printf("distance from %d samples per pixel\n", SAMPLES * SAMPLES);
    for (int panel = 0; panel < 2; panel++) {
        draw_values(context, panel == 1, false, drawn);
        printf("  %-28s %.4f\n", panel == 1 ? "gradient by duals" : "gradient of the floor",
               difference(drawn, truth));
    }
    rhw_context_destroy(context);
    return 0;
}
