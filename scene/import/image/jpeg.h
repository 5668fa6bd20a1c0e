// SPDX-License-Identifier: MIT
// JPEG files: their size, whether their Huffman tables fit, and whether their scans are all there. stb_image, which
// reads the files, writes past its own tables before version 2.28, and leaves rows unwritten that a file lacks.
#ifndef SCENE_IMAGE_JPEG_H
#define SCENE_IMAGE_JPEG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Set the width and height that the header of the frame says. Return false if there is none.
bool scene_jpeg_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Return a reason (static storage) if a file that begins as a JPEG has a table of more than 256 codes, wherever
/// stb_image may look for one. Return NULL if not. A file with another fault may pass, and stb_image finds that fault.
const char *scene_jpeg_problem(const unsigned char *bytes, size_t size);
/// Find the last byte of each scan, where it is an escaped 0xff, up to `most` of them. Return how many there are.
size_t scene_jpeg_tails(const unsigned char *bytes, size_t size, size_t most, size_t *places);
/// Return a reason (static storage) if components, tables or intervals of a file are not there, of which stb_image
/// would say nothing. Return NULL if all are, or if there is no frame. Set `lacks_end` where no mark ends the scans.
const char *scene_jpeg_gap(const unsigned char *bytes, size_t size, bool *lacks_end);

#endif
