// SPDX-License-Identifier: MIT
// Measures how far librhw is from exact arithmetic: draws random triangles of every family, compares every
// sample with the oracle, prints a table. Fails when a bound or an equality is broken, and then says how to
// see the fragment again.
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"
#include "peer_gles.h"
#include "probe.h"
#include "table.h"

enum { MAX_JOBS = 64, MAX_PEERS = 4 };

// ULP of the largest vertex value; docs/exactness.md adds up the first three. Behind a vertex with W <= 0 weights on
// the screen, and with them errors, may be larger.
static const double bound[QUANTITY_COUNT] = {
    [QUANTITY_SMOOTH] = 5.6,     [QUANTITY_NOPERSPECTIVE] = 5.6, [QUANTITY_DEPTH] = 0.51,
    [QUANTITY_INVERSE_W] = 0.51, [QUANTITY_SPACE] = 1,           [QUANTITY_SCREEN] = 3,
    [QUANTITY_DERIVATIVE] = 8,
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
};

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

static void *work(void *argument)
{
    struct worker *const w = argument;
    const struct options *const o = w->options;
    struct probe *const probe = probe_create(1, o->isa);
    struct judge *const judge = judge_create();
    struct scene *const scene = malloc(sizeof *scene);
    w->failed = !probe || !judge || !scene;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        const uint64_t enough = budget(o, family, o->fragments) / (uint64_t)o->jobs;
        for (uint64_t i = (uint64_t)w->number; w->results->family_fragments[family] < enough && !w->failed;
             i += (uint64_t)o->jobs) {
            scene_make(scene, (enum family)family, o->seed, o->index + i);
            judge_prepare(judge, scene);
            const struct probe_image *const image = probe_draw(probe, scene);
            w->failed = !image;
            if (image) {
                judge_compare(judge, image, &o->mode, w->results);
            }
        }
    }
    free(scene);
    judge_destroy(judge);
    probe_destroy(probe);
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
static bool measure_peer(const struct options *o, const char *driver, struct judge_results *results)
{
    const char *why;
    struct peer *const peer = peer_open(driver, &why);
    struct judge *const judge = judge_create();
    struct scene *const scene = malloc(sizeof *scene);
    if (!peer) {
        fprintf(stderr, "exactness: %s is not measured: %s\n", driver, why);
    }
    bool good = peer && judge && scene;
    for (int family = 0; family < FAMILY_COUNT && good; family++) {
        const uint64_t enough = budget(o, family, o->peer_fragments);
        for (uint64_t i = 0; results->family_fragments[family] < enough && good; i++) {
            scene_make(scene, (enum family)family, o->seed, o->index + i);
            if (peer_can_draw(scene)) {
                judge_prepare(judge, scene);
                const struct probe_image *const image = peer_draw(peer, scene);
                good = image != NULL;
                if (image) {
                    const struct judge_mode mode = {.peer = true, .derivative_stride = 1};
                    judge_compare(judge, image, &mode, results);
                }
            }
        }
    }
    if (good) {
        printf("%s: %s, %llu fragments\n", driver, peer_name(peer), (unsigned long long)results->fragments);
    }
    free(scene);
    judge_destroy(judge);
    peer_close(peer);
    return good;
}

static int measure_all(const struct options *o)
{
    static struct worker workers[MAX_JOBS];
    struct judge_results *const all = calloc((size_t)(o->jobs + o->peer_count), sizeof *all);
    bool failed = !all;
    int started = 0;
    for (; started < o->jobs && !failed; started++) {
        workers[started] = (struct worker){.options = o, .number = started, .results = &all[started]};
        failed = pthread_create(&workers[started].thread, NULL, work, &workers[started]) != 0;
        started -= failed;
    }
    for (int i = 0; i < started; i++) {
        pthread_join(workers[i].thread, NULL);
        failed = failed || workers[i].failed;
    }
    if (failed) {
        fprintf(stderr, "exactness: out of memory or threads\n");
        free(all);
        return 1;
    }
    for (int i = 1; i < o->jobs; i++) {
        judge_merge(&all[0], &all[i]);
    }
    struct table_column column[1 + MAX_PEERS] = {{"rhw", &all[0]}};
    int columns = 1;
    for (int i = 0; i < o->peer_count; i++) {
        if (measure_peer(o, o->peer[i], &all[o->jobs + i])) {
            column[columns++] = (struct table_column){o->peer[i], &all[o->jobs + i]};
        }
    }
    table_print(stdout, column, columns);
    bool good = report(&all[0]);
    if (o->table) {
        good = table_write(o->table, column, columns) && good;
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
            status = report(results) ? 0 : 1;
        }
    }
    free(results);
    free(scene);
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
