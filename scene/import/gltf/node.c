// SPDX-License-Identifier: MIT
// The node forest (§3.5): places in the world, and the instances, cameras and lights of the scene.
#include <stdlib.h>
#include <string.h>

#include "elementary.h"
#include "gltf.h"
#include "import/builder/numbers.h"
#include "import/builder/pose.h"

static const uint32_t no_parent = UINT32_MAX;

// Nodes still to be visited. A node stands on the stack at most twice, as a child and as a root, so the node count
// bounds it. Recursion would let a deep file overflow the program's stack.
struct stack {
    uint32_t *nodes;
    size_t count;
};

static uint32_t node_index(struct scene_gltf *gltf, const json_t *value, const char *list)
{
    const double number = json_is_number(value) ? json_number_value(value) : -1;
    if (!(number >= 0 && number < (double)scene_gltf_count(gltf, "nodes"))) {
        scene_import_fail(gltf->import, "\"%s\" refers to a node that does not exist", list);
    }
    return (uint32_t)number;
}

static void find_parents(struct scene_gltf *gltf)
{
    const size_t count = scene_gltf_count(gltf, "nodes");
    for (size_t i = 0; i < count; i++) {
        gltf->nodes[i].parent = no_parent;
    }
    for (size_t i = 0; i < count; i++) {
        const json_t *node = scene_gltf_item(gltf, "nodes", (int64_t)i);
        size_t k;
        json_t *value;
        json_array_foreach(scene_gltf_array(gltf, node, "children"), k, value)
        {
            const uint32_t child = node_index(gltf, value, "children");
            if (gltf->nodes[child].parent != no_parent) {
                scene_import_warn(gltf->import,
                                  "nodes[%u] has two parents, nodes[%u] and nodes[%zu]: drawn once, "
                                  "as a child of the first",
                                  child, gltf->nodes[child].parent, i);
                continue;
            }
            gltf->nodes[child].parent = (uint32_t)i;
            gltf->nodes[child].place = (uint32_t)k;
        }
    }
}

// Read one of a node's properties, or take it from an animation.
static void read_property(struct scene_gltf *gltf, const json_t *node, const char *key,
                          const double *animated, int count, double *values)
{
    scene_gltf_numbers(gltf, node, key, values, (size_t)count);
    for (int i = 0; i < count && animated != NULL; i++) {
        values[i] = animated[i];
    }
}

static struct scene_import_place local_place(struct scene_gltf *gltf, const json_t *node,
                                             const struct scene_gltf_node *animated)
{
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    struct scene_import_place place;
    if (scene_gltf_numbers(gltf, node, "matrix", place.exact, 16)) {
        for (int i = 0; i < 16; i++) {
            place.world[i] = (float)place.exact[i];
        }
        return place;
    }
    read_property(gltf, node, "translation", animated->translation, 3, t);
    read_property(gltf, node, "rotation", animated->rotation, 4, q);
    read_property(gltf, node, "scale", animated->scale, 3, s);
    return scene_import_compose(t, q, s);
}

// Push the children of a node, the first on top. A child that another node or place has, too, is pushed once.
static void push_children(struct scene_gltf *gltf, struct stack *stack, uint32_t node)
{
    const json_t *children = scene_gltf_array(gltf, scene_gltf_item(gltf, "nodes", node), "children");
    for (size_t i = json_array_size(children); i > 0; i--) {
        const uint32_t child = node_index(gltf, json_array_get(children, i - 1), "children");
        if (gltf->nodes[child].parent == node && gltf->nodes[child].place == i - 1) {
            stack->nodes[stack->count++] = child;
        }
    }
}

static void place_nodes(struct scene_gltf *gltf, struct stack *stack)
{
    const size_t count = scene_gltf_count(gltf, "nodes");
    for (size_t i = count; i > 0; i--) {
        if (gltf->nodes[i - 1].parent == no_parent) {
            stack->nodes[stack->count++] = (uint32_t)(i - 1);
        }
    }
    while (stack->count > 0) {
        const uint32_t index = stack->nodes[--stack->count];
        struct scene_gltf_node *node = &gltf->nodes[index];
        node->world = local_place(gltf, scene_gltf_item(gltf, "nodes", index), node);
        if (node->parent != no_parent) {
            node->world = scene_import_place_multiply(&gltf->nodes[node->parent].world, &node->world);
        }
        node->placed = true;
        push_children(gltf, stack, index);
    }
    for (size_t i = 0; i < count; i++) {
        if (!gltf->nodes[i].placed) {
            scene_import_fail(gltf->import, "nodes[%zu] is its own ancestor: the node graph has a cycle", i);
        }
    }
}

// What a node holds ---------------------------------------------------------------------------------

static void add_instance(struct scene_gltf *gltf, const json_t *node, struct scene_gltf_meshes meshes,
                         const struct scene_import_place *world, uint32_t object)
{
    const char *name = scene_gltf_name(gltf, node);
    for (uint32_t i = 0; i < meshes.count; i++) {
        struct scene_instance *instance = scene_import_add_instance(gltf->import);
        instance->name = name;
        instance->mesh = meshes.first + i;
        instance->object = object;
        scene_import_place_instance(gltf->import, world);
    }
}

// Return an attribute of EXT_mesh_gpu_instancing. Return NULL if there is none. All attributes have equally many
// elements.
static float *instance_attribute(struct scene_gltf *gltf, const json_t *attributes, const char *name,
                                 int width, uint32_t *count)
{
    const int64_t accessor = scene_gltf_integer(gltf, attributes, name, -1);
    if (accessor < 0) {
        return NULL;
    }
    uint32_t own = 0;
    float *values = scene_gltf_read_floats(gltf, accessor, width, width, &own);
    if (*count != 0 && own != *count) {
        scene_import_fail(gltf->import, "EXT_mesh_gpu_instancing: %s has %u elements where others have %u",
                          name, own, *count);
    }
    *count = own;
    return values;
}

// Take an element of an attribute that may be absent.
static void take(const float *attribute, uint32_t element, uint32_t width, double *values)
{
    for (uint32_t i = 0; i < width && attribute != NULL; i++) {
        values[i] = (double)attribute[(size_t)element * width + i];
    }
}

// Add the node's mesh many times, each time as an object of its own (EXT_mesh_gpu_instancing).
static void add_many(struct scene_gltf *gltf, const json_t *node, struct scene_gltf_meshes meshes,
                     const struct scene_import_place *world, uint32_t *objects)
{
    const json_t *extension = scene_gltf_extension(gltf, node, "EXT_mesh_gpu_instancing");
    const json_t *attributes = scene_gltf_object(gltf, extension, "attributes");
    uint32_t count = 0;
    float *moves = instance_attribute(gltf, attributes, "TRANSLATION", 3, &count);
    float *turns = instance_attribute(gltf, attributes, "ROTATION", 4, &count);
    float *scales = instance_attribute(gltf, attributes, "SCALE", 3, &count);
    for (uint32_t i = 0; i < count; i++) {
        double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
        take(moves, i, 3, t);
        take(turns, i, 4, q);
        take(scales, i, 3, s);
        const struct scene_import_place local = scene_import_compose(t, q, s);
        const struct scene_import_place place = scene_import_place_multiply(world, &local);
        add_instance(gltf, node, meshes, &place, ++*objects);
    }
    free(moves);
    free(turns);
    free(scales);
}

static void add_instances(struct scene_gltf *gltf, const json_t *node, const struct scene_gltf_node *place,
                          uint32_t *objects)
{
    const struct scene_gltf_meshes meshes = scene_gltf_mesh(gltf, node, place);
    if (meshes.in_world) {
        const struct scene_import_place identity = scene_import_place_identity();
        add_instance(gltf, node, meshes, &identity, ++*objects);
    } else if (scene_gltf_extension(gltf, node, "EXT_mesh_gpu_instancing") != NULL) {
        add_many(gltf, node, meshes, &place->world, objects);
    } else {
        add_instance(gltf, node, meshes, &place->world, ++*objects);
    }
}

static void add_camera(struct scene_gltf *gltf, const json_t *node, const struct scene_import_place *place)
{
    const float *const world = place->world;
    const json_t *object = scene_gltf_item(gltf, "cameras", scene_gltf_integer(gltf, node, "camera", -1));
    const json_t *perspective = scene_gltf_object(gltf, object, "perspective");
    const json_t *orthographic = scene_gltf_object(gltf, object, "orthographic");
    const json_t *lens = orthographic != NULL ? orthographic : perspective;
    struct scene_model_camera camera = {.name = scene_gltf_name(gltf, object),
                                        .orthographic = orthographic != NULL};
    if (camera.name[0] == 0) {
        camera.name = scene_gltf_name(gltf, node);
    }
    memcpy(camera.world, world, sizeof camera.world);
    camera.znear = (float)scene_gltf_number(gltf, lens, "znear", 0.01);
    camera.zfar = (float)scene_gltf_number(gltf, lens, "zfar", 0);
    camera.yfov = (float)scene_gltf_number(gltf, lens, "yfov", 0);
    camera.aspect = (float)scene_gltf_number(gltf, lens, "aspectRatio", 0);
    camera.xmag = (float)scene_gltf_number(gltf, lens, "xmag", 0);
    camera.ymag = (float)scene_gltf_number(gltf, lens, "ymag", 0);
    const bool good =
        camera.orthographic
            ? camera.xmag != 0 && camera.ymag != 0 && camera.zfar > camera.znear && camera.znear >= 0
            : camera.yfov > 0 && camera.yfov < 3.14159f && camera.aspect >= 0 && camera.znear > 0 &&
                  (camera.zfar == 0 || camera.zfar > camera.znear);
    if (good && scene_import_finite(world, 16) && scene_import_determinant(world) != 0) {
        *scene_import_add_camera(gltf->import) = camera;
        scene_import_place_camera(gltf->import, place);
    } else {
        scene_import_warn(gltf->import, "camera \"%s\" is not valid: left out", camera.name);
    }
}

static void add_light(struct scene_gltf *gltf, int64_t index, const struct scene_import_place *place)
{
    const float *const world = place->world;
    const json_t *list =
        scene_gltf_array(gltf, scene_gltf_extension(gltf, gltf->root, "KHR_lights_punctual"), "lights");
    const json_t *object = json_array_get(list, (size_t)index);
    if (!json_is_object(object)) {
        scene_import_fail(gltf->import, "refers to light %lld, but there are %zu", (long long)index,
                          json_array_size(list));
    }
    struct scene_model_light light = {.name = scene_gltf_name(gltf, object), .color = {1, 1, 1}};
    const char *type = scene_gltf_text(gltf, object, "type");
    const json_t *spot = scene_gltf_object(gltf, object, "spot");
    const bool known = type != NULL && (strcmp(type, "directional") == 0 || strcmp(type, "point") == 0 ||
                                        strcmp(type, "spot") == 0);
    light.type = !known || type[0] == 'p' ? SCENE_LIGHT_POINT
                 : type[0] == 's'         ? SCENE_LIGHT_SPOT
                                          : SCENE_LIGHT_DIRECTIONAL;
    scene_gltf_floats(gltf, object, "color", light.color, 3);
    light.intensity = (float)scene_gltf_number(gltf, object, "intensity", 1);
    light.range = (float)scene_gltf_number(gltf, object, "range", 0);
    light.inner_cos = (float)scene_cos(scene_gltf_number(gltf, spot, "innerConeAngle", 0));
    light.outer_cos = (float)scene_cos(scene_gltf_number(gltf, spot, "outerConeAngle", 0.78539816339744831));
    memcpy(light.position, world + 12, sizeof light.position);
    const float length = __builtin_sqrtf(world[8] * world[8] + world[9] * world[9] + world[10] * world[10]);
    for (int c = 0; c < 3; c++) {
        light.direction[c] = length > 0 ? -world[8 + c] / length : c == 2 ? -1.0f : 0.0f;
    }
    const bool good = known && light.intensity >= 0 && light.range >= 0 && scene_import_finite(world, 16) &&
                      scene_import_finite(light.color, 3) && scene_import_finite(&light.intensity, 1);
    if (light.inner_cos <= light.outer_cos) {
        light.inner_cos = light.outer_cos + 1e-4f;
    }
    if (good) {
        *scene_import_add_light(gltf->import) = light;
        scene_import_place_light(gltf->import, place);
    } else {
        scene_import_warn(gltf->import, "light \"%s\" is not valid: left out", light.name);
    }
}

// Return true if KHR_node_visibility lets the node be seen. A false value hides the children too.
static bool is_visible(struct scene_gltf *gltf, uint32_t index)
{
    const json_t *node = scene_gltf_item(gltf, "nodes", index);
    return scene_gltf_flag(gltf, scene_gltf_extension(gltf, node, "KHR_node_visibility"), "visible", true);
}

static void visit(struct scene_gltf *gltf, uint32_t index, uint32_t *objects)
{
    const json_t *node = scene_gltf_item(gltf, "nodes", index);
    const struct scene_import_place *world = &gltf->nodes[index].world;
    const json_t *light = scene_gltf_extension(gltf, node, "KHR_lights_punctual");
    scene_gltf_note_extensions(gltf, node);
    if (json_object_get(node, "mesh") != NULL) {
        add_instances(gltf, node, &gltf->nodes[index], objects);
    }
    if (json_object_get(node, "camera") != NULL) {
        add_camera(gltf, node, world);
    }
    if (light != NULL) {
        add_light(gltf, scene_gltf_integer(gltf, light, "light", -1), world);
    }
}

// Push the roots of the scene to draw: of the default scene, of the first one, or all roots if the file has no scene.
static void push_scene(struct scene_gltf *gltf, struct stack *stack)
{
    if (scene_gltf_count(gltf, "scenes") == 0) {
        for (size_t i = scene_gltf_count(gltf, "nodes"); i > 0; i--) {
            if (gltf->nodes[i - 1].parent == no_parent) {
                stack->nodes[stack->count++] = (uint32_t)(i - 1);
            }
        }
        return;
    }
    const size_t scenes = scene_gltf_count(gltf, "scenes");
    const int64_t drawn = scene_gltf_integer(gltf, gltf->root, "scene", 0);
    const json_t *scene = scene_gltf_item(gltf, "scenes", drawn);
    if (scenes > 1) {
        scene_import_unsupported(gltf->import, "scenes[%lld] alone is drawn, of %zu scenes", (long long)drawn,
                                 scenes);
    }
    const json_t *roots = scene_gltf_array(gltf, scene, "nodes");
    for (size_t i = json_array_size(roots); i > 0; i--) {
        const uint32_t root = node_index(gltf, json_array_get(roots, i - 1), "scenes");
        // A root that is a child is against §3.5.1, but others draw it.
        if (gltf->nodes[root].parent != no_parent) {
            scene_import_warn(
                gltf->import,
                "nodes[%u] is a root of the scene and a child of nodes[%u]: drawn once, as its child", root,
                gltf->nodes[root].parent);
        }
        if (!gltf->nodes[root].in_scene) {
            stack->nodes[stack->count++] = root;
        }
        gltf->nodes[root].in_scene = true;
    }
}

void scene_gltf_scene(struct scene_gltf *gltf)
{
    const size_t count = scene_gltf_count(gltf, "nodes");
    struct stack stack = {scene_import_allocate(gltf->import, 2 * count, sizeof *stack.nodes), 0};
    uint32_t objects = 0;
    if (count >= no_parent) {
        scene_import_fail(gltf->import, "has too many nodes");
    }
    find_parents(gltf);
    place_nodes(gltf, &stack);
    push_scene(gltf, &stack);
    while (stack.count > 0) {
        const uint32_t node = stack.nodes[--stack.count];
        if (!gltf->nodes[node].visited && is_visible(gltf, node)) {
            push_children(gltf, &stack, node);
            visit(gltf, node, &objects);
        }
        gltf->nodes[node].visited = true;
    }
    free(stack.nodes);
}
