// SPDX-License-Identifier: MIT
// Samplers: a checked copy of the definition, and what follows from it.
#include "sampler.h"

#include <math.h>

#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"

static const char *const create_name = "rhw_sampler_create";

static bool check_enum(const struct rhw_context *context, const char *field, const char *type, unsigned value,
                       unsigned last)
{
    return rhw_check(context, value <= last, "%s: %s is %u; it must be 0..%u (enum %s)", create_name, field,
                     value, last, type);
}

static bool check_finite(const struct rhw_context *context, const char *field, float value)
{
    return rhw_check(context, isfinite(value), "%s: %s is %g; it must be finite", create_name, field,
                     (double)value);
}

static bool check_lod(const struct rhw_context *context, const struct rhw_sampler_def *def)
{
    return check_finite(context, "lod_bias", def->lod_bias) &&
           check_finite(context, "lod_min", def->lod_min) && check_finite(context, "lod_max", def->lod_max) &&
           rhw_check(context, def->lod_max == 0 || def->lod_min <= (def->lod_max > 0 ? def->lod_max : 0),
                     "%s: lod_min is %g and lod_max is %g; lod_min must not be above lod_max, a negative one "
                     "being 0",
                     create_name, (double)def->lod_min, (double)def->lod_max);
}

static bool is_clamped(enum rhw_address address)
{
    return address == RHW_ADDRESS_CLAMP || address == RHW_ADDRESS_BORDER;
}

static const char *filter_name(enum rhw_filter filter)
{
    return filter == RHW_FILTER_LINEAR ? "LINEAR" : "NEAREST";
}

static const char *address_name(enum rhw_address address)
{
    switch (address) {
    case RHW_ADDRESS_REPEAT: return "REPEAT";
    case RHW_ADDRESS_MIRROR: return "MIRROR";
    case RHW_ADDRESS_CLAMP: return "CLAMP";
    case RHW_ADDRESS_BORDER: return "BORDER";
    case RHW_ADDRESS_MIRROR_ONCE: return "MIRROR_ONCE";
    }
    return "unknown";
}

// Check the rules of VkSamplerCreateInfo for unnormalizedCoordinates.
static bool check_unnormalized(const struct rhw_context *context, const struct rhw_sampler_def *def)
{
    return !def->unnormalized ||
           (rhw_check(context, def->min_filter == def->mag_filter,
                      "%s: unnormalized with min_filter %s and mag_filter %s; they must be equal",
                      create_name, filter_name(def->min_filter), filter_name(def->mag_filter)) &&
            rhw_check(context, is_clamped(def->address_u) && is_clamped(def->address_v),
                      "%s: unnormalized with address_u %s and address_v %s; they must be CLAMP or BORDER",
                      create_name, address_name(def->address_u), address_name(def->address_v)) &&
            rhw_check(context, def->mip_filter == RHW_MIP_FILTER_NONE,
                      "%s: unnormalized with mip_filter %s; it must be NONE", create_name,
                      def->mip_filter == RHW_MIP_FILTER_LINEAR ? "LINEAR" : "NEAREST") &&
            rhw_check(context, !def->compares && def->max_anisotropy <= 1,
                      "%s: unnormalized with compares %d and max_anisotropy %g; they must be off",
                      create_name, def->compares, (double)def->max_anisotropy));
}

static bool check_filter_state(const struct rhw_context *context, const struct rhw_sampler_def *def)
{
    return check_enum(context, "address_w", "rhw_address", def->address_w, RHW_ADDRESS_MIRROR_ONCE) &&
           check_enum(context, "reduction", "rhw_reduction", def->reduction, RHW_REDUCTION_MAX) &&
           rhw_check(context, def->max_anisotropy >= 0 && def->max_anisotropy <= RHW_MOST_ANISOTROPY,
                     "%s: max_anisotropy is %g; it must be 0..%d", create_name, (double)def->max_anisotropy,
                     RHW_MOST_ANISOTROPY) &&
           rhw_check(context, def->reduction == RHW_REDUCTION_AVERAGE || !def->compares,
                     "%s: reduction is %u and compares is true; a sampler that compares averages",
                     create_name, (unsigned)def->reduction) &&
           check_unnormalized(context, def);
}

static bool check_create(const struct rhw_context *context, const struct rhw_sampler_def *def,
                         const rhw_sampler *sampler)
{
    return rhw_check(context, def != NULL, "%s: def is NULL", create_name) &&
           rhw_check(context, sampler != NULL, "%s: sampler is NULL", create_name) &&
           check_enum(context, "min_filter", "rhw_filter", def->min_filter, RHW_FILTER_NEAREST) &&
           check_enum(context, "mag_filter", "rhw_filter", def->mag_filter, RHW_FILTER_NEAREST) &&
           check_enum(context, "mip_filter", "rhw_mip_filter", def->mip_filter, RHW_MIP_FILTER_NONE) &&
           check_enum(context, "address_u", "rhw_address", def->address_u, RHW_ADDRESS_MIRROR_ONCE) &&
           check_enum(context, "address_v", "rhw_address", def->address_v, RHW_ADDRESS_MIRROR_ONCE) &&
           check_enum(context, "compare", "rhw_compare", def->compare, RHW_COMPARE_ALWAYS) &&
           rhw_check(context, def->compares || def->compare == 0,
                     "%s: compare is %u and compares is false; it must be true for a sampler that compares",
                     create_name, (unsigned)def->compare) &&
           check_finite(context, "border[0]", def->border[0]) &&
           check_finite(context, "border[1]", def->border[1]) &&
           check_finite(context, "border[2]", def->border[2]) &&
           check_finite(context, "border[3]", def->border[3]) && check_lod(context, def) &&
           check_filter_state(context, def);
}

static bool is_general(const struct rhw_sampler_def *def)
{
    return def->unnormalized || def->reduction != RHW_REDUCTION_AVERAGE ||
           def->address_u == RHW_ADDRESS_MIRROR_ONCE || def->address_v == RHW_ADDRESS_MIRROR_ONCE;
}

static bool filters_plainly(const struct rhw_sampler_def *def)
{
    return !is_general(def) && !def->compares && def->min_filter == RHW_FILTER_LINEAR &&
           def->mag_filter == RHW_FILTER_LINEAR && def->address_u != RHW_ADDRESS_BORDER &&
           def->address_v != RHW_ADDRESS_BORDER;
}

static bool filters_compared(const struct rhw_sampler_def *def)
{
    return !is_general(def) && def->compares && def->min_filter == RHW_FILTER_LINEAR &&
           def->mag_filter == RHW_FILTER_LINEAR && def->address_u != RHW_ADDRESS_BORDER &&
           def->address_v != RHW_ADDRESS_BORDER;
}

static float lod_max_of(const struct rhw_sampler_def *def)
{
    const float no_limit = 1000; // more levels than there are
    return def->lod_max > 0 ? def->lod_max : def->lod_max < 0 ? 0 : no_limit;
}

void rhw_sampler_data_init(struct rhw_sampler_data *sampler, const struct rhw_sampler_def *def)
{
    *sampler = (struct rhw_sampler_data){.def = *def,
                                         .filters_plainly = filters_plainly(def),
                                         .filters_fixed = filters_plainly(def) &&
                                                          def->mip_filter != RHW_MIP_FILTER_NEAREST,
                                         .filters_compared = filters_compared(def),
                                         .is_general = is_general(def)};
    sampler->def.lod_max = lod_max_of(def);
    sampler->def.label = NULL; // the label is the caller's memory
    for (int lane = 0; lane < RHW_LANES; lane++) {
        sampler->gradient_bias[lane] = def->lod_bias - 16.0f;
        sampler->lod_least[lane] = def->lod_min > 0 ? def->lod_min : 0;
        sampler->lod_most[lane] = lod_max_of(def);
    }
}

static enum rhw_result create(struct rhw_context *context, const struct rhw_sampler_def *def,
                              rhw_sampler *sampler)
{
    if (!check_create(context, def, sampler)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_sampler id = {.context = context->number};
    struct rhw_sampler_data *const data =
        rhw_pool_add(&context->memory, &context->samplers, def->label, &id.index, &id.generation);
    if (data == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    rhw_sampler_data_init(data, def);
    *sampler = id;
    return RHW_OK;
}

enum rhw_result rhw_sampler_create(rhw_context *context, const struct rhw_sampler_def *def,
                                   rhw_sampler *sampler)
{
    if (sampler != NULL) {
        *sampler = (rhw_sampler){0};
    }
    if (!rhw_context_enter(context, "rhw_sampler_create")) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def != NULL ? def->label : NULL;
    const enum rhw_result result = create(context, def, sampler);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}

void rhw_sampler_destroy(rhw_context *context, rhw_sampler sampler)
{
    static const char *const where = "rhw_sampler_destroy";
    if (sampler.index == 0 || !rhw_context_enter(context, where)) {
        return;
    }
    const bool live = rhw_context_sampler(context, sampler, where) != NULL;
    if (live && rhw_context_records(context, &context->samplers, sampler.index)) {
        rhw_pool_retire(&context->memory, &context->samplers, sampler.index);
    } else if (live) {
        rhw_pool_remove(&context->memory, &context->samplers, sampler.index);
    }
    rhw_context_leave(context);
}
