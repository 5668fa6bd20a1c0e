// SPDX-License-Identifier: MIT
// A triangle over the whole picture: backgrounds, and passes from texture to texture.
#ifndef SCENE_SCREEN_H
#define SCENE_SCREEN_H

#include "rhw/rhw.h"
#include "draw/shading/scene_shaders.h"

/// Records it; color 0 alone is written. `uniforms` are those of `kind`.
enum rhw_result scene_screen_record(rhw_context *context, rhw_pass pass, enum scene_screen_kind kind,
                                    const enum rhw_format *formats, int format_count, const void *uniforms);

/// Records a layer of premultiplied colours over what all attachments have, sample by sample: SCENE_SCREEN_LAYER, whose
/// textures are bound.
enum rhw_result scene_screen_lay(rhw_context *context, rhw_pass pass, const enum rhw_format *formats,
                                 int format_count, const struct scene_layer *layer);

/// Begins a pass that writes every texel of `texture`, and nothing else.
enum rhw_result scene_screen_begin(rhw_context *context, rhw_texture texture, rhw_pass *pass);

/// Ends a pass whatever came before, since only that gives it back. `stats` may be NULL.
enum rhw_result scene_pass_end(rhw_context *context, rhw_pass pass, enum rhw_result so_far,
                               struct rhw_stats *stats);

#endif
