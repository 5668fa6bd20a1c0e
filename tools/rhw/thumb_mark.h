// SPDX-License-Identifier: MIT
// What a thumbnail says of the options that it was drawn with: a text in its PNG file, by which rhw thumbs notices that
// it is asked for other pictures now, with no file beside them. The same options give the same text, however they were
// written, so the bytes of a picture stay those of its model and its options.
#ifndef CLI_THUMB_MARK_H
#define CLI_THUMB_MARK_H

#include <stdbool.h>

enum { CLI_THUMB_MARK_SIZE = 128 };

#define CLI_THUMB_MARK_KEYWORD "rhw thumbs"

/// Whether the picture is a PNG file with another mark than this one. One without a mark is someone's own.
bool cli_thumb_mark_differs(const char *picture, const char *mark);

#endif
