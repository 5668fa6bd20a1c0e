// SPDX-License-Identifier: MIT
// The program tells here what it has written to texels on its memory. What the library keeps about other texels of the
// texture, the linear copy of srgb_texture.h above all, goes on to hold.
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "shared_texels.h"
#include "texture_access.h"
#include "texture_shape.h"

// Check that the texture has the layers. A count of 0 stands for all from `layer` on.
static bool check_layers(const struct rhw_context *context, rhw_texture id,
                         const struct rhw_texture_data *texture, int level, int layer, int layer_count,
                         const char *where)
{
    if (!rhw_texture_check_level(context, id, texture, level, where) ||
        !rhw_texture_check_layer(context, id, texture, level, layer, where)) {
        return false;
    }
    const int left = texture->mip[level].slices - layer;
    return rhw_check(context, layer_count >= 0 && layer_count <= left,
                     "%s: layer is %d and layer_count is %d; level %d of %s has 0..%d", where, layer,
                     layer_count, level, rhw_name_of(&context->textures, id.index).text,
                     texture->mip[level].slices - 1);
}

static bool check_changed(const struct rhw_context *context, rhw_texture id,
                          const struct rhw_texture_data *texture, const char *where)
{
    return rhw_check(context, texture->shared && texture->shared->is_callers,
                     "%s: %s stands on memory of the library; it must stand on memory of the program", where,
                     rhw_name_of(&context->textures, id.index).text) &&
           rhw_texture_check_unattached(context, id, texture, where) &&
           rhw_texture_check_unread(context, id, texture, where);
}

enum rhw_result rhw_texture_changed(rhw_context *context, rhw_texture texture, int level, int layer,
                                    int layer_count)
{
    static const char *const where = "rhw_texture_changed";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    const bool is_valid = data && check_layers(context, texture, data, level, layer, layer_count, where) &&
                          check_changed(context, texture, data, where);
    if (is_valid) {
        const int left = data->mip[level].slices - layer;
        rhw_texture_note_changed(data, level, layer, layer_count == 0 ? left : layer_count);
    }
    rhw_context_leave(context);
    return is_valid ? RHW_OK : RHW_ERROR_MISUSE;
}
