// SPDX-License-Identifier: MIT
// What every lesson needs and none is about: a context, textures to draw into, and files.
//
// Each function ends the program with one line on stderr when something fails, so that a lesson reads
// without error paths. A program of its own would look at the result codes instead.
#ifndef PICTURE_H
#define PICTURE_H

#include <stdint.h>

#include <rhw/rhw.h>

/// Ends the program unless `result` is RHW_OK.
void must(enum rhw_result result, const char *what);

/// A context on all cores.
rhw_context *picture_context(void);

/// A texture to draw into, with that many mip levels. Level 0 is drawn into; rhw_texture_generate_mips
/// then averages 2×2 pixels per level in linear light: three levels make 4×4 supersampling.
rhw_texture picture_target(rhw_context *context, enum rhw_format format, int width, int height, int levels);

/// A vertex buffer with a copy of `data`.
rhw_buffer picture_vertices(rhw_context *context, const void *data, size_t size);

/// Writes DIRECTORY/NAME from `width` × `height` RGBA8 pixels; alpha is left out.
void picture_write_png(const char *directory, const char *name, int width, int height, const uint8_t *rgba);
void picture_write_ppm(const char *directory, const char *name, int width, int height, const uint8_t *rgba);

/// Reads a level of an RGBA8 texture back. The caller frees the pixels.
uint8_t *picture_read(rhw_context *context, rhw_texture texture, int level);

/// Reads a level of an RGBA8 texture back and writes it as PNG.
void picture_save(rhw_context *context, rhw_texture texture, int level, const char *directory,
                  const char *name);

#endif
