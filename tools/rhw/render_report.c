// SPDX-License-Identifier: MIT
// What rhw render --stats writes: times by stage and what went through the pipeline, as JSON.
#include "json.h"
#include "memory_limit.h"
#include "message.h"
#include "output_file.h"
#include "render_job.h"

#include <inttypes.h>
#include <string.h>

static void print_outputs(FILE *stream, unsigned kinds)
{
    const char *separator = "";
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        if (kinds >> kind & 1) {
            fprintf(stream, "%s\"%s\"", separator, scene_outputs[kind].word);
            separator = ", ";
        }
    }
}

static void print_times(FILE *stream, const struct scene_draw_stats *stats,
                        const struct cli_render_times *times)
{
    const struct rhw_stats *pipeline = &stats->pipeline;
    fprintf(stream,
            "  \"times_ms\": {\n    \"import\": %.3f,\n    \"upload\": %.3f,\n    \"light\": %.3f,\n    "
            "\"record\": %.3f,\n"
            "    \"front\": %.3f,\n    \"back\": %.3f,\n",
            times->import_ms, stats->upload_ms, stats->light_ms, pipeline->record_ms, pipeline->front_ms,
            pipeline->back_ms);
    fprintf(stream,
            "    \"resolve\": %.3f,\n    \"read\": %.3f,\n    \"encode\": %.3f,\n    \"total\": %.3f\n  },\n",
            stats->resolve_ms, stats->read_ms, times->encode_ms, times->total_ms);
    fprintf(stream,
            "  \"busy_ms\": {\"front\": %.3f, \"vertex\": %.3f, \"setup\": %.3f, \"bin\": %.3f, "
            "\"back\": %.3f},\n",
            pipeline->front_busy_ms, pipeline->vertex_busy_ms, pipeline->setup_busy_ms, pipeline->bin_busy_ms,
            pipeline->back_busy_ms);
}

static void print_report(FILE *stream, const struct cli_render_job *job, const struct scene_model *model,
                         const struct scene_draw_stats *stats, const struct cli_render_times *times)
{
    const struct rhw_stats *pipeline = &stats->pipeline;
    const double lanes = (double)pipeline->fragment_groups * 8.0;
    fputs("{\n  \"model\": ", stream);
    cli_json_string(stream, job->model_path);
    fputs(",\n  \"model_format\": ", stream);
    cli_json_string(stream, model->format);
    fprintf(stream, ",\n  \"up\": \"%s\",\n  \"up_from\": \"%s\"",
            cli_axis_names[job->has_up ? job->up : model->up],
            job->has_up         ? "option"
            : model->up_guessed ? "shape"
                                : "format");
    fprintf(stream,
            ",\n  \"width\": %d,\n  \"height\": %d,\n  \"samples\": %d,\n  \"supersample\": %d,\n  "
            "\"outputs\": [",
            job->width, job->height, job->samples, job->supersample);
    print_outputs(stream, job->kinds);
    fprintf(stream, "],\n  \"threads\": %d,\n  \"isa\": \"%s\",\n", pipeline->threads,
            rhw_isa_name(pipeline->isa));
    print_times(stream, stats, times);
    fprintf(stream,
            "  \"triangles\": {\"in\": %" PRIu64 ", \"dropped\": %" PRIu64 ", \"clipped\": %" PRIu64
            ", \"culled\": %" PRIu64 ", \"rasterized\": %" PRIu64 "},\n",
            pipeline->triangles_in, pipeline->triangles_dropped, pipeline->triangles_clipped,
            pipeline->triangles_culled, pipeline->triangles_rasterized);
    fprintf(stream, "  \"draws\": %" PRIu64 ",\n  \"vertices_shaded\": %" PRIu64 ",\n", pipeline->draws,
            pipeline->vertices_shaded);
    fprintf(stream,
            "  \"fragments\": {\"shaded\": %" PRIu64 ", \"groups\": %" PRIu64
            ", \"lane_occupancy\": %.4f},\n",
            pipeline->fragments_shaded, pipeline->fragment_groups,
            lanes > 0.0 ? (double)pipeline->fragments_shaded / lanes : 0.0);
    fprintf(stream, "  \"tiles\": %d,\n  \"bin_entries\": %" PRIu64 ",\n  \"flushes\": %" PRIu64 ",\n",
            pipeline->tiles, pipeline->bin_entries, pipeline->flushes);
    fprintf(stream,
            "  \"geometry_peak\": %" PRIu64 ",\n  \"memory_peak\": %" PRIu64
            ",\n  \"process_memory_peak\": %" PRIu64 "\n}\n",
            pipeline->geometry_peak, pipeline->memory_peak, system_memory_peak());
}

bool cli_render_report(const struct cli_render_job *job, const struct scene_model *model,
                       const struct scene_draw_stats *stats, const struct cli_render_times *times)
{
    if (strcmp(job->stats_path, "-") == 0) {
        print_report(stdout, job, model, stats, times);
        return true; // main reports what cannot be written to standard output
    }
    struct cli_output_file file;
    if (!cli_output_file_open(&file, job->stats_path)) {
        return false;
    }
    print_report(file.stream, job, model, stats, times);
    const bool written = cli_output_file_finish(&file) && cli_output_file_commit(&file);
    if (!written) {
        cli_output_file_discard(&file);
    }
    return written;
}
