// SPDX-License-Identifier: MIT
// What is loaded and stored through pointers.
#include "build.h"

// Scalars --------------------------------------------------------------------------------------------

static uint32_t is_index(struct shader_builder *builder, const struct shader_dynamic_index *dynamic,
                         uint32_t i)
{
    return shader_emit(builder, SHADER_IEQUAL, dynamic->value, shader_number(builder, i), 0);
}

static uint32_t read_scalar(struct shader_builder *builder, const struct shader_place *place, uint32_t at)
{
    return place->kind == SHADER_PLACE_HOMES ? shader_get_home(builder, place->scalars[at])
                                             : place->scalars[at];
}

// Read the scalar that indices from `level` on pick; an index outside picks the last element.
static uint32_t read_dynamic(struct shader_builder *builder, const struct shader_place *place, uint32_t level,
                             uint32_t at)
{
    if (level == SHADER_MAX_DYNAMIC || level == place->dynamic_count) {
        return read_scalar(builder, place, at);
    }
    const struct shader_dynamic_index *const dynamic = &place->dynamic[level];
    uint32_t result = read_dynamic(builder, place, level + 1, at + (dynamic->count - 1) * dynamic->stride);
    for (uint32_t i = dynamic->count - 1; i-- > 0;) {
        const uint32_t other = read_dynamic(builder, place, level + 1, at + i * dynamic->stride);
        result = shader_emit(builder, SHADER_SELECT, is_index(builder, dynamic, i), other, result);
    }
    return result;
}

// Write the scalar that indices from `level` on pick, where `condition` holds; an index outside picks none.
static void write_dynamic(struct shader_builder *builder, const struct shader_place *place, uint32_t level,
                          uint32_t at, uint32_t condition, uint32_t value)
{
    if (level == SHADER_MAX_DYNAMIC || level == place->dynamic_count) {
        const uint32_t home = place->scalars[at];
        if (condition != SHADER_NO_VALUE) {
            value = shader_emit(builder, SHADER_SELECT, condition, value, shader_get_home(builder, home));
        }
        shader_set_home(builder, home, value);
        return;
    }
    const struct shader_dynamic_index *const dynamic = &place->dynamic[level];
    for (uint32_t i = 0; i < dynamic->count; i++) {
        uint32_t holds = is_index(builder, dynamic, i);
        holds = condition == SHADER_NO_VALUE ? holds : shader_emit(builder, SHADER_AND, condition, holds, 0);
        write_dynamic(builder, place, level + 1, at + i * dynamic->stride, holds, value);
    }
}

// Memory ---------------------------------------------------------------------------------------------

// Refuse a scalar in memory with a layout that has no place in it.
static void check_layout(const struct shader_builder *builder, const struct shader_place *place)
{
    if (place->type->kind == SHADER_BOOL) {
        shader_build_refuse(builder, "there are no bools in memory that has a layout");
    }
    const uint32_t size = (uint32_t)place->type->bits / 8;
    if (((place->bytes | place->strides) & (size - 1)) != 0) {
        shader_build_refuse(builder, "a number of %d bits does not lie at a multiple of %u bytes",
                            place->type->bits, (unsigned)size);
    }
}

static bool is_narrow(const struct shader_place *place)
{
    return !shader_is_packed(place) && place->type->bits < 32;
}

// Return a scalar of a table at a place that is known; outside it is 0.
static uint32_t constant_at(struct shader_builder *builder, const struct shader_place *place)
{
    const uint32_t scalar = place->bytes / 4, count = builder->program->nodes[place->buffer].operands[0];
    return shader_number(builder, scalar < count ? place->constants[scalar] : 0);
}

static uint32_t load_scalar(struct shader_builder *builder, const struct shader_place *place)
{
    const uint32_t offset = place->offset == SHADER_NO_VALUE ? shader_number(builder, 0) : place->offset;
    if (place->kind == SHADER_PLACE_TABLE && place->offset == SHADER_NO_VALUE) {
        return constant_at(builder, place);
    }
    if (!shader_is_packed(place)) {
        check_layout(builder, place);
    }
    if (is_narrow(place)) {
        return shader_load_narrow(builder, place, offset);
    }
    const uint32_t loaded = shader_emit_with(builder, SHADER_LOAD, place->bytes, place->buffer, offset, 0);
    if (place->type->kind != SHADER_BOOL) {
        return loaded;
    }
    // A store that an index led astray may have written any bits there. A truth is −1 or 0.
    return shader_emit(builder, SHADER_NOT,
                       shader_emit(builder, SHADER_IEQUAL, loaded, shader_number(builder, 0), 0), 0, 0);
}

static void store_scalar(struct shader_builder *builder, const struct shader_place *place, uint32_t value)
{
    const uint32_t offset = place->offset == SHADER_NO_VALUE ? shader_number(builder, 0) : place->offset;
    if (!shader_is_packed(place)) {
        check_layout(builder, place);
    }
    if (is_narrow(place)) {
        shader_store_narrow(builder, place, offset, value);
    } else {
        (void)shader_emit_with(builder, SHADER_STORE, place->bytes, place->buffer, offset, value);
    }
}

// Load to, or store from, as many scalars as a place has.
static void access_memory(struct shader_builder *builder, const struct shader_place *place, uint32_t **loaded,
                          const uint32_t **stored)
{
    const struct shader_type *const type = place->type;
    if (type->is_empty) {
        return; // arrays of it may have any number of elements
    }
    if (type->kind == SHADER_INT || type->kind == SHADER_FLOAT || type->kind == SHADER_BOOL) {
        if (loaded) {
            *(*loaded)++ = load_scalar(builder, place);
        } else {
            store_scalar(builder, place, *(*stored)++);
        }
        return;
    }
    for (uint32_t i = 0; i < type->count; i++) {
        struct shader_place part = *place;
        shader_step(builder, &part, shader_number(builder, i));
        access_memory(builder, &part, loaded, stored);
    }
}

void shader_read_place(struct shader_builder *builder, const struct shader_place *place, uint32_t *scalars)
{
    if (shader_is_in_memory(place)) {
        access_memory(builder, place, &scalars, NULL);
        return;
    }
    if (place->kind != SHADER_PLACE_HOMES && place->kind != SHADER_PLACE_INPUT) {
        shader_build_refuse(builder, "what is pointed to cannot be loaded");
    }
    for (uint32_t i = 0; i < place->type->scalars; i++) {
        scalars[i] = read_dynamic(builder, place, 0, place->first + i);
    }
}

void shader_write_place(struct shader_builder *builder, const struct shader_place *place,
                        const uint32_t *scalars)
{
    if (place->is_read_only) {
        shader_build_refuse(builder, "uniform blocks and push constants cannot be stored to");
    }
    if (place->kind == SHADER_PLACE_TABLE) {
        return; // it holds what is stored to it
    }
    if (shader_is_in_memory(place)) {
        access_memory(builder, place, NULL, &scalars);
        return;
    }
    if (place->kind != SHADER_PLACE_HOMES) {
        shader_build_refuse(builder, "what is pointed to cannot be stored to");
    }
    for (uint32_t i = 0; i < place->type->scalars; i++) {
        write_dynamic(builder, place, 0, place->first + i, SHADER_NO_VALUE, scalars[i]);
    }
}

static void build_load(struct shader_builder *builder)
{
    const struct shader_place *const place = shader_place_of(builder, shader_operand(builder, 3));
    if (place->type != shader_result_type(builder) || place->is_array_of_resources) {
        shader_build_refuse(builder, "the value is not of the type of what is pointed to");
    }
    if (place->kind == SHADER_PLACE_RESOURCE) {
        shader_define_place(builder, place);
        return;
    }
    uint32_t *const scalars = shader_new_scalars(builder, place->type);
    shader_read_place(builder, place, scalars);
    shader_define(builder, scalars);
}

void shader_store(struct shader_builder *builder, uint32_t pointer, const struct shader_type *type,
                  const uint32_t *scalars)
{
    const struct shader_place *const place = shader_place_of(builder, pointer);
    if (place->type != type || place->is_array_of_resources) {
        shader_build_refuse(builder, "the value is not of the type of what is pointed to");
    }
    shader_write_place(builder, place, scalars);
}

static void build_store(struct shader_builder *builder)
{
    const uint32_t id = shader_operand(builder, 2);
    shader_store(builder, shader_operand(builder, 1), shader_type_of_value(builder, id),
                 shader_scalars(builder, id));
}

static void build_copy(struct shader_builder *builder)
{
    const struct shader_place *const to = shader_place_of(builder, shader_operand(builder, 1));
    const struct shader_place *const from = shader_place_of(builder, shader_operand(builder, 2));
    if (to->type != from->type || to->is_array_of_resources || from->is_array_of_resources) {
        shader_build_refuse(builder, "the pointers point to other types");
    }
    uint32_t *const scalars = shader_new_scalars(builder, to->type);
    shader_read_place(builder, from, scalars);
    shader_write_place(builder, to, scalars);
}

// Elements of the runtime array that ends a block: the bytes behind its offset, divided by its stride.
static void build_array_length(struct shader_builder *builder)
{
    const struct shader_place *const place = shader_place_of(builder, shader_operand(builder, 3));
    const uint32_t number = shader_operand(builder, 4);
    const struct shader_type *const type = place->type;
    if (place->kind != SHADER_PLACE_BUFFER || place->is_array_of_resources ||
        builder->program->nodes[place->buffer].op != SHADER_BUFFER || type->kind != SHADER_STRUCT ||
        number + 1 != type->count || type->members[number].type->kind != SHADER_RUNTIME_ARRAY ||
        type->members[number].type->stride == 0) {
        shader_build_refuse(builder, "the last member of the block is no array without a length");
    }
    const struct shader_member *const member = &type->members[number];
    const uint32_t bytes = shader_emit_with(builder, SHADER_LENGTH, 0, place->buffer, 0, 0);
    const uint32_t offset = shader_number(builder, member->offset);
    const uint32_t rest = shader_emit(builder, SHADER_ISUB, bytes, offset, 0);
    const uint32_t is_short = shader_emit(builder, SHADER_ULESS, bytes, offset, 0);
    const uint32_t behind = shader_emit(builder, SHADER_SELECT, is_short, shader_number(builder, 0), rest);
    const uint32_t length =
        shader_emit(builder, SHADER_UDIV, behind, shader_number(builder, member->type->stride), 0);
    shader_define_scalar(builder, length);
}

// Atomics --------------------------------------------------------------------------------------------

// The operation of an instruction that has a pointer, a scope, an order and a value. Return false for others.
static bool find_atomic(uint32_t opcode, enum shader_atomic *operation)
{
    switch (opcode) {
    case SPIRV_OP_AtomicExchange: *operation = SHADER_ATOMIC_EXCHANGE; return true;
    case SPIRV_OP_AtomicIAdd:
    case SPIRV_OP_AtomicISub: *operation = SHADER_ATOMIC_ADD; return true;
    case SPIRV_OP_AtomicSMin: *operation = SHADER_ATOMIC_MIN_INT; return true;
    case SPIRV_OP_AtomicUMin: *operation = SHADER_ATOMIC_MIN_UINT; return true;
    case SPIRV_OP_AtomicSMax: *operation = SHADER_ATOMIC_MAX_INT; return true;
    case SPIRV_OP_AtomicUMax: *operation = SHADER_ATOMIC_MAX_UINT; return true;
    case SPIRV_OP_AtomicAnd: *operation = SHADER_ATOMIC_AND; return true;
    case SPIRV_OP_AtomicOr: *operation = SHADER_ATOMIC_OR; return true;
    case SPIRV_OP_AtomicXor: *operation = SHADER_ATOMIC_XOR; return true;
    default: return false;
    }
}

static uint32_t emit_image_atomic(struct shader_builder *builder, enum shader_atomic operation,
                                  const struct shader_place *place, uint32_t value, uint32_t comparand)
{
    const uint32_t values[SHADER_IMAGE_ATOMIC_OPERANDS] = {
        place->buffer, place->coordinates[0], place->coordinates[1], place->coordinates[2], value, comparand};
    const uint32_t list = shader_add_list(builder->program, values, SHADER_IMAGE_ATOMIC_OPERANDS);
    return shader_emit_with(builder, SHADER_IMAGE_ATOMIC, (uint32_t)operation, list, 0, 0);
}

static uint32_t emit_atomic(struct shader_builder *builder, enum shader_atomic operation, uint32_t pointer,
                            uint32_t value, uint32_t comparand)
{
    const struct shader_place *const place = shader_place_of(builder, pointer);
    const bool moves = operation == SHADER_ATOMIC_LOAD || operation == SHADER_ATOMIC_STORE ||
                       operation == SHADER_ATOMIC_EXCHANGE;
    if ((place->kind != SHADER_PLACE_BUFFER && place->kind != SHADER_PLACE_WORKGROUP &&
         place->kind != SHADER_PLACE_TEXEL) ||
        place->is_read_only || place->is_array_of_resources || place->type->bits != 32 ||
        (place->type->kind != SHADER_INT && (place->type->kind != SHADER_FLOAT || !moves))) {
        shader_build_refuse(builder, "id %u does not point to %s of 32 bits in memory", (unsigned)pointer,
                            moves ? "a number" : "an integer");
    }
    if (place->kind == SHADER_PLACE_TEXEL) {
        return emit_image_atomic(builder, operation, place, value, comparand);
    }
    const uint32_t bytes = shader_number(builder, place->bytes);
    const uint32_t values[SHADER_ATOMIC_OPERANDS] = {
        place->buffer,
        place->offset == SHADER_NO_VALUE ? bytes : shader_emit(builder, SHADER_IADD, place->offset, bytes, 0),
        value, comparand};
    const uint32_t list = shader_add_list(builder->program, values, SHADER_ATOMIC_OPERANDS);
    return shader_emit_with(builder, SHADER_ATOMIC, (uint32_t)operation, list, 0, 0);
}

// Return an operand that is of the type of what is pointed to.
static uint32_t atomic_value(struct shader_builder *builder, uint32_t pointer, uint32_t operand)
{
    const uint32_t id = shader_operand(builder, operand);
    if (shader_type_of_value(builder, id) !=
        shader_place_of(builder, shader_operand(builder, pointer))->type) {
        shader_build_refuse(builder, "id %u is not of the type of what is pointed to", (unsigned)id);
    }
    return shader_scalars(builder, id)[0];
}

static bool build_atomic(struct shader_builder *builder, uint32_t opcode)
{
    enum shader_atomic operation;
    uint32_t before;
    if (opcode >= SPIRV_OP_AtomicLoad && opcode <= SPIRV_OP_AtomicXor && opcode != SPIRV_OP_AtomicStore &&
        shader_result_type(builder) != shader_place_of(builder, shader_operand(builder, 3))->type) {
        shader_build_refuse(builder, "the result is not of the type of what is pointed to");
    }
    if (opcode == SPIRV_OP_AtomicStore) {
        (void)emit_atomic(builder, SHADER_ATOMIC_STORE, shader_operand(builder, 1),
                          atomic_value(builder, 1, 4), 0);
        return true;
    }
    if (opcode == SPIRV_OP_AtomicLoad) {
        before = emit_atomic(builder, SHADER_ATOMIC_LOAD, shader_operand(builder, 3), 0, 0);
    } else if (opcode == SPIRV_OP_AtomicCompareExchange) {
        before = emit_atomic(builder, SHADER_ATOMIC_COMPARE_EXCHANGE, shader_operand(builder, 3),
                             atomic_value(builder, 3, 7), atomic_value(builder, 3, 8));
    } else if (opcode == SPIRV_OP_AtomicIIncrement || opcode == SPIRV_OP_AtomicIDecrement) {
        const uint32_t step = opcode == SPIRV_OP_AtomicIIncrement ? 1 : UINT32_MAX;
        before = emit_atomic(builder, SHADER_ATOMIC_ADD, shader_operand(builder, 3),
                             shader_number(builder, step), 0);
    } else if (find_atomic(opcode, &operation)) {
        uint32_t value = atomic_value(builder, 3, 6);
        value = opcode == SPIRV_OP_AtomicISub
                    ? shader_emit(builder, SHADER_ISUB, shader_number(builder, 0), value, 0)
                    : value;
        before = emit_atomic(builder, operation, shader_operand(builder, 3), value, 0);
    } else {
        return false;
    }
    shader_define_scalar(builder, before);
    return true;
}

// The lanes of a subgroup go through the shader together.
static void build_barrier(struct shader_builder *builder)
{
    enum { SUBGROUP = 3 };
    uint32_t scope;
    const uint32_t id = shader_operand(builder, 1);
    if (!shader_is_number(builder, shader_scalars(builder, id)[0], &scope)) {
        shader_build_refuse(builder, "the scope of a barrier is a constant");
    }
    if (scope != SUBGROUP) {
        (void)shader_emit_with(builder, SHADER_BARRIER, 0, 0, 0, 0);
        builder->program->has_barriers = true;
    }
}

bool shader_build_memory(struct shader_builder *builder, uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_AccessChain:
    case SPIRV_OP_InBoundsAccessChain: shader_build_access_chain(builder); return true;
    case SPIRV_OP_Load: build_load(builder); return true;
    case SPIRV_OP_Store: build_store(builder); return true;
    case SPIRV_OP_CopyMemory: build_copy(builder); return true;
    case SPIRV_OP_ArrayLength: build_array_length(builder); return true;
    case SPIRV_OP_ControlBarrier: build_barrier(builder); return true;
    case SPIRV_OP_MemoryBarrier: return true; // memory is written in the order of the operations
    default: return build_atomic(builder, opcode);
    }
}
