// SPDX-License-Identifier: MIT
// Images and samplers. A sampled image is the place of an image and that of a sampler.
#include "build.h"

#include <string.h>

// One instruction as its operands are collected.
struct image_access {
    uint32_t values[SHADER_IMAGE_OPERANDS];
    uint32_t flags;
    const struct shader_type *image;
    uint32_t spatial;     // coordinates without the layer
    uint32_t coordinates; // all that are taken
    uint32_t offsets;     // id: four offsets of a gather, or 0
};

static const struct shader_type *image_type_of(const struct shader_builder *builder,
                                               const struct shader_type *type)
{
    const struct shader_type *const image = type->kind == SHADER_SAMPLED_IMAGE ? type->element : type;
    if (image->kind != SHADER_IMAGE) {
        shader_build_refuse(builder, "the operand is no image");
    }
    return image;
}

static uint32_t spatial_of(const struct shader_builder *builder, const struct shader_type *image)
{
    switch (image->image.dim) {
    case SPIRV_DIM_1D:
    case SPIRV_DIM_BUFFER: return 1;
    case SPIRV_DIM_2D:
    case SPIRV_DIM_RECT:
    case SPIRV_DIM_SUBPASS: return 2;
    case SPIRV_DIM_3D:
    case SPIRV_DIM_CUBE: return 3;
    default: shader_build_refuse(builder, "images of this dimension are not supported");
    }
}

// Whole coordinates of a cube have a face, which is the layer in an array of cubes.
static bool is_whole(enum shader_image_operation does)
{
    return does == SHADER_DO_FETCH || does == SHADER_DO_LOAD;
}

static struct image_access begin_access(struct shader_builder *builder, uint32_t operand,
                                        enum shader_image_operation does)
{
    const uint32_t id = shader_operand(builder, operand);
    const struct shader_place *const place = shader_place_of(builder, id);
    struct image_access access = {.flags = (uint32_t)does};
    if (place->kind != SHADER_PLACE_RESOURCE || place->is_array_of_resources) {
        shader_build_refuse(builder, "id %u is no image", (unsigned)id);
    }
    memset(access.values, 0, sizeof access.values);
    access.image = image_type_of(builder, shader_type_of_value(builder, id));
    if (access.image->image.is_storage && access.image->image.is_multisampled &&
        access.image->image.dim != SPIRV_DIM_SUBPASS) {
        shader_build_refuse(builder, "storage images with several samples are not supported");
    }
    access.values[SHADER_IMAGE_TEXTURE] = place->buffer;
    access.spatial = spatial_of(builder, access.image);
    access.coordinates = access.spatial;
    if (access.image->image.is_arrayed && does != SHADER_DO_QUERY_LOD &&
        !(is_whole(does) && access.image->image.dim == SPIRV_DIM_CUBE)) {
        access.coordinates++;
    }
    access.flags |= access.spatial << SHADER_IMAGE_SPATIAL_SHIFT;
    access.flags |= access.image->image.is_arrayed ? (uint32_t)SHADER_IMAGE_IS_ARRAYED : 0;
    const struct shader_place *const sampler = builder->built[id].sampler;
    if (sampler) {
        access.values[SHADER_IMAGE_SAMPLER] = sampler->buffer;
        access.flags |= SHADER_IMAGE_HAS_SAMPLER;
    }
    return access;
}

// Components of an operand, at most `most`.
static void take_components(struct shader_builder *builder, struct image_access *access, uint32_t id,
                            uint32_t slot, uint32_t most)
{
    const uint32_t count = shader_type_of_value(builder, id)->scalars;
    if (count > 4) {
        shader_build_refuse(builder, "id %u has too many components", (unsigned)id);
    }
    for (uint32_t i = 0; i < count && i < most; i++) {
        access->values[slot + i] = shader_scalars(builder, id)[i];
    }
}

static void take_coordinates(struct shader_builder *builder, struct image_access *access, uint32_t id,
                             bool is_projective)
{
    const uint32_t needed = access->coordinates, count = shader_type_of_value(builder, id)->scalars;
    if (count < needed + (is_projective ? 1 : 0) || count > 4) {
        shader_build_refuse(builder, "id %u has %u components; the image asks for %u", (unsigned)id,
                            (unsigned)count, (unsigned)needed + (is_projective ? 1u : 0u));
    }
    take_components(builder, access, id, SHADER_IMAGE_COORDINATES, needed);
    for (uint32_t i = 0; is_projective && i < needed; i++) {
        uint32_t *const coordinate = &access->values[SHADER_IMAGE_COORDINATES + i];
        *coordinate = shader_emit(builder, SHADER_FDIV, *coordinate, shader_scalars(builder, id)[needed], 0);
    }
}

// Read the image operands, whose mask stands at this operand.
static void take_operands(struct shader_builder *builder, struct image_access *access, uint32_t operand)
{
    const uint32_t mask = operand < shader_word_count(builder) ? shader_operand(builder, operand) : 0;
    uint32_t next = operand + 1;
    if (mask & SPIRV_IMAGE_BIAS) {
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_BIAS, 1);
        access->flags |= SHADER_IMAGE_HAS_BIAS;
    }
    if (mask & SPIRV_IMAGE_LOD) {
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_LOD, 1);
        access->flags |= SHADER_IMAGE_HAS_LOD;
    }
    if (mask & SPIRV_IMAGE_GRAD) {
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_DX, 3);
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_DY, 3);
        access->flags |= SHADER_IMAGE_HAS_GRADIENT;
    }
    if (mask & (SPIRV_IMAGE_CONST_OFFSET | SPIRV_IMAGE_OFFSET)) {
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_OFFSET, 3);
        access->flags |= SHADER_IMAGE_HAS_OFFSET;
    }
    if (mask & SPIRV_IMAGE_CONST_OFFSETS) {
        access->offsets = shader_operand(builder, next++);
        if (shader_type_of_value(builder, access->offsets)->scalars != 8 ||
            (access->flags & 15) != SHADER_DO_GATHER) {
            shader_build_refuse(builder, "four offsets have 2 components each, and are for gathers");
        }
    }
    if (mask & SPIRV_IMAGE_SAMPLE) {
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_SAMPLE, 1);
        access->flags |= SHADER_IMAGE_HAS_SAMPLE;
    }
    if (mask & SPIRV_IMAGE_MIN_LOD) {
        take_components(builder, access, shader_operand(builder, next++), SHADER_IMAGE_LEAST_LOD, 1);
        access->flags |= SHADER_IMAGE_HAS_LEAST_LOD;
    }
}

// In fragments a level of detail that is not given follows from how the coordinates change from pixel to pixel.
static void take_gradient(struct shader_builder *builder, struct image_access *access)
{
    if (builder->entry->model != SPIRV_FRAGMENT) {
        return; // level 0
    }
    for (uint32_t i = 0; i < access->spatial; i++) {
        const uint32_t at = access->values[SHADER_IMAGE_COORDINATES + i];
        access->values[SHADER_IMAGE_DX + i] = shader_emit(builder, SHADER_DDX, at, 0, 0);
        access->values[SHADER_IMAGE_DY + i] = shader_emit(builder, SHADER_DDY, at, 0, 0);
    }
    access->flags |= SHADER_IMAGE_HAS_GRADIENT;
}

// Return what the components of the result are.
static enum shader_type_kind kind_of_result(const struct image_access *access)
{
    switch ((enum shader_image_operation)(access->flags & 15)) {
    case SHADER_DO_SIZE:
    case SHADER_DO_IMAGE_SIZE:
    case SHADER_DO_LEVELS:
    case SHADER_DO_SAMPLES: return SHADER_INT;
    case SHADER_DO_QUERY_LOD: return SHADER_FLOAT;
    default: return access->image->element->kind;
    }
}

// Put the access into the code. Return its node, whose PARTs follow it.
static uint32_t emit_access(struct shader_builder *builder, const struct image_access *access)
{
    const uint32_t list = shader_add_list(builder->program, access->values, SHADER_IMAGE_OPERANDS);
    return shader_emit_with(builder, SHADER_SAMPLE, access->flags, list, 0, 0);
}

// Put the access into the code, and define the result as these of its components, in the order of the result.
static void finish_parts(struct shader_builder *builder, const struct image_access *access,
                         const uint32_t order[4])
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t sample = emit_access(builder, access);
    uint32_t parts[4];
    if (type->scalars == 0 || type->scalars > 4) {
        shader_build_refuse(builder, "the result has 1 to 4 components");
    }
    const struct shader_type *const scalar = type->kind == SHADER_VECTOR ? type->element : type;
    if (scalar->kind != kind_of_result(access)) {
        shader_build_refuse(builder, "the result is not of the type that the image gives");
    }
    for (uint32_t i = 0; i < type->scalars; i++) {
        parts[i] = shader_emit_with(builder, SHADER_PART, order[i], sample, 0, 0);
    }
    shader_define(builder, parts);
}

static void finish_access(struct shader_builder *builder, const struct image_access *access)
{
    finish_parts(builder, access, (const uint32_t[4]){0, 1, 2, 3});
}

// The sampling instructions: with or without a level, a reference and a division by the last coordinate.
static void build_sample(struct shader_builder *builder, bool is_explicit, bool has_reference,
                         bool is_projective)
{
    struct image_access access = begin_access(builder, 3, SHADER_DO_SAMPLE);
    const uint32_t id = shader_operand(builder, 4);
    take_coordinates(builder, &access, id, is_projective);
    if (has_reference) {
        uint32_t reference = shader_scalars(builder, shader_operand(builder, 5))[0];
        if (is_projective) {
            reference = shader_emit(builder, SHADER_FDIV, reference,
                                    shader_scalars(builder, id)[access.coordinates], 0);
        }
        access.values[SHADER_IMAGE_REFERENCE] = reference;
        access.flags |= SHADER_IMAGE_HAS_REFERENCE;
    }
    take_operands(builder, &access, has_reference ? 6 : 5);
    if (!is_explicit) {
        take_gradient(builder, &access);
    }
    finish_access(builder, &access);
}

// Gather at four offsets: each gives the texel above left of its own footprint, which a gather has last.
static void gather_apart(struct shader_builder *builder, struct image_access *access)
{
    uint32_t parts[4];
    access->flags |= SHADER_IMAGE_HAS_OFFSET;
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t *const offset = shader_scalars(builder, access->offsets) + 2 * (size_t)i;
        access->values[SHADER_IMAGE_OFFSET] = offset[0];
        access->values[SHADER_IMAGE_OFFSET + 1] = offset[1];
        parts[i] = shader_emit_with(builder, SHADER_PART, 3, emit_access(builder, access), 0, 0);
    }
    if (shader_result_type(builder)->scalars != 4) {
        shader_build_refuse(builder, "a gather has 4 components");
    }
    shader_define(builder, parts);
}

static void build_gather(struct shader_builder *builder, bool has_reference)
{
    struct image_access access = begin_access(builder, 3, SHADER_DO_GATHER);
    take_coordinates(builder, &access, shader_operand(builder, 4), false);
    uint32_t channel = 0;
    if (has_reference) {
        take_components(builder, &access, shader_operand(builder, 5), SHADER_IMAGE_REFERENCE, 1);
        access.flags |= SHADER_IMAGE_HAS_REFERENCE;
    } else if (!shader_is_number(builder, shader_scalars(builder, shader_operand(builder, 5))[0], &channel) ||
               channel > 3) {
        shader_build_refuse(builder, "the channel is a constant of 0 to 3");
    }
    access.flags |= channel << SHADER_IMAGE_CHANNEL_SHIFT;
    take_operands(builder, &access, 6);
    if (access.offsets != 0) {
        gather_apart(builder, &access);
    } else {
        finish_access(builder, &access);
    }
}

static bool is_storage(const struct shader_type *image)
{
    return image->image.is_storage || image->image.dim == SPIRV_DIM_BUFFER;
}

// An input attachment is fetched at the fragment's pixel, with an offset (Vulkan 1.3, "Input Attachment Interface").
static void build_attachment_read(struct shader_builder *builder)
{
    struct image_access access = begin_access(builder, 3, SHADER_DO_FETCH);
    const uint32_t id = shader_operand(builder, 4);
    const uint32_t *const offset = shader_scalars(builder, id);
    if (builder->entry->model != SPIRV_FRAGMENT || shader_type_of_value(builder, id)->scalars != 2) {
        shader_build_refuse(builder, "input attachments are read in fragments, at an offset of 2 components");
    }
    for (uint32_t i = 0; i < 2; i++) {
        const uint32_t coordinate = shader_emit_with(builder, SHADER_BUILT_IN, SHADER_IN_COORD + i, 0, 0, 0);
        const uint32_t pixel = shader_emit(builder, SHADER_INT_FROM_FLOAT, coordinate, 0, 0);
        access.values[SHADER_IMAGE_COORDINATES + i] = shader_emit(builder, SHADER_IADD, pixel, offset[i], 0);
    }
    // Views are drawn one at a time, each into a layer 0, and read the layer that has the number of the view.
    const uint32_t layer = shader_emit_with(builder, SHADER_BUILT_IN, SHADER_IN_LAYER, 0, 0, 0);
    const uint32_t view = shader_number(builder, builder->program->view_index);
    builder->program->reads_view_index = true;
    access.values[SHADER_IMAGE_COORDINATES + 2] = shader_emit(builder, SHADER_IADD, layer, view, 0);
    access.flags |= SHADER_IMAGE_IS_ARRAYED;
    (void)take_operands(builder, &access, 5);
    finish_access(builder, &access);
}

static void build_fetch(struct shader_builder *builder, enum shader_image_operation does)
{
    const struct shader_type *const type = shader_type_of_value(builder, shader_operand(builder, 3));
    if (type->kind == SHADER_IMAGE && type->image.dim == SPIRV_DIM_SUBPASS) {
        build_attachment_read(builder);
        return;
    }
    const struct shader_type *const image =
        image_type_of(builder, shader_type_of_value(builder, shader_operand(builder, 3)));
    struct image_access access = begin_access(builder, 3, is_storage(image) ? SHADER_DO_LOAD : does);
    take_coordinates(builder, &access, shader_operand(builder, 4), false);
    take_operands(builder, &access, 5);
    if (access.values[SHADER_IMAGE_LOD] == 0) { // level 0, which is that of a fetch without one
        access.flags &= ~(uint32_t)SHADER_IMAGE_HAS_LOD;
    }
    for (uint32_t i = 0; (access.flags & SHADER_IMAGE_HAS_OFFSET) && i < access.spatial; i++) {
        uint32_t *const at = &access.values[SHADER_IMAGE_COORDINATES + i];
        *at = shader_emit(builder, SHADER_IADD, *at, access.values[SHADER_IMAGE_OFFSET + i], 0);
        access.values[SHADER_IMAGE_OFFSET + i] = 0;
    }
    access.flags &= ~(uint32_t)SHADER_IMAGE_HAS_OFFSET;
    finish_access(builder, &access);
}

static void build_query(struct shader_builder *builder, enum shader_image_operation does)
{
    struct image_access access = begin_access(builder, 3, does);
    finish_access(builder, &access);
}

// The size has width and height as far as the image has them, then slices or layers, of which a cube has six.
static void build_size(struct shader_builder *builder, bool has_level)
{
    struct image_access access = begin_access(builder, 3, SHADER_DO_SIZE);
    const bool is_cube = access.image->image.dim == SPIRV_DIM_CUBE,
               is_arrayed = access.image->image.is_arrayed;
    const uint32_t flat = is_cube ? 2 : access.spatial, count = flat + (is_arrayed ? 1 : 0);
    const uint32_t order[4] = {0, flat == 1 ? 2 : 1, 2, 2};
    if (is_storage(access.image)) {
        access.flags = (access.flags & ~15u) | SHADER_DO_IMAGE_SIZE;
    } else if (has_level) {
        take_components(builder, &access, shader_operand(builder, 4), SHADER_IMAGE_LOD, 1);
        access.flags |= SHADER_IMAGE_HAS_LOD;
    }
    if (shader_result_type(builder)->scalars != count) {
        shader_build_refuse(builder, "the size of the image has %u components", (unsigned)count);
    }
    finish_parts(builder, &access, order);
    if (is_cube && is_arrayed) {
        uint32_t *const layers = &builder->built[shader_operand(builder, 2)].scalars[2];
        *layers = shader_emit(builder, SHADER_UDIV, *layers, shader_number(builder, 6), 0);
    }
}

static void build_query_lod(struct shader_builder *builder)
{
    struct image_access access = begin_access(builder, 3, SHADER_DO_QUERY_LOD);
    take_coordinates(builder, &access, shader_operand(builder, 4), false);
    take_gradient(builder, &access);
    finish_access(builder, &access);
}

static void build_write(struct shader_builder *builder)
{
    struct image_access access = begin_access(builder, 1, SHADER_DO_LOAD);
    take_coordinates(builder, &access, shader_operand(builder, 2), false);
    take_components(builder, &access, shader_operand(builder, 3), SHADER_IMAGE_TEXEL, 4);
    take_operands(builder, &access, 4);
    const uint32_t list = shader_add_list(builder->program, access.values, SHADER_IMAGE_OPERANDS);
    (void)shader_emit_with(builder, SHADER_IMAGE_STORE, access.flags, list, 0, 0);
}

// The image is behind a pointer.
static void build_texel_pointer(struct shader_builder *builder)
{
    const struct shader_place *const image = shader_place_of(builder, shader_operand(builder, 3));
    const uint32_t id = shader_operand(builder, 4), count = shader_type_of_value(builder, id)->scalars;
    const struct shader_type *const type = shader_result_type(builder);
    if (image->kind != SHADER_PLACE_RESOURCE || image->is_array_of_resources ||
        image->type->kind != SHADER_IMAGE || !is_storage(image->type) || image->type->image.is_multisampled ||
        type->kind != SHADER_POINTER || type->element != image->type->element) {
        shader_build_refuse(builder, "it points to no texel of a storage image");
    }
    const bool has_layer = image->type->image.is_arrayed && image->type->image.dim != SPIRV_DIM_CUBE;
    const uint32_t needed = spatial_of(builder, image->type) + (has_layer ? 1 : 0);
    if (count < needed || count > 4) {
        shader_build_refuse(builder, "id %u has %u components; the image asks for %u", (unsigned)id,
                            (unsigned)count, (unsigned)needed);
    }
    struct shader_place place = *image;
    place.kind = SHADER_PLACE_TEXEL;
    place.type = image->type->element;
    for (uint32_t i = 0; i < needed; i++) {
        place.coordinates[i] = shader_scalars(builder, id)[i];
    }
    shader_define_place(builder, &place);
}

static void build_sampled_image(struct shader_builder *builder)
{
    const struct shader_type *const type = shader_result_type(builder);
    const struct shader_place *const image = shader_place_of(builder, shader_operand(builder, 3));
    struct shader_place *const sampler = shader_place_of(builder, shader_operand(builder, 4));
    if (type->kind != SHADER_SAMPLED_IMAGE ||
        type->element != shader_type_of_value(builder, shader_operand(builder, 3))) {
        shader_build_refuse(builder, "the result is not the sampled image of the type of the image");
    }
    if (image->kind != SHADER_PLACE_RESOURCE || sampler->kind != SHADER_PLACE_RESOURCE ||
        shader_type_of_value(builder, shader_operand(builder, 4))->kind != SHADER_SAMPLER) {
        shader_build_refuse(builder, "a sampled image is made of an image and a sampler");
    }
    shader_define_place(builder, image);
    builder->built[shader_operand(builder, 2)].sampler = sampler;
}

// The image of a sampled image.
static void build_image_of(struct shader_builder *builder)
{
    const uint32_t id = shader_operand(builder, 3);
    const struct shader_type *const type = shader_type_of_value(builder, id);
    if (type->kind != SHADER_SAMPLED_IMAGE || type->element != shader_result_type(builder)) {
        shader_build_refuse(builder, "id %u is no sampled image of the type of the result", (unsigned)id);
    }
    shader_define_place(builder, shader_place_of(builder, id));
}

static void build_derivative(struct shader_builder *builder, uint32_t opcode)
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t id = shader_operand(builder, 3);
    const bool is_x = opcode == SPIRV_OP_DPdx || opcode == SPIRV_OP_DPdxFine || opcode == SPIRV_OP_DPdxCoarse;
    const bool is_y = opcode == SPIRV_OP_DPdy || opcode == SPIRV_OP_DPdyFine || opcode == SPIRV_OP_DPdyCoarse;
    uint32_t *const result = shader_new_scalars(builder, type);
    shader_check_operands(builder, opcode);
    if (shader_type_of_value(builder, id) != type || builder->entry->model != SPIRV_FRAGMENT) {
        shader_build_refuse(builder, "a derivative is of the type of its operand, and in fragments alone");
    }
    for (uint32_t i = 0; i < type->scalars; i++) {
        const uint32_t value = shader_scalars(builder, id)[i];
        const uint32_t x = is_y ? 0 : shader_emit(builder, SHADER_DDX, value, 0, 0);
        const uint32_t y = is_x ? 0 : shader_emit(builder, SHADER_DDY, value, 0, 0);
        if (is_x || is_y) {
            result[i] = is_x ? x : y;
            continue;
        }
        const uint32_t positive = shader_number(builder, 0x7fffffff);
        result[i] = shader_emit(builder, SHADER_FADD, shader_emit(builder, SHADER_AND, x, positive, 0),
                                shader_emit(builder, SHADER_AND, y, positive, 0), 0);
    }
    shader_define(builder, result);
}

bool shader_build_image(struct shader_builder *builder, uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_SampledImage: build_sampled_image(builder); return true;
    case SPIRV_OP_Image: build_image_of(builder); return true;
    case SPIRV_OP_ImageTexelPointer: build_texel_pointer(builder); return true;
    case SPIRV_OP_ImageSampleImplicitLod: build_sample(builder, false, false, false); return true;
    case SPIRV_OP_ImageSampleExplicitLod: build_sample(builder, true, false, false); return true;
    case SPIRV_OP_ImageSampleDrefImplicitLod: build_sample(builder, false, true, false); return true;
    case SPIRV_OP_ImageSampleDrefExplicitLod: build_sample(builder, true, true, false); return true;
    case SPIRV_OP_ImageSampleProjImplicitLod: build_sample(builder, false, false, true); return true;
    case SPIRV_OP_ImageSampleProjExplicitLod: build_sample(builder, true, false, true); return true;
    case SPIRV_OP_ImageSampleProjDrefImplicitLod: build_sample(builder, false, true, true); return true;
    case SPIRV_OP_ImageSampleProjDrefExplicitLod: build_sample(builder, true, true, true); return true;
    case SPIRV_OP_ImageGather: build_gather(builder, false); return true;
    case SPIRV_OP_ImageDrefGather: build_gather(builder, true); return true;
    case SPIRV_OP_ImageFetch: build_fetch(builder, SHADER_DO_FETCH); return true;
    case SPIRV_OP_ImageRead: build_fetch(builder, SHADER_DO_LOAD); return true;
    case SPIRV_OP_ImageWrite: build_write(builder); return true;
    case SPIRV_OP_ImageQuerySizeLod: build_size(builder, true); return true;
    case SPIRV_OP_ImageQuerySize: build_size(builder, false); return true;
    case SPIRV_OP_ImageQueryLevels: build_query(builder, SHADER_DO_LEVELS); return true;
    case SPIRV_OP_ImageQuerySamples: build_query(builder, SHADER_DO_SAMPLES); return true;
    case SPIRV_OP_ImageQueryLod: build_query_lod(builder); return true;
    case SPIRV_OP_DPdx:
    case SPIRV_OP_DPdy:
    case SPIRV_OP_Fwidth:
    case SPIRV_OP_DPdxFine:
    case SPIRV_OP_DPdyFine:
    case SPIRV_OP_FwidthFine:
    case SPIRV_OP_DPdxCoarse:
    case SPIRV_OP_DPdyCoarse:
    case SPIRV_OP_FwidthCoarse: build_derivative(builder, opcode); return true;
    default: return false;
    }
}
