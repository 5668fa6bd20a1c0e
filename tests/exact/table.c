// SPDX-License-Identifier: MIT
// See table.h.
#include "table.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 8 };

static const char *const begin_marker = "<!-- exactness table: written by script/exactness -->\n";
static const char *const end_marker = "<!-- end of exactness table -->\n";

static void print_number(FILE *out, double v, const char *behind)
{
    if (v >= 0x1p35) {
        fprintf(out, "∞%s", behind); // not a number, infinite, or as good as
    } else if (v >= 1e6) {
        fprintf(out, "%.0f M%s", v / 1e6, behind);
    } else if (v >= 1e4) {
        fprintf(out, "%.0f k%s", v / 1e3, behind);
    } else {
        fprintf(out, v >= 100 ? "%.0f%s" : v >= 10 ? "%.1f%s" : "%.2f%s", v, behind);
    }
}

// 12345678 as "12 M".
static void print_count(FILE *out, uint64_t v)
{
    if (v >= 10000000) {
        fprintf(out, "%.0f M", (double)v / 1e6);
    } else if (v >= 10000) {
        fprintf(out, "%.0f k", (double)v / 1e3);
    } else {
        fprintf(out, "%d", (int)v);
    }
}

static void print_row(FILE *out, const char *name, const struct tally *const *tallies, int count)
{
    fprintf(out, "| %s | ", name);
    print_count(out, tallies[0]->count);
    for (int i = 0; i < count; i++) {
        const struct tally *const t = tallies[i];
        fprintf(out, " | ");
        if (t->count == 0) {
            fprintf(out, "–");
            continue;
        }
        print_number(out, tally_percentile(t, 0.5), ", ");
        print_number(out, tally_percentile(t, 0.99), ", ");
        print_number(out, t->worst, "");
    }
    fprintf(out, " |\n");
}

static void print_header(FILE *out, const char *first, const struct table_column *columns, int count)
{
    fprintf(out, "| %s | values |", first);
    for (int i = 0; i < count; i++) {
        fprintf(out, " %s |", columns[i].name);
    }
    fprintf(out, "\n|---|---:|");
    for (int i = 0; i < count; i++) {
        fprintf(out, "---:|");
    }
    fprintf(out, "\n");
}

static void print_quantity(FILE *out, enum quantity quantity, const struct table_column *columns, int count)
{
    print_header(out, judge_quantity_name(quantity), columns, count);
    struct tally *const sum = calloc((size_t)count, sizeof *sum);
    const struct tally *cell[MAX_COLUMNS];
    for (int family = 0; family < FAMILY_COUNT && sum; family++) {
        for (int i = 0; i < count; i++) {
            cell[i] = &columns[i].results->quantity[family][quantity];
            tally_merge(&sum[i], cell[i]);
        }
        print_row(out, scene_family_name((enum family)family), cell, count);
    }
    for (int i = 0; i < count; i++) {
        cell[i] = &sum[i];
    }
    if (sum) {
        print_row(out, "**all**", cell, count);
    }
    free(sum);
    fprintf(out, "\n");
}

static void print_kinds(FILE *out, enum quantity quantity, const struct table_column *columns, int count)
{
    char title[64];
    snprintf(title, sizeof title, "%s, vertex values", judge_quantity_name(quantity));
    print_header(out, title, columns, count);
    for (int kind = 0; kind < VALUE_CONSTANT; kind++) {
        const struct tally *cell[MAX_COLUMNS];
        for (int i = 0; i < count; i++) {
            cell[i] = &columns[i].results->kind[kind][quantity];
        }
        print_row(out, scene_kind_name((enum value_kind)kind), cell, count);
    }
    fprintf(out, "\n");
}

void table_print(FILE *out, const struct table_column *columns, int count)
{
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s%s: ", i == 0 ? "Fragments: " : "; ", columns[i].name);
        print_count(out, columns[i].results->fragments);
    }
    fprintf(out, ". Each cell: median, 99th percentile, worst, in ULP of the largest vertex value.\n\n");
    for (int quantity = 0; quantity <= QUANTITY_INVERSE_W; quantity++) {
        print_quantity(out, (enum quantity)quantity, columns, count);
    }
    print_kinds(out, QUANTITY_SMOOTH, columns, count);
    print_kinds(out, QUANTITY_NOPERSPECTIVE, columns, count);
    for (int quantity = QUANTITY_SPACE; quantity < QUANTITY_COUNT; quantity++) {
        print_quantity(out, (enum quantity)quantity, columns, 1); // peers do not tell
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
