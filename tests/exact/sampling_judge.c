// SPDX-License-Identifier: MIT
// See sampling_judge.h. Samples lie on the 24.8 grid, so that the oracle moves the triangle the other way, exactly, and asks
// which centres of pixels it covers.
#include "sampling_judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rhw/shader.h"

enum { MAX_SAMPLES = 16, MAX_PIXELS = 256 * 256, TOPOLOGIES = 3 };
enum mode { MODE_SAMPLE, MODE_CENTROID, MODE_OFFSET, MODES };
enum { SMOOTH, NOPERSPECTIVE, PLACE, TARGETS }; // PLACE: x, y, 1 + number of the triangle, depth
// Where the components of the varyings start.
enum { AT_SMOOTH = 0, AT_NOPERSPECTIVE = SCENE_VALUES, AT_W = 2 * SCENE_VALUES };
// One pixel of so many is asked for its value at an offset.
enum { OFFSET_STRIDE = 8 };

struct sampling_judge {
    rhw_context *context;
    rhw_buffer vertices;
    rhw_pipeline pipeline[MODES][TOPOLOGIES][2];
    struct oracle_triangle triangle;
    struct oracle_form form[2][SCENE_VALUES], depth, w, inverse_w;
    struct oracle_sample sample, beside;
    int16_t owner[MAX_SAMPLES][MAX_PIXELS]; // the last triangle that covers a sample, or −1
    uint16_t covered[MAX_PIXELS];           // bits of the samples that the triangle covers
    probe_pixel seen[TARGETS][MAX_SAMPLES][MAX_PIXELS];
    // Of the scene being compared.
    const struct scene *scene;
    enum mode mode;
    int samples, place_0_8[MAX_SAMPLES][2]; // from the centre
    int offset_0_8[2];
    struct judge_results *results;
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
        v->varying[AT_W] = v->position[3];
    }
}

static void write_place(struct rhw_fragment *f)
{
    f->color[PLACE][0] = f->coord[0];
    f->color[PLACE][1] = f->coord[1];
    f->color[PLACE][2] = __builtin_convertvector(f->primitive + rhw_splat_int(1), rhw_float);
    f->color[PLACE][3] = f->coord[2];
}

static void values_here(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        for (int i = 0; i < SCENE_VALUES; i++) {
            f->color[SMOOTH][i] = f->varying[AT_SMOOTH + i];
            f->color[NOPERSPECTIVE][i] = f->varying[AT_NOPERSPECTIVE + i];
        }
        write_place(f);
    }
}

// The uniforms are the offset.
static void values_there(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const float *const by = f->uniforms;
        const rhw_float offset[2] = {rhw_splat(by[0]), rhw_splat(by[1])};
        for (int i = 0; i < SCENE_VALUES; i++) {
            f->color[SMOOTH][i] = rhw_interpolate_at(f, AT_SMOOTH + i, AT_W, offset);
            f->color[NOPERSPECTIVE][i] = rhw_interpolate_at(f, AT_NOPERSPECTIVE + i, -1, offset);
        }
        write_place(f);
    }
}

static bool create_pipeline(struct sampling_judge *j, enum mode mode, enum rhw_topology topology,
                            bool minus_one_to_one)
{
    static const enum rhw_sampling samplings[MODES] = {
        [MODE_SAMPLE] = RHW_SAMPLING_SAMPLE,
        [MODE_CENTROID] = RHW_SAMPLING_CENTROID,
        [MODE_OFFSET] = RHW_SAMPLING_CENTER,
    };
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex[RHW_ISA_BASELINE] = vertex_function;
    def.program.fragment[RHW_ISA_BASELINE] = mode == MODE_OFFSET ? values_there : values_here;
    for (int i = 0; i < 3; i++) {
        def.program.varyings[i].components = i == 2 ? 1 : SCENE_VALUES;
        def.program.varyings[i].qualifier = i == 1 ? RHW_NOPERSPECTIVE : RHW_SMOOTH;
        def.program.varyings[i].derivatives = mode == MODE_OFFSET;
        def.program.varyings[i].sampling = samplings[mode];
    }
    def.program.varying_count = 3;
    def.program.uses = RHW_USE_COORD | RHW_USE_IDS;
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, position)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, value)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct scene_vertex);
    def.buffer_count = 1;
    def.topology = topology;
    def.depth_range = minus_one_to_one ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
    def.target_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        def.targets[i].format = RHW_FORMAT_RGBA32_FLOAT;
    }
    return rhw_pipeline_create(j->context, &def, &j->pipeline[mode][topology][minus_one_to_one]) == RHW_OK;
}

typedef void form_function(struct oracle_form *form);

static void each_form(struct sampling_judge *j, form_function *function)
{
    for (int i = 0; i < SCENE_VALUES; i++) {
        function(&j->form[SMOOTH][i]);
        function(&j->form[NOPERSPECTIVE][i]);
    }
    function(&j->depth);
    function(&j->w);
    function(&j->inverse_w);
}

struct sampling_judge *sampling_judge_create(enum rhw_isa isa)
{
    struct sampling_judge *const j = calloc(1, sizeof *j);
    struct rhw_context_def def = rhw_context_def_default();
    struct rhw_buffer_def buffer = rhw_buffer_def_default();
    def.threads = 1;
    def.isa_limit = rhw_isa_up_to(isa);
    buffer.size = sizeof(struct scene_vertex) * SCENE_VERTICES;
    if (!j || rhw_context_create(&def, &j->context) != RHW_OK) {
        free(j);
        return NULL;
    }
    each_form(j, oracle_form_init);
    oracle_triangle_init(&j->triangle);
    oracle_sample_init(&j->sample);
    oracle_sample_init(&j->beside);
    bool ok = rhw_buffer_create(j->context, &buffer, &j->vertices) == RHW_OK;
    for (int i = 0; i < MODES * TOPOLOGIES * 2 && ok; i++) {
        ok = create_pipeline(j, (enum mode)(i / (2 * TOPOLOGIES)), (enum rhw_topology)(i / 2 % TOPOLOGIES),
                             i % 2);
    }
    if (!ok) {
        sampling_judge_destroy(j);
        return NULL;
    }
    return j;
}

void sampling_judge_destroy(struct sampling_judge *j)
{
    if (j) {
        oracle_sample_clear(&j->beside);
        oracle_sample_clear(&j->sample);
        oracle_triangle_clear(&j->triangle);
        each_form(j, oracle_form_clear);
        rhw_context_destroy(j->context);
        free(j);
    }
}

static bool record(struct sampling_judge *j, const rhw_texture targets[TARGETS])
{
    const struct oracle_view *const view = &j->scene->view;
    const float offset[2] = {(float)j->offset_0_8[0] / 256, (float)j->offset_0_8[1] / 256};
    struct rhw_pass_def def = rhw_pass_def_default();
    rhw_pass pass;
    def.color_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        def.colors[i].texture = targets[i];
        def.colors[i].load = RHW_LOAD_CLEAR;
        memset(def.colors[i].clear, 0, sizeof def.colors[i].clear);
    }
    rhw_buffer_write(j->context, j->vertices, 0, j->scene->vertex,
                     sizeof *j->scene->vertex * (size_t)j->scene->vertex_count);
    if (rhw_pass_begin(j->context, &def, &pass) != RHW_OK) {
        return false;
    }
    rhw_pass_set_pipeline(j->context, pass, j->pipeline[j->mode][j->scene->topology][view->minus_one_to_one]);
    rhw_pass_set_vertex_buffer(j->context, pass, 0, j->vertices, 0);
    rhw_pass_set_uniforms(j->context, pass, offset, sizeof offset);
    const struct rhw_viewport viewport = {view->x,      view->y,         view->width,
                                          view->height, view->depth_min, view->depth_max};
    rhw_pass_set_viewport(j->context, pass, &viewport);
    rhw_pass_draw(j->context, pass, 0, (uint32_t)j->scene->vertex_count, 0, 1);
    return rhw_pass_end(j->context, pass, NULL) == RHW_OK;
}

static bool draw(struct sampling_judge *j)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture targets[TARGETS];
    int created = 0;
    def.width = j->scene->view.target_width;
    def.height = j->scene->view.target_height;
    def.mip_levels = 1;
    def.samples = j->samples;
    def.format = RHW_FORMAT_RGBA32_FLOAT;
    while (created < TARGETS && rhw_texture_create(j->context, &def, &targets[created]) == RHW_OK) {
        created++;
    }
    bool ok = created == TARGETS && record(j, targets);
    for (int i = 0; i < TARGETS && ok; i++) {
        for (int s = 0; s < j->samples && ok; s++) {
            ok = (j->samples == 1
                      ? rhw_texture_read(j->context, targets[i], 0, j->seen[i][s], 0)
                      : rhw_texture_read_sample(j->context, targets[i], s, j->seen[i][s], 0)) == RHW_OK;
        }
    }
    while (created > 0) {
        rhw_texture_destroy(j->context, targets[--created]);
    }
    return ok;
}

static const struct scene_vertex *vertex_of(const struct sampling_judge *j, int triangle, int corner)
{
    return &j->scene->vertex[j->scene->triangle[triangle][corner]];
}

static void set_triangle(struct sampling_judge *j, int number)
{
    float position[3][4];
    for (int k = 0; k < 3; k++) {
        memcpy(position[k], vertex_of(j, number, k)->position, sizeof position[k]);
    }
    oracle_triangle_set(&j->triangle, &j->scene->view, (const float(*)[4])position);
}

static void set_forms(struct sampling_judge *j, int number)
{
    struct oracle_triangle *const t = &j->triangle;
    const float w[3] = {t->position[0][3], t->position[1][3], t->position[2][3]};
    for (int i = 0; i < SCENE_VALUES; i++) {
        float value[3];
        for (int k = 0; k < 3; k++) {
            value[k] = vertex_of(j, number, k)->value[i];
        }
        oracle_form_smooth(&j->form[SMOOTH][i], t, value);
        oracle_form_noperspective(&j->form[NOPERSPECTIVE][i], t, value);
    }
    oracle_form_depth(&j->depth, t);
    oracle_form_smooth(&j->w, t, w);
    oracle_form_inverse_w(&j->inverse_w, t);
}

// Notes which pixels have sample s covered by the triangle.
static void cover(struct sampling_judge *j, int s)
{
    struct oracle_triangle moved = j->triangle; // to be read: its integers stay the triangle's
    int y0, y1;
    for (int i = 0; i < moved.corner_count; i++) {
        moved.corner_24_8[i][0] -= j->place_0_8[s][0];
        moved.corner_24_8[i][1] -= j->place_0_8[s][1];
    }
    oracle_rows(&moved, &y0, &y1);
    for (int y = y0; y < y1; y++) {
        int run[ORACLE_CORNERS];
        const int ends = oracle_cover_row(&moved, y, run);
        for (int i = 0; i < ends; i += 2) {
            for (int x = run[i]; x < run[i + 1]; x++) {
                j->covered[y * moved.view.target_width + x] |= (uint16_t)(1 << s);
            }
        }
    }
}

// The pixels that the triangle may have a sample in.
struct bounds {
    int x0, y0, x1, y1;
};

static int clamp(int v, int least, int most)
{
    return v < least ? least : v > most ? most : v;
}

static struct bounds bounds_of(const struct oracle_triangle *t)
{
    int32_t least[2] = {INT32_MAX, INT32_MAX}, most[2] = {INT32_MIN, INT32_MIN};
    for (int i = 0; i < t->corner_count; i++) {
        for (int axis = 0; axis < 2; axis++) {
            const int32_t at = t->corner_24_8[i][axis];
            least[axis] = at < least[axis] ? at : least[axis];
            most[axis] = at > most[axis] ? at : most[axis];
        }
    }
    const int width = t->view.target_width, height = t->view.target_height;
    return t->empty
               ? (struct bounds){0, 0, 0, 0}
               : (struct bounds){clamp(least[0] >> 8, 0, width), clamp(least[1] >> 8, 0, height),
                                 clamp((most[0] >> 8) + 1, 0, width), clamp((most[1] >> 8) + 1, 0, height)};
}

static struct bounds cover_samples(struct sampling_judge *j)
{
    const struct bounds b = bounds_of(&j->triangle);
    for (int y = b.y0; y < b.y1; y++) {
        memset(&j->covered[y * j->scene->view.target_width + b.x0], 0,
               sizeof *j->covered * (size_t)(b.x1 - b.x0));
    }
    for (int s = 0; s < j->samples; s++) {
        cover(j, s);
    }
    return b;
}

// Who covers what; false when the scene has a corner on a rounding tie.
static bool find_owners(struct sampling_judge *j)
{
    memset(j->owner, -1, sizeof j->owner);
    for (int n = 0; n < j->scene->triangle_count; n++) {
        set_triangle(j, n);
        if (j->triangle.ambiguous) {
            return false;
        }
        const struct bounds b = cover_samples(j);
        for (int y = b.y0; y < b.y1; y++) {
            for (int x = b.x0; x < b.x1; x++) {
                const int pixel = y * j->scene->view.target_width + x;
                for (unsigned left = j->covered[pixel]; left != 0; left &= left - 1) {
                    j->owner[__builtin_ctz(left)][pixel] = (int16_t)n;
                }
            }
        }
    }
    return true;
}

// One fragment being compared.
struct fragment {
    struct tally_place at;
    int pixel;
};

static void unequal(struct sampling_judge *j, enum equality what, const struct fragment *f)
{
    if (j->results->unequal[what]++ == 0) {
        j->results->unequal_at[what] = f->at;
    }
}

static void measure(struct sampling_judge *j, enum quantity quantity, const struct fragment *f, double error,
                    int component)
{
    struct tally_place at = f->at;
    at.component = component;
    tally_add(&j->results->quantity[f->at.family][quantity], error, &at);
}

// What the unit of the error of a value at the sample is: the largest vertex value, behind a vertex that cannot be snapped
// as much more as the weights on the screen exceed 1.
static double scale_of(const struct sampling_judge *j, int q, const struct oracle_form *form)
{
    const bool mean = j->triangle.snapped || q == SMOOTH;
    return form->vertex_max * (mean ? 1 : fmax(1, oracle_largest_weight(form, &j->sample)));
}

static bool is_measured(const struct sampling_judge *j, int i)
{
    return j->scene->kind[i] <= VALUE_OPPOSITE;
}

static void compare_values(struct sampling_judge *j, enum quantity quantity, const struct fragment *f, int s)
{
    for (int q = SMOOTH; q <= NOPERSPECTIVE; q++) {
        for (int i = 0; i < SCENE_VALUES; i++) {
            const float got = j->seen[q][s][f->pixel][i];
            const struct oracle_form *const form = &j->form[q][i];
            if (j->scene->kind[i] == VALUE_CONSTANT) {
                if (memcmp(&got, &vertex_of(j, f->at.triangle, 0)->value[i], sizeof got) != 0) {
                    unequal(j, EQUAL_CONSTANT, f);
                }
            } else if (is_measured(j, i)) {
                const double unit = oracle_ulp(scale_of(j, q, form));
                measure(j, quantity, f, oracle_error(form, &j->sample, (double)got, unit), i);
            }
        }
    }
}

// Where the fragment has its values, on the screen, exactly.
static void compare_place(struct sampling_judge *j, const struct fragment *f, int s, const int by_0_8[2])
{
    const float *const seen = j->seen[PLACE][s][f->pixel];
    const float x = (float)f->at.x + (float)(128 + by_0_8[0]) / 256,
                y = (float)f->at.y + (float)(128 + by_0_8[1]) / 256;
    if (seen[0] != x || seen[1] != y) {
        unequal(j, EQUAL_PLACE, f);
    }
}

static void compare_depth(struct sampling_judge *j, const struct fragment *f, int s)
{
    const struct oracle_view *const v = &j->scene->view;
    const float low = fminf(v->depth_min, v->depth_max), high = fmaxf(v->depth_min, v->depth_max);
    const float got = j->seen[PLACE][s][f->pixel][3];
    const double truth = oracle_value(&j->depth, &j->sample);
    if ((got == low && truth < (double)low) || (got == high && truth > (double)high)) {
        return; // clamped to the viewport's range
    }
    measure(j, QUANTITY_SAMPLE_DEPTH, f,
            oracle_error(&j->depth, &j->sample, (double)got, oracle_ulp(j->depth.vertex_max)), 0);
}

static void compare_samples(struct sampling_judge *j, const struct fragment *f)
{
    for (int s = 0; s < j->samples; s++) {
        if (j->owner[s][f->pixel] == f->at.triangle) {
            oracle_sample_beside(&j->sample, &j->triangle, f->at.x, f->at.y, j->place_0_8[s]);
            compare_place(j, f, s, j->place_0_8[s]);
            compare_values(j, QUANTITY_SAMPLE, f, s);
            compare_depth(j, f, s);
        }
    }
}

// Vulkan 1.3 §28.3 leaves open which point of the covered part a centroid is; ours is the first sample that the triangle
// covers, or the centre where it covers all of them. Every sample keeps the one value. The fragment's coordinates are the centre's (Vulkan
// 1.3, FragCoord: "the Centroid interpolation decoration is ignored").
static void compare_centroid(struct sampling_judge *j, const struct fragment *f)
{
    static const int centre[2] = {0, 0};
    const unsigned covered = j->covered[f->pixel], all = (1U << j->samples) - 1;
    const int *const place = covered == all ? centre : j->place_0_8[__builtin_ctz(covered)];
    int first = -1;
    for (int s = 0; s < j->samples; s++) {
        if (j->owner[s][f->pixel] != f->at.triangle) {
            continue;
        }
        if (first < 0) {
            first = s;
            oracle_sample_beside(&j->sample, &j->triangle, f->at.x, f->at.y, place);
            compare_place(j, f, s, centre);
            compare_values(j, QUANTITY_CENTROID, f, s);
        }
        for (int i = 0; i < TARGETS; i++) {
            if (memcmp(j->seen[i][s][f->pixel], j->seen[i][first][f->pixel], sizeof(probe_pixel)) != 0) {
                unequal(j, EQUAL_PLACE, f);
            }
        }
    }
}

// The largest term of the change from the fragment to the offset, as the derivatives have it.
static double largest_change(const struct sampling_judge *j, const struct oracle_form *form)
{
    double largest = 0;
    for (int axis = 0; axis < 2; axis++) {
        double size;
        oracle_derivative(form, &j->triangle, &j->sample, axis, &size);
        largest = fmax(largest, size * abs(j->offset_0_8[axis]) / 256);
    }
    return largest;
}

// At a place within the triangle, of one that has all vertices on the screen. The unit is that of the largest vertex value,
// or of what is added where that is more (slivers); a smooth value's error grows with the largest W over the W there.
static void compare_offset(struct sampling_judge *j, const struct fragment *f)
{
    if ((f->at.x * 5 + f->at.y * 3) % OFFSET_STRIDE != 0 || !j->triangle.snapped ||
        j->owner[0][f->pixel] != f->at.triangle) {
        return;
    }
    oracle_sample_at(&j->sample, &j->triangle, f->at.x, f->at.y);
    oracle_sample_beside(&j->beside, &j->triangle, f->at.x, f->at.y, j->offset_0_8);
    if (!j->sample.inside || !j->beside.inside) {
        return;
    }
    const double inverse_w = oracle_value(&j->inverse_w, &j->beside);
    const double spread = fmax(j->w.vertex_max, largest_change(j, &j->w)) * inverse_w;
    for (int q = SMOOTH; q <= NOPERSPECTIVE; q++) {
        for (int i = 0; i < SCENE_VALUES; i++) {
            const struct oracle_form *const form = &j->form[q][i];
            if (is_measured(j, i)) {
                const double size = fmax(form->vertex_max, largest_change(j, form));
                const double error =
                    oracle_error(form, &j->beside, (double)j->seen[q][0][f->pixel][i], oracle_ulp(size));
                measure(j, QUANTITY_OFFSET, f, q == SMOOTH ? error / fmax(1, spread) : error, i);
            }
        }
    }
}

static void compare_triangle(struct sampling_judge *j, int number)
{
    typedef void compare_function(struct sampling_judge *, const struct fragment *);
    static compare_function *const compare[MODES] = {compare_samples, compare_centroid, compare_offset};
    const struct scene *const scene = j->scene;
    set_triangle(j, number);
    if (j->triangle.empty) {
        return;
    }
    set_forms(j, number);
    const struct bounds b = cover_samples(j);
    for (int y = b.y0; y < b.y1; y++) {
        for (int x = b.x0; x < b.x1; x++) {
            const struct fragment f = {.at = {(int)scene->family, number, x, y, 0, scene->seed, scene->index},
                                       .pixel = y * scene->view.target_width + x};
            if (j->covered[f.pixel] != 0) {
                compare[j->mode](j, &f);
            }
        }
    }
}

// Every sample, that of triangles drawn over each other included, has the triangle that is on top.
static void compare_owners(struct sampling_judge *j)
{
    const int width = j->scene->view.target_width, height = j->scene->view.target_height;
    for (int s = 0; s < j->samples; s++) {
        for (int pixel = 0; pixel < width * height; pixel++) {
            const int owner = j->owner[s][pixel];
            if (j->seen[PLACE][s][pixel][2] != (float)(owner + 1)) {
                const struct fragment f = {.at = {(int)j->scene->family, owner, pixel % width, pixel / width,
                                                  0, j->scene->seed, j->scene->index}};
                unequal(j, EQUAL_OWNER, &f);
            }
        }
    }
}

static void set_places(struct sampling_judge *j)
{
    for (int s = 0; s < j->samples; s++) {
        float at[2] = {0.5F, 0.5F};
        rhw_sample_position(j->samples, s, at);
        for (int axis = 0; axis < 2; axis++) {
            j->place_0_8[s][axis] = (int)(at[axis] * 256) - 128;
        }
    }
}

bool sampling_judge_compare(struct sampling_judge *j, const struct scene *scene,
                            struct judge_results *results)
{
    j->scene = scene;
    j->results = results;
    // Any offset of GLSL's range, −0.5..0.5: two numbers of the scene's own.
    j->offset_0_8[0] = (int)((scene->index * 97 + 11) % 257) - 128;
    j->offset_0_8[1] = (int)((scene->index * 61 + 201) % 257) - 128;
    for (int mode = 0; mode < MODES; mode++) {
        j->mode = (enum mode)mode;
        j->samples = mode == MODE_OFFSET ? 1 : 2 << scene->index % 4;
        set_places(j);
        if (!find_owners(j)) {
            return true; // counted with the centres
        }
        if (!draw(j)) {
            return false;
        }
        compare_owners(j);
        for (int n = 0; n < scene->triangle_count; n++) {
            compare_triangle(j, n);
        }
    }
    return true;
}
