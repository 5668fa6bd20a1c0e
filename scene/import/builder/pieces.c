// SPDX-License-Identifier: MIT
#include "pieces.h"

#include <stdlib.h>
#include <string.h>

#include "origin.h"
#include "place.h"
#include "vertices.h"

void scene_import_keep_exact(struct scene_import *import, struct scene_mesh *mesh, const double (*points)[3])
{
    const struct scene_import_points all = {.exact = points, .count = mesh->vertex_count};
    if (scene_import_clusters_may_be(&all)) {
        mesh->exact = scene_import_allocate(import, mesh->vertex_count, sizeof *points);
        memcpy(mesh->exact, points, mesh->vertex_count * sizeof *points);
    }
}

void scene_import_check_exact(struct scene_import *import, struct scene_mesh *mesh,
                              const struct scene_import_elements *lists, size_t list_count)
{
    if (mesh->exact == NULL) {
        return;
    }
    const struct scene_import_points points = {.exact = (const double(*)[3])mesh->exact,
                                               .count = mesh->vertex_count};
    const struct scene_import_clusters clusters =
        scene_import_clusters_find(import, &points, lists, list_count);
    free(clusters.of_point);
    if (clusters.count < 2) {
        free(mesh->exact);
        mesh->exact = NULL;
    }
}

void scene_import_settle_mesh(struct scene_import *import, struct scene_mesh *mesh, double (*points)[3],
                              double origin[3])
{
    const struct scene_import_elements list = scene_import_elements_of(mesh);
    scene_import_keep_exact(import, mesh, (const double(*)[3])points);
    scene_import_check_exact(import, mesh, &list, 1);
    mesh->positions = scene_import_settle(import, points, mesh->vertex_count, origin);
}

bool scene_import_stay_floats(struct scene_import *import, const float (*points)[3], size_t count)
{
    const struct scene_import_points all = {.floats = points, .count = count};
    return !scene_import_clusters_may_be(&all) && !scene_import_are_far(import, points, count);
}

double (*scene_import_widen(struct scene_import *import, float (*points)[3], size_t count))[3]
{
    double(*const wide)[3] = scene_import_allocate(import, count, sizeof *wide);
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            wide[i][c] = (double)points[i][c];
        }
    }
    free(points);
    return wide;
}

float (*scene_import_settle_clusters(struct scene_import *import, double (*points)[3], size_t count,
                                     const struct scene_import_clusters *clusters, double (*origins)[3]))[3]
{
    if (clusters->of_point == NULL) {
        return scene_import_settle(import, points, count, origins[0]);
    }
    size_t ends[SCENE_IMPORT_CLUSTERS + 1] = {0};
    for (size_t i = 0; i < count; i++) {
        ends[clusters->of_point[i] + 1]++;
    }
    for (uint32_t c = 0; c < clusters->count; c++) {
        ends[c + 1] += ends[c];
    }
    double(*const sorted)[3] = scene_import_allocate(import, count, sizeof *sorted);
    size_t next[SCENE_IMPORT_CLUSTERS];
    memcpy(next, ends, sizeof next);
    for (size_t i = 0; i < count; i++) {
        memcpy(sorted[next[clusters->of_point[i]]++], points[i], sizeof *sorted);
    }
    for (uint32_t c = 0; c < clusters->count; c++) {
        const struct scene_import_spread spread =
            scene_import_spread_find(import, (const double(*)[3])sorted + ends[c], ends[c + 1] - ends[c]);
        for (int k = 0; k < 3; k++) {
            origins[c][k] = spread.is_far ? spread.middle[k] : 0;
        }
    }
    free(sorted);
    float(*const floats)[3] = scene_import_allocate(import, count, sizeof *floats);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            floats[i][k] = (float)(points[i][k] - origins[clusters->of_point[i]][k]);
        }
    }
    free(points);
    return floats;
}

// Cutting -------------------------------------------------------------------------------------------

// A mesh that is cut. Its vertices and its primitives are sorted by their clusters. Those of cluster c are from place
// starts[c] to starts[c + 1].
struct whole {
    struct scene_mesh mesh;
    struct scene_import_clusters clusters;
    const uint32_t *polygons;
    double origin[3]; // what mesh.exact counts from
    uint32_t *vertices, *primitives;
    uint32_t *vertex_starts, *primitive_starts;
    uint32_t *places; // place of each vertex among those of its cluster
};

static uint32_t cluster_of(const struct whole *whole, uint32_t vertex)
{
    return whole->clusters.of_point == NULL ? 0 : whole->clusters.of_point[vertex];
}

// Return the cluster of a primitive. Return UINT32_MAX if it has corners in several, as one with a corner that is not
// finite can have.
static uint32_t cluster_of_primitive(const struct whole *whole, uint32_t primitive)
{
    const uint32_t corners = scene_mesh_corners(&whole->mesh);
    const uint32_t *const indices = whole->mesh.indices + (size_t)primitive * corners;
    const uint32_t cluster = cluster_of(whole, indices[0]);
    for (uint32_t k = 1; k < corners; k++) {
        if (cluster_of(whole, indices[k]) != cluster) {
            return UINT32_MAX;
        }
    }
    return cluster;
}

// Sort numbers by the cluster of each. Leave out those that are in none, and return how many these are.
static uint32_t sort_by_cluster(struct scene_import *import, const struct whole *whole, uint32_t count,
                                uint32_t (*find)(const struct whole *, uint32_t), uint32_t **sorted,
                                uint32_t **starts)
{
    uint32_t left_out = 0;
    *sorted = scene_import_allocate(import, count, sizeof **sorted);
    *starts = scene_import_allocate(import, (size_t)whole->clusters.count + 2, sizeof **starts);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t cluster = find(whole, i);
        left_out += cluster == UINT32_MAX;
        (*starts)[cluster == UINT32_MAX ? 0 : cluster + 2] += cluster != UINT32_MAX;
    }
    for (uint32_t c = 0; c < whole->clusters.count; c++) {
        (*starts)[c + 2] += (*starts)[c + 1];
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t cluster = find(whole, i);
        if (cluster != UINT32_MAX) {
            (*sorted)[(*starts)[cluster + 1]++] = i;
        }
    }
    return left_out;
}

static void sort_whole(struct scene_import *import, struct whole *whole)
{
    const uint32_t primitives = whole->mesh.index_count / scene_mesh_corners(&whole->mesh);
    sort_by_cluster(import, whole, whole->mesh.vertex_count, cluster_of, &whole->vertices,
                    &whole->vertex_starts);
    const uint32_t left_out = sort_by_cluster(import, whole, primitives, cluster_of_primitive,
                                              &whole->primitives, &whole->primitive_starts);
    if (left_out > 0) {
        scene_import_warn(
            import, "mesh \"%s\": primitives with positions that are not finite are left out, %u of them",
            whole->mesh.name, left_out);
    }
    whole->places = scene_import_allocate(import, whole->mesh.vertex_count, sizeof *whole->places);
    for (uint32_t i = 0; i < whole->mesh.vertex_count; i++) {
        const uint32_t vertex = whole->vertices[i];
        whole->places[vertex] = i - whole->vertex_starts[cluster_of(whole, vertex)];
    }
}

// Return the piece of a cluster. Write the polygons of its triangles to `polygons`, NULL if there are none.
static struct scene_mesh take_piece(struct scene_import *import, const struct whole *whole, uint32_t cluster,
                                    double origin[3], uint32_t **polygons)
{
    struct scene_mesh piece = whole->mesh;
    const uint32_t corners = scene_mesh_corners(&whole->mesh);
    const uint32_t first = whole->primitive_starts[cluster], first_vertex = whole->vertex_starts[cluster];
    const uint32_t count = whole->primitive_starts[cluster + 1] - first;
    piece.index_count = count * corners;
    piece.indices = scene_import_allocate(import, piece.index_count, sizeof *piece.indices);
    *polygons = whole->polygons != NULL ? scene_import_allocate(import, count, sizeof **polygons) : NULL;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t primitive = whole->primitives[first + i];
        for (uint32_t k = 0; k < corners; k++) {
            const uint32_t vertex = whole->mesh.indices[(size_t)primitive * corners + k];
            piece.indices[(size_t)i * corners + k] = whole->places[vertex];
        }
        if (*polygons != NULL) {
            (*polygons)[i] = whole->polygons[primitive];
        }
    }
    scene_import_copy_vertices(import, &piece, whole->vertices + first_vertex,
                               whole->vertex_starts[cluster + 1] - first_vertex);
    free(piece.positions);
    piece.positions = scene_import_settle(import, piece.exact, piece.vertex_count, origin);
    piece.exact = NULL;
    for (int c = 0; c < 3; c++) {
        origin[c] += whole->origin[c];
    }
    return piece;
}

// Free what the pieces have copies of.
static void free_whole(struct whole *whole)
{
    void *const arrays[] = {whole->mesh.indices,      whole->mesh.positions,   whole->mesh.normals,
                            whole->mesh.tangents,     whole->mesh.colors,      whole->mesh.exact,
                            whole->clusters.of_point, whole->vertices,         whole->primitives,
                            whole->vertex_starts,     whole->primitive_starts, whole->places};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        free(arrays[i]);
    }
    for (int set = 0; set < SCENE_UV_SETS; set++) {
        free(whole->mesh.uvs[set]);
    }
}

static void add_piece(struct scene_import *import, const struct scene_import_piece *piece)
{
    scene_import_reserve(import, &import->pieces, &import->piece_capacity, import->piece_count + 1,
                         sizeof *import->pieces);
    import->pieces[import->piece_count++] = *piece;
}

static void cut(struct scene_import *import, uint32_t index, struct whole *whole,
                scene_import_piece_work *work, const void *context)
{
    sort_whole(import, whole);
    for (uint32_t i = 0; i < whole->clusters.count; i++) {
        struct scene_import_piece piece = {.of = index};
        uint32_t *polygons;
        piece.mesh = take_piece(import, whole, i, piece.origin, &polygons);
        if (work != NULL) {
            work(import, &piece.mesh, polygons, context);
        }
        free(polygons);
        if (i > 0) {
            add_piece(import, &piece);
            continue;
        }
        import->model.meshes[index] = piece.mesh;
        memcpy(import->exact_meshes.matrices[index] + 12, piece.origin, sizeof piece.origin);
    }
    free_whole(whole);
}

void scene_import_cut_exact(struct scene_import *import, uint32_t index, const uint32_t *polygons,
                            scene_import_piece_work *work, const void *context)
{
    struct whole whole = {.mesh = import->model.meshes[index], .polygons = polygons};
    const struct scene_import_points points = {.exact = (const double(*)[3])whole.mesh.exact,
                                               .count = whole.mesh.vertex_count};
    const struct scene_import_elements list = scene_import_elements_of(&whole.mesh);
    whole.clusters = scene_import_clusters_find(import, &points, &list, 1);
    cut(import, index, &whole, work, context);
}

void scene_import_cut_floats(struct scene_import *import, uint32_t index)
{
    struct whole whole = {.mesh = import->model.meshes[index]};
    const uint32_t count = whole.mesh.vertex_count;
    const struct scene_import_points points = {.floats = (const float(*)[3])whole.mesh.positions,
                                               .count = count};
    const struct scene_import_elements list = scene_import_elements_of(&whole.mesh);
    whole.clusters = scene_import_clusters_find(import, &points, &list, 1);
    if (whole.clusters.count < 2) {
        return;
    }
    memcpy(whole.origin, import->exact_meshes.matrices[index] + 12, sizeof whole.origin);
    whole.mesh.exact = scene_import_allocate(import, count, sizeof *whole.mesh.exact);
    for (uint32_t v = 0; v < count; v++) {
        for (int c = 0; c < 3; c++) {
            whole.mesh.exact[v][c] = (double)whole.mesh.positions[v][c];
        }
    }
    cut(import, index, &whole, NULL, NULL);
}

// Places --------------------------------------------------------------------------------------------

// Put a mesh of the model where another one stands, in the first `count` of the instances.
static void place_beside(struct scene_import *import, uint32_t mesh, const uint32_t *instances,
                         uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        struct scene_instance *const added = scene_import_add_instance(import);
        *added = import->model.instances[instances[i]];
        added->mesh = mesh;
        memcpy(import->exact_instances.matrices[import->exact_instances.count - 1],
               import->exact_instances.matrices[instances[i]], sizeof *import->exact_instances.matrices);
    }
}

// Write the instances to `sorted` by their meshes, those of mesh m from starts[m] to starts[m + 1]. All starts are 0
// before.
static void sort_instances(const struct scene_model *model, uint32_t *starts, uint32_t *sorted)
{
    for (uint32_t i = 0; i < model->instance_count; i++) {
        starts[model->instances[i].mesh]++;
    }
    for (uint32_t m = 1; m < model->mesh_count; m++) {
        starts[m] += starts[m - 1];
    }
    starts[model->mesh_count] = model->instance_count;
    for (uint32_t i = model->instance_count; i > 0; i--) {
        sorted[--starts[model->instances[i - 1].mesh]] = i - 1;
    }
}

enum { MOST_ADDED = 1 << 22 }; // instances of pieces of a model

void scene_import_place_pieces(struct scene_import *import)
{
    if (import->piece_count == 0) {
        return;
    }
    struct scene_model *const model = &import->model;
    uint32_t *const starts = scene_import_allocate(import, (size_t)model->mesh_count + 1, sizeof *starts);
    uint32_t *const sorted = scene_import_allocate(import, model->instance_count, sizeof *sorted);
    sort_instances(model, starts, sorted);
    uint64_t added = 0;
    for (size_t i = 0; i < import->piece_count; i++) {
        added += starts[import->pieces[i].of + 1] - starts[import->pieces[i].of];
    }
    if (added > MOST_ADDED) {
        scene_import_fail(import, "has too many parts that are far from each other");
    }
    for (size_t i = 0; i < import->piece_count; i++) {
        const struct scene_import_piece *const piece = &import->pieces[i];
        *scene_import_add_mesh(import) = piece->mesh;
        scene_import_place_mesh(import, piece->origin);
        const uint32_t first = starts[piece->of];
        place_beside(import, model->mesh_count - 1, sorted + first, starts[piece->of + 1] - first);
    }
    free(sorted);
    free(starts);
    free(import->pieces);
    import->pieces = NULL;
    import->piece_count = import->piece_capacity = 0;
}
