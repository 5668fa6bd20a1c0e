// SPDX-License-Identifier: MIT
// ASTC of low dynamic range, decoded to 8 bits (Khronos Data Format Specification, chapter ASTC, decode mode unorm8). A
// block has up to four partitions, each with two endpoints, and a grid of weights that is stretched over its texels.
// The weights are stored from the end of the block downwards. A block, or a partition of it, that says what the
// specification forbids is opaque magenta.
#include <string.h>

#include "astc_endpoint.h"
#include "astc_sequence.h"
#include "block_decoders.h"

enum { RGBA = 4, BLOCK_BITS = 128, MOST_PARTITIONS = 4, MOST_SIDE = 12 };

static const unsigned char error_color[RGBA] = {255, 0, 255, 255};

static void fill(const struct rhw_block_format *format, const unsigned char color[RGBA],
                 unsigned char *texels)
{
    for (int i = 0; i < format->width * format->height; i++) {
        memcpy(texels + RGBA * i, color, RGBA);
    }
}

// Layout -----------------------------------------------------------------------------------------------

struct grid {
    int width, height;
    int range; // range of the grid's weights
    // Each texel has two weights: one channel has a weight of its own.
    bool planes;
};

static void set_size(struct grid *grid, int width, int height)
{
    grid->width = width;
    grid->height = height;
}

// Read the block mode, 11 bits. Return false for reserved modes.
static bool read_grid(int mode, struct grid *grid)
{
    const int a = mode >> 5 & 3, b = mode >> 7 & 3;
    // Short layouts have one or two sides that are constant.
    const bool is_short = (mode & 3) == 0;
    // The height takes the place of the bits of planes and of precision.
    const bool has_height = is_short && b == 2;
    const int range = (mode >> 4 & 1) | (is_short ? mode >> 1 & 6 : mode << 1 & 6);
    switch (is_short ? 4 + b : mode >> 2 & 3) {
    case 0: set_size(grid, b + 4, a + 2); break;
    case 1: set_size(grid, b + 8, a + 2); break;
    case 2: set_size(grid, a + 2, b + 8); break;
    case 3: set_size(grid, b & 2 ? (b & 1) + 2 : a + 2, b & 2 ? a + 2 : (b & 1) + 6); break;
    case 4: set_size(grid, 12, a + 2); break;
    case 5: set_size(grid, a + 2, 12); break;
    case 6: set_size(grid, a + 6, (mode >> 9 & 3) + 6); break;
    default: set_size(grid, a == 0 ? 6 : 10, a == 0 ? 10 : 6); break;
    }
    grid->planes = !has_height && (mode & 0x400) != 0;
    grid->range = range - 2 + (!has_height && (mode & 0x200) != 0 ? 6 : 0);
    return range >= 2 && !(is_short && b == 3 && a > 1);
}

// What a block says before its endpoints and weights.
struct layout {
    struct grid grid;
    int weights, weight_bits;
    int partitions, seed;
    int mode[MOST_PARTITIONS]; // modes of endpoints
    int channel;               // channel that has the second plane; −1: none
    int numbers, range;        // count and range of the numbers of the endpoints
    int at;                    // bit where the endpoints begin
};

// Read the endpoint modes of several partitions. All have one mode, or each has a mode of one of two neighbouring
// classes. Their bits go on below the weights. Return the number of these bits; `end` is where they end.
static int read_modes(struct rhw_bit_stream bits, int end, struct layout *layout)
{
    const int partitions = layout->partitions;
    const int selector = rhw_stream_bits(bits, 23, 2);
    const int more = selector != 0 ? 3 * partitions - 4 : 0;
    const int said = rhw_stream_bits(bits, 25, 4) | rhw_stream_bits(bits, end - more, more) << 4;
    for (int i = 0; i < partitions; i++) {
        const int upper = selector - 1 + (said >> i & 1), lower = said >> (partitions + 2 * i) & 3;
        layout->mode[i] = selector != 0 ? upper << 2 | lower : said;
    }
    return more;
}

// Choose the widest range whose numbers fit. Return false where none does.
static bool choose_range(struct layout *layout, int bits)
{
    for (int range = RHW_ASTC_RANGES - 1; range >= RHW_ASTC_LEAST_COLOR_RANGE; range--) {
        if (rhw_astc_sequence_bits(range, layout->numbers) <= bits) {
            layout->range = range;
            return true;
        }
    }
    return false;
}

// Read the layout of a block. Return false for what the specification lists as illegal encodings.
static bool read_layout(const struct rhw_block_format *format, struct rhw_bit_stream bits,
                        struct layout *layout)
{
    struct grid *const grid = &layout->grid;
    if (!read_grid(rhw_stream_bits(bits, 0, 11), grid) || grid->width > format->width ||
        grid->height > format->height) {
        return false;
    }
    layout->weights = grid->width * grid->height * (grid->planes ? 2 : 1);
    layout->weight_bits = rhw_astc_sequence_bits(grid->range, layout->weights);
    layout->partitions = rhw_stream_bits(bits, 11, 2) + 1;
    if (layout->weights > RHW_ASTC_MOST_WEIGHTS || layout->weight_bits < 24 || layout->weight_bits > 96 ||
        (grid->planes && layout->partitions == MOST_PARTITIONS)) {
        return false;
    }
    // The endpoints end here; they have at least 32 bits.
    int end = BLOCK_BITS - layout->weight_bits;
    if (layout->partitions == 1) {
        layout->mode[0] = rhw_stream_bits(bits, 13, 4);
        layout->at = 17;
    } else {
        layout->seed = rhw_stream_bits(bits, 13, 10);
        layout->at = 29;
        end -= read_modes(bits, end, layout);
    }
    if (grid->planes) {
        end -= 2;
    }
    layout->channel = grid->planes ? rhw_stream_bits(bits, end, 2) : -1;
    for (int i = 0; i < layout->partitions; i++) {
        layout->numbers += rhw_astc_endpoint_numbers(layout->mode[i]);
    }
    return layout->numbers <= RHW_ASTC_MOST_COLORS && choose_range(layout, end - layout->at);
}

// Partitions ---------------------------------------------------------------------------------------------

static uint32_t hash_52(uint32_t p)
{
    p ^= p >> 15;
    p -= p << 17;
    p += p << 7;
    p += p << 4;
    p ^= p >> 5;
    p += p << 16;
    p ^= p >> 7;
    p ^= p >> 3;
    p ^= p << 6;
    p ^= p >> 17;
    return p;
}

// A pattern is four linear functions of x and y, modulo 64. The greatest one names a texel's partition ("Partition
// Pattern Generation").
struct pattern {
    // The scale is 2 in blocks of fewer than 31 texels.
    int partitions, scale;
    int of_x[MOST_PARTITIONS], of_y[MOST_PARTITIONS], constant[MOST_PARTITIONS];
};

static struct pattern make_pattern(const struct rhw_block_format *format, int partitions, int seed)
{
    struct pattern pattern = {.partitions = partitions, .scale = format->width * format->height < 31 ? 2 : 1};
    const uint32_t random = hash_52((uint32_t)(seed + (partitions - 1) * 1024));
    const int by_seed = seed & 2 ? 4 : 5, by_count = partitions == 3 ? 6 : 5;
    const int shift_x = seed & 1 ? by_seed : by_count, shift_y = seed & 1 ? by_count : by_seed;
    for (int i = 0; i < partitions; i++) {
        const int x = random >> 8 * i & 15, y = random >> (8 * i + 4) & 15;
        pattern.of_x[i] = x * x >> shift_x;
        pattern.of_y[i] = y * y >> shift_y;
        pattern.constant[i] = (int)(random >> (14 - 4 * i) & 63);
    }
    return pattern;
}

static int partition_of(const struct pattern *pattern, int x, int y)
{
    int partition = 0, most = -1;
    for (int i = 0; i < pattern->partitions && pattern->partitions > 1; i++) {
        const int value = (pattern->of_x[i] * x * pattern->scale + pattern->of_y[i] * y * pattern->scale +
                           pattern->constant[i]) &
                          63;
        if (value > most) {
            most = value;
            partition = i;
        }
    }
    return partition;
}

// Weights ------------------------------------------------------------------------------------------------

static uint64_t reverse(uint64_t value)
{
    uint64_t reversed = 0;
    for (int i = 0; i < 64; i++) {
        reversed = reversed << 1 | (value >> i & 1);
    }
    return reversed;
}

// Weights of each plane, with zeros behind the last row. Texels of the last row have weights from these zeros, times 0.
struct weights {
    uint8_t plane[2][RHW_ASTC_MOST_WEIGHTS + MOST_SIDE + 1];
};

static void read_weights(struct rhw_bit_stream bits, const struct layout *layout, struct weights *weights)
{
    struct rhw_bit_stream backwards = {reverse(bits.high), reverse(bits.low)};
    rhw_stream_keep(&backwards, layout->weight_bits);
    uint8_t weight[RHW_ASTC_MOST_WEIGHTS];
    rhw_astc_take_weights(backwards, layout->grid.range, layout->weights, weight);
    memset(weights, 0, sizeof *weights);
    const int planes = layout->grid.planes ? 2 : 1;
    for (int i = 0; i < layout->weights; i++) {
        weights->plane[i % planes][i / planes] = weight[i];
    }
}

// Set where the texels of a side lie in the grid, in 16ths of the distance between weights.
static void place_in_grid(int texels, int weights, int position[MOST_SIDE])
{
    const int scale = (1024 + texels / 2) / (texels - 1);
    for (int i = 0; i < texels; i++) {
        position[i] = (scale * i * (weights - 1) + 32) >> 6;
    }
}

static int weight_at(const uint8_t *plane, int grid_width, int x, int y)
{
    const uint8_t *const at = plane + (y >> 4) * grid_width + (x >> 4);
    const int right = x & 15, down = y & 15;
    const int both = (right * down + 8) >> 4;
    return (at[0] * (16 - right - down + both) + at[1] * (right - both) + at[grid_width] * (down - both) +
            at[grid_width + 1] * both + 8) >>
           4;
}

// Texels -------------------------------------------------------------------------------------------------

// Mix two endpoints. They are widened to 16 bits, by repetition or, of sRGB, to the middle of a code, so that the upper
// byte of what lies between them is the result. Alpha is widened like colours (Khronos Data Format 1.4; 1.3 had
// repeated it).
static unsigned char mix(int first, int second, int weight, bool srgb)
{
    const int wide_first = first << 8 | (srgb ? 0x80 : first);
    const int wide_second = second << 8 | (srgb ? 0x80 : second);
    return (unsigned char)((wide_first * (64 - weight) + wide_second * weight + 32) >> 6 >> 8);
}

static void decode_texels(const struct rhw_block_format *format, const struct layout *layout,
                          const struct rhw_astc_endpoints *endpoints, const struct weights *weights,
                          bool srgb, unsigned char *texels)
{
    const struct grid *const grid = &layout->grid;
    const struct pattern pattern = make_pattern(format, layout->partitions, layout->seed);
    int grid_x[MOST_SIDE], grid_y[MOST_SIDE];
    place_in_grid(format->width, grid->width, grid_x);
    place_in_grid(format->height, grid->height, grid_y);
    for (int i = 0; i < format->width * format->height; i++) {
        const int x = i % format->width, y = i / format->width;
        unsigned char *const texel = texels + RGBA * i;
        const struct rhw_astc_endpoints *const ends = &endpoints[partition_of(&pattern, x, y)];
        if (ends->is_error) {
            memcpy(texel, error_color, RGBA);
            continue;
        }
        const int weight[2] = {weight_at(weights->plane[0], grid->width, grid_x[x], grid_y[y]),
                               weight_at(weights->plane[1], grid->width, grid_x[x], grid_y[y])};
        for (int c = 0; c < RGBA; c++) {
            texel[c] = mix(ends->color[0][c], ends->color[1][c], weight[c == layout->channel], srgb);
        }
    }
}

// Decode a block of one colour. A rectangle of texture coordinates that all have the colour stands in the block; it
// only has to be a rectangle.
static void decode_void_extent(const struct rhw_block_format *format, const unsigned char *block,
                               unsigned char *texels)
{
    const uint64_t bits = rhw_load_little(block);
    const bool anywhere = bits >> 12 == UINT64_MAX >> 12;
    const bool is_rectangle = rhw_bits_of(bits, 12, 13) < rhw_bits_of(bits, 25, 13) &&
                              rhw_bits_of(bits, 38, 13) < rhw_bits_of(bits, 51, 13);
    // The bits must not say high dynamic range, and two of them are reserved.
    const bool is_legal = rhw_bits_of(bits, 9, 3) == 6;
    const unsigned char color[RGBA] = {block[9], block[11], block[13], block[15]};
    fill(format, is_legal && (anywhere || is_rectangle) ? color : error_color, texels);
}

static void decode(const struct rhw_block_format *format, const unsigned char *block, bool srgb,
                   unsigned char *texels)
{
    const struct rhw_bit_stream bits = rhw_stream_open(block);
    if ((bits.low & 0x1ff) == 0x1fc) {
        decode_void_extent(format, block, texels);
        return;
    }
    struct layout layout = {.numbers = 0};
    if (!read_layout(format, bits, &layout)) {
        fill(format, error_color, texels);
        return;
    }
    struct rhw_bit_stream colors = bits;
    rhw_stream_skip(&colors, layout.at);
    rhw_stream_keep(&colors, rhw_astc_sequence_bits(layout.range, layout.numbers));
    uint8_t number[RHW_ASTC_MOST_COLORS];
    rhw_astc_take_colors(colors, layout.range, layout.numbers, number);
    struct rhw_astc_endpoints endpoints[MOST_PARTITIONS];
    const uint8_t *next = number;
    for (int i = 0; i < layout.partitions; i++) {
        endpoints[i] = rhw_astc_endpoints(layout.mode[i], next);
        next += rhw_astc_endpoint_numbers(layout.mode[i]);
    }
    struct weights weights;
    read_weights(bits, &layout, &weights);
    decode_texels(format, &layout, endpoints, &weights, srgb, texels);
}

void rhw_decode_astc_unorm(const struct rhw_block_format *format, const unsigned char *block,
                           unsigned char *texels)
{
    decode(format, block, false, texels);
}

void rhw_decode_astc_srgb(const struct rhw_block_format *format, const unsigned char *block,
                          unsigned char *texels)
{
    decode(format, block, true, texels);
}
