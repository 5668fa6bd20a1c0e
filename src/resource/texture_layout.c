// SPDX-License-Identifier: MIT
// Where texels lie: what rhw_texture_data_init decides, told to the program.
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "texture.h"
#include "texture_shape.h"

static void tell(const struct rhw_texture_data *texture, struct rhw_texture_layout *layout)
{
    *layout = (struct rhw_texture_layout){.size = texture->memory_size,
                                          .alignment = RHW_MEMORY_ALIGNMENT,
                                          .levels = texture->levels,
                                          .sample_stride = texture->sample_stride};
    const bool has_stencil = rhw_format_has_role(texture->info, RHW_ROLE_STENCIL_TARGET) &&
                             rhw_format_has_role(texture->info, RHW_ROLE_DEPTH_TARGET);
    size_t next = 0;
    for (int i = 0; i < texture->levels; i++) {
        const struct rhw_mip *const mip = &texture->mip[i];
        struct rhw_level_layout *const level = &layout->level[i];
        level->offset = next;
        level->row_pitch = mip->row_pitch;
        level->slice_pitch = mip->slice_pitch;
        next += mip->slice_pitch * (size_t)mip->slices;
        if (has_stencil) {
            level->stencil_offset = next;
            level->stencil_row_pitch = mip->stencil_pitch;
            level->stencil_slice_pitch = mip->stencil_pitch * (size_t)mip->height;
            next += level->stencil_slice_pitch * (size_t)mip->slices;
        }
    }
}

enum rhw_result rhw_texture_query_layout(rhw_context *context, const struct rhw_texture_def *def,
                                         struct rhw_texture_layout *layout)
{
    static const char *const where = "rhw_texture_query_layout";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const bool is_valid = rhw_check(context, def != NULL, "%s: def is NULL", where) &&
                          rhw_check(context, layout != NULL, "%s: layout is NULL", where) &&
                          rhw_check_format(context, where, "format", def->format) &&
                          rhw_texture_shape_check(context, def, where);
    if (is_valid) {
        const struct rhw_texture_shape shape = rhw_texture_shape_of(def);
        struct rhw_texture_data texture;
        rhw_texture_data_init(&texture, def->format, &shape);
        tell(&texture, layout);
    }
    rhw_context_leave(context);
    return is_valid ? RHW_OK : RHW_ERROR_MISUSE;
}
