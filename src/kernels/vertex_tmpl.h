// SPDX-License-Identifier: MIT
// Vertices: fetch from the buffers into 8 lanes, the vertex function, projection and snapping, and the record
// that triangles read. Template: compiled once per instruction set.

#include "../format.h"
#include "../half.h"
#include "../shader_adapter.h"
#include "scratch.h"

// One value of `type` with 1 to 4 components; the rest of `out` is left alone.
static void fetch_lane(const unsigned char *p, enum rhw_vertex_type type, int components, float out[4])
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

// One attribute of 8 vertices, the slow way. `element` says which element of the stream each lane reads; a lane
// whose element is not wholly inside the buffer reads 0, 0, 0, 1.
static __attribute__((noinline)) void fetch_lanes(const struct rhw_vertex_stream *stream,
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
            fetch_lane(stream->bytes + offset, type, components, rows[lane]);
        }
        places[lane] = rows[lane];
    }
    f8_load_columns(places, out);
}

// Numbers of 8 or 16 bits as fetch_lane makes them, one of each lane: `code` has its bits, and above them rubbish.
static f8 widen_code(enum rhw_vertex_type type, i8 code)
{
    switch (type) {
    case RHW_TYPE_HALF: return f8_from_half(code & 0xffff);
    case RHW_TYPE_UNORM8: return rhw_to_float(code & 0xff) / 255.0f;
    case RHW_TYPE_SNORM8: return f8_max(rhw_to_float(code << 24 >> 24) / 127.0f, f8_splat(-1));
    case RHW_TYPE_UINT8: return rhw_to_float(code & 0xff);
    case RHW_TYPE_SINT8: return rhw_to_float(code << 24 >> 24);
    case RHW_TYPE_UNORM16: return rhw_to_float(code & 0xffff) / 65535.0f;
    case RHW_TYPE_SNORM16: return f8_max(rhw_to_float(code << 16 >> 16) / 32767.0f, f8_splat(-1));
    case RHW_TYPE_UINT16: return rhw_to_float(code & 0xffff);
    default: return rhw_to_float(code << 16 >> 16);
    }
}

// Four numbers of 8 or 16 bits at each of 8 places.
static void fetch_codes(const void *const place[8], enum rhw_vertex_type type, f8 out[4])
{
    const bool wide = rhw_vertex_type_size(type) == 2;
    int32_t word[2][8];
    for (int lane = 0; lane < 8; lane++) {
        memcpy(&word[0][lane], place[lane], sizeof word[0][lane]);
        memcpy(&word[1][lane], (const char *)place[lane] + (wide ? 4 : 0), sizeof word[1][lane]);
    }
    for (int c = 0; c < 4; c++) {
        const i8 codes = i8_load(word[wide ? c / 2 : 0]);
        out[c] = widen_code(type, codes >> (wide ? 16 * (c % 2) : 8 * c));
    }
}

// One attribute of 8 vertices. Four components are loaded where each starts, however many there are, and what is not
// theirs is replaced: what lies behind a buffer may be read too (buffer.h).
static void fetch_attribute(const struct rhw_vertex_stream *stream, const struct rhw_attribute *attribute,
                            uint32_t stride, const uint32_t element[8], f8 out[4])
{
    uint32_t last = element[0];
    for (int lane = 1; lane < 8; lane++) {
        last = element[lane] > last ? element[lane] : last;
    }
    const enum rhw_vertex_type type = rhw_vertex_format_type(attribute->format);
    const int components = rhw_vertex_format_components(attribute->format);
    const uint64_t end = (uint64_t)last * stride + attribute->offset +
                         (uint64_t)components * (uint64_t)rhw_vertex_type_size(type);
    if (end > stream->size) {
        fetch_lanes(stream, attribute, stride, element, out);
        return;
    }
    const unsigned char *const bytes = stream->bytes + attribute->offset;
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        places[lane] = bytes + (size_t)element[lane] * stride;
    }
    if (type == RHW_TYPE_FLOAT) {
        f8_load_columns(places, out);
    } else {
        fetch_codes(places, type, out);
    }
    switch (components) {
    case 1: out[1] = f8_splat(0); // fall through
    case 2: out[2] = f8_splat(0); // fall through
    case 3: out[3] = f8_splat(1); // fall through
    default: break;
    }
}

// Clip coordinates to the header of the vertex records.
static void project(const struct rhw_draw_state *state, const f8 position[4], f8 header[8])
{
    const f8 x = position[0], y = position[1], z = position[2], w = position[3];
    const bool symmetric = state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    const f8 near = symmetric ? -w : f8_splat(0);
    const f8 zero = f8_splat(0);
    const d8 wd = d8_from_f8(w);
    const d8 sx =
        d8_add(d8_mul(d8_div(d8_from_f8(x), wd), d8_splat(state->half_width)), d8_splat(state->center_x));
    const d8 sy =
        d8_sub(d8_splat(state->center_y), d8_mul(d8_div(d8_from_f8(y), wd), d8_splat(state->half_height)));
    const f8 d = f8_from_d8(
        d8_add(d8_splat(state->depth_low), d8_mul(d8_splat(state->depth_span), d8_div(d8_from_f8(z), wd))));
    // In float the comparisons err by a rounding at 32768, a power of two: there the float is below or equal
    // exactly when the double rounds to it or below.
    const f8 fx = f8_from_d8(sx), fy = f8_from_d8(sy);
    const f8 band = f8_splat((float)RHW_GUARD_BAND), far_depth = f8_splat(1e30f);
    const i8 snapped = rhw_less(zero, w) & rhw_less_equal(fx, band) & rhw_less_equal(-band, fx) &
                       rhw_less_equal(fy, band) & rhw_less_equal(-band, fy) & rhw_less(d, far_depth) &
                       rhw_less(-far_depth, d);
    const i8 finite =
        rhw_equal(x - x, zero) & rhw_equal(y - y, zero) & rhw_equal(z - z, zero) & rhw_equal(w - w, zero);
    i8 flags = rhw_less(x, -w) & i8_splat(RHW_VERTEX_LEFT);
    flags |= rhw_less(w, x) & i8_splat(RHW_VERTEX_RIGHT);
    flags |= rhw_less(y, -w) & i8_splat(RHW_VERTEX_BOTTOM);
    flags |= rhw_less(w, y) & i8_splat(RHW_VERTEX_TOP);
    flags |= rhw_less(z, near) & i8_splat(RHW_VERTEX_NEAR);
    flags |= rhw_less(w, z) & i8_splat(RHW_VERTEX_FAR);
    flags |= ~snapped & i8_splat(RHW_VERTEX_UNSNAPPED);
    flags |= ~finite & i8_splat(RHW_VERTEX_NOT_FINITE);
    const double limit = RHW_GUARD_BAND;
    const d8 unit = d8_splat(RHW_SUBPIXEL);
    header[0] = (f8)i8_round_d8(d8_mul(d8_clamp(sx, -limit, limit), unit));
    header[1] = (f8)i8_round_d8(d8_mul(d8_clamp(sy, -limit, limit), unit));
    header[2] = d;
    header[3] = (f8)flags;
    header[4] = x;
    header[5] = y;
    header[6] = z;
    header[7] = w;
}

// Writes 8 vectors of 8 vertices as 8 floats of each vertex.
static void scatter(f8 vectors[8], float *records, int stride)
{
    f8_transpose(vectors);
    for (int lane = 0; lane < 8; lane++) {
        f8_store(records + lane * stride, vectors[lane]);
    }
}

// Writes the records of 8 vertices, and what culling reads of them once more into `corners`.
static void store_records(const struct rhw_draw_state *state, const struct rhw_vertex *group, int stride,
                          float *records, struct rhw_corner *corners)
{
    const int components = state->pipeline->varying_components;
    f8 vectors[8];
    project(state, group->position, vectors);
    scatter(vectors, records, stride);
    for (int lane = 0; lane < 8; lane++) {
        memcpy(&corners[lane], &vectors[lane], sizeof *corners);
    }
    for (int c = 0; c < components; c += 8) {
        const int n = components - c < 8 ? components - c : 8;
        for (int i = 0; i < 8; i++) {
            vectors[i] = i < n ? group->varying[c + i] : f8_splat(0);
        }
        scatter(vectors, records + 8 + c, stride);
    }
}

// Shades `count` vertices, whose indices are scratch->unique, into the segment. `count` is rounded up to 8:
// the last group repeats its last vertex, and there is room for it.
static void shade_vertices(struct rhw_front_scratch *scratch, const struct rhw_segment *segment,
                           struct rhw_corner *corners, uint32_t count)
{
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const struct rhw_pipeline_def *const def = &pipeline->def;
    const uint32_t instance = segment->draw->first_instance + segment->instance;
    const uint32_t total = (count + 7) / 8;
    for (uint32_t i = count; i < 8 * total; i++) {
        scratch->unique[i] = scratch->unique[count - 1];
    }
    for (uint32_t first = 0; first < total; first += RHW_VERTEX_GROUPS) {
        const int groups = (int)(total - first < RHW_VERTEX_GROUPS ? total - first : RHW_VERTEX_GROUPS);
        for (int g = 0; g < groups; g++) {
            struct rhw_vertex *const group = &scratch->groups[g];
            uint32_t element[8], instances[8];
            memcpy(element, &scratch->unique[8 * (first + (uint32_t)g)], sizeof element);
            for (int lane = 0; lane < 8; lane++) {
                instances[lane] = instance;
            }
            for (int a = 0; a < def->attribute_count; a++) {
                const struct rhw_attribute *const attribute = &def->attributes[a];
                const struct rhw_vertex_layout *const layout = &def->buffers[attribute->buffer];
                fetch_attribute(&state->streams[attribute->buffer], attribute, layout->stride,
                                layout->per_instance ? instances : element, scratch->attributes[g][a]);
            }
            group->attribute = (const f8(*)[4])scratch->attributes[g];
            group->vertex_index = i8_load(element);
            group->instance_index = i8_load(instances);
            group->uniforms = segment->draw->uniforms;
            group->user = def->program.user;
            group->textures = state->textures;
            group->varying = scratch->varyings + g * pipeline->varying_components;
        }
        if (pipeline->vertex) {
            pipeline->vertex(scratch->groups, groups);
        } else {
            rhw_vertex1_run(pipeline, scratch->groups, groups);
        }
        for (int g = 0; g < groups; g++) {
            store_records(state, &scratch->groups[g], segment->vertex_stride,
                          segment->vertices +
                              (size_t)(8 * (first + (uint32_t)g)) * (size_t)segment->vertex_stride,
                          corners + 8 * (first + (uint32_t)g));
        }
    }
}
