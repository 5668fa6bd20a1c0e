// SPDX-License-Identifier: MIT
// Replaces faces in a scene of assimp. Its arrays are made and freed by new and delete, which C has not.
#include "cut_faces.h"

#include <new>

#include <assimp/scene.h>

namespace {

enum { MOST_OF_ASSIMP = 4 }; // corners of a face that is left to assimp

// Count the faces that a mesh has when it is cut. Set `most` to the corners of the largest face.
size_t count_faces(const aiMesh &mesh, unsigned &most)
{
    size_t count = 0;
    most = 0;
    for (unsigned i = 0; i < mesh.mNumFaces; i++) {
        const unsigned corners = mesh.mFaces[i].mNumIndices;
        count += corners > MOST_OF_ASSIMP ? corners - 2 : 1;
        most = corners > most ? corners : most;
    }
    return count;
}

bool has_all_vertices(const aiMesh &mesh, const aiFace &face)
{
    bool has = mesh.mVertices != nullptr;
    for (unsigned i = 0; i < face.mNumIndices && has; i++) {
        has = face.mIndices[i] < mesh.mNumVertices;
    }
    return has;
}

void set_triangle(aiFace &face, const aiFace &polygon, const uint32_t places[3])
{
    face.mIndices = new unsigned[3];
    face.mNumIndices = 3;
    for (unsigned k = 0; k < 3; k++) {
        face.mIndices[k] = polygon.mIndices[places[k]];
    }
}

void cut_mesh(aiMesh &mesh, scene_cutter *cut, void *user)
{
    unsigned most;
    const size_t count = count_faces(mesh, most);
    if (most <= MOST_OF_ASSIMP || count > UINT32_MAX / 3) {
        return;
    }
    aiFace *const faces = new aiFace[count];
    uint32_t *const triangles = new uint32_t[3 * static_cast<size_t>(most)];
    size_t next = 0;
    bool has_polygons = false;
    for (unsigned i = 0; i < mesh.mNumFaces; i++) {
        aiFace &face = mesh.mFaces[i];
        if (face.mNumIndices <= MOST_OF_ASSIMP || !has_all_vertices(mesh, face)) {
            has_polygons = has_polygons || face.mNumIndices > 3;
            faces[next].mNumIndices = face.mNumIndices;
            faces[next++].mIndices = face.mIndices;
            face.mIndices = nullptr;
            continue;
        }
        cut(user, reinterpret_cast<const float(*)[3]>(mesh.mVertices), face.mIndices, face.mNumIndices,
            triangles);
        for (unsigned k = 0; k + 2 < face.mNumIndices; k++) {
            set_triangle(faces[next++], face, triangles + 3 * static_cast<size_t>(k));
        }
    }
    delete[] triangles;
    delete[] mesh.mFaces;
    mesh.mFaces = faces;
    mesh.mNumFaces = static_cast<unsigned>(next);
    mesh.mPrimitiveTypes |= aiPrimitiveType_TRIANGLE;
    if (!has_polygons) {
        mesh.mPrimitiveTypes &= ~static_cast<unsigned>(aiPrimitiveType_POLYGON);
    }
}

} // namespace

bool scene_assimp_cut_faces(const aiScene *scene, scene_cutter *cut, void *user)
{
    try {
        for (unsigned i = 0; i < scene->mNumMeshes; i++) {
            cut_mesh(*scene->mMeshes[i], cut, user);
        }
    } catch (const std::bad_alloc &) {
        return false;
    }
    return true;
}
