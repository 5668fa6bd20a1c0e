// SPDX-License-Identifier: MIT
// From vertex buffers to 8 lanes of floats.
//
// Most vertices lie well inside their buffers: 16 bytes are loaded where each one's attribute begins, and 8 of them are
// turned into four vectors. One at a time, checked against the buffer's end, is the general path; it takes the groups
// that reach past that end.
#ifndef RHW_VERTEX_FETCH_H
#define RHW_VERTEX_FETCH_H

#include "../../draw_list.h"
#include "../../format.h"
#include "../../half.h"
#include "../../pipeline.h"
#include "../../simd_layout.h"

// One attribute of `type` with 1 to 4 components; the rest of `out` is left alone.
static void read_attribute(const unsigned char *p, enum rhw_vertex_type type, int components, float out[4])
{
    for (int c = 0; c < components; c++) {
        uint16_t u16 = 0;
        if (rhw_vertex_type_size(type) == 2) {
            memcpy(&u16, p + 2 * c, sizeof u16);
        }
        switch (type) {
        case RHW_TYPE_FLOAT: memcpy(&out[c], p + 4 * c, sizeof out[c]); break;
        case RHW_TYPE_HALF: out[c] = rhw_half_to_float(u16); break;
        case RHW_TYPE_UNORM8: out[c] = (float)p[c] / 255.0f; break;
        case RHW_TYPE_SNORM8: out[c] = (int8_t)p[c] == -128 ? -1.0f : (float)(int8_t)p[c] / 127.0f; break;
        case RHW_TYPE_UINT8: out[c] = (float)p[c]; break;
        case RHW_TYPE_SINT8: out[c] = (float)(int8_t)p[c]; break;
        case RHW_TYPE_UNORM16: out[c] = (float)u16 / 65535.0f; break;
        case RHW_TYPE_SNORM16:
            out[c] = (int16_t)u16 == -32768 ? -1.0f : (float)(int16_t)u16 / 32767.0f;
            break;
        case RHW_TYPE_UINT16: out[c] = (float)u16; break;
        default: out[c] = (float)(int16_t)u16; break;
        }
    }
}

// One attribute of 8 vertices, the general path. `element` says which element of the stream each lane reads; a lane
// whose element is not wholly inside the buffer reads 0, 0, 0, 1.
static __attribute__((noinline)) void fetch_checked(const struct rhw_vertex_stream *stream,
                                                    const struct rhw_attribute *attribute, uint32_t stride,
                                                    const uint32_t element[8], f8 out[4])
{
    const enum rhw_vertex_type type = rhw_vertex_format_type(attribute->format);
    const int components = rhw_vertex_format_components(attribute->format);
    const size_t size = (size_t)(components * rhw_vertex_type_size(type));
    float rows[8][4];
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        const uint64_t offset = (uint64_t)element[lane] * stride + attribute->offset;
        rows[lane][0] = rows[lane][1] = rows[lane][2] = 0;
        rows[lane][3] = 1;
        if (offset <= stream->size && stream->size - offset >= size) {
            read_attribute(stream->bytes + offset, type, components, rows[lane]);
        }
        places[lane] = rows[lane];
    }
    f8_load_columns(places, out);
}

// The floats that read_attribute makes of numbers of 8 or 16 bits, one of each lane: `bits` has the number, and above
// it rubbish.
static f8 narrow_to_float(enum rhw_vertex_type type, i8 bits)
{
    switch (type) {
    case RHW_TYPE_HALF: return f8_from_half(bits & 0xffff);
    case RHW_TYPE_UNORM8: return rhw_float_from_int(bits & 0xff) / 255.0f;
    case RHW_TYPE_SNORM8: return f8_max(rhw_float_from_int(bits << 24 >> 24) / 127.0f, f8_splat(-1));
    case RHW_TYPE_UINT8: return rhw_float_from_int(bits & 0xff);
    case RHW_TYPE_SINT8: return rhw_float_from_int(bits << 24 >> 24);
    case RHW_TYPE_UNORM16: return rhw_float_from_int(bits & 0xffff) / 65535.0f;
    case RHW_TYPE_SNORM16: return f8_max(rhw_float_from_int(bits << 16 >> 16) / 32767.0f, f8_splat(-1));
    case RHW_TYPE_UINT16: return rhw_float_from_int(bits & 0xffff);
    default: return rhw_float_from_int(bits << 16 >> 16);
    }
}

// Fetches four numbers of 8 or 16 bits at each of 8 places.
static void fetch_narrow(const void *const place[8], enum rhw_vertex_type type, f8 out[4])
{
    const bool has_16_bits = rhw_vertex_type_size(type) == 2;
    int32_t word[2][8];
    for (int lane = 0; lane < 8; lane++) {
        memcpy(&word[0][lane], place[lane], sizeof word[0][lane]);
        memcpy(&word[1][lane], (const char *)place[lane] + (has_16_bits ? 4 : 0), sizeof word[1][lane]);
    }
    for (int c = 0; c < 4; c++) {
        const i8 bits = i8_load(word[has_16_bits ? c / 2 : 0]);
        out[c] = narrow_to_float(type, bits >> (has_16_bits ? 16 * (c % 2) : 8 * c));
    }
}

// Whether the attribute lies wholly inside the buffer for all of 8 vertices.
static bool lies_inside(const struct rhw_vertex_stream *stream, const struct rhw_attribute *attribute,
                        uint32_t stride, const uint32_t element[8])
{
    uint32_t last = element[0];
    for (int lane = 1; lane < 8; lane++) {
        last = element[lane] > last ? element[lane] : last;
    }
    const uint64_t size = (uint64_t)rhw_vertex_format_components(attribute->format) *
                          (uint64_t)rhw_vertex_type_size(rhw_vertex_format_type(attribute->format));
    return (uint64_t)last * stride + attribute->offset + size <= stream->size;
}

// One attribute of 8 vertices that lies inside. Four components are loaded where each starts, however many there are,
// and what is not theirs is replaced: what lies behind a buffer may be read too (buffer.h).
static void fetch_inside(const struct rhw_vertex_stream *stream, const struct rhw_attribute *attribute,
                         uint32_t stride, const uint32_t element[8], f8 out[4])
{
    const enum rhw_vertex_type type = rhw_vertex_format_type(attribute->format);
    const unsigned char *const bytes = stream->bytes + attribute->offset;
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        places[lane] = bytes + (size_t)element[lane] * stride;
    }
    if (type == RHW_TYPE_FLOAT) {
        f8_load_columns(places, out);
    } else {
        fetch_narrow(places, type, out);
    }
    switch (rhw_vertex_format_components(attribute->format)) {
    case 1: out[1] = f8_splat(0); // fall through
    case 2: out[2] = f8_splat(0); // fall through
    case 3: out[3] = f8_splat(1); // fall through
    default: break;
    }
}

#endif
