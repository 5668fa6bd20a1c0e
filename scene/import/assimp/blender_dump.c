// SPDX-License-Identifier: MIT
#include "blender_dump.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

enum { HEADER = 12 };

uint64_t scene_blender_number(const struct scene_blender_dump *dump, size_t at, size_t count)
{
    uint64_t number = 0;
    for (size_t i = 0; i < count && at + i < dump->size; i++) {
        number |= (uint64_t)dump->bytes[at + i] << 8 * (dump->is_big ? count - 1 - i : i);
    }
    return number;
}

// Read texts that a 0 ends, behind a mark and their count. Return what follows them, a multiple of four behind `start`.
static size_t read_texts(struct scene_import *import, const struct scene_blender_dump *dump, size_t start,
                         size_t at, const char ***texts, uint32_t *count)
{
    *count = (uint32_t)scene_blender_number(dump, at + 4, 4);
    at += 8;
    if (at > dump->size || *count > dump->size - at) {
        *count = 0;
    }
    *texts = scene_import_allocate(import, *count, sizeof **texts);
    for (uint32_t i = 0; i < *count; i++) {
        const unsigned char *const text = dump->bytes + at;
        const unsigned char *const zero = at < dump->size ? memchr(text, 0, dump->size - at) : NULL;
        if (zero == NULL) {
            *count = i;
            break;
        }
        (*texts)[i] = (const char *)text;
        at += (size_t)(zero - text) + 1;
    }
    return at + (start - at) % 4;
}

// Return how many elements a field has by its name, as in "mat[4][4]".
static size_t count_elements(const char *name)
{
    size_t count = 1;
    for (const char *c = strchr(name, '['); c != NULL; c = strchr(c + 1, '[')) {
        const unsigned long length = strtoul(c + 1, NULL, 10);
        count = length < 65536 && count < 65536 ? count * length : 0;
    }
    return count;
}

// Read the DNA whose block's content is at `start`.
static struct scene_blender_dna read_dna(struct scene_import *import, const struct scene_blender_dump *dump,
                                         size_t start)
{
    struct scene_blender_dna dna = {.names = NULL};
    size_t at = read_texts(import, dump, start, start + 4, &dna.names, &dna.name_count);
    dna.elements = scene_import_allocate(import, dna.name_count, sizeof *dna.elements);
    for (uint32_t i = 0; i < dna.name_count; i++) {
        dna.elements[i] = count_elements(dna.names[i]);
    }
    at = read_texts(import, dump, start, at, &dna.types, &dna.type_count);
    dna.sizes = at + 4;
    at = dna.sizes + 2 * (size_t)dna.type_count;
    at += (start - at) % 4 + 4;
    const uint64_t count = scene_blender_number(dump, at, 4);
    dna.struct_count = at < dump->size && count <= (dump->size - at) / 4 ? (uint32_t)count : 0;
    dna.structs = scene_import_allocate(import, dna.struct_count, sizeof *dna.structs);
    at += 4;
    for (uint32_t i = 0; i < dna.struct_count; i++) {
        dna.structs[i] = at;
        at += 4 + 4 * (size_t)scene_blender_number(dump, at + 2, 2);
    }
    return dna;
}

static const char *text_at(const char *const *texts, uint32_t count, uint64_t index)
{
    return index < count ? texts[index] : "";
}

// Find a field of a struct by its name, with its * and without its [].
static struct scene_blender_field find_field(const struct scene_blender_dump *dump,
                                             const struct scene_blender_dna *dna, uint32_t index,
                                             const char *name)
{
    const size_t at = dna->structs[index], length = strlen(name);
    const uint64_t count = scene_blender_number(dump, at + 2, 2);
    size_t offset = 0;
    for (uint64_t i = 0; i < count; i++) {
        const uint64_t type = scene_blender_number(dump, at + 4 + 4 * i, 2);
        const uint64_t number = scene_blender_number(dump, at + 6 + 4 * i, 2);
        const char *const field = text_at(dna->names, dna->name_count, number);
        const bool is_pointer = field[0] == '*' || field[0] == '(';
        const size_t size =
            (is_pointer ? dump->pointer : (size_t)scene_blender_number(dump, dna->sizes + 2 * type, 2)) *
            (number < dna->name_count ? dna->elements[number] : 1);
        if (strncmp(field, name, length) == 0 && (field[length] == 0 || field[length] == '[')) {
            return (struct scene_blender_field){offset, size};
        }
        offset += size;
    }
    return (struct scene_blender_field){0, 0};
}

uint64_t scene_blender_read(const struct scene_blender_dump *dump, size_t at,
                            struct scene_blender_field field)
{
    return scene_blender_number(dump, at + field.at, field.size < 8 ? field.size : 8);
}

// Return true if a struct of the DNA has this name.
static bool is_struct(const struct scene_blender_dump *dump, const struct scene_blender_dna *dna,
                      uint32_t index, const char *name)
{
    const uint64_t type =
        index < dna->struct_count ? scene_blender_number(dump, dna->structs[index], 2) : UINT64_MAX;
    return strcmp(text_at(dna->types, dna->type_count, type), name) == 0;
}

struct scene_blender_field scene_blender_find_in_id(const struct scene_blender_dump *dump,
                                                    const struct scene_blender_dna *dna, const char *name)
{
    for (uint32_t i = 0; i < dna->struct_count; i++) {
        if (is_struct(dump, dna, i, "ID")) {
            return find_field(dump, dna, i, name);
        }
    }
    return (struct scene_blender_field){0, 0};
}

bool scene_blender_is_kind(const struct scene_blender_file *file, const struct scene_blender_block *block,
                           const struct scene_blender_kind *kind, struct scene_blender_layout *layout)
{
    const struct scene_blender_dump *const dump = &file->dump;
    const struct scene_blender_dna *const dna = &file->dna;
    if (memcmp(block->code, kind->code, 4) != 0) {
        return false;
    }
    if (!layout->is_known && is_struct(dump, dna, block->index, kind->type)) {
        const size_t type = (size_t)scene_blender_number(dump, dna->structs[block->index], 2);
        *layout = (struct scene_blender_layout){
            .is_known = true,
            .index = block->index,
            .size = (size_t)scene_blender_number(dump, dna->sizes + 2 * type, 2)};
        for (size_t i = 0; i < SCENE_BLENDER_FIELDS && kind->fields[i] != NULL; i++) {
            layout->fields[i] = find_field(dump, dna, block->index, kind->fields[i]);
        }
    }
    return layout->is_known && layout->index == block->index;
}

// Return the bytes of a file, which may be compressed by gzip. Return NULL if they cannot be read.
static unsigned char *read_whole(struct scene_import *import, size_t *size)
{
    enum { PART = 1 << 20, MOST = 1 << 30 };
    unsigned char *bytes = NULL;
    size_t capacity = 0;
    const gzFile file = gzopen(import->model.path, "rb");
    int got = file == NULL ? -1 : 1;
    *size = 0;
    while (got > 0 && *size < MOST) {
        scene_import_reserve(import, &bytes, &capacity, *size + PART, 1);
        got = gzread(file, bytes + *size, PART);
        *size += got > 0 ? (size_t)got : 0;
    }
    if (file != NULL) {
        gzclose(file);
    }
    return bytes;
}

bool scene_blender_next(const struct scene_blender_dump *dump, size_t *at, struct scene_blender_block *block)
{
    const size_t head = 16 + dump->pointer;
    if (*at >= dump->size || dump->size - *at < head) {
        return false;
    }
    *block = (struct scene_blender_block){
        .code = (const char *)dump->bytes + *at,
        .size = scene_blender_number(dump, *at + 4, 4),
        .address = scene_blender_number(dump, *at + 8, dump->pointer),
        .index = (uint32_t)scene_blender_number(dump, *at + 8 + dump->pointer, 4),
        .at = *at + head};
    *at = block->at + block->size;
    return block->size <= dump->size - block->at && memcmp(block->code, "ENDB", 4) != 0;
}

bool scene_blender_open(struct scene_import *import, struct scene_blender_file *file)
{
    *file = (struct scene_blender_file){.first = HEADER};
    if (strcasecmp(import->ending, "blend") != 0) {
        return false;
    }
    struct scene_blender_dump *const dump = &file->dump;
    dump->bytes = file->bytes = read_whole(import, &dump->size);
    if (dump->bytes == NULL || dump->size < HEADER || memcmp(dump->bytes, "BLENDER", 7) != 0) {
        free(file->bytes);
        return false;
    }
    dump->pointer = dump->bytes[7] == '_' ? 4 : 8;
    dump->is_big = dump->bytes[8] == 'V';
    struct scene_blender_block block;
    for (size_t at = file->first; scene_blender_next(dump, &at, &block);) {
        if (memcmp(block.code, "DNA1", 4) == 0) {
            file->dna = read_dna(import, dump, block.at);
            return true;
        }
    }
    free(file->bytes);
    return false;
}

void scene_blender_close(struct scene_blender_file *file)
{
    free(file->dna.names);
    free(file->dna.elements);
    free(file->dna.types);
    free(file->dna.structs);
    free(file->bytes);
}
