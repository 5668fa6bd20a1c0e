// SPDX-License-Identifier: MIT
// See table.h.
#include "table.h"

#include <stdlib.h>
#include <string.h>

#include "document.h"

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

static void print_cells(FILE *out, const struct tally *const *tallies, int count)
{
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
    fprintf(out, "| %s values |", first);
    for (int i = 0; i < count; i++) {
        fprintf(out, " %s |", columns[i].name);
    }
    fprintf(out, "\n|---|");
    for (const char *bar = strchr(first, '|'); bar; bar = strchr(bar + 1, '|')) {
        fprintf(out, "---:|");
    }
    for (int i = 0; i < count; i++) {
        fprintf(out, "---:|");
    }
    fprintf(out, "\n");
}

// How many columns know the quantity: peers tell no weights and no derivatives.
static int columns_of(enum quantity quantity, int count)
{
    return quantity <= QUANTITY_INVERSE_W ? count : 1;
}

static void print_overview(FILE *out, const struct table_column *columns, int count, const double *bound)
{
    print_header(out, "all families | bound |", columns, count);
    struct tally *const sum = malloc((size_t)count * sizeof *sum);
    for (int quantity = 0; quantity < QUANTITY_COUNT && sum; quantity++) {
        const struct tally *cell[MAX_COLUMNS];
        memset(sum, 0, (size_t)count * sizeof *sum);
        for (int i = 0; i < count; i++) {
            for (int family = 0; family < FAMILY_COUNT && i < columns_of((enum quantity)quantity, count);
                 family++) {
                tally_merge(&sum[i], &columns[i].results->quantity[family][quantity]);
            }
            cell[i] = &sum[i];
        }
        fprintf(out, "| %s | %g | ", judge_quantity_name((enum quantity)quantity), bound[quantity]);
        print_cells(out, cell, count);
    }
    free(sum);
    fprintf(out, "\n");
}

static void print_quantity(FILE *out, enum quantity quantity, const struct table_column *columns, int count)
{
    char title[64];
    snprintf(title, sizeof title, "%s |", judge_quantity_name(quantity));
    print_header(out, title, columns, count);
    for (int family = 0; family < FAMILY_COUNT; family++) {
        const struct tally *cell[MAX_COLUMNS];
        for (int i = 0; i < count; i++) {
            cell[i] = &columns[i].results->quantity[family][quantity];
        }
        fprintf(out, "| %s | ", scene_family_name((enum family)family));
        print_cells(out, cell, count);
    }
    fprintf(out, "\n");
}

static void print_kinds(FILE *out, enum quantity quantity, const struct table_column *columns, int count)
{
    char title[64];
    snprintf(title, sizeof title, "%s, vertex values |", judge_quantity_name(quantity));
    print_header(out, title, columns, count);
    for (int kind = 0; kind < VALUE_CONSTANT; kind++) {
        const struct tally *cell[MAX_COLUMNS];
        for (int i = 0; i < count; i++) {
            cell[i] = &columns[i].results->kind[kind][quantity];
        }
        fprintf(out, "| %s | ", scene_kind_name((enum value_kind)kind));
        print_cells(out, cell, count);
    }
    fprintf(out, "\n");
}

void table_print(FILE *out, const struct table_column *columns, int count, const double *bound)
{
    fprintf(out, "Each cell: median, 99th percentile, worst. Fragments:");
    for (int i = 0; i < count; i++) {
        fprintf(out, " %s: ", columns[i].title);
        print_count(out, columns[i].results->fragments);
        fputs(i + 1 < count ? ";" : ".\n\n", out);
    }
    print_overview(out, columns, count, bound);
    fprintf(out, "<details>\n<summary>By family of triangles, and by kind of vertex values</summary>\n\n");
    for (int quantity = 0; quantity <= QUANTITY_INVERSE_W; quantity++) {
        print_quantity(out, (enum quantity)quantity, columns, count);
    }
    print_kinds(out, QUANTITY_SMOOTH, columns, count);
    print_kinds(out, QUANTITY_NOPERSPECTIVE, columns, count);
    for (int quantity = QUANTITY_INVERSE_W + 1; quantity < QUANTITY_COUNT; quantity++) {
        print_quantity(out, (enum quantity)quantity, columns, columns_of((enum quantity)quantity, count));
    }
    fprintf(out, "</details>\n\n");
}

// What document_replace calls.
struct printout {
    const struct table_column *columns;
    int count;
    const double *bound;
};

static void print_all(FILE *out, const void *argument)
{
    const struct printout *const p = argument;
    table_print(out, p->columns, p->count, p->bound);
}

bool table_write(const char *path, const struct table_column *columns, int count, const double *bound)
{
    const struct printout printout = {columns, count, bound};
    return document_replace(path, begin_marker, end_marker, print_all, &printout);
}
