// SPDX-License-Identifier: MIT
// Bindings in memory of the program give what slots give; what is no binding of a kind does nothing.
#include "binding/binding.h"
#include "bound_things.h"
#include "context/context.h"
#include "format/format.h"
#include "rhw/shader_spirv.h"

// Sampling ---------------------------------------------------------------------------------------------

enum { SLOT = 2, COLUMNS = 3, ROWS = 2 };

// All that the functions on 8 lanes give, and those one at a time.
struct answers {
    rhw_float sample[4], gather[4], fetch[4], fetch_sample[4], lod[2], window[COLUMNS * ROWS];
    rhw_int size[3];
    float sample1[4], gather1[4], fetch1[4], fetch_sample1[4], lod1[2], window1[COLUMNS * ROWS];
    int32_t size1[3];
    int levels, samples;
};

struct question {
    rhw_float coordinates[4], gradient[6], bias, reference;
    rhw_int offset[3], at[3], level;
    struct rhw_sample_request request;
    struct rhw_sample_request1 request1;
    float coordinates1[4], gradient1[6], bias1, reference1;
    int32_t offset1[3], at1[3];
};

static void ask(struct question *q, uint64_t *random, bool shifts, bool biases, bool compares)
{
    memset(q, 0, sizeof *q);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        for (int i = 0; i < 4; i++) {
            q->coordinates[i][lane] = rig_random_float(random, -1, 2);
        }
        for (int i = 0; i < 6; i++) {
            q->gradient[i][lane] = rig_random_float(random, 0.01f, 0.3f);
        }
        for (int i = 0; i < 3; i++) {
            q->offset[i][lane] = rig_random_int(random, 7) - 3;
            q->at[i][lane] = rig_random_int(random, 12) - 2;
        }
        q->level[lane] = rig_random_int(random, 3);
        q->bias[lane] = rig_random_float(random, -1, 1);
        q->reference[lane] = rig_random_float(random, 0, 0.2f);
    }
    for (int i = 0; i < 4; i++) {
        q->coordinates1[i] = q->coordinates[i][3];
    }
    for (int i = 0; i < 6; i++) {
        q->gradient1[i] = q->gradient[i][3];
    }
    for (int i = 0; i < 3; i++) {
        q->offset1[i] = q->offset[i][3];
        q->at1[i] = q->at[i][3];
    }
    q->bias1 = q->bias[3];
    q->reference1 = q->reference[3];
    q->request = (struct rhw_sample_request){.coordinates = q->coordinates, .gradient = q->gradient};
    q->request1 = (struct rhw_sample_request1){.coordinates = q->coordinates1, .gradient = q->gradient1};
    if (shifts) {
        q->request.offset = q->offset;
        q->request1.offset = q->offset1;
    }
    if (biases) {
        q->request.bias = &q->bias;
        q->request1.bias = &q->bias1;
    }
    if (compares) {
        q->request.reference = &q->reference;
        q->request1.reference = &q->reference1;
    }
}

static void answer_by_slot(const struct rhw_bindings *b, const struct question *q, struct answers *a)
{
    memset(a, 0, sizeof *a);
    rhw_sample(b, SLOT, &q->request, a->sample);
    rhw_sample_gather(b, SLOT, &q->request, 1, a->gather);
    rhw_sample_fetch(b, SLOT, q->at, &q->level, a->fetch);
    rhw_sample_fetch_sample(b, SLOT, q->at, &q->level, a->fetch_sample);
    rhw_sample_query_lod(b, SLOT, &q->request, a->lod);
    rhw_sample_compare_window(b, SLOT, &q->request, COLUMNS, ROWS, a->window);
    rhw_sample_size(b, SLOT, &q->level, a->size);
    rhw_sample1(b, SLOT, &q->request1, a->sample1);
    rhw_sample_gather1(b, SLOT, &q->request1, 1, a->gather1);
    rhw_sample_fetch1(b, SLOT, q->at1, 1, a->fetch1);
    rhw_sample_fetch_sample1(b, SLOT, q->at1, 1, a->fetch_sample1);
    rhw_sample_query_lod1(b, SLOT, &q->request1, a->lod1);
    rhw_sample_compare_window1(b, SLOT, &q->request1, COLUMNS, ROWS, a->window1);
    rhw_sample_size1(b, SLOT, 1, a->size1);
    a->levels = rhw_sample_levels(b, SLOT);
    a->samples = rhw_sample_samples(b, SLOT);
}

static void answer_by_binding(const struct rhw_binding *b, const struct question *q, struct answers *a)
{
    memset(a, 0, sizeof *a);
    rhw_binding_sample(b, &q->request, a->sample);
    rhw_binding_sample_gather(b, &q->request, 1, a->gather);
    rhw_binding_sample_fetch(b, q->at, &q->level, a->fetch);
    rhw_binding_sample_fetch_sample(b, q->at, &q->level, a->fetch_sample);
    rhw_binding_sample_query_lod(b, &q->request, a->lod);
    rhw_binding_sample_compare_window(b, &q->request, COLUMNS, ROWS, a->window);
    rhw_binding_sample_size(b, &q->level, a->size);
    rhw_binding_sample1(b, &q->request1, a->sample1);
    rhw_binding_sample_gather1(b, &q->request1, 1, a->gather1);
    rhw_binding_sample_fetch1(b, q->at1, 1, a->fetch1);
    rhw_binding_sample_fetch_sample1(b, q->at1, 1, a->fetch_sample1);
    rhw_binding_sample_query_lod1(b, &q->request1, a->lod1);
    rhw_binding_sample_compare_window1(b, &q->request1, COLUMNS, ROWS, a->window1);
    rhw_binding_sample_size1(b, 1, a->size1);
    a->levels = rhw_binding_sample_levels(b);
    a->samples = rhw_binding_sample_samples(b);
}

// Where a sampler says that it needs no gradient, it gives the same bits with every level.
static void expect_no_need(const struct rhw_binding *texture, const struct rhw_binding *by,
                           const struct rhw_binding *pair, const struct question *q)
{
    const rhw_float levels[] = {rhw_splat(0.0f), rhw_splat(1.5f), rhw_splat(-80.0f), rhw_nan()};
    assert_int_equal(rhw_binding_sample_needs_gradient(pair, pair),
                     rhw_binding_sample_needs_gradient(texture, by));
    for (int i = 0; i < 4 && !rhw_binding_sample_needs_gradient(texture, by); i++) {
        const rhw_float gradient[6] = {levels[i], levels[i], levels[i], levels[i], levels[i], levels[i]};
        struct rhw_sample_request request = q->request;
        rhw_float expected[4], found[4];
        rhw_binding_sample(pair, &q->request, expected);
        request.gradient = i % 2 == 0 ? gradient : NULL;
        request.lod = &levels[i];
        rhw_binding_sample(pair, &request, found);
        assert_memory_equal(found, expected, sizeof found);
    }
}

static void expect_as_slot(const struct rig *rig, rhw_texture texture, rhw_sampler sampler, bool compares)
{
    static struct rhw_bindings bindings;
    struct rhw_binding binding, alone, by, pair;
    uint64_t random = 7;
    assert_int_equal(rhw_binding_of_texture(rig->context, texture, sampler, &binding), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig->context, texture, (rhw_sampler){0}, &alone), RHW_OK);
    assert_int_equal(rhw_binding_of_sampler(rig->context, sampler, &by), RHW_OK);
    assert_true(rhw_binding_of_pair(&alone, &by, &pair));
    rhw_bindings_init(&bindings, rig->context->kernels);
    bindings.slot[SLOT] = rhw_binding_of(rig->context->kernels, rig->context->paths,
                                         rhw_context_texture(rig->context, texture, "test"),
                                         rhw_context_sampler(rig->context, sampler, "test"));
    for (int way = 0; way < 8; way++) {
        struct question q;
        struct answers expected, found;
        ask(&q, &random, way & 1, way & 2, compares && way & 4);
        answer_by_slot(&bindings, &q, &expected);
        answer_by_binding(&binding, &q, &found);
        assert_memory_equal(&found, &expected, sizeof found);
        answer_by_binding(&pair, &q, &found);
        assert_memory_equal(&found, &expected, sizeof found);
        answer_by_binding(&alone, &q, &found); // fetches and sizes need no sampler
        assert_memory_equal(found.fetch, expected.fetch, sizeof found.fetch);
        assert_memory_equal(found.fetch_sample, expected.fetch_sample, sizeof found.fetch_sample);
        assert_memory_equal(found.size, expected.size, sizeof found.size);
        assert_int_equal(found.levels, expected.levels);
        expect_no_need(&alone, &by, &pair, &q);
    }
}

static void expect_2d(const struct rig *rig, rhw_texture texture, rhw_sampler sampler, bool expected)
{
    struct rhw_binding bound, alone;
    assert_int_equal(rhw_binding_of_texture(rig->context, texture, sampler, &bound), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig->context, texture, (rhw_sampler){0}, &alone), RHW_OK);
    assert_true(rhw_binding_sample_is_2d(&bound) == expected);
    assert_false(rhw_binding_sample_is_2d(&alone)); // it has no sampler
    assert_false(rhw_binding_sample_is_2d(NULL));
}

// A plane has what a fetch gives, which is nothing outside of the texels.
static void expect_plane(const struct rig *rig, rhw_texture texture, bool is_plane)
{
    struct rhw_binding bound;
    assert_int_equal(rhw_binding_of_texture(rig->context, texture, (rhw_sampler){0}, &bound), RHW_OK);
    const struct rhw_texel_plane plane = rhw_binding_sample_plane(&bound);
    assert_true((plane.texels != NULL) == is_plane);
    for (int y = 0; y < plane.height; y++) {
        const rhw_int at[4] = {rhw_lane_numbers(), rhw_splat_int(y)};
        rhw_float texel[4];
        rhw_binding_sample_fetch(&bound, at, NULL, texel);
        for (int x = 0; x < plane.width && x < RHW_LANES; x++) {
            const float fetched = texel[0][x];
            assert_memory_equal(&fetched, &plane.texels[y * plane.pitch + x], sizeof fetched);
        }
    }
    const int wrapped =
        is_plane ? (int)(((uint64_t)1 << 32) / (uint64_t)plane.pitch) : 0; // rows in 32 bits of texels
    const int rows[] = {0,       plane.height - 1, -1,       plane.height, plane.height + 1,
                        wrapped, INT32_MIN,        INT32_MAX};
    for (size_t i = 0; i < sizeof rows / sizeof *rows && is_plane; i++) {
        const rhw_int columns = {0,           plane.width - 1, -1,
                                 plane.width, plane.pitch,     plane.width - 1 - plane.pitch,
                                 INT32_MIN,   INT32_MAX};
        const rhw_int at[4] = {columns, rhw_splat_int(rows[i])};
        rhw_float texel[4];
        rhw_binding_sample_fetch(&bound, at, NULL, texel);
        const rhw_float fetched = rhw_spirv_fetch_first(&plane, at[0], at[1]);
        assert_memory_equal(&fetched, &texel[0], sizeof fetched);
    }
}

static void gradients_are_needed(void **state)
{
    (void)state;
    static const struct {
        int levels;
        bool needs;
        struct rhw_sampler_def sampler;
    } cases[] = {{1, false, {.lod_bias = 0.25f}},
                 {2, true, {.lod_bias = 0.25f}},
                 {2, false, {.mip_filter = RHW_MIP_FILTER_NONE}},
                 {1, true, {.min_filter = RHW_FILTER_NEAREST}},
                 {1, true, {.max_anisotropy = 2}}};
    struct rig rig;
    rig_open(&rig, 16, 16);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct rhw_texture_def def = {
            .format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 4, .mip_levels = cases[i].levels};
        const rhw_texture texture = make_texture(&rig, &def);
        const rhw_sampler sampler = make_sampler(&rig, &cases[i].sampler);
        struct rhw_binding bound, alone;
        assert_int_equal(rhw_binding_of_texture(rig.context, texture, sampler, &bound), RHW_OK);
        assert_int_equal(rhw_binding_of_texture(rig.context, texture, (rhw_sampler){0}, &alone), RHW_OK);
        assert_int_equal(rhw_binding_sample_needs_gradient(&bound, &bound), cases[i].needs);
        assert_int_equal(rhw_binding_sample_needs_gradient(&alone, &bound), cases[i].needs);
        assert_false(rhw_binding_sample_needs_gradient(&alone, &alone)); // it has no sampler
        assert_false(rhw_binding_sample_needs_gradient(NULL, &bound));
        assert_false(rhw_binding_sample_needs_gradient(&alone, NULL));
        rhw_sampler_destroy(rig.context, sampler);
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void sampled_as_slots(void **state)
{
    (void)state;
    static const struct rhw_texture_def textures[] = {
        {.format = RHW_FORMAT_RGBA8_UNORM, .width = 9, .height = 6, .mip_levels = RHW_MIP_LEVELS_ALL},
        {.format = RHW_FORMAT_RGBA8_SRGB, .width = 9, .height = 6, .mip_levels = RHW_MIP_LEVELS_ALL},
        {.format = RHW_FORMAT_RGBA16_FLOAT, .width = 8, .height = 8, .mip_levels = 3},
        {.format = RHW_FORMAT_R32_FLOAT, .width = 8, .height = 8},
        {.format = RHW_FORMAT_D32_FLOAT, .width = 8, .height = 8},
        {.format = RHW_FORMAT_RGBA8_SRGB, .width = 7, .height = 7, .layers = 3, .mip_levels = 2},
        {.format = RHW_FORMAT_R8_UNORM, .kind = RHW_TEXTURE_CUBE, .width = 5, .height = 5},
        {.format = RHW_FORMAT_RG8_UNORM, .kind = RHW_TEXTURE_3D, .width = 5, .height = 4, .depth = 3},
        {.format = RHW_FORMAT_RGBA8_UNORM, .width = 6, .height = 6, .samples = 4},
        {.format = RHW_FORMAT_R32_FLOAT, .width = 9, .height = 5, .mip_levels = 2},
        {.format = RHW_FORMAT_RGBA8_UNORM, .kind = RHW_TEXTURE_1D, .width = 9, .layers = 4},
    };
    static const struct rhw_sampler_def samplers[] = {
        {.lod_bias = 0.25f},
        {.address_u = RHW_ADDRESS_CLAMP, .address_v = RHW_ADDRESS_BORDER, .max_anisotropy = 8},
        {.max_anisotropy = 4},
        {.compares = true, .compare = RHW_COMPARE_LESS_EQUAL, .mip_filter = RHW_MIP_FILTER_NONE},
        {.reduction = RHW_REDUCTION_MAX}};
    struct rig rig;
    rig_open(&rig, 16, 16);
    for (size_t t = 0; t < sizeof textures / sizeof *textures; t++) {
        const rhw_texture texture = make_texture(&rig, &textures[t]);
        rhw_texture read = texture, view = {0};
        if (textures[t].samples == 0 && textures[t].format != RHW_FORMAT_D32_FLOAT) {
            const struct rhw_texture_view_def def = {.texture = texture,
                                                     .kind = textures[t].kind,
                                                     .layers = textures[t].layers,
                                                     .swizzle = {RHW_SWIZZLE_BLUE, RHW_SWIZZLE_ONE}};
            write_noise(&rig, texture, t);
            assert_int_equal(rhw_texture_view_create(rig.context, &def, &view), RHW_OK);
            read = t % 3 == 0 ? view : texture;
        }
        for (size_t s = 0; s < sizeof samplers / sizeof *samplers; s++) {
            const rhw_sampler sampler = make_sampler(&rig, &samplers[s]);
            expect_as_slot(&rig, read, sampler, samplers[s].compares);
            expect_2d(&rig, read, sampler,
                      t < 5 || t == 9); // the others have layers, samples or another kind
            rhw_sampler_destroy(rig.context, sampler);
        }
        const bool is_plane =
            textures[t].format == RHW_FORMAT_R32_FLOAT || textures[t].format == RHW_FORMAT_D32_FLOAT;
        expect_plane(&rig, texture, is_plane);
        if (memcmp(&read, &view, sizeof view) == 0) {
            expect_plane(&rig, view, false); // it has another order of channels
        }
        rhw_texture_destroy(rig.context, texture);
        rhw_texture_destroy(rig.context, view);
    }
    rig_close(&rig);
}

// Words and texels --------------------------------------------------------------------------------------

static void words_of_memory(void **state)
{
    (void)state;
    uint32_t memory[16];
    struct rhw_binding binding, read;
    memset(memory, 0x55, sizeof memory);
    assert_true(rhw_binding_of_memory(memory + 1, 4 * 5 + 3, false, &binding)); // three bytes are no word
    assert_true(rhw_binding_of_memory(memory + 1, 4 * 5, true, &read));
    assert_int_equal(rhw_binding_storage_count(&binding), 5);
    const rhw_int all = rhw_splat_int(-1), index = rhw_lane_numbers() - 1; // −1 .. 6
    rhw_binding_storage_store(&binding, index, rhw_lane_numbers() + 100, all);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(memory[i], i >= 1 && i < 6 ? (uint32_t)(100 + i) : 0x55555555);
    }
    rhw_binding_storage_store(&read, index, rhw_splat_int(9), all);
    rhw_binding_storage_store1(&read, 1, 9);
    const rhw_int loaded = rhw_binding_storage_load(&read, index, all);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        assert_int_equal(loaded[lane], lane >= 1 && lane < 6 ? 100 + lane : 0);
    }
    const rhw_int odd = rhw_equal_int(rhw_lane_numbers() & 1, rhw_splat_int(1));
    (void)rhw_binding_storage_atomic(&binding, RHW_STORAGE_ADD, rhw_splat_int(4), rhw_splat_int(10), odd);
    assert_int_equal(rhw_binding_storage_load1(&binding, 4), 105 + 40);
    assert_int_equal(rhw_binding_storage_atomic1(&binding, RHW_STORAGE_MAX, 4, 1000), 145);
    assert_int_equal(rhw_binding_storage_compare_exchange1(&binding, 4, 1000, 5), 1000);
    assert_int_equal(memory[5], 5);
    assert_int_equal(rhw_binding_storage_load1(&binding, 5), 0);
    assert_int_equal(rhw_binding_storage_atomic1(&binding, RHW_STORAGE_ADD, UINT32_MAX, 1), 0);
    assert_true(rhw_binding_of_memory(NULL, 0, false, &binding));
    assert_int_equal(rhw_binding_storage_count(&binding), 0);
    assert_int_equal(rhw_binding_storage_load1(&binding, 0), 0);
    assert_false(rhw_binding_of_memory(NULL, 4, false, &binding));
    assert_false(rhw_binding_of_memory((unsigned char *)memory + 2, 4, false, &binding));
    assert_int_equal(rhw_binding_storage_count(&binding), 0);
}

// Write texels 0 .. 7 of a row at −1 .. 6, and expect what was written to the texels that there are.
static void check_row(enum rhw_isa isa, enum rhw_format format, size_t texel, int texels)
{
    _Alignas(16) unsigned char bytes[16 * 10 + 4], before[16 * 10];
    unsigned char *const memory = bytes + (texel > 4 ? 4 : 0); // aligned to words alone
    struct rhw_binding binding, read;
    memset(memory, 0x11, sizeof before);
    memcpy(before, memory, sizeof before);
    const size_t size = texel * (size_t)texels + (texel > 1 ? texel - 1 : 0); // the rest is no texel
    assert_true(rhw_binding_of_texel_memory(isa, memory + texel, size, format, false, &binding));
    assert_true(rhw_binding_of_texel_memory(isa, memory + texel, size, format, true, &read));
    rhw_int at[3] = {rhw_lane_numbers() - 1}, extent[3];
    const rhw_float value[4] = {rhw_splat(1), rhw_splat(0), rhw_splat(1), rhw_splat(1)};
    rhw_float got[4];
    rhw_binding_image_store(&read, at, NULL, value);
    assert_memory_equal(memory, before, sizeof before);
    rhw_binding_image_store(&binding, at, NULL, value);
    rhw_binding_image_load(&binding, at, got);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const int x = lane - 1;
        const float expected = x >= 0 && x < texels ? 1.0f : 0.0f;
        assert_true(got[0][lane] == expected);
        float one[4];
        rhw_binding_image_load1(&binding, &x, one);
        assert_true(one[0] == got[0][lane] && one[3] == got[3][lane]);
    }
    memset(memory + texel, 0x11, texel * (size_t)texels);
    assert_memory_equal(memory, before, sizeof before);
    rhw_binding_image_size(&binding, extent);
    assert_int_equal(extent[0][0], texels);
    assert_int_equal(extent[1][0], texels > 0);
}

static void texels_of_memory(void **state)
{
    (void)state;
    static const struct {
        enum rhw_format format;
        size_t texel;
    } formats[] = {{RHW_FORMAT_R8_UNORM, 1},
                   {RHW_FORMAT_RG8_UNORM, 2},
                   {RHW_FORMAT_RGBA8_UNORM, 4},
                   {RHW_FORMAT_RGBA16_FLOAT, 8},
                   {RHW_FORMAT_RGBA32_FLOAT, 16}};
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        for (size_t f = 0; f < sizeof formats / sizeof *formats && rhw_isa_supported((enum rhw_isa)isa);
             f++) {
            check_row((enum rhw_isa)isa, formats[f].format, formats[f].texel, 5);
            check_row((enum rhw_isa)isa, formats[f].format, formats[f].texel, 1);
            check_row((enum rhw_isa)isa, formats[f].format, formats[f].texel, 0);
        }
    }
    uint32_t words[4] = {1, 2, 3, 4};
    struct rhw_binding b;
    const enum rhw_isa isa = RHW_ISA_BASELINE;
    assert_true(rhw_binding_of_texel_memory(isa, words, sizeof words, RHW_FORMAT_R32_UINT, false, &b));
    const int32_t third = 2, outside = 4;
    assert_int_equal(rhw_binding_image_atomic1(&b, RHW_STORAGE_ADD, &third, 5, 0), 3);
    assert_int_equal(rhw_binding_image_atomic1(&b, RHW_STORAGE_ADD, &outside, 5, 0), 0);
    assert_int_equal(words[2], 8);
    assert_false(rhw_binding_of_texel_memory(isa, words, 16, RHW_FORMAT_D16_UNORM, false, &b));
    assert_false(rhw_binding_of_texel_memory(isa, words, 16, RHW_FORMAT_BC1_RGB_UNORM, false, &b));
    assert_false(rhw_binding_of_texel_memory(isa, words, 16, RHW_FORMAT_NONE, false, &b));
    assert_false(rhw_binding_of_texel_memory(isa, words, 16, (enum rhw_format)RHW_FORMAT_COUNT, false, &b));
    assert_false(rhw_binding_of_texel_memory(isa, NULL, 16, RHW_FORMAT_R32_UINT, false, &b));
    unsigned char *const odd = (unsigned char *)words + 1;
    assert_false(rhw_binding_of_texel_memory(isa, odd, 8, RHW_FORMAT_RG8_UNORM, false, &b));
    assert_true(rhw_binding_of_texel_memory(isa, odd, 8, RHW_FORMAT_R8_UNORM, false, &b));
    assert_false(
        rhw_binding_of_texel_memory((enum rhw_isa)RHW_ISA_COUNT, words, 16, RHW_FORMAT_R32_UINT, false, &b));
}

// What is of another kind, or of none, gives what a slot gives that has nothing.
static void other_kinds_do_nothing(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    static struct rhw_bindings none;
    rhw_bindings_init(&none, rig.context->kernels);
    uint32_t word = 77;
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    const rhw_sampler sampler = make_sampler(&rig, &sampler_def);
    struct rhw_binding kinds[5] = {{{0}}};
    assert_true(rhw_binding_of_memory(&word, sizeof word, false, &kinds[1]));
    assert_true(
        rhw_binding_of_texel_memory(RHW_ISA_BASELINE, &word, 4, RHW_FORMAT_R32_UINT, false, &kinds[2]));
    assert_int_equal(rhw_binding_of_sampler(rig.context, sampler, &kinds[3]), RHW_OK);
    struct question q;
    struct answers expected, found;
    uint64_t random = 3;
    ask(&q, &random, true, true, false);
    answer_by_slot(&none, &q, &expected);
    const int32_t at[3] = {0, 0, 0};
    for (int k = 0; k < 5; k++) {
        const struct rhw_binding *const binding = k < 4 ? &kinds[k] : NULL;
        answer_by_binding(binding, &q, &found);
        assert_memory_equal(&found, &expected, sizeof found);
        if (k != 1) {
            assert_int_equal(rhw_binding_storage_count(binding), 0);
            assert_int_equal(rhw_binding_storage_atomic1(binding, RHW_STORAGE_ADD, 0, 1), 0);
        }
        if (k != 2) {
            const rhw_int lanes[3] = {rhw_splat_int(0)};
            rhw_float texel[4];
            rhw_int size[3];
            rhw_binding_image_store(binding, lanes, NULL, texel);
            rhw_binding_image_load(binding, lanes, texel);
            rhw_binding_image_size(binding, size);
            assert_true(texel[0][0] == 0 && texel[3][0] == 1 && size[0][0] == 0 && size[1][0] == 0);
            assert_int_equal(rhw_binding_image_atomic1(binding, RHW_STORAGE_ADD, at, 1, 0), 0);
        }
        struct rhw_binding pair;
        assert_false(rhw_binding_of_pair(binding, &kinds[3], &pair));
        assert_false(rhw_binding_of_pair(&kinds[3], binding, &pair));
    }
    assert_int_equal(word, 77);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(sampled_as_slots), cmocka_unit_test(gradients_are_needed),
    cmocka_unit_test(words_of_memory), cmocka_unit_test(texels_of_memory),
    cmocka_unit_test(other_kinds_do_nothing)};

const struct unit_tests test_binding = UNIT_TESTS(tests, NULL, NULL);
