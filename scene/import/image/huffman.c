// SPDX-License-Identifier: MIT
// Codes are told bit by bit: the number of codes of each length says whether one has ended. No table for each prefix is
// needed, and textures are small beside the time that drawing them takes.
#include "huffman.h"

#include <string.h>

struct scene_bits scene_bits_open(const uint8_t *bytes, size_t size)
{
    return (struct scene_bits){.bytes = bytes, .size = size};
}

uint32_t scene_bits_take(struct scene_bits *bits, unsigned count)
{
    while (bits->count < count) {
        const bool inside = bits->next < bits->size;
        bits->failed |= !inside;
        bits->window |= (uint64_t)(inside ? bits->bytes[bits->next++] : 0) << bits->count;
        bits->count += 8;
    }
    const uint32_t value = (uint32_t)(bits->window & (((uint64_t)1 << count) - 1));
    bits->window >>= count;
    bits->count -= count;
    return value;
}

// Build a code. Fail where the lengths give more codes than there are. Fewer codes are fine, but must not be met.
static void build(struct scene_bits *bits, const uint8_t *length, uint32_t symbols,
                  struct scene_huffman *code)
{
    memset(code, 0, sizeof *code);
    for (uint32_t i = 0; i < symbols; i++) {
        code->count[length[i]]++;
    }
    code->count[0] = 0;
    uint32_t first[SCENE_HUFFMAN_LENGTHS] = {0}, free_codes = 1;
    for (int i = 1; i < SCENE_HUFFMAN_LENGTHS; i++) {
        first[i] = first[i - 1] + code->count[i - 1];
        free_codes *= 2;
        if (free_codes < code->count[i]) {
            bits->failed = true;
            memset(code, 0, sizeof *code);
            return;
        }
        free_codes -= code->count[i];
    }
    for (uint32_t i = 0; i < symbols; i++) {
        if (length[i] != 0) {
            code->symbols[first[length[i]]++] = (uint16_t)i;
        }
    }
}

uint32_t scene_huffman_take(struct scene_bits *bits, const struct scene_huffman *code)
{
    uint32_t value = 0, first = 0,
             // The code up to here, the first code of its length, and the index of that first one.
        index = 0;
    for (int length = 1; length < SCENE_HUFFMAN_LENGTHS; length++) {
        value |= scene_bits_take(bits, 1);
        const uint32_t count = code->count[length];
        if (value - first < count) {
            return code->symbols[index + value - first];
        }
        index += count;
        first = (first + count) << 1;
        value <<= 1;
    }
    bits->failed = true;
    return 0;
}

// Lengths are symbols of a code of their own, with runs of zeros and of the length before.
enum { LENGTH_SYMBOLS = 21, SHORT_ZEROS = 17, LONG_ZEROS, SHORT_REPEAT, LONG_REPEAT };

static void read_length_code(struct scene_bits *bits, struct scene_huffman *code)
{
    static const uint8_t order[LENGTH_SYMBOLS] = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                  11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
    uint8_t length[LENGTH_SYMBOLS] = {0};
    const uint32_t count = scene_bits_take(bits, 5);
    bits->failed |= count < 1 || count > LENGTH_SYMBOLS;
    for (uint32_t i = 0; i < count && i < LENGTH_SYMBOLS; i++) {
        length[order[i]] = (uint8_t)scene_bits_take(bits, 3);
    }
    build(bits, length, LENGTH_SYMBOLS, code);
}

// Take how often the length that `symbol` stands for follows.
static uint32_t take_run(struct scene_bits *bits, uint32_t symbol)
{
    switch (symbol) {
    case SHORT_ZEROS: return scene_bits_take(bits, 3) + 3;
    case LONG_ZEROS: return scene_bits_take(bits, 7) + 11;
    case SHORT_REPEAT: return scene_bits_take(bits, 2) + 3;
    case LONG_REPEAT: return scene_bits_take(bits, 7) + 7;
    default: return 1;
    }
}

void scene_huffman_read(struct scene_bits *bits, struct scene_huffman *code)
{
    uint8_t length[SCENE_HUFFMAN_SYMBOLS] = {0};
    const uint32_t symbols = scene_bits_take(bits, 14);
    if (symbols == 0) { // the code is not used
        memset(code, 0, sizeof *code);
        return;
    }
    read_length_code(bits, code);
    for (uint32_t i = 0; i < symbols && !bits->failed;) {
        const uint32_t symbol = scene_huffman_take(bits, code);
        const uint32_t run = take_run(bits, symbol);
        const bool repeats = symbol >= SHORT_REPEAT;
        if (run > symbols - i || (repeats && (i == 0 || length[i - 1] == 0))) {
            bits->failed = true;
            break;
        }
        const uint8_t value = repeats ? length[i - 1] : symbol < SHORT_ZEROS ? (uint8_t)symbol : 0;
        memset(length + i, value, run);
        i += run;
    }
    build(bits, length, symbols, code);
}
