// SPDX-License-Identifier: MIT
// An import that others look at, and give up.
#define _GNU_SOURCE // MAP_ANONYMOUS
#include "model_files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>

static struct scene_progress *make_progress(void)
{
    struct scene_progress *const progress =
        mmap(NULL, sizeof *progress, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(progress != MAP_FAILED);
    return progress;
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
    const struct scene_model_options options = {.progress = progress};
    struct scene_model *const model = scene_model_load(path_of("m.obj"), &options, error, sizeof error);
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

static bool asked_three_times(void *user)
{
    int *const times = user;
    return ++*times < 3;
}

// There is no model then, and no process is left.
static void test_an_import_can_be_given_up(void **state)
{
    (void)state;
    char error[256] = "";
    int times = 0;
    const struct scene_model_options options = {.goes_on = asked_three_times, .user = &times};
    write_large_model();
    assert_null(scene_model_load(path_of("m.obj"), &options, error, sizeof error));
    assert_int_equal(times, 3);
    assert_string_equal(error, "import was given up");
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_images_are_counted),
                                          cmocka_unit_test(test_an_import_can_be_given_up)};

const struct unit_tests test_import_progress = UNIT_TESTS(tests, make_directory, remove_directory);
