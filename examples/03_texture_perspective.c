// SPDX-License-Identifier: MIT
// Lesson 3: three ways to find the texture coordinates of a pixel.
//
// A square lies on the plane y = 0, made of two triangles and seen from (0, 1.5, 1.5). Its texture is a grid
// with both diagonals marked. From left to right:
//
//     screen    u = r·u_A + s·u_B + t·u_C. Each triangle is bent in its own way: the red diagonal, which
//               crosses from one to the other, breaks at the edge they share.
//     world     The pixel's x, y and depth go back through the inverse of viewport · projection · view to a
//               point P in the world; the weights a, b, c are the areas of the triangles PBC, PCA and PAB
//               over that of ABC, and u = a·u_A + b·u_B + c·u_C. Right, and laborious.
//     pipeline  a = r·W_P/W_A, … with 1/W_P = r/W_A + s/W_B + t/W_C. The same numbers for three
//               multiplications: this is what RHW_SMOOTH does.
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

// A panel shows `ROWS` rows of a square view of SIZE × SIZE pixels, those from row ABOVE on.
enum { SIZE = 400, ROWS = 256, ABOVE = 104, SCALE = 4, SCALE_LEVELS = 3, TEXELS = 512 };

enum way { SCREEN, WORLD, PIPELINE, WAYS };

struct corner {
    float world[3];
    float uv[2];
};

// The shared edge runs from corner 0 to corner 2, along the blue diagonal of the texture.
static const struct corner square[6] = {
    {{-1, 0, -1}, {0, 0}}, {{-1, 0, 1}, {0, 1}}, {{1, 0, 1}, {1, 1}},
    {{-1, 0, -1}, {0, 0}}, {{1, 0, 1}, {1, 1}},  {{1, 0, -1}, {1, 0}},
};

// Row-major; a point is a column: clip = matrix · (x, y, z, 1).
struct matrix {
    double m[4][4];
};

struct uniforms {
    float clip_from_world[4][4];
    float world_from_screen[4][4]; // from (column, row, depth, 1), up to a factor
    int32_t way;
};

static struct matrix multiply(const struct matrix *a, const struct matrix *b)
{
    struct matrix product = {{{0}}};
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            for (int k = 0; k < 4; k++) {
                product.m[row][column] += a->m[row][k] * b->m[k][column];
            }
        }
    }
    return product;
}

// Gauss and Jordan's, with the largest pivot of each column; the matrix has an inverse.
static struct matrix invert(struct matrix a)
{
    struct matrix inverse = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    for (int column = 0; column < 4; column++) {
        int pivot = column;
        for (int row = column + 1; row < 4; row++) {
            pivot = fabs(a.m[row][column]) > fabs(a.m[pivot][column]) ? row : pivot;
        }
        for (int k = 0; k < 4; k++) {
            const double swap = a.m[pivot][k], other = inverse.m[pivot][k];
            a.m[pivot][k] = a.m[column][k];
            inverse.m[pivot][k] = inverse.m[column][k];
            a.m[column][k] = swap;
            inverse.m[column][k] = other;
        }
        const double scale = 1 / a.m[column][column];
        for (int k = 0; k < 4; k++) {
            a.m[column][k] *= scale;
            inverse.m[column][k] *= scale;
        }
        for (int row = 0; row < 4; row++) {
            const double factor = row == column ? 0 : a.m[row][column];
            for (int k = 0; k < 4; k++) {
                a.m[row][k] -= factor * a.m[column][k];
                inverse.m[row][k] -= factor * inverse.m[column][k];
            }
        }
    }
    return inverse;
}

// From (0, 1.5, 1.5) towards the origin: right is x, up (0, 1, −1)/√2, forward (0, −1, −1)/√2.
static struct matrix view_matrix(void)
{
    const double h = 0.70710678118654752, distance = 1.5 * 2 * h;
    return (struct matrix){{{1, 0, 0, 0}, {0, h, -h, 0}, {0, -h, -h, distance}, {0, 0, 0, 1}}};
}

// W = distance forward; Z/W runs from 0 at `near` to 1 at `far`. `focal` is the cotangent of half the angle of
// view; 1.35 shows 73 degrees.
static struct matrix projection_matrix(void)
{
    const double focal = 1.35, near = 1, far = 4, k = far / (far - near);
    return (struct matrix){{{focal, 0, 0, 0}, {0, focal, 0, 0}, {0, 0, k, -near * k}, {0, 0, 1, 0}}};
}

// Columns and rows of pixels from −1..1; y turns over, since rows are counted from the top.
static struct matrix viewport_matrix(const struct rhw_viewport *v)
{
    const double w = (double)v->width / 2, h = (double)v->height / 2;
    return (struct matrix){
        {{w, 0, 0, (double)v->x + w}, {0, -h, 0, (double)v->y + h}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

// Where the view of a panel stands in a target that is `scale` times the picture.
static struct rhw_viewport panel_viewport(enum way way, int scale)
{
    const float size = (float)(SIZE * scale);
    return (struct rhw_viewport){(float)way * size, (float)(-ABOVE * scale), size, size, 0, 1};
}

static struct uniforms make_uniforms(enum way way, const struct rhw_viewport *panel)
{
    const struct matrix view = view_matrix(), projection = projection_matrix();
    const struct matrix viewport = viewport_matrix(panel);
    const struct matrix clip_from_world = multiply(&projection, &view);
    const struct matrix world_from_screen = invert(multiply(&viewport, &clip_from_world));
    struct uniforms uniforms = {.way = (int32_t)way};
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            uniforms.clip_from_world[row][column] = (float)clip_from_world.m[row][column];
            uniforms.world_from_screen[row][column] = (float)world_from_screen.m[row][column];
        }
    }
    return uniforms;
}

// Varyings 0..1: u, v with RHW_SMOOTH. Varyings 2..3: u, v with RHW_NOPERSPECTIVE.
static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_vertex *vertex = &groups[i];
        const struct uniforms *uniforms = vertex->uniforms;
        const rhw_float *world = vertex->attribute[0];
        for (int row = 0; row < 4; row++) {
            const float *m = uniforms->clip_from_world[row];
            vertex->position[row] = m[0] * world[0] + m[1] * world[1] + m[2] * world[2] + m[3];
        }
        for (int c = 0; c < 2; c++) {
            vertex->varying[c] = vertex->varying[c + 2] = vertex->attribute[1][c];
        }
    }
}

// Twice the area of PQR, which lies on the plane y = 0; signed.
static rhw_float area(const rhw_float p[2], const rhw_float q[2], const rhw_float r[2])
{
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

// The way through the world: column, row and depth to a point, the point to weights, the weights to u and v.
static void uv_from_world(const struct rhw_fragment *fragment, rhw_float uv[2])
{
    const struct uniforms *uniforms = fragment->uniforms;
    rhw_float world[4];
    for (int row = 0; row < 4; row++) {
        const float *m = uniforms->world_from_screen[row];
        world[row] = m[0] * fragment->coord[0] + m[1] * fragment->coord[1] + m[2] * fragment->coord[2] + m[3];
    }
    const rhw_float p[2] = {world[0] / world[3], world[2] / world[3]};

    const rhw_int second = rhw_equal_int(fragment->primitive, 1);
    rhw_float xz[3][2];
    for (int i = 0; i < 3; i++) {
        const float *first_corner = square[i].world, *second_corner = square[i + 3].world;
        xz[i][0] = rhw_select(second, second_corner[0], first_corner[0]);
        xz[i][1] = rhw_select(second, second_corner[2], first_corner[2]);
    }
    const rhw_float whole = area(xz[0], xz[1], xz[2]);
    const rhw_float a = area(p, xz[1], xz[2]) / whole;
    const rhw_float b = area(p, xz[2], xz[0]) / whole;
    const rhw_float c = area(p, xz[0], xz[1]) / whole;
    for (int k = 0; k < 2; k++) {
        const rhw_float u_a = rhw_select(second, square[3].uv[k], square[0].uv[k]);
        const rhw_float u_b = rhw_select(second, square[4].uv[k], square[1].uv[k]);
        const rhw_float u_c = rhw_select(second, square[5].uv[k], square[2].uv[k]);
        uv[k] = a * u_a + b * u_b + c * u_c;
    }
}

static void find_uv(const struct rhw_fragment *fragment, rhw_float uv[2])
{
    const int32_t way = ((const struct uniforms *)fragment->uniforms)->way;
    if (way == WORLD) {
        uv_from_world(fragment, uv);
        return;
    }
    uv[0] = fragment->varying[way == SCREEN ? 2 : 0];
    uv[1] = fragment->varying[way == SCREEN ? 3 : 1];
}

// How large a pixel's footprint in the texture is says the pipeline, for all three alike: du/dx, dv/dx,
// du/dy and dv/dy of the smooth coordinates choose the mip level.
static void sample_texture(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_fragment *fragment = &groups[i];
        const rhw_float footprint[4] = {fragment->ddx[0], fragment->ddx[1], fragment->ddy[0],
                                        fragment->ddy[1]};
        rhw_float uv[2];
        find_uv(fragment, uv);
        rhw_sample_grad(fragment->bindings, 0, uv, footprint, fragment->color[0]);
    }
}

// The coordinates themselves, to compare.
static void show_uv(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        find_uv(&groups[i], groups[i].color[0]);
        groups[i].color[0][2] = rhw_float_from_int(groups[i].primitive);
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// A grid of 8 × 8 fields; the diagonal u = v is blue, the diagonal u = 1 − v red.
static rhw_texture make_texture(rhw_context *context)
{
    static uint8_t texels[TEXELS][TEXELS][4];
    static const uint8_t paper[2][4] = {{250, 248, 240, 255}, {226, 228, 226, 255}};
    static const uint8_t line[4] = {70, 78, 90, 255}, blue[4] = {40, 110, 200, 255},
                         red[4] = {215, 60, 45, 255};
    const int field = TEXELS / 8;
    for (int y = 0; y < TEXELS; y++) {
        for (int x = 0; x < TEXELS; x++) {
            const bool on_line = (x + 3) % field < 6 || (y + 3) % field < 6;
            const uint8_t *color = on_line ? line : paper[(x / field + y / field) & 1];
            color = abs(x + y - TEXELS + 1) < 11 ? red : color;
            color = abs(x - y) < 11 ? blue : color;
            for (int c = 0; c < 4; c++) {
                texels[y][x][c] = color[c];
            }
        }
    }
    const rhw_texture texture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, TEXELS, TEXELS, RHW_MIP_LEVELS_ALL);
    rhw_texture_write(context, texture, 0, texels, 0);
    rhw_texture_generate_mips(context, texture);
    return texture;
}

static rhw_pipeline make_pipeline(rhw_context *context, rhw_fragment_function *fragment,
                                  enum rhw_format format)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){
        .vertex = {place},
        .fragment = {fragment},
        .varyings = {{.components = 2, .derivatives = true},
                     {.components = 2, .qualifier = RHW_NOPERSPECTIVE}},
        .varying_count = 2,
        .uses = RHW_USE_COORD | RHW_USE_IDS,
        .uniform_size = sizeof(struct uniforms),
    };
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, world)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct corner, uv)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// The three ways side by side.
static void draw(rhw_context *context, rhw_fragment_function *fragment, rhw_texture target, int scale)
{
    rhw_sampler trilinear;
    struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    sampler_def.address_u = sampler_def.address_v = RHW_ADDRESS_CLAMP;
    must(rhw_sampler_create(context, &sampler_def, &trilinear), "sampler");
    const rhw_buffer corners = picture_vertices(context, square, sizeof square);

    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = target;
    attachments.colors[0].clear[0] = 0.09f;
    attachments.colors[0].clear[1] = 0.11f;
    attachments.colors[0].clear[2] = 0.14f;
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass,
                          make_pipeline(context, fragment, rhw_texture_format(context, target)));
    rhw_pass_set_vertex_buffer(context, pass, 0, corners, 0);
    rhw_pass_set_texture(context, pass, 0, make_texture(context), trilinear);
    for (int way = 0; way < WAYS; way++) {
        const struct rhw_viewport panel = panel_viewport((enum way)way, scale);
        const struct uniforms uniforms = make_uniforms((enum way)way, &panel);
        rhw_pass_set_viewport(context, pass, &panel);
        rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
        rhw_pass_draw(context, pass, 0, 6, 0, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
}

// The largest difference of u or v between two ways, over the pixels of the square.
static float largest_difference(const float (*uv)[4], enum way first, enum way second)
{
    float largest = 0;
    for (int i = 0; i < SIZE * ROWS; i++) {
        const float *p = uv[i / SIZE * WAYS * SIZE + i % SIZE + (int)first * SIZE];
        const float *q = uv[i / SIZE * WAYS * SIZE + i % SIZE + (int)second * SIZE];
        for (int k = 0; k < 2 && p[3] == 1; k++) {
            largest = fmaxf(largest, fabsf(p[k] - q[k]));
        }
    }
    return largest;
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, WAYS * SIZE * SCALE, ROWS * SCALE, SCALE_LEVELS);
    draw(context, sample_texture, picture, SCALE);
    rhw_texture_generate_mips(context, picture);
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "03_texture_perspective.png");

    static float uv[ROWS * SIZE * WAYS][4];
    const rhw_texture coordinates = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, WAYS * SIZE, ROWS, 1);
    draw(context, show_uv, coordinates, 1);
    rhw_texture_read(context, coordinates, 0, uv, 0);
    const float screen = largest_difference((const float(*)[4])uv, SCREEN, PIPELINE);
    const float world = largest_difference((const float(*)[4])uv, WORLD, PIPELINE);
    printf("largest difference from the pipeline's u and v:\n");
    printf("  weights of the screen            %.3f, %.1f fields of the grid\n", (double)screen,
           (double)(screen * 8));
    printf("  weights from the world position  %.1e, from snapped corners and a 32-bit depth\n",
           (double)world);
    rhw_context_destroy(context);
    return world < 2e-5f ? 0 : 1;
}
