// SPDX-License-Identifier: MIT
// The attachments of a pass begin as its definition, which is checked here, and become what tiles load, draw into and
// store.
#include "attach.h"

#include <stdio.h>
#include <string.h>

#include "attached_texture.h"
#include "pipeline/blend_state.h"
#include "resource/clear_texel.h"
#include "context/context.h"
#include "base/cpu.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "encoder.h"

static const char *const where = "rhw_pass_begin";

// Check the load and store operations of an attachment. `prefix` stands before the members' names in messages, as
// "depth.stencil_" does.
static bool check_operations(rhw_context *context, const char *prefix, enum rhw_load load,
                             enum rhw_store store)
{
    return rhw_check(context, (unsigned)load <= RHW_LOAD_DISCARD, "%s: %sload is %d; not a load operation",
                     where, prefix, (int)load) &&
           rhw_check(context, (unsigned)store <= RHW_STORE_DISCARD,
                     "%s: %sstore is %d; not a store operation", where, prefix, (int)store);
}

// Check a resolve mode. RHW_RESOLVE_NONE, which leaves the texture to resolve into as it is, is good only if
// `may_be_none`.
static bool check_resolve_mode(rhw_context *context, const char *prefix, enum rhw_resolve mode,
                               bool may_be_none)
{
    return rhw_check(context, (unsigned)mode <= RHW_RESOLVE_NONE,
                     "%s: %sresolve_mode is %d; not a resolve mode", where, prefix, (int)mode) &&
           rhw_check(
               context, mode != RHW_RESOLVE_NONE || may_be_none,
               "%s: %sresolve_mode is RHW_RESOLVE_NONE; that is for a depth attachment with resolve set",
               where, prefix);
}

static struct rhw_name name_of(const rhw_context *context, rhw_texture id)
{
    return rhw_name_of(&context->textures, id.index);
}

static int layers_of(int layer_count)
{
    return layer_count == 0 ? 1 : layer_count;
}

// Return the operation that a load operation stands for: RHW_LOAD_DEFAULT clears.
static enum rhw_load load_of(enum rhw_load load)
{
    return load == RHW_LOAD_DEFAULT ? RHW_LOAD_CLEAR : load;
}

static bool has_role(enum rhw_format format, int role)
{
    return rhw_format_has_role(rhw_format_info(format), role);
}

static void set_clear(struct rhw_attachment *attachment, const unsigned char *texel)
{
    memset(attachment->clear, 0, sizeof attachment->clear);
    for (size_t i = 0; attachment->load == RHW_LOAD_CLEAR && i < sizeof attachment->clear;
         i += attachment->texel_size) {
        memcpy(attachment->clear + i, texel, attachment->texel_size);
    }
}

// Return true if the samples of an attachment are resolved. Where the only texture has one sample, storing is
// resolving. Where samples have a texture of their own, the texture beside it is resolved into in any case.
static bool is_resolved(const struct rhw_attachment *attachment)
{
    return attachment->resolve && attachment->resolve_mode != RHW_RESOLVE_NONE &&
           (!attachment->loads_resolved || attachment->store == RHW_STORE_STORE);
}

// Check the clear value of a colour attachment. NaN is reported under validation alone.
static bool check_clear(const rhw_context *context, const struct rhw_color_attachment *color,
                        const struct rhw_format_info *info, int i)
{
    const bool is_integer = rhw_format_is_integer(info);
    for (int c = 0; c < 4; c++) {
        const float value = color->clear[c];
        if (!rhw_check(context, value == value || !context->validation, "%s: colors[%d].clear[%d] is NaN",
                       where, i, c) ||
            !rhw_check(context, !is_integer || value == 0,
                       "%s: colors[%d].clear[%d] is set and %s holds integers; set clear_integer", where, i,
                       c, info->name) ||
            !rhw_check(context, is_integer || color->clear_integer[c] == 0,
                       "%s: colors[%d].clear_integer[%d] is set and %s holds no integers; set clear", where,
                       i, c, info->name)) {
            return false;
        }
    }
    return true;
}

static void set_color_clear(struct rhw_attachment *attachment, const struct rhw_color_attachment *color,
                            const struct rhw_format_info *info)
{
    float value[4];
    memcpy(value, color->clear, sizeof value);
    if (rhw_format_is_integer(info)) {
        memcpy(value, color->clear_integer, sizeof value);
    }
    unsigned char texel[RHW_TEXEL_BYTES];
    const uint64_t environment = rhw_cpu_float_enter();
    rhw_clear_texel(info, value, texel);
    rhw_cpu_float_leave(environment);
    set_clear(attachment, texel);
}

// Return the attachment that tiles have in place of one that the pass leaves out. It is cleared, nobody draws into it,
// and it is forgotten.
static struct rhw_attachment left_out(void)
{
    return (struct rhw_attachment){.is_left_out = true,
                                   .format = rhw_left_out_format,
                                   .texel_size = rhw_format_size(rhw_left_out_format),
                                   .load = RHW_LOAD_CLEAR,
                                   .store = RHW_STORE_DISCARD};
}

static enum rhw_result attach_color(struct rhw_encoder *encoder, const struct rhw_pass_def *def, int i)
{
    struct rhw_context *const context = encoder->context;
    const struct rhw_color_attachment *const color = &def->colors[i];
    struct rhw_attachment *const attachment = &encoder->pass->target.colors[i];
    char name[32], prefix[36];
    snprintf(name, sizeof name, "colors[%d]", i);
    snprintf(prefix, sizeof prefix, "%s.", name);
    if (!check_operations(context, prefix, color->load, color->store) ||
        !check_resolve_mode(context, prefix, color->resolve_mode, false)) {
        return RHW_ERROR_MISUSE;
    }
    if (color->texture.index == 0) {
        *attachment = left_out();
        return rhw_check(context, color->resolve.index == 0,
                         "%s: colors[%d].resolve is set and colors[%d].texture is null; it must be null then",
                         where, i, i)
                   ? RHW_OK
                   : RHW_ERROR_MISUSE;
    }
    *attachment = (struct rhw_attachment){.resolve_mode = color->resolve_mode};
    enum rhw_result result = rhw_pass_attach_texture(
        encoder, color->texture,
        (struct rhw_attached_part){color->layer, color->level, layers_of(color->layer_count)}, name,
        attachment);
    if (result == RHW_OK && color->resolve.index != 0) {
        result = rhw_pass_attach_resolve(encoder, color->resolve, name, attachment);
    }
    if (result != RHW_OK) {
        return result;
    }
    const struct rhw_format_info *const info = rhw_format_info(attachment->format);
    if (!rhw_check(context, rhw_format_has_role(info, RHW_ROLE_COLOR_TARGET),
                   "%s: colors[%d] is %s, which is %s; that is no colour target", where, i,
                   name_of(context, color->texture).text, info->name)) {
        return RHW_ERROR_MISUSE;
    }
    if (!check_clear(context, color, info, i)) {
        return RHW_ERROR_MISUSE;
    }
    attachment->load = load_of(color->load);
    attachment->store = color->store;
    attachment->resolves = is_resolved(attachment);
    set_color_clear(attachment, color, info);
    return RHW_OK;
}

static enum rhw_result attach_depth_texture(struct rhw_encoder *encoder,
                                            const struct rhw_depth_attachment *depth)
{
    struct rhw_target *const target = &encoder->pass->target;
    struct rhw_context *const context = encoder->context;
    enum rhw_result result = rhw_pass_attach_texture(
        encoder, depth->texture,
        (struct rhw_attached_part){depth->layer, depth->level, layers_of(depth->layer_count)}, "depth",
        &target->depth);
    if (result == RHW_OK && depth->resolve.index != 0) {
        result = rhw_pass_attach_resolve(encoder, depth->resolve, "depth", &target->depth);
    }
    if (result != RHW_OK) {
        return result;
    }
    const enum rhw_format format = target->depth.format;
    return (depth->format == RHW_FORMAT_NONE ||
            rhw_check_format(context, where, "depth.format", depth->format)) &&
                   rhw_check(context, has_role(format, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET),
                             "%s: depth is %s, which is %s; that has neither depth nor stencil", where,
                             name_of(context, depth->texture).text, rhw_format_info(format)->name) &&
                   rhw_check(context, depth->format == RHW_FORMAT_NONE || depth->format == format,
                             "%s: depth.format is %s; %s is %s", where, rhw_format_info(depth->format)->name,
                             name_of(context, depth->texture).text, rhw_format_info(format)->name)
               ? RHW_OK
               : RHW_ERROR_MISUSE;
}

// Check that an attachment that is only read is neither cleared nor discarded. `prefix` stands before the members'
// names in messages.
static bool check_read_only(const struct rhw_context *context, const struct rhw_depth_attachment *depth,
                            const char *prefix, enum rhw_load load, enum rhw_store store)
{
    return rhw_check(context, depth->texture.index != 0,
                     "%s: %sread_only is true and depth.texture is null; there is nothing to read", where,
                     prefix) &&
           rhw_check(context, (load == RHW_LOAD_DEFAULT || load == RHW_LOAD_LOAD) && store == RHW_STORE_STORE,
                     "%s: %sread_only is true, and %sload or %sstore clears or discards; they must be "
                     "RHW_LOAD_LOAD and RHW_STORE_STORE, which stores nothing then",
                     where, prefix, prefix, prefix);
}

// Make an attachment one that is read and stays as it is.
static void set_read_only(struct rhw_attachment *attachment)
{
    attachment->is_read_only = true;
    attachment->load = RHW_LOAD_LOAD;
    attachment->store = RHW_STORE_DISCARD;
}

// Check that nothing is loaded or stored where there is no texture. `prefix` stands before the members' names in
// messages.
static bool check_not_kept(const struct rhw_context *context, const char *prefix, enum rhw_load load,
                           enum rhw_store store)
{
    return rhw_check(
               context, load_of(load) == RHW_LOAD_CLEAR,
               "%s: depth.texture is null and %sload is not RHW_LOAD_CLEAR: give it a texture, or clear",
               where, prefix) &&
           rhw_check(context, store == RHW_STORE_DISCARD,
                     "%s: depth.texture is null and %sstore is RHW_STORE_STORE: give it a texture, or set "
                     "%sstore = RHW_STORE_DISCARD",
                     where, prefix, prefix);
}

static bool check_transient(const struct rhw_encoder *encoder, const struct rhw_depth_attachment *depth)
{
    struct rhw_context *const context = encoder->context;
    const enum rhw_format format = encoder->pass->target.depth.format;
    return rhw_check_format(context, where, "depth.format", format) &&
           rhw_check(context, has_role(format, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET),
                     "%s: depth.format is %s; that has neither depth nor stencil", where,
                     rhw_format_info(format)->name) &&
           (!has_role(format, RHW_ROLE_DEPTH_TARGET) ||
            check_not_kept(context, "depth.", depth->load, depth->store)) &&
           (!has_role(format, RHW_ROLE_STENCIL_TARGET) ||
            check_not_kept(context, "depth.stencil_", depth->stencil_load, depth->stencil_store));
}

// Make the stencil attachment from the depth attachment, whose texture and format it shares.
static void attach_stencil(struct rhw_encoder *encoder, const struct rhw_depth_attachment *depth)
{
    struct rhw_target *const target = &encoder->pass->target;
    struct rhw_attachment *const stencil = &target->stencil;
    target->has_stencil = has_role(target->depth.format, RHW_ROLE_STENCIL_TARGET);
    *stencil = (struct rhw_attachment){.format = target->depth.format, .texel_size = 1};
    stencil->load = load_of(depth->stencil_load);
    stencil->store = depth->stencil_store;
    if (depth->stencil_read_only) {
        set_read_only(stencil);
    }
    stencil->sample_stride = target->depth.sample_stride;
    stencil->layer = target->depth.layer;
    stencil->loads_resolved = target->depth.loads_resolved;
    stencil->target = rhw_stencil_aspect_of(target->depth.target, &encoder->pass->stencil_aspect);
    stencil->resolve = rhw_stencil_aspect_of(target->depth.resolve, &encoder->pass->stencil_resolve);
    stencil->resolve_mode = depth->stencil_resolve_mode == RHW_RESOLVE_DEFAULT ? depth->resolve_mode
                                                                               : depth->stencil_resolve_mode;
    stencil->resolves = target->has_stencil && is_resolved(stencil) &&
                        has_role(target->depth.resolve_format, RHW_ROLE_STENCIL_TARGET);
    set_clear(stencil, &depth->stencil_clear);
}

static void set_depth(struct rhw_encoder *encoder, const struct rhw_depth_attachment *depth)
{
    struct rhw_target *const target = &encoder->pass->target;
    const struct rhw_format_info *const info = rhw_format_info(target->depth.format);
    target->has_depth = rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET);
    target->depth_steps = rhw_codec_depth_steps(info->codec);
    target->depth.load = load_of(depth->load);
    target->depth.store = depth->store;
    target->depth.resolve_mode = depth->resolve_mode;
    if (depth->read_only) {
        set_read_only(&target->depth);
    }
    target->depth.resolves = target->has_depth && is_resolved(&target->depth) &&
                             has_role(target->depth.resolve_format, RHW_ROLE_DEPTH_TARGET);
    encoder->depth_by_default =
        target->depth.load == RHW_LOAD_CLEAR && depth->load == RHW_LOAD_DEFAULT && depth->clear == 0;
    const float clear[4] = {encoder->depth_by_default ? 1 : depth->clear};
    unsigned char texel[RHW_TEXEL_BYTES] = {0};
    const uint64_t environment = rhw_cpu_float_enter();
    rhw_clear_texel(info, clear, texel);
    rhw_cpu_float_leave(environment);
    set_clear(&target->depth, texel);
}

static enum rhw_result attach_depth(struct rhw_encoder *encoder, const struct rhw_pass_def *def)
{
    struct rhw_target *const target = &encoder->pass->target;
    struct rhw_context *const context = encoder->context;
    const struct rhw_depth_attachment *const depth = &def->depth;
    const enum rhw_format format = depth->format == RHW_FORMAT_NONE ? RHW_FORMAT_D32_FLOAT : depth->format;
    target->has_depth = target->has_stencil = encoder->depth_by_default = false;
    target->depth_steps = 0;
    target->depth = (struct rhw_attachment){.format = format, .texel_size = rhw_format_size(format)};
    if (!depth->enabled) {
        return RHW_OK;
    }
    if (!check_operations(context, "depth.", depth->load, depth->store) ||
        !check_operations(context, "depth.stencil_", depth->stencil_load, depth->stencil_store) ||
        !check_resolve_mode(context, "depth.", depth->resolve_mode, depth->resolve.index != 0) ||
        !check_resolve_mode(context, "depth.stencil_", depth->stencil_resolve_mode,
                            depth->resolve.index != 0) ||
        (depth->read_only && !check_read_only(context, depth, "depth.", depth->load, depth->store)) ||
        (depth->stencil_read_only &&
         !check_read_only(context, depth, "depth.stencil_", depth->stencil_load, depth->stencil_store))) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_check(context, depth->resolve.index == 0 || depth->texture.index != 0,
                   "%s: depth.resolve is set and depth.texture is null; it must be null then", where)) {
        return RHW_ERROR_MISUSE;
    }
    if (depth->texture.index != 0) {
        const enum rhw_result result = attach_depth_texture(encoder, depth);
        if (result != RHW_OK) {
            return result;
        }
    } else if (!check_transient(encoder, depth)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_check(context, depth->clear >= 0 && depth->clear <= 1, "%s: depth.clear is %g; it is in 0..1",
                   where, (double)depth->clear)) {
        return RHW_ERROR_MISUSE;
    }
    set_depth(encoder, depth);
    attach_stencil(encoder, depth);
    return RHW_OK;
}

// Return the number of the first colour attachment that is not left out, or color_count where all are left out.
static int first_color(const struct rhw_pass_def *def)
{
    int i = 0;
    while (i < def->color_count && def->colors[i].texture.index == 0) {
        i++;
    }
    return i;
}

bool rhw_pass_def_has_color(const struct rhw_pass_def *def)
{
    return first_color(def) < def->color_count;
}

// Return the samples of a pixel: the number that the definition names, or the number that the first attachment has.
// Return 0 where that attachment's texture is misuse.
static int samples_of(const struct rhw_encoder *encoder, const struct rhw_pass_def *def)
{
    const int color = first_color(def);
    const rhw_texture first = color < def->color_count ? def->colors[color].texture : def->depth.texture;
    if (def->samples != 0 || first.index == 0) {
        return def->samples == 0 ? 1 : def->samples;
    }
    const struct rhw_texture_data *const texture = rhw_context_texture(encoder->context, first, where);
    return texture ? texture->samples : 0;
}

// Set the layers of the pass: the number that the first attachment has, or the number that a definition without
// attachments names. Return false where it is misuse.
static bool set_layers(struct rhw_encoder *encoder, const struct rhw_pass_def *def)
{
    struct rhw_target *const target = &encoder->pass->target;
    const int color = first_color(def);
    char counted[32] = "layers";
    int count = def->layers;
    if (color < def->color_count) {
        snprintf(counted, sizeof counted, "colors[%d].layer_count", color);
        count = def->colors[color].layer_count;
    } else if (def->depth.enabled) {
        snprintf(counted, sizeof counted, "depth.layer_count");
        count = def->depth.layer_count;
    }
    target->layers = layers_of(count);
    return rhw_check(encoder->context, target->layers > 0 && target->layers <= RHW_MAX_TEXTURE_LAYERS,
                     "%s: %s is %d; it is 0..%d", where, counted, target->layers, RHW_MAX_TEXTURE_LAYERS);
}

enum rhw_result rhw_pass_attach(struct rhw_encoder *encoder, const struct rhw_pass_def *def)
{
    struct rhw_target *const target = &encoder->pass->target;
    const int samples = samples_of(encoder, def);
    if (samples == 0 || !rhw_check(encoder->context, rhw_sample_count_valid(samples),
                                   "%s: samples is %d; it is 0, 1, 2, 4, 8 or 16", where, samples)) {
        return RHW_ERROR_MISUSE;
    }
    target->pattern = rhw_sample_pattern_of(samples);
    if (!set_layers(encoder, def)) {
        return RHW_ERROR_MISUSE;
    }
    // An earlier pass has left its attachments here.
    memset(target->colors, 0, sizeof target->colors);
    target->depth = target->stencil = (struct rhw_attachment){.target = NULL};
    for (int i = 0; i < def->color_count; i++) {
        const enum rhw_result result = attach_color(encoder, def, i);
        if (result != RHW_OK) {
            return result;
        }
    }
    return attach_depth(encoder, def);
}
