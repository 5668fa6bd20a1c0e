// SPDX-License-Identifier: MIT
// What floats cannot hold of a file that stands far from the origin, beside the scene that assimp makes of it. assimp
// keeps floats, so it is given the file with two changes. Positions of a geometry that are far from its origin are
// counted from a place among them. The translation of a node gives way to a mark, three whole numbers that floats hold,
// one of which is the number of the node's true matrix in a list. Both are put back in double.
#ifndef SCENE_ASSIMP_EXACT_H
#define SCENE_ASSIMP_EXACT_H

#include <assimp/scene.h>

#include "edits.h"
#include "import/builder/hash_table.h"
#include "import/builder/place.h"

/// What was subtracted from the positions of a geometry.
struct scene_assimp_offset {
    double offset[3];
    const char *name; ///< the name of assimp's mesh, without a 0; NULL where that name has a mark
    size_t length;
};

/// What a mark stands for: all nodes that assimp makes of one of the file, the matrix that it is in, or the translation
/// of it, where assimp's floats are the rest.
enum scene_assimp_mark { SCENE_ASSIMP_NODES, SCENE_ASSIMP_MATRIX, SCENE_ASSIMP_WAY };

struct scene_assimp_marked {
    double matrix[16];
    enum scene_assimp_mark kind;
};

/// A zeroed struct is that of a file which assimp reads as it is.
struct scene_assimp_exact {
    char *bytes; ///< the file as assimp is to read it; NULL for the file as it is
    size_t size;
    struct scene_assimp_marked *places;
    size_t place_count, place_capacity;
    struct scene_assimp_offset *offsets;
    size_t offset_count, offset_capacity;
    struct scene_hash_table names; ///< offsets by their names
    double common[3];              ///< what was subtracted from all positions without an offset of their own
    struct scene_hash_table moved; ///< hashes of names of nodes that an animation moves
    bool rounds_movements;         ///< assimp makes floats of what animations and skins have in double
    double model_size;             ///< size of all of it, by the floats of the file as it is
    double unit;                   ///< factor of the root node; 0 where floats have it
};

/// Names of geometries in an FBX, which need not differ, get this and the number of their offset and this again.
#define SCENE_ASSIMP_NAME_MARK "~far~"

/// Return true if three numbers move something, and none of them is beyond all use.
bool scene_assimp_is_way(const double numbers[3]);
/// Keep the name of a node that an animation moves.
void scene_assimp_keep_moved(struct scene_import *import, struct scene_assimp_exact *exact, const char *name);
/// Return true if an animation may move the nodes that assimp makes of one of this name.
bool scene_assimp_may_move(const struct scene_assimp_exact *exact, const char *name, size_t length);
/// Find where positions are to be counted from. Return false if they are not far from the origin.
bool scene_assimp_find_offset(struct scene_import *import, const double (*points)[3], size_t count,
                              double offset[3]);
/// Keep a matrix, and write the mark that stands for it. A mark whose numbers are negative stands for its inverse.
void scene_assimp_mark_matrix(struct scene_import *import, struct scene_assimp_exact *exact,
                              enum scene_assimp_mark kind, const double matrix[16], double mark[3]);
/// Keep a translation, and write the mark that stands for it. The rest of the matrix stays that of floats.
void scene_assimp_mark_way(struct scene_import *import, struct scene_assimp_exact *exact, const double way[3],
                           double mark[3]);
/// Keep an offset. Return its number.
size_t scene_assimp_keep_offset(struct scene_import *import, struct scene_assimp_exact *exact,
                                const double offset[3]);
/// Keep an offset, which may be zeros, for the mesh of a name. Return false if the name has one.
bool scene_assimp_name_offset(struct scene_import *import, struct scene_assimp_exact *exact, const char *name,
                              size_t length, const double offset[3]);
/// Write a number that is a float as text. Return its length.
size_t scene_assimp_write_number(char text[32], double number);
/// Replace `length` bytes of a text from `at` on by points less an offset, with a byte between numbers.
void scene_assimp_edit_points(struct scene_import *import, struct scene_edits *edits, size_t at,
                              size_t length, char between, const double (*points)[3], size_t count,
                              const double offset[3]);

/// Return the place of a node within its parent. Its floats are assimp's, but for what a mark stands for.
struct scene_import_place scene_assimp_exact_place(const struct scene_assimp_exact *exact,
                                                   const struct aiNode *node);
/// Return the place that a bone moves its vertices from. Its floats are assimp's, but for what a mark stands for.
struct scene_import_place scene_assimp_exact_bone(const struct scene_assimp_exact *exact,
                                                  const struct aiBone *bone);
/// Put back what a node's mark stands for where an animation left the numbers of a translation as they are in the node.
void scene_assimp_unmark_way(const struct scene_assimp_exact *exact, const struct aiNode *node,
                             double way[3]);
/// Return a place in the world as it is for what is at `offset` and about it: the turns of floats, which are those of a
/// file near the origin, and the translation that doubles have.
struct scene_import_place scene_assimp_settled(const struct scene_assimp_exact *exact,
                                               struct scene_import_place place, const double offset[3]);
/// Write the place of a node within its parent as floats hold it. What has a mark is exact and does not count: its
/// translation is written as zeros, but while the file is read as it is, and where a movement is rounded.
void scene_assimp_float_place(const struct scene_assimp_exact *exact, const struct aiNode *node,
                              double place[16]);
/// Return what was subtracted from the positions of a mesh, or zeros.
const double *scene_assimp_exact_offset(const struct scene_assimp_exact *exact, const struct aiMesh *mesh);
/// Return the name of a mesh without its mark.
const char *scene_assimp_exact_name(struct scene_import *import, const struct scene_assimp_exact *exact,
                                    const struct aiScene *scene, unsigned index);

/// Return true if floats lose what can be seen of a scene that stands far from the origin, or has parts that do. What
/// is exact by now does not count.
bool scene_assimp_is_far(struct scene_import *import, struct scene_assimp_exact *exact,
                         const struct aiScene *scene);
/// Rewrite the file of the import. Return false if there is nothing that can be rewritten.
bool scene_assimp_rewrite(struct scene_import *import, struct scene_assimp_exact *exact);

// Each rewrites a file of one format, of which it knows nothing yet. It returns NULL if the file is of another format,
// or not as it should be. A 0 follows the bytes.
char *scene_assimp_rewrite_fbx(struct scene_import *import, struct scene_assimp_exact *exact,
                               const char *bytes, size_t *size);
char *scene_assimp_rewrite_fbx_text(struct scene_import *import, struct scene_assimp_exact *exact,
                                    const char *bytes, size_t *size);
char *scene_assimp_rewrite_collada(struct scene_import *import, struct scene_assimp_exact *exact, char *bytes,
                                   size_t *size);
char *scene_assimp_rewrite_dxf(struct scene_import *import, struct scene_assimp_exact *exact, char *bytes,
                               size_t *size);

#endif
