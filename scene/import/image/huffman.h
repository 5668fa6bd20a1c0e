// SPDX-License-Identifier: MIT
// Bits and Huffman codes of BasisLZ streams (KTX 2.0, appendix "BasisLZ/ETC1S Bitstream Specification").
#ifndef SCENE_IMAGE_HUFFMAN_H
#define SCENE_IMAGE_HUFFMAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Bytes that are read from the lowest bit of the first one upwards. Zeros follow behind the end, and `failed` is set.
/// It is also set by everything that the stream may not say. Reading goes on nevertheless, so that looking at `failed`
/// now and then is enough.
struct scene_bits {
    const uint8_t *bytes;
    size_t size, next; // next: place of the byte that comes into `window`
    uint64_t window;   // bits that are not taken yet, from the lowest on
    unsigned count;    // number of bits in `window`
    bool failed;
};

struct scene_bits scene_bits_open(const uint8_t *bytes, size_t size);
/// Take the next `count` bits, 0..32.
uint32_t scene_bits_take(struct scene_bits *bits, unsigned count);

enum { SCENE_HUFFMAN_LENGTHS = 17, SCENE_HUFFMAN_SYMBOLS = 1 << 14 };

/// A canonical code as RFC 1951 defines it.
struct scene_huffman {
    uint16_t count[SCENE_HUFFMAN_LENGTHS];   // number of codes of each length
    uint16_t symbols[SCENE_HUFFMAN_SYMBOLS]; // symbols by length, and by number within a length
};

/// Read the lengths of a code's symbols, which are compressed themselves.
void scene_huffman_read(struct scene_bits *bits, struct scene_huffman *code);
/// Take the next symbol. Return 0 if the bits are no code.
uint32_t scene_huffman_take(struct scene_bits *bits, const struct scene_huffman *code);

#endif
