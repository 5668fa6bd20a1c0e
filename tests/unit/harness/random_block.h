// SPDX-License-Identifier: MIT
// Random blocks of compressed formats, helped towards what chance alone seldom meets. The stored hashes of
// test_block_formats are of these: a change here asks for new ones, after blocks_peer has confirmed them.
#ifndef RANDOM_BLOCK_H
#define RANDOM_BLOCK_H

#include <stdint.h>
#include <string.h>

#include "rhw/rhw.h"

// SplitMix64.
static inline uint64_t random_word(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

// Modes of BC7 are told by the lowest bit that is set: each one as often.
static inline void help_bc7(uint64_t choice, unsigned char *block)
{
    const int mode = (int)(choice % 9);
    block[0] = (unsigned char)((block[0] & (0xff00 >> (8 - mode) << 1)) | (mode < 8 ? 1 << mode : 0));
}

// One in 16 of one colour: of any rectangle, of all coordinates, or of high dynamic range. Their reserved bits are set:
// the peer does not look at them.
static inline void help_astc(uint64_t choice, unsigned char *block)
{
    if (choice % 16 == 0) {
        block[0] = 0xfc;
        block[1] = (unsigned char)((block[1] & 0xf0) | (choice & 0x30 ? 0x0d : 0x0f));
        if (choice & 0x40) {
            block[1] |= 0xf0;
            memset(block + 2, 0xff, 6);
        }
    }
    if (block[0] == 0xfc && (block[1] & 1) != 0) {
        block[1] |= 0x0c;
    }
}

static inline void random_block(enum rhw_format format, uint64_t *state, unsigned char *block)
{
    const size_t bytes = rhw_format_block_bytes(format);
    for (size_t i = 0; i < bytes; i += 8) {
        const uint64_t word = random_word(state);
        for (size_t k = 0; k < 8; k++) {
            block[i + k] = (unsigned char)(word >> 8 * k);
        }
    }
    const uint64_t choice = random_word(state);
    if (format == RHW_FORMAT_BC7_UNORM || format == RHW_FORMAT_BC7_SRGB) {
        help_bc7(choice, block);
    } else if (format >= RHW_FORMAT_ASTC_4X4_UNORM) {
        help_astc(choice, block);
    }
}

#endif
