// SPDX-License-Identifier: MIT
// rhw bench: the scenes of bench/, drawn by rhw and by a peer in turn, timed and compared.
#include "bench_job.h"
#include "image_write.h"
#include "machine.h"
#include "message.h"
#include "options.h"
#include "subprocess.h"
#include "rhw/rhw.h"
#include "verbs.h"

#include <stdlib.h>
#include <string.h>

// In the order in which they take turns.
enum { ALL_THREADS, OTHERS, RENDERERS_MAX = CLI_BENCH_COUNTS_MAX };

struct bench {
    struct cli_bench_job job;
    struct cli_bench_report report;
    struct bench_renderer renderers[RENDERERS_MAX];
    int renderer_count;
    int one, peer; // numbers of renderers; −1: there is none
    bool scaling;  // the renderers are rhw with one number of threads after the other
    struct bench_image images[RENDERERS_MAX];
    bool table; // print rows as they come
    bool failed;
};

// The machine ---------------------------------------------------------------------------------------

// The CPU as the system names it.
static void find_cpu(char *name, size_t size)
{
    char line[256];
    FILE *const file = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown CPU");
    while (file && fgets(line, sizeof line, file)) {
        const char *const colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon) {
            snprintf(name, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
            break;
        }
    }
    if (file) {
        fclose(file);
    }
}

static bool open_rhw(struct bench *bench, int threads)
{
    const char *why;
    if (!bench_open_rhw(&bench->renderers[bench->renderer_count], threads, bench->job.isa, &why)) {
        cli_error("bench", "%s", why);
        return false;
    }
    bench->renderer_count++;
    return true;
}

// The numbers of threads in the order in which they were asked for.
static bool open_counts(struct bench *bench)
{
    bench->scaling = true;
    bench->one = bench->peer = -1;
    for (int i = 0; i < bench->job.thread_counts; i++) {
        if (!open_rhw(bench, bench->job.threads[i])) {
            return false;
        }
    }
    bench->report.isa = bench->renderers[0].isa;
    return true;
}

// Other shaders of rhw, or another renderer.
static bool open_peer_named(struct bench_renderer *renderer, const struct cli_bench_job *job,
                            const char **why)
{
    if (strcmp(job->peer, "interpreter") == 0) {
        return bench_open_translated(renderer, BENCH_INTERPRETER, job->threads[0], job->isa, why);
    }
    if (strcmp(job->peer, "machine") == 0) {
        return bench_open_translated(renderer, BENCH_MACHINE, job->threads[0], job->isa, why);
    }
    if (strcmp(job->peer, "emitted") == 0) {
        return bench_open_translated(renderer, BENCH_EMITTED, job->threads[0], job->isa, why);
    }
    return bench_open_gles(renderer, job->peer, why);
}

// A machine without the peer is no failure: rhw is then timed alone.
static void open_peer(struct bench *bench)
{
    const struct cli_bench_job *const job = &bench->job;
    char number[16];
    const char *why;
    bench->peer = -1;
    if (!job->peer) {
        return;
    }
    if (job->peer_threads) {
        snprintf(number, sizeof number, "%d", job->peer_threads);
        system_subprocess_set_variable("LP_NUM_THREADS", number);
    }
    if (!open_peer_named(&bench->renderers[bench->renderer_count], job, &why)) {
        cli_warning(job->peer, "not compared with: %s", why);
        return;
    }
    bench->peer = bench->renderer_count++;
    snprintf(bench->report.peer_name, sizeof bench->report.peer_name, "%s",
             bench->renderers[bench->peer].name);
}

static bool open_renderers(struct bench *bench)
{
    struct cli_bench_report *const report = &bench->report;
    if (bench->job.thread_counts > 1) {
        return open_counts(bench);
    }
    if (!open_rhw(bench, bench->job.threads[0])) {
        return false;
    }
    report->threads = bench->renderers[ALL_THREADS].threads;
    report->isa = bench->renderers[ALL_THREADS].isa;
    bench->one = report->threads > 1 ? OTHERS : -1;
    if (bench->one >= 0 && !open_rhw(bench, 1)) {
        return false;
    }
    open_peer(bench);
    return true;
}

// Pictures ------------------------------------------------------------------------------------------

static void free_images(struct bench *bench)
{
    for (int i = 0; i < RENDERERS_MAX; i++) {
        free(bench->images[i].color);
        free(bench->images[i].depth);
        bench->images[i] = (struct bench_image){0};
    }
}

// Reads the pictures of the first `count` renderers.
static bool read_images(struct bench *bench, const struct bench_scene *scene, int count)
{
    const size_t pixels = (size_t)bench->job.width * (size_t)bench->job.height;
    for (int i = 0; i < count; i++) {
        struct bench_image *const image = &bench->images[i];
        *image = (struct bench_image){.width = bench->job.width, .height = bench->job.height};
        image->color = scene->has_color ? malloc(4 * pixels) : NULL;
        image->depth = scene->has_color ? NULL : malloc(pixels * sizeof *image->depth);
        if ((!image->color && !image->depth) || !bench->renderers[i].read(&bench->renderers[i], image)) {
            cli_error(bench->renderers[i].name, "its picture cannot be read");
            return false;
        }
    }
    return true;
}

static void color_row(const void *user, int y, void *row)
{
    const struct bench_image *const image = user;
    const size_t size = 4 * (size_t)image->width;
    memcpy(row, image->color + (size_t)y * size, size);
}

static void depth_row(const void *user, int y, void *row)
{
    const struct bench_image *const image = user;
    const float *const from = image->depth + (size_t)y * (size_t)image->width;
    uint16_t *const to = row;
    for (int x = 0; x < image->width; x++) {
        to[x] = (uint16_t)(from[x] * 65535.0f + 0.5f);
    }
}

static bool save_image(const char *folder, const char *scene, const char *renderer,
                       const struct bench_image *image)
{
    char path[4096];
    struct cli_output_file file;
    const bool color = image->color != NULL;
    const struct cli_raster raster = {.width = image->width,
                                      .height = image->height,
                                      .channels = color ? 4 : 1,
                                      .bits = color ? 8 : 16,
                                      .srgb = color,
                                      .row = color ? color_row : depth_row,
                                      .user = image};
    snprintf(path, sizeof path, "%s/%s_%s.png", folder, scene, renderer);
    if (!cli_output_file_open(&file, path)) {
        return false;
    }
    if (cli_png_write(&file, &raster) && cli_output_file_finish(&file)) {
        return cli_output_file_commit(&file);
    }
    cli_output_file_discard(&file);
    return false;
}

static bool save_images(const struct bench *bench, const char *scene, bool with_peer)
{
    return save_image(bench->job.save, scene, "rhw", &bench->images[ALL_THREADS]) &&
           (!with_peer || save_image(bench->job.save, scene, bench->job.peer, &bench->images[bench->peer]));
}

// rhw's own promise, while the pictures are at hand: the number of threads changes no byte.
static bool same_for_threads(const struct bench *bench)
{
    const struct bench_image *const a = &bench->images[ALL_THREADS];
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    bool same = true;
    for (int i = 1; i < bench->renderer_count; i++) {
        const struct bench_image *const b = &bench->images[i];
        if (i != bench->peer) {
            same = same && (a->color ? memcmp(a->color, b->color, 4 * pixels) == 0
                                     : memcmp(a->depth, b->depth, pixels * sizeof *a->depth) == 0);
        }
    }
    return same;
}

// softpipe takes the longer component of a texel footprint's axis for its length, as OpenGL ES 3.0 §3.8.10 allows:
// half a level of detail too little on a diagonal. llvmpipe does not.
static struct bench_tolerance tolerance_of(const struct bench *bench, const struct bench_scene *scene)
{
    struct bench_tolerance tolerance = scene->tolerance;
    if (scene->texture_count && strcmp(bench->job.peer, "softpipe") == 0) {
        tolerance.color = 40;
    }
    return tolerance;
}

// Scenes --------------------------------------------------------------------------------------------

// `with_peer`: the peer has drawn the scene too.
static bool check_images(struct bench *bench, const struct bench_scene *scene, bool with_peer,
                         struct cli_bench_result *result)
{
    const char *const name = result->entry->name;
    const int count = bench->renderer_count - (bench->peer >= 0 && !with_peer);
    if (!read_images(bench, scene, count) || (bench->job.save && !save_images(bench, name, with_peer))) {
        return false;
    }
    if (!same_for_threads(bench)) {
        cli_error(name, "the picture differs with the number of threads");
        return false;
    }
    if (scene->shades_all && (double)bench->renderers[ALL_THREADS].fragments < scene->work) {
        cli_error(name, "fewer fragments were shaded than there are");
        bench->failed = true;
    }
    if (with_peer) {
        char text[256];
        const struct bench_tolerance tolerance = tolerance_of(bench, scene);
        result->agreement = bench_agree(&bench->images[ALL_THREADS], &bench->images[bench->peer], &tolerance);
        cli_bench_describe(result, text, sizeof text);
        if (!result->agreement.agrees) {
            cli_error(name, "the picture differs from that of %s: %s", bench->job.peer, text);
            bench->failed = true;
        }
    }
    return true;
}

static bool measure_scene(struct bench *bench, const struct bench_scene *scene,
                          struct cli_bench_result *result)
{
    struct bench_time times[RENDERERS_MAX];
    bool with_peer = bench->peer >= 0 && bench_scene_has_picture(scene); // the peer is the last
    int count = bench->renderer_count - (bench->peer >= 0 && !with_peer);
    int failed = 0, taken = 0;
    bool works = true;
    for (; works && taken < count; taken++) {
        struct bench_renderer *const renderer = &bench->renderers[taken];
        works = renderer->take(renderer, scene, bench->job.width, bench->job.height);
        if (!works && taken == bench->peer && (renderer->why[0] || scene->picture != BENCH_RGBA8)) {
            cli_warning(result->entry->name, "not compared with %s: %s", bench->job.peer,
                        renderer->why[0] ? renderer->why : "it does not draw into this format");
            renderer->release(renderer);
            with_peer = false;
            works = true;
            count--;
            break;
        }
        if (!works) {
            cli_error(renderer->name, "cannot take the scene %s", result->entry->name);
        }
    }
    if (works && !bench_measure(bench->renderers, count, bench->job.frames, times, &failed)) {
        cli_error(bench->renderers[failed].name, "cannot draw the scene %s", result->entry->name);
        works = false;
    }
    works = works && (!bench_scene_has_picture(scene) || check_images(bench, scene, with_peer, result));
    free_images(bench);
    while (taken-- > 0) {
        bench->renderers[taken].release(&bench->renderers[taken]);
    }
    if (!works) {
        return false;
    }
    result->all = times[ALL_THREADS];
    result->has_one = bench->one >= 0;
    result->has_peer = with_peer;
    if (bench->scaling) {
        memcpy(result->scaling, times, (size_t)count * sizeof *times);
    }
    if (result->has_one) {
        result->one = times[bench->one];
    }
    if (result->has_peer) {
        result->peer = times[bench->peer];
    }
    return true;
}

static void run_scene(struct bench *bench, const struct bench_scene_entry *entry)
{
    struct cli_bench_report *const report = &bench->report;
    struct cli_bench_result *const result = &report->results[report->result_count];
    struct bench_scene scene;
    char why[512];
    cli_stage("measuring", entry->name);
    if (!bench_scene_make(entry, &scene, bench->job.width, bench->job.height, why, sizeof why)) {
        cli_warning(entry->name, "left out: %s", why);
        return;
    }
    *result = (struct cli_bench_result){
        .entry = entry, .unit = scene.unit, .work = scene.work, .tolerance = scene.tolerance};
    const bool works = measure_scene(bench, &scene, result);
    bench_scene_free(&scene);
    cli_stage_end();
    if (!works) {
        bench->failed = true;
        return;
    }
    report->result_count++;
    if (bench->table) {
        (bench->scaling ? cli_bench_print_scaling_rows : cli_bench_print_row)(report, result);
    }
}

static bool write_report(const struct cli_bench_report *report, const char *path,
                         void (*print)(FILE *stream, const struct cli_bench_report *report))
{
    struct cli_output_file file;
    if (!path) {
        print(stdout, report);
        return true;
    }
    if (!cli_output_file_open(&file, path)) {
        return false;
    }
    print(file.stream, report);
    if (cli_output_file_finish(&file)) {
        return cli_output_file_commit(&file);
    }
    cli_output_file_discard(&file);
    return false;
}

static void run_scenes(struct bench *bench)
{
    const struct cli_bench_job *const job = &bench->job;
    bench->table = !(job->json && !job->json_path) && !(job->csv && !job->csv_path);
    if (bench->table) {
        (bench->scaling ? cli_bench_print_scaling_head : cli_bench_print_head)(&bench->report);
    }
    for (int i = 0; i < bench_scene_entry_count; i++) {
        if (job->wanted[i]) {
            run_scene(bench, &bench_scene_entries[i]);
        }
    }
    if (bench->report.result_count == 0 && !bench->failed) {
        cli_error("bench", "no scene was timed");
        bench->failed = true;
    }
    if ((job->json && !write_report(&bench->report, job->json_path,
                                    bench->scaling ? cli_bench_print_scaling_json : cli_bench_print_json)) ||
        (job->csv && !write_report(&bench->report, job->csv_path,
                                   bench->scaling ? cli_bench_print_scaling_csv : cli_bench_print_csv))) {
        bench->failed = true;
    }
}

int cli_bench(int argc, char **argv)
{
    bool go;
    struct bench *const bench = calloc(1, sizeof *bench);
    if (!bench) {
        cli_error("bench", "out of memory");
        return CLI_FAILED;
    }
    int status = cli_bench_options(argc, argv, &bench->job, &go);
    if (go) {
        bench->report.job = &bench->job;
        bench->report.cores = system_machine_processors();
        find_cpu(bench->report.cpu, sizeof bench->report.cpu);
        if (open_renderers(bench)) {
            run_scenes(bench);
        } else {
            bench->failed = true;
        }
        status = bench->failed ? CLI_FAILED : CLI_OK;
    }
    while (bench->renderer_count-- > 0) {
        bench->renderers[bench->renderer_count].close(&bench->renderers[bench->renderer_count]);
    }
    free(bench);
    return status;
}
