// SPDX-License-Identifier: MIT
// What rhw bench prints: the table for people, JSON and CSV for programs.
#include "bench_job.h"
#include "json.h"
#include "rhw/rhw.h"

#include <string.h>

// Of a frame time in milliseconds: millions of units per second, thousands for draws.
static double rate_of(const struct cli_bench_result *result, double ms)
{
    return result->work / ms * (result->unit == BENCH_DRAWS ? 1.0 : 1e-3);
}

static const char *unit_of(const struct cli_bench_result *result)
{
    static const char *const names[] = {"Mpix/s", "Mtri/s", "kdraw/s", "Mpoint/s", "Mline/s"};
    return names[result->unit];
}

// "llvmpipe", without the rest of the driver's name.
static const char *peer_of(const struct cli_bench_report *report)
{
    return report->job->peer;
}

// The part of the driver's name from "Mesa" on, without a comma, or "".
static const char *peer_version(const struct cli_bench_report *report)
{
    const char *const version = strstr(report->peer_name, "Mesa ");
    return version && !strchr(version, ',') ? version + strlen("Mesa ") : "";
}

void cli_bench_describe(const struct cli_bench_result *result, char *text, size_t size)
{
    const struct bench_agreement *const a = &result->agreement;
    char largest[48];
    if (result->tolerance.depth > 0.0 && a->color == 0) {
        snprintf(largest, sizeof largest, "depth within %.1e", a->depth);
    } else {
        snprintf(largest, sizeof largest, "mean difference %.3f/255, largest %d", a->mean, a->color);
    }
    snprintf(text, size, "%llu of %llu pixels covered by one only, %llu beyond the tolerance; %s",
             (unsigned long long)a->coverage, (unsigned long long)a->pixels, (unsigned long long)a->outliers,
             largest);
}

// Table --------------------------------------------------------------------------------------------

void cli_bench_print_head(const struct cli_bench_report *report)
{
    const struct cli_bench_job *const job = report->job;
    printf("%s, %d core%s\nrhw %s %s, %d thread%s\n", report->cpu, report->cores,
           report->cores == 1 ? "" : "s", rhw_version(), rhw_isa_name(report->isa), report->threads,
           report->threads == 1 ? "" : "s");
    if (report->peer_name[0]) {
        printf("%s\n", report->peer_name);
    }
    printf("%dx%d, milliseconds per frame: median (least-most) of %d\n\n%-20s", job->width, job->height,
           job->frames, "scene");
    if (report->threads > 1) {
        printf(" %-23s", "1 thread");
    }
    printf(" %-23s %-14s", report->threads > 1 ? "all threads" : "rhw", "rate");
    printf(report->peer_name[0] ? " %-23s ratio  pictures\n" : "\n", peer_of(report));
    fflush(stdout);
}

static void print_time(const struct bench_time *time)
{
    char range[32];
    snprintf(range, sizeof range, "(%.2f-%.2f)", time->least, time->most);
    printf(" %7.2f %-15s", time->median, range);
}

void cli_bench_print_row(const struct cli_bench_report *report, const struct cli_bench_result *result)
{
    printf("%-20s", result->entry->name);
    if (result->has_one) {
        print_time(&result->one);
    } else if (report->threads > 1) {
        printf(" %-23s", "");
    }
    print_time(&result->all);
    char rate[32] = "";
    if (result->work > 0.0) {
        snprintf(rate, sizeof rate, "%.4g %s", rate_of(result, result->all.median), unit_of(result));
    }
    printf(" %-14s", rate);
    if (result->has_peer) {
        print_time(&result->peer);
        printf(" %5.2f  %s", result->peer.median / result->all.median,
               result->agreement.is_equal ? "equal"
               : result->agreement.agrees ? "agree"
                                          : "DIFFER");
    }
    printf("\n");
    fflush(stdout);
}

// JSON ---------------------------------------------------------------------------------------------

static void json_member(FILE *stream, const char *key, double number)
{
    fprintf(stream, ", \"%s\": ", key);
    cli_json_number(stream, number);
}

static void json_text(FILE *stream, const char *key, const char *text)
{
    fprintf(stream, ", \"%s\": ", key);
    cli_json_string(stream, text);
}

static void json_agreement(FILE *stream, const struct cli_bench_result *result)
{
    const struct bench_agreement *const a = &result->agreement;
    fprintf(stream, ", \"agrees\": %s, \"equal\": %s", a->agrees ? "true" : "false",
            a->is_equal ? "true" : "false");
    json_member(stream, "coverage_pixels", (double)a->coverage);
    json_member(stream, "outlier_pixels", (double)a->outliers);
    json_member(stream, "largest_color_255", a->color);
    json_member(stream, "largest_depth", a->depth);
    json_member(stream, "mean_difference", a->mean);
}

static void json_peer(FILE *stream, const struct cli_bench_report *report,
                      const struct cli_bench_result *result)
{
    fputs(", \"peers\": {", stream);
    if (result->has_peer) {
        cli_json_string(stream, peer_of(report));
        fputs(": {\"ms\": ", stream);
        cli_json_number(stream, result->peer.median);
        json_member(stream, "ratio", result->peer.median / result->all.median);
        json_member(stream, "min_ms", result->peer.least);
        json_member(stream, "max_ms", result->peer.most);
        json_agreement(stream, result);
        fputc('}', stream);
    }
    fputc('}', stream);
}

static void json_scene(FILE *stream, const struct cli_bench_report *report,
                       const struct cli_bench_result *result)
{
    fputs("{\"name\": ", stream);
    cli_json_string(stream, result->entry->name);
    json_member(stream, "rhw_ms", result->all.median);
    json_member(stream, "rhw_min_ms", result->all.least);
    json_member(stream, "rhw_max_ms", result->all.most);
    if (result->has_one) {
        json_member(stream, "rhw_1_thread_ms", result->one.median);
        json_member(stream, "rhw_1_thread_min_ms", result->one.least);
        json_member(stream, "rhw_1_thread_max_ms", result->one.most);
    }
    if (result->work > 0.0) {
        json_member(stream, "rate", rate_of(result, result->all.median));
        json_text(stream, "unit", unit_of(result));
    }
    json_peer(stream, report, result);
    fputc('}', stream);
}

void cli_bench_print_json(FILE *stream, const struct cli_bench_report *report)
{
    fputs("{\"cpu\": ", stream);
    cli_json_string(stream, report->cpu);
    json_member(stream, "cores", report->cores);
    json_text(stream, "rhw", rhw_version());
    json_text(stream, "isa", rhw_isa_name(report->isa));
    json_member(stream, "threads", report->threads);
    json_member(stream, "width", report->job->width);
    json_member(stream, "height", report->job->height);
    json_member(stream, "frames", report->job->frames);
    json_text(stream, "peer", report->peer_name);
    fputs(",\n  \"scenes\": [", stream);
    for (int i = 0; i < report->result_count; i++) {
        fputs(i ? ",\n    " : "\n    ", stream);
        json_scene(stream, report, &report->results[i]);
    }
    fputs("\n  ]\n}\n", stream);
}

// CSV ----------------------------------------------------------------------------------------------

static void csv_time(FILE *stream, bool present, const struct bench_time *time)
{
    if (present) {
        fprintf(stream, ",%.4f,%.4f,%.4f", time->median, time->least, time->most);
    } else {
        fputs(",,,", stream);
    }
}

void cli_bench_print_csv(FILE *stream, const struct cli_bench_report *report)
{
    fputs("scene,rhw_ms,rhw_min_ms,rhw_max_ms,rhw_1_thread_ms,rhw_1_thread_min_ms,rhw_1_thread_max_ms,"
          "rate,unit,peer,peer_ms,peer_min_ms,peer_max_ms,ratio,agrees,peer_version\n",
          stream);
    for (int i = 0; i < report->result_count; i++) {
        const struct cli_bench_result *const r = &report->results[i];
        fputs(r->entry->name, stream);
        csv_time(stream, true, &r->all);
        csv_time(stream, r->has_one, &r->one);
        if (r->work > 0.0) {
            fprintf(stream, ",%.5g,%s", rate_of(r, r->all.median), unit_of(r));
        } else {
            fputs(",,", stream);
        }
        fprintf(stream, ",%s", r->has_peer ? peer_of(report) : "");
        csv_time(stream, r->has_peer, &r->peer);
        if (r->has_peer) {
            fprintf(stream, ",%.4f,%s,%s", r->peer.median / r->all.median, r->agreement.agrees ? "yes" : "no",
                    peer_version(report));
        } else {
            fputs(",,,", stream);
        }
        fputc('\n', stream);
    }
}
