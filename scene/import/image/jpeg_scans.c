// SPDX-License-Identifier: MIT
// Whether the scans of a JPEG are all there. Markers are those of ITU-T T.81, annex B. stb_image decodes what there is:
// of a component without a scan, and behind an interval without the marker that begins the next one, it writes nothing.
#include "jpeg.h"

enum { FILL = 0xff, START = 0xd8, END = 0xd9, FIRST_RESTART = 0xd0, LAST_RESTART = 0xd7 };
enum { BASELINE = 0xc0, EXTENDED = 0xc1, PROGRESSIVE = 0xc2 };
enum { HUFFMAN_TABLES = 0xc4, QUANTIZATION_TABLES = 0xdb, INTERVAL = 0xdd, SCAN = 0xda };
enum { MOST_COMPONENTS = 4, TABLES = 4, DCT = 8 };

struct component {
    unsigned id, across, down, table; // how often it is sampled; its table of quantization
    bool is_begun;                    // a scan has the first of its coefficients
};

struct frame {
    bool is_progressive;
    unsigned width, height, count;
    unsigned across, down; // the most of its components
    struct component components[MOST_COMPONENTS];
};

struct walk {
    const unsigned char *bytes;
    size_t size, at;
    struct frame frame;
    unsigned interval;                 // MCUs between restarts. 0 if there are none
    unsigned quantization, huffman[2]; // a bit for each table that is there
    bool has_scan;
};

// Go to what follows the next marker. Return the marker, or −1 at the end. Count the restarts that are passed.
static int next_marker(struct walk *walk, unsigned *restarts)
{
    while (walk->at < walk->size) {
        if (walk->bytes[walk->at++] != FILL) {
            continue;
        }
        while (walk->at < walk->size && walk->bytes[walk->at] == FILL) {
            walk->at++;
        }
        const int marker = walk->at < walk->size ? walk->bytes[walk->at++] : 0;
        if (marker >= FIRST_RESTART && marker <= LAST_RESTART) {
            ++*restarts;
        } else if (marker > 1) {
            return marker;
        }
    }
    return -1;
}

static void read_frame(struct frame *frame, const unsigned char *segment, size_t length, bool is_progressive)
{
    enum { HEAD = 8, COMPONENT = 3 };
    const unsigned count = length >= HEAD ? segment[7] : 0;
    if (frame->count > 0 || count == 0 || count > MOST_COMPONENTS || length < HEAD + COMPONENT * count) {
        return; // stb_image refuses it
    }
    frame->is_progressive = is_progressive;
    frame->height = (unsigned)segment[3] << 8 | segment[4];
    frame->width = (unsigned)segment[5] << 8 | segment[6];
    frame->count = count;
    frame->across = frame->down = 1;
    for (unsigned i = 0; i < count; i++) {
        const unsigned char *const c = segment + HEAD + COMPONENT * i;
        const unsigned across = c[1] >> 4, down = c[1] & 15;
        frame->components[i] = (struct component){c[0], across, down, c[2], false};
        frame->across = across > frame->across ? across : frame->across;
        frame->down = down > frame->down ? down : frame->down;
    }
}

static void read_quantization(struct walk *walk, const unsigned char *segment, size_t length)
{
    enum { NUMBERS = 64 };
    for (size_t at = 2; at < length; at += 1 + NUMBERS * (segment[at] >> 4 != 0 ? 2u : 1u)) {
        walk->quantization |= 1u << (segment[at] & 15);
    }
}

static void read_huffman(struct walk *walk, const unsigned char *segment, size_t length)
{
    enum { HEAD = 17 };
    for (size_t at = 2, codes = 0; at + HEAD <= length; at += HEAD + codes) {
        codes = 0;
        for (size_t i = 1; i < HEAD; i++) {
            codes += segment[at + i];
        }
        walk->huffman[segment[at] >> 4 != 0] |= 1u << (segment[at] & 15);
    }
}

static unsigned divide_up(unsigned a, unsigned b)
{
    return (a + b - 1) / b;
}

// Return how many MCUs a scan of some components has. One of a single component has a block for each.
static uint64_t count_units(const struct frame *frame, const struct component *only)
{
    const unsigned across = only == NULL
                                ? divide_up(frame->width, DCT * frame->across)
                                : divide_up(divide_up(frame->width * only->across, frame->across), DCT);
    const unsigned down = only == NULL ? divide_up(frame->height, DCT * frame->down)
                                       : divide_up(divide_up(frame->height * only->down, frame->down), DCT);
    return (uint64_t)across * down;
}

static struct component *find_component(struct frame *frame, unsigned id)
{
    struct component *found = NULL;
    for (unsigned i = 0; i < frame->count && found == NULL; i++) {
        found = frame->components[i].id == id ? &frame->components[i] : NULL;
    }
    return found;
}

// Return true if the tables that a component of a scan needs are there.
static bool has_tables(const struct walk *walk, unsigned tables, unsigned first, unsigned refines)
{
    const bool needs_first = first == 0 && refines == 0;
    const bool needs_others = !walk->frame.is_progressive || first > 0;
    const bool has_first = (walk->huffman[0] >> (tables >> 4) & 1) != 0,
               has_others = (walk->huffman[1] >> (tables & 15) & 1) != 0;
    return (has_first || !needs_first) && (has_others || !needs_others);
}

// Look at the head of a scan, and at the restarts in it. Go to its end.
static const char *look_at_scan(struct walk *walk, const unsigned char *segment, size_t length, int *marker)
{
    const unsigned count = length > 2 ? segment[2] : 0;
    unsigned restarts = 0;
    if (count == 0 || count > walk->frame.count || length < 6 + 2 * (size_t)count) {
        *marker = next_marker(walk, &restarts);
        return NULL; // stb_image refuses it
    }
    const unsigned first = segment[3 + 2 * count], refines = segment[5 + 2 * count] >> 4;
    struct component *component = NULL;
    for (unsigned i = 0; i < count; i++) {
        component = find_component(&walk->frame, segment[3 + 2 * i]);
        if (component == NULL) {
            return "damaged JPEG: a scan of a component that is not there";
        }
        if (!has_tables(walk, segment[4 + 2 * i], first, refines)) {
            return "damaged JPEG: a Huffman table is not there";
        }
        component->is_begun = component->is_begun || (first == 0 && refines == 0);
        if (!component->is_begun) {
            return "damaged JPEG: scans are not there";
        }
    }
    walk->has_scan = true;
    *marker = next_marker(walk, &restarts);
    const uint64_t units = count_units(&walk->frame, count == 1 ? component : NULL);
    const uint64_t needed = walk->interval == 0 || units == 0 ? 0 : (units - 1) / walk->interval;
    return restarts < needed ? "damaged JPEG: rows are not there" : NULL;
}

// Look at the components of a file at its end.
static const char *look_at_components(const struct walk *walk)
{
    for (unsigned i = 0; i < walk->frame.count; i++) {
        if (!walk->frame.components[i].is_begun) {
            return "damaged JPEG: scans are not there";
        }
        if ((walk->quantization >> (walk->frame.components[i].table & 15) & 1) == 0) {
            return "damaged JPEG: a table of quantization is not there";
        }
    }
    return NULL;
}

const char *scene_jpeg_gap(const unsigned char *bytes, size_t size, bool *lacks_end)
{
    struct walk walk = {.bytes = bytes, .size = size};
    unsigned restarts = 0;
    const char *problem = NULL;
    int marker = next_marker(&walk, &restarts);
    *lacks_end = false;
    while (marker >= 0 && problem == NULL && (marker != END || !walk.has_scan)) {
        const size_t left = size - walk.at;
        const size_t said = left < 2 ? left : (size_t)bytes[walk.at] << 8 | bytes[walk.at + 1];
        const unsigned char *const segment = bytes + walk.at;
        const size_t length = said < left ? said : left;
        walk.at += marker == START || marker == END ? 0 : length;
        if (marker == BASELINE || marker == EXTENDED || marker == PROGRESSIVE) {
            read_frame(&walk.frame, segment, length, marker == PROGRESSIVE);
        } else if (marker == QUANTIZATION_TABLES) {
            read_quantization(&walk, segment, length);
        } else if (marker == HUFFMAN_TABLES) {
            read_huffman(&walk, segment, length);
        } else if (marker == INTERVAL && length >= 4) {
            walk.interval = (unsigned)segment[2] << 8 | segment[3];
        }
        if (marker == SCAN && walk.frame.count > 0) {
            problem = look_at_scan(&walk, segment, length, &marker);
        } else {
            marker = next_marker(&walk, &restarts);
        }
    }
    if (problem != NULL || walk.frame.count == 0 || !walk.has_scan) {
        return problem;
    }
    *lacks_end = marker < 0;
    return look_at_components(&walk);
}
