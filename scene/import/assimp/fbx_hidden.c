// SPDX-License-Identifier: MIT
// Models of an FBX that are hidden, for good or for a while. assimp keeps one of the two properties that hide them, and
// not the one that Maya writes, and neither layers nor movements of visibility, so all are looked for in the file. A
// model hides those below it that do not say otherwise.
#include "assimp.h"
#include "fbx_objects.h"
#include "import/builder/hash_table.h"

#include <stdlib.h>
#include <strings.h>

enum {
    HIDDEN = 1,
    LAYERED = 2, // in a layer that is hidden
    MOVED = 4,   // hidden for a while
    SHOWN = 8,   // below the root of the scene
    DRAWN = 16,  // has a shape
    KNOWN = 32,  // what is above it has been added
    LOW = 64,    // a curve that reaches 0
};

struct graph {
    struct scene_import *import;
    struct scene_fbx_objects all;
    struct scene_hash_table places; // finds objects by their ids
    unsigned char *flags;           // what is known of an object
    uint32_t *above;                // the model above each model. NONE if there is none
};

static const uint32_t none = UINT32_MAX;

static uint32_t hash_of(int64_t id)
{
    return scene_hash_bytes(&id, sizeof id);
}

static uint32_t find(const struct graph *graph, int64_t id)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = hash_of(id);
    uint32_t index = scene_hash_next(&graph->places, hash, &place);
    while (index != none && graph->all.objects[index].id != id) {
        index = scene_hash_next(&graph->places, hash, &place);
    }
    return index;
}

static bool is_of(const struct graph *graph, uint32_t index, enum scene_fbx_class class)
{
    return index != none && graph->all.objects[index].class == class;
}

static struct graph open_graph(struct scene_import *import, char *bytes, size_t size)
{
    struct graph graph = {.import = import, .all = scene_fbx_read_objects(import, bytes, size)};
    const size_t count = graph.all.count < none ? graph.all.count : none - 1;
    graph.all.count = count;
    graph.flags = scene_import_allocate(import, count, sizeof *graph.flags);
    graph.above = scene_import_allocate(import, count, sizeof *graph.above);
    for (uint32_t i = 0; i < count; i++) {
        if (find(&graph, graph.all.objects[i].id) == none) { // where several have one id, the first is meant
            scene_hash_add(import, &graph.places, hash_of(graph.all.objects[i].id), i);
        }
        graph.flags[i] = graph.all.objects[i].is_hidden ? HIDDEN : 0;
        graph.above[i] = none;
    }
    return graph;
}

static void close_graph(struct graph *graph)
{
    free(graph->all.objects);
    free(graph->all.links);
    free(graph->places.entries);
    free(graph->flags);
    free(graph->above);
}

// Return true if a curve reaches 0. Many links may name one curve, whose values are looked at once.
static bool reaches_zero(struct graph *graph, uint32_t curve, const char *bytes, size_t size)
{
    struct scene_fbx_object *const object = &graph->all.objects[curve];
    if (object->keys != 0) {
        graph->flags[curve] |= scene_fbx_reaches_zero(bytes, size, object->keys) ? LOW : 0;
        object->keys = 0;
    }
    return (graph->flags[curve] & LOW) != 0;
}

// Find the curves that hide what follows them. A property follows curves, and a model follows properties.
static void follow_curves(struct graph *graph, const char *bytes, size_t size)
{
    for (size_t i = 0; i < graph->all.link_count; i++) {
        const struct scene_fbx_link *const link = &graph->all.links[i];
        const uint32_t node = find(graph, link->child);
        if (link->is_visibility && is_of(graph, node, SCENE_FBX_CLASS_CURVE_NODE)) {
            graph->flags[node] |= MOVED;
        }
    }
    for (size_t i = 0; i < graph->all.link_count; i++) {
        const struct scene_fbx_link *const link = &graph->all.links[i];
        const uint32_t curve = find(graph, link->child), node = find(graph, link->parent);
        if (is_of(graph, curve, SCENE_FBX_CLASS_CURVE) && is_of(graph, node, SCENE_FBX_CLASS_CURVE_NODE) &&
            (graph->flags[node] & MOVED) != 0 && reaches_zero(graph, curve, bytes, size)) {
            graph->flags[node] |= HIDDEN;
        }
    }
}

static void follow_link(struct graph *graph, const struct scene_fbx_link *link)
{
    const uint32_t child = find(graph, link->child), parent = find(graph, link->parent);
    const bool is_model = is_of(graph, child, SCENE_FBX_CLASS_MODEL);
    const bool is_hidden = child != none && (graph->flags[child] & HIDDEN) != 0;
    if (is_model && link->parent == 0) {
        graph->flags[child] |= SHOWN;
    } else if (is_model && is_of(graph, parent, SCENE_FBX_CLASS_LAYER)) {
        graph->flags[child] |= (graph->flags[parent] & HIDDEN) != 0 ? LAYERED : 0;
    } else if (is_model && is_of(graph, parent, SCENE_FBX_CLASS_MODEL)) {
        graph->above[child] = parent;
    } else if (is_of(graph, parent, SCENE_FBX_CLASS_MODEL) && is_of(graph, child, SCENE_FBX_CLASS_SHAPE)) {
        graph->flags[parent] |= DRAWN;
    } else if (is_of(graph, parent, SCENE_FBX_CLASS_MODEL) && link->is_visibility && is_hidden) {
        graph->flags[parent] |= MOVED;
    }
}

// Add to a model, and to those above it that nobody has added yet, what is above them. `path` has room for all objects.
static void inherit(struct graph *graph, uint32_t model, uint32_t *path)
{
    size_t length = 0;
    for (; model != none && (graph->flags[model] & KNOWN) == 0; model = graph->above[model]) {
        graph->flags[model] |= KNOWN; // a ring ends here
        path[length++] = model;
    }
    while (length > 0) {
        const uint32_t child = path[--length], parent = graph->above[child];
        const unsigned char taken =
            graph->all.objects[child].is_apart ? SHOWN : SHOWN | HIDDEN | LAYERED | MOVED;
        graph->flags[child] |= parent == none ? 0 : graph->flags[parent] & taken;
    }
}

// Return all that is said of models that are drawn.
static unsigned char gather(struct graph *graph)
{
    unsigned char gathered = 0;
    uint32_t *const path = scene_import_allocate(graph->import, graph->all.count, sizeof *path);
    for (uint32_t i = 0; i < graph->all.count; i++) {
        inherit(graph, i, path);
        const bool is_seen = (graph->flags[i] & SHOWN) != 0 && (graph->flags[i] & DRAWN) != 0;
        gathered |= is_seen ? graph->flags[i] : 0;
    }
    free(path);
    return gathered;
}

void scene_assimp_tell_hidden(struct scene_import *import)
{
    const char *problem = NULL;
    size_t size = 0;
    char *const bytes = strcasecmp(import->ending, "fbx") == 0
                            ? scene_import_read_bytes(import->model.path, &size, &problem)
                            : NULL;
    if (bytes == NULL) {
        return;
    }
    struct graph graph = open_graph(import, bytes, size);
    follow_curves(&graph, bytes, size);
    for (size_t i = 0; i < graph.all.link_count; i++) {
        follow_link(&graph, &graph.all.links[i]);
    }
    const unsigned char gathered = gather(&graph);
    if ((gathered & HIDDEN) != 0) {
        scene_import_unsupported(import, "hidden objects: drawn");
    }
    if ((gathered & LAYERED) != 0) {
        scene_import_unsupported(import, "hidden layers (FBX): drawn");
    }
    if ((gathered & MOVED) != 0) {
        scene_import_unsupported(import, "objects that are hidden for a while: drawn all the time");
    }
    close_graph(&graph);
    free(bytes);
}
