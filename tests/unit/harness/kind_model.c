// SPDX-License-Identifier: MIT
// See kind_model.h.
#include "kind_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "format/format.h"

// Vulkan's table of faces: the axes of s, t and the normal, and their signs.
static const struct {
    int s_axis, s_sign, t_axis, t_sign, axis, sign;
} faces[6] = {
    {2, -1, 1, -1, 0, 1}, {2, 1, 1, -1, 0, -1}, {0, 1, 2, 1, 1, 1},
    {0, 1, 2, -1, 1, -1}, {0, 1, 1, -1, 2, 1},  {0, -1, 1, -1, 2, -1},
};

int kind_model_face(const double direction[3], double st[2])
{
    int axis = 2; // z wins over y, and y over x
    axis = fabs(direction[1]) > fabs(direction[axis]) ? 1 : axis;
    axis = fabs(direction[0]) > fabs(direction[axis]) ? 0 : axis;
    const int face = 2 * axis + (direction[axis] < 0);
    const double major = fabs(direction[axis]);
    st[0] = 0.5 * faces[face].s_sign * direction[faces[face].s_axis] / major + 0.5;
    st[1] = 0.5 * faces[face].t_sign * direction[faces[face].t_axis] / major + 0.5;
    return face;
}

static void face_point(int face, double s, double t, double depth, double point[3])
{
    point[faces[face].s_axis] = faces[face].s_sign * s;
    point[faces[face].t_axis] = faces[face].t_sign * t;
    point[faces[face].axis] = faces[face].sign * depth;
}

// The texel of any face whose centre is at the point of the cube ±1 that a texel across one edge folds to.
static void find_across(int face, int n, long x, long y, int found[3])
{
    const double s = (2.0 * (double)x + 1) / n - 1, t = (2.0 * (double)y + 1) / n - 1;
    double place[3];
    face_point(face, fmax(-1, fmin(1, s)), fmax(-1, fmin(1, t)), 1 - 1.0 / n, place);
    for (int i = 0; i < 6 * n * n; i++) {
        double center[3];
        const int other = i / (n * n), column = i % n, row = i / n % n;
        face_point(other, (2.0 * column + 1) / n - 1, (2.0 * row + 1) / n - 1, 1, center);
        if (fabs(center[0] - place[0]) + fabs(center[1] - place[1]) + fabs(center[2] - place[2]) < 1e-9) {
            found[0] = column;
            found[1] = row;
            found[2] = other;
            return;
        }
    }
    fail_msg("no texel across the edge of face %d at %ld, %ld of %d", face, x, y, n);
}

static void load(const struct rhw_texture_data *texture, int level, long x, long y, long slice,
                 double value[4])
{
    const struct rhw_mip *const mip = &texture->mip[level];
    model_decode(texture->format,
                 mip->texels + (size_t)slice * mip->slice_pitch + (size_t)y * mip->row_pitch +
                     (size_t)x * rhw_format_size(texture->format),
                 value);
}

static bool wrap(enum rhw_address address, long n, long *i)
{
    long period;
    switch (address) {
    case RHW_ADDRESS_REPEAT: *i = (*i % n + n) % n; break;
    case RHW_ADDRESS_MIRROR:
        period = (*i % (2 * n) + 2 * n) % (2 * n);
        *i = period < n ? period : 2 * n - 1 - period;
        break;
    case RHW_ADDRESS_CLAMP: *i = *i < 0 ? 0 : *i >= n ? n - 1 : *i; break;
    case RHW_ADDRESS_MIRROR_ONCE:
        *i = *i < 0 ? -1 - *i : *i;
        *i = *i >= n ? n - 1 : *i;
        break;
    case RHW_ADDRESS_BORDER: return *i >= 0 && *i < n;
    }
    return true;
}

// What the model needs at every level.
struct place {
    const struct rhw_texture_data *texture;
    const struct rhw_sampler_def *sampler;
    int axes, face;
    long layer;
    double at[3];
    const int *offset;
};

// False where a cube has no texel: at its corners.
static bool texel_at(const struct place *place, int level, const long at[3], double value[4])
{
    const struct rhw_mip *const mip = &place->texture->mip[level];
    const long size[3] = {mip->width, mip->height, mip->slices};
    if (place->texture->shape.kind == RHW_TEXTURE_CUBE) {
        const bool out_x = at[0] < 0 || at[0] >= size[0], out_y = at[1] < 0 || at[1] >= size[0];
        int found[3] = {(int)at[0], (int)at[1], place->face};
        if (out_x && out_y) {
            return false;
        }
        if (out_x || out_y) {
            find_across(place->face, mip->width, at[0], at[1], found);
        }
        load(place->texture, level, found[0], found[1], 6 * place->layer + found[2], value);
        return true;
    }
    const enum rhw_address address[3] = {place->sampler->address_u, place->sampler->address_v,
                                         place->sampler->address_w};
    long inside[3] = {0, 0, place->layer};
    for (int i = 0; i < place->axes; i++) {
        inside[i] = at[i];
        if (!wrap(address[i], size[i], &inside[i])) {
            for (int c = 0; c < 4; c++) {
                const float lacking = c < 3 ? 0.0f : 1.0f;
                value[c] = (double)(c < place->texture->info->channels ? place->sampler->border[c] : lacking);
            }
            return true;
        }
    }
    load(place->texture, level, inside[0], inside[1], inside[2], value);
    return true;
}

static void model_nearest(const struct place *place, int level, double value[4])
{
    const struct rhw_mip *const mip = &place->texture->mip[level];
    const int size[3] = {mip->width, mip->height, mip->slices};
    long at[3] = {0, 0, 0};
    for (int i = 0; i < place->axes; i++) {
        at[i] = (long)floor(place->at[i] * size[i]) + place->offset[i];
    }
    texel_at(place, level, at, value);
}

static void model_linear(const struct place *place, int level, double value[4])
{
    const struct rhw_mip *const mip = &place->texture->mip[level];
    const int size[3] = {mip->width, mip->height, mip->slices};
    double texel[8][4], weight[8], sum[4] = {0};
    int count = 0, corner = -1;
    for (int n = 0; n < 1 << place->axes; n++) {
        long at[3] = {0, 0, 0};
        weight[n] = 1;
        for (int i = 0; i < place->axes; i++) {
            const double x = place->at[i] * size[i] - 0.5, low = floor(x);
            at[i] = (long)low + place->offset[i] + (n >> i & 1);
            weight[n] *= n >> i & 1 ? x - low : 1 - (x - low);
        }
        if (texel_at(place, level, at, texel[n])) {
            for (int c = 0; c < 4; c++) {
                sum[c] += texel[n][c];
            }
            count++;
        } else {
            corner = n;
        }
    }
    for (int c = 0; c < 4; c++) {
        value[c] = corner >= 0 ? weight[corner] * sum[c] / 3 : 0;
        for (int n = 0; n < 1 << place->axes; n++) {
            value[c] += n == corner ? 0 : weight[n] * texel[n][c];
        }
    }
    assert_true(count == 1 << place->axes || (count == 3 && corner >= 0));
}

static void model_level(const struct place *place, int level, enum rhw_filter filter, double value[4])
{
    if (filter == RHW_FILTER_NEAREST) {
        model_nearest(place, level, value);
    } else {
        model_linear(place, level, value);
    }
}

static long nearest_layer(double layer, int count)
{
    const double rounded = nearbyint(layer); // ties to even
    return rounded < 0 ? 0 : rounded >= count ? count - 1 : (long)rounded;
}

void kind_model_sample(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler,
                       const struct kind_request *request, double value[4])
{
    const enum rhw_texture_kind kind = texture->shape.kind;
    const int components = kind == RHW_TEXTURE_1D ? 1 : kind == RHW_TEXTURE_2D ? 2 : 3;
    const int layers = texture->shape.layers / (kind == RHW_TEXTURE_CUBE ? 6 : 1);
    struct place place = {.texture = texture,
                          .sampler = sampler,
                          .axes = kind == RHW_TEXTURE_CUBE ? 2 : components,
                          .offset = request->offset};
    memcpy(place.at, request->coordinates, sizeof place.at);
    place.layer = texture->shape.is_array ? nearest_layer(request->coordinates[components], layers) : 0;
    if (kind == RHW_TEXTURE_CUBE) {
        place.face = kind_model_face(request->coordinates, place.at);
    }
    const double lambda = fmin(fmax(request->lod + (double)sampler->lod_bias, (double)sampler->lod_min),
                               sampler->lod_max == 0 ? 1000 : (double)sampler->lod_max);
    const int last = texture->levels - 1;
    const double within = fmin(fmax(lambda, 0), last);
    if (lambda <= 0) {
        model_level(&place, 0, sampler->mag_filter, value);
    } else if (sampler->mip_filter == RHW_MIP_FILTER_NONE) {
        model_level(&place, 0, sampler->min_filter, value);
    } else if (sampler->mip_filter == RHW_MIP_FILTER_NEAREST) {
        model_level(&place, (int)ceil(within + 0.5) - 1, sampler->min_filter, value);
    } else {
        const int level = (int)within;
        double coarse[4];
        model_level(&place, level, sampler->min_filter, value);
        model_level(&place, level < last ? level + 1 : last, sampler->min_filter, coarse);
        for (int c = 0; c < 4; c++) {
            value[c] += (within - level) * (coarse[c] - value[c]);
        }
    }
}

rhw_texture kind_model_texture(rhw_context *context, const struct rhw_texture_def *def, uint64_t *random)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(context, def, &texture), RHW_OK);
    const size_t size = rhw_format_size(def->format);
    for (int level = 0; level < rhw_texture_mip_levels(context, texture); level++) {
        const int count =
            rhw_texture_width(context, texture, level) * rhw_texture_height(context, texture, level);
        const int slices = rhw_texture_depth(context, texture, level) * rhw_texture_layers(context, texture);
        unsigned char *const texels = malloc((size_t)count * size);
        for (int slice = 0; slice < slices; slice++) {
            for (size_t i = 0; i < (size_t)count * size; i += def->format >= RHW_FORMAT_R32_FLOAT ? 4 : 1) {
                const float value = rig_random_float(random, -4, 4);
                if (def->format >= RHW_FORMAT_R32_FLOAT) {
                    memcpy(texels + i, &value, sizeof value);
                } else {
                    texels[i] = (unsigned char)rig_random(random);
                }
            }
            assert_int_equal(rhw_texture_write_layer(context, texture, level, slice, texels, 0), RHW_OK);
        }
        free(texels);
    }
    return texture;
}
