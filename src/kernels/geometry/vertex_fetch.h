// SPDX-License-Identifier: MIT
// The way from vertex buffers to 8 lanes of floats.
//
// Most vertices lie well inside their buffers: RHW_FETCH_BYTES are loaded where each attribute begins, and 8 of these
// loads are turned into four vectors. The general path takes one vertex at a time and checks it against the buffer's
// end; it serves the groups that reach past this end.
#ifndef RHW_VERTEX_FETCH_H
#define RHW_VERTEX_FETCH_H

#include "draw/draw_list.h"
#include "format/format.h"
#include "pipeline/pipeline.h"
#include "base/simd_layout.h"

// Return what numbers of 8 or 16 bits are in the lanes. `bits` has the number, and rubbish above it.
static f32x8 narrow_to_lane(enum rhw_vertex_type type, i32x8 bits)
{
    switch (type) {
    case RHW_TYPE_HALF: return f32x8_from_half(bits & 0xffff);
    case RHW_TYPE_UNORM8: return rhw_float_from_int(bits & 0xff) / 255.0f;
    case RHW_TYPE_SNORM8: return f32x8_max(rhw_float_from_int(bits << 24 >> 24) / 127.0f, f32x8_splat(-1));
    case RHW_TYPE_USCALED8: return rhw_float_from_int(bits & 0xff);
    case RHW_TYPE_SSCALED8: return rhw_float_from_int(bits << 24 >> 24);
    case RHW_TYPE_UINT8: return (f32x8)(bits & 0xff);
    case RHW_TYPE_SINT8: return (f32x8)(bits << 24 >> 24);
    case RHW_TYPE_UNORM16: return rhw_float_from_int(bits & 0xffff) / 65535.0f;
    case RHW_TYPE_SNORM16: return f32x8_max(rhw_float_from_int(bits << 16 >> 16) / 32767.0f, f32x8_splat(-1));
    case RHW_TYPE_USCALED16: return rhw_float_from_int(bits & 0xffff);
    case RHW_TYPE_SSCALED16: return rhw_float_from_int(bits << 16 >> 16);
    case RHW_TYPE_UINT16: return (f32x8)(bits & 0xffff);
    default: return (f32x8)(bits << 16 >> 16);
    }
}

// Fetch four numbers of 8 or 16 bits at each of 8 places.
static void fetch_narrow(const void *const place[8], enum rhw_vertex_type type, f32x8 out[4])
{
    const bool has_16_bits = rhw_vertex_type_size(type) == 2;
    int32_t word[2][8];
    for (int lane = 0; lane < 8; lane++) {
        memcpy(&word[0][lane], place[lane], sizeof word[0][lane]);
        memcpy(&word[1][lane], (const char *)place[lane] + (has_16_bits ? 4 : 0), sizeof word[1][lane]);
    }
    for (int c = 0; c < 4; c++) {
        const i32x8 bits = i32x8_load(word[has_16_bits ? c / 2 : 0]);
        out[c] = narrow_to_lane(type, bits >> (has_16_bits ? 16 * (c % 2) : 8 * c));
    }
}

// Return what a field of `bits` bits is in the lanes. The field is given at the top of a word.
static f32x8 field_to_lane(enum rhw_vertex_type type, i32x8 top, int bits)
{
    const i32x8 code = (i32x8)((u32x8)top >> (32 - bits)), number = top >> (32 - bits);
    switch (type) {
    case RHW_TYPE_UNORM10: return rhw_float_from_int(code) / (float)((1 << bits) - 1);
    case RHW_TYPE_SNORM10:
        return f32x8_max(rhw_float_from_int(number) / (float)((1 << (bits - 1)) - 1), f32x8_splat(-1));
    case RHW_TYPE_USCALED10: return rhw_float_from_int(code);
    case RHW_TYPE_SSCALED10: return rhw_float_from_int(number);
    case RHW_TYPE_UINT10: return (f32x8)code;
    default: return (f32x8)number;
    }
}

// Fetch four components that share a word at each of 8 places.
static void fetch_packed(const void *const place[8], enum rhw_vertex_type type, f32x8 out[4])
{
    int32_t words[8];
    for (int lane = 0; lane < 8; lane++) {
        memcpy(&words[lane], place[lane], sizeof words[lane]);
    }
    const i32x8 word = i32x8_load(words);
    const bool is_swapped = type >= RHW_TYPE_UNORM10_BGRA;
    const enum rhw_vertex_type field =
        is_swapped ? (enum rhw_vertex_type)(type - RHW_TYPE_UNORM10_BGRA + RHW_TYPE_UNORM10) : type;
    for (int c = 0; c < 4; c++) {
        if (type == RHW_TYPE_BGRA8) {
            out[c] = narrow_to_lane(RHW_TYPE_UNORM8, word >> (c < 3 ? 16 - 8 * c : 24));
        } else {
            const int up = c == 3 ? 0 : is_swapped ? 2 + 10 * c : 22 - 10 * c;
            out[c] = field_to_lane(field, word << up, c < 3 ? 10 : 2);
        }
    }
}

// Fetch one attribute of 8 vertices. Four components are loaded at each place, however many the attribute has, and the
// others are replaced: lies_inside tells where that may be.
RHW_INLINE void fetch_places(const void *const place[8], const struct rhw_fetch *fetch, f32x8 out[4])
{
    const enum rhw_vertex_type type = (enum rhw_vertex_type)fetch->type;
    if (type == RHW_TYPE_FLOAT || type == RHW_TYPE_UINT32 || type == RHW_TYPE_SINT32) {
        f32x8_load_columns(place, out);
    } else if (type < RHW_TYPE_UNORM10) {
        fetch_narrow(place, type, out);
    } else {
        fetch_packed(place, type, out);
    }
    switch (fetch->components) {
    case 1: out[1] = f32x8_splat(0);                                             // fall through
    case 2: out[2] = f32x8_splat(0);                                             // fall through
    case 3: out[3] = fetch->is_integer ? (f32x8)i32x8_splat(1) : f32x8_splat(1); // fall through
    default: break;
    }
}

// Fetch an attribute from a buffer that may end before it. `element` says which element of the stream each lane reads.
// A lane whose element is not wholly inside the buffer reads bytes of 0 (robustBufferAccess2); channels that the format
// lacks are what they always are.
static __attribute__((noinline)) void fetch_checked(const struct rhw_vertex_stream *stream,
                                                    const struct rhw_fetch *fetch, uint32_t stride,
                                                    const uint32_t element[8], f32x8 out[4])
{
    unsigned char bytes[8][16] = {{0}};
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        const uint64_t offset = (uint64_t)element[lane] * stride + fetch->offset;
        if (offset <= stream->size && stream->size - offset >= fetch->size) {
            memcpy(bytes[lane], stream->bytes + offset, fetch->size);
        }
        places[lane] = bytes[lane];
    }
    fetch_places(places, fetch, out);
}

// Return true if the attribute lies wholly inside the buffer for all of 8 vertices, and so does all that is loaded with
// it, where nothing may be read behind the buffer.
static bool lies_inside(const struct rhw_vertex_stream *stream, const struct rhw_fetch *fetch,
                        uint32_t stride, const uint32_t element[8])
{
    uint32_t last = element[0];
    for (int lane = 1; lane < 8; lane++) {
        last = element[lane] > last ? element[lane] : last;
    }
    const uint32_t reach = fetch->size > stream->loaded ? fetch->size : stream->loaded;
    return (uint64_t)last * stride + fetch->offset + reach <= stream->size;
}

// Fetch an attribute from a buffer that has all 8 elements.
static void fetch_inside(const struct rhw_vertex_stream *stream, const struct rhw_fetch *fetch,
                         uint32_t stride, const uint32_t element[8], f32x8 out[4])
{
    const unsigned char *const bytes = stream->bytes + fetch->offset;
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        places[lane] = bytes + (size_t)element[lane] * stride;
    }
    fetch_places(places, fetch, out);
}

#endif
