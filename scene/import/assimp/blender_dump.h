// SPDX-License-Identifier: MIT
// A Blender file, which is a dump of memory: blocks of structs, and a description of all structs, the DNA, by which
// fields are found.
#ifndef SCENE_IMPORT_BLENDER_DUMP_H
#define SCENE_IMPORT_BLENDER_DUMP_H

#include "import/builder/import.h"

/// Bytes of a file. What is not there reads as 0.
struct scene_blender_dump {
    const unsigned char *bytes;
    size_t size;
    size_t pointer; ///< bytes of a pointer
    bool is_big;    ///< the highest byte of a number comes first
};

/// The parts of the DNA: names of fields, names of types and their sizes, and structs.
struct scene_blender_dna {
    const char **names, **types;
    size_t *elements; ///< how many a field of each name has
    uint32_t name_count, type_count, struct_count;
    size_t sizes, *structs; ///< places in the file
};

/// Where a field is in its struct. Its size is 0 if the struct has none of that name.
struct scene_blender_field {
    size_t at, size;
};

/// A block of a file.
struct scene_blender_block {
    const char *code; ///< four letters
    size_t at, size;  ///< where its structs are, and their bytes
    uint64_t address; ///< what points to it has this number
    uint32_t index;   ///< number of its struct in the DNA
};

struct scene_blender_file {
    struct scene_blender_dump dump;
    struct scene_blender_dna dna;
    size_t first; ///< place of its first block
    unsigned char *bytes;
};

enum { SCENE_BLENDER_FIELDS = 5 };

/// A kind of block: its code, the name of its struct, and the fields that are looked at.
struct scene_blender_kind {
    const char *code, *type, *fields[SCENE_BLENDER_FIELDS];
};

/// Where the fields of a kind are. They are looked up once, as a hostile file has many blocks, and many fields in a
/// struct. A zeroed layout is not known yet.
struct scene_blender_layout {
    bool is_known;
    uint32_t index; ///< number of the struct in the DNA
    size_t size;    ///< bytes of the struct
    struct scene_blender_field fields[SCENE_BLENDER_FIELDS];
};

/// Read the file of an import, which may be compressed by gzip. Return false if it is no Blender file with a DNA.
bool scene_blender_open(struct scene_import *import, struct scene_blender_file *file);
void scene_blender_close(struct scene_blender_file *file);
/// Read the block at a place, and set the place of the next. Return false at the end, or where a block is cut.
bool scene_blender_next(const struct scene_blender_dump *dump, size_t *at, struct scene_blender_block *block);
uint64_t scene_blender_number(const struct scene_blender_dump *dump, size_t at, size_t count);
/// Return true if a block is of a kind, whose layout is known then. It is that of the first struct that is met, and
/// blocks of another one are of no kind.
bool scene_blender_is_kind(const struct scene_blender_file *file, const struct scene_blender_block *block,
                           const struct scene_blender_kind *kind, struct scene_blender_layout *layout);
/// Find a field of the ID, with which things that have names begin.
struct scene_blender_field scene_blender_find_in_id(const struct scene_blender_dump *dump,
                                                    const struct scene_blender_dna *dna, const char *name);
/// Return the number in a field of a struct that begins at `at`. Return 0 if there is none.
uint64_t scene_blender_read(const struct scene_blender_dump *dump, size_t at,
                            struct scene_blender_field field);

#endif
