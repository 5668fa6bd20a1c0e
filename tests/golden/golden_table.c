// SPDX-License-Identifier: MIT
// Tables of hashes and the configurations; see golden.h.
#include "golden.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint64_t golden_hash(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

// Thread counts, instruction sets and bin sizes that must make no difference; the first is the reference.
static int configurations(struct rhw_context_def defs[8])
{
    int count = 0;
    const int threads[] = {1, 2, 3, 8};
    for (int i = 0; i < 4; i++) {
        defs[count] = rhw_context_def_default();
        defs[count].isa = RHW_ISA_BASELINE;
        defs[count++].threads = threads[i];
    }
    defs[1].bin_memory = 1 << 16;
    for (int isa = RHW_ISA_BASELINE + 1; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa))
            continue;
        defs[count] = rhw_context_def_default();
        defs[count].isa = (enum rhw_isa)isa;
        defs[count++].threads = 2;
    }
    return count;
}

// Draws an image in every configuration; 0 when they differ (and says so) or it is skipped.
static uint64_t hash_everywhere(const struct golden_set *set, int number, int *failed)
{
    struct rhw_context_def defs[8];
    const int count = configurations(defs);
    const uint64_t first = set->hash(number, &defs[0]);
    for (int i = 1; i < count && first != 0; i++) {
        if (set->hash(number, &defs[i]) == first)
            continue;
        printf("%s: other bytes with %d threads, %s, bin memory %zu\n", set->name(number), defs[i].threads,
               rhw_isa_name(defs[i].isa), defs[i].bin_memory);
        *failed += 1;
        return 0;
    }
    return first;
}

// 0 where the table has no such line.
static uint64_t look_up(FILE *table, const char *name)
{
    char line[512], entry[400];
    rewind(table);
    while (fgets(line, sizeof line, table) != NULL) {
        uint64_t hash;
        if (sscanf(line, "%" SCNx64 " %399[^\n]", &hash, entry) == 2 && strcmp(entry, name) == 0)
            return hash;
    }
    return 0;
}

int golden_main(const struct golden_set *set, int argc, char **argv)
{
    const bool update = argc == 3 && strcmp(argv[2], "--update") == 0;
    FILE *table = argc == 2 || update ? fopen(argv[1], update ? "w" : "r") : NULL;
    if (table == NULL) {
        fprintf(stderr, "usage: %s TABLE [--update]\n", argv[0]);
        return 2;
    }
    int passed = 0, failed = 0, skipped = 0;
    for (int i = 0; i < set->count; i++) {
        const int failed_before = failed;
        const uint64_t hash = hash_everywhere(set, i, &failed);
        if (failed != failed_before)
            continue;
        if (hash == 0) {
            skipped++;
        } else if (update) {
            fprintf(table, "%016" PRIx64 " %s\n", hash, set->name(i));
            passed++;
        } else if (look_up(table, set->name(i)) == hash) {
            passed++;
        } else {
            printf("%s: %016" PRIx64 ", not %016" PRIx64 "\n", set->name(i), hash,
                   look_up(table, set->name(i)));
            failed++;
        }
    }
    printf("%d passed, %d failed, %d skipped\n", passed, failed, skipped);
    return fclose(table) != 0 || failed != 0;
}
