// SPDX-License-Identifier: MIT
// What the files of rhw bench share: what the command line asks for, and what was measured.
#ifndef CLI_BENCH_JOB_H
#define CLI_BENCH_JOB_H

#include "agreement.h"
#include "measure.h"

#include <stdio.h>

enum { CLI_BENCH_SCENES_MAX = 128, CLI_BENCH_COUNTS_MAX = 8 };

struct cli_bench_job {
    bool wanted[CLI_BENCH_SCENES_MAX]; // of bench_scene_entries
    int width, height, frames;
    int threads[CLI_BENCH_COUNTS_MAX]; // 0: as the library chooses
    int thread_counts;                 // of `threads`; with several, rhw is timed alone, with each of them
    enum rhw_isa isa;
    const char *peer; // driver, or NULL: none
    int peer_threads; // 0: as the peer likes
    bool json, csv;   // instead of the table, or to a file of this name:
    const char *json_path, *csv_path;
    const char *save; // folder for the pictures, or NULL
};

// What came of one scene.
struct cli_bench_result {
    const struct bench_scene_entry *entry;
    enum bench_unit unit;
    double work; // units per frame
    struct bench_time all, one, peer;
    bool has_one, has_peer;
    struct bench_agreement agreement; // with the peer
    struct bench_tolerance tolerance;
    struct bench_time scaling[CLI_BENCH_COUNTS_MAX]; // where there are several numbers of threads
};

struct cli_bench_report {
    char cpu[128];
    char peer_name[160]; // "" without a peer
    int cores, threads, result_count;
    struct cli_bench_result results[CLI_BENCH_SCENES_MAX];
    const struct cli_bench_job *job;
    enum rhw_isa isa;
};

// bench_options.c. An cli_status; `*go` tells whether there is anything to do.
int cli_bench_options(int argc, char **argv, struct cli_bench_job *job, bool *go);

// bench_report.c. The table comes row by row, since a run takes minutes.
void cli_bench_print_head(const struct cli_bench_report *report);
void cli_bench_print_row(const struct cli_bench_report *report, const struct cli_bench_result *result);
void cli_bench_print_json(FILE *stream, const struct cli_bench_report *report);
void cli_bench_print_csv(FILE *stream, const struct cli_bench_report *report);
// bench_scaling.c. The report where rhw is timed with several numbers of threads.
void cli_bench_print_scaling_head(const struct cli_bench_report *report);
void cli_bench_print_scaling_rows(const struct cli_bench_report *report,
                                  const struct cli_bench_result *result);
void cli_bench_print_scaling_json(FILE *stream, const struct cli_bench_report *report);
void cli_bench_print_scaling_csv(FILE *stream, const struct cli_bench_report *report);

// bench_report.c. One sentence: how far the pictures of rhw and the peer are apart.
void cli_bench_describe(const struct cli_bench_result *result, char *text, size_t size);

#endif
