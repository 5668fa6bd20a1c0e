// SPDX-License-Identifier: MIT
// Shadows from a depth map: a pass without colours draws the scene as the sun sees it, and a second one samples that
// depth as a texture, 3 × 3 texels around each point, to find what the sun reaches. All boxes, the ground among them,
// are instances of one draw. Where shadows end is worked out by hand.
#include "shadow_map.h"
#include "matrix.h"
#include "outside.h"

enum { WIDTH = 640, HEIGHT = 400, MAP = 512 };

struct corner {
    float position[3], normal[3];
};

struct box {
    float center[3], half[3], albedo[3];
};

static const struct box boxes[] = {
    {{0, -0.1f, 0}, {5, 0.1f, 5}, {0.8f, 0.8f, 0.8f}}, // the ground: its top is y = 0
    {{0, 0.5f, 0}, {0.5f, 0.5f, 0.5f}, {0.9f, 0.3f, 0.2f}},
    {{-2, 1, -1}, {0.3f, 1, 0.3f}, {0.2f, 0.5f, 0.9f}},
    {{1.5f, 1.7f, -2}, {1, 0.1f, 0.6f}, {0.3f, 0.8f, 0.3f}}, // hangs in the air
};
enum { BOXES = sizeof boxes / sizeof boxes[0] };

// 4 corners for each of 6 faces, counter-clockwise seen from outside, and two triangles of each.
static void make_cube(struct corner corners[24], uint8_t indices[36])
{
    static const uint8_t quad[6] = {0, 1, 2, 0, 2, 3};
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2;
        const float side = face % 2 ? 1.0f : -1.0f;
        for (int i = 0; i < 4; i++) {
            struct corner *corner = &corners[4 * face + i];
            const float u = i == 1 || i == 2 ? 1.0f : -1.0f, v = i >= 2 ? 1.0f : -1.0f;
            *corner = (struct corner){{0}, {0}};
            corner->normal[axis] = corner->position[axis] = side;
            corner->position[(axis + 1) % 3] = u * side;
            corner->position[(axis + 2) % 3] = v;
        }
        for (int i = 0; i < 6; i++) {
            indices[6 * face + i] = (uint8_t)(4 * face + quad[i]);
        }
    }
}

static void make_sun(struct sun *sun)
{
    static const float up[3] = {0, 1, 0}, middle[3] = {0, 0, 0};
    static const float eye[3] = {3.5f, 4.5f, 6.5f};
    static const float high[3] = {-4, 8,
                                  0}; // rays go by (1, −2, 0): shadows are half as long as things are high
    float view[16], projection[16];
    matrix_look_at(eye, middle, up, view);
    matrix_perspective(0.75f, (float)WIDTH / HEIGHT, 0.5f, 50, projection);
    matrix_mul(projection, view, sun->camera);
    matrix_look_at(high, middle, up, view);
    matrix_orthographic(6, 6, 1, 17, projection);
    matrix_mul(projection, view, sun->light);
    rhw_normalize3_1(high, sun->towards);
    sun->ambient = 0.25f;
    sun->texel = 1.0f / MAP;
    sun->bias = 0.003f;
}

// The pass from the sun when `lit` is false: depth alone, neither a fragment function nor a target.
static rhw_pipeline make_pipeline(rhw_context *context, bool lit)
{
    struct rhw_pipeline_def def = {
        .program = {.vertex = RHW_ISA_TABLE(shadow_cast), .uniform_size = sizeof(struct sun)},
        .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, position)},
                       {RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, normal)},
                       {RHW_VERTEX_FLOAT3, 1, offsetof(struct box, center)},
                       {RHW_VERTEX_FLOAT3, 1, offsetof(struct box, half)},
                       {RHW_VERTEX_FLOAT3, 1, offsetof(struct box, albedo)}},
        .attribute_count = 5,
        .buffers = {{.stride = sizeof(struct corner)}, {.stride = sizeof(struct box), .per_instance = true}},
        .buffer_count = 2,
        .cull = RHW_CULL_BACK,
        .depth_test = true,
        .label = "cast",
    };
    if (lit) {
        def.label = "lit";
        def.program = (struct rhw_program){
            .vertex = RHW_ISA_TABLE(shadow_place),
            .fragment = RHW_ISA_TABLE(shadow_light),
            .varyings = {RHW_VARYING(struct ground, world, RHW_SMOOTH, false),
                         RHW_VARYING(struct ground, normal, RHW_FLAT, false),
                         RHW_VARYING(struct ground, albedo, RHW_FLAT, false)},
            .varying_count = 3,
            .uniform_size = sizeof(struct sun),
        };
        def.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
        def.target_count = 1;
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), def.label);
    return pipeline;
}

static rhw_texture make_texture(rhw_context *context, enum rhw_format format, int width, int height)
{
    const struct rhw_texture_def def = {.format = format, .width = width, .height = height};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), "texture");
    return texture;
}

// Both passes: the map, then the picture that samples it.
static void draw(rhw_context *context, const struct sun *sun, rhw_texture map, rhw_texture picture)
{
    struct corner corners[24];
    uint8_t indices[36];
    make_cube(corners, indices);
    const struct rhw_buffer_def corner_def = {.size = sizeof corners, .data = corners};
    const struct rhw_buffer_def index_def = {.size = sizeof indices, .data = indices};
    const struct rhw_buffer_def box_def = {.size = sizeof boxes, .data = boxes};
    // Outside the map nothing casts a shadow: the border is as far away as can be.
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_NEAREST,
                                                .mag_filter = RHW_FILTER_NEAREST,
                                                .mip_filter = RHW_MIP_FILTER_NONE,
                                                .address_u = RHW_ADDRESS_BORDER,
                                                .address_v = RHW_ADDRESS_BORDER,
                                                .border = {1, 1, 1, 1}};
    rhw_buffer corner_buffer, index_buffer, box_buffer;
    rhw_sampler sampler;
    must(rhw_buffer_create(context, &corner_def, &corner_buffer), "corners");
    must(rhw_buffer_create(context, &index_def, &index_buffer), "indices");
    must(rhw_buffer_create(context, &box_def, &box_buffer), "boxes");
    must(rhw_sampler_create(context, &sampler_def, &sampler), "sampler");

    const struct rhw_pass_def map_def = {.depth = {.enabled = true, .texture = map}, .label = "map"};
    const struct rhw_pass_def picture_def = {
        .colors = {{.texture = picture, .clear = {0.5f, 0.65f, 0.8f, 1}}},
        .color_count = 1,
        .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
        .label = "picture",
    };
    for (int lit = 0; lit < 2; lit++) {
        rhw_pass pass;
        must(rhw_pass_begin(context, lit ? &picture_def : &map_def, &pass), "begin");
        rhw_pass_set_pipeline(context, pass, make_pipeline(context, lit));
        rhw_pass_set_vertex_buffer(context, pass, 0, corner_buffer, 0);
        rhw_pass_set_vertex_buffer(context, pass, 1, box_buffer, 0);
        rhw_pass_set_index_buffer(context, pass, index_buffer, RHW_INDEX_UINT8, 0);
        rhw_pass_set_uniforms(context, pass, sun, sizeof *sun);
        if (lit) {
            rhw_pass_set_texture(context, pass, 0, map, sampler);
        }
        rhw_pass_draw_indexed(context, pass, 0, 36, 0, 0, BOXES);
        must(rhw_pass_end(context, pass, NULL), "end");
    }
}

// The red code of the picture where a point of the world lands.
static int red_at(const struct sun *sun, uint8_t (*pixels)[4], float x, float y, float z)
{
    float landed[3];
    matrix_land(sun->camera, (float[]){x, y, z}, WIDTH, HEIGHT, landed);
    return pixels[(int)landed[1] * WIDTH + (int)landed[0]][0];
}

// The code of a linear value in sRGB.
static int code(float linear)
{
    return (int)(255 * (1.055f * rhw_pow1(linear, 1 / 2.4f) - 0.055f) + 0.5f);
}

static bool near(int a, int b)
{
    return abs(a - b) <= 1;
}

int main(int argc, char **argv)
{
    struct outside outside = outside_options(argc, argv);
    rhw_context *context;
    must(rhw_context_create(&outside.context_def, &context), "context");
    const rhw_texture map = make_texture(context, RHW_FORMAT_D32_FLOAT, MAP, MAP);
    const rhw_texture picture = make_texture(context, RHW_FORMAT_RGBA8_SRGB, WIDTH, HEIGHT);
    struct sun sun;
    make_sun(&sun);
    draw(context, &sun, map, picture);
    float *depth = outside_show(&outside, context, "shadow_map.map", map);
    uint8_t(*pixels)[4] = outside_show(&outside, context, "shadow_map", picture);

    // A ray goes 1 to the right for 2 down: the red box, whose right edge is at (0.5, 1), throws its shadow to x = 1.
    const float sine = 2 / rhw_sqrt1(5); // of the sun's height over the ground
    const int shade = code(0.8f * 0.25f), sunny = code(0.8f * (0.25f + 0.75f * sine));
    check(&outside, near(red_at(&sun, pixels, 0.9f, 0, 0), shade), "the ground at x = 0.9 is in shadow");
    check(&outside, near(red_at(&sun, pixels, 1.1f, 0, 0), sunny), "the ground at x = 1.1 is in the sun");
    // The plate's underside is 1.6 high, its top 1.8: its shadow reaches from 0.5 + 0.8 to 2.5 + 0.9.
    check(&outside, near(red_at(&sun, pixels, 1.4f, 0, -1.6f), shade), "shadow of the plate begins");
    check(&outside, near(red_at(&sun, pixels, 1.2f, 0, -1.6f), sunny), "sun left of the plate's shadow");
    check(&outside, near(red_at(&sun, pixels, 3.3f, 0, -1.6f), shade), "shadow of the plate ends");
    check(&outside, near(red_at(&sun, pixels, 3.5f, 0, -1.6f), sunny), "sun right of the plate's shadow");
    // The sun is √80 away from the middle, and the box's top is nearer by what 1 up is along the ray: 2 / √5.
    float landed[3];
    matrix_land(sun.light, (float[]){0, 1, 0}, MAP, MAP, landed);
    const float found = depth[(int)landed[1] * MAP + (int)landed[0]];
    const float expected = (rhw_sqrt1(80) - sine - 1) / 16;
    check(&outside, rhw_abs1(found - expected) < 0.001f, "depth of the red box's top in the map");

    free(depth);
    free(pixels);
    rhw_context_destroy(context);
    return outside.failures != 0;
}
