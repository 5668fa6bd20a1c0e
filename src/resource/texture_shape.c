// SPDX-License-Identifier: MIT
// The sampler numbers texels with 31 bits (kernels/texture/lane_level.h) for every kind but plain 2D textures; the rule
// that follows from it stands here.
#include "texture_shape.h"

#include "context/context.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "sample_pattern.h"

_Static_assert((int)RHW_ROW_ALIGNMENT == (int)RHW_MEMORY_ALIGNMENT &&
                   (int)RHW_TEXEL_PADDING == (int)RHW_MEMORY_PADDING,
               "what rhw_texture_def says");

enum { FACES = 6 };

int rhw_mip_chain_length(int width, int height, int depth)
{
    int levels = 1;
    // Count down to the highest bit of the largest side.
    for (int most = width | height | depth; most > 1; most >>= 1) {
        levels++;
    }
    return levels;
}

static bool check_size(const struct rhw_context *context, const char *field, int value, int most,
                       const char *where)
{
    return rhw_check(context, value >= 1 && value <= most, "%s: %s is %d; it must be 1..%d", where, field,
                     value, most);
}

static bool check_unused(const struct rhw_context *context, const char *field, int value, const char *of,
                         const char *where)
{
    return rhw_check(context, value == 0 || value == 1, "%s: %s is %d; %s has none: it must be 0 or 1", where,
                     field, value, of);
}

static bool check_layers(const struct rhw_context *context, const struct rhw_texture_def *def,
                         const char *where)
{
    if (def->kind == RHW_TEXTURE_3D) {
        return rhw_check(context, def->layers == 0,
                         "%s: layers is %d; a 3D texture is no array: it must be 0", where, def->layers);
    }
    const int most = RHW_MAX_TEXTURE_LAYERS / (def->kind == RHW_TEXTURE_CUBE ? FACES : 1);
    return rhw_check(context, def->layers >= 0 && def->layers <= most, "%s: layers is %d; it must be 0..%d",
                     where, def->layers, most);
}

static bool check_kind(const struct rhw_context *context, const struct rhw_texture_def *def,
                       const char *where)
{
    if (!rhw_check(context, (unsigned)def->kind <= RHW_TEXTURE_CUBE, "%s: kind is %d; it must be 0..%d",
                   where, (int)def->kind, RHW_TEXTURE_CUBE) ||
        !check_size(context, "width", def->width, RHW_MAX_TARGET_SIZE, where) ||
        !check_layers(context, def, where)) {
        return false;
    }
    const bool height = def->kind == RHW_TEXTURE_1D
                            ? check_unused(context, "height", def->height, "a 1D texture", where)
                            : check_size(context, "height", def->height, RHW_MAX_TARGET_SIZE, where);
    const bool depth = height && (def->kind == RHW_TEXTURE_3D
                                      ? check_size(context, "depth", def->depth, RHW_MAX_TEXTURE_DEPTH, where)
                                      : check_unused(context, "depth", def->depth, "this kind", where));
    return depth &&
           rhw_check(context, def->kind != RHW_TEXTURE_CUBE || def->width == def->height,
                     "%s: a cube of %dx%d; its faces must be square", where, def->width, def->height);
}

static bool check_samples(const struct rhw_context *context, const struct rhw_texture_def *def,
                          const char *where)
{
    const int targets = RHW_ROLE_COLOR_TARGET | RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET;
    const struct rhw_format_info *const info = rhw_format_info(def->format);
    return rhw_check(context, def->samples == 0 || rhw_sample_count_valid(def->samples),
                     "%s: samples is %d; it is 0, 1, 2, 4, 8 or 16", where, def->samples) &&
           rhw_check(context, def->samples <= 1 || rhw_format_has_role(info, targets),
                     "%s: samples is %d and format is %s; that is not drawn into", where, def->samples,
                     info->name) &&
           rhw_check(context, def->samples <= 1 || def->kind == RHW_TEXTURE_2D,
                     "%s: samples is %d and kind is %d; a multisampled texture is 2D", where, def->samples,
                     (int)def->kind) &&
           rhw_check(context, def->samples <= 1 || def->mip_levels == 0 || def->mip_levels == 1,
                     "%s: samples is %d and mip_levels is %d; a multisampled texture has one level", where,
                     def->samples, def->mip_levels);
}

static bool check_row_pitch(const struct rhw_context *context, const struct rhw_texture_def *def,
                            const char *where)
{
    const size_t size = rhw_format_size(rhw_format_decoded(def->format));
    const size_t least = (size_t)def->width * size, most = RHW_MAX_TARGET_SIZE * size;
    return rhw_check(context,
                     def->row_pitch == 0 || (def->row_pitch % RHW_ROW_ALIGNMENT == 0 &&
                                             def->row_pitch >= least && def->row_pitch <= most),
                     "%s: row_pitch is %zu; it is 0, or a multiple of %d in %zu..%zu", where, def->row_pitch,
                     RHW_ROW_ALIGNMENT, least, most) &&
           rhw_check(context, def->row_pitch == 0 || def->mip_levels == 0 || def->mip_levels == 1,
                     "%s: row_pitch is set and mip_levels is %d; with one level alone", where,
                     def->mip_levels);
}

static struct rhw_texture_shape without_levels(const struct rhw_texture_def *def)
{
    const int count = def->layers > 1 ? def->layers : 1;
    return (struct rhw_texture_shape){
        .kind = def->kind,
        .is_array = def->layers > 0,
        .width = def->width,
        .height = def->height > 1 ? def->height : 1,
        .depth = def->depth > 1 ? def->depth : 1,
        .layers = def->kind == RHW_TEXTURE_CUBE ? FACES * count : count,
        .samples = def->samples > 1 ? def->samples : 1,
        .row_pitch = def->row_pitch,
    };
}

// Return true if the sampler can number all texels. Rows are counted as they are stored, in all levels, too many rather
// than too few: the chain is below twice its first level.
static bool fits_numbers(const struct rhw_texture_def *def)
{
    const struct rhw_texture_shape shape = without_levels(def);
    const uint64_t size = rhw_format_size(rhw_format_decoded(def->format));
    const uint64_t rounded =
        ((uint64_t)shape.width * size + RHW_ROW_ALIGNMENT - 1) / RHW_ROW_ALIGNMENT * RHW_ROW_ALIGNMENT;
    const uint64_t row = (shape.row_pitch != 0 ? shape.row_pitch : rounded) / size;
    const uint64_t level = row * (uint64_t)shape.height * (uint64_t)shape.depth * (uint64_t)shape.layers;
    const bool is_plain = def->kind == RHW_TEXTURE_2D && !shape.is_array;
    return is_plain || (def->mip_levels == 0 || def->mip_levels == 1 ? level : 2 * level) <= INT32_MAX;
}

bool rhw_texture_shape_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                             const char *where)
{
    if (!check_kind(context, def, where) || !check_samples(context, def, where) ||
        !check_row_pitch(context, def, where)) {
        return false;
    }
    const struct rhw_texture_shape shape = without_levels(def);
    const int chain = rhw_mip_chain_length(shape.width, shape.height, shape.depth);
    return rhw_check(context, def->mip_levels >= RHW_MIP_LEVELS_ALL && def->mip_levels <= chain,
                     "%s: mip_levels is %d; a %dx%d texture has 1..%d (RHW_MIP_LEVELS_ALL is -1)", where,
                     def->mip_levels, shape.width, shape.height, chain) &&
           rhw_check(context, fits_numbers(def),
                     "%s: %dx%dx%d texels of %d layers; a texture has fewer than 2^31 texels", where,
                     shape.width, shape.height, shape.depth, shape.layers);
}

struct rhw_texture_shape rhw_texture_shape_of(const struct rhw_texture_def *def)
{
    struct rhw_texture_shape shape = without_levels(def);
    shape.levels = def->mip_levels == RHW_MIP_LEVELS_ALL
                       ? rhw_mip_chain_length(shape.width, shape.height, shape.depth)
                   : def->mip_levels == 0 ? 1
                                          : def->mip_levels;
    return shape;
}

bool rhw_texture_memory_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                              const char *where)
{
    if (!def->memory) {
        return rhw_check(context, def->memory_size == 0,
                         "%s: memory_size is %zu and memory is NULL; it must be 0 then", where,
                         def->memory_size) &&
               rhw_check(context, !def->memory_is_told,
                         "%s: memory_is_told is true and memory is NULL; it must be false then", where);
    }
    const struct rhw_texture_shape shape = rhw_texture_shape_of(def);
    struct rhw_texture_data texture;
    rhw_texture_data_init(&texture, def->format, &shape);
    return rhw_check(context, (uintptr_t)def->memory % RHW_MEMORY_ALIGNMENT == 0,
                     "%s: memory is %p; its address must be a multiple of %d", where, def->memory,
                     RHW_MEMORY_ALIGNMENT) &&
           rhw_check(context, def->memory_size >= texture.memory_size && texture.memory_size != SIZE_MAX,
                     "%s: memory_size is %zu; the texture takes %zu bytes (rhw_texture_query_layout)", where,
                     def->memory_size, texture.memory_size);
}

bool rhw_texture_check_layer(const struct rhw_context *context, rhw_texture id,
                             const struct rhw_texture_data *texture, int level, int layer, const char *where)
{
    const int slices = texture->mip[level].slices;
    return rhw_check(context, layer >= 0 && layer < slices, "%s: layer is %d; level %d of %s has 0..%d",
                     where, layer, level, rhw_name_of(&context->textures, id.index).text, slices - 1);
}

bool rhw_texture_check_level(const struct rhw_context *context, rhw_texture texture,
                             const struct rhw_texture_data *data, int level, const char *where)
{
    return rhw_check(context, level >= 0 && level < data->levels, "%s: level is %d; %s has levels 0..%d",
                     where, level, rhw_name_of(&context->textures, texture.index).text, data->levels - 1);
}
