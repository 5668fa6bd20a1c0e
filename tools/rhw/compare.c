// SPDX-License-Identifier: MIT
// rhw compare: how two pictures differ, per channel in numbers and as a picture. Everything is computed in
// double from the stored samples, row by row, so that equal files give exactly 0 and ids compare as integers.
#include "budget.h"
#include "elementary.h"
#include "file.h"
#include "image_load.h"
#include "image_write.h"
#include "json.h"
#include "options.h"
#include "output_file.h"
#include "verbs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/shader.h>

enum { OPTION_DIFFERENCE = 'd', OPTION_TOLERANCE = 't', OPTION_JSON = 256 };

static const struct cli_option options[] = {
    {"difference", OPTION_DIFFERENCE, "OUT", "write a picture of the differences (.png or .ppm)"},
    {"tolerance", OPTION_TOLERANCE, "T",
     "largest difference of a sample that still passes; default 0.\nA number or a fraction such as 2/255"},
    {"json", OPTION_JSON, NULL, "print the numbers as JSON"},
    {"max-memory", CLI_BUDGET_MEMORY, "SIZE",
     "fail when the pictures need more than this, each half of it; default 4G"},
    {"max-time", CLI_BUDGET_TIME, "SECONDS", "fail when it takes longer, 0.1..86400; default 300"},
};

static const char notes[] =
    "Reads PNG (8 and 16 bit), WebP that does not move, PPM, PGM and EXR. Samples of PNG, WebP and PPM are "
    "taken\n"
    "as fractions of full scale, so that 8 and 16 bit files can be compared, a missing alpha channel is "
    "opaque;\n"
    "those of EXR are taken as they are and compared channel by channel. Two NaNs are equal, a NaN "
    "and a\nnumber differ without limit. "
    "PSNR refers to full scale, for EXR to the largest value that A has in the channel.\n"
    "The picture is black where A and B are equal; else from blue (1/1024 or less) over green, yellow and "
    "red to\n"
    "white (1/2 or more of full scale) by the largest difference of the pixel's channels.\n\n"
    "Exit status: 0 when no sample differs by more than the tolerance, 1 when one does or a file cannot be "
    "read,\n"
    "2 for a wrong command line.";

static const struct cli_verb verb = {
    .name = "compare",
    .operands = "A B",
    .summary = "Compares two pictures.",
    .options = options,
    .option_count = (int)(sizeof options / sizeof *options),
    .notes = notes,
};

struct channel_difference {
    const char *name;
    int a, b; // channel numbers in the two images
    double max, sum, sum_of_squares;
    double peak; // what PSNR refers to
    uint64_t differing;
    int worst_x, worst_y;
};

struct comparison {
    const char *path_a, *path_b;
    struct cli_loaded_image a, b;
    struct channel_difference *channels;
    int channel_count;
    double max;
    int worst_x, worst_y;
    uint64_t pixels, differing; // differing in any channel
    double tolerance;
    struct cli_budget budget;
    const char *difference_path; // NULL: no picture
    bool json;
    float *heat; // largest difference of the pixel as a fraction of the channel's peak; NULL: no picture
};

// |a − b| where that means something: equal infinities and two NaNs do not differ.
static double difference_of(double a, double b)
{
    if (a == b || (isnan(a) && isnan(b))) {
        return 0.0;
    }
    return isfinite(a) && isfinite(b) ? fabs(a - b) : INFINITY;
}

static const double decibel = 4.34294481903251828; // 10 / ln 10

static double psnr_of(const struct channel_difference *channel, uint64_t pixels)
{
    const double mean_square = channel->sum_of_squares / (double)pixels;
    return mean_square > 0.0 ? decibel * scene_log(channel->peak * channel->peak / mean_square) : INFINITY;
}

static bool match_channels(struct comparison *comparison)
{
    const struct cli_loaded_image *a = &comparison->a, *b = &comparison->b;
    for (int i = 0; i < b->channel_count; i++) {
        if (cli_image_find_channel(a, b->channels[i].name) < 0) {
            cli_error(comparison->path_a, "has no channel %s, which the other file has", b->channels[i].name);
            return false;
        }
    }
    comparison->channels = calloc((size_t)a->channel_count, sizeof *comparison->channels);
    if (!comparison->channels) {
        cli_error(comparison->path_a, "out of memory");
        return false;
    }
    comparison->channel_count = a->channel_count;
    for (int i = 0; i < a->channel_count; i++) {
        const char *name = a->channels[i].name;
        const int other = cli_image_find_channel(b, name);
        if (other < 0) {
            cli_error(comparison->path_b, "has no channel %s, which the other file has", name);
            return false;
        }
        comparison->channels[i] = (struct channel_difference){.name = name, .a = i, .b = other, .peak = 1.0};
    }
    return true;
}

static bool check_comparable(const struct comparison *comparison)
{
    const struct cli_loaded_image *a = &comparison->a, *b = &comparison->b;
    if (a->encoded != b->encoded) {
        cli_error(comparison->path_b,
                  "an EXR file compares with EXR files only, its numbers are not encoded");
        return false;
    }
    if (a->width != b->width || a->height != b->height) {
        cli_error(comparison->path_b, "is %dx%d, but %s is %dx%d", b->width, b->height, comparison->path_a,
                  a->width, a->height);
        return false;
    }
    return true;
}

static void find_peak(const struct cli_loaded_image *image, struct channel_difference *channel, double *row)
{
    double peak = 0.0;
    for (int y = 0; y < image->height; y++) {
        cli_image_row(image, channel->a, y, row);
        for (int x = 0; x < image->width; x++) {
            if (isfinite(row[x]) && fabs(row[x]) > peak) {
                peak = fabs(row[x]);
            }
        }
    }
    channel->peak = peak > 0.0 ? peak : 1.0;
}

// One row of one channel; marks differing pixels.
static void compare_row(struct comparison *comparison, struct channel_difference *channel, int y,
                        const double *a, const double *b, bool *differs)
{
    const int width = comparison->a.width;
    for (int x = 0; x < width; x++) {
        const double difference = difference_of(a[x], b[x]);
        if (difference == 0.0) {
            continue;
        }
        differs[x] = true;
        channel->differing++;
        channel->sum += difference;
        channel->sum_of_squares += difference * difference;
        if (difference > channel->max) {
            channel->max = difference;
            channel->worst_x = x;
            channel->worst_y = y;
        }
        if (comparison->heat) {
            float *heat = &comparison->heat[(size_t)y * (size_t)width + (size_t)x];
            *heat = fmaxf(*heat, (float)(difference / channel->peak));
        }
    }
}

static bool compare_pixels(struct comparison *comparison)
{
    const struct cli_loaded_image *a = &comparison->a;
    const size_t width = (size_t)a->width;
    double *rows = malloc(2 * width * sizeof *rows);
    bool *differs = malloc(width * sizeof *differs);
    comparison->pixels = (uint64_t)a->width * (uint64_t)a->height;
    if (comparison->difference_path) {
        comparison->heat = calloc(comparison->pixels, sizeof *comparison->heat);
    }
    const bool enough = rows && differs && (comparison->heat || !comparison->difference_path);
    for (int c = 0; enough && !a->encoded && c < comparison->channel_count; c++) {
        find_peak(a, &comparison->channels[c], rows);
    }
    for (int y = 0; enough && y < a->height; y++) {
        memset(differs, 0, width * sizeof *differs);
        for (int c = 0; c < comparison->channel_count; c++) {
            struct channel_difference *channel = &comparison->channels[c];
            cli_image_row(a, channel->a, y, rows);
            cli_image_row(&comparison->b, channel->b, y, rows + width);
            compare_row(comparison, channel, y, rows, rows + width, differs);
        }
        for (size_t x = 0; x < width; x++) {
            comparison->differing += differs[x];
        }
    }
    for (int c = 0; c < comparison->channel_count; c++) {
        const struct channel_difference *channel = &comparison->channels[c];
        if (channel->max > comparison->max) {
            comparison->max = channel->max;
            comparison->worst_x = channel->worst_x;
            comparison->worst_y = channel->worst_y;
        }
    }
    free(rows);
    free(differs);
    if (!enough) {
        cli_error(comparison->path_a, "out of memory");
    }
    return enough;
}

// Black, then blue to white in five steps of 1.8 binary orders each.
static void heat_row(const void *user, int y, void *row)
{
    static const float colors[6][3] = {{0, 0, 160},   {0, 90, 255}, {0, 200, 60},
                                       {255, 230, 0}, {255, 40, 0}, {255, 255, 255}};
    const struct comparison *comparison = user;
    const int width = comparison->a.width;
    const float *heat = comparison->heat + (size_t)y * (size_t)width;
    uint8_t *bytes = row;
    for (int x = 0; x < width; x++, bytes += 3) {
        memset(bytes, 0, 3);
        if (heat[x] <= 0.0f) {
            continue;
        }
        const float place = fminf(fmaxf((rhw_log2_1(heat[x]) + 10.0f) / 9.0f, 0.0f), 1.0f) * 5.0f;
        const int step = place < 4.0f ? (int)place : 4;
        const float part = place - (float)step;
        for (int i = 0; i < 3; i++) {
            bytes[i] = (uint8_t)(colors[step][i] + (colors[step + 1][i] - colors[step][i]) * part + 0.5f);
        }
    }
}

static bool write_difference(const struct comparison *comparison)
{
    const struct cli_raster raster = {.width = comparison->a.width,
                                      .height = comparison->a.height,
                                      .channels = 3,
                                      .bits = 8,
                                      .srgb = true,
                                      .row = heat_row,
                                      .user = comparison};
    const bool png = cli_picture_format_of(comparison->difference_path) == CLI_PICTURE_PNG;
    struct cli_output_file file;
    if (!cli_output_file_open(&file, comparison->difference_path)) {
        return false;
    }
    const bool written = (png ? cli_png_write(&file, &raster) : cli_ppm_write(&file, &raster)) &&
                         cli_output_file_finish(&file) && cli_output_file_commit(&file);
    if (!written) {
        cli_output_file_discard(&file);
    }
    return written;
}

static void print_json(const struct comparison *comparison)
{
    const double pixels = (double)comparison->pixels;
    fputs("{\n  \"a\": ", stdout);
    cli_json_string(stdout, comparison->path_a);
    fputs(",\n  \"b\": ", stdout);
    cli_json_string(stdout, comparison->path_b);
    printf(",\n  \"width\": %d,\n  \"height\": %d,\n  \"max\": ", comparison->a.width, comparison->a.height);
    cli_json_number(stdout, comparison->max);
    fputs(",\n  \"tolerance\": ", stdout);
    cli_json_number(stdout, comparison->tolerance);
    printf(
        ",\n  \"pass\": %s,\n  \"differing_pixels\": %llu,\n  \"worst_pixel\": [%d, %d],\n  \"channels\": [",
        comparison->max <= comparison->tolerance ? "true" : "false",
        (unsigned long long)comparison->differing, comparison->worst_x, comparison->worst_y);
    for (int c = 0; c < comparison->channel_count; c++) {
        const struct channel_difference *channel = &comparison->channels[c];
        printf("%s\n    {\"name\": ", c ? "," : "");
        cli_json_string(stdout, channel->name);
        fputs(", \"max\": ", stdout);
        cli_json_number(stdout, channel->max);
        fputs(", \"mean\": ", stdout);
        cli_json_number(stdout, channel->sum / pixels);
        fputs(", \"psnr\": ", stdout);
        cli_json_number(stdout, psnr_of(channel, comparison->pixels));
        printf(", \"differing\": %llu}", (unsigned long long)channel->differing);
    }
    fputs("\n  ]\n}\n", stdout);
}

static void print_table(const struct comparison *comparison)
{
    const double pixels = (double)comparison->pixels;
    printf("%-16s %12s %12s %9s %10s\n", "channel", "max", "mean", "PSNR dB", "differing");
    for (int c = 0; c < comparison->channel_count; c++) {
        const struct channel_difference *channel = &comparison->channels[c];
        printf("%-16s %12.6g %12.6g %9.2f %10llu\n", channel->name, channel->max, channel->sum / pixels,
               psnr_of(channel, comparison->pixels), (unsigned long long)channel->differing);
    }
    if (comparison->differing) {
        printf("%llu of %llu pixels differ, most at %d,%d by %g\n", (unsigned long long)comparison->differing,
               (unsigned long long)comparison->pixels, comparison->worst_x, comparison->worst_y,
               comparison->max);
    } else {
        printf("all %llu pixels are equal\n", (unsigned long long)comparison->pixels);
    }
}

static bool load_and_compare(struct comparison *comparison)
{
    const char *const path = comparison->difference_path;
    if (path &&
        (system_file_is_same(path, comparison->path_a) || system_file_is_same(path, comparison->path_b))) {
        cli_error(path, "is one of the pictures; name another file for the difference");
        return false;
    }
    if (path && !cli_output_file_check(path)) {
        return false;
    }
    const size_t most = comparison->budget.memory > 0 ? comparison->budget.memory / 2 : CLI_IMAGE_MOST;
    if (!cli_image_load(&comparison->a, comparison->path_a, most) ||
        !cli_image_load(&comparison->b, comparison->path_b, most)) {
        return false;
    }
    return check_comparable(comparison) && match_channels(comparison) && compare_pixels(comparison) &&
           (!comparison->difference_path || write_difference(comparison));
}

static bool parse_tolerance(const char *text, double *tolerance)
{
    char first[32];
    const size_t length = strcspn(text, "/");
    float number, divisor = 1.0f;
    if (length >= sizeof first) {
        return false;
    }
    memcpy(first, text, length);
    first[length] = '\0';
    if (!cli_parse_float(first, &number) || number < 0.0f) {
        return false;
    }
    if (text[length] && (!cli_parse_float(text + length + 1, &divisor) || divisor <= 0.0f)) {
        return false;
    }
    // A sample that is off by exactly N/255 passes "N/255", whatever the rounding of the two divisions.
    *tolerance = (double)number / (double)divisor * (1.0 + 1e-12);
    return true;
}

static bool parse_option(struct comparison *comparison, int id, const char *argument)
{
    switch (id) {
    case OPTION_DIFFERENCE:
        comparison->difference_path = argument;
        if (cli_picture_format_of(argument) == CLI_PICTURE_PNG ||
            cli_picture_format_of(argument) == CLI_PICTURE_PPM) {
            return true;
        }
        cli_error(argument, "a difference picture is named .png or .ppm");
        return false;
    case OPTION_TOLERANCE:
        if (parse_tolerance(argument, &comparison->tolerance)) {
            return true;
        }
        cli_error("--tolerance", "'%s' is not a number or a fraction, 0 or above", argument);
        return false;
    case CLI_BUDGET_MEMORY:
    case CLI_BUDGET_TIME: return cli_parse_budget(&comparison->budget, id, argument);
    default: comparison->json = true; return true;
    }
}

int cli_compare(int argc, char **argv)
{
    struct comparison comparison = {.budget = {.seconds = 300.0}};
    struct cli_parser parser;
    cli_parser_start(&parser, &verb, argc, argv);
    int id;
    while ((id = cli_parser_next(&parser)) > 0) {
        if (!parse_option(&comparison, id, parser.argument)) {
            return CLI_USAGE;
        }
    }
    if (id == CLI_OPTION_STOP) {
        return parser.status;
    }
    if (!cli_parser_operands(&parser, 2, 2)) {
        return CLI_USAGE;
    }

    comparison.path_a = parser.operands[0];
    comparison.path_b = parser.operands[1];
    int status = CLI_FAILED;
    cli_budget_apply(&comparison.budget, comparison.path_a);
    if (load_and_compare(&comparison)) {
        if (comparison.json) {
            print_json(&comparison);
        } else {
            print_table(&comparison);
        }
        status = comparison.max <= comparison.tolerance ? CLI_OK : CLI_FAILED;
        if (status != CLI_OK) {
            cli_error(comparison.path_b, "differs from %s by up to %g, more than the tolerance of %g",
                      comparison.path_a, comparison.max, comparison.tolerance);
        }
    }
    cli_image_unload(&comparison.a);
    cli_image_unload(&comparison.b);
    free(comparison.channels);
    free(comparison.heat);
    return status;
}
