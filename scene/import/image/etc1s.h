// SPDX-License-Identifier: MIT
// Texels of ETC1S, compressed with BasisLZ, as KTX2 files hold them.
#ifndef SCENE_IMAGE_ETC1S_H
#define SCENE_IMAGE_ETC1S_H

#include <stdint.h>

#include "huffman.h"

/// A part of a file.
struct scene_span {
    const uint8_t *bytes;
    size_t size;
};

/// What slices of blocks refer to: colours and patterns of texels, and the codes of the references.
struct scene_etc1s;

/// Read the global data. `endpoint_count` and `selector_count` are at least 1, as the file says. Return NULL on
/// success. Return a short reason (static storage) if not. The caller frees what was made with scene_etc1s_free.
const char *scene_etc1s_open(uint32_t endpoint_count, uint32_t selector_count, struct scene_span endpoints,
                             struct scene_span selectors, struct scene_span tables,
                             struct scene_etc1s **codebooks);
/// Decode a slice of `width` × `height` texels. With `alpha` the slice's green channel becomes the alpha of `texels`.
/// Without it the slice's colours become their red, green and blue, and the texels are opaque. Return NULL on success.
/// Return a short reason (static storage) if not.
const char *scene_etc1s_decode(const struct scene_etc1s *codebooks, struct scene_span slice, uint32_t width,
                               uint32_t height, bool alpha, uint8_t (*texels)[4]);
void scene_etc1s_free(struct scene_etc1s *codebooks);

#endif
