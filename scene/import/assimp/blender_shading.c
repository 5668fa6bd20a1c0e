// SPDX-License-Identifier: MIT
// How the faces of a Blender file are shaded. Each says whether it is smooth, which assimp does not: it gives all
// corners the normals of their vertices, by which a cube looks like a ball.
#include "blender_shading.h"

#include "blender_dump.h"
#include "import/builder/hash_table.h"

#include <stdlib.h>
#include <string.h>

enum kind { OBJECT, MESH, POLYGONS, FACES, KINDS };

// Files have polygons since version 2.63.
static const struct scene_blender_kind kinds[KINDS] = {
    [OBJECT] = {"OB\0", "Object", {"type", "*data", "id"}},
    [MESH] = {"ME\0", "Mesh", {"flag", "*mpoly", "*mface"}},
    [POLYGONS] = {"DATA", "MPoly", {"flag"}},
    [FACES] = {"DATA", "MFace", {"flag"}},
};

struct part {
    enum kind kind;
    struct scene_blender_block block;
    bool is_counted;
    bool some_flat, some_smooth;
};

struct look {
    struct scene_import *import;
    const struct scene_blender_file *file;
    struct scene_blender_layout layouts[KINDS];
    struct scene_blender_field name; // in the ID of a thing
    struct part *parts;
    size_t count, capacity;
    struct scene_hash_table places; // finds parts by kind and address
};

static uint32_t hash_of(enum kind kind, uint64_t address)
{
    const uint64_t key[] = {address, kind};
    return scene_hash_bytes(key, sizeof key);
}

// Find the part of a kind at an address. Return NULL if there is none.
static struct part *find_part(const struct look *look, enum kind kind, uint64_t address)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = hash_of(kind, address);
    uint32_t i = scene_hash_next(&look->places, hash, &place);
    while (i != UINT32_MAX && (look->parts[i].block.address != address || look->parts[i].kind != kind)) {
        i = scene_hash_next(&look->places, hash, &place);
    }
    return i == UINT32_MAX ? NULL : &look->parts[i];
}

static void collect(struct look *look)
{
    struct scene_blender_block block;
    for (size_t at = look->file->first; scene_blender_next(&look->file->dump, &at, &block);) {
        for (enum kind kind = 0; kind < KINDS; kind++) {
            struct scene_blender_layout *const layout = &look->layouts[kind];
            if (scene_blender_is_kind(look->file, &block, &kinds[kind], layout) && layout->size > 0 &&
                find_part(look, kind, block.address) == NULL) {
                scene_import_reserve(look->import, &look->parts, &look->capacity, look->count + 1,
                                     sizeof *look->parts);
                scene_hash_add(look->import, &look->places, hash_of(kind, block.address),
                               (uint32_t)look->count);
                look->parts[look->count++] = (struct part){.kind = kind, .block = block};
            }
        }
    }
}

// Look at the flags of the faces in a block.
static void count_faces(const struct look *look, struct part *part)
{
    enum { SMOOTH = 1 };
    const struct scene_blender_layout *const layout = &look->layouts[part->kind];
    for (size_t at = 0; !part->is_counted && part->block.size - at >= layout->size; at += layout->size) {
        const bool is_smooth =
            (scene_blender_read(&look->file->dump, part->block.at + at, layout->fields[0]) & SMOOTH) != 0;
        part->some_smooth = part->some_smooth || is_smooth;
        part->some_flat = part->some_flat || !is_smooth;
    }
    part->is_counted = true;
}

// Find out how a mesh is shaded. One whose faces are not there is as assimp has it.
static enum scene_blender_shading find_shading(const struct look *look, const struct part *mesh)
{
    enum { SMOOTH_BY_ANGLE = 1 << 5 };
    const struct scene_blender_dump *const dump = &look->file->dump;
    const struct scene_blender_field *const fields = look->layouts[MESH].fields;
    struct part *faces = find_part(look, POLYGONS, scene_blender_read(dump, mesh->block.at, fields[1]));
    if (faces == NULL) {
        faces = find_part(look, FACES, scene_blender_read(dump, mesh->block.at, fields[2]));
    }
    if (faces == NULL) {
        return SCENE_BLENDER_SMOOTH;
    }
    count_faces(look, faces);
    const bool by_angle = (scene_blender_read(dump, mesh->block.at, fields[0]) & SMOOTH_BY_ANGLE) != 0;
    return !faces->some_smooth              ? SCENE_BLENDER_FLAT
           : !faces->some_flat && !by_angle ? SCENE_BLENDER_SMOOTH
                                            : SCENE_BLENDER_CREASED;
}

// Add the shading of an object by its name, which two letters precede. assimp has its bytes, in any encoding.
static void add_object(const struct look *look, struct scene_blender_shadings *shadings,
                       const struct part *object)
{
    enum { MESHES = 1, LETTERS = 2 };
    const struct scene_blender_dump *const dump = &look->file->dump;
    const struct scene_blender_field *const fields = look->layouts[OBJECT].fields;
    if (scene_blender_read(dump, object->block.at, fields[0]) != MESHES || look->name.size <= LETTERS ||
        fields[2].size < look->name.at + look->name.size ||
        object->block.size < fields[2].at + fields[2].size) {
        return;
    }
    const struct part *const mesh =
        find_part(look, MESH, scene_blender_read(dump, object->block.at, fields[1]));
    const enum scene_blender_shading shading = mesh == NULL ? SCENE_BLENDER_SMOOTH : find_shading(look, mesh);
    if (shading == SCENE_BLENDER_SMOOTH) {
        return;
    }
    const char *const name =
        (const char *)dump->bytes + object->block.at + fields[2].at + look->name.at + LETTERS;
    const size_t length = strnlen(name, look->name.size - LETTERS);
    scene_import_reserve(look->import, &shadings->list, &shadings->capacity, shadings->count + 1,
                         sizeof *shadings->list);
    scene_hash_add(look->import, &shadings->names, scene_hash_bytes(name, length), (uint32_t)shadings->count);
    char *const bytes = scene_import_allocate(look->import, length + 1, 1);
    shadings->list[shadings->count++] = (struct scene_blender_shaded){memcpy(bytes, name, length), shading};
}

void scene_blender_find_shadings(struct scene_import *import, const struct scene_blender_file *file,
                                 struct scene_blender_shadings *shadings)
{
    struct look look = {
        .import = import, .file = file, .name = scene_blender_find_in_id(&file->dump, &file->dna, "name")};
    collect(&look);
    for (size_t i = 0; i < look.count; i++) {
        if (look.parts[i].kind == OBJECT) {
            add_object(&look, shadings, &look.parts[i]);
        }
    }
    free(look.parts);
    free(look.places.entries);
}

enum scene_blender_shading scene_blender_shading(const struct scene_blender_shadings *shadings,
                                                 const char *name)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = scene_hash_bytes(name, strlen(name));
    uint32_t i = scene_hash_next(&shadings->names, hash, &place);
    while (i != UINT32_MAX && strcmp(shadings->list[i].name, name) != 0) {
        i = scene_hash_next(&shadings->names, hash, &place);
    }
    return i == UINT32_MAX ? SCENE_BLENDER_SMOOTH : shadings->list[i].shading;
}

void scene_blender_free_shadings(struct scene_blender_shadings *shadings)
{
    for (size_t i = 0; i < shadings->count; i++) {
        free(shadings->list[i].name);
    }
    free(shadings->list);
    free(shadings->names.entries);
}
