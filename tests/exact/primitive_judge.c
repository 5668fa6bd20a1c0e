// SPDX-License-Identifier: MIT
// See primitive_judge.h. The truth about a line is that of a triangle with its two ends and, for the third vertex, one end
// again, across from it; nothing varies across.
#include "primitive_judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"
#include "rhw/shader.h"

__extension__ typedef __int128 wide;

enum { MAX_PRIMITIVES = 32, MAX_PIXELS = 256 * 256 };
enum shape { SHAPE_POINT, SHAPE_RECTANGLE, SHAPE_BRESENHAM, SHAPES };
enum { SMOOTH, NOPERSPECTIVE, PLACE, COUNT, TARGETS }; // PLACE: point coordinate, 1 + number, depth
// Where the components of the varyings start.
enum { AT_SMOOTH = 0, AT_NOPERSPECTIVE = SCENE_VALUES };
enum { MAX_WIDTH = 12, BESIDE = 16 }; // pixels; geometry/line_bresenham.h says why 16

struct primitive {
    struct scene_vertex end[2]; // of a point: the same twice
    int32_t at_24_8[2][2];
};

struct primitive_judge {
    rhw_context *context;
    rhw_buffer vertices;
    struct oracle_triangle triangle;
    struct oracle_form form[2][SCENE_VALUES], depth, end;
    struct oracle_sample sample;
    int16_t owner[MAX_PIXELS], count[MAX_PIXELS];
    probe_pixel seen[TARGETS - 1][MAX_PIXELS];
    float seen_count[MAX_PIXELS];
    // Of the scene being compared.
    const struct scene *scene;
    struct judge_results *results;
    enum shape shape;
    int size_24_8; // of points, and across rectangular lines; of Bresenham lines 256 · pixels
    int primitive_count;
    struct primitive primitive[MAX_PRIMITIVES];
};

static void vertex_function(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const float *const size = v->uniforms;
        for (int i = 0; i < 4; i++) {
            v->position[i] = v->attribute[0][i];
        }
        for (int i = 0; i < SCENE_VALUES; i++) {
            v->varying[AT_SMOOTH + i] = v->varying[AT_NOPERSPECTIVE + i] = v->attribute[1][i];
        }
        v->point_size = rhw_splat(*size);
    }
}

static void fragment_function(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        for (int i = 0; i < SCENE_VALUES; i++) {
            f->color[SMOOTH][i] = f->varying[AT_SMOOTH + i];
            f->color[NOPERSPECTIVE][i] = f->varying[AT_NOPERSPECTIVE + i];
        }
        f->color[PLACE][0] = f->point_coord[0];
        f->color[PLACE][1] = f->point_coord[1];
        f->color[PLACE][2] = __builtin_convertvector(f->primitive + rhw_splat_int(1), rhw_float);
        f->color[PLACE][3] = f->coord[2];
        f->color[COUNT][0] = f->color[COUNT][1] = f->color[COUNT][2] = f->color[COUNT][3] = rhw_splat(1);
    }
}

typedef void form_function(struct oracle_form *form);

static void each_form(struct primitive_judge *j, form_function *function)
{
    for (int i = 0; i < SCENE_VALUES; i++) {
        function(&j->form[SMOOTH][i]);
        function(&j->form[NOPERSPECTIVE][i]);
    }
    function(&j->depth);
    function(&j->end);
}

struct primitive_judge *primitive_judge_create(enum rhw_isa isa)
{
    struct primitive_judge *const j = calloc(1, sizeof *j);
    struct rhw_context_def def = rhw_context_def_default();
    struct rhw_buffer_def buffer = rhw_buffer_def_default();
    def.threads = 1;
    def.isa_limit = rhw_isa_up_to(isa);
    buffer.size = sizeof(struct scene_vertex) * 2 * MAX_PRIMITIVES;
    if (!j || rhw_context_create(&def, &j->context) != RHW_OK) {
        free(j);
        return NULL;
    }
    each_form(j, oracle_form_init);
    oracle_triangle_init(&j->triangle);
    oracle_sample_init(&j->sample);
    if (rhw_buffer_create(j->context, &buffer, &j->vertices) != RHW_OK) {
        primitive_judge_destroy(j);
        return NULL;
    }
    return j;
}

void primitive_judge_destroy(struct primitive_judge *j)
{
    if (j) {
        oracle_sample_clear(&j->sample);
        oracle_triangle_clear(&j->triangle);
        each_form(j, oracle_form_clear);
        rhw_context_destroy(j->context);
        free(j);
    }
}

static bool create_pipeline(struct primitive_judge *j, rhw_pipeline *pipeline)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    const struct rhw_blend_component add = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    def.program.vertex[RHW_ISA_BASELINE] = vertex_function;
    def.program.fragment[RHW_ISA_BASELINE] = fragment_function;
    def.program.varyings[0].components = def.program.varyings[1].components = SCENE_VALUES;
    def.program.varyings[1].qualifier = RHW_NOPERSPECTIVE;
    def.program.varying_count = 2;
    def.program.uniform_size = sizeof(float);
    def.program.uses = RHW_USE_COORD | RHW_USE_IDS | (j->shape == SHAPE_POINT ? RHW_USE_POINT_COORD : 0);
    def.program.writes_point_size = j->shape == SHAPE_POINT;
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, position)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, value)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct scene_vertex);
    def.buffer_count = 1;
    def.topology = j->shape == SHAPE_POINT ? RHW_POINT_LIST : RHW_LINE_LIST;
    def.line_mode = j->shape == SHAPE_BRESENHAM ? RHW_LINE_BRESENHAM : RHW_LINE_RECTANGULAR;
    def.line_width = (float)j->size_24_8 / 256;
    def.depth_range = j->scene->view.minus_one_to_one ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
    def.target_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        def.targets[i].format = i == COUNT ? RHW_FORMAT_R32_FLOAT : RHW_FORMAT_RGBA32_FLOAT;
    }
    def.targets[COUNT].blend = true;
    def.targets[COUNT].color = def.targets[COUNT].alpha = add;
    return rhw_pipeline_create(j->context, &def, pipeline) == RHW_OK;
}

static bool record(struct primitive_judge *j, rhw_pipeline pipeline, const rhw_texture targets[TARGETS])
{
    const struct oracle_view *const view = &j->scene->view;
    const float size = (float)j->size_24_8 / 256;
    struct rhw_pass_def def = rhw_pass_def_default();
    rhw_pass pass;
    struct scene_vertex vertices[2 * MAX_PRIMITIVES];
    int count = 0;
    for (int n = 0; n < j->primitive_count; n++) {
        vertices[count++] = j->primitive[n].end[0];
        if (j->shape != SHAPE_POINT) {
            vertices[count++] = j->primitive[n].end[1];
        }
    }
    def.color_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        def.colors[i].texture = targets[i];
        def.colors[i].load = RHW_LOAD_CLEAR;
        memset(def.colors[i].clear, 0, sizeof def.colors[i].clear);
    }
    rhw_buffer_write(j->context, j->vertices, 0, vertices, sizeof *vertices * (size_t)count);
    if (rhw_pass_begin(j->context, &def, &pass) != RHW_OK) {
        return false;
    }
    rhw_pass_set_pipeline(j->context, pass, pipeline);
    rhw_pass_set_vertex_buffer(j->context, pass, 0, j->vertices, 0);
    rhw_pass_set_uniforms(j->context, pass, &size, sizeof size);
    const struct rhw_viewport viewport = {view->x,      view->y,         view->width,
                                          view->height, view->depth_min, view->depth_max};
    rhw_pass_set_viewport(j->context, pass, &viewport);
    rhw_pass_draw(j->context, pass, 0, (uint32_t)count, 0, 1);
    return rhw_pass_end(j->context, pass, NULL) == RHW_OK;
}

static bool draw(struct primitive_judge *j)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture targets[TARGETS];
    rhw_pipeline pipeline;
    int created = 0;
    if (!create_pipeline(j, &pipeline)) {
        return false;
    }
    def.width = j->scene->view.target_width;
    def.height = j->scene->view.target_height;
    def.mip_levels = 1;
    for (; created < TARGETS; created++) {
        def.format = created == COUNT ? RHW_FORMAT_R32_FLOAT : RHW_FORMAT_RGBA32_FLOAT;
        if (rhw_texture_create(j->context, &def, &targets[created]) != RHW_OK) {
            break;
        }
    }
    bool ok = created == TARGETS && record(j, pipeline, targets);
    for (int i = 0; i < TARGETS && ok; i++) {
        float *const out = i == COUNT ? j->seen_count : j->seen[i][0];
        ok = rhw_texture_read(j->context, targets[i], 0, out, 0) == RHW_OK;
    }
    while (created > 0) {
        rhw_texture_destroy(j->context, targets[--created]);
    }
    rhw_pipeline_destroy(j->context, pipeline);
    return ok;
}

// Within the view volume, so that nothing is cut off.
static bool in_view(const struct scene *scene, const struct scene_vertex *v)
{
    const float *const p = v->position, w = p[3];
    return w > 0 && fabsf(p[0]) <= w && fabsf(p[1]) <= w && p[2] <= w &&
           p[2] >= (scene->view.minus_one_to_one ? -w : 0);
}

// What leads across from a line, `size` far, rounded to 24.8. False where its ends are one, and where rounding is a tie (of
// lines that lie as 3 to 4, say): which way that goes nobody is held to.
static bool side_of(const struct primitive *p, double size_24_8, int32_t side[2])
{
    const double dx = p->at_24_8[1][0] - p->at_24_8[0][0], dy = p->at_24_8[1][1] - p->at_24_8[0][1];
    const double length = sqrt(dx * dx + dy * dy); // of an integer
    const double exact[2] = {-dy * size_24_8 / length, dx * size_24_8 / length};
    bool good = length > 0;
    for (int axis = 0; axis < 2 && good; axis++) {
        side[axis] = (int32_t)rint(exact[axis]);
        good = fabs(fabs(exact[axis] - side[axis]) - 0.5) > 1e-9;
    }
    return good;
}

// How far across the triangle reaches that a line's values, or its coverage, come from.
static double half_width(const struct primitive_judge *j)
{
    return j->shape == SHAPE_BRESENHAM ? BESIDE * 256 : j->size_24_8 / 2.0;
}

// Takes the corners, or the edges, of the scene's first triangles.
static void collect(struct primitive_judge *j)
{
    const struct scene *const scene = j->scene;
    j->primitive_count = 0;
    for (int i = 0; i < 3 * scene->triangle_count && j->primitive_count < MAX_PRIMITIVES; i++) {
        const int *const corners = scene->triangle[i / 3];
        const int other = j->shape == SHAPE_POINT ? i % 3 : (i + 1) % 3;
        struct primitive *const p = &j->primitive[j->primitive_count];
        int32_t side[2];
        p->end[0] = scene->vertex[corners[i % 3]];
        p->end[1] = scene->vertex[corners[other]];
        if (in_view(scene, &p->end[0]) && in_view(scene, &p->end[1]) &&
            oracle_snap(&scene->view, p->end[0].position, p->at_24_8[0]) &&
            oracle_snap(&scene->view, p->end[1].position, p->at_24_8[1]) &&
            (j->shape == SHAPE_POINT || side_of(p, half_width(j), side))) {
            j->primitive_count++;
        }
    }
}

// Coverage ------------------------------------------------------------------------------------------

static void note(struct primitive_judge *j, int number, int x, int y)
{
    const struct oracle_view *const v = &j->scene->view;
    const int left = (int)fmaxf(v->x, 0), top = (int)fmaxf(v->y, 0),
              right = (int)fminf(v->x + v->width, (float)v->target_width),
              bottom = (int)fminf(v->y + v->height, (float)v->target_height);
    const bool is_cut = j->shape != SHAPE_POINT; // a viewport does not cut points
    const bool in_target = x >= 0 && y >= 0 && x < v->target_width && y < v->target_height;
    if (in_target && (!is_cut || (x >= left && x < right && y >= top && y < bottom))) {
        j->owner[y * v->target_width + x] = (int16_t)number;
        j->count[y * v->target_width + x]++;
    }
}

static void cover_point(struct primitive_judge *j, int number)
{
    const struct primitive *const p = &j->primitive[number];
    const int x = p->at_24_8[0][0] - j->size_24_8 / 2, y = p->at_24_8[0][1] - j->size_24_8 / 2;
    for (int row = 0; row < j->scene->view.target_height; row++) {
        for (int column = 0; column < j->scene->view.target_width; column++) {
            const int right = 256 * column + 128 - x, down = 256 * row + 128 - y;
            if (right >= 0 && down >= 0 && right < j->size_24_8 && down < j->size_24_8) {
                note(j, number, column, row);
            }
        }
    }
}

static void cover_rectangle(struct primitive_judge *j, int number)
{
    const struct primitive *const p = &j->primitive[number];
    struct oracle_triangle area = {.view = j->scene->view, .corner_count = 4};
    int32_t side[2];
    int y0, y1;
    side_of(p, half_width(j), side);
    for (int i = 0; i < 4; i++) {
        for (int axis = 0; axis < 2; axis++) {
            area.corner_24_8[i][axis] =
                p->at_24_8[i / 2][axis] + (i == 0 || i == 3 ? side[axis] : -side[axis]);
        }
    }
    oracle_rows(&area, &y0, &y1);
    for (int y = y0; y < y1; y++) {
        int run[ORACLE_CORNERS];
        const int ends = oracle_cover_row(&area, y, run);
        for (int i = 0; i < ends; i += 2) {
            for (int x = run[i]; x < run[i + 1]; x++) {
                note(j, number, x, y);
            }
        }
    }
}

// Vulkan 1.3 §28.10.1: a pixel is drawn where the line meets the diamond |x − x_c| + |y − y_c| < 1/2 around its centre and
// does not end in it, all moved by (−ε, −ε²). With u = x + y and v = x − y diamonds are squares. In units of 2^-40/256
// pixel and with ε = 2^-20/256: what the integers would decide differs by 1/256 at least, and ε moves it by less.
struct diamond_line {
    wide u[2], v[2];
};

static const wide diamond_unit = (wide)1 << 40;

static struct diamond_line diamond_line_of(const struct primitive *p, int down_24_8[2])
{
    const wide epsilon = 1 << 20, epsilon2 = 1;
    struct diamond_line line;
    for (int i = 0; i < 2; i++) {
        const wide x = (p->at_24_8[i][0] - down_24_8[0]) * diamond_unit - epsilon,
                   y = (p->at_24_8[i][1] - down_24_8[1]) * diamond_unit - epsilon2;
        line.u[i] = x + y;
        line.v[i] = x - y;
    }
    return line;
}

static bool in_square(wide u, wide v)
{
    const wide half = 128 * diamond_unit;
    return -half < u && u < half && -half < v && v < half;
}

// Two convex areas are apart where an axis across a side of one keeps them apart.
static bool leaves_diamond(const struct diamond_line *line, int x, int y)
{
    const wide half = 128 * diamond_unit, center_x = (256 * x + 128) * diamond_unit,
               center_y = (256 * y + 128) * diamond_unit;
    wide u[2], v[2];
    for (int i = 0; i < 2; i++) {
        u[i] = line->u[i] - center_x - center_y;
        v[i] = line->v[i] - center_x + center_y;
    }
    if ((u[0] >= half && u[1] >= half) || (u[0] <= -half && u[1] <= -half) ||
        (v[0] >= half && v[1] >= half) || (v[0] <= -half && v[1] <= -half) || in_square(u[1], v[1])) {
        return false;
    }
    const wide du = u[1] - u[0], dv = v[1] - v[0], through = du * -v[0] - dv * -u[0],
               reach = ((du < 0 ? -du : du) + (dv < 0 ? -dv : dv)) * half;
    return -reach < through && through < reach;
}

// A line `pixels` wide is that of one, moved across by half of what it is wider, with each pixel repeated across.
static void cover_bresenham(struct primitive_judge *j, int number)
{
    const struct primitive *const p = &j->primitive[number];
    const int32_t dx = p->at_24_8[1][0] - p->at_24_8[0][0], dy = p->at_24_8[1][1] - p->at_24_8[0][1];
    const int across = labs((long)dy) > labs((long)dx) ? 0 : 1, pixels = j->size_24_8 / 256;
    int down_24_8[2] = {0, 0};
    down_24_8[across] = (pixels - 1) * 128;
    const struct diamond_line line = diamond_line_of(p, down_24_8);
    for (int y = -2 * MAX_WIDTH; y < j->scene->view.target_height + 2; y++) {
        for (int x = -2 * MAX_WIDTH; x < j->scene->view.target_width + 2; x++) {
            if (leaves_diamond(&line, x, y)) {
                for (int k = 0; k < pixels; k++) {
                    note(j, number, x + (across == 0 ? k : 0), y + (across == 1 ? k : 0));
                }
            }
        }
    }
}

static void cover_all(struct primitive_judge *j)
{
    typedef void cover_function(struct primitive_judge *, int);
    static cover_function *const cover[SHAPES] = {cover_point, cover_rectangle, cover_bresenham};
    memset(j->count, 0, sizeof j->count);
    memset(j->owner, -1, sizeof j->owner);
    for (int n = 0; n < j->primitive_count; n++) {
        cover[j->shape](j, n);
    }
}

// Comparison ----------------------------------------------------------------------------------------

static void unequal(struct primitive_judge *j, enum equality what, const struct tally_place *at)
{
    if (j->results->unequal[what]++ == 0) {
        j->results->unequal_at[what] = *at;
    }
}

static void measure(struct primitive_judge *j, enum quantity quantity, const struct tally_place *place,
                    double error, int component)
{
    struct tally_place at = *place;
    at.component = component;
    tally_add(&j->results->quantity[at.family][quantity], error, &at);
}

static void compare_depth(struct primitive_judge *j, const struct tally_place *at, int pixel)
{
    const struct oracle_view *const v = &j->scene->view;
    const float low = fminf(v->depth_min, v->depth_max), high = fmaxf(v->depth_min, v->depth_max);
    const float got = j->seen[PLACE][pixel][3];
    const double truth = oracle_value(&j->depth, &j->sample);
    if (!((got == low && truth < (double)low) || (got == high && truth > (double)high))) {
        measure(j, QUANTITY_PRIMITIVE_DEPTH, at,
                oracle_error(&j->depth, &j->sample, (double)got, oracle_ulp(j->depth.vertex_max)), 0);
    }
}

// The triangle with the values of primitive `number`: its first end, the place across from that, its other end.
static void set_triangle(struct primitive_judge *j, int number)
{
    const struct primitive *const p = &j->primitive[number];
    int32_t side[2] = {0, 256}, corners[3][2];
    float position[3][4];
    if (j->shape != SHAPE_POINT) {
        side_of(p, half_width(j), side);
    }
    for (int axis = 0; axis < 2; axis++) {
        corners[0][axis] = p->at_24_8[0][axis];
        corners[1][axis] = p->at_24_8[0][axis] - side[axis];
        corners[2][axis] = p->at_24_8[1][axis];
    }
    if (j->shape == SHAPE_POINT) {
        corners[2][0] += 256;
    }
    for (int i = 0; i < 3; i++) {
        memcpy(position[i], p->end[i / 2].position, sizeof position[i]);
    }
    oracle_triangle_set_snapped(&j->triangle, &j->scene->view, (const int32_t(*)[2])corners,
                                (const float(*)[4])position);
}

static void set_forms(struct primitive_judge *j, int number)
{
    const struct primitive *const p = &j->primitive[number];
    static const float of_end[3] = {0, 0, 1};
    for (int i = 0; i < SCENE_VALUES; i++) {
        const float value[3] = {p->end[0].value[i], p->end[0].value[i], p->end[1].value[i]};
        oracle_form_smooth(&j->form[SMOOTH][i], &j->triangle, value);
        oracle_form_noperspective(&j->form[NOPERSPECTIVE][i], &j->triangle, value);
    }
    oracle_form_depth(&j->depth, &j->triangle);
    oracle_form_noperspective(&j->end, &j->triangle, of_end);
}

// A point has its vertex's values, and in its square the coordinate of the pixel's centre: 0..1 from the top left.
static void compare_point(struct primitive_judge *j, const struct tally_place *at, int pixel)
{
    const struct primitive *const p = &j->primitive[at->triangle];
    const int centre[2] = {256 * at->x + 128, 256 * at->y + 128};
    if (memcmp(j->seen[SMOOTH][pixel], p->end[0].value, sizeof(probe_pixel)) != 0 ||
        memcmp(j->seen[NOPERSPECTIVE][pixel], p->end[0].value, sizeof(probe_pixel)) != 0) {
        unequal(j, EQUAL_CONSTANT, at);
    }
    for (int axis = 0; axis < 2; axis++) {
        // A float times an integer below 2^24: exact.
        const double got = (double)j->seen[PLACE][pixel][axis] * j->size_24_8;
        const double truth = centre[axis] - (p->at_24_8[0][axis] - j->size_24_8 / 2);
        measure(j, QUANTITY_POINT_COORD, at, fabs(got - truth) / j->size_24_8 / oracle_ulp(1), axis);
    }
}

static void compare_line(struct primitive_judge *j, const struct tally_place *at, int pixel)
{
    for (int q = SMOOTH; q <= NOPERSPECTIVE; q++) {
        for (int i = 0; i < SCENE_VALUES; i++) {
            const struct oracle_form *const form = &j->form[q][i];
            const float got = j->seen[q][pixel][i];
            if (j->scene->kind[i] == VALUE_CONSTANT) {
                if (memcmp(&got, &j->primitive[at->triangle].end[0].value[i], sizeof got) != 0) {
                    unequal(j, EQUAL_CONSTANT, at);
                }
            } else if (j->scene->kind[i] <= VALUE_OPPOSITE) {
                const double unit = oracle_ulp(form->vertex_max);
                measure(j, j->shape == SHAPE_BRESENHAM ? QUANTITY_BRESENHAM : QUANTITY_LINE, at,
                        oracle_error(form, &j->sample, (double)got, unit), i);
            }
        }
    }
}

static void compare_primitive(struct primitive_judge *j, int number)
{
    const struct scene *const scene = j->scene;
    set_triangle(j, number);
    set_forms(j, number);
    for (int pixel = 0; pixel < scene->view.target_width * scene->view.target_height; pixel++) {
        const struct tally_place at = {(int)scene->family,
                                       number,
                                       pixel % scene->view.target_width,
                                       pixel / scene->view.target_width,
                                       0,
                                       scene->seed,
                                       scene->index};
        if (j->owner[pixel] != number) {
            continue;
        }
        oracle_sample_at(&j->sample, &j->triangle, at.x, at.y);
        const double part = oracle_value(&j->end, &j->sample);
        if (j->shape != SHAPE_POINT && !(part >= 0 && part <= 1)) {
            continue; // a pixel of a Bresenham line may have its centre beyond the ends, by half a pixel
        }
        compare_depth(j, &at, pixel);
        if (j->shape == SHAPE_POINT) {
            compare_point(j, &at, pixel);
        } else {
            compare_line(j, &at, pixel);
        }
    }
}

static void compare_coverage(struct primitive_judge *j)
{
    const struct scene *const scene = j->scene;
    for (int pixel = 0; pixel < scene->view.target_width * scene->view.target_height; pixel++) {
        const struct tally_place at = {(int)scene->family,
                                       j->owner[pixel],
                                       pixel % scene->view.target_width,
                                       pixel / scene->view.target_width,
                                       0,
                                       scene->seed,
                                       scene->index};
        if (j->seen_count[pixel] != (float)j->count[pixel]) {
            unequal(j, EQUAL_PRIMITIVE, &at);
        } else if (j->seen[PLACE][pixel][2] != (float)(j->owner[pixel] + 1)) {
            unequal(j, EQUAL_OWNER, &at);
        }
    }
}

bool primitive_judge_compare(struct primitive_judge *j, const struct scene *scene,
                             struct judge_results *results)
{
    struct random random = random_start(scene->seed, scene->family, scene->index);
    j->scene = scene;
    j->results = results;
    for (int shape = 0; shape < SHAPES; shape++) {
        j->shape = (enum shape)shape;
        j->size_24_8 = shape == SHAPE_BRESENHAM
                           ? 256 * (1 + random_below(&random, MAX_WIDTH) * random_below(&random, 2))
                           : 256 + random_below(&random, (MAX_WIDTH - 1) * 256 + 1);
        collect(j);
        if (j->primitive_count == 0) {
            continue;
        }
        if (!draw(j)) {
            return false;
        }
        cover_all(j);
        compare_coverage(j);
        for (int n = 0; n < j->primitive_count; n++) {
            compare_primitive(j, n);
        }
    }
    return true;
}
