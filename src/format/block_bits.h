// SPDX-License-Identifier: MIT
// The bits of a compressed block: 64 or 128, in the byte order that the format's specification counts them in.
#ifndef RHW_BLOCK_BITS_H
#define RHW_BLOCK_BITS_H

#include <stdint.h>

// Load 8 bytes, the first as the lowest.
static inline uint64_t rhw_load_little(const unsigned char *bytes)
{
    uint64_t value = 0;
    for (int i = 7; i >= 0; i--) {
        value = value << 8 | bytes[i];
    }
    return value;
}

// Load 8 bytes, the first as the highest.
static inline uint64_t rhw_load_big(const unsigned char *bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < 8; i++) {
        value = value << 8 | bytes[i];
    }
    return value;
}

// Return `count` bits, 1..31, from bit `at` upwards.
static inline int rhw_bits_of(uint64_t value, int at, int count)
{
    return (int)(value >> at & ((1u << count) - 1));
}

// Return the low `count` bits of `value` as a signed number.
static inline int rhw_sign_extend(int value, int count)
{
    const int sign = 1 << (count - 1);
    return (value & (2 * sign - 1)) - ((value & sign) << 1);
}

// A stream has 128 bits, which are read from the lowest upwards. Behind the end there are zeros.
struct rhw_bit_stream {
    uint64_t low, high;
};

static inline struct rhw_bit_stream rhw_stream_open(const unsigned char *block)
{
    return (struct rhw_bit_stream){rhw_load_little(block), rhw_load_little(block + 8)};
}

// Drop `count` bits, 0..127.
static inline void rhw_stream_skip(struct rhw_bit_stream *stream, int count)
{
    if (count >= 64) {
        stream->low = stream->high >> (count - 64);
        stream->high = 0;
    } else if (count > 0) {
        stream->low = stream->low >> count | stream->high << (64 - count);
        stream->high >>= count;
    }
}

// Take the next `count` bits, 0..31.
static inline int rhw_stream_take(struct rhw_bit_stream *stream, int count)
{
    const int value = (int)(stream->low & ((1u << count) - 1));
    rhw_stream_skip(stream, count);
    return value;
}

// Return `count` bits from bit `at` upwards. `at` is 0..127 and `count` 0..31.
static inline int rhw_stream_bits(struct rhw_bit_stream stream, int at, int count)
{
    rhw_stream_skip(&stream, at);
    return rhw_stream_take(&stream, count);
}

// Keep `count` bits, 0..128, with zeros behind them.
static inline void rhw_stream_keep(struct rhw_bit_stream *stream, int count)
{
    if (count < 64) {
        stream->low &= ((uint64_t)1 << count) - 1;
        stream->high = 0;
    } else if (count < 128) {
        stream->high &= ((uint64_t)1 << (count - 64)) - 1;
    }
}

#endif
