// SPDX-License-Identifier: MIT
// Formats that both renderers have: how the peer names, takes and gives them, and what texels mean.
#ifndef DIFFERENTIAL_TEXEL_PAIR_H
#define DIFFERENTIAL_TEXEL_PAIR_H

#include <GLES3/gl32.h>
#include <rhw/rhw.h>

// How texels are compared: what numbers they are decoded to, and what a unit is.
enum texel_kind {
    TEXEL_BYTES,  // UNORM of 8 bits and sRGB: codes
    TEXEL_PACKED, // RGB10A2 UNORM: codes
    TEXEL_SIGNED, // integers
    TEXEL_UNSIGNED,
    TEXEL_HALF,  // values; a unit is a step of the format at the largest of both and 1/4
    TEXEL_11_10, // RG11B10, likewise
    TEXEL_FLOAT  // values; a unit is 2^-16
};

struct texel_pair {
    enum rhw_format format;
    GLenum internal, external, type; // as the peer stores and takes it
    enum texel_kind kind;
    int channels;
};

// NULL: the peer has no such format.
const struct texel_pair *texel_pair_find(enum rhw_format format);
// A texel of the library's own layout.
void texel_decode(const struct texel_pair *pair, const unsigned char *texel, double value[4]);
// In units of the format.
double texel_difference(const struct texel_pair *pair, int channel, double a, double b);

#endif
