// SPDX-License-Identifier: MIT
// Views: texture data whose levels point into the texels of another texture. Nothing that samples or draws knows of
// them.
#include <string.h>

#include "bound_texels.h"
#include "format/block_format.h"
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/lookup.h"
#include "base/memory.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "shared_texels.h"
#include "texture.h"
#include "texture_shape.h"

static const char *const where = "rhw_texture_view_create";

enum { FACES = 6 };

// What a view will be.
struct plan {
    struct rhw_texture_data *parent;
    rhw_texture id; // id of the parent
    enum rhw_format format;
    struct rhw_texture_shape shape;
    bool is_stencil; // the view is the parent's stencil aspect
};

static struct rhw_name name_of(const struct rhw_context *context, const struct plan *plan)
{
    return rhw_name_of(&context->textures, plan->id.index);
}

// Formats -------------------------------------------------------------------------------------------

static bool has_depth_or_stencil(const struct rhw_format_info *info)
{
    return rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET);
}

static bool are_decoded_alike(const struct rhw_block_format *a, const struct rhw_block_format *b)
{
    return a && b && a->decode == b->decode && a->bytes == b->bytes && a->width == b->width &&
           a->height == b->height;
}

// Return true if a format is that of one of the aspects of the other.
static bool is_aspect_of(const struct rhw_format_info *aspect, const struct rhw_format_info *both)
{
    const bool has_both = rhw_format_has_role(both, RHW_ROLE_DEPTH_TARGET) &&
                          rhw_format_has_role(both, RHW_ROLE_STENCIL_TARGET);
    const bool is_depth = rhw_format_has_role(aspect, RHW_ROLE_DEPTH_TARGET) && aspect->codec == both->codec;
    const bool is_stencil = rhw_format_has_role(aspect, RHW_ROLE_STENCIL_TARGET);
    return has_both && is_depth != is_stencil;
}

// Return true if the view reads stencil: shaders read it as these bytes (VK_IMAGE_ASPECT_STENCIL_BIT).
static bool reads_stencil(const struct rhw_format_info *parent, enum rhw_format view)
{
    return view == RHW_FORMAT_R8_UINT && rhw_format_has_role(parent, RHW_ROLE_STENCIL_TARGET);
}

static bool formats_fit(enum rhw_format parent, enum rhw_format view)
{
    const struct rhw_block_format *const a = rhw_block_format(parent), *const b = rhw_block_format(view);
    if (parent == view) {
        return true;
    }
    if (a || b) {
        return are_decoded_alike(a, b);
    }
    const struct rhw_format_info *const from = rhw_format_info(parent), *const to = rhw_format_info(view);
    if (has_depth_or_stencil(from) || has_depth_or_stencil(to)) {
        return is_aspect_of(to, from) || reads_stencil(from, view);
    }
    return from->size == to->size;
}

static bool check_view_format(const struct rhw_context *context, struct plan *plan, enum rhw_format format)
{
    plan->format = format == RHW_FORMAT_NONE ? plan->parent->format : format;
    if (!rhw_check_format(context, where, "format", plan->format)) {
        return false;
    }
    const struct rhw_format_info *const info = rhw_format_info(plan->format);
    plan->is_stencil = reads_stencil(plan->parent->info, plan->format) ||
                       (rhw_format_has_role(info, RHW_ROLE_STENCIL_TARGET) &&
                        !rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET));
    return rhw_check(context, formats_fit(plan->parent->format, plan->format),
                     "%s: format is %s and %s is %s; colour has texels of one size, depth with stencil the "
                     "format of one of both, stencil R8_UINT",
                     where, info->name, name_of(context, plan).text,
                     rhw_format_info(plan->parent->format)->name);
}

// Levels, layers and kinds ----------------------------------------------------------------------------

static bool is_flat(enum rhw_texture_kind kind)
{
    return kind == RHW_TEXTURE_2D || kind == RHW_TEXTURE_CUBE;
}

static bool check_view_kind(const struct rhw_context *context, const struct plan *plan,
                            enum rhw_texture_kind kind)
{
    const struct rhw_texture_shape *const parent = &plan->parent->shape;
    const bool fits = kind == parent->kind || (is_flat(kind) && is_flat(parent->kind)) ||
                      (kind == RHW_TEXTURE_2D && parent->kind == RHW_TEXTURE_3D);
    return rhw_check(context, (unsigned)kind <= RHW_TEXTURE_CUBE, "%s: kind is %d; it must be 0..%d", where,
                     (int)kind, RHW_TEXTURE_CUBE) &&
           rhw_check(context, fits, "%s: kind is %d and %s has kind %d; that has no such views", where,
                     (int)kind, name_of(context, plan).text, (int)parent->kind) &&
           rhw_check(context, kind != RHW_TEXTURE_CUBE || parent->width == parent->height,
                     "%s: a cube of %s, which is %dx%d; its faces must be square", where,
                     name_of(context, plan).text, parent->width, parent->height) &&
           rhw_check(context, parent->samples == 1 || kind == RHW_TEXTURE_2D,
                     "%s: kind is %d and %s has %d samples; a multisampled texture is 2D", where, (int)kind,
                     name_of(context, plan).text, parent->samples);
}

static bool check_levels(const struct rhw_context *context, struct plan *plan,
                         const struct rhw_texture_view_def *def)
{
    const bool is_slice = plan->parent->shape.kind == RHW_TEXTURE_3D && def->kind != RHW_TEXTURE_3D;
    if (!rhw_texture_check_level(context, plan->id, plan->parent, def->level, where)) {
        return false;
    }
    const int most = is_slice ? 1 : plan->parent->levels - def->level;
    plan->shape.levels = def->levels == 0 ? most : def->levels;
    return rhw_check(context, plan->shape.levels >= 1 && plan->shape.levels <= most,
                     "%s: level is %d and levels is %d; from there %s has 1..%d", where, def->level,
                     def->levels, name_of(context, plan).text, most);
}

static bool check_layers(const struct rhw_context *context, struct plan *plan,
                         const struct rhw_texture_view_def *def)
{
    struct rhw_texture_shape *const shape = &plan->shape;
    const int slices = plan->parent->mip[def->level].slices;
    shape->is_array = def->layers > 0;
    if (def->kind == RHW_TEXTURE_3D) {
        shape->layers = 1;
        shape->depth = slices;
        return rhw_check(context, def->layer == 0 && def->layers == 0,
                         "%s: layer is %d and layers is %d; a 3D view has all slices: they must be 0", where,
                         def->layer, def->layers);
    }
    const int each = def->kind == RHW_TEXTURE_CUBE ? FACES : 1;
    shape->depth = 1;
    if (!rhw_check(context, def->layers >= 0 && def->layers <= RHW_MAX_TEXTURE_LAYERS / each,
                   "%s: layers is %d; it must be 0..%d", where, def->layers, RHW_MAX_TEXTURE_LAYERS / each)) {
        return false;
    }
    shape->layers = each * (def->layers > 1 ? def->layers : 1);
    return rhw_check(context, def->layer >= 0 && def->layer <= slices && shape->layers <= slices - def->layer,
                     "%s: layer is %d and the view has %d; level %d of %s has %d", where, def->layer,
                     shape->layers, def->level, name_of(context, plan).text, slices);
}

static bool check_swizzle(const struct rhw_context *context, const struct rhw_texture_view_def *def)
{
    for (int c = 0; c < 4; c++) {
        if (!rhw_check(context, (unsigned)def->swizzle[c] <= RHW_SWIZZLE_ALPHA,
                       "%s: swizzle[%d] is %d; not a swizzle", where, c, (int)def->swizzle[c])) {
            return false;
        }
    }
    return true;
}

static bool make_plan(const struct rhw_context *context, const struct rhw_texture_view_def *def,
                      struct plan *plan)
{
    plan->id = def->texture;
    plan->parent = rhw_context_texture(context, def->texture, where);
    if (!plan->parent || !check_view_format(context, plan, def->format) ||
        !check_view_kind(context, plan, def->kind) || !check_levels(context, plan, def) ||
        !check_layers(context, plan, def) || !check_swizzle(context, def)) {
        return false;
    }
    const struct rhw_mip *const mip = &plan->parent->mip[def->level];
    plan->shape.kind = def->kind;
    plan->shape.width = mip->width;
    plan->shape.height = mip->height;
    plan->shape.samples = plan->parent->samples;
    return true;
}

// Making --------------------------------------------------------------------------------------------

// Set a level from the aspect of the parent that the view has, from its first layer on.
static void set_level(const struct plan *plan, const struct rhw_texture_view_def *def, struct rhw_mip *mip)
{
    if (plan->is_stencil) {
        rhw_mip_take_stencil(mip);
    }
    mip->linear = NULL;
    mip->texels += (size_t)def->layer * mip->slice_pitch;
    if (def->kind != RHW_TEXTURE_3D) {
        mip->slices = plan->shape.layers;
    }
    if (plan->is_stencil && plan->format == RHW_FORMAT_S8_UINT) {
        mip->stencil = mip->texels;
    } else if (rhw_format_has_role(rhw_format_info(plan->format), RHW_ROLE_STENCIL_TARGET)) {
        mip->stencil += (size_t)def->layer * mip->stencil_pitch * (size_t)mip->height;
    } else {
        mip->stencil = NULL;
    }
}

// Set the levels and, from them, the tables of the sampler. Return false where a texel has a number beyond 31 bits.
static bool set_levels(const struct plan *plan, const struct rhw_texture_view_def *def,
                       struct rhw_texture_data *view)
{
    const size_t size = view->info->size;
    size_t last = 0;
    view->memory_size = RHW_TEXEL_PADDING;
    for (int i = 0; i < view->levels; i++) {
        struct rhw_mip *const mip = &view->mip[i];
        *mip = plan->parent->mip[def->level + i];
        set_level(plan, def, mip);
        const size_t first = (size_t)(mip->texels - view->mip[0].texels) / size;
        last = first + mip->slice_pitch * (size_t)mip->slices / size;
        view->table.first[i] = (int32_t)first;
        view->table.row[i] = (int32_t)(mip->row_pitch / size);
        view->table.slice[i] = (int32_t)(mip->slice_pitch / size);
        view->table.slices[i] = mip->slices;
        view->memory_size += mip->slice_pitch * (size_t)mip->slices;
    }
    return view->is_plain || last <= INT32_MAX;
}

static void set_view(const struct plan *plan, const struct rhw_texture_view_def *def,
                     struct rhw_texture_data *view)
{
    view->sample_stride = plan->parent->sample_stride;
    for (int c = 0; c < 4; c++) {
        view->swizzle[c] = def->swizzle[c];
        view->swizzles |= def->swizzle[c] != RHW_SWIZZLE_IDENTITY &&
                          def->swizzle[c] != (enum rhw_swizzle)(RHW_SWIZZLE_RED + c);
    }
    view->shared = plan->parent->shared;
    view->shared->owners++;
    view->version = view->shared->version;
    // All levels count as filled: which ones somebody has filled is not followed from one texture to the other.
    view->written = (1u << view->levels) - 1;
    plan->parent->written = (1u << plan->parent->levels) - 1;
}

// Return the view's data. Return NULL and set *result where something is wrong.
static struct rhw_texture_data *make_view(struct rhw_context *context, const struct plan *plan,
                                          const struct rhw_texture_view_def *def, enum rhw_result *result)
{
    struct rhw_texture_data *const view =
        rhw_memory_allocate(&context->memory, sizeof *view, _Alignof(struct rhw_texture_data));
    *result = RHW_ERROR_OUT_OF_MEMORY;
    if (!view) {
        return NULL;
    }
    rhw_texture_data_init(view, plan->format, &plan->shape);
    const bool fits = rhw_check(context, set_levels(plan, def, view),
                                "%s: the view has 2^31 texels or more between its first and its last", where);
    if (!fits || !rhw_texture_pin(context, plan->id, plan->parent)) {
        *result = fits ? RHW_ERROR_OUT_OF_MEMORY : RHW_ERROR_MISUSE;
        rhw_memory_release(&context->memory, view, sizeof *view);
        return NULL;
    }
    set_view(plan, def, view);
    *result = RHW_OK;
    return view;
}

static enum rhw_result create(struct rhw_context *context, const struct rhw_texture_view_def *def,
                              rhw_texture *view)
{
    struct plan plan = {.parent = NULL};
    if (!rhw_check(context, def != NULL, "%s: def is NULL", where) ||
        !rhw_check(context, view != NULL, "%s: view is NULL", where) || !make_plan(context, def, &plan)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_texture id = {.context = context->number};
    struct rhw_texture_data **const item =
        rhw_pool_add(&context->memory, &context->textures, def->label, &id.index, &id.generation);
    if (!item) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    enum rhw_result result;
    *item = make_view(context, &plan, def, &result);
    if (!*item) {
        rhw_pool_remove(&context->memory, &context->textures, id.index);
        return result;
    }
    *view = id;
    return RHW_OK;
}

enum rhw_result rhw_texture_view_create(rhw_context *context, const struct rhw_texture_view_def *def,
                                        rhw_texture *view)
{
    if (view) {
        *view = (rhw_texture){0};
    }
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def ? def->label : NULL;
    const enum rhw_result result = create(context, def, view);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}
