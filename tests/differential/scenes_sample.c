// SPDX-License-Identifier: MIT
// Several samples a pixel, resolved: four, and as many as the peer has.
#include <string.h>

#include "scenes.h"

static void begin(struct frame *f, const struct shader_pair *shaders)
{
    frame_begin(f, 256, 256);
    f->samples = 4;
    frame_add_triangles(f, 150, 100);
    frame_add_draw(f, frame_draw_default(f, shaders));
}

static void coverage(struct frame *f)
{
    begin(f, &flat_color);
}

static void values(struct frame *f)
{
    begin(f, &smooth_color);
}

static void paint_smooth(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying, sizeof f->color[0]);
}

static const struct shader_pair sample_color = {.fragment = "out vec4 color; void main() { color = values; }",
                                                .fragment1 = paint_smooth,
                                                .sampling = RHW_SAMPLING_SAMPLE};
static const struct shader_pair centroid_color = {.fragment =
                                                      "out vec4 color; void main() { color = values; }",
                                                  .fragment1 = paint_smooth,
                                                  .sampling = RHW_SAMPLING_CENTROID};

static void sample_values(struct frame *f)
{
    begin(f, &sample_color);
}

static void centroid_values(struct frame *f)
{
    begin(f, &centroid_color);
}

// Two large triangles alone: whatever is outside of one is black, so that a value from outside would show.
static void centroid_in(struct frame *f)
{
    static const float low[4] = {0, 0, 0, 1}, high[4] = {16, 16, 16, 1};
    frame_begin(f, 128, 128);
    f->samples = 4;
    frame_add_quad(f, 10 + 70.0 / 256, 12 + 90.0 / 256, 3, 100, 0, low, high);
    frame_add_quad(f, 20 + 30.0 / 256, 12 + 200.0 / 256, 100, 2, 0, low, high);
    frame_add_draw(f, frame_draw_default(f, &centroid_color));
}

static void paint_position(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->sample_position[0];
    f->color[0][1] = f->sample_position[1];
    f->color[0][2] = (float)f->sample_id / 4;
    f->color[0][3] = 1;
}

static const struct shader_pair position_color = {
    .fragment = "out vec4 color;\n"
                "void main() { color = vec4(gl_SamplePosition, float(gl_SampleID) / 4.0, 1); }",
    .fragment1 = paint_position,
    .uses = RHW_USE_SAMPLE};

static void positions(struct frame *f)
{
    begin(f, &position_color);
}

static void depth(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->samples = 4;
    f->depth_format = RHW_FORMAT_D24_UNORM_S8_UINT;
    frame_add_triangles(f, 150, 100);
    for (int v = 0; v < f->vertex_count; v++) {
        f->vertices[v].position[2] = 2 * frame_random_part(f) - 1;
    }
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.depth_test = true;
    draw.state.stencil_test = true;
    draw.state.stencil_front.pass = RHW_STENCIL_INCREMENT_WRAP;
    frame_add_draw(f, draw);
    draw.state.stencil_front.compares = draw.state.stencil_back.compares = true;
    draw.state.stencil_front.compare = draw.state.stencil_back.compare = RHW_COMPARE_EQUAL;
    draw.reference_front = draw.reference_back = 1;
    frame_add_triangles(f, 60, 100);
    frame_add_draw(f, draw);
}

static void masked(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->samples = 4;
    for (int mask = 1; mask < 16; mask++) {
        struct frame_draw draw = frame_draw_default(f, &flat_color);
        draw.state.sample_mask = (uint32_t)mask;
        frame_add_triangles(f, 12, 100);
        frame_add_draw(f, draw);
    }
}

// Alpha at the middles of the steps to no, one .. all samples.
static void alpha(struct frame *f)
{
    frame_begin(f, 128, 128);
    f->samples = 4;
    for (int i = 0; i < 5; i++) {
        const float color[4] = {1, 0.5f, 0.25f, (float)i / 4};
        frame_add_quad(f, 24 * i + 2, 8, 20, 100, 0, color, color);
    }
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.alpha_to_coverage = true;
    frame_add_draw(f, draw);
}

static void paint_masked(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
    f->sample_mask = ((int32_t)(f->varying[4] * 256) & 15) & f->sample_mask;
}

static const struct shader_pair mask_color = {
    .fragment = "out vec4 color; void main() { color = flat_values;\n"
                "gl_SampleMask[0] = (int(flat_values.x * 256.0) & 15) & gl_SampleMaskIn[0]; }",
    .fragment1 = paint_masked,
    .uses = RHW_USE_SAMPLE_MASK};

static void mask_out(struct frame *f)
{
    begin(f, &mask_color);
}

static void blended(struct frame *f)
{
    begin(f, &smooth_color);
    f->draws[0].state.targets[0].blend = true;
    f->draws[0].state.targets[0].color = f->draws[0].state.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_MAX};
}

static void srgb(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->formats[0] = RHW_FORMAT_RGBA8_SRGB;
    f->samples = 4;
    frame_add_triangles(f, 100, 100);
    frame_add_draw(f, frame_draw_default(f, &flat_color));
}

static void halves(struct frame *f)
{
    srgb(f);
    f->formats[0] = f->draws[0].state.targets[0].format = RHW_FORMAT_RGBA16_FLOAT;
}

static void begin_with(struct frame *f, const struct shader_pair *shaders, int samples)
{
    begin(f, shaders);
    f->samples = samples;
}

static void values_2(struct frame *f)
{
    begin_with(f, &sample_color, 2);
}

static void values_8(struct frame *f)
{
    begin_with(f, &sample_color, 8);
}

static void values_16(struct frame *f)
{
    begin_with(f, &sample_color, 16);
}

static void positions_2(struct frame *f)
{
    begin_with(f, &position_color, 2);
}

static void positions_8(struct frame *f)
{
    begin_with(f, &position_color, 8);
}

static void positions_16(struct frame *f)
{
    begin_with(f, &position_color, 16);
}

struct scene_list sample_scenes(void)
{
    static const struct scene scenes[] = {
        {"4 samples: coverage", coverage, NULL, 0, 0},
        {"4 samples: values", values, NULL, 0, 0},
        {"4 samples: values at samples", sample_values, NULL, 0, 0},
        {"4 samples: values at centroids", centroid_values, NULL, 0, 0},
        {"4 samples: centroids within", centroid_in, NULL, 0, 0},
        {"4 samples: ids and positions", positions, NULL, 0, 0},
        {"4 samples: depth and stencil", depth, NULL, 0, 0},
        {"4 samples: sample mask", masked, NULL, 0, 0},
        {"4 samples: alpha to coverage", alpha, NULL, 0, 0},
        {"4 samples: gl_SampleMask", mask_out, NULL, 0, 0},
        {"4 samples: blending", blended, NULL, 0, 0},
        {"4 samples: sRGB", srgb,
         "the peer's polynomials for sRGB: a sample is stored up to a code off, decoded and, averaged, "
         "encoded again",
         10, 2},
        {"4 samples: RGBA16F", halves, NULL, 0, 0},
        {"2 samples: values at samples", values_2, NULL, 0, 0},
        {"2 samples: ids and positions", positions_2, NULL, 0, 0},
        {"8 samples: values at samples", values_8, NULL, 0, 0},
        {"8 samples: ids and positions", positions_8, NULL, 0, 0},
        {"16 samples: values at samples", values_16, NULL, 0, 0},
        {"16 samples: ids and positions", positions_16, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
