// SPDX-License-Identifier: MIT
// How vertices become triangles: lists, strips, fans, restart, the three index types, offsets of every
// kind, and which vertex provokes. A strip or fan must draw the very bytes of the list of its triangles.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum { SIZE = 64, MAX_TRIANGLES = 128 };

// Every triangle shows its number, its facing and its flat value.
static void identity_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = __builtin_convertvector(groups[g].primitive, rhw_float) + 1.0f;
        groups[g].color[0][1] = rhw_select(groups[g].front_facing, rhw_splat(2), rhw_splat(1));
        groups[g].color[0][2] = groups[g].varying[0];
        groups[g].color[0][3] = groups[g].varying[1];
    }
}

static void open_rig(struct rig *rig)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, rig_vertex_pass, identity_fragment);
    rig->pipeline.program.uses = RHW_USE_FACING | RHW_USE_IDS;
    rig->pipeline.program.varyings[0].qualifier = RHW_FLAT;
}

// Points of a zigzag from left to right, as a strip of `count` vertices; value 0 is the vertex's number + 1.
static void make_zigzag(const struct rig *rig, int count, struct rig_vertex *vertices)
{
    for (int i = 0; i < count; i++) {
        const float x = 2 + 60.0f * (float)i / (float)count, y = i % 2 == 0 ? 50.25f : 10.75f;
        rig_place(rig, x, y, 0.5f, 1, vertices[i].position);
        vertices[i].value[0] = (float)(i + 1);
        vertices[i].value[1] = (float)(i * i);
        vertices[i].value[2] = vertices[i].value[3] = 0;
    }
}

// Points around a centre; vertex 0 is the centre.
static void make_wheel(const struct rig *rig, int count, struct rig_vertex *vertices)
{
    static const float rim[8][2] = {{1, 0},  {0.75f, -0.75f}, {0, -1}, {-0.75f, -0.75f},
                                    {-1, 0}, {-0.75f, 0.75f}, {0, 1},  {0.75f, 0.75f}};
    for (int i = 0; i < count; i++) {
        const float *p = rim[(i + 7) % 8];
        const float scale = i == 0 ? 0 : 30;
        rig_place(rig, 32 + scale * p[0], 32 + scale * p[1], 0.5f, 1, vertices[i].position);
        vertices[i].value[0] = (float)(i + 1);
        vertices[i].value[1] = (float)(7 * i);
        vertices[i].value[2] = vertices[i].value[3] = 0;
    }
}

// What Vulkan 1.3 §20.1 says about triangle n of a strip or fan: its vertices with their winding, and the
// first one as the vertex that provokes under the first-vertex convention.
static void triangle_of(enum rhw_topology topology, int n, int indices[3])
{
    if (topology == RHW_TRIANGLE_FAN) {
        indices[0] = n + 1, indices[1] = n + 2, indices[2] = 0;
    } else if (topology == RHW_TRIANGLE_STRIP) {
        indices[0] = n, indices[1] = n + 1 + n % 2, indices[2] = n + 2 - n % 2;
    } else {
        indices[0] = 3 * n, indices[1] = 3 * n + 1, indices[2] = 3 * n + 2;
    }
}

// Under the last-vertex convention the newest vertex provokes, of a list's triangle the third.
static int last_of(enum rhw_topology topology, int n)
{
    return topology == RHW_TRIANGLE_LIST ? 3 * n + 2 : n + 2;
}

// Draws the triangles of a strip or fan as a list whose three vertices all carry the provoking value.
static void draw_expanded(struct rig *rig, enum rhw_topology topology, enum rhw_provoking provoking,
                          const struct rig_vertex *vertices, int triangles)
{
    struct rig_vertex expanded[3 * MAX_TRIANGLES];
    for (int n = 0; n < triangles; n++) {
        int indices[3];
        triangle_of(topology, n, indices);
        const int provoker = provoking == RHW_PROVOKING_FIRST ? indices[0] : last_of(topology, n);
        for (int i = 0; i < 3; i++) {
            expanded[3 * n + i] = vertices[indices[i]];
            memcpy(expanded[3 * n + i].value, vertices[provoker].value, sizeof vertices->value);
        }
    }
    rig->pipeline.topology = RHW_TRIANGLE_LIST;
    rig_draw_once(rig, expanded, 3 * triangles);
}

static void test_strips_and_fans_are_their_triangles(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    const enum rhw_topology topologies[] = {RHW_TRIANGLE_LIST, RHW_TRIANGLE_STRIP, RHW_TRIANGLE_FAN};
    for (int t = 0; t < 3; t++) {
        for (int provoking = 0; provoking < 2; provoking++) {
            for (int count = 3; count <= 9; count++) {
                struct rig_vertex vertices[9];
                if (topologies[t] == RHW_TRIANGLE_STRIP) {
                    make_zigzag(&rig, count, vertices);
                } else {
                    make_wheel(&rig, count, vertices);
                }
                const int triangles = topologies[t] == RHW_TRIANGLE_LIST ? count / 3 : count - 2;
                rig.pipeline.provoking = (enum rhw_provoking)provoking;
                draw_expanded(&rig, topologies[t], rig.pipeline.provoking, vertices, triangles);
                const uint64_t expected = rig_hash(&rig, 0);
                rig.pipeline.topology = topologies[t];
                rig_draw_once(&rig, vertices, count);
                assert_int_equal(rig.stats.triangles_in, triangles);
                if (rig_hash(&rig, 0) != expected) {
                    fail_msg("topology %d, provoking %d, %d vertices differ from the list", t, provoking,
                             count);
                }
            }
        }
    }
    rig_close(&rig);
}

static void test_a_strip_faces_one_way(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig.pipeline.topology = RHW_TRIANGLE_STRIP;
    struct rig_vertex vertices[12];
    make_zigzag(&rig, 12, vertices);
    rig_draw_once(&rig, vertices, 12);
    const uint64_t both = rig_hash(&rig, 0);
    int seen[3] = {0};
    for (int cull = RHW_CULL_FRONT; cull <= RHW_CULL_BACK; cull++) {
        rig.pipeline.cull = (enum rhw_cull)cull;
        rig_draw_once(&rig, vertices, 12);
        assert_true(rig.stats.triangles_culled == 0 || rig.stats.triangles_culled == 10);
        seen[cull] = rig_hash(&rig, 0) == both;
    }
    assert_int_equal(seen[RHW_CULL_FRONT] + seen[RHW_CULL_BACK], 1);
    rig_close(&rig);
}

static void test_incomplete_triangles_are_nothing(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex vertices[8];
    make_wheel(&rig, 8, vertices);
    for (int topology = 0; topology < 3; topology++) {
        for (uint32_t count = 0; count < 3; count++) {
            rig.pipeline.topology = (enum rhw_topology)topology;
            rig_begin(&rig);
            rig_use_pipeline(&rig);
            rig_use_vertices(&rig, 0, vertices, sizeof vertices);
            rhw_pass_draw(rig.context, rig.recording, 0, count, 0, 1);
            rhw_pass_draw(rig.context, rig.recording, 0, 8, 0, 0);
            rig_end(&rig);
            assert_int_equal(rig.stats.triangles_in, 0);
            assert_int_equal(rig.stats.fragments_shaded, 0);
        }
    }
    rig_close(&rig);
}

static void store_index(unsigned char *data, enum rhw_index_type type, int i, uint32_t index)
{
    if (type == RHW_INDEX_UINT8) {
        data[i] = (unsigned char)index;
    } else if (type == RHW_INDEX_UINT16) {
        memcpy(data + 2 * i, &(uint16_t){(uint16_t)index}, 2);
    } else {
        memcpy(data + 4 * i, &index, 4);
    }
}

static const uint32_t restart_of[3] = {0xff, 0xffff, 0xffffffff};

// Draws `count` indices that stand `skip` bytes and then `first` indices into the buffer.
static void draw_indices(struct rig *rig, enum rhw_index_type type, const struct rig_vertex *vertices,
                         int vertex_count, const uint32_t *indices, int count, uint32_t first, size_t skip,
                         int32_t base)
{
    unsigned char data[4096];
    memset(data, 0xee, sizeof data);
    for (int i = 0; i < count; i++) {
        store_index(data + skip, type, i + (int)first, indices[i]);
    }
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, sizeof *vertices * (size_t)vertex_count);
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = sizeof data;
    def.data = data;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    rhw_pass_set_index_buffer(rig->context, rig->recording, buffer, type, skip);
    rhw_pass_draw_indexed(rig->context, rig->recording, first, (uint32_t)count, base, 0, 1);
    rig_end(rig);
    rhw_buffer_destroy(rig->context, buffer);
}

static void test_index_types_offsets_and_base_vertex(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex vertices[9], shifted[19] = {0};
    make_wheel(&rig, 9, vertices);
    memcpy(shifted + 7, vertices, sizeof vertices);
    const uint32_t indices[] = {1, 2, 0, 3, 4, 0, 7, 8, 0, 5, 6, 0};
    struct rig_vertex expanded[12];
    for (int i = 0; i < 12; i++) {
        expanded[i] = vertices[indices[i]];
    }
    rig_draw_once(&rig, expanded, 12);
    const uint64_t expected = rig_hash(&rig, 0);
    for (int type = 0; type < 3; type++) {
        for (size_t skip = 0; skip < 6; skip++) {
            for (uint32_t first = 0; first < 4; first++) {
                draw_indices(&rig, (enum rhw_index_type)type, vertices, 9, indices, 12, first, skip, 0);
                assert_true(rig_hash(&rig, 0) == expected);
                draw_indices(&rig, (enum rhw_index_type)type, shifted, 19, indices, 12, first, skip, 7);
                assert_true(rig_hash(&rig, 0) == expected);
            }
        }
    }
    uint32_t higher[12];
    for (int i = 0; i < 12; i++) {
        higher[i] = indices[i] + 100;
    }
    for (int type = 0; type < 3; type++) {
        draw_indices(&rig, (enum rhw_index_type)type, vertices, 9, higher, 12, 0, 0, -100);
        assert_true(rig_hash(&rig, 0) == expected);
    }
    rig_close(&rig);
}

enum { LONG_TRIANGLES = 2000, LONG_INDICES = 3 * LONG_TRIANGLES, LONG_BASE = 11 };

// Small triangles all over the target: vertices that follow each other stand close together.
static void make_trail(const struct rig *rig, int count, struct rig_vertex *vertices)
{
    uint32_t random = 1;
    float x = 32, y = 32;
    for (int i = 0; i < count; i++) {
        random = random * 1664525 + 1013904223;
        x += (float)(random >> 24) / 32 - (x > 60 ? 7 : x < 4 ? 1 : 4);
        y += (float)(random >> 16 & 255) / 32 - (y > 60 ? 7 : y < 4 ? 1 : 4);
        rig_place(rig, x, y, 0.5f, 1, vertices[i].position);
        vertices[i].value[0] = (float)(i + 1);
        vertices[i].value[1] = (float)(i % 97);
        vertices[i].value[2] = vertices[i].value[3] = 0;
    }
}

static void test_primitives_count_through_long_draws(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    static struct rig_vertex vertices[LONG_INDICES];
    make_trail(&rig, LONG_INDICES, vertices);
    for (int i = 0; i < LONG_INDICES; i++) {
        vertices[i].value[1] = (float)(i / 3 + 1);
    }
    rig_draw_once(&rig, vertices, LONG_INDICES);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][0] == pixels[i][3]);
    }
    rig_close(&rig);
}

// Draws so long that they are cut into several chunks, with indices that stay close together and with
// indices that jump, from buffers that are and are not aligned: vertices are found again in different ways.
static void test_long_draws_are_their_triangles(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    static struct rig_vertex vertices[LONG_INDICES + LONG_BASE], expanded[LONG_INDICES];
    static unsigned char data[2 + 4 * LONG_INDICES];
    make_trail(&rig, LONG_INDICES + LONG_BASE, vertices);
    for (int variant = 0; variant < 3 * 2 * 2 * 2 * 2; variant++) {
        const enum rhw_topology topology = (enum rhw_topology)(variant / 16);
        const bool jumps = variant & 1, aligned = variant & 2;
        const int base = variant & 4 ? LONG_BASE : 0;
        const enum rhw_index_type type = variant & 8 ? RHW_INDEX_UINT32 : RHW_INDEX_UINT16;
        unsigned char *const indices = data + (aligned ? 0 : 2);
        int index[LONG_INDICES];
        for (int i = 0; i < LONG_INDICES; i++) {
            index[i] = jumps ? i * 5 % LONG_INDICES : i / 4 + i * 7 % 5;
            store_index(indices, type, i, (uint32_t)index[i]);
        }
        for (int n = 0; n < LONG_TRIANGLES; n++) {
            int corner[3];
            triangle_of(topology, n, corner);
            for (int i = 0; i < 3; i++) {
                expanded[3 * n + i] = vertices[index[corner[i]] + base];
                memcpy(expanded[3 * n + i].value, vertices[index[corner[0]] + base].value, 16);
            }
        }
        rig.pipeline.topology = RHW_TRIANGLE_LIST;
        rig_draw_once(&rig, expanded, LONG_INDICES);
        const uint64_t expected = rig_hash(&rig, 0);
        rig.pipeline.topology = topology;
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, vertices, sizeof vertices);
        const struct rhw_buffer_def def = {.size = sizeof data, .data = data};
        rhw_buffer buffer;
        assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
        rhw_pass_set_index_buffer(rig.context, rig.recording, buffer, type, aligned ? 0 : 2);
        const uint32_t count = topology == RHW_TRIANGLE_LIST ? LONG_INDICES : LONG_TRIANGLES + 2;
        rhw_pass_draw_indexed(rig.context, rig.recording, 0, count, base, 0, 1);
        rig_end(&rig);
        rhw_buffer_destroy(rig.context, buffer);
        assert_int_equal(rig.stats.triangles_in, LONG_TRIANGLES);
        if (rig_hash(&rig, 0) != expected) {
            fail_msg("variant %d differs from the list of its triangles", variant);
        }
    }
    rig_close(&rig);
}

static void test_primitive_restart(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex vertices[12];
    make_zigzag(&rig, 12, vertices);
    // Three vertices, nothing, five vertices (the winding starts anew), a lone pair, nothing twice, four.
    const int runs[5][2] = {{0, 3}, {3, 5}, {0, 2}, {0, 0}, {8, 4}};
    for (int type = 0; type < 3; type++) {
        for (int fan = 0; fan < 2; fan++) {
            const enum rhw_topology topology = fan ? RHW_TRIANGLE_FAN : RHW_TRIANGLE_STRIP;
            uint32_t indices[32];
            struct rig_vertex expanded[64];
            int count = 0, corners = 0;
            for (int run = 0; run < 5; run++) {
                for (int i = 0; i < runs[run][1]; i++) {
                    indices[count++] = (uint32_t)(runs[run][0] + i);
                }
                for (int n = 0; n + 2 < runs[run][1]; n++) {
                    int corner[3];
                    triangle_of(topology, n, corner);
                    for (int i = 0; i < 3; i++) {
                        expanded[corners] = vertices[runs[run][0] + corner[i]];
                        memcpy(expanded[corners++].value, vertices[runs[run][0] + corner[0]].value, 16);
                    }
                }
                indices[count++] = restart_of[type];
            }
            rig.pipeline.topology = RHW_TRIANGLE_LIST;
            rig.pipeline.primitive_restart = false;
            rig_draw_once(&rig, expanded, corners);
            const uint64_t expected = rig_hash(&rig, 0);
            rig.pipeline.topology = topology;
            rig.pipeline.primitive_restart = true;
            draw_indices(&rig, (enum rhw_index_type)type, vertices, 12, indices, count, 0, 0, 0);
            assert_int_equal(rig.stats.triangles_in, corners / 3);
            assert_true(rig_hash(&rig, 0) == expected);
        }
    }
    rig_close(&rig);
}

static void test_restart_is_tested_before_the_base_vertex(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex vertices[8];
    make_zigzag(&rig, 8, vertices);
    rig.pipeline.topology = RHW_TRIANGLE_STRIP;
    rig.pipeline.primitive_restart = true;
    const uint32_t indices[] = {0, 1, 2, 0xff, 3, 4, 5};
    draw_indices(&rig, RHW_INDEX_UINT8, vertices, 8, indices, 7, 0, 0, 1);
    assert_int_equal(rig.stats.triangles_in, 2);
    const uint32_t plain[] = {1, 2, 3, 0xffff, 4, 5, 6};
    const uint64_t seen = rig_hash(&rig, 0);
    draw_indices(&rig, RHW_INDEX_UINT16, vertices, 8, plain, 7, 0, 0, 0);
    assert_true(rig_hash(&rig, 0) == seen);
    rig_close(&rig);
}

static void test_without_restart_the_largest_index_is_an_index(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    static struct rig_vertex vertices[65536];
    make_wheel(&rig, 3, vertices);
    vertices[0xff] = vertices[0xffff] = vertices[2];
    for (int topology = 0; topology < 3; topology++) {
        rig.pipeline.topology = (enum rhw_topology)topology;
        rig_draw_once(&rig, vertices, 3);
        const uint64_t expected = rig_hash(&rig, 0);
        assert_true(rig.stats.fragments_shaded > 0);
        for (int type = 0; type < 2; type++) {
            const uint32_t indices[3] = {0, 1, restart_of[type]};
            draw_indices(&rig, (enum rhw_index_type)type, vertices, 65536, indices, 3, 0, 0, 0);
            assert_true(rig_hash(&rig, 0) == expected);
        }
    }
    rig_close(&rig);
}

static void test_reads_outside_the_buffers(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    struct rig_vertex vertices[3];
    make_wheel(&rig, 3, vertices);
    // An index beyond the index buffer reads 0: three times vertex 0 is a triangle of no area.
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    const uint16_t indices[3] = {1, 2, 0};
    rig_use_indices(&rig, RHW_INDEX_UINT16, indices, sizeof indices);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 6, 0, 0, 1);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0xfffffff0, 6, 0, 0, 1);
    rig_end(&rig);
    assert_int_equal(rig.stats.triangles_in, 4);
    assert_int_equal(rig.stats.triangles_rasterized, 1);
    assert_int_equal(rig.stats.triangles_culled, 3);

    // A vertex beyond its buffer reads zeros, and 1 in the channel that its format lacks: the middle of the view. With
    // the other two corners it makes the same triangle as a vertex that says so itself.
    rig.pipeline.attributes[0].format = RHW_VERTEX_FLOAT3;
    const float around[2] = {0.5f, 0.75f};
    struct rig_vertex three[3] = {{{around[0], 0, 0, 1}, {5, 6, 7, 8}}, {{0, around[1], 0, 1}, {5, 6, 7, 8}}};
    three[2] = (struct rig_vertex){{0, 0, 0, 1}, {0, 0, 0, 0}};
    rig_draw_once(&rig, three, 3);
    const uint64_t expected = rig_hash(&rig, 0);
    const uint32_t wild[] = {2, 3, 1000, 0x7fffffff, 0xfffffffe};
    for (int i = 0; i < 5; i++) {
        const uint32_t two[3] = {0, 1, wild[i]};
        draw_indices(&rig, RHW_INDEX_UINT32, three, 2, two, 3, 0, 0, 0);
        assert_true(rig_hash(&rig, 0) == expected);
    }
    const uint32_t below[3] = {1, 2, 0};
    draw_indices(&rig, RHW_INDEX_UINT32, three, 2, below, 3, 0, 0, -1);
    assert_true(rig_hash(&rig, 0) == expected);
    rig_close(&rig);
}

// Places triangle vertex_index % 3 by ids alone and shows the ids.
static void ids_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int corner = groups[g].vertex_index % 3, row = groups[g].instance_index;
        const rhw_float y = __builtin_convertvector(row, rhw_float);
        groups[g].position[0] = rhw_select(corner == 1, rhw_splat(3), rhw_splat(-1));
        groups[g].position[1] =
            rhw_select(corner == 2, rhw_splat(1) - y * 0.125f, rhw_splat(0.875f) - y * 0.125f);
        groups[g].position[2] = rhw_splat(0);
        groups[g].position[3] = rhw_splat(1);
        groups[g].varying[0] = __builtin_convertvector(groups[g].vertex_index, rhw_float);
        groups[g].varying[1] = y;
    }
}

static void ids_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].varying[0];
        groups[g].color[0][1] = groups[g].varying[1];
        groups[g].color[0][2] = __builtin_convertvector(groups[g].primitive, rhw_float);
        groups[g].color[0][3] = __builtin_convertvector(groups[g].instance * 100 + groups[g].draw, rhw_float);
    }
}

static void test_ids_count_from_first(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_program(&rig, ids_vertex, ids_fragment);
    rig.pipeline.program.varyings[0] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
    rig.pipeline.program.uses = RHW_USE_IDS;
    rig.pipeline.attributes[0] = (struct rhw_attribute){0};
    rig.pipeline.attribute_count = rig.pipeline.buffer_count = 0;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_draw(rig.context, rig.recording, 30, 6, 2, 3); // instances 2, 3, 4, two triangles each
    const uint8_t indices[6] = {9, 10, 11, 3, 4, 5};
    rig_use_indices(&rig, RHW_INDEX_UINT8, indices, sizeof indices);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 6, 60, 6, 2); // instances 6, 7
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int instance = 0; instance < 8; instance++) {
        // The second triangle of an instance covers the first.
        const float *seen = pixels[(instance * 4 + 3) * SIZE + 0];
        const bool plain = instance >= 2 && instance <= 4, indexed = instance >= 6;
        assert_true(seen[0] == (plain ? 33.0f : indexed ? 63.0f : 0.0f));
        assert_true(seen[1] == (plain || indexed ? (float)instance : 0.0f));
        assert_true(seen[2] == (plain || indexed ? 1.0f : 0.0f));
        assert_true(seen[3] == (plain ? (float)instance * 100 : indexed ? (float)instance * 100 + 1 : 0.0f));
    }
    assert_int_equal(rig.stats.draws, 2);
    assert_int_equal(rig.stats.triangles_in, 10);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_strips_and_fans_are_their_triangles),
    cmocka_unit_test(test_a_strip_faces_one_way),
    cmocka_unit_test(test_incomplete_triangles_are_nothing),
    cmocka_unit_test(test_index_types_offsets_and_base_vertex),
    cmocka_unit_test(test_primitives_count_through_long_draws),
    cmocka_unit_test(test_long_draws_are_their_triangles),
    cmocka_unit_test(test_primitive_restart),
    cmocka_unit_test(test_restart_is_tested_before_the_base_vertex),
    cmocka_unit_test(test_without_restart_the_largest_index_is_an_index),
    cmocka_unit_test(test_reads_outside_the_buffers),
    cmocka_unit_test(test_ids_count_from_first),
};

const struct unit_tests test_topology = UNIT_TESTS(tests, NULL, NULL);
