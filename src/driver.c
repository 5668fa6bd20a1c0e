// SPDX-License-Identifier: MIT
#include "driver.h"

#include "resource/texture.h"

void rhw_driver_texture_layout(const struct rhw_texture_def *def, struct rhw_texture_layout *layout)
{
    rhw_texture_layout_of(def, layout);
}
