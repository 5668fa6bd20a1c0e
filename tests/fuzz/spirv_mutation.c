// SPDX-License-Identifier: MIT
// See spirv_mutation.h.
#include "spirv_mutation.h"

#include <string.h>

struct known_instruction {
    const char *operands; // letters of script/spirv-grammar
    uint32_t opcode;
};

#define INSTRUCTION(name, number, operands) {operands, number},
static const struct known_instruction known[] = {
#include "module/grammar.inc"
};
#undef INSTRUCTION

enum { HEADER = 5, MAX_INSTRUCTIONS = 1 << 13, MAX_OPERANDS = 24, KNOWN = sizeof known / sizeof *known };

uint32_t spirv_pick(uint64_t *state, uint32_t count)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (uint32_t)((z ^ (z >> 31)) % count);
}

static uint32_t extreme(uint64_t *state)
{
    static const uint32_t numbers[] = {
        0,    1,      2,    3,     4,          7,          8,          16,         31,         32,  33, 64,
        0xff, 0xffff, 1024, 65536, 0x3f800000, 0x7f800000, 0x7fc00000, 0x7fffffff, 0x80000000, ~3u, ~0u};
    return numbers[spirv_pick(state, sizeof numbers / sizeof *numbers)];
}

// Instructions ---------------------------------------------------------------------------------------

// Find where instructions begin. Return how many there are.
static uint32_t list(const struct spirv_words *module, uint32_t *begins)
{
    uint32_t count = 0;
    for (size_t at = HEADER; at < module->count && count < MAX_INSTRUCTIONS;) {
        const uint32_t length = module->words[at] >> 16;
        begins[count++] = (uint32_t)at;
        at += length == 0 ? module->count : length;
    }
    return count;
}

static uint32_t length_at(const struct spirv_words *module, uint32_t at)
{
    const uint32_t length = module->words[at] >> 16, left = (uint32_t)(module->count - at);
    return length < 1 ? 1 : length > left ? left : length;
}

static const struct known_instruction *find_known(uint32_t opcode)
{
    for (size_t i = 0; i < KNOWN; i++) {
        if (known[i].opcode == opcode) {
            return &known[i];
        }
    }
    return &known[0];
}

static void remove_words(struct spirv_words *module, uint32_t at, uint32_t count)
{
    memmove(module->words + at, module->words + at + count, (module->count - at - count) * sizeof(uint32_t));
    module->count -= count;
}

static void insert_words(struct spirv_words *module, uint32_t at, const uint32_t *words, uint32_t count)
{
    if (module->count + count > SPIRV_MUTATION_ROOM) {
        return;
    }
    memmove(module->words + at + count, module->words + at, (module->count - at) * sizeof(uint32_t));
    memcpy(module->words + at, words, count * sizeof(uint32_t));
    module->count += count;
}

// Return an id of the module: any, or one that the word beside an existing operand names.
static uint32_t some_id(uint64_t *state, const struct spirv_words *module)
{
    const uint32_t bound = module->words[3] < 2 || module->words[3] > 1 << 20 ? 2 : module->words[3];
    if (spirv_pick(state, 3) != 0 || module->count <= HEADER) {
        return 1 + spirv_pick(state, bound - 1);
    }
    return module->words[HEADER + spirv_pick(state, (uint32_t)module->count - HEADER)];
}

// Make an instruction whose operands are of the kinds that its grammar asks for. Return its words.
static uint32_t make(uint64_t *state, struct spirv_words *module, uint32_t *words)
{
    const struct known_instruction *const instruction = &known[spirv_pick(state, KNOWN)];
    uint32_t count = 1;
    for (const char *letter = instruction->operands; *letter != '\0' && count < MAX_OPERANDS; letter++) {
        const char quantifier = letter[1] == '?' || letter[1] == '*' ? letter[1] : '\0';
        uint32_t repeats = quantifier == '*'   ? spirv_pick(state, 5)
                           : quantifier == '?' ? spirv_pick(state, 2)
                                               : 1;
        for (; repeats > 0 && count < MAX_OPERANDS; repeats--) {
            switch (*letter) {
            case 'R': words[count++] = module->words[3]++; break;
            case 'T':
            case 'i': words[count++] = some_id(state, module); break;
            case 's': words[count++] = 0x6e; break;
            default: words[count++] = spirv_pick(state, 2) ? spirv_pick(state, 5) : extreme(state); break;
            }
        }
        letter += quantifier != '\0';
    }
    words[0] = count << 16 | instruction->opcode;
    return count;
}

// Changes --------------------------------------------------------------------------------------------

static void change_operand(uint64_t *state, struct spirv_words *module, uint32_t at)
{
    const uint32_t length = length_at(module, at);
    if (length < 2) {
        return;
    }
    uint32_t *const word = &module->words[at + 1 + spirv_pick(state, length - 1)];
    switch (spirv_pick(state, 5)) {
    case 0: *word = extreme(state); break;
    case 1: *word += spirv_pick(state, 2) ? 1 : ~0u; break;
    case 2: *word ^= 1u << spirv_pick(state, 32); break;
    default: *word = some_id(state, module); break;
    }
}

// Give an instruction another opcode: one that takes the same operands, or any.
static void change_opcode(uint64_t *state, struct spirv_words *module, uint32_t at)
{
    const char *const operands = find_known(module->words[at] & 0xffff)->operands;
    const uint32_t first = spirv_pick(state, KNOWN);
    for (uint32_t i = 0; i < KNOWN; i++) {
        const struct known_instruction *const other = &known[(first + i) % KNOWN];
        if (strcmp(other->operands, operands) == 0 || spirv_pick(state, 200) == 0) {
            module->words[at] = (module->words[at] & 0xffff0000) | other->opcode;
            return;
        }
    }
}

// Give an instruction a word more or less, with its length told or not.
static void change_length(uint64_t *state, struct spirv_words *module, uint32_t at)
{
    const uint32_t length = length_at(module, at), place = at + spirv_pick(state, length) + 1;
    const uint32_t word = some_id(state, module);
    const uint32_t kind = spirv_pick(state, 8);
    if (kind == 0) {
        module->words[at] ^= 0x10000u << spirv_pick(state, 8);
    } else if (kind < 4 && length > 1) {
        remove_words(module, place - 1 > at ? place - 1 : at + 1, 1);
        module->words[at] -= 0x10000;
    } else {
        insert_words(module, place, &word, 1);
        module->words[at] += 0x10000;
    }
}

static void copy_instruction(struct spirv_words *module, uint32_t to, const struct spirv_words *from,
                             uint32_t at)
{
    uint32_t copy[MAX_OPERANDS];
    const uint32_t length = length_at(from, at);
    if (length <= MAX_OPERANDS) {
        memcpy(copy, from->words + at, length * sizeof(uint32_t));
        insert_words(module, to, copy, length);
    }
}

static void mutate_once(uint64_t *state, struct spirv_words *module, const struct spirv_words *other)
{
    static uint32_t begins[MAX_INSTRUCTIONS], others[MAX_INSTRUCTIONS];
    uint32_t words[MAX_OPERANDS];
    const uint32_t count = list(module, begins);
    if (count == 0) {
        return;
    }
    const uint32_t at = begins[spirv_pick(state, count)], to = begins[spirv_pick(state, count)];
    switch (spirv_pick(state, 16)) {
    case 0: remove_words(module, at, length_at(module, at)); break;
    case 1: copy_instruction(module, to, module, at); break;
    case 2: { // move it
        const uint32_t length = length_at(module, at);
        const size_t before = module->count;
        copy_instruction(module, to, module, at);
        if (module->count > before) {
            remove_words(module, at < to ? at : at + length, length);
        }
        break;
    }
    case 3: change_length(state, module, at); break;
    case 4:
    case 5: change_opcode(state, module, at); break;
    case 6: {
        const uint32_t other_count = list(other, others);
        if (other_count > 0) {
            copy_instruction(module, to, other, others[spirv_pick(state, other_count)]);
        }
        break;
    }
    case 7:
    case 8: insert_words(module, to, words, make(state, module, words)); break;
    case 9:
        if (spirv_pick(state, 8) == 0) {
            module->count = HEADER + spirv_pick(state, (uint32_t)module->count - HEADER);
        }
        if (spirv_pick(state, 8) == 0) {
            const uint32_t word =
                spirv_pick(state, HEADER); // compilers choose the order within an assignment
            module->words[word] = extreme(state);
        }
        break;
    default: change_operand(state, module, at); break;
    }
}

void spirv_mutate(uint64_t *state, struct spirv_words *module, const struct spirv_words *other)
{
    do {
        if (module->count > HEADER) {
            mutate_once(state, module, other);
        }
    } while (spirv_pick(state, 3) != 0);
}

// A module of the grammar ----------------------------------------------------------------------------

static void put(struct spirv_words *module, const uint32_t *words, uint32_t count)
{
    insert_words(module, (uint32_t)module->count, words, count);
}

void spirv_generate(uint64_t *state, struct spirv_words *module)
{
    // Capability Shader, memory model, and %1 as "main" of compute with types and constants that random operands meet.
    static const uint32_t frame[] = {
        0x07230203, 0x10300, 0,       32,      0, // header
        0x20011,    1,       0x3000e, 0,       1,       0x5000f, 5,       1,
        0x6e69616d, 0,                                     // Capability, MemoryModel, EntryPoint
        0x60010,    1,       17,      8,       1,       1, // ExecutionMode LocalSize
        0x40047,    13,      34,      0,       0x40047, 13,      33,      0,
        0x30047,    11,      2, // set and binding of %13, Block of %11
        0x50048,    11,      0,       35,      0,       0x40047, 10,      6,
        4,                                                          // Offset 0, ArrayStride 4
        0x20013,    2,       0x30021, 3,       2,       0x20014, 4, // void, function, bool
        0x40015,    5,       32,      0,       0x30016, 6,       32,      0x40017,
        7,          6,       4,                                                       // uint, float, vec4
        0x4002b,    5,       8,       0,       0x4002b, 6,       9,       0x3f800000, // 0, 1.0
        0x3001d,    10,      5,       0x3001e, 11,      10,      0x40020, 12,
        12,         11, // array, structure, pointer
        0x4003b,    12,      13,      12,      0x40020, 14,      12,      5,
        0x40020,    15,      7,       7, // variable, pointers
        0x30029,    4,       16,      0x7002c, 7,       17,      9,       9,
        9,          9, // true, vec4
        0x50036,    2,       1,       0,       3,       0x200f8, 18,      0x4003b,
        15,         19,      7, // function, label, variable
    };
    static const uint32_t end[] = {0x100fd, 0x10038};
    uint32_t words[MAX_OPERANDS];
    module->count = 0;
    put(module, frame, sizeof frame / sizeof *frame);
    for (uint32_t rest = spirv_pick(state, 40); rest > 0; rest--) {
        put(module, words, make(state, module, words));
    }
    put(module, end, 2);
}
