// SPDX-License-Identifier: MIT
// What assimp leaves out of a Blender file without a word. A file is a dump of memory: blocks of structs, and a
// description of all structs, the DNA, by which fields are found.
#include "assimp.h"
#include "import/builder/hash_table.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

enum { HEADER = 12 };

// Bytes of a file, or of a part of it. What is not there reads as 0.
struct dump {
    const unsigned char *bytes;
    size_t size;
    size_t pointer; // bytes of a pointer
    bool is_big;    // the highest byte of a number comes first
};

// The parts of the DNA: names of fields, names of types and their sizes, and structs.
struct dna {
    const char **names, **types;
    uint32_t name_count, type_count, struct_count;
    size_t sizes, *structs; // places in the file
};

// Where a field is in its struct. Its size is 0 if the struct has none of that name.
struct field {
    size_t at, size;
};

static uint64_t read_number(const struct dump *dump, size_t at, size_t count)
{
    uint64_t number = 0;
    for (size_t i = 0; i < count && at + i < dump->size; i++) {
        number |= (uint64_t)dump->bytes[at + i] << 8 * (dump->is_big ? count - 1 - i : i);
    }
    return number;
}

// Read texts that a 0 ends, behind a mark and their count. Return what follows them, a multiple of four behind `start`.
static size_t read_texts(struct scene_import *import, const struct dump *dump, size_t start, size_t at,
                         const char ***texts, uint32_t *count)
{
    *count = (uint32_t)read_number(dump, at + 4, 4);
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

// Read the DNA whose block's content is at `start`.
static struct dna read_dna(struct scene_import *import, const struct dump *dump, size_t start)
{
    struct dna dna = {.names = NULL};
    size_t at = read_texts(import, dump, start, start + 4, &dna.names, &dna.name_count);
    at = read_texts(import, dump, start, at, &dna.types, &dna.type_count);
    dna.sizes = at + 4;
    at = dna.sizes + 2 * (size_t)dna.type_count;
    at += (start - at) % 4 + 4;
    const uint64_t count = read_number(dump, at, 4);
    dna.struct_count = at < dump->size && count <= (dump->size - at) / 4 ? (uint32_t)count : 0;
    dna.structs = scene_import_allocate(import, dna.struct_count, sizeof *dna.structs);
    at += 4;
    for (uint32_t i = 0; i < dna.struct_count; i++) {
        dna.structs[i] = at;
        at += 4 + 4 * (size_t)read_number(dump, at + 2, 2);
    }
    return dna;
}

static const char *text_at(const char *const *texts, uint32_t count, uint64_t index)
{
    return index < count ? texts[index] : "";
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

// Find a field of a struct by its name, with its * and without its [].
static struct field find_field(const struct dump *dump, const struct dna *dna, uint32_t index,
                               const char *name)
{
    const size_t at = dna->structs[index], length = strlen(name);
    const uint64_t count = read_number(dump, at + 2, 2);
    size_t offset = 0;
    for (uint64_t i = 0; i < count; i++) {
        const uint64_t type = read_number(dump, at + 4 + 4 * i, 2);
        const char *const field = text_at(dna->names, dna->name_count, read_number(dump, at + 6 + 4 * i, 2));
        const bool is_pointer = field[0] == '*' || field[0] == '(';
        const size_t size =
            (is_pointer ? dump->pointer : (size_t)read_number(dump, dna->sizes + 2 * type, 2)) *
            count_elements(field);
        if (strncmp(field, name, length) == 0 && (field[length] == 0 || field[length] == '[')) {
            return (struct field){offset, size};
        }
        offset += size;
    }
    return (struct field){0, 0};
}

// Return the number in a field of a struct that begins at `at`. Return 0 if there is none.
static uint64_t read_field(const struct dump *dump, size_t at, struct field field)
{
    return read_number(dump, at + field.at, field.size < 8 ? field.size : 8);
}

static bool is_struct(const struct dump *dump, const struct dna *dna, uint32_t index, const char *name)
{
    const uint64_t type = index < dna->struct_count ? read_number(dump, dna->structs[index], 2) : UINT64_MAX;
    return strcmp(text_at(dna->types, dna->type_count, type), name) == 0;
}

enum kind { OBJECT, SCENE, MATERIAL, BASE, KINDS };

enum { MOST_FIELDS = 5 };

// Kinds of blocks that are looked at, and the fields of their structs.
static const struct {
    const char *code, *type, *fields[MOST_FIELDS];
} kinds[KINDS] = {
    [OBJECT] = {"OB\0", "Object", {"type", "restrictflag", "lay", "*dup_group", "particlesystem"}},
    [SCENE] = {"SC\0", "Scene", {"lay", "base"}},
    [MATERIAL] = {"MA\0", "Material", {"use_nodes"}},
    [BASE] = {"DATA", "Base", {"*next", "*object"}}, // a link of the list of a scene's objects
};

// Where the fields of a kind are. They are looked up once, as a hostile file has many blocks, and many fields in a
// struct.
struct layout {
    bool is_known;
    uint32_t index; // number of the struct in the DNA
    struct field fields[MOST_FIELDS];
};

// A block of an object or of a base.
struct block {
    uint64_t address; // what points to it has this number
    size_t at;
    enum kind kind;
    bool is_drawn;
};

struct look {
    struct scene_import *import;
    const struct dump *dump;
    const struct dna *dna;
    struct layout layouts[KINDS];
    bool has_scene;
    uint64_t layers; // layers of the first scene that are shown. 0 if none is known
    uint64_t first;  // address of its first base. 0 if it has none, as since version 2.8
    struct block *blocks;
    size_t block_count, block_capacity;
    struct scene_hash_table places; // finds blocks by their addresses
};

// Return where the fields of a kind of block are. Return NULL for a block of another struct than the first of its kind.
static const struct field *find_layout(struct look *look, enum kind kind, uint32_t index)
{
    struct layout *const layout = &look->layouts[kind];
    if (!layout->is_known && is_struct(look->dump, look->dna, index, kinds[kind].type)) {
        *layout = (struct layout){.is_known = true, .index = index};
        for (size_t i = 0; i < MOST_FIELDS && kinds[kind].fields[i] != NULL; i++) {
            layout->fields[i] = find_field(look->dump, look->dna, index, kinds[kind].fields[i]);
        }
    }
    return layout->is_known && layout->index == index ? layout->fields : NULL;
}

static void look_at_object(const struct look *look, const struct field *fields, size_t at)
{
    enum { MESH = 1, HIDDEN_IN_VIEW = 1, HIDDEN_IN_PICTURE = 4 };
    static const struct {
        uint64_t type;
        const char *what;
    } others[] = {{2, "curves"},        {3, "surfaces"},       {4, "text"},
                  {5, "metaballs"},     {26, "grease pencil"}, {27, "hair"},
                  {28, "point clouds"}, {29, "volumes"},       {30, "grease pencil"}};
    uint64_t values[MOST_FIELDS];
    for (size_t i = 0; i < MOST_FIELDS; i++) {
        struct field field = fields[i];
        field.size = field.size > look->dump->pointer ? look->dump->pointer : field.size;
        values[i] = read_field(look->dump, at, field);
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (values[0] == others[i].type) {
            scene_import_unsupported(look->import, "%s (Blender): not drawn", others[i].what);
        }
    }
    const bool is_layered = look->layers != 0 && values[2] != 0 && (values[2] & look->layers) == 0;
    if (values[0] == MESH && (is_layered || (values[1] & (HIDDEN_IN_VIEW | HIDDEN_IN_PICTURE)) != 0)) {
        scene_import_unsupported(look->import, "hidden objects: drawn");
    }
    if (values[3] != 0) {
        scene_import_unsupported(look->import, "instances of groups (Blender): not drawn");
    }
    if (values[4] != 0) {
        scene_import_unsupported(look->import, "particles (Blender): not drawn");
    }
}

// Find the block of a kind by its address. Return NULL if there is none.
static struct block *find_block(const struct look *look, enum kind kind, uint64_t address)
{
    const uint64_t key[] = {address, kind};
    const uint32_t hash = scene_hash_bytes(key, sizeof key);
    size_t place = SIZE_MAX;
    uint32_t index = scene_hash_next(&look->places, hash, &place);
    while (index != UINT32_MAX &&
           (look->blocks[index].address != address || look->blocks[index].kind != kind)) {
        index = scene_hash_next(&look->places, hash, &place);
    }
    return index == UINT32_MAX ? NULL : &look->blocks[index];
}

// Add a block. Of blocks with one address the first is found.
static void add_block(struct look *look, struct block block)
{
    const uint64_t key[] = {block.address, block.kind};
    scene_import_reserve(look->import, &look->blocks, &look->block_capacity, look->block_count + 1,
                         sizeof *look->blocks);
    if (find_block(look, block.kind, block.address) == NULL) {
        scene_hash_add(look->import, &look->places, scene_hash_bytes(key, sizeof key),
                       (uint32_t)look->block_count);
    }
    look->blocks[look->block_count++] = block;
}

// Mark the objects of the first scene, which assimp draws. Return false if its list is not there.
static bool mark_drawn(struct look *look)
{
    const struct field *const fields = look->layouts[BASE].fields;
    uint64_t address = look->first;
    for (size_t i = 0; address != 0 && i < look->block_count; i++) {
        const struct block *const base = find_block(look, BASE, address);
        if (base == NULL) {
            return false;
        }
        struct block *const object = find_block(look, OBJECT, read_field(look->dump, base->at, fields[1]));
        if (object != NULL) {
            object->is_drawn = true;
        }
        address = read_field(look->dump, base->at, fields[0]);
    }
    return look->first != 0;
}

static void look_at_objects(struct look *look)
{
    const bool is_marked = mark_drawn(look);
    for (size_t i = 0; i < look->block_count; i++) {
        if (look->blocks[i].kind == OBJECT && (look->blocks[i].is_drawn || !is_marked)) {
            look_at_object(look, look->layouts[OBJECT].fields, look->blocks[i].at);
        }
    }
}

static void look_at_block(struct look *look, const char *code, uint32_t index, uint64_t address, size_t at)
{
    for (enum kind kind = 0; kind < KINDS; kind++) {
        const bool is_kind = memcmp(code, kinds[kind].code, 4) == 0;
        const struct field *const fields = is_kind ? find_layout(look, kind, index) : NULL;
        if (fields == NULL) {
            continue;
        }
        if (kind == OBJECT || kind == BASE) {
            add_block(look, (struct block){.address = address, .at = at, .kind = kind});
        } else if (kind == SCENE && !look->has_scene) {
            look->has_scene = true;
            look->layers = read_field(look->dump, at, fields[0]);
            look->first =
                fields[1].size == 0 ? 0 : read_number(look->dump, at + fields[1].at, look->dump->pointer);
        } else if (kind == MATERIAL && read_field(look->dump, at, fields[0]) != 0) {
            scene_import_unsupported(look->import, "materials of nodes (Blender): drawn plain");
        }
    }
}

// Look at the blocks of a file. With `dna` NULL, return where the content of its DNA begins, or 0.
static size_t visit(struct look *look)
{
    const struct dump *const dump = look->dump;
    const size_t head = 16 + dump->pointer;
    for (size_t at = HEADER; at < dump->size && dump->size - at >= head;) {
        const char *const code = (const char *)dump->bytes + at;
        const uint64_t size = read_number(dump, at + 4, 4);
        const uint32_t index = (uint32_t)read_number(dump, at + 8 + dump->pointer, 4);
        const size_t content = at + head;
        if (size > dump->size - content || memcmp(code, "ENDB", 4) == 0) {
            return 0;
        }
        if (look->dna == NULL && memcmp(code, "DNA1", 4) == 0) {
            return content;
        }
        if (look->dna != NULL) {
            look_at_block(look, code, index, read_number(dump, at + 8, dump->pointer), content);
        }
        at = content + (size_t)size;
    }
    return 0;
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

void scene_assimp_look_at_blender(struct scene_import *import)
{
    struct dump dump = {.bytes = NULL};
    if (strcasecmp(import->ending, "blend") != 0) {
        return;
    }
    unsigned char *const bytes = read_whole(import, &dump.size);
    if (bytes == NULL || dump.size < HEADER || memcmp(bytes, "BLENDER", 7) != 0) {
        free(bytes);
        return;
    }
    dump.bytes = bytes;
    dump.pointer = bytes[7] == '_' ? 4 : 8;
    dump.is_big = bytes[8] == 'V';
    struct look look = {.import = import, .dump = &dump};
    const size_t start = visit(&look);
    if (start != 0) {
        const struct dna dna = read_dna(import, &dump, start);
        look.dna = &dna;
        visit(&look);
        look_at_objects(&look);
        free(look.blocks);
        free(look.places.entries);
        free(dna.names);
        free(dna.types);
        free(dna.structs);
    }
    free(bytes);
}
