// SPDX-License-Identifier: MIT
// Every format that has no reader of its own here, through assimp's C API: meshes, nodes and the order of a read.
//
// Of assimp's post-processing only what nothing else can do is used: polygons of four corners are cut into triangles
// and primitive kinds separated. Normals, tangents and joined vertices are made by complete_mesh.c: its passes are
// a few times faster on large scans and keep creases.
#include "assimp.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "blender_shading.h"
#include "cut_faces.h"
#include "import/builder/complete_mesh.h"
#include "import/builder/normals.h"
#include "import/builder/numbers.h"
#include "import/builder/polygon.h"
#include "import/builder/readers.h"
#include "memory_limit.h"
#include "x3d_faces.h"

_Static_assert(sizeof(ai_real) == sizeof(float), "assimp is built with single precision");

struct reader {
    struct scene_import *import;
    struct scene_assimp_exact *exact;
    const struct aiScene *scene;
    uint32_t *meshes; // model mesh by assimp mesh
    int32_t (
        *materials)[2]; // model material by assimp material, without and with vertex colours; −1: not made
    uint32_t objects;
    uint32_t depth;
    uint8_t *shadings; // how the meshes of a Blender file are shaded
};

// Meshes --------------------------------------------------------------------------------------------

// Return the colours of a mesh's vertices. Return NULL if there are none: assimp gives all meshes of an AMF some, and
// some of Blender's, of which nothing is set where the file has no colours.
static const struct aiColor4D *colors_of(const struct scene_import *import, const struct aiMesh *mesh)
{
    const struct aiColor4D *const colors = mesh->mColors[0];
    if (strcasecmp(import->ending, "amf") != 0 && strcasecmp(import->ending, "blend") != 0) {
        return colors;
    }
    for (unsigned i = 0; colors != NULL && i < mesh->mNumVertices; i++) {
        const struct aiColor4D *const c = &colors[i];
        if (!(c->r == 0 && c->g == 0 && c->b == 0 && c->a == 0)) {
            return colors;
        }
    }
    return NULL;
}

// Bring the colours of a mesh of Blender before 2.63 to what others have. assimp takes their bytes for numbers with a
// sign. Red and blue stand in each other's place, and nothing is meant by alpha.
static void mend_colors(const struct scene_import *import, const struct aiMesh *mesh)
{
    struct aiColor4D *const colors = mesh->mColors[0];
    bool are_bytes = false;
    if (strcasecmp(import->ending, "blend") != 0 || colors == NULL) {
        return;
    }
    for (unsigned i = 0; i < mesh->mNumVertices && !are_bytes; i++) {
        const float values[4] = {colors[i].r, colors[i].g, colors[i].b, colors[i].a};
        for (int c = 0; c < 4; c++) {
            are_bytes = are_bytes || values[c] < 0 || values[c] > 1;
        }
    }
    for (unsigned i = 0; i < mesh->mNumVertices && are_bytes; i++) {
        const float values[3] = {colors[i].b, colors[i].g, colors[i].r};
        float mended[3];
        for (int c = 0; c < 3; c++) {
            const bool is_byte = values[c] >= -128 && values[c] <= 127;
            mended[c] = is_byte ? (float)((int)values[c] & 255) / 255 : 1;
        }
        colors[i] = (struct aiColor4D){mended[0], mended[1], mended[2], 1};
    }
}

static uint32_t material_of(struct reader *reader, const struct aiMesh *mesh)
{
    const bool colored = colors_of(reader->import, mesh) != NULL;
    if (mesh->mMaterialIndex >= reader->scene->mNumMaterials) {
        scene_import_fail(reader->import, "a mesh refers to a material that does not exist");
    }
    int32_t *made = &reader->materials[mesh->mMaterialIndex][colored];
    if (*made < 0) {
        *made = (int32_t)scene_assimp_material(reader->import, reader->scene,
                                               reader->scene->mMaterials[mesh->mMaterialIndex], colored);
    }
    return (uint32_t)*made;
}

static void *copy_vectors(struct scene_import *import, const struct aiVector3D *vectors, uint32_t count)
{
    if (vectors == NULL) {
        return NULL;
    }
    float(*copy)[3] = scene_import_allocate(import, count, sizeof *copy);
    memcpy(copy, vectors, count * sizeof *copy);
    return copy;
}

// v turned from assimp's upward to our downward direction.
static void *copy_uvs(struct scene_import *import, const struct aiVector3D *vectors, uint32_t count)
{
    if (vectors == NULL) {
        return NULL;
    }
    float(*copy)[2] = scene_import_allocate(import, count, sizeof *copy);
    for (uint32_t i = 0; i < count; i++) {
        copy[i][0] = vectors[i].x;
        copy[i][1] = 1 - vectors[i].y;
    }
    return copy;
}

// These formats store colours as they look, encoded with the sRGB transfer function. Most come from bytes,
// for which a table is exact.
static void *copy_colors(struct scene_import *import, const struct aiColor4D *colors, uint32_t count)
{
    if (colors == NULL) {
        return NULL;
    }
    float table[256];
    for (int i = 0; i < 256; i++) {
        table[i] = scene_import_from_srgb((float)i / 255);
    }
    float(*copy)[4] = scene_import_allocate(import, count, sizeof *copy);
    for (uint32_t i = 0; i < count; i++) {
        const float encoded[3] = {colors[i].r, colors[i].g, colors[i].b};
        for (int c = 0; c < 3; c++) {
            const bool in_range = encoded[c] >= 0 && encoded[c] <= 1;
            const int byte = in_range ? (int)(encoded[c] * 255 + 0.5f) : 0;
            const float error = encoded[c] - (float)byte / 255;
            const bool from_byte = in_range && error < 1e-6f && error > -1e-6f;
            copy[i][c] = from_byte ? table[byte] : scene_import_from_srgb(encoded[c]);
        }
        copy[i][3] = colors[i].a;
    }
    return copy;
}

// Tell of texture coordinates with a third number, as those of volumes and projections are. Exporters write one of 0.
static void tell_of_third(struct scene_import *import, const struct aiMesh *mesh)
{
    bool is_used = false;
    for (int set = 0; set < SCENE_UV_SETS && mesh->mTextureCoords[set] != NULL; set++) {
        const uint32_t count = mesh->mNumUVComponents[set] == 3 ? mesh->mNumVertices : 0;
        for (uint32_t i = 0; i < count && !is_used; i++) {
            is_used = mesh->mTextureCoords[set][i].z < 0 || mesh->mTextureCoords[set][i].z > 0;
        }
    }
    if (is_used) {
        scene_import_unsupported(import, "texture coordinates of three numbers: the third is not used");
    }
}

static void copy_indices(struct reader *reader, const struct aiMesh *source, struct scene_mesh *mesh)
{
    const uint32_t corners = scene_mesh_corners(mesh);
    if (source->mNumFaces > UINT32_MAX / 3) {
        scene_import_fail(reader->import, "has too many faces");
    }
    mesh->indices =
        scene_import_allocate(reader->import, (size_t)source->mNumFaces * corners, sizeof *mesh->indices);
    for (uint32_t i = 0; i < source->mNumFaces; i++) {
        const struct aiFace *face = &source->mFaces[i];
        if (face->mNumIndices != corners) {
            if (face->mNumIndices > 0) {
                scene_import_unsupported(reader->import, "faces of %u corners among those of %u: left out",
                                         face->mNumIndices, corners);
            }
            continue;
        }
        for (uint32_t k = 0; k < corners; k++) {
            if (face->mIndices[k] >= source->mNumVertices) {
                scene_import_fail(reader->import, "a face refers to vertex %u of %u", face->mIndices[k],
                                  source->mNumVertices);
            }
            mesh->indices[mesh->index_count++] = face->mIndices[k];
        }
    }
}

// Vertices without faces are a cloud of points.
static void make_points(struct reader *reader, struct scene_mesh *mesh)
{
    mesh->primitive = SCENE_PRIMITIVE_POINTS;
    mesh->index_count = mesh->vertex_count;
    mesh->indices = scene_import_allocate(reader->import, mesh->vertex_count, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        mesh->indices[i] = i;
    }
}

// An alpha that is 0 everywhere means a format without alpha, not an invisible mesh.
static void fix_alpha(struct scene_import *import, struct scene_mesh *mesh)
{
    bool visible = false, translucent = false;
    for (uint32_t i = 0; mesh->colors != NULL && i < mesh->vertex_count; i++) {
        visible = visible || mesh->colors[i][3] > 0;
        translucent = translucent || mesh->colors[i][3] < 1;
    }
    // Some programs keep weights there, so that nothing says that it is meant to be seen through. assimp itself gives
    // some colours of DXF an alpha.
    if (visible && translucent && strcasecmp(import->ending, "dxf") != 0) {
        scene_import_unsupported(import, "alpha of vertex colours: not used");
    }
    for (uint32_t i = 0; mesh->colors != NULL && i < mesh->vertex_count && !visible; i++) {
        mesh->colors[i][3] = 1;
    }
}

// Set how the meshes at a node and below it are shaded, where the file says so. Nodes of Blender have objects' names.
static void set_shadings(struct reader *reader, const struct scene_blender_shadings *shadings,
                         const struct aiNode *node, uint32_t depth)
{
    enum { DEEPEST = 1000 };
    const enum scene_blender_shading shading = scene_blender_shading(shadings, node->mName.data);
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] < reader->scene->mNumMeshes) {
            reader->shadings[node->mMeshes[i]] = (uint8_t)shading;
        }
    }
    for (unsigned i = 0; i < node->mNumChildren && depth < DEEPEST; i++) {
        if (node->mChildren[i] != NULL) {
            set_shadings(reader, shadings, node->mChildren[i], depth + 1);
        }
    }
}

// How a mesh is shaded.
struct shading {
    bool has_normals;               // its own are used
    enum scene_import_normals made; // what is used where it has none, or not these
    bool has_creases;
    double crease_cosine;
    bool is_repeated;    // vertices may be the same
    bool has_own_points; // vertices at one place are apart
};

static struct shading shading_of(const struct reader *reader, uint32_t index)
{
    enum scene_x3d_normals normals;
    double cosine;
    if (strcasecmp(reader->import->ending, "x3d") == 0 &&
        scene_x3d_normals_of(reader->scene->mMeshes[index], &normals, &cosine)) {
        const bool is_shared = normals == SCENE_X3D_SHARED,
                   is_creased = normals == SCENE_X3D_CREASED || is_shared;
        return (struct shading){.has_normals = normals == SCENE_X3D_GIVEN,
                                .made = is_creased && cosine >= 1 ? SCENE_IMPORT_FLAT : SCENE_IMPORT_SMOOTH,
                                .has_creases = is_creased,
                                .crease_cosine = cosine,
                                .is_repeated = !is_shared,
                                .has_own_points = is_shared};
    }
    const enum scene_blender_shading shading = reader->shadings[index];
    return (struct shading){.has_normals = shading == SCENE_BLENDER_SMOOTH,
                            .made = shading == SCENE_BLENDER_FLAT ? SCENE_IMPORT_FLAT : SCENE_IMPORT_SMOOTH,
                            .is_repeated = shading != SCENE_BLENDER_SMOOTH};
}

static void add_mesh(struct reader *reader, uint32_t index)
{
    const struct aiMesh *source = reader->scene->mMeshes[index];
    struct scene_import *import = reader->import;
    const uint32_t count = source->mNumVertices;
    struct scene_mesh mesh = {.name = scene_assimp_exact_name(import, reader->exact, reader->scene, index),
                              .vertex_count = count};
    const unsigned kinds = source->mPrimitiveTypes;
    mesh.primitive = kinds & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON) ? SCENE_PRIMITIVE_TRIANGLES
                     : kinds & aiPrimitiveType_LINE                               ? SCENE_PRIMITIVE_LINES
                                                                                  : SCENE_PRIMITIVE_POINTS;
    mesh.material = material_of(reader, source);
    if (source->mVertices == NULL) {
        mesh.vertex_count = 0;
    }
    mesh.positions = copy_vectors(import, source->mVertices, count);
    const struct shading shading = shading_of(reader, index);
    mesh.normals = shading.has_normals ? copy_vectors(import, source->mNormals, count) : NULL;
    mesh.uvs[0] = copy_uvs(import, source->mTextureCoords[0], count);
    mesh.uvs[1] = copy_uvs(import, source->mTextureCoords[1], count);
    mend_colors(import, source);
    mesh.colors = copy_colors(import, colors_of(import, source), count);
    fix_alpha(import, &mesh);
    tell_of_third(import, source);
    if (source->mColors[1] != NULL) {
        scene_import_unsupported(import, "vertex colours beyond the first set: ignored");
    }
    copy_indices(reader, source, &mesh);
    if (mesh.index_count == 0) {
        make_points(reader, &mesh);
    }
    double origin[3] = {0, 0, 0};
    if (scene_assimp_is_skinned(import, source)) {
        scene_assimp_skin(import, reader->exact, reader->scene, index, &mesh, origin);
    } else {
        memcpy(origin, scene_assimp_exact_offset(reader->exact, source), sizeof origin);
    }
    if (source->mNumBones > 0 && !import->is_posed) {
        scene_import_unsupported(import, "skins: drawn in the pose the meshes are stored in");
    }
    if (source->mNumAnimMeshes > 0) {
        scene_import_unsupported(import, "morph targets: drawn at rest");
    }
    *scene_import_add_mesh(import) = mesh;
    scene_import_place_mesh(import, origin);
    reader->meshes[index] = import->model.mesh_count - 1;
    // Formats that list every corner of every face hold each vertex several times.
    const bool repeated =
        !shading.has_own_points && ((mesh.index_count == count && count > 3) || shading.is_repeated);
    import->has_creases = shading.has_creases;
    import->has_own_points = shading.has_own_points;
    import->crease_cosine = shading.crease_cosine;
    scene_import_complete_mesh(import, reader->meshes[index], shading.made, repeated);
    import->has_creases = import->has_own_points = false;
}

// Nodes ---------------------------------------------------------------------------------------------

static void add_node(struct reader *reader, const struct aiNode *node,
                     const struct scene_import_place *parent)
{
    enum { DEEPEST = 4096 };
    struct scene_import *import = reader->import;
    const struct scene_import_place identity = scene_import_place_identity();
    const struct scene_import_place local = scene_assimp_exact_place(reader->exact, node);
    const struct scene_import_place world = scene_import_place_multiply(parent, &local);
    if (++reader->depth > DEEPEST) {
        scene_import_fail(import, "its nodes are nested too deeply");
    }
    if (node->mNumMeshes > 0) {
        reader->objects++;
    }
    for (uint32_t i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] >= reader->scene->mNumMeshes) {
            scene_import_fail(import, "a node refers to a mesh that does not exist");
        }
        struct scene_instance *instance = scene_import_add_instance(import);
        instance->name = scene_assimp_string(import, &node->mName);
        instance->mesh = reader->meshes[node->mMeshes[i]];
        instance->object = reader->objects;
        const bool skinned = scene_assimp_is_skinned(import, reader->scene->mMeshes[node->mMeshes[i]]);
        const struct scene_import_place placed = scene_assimp_settled(
            reader->exact, world,
            scene_assimp_exact_offset(reader->exact, reader->scene->mMeshes[node->mMeshes[i]]));
        scene_import_place_instance(import, skinned ? &identity : &placed);
    }
    for (uint32_t i = 0; i < node->mNumChildren; i++) {
        if (node->mChildren[i] != NULL) { // the reader of RAW files leaves gaps
            add_node(reader, node->mChildren[i], &world);
        }
    }
    reader->depth--;
}

// Entry ---------------------------------------------------------------------------------------------

// Limits the memory of assimp by the size of the file, and sets back what was before. A few hundred bytes that
// ask for gigabytes would otherwise be given them all.
static uint64_t limit_memory(struct scene_import *import)
{
    const uint64_t base = (uint64_t)1 << 30, per_byte = 64;
    struct stat status;
    return stat(import->model.path, &status) == 0
               ? system_memory_limit_lower(base + per_byte * (uint64_t)status.st_size)
               : 0;
}

static void cut_polygon(void *user, const float (*positions)[3], const uint32_t *corners, uint32_t count,
                        uint32_t *triangles)
{
    const struct scene_mesh mesh = {.positions = (float(*)[3])positions}; // the cutter only reads positions
    scene_import_triangulate(user, &mesh, corners, count, triangles);
}

// Read what the import is about. Return NULL if assimp cannot.
static const struct aiScene *read_source(struct scene_import *import, const struct scene_assimp_exact *exact,
                                         struct scene_assimp_unknowns *unknowns)
{
    struct scene_assimp_source source = {.import = import, .exact = exact, .unknowns = unknowns};
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    // The matrices that a node of an FBX is made of stay nodes of their own: where assimp 5.2.5 multiplies them, it
    // turns the matrix that exporters aim cameras and lights with the wrong way.
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, 1);
    const uint64_t before = limit_memory(import);
    scene_import_enter(import, "assimp", scene_assimp_schema(import));
    struct aiFileIO files = scene_assimp_files(&source);
    const struct aiScene *scene = aiImportFileExWithProperties(import->model.path, 0, &files, properties);
    if (scene != NULL) {
        if (!scene_assimp_cut_faces(scene, cut_polygon, import)) {
            scene_import_fail(import, "needs more memory than there is");
        }
        scene = aiApplyPostProcessing(scene,
                                      aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenUVCoords);
    }
    if (source.changed != unknowns->text) {
        free(source.changed);
    }
    system_memory_limit_restore(before);
    scene_import_enter(import, NULL, "");
    aiReleasePropertyStore(properties);
    return scene;
}

// Read the scene, and pose it. Return NULL if assimp cannot.
static const struct aiScene *read_posed(struct scene_import *import, struct scene_assimp_exact *exact)
{
    struct scene_assimp_unknowns unknowns = {.count = 0};
    const struct aiScene *scene = read_source(import, exact, &unknowns);
    while (scene == NULL && scene_assimp_leave_out(import, aiGetErrorString(), &unknowns)) {
        scene = read_source(import, exact, &unknowns);
    }
    free(unknowns.text);
    if (scene != NULL && scene->mRootNode == NULL) {
        scene_import_fail(import, "has no nodes");
    }
    if (scene != NULL) {
        scene_assimp_pose(import, exact, scene);
    }
    return scene;
}

static const struct aiScene *read_scene(struct scene_import *import, struct scene_assimp_exact *exact)
{
    const struct aiScene *scene = read_posed(import, exact);
    if (scene != NULL && scene_assimp_is_far(import, exact, scene) && scene_assimp_rewrite(import, exact)) {
        aiReleaseImport(scene);
        scene = read_posed(import, exact);
        if (scene == NULL) { // assimp has read the file as it is
            free(exact->bytes);
            *exact = (struct scene_assimp_exact){.bytes = NULL};
            scene = read_posed(import, exact);
        }
    }
    if (scene != NULL) {
        return scene;
    }
    const char *error = aiGetErrorString();
    scene_assimp_refuse_blender(import, true);
    // The second guess is made at files of no format.
    if (strncmp(error, "No suitable reader", 18) == 0 ||
        strncmp(error, "Failed to determine STL storage", 31) == 0) {
        scene_import_fail(import, "is not a model in a format that can be read");
    }
    if (strcasecmp(import->ending, "dxf") == 0 && import->model.unsupported_count > 0) {
        scene_import_fail(import, "has nothing that can be drawn: %s", import->model.unsupported[0]);
    }
    if (strstr(error, "index count in <p>") != NULL) {
        scene_assimp_refuse_indices(import);
    }
    if (strstr(error, "bad_alloc") != NULL) {
        scene_import_fail(import, "needs more memory than there is");
    }
    scene_import_fail(import, "cannot be read: %s%s", error[0] != 0 ? error : "the importer gives no reason",
                      scene_assimp_schema(import));
}

// What the importer calls itself.
static const char *format_of(struct scene_import *import, const struct aiScene *scene)
{
    static const char ending[] = " Importer";
    const struct aiMetadata *data = scene->mMetaData;
    for (unsigned i = 0; data != NULL && i < data->mNumProperties; i++) {
        if (strcmp(data->mKeys[i].data, "SourceAsset_Format") == 0 && data->mValues[i].mType == AI_AISTRING) {
            const struct aiString *name = data->mValues[i].mData;
            const size_t length = name->length, tail = strlen(ending);
            const bool importer = length > tail && strcmp(name->data + length - tail, ending) == 0;
            return scene_import_string(import, name->data, importer ? length - tail : length);
        }
    }
    return "unknown";
}

// What an FBX says of its axes; 1 (y) where it says nothing.
static int fbx_up_axis(const struct aiScene *scene)
{
    const struct aiMetadata *data = scene->mMetaData;
    for (unsigned i = 0; data != NULL && i < data->mNumProperties; i++) {
        if (strcmp(data->mKeys[i].data, "UpAxis") == 0 && data->mValues[i].mType == AI_INT32) {
            int32_t axis;
            memcpy(&axis, data->mValues[i].mData, sizeof axis);
            return axis;
        }
    }
    return 1;
}

// What an FBX says of its unit: so many centimetres; 0 where it says nothing.
static double fbx_unit(const struct aiScene *scene)
{
    const struct aiMetadata *data = scene->mMetaData;
    for (unsigned i = 0; data != NULL && i < data->mNumProperties; i++) {
        const struct aiMetadataEntry *const entry = &data->mValues[i];
        float narrow;
        double wide;
        if (strcmp(data->mKeys[i].data, "UnitScaleFactor") != 0) {
            continue;
        }
        if (entry->mType == AI_DOUBLE) {
            memcpy(&wide, entry->mData, sizeof wide);
            return wide;
        }
        if (entry->mType == AI_FLOAT) {
            memcpy(&narrow, entry->mData, sizeof narrow);
            return (double)narrow;
        }
    }
    return 0;
}

static void set_unit(struct scene_import *import, const struct aiScene *scene)
{
    const double centimetres = strcasecmp(import->ending, "fbx") == 0 ? fbx_unit(scene) : 0;
    char text[32];
    snprintf(text, sizeof text, "%.6g mm", centimetres * 10);
    if (centimetres > 0 && centimetres < 1e6) {
        import->model.unit = centimetres == 100 ? "metre" : scene_import_string(import, text, sizeof text);
    }
}

// Assimp turns most formats so that y is up; these it leaves as they are.
static void set_up(struct scene_import *import, const struct aiScene *scene)
{
    static const char *const upright[] = {"amf", "blend", "cob", "hmp", "smd"}; // along z
    for (size_t i = 0; i < sizeof upright / sizeof *upright; i++) {
        if (strcasecmp(import->ending, upright[i]) == 0) {
            import->model.up = SCENE_AXIS_Z;
        }
    }
    if (strcasecmp(import->ending, "fbx") == 0) {
        const int axis = fbx_up_axis(scene);
        import->model.up = axis == 2 ? SCENE_AXIS_Z : axis == 0 ? SCENE_AXIS_X : SCENE_AXIS_Y;
    }
    import->up_is_open = strcasecmp(import->ending, "xgl") == 0 || strcasecmp(import->ending, "zgl") == 0;
}

// Return true if floats have lost what a model far from the origin has.
static bool has_floats_alone(const struct reader *reader)
{
    bool is_skinned = false;
    for (uint32_t i = 0; i < reader->scene->mNumMeshes; i++) {
        is_skinned = is_skinned || scene_assimp_is_skinned(reader->import, reader->scene->mMeshes[i]);
    }
    return reader->exact->bytes == NULL || (reader->exact->rounds_movements && is_skinned) ||
           scene_assimp_is_far(reader->import, reader->exact, reader->scene);
}

void scene_import_assimp(struct scene_import *import)
{
    scene_assimp_refuse_blender(import, false);
    scene_assimp_listen(import);
    struct scene_assimp_exact exact = {.bytes = NULL};
    struct scene_blender_shadings shadings = {.count = 0};
    scene_assimp_find_gaps(import);
    scene_assimp_look_at_blender(import, &shadings);
    const struct aiScene *scene = read_scene(import, &exact);
    struct reader reader = {.import = import, .exact = &exact, .scene = scene};
    scene_assimp_tell_hidden(import);
    import->model.format = format_of(import, scene);
    import->model.doubts_cameras = true;
    set_up(import, scene);
    set_unit(import, scene);
    import->has_floats_alone = has_floats_alone(&reader);
    reader.meshes = scene_import_allocate(import, scene->mNumMeshes, sizeof *reader.meshes);
    reader.materials = scene_import_allocate(import, scene->mNumMaterials, sizeof *reader.materials);
    for (uint32_t i = 0; i < scene->mNumMaterials; i++) {
        reader.materials[i][0] = reader.materials[i][1] = -1;
    }
    reader.shadings = scene_import_allocate(import, scene->mNumMeshes, sizeof *reader.shadings);
    if (shadings.count > 0) {
        set_shadings(&reader, &shadings, scene->mRootNode, 0);
    }
    scene_blender_free_shadings(&shadings);
    for (uint32_t i = 0; i < scene->mNumMeshes; i++) {
        add_mesh(&reader, i);
    }
    const struct scene_import_place identity = scene_import_place_identity();
    add_node(&reader, scene->mRootNode, &identity);
    scene_assimp_add_cameras(import, &exact, scene);
    scene_assimp_add_lights(import, &exact, scene);
}
