// SPDX-License-Identifier: MIT
// See table.h.
#include "table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const begin_marker = "<!-- exactness table: written by script/exactness -->\n";
static const char *const end_marker = "<!-- end of exactness table -->\n";

static void print_number(FILE *out, double v)
{
    if (isinf(v)) {
        fprintf(out, " inf");
    } else if (v >= 1000) {
        fprintf(out, " %.0f", v);
    } else {
        fprintf(out, v >= 100 ? " %.0f" : v >= 10 ? " %.1f" : " %.2f", v);
    }
}

// 12345678 as "12 M".
static void print_count(FILE *out, uint64_t v)
{
    if (v >= 10000000) {
        fprintf(out, " %.0f M", (double)v / 1e6);
    } else if (v >= 10000) {
        fprintf(out, " %.0f k", (double)v / 1e3);
    } else {
        fprintf(out, " %d", (int)v);
    }
}

static void print_tally(FILE *out, const struct tally *t)
{
    if (t->count == 0) {
        fprintf(out, " – | – | – | – |");
        return;
    }
    print_count(out, t->count);
    fprintf(out, " |");
    print_number(out, tally_percentile(t, 0.5));
    fprintf(out, " |");
    print_number(out, tally_percentile(t, 0.99));
    fprintf(out, " |");
    print_number(out, t->worst);
    fprintf(out, " |");
}

static void print_header(FILE *out, const char *first, const struct table_column *columns, int count)
{
    fprintf(out, "| %s |", first);
    for (int i = 0; i < count; i++) {
        fprintf(out, " %s: values | median | p99 | worst |", columns[i].name);
    }
    fprintf(out, "\n|---|");
    for (int i = 0; i < count; i++) {
        fprintf(out, "---:|---:|---:|---:|");
    }
    fprintf(out, "\n");
}

void table_print(FILE *out, const struct table_column *columns, int count)
{
    print_header(out, "triangles, quantity", columns, count);
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (int quantity = 0; quantity < QUANTITY_COUNT; quantity++) {
            fprintf(out, "| %s, %s |", scene_family_name((enum family)family),
                    judge_quantity_name((enum quantity)quantity));
            for (int i = 0; i < count; i++) {
                print_tally(out, &columns[i].results->quantity[family][quantity]);
            }
            fprintf(out, "\n");
        }
    }
    fprintf(out, "\n");
    print_header(out, "values, qualifier", columns, count);
    for (int kind = 0; kind < VALUE_KINDS; kind++) {
        for (int q = 0; q < 2 && kind != VALUE_CONSTANT; q++) {
            fprintf(out, "| %s, %s |", scene_kind_name((enum value_kind)kind), judge_quantity_name((enum quantity)q));
            for (int i = 0; i < count; i++) {
                print_tally(out, &columns[i].results->kind[kind][q]);
            }
            fprintf(out, "\n");
        }
    }
}

// The whole file with a terminating zero, or NULL.
static char *read_all(const char *path)
{
    FILE *const in = fopen(path, "rb");
    char *text = NULL;
    if (in && fseek(in, 0, SEEK_END) == 0) {
        const long size = ftell(in);
        rewind(in);
        text = size >= 0 ? malloc((size_t)size + 1) : NULL;
        if (text && fread(text, 1, (size_t)size, in) == (size_t)size) {
            text[size] = 0;
        } else {
            free(text);
            text = NULL;
        }
    }
    if (in) {
        fclose(in);
    }
    return text;
}

bool table_write(const char *path, const struct table_column *columns, int count)
{
    char *const text = read_all(path);
    char *const begin = text ? strstr(text, begin_marker) : NULL;
    const char *const end = begin ? strstr(begin, end_marker) : NULL;
    char beside[4096];
    bool ok = false;
    if (!end || snprintf(beside, sizeof beside, "%s.new", path) >= (int)sizeof beside) {
        fprintf(stderr, "exactness: %s: cannot be read or lacks the two marker lines of the table\n", path);
        free(text);
        return false;
    }
    FILE *const out = fopen(beside, "wb");
    if (out) {
        fwrite(text, 1, (size_t)(begin - text) + strlen(begin_marker), out);
        table_print(out, columns, count);
        fputs(end, out);
        ok = !ferror(out);
        ok = fclose(out) == 0 && ok && rename(beside, path) == 0;
    }
    if (!ok) {
        fprintf(stderr, "exactness: %s: cannot be written\n", path);
        remove(beside);
    }
    free(text);
    return ok;
}
