// SPDX-License-Identifier: MIT
// See calls.h.
#include "calls.h"

#include <string.h>

#include "form/atomic.h"
#include "rhw/isa.h"
#include "rhw/shader_binding.h"
#include "rhw/shader_spirv.h"

RHW_ISA_DECLARE(shader_call_finder, shader_find_call);

#if defined(__AVX2__)

// Arithmetic -----------------------------------------------------------------------------------------

typedef rhw_float vector_f;
typedef rhw_int vector_i;
#define ONE(name, result, operand, function)               \
    static vector_##result call_##name(vector_##operand a) \
    {                                                      \
        return function(a);                                \
    }
#define TWO(name, result, first, second, function)                          \
    static vector_##result call_##name(vector_##first a, vector_##second b) \
    {                                                                       \
        return function(a, b);                                              \
    }
#include "form/function.inc"
#undef ONE
#undef TWO

// A function of a value in the records of groups, whose result goes there too.
#define OF_GROUPS(name, function)                                                                   \
    static void call_##name##_OF_GROUPS(unsigned char *const *records, uint64_t count, uint64_t to, \
                                        uint64_t from)                                              \
    {                                                                                               \
        for (uint64_t i = 0; i < count; i++) {                                                      \
            *(rhw_float *)(void *)(records[i] + to) =                                               \
                function(*(const rhw_float *)(void *)(records[i] + from));                          \
        }                                                                                           \
    }
OF_GROUPS(EXP, rhw_exp)
OF_GROUPS(LOG, rhw_log)
OF_GROUPS(EXP2, rhw_exp2)
OF_GROUPS(LOG2, rhw_log2)
#undef OF_GROUPS

static rhw_float call_SINE_FIRST(rhw_float *cosine, rhw_float a)
{
    rhw_float sine;
    rhw_sincos(a, &sine, cosine);
    return sine;
}

static rhw_float call_COSINE_FIRST(rhw_float *sine, rhw_float a)
{
    rhw_float cosine;
    rhw_sincos(a, sine, &cosine);
    return cosine;
}

static rhw_int call_BALLOT(rhw_int truth, rhw_int mask)
{
    return rhw_spirv_ballot(truth, mask);
}

static rhw_int call_SHUFFLE(rhw_int value, rhw_int lane, rhw_int mask)
{
    return rhw_spirv_shuffle(value, lane, mask);
}

static rhw_int call_SCAN(uint32_t immediate, rhw_int value, rhw_int mask)
{
    return rhw_spirv_scan((enum rhw_spirv_scan)(immediate & 15),
                          (enum rhw_spirv_reach)(immediate >> SHADER_SCAN_REACH_SHIFT & 3),
                          1 << (immediate >> SHADER_SCAN_CLUSTER_SHIFT & 3), value, mask);
}

// Inputs ---------------------------------------------------------------------------------------------

static rhw_float call_INPUT_BESIDE(const struct rhw_fragment *fragment, int component, int w)
{
    return rhw_spirv_partner(fragment, component, w, 0);
}

static rhw_float call_INPUT_BELOW(const struct rhw_fragment *fragment, int component, int w)
{
    return rhw_spirv_partner(fragment, component, w, 1);
}

static rhw_float call_INPUT_AT(const struct rhw_fragment *fragment, int component, int w, rhw_float x,
                               rhw_float y)
{
    return rhw_spirv_input_at(fragment, component, w, x, y);
}

static rhw_float call_SAMPLE_X(const struct rhw_shader_frame *frame, rhw_int number)
{
    return rhw_spirv_sample_place(frame, number, 0);
}

static rhw_float call_SAMPLE_Y(const struct rhw_shader_frame *frame, rhw_int number)
{
    return rhw_spirv_sample_place(frame, number, 1);
}

// What all lanes name --------------------------------------------------------------------------------

static int32_t call_PUSH_WORD(const struct rhw_shader_frame *frame, uint32_t index)
{
    return rhw_spirv_push_word(frame, index);
}

static rhw_int call_PUSH(const struct rhw_shader_frame *frame, rhw_int index)
{
    return rhw_spirv_push(frame, index);
}

static void take_words(struct shader_found *found)
{
    const struct rhw_spirv_words words = rhw_spirv_words_of(found->binding);
    found->words = words.words;
    found->count = words.count < SHADER_MOST_WORDS ? words.count : SHADER_MOST_WORDS;
}

static void call_FIND_WORDS(const struct rhw_shader_frame *frame, const struct shader_site *site,
                            uint32_t element, struct shader_found *found)
{
    found->binding =
        rhw_spirv_element(frame, site->texture.set, site->texture.first, site->texture.count, element);
    found->words = NULL;
    found->count = 0;
    if (site->flags != 0) {
        take_words(found);
    }
}

static void call_FIND_SHARED(void *shared, uint32_t size, struct shader_found_pair *found)
{
    (void)rhw_binding_of_memory(shared, size, false, &found->memory);
    found->found.binding = &found->memory;
    take_words(&found->found);
}

static void call_FIND_PAIR(const struct shader_found *texture, const struct shader_found *sampler,
                           struct shader_found_pair *pair)
{
    pair->found.binding = rhw_spirv_pair(texture->binding, sampler->binding, &pair->memory);
}

// Bindings -------------------------------------------------------------------------------------------

// The bindings that lanes name, one after the other.
struct named {
    const struct rhw_shader_frame *frame;
    const struct shader_site *site;
    const struct shader_found *one; // the binding of all lanes, or NULL
    rhw_int texture, sampler;       // elements
    rhw_int todo, lanes;
    const struct rhw_binding *binding;
    struct rhw_binding pair;
};

static struct named begin_named(const struct rhw_shader_frame *frame, const struct shader_site *site,
                                const struct shader_found *one, rhw_int texture, rhw_int mask)
{
    return (struct named){.frame = frame, .site = site, .one = one, .texture = texture, .todo = mask};
}

// Find the next binding and the lanes that name it. Return false where all lanes had theirs.
static bool next_binding(struct named *named)
{
    if (!rhw_any(named->todo)) {
        return false;
    }
    if (named->one) {
        named->lanes = named->todo;
        named->todo = rhw_splat_int(0);
        named->binding = named->one->binding;
        return true;
    }
    const struct shader_site *const site = named->site;
    const uint32_t element = (uint32_t)rhw_binding_next(named->texture, &named->todo, &named->lanes);
    named->binding =
        rhw_spirv_element(named->frame, site->texture.set, site->texture.first, site->texture.count, element);
    if (site->sampler.count > 0) {
        rhw_int same = named->lanes, rest = named->lanes;
        const uint32_t other = (uint32_t)rhw_binding_next(named->sampler, &rest, &same);
        named->todo |= rest;
        named->lanes = same;
        named->binding = rhw_spirv_pair(named->binding,
                                        rhw_spirv_element(named->frame, site->sampler.set,
                                                          site->sampler.first, site->sampler.count, other),
                                        &named->pair);
    }
    return true;
}

// What is the same in all lanes is read for all of them, as those that are not active are looked at, too.
static rhw_int lanes_to_read(const struct shader_site *site, rhw_int mask)
{
    return site->flags & SHADER_UNIFORM ? rhw_splat_int(-1) : mask;
}

static rhw_int call_LOAD(const struct rhw_shader_frame *frame, const struct shader_site *site,
                         const struct shader_found *one, rhw_int element, rhw_int index, rhw_int mask)
{
    rhw_int value = rhw_splat_int(0);
    mask = lanes_to_read(site, mask);
    for (struct named n = begin_named(frame, site, one, element, mask); next_binding(&n);) {
        value |= rhw_spirv_load(rhw_spirv_words_of(n.binding), index, n.lanes);
    }
    return value;
}

static rhw_int call_LOAD_WORDS(const struct shader_found *found, rhw_int index, rhw_int mask)
{
    const struct rhw_spirv_words words = {found->words, (uint32_t)found->count};
    return rhw_spirv_load(words, index, mask);
}

static void call_STORE(const struct rhw_shader_frame *frame, const struct shader_site *site,
                       const struct shader_found *one, rhw_int element, rhw_int index, rhw_int value,
                       rhw_int mask)
{
    for (struct named n = begin_named(frame, site, one, element, mask); next_binding(&n);) {
        rhw_binding_storage_store(n.binding, index, value, n.lanes);
    }
}

static void call_STORE8(const struct rhw_shader_frame *frame, const struct shader_site *site,
                        const struct shader_found *one, rhw_int element, rhw_int offset, rhw_int value,
                        rhw_int mask)
{
    for (struct named n = begin_named(frame, site, one, element, mask); next_binding(&n);) {
        rhw_spirv_store_part(n.binding, offset, site->flags, value, (int)site->width, n.lanes);
    }
}

static void call_SHARE(void *shared, uint32_t size, rhw_int index, rhw_int value, rhw_int mask)
{
    rhw_spirv_share(shared, size, index, value, mask);
}

static rhw_int call_LENGTH(const struct rhw_shader_frame *frame, const struct shader_site *site,
                           const struct shader_found *one, rhw_int element, rhw_int mask)
{
    rhw_int bytes = rhw_splat_int(0);
    mask = lanes_to_read(site, mask);
    for (struct named n = begin_named(frame, site, one, element, mask); next_binding(&n);) {
        bytes |= rhw_splat_int(rhw_spirv_bytes(rhw_spirv_words_of(n.binding))) & n.lanes;
    }
    return bytes;
}

static rhw_int call_ATOMIC(const struct rhw_shader_frame *frame, const struct shader_site *site,
                           const struct shader_found *one, rhw_int element, rhw_int index, rhw_int value,
                           rhw_int comparand, rhw_int mask)
{
    rhw_int before = rhw_splat_int(0);
    for (struct named n = begin_named(frame, site, one, element, mask); next_binding(&n);) {
        before |= rhw_spirv_atomic(n.binding, shader_storage_operation(site->flags), index, value, comparand,
                                   n.lanes);
    }
    return before;
}

static rhw_int call_IMAGE_ATOMIC(const struct rhw_shader_frame *frame, const struct shader_site *site,
                                 const struct shader_found *one, rhw_int element, rhw_int x, rhw_int y,
                                 rhw_int z, rhw_int value, rhw_int comparand, rhw_int mask)
{
    const rhw_int at[4] = {x, y, z};
    rhw_int before = rhw_splat_int(0);
    for (struct named n = begin_named(frame, site, one, element, mask); next_binding(&n);) {
        before |= rhw_spirv_image_atomic(n.binding, shader_storage_operation(site->flags), at, value,
                                         comparand, n.lanes);
    }
    return before;
}

// Memory of the lanes --------------------------------------------------------------------------------

static void call_OWN_STORE(rhw_int *own, uint32_t count, rhw_int index, rhw_int value, rhw_int mask)
{
    rhw_spirv_own_store(own, count, index, value, mask);
}

// Images ---------------------------------------------------------------------------------------------

static struct rhw_sample_request request_of(const struct shader_request *r, uint32_t flags)
{
    return (struct rhw_sample_request){
        .coordinates = r->at.f,
        .gradient = flags & SHADER_IMAGE_HAS_GRADIENT ? r->gradient : NULL,
        .lod = flags & SHADER_IMAGE_HAS_LOD ? &r->lod.f : NULL,
        .reference = flags & SHADER_IMAGE_HAS_REFERENCE ? &r->reference : NULL,
        .offset = flags & SHADER_IMAGE_HAS_OFFSET ? r->offset : NULL,
        .bias = flags & SHADER_IMAGE_HAS_BIAS ? &r->bias : NULL,
    };
}

static void sample_one(const struct rhw_binding *binding, uint32_t flags, const struct shader_request *r,
                       rhw_float texel[4])
{
    const int channel = (int)(flags >> SHADER_IMAGE_CHANNEL_SHIFT & 3);
    const rhw_int *const lod = flags & SHADER_IMAGE_HAS_LOD ? &r->lod.i : NULL;
    const struct rhw_sample_request request = request_of(r, flags);
    switch ((enum shader_image_operation)(flags & 15)) {
    case SHADER_DO_SAMPLE:
        if (flags & SHADER_IMAGE_HAS_LEAST_LOD) {
            rhw_spirv_sample_above(binding, &request, r->least, texel);
        } else {
            rhw_binding_sample(binding, &request, texel);
        }
        return;
    case SHADER_DO_GATHER: rhw_binding_sample_gather(binding, &request, channel, texel); return;
    case SHADER_DO_QUERY_LOD: rhw_binding_sample_query_lod(binding, &request, texel); return;
    case SHADER_DO_FETCH:
        if (flags & SHADER_IMAGE_HAS_SAMPLE) {
            rhw_binding_sample_fetch_sample(binding, r->at.i, &r->sample, texel);
        } else {
            rhw_binding_sample_fetch(binding, r->at.i, lod, texel);
        }
        return;
    case SHADER_DO_LOAD: rhw_binding_image_load(binding, r->at.i, texel); return;
    case SHADER_DO_SIZE: rhw_spirv_size(binding, lod, texel); return;
    case SHADER_DO_IMAGE_SIZE: rhw_spirv_image_size(binding, texel); return;
    case SHADER_DO_LEVELS: texel[0] = rhw_spirv_count(rhw_binding_sample_levels(binding)); return;
    case SHADER_DO_SAMPLES: texel[0] = rhw_spirv_count(rhw_binding_sample_samples(binding)); return;
    }
}

static void call_SAMPLE(const struct rhw_shader_frame *frame, const struct shader_site *site,
                        const struct shader_found *one, struct shader_request *r, rhw_float texel[4])
{
    if (one) {
        sample_one(one->binding, site->flags, r, texel);
        return;
    }
    rhw_float some[4] = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f)};
    for (int c = 0; c < 4; c++) {
        texel[c] = rhw_splat(0.0f);
    }
    struct named n = begin_named(frame, site, one, r->texture, r->mask);
    n.sampler = r->sampler;
    while (next_binding(&n)) {
        sample_one(n.binding, site->flags, r, some);
        rhw_spirv_take(n.lanes, some, texel);
    }
}

static int32_t call_NEEDS_GRADIENT(const struct shader_found *texture, const struct shader_found *sampler)
{
    return -rhw_binding_sample_needs_gradient(texture->binding, sampler->binding);
}

static void call_COMPARE_WINDOW(const struct shader_found *one, const struct shader_request *r,
                                uint32_t flags, uint32_t columns, uint32_t rows, rhw_float *parts)
{
    const struct rhw_sample_request request = request_of(r, flags);
    rhw_binding_sample_compare_window(one->binding, &request, (int)columns, (int)rows, parts);
}

static void call_FIND_PLANE(const struct shader_found *texture, struct shader_found_plane *found)
{
    found->binding = texture->binding;
    found->plane = rhw_binding_sample_plane(texture->binding);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        found->last[0][lane] = (uint32_t)(found->plane.width - 1);
        found->last[1][lane] = (uint32_t)(found->plane.height - 1);
        found->row_length[lane] = (uint32_t)found->plane.pitch;
    }
}

// Return the first component of texels that lie in no plane.
static rhw_float call_FETCH_PLANE(const struct shader_found_plane *found, rhw_int x, rhw_int y)
{
    const rhw_int at[4] = {x, y, rhw_splat_int(0), rhw_splat_int(0)};
    rhw_float texel[4];
    rhw_binding_sample_fetch(found->binding, at, NULL, texel);
    return texel[0];
}

// Put what all lanes name into a table.
static void call_LIST(const struct shader_found *found, struct rhw_binding *entry)
{
    rhw_spirv_list(found->binding, entry);
}

// Sample the bindings of a table whose bits `which` has, at two varyings of each group. Texels begin each record.
static void call_SAMPLE_GROUPS(const struct shader_together *together, const struct rhw_binding *table,
                               uint32_t which, uint32_t at)
{
    rhw_float(*const texels)[4] = together->records;
    rhw_spirv_sample_groups(table, together->groups, (int)together->here, which, (int)at, texels,
                            (int)(together->record_size / sizeof *texels));
}

static void call_IMAGE_STORE(const struct rhw_shader_frame *frame, const struct shader_site *site,
                             const struct shader_found *one, struct shader_request *r)
{
    for (struct named n = begin_named(frame, site, one, r->texture, r->mask); next_binding(&n);) {
        rhw_binding_image_store(n.binding, r->at.i, &n.lanes, r->texel);
    }
}

// Loops ----------------------------------------------------------------------------------------------

static int call_GIVEN_UP(const struct rhw_bindings *bindings)
{
    return rhw_work_is_given_up(bindings);
}

#define ENTRY(name)                                [SHADER_##name] = (shader_call_function *)call_##name
#define MORE(name)                                 [SHADER_CALL_##name] = (shader_call_function *)call_##name
#define ONE(name, result, operand, function)       ENTRY(name),
#define TWO(name, result, first, second, function) ENTRY(name),
static shader_call_function *const functions[SHADER_CALLS] = {
#include "form/function.inc"
    ENTRY(BALLOT),
    ENTRY(SHUFFLE),
    ENTRY(SCAN),
    ENTRY(INPUT_BESIDE),
    ENTRY(INPUT_BELOW),
    ENTRY(INPUT_AT),
    ENTRY(SAMPLE_X),
    ENTRY(SAMPLE_Y),
    ENTRY(LOAD),
    ENTRY(STORE),
    ENTRY(STORE8),
    [SHADER_STORE16] = (shader_call_function *)call_STORE8,
    ENTRY(LENGTH),
    ENTRY(ATOMIC),
    ENTRY(IMAGE_ATOMIC),
    ENTRY(SAMPLE),
    ENTRY(NEEDS_GRADIENT),
    ENTRY(IMAGE_STORE),
    MORE(PUSH_WORD),
    MORE(PUSH),
    MORE(SINE_FIRST),
    MORE(COSINE_FIRST),
    MORE(FIND_WORDS),
    MORE(FIND_SHARED),
    MORE(FIND_PAIR),
    MORE(COMPARE_WINDOW),
    MORE(FIND_PLANE),
    MORE(FETCH_PLANE),
    MORE(LIST),
    MORE(SAMPLE_GROUPS),
    MORE(LOAD_WORDS),
    MORE(SHARE),
    MORE(OWN_STORE),
    MORE(GIVEN_UP),
    MORE(EXP_OF_GROUPS),
    MORE(LOG_OF_GROUPS),
    MORE(EXP2_OF_GROUPS),
    MORE(LOG2_OF_GROUPS),
};
#undef ENTRY
#undef MORE
#undef ONE
#undef TWO

shader_call_function *RHW_ISA_NAME(shader_find_call)(unsigned which)
{
    return which < SHADER_CALLS ? functions[which] : NULL;
}

#else

shader_call_function *RHW_ISA_NAME(shader_find_call)(unsigned which)
{
    (void)which;
    return NULL;
}

#endif
