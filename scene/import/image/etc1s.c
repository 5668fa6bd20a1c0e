// SPDX-License-Identifier: MIT
// ETC1S and BasisLZ, written from KTX 2.0, appendix "BasisLZ/ETC1S Bitstream Specification". A block of 4 × 4 texels is
// a reference to an endpoint (a base colour and a table of steps) and one to a selector (which step each texel takes).
// An endpoint is told by its difference to the one before, or is that of a neighbour. A selector was often used shortly
// before, so a history of selectors is at hand.
#include "etc1s.h"

#include <stdlib.h>
#include <string.h>

enum {
    PREDICTIONS = 256, // symbols that say how 2 × 2 blocks come by their endpoints
    REPEAT_PREDICTION = PREDICTIONS,
    LEAST_REPEAT = 3,
    LEAST_SELECTOR_RUN = 3,
    LONG_SELECTOR_RUN = 63, // symbol of a run whose length follows
    MOST_HISTORY = 1 << 13
};

// What 2 bits of a prediction say.
enum { FROM_LEFT, FROM_ABOVE, FROM_ABOVE_LEFT, BY_DIFFERENCE };

struct endpoint {
    uint8_t color[3]; // 5 bits for each channel
    uint8_t table;    // number of the table of steps, 3 bits
};

struct scene_etc1s {
    uint32_t endpoint_count, selector_count, history_size;
    struct endpoint *endpoints;
    uint8_t (*selectors)[4]; // a byte for each row of texels, 2 bits for each texel from the lowest on
    struct scene_huffman prediction, difference, selector, run;
};

static const char damaged[] = "damaged KTX2: its ETC1S data";

// Codebooks ----------------------------------------------------------------------------------------------

// Take a colour as its difference to the one before, by a code that depends on how bright that one was.
static uint8_t take_color(struct scene_bits *bits, const struct scene_huffman code[3], uint8_t before)
{
    const int range = before <= 9 ? 0 : before <= 21 ? 1 : 2;
    return (before + scene_huffman_take(bits, &code[range])) & 31;
}

// Read the endpoints. `code` is room for four codes.
static bool read_endpoints(struct scene_bits bits, struct scene_etc1s *codebooks,
                           struct scene_huffman code[4])
{
    for (int i = 0; i < 4; i++) {
        scene_huffman_read(&bits, &code[i]);
    }
    const bool grey = scene_bits_take(&bits, 1) != 0;
    struct endpoint before = {{16, 16, 16}, 0};
    for (uint32_t i = 0; i < codebooks->endpoint_count && !bits.failed; i++) {
        before.table = (before.table + scene_huffman_take(&bits, &code[3])) & 7;
        for (int c = 0; c < 3; c++) {
            before.color[c] = grey && c > 0 ? before.color[0] : take_color(&bits, code, before.color[c]);
        }
        codebooks->endpoints[i] = before;
    }
    return !bits.failed;
}

static bool read_selectors(struct scene_bits bits, struct scene_etc1s *codebooks, struct scene_huffman *code)
{
    if (scene_bits_take(&bits, 2) != 0) {
        return false;
    }
    const bool plain = scene_bits_take(&bits, 1) != 0;
    if (!plain) {
        scene_huffman_read(&bits, code);
    }
    for (uint32_t i = 0; i < codebooks->selector_count && !bits.failed; i++) {
        for (int y = 0; y < 4; y++) {
            const bool whole = plain || i == 0;
            const uint32_t value = whole ? scene_bits_take(&bits, 8)
                                         : scene_huffman_take(&bits, code) ^ codebooks->selectors[i - 1][y];
            codebooks->selectors[i][y] = (uint8_t)value;
        }
    }
    return !bits.failed;
}

static bool read_tables(struct scene_bits bits, struct scene_etc1s *codebooks)
{
    scene_huffman_read(&bits, &codebooks->prediction);
    scene_huffman_read(&bits, &codebooks->difference);
    scene_huffman_read(&bits, &codebooks->selector);
    scene_huffman_read(&bits, &codebooks->run);
    codebooks->history_size = scene_bits_take(&bits, 13);
    return !bits.failed;
}

const char *scene_etc1s_open(uint32_t endpoint_count, uint32_t selector_count, struct scene_span endpoints,
                             struct scene_span selectors, struct scene_span tables,
                             struct scene_etc1s **codebooks)
{
    struct scene_etc1s *const made = calloc(1, sizeof *made);
    struct scene_huffman *const code = calloc(4, sizeof *code);
    *codebooks = made;
    if (made != NULL) {
        made->endpoint_count = endpoint_count;
        made->selector_count = selector_count;
        made->endpoints = calloc(endpoint_count, sizeof *made->endpoints);
        made->selectors = calloc(selector_count, sizeof *made->selectors);
    }
    const char *problem = NULL;
    if (made == NULL || code == NULL || made->endpoints == NULL || made->selectors == NULL) {
        problem = "outofmem";
    } else if (!read_endpoints(scene_bits_open(endpoints.bytes, endpoints.size), made, code) ||
               !read_selectors(scene_bits_open(selectors.bytes, selectors.size), made, code) ||
               !read_tables(scene_bits_open(tables.bytes, tables.size), made)) {
        problem = damaged;
    }
    free(code);
    return problem;
}

void scene_etc1s_free(struct scene_etc1s *codebooks)
{
    if (codebooks != NULL) {
        free(codebooks->endpoints);
        free(codebooks->selectors);
        free(codebooks);
    }
}

// References ---------------------------------------------------------------------------------------------

// Selectors that were used. New ones come into the second half, and selectors that are used again move towards the
// front.
struct history {
    uint32_t size, next;
    uint16_t selector[MOST_HISTORY];
};

static void add_to_history(struct history *history, uint32_t selector)
{
    if (history->size == 0) {
        return;
    }
    history->selector[history->next++] = (uint16_t)selector;
    if (history->next == history->size) {
        history->next = history->size / 2;
    }
}

static uint32_t take_from_history(struct history *history, uint32_t index)
{
    const uint16_t selector = history->selector[index];
    history->selector[index] = history->selector[index / 2];
    history->selector[index / 2] = selector;
    return selector;
}

// A slice while its blocks are read, row by row.
struct reader {
    struct scene_bits bits;
    const struct scene_etc1s *codebooks;
    uint32_t columns; // number of blocks in a row
    // Endpoints of the row of blocks above, and of this row up to the block that is read.
    uint16_t *endpoint;
    uint8_t *prediction; // predictions of pairs of blocks, for the odd rows
    uint32_t corner;     // endpoint that stood above the block to the left
    uint32_t left;       // endpoint that was used last
    uint32_t last_prediction, prediction_run;
    uint32_t selector_run;
    struct history history;
};

// Take a number in groups of bits, the lowest first. The highest bit of each group says whether another one follows.
static uint32_t take_number(struct scene_bits *bits, unsigned group)
{
    uint32_t value = 0;
    for (unsigned at = 0; at < 32; at += group) {
        const uint32_t part = scene_bits_take(bits, group + 1);
        value |= (part & ((1u << group) - 1)) << at;
        if (part >> group == 0) {
            return value;
        }
    }
    bits->failed = true;
    return 0;
}

// Take the prediction of 2 × 2 blocks, 2 bits for each.
static uint32_t take_prediction(struct reader *reader)
{
    if (reader->prediction_run > 0) {
        reader->prediction_run--;
        return reader->last_prediction;
    }
    const uint32_t symbol = scene_huffman_take(&reader->bits, &reader->codebooks->prediction);
    if (symbol == REPEAT_PREDICTION) {
        const uint32_t run = take_number(&reader->bits, 4);
        reader->bits.failed |= run > UINT32_MAX - LEAST_REPEAT;
        reader->prediction_run = run + LEAST_REPEAT - 1;
    } else {
        reader->last_prediction = symbol;
    }
    return reader->last_prediction;
}

static uint32_t take_endpoint(struct reader *reader, uint32_t prediction, uint32_t x, uint32_t y)
{
    const uint32_t above = reader->endpoint[x], corner = reader->corner;
    reader->corner = above;
    const bool inside = (x > 0 || prediction == FROM_ABOVE) && (y > 0 || prediction == FROM_LEFT);
    if (prediction != BY_DIFFERENCE) {
        reader->bits.failed |= !inside;
        return prediction == FROM_LEFT ? reader->left : prediction == FROM_ABOVE ? above : corner;
    }
    const uint32_t count = reader->codebooks->endpoint_count;
    const uint32_t sum = reader->left + scene_huffman_take(&reader->bits, &reader->codebooks->difference);
    const uint32_t endpoint = sum >= count ? sum - count : sum;
    reader->bits.failed |= endpoint >= count;
    return endpoint < count ? endpoint : 0;
}

// Take a selector. Symbols are selectors first, places in the history next, and at last one symbol for a run of the
// history's first selector.
static uint32_t take_selector(struct reader *reader)
{
    const struct scene_etc1s *const codebooks = reader->codebooks;
    uint32_t symbol = codebooks->selector_count;
    if (reader->selector_run > 0) {
        reader->selector_run--;
    } else {
        symbol = scene_huffman_take(&reader->bits, &codebooks->selector);
        if (symbol == codebooks->selector_count + codebooks->history_size) {
            const uint32_t run = scene_huffman_take(&reader->bits, &codebooks->run);
            const uint32_t more = run == LONG_SELECTOR_RUN ? take_number(&reader->bits, 7) : run;
            reader->bits.failed |= run > LONG_SELECTOR_RUN || more > UINT32_MAX - LEAST_SELECTOR_RUN;
            reader->selector_run = more + LEAST_SELECTOR_RUN - 1;
            symbol = codebooks->selector_count;
        }
    }
    if (symbol < codebooks->selector_count) {
        add_to_history(&reader->history, symbol);
        return symbol;
    }
    const uint32_t index = symbol - codebooks->selector_count;
    if (index >= codebooks->history_size) {
        reader->bits.failed = true;
        return 0;
    }
    return take_from_history(&reader->history, index);
}

// Texels -------------------------------------------------------------------------------------------------

static uint8_t step_from(int color, int step)
{
    const int value = (color << 3 | color >> 2) + step;
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

// Paint the texels of a block that lie within the image.
static void paint(const struct endpoint *endpoint, const uint8_t selector[4], uint32_t columns, uint32_t rows,
                  size_t pitch, bool alpha, uint8_t (*texels)[4])
{
    static const int16_t steps[8][4] = {{-8, -2, 2, 8},       {-17, -5, 5, 17},    {-29, -9, 9, 29},
                                        {-42, -13, 13, 42},   {-60, -18, 18, 60},  {-80, -24, 24, 80},
                                        {-106, -33, 33, 106}, {-183, -47, 47, 183}};
    uint8_t palette[4][3];
    for (int i = 0; i < 4; i++) {
        for (int c = 0; c < 3; c++) {
            palette[i][c] = step_from(endpoint->color[c], steps[endpoint->table][i]);
        }
    }
    for (uint32_t y = 0; y < rows; y++) {
        for (uint32_t x = 0; x < columns; x++) {
            const uint8_t *const color = palette[selector[y] >> 2 * x & 3];
            if (alpha) {
                texels[y * pitch + x][3] = color[1];
            } else {
                memcpy(texels[y * pitch + x], color, 3);
                texels[y * pitch + x][3] = UINT8_MAX;
            }
        }
    }
}

static uint32_t within_block(uint32_t size, uint32_t block)
{
    return size - 4 * block < 4 ? size - 4 * block : 4;
}

static bool read_blocks(struct reader *reader, uint32_t width, uint32_t height, bool alpha,
                        uint8_t (*texels)[4])
{
    const struct scene_etc1s *const codebooks = reader->codebooks;
    for (uint32_t y = 0; y < (height + 3) / 4 && !reader->bits.failed; y++) {
        uint32_t prediction = 0;
        for (uint32_t x = 0; x < reader->columns; x++) {
            if (x % 2 == 0) {
                prediction = y % 2 == 0 ? take_prediction(reader) : reader->prediction[x / 2];
                reader->prediction[x / 2] = (uint8_t)(prediction >> 4);
            }
            const uint32_t endpoint = take_endpoint(reader, prediction & 3, x, y);
            prediction >>= 2;
            const uint32_t selector = take_selector(reader);
            reader->endpoint[x] = (uint16_t)endpoint;
            reader->left = endpoint;
            paint(&codebooks->endpoints[endpoint], codebooks->selectors[selector], within_block(width, x),
                  within_block(height, y), width, alpha, texels + (size_t)4 * y * width + 4 * x);
        }
    }
    return !reader->bits.failed;
}

const char *scene_etc1s_decode(const struct scene_etc1s *codebooks, struct scene_span slice, uint32_t width,
                               uint32_t height, bool alpha, uint8_t (*texels)[4])
{
    const uint32_t columns = (width + 3) / 4;
    struct reader *const reader = calloc(1, sizeof *reader);
    uint16_t *const endpoint = calloc(columns, sizeof *endpoint);
    uint8_t *const prediction = calloc(columns, sizeof *prediction);
    const char *problem = "outofmem";
    if (reader != NULL && endpoint != NULL && prediction != NULL) {
        reader->bits = scene_bits_open(slice.bytes, slice.size);
        reader->codebooks = codebooks;
        reader->columns = columns;
        reader->endpoint = endpoint;
        reader->prediction = prediction;
        reader->history.size = codebooks->history_size;
        reader->history.next = codebooks->history_size / 2;
        problem = read_blocks(reader, width, height, alpha, texels) ? NULL : damaged;
    }
    free(reader);
    free(endpoint);
    free(prediction);
    return problem;
}
