// SPDX-License-Identifier: MIT
// The instructions that are known, and whether their words are those that the grammar asks for.
#include "module.h"

struct known_instruction {
    const char *name, *operands;
    uint16_t number;
};

#define INSTRUCTION(name, number, operands) {#name, operands, number},
static const struct known_instruction known_instructions[] = {
#include "grammar.inc"
};
#undef INSTRUCTION

enum { KNOWN_COUNT = sizeof known_instructions / sizeof *known_instructions };

// The table is in the order of numbers.
static const struct known_instruction *find_instruction(uint32_t opcode)
{
    size_t low = 0, high = KNOWN_COUNT;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (known_instructions[middle].number < opcode) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < KNOWN_COUNT && known_instructions[low].number == opcode ? &known_instructions[low] : NULL;
}

const char *shader_instruction_name(uint32_t opcode)
{
    const struct known_instruction *const known = find_instruction(opcode);
    return known ? known->name : "an unknown instruction";
}

const char *shader_instruction_operands(uint32_t opcode)
{
    const struct known_instruction *const known = find_instruction(opcode);
    return known ? known->operands : NULL;
}

// Operands -------------------------------------------------------------------------------------------

// The operands of one instruction as they are checked.
struct operand_reader {
    const struct shader_module *module;
    uint32_t word, next, end; // the instruction, its next operand, and behind the last
};

static uint32_t take_word(struct operand_reader *reader)
{
    if (reader->next >= reader->end) {
        shader_refuse(reader->module, reader->word, "an operand is missing");
    }
    return reader->module->words[reader->next++];
}

static void check_id(struct operand_reader *reader)
{
    const uint32_t id = take_word(reader);
    if (id == 0 || id >= reader->module->bound) {
        shader_refuse(reader->module, reader->word, "%u is no id below the bound of %u", (unsigned)id,
                      (unsigned)reader->module->bound);
    }
}

static void check_string(struct operand_reader *reader)
{
    for (;;) {
        const uint32_t word = take_word(reader);
        if ((word & 0xff) == 0 || (word & 0xff00) == 0 || (word & 0xff0000) == 0 || (word >> 24) == 0) {
            return;
        }
    }
}

static void check_memory_access(struct operand_reader *reader)
{
    const uint32_t mask = take_word(reader);
    if (mask & ~7u) {
        shader_refuse(reader->module, reader->word, "memory access 0x%x is not supported", (unsigned)mask);
    }
    if (mask & 2) {
        (void)take_word(reader); // alignment
    }
}

static void check_image_operands(struct operand_reader *reader)
{
    const uint32_t mask = take_word(reader);
    if (mask >= 0x100) {
        shader_refuse(reader->module, reader->word, "image operands 0x%x are not supported", (unsigned)mask);
    }
    for (uint32_t bit = 1; bit <= SPIRV_IMAGE_MIN_LOD; bit <<= 1) {
        for (int i = 0; (mask & bit) && i < (bit == SPIRV_IMAGE_GRAD ? 2 : 1); i++) {
            check_id(reader);
        }
    }
}

static void check_operand(struct operand_reader *reader, char letter)
{
    switch (letter) {
    case 'T':
    case 'R':
    case 'i': check_id(reader); break;
    case 's': check_string(reader); break;
    case 'm': check_memory_access(reader); break;
    case 'g': check_image_operands(reader); break;
    case 'p':
        check_id(reader);
        check_id(reader);
        break;
    case 'w':
        (void)take_word(reader);
        check_id(reader);
        break;
    case 'q':
        check_id(reader);
        (void)take_word(reader);
        break;
    case 'd':
    case 'x':
    case 'u':
    case 'o': // one number, and as many operands as it asks for: whoever reads them checks them
        (void)take_word(reader);
        reader->next = reader->end;
        break;
    default: (void)take_word(reader); break;
    }
}

void shader_check_words(const struct shader_module *module, uint32_t word, const char *operands)
{
    struct operand_reader reader = {module, word, word + 1, word + (module->words[word] >> 16)};
    for (const char *letter = operands; *letter != '\0'; letter++) {
        const char quantifier = letter[1] == '?' || letter[1] == '*' ? letter[1] : '\0';
        if (quantifier == '\0') {
            check_operand(&reader, *letter);
            continue;
        }
        while (reader.next < reader.end) {
            check_operand(&reader, *letter);
            if (quantifier == '?') {
                break;
            }
        }
        letter++;
    }
    if (reader.next != reader.end) {
        shader_refuse(module, word, "it has %u words too many", (unsigned)(reader.end - reader.next));
    }
}
