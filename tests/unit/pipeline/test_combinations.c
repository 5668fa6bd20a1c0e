// SPDX-License-Identifier: MIT
// The whole pipeline at random: passes whose state, formats, samples, layers, viewports and shader inputs have nothing
// to do with each other. Every path, instruction set, number of threads and way of waves gives the same bytes, counts
// of queries and effects. RHW_COMBINATIONS=n tries n passes instead of a few; RHW_COMBINATION=n pass n alone.
#include "harness.h"

#include <rhw/shader_storage.h>
#include <rhw/transfer.h>

#include <stdlib.h>
#include <string.h>

#include "format/format.h"

enum {
    PASSES = 500,
    WIDTH = 90,
    HEIGHT = 75,
    DRAWS_MOST = 7,
    VERTICES_MOST = 60,
    LAYERS_MOST = 3,
    COUNTERS = 4
};

// What a draw is made of besides its pipeline's definition. Lives as long as the pipeline: its functions read it.
struct combination {
    struct rhw_pipeline_def def;
    bool is_points, is_integer[RHW_MAX_COLOR_ATTACHMENTS];
};

static bool chance(uint64_t *random, int of)
{
    return rig_random_int(random, of) == 0;
}

// Shaders -----------------------------------------------------------------------------------------------

static void vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const struct combination *const of = v->user;
        memcpy(v->position, v->attribute[0], sizeof v->position);
        for (int c = 0; c < (of->def.program.varying_count > 0 ? 4 : 0); c++) {
            v->varying[c] = v->attribute[1][c];
        }
        for (int i = 0; i < of->def.program.clip_distance_count; i++) {
            v->clip_distance[i] = v->attribute[1][i % 4] + v->attribute[0][3] * (0.5f + (float)i);
        }
        for (int i = 0; i < of->def.program.cull_distance_count; i++) {
            v->cull_distance[i] = v->attribute[1][(i + 1) % 4];
        }
        if (of->def.program.writes_point_size) {
            v->point_size = v->attribute[1][2] * 20.0f;
        }
        if (of->def.program.writes_layer) {
            v->layer = v->vertex_index % 4 - (v->vertex_index & 1); // some are none
        }
        if (of->def.program.writes_viewport_index) {
            v->viewport_index = v->vertex_index % 3;
        }
    }
}

static void add_inputs(const struct rhw_fragment *f, uint32_t uses, bool is_points, rhw_float v[4])
{
    if (uses & RHW_USE_COORD) {
        v[0] += 0.01f * f->coord[0] + f->coord[2];
        v[1] += 0.01f * f->coord[1] + 0.1f * f->coord[3];
    }
    if (uses & RHW_USE_FACING) {
        v[1] *= rhw_select(f->front_facing, rhw_splat(1), rhw_splat(0.5f));
    }
    if (uses & RHW_USE_IDS) {
        v[2] += 0.125f * rhw_float_from_int((f->primitive + f->draw) & 7);
    }
    if (uses & RHW_USE_BARYCENTRIC) {
        v[0] += f->barycentric[1];
        v[3] = f->barycentric_noperspective[2];
    }
    if (uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
        v[1] += f->barycentric_ddx[0] + f->barycentric_ddy[2];
    }
    if (uses & RHW_USE_SAMPLE) {
        v[2] += 0.0625f * rhw_float_from_int(f->sample_id) + f->sample_position[0] - f->sample_position[1];
    }
    if (uses & RHW_USE_POINT_COORD && is_points) {
        v[0] *= f->point_coord[0] + f->point_coord[1];
    }
    if (uses & RHW_USE_FULLY_COVERED) {
        v[3] *= rhw_select(f->fully_covered, rhw_splat(1), rhw_splat(0.25f));
    }
    if (uses & RHW_USE_LAYER) {
        v[0] += 0.125f * rhw_float_from_int(f->layer + 4 * f->viewport_index);
    }
    if (uses & RHW_USE_DEPTH_INPUT) {
        v[0] += f->depth_input;
    }
    if (uses & RHW_USE_STENCIL_INPUT) {
        v[1] += rhw_float_from_int(f->stencil_input) / 256.0f;
    }
}

static void count_fragments(const struct rhw_fragment *f)
{
    const rhw_int at = rhw_int_from_float(f->coord[0]) & (COUNTERS - 1);
    rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, at, rhw_splat_int(1), f->mask);
}

static void decide(struct rhw_fragment *f, uint32_t uses, const rhw_float v[4])
{
    if (uses & RHW_USE_DISCARD) {
        f->mask &= rhw_less(v[1], rhw_splat(0.75f));
    }
    if (uses & RHW_USE_DEPTH) {
        f->depth = 0.5f * f->depth + 0.3f * v[3];
    }
    if (uses & RHW_USE_SAMPLE_MASK) {
        f->sample_mask &= rhw_int_from_float(v[2] * 4096.0f);
    }
}

static void fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const struct combination *const of = f->user;
        const struct rhw_program *const program = &of->def.program;
        rhw_float v[4];
        for (int c = 0; c < 4; c++) {
            const bool varies = program->varying_count > 0,
                       derives = varies && program->varyings[0].derivatives;
            v[c] = varies ? f->varying[c] : rhw_splat(0.2f * (float)(c + 1));
            v[c] += derives ? f->ddx[c] + f->ddy[3 - c] : rhw_splat(0);
        }
        add_inputs(f, program->uses, of->is_points, v);
        if (program->uses & RHW_USE_EFFECTS) {
            count_fragments(f);
        }
        for (int c = 0; c < 4; c++) {
            v[c] = rhw_clamp(v[c], rhw_splat(-0.5f), rhw_splat(1.25f));
        }
        decide(f, program->uses, v);
        for (int t = 0; t < (of->def.target_count > 1 ? of->def.target_count : 2); t++) {
            const bool blends = program->uses & RHW_USE_COLOR_INPUT && t < of->def.target_count;
            for (int c = 0; c < 4; c++) {
                const rhw_float value = v[(c + t) % 4];
                const rhw_int bits = rhw_int_from_float(value * 100.0f);
                f->color[t][c] = of->is_integer[t]
                                     ? (rhw_float)(blends ? bits ^ (rhw_int)f->color[t][c] : bits)
                                 : blends ? 0.5f * value + 0.5f * f->color[t][c]
                                          : value;
            }
        }
    }
}

// State -------------------------------------------------------------------------------------------------

static const enum rhw_format color_formats[] = {
    RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_RGBA8_UNORM,   RHW_FORMAT_RGBA8_SRGB,
    RHW_FORMAT_BGRA8_UNORM,  RHW_FORMAT_R8_UNORM,     RHW_FORMAT_RG8_SNORM,     RHW_FORMAT_RGBA32_FLOAT,
    RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_RGBA16_UNORM, RHW_FORMAT_RGB10A2_UNORM, RHW_FORMAT_RG11B10_FLOAT,
    RHW_FORMAT_RGB565_UNORM, RHW_FORMAT_RGB5A1_UNORM, RHW_FORMAT_R32_UINT,      RHW_FORMAT_RGBA8_SINT,
    RHW_FORMAT_RG16_UINT,    RHW_FORMAT_RGB10A2_UINT, RHW_FORMAT_R32_FLOAT,     RHW_FORMAT_RGBA32_SINT};
static const enum rhw_format depth_formats[] = {
    RHW_FORMAT_D32_FLOAT,         RHW_FORMAT_D32_FLOAT,         RHW_FORMAT_D16_UNORM, RHW_FORMAT_D24_UNORM,
    RHW_FORMAT_D24_UNORM_S8_UINT, RHW_FORMAT_D32_FLOAT_S8_UINT, RHW_FORMAT_S8_UINT};

#define ONE_OF(random, array) array[rig_random_int(random, (int)(sizeof array / sizeof array[0]))]

static bool has_depth(enum rhw_format format)
{
    return rhw_format_has_role(rhw_format_info(format), RHW_ROLE_DEPTH_TARGET);
}

static bool has_stencil(enum rhw_format format)
{
    return rhw_format_has_role(rhw_format_info(format), RHW_ROLE_STENCIL_TARGET);
}

static bool is_integer(enum rhw_format format)
{
    return rhw_format_is_integer(rhw_format_info(format));
}

// The attachments of a pass.
struct attachments {
    int samples, layers, count;
    bool resolves, keeps_too; // samples into the textures, or into others, where they are kept as well
    enum rhw_format colors[4], depth;
};

static struct attachments choose_attachments(uint64_t *random)
{
    struct attachments a = {.samples = chance(random, 3) ? 1 : 1 << rig_random_int(random, 5),
                            .layers = chance(random, 4) ? 1 + rig_random_int(random, LAYERS_MOST) : 1,
                            .count = chance(random, 2) ? 1 : rig_random_int(random, 5)};
    a.resolves = a.samples > 1 && chance(random, 2);
    a.keeps_too = a.samples > 1 && !a.resolves && chance(random, 2);
    for (int i = 0; i < a.count; i++) {
        a.colors[i] = ONE_OF(random, color_formats);
    }
    a.depth = a.count > 0 && chance(random, 4) ? RHW_FORMAT_NONE : ONE_OF(random, depth_formats);
    return a;
}

static void choose_inputs(struct rhw_program *program, const struct attachments *a, uint64_t *random)
{
    static const uint32_t uses[] = {RHW_USE_COORD,
                                    RHW_USE_FACING,
                                    RHW_USE_IDS,
                                    RHW_USE_BARYCENTRIC,
                                    RHW_USE_DISCARD,
                                    RHW_USE_DEPTH,
                                    RHW_USE_BARYCENTRIC_DERIVATIVES,
                                    RHW_USE_SAMPLE,
                                    RHW_USE_SAMPLE_MASK,
                                    RHW_USE_POINT_COORD,
                                    RHW_USE_FULLY_COVERED,
                                    RHW_USE_LAYER,
                                    RHW_USE_EFFECTS | RHW_USE_COORD,
                                    RHW_USE_COLOR_INPUT,
                                    RHW_USE_DEPTH_INPUT,
                                    RHW_USE_STENCIL_INPUT};
    for (int n = chance(random, 2) ? 0 : rig_random_int(random, 4); n > 0; n--) {
        program->uses |= ONE_OF(random, uses);
    }
    program->uses &= has_depth(a->depth) ? UINT32_MAX : ~(uint32_t)RHW_USE_DEPTH_INPUT;
    program->uses &= has_stencil(a->depth) ? UINT32_MAX : ~(uint32_t)RHW_USE_STENCIL_INPUT;
    program->varying_count = !chance(random, 6);
    if (program->varying_count > 0) {
        program->varyings[0] = (struct rhw_varying){
            .components = 4,
            .qualifier = (enum rhw_qualifier)(chance(random, 2) ? rig_random_int(random, 3) : 0),
            .derivatives = chance(random, 5),
            .sampling = (enum rhw_sampling)(chance(random, 3) ? rig_random_int(random, 3) : 0)};
    }
    program->early_fragment_tests = chance(random, 8);
    program->clip_distance_count = chance(random, 6) ? 1 + rig_random_int(random, 8) : 0;
    program->cull_distance_count = chance(random, 8) ? 1 + rig_random_int(random, 8) : 0;
    program->writes_point_size = chance(random, 2);
    program->writes_layer = a->layers > 1 && !chance(random, 4);
    program->writes_viewport_index = chance(random, 6);
}

static struct rhw_blend_component choose_blend(uint64_t *random, bool second)
{
    const int factors = second ? RHW_BLEND_ONE_MINUS_SRC1_ALPHA + 1 : RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA + 1;
    return (struct rhw_blend_component){(enum rhw_blend_factor)rig_random_int(random, factors),
                                        (enum rhw_blend_factor)rig_random_int(random, factors),
                                        (enum rhw_blend_operation)rig_random_int(random, 5)};
}

static struct rhw_stencil_face choose_face(uint64_t *random)
{
    const bool compares = chance(random, 2);
    struct rhw_stencil_face face = {.compares = compares,
                                    .compare = (enum rhw_compare)(compares ? rig_random_int(random, 8) : 0)};
    face.fail = (enum rhw_stencil_operation)rig_random_int(random, 8);
    face.depth_fail = (enum rhw_stencil_operation)rig_random_int(random, 8);
    face.pass = (enum rhw_stencil_operation)rig_random_int(random, 8);
    face.read_mask = (uint16_t)(chance(random, 3) ? rig_random_int(random, 257) : 0);
    face.write_mask = (uint16_t)(chance(random, 3) ? rig_random_int(random, 257) : 0);
    return face;
}

static void choose_raster(struct rhw_pipeline_def *def, uint64_t *random)
{
    def->topology =
        chance(random, 2) ? RHW_TRIANGLE_LIST : (enum rhw_topology)rig_random_int(random, RHW_LINE_LOOP + 1);
    def->primitive_restart = chance(random, 4);
    def->provoking = (enum rhw_provoking)rig_random_int(random, 2);
    def->polygon_mode = (enum rhw_polygon_mode)(chance(random, 4) ? rig_random_int(random, 3) : 0);
    def->line_width = chance(random, 2) ? rig_random_float(random, 1, 9) : 0;
    def->line_mode = (enum rhw_line_mode)rig_random_int(random, 3);
    def->line_stipple =
        (struct rhw_line_stipple){chance(random, 3) ? 1 + rig_random_int(random, 4) : 0, 0x72e5};
    def->conservative = (enum rhw_conservative)(chance(random, 6) ? rig_random_int(random, 3) : 0);
    def->cull = (enum rhw_cull)(chance(random, 4) ? rig_random_int(random, 4) : 0);
    def->front = (enum rhw_winding)rig_random_int(random, 2);
    def->depth_range = (enum rhw_depth_range)chance(random, 4);
    def->depth_clip_disabled = chance(random, 6);
    def->depth_clamp = chance(random, 6);
    def->rasterizer_discard = chance(random, 40);
}

static void choose_tests(struct rhw_pipeline_def *def, const struct attachments *a, uint64_t *random)
{
    def->depth_test = has_depth(a->depth) && !chance(random, 4);
    def->depth_compare = (enum rhw_compare)(chance(random, 2) ? rig_random_int(random, 8) : 0);
    def->depth_read_only = chance(random, 5);
    def->depth_bounds_test = has_depth(a->depth) && chance(random, 8);
    if (chance(random, 5)) {
        def->depth_bias =
            (struct rhw_depth_bias){rig_random_float(random, -1000, 1000), rig_random_float(random, -1, 1),
                                    chance(random, 2) ? rig_random_float(random, -0.01f, 0.01f) : 0};
    }
    def->stencil_test = has_stencil(a->depth) && !chance(random, 3);
    def->stencil_front = choose_face(random);
    def->stencil_back = choose_face(random);
    def->sample_mask = chance(random, 6) ? (uint32_t)rig_random(random) : 0;
    def->alpha_to_coverage = chance(random, 6);
    def->alpha_to_one = chance(random, 6);
}

static void choose_targets(struct rhw_pipeline_def *def, const struct attachments *a, uint64_t *random)
{
    def->target_count = a->count;
    def->logic = (enum rhw_logic)(chance(random, 8) ? rig_random_int(random, RHW_LOGIC_SET + 1) : 0);
    for (int t = 0; t < a->count; t++) {
        struct rhw_color_target *const target = &def->targets[t];
        target->format = a->colors[t];
        target->blend = !is_integer(target->format) && def->logic == RHW_LOGIC_OFF && chance(random, 2);
        if (target->blend) {
            const bool second = a->count == 1 && chance(random, 2);
            target->color = choose_blend(random, second);
            target->alpha = choose_blend(random, second);
        }
        target->write_mask = (uint8_t)(chance(random, 4) ? rig_random_int(random, 17) : 0);
    }
}

static void choose(struct combination *of, const struct rig *rig, const struct attachments *a,
                   uint64_t *random)
{
    *of = (struct combination){.def = rig->pipeline};
    struct rhw_pipeline_def *const def = &of->def;
    memset(&def->program, 0, sizeof def->program);
    memset(def->targets, 0, sizeof def->targets);
    def->program.vertex[RHW_ISA_BASELINE] = vertex;
    def->program.user = of;
    choose_raster(def, random);
    choose_tests(def, a, random);
    choose_targets(def, a, random);
    choose_inputs(&def->program, a, random);
    if (chance(random, 12)) { // no fragment function
        for (int t = 0; t < a->count; t++) {
            def->targets[t] = (struct rhw_color_target){.format = a->colors[t], .write_mask = RHW_WRITE_NONE};
        }
        def->alpha_to_coverage = false;
        def->program.uses = 0;
    } else {
        def->program.fragment[RHW_ISA_BASELINE] = fragment;
    }
    of->is_points = def->topology == RHW_POINT_LIST;
    for (int t = 0; t < a->count; t++) {
        of->is_integer[t] = is_integer(a->colors[t]);
    }
}

// Passes ------------------------------------------------------------------------------------------------

static rhw_texture make_texture(struct rig *rig, enum rhw_format format, int samples, int layers)
{
    const struct rhw_texture_def def = {
        .format = format, .width = WIDTH, .height = HEIGHT, .samples = samples, .layers = layers};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void attach(struct rig *rig, const struct attachments *a, uint64_t *random)
{
    const int kept = a->resolves ? 1 : a->samples;
    rig->pass = (struct rhw_pass_def){.color_count = a->count, .samples = a->samples};
    if (chance(random, 4)) {
        const int x = rig_random_int(random, WIDTH), y = rig_random_int(random, HEIGHT);
        rig->pass.render_area = (struct rhw_rect){x, y, 1 + rig_random_int(random, WIDTH - x),
                                                  1 + rig_random_int(random, HEIGHT - y)};
    }
    for (int i = 0; i < a->count; i++) {
        struct rhw_color_attachment *const color = &rig->pass.colors[i];
        color->texture = make_texture(rig, a->colors[i], kept, a->layers);
        color->layer_count = a->layers;
        if (a->keeps_too) {
            color->resolve = make_texture(rig, a->colors[i], 1, a->layers);
        }
        for (int c = 0; c < 4; c++) {
            color->clear[c] = is_integer(a->colors[i]) ? 0 : rig_random_float(random, 0, 1);
        }
    }
    if (a->depth != RHW_FORMAT_NONE) {
        rig->pass.depth =
            (struct rhw_depth_attachment){.enabled = true,
                                          .texture = make_texture(rig, a->depth, kept, a->layers),
                                          .load = RHW_LOAD_CLEAR,
                                          .clear = chance(random, 3) ? 0.5f : 1,
                                          .stencil_clear = (uint8_t)rig_random_int(random, 256),
                                          .layer_count = a->layers};
        if (a->keeps_too) {
            rig->pass.depth.resolve = make_texture(rig, a->depth, 1, a->layers);
            rig->pass.depth.resolve_mode = (enum rhw_resolve)rig_random_int(random, RHW_RESOLVE_NONE + 1);
            rig->pass.depth.stencil_resolve_mode =
                (enum rhw_resolve)rig_random_int(random, RHW_RESOLVE_NONE + 1);
        }
    }
}

static void set_dynamic(struct rig *rig, uint64_t *random)
{
    for (int i = 0; i < 3 && chance(random, 2); i++) {
        const struct rhw_viewport viewport = {
            rig_random_float(random, -30, 30), rig_random_float(random, -30, 30),
            rig_random_float(random, 20, 150), rig_random_float(random, 20, 150),
            rig_random_float(random, 0, 1),    rig_random_float(random, 0, 1)};
        const struct rhw_rect scissor = {rig_random_int(random, 30) - 10, rig_random_int(random, 30) - 10,
                                         10 + rig_random_int(random, WIDTH),
                                         10 + rig_random_int(random, HEIGHT)};
        rhw_pass_set_viewports(rig->context, rig->recording, i, 1, &viewport);
        rhw_pass_set_scissors(rig->context, rig->recording, i, 1, &scissor);
    }
    const float constant[4] = {rig_random_float(random, 0, 1), rig_random_float(random, 0, 1),
                               rig_random_float(random, 0, 1), rig_random_float(random, 0, 1)};
    rhw_pass_set_blend_constant(rig->context, rig->recording, constant);
    rhw_pass_set_stencil_reference(rig->context, rig->recording, (uint8_t)rig_random_int(random, 256),
                                   (uint8_t)rig_random_int(random, 256));
    const float least = rig_random_float(random, 0, 0.6f);
    rhw_pass_set_depth_bounds(rig->context, rig->recording, least, rig_random_float(random, least, 1));
}

static int make_vertices(const struct rig *rig, uint64_t *random, struct rig_vertex *vertices)
{
    static const float sizes[] = {2, 4, 12, 40, 150};
    const int count = 3 + rig_random_int(random, VERTICES_MOST - 2);
    const float size = ONE_OF(random, sizes), level = chance(random, 3) ? rig_random_float(random, 0, 1) : -1;
    const bool cut = chance(random, 5);
    float x = 0, y = 0;
    for (int i = 0; i < count; i++) {
        if (i % 3 == 0) {
            x = rig_random_float(random, -10, WIDTH);
            y = rig_random_float(random, -10, HEIGHT);
        }
        const float w = level >= 0 ? 1 : rig_random_float(random, cut ? -0.3f : 0.3f, 2);
        const float z = level >= 0 ? level : rig_random_float(random, cut ? -0.3f : 0, cut ? 1.3f : 1);
        rig_place(rig, x + rig_random_float(random, -size, size), y + rig_random_float(random, -size, size),
                  z, w, vertices[i].position);
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = rig_random_float(random, -0.4f, 1.2f);
        }
    }
    return count;
}

// How the same pass is drawn.
struct way {
    enum rhw_paths paths;
    int threads;
    size_t bin_memory;
    enum rhw_isa_limit isa;
    bool validates;
};

static const struct way ways[] = {
    {RHW_PATHS_GENERAL, 1, 0, RHW_ISA_BEST, false},       {RHW_PATHS_ALL, 1, 0, RHW_ISA_BEST, false},
    {RHW_PATHS_ALL, 2, 1, RHW_ISA_BEST, false}, // in waves of a chunk each
    {RHW_PATHS_ALL, 2, 0, RHW_ISA_UP_TO_BASELINE, false}, {RHW_PATHS_IN_ORDER, 1, 0, RHW_ISA_BEST, true},
};

enum { WAYS = sizeof ways / sizeof ways[0] };

// Much of what is chosen has no effect.
static void ignore(void *user, enum rhw_log_level level, const char *message)
{
    (void)user;
    (void)level;
    (void)message;
}

enum { WORDS = WIDTH * HEIGHT * 2 }; // texels of 16 bytes, the largest

// Differences between words do not cancel: the shift carries the topmost bit down, where the product moves it on.
static uint64_t hash_words(uint64_t hash, const uint64_t words[WORDS])
{
    for (int i = 0; i < WORDS; i++) {
        hash = (hash ^ words[i]) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return hash;
}

static uint64_t hash_samples(struct rig *rig, rhw_texture texture, enum rhw_aspect aspect, int samples,
                             int layers, uint64_t hash)
{
    static uint64_t texels[WORDS];
    for (int n = 0; n < layers * samples; n++) {
        const struct rhw_texture_region region = {
            .z = n / samples, .depth = 1, .sample = n % samples, .aspect = aspect};
        memset(texels, 0, sizeof texels);
        assert_int_equal(rhw_texture_read_region(rig->context, texture, &region, texels, 0, 0), RHW_OK);
        hash = hash_words(hash, texels);
    }
    return hash;
}

// `resolve`: null where there is none.
static uint64_t hash_texture(struct rig *rig, const struct attachments *a, rhw_texture texture,
                             rhw_texture resolve, enum rhw_aspect aspect)
{
    const uint64_t hash = hash_samples(rig, texture, aspect, a->resolves ? 1 : a->samples, a->layers, 0);
    return a->keeps_too ? hash_samples(rig, resolve, aspect, 1, a->layers, hash) : hash;
}

// What is left of a pass.
struct outcome {
    uint64_t hash[RHW_MAX_COLOR_ATTACHMENTS], depth, stencil;
    struct rhw_query_counts counts[2];
    uint32_t counters[COUNTERS];
    int draws;
};

// Draws what the seed says; definitions that are refused are left out.
static int draw_all(struct rig *rig, const struct attachments *a, struct combination *of, uint64_t *random)
{
    int drawn = 0;
    for (int d = 1 + rig_random_int(random, DRAWS_MOST); d > 0; d--, of++) {
        struct rig_vertex vertices[VERTICES_MOST];
        rhw_pipeline pipeline;
        choose(of, rig, a, random);
        const int count = make_vertices(rig, random, vertices);
        set_dynamic(rig, random);
        if (rhw_pipeline_create(rig->context, &of->def, &pipeline) != RHW_OK) {
            rig->misuses = 0;
            continue;
        }
        rhw_pass_set_pipeline(rig->context, rig->recording, pipeline);
        rig_use_vertices(rig, 0, vertices, (size_t)count * sizeof vertices[0]);
        rhw_pass_draw(rig->context, rig->recording, 0, (uint32_t)count, 0,
                      1 + (uint32_t)rig_random_int(random, 2));
        rhw_pipeline_destroy(rig->context, pipeline);
        drawn++;
    }
    return drawn;
}

static void draw_pass(uint64_t seed, const struct way *way, struct outcome *out)
{
    static struct combination combinations[DRAWS_MOST];
    uint64_t random = seed;
    struct rig rig;
    memset(out, 0, sizeof *out);
    rig_open_with(&rig, WIDTH, HEIGHT,
                  &(struct rhw_context_def){.threads = way->threads,
                                            .paths = way->paths,
                                            .bin_memory = way->bin_memory,
                                            .isa_limit = way->isa,
                                            .log = ignore,
                                            .validate = way->validates ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF});
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    const struct attachments a = choose_attachments(&random);
    attach(&rig, &a, &random);
    rhw_query queries[2];
    const bool counts = chance(&random, 2);
    for (int i = 0; i < 2; i++) {
        const struct rhw_query_def def = {.kind = i == 0 ? RHW_QUERY_OCCLUSION : RHW_QUERY_STATISTICS};
        assert_int_equal(rhw_query_create(rig.context, &def, &queries[i]), RHW_OK);
    }
    rhw_buffer counters;
    const struct rhw_buffer_def buffer_def = {.size = sizeof out->counters, .data = out->counters};
    assert_int_equal(rhw_buffer_create(rig.context, &buffer_def, &counters), RHW_OK);
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &rig.recording), RHW_OK);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, counters, 0, 0);
    for (int i = 0; i < 2 && counts; i++) {
        rhw_pass_begin_query(rig.context, rig.recording, queries[i]);
    }
    out->draws = draw_all(&rig, &a, combinations, &random);
    for (int i = 0; i < 2 && counts; i++) {
        rhw_pass_end_query(rig.context, rig.recording, queries[i]);
    }
    rig_end(&rig);
    for (int i = 0; i < 2 && counts; i++) {
        assert_int_equal(rhw_query_read(rig.context, queries[i], &out->counts[i]), RHW_OK);
    }
    for (int i = 0; i < a.count; i++) {
        out->hash[i] = hash_texture(&rig, &a, rig.pass.colors[i].texture, rig.pass.colors[i].resolve,
                                    RHW_ASPECT_DEFAULT);
    }
    if (a.depth != RHW_FORMAT_NONE) {
        out->depth =
            hash_texture(&rig, &a, rig.pass.depth.texture, rig.pass.depth.resolve, RHW_ASPECT_DEFAULT);
    }
    if (has_depth(a.depth) && has_stencil(a.depth)) {
        out->stencil =
            hash_texture(&rig, &a, rig.pass.depth.texture, rig.pass.depth.resolve, RHW_ASPECT_STENCIL);
    }
    assert_int_equal(rhw_buffer_read(rig.context, counters, 0, out->counters, sizeof out->counters), RHW_OK);
    rig_close(&rig);
}

static long number_of(const char *name, long otherwise)
{
    const char *const value = getenv(name);
    return value != NULL ? strtol(value, NULL, 10) : otherwise;
}

static void test_every_way_draws_the_same(void **state)
{
    (void)state;
    const long only = number_of("RHW_COMBINATION", -1), passes = number_of("RHW_COMBINATIONS", PASSES);
    long draws = 0;
    for (long pass = only < 0 ? 0 : only; pass < (only < 0 ? passes : only + 1); pass++) {
        struct outcome outcomes[WAYS];
        for (int w = 0; w < WAYS; w++) {
            draw_pass((uint64_t)pass, &ways[w], &outcomes[w]);
            if (memcmp(&outcomes[w], &outcomes[0], sizeof outcomes[0]) != 0) {
                const struct outcome *const a = &outcomes[0], *const b = &outcomes[w];
                fail_msg("pass %ld by way %d: colors %d, depth %d, stencil %d, counts %d, counters %d differ",
                         pass, w, memcmp(a->hash, b->hash, sizeof a->hash) != 0, a->depth != b->depth,
                         a->stencil != b->stencil, memcmp(a->counts, b->counts, sizeof a->counts) != 0,
                         memcmp(a->counters, b->counters, sizeof a->counters) != 0);
            }
        }
        draws += outcomes[0].draws;
    }
    assert_true(only >= 0 || draws > 2 * passes);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_way_draws_the_same)};

const struct unit_tests test_combinations = UNIT_TESTS(tests, NULL, NULL);
