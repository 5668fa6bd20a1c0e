// SPDX-License-Identifier: MIT
// Images: operands are gathered from registers and given to the sampling functions of librhw.
#ifndef SHADER_KERNEL_IMAGE_H
#define SHADER_KERNEL_IMAGE_H

#include "kernel_memory.h"
#include "rhw/shader_spirv.h"

// The operands of one group.
struct image_request {
    rhw_float at[4];
    rhw_int whole[4]; // bits of `at` as whole numbers
    rhw_float gradient[6];
    rhw_float level, reference, bias;
    rhw_int offset[3];
    struct rhw_sample_request request;
};

static rhw_int image_operand(const struct frame *frame, const struct shader_operand_of *operands, int number,
                             int group)
{
    const struct shader_operand_of operand = operands[number];
    return frame->registers[operand.vector + (operand.is_uniform ? 0u : (uint32_t)group)].i;
}

static rhw_float image_float(const struct frame *frame, const struct shader_operand_of *operands, int number,
                             int group)
{
    return rhw_float_from_bits(image_operand(frame, operands, number, group));
}

// Read the operands that an instruction has.
static void read_image_request(const struct frame *frame, const struct shader_operand_of *operands,
                               uint32_t flags, int group, struct image_request *r)
{
    const int spatial = (int)(flags >> SHADER_IMAGE_SPATIAL_SHIFT & 3);
    const int coordinates = spatial + (flags & SHADER_IMAGE_IS_ARRAYED ? 1 : 0);
    r->request = (struct rhw_sample_request){.coordinates = r->at};
    for (int i = 0; i < coordinates; i++) {
        r->whole[i] = image_operand(frame, operands, SHADER_IMAGE_COORDINATES + i, group);
        r->at[i] = rhw_float_from_bits(r->whole[i]);
    }
    // A texture of more dimensions than the shader knows of is read at 0 of those.
    for (int i = coordinates; i < 4; i++) {
        r->whole[i] = rhw_splat_int(0);
        r->at[i] = rhw_splat(0.0f);
    }
    if (flags & SHADER_IMAGE_HAS_GRADIENT) {
        for (int i = 0; i < spatial; i++) {
            r->gradient[i] = image_float(frame, operands, SHADER_IMAGE_DX + i, group);
            r->gradient[spatial + i] = image_float(frame, operands, SHADER_IMAGE_DY + i, group);
        }
        for (int i = 2 * spatial; i < 6; i++) {
            r->gradient[i] = rhw_splat(0.0f);
        }
        r->request.gradient = r->gradient;
    }
    if (flags & SHADER_IMAGE_HAS_OFFSET) {
        for (int i = 0; i < spatial; i++) {
            r->offset[i] = image_operand(frame, operands, SHADER_IMAGE_OFFSET + i, group);
        }
        for (int i = spatial; i < 3; i++) {
            r->offset[i] = rhw_splat_int(0);
        }
        r->request.offset = r->offset;
    }
    if (flags & SHADER_IMAGE_HAS_LOD) {
        r->level = image_float(frame, operands, SHADER_IMAGE_LOD, group);
        r->request.lod = &r->level;
    }
    if (flags & SHADER_IMAGE_HAS_REFERENCE) {
        r->reference = image_float(frame, operands, SHADER_IMAGE_REFERENCE, group);
        r->request.reference = &r->reference;
    }
    if (flags & SHADER_IMAGE_HAS_BIAS) {
        r->bias = image_float(frame, operands, SHADER_IMAGE_BIAS, group);
        r->request.bias = &r->bias;
    }
}

// The binding that all lanes name, or that of some lanes after the other.
struct image_binding {
    const struct rhw_binding *binding;
    struct rhw_binding pair; // a texture and a sampler of their own are put together here
};

static void find_image(const struct frame *frame, const struct shader_instruction *in, uint32_t texture,
                       uint32_t sampler, struct image_binding *found)
{
    found->binding = binding_of(frame, in->resource, texture);
    if (in->immediate & SHADER_IMAGE_HAS_SAMPLER) {
        const struct rhw_binding *const other = binding_of(frame, in->c.vector, sampler);
        const bool has_both = found->binding && other;
        found->binding =
            has_both && rhw_binding_of_pair(found->binding, other, &found->pair) ? &found->pair : NULL;
    }
}

// Find the binding of an instruction whose lanes all name the same. Return false where each may name its own.
static bool find_one_image(const struct frame *frame, const struct shader_operand_of *operands,
                           const struct shader_instruction *in, struct image_binding *found)
{
    const bool has_sampler = (in->immediate & SHADER_IMAGE_HAS_SAMPLER) != 0;
    if (!operands[SHADER_IMAGE_TEXTURE].is_uniform ||
        (has_sampler && !operands[SHADER_IMAGE_SAMPLER].is_uniform)) {
        return false;
    }
    find_image(frame, in, (uint32_t)image_operand(frame, operands, SHADER_IMAGE_TEXTURE, 0)[0],
               (uint32_t)image_operand(frame, operands, SHADER_IMAGE_SAMPLER, 0)[0], found);
    return true;
}

// Find the binding that lanes name first among `todo`. Return which lanes name it.
static rhw_int find_next_image(const struct frame *frame, const struct shader_operand_of *operands,
                               const struct shader_instruction *in, int group, rhw_int *todo,
                               struct image_binding *found)
{
    rhw_int lanes;
    const uint32_t texture =
        (uint32_t)rhw_binding_next(image_operand(frame, operands, SHADER_IMAGE_TEXTURE, group), todo, &lanes);
    if (!(in->immediate & SHADER_IMAGE_HAS_SAMPLER)) {
        find_image(frame, in, texture, 0, found);
        return lanes;
    }
    // Lanes that name another sampler wait for their turn.
    rhw_int same, rest = lanes;
    const uint32_t sampler =
        (uint32_t)rhw_binding_next(image_operand(frame, operands, SHADER_IMAGE_SAMPLER, group), &rest, &same);
    *todo |= rest;
    find_image(frame, in, texture, sampler, found);
    return same;
}

static void fetch_image(const struct rhw_binding *binding, uint32_t flags, struct image_request *r,
                        rhw_int sample, rhw_float texel[4])
{
    if (flags & SHADER_IMAGE_HAS_SAMPLE) {
        rhw_binding_sample_fetch_sample(binding, r->whole, &sample, texel);
    } else if (flags & SHADER_IMAGE_HAS_LOD) {
        const rhw_int level = rhw_bits_from_float(r->level);
        rhw_binding_sample_fetch(binding, r->whole, &level, texel);
    } else {
        rhw_binding_sample_fetch(binding, r->whole, NULL, texel);
    }
}

static void query_image(const struct rhw_binding *binding, uint32_t flags, struct image_request *r,
                        rhw_float texel[4])
{
    const rhw_int level = flags & SHADER_IMAGE_HAS_LOD ? rhw_bits_from_float(r->level) : rhw_splat_int(0);
    rhw_int size[3] = {rhw_splat_int(0), rhw_splat_int(0), rhw_splat_int(0)};
    switch ((enum shader_image_operation)(flags & 15)) {
    case SHADER_DO_LEVELS: size[0] = rhw_splat_int(rhw_binding_sample_levels(binding)); break;
    case SHADER_DO_SAMPLES: size[0] = rhw_splat_int(rhw_binding_sample_samples(binding)); break;
    case SHADER_DO_IMAGE_SIZE: rhw_binding_image_size(binding, size); break;
    default: rhw_binding_sample_size(binding, flags & SHADER_IMAGE_HAS_LOD ? &level : NULL, size); break;
    }
    for (int i = 0; i < 3; i++) {
        texel[i] = rhw_float_from_bits(size[i]);
    }
    texel[3] = rhw_splat(0.0f);
}

static void access_image(const struct frame *frame, const struct rhw_binding *binding,
                         const struct shader_operand_of *operands, uint32_t flags, int group,
                         rhw_float texel[4])
{
    const int channel = (int)(flags >> SHADER_IMAGE_CHANNEL_SHIFT & 3);
    struct image_request r;
    read_image_request(frame, operands, flags, group, &r);
    if (flags & SHADER_IMAGE_HAS_LEAST_LOD) {
        r.bias = rhw_spirv_raised_bias(binding, &r.request,
                                       image_float(frame, operands, SHADER_IMAGE_LEAST_LOD, group));
        r.request.bias = &r.bias;
    }
    switch ((enum shader_image_operation)(flags & 15)) {
    case SHADER_DO_SAMPLE: rhw_binding_sample(binding, &r.request, texel); return;
    case SHADER_DO_GATHER: rhw_binding_sample_gather(binding, &r.request, channel, texel); return;
    case SHADER_DO_FETCH:
        fetch_image(binding, flags, &r, image_operand(frame, operands, SHADER_IMAGE_SAMPLE, group), texel);
        return;
    case SHADER_DO_LOAD: rhw_binding_image_load(binding, r.whole, texel); return;
    case SHADER_DO_QUERY_LOD: rhw_binding_sample_query_lod(binding, &r.request, texel); return;
    default: query_image(binding, flags, &r, texel); return;
    }
}

// Fetch texels of level 0 of one texture: nothing but coordinates differs from group to group.
static void fetch_groups(struct frame *frame, const struct shader_operand_of *operands,
                         const struct shader_instruction *in, const struct rhw_binding *binding)
{
    enum { MOST = 3 };
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    const union vector nothing = {.i = rhw_splat_int(0)};
    const int coordinates = (int)(in->immediate >> SHADER_IMAGE_SPATIAL_SHIFT & 3) +
                            (in->immediate & SHADER_IMAGE_IS_ARRAYED ? 1 : 0);
    const union vector *from[MOST];
    ptrdiff_t steps[MOST];
    for (int i = 0; i < MOST; i++) {
        const struct shader_operand_of operand = operands[SHADER_IMAGE_COORDINATES + i];
        from[i] = i < coordinates ? &frame->registers[operand.vector] : &nothing;
        steps[i] = i < coordinates && !operand.is_uniform ? 1 : 0;
    }
    const struct rhw_texel_plane plane = rhw_binding_sample_plane(binding);
    for (ptrdiff_t g = frame->range.first; g < frame->range.end && plane.texels; g++) {
        rhw_float *const texel = frame->texels[g];
        texel[0] = rhw_spirv_fetch_first(&plane, from[0][g * steps[0]].i, from[1][g * steps[1]].i);
        texel[1] = texel[2] = rhw_splat(0.0f);
        texel[3] = rhw_splat(1.0f);
    }
    for (ptrdiff_t g = frame->range.first; g < frame->range.end && !plane.texels; g++) {
        if (rhw_any(active[g].i)) {
            const rhw_int at[4] = {from[0][g * steps[0]].i, from[1][g * steps[1]].i, from[2][g * steps[2]].i,
                                   nothing.i};
            rhw_binding_sample_fetch(binding, at, NULL, frame->texels[g]);
        }
    }
}

static void run_SAMPLE(struct frame *frame, const struct shader_instruction *in)
{
    const uint32_t more = SHADER_IMAGE_HAS_SAMPLE | SHADER_IMAGE_HAS_LOD;
    const struct shader_operand_of *const operands = frame->bytecode->image_operands + in->b.vector;
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    struct image_binding found;
    const bool is_one = find_one_image(frame, operands, in, &found);
    if (is_one && (in->immediate & 15) == SHADER_DO_FETCH && (in->immediate & more) == 0) {
        fetch_groups(frame, operands, in, found.binding);
        return;
    }
    for (int i = frame->range.first; i < frame->range.end; i++) {
        rhw_float *const texels = frame->texels[i];
        if (is_one && rhw_any(active[i].i)) {
            access_image(frame, found.binding, operands, in->immediate, i, texels);
            continue;
        }
        for (rhw_int todo = active[i].i; rhw_any(todo);) {
            rhw_float texel[4];
            const rhw_int lanes = find_next_image(frame, operands, in, i, &todo, &found);
            access_image(frame, found.binding, operands, in->immediate, i, texel);
            for (int c = 0; c < 4; c++) {
                texels[c] = rhw_select(lanes, texel[c], texels[c]);
            }
        }
    }
}

static void run_PART(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = frame->range.first; i < frame->range.end; i++) {
        d[i].f = frame->texels[i][in->immediate];
    }
}

static void run_NEEDS_GRADIENT(struct frame *frame, const struct shader_instruction *in)
{
    const rhw_int texture = frame->registers[in->a.vector].i, sampler = frame->registers[in->b.vector].i;
    const bool needs =
        rhw_binding_sample_needs_gradient(binding_of(frame, in->resource, (uint32_t)texture[0]),
                                          binding_of(frame, in->immediate, (uint32_t)sampler[0]));
    frame->registers[in->result.vector].i = rhw_splat_int(needs ? -1 : 0);
}

static void run_IMAGE_STORE(struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_operand_of *const operands = frame->bytecode->image_operands + in->b.vector;
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    struct image_binding found;
    for (int i = 0; i < frame->groups; i++) {
        rhw_int at[4];
        rhw_float texel[4];
        for (int c = 0; c < 4; c++) {
            at[c] = image_operand(frame, operands, SHADER_IMAGE_COORDINATES + c, i);
            texel[c] = image_float(frame, operands, SHADER_IMAGE_TEXEL + c, i);
        }
        for (rhw_int todo = active[i].i; rhw_any(todo);) {
            const rhw_int lanes = find_next_image(frame, operands, in, i, &todo, &found);
            rhw_binding_image_store(found.binding, at, &lanes, texel);
        }
    }
}

static void run_IMAGE_ATOMIC(struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_operand_of *const operands = frame->bytecode->image_operands + in->b.vector;
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        rhw_int v[SHADER_IMAGE_ATOMIC_OPERANDS], result = rhw_splat_int(0);
        for (int o = 0; o < SHADER_IMAGE_ATOMIC_OPERANDS; o++) {
            v[o] = image_operand(frame, operands, o, i);
        }
        for (rhw_int todo = active[i].i, lanes; rhw_any(todo);) {
            const uint32_t named = (uint32_t)rhw_binding_next(v[SHADER_IMAGE_ATOMIC_IMAGE], &todo, &lanes);
            const struct rhw_storage_request request = {.operation = shader_storage_operation(in->immediate),
                                                        .mask = &lanes,
                                                        .index = &v[SHADER_IMAGE_ATOMIC_COORDINATES],
                                                        .value = &v[SHADER_IMAGE_ATOMIC_VALUE],
                                                        .comparand = &v[SHADER_IMAGE_ATOMIC_COMPARAND]};
            rhw_int before;
            rhw_binding_image_atomic(binding_of(frame, in->resource, named), &request, &before);
            result = rhw_select_int(lanes, before, result);
        }
        d[i].i = result;
    }
}

#endif
