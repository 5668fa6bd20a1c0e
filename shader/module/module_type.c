// SPDX-License-Identifier: MIT
// Types and their layout in memory.
#include "module.h"

static struct shader_type *new_type(struct shader_module *module, uint32_t word, enum shader_type_kind kind)
{
    struct shader_type *const type = shader_take(module->memory, 1, sizeof *type);
    type->kind = kind;
    type->id = module->words[word + 1];
    type->depth = 1;
    return type;
}

// Nest a type in another. A type is bounded in depth and in scalars, so that those who walk it need no stack of their
// own and no count overflows.
static void nest(const struct shader_module *module, uint32_t word, struct shader_type *type,
                 const struct shader_type *element, uint64_t count)
{
    const uint64_t scalars = type->scalars + element->scalars * count;
    if (element->depth + 1 > SHADER_MAX_TYPE_DEPTH || scalars > SHADER_MAX_SCALARS) {
        shader_refuse(module, word,
                      "the type is too large: at most %d scalars and %d types within each other",
                      SHADER_MAX_SCALARS, SHADER_MAX_TYPE_DEPTH);
    }
    type->scalars = (uint32_t)scalars;
    type->depth = type->depth > element->depth + 1 ? type->depth : element->depth + 1;
}

static bool is_scalar(const struct shader_type *type)
{
    return type->kind == SHADER_BOOL || type->kind == SHADER_INT || type->kind == SHADER_FLOAT;
}

static void read_number(struct shader_module *module, uint32_t word, struct shader_type *type)
{
    const uint32_t bits = module->words[word + 2];
    const bool is_float = type->kind == SHADER_FLOAT;
    if (bits != 32 && bits != 16 && (is_float || bits != 8)) {
        shader_refuse(module, word, "numbers of %u bits are not supported", (unsigned)bits);
    }
    type->bits = (int)bits;
    type->bytes = bits / 8;
    type->is_signed = !is_float && module->words[word + 3] != 0;
    type->scalars = 1;
}

static void read_vector(struct shader_module *module, uint32_t word, struct shader_type *type)
{
    type->element = shader_type_of_id(module, word, module->words[word + 2]);
    type->count = module->words[word + 3];
    const bool fits = type->kind == SHADER_VECTOR ? is_scalar(type->element)
                                                  : type->element->kind == SHADER_VECTOR &&
                                                        type->element->element->kind == SHADER_FLOAT;
    if (!fits || type->count < 2 || type->count > 4) {
        shader_refuse(module, word, "a vector has 2 to 4 scalars, and a matrix 2 to 4 vectors of floats");
    }
    nest(module, word, type, type->element, type->count);
    type->bytes = type->kind == SHADER_VECTOR ? type->count * type->element->bytes : 0;
}

uint64_t shader_member_bytes(const struct shader_member *member)
{
    uint64_t before = 0;
    const struct shader_type *type = member->type;
    for (; type->kind == SHADER_ARRAY; type = type->element) {
        before += (uint64_t)(type->count - 1) * type->stride;
    }
    if (type->kind != SHADER_MATRIX) {
        return before + type->bytes;
    }
    const uint32_t rows = type->element->count, bytes = type->element->element->bytes;
    const uint32_t vectors = member->is_row_major ? rows : type->count;
    const uint32_t components = member->is_row_major ? type->count : rows;
    return before + (uint64_t)(vectors - 1) * member->matrix_stride + components * bytes;
}

// Set the bytes of a type. Sums of offsets within one type fit into 32 bits because of the bound.
static void set_bytes(const struct shader_module *module, uint32_t word, struct shader_type *type,
                      uint64_t bytes)
{
    if (bytes > SHADER_MAX_TYPE_BYTES) {
        shader_refuse(module, word, "by its offsets and strides the type has more than %d bytes",
                      SHADER_MAX_TYPE_BYTES);
    }
    type->bytes = (uint32_t)bytes;
}

static void read_array(struct shader_module *module, uint32_t word, struct shader_type *type)
{
    type->element = shader_type_of_id(module, word, module->words[word + 2]);
    const struct shader_decoration *const stride =
        shader_find_decoration(module, type->id, -1, SPIRV_ARRAY_STRIDE);
    type->stride = stride ? stride->value : 0;
    if (type->kind == SHADER_RUNTIME_ARRAY) {
        nest(module, word, type, type->element, 0);
        type->scalars = 0;
        return;
    }
    const struct shader_constant *const length = shader_constant_of_id(module, word, module->words[word + 3]);
    if (length->type->kind != SHADER_INT || length->scalars[0] == 0 || length->scalars[0] > INT32_MAX) {
        shader_refuse(module, word, "the length of an array is a whole number from 1 on");
    }
    type->count = length->scalars[0];
    // Resources have no scalars; an array of them is bounded by its length.
    if (type->element->scalars == 0 && !type->element->is_empty && type->count > SHADER_MAX_SCALARS) {
        shader_refuse(module, word, "an array of resources has at most %d", SHADER_MAX_SCALARS);
    }
    // Memory may hold more than a value can.
    const uint64_t scalars = (uint64_t)type->element->scalars * type->count;
    nest(module, word, type, type->element, scalars > SHADER_MAX_SCALARS ? 0 : type->count);
    if (scalars > SHADER_MAX_SCALARS) {
        type->scalars = 0;
    }
    type->is_empty = type->element->is_empty;
    const struct shader_member whole = {.type = type};
    set_bytes(module, word, type, shader_member_bytes(&whole));
}

// Give members what they are decorated with. One walk over the decorations serves all members.
static void decorate_members(const struct shader_module *module, uint32_t id, struct shader_member *members,
                             uint32_t count)
{
    for (uint32_t d = module->ids[id].decorations; d != 0; d = module->decorations[d - 1].next) {
        const struct shader_decoration *const decoration = &module->decorations[d - 1];
        if (decoration->member < 0) {
            continue;
        }
        if ((uint32_t)decoration->member >= count) {
            shader_refuse(module, decoration->word, "id %u has no member %d", (unsigned)id,
                          decoration->member);
        }
        struct shader_member *const member = &members[decoration->member];
        const bool is_index = decoration->value <= INT32_MAX;
        switch (decoration->number) {
        case SPIRV_OFFSET: member->offset = decoration->value; break;
        case SPIRV_MATRIX_STRIDE: member->matrix_stride = decoration->value; break;
        case SPIRV_ROW_MAJOR: member->is_row_major = true; break;
        case SPIRV_FLAT: member->interpolation |= SHADER_FLAT; break;
        case SPIRV_NO_PERSPECTIVE: member->interpolation |= SHADER_NOPERSPECTIVE; break;
        case SPIRV_CENTROID: member->interpolation |= SHADER_AT_CENTROID; break;
        case SPIRV_SAMPLE: member->interpolation |= SHADER_AT_SAMPLE; break;
        case SPIRV_BUILT_IN: member->built_in = is_index ? (int)decoration->value : INT32_MAX; break;
        case SPIRV_LOCATION: member->location = is_index ? (int)decoration->value : INT32_MAX; break;
        case SPIRV_COMPONENT: member->component = is_index ? (int)decoration->value : INT32_MAX; break;
        default: break;
        }
    }
}

static void read_struct(struct shader_module *module, uint32_t word, struct shader_type *type)
{
    type->count = (module->words[word] >> 16) - 2;
    struct shader_member *const members = shader_take(module->memory, type->count, sizeof *members);
    bool has_values = true;
    uint64_t scalars = 0, end = 0;
    for (uint32_t i = 0; i < type->count; i++) {
        members[i] =
            (struct shader_member){.type = shader_type_of_id(module, word, module->words[word + 2 + i]),
                                   .built_in = -1,
                                   .location = -1};
    }
    decorate_members(module, type->id, members, type->count);
    for (uint32_t i = 0; i < type->count; i++) {
        const uint64_t behind = members[i].offset + shader_member_bytes(&members[i]);
        end = behind > end ? behind : end;
        nest(module, word, type, members[i].type, 0);
        // Memory may hold more than a value can.
        has_values = has_values && (members[i].type->scalars != 0 || members[i].type->is_empty);
        members[i].first = has_values ? (uint32_t)scalars : 0;
        scalars += members[i].type->scalars;
        has_values = has_values && scalars <= SHADER_MAX_SCALARS;
    }
    type->scalars = has_values ? (uint32_t)scalars : 0;
    type->is_empty = has_values && scalars == 0;
    set_bytes(module, word, type, end);
    type->members = members;
    type->is_block = shader_find_decoration(module, type->id, -1, SPIRV_BLOCK) != NULL;
    type->is_buffer_block = shader_find_decoration(module, type->id, -1, SPIRV_BUFFER_BLOCK) != NULL;
}

static void read_image(struct shader_module *module, uint32_t word, struct shader_type *type)
{
    const uint32_t *const words = module->words + word;
    type->element = shader_type_of_id(module, word, words[2]);
    if (words[3] > SPIRV_DIM_SUBPASS || words[5] > 1 || words[6] > 1 || words[7] == 0 || words[7] > 2 ||
        (type->element->kind != SHADER_FLOAT && type->element->kind != SHADER_INT) ||
        type->element->bits != 32) {
        shader_refuse(module, word, "an image of this kind is not supported");
    }
    type->image = (struct shader_image_type){.dim = (enum spirv_dim)words[3],
                                             .is_depth = words[4] == 1,
                                             .is_arrayed = words[5] == 1,
                                             .is_multisampled = words[6] == 1,
                                             .is_storage = words[7] == 2 && words[3] != SPIRV_DIM_SUBPASS,
                                             .format = words[8]};
}

static void read_function_type(struct shader_module *module, uint32_t word, struct shader_type *type)
{
    type->element = shader_type_of_id(module, word, module->words[word + 2]);
    type->count = (module->words[word] >> 16) - 3;
    const struct shader_type **const parameters =
        shader_take(module->memory, type->count, sizeof(struct shader_type *));
    for (uint32_t i = 0; i < type->count; i++) {
        parameters[i] = shader_type_of_id(module, word, module->words[word + 3 + i]);
    }
    type->parameters = parameters;
}

void shader_read_type(struct shader_module *module, uint32_t word)
{
    static const enum shader_type_kind kinds[] = {SHADER_VOID,  SHADER_BOOL,          SHADER_INT,
                                                  SHADER_FLOAT, SHADER_VECTOR,        SHADER_MATRIX,
                                                  SHADER_IMAGE, SHADER_SAMPLER,       SHADER_SAMPLED_IMAGE,
                                                  SHADER_ARRAY, SHADER_RUNTIME_ARRAY, SHADER_STRUCT};
    const uint32_t opcode = module->words[word] & 0xffff;
    enum shader_type_kind kind = SHADER_VOID;
    if (opcode == SPIRV_OP_TypePointer) {
        kind = SHADER_POINTER;
    } else if (opcode == SPIRV_OP_TypeFunction) {
        kind = SHADER_FUNCTION;
    } else if (opcode <= SPIRV_OP_TypeStruct) {
        kind = kinds[opcode - SPIRV_OP_TypeVoid];
    } else {
        shader_refuse(module, word, "types of this kind are not supported");
    }
    struct shader_type *const type = new_type(module, word, kind);
    switch (kind) {
    case SHADER_BOOL: type->scalars = 1; break;
    case SHADER_INT:
    case SHADER_FLOAT: read_number(module, word, type); break;
    case SHADER_VECTOR:
    case SHADER_MATRIX: read_vector(module, word, type); break;
    case SHADER_IMAGE: read_image(module, word, type); break;
    case SHADER_SAMPLED_IMAGE:
        type->element = shader_type_of_id(module, word, module->words[word + 2]);
        if (type->element->kind != SHADER_IMAGE) {
            shader_refuse(module, word, "id %u is no image", (unsigned)module->words[word + 2]);
        }
        break;
    case SHADER_ARRAY:
    case SHADER_RUNTIME_ARRAY: read_array(module, word, type); break;
    case SHADER_STRUCT: read_struct(module, word, type); break;
    case SHADER_POINTER:
        type->storage = (enum spirv_storage_class)module->words[word + 2];
        type->element = shader_type_of_id(module, word, module->words[word + 3]);
        break;
    case SHADER_FUNCTION: read_function_type(module, word, type); break;
    default: break;
    }
    module->ids[type->id].data.as_type = type;
}
