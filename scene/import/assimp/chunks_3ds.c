// SPDX-License-Identifier: MIT
#include "chunks_3ds.h"

#include <string.h>

size_t scene_3ds_number(const unsigned char *bytes, size_t count)
{
    size_t number = 0;
    for (size_t i = count; i > 0; i--) {
        number = number << 8 | bytes[i - 1];
    }
    return number;
}

bool scene_3ds_next(struct scene_3ds_chunks *chunks, struct scene_3ds_chunk *chunk)
{
    const unsigned char *const head = chunks->bytes + chunks->at;
    const size_t size = chunks->end - chunks->at < SCENE_3DS_HEAD ? 0 : scene_3ds_number(head + 2, 4);
    if (size < SCENE_3DS_HEAD || size > chunks->end - chunks->at) {
        return false;
    }
    *chunk = (struct scene_3ds_chunk){
        chunks->at,
        scene_3ds_number(head, 2),
        {chunks->bytes, chunks->at + SCENE_3DS_HEAD, chunks->at + size},
    };
    if (chunk->kind == SCENE_3DS_OBJECT) {
        const unsigned char *const name = head + SCENE_3DS_HEAD;
        const unsigned char *const zero = memchr(name, 0, size - SCENE_3DS_HEAD);
        chunk->content.at += zero == NULL ? 0 : (size_t)(zero - name) + 1;
    }
    chunks->at += size;
    return true;
}
