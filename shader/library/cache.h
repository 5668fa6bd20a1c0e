// SPDX-License-Identifier: MIT
// What was made, kept for whoever asks for the same again.
//
// A struct shader_kept is the first member of a shader and of a program. It counts their users: whoever made them,
// programs that were linked of a shader, and the cache that has it. The links of a cache stand in what it keeps, so
// that it takes no memory that could be missing. Nothing of what is kept changes any more, so that users need no lock.
#ifndef SHADER_CACHE_H
#define SHADER_CACHE_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "rhw/spirv.h"

struct shader_kept {
    atomic_uint users;
    void (*destroy)(struct shader_kept *kept); // called when the last user leaves
    // The rest is the cache's.
    uint64_t hash;
    unsigned char *key; // NULL: no cache ever had it
    size_t key_size, bytes;
    struct shader_kept *next;          // what the bucket has besides
    struct shader_kept *newer, *older; // by when they were last asked for
};

enum { SHADER_KEY_PARTS = 4 };

// All that something is made of. Equal bytes make equal things.
struct shader_key {
    struct shader_key_part {
        const void *bytes;
        size_t size;
    } parts[SHADER_KEY_PARTS]; // the first tells what is made, and how long all but one of the others are
};

void shader_kept_init(struct shader_kept *kept, void (*destroy)(struct shader_kept *kept));
void shader_hold(const struct shader_kept *kept);
void shader_release(const struct shader_kept *kept);

// Return what a cache has of a key, which the caller then holds. Return NULL where it has nothing, or is NULL.
struct shader_kept *shader_cache_find(rhw_shader_cache *cache, const struct shader_key *key);
// Give a cache, which may be NULL, what was made of a key. Return what the caller holds from then on: `made`, or what
// another thread has given meanwhile, with `made` released. `bytes` is the memory that it takes.
struct shader_kept *shader_cache_add(rhw_shader_cache *cache, const struct shader_key *key,
                                     struct shader_kept *made, size_t bytes);

#endif
