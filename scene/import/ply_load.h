// SPDX-License-Identifier: MIT
// Numbers of a binary PLY at known places.
#ifndef SCENE_PLY_LOAD_H
#define SCENE_PLY_LOAD_H

#include <string.h>

#include "ply.h"

static inline uint32_t scene_ply_load_32(const unsigned char *bytes, bool is_big)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return is_big ? __builtin_bswap32(word) : word;
}

static inline double scene_ply_load_float(const unsigned char *bytes, bool is_big)
{
    const uint32_t word = scene_ply_load_32(bytes, is_big);
    float value;
    memcpy(&value, &word, sizeof value);
    return (double)value;
}

static inline double scene_ply_load_double(const unsigned char *bytes, bool is_big)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    word = is_big ? __builtin_bswap64(word) : word;
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/// Return the number at `bytes`, whose highest byte is the first if it `is_big`.
static inline double scene_ply_load(const unsigned char *bytes, enum type type, bool is_big)
{
    const uint16_t word = (uint16_t)(type == TYPE_INT8 || type == TYPE_UINT8 ? bytes[0]
                                     : is_big                                ? bytes[0] << 8 | bytes[1]
                                                                             : bytes[1] << 8 | bytes[0]);
    switch (type) {
    case TYPE_INT8: return (int8_t)word;
    case TYPE_UINT8:
    case TYPE_UINT16: return word;
    case TYPE_INT16: return (int16_t)word;
    case TYPE_INT32: return (int32_t)scene_ply_load_32(bytes, is_big);
    case TYPE_UINT32: return scene_ply_load_32(bytes, is_big);
    case TYPE_FLOAT: return scene_ply_load_float(bytes, is_big);
    default: return scene_ply_load_double(bytes, is_big);
    }
}

#endif
