// SPDX-License-Identifier: MIT
// Lesson 9: a shadow map, and a sampler that compares.
//
// What the light sees is drawn first, depth alone. A point then lies in shadow where it is farther from the light than
// the map says. The map has few texels, so how it is sampled decides how shadows look:
//
//     one texel         the comparison of the nearest one: 0 or 1, in blocks
//     one footprint     compares four texels and mixes what that gives: not the depth of four texels, which is none
//     3 × 3 footprints  their mean: percentage-closer filtering
//
// (W. Reeves, D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987.)
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { PANEL = 300, SCALE = 4, SCALE_LEVELS = 3, MAP = 128, SPHERES = 4 };

static const struct sphere {
    float center[3], radius, color[3];
} spheres[SPHERES] = {
    {{-0.95f, 0.70f, -0.2f}, 0.70f, {0.80f, 0.13f, 0.06f}},
    {{0.55f, 0.45f, 0.75f}, 0.45f, {0.85f, 0.55f, 0.05f}},
    {{0.75f, 0.95f, -1.1f}, 0.95f, {0.05f, 0.25f, 0.45f}},
    {{-0.25f, 0.25f, 1.25f}, 0.25f, {0.30f, 0.40f, 0.10f}},
};

static const float floor_color[3] = {0.55f, 0.52f, 0.48f}, sky[4] = {0.80f, 0.85f, 0.92f, 1};

// Towards the light, and two directions across; all of length 1.
static const float sun[3] = {0.72f, 0.6f, 0.3487119f}, across[3] = {0.4358899f, 0, -0.9f},
                   along[3] = {-0.54f, 0.8f, -0.2615339f};
static const float map_radius = 3.2f; // the light looks at this much of the ground around the origin

struct uniforms {
    float camera[16], light[16]; // world to clip coordinates
    float center[3], radius;     // of what is drawn
    float color[3];
    float wide; // 1: 3 × 3 footprints
};

struct surface {
    rhw_float normal[3];
    rhw_float light[3]; // where the light sees the point: u, v and depth
};

// x, y and depth of the light's picture are products with three directions.
static void set_light(float m[16])
{
    for (int c = 0; c < 3; c++) {
        m[4 * c] = across[c] / map_radius;
        m[4 * c + 1] = along[c] / map_radius;
        m[4 * c + 2] = -sun[c] / (2 * map_radius);
        m[4 * c + 3] = 0;
    }
    m[12] = m[13] = 0;
    m[14] = 0.5f;
    m[15] = 1;
}

// The eye looks down on the spheres; W is the distance ahead, Z half a unit less.
static void set_camera(float m[16])
{
    const float sine = 0.28f, cosine = 0.96f, zoom = 3.0f, near = 0.5f, eye[3] = {0, 3.0f, 6.6f};
    const float rows[4][3] = {
        {zoom, 0, 0}, {0, zoom * cosine, -zoom * sine}, {0, -sine, -cosine}, {0, -sine, -cosine}};
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 3; c++) {
            m[4 * c + r] = rows[r][c];
        }
        m[12 + r] = -(rows[r][0] * eye[0] + rows[r][1] * eye[1] + rows[r][2] * eye[2]) - (r == 2 ? near : 0);
    }
}

// Both pictures: the world, and where the light sees it.
static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_vertex *v = &groups[i];
        const struct uniforms *u = v->uniforms;
        struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
        rhw_float world[3], lit[4];
        for (int k = 0; k < 3; k++) {
            world[k] = v->attribute[0][k] * u->radius + u->center[k];
            out->normal[k] = v->attribute[1][k];
        }
        rhw_mat4_mul_point(u->camera, world, v->position);
        rhw_mat4_mul_point(u->light, world, lit);
        out->light[0] = 0.5f + 0.5f * lit[0];
        out->light[1] = 0.5f - 0.5f * lit[1];
        out->light[2] = lit[2];
    }
}

static void place_in_map(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        rhw_float world[3];
        for (int k = 0; k < 3; k++) {
            world[k] = groups[i].attribute[0][k] * u->radius + u->center[k];
        }
        rhw_mat4_mul_point(u->light, world, groups[i].position);
    }
}

// How the surface's depth in the light changes with u and v, by the texel. It follows from their exact derivatives on
// the screen: (du/dx dv/dx; du/dy dv/dy)·(dz/du, dz/dv) = (dz/dx, dz/dy). (J. Isidoro, "Shadow mapping: GPU-based tips
// and techniques", GDC 2006.)
static void find_slope(const struct rhw_fragment *fragment, rhw_float slope[2])
{
    const rhw_float *x = RHW_VARYINGS(struct surface, fragment->ddx)->light;
    const rhw_float *y = RHW_VARYINGS(struct surface, fragment->ddy)->light;
    const rhw_float scale = 1.0f / ((x[0] * y[1] - x[1] * y[0]) * (float)MAP);
    slope[0] =
        rhw_clamp((y[1] * x[2] - x[1] * y[2]) * scale, -0.05f, 0.05f); // steep where the sun only grazes
    slope[1] = rhw_clamp((x[0] * y[2] - y[0] * x[2]) * scale, -0.05f, 0.05f);
}

// The part of the light that arrives, 0..1. Each footprint is compared with the depth that the surface has there, and a
// texel's slope nearer to the light: else a surface would shade itself.
static rhw_float lightness(const struct rhw_fragment *fragment)
{
    const struct uniforms *u = fragment->uniforms;
    const rhw_float *at = RHW_VARYINGS(struct surface, fragment->varying)->light;
    rhw_float slope[2], sum = rhw_splat(0);
    find_slope(fragment, slope);
    const rhw_float depth = at[2] - rhw_abs(slope[0]) - rhw_abs(slope[1]) - 0.002f;
    const int reach = u->wide != 0 ? 1 : 0;
    for (int y = -reach; y <= reach; y++) {
        for (int x = -reach; x <= reach; x++) {
            const rhw_float uv[2] = {at[0] + (float)x / MAP, at[1] + (float)y / MAP};
            const rhw_float reference = rhw_min(depth + slope[0] * (float)x + slope[1] * (float)y, 1.0f);
            sum += rhw_sample_compare_lod(fragment->textures, 0, uv, reference, rhw_splat(0));
        }
    }
    return sum / (float)((2 * reach + 1) * (2 * reach + 1));
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        rhw_float normal[3];
        rhw_normalize3(RHW_VARYINGS(struct surface, groups[i].varying)->normal, normal);
        const rhw_float cosine = normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2];
        const rhw_float direct = rhw_max(cosine, 0.0f) * lightness(&groups[i]);
        const rhw_float open = 0.5f + 0.5f * normal[1]; // how much of the sky is seen
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] = u->color[k] * (0.95f * direct + 0.35f * sky[k] * open);
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// For numbers: what arrives, the cosine, 0, and 1 where there is something.
static void show_light(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        rhw_float normal[3];
        rhw_normalize3(RHW_VARYINGS(struct surface, groups[i].varying)->normal, normal);
        const rhw_float cosine = normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2];
        groups[i].color[0][0] = lightness(&groups[i]);
        groups[i].color[0][1] = cosine;
        groups[i].color[0][2] = rhw_splat(0);
        groups[i].color[0][3] = rhw_splat(1);
    }
}

static rhw_pipeline make_pipeline(rhw_context *context, const struct rhw_program *program,
                                  enum rhw_format format)
{
    struct rhw_pipeline_def def = solid_pipeline_def();
    def.label = "lesson 9";
    def.program = *program;
    def.program.uniform_size = sizeof(struct uniforms);
    def.target_count = format != RHW_FORMAT_NONE;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// Everything, with the pipeline that is set.
static void draw_world(rhw_context *context, rhw_pass pass, rhw_buffer vertices, float wide)
{
    struct uniforms uniforms = {.wide = wide, .radius = 20};
    set_camera(uniforms.camera);
    set_light(uniforms.light);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    memcpy(uniforms.color, floor_color, sizeof floor_color);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    solid_draw(context, pass, SOLID_SQUARE, 1);
    for (int i = 0; i < SPHERES; i++) {
        memcpy(uniforms.center, spheres[i].center, sizeof uniforms.center);
        memcpy(uniforms.color, spheres[i].color, sizeof uniforms.color);
        uniforms.radius = spheres[i].radius;
        rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
        solid_draw(context, pass, SOLID_BALL, 1);
    }
}

// What the light sees: a pass without colour.
static rhw_texture draw_map(rhw_context *context, rhw_buffer vertices)
{
    const struct rhw_program program = {.vertex = {place_in_map}};
    const rhw_texture map = picture_target(context, RHW_FORMAT_D32_FLOAT, MAP, MAP, 1);
    const struct rhw_pass_def attachments = {.depth = {.enabled = true, .texture = map},
                                             .label = "shadow map"};
    const rhw_pipeline pipeline = make_pipeline(context, &program, RHW_FORMAT_NONE);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    draw_world(context, pass, vertices, 0);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_pipeline_destroy(context, pipeline);
    return map;
}

// Outside the map is light: its border is farther than everything.
static rhw_sampler make_sampler(rhw_context *context, enum rhw_filter filter)
{
    const struct rhw_sampler_def def = {.min_filter = filter,
                                        .mag_filter = filter,
                                        .address_u = RHW_ADDRESS_BORDER,
                                        .address_v = RHW_ADDRESS_BORDER,
                                        .border = {1},
                                        .compares = true,
                                        .compare = RHW_COMPARE_LESS_EQUAL};
    rhw_sampler sampler;
    must(rhw_sampler_create(context, &def, &sampler), "sampler");
    return sampler;
}

// The three ways side by side; `size` is a panel's width in pixels of the target.
static void draw(rhw_context *context, rhw_fragment_function *fragment, rhw_texture target, int size)
{
    const struct rhw_program program = {.vertex = {place},
                                        .fragment = {fragment},
                                        .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                                     RHW_VARYING(struct surface, light, RHW_SMOOTH, true)},
                                        .varying_count = 2};
    const rhw_buffer vertices = solid_buffer(context);
    const rhw_texture map = draw_map(context, vertices);
    const rhw_pipeline pipeline = make_pipeline(context, &program, rhw_texture_format(context, target));
    struct rhw_pass_def attachments = {.colors = {{.texture = target}},
                                       .color_count = 1,
                                       .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
                                       .label = "three ways"};
    const rhw_sampler nearest = make_sampler(context, RHW_FILTER_NEAREST),
                      linear = make_sampler(context, RHW_FILTER_LINEAR);
    if (fragment == paint) {
        memcpy(attachments.colors[0].clear, sky, sizeof sky);
    }
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    for (int i = 0; i < 3; i++) {
        const struct rhw_viewport panel = {(float)(i * size), 0, (float)size, (float)size, 0, 1};
        rhw_pass_set_viewport(context, pass, &panel);
        rhw_pass_set_texture(context, pass, 0, map, i == 0 ? nearest : linear);
        draw_world(context, pass, vertices, i == 2 ? 1 : 0);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_texture_destroy(context, map);
    rhw_sampler_destroy(context, nearest);
    rhw_sampler_destroy(context, linear);
    rhw_buffer_destroy(context, vertices);
    rhw_pipeline_destroy(context, pipeline);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, 3 * PANEL * SCALE, PANEL * SCALE, SCALE_LEVELS);
    draw(context, paint, picture, PANEL * SCALE);
    must(rhw_texture_generate_mips(context, picture), "mips");
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "09_shadow_map.png");

    static float light[PANEL][3 * PANEL][4];
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, 3 * PANEL, PANEL, 1);
    draw(context, show_light, plain, PANEL);
    rhw_texture_read(context, plain, 0, light, 0);
    static const char *const ways[3] = {"one texel", "one footprint", "3 x 3 footprints"};
    for (int i = 0; i < 3; i++) {
        int levels[3] = {0, 0, 0}; // none of the light, some, all of it
        for (int y = 0; y < PANEL; y++) {
            for (int x = 0; x < PANEL; x++) {
                const float *p = light[y][i * PANEL + x];
                if (p[3] == 1 && p[1] > 0) {
                    levels[p[0] == 0 ? 0 : p[0] < 1 ? 1 : 2]++;
                }
            }
        }
        printf("%-16s: %5d pixels in shadow, %5d at its edge, %5d in the light\n", ways[i], levels[0],
               levels[1], levels[2]);
    }
    rhw_context_destroy(context);
    return 0;
}
