// SPDX-License-Identifier: MIT
// 100,000 particles, each an instance of a quad that faces the camera, drawn twice: solid with a depth test, where a
// second target of 32-bit integers takes the id of the particle seen; and added up without one. Colours are multiples
// of 1/256, so what floats add up to is exact. All is compared with rectangles worked out one particle at a time.
#include "particles.h"
#include "matrix.h"
#include "outside.h"

enum { WIDTH = 640, HEIGHT = 480, PARTICLES = 100000 };

struct particle {
    float center[3], half;
    uint8_t color[4];
    uint32_t id;
};

// What a pixel is to hold.
struct expected {
    float depth;
    uint32_t id, sum[3], layers;
    bool doubtful; // an edge passes so close to its centre that rounding decides
};

// 0 ≤ result < 1, a multiple of 1/65536.
static float any(uint32_t *state)
{
    *state = *state * 1664525 + 1013904223;
    return (float)(*state >> 16) / 65536;
}

// A disc with three arms, and one particle by itself half way to the eye.
static void make_particles(struct particle *particles)
{
    static const float inner[3] = {255, 210, 150}, outer[3] = {70, 120, 255};
    const float turn = 6.28318531f;
    uint32_t state = 1;
    for (int i = 0; i < PARTICLES; i++) {
        struct particle *p = &particles[i];
        const float part = any(&state), radius = 2.6f * part, spread = any(&state) * any(&state);
        const float angle = turn * ((float)(i % 3) / 3 + 0.5f * part + 0.25f * spread);
        const float thick = 0.3f * (1 - part) * (1 - part) + 0.04f;
        float sine, cosine;
        rhw_sincos1(angle, &sine, &cosine);
        p->center[0] = radius * cosine;
        p->center[1] = thick * (any(&state) + any(&state) + any(&state) - 1.5f);
        p->center[2] = radius * sine;
        const float light = 0.4f + 0.6f * any(&state), large = any(&state) * any(&state);
        p->half = 0.006f + 0.014f * large;
        for (int c = 0; c < 3; c++) {
            p->color[c] = (uint8_t)(light * rhw_mix1(inner[c], outer[c], part));
        }
        p->id = (uint32_t)(i + 1) * 2654435761u; // all differ, none is 0, and all 32 bits are used
    }
    particles[0] = (struct particle){{0, 1.8f, 2.4f}, 0.05f, {255, 40, 20, 0}, particles[0].id};
}

// From (0, 3, 4) to the middle, 5 away; half the height of the picture is half its distance.
static void make_lens(struct lens *lens)
{
    static const float eye[3] = {0, 3, 4}, middle[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    float look[16], projection[16];
    matrix_look_at(eye, middle, up, look);
    matrix_perspective(2 * rhw_atan1(0.5f), (float)WIDTH / HEIGHT, 1, 20, projection);
    matrix_mul(projection, look, lens->camera);
    lens->scale[0] = projection[0];
    lens->scale[1] = projection[5];
    lens->glow = 0.15f;
}

static rhw_pipeline make_pipeline(rhw_context *context, bool solid)
{
    struct rhw_pipeline_def def = {
        .program = {.vertex = RHW_ISA_TABLE(particles_face),
                    .fragment = RHW_ISA_TABLE(particles_solid),
                    .varyings = {RHW_VARYING(struct spark, color, RHW_FLAT, false),
                                 RHW_VARYING(struct spark, id, RHW_FLAT, false)},
                    .varying_count = 2,
                    .uniform_size = sizeof(struct lens)},
        .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct particle, center)},
                       {RHW_VERTEX_FLOAT1, 0, offsetof(struct particle, half)},
                       {RHW_VERTEX_USCALED8X3, 0, offsetof(struct particle, color)},
                       {RHW_VERTEX_FLOAT1, 0, offsetof(struct particle, id)}}, // its bits pass unchanged
        .attribute_count = 4,
        .buffers = {{.stride = sizeof(struct particle), .per_instance = true}},
        .buffer_count = 1,
        .topology = RHW_TRIANGLE_STRIP,
        .depth_test = true,
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}, {.format = RHW_FORMAT_R32_UINT}},
        .target_count = 2,
        .label = "solid",
    };
    if (!solid) {
        const struct rhw_blend_component add = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
        const enum rhw_format formats[2] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA32_FLOAT};
        def.label = "glow";
        def.program = (struct rhw_program){.vertex = RHW_ISA_TABLE(particles_face),
                                           .fragment = RHW_ISA_TABLE(particles_glow),
                                           .varyings = {RHW_VARYING(struct spark, color, RHW_FLAT, false),
                                                        RHW_VARYING(struct spark, id, RHW_FLAT, false)},
                                           .varying_count = 2,
                                           .uniform_size = sizeof(struct lens)};
        def.depth_test = false;
        for (int i = 0; i < 2; i++) {
            def.targets[i] =
                (struct rhw_color_target){.format = formats[i], .blend = true, .color = add, .alpha = add};
        }
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), def.label);
    return pipeline;
}

static rhw_texture make_texture(rhw_context *context, enum rhw_format format, const char *label)
{
    const struct rhw_texture_def def = {.format = format, .width = WIDTH, .height = HEIGHT, .label = label};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), label);
    return texture;
}

static void draw(struct outside *outside, rhw_context *context, const struct lens *lens, bool solid,
                 rhw_buffer particles, rhw_texture picture, rhw_texture second)
{
    const struct rhw_pass_def def = {
        .colors = {{.texture = picture}, {.texture = second}},
        .color_count = 2,
        .depth = {.enabled = solid, .store = RHW_STORE_DISCARD},
        .label = solid ? "solid" : "glow",
    };
    rhw_pass pass;
    struct rhw_stats stats;
    must(rhw_pass_begin(context, &def, &pass), def.label);
    rhw_pass_set_pipeline(context, pass, make_pipeline(context, solid));
    rhw_pass_set_vertex_buffer(context, pass, 0, particles, 0);
    rhw_pass_set_uniforms(context, pass, lens, sizeof *lens);
    rhw_pass_draw(context, pass, 0, 4, 0, PARTICLES);
    must(rhw_pass_end(context, pass, &stats), def.label);
    check(outside, stats.draws == 1 && stats.triangles_in == 2 * PARTICLES, "two triangles for a particle");
}

// Paints the rectangle of one particle. Corners are snapped to 1/256 of a pixel, so an edge is sure but for 1/128.
static void expect(const struct lens *lens, const struct particle *p, struct expected *pixels)
{
    float landed[3], clip[4];
    matrix_land(lens->camera, p->center, WIDTH, HEIGHT, landed);
    rhw_mat4_mul_point1(lens->camera, p->center, clip);
    const float right = p->half * lens->scale[0] / clip[3] * WIDTH / 2;
    const float down = p->half * lens->scale[1] / clip[3] * HEIGHT / 2;
    for (int y = (int)(landed[1] - down) - 1; y <= (int)(landed[1] + down) + 1; y++) {
        for (int x = (int)(landed[0] - right) - 1; x <= (int)(landed[0] + right) + 1; x++) {
            const float outside = rhw_max1(rhw_abs1((float)x + 0.5f - landed[0]) - right,
                                           rhw_abs1((float)y + 0.5f - landed[1]) - down);
            if (x < 0 || x >= WIDTH || y < 0 || y >= HEIGHT || outside > 1.0f / 128) {
                continue;
            }
            struct expected *pixel = &pixels[y * WIDTH + x];
            pixel->doubtful |= outside > -1.0f / 128;
            pixel->layers++;
            for (int c = 0; c < 3; c++) {
                pixel->sum[c] += p->color[c];
            }
            if (landed[2] < pixel->depth || pixel->id == 0) {
                pixel->depth = landed[2];
                pixel->id = p->id;
            }
        }
    }
}

// Compares all pixels that no edge makes doubtful, and those of the particle by itself once more.
static void compare(struct outside *outside, uint32_t first, const struct expected *expected,
                    const uint32_t *ids, float (*sums)[4])
{
    int sure = 0, ids_wrong = 0, sums_wrong = 0, alone = 0, alone_inside = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const struct expected *e = &expected[i];
        const int x = i % WIDTH, y = i / WIDTH;
        // 2 away and 0.05 of half size: 0.05 / (2 · 0.5) · 480 / 2 = 12 pixels each way from the middle.
        alone += ids[i] == first;
        alone_inside += ids[i] == first && x >= 308 && x < 332 && y >= 228 && y < 252;
        if (!e->doubtful) {
            sure++;
            ids_wrong += ids[i] != e->id;
            sums_wrong += sums[i][3] != (float)e->layers;
            for (int c = 0; c < 3; c++) {
                sums_wrong += sums[i][c] != (float)e->sum[c] / 256;
            }
        }
    }
    check(outside, alone == 24 * 24 && alone_inside == alone, "the particle by itself fills 24 × 24 pixels");
    check(outside, sure > WIDTH * HEIGHT / 2, "most pixels are beyond doubt");
    check(outside, ids_wrong == 0, "the id of the nearest particle");
    check(outside, sums_wrong == 0, "the sum of all particles, and their number");
}

int main(int argc, char **argv)
{
    struct outside outside = outside_options(argc, argv);
    rhw_context *context;
    must(rhw_context_create(&outside.context_def, &context), "context");
    static struct particle particles[PARTICLES];
    struct lens lens;
    make_particles(particles);
    make_lens(&lens);
    const struct rhw_buffer_def def = {.size = sizeof particles, .data = particles, .label = "particles"};
    rhw_buffer buffer;
    must(rhw_buffer_create(context, &def, &buffer), def.label);
    const rhw_texture solid = make_texture(context, RHW_FORMAT_RGBA8_SRGB, "solid");
    const rhw_texture id = make_texture(context, RHW_FORMAT_R32_UINT, "id");
    const rhw_texture glow = make_texture(context, RHW_FORMAT_RGBA8_SRGB, "glow");
    const rhw_texture sum = make_texture(context, RHW_FORMAT_RGBA32_FLOAT, "sum");
    draw(&outside, context, &lens, true, buffer, solid, id);
    draw(&outside, context, &lens, false, buffer, glow, sum);
    free(outside_show(&outside, context, "particles", solid));
    uint32_t *ids = outside_show(&outside, context, "particles.id", id);
    free(outside_show(&outside, context, "particles.glow", glow));
    float(*sums)[4] = outside_show(&outside, context, "particles.sum", sum);

    static struct expected expected[WIDTH * HEIGHT];
    for (int i = 0; i < PARTICLES; i++) {
        expect(&lens, &particles[i], expected);
    }
    compare(&outside, particles[0].id, expected, ids, sums);

    free(ids);
    free(sums);
    rhw_context_destroy(context);
    return outside.failures != 0;
}
