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

// Return true if a chunk holds others. Leave these alone in its content.
static bool find_inner(struct scene_3ds_chunk *chunk)
{
    static const size_t holders[] = {
        SCENE_3DS_FILE,          SCENE_3DS_EDITOR,       SCENE_3DS_OBJECT,         SCENE_3DS_MESH,
        SCENE_3DS_KEYS,          SCENE_3DS_NODE,         SCENE_3DS_MATERIAL,       SCENE_3DS_TEXTURE,
        SCENE_3DS_SPECULAR_MAP,  SCENE_3DS_OPACITY_MAP,  SCENE_3DS_REFLECTION_MAP, SCENE_3DS_BUMP_MAP,
        SCENE_3DS_SHININESS_MAP, SCENE_3DS_EMISSION_MAP, SCENE_3DS_LIGHT,          SCENE_3DS_CAMERA,
        SCENE_3DS_FACES};
    enum { FACE = 8, LIGHT = 12, CAMERA = 32 }; // bytes of their numbers
    struct scene_3ds_chunks *const content = &chunk->content;
    const size_t length = content->end - content->at;
    bool holds = false;
    for (size_t i = 0; i < sizeof holders / sizeof holders[0]; i++) {
        holds = holds || chunk->kind == holders[i];
    }
    size_t own = chunk->kind == SCENE_3DS_LIGHT ? LIGHT : chunk->kind == SCENE_3DS_CAMERA ? CAMERA : 0;
    if (chunk->kind == SCENE_3DS_FACES) {
        own = length < 2 ? length : 2 + FACE * scene_3ds_number(content->bytes + content->at, 2);
    }
    content->at += own < length ? own : length;
    return holds;
}

static bool fill(unsigned char *bytes, struct scene_3ds_chunks chunks, unsigned depth)
{
    enum { DEEPEST = 6 };
    struct scene_3ds_chunk chunk;
    bool is_filled = false;
    while (depth < DEEPEST && scene_3ds_next(&chunks, &chunk)) {
        is_filled = (find_inner(&chunk) && fill(bytes, chunk.content, depth + 1)) || is_filled;
    }
    const size_t rest = chunks.end - chunks.at;
    size_t zeros = 0;
    while (depth < DEEPEST && zeros < rest && bytes[chunks.at + zeros] == 0) {
        zeros++;
    }
    if (zeros < SCENE_3DS_HEAD || zeros < rest || (depth == 0 && chunks.at == 0)) {
        return is_filled;
    }
    memset(bytes + chunks.at, 0xff, 2); // a kind of no meaning
    for (unsigned i = 0; i < 4; i++) {
        bytes[chunks.at + 2 + i] = (unsigned char)(rest >> 8 * i);
    }
    return true;
}

bool scene_3ds_fill(unsigned char *bytes, size_t size)
{
    return fill(bytes, (struct scene_3ds_chunks){bytes, 0, size}, 0);
}
