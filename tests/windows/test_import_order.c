// SPDX-License-Identifier: MIT
// What the thread that reads a model file uses is its own: the caller's options may be gone when it comes to them. Its readers
// are none of ours here; one stands for them all.
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "import/import.h"
#include "import/blob.h"

static atomic_int compared; // strings, when the reader has come to its end
static atomic_int changed;
static atomic_bool is_late; // the reader takes longer than its time, 5 s of the clock

static void compare(const char *text, const char *expected)
{
    atomic_fetch_add(&changed, strcmp(text, expected) != 0);
    atomic_fetch_add(&compared, 1);
}

void scene_import_run(struct scene_import *import)
{
    sleep(atomic_load(&is_late) ? 7 : 0);
    compare(import->model.path, "test_import_order.c");
    compare(import->name, "name");
    compare(import->variant, "variant");
    compare(import->animation, "animation");
    scene_import_fail(import, "it is read");
}

bool scene_blob_write(const struct scene_model *model, FILE *file)
{
    (void)model;
    (void)file;
    return false;
}

struct scene_model *scene_blob_read(void *bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return NULL;
}

void scene_import_read(struct scene_import *import)
{
    (void)import;
}

// Loads by options that are overwritten after that, as memory that is freed may be.
static void load(struct scene_progress *progress, const struct scene_arrays *arrays, char error[256])
{
    static char texts[4][32];
    static const char *const expected[4] = {"test_import_order.c", "name", "variant", "animation"};
    for (int i = 0; i < 4; i++) {
        strcpy(texts[i], expected[i]);
    }
    const struct scene_import import = {.read = scene_import_read, .model.path = texts[0], .arrays = arrays};
    const struct scene_model_options options = {
        .seconds = 1, .name = texts[1], .variant = texts[2], .animation = texts[3], .progress = progress};
    atomic_store(&compared, 0);
    atomic_store(&changed, 0);
    assert_null(scene_import_start(&import, &options, error, 256));
    memset(texts, 'x', sizeof texts);
    texts[3][31] = '\0';
}

static void test_a_reader_in_time(void **state)
{
    (void)state;
    char error[256] = "";
    load(NULL, NULL, error);
    assert_string_equal(error, "it is read");
    assert_int_equal(atomic_load(&compared), 4);
    assert_int_equal(atomic_load(&changed), 0);
}

static void test_a_reader_that_runs_out_of_time(void **state)
{
    (void)state;
    char error[256] = "";
    atomic_store(&is_late, true);
    load(NULL, NULL, error);
    assert_string_equal(error, "import took more than 5 s");
    assert_int_equal(atomic_load(&compared), 0);
    for (int tries = 0; tries < 300 && atomic_load(&compared) < 4; tries++) {
        usleep(100000);
    }
    assert_int_equal(atomic_load(&compared), 4);
    assert_int_equal(atomic_load(&changed), 0);
}

// Memory of the caller that is not copied.
static void test_a_reader_that_borrows_is_waited_for(void **state)
{
    (void)state;
    atomic_store(&is_late, true);
    struct scene_progress progress = {0}; // and arrays are no more than an address here
    for (int i = 0; i < 2; i++) {
        char error[256] = "";
        load(i == 0 ? &progress : NULL, i == 0 ? NULL : (const struct scene_arrays *)&progress, error);
        assert_string_equal(error, "it is read");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_reader_in_time),
        cmocka_unit_test(test_a_reader_that_runs_out_of_time),
        cmocka_unit_test(test_a_reader_that_borrows_is_waited_for),
    };
    return cmocka_run_group_tests_name("test_import_order", tests, NULL, NULL);
}
