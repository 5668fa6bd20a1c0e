// SPDX-License-Identifier: MIT
// One decoder for each kind of block, by the Khronos Data Format Specification 1.4. Formats that differ in the transfer
// function alone share a decoder, except those of ASTC.
#ifndef RHW_BLOCK_DECODERS_H
#define RHW_BLOCK_DECODERS_H

#include "block_format.h"

// block_bc.c implements the chapters S3TC and RGTC.
rhw_block_decoder rhw_decode_bc1_rgb, rhw_decode_bc1_rgba, rhw_decode_bc2, rhw_decode_bc3;
rhw_block_decoder rhw_decode_bc4_unorm, rhw_decode_bc4_snorm, rhw_decode_bc5_unorm, rhw_decode_bc5_snorm;
// block_bc6h.c and block_bc7.c implement the chapter BPTC.
rhw_block_decoder rhw_decode_bc6h_ufloat, rhw_decode_bc6h_sfloat, rhw_decode_bc7;
// block_etc.c and block_eac.c implement the chapter ETC2.
rhw_block_decoder rhw_decode_etc2_rgb8, rhw_decode_etc2_rgb8a1, rhw_decode_etc2_rgba8;
rhw_block_decoder rhw_decode_eac_r11_unorm, rhw_decode_eac_r11_snorm, rhw_decode_eac_rg11_unorm,
    rhw_decode_eac_rg11_snorm;
// block_astc.c implements the chapter ASTC.
rhw_block_decoder rhw_decode_astc_unorm, rhw_decode_astc_srgb;

#endif
