// SPDX-License-Identifier: MIT
// An import that another thread looks at, and ends.
#define _GNU_SOURCE // MAP_ANONYMOUS
#include "model_files.h"

#include <errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static struct scene_progress *make_progress(void)
{
    struct scene_progress *const progress =
        mmap(NULL, sizeof *progress, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(progress != MAP_FAILED);
    return progress;
}

static struct scene_model *load_watched(struct scene_progress *progress, char error[256])
{
    const struct scene_model_options options = {.progress = progress};
    return scene_model_load(path_of("m.obj"), &options, error, 256);
}

// Two textures, of which one is missing: that is done too.
static void write_model(void)
{
    const unsigned char white[21] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [18] = 255, 255, 255};
    write_bytes("a.tga", white, sizeof white);
    write_text("m.mtl", "newmtl a\nmap_Kd a.tga\nnewmtl b\nmap_Kd b.tga\n");
    write_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                        "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 2/1\n");
}

static void test_images_are_counted(void **state)
{
    (void)state;
    char error[256] = "";
    struct scene_progress *const progress = make_progress();
    write_model();
    struct scene_model *const model = load_watched(progress, error);
    assert_non_null(model);
    assert_int_equal(model->image_count, 2);
    assert_int_equal(progress->image_count, 2);
    assert_int_equal(progress->images, 2);
    scene_model_free(model);
    munmap(progress, sizeof *progress);
}

// A file of faces that takes longer to read than a test may.
static void write_large_model(void)
{
    enum { FACES = 3000000, LINE = 8 };
    char *const text = malloc(FACES * LINE + 64);
    assert_non_null(text);
    size_t size = (size_t)sprintf(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (int i = 0; i < FACES; i++, size += LINE) {
        memcpy(text + size, "f 1 2 3\n", LINE);
    }
    write_bytes("m.obj", text, size);
    free(text);
}

static void *stop_soon(void *user)
{
    struct scene_progress *const progress = user;
    usleep(20000);
    __atomic_store_n(&progress->stop, 1, __ATOMIC_RELAXED);
    return NULL;
}

// There is no model then, and no process is left.
static void test_an_import_can_be_stopped(void **state)
{
    (void)state;
    char error[256] = "";
    pthread_t other;
    struct scene_progress *const progress = make_progress();
    write_large_model();
    assert_int_equal(pthread_create(&other, NULL, stop_soon, progress), 0);
    assert_null(load_watched(progress, error));
    pthread_join(other, NULL);
    assert_string_equal(error, "import was stopped");
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
    munmap(progress, sizeof *progress);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_images_are_counted),
                                       cmocka_unit_test(test_an_import_can_be_stopped)};
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
