// SPDX-License-Identifier: MIT
// What rhw bench prints for several numbers of threads: how a frame scales, and what its threads do meanwhile.
//
// In a stage a thread is busy or waits for the last of the others. The rest of a frame is neither of the two stages:
// recording, waking the threads and whatever the scene does between passes.
#include "bench_job.h"
#include "json.h"
#include "rhw/rhw.h"

static const char *const columns[] = {"ms",         "min_ms",    "max_ms",       "speedup",
                                      "efficiency", "front_ms",  "front_busy",   "front_wait_ms",
                                      "back_ms",    "back_busy", "back_wait_ms", "rest_ms"};

enum { COLUMNS = sizeof columns / sizeof *columns };

// The part of `threads` × `wall` that threads were busy.
static double busy_part(double busy, double wall, int threads)
{
    return wall > 0.0 ? busy / (wall * threads) : 1.0;
}

// The numbers of `columns` for the thread count of this index. The first count is what the others are measured by.
static void find_numbers(const struct cli_bench_report *report, const struct cli_bench_result *result,
                         int index, double numbers[COLUMNS])
{
    const struct bench_time *const time = &result->scaling[index];
    const struct bench_stages *const stages = &time->stages;
    const int threads = report->job->threads[index];
    const double speedup = result->scaling[0].median / time->median;
    const double all[COLUMNS] = {time->median,
                                 time->least,
                                 time->most,
                                 speedup,
                                 speedup * report->job->threads[0] / threads,
                                 stages->front,
                                 busy_part(stages->front_busy, stages->front, threads),
                                 threads * stages->front - stages->front_busy,
                                 stages->back,
                                 busy_part(stages->back_busy, stages->back, threads),
                                 threads * stages->back - stages->back_busy,
                                 stages->frame - stages->front - stages->back};
    for (int i = 0; i < COLUMNS; i++) {
        numbers[i] = all[i];
    }
}

void cli_bench_print_scaling_head(const struct cli_bench_report *report)
{
    const struct cli_bench_job *const job = report->job;
    printf("%s, %d core%s\nrhw %s %s\n", report->cpu, report->cores, report->cores == 1 ? "" : "s",
           rhw_version(), rhw_isa_name(report->isa));
    printf("%dx%d, milliseconds per frame: median (least-most) of %d; stages are means\n\n", job->width,
           job->height, job->frames);
    printf("%-20s %7s %-24s %7s %10s   %-24s %-24s %s\n", "", "", "", "", "", "front end", "tiles", "");
    printf("%-20s %7s %-24s %7s %10s   %-24s %-24s %s\n", "scene", "threads", " frame", "speedup",
           "efficiency", "     ms  busy    waiting", "     ms  busy    waiting", "rest");
    fflush(stdout);
}

void cli_bench_print_scaling_rows(const struct cli_bench_report *report,
                                  const struct cli_bench_result *result)
{
    for (int i = 0; i < report->job->thread_counts; i++) {
        double n[COLUMNS];
        char range[32];
        find_numbers(report, result, i, n);
        snprintf(range, sizeof range, "(%.2f-%.2f)", n[1], n[2]);
        printf("%-20s %7d %7.2f %-16s %7.2f %10.2f   %7.2f %4.0f%% %10.2f  %7.2f %4.0f%% %10.2f  %4.2f\n",
               i == 0 ? result->entry->name : "", report->job->threads[i], n[0], range, n[3], n[4], n[5],
               100.0 * n[6], n[7], n[8], 100.0 * n[9], n[10], n[11]);
    }
    fflush(stdout);
}

static void json_count(FILE *stream, const struct cli_bench_report *report,
                       const struct cli_bench_result *result, int index)
{
    double numbers[COLUMNS];
    find_numbers(report, result, index, numbers);
    fprintf(stream, "{\"threads\": %d", report->job->threads[index]);
    for (int i = 0; i < COLUMNS; i++) {
        fprintf(stream, ", \"%s\": ", columns[i]);
        cli_json_number(stream, numbers[i]);
    }
    fputc('}', stream);
}

void cli_bench_print_scaling_json(FILE *stream, const struct cli_bench_report *report)
{
    fputs("{\"cpu\": ", stream);
    cli_json_string(stream, report->cpu);
    fprintf(stream, ", \"cores\": %d, \"rhw\": ", report->cores);
    cli_json_string(stream, rhw_version());
    fputs(", \"isa\": ", stream);
    cli_json_string(stream, rhw_isa_name(report->isa));
    fprintf(stream, ", \"width\": %d, \"height\": %d, \"frames\": %d,\n  \"scenes\": [", report->job->width,
            report->job->height, report->job->frames);
    for (int r = 0; r < report->result_count; r++) {
        fputs(r ? ",\n    {\"name\": " : "\n    {\"name\": ", stream);
        cli_json_string(stream, report->results[r].entry->name);
        fputs(", \"scaling\": [", stream);
        for (int i = 0; i < report->job->thread_counts; i++) {
            fputs(i ? ",\n      " : "\n      ", stream);
            json_count(stream, report, &report->results[r], i);
        }
        fputs("]}", stream);
    }
    fputs("\n  ]\n}\n", stream);
}

void cli_bench_print_scaling_csv(FILE *stream, const struct cli_bench_report *report)
{
    fputs("scene,threads", stream);
    for (int i = 0; i < COLUMNS; i++) {
        fprintf(stream, ",%s", columns[i]);
    }
    fputc('\n', stream);
    for (int r = 0; r < report->result_count; r++) {
        for (int t = 0; t < report->job->thread_counts; t++) {
            double numbers[COLUMNS];
            find_numbers(report, &report->results[r], t, numbers);
            fprintf(stream, "%s,%d", report->results[r].entry->name, report->job->threads[t]);
            for (int i = 0; i < COLUMNS; i++) {
                fprintf(stream, ",%.4f", numbers[i]);
            }
            fputc('\n', stream);
        }
    }
}
