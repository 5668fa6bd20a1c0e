// SPDX-License-Identifier: MIT
// A walk over instructions that trusts nothing: rhw_shader_create tells what is wrong with a module.
#include "shader_words.h"

#include <stdlib.h>
#include <string.h>

enum {
    MAGIC = 0x07230203,
    HEADER_WORDS = 5,
    OP_ENTRY_POINT = 15,
    OP_TYPE_FLOAT = 22,
    OP_SPEC_CONSTANT_TRUE = 48,
    OP_SPEC_CONSTANT_FALSE = 49,
    OP_SPEC_CONSTANT = 50,
    OP_FUNCTION = 54,
    OP_DECORATE = 71,
    SPEC_ID = 1
};

struct cli_shader_words cli_shader_words_of(uint32_t *words, size_t size)
{
    return (struct cli_shader_words){.words = words,
                                     .count = size / sizeof *words,
                                     .is_swapped = size >= sizeof *words && words[0] != MAGIC};
}

static uint32_t word_at(const struct cli_shader_words *words, size_t place)
{
    const uint32_t w = words->words[place];
    return words->is_swapped ? w >> 24 | (w >> 8 & 0xff00) | (w << 8 & 0xff0000) | w << 24 : w;
}

// Find the next instruction at or behind *place of an opcode before functions begin. Return its number of words, or 0.
static size_t find(const struct cli_shader_words *words, uint32_t opcode, size_t *place)
{
    while (*place < words->count) {
        const uint32_t first = word_at(words, *place);
        const size_t count = first >> 16;
        if (count == 0 || count > words->count - *place || (first & 0xffff) == OP_FUNCTION) {
            return 0;
        }
        if ((first & 0xffff) == opcode) {
            return count;
        }
        *place += count;
    }
    return 0;
}

// Return the string of words, by malloc.
static char *string_of(const struct cli_shader_words *words, size_t place, size_t count)
{
    char *const text = calloc(count + 1, sizeof(uint32_t));
    for (size_t i = 0; text && i < 4 * count; i++) {
        text[i] = (char)(word_at(words, place + i / 4) >> 8 * (i % 4) & 0xff);
    }
    return text;
}

char *cli_shader_find_entry(const struct cli_shader_words *words, const char *name,
                            enum rhw_shader_stage *stage)
{
    char *found = NULL;
    size_t count;
    for (size_t place = HEADER_WORDS; (count = find(words, OP_ENTRY_POINT, &place)) > 0; place += count) {
        const uint32_t model = count > 3 ? word_at(words, place + 1) : UINT32_MAX;
        if (model != 0 && model != 4 && model != 5) {
            continue;
        }
        char *const text = string_of(words, place + 3, count - 3);
        const bool is_main = text && strcmp(text, "main") == 0;
        const bool is_better = text && (name ? !found && strcmp(text, name) == 0
                                             : !found || (is_main && strcmp(found, "main") != 0));
        if (!is_better) {
            free(text);
            continue;
        }
        free(found);
        found = text;
        *stage = model == 0 ? RHW_SHADER_VERTEX : model == 4 ? RHW_SHADER_FRAGMENT : RHW_SHADER_COMPUTE;
    }
    return found;
}

// Return whether a type is one of floats.
static bool is_float(const struct cli_shader_words *words, uint32_t type)
{
    size_t count;
    for (size_t place = HEADER_WORDS; (count = find(words, OP_TYPE_FLOAT, &place)) > 0; place += count) {
        if (count > 1 && word_at(words, place + 1) == type) {
            return true;
        }
    }
    return false;
}

// Find the specialization constant that an id is. Return 0 if it is none.
static size_t place_of(const struct cli_shader_words *words, uint32_t target)
{
    for (uint32_t opcode = OP_SPEC_CONSTANT_TRUE; opcode <= OP_SPEC_CONSTANT; opcode++) {
        size_t count;
        for (size_t place = HEADER_WORDS; (count = find(words, opcode, &place)) > 0; place += count) {
            if (count > (opcode == OP_SPEC_CONSTANT ? 3 : 2) && word_at(words, place + 2) == target) {
                return place;
            }
        }
    }
    return 0;
}

// Find the next constant of a SpecId, whose decoration stands at or behind *place. Return 0 if there is none.
static size_t find_constant(const struct cli_shader_words *words, uint32_t id, size_t *place)
{
    size_t count;
    while ((count = find(words, OP_DECORATE, place)) > 0) {
        const bool is_meant =
            count > 3 && word_at(words, *place + 2) == SPEC_ID && word_at(words, *place + 3) == id;
        const size_t found = is_meant ? place_of(words, word_at(words, *place + 1)) : 0;
        *place += count;
        if (found > 0) {
            return found;
        }
    }
    return 0;
}

enum cli_shader_constant_kind cli_shader_find_constant(const struct cli_shader_words *words, uint32_t id)
{
    size_t place = HEADER_WORDS;
    const size_t found = find_constant(words, id, &place);
    return found == 0                                             ? CLI_CONSTANT_ABSENT
           : (word_at(words, found) & 0xffff) != OP_SPEC_CONSTANT ? CLI_CONSTANT_BOOL
           : is_float(words, word_at(words, found + 1))           ? CLI_CONSTANT_FLOAT
                                                                  : CLI_CONSTANT_INT;
}

static void put_word(const struct cli_shader_words *words, size_t place, uint32_t word)
{
    words->words[place] = word;
    words->words[place] = word_at(words, place); // the order of bytes of the module
}

void cli_shader_set_constant(const struct cli_shader_words *words, uint32_t id, uint32_t value)
{
    size_t found;
    for (size_t place = HEADER_WORDS; (found = find_constant(words, id, &place)) > 0;) {
        const uint32_t first = word_at(words, found);
        if ((first & 0xffff) == OP_SPEC_CONSTANT) {
            put_word(words, found + 3, value);
        } else {
            put_word(words, found,
                     (first & 0xffff0000) | (value != 0 ? OP_SPEC_CONSTANT_TRUE : OP_SPEC_CONSTANT_FALSE));
        }
    }
}
