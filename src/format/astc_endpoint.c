// SPDX-License-Identifier: MIT
// ASTC has ten endpoint modes of low dynamic range (Khronos Data Format Specification, "LDR Endpoint Decoding").
#include "astc_endpoint.h"

enum { RGBA = 4 };

static uint8_t clamp_code(int value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

static void set(uint8_t color[RGBA], int red, int green, int blue, int alpha)
{
    color[0] = clamp_code(red);
    color[1] = clamp_code(green);
    color[2] = clamp_code(blue);
    color[3] = clamp_code(alpha);
}

// Set a colour whose red and green were stored with twice their distance from blue: colours near grey are.
static void set_contracted(uint8_t color[RGBA], int red, int green, int blue, int alpha)
{
    set(color, (red + blue) >> 1, (green + blue) >> 1, blue, alpha);
}

// A base of 8 bits and an offset of −32..31 are taken from two bytes.
struct offset_pair {
    int base, sum; // sum is base + offset
    int offset;
};

static struct offset_pair transfer_bit(uint8_t first, uint8_t second)
{
    const int base = first >> 1 | (second & 0x80);
    const int low = second >> 1 & 0x3f;
    const int offset = low & 0x20 ? low - 0x40 : low;
    return (struct offset_pair){base, base + offset, offset};
}

// Set the endpoints from colours that are stored directly. The first colour is the darker one; colours that are stored
// the other way round are contracted.
static void set_direct(struct rhw_astc_endpoints *e, const uint8_t *v, int first_alpha, int second_alpha)
{
    if (v[1] + v[3] + v[5] >= v[0] + v[2] + v[4]) {
        set(e->color[0], v[0], v[2], v[4], first_alpha);
        set(e->color[1], v[1], v[3], v[5], second_alpha);
    } else {
        set_contracted(e->color[0], v[1], v[3], v[5], second_alpha);
        set_contracted(e->color[1], v[0], v[2], v[4], first_alpha);
    }
}

static void set_offset(struct rhw_astc_endpoints *e, const uint8_t *v, int base_alpha, int sum_alpha)
{
    const struct offset_pair red = transfer_bit(v[0], v[1]), green = transfer_bit(v[2], v[3]),
                             blue = transfer_bit(v[4], v[5]);
    if (red.offset + green.offset + blue.offset >= 0) {
        set(e->color[0], red.base, green.base, blue.base, base_alpha);
        set(e->color[1], red.sum, green.sum, blue.sum, sum_alpha);
    } else {
        set_contracted(e->color[0], red.sum, green.sum, blue.sum, sum_alpha);
        set_contracted(e->color[1], red.base, green.base, blue.base, base_alpha);
    }
}

static void set_scaled(struct rhw_astc_endpoints *e, const uint8_t *v, int first_alpha, int second_alpha)
{
    set(e->color[0], v[0] * v[3] >> 8, v[1] * v[3] >> 8, v[2] * v[3] >> 8, first_alpha);
    set(e->color[1], v[0], v[1], v[2], second_alpha);
}

static void set_luminance(uint8_t color[RGBA], int luminance, int alpha)
{
    set(color, luminance, luminance, luminance, alpha);
}

static void set_luminance_offset(struct rhw_astc_endpoints *e, const uint8_t *v)
{
    const int base = v[0] >> 2 | (v[1] & 0xc0);
    set_luminance(e->color[0], base, 255);
    set_luminance(e->color[1], base + (v[1] & 0x3f), 255);
}

struct rhw_astc_endpoints rhw_astc_endpoints(int mode, const uint8_t *v)
{
    struct rhw_astc_endpoints e = {.is_error = false};
    struct offset_pair luminance, alpha;
    switch (mode) {
    case 0:
        set_luminance(e.color[0], v[0], 255);
        set_luminance(e.color[1], v[1], 255);
        break;
    case 1: set_luminance_offset(&e, v); break;
    case 4:
        set_luminance(e.color[0], v[0], v[2]);
        set_luminance(e.color[1], v[1], v[3]);
        break;
    case 5:
        luminance = transfer_bit(v[0], v[1]);
        alpha = transfer_bit(v[2], v[3]);
        set_luminance(e.color[0], luminance.base, alpha.base);
        set_luminance(e.color[1], luminance.sum, alpha.sum);
        break;
    case 6: set_scaled(&e, v, 255, 255); break;
    case 8: set_direct(&e, v, 255, 255); break;
    case 9: set_offset(&e, v, 255, 255); break;
    case 10: set_scaled(&e, v, v[4], v[5]); break;
    case 12: set_direct(&e, v, v[6], v[7]); break;
    case 13:
        alpha = transfer_bit(v[6], v[7]);
        set_offset(&e, v, alpha.base, alpha.sum);
        break;
    default: e.is_error = true; break;
    }
    return e;
}
