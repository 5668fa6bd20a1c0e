// SPDX-License-Identifier: MIT
// Pointers and what is loaded and stored through them. Pointers are logical: each is a place that is known when the
// shader is translated, with indices that may be known when it runs.
#include "build.h"

enum { MAX_CANDIDATES = 1024, MAX_VARIABLES = 4096, SHADER_MAX_WORKGROUP = 32768 };

// Scalars of a type in the memory of a workgroup, where arrays may be larger than values.
static uint64_t shared_scalars(const struct shader_type *type)
{
    const uint64_t all =
        type->kind == SHADER_ARRAY ? shared_scalars(type->element) * type->count : type->scalars;
    return all < SHADER_MAX_WORKGROUP ? all : SHADER_MAX_WORKGROUP;
}

// Variables ------------------------------------------------------------------------------------------

static uint32_t add_resource(struct shader_builder *builder, const struct shader_variable *variable,
                             const struct shader_type *element, uint32_t count)
{
    struct shader_program *const program = builder->program;
    if (program->resource_count == MAX_VARIABLES) {
        shader_build_refuse(builder, "the module has more than %d buffers, images and samplers",
                            MAX_VARIABLES);
    }
    if (!program->resources) {
        program->resources =
            shader_take(builder->memory, builder->module->variable_count, sizeof *program->resources);
    }
    program->resources[program->resource_count] =
        (struct shader_resource){.variable = variable, .type = element, .count = count};
    return program->resource_count++;
}

// The variable is a resource, or an array of resources.
static void build_resource(struct shader_builder *builder, const struct shader_variable *variable,
                           struct shader_place *place)
{
    const struct shader_type *element = variable->type;
    uint32_t count = 1;
    place->is_array_of_resources = element->kind == SHADER_ARRAY || element->kind == SHADER_RUNTIME_ARRAY;
    if (place->is_array_of_resources) {
        count = element->kind == SHADER_ARRAY ? element->count : 0;
        element = element->element;
    }
    const bool is_buffer = element->kind == SHADER_STRUCT;
    const bool is_image = element->kind == SHADER_IMAGE || element->kind == SHADER_SAMPLER ||
                          element->kind == SHADER_SAMPLED_IMAGE;
    if ((!is_buffer && !is_image) || is_image != (variable->storage == SPIRV_UNIFORM_CONSTANT)) {
        shader_build_refuse(builder, "a resource is a block in a buffer, an image or a sampler");
    }
    place->kind = is_buffer ? SHADER_PLACE_BUFFER : SHADER_PLACE_RESOURCE;
    place->is_read_only = variable->storage == SPIRV_UNIFORM && !element->is_buffer_block;
    place->resource = add_resource(builder, variable, element, count);
    if (!place->is_array_of_resources) {
        place->buffer =
            shader_emit_with(builder, SHADER_BUFFER, place->resource, shader_number(builder, 0), 0, 0);
    }
}

// A variable of the workgroup lies in its memory, scalar behind scalar.
static void build_shared(struct shader_builder *builder, struct shader_place *place)
{
    struct shader_program *const program = builder->program;
    if (place->type->scalars == 0 && place->type->kind != SHADER_ARRAY) {
        shader_build_refuse(builder, "the variable holds no values");
    }
    const uint64_t bytes = program->workgroup_size + 4 * shared_scalars(place->type);
    if (bytes > SHADER_MAX_WORKGROUP) {
        shader_build_refuse(builder, "a workgroup has at most %d bytes of memory", SHADER_MAX_WORKGROUP);
    }
    place->kind = SHADER_PLACE_WORKGROUP;
    place->buffer = shader_emit_with(builder, SHADER_WORKGROUP, 0, 0, 0, 0);
    place->bytes = program->workgroup_size;
    program->workgroup_size = (uint32_t)bytes;
}

void shader_build_variable(struct shader_builder *builder, const struct shader_variable *variable)
{
    const struct shader_type *const type = variable->type;
    struct shader_place place = {.type = type, .offset = SHADER_NO_VALUE};
    switch (variable->storage) {
    case SPIRV_UNIFORM_CONSTANT:
    case SPIRV_UNIFORM:
    case SPIRV_STORAGE_BUFFER: build_resource(builder, variable, &place); break;
    case SPIRV_PUSH_CONSTANT:
        place.kind = SHADER_PLACE_BUFFER;
        place.is_read_only = true;
        place.buffer = shader_emit_with(builder, SHADER_PUSH, 0, 0, 0, 0);
        break;
    case SPIRV_INPUT:
    case SPIRV_OUTPUT: shader_build_interface_variable(builder, variable, &place); break;
    case SPIRV_WORKGROUP: build_shared(builder, &place); break;
    default:
        place.kind = SHADER_PLACE_HOMES;
        place.scalars = shader_new_scalars(builder, type);
        for (uint32_t i = 0; i < type->scalars; i++) {
            const uint32_t initial = variable->initial ? variable->initial->scalars[i] : 0;
            place.scalars[i] = shader_new_home(builder, initial);
            // A variable of a function is new in every call and every round of a loop.
            if (variable->storage == SPIRV_FUNCTION && variable->initial) {
                shader_set_home(builder, place.scalars[i], shader_number(builder, initial));
            }
        }
    }
    struct shader_built *const built = &builder->built[variable->id];
    built->place = shader_take(builder->memory, 1, sizeof place);
    *built->place = place;
    built->type = shader_type_of_id(builder->module, builder->word, builder->module->ids[variable->id].type);
    built->scalars = NULL;
}

// Access chains --------------------------------------------------------------------------------------

static uint32_t add_offset(struct shader_builder *builder, uint32_t offset, uint32_t more)
{
    return offset == SHADER_NO_VALUE ? more : shader_emit(builder, SHADER_IADD, offset, more, 0);
}

// Step `index` times `bytes` on in memory.
static void step_bytes(struct shader_builder *builder, struct shader_place *place, uint32_t index,
                       uint32_t bytes)
{
    uint32_t number;
    if (bytes == 0) {
        shader_build_refuse(builder, "the array or matrix has no stride");
    }
    if (shader_is_number(builder, index, &number)) {
        const uint64_t offset = place->bytes + (uint64_t)number * bytes;
        if (offset > INT32_MAX) {
            shader_build_refuse(builder, "element %u lies beyond %d bytes", (unsigned)number, INT32_MAX);
        }
        place->bytes = (uint32_t)offset;
        return;
    }
    const uint32_t more = shader_emit(builder, SHADER_IMUL, index, shader_number(builder, bytes), 0);
    place->offset = add_offset(builder, place->offset, more);
}

// Pick an element in memory that has a layout.
static void step_in_memory(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    const struct shader_type *const type = place->type;
    uint32_t stride = 0, number;
    if (type->kind != SHADER_RUNTIME_ARRAY && shader_is_number(builder, index, &number) &&
        number >= type->count) {
        shader_build_refuse(builder, "there is no element %u of %u", (unsigned)number, (unsigned)type->count);
    }
    if (place->kind == SHADER_PLACE_WORKGROUP) {
        step_bytes(builder, place, index, 4 * (uint32_t)shared_scalars(type->element));
        return;
    }
    switch (type->kind) {
    case SHADER_ARRAY:
    case SHADER_RUNTIME_ARRAY: stride = type->stride; break;
    case SHADER_MATRIX:
        stride = place->matrix && place->matrix->is_row_major ? 4
                 : place->matrix                              ? place->matrix->matrix_stride
                                                              : 0;
        place->row_stride = place->matrix && place->matrix->is_row_major ? place->matrix->matrix_stride : 4;
        break;
    default: stride = place->row_stride ? place->row_stride : 4; break;
    }
    step_bytes(builder, place, index, stride);
}

// Pick an element among scalars.
static void step_in_scalars(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    const struct shader_type *const type = place->type;
    uint32_t number;
    if (shader_is_number(builder, index, &number)) {
        if (number >= type->count) {
            shader_build_refuse(builder, "there is no element %u of %u", (unsigned)number,
                                (unsigned)type->count);
        }
        place->first += number * type->element->scalars;
        return;
    }
    if (place->dynamic_count == SHADER_MAX_DYNAMIC) {
        shader_build_refuse(builder, "more than %d indices are not constant", SHADER_MAX_DYNAMIC);
    }
    place->dynamic[place->dynamic_count++] =
        (struct shader_dynamic_index){index, type->count, type->element->scalars};
}

static void step_in_struct(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    uint32_t number;
    if (!shader_is_number(builder, index, &number) || number >= place->type->count) {
        shader_build_refuse(builder, "a member of a structure is named by a constant below %u",
                            (unsigned)place->type->count);
    }
    const struct shader_member *const member = &place->type->members[number];
    place->first += member->first;
    place->bytes += place->kind == SHADER_PLACE_WORKGROUP ? 4 * member->first : member->offset;
    place->matrix = member;
    place->type = member->type;
}

static void step(struct shader_builder *builder, struct shader_place *place, uint32_t id)
{
    const uint32_t index = shader_scalars(builder, id)[0];
    const struct shader_type *const type = place->type;
    if (shader_type_of_value(builder, id)->kind != SHADER_INT) {
        shader_build_refuse(builder, "index %u is no integer", (unsigned)id);
    }
    if (place->is_array_of_resources) {
        place->buffer = shader_emit_with(builder, SHADER_BUFFER, place->resource, index, 0, 0);
        place->is_array_of_resources = false;
        place->type = type->element;
        return;
    }
    if (type->kind == SHADER_STRUCT) {
        step_in_struct(builder, place, index);
        return;
    }
    if (type->kind != SHADER_VECTOR && type->kind != SHADER_MATRIX && type->kind != SHADER_ARRAY &&
        (type->kind != SHADER_RUNTIME_ARRAY || place->kind != SHADER_PLACE_BUFFER)) {
        shader_build_refuse(builder, "index %u picks from what has no elements", (unsigned)id);
    }
    if (place->kind == SHADER_PLACE_BUFFER || place->kind == SHADER_PLACE_WORKGROUP) {
        step_in_memory(builder, place, index);
    } else {
        step_in_scalars(builder, place, index);
    }
    place->type = type->element;
}

static void build_access_chain(struct shader_builder *builder)
{
    struct shader_place place = *shader_place_of(builder, shader_operand(builder, 3));
    for (uint32_t i = 4; i < shader_word_count(builder); i++) {
        step(builder, &place, shader_operand(builder, i));
    }
    const struct shader_type *const type = shader_result_type(builder);
    if (type->kind != SHADER_POINTER || type->element != place.type) {
        shader_build_refuse(builder, "the pointer is not of the type of what it points to");
    }
    shader_define_place(builder, &place);
}

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

static void check_candidates(const struct shader_builder *builder, const struct shader_place *place)
{
    uint64_t candidates = place->type->scalars;
    for (uint32_t i = 0; i < place->dynamic_count; i++) {
        candidates *= place->dynamic[i].count;
        if (candidates > MAX_CANDIDATES) {
            shader_build_refuse(builder, "indices that are not constant pick from more than %d numbers",
                                MAX_CANDIDATES);
        }
    }
}

// Memory ---------------------------------------------------------------------------------------------

// Load or store a scalar.
static uint32_t access_word(struct shader_builder *builder, const struct shader_place *place,
                            const uint32_t *value)
{
    const bool is_bool = place->type->kind == SHADER_BOOL;
    if (!is_bool && place->bytes % 4 != 0) {
        shader_build_refuse(builder, "a number of 32 bits does not lie at a multiple of 4 bytes, but at %u",
                            (unsigned)place->bytes);
    }
    if (is_bool && place->kind != SHADER_PLACE_WORKGROUP) {
        shader_build_refuse(builder, "there are no bools in memory that has a layout");
    }
    if (!is_bool && place->type->bits != 32) {
        shader_build_refuse(builder, "memory of %d bits is not supported", place->type->bits);
    }
    const uint32_t offset = place->offset == SHADER_NO_VALUE ? shader_number(builder, 0) : place->offset;
    if (value) {
        return shader_emit_with(builder, SHADER_STORE, place->bytes, place->buffer, offset, *value);
    }
    const uint32_t loaded = shader_emit_with(builder, SHADER_LOAD, place->bytes, place->buffer, offset, 0);
    if (!is_bool) {
        return loaded;
    }
    // A store that an index led astray may have written any bits there. A truth is −1 or 0.
    return shader_emit(builder, SHADER_NOT,
                       shader_emit(builder, SHADER_IEQUAL, loaded, shader_number(builder, 0), 0), 0, 0);
}

// Load or store all scalars of a place, in order.
static void access_memory(struct shader_builder *builder, const struct shader_place *place,
                          uint32_t **scalars, bool stores)
{
    const struct shader_type *const type = place->type;
    if (type->kind == SHADER_INT || type->kind == SHADER_FLOAT || type->kind == SHADER_BOOL) {
        if (stores) {
            (void)access_word(builder, place, *scalars);
        } else {
            **scalars = access_word(builder, place, NULL);
        }
        (*scalars)++;
        return;
    }
    for (uint32_t i = 0; i < type->count; i++) {
        struct shader_place part = *place;
        if (type->kind == SHADER_STRUCT) {
            step_in_struct(builder, &part, shader_number(builder, i));
        } else {
            step_in_memory(builder, &part, shader_number(builder, i));
            part.type = type->element;
        }
        access_memory(builder, &part, scalars, stores);
    }
}

// Read what a place holds into `scalars`.
static void read_place(struct shader_builder *builder, const struct shader_place *place, uint32_t *scalars)
{
    if (place->kind == SHADER_PLACE_BUFFER || place->kind == SHADER_PLACE_WORKGROUP) {
        uint32_t *next = scalars;
        access_memory(builder, place, &next, false);
        return;
    }
    if (place->kind != SHADER_PLACE_HOMES && place->kind != SHADER_PLACE_INPUT) {
        shader_build_refuse(builder, "what is pointed to cannot be loaded");
    }
    check_candidates(builder, place);
    for (uint32_t i = 0; i < place->type->scalars; i++) {
        scalars[i] = read_dynamic(builder, place, 0, place->first + i);
    }
}

static void write_place(struct shader_builder *builder, const struct shader_place *place, uint32_t *scalars)
{
    if (place->is_read_only) {
        shader_build_refuse(builder, "uniform blocks and push constants cannot be stored to");
    }
    if (place->kind == SHADER_PLACE_BUFFER || place->kind == SHADER_PLACE_WORKGROUP) {
        access_memory(builder, place, &scalars, true);
        return;
    }
    if (place->kind != SHADER_PLACE_HOMES) {
        shader_build_refuse(builder, "what is pointed to cannot be stored to");
    }
    check_candidates(builder, place);
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
    read_place(builder, place, scalars);
    shader_define(builder, scalars);
}

void shader_store(struct shader_builder *builder, uint32_t pointer, const struct shader_type *type,
                  uint32_t *scalars)
{
    const struct shader_place *const place = shader_place_of(builder, pointer);
    if (place->type != type || place->is_array_of_resources) {
        shader_build_refuse(builder, "the value is not of the type of what is pointed to");
    }
    write_place(builder, place, scalars);
}

static void build_store(struct shader_builder *builder)
{
    const struct shader_place *const place = shader_place_of(builder, shader_operand(builder, 1));
    const uint32_t id = shader_operand(builder, 2);
    if (place->type != shader_type_of_value(builder, id) || place->is_array_of_resources) {
        shader_build_refuse(builder, "the value is not of the type of what is pointed to");
    }
    uint32_t *const scalars = shader_new_scalars(builder, place->type);
    for (uint32_t i = 0; i < place->type->scalars; i++) {
        scalars[i] = shader_scalars(builder, id)[i];
    }
    write_place(builder, place, scalars);
}

static void build_copy(struct shader_builder *builder)
{
    const struct shader_place *const to = shader_place_of(builder, shader_operand(builder, 1));
    const struct shader_place *const from = shader_place_of(builder, shader_operand(builder, 2));
    if (to->type != from->type || to->is_array_of_resources || from->is_array_of_resources) {
        shader_build_refuse(builder, "the pointers point to other types");
    }
    uint32_t *const scalars = shader_new_scalars(builder, to->type);
    read_place(builder, from, scalars);
    write_place(builder, to, scalars);
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
    case SPIRV_OP_InBoundsAccessChain: build_access_chain(builder); return true;
    case SPIRV_OP_Load: build_load(builder); return true;
    case SPIRV_OP_Store: build_store(builder); return true;
    case SPIRV_OP_CopyMemory: build_copy(builder); return true;
    case SPIRV_OP_ArrayLength: build_array_length(builder); return true;
    case SPIRV_OP_ControlBarrier: build_barrier(builder); return true;
    case SPIRV_OP_MemoryBarrier: return true; // memory is written in the order of the operations
    default: return build_atomic(builder, opcode);
    }
}
