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
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

enum { MOST_CONFIGURATIONS = 3 + RHW_ISA_COUNT - 1 + RHW_PATHS_GENERAL + 1 };

static const char *isa_limit_name(const struct rhw_context_def *def)
{
    return def->isa_limit == RHW_ISA_BEST ? "best" : rhw_isa_name((enum rhw_isa)(def->isa_limit - 1));
}

// Some scenes read outside their buffers, as they may; validation does not draw that. Of everything else it must find
// nothing wrong.
static bool reads_outside;

static void look_at_misuse(void *user, const char *message)
{
    (void)user;
    if (strstr(message, ": it reads ") == NULL && strstr(message, "; the index buffer has ") == NULL) {
        fprintf(stderr, "rhw: %s\n", message);
        abort();
    }
    reads_outside = true;
}

// Thread counts, instruction sets, paths, bin sizes and validation that must make no difference; the first is the
// reference. script/determinism has more numbers of threads. Few are one thread count, with small bins.
static int configurations(struct rhw_context_def defs[MOST_CONFIGURATIONS], bool few)
{
    int count = 0;
    const int threads[] = {1, 3, 8};
    for (int i = 0; i < 3; i++) {
        if (few && threads[i] != 3) {
            continue;
        }
        defs[count] = rhw_context_def_default();
        defs[count].isa_limit = RHW_ISA_UP_TO_BASELINE;
        defs[count].bin_memory = threads[i] == 3 ? 1 << 16 : 0;
        defs[count++].threads = threads[i];
    }
    for (int isa = RHW_ISA_BASELINE + 1; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        defs[count] = rhw_context_def_default();
        defs[count].isa_limit = rhw_isa_up_to((enum rhw_isa)isa);
        defs[count++].threads = 2;
    }
    for (int paths = RHW_PATHS_ALL + 1; paths <= RHW_PATHS_GENERAL; paths++) {
        defs[count] = rhw_context_def_default();
        defs[count].paths = (enum rhw_paths)paths;
        defs[count++].threads = 2;
    }
    defs[count] = rhw_context_def_default();
    defs[count].validate = RHW_VALIDATE_ON;
    defs[count].assert_ = look_at_misuse;
    defs[count++].threads = 2;
    return count;
}

// Draws an image in every configuration; 0 when they differ (and says so) or it is skipped.
static uint64_t hash_everywhere(const struct golden_set *set, int number, bool few, int *failed)
{
    struct rhw_context_def defs[MOST_CONFIGURATIONS];
    const int count = configurations(defs, few);
    const uint64_t first = set->hash(number, &defs[0]);
    for (int i = 1; i < count && first != 0; i++) {
        reads_outside = false;
        if (set->hash(number, &defs[i]) == first || reads_outside) {
            continue;
        }
        printf("%s: other bytes with %d threads, %s, paths %d, bin memory %zu, validate %d\n",
               set->name(number), defs[i].threads, isa_limit_name(&defs[i]), (int)defs[i].paths,
               defs[i].bin_memory, (int)defs[i].validate);
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
        if (sscanf(line, "%" SCNx64 " %399[^\n]", &hash, entry) == 2 && strcmp(entry, name) == 0) {
            return hash;
        }
    }
    return 0;
}

// One cell of the matrix: true where every scene matched every time.
static bool print_cell(const struct golden_set *set, FILE *table, struct rhw_context_def *def, int repeats)
{
    int matched = 0;
    uint64_t whole = GOLDEN_HASH_START;
    for (int i = 0; i < set->count; i++) {
        const uint64_t wanted = look_up(table, set->name(i));
        bool same = true;
        for (int repeat = 0; repeat < repeats; repeat++) {
            def->bin_memory = repeat % 2 ? 1 << 16 : 0;
            const uint64_t hash = set->hash(i, def);
            whole = repeat == 0 ? golden_hash(whole, &hash, sizeof hash) : whole;
            if (hash != wanted) {
                fprintf(stderr, "%s, %s, %d threads, repeat %d: %016" PRIx64 ", not %016" PRIx64 "\n",
                        set->name(i), isa_limit_name(def), def->threads, repeat, hash, wanted);
                same = false;
            }
        }
        matched += same;
    }
    printf("%s %d %d %d %016" PRIx64 "\n", isa_limit_name(def), def->threads, matched, set->count, whole);
    fflush(stdout);
    return matched == set->count;
}

static int print_matrix(const struct golden_set *set, FILE *table, const char *threads, int repeats)
{
    bool same = true;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        const char *at = threads;
        while (*at != '\0') {
            char *end;
            struct rhw_context_def def = rhw_context_def_default();
            def.isa_limit = rhw_isa_up_to((enum rhw_isa)isa);
            def.threads = (int)strtol(at, &end, 10);
            if (end == at || def.threads < 1 || repeats < 1) {
                fprintf(stderr, "golden: threads %s or repeats %d out of range\n", threads, repeats);
                return 2;
            }
            same = print_cell(set, table, &def, repeats) && same;
            at = *end == ',' ? end + 1 : end;
        }
    }
    return same ? 0 : 1;
}

int golden_main(const struct golden_set *set, int argc, char **argv)
{
    const bool update = argc == 3 && strcmp(argv[2], "--update") == 0;
    const bool few = argc == 3 && strcmp(argv[2], "--few") == 0;
    const bool matrix = argc == 5 && strcmp(argv[2], "--matrix") == 0;
    FILE *table = argc == 2 || update || few || matrix ? fopen(argv[1], update ? "w" : "r") : NULL;
    if (table == NULL) {
        fprintf(stderr,
                "usage: %s TABLE [--update | --few | --matrix THREADS REPEATS]\n"
                "       golden --show SCENE FILE\n",
                argv[0]);
        return 2;
    }
    if (matrix) {
        const int status = print_matrix(set, table, argv[3], atoi(argv[4]));
        fclose(table);
        return status;
    }
    int passed = 0, failed = 0, skipped = 0;
    for (int i = 0; i < set->count; i++) {
        const int failed_before = failed;
        const uint64_t hash = hash_everywhere(set, i, few, &failed);
        if (failed != failed_before) {
            continue;
        }
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
