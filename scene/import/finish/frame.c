// SPDX-License-Identifier: MIT
// See frame.h. The search for specks begins with the box around the middle of all area. The box grows by what lies near
// until a gap is around it, or nothing is left.
#include "frame.h"

#include <math.h>
#include <stdlib.h>

#include "cloud_frame.h"
#include "draw/camera/camera_math.h"
#include "draw/camera/subject.h"
#include "import/builder/numbers.h"

static const double gap = 16, largest_speck = 0.1, largest_share = 0.02, tail = 0.1;
enum { BINS = 256, GAP_BINS = 64, ROUNDS = 4, GROWTHS = 64 };

// A triangle, line or point in the world. Its weight is an area, or 1 for a line and a point.
struct unit {
    struct scene_box box;
    double weight;
    bool is_area;
};

struct search {
    const struct scene_model *model;
    const struct scene_seen_mesh *seen;
    bool takes_flat;      // flat instances are searched too, as there are no others
    struct scene_box all; // what lies outside is left out already
    double area, count;   // weights of all units
    uint32_t triangles;   // how many units have an area
    bool ignores_count;   // lines and points are so few beside triangles that they weigh nothing
    double bins[3][BINS]; // shares of the weights along each axis
    struct scene_box core, near, grown;
    double left_area, left_count, left_length;
    bool is_left;
};

typedef void visit(struct search *search, const struct unit *unit);

// Units -----------------------------------------------------------------------------------------------

static double triangle_area(double corners[3][3])
{
    double a[3], b[3], product[3];
    for (int c = 0; c < 3; c++) {
        a[c] = corners[1][c] - corners[0][c];
        b[c] = corners[2][c] - corners[0][c];
    }
    scene_cross(a, b, product);
    return 0.5 * __builtin_sqrt(scene_dot(product, product));
}

static void visit_instance(struct search *search, const struct scene_instance *instance, visit *visitor)
{
    const struct scene_mesh *mesh = &search->model->meshes[instance->mesh];
    const bool *seen = search->seen[instance->mesh].vertices;
    const uint32_t count = scene_mesh_corners(mesh);
    for (uint32_t i = 0; i + count <= mesh->index_count; i += count) {
        struct unit unit = {.box = scene_box_empty(), .weight = 1, .is_area = count == 3};
        double corners[3][3];
        bool shows = true;
        for (uint32_t k = 0; k < count; k++) {
            const uint32_t vertex = mesh->indices[i + k];
            scene_place_point(instance->world, mesh->positions[vertex], corners[k]);
            scene_box_extend_to(&unit.box, corners[k]);
            shows = shows && (seen == NULL || seen[vertex]);
        }
        if (count == 3) {
            unit.weight = triangle_area(corners);
        }
        if (shows && unit.weight > 0 && scene_box_holds(&search->all, &unit.box)) {
            visitor(search, &unit);
        }
    }
}

// Return the axis in which an instance is thin, as a ground or a sheet is. Return −1 if there is none. What is thin in
// two axes, as a pole is, or a row of small things, is not flat.
static int flat_axis(const struct scene_model *model, uint32_t instance, struct scene_box *box)
{
    const int axis = scene_subject_thin_axis(model, instance, box);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double across = fmin(box->high[u] - box->low[u], box->high[v] - box->low[v]);
    return axis >= 0 && box->high[axis] - box->low[axis] <= 0.25 * across ? axis : -1;
}

static bool is_searched(const struct search *search, uint32_t number)
{
    struct scene_box box;
    return !search->model->instances[number].unseen &&
           (search->takes_flat || flat_axis(search->model, number, &box) < 0);
}

static void visit_all(struct search *search, visit *visitor)
{
    for (uint32_t i = 0; i < search->model->instance_count; i++) {
        if (is_searched(search, i)) {
            visit_instance(search, &search->model->instances[i], visitor);
        }
    }
}

// The search ------------------------------------------------------------------------------------------

static bool sees_all(const struct search *search)
{
    bool all = true;
    for (uint32_t i = 0; i < search->model->instance_count && all; i++) {
        const struct scene_instance *instance = &search->model->instances[i];
        all = !instance->unseen && search->seen[instance->mesh].vertices == NULL;
    }
    return all;
}

// Extend a box by the vertices of an instance that are seen.
static void extend_by(const struct scene_instance *instance, const struct scene_mesh *mesh, const bool *seen,
                      struct scene_box *box)
{
    const bool is_moved = !scene_import_is_identity(instance->world);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        const float *const from = mesh->positions[v];
        double point[3] = {(double)from[0], (double)from[1], (double)from[2]};
        if (is_moved) {
            scene_place_point(instance->world, from, point);
        }
        if (seen == NULL || seen[v]) {
            scene_box_extend_to(box, point);
        }
    }
}

// Find the bounds of all vertices that are seen.
static struct scene_box seen_box(const struct search *search)
{
    struct scene_box box = scene_box_empty();
    if (sees_all(search)) {
        return scene_box_of(search->model->bounds_min, search->model->bounds_max);
    }
    for (uint32_t i = 0; i < search->model->instance_count; i++) {
        const struct scene_instance *instance = &search->model->instances[i];
        if (!instance->unseen) {
            extend_by(instance, &search->model->meshes[instance->mesh], search->seen[instance->mesh].vertices,
                      &box);
        }
    }
    return box;
}

static int find_bin(const struct search *search, int axis, double at, int bins)
{
    const double low = search->all.low[axis], side = search->all.high[axis] - low;
    const double place = side > 0 ? (at - low) / side * bins : 0;
    return place > 0 ? place < bins ? (int)place : bins - 1 : 0;
}

// Return the length of the longest run of bins without vertices along any axis.
static int widest_gap(bool used[3][GAP_BINS])
{
    int widest = 0;
    for (int c = 0; c < 3; c++) {
        for (int bin = 0, empty = 0; bin < GAP_BINS; bin++) {
            empty = used[c][bin] ? 0 : empty + 1;
            widest = empty > widest ? empty : widest;
        }
    }
    return widest;
}

// Mark the bins of every so many vertices of an instance, from `first` up to `end`.
static void use_bins(const struct search *search, const struct scene_instance *instance, uint32_t first,
                     uint32_t end, uint32_t step, bool used[3][GAP_BINS])
{
    const struct scene_mesh *mesh = &search->model->meshes[instance->mesh];
    for (uint32_t v = first; v < end; v += step) {
        struct scene_box point = scene_box_empty();
        double place[3];
        scene_place_point(instance->world, mesh->positions[v], place);
        scene_box_extend_to(&point, place);
        for (int c = 0; c < 3 && scene_box_holds(&search->all, &point); c++) {
            used[c][find_bin(search, c, place[c], GAP_BINS)] = true;
        }
        if (end - v <= step) {
            break;
        }
    }
}

static bool is_closed(bool used[3][GAP_BINS])
{
    return widest_gap(used) < GAP_BINS / 4;
}

// Return true if a quarter of the extent along an axis is without vertices. Hardly a model has so wide a gap, so this
// spares the rest of the search. Some vertices from everywhere tell, or else the next thousands of them.
static bool has_gap(const struct search *search)
{
    enum { SOME = 2048 };
    bool used[3][GAP_BINS] = {{false}};
    for (int is_whole = 0; is_whole < 2; is_whole++) {
        for (uint32_t i = 0; i < search->model->instance_count; i++) {
            const struct scene_instance *instance = &search->model->instances[i];
            const uint32_t count =
                is_searched(search, i) ? search->model->meshes[instance->mesh].vertex_count : 0;
            for (uint32_t v = 0; v < count && is_whole; v += SOME) {
                const uint32_t end = count - v < SOME ? count : v + SOME;
                use_bins(search, instance, v, end, 1, used);
                if (end == count || is_closed(used)) {
                    break;
                }
            }
            if (!is_whole) {
                use_bins(search, instance, 0, count, count / SOME + 1, used);
            }
            if (is_closed(used)) {
                return false;
            }
        }
    }
    return true;
}

static void weigh(struct search *search, const struct unit *unit)
{
    *(unit->is_area ? &search->area : &search->count) += unit->weight;
    search->triangles += unit->is_area;
}

static void fill_bins(struct search *search, const struct unit *unit)
{
    const double share = unit->is_area           ? unit->weight / search->area
                         : search->ignores_count ? 0
                                                 : unit->weight / search->count;
    for (int c = 0; c < 3; c++) {
        const double middle = 0.5 * (unit->box.low[c] + unit->box.high[c]);
        search->bins[c][find_bin(search, c, middle, BINS)] += share;
    }
}

static void grow_middle(struct search *search, const struct unit *unit)
{
    struct scene_box middle;
    for (int c = 0; c < 3; c++) {
        middle.low[c] = middle.high[c] = 0.5 * (unit->box.low[c] + unit->box.high[c]);
    }
    if (scene_box_overlaps(&search->near, &middle)) {
        scene_box_extend(&search->grown, &unit->box);
    }
}

static void grow(struct search *search, const struct unit *unit)
{
    if (scene_box_overlaps(&search->near, &unit->box)) {
        scene_box_extend(&search->grown, &unit->box);
        return;
    }
    const double length = scene_box_longest(&unit->box);
    *(unit->is_area ? &search->left_area : &search->left_count) += unit->weight;
    search->left_length = length > search->left_length ? length : search->left_length;
    search->is_left = true;
}

// Set the core to the bounds of what has its middle among the weight that is left without a tenth at each end of each
// axis. Return false if there is nothing.
static bool find_middle(struct search *search)
{
    search->area = search->count = 0;
    search->triangles = 0;
    visit_all(search, weigh);
    search->ignores_count = search->area > 0 && search->count <= 1 + largest_share * search->triangles;
    const double whole = (search->area > 0) + (search->count > 0 && !search->ignores_count);
    for (int c = 0; c < 3; c++) {
        for (int bin = 0; bin < BINS; bin++) {
            search->bins[c][bin] = 0;
        }
    }
    visit_all(search, fill_bins);
    for (int c = 0; c < 3; c++) {
        const double low = search->all.low[c], side = search->all.high[c] - low;
        int first = 0, last = BINS - 1;
        for (double sum = search->bins[c][first]; first < last && sum <= tail * whole;
             sum += search->bins[c][first]) {
            first++;
        }
        for (double sum = search->bins[c][last]; last > first && sum <= tail * whole;
             sum += search->bins[c][last]) {
            last--;
        }
        search->near.low[c] = low + side * first / BINS;
        search->near.high[c] = low + side * (last + 1) / BINS;
    }
    search->grown = scene_box_empty();
    visit_all(search, grow_middle);
    search->core = search->grown;
    return search->core.low[0] <= search->core.high[0];
}

// Return true if a flat instance stands far from the core. Flat instances are not searched.
static bool has_far_flat(const struct search *search)
{
    const struct scene_box near = scene_box_grown(&search->core, gap * scene_box_longest(&search->core));
    bool found = false;
    for (uint32_t i = 0; i < search->model->instance_count && !found; i++) {
        const struct scene_box box = scene_subject_box(search->model, i);
        found = !search->model->instances[i].unseen && !is_searched(search, i) &&
                scene_box_holds(&search->all, &box) && !scene_box_overlaps(&near, &box);
    }
    return found;
}

// Let the core grow until a gap is around it. Return true if what is left are specks.
static bool find_specks(struct search *search)
{
    for (int i = 0; i < GROWTHS; i++) {
        const double reach = gap * scene_box_longest(&search->core);
        search->grown = search->core;
        search->left_area = search->left_count = search->left_length = 0;
        search->is_left = false;
        search->near = scene_box_grown(&search->core, reach);
        visit_all(search, grow);
        if (scene_box_holds(&search->core, &search->grown)) {
            return (search->is_left || has_far_flat(search)) &&
                   search->left_area <= largest_share * search->area &&
                   (search->ignores_count || search->left_count <= largest_share * search->count) &&
                   search->left_length <= largest_speck * scene_box_longest(&search->core);
        }
        search->core = search->grown;
    }
    return false;
}

// Add the flat instances to what was found. Return false if one of them stands far away and is no speck. What is
// hundreds of times as large is a ground and no part of a picture's subject.
static bool add_flat(const struct search *search, struct scene_box *frame)
{
    const double length = scene_box_longest(frame), reach = gap * length;
    const struct scene_box near = scene_box_grown(frame, reach);
    for (uint32_t i = 0; i < search->model->instance_count; i++) {
        struct scene_box box;
        if (search->model->instances[i].unseen || is_searched(search, i)) {
            continue;
        }
        const int axis = flat_axis(search->model, i, &box);
        if (scene_subject_is_ground(&box, axis, &search->core)) {
            continue;
        }
        if (scene_box_overlaps(&near, &box)) {
            scene_box_extend(frame, &box);
        } else if (scene_box_longest(&box) > largest_speck * length) {
            return false;
        }
    }
    return true;
}

// Leave specks out of the frame. Return true if there were any.
static bool leave_specks(struct search *search, struct scene_box *frame)
{
    search->takes_flat = true;
    for (uint32_t i = 0; i < search->model->instance_count && search->takes_flat; i++) {
        struct scene_box box;
        search->takes_flat = search->model->instances[i].unseen || flat_axis(search->model, i, &box) >= 0;
    }
    bool found = false;
    for (int round = 0; round < ROUNDS; round++) {
        if (!has_gap(search) || !find_middle(search) || !find_specks(search)) {
            break;
        }
        search->all = search->core;
        found = true;
    }
    struct scene_box all = search->all;
    search->core = all;
    if (!found || !add_flat(search, &all)) {
        return false;
    }
    *frame = all;
    return true;
}

void scene_frame_find(struct scene_import *import, const struct scene_seen_mesh *seen)
{
    struct scene_model *model = &import->model;
    struct search *search = scene_import_allocate(import, 1, sizeof *search);
    *search = (struct search){.model = model, .seen = seen};
    struct scene_box frame = seen_box(search);
    const double before = scene_box_longest(&frame);
    search->all = scene_box_grown(&frame, 1e-5 * before); // the bounds are rounded
    const bool has_specks = leave_specks(search, &frame);
    if (scene_cloud_frame_trim(model, &frame)) {
        scene_import_warn(import, "stray points are outside a fitted picture; --fit=all shows them");
    } else if (has_specks) {
        scene_import_warn(import, "specks far away from all else are outside a fitted picture; "
                                  "--fit=all shows them");
    }
    free(search);
    if (!(frame.low[0] <= frame.high[0])) {
        return;
    }
    const double rounding = 1e-5 * before;
    for (int c = 0; c < 3; c++) {
        model->frame_min[c] = (float)frame.low[c];
        model->frame_max[c] = (float)frame.high[c];
        model->is_framed = model->is_framed || frame.low[c] > (double)model->bounds_min[c] + rounding ||
                           frame.high[c] < (double)model->bounds_max[c] - rounding;
    }
}
