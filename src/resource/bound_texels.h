// SPDX-License-Identifier: MIT
// Textures that bindings in memory of the program sample. No pass is told that its functions sample one, so what
// sampling needs beside the texels, the linear copy of srgb_texture.h, is made when a binding is, and made anew before
// each pass that follows a write. A list has the shared texels that were written: looking through all textures with
// bindings would cost a small pass more than drawing.
#ifndef RHW_BOUND_TEXELS_H
#define RHW_BOUND_TEXELS_H

#include <stdbool.h>

#include "rhw/types.h"

struct rhw_context;
struct rhw_texture_data;

// Make the texels of a live texture stay where they are, so that bindings can point at them. Draws that were recorded
// and read them go on to do so. Return false when out of memory.
bool rhw_texture_pin(struct rhw_context *context, rhw_texture id, struct rhw_texture_data *texture);
// Prepare a pinned texture for being sampled by bindings from now on. Return RHW_OK, RHW_ERROR_OUT_OF_MEMORY or
// RHW_ERROR_GIVEN_UP.
enum rhw_result rhw_texture_note_bound(struct rhw_context *context, struct rhw_texture_data *texture);

// Prepare the textures with bindings that were written since the last pass or dispatch, before another runs. What that
// draws into is prepared for the next. Return RHW_OK, RHW_ERROR_OUT_OF_MEMORY or RHW_ERROR_GIVEN_UP.
enum rhw_result rhw_bound_texels_prepare(struct rhw_context *context);

#endif
