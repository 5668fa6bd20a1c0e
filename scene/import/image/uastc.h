// SPDX-License-Identifier: MIT
// Texels of UASTC LDR 4×4, the format between formats that KTX2 files hold their textures in.
#ifndef SCENE_IMAGE_UASTC_H
#define SCENE_IMAGE_UASTC_H

#include <stdint.h>

enum { SCENE_UASTC_BLOCK = 16 /* bytes */ };

/// Decode one block, of any bits, into 4 × 4 texels of RGBA8, row by row. A block that says what none may say becomes
/// opaque magenta.
void scene_uastc_decode(const uint8_t block[SCENE_UASTC_BLOCK], uint8_t texels[16][4]);

#endif
