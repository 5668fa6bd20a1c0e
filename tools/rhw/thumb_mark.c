// SPDX-License-Identifier: MIT
// See thumb_mark.h.
#include "thumb_mark.h"

#include <spng.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { TEXTS_MAX = 16, CHUNK_SIZE = 1 << 16, CHUNKS_SIZE = 1 << 20 }; // a picture may be anyone's

static bool find_other(spng_ctx *context, FILE *stream, const char *mark)
{
    struct spng_text texts[TEXTS_MAX];
    uint32_t count = TEXTS_MAX;
    if (spng_set_chunk_limits(context, CHUNK_SIZE, CHUNKS_SIZE) || spng_set_png_file(context, stream) ||
        spng_get_text(context, texts, &count)) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(texts[i].keyword, CLI_THUMB_MARK_KEYWORD) == 0) {
            return strcmp(texts[i].text, mark) != 0;
        }
    }
    return false;
}

bool cli_thumb_mark_differs(const char *picture, const char *mark)
{
    FILE *const stream = fopen(picture, "rb");
    spng_ctx *const context = stream ? spng_ctx_new(0) : NULL;
    const bool differs = context && find_other(context, stream, mark);
    spng_ctx_free(context);
    if (stream) {
        fclose(stream);
    }
    return differs;
}
