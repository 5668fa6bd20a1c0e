// SPDX-License-Identifier: MIT
// The command line of rhw bench.
#include "bench_job.h"
#include "options.h"
#include "output_file.h"
#include "rhw/rhw.h"

#include <string.h>
#include <sys/stat.h>

enum {
    OPTION_SIZE = 's',
    OPTION_THREADS = 'j',
    OPTION_SCENE = 256,
    OPTION_LIST,
    OPTION_FRAMES,
    OPTION_ISA,
    OPTION_PEER,
    OPTION_PEER_THREADS,
    OPTION_JSON,
    OPTION_CSV,
    OPTION_SAVE
};

static const struct cli_option options[] = {
    {"scene", OPTION_SCENE, "LIST",
     "scenes to draw, separated by commas; the beginning of names stands for\nall of them; default: every "
     "scene"},
    {"list", OPTION_LIST, NULL, "list the scenes and exit"},
    {"size", OPTION_SIZE, "WxH", "pixels, each way 1..16384; default 1920x1080"},
    {"frames", OPTION_FRAMES, "N", "frames that count, 1..10000, after 3 that do not; default 15"},
    {"threads", OPTION_THREADS, "LIST",
     "threads of rhw, 1..64; default: one for each core that the process may\nuse; one thread is timed as "
     "well. Up to 8 numbers: each is timed, beside\nno peer, with what threads do and wait for in a frame"},
    {"isa", OPTION_ISA, "NAME", "baseline, avx2 or avx512; default: avx2 where the CPU has it"},
    {"peer", OPTION_PEER, "NAME",
     "what to compare with: llvmpipe (the default), softpipe, interpreter,\nmachine, emitted or none; the "
     "three are "
     "rhw with shaders of GLSL:\ninterpreted, as machine code, or as C where it was built so"},
    {"peer-threads", OPTION_PEER_THREADS, "N", "threads of llvmpipe, 1..32; default: all cores"},
    {"json", OPTION_JSON, "[FILE]", "print the results as JSON instead of a table, or write it to FILE"},
    {"csv", OPTION_CSV, "[FILE]", "the same as comma-separated values"},
    {"save", OPTION_SAVE, "DIR", "write the pictures of rhw and of the peer to DIR, which must exist"},
};

static const char notes[] =
    "A frame is clear, draw and the finished image in memory. Renderers take turns, frame by frame; the "
    "table\n"
    "gives medians, the ratio is the peer's time over that of rhw with all threads. The pictures must "
    "agree:\n"
    "the same pixels covered, colours within 1/255 but for the exceptions that docs/performance.md "
    "explains.\n\n"
    "Exit status: 0, 1 when a picture differs or a renderer fails, 2 for a wrong command line.";

static const struct cli_verb verb = {
    .name = "bench",
    .operands = "",
    .summary = "Times the scenes of docs/performance.md, beside another renderer where the machine has one.",
    .options = options,
    .option_count = (int)(sizeof options / sizeof *options),
    .notes = notes,
};

// Marks the scene of that name, or else all whose names begin so.
static bool want_scene(struct cli_bench_job *job, const char *name, size_t length)
{
    bool found = false;
    for (int whole = 1; whole >= 0 && !found; whole--) {
        for (int i = 0; i < bench_scene_entry_count && length > 0; i++) {
            const char *const candidate = bench_scene_entries[i].name;
            if (strncmp(candidate, name, length) == 0 && (!whole || candidate[length] == '\0')) {
                job->wanted[i] = found = true;
            }
        }
    }
    if (!found) {
        cli_error("--scene", "there is no scene '%.*s'; see 'rhw bench --list'", (int)length, name);
    }
    return found;
}

static bool parse_scenes(struct cli_bench_job *job, const char *list)
{
    for (;;) {
        const size_t length = strcspn(list, ",");
        if (!want_scene(job, list, length)) {
            return false;
        }
        if (list[length] == '\0') {
            return true;
        }
        list += length + 1;
    }
}

static bool parse_number(const char *option, const char *text, int least, int most, int *value)
{
    if (cli_parse_int(text, least, most, value)) {
        return true;
    }
    cli_error(option, "'%s' is not a number of %d to %d", text, least, most);
    return false;
}

static bool parse_threads(struct cli_bench_job *job, const char *list)
{
    job->thread_counts = 0;
    for (;;) {
        char number[16];
        const size_t length = strcspn(list, ",");
        snprintf(number, sizeof number, "%.*s", (int)length, list);
        if (job->thread_counts == CLI_BENCH_COUNTS_MAX) {
            cli_error("--threads", "takes %d numbers at most", CLI_BENCH_COUNTS_MAX);
            return false;
        }
        if (!parse_number("--threads", length < sizeof number ? number : list, 1, RHW_MAX_THREADS,
                          &job->threads[job->thread_counts++])) {
            return false;
        }
        if (list[length] == '\0') {
            return true;
        }
        list += length + 1;
    }
}

static bool parse_isa(struct cli_bench_job *job, const char *text)
{
    const char *names[RHW_ISA_COUNT];
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        names[isa] = rhw_isa_name((enum rhw_isa)isa);
    }
    const int isa = cli_parse_name(text, names, RHW_ISA_COUNT);
    if (isa < 0) {
        cli_error("--isa", "'%s' is not baseline, avx2 or avx512", text);
        return false;
    }
    job->isa = (enum rhw_isa)isa;
    return true;
}

static bool parse_peer(struct cli_bench_job *job, const char *text)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "interpreter", "machine", "emitted", "none"};
    const int peer = cli_parse_name(text, names, 6);
    if (peer < 0) {
        cli_error("--peer", "'%s' is not llvmpipe, softpipe, interpreter, machine, emitted or none", text);
        return false;
    }
    job->peer = peer < 5 ? names[peer] : NULL;
    return true;
}

static bool parse_size(struct cli_bench_job *job, const char *text)
{
    if (cli_parse_size(text, &job->width, &job->height)) {
        return true;
    }
    cli_error("--size", "'%s' is not WxH with both 1..%d", text, RHW_MAX_TARGET_SIZE);
    return false;
}

// Known before anything is drawn: minutes would be lost.
static bool can_write(const struct cli_bench_job *job)
{
    struct stat folder;
    if (job->save && (stat(job->save, &folder) != 0 || !S_ISDIR(folder.st_mode))) {
        cli_error(job->save, "is no folder to save pictures in");
        return false;
    }
    return (!job->json_path || cli_output_file_check(job->json_path)) &&
           (!job->csv_path || cli_output_file_check(job->csv_path));
}

static bool take_option(struct cli_bench_job *job, int id, const char *argument)
{
    switch (id) {
    case OPTION_SCENE: return parse_scenes(job, argument);
    case OPTION_SIZE: return parse_size(job, argument);
    case OPTION_FRAMES: return parse_number("--frames", argument, 1, BENCH_FRAMES_MAX, &job->frames);
    case OPTION_THREADS: return parse_threads(job, argument);
    case OPTION_ISA: return parse_isa(job, argument);
    case OPTION_PEER: return parse_peer(job, argument);
    case OPTION_PEER_THREADS: return parse_number("--peer-threads", argument, 1, 32, &job->peer_threads);
    case OPTION_JSON: job->json = true, job->json_path = argument; return true;
    case OPTION_CSV: job->csv = true, job->csv_path = argument; return true;
    case OPTION_SAVE: job->save = argument; return true;
    default: return true;
    }
}

static void print_list(void)
{
    for (int i = 0; i < bench_scene_entry_count; i++) {
        printf("%-20s %s\n", bench_scene_entries[i].name, bench_scene_entries[i].what);
    }
}

int cli_bench_options(int argc, char **argv, struct cli_bench_job *job, bool *go)
{
    struct cli_parser parser;
    *job = (struct cli_bench_job){.width = 1920,
                                  .height = 1080,
                                  .frames = 15,
                                  .isa = RHW_ISA_COUNT,
                                  .peer = "llvmpipe",
                                  .thread_counts = 1};
    *go = false;
    cli_parser_start(&parser, &verb, argc, argv);
    bool list = false, chosen = false;
    int id;
    while ((id = cli_parser_next(&parser)) > 0) {
        if (!take_option(job, id, parser.argument)) {
            return CLI_USAGE;
        }
        list = list || id == OPTION_LIST;
        chosen = chosen || id == OPTION_SCENE;
    }
    if (id == CLI_OPTION_STOP) {
        return parser.status;
    }
    if (!cli_parser_operands(&parser, 0, 0)) {
        return CLI_USAGE;
    }
    if (job->json && job->csv && !job->json_path && !job->csv_path) {
        cli_error("--csv", "standard output takes one of --json and --csv");
        return CLI_USAGE;
    }
    if (job->isa != RHW_ISA_COUNT && !rhw_isa_supported(job->isa)) {
        cli_error("--isa", "this CPU does not run %s", rhw_isa_name(job->isa));
        return CLI_FAILED;
    }
    if (!can_write(job)) {
        return CLI_FAILED;
    }
    for (int i = 0; i < bench_scene_entry_count && !chosen; i++) {
        job->wanted[i] = true;
    }
    if (list) {
        print_list();
    }
    *go = !list;
    return CLI_OK;
}
