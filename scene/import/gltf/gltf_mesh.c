// SPDX-License-Identifier: MIT
// Meshes (§3.7): every primitive becomes one mesh of lists. Morph targets are applied at their weights, and skins in
// the pose that the nodes give, so that code that draws a mesh need not know of either.
#include <stdlib.h>
#include <string.h>

#include "gltf.h"
#include "import/builder/complete_mesh.h"
#include "import/builder/skin.h"

enum { MODE_POINTS, MODE_LINES, MODE_LINE_LOOP, MODE_LINE_STRIP, MODE_TRIANGLES, MODE_STRIP, MODE_FAN };

struct primitive {
    struct scene_gltf *gltf;
    const json_t *object, *attributes;
    int mesh_number, number;
    bool is_draco; // its indices are of triangles, whatever its mode was before
    struct scene_mesh mesh;
    double origin[3]; // what was subtracted from the positions
};

_Noreturn static void refuse(const struct primitive *primitive, const char *problem)
{
    scene_import_fail(primitive->gltf->import, "meshes[%d].primitives[%d]: %s", primitive->mesh_number,
                      primitive->number, problem);
}

// Attributes ----------------------------------------------------------------------------------------

// Return an attribute with one element for each vertex. Return NULL if there is none.
static void *attribute(const struct primitive *primitive, const json_t *attributes, const char *name,
                       int least, int width)
{
    const int64_t accessor = scene_gltf_integer(primitive->gltf, attributes, name, -1);
    if (accessor < 0) {
        return NULL;
    }
    uint32_t count = 0;
    float *values = scene_gltf_read_floats(primitive->gltf, accessor, least, width, &count);
    if (count != primitive->mesh.vertex_count) {
        char problem[96];
        snprintf(problem, sizeof problem, "%s has %u elements, POSITION %u", name, count,
                 primitive->mesh.vertex_count);
        refuse(primitive, problem);
    }
    return values;
}

// Tell of attributes that mean nothing. Those that begin with _ are a program's own.
static void tell_of_attributes(const struct primitive *primitive)
{
    static const char *const known[] = {"POSITION", "NORMAL",  "TANGENT", "TEXCOORD_",
                                        "COLOR_",   "JOINTS_", "WEIGHTS_"};
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)primitive->attributes, name, value)
    {
        bool is_known = name[0] == '_';
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
            const size_t length = strlen(known[i]);
            const bool is_numbered = known[i][length - 1] == '_';
            is_known = is_known ||
                       (is_numbered ? strncmp(name, known[i], length) == 0 : strcmp(name, known[i]) == 0);
        }
        if (!is_known) {
            scene_import_unsupported(primitive->gltf->import, "attribute \"%.64s\": ignored", name);
        }
    }
}

static void read_attributes(struct primitive *primitive)
{
    struct scene_mesh *mesh = &primitive->mesh;
    const json_t *attributes = primitive->attributes;
    const int64_t positions = scene_gltf_integer(primitive->gltf, attributes, "POSITION", -1);
    mesh->positions = (void *)scene_gltf_read_floats(primitive->gltf, positions, 3, 3, &mesh->vertex_count);
    mesh->normals = attribute(primitive, attributes, "NORMAL", 3, 3);
    // Tangents without normals are to be ignored (§3.7.2.1).
    mesh->tangents = mesh->normals != NULL ? attribute(primitive, attributes, "TANGENT", 4, 4) : NULL;
    mesh->uvs[0] = attribute(primitive, attributes, "TEXCOORD_0", 2, 2);
    mesh->uvs[1] = attribute(primitive, attributes, "TEXCOORD_1", 2, 2);
    mesh->colors = attribute(primitive, attributes, "COLOR_0", 3, 4);
    if (json_object_get(attributes, "COLOR_1") != NULL) {
        scene_import_unsupported(primitive->gltf->import,
                                 "a second set of vertex colours (COLOR_1): ignored");
    }
    tell_of_attributes(primitive);
}

// Indices -------------------------------------------------------------------------------------------

// Return the file's indices, or 0, 1, 2, ... if it has none.
static uint32_t *read_indices(struct primitive *primitive, uint32_t *count)
{
    const int64_t accessor = scene_gltf_integer(primitive->gltf, primitive->object, "indices", -1);
    const uint32_t vertices = primitive->mesh.vertex_count;
    if (accessor < 0) {
        uint32_t *indices = scene_import_allocate(primitive->gltf->import, vertices, sizeof *indices);
        for (uint32_t i = 0; i < vertices; i++) {
            indices[i] = i;
        }
        *count = vertices;
        return indices;
    }
    uint32_t *indices = scene_gltf_read_integers(primitive->gltf, accessor, 1, count);
    for (uint32_t i = 0; i < *count; i++) {
        if (indices[i] >= vertices) {
            char problem[96];
            snprintf(problem, sizeof problem, "index %u is outside its %u vertices", indices[i], vertices);
            refuse(primitive, problem);
        }
    }
    return indices;
}

// Make a list of every topology, in the order of §3.7.2.1.
static void make_list(struct primitive *primitive, int mode, const uint32_t *in, uint32_t count)
{
    struct scene_mesh *mesh = &primitive->mesh;
    const bool lines = mode == MODE_LINE_LOOP || mode == MODE_LINE_STRIP;
    const uint32_t elements = lines ? (mode == MODE_LINE_LOOP ? count : count - 1) : count - 2;
    const uint32_t corners = lines ? 2 : 3;
    if (count < corners) {
        return;
    }
    if (elements > UINT32_MAX / 4) {
        refuse(primitive, "has too many indices");
    }
    mesh->indices =
        scene_import_allocate(primitive->gltf->import, (size_t)elements * corners, sizeof *mesh->indices);
    mesh->index_count = elements * corners;
    for (uint32_t i = 0; i < elements; i++) {
        uint32_t *out = mesh->indices + (size_t)i * corners;
        if (lines) {
            out[0] = in[i];
            out[1] = in[(i + 1) % count];
        } else if (mode == MODE_STRIP) {
            out[0] = in[i];
            out[1] = in[i + 1 + i % 2];
            out[2] = in[i + 2 - i % 2];
        } else {
            out[0] = in[i + 1];
            out[1] = in[i + 2];
            out[2] = in[0];
        }
    }
}

static void read_topology(struct primitive *primitive)
{
    struct scene_mesh *mesh = &primitive->mesh;
    const int64_t mode = primitive->is_draco
                             ? MODE_TRIANGLES
                             : scene_gltf_integer(primitive->gltf, primitive->object, "mode", MODE_TRIANGLES);
    if (mode < 0 || mode > MODE_FAN) {
        refuse(primitive, "has a mode that does not exist");
    }
    mesh->primitive = mode == MODE_POINTS       ? SCENE_PRIMITIVE_POINTS
                      : mode <= MODE_LINE_STRIP ? SCENE_PRIMITIVE_LINES
                                                : SCENE_PRIMITIVE_TRIANGLES;
    uint32_t count = 0;
    uint32_t *indices = read_indices(primitive, &count);
    if (mode == MODE_POINTS || mode == MODE_LINES || mode == MODE_TRIANGLES) {
        mesh->indices = indices;
        mesh->index_count = count;
        return;
    }
    make_list(primitive, (int)mode, indices, count);
    free(indices);
}

// Morph targets and skins ---------------------------------------------------------------------------

static void add_scaled(float *values, int width, const float *deltas, uint32_t count, float weight)
{
    if (values == NULL || deltas == NULL) {
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            values[(size_t)i * (size_t)width + (size_t)c] += weight * deltas[(size_t)i * 3 + (size_t)c];
        }
    }
}

struct weights {
    const double *values;
    size_t count;
};

static void apply_morphs(struct primitive *primitive, struct weights weights)
{
    struct scene_mesh *mesh = &primitive->mesh;
    size_t i;
    json_t *target;
    json_array_foreach(scene_gltf_array(primitive->gltf, primitive->object, "targets"), i, target)
    {
        const float weight = i < weights.count ? (float)weights.values[i] : 0;
        if (weight == 0) {
            continue;
        }
        float *positions = attribute(primitive, target, "POSITION", 3, 3);
        float *normals = attribute(primitive, target, "NORMAL", 3, 3);
        float *tangents = attribute(primitive, target, "TANGENT", 3, 3);
        add_scaled((float *)mesh->positions, 3, positions, mesh->vertex_count, weight);
        add_scaled((float *)mesh->normals, 3, normals, mesh->vertex_count, weight);
        add_scaled((float *)mesh->tangents, 4, tangents, mesh->vertex_count, weight);
        free(positions);
        free(normals);
        free(tangents);
        if (json_object_get(target, "COLOR_0") != NULL || json_object_get(target, "TEXCOORD_0") != NULL ||
            json_object_get(target, "TEXCOORD_1") != NULL) {
            scene_import_unsupported(primitive->gltf->import,
                                     "morph targets of colours and texture coordinates: left as at rest");
        }
    }
}

// Return the places of a skin's joints: world matrix of the joint × inverse bind matrix (§3.7.3.1).
static struct scene_import_place *find_joints(struct scene_gltf *gltf, int64_t skin_index, size_t *count)
{
    const json_t *skin = scene_gltf_item(gltf, "skins", skin_index);
    const json_t *joints = scene_gltf_array(gltf, skin, "joints");
    const int64_t accessor = scene_gltf_integer(gltf, skin, "inverseBindMatrices", -1);
    *count = json_array_size(joints);
    struct scene_import_place *places = scene_import_allocate(gltf->import, *count, sizeof *places);
    float *binds = NULL;
    uint32_t bind_count = 0;
    if (accessor >= 0) {
        binds = scene_gltf_read_floats(gltf, accessor, 16, 16, &bind_count);
    }
    for (size_t i = 0; i < *count; i++) {
        const json_t *joint = json_array_get(joints, i);
        const double node = json_is_number(joint) ? json_number_value(joint) : -1;
        if (!(node >= 0 && node < (double)scene_gltf_count(gltf, "nodes"))) {
            scene_import_fail(gltf->import, "skins[%lld] has a joint that does not exist",
                              (long long)skin_index);
        }
        places[i] = gltf->nodes[(size_t)node].world;
        if (i < bind_count) {
            const struct scene_import_place bind = scene_import_place_of(binds + 16 * i);
            places[i] = scene_import_place_multiply(&places[i], &bind);
        }
    }
    free(binds);
    return places;
}

// Add what joint and weight set `set` gives to each vertex. Return false if there is no set of this number.
static bool add_joints(struct primitive *primitive, int set, const struct scene_import_place *joints,
                       size_t joint_count, struct scene_import_skin *skin)
{
    char joint_name[32], weight_name[32];
    snprintf(joint_name, sizeof joint_name, "JOINTS_%d", set);
    snprintf(weight_name, sizeof weight_name, "WEIGHTS_%d", set);
    const int64_t accessor = scene_gltf_integer(primitive->gltf, primitive->attributes, joint_name, -1);
    float(*weights)[4] = attribute(primitive, primitive->attributes, weight_name, 4, 4);
    if (accessor < 0 || weights == NULL) {
        return false;
    }
    uint32_t count = 0;
    uint32_t *indices = scene_gltf_read_integers(primitive->gltf, accessor, 4, &count);
    if (count != primitive->mesh.vertex_count) {
        refuse(primitive, "JOINTS and POSITION have different counts");
    }
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 4; k++) {
            const uint32_t joint = indices[4 * (size_t)i + (size_t)k];
            if (weights[i][k] == 0) {
                continue;
            }
            if (joint >= joint_count) {
                refuse(primitive, "refers to a joint that its skin does not have");
            }
            scene_import_skin_add(skin, i, &joints[joint], weights[i][k]);
        }
    }
    free(weights);
    free(indices);
    return true;
}

// Bring the vertices of a skinned node into the world. A primitive without joints is brought there by the node's own
// matrix.
static void apply_skin(struct primitive *primitive, int64_t skin_index,
                       const struct scene_import_place *world)
{
    struct scene_import *const import = primitive->gltf->import;
    struct scene_gltf *const gltf = primitive->gltf;
    const bool has_joints = scene_gltf_integer(gltf, primitive->attributes, "JOINTS_0", -1) >= 0 &&
                            scene_gltf_integer(gltf, primitive->attributes, "WEIGHTS_0", -1) >= 0;
    size_t count = 0;
    struct scene_import_place *const joints = find_joints(primitive->gltf, skin_index, &count);
    struct scene_import_skin skin =
        scene_import_skin_open(import, &primitive->mesh, has_joints ? joints : world, has_joints ? count : 1);
    for (int set = 0; add_joints(primitive, set, joints, count, &skin); set++) {
    }
    for (uint32_t i = 0; i < primitive->mesh.vertex_count && !has_joints; i++) {
        scene_import_skin_add(&skin, i, world, 1);
    }
    scene_import_skin_close(&skin, false, primitive->origin);
    free(joints);
}

// Return the material of the variant that is wanted, or the primitive's own (KHR_materials_variants).
static int64_t find_material(const struct primitive *primitive)
{
    struct scene_gltf *gltf = primitive->gltf;
    const json_t *extension = scene_gltf_extension(gltf, primitive->object, "KHR_materials_variants");
    size_t i, k;
    json_t *mapping, *number;
    json_array_foreach(scene_gltf_array(gltf, extension, "mappings"), i, mapping)
    {
        json_array_foreach(scene_gltf_array(gltf, mapping, "variants"), k, number)
        {
            if (gltf->variant >= 0 && json_is_number(number) &&
                json_number_value(number) == (double)gltf->variant) {
                return scene_gltf_integer(gltf, mapping, "material", -1);
            }
        }
    }
    return scene_gltf_integer(gltf, primitive->object, "material", -1);
}

// Entry ---------------------------------------------------------------------------------------------

static bool make_primitive(struct primitive *primitive, const char *name, struct weights weights,
                           int64_t skin, const struct scene_import_place *world)
{
    struct scene_gltf *gltf = primitive->gltf;
    if (!json_is_object(primitive->object)) {
        refuse(primitive, "must be an object");
    }
    primitive->attributes = scene_gltf_object(gltf, primitive->object, "attributes");
    if (json_object_get(primitive->attributes, "POSITION") == NULL) {
        scene_import_warn(gltf->import, "meshes[%d].primitives[%d] has no positions: not drawn",
                          primitive->mesh_number, primitive->number);
        return false;
    }
    scene_gltf_note_extensions(gltf, primitive->object);
    const json_t *draco = scene_gltf_extension(gltf, primitive->object, "KHR_draco_mesh_compression");
    primitive->is_draco = draco != NULL;
    if (draco != NULL) {
        char what[64];
        snprintf(what, sizeof what, "meshes[%d].primitives[%d]", primitive->mesh_number, primitive->number);
        scene_gltf_draco(gltf, primitive->object, draco, what);
    }
    read_attributes(primitive);
    read_topology(primitive);
    apply_morphs(primitive, weights);
    if (skin >= 0) {
        apply_skin(primitive, skin, world);
    }
    primitive->mesh.name = name;
    primitive->mesh.material = scene_gltf_material(gltf, find_material(primitive));
    *scene_import_add_mesh(gltf->import) = primitive->mesh;
    scene_import_place_mesh(gltf->import, primitive->origin);
    scene_import_complete_mesh(gltf->import, gltf->import->model.mesh_count - 1, SCENE_IMPORT_FLAT, false);
    return true;
}

// Return the weights of morph targets: an animation's come first, the node's next, its mesh's last.
static struct weights find_weights(struct scene_gltf *gltf, const json_t *node, const json_t *mesh,
                                   const struct scene_gltf_node *place)
{
    if (place->weights != NULL) {
        return (struct weights){place->weights, place->weight_count};
    }
    const json_t *const own = scene_gltf_array(gltf, node, "weights");
    const json_t *const list = own != NULL ? own : scene_gltf_array(gltf, mesh, "weights");
    const size_t count = json_array_size(list);
    double *const values = scene_import_allocate(gltf->import, count, sizeof *values);
    for (size_t i = 0; i < count; i++) {
        values[i] = json_number_value(json_array_get(list, i));
    }
    return (struct weights){values, count};
}

struct scene_gltf_meshes scene_gltf_mesh(struct scene_gltf *gltf, const json_t *node,
                                         const struct scene_gltf_node *place)
{
    const int64_t index = scene_gltf_integer(gltf, node, "mesh", -1);
    const json_t *object = scene_gltf_item(gltf, "meshes", index);
    const int64_t skin = scene_gltf_integer(gltf, node, "skin", -1);
    // A mesh that is equal for every node that uses it is made once.
    const bool shared = skin < 0 && place->weights == NULL && scene_gltf_array(gltf, node, "weights") == NULL;
    if (shared && gltf->meshes[index].made) {
        return gltf->meshes[index];
    }
    const struct weights weights = find_weights(gltf, node, object, place);
    struct scene_gltf_meshes meshes = {gltf->import->model.mesh_count, 0, true, skin >= 0};
    const char *name = scene_gltf_name(gltf, object);
    size_t i;
    json_t *part;
    json_array_foreach(scene_gltf_array(gltf, object, "primitives"), i, part)
    {
        struct primitive primitive = {
            .gltf = gltf, .object = part, .mesh_number = (int)index, .number = (int)i};
        meshes.count += make_primitive(&primitive, name, weights, skin, &place->world);
    }
    if (shared) {
        gltf->meshes[index] = meshes;
    }
    return meshes;
}
