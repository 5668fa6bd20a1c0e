// SPDX-License-Identifier: MIT
// The triangles of a bin are read 8 at a time and ahead of what is drawn: they lie anywhere in their chunk, as their
// vertices do. Without this, a mesh in random order spends two thirds of its time waiting for them.
#ifndef RHW_BIN_READER_H
#define RHW_BIN_READER_H

#include "kernels/raster/vertex_record.h"
#include "kernels/tile_work.h"

enum {
    BATCH = 8,
    BATCHES_AHEAD = 2,        // batches between asking for vertices and drawing
    RECORDS_AHEAD = 2 * BATCH // triangles between asking for a record and reading it
};

// A batch of `count` triangles in the order of drawing. The first triangle stands again behind the last. `number`
// counts the triangles that are drawn in two phases.
struct bin_batch {
    int count;
    uint32_t number[BATCH];
    const struct rhw_triangle *triangle[BATCH];
    const struct rhw_vertex_record *vertex[BATCH][3];
};

// The state of the reading of a bin: `next` of its triangles were looked at. first_number is the number of the bin's
// first triangle. The next entry is `step` from the one before: RHW_PHASE_BACKWARDS begins with the last entry.
struct bin_reader {
    const struct rhw_chunk *chunk;
    const uint16_t *entries;
    ptrdiff_t step;
    uint32_t next, end, first_number;
    const uint8_t *seen; // NULL except in RHW_PHASE_SHADE
};

static struct bin_reader read_bin(const struct tile_work *work, const struct bin *bin, uint32_t first_number)
{
    const bool backwards = work->phase == RHW_PHASE_BACKWARDS;
    const struct bin_reader reader = {.chunk = bin->chunk,
                                      .entries =
                                          bin->chunk->entries + (backwards ? bin->end - 1 : bin->first),
                                      .step = backwards ? -1 : 1,
                                      .end = bin->end - bin->first,
                                      .first_number = first_number,
                                      .seen = work->phase == RHW_PHASE_SHADE ? work->scratch->seen : NULL};
    for (uint32_t k = 0; k < RECORDS_AHEAD && k < reader.end; k++) {
        __builtin_prefetch(&reader.chunk->triangles[reader.entries[reader.step * (ptrdiff_t)k]]);
    }
    return reader;
}

// Read the next triangles. If the batch stays empty, none are left.
static void read_batch(struct bin_reader *reader, struct bin_batch *batch)
{
    const struct rhw_triangle *const triangles = reader->chunk->triangles;
    const struct rhw_segment *const segments = reader->chunk->segments;
    const uint8_t *const seen = reader->seen;
    const ptrdiff_t step = reader->step;
    const uint32_t end = reader->end;
    uint32_t k = reader->next;
    int count = 0;
    for (; k < end && count < BATCH; k++) {
        const uint16_t *const entry = reader->entries + step * (ptrdiff_t)k;
        const uint32_t number = reader->first_number + k;
        if (k + RECORDS_AHEAD < end) {
            __builtin_prefetch(&triangles[entry[step * RECORDS_AHEAD]]);
        }
        if (seen && !(seen[number / 8] >> number % 8 & 1)) {
            continue;
        }
        const struct rhw_triangle *const t = &triangles[*entry];
        const struct rhw_segment *const segment = &segments[t->segment];
        for (int v = 0; v < 3; v++) {
            batch->vertex[count][v] = record_at(segment, t->vertex[v]);
            __builtin_prefetch(batch->vertex[count][v]);
        }
        batch->number[count] = number;
        batch->triangle[count++] = t;
    }
    reader->next = k;
    batch->count = count;
    for (int i = count; i < BATCH && count != 0; i++) {
        batch->triangle[i] = batch->triangle[0];
        memcpy(batch->vertex[i], batch->vertex[0], sizeof batch->vertex[0]);
    }
}

#endif
