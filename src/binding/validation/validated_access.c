// SPDX-License-Identifier: MIT
// Sampling and storage under validation. Levels of detail are worked out anew, apart from the kernels, which give them
// up to rounding: a level counts as read where it makes more than 1/256 of the result.
#include "resource/sampler.h"
#include "resource/texture.h"
#include "validation.h"

static const float rounding = 1.0f / 256;

// Return the level of detail, biased and not yet limited.
static rhw_float level_of_detail(const struct rhw_texture_data *texture, const struct rhw_sampler_def *def,
                                 const struct rhw_sample_request *request)
{
    const rhw_float *const gradient = request->gradient;
    const rhw_float bias = (request->bias ? *request->bias : rhw_splat(0)) + def->lod_bias;
    if (!gradient) {
        return (request->lod ? *request->lod : rhw_splat(0)) + bias;
    }
    const float width = (float)texture->mip[0].width, height = (float)texture->mip[0].height;
    const rhw_float ux = gradient[0] * width, vx = gradient[1] * height;
    const rhw_float uy = gradient[2] * width, vy = gradient[3] * height;
    return rhw_log2(rhw_max(ux * ux + vx * vx, uy * uy + vy * vy)) * 0.5f + bias;
}

// Set the two levels that each lane reads, which may be one.
static void levels_of(const struct rhw_texture_data *texture, const struct rhw_sampler_def *def,
                      rhw_float lod, rhw_float *fine, rhw_float *coarse)
{
    const float last = def->mip_filter == RHW_MIP_FILTER_NONE ? 0 : (float)(texture->levels - 1);
    const rhw_float limited = rhw_clamp(lod, rhw_splat(def->lod_min), rhw_splat(def->lod_max));
    const rhw_float within = rhw_clamp(limited, rhw_splat(0), rhw_splat(last));
    const bool blended = def->mip_filter == RHW_MIP_FILTER_LINEAR;
    *coarse = rhw_ceil(within - (blended ? rounding : 0.5f + rounding));
    *fine = blended ? rhw_floor(within + rounding) : *coarse;
}

// Return a level that is read and was never written. Return 0 where there is none, or where the texture is not a plain
// 2D one, whose gradients say other things. Lanes whose level of detail is NaN do not count: what their gradients come
// from is at fault.
static int unwritten_level(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                           const rhw_int *mask)
{
    const struct rhw_texture_data *const texture = binding->texture;
    if (texture->written == (1u << texture->levels) - 1 || !texture->is_plain) {
        return 0;
    }
    const rhw_float lod = level_of_detail(texture, &binding->sampler->def, request);
    rhw_float fine, coarse;
    levels_of(texture, &binding->sampler->def, lod, &fine, &coarse);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const bool counts = lod[lane] == lod[lane] && (!mask || (*mask)[lane] != 0);
        if (counts && fine[lane] > 0 && !(texture->written & 1u << (int)fine[lane])) {
            return (int)fine[lane];
        }
        if (counts && coarse[lane] > 0 && !(texture->written & 1u << (int)coarse[lane])) {
            return (int)coarse[lane];
        }
    }
    return 0;
}

static void tell_missing(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_sample_site *const site = &bindings->site;
    static const struct rhw_binding_data none;
    const struct rhw_binding_data *const binding =
        slot < bindings->slot_count ? &bindings->slot[slot] : &none;
    const char *const what = binding->kind == RHW_BINDING_MULTISAMPLED
                                 ? "whose texture is multisampled; rhw_sample_fetch_sample reads it"
                             : binding->texture ? "whose texture is not multisampled"
                                                : "in which no texture is set";
    rhw_validation_messages_add(site->validation, RHW_VALIDATION_MISUSE, site->draw,
                                "a shader function of %s samples slot %d, %s", site->pipeline, slot, what);
}

void rhw_validate_samples(const struct rhw_bindings *bindings, int slot)
{
    if ((unsigned)slot >= RHW_MAX_TEXTURES) {
        (void)rhw_validate_slot(bindings, slot);
    } else if (slot >= bindings->slot_count || bindings->slot[slot].kind != RHW_BINDING_MULTISAMPLED) {
        tell_missing(bindings, slot);
    }
}

bool rhw_validate_slot(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_sample_site *const site = &bindings->site;
    if ((unsigned)slot >= RHW_MAX_TEXTURES) {
        rhw_validation_messages_add(site->validation, RHW_VALIDATION_MISUSE, site->draw,
                                    "a shader function of %s samples slot %d; slots are 0..%d",
                                    site->pipeline, slot, RHW_MAX_TEXTURES - 1);
        return false;
    }
    if (slot >= bindings->slot_count || !bindings->slot[slot].texture) {
        tell_missing(bindings, slot);
        return false;
    }
    return true;
}

void rhw_validate_reference(const struct rhw_bindings *bindings, int slot,
                            const struct rhw_sample_request *request)
{
    const struct rhw_sample_site *const site = &bindings->site;
    const bool compares = bindings->slot[slot].sampler->def.compares;
    if (compares && !request->reference) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s samples slot %d without a reference, and the sampler there compares; "
            "rhw_sample_compare_lod and its like take one",
            site->pipeline, slot);
    } else if (!compares && request->reference) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s gives a reference for slot %d, and the sampler there does not compare; "
            "its definition must have compares set",
            site->pipeline, slot);
    }
}

void rhw_validate_sample(const struct rhw_bindings *bindings, int slot,
                         const struct rhw_sample_request *request)
{
    const struct rhw_sample_site *const site = &bindings->site;
    if (!rhw_validate_slot(bindings, slot)) {
        return;
    }
    rhw_validate_reference(bindings, slot, request);
    const int level = unwritten_level(&bindings->slot[slot], request, site->mask);
    if (level != 0) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s samples level %d of the texture in slot %d, which was never "
            "written; rhw_texture_generate_mips fills all levels from level 0",
            site->pipeline, level, slot);
    }
}

bool rhw_validate_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                                int stride)
{
    const struct rhw_sample_site *const site = &groups->bindings->site;
    const int highest = slots ? 31 - __builtin_clz(slots) : 0;
    if (stride <= highest) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s calls rhw_sample_groups with stride %d; it must be above the highest "
            "slot, which is %d",
            site->pipeline, stride, highest);
        return false;
    }
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const group = &groups[g];
        const rhw_float gradient[4] = {group->ddx[at], group->ddx[at + 1], group->ddy[at],
                                       group->ddy[at + 1]};
        const struct rhw_sample_request request = {.coordinates = &group->varying[at], .gradient = gradient};
        for (uint32_t left = slots; left != 0; left &= left - 1) {
            rhw_validate_sample(group->bindings, __builtin_ctz(left), &request);
        }
    }
    return true;
}

static void validate_effect(const struct rhw_bindings *bindings, int slot, int count, bool is_set,
                            bool is_read_only, const char *noun, enum rhw_storage_operation operation)
{
    const struct rhw_sample_site *const site = &bindings->site;
    if ((unsigned)slot >= (unsigned)count) {
        rhw_validation_messages_add(site->validation, RHW_VALIDATION_MISUSE, site->draw,
                                    "a shader function of %s uses %s slot %d; slots are 0..%d",
                                    site->pipeline, noun, slot, count - 1);
    } else if (!is_set) {
        rhw_validation_messages_add(site->validation, RHW_VALIDATION_MISUSE, site->draw,
                                    "a shader function of %s uses %s slot %d, in which nothing is set",
                                    site->pipeline, noun, slot);
    } else if (is_read_only && operation != RHW_STORAGE_LOAD) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s writes to %s slot %d, which is set for reading alone", site->pipeline,
            noun, slot);
    } else if (bindings->drops_effects && operation != RHW_STORAGE_LOAD) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s writes to %s slot %d; its program declares no such "
            "effects, by RHW_USE_EFFECTS or vertex_effects",
            site->pipeline, noun, slot);
    }
}

void rhw_validate_storage(const struct rhw_bindings *bindings, int slot, enum rhw_storage_operation operation)
{
    const int count = RHW_MAX_STORAGE_BUFFERS;
    const struct rhw_storage_words *const words =
        (unsigned)slot < (unsigned)count ? &bindings->storage->buffers[slot] : &rhw_no_storage.buffers[0];
    validate_effect(bindings, slot, count, words->words, words->is_read_only, "storage", operation);
}

void rhw_validate_image(const struct rhw_bindings *bindings, int slot, enum rhw_storage_operation operation)
{
    const int count = RHW_MAX_STORAGE_IMAGES;
    const struct rhw_storage_image *const image =
        (unsigned)slot < (unsigned)count ? &bindings->storage->images[slot] : &rhw_no_storage.images[0];
    validate_effect(bindings, slot, count, image->info, image->is_read_only, "image", operation);
}
