// SPDX-License-Identifier: MIT
// Golden scenes of solids, floors and shards, made from arithmetic that is the same everywhere: what a picture
// is usually made of, in the sizes and depths that a renderer meets.
#include "golden_board.h"
#include "golden_scenes.h"
#include "golden_shaders.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 400, HEIGHT = 300 };

struct vertex {
    float position[3], value[4];
};

struct mesh {
    struct vertex *vertices;
    int count, capacity;
};

static void add(struct mesh *mesh, const float position[3], const float value[4])
{
    if (mesh->count == mesh->capacity) {
        mesh->capacity = mesh->capacity ? 2 * mesh->capacity : 1024;
        mesh->vertices = realloc(mesh->vertices, sizeof *mesh->vertices * (size_t)mesh->capacity);
    }
    struct vertex *vertex = &mesh->vertices[mesh->count++];
    memcpy(vertex->position, position, sizeof vertex->position);
    memcpy(vertex->value, value, sizeof vertex->value);
}

// A triangle of the octahedron, divided `depth` times, its corners pushed out to the sphere.
static void add_sphere_part(struct mesh *mesh, const float a[3], const float b[3], const float c[3],
                            int depth)
{
    if (depth == 0) {
        // Coordinates for a texture: those of the position.
        add(mesh, a, (const float[4]){a[0], a[1], 0, 0});
        add(mesh, b, (const float[4]){b[0], b[1], 0, 0});
        add(mesh, c, (const float[4]){c[0], c[1], 0, 0});
        return;
    }
    const float *corner[3] = {a, b, c};
    float middle[3][3];
    for (int i = 0; i < 3; i++) {
        const float *p = corner[i], *q = corner[(i + 1) % 3];
        float sum[3], square = 0;
        for (int k = 0; k < 3; k++) {
            sum[k] = p[k] + q[k];
            square += sum[k] * sum[k];
        }
        for (int k = 0; k < 3; k++) {
            middle[i][k] = sum[k] / sqrtf(square);
        }
    }
    add_sphere_part(mesh, a, middle[0], middle[2], depth - 1);
    add_sphere_part(mesh, b, middle[1], middle[0], depth - 1);
    add_sphere_part(mesh, c, middle[2], middle[1], depth - 1);
    add_sphere_part(mesh, middle[0], middle[1], middle[2], depth - 1);
}

static void make_sphere(struct mesh *mesh, int depth)
{
    for (int octant = 0; octant < 8; octant++) {
        const float x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
        const float px[3] = {x, 0, 0}, py[3] = {0, y, 0}, pz[3] = {0, 0, z};
        if (x * y * z > 0) {
            add_sphere_part(mesh, px, py, pz, depth);
        } else {
            add_sphere_part(mesh, px, pz, py, depth);
        }
    }
}

// A floor that starts behind the eye and goes on beyond the far plane.
static void make_floor(struct mesh *mesh)
{
    static const float corners[6][2] = {{-60, 40}, {60, 40}, {-60, -90}, {-60, -90}, {60, 40}, {60, -90}};
    for (int i = 0; i < 6; i++) {
        const float position[3] = {corners[i][0], -1, corners[i][1]};
        const float uv[4] = {corners[i][0] * 0.25f, corners[i][1] * 0.25f, 0, 0};
        add(mesh, position, uv);
    }
}

static void make_shards(struct mesh *mesh, int count, float size, float alpha)
{
    uint64_t random = 7;
    for (int i = 0; i < count; i++) {
        float center[3], value[4];
        for (int c = 0; c < 3; c++) {
            center[c] = golden_random(&random, -1.5f, 1.5f);
        }
        for (int c = 0; c < 3; c++) {
            value[c] = golden_random(&random, 0, 1);
        }
        value[3] = alpha;
        for (int k = 0; k < 3; k++) {
            float position[3];
            for (int c = 0; c < 3; c++) {
                position[c] = center[c] + golden_random(&random, -size, size);
            }
            add(mesh, position, value);
        }
    }
}

// Eye on the z axis looking down −z, 4:3, about 46 degrees high; near 0.1, far 60.
static struct golden_uniforms make_uniforms(float distance)
{
    const float near = 0.1f, far = 60, focal = 2.3652225f;
    // From the side that the eye sees: the front of a ball, or its inside at the back.
    struct golden_uniforms uniforms = {.eye = {0, 0, distance, 1}, .light = {0.48f, 0.6f, 0.64f, 0}};
    if (distance < 1) {
        uniforms.light[2] = -uniforms.light[2];
    }
    uniforms.matrix[0] = focal * 0.75f;
    uniforms.matrix[5] = focal;
    uniforms.matrix[10] = -far / (far - near);
    uniforms.matrix[11] = -1;
    uniforms.matrix[14] = (distance - near) * far / (far - near);
    uniforms.matrix[15] = distance;
    return uniforms;
}

struct scene {
    const char *name;
    void (*make)(struct mesh *mesh);
    enum golden_shader shader;
    float distance;
    enum rhw_format format;
    enum rhw_qualifier qualifier;
    bool blend, cull;
};

static void make_coarse_ball(struct mesh *mesh)
{
    make_sphere(mesh, 1);
}

static void make_ball(struct mesh *mesh)
{
    make_sphere(mesh, 4);
}

static void make_fine_ball(struct mesh *mesh)
{
    make_sphere(mesh, 7); // 131,072 triangles
}

static void make_glass(struct mesh *mesh)
{
    make_shards(mesh, 1500, 0.5f, 0.375f);
}

static void make_dust(struct mesh *mesh)
{
    make_shards(mesh, 60000, 0.02f, 1);
}

static const struct scene scenes[] = {
    {"ball", make_ball, GOLDEN_LIT, 3, RHW_FORMAT_RGBA8_SRGB, RHW_SMOOTH, false, true},
    {"ball-of-131072-triangles", make_fine_ball, GOLDEN_LIT, 2.5f, RHW_FORMAT_RGBA32_FLOAT, RHW_SMOOTH, false,
     true},
    {"inside-the-ball", make_ball, GOLDEN_LIT, 0.5f, RHW_FORMAT_RGBA16_FLOAT, RHW_SMOOTH, false, false},
    {"floor", make_floor, GOLDEN_TEXTURE, 0.5f, RHW_FORMAT_RGBA8_SRGB, RHW_SMOOTH, false, false},
    {"ball-noperspective", make_coarse_ball, GOLDEN_TEXTURE, 1.5f, RHW_FORMAT_RGBA8_UNORM, RHW_NOPERSPECTIVE,
     false, true},
    {"glass", make_glass, GOLDEN_GLASS, 4, RHW_FORMAT_RGBA8_SRGB, RHW_SMOOTH, true, false},
    {"glass-around-the-eye", make_glass, GOLDEN_GLASS, 0, RHW_FORMAT_RGBA32_FLOAT, RHW_FLAT, true, false},
    {"dust", make_dust, GOLDEN_GLASS, 3, RHW_FORMAT_RGBA8_UNORM, RHW_SMOOTH, false, false},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

const char *golden_shape_name(int number)
{
    return number < SCENES ? scenes[number].name : NULL;
}

static rhw_pipeline make_pipeline(rhw_context *context, const struct scene *scene)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    golden_shaders_fill(&def.program, scene->shader);
    def.program.varyings[0] =
        (struct rhw_varying){.components = 3, .qualifier = scene->qualifier, .derivatives = true};
    def.program.varyings[1] =
        (struct rhw_varying){.components = 4, .qualifier = scene->qualifier, .derivatives = true};
    def.program.varying_count = 2;
    def.program.uses = scene->shader == GOLDEN_GLASS ? RHW_USE_DISCARD : 0;
    def.program.uniform_size = sizeof(struct golden_uniforms);
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct vertex, position)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct vertex, value)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct vertex);
    def.buffer_count = 1;
    def.cull = scene->cull ? RHW_CULL_BACK : RHW_CULL_NONE;
    def.depth_test = true;
    def.depth_read_only = scene->blend;
    def.targets[0].format = scene->format;
    def.targets[0].blend = scene->blend;
    def.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    def.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    rhw_pipeline pipeline;
    golden_check(rhw_pipeline_create(context, &def, &pipeline), scene->name);
    return pipeline;
}

// A checkerboard with a hue that changes, of odd sizes.
static rhw_texture make_checker(rhw_context *context)
{
    enum { W = 75, H = 50 };
    unsigned char texels[H][W][4];
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            const int dark = (x / 15 + y / 10) % 2;
            texels[y][x][0] = (unsigned char)(dark ? 30 : 255 - y);
            texels[y][x][1] = (unsigned char)(dark ? 60 + x : 240);
            texels[y][x][2] = (unsigned char)(dark ? 90 : 3 * x);
            texels[y][x][3] = 255;
        }
    }
    const rhw_texture texture = golden_texture(context, RHW_FORMAT_RGBA8_SRGB, W, H, RHW_MIP_LEVELS_ALL);
    rhw_texture_write(context, texture, 0, texels, 0);
    rhw_texture_generate_mips(context, texture);
    return texture;
}

void golden_shape_draw(rhw_context *context, int number, struct golden_images *images)
{
    const struct scene *scene = &scenes[number];
    struct mesh mesh = {0};
    scene->make(&mesh);
    const rhw_buffer buffer =
        golden_buffer(context, mesh.vertices, sizeof *mesh.vertices * (size_t)mesh.count);
    const struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    rhw_sampler sampler;
    golden_check(rhw_sampler_create(context, &sampler_def, &sampler), scene->name);
    const rhw_texture target = golden_texture(context, scene->format, WIDTH, HEIGHT, 1);
    const rhw_texture depth_target = golden_texture(context, RHW_FORMAT_D32_FLOAT, WIDTH, HEIGHT, 1);
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    pass_def.colors[0] = (struct rhw_color_attachment){.texture = target, .clear = {0.05f, 0.1f, 0.2f, 1}};
    pass_def.color_count = 1;
    pass_def.depth = (struct rhw_depth_attachment){.enabled = true, .texture = depth_target, .clear = 1};
    rhw_pass pass;
    golden_check(rhw_pass_begin(context, &pass_def, &pass), scene->name);
    rhw_pass_set_pipeline(context, pass, make_pipeline(context, scene));
    rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
    rhw_pass_set_texture(context, pass, 0, make_checker(context), sampler);
    const struct golden_uniforms uniforms = make_uniforms(scene->distance);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_draw(context, pass, 0, (uint32_t)mesh.count, 0, 1);
    golden_check(rhw_pass_end(context, pass, NULL), scene->name);
    golden_keep(images, context, target);
    golden_keep(images, context, depth_target);
    free(mesh.vertices);
}
