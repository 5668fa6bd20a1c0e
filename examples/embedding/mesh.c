// SPDX-License-Identifier: MIT
// A mesh as model files have them: vertices and indices in buffers, a perspective matrix, a texture with mip levels,
// depth. Draws a chequered floor that reaches far away, with a pillar on it; writes mesh.ppm and prints a number made of
// the picture.
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture_hash.h"

enum { WIDTH = 640, HEIGHT = 360, SIDE = 256 };

struct vertex {
    float position[3], uv[2];
};

// The floor; then the pillar's front and right sides. Counter-clockwise as seen from where they are looked at.
static const struct vertex vertices[] = {
    {{-50, 0, 0}, {0, 50}}, {{50, 0, 0}, {50, 50}},  {{50, 0, -100}, {50, 0}}, {{-50, 0, -100}, {0, 0}},
    {{-1, 0, -6}, {0, 1}},  {{0, 0, -6}, {0.5f, 1}}, {{0, 2, -6}, {0.5f, 0}},  {{-1, 2, -6}, {0, 0}},
    {{0, 0, -7}, {1, 1}},   {{0, 2, -7}, {1, 0}},
};
static const uint16_t indices[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 5, 8, 9, 5, 9, 6};

enum { INDICES = sizeof indices / sizeof indices[0] };

// Uniforms: column by column, so that m[4 * column + row]; a position is a column on the right.
struct uniforms {
    float projection[16];
};

// Perspective for an eye that looks along -z, y up. Depth is 0 at `near` and 1 at `far`. `scale`: 1 / tan of half the
// vertical field of view.
static void perspective(float m[16], float scale, float aspect, float near, float far)
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = scale / aspect;
    m[5] = scale;
    m[10] = far / (near - far);
    m[11] = -1; // W is the distance, -z
    m[14] = near * far / (near - far);
}

// The eye stands 1.5 above the floor, to the right.
static void mesh_vertex(struct rhw_vertex1 *v)
{
    struct uniforms u;
    memcpy(&u, v->uniforms, sizeof u);
    const float at[4] = {v->attribute[0][0] - 1, v->attribute[0][1] - 1.5f, v->attribute[0][2], 1};
    for (int row = 0; row < 4; row++) {
        v->position[row] = 0;
        for (int column = 0; column < 4; column++) {
            v->position[row] += u.projection[4 * column + row] * at[column];
        }
    }
    v->varying[0] = v->attribute[1][0];
    v->varying[1] = v->attribute[1][1];
}

static void mesh_fragment(struct rhw_fragment1 *f)
{
    const float gradient[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    rhw_sample_grad1(f->bindings, 0, f->varying, gradient, f->color[0]);
}

static enum rhw_result make_texture(rhw_context *context, rhw_texture *texture)
{
    static unsigned char texels[SIDE][SIDE][4];
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            const int light = (x / 32 + y / 32) % 2;
            const unsigned char texel[4] = {light ? 230 : 40, light ? 220 : 60, light ? 190 : 110, 255};
            memcpy(texels[y][x], texel, sizeof texel);
        }
    }
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = def.height = SIDE;
    def.mip_levels = RHW_MIP_LEVELS_ALL; // which are black until they are made
    def.label = "tiles";
    enum rhw_result result = rhw_texture_create(context, &def, texture);
    if (result == RHW_OK) {
        result = rhw_texture_write(context, *texture, 0, texels, 0);
    }
    return result == RHW_OK ? rhw_texture_generate_mips(context, *texture) : result;
}

static enum rhw_result make_pipeline(rhw_context *context, rhw_pipeline *pipeline)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex1 = mesh_vertex;
    def.program.fragment1 = mesh_fragment;
    def.program.varyings[0].components = 2;
    def.program.varyings[0].derivatives = true; // for the level of detail
    def.program.varying_count = 1;
    def.program.uniform_size = sizeof(struct uniforms);
    def.attributes[0].format = RHW_VERTEX_FLOAT3;
    def.attributes[0].offset = offsetof(struct vertex, position);
    def.attributes[1].format = RHW_VERTEX_FLOAT2;
    def.attributes[1].offset = offsetof(struct vertex, uv);
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct vertex);
    def.buffer_count = 1;
    def.cull = RHW_CULL_BACK;
    def.depth_test = true;
    def.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
    def.label = "mesh";
    return rhw_pipeline_create(context, &def, pipeline);
}

struct mesh {
    rhw_buffer vertices, indices;
    rhw_texture texture, picture;
    rhw_sampler sampler;
    rhw_pipeline pipeline;
};

static enum rhw_result make_mesh(rhw_context *context, struct mesh *mesh)
{
    const struct rhw_buffer_def vertex_def = {.size = sizeof vertices, .data = vertices, .label = "vertices"};
    const struct rhw_buffer_def index_def = {.size = sizeof indices, .data = indices, .label = "indices"};
    const struct rhw_sampler_def sampler_def = rhw_sampler_def_default(); // trilinear, repeats
    struct rhw_texture_def picture_def = rhw_texture_def_default();
    picture_def.format = RHW_FORMAT_RGBA8_SRGB;
    picture_def.width = WIDTH;
    picture_def.height = HEIGHT;
    enum rhw_result result = rhw_buffer_create(context, &vertex_def, &mesh->vertices);
    result = result ? result : rhw_buffer_create(context, &index_def, &mesh->indices);
    result = result ? result : make_texture(context, &mesh->texture);
    result = result ? result : rhw_sampler_create(context, &sampler_def, &mesh->sampler);
    result = result ? result : make_pipeline(context, &mesh->pipeline);
    return result ? result : rhw_texture_create(context, &picture_def, &mesh->picture);
}

static enum rhw_result draw(rhw_context *context, const struct mesh *mesh)
{
    struct uniforms uniforms;
    perspective(uniforms.projection, 1.732f, (float)WIDTH / HEIGHT, 0.1f, 200);
    struct rhw_pass_def def = rhw_pass_def_default();
    const float sky[4] = {0.3f, 0.5f, 0.8f, 1};
    def.colors[0].texture = mesh->picture;
    memcpy(def.colors[0].clear, sky, sizeof sky);
    def.depth.enabled = true;
    def.depth.store = RHW_STORE_DISCARD; // nobody reads it later: it needs no texture
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_set_pipeline(context, pass, mesh->pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, mesh->vertices, 0);
    rhw_pass_set_index_buffer(context, pass, mesh->indices, RHW_INDEX_UINT16, 0);
    rhw_pass_set_texture(context, pass, 0, mesh->texture, mesh->sampler);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_draw_indexed(context, pass, 0, INDICES, 0, 0, 1);
    return rhw_pass_end(context, pass, NULL);
}

static int write_picture(rhw_context *context, rhw_texture picture)
{
    static unsigned char pixels[WIDTH * HEIGHT][4];
    rhw_texture_read(context, picture, 0, pixels, 0);
    FILE *const file = fopen("mesh.ppm", "wb");
    if (!file) {
        return 1;
    }
    fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        fwrite(pixels[i], 1, 3, file);
    }
    return fclose(file) != 0;
}

int main(void)
{
    const struct rhw_context_def def = {0};
    struct mesh mesh;
    rhw_context *context;
    if (rhw_context_create(&def, &context) != RHW_OK) {
        return 1;
    }
    enum rhw_result result = make_mesh(context, &mesh);
    result = result ? result : draw(context, &mesh);
    int status = result != RHW_OK;
    if (result == RHW_OK) {
        printf("%016llx\n", (unsigned long long)hash_picture(context, mesh.picture));
        status = write_picture(context, mesh.picture);
    } else {
        fprintf(stderr, "mesh: %s\n", rhw_result_string(result));
    }
    rhw_context_destroy(context);
    return status;
}
