// SPDX-License-Identifier: MIT
// Lesson 19: the table has the sums of the drawn texels, and each blurred pixel is the mean of its square.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "19_compute.c"
#undef main

static int least_of(int a, int b)
{
    return a < b ? a : b;
}

static int most_of(int a, int b)
{
    return a > b ? a : b;
}

// Hold a blurred picture against means of the numbers; pixels whose radius is near a step are left out.
static int check_blur(rhw_context *context, rhw_texture blurred, const float *distances, struct lens lens,
                      int32_t (*numbers)[SIZE][SIZE])
{
    uint8_t *const pixels = picture_read(context, blurred, 0);
    int compared = 0;
    for (int p = 0; p < SIZE * SIZE; p += 7) {
        const int x = p % SIZE, y = p / SIZE;
        const double wanted =
            (double)lens.least +
            fmin(fabs(1 / (double)focus - 1 / (double)distances[p]) * (double)lens.aperture, 30);
        const int radius = (int)floor(wanted + 1e-4);
        if (radius != (int)floor(wanted - 1e-4) && wanted > 1e-3 && wanted != radius) {
            continue;
        }
        double sum = 0;
        int count = 0;
        for (int row = most_of(y - radius, 0); row <= least_of(y + radius, SIZE - 1); row++) {
            for (int column = most_of(x - radius, 0); column <= least_of(x + radius, SIZE - 1); column++) {
                sum += numbers[1][row][column];
                count++;
            }
        }
        lesson_close(pixels[4 * p + 1], 255 * ref_srgb_encode(sum / count / FULL), 0.51);
        compared++;
    }
    free(pixels);
    return compared;
}

static void sums_and_means(void **state)
{
    (void)state;
    static int32_t table[CHANNELS][SIZE][SIZE], numbers[CHANNELS][SIZE][SIZE];
    static float distances[SIZE * SIZE];
    rhw_context *context = picture_context();
    const rhw_sampler sampler = make_sampler(context);
    const rhw_texture colors = picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE, SIZE, 1),
                      ahead = picture_target(context, RHW_FORMAT_R32_FLOAT, SIZE, SIZE, 1);
    draw(context, colors, ahead);
    const rhw_buffer sums = make_table(context, colors, sampler, false),
                     sums1 = make_table(context, colors, sampler, true);
    must(rhw_buffer_read(context, sums1, 0, numbers, sizeof numbers), "read");
    must(rhw_buffer_read(context, sums, 0, table, sizeof table), "read");
    assert_memory_equal(numbers, table, sizeof table);
    must(rhw_texture_read(context, ahead, 0, distances, 0), "read");
    uint8_t *const pixels = picture_read(context, colors, 0);
    for (int k = 0; k < CHANNELS; k++) {
        for (int y = 0; y < SIZE; y++) {
            int32_t row = 0;
            for (int x = 0; x < SIZE; x++) {
                numbers[k][y][x] =
                    (int32_t)floor(ref_srgb_decode(pixels[4 * (y * SIZE + x) + k] / 255.0) * FULL + 0.5);
                row += numbers[k][y][x];
                assert_int_equal(table[k][y][x], row + (y > 0 ? table[k][y - 1][x] : 0));
            }
        }
    }
    free(pixels);
    for (int i = 0; i < 2; i++) {
        const rhw_texture blurred = make_blurred(context, sums, ahead, sampler, lenses[i]);
        assert_true(check_blur(context, blurred, distances, lenses[i], numbers) > SIZE * SIZE / 8);
    }
    rhw_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_and_means)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
