// SPDX-License-Identifier: MIT
// The beginning of a pass: its attachments are checked, and everything is reset. pass.c records into it.
#include <string.h>

#include "context.h"
#include "cpu.h"
#include "entry.h"
#include "format.h"
#include "lookup.h"
#include "misuse.h"
#include "pass_state.h"
#include "rhw/rhw.h"
#include "thread.h"

static const char *const where = "rhw_pass_begin";

static bool check_operations(rhw_context *context, const char *name, int i, enum rhw_load load,
                             enum rhw_store store)
{
    return rhw_check(context, (unsigned)load <= RHW_LOAD_DISCARD,
                     "%s: %s[%d].load is %d; not a load operation", where, name, i, (int)load) &&
           rhw_check(context, (unsigned)store <= RHW_STORE_DISCARD,
                     "%s: %s[%d].store is %d; not a store operation", where, name, i, (int)store);
}

static struct rhw_name name_of(const rhw_context *context, rhw_texture id)
{
    return rhw_name_of(&context->textures, id.index);
}

// Checks the texture of an attachment against the pass and the attachments before it.
static bool check_texture(const struct rhw_pass_state *pass, rhw_texture id,
                          const struct rhw_texture_data *texture, const char *name, int i)
{
    rhw_context *const context = pass->context;
    const struct rhw_mip *const mip = &texture->mip[0];
    return rhw_check(context, texture->attached != context->recording.generation,
                     "%s: %s[%d] is %s, as another attachment is; each needs its own texture", where, name, i,
                     name_of(context, id).text) &&
           rhw_check(context, mip->width == pass->width && mip->height == pass->height,
                     "%s: %s[%d] is %s, which is %dx%d; the pass is %dx%d", where, name, i,
                     name_of(context, id).text, mip->width, mip->height, pass->width, pass->height);
}

// Fills what an attachment with a texture has.
static enum rhw_result attach(struct rhw_pass_state *pass, rhw_texture id, const char *name, int i,
                              struct rhw_attachment *attachment)
{
    struct rhw_context *const context = pass->context;
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture) {
        return RHW_ERROR_MISUSE;
    }
    if (pass->width == 0) {
        pass->width = texture->mip[0].width;
        pass->height = texture->mip[0].height;
    }
    if (!check_texture(pass, id, texture, name, i)) {
        return RHW_ERROR_MISUSE;
    }
    if (!texture->clean) {
        texture->clean =
            rhw_clean_tiles_create(&context->memory, texture->mip[0].width, texture->mip[0].height);
    }
    if (!texture->clean) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    texture->linear_is_current = false;
    texture->attached = context->recording.generation;
    rhw_pool_use(&context->textures, id.index, context->recording.generation);
    attachment->format = texture->format;
    attachment->target = &texture->mip[0];
    attachment->clean = texture->clean;
    attachment->texel_size = rhw_format_size(texture->format);
    return RHW_OK;
}

// What RHW_LOAD_DEFAULT stands for.
static enum rhw_load load_of(enum rhw_load load)
{
    return load == RHW_LOAD_DEFAULT ? RHW_LOAD_CLEAR : load;
}

static void set_clear(struct rhw_attachment *attachment, const unsigned char *texel)
{
    memset(attachment->clear, 0, sizeof attachment->clear);
    for (size_t i = 0; attachment->load == RHW_LOAD_CLEAR && i < sizeof attachment->clear;
         i += attachment->texel_size) {
        memcpy(attachment->clear + i, texel, attachment->texel_size);
    }
}

// Under validation.
static bool check_clear(const rhw_context *context, const float clear[4], int i)
{
    for (int c = 0; c < 4; c++) {
        if (!rhw_check(context, clear[c] == clear[c], "%s: colors[%d].clear[%d] is NaN", where, i, c)) {
            return false;
        }
    }
    return true;
}

static enum rhw_result attach_color(struct rhw_pass_state *pass, const struct rhw_pass_def *def, int i)
{
    struct rhw_context *const context = pass->context;
    const struct rhw_color_attachment *const color = &def->colors[i];
    struct rhw_attachment *const attachment = &pass->colors[i];
    if (!check_operations(context, "colors", i, color->load, color->store)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = attach(pass, color->texture, "colors", i, attachment);
    if (result != RHW_OK) {
        return result;
    }
    const struct rhw_format_info *const info = rhw_format_info(attachment->format);
    if (!rhw_check(context, rhw_format_has_role(info, RHW_ROLE_COLOR_TARGET),
                   "%s: colors[%d] is %s, which is %s; that is no colour target", where, i,
                   name_of(context, color->texture).text, info->name)) {
        return RHW_ERROR_MISUSE;
    }
    if (context->findings && !check_clear(context, color->clear, i)) {
        return RHW_ERROR_MISUSE;
    }
    attachment->load = load_of(color->load);
    attachment->store = color->store;
    const uint64_t environment = rhw_cpu_float_enter();
    unsigned char texel[RHW_TEXEL_BYTES];
    rhw_clear_texel(info, color->clear, texel);
    rhw_cpu_float_leave(environment);
    set_clear(attachment, texel);
    return RHW_OK;
}

static enum rhw_result attach_depth_texture(struct rhw_pass_state *pass, rhw_texture id)
{
    struct rhw_context *const context = pass->context;
    const enum rhw_result result = attach(pass, id, "depth", 0, &pass->depth);
    if (result != RHW_OK) {
        return result;
    }
    const struct rhw_format_info *const info = rhw_format_info(pass->depth.format);
    return rhw_check(context, rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET),
                     "%s: depth is %s, which is %s; the depth attachment is RHW_FORMAT_D32_FLOAT", where,
                     name_of(context, id).text, info->name)
               ? RHW_OK
               : RHW_ERROR_MISUSE;
}

static enum rhw_result attach_depth(struct rhw_pass_state *pass, const struct rhw_pass_def *def)
{
    struct rhw_context *const context = pass->context;
    const struct rhw_depth_attachment *const depth = &def->depth;
    pass->has_depth = depth->enabled;
    pass->depth = (struct rhw_attachment){.format = RHW_FORMAT_D32_FLOAT, .texel_size = sizeof(float)};
    pass->depth_by_default = false;
    if (!depth->enabled) {
        return RHW_OK;
    }
    if (!check_operations(context, "depth", 0, depth->load, depth->store)) {
        return RHW_ERROR_MISUSE;
    }
    if (depth->texture.index != 0) {
        const enum rhw_result result = attach_depth_texture(pass, depth->texture);
        if (result != RHW_OK) {
            return result;
        }
    } else if (!rhw_check(context,
                          load_of(depth->load) == RHW_LOAD_CLEAR && depth->store == RHW_STORE_DISCARD,
                          "%s: depth.texture is null; without one depth is cleared and not stored", where)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_check(context, depth->clear >= 0 && depth->clear <= 1, "%s: depth.clear is %g; it is in 0..1",
                   where, (double)depth->clear)) {
        return RHW_ERROR_MISUSE;
    }
    pass->depth.load = load_of(depth->load);
    pass->depth.store = depth->store;
    pass->depth_by_default = depth->load == RHW_LOAD_DEFAULT && depth->clear == 0;
    const float clear = pass->depth_by_default ? 1 : depth->clear;
    set_clear(&pass->depth, (const unsigned char *)&clear);
    return RHW_OK;
}

static enum rhw_result attach_all(struct rhw_pass_state *pass, const struct rhw_pass_def *def)
{
    for (int i = 0; i < def->color_count; i++) {
        const enum rhw_result result = attach_color(pass, def, i);
        if (result != RHW_OK) {
            return result;
        }
    }
    return attach_depth(pass, def);
}

static void reset(struct rhw_pass_state *pass, const struct rhw_pass_def *def)
{
    rhw_arena_reset(&pass->arena);
    pass->begun_ns = rhw_time_ns();
    pass->width = def->width;
    pass->height = def->height;
    pass->draws.count = 0;
    pass->triangle_count = 0;
    pass->triangles_most = 1;
    pass->has_large_draws = false;
    pass->current = NULL;
    pass->out_of_memory = false;
    pass->color_count = def->color_count;
    memset(&pass->pending, 0, sizeof pass->pending);
    memset(&pass->bound, 0, sizeof pass->bound);
    pass->pending_changed = true;
    pass->uniforms = NULL;
    pass->uniform_size = 0;
    pass->textures_changed = true;
}

static bool check_def(rhw_context *context, const struct rhw_pass_def *def, const rhw_pass *id)
{
    return rhw_check(context, def != NULL && id != NULL, "%s: def and pass must not be NULL", where) &&
           rhw_check(context, !context->recording.active, "%s: a pass is being recorded; end it first",
                     where) &&
           rhw_check(context, def->color_count >= 0 && def->color_count <= RHW_MAX_COLOR_ATTACHMENTS,
                     "%s: color_count is %d; it is in 0..%d", where, def->color_count,
                     RHW_MAX_COLOR_ATTACHMENTS) &&
           rhw_check(context, def->color_count > 0 || def->depth.enabled, "%s: the pass has no attachment",
                     where) &&
           rhw_check(context, def->color_count > 0 || def->colors[0].texture.index == 0,
                     "%s: colors[0].texture is set and color_count is 0; it must be 1 or more, or the "
                     "texture null",
                     where);
}

static void begin_recording(struct rhw_context *context, const struct rhw_pass_def *def)
{
    struct rhw_recording *const recording = &context->recording;
    atomic_store_explicit(&context->refused, false, memory_order_relaxed);
    recording->active = true;
    recording->misused = false;
    recording->draw = 0;
    recording->group = NULL;
    rhw_label_copy(recording->label, def->label);
}

static enum rhw_result begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *id)
{
    struct rhw_pass_state *const pass = context->pass;
    if (!check_def(context, def, id)) {
        return RHW_ERROR_MISUSE;
    }
    reset(pass, def);
    if (++context->recording.generation == 0) {
        context->recording.generation = 1; // 0 is that of nothing yet
    }
    const enum rhw_result result = attach_all(pass, def);
    if (result != RHW_OK) {
        return result;
    }
    if (!rhw_check(context,
                   pass->width >= 1 && pass->width <= RHW_MAX_TARGET_SIZE && pass->height >= 1 &&
                       pass->height <= RHW_MAX_TARGET_SIZE,
                   "%s: the size is %dx%d; each is in 1..%d", where, pass->width, pass->height,
                   RHW_MAX_TARGET_SIZE)) {
        return RHW_ERROR_MISUSE;
    }
    pass->tiles_x = (pass->width + RHW_TILE - 1) / RHW_TILE;
    pass->tiles_y = (pass->height + RHW_TILE - 1) / RHW_TILE;
    pass->pending.viewport = (struct rhw_viewport){0, 0, (float)pass->width, (float)pass->height, 0, 1};
    pass->pending.scissor = (struct rhw_rect){0, 0, pass->width, pass->height};
    begin_recording(context, def);
    *id = (rhw_pass){1, context->recording.generation, context->number};
    return RHW_OK;
}

enum rhw_result rhw_pass_begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *id)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (id != NULL &&
        !context->recording.active) { // else it may be the only name of the pass that has to end
        *id = (rhw_pass){0};
    }
    const enum rhw_result result = begin(context, def, id);
    rhw_context_leave(context);
    return result;
}
