// SPDX-License-Identifier: MIT
// Triangles are clipped by Sutherland–Hodgman against six planes, in double. A cut is computed from the vertex inside
// to the vertex outside, whichever order the triangle names them in. The two owners of a shared edge cut it by the same
// planes in the same order, so they get the same point, bit for bit, and no crack opens between them.
//
// Z is in the range 0..W here, whatever range the pipeline has: (Z + W)/2 of floats is exact in double unless their
// exponents are far apart. 0 <= Z <= W implies W >= 0. With the guard band, W = 0 is left only for the point
// (0, 0, 0, 0). Without the planes of depth it is left for any (0, 0, Z, 0), and a polygon with one of these points is
// not drawn.
#include "clip.h"

#include "base/constants.h"
#include "draw_list.h"
#include "snap.h"
#include "pipeline/pipeline.h"

enum { PLANES = 6, DEPTH_PLANES = 2 }; // the planes of depth stand first

// A position is in pixels from the target's origin, still times W: x = X·W, y = Y·W on the screen.
struct clip_vertex {
    double x, y, z, w;
};

static double distance(const struct clip_vertex *c, int plane)
{
    switch (plane) {
    case 0: return c->z;
    case 1: return c->w - c->z;
    case 2: return RHW_GUARD_BAND * c->w + c->x;
    case 3: return RHW_GUARD_BAND * c->w - c->x;
    case 4: return RHW_GUARD_BAND * c->w + c->y;
    default: return RHW_GUARD_BAND * c->w - c->y;
    }
}

static struct clip_vertex cut(const struct clip_vertex *inside, double d_inside,
                              const struct clip_vertex *outside, double d_outside)
{
    const double t = d_inside / (d_inside - d_outside);
    return (struct clip_vertex){
        inside->x + t * (outside->x - inside->x), inside->y + t * (outside->y - inside->y),
        inside->z + t * (outside->z - inside->z), inside->w + t * (outside->w - inside->w)};
}

static int clip_plane(const struct clip_vertex *in, int count, int plane, struct clip_vertex *out)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        const struct clip_vertex *const a = &in[i], *const b = &in[i + 1 == count ? 0 : i + 1];
        const double da = distance(a, plane), db = distance(b, plane);
        if (da >= 0) {
            out[n++] = *a;
        }
        if (da >= 0 && db < 0) {
            out[n++] = cut(a, da, b, db);
        } else if (da < 0 && db >= 0) {
            out[n++] = cut(b, db, a, da);
        }
    }
    return n;
}

// A vertex has all clip distances beside its position, because they are cut as the position is.
struct distance_vertex {
    struct clip_vertex at;
    double distance[RHW_MAX_CLIP_DISTANCES];
};

static struct distance_vertex cut_distances(const struct distance_vertex *inside,
                                            const struct distance_vertex *outside, int plane, int count)
{
    const double d = inside->distance[plane], t = d / (d - outside->distance[plane]);
    struct distance_vertex out = {cut(&inside->at, d, &outside->at, outside->distance[plane]), {0}};
    for (int i = 0; i < count; i++) {
        out.distance[i] = inside->distance[i] + t * (outside->distance[i] - inside->distance[i]);
    }
    out.distance[plane] = 0;
    return out;
}

static int clip_distance(const struct distance_vertex *in, int vertices, int plane, int count,
                         struct distance_vertex *out)
{
    int n = 0;
    for (int i = 0; i < vertices; i++) {
        const struct distance_vertex *const a = &in[i], *const b = &in[i + 1 == vertices ? 0 : i + 1];
        const bool a_inside = a->distance[plane] >= 0, b_inside = b->distance[plane] >= 0;
        if (a_inside) {
            out[n++] = *a;
        }
        if (a_inside != b_inside) {
            out[n++] = cut_distances(a_inside ? a : b, a_inside ? b : a, plane, count);
        }
    }
    return n;
}

// Cut off the parts of the triangle where a clip distance is below 0. Return how many vertices `corners` has
// afterwards.
static int clip_distances(const struct rhw_draw_state *state,
                          const struct rhw_vertex_record *const vertices[3], struct clip_vertex *corners)
{
    const int count = state->pipeline->def.program.clip_distance_count;
    struct distance_vertex a[RHW_POLYGON_VERTICES + 1], b[RHW_POLYGON_VERTICES + 1];
    struct distance_vertex *in = a, *out = b;
    for (int i = 0; i < 3; i++) {
        a[i].at = corners[i];
        for (int k = 0; k < count; k++) {
            a[i].distance[k] = (double)vertices[i]->varyings[state->pipeline->varying_components + k];
        }
    }
    int n = 3;
    for (int plane = 0; plane < count && n >= 3; plane++) {
        n = clip_distance(in, n, plane, count, out);
        struct distance_vertex *const swap = in;
        in = out;
        out = swap;
    }
    for (int i = 0; i < n; i++) {
        corners[i] = in[i].at;
    }
    return n;
}

// Return the vertex in pixels times W. The front end projects vertices by another formula, which divides by W first
// (geometry/vertex_shading.h). Here a position must stay linear while it is cut, and is divided afterwards. The two
// formulas may round apart by a step of 1/256 pixel. The difference has no effect: a vertex of the triangle that is
// left keeps the front end's position.
static struct clip_vertex clip_vertex_of(const struct rhw_draw_state *state,
                                         const struct rhw_vertex_record *v)
{
    const float *const p = v->position;
    const double z = (double)p[2], w = (double)p[3];
    const bool symmetric = state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    return (struct clip_vertex){(double)p[0] * state->half_width + w * state->center_x,
                                w * state->center_y - (double)p[1] * state->half_height,
                                symmetric ? (z + w) * 0.5 : z, w};
}

bool rhw_clip_triangle(const struct rhw_draw_state *state, const struct rhw_vertex_record *const vertices[3],
                       struct rhw_polygon *polygon)
{
    struct clip_vertex a[RHW_POLYGON_VERTICES + 1], b[RHW_POLYGON_VERTICES + 1];
    for (int i = 0; i < 3; i++) {
        a[i] = clip_vertex_of(state, vertices[i]);
    }
    struct clip_vertex *in = a, *out = b;
    int count =
        state->pipeline->def.program.clip_distance_count == 0 ? 3 : clip_distances(state, vertices, a);
    const int first = state->pipeline->def.depth_clip_disabled ? DEPTH_PLANES : 0;
    for (int plane = first; plane < PLANES && count >= 3; plane++) {
        count = clip_plane(in, count, plane, out);
        struct clip_vertex *const swap = in;
        in = out;
        out = swap;
    }
    if (count < 3) {
        return false;
    }
    polygon->count = count;
    for (int i = 0; i < count; i++) {
        if (!(in[i].w > 0)) {
            return false;
        }
        polygon->x_24_8[i] = snap(in[i].x / in[i].w);
        polygon->y_24_8[i] = snap(in[i].y / in[i].w);
    }
    // A vertex of the triangle that is left keeps the position it was snapped to, because other triangles share it.
    for (int k = 0; k < 3; k++) {
        const struct rhw_vertex_record *const v = vertices[k];
        const struct clip_vertex c = clip_vertex_of(state, v);
        for (int i = 0; i < count && !(v->flags & RHW_VERTEX_UNSNAPPED); i++) {
            if (in[i].w == c.w && in[i].x == c.x && in[i].y == c.y && in[i].z == c.z) {
                polygon->x_24_8[i] = v->x_24_8;
                polygon->y_24_8[i] = v->y_24_8;
            }
        }
    }
    return true;
}

// Narrow t[0] .. t[1] to the part of a line where a distance is at least 0. The distance is d0 and d1 at the line's
// vertices.
static void narrow(double t[2], double d0, double d1)
{
    if (d0 >= 0 && d1 >= 0) {
        return;
    }
    const double at = d0 / (d0 - d1);
    if (d0 >= 0 && d1 < 0) {
        t[1] = at < t[1] ? at : t[1];
    } else if (d0 < 0 && d1 >= 0) {
        t[0] = at > t[0] ? at : t[0];
    } else { // nothing is inside, or a distance is no number
        t[0] = 2;
    }
}

bool rhw_clip_line(const struct rhw_draw_state *state, const struct rhw_vertex_record *const vertices[2],
                   double t[2])
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const struct clip_vertex a = clip_vertex_of(state, vertices[0]), b = clip_vertex_of(state, vertices[1]);
    t[0] = 0;
    t[1] = 1;
    const int first = pipeline->def.depth_clip_disabled ? DEPTH_PLANES : 0;
    for (int plane = first; plane < PLANES; plane++) {
        narrow(t, distance(&a, plane), distance(&b, plane));
    }
    for (int i = 0; i < pipeline->def.program.clip_distance_count; i++) {
        const int component = pipeline->varying_components + i;
        narrow(t, (double)vertices[0]->varyings[component], (double)vertices[1]->varyings[component]);
    }
    return t[0] < t[1];
}

// Return twice the area of triangle (0, i, i + 1) of the fan.
static int64_t fan_area(const struct rhw_polygon *polygon, int i)
{
    const int64_t x0 = polygon->x_24_8[0], y0 = polygon->y_24_8[0];
    return (polygon->x_24_8[i] - x0) * (polygon->y_24_8[i + 1] - y0) -
           (polygon->y_24_8[i] - y0) * (polygon->x_24_8[i + 1] - x0);
}

int64_t rhw_polygon_area(const struct rhw_polygon *polygon)
{
    int64_t area = 0;
    for (int i = 1; i + 1 < polygon->count; i++) {
        area += fan_area(polygon, i);
    }
    return area;
}

bool rhw_polygon_is_flat(const struct rhw_polygon *polygon)
{
    for (int i = 1; i + 1 < polygon->count; i++) {
        if (fan_area(polygon, i) != 0) {
            return false;
        }
    }
    return true;
}
