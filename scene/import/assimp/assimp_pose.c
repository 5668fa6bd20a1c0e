// SPDX-License-Identifier: MIT
// Animations as assimp gives them: nodes get the matrices of a moment, and meshes with bones follow. Keys are joined by
// straight lines and arcs, whatever curves the file had.
#include <stdlib.h>
#include <string.h>

#include "assimp.h"
#include "import/builder/pose.h"
#include "import/builder/skin.h"

void scene_assimp_matrix(const struct aiMatrix4x4 *m, float matrix[16])
{
    const float columns[16] = {m->a1, m->b1, m->c1, m->d1, m->a2, m->b2, m->c2, m->d2,
                               m->a3, m->b3, m->c3, m->d3, m->a4, m->b4, m->c4, m->d4};
    memcpy(matrix, columns, sizeof columns);
}

static const double usual_rate = 25.0; // ticks a second where a file does not say

static double rate_of(const struct aiAnimation *animation)
{
    return animation->mTicksPerSecond > 0.0 ? animation->mTicksPerSecond : usual_rate;
}

static void list_animations(struct scene_import *import, const struct aiScene *scene)
{
    struct scene_model *const model = &import->model;
    model->animations = scene_import_allocate(import, scene->mNumAnimations, sizeof *model->animations);
    model->animation_count = scene->mNumAnimations;
    for (unsigned i = 0; i < scene->mNumAnimations; i++) {
        const struct aiAnimation *const animation = scene->mAnimations[i];
        const double seconds = animation->mDuration / rate_of(animation);
        model->animations[i] =
            (struct scene_model_animation){.name = scene_assimp_string(import, &animation->mName),
                                           .seconds = seconds > 0.0 && seconds < 1e9 ? (float)seconds : 0.0f,
                                           .channel_count = animation->mNumChannels};
    }
}

// The key at or before a time, and how far the next one is away: 0 at the key, and before the first and after the last.
static unsigned find_key(const void *keys, size_t size, unsigned count, double time, double *part)
{
    const char *const bytes = keys;
    double now, next;
    unsigned key = 0;
    *part = 0.0;
    while (key + 1 < count && (memcpy(&next, bytes + (key + 1) * size, sizeof next), next <= time)) {
        key++;
    }
    memcpy(&now, bytes + key * size, sizeof now); // a key begins with its time
    if (key + 1 < count && time > now) {
        memcpy(&next, bytes + (key + 1) * size, sizeof next);
        *part = (time - now) / (next - now);
    }
    return key;
}

static void sample_vectors(const struct aiVectorKey *keys, unsigned count, double time, double value[3])
{
    if (count == 0) {
        return;
    }
    double part;
    const unsigned key = find_key(keys, sizeof *keys, count, time, &part);
    const struct aiVector3D *const a = &keys[key].mValue, *const b = part > 0.0 ? &keys[key + 1].mValue : a;
    const float from[3] = {a->x, a->y, a->z}, to[3] = {b->x, b->y, b->z};
    for (int c = 0; c < 3; c++) {
        value[c] = (double)from[c] + ((double)to[c] - (double)from[c]) * part;
    }
}

static void sample_turns(const struct aiQuatKey *keys, unsigned count, double time, double value[4])
{
    if (count == 0) {
        return;
    }
    double part;
    const unsigned key = find_key(keys, sizeof *keys, count, time, &part);
    const struct aiQuaternion *const a = &keys[key].mValue, *const b = part > 0.0 ? &keys[key + 1].mValue : a;
    const float from[4] = {a->x, a->y, a->z, a->w}, to[4] = {b->x, b->y, b->z, b->w};
    scene_import_slerp(from, to, part, value);
}

static struct aiNode *find_node(struct aiNode *node, const char *name)
{
    struct aiNode *found = strcmp(node->mName.data, name) == 0 ? node : NULL;
    for (unsigned i = 0; i < node->mNumChildren && found == NULL; i++) {
        found = node->mChildren[i] != NULL ? find_node(node->mChildren[i], name) : NULL;
    }
    return found;
}

static void set_matrix(struct aiMatrix4x4 *to, const float m[16])
{
    const struct aiMatrix4x4 matrix = {m[0], m[4], m[8],  m[12], m[1], m[5], m[9],  m[13],
                                       m[2], m[6], m[10], m[14], m[3], m[7], m[11], m[15]};
    *to = matrix;
}

static void move_nodes(struct scene_import *import, struct scene_assimp_exact *exact,
                       const struct aiScene *scene, const struct aiAnimation *animation)
{
    const double time = import->time * rate_of(animation);
    for (unsigned i = 0; i < animation->mNumChannels; i++) {
        const struct aiNodeAnim *const channel = animation->mChannels[i];
        struct aiNode *const node = find_node(scene->mRootNode, channel->mNodeName.data);
        scene_assimp_keep_moved(import, exact, channel->mNodeName.data);
        if (node == NULL) {
            continue;
        }
        double way[3] = {0, 0, 0}, turn[4] = {0, 0, 0, 1}, size[3] = {1, 1, 1};
        sample_vectors(channel->mPositionKeys, channel->mNumPositionKeys, time, way);
        sample_turns(channel->mRotationKeys, channel->mNumRotationKeys, time, turn);
        sample_vectors(channel->mScalingKeys, channel->mNumScalingKeys, time, size);
        scene_assimp_unmark_way(exact, node, way);
        struct scene_import_place place = scene_import_compose(way, turn, size);
        double mark[3];
        scene_assimp_mark_matrix(import, exact, SCENE_ASSIMP_MATRIX, place.exact, mark);
        for (int c = 0; c < 3; c++) {
            place.world[12 + c] = (float)mark[c];
        }
        set_matrix(&node->mTransformation, place.world);
    }
    if (animation->mNumMeshChannels > 0 || animation->mNumMorphMeshChannels > 0) {
        scene_import_unsupported(import, "animations of meshes and morph targets: left as at rest");
    }
}

void scene_assimp_pose(struct scene_import *import, struct scene_assimp_exact *exact,
                       const struct aiScene *scene)
{
    list_animations(import, scene);
    if (scene->mNumAnimations == 0) {
        return;
    }
    if (!import->is_posed) {
        scene_import_unsupported(import, "%u animation%s: drawn at rest", scene->mNumAnimations,
                                 scene->mNumAnimations == 1 ? "" : "s");
        return;
    }
    const int64_t index = scene_import_find_animation(import);
    if (index < 0) {
        scene_import_fail(import, "has no animation '%s'; rhw info lists those that it has",
                          import->animation);
    }
    move_nodes(import, exact, scene, scene->mAnimations[index]);
}

// Skins ---------------------------------------------------------------------------------------------

static struct scene_import_place node_world(const struct scene_assimp_exact *exact, const struct aiNode *node)
{
    struct scene_import_place world = scene_import_place_identity();
    for (; node != NULL; node = node->mParent) {
        const struct scene_import_place local = scene_assimp_exact_place(exact, node);
        world = scene_import_place_multiply(&local, &world);
    }
    return world;
}

const struct aiNode *scene_assimp_holder(const struct aiNode *node, unsigned mesh)
{
    const struct aiNode *found = NULL;
    for (unsigned i = 0; i < node->mNumMeshes && found == NULL; i++) {
        found = node->mMeshes[i] == mesh ? node : NULL;
    }
    for (unsigned i = 0; i < node->mNumChildren && found == NULL; i++) {
        found = node->mChildren[i] != NULL ? scene_assimp_holder(node->mChildren[i], mesh) : NULL;
    }
    return found;
}

bool scene_assimp_is_skinned(const struct scene_import *import, const struct aiMesh *mesh)
{
    return import->is_posed && mesh->mNumBones > 0;
}

// A mesh that follows bones.
struct bones {
    struct scene_import *import;
    const struct scene_assimp_exact *exact;
    const struct aiScene *scene;
    const struct aiMesh *source;
};

// Return where a node has what is counted from the offset of the mesh.
static struct scene_import_place add_offset(const struct bones *bones, struct scene_import_place place)
{
    const double *const offset = scene_assimp_exact_offset(bones->exact, bones->source);
    if (scene_origin_is_far(offset)) {
        scene_import_add_offset(place.exact, offset);
    }
    for (int c = 0; c < 3 && scene_origin_is_far(offset); c++) {
        place.world[12 + c] = (float)place.exact[12 + c];
    }
    return place;
}

// Return where a bone brings the vertices of the mesh.
static struct scene_import_place bone_place(const struct bones *bones, const struct aiBone *bone)
{
    const struct aiNode *const found = find_node(bones->scene->mRootNode, bone->mName.data);
    const struct scene_import_place node = node_world(bones->exact, found);
    const struct scene_import_place bind = add_offset(bones, scene_assimp_exact_bone(bones->exact, bone));
    return scene_import_place_multiply(&node, &bind);
}

static void add_bone(const struct bones *bones, const struct aiBone *bone,
                     const struct scene_import_place *place, struct scene_import_skin *skin)
{
    for (unsigned i = 0; i < bone->mNumWeights; i++) {
        const struct aiVertexWeight *const weight = &bone->mWeights[i];
        if (weight->mVertexId >= bones->source->mNumVertices) {
            scene_import_fail(bones->import, "a bone moves vertex %u of %u", weight->mVertexId,
                              bones->source->mNumVertices);
        }
        if (weight->mWeight > 0) {
            scene_import_skin_add(skin, weight->mVertexId, place, weight->mWeight);
        }
    }
}

void scene_assimp_skin(struct scene_import *import, const struct scene_assimp_exact *exact,
                       const struct aiScene *scene, unsigned index, struct scene_mesh *mesh, double origin[3])
{
    const struct bones bones = {import, exact, scene, scene->mMeshes[index]};
    const unsigned count = bones.source->mNumBones;
    struct scene_import_place *const places = scene_import_allocate(import, count + 1, sizeof *places);
    for (unsigned i = 0; i < count; i++) {
        places[i] = bone_place(&bones, bones.source->mBones[i]);
    }
    places[count] = add_offset(&bones, node_world(exact, scene_assimp_holder(scene->mRootNode, index)));
    struct scene_import_skin skin = scene_import_skin_open(import, mesh, places, count + 1);
    for (unsigned i = 0; i < count; i++) {
        add_bone(&bones, bones.source->mBones[i], &places[i], &skin);
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        if (!(skin.weights[v] > 0)) { // a vertex without bones follows the node
            scene_import_skin_add(&skin, v, &places[count], 1);
        }
    }
    scene_import_skin_close(&skin, true, origin);
    free(places);
}
