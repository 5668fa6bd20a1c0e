// SPDX-License-Identifier: MIT
// What the window's painter gives and when: nothing of a model once another is shown, and a word of every order, also of one
// that fails.
#include "painter.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { LARGE_SIDE = 2048, ATTEMPTS = 20 };
enum { FIRST_SIDE = 96, SECOND_SIDE = 32, ROUNDS = 60, PATIENCE_MS = 60000 };

static _Atomic int wakes; // one for every picture and answer

static void wake(void)
{
    wakes++;
}

static void rest(long microseconds)
{
    nanosleep(&(struct timespec){.tv_nsec = microseconds * 1000}, NULL);
}

// A square in an OBJ file of the current folder.
static void write_model(const char *path)
{
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fputs("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n", file);
    assert_int_equal(fclose(file), 0);
}

static struct render read_model(char *path)
{
    static char verb[] = "render", out[] = "--out=picture.png", quiet[] = "--quiet", *words[4];
    struct render render = {0};
    int status;
    memcpy(words, (char *[]){verb, out, quiet, path}, sizeof words);
    assert_true(cli_render_job_parse(&render.job, NULL, 4, words, &status));
    assert_int_equal(cli_render_open(&render, path), 0);
    return render;
}

static struct view_order order_of(const struct render *render, int side, int version)
{
    struct view_order order = {.job = render->job, .version = version};
    const double look[10] = {0, 0, 5, 0, 0, 0, 0, 1, 0, 30};
    order.job.camera = CLI_CAMERA_LOOK;
    memcpy(order.job.look, look, sizeof look);
    order.job.width = order.job.height = side;
    return order;
}

static struct view_picture await_picture(struct view_painter *painter)
{
    struct view_picture picture;
    for (int i = 0; i < PATIENCE_MS; i++) {
        if (view_painter_take_picture(painter, &picture)) {
            return picture;
        }
        rest(1000);
    }
    fail_msg("no picture");
    return picture;
}

static struct view_answer await_answer(struct view_painter *painter)
{
    for (int i = 0; i < PATIENCE_MS; i++) {
        const struct view_answer answer = view_painter_take_answer(painter);
        if (answer.errand != VIEW_ERRAND_NONE) {
            return answer;
        }
        rest(1000);
    }
    fail_msg("no answer");
    return (struct view_answer){0};
}

static int enter_folder(void **state)
{
    static char folder[] = "/tmp/rhw-painter-XXXXXX";
    *state = folder;
    if (!mkdtemp(folder) || chdir(folder) != 0) {
        return -1;
    }
    write_model("first.obj");
    write_model("second.obj");
    return 0;
}

static int leave_folder(void **state)
{
    unlink("first.obj");
    unlink("second.obj");
    return chdir("/") == 0 && rmdir(*state) == 0 ? 0 : -1;
}

static void test_nothing_of_an_older_model(void **state)
{
    (void)state;
    static const struct scene_panorama none;
    static char first_path[] = "first.obj", second_path[] = "second.obj";
    struct view_painter *const painter = view_painter_start(&none, wake);
    for (int round = 0; round < ROUNDS; round++) {
        const struct render first = read_model(first_path), second = read_model(second_path);
        const struct view_order of_first = order_of(&first, FIRST_SIDE, round),
                                of_second = order_of(&second, SECOND_SIDE, -1);
        view_painter_show(painter, &first);
        if (round % 2 == 0) {
            view_painter_draw(painter, &of_first);
        } else {
            view_painter_send(painter, VIEW_ERRAND_EXPLAIN, &of_first, FIRST_SIDE / 2, FIRST_SIDE / 2);
        }
        rest(round * 100); // from before it begins to after its end
        view_painter_show(painter, &second);
        view_painter_draw(painter, &of_second);
        const struct view_picture picture = await_picture(painter);
        assert_int_equal(picture.version, -1);
        assert_int_equal(picture.width, SECOND_SIDE);
        free(picture.pixels);
        view_painter_send(painter, VIEW_ERRAND_EXPLAIN, &of_second, SECOND_SIDE / 2, SECOND_SIDE / 2);
        const struct view_answer answer = await_answer(painter);
        assert_int_equal(answer.errand, VIEW_ERRAND_EXPLAIN);
        assert_non_null(strstr(answer.text, "second.obj: pixel (16, 16)"));
        assert_int_equal(answer.x, SECOND_SIDE / 2);
        free(answer.text);
    }
    view_painter_stop(painter);
}

static void test_a_failure_is_told(void **state)
{
    (void)state;
    static const struct scene_panorama none;
    static char path[] = "first.obj";
    struct view_painter *const painter = view_painter_start(&none, wake);
    const struct render read = read_model(path);
    struct view_order order = order_of(&read, FIRST_SIDE, 7);
    view_painter_show(painter, &read);
    order.job.look[2] = 0.0; // eye and target are one
    view_painter_draw(painter, &order);
    const struct view_picture none_drawn = await_picture(painter);
    assert_null(none_drawn.pixels);
    assert_int_equal(none_drawn.version, 7);
    double ms;
    for (int i = 0; i < PATIENCE_MS && view_painter_doing(painter, &ms); i++) {
        rest(1000);
    }
    assert_null(view_painter_doing(painter, &ms));
    order = order_of(&read, FIRST_SIDE, 8);
    view_painter_draw(painter, &order);
    const struct view_picture picture = await_picture(painter);
    assert_non_null(picture.pixels);
    assert_int_equal(picture.version, 8);
    free(picture.pixels);
    view_painter_stop(painter);
}

static void await_drawing(struct view_painter *painter)
{
    double ms;
    const char *doing = NULL;
    for (int i = 0; i < PATIENCE_MS && !(doing && strcmp(doing, "Drawing") == 0); i++) {
        doing = view_painter_doing(painter, &ms);
        rest(1000);
    }
    if (!doing) {
        fail_msg("it does not draw");
    }
    rest(4000); // well into it
}

// A picture of one band, which is given up within its passes. Where the computer is busy it may be done before the
// second order comes, but hardly every time.
static void test_a_large_picture_gives_way(void **state)
{
    (void)state;
    static const struct scene_panorama none;
    static char path[] = "first.obj";
    struct view_painter *const painter = view_painter_start(&none, wake);
    const struct render read = read_model(path);
    view_painter_show(painter, &read);
    bool gave_way = false;
    for (int attempt = 0; attempt < ATTEMPTS && !gave_way; attempt++) {
        struct view_order large = order_of(&read, LARGE_SIDE, 1), small = order_of(&read, SECOND_SIDE, 2);
        large.job.shadows = large.job.ambient_occlusion = false;
        small.hurries = true;
        wakes = 0;
        view_painter_draw(painter, &large);
        await_drawing(painter);
        view_painter_draw(painter, &small);
        int version = 0;
        while (version != small.version) {
            const struct view_picture picture = await_picture(painter);
            version = picture.version;
            free(picture.pixels);
        }
        gave_way = wakes == 1; // of the small one alone
    }
    assert_true(gave_way);
    view_painter_stop(painter);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_of_an_older_model),
        cmocka_unit_test(test_a_failure_is_told),
        cmocka_unit_test(test_a_large_picture_gives_way),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
