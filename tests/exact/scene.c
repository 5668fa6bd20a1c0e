// SPDX-License-Identifier: MIT
// See scene.h.
#include "scene.h"

#include <math.h>
#include <string.h>

#include "random.h"

enum { SMALL = 128, ODD_WIDTH = 131, ODD_HEIGHT = 117, LARGE = 16384 };

static const char *const family_names[FAMILY_COUNT] = {
    "ordinary",   "sliver",     "micro",   "large", "perspective", "near_far", "guard_band", "behind",
    "everything", "cut_sliver", "horizon", "fan",   "strip",       "grid",     "cut_grid",
};

static const char *const kind_names[VALUE_KINDS] = {
    "unit", "signed", "offset", "opposite", "denormal", "huge", "wide", "constant",
};

const char *scene_family_name(enum family family)
{
    return family_names[family];
}

const char *scene_kind_name(enum value_kind kind)
{
    return kind_names[kind];
}

enum family scene_family_named(const char *name)
{
    int i = 0;
    while (i < FAMILY_COUNT && strcmp(family_names[i], name) != 0) {
        i++;
    }
    return (enum family)i;
}

// Puts a vertex at (x, y) pixels of the target with depth z = Z/W (0..1, as the near and far planes have it).
static void place(const struct scene *s, struct scene_vertex *v, double x, double y, double z, double w)
{
    const struct oracle_view *const view = &s->view;
    const double half_width = (double)view->width / 2, half_height = (double)view->height / 2;
    v->position[0] = (float)((x - (double)view->x - half_width) / half_width * w);
    v->position[1] = (float)(((double)view->y + half_height - y) / half_height * w);
    v->position[2] = (float)((view->minus_one_to_one ? 2 * z - 1 : z) * w);
    v->position[3] = (float)w;
}

// Positions on the 1/256 grid and values of W with few bits make X, Y and W exact floats. Every other mesh of
// these stands on half pixels, where samples on edges and corners are the rule.
static double grid(const struct scene *s, double pixels)
{
    const double steps = s->mesh && s->index % 4 == 2 ? 2 : 256;
    return s->index % 2 ? pixels : rint(pixels * steps) / steps;
}

static double few_bits(const struct scene *s, double w)
{
    int exponent;
    const double fraction = frexp(w, &exponent);
    return s->index % 2 ? w : ldexp(rint(fraction * 64), exponent - 6);
}

static double make_value(struct random *r, enum value_kind kind, double shared)
{
    switch (kind) {
    case VALUE_UNIT: return random_between(r, 0, 1);
    case VALUE_SIGNED: return random_between(r, -1, 1);
    case VALUE_OFFSET: return 1e6 + random_between(r, 0, 16);
    case VALUE_OPPOSITE: return random_sign(r) * (1 - random_between(r, 0, 0x1p-8)) * shared;
    case VALUE_DENORMAL: return random_sign(r) * random_scale(r, -149, -126);
    case VALUE_HUGE: return random_sign(r) * random_between(r, 0, 1) * 0x1p126;
    case VALUE_WIDE: return random_sign(r) * random_scale(r, -60, 60);
    default: return shared;
    }
}

// Values of all vertices. A constant and the power of two of VALUE_OPPOSITE are shared by the whole scene.
static void make_values(struct scene *s, struct random *r)
{
    static const enum value_kind sets[2][SCENE_VALUES] = {
        {VALUE_SIGNED, VALUE_OFFSET, VALUE_DENORMAL, VALUE_CONSTANT},
        {VALUE_OPPOSITE, VALUE_UNIT, VALUE_HUGE, VALUE_WIDE},
    };
    memcpy(s->kind, sets[s->index / 2 % 2], sizeof s->kind);
    const double constant = random_sign(r) * random_scale(r, -140, 126),
                 power = ldexp(1, random_below(r, 200) - 100);
    for (int i = 0; i < s->vertex_count; i++) {
        for (int k = 0; k < SCENE_VALUES; k++) {
            s->vertex[i].value[k] =
                (float)make_value(r, s->kind[k], s->kind[k] == VALUE_OPPOSITE ? power : constant);
        }
        s->vertex[i].flat[0] = (float)random_between(r, -1, 1);
        s->vertex[i].flat[1] = (float)(random_sign(r) * random_scale(r, -149, 127));
    }
}

static struct scene_vertex *add(struct scene *s)
{
    return &s->vertex[s->vertex_count++];
}

static void add_triangle(struct scene *s, int a, int b, int c)
{
    int *const t = s->triangle[s->triangle_count++];
    t[0] = a;
    t[1] = b;
    t[2] = c;
}

// Triangles of a list, each with vertices of its own.
static void list_triangles(struct scene *s)
{
    for (int i = 0; i + 2 < s->vertex_count; i += 3) {
        add_triangle(s, i, i + 1, i + 2);
    }
}

static double pick_x(const struct scene *s, struct random *r)
{
    return grid(s, random_between(r, -0.2, 1.2) * s->view.target_width);
}

static double pick_y(const struct scene *s, struct random *r)
{
    return grid(s, random_between(r, -0.2, 1.2) * s->view.target_height);
}

static void make_ordinary(struct scene *s, struct random *r)
{
    for (int i = 0; i < 3; i++) {
        place(s, add(s), pick_x(s, r), pick_y(s, r), random_between(r, 0, 1),
              few_bits(s, random_scale(r, -2, 3)));
    }
}

static void make_perspective(struct scene *s, struct random *r)
{
    const double log2_ratio = random_between(r, 0, log2(1e6)), scale = random_between(r, -10, 10);
    for (int i = 0; i < 3; i++) {
        const double log2_w = i == 0 ? 0 : i == 1 ? log2_ratio : random_between(r, 0, log2_ratio);
        const double w = few_bits(s, exp2(scale + log2_w));
        place(s, add(s), pick_x(s, r), pick_y(s, r), random_between(r, 0, 1), w);
    }
}

// The third vertex lies a few 1/256 pixel off the line through the others, which passes through the target and
// ends up to 16384 pixels away.
static void make_slivers(struct scene *s, struct random *r)
{
    // Hardly any covers more than a few samples: many at a time, or drawing would be all the work.
    for (int n = 0; n < 480; n++) {
        const bool deep = n % 4 == 0; // a pixel centre is at the far end, where the sum behind 1/W cancels
        const double x = deep ? floor(pick_x(s, r)) + 0.5 : pick_x(s, r), angle = random_between(r, 0, 6.28);
        const double y = deep ? floor(pick_y(s, r)) + 0.5 : pick_y(s, r);
        const double before = deep ? 0 : random_scale(r, 0, n % 2 ? 6 : 13.9);
        const double after = -random_scale(r, 0, n % 2 ? 6 : 13.9);
        const double along = before + random_between(r, -0.3, 1.3) * (after - before);
        const double at[3] = {before, after, along < -16000 ? -16000 : along > 16000 ? 16000 : along};
        const double log2_ratio = random_between(r, 0, 20);
        const double off_x = random_between(r, -4, 4) / 256, off_y = random_between(r, -4, 4) / 256;
        const int turn = random_below(r, 3);
        for (int i = 0; i < 3; i++) {
            const int k = (i + turn) % 3;
            place(s, add(s), grid(s, x + at[k] * cos(angle) + (k == 2 ? off_x : 0)),
                  grid(s, y + at[k] * sin(angle) + (k == 2 ? off_y : 0)), random_between(r, 0, 1),
                  few_bits(s, deep ? exp2(k == 0 ? log2_ratio : 0) : random_scale(r, 0, log2_ratio)));
        }
    }
}

static void make_micro(struct scene *s, struct random *r)
{
    for (int n = 0; n < SCENE_VERTICES / 3 && n < SCENE_TRIANGLES; n++) {
        const double x = pick_x(s, r), y = pick_y(s, r), size = random_scale(r, -6, 0);
        for (int i = 0; i < 3; i++) {
            place(s, add(s), grid(s, x + random_between(r, -size, size)),
                  grid(s, y + random_between(r, -size, size)), random_between(r, 0, 1),
                  few_bits(s, random_scale(r, 0, 4)));
        }
    }
}

// Vertices around the window, each in its own third of the directions, so that most scenes cover some of it.
static void make_large(struct scene *s, struct random *r)
{
    const double turn = random_between(r, 0, 6.28);
    for (int i = 0; i < 3; i++) {
        const double angle = turn + i * 2.09 + random_between(r, -0.6, 0.6),
                     distance = random_scale(r, 6, 13.9);
        const double x = s->view.target_width / 2 + distance * cos(angle);
        const double y = s->view.target_height / 2 + distance * sin(angle);
        const double w = s->index % 2 ? random_scale(r, 0, 8) : exp2(random_below(r, 8));
        place(s, add(s), grid(s, x), grid(s, y), random_between(r, 0, 1), w);
    }
}

static void make_near_far(struct scene *s, struct random *r)
{
    for (int i = 0; i < 3; i++) {
        const double z =
            random_chance(r, 0.5) ? random_between(r, -1, 2) : random_sign(r) * random_scale(r, -8, 12);
        place(s, add(s), pick_x(s, r), pick_y(s, r), z, few_bits(s, random_scale(r, -2, 4)));
    }
}

// Far outside of the target on one or both axes.
static void place_outside(const struct scene *s, struct scene_vertex *v, struct random *r, double z, double w)
{
    const int which = random_below(r, 3);
    const double x = which == 1 ? pick_x(s, r) : random_sign(r) * random_scale(r, 14, 24);
    const double y = which == 0 ? pick_y(s, r) : random_sign(r) * random_scale(r, 14, 24);
    place(s, v, x, y, z, w);
}

static void make_guard_band(struct scene *s, struct random *r)
{
    const int outside = 1 + random_below(r, 7); // which vertices, as bits
    for (int i = 0; i < 3; i++) {
        const double z = random_between(r, 0, 1), w = random_scale(r, 0, 6);
        if (outside >> i & 1) {
            place_outside(s, add(s), r, z, w);
        } else {
            place(s, add(s), pick_x(s, r), pick_y(s, r), z, w);
        }
    }
}

// A vertex at or behind the eye: W <= 0. Z follows W as a projection with near plane `near` has it.
static void place_behind(const struct scene *s, struct scene_vertex *v, struct random *r, double near)
{
    const double w = random_chance(r, 0.25) ? 0 : -random_scale(r, -8, 4);
    v->position[0] = (float)(random_between(r, -2, 2));
    v->position[1] = (float)(random_between(r, -2, 2));
    v->position[3] = (float)w;
    v->position[2] = (float)(s->view.minus_one_to_one ? w - 2 * near : w - near);
}

static void place_in_front(const struct scene *s, struct scene_vertex *v, struct random *r, double near)
{
    const double w = near * (1 + random_scale(r, -3, 8));
    place(s, v, pick_x(s, r), pick_y(s, r), 0, w);
    v->position[2] = (float)(s->view.minus_one_to_one ? w - 2 * near : w - near);
}

static void make_behind(struct scene *s, struct random *r)
{
    const double near = random_scale(r, -8, 0);
    const int behind = 1 + random_below(r, 6);
    for (int i = 0; i < 3; i++) {
        if (behind >> i & 1) {
            place_behind(s, add(s), r, near);
        } else {
            place_in_front(s, add(s), r, near);
        }
    }
}

static void make_everything(struct scene *s, struct random *r)
{
    const double near = random_scale(r, -8, 0);
    for (int i = 0; i < 3; i++) {
        struct scene_vertex *const v = add(s);
        switch (random_below(r, 4)) {
        case 0: place_behind(s, v, r, near); break;
        case 1: place_in_front(s, v, r, near); break;
        case 2: place_outside(s, v, r, random_between(r, -1, 2), random_scale(r, -8, 8)); break;
        default:
            place(s, v, pick_x(s, r), pick_y(s, r), random_between(r, -1, 2), random_scale(r, -8, 8));
            break;
        }
    }
}

// A sliver a few float ULP thin along a line of pixel centres: from a centre in a direction of small integers to
// a vertex that cannot be snapped. Weights are quotients of almost nothing by almost nothing here.
static void place_thinnest(const struct scene *s, struct scene_vertex v[3], struct random *r, double near)
{
    const double x = random_below(r, s->view.target_width) + 0.5,
                 y = random_below(r, s->view.target_height) + 0.5;
    const double dx = random_below(r, 9) - 4, dy = random_below(r, 9) - 4;
    const double far = random_chance(r, 0.5) ? 0x1p17 : 20, w = few_bits(s, random_scale(r, 0, 6));
    place(s, &v[0], x, y, random_between(r, 0, 1), w);
    place(s, &v[1], x + far * dx, y + far * dy, random_between(r, 0, 1), far < 100 ? -few_bits(s, near) : w);
    place(s, &v[2], x + 7 * dx, y + 7 * dy, random_between(r, 0, 1), few_bits(s, random_scale(r, 0, 6)));
    for (int k = 0; k < 2; k++) {
        for (int steps = random_below(r, 4); steps > 0; steps--) {
            v[2].position[k] = nextafterf(v[2].position[k], random_sign(r) > 0 ? 1e30F : -1e30F);
        }
    }
}

// Thin triangles that are cut: with a vertex behind the eye, with one beyond the guard band, or with all three
// on the screen and the near and far planes between them. The third vertex is a point of the line through the
// others, moved a little.
static void make_cut_slivers(struct scene *s, struct random *r)
{
    for (int n = 0; n < 48; n++) {
        const double near = random_scale(r, -8, 0), shift = random_scale(r, -24, -6);
        const double a = n % 2 ? random_between(r, -1, 2) : random_between(r, 0, 1);
        struct scene_vertex *const v = &s->vertex[s->vertex_count];
        s->vertex_count += 3;
        place_in_front(s, &v[0], r, near);
        switch (random_below(r, 4)) {
        case 0: place_behind(s, &v[1], r, near); break;
        case 1: place_outside(s, &v[1], r, random_between(r, 0, 1), random_scale(r, 0, 6)); break;
        case 2: place_thinnest(s, v, r, near); continue;
        default:
            place(s, &v[0], pick_x(s, r), pick_y(s, r), random_between(r, -1, 1), random_scale(r, 0, 6));
            place(s, &v[1], pick_x(s, r), pick_y(s, r), random_between(r, 0, 2), random_scale(r, 0, 6));
            break;
        }
        for (int k = 0; k < 4; k++) {
            const double on_line = (1 - a) * (double)v[0].position[k] + a * (double)v[1].position[k];
            v[2].position[k] = (float)(on_line * (1 + shift * random_between(r, -1, 1)));
        }
    }
}

// Two triangles from behind the eye almost to the horizon. With an odd height of the target the horizon is a row
// of pixel centres, and snapping moves the far edge onto it: 1/W is next to 0 there.
static void make_horizon(struct scene *s, struct random *r)
{
    const double far = random_scale(r, 4, 24), height = random_scale(r, -6, 0), near = random_scale(r, -4, 0);
    const double shift = random_between(r, -1, 1);
    static const int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < 6; i++) {
        const double w = order[i][1] ? far : -1, z = s->view.minus_one_to_one ? w - 2 * near : w - near;
        const double position[4] = {(order[i][0] ? 1 : -1) * fabs(w) + shift, -height, z, w};
        struct scene_vertex *const v = add(s);
        for (int k = 0; k < 4; k++) {
            v->position[k] = (float)position[k];
        }
    }
}

// A convex ring around a centre. Consecutive vertices are less than half a turn apart, so triangles of a
// fan turn the same way, unless snapping turns a very thin one.
static void make_fan(struct scene *s, struct random *r)
{
    const int spokes = 3 + random_below(r, 40);
    const double x = s->view.target_width * random_between(r, 0.3, 0.7);
    const double y = s->view.target_height * random_between(r, 0.3, 0.7);
    const double radius = random_between(r, 4, 70), turn = random_between(r, 0, 6.28);
    s->topology = RHW_TRIANGLE_FAN;
    place(s, add(s), grid(s, x), grid(s, y), random_between(r, 0, 1), few_bits(s, random_scale(r, 0, 3)));
    for (int i = 0; i <= spokes; i++) {
        struct scene_vertex *const v = add(s);
        if (i == spokes) {
            *v = s->vertex[1];
            break;
        }
        const double angle = turn + 6.283185307 * (i + random_between(r, 0, 0.3)) / spokes;
        const double reach = radius * random_between(r, 0.8, 1);
        place(s, v, grid(s, x + reach * cos(angle)), grid(s, y + reach * sin(angle)), random_between(r, 0, 1),
              few_bits(s, random_scale(r, 0, 3)));
    }
    for (int i = 0; i < spokes; i++) {
        add_triangle(s, i + 1, i + 2, 0);
    }
}

static void make_strip(struct scene *s, struct random *r)
{
    const int count = 4 + random_below(r, 60);
    const double step = random_between(r, 2, 30), top = random_between(r, 5, 40),
                 height = random_between(r, 2, 60);
    s->topology = RHW_TRIANGLE_STRIP;
    for (int i = 0; i < count; i++) {
        const double x = -5 + step * (i / 2 + random_between(r, 0, 0.4));
        const double y = top + (i % 2) * height + random_between(r, -0.45, 0.45) * height;
        place(s, add(s), grid(s, x), grid(s, y), random_between(r, 0, 1), few_bits(s, random_scale(r, 0, 3)));
    }
    for (int i = 0; i + 2 < count; i++) {
        const int odd = i & 1;
        add_triangle(s, i, i + 1 + odd, i + 2 - odd);
    }
}

static void grid_triangles(struct scene *s, int columns, int rows, const struct scene_vertex *corner)
{
    for (int y = 0; y < rows; y++) {
        for (int x = 0; x < columns; x++) {
            const int at[4] = {y * (columns + 1) + x, y * (columns + 1) + x + 1, (y + 1) * (columns + 1) + x,
                               (y + 1) * (columns + 1) + x + 1};
            const int order[2][6] = {{0, 1, 2, 1, 3, 2}, {0, 1, 3, 3, 2, 0}};
            for (int i = 0; i < 6; i++) {
                *add(s) = corner[at[order[(x * 7 + y * 3) % 2][i]]];
            }
        }
    }
    list_triangles(s);
}

// A jittered grid on the screen with a W of its own at every corner.
static void make_grid(struct scene *s, struct random *r)
{
    const int columns = 1 + random_below(r, 16), rows = 1 + random_below(r, 16);
    const double width = random_between(r, 0.1, 1.4) * s->view.target_width / columns;
    const double height = random_between(r, 0.1, 1.4) * s->view.target_height / rows;
    const double x0 = random_between(r, -20, 60), y0 = random_between(r, -20, 60);
    struct scene_vertex corner[17 * 17];
    memset(corner, 0, sizeof corner);
    for (int i = 0; i < (columns + 1) * (rows + 1); i++) {
        const double x = x0 + width * (i % (columns + 1) + random_between(r, 0, 0.4));
        const double y = y0 + height * (i / (columns + 1) + random_between(r, 0, 0.4));
        place(s, &corner[i], grid(s, x), grid(s, y), random_between(r, 0, 1),
              few_bits(s, random_scale(r, 0, 3)));
    }
    grid_triangles(s, columns, rows, corner);
}

// A floor under the eye, seen in perspective: cells behind the eye, cells that the near plane cuts, cells
// that reach beyond the guard band.
static void make_cut_grid(struct scene *s, struct random *r)
{
    const int columns = 1 + random_below(r, 16), rows = 1 + random_below(r, 16);
    const double near = random_scale(r, -10, -2), height = random_scale(r, -6, 1),
                 tilt = random_between(r, -0.5, 0.5);
    const double extent = random_scale(r, 0, 6), turn = random_between(r, 0, 6.28),
                 far = random_scale(r, 0, 6);
    struct scene_vertex corner[17 * 17];
    memset(corner, 0, sizeof corner);
    for (int i = 0; i < (columns + 1) * (rows + 1); i++) {
        const double u = (i % (columns + 1) + random_between(r, 0, 0.4)) / columns - 0.5;
        const double v = (i / (columns + 1) + random_between(r, 0, 0.4)) / rows - 0.5;
        const double x = extent * (u * cos(turn) - v * sin(turn)),
                     depth = extent * (u * sin(turn) + v * cos(turn));
        const double y = -height + tilt * x, w = depth + height * 0.3;
        corner[i].position[0] = (float)(1.5 * x);
        corner[i].position[1] = (float)(1.5 * y);
        corner[i].position[2] =
            (float)((w - near) * far / (far + near) * (s->view.minus_one_to_one ? 1.5 : 1));
        corner[i].position[3] = (float)w;
    }
    grid_triangles(s, columns, rows, corner);
}

static void make_view(struct scene *s, struct random *r)
{
    const bool odd = s->index % 2;
    struct oracle_view *const v = &s->view;
    *v = (struct oracle_view){.target_width = odd ? ODD_WIDTH : SMALL,
                              .target_height = odd ? ODD_HEIGHT : SMALL,
                              .depth_max = 1,
                              .minus_one_to_one = random_chance(r, 0.5)};
    v->width = odd ? ODD_WIDTH : SMALL;
    v->height = odd ? ODD_HEIGHT : SMALL;
    if (s->family == FAMILY_LARGE) {
        v->width = v->height = LARGE;
        v->x = (float)-random_below(r, LARGE - ODD_WIDTH);
        v->y = (float)-random_below(r, LARGE - ODD_WIDTH);
    } else if (s->index % 8 == 7) { // a viewport inside the target
        v->x = (float)random_below(r, 40);
        v->y = (float)random_below(r, 40);
        v->width -= v->x + (float)random_below(r, 40);
        v->height -= v->y + (float)random_below(r, 40);
    }
    if (random_chance(r, 0.25)) {
        v->depth_min = (float)random_between(r, 0, 1);
        v->depth_max = (float)random_between(r, 0, 1);
    }
}

typedef void make_function(struct scene *s, struct random *r);

void scene_make(struct scene *s, enum family family, uint64_t seed, uint64_t index)
{
    static make_function *const make[FAMILY_COUNT] = {
        make_ordinary, make_slivers,    make_micro,  make_large,      make_perspective,
        make_near_far, make_guard_band, make_behind, make_everything, make_cut_slivers,
        make_horizon,  make_fan,        make_strip,  make_grid,       make_cut_grid,
    };
    struct random r = random_start(seed, (uint64_t)family, index);
    s->family = family;
    s->seed = seed;
    s->index = index;
    s->topology = RHW_TRIANGLE_LIST;
    s->mesh = family >= FAMILY_FAN;
    s->vertex_count = s->triangle_count = 0;
    make_view(s, &r);
    make[family](s, &r);
    if (s->triangle_count == 0) {
        list_triangles(s);
    }
    make_values(s, &r);
}

bool scene_on_grid(const struct scene *s, int triangle)
{
    const double half_width = (double)s->view.width / 2, half_height = (double)s->view.height / 2;
    const double centre_x = (double)s->view.x + half_width, centre_y = (double)s->view.y + half_height;
    for (int i = 0; i < 3; i++) {
        const float *const p = s->vertex[s->triangle[triangle][i]].position;
        int32_t xy[2];
        // X·half = (x − centre)·W: both sides are products of at most 24 by 25 bits, exact in double.
        if (!oracle_snap(&s->view, p, xy) ||
            (double)p[0] * half_width != (xy[0] / 256.0 - centre_x) * (double)p[3] ||
            (double)p[1] * half_height != (centre_y - xy[1] / 256.0) * (double)p[3]) {
            return false;
        }
    }
    return true;
}
