// SPDX-License-Identifier: MIT
// The parts of the assimp reader.
#ifndef SCENE_IMPORT_ASSIMP_H
#define SCENE_IMPORT_ASSIMP_H

#include <assimp/cfileio.h>
#include <assimp/scene.h>

#include "assimp_exact.h"

/// Adds a material of the scene, converted to metallic-roughness. `colored`: its mesh has vertex colours.
uint32_t scene_assimp_material(struct scene_import *import, const struct aiScene *scene,
                               const struct aiMaterial *material, bool colored);
/// A name as the model keeps it.
const char *scene_assimp_string(struct scene_import *import, const struct aiString *string);
/// Column major.
void scene_assimp_matrix(const struct aiMatrix4x4 *m, float matrix[16]);
/// Lists the animations in the model, and moves the scene's nodes as the one that is wanted says.
void scene_assimp_pose(struct scene_import *import, struct scene_assimp_exact *exact,
                       const struct aiScene *scene);
/// Whether the mesh follows bones in the pose that is wanted: it then stands in the world, not at its node.
bool scene_assimp_is_skinned(const struct scene_import *import, const struct aiMesh *mesh);
/// Brings the vertices of a skinned mesh there, less `origin`, which is not 0 if that is far away.
void scene_assimp_skin(struct scene_import *import, const struct scene_assimp_exact *exact,
                       const struct aiScene *scene, unsigned index, struct scene_mesh *mesh,
                       double origin[3]);
/// Add the cameras of a scene to the model, each at the node of its name.
void scene_assimp_add_cameras(struct scene_import *import, const struct scene_assimp_exact *exact,
                              const struct aiScene *scene);
/// Add the lights of a scene whose meshes are placed, as strong as they light the middle of these.
void scene_assimp_add_lights(struct scene_import *import, const struct scene_assimp_exact *exact,
                             const struct aiScene *scene);
/// The first node, from one on downward, that holds a mesh. NULL if none does.
const struct aiNode *scene_assimp_holder(const struct aiNode *node, unsigned mesh);
/// Tells the user what assimp says that it leaves out, from now to the end of the process.
void scene_assimp_listen(struct scene_import *import);
/// Tells the user what assimp leaves out without a word, as the file has it.
void scene_assimp_find_gaps(struct scene_import *import);
/// Tells the user what assimp leaves out of a file that an X3D shows.
void scene_assimp_find_gaps_within(struct scene_import *import, const char *path);
/// Tells the user what assimp leaves out of a model that is made of chunks, if it is one of 3DS, LightWave or Blitz3D.
void scene_assimp_look_at_chunks(struct scene_import *import, const void *bytes, size_t size);
/// Tells the user what is left out of a DXF, and what of it is drawn that is hidden.
void scene_assimp_look_at_dxf(struct scene_import *import, char *bytes, size_t size);
/// Tells the user what assimp leaves out of a model if it is one of NFF or AC3D.
void scene_assimp_look_at_text(struct scene_import *import, char *bytes, size_t size);
/// Fail the import if it is an ASE with indices of what is not there.
void scene_assimp_look_at_ase(struct scene_import *import, char *bytes, size_t size);
/// Tells the user what assimp leaves out of the text of a Collada document. A 0 follows it.
void scene_assimp_look_at_collada(struct scene_import *import, char *text, size_t size);
enum { SCENE_ASSIMP_UNKNOWNS = 16 }; ///< nodes of a file that are left out at most

/// Nodes of X3D that assimp refuses a file for, and the nodes that they are in.
struct scene_assimp_unknown {
    char node[64], parent[64];
};
struct scene_assimp_unknowns {
    struct scene_assimp_unknown list[SCENE_ASSIMP_UNKNOWNS];
    unsigned count, blanked; // `blanked` of them are no longer in the text
    char *text;              // the file as assimp can read it, a 0 behind it; NULL before it is read
    size_t size;
};

struct scene_blender_shadings;
/// Tell the user what assimp leaves out of a Blender file, and what of it is drawn that is hidden. Find how its objects
/// are shaded, of which none is listed where the file is no Blender file.
void scene_assimp_look_at_blender(struct scene_import *import, struct scene_blender_shadings *shadings);
/// What assimp reads: the file of the import, or the bytes that stand for it.
struct scene_assimp_source {
    struct scene_import *import;
    const struct scene_assimp_exact *exact;
    struct scene_assimp_unknowns *unknowns; // nodes that it gets the file without
    // What the model becomes for assimp, which opens it several times. NULL: it is read as it is.
    char *changed;
    size_t changed_size;
    bool is_looked_at; // it is known whether the model becomes anything else
};

/// What opens regular files within import->confine, and the model itself; it lives as long as `source`.
struct aiFileIO scene_assimp_files(struct scene_assimp_source *source);
/// Return the document of an archive of Collada, a 0 behind it. Fail the import if there is none.
char *scene_assimp_read_zae(struct scene_import *import, size_t *size);
/// Return true for a file that may be Collada, by the ending of its name.
bool scene_assimp_may_be_collada(const struct scene_import *import);
/// Return the text of a Collada file as assimp can read it, a 0 behind it. Return NULL if the file is none.
char *scene_assimp_collada(struct scene_import *import, size_t *size);
/// Return the text of a DXF as assimp can read it, a 0 behind it. Return NULL if the file is none.
char *scene_assimp_dxf(struct scene_import *import, size_t *size);
/// Return the bytes of an FBX with layers of materials where its geometries lack them, a 0 behind them. Return NULL if
/// none does, or if the file is none.
char *scene_assimp_fbx(struct scene_import *import, size_t *size);
/// Return the bytes of a 3DS as assimp can read it: without keys that would tear its meshes apart, with the smoothing
/// groups that its faces lack, and with a chunk in place of zeros. Return NULL if it is right as it is, or no 3DS.
char *scene_assimp_3ds(struct scene_import *import, size_t *size);
/// Return the text of an X3D as assimp can read it, a 0 behind it, which `unknowns` keeps. Return NULL if the file is
/// none.
char *scene_assimp_x3d(struct scene_import *import, struct scene_assimp_unknowns *unknowns, size_t *size);
/// Hide the proxies of an X3D. Return the text, which may be another one by then. A 0 follows it.
char *scene_assimp_hide_proxies(struct scene_import *import, char *text, size_t *size);
/// Add the node that assimp has refused an X3D for, by its error, and tell of it. Return false if it is for another
/// reason, or for too many nodes.
bool scene_assimp_leave_out(struct scene_import *import, const char *error,
                            struct scene_assimp_unknowns *unknowns);
/// Tell the user if models are drawn that an FBX hides, for good or for a while.
void scene_assimp_tell_hidden(struct scene_import *import);
/// Move the white space at the ends of a document's texts into its tags. A 0 follows the text.
void scene_assimp_collapse_texts(char *text, size_t size);
/// Make meshes of the convex meshes of a Collada document that have parts of their own. A 0 follows the text.
void scene_assimp_rename_convex(char *text, size_t size);
/// Name the texture coordinates of a Collada document's textures by the numbers that assimp has for their sets. A 0
/// follows the text.
void scene_assimp_number_sets(char *text, size_t size);
/// Leave out of the lists of indices of a Collada document what is none, with all that follow it, and warn. A 0 follows
/// the text.
void scene_assimp_check_indices(struct scene_import *import, char *text, size_t size);
/// Refuse a Collada document that lacks indices because one of them was none.
void scene_assimp_refuse_indices(struct scene_import *import);
/// Name the images of a Collada document that name no file. Return the text, which may be another one by then. A 0
/// follows it.
char *scene_assimp_name_images(char *text, size_t *size);
/// Write the skews and lookats of a Collada document as matrices. Return the text, which may be another one by then. A
/// 0 follows it.
char *scene_assimp_write_matrices(struct scene_import *import, char *text, size_t *size);
/// Write the images and samplers of a Collada document as assimp can read them. Return the text, which may be another
/// one by then. A 0 follows it.
char *scene_assimp_write_samplers(struct scene_import *import, char *text, size_t *size);
/// Write the parameters of the effects of a Collada document in their places. Return the text, which may be another one
/// by then. A 0 follows it.
char *scene_assimp_write_effects(struct scene_import *import, char *text, size_t *size);
/// Write the cameras of a Collada document as assimp can read them. Return the text, which may be another one by then.
/// A 0 follows it.
char *scene_assimp_write_cameras(struct scene_import *import, char *text, size_t *size);
/// Replace entities of a DXF that assimp does not know. Return the text, which is another one by then.
char *scene_assimp_flatten_dxf(struct scene_import *import, char *bytes, size_t *size);
/// Write what the insertions of a DXF draw in their places. Return the text, which may be another one by then.
char *scene_assimp_insert_blocks(struct scene_import *import, char *bytes, size_t *size);
/// Give the entities of a DXF their colours, as assimp counts them. Return the text, which may be another one by then.
char *scene_assimp_write_dxf_colors(struct scene_import *import, char *bytes, size_t *size);
/// Fail the import by its version if it is a Blender file that is too new for assimp. With `is_tried` fail it also for
/// the versions of which assimp reads some files.
void scene_assimp_refuse_blender(struct scene_import *import, bool is_tried);
/// Return why assimp may not read the file: its schema or version, if it is one of IFC or Collada that assimp does not
/// know. Return "" for other files.
const char *scene_assimp_schema(struct scene_import *import);

#endif
