// SPDX-License-Identifier: MIT
// Deferred shading: a first pass writes albedo, normal and depth of what is seen into three targets, the G-buffer; a
// second one draws a cube around each of 101 point lights, whose fragments read the G-buffer and add what the light
// gives; a last one adds the ambient light. Of cubes the far sides are drawn, tested against the first pass's depth.
// Normals, depths and the light under a lamp are worked out by hand.
#include "deferred.h"
#include "deferred_scene.h"
#include "matrix.h"
#include "outside.h"

enum { STORE, LIGHT, RESOLVE, PASSES };

static void make_pipelines(rhw_context *context, rhw_pipeline pipelines[PASSES])
{
    const struct rhw_blend_component add = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    const struct rhw_pipeline_def defs[PASSES] = {
        [STORE] = {.program = {.vertex = RHW_ISA_TABLE(deferred_place),
                               .fragment = RHW_ISA_TABLE(deferred_store),
                               .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                            RHW_VARYING(struct surface, albedo, RHW_FLAT, false)},
                               .varying_count = 2,
                               .uses = RHW_USE_COORD,
                               .uniform_size = sizeof(struct view)},
                   .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, position)},
                                  {RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, normal)},
                                  {RHW_VERTEX_FLOAT3, 1, offsetof(struct thing, center)},
                                  {RHW_VERTEX_FLOAT1, 1, offsetof(struct thing, scale)},
                                  {RHW_VERTEX_FLOAT3, 1, offsetof(struct thing, albedo)}},
                   .attribute_count = 5,
                   .buffers = {{.stride = sizeof(struct corner)},
                               {.stride = sizeof(struct thing), .per_instance = true}},
                   .buffer_count = 2,
                   .cull = RHW_CULL_BACK,
                   .depth_test = true,
                   .targets = {[SLOT_ALBEDO] = {.format = RHW_FORMAT_RGBA8_UNORM},
                               [SLOT_NORMAL] = {.format = RHW_FORMAT_RGBA16_FLOAT},
                               [SLOT_DEPTH] = {.format = RHW_FORMAT_R32_FLOAT}},
                   .target_count = 3,
                   .label = "store"},
        // A light reaches what lies before the far side of its cube: this side is drawn where its depth is greater.
        [LIGHT] = {.program = {.vertex = RHW_ISA_TABLE(deferred_volume),
                               .fragment = RHW_ISA_TABLE(deferred_light),
                               .varyings = {RHW_VARYING(struct glow, center, RHW_FLAT, false),
                                            RHW_VARYING(struct glow, radius, RHW_FLAT, false),
                                            RHW_VARYING(struct glow, color, RHW_FLAT, false)},
                               .varying_count = 3,
                               .uses = RHW_USE_COORD,
                               .uniform_size = sizeof(struct view)},
                   .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, position)},
                                  {RHW_VERTEX_FLOAT3, 1, offsetof(struct light, center)},
                                  {RHW_VERTEX_FLOAT1, 1, offsetof(struct light, radius)},
                                  {RHW_VERTEX_FLOAT3, 1, offsetof(struct light, color)}},
                   .attribute_count = 4,
                   .buffers = {{.stride = sizeof(struct corner)},
                               {.stride = sizeof(struct light), .per_instance = true}},
                   .buffer_count = 2,
                   .cull = RHW_CULL_FRONT,
                   .depth_test = true,
                   .depth_compare = RHW_COMPARE_GREATER,
                   .depth_read_only = true,
                   .targets = {{RHW_FORMAT_RGBA16_FLOAT, .blend = true, .color = add, .alpha = add}},
                   .target_count = 1,
                   .label = "light"},
        [RESOLVE] = {.program = {.vertex = RHW_ISA_TABLE(deferred_screen),
                                 .fragment = RHW_ISA_TABLE(deferred_resolve),
                                 .uses = RHW_USE_COORD,
                                 .uniform_size = sizeof(struct view)},
                     .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
                     .target_count = 1,
                     .label = "resolve"},
    };
    for (int i = 0; i < PASSES; i++) {
        must(rhw_pipeline_create(context, &defs[i], &pipelines[i]), defs[i].label);
    }
}

static rhw_buffer make_buffer(rhw_context *context, const void *data, size_t size, const char *label)
{
    const struct rhw_buffer_def def = {.size = size, .data = data, .label = label};
    rhw_buffer buffer;
    must(rhw_buffer_create(context, &def, &buffer), label);
    return buffer;
}

static rhw_texture make_texture(rhw_context *context, enum rhw_format format, const char *label)
{
    const struct rhw_texture_def def = {.format = format, .width = WIDTH, .height = HEIGHT, .label = label};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), label);
    return texture;
}

// What the passes write: the G-buffer and the light by their slots, the depth that is tested, the picture.
struct frame {
    rhw_texture slots[4], depth, picture;
};

static void draw(rhw_context *context, const struct view *view, const struct thing *things,
                 const struct light *lights, const struct frame *frame)
{
    static struct meshes meshes;
    make_meshes(&meshes);
    const rhw_buffer corners = make_buffer(context, meshes.corners, sizeof meshes.corners, "corners");
    const rhw_buffer indices = make_buffer(context, meshes.indices, sizeof meshes.indices, "indices");
    const rhw_buffer thing_buffer = make_buffer(context, things, (1 + BALLS) * sizeof *things, "things");
    const rhw_buffer light_buffer = make_buffer(context, lights, LIGHTS * sizeof *lights, "lights");
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST,
                                            .mip_filter = RHW_MIP_FILTER_NONE,
                                            .address_u = RHW_ADDRESS_CLAMP,
                                            .address_v = RHW_ADDRESS_CLAMP};
    rhw_sampler sampler;
    must(rhw_sampler_create(context, &nearest, &sampler), "sampler");

    const struct rhw_pass_def defs[PASSES] = {
        [STORE] = {.colors = {[SLOT_ALBEDO] = {.texture = frame->slots[SLOT_ALBEDO]},
                              [SLOT_NORMAL] = {.texture = frame->slots[SLOT_NORMAL]},
                              [SLOT_DEPTH] = {.texture = frame->slots[SLOT_DEPTH], .clear = {1}}},
                   .color_count = 3,
                   .depth = {.enabled = true, .texture = frame->depth},
                   .label = "store"},
        [LIGHT] = {.colors = {{.texture = frame->slots[SLOT_LIGHT]}},
                   .color_count = 1,
                   .depth = {.enabled = true, .texture = frame->depth, .load = RHW_LOAD_LOAD},
                   .label = "light"},
        [RESOLVE] = {.colors = {{.texture = frame->picture}}, .color_count = 1, .label = "resolve"},
    };
    static const int readable[PASSES] = {0, SLOT_LIGHT, SLOT_LIGHT + 1}; // slots that earlier passes filled
    rhw_pipeline pipelines[PASSES];
    make_pipelines(context, pipelines);
    for (int p = 0; p < PASSES; p++) {
        rhw_pass pass;
        must(rhw_pass_begin(context, &defs[p], &pass), defs[p].label);
        rhw_pass_set_pipeline(context, pass, pipelines[p]);
        rhw_pass_set_uniforms(context, pass, view, sizeof *view);
        rhw_pass_set_vertex_buffer(context, pass, 0, corners, 0);
        rhw_pass_set_index_buffer(context, pass, indices, RHW_INDEX_UINT16, 0);
        for (int slot = 0; slot < readable[p]; slot++) {
            rhw_pass_set_texture(context, pass, slot, frame->slots[slot], sampler);
        }
        if (p == STORE) {
            rhw_pass_set_vertex_buffer(context, pass, 1, thing_buffer, 0);
            rhw_pass_draw_indexed(context, pass, BALL_INDICES, 6, BALL_VERTICES, 0, 1); // the floor
            rhw_pass_draw_indexed(context, pass, 0, BALL_INDICES, 0, 1, BALLS);
        } else if (p == LIGHT) {
            rhw_pass_set_vertex_buffer(context, pass, 1, light_buffer, 0);
            rhw_pass_draw_indexed(context, pass, BALL_INDICES + 6, 36, BALL_VERTICES + 4, 0, LIGHTS);
        } else {
            rhw_pass_draw(context, pass, 0, 3, 0, 1);
        }
        must(rhw_pass_end(context, pass, NULL), defs[p].label);
    }
}

// The value of a half that is 0 or normal, as all are here.
static float from_half(uint16_t half)
{
    const int32_t magnitude = half & 0x7fff ? ((half & 0x7fff) << 13) + (112 << 23) : 0;
    return rhw_float_from_bits1(magnitude | (int32_t)((uint32_t)(half >> 15) << 31));
}

static int pixel_of(const struct view *view, float x, float y, float z)
{
    float landed[3];
    matrix_land(view->camera, (float[]){x, y, z}, WIDTH, HEIGHT, landed);
    return (int)landed[1] * WIDTH + (int)landed[0];
}

static bool close(float a, float b, float within)
{
    return rhw_abs1(a - b) <= within;
}

// Whether a pixel of the floor has the light of all lamps: the sum over all of them where its ray meets y = 0.
static bool floor_is_lit(const struct view *view, const struct light *lights, int pixel, uint16_t light[4])
{
    const float x = (float)(pixel % WIDTH) + 0.5f, y = (float)(pixel / WIDTH) + 0.5f;
    float ray[3], sum[3] = {0};
    for (int i = 0; i < 3; i++) {
        ray[i] = view->corner[i] + x * view->right[i] + y * view->down[i];
    }
    const float far = -view->eye[1] / ray[1];
    for (int i = 0; i < LIGHTS; i++) {
        const float towards[3] = {lights[i].center[0] - (view->eye[0] + far * ray[0]), lights[i].center[1],
                                  lights[i].center[2] - (view->eye[2] + far * ray[2])};
        const float square = rhw_dot3_1(towards, towards), radius = lights[i].radius;
        const float fade = rhw_max1(1 - square / (radius * radius), 0);
        for (int c = 0; c < 3; c++) {
            sum[c] += 0.5f * lights[i].color[c] * towards[1] / rhw_sqrt1(square) * fade * fade;
        }
    }
    bool lit = true;
    for (int c = 0; c < 3; c++) {
        lit &= close(from_half(light[c]), sum[c], 0.001f + 0.005f * sum[c]);
    }
    return lit;
}

// The code of a linear value in sRGB.
static float code(float linear)
{
    return 255 * (1.055f * rhw_pow1(linear, 1 / 2.4f) - 0.055f);
}

int main(int argc, char **argv)
{
    struct outside outside = outside_options(argc, argv);
    rhw_context *context;
    must(rhw_context_create(&outside.context_def, &context), "context");
    struct view view;
    struct thing things[1 + BALLS];
    struct light lights[LIGHTS];
    make_view(&view);
    make_scene(things, lights);
    const struct frame frame = {.slots = {make_texture(context, RHW_FORMAT_RGBA8_UNORM, "albedo"),
                                          make_texture(context, RHW_FORMAT_RGBA16_FLOAT, "normal"),
                                          make_texture(context, RHW_FORMAT_R32_FLOAT, "depth"),
                                          make_texture(context, RHW_FORMAT_RGBA16_FLOAT, "light")},
                                .depth = make_texture(context, RHW_FORMAT_D32_FLOAT, "tested depth"),
                                .picture = make_texture(context, RHW_FORMAT_RGBA8_SRGB, "picture")};
    draw(context, &view, things, lights, &frame);
    uint8_t(*albedo)[4] = outside_show(&outside, context, "deferred.albedo", frame.slots[SLOT_ALBEDO]);
    uint16_t(*normal)[4] = outside_show(&outside, context, "deferred.normal", frame.slots[SLOT_NORMAL]);
    float *depth = outside_show(&outside, context, "deferred.depth", frame.slots[SLOT_DEPTH]);
    uint16_t(*light)[4] = outside_show(&outside, context, "deferred.light", frame.slots[SLOT_LIGHT]);
    uint8_t(*picture)[4] = outside_show(&outside, context, "deferred", frame.picture);

    // The depth that the shader wrote as a colour is the one that was tested, bit by bit.
    float *tested = malloc(WIDTH * HEIGHT * sizeof *tested);
    must(tested ? rhw_texture_read(context, frame.depth, 0, tested, 0) : RHW_ERROR_OUT_OF_MEMORY, "read");
    check(&outside, memcmp(depth, tested, WIDTH * HEIGHT * sizeof *tested) == 0, "coord[2] is the depth");

    // Under the lamp by itself, which hangs 1 high and reaches 2 far: (1 − 1/4)², on grey of 1/2.
    const int under = pixel_of(&view, 6, 0, 0);
    float landed[3];
    matrix_land(view.camera, (float[]){6, 0, 0}, WIDTH, HEIGHT, landed);
    check(&outside, close(depth[under], landed[2], 0.0005f), "depth of the floor");
    check(&outside, albedo[under][0] == 128 && albedo[under][3] == 255, "albedo of the floor");
    check(&outside, normal[under][0] == 0 && normal[under][1] == 0x3c00 && normal[under][2] == 0,
          "the floor's normal is (0, 1, 0)");
    for (int c = 0; c < 3; c++) {
        const float expected = 0.5f * lights[LIGHTS - 1].color[c] * 0.5625f;
        check(&outside, close(from_half(light[under][c]), expected, 0.002f), "light under the lamp");
        check(&outside, close(picture[under][c], code(0.03125f + expected), 1), "picture under the lamp");
    }
    check(&outside, from_half(light[under][3]) == 1, "one lamp was asked there");

    // The ball in the middle, at (0, 0.5, 0): on it a normal is the direction from its centre.
    const int on_ball = pixel_of(&view, 0, 0.5f + 0.5f * 0.6f, 0.5f * 0.8f);
    for (int i = 0; i < 3; i++) {
        check(&outside, close(from_half(normal[on_ball][i]), (float[]){0, 0.6f, 0.8f}[i], 0.03f),
              "the ball's normal where it is (0, 0.6, 0.8)");
    }

    // Far from all lamps nothing is asked, and the ambient light is left.
    const int dark = pixel_of(&view, -5, 0, -7);
    check(&outside, from_half(light[dark][3]) == 0, "no lamp is asked at (−5, 0, −7)");
    check(&outside, close(picture[dark][0], code(0.03125f), 1), "ambient light at (−5, 0, −7)");

    int floor = 0, wrong = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i += 7) {
        if (normal[i][1] == 0x3c00 && albedo[i][0] == 128) {
            floor++;
            wrong += !floor_is_lit(&view, lights, i, light[i]);
        }
    }
    check(&outside, floor > 10000 && wrong == 0, "the light of all lamps on the floor");

    free(albedo);
    free(normal);
    free(depth);
    free(light);
    free(picture);
    free(tested);
    rhw_context_destroy(context);
    return outside.failures != 0;
}
