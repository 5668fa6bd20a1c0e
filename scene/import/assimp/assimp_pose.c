// SPDX-License-Identifier: MIT
// Animations as assimp gives them: nodes get the matrices of a moment, and meshes with bones follow. Keys are joined by
// straight lines and arcs, whatever curves the file had.
#include <stdlib.h>
#include <string.h>

#include "assimp.h"
#include "import/builder/normals.h"
#include "import/builder/numbers.h"
#include "import/builder/origin.h"
#include "import/builder/pose.h"

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

static void sample_vectors(const struct aiVectorKey *keys, unsigned count, double time, float value[3])
{
    if (count == 0) {
        return;
    }
    double part;
    const unsigned key = find_key(keys, sizeof *keys, count, time, &part);
    const struct aiVector3D *const a = &keys[key].mValue, *const b = part > 0.0 ? &keys[key + 1].mValue : a;
    const float from[3] = {a->x, a->y, a->z}, to[3] = {b->x, b->y, b->z};
    for (int c = 0; c < 3; c++) {
        value[c] = (float)((double)from[c] + ((double)to[c] - (double)from[c]) * part);
    }
}

static void sample_turns(const struct aiQuatKey *keys, unsigned count, double time, float value[4])
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

static void move_nodes(struct scene_import *import, const struct aiScene *scene,
                       const struct aiAnimation *animation)
{
    const double time = import->time * rate_of(animation);
    for (unsigned i = 0; i < animation->mNumChannels; i++) {
        const struct aiNodeAnim *const channel = animation->mChannels[i];
        struct aiNode *const node = find_node(scene->mRootNode, channel->mNodeName.data);
        if (node == NULL) {
            continue;
        }
        float place[3] = {0, 0, 0}, turn[4] = {0, 0, 0, 1}, size[3] = {1, 1, 1}, matrix[16];
        sample_vectors(channel->mPositionKeys, channel->mNumPositionKeys, time, place);
        sample_turns(channel->mRotationKeys, channel->mNumRotationKeys, time, turn);
        sample_vectors(channel->mScalingKeys, channel->mNumScalingKeys, time, size);
        scene_import_compose(place, turn, size, matrix);
        set_matrix(&node->mTransformation, matrix);
    }
    if (animation->mNumMeshChannels > 0 || animation->mNumMorphMeshChannels > 0) {
        scene_import_unsupported(import, "animations of meshes and morph targets: left as at rest");
    }
}

void scene_assimp_pose(struct scene_import *import, const struct aiScene *scene)
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
    move_nodes(import, scene, scene->mAnimations[index]);
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

// The matrices that bring the vertices of a skinned mesh into the world, and the sums of their weights.
struct blend {
    float (*matrices)[16];
    float *weights;
};

// A mesh that follows bones.
struct skin {
    struct scene_import *import;
    const struct scene_assimp_exact *exact;
    const struct aiScene *scene;
    const struct aiMesh *source;
    const struct aiNode *holder;
};

// Return a place from which the offset of the mesh is taken.
static struct scene_import_place add_offset(const struct skin *skin, struct scene_import_place place)
{
    const double *const offset = scene_assimp_exact_offset(skin->exact, skin->source), *const m = place.exact;
    for (int row = 0; row < 3 && scene_origin_is_far(offset); row++) {
        place.exact[12 + row] += m[row] * offset[0] + m[4 + row] * offset[1] + m[8 + row] * offset[2];
        place.world[12 + row] = (float)place.exact[12 + row];
    }
    return place;
}

// Adds a bone's share to the matrices of the vertices that it moves.
static void add_bone(const struct skin *skin, const struct aiBone *bone, const double origin[3],
                     const struct blend *blend)
{
    const struct aiNode *const found = find_node(skin->scene->mRootNode, bone->mName.data);
    const struct scene_import_place node = node_world(skin->exact, found);
    float matrix[16];
    scene_assimp_matrix(&bone->mOffsetMatrix, matrix);
    const struct scene_import_place bind = add_offset(skin, scene_import_place_of(matrix));
    const struct scene_import_place place = scene_import_place_multiply(&node, &bind);
    float joint[16];
    scene_import_place_from(&place, origin, joint);
    for (unsigned i = 0; i < bone->mNumWeights; i++) {
        const struct aiVertexWeight *const weight = &bone->mWeights[i];
        if (weight->mVertexId >= skin->source->mNumVertices) {
            scene_import_fail(skin->import, "a bone moves vertex %u of %u", weight->mVertexId,
                              skin->source->mNumVertices);
        }
        blend->weights[weight->mVertexId] += weight->mWeight;
        for (int m = 0; m < 16; m++) {
            blend->matrices[weight->mVertexId][m] += weight->mWeight * joint[m];
        }
    }
}

// Blends the matrices of a mesh, counted from `origin`. A vertex without bones gets that of the node.
static struct blend blend_bones(const struct skin *skin, const double origin[3])
{
    const uint32_t vertex_count = skin->source->mNumVertices;
    const struct blend blend = {scene_import_allocate(skin->import, vertex_count, sizeof *blend.matrices),
                                scene_import_allocate(skin->import, vertex_count, sizeof *blend.weights)};
    const struct scene_import_place holder = add_offset(skin, node_world(skin->exact, skin->holder));
    for (unsigned i = 0; i < skin->source->mNumBones; i++) {
        add_bone(skin, skin->source->mBones[i], origin, &blend);
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        if (!(blend.weights[v] > 0)) {
            scene_import_place_from(&holder, origin, blend.matrices[v]);
        }
    }
    return blend;
}

void scene_assimp_skin(struct scene_import *import, const struct scene_assimp_exact *exact,
                       const struct aiScene *scene, unsigned index, struct scene_mesh *mesh, double origin[3])
{
    const struct skin skin = {import, exact, scene, scene->mMeshes[index],
                              scene_assimp_holder(scene->mRootNode, index)};
    struct blend blend = blend_bones(&skin, origin);
    scene_import_skin_origin(import, mesh, (const float(*)[16])blend.matrices, origin);
    if (scene_origin_is_far(origin)) {
        free(blend.matrices);
        free(blend.weights);
        blend = blend_bones(&skin, origin);
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        const float *const matrix = blend.matrices[v];
        const float share = blend.weights[v] > 0 ? 1 / blend.weights[v] : 1; // exporters round
        float point[3];
        scene_import_transform(matrix, mesh->positions[v], point);
        for (int c = 0; c < 3; c++) {
            mesh->positions[v][c] = point[c] * share;
        }
        if (mesh->normals != NULL) {
            scene_import_move_normal(matrix, mesh->normals[v]);
        }
    }
    free(blend.matrices);
    free(blend.weights);
}
