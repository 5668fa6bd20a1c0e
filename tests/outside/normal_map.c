// SPDX-License-Identifier: MIT
// A corridor of bevelled tiles: an albedo in sRGB and a normal map, both with mip levels, over tangents that
// the vertices bring along; the left wall has its texture mirrored. Drawn twice, side by side: on the left
// the fragment function works on 8 lanes, on the right, written again, on one fragment at a time. The halves
// have the same bytes. Tiles slope 3 to 4 at their edges, and the sun stands at (2, 3, -6) / 7, so that light
// is worked out by hand.
#include "normal_map.h"
#include "matrix.h"
#include "outside.h"

enum { SIZE = 320, TEXELS = 64, TILE = 32, GAP = 2, BEVEL = 6 };

struct corner {
    float position[3], uv[2];
    int8_t normal[4], tangent[4];
};

// A rectangle: v grows along mirror · normal × tangent; u and v are lengths.
struct plane {
    float origin[3];
    int8_t normal[3], tangent[3], mirror;
    float width, height;
};

static const struct plane planes[] = {
    {{-2, 0, 0}, {0, 1, 0}, {1, 0, 0}, 1, 4, 64},   // the floor: u to the right, v ahead
    {{-2, 3, 0}, {1, 0, 0}, {0, 0, -1}, -1, 64, 3}, // walls: u ahead, v down; the left one
    {{2, 3, 0}, {-1, 0, 0}, {0, 0, -1}, 1, 64, 3},  // and the right one
};
enum { PLANES = sizeof planes / sizeof planes[0] };

static const unsigned char clay[4] = {200, 100, 70, 255}, cream[4] = {220, 210, 180, 255},
                           mortar[4] = {60, 60, 65, 255};

static void make_corners(struct corner corners[4 * PLANES], uint8_t indices[6 * PLANES])
{
    static const uint8_t quad[6] = {0, 1, 2, 2, 1, 3};
    for (int p = 0; p < PLANES; p++) {
        const struct plane *plane = &planes[p];
        const int8_t *n = plane->normal, *t = plane->tangent;
        for (int i = 0; i < 4; i++) {
            struct corner *corner = &corners[4 * p + i];
            corner->uv[0] = i & 1 ? plane->width : 0;
            corner->uv[1] = i & 2 ? plane->height : 0;
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                const int bitangent = plane->mirror * (n[b] * t[c] - n[c] * t[b]);
                corner->normal[a] = (int8_t)(127 * n[a]);
                corner->tangent[a] = (int8_t)(127 * t[a]);
                corner->position[a] =
                    plane->origin[a] + corner->uv[0] * t[a] + corner->uv[1] * (float)bitangent;
            }
            corner->normal[3] = 0;
            corner->tangent[3] = (int8_t)(127 * plane->mirror);
        }
        for (int i = 0; i < 6; i++) {
            indices[6 * p + i] = (uint8_t)(4 * p + quad[i]);
        }
    }
}

// 2 × 2 tiles of two colours. Their edges slope 3 to 4: (±75, 0, 100) has the length 125.
static void make_texels(unsigned char albedo[TEXELS][TEXELS][4], unsigned char normals[TEXELS][TEXELS][4])
{
    for (int y = 0; y < TEXELS; y++) {
        for (int x = 0; x < TEXELS; x++) {
            const int right = TILE - 1 - x % TILE, below = TILE - 1 - y % TILE;
            const int near_x = x % TILE < right ? x % TILE : right;
            const int near_y = y % TILE < below ? y % TILE : below;
            const int edge = near_x < near_y ? near_x : near_y;
            memcpy(albedo[y][x], edge < GAP ? mortar : x / TILE == y / TILE ? clay : cream, 4);
            const bool slopes = edge >= GAP && edge < GAP + BEVEL;
            const int slope_x = !slopes || near_x > near_y ? 0 : x % TILE < TILE / 2 ? -75 : 75;
            const int slope_y = !slopes || near_y >= near_x ? 0 : y % TILE < TILE / 2 ? -75 : 75;
            normals[y][x][0] = (unsigned char)(128 + slope_x);
            normals[y][x][1] = (unsigned char)(128 + slope_y);
            normals[y][x][2] = (unsigned char)(128 + (slope_x || slope_y ? 100 : 127));
            normals[y][x][3] = 255;
        }
    }
}

// The fragment function again, one at a time; normal_map_shaders.c has it on 8 lanes.
static void light1(struct rhw_fragment1 *f)
{
    const struct material *material = f->uniforms;
    const struct surface1 *in = RHW_VARYINGS(struct surface1, f->varying);
    const float *ddx = RHW_VARYINGS(struct surface1, f->ddx)->uv;
    const float *ddy = RHW_VARYINGS(struct surface1, f->ddy)->uv;
    const float grad[4] = {ddx[0], ddx[1], ddy[0], ddy[1]};
    float albedo[4], bend[4], bitangent[3], normal[3], half[3];
    rhw_sample_grad1(f->textures, ALBEDO, in->uv, grad, albedo);
    rhw_sample_grad1(f->textures, NORMALS, in->uv, grad, bend);
    rhw_cross1(in->normal, in->tangent, bitangent);
    for (int i = 0; i < 3; i++) {
        bend[i] = bend[i] * normal_scale + normal_offset;
        bitangent[i] *= in->tangent[3];
    }
    for (int i = 0; i < 3; i++) {
        normal[i] = bend[0] * in->tangent[i] + bend[1] * bitangent[i] + bend[2] * in->normal[i];
        half[i] = material->eye[i] - in->world[i];
    }
    rhw_normalize3_1(normal, normal);
    rhw_normalize3_1(half, half);
    for (int i = 0; i < 3; i++) {
        half[i] += material->towards[i];
    }
    rhw_normalize3_1(half, half);
    const float facing = rhw_max1(rhw_dot3_1(normal, material->towards), 0);
    const float power = rhw_pow1(rhw_max1(rhw_dot3_1(normal, half), 0), material->sharpness);
    const float shine = facing > 0 ? material->shine * power : 0;
    const float light = material->ambient + (1 - material->ambient) * facing;
    for (int c = 0; c < 3; c++) {
        f->color[0][c] = albedo[c] * light + shine;
    }
    f->color[0][3] = 1;
}

// The vertex function is on 8 lanes in both programs.
static rhw_pipeline make_pipeline(rhw_context *context, bool lanes)
{
    struct rhw_pipeline_def def = {
        .program = {.vertex = RHW_ISA_TABLE(normal_map_place),
                    .fragment = RHW_ISA_TABLE(normal_map_light),
                    .fragment1 = light1,
                    .varyings = {RHW_VARYING1(struct surface1, uv, RHW_SMOOTH, true),
                                 RHW_VARYING1(struct surface1, world, RHW_SMOOTH, false),
                                 RHW_VARYING1(struct surface1, normal, RHW_SMOOTH, false),
                                 RHW_VARYING1(struct surface1, tangent, RHW_SMOOTH, false)},
                    .varying_count = 4,
                    .uniform_size = sizeof(struct material)},
        .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, position)},
                       {RHW_VERTEX_SNORM8X3, 0, offsetof(struct corner, normal)},
                       {RHW_VERTEX_SNORM8X4, 0, offsetof(struct corner, tangent)},
                       {RHW_VERTEX_FLOAT2, 0, offsetof(struct corner, uv)}},
        .attribute_count = 4,
        .buffers = {{.stride = sizeof(struct corner)}},
        .buffer_count = 1,
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
        .target_count = 1,
        .label = lanes ? "8 lanes" : "one at a time",
    };
    if (!lanes) { // fragment1 is used where there is no other
        memset(def.program.fragment, 0, sizeof def.program.fragment);
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), def.label);
    return pipeline;
}

static rhw_texture make_texture(rhw_context *context, enum rhw_format format, const void *texels)
{
    const struct rhw_texture_def def = {
        .format = format, .width = TEXELS, .height = TEXELS, .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), "texture");
    must(rhw_texture_write(context, texture, 0, texels, 0), "texels");
    must(rhw_texture_generate_mips(context, texture), "mip levels");
    return texture;
}

static void draw(rhw_context *context, const struct material *material, rhw_texture albedo,
                 rhw_texture normals, rhw_texture picture)
{
    struct corner corners[4 * PLANES];
    uint8_t indices[6 * PLANES];
    make_corners(corners, indices);
    const struct rhw_buffer_def corner_def = {.size = sizeof corners, .data = corners};
    const struct rhw_buffer_def index_def = {.size = sizeof indices, .data = indices};
    const struct rhw_sampler_def sampler_def = {0}; // trilinear, repeated
    rhw_buffer corner_buffer, index_buffer;
    rhw_sampler sampler;
    must(rhw_buffer_create(context, &corner_def, &corner_buffer), "corners");
    must(rhw_buffer_create(context, &index_def, &index_buffer), "indices");
    must(rhw_sampler_create(context, &sampler_def, &sampler), "sampler");

    const struct rhw_pass_def pass_def = {
        .colors = {{.texture = picture, .clear = {0.45f, 0.6f, 0.8f, 1}}},
        .color_count = 1,
        .label = "corridors",
    };
    rhw_pass pass;
    must(rhw_pass_begin(context, &pass_def, &pass), "begin");
    rhw_pass_set_vertex_buffer(context, pass, 0, corner_buffer, 0);
    rhw_pass_set_index_buffer(context, pass, index_buffer, RHW_INDEX_UINT8, 0);
    rhw_pass_set_uniforms(context, pass, material, sizeof *material);
    rhw_pass_set_texture(context, pass, ALBEDO, albedo, sampler);
    rhw_pass_set_texture(context, pass, NORMALS, normals, sampler);
    for (int half = 0; half < 2; half++) {
        const struct rhw_viewport viewport = {.x = (float)(half * SIZE), .width = SIZE, .height = SIZE};
        rhw_pass_set_viewport(context, pass, &viewport);
        rhw_pass_set_pipeline(context, pass, make_pipeline(context, half == 0));
        rhw_pass_draw_indexed(context, pass, 0, 6 * PLANES, 0, 0, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "end");
}

static float linear(int code)
{
    const float c = (float)code / 255;
    return c <= 0.04045f ? c / 12.92f : rhw_pow1((c + 0.055f) / 1.055f, 2.4f);
}

static int code(float value)
{
    return (int)(255 * (1.055f * rhw_pow1(rhw_saturate1(value), 1 / 2.4f) - 0.055f) + 0.5f);
}

// Whether the left half has the colour, by codes of an albedo, where a point of the world lands in it.
static bool shows(const struct material *material, unsigned char (*pixels)[4], const float point[3],
                  const float albedo[3], float facing, float shine)
{
    float landed[3];
    matrix_land(material->camera, point, SIZE, SIZE, landed);
    const unsigned char *pixel = pixels[(int)landed[1] * 2 * SIZE + (int)landed[0]];
    bool same = true;
    for (int c = 0; c < 3; c++) {
        const float light = material->ambient + (1 - material->ambient) * facing;
        const int expected = code(albedo[c] * light + shine);
        same = same && abs(pixel[c] - expected) <= 1;
    }
    return same;
}

static void check_pixels(struct outside *outside, const struct material *material, unsigned char (*pixels)[4],
                         unsigned char (*albedo)[4])
{
    float albedo_of[2][3], mean[3] = {0};
    for (int c = 0; c < 3; c++) {
        albedo_of[0][c] = linear(clay[c]);
        albedo_of[1][c] = linear(cream[c]);
        for (int i = 0; i < TEXELS * TEXELS; i++) {
            mean[c] += linear(albedo[i][c]) / (TEXELS * TEXELS);
        }
    }
    // Middles of tiles lie at quarters of u and v, middles of slopes 6 texels from the edge of a tile. A
    // normal n faces the sun by n · (2, 3, −6) / 7; slopes have the parts 0.6 and 0.8.
    const struct {
        float point[3];
        int tile;
        float facing, shine;
        const char *sentence;
    } rows[] = {
        {{-0.75f, 0, -2.25f}, 0, 3.0f / 7, 0, "floor: a tile's middle gets 3/7 of the sun"},
        {{-1 + 6.0f / 64, 0, -2.25f}, 0, 1.2f / 7, 0, "floor: the left slope of a tile gets 1.2/7"},
        {{-0.75f, 0, -2 - 26.0f / 64}, 0, 6.0f / 7, 0, "floor: the far slope of a tile gets 6/7"},
        {{-0.75f, 0, -2 - 6.0f / 64}, 0, 0, 0, "floor: the near slope of a tile gets nothing"},
        {{-2, 1.25f, -4.25f}, 1, 2.0f / 7, 0, "left wall: a tile's middle gets 2/7"},
        {{-2, 1.25f, -4 - 26.0f / 64}, 1, 5.2f / 7, 0, "left wall: the far slope gets 5.2/7"},
        {{-2, 1 + 6.0f / 64, -4.25f}, 1, 0, 0, "left wall: the lower slope gets nothing"},
        {{2, 1.25f, -4.25f}, 1, 0, 0, "right wall: a tile's middle is in shade"},
        {{2, 1.25f, -3 - 26.0f / 64}, 1, 2.0f / 7, 0, "right wall: the far slope gets 2/7"},
        // The floor mirrors the sun where the eye, 1.5 high, lies towards (−2, 3, 6) / 7.
        {{1.25f, 0, -2.75f}, 1, 3.0f / 7, 0.5f, "floor: the sun is mirrored at (1.25, 0, -2.75)"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const float *of_tile = albedo_of[rows[i].tile];
        check(outside, shows(material, pixels, rows[i].point, of_tile, rows[i].facing, rows[i].shine),
              rows[i].sentence);
    }
    static const float far[3] = {0, 0, -50};
    check(outside, shows(material, pixels, far, mean, 3.0f / 7, 0), "far away: the mean of all texels");
}

int main(int argc, char **argv)
{
    struct outside outside = outside_options(argc, argv);
    rhw_context *context;
    must(rhw_context_create(&outside.context_def, &context), "context");
    static unsigned char albedo[TEXELS][TEXELS][4], normals[TEXELS][TEXELS][4];
    make_texels(albedo, normals);
    const struct rhw_texture_def picture_def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = 2 * SIZE, .height = SIZE, .label = "picture"};
    rhw_texture picture;
    must(rhw_texture_create(context, &picture_def, &picture), picture_def.label);

    struct material material = {.eye = {0.25f, 1.5f, 0.25f},
                                .towards = {2.0f / 7, 3.0f / 7, -6.0f / 7},
                                .ambient = 0.25f,
                                .shine = 0.5f,
                                .sharpness = 48};
    float view[16], projection[16];
    matrix_look_at(material.eye, (float[]){0, 0.6f, -6}, (float[]){0, 1, 0}, view);
    matrix_perspective(1, 1, 0.1f, 100, projection);
    matrix_mul(projection, view, material.camera);
    draw(context, &material, make_texture(context, RHW_FORMAT_RGBA8_SRGB, albedo),
         make_texture(context, RHW_FORMAT_RGBA8_UNORM, normals), picture);

    unsigned char(*pixels)[4] = outside_show(&outside, context, "normal_map", picture);
    int different = 0;
    for (int i = 0; i < 2 * SIZE * SIZE; i += 2 * SIZE) {
        different += memcmp(pixels[i], pixels[i + SIZE], 4 * SIZE) != 0;
    }
    check(&outside, different == 0, "both halves have the same bytes");
    check_pixels(&outside, &material, pixels, albedo[0]);
    free(pixels);
    rhw_context_destroy(context);
    return outside.failures != 0;
}
