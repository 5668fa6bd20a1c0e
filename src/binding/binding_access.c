// SPDX-License-Identifier: MIT
// What shader functions do with bindings in memory (shader_binding.h), 8 lanes at a time.
#include "sample_access.h"

#include "resource/sampler.h"
#include "resource/texture.h"

static const struct rhw_binding_data *sampled(const struct rhw_binding *binding)
{
    return rhw_binding_of_kind(binding, RHW_BINDING_SAMPLED);
}

// Return a binding whose texture has one sample, with a sampler or without. Return NULL for others.
static const struct rhw_binding_data *textured(const struct rhw_binding *binding)
{
    const struct rhw_binding_data *const data = sampled(binding);
    return data ? data : rhw_binding_of_kind(binding, RHW_BINDING_TEXTURE);
}

void rhw_binding_sample(const struct rhw_binding *binding, const struct rhw_sample_request *request,
                        rhw_float texel[4])
{
    const struct rhw_binding_data *const data = sampled(binding);
    if (data) {
        rhw_sample_bound(data, request, texel);
    } else {
        rhw_no_texel(texel);
    }
}

void rhw_binding_sample_compare_window(const struct rhw_binding *binding,
                                       const struct rhw_sample_request *request, int columns, int rows,
                                       rhw_float *parts)
{
    rhw_bound_compare_window(sampled(binding), request, columns, rows, parts);
}

void rhw_binding_sample_gather(const struct rhw_binding *binding, const struct rhw_sample_request *request,
                               int channel, rhw_float texel[4])
{
    rhw_bound_gather(sampled(binding), request, channel, texel);
}

void rhw_binding_sample_fetch(const struct rhw_binding *binding, const rhw_int *at, const rhw_int *level,
                              rhw_float texel[4])
{
    rhw_bound_fetch(textured(binding), at, level, texel);
}

void rhw_binding_sample_fetch_sample(const struct rhw_binding *binding, const rhw_int *at,
                                     const rhw_int *sample, rhw_float texel[4])
{
    rhw_bound_fetch_sample(rhw_binding_textured(binding), at, sample, texel);
}

void rhw_binding_sample_query_lod(const struct rhw_binding *binding, const struct rhw_sample_request *request,
                                  rhw_float lod[2])
{
    rhw_bound_query_lod(sampled(binding), request, lod);
}

void rhw_binding_sample_size(const struct rhw_binding *binding, const rhw_int *level, rhw_int size[3])
{
    rhw_bound_size(rhw_binding_textured(binding), level, size);
}

int rhw_binding_sample_levels(const struct rhw_binding *binding)
{
    const struct rhw_texture_data *const texture = rhw_bound_texture(rhw_binding_textured(binding));
    return texture ? texture->levels : 0;
}

int rhw_binding_sample_samples(const struct rhw_binding *binding)
{
    const struct rhw_texture_data *const texture = rhw_bound_texture(rhw_binding_textured(binding));
    return texture ? texture->samples : 0;
}

struct rhw_texel_plane rhw_binding_sample_plane(const struct rhw_binding *binding)
{
    const struct rhw_binding_data *const data = textured(binding);
    const struct rhw_texture_data *const texture = data ? data->texture : NULL;
    const bool is_plane = texture && texture->is_plain && !texture->swizzles &&
                          texture->info->channels == 1 && texture->info->size == sizeof(float) &&
                          texture->info->codec == RHW_CODEC_FLOAT32;
    if (!is_plane) {
        return (struct rhw_texel_plane){.texels = NULL};
    }
    const struct rhw_mip *const mip = &texture->mip[0];
    return (struct rhw_texel_plane){(const float *)(const void *)mip->texels, mip->width, mip->height,
                                    (int32_t)(mip->row_pitch / sizeof(float))};
}

bool rhw_binding_sample_is_2d(const struct rhw_binding *binding)
{
    const struct rhw_binding_data *const data = sampled(binding);
    return data && data->texture && data->texture->shape.kind == RHW_TEXTURE_2D &&
           !data->texture->shape.is_array;
}

bool rhw_binding_sample_needs_gradient(const struct rhw_binding *texture, const struct rhw_binding *sampler)
{
    const struct rhw_binding_data *const of = textured(texture), *const by = rhw_binding_look(sampler);
    const bool has_sampler = by && (by->kind == RHW_BINDING_SAMPLED || by->kind == RHW_BINDING_SAMPLER);
    if (!of || !of->texture || !has_sampler || !by->sampler) {
        return false;
    }
    const struct rhw_sampler_def *const def = &by->sampler->def;
    const bool has_levels = of->texture->levels > 1 && def->mip_filter != RHW_MIP_FILTER_NONE;
    return has_levels || def->min_filter != def->mag_filter || def->max_anisotropy > 1;
}

void rhw_binding_sample_groups(const struct rhw_binding *table, const struct rhw_fragment *groups, int count,
                               uint32_t which, int at, rhw_float (*texels)[4], int stride)
{
    uint32_t present = 0;
    for (uint32_t left = which; left != 0; left &= left - 1) {
        const int n = __builtin_ctz(left);
        present |= sampled(&table[n]) ? left & -left : 0;
    }
    rhw_no_texels(count, which & ~present, texels, stride);
    if (present != 0) {
        const struct rhw_binding_data *const bindings = rhw_binding_look(table);
        bindings[__builtin_ctz(present)].kernels->sample_groups(bindings, groups, count, present, at, texels,
                                                                stride);
    }
}

// Storage ------------------------------------------------------------------------------------------------

// Return the words of a binding. Return none to an operation that changes them where the binding is for reading.
static struct rhw_storage_words words_of(const struct rhw_binding *binding,
                                         enum rhw_storage_operation operation)
{
    const struct rhw_binding_data *const data = rhw_binding_of_kind(binding, RHW_BINDING_WORDS);
    const bool is_there = data && (operation == RHW_STORAGE_LOAD || !data->words.is_read_only);
    return is_there ? data->words : (struct rhw_storage_words){.words = NULL};
}

void rhw_binding_storage_access(const struct rhw_binding *binding, const struct rhw_storage_request *request,
                                rhw_int *before)
{
    rhw_words_access(words_of(binding, request->operation), request, before);
}

int32_t rhw_binding_storage_access1(const struct rhw_binding *binding, enum rhw_storage_operation operation,
                                    uint32_t index, int32_t value, int32_t comparand)
{
    return rhw_words_access1(words_of(binding, operation), operation, index, value, comparand);
}

uint32_t rhw_binding_storage_count(const struct rhw_binding *binding)
{
    return words_of(binding, RHW_STORAGE_LOAD).count;
}

const uint32_t *rhw_binding_storage_words(const struct rhw_binding *binding, uint32_t *count)
{
    const struct rhw_storage_words range = words_of(binding, RHW_STORAGE_LOAD);
    *count = range.words ? range.count : 0;
    return range.words;
}

// Images -------------------------------------------------------------------------------------------------

// Return a binding of an image. Return one of nothing to an operation that changes it where it is for reading.
static const struct rhw_binding_data *image_of(const struct rhw_binding *binding,
                                               enum rhw_storage_operation operation)
{
    static const struct rhw_binding_data none;
    const struct rhw_binding_data *const data = rhw_binding_of_kind(binding, RHW_BINDING_IMAGE);
    return data && (operation == RHW_STORAGE_LOAD || !data->image.is_read_only) ? data : &none;
}

void rhw_binding_image_load(const struct rhw_binding *binding, const rhw_int *at, rhw_float texel[4])
{
    const struct rhw_binding_data *const data = image_of(binding, RHW_STORAGE_LOAD);
    rhw_bound_image_load(data->kernels, &data->image, at, texel);
}

void rhw_binding_image_store(const struct rhw_binding *binding, const rhw_int *at, const rhw_int *mask,
                             const rhw_float texel[4])
{
    const struct rhw_binding_data *const data = image_of(binding, RHW_STORAGE_STORE);
    rhw_bound_image_store(data->kernels, &data->image, at, mask, texel);
}

void rhw_binding_image_atomic(const struct rhw_binding *binding, const struct rhw_storage_request *request,
                              rhw_int *before)
{
    rhw_bound_image_atomic(&image_of(binding, request->operation)->image, request, before);
}

void rhw_binding_image_size(const struct rhw_binding *binding, rhw_int size[3])
{
    const struct rhw_binding_data *const data = image_of(binding, RHW_STORAGE_LOAD);
    rhw_bound_image_size(data->kernels, &data->image, size);
}

void rhw_binding_image_load1(const struct rhw_binding *binding, const int32_t *at, float texel[4])
{
    const struct rhw_binding_data *const data = image_of(binding, RHW_STORAGE_LOAD);
    rhw_bound_image_load1(data->kernels, &data->image, at, texel);
}

void rhw_binding_image_store1(const struct rhw_binding *binding, const int32_t *at, const float texel[4])
{
    const struct rhw_binding_data *const data = image_of(binding, RHW_STORAGE_STORE);
    rhw_bound_image_store1(data->kernels, &data->image, at, texel);
}

int32_t rhw_binding_image_atomic1(const struct rhw_binding *binding, enum rhw_storage_operation operation,
                                  const int32_t *at, int32_t value, int32_t comparand)
{
    return rhw_bound_image_atomic1(&image_of(binding, operation)->image, operation, at, value, comparand);
}

void rhw_binding_image_size1(const struct rhw_binding *binding, int32_t size[3])
{
    const struct rhw_binding_data *const data = image_of(binding, RHW_STORAGE_LOAD);
    rhw_bound_image_size1(data->kernels, &data->image, size);
}
