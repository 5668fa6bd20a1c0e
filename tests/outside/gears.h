// SPDX-License-Identifier: MIT
// The gears of gears.c: their numbers, which are those of glxgears, and their triangles, all in one mesh.
#ifndef GEARS_H
#define GEARS_H

#include <stdint.h>

enum { GEARS = 3, MAX_CORNERS = 1536, MAX_INDICES = 1536, RESTART = 0xffff };

struct gear {
    float inner, outer, width; // radii of the hole, and of half the height of a tooth
    int teeth;
    float tooth_depth;
    float color[3];
    float at[2];
    float speed, phase; // turned by speed · angle + phase, in degrees
};

static const struct gear gears[GEARS] = {
    {1, 4, 1, 20, 0.7f, {0.8f, 0.1f, 0}, {-3, -2}, 1, 0},
    {0.5f, 2, 2, 10, 0.7f, {0, 0.8f, 0.2f}, {3.1f, -2}, -2, -9},
    {1.3f, 2, 0.5f, 10, 0.7f, {0.2f, 0.2f, 1}, {-3.1f, 4.2f}, -2, -25},
};

struct corner {
    float position[3], normal[3];
};

struct span {
    uint32_t first, count; // indices
};

struct mesh {
    struct corner corners[MAX_CORNERS];
    uint16_t indices[MAX_INDICES];
    uint32_t corner_count, index_count;
    struct span flat[GEARS], smooth[GEARS];
};

// Cosine and sine of degrees by Taylor's series, within −45..45: no C library chooses their bits.
static void turn(double degrees, float result[2])
{
    const int quarters = (int)(degrees / 90 + 1024.5) - 1024; // to the nearest
    const double x = (degrees - 90 * quarters) * 0.017453292519943295;
    double cosine = 0, sine = 0, term = 1;
    for (int n = 1; n < 20; n += 2) {
        cosine += term;
        sine += term * x / n;
        term *= -x * x / (n * (n + 1));
    }
    const double cosines[4] = {cosine, -sine, -cosine, sine}; // a quarter further each
    result[0] = (float)cosines[quarters & 3];
    result[1] = (float)cosines[(quarters + 3) & 3]; // the sine is the cosine of a quarter less
}

static void add(struct mesh *mesh, const float at[2], float z, const float normal[3])
{
    mesh->corners[mesh->corner_count] = (struct corner){{at[0], at[1], z}, {normal[0], normal[1], normal[2]}};
    mesh->indices[mesh->index_count++] = (uint16_t)mesh->corner_count++;
}

static void end_strip(struct mesh *mesh)
{
    mesh->indices[mesh->index_count++] = RESTART;
}

// The outline of a tooth: root, tip, tip, root, and the next root; and the hole at these angles.
struct tooth {
    float outline[5][2], hole[5][2];
};

static struct tooth make_tooth(const struct gear *gear, int number)
{
    struct tooth tooth;
    for (int i = 0; i < 5; i++) {
        float turned[2];
        turn((4 * number + i) * 90.0 / gear->teeth, turned);
        const float radius = gear->outer + (i == 1 || i == 2 ? 0.5f : -0.5f) * gear->tooth_depth;
        for (int a = 0; a < 2; a++) {
            tooth.outline[i][a] = radius * turned[a];
            tooth.hole[i][a] = gear->inner * turned[a];
        }
    }
    return tooth;
}

// The front, side 1, or the back, side −1: the same, wound the other way round.
static void add_face(struct mesh *mesh, const struct gear *gear, float side)
{
    const float z = side * gear->width / 2, normal[3] = {0, 0, side};
    const int swap = side < 0;
    for (int number = 0; number < gear->teeth; number++) {
        const struct tooth tooth = make_tooth(gear, number);
        const float *const ring[6] = {tooth.hole[0],    tooth.outline[0], tooth.hole[0],
                                      tooth.outline[3], tooth.hole[4],    tooth.outline[4]};
        const float *const quad[4] = {tooth.outline[0], tooth.outline[1], tooth.outline[3], tooth.outline[2]};
        for (int i = 0; i < 6; i++) {
            add(mesh, ring[i ^ swap], z, normal);
        }
        end_strip(mesh);
        for (int i = 0; i < 4; i++) {
            add(mesh, quad[i ^ swap], z, normal);
        }
        end_strip(mesh);
    }
}

// All around the teeth. Flanks have their own normals, what lies between them that of the tooth's beginning.
static void add_rim(struct mesh *mesh, const struct gear *gear)
{
    const float z = gear->width / 2;
    for (int number = 0; number < gear->teeth; number++) {
        const struct tooth tooth = make_tooth(gear, number);
        for (int i = 0; i < 5; i++) {
            const float *const to = tooth.outline[i], *const from = tooth.outline[i ? i - 1 : 0];
            const float flank[3] = {to[1] - from[1], from[0] - to[0], 0};
            const float between[3] = {tooth.hole[0][0], tooth.hole[0][1], 0};
            add(mesh, to, z, i & 1 ? flank : between);
            add(mesh, to, -z, i & 1 ? flank : between);
        }
        end_strip(mesh);
    }
}

static void add_hole(struct mesh *mesh, const struct gear *gear)
{
    const float z = gear->width / 2;
    for (int number = 0; number <= gear->teeth; number++) {
        const struct tooth tooth = make_tooth(gear, number);
        const float normal[3] = {-tooth.hole[0][0], -tooth.hole[0][1], 0};
        add(mesh, tooth.hole[0], -z, normal);
        add(mesh, tooth.hole[0], z, normal);
    }
    end_strip(mesh);
}

static void make_mesh(struct mesh *mesh)
{
    *mesh = (struct mesh){.corner_count = 0};
    for (int g = 0; g < GEARS; g++) {
        const uint32_t first = mesh->index_count;
        add_face(mesh, &gears[g], 1);
        add_face(mesh, &gears[g], -1);
        add_rim(mesh, &gears[g]);
        const uint32_t middle = mesh->index_count;
        add_hole(mesh, &gears[g]);
        mesh->flat[g] = (struct span){first, middle - first};
        mesh->smooth[g] = (struct span){middle, mesh->index_count - middle};
    }
}

#endif
