// SPDX-License-Identifier: MIT
// Whether a scene of assimp's stands far from the origin, by the floats that assimp has of it. A file that does not is
// never rewritten.
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assimp.h"
#include "assimp_exact.h"
#include "import/builder/origin.h"

enum { SAMPLE = 4096, DEEPEST = 4096 }; // vertices that are looked at, and nodes below each other

struct survey {
    const struct scene_assimp_exact *exact;
    const struct aiScene *scene;
    float (*centers)[3], (*extents)[3]; // each mesh has one of both
    double (*points)[3];
    size_t count;
    uint64_t step, skipped;
    double longest_way; // no matrix brings the middle of its mesh further, its translation aside
    bool has_remote;    // an instance stands many of its sizes away
};

static void find_box(const struct aiMesh *mesh, float center[3], float extent[3])
{
    float low[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, high[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t v = 0; v < mesh->mNumVertices && mesh->mVertices != NULL; v++) {
        const float point[3] = {mesh->mVertices[v].x, mesh->mVertices[v].y, mesh->mVertices[v].z};
        for (int c = 0; c < 3; c++) {
            low[c] = fminf(low[c], point[c]);
            high[c] = fmaxf(high[c], point[c]);
        }
    }
    for (int c = 0; c < 3; c++) {
        center[c] = low[c] > high[c] ? 0 : low[c] / 2 + high[c] / 2;
        extent[c] = low[c] > high[c] ? 0 : high[c] - low[c];
    }
}

static double longest(const float extent[3])
{
    return (double)fmaxf(extent[0], fmaxf(extent[1], extent[2]));
}

// See whether a mesh stands so many of its own sizes from its own origin, or its instance from that of the world, that
// pictures of it alone would show the steps of floats.
static void look_at(struct survey *survey, unsigned mesh, const double world[16])
{
    const float *const center = survey->centers[mesh], *const extent = survey->extents[mesh];
    const double own_size = longest(extent);
    double distance = 0, own = 0, size = 0, place[3];
    scene_import_transform_floats(world, center, place);
    for (int row = 0; row < 3; row++) {
        double along = 0;
        for (int k = 0; k < 3; k++) {
            along += fabs(world[4 * k + row]) * (double)extent[k];
        }
        size = fmax(size, along);
        distance = fmax(distance, fabs(place[row]));
        own = fmax(own, fabs((double)center[row]));
        survey->longest_way = fmax(survey->longest_way, fabs(place[row] - world[12 + row]));
    }
    // So far away that floats make one point of all vertices, they have no size left.
    const bool has_size = own_size > 0 || survey->scene->mMeshes[mesh]->mNumVertices > 1;
    survey->has_remote =
        survey->has_remote || (has_size && (own > SCENE_REMOTE * own_size || distance > SCENE_REMOTE * size));
}

static void sample_mesh(struct survey *survey, const struct aiMesh *mesh, const double world[16])
{
    const uint32_t count = mesh->mVertices == NULL ? 0 : mesh->mNumVertices;
    for (uint64_t v = survey->skipped; v < count && survey->count < SAMPLE; v += survey->step) {
        const float point[3] = {mesh->mVertices[v].x, mesh->mVertices[v].y, mesh->mVertices[v].z};
        scene_import_transform_floats(world, point, survey->points[survey->count++]);
    }
    const uint64_t left = count > survey->skipped ? count - survey->skipped : 0;
    survey->skipped =
        left > 0 ? (survey->step - left % survey->step) % survey->step : survey->skipped - count;
}

static uint64_t count_vertices(const struct aiScene *scene, const struct aiNode *node, unsigned depth)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < node->mNumMeshes; i++) {
        count += node->mMeshes[i] < scene->mNumMeshes ? scene->mMeshes[node->mMeshes[i]]->mNumVertices : 0;
    }
    for (uint32_t i = 0; i < node->mNumChildren && depth < DEEPEST; i++) {
        count += node->mChildren[i] != NULL ? count_vertices(scene, node->mChildren[i], depth + 1) : 0;
    }
    return count;
}

static void visit(struct survey *survey, const struct aiNode *node, const double parent[16], unsigned depth)
{
    const struct aiScene *const scene = survey->scene;
    double world[16];
    scene_assimp_float_place(survey->exact, node, world);
    scene_import_multiply_exact(parent, world, world);
    for (uint32_t i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] < scene->mNumMeshes) {
            look_at(survey, node->mMeshes[i], world);
            sample_mesh(survey, scene->mMeshes[node->mMeshes[i]], world);
        }
    }
    for (uint32_t i = 0; i < node->mNumChildren && depth < DEEPEST; i++) {
        if (node->mChildren[i] != NULL) {
            visit(survey, node->mChildren[i], world, depth + 1);
        }
    }
}

bool scene_assimp_is_far(struct scene_import *import, struct scene_assimp_exact *exact,
                         const struct aiScene *scene)
{
    if (scene->mRootNode == NULL) {
        return false;
    }
    struct survey survey = {
        .exact = exact,
        .scene = scene,
        .centers = scene_import_allocate(import, scene->mNumMeshes, sizeof *survey.centers),
        .extents = scene_import_allocate(import, scene->mNumMeshes, sizeof *survey.extents),
        .points = scene_import_allocate(import, SAMPLE, sizeof *survey.points),
        .step = count_vertices(scene, scene->mRootNode, 0) / SAMPLE + 1,
    };
    const struct scene_import_place identity = scene_import_place_identity();
    for (uint32_t i = 0; i < scene->mNumMeshes; i++) {
        find_box(scene->mMeshes[i], survey.centers[i], survey.extents[i]);
    }
    visit(&survey, scene->mRootNode, identity.exact, 0);
    const struct scene_import_spread spread =
        scene_import_spread_find(import, (const double(*)[3])survey.points, survey.count);
    free(survey.centers);
    free(survey.extents);
    free(survey.points);
    exact->model_size = exact->bytes == NULL ? spread.size : exact->model_size;
    // Without the translations that have marks, all of a model may seem to be in one place.
    const double size = fmax(spread.size, exact->model_size);
    return survey.has_remote ||
           (size > 0 && fmax(spread.distance, survey.longest_way) > SCENE_IMPORT_FAR * size);
}
