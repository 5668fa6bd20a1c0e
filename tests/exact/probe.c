// SPDX-License-Identifier: MIT
// See probe.h. Seven four-channel float targets carry the fragment's numbers and an eighth counts fragments by
// additive blending, so that a sample covered twice cannot hide behind the last triangle drawn.
#include "probe.h"

#include <stdlib.h>
#include <string.h>

#include "rhw/shader.h"

enum { SMOOTH, NOPERSPECTIVE, FLAT, SPACE, SCREEN, DDX, DDY, COUNT, TARGETS };
// Where the components of the varyings start.
enum { AT_SMOOTH = 0, AT_NOPERSPECTIVE = SCENE_VALUES, AT_FLAT = 2 * SCENE_VALUES, COMPONENTS = AT_FLAT + 2 };
// Sizes of target kept at a time; the families use two.
enum { SIZES = 4 };
// Pipelines: topology by depth range.
enum { TOPOLOGIES = 3 };

struct size {
    int width, height;
    rhw_texture target[TARGETS], depth;
    float *memory; // read back into
};

struct probe {
    rhw_context *context;
    rhw_buffer vertices;
    rhw_pipeline pipeline[TOPOLOGIES][2];
    struct size size[SIZES];
    int size_count;
    struct probe_image image;
};

static void vertex_function(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        for (int i = 0; i < 4; i++) {
            v->position[i] = v->attribute[0][i];
        }
        for (int i = 0; i < SCENE_VALUES; i++) {
            v->varying[AT_SMOOTH + i] = v->varying[AT_NOPERSPECTIVE + i] = v->attribute[1][i];
        }
        v->varying[AT_FLAT] = v->attribute[2][0];
        v->varying[AT_FLAT + 1] = v->attribute[2][1];
    }
}

static void fragment_function(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        for (int i = 0; i < 4; i++) {
            f->color[SMOOTH][i] = f->varying[AT_SMOOTH + i];
            f->color[NOPERSPECTIVE][i] = f->varying[AT_NOPERSPECTIVE + i];
            f->color[DDX][i] = f->ddx[AT_SMOOTH + i];
            f->color[DDY][i] = f->ddy[AT_SMOOTH + i];
        }
        for (int i = 0; i < 3; i++) {
            f->color[SPACE][i] = f->barycentric[i];
            f->color[SCREEN][i] = f->barycentric_noperspective[i];
        }
        f->color[SPACE][3] = f->coord[3];
        f->color[SCREEN][3] = f->coord[2];
        f->color[FLAT][0] = f->varying[AT_FLAT];
        f->color[FLAT][1] = f->varying[AT_FLAT + 1];
        f->color[FLAT][2] = __builtin_convertvector(f->primitive + rhw_splat_int(1), rhw_float);
        f->color[FLAT][3] = rhw_select(f->front_facing, rhw_splat(1), rhw_splat(2));
        f->color[COUNT][0] = f->color[COUNT][1] = f->color[COUNT][2] = f->color[COUNT][3] = rhw_splat(1);
    }
}

static bool create_pipeline(struct probe *p, enum rhw_topology topology, bool minus_one_to_one)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex[RHW_ISA_BASELINE] = vertex_function;
    def.program.fragment[RHW_ISA_BASELINE] = fragment_function;
    def.program.varyings[0] = (struct rhw_varying){.components = SCENE_VALUES, .derivatives = true};
    def.program.varyings[1] =
        (struct rhw_varying){.components = SCENE_VALUES, .qualifier = RHW_NOPERSPECTIVE};
    def.program.varyings[2] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
    def.program.varying_count = 3;
    def.program.uses = RHW_USE_COORD | RHW_USE_FACING | RHW_USE_IDS | RHW_USE_BARYCENTRIC;
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, position)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, value)};
    def.attributes[2] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct scene_vertex, flat)};
    def.attribute_count = 3;
    def.buffers[0].stride = sizeof(struct scene_vertex);
    def.buffer_count = 1;
    def.topology = topology;
    def.depth_range = minus_one_to_one ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
    def.depth_test = true;
    def.depth_compare = RHW_COMPARE_ALWAYS;
    def.target_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        def.targets[i].format = i == COUNT ? RHW_FORMAT_R32_FLOAT : RHW_FORMAT_RGBA32_FLOAT;
        def.targets[i].write_mask = 0;
    }
    const struct rhw_blend_component add = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    def.targets[COUNT].blend = true;
    def.targets[COUNT].color = def.targets[COUNT].alpha = add;
    return rhw_pipeline_create(p->context, &def, &p->pipeline[topology][minus_one_to_one]) == RHW_OK;
}

struct probe *probe_create(int threads, enum rhw_isa isa)
{
    struct probe *const p = calloc(1, sizeof *p);
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.isa_limit = rhw_isa_up_to(isa);
    if (!p || rhw_context_create(&def, &p->context) != RHW_OK) {
        free(p);
        return NULL;
    }
    struct rhw_buffer_def buffer = rhw_buffer_def_default();
    buffer.size = sizeof(struct scene_vertex) * SCENE_VERTICES;
    bool ok = rhw_buffer_create(p->context, &buffer, &p->vertices) == RHW_OK;
    for (int i = 0; i < 2 * TOPOLOGIES && ok; i++) {
        ok = create_pipeline(p, (enum rhw_topology)(i / 2), i % 2);
    }
    if (!ok) {
        probe_destroy(p);
        return NULL;
    }
    return p;
}

void probe_destroy(struct probe *p)
{
    if (p) {
        rhw_context_destroy(p->context);
        for (int i = 0; i < p->size_count; i++) {
            free(p->size[i].memory);
        }
        free(p);
    }
}

const char *probe_isa_name(const struct probe *p)
{
    return rhw_isa_name(rhw_context_isa(p->context));
}

// Floats per pixel of a target.
static size_t channels(int target)
{
    return target == COUNT ? 1 : 4;
}

static bool create_size(struct probe *p, struct size *s, int width, int height)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = s->width = width;
    def.height = s->height = height;
    def.mip_levels = 1;
    for (int i = 0; i < TARGETS; i++) {
        def.format = i == COUNT ? RHW_FORMAT_R32_FLOAT : RHW_FORMAT_RGBA32_FLOAT;
        if (rhw_texture_create(p->context, &def, &s->target[i]) != RHW_OK) {
            return false;
        }
    }
    def.format = RHW_FORMAT_D32_FLOAT;
    s->memory = malloc((size_t)width * (size_t)height * (4 * (TARGETS - 1) + 2) * sizeof *s->memory);
    return s->memory && rhw_texture_create(p->context, &def, &s->depth) == RHW_OK;
}

static struct size *find_size(struct probe *p, int width, int height)
{
    for (int i = 0; i < p->size_count; i++) {
        if (p->size[i].width == width && p->size[i].height == height) {
            return &p->size[i];
        }
    }
    if (p->size_count == SIZES || !create_size(p, &p->size[p->size_count], width, height)) {
        return NULL;
    }
    return &p->size[p->size_count++];
}

static void read_back(struct probe *p, struct size *s)
{
    const size_t pixels = (size_t)s->width * (size_t)s->height;
    const float *at[TARGETS];
    float *next = s->memory;
    for (int i = 0; i < TARGETS; i++) {
        rhw_texture_read(p->context, s->target[i], 0, next, 0);
        at[i] = next;
        next += pixels * channels(i);
    }
    rhw_texture_read(p->context, s->depth, 0, next, 0);
    p->image = (struct probe_image){
        .width = s->width,
        .height = s->height,
        .smooth = (const probe_pixel *)at[SMOOTH],
        .noperspective = (const probe_pixel *)at[NOPERSPECTIVE],
        .flat = (const probe_pixel *)at[FLAT],
        .space = (const probe_pixel *)at[SPACE],
        .screen = (const probe_pixel *)at[SCREEN],
        .ddx = (const probe_pixel *)at[DDX],
        .ddy = (const probe_pixel *)at[DDY],
        .count = at[COUNT],
        .depth = next,
    };
}

const struct probe_image *probe_draw(struct probe *p, const struct scene *scene)
{
    const struct oracle_view *const view = &scene->view;
    struct size *const s = find_size(p, view->target_width, view->target_height);
    rhw_pass pass;
    struct rhw_pass_def def = rhw_pass_def_default();
    if (!s) {
        return NULL;
    }
    def.color_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        def.colors[i].texture = s->target[i];
        def.colors[i].load = RHW_LOAD_CLEAR;
        memset(def.colors[i].clear, 0, sizeof def.colors[i].clear);
    }
    def.depth.enabled = true;
    def.depth.texture = s->depth;
    def.depth.clear = 1;
    rhw_buffer_write(p->context, p->vertices, 0, scene->vertex,
                     sizeof *scene->vertex * (size_t)scene->vertex_count);
    if (rhw_pass_begin(p->context, &def, &pass) != RHW_OK) {
        return NULL;
    }
    rhw_pass_set_pipeline(p->context, pass, p->pipeline[scene->topology][view->minus_one_to_one]);
    rhw_pass_set_vertex_buffer(p->context, pass, 0, p->vertices, 0);
    const struct rhw_viewport viewport = {view->x,      view->y,         view->width,
                                          view->height, view->depth_min, view->depth_max};
    rhw_pass_set_viewport(p->context, pass, &viewport);
    rhw_pass_draw(p->context, pass, 0, (uint32_t)scene->vertex_count, 0, 1);
    if (rhw_pass_end(p->context, pass, NULL) != RHW_OK) {
        return NULL;
    }
    read_back(p, s);
    return &p->image;
}
