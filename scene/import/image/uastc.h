// SPDX-License-Identifier: MIT
// Texels of UASTC LDR 4×4, the format between formats that KTX2 files hold their textures in.
#ifndef SCENE_IMAGE_UASTC_H
#define SCENE_IMAGE_UASTC_H

#include <stdint.h>

enum { SCENE_UASTC_BLOCK = 16 /* bytes */ };

/// Decodes one block, of any bits, into 4 × 4 texels of RGBA8, row by row. What a block may not say makes it opaque
/// magenta.
void scene_uastc_decode(const uint8_t block[SCENE_UASTC_BLOCK], uint8_t texels[16][4]);

#endif
