// SPDX-License-Identifier: MIT
// Lesson 17: the number of every pixel is that of the ball which a ray through it meets first.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "17_ids.c"
#undef main

// The ball that a pixel's ray meets first, of that radius; −1: none.
static int find_ball(int column, int row, double radius)
{
    double direction[3];
    lesson_ray(eye, target_point, zoom, SIZE, column + 0.5, row + 0.5, direction);
    int found = -1;
    double nearest = 1e30;
    for (int i = 0; i < THINGS; i++) {
        double to[3];
        for (int k = 0; k < 3; k++) {
            to[k] = (i >> (2 * k) & 3) - 1.5 - (double)eye[k];
        }
        const double middle = lesson_dot(to, direction), square = lesson_dot(to, to) - middle * middle;
        const double where = middle - sqrt(fmax(radius * radius - square, 0));
        if (square < radius * radius && where < nearest) {
            nearest = where;
            found = i;
        }
    }
    return found;
}

static void numbers_are_those_of_rays(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture colors = picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE, SIZE, 1),
                      ids = picture_target(context, RHW_FORMAT_R32_UINT, SIZE, SIZE, 1);
    draw(context, colors, ids);
    static uint32_t numbers[SIZE * SIZE];
    must(rhw_texture_read(context, ids, 0, numbers, 0), "read");
    int compared = 0;
    bool seen[THINGS] = {false};
    for (int p = 0; p < SIZE * SIZE; p++) {
        // Where a smaller and a larger ball would be the same: not at edges, where corners are.
        const int inner = find_ball(p % SIZE, p / SIZE, 0.412), outer = find_ball(p % SIZE, p / SIZE, 0.426);
        if (inner == outer) {
            compared++;
            assert_int_equal(numbers[p], inner < 0 ? nothing : first_number + (uint32_t)inner);
            if (inner >= 0) {
                seen[inner] = true;
            }
        }
    }
    assert_true(compared > SIZE * SIZE * 9 / 10);
    int different = 0;
    for (int i = 0; i < THINGS; i++) {
        different += seen[i];
    }
    assert_true(different > 30 && seen[CHOSEN]);
    rhw_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_are_those_of_rays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
