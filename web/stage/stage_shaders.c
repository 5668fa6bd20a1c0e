// SPDX-License-Identifier: MIT
// See stage_shaders.h.
#include "stage_shaders.h"

#include "stage.h"

void RHW_ISA_NAME(stage_place)(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 4; k++) {
            groups[i].position[k] = groups[i].attribute[0][k];
        }
        for (int k = 0; k < 2; k++) {
            groups[i].varying[STAGE_U + k] = groups[i].attribute[1][k];
        }
        for (int k = 0; k < 3; k++) {
            groups[i].varying[STAGE_RED + k] = groups[i].attribute[2][k];
        }
    }
}

// What a fragment is painted with; and by world, what that was made with.
struct values {
    rhw_float uv[2], color[3];
    rhw_float point[3], weights[3];
};

static struct values interpolated(const struct rhw_fragment *fragment)
{
    const rhw_float *const v = fragment->varying;
    return (struct values){.uv = {v[STAGE_U], v[STAGE_V]},
                           .color = {v[STAGE_RED], v[STAGE_RED + 1], v[STAGE_RED + 2]}};
}

// (B − A) × (C − A), for points that are lanes.
static void normal_of(const rhw_float a[3], const rhw_float b[3], const rhw_float c[3], rhw_float normal[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    }
}

// Back through the inverse matrix to the point P of the world; a, b, c are the areas of PBC, PCA, PAB over that of ABC.
static struct values by_world(const struct rhw_fragment *fragment, const struct stage_uniforms *uniforms)
{
    rhw_float p[4], corner[3][3], whole[3];
    for (int row = 0; row < 4; row++) {
        const float *const m = uniforms->world_from_screen[row];
        p[row] = m[0] * fragment->coord[0] + m[1] * fragment->coord[1] + m[2] * fragment->coord[2] + m[3];
    }
    for (int k = 0; k < 3; k++) {
        p[k] = p[k] / p[3];
        for (int i = 0; i < 3; i++) {
            corner[i][k] = rhw_splat(uniforms->corner[i][k]);
        }
    }
    normal_of(corner[0], corner[1], corner[2], whole);
    struct values values = {.point = {p[0], p[1], p[2]}};
    for (int i = 0; i < 3; i++) {
        rhw_float part[3];
        normal_of(p, corner[(i + 1) % 3], corner[(i + 2) % 3], part);
        const rhw_float weight = (part[0] * whole[0] + part[1] * whole[1] + part[2] * whole[2]) /
                                 (whole[0] * whole[0] + whole[1] * whole[1] + whole[2] * whole[2]);
        values.weights[i] = weight;
        for (int k = 0; k < 2; k++) {
            values.uv[k] = values.uv[k] + weight * uniforms->corner_uv[i][k];
        }
        for (int k = 0; k < 3; k++) {
            values.color[k] = values.color[k] + weight * uniforms->corner_color[i][k];
        }
    }
    return values;
}

// The patterns are computed, not looked up: each is averaged over the square that the pixel covers in u, v, so lines stay
// sharp and do not flicker, however steep the floor. Sizes are in fields, 1/8 of u and v.

static const float line_width = 0.09f, diagonal_width = 0.045f; // of a diagonal: in u, v

struct footprint {
    rhw_float place[2], width[2]; // in fields
    rhw_float along[2];           // how far u − v and u + v go in the pixel
};

static struct footprint footprint_of(const struct rhw_fragment *fragment, const struct values *values)
{
    const rhw_float *const ddx = &fragment->ddx[STAGE_U], *const ddy = &fragment->ddy[STAGE_U];
    struct footprint f;
    for (int k = 0; k < 2; k++) {
        f.place[k] = 8.0f * values->uv[k];
        f.width[k] = rhw_max(8.0f * (rhw_abs(ddx[k]) + rhw_abs(ddy[k])), rhw_splat(1e-4f));
    }
    f.along[0] = rhw_max(rhw_abs(ddx[0] - ddx[1]) + rhw_abs(ddy[0] - ddy[1]), rhw_splat(1e-5f));
    f.along[1] = rhw_max(rhw_abs(ddx[0] + ddx[1]) + rhw_abs(ddy[0] + ddy[1]), rhw_splat(1e-5f));
    return f;
}

// The integral of a wave that is 1 in −1..0 and −1 in 0..1, with period 2, up to a constant.
static rhw_float square_integral(rhw_float x)
{
    return 2.0f * rhw_abs(rhw_fract(x * 0.5f) - 0.5f);
}

// 0..1: how much of the footprint lies in the odd fields, as on a chessboard.
static rhw_float odd_fields(const struct footprint *f)
{
    rhw_float wave[2];
    for (int k = 0; k < 2; k++) {
        const rhw_float half = 0.5f * f->width[k];
        wave[k] = (square_integral(f->place[k] - half) - square_integral(f->place[k] + half)) / f->width[k];
    }
    return 0.5f - 0.5f * wave[0] * wave[1];
}

// The integral of what is 1 on the lines, which begin at whole numbers.
static rhw_float line_integral(rhw_float x)
{
    const rhw_float whole = rhw_floor(x);
    return whole * line_width + rhw_min(x - whole, rhw_splat(line_width));
}

// 0..1: how much of the footprint lies on a line between fields.
static rhw_float on_lines(const struct footprint *f)
{
    rhw_float beside = rhw_splat(1);
    for (int k = 0; k < 2; k++) {
        const rhw_float middle = f->place[k] + 0.5f * line_width, half = 0.5f * f->width[k];
        beside *= 1.0f - (line_integral(middle + half) - line_integral(middle - half)) / f->width[k];
    }
    return 1.0f - beside;
}

static rhw_float on_diagonal(rhw_float distance, rhw_float width)
{
    const rhw_float covered = (0.5f * diagonal_width - rhw_abs(distance)) / width + 0.5f;
    return rhw_min(rhw_max(covered, rhw_splat(0)), rhw_splat(1));
}

static void paint_checker(const struct rhw_fragment *fragment, const struct values *values,
                          rhw_float color[4])
{
    const struct footprint f = footprint_of(fragment, values);
    const rhw_float light = 1.0f - 0.55f * odd_fields(&f);
    for (int k = 0; k < 3; k++) {
        color[k] = light * values->color[k];
    }
}

static void paint_floor(const struct rhw_fragment *fragment, const struct values *values, rhw_float color[4])
{
    static const float paper[3] = {0.98f, 0.97f, 0.94f}, shade[3] = {0.83f, 0.84f, 0.84f},
                       line[3] = {0.27f, 0.31f, 0.35f}, blue[3] = {0.16f, 0.43f, 0.78f},
                       red[3] = {0.84f, 0.24f, 0.18f};
    const struct footprint f = footprint_of(fragment, values);
    const rhw_float odd = odd_fields(&f), lines = on_lines(&f);
    const rhw_float along = on_diagonal(values->uv[0] - values->uv[1], f.along[0]);
    const rhw_float across = on_diagonal(values->uv[0] + values->uv[1] - 1.0f, f.along[1]);
    for (int k = 0; k < 3; k++) {
        rhw_float c = paper[k] + odd * (shade[k] - paper[k]);
        c += lines * (line[k] - c);
        c += across * (red[k] - c);
        color[k] = c + along * (blue[k] - c);
    }
}

static void tell(const struct values *values, enum stage_told told, rhw_float color[4])
{
    const rhw_float of_values[3] = {values->uv[0], values->uv[1], values->color[1]};
    const rhw_float *const numbers = told == STAGE_TOLD_POINT     ? values->point
                                     : told == STAGE_TOLD_WEIGHTS ? values->weights
                                                                  : of_values;
    for (int k = 0; k < 3; k++) {
        color[k] = numbers[k];
    }
}

static void paint_one(struct rhw_fragment *fragment)
{
    const struct stage_uniforms *const uniforms = fragment->uniforms;
    const struct values values = uniforms->by_world ? by_world(fragment, uniforms) : interpolated(fragment);
    rhw_float *const color = fragment->color[0];
    color[3] = rhw_splat(1);
    if (uniforms->told != STAGE_TOLD_COLOR) {
        tell(&values, (enum stage_told)uniforms->told, color);
        return;
    }
    switch ((enum stage_pattern)uniforms->pattern) {
    case STAGE_CHECKER: paint_checker(fragment, &values, color); break;
    case STAGE_FLOOR: paint_floor(fragment, &values, color); break;
    case STAGE_DEPTH: color[0] = color[1] = color[2] = fragment->coord[2]; break;
    case STAGE_INVERSE_W:
        color[0] = color[1] = color[2] = fragment->coord[3] / uniforms->largest_inverse_w;
        break;
    case STAGE_UV:
        color[0] = values.uv[0];
        color[1] = values.uv[1];
        color[2] = rhw_splat(0);
        break;
    case STAGE_UV_OVER_W:
        color[0] = values.uv[0] * (fragment->coord[3] / uniforms->largest_inverse_w);
        color[1] = values.uv[1] * (fragment->coord[3] / uniforms->largest_inverse_w);
        color[2] = rhw_splat(0);
        break;
    default:
        for (int k = 0; k < 3; k++) {
            color[k] = values.color[k];
        }
    }
}

void RHW_ISA_NAME(stage_paint)(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        paint_one(&groups[i]);
    }
}
