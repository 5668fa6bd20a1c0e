// SPDX-License-Identifier: MIT
// Points are sorted into bins along the longest side of their box. Where clusters are far from each other, the largest
// is still smaller than a bin, and bins between them are empty. The points on both sides of empty bins become two sets,
// and each is looked at in the same way. Sets that an element or their nearness holds together are then joined.
#include "clusters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bounds.h"
#include "draw/camera/box.h"

// Clusters are apart by more than FAR times the size of the larger one.
enum { FAR = SCENE_REMOTE / 4, BINS = FAR, WORDS = BINS / 64, MOST = SCENE_IMPORT_CLUSTERS };

static const double huge = 1e150; // Numbers below have sums and squares within the range of doubles.

// Points that belong together as far as is known.
struct set {
    struct scene_box box;
    uint64_t bins[WORDS]; // a bit is set for each bin that has points
    int axis;
    double scale;         // bins for a unit
    bool is_whole;        // it is not divided any more
    bool is_used;         // an element has a point of it
    uint8_t parent;       // number of a set that it was joined to, or its own
    uint8_t of_bin[BINS]; // number of the set that the points of a bin go to
};

struct search {
    const struct scene_import_points *points;
    uint8_t *of_point;
    struct set sets[MOST];
    uint32_t count;
};

static bool find_point(const struct scene_import_points *points, size_t number, double point[3])
{
    bool is_good = true;
    for (int c = 0; c < 3; c++) {
        point[c] = points->exact != NULL ? points->exact[number][c] : (double)points->floats[number][c];
        is_good = is_good && point[c] > -huge && point[c] < huge; // false of what is not a number
    }
    return is_good;
}

// Bound points that are floats alone. Return false if one of them is no number.
static bool bound_floats(const struct scene_import_points *points, double low[3], double high[3])
{
    float least[3], most[3];
    const bool is_good = scene_import_bound(points->floats, points->count, least, most);
    for (int c = 0; c < 3; c++) {
        low[c] = (double)least[c];
        high[c] = (double)most[c];
    }
    return is_good;
}

// Bound points by the lesser and the greater of two numbers, which no branch depends on. Return false if one of them is
// no good point.
static bool bound_good(const struct scene_import_points *points, double low[3], double high[3])
{
    bool is_good = points->exact != NULL || bound_floats(points, low, high);
    for (size_t i = 0; i < points->count && points->exact != NULL; i++) {
        for (int c = 0; c < 3; c++) {
            const double at = points->exact[i][c];
            low[c] = at < low[c] ? at : low[c];
            high[c] = at > high[c] ? at : high[c];
            is_good &= at == at; // false of what is not a number
        }
    }
    for (int c = 0; c < 3; c++) {
        is_good &= low[c] > -huge && high[c] < huge;
    }
    return is_good;
}

static struct scene_box bound(const struct scene_import_points *points)
{
    struct scene_box box = scene_box_empty();
    double point[3];
    if (points->count > 0 && bound_good(points, box.low, box.high)) {
        return box;
    }
    box = scene_box_empty();
    for (size_t i = 0; i < points->count; i++) {
        if (find_point(points, i, point)) {
            scene_box_extend_to(&box, point);
        }
    }
    return box;
}

// Bins ----------------------------------------------------------------------------------------------

static void choose_bins(struct set *set)
{
    const double longest = scene_box_longest(&set->box);
    set->axis = 0;
    for (int c = 1; c < 3; c++) {
        const double side = set->box.high[c] - set->box.low[c];
        set->axis = side > set->box.high[set->axis] - set->box.low[set->axis] ? c : set->axis;
    }
    set->is_whole = !(longest > 1 / huge);
    set->scale = set->is_whole ? 0 : BINS / longest;
    memset(set->bins, 0, sizeof set->bins);
}

static uint32_t bin_of(const struct set *set, const double point[3])
{
    const double bin = (point[set->axis] - set->box.low[set->axis]) * set->scale;
    return bin < BINS - 1 ? (uint32_t)bin : BINS - 1;
}

static bool has_points(const struct set *set, uint32_t bin)
{
    return (set->bins[bin / 64] >> bin % 64 & 1) != 0;
}

// Return the number of runs of bins with points, or 1 where too many have some to be those of clusters.
static uint32_t count_runs(const struct set *set)
{
    uint32_t runs = 0, filled = 0;
    for (uint32_t i = 0; i < BINS; i++) {
        filled += has_points(set, i);
        runs += has_points(set, i) && (i == 0 || !has_points(set, i - 1));
    }
    return filled > 2 * MOST ? 1 : runs;
}

// Fill the bins of a set by every so many of the points, up to more bins than those of clusters. Return how many are
// filled.
static uint32_t fill_some(struct set *set, const struct scene_import_points *points, size_t step)
{
    uint32_t filled = 0;
    for (size_t i = 0; i < points->count && filled <= 2 * MOST; i += step) {
        double point[3];
        if (find_point(points, i, point)) {
            const uint32_t bin = bin_of(set, point);
            filled += !has_points(set, bin);
            set->bins[bin / 64] |= (uint64_t)1 << bin % 64;
        }
    }
    return filled;
}

static bool may_be(const struct scene_import_points *points, const struct scene_box *box)
{
    enum { SOME = 4096 }; // points from everywhere that nearly always tell
    struct set set = {.box = *box};
    choose_bins(&set);
    if (set.is_whole || fill_some(&set, points, points->count / SOME + 1) > 2 * MOST) {
        return false;
    }
    choose_bins(&set);
    return fill_some(&set, points, 1) <= 2 * MOST && count_runs(&set) > 1;
}

bool scene_import_clusters_may_be(const struct scene_import_points *points)
{
    const struct scene_box box = bound(points);
    return may_be(points, &box);
}

// Sets ----------------------------------------------------------------------------------------------

static void bound_sets(struct search *search)
{
    double point[3];
    for (uint32_t i = 0; i < search->count; i++) {
        if (!search->sets[i].is_whole) {
            search->sets[i].box = scene_box_empty();
        }
    }
    for (size_t i = 0; i < search->points->count; i++) {
        struct set *const set = &search->sets[search->of_point[i]];
        if (!set->is_whole && find_point(search->points, i, point)) {
            scene_box_extend_to(&set->box, point);
        }
    }
}

static void fill_bins(struct search *search)
{
    double point[3];
    for (uint32_t i = 0; i < search->count; i++) {
        if (!search->sets[i].is_whole) {
            choose_bins(&search->sets[i]);
        }
    }
    for (size_t i = 0; i < search->points->count; i++) {
        struct set *const set = &search->sets[search->of_point[i]];
        if (!set->is_whole && find_point(search->points, i, point)) {
            const uint32_t bin = bin_of(set, point);
            set->bins[bin / 64] |= (uint64_t)1 << bin % 64;
        }
    }
}

// Say which sets the bins of a set become. The first of them has its number.
static void divide(struct search *search, uint32_t number)
{
    struct set *const set = &search->sets[number];
    const uint32_t runs = count_runs(set);
    uint32_t run = number, runs_before = 0;
    set->is_whole = set->is_whole || runs < 2 || search->count + runs - 1 > MOST;
    for (uint32_t i = 0; i < BINS && !set->is_whole; i++) {
        const bool begins = has_points(set, i) && (i == 0 || !has_points(set, i - 1));
        run = begins && runs_before > 0 ? search->count++ : run;
        runs_before += begins;
        set->of_bin[i] = (uint8_t)run;
    }
}

// Divide all sets that can be divided. Return false if there are none.
static bool divide_sets(struct search *search)
{
    const uint32_t count = search->count;
    double point[3];
    bound_sets(search);
    fill_bins(search);
    for (uint32_t i = 0; i < count; i++) {
        if (!search->sets[i].is_whole) {
            divide(search, i);
        }
    }
    for (size_t i = 0; i < search->points->count && search->count > count; i++) {
        const struct set *const set = &search->sets[search->of_point[i]];
        if (!set->is_whole && find_point(search->points, i, point)) {
            search->of_point[i] = set->of_bin[bin_of(set, point)];
        }
    }
    return search->count > count;
}

// Elements ------------------------------------------------------------------------------------------

struct scene_import_elements scene_import_elements_of(const struct scene_mesh *mesh)
{
    const uint32_t each = scene_mesh_corners(mesh);
    return (struct scene_import_elements){.corners = mesh->indices,
                                          .count = mesh->index_count / each,
                                          .stride = sizeof(uint32_t),
                                          .each = each};
}

// Return the corner that is so many corners behind one.
static uint32_t corner_at(const struct scene_import_elements *list, const char *first, uint32_t number)
{
    uint32_t corner;
    memcpy(&corner, first + number * list->stride, sizeof corner);
    return corner;
}

static uint32_t size_of(const struct scene_import_elements *list, size_t element)
{
    return list->sizes != NULL ? list->sizes[element] : list->each;
}

static const char *behind(const struct scene_import_elements *list, const char *first, size_t element)
{
    return first + (list->step > 0 ? list->step : size_of(list, element) * list->stride);
}

// Return true if an element is longer than the clusters of the whole could be.
static bool has_long_element(const struct scene_import_points *points,
                             const struct scene_import_elements *list, double longest)
{
    const char *first = list->corners;
    double point[3];
    for (size_t i = 0; i < list->count; first = behind(list, first, i++)) {
        struct scene_box box = scene_box_empty();
        for (uint32_t k = 0; k < size_of(list, i); k++) {
            if (find_point(points, corner_at(list, first, k), point)) {
                scene_box_extend_to(&box, point);
            }
        }
        if (FAR * scene_box_longest(&box) > longest) {
            return true;
        }
    }
    return false;
}

static uint32_t root_of(const struct search *search, uint32_t set)
{
    while (search->sets[set].parent != set) {
        set = search->sets[set].parent;
    }
    return set;
}

static void join(struct search *search, uint32_t a, uint32_t b)
{
    const uint32_t one = root_of(search, a), other = root_of(search, b);
    if (one != other) {
        scene_box_extend(&search->sets[one].box, &search->sets[other].box);
        search->sets[one].is_used = search->sets[one].is_used || search->sets[other].is_used;
        search->sets[other].parent = (uint8_t)one;
    }
}

// Join the sets of an element's corners. Corners that are no good points do not count.
static void join_element(struct search *search, const struct scene_import_elements *list, const char *first,
                         uint32_t size)
{
    uint32_t set = MOST;
    double point[3];
    for (uint32_t k = 0; k < size; k++) {
        const uint32_t corner = corner_at(list, first, k);
        const uint8_t other = search->of_point[corner];
        if (other != set && find_point(search->points, corner, point)) {
            search->sets[other].is_used = true;
            join(search, set < MOST ? set : other, other);
            set = other;
        }
    }
}

static void join_elements(struct search *search, const struct scene_import_elements *list)
{
    const char *first = list->corners;
    for (size_t i = 0; i < list->count; first = behind(list, first, i++)) {
        join_element(search, list, first, size_of(list, i));
    }
}

// Nearness ------------------------------------------------------------------------------------------

// Return how far two boxes are from each other, along the axis where that is furthest.
static double distance(const struct scene_box *a, const struct scene_box *b)
{
    double apart = 0;
    for (int c = 0; c < 3; c++) {
        apart = fmax(apart, fmax(a->low[c] - b->high[c], b->low[c] - a->high[c]));
    }
    return apart;
}

static bool is_near(const struct scene_box *a, const struct scene_box *b)
{
    return distance(a, b) <= FAR * fmax(scene_box_longest(a), scene_box_longest(b));
}

static bool is_cluster(const struct search *search, uint32_t set)
{
    return search->sets[set].is_used && search->sets[set].parent == set;
}

static bool has_size(const struct search *search, uint32_t set)
{
    return scene_box_longest(&search->sets[set].box) > 0;
}

// Join what is near a set. Return false if nothing is.
static bool join_near_to(struct search *search, uint32_t set)
{
    bool joined = false;
    for (uint32_t i = 0; i < search->count; i++) {
        if (i != set && is_cluster(search, i) && is_near(&search->sets[set].box, &search->sets[i].box)) {
            join(search, set, i);
            joined = true;
        }
    }
    return joined;
}

static void join_near(struct search *search)
{
    for (uint32_t i = 0; i < search->count;) {
        // A set that has grown may be near others that were far.
        i = is_cluster(search, i) && join_near_to(search, i) ? 0 : i + 1;
    }
}

static uint32_t nearest(const struct search *search, uint32_t set)
{
    double least = (double)INFINITY;
    uint32_t found = set;
    for (uint32_t i = 0; i < search->count; i++) {
        const double apart = distance(&search->sets[set].box, &search->sets[i].box);
        if (i != set && is_cluster(search, i) && apart < least) {
            least = apart;
            found = i;
        }
    }
    return found;
}

// Join single points that are the nearest to each other. They have no size that could tell how far they are from
// others. Return false if there are none.
static bool join_points(struct search *search)
{
    bool joined = false;
    for (uint32_t i = 0; i < search->count; i++) {
        const uint32_t k = is_cluster(search, i) && !has_size(search, i) ? nearest(search, i) : i;
        if (k != i && !has_size(search, k) && nearest(search, k) == i) {
            join(search, i, k);
            joined = true;
        }
    }
    return joined;
}

// Return the number of clusters that have a size.
static uint32_t count_sized(const struct search *search)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->count; i++) {
        count += is_cluster(search, i) && has_size(search, i);
    }
    return count;
}

// Return the set of an element's first corner that has a place. Return MOST if it has none.
static uint32_t set_of_element(const struct search *search, const struct scene_import_elements *list,
                               const char *first, uint32_t size)
{
    double point[3];
    for (uint32_t k = 0; k < size; k++) {
        const uint32_t corner = corner_at(list, first, k);
        if (find_point(search->points, corner, point)) {
            return root_of(search, search->of_point[corner]);
        }
    }
    return MOST;
}

// Number the clusters in the order of their first elements, and give each point the number of its cluster.
static uint32_t number_clusters(struct search *search, const struct scene_import_elements *lists,
                                size_t list_count)
{
    uint8_t numbers[MOST] = {0};
    uint32_t count = 0;
    for (size_t i = 0; i < list_count; i++) {
        const char *first = lists[i].corners;
        for (size_t k = 0; k < lists[i].count; first = behind(&lists[i], first, k++)) {
            const uint32_t root = set_of_element(search, &lists[i], first, size_of(&lists[i], k));
            if (root < MOST && search->sets[root].is_used) {
                numbers[root] = (uint8_t)count++;
                search->sets[root].is_used = false;
            }
        }
    }
    for (size_t i = 0; i < search->points->count; i++) {
        search->of_point[i] = numbers[root_of(search, search->of_point[i])];
    }
    return count;
}

// Entry ---------------------------------------------------------------------------------------------

struct scene_import_clusters scene_import_clusters_find(struct scene_import *import,
                                                        const struct scene_import_points *points,
                                                        const struct scene_import_elements *lists,
                                                        size_t list_count)
{
    const struct scene_import_clusters one = {1, NULL};
    const struct scene_box box = bound(points);
    const double longest = scene_box_longest(&box);
    for (size_t i = 0; i < list_count; i++) {
        if (has_long_element(points, &lists[i], longest)) {
            return one;
        }
    }
    if (!may_be(points, &box)) {
        return one;
    }
    struct search *const search = scene_import_allocate(import, 1, sizeof *search);
    search->points = points;
    search->of_point = scene_import_allocate(import, points->count, 1);
    search->count = 1;
    while (divide_sets(search)) {
    }
    for (uint32_t i = 0; i < search->count; i++) {
        search->sets[i].parent = (uint8_t)i;
    }
    for (size_t i = 0; i < list_count; i++) {
        join_elements(search, &lists[i]);
    }
    join_near(search);
    while (count_sized(search) < 2 && join_points(search)) {
        join_near(search);
    }
    struct scene_import_clusters clusters = one;
    if (count_sized(search) > 1) {
        clusters.count = number_clusters(search, lists, list_count);
        clusters.of_point = search->of_point;
    } else {
        free(search->of_point);
    }
    free(search);
    return clusters;
}
