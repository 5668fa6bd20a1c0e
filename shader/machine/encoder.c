// SPDX-License-Identifier: MIT
// See encoder.h. Formats are those of Intel's manual, volume 2: VEX in 2.3, REX in 2.2.1, ModRM and SIB in 2.1.
#include "encoder.h"

#include <string.h>

enum {
    LONGEST = 16, // bytes of an instruction, and one more
    FIRST_ROOM = 4096,
    NO_PLACE = -1,
    POOL_ALIGNMENT = 32
};

// Values of the fields `pp` and `mmmmm` of VEX.
enum prefix { PREFIX_NONE, PREFIX_66, PREFIX_F3 };
enum map { MAP_0F = 1, MAP_0F38, MAP_0F3A };

static const struct x86_encoding encodings[X86_INSTRUCTIONS] = {
#define VEX(name, prefix, map, opcode, shape, digit) \
    [X86_##name] = {#name, true, PREFIX_##prefix, MAP_##map, opcode, X86_##shape, digit},
#define INT(name, opcode, shape, digit) [X86_##name] = {#name, false, 0, 0, opcode, X86_##shape, digit},
#include "instruction.inc"
#undef VEX
#undef INT
};

const struct x86_encoding *shader_encoding_of(uint32_t instruction)
{
    return &encodings[instruction & 0xff];
}

struct shader_fix {
    uint32_t place;  // displacement of 4 bytes
    uint32_t from;   // where the instruction ends
    uint32_t target; // label, or number of the constant
    bool is_constant;
};

// Bytes ----------------------------------------------------------------------------------------------

void shader_encoder_init(struct shader_encoder *encoder, struct shader_memory *memory)
{
    memset(encoder, 0, sizeof *encoder);
    encoder->memory = memory;
    encoder->room = FIRST_ROOM;
    encoder->bytes = shader_take(memory, FIRST_ROOM, 1);
}

static void reserve(struct shader_encoder *encoder, size_t size)
{
    while (encoder->room - encoder->size < size) {
        encoder->bytes = shader_grow(encoder->memory, encoder->bytes, &encoder->room, 1);
    }
}

// Append the lowest `count` bytes of a number. There is room.
static void put(struct shader_encoder *encoder, uint64_t number, int count)
{
    for (int i = 0; i < count; i++) {
        encoder->bytes[encoder->size++] = (uint8_t)(number >> (8 * i));
    }
}

static void record(struct shader_encoder *encoder, unsigned instruction, int reg, int source,
                   struct x86_operand rm, int32_t immediate)
{
    if (!encoder->has_records) {
        return;
    }
    if (encoder->record_count == encoder->record_room) {
        encoder->records =
            shader_grow(encoder->memory, encoder->records, &encoder->record_room, sizeof *encoder->records);
    }
    encoder->records[encoder->record_count++] = (struct shader_record){
        (uint32_t)encoder->size, instruction, (int8_t)reg, (int8_t)source, rm, immediate};
}

static bool is_byte(int32_t number)
{
    return number >= INT8_MIN && number <= INT8_MAX;
}

static unsigned high(int reg)
{
    return reg >= 8 ? 1 : 0;
}

// Fixes ----------------------------------------------------------------------------------------------

// Append a displacement that is filled in later. `behind` bytes of the instruction follow it.
static void put_fix(struct shader_encoder *encoder, bool is_constant, uint32_t target, int behind)
{
    if (encoder->fix_count == encoder->fix_room) {
        encoder->fixes =
            shader_grow(encoder->memory, encoder->fixes, &encoder->fix_room, sizeof *encoder->fixes);
    }
    const uint32_t place = (uint32_t)encoder->size;
    encoder->fixes[encoder->fix_count++] =
        (struct shader_fix){place, place + 4 + (uint32_t)behind, target, is_constant};
    put(encoder, 0, 4);
}

// Operands -------------------------------------------------------------------------------------------

// Append ModRM, SIB and displacement. `behind` bytes of the instruction follow them.
static void put_operand(struct shader_encoder *encoder, int reg, struct x86_operand rm, int behind)
{
    const unsigned field = (unsigned)(reg & 7) << 3, base = (unsigned)(rm.base & 7);
    if (rm.reg >= 0) {
        put(encoder, 0xc0 | field | (unsigned)(rm.reg & 7), 1);
        return;
    }
    if (rm.base < 0) {
        put(encoder, field | 5, 1);
        put_fix(encoder, true, (uint32_t)rm.offset, behind);
        return;
    }
    // A base of rbp or r13 without a displacement would mean something else.
    const unsigned mode = rm.offset == 0 && base != X86_RBP ? 0 : is_byte(rm.offset) ? 1 : 2;
    if (rm.index >= 0 || base == X86_RSP) {
        const unsigned index = rm.index >= 0 ? (unsigned)(rm.index & 7) : X86_RSP; // rsp stands for none
        put(encoder, mode << 6 | field | 4, 1);
        put(encoder, (unsigned)rm.shift << 6 | index << 3 | base, 1);
    } else {
        put(encoder, mode << 6 | field | base, 1);
    }
    put(encoder, (uint32_t)rm.offset, mode == 0 ? 0 : mode == 1 ? 1 : 4);
}

// Bits above the three of ModRM and SIB, as REX has them.
static unsigned high_bits(int reg, struct x86_operand rm)
{
    return high(reg) << 2 | (rm.reg < 0 ? high(rm.index) : 0) << 1 | high(rm.reg >= 0 ? rm.reg : rm.base);
}

// Instructions ---------------------------------------------------------------------------------------

static void put_vex(struct shader_encoder *encoder, const struct x86_encoding *encoding, unsigned bits,
                    int vector, unsigned flags)
{
    const unsigned length = flags & X86_NARROW ? 0 : 1;
    const unsigned last = (~(unsigned)vector & 15) << 3 | length << 2 | encoding->prefix;
    if (encoding->map == MAP_0F && (bits & 3) == 0) {
        put(encoder, 0xc5, 1);
        put(encoder, (~bits & 4) << 5 | last, 1);
    } else {
        put(encoder, 0xc4, 1);
        put(encoder, (~bits & 7) << 5 | encoding->map, 1);
        put(encoder, last, 1);
    }
    put(encoder, encoding->opcode, 1);
}

static void encode_vex(struct shader_encoder *encoder, const struct x86_encoding *encoding, unsigned flags,
                       int reg, int source, struct x86_operand rm, int32_t immediate)
{
    const unsigned shape = encoding->shape;
    const bool has_immediate = shape >= X86_VMI && shape <= X86_RVMR;
    const int vector = shape == X86_VMI ? reg : shape >= X86_RVMI && shape <= X86_RXV ? source : 0;
    const int field = shape == X86_VMI ? encoding->digit : reg;
    put_vex(encoder, encoding, high_bits(field, rm), vector, flags);
    if (shape == X86_NO_OPERANDS) {
        return;
    }
    put_operand(encoder, field, rm, has_immediate ? 1 : 0);
    if (has_immediate) {
        put(encoder, (uint32_t)immediate << (shape == X86_RVMR ? 4 : 0), 1);
    }
}

static void encode_integer(struct shader_encoder *encoder, const struct x86_encoding *encoding,
                           unsigned flags, int reg, struct x86_operand rm, int32_t immediate)
{
    const unsigned shape = encoding->shape;
    const bool has_digit = shape >= X86_M && shape <= X86_ML, has_modrm = shape < X86_O;
    const bool has_number = shape == X86_MN || shape == X86_RMN;
    const bool is_short = has_number && is_byte(immediate);
    const int width = shape == X86_MI || is_short ? 1 : has_number || shape == X86_ML ? 4 : 0;
    const int field = has_digit ? encoding->digit : reg;
    const unsigned rex = (flags & X86_WIDE ? 8u : 0u) | (has_modrm ? high_bits(field, rm) : high(reg));
    if (rex != 0) {
        put(encoder, 0x40 | rex, 1);
    }
    if (!has_modrm) {
        put(encoder, encoding->opcode | (unsigned)(reg & 7), 1);
        return;
    }
    put(encoder, encoding->opcode | (is_short ? 2u : 0u), 1);
    put_operand(encoder, field, rm, width);
    put(encoder, (uint32_t)immediate, width);
}

void shader_encode(struct shader_encoder *encoder, unsigned instruction, int reg, int source,
                   struct x86_operand rm, int32_t immediate)
{
    const struct x86_encoding *const encoding = shader_encoding_of(instruction);
    record(encoder, instruction, reg, source, rm, immediate);
    reserve(encoder, LONGEST);
    if (encoding->is_vex) {
        encode_vex(encoder, encoding, instruction & ~0xffu, reg, source, rm, immediate);
    } else {
        encode_integer(encoder, encoding, instruction & ~0xffu, reg, rm, immediate);
    }
}

void shader_encode_number(struct shader_encoder *encoder, int reg, uint64_t number)
{
    const unsigned low = (unsigned)(reg & 7);
    record(encoder, X86_NUMBER, reg, 0, x86_at(0, (int32_t)(uint32_t)number),
           (int32_t)(uint32_t)(number >> 32));
    reserve(encoder, LONGEST);
    if (number > UINT32_MAX) {
        put(encoder, 0x48 | high(reg), 1);
    } else if (reg >= 8) {
        put(encoder, 0x41, 1);
    }
    put(encoder, 0xb8 | low, 1);
    put(encoder, number, number > UINT32_MAX ? 8 : 4);
}

// Labels ---------------------------------------------------------------------------------------------

uint32_t shader_label_new(struct shader_encoder *encoder)
{
    if (encoder->label_count == encoder->label_room) {
        encoder->labels =
            shader_grow(encoder->memory, encoder->labels, &encoder->label_room, sizeof *encoder->labels);
    }
    encoder->labels[encoder->label_count] = (uint32_t)NO_PLACE;
    return encoder->label_count++;
}

void shader_label_place(struct shader_encoder *encoder, uint32_t label)
{
    record(encoder, X86_LABEL, 0, 0, x86_reg(0), (int32_t)label);
    encoder->labels[label] = (uint32_t)encoder->size;
}

// Append a jump: the opcode for a distance of 1 byte, or that of 4 bytes, which may take two.
static void encode_jump(struct shader_encoder *encoder, unsigned short_opcode, unsigned long_opcode,
                        uint32_t label)
{
    const int condition = long_opcode > 0xff ? (int)(short_opcode & 15) : -1;
    record(encoder, X86_JUMP, condition, 0, x86_reg(0), (int32_t)label);
    reserve(encoder, LONGEST);
    const int64_t distance = (int64_t)encoder->labels[label] - (int64_t)(encoder->size + 2);
    if (encoder->labels[label] != (uint32_t)NO_PLACE && distance >= INT8_MIN) {
        put(encoder, short_opcode, 1);
        put(encoder, (uint64_t)distance, 1);
        return;
    }
    put(encoder, long_opcode, long_opcode > 0xff ? 2 : 1);
    put_fix(encoder, false, label, 0);
}

void shader_encode_jump(struct shader_encoder *encoder, uint32_t label)
{
    encode_jump(encoder, 0xeb, 0xe9, label);
}

void shader_encode_jump_if(struct shader_encoder *encoder, enum x86_condition condition, uint32_t label)
{
    encode_jump(encoder, 0x70u | condition, 0x800fu | (unsigned)condition << 8, label);
}

// Constants ------------------------------------------------------------------------------------------

static uint32_t hash(const uint32_t words[8], unsigned size)
{
    uint32_t sum = size;
    for (unsigned i = 0; i < size / 4; i++) {
        sum = (sum ^ words[i]) * 0x9e3779b1u;
    }
    return sum >> 24;
}

struct x86_operand shader_pool_bytes(struct shader_encoder *encoder, const void *bytes, unsigned size)
{
    struct shader_pool_constant constant = {.size = size};
    memcpy(constant.words, bytes, size);
    uint32_t *const head = &encoder->constant_heads[hash(constant.words, size)];
    uint32_t number = *head;
    while (number != 0) {
        const struct shader_pool_constant *const other = &encoder->constants[number - 1];
        if (other->size == size && memcmp(other->words, constant.words, size) == 0) {
            return x86_at(-1, (int32_t)(number - 1));
        }
        number = other->next;
    }
    if (encoder->constant_count == encoder->constant_room) {
        encoder->constants = shader_grow(encoder->memory, encoder->constants, &encoder->constant_room,
                                         sizeof *encoder->constants);
    }
    constant.next = *head;
    encoder->constants[encoder->constant_count++] = constant;
    *head = encoder->constant_count;
    return x86_at(-1, (int32_t)(encoder->constant_count - 1));
}

struct x86_operand shader_pool_scalar(struct shader_encoder *encoder, uint32_t bits)
{
    return shader_pool_bytes(encoder, &bits, sizeof bits);
}

struct x86_operand shader_pool_splat(struct shader_encoder *encoder, uint32_t bits)
{
    const uint32_t lanes[8] = {bits, bits, bits, bits, bits, bits, bits, bits};
    return shader_pool_bytes(encoder, lanes, sizeof lanes);
}

// The larger ones come first, so that each lies at a multiple of its size.
static void put_pool(struct shader_encoder *encoder)
{
    while (encoder->constant_count > 0 && encoder->size % POOL_ALIGNMENT != 0) {
        reserve(encoder, 1);
        put(encoder, 0xcc, 1); // a trap
    }
    encoder->pool = (uint32_t)encoder->size;
    static const uint32_t sizes[] = {32, 8, 4};
    for (int s = 0; s < 3; s++) {
        for (uint32_t i = 0; i < encoder->constant_count; i++) {
            struct shader_pool_constant *const constant = &encoder->constants[i];
            if (constant->size == sizes[s]) {
                reserve(encoder, constant->size);
                constant->place = (uint32_t)encoder->size;
                memcpy(encoder->bytes + encoder->size, constant->words, constant->size);
                encoder->size += constant->size;
            }
        }
    }
}

// The whole ------------------------------------------------------------------------------------------

void shader_encode_mark(struct shader_encoder *encoder, uint32_t node)
{
    const uint32_t place = (uint32_t)encoder->size;
    if (encoder->mark_count > 0 && encoder->marks[encoder->mark_count - 1].place == place) {
        encoder->mark_count--;
    }
    if (encoder->mark_count == encoder->mark_room) {
        encoder->marks =
            shader_grow(encoder->memory, encoder->marks, &encoder->mark_room, sizeof *encoder->marks);
    }
    encoder->marks[encoder->mark_count++] = (struct shader_code_mark){place, node};
}

size_t shader_encoder_finish(struct shader_encoder *encoder)
{
    encoder->code_size = (uint32_t)encoder->size;
    put_pool(encoder);
    for (uint32_t i = 0; i < encoder->fix_count; i++) {
        const struct shader_fix *const fix = &encoder->fixes[i];
        const uint32_t target =
            fix->is_constant ? encoder->constants[fix->target].place : encoder->labels[fix->target];
        const uint32_t distance = target - fix->from;
        memcpy(encoder->bytes + fix->place, &distance, sizeof distance);
    }
    return encoder->code_size;
}
