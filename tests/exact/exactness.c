// SPDX-License-Identifier: MIT
// Measures how far librhw is from exact arithmetic: draws random triangles of every family, compares every
// sample with the oracle, prints a table. Fails when a bound or an equality is broken, and then says how to
// see the fragment again.
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

#include "judge.h"
#include "peer_gles.h"
#include "primitive_judge.h"
#include "probe.h"
#include "progress.h"
#include "sampling_judge.h"
#include "table.h"

enum { MAX_JOBS = 64, MAX_PEERS = 4 };
// One scene of so many is drawn at samples, centroids and offsets too, and one as points and lines.
enum { SAMPLING_STRIDE = 7, PRIMITIVE_STRIDE = 5 };

// ULP of the largest vertex value; docs/exactness.md adds up the first three. Behind a vertex with W <= 0 weights on
// the screen, and with them errors, may be larger.
static const double bound[QUANTITY_COUNT] = {
    [QUANTITY_SMOOTH] = 5.6,        [QUANTITY_NOPERSPECTIVE] = 5.6, [QUANTITY_DEPTH] = 0.51,
    [QUANTITY_INVERSE_W] = 0.51,    [QUANTITY_SPACE] = 1,           [QUANTITY_SCREEN] = 3,
    [QUANTITY_DERIVATIVE] = 1.2,    [QUANTITY_SAMPLE] = 5.6,        [QUANTITY_CENTROID] = 5.6,
    [QUANTITY_SAMPLE_DEPTH] = 0.51, [QUANTITY_OFFSET] = 32,         [QUANTITY_POINT_COORD] = 1,
    [QUANTITY_LINE] = 5.6,          [QUANTITY_BRESENHAM] = 5.6,     [QUANTITY_PRIMITIVE_DEPTH] = 0.51,
};

// How a budget of fragments is shared out. Families of tiny triangles cost up to 60 times more per fragment.
static const int share[FAMILY_COUNT] = {
    [FAMILY_ORDINARY] = 40,    [FAMILY_SLIVER] = 3,      [FAMILY_MICRO] = 1,       [FAMILY_LARGE] = 40,
    [FAMILY_PERSPECTIVE] = 60, [FAMILY_NEAR_FAR] = 30,   [FAMILY_GUARD_BAND] = 20, [FAMILY_BEHIND] = 30,
    [FAMILY_EVERYTHING] = 20,  [FAMILY_CUT_SLIVER] = 12, [FAMILY_HORIZON] = 10,    [FAMILY_FAN] = 10,
    [FAMILY_STRIP] = 10,       [FAMILY_GRID] = 10,       [FAMILY_CUT_GRID] = 10,
};

struct options {
    uint64_t seed, index, fragments;
    enum family family; // FAMILY_COUNT: all
    bool replay;
    int x, y, jobs;
    enum rhw_isa isa;
    struct judge_mode mode;
    const char *table;           // file whose table is rewritten
    const char *peer[MAX_PEERS]; // drivers to measure as well
    int peer_count;
    uint64_t peer_fragments;
};

// One thread with a context of its own; it takes every jobs-th scene.
struct worker {
    const struct options *options;
    int number;
    pthread_t thread;
    struct judge_results *results;
    bool failed;
    // Written by the worker, read by the thread that waits for it.
    _Atomic double part; // done, 0..1
    atomic_bool ended;
};

// Set by an interrupt: whoever measures stops after its scene, and what it has is printed.
static volatile sig_atomic_t interrupted;

static void interrupt(int signal)
{
    (void)signal;
    interrupted = 1;
}

// A family's part of so many fragments.
static uint64_t budget(const struct options *o, int family, uint64_t fragments)
{
    uint64_t total = 0;
    for (int i = 0; i < FAMILY_COUNT; i++) {
        total += (uint64_t)share[i];
    }
    return o->family == FAMILY_COUNT  ? fragments * (uint64_t)share[family] / total
           : (int)o->family == family ? fragments
                                      : 0;
}

// What is left to do of a measurement: the next scene of every family. Families take turns, so that time goes evenly
// with the part that is done.
struct agenda {
    uint64_t enough[FAMILY_COUNT]; // fragments
    uint64_t next[FAMILY_COUNT];   // scene
    double part;                   // done of the family that is furthest behind
};

static struct agenda agenda_start(const struct options *o, uint64_t fragments, int jobs, int number)
{
    struct agenda a = {.part = 0};
    for (int family = 0; family < FAMILY_COUNT; family++) {
        a.enough[family] = budget(o, family, fragments) / (uint64_t)jobs;
        a.next[family] = (uint64_t)number;
    }
    return a;
}

// The family whose turn it is; FAMILY_COUNT at the end.
static enum family agenda_turn(struct agenda *a, const struct judge_results *results)
{
    enum family turn = FAMILY_COUNT;
    a->part = 1;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        const uint64_t enough = a->enough[family], done = results->family_fragments[family];
        if (done < enough && (double)done / (double)enough < a->part) {
            a->part = (double)done / (double)enough;
            turn = (enum family)family;
        }
    }
    return interrupted ? FAMILY_COUNT : turn;
}

static void *work(void *argument)
{
    struct worker *const w = argument;
    const struct options *const o = w->options;
    struct probe *const probe = probe_create(1, o->isa);
    struct judge *const judge = judge_create();
    struct sampling_judge *const sampling = sampling_judge_create(o->isa);
    struct primitive_judge *const primitives = primitive_judge_create(o->isa);
    struct scene *const scene = malloc(sizeof *scene);
    struct agenda agenda = agenda_start(o, o->fragments, o->jobs, w->number);
    w->failed = !probe || !judge || !sampling || !primitives || !scene;
    for (enum family family; !w->failed && (family = agenda_turn(&agenda, w->results)) != FAMILY_COUNT;) {
        scene_make(scene, family, o->seed, o->index + agenda.next[family]);
        agenda.next[family] += (uint64_t)o->jobs;
        judge_prepare(judge, scene);
        const struct probe_image *const image = probe_draw(probe, scene);
        w->failed = !image;
        if (image) {
            judge_compare(judge, image, &o->mode, w->results);
        }
        if (scene->index % SAMPLING_STRIDE == 0) {
            w->failed = !sampling_judge_compare(sampling, scene, w->results) || w->failed;
        }
        if (scene->index % PRIMITIVE_STRIDE == 0) {
            w->failed = !primitive_judge_compare(primitives, scene, w->results) || w->failed;
        }
        atomic_store_explicit(&w->part, agenda.part, memory_order_relaxed);
    }
    free(scene);
    primitive_judge_destroy(primitives);
    sampling_judge_destroy(sampling);
    judge_destroy(judge);
    probe_destroy(probe);
    atomic_store(&w->ended, true);
    return NULL;
}

static void print_replay(const struct tally_place *at)
{
    printf("    exactness --family %s --seed %llu --index %llu --at %d,%d\n",
           scene_family_name((enum family)at->family), (unsigned long long)at->seed,
           (unsigned long long)at->index, at->x, at->y);
}

static bool within_bound(const struct tally *t, const char *what, enum quantity quantity)
{
    if (t->worst <= bound[quantity]) {
        return true;
    }
    printf("FAILED: %s, %s: %.4g ULP, component %d\n", what, judge_quantity_name(quantity), t->worst,
           t->at.component);
    print_replay(&t->at);
    return false;
}

static bool report(const struct judge_results *r)
{
    bool good = r->fragments != 0;
    printf("\n%llu scenes, %llu triangles, %llu fragments; %llu of them off their cut triangle; %llu scenes "
           "left "
           "out for a corner on a rounding tie\n",
           (unsigned long long)r->scenes, (unsigned long long)r->triangles, (unsigned long long)r->fragments,
           (unsigned long long)r->outside, (unsigned long long)r->ambiguous);
    for (int i = 0; i < EQUALITY_COUNT; i++) {
        if (r->unequal[i] != 0) {
            good = false;
            printf("FAILED: %s differs %llu times, first:\n", judge_equality_name((enum equality)i),
                   (unsigned long long)r->unequal[i]);
            print_replay(&r->unequal_at[i]);
        }
    }
    for (int f = 0; f < FAMILY_COUNT; f++) {
        for (int q = 0; q < QUANTITY_COUNT; q++) {
            good =
                within_bound(&r->quantity[f][q], scene_family_name((enum family)f), (enum quantity)q) && good;
        }
    }
    for (int k = 0; k < VALUE_KINDS; k++) {
        good = within_bound(&r->kind[k][0], scene_kind_name((enum value_kind)k), QUANTITY_SMOOTH) && good;
        good =
            within_bound(&r->kind[k][1], scene_kind_name((enum value_kind)k), QUANTITY_NOPERSPECTIVE) && good;
    }
    return good;
}

// The same scenes through a peer, as far as it can draw them. Odd scenes are off the 1/256 grid: only what is
// cut counts there.
static bool measure_peer(const struct options *o, const char *driver, struct judge_results *results,
                         char *title, size_t size)
{
    const char *why;
    struct peer *const peer = peer_open(driver, &why);
    struct judge *const judge = judge_create();
    struct scene *const scene = malloc(sizeof *scene);
    struct agenda agenda = agenda_start(o, o->peer_fragments, 1, 0);
    struct progress progress;
    if (!peer) {
        fprintf(stderr, "exactness: %s is not measured: %s\n", driver, why);
    }
    progress_start(&progress, driver);
    bool good = peer && judge && scene;
    for (enum family family; good && (family = agenda_turn(&agenda, results)) != FAMILY_COUNT;) {
        scene_make(scene, family, o->seed, o->index + agenda.next[family]++);
        if (peer_can_draw(scene)) {
            judge_prepare(judge, scene);
            const struct probe_image *const image = peer_draw(peer, scene);
            good = image != NULL;
            if (image) {
                const struct judge_mode mode = {.peer = true, .derivative_stride = 1};
                judge_compare(judge, image, &mode, results);
            }
        }
        progress_say(&progress, agenda.part);
    }
    progress_end(&progress);
    if (good) {
        snprintf(title, size, "%s", peer_name(peer));
    }
    free(scene);
    judge_destroy(judge);
    peer_close(peer);
    return good;
}

// Waits for the workers and says meanwhile how far they are.
static void wait_for(struct worker *workers, int count)
{
    struct progress progress;
    progress_start(&progress, "rhw");
    for (int ended = 0; ended < count;) {
        double part = 1;
        ended = 0;
        for (int i = 0; i < count; i++) {
            const bool has_ended = atomic_load(&workers[i].ended);
            const double done = has_ended ? 1 : atomic_load_explicit(&workers[i].part, memory_order_relaxed);
            part = done < part ? done : part;
            ended += has_ended;
        }
        progress_say(&progress, part);
        if (ended < count) {
            thrd_sleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
        }
    }
    progress_end(&progress);
    for (int i = 0; i < count; i++) {
        pthread_join(workers[i].thread, NULL);
    }
}

// Measures librhw with all workers; the sum is in results[0].
static bool measure(const struct options *o, struct judge_results *results)
{
    static struct worker workers[MAX_JOBS];
    int started = 0;
    bool failed = false;
    while (started < o->jobs && !failed) {
        struct worker *const w = &workers[started];
        w->options = o;
        w->number = started;
        w->results = &results[started];
        failed = pthread_create(&w->thread, NULL, work, w) != 0;
        started += !failed;
    }
    wait_for(workers, started);
    for (int i = 0; i < started; i++) {
        failed = failed || workers[i].failed;
        if (i > 0) {
            judge_merge(&results[0], &results[i]);
        }
    }
    return !failed;
}

static int measure_all(const struct options *o)
{
    struct judge_results *const all = calloc((size_t)(o->jobs + o->peer_count), sizeof *all);
    signal(SIGINT, interrupt);
    signal(SIGTERM, interrupt);
    if (!all || !measure(o, all)) {
        fprintf(stderr, "exactness: out of memory or threads\n");
        free(all);
        return 1;
    }
    char title[1 + MAX_PEERS][256];
    snprintf(title[0], sizeof title[0], "rhw %d.%d.%d", RHW_VERSION_MAJOR, RHW_VERSION_MINOR,
             RHW_VERSION_PATCH);
    struct table_column column[1 + MAX_PEERS] = {{"rhw", title[0], &all[0]}};
    int columns = 1;
    for (int i = 0; i < o->peer_count && !interrupted; i++) {
        if (measure_peer(o, o->peer[i], &all[o->jobs + i], title[columns], sizeof title[columns])) {
            column[columns] = (struct table_column){o->peer[i], title[columns], &all[o->jobs + i]};
            columns++;
        }
    }
    table_print(stdout, column, columns, bound);
    bool good = report(&all[0]);
    if (interrupted) {
        fprintf(stderr, "exactness: interrupted; no file was changed\n");
        good = false;
    } else if (o->table) {
        good = table_write(o->table, column, columns, bound) && good;
    }
    free(all);
    return good ? 0 : 1;
}

// One scene again, with everything about one pixel: as librhw draws it or as the first peer named does.
static int replay(const struct options *o)
{
    const char *why = "";
    struct probe *const probe = probe_create(1, o->isa);
    struct peer *const peer = o->peer_count != 0 ? peer_open(o->peer[0], &why) : NULL;
    struct judge *const judge = judge_create();
    struct sampling_judge *const sampling = sampling_judge_create(o->isa);
    struct primitive_judge *const primitives = primitive_judge_create(o->isa);
    struct scene *const scene = calloc(1, sizeof *scene);
    struct judge_results *const results = calloc(1, sizeof *results);
    struct judge_mode mode = o->mode;
    mode.peer = o->peer_count != 0;
    int status = 1;
    if (mode.peer && !peer) {
        fprintf(stderr, "exactness: %s: %s\n", o->peer[0], why);
    } else if (probe && judge && scene && results) {
        scene_make(scene, o->family, o->seed, o->index);
        judge_prepare(judge, scene);
        const struct probe_image *const image = peer ? peer_draw(peer, scene) : probe_draw(probe, scene);
        if (image) {
            printf("%s: viewport %g %g %g %g, depth %g..%g%s, target %d×%d\n",
                   peer ? peer_name(peer) : probe_isa_name(probe), (double)scene->view.x,
                   (double)scene->view.y, (double)scene->view.width, (double)scene->view.height,
                   (double)scene->view.depth_min, (double)scene->view.depth_max,
                   scene->view.minus_one_to_one ? ", Z from -W" : "", image->width, image->height);
            if (o->x >= 0 && o->y >= 0 && o->x < image->width && o->y < image->height) {
                judge_explain(judge, image, o->x, o->y);
            }
            judge_compare(judge, image, &mode, results);
            if (sampling && primitives && !peer) {
                sampling_judge_compare(sampling, scene, results);
                primitive_judge_compare(primitives, scene, results);
            }
            status = report(results) ? 0 : 1;
        }
    }
    free(results);
    free(scene);
    primitive_judge_destroy(primitives);
    sampling_judge_destroy(sampling);
    judge_destroy(judge);
    peer_close(peer);
    probe_destroy(probe);
    return status;
}

static int usage(void)
{
    fprintf(stderr, "usage: exactness [--fragments N] [--family NAME] [--seed N] [--jobs N] [--isa NAME]\n"
                    "                 [--integers] [--derivatives EVERY] [--table FILE]\n"
                    "                 [--peer DRIVER]... [--peer-fragments N]\n"
                    "       exactness --family NAME --index N [--seed N] [--at X,Y] [--peer DRIVER]\n");
    return 2;
}

static bool parse_number(const char *text, uint64_t *number)
{
    char *end;
    errno = 0;
    const double v = strtod(text, &end); // 1e9 is welcome
    *number = (uint64_t)v;
    return errno == 0 && end != text && *end == 0 && v >= 0 && v < 0x1p53;
}

static bool parse_option(struct options *o, const char *name, const char *value)
{
    uint64_t number = 0;
    const bool is_number = parse_number(value, &number);
    if (strcmp(name, "--fragments") == 0) {
        o->fragments = number;
    } else if (strcmp(name, "--peer-fragments") == 0) {
        o->peer_fragments = number;
    } else if (strcmp(name, "--seed") == 0) {
        o->seed = number;
    } else if (strcmp(name, "--index") == 0) {
        o->index = number;
        o->replay = true;
    } else if (strcmp(name, "--jobs") == 0 && number >= 1 && number <= MAX_JOBS) {
        o->jobs = (int)number;
    } else if (strcmp(name, "--derivatives") == 0 && number >= 1 && number <= 1000) {
        o->mode.derivative_stride = (int)number;
    } else if (strcmp(name, "--family") == 0) {
        o->family = scene_family_named(value);
        return o->family != FAMILY_COUNT;
    } else if (strcmp(name, "--isa") == 0) {
        int isa = 0;
        while (isa < RHW_ISA_COUNT && strcmp(rhw_isa_name((enum rhw_isa)isa), value) != 0) {
            isa++;
        }
        o->isa = (enum rhw_isa)isa;
        return isa < RHW_ISA_COUNT;
    } else if (strcmp(name, "--at") == 0) {
        return sscanf(value, "%d,%d", &o->x, &o->y) == 2;
    } else if (strcmp(name, "--peer") == 0) {
        o->peer[o->peer_count] = value;
        return ++o->peer_count < MAX_PEERS;
    } else if (strcmp(name, "--table") == 0) {
        o->table = value;
        return true;
    } else {
        return false;
    }
    return is_number;
}

int main(int argc, char **argv)
{
    struct options o = {.seed = 1,
                        .fragments = 1000000,
                        .peer_fragments = 1000000,
                        .family = FAMILY_COUNT,
                        .x = -1,
                        .y = -1,
                        .jobs = 1,
                        .isa = RHW_ISA_COUNT,
                        .mode = {.derivative_stride = 8}};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--integers") == 0) {
            o.mode.integers = true;
        } else if (i + 1 >= argc || !parse_option(&o, argv[i], argv[i + 1])) {
            return usage();
        } else {
            i++;
        }
    }
    if (o.replay) {
        return o.family == FAMILY_COUNT ? usage() : replay(&o);
    }
    return measure_all(&o);
}
