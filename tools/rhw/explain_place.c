// SPDX-License-Identifier: MIT
// What a sampler's address modes make of a place beyond the edge of a texture; see explain_write.h.
#include "explain_write.h"

#include <math.h>

// Vulkan 1.3, Texel Coordinate Systems: Wrapping Operation, of a place that counts from the middle of the first texel.
static double wrap(enum rhw_address address, double place, double side)
{
    const double last = side - 1.0, periods = floor((place + 0.5) / side), inside = place - side * periods;
    switch (address) {
    case RHW_ADDRESS_REPEAT: return inside;
    case RHW_ADDRESS_MIRROR: return fmod(periods, 2.0) != 0.0 ? last - inside : inside;
    case RHW_ADDRESS_CLAMP: return fmin(fmax(place, 0.0), last);
    case RHW_ADDRESS_MIRROR_ONCE: return fmin(fmax(fabs(place + 0.5) - 0.5, 0.0), last);
    case RHW_ADDRESS_BORDER: return place;
    }
    return place;
}

struct cli_texture_place cli_texture_place(const struct scene_texture_look *look,
                                           const struct scene_texture_slot *slot)
{
    struct cli_texture_place place = {.address = {slot->address_u, slot->address_v},
                                      .filter = look->is_enlarged ? slot->mag_filter : slot->min_filter};
    const double side[2] = {look->width, look->height};
    for (int i = 0; i < 2; i++) {
        place.is_beyond[i] = look->uv[i] < 0.0f || look->uv[i] > 1.0f;
        place.is_border = place.is_border || (place.is_beyond[i] && place.address[i] == RHW_ADDRESS_BORDER);
        place.inside[i] = place.is_beyond[i] ? wrap(place.address[i], (double)look->place[i], side[i])
                                             : (double)look->place[i];
    }
    return place;
}
