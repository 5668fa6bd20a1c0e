// SPDX-License-Identifier: MIT
// What assimp leaves out of a Blender file without a word.
#include "blender_gaps.h"

#include "blender_dump.h"
#include "import/builder/hash_table.h"

#include <stdlib.h>
#include <string.h>

enum kind { OBJECT, SCENE, MATERIAL, BASE, KINDS };

static const struct scene_blender_kind kinds[KINDS] = {
    [OBJECT] = {"OB\0", "Object", {"type", "restrictflag", "lay", "*dup_group", "particlesystem"}},
    [SCENE] = {"SC\0", "Scene", {"lay", "base"}},
    [MATERIAL] = {"MA\0", "Material", {"use_nodes"}},
    [BASE] = {"DATA", "Base", {"*next", "*object"}}, // a link of the list of a scene's objects
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
    const struct scene_blender_file *file;
    struct scene_blender_layout layouts[KINDS];
    struct scene_blender_field users, flags; // in the ID of a thing
    bool has_scene;
    uint64_t layers; // layers of the first scene that are shown. 0 if none is known
    uint64_t first;  // address of its first base. 0 if it has none, as since version 2.8
    struct block *blocks;
    size_t block_count, block_capacity;
    struct scene_hash_table places; // finds blocks by their addresses
};

static void look_at_object(const struct look *look, const struct scene_blender_field *fields, size_t at)
{
    enum { MESH = 1, HIDDEN_IN_VIEW = 1, HIDDEN_IN_PICTURE = 4 };
    static const struct {
        uint64_t type;
        const char *what;
    } others[] = {{2, "curves"},        {3, "surfaces"},       {4, "text"},
                  {5, "metaballs"},     {26, "grease pencil"}, {27, "hair"},
                  {28, "point clouds"}, {29, "volumes"},       {30, "grease pencil"}};
    uint64_t values[SCENE_BLENDER_FIELDS];
    for (size_t i = 0; i < SCENE_BLENDER_FIELDS; i++) {
        struct scene_blender_field field = fields[i];
        field.size = field.size > look->file->dump.pointer ? look->file->dump.pointer : field.size;
        values[i] = scene_blender_read(&look->file->dump, at, field);
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
    const struct scene_blender_field *const fields = look->layouts[BASE].fields;
    uint64_t address = look->first;
    for (size_t i = 0; address != 0 && i < look->block_count; i++) {
        const struct block *const base = find_block(look, BASE, address);
        if (base == NULL) {
            return false;
        }
        struct block *const object =
            find_block(look, OBJECT, scene_blender_read(&look->file->dump, base->at, fields[1]));
        if (object != NULL) {
            object->is_drawn = true;
        }
        address = scene_blender_read(&look->file->dump, base->at, fields[0]);
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

// Return true if anything uses what begins at `at`. What nothing uses a user may have kept, which counts as one.
static bool is_used(const struct look *look, size_t at)
{
    enum { IS_KEPT = 1 << 9 };
    const uint64_t kept = (scene_blender_read(&look->file->dump, at, look->flags) & IS_KEPT) != 0;
    return look->users.size == 0 || scene_blender_read(&look->file->dump, at, look->users) > kept;
}

static void look_at_block(struct look *look, const struct scene_blender_block *block)
{
    const size_t at = block->at;
    for (enum kind kind = 0; kind < KINDS; kind++) {
        const struct scene_blender_field *const fields = look->layouts[kind].fields;
        if (!scene_blender_is_kind(look->file, block, &kinds[kind], &look->layouts[kind])) {
            continue;
        }
        if (kind == OBJECT || kind == BASE) {
            add_block(look, (struct block){.address = block->address, .at = at, .kind = kind});
        } else if (kind == SCENE && !look->has_scene) {
            look->has_scene = true;
            look->layers = scene_blender_read(&look->file->dump, at, fields[0]);
            look->first = fields[1].size == 0 ? 0
                                              : scene_blender_number(&look->file->dump, at + fields[1].at,
                                                                     look->file->dump.pointer);
        } else if (kind == MATERIAL && scene_blender_read(&look->file->dump, at, fields[0]) != 0 &&
                   is_used(look, at)) {
            scene_import_unsupported(look->import, "materials of nodes (Blender): drawn plain");
        }
    }
}

void scene_blender_tell_gaps(struct scene_import *import, const struct scene_blender_file *file)
{
    struct look look = {.import = import,
                        .file = file,
                        .users = scene_blender_find_in_id(&file->dump, &file->dna, "us"),
                        .flags = scene_blender_find_in_id(&file->dump, &file->dna, "flag")};
    struct scene_blender_block block;
    for (size_t at = file->first; scene_blender_next(&file->dump, &at, &block);) {
        look_at_block(&look, &block);
    }
    look_at_objects(&look);
    free(look.blocks);
    free(look.places.entries);
}
