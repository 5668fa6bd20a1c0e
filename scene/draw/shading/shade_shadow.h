// SPDX-License-Identifier: MIT
// How much of a light arrives at a fragment: percentage-closer soft shadows (R. Fernando, SIGGRAPH 2005). The mean
// distance of what stands before the fragment says how wide the penumbra is there. Over that width the map is compared,
// four texels at a time, weighted as a linear filter does.
//
// Every texel is compared with the depth that the fragment's own plane has at its centre: depth, and in a perspective
// map 1/distance, is linear there, with a gradient that follows from exact derivatives on the screen. A plane therefore
// never shades itself, however slanted it is and however wide the filter. Where the plane leads away from the light,
// only what is nearer than the fragment can shade it, and it must be the higher above the fragment the farther it is
// beside it. Planes that meet in a fold therefore do not shade each other.
//
// That allowance would leave a bright line along an inner corner whose one side keeps the light from the other: what
// casts the shadow touches what it falls on. But the plane of what casts shadows itself is in the map where the light
// reaches it. Where none of the four texels around a fragment lies in its plane and some lie before it, the fragment
// is hidden. A texel that is only near the plane may be of what meets it there, and counts where a square of texels is
// near. The allowance is not made where a fragment is hidden, taps beyond the end of the plane do not count, and no
// light arrives where the penumbra of what hides the fragment is narrower than a texel. Folds stay lit: the other side
// of a fold begins beyond a line that passes the fragment, and no such side holds all four corners of a square without
// what is inside of the square.
//
// Facets that stand for a curved surface and are turned away from the light lie in the shadow of the facets before
// them, while the normals of their corners still face the light. The result is dark triangles along the limit of light.
// What the facets stand for is looked up in their place: the point that the tangent planes of the corners suggest, and
// the plane across the normal there. It is a simplified form of J. Hanika, "Hacking the shadow terminator" (Ray Tracing
// Gems II, 2021), who projects onto the plane of each corner, holds each projection to the outer side, and takes their
// mean. A fragment has no corners, and 18 varyings more would bring them; one varying brings the mean distance of the
// planes. The mean is held to the outer side, once, and taken along the interpolated normal. Where all three planes lie
// above the fragment, as on a convex body, the two forms differ little.
#ifndef SCENE_SHADE_SHADOW_H
#define SCENE_SHADE_SHADOW_H

#include "rhw/shader.h"
#include "scene_shaders.h"

// Numbers of places on the disc. SCENE_SHADOW_MORE places are added where a first look finds a penumbra, and
// SCENE_SHADOW_FINE taps are added where the penumbra is wide.
enum { SCENE_SHADOW_SEARCHES = 12, SCENE_SHADOW_MORE = 24, SCENE_SHADOW_TAPS = 20, SCENE_SHADOW_FINE = 44 };

static const float scene_shadow_widest = 24.0f; // radius of the widest filter, texels
static const float scene_shadow_wide = 5.0f;    // radius above which a filter takes more taps, texels

// Depth per width, both in the world. The filter follows no plane that is steeper than scene_shadow_steepest, and the
// search for what casts a shadow follows none that is steeper than scene_shadow_gentle. What rises less than a fold
// above a plane does not shade it.
static const float scene_shadow_steepest = 32.0f, scene_shadow_gentle = 8.0f, scene_shadow_fold = 2.0f;
// Depth in widths of a texel, below which a filter takes what is before a plane for the plane itself: where the map has
// the plane at the fragment, and where it has not.
static const float scene_shadow_least = 0.7f, scene_shadow_least_hidden = 0.05f;
// Depth in widths of a texel: what is nearer than scene_shadow_near before a plane, or scene_shadow_near_behind behind
// it, may be the plane itself, as one facet of many is. What is within scene_shadow_exact of it is the plane itself,
// and what is scene_shadow_far_behind behind it is something else.
static const float scene_shadow_near = 0.25f, scene_shadow_near_behind = 2.0f, scene_shadow_exact = 0.004f,
                   scene_shadow_far_behind = 8.0f;
// Texels by which the thing that a facet stands for is brought nearer to the light.
static const float scene_shadow_lift = 6.0f;

/// A fragment as a light sees it.
struct scene_shadow_point {
    rhw_float column, row, depth;
    rhw_float own;       // `depth`, but no less than where the map is empty
    rhw_float slope[2];  // depth per column and per row on the fragment's plane
    rhw_float gentle[2]; // `slope` as the search for a penumbra takes it
    rhw_float step;      // depth that is as far as a texel is wide
    rhw_float per_texel; // width of a texel in the world
    rhw_float distance;  // distance from the light
    rhw_int inside;      // the map reaches the fragment
    rhw_int away;        // the light sees the plane's other side
    bool casts;          // the map has the fragment's surface, where the light reaches it
};

/// What a facet stands for, from interpolated values.
struct scene_shadow_curve {
    const rhw_float *normal;  // interpolated normal, not unit
    const rhw_float *support; // interpolated distance of `origin` from the tangent planes of the corners
    const float *origin;
    rhw_int turn; // −1 where the back is seen, 0 elsewhere
};

// Find place n of `count` on a disc of radius 1, and its distance from the middle: sunflower seeds (H. Vogel 1979),
// which are as even as any.
static inline void scene_shadow_seed(int n, int count, float seed[3])
{
    static const float turns[SCENE_SHADOW_TAPS][2] = {
        {1.000000f, 0.000000f},   {-0.737369f, 0.675490f}, {0.087426f, -0.996171f}, {0.608439f, 0.793601f},
        {-0.984713f, -0.174182f}, {0.843755f, -0.536728f}, {-0.259604f, 0.965715f}, {-0.460907f, -0.887448f},
        {0.939321f, 0.343039f},   {-0.924346f, 0.381556f}, {0.423846f, -0.905734f}, {0.299284f, 0.954164f},
        {-0.865211f, -0.501408f}, {0.976676f, -0.214719f}, {-0.575129f, 0.818062f}, {-0.128511f, -0.991708f},
        {0.764649f, 0.644447f},   {-0.999146f, 0.041318f}, {0.708829f, -0.705380f}, {-0.046191f, 0.998933f}};
    const float radius = __builtin_sqrtf(((float)n + 0.5f) / (float)count);
    seed[0] = turns[n][0] * radius;
    seed[1] = turns[n][1] * radius;
    seed[2] = radius;
}

// Find place n of `count` on a second disc, whose places lie between those of scene_shadow_seed.
static inline void scene_shadow_seed_between(int n, int count, float seed[3])
{
    static const float turns[SCENE_SHADOW_FINE][2] = {
        {0.362375f, 0.932032f},   {-0.896783f, -0.442471f}, {0.960145f, -0.279504f},
        {-0.519179f, 0.854666f},  {-0.194492f, -0.980904f}, {0.806004f, 0.591911f},
        {-0.994152f, 0.107991f},  {0.660110f, -0.751169f},  {0.020663f, 0.999786f},
        {-0.690583f, -0.723254f}, {0.997765f, 0.066823f},   {-0.780859f, 0.624707f},
        {0.153797f, -0.988102f},  {0.554048f, 0.832485f},   {-0.970873f, -0.239594f},
        {0.877735f, -0.479146f},  {-0.323556f, 0.946209f},  {-0.400575f, -0.916264f},
        {0.914299f, 0.405040f},   {-0.947776f, 0.318936f},  {0.483422f, -0.875387f},
        {0.234855f, 0.972030f},   {-0.829772f, -0.558103f}, {0.988841f, -0.148975f},
        {-0.628509f, 0.777802f},  {-0.061955f, -0.998079f}, {0.719876f, 0.694103f},
        {-0.999674f, -0.025540f}, {0.754381f, -0.656437f},  {-0.112840f, 0.993613f},
        {-0.587972f, -0.808882f}, {0.979944f, 0.199275f},   {-0.857188f, 0.515003f},
        {0.284184f, -0.958770f},  {0.438091f, 0.898931f},   {-0.930254f, -0.366917f},
        {0.933789f, -0.357824f},  {-0.446840f, 0.894614f},  {-0.274817f, -0.961497f},
        {0.852123f, 0.523342f},   {-0.981841f, 0.189705f},  {0.595835f, -0.803107f},
        {0.103140f, 0.994667f},   {-0.747940f, -0.663766f}};
    const float radius = __builtin_sqrtf(((float)n + 0.5f) / (float)count);
    seed[0] = turns[n][0] * radius;
    seed[1] = turns[n][1] * radius;
    seed[2] = radius;
}

static inline void scene_shadow_project(const struct scene_shadow_map *map, const rhw_float p[3], float one,
                                        rhw_float projected[4])
{
    for (int r = 0; r < 4; r++) {
        const float *row = map->rows[r];
        projected[r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] * one;
    }
}

/// Place a fragment in a map. `ddx` and `ddy` are the derivatives of `position` on the screen. If they are NULL, the
/// plane faces the light.
static inline struct scene_shadow_point scene_shadow_place(const struct scene_shadow_map *map,
                                                           const rhw_float position[3],
                                                           const rhw_float ddx[3], const rhw_float ddy[3])
{
    struct scene_shadow_point p;
    rhw_float c[4];
    scene_shadow_project(map, position, 1.0f, c);
    const rhw_int before = rhw_less(1e-20f, c[3]);
    const rhw_float inverse = 1.0f / rhw_select(before, c[3], 1.0f);
    p.column = c[0] * inverse;
    p.row = c[1] * inverse;
    p.depth = c[2] * inverse;
    // A map is empty beyond all that casts shadows, and nothing casts a shadow there
    p.own = rhw_max(p.depth, 0.0f);
    const float edge = (float)map->size;
    p.inside = before & rhw_less(0.0f, p.column) & rhw_less(p.column, edge) & rhw_less(0.0f, p.row) &
               rhw_less(p.row, edge);
    if (map->perspective) {
        p.distance = c[3];
        p.per_texel = c[3] * (1.0f / map->unit);
        p.step = p.depth * (1.0f / map->unit);
    } else {
        p.distance = (1.0f - p.depth) * map->range;
        p.per_texel = rhw_splat(1.0f / map->unit);
        p.step = rhw_splat(1.0f / (map->unit * map->range));
    }
    p.slope[0] = p.slope[1] = p.gentle[0] = p.gentle[1] = rhw_splat(0.0f);
    p.away = rhw_splat_int(0);
    if (ddx) {
        // (∂column, ∂row) · slope = ∂depth holds along both axes of the screen.
        rhw_float x[4], y[4];
        scene_shadow_project(map, ddx, 0.0f, x);
        scene_shadow_project(map, ddy, 0.0f, y);
        for (int r = 0; r < 3; r++) {
            const rhw_float own = r == 0 ? p.column : r == 1 ? p.row : p.depth;
            x[r] = x[r] - own * x[3];
            y[r] = y[r] - own * y[3];
        }
        const rhw_float area = x[0] * y[1] - x[1] * y[0];
        const rhw_int flat = rhw_less(rhw_abs(area), 1e-30f);
        const rhw_float scale = rhw_select(flat, 0.0f, 1.0f / rhw_select(flat, 1.0f, area));
        p.away = rhw_less(area, 0.0f); // columns and rows turn as the screen's do if both see the same side
        const rhw_float steepest = p.step * scene_shadow_steepest;
        const rhw_float gentle = p.step * scene_shadow_gentle;
        p.slope[0] = rhw_clamp((y[1] * x[2] - x[1] * y[2]) * scale, -steepest, steepest);
        p.slope[1] = rhw_clamp((x[0] * y[2] - y[0] * x[2]) * scale, -steepest, steepest);
        p.gentle[0] = rhw_clamp(p.slope[0], -gentle, gentle);
        p.gentle[1] = rhw_clamp(p.slope[1], -gentle, gentle);
    }
    return p;
}

static inline rhw_int scene_shadow_texel(const struct scene_shadow_map *map, rhw_float place)
{
    return rhw_int_from_float_unchecked(rhw_clamp(place, 0.0f, (float)(map->size - 1)));
}

// What the map has at a place of the disc within reach. `before` is set if it lies before the fragment's plane. `above`
// is set if it is nearer to the light than the fragment too, since nothing else can cast a shadow.
struct scene_shadow_find {
    rhw_float depth;
    rhw_int before, above;
};

static inline struct scene_shadow_find scene_shadow_search(const struct scene_shadow_map *map,
                                                           const struct scene_shadow_point *p,
                                                           const float seed[3], rhw_float reach)
{
    struct scene_shadow_find found;
    const rhw_float bias = p->step * (1.0f + 0.1f * reach);
    const rhw_int column = scene_shadow_texel(map, p->column + seed[0] * reach);
    const rhw_int row = scene_shadow_texel(map, p->row + seed[1] * reach);
    found.depth = rhw_gather(map->depth, map->pitch * map->size, row * map->pitch + column);
    const rhw_float plane = p->depth + p->gentle[0] * (rhw_float_from_int(column) + 0.5f - p->column) +
                            p->gentle[1] * (rhw_float_from_int(row) + 0.5f - p->row);
    const rhw_float least = found.depth - bias;
    found.before = rhw_less(rhw_max(plane, -bias), least);
    found.above = found.before & rhw_less(p->own, least);
    return found;
}

/// Return the radius of the penumbra in texels, from the mean distance of what casts it. Return −1 where nothing casts
/// a shadow, and −2 where everything within reach does. A few places find out whether there is a penumbra. Small things
/// fall between them, so whatever is before the plane, as a part of each fold is, is reason enough to look at more
/// places.
static inline rhw_float scene_shadow_penumbra(const struct scene_shadow_map *map,
                                              const struct scene_shadow_point *p, rhw_int who)
{
    const rhw_float reach = rhw_clamp(map->softness * p->distance / p->per_texel, 1.5f, scene_shadow_widest);
    rhw_int some = rhw_splat_int(0), all = rhw_splat_int(-1);
    float seed[3];
    for (int n = 0; n < SCENE_SHADOW_SEARCHES; n++) {
        scene_shadow_seed(n, SCENE_SHADOW_SEARCHES, seed);
        const struct scene_shadow_find found = scene_shadow_search(map, p, seed, reach);
        some |= found.before;
        all &= found.above;
    }
    rhw_float radius = rhw_splat(1.0f);
    if (rhw_any(some & ~all & who)) {
        rhw_float sum = rhw_splat(0.0f), count = rhw_splat(0.0f);
        for (int n = 0; n < SCENE_SHADOW_MORE; n++) {
            scene_shadow_seed_between(n, SCENE_SHADOW_MORE, seed);
            const struct scene_shadow_find found = scene_shadow_search(map, p, seed, reach);
            const rhw_float distance = map->perspective ? map->range / rhw_max(found.depth, 1e-20f)
                                                        : (1.0f - found.depth) * map->range;
            sum += rhw_select(found.above, distance, 0.0f);
            count += rhw_select(found.above, 1.0f, 0.0f);
        }
        const rhw_float height = p->distance - sum / rhw_max(count, 1.0f);
        radius = rhw_clamp(map->softness * height / p->per_texel, 1.0f, scene_shadow_widest);
        radius = rhw_select(rhw_less(0.0f, count), radius, 1.0f);
    }
    return rhw_select(some, rhw_select(all, -2.0f, radius), -1.0f);
}

// A filter around a fragment, and what its taps have summed up.
struct scene_shadow_disc {
    rhw_float radius; // texels
    rhw_float least;  // what rises less than this above the plane, in widths of a texel, shades nothing
    rhw_float fold;   // nor does what rises less than this, in depth per width
    rhw_int ends; // the plane may end within the disc: what lies farther than `drop` behind it does not count
    bool some_end; // some lane of `ends` is set
    rhw_float drop;
    rhw_float lit, count; // the part of the taps that the light reaches, and the part that counts
};

// Add a tap, which is a linear filter of four texels at a place of the disc.
static inline void scene_shadow_tap(const struct scene_shadow_map *map, const struct scene_shadow_point *p,
                                    const float seed[3], struct scene_shadow_disc *disc)
{
    const rhw_float radius = disc->radius, width = p->step * (seed[2] * radius);
    const rhw_float bias = p->step * disc->least + width * disc->fold;
    const rhw_float drop = disc->some_end ? disc->drop + width * (2.0f * scene_shadow_fold) + bias : bias;
    const rhw_float x = p->column + seed[0] * radius - 0.5f, y = p->row + seed[1] * radius - 0.5f;
    const rhw_float left = rhw_floor(x), top = rhw_floor(y);
    const rhw_float corner =
        p->depth + p->slope[0] * (left + 0.5f - p->column) + p->slope[1] * (top + 0.5f - p->row) + bias;
    const rhw_float own = p->own + bias;
    for (int i = 0; i < 4; i++) {
        const rhw_int column = scene_shadow_texel(map, left + (float)(i & 1));
        const rhw_int row = scene_shadow_texel(map, top + (float)(i >> 1));
        const rhw_float depth = rhw_gather(map->depth, map->pitch * map->size, row * map->pitch + column);
        const rhw_float share = (i & 1 ? x - left : 1.0f - (x - left)) * (i & 2 ? y - top : 1.0f - (y - top));
        const rhw_float along = i & 1 ? corner + p->slope[0] : corner;
        const rhw_float plane = i & 2 ? along + p->slope[1] : along;
        const rhw_int lit = rhw_less_equal(depth, rhw_max(plane, own));
        if (disc->some_end) {
            const rhw_float counts = rhw_select(rhw_less_equal(plane - drop, depth), share, 0.0f);
            disc->count += counts;
            disc->lit += rhw_select(lit, counts, 0.0f);
        } else {
            disc->lit += rhw_select(lit, share, 0.0f);
        }
    }
}

// Return what is lit of the taps so far, of which there are `taps`.
static inline rhw_float scene_shadow_mean(const struct scene_shadow_disc *disc, int taps)
{
    const rhw_float mean = disc->lit * (1.0f / (float)taps);
    return disc->some_end ? rhw_select(disc->ends, disc->lit / rhw_max(disc->count, 1e-6f), mean) : mean;
}

// What hides a fragment, as the four texels around it tell.
struct scene_shadow_cover {
    rhw_int hidden;   // the fragment's plane is not in the map, and something before it is
    rhw_float height; // height of that above the plane, in widths of a texel
};

// Return how much higher than the fragment's plane the map is at a texel.
static inline rhw_float scene_shadow_height(const struct scene_shadow_map *map,
                                            const struct scene_shadow_point *p, rhw_float x, rhw_float y)
{
    const rhw_int column = scene_shadow_texel(map, x), row = scene_shadow_texel(map, y);
    const rhw_float depth = rhw_gather(map->depth, map->pitch * map->size, row * map->pitch + column);
    return depth - (p->depth + p->slope[0] * (x + 0.5f - p->column) + p->slope[1] * (y + 0.5f - p->row));
}

// Return true where a height may be that of the plane itself.
static inline rhw_int scene_shadow_may_be_plane(const struct scene_shadow_point *p, rhw_float height)
{
    return ~rhw_less(p->step * scene_shadow_near, height) &
           rhw_less_equal(p->step * -scene_shadow_near_behind, height);
}

// Return true where what crosses the plane ends there, as the 16 texels around (`left`, `top`) tell: a row of them at
// most is near the plane, so that no four in a square are, and behind the end the map has what is far away.
static inline rhw_int scene_shadow_crosses(const struct scene_shadow_map *map,
                                           const struct scene_shadow_point *p, rhw_float left, rhw_float top)
{
    const rhw_float far = p->step * -scene_shadow_far_behind;
    rhw_int square = rhw_splat_int(0), ends = rhw_splat_int(0);
    rhw_int pairs[3] = {ends, ends, ends}; // neighbours in the row above that may both be the plane
    for (int row = -1; row <= 2; row++) {
        rhw_int last = rhw_splat_int(0);
        for (int column = -1; column <= 2; column++) {
            const rhw_float height = scene_shadow_height(map, p, left + (float)column, top + (float)row);
            const rhw_int plane = scene_shadow_may_be_plane(p, height);
            ends |= rhw_less(height, far);
            if (column >= 0) {
                square |= last & plane & pairs[column];
                pairs[column] = last & plane;
            }
            last = plane;
        }
    }
    return ends & ~square;
}

static inline struct scene_shadow_cover scene_shadow_cover_at(const struct scene_shadow_map *map,
                                                              const struct scene_shadow_point *p, rhw_int who)
{
    const rhw_float left = rhw_floor(p->column - 0.5f), top = rhw_floor(p->row - 0.5f);
    const rhw_float near = p->step * scene_shadow_near, close = p->step * scene_shadow_exact;
    rhw_int seen = rhw_splat_int(0), maybe = rhw_splat_int(0), some = rhw_splat_int(0);
    rhw_float highest = rhw_splat(0.0f);
    for (int i = 0; i < 4; i++) {
        const rhw_float height = scene_shadow_height(map, p, left + (float)(i & 1), top + (float)(i >> 1));
        some |= rhw_less(near, height);
        maybe |= scene_shadow_may_be_plane(p, height);
        seen |= rhw_less_equal(rhw_abs(height), close);
        highest = rhw_max(highest, height);
    }
    // Neither a plane that stands for a curve nor one that is too steep is where the map has its surface.
    const rhw_int exact =
        ~p->away & rhw_equal(p->slope[0], p->gentle[0]) & rhw_equal(p->slope[1], p->gentle[1]);
    const rhw_int unsure = exact & some & maybe & ~seen;
    if (rhw_any(unsure & who)) {
        maybe &= ~(unsure & scene_shadow_crosses(map, p, left, top));
    }
    const struct scene_shadow_cover cover = {exact & some & ~maybe & ~seen, highest / p->step};
    return cover;
}

/// Return the part of the light that arrives, by a filter whose radius, fold and drop are set.
static inline rhw_float scene_shadow_filter(const struct scene_shadow_map *map,
                                            const struct scene_shadow_point *p,
                                            struct scene_shadow_disc *disc, rhw_int who)
{
    disc->lit = disc->count = rhw_splat(0.0f);
    float seed[3];
    for (int n = 0; n < SCENE_SHADOW_TAPS; n++) {
        scene_shadow_seed(n, SCENE_SHADOW_TAPS, seed);
        scene_shadow_tap(map, p, seed, disc);
    }
    const rhw_float few = scene_shadow_mean(disc, SCENE_SHADOW_TAPS);
    const rhw_int wide = rhw_less(scene_shadow_wide, disc->radius);
    if (!rhw_any(wide & who)) {
        return few;
    }
    for (int n = 0; n < SCENE_SHADOW_FINE; n++) {
        scene_shadow_seed_between(n, SCENE_SHADOW_FINE, seed);
        scene_shadow_tap(map, p, seed, disc);
    }
    return rhw_select(wide, scene_shadow_mean(disc, SCENE_SHADOW_TAPS + SCENE_SHADOW_FINE), few);
}

/// Return the part of the light, 0..1, that arrives at the lanes of `who` that lie in the map. Return 1 elsewhere.
static inline rhw_float scene_shadow_look(const struct scene_shadow_map *map,
                                          const struct scene_shadow_point *p, rhw_int who)
{
    const rhw_int mine = who & p->inside;
    if (!rhw_any(mine)) {
        return rhw_splat(1.0f);
    }
    const rhw_float radius = scene_shadow_penumbra(map, p, mine);
    const rhw_int partly = rhw_less(0.0f, radius) & mine;
    rhw_float open = rhw_select(rhw_equal(radius, -2.0f), 0.0f, 1.0f);
    if (rhw_any(partly)) {
        struct scene_shadow_cover cover = {rhw_splat_int(0), rhw_splat(0.0f)};
        if (p->casts) {
            cover = scene_shadow_cover_at(map, p, partly);
        }
        const rhw_int touched = cover.hidden & rhw_less(cover.height * map->softness, 1.0f);
        struct scene_shadow_disc disc = {
            .radius = rhw_max(radius, 1.0f),
            .least = rhw_select(cover.hidden, scene_shadow_least_hidden, scene_shadow_least),
            .fold = rhw_select(cover.hidden, 0.0f, scene_shadow_fold),
            .ends = cover.hidden,
            .some_end = rhw_any(partly & cover.hidden & ~touched),
            .drop = rhw_select(cover.hidden, p->step * scene_shadow_near_behind, 1e30f)};
        const rhw_float filtered = scene_shadow_filter(map, p, &disc, partly & ~touched);
        open = rhw_select(partly, rhw_select(touched, 0.0f, filtered), open);
    }
    return rhw_select(mine, open, 1.0f);
}

// Place what the facet stands for, on the plane across the normal.
static inline struct scene_shadow_point scene_shadow_place_curved(const struct scene_shadow_map *map,
                                                                  const struct scene_shadow_curve *curve,
                                                                  const rhw_float position[3],
                                                                  const rhw_float ddx[3],
                                                                  const rhw_float ddy[3])
{
    const rhw_float *n = curve->normal;
    rhw_float rise = *curve->support; // height of the corners' tangent planes above the fragment
    for (int c = 0; c < 3; c++) {
        rise -= (position[c] - curve->origin[c]) * n[c];
    }
    rise = rhw_select(curve->turn, rhw_min(rise, 0.0f), rhw_max(rise, 0.0f));
    const rhw_float inverse = 1.0f / rhw_max(rhw_dot3(n, n), 1e-20f);
    const rhw_float x = rhw_dot3(ddx, n) * inverse, y = rhw_dot3(ddy, n) * inverse;
    rhw_float moved[3], across[2][3];
    for (int c = 0; c < 3; c++) {
        moved[c] = position[c] + n[c] * rise;
        across[0][c] = ddx[c] - n[c] * x;
        across[1][c] = ddy[c] - n[c] * y;
    }
    struct scene_shadow_point p = scene_shadow_place(map, moved, across[0], across[1]);
    p.depth += p.step * scene_shadow_lift;
    p.own = rhw_max(p.depth, 0.0f);
    return p;
}

static inline void scene_shadow_choose(struct scene_shadow_point *p, rhw_int mask,
                                       const struct scene_shadow_point *other)
{
    p->column = rhw_select(mask, other->column, p->column);
    p->row = rhw_select(mask, other->row, p->row);
    p->depth = rhw_select(mask, other->depth, p->depth);
    p->own = rhw_select(mask, other->own, p->own);
    p->slope[0] = rhw_select(mask, other->slope[0], p->slope[0]);
    p->slope[1] = rhw_select(mask, other->slope[1], p->slope[1]);
    p->gentle[0] = rhw_select(mask, other->gentle[0], p->gentle[0]);
    p->gentle[1] = rhw_select(mask, other->gentle[1], p->gentle[1]);
    p->step = rhw_select(mask, other->step, p->step);
    p->per_texel = rhw_select(mask, other->per_texel, p->per_texel);
    p->distance = rhw_select(mask, other->distance, p->distance);
    p->inside = (mask & other->inside) | (~mask & p->inside);
}

/// Return the part of a light that arrives at the lanes `mask`. Each lane takes the first of the maps around a point
/// light that has it well within. If `curve` is NULL, the facet stands for itself. `casts` tells
/// whether the surface casts shadows, and so is in the maps.
static inline rhw_float scene_shadow(const struct scene_shader_light *light, const rhw_float position[3],
                                     const rhw_float ddx[3], const rhw_float ddy[3],
                                     const struct scene_shadow_curve *curve, bool casts, rhw_int mask)
{
    rhw_float open = rhw_splat(1.0f);
    for (int m = 0; m < light->map_count && rhw_any(mask); m++) {
        const struct scene_shadow_map *map = &light->maps[m];
        struct scene_shadow_point p = scene_shadow_place(map, position, ddx, ddy);
        p.casts = casts;
        if (curve && rhw_any(p.away & mask)) {
            const struct scene_shadow_point curved =
                scene_shadow_place_curved(map, curve, position, ddx, ddy);
            scene_shadow_choose(&p, p.away, &curved);
        }
        const float low = light->map_count > 1 ? scene_shadow_widest + 1.0f : 0.0f,
                    high = (float)map->size - low;
        const rhw_int mine = mask & p.inside & rhw_less(low, p.column) & rhw_less(p.column, high) &
                             rhw_less(low, p.row) & rhw_less(p.row, high);
        if (rhw_any(mine)) {
            open = rhw_select(mine, scene_shadow_look(map, &p, mine), open);
            mask = mask & ~mine;
        }
    }
    return open;
}

#endif
