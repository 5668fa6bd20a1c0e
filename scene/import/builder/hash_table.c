// SPDX-License-Identifier: MIT
// A hash table of indices with open addressing. At most half of it is occupied, so that runs are short.
#include "hash_table.h"

#include <stdlib.h>
#include <string.h>

static const uint32_t none = UINT32_MAX;

uint32_t scene_hash_bytes(const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ b[i]) * 0x100000001b3u;
    }
    return (uint32_t)(hash ^ hash >> 32);
}

uint32_t scene_hash_next(const struct scene_hash_table *table, uint32_t hash, size_t *place)
{
    const size_t mask = table->capacity - 1;
    if (table->capacity == 0) {
        return none;
    }
    *place = *place == SIZE_MAX ? hash & mask : (*place + 1) & mask;
    while (table->entries[*place].index != none && table->entries[*place].hash != hash) {
        *place = (*place + 1) & mask;
    }
    return table->entries[*place].index;
}

static void insert(struct scene_hash_table *table, struct scene_hash_entry entry)
{
    const size_t mask = table->capacity - 1;
    size_t place = entry.hash & mask;
    while (table->entries[place].index != none) {
        place = (place + 1) & mask;
    }
    table->entries[place] = entry;
}

void scene_hash_add(struct scene_import *import, struct scene_hash_table *table, uint32_t hash,
                    uint32_t index)
{
    if (2 * (table->count + 1) > table->capacity) {
        struct scene_hash_table larger = {.capacity = table->capacity == 0 ? 64 : 2 * table->capacity,
                                          .count = table->count};
        larger.entries = scene_import_allocate(import, larger.capacity, sizeof *larger.entries);
        memset(larger.entries, 0xff, larger.capacity * sizeof *larger.entries);
        for (size_t i = 0; i < table->capacity; i++) {
            if (table->entries[i].index != none) {
                insert(&larger, table->entries[i]);
            }
        }
        free(table->entries);
        *table = larger;
    }
    insert(table, (struct scene_hash_entry){hash, index});
    table->count++;
}
