// SPDX-License-Identifier: MIT
// See cache.h.
//
// Threads take turns by a flag, for some tens of instructions: what takes long (hashing, comparing, translating,
// freeing) stands outside of them. A flag needs no system, and nothing here ever waits while it is set.
#include "cache.h"

#include <stdlib.h>
#include <string.h>

enum { BUCKETS = 1 << 10 };

struct rhw_shader_cache {
    atomic_flag is_taken; // by the thread that reads or writes what follows
    size_t bound, size;   // bytes
    struct shader_kept *newest, *oldest;
    struct shader_kept *buckets[BUCKETS];
};

static void take_turn(rhw_shader_cache *cache)
{
    while (atomic_flag_test_and_set_explicit(&cache->is_taken, memory_order_acquire)) {
    }
}

static void end_turn(rhw_shader_cache *cache)
{
    atomic_flag_clear_explicit(&cache->is_taken, memory_order_release);
}

// Users ----------------------------------------------------------------------------------------------

void shader_kept_init(struct shader_kept *kept, void (*destroy)(struct shader_kept *kept))
{
    atomic_init(&kept->users, 1);
    kept->destroy = destroy;
}

void shader_hold(const struct shader_kept *kept)
{
    atomic_fetch_add_explicit((atomic_uint *)&kept->users, 1, memory_order_relaxed);
}

void shader_release(const struct shader_kept *kept)
{
    struct shader_kept *const mine = (struct shader_kept *)kept;
    if (atomic_fetch_sub_explicit(&mine->users, 1, memory_order_acq_rel) == 1) {
        free(mine->key);
        mine->destroy(mine);
    }
}

// Keys -----------------------------------------------------------------------------------------------

static uint64_t mix(uint64_t hash, uint64_t piece)
{
    hash = (hash ^ piece) * 0x9e3779b97f4a7c15u; // 2^64 by the golden ratio
    return hash ^ hash >> 32;
}

static uint64_t mix_part(uint64_t hash, const struct shader_key_part *part)
{
    const unsigned char *bytes = part->bytes;
    size_t left = part->size;
    uint64_t piece = 0;
    for (; left >= sizeof piece; left -= sizeof piece, bytes += sizeof piece) {
        memcpy(&piece, bytes, sizeof piece);
        hash = mix(hash, piece);
    }
    if (left > 0) {
        piece = 0;
        memcpy(&piece, bytes, left);
        hash = mix(hash, piece);
    }
    return hash;
}

static uint64_t hash_of(const struct shader_key *key)
{
    uint64_t hash = 0;
    for (int i = 0; i < SHADER_KEY_PARTS; i++) {
        hash = mix_part(hash, &key->parts[i]);
    }
    return hash;
}

static size_t size_of(const struct shader_key *key)
{
    size_t size = 0;
    for (int i = 0; i < SHADER_KEY_PARTS; i++) {
        size += key->parts[i].size;
    }
    return size;
}

static bool is_of(const struct shader_kept *kept, const struct shader_key *key)
{
    const unsigned char *bytes = kept->key;
    bool is_equal = kept->key_size == size_of(key);
    for (int i = 0; is_equal && i < SHADER_KEY_PARTS; i++) {
        const size_t size = key->parts[i].size;
        is_equal = size == 0 || memcmp(bytes, key->parts[i].bytes, size) == 0;
        bytes += size;
    }
    return is_equal;
}

// Return a copy of the bytes of a key, or NULL without memory.
static unsigned char *copy_key(const struct shader_key *key)
{
    unsigned char *const copy = malloc(size_of(key)), *to = copy;
    for (int i = 0; copy && i < SHADER_KEY_PARTS; i++) {
        const size_t size = key->parts[i].size;
        if (size > 0) {
            memcpy(to, key->parts[i].bytes, size);
        }
        to += size;
    }
    return copy;
}

// What stands between taking a turn and its end ---------------------------------------------------------

static void put_first(rhw_shader_cache *cache, struct shader_kept *kept)
{
    kept->newer = NULL;
    kept->older = cache->newest;
    *(cache->newest ? &cache->newest->newer : &cache->oldest) = kept;
    cache->newest = kept;
}

static void take_out(rhw_shader_cache *cache, struct shader_kept *kept)
{
    *(kept->newer ? &kept->newer->older : &cache->newest) = kept->older;
    *(kept->older ? &kept->older->newer : &cache->oldest) = kept->newer;
}

// Return what has a hash, which the caller then holds, or NULL. It counts as asked for.
static struct shader_kept *look_up(rhw_shader_cache *cache, uint64_t hash)
{
    struct shader_kept *found = cache->buckets[hash % BUCKETS];
    while (found && found->hash != hash) {
        found = found->next;
    }
    if (found) {
        shader_hold(found);
        take_out(cache, found);
        put_first(cache, found);
    }
    return found;
}

// Take out what was asked for least recently, until there is room. Return it, as a list by `older`.
static struct shader_kept *make_room(rhw_shader_cache *cache, size_t bytes)
{
    struct shader_kept *gone = NULL;
    while (cache->oldest && cache->bound - bytes < cache->size) {
        struct shader_kept *const kept = cache->oldest;
        struct shader_kept **link = &cache->buckets[kept->hash % BUCKETS];
        while (*link != kept) {
            link = &(*link)->next;
        }
        *link = kept->next;
        take_out(cache, kept);
        cache->size -= kept->bytes;
        kept->older = gone;
        gone = kept;
    }
    return gone;
}

// The whole ------------------------------------------------------------------------------------------

static void release_all(struct shader_kept *list)
{
    while (list) {
        struct shader_kept *const next = list->older;
        shader_release(list);
        list = next;
    }
}

// Return what the caller holds of a lookup: nothing where another key has the same hash.
static struct shader_kept *confirm(struct shader_kept *found, const struct shader_key *key)
{
    if (found && !is_of(found, key)) {
        shader_release(found);
        return NULL;
    }
    return found;
}

struct shader_kept *shader_cache_find(rhw_shader_cache *cache, const struct shader_key *key)
{
    if (!cache) {
        return NULL;
    }
    const uint64_t hash = hash_of(key);
    take_turn(cache);
    struct shader_kept *const found = look_up(cache, hash);
    end_turn(cache);
    return confirm(found, key);
}

struct shader_kept *shader_cache_add(rhw_shader_cache *cache, const struct shader_key *key,
                                     struct shader_kept *made, size_t bytes)
{
    if (!cache) {
        return made;
    }
    made->key_size = size_of(key);
    made->bytes = bytes + made->key_size;
    made->key = made->bytes <= cache->bound ? copy_key(key) : NULL;
    if (!made->key) {
        return made; // It is too large to keep, or memory is short.
    }
    made->hash = hash_of(key);
    struct shader_kept *gone = NULL;
    take_turn(cache);
    struct shader_kept *const found = look_up(cache, made->hash);
    if (!found) {
        gone = make_room(cache, made->bytes);
        cache->size += made->bytes;
        made->next = cache->buckets[made->hash % BUCKETS];
        cache->buckets[made->hash % BUCKETS] = made;
        put_first(cache, made);
        shader_hold(made);
    }
    end_turn(cache);
    release_all(gone);
    struct shader_kept *const other = confirm(found, key);
    if (other) {
        shader_release(made);
    }
    return other ? other : made;
}

enum rhw_result rhw_shader_cache_create(size_t bound, rhw_shader_cache **cache)
{
    rhw_shader_cache *const made = calloc(1, sizeof *made);
    *cache = made;
    if (!made) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    atomic_flag_clear(&made->is_taken);
    made->bound = bound;
    return RHW_OK;
}

void rhw_shader_cache_destroy(rhw_shader_cache *cache)
{
    if (cache) {
        rhw_shader_cache_clear(cache);
    }
    free(cache);
}

void rhw_shader_cache_clear(rhw_shader_cache *cache)
{
    take_turn(cache);
    struct shader_kept *const gone = make_room(cache, cache->bound);
    end_turn(cache);
    release_all(gone);
}

size_t rhw_shader_cache_get_size(rhw_shader_cache *cache)
{
    take_turn(cache);
    const size_t size = cache->size;
    end_turn(cache);
    return size;
}
